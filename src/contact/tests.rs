//! What counts as rounding, and which forces of an episode are finite.

use super::*;
use crate::linear::Symmetric;
use crate::scene::{Load, PlaneRows, Row, Structure, Wall, WallLaw};
use crate::step::{Balance, Bound, Conserves, Promise, Tolerances};

fn contract(hole: Option<Bound>) -> Contract {
    Contract {
        balance: Balance::Exact,
        promise: Promise { hole, ..Promise::throughout() },
        instant: 0.5,
        tolerances: Tolerances::of(Conserves::Nothing),
        divides: false,
    }
}

/// The limits at an elastic hole by load (N), stiffness (N/m), gap (m) and mass (kg).
fn at_hole([load, stiffness, gap, mass]: [f64; 4]) -> [f64; 2] {
    let unit = |x: f64| Symmetric::diagonal(&[x, x]);
    let structure = Structure { mass: unit(mass), damping: unit(0.0), stiffness: unit(1.0) };
    let mut scene = Scene::structure(structure).with_load(Load::constant(-load));
    let at = PlaneRows { y: Row::dof(0), z: Row::dof(1) };
    let wall = Wall { law: WallLaw::Elastic { stiffness, damping: 0.0 }, ..Wall::round("ring", at.clone(), gap) };
    scene = scene.with_support("ring", at, [0.0; 2], vec![wall]);
    let floor = Floor::all(&scene, &[mass], contract(Some(Bound::End)))[0];
    // A scheme that bounds velocities has no rounding of displacements.
    assert_eq!(Floor::all(&scene, &[mass], contract(None))[0].inertia, 0.0);
    [floor.force, floor.inertia]
}

#[test]
fn rounding_at_a_hole_grows_with_what_acts_there_and_has_its_units() {
    let base = [3.0, 200.0, 0.25, 2.0];
    let [force, inertia] = at_hole(base);
    // Some units in the last place of 3 N + 50 N, and of 0.5 kg m.
    for (limit, size) in [(force, 53.0), (inertia, 0.5)] {
        assert!(limit >= f64::EPSILON * size && limit < 100.0 * f64::EPSILON * size, "{limit:e}");
    }
    assert!(at_hole([30.0, 200.0, 0.25, 2.0])[0] > force && at_hole([3.0, 300.0, 0.25, 2.0])[0] > force);
    // Lengths eight times as large, then masses, then times of half the length; powers of two do
    // not round.
    for (units, grown) in
        [([8.0, 1.0, 8.0, 1.0], [8.0, 8.0]), ([4.0, 4.0, 1.0, 4.0], [4.0, 4.0]), ([4.0, 4.0, 1.0, 1.0], [4.0, 1.0])]
    {
        let other = at_hole(std::array::from_fn(|i| base[i] * units[i]));
        assert_eq!(other, [force * grown[0], inertia * grown[1]], "{units:?}");
    }
}

#[test]
fn the_first_two_steps_of_a_lasting_contact_are_no_force() {
    // 1 kg arrives in two steps, and is then held by 1 N.
    let scene = Scene::oscillator(1.0, 0.0, 0.0).with_wall(Wall::upper("stop", 1.0));
    let mut episodes = Episodes::new(&scene, &[1.0], contract(None));
    let h = 0.125;
    for (step, (impulse, speed)) in [(-10.0, 10.0), (-10.0, 0.0), (-h, 0.0), (-h, 0.0)].into_iter().enumerate() {
        let rates = Rates { before: speed, struck: speed, after: 0.0 };
        episodes.observe(step as f64 * h, h, &[impulse], &[0], |_| rates);
        let open = episodes.still_open();
        // An impact so far, without a finite force; then that of the third step.
        assert_eq!((open.len(), open[0].peak_force), (1, (step > 1).then_some(1.0)), "step {step}");
    }
    episodes.observe(4.0 * h, h, &[0.0], &[], |_| Rates { before: 0.0, struck: 0.0, after: 0.0 });
    let [contact] = episodes.closed() else { panic!("{:?}", episodes.closed()) };
    assert_eq!((contact.impulse, contact.peak_force, contact.approach_speed), (-20.25, Some(1.0), 10.0));
}

#[test]
fn a_part_too_short_to_push_ends_no_contact_and_a_longer_one_does() {
    let scene = Scene::oscillator(1.0, 0.0, 0.0).with_wall(Wall::upper("stop", 1.0));
    let h = 0.125;
    let held = PartRates { before: 0.0, arrived: 0.0, struck: 0.0, after: 0.0 };
    // Where sticking ends and sliding begins, a part of a step may take no more than rounding.
    for (pause, contacts) in [(1e-9 * h, 1), (0.1 * h, 2)] {
        let divided = Contract { divides: true, ..contract(None) };
        let mut episodes = Episodes::new(&scene, &[1.0], divided);
        let mut closed = 0;
        let parts =
            [([0.0, h], -h), ([h, h + pause], 0.0), ([h + pause, 2.0 * h], pause - h), ([2.0 * h, 3.0 * h], 0.0)];
        for ([start, end], impulse) in parts {
            let pushing: &[usize] = if impulse == 0.0 { &[] } else { &[0] };
            episodes.observe_part([start, end], end - start, (&[impulse], &[0.0]), pushing, |_| held);
            closed += episodes.closed().len();
        }
        assert_eq!(closed, contacts, "{pause:e}");
    }
}
