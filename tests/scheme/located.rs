//! The scheme whose steps are divided at impacts: its order, what it keeps, and where it gives up.

use crate::common::event_driven::EventDriven;
use crate::common::{self, slope};
use crate::random_structures::{chain, on};
use signorini::linear::Symmetric;
use signorini::{Load, Options, Row, Run, Scene, Scheme, Stepper, Structure, Table, TimeOptions, Wall, run};

fn located(scene: &Scene, step: f64) -> Run {
    let time = TimeOptions { sample: Some(1e-3_f64.max(step)), ..TimeOptions::with_step(step) };
    let run = run(scene, &Scheme::Located, &Options::new(time)).expect("a run");
    assert_eq!(run.findings, [], "step {step:e}");
    run
}

/// The largest difference of the rows from displacements every millisecond, over 5 mm.
fn error(scene: &Scene, step: f64, exact: &[f64]) -> f64 {
    let run = located(scene, step);
    let shown = &run.trajectory.displacements()[0][1..];
    assert_eq!(shown.len(), exact.len());
    common::error(shown, exact)
}

/// Steps of 1 ms over these numbers.
const PARTS: [f64; 6] = [1.0, 2.0, 4.0, 8.0, 16.0, 32.0];

/// The order of the error over steps of a millisecond and below; where it is at rounding, ∞.
fn order(what: &str, error: impl Fn(f64) -> f64) -> f64 {
    let points: Vec<(f64, f64)> = PARTS.iter().map(|n| (1e-3 / n, error(1e-3 / n))).collect();
    println!("{what}: order {:.2}, {points:?}", slope(&points));
    slope(&points)
}

#[test]
fn displacements_are_of_order_two_through_impacts() {
    // The motion is predictable for a second: at e = 1 errors grow eightfold.
    for e in [1.0, 0.8, 0.0] {
        let scene = common::source(e, e).with_duration(1.0);
        let exact = EventDriven::displacements(&scene, 1e-3, 1.0);
        let order = order(&format!("e = {e}"), |step| error(&scene, step, &exact));
        // A slope over a factor of 32 of the step; the phase of impacts within steps scatters it.
        assert!((1.8..2.4).contains(&order), "e = {e}: {order}");
    }
}

#[test]
fn instants_and_impulses_of_impacts_are_of_order_two() {
    let scene = common::source(0.8, 0.8).with_duration(1.0);
    let mut exact = EventDriven::new(&scene);
    exact.advance(1.0);
    let reference = run(&scene, &Scheme::Event, &Options::with_step(1e-3)).expect("an exact run");
    let instants = order("instants", |step| {
        let run = located(&scene, step);
        assert_eq!(run.trajectory.contacts().len(), exact.events.len());
        let apart = run.trajectory.contacts().iter().zip(&exact.events).map(|(c, event)| (c.start - event.time).abs());
        apart.fold(0.0, f64::max)
    });
    let impulses = order("impulses", |step| {
        let run = located(&scene, step);
        let pairs = run.trajectory.contacts().iter().zip(reference.trajectory.contacts());
        pairs.map(|(a, b)| (a.impulse - b.impulse).abs()).fold(0.0, f64::max)
    });
    assert!((1.8..2.3).contains(&instants) && (1.8..2.3).contains(&impulses), "{instants} {impulses}");
}

#[test]
fn lasting_contacts_begin_and_end_at_order_two() {
    let scene = common::source(0.0, 0.0).with_duration(1.0);
    let exact = run(&scene, &Scheme::Event, &Options::with_step(1e-3)).expect("an exact run");
    let error = |step: f64, of: &dyn Fn(&signorini::Contact) -> f64| {
        let run = located(&scene, step);
        let contacts = run.trajectory.contacts();
        assert_eq!(contacts.len(), exact.trajectory.contacts().len());
        let pairs = contacts.iter().zip(exact.trajectory.contacts());
        pairs.map(|(a, b)| (of(a) - of(b)).abs()).fold(0.0, f64::max)
    };
    let ends = order("ends of rests", |step| error(step, &|contact| contact.end.unwrap_or(0.0)));
    let impulses = order("impulses of rests", |step| error(step, &|contact| contact.impulse));
    // The force of a rest falls almost straight to zero.
    assert!((1.7..2.6).contains(&ends) && (1.7..2.4).contains(&impulses), "{ends} {impulses}");
}

#[test]
fn a_ball_bounces_at_the_instants_of_its_closed_form_and_rests_on_the_face() {
    // From 0.1 m at e = ½: impacts at t₁(1 + 2e + 2e² + …), t₁ = √(2 · 0.1/g), which end at 3t₁. A
    // fall is a parabola, which the rule follows exactly.
    let (e, g) = (0.5, 9.81);
    let scene = Scene::oscillator(1.0, 0.0, 0.0)
        .with_wall(Wall::lower("floor", 0.0).with_restitution(e))
        .with_load(Load::constant(-g))
        .with_initial(&[0.1], &[0.0])
        .with_duration(1.0);
    let first = (0.2_f64 / g).sqrt();
    for step in [7e-3, 1e-3] {
        let run = located(&scene, step);
        let contacts = run.trajectory.contacts();
        let mut time = first;
        let mut flight = 2.0 * first * e;
        for (count, contact) in contacts.iter().enumerate().take_while(|(_, c)| c.peak_force.is_none()) {
            // The wall counts as touched within 1e-13 m, a share of 1e-12 of the height; a ball at
            // 0.03 m/s takes 3e-12 s for that.
            assert!((contact.start - time).abs() < 2e-11, "impact {count}: {} for {time}", contact.start);
            (time, flight) = (time + flight, flight * e);
            assert!(flight * 2.0 > step * e, "impact {count} should have been the last");
        }
        let rest = contacts.last().expect("contacts");
        // It rests at once where the remaining bounces end within a step.
        assert!(rest.end.is_none() && (rest.start - 3.0 * first).abs() <= step, "{rest:?}");
        assert!((rest.peak_force.unwrap_or(0.0) - g).abs() < 1e-9, "{rest:?}");
        // On the face, at no depth.
        assert!(run.state.q[0].abs() < 1e-15, "{:?}", run.state);
        // All that the ball lost and what its weight gave: p = g T.
        assert!((run.trajectory.impulse("floor").expect("a wall") - g).abs() < 1e-12);
    }
}

/// A chain of three masses between walls, driven at its end.
fn struck_chain(e: f64) -> Scene {
    let walls = |scene: Scene, i: usize| {
        let (upper, lower) = (Wall::upper(&format!("u{i}"), 4e-3), Wall::lower(&format!("l{i}"), -4e-3));
        scene.with_wall(upper.at(Row::dof(i)).with_restitution(e)).with_wall(lower.at(Row::dof(i)).with_restitution(e))
    };
    let scene = chain(3, 150.0, 4e-3).with_load(on(Load::harmonic(2.0, 2.0, 0.0), 0)).with_duration(1.0);
    (0..3).fold(scene, walls)
}

#[test]
fn structures_are_of_order_two_through_impacts_and_rests() {
    for e in [0.7, 0.0] {
        let scene = struck_chain(e);
        let exact = run(&scene, &Scheme::Event, &Options::with_step(1e-3)).expect("an exact run");
        assert!(exact.trajectory.contacts().len() > 4);
        let order = order(&format!("chain, e = {e}"), |step| {
            let run = located(&scene, step);
            let pairs = run.state.q.iter().zip(&exact.state.q);
            pairs.map(|(a, b)| (a - b).abs()).fold(0.0, f64::max)
        });
        assert!((1.6..2.6).contains(&order), "e = {e}: {order}");
    }
}

#[test]
fn elastic_walls_are_of_order_two_with_and_without_dashpots() {
    for damping in [0.0, 20.0] {
        let scene = common::elastic(damping, 0.8).with_duration(1.0);
        let exact = EventDriven::displacements(&scene, 1e-3, 1.0);
        let order = order(&format!("dashpot {damping}"), |step| error(&scene, step, &exact));
        assert!((1.7..2.6).contains(&order), "damping {damping}: {order}");
    }
}

#[test]
fn contacts_with_elastic_walls_begin_at_their_instants_with_the_speed_there() {
    for damping in [0.0, 20.0] {
        let scene = common::elastic(damping, 0.8).with_duration(1.0);
        let exact = run(&scene, &Scheme::Event, &Options::with_step(1e-3)).expect("an exact run");
        let exact = exact.trajectory.contacts();
        let error = |step: f64, of: fn(&signorini::Contact) -> f64| {
            let made = located(&scene, step);
            assert_eq!(made.trajectory.contacts().len(), exact.len());
            let pairs = made.trajectory.contacts().iter().zip(exact);
            pairs.map(|(a, b)| (of(a) - of(b)).abs()).fold(0.0, f64::max)
        };
        let starts = order("starts", |step| error(step, |contact| contact.start));
        let speeds = order("speeds", |step| error(step, |contact| contact.approach_speed));
        assert!((1.7..2.6).contains(&starts) && (1.7..2.6).contains(&speeds), "{damping}: {starts} {speeds}");
    }
}

#[test]
fn blows_and_jumps_of_tables_divide_steps_at_their_instants() {
    let table = Table::new(vec![0.0777, 0.4213], vec![2.0, 1.0]).expect("a table");
    let scene = common::source(0.8, 0.8)
        .with_load(Load::impulse(0.05, 0.123_456))
        .with_load(Load::table(table))
        .with_duration(0.5);
    let exact = run(&scene, &Scheme::Event, &Options::with_step(1e-3)).expect("an exact run");
    let order = order("blow and table", |step| (located(&scene, step).state.q[0] - exact.state.q[0]).abs());
    assert!((1.7..2.5).contains(&order), "{order}");
    assert_eq!(located(&scene, 1e-3).trajectory.contacts().len(), exact.trajectory.contacts().len());
}

#[test]
fn more_impacts_than_a_step_can_be_divided_for_are_given_up_and_said() {
    // 2e4 m/s across a gap of 2 mm: 10 000 impacts in a step of a millisecond.
    let scene = Scene::oscillator(1.0, 0.0, 0.0)
        .with_wall(Wall::upper("upper", 1e-3))
        .with_wall(Wall::lower("lower", -1e-3))
        .with_initial(&[0.0], &[2e4])
        .with_duration(0.01);
    let run = run(&scene, &Scheme::Located, &Options::with_step(1e-3)).expect("a run");
    assert_eq!(run.findings, []);
    assert!(run.counters.steps_given_up > 0);
    assert!(run.notes.iter().any(|note| note.contains("without rebound")), "{:?}", run.notes);
    assert!(run.residuals.penetration_m <= 1e-15, "{}", run.residuals.penetration_m);
    // Every row is there, that at the end too, where the last step was given up.
    for steps in 1..40_u32 {
        let scene = scene.clone().with_duration(1e-3 * f64::from(steps));
        let run = signorini::run(&scene, &Scheme::Located, &Options::with_step(0.9e-3)).expect("a run");
        let time = run.trajectory.time();
        assert_eq!((time.len() as u64, time.last().copied()), (run.grid.rows + 1, Some(scene.duration)));
    }
}

#[test]
fn a_state_set_at_an_instant_of_the_grid_continues_with_the_same_steps() {
    for scene in [common::source(0.8, 0.8), struck_chain(0.0)] {
        let mut whole = Stepper::new(&scene, &Scheme::Located, 1e-3).expect("a stepper");
        let mut continued = Stepper::new(&scene, &Scheme::Located, 1e-3).expect("a stepper");
        let step_to = |stepper: &mut Stepper, end: f64| {
            while stepper.time() < end - 1e-9 {
                stepper.step().expect("a step");
            }
        };
        step_to(&mut whole, 0.3);
        continued.set_state(whole.time(), &whole.state()).expect("an instant of the grid");
        step_to(&mut whole, 0.6);
        step_to(&mut continued, 0.6);
        assert_eq!(whole.state(), continued.state());
    }
}

#[test]
fn steps_between_contacts_in_one_loop_are_those_one_by_one() {
    for scene in [common::source(0.8, 0.8), struck_chain(0.7)] {
        let mut single = Stepper::new(&scene, &Scheme::Located, 1e-3).expect("a stepper");
        let mut together = Stepper::new(&scene, &Scheme::Located, 1e-3).expect("a stepper");
        let mut impacts = 0;
        for _ in 0..20 {
            let (index, end, q) = {
                let step = together.advance_quiet(100).expect("steps");
                (step.index, step.end, step.q.to_vec())
            };
            while single.time() < end {
                single.step().expect("a step");
            }
            assert_eq!((single.time(), single.state().q), (end, q), "step {index}");
            impacts += u32::from(end < (index + 1) as f64 * 1e-3);
        }
        assert!(impacts > 3);
    }
}

#[test]
fn an_extra_force_acts_over_every_part_of_a_step() {
    // A constant load given from outside instead of by the scene.
    let scene = common::source(0.8, 0.8);
    let loaded = scene.clone().with_load(Load::constant(0.7));
    let mut inside = Stepper::new(&loaded, &Scheme::Located, 1e-3).expect("a stepper");
    let mut outside = Stepper::new(&scene, &Scheme::Located, 1e-3).expect("a stepper");
    for _ in 0..400 {
        inside.step().expect("a step");
        outside.step_with(&[0.7]).expect("a step");
        // The two sum the same forces in another order.
        assert!((inside.state().q[0] - outside.state().q[0]).abs() < 1e-13);
    }
    assert!(inside.counters().parts > 4);
}

#[test]
fn the_extra_force_of_each_part_is_the_one_given_for_it() {
    // A free mass of 1 kg meets a wall within the step: 1000 N over the part after that alone.
    let scene = Scene::oscillator(1.0, 0.0, 0.0).with_wall(Wall::upper("stop", 1e-4)).with_initial(&[0.0], &[1.0]);
    for forces in [[0.0, 1000.0], [1000.0, 0.0]] {
        let mut stepper = Stepper::new(&scene, &Scheme::Located, 1e-3).expect("a stepper");
        stepper.step_with(&[forces[0]]).expect("a part");
        let (time, speed) = (stepper.time(), stepper.state().v[0]);
        assert!(0.0 < time && time < 1e-3 && speed < 0.0, "{time} {speed}");
        stepper.step_with(&[forces[1]]).expect("the rest");
        let wanted = speed + forces[1] * (1e-3 - time);
        assert!((stepper.time() - 1e-3).abs() < 1e-18 && (stepper.state().v[0] - wanted).abs() < 1e-12);
    }
}

#[test]
fn steps_that_do_not_resolve_what_a_wall_strikes_or_a_change_of_a_table_are_said() {
    // Two masses of 1 kg on a link against a stop; the exact impulse of a stiff link is 1.04 N s.
    let linked = |stiffness: f64| {
        let link = [(0, 0, stiffness), (1, 0, -stiffness), (1, 1, stiffness)];
        let structure = Structure {
            mass: Symmetric::diagonal(&[1.0; 2]),
            damping: Symmetric::diagonal(&[0.0; 2]),
            stiffness: Symmetric::from_entries(2, link),
        };
        let wall = Wall::upper("stop", 5e-3).with_restitution(0.8);
        Scene::structure(structure).with_wall(wall).with_initial(&[0.0; 2], &[0.3; 2]).with_duration(0.05)
    };
    let said = |scene: &Scene, words: &str| located(scene, 1e-3).notes.iter().any(|note| note.contains(words));
    // ½h²k/m of the link: 5000 and 0.1.
    assert!(said(&linked(1e10), "does not resolve what the wall"));
    assert!(!said(&linked(2e5), "does not resolve what the wall"));
    // Between two rows within a step the load falls from 10 to 0.5 N, which moreau-jean passes over
    // and says; a step of a tenth of the time between rows resolves a triangle.
    let words = "passes over a change of the table of load 1 at 0.05";
    let notes = |scene: &Scene, scheme| run(scene, &scheme, &Options::with_step(1e-3)).expect("a run").notes;
    let passes = |notes: Vec<String>| notes.iter().any(|note| note.contains(words));
    assert!(passes(notes(&nearly_jumping(100.0), Scheme::MoreauJean { theta: 0.5 })));
    assert!(!passes(notes(&nearly_jumping(100.0), Scheme::Located)));
    let triangle = table(&[0.0, 0.0505, 0.101], &[0.0, 10.0, 0.0], 100.0);
    assert!(!notes(&triangle, Scheme::MoreauJean { theta: 0.5 }).iter().any(|note| note.contains("passes over")));
}

/// A mass of 1 kg on a spring (N/m) under a table.
fn table(time: &[f64], force: &[f64], stiffness: f64) -> Scene {
    let load = Load::table(Table::new(time.to_vec(), force.to_vec()).expect("a table"));
    Scene::oscillator(1.0, 0.0, stiffness).with_load(load).with_duration(0.1)
}

/// The load falls from 10 to 0.5 N between two rows 1e-7 s apart.
fn nearly_jumping(stiffness: f64) -> Scene {
    table(&[0.0, 0.0512345, 0.0512346, 0.2], &[10.0, 10.0, 0.5, 0.5], stiffness)
}

#[test]
fn a_jump_written_as_two_rows_divides_its_step() {
    // A free mass takes the impulse of the table; the rule has the mean of a straight line exactly.
    let scene = nearly_jumping(0.0);
    let wanted = 10.0 * 0.0512345 + 1e-7 * 5.25 + 0.5 * (0.1 - 0.0512346);
    for step in [1e-2, 1e-3] {
        let run = located(&scene, step);
        assert!((run.state.v[0] / wanted - 1.0).abs() < 1e-12, "{step}: {:?}", run.state);
    }
    // With a wall in the way as well.
    let struck = nearly_jumping(100.0).with_wall(Wall::upper("stop", 5e-3).with_restitution(0.8));
    let exact = run(&struck, &Scheme::Event, &Options::with_step(1e-3)).expect("an exact run").state.q[0];
    let errors = [1e-3, 2.5e-4].map(|step| (located(&struck, step).state.q[0] - exact).abs());
    assert!(errors[0] < 2e-5 && errors[1] < errors[0] / 8.0, "{errors:?}");
}

/// Speeds, gaps and steps in round numbers: a body strikes its wall where a step ends, to rounding,
/// and that step has the impact.
#[test]
fn an_impact_at_the_end_of_a_step_is_in_that_step() {
    for gap in [1e-3, 2e-3, 5e-3, 0.01, 0.02, 0.05] {
        for speed in [0.1, 0.2, 0.5, 0.8, 1.0, 2.0] {
            for parts in [5.0, 10.0, 20.0, 25.0, 40.0, 50.0, 64.0, 100.0] {
                let step = gap / speed / parts;
                let scene = Scene::oscillator(1.0, 0.0, 0.0)
                    .with_wall(Wall::upper("wall", gap).with_restitution(0.6))
                    .with_initial(&[0.0], &[speed])
                    .with_duration(2.0 * gap / speed);
                let run = run(&scene, &Scheme::Located, &Options::with_step(step)).expect("a run");
                let what = format!("{gap} m at {speed} m/s in {parts} steps: {:?}", run.findings);
                let judged = run.judged().expect("a judge");
                // The rounding of a speed.
                assert!(run.findings.is_empty() && judged.complementarity < 1e-12, "{what}");
                assert!((run.state.v[0] / speed + 0.6).abs() < 1e-15, "{what}");
                let mut stepper = Stepper::new(&scene, &Scheme::Located, step).expect("a stepper");
                while stepper.time() < (1.0 - 1e-9) * gap / speed {
                    stepper.step().expect("a step");
                }
                assert!(stepper.state().v[0] < 0.0, "{what}");
                // It comes back from where it was struck, the touching distance of 1e-12 in front.
                assert!((run.state.q[0] / gap - 0.4).abs() < 2e-12, "{what}: {}", run.state.q[0] / gap);
            }
        }
    }
}

#[test]
fn a_body_struck_between_flats_all_round_it_stays_between_them() {
    // Two pairs of flats without gaps, each with its restitution: the impacts end, and some of the
    // walls rest before the others do.
    for h in [1e-4, 1e-3, 3e-3] {
        for seed in 0..4 {
            let turn = 37.0 * f64::from(seed);
            let row = |degrees: f64| {
                let (sin, cos) = (degrees + turn).to_radians().sin_cos();
                Row::new(vec![(0, cos), (1, sin)])
            };
            let identity = |x: f64| Symmetric::diagonal(&[x, x]);
            let structure = Structure {
                mass: identity(1.027186489341313),
                damping: identity(0.0),
                stiffness: identity(21.64477422265029),
            };
            let mut scene = Scene::structure(structure)
                .with_load(Load { at: row(90.0), ..Load::impulse(0.03950999592959975, 0.12) })
                .with_initial(&[0.0, 0.0], &[0.01770852909999271, -0.11803313737360727])
                .with_duration(0.15);
            for (name, degrees, e) in [
                ("a", 123.37518898827526, 0.57),
                ("b", 243.37518898827526, 0.57),
                ("c", 311.38839862979347, 1.0),
                ("d", 401.38839862979347, 1.0),
            ] {
                scene = scene.with_wall(Wall::upper(name, 0.0).with_restitution(e).at(row(degrees)));
            }
            let found = run(&scene, &Scheme::Located, &Options::with_step(h)).expect("a run");
            assert_eq!(found.findings, [], "{h}, {turn}");
            let farthest = found.trajectory.displacements().iter().flatten().fold(0.0_f64, |most, q| most.max(q.abs()));
            // The touching distance, 1e-12 of a metre.
            assert!(farthest <= 2e-12, "{h}, {turn}: {farthest:e} m");
        }
    }
}

/// A blow drives a mass against its neighbour while the neighbour leaves the ground, which both
/// touch: the impacts follow each other as if the gaps were tiny. With two masses of 1 kg, speeds
/// 0.3 and −0.1 m/s and e = ½: the masses strike with 0.3 N s (0 and 0.2 m/s), the second the
/// ground with 0.3 N s (−0.1 m/s), and the masses each other with 0.075 N s.
#[test]
fn a_wall_that_is_left_has_no_part_in_an_impact() {
    let pile = |gap: f64| {
        let [mass, damping, stiffness] = [1.0, 0.0, 0.0].map(|x| Symmetric::diagonal(&[x; 2]));
        Scene::structure(Structure { mass, damping, stiffness })
            .with_wall(Wall::upper("masses", gap).with_restitution(0.5).at(Row::new(vec![(0, 1.0), (1, -1.0)])))
            .with_wall(Wall::upper("ground", gap).with_restitution(0.5).at(Row::dof(1)))
            .with_initial(&[0.0; 2], &[0.3, -0.1])
            .with_duration(0.1)
    };
    for gap in [0.0, 1e-12, 1e-9] {
        let run = located(&pile(gap), 1e-3);
        let impulse =
            |wall: usize| run.trajectory.contacts().iter().filter(|c| c.wall == wall).map(|c| -c.impulse).sum::<f64>();
        // A gap shifts the impacts by 1e-8 s, during which nothing accelerates.
        let near = |a: f64, b: f64| assert!((a - b).abs() < 1e-14, "gap {gap:e}: {a}, {b}");
        near(run.state.v[0], -0.075);
        near(run.state.v[1], -0.025);
        near(impulse(0), 0.375);
        near(impulse(1), 0.3);
    }
}
