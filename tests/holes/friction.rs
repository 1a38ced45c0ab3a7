//! Coulomb friction at round holes and flats: closed forms, and what holds of every scene.

use crate::random_structures::Draws;
use crate::rubbing::{
    MOREAU_JEAN, Sums, body, energy, follow, hole, isotropic, load, random_scene, rotating, turned, with, with_flats,
};
use signorini::linear::Symmetric;
use signorini::{Load, Options, PlaneRows, Row, Scene, Scheme, Stepper, Structure, WallLaw, heading, run};
use std::f64::consts::TAU;

#[test]
fn a_body_pressed_round_a_hole_rubs_with_the_exact_force_and_power() {
    const FORCE: f64 = 7.064_267_168_051_028;
    const WORK_RATE: f64 = 1.109_652_491_907_234_2;
    const POWER: f64 = 0.221_930_498_381_446_84;
    let (gap, omega, lag) = (5e-3, TAU * 5.0, 0.502_277_650_919_016_2_f64);
    let scene = rotating(with(isotropic(1.0, 0.2, 100.0), hole("hole", body(), gap, 0.3, 0.2)), 3.0, 5.0)
        .with_initial(&[gap * lag.cos(), -gap * lag.sin()], &[gap * omega * lag.sin(), gap * omega * lag.cos()]);
    for (h, steps) in [(1e-3, 4000_u64), (1e-4, 40_000), (1e-5, 40_000)] {
        let mut sums = Sums::default();
        follow(&scene, h, steps, |step| sums.observe(&scene, step));
        let (span, share) = (h * steps as f64, (h / 1e-3).powi(2));
        let [force, work, power] = [(sums.impulse, FORCE), (sums.work, WORK_RATE), (sums.friction, POWER)]
            .map(|(sum, exact)| sum / span / exact - 1.0);
        assert!(force.abs() < 3e-5 * share, "h = {h}: {force:e}");
        assert!(work.abs() < 1e-4 * share && power.abs() < 1e-4 * share, "h = {h}: {work:e}, {power:e}");
        // While it slides one way, friction takes μ of the work of wear, step by step.
        assert!((sums.friction / (0.2 * sums.work) - 1.0).abs() < 1e-12, "h = {h}: {sums:?}");
    }
}

/// A mass on a spring of 1e4 N/m along z, pressed with 10 N on a flat, as SDND100 of code_aster.
fn pressed() -> Scene {
    let none = || Symmetric::diagonal(&[0.0; 2]);
    let scene = Scene::structure(Structure {
        mass: Symmetric::diagonal(&[1.0; 2]),
        damping: none(),
        stiffness: Symmetric::diagonal(&[0.0, 1e4]),
    });
    with_flats(scene, "floor", body(), &[(0.0, 0.0)], 0.5, 0.1)
        .with_load(load(Load::constant(10.0), Row::dof(0)))
        .with_initial(&[0.0, 0.85e-3], &[0.0, 0.0])
        .with_duration(0.2)
}

#[test]
fn a_released_mass_swings_and_stops_as_coulomb_says() {
    // Each half swing loses 2μN/k; it stops where |u| ≤ μN/k.
    const TURNS: [f64; 4] = [-0.65e-3, 0.45e-3, -0.25e-3, 0.05e-3];
    let scene = pressed();
    let errors = |steps: u64| {
        let h = 0.2 / steps as f64;
        let (mut turns, mut sums, mut last, mut at) = (Vec::new(), Sums::default(), 0.0, f64::NAN);
        let stepper = follow(&scene, h, steps, |step| {
            let v = step.v[1];
            if last != 0.0 && v * last <= 0.0 {
                turns.push(step.q[1]);
            }
            last = v;
            assert!((step.impulse[0] + 10.0 * h).abs() < 1e-13 * h * 1e3, "{:?}", step.impulse);
            sums.observe(&scene, step);
            if (step.end - 0.05).abs() < 0.5 * h {
                at = step.q[1];
            }
        });
        assert_eq!(stepper.state().v[1], 0.0, "it sticks for ever");
        turns.truncate(4);
        assert_eq!(turns.len(), 4, "{turns:?}");
        let turn = turns.iter().zip(TURNS).map(|(found, exact)| (found - exact).abs()).fold(0.0, f64::max);
        // The rest is the last turning point.
        let rest = (stepper.state().q[1] - 0.05e-3).abs();
        [turn, (at - 5.601_420_200_247_444e-5).abs(), rest, (sums.work / 0.036 - 1.0).abs()]
    };
    let [coarse, fine] = [2000, 8000].map(errors);
    // Turning points and rest are of order 2. In the step in which the velocity turns, friction has
    // one sign instead of two, so what follows is off by up to 2μN h/mω in displacement: 2e-6 m at
    // h = 1e-4 s.
    assert!(coarse[0] < 5e-8 && fine[0] < coarse[0] / 8.0, "{coarse:?} {fine:?}");
    assert!(coarse[1] < 2e-6 && fine[1] < 0.5e-6, "{coarse:?} {fine:?}");
    assert!(coarse[2] < 5e-8 && fine[2] < 3e-9, "{coarse:?} {fine:?}");
    assert!(coarse[3] < 5e-5 && fine[3] < 5e-6, "{coarse:?} {fine:?}");
}

#[test]
fn an_oblique_impact_slips_or_sticks_as_coulomb_says() {
    let impact = |support: usize, sliding: f64| {
        let scene = isotropic(1.3, 0.0, 0.0);
        let scene = if support == 0 {
            with_flats(scene, "flat", body(), &[(0.0, 0.0)], 0.5, 0.2)
        } else {
            with(scene, hole("hole", body(), 1.0, 0.5, 0.2)).with_initial(&[1.0, 0.0], &[0.0, 0.0])
        };
        let start = scene.initial.q.clone();
        let scene = scene.with_initial(&start, &[0.2, sliding]);
        let mut sums = Sums::default();
        // The normal of the hole is that half a step ahead: 1e-10 rad on.
        let h = if support == 0 { 1e-3 } else { 1e-9 };
        let mut f = 0.0;
        let stepper = follow(&scene, h, 1, |step| {
            sums.observe(&scene, step);
            f = step.friction.iter().sum();
        });
        (sums, f, stepper.state().v)
    };
    for (support, within) in [(0, 1e-15), (1, 1e-9)] {
        let (sums, f, v) = impact(support, 0.15);
        assert!((sums.impulse - 0.39).abs() < within && (f + 0.078).abs() < within, "{sums:?} {f}");
        assert!((v[1] - 0.09).abs() < within && (v[0] + 0.1).abs() < within, "{v:?}");
        assert!((sums.work - 0.0468).abs() < within && (sums.friction - 0.2 * 0.0468).abs() < within, "{sums:?}");
        let (sums, f, v) = impact(support, 0.03);
        // It sticks: of μp = 0.078 N s half is needed. A step answers an impact whole, so the work
        // of wear is p v_t/2 rather than that of the impulse until it sticks.
        assert!((f + 0.039).abs() < within && v[1].abs() < within, "{f} {v:?}");
        assert!((sums.work - 0.39 * 0.015).abs() < within, "{sums:?}");
        // The other way round.
        let (_, f, v) = impact(support, -0.15);
        assert!((f - 0.078).abs() < within && (v[1] + 0.09).abs() < within, "{f} {v:?}");
    }
}

#[test]
fn a_mass_on_an_elastic_flat_is_rubbed_by_the_force_of_the_spring() {
    // Pressed into an elastic floor by 10 N and pushed along it by 3 N against μN = 2 N: (3 − 2)/m.
    let mut scene = with_flats(isotropic(2.0, 0.0, 0.0), "floor", body(), &[(0.0, 0.0)], 0.0, 0.2);
    scene.walls[0].law = WallLaw::Elastic { stiffness: 1e5, damping: 0.0 };
    let scene = scene
        .with_load(load(Load::constant(10.0), Row::dof(0)))
        .with_load(load(Load::constant(3.0), Row::dof(1)))
        .with_initial(&[1e-4, 0.0], &[0.0, 0.0])
        .with_duration(0.1);
    let run = run(&scene, &MOREAU_JEAN, &Options::with_step(1e-4)).unwrap();
    assert_eq!(run.findings, []);
    assert!((run.state.v[1] - 0.05).abs() < 1e-12 && (run.state.q[0] - 1e-4).abs() < 1e-15, "{:?}", run.state);
    let friction: f64 = run.trajectory.friction_impulses()[0].iter().sum();
    assert!((friction + 0.2).abs() < 1e-12, "{friction}");
}

/// A chain of three masses in two planes, two of them in supports with friction.
fn chain(friction: f64) -> Scene {
    let stiffness = |k: f64| {
        let own = (0..6).map(move |i| (i, i, 2.0 * k));
        Symmetric::from_entries(6, own.chain((2..6).map(move |i| (i, i - 2, -k))))
    };
    let scene = Scene::structure(Structure {
        mass: Symmetric::diagonal(&[1.0; 6]),
        damping: stiffness(0.05),
        stiffness: stiffness(500.0),
    });
    let at = |mass: usize| PlaneRows { y: Row::dof(2 * mass), z: Row::dof(2 * mass + 1) };
    let scene = with(scene, hole("hole", at(0), 1e-3, 0.5, friction));
    let flats = [(15.0, 0.8e-3), (105.0, 1e-3), (195.0, 0.9e-3), (285.0, 1e-3)];
    with_flats(scene, "flats", at(2), &flats, 0.3, friction)
        .with_load(load(Load::harmonic(4.0, 7.0, 0.2), Row::new(vec![(2, 1.0), (3, 0.4)])))
        .with_load(load(Load::harmonic(2.0, 3.0, 0.0), Row::dof(5)))
        .with_initial(&[0.0; 6], &[0.05, 0.02, 0.0, -0.03, 0.01, 0.0])
}

#[test]
fn a_turned_scene_with_friction_has_the_turned_motion() {
    let scene = chain(0.25);
    let other = turned(&scene, 37.0);
    let mut beside = Stepper::new(&other, &MOREAU_JEAN, 1e-4).unwrap();
    let [c, s] = heading(37.0);
    let mut sums = Sums::default();
    follow(&scene, 1e-4, 3000, |step| {
        let image = beside.step().unwrap();
        for (q, turned) in step.q.chunks_exact(2).zip(image.q.chunks_exact(2)) {
            let back = [c * turned[0] + s * turned[1], c * turned[1] - s * turned[0]];
            // Impacts multiply roundings of 1e-19 m.
            assert!((back[0] - q[0]).hypot(back[1] - q[1]) < 1e-8 * 1e-3, "{}", step.end);
        }
        sums.observe(&scene, step);
    });
    assert!(sums.arrivals > 20 && sums.friction > 0.0, "{sums:?}");
}

#[test]
fn friction_takes_energy_and_without_friction_the_scene_is_the_same_as_before() {
    // Free motion: the energy falls by what impacts and friction take, step by step.
    let mut scene = chain(0.25);
    scene.loads.clear();
    scene.initial.v = vec![0.3, -0.1, 0.0, 0.2, 0.1, 0.4];
    let mut before = energy(&scene, &scene.initial.q, &scene.initial.v);
    let first = before;
    follow(&scene, 1e-4, 5000, |step| {
        let after = energy(&scene, step.q, step.v);
        // Some roundings of the energy.
        assert!(after <= before + 1e-14 * first, "{}", step.end);
        before = after;
    });
    // A support of flats without friction beside a far hole is stepped by other code than planar
    // walls, to the same motion.
    let flats = [(15.0, 0.8e-3), (135.0, 1e-3), (255.0, 0.9e-3)];
    let planar = with_flats(isotropic(1.0, 0.3, 200.0), "flats", body(), &flats, 0.4, 0.0)
        .with_load(load(Load::harmonic(4.0, 9.0, 0.2), Row::new(vec![(0, 1.0), (1, 0.4)])))
        .with_load(load(Load::impulse(0.05, 0.0303), Row::dof(1)));
    let beside = with(planar.clone(), hole("far", body(), 1.0, 0.0, 0.0));
    let mut stepper = Stepper::new(&planar, &MOREAU_JEAN, 1e-4).unwrap();
    let mut pushed = 0;
    follow(&beside, 1e-4, 3000, |step| {
        let other = stepper.step().unwrap();
        for (a, b) in step.q.iter().zip(other.q) {
            assert!((a - b).abs() < 1e-10 * 1e-3, "{}", step.end);
        }
        pushed += u32::from(step.impulse.iter().any(|p| *p != 0.0));
    });
    assert!(pushed > 30, "{pushed}");
}

#[test]
fn other_schemes_refuse_friction() {
    let hole = hole("hole", body(), 1e-3, 0.0, 0.2);
    let elastic = with(isotropic(1.0, 0.2, 100.0), hole.clone().with_elasticity(1e6, 0.0));
    let rigid = with(isotropic(1.0, 0.2, 100.0), hole);
    let (alpha, flats) = (Scheme::GeneralizedAlpha { rho: 0.8 }, &pressed());
    for (scheme, scene, words) in [
        (Scheme::PaoliSchatzman, flats, "expected moreau-jean, located or no friction: this scheme has no law"),
        (Scheme::Event, flats, "expected moreau-jean, located or no friction: where"),
        (alpha, flats, "expected moreau-jean, located or no friction: a bound"),
        (alpha, &rigid, "friction at the round support \"hole\"; expected moreau-jean, located or no friction"),
        (Scheme::PaoliSchatzman, &rigid, "the round support \"hole\"; expected moreau-jean or located: this scheme"),
        // What is named is not refused next.
        (MOREAU_JEAN, &elastic, "expected located, no friction or rigid round supports: the normal"),
        (Scheme::ImplicitEuler, &elastic, "expected located or no friction: a bound"),
        (Scheme::Event, &elastic, "the elastic round support \"hole\"; expected located: the force"),
        (alpha, &elastic, "the elastic round support \"hole\"; expected located: this scheme"),
    ] {
        let error = Stepper::new(scene, &scheme, 1e-4).unwrap_err();
        assert!(error.is_request() && error.to_string().contains(words), "{error}");
    }
}

#[test]
fn large_friction_keeps_every_law() {
    // A body whose masses couple normal and tangent, thrown about in a hole, and a chain.
    let none = || Symmetric::diagonal(&[0.0; 2]);
    let mass = Symmetric::from_entries(2, [(0, 0, 2.0), (0, 1, 1.35), (1, 1, 1.0)]);
    let body_in_hole = Scene::structure(Structure { mass, damping: none(), stiffness: none() });
    for k in 0..60 {
        let (turn, friction) = (0.31 * f64::from(k), [0.8, 3.0, 10.0][k as usize % 3]);
        let scene = with(body_in_hole.clone(), hole("hole", body(), 1.0, 0.5, friction))
            .with_initial(&[0.0, 0.0], &[0.3 * turn.cos(), 0.3 * turn.sin()])
            .with_duration(20.0);
        for (scene, h) in [(scene, 1e-2), (chain(friction).with_duration(0.2), 1e-4 * f64::from(1 + k % 5))] {
            let run = run(&scene, &MOREAU_JEAN, &Options::with_step(h)).unwrap();
            assert_eq!((run.findings, run.counters.qp_unsettled), (vec![], 0), "{k}, μ = {friction}");
            assert!(run.statistics.walls.len() == scene.walls.len() && run.counters.qp_solves > 0);
        }
    }
}

/// Runs random scenes with friction; returns the number of steps in which bodies were wedged, and
/// that of all steps that met something.
fn random_runs(seeds: std::ops::Range<u64>) -> [u64; 2] {
    let mut counted = [0; 2];
    for seed in seeds {
        let mut draws = Draws::new(seed);
        let friction = [0.1, 0.3, 1.0][draws.below(3)];
        let scene = random_scene(&mut draws, friction).with_duration(0.3);
        let h = [1e-4, 1e-3, 5e-3][draws.below(3)];
        let run = run(&scene, &MOREAU_JEAN, &Options::with_step(h).unrecorded()).unwrap();
        let unsettled = run.counters.qp_unsettled;
        assert_eq!((run.findings, unsettled), (vec![], 0), "seed {seed}");
        counted = [counted[0] + run.counters.wedged_steps, counted[1] + run.counters.qp_solves];
    }
    counted
}

#[test]
fn random_scenes_keep_every_law_to_rounding() {
    let [wedged, all] = random_runs(0..150);
    // Several contacts with much friction press on few degrees of freedom here.
    assert!(wedged * 200 <= all && all > 10_000, "{wedged} of {all}");
}

#[test]
#[ignore = "minutes: cargo test --release --test holes friction -- --ignored --nocapture"]
fn ten_thousand_random_scenes_keep_every_law_to_rounding() {
    let [wedged, all] = random_runs(0..10_000);
    println!("in {wedged} of {all} steps that met something a body was wedged");
}

#[test]
fn a_body_that_crosses_its_gap_in_less_than_a_step_is_counted_as_frozen_between_opposite_sides() {
    // 10 m/s across 10 mm in steps of 10 ms, without loss: each side is reached from the other
    // before the body has moved.
    let free = || isotropic(1.0, 0.0, 0.0).with_initial(&[0.0; 2], &[10.0, 0.0]);
    let flats = with_flats(free(), "flats", body(), &[(0.0, 5e-3), (180.0, 5e-3)], 1.0, 0.2);
    let round = with(free(), hole("hole", body(), 5e-3, 1.0, 0.2));
    for (scene, what) in [(flats, "flats"), (round, "hole")] {
        let mut stepper = Stepper::new(&scene, &MOREAU_JEAN, 1e-2).expect("a scene");
        let (mut last, mut turns) = (0.0, 0);
        for k in 0..100 {
            let step = stepper.step().expect("a step");
            // The push along y, by flats or by the hole.
            let push = step.impulse.iter().sum::<f64>().abs();
            let side = push * step.velocity_after[0].signum();
            turns += u64::from(side * last < 0.0);
            last = side;
            if k == 49 {
                // The state that is set again has no step before it.
                let (time, state) = (stepper.time(), stepper.state());
                stepper.set_state(time, &state).expect("a state");
                last = 0.0;
            }
        }
        assert!(turns > 90, "{what}: {turns} turns");
        assert_eq!(stepper.counters().frozen_steps, turns, "{what}");
        // A step that resolves the crossing.
        let resolved = run(&scene.with_duration(0.1), &MOREAU_JEAN, &Options::with_step(1e-5)).expect("a run");
        assert_eq!(resolved.counters.frozen_steps, 0, "{what}");
    }
}
