//! The velocity reported at the end of a step, by the formula of the head of the file.

use super::super::{Integrator, PenaltyLaw, Scheme, Stepper};
use crate::scene::{Load, Scene, Side, Wall, WallLaw};

/// Both staggered schemes.
fn schemes() -> [Scheme; 2] {
    let law = PenaltyLaw::Linear { stiffness: 1.0, damping: 0.0 };
    [Scheme::PaoliSchatzman, Scheme::Penalty { law, integrator: Integrator::CentralDifference }]
}

/// 2 kg with a damper between a spring that pushes up and one that pushes down, each with a
/// dashpot; a rigid wall is never reached.
fn between(stiffness: f64, damping: f64) -> Scene {
    Scene::oscillator(2.0, 3.0, 40.0)
        .with_wall(Wall::upper("far", 100.0))
        .with_wall(Wall::upper("above", 0.1).with_elasticity(stiffness, damping))
        .with_wall(Wall::lower("below", -0.1).with_elasticity(stiffness, damping))
        .with_load(Load::constant(0.5))
        .with_initial(&[0.0], &[4.0])
}

#[test]
fn half_a_step_of_the_force_at_the_end_is_in_the_velocity_there() {
    let (m, c, k, f) = (2.0, 3.0, 40.0, 0.5);
    for scheme in schemes() {
        for h in [0.01, 0.002] {
            for damping in [0.0, 5.0] {
                let scene = between(500.0, damping);
                let mut stepper = Stepper::new(&scene, &scheme, h).unwrap();
                let mut pushed = [0; 2];
                for _ in 0..400 {
                    let step = stepper.step().unwrap();
                    let (q, middle) = (step.q[0], step.velocity_after[0]);
                    let mut force = f - c * middle - k * q;
                    for wall in scene.walls.iter().skip(1) {
                        let (upper, WallLaw::Elastic { stiffness, damping }) = (wall.side() == Side::Upper, wall.law)
                        else {
                            panic!("a spring")
                        };
                        let (depth, rate) = if upper { (q - 0.1, middle) } else { (-0.1 - q, -middle) };
                        // A dashpot that pulls is cut off.
                        let r = if depth > 0.0 { (stiffness * depth + damping * rate).max(0.0) } else { 0.0 };
                        force += if upper { -r } else { r };
                        pushed[usize::from(upper)] += u32::from(r > 0.0);
                    }
                    let expected = middle + 0.5 * h * force / (m + 0.5 * h * c);
                    // A few roundings of 4 m/s.
                    assert!((step.v[0] - expected).abs() < 1e-14, "{scheme}, {h} s: {}, {expected}", step.v[0]);
                }
                assert!(pushed.iter().all(|&steps| steps > 20), "{pushed:?}");
            }
        }
    }
}

#[test]
fn within_a_spring_that_the_step_does_not_resolve_the_velocity_known_is_reported() {
    // h²k = 1.9 m or 2.1 m.
    let (m, h) = (2.0, 0.01);
    for (share, resolved) in [(0.95, true), (1.05, false)] {
        let scene = between(share * m / (h * h), 0.0);
        let mut stepper = Stepper::new(&scene, &Scheme::PaoliSchatzman, h).unwrap();
        let mut inside = 0;
        for _ in 0..100 {
            let step = stepper.step().unwrap();
            if step.q[0].abs() > 0.1 + 1e-9 {
                inside += 1;
                let reported = step.v[0].to_bits() == step.velocity_after[0].to_bits();
                assert_eq!(reported, !resolved, "{share}: {} m", step.q[0]);
            }
        }
        assert!(inside > 3, "{inside} steps");
    }
}

#[test]
fn at_the_face_of_a_dashpot_there_is_no_force_yet() {
    // 50 mm behind one face, exactly at another.
    let law = PenaltyLaw::Linear { stiffness: 1.0, damping: 0.0 };
    let scheme = Scheme::Penalty { law, integrator: Integrator::CentralDifference };
    for sign in [1.0, -1.0] {
        let wall = |name: &str, place: f64| {
            let wall = if sign > 0.0 { Wall::upper(name, place) } else { Wall::lower(name, -place) };
            wall.with_elasticity(100.0, 2.0)
        };
        let scene = Scene::oscillator(1.0, 0.0, 0.0)
            .with_wall(wall("behind", 0.0625))
            .with_wall(wall("at", 0.125))
            .with_wall(Wall::upper("far", 100.0))
            .with_initial(&[sign * 0.125], &[sign * 2.0]);
        let mut stepper = Stepper::new(&scene, &scheme, 1e-3).unwrap();
        let step = stepper.step().unwrap();
        assert!(sign * step.force[0] < -6.25 && step.force[1] == 0.0, "{:?}", step.force);
    }
}
