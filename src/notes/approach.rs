//! How near the body came to walls that it never touched.

use crate::scene::Scene;
use crate::trajectory::Trajectory;

/// The note on a run without contact; `None` where there was a contact, or no wall.
pub(super) fn untouched(scene: &Scene, trajectory: &Trajectory) -> Option<String> {
    if scene.walls.is_empty() || !trajectory.contacts().is_empty() {
        return None;
    }
    // The gap at a wall is known at the recorded rows, through a probe on the same row of the
    // structure.
    let seen = scene.walls.iter().filter_map(|wall| {
        let probe = scene.probes.iter().position(|probe| probe.at == wall.at)?;
        let gaps = trajectory.displacements().get(probe)?.iter().map(|&w| wall.gap(w));
        Some((wall, wall.gap(wall.at.dot(&scene.initial.q)), gaps.reduce(f64::min)?))
    });
    let Some((wall, start, nearest)) = seen.min_by(|a, b| (a.2 / a.1).total_cmp(&(b.2 / b.1))) else {
        return Some("no contact at all, with any wall".into());
    };
    let covered = if start > 0.0 { 100.0 * (1.0 - nearest / start) } else { 0.0 };
    Some(format!(
        "no contact at all: nearest, the body stays {nearest:.3e} m from the wall {:?}, having covered \
         {covered:.2} % of the {start:.3e} m at the start; positions and gaps are in m",
        wall.name
    ))
}
