//! Penetration within its bounds, frozen motion that is reported, and scenes at the limits of
//! double precision.

use crate::common::{self, INTEGRATORS, MOREAU_JEAN, penalty, source, spring};
use crate::draws;
use proptest::test_runner::{Config as ProptestConfig, RngSeed};
use signorini::linear::Symmetric;
use signorini::residual::Judge;
use signorini::{
    Error, Integrator, Load, Options, Promise, Rigid, Scene, Scheme, Stepper, Structure, System, Wall, run,
};

#[test]
fn rigid_walls_are_passed_by_no_more_than_the_bounds_of_each_scheme() {
    for e in [0.0, 0.5, 0.8, 1.0] {
        for h in [1e-2, 1e-3, 1e-4] {
            for scene in [source(e, e), common::ball(0.1, e)] {
                for scheme in [Scheme::ImplicitEuler, Scheme::Newmark, Scheme::PaoliSchatzman, MOREAU_JEAN] {
                    let mut stepper = Stepper::new(&scene, &scheme, h).expect("sound");
                    let (mut deepest, mut speed, mut force) = (0.0_f64, 0.0_f64, 9.81_f64);
                    for _ in 0..(1.0 / h).round() as u32 {
                        let step = stepper.step().expect("a step");
                        speed = speed.max(step.velocity_before[0].abs());
                        force = force.max(100.0 * step.q[0].abs() + 3.0);
                        for wall in &scene.walls {
                            deepest = deepest.max(-wall.gap(step.q[0]));
                        }
                    }
                    let bound = match scheme {
                        Scheme::PaoliSchatzman => 2.0 * e * h * speed / (1.0 + e),
                        Scheme::MoreauJean { .. } => h * speed * (1.0 - 0.5 * e),
                        _ => 0.0,
                    };
                    let order_two = if bound > 0.0 { h * h * force } else { 0.0 };
                    assert!(deepest <= bound + order_two + 1e-17, "{scheme}, e = {e}, h = {h}: {deepest:e}, {bound:e}");
                }
            }
        }
    }
}

#[test]
fn moreau_jean_says_so_where_the_body_crosses_the_gap_within_a_step_and_freezes() {
    // 10 m/s across 10 mm in steps of 10 ms: each wall is reached from the other before the body
    // has moved.
    let scene = source(1.0, 1.0).with_initial(&[0.0], &[10.0]);
    let run = run(&scene, &MOREAU_JEAN, &Options::with_step(1e-2)).expect("a run");
    assert!(run.counters.frozen_steps > 90, "{:?}", run.counters);
    assert!(run.notes.iter().any(|n| n.contains("stands still")), "{:?}", run.notes);
    // With a step that resolves the crossing it does not.
    let run = signorini::run(&scene, &MOREAU_JEAN, &Options::with_step(1e-4)).expect("a run");
    assert_eq!(run.counters.frozen_steps, 0);
}

/// A scene at the limits of double precision, in units that scale it: ω = √(k/m), or √(1/m) without
/// a spring.
#[derive(Debug, Clone, Copy)]
struct Extreme {
    mass: f64,
    stiffness: f64,
    /// Damping over the critical one.
    zeta: f64,
    gap: f64,
    e: f64,
    /// Step over the period.
    periods: f64,
    load: Push,
}

#[derive(Debug, Clone, Copy, PartialEq)]
enum Push {
    None,
    /// Presses on the wall for ever.
    Constant,
    /// The same with a sine, between two walls.
    Both,
}

impl Extreme {
    fn spring(&self) -> f64 {
        if self.stiffness == 0.0 { 1.0 } else { self.stiffness }
    }

    fn omega(&self) -> f64 {
        (self.spring() / self.mass).sqrt()
    }

    fn step(&self) -> f64 {
        self.periods * std::f64::consts::TAU / self.omega()
    }

    fn scene(&self) -> Scene {
        let Self { mass, stiffness, zeta, gap, e, load, .. } = *self;
        let (k, omega) = (self.spring(), self.omega());
        let size = gap.max(1e-3);
        let scene = Scene::oscillator(mass, 2.0 * zeta * mass * omega, stiffness)
            .with_wall(Wall::upper("upper", gap).with_restitution(e))
            .with_initial(&[0.0], &[2.0 * size * omega]);
        let pressed = scene.clone().with_load(Load::constant(3.0 * k * size));
        match load {
            Push::None => scene,
            Push::Constant => pressed,
            Push::Both => pressed.with_wall(Wall::lower("lower", -gap).with_restitution(e)).with_load(Load::harmonic(
                5.0 * k * size,
                0.37 * omega.max(0.1 / self.step()),
                0.3,
            )),
        }
    }

    fn schemes(&self) -> Vec<Scheme> {
        let moreau = |theta| Scheme::MoreauJean { theta };
        let mut all = vec![Scheme::ImplicitEuler, Scheme::PaoliSchatzman, moreau(0.5), moreau(1.0), Scheme::Newmark];
        all.extend(INTEGRATORS.map(|i| spring(1e4 * self.spring(), i)));
        if self.load == Push::Both && self.gap > 0.0 {
            // As stiff at the wall as the linear spring.
            all.extend(INTEGRATORS.map(|i| penalty(4.0 * self.gap * self.gap / (1e4 * self.spring()), i)));
        }
        all
    }
}

/// 300 steps end in a named error, or meet their residuals: to 1e-9, or to rounding of what the
/// balance subtracts where that is coarser.
fn survives(extreme: &Extreme, scheme: &Scheme) {
    let what = format!("{scheme}, {extreme:?}");
    let (scene, h) = (extreme.scene(), extreme.step());
    let mut stepper = Stepper::new(&scene, scheme, h).unwrap_or_else(|e| panic!("{what}: {e}"));
    let state = stepper.state();
    let mut judge = Judge::new(stepper.scene(), stepper.contract(), h, &state.q, &state.v);
    let (mut reach, mut speed) = (extreme.gap, state.v[0].abs());
    for _ in 0..300 {
        match stepper.step() {
            Ok(step) => {
                speed = speed.max(step.velocity_before[0].abs()).max(step.velocity_after[0].abs());
                reach = reach.max(step.q[0].abs());
                judge.observe(&step);
            }
            Err(Error::NotFinite { .. } | Error::Newton { .. } | Error::Qp { .. }) => return,
            Err(other) => panic!("{what}: {other}"),
        }
    }
    let explicit = matches!(scheme, Scheme::Penalty { integrator: Integrator::CentralDifference, .. });
    if explicit && speed > 1e3 * extreme.omega() * reach.min(1.0) {
        // About to overflow, which it reports: stiffer than the stability limit of the explicit
        // rule.
        return;
    }
    assert_eq!(judge.findings(), [], "{what}");
    let r = judge.residuals();
    let System::Oscillator(o) = &scene.system else { panic!("one degree of freedom") };
    let wall = if matches!(scheme, Scheme::Penalty { .. }) { 1e4 * extreme.spring() } else { 0.0 };
    let ulp = 32.0 * f64::EPSILON;
    let length = reach + h * speed;
    let forces = o.mass * speed / h + o.damping * speed + (o.stiffness + wall) * length + r.force_scale_n;
    assert!(r.force_balance_n <= ulp * forces, "{what}: {forces:e} N, {r:?}");
    let (gamma, force) = match stepper.contract().promise {
        Promise { rigid: Rigid { displacement: None, velocity: Some(_), .. }, .. } => (speed, r.force_scale_n),
        _ => (length, r.force_scale_n.max(f64::MIN_POSITIVE)),
    };
    let rounding = ulp * (gamma / r.gap_scale).max(wall * length / force);
    assert!(r.complementarity <= 1e-9_f64.max(rounding), "{what}: {r:?}");
    assert!(r.tension_n <= 1e-12 * r.force_scale_n, "{what}: {r:?}");
    let bound = match scheme {
        Scheme::Penalty { .. } => f64::INFINITY,
        // e(g − q⁻) with q⁻ two steps back, and half a step and a turn of velocity: wider than the
        // bounds above, which are for small h.
        Scheme::PaoliSchatzman | Scheme::MoreauJean { .. } => 2.0 * h * speed,
        _ => 0.0,
    };
    assert!(r.penetration_m <= bound + ulp * length, "{what}: {r:?}");
}

#[test]
fn extreme_scenes_end_in_a_run_that_meets_its_residuals_or_in_a_named_error() {
    for mass in [1e-12, 1.0, 1e12] {
        for stiffness in [0.0, 1.0, 1e14] {
            for zeta in [0.0, 1.0, 1e6] {
                for gap in [0.0, 1e-12, 5e-3] {
                    for e in [0.0, 1e-6, 1.0] {
                        for periods in [1e-9, 1e-3, 0.1, 1.0, 10.0] {
                            for load in [Push::None, Push::Constant, Push::Both] {
                                let extreme = Extreme { mass, stiffness, zeta, gap, e, periods, load };
                                for scheme in extreme.schemes() {
                                    survives(&extreme, &scheme);
                                }
                            }
                        }
                    }
                }
            }
        }
    }
}

proptest::proptest! {
    #![proptest_config(ProptestConfig {
        cases: draws::cases(256),
        rng_seed: RngSeed::Fixed(draws::seed(1)),
        failure_persistence: None,
        ..ProptestConfig::default()
    })]

    #[test]
    fn drawn_scenes_do_too(
        mass in -12.0..12.0_f64,
        stiffness in proptest::option::of(-3.0..14.0_f64),
        zeta in proptest::option::of(-3.0..6.0_f64),
        gap in proptest::option::of(-12.0..0.0_f64),
        e in proptest::prop_oneof![proptest::strategy::Just(0.0), proptest::strategy::Just(1.0), 0.0..1.0],
        periods in -9.0..1.0_f64,
        load in proptest::sample::select(vec![Push::None, Push::Constant, Push::Both]),
    ) {
        let power = |x: Option<f64>| x.map_or(0.0, |x| 10.0_f64.powf(x));
        let extreme = Extreme {
            mass: 10.0_f64.powf(mass),
            stiffness: power(stiffness),
            zeta: power(zeta),
            gap: power(gap),
            e,
            periods: 10.0_f64.powf(periods),
            load,
        };
        for scheme in extreme.schemes() {
            survives(&extreme, &scheme);
        }
    }
}

#[test]
fn elastic_walls_that_take_turns_freeze_nothing() {
    // The body is thrown from one pad to the other in every step; a spring's answer is its force,
    // not a rule that holds the body up.
    for (walls, frozen) in [(false, false), (true, true)] {
        let close = |wall: Wall| if walls { wall } else { wall.with_elasticity(1e4, 0.0) };
        let mut scene = Scene::oscillator(1.0, 0.0, 0.0)
            .with_wall(close(Wall::upper("upper", 1e-3)))
            .with_wall(close(Wall::lower("lower", -1e-3)))
            .with_initial(&[0.0], &[10.0])
            .with_duration(2.0);
        for structure in [false, true] {
            if structure {
                scene.system = System::Structure(scene.system.structure());
            }
            let (mut turns, mut last) = (0, 0.0);
            let mut stepper = Stepper::new(&scene, &MOREAU_JEAN, 4e-2).expect("sound");
            for _ in 0..50 {
                let step = stepper.step().expect("a step");
                let pushed = step.impulse.iter().sum::<f64>();
                turns += u32::from(pushed * last < 0.0);
                last = pushed;
            }
            assert!(turns > 20, "{walls}, {structure}: {turns}");
            let counted = stepper.counters().frozen_steps;
            assert_eq!(counted, if frozen { u64::from(turns) } else { 0 }, "{walls}, {structure}: {turns} turns");
        }
    }
}

#[test]
fn a_motion_that_leaves_the_numbers_is_an_error_at_that_step() {
    // 1e308 N on 1 kg: 1e308 m/s after a second, and an overflow after two more.
    for structure in [false, true] {
        let mut scene = Scene::oscillator(1.0, 0.0, 0.0).with_load(Load::constant(1e308)).with_duration(10.0);
        if structure {
            scene.system = System::Structure(scene.system.structure());
        }
        let mut schemes = common::schemes();
        schemes.retain(|scheme| !matches!(scheme, Scheme::Penalty { .. }));
        for scheme in schemes {
            let mut stepper = Stepper::new(&scene, &scheme, 1.0).expect("sound");
            let mut good = 0;
            let error = loop {
                match stepper.step() {
                    Ok(step) => {
                        assert!(step.q[0].is_finite() && step.v[0].is_finite(), "{scheme}, {structure}: {step:?}");
                        good += 1;
                        assert!(good < 5, "{scheme}, {structure}");
                    }
                    Err(error) => break error,
                }
            };
            assert!(matches!(error, Error::NotFinite { step, .. } if step == good), "{scheme}, {structure}: {error:?}");
            assert!(!error.is_request(), "{error}");
        }
    }
}

#[test]
fn a_motion_that_has_decayed_is_zero_and_needs_no_denormal_numbers() {
    // At ω = 20 rad/s the damper lets the motion fall as e^(−t), by nine decades in a block of 4096
    // steps: below 1e-290 of the gap after 668 s and, were it followed on, below the least normal
    // number after 709 s. implicit-euler falls as fast again.
    for scheme in common::schemes() {
        for n in [1, 2] {
            let matrix = |x: f64| Symmetric::diagonal(&[x; 2]);
            let pair = || Structure { mass: matrix(1.0), damping: matrix(2.0), stiffness: matrix(400.0) };
            let scene = if n == 1 { Scene::oscillator(1.0, 2.0, 400.0) } else { Scene::structure(pair()) };
            let scene = scene
                .with_wall(Wall::upper("far", 1.0).with_restitution(0.5))
                .with_initial(&[0.5, 0.25][..n], &[0.0; 2][..n]);
            let mut stepper = Stepper::new(&scene, &scheme, 5e-3).unwrap();
            let start = stepper.state();
            let mut judge = Judge::new(stepper.scene(), stepper.contract(), 5e-3, &start.q, &start.v);
            let (mut least, mut denormal) = (f64::INFINITY, 0);
            for _ in 0..160_000 {
                let step = stepper.step().unwrap();
                judge.observe(&step);
                least = step.q.iter().map(|q| q.abs()).filter(|q| *q > 0.0).fold(least, f64::min);
                denormal += step.q.iter().filter(|q| q.is_subnormal()).count();
            }
            assert!(least < 1e-250 && denormal < 100, "{scheme}, {n}: {least:e}, {denormal}");
            let end = stepper.state();
            assert!(end.q.iter().chain(&end.v).all(|x| *x == 0.0), "{scheme}, {n}: {end:?}");
            assert_eq!(judge.findings(), [], "{scheme}, {n}");
        }
    }
}
