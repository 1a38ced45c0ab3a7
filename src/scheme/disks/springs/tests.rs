//! The forces of springs: their derivatives, and the energy that they keep.

use super::*;
use crate::linear::Symmetric;
use crate::scene::{PlaneRows, Structure, Wall, WallLaw, heading};
use crate::scheme::{Integrator, PenaltyLaw, Scheme, Stepper};

/// A mass of 1 kg without springs of its own in a round hole of this law.
fn free(gap: f64, law: WallLaw) -> Scene {
    let zero = || Symmetric::zeros(2);
    let mass = Symmetric::diagonal(&[1.0; 2]);
    let mut scene = Scene::structure(Structure { mass, damping: zero(), stiffness: zero() });
    let at = PlaneRows { y: Row::dof(0), z: Row::dof(1) };
    let wall = Wall { law, ..Wall::round("hole", at.clone(), gap) };
    scene = scene.with_support("hole", at, [0.0; 2], vec![wall]);
    scene
}

#[test]
fn slopes_are_the_derivatives_of_the_forces() {
    let (gap, h) = (1.0, 0.1);
    let mut pressed = 0;
    for law in [WallLaw::Elastic { stiffness: 50.0, damping: 2.0 }, WallLaw::Quartic { epsilon: 0.1, span: 2.0 }] {
        let scene = free(gap, law);
        let mut held = HoleBody::new(&scene, h).expect("a scene");
        let springs = Springs::new(&scene, &held).expect("a scene");
        for k in 0..60 {
            let turn = 0.37 * f64::from(k);
            // From inside or outside of the circle to outside, at some angle to the radius.
            let at = 0.9 + 0.1 * f64::from(k % 4);
            held.frame.q = vec![at * turn.cos(), at * turn.sin()];
            let y = DVector::from_vec(vec![5.0 * (1.1 * turn).cos(), 5.0 * (1.1 * turn).sin()]);
            let answer = springs.law_response(&held, &y);
            pressed += u32::from(answer.force.amax() > 0.0);
            for j in 0..2 {
                let step = 1e-5;
                let moved = |by: f64| {
                    let mut y = y.clone();
                    y[j] += by;
                    springs.law_response(&held, &y).force
                };
                let slope = (moved(-step) - moved(step)) / (2.0 * step);
                for i in 0..2 {
                    // The error of the central difference, 1e-10 of a third derivative, and
                    // roundings of forces of some hundred newtons over the step.
                    let off = (slope[i] - answer.slope[(i, j)]).abs();
                    assert!(off < 1e-7 * (1.0 + answer.slope.amax()), "{law:?}, {k}: {slope}, {}", answer.slope);
                }
            }
        }
    }
    assert!(pressed > 80, "{pressed}");
}

/// Steps until the end, each of which keeps kinetic energy plus that of `spring`, J; returns the
/// steps with a force, and the Newton steps.
fn keep_energy(scene: &Scene, law: PenaltyLaw, (h, steps): (f64, u64), spring: impl Fn(&[f64]) -> f64) -> (u64, u64) {
    let scheme = Scheme::Penalty { law, integrator: Integrator::DiscreteGradient };
    let mut stepper = Stepper::new(scene, &scheme, h).expect("a scene");
    let energy = |q: &[f64], v: &[f64]| 0.5 * (v[0] * v[0] + v[1] * v[1]) + spring(q);
    let start = energy(&scene.initial.q, &scene.initial.v);
    let mut pushing = 0;
    for number in 0..steps {
        let step = stepper.step().expect("Newton's method converges");
        let now = energy(step.q, step.v);
        // Some roundings a step.
        assert!((now / start - 1.0).abs() < 1e-13 * (number + 4) as f64, "{law}, step {number}: {now}, {start}");
        let force = step.impulse.iter().any(|p| *p != 0.0);
        pushing += u64::from(force);
    }
    (pushing, stepper.counters().newton_iterations)
}

#[test]
fn a_bounce_from_a_lone_wall_keeps_the_energy_at_any_speed() {
    let (far, stiffness, h) = (1e3, 30.0, 0.1);
    for speed in [0.3, 1.1, 2.3, 4.7, 7.3, 9.9, 17.0] {
        for upper in [true, false] {
            let sign = if upper { 1.0 } else { -1.0 };
            let wall = if upper { Wall::upper("wall", 1.0) } else { Wall::lower("wall", -1.0) };
            let wall = wall.at(Row::dof(0));
            let law = WallLaw::Elastic { stiffness, damping: 0.0 };
            let scene = free(far, law).with_wall(wall).with_initial(&[0.1 * sign, 0.0], &[sign * speed, 0.2]);
            let law = PenaltyLaw::Linear { stiffness, damping: 0.0 };
            let depth = |q: &[f64]| (sign * q[0] - 1.0).max(0.0);
            // Until it is well on its way back.
            let steps = (2.0 / speed / h) as u64 + 20;
            let (pushing, newton) = keep_energy(&scene, law, (h, steps), |q| 0.5 * stiffness * depth(q).powi(2));
            // Half a period of √(30/1)/2π Hz takes 0.57 s.
            assert!((5..=8).contains(&pushing), "{speed}: {pushing}");
            assert!((1..=5 * pushing).contains(&newton), "{speed}: {newton} Newton steps");
        }
    }
}

#[test]
fn a_body_thrown_about_in_a_hole_keeps_its_energy_however_stiff_the_hole_is() {
    for k in 0..24 {
        let turn = 0.37 * f64::from(k);
        let stiffness = 10.0_f64.powi(k % 6);
        let [c, s] = heading(turn.to_degrees());
        // A unit of length, which changes no number of steps.
        let unit = 2.0_f64.powi(30 * (k / 6 % 3 - 1));
        let start = |unit: f64| {
            let law = WallLaw::Rigid { restitution: 0.5 };
            let [q, v] = [[0.3 * c, -0.2 * s], [3.0 * s, 5.0 * c]].map(|x| x.map(|x| x * unit));
            free(unit, law).with_initial(&q, &v)
        };
        let scene = start(unit);
        let depth = |q: &[f64]| (q[0].hypot(q[1]) - unit).max(0.0);
        let penalty = PenaltyLaw::Linear { stiffness, damping: 0.0 };
        let (pushing, newton) = keep_energy(&scene, penalty, (0.05, 200), |q| 0.5 * stiffness * depth(q).powi(2));
        assert!(pushing > 5, "{k}: {pushing}");
        // With more than a step for each force, and not many.
        assert!((pushing..20 * pushing).contains(&newton), "{k}: {newton} Newton steps, {pushing} forces");
        // φ²/(2ε) with φ = |w|² − 1.
        let (scene, epsilon) = (start(1.0), 1.0 / stiffness);
        let phi = |q: &[f64]| (q[0] * q[0] + q[1] * q[1] - 1.0).max(0.0);
        keep_energy(&scene, PenaltyLaw::Quartic { epsilon }, (0.05, 200), |q| phi(q).powi(2) / (2.0 * epsilon));
    }
}

#[test]
fn steps_far_longer_than_a_hole_is_wide_are_solved() {
    for k in 0..60 {
        let (turn, stiffness) = (0.37 * f64::from(k), 10.0_f64.powi(k % 5));
        let [c, s] = heading(turn.to_degrees());
        let scene = free(1.0, WallLaw::Rigid { restitution: 0.5 })
            .with_initial(&[0.9 * c, -0.4 * s], &[30.0 * s, 20.0 * c + 5.0]);
        let law = PenaltyLaw::Linear { stiffness, damping: 0.0 };
        let depth = |q: &[f64]| (q[0].hypot(q[1]) - 1.0).max(0.0);
        let (pushing, _) = keep_energy(&scene, law, (0.5, 40), |q| 0.5 * stiffness * depth(q).powi(2));
        assert!(pushing > 5, "{k}: {pushing}");
    }
}

#[test]
fn a_step_that_would_end_at_the_centre_without_the_hole_is_solved() {
    // From 1/2 behind the circle, at the velocity that would bring it to the centre exactly.
    let (stiffness, h) = (0.5, 1.0);
    let scene = free(1.0, WallLaw::Elastic { stiffness, damping: 0.0 }).with_initial(&[1.5, 0.0], &[-1.5, 0.0]);
    let law = PenaltyLaw::Linear { stiffness, damping: 0.0 };
    let depth = |q: &[f64]| (q[0].hypot(q[1]) - 1.0).max(0.0);
    let (pushing, _) = keep_energy(&scene, law, (h, 1), |q| 0.5 * stiffness * depth(q).powi(2));
    assert_eq!(pushing, 1);
}
