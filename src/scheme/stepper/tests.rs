//! What a stepper says of itself, and its steps in one call.

use super::super::{Integrator, PenaltyLaw};
use super::*;
use crate::linear::Symmetric;
use crate::scene::{Load, PlaneRows, Row, Structure, Table, Wall, WallLaw};
use crate::statistics::{ForceStatistics, Forces, Statistics, WearTally};
use crate::trajectory::Recorder;

const WITH_PROGRAMMES: [Scheme; 5] = [
    Scheme::ImplicitEuler,
    Scheme::PaoliSchatzman,
    Scheme::MoreauJean { theta: 0.5 },
    Scheme::GeneralizedAlpha { rho: 0.8 },
    Scheme::Newmark,
];

fn oscillator() -> Scene {
    Scene::oscillator(1.0, 0.0, 4.0).with_wall(Wall::upper("stop", 0.25)).with_initial(&[0.0], &[1.0])
}

#[test]
fn the_solver_that_works_is_named() {
    let unit = |x: f64| Symmetric::diagonal(&[x, x]);
    let pair = Scene::structure(Structure { mass: unit(1.0), damping: unit(0.0), stiffness: unit(4.0) })
        .with_wall(Wall::upper("stop", 0.25));
    let named = |scene: &Scene, scheme: Scheme, backend: Backend| {
        Stepper::new(scene, &Method { scheme, backend }, 0.01).unwrap().backend()
    };
    for scheme in WITH_PROGRAMMES {
        assert_eq!(named(&oscillator(), scheme, Backend::Auto), Backend::Clamp, "{scheme}");
        assert_eq!(named(&pair, scheme, Backend::Auto), Backend::Condensed, "{scheme}");
        assert_eq!(named(&oscillator(), scheme, Backend::Clarabel), Backend::Clarabel, "{scheme}");
    }
    let law = PenaltyLaw::Linear { stiffness: 1e4, damping: 0.0 };
    for scheme in [Scheme::Event, Scheme::Penalty { law, integrator: Integrator::default() }] {
        assert_eq!(named(&oscillator(), scheme, Backend::Auto), Backend::Auto, "{scheme}");
    }
}

#[test]
fn steps_are_counted_through_every_setting_of_the_state() {
    let mut stepper = Stepper::new(&oscillator(), &Scheme::MoreauJean { theta: 0.5 }, 0.5).unwrap();
    let state = stepper.state();
    let mut made = 0;
    for (steps, to) in [(5_u64, 1.5), (2, 1.0), (4, 5.0), (1, 0.0), (3, 0.0)] {
        for _ in 0..steps {
            stepper.step().unwrap();
        }
        made += steps;
        assert_eq!(stepper.counters().steps, made);
        stepper.set_state(to, &state).unwrap();
        assert_eq!((stepper.counters().steps, stepper.time()), (made, to));
        assert_eq!(stepper.step().unwrap().index, (2.0 * to) as u64);
        made += 1;
    }
}

#[test]
fn a_state_may_be_set_as_late_as_a_run_may_last() {
    let mut stepper = Stepper::new(&oscillator(), &Scheme::MoreauJean { theta: 0.5 }, 1.0).unwrap();
    let state = stepper.state();
    assert_eq!(stepper.set_state(1e10, &state), Ok(()));
    assert!(stepper.set_state(1e10 + 1.0, &state).is_err());
    assert!(stepper.set_state(1.5, &state).is_err());
    assert_eq!(stepper.time(), 1e10);
}

#[test]
fn the_exact_scheme_goes_on_as_late_as_its_time_advances() {
    let pair = Structure { mass: Symmetric::diagonal(&[1.0; 2]), ..Structure::default() };
    let zeros = Structure { damping: Symmetric::zeros(2), stiffness: Symmetric::zeros(2), ..pair };
    for scene in [oscillator(), Scene::structure(zeros)] {
        let mut stepper = Stepper::new(&scene, &Scheme::Event, 1e-3).unwrap();
        let state = stepper.state();
        for late in [1.000_001e7, 1.9e16, 1e17, 1e300] {
            let told = stepper.set_state(late, &state).unwrap_err().to_string();
            assert!(told.ends_with("expected at most 1e10 times the longest step, 0.001 s"), "{told}");
        }
        assert_eq!(stepper.set_state(1e7, &state), Ok(()));
        assert!(stepper.step().unwrap().end > 1e7);
    }
}

#[test]
fn the_exact_scheme_goes_on_at_a_wall_and_not_behind_it() {
    let mut stepper = Stepper::new(&oscillator(), &Scheme::Event, 0.1).unwrap();
    let at = |place: f64| State { q: vec![place], v: vec![-1.0] };
    // Rounding of the place of a wall 0.25 m away.
    for place in [0.25, 0.25_f64.next_up(), 0.125] {
        assert_eq!(stepper.set_state(0.0, &at(place)), Ok(()), "{place}");
    }
    assert!(stepper.set_state(0.0, &at(0.25 + 1e-9)).is_err());
}

#[test]
fn a_motion_that_becomes_infinite_in_a_glide_is_told_as_in_a_single_step() {
    // Two loads that are finite by themselves; their sum is not after 1.9 s. So heavy a body has no
    // great speed.
    let unit = |x: f64| Symmetric::diagonal(&[x, x]);
    let ramp = Table::new(vec![0.0, 4.0], vec![0.0, 1.7e308]).unwrap();
    let loaded = |scene: Scene| scene.with_load(Load::constant(1e308)).with_load(Load::table(ramp.clone()));
    let pair = Structure { mass: unit(1e10), damping: unit(0.0), stiffness: unit(1.0) };
    for scene in [loaded(Scene::structure(pair)), loaded(Scene::oscillator(1e10, 0.0, 1.0))] {
        let stepper = || Stepper::new(&scene, &Scheme::MoreauJean { theta: 0.5 }, 0.25).unwrap();
        let (mut one, mut many) = (stepper(), stepper());
        let told = (0..100).find_map(|_| one.step().err()).unwrap();
        let Error::NotFinite { step, .. } = told else { panic!("{told}") };
        assert!((4..12).contains(&step), "{told}");
        assert_eq!(many.advance_quiet(100).err(), Some(told));
    }
}

#[test]
fn a_glide_in_a_hole_ends_with_each_push_and_only_there() {
    let unit = |x: f64| Symmetric::diagonal(&[x, x]);
    let mut scene = Scene::structure(Structure { mass: unit(1.0), damping: unit(0.1), stiffness: unit(4.0) })
        .with_load(Load::harmonic(3.0, 0.7, 0.0))
        .with_initial(&[0.0, 0.0], &[1.0, 0.5]);
    let at = PlaneRows { y: Row::dof(0), z: Row::dof(1) };
    let wall = Wall { law: WallLaw::Rigid { restitution: 0.8 }, ..Wall::round("ring", at.clone(), 0.1) };
    scene = scene.with_support("ring", at, [0.0; 2], vec![wall]);
    let stepper = || Stepper::new(&scene, &Scheme::MoreauJean { theta: 0.5 }, 0.01).unwrap();
    let (mut one, mut many) = (stepper(), stepper());
    let (mut made, mut met, mut long) = (0, 0, 0);
    while made < 2000 {
        let end = many.advance_quiet(40).unwrap();
        let count = end.index + 1 - made;
        for k in 1..=count {
            let step = one.step().unwrap();
            let pushed = step.impulse[0] != 0.0;
            met += u32::from(pushed);
            assert_eq!(k == count, pushed || !step.closed.is_empty() || k == 40, "step {}", step.index);
            assert!(k < count || (step.q, step.v) == (end.q, end.v));
        }
        made += count;
        long += u32::from(count > 1);
    }
    assert!(met > 20 && long > 20, "{met} pushes, {long} glides of several steps");
}

#[test]
fn a_row_at_the_instant_of_an_impact_shows_the_state_after_it() {
    // All times and speeds are binary numbers: the wall is reached at 0.5 s exactly.
    let scene = Scene::oscillator(1.0, 0.0, 0.0)
        .with_wall(Wall::upper("stop", 0.5).with_restitution(0.5))
        .with_initial(&[0.0], &[1.0]);
    let mut stepper = Stepper::new(&scene, &Scheme::Event, 1.0).unwrap();
    let mut recorder = Recorder::new(&scene, 4, &[0.0], &[1.0]);
    while stepper.time() < 1.0 {
        recorder.observe(&stepper.step().unwrap());
    }
    let found = recorder.finish(&[]);
    assert_eq!(found.velocity(), [1.0, 1.0, -0.5, -0.5, -0.5]);
    assert_eq!(found.displacement(), [0.0, 0.25, 0.5, 0.375, 0.25]);
}

/// The force of the first wall over an exact run in one step.
fn exact_force(scene: &Scene) -> ForceStatistics {
    let mut stepper = Stepper::new(scene, &Scheme::Event, 1e9).unwrap();
    let mut forces = Forces::new(scene, 0.0, 1e9);
    while stepper.time() < scene.duration {
        forces.observe(&stepper.step().unwrap());
    }
    Statistics::new(scene, &[], 0.0).with_forces(&forces).walls[0].force.unwrap()
}

#[test]
fn the_mean_square_of_a_force_that_swings_often_in_one_step_is_that_of_its_closed_form() {
    // 3 N press 1 kg onto a spring, on which it swings by 2 N: 103 times in the run, which is one
    // step, and more than ten times in each of the ten intervals of the window.
    for period in [1.0, 1e-3, 1e3] {
        let omega = std::f64::consts::TAU / period;
        let stiffness = omega * omega;
        let scene = Scene::oscillator(1.0, 0.0, 0.0)
            .with_wall(Wall::lower("pad", 0.0).with_elasticity(stiffness, 0.0))
            .with_load(Load::constant(-3.0))
            .with_initial(&[-5.0 / stiffness], &[0.0])
            .with_duration(103.0 * period);
        let wall = exact_force(&scene);
        assert!((wall.mean_n - 3.0).abs() < 1e-9, "{wall:?}");
        // 3² + 2²/2; Gauss's rule of two points over a radian of the squared force errs by 1/4320
        // of its fourth derivative, which has the mean 0 over whole periods.
        assert!((wall.rms_n - 11.0_f64.sqrt()).abs() < 1e-5, "{wall:?}");
    }
}

#[test]
fn the_mean_square_of_a_single_push_is_that_of_its_closed_form() {
    // A spring pushes 1 kg out with 5 N at first, and a load of 1 N pulls it away: 6 cos φ − 1 N
    // with φ = ωt, until cos φ = 1/6. It never comes back.
    let leaves = (1.0_f64 / 6.0).acos();
    let square = leaves - 12.0 * leaves.sin() + 36.0 * (0.5 * leaves + 0.25 * (2.0 * leaves).sin());
    for omega in [1.0, 1e3, 1e-3] {
        let stiffness = omega * omega;
        let scene = Scene::oscillator(1.0, 0.0, 0.0)
            .with_wall(Wall::lower("pad", 0.0).with_elasticity(stiffness, 0.0))
            .with_load(Load::constant(1.0))
            .with_initial(&[-5.0 / stiffness], &[0.0])
            .with_duration(100.0 / omega);
        let wall = exact_force(&scene);
        // Gauss's rule of two points over at most half a radian: 1/4320 of its fourth power times
        // the third derivative at the end, 36 N², of 18 N².
        let expected = (square / 100.0).sqrt();
        assert!((wall.rms_n / expected - 1.0).abs() < 5e-5, "{wall:?}, {expected}");
    }
}

#[test]
fn an_impact_at_the_very_start_wears() {
    // At the brim of its hole, 2 kg leave it at 0.4 m/s and slide along it at 0.3 m/s; e = 1/2. The
    // way back in the run is shorter than the next chord.
    let unit = |x: f64| Symmetric::diagonal(&[x, x]);
    let mut scene = Scene::structure(Structure { mass: unit(2.0), damping: unit(0.0), stiffness: unit(0.0) })
        .with_initial(&[1e-3, 0.0], &[0.4, 0.3])
        .with_duration(1e-3);
    let at = PlaneRows { y: Row::dof(0), z: Row::dof(1) };
    let wall = Wall { law: WallLaw::Rigid { restitution: 0.5 }, ..Wall::round("hole", at.clone(), 1e-3) };
    scene = scene.with_support("hole", at, [0.0; 2], vec![wall]);
    let mut stepper = Stepper::new(&scene, &Scheme::Event, 1e-3).unwrap();
    let mut wear = WearTally::new(&scene, 0.0, 4);
    while stepper.time() < scene.duration {
        wear.observe(&stepper.step().unwrap());
    }
    // The sliding speed times the impulse of 2 kg (0.4 + 0.2) m/s, over 1 ms.
    let found = wear.statistics()[0].work_rate_w;
    assert!((found - 360.0).abs() < 1e-6, "{found}");
}
