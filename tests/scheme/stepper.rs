//! The stepper: allocations, co-simulation, blows, and what is recorded of its steps.

use crate::common::{self, INTEGRATORS, MOREAU_JEAN, penalty, schemes, schemes_of_whole_steps, source, spring};
use crate::counting;
use crate::random_structures;
use signorini::qp::Backend;
use signorini::residual::Judge;
use signorini::scheme::event::Event;
use signorini::{
    Balance, Contact, Error, Integrator, Load, Method, Options, Recorder, Row, Scene, Scheme, Stepper, Structure,
    TimeOptions, Wall, WallLaw, run,
};

#[test]
fn no_step_after_the_first_allocates() {
    let mut scheme_list = schemes_of_whole_steps();
    scheme_list.extend(INTEGRATORS.map(|i| penalty(1e-9, i)));
    for scene in [source(0.8, 0.8), common::elastic(3.0, 0.5), common::all_elastic(1.0)] {
        for scheme in &scheme_list {
            if matches!(scheme, Scheme::Penalty { .. }) && scene.walls.iter().any(|w| !w.law.is_rigid()) {
                continue;
            }
            let mut stepper = Stepper::new(&scene, &Method { scheme: *scheme, backend: Backend::Clamp }, 1e-4)
                .expect("a sound scene");
            stepper.step().expect("a step");
            let before = counting::count();
            let mut contacts = 0;
            for _ in 0..20_000 {
                contacts += stepper.step().expect("a step").closed.len();
            }
            for _ in 0..1000 {
                stepper.step_with(&[0.5]).expect("a step");
            }
            assert_eq!(counting::count() - before, 0, "{scheme}");
            assert!(contacts > 2, "{scheme}: {contacts} contacts only");
        }
    }
}

#[test]
fn no_step_of_a_structure_after_the_first_allocates() {
    let mut scene =
        random_structures::chain(30, 1e4, 1e-5).with_load(random_structures::on(Load::impulse(0.1, 0.0503), 3));
    for i in 0..30 {
        let upper = Wall::upper(&format!("u{i}"), 1e-3).with_restitution(0.5);
        let lower = Wall::lower(&format!("l{i}"), -1e-3);
        let lower = if i % 3 == 0 { lower.with_elasticity(1e5, 10.0) } else { lower };
        let place = if i % 7 == 1 { Row::new(vec![(i, 1.0), (i - 1, -1.0)]) } else { Row::dof(i) };
        scene =
            scene.with_wall(random_structures::at(upper, place.clone())).with_wall(random_structures::at(lower, place));
    }
    let scene = scene.with_load(Load::harmonic(50.0, 5.0, 0.0));
    for scheme in schemes_of_whole_steps() {
        let mut stepper = Stepper::new(&scene, &scheme, 1e-4).expect("a sound scene");
        stepper.step().expect("a step");
        let before = counting::count();
        let mut contacts = 0;
        for _ in 0..2000 {
            contacts += stepper.step().expect("a step").closed.len();
        }
        for _ in 0..100 {
            stepper.step_with(&[0.5; 30]).expect("a step");
        }
        assert_eq!(counting::count() - before, 0, "{scheme}");
        assert!(contacts > 2, "{scheme}: {contacts} contacts only");
    }
}

#[test]
fn the_exact_scheme_allocates_nothing_once_it_is_built() {
    let blown = common::ball(0.1, 0.5).with_load(Load::impulse(-1.0, 1.9)).with_load(Load::impulse(1.0, 1.95));
    let scenes = [
        source(1.0, 1.0),
        source(0.8, 0.8),
        source(0.0, 0.0),
        common::elastic(3.0, 0.5),
        common::all_elastic(1.0),
        common::ball(0.1, 1.0),
        common::ball(0.1, 0.8),
        blown,
    ];
    for (number, scene) in scenes.into_iter().enumerate() {
        let scene = scene.with_duration(5.0);
        for stride in [1e-3, 10.0] {
            let mut event = Event::new(&scene, stride).expect("a sound scene");
            let before = counting::count();
            let mut contacts = 0;
            while !event.is_done() {
                event.advance(0.0).expect("a step");
                contacts += event.step().closed.len();
            }
            assert_eq!(counting::count() - before, 0, "scene {number}, stride {stride}");
            assert!(contacts > 2, "scene {number}: {contacts} contacts only");
        }
    }
}

/// A scheme's states over `steps` steps of 0.1 ms, with an extra force.
fn states(scene: &Scene, scheme: &Scheme, steps: u32, extra: f64) -> Vec<(f64, f64, f64)> {
    let mut stepper = Stepper::new(scene, scheme, 1e-4).expect("a sound scene");
    let mut out = Vec::new();
    for _ in 0..steps {
        let step = stepper.step_with(&[extra]).expect("a step");
        out.push((step.q[0], step.v[0], step.impulse.iter().sum()));
    }
    out
}

#[test]
fn a_force_given_step_by_step_does_what_a_constant_load_does() {
    // Over a quarter of a second: to the start of chaos, with impacts. Rounding enters in another
    // order: 1e-12 of the gap.
    for scheme in schemes() {
        let loaded = states(&source(0.8, 0.8).with_load(Load::constant(1.5)), &scheme, 2500, 0.0);
        let pushed = states(&source(0.8, 0.8), &scheme, 2500, 1.5);
        // Staggered schemes extrapolate the step before the start with the load but without the
        // extra force: h² apart in what damping and stiffness feel of it, some 1e-7 of the gap
        // after two impacts.
        let staggered = matches!(scheme.contract().balance, Balance::Staggered(_));
        let (close, least) = if staggered { (1e-6, 1e-4) } else { (1e-12, 1e-12) };
        for (i, (a, b)) in loaded.iter().zip(&pushed).enumerate() {
            assert!((a.0 - b.0).abs() < close * 5e-3, "{scheme}, step {i}: {a:?} {b:?}");
            let (va, vb, pa, pb) = (a.1, b.1, a.2, b.2);
            assert!((va - vb).abs() < least && (pa - pb).abs() < least, "{scheme}, step {i}: {a:?} {b:?}");
        }
    }
    // A force that changes from step to step is judged like any other.
    for scheme in schemes() {
        let scene = source(0.5, 0.5);
        let mut stepper = Stepper::new(&scene, &scheme, 1e-4).expect("a sound scene");
        let state = stepper.state();
        let mut judge = Judge::new(stepper.scene(), stepper.contract(), 1e-4, &state.q, &state.v);
        for i in 0..5000 {
            judge.observe(&stepper.step_with(&[2.0 * f64::from(i % 7)]).expect("a step"));
        }
        let r = judge.residuals();
        // Rounding of the mass times the velocity over a step of 0.1 ms, beside 1e3 N of impact.
        assert!(r.force_balance < 1e-12, "{scheme}: {r:?}");
    }
    let mut stepper = Stepper::new(&source(1.0, 1.0), &MOREAU_JEAN, 1e-3).expect("a sound scene");
    assert!(matches!(stepper.step_with(&[]), Err(Error::Invalid { .. })));
    assert!(matches!(stepper.step_with(&[f64::NAN]), Err(Error::Invalid { .. })));
    assert!(matches!(stepper.step_with(&[1.0, 2.0]), Err(Error::Invalid { .. })));
    assert_eq!(stepper.time(), 0.0);
}

#[test]
fn a_run_is_its_steps_and_its_columns_sum_to_its_impulses() {
    let scenes = [
        source(0.8, 0.8),
        source(0.0, 0.0),
        common::elastic(3.0, 0.5),
        source(0.4, 0.9).with_load(Load::impulse(0.1, 0.25)).with_load(Load::impulse(-0.05, 0.0)),
    ];
    for scene in scenes {
        for scheme in schemes_of_whole_steps() {
            // 7 ms do not divide a second: rows of a 143rd, steps that divide them.
            for (step, sample) in [(1e-4, None), (1e-4, Some(7e-3)), (3e-4, Some(1e-2))] {
                let time = TimeOptions { sample, ..TimeOptions::with_step(step) };
                let options = Options { time, ..Options::with_step(step) };
                let run = run(&scene, &scheme, &options).expect("a run");
                let what = format!("{scheme}, h = {step}, rows every {sample:?}");
                let (grid, t) = (run.grid, &run.trajectory);
                assert!(grid.step <= step * (1.0 + 1e-9) && grid.steps % grid.rows == 0, "{what}: {grid:?}");
                let mut stepper = Stepper::new(&scene, &scheme, grid.step).expect("a sound scene");
                assert_eq!(
                    (t.time()[0], t.displacement()[0], t.velocity()[0]),
                    (0.0, 0.0, stepper.state().v[0]),
                    "{what}"
                );
                let mut sums = vec![0.0; scene.walls.len()];
                let (mut row, mut contacts) = (1, Vec::new());
                for i in 0..grid.steps {
                    let step = stepper.step().expect("a step");
                    for (sum, p) in sums.iter_mut().zip(step.impulse) {
                        *sum += p;
                    }
                    contacts.extend_from_slice(step.closed);
                    if (i + 1) % (grid.steps / grid.rows) == 0 {
                        assert_eq!(
                            (t.displacement()[row], t.velocity()[row]),
                            (step.q[0], step.v[0]),
                            "{what}, row {row}"
                        );
                        assert!((t.time()[row] - step.end).abs() < 1e-12, "{what}, row {row}");
                        row += 1;
                    }
                }
                assert_eq!((t.time().len(), t.time()[row - 1]), (row, 1.0), "{what}");
                contacts.extend(stepper.open_contacts());
                contacts.sort_by(|a: &Contact, b| a.start.total_cmp(&b.start));
                assert_eq!(t.contacts(), contacts, "{what}");
                for (index, wall) in scene.walls.iter().enumerate() {
                    let columns: f64 = t.contact_impulse(&wall.name).expect("its wall").iter().sum();
                    let total = t.impulse(&wall.name).expect("its wall");
                    let episodes: f64 = contacts.iter().filter(|c| c.wall == index).map(|c| c.impulse).sum();
                    // Sums of the same 1e4 numbers in another order.
                    let close = |a: f64| (a - sums[index]).abs() <= 1e-12 * sums[index].abs();
                    assert!(
                        total == columns && close(total) && close(episodes),
                        "{what}: {total} {episodes} {}",
                        sums[index]
                    );
                    assert!(wall.side().sign() * total > 0.0 || scheme == Scheme::Newmark, "{what}: {total}");
                }
            }
        }
    }
}

#[test]
fn a_blow_at_the_start_is_the_velocity_it_gives_and_one_in_mid_run_arrives_in_time() {
    for scheme in schemes() {
        // 2 kg; 0.1 N s at once make 0.05 m/s.
        let struck = Scene::oscillator(2.0, 0.3, 50.0).with_load(Load::impulse(0.1, 0.0));
        let moving = Scene::oscillator(2.0, 0.3, 50.0).with_initial(&[0.0], &[0.05]);
        let go = |scene: &Scene, step: f64| run(scene, &scheme, &Options::with_step(step)).expect("a run").trajectory;
        let with_wall = |scene: &Scene| scene.clone().with_wall(Wall::upper("far", 1.0));
        let (a, b) = (go(&with_wall(&struck), 1e-3), go(&with_wall(&moving), 1e-3));
        assert_eq!((a.displacement(), a.velocity()), (b.displacement(), b.velocity()), "{scheme}");
        // At half time, on a grid instant and between two: free motion of an undamped mass, 1 N s
        // on 1 kg.
        for time in [0.5, 0.5003] {
            let mass = Scene::oscillator(1.0, 0.0, 0.0).with_load(Load::impulse(1.0, time));
            let t = go(&with_wall(&mass).with_duration(1.0), 1e-3);
            let (q, v) = (t.displacement(), t.velocity());
            // The whole blow, and within a step of its time.
            assert!((v[1000] - 1.0).abs() < 1e-12 && v[499] == 0.0, "{scheme}: {} {}", v[1000], v[499]);
            assert!((q[1000] - (1.0 - time)).abs() <= 1.000_001e-3, "{scheme}: {}", q[1000]);
            if time == 0.5 {
                // States are right-continuous: the row at the instant of the blow is after it.
                assert!((v[500] - 1.0).abs() < 1e-12, "{scheme}: {} at the blow", v[500]);
            }
        }
    }
}

#[test]
fn blows_half_way_between_two_steps_act_once() {
    let step = 1e-4;
    for half in (0..2000).map(|n| f64::from(2 * n + 1) * 5e-5) {
        let half = (half * 1e6).round() / 1e6;
        let scene = Scene::oscillator(1.0, 0.0, 0.0).with_load(Load::impulse(1.0, half)).with_duration(0.3);
        for scheme in [Scheme::PaoliSchatzman, spring(1.0, Integrator::CentralDifference)] {
            let mut stepper = Stepper::new(&scene, &scheme, step).expect("a sound scene");
            let start = stepper.state();
            let mut judge = Judge::new(&scene, stepper.contract(), step, &start.q, &start.v);
            while stepper.time() < half + 3.0 * step {
                judge.observe(&stepper.step().expect("a step"));
            }
            let v = stepper.state().v[0];
            assert!((v - 1.0).abs() < 1e-12, "{scheme}: velocity {v} m/s after a blow of 1 N s at {half} s");
            assert!(judge.residuals().force_balance < 1e-12, "{scheme}: {:?}", judge.residuals());
        }
    }
}

#[test]
fn a_recorder_that_sees_steps_beyond_its_last_row_keeps_to_its_rows() {
    let scene = source(0.8, 0.8).with_duration(0.5);
    for scheme in [MOREAU_JEAN, Scheme::PaoliSchatzman, Scheme::Event] {
        let mut stepper = Stepper::new(&scene, &scheme, 1e-3).expect("a sound scene");
        let start = stepper.state();
        let mut recorder = Recorder::new(&scene, 50, &start.q, &start.v);
        for _ in 0..700 {
            recorder.observe(&stepper.step().expect("a step"));
        }
        let trajectory = recorder.finish(&[]);
        assert_eq!(trajectory.time().len(), 51, "{scheme}");
        assert!(trajectory.time().is_sorted_by(|a, b| a < b), "{scheme}");
        assert!(trajectory.contacts().iter().all(|c| c.start <= 0.5), "{scheme}");
    }
}

#[test]
fn a_wall_of_the_quartic_law_is_refused_by_schemes_that_would_not_feel_it() {
    let mut scene = source(1.0, 1.0);
    scene.walls[0].law = WallLaw::Quartic { epsilon: 1e-9, span: 1e-2 };
    for scheme in [MOREAU_JEAN, Scheme::PaoliSchatzman, Scheme::ImplicitEuler, Scheme::Newmark, Scheme::Event] {
        let refused = Stepper::new(&scene, &scheme, 1e-4).map(|_| ());
        assert!(refused.as_ref().is_err_and(Error::is_request), "{scheme}: {refused:?}");
    }
    assert!(Stepper::new(&scene, &penalty(1e-9, Integrator::Trapezoidal), 1e-4).is_ok());
}

#[test]
fn every_row_of_an_exact_run_has_the_force_of_a_body_that_starts_at_rest_on_a_wall() {
    let scene = Scene::oscillator(2.0, 0.0, 0.0)
        .with_wall(Wall::lower("floor", 0.0).with_restitution(0.5))
        .with_load(Load::constant(-10.0));
    let exact = run(&scene, &Scheme::Event, &Options::with_step(1e-2)).expect("a run");
    let force = exact.trajectory.contact_force("floor").expect("a wall");
    // No time precedes the first row. In the others some roundings of 10 N s, 2e-15 N s each, count
    // a hundredfold as a force over 10 ms.
    assert_eq!(force[0], 0.0);
    let worst = force[1..].iter().fold(0.0, |worst, &f| f64::max(worst, (f - 10.0).abs()));
    assert!(worst < 1e-11, "{worst}");
}

#[test]
fn a_wall_behind_a_lever_meets_an_oscillator_where_it_meets_the_structure() {
    // Seen through 2 q a wall at 0.2 m stands at q = 0.1 m, and a spring there is four times as
    // stiff.
    let direct = Wall::upper("stop", 0.1).with_restitution(0.5);
    let spring = Wall::lower("spring", -0.1).with_elasticity(4e3, 4.0);
    let lever = |mut wall: Wall, k: f64| {
        let position = 2.0 * wall.position();
        wall = wall.at(Row::new(vec![(0, 2.0)])).with_position(position);
        if !wall.law.is_rigid() {
            wall = wall.with_elasticity(k, k * 1e-3);
        }
        wall
    };
    let body = Scene::oscillator(2.0, 0.0, 300.0).with_initial(&[0.0], &[3.0]);
    let scene = body.clone().with_wall(direct.clone()).with_wall(spring.clone());
    let levers = body.with_wall(lever(direct, 0.0)).with_wall(lever(spring, 1e3));
    // newmark throws the body about by the phase of each impact, which no rounding leaves alone.
    let schemes = common::CONSTRAINED.into_iter().filter(|scheme| *scheme != Scheme::Newmark);
    for scheme in schemes.chain([Scheme::Event]) {
        let run = |scene: &Scene| signorini::run(scene, &scheme, &Options::with_step(1e-3)).expect("a run");
        let (a, b) = (run(&scene), run(&levers));
        assert!(b.residuals.complementarity < 1e-9, "{scheme}: {:?}", b.residuals);
        assert_eq!(a.trajectory.contacts().len(), b.trajectory.contacts().len(), "{scheme}");
        // The impacts of a second carry rounding from one to the next, each by a factor of some
        // units.
        for (a, b) in a.trajectory.displacement().iter().zip(b.trajectory.displacement()) {
            assert!((a - b).abs() < 1e-9, "{scheme}: {a}, {b}");
        }
    }
}

#[test]
fn steps_of_another_scene_change_nothing_for_recorder_and_judge() {
    let small = source(0.8, 0.8);
    let mut wide = small.clone().with_initial(&[0.0, 0.0], &[1.0, 1.0]);
    let two = signorini::linear::Symmetric::diagonal(&[1.0, 1.0]);
    let structure = Structure { mass: two.clone(), damping: signorini::linear::Symmetric::zeros(2), stiffness: two };
    wide.system = structure.into();
    for scheme in [MOREAU_JEAN, Scheme::Event, Scheme::GeneralizedAlpha { rho: 0.8 }] {
        for (mine, other) in [(&small, &wide), (&wide, &small)] {
            let state = &mine.initial;
            let contract = Stepper::new(mine, &scheme, 1e-3).expect("sound").contract();
            let mut recorder = Recorder::new(mine, 1000, &state.q, &state.v);
            let mut judge = Judge::new(mine, contract, 1e-3, &state.q, &state.v);
            let (before, verdict) = (recorder.clone().finish(&[]), judge.residuals());
            let mut stepper = Stepper::new(other, &scheme, 1e-3).expect("sound");
            for _ in 0..20 {
                let step = stepper.step().expect("a step");
                recorder.observe(&step);
                judge.observe(&step);
            }
            assert_eq!(recorder.finish(&[]), before, "{scheme}");
            assert_eq!(judge.residuals(), verdict, "{scheme}");
        }
    }
}
