//! Where the structure is put that stands behind walls.

use super::super::tests::{hole, masses, rigid, started, with};
use crate::scene::{Scene, Wall};

/// A point of 1 kg in a plane, behind which walls stand, put back from (1, 0.5) µm.
fn put_back(scene: &Scene) -> ([f64; 2], Vec<f64>) {
    let mut event = started(scene, 1.0);
    event.restart(0.5, &[1e-6, 0.5e-6], &[0.0, 0.0]).unwrap();
    event.put_back().unwrap();
    let gaps = event.places.iter().zip(0..).flat_map(|(place, row)| {
        let w = event.body.rows.dot(row, &event.q);
        [0, 1].map(|side| place.gap(side, w))
    });
    let gaps = gaps.filter(|gap| gap.is_finite()).collect();
    ([event.q[0], event.q[1]], gaps)
}

/// The wall at the origin whose outward normal is at this angle to x.
fn wall(degrees: f64) -> Wall {
    let (sine, cosine) = f64::to_radians(degrees).sin_cos();
    rigid(Wall::upper(&format!("wall-{degrees}"), 0.0), 0.5, &[(0, cosine), (1, sine)])
}

/// Rounding of displacements of 1 µm, and the tolerance of a programme, 1e-12 of them.
const NEAR: f64 = 1e-17;

#[test]
fn between_two_walls_at_a_sharp_angle_the_structure_goes_to_their_edge() {
    let scene = masses(&[1.0, 1.0], &[], &[]).with_wall(wall(0.0)).with_wall(wall(170.0));
    let ([x, y], gaps) = put_back(&scene);
    assert!(x.abs() < NEAR && y.abs() < NEAR, "{x} {y}");
    assert!(gaps.iter().all(|gap| *gap > -NEAR), "{gaps:?}");
}

#[test]
fn a_wall_that_the_nearest_free_place_leaves_behind_does_not_hold_the_structure() {
    // The second wall is 0.01 µm in front of the structure, and 1 µm behind the place on the first.
    let at = f64::to_radians(10.0).sin_cos();
    let second = rigid(Wall::upper("second", 1e-6 * at.1 + 0.5e-6 * at.0 - 1e-8), 0.5, &[(0, at.1), (1, at.0)]);
    let scene = masses(&[1.0, 1.0], &[], &[]).with_wall(wall(0.0)).with_wall(second);
    let ([x, y], gaps) = put_back(&scene);
    assert!(x.abs() < NEAR && (y - 0.5e-6).abs() < NEAR, "{x} {y}");
    assert!(gaps[0].abs() < NEAR && gaps[1] > 0.9e-6, "{gaps:?}");
}

#[test]
fn walls_more_than_the_degrees_of_freedom_leave_the_structure_behind_none() {
    let angles = [0.0, 25.0, 60.0, 95.0, 170.0];
    let scene = angles.into_iter().fold(masses(&[1.0, 1.0], &[], &[]), |scene, at| scene.with_wall(wall(at)));
    let ([x, y], gaps) = put_back(&scene);
    assert!(x.abs() < NEAR && y.abs() < NEAR && gaps.iter().all(|gap| *gap > -NEAR), "{x} {y} {gaps:?}");
}

#[test]
fn far_behind_two_holes_the_structure_goes_to_where_their_circles_cross() {
    // Circles of 1 mm about ±0.95 mm cross at 0.312 mm on both sides of the line of their centres.
    let free = masses(&[1.0, 1.0], &[], &[]);
    let scene = with(with(free, hole(1e-3, 0.5, [-0.95e-3, 0.0])), hole(1e-3, 0.5, [0.95e-3, 0.0]));
    let mut event = started(&scene, 1.0);
    event.restart(0.5, &[0.02e-3, 0.9e-3], &[0.0, 0.0]).unwrap();
    event.put_back().unwrap();
    let edge = 1e-3 * (1.0_f64 - 0.95 * 0.95).sqrt();
    // Rounding of 1 mm, over the angle at which the circles cross.
    assert!(event.q[0].abs() < 1e-18 && (event.q[1] - edge).abs() < 1e-18, "{:?}, {edge}", event.q);
}

#[test]
fn a_hole_and_a_wall_that_cross_at_a_sharp_angle_hold_the_structure_where_they_cross() {
    // A hole of 1 mm whose circle passes through the origin towards x, and a wall at 170°.
    let scene = with(masses(&[1.0, 1.0], &[], &[]), hole(1e-3, 0.5, [-1e-3, 0.0])).with_wall(wall(170.0));
    let ([x, y], _) = put_back(&scene);
    let beyond = (x + 1e-3).hypot(y) - 1e-3;
    // Rounding of 1 mm.
    assert!(beyond.abs() < 1e-18 && x.abs() < 1e-15 && y.abs() < 1e-15, "{x} {y} {beyond}");
}
