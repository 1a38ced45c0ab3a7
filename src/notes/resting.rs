//! Where moreau-jean lets a body rest behind its wall.

use crate::scene::{LoadKind, Scene, Side, System, Wall};
use std::f64::consts::TAU;

/// A sine this much slower than the vibration itself is a load that lasts.
const SLOW: f64 = 0.1;

/// What to know before moreau-jean steps a scene whose load may hold the body on a rigid wall; none without such a wall.
pub(crate) fn resting(scene: &Scene) -> Option<String> {
    let wall = scene.walls.iter().find(|wall| wall.law.is_rigid() && may_rest(scene, wall))?;
    Some(format!(
        "a load that lasts can hold the body on wall {:?}: moreau-jean lets it rest up to h v (1 - e/2) behind a wall (v: its speed of \
         landing) and gives the force of that place, off by the stiffness times the depth; event and generalized-alpha rest on the \
         face, and a smaller step makes the depth smaller",
        wall.name
    ))
}

/// True if what lasts of the loads may press the body onto `wall`: where it would stand without walls lies behind it.
fn may_rest(scene: &Scene, wall: &Wall) -> bool {
    let outward = if wall.side == Side::Upper { 1.0 } else { -1.0 };
    let System::Oscillator(o) = &scene.system else {
        // Which of many walls a structure rests on takes its statics, if it has any; that something presses is known.
        return scene.loads.iter().any(|load| most(&load.kind, 1.0, 0.0).max(most(&load.kind, -1.0, 0.0)) > 0.0);
    };
    let slow = SLOW * (o.stiffness / o.mass).sqrt();
    let push = |weight: f64, kind: &LoadKind| most(kind, outward * weight.signum(), slow) * weight.abs();
    let pushes = scene.loads.iter().map(|load| push(load.at.dot(&[1.0]), &load.kind));
    // The row of a wall has a weight too: w = g q, with the place of the wall at w.
    let row = wall.at.dot(&[1.0]);
    let pressing = pushes.sum::<f64>() * row.abs() > o.stiffness * outward * wall.position / row.abs();
    pressing && row != 0.0
}

/// The largest force with which a load lasts in the direction `sign`, N; of sines those slower than `slow` (rad/s).
fn most(kind: &LoadKind, sign: f64, slow: f64) -> f64 {
    match kind {
        LoadKind::Constant { force } => sign * force,
        LoadKind::Table(table) => table.force().iter().fold(f64::NEG_INFINITY, |most, force| most.max(sign * force)),
        LoadKind::Harmonic { amplitude, frequency, .. } if TAU * frequency < slow => amplitude.abs(),
        // What a function does is not known before it runs.
        LoadKind::Function(_) => f64::INFINITY,
        LoadKind::Harmonic { .. } | LoadKind::Impulse { .. } => 0.0,
    }
}
