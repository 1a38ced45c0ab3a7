//! Periodic orbits against closed forms evaluated with sixty digits, and against the free run.

use crate::source::{ball, near, source};
use signorini::linear::Symmetric;
use signorini::orbit::{ClosedForm, Event, Kind, Orbit, Problem, Signature, closed_forms, shoot};
use signorini::{Error, FrictionCoefficients, Load, Row, Scene, Scheme, Slider, State, Stepper, Structure, Wall};
use std::f64::consts::{FRAC_PI_2, TAU};

/// Dankowicz & Schilder 2013, example 15.2 (doi:10.1137/1.9781611972573), under A cos t.
fn coco(amplitude: f64) -> Scene {
    Scene::oscillator(1.0, 0.1, 1.0)
        .with_wall(Wall::upper("stop", 1.0).with_restitution(0.8))
        .with_load(Load::harmonic(amplitude, 1.0 / TAU, FRAC_PI_2))
}

fn of_speed(scene: &Scene, speed: f64) -> ClosedForm {
    let found = closed_forms(scene, 1).unwrap();
    found.into_iter().find(|orbit| (orbit.speed / speed - 1.0).abs() < 1e-6).expect("an orbit of that speed")
}

#[test]
fn a_settled_run_leads_to_the_symmetric_orbit() {
    let problem = Problem::new(source(5.0, 0.8)).unwrap();
    let orbit = problem.settled(200).unwrap();
    assert!(orbit.signature.symmetric && orbit.signature.periods == 1 && orbit.phases.len() == 1);
    near(orbit.speeds[0], 0.169_410_591_358_373_47, 1e-12);
    let upper = orbit.signature.events[0].wall == 0;
    let phase = (orbit.phases[0] + if upper { 0.0 } else { 0.5 }).rem_euclid(1.0);
    near(TAU * phase, 1.741_232_823_663_744_7, 1e-12);
    let floquet = problem.floquet(&orbit).unwrap();
    near(floquet.trace, -1.318_546_497_591_139, 1e-11);
    near(floquet.determinant, 0.627_327_150_916_323_4, 1e-13);
    let half = floquet.half.as_ref().unwrap()[0];
    near(half[0], -0.659_273_248_795_569_5, 1e-11);
    near(half[1], 0.438_960_060_072_506_4, 1e-11);
    near(floquet.multipliers[0][0], 0.241_955_282_238_606_5, 1e-10);
    assert!(floquet.is_stable() && problem.admissible(&orbit).unwrap().holds());
    let judged = problem.judge(&orbit, 100).unwrap();
    assert!(judged.holds(), "{} {}", judged.closure, judged.same_events);
    // Momentum: m (1 + e) v at each wall, the upper one pushes down.
    for (wall, sign) in [(0, -1.0), (1, 1.0)] {
        near(judged.walls[wall].impulse, sign * 1.8 * orbit.speeds[0], 1e-9);
        assert_eq!(judged.walls[wall].contacts, 1);
    }
}

#[test]
fn an_orbit_does_not_depend_on_how_far_from_its_wall_a_run_began() {
    // At a wall where the spring rests, and on a table without a spring, no gap is that of the
    // scene: the distance of the start is none either.
    let pressed = Scene::oscillator(1.0, 0.02, 1.0)
        .with_wall(Wall::upper("stop", 0.0).with_restitution(0.8))
        .with_load(Load::harmonic(1.0, 0.4, 0.0));
    let found = |start: f64| {
        let problem = Problem::new(pressed.clone().with_initial(&[start], &[0.0])).unwrap();
        let orbit = problem.settled(600).unwrap();
        let judged = problem.judge(&orbit, 100).unwrap();
        assert!(judged.holds(), "{start}: {}", judged.closure);
        orbit
    };
    let first = found(-0.5);
    for start in [-1e2, -1e-3, -1e-6, -1e-9] {
        let orbit = found(start);
        assert_eq!(orbit.signature, first.signature, "{start}");
        // Two Newton solutions of one orbit, whose largest multiplier is 0.78.
        near(orbit.speeds[0], first.speeds[0], 1e-11);
    }
}

#[test]
fn multipliers_of_a_symmetric_orbit_have_the_order_of_any_other() {
    let problem = Problem::new(source(5.0, 0.8)).unwrap();
    let floquet = problem.floquet(&problem.settled(200).unwrap()).unwrap();
    let [first, second] = floquet.multipliers[..] else { panic!("{floquet:?}") };
    assert!(first[1] > 0.0 && second[1] == -first[1] && second[0] == first[0], "{floquet:?}");
}

#[test]
fn an_orbit_without_losses_is_not_stable_by_rounding() {
    // e = 1 and no dashpot: multipliers on the unit circle, which rounding moves to either side.
    let family = |f: f64| {
        Scene::oscillator(1.0, 0.0, 1.0)
            .with_wall(Wall::upper("stop", 0.0).with_restitution(1.0))
            .with_load(Load::harmonic(1.0, f, 0.0))
    };
    let mut neutral = 0;
    for f in [0.36, 0.37, 0.38, 0.39, 0.4, 0.41] {
        for form in closed_forms(&family(f), 1).unwrap() {
            let largest = form.multipliers.iter().map(|[re, im]| re.hypot(*im)).fold(0.0, f64::max);
            neutral += usize::from((largest - 1.0).abs() < 1e-10);
            assert!(!form.is_stable(), "{f} Hz: {form:?}");
        }
    }
    assert!(neutral >= 6, "{neutral}");
}

/// Under 4 Hz between no second wall: an orbit of two impacts in three forcing periods.
fn one_sided() -> Scene {
    Scene::oscillator(1.0, 0.2, 100.0)
        .with_wall(Wall::upper("stop", 5e-3).with_restitution(0.8))
        .with_load(Load::harmonic(3.0, 4.0, 0.0))
}

#[test]
fn an_orbit_is_the_shortest_that_the_motion_repeats() {
    let problem = Problem::new(one_sided()).unwrap();
    // After 200 periods the motion still alternates about the orbit by more than what counts as
    // repeated, and repeats itself after twice the period of the orbit only.
    let orbits = [200, 400, 800].map(|settle| problem.settled(settle).unwrap());
    for orbit in &orbits {
        assert_eq!((orbit.signature.periods, orbit.signature.written(problem.scene()).as_str()), (3, "SS"));
        assert_eq!((orbit.phases.len(), orbit.speeds.len()), (2, 2));
        // The free run comes back after this period, and after no shorter one: its two impacts
        // differ.
        assert!(problem.judge(orbit, 10).unwrap().holds());
        let fast = orbit.speeds.iter().copied().fold(0.0, f64::max);
        assert!((orbit.speeds[0] - orbit.speeds[1]).abs() > 0.1 * fast);
        near(fast, orbits[1].speeds.iter().copied().fold(0.0, f64::max), 1e-9);
    }
    // The same orbit by shooting, of a body beside which another one moves.
    let mut both = Scene::structure(Structure {
        mass: Symmetric::diagonal(&[1.0, 1.0]),
        damping: Symmetric::diagonal(&[0.2, 2.0]),
        stiffness: Symmetric::diagonal(&[100.0, 300.0]),
    });
    (both.walls, both.loads) = (one_sided().walls, one_sided().loads);
    let shot = shoot(&both, 200, &|_| ()).unwrap();
    assert_eq!((shot.periods, shot.orbit.phases.len(), shot.contacts.as_slice()), (3, 2, [2].as_slice()));
    let fast = |speeds: &[f64]| speeds.iter().copied().fold(0.0, f64::max);
    near(fast(&shot.orbit.speeds), fast(&orbits[1].speeds), 1e-8);
}

#[test]
fn a_start_that_repeats_an_orbit_is_that_orbit() {
    let problem = Problem::new(source(5.0, 0.8)).unwrap();
    let half = problem.settled(400).unwrap();
    assert!(half.signature.symmetric && half.signature.periods == 1);
    // The whole orbit six times over, and the half three times, each every second time mirrored.
    let [first, other] = [half.signature.events[0].wall, 1 - half.signature.events[0].wall];
    let repeated = |count: u32, turn: f64| Orbit {
        signature: Signature {
            symmetric: count % 2 == 1,
            ..Signature::impacts(&[first, other].repeat(6)[..count as usize], (f64::from(count) * turn).round() as u32)
        },
        phases: (0..count).map(|k| half.phases[0] + 0.5 * f64::from(k)).collect(),
        speeds: vec![half.speeds[0]; count as usize],
        forcing_period: half.forcing_period,
    };
    let whole = problem.correct(&repeated(12, 0.5)).unwrap();
    assert_eq!((whole.signature.periods, whole.phases.len(), whole.signature.symmetric), (1, 2, false));
    near(whole.speeds[0], half.speeds[0], 1e-12);
    let mirrored = problem.correct(&repeated(3, 1.0)).unwrap();
    assert_eq!((mirrored.signature.periods, mirrored.phases.len(), mirrored.signature.symmetric), (1, 1, true));
    near(mirrored.speeds[0], half.speeds[0], 1e-12);
}

#[test]
fn closed_forms_list_the_unstable_twin() {
    let scene = source(5.0, 0.8);
    let problem = Problem::new(scene.clone()).unwrap();
    let twin = of_speed(&scene, 0.032_944_907_242_849_2);
    assert!(twin.symmetric && !twin.is_stable());
    near(twin.speed, 0.032_944_907_242_849_2, 1e-12);
    near(twin.multipliers[0][0], 280.168_518_443_668_34, 1e-10);
    // Newton stays where the closed form is.
    let orbit = problem.correct(&twin.orbit(&problem)).unwrap();
    near(orbit.speeds[0], twin.speed, 1e-12);
    let half = problem.floquet(&orbit).unwrap().half.unwrap();
    near(half[0][0], 16.738_235_224_887_61, 1e-11);
    near(half[1][0], 0.037_478_691_301_259_43, 1e-11);
    assert!(problem.admissible(&orbit).unwrap().holds());
    assert!(problem.judge(&orbit, 10).unwrap().holds());
}

#[test]
fn the_impact_oscillator_of_the_continuation_book() {
    for (amplitude, speed, trace) in [
        (1.0, 1.695_732_937_594_882, -1.168_590_628_683_059),
        (0.2, 0.298_612_852_056_333_86, -1.140_047_386_516_420_5),
    ] {
        let problem = Problem::new(coco(amplitude)).unwrap();
        // The start of the book's demo: −1.36 after the impact, at the phase 0.076.
        let guess = Orbit {
            signature: Signature::impacts(&[0], 1),
            phases: vec![0.076 / TAU],
            speeds: vec![1.7 * amplitude],
            forcing_period: problem.forcing_period(),
        };
        let orbit = problem.correct(&guess).unwrap();
        near(orbit.speeds[0], speed, 1e-11);
        let floquet = problem.floquet(&orbit).unwrap();
        near(floquet.trace, trace, 1e-11);
        near(floquet.determinant, 0.341_432_378_298_306_1, 1e-12);
        let listed = of_speed(problem.scene(), speed);
        near(listed.phase, orbit.phases[0], 1e-11);
        if amplitude == 1.0 {
            near(TAU * orbit.phases[0], 0.075_952_164_938_312_39, 1e-10);
        }
    }
}

#[test]
fn the_ball_on_the_table() {
    let problem = Problem::new(ball(1.1)).unwrap();
    // Γ cos φ = π (1 − e)/(1 + e) on the branch with sin φ > 0.
    let phase = (std::f64::consts::PI * 0.3 / 1.7 / 1.1).acos() / TAU;
    for start in [phase, phase + 0.02] {
        let guess = Orbit {
            signature: Signature::impacts(&[0], 1),
            phases: vec![start],
            speeds: vec![0.6],
            forcing_period: problem.forcing_period(),
        };
        let orbit = problem.correct(&guess).unwrap();
        near(orbit.speeds[0], 0.577_058_823_529_411_8, 1e-11);
        let floquet = problem.floquet(&orbit).unwrap();
        near(floquet.trace, -1.255_716_098_812_231_1, 1e-11);
        near(floquet.determinant, 0.49, 1e-12);
        assert!(problem.judge(&orbit, 10).unwrap().holds());
    }
    // Pressed on its stop with 1 N, which 0.5 N cannot lift: no flight, whatever the free motion
    // does.
    let pressed = Scene::oscillator(1.0, 0.5, 100.0)
        .with_wall(Wall::upper("stop", 0.0).with_restitution(0.3))
        .with_load(Load::constant(1.0))
        .with_load(Load::harmonic(0.5, 2.0, 0.0))
        .with_duration(5.0);
    let none = Problem::new(pressed).unwrap().settled(20).unwrap_err();
    assert!(!none.is_request() && none.to_string().contains("never leaves the wall \"stop\""), "{none}");
    // Its steady motion without the table is not determined.
    assert!(closed_forms(problem.scene(), 1).unwrap_err().to_string().contains("springs hold"));
    let slider = Slider {
        name: "pad".to_owned(),
        at: Row::dof(0),
        normal_force: 10.0,
        friction: FrictionCoefficients::from(0.2),
    };
    let refused = closed_forms(&source(5.0, 0.8).with_slider(&slider).unwrap(), 1).unwrap_err();
    assert!(refused.is_request() && refused.to_string().contains("friction at the slider \"pad\""), "{refused}");
}

#[test]
fn an_orbit_that_rests_on_both_walls() {
    let problem = Problem::new(source(1.0, 0.0)).unwrap();
    let orbit = problem.settled(3).unwrap();
    assert!(orbit.signature.symmetric && orbit.signature.rests());
    let [release, arrival] = [orbit.phases[0], orbit.phases[1]];
    assert_eq!(orbit.signature.events[0].kind, Kind::Release);
    assert_eq!(orbit.signature.events[1].kind, Kind::Rest);
    let upper = orbit.signature.events[0].wall == 0;
    near(TAU * (release + if upper { 0.0 } else { 0.5 }).rem_euclid(1.0), 2.974_144_574_370_104, 1e-12);
    near(arrival - release, 0.154_599_125_818_999_76, 1e-12);
    near(orbit.speeds[1], 0.174_133_447_977_690_1, 1e-12);
    let floquet = problem.floquet(&orbit).unwrap();
    assert_eq!(floquet.multipliers, [[0.0; 2]; 2]);
    let judged = problem.judge(&orbit, 2000).unwrap();
    assert!(judged.holds(), "{judged:?}");
    // F − k g = 2.5 N, at an instant of the 2000: (2π/2000)²/8 of it at most below.
    near(judged.walls[0].peak_force, 2.5, 1e-5);
    assert!(problem.admissible(&orbit).unwrap().holds());
}

#[test]
fn an_orbit_in_which_impacts_accumulate_is_run_from_its_release() {
    let problem = Problem::new(source(1.0, 0.5)).unwrap();
    let orbit = problem.settled(5).unwrap();
    assert!(orbit.signature.chatters(), "{:?}", orbit.signature);
    let judged = problem.judge(&orbit, 50).unwrap();
    assert!(judged.holds(), "{} {}", judged.closure, judged.same_events);
    assert_eq!(problem.floquet(&orbit).unwrap().multipliers, [[0.0; 2]; 2]);
    let refused = problem.correct(&orbit).unwrap_err();
    assert!(matches!(refused, Error::NoOrbit { .. }) && refused.to_string().contains("accumulate"));
}

#[test]
fn a_quiet_motion_is_an_orbit_without_events() {
    let problem = Problem::new(source(9.0, 0.5).with_initial(&[-1e-3], &[0.0])).unwrap();
    let orbit = problem.settled(400).unwrap();
    assert!(orbit.phases.is_empty());
    let floquet = problem.floquet(&orbit).unwrap();
    // Over a half period: e^{−cT/4m} in size.
    near(floquet.determinant, (-0.2 / 18.0_f64).exp(), 1e-13);
    assert!(problem.judge(&orbit, 10).unwrap().holds());
    let nearest = problem.admissible(&orbit).unwrap().nearest.unwrap();
    let omega = TAU * 9.0;
    let amplitude = 3.0 / ((100.0 - omega * omega).powi(2) + (0.2 * omega).powi(2)).sqrt();
    near(nearest.gap, 5e-3 - amplitude, 1e-12);
}

#[test]
fn elastic_walls_and_dashpots() {
    for damping in [0.0, 20.0] {
        let scene = Scene::oscillator(1.0, 0.2, 100.0)
            .with_wall(Wall::upper("upper", 5e-3).with_elasticity(1e5, damping))
            .with_wall(Wall::lower("lower", -4e-3).with_restitution(0.6))
            .with_load(Load::harmonic(3.0, 4.0, 0.3));
        let problem = Problem::new(scene).unwrap();
        let orbit = problem.settled(300).unwrap();
        let kinds: Vec<Kind> = orbit.signature.events.iter().map(|event| event.kind).collect();
        assert!(kinds.contains(&Kind::Enter) && kinds.contains(&Kind::Leave), "{kinds:?}");
        let judged = problem.judge(&orbit, 100).unwrap();
        assert!(judged.holds(), "{damping}: {} {}", judged.closure, judged.same_events);
        against_differences(&problem, &orbit);
    }
}

#[test]
fn shooting_finds_the_orbit_of_one_degree_of_freedom() {
    let shot = shoot(&source(5.0, 0.8), 200, &|_| ()).unwrap();
    assert_eq!((shot.periods, shot.contacts.as_slice()), (1, &[1, 1][..]));
    near(shot.multipliers[0][0], 0.241_955_282_238_606_5, 1e-9);
    near(shot.impulses[1], 1.8 * 0.169_410_591_358_373_47, 1e-9);
}

#[test]
fn shooting_and_closed_forms_agree_for_two_masses() {
    let chain = signorini::Chain { masses: vec![1.0, 0.5], springs: vec![60.0], grounds: [80.0, 20.0] };
    let damping = signorini::Damping::Rayleigh { mass: 0.3, stiffness: 2e-3 };
    let scene = Scene::structure(chain.structure().unwrap().with_damping(&damping).unwrap())
        .with_wall(Wall::upper("stop", 5e-3).with_restitution(0.6))
        .with_load(Load::harmonic(2.0, 1.9, 0.0));
    let shot = shoot(&scene, 400, &|_| ()).unwrap();
    assert!(shot.is_stable() && shot.contacts == [1], "{shot:?}");
    let forms = closed_forms(&scene, shot.periods).unwrap();
    let mass = scene.wall_masses()[0];
    let speed = -shot.impulses[0] / (1.6 * mass);
    let form = forms.iter().find(|form| (form.speed / speed - 1.0).abs() < 1e-8).expect("the same speed");
    for (a, b) in form.multipliers.iter().zip(&shot.multipliers) {
        assert!((a[0] - b[0]).abs() < 1e-8 && (a[1].abs() - b[1].abs()).abs() < 1e-8, "{form:?} {shot:?}");
    }
}

/// The state one orbit after `start` (s), by the free exact run.
fn one_turn(problem: &Problem, orbit: &Orbit, start: f64, state: [f64; 2]) -> [f64; 2] {
    let end = start + orbit.period();
    let mut scene = problem.scene().clone();
    scene.duration = end;
    let mut stepper = Stepper::new(&scene, &Scheme::Event, end).unwrap();
    stepper.set_state(start, &State { q: vec![state[0]], v: vec![state[1]] }).unwrap();
    while stepper.time() < end {
        stepper.step().unwrap();
    }
    let state = stepper.state();
    [state.q[0], state.v[0]]
}

/// Trace and determinant of the derivative of the free run over one orbit.
fn against_differences(problem: &Problem, orbit: &Orbit) {
    let judged = problem.judge(orbit, 1).unwrap();
    let first = &judged.motion[0];
    let base = [first.displacement, first.velocity];
    let column = |k: usize| {
        let h = [1e-9, 1e-8][k];
        let mut ends = [1.0, -1.0].map(|sign: f64| {
            let mut state = base;
            state[k] += sign * h;
            one_turn(problem, orbit, first.time, state)
        });
        let [up, down] = &mut ends;
        [(up[0] - down[0]) / (2.0 * h), (up[1] - down[1]) / (2.0 * h)]
    };
    let (a, b) = (column(0), column(1));
    let floquet = problem.floquet(orbit).unwrap();
    let m = floquet.multipliers;
    let (trace, product) = (m[0][0] + m[1][0], m[0][0] * m[1][0] - m[0][1] * m[1][1]);
    // Central differences with steps of 1e-6 of the state: 1e-5 of the larger entries remain.
    let size = a.iter().chain(&b).fold(1.0_f64, |top, x| top.max(x.abs()));
    assert!((a[0] + b[1] - trace).abs() < 1e-4 * size, "{} {trace}", a[0] + b[1]);
    assert!((a[0] * b[1] - a[1] * b[0] - product).abs() < 1e-4 * size, "{product}");
}

#[test]
fn multipliers_are_those_of_differences_of_the_free_run() {
    for (frequency, restitution) in [(5.0, 0.8), (4.4, 0.8), (3.7, 0.5), (6.0, 0.9)] {
        let problem = Problem::new(source(frequency, restitution)).unwrap();
        let Ok(orbit) = problem.settled(600) else { continue };
        if !orbit.signature.rests() {
            against_differences(&problem, &orbit);
        }
    }
    let problem = Problem::new(source(5.0, 0.8)).unwrap();
    against_differences(&problem, &of_speed(problem.scene(), 0.032_944_907_242_849_2).orbit(&problem));
}

/// A generator of numbers in [−1, 1) that needs no crate.
struct Numbers(u64);

impl Numbers {
    fn next(&mut self) -> f64 {
        self.0 = self.0.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        (self.0 >> 11) as f64 / (1u64 << 52) as f64 - 1.0
    }
}

#[test]
fn newton_reaches_orbits_with_large_multipliers_from_three_per_cent_away() {
    let mut numbers = Numbers(7);
    // The unstable symmetric orbit towards the grazing frequency.
    for (frequency, least) in [(5.0, 2e2), (4.22, 1e5), (4.2109, 1e8)] {
        let problem = Problem::new(source(frequency, 0.8)).unwrap();
        let twin = closed_forms(problem.scene(), 1)
            .unwrap()
            .into_iter()
            .filter(|orbit| orbit.symmetric)
            .max_by(|a, b| a.multipliers[0][0].total_cmp(&b.multipliers[0][0]))
            .unwrap();
        assert!(twin.multipliers[0][0] > least, "{}", twin.multipliers[0][0]);
        let orbit = problem.correct(&twin.orbit(&problem)).unwrap();
        let reached = (0..200)
            .filter(|_| {
                let mut start = orbit.clone();
                start.phases[0] *= 1.0 + 0.03 * numbers.next();
                start.speeds[0] *= 1.0 + 0.03 * numbers.next();
                problem.correct(&start).is_ok_and(|found| {
                    (found.phases[0] - orbit.phases[0]).abs() < 1e-8
                        && (found.speeds[0] / orbit.speeds[0] - 1.0).abs() < 1e-6
                })
            })
            .count();
        assert!(reached >= 199, "{frequency} Hz: {reached}");
    }
}

/// Two frequencies without a common divisor near them: an orbit of 10 s with 70 impacts, whose
/// multipliers are far below 1 and which lets roundings grow a thousandfold on the way. Its free
/// run misses its start by 6e-9 of the gap; a change of its start by 1e-5 is more than that.
#[test]
fn a_long_orbit_closes_to_what_its_impacts_make_of_rounding() {
    let scene = Scene::oscillator(1.0, 0.2, 100.0)
        .with_wall(Wall::upper("upper", 5e-3).with_restitution(0.8))
        .with_wall(Wall::lower("lower", -5e-3).with_restitution(0.8))
        .with_load(Load::harmonic(0.5, 2.5, 0.0))
        .with_load(Load::harmonic(2.0, 3.1, 0.0));
    let problem = Problem::new(scene).unwrap();
    let orbit = problem.settled(100).unwrap();
    assert!((orbit.period() - 10.0).abs() < 1e-9 && orbit.phases.len() == 70, "{orbit:?}");
    let judged = problem.judge(&orbit, 10).unwrap();
    assert!(judged.holds(), "{:e} of {:e}", judged.closure, judged.tolerance);
    let mut changed = orbit.clone();
    for speed in &mut changed.speeds {
        *speed *= 1.0 + 1e-5;
    }
    let judged = problem.judge(&changed, 10).unwrap();
    assert!(!judged.holds(), "{:e} of {:e}", judged.closure, judged.tolerance);
}

#[test]
fn force_and_gap_scale_alike_and_mirrors_have_mirrored_orbits() {
    let orbit = |scene: Scene| {
        let problem = Problem::new(scene).unwrap();
        problem.settled(400).unwrap()
    };
    let walls = |scale: f64, gaps: [f64; 2]| {
        Scene::oscillator(1.0, 0.2, 100.0)
            .with_wall(Wall::upper("upper", scale * gaps[0]).with_restitution(0.7))
            .with_wall(Wall::lower("lower", -scale * gaps[1]).with_restitution(0.7))
    };
    let plain = orbit(walls(1.0, [5e-3, 4e-3]).with_load(Load::harmonic(3.0, 5.0, 0.2)));
    let twice = orbit(walls(2.0, [5e-3, 4e-3]).with_load(Load::harmonic(6.0, 5.0, 0.2)));
    let mirror = orbit(walls(1.0, [4e-3, 5e-3]).with_load(Load::harmonic(-3.0, 5.0, 0.2)));
    assert!(!plain.signature.events.is_empty() && plain.signature.events == twice.signature.events);
    for i in 0..plain.phases.len() {
        near(twice.speeds[i], 2.0 * plain.speeds[i], 1e-9);
        near(twice.phases[i], plain.phases[i], 1e-9);
        near(mirror.speeds[i], plain.speeds[i], 1e-9);
        let opposite = Event { wall: 1 - plain.signature.events[i].wall, ..plain.signature.events[i] };
        assert_eq!(mirror.signature.events[i], opposite);
    }
}

#[test]
fn signatures_are_written_and_read() {
    let (scene, plastic) = (source(5.0, 0.8), source(5.0, 0.0));
    for (scene, text, written) in [
        (&scene, "UL", "UL"),
        (&scene, "upper,lower", "UL"),
        (&scene, "ulu", "ULU"),
        (&scene, "upper:chatter upper:release", "upper:chatter upper:release"),
        (&plastic, "upper:rest upper:release", "upper:rest upper:release"),
    ] {
        let signature = Signature::parse(text, 1, scene).unwrap();
        assert_eq!(signature.written(scene), written);
        assert_eq!(Signature::parse(&signature.written(scene), 1, scene).unwrap(), signature);
    }
    for (text, periods, words) in [
        ("UX", 1, "no wall is named \"UX\""),
        ("upper:stop", 1, "no kind of event is named \"stop\""),
        ("upper:enter", 1, "is enter at wall \"upper\", which is rigid"),
        ("upper:chatter", 1, "without its release"),
        ("upper:rest upper:release", 1, "rest at wall \"upper\", whose restitution is 0.8"),
        ("UL", 0, "1 to 64"),
        ("UL", 65, "1 to 64"),
    ] {
        let refused = Signature::parse(text, periods, &scene).unwrap_err();
        assert!(refused.is_request() && refused.to_string().contains(words), "{text}: {refused}");
    }
}

#[test]
fn what_has_no_orbit_is_refused_with_the_reason() {
    let two = Scene::oscillator(1.0, 0.2, 100.0).with_load(Load::harmonic(3.0, 5.0, 0.0));
    let blown = source(5.0, 0.8).with_load(Load::impulse(1.0, 0.5));
    let apart = source(5.0, 0.8).with_load(Load::harmonic(1.0, 2.0_f64.sqrt(), 0.0));
    let chain = signorini::Chain { masses: vec![1.0; 2], springs: vec![50.0], grounds: [100.0; 2] };
    let structure = Scene::structure(chain.structure().unwrap())
        .with_wall(Wall::upper("u", 1e-3))
        .with_load(Load::harmonic(3.0, 5.0, 0.0));
    for (scene, words) in [
        (two, "without one all motions settle"),
        (blown, "load 2 does not repeat"),
        (apart, "Hz have none"),
        (structure, "system is a structure; expected an oscillator"),
    ] {
        let refused = Problem::new(scene).unwrap_err();
        assert!(refused.is_request() && refused.to_string().contains(words), "{refused}");
    }
    let problem = Problem::new(source(5.0, 0.8)).unwrap();
    let start = |phases: Vec<f64>, speeds: Vec<f64>| Orbit {
        signature: Signature::impacts(&[0, 1], 1),
        phases,
        speeds,
        forcing_period: 0.2,
    };
    for (orbit, request, words) in [
        (start(vec![0.1], vec![0.1]), true, "1 phases and 1 speeds"),
        (start(vec![0.1, f64::NAN], vec![0.1, 0.1]), true, "finite numbers"),
        (start(vec![0.9, 0.1], vec![0.1, 0.1]), false, "no periodic orbit"),
    ] {
        let refused = problem.correct(&orbit).unwrap_err();
        assert!(refused.is_request() == request && refused.to_string().contains(words), "{refused}");
    }
}

#[test]
fn a_flight_after_which_free_motion_repeats_itself_has_no_orbit_in_closed_form() {
    // Without damping, at twice the natural frequency: over two periods of the load the free motion
    // comes back to where it was, so that no impact of speed v > 0, which takes (1 + e) v away, can
    // be part of an orbit of two periods, or of four.
    let scene = Scene::oscillator(1.0, 0.0, 100.0)
        .with_wall(Wall::upper("stop", 5e-3).with_restitution(0.5))
        .with_load(Load::harmonic(3.0, 20.0 / TAU, 0.0));
    let found = closed_forms(&scene, 4).unwrap();
    let periods: Vec<u32> = found.iter().map(|one| one.periods).collect();
    assert!(!found.is_empty() && periods.iter().all(|n| n % 2 == 1), "{found:?}");
}

#[test]
fn the_largest_force_of_a_short_contact_is_not_missed_between_the_instants_of_the_motion() {
    // A stop of 1e9 N/m without a dashpot pushes for 0.1 ms of a period of 0.4 s.
    let scene = Scene::oscillator(1.0, 4.0, 100.0)
        .with_wall(Wall::upper("pad", 5e-3).with_elasticity(1e9, 0.0))
        .with_load(Load::harmonic(10.0, 2.5, 0.0));
    let problem = Problem::new(scene).unwrap();
    let orbit = problem.settled(2000).unwrap();
    let judged = problem.judge(&orbit, 100).unwrap();
    let share = &judged.walls[0];
    assert!(judged.holds() && share.contacts >= 1, "{share:?}");
    // All of the energy m v²/2 at the face goes into the stop, but for what the load and the spring
    // do over 10 um, a thousandth of it and less.
    let expected = share.approach_speed * (1e9_f64 * 1.0).sqrt();
    assert!((share.peak_force / expected - 1.0).abs() < 2e-3, "{share:?} for {expected}");
}
