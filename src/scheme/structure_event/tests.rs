//! Structures for the tests of these files, and what a step does as a whole.

use super::closed_row::{Fate, LEVELS};
use super::*;
use crate::linear::Symmetric;
use crate::scene::{Load, PlaneRows, Row, Structure, Wall};

/// Entries (row, column, value) of a symmetric matrix.
pub(super) type Entries<'a> = &'a [(usize, usize, f64)];

/// Masses (kg) with these entries of C and K, at rest, for one second.
pub(super) fn masses(mass: &[f64], damping: Entries<'_>, stiffness: Entries<'_>) -> Scene {
    let matrix = |entries: Entries<'_>| Symmetric::from_entries(mass.len(), entries.iter().copied());
    let mass = Symmetric::diagonal(mass);
    let (damping, stiffness) = (matrix(damping), matrix(stiffness));
    Scene::structure(Structure { mass, damping, stiffness })
}

/// The load on a degree of freedom.
pub(super) fn on(load: Load, dof: usize) -> Load {
    Load { at: Row::dof(dof), ..load }
}

/// A rigid wall on a row.
pub(super) fn rigid(wall: Wall, e: f64, row: &[(usize, f64)]) -> Wall {
    wall.with_restitution(e).at(Row::new(row.to_vec()))
}

/// A round hole about the first two degrees of freedom.
pub(super) fn hole(gap: f64, restitution: f64, centre: [f64; 2]) -> Wall {
    let at = PlaneRows { y: Row::dof(0), z: Row::dof(1) };
    Wall::round("hole", at, gap).with_centre(centre).with_restitution(restitution)
}

/// The scene with one more wall.
pub(super) fn with(scene: Scene, wall: Wall) -> Scene {
    scene.with_wall(wall)
}

/// The scene at its start, whose steps end at multiples of `stride` (s).
pub(super) fn started(scene: &Scene, stride: f64) -> StructureEvent {
    StructureEvent::new(&Arc::new(scene.clone()), stride).unwrap()
}

/// Whether two numbers agree to 12 digits: rounding of some sums and products.
pub(super) fn near(found: f64, wanted: f64) -> bool {
    (found - wanted).abs() <= 1e-12 * wanted.abs()
}

/// A closed row that has not been looked at.
pub(super) fn closed(row: usize, sign: f64) -> ClosedRow {
    ClosedRow {
        row,
        sign,
        both: false,
        was: 0.0,
        arrived: 0.0,
        restitution: 0.0,
        push: [0.0; 2],
        candidate: false,
        fate: Fate::Open,
        force: [0.0; LEVELS],
    }
}

#[test]
fn an_extra_force_acts_in_the_steps_that_are_given_it() {
    let mut event = started(&masses(&[2.0], &[], &[]).with_duration(4.0), 0.5);
    let mut speed = 0.0;
    for force in [Some(3.0), None, None, Some(3.0), Some(-5.0), None] {
        event.advance(force.map(|f| [f]).as_ref().map(|f| &f[..])).unwrap();
        speed += 0.5 * force.unwrap_or(0.0) / 2.0;
        assert!((event.v[0] - speed).abs() < 1e-14, "{force:?}: {} for {speed}", event.v[0]);
    }
}

#[test]
fn numbers_that_are_not_finite_are_refused_with_the_number_of_the_step() {
    for part in 0..2 {
        let mut event = started(&masses(&[2.0], &[], &[]), 0.125);
        (0..3).for_each(|_| event.advance(None).unwrap());
        assert!(event.check().is_ok());
        if part == 0 {
            event.q[0] = f64::NAN
        } else {
            event.v[0] = f64::INFINITY
        }
        let found = event.check();
        assert!(matches!(found, Err(Error::NotFinite { step: 3, .. })), "{part}: {found:?}");
    }
}

#[test]
fn doubt_grows_while_events_follow_one_another_without_motion() {
    let walls = (0..20).map(|i| Wall::upper(&format!("{i}"), 0.5).with_elasticity(10.0, 0.0));
    let scene = walls.fold(masses(&[1.0], &[], &[]), Scene::with_wall).with_initial(&[0.0], &[1.0]);
    let mut event = started(&scene, 1.0);
    event.advance(None).unwrap();
    // The first wall is met after a flight.
    assert!((event.time, event.clock.total().events) == (0.5, 1) && event.doubt == 1.0, "{}", event.doubt);
    event.advance(None).unwrap();
    // Sixteen more at the same instant, in one step: 4¹⁶ is more than the most.
    assert!((event.time, event.clock.total().events) == (0.5, 17) && event.doubt == 1e4, "{}", event.doubt);
    event.advance(None).unwrap();
    assert!(event.time > 0.5 && event.doubt == 1.0, "{} {}", event.time, event.doubt);
}

#[test]
fn a_blow_at_the_start_is_in_the_state_and_ends_no_step() {
    let mut event = started(&masses(&[2.0], &[], &[]).with_load(on(Load::impulse(3.0, 0.0), 0)), 0.5);
    assert!(event.blows.is_empty() && near(event.v[0], 1.5), "{:?}", event.blows);
    event.advance(None).unwrap();
    assert!(event.time == 0.5 && near(event.q[0], 0.75), "{} {}", event.time, event.q[0]);
}

#[test]
fn a_blow_acts_at_its_very_time_although_the_length_of_the_stretch_before_it_is_rounded() {
    let mut missed = 0;
    for k in 0..200 {
        // The second stretch goes from the first blow to the second.
        let first = 0.05 + 1e-3 * f64::from(k);
        let time = 4.2 * first;
        missed += u32::from(first + (time - first) > time);
        let scene = masses(&[2.0], &[], &[]).with_duration(2.0).with_load(on(Load::impulse(3.0, first), 0));
        let mut event = started(&scene.with_load(on(Load::impulse(-1.0, time), 0)), 2.0);
        event.advance(None).unwrap();
        assert!(event.time == first && near(event.v[0], 1.5), "{first}: {}, {}", event.time, event.v[0]);
        event.advance(None).unwrap();
        assert!(event.time == time && near(event.v[0], 1.0), "{first}: {}, {}", event.time, event.v[0]);
    }
    assert!(missed > 10, "{missed}");
}

#[test]
fn the_length_of_a_scene_is_its_least_gap() {
    let scene = masses(&[1.0, 1.0], &[], &[]).with_wall(rigid(Wall::upper("stop", 1.0), 0.5, &[(0, 1.0)]));
    assert!(started(&scene, 1.0).length == 1.0);
    assert!(started(&with(scene, hole(2e-3, 0.5, [0.0; 2])), 1.0).length == 2e-3);
}
