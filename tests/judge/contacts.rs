//! The table of contacts, against closed forms and the exact motion.

use crate::common::event_driven::EventDriven;
use crate::common::{self, MOREAU_JEAN, schemes, schemes_of_whole_steps, source};
use signorini::{
    Chain, Contact, Integrator, Load, Options, Row, Scene, Scheme, Stepper, Table, TimeOptions, Wall, run,
};

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
                // The motion itself is known to 1e-3 of the gap and 1e-2 of its speed at this step:
                // 5e-6 m at 0.1 m/s.
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
    // Sharing a spring between steps, an order-one scheme is off by some 10 h of relative energy
    // loss; the others by h where a contact begins or ends within a step.
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
        // The impact of the landing has no finite force: the peak is the weight, or what an impact
        // leaves of the same order.
        assert!(contact.peak_force.is_some_and(|p| p < 3.0 * 9.81), "{what}");
    }
    // Without the lift it is open at the end.
    for scheme in schemes() {
        let found = contacts(&common::ball(0.0, 0.0), &scheme, h);
        let [contact] = found[..] else { panic!("{scheme}: {found:?}") };
        assert_eq!((contact.end, contact.departure_speed), (None, None), "{scheme}");
    }
}

/// Where in a step a scheme's contact impulse acts, as a share of it: the multiplier of a
/// position-level rule is the force at its end, that of a staggered one is the force at its start,
/// an impulse on the velocity stands for the whole step.
fn instant(scheme: &Scheme) -> f64 {
    match scheme {
        Scheme::ImplicitEuler | Scheme::Newmark => 1.0,
        Scheme::PaoliSchatzman => 0.0,
        Scheme::Penalty { integrator: Integrator::ImplicitEuler, .. } => 1.0,
        Scheme::Penalty { integrator: Integrator::CentralDifference, .. } => 0.0,
        _ => 0.5,
    }
}

/// One wall's episodes, put together from the steps by their definition: runs of steps with an
/// impulse, times and sums alone.
#[derive(Debug, Default)]
struct Joined {
    start: f64,
    end: f64,
    steps: u32,
    impulse: f64,
    moment: f64,
    peak: f64,
}

#[test]
fn the_table_joins_the_steps_in_which_a_wall_pushes() {
    let scenes = [
        ("rigid", source(0.8, 0.4)),
        ("elastic and rigid", common::elastic(3.0, 0.5)),
        ("elastic", common::all_elastic(1.0)),
    ];
    for (name, scene) in scenes {
        // The instants of contacts are those of the grid.
        for scheme in schemes_of_whole_steps() {
            let h = 1e-4;
            let mut stepper = Stepper::new(&scene, &scheme, h).expect("a sound scene");
            let rigid: Vec<bool> = stepper.scene().walls.iter().map(|wall| wall.law.is_rigid()).collect();
            let mut open: Vec<Option<Joined>> = vec![None, None];
            let (mut lasting, mut impacts) = (0, 0);
            for _ in 0..20_000 {
                let step = stepper.step().expect("a step");
                let at = step.start + instant(&scheme) * h;
                for (wall, open) in open.iter_mut().enumerate() {
                    let p = step.impulse[wall];
                    let closed = step.closed.iter().find(|contact| contact.wall == wall);
                    if p == 0.0 {
                        let Some(joined) = open.take() else {
                            assert!(closed.is_none(), "{name}, {scheme}: {closed:?} at {at} s");
                            continue;
                        };
                        let contact = closed.expect("an episode that has ended");
                        let what = format!("{name}, {scheme}: {contact:?}, {joined:?}");
                        // An impact takes up to two steps at a rigid wall, and has one instant:
                        // that of its impulse on the average.
                        let impact = rigid[wall] && joined.steps <= 2;
                        let mean = joined.moment / joined.impulse;
                        let (start, end) = if impact { (mean, mean) } else { (joined.start, joined.end) };
                        // Sums of a few terms, and of at most a period's steps.
                        let near =
                            |found: f64, expected: f64, share: f64| (found - expected).abs() <= share * expected.abs();
                        assert!(near(contact.start, start, 1e-15), "{what}: {start}");
                        assert!(near(contact.end.expect("closed"), end, 1e-15), "{what}: {end}");
                        assert!(near(contact.impulse, joined.impulse, 1e-12), "{what}");
                        // A spring has a largest force; an impact has none, and nor has a rest as
                        // long as it consists of impacts.
                        match contact.peak_force {
                            None => assert!(rigid[wall], "{what}"),
                            Some(peak) => assert!(!impact && near(peak, joined.peak, 1e-15), "{what}"),
                        }
                        if impact {
                            impacts += 1
                        } else {
                            lasting += 1
                        }
                        continue;
                    }
                    assert!(closed.is_none(), "{name}, {scheme}: {closed:?} at {at} s");
                    let joined = open.get_or_insert(Joined { start: at, ..Joined::default() });
                    joined.end = at;
                    joined.steps += 1;
                    joined.impulse += p;
                    joined.moment += p * at;
                    let finite = !rigid[wall] || joined.steps > 2 && step.velocity_before[0].abs() <= 1e-2 * p.abs();
                    joined.peak = joined.peak.max(if finite { p.abs() / h } else { 0.0 });
                }
            }
            // Each scene contains what it is meant to test: a spring pushes for long, an impact is
            // over at once.
            assert!(lasting > 0 || rigid.iter().all(|&rigid| rigid), "{name}, {scheme}");
            assert!(impacts > 0 || !rigid.contains(&true) || !lands_at_once(&scheme), "{name}, {scheme}");
        }
    }
}

/// True for schemes that leave a rigid wall by its restitution, one or two steps after they met it.
fn lands_at_once(scheme: &Scheme) -> bool {
    matches!(scheme, Scheme::PaoliSchatzman | Scheme::MoreauJean { .. } | Scheme::GeneralizedAlpha { .. })
}

#[test]
fn a_free_body_turns_round_at_the_instant_of_its_impact() {
    // Wherever the impact falls in a step: the lines on which the body comes and goes cross at the
    // instant that the table gives. For moreau-jean that is the middle of the step in which ½hv
    // takes it to the wall. The bound of paoli-schatzman mirrors the displacement of two steps
    // before, so the body leaves as if from the wall 2h after it came there: the lines cross 2eh/(1
    // + e) after.
    let (h, v) = (1e-2, 0.3);
    for e in [1.0, 0.5, 0.05] {
        for phase in 1..20 {
            let wall = 1.0 + f64::from(phase) * 0.05 * v * h;
            for side in [1.0, -1.0] {
                let stop = if side > 0.0 { Wall::upper("stop", wall) } else { Wall::lower("stop", -wall) };
                let scene = Scene::oscillator(1.0, 0.0, 0.0)
                    .with_wall(stop.with_restitution(e))
                    .with_initial(&[0.0], &[side * v])
                    .with_duration(6.0);
                for scheme in [MOREAU_JEAN, Scheme::PaoliSchatzman] {
                    let run = run(&scene, &scheme, &Options::with_step(h)).expect("a run");
                    let [contact] = run.trajectory.contacts() else {
                        panic!("{scheme}: {:?}", run.trajectory.contacts())
                    };
                    let what = format!("{scheme}, e = {e}, phase {phase}: {contact:?}");
                    assert_eq!((contact.end, contact.peak_force), (Some(contact.start), None), "{what}");
                    let (t, q) = (run.trajectory.time(), run.trajectory.displacement());
                    // side (q_end − e v (t_end − t)·(−1)) = v t where the lines meet.
                    let (last, end) = (side * q[q.len() - 1], t[t.len() - 1]);
                    let crossing = (last + e * v * end) / (v + e * v);
                    // Sums of 600 steps, of 6 s and 1.8 m at most.
                    assert!((contact.start - crossing).abs() < 1e-12, "{what}: {crossing}");
                    let arrival = wall / v;
                    let late = contact.start - arrival;
                    let found = match scheme {
                        Scheme::PaoliSchatzman => (late - 2.0 * e * h / (1.0 + e)).abs() < 1e-12,
                        _ => (-1e-12..h + 1e-12).contains(&late),
                    };
                    assert!(found, "{what}: {late:e} s after {arrival}");
                }
            }
        }
    }
}

#[test]
fn a_push_of_two_steps_is_an_impact_and_one_of_three_lasts() {
    // A body that lies on a stop is pressed onto it for some steps and then pulled off.
    let h = 1e-2;
    for pushed in 1..6_u32 {
        let until = f64::from(pushed) * h;
        let edge = 1e-3 * h;
        for (scheme, from, to) in [
            // The load at the start of a step, at its end, or its mean: the table turns where the
            // last of them is taken.
            (Scheme::PaoliSchatzman, until - h + edge, until - edge),
            (Scheme::ImplicitEuler, until + edge, until + h - edge),
            (MOREAU_JEAN, until, until + edge),
        ] {
            let table = Table::new(vec![0.0, from, to, 1.0], vec![2.0, 2.0, -2.0, -2.0]).expect("a sound table");
            let scene = Scene::oscillator(1.0, 0.0, 0.0)
                .with_wall(Wall::upper("stop", 0.1))
                .with_load(Load::table(table))
                .with_initial(&[0.1], &[0.0])
                .with_duration(0.2);
            let found = contacts(&scene, &scheme, h);
            let [contact] = found[..] else { panic!("{scheme}: {found:?}") };
            let what = format!("{scheme}, {pushed} steps: {contact:?}");
            let (first, last) = (instant(&scheme) * h, (f64::from(pushed) - 1.0 + instant(&scheme)) * h);
            let near = |found: f64, expected: f64| (found - expected).abs() < 1e-15;
            assert!((contact.impulse + 2.0 * until).abs() < 1e-15, "{what}");
            if pushed <= 2 {
                let mean = 0.5 * (first + last);
                assert!(near(contact.start, mean) && contact.end == Some(contact.start), "{what}");
                assert_eq!(contact.peak_force, None, "{what}");
            } else {
                assert!(near(contact.start, first) && near(contact.end.expect("closed"), last), "{what}");
                assert!((contact.peak_force.expect("a force that lasts") - 2.0).abs() < 1e-12, "{what}");
            }
        }
    }
}

#[test]
fn a_body_that_stands_at_a_wall_without_pressing_is_not_in_contact() {
    // Its spring carries the load up to a unit in the last place, which is rounding and no force.
    for i in 1..60 {
        let (place, k) = (f64::from(i) / 97.0, 31.0 + f64::from(i) / 7.0);
        let force = (k * place).next_up();
        let forever = |force: f64| Load::table(Table::new(vec![0.0, 9.0], vec![force, force]).expect("a sound table"));
        for (wall, place, force) in
            [(Wall::upper("wall", place), place, force), (Wall::lower("wall", -place), -place, -force)]
        {
            for load in [Load::constant(force), forever(force)] {
                for scheme in common::CONSTRAINED {
                    let scene = Scene::oscillator(1.0, 0.1, k)
                        .with_wall(wall.clone())
                        .with_load(load.clone())
                        .with_initial(&[place], &[0.0])
                        .with_duration(0.1);
                    let found = contacts(&scene, &scheme, 1e-2);
                    assert_eq!(found, [], "{scheme}, {force} N at {place} m");
                }
            }
        }
        // Some hundred units in the last place are a force.
        let scene = Scene::oscillator(1.0, 0.1, k)
            .with_wall(Wall::lower("wall", -place))
            .with_load(Load::constant(-force * (1.0 + 1e-13)))
            .with_initial(&[-place], &[0.0])
            .with_duration(0.1);
        assert_eq!(contacts(&scene, &MOREAU_JEAN, 1e-2).len(), 1);
    }
}

/// The impulses (N s) of a scene's contacts by `scheme` in ten steps of 10 ms.
fn impulses(scene: &Scene, scheme: &Scheme) -> Vec<f64> {
    contacts(&scene.clone().with_duration(0.1), scheme, 1e-2).iter().map(|contact| contact.impulse).collect()
}

#[test]
fn what_counts_as_rounding_is_measured_by_the_scene_whatever_its_signs() {
    // As above, with loads of either sign in every form: sizes count, not signs. The place is on
    // the other side of 0 from where the load presses, and the spring carries all of it.
    let steady = |force: f64| {
        let table = Table::new(vec![0.0, 9.0], vec![force, force]).expect("a sound table");
        // A cosine of 1e-9 Hz, 1 to the last place for longer than this lasts.
        [
            Load::constant(force),
            Load::table(table),
            Load::harmonic(-force, 1e-9, -0.5 * std::f64::consts::PI),
            Load::harmonic(force, 1e-9, 0.5 * std::f64::consts::PI),
        ]
    };
    let structure = |k: f64| {
        let one = |x: f64| signorini::linear::Symmetric::diagonal(&[x]);
        Scene::structure(signorini::Structure { mass: one(1.0), damping: one(0.1), stiffness: one(k) })
    };
    for i in 1..30 {
        let (place, k) = (f64::from(i) / 97.0, 31.0 + f64::from(i) / 7.0);
        for sign in [1.0, -1.0] {
            let wall = if sign > 0.0 { Wall::upper("wall", place) } else { Wall::lower("wall", -place) };
            let force = sign * (k * place).next_up();
            for load in steady(force) {
                for scheme in common::CONSTRAINED {
                    // As a structure, it has the loads alone to measure by.
                    for system in [Scene::oscillator(1.0, 0.1, k), structure(k)] {
                        let scene = system
                            .with_wall(wall.clone())
                            .with_load(load.clone())
                            .with_initial(&[sign * place], &[0.0]);
                        assert_eq!(impulses(&scene, &scheme), Vec::<f64>::new(), "{scheme}, {load:?} at {place} m");
                    }
                }
            }
        }
    }
}

#[test]
fn a_force_of_any_size_is_a_force_where_nothing_larger_acts() {
    // Half the scene's scales are 0: a free body of 1 kg is held by a stop, against a force that
    // would drown in the rounding of 1 N, or of a spring of 1 N/m. The velocity that a step gives
    // it is 1e-18 m/s, and moreau-jean answers just that.
    let force = 1e-16;
    let table = Table::new(vec![0.0, 9.0], vec![force, force]).expect("a sound table");
    let structure = signorini::Structure {
        mass: signorini::linear::Symmetric::diagonal(&[1.0]),
        damping: signorini::linear::Symmetric::zeros(1),
        stiffness: signorini::linear::Symmetric::zeros(1),
    };
    for scene in [Scene::oscillator(1.0, 0.0, 0.0), Scene::structure(structure)] {
        for load in [Load::constant(force), Load::table(table.clone())] {
            let scene = scene
                .clone()
                .with_wall(Wall::upper("stop", 0.5).with_restitution(0.0))
                .with_load(load)
                // A blow that does nothing is no force.
                .with_load(Load::impulse(0.0, 0.0))
                .with_initial(&[0.5], &[0.0]);
            let found = impulses(&scene, &MOREAU_JEAN);
            let [impulse] = found[..] else { panic!("{found:?}") };
            // A sum of ten equal numbers.
            assert!((impulse / (-0.1 * force) - 1.0).abs() < 1e-14, "{impulse:e} N s");
        }
    }
}

#[test]
fn the_rounding_of_an_impulse_is_that_of_its_own_terms() {
    // Each scene has one product that a sum, or a sum that a product, would make 30 times larger or
    // more: the force pressed with is between the two, and some units in the last place larger than
    // what is lost. It is a force.
    //
    // 1e4 N carried by a spring, and 1e-13 of that over it: 1e-9 N, against 2e4 N rounded to
    // 3.6e-11 N; 1e4 N · 1e4 N would be rounded to 1.8e-7 N².
    let (k, place) = (1e6, 1e-2);
    let stiff = Scene::oscillator(1.0, 100.0, k)
        .with_wall(Wall::upper("stop", place).with_restitution(0.0))
        .with_load(Load::constant(k * place * (1.0 + 1e-13)))
        .with_initial(&[place], &[0.0]);
    assert_eq!(impulses(&stiff, &MOREAU_JEAN).len(), 1);
    // And where both are small, what is lost is more than the product: 1e-6 N and 1 unit in its
    // last place.
    for i in 1..30 {
        let k = 1e-4 * (1.0 + f64::from(i) / 7.0);
        let faint = Scene::oscillator(1.0, 0.0, k)
            .with_wall(Wall::upper("stop", place).with_restitution(0.0))
            .with_load(Load::constant((k * place).next_up()))
            .with_initial(&[place], &[0.0]);
        assert_eq!(impulses(&faint, &MOREAU_JEAN), Vec::<f64>::new(), "{k} N/m");
    }
    // An elastic wall of 1000 N/m beside a spring of 31 N/m: 1062 N/m · place is rounded to 1.9e-12
    // N/m · place, and 4e-13 · 31 N/m · place is pressed with, 1.2e-11; the product of the two
    // stiffnesses would be rounded to 5.5e-11.
    let (k, own, place) = (31.0, 1000.0, 0.3);
    let soft = |over: f64| {
        Scene::oscillator(1.0, 0.0, k)
            .with_wall(Wall::upper("pad", place).with_elasticity(own, 0.0))
            .with_load(Load::constant(k * place * (1.0 + over)))
            .with_initial(&[place], &[0.0])
    };
    assert_eq!(impulses(&soft(4e-13), &MOREAU_JEAN).len(), 1);
    // A unit in the last place of the place, times the wall's stiffness, is rounding: 1000 N/m ·
    // 5.6e-17 m, as much as 6e-15 of the load. The load's own is 1.6 N less the wall's 300 N: sizes
    // add up.
    for i in 1..30 {
        let place = 0.3 + f64::from(i) / 97.0;
        for scheme in common::CONSTRAINED {
            let scene = Scene::oscillator(1.0, 0.1, k)
                .with_wall(Wall::upper("pad", place).with_elasticity(own, 0.0))
                .with_load(Load::constant((k * place).next_up()))
                .with_initial(&[place], &[0.0]);
            assert_eq!(impulses(&scene, &scheme), Vec::<f64>::new(), "{scheme}, {place} m");
        }
    }
    // A heavy free body at 1 mm: a displacement is rounded to 1e-3 m · 1e6 kg, not to 1e6 kg and
    // 1e-3 m together. 2e-6 N for 10 ms are 2e-8 N s, and what is lost is 1.8e-10.
    let heavy = Scene::oscillator(1e6, 0.0, 0.0)
        .with_wall(Wall::upper("stop", 1e-3).with_restitution(0.0))
        .with_load(Load::constant(2e-6))
        .with_initial(&[1e-3], &[0.0]);
    for scheme in [Scheme::ImplicitEuler, Scheme::PaoliSchatzman] {
        let found = impulses(&heavy, &scheme);
        let [impulse] = found[..] else { panic!("{scheme}: {found:?}") };
        // Ten steps, each known to a hundredth; the first of paoli-schatzman is half a step's.
        assert!((impulse / -2e-7 - 1.0).abs() < 0.06, "{scheme}: {impulse:e} N s");
    }
}

/// 1 kg rests on the ground under 5 N, and another kilogram falls onto it at 1 m/s: what the ground
/// gives at that impact is no force of the rest.
#[test]
fn an_impact_that_the_structure_passes_on_is_no_force_of_a_contact_that_lasts() {
    let chain = Chain { masses: vec![1.0, 1.0], springs: vec![0.0], grounds: [0.0, 0.0] };
    let scene = Scene::structure(chain.structure().unwrap())
        .with_wall(Wall::lower("ground", 0.0).with_restitution(0.5))
        .with_wall(Wall::lower("between", -0.1).at(Row::new(vec![(0, -1.0), (1, 1.0)])).with_restitution(0.8))
        .with_load(Load { at: Row::dof(0), ..Load::constant(-5.0) })
        .with_initial(&[0.0, 0.0], &[0.0, -1.0])
        .with_duration(0.4);
    for scheme in [Scheme::MoreauJean { theta: 0.5 }, Scheme::Located, Scheme::Event] {
        for step in [1e-2, 1e-3, 1e-4] {
            let run = run(&scene, &scheme, &Options::with_step(step)).unwrap();
            let rest = run.trajectory.contacts().iter().filter(|contact| contact.wall == 0);
            let peak = rest.filter_map(|contact| contact.peak_force).fold(0.0, f64::max);
            assert!((peak - 5.0).abs() < 1e-9, "{scheme}, {step}: {peak}");
        }
    }
}

/// 2 kg that fall and stay have lost all they brought, though their contact has not ended.
#[test]
fn what_rests_at_the_end_has_left_with_nothing() {
    for scheme in [Scheme::Event, Scheme::Located, Scheme::MoreauJean { theta: 0.5 }] {
        let scene = Scene::oscillator(2.0, 0.0, 0.0)
            .with_wall(Wall::lower("ground", 0.0).with_restitution(0.0))
            .with_load(Load::constant(-4.0))
            .with_initial(&[0.01], &[0.0])
            .with_duration(1.0);
        let run = run(&scene, &scheme, &Options::with_step(1e-3)).unwrap();
        // The work of 4 N over 1 cm, within a second; a step's way in the speed of moreau-jean.
        let lost = run.statistics.walls[0].arrived_less_departed_power_w;
        assert!((lost - 0.04).abs() < 1e-3, "{scheme}: {lost}");
    }
}

/// The force of a spring with a dashpot vanishes before the body has left the wall's face, within a
/// part of a step: the speed is that of the same instant.
#[test]
fn located_tells_the_speed_with_which_a_body_leaves_a_damped_spring_to_order_two() {
    for damping in [0.0, 120.0] {
        let scene = Scene::oscillator(2.0, 8.0, 2e4)
            .with_wall(Wall::upper("stop", 3e-3).with_elasticity(3e5, damping))
            .with_load(Load::harmonic(60.0, 15.0, 0.3))
            .with_duration(0.5);
        let exact = contacts(&scene, &Scheme::Event, 1e-3);
        let error = |h: f64| {
            let found = contacts(&scene, &Scheme::Located, h);
            assert!(found.len() == exact.len() && found.len() > 4, "{} {}", found.len(), exact.len());
            let pairs = found.iter().zip(&exact).filter_map(|(a, b)| Some((a.departure_speed?, b.departure_speed?)));
            pairs.map(|(a, b)| (a / b - 1.0).abs()).fold(0.0, f64::max)
        };
        // A quarter of the step leaves a sixteenth of the error, 4.5e-4 and 2.4e-4 at first; its
        // share of three terms of the next order is a quarter more.
        let [coarse, fine, finest] = [1e-4, 2.5e-5, 6.25e-6].map(error);
        assert!(coarse < 1e-3 && fine < coarse / 12.0 && finest < fine / 12.0, "{coarse} {fine} {finest}");
    }
}

/// A free mass that strikes a spring pushes it with F sin(ω(t − t₀)), whatever the part of the
/// contact in which the window of the statistics begins.
#[test]
fn the_largest_force_of_a_contact_that_began_before_the_window_is_that_within_it() {
    let scene = Scene::oscillator(1.0, 0.0, 0.0)
        .with_wall(Wall::upper("stop", 0.0).with_elasticity(1e4, 0.0))
        .with_initial(&[-0.01], &[1.0])
        .with_duration(0.1);
    for from in [0.0101, 0.012, 0.02, 0.035, 0.0405] {
        let phase = 100.0 * (from - 0.01);
        let expected = if phase < 0.5 * std::f64::consts::PI { 100.0 } else { 100.0 * phase.sin() };
        // Exact at instants, and to 1e-5 at a crest between two of its pieces; on a grid the mean
        // over a step is less by half a step of its slope.
        for (scheme, off) in [(Scheme::Event, 1e-5 * expected), (Scheme::Located, 0.6), (MOREAU_JEAN, 0.6)] {
            for averaging in [1e-4, 1e-3, 1e-2] {
                let time =
                    TimeOptions { statistics_from: from, force_averaging: averaging, ..TimeOptions::with_step(1e-4) };
                let run = run(&scene, &scheme, &Options::new(time)).expect("a run");
                let largest = run.statistics.walls[0].force_largest.expect("a push");
                let found = (largest.mean_n - expected).abs();
                assert!(found <= off && largest.averaged_over_s == 0.0, "{scheme}, {from} s: {largest:?} {expected}");
                assert!(largest.at_s >= from, "{largest:?}");
            }
        }
    }
}

/// A blow pulls the body off a damped spring that still pushes: the contact ends at the blow.
#[test]
fn a_blow_ends_a_contact_of_located_at_its_instant() {
    let scene = Scene::oscillator(1.0, 0.5, 100.0)
        .with_wall(Wall::upper("stop", 0.0).with_elasticity(1e4, 20.0))
        .with_load(Load::impulse(-1.5, 0.0371))
        .with_initial(&[-0.0101], &[1.0])
        .with_duration(0.06);
    let exact = contacts(&scene, &Scheme::Event, 1e-3);
    let departed = exact[0].departure_speed.unwrap();
    for h in [1e-3, 2.5e-4, 3.1e-5] {
        let found = contacts(&scene, &Scheme::Located, h);
        assert_eq!((found.len(), found[0].end, exact[0].end), (1, Some(0.0371), Some(0.0371)));
        // Of order 2: 6e-5 m/s at the first step.
        let off = (found[0].departure_speed.unwrap() - departed).abs();
        assert!(off < 100.0 * h * h, "{h}: {off:e}");
    }
}
