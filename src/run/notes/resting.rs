//! A warning that moreau-jean may let a body rest behind its wall.

use crate::scene::{LoadKind, Scene, Side, System, Wall};
use crate::scheme::{Scheme, Stepper};
use std::f64::consts::TAU;

/// A sine slower than this share of the natural frequency counts as a lasting load.
const SLOW: f64 = 0.1;

/// The warning before moreau-jean steps a scene whose load may hold the body on a rigid wall;
/// `None` without such a wall, or where it refuses the scene. It names the schemes that rest on the
/// face of the wall, of those that take the scene with steps of `step` seconds.
pub(crate) fn resting(scene: &Scene, walls: usize, step: f64) -> Option<String> {
    let wall = scene.walls.iter().take(walls).find(|wall| wall.law.is_rigid() && may_rest(scene, wall))?;
    let takes = |scheme: &Scheme| Stepper::takes(scene, scheme, step);
    if !takes(&Scheme::MoreauJean { theta: 0.5 }) {
        return None;
    }
    let others = [Scheme::Event, Scheme::Located, Scheme::GeneralizedAlpha { rho: 1.0 }];
    let taken: Vec<&str> = others.iter().filter(|scheme| takes(scheme)).map(|scheme| scheme.entry().name).collect();
    let others = match taken.as_slice() {
        [] => String::new(),
        [one] => format!("{one} rests on the face, and "),
        [rest @ .., last] => format!("{} and {last} rest on the face, and ", rest.join(", ")),
    };
    Some(format!(
        "a load that lasts can hold the body on wall {:?}: moreau-jean lets it rest up to h v (1 - e/2) behind \
         a wall (v: its speed of landing), and its force has an error of the stiffness times the depth; {others}a \
         smaller step makes the depth smaller",
        wall.name
    ))
}

/// True if the lasting loads may press the body onto `wall`: its static displacement without walls
/// lies behind it.
fn may_rest(scene: &Scene, wall: &Wall) -> bool {
    let outward = if wall.side() == Side::Upper { 1.0 } else { -1.0 };
    let System::Oscillator(o) = &scene.system else {
        // Which of its walls a structure rests on would take its static solution, if it has one;
        // here it counts that some load presses.
        return scene.loads.iter().any(|load| most(&load.kind, 1.0, 0.0).max(most(&load.kind, -1.0, 0.0)) > 0.0);
    };
    let slow = SLOW * (o.stiffness / o.mass).sqrt();
    let push = |weight: f64, kind: &LoadKind| most(kind, outward * weight.signum(), slow) * weight.abs();
    let pushes = scene.loads.iter().map(|load| push(load.at.dot(&[1.0]), &load.kind));
    // The row of a wall has a weight too: w = g q, and the wall's position is in w.
    let row = wall.row().dot(&[1.0]);
    let pressing = pushes.sum::<f64>() * row.abs() > o.stiffness * outward * wall.position() / row.abs();
    pressing && row != 0.0
}

/// The largest lasting force of a load in the direction `sign`, N; of sines, only those slower than
/// `slow` (rad/s).
fn most(kind: &LoadKind, sign: f64, slow: f64) -> f64 {
    match kind {
        LoadKind::Constant { force } => sign * force,
        LoadKind::Table(table) => table.force().iter().fold(f64::NEG_INFINITY, |most, force| most.max(sign * force)),
        LoadKind::Harmonic { amplitude, frequency, .. } if TAU * frequency < slow => amplitude.abs(),
        // The values of a function are not known before the run.
        LoadKind::Function(_) => f64::INFINITY,
        LoadKind::Harmonic { .. } | LoadKind::Impulse { .. } => 0.0,
    }
}
