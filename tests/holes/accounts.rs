//! What the judge says of exact motion in a round hole: sizes in closed form, and whom it names.

use crate::rubbing::{body, change_hole, hole, isotropic, with};
use signorini::residual::{Judge, Residuals};
use signorini::{Finding, Refuted, Scene, Scheme, Stepper, Wall, heading};

/// Gap, m, mass, kg, and speed along the brim, m/s: pressed by m v²/γ = 4 N.
const GAP: f64 = 5e-3;
const MASS: f64 = 2.0;
const SPEED: f64 = 0.1;

/// A free body that slides round a hole from this direction, beside a wall and a hole that it does
/// not reach.
fn sliding(degrees: f64, duration: f64) -> Scene {
    let [c, s] = heading(degrees);
    let wide = with(isotropic(MASS, 0.0, 0.0), hole("wide", body(), 1.0, 0.5, 0.0));
    with(wide, hole("hole", body(), GAP, 0.5, 0.0))
        .with_wall(Wall::upper("far", 1.0))
        .with_initial(&[GAP * c, GAP * s], &[-SPEED * s, SPEED * c])
        .with_duration(duration)
}

/// What a judge of `told` says of the exact motion of `scene`.
fn judged(scene: &Scene, told: &Scene) -> (Vec<Finding>, Residuals) {
    let mut stepper = Stepper::new(scene, &Scheme::Event, 1.0).expect("a scene");
    let state = stepper.state();
    let mut judge = Judge::new(told, stepper.contract(), 1.0, &state.q, &state.v);
    while stepper.time() < scene.duration {
        judge.observe(&stepper.step().expect("a step"));
    }
    (judge.findings(), judge.residuals())
}

fn widened(scene: &Scene, share: f64, centre: [f64; 2]) -> Scene {
    let mut told = scene.clone();
    change_hole(&mut told, 1, |hole| {
        let gap = hole.position() * share;
        hole.with_position(gap).with_centre(centre)
    });
    told
}

#[test]
fn a_body_that_slides_round_is_measured_to_rounding() {
    for degrees in [0.0, 75.0, 200.0] {
        let scene = sliding(degrees, 0.5);
        let (findings, seen) = judged(&scene, &scene);
        assert_eq!(findings, []);
        // Rounding of 4 N, of 5 mm and of 10 mJ, over 10 rad.
        assert!((seen.force_scale_n / (MASS * SPEED * SPEED / GAP) - 1.0).abs() < 1e-9, "{seen:?}");
        assert!(seen.tension_n < 1e-9 && seen.complementarity < 1e-9 && seen.force_balance < 1e-9, "{seen:?}");
        let [hole, far] = ["hole", "far"].map(|name| seen.depth_m[scene.wall_index(name).expect("a wall")]);
        assert!(hole < 1e-14 && far == 0.0, "{seen:?}");
        assert!((seen.energy.initial_j - 0.01).abs() < 1e-15 && seen.energy.residual < 1e-10, "{seen:?}");
    }
}

#[test]
fn a_hole_of_another_size_is_named_with_the_depth() {
    let scene = sliding(30.0, 0.2);
    let (depth, hole) = (1e-3 * GAP, scene.wall_index("hole").expect("a wall"));
    let (findings, seen) = judged(&scene, &widened(&scene, 1.0 - 1e-3, [0.0; 2]));
    let found = findings.iter().find(|finding| finding.refuted == Refuted::Penetration).expect("a finding");
    assert_eq!(found.wall.as_deref(), Some("hole"), "{findings:?}");
    assert!((seen.depth_m[hole] / depth - 1.0).abs() < 1e-9, "{seen:?}");
    assert!((seen.penetration_m / depth - 1.0).abs() < 1e-9, "{seen:?}");
    // A larger one is not touched, and pushes all the same.
    let (findings, seen) = judged(&scene, &widened(&scene, 1.0 + 1e-3, [0.0; 2]));
    let found = findings.iter().find(|finding| finding.refuted == Refuted::Complementarity).expect("a finding");
    // The smaller of 1e-3 of the gap over the scale of gaps and 4 N over that of forces.
    assert!((seen.complementarity * seen.gap_scale / depth - 1.0).abs() < 1e-6, "{seen:?}");
    assert_eq!((found.wall.as_deref(), seen.depth_m[hole]), (Some("hole"), 0.0), "{findings:?}");
}

#[test]
fn a_force_beside_the_normal_is_measured_by_its_share() {
    // The centre elsewhere along the brim by 1e-4 of the gap, over 5e-3 rad: the gap changes by
    // 5e-7 of itself, and the direction by 1e-4.
    for degrees in [0.0, 75.0, 200.0] {
        let scene = sliding(degrees, 2.5e-4);
        let [c, s] = heading(degrees);
        let told = widened(&scene, 1.0, [-1e-4 * GAP * s, 1e-4 * GAP * c]);
        let (findings, _) = judged(&scene, &told);
        let [finding] = &findings[..] else { panic!("{findings:?}") };
        assert_eq!((finding.refuted, finding.wall.as_deref()), (Refuted::Normal, Some("hole")), "{finding:?}");
        assert!((finding.residual / 1e-4 - 1.0).abs() < 0.01, "{finding:?}");
    }
}

#[test]
fn recorded_sums_that_are_not_those_of_the_steps_are_found() {
    let scene = sliding(40.0, 0.02);
    let hole = scene.wall_index("hole").expect("a wall");
    for (scheme, h) in [
        (Scheme::MoreauJean { theta: 0.5 }, 1e-4),
        (Scheme::ImplicitEuler, 1e-4),
        (Scheme::GeneralizedAlpha { rho: 0.8 }, 1e-4),
        (Scheme::Event, 1.0),
    ] {
        let heard = |told: &dyn Fn([f64; 2]) -> Vec<[f64; 2]>| {
            let mut stepper = Stepper::new(&scene, &scheme, h).expect("a scene");
            let state = stepper.state();
            let mut judge = Judge::new(&scene, stepper.contract(), h, &state.q, &state.v);
            let mut sum = [0.0; 2];
            while stepper.time() < scene.duration - 0.5 * h.min(1e-4) {
                let step = stepper.step().expect("a step");
                judge.observe(&step);
                let push = step.hole_push(hole);
                sum = [sum[0] + push[0], sum[1] + push[1]];
            }
            assert!(sum[0].hypot(sum[1]) > 0.05, "{scheme}: {sum:?}");
            judge.hear_holes(&told(sum));
            judge.findings()
        };
        assert_eq!(heard(&|sum| vec![[0.0; 2], sum]), [], "{scheme}");
        // One part in ten thousand of either component, or what a hole out of reach did not give.
        for wrong in [|[y, z]: [f64; 2]| [1.0001 * y, z], |[y, z]: [f64; 2]| [y, z - 1e-4 * y]] {
            let findings = heard(&|sum| vec![[0.0; 2], wrong(sum)]);
            let [finding] = &findings[..] else { panic!("{scheme}: {findings:?}") };
            let named = (finding.refuted, finding.wall.as_deref());
            assert_eq!(named, (Refuted::Impulses, Some("hole")), "{scheme}: {finding:?}");
            // Of |p|, whose components are of one size there.
            assert!((2e-5..1.5e-4).contains(&finding.residual), "{scheme}: {finding:?}");
        }
        assert_ne!(heard(&|sum| vec![[1e-3, 0.0], sum]), [], "{scheme}");
        // A list for other holes says nothing of these.
        assert_eq!(heard(&|_| vec![[9.0; 2]]), [], "{scheme}");
    }
}
