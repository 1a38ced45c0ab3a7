//! generalized-alpha where a body stands at a wall or hole.

use super::*;

/// Stands at a wall beside a hole out of reach, or at a hole at y : z = 3 : 4; and the direction
/// into it.
fn standing(damping: f64, restitution: f64) -> [(Scene, [f64; 2]); 2] {
    let mass = || masses(&[1.2; 2], &[damping; 2]);
    let wall = Wall::upper("wall", 1e-3).with_restitution(restitution).at(Row::dof(0));
    let beside = with(mass(), &[hole(1.0, 0.0)]).with_wall(wall).with_initial(&[1e-3, 0.0], &[0.0; 2]);
    let inside = with(mass(), &[hole(1e-3, restitution)]).with_initial(&[0.6e-3, 0.8e-3], &[0.0; 2]);
    [(beside, [1.0, 0.0]), (inside, [0.6, 0.8])]
}

/// The impulse of the wall or hole.
fn impulse(step: &Step<'_>) -> f64 {
    // Of an upper wall, or of a hole.
    step.impulse.iter().map(|p| p.abs()).sum()
}

#[test]
fn a_heavy_damper_does_not_throw_a_body_off_what_it_is_pressed_to() {
    let (h, load) = (1e-3, 5.0);
    for rho in [0.0, 0.3, 0.8] {
        for damping in [1e2, 1e5, 1e8] {
            for (scene, n) in standing(damping, 0.5) {
                let scene = pushed(scene, &Load::constant(load), n);
                let mut last = 0.0;
                follow(&scene, &Scheme::GeneralizedAlpha { rho }, h, 300, |number, step| {
                    let (q, v) = (n[0] * step.q[0] + n[1] * step.q[1], step.v[0].hypot(step.v[1]));
                    last = impulse(step);
                    assert!(last > 0.0, "{rho}, {damping}: step {number}");
                    assert!((q - 1e-3).abs() < 1e-15 && v < 1e-12, "{rho}, {damping}: step {number}, {q}, {v}");
                });
                // What the start leaves has died away as ρ^300.
                assert!((last / (h * load) - 1.0).abs() < 1e-9, "{rho}, {damping}: {last}");
            }
        }
    }
}

#[test]
fn a_step_that_just_meets_a_wall_or_just_not_is_that_between_walls() {
    let (h, damping) = (1e-3, 1.2e7);
    for rho in [0.0, 0.3, 0.8] {
        for tenth in -110..-60 {
            let wall = Wall::upper("wall", 1e-3).with_restitution(0.5).at(Row::dof(0));
            let q = 1e-3 - 10.0_f64.powf(0.1 * f64::from(tenth));
            let line = masses(&[1.2; 2], &[damping; 2]).with_wall(wall).with_initial(&[q, 0.0], &[0.0; 2]);
            let line = pushed(line, &Load::constant(5.0), [1.0, 0.0]);
            let mut bare = Stepper::new(&line, &Scheme::GeneralizedAlpha { rho }, h).expect("a scene");
            let beside = with(line, &[hole(1.0, 0.0)]);
            follow(&beside, &Scheme::GeneralizedAlpha { rho }, h, 3, |number, step| {
                let other = bare.step().expect("a step");
                let off = [step.q[0] - other.q[0], step.v[0] - other.v[0], step.impulse[0] - other.impulse[0]];
                // Rounding of q over h, and times the damper.
                let within = off[0].abs() < 1e-17 && off[1].abs() < 1e-14 && off[2].abs() < 1e-11;
                assert!(within, "{rho}, {tenth}: step {number}, {off:?}");
            });
        }
    }
}

#[test]
fn a_blow_at_the_end_of_a_step_throws_a_standing_body_back_in_this_step() {
    let (h, blow, restitution) = (1e-3, 0.06, 0.5);
    for (scene, n) in standing(0.0, restitution) {
        let scene = pushed(scene, &Load::impulse(blow, 2.0 * h), n);
        follow(&scene, &Scheme::GeneralizedAlpha { rho: 0.8 }, h, 4, |number, step| {
            let [q, v] = [step.q, step.v].map(|x| n[0] * x[0] + n[1] * x[1]);
            let back = if number < 2 { 0.0 } else { -restitution * blow / 1.2 };
            assert!((v - back).abs() < 1e-15, "step {number}: {v}");
            let way = 1e-3 + back * h * number.saturating_sub(2) as f64;
            assert!((q - way).abs() < 1e-17, "step {number}: {q}");
            let p = if number == 2 { (1.0 + restitution) * blow } else { 0.0 };
            assert!((impulse(step) - p).abs() < 1e-15, "step {number}: {}", impulse(step));
        });
    }
}

#[test]
fn a_step_across_the_whole_hole_takes_the_normal_at_its_end() {
    // From one side to the other exactly: the middle of the two places has no direction. All
    // numbers are multiples of powers of two.
    let scene = with(masses(&[1.0; 2], &[0.0; 2]), &[hole(2.0, 0.5)]).with_initial(&[-2.0, 0.0], &[8.0, 0.0]);
    follow(&scene, &Scheme::GeneralizedAlpha { rho: 1.0 }, 1.0, 1, |_, step| {
        assert_eq!((step.q, step.normal[0]), (&[2.0, 0.0][..], [1.0, 0.0]));
        // The body arrives at the other side with all of its speed, of which e = ½ comes back.
        assert!((step.v[0] + 4.0).abs() < 1e-14 && (step.impulse[0] - 12.0).abs() < 1e-14, "{:?}", step.v);
    });
}
