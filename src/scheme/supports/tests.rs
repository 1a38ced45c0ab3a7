//! Steps of moreau-jean in rigid round holes.

use crate::linear::Symmetric;
use crate::scene::{Load, PlaneRows, Row, Scene, Structure, Wall};
use crate::scheme::{Scheme, Stepper};

const MOREAU_JEAN: Scheme = Scheme::MoreauJean { theta: 0.5 };

/// A free mass of 1 kg in a round hole of this gap.
fn free(gap: f64) -> Scene {
    let zero = || Symmetric::zeros(2);
    let mass = Symmetric::diagonal(&[1.0; 2]);
    let mut scene = Scene::structure(Structure { mass, damping: zero(), stiffness: zero() });
    let at = PlaneRows { y: Row::dof(0), z: Row::dof(1) };
    let wall = Wall::round("hole", at.clone(), gap).with_restitution(0.0);
    scene = scene.with_support("hole", at, [0.0; 2], vec![wall]);
    scene
}

#[test]
fn a_body_that_stands_at_a_wall_without_a_load_asks_for_no_impulse() {
    let wall = Wall::upper("wall", 1e-3).with_restitution(0.5).at(Row::dof(0));
    let scene = free(1.0).with_wall(wall).with_initial(&[1e-3, 0.0], &[0.0, 0.0]);
    let mut stepper = Stepper::new(&scene, &MOREAU_JEAN, 1e-3).expect("a scene");
    for _ in 0..5 {
        let step = stepper.step().expect("a step");
        assert_eq!((step.q, step.v, step.impulse), (&[1e-3, 0.0][..], &[0.0; 2][..], &[0.0; 2][..]));
    }
    assert_eq!(stepper.counters().qp_solves, 0);
}

#[test]
fn a_blow_into_the_hole_ends_the_contact_of_a_body_that_slides_and_begins_another_whatever_the_angle() {
    let (gap, speed, h, blow) = (1e-3, 0.1, 1e-4, 5e-3);
    for eighth in 0..8 {
        for way in [1.0, -1.0] {
            let start = std::f64::consts::FRAC_PI_4 * f64::from(eighth) + 0.3;
            let (c, s) = (start.cos(), start.sin());
            // 10.3 steps later it is here.
            let there = start + way * speed / gap * 10.3 * h;
            let push = |share: f64, row: usize| Load { at: Row::dof(row), ..Load::impulse(blow * share, 10.3 * h) };
            let scene = free(gap)
                .with_initial(&[gap * c, gap * s], &[-way * speed * s, way * speed * c])
                .with_load(push(there.cos(), 0))
                .with_load(push(there.sin(), 1));
            let mut stepper = Stepper::new(&scene, &MOREAU_JEAN, h).expect("a scene");
            for number in 1..=14 {
                let step = stepper.step().expect("a step");
                assert!(step.impulse[0] > 0.0, "{eighth}, {way}: step {number}");
                let ended = usize::from(number == 11);
                assert_eq!(step.closed.len(), ended, "{eighth}, {way}: step {number}: {:?}", step.closed);
            }
        }
    }
}
