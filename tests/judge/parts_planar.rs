//! The judge of steps that are divided at impacts in round holes and with friction: what it accuses
//! at an instant, and over a slide.

use signorini::linear::Symmetric;
use signorini::residual::Judge;
use signorini::{Load, PlaneRows, Refuted, Row, Scene, Scheme, Step, Stepper, Structure, Wall};

/// What the judge is shown of a part in place of the true values, of two degrees of freedom and one
/// wall.
#[derive(Debug, Clone)]
struct Shown {
    q: [f64; 2],
    after: [f64; 2],
    v: [f64; 2],
    impulse: f64,
    jump: f64,
    friction: f64,
    normal: [f64; 2],
    resting: Vec<usize>,
}

/// The part that a lie changes.
#[derive(Debug, Clone, Copy, PartialEq)]
enum Part {
    Impact,
    Slide,
}

const MASS: f64 = 1.3;

/// A mass in a hole of 2 mm with friction, under a load that presses it against the hole after some
/// impacts.
fn scene() -> Scene {
    let pair = |x: f64| Symmetric::diagonal(&[x; 2]);
    let at = PlaneRows { y: Row::dof(0), z: Row::dof(1) };
    let hole = Wall::round("hole", at.clone(), 2e-3).with_restitution(0.5).with_friction(0.2);
    Scene::structure(Structure { mass: pair(MASS), damping: pair(0.0), stiffness: pair(0.0) })
        .with_support("hole", at, [0.0; 2], vec![hole])
        .with_load(Load { at: Row::dof(0), ..Load::constant(3.0) })
        .with_initial(&[0.0, 0.0], &[0.1, 0.05])
        .with_duration(0.2)
}

/// What the judge finds where the first impact, or the first slide after 0.1 s, is changed by
/// `lie`.
fn accused(part: Part, lie: impl Fn(&Step<'_>, &mut Shown)) -> Vec<Refuted> {
    let (scene, h) = (scene(), 1e-3);
    let mut stepper = Stepper::new(&scene, &Scheme::Located, h).expect("a stepper");
    let state = stepper.state();
    let mut judge = Judge::new(&scene, stepper.contract(), h, &state.q, &state.v);
    let mut lied = false;
    while stepper.time() < scene.duration - 1e-9 {
        let step = stepper.step().expect("a step");
        let pair = |x: &[f64]| [x[0], x[1]];
        let mut shown = Shown {
            q: pair(step.q),
            after: pair(step.velocity_after),
            v: pair(step.v),
            impulse: step.impulse[0],
            jump: step.jump[0],
            friction: step.friction[0],
            normal: step.normal[0],
            resting: step.resting.to_vec(),
        };
        let is_part = match part {
            Part::Impact => step.jump[0] != 0.0,
            Part::Slide => step.jump[0] == 0.0 && step.impulse[0] != 0.0 && step.end > 0.1,
        };
        if is_part && !lied {
            lied = true;
            lie(&step, &mut shown);
        }
        let mut told = step;
        (told.q, told.velocity_after, told.v) = (&shown.q, &shown.after, &shown.v);
        let (impulse, jump, friction, normal) = ([shown.impulse], [shown.jump], [shown.friction], [shown.normal]);
        (told.impulse, told.jump, told.friction, told.normal) = (&impulse, &jump, &friction, &normal);
        told.resting = &shown.resting;
        judge.observe(&told);
    }
    assert!(lied, "{part:?}");
    judge.findings().iter().map(|finding| finding.refuted).collect()
}

/// Adds the impulse −p n + f t to what the hole gave at the end of a part.
fn push(shown: &mut Shown, p: f64, f: f64) {
    let [y, z] = shown.normal;
    (shown.impulse, shown.jump, shown.friction) = (shown.impulse + p, shown.jump + p, shown.friction + f);
    shown.v = [shown.v[0] + (-p * y - f * z) / MASS, shown.v[1] + (-p * z + f * y) / MASS];
}

#[test]
fn a_sound_run_is_not_accused() {
    assert_eq!(accused(Part::Impact, |_, _| {}), []);
    assert_eq!(accused(Part::Slide, |_, _| {}), []);
}

#[test]
fn a_rebound_by_another_restitution_is_accused_though_momentum_is_kept() {
    let found =
        accused(Part::Impact, |_, shown| push(shown, 0.01 * shown.jump, 0.002 * shown.jump.copysign(shown.friction)));
    assert!(found.contains(&Refuted::Complementarity), "{found:?}");
}

#[test]
fn friction_beyond_coulombs_or_short_of_it_is_accused() {
    for share in [0.1, -0.1, -2.0] {
        let found = accused(Part::Impact, |_, shown| push(shown, 0.0, share * shown.friction));
        assert!(!found.is_empty(), "{share}");
        // It breaks no balance of momentum.
        assert!(!found.contains(&Refuted::MomentumBalance), "{share}: {found:?}");
    }
}

#[test]
fn an_impulse_that_the_velocity_does_not_show_is_accused() {
    let found = accused(Part::Impact, |_, shown| {
        (shown.impulse, shown.jump) = (1.001 * shown.impulse, 1.001 * shown.jump);
    });
    assert!(found.contains(&Refuted::MomentumBalance), "{found:?}");
    let found = accused(Part::Impact, |_, shown| shown.friction *= 1.001);
    assert!(found.contains(&Refuted::MomentumBalance), "{found:?}");
}

#[test]
fn an_impact_along_another_normal_is_accused() {
    let found = accused(Part::Impact, |_, shown| {
        let ([y, z], p, f) = (shown.normal, shown.jump, shown.friction);
        push(shown, -p, -f);
        let (c, s) = (0.01_f64.cos(), 0.01_f64.sin());
        shown.normal = [c * y - s * z, s * y + c * z];
        push(shown, p, f);
    });
    assert!(!found.is_empty());
}

#[test]
fn a_rest_that_no_acceleration_explains_is_accused() {
    let found = accused(Part::Impact, |_, shown| {
        let [y, z] = shown.normal;
        let leaves = y * shown.v[0] + z * shown.v[1];
        assert!(leaves < -0.01, "{leaves}");
        push(shown, MASS * leaves, 0.0);
        shown.friction *= 1.0;
        shown.resting = vec![0];
    });
    assert!(found.contains(&Refuted::Complementarity), "{found:?}");
}

#[test]
fn a_slide_that_leaves_the_circle_or_is_pushed_across_its_way_is_accused() {
    let found = accused(Part::Slide, |_, shown| shown.q = shown.q.map(|q| 0.999 * q));
    assert!(!found.is_empty());
    let found = accused(Part::Slide, |_, shown| shown.q = shown.q.map(|q| 1.001 * q));
    assert!(found.contains(&Refuted::Penetration), "{found:?}");
    let found = accused(Part::Slide, |_, shown| {
        let [y, z] = shown.normal;
        shown.normal = [y - 1e-3 * z, z + 1e-3 * y];
    });
    assert!(!found.is_empty());
}
