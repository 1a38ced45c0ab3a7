//! The stepper at its edges: allocations, co-simulation, the recorder's sums, contacts, rest, and extreme scenes.

mod common;

use common::{MOREAU_JEAN, penalty, source, spring};
use signorini::qp::Backend;
use signorini::residual::Judge;
use signorini::{Balance, Contact, Error, Integrator, Load, Options, Scene, Scheme, Stepper, TimeOptions, Wall, run};

mod counting {
    //! An allocator that counts what the current thread asks of it.

    use std::alloc::{GlobalAlloc, Layout, System};
    use std::cell::Cell;

    thread_local! {
        static ALLOCATIONS: Cell<u64> = const { Cell::new(0) };
    }

    pub struct Counting;

    // SAFETY: everything is passed on to the system's allocator unchanged.
    unsafe impl GlobalAlloc for Counting {
        unsafe fn alloc(&self, layout: Layout) -> *mut u8 {
            let _ = ALLOCATIONS.try_with(|count| count.set(count.get() + 1));
            // SAFETY: as the caller promises.
            unsafe { System.alloc(layout) }
        }

        unsafe fn dealloc(&self, pointer: *mut u8, layout: Layout) {
            // SAFETY: as the caller promises.
            unsafe { System.dealloc(pointer, layout) }
        }
    }

    pub fn count() -> u64 {
        ALLOCATIONS.with(Cell::get)
    }
}

#[global_allocator]
static ALLOCATOR: counting::Counting = counting::Counting;

const INTEGRATORS: [Integrator; 4] = Integrator::ALL;

/// Every scheme on a grid; the penalty with a spring that a step of 0.1 ms resolves.
fn schemes() -> Vec<Scheme> {
    let mut all = vec![
        Scheme::ImplicitEuler,
        Scheme::PaoliSchatzman,
        MOREAU_JEAN,
        Scheme::MoreauJean { theta: 0.75 },
        Scheme::MoreauJean { theta: 1.0 },
        Scheme::Newmark,
    ];
    all.extend(INTEGRATORS.map(|i| spring(1e6, i)));
    all
}

#[test]
fn no_step_after_the_first_allocates() {
    let mut scheme_list = schemes();
    scheme_list.extend(INTEGRATORS.map(|i| penalty(1e-9, i)));
    for scene in [source(0.8, 0.8), common::elastic(3.0, 0.5), common::all_elastic(1.0)] {
        for scheme in &scheme_list {
            if matches!(scheme, Scheme::Penalty { .. }) && scene.walls.iter().any(|w| !w.law.is_rigid()) {
                continue;
            }
            let mut stepper = Stepper::with_backend(&scene, scheme, 1e-4, Backend::Clamp).expect("a sound scene");
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
    // Over a quarter of a second: to the start of chaos, with impacts. Rounding enters in another order: 1e-12 of the gap.
    for scheme in schemes() {
        let loaded = states(&source(0.8, 0.8).with_load(Load::constant(1.5)), &scheme, 2500, 0.0);
        let pushed = states(&source(0.8, 0.8), &scheme, 2500, 1.5);
        // Staggered schemes extrapolate the step before the start with the load but without the extra force: h² apart in what damping and
        // stiffness feel of it, some 1e-7 of the gap after two impacts.
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
            judge.see(&stepper.step_with(&[2.0 * f64::from(i % 7)]).expect("a step"));
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
        for scheme in schemes() {
            // 7 ms do not divide a second: rows of a 143rd, steps that divide them.
            for (step, sample) in [(1e-4, None), (1e-4, Some(7e-3)), (3e-4, Some(1e-2))] {
                let time = TimeOptions { step, sample, statistics_from: 0.0 };
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
                    assert!(wall.side.sign() * total > 0.0 || scheme == Scheme::Newmark, "{what}: {total}");
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
        // At half time, on a grid instant and between two: free motion of an undamped mass, 1 N s on 1 kg.
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

/// Bounds of a motion over many steps, and the number of contact episodes that ended.
#[derive(Debug)]
struct Bounds {
    least: f64,
    most: f64,
    speed: f64,
    ended: u64,
    pushed: f64,
}

fn bounds(scene: &Scene, scheme: &Scheme, h: f64, steps: u32) -> Bounds {
    let mut stepper = Stepper::new(scene, scheme, h).expect("a sound scene");
    let mut b = Bounds { least: f64::INFINITY, most: f64::NEG_INFINITY, speed: 0.0, ended: 0, pushed: 0.0 };
    for _ in 0..steps {
        let step = stepper.step().expect("a step");
        b.least = b.least.min(step.q[0]);
        b.most = b.most.max(step.q[0]);
        b.speed = b.speed.max(step.v[0].abs());
        b.ended += step.closed.len() as u64;
        b.pushed += step.impulse.iter().sum::<f64>();
    }
    b
}

#[test]
fn a_body_at_rest_on_a_wall_neither_creeps_nor_buzzes_in_a_million_steps() {
    const STEPS: u32 = 1_000_000;
    let rigid = [
        Scheme::ImplicitEuler,
        Scheme::PaoliSchatzman,
        MOREAU_JEAN,
        Scheme::MoreauJean { theta: 1.0 },
        Scheme::Newmark,
    ];
    for e in [0.0, 1e-6, 1.0] {
        for h in [1e-2, 1e-4] {
            // A floor at 0, and one at a place that is no short binary number, under a ball with a spring and a damper.
            let sprung = Scene::oscillator(0.7, 0.3, 11.0)
                .with_wall(Wall::lower("floor", 0.1).with_restitution(e))
                .with_load(Load::constant(-9.81))
                .with_initial(&[0.1], &[0.0]);
            for (scene, floor, weight) in [(common::ball(0.0, e), 0.0, 9.81), (sprung, 0.1, 9.81 + 1.1)] {
                for scheme in rigid {
                    let b = bounds(&scene, &scheme, h, STEPS);
                    let what = format!("{scheme}, e = {e}, h = {h}, floor at {floor}: {b:?}");
                    assert!((b.least - floor).abs() <= 1e-15 && (b.most - floor).abs() <= 1e-15, "{what}");
                    // One ulp of the position over a step at most.
                    assert!(b.speed <= 2e-17 / h && b.ended == 0, "{what}");
                    // Every newton second of the weight is carried (a staggered or position-level rule starts within half a step).
                    let carried = b.pushed / (weight * h * f64::from(STEPS));
                    assert!((carried - 1.0).abs() <= 1.0 / f64::from(STEPS), "{what}: carried {carried}");
                }
            }
        }
    }
}

#[test]
fn a_body_at_rest_in_a_penalty_wall_stays_where_the_wall_carries_it() {
    let weight = 9.81;
    for stiffness in [1e4, 1e8] {
        for integrator in INTEGRATORS {
            let depth = weight / stiffness;
            let scene = common::ball(0.0, 1.0).with_initial(&[0.0], &[0.0]);
            // The spring stands where the rigid floor does: the body may start behind the floor in the penalised scene only.
            let scheme = spring(stiffness, integrator);
            let settled = scene.penalised(match scheme {
                Scheme::Penalty { law, .. } => law,
                _ => continue,
            });
            let settled = settled.expect("a sound scene").with_initial(&[-depth], &[0.0]);
            for h in [1e-2, 1e-4] {
                if integrator == Integrator::CentralDifference && h * h * stiffness > 4.0 {
                    continue;
                }
                let b = bounds(&settled, &scheme, h, 1_000_000);
                let what = format!("{scheme}, h = {h}: {b:?}");
                // Rounding of the force, 1e-15 N, accelerates to 1e-15 m/s in a second.
                assert!((b.least / depth + 1.0).abs() < 1e-9 && (b.most / depth + 1.0).abs() < 1e-9, "{what}");
                assert!(b.speed < 1e-9 && b.ended == 0, "{what}");
            }
        }
    }
}

#[test]
fn a_bouncing_ball_comes_to_rest_and_stays() {
    // Exact rest at √(2h/g)(1 + e)/(1 − e), with h = 0.1 m and e = ½: 0.428 s.
    for scheme in [Scheme::ImplicitEuler, Scheme::PaoliSchatzman, MOREAU_JEAN, Scheme::MoreauJean { theta: 1.0 }] {
        for h in [1e-3, 1e-4] {
            let mut stepper = Stepper::new(&common::ball(0.1, 0.5), &scheme, h).expect("a sound scene");
            while stepper.time() < 0.5 {
                stepper.step().expect("a step");
            }
            let rest = stepper.state();
            // Within the height a step of gravity makes, and at no speed beyond it.
            assert!(rest.q[0].abs() < 10.0 * 9.81 * h * h && rest.v[0].abs() < 10.0 * h, "{scheme}, h = {h}: {rest:?}");
            let (mut least, mut most, mut episodes) = (f64::INFINITY, f64::NEG_INFINITY, 0);
            for _ in 0..100_000 {
                let step = stepper.step().expect("a step");
                least = least.min(step.q[0]);
                most = most.max(step.q[0]);
                episodes += step.closed.len();
            }
            println!("{scheme} {h}: {:e} {episodes} open {:?}", most - least, stepper.open_contacts());
            assert!(
                most - least < 9.81 * h * h && episodes <= 1,
                "{scheme}, h = {h}: {least:e} … {most:e}, {episodes}"
            );
        }
    }
}
