//! The judge of round holes and friction: faultless steps are not accused, and every fault of known
//! size is found.

use crate::rubbing::{MOREAU_JEAN, body, hole, isotropic, load, rotating, with, with_flats};
use crate::steps::{HoleStep, Pushes};
use signorini::residual::{Judge, Residuals};
use signorini::{Finding, Load, Refuted, Row, Scene, Step, Stepper};

/// What the judge is shown of a step in place of the true values.
struct Shown {
    pushes: Pushes,
    after: Vec<f64>,
}

/// 2000 steps of `scene` of `h` seconds as a judge sees them, each passed through `alter` before.
fn judge(scene: &Scene, h: f64, mut alter: impl FnMut(&Step<'_>, &mut Shown)) -> (Vec<Finding>, Residuals) {
    let mut stepper = Stepper::new(scene, &MOREAU_JEAN, h).expect("a sound scene");
    let state = stepper.state();
    let mut judge = Judge::new(scene, stepper.contract(), h, &state.q, &state.v);
    for _ in 0..2000 {
        let mut step = stepper.step().expect("a step");
        let mut shown = Shown { pushes: Pushes::of(&step), after: step.velocity_after.to_vec() };
        alter(&step, &mut shown);
        shown.pushes.show(&mut step);
        step.velocity_after = &shown.after;
        judge.observe(&step);
    }
    (judge.findings(), judge.residuals())
}

/// A body that whirls in a hole and between flats, with friction, and under blows.
fn scenes(friction: f64) -> Vec<(&'static str, Scene)> {
    let pressed = rotating(with(isotropic(1.0, 0.2, 100.0), hole("hole", body(), 5e-3, 0.4, friction)), 3.0, 5.0);
    let square = [0.0, 90.0, 180.0, 270.0].map(|direction| (direction + 20.0, 4e-3));
    let flats = rotating(with_flats(isotropic(1.0, 0.2, 100.0), "flats", body(), &square, 0.4, friction), 3.0, 5.0);
    let off = hole("off", body(), 5e-3, 0.7, friction).with_centre([1e-3, 0.5e-3]);
    vec![
        ("a hole", pressed.clone()),
        ("flats and a hole", with(flats, hole("hole", body(), 4.5e-3, 0.2, friction))),
        ("two holes", with(pressed.clone(), off)),
        ("blows", pressed.with_load(load(Load::impulse(0.2, 0.1003), Row::new(vec![(0, 1.0), (1, -0.5)])))),
    ]
}

#[test]
fn a_faultless_run_is_not_accused() {
    for friction in [0.0, 0.3] {
        for (name, scene) in scenes(friction) {
            for h in [1e-4, 1e-3] {
                let (findings, residuals) = judge(&scene, h, |_, _| {});
                assert_eq!(findings, [], "{name}, friction {friction}, h = {h}");
                // Roundings: of forces near 10 N from velocities over h.
                assert!(residuals.complementarity < 1e-10, "{name}: {residuals:?}");
                assert!(residuals.energy.residual < 1e-12 && residuals.force_balance < 1e-10, "{name}: {residuals:?}");
                assert_eq!(residuals.energy.friction_j > 0.0, friction > 0.0, "{name}: {residuals:?}");
                assert!(residuals.energy.impact_loss_j > 0.0, "{name}: {residuals:?}");
            }
        }
    }
}

fn refuted(findings: &[Finding], refuted: Refuted) -> f64 {
    let found = findings.iter().find(|finding| finding.refuted == refuted);
    found.unwrap_or_else(|| panic!("{refuted:?}: {findings:?}")).residual
}

/// The steps of `a hole` by now push all the time; the fault happens once, in step 1000 or in the
/// first thereafter in which the hole pushes.
fn with_fault(friction: f64, fault: impl Fn(&mut HoleStep)) -> (Vec<Finding>, Residuals) {
    let mut done = false;
    judge(&scenes(friction)[0].1, 1e-4, |step, shown| {
        if step.index >= 1000 && !done && shown.pushes.impulse[0] > 0.0 {
            shown.pushes.alter(0, &fault);
            done = true;
        }
    })
}

#[test]
fn every_fault_of_a_hole_is_found() {
    for friction in [0.0, 0.3] {
        // The normal turned by 1e-4: a force of that share is askew, and the balance misses as
        // much.
        let (findings, _) = with_fault(friction, |hole| {
            let ([y, z], turn) = (hole.normal, 1e-4);
            hole.normal = [y - turn * z, z + turn * y];
        });
        assert!(refuted(&findings, Refuted::Normal) > 1e-6, "{findings:?}");
        assert!(refuted(&findings, Refuted::MomentumBalance) > 1e-6, "{findings:?}");
        // An impulse larger by a part in 1e3; the recorder's sum is not told.
        let (findings, _) = with_fault(friction, |hole| hole.impulse *= 1.001);
        assert!(refuted(&findings, Refuted::MomentumBalance) > 1e-5, "{findings:?}");
        // A hole that pulls.
        let (findings, residuals) = with_fault(friction, |hole| hole.impulse = -hole.impulse);
        assert!(refuted(&findings, Refuted::Tension) > 1e-3 && residuals.tension_n > 0.0, "{findings:?}");
    }
    // Friction beyond the cone, without friction and with.
    for (friction, by) in [(0.0, 1e-3), (0.3, 0.301)] {
        let (findings, _) = with_fault(friction, |hole| hole.friction = hole.friction.signum() * by * hole.impulse);
        assert!(refuted(&findings, Refuted::Friction) > 1e-5, "{findings:?}");
    }
    // Friction that pushes the way the body slides, and less than Coulomb's while it slides.
    for share in [-1.0, 0.9] {
        let (findings, _) = with_fault(0.3, |hole| hole.friction *= share);
        assert!(refuted(&findings, Refuted::Friction) > 1e-4, "{findings:?}");
    }
}

#[test]
fn a_law_without_the_split_is_found() {
    // The naive bound n·ẇ⁺ ≤ −e n·ẇ, which takes turning for an approach, gives a smaller impulse
    // while the body slides: p(1+e)/2 in place of p, with the velocity that belongs to it.
    let scene = rotating(with(isotropic(1.0, 0.2, 100.0), hole("hole", body(), 5e-3, 0.4, 0.0)), 3.0, 5.0);
    let (findings, _) = judge(&scene, 1e-4, |step, shown| {
        if step.index == 1500 {
            let lost = 0.3 * shown.pushes.impulse[0];
            assert!(lost > 0.0);
            shown.pushes.impulse[0] -= lost;
            for (after, n) in shown.after.iter_mut().zip(shown.pushes.normal[0]) {
                *after += lost * n;
            }
        }
    });
    assert!(refuted(&findings, Refuted::Complementarity) > 1e-4, "{findings:?}");
    assert!(findings.iter().all(|finding| finding.refuted != Refuted::Normal), "{findings:?}");
}

#[test]
fn a_push_out_of_reach_is_found() {
    let scene = with(isotropic(1.0, 0.0, 0.0), hole("hole", body(), 5e-3, 0.4, 0.0));
    let scene = scene.with_load(load(Load::harmonic(1e-3, 5.0, 0.0), Row::dof(0)));
    let (findings, _) = judge(&scene, 1e-4, |step, shown| {
        if step.index == 700 {
            (shown.pushes.normal[0], shown.pushes.impulse[0]) = ([1.0, 0.0], 1e-6);
        }
    });
    let found = findings.iter().find(|finding| finding.refuted == Refuted::WallLaw).expect("a finding");
    assert_eq!(found.wall.as_deref(), Some("hole"));
}

#[test]
fn faults_of_friction_at_flats_are_found() {
    let (_, scene) = scenes(0.3).remove(1);
    for share in [-1.0, 0.5, 1.2] {
        let mut done = false;
        let (findings, _) = judge(&scene, 1e-4, |step, shown| {
            let pushing = shown.pushes.friction.iter().position(|f| *f != 0.0);
            if let (true, false, Some(wall)) = (step.index >= 500, done, pushing) {
                shown.pushes.friction[wall] *= share;
                done = true;
            }
        });
        assert!(refuted(&findings, Refuted::MomentumBalance) > 1e-6, "{findings:?}");
        assert!(refuted(&findings, Refuted::Friction) > 1e-5, "{share}: {findings:?}");
    }
}
