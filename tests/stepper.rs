//! The stepper at its edges: allocations, co-simulation, the recorder's sums, contacts, rest, and extreme scenes.

mod common;

use common::event_driven::EventDriven;
use common::{MOREAU_JEAN, penalty, source, spring};
use signorini::qp::Backend;
use signorini::residual::Judge;
use signorini::{
    Balance, Contact, Error, Integrator, Load, Options, Promise, Scene, Scheme, Stepper, System, Table, TimeOptions,
    Wall, run,
};

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

/// Contacts of a run over the scene's duration with steps of `h`.
fn contacts(scene: &Scene, scheme: &Scheme, h: f64) -> Vec<Contact> {
    let time = TimeOptions { sample: Some(scene.duration), ..TimeOptions::with_step(h) };
    let run = run(scene, scheme, &Options { time, ..Options::with_step(h) }).expect("a run");
    run.trajectory.contacts().to_vec()
}

#[test]
fn the_table_of_contacts_lists_the_impacts_of_the_exact_motion() {
    for e in [0.8, 1.0] {
        let scene = source(e, e).with_duration(1.0);
        let mut motion = EventDriven::new(&scene);
        motion.advance(1.0);
        for scheme in [Scheme::PaoliSchatzman, MOREAU_JEAN] {
            let h = 1e-5;
            let found = contacts(&scene, &scheme, h);
            assert_eq!(found.len(), motion.events.len(), "{scheme}, e = {e}");
            for (contact, event) in found.iter().zip(&motion.events) {
                let what = format!("{scheme}, e = {e}: {contact:?}, {event:?}");
                assert_eq!(
                    (contact.wall, contact.end, contact.peak_force),
                    (event.wall, Some(contact.start), None),
                    "{what}"
                );
                // The motion itself is known to 1e-3 of the gap and 1e-2 of its speed at this step: 5e-6 m at 0.1 m/s.
                assert!((contact.start - event.time).abs() < 2e-4, "{what}");
                assert!((contact.approach_speed - event.approach).abs() < 5e-3, "{what}");
                let departure = contact.departure_speed.expect("closed");
                assert!((departure - e * contact.approach_speed).abs() < 1e-3, "{what}");
                // Of 1 kg, but for what the load gives in the one or two steps: 3 N for 2e-5 s.
                assert!((contact.impulse.abs() - contact.approach_speed - departure).abs() < 2e-4, "{what}");
            }
        }
    }
}

#[test]
fn lasting_contacts_begin_end_and_peak_where_the_closed_forms_do() {
    // A published case: 100 kg on 1e4 N/m against a spring of 1e6 N/m at no gap, 1 m/s towards it.
    let struck = Scene::oscillator(100.0, 0.0, 1e4)
        .with_wall(Wall::upper("wall", 0.0).with_elasticity(1e6, 0.0))
        .with_initial(&[0.0], &[1.0])
        .with_duration(0.4);
    // Another: 1 kg under 10 N falls on a spring of 100 N/m 2 m below, thrown down at 1 m/s.
    let falling = Scene::oscillator(1.0, 0.0, 0.0)
        .with_wall(Wall::lower("wall", -2.0).with_elasticity(100.0, 0.0))
        .with_load(Load::constant(-10.0))
        .with_initial(&[0.0], &[-1.0])
        .with_duration(1.1);
    let h = 1e-5;
    // Sharing a spring between steps, an order-one scheme is off by some 10 h of relative energy loss; the others by h where a contact
    // begins or ends within a step.
    for scheme in schemes() {
        let first_order = matches!(
            scheme,
            Scheme::ImplicitEuler | Scheme::MoreauJean { theta: 0.75 } | Scheme::MoreauJean { theta: 1.0 }
        ) || matches!(scheme, Scheme::Penalty { integrator: Integrator::ImplicitEuler, .. });
        let tolerance = if first_order { 2e-3 } else { 1e-5 };
        let near = |found: f64, expected: f64, what: &str| {
            assert!((found / expected - 1.0).abs() < tolerance, "{scheme}: {what} {found}, expected {expected}");
        };
        let found = contacts(&struck, &scheme, h);
        let [first, second] = found[..] else { panic!("{scheme}: {found:?}") };
        assert!(first.start <= h && (first.end.expect("closed") - 0.03126).abs() < 4e-5, "{scheme}: {first:?}");
        near(first.peak_force.expect("finite"), 9950.37, "peak");
        near(-first.impulse, 198.020, "impulse");
        near(first.approach_speed, 1.0, "approach");
        // The second peak is at 0.36105 s, half a contact after its start.
        assert!((second.start - 0.36105 + 0.01563).abs() < 4e-5 + 2e-4 * tolerance, "{scheme}: {second:?}");
        let found = contacts(&falling, &scheme, h);
        let [contact] = found[..] else { panic!("{scheme}: {found:?}") };
        assert!((contact.start - 0.540_312).abs() < 3e-5, "{scheme}: {contact:?}");
        assert!((contact.end.expect("closed") - 0.885_456).abs() < 3e-5 + 0.1 * tolerance, "{scheme}: {contact:?}");
        near(contact.peak_force.expect("finite"), 74.80741, "peak");
        // v = √(1 + 40) at 2 m, both ways, and gravity in between.
        near(contact.impulse, 2.0 * 41.0_f64.sqrt() + 10.0 * (0.885_456_153 - 0.540_312_424), "impulse");
        near(contact.departure_speed.expect("closed"), 41.0_f64.sqrt(), "departure");
    }
}

#[test]
fn a_body_that_lands_with_restitution_zero_stays_until_it_is_lifted() {
    // Falls 0.1 m in 0.142785 s, rests, and is pulled up by 20 N from 0.5 s on; then flies.
    let table = Table::new(vec![0.5, 2.0], vec![20.0, 20.0]).expect("a sound table");
    let scene = common::ball(0.1, 0.0).with_load(Load::table(table)).with_duration(0.6);
    let landing = (0.2_f64 / 9.81).sqrt();
    let h = 1e-4;
    for scheme in [Scheme::ImplicitEuler, Scheme::PaoliSchatzman, MOREAU_JEAN] {
        let found = contacts(&scene, &scheme, h);
        let [contact] = found[..] else { panic!("{scheme}: {found:?}") };
        let what = format!("{scheme}: {contact:?}");
        assert!(
            (contact.start - landing).abs() <= 1.5 * h && (contact.end.expect("closed") - 0.5).abs() <= 1.5 * h,
            "{what}"
        );
        // v of the landing and the weight while it rests; each is within a step of its time.
        let expected = 9.81 * landing + 9.81 * (0.5 - landing);
        assert!((contact.impulse - expected).abs() < 2.0 * h * 9.81, "{what}, expected {expected}");
        assert!((contact.approach_speed - 9.81 * landing).abs() < 2.0 * h * 9.81, "{what}");
        assert!(contact.departure_speed.expect("closed").abs() < 2.0 * h * 10.19, "{what}");
        // The blow of the landing is no finite force: what peaks is the weight, or a blow's remainder of the same order.
        assert!(contact.peak_force.is_some_and(|p| p < 3.0 * 9.81), "{what}");
    }
    // Without the lift it is open at the end.
    for scheme in schemes() {
        let found = contacts(&common::ball(0.0, 0.0), &scheme, h);
        let [contact] = found[..] else { panic!("{scheme}: {found:?}") };
        assert_eq!((contact.end, contact.departure_speed), (None, None), "{scheme}");
    }
}

#[test]
fn a_wall_touched_at_the_start_with_outward_velocity_is_not_felt() {
    for scheme in schemes() {
        for (wall, v) in [(Wall::upper("wall", 0.3), -0.5), (Wall::lower("wall", 0.3), 0.5)] {
            for wall in [wall.clone().with_restitution(0.5), wall.with_elasticity(1e5, 10.0)] {
                let free = Scene::oscillator(1.0, 0.1, 2.0).with_initial(&[0.3], &[v]);
                let held = free.clone().with_wall(wall);
                let (mut a, mut b) = (
                    Stepper::new(&free, &scheme, 1e-3).expect("sound"),
                    Stepper::new(&held, &scheme, 1e-3).expect("sound"),
                );
                for i in 0..200 {
                    let (free, held) = (a.step().expect("a step"), b.step().expect("a step"));
                    assert_eq!((free.q, free.v), (held.q, held.v), "{scheme}, step {i}");
                    assert_eq!(held.impulse, [0.0], "{scheme}, step {i}");
                }
            }
        }
    }
}

#[test]
fn a_body_that_grazes_a_wall_at_rest_there_goes_its_way() {
    // Starts at the wall with no velocity, drawn off it by the spring: no force, and none that pulls.
    for scheme in schemes() {
        let scene =
            Scene::oscillator(1.0, 0.0, 100.0).with_wall(Wall::upper("wall", 0.01)).with_initial(&[0.01], &[0.0]);
        let b = bounds(&scene, &scheme, 1e-4, 5000);
        // It comes back after 0.628 s, not in this half second.
        assert!(b.pushed.abs() < 1e-12 && b.most <= 0.01 && (b.least + 0.01).abs() < 2e-5, "{scheme}: {b:?}");
    }
}

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
    // 10 m/s across 10 mm in steps of 10 ms: each wall is reached from the other before the body has moved.
    let scene = source(1.0, 1.0).with_initial(&[0.0], &[10.0]);
    let run = run(&scene, &MOREAU_JEAN, &Options::with_step(1e-2)).expect("a run");
    assert!(run.counters.frozen_steps > 90, "{:?}", run.counters);
    assert!(run.notes.iter().any(|n| n.contains("stands still")), "{:?}", run.notes);
    // With a step that resolves the crossing it does not.
    let run = signorini::run(&scene, &MOREAU_JEAN, &Options::with_step(1e-4)).expect("a run");
    assert_eq!(run.counters.frozen_steps, 0);
}

/// A scene at the edge of what numbers hold, in units that scale it: ω = √(k/m), or √(1/m) without a spring.
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

/// 300 steps end in a named error, or meet their residuals: to 1e-9, or to rounding of what the balance subtracts where that is coarser.
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
                judge.see(&step);
            }
            Err(Error::NotFinite { .. } | Error::Newton { .. } | Error::Qp { .. }) => return,
            Err(other) => panic!("{what}: {other}"),
        }
    }
    let explicit = matches!(scheme, Scheme::Penalty { integrator: Integrator::CentralDifference, .. });
    if explicit && speed > 1e3 * extreme.omega() * reach.min(1.0) {
        // On its way to the infinity that it reports: stiffer than the explicit rule is stable for.
        return;
    }
    let r = judge.residuals();
    let System::Oscillator(o) = &scene.system else { panic!("one degree of freedom") };
    let wall = if matches!(scheme, Scheme::Penalty { .. }) { 1e4 * extreme.spring() } else { 0.0 };
    let ulp = 32.0 * f64::EPSILON;
    let length = reach + h * speed;
    let forces = o.mass * speed / h + o.damping * speed + (o.stiffness + wall) * length + r.force_scale_n;
    assert!(r.force_balance_n <= ulp * forces, "{what}: {forces:e} N, {r:?}");
    let (gamma, force) = match stepper.contract().promise {
        Promise::Velocity => (speed, r.force_scale_n),
        _ => (length, r.force_scale_n.max(f64::MIN_POSITIVE)),
    };
    let rounding = ulp * (gamma / r.gap_scale).max(wall * length / force);
    assert!(r.complementarity <= 1e-9_f64.max(rounding), "{what}: {r:?}");
    assert!(r.tension_n <= 1e-12 * r.force_scale_n, "{what}: {r:?}");
    let bound = match scheme {
        Scheme::Penalty { .. } => f64::INFINITY,
        // e(g − q⁻) with q⁻ two steps back, and half a step and a turn of velocity: wider than the bounds above, which are for small h.
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
