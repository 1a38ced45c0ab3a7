//! Many steps in one call: the same steps, contacts and errors as one by one, to the last bit.

use crate::common::{MOREAU_JEAN, source};
use crate::random_structures::{Draws, random_scene};
use signorini::{Interrupt, Load, Scene, Scheme, Step, Stepper, Table, Wall};

/// What a step shows, by its bits: its number, times, state, impulses and the ends of the episodes.
fn shown(step: &Step<'_>) -> (u64, Vec<u64>, Vec<[u64; 2]>) {
    let numbers = [step.start, step.end].into_iter().chain(step.q.iter().chain(step.v).copied());
    let numbers = numbers.chain(step.velocity_before.iter().chain(step.velocity_after).copied());
    let numbers = numbers.chain(step.impulse.iter().chain(step.force).chain(step.extra).copied());
    let closed = step.closed.iter().map(|contact| [contact.start, contact.impulse].map(f64::to_bits));
    (step.index, numbers.map(f64::to_bits).collect(), closed.collect())
}

/// Goes through `count` steps one by one and, beside it, in glides of at most `most` steps; returns
/// the largest number of steps in one call.
fn compare(scene: &Scene, scheme: &Scheme, h: f64, (count, most): (u64, u64)) -> u64 {
    let stepper = || Stepper::new(scene, scheme, h).expect("a scene");
    let (mut one, mut many, mut made, mut longest) = (stepper(), stepper(), 0, 0);
    while made < count {
        let step = many.advance_quiet(most).expect("steps");
        let steps = step.index + 1 - made;
        assert!((1..=most).contains(&steps), "{scheme}: {steps} of {most} steps");
        for k in 1..=steps {
            let alone = one.step().expect("a step");
            let met = alone.impulse.iter().any(|&p| p != 0.0) || !alone.closed.is_empty();
            assert!(k == steps || !met, "{scheme}: step {} met a wall and was passed over", alone.index);
            if k == steps {
                assert!(met || steps == most, "{scheme}: it stopped at step {} without a contact", alone.index);
                assert_eq!(shown(&step), shown(&alone), "{scheme}");
            }
        }
        (made, longest) = (made + steps, longest.max(steps));
    }
    assert_eq!(many.counters(), one.counters(), "{scheme}");
    assert_eq!(many.open_contacts(), one.open_contacts(), "{scheme}");
    longest
}

#[test]
fn one_degree_of_freedom_makes_the_same_steps() {
    let table = Table::new(vec![0.0, 0.7, 1.6], vec![0.0, 1.0, -1.0]).expect("a table");
    let scenes = [
        source(0.8, 0.8),
        source(0.0, 0.0),
        source(0.8, 0.8).with_load(Load::table(table)).with_load(Load::constant(-0.3)),
        // A blow, and a wall that is a spring, leave every step to the usual way.
        source(0.8, 0.8).with_load(Load::impulse(0.02, 0.3)),
        source(0.8, 0.8).with_wall(Wall::upper("spring", 4e-3).with_elasticity(1e4, 1.0)),
        Scene::oscillator(1.0, 0.0, 100.0).with_initial(&[0.01], &[0.0]),
    ];
    for (number, scene) in scenes.iter().enumerate() {
        for most in [1, 7, 1000, u64::MAX / 2] {
            let count = if most > 1_000_000 && scene.walls.is_empty() { continue } else { 5000 };
            let longest = compare(scene, &MOREAU_JEAN, 1e-4, (count, most));
            assert!(number > 2 || longest > most.min(100) / 2, "{longest} of {most}");
        }
    }
}

#[test]
fn every_scheme_and_structure_makes_the_same_steps() {
    for scheme in [MOREAU_JEAN, Scheme::PaoliSchatzman, Scheme::GeneralizedAlpha { rho: 0.8 }] {
        compare(&source(0.8, 0.8), &scheme, 1e-4, (3000, 100));
    }
    compare(&source(0.8, 0.8), &Scheme::Event, 0.05, (200, 30));
    let mut draws = Draws::new(7);
    for _ in 0..40 {
        let scene = random_scene(&mut draws);
        compare(&scene, &MOREAU_JEAN, 1e-3 * scene.duration, (300, 1 + draws.below(40) as u64));
    }
}

#[test]
fn an_extra_force_ends_with_its_step() {
    let scene = source(0.8, 0.8);
    let stepper = || Stepper::new(&scene, &MOREAU_JEAN, 1e-4).expect("a scene");
    let (mut one, mut many) = (stepper(), stepper());
    one.step_with(&[2.0]).expect("a step");
    many.step_with(&[2.0]).expect("a step");
    // No wall is near in the first 5 ms.
    for _ in 1..50 {
        one.step().expect("a step");
    }
    assert_eq!(shown(&many.advance_quiet(50).expect("steps")), shown(&one.step().expect("a step")));
}

#[test]
fn a_motion_that_becomes_infinite_is_told_at_its_step() {
    let scene = Scene::oscillator(1.0, 0.0, 0.0).with_load(Load::constant(1e306));
    let stepper = || Stepper::new(&scene, &MOREAU_JEAN, 1.0).expect("a scene");
    let (mut one, mut many) = (stepper(), stepper());
    let alone = (0..1000).find_map(|_| one.step().err()).expect("an infinite speed");
    assert_eq!(many.advance_quiet(1000).err().map(|error| error.to_string()), Some(alone.to_string()));
}

#[test]
fn it_can_be_stopped() {
    let scene = Scene::oscillator(1.0, 0.0, 100.0).with_initial(&[0.01], &[0.0]);
    let stop = Interrupt::new(|| true);
    // Years of work if it went on.
    let end = stop.over(|| Stepper::new(&scene, &MOREAU_JEAN, 1e-4)?.advance_quiet(u64::MAX).map(|step| step.index));
    assert_eq!(end.map_err(|error| error.to_string()), Err(signorini::Error::Stopped.to_string()));
}
