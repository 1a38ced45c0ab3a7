//! Branches of periodic orbits against thresholds evaluated with sixty digits.

use crate::source::{ball, near, only_of, source, values};
use signorini::orbit::branch::{End, Label};
use signorini::orbit::branch::{Graph, Locus, Request, Special, Switch, graph, locus};
use signorini::orbit::{Event, Kind, Orbit, Problem, Signature};
use signorini::{Error, Load, Result, Scene, Wall};
use std::f64::consts::{FRAC_PI_2, PI, TAU};

fn settled(scene: Scene) -> Orbit {
    Problem::new(scene).unwrap().settled(600).unwrap()
}

fn follow(
    family: &dyn Fn(f64) -> Result<Scene>,
    start: &Orbit,
    value: f64,
    range: [f64; 2],
    (switch, depth): (Switch, u32),
) -> Graph {
    let request = Request { range, switch, depth, points: 20_000 };
    graph(family, start, value, &request, &mut |_| ()).unwrap()
}

fn only(graph: &Graph, label: Label) -> &Special {
    let found: Vec<_> = graph.specials.iter().filter(|special| special.label == label).collect();
    assert_eq!(found.len(), 1, "{label}: {:?}", values(graph));
    found[0]
}

#[test]
fn a_branch_reaches_the_end_of_what_its_key_accepts() {
    // Beyond e = 1 there is no restitution: a step that leads there ends at e = 1 itself.
    let family = |e: f64| Ok(source(5.0, e));
    let found = follow(&family, &settled(source(5.0, 0.8)), 0.8, [0.3, 1.0], (Switch::No, 0));
    let branch = &found.branches[0];
    let (first, last) = (branch.points.first().unwrap(), branch.points.last().unwrap());
    assert_eq!([first.value, last.value], [0.3, 1.0], "{:?} {:?}", branch.ends, values(&found));
    assert_eq!(branch.ends, [Some(End::Range), Some(End::Range)]);
    // The product of both multipliers is e⁴ exp(−cT/m): that of the orbit at the ends themselves.
    for (point, e) in [(first, 0.3f64), (last, 1.0)] {
        let multipliers = &point.floquet.multipliers;
        let (a, b) = (multipliers[0], multipliers[1]);
        let product = [a[0] * b[0] - a[1] * b[1], a[0] * b[1] + a[1] * b[0]];
        let expected = e.powi(4) * (-0.2f64 * 0.2).exp();
        // A matrix of some roundings, and its eigenvalues.
        assert!((product[0] / expected - 1.0).abs() < 1e-10 && product[1].abs() < 1e-10, "{product:?}");
    }
}

#[test]
fn a_branch_towards_restitution_0_ends_where_the_rebound_comes_back_to_its_wall() {
    // At e = 0 other test functions count than above it; the graze before it is that of the closed
    // form of the flight, x(t) = -g at x'(t) = 0, with 30 digits.
    let family = |e: f64| Ok(source(5.0, e));
    let found = follow(&family, &settled(source(5.0, 0.8)), 0.8, [0.0, 1.0], (Switch::No, 0));
    assert_eq!(found.specials.len(), 1, "{:?}", values(&found));
    // The branch is followed in units of 1, the width of the range: to 1e-14 of that, a few
    // roundings.
    near(only(&found, Label::GrazingIn).point.value, 1.400_450_056_635_178_5e-4, 1e-10);
}

#[test]
fn fold_symmetry_breaking_and_grazing_of_the_symmetric_orbit() {
    for (restitution, fold, breaking) in
        [(0.8, 14.610_019_877_539_264, 4.570_839_133_780_74), (0.5, 8.742_829_292_083_56, 4.281_187_156_554_336)]
    {
        let family = |f: f64| Ok(source(f, restitution));
        let problem = Problem::new(source(5.0, restitution)).unwrap();
        let forms = signorini::orbit::closed_forms(problem.scene(), 1).unwrap();
        let start = forms.iter().find(|form| form.symmetric && form.is_stable()).unwrap().orbit(&problem);
        let graph = follow(&family, &start, 5.0, [4.1, 16.0], (Switch::No, 0));
        near(only(&graph, Label::Fold).point.value, fold, 1e-10);
        near(only(&graph, Label::SymmetryBreaking).point.value, breaking, 1e-10);
        // The unstable half ends where the motion without contact touches the walls.
        near(only(&graph, Label::GrazingOut).point.value, 4.210_773_813_134_604, 1e-12);
        assert_eq!(graph.branches.len(), 1);
    }
}

#[test]
fn the_grazing_locus_is_the_resonance_curve() {
    for omega in [0.8_f64, 1.0, 1.3] {
        let family = |amplitude: f64| {
            Ok(Scene::oscillator(1.0, 0.1, 1.0)
                .with_wall(Wall::upper("stop", 1.0).with_restitution(0.8))
                .with_load(Load::harmonic(amplitude, omega / TAU, FRAC_PI_2)))
        };
        let locus = ((1.0 - omega * omega).powi(2) + 0.01 * omega * omega).sqrt();
        let value = 2.0 * locus;
        let problem = Problem::new(family(value).unwrap()).unwrap();
        let forms = signorini::orbit::closed_forms(problem.scene(), 1).unwrap();
        let start =
            forms.iter().map(|form| form.orbit(&problem)).find(|orbit| problem.admissible(orbit).unwrap().holds());
        let Some(start) = start else { panic!("{omega}: {forms:?}") };
        let graph = follow(&family, &start, value, [0.02 * locus, 3.0 * locus], (Switch::No, 0));
        let grazing = graph.specials.iter().find(|special| special.label == Label::GrazingOut);
        near(grazing.expect("a grazing orbit").point.value, locus, 1e-11);
    }
}

#[test]
fn the_ball_folds_and_doubles_where_theory_says() {
    let family = |gamma: f64| Ok(ball(gamma));
    let problem = Problem::new(ball(1.1)).unwrap();
    let phase = (PI * 0.3 / 1.7 / 1.1).acos() / TAU;
    let guess =
        Orbit { signature: Signature::impacts(&[0], 1), phases: vec![phase], speeds: vec![0.577], forcing_period: 0.1 };
    let start = problem.correct(&guess).unwrap();
    let graph = follow(&family, &start, 1.1, [0.3, 1.25], (Switch::Stable, 1));
    // The doubled branch may fold or double again: the first branch has one of each.
    let first = |label: Label| only_of(&graph, 0, label);
    near(first(Label::Fold).point.value, 0.554_398_703_574_669_4, 1e-11);
    let doubling = first(Label::PeriodDoubling);
    near(doubling.point.value, 1.170_731_171_330_088_6, 1e-11);
    // Beyond it runs settle on the orbit of twice the period.
    let doubled = &graph.branches[doubling.leads_to[0]];
    let stable = doubled.points.iter().rfind(|point| point.floquet.is_stable()).unwrap();
    assert_eq!(stable.orbit.signature.periods, 2);
    assert!((stable.orbit.speeds[0] - stable.orbit.speeds[1]).abs() > 1e-2 * stable.orbit.speeds[0]);
    let problem = Problem::new(ball(stable.value)).unwrap();
    assert!(problem.judge(&stable.orbit, 10).unwrap().holds());
}

#[test]
fn the_oscillator_with_a_wall_at_its_rest_position_doubles() {
    // Shaw & Holmes 1983 (doi:10.1016/0022-460X(83)90407-8), without damping, e = 0.8.
    let family = |omega: f64| {
        Ok(Scene::oscillator(1.0, 0.0, 1.0)
            .with_wall(Wall::upper("stop", 0.0).with_restitution(0.8))
            .with_load(Load::harmonic(1.0, omega / TAU, FRAC_PI_2)))
    };
    let problem = Problem::new(family(2.7).unwrap()).unwrap();
    let forms = signorini::orbit::closed_forms(problem.scene(), 1).unwrap();
    let form = forms.iter().find(|form| !form.symmetric).unwrap();
    // Published to six digits.
    near(form.multipliers[0][0], -1.728_990, 1e-6);
    near(form.multipliers[1][0], -0.370_158, 2e-6);
    let graph = follow(&family, &form.orbit(&problem), 2.7, [2.4, 2.9], (Switch::No, 0));
    near(only(&graph, Label::PeriodDoubling).point.value, 2.653_35, 2e-6);
}

#[test]
fn the_quiet_motion_and_the_symmetric_branch_meet_where_it_touches() {
    let family = |f: f64| Ok(source(f, 0.8));
    let quiet = Problem::new(source(6.0, 0.8)).unwrap().settled(400);
    // A run from rest may settle on impacts: the quiet motion is an orbit all the same.
    let start = Orbit {
        signature: Signature { events: Vec::new(), periods: 1, symmetric: true },
        phases: Vec::new(),
        speeds: Vec::new(),
        forcing_period: 1.0 / 6.0,
    };
    assert!(quiet.is_ok());
    let graph = follow(&family, &start, 6.0, [4.0, 7.0], (Switch::All, 2));
    let touch = &graph.specials[0];
    assert_eq!(touch.label, Label::GrazingIn);
    near(touch.point.value, 4.210_773_813_134_604, 1e-12);
    // The branch with impacts begins there, unstable, and rises in frequency: it is the twin of the
    // attracting one.
    let impacts = &graph.branches[touch.leads_to[0]];
    assert!(impacts.points[0].orbit.speeds[0].abs() < 1e-9 && impacts.points[5].value > touch.point.value);
    assert!(!impacts.points[5].floquet.is_stable());
    // And back: from the impacts the same node is found, and the quiet branch is known.
    let problem = Problem::new(source(5.0, 0.8)).unwrap();
    let start = settled(source(5.0, 0.8));
    assert!(problem.is_symmetric());
    let back = follow(&family, &start, 5.0, [4.0, 16.0], (Switch::All, 1));
    let graze = back.specials.iter().find(|special| special.branch == 0 && special.label == Label::GrazingOut).unwrap();
    let quiet = &back.branches[graze.leads_to[0]];
    assert!(quiet.points[0].orbit.phases.is_empty() && quiet.points.last().unwrap().value > 15.9);
}

#[test]
fn a_broken_symmetry_leads_to_stable_orbits_without_it() {
    let family = |f: f64| Ok(source(f, 0.8));
    let start = settled(source(5.0, 0.8));
    let graph = follow(&family, &start, 5.0, [4.3, 5.5], (Switch::Stable, 1));
    let breaking = graph.specials.iter().find(|special| special.label == Label::SymmetryBreaking).unwrap();
    let broken = graph.branches[breaking.leads_to[0]].clone();
    // Where an impact vanishes, its wall is not touched anew besides.
    let graph = follow(&family, &start, 5.0, [1.5, 5.5], (Switch::Stable, 2));
    let three = graph.branches.iter().position(|branch| branch.points[0].orbit.speeds.len() == 3).unwrap();
    // The symmetric orbit touches a wall anew at the same node.
    let node = only_of(&graph, 0, Label::GrazingIn).point.value;
    near(only_of(&graph, three, Label::GrazingOut).point.value, node, 1e-11);
    for special in graph.specials.iter().filter(|special| special.label == Label::GrazingIn) {
        let top = special.point.orbit.speeds.iter().fold(0.0, |top: f64, v| top.max(*v));
        assert!(special.point.orbit.speeds.iter().all(|v| *v > 1e-6 * top), "{:?}", special.point.orbit);
    }
    let point = &broken.points[broken.points.len().min(6) - 1];
    assert!(!point.orbit.signature.symmetric && point.orbit.speeds.len() == 2);
    assert!((point.orbit.speeds[0] - point.orbit.speeds[1]).abs() > 1e-4 * point.orbit.speeds[0]);
}

#[test]
fn a_branch_is_the_same_from_either_end() {
    let family = |f: f64| Ok(source(f, 0.8));
    let start = settled(source(5.0, 0.8));
    let first = follow(&family, &start, 5.0, [4.3, 16.0], (Switch::No, 0));
    let last = first.branches[0].points.iter().rev().find(|point| point.value < 13.0).unwrap();
    let second = follow(&family, &last.orbit, last.value, [4.3, 16.0], (Switch::No, 0));
    let listed = |graph: &Graph| {
        let mut all: Vec<f64> = graph.specials.iter().map(|special| special.point.value).collect();
        all.sort_by(f64::total_cmp);
        all
    };
    let (a, b) = (listed(&first), listed(&second));
    assert!(a.len() == b.len() && a.len() >= 2, "{a:?} {b:?}");
    a.iter().zip(&b).for_each(|(a, b)| near(*a, *b, 1e-10));
}

#[test]
fn force_and_gap_fold_at_the_same_ratio() {
    let scene = |force: f64, gap: f64| {
        Scene::oscillator(1.0, 0.2, 100.0)
            .with_wall(Wall::upper("upper", gap).with_restitution(0.8))
            .with_wall(Wall::lower("lower", -gap).with_restitution(0.8))
            .with_load(Load::harmonic(force, 8.0, 0.0))
    };
    let problem = Problem::new(scene(3.0, 5e-3)).unwrap();
    let forms = signorini::orbit::closed_forms(problem.scene(), 1).unwrap();
    let start = forms.iter().find(|form| form.symmetric && form.is_stable()).unwrap().orbit(&problem);
    let in_force = follow(&|force| Ok(scene(force, 5e-3)), &start, 3.0, [0.5, 4.0], (Switch::No, 0));
    let in_gap = follow(&|gap| Ok(scene(3.0, gap)), &start, 5e-3, [4e-3, 5e-2], (Switch::No, 0));
    let product = only(&in_force, Label::Fold).point.value * only(&in_gap, Label::Fold).point.value;
    near(product, 3.0 * 5e-3, 1e-10);
}

#[test]
fn stable_orbits_attract_runs() {
    let family = |f: f64| Ok(source(f, 0.8));
    let start = settled(source(5.0, 0.8));
    let graph = follow(&family, &start, 5.0, [4.3, 7.0], (Switch::Stable, 2));
    let stable = graph.branches.iter().flat_map(|branch| &branch.points).filter(|point| {
        let largest = point.floquet.multipliers.iter().map(|m| m[0].hypot(m[1])).fold(0.0, f64::max);
        largest < 0.9 && !point.orbit.phases.is_empty()
    });
    let mut checked = 0;
    for point in stable.step_by(7) {
        let problem = Problem::new(source(point.value, 0.8)).unwrap();
        let motion = problem.judge(&point.orbit, 1).unwrap().motion;
        let state = [motion[0].displacement, motion[0].velocity];
        // A run from close to the orbit, its load's phase moved to t = 0.
        let shift = TAU * point.value * motion[0].time;
        let mut scene = source(point.value, 0.8).with_initial(&[state[0] * (1.0 + 1e-4)], &[state[1] * (1.0 + 1e-4)]);
        scene.loads = vec![Load::harmonic(3.0, point.value, shift)];
        let found = Problem::new(scene).unwrap().settled(300).unwrap();
        let mut speeds = [found.speeds.clone(), point.orbit.speeds.clone()];
        speeds.iter_mut().for_each(|list| list.sort_by(f64::total_cmp));
        assert_eq!(speeds[0].len(), speeds[1].len(), "{}", point.value);
        speeds[0].iter().zip(&speeds[1]).for_each(|(a, b)| near(*a, *b, 1e-8));
        checked += 1;
    }
    assert!(checked > 3);
}

#[test]
fn at_restitution_0_a_grazing_impact_is_no_fold() {
    // The place of the wall changes by the square of the speed of the impact that vanishes, so that
    // its derivative by the speed is 0 there; all multipliers are 0, and none is 1.
    let family = |position: f64| {
        Ok(Scene::oscillator(1.0, 0.02, 1.0)
            .with_wall(Wall::upper("stop", position).with_restitution(0.0))
            .with_load(Load::harmonic(1.0, 0.47, 0.0))
            .with_initial(&[-0.5], &[0.0]))
    };
    let start = settled(family(0.0).unwrap());
    let graph = follow(&family, &start, 0.0, [-0.3, 0.3], (Switch::No, 0));
    assert!(graph.specials.iter().any(|special| special.label == Label::GrazingOut), "{:?}", values(&graph));
    assert!(graph.specials.iter().all(|special| special.label != Label::Fold), "{:?}", values(&graph));
}

#[test]
fn an_orbit_that_rests_is_followed_until_its_rest_ends() {
    let family = |f: f64| Ok(source(f, 0.0));
    let start = settled(source(1.0, 0.0));
    assert!(start.signature.rests());
    let graph = follow(&family, &start, 1.0, [0.5, 6.0], (Switch::All, 1));
    let special = only_of(&graph, 0, Label::RestEnds);
    assert_eq!(graph.branches[0].ends, [Some(End::Range), Some(End::Special(Label::RestEnds))]);
    // The load presses no more on the arriving body: F |sin θ| = k g.
    let arrival = special.point.orbit.phases[1];
    near(3.0 * (TAU * arrival).sin().abs(), 0.5, 1e-10);
    // Beyond, the body leaves at once.
    let beyond = &graph.branches[special.leads_to[0]];
    let point = &beyond.points[4];
    assert!(point.orbit.signature.events.len() == 1 && point.value > special.point.value);
    let judged = Problem::new(source(point.value, 0.0)).unwrap().judge(&point.orbit, 10).unwrap();
    assert!(judged.holds(), "{} {}", judged.closure, judged.same_events);
}

#[test]
fn an_orbit_that_rests_after_one_impact_ends_where_its_wall_begins_to_rebound() {
    let family = |e: f64| Ok(source(1.0, e));
    let start = settled(source(1.0, 0.0));
    assert!(start.signature.rests());
    let graph = follow(&family, &start, 0.0, [0.0, 1.0], (Switch::All, 1));
    let [branch] = &graph.branches[..] else { panic!("{} branches", graph.branches.len()) };
    assert_eq!(branch.points.len(), 1);
    let refused = |end: &End| matches!(end, End::Refused(why) if why.contains("only without a rebound"));
    assert!(branch.ends.iter().flatten().any(refused), "{:?}", branch.ends);
    // Nor is it one of a wall that rebounds.
    let refused = Problem::new(source(1.0, 0.5)).unwrap().judge(&start, 1).unwrap_err();
    assert!(refused.is_request() && refused.to_string().contains("whose restitution is 0.5"), "{refused}");
}

#[test]
fn what_cannot_be_followed_is_refused() {
    let family = |f: f64| Ok(source(f, 0.8));
    let start = settled(source(5.0, 0.8));
    let request = |range: [f64; 2]| Request { range, switch: Switch::No, depth: 0, points: 100 };
    for (range, words) in
        [([6.0, 5.0], "the first below the second"), ([6.0, 7.0], "a value of the key from 6.0 to 7.0")]
    {
        let refused = graph(&family, &start, 5.0, &request(range), &mut |_| ()).unwrap_err();
        assert!(refused.is_request() && refused.to_string().contains(words), "{refused}");
    }
    // The key's values end before the range does.
    let family = |e: f64| {
        let scene = source(5.0, e);
        scene.validate().map(|()| scene)
    };
    let found = graph(&family, &start, 0.8, &request([0.7, 1.5]), &mut |_| ()).unwrap();
    let last = found.branches[0].points.iter().map(|point| point.value).fold(0.0, f64::max);
    assert!(last <= 1.0 && last > 0.99, "{last}");
    let refused = |end: &End| matches!(end, End::Refused(why) if why.contains("from 0 to 1"));
    assert!(found.branches[0].ends.iter().flatten().any(refused), "{:?}", found.branches[0].ends);
    // Impacts that accumulate are not solved for.
    let chatter = settled(source(1.0, 0.5));
    let refused = graph(&|f| Ok(source(f, 0.5)), &chatter, 1.0, &request([0.9, 1.1]), &mut |_| ()).unwrap_err();
    assert!(matches!(&refused, Error::NoOrbit { reason } if reason.contains("accumulate")), "{refused}");
}

fn at(curve: &Locus, second: f64) -> f64 {
    let found = curve.points.iter().find(|point| point.values[1] == second);
    found.unwrap_or_else(|| panic!("{:?}", curve.ends)).values[0]
}

#[test]
fn loci_join_the_thresholds_of_two_restitutions() {
    let plane = |[frequency, restitution]: [f64; 2]| Ok(source(frequency, restitution));
    let start = settled(source(5.0, 0.8));
    let graph = follow(&|f| Ok(source(f, 0.8)), &start, 5.0, [4.1, 16.0], (Switch::No, 0));
    let ranges = [[4.0, 20.0], [0.5, 0.85]];
    // From e = 0.8 to e = 0.5, both known to thirty digits. A locus is solved by differences of its
    // test function: 1e-9 of the values remain.
    for (label, half) in [
        (Label::Fold, 8.742_829_292_083_56),
        (Label::SymmetryBreaking, 4.281_187_156_554_336),
        (Label::GrazingOut, 4.210_773_813_134_604),
    ] {
        let curve = locus(&plane, only(&graph, label), 0.8, ranges, 2000).unwrap();
        near(at(&curve, 0.5), half, 1e-9);
    }
    let special = only(&graph, Label::Fold);
    let refused = locus(&plane, special, 0.9, ranges, 10).unwrap_err();
    assert!(refused.is_request() && refused.to_string().contains("from 0.5 to 0.85"), "{refused}");
}

#[test]
fn the_locus_of_the_balls_doubling_is_that_of_theory() {
    let plane = |[gamma, restitution]: [f64; 2]| {
        let mut scene = ball(gamma);
        scene.walls[0] = Wall::lower("table", 0.0).with_restitution(restitution);
        Ok(scene)
    };
    let problem = Problem::new(ball(1.1)).unwrap();
    let guess = Orbit {
        signature: Signature::impacts(&[0], 1),
        phases: vec![(PI * 0.3 / 1.7 / 1.1).acos() / TAU],
        speeds: vec![0.577],
        forcing_period: 0.1,
    };
    let start = problem.correct(&guess).unwrap();
    let graph = follow(&|gamma| Ok(ball(gamma)), &start, 1.1, [0.3, 1.25], (Switch::No, 0));
    let special = only(&graph, Label::PeriodDoubling);
    let curve = locus(&plane, special, 0.7, [[0.1, 3.0], [0.4, 0.95]], 1000).unwrap();
    assert!(curve.points.len() > 10);
    for point in &curve.points {
        let [gamma, e] = point.values;
        let (cosine, sine) = (PI * (1.0 - e) / (1.0 + e), 2.0 * (1.0 + e * e) / ((1.0 + e) * (1.0 + e)));
        near(gamma, cosine.hypot(sine), 1e-9);
    }
}

#[test]
fn elastic_walls_are_met_and_left_at_grazes() {
    let family = |f: f64| {
        Ok(Scene::oscillator(1.0, 0.2, 100.0)
            .with_wall(Wall::upper("upper", 5e-3).with_elasticity(1e5, 20.0))
            .with_wall(Wall::lower("lower", -4e-3).with_restitution(0.6))
            .with_load(Load::harmonic(3.0, f, 0.3)))
    };
    let start = settled(family(4.0).unwrap());
    let graph = follow(&family, &start, 4.0, [2.0, 14.0], (Switch::All, 2));
    assert!(graph.branches.len() > 5);
    // A special point other than a fold leads on, or says why not.
    let silent = |s: &&Special| s.label != Label::Fold && s.leads_to.is_empty() == s.reason.is_none();
    assert_eq!(graph.specials.iter().find(silent).map(|s| (s.label, s.point.value)), None);
    assert!(
        graph.specials.iter().flat_map(|s| &s.reason).any(|reason| reason.contains("switches from the first branch"))
    );
    // A contact that vanishes is one special point, not a fold and a doubling besides.
    for (index, special) in graph.specials.iter().enumerate() {
        for other in &graph.specials[index + 1..] {
            let same = special.branch == other.branch && special.after == other.after;
            assert!(!same || (special.point.value - other.point.value).abs() > 1e-9, "{:?}", values(&graph));
        }
    }
    // Stable orbits of every branch are what the free run does.
    let mut checked = 0;
    for branch in &graph.branches {
        let stable = branch.points.iter().filter(|point| point.floquet.is_stable());
        for point in stable.step_by(11) {
            let judged = Problem::new(family(point.value).unwrap()).unwrap().judge(&point.orbit, 1).unwrap();
            assert!(judged.holds(), "{}: {} {}", point.value, judged.closure, judged.same_events);
            checked += 1;
        }
    }
    assert!(checked > 10);
}

#[test]
fn a_body_that_no_longer_comes_out_of_its_wall_meets_it_again_behind_the_face() {
    // A pad with a dashpot that its own spring preloads by 0.075 N.
    let family = |amplitude: f64| {
        Ok(Scene::oscillator(1.0, 0.5, 100.0)
            .with_wall(Wall::upper("pad", -1e-3).with_elasticity(300.0, 1.0))
            .with_load(Load::harmonic(amplitude, 2.0, 0.0)))
    };
    let start = settled(family(0.1).unwrap());
    let graph = follow(&family, &start, 0.1, [0.05, 0.11], (Switch::All, 1));
    let graze = only_of(&graph, 0, Label::GrazingOut);
    let [beyond] = graze.leads_to[..] else { panic!("{:?}", graze.reason) };
    assert_eq!(graph.branches[beyond].points[0].orbit.signature.events.len(), 2);
    // Below an amplitude the pad is never left: its force along the linear motion on it stays above
    // 0. There the flights end.
    let omega = 2.0 * TAU;
    let linear = (400.0 - omega * omega).hypot(1.5 * omega) / 300.0_f64.hypot(omega);
    near(only_of(&graph, beyond, Label::Corner).point.value, 0.075 * linear, 1e-9);
    assert_eq!(graph.specials.iter().filter(|special| special.branch == beyond).count(), 1, "{:?}", values(&graph));
    for point in graph.branches[beyond].points.iter().skip(1).step_by(3).filter(|point| point.floquet.is_stable()) {
        let judged = Problem::new(family(point.value).unwrap()).unwrap().judge(&point.orbit, 1).unwrap();
        assert!(judged.holds(), "{}: {} {}", point.value, judged.closure, judged.same_events);
    }
}

#[test]
fn a_dashpot_that_pushes_again_behind_the_face_begins_another_branch() {
    let family = |stiffness: f64| {
        Ok(Scene::oscillator(1.0, 0.93, 43.476)
            .with_wall(Wall::upper("a", 5.239e-3).with_elasticity(stiffness, 4.763))
            .with_wall(Wall::lower("b", -4.787e-3).with_elasticity(622.686, 17.234))
            .with_load(Load::harmonic(1.030_678, 1.542_15, 0.0)))
    };
    let start = settled(family(400.0).unwrap());
    let graph = follow(&family, &start, 400.0, [350.0, 800.0], (Switch::All, 3));
    // The push of b begins and ends again: three branches one after the other, no fold or doubling.
    let specials: Vec<_> = graph.specials.iter().map(|special| (special.label, special.branch)).collect();
    assert_eq!(specials, [(Label::ContactEnds, 0), (Label::Corner, 1)], "{:?}", values(&graph));
    let events = graph.branches.iter().map(|branch| branch.points[0].orbit.signature.events.len());
    assert_eq!(events.collect::<Vec<_>>(), [4, 6, 4]);
    assert_eq!(graph.branches[2].ends[1], Some(End::Range));
    // Free runs have the same events, but where a push or pause is too short to be told.
    let apart = |value: f64| graph.specials.iter().all(|special| (special.point.value - value).abs() > 0.1);
    let mut checked = 0;
    for branch in &graph.branches {
        for point in branch.points.iter().step_by(5).filter(|point| apart(point.value)) {
            let judged = Problem::new(family(point.value).unwrap()).unwrap().judge(&point.orbit, 3).unwrap();
            assert!(judged.holds(), "{}: {} {}", point.value, judged.closure, judged.same_events);
            checked += 1;
        }
    }
    assert!(checked > 8, "{checked}");
}

#[test]
fn a_push_behind_the_face_of_a_dashpot_comes_out_to_it_and_becomes_a_contact() {
    let family = |damping: f64| {
        Ok(Scene::oscillator(1.0, 1.0, 167.0)
            .with_wall(Wall::upper("a", 3.1e-3).with_elasticity(305.0, damping))
            .with_load(Load::harmonic(3.9, 1.21, 0.0)))
    };
    let start = settled(family(10.0).unwrap());
    let graph = follow(&family, &start, 10.0, [1.0, 20.0], (Switch::All, 3));
    let kinds = |events: &[Event]| events.iter().map(|event| event.kind).collect::<Vec<_>>();
    let found: Vec<_> = graph.branches.iter().map(|branch| kinds(&branch.points[1].orbit.signature.events)).collect();
    let (enter, leave, again) = (Kind::Enter, Kind::Leave, Kind::Again);
    let expected = [vec![enter, leave], vec![enter, leave, again, leave], vec![enter, leave, enter, leave]];
    assert_eq!(found, expected, "{:?}", values(&graph));
    // The events on which free runs settle.
    for (damping, events) in [(10.0, &expected[0]), (5.0, &expected[1]), (3.0, &expected[2]), (1.5, &expected[2])] {
        assert_eq!(&kinds(&settled(family(damping).unwrap()).signature.events), events, "{damping} N s/m");
    }
    let last = graph.branches[2].points.iter().rfind(|point| point.value < 3.0).unwrap();
    assert!(Problem::new(family(last.value).unwrap()).unwrap().judge(&last.orbit, 3).unwrap().holds());
}

#[test]
fn a_branch_of_twice_the_period_ends_where_it_meets_that_of_the_single_one_again() {
    let family = |frequency: f64| {
        Ok(Scene::oscillator(1.3, 0.4, 90.0)
            .with_wall(Wall::upper("stop", 2e-3).with_restitution(0.75))
            .with_load(Load::harmonic(4.0, frequency, 0.4)))
    };
    let start = settled(family(3.4).unwrap());
    let graph = follow(&family, &start, 3.4, [3.39, 3.72], (Switch::All, 3));
    let returned: Vec<_> = graph
        .branches
        .iter()
        .enumerate()
        .filter(|(_, branch)| branch.ends[1] == Some(End::Special(Label::PeriodDoubling)) && branch.depth < 3)
        .collect();
    assert!(!returned.is_empty(), "{:?}", values(&graph));
    for (number, branch) in returned {
        // It leads back to the branch where it began: its other end is a doubling of that one.
        let last = graph.specials.iter().rfind(|special| special.branch == number).unwrap();
        let parent = graph.specials[branch.from.unwrap()].branch;
        assert_eq!(last.leads_to, [parent], "{:?}", last.reason);
        let other = graph.specials.iter().filter(|s| s.branch == parent && s.label == Label::PeriodDoubling);
        assert!(other.clone().any(|s| (s.point.value - last.point.value).abs() < 1e-8), "{:?}", values(&graph));
    }
    // Nothing is passed twice.
    for (index, one) in graph.specials.iter().enumerate() {
        for other in &graph.specials[index + 1..] {
            let same = one.branch == other.branch && one.label == other.label;
            assert!(!same || (one.point.value - other.point.value).abs() > 1e-9, "{:?}", values(&graph));
        }
    }
}

/// A bilinear oscillator, whose wall is eight times as stiff as its spring: the orbit over two
/// periods with one contact, resonant at twice the bilinear frequency. Where the body leaves its
/// wall for an instant within that contact, there begin orbits with two, down to the doubling of
/// the orbits over one period.
#[test]
fn a_contact_without_a_dashpot_parts_where_its_wall_lets_go_within_it() {
    let family = |frequency: f64| {
        Ok(Scene::oscillator(1.0, 0.2, 1.0)
            .with_wall(Wall::upper("stop", 0.0).with_elasticity(8.0, 0.0))
            .with_load(Load::harmonic(1.0, frequency, 0.0)))
    };
    let start = settled(family(0.477_464_829).unwrap());
    assert_eq!((start.signature.periods, start.signature.events.len()), (2, 2));
    let graph = follow(&family, &start, 0.477_464_829, [0.3, 0.8], (Switch::All, 4));
    let number = |label: Label| graph.specials.iter().filter(|special| special.label == label).count();
    assert!(graph.branches.iter().all(|branch| !branch.ends.iter().flatten().any(|end| matches!(end, End::Stuck(_)))));
    let [parts] = graph.specials.iter().filter(|s| s.label == Label::ContactEnds).collect::<Vec<_>>()[..] else {
        panic!("{:?}", values(&graph))
    };
    // Two contacts follow, up to the doubling of the orbits over one period.
    let [divided] = parts.leads_to[..] else { panic!("{:?}", parts.reason) };
    assert_eq!(graph.branches[divided].points[0].orbit.signature.events.len(), 4);
    assert_eq!(graph.branches[divided].ends[1], Some(End::Special(Label::PeriodDoubling)));
    let doubling = graph.specials.iter().find(|special| special.branch == divided).unwrap();
    let [single] = doubling.leads_to[..] else { panic!("{:?}", doubling.reason) };
    assert_eq!(graph.branches[single].points[0].orbit.signature.periods, 1);
    // A doubling that a branch reaches from beyond is no fold.
    assert_eq!(number(Label::Fold), 1, "{:?}", values(&graph));
    // A free run from any orbit comes back.
    for branch in &graph.branches {
        for point in branch.points.iter().step_by(10).filter(|point| point.admissible.holds()) {
            let problem = Problem::new(family(point.value).unwrap()).unwrap();
            let judged = problem.judge(&point.orbit, 8).unwrap();
            assert!(judged.same_events, "{} Hz: {}", point.value, point.orbit.signature.events.len());
        }
    }
}
