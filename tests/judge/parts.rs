//! The judge of steps that are divided at impacts: what it accuses at the instant of one.

use crate::common::source;
use signorini::residual::Judge;
use signorini::{Load, Path, Refuted, Scene, Scheme, Step, Stepper};

/// What the judge is shown of a part in place of the true values, of one degree of freedom and two
/// walls.
#[derive(Debug, Clone)]
struct Shown {
    q: f64,
    v: f64,
    impulse: [f64; 2],
    jump: [f64; 2],
    resting: Vec<usize>,
}

/// What the judge finds in half a second of `scene` where the first part with an impact after 0.2 s
/// is changed by `lie`.
fn accused(scene: &Scene, lie: impl Fn(&Step<'_>, &mut Shown)) -> Vec<Refuted> {
    let h = 1e-3;
    let mut stepper = Stepper::new(scene, &Scheme::Located, h).expect("a stepper");
    let state = stepper.state();
    let mut judge = Judge::new(scene, stepper.contract(), h, &state.q, &state.v);
    let mut lied = false;
    while stepper.time() < 0.5 - 1e-9 {
        let step = stepper.step().expect("a step");
        let impact = step.jump.iter().any(|&p| p != 0.0);
        let pair = |x: &[f64]| [x[0], x[1]];
        let mut shown = Shown {
            q: step.q[0],
            v: step.v[0],
            impulse: pair(step.impulse),
            jump: pair(step.jump),
            resting: step.resting.to_vec(),
        };
        if impact && step.end > 0.2 && !lied {
            assert!(matches!(step.path, Path::Part { .. }));
            lied = true;
            lie(&step, &mut shown);
        }
        let Shown { q, v, impulse, jump, resting } = &shown;
        let mut told = step;
        (told.q, told.v) = (std::slice::from_ref(q), std::slice::from_ref(v));
        (told.impulse, told.jump, told.resting) = (impulse, jump, resting);
        judge.observe(&told);
    }
    assert!(lied);
    judge.findings().iter().map(|finding| finding.refuted).collect()
}

#[test]
fn a_sound_run_is_not_accused() {
    assert_eq!(accused(&source(0.8, 0.8), |_, _| {}), []);
    let blown = source(0.8, 0.8).with_load(Load::impulse(0.05, 0.123_456));
    assert_eq!(accused(&blown, |_, _| {}), []);
}

#[test]
fn an_impulse_that_the_velocity_does_not_show_is_accused() {
    let found = accused(&source(0.8, 0.8), |_, shown| {
        for (impulse, jump) in shown.impulse.iter_mut().zip(&mut shown.jump) {
            (*impulse, *jump) = (*impulse + 1e-3 * *jump, 1.001 * *jump);
        }
    });
    assert!(found.contains(&Refuted::MomentumBalance), "{found:?}");
}

#[test]
fn a_rebound_by_another_restitution_is_accused_though_momentum_and_energy_are_kept() {
    // The body leaves with 1 % less of its speed, and the wall gave the impulse for that.
    let slower = |_: &Step<'_>, shown: &mut Shown| {
        let less = 0.01 * shown.v;
        shown.v -= less;
        for (impulse, jump) in shown.impulse.iter_mut().zip(&mut shown.jump).filter(|(_, jump)| **jump != 0.0) {
            (*impulse, *jump) = (*impulse - less, *jump - less);
        }
    };
    let found = accused(&source(0.8, 0.8), slower);
    assert!(found.contains(&Refuted::Complementarity), "{found:?}");
}

#[test]
fn a_rest_that_no_acceleration_explains_is_accused() {
    // The body stops at the wall, and the step says that its rebounds end within it; the
    // acceleration that presses it would need many steps for that.
    let stopped = |step: &Step<'_>, shown: &mut Shown| {
        let wall = shown.jump.iter().position(|&p| p != 0.0).expect("an impact");
        for (impulse, jump) in shown.impulse.iter_mut().zip(&mut shown.jump).filter(|(_, jump)| **jump != 0.0) {
            (*impulse, *jump) = (*impulse - shown.v, *jump - shown.v);
        }
        shown.v = 0.0;
        shown.resting = vec![wall];
        assert!(step.velocity_after[0].abs() > 0.01);
    };
    let found = accused(&source(0.8, 0.8), stopped);
    assert!(found.contains(&Refuted::Complementarity), "{found:?}");
}

#[test]
fn an_impact_away_from_the_wall_is_accused() {
    let found = accused(&source(0.8, 0.8), |_, shown| shown.q *= 0.99);
    assert!(found.contains(&Refuted::Complementarity), "{found:?}");
    let found = accused(&source(0.8, 0.8), |_, shown| shown.q *= 1.01);
    assert!(found.contains(&Refuted::Penetration), "{found:?}");
}
