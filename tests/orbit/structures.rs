//! Branches of periodic orbits of structures, against those of one degree of freedom, closed forms
//! and free runs.

use crate::source::{near, only_of, source, values};
use signorini::linear::Symmetric;
use signorini::orbit::branch::{End, Graph, Label, Point, Request, Special, Switch, graph};
use signorini::orbit::{Kind, Problem, Shot, closed_forms, shoot};
use signorini::{Error, Face, Load, Result, Row, Scene, Scheme, Side, State, Stepper, Structure, Wall, WallLaw};
use std::f64::consts::{FRAC_PI_2, TAU};

/// `first`, a body of one degree of freedom (kg, N s/m, N/m), and beside it a second one that
/// nothing joins to it, under a load of `frequency` (Hz). Both are seen in coordinates turned by an
/// angle, so that the matrices are full.
fn beside(first: &Scene, [mass, damping, stiffness]: [f64; 3], frequency: f64) -> Scene {
    let (c, s) = (0.8, 0.6);
    // q = T p with p the two bodies: M = T diag T' as T' T = 1.
    let turned = |a: f64, b: f64| {
        Symmetric::from_entries(
            2,
            [(0, 0, c * c * a + s * s * b), (1, 0, c * s * (a - b)), (1, 1, s * s * a + c * c * b)],
        )
    };
    let structure =
        Structure { mass: turned(mass, 0.7), damping: turned(damping, 1.1), stiffness: turned(stiffness, 300.0) };
    let at = Row::new(vec![(0, c), (1, s)]);
    let mut scene = Scene::structure(structure);
    scene.walls = first.walls.iter().map(|wall| wall.clone().at(at.clone())).collect();
    scene.loads = first.loads.iter().map(|load| Load { at: at.clone(), ..load.clone() }).collect();
    scene.loads.push(Load { at: Row::new(vec![(0, -s), (1, c)]), ..Load::harmonic(0.5, frequency, 0.3) });
    scene
}

fn source_beside(frequency: f64, restitution: f64) -> Scene {
    beside(&source(frequency, restitution), [1.0, 0.2, 100.0], frequency)
}

/// The two masses of `orbits.rs`, which are coupled.
fn two_masses(frequency: f64) -> Scene {
    let chain = signorini::Chain { masses: vec![1.0, 0.5], springs: vec![60.0], grounds: [80.0, 20.0] };
    let damping = signorini::Damping::Rayleigh { mass: 0.3, stiffness: 2e-3 };
    Scene::structure(chain.structure().unwrap().with_damping(&damping).unwrap())
        .with_wall(Wall::upper("stop", 5e-3).with_restitution(0.6))
        .with_load(Load::harmonic(2.0, frequency, 0.0))
}

fn settled(scene: &Scene) -> Shot {
    shoot(scene, 600, &|_| ()).unwrap()
}

fn follow(
    family: &dyn Fn(f64) -> Result<Scene>,
    start: &Shot,
    value: f64,
    range: [f64; 2],
    (switch, depth): (Switch, u32),
) -> Graph {
    let request = Request { range, switch, depth, points: 3000 };
    graph(family, start, value, &request, &mut |_| ()).unwrap()
}

/// The state after `periods` forcing periods of the free run from the strobe of `point`.
fn after(scene: &Scene, point: &Point, state: &State, periods: f64) -> State {
    let strobe = point.strobe.as_ref().unwrap();
    let (from, period) = (strobe.phase * point.orbit.forcing_period, point.orbit.forcing_period);
    let end = from + periods * period;
    let scene = scene.clone().with_duration(end);
    let mut stepper = Stepper::new(&scene, &Scheme::Event, end).unwrap();
    stepper.set_state(from, state).unwrap();
    while stepper.time() < end {
        stepper.step().unwrap();
    }
    stepper.state()
}

#[test]
fn a_body_beside_another_one_has_the_branches_of_its_own() {
    // The thresholds have thirty digits.
    for (restitution, fold, breaking) in
        [(0.8, 14.610_019_877_539_264, 4.570_839_133_780_74), (0.5, 8.742_829_292_083_56, 4.281_187_156_554_336)]
    {
        let family = |f: f64| Ok(source_beside(f, restitution));
        let start = settled(&source_beside(5.0, restitution));
        let found = follow(&family, &start, 5.0, [4.1, 16.0], (Switch::No, 0));
        near(only_of(&found, 0, Label::Fold).point.value, fold, 1e-10);
        near(only_of(&found, 0, Label::SymmetryBreaking).point.value, breaking, 1e-10);
        let graze = only_of(&found, 0, Label::GrazingOut);
        near(graze.point.value, 4.210_773_813_134_604, 1e-10);
        assert!(graze.wall.is_some() && found.branches[0].ends.contains(&Some(End::Special(Label::GrazingOut))));
        // Beyond the graze the motion without contact goes on, without a switch.
        let quiet = &found.branches[graze.leads_to[0]];
        assert!(quiet.depth == 0 && quiet.points.iter().all(|point| point.orbit.phases.is_empty()));
        assert!(quiet.points.last().unwrap().value == 16.0, "{:?}", quiet.ends);
        // The multipliers of one body are among those of both, and its impacts are theirs.
        let fast = |point: &&Point| point.value < 8.0 && point.admissible.least_speed > 1e-4;
        for point in found.branches[0].points.iter().filter(fast).step_by(9) {
            let problem = Problem::new(source(point.value, restitution)).unwrap();
            let orbit = problem.correct(&point.orbit).unwrap();
            assert!((point.orbit.speeds[0] - orbit.speeds[0]).abs() < 1e-9, "{:?} {orbit:?}", point.orbit);
            let own = problem.floquet(&orbit).unwrap();
            for [re, im] in own.half.clone().unwrap() {
                let half = point.floquet.half.as_ref().unwrap();
                let least = half.iter().map(|[a, b]| (a - re).hypot(b - im)).fold(f64::INFINITY, f64::min);
                // They grow without bound towards the graze.
                assert!(least <= 1e-7 * (1.0 + re.hypot(im).powi(2)), "{} {own:?} {half:?}", point.value);
            }
        }
    }
}

#[test]
fn impacts_begin_where_the_motion_touches_a_wall() {
    let family = |f: f64| Ok(source_beside(f, 0.8));
    let quiet = shoot(&source_beside(16.0, 0.8), 3000, &|_| ()).unwrap();
    assert_eq!(quiet.contacts, [0, 0]);
    let found = follow(&family, &quiet, 16.0, [4.3, 16.0], (Switch::No, 0));
    assert!(found.specials.is_empty(), "{:?}", values(&found));
    let found = follow(&family, &quiet, 16.0, [4.0, 16.0], (Switch::Stable, 1));
    let touch = only_of(&found, 0, Label::GrazingIn);
    near(touch.point.value, 4.210_773_813_134_604, 1e-10);
    // The branch with impacts begins there, unstable, and rises in frequency.
    let impacts = &found.branches[touch.leads_to[0]];
    assert!(impacts.points[0].value > touch.point.value && !impacts.points[0].floquet.is_stable());
    near(only_of(&found, touch.leads_to[0], Label::Fold).point.value, 14.610_019_877_539_264, 1e-10);
    // From the broken symmetry on, orbits without it.
    let breaking = only_of(&found, touch.leads_to[0], Label::SymmetryBreaking);
    let broken = &found.branches[breaking.leads_to[0]];
    let point = &broken.points[broken.points.len().min(6) - 1];
    assert!(!point.orbit.signature.symmetric && point.orbit.speeds.len() == 2);
    assert!((point.orbit.speeds[0] - point.orbit.speeds[1]).abs() > 1e-4 * point.orbit.speeds[0]);
}

#[test]
fn periods_double_where_they_do_with_one_degree_of_freedom() {
    // Shaw & Holmes 1983 (doi:10.1016/0022-460X(83)90407-8), without damping, e = 0.8.
    let one = |omega: f64| {
        Scene::oscillator(1.0, 0.0, 1.0)
            .with_wall(Wall::upper("stop", 0.0).with_restitution(0.8))
            .with_load(Load::harmonic(1.0, omega / TAU, FRAC_PI_2))
    };
    let family = |omega: f64| Ok(beside(&one(omega), [1.0, 0.0, 1.0], omega / TAU));
    let start = settled(&family(2.6).unwrap().with_initial(&[-0.1, 0.0], &[0.0, 0.0]));
    let found = follow(&family, &start, 2.6, [2.4, 2.9], (Switch::Stable, 2));
    // Published to six digits.
    let doubling = only_of(&found, 0, Label::PeriodDoubling);
    near(doubling.point.value, 2.653_35, 2e-6);
    let problem = Problem::new(one(2.7)).unwrap();
    let form = closed_forms(problem.scene(), 1).unwrap().into_iter().find(|form| !form.symmetric).unwrap();
    let request = Request { range: [2.4, 2.9], switch: Switch::Stable, depth: 2, points: 3000 };
    let own = graph(&|omega| Ok(one(omega)), &form.orbit(&problem), 2.7, &request, &mut |_| ()).unwrap();
    // The same branches with the same doublings. Where a doubled branch begins it is known to half
    // of the digits only, but its own special points are located on it.
    assert_eq!(values(&found).len(), values(&own).len(), "{:?} {:?}", values(&found), values(&own));
    for (a, b) in found.specials.iter().zip(&own.specials) {
        assert_eq!((a.label, a.branch, a.leads_to.len()), (b.label, b.branch, b.leads_to.len()));
        near(a.point.value, b.point.value, 1e-9);
    }
    let doubled = &found.branches[doubling.leads_to[0]];
    let stable = doubled.points.iter().rfind(|point| point.floquet.is_stable()).unwrap();
    assert_eq!(stable.orbit.signature.periods, 2);
    let scene = family(stable.value).unwrap();
    let state = &stable.strobe.as_ref().unwrap().state;
    let (once, twice) = (after(&scene, stable, state, 1.0), after(&scene, stable, state, 2.0));
    assert!((once.q[0] - state.q[0]).abs() > 1e-3 && (twice.q[0] - state.q[0]).abs() < 1e-9);
}

#[test]
fn points_of_a_branch_are_orbits_of_the_coupled_structure() {
    let family = |f: f64| Ok(two_masses(f));
    let start = settled(&two_masses(1.9));
    assert_eq!(start.contacts, [1]);
    let found = follow(&family, &start, 1.9, [1.6, 2.4], (Switch::No, 0));
    let again = follow(&family, &start, 1.9, [1.6, 2.4], (Switch::No, 0));
    assert_eq!(format!("{:?}", found.branches), format!("{:?}", again.branches));
    let (mut attracting, mut repelling) = (0, 0);
    for point in found.branches.iter().flat_map(|branch| &branch.points).step_by(7) {
        let (scene, state) = (two_masses(point.value), point.strobe.as_ref().unwrap().state.clone());
        let turn = f64::from(point.orbit.signature.periods);
        let largest = point.floquet.multipliers[0];
        let largest = largest[0].hypot(largest[1]);
        let end = after(&scene, point, &state, turn);
        let miss = end.q.iter().zip(&state.q).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max);
        assert!(miss <= 1e-12 * (1.0 + largest) + 1e-13, "{}: {miss:e} {largest}", point.value);
        // The multipliers add up to the trace of the map's derivative, by differences of free runs.
        // Near a graze a difference sees other walls.
        let graze = point.admissible.nearest.map_or(1.0, |nearest| nearest.gap) < 1e-4;
        if largest < 10.0 && !graze && point.admissible.least_speed > 1e-2 {
            let mut trace = 0.0;
            for i in 0..4 {
                let (h, mut ends) = (1e-6, Vec::new());
                for sign in [1.0, -1.0] {
                    let mut other = state.clone();
                    *(if i < 2 { &mut other.q[i] } else { &mut other.v[i - 2] }) += sign * h;
                    let end = after(&scene, point, &other, turn);
                    ends.push(if i < 2 { end.q[i] } else { end.v[i - 2] });
                }
                trace += (ends[0] - ends[1]) / (2.0 * h);
            }
            assert!((trace - point.floquet.trace).abs() < 1e-5 * (1.0 + largest), "{trace} {:?}", point.floquet);
        }
        // Runs settle on stable orbits, from nearby.
        if largest < 0.9 {
            let beside = State { q: state.q.iter().map(|q| q + 1e-6).collect(), v: state.v.clone() };
            let end = after(&scene, point, &beside, 200.0 * turn);
            assert!((end.q[0] - state.q[0]).abs() < 1e-9, "{} {end:?} {state:?}", point.value);
            attracting += 1;
        } else if largest > 1.0 {
            repelling += 1;
        }
    }
    assert!(attracting > 3 && repelling > 0, "{attracting} {repelling}");
}

#[test]
fn a_pair_crosses_the_circle_where_the_closed_form_says() {
    let family = |frequency: f64| {
        let chain = signorini::Chain { masses: vec![1.0, 0.3], springs: vec![60.0], grounds: [80.0, 20.0] };
        let damping = signorini::Damping::Rayleigh { mass: 0.1, stiffness: 1e-3 };
        Ok(Scene::structure(chain.structure()?.with_damping(&damping)?)
            .with_wall(Wall::upper("stop", 5e-3).with_restitution(0.7))
            .with_load(Load::harmonic(2.0, frequency, 0.0)))
    };
    // |μ| − 1 of the largest multiplier of the orbit of one impact a period.
    let beyond = |frequency: f64| {
        let forms = closed_forms(&family(frequency).unwrap(), 1).unwrap();
        let form = forms.iter().find(|form| (form.speed - 0.345).abs() < 0.02).unwrap();
        form.multipliers[0][0].hypot(form.multipliers[0][1]) - 1.0
    };
    let crossing = |mut low: f64, mut high: f64| {
        assert!(beyond(low) * beyond(high) < 0.0);
        for _ in 0..60 {
            let middle = 0.5 * (low + high);
            *(if beyond(low) * beyond(middle) > 0.0 { &mut low } else { &mut high }) = middle;
        }
        low
    };
    let start = settled(&family(1.9).unwrap());
    assert_eq!((start.periods, start.contacts.as_slice()), (1, &[1][..]));
    let found = follow(&family, &start, 1.9, [1.6, 2.0], (Switch::All, 1));
    let pairs: Vec<&Special> =
        found.specials.iter().filter(|special| special.label == Label::NeimarkSacker && special.branch == 0).collect();
    let mut at: Vec<f64> = pairs.iter().map(|special| special.point.value).collect();
    at.sort_by(f64::total_cmp);
    assert_eq!(at.len(), 2, "{:?}", values(&found));
    near(at[0], crossing(1.66, 1.7), 1e-10);
    near(at[1], crossing(1.75, 1.82), 1e-10);
    assert!(pairs[0].reason.as_ref().unwrap().contains("not periodic"));
    // Between both the orbit is unstable.
    for point in found.branches[0].points.iter().filter(|point| point.value < 1.9) {
        assert_eq!(point.floquet.is_stable(), point.value < at[0] || point.value > at[1], "{}", point.value);
    }
}

#[test]
fn an_elastic_wall_is_entered_and_left() {
    let pad = |wall: Wall| Wall { law: WallLaw::Elastic { stiffness: 2e3, damping: 3.0 }, ..wall };
    let one = |amplitude: f64| {
        Scene::oscillator(1.0, 2.0, 100.0)
            .with_wall(pad(Wall::upper("pad", 5e-3)))
            .with_load(Load::harmonic(amplitude, 1.0, 0.0))
    };
    let family = |amplitude: f64| Ok(beside(&one(amplitude), [1.0, 2.0, 100.0], 1.0));
    let start = settled(&family(0.4).unwrap());
    assert_eq!(start.contacts, [1]);
    let found = follow(&family, &start, 0.4, [0.1, 0.5], (Switch::No, 0));
    // The motion without contact has the amplitude A/|k − mΩ² + icΩ|.
    let omega = TAU;
    let touching = 5e-3 * (100.0 - omega * omega).hypot(2.0 * omega);
    near(only_of(&found, 0, Label::GrazingOut).point.value, touching, 1e-10);
    let kinds: Vec<Kind> = found.branches[0].points[0].orbit.signature.events.iter().map(|event| event.kind).collect();
    assert_eq!(kinds, [Kind::Enter, Kind::Leave]);
    // And from the other side.
    let start = settled(&family(0.2).unwrap());
    let back = follow(&family, &start, 0.2, [0.1, 0.5], (Switch::No, 0));
    let touch = only_of(&back, 0, Label::GrazingIn);
    near(touch.point.value, touching, 1e-10);
    assert!(back.branches[touch.leads_to[0]].points.last().unwrap().value == 0.5);
}

#[test]
fn a_branch_ends_at_the_last_value_that_the_key_accepts() {
    let family = |e: f64| {
        let scene = source_beside(5.0, e);
        scene.validate().map(|()| scene)
    };
    let found = follow(&family, &settled(&source_beside(5.0, 0.8)), 0.8, [0.7, 1.0], (Switch::No, 0));
    let mut ends =
        [found.branches[0].points.first(), found.branches[0].points.last()].map(|point| point.unwrap().value);
    ends.sort_by(f64::total_cmp);
    assert_eq!((ends, &found.branches[0].ends), ([0.7, 1.0], &[Some(End::Range), Some(End::Range)]));
}

#[test]
fn what_cannot_be_followed_is_refused() {
    let family = |f: f64| Ok(two_masses(f));
    let start = settled(&two_masses(1.9));
    let request = |range: [f64; 2]| Request { range, switch: Switch::No, depth: 0, points: 50 };
    let refused = |range: [f64; 2], start: &Shot| graph(&family, start, 1.9, &request(range), &mut |_| ()).unwrap_err();
    let words = |error: Error, words: &str| assert!(error.is_request() && error.to_string().contains(words), "{error}");
    words(refused([2.0, 2.4], &start), "a value of the key from 2.0 to 2.4");
    let short = State { q: vec![0.0], v: vec![0.0] };
    words(refused([1.6, 2.4], &Shot { state: short, ..start.clone() }), "2 of each");
    words(refused([1.6, 2.4], &Shot { periods: 0, ..start.clone() }), "0 forcing periods");
    words(refused([1.6, 2.4], &Shot { time: f64::NAN, ..start.clone() }), "finite");
    let large = |_: f64| {
        let chain = signorini::Chain { masses: vec![1.0; 201], springs: vec![60.0; 200], grounds: [80.0, 20.0] };
        let scene = Scene::structure(chain.structure()?).with_wall(Wall::upper("stop", 5e-3));
        Ok(scene.with_load(Load::harmonic(2.0, 1.9, 0.0)))
    };
    words(graph(&large, &start, 1.9, &request([1.6, 2.4]), &mut |_| ()).unwrap_err(), "at most 200");
    // One frequency of two: there is no common period beside the start.
    let two = |f: f64| Ok(two_masses(f).with_load(Load::harmonic(0.1, 1.9, 0.0)));
    let failed = graph(&two, &settled(&two(1.9).unwrap()), 1.9, &request([1.6, 2.4]), &mut |_| ()).unwrap_err();
    assert!(failed.to_string().contains("common period"), "{failed}");
}

#[test]
fn a_rest_ends_where_it_does_with_one_degree_of_freedom() {
    let family = |f: f64| Ok(source_beside(f, 0.0));
    let start = settled(&source_beside(1.0, 0.0));
    assert!(start.orbit.signature.rests());
    let found = follow(&family, &start, 1.0, [0.5, 6.0], (Switch::No, 0));
    let problem = Problem::new(source(1.0, 0.0)).unwrap();
    let request = Request { range: [0.5, 6.0], switch: Switch::All, depth: 1, points: 3000 };
    let start = problem.settled(200).unwrap();
    let own = graph(&|f| Ok(source(f, 0.0)), &start, 1.0, &request, &mut |_| ()).unwrap();
    let end = only_of(&found, 0, Label::RestEnds);
    near(end.point.value, only_of(&own, 0, Label::RestEnds).point.value, 1e-10);
    // Beyond, impacts with e = 0, their fold, and the graze at which they vanish.
    let beyond = end.leads_to[0];
    assert_eq!(found.branches[beyond].points[0].orbit.signature.events.len(), 1);
    near(only_of(&found, beyond, Label::Fold).point.value, only_of(&own, 1, Label::Fold).point.value, 1e-10);
    near(only_of(&found, beyond, Label::GrazingOut).point.value, 4.210_773_813_134_604, 1e-10);
}

#[test]
fn impacts_that_accumulate_are_one_event_of_a_branch() {
    let family = |f: f64| Ok(source_beside(f, 0.5));
    let start = settled(&source_beside(1.0, 0.5));
    assert!(start.orbit.signature.chatters());
    let found = follow(&family, &start, 1.0, [0.8, 1.3], (Switch::No, 0));
    assert_eq!(found.branches[0].ends, [Some(End::Range), Some(End::Range)], "{:?}", values(&found));
    for point in found.branches[0].points.iter().step_by(8) {
        // Released from rest the body goes the same way as alone.
        let own = Problem::new(source(point.value, 0.5)).unwrap().settled(50).unwrap();
        let speed = |speeds: &[f64]| speeds.iter().fold(0.0_f64, |most, v| most.max(*v));
        near(speed(&point.orbit.speeds), speed(&own.speeds), 1e-8);
        // Two of four multipliers are those of the other body: all else is forgotten.
        let half = point.floquet.half.as_ref().unwrap();
        assert!(half[2][0].hypot(half[2][1]) < 1e-8, "{half:?}");
    }
}

#[test]
fn orbits_that_repeat_after_a_graze_go_on_as_the_shorter_ones() {
    let family = |frequency: f64| {
        let chain = signorini::Chain { masses: vec![1.0, 0.5], springs: vec![50.0], grounds: [100.0, 0.0] };
        let damping = signorini::Damping::Rayleigh { mass: 0.4, stiffness: 0.0 };
        Ok(Scene::structure(chain.structure().unwrap().with_damping(&damping).unwrap())
            .with_wall(Wall::upper("stop", 3e-3).with_restitution(0.7).at(Row::new(vec![(1, 1.0)])))
            .with_load(Load::harmonic(2.0, frequency, 0.0)))
    };
    let range = [1.57, 1.85];
    let request = Request { range, switch: Switch::Stable, depth: 4, points: 300 };
    let start = shoot(&family(1.75).unwrap(), 400, &|_| ()).unwrap();
    let graph = graph(&family, &start, 1.75, &request, &mut |_| ()).unwrap();
    // Over four periods with five impacts, of which one grazes where the orbits over two periods
    // graze as well. Near there they are so unstable that rounding decides whether the branch is
    // followed to its end.
    let graze = 1.578_709_816;
    let meets = |special: &&Special| (special.point.value - graze).abs() < 1e-8;
    let periods = |special: &Special| graph.branches[special.branch].points[0].orbit.signature.periods;
    let of = |wanted: u32| -> Vec<&Special> {
        graph.specials.iter().filter(meets).filter(|special| periods(special) == wanted).collect()
    };
    let short = of(2);
    assert!(!short.is_empty(), "{:?}", values(&graph));
    for long in of(4) {
        assert!(short.iter().any(|special| long.leads_to == [special.branch]), "{:?} {:?}", long.leads_to, long.reason);
    }
    // No branch is one of half its period, run over twice.
    for branch in &graph.branches {
        let orbit = &branch.points[branch.points.len() / 2].orbit;
        let (half, periods) = (orbit.phases.len() / 2, f64::from(orbit.signature.periods));
        let repeats = (0..half).all(|i| {
            (orbit.phases[i + half] - orbit.phases[i] - 0.5 * periods).abs() < 1e-5
                && (orbit.speeds[i + half] - orbit.speeds[i]).abs() < 1e-5
        });
        assert!(orbit.phases.len() % 2 == 1 || orbit.signature.periods % 2 == 1 || !repeats, "{orbit:?}");
    }
}

#[test]
fn orbits_in_closed_form_that_pass_a_wall_are_told() {
    // Of these orbits those of two periods swing to 2.6 m, one of six to 1.0035 m, beyond the wall
    // at 1 m (their motion as a sum of two modes, by another program).
    let chain = signorini::Chain { masses: vec![1.0, 1.0], springs: vec![1.0], grounds: [1.0, 0.0] };
    let stop = Wall {
        face: Face::Flat { side: Side::Upper, position: 1.0, at: Row::dof(1), direction: None },
        ..Wall::upper("stop", 1.0)
    };
    let scene = Scene::structure(chain.structure().unwrap())
        .with_wall(stop)
        .with_load(Load { at: Row::dof(0), ..Load::harmonic(1e-3, 0.12, 0.0) });
    let forms = closed_forms(&scene, 8).unwrap();
    let told: Vec<(u32, Option<bool>)> = forms.iter().map(|form| (form.periods, form.admissible)).collect();
    let expected = [(1, true), (1, true), (2, false), (2, false), (6, false), (6, true)];
    assert_eq!(told, expected.map(|(periods, holds)| (periods, Some(holds))));
    // Of one degree of freedom the extremes of the motion are known.
    let (mut holds, mut passes) = (0, 0);
    for k in 0..40 {
        let frequency = 0.2 + 0.11 * f64::from(k);
        let scene = Scene::oscillator(1.0, 0.1, 100.0)
            .with_wall(Wall::upper("upper", 4e-3).with_restitution(0.8))
            .with_wall(Wall::lower("lower", -4e-3).with_restitution(0.8))
            .with_load(Load::harmonic(3.0, frequency, 0.0));
        let problem = Problem::new(scene).unwrap();
        for form in closed_forms(problem.scene(), 6).unwrap() {
            let exact = problem.admissible(&form.orbit(&problem)).unwrap().holds();
            assert_eq!(form.admissible, Some(exact), "{frequency} Hz: {form:?}");
            *(if exact { &mut holds } else { &mut passes }) += 1;
        }
    }
    assert!(holds > 20 && passes > 20, "{holds} {passes}");
}
