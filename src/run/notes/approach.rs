//! How near the body came to walls and round supports that it never touched.

use crate::scene::{Row, Scene, Wall};
use crate::trajectory::Trajectory;

/// With this begins the note on a run without contact.
pub(crate) const NO_CONTACT: &str = "no contact at all";

/// The note on a run without contact; `None` where there was a contact, or no wall.
pub(super) fn untouched(scene: &Scene, trajectory: &Trajectory) -> Option<String> {
    if !trajectory.contacts().is_empty() {
        return None;
    }
    if scene.walls.iter().all(Wall::is_round) {
        return within(scene, trajectory);
    }
    // The gap at a wall is known at the recorded rows, through a probe on the same row of the
    // structure.
    let seen = scene.walls.iter().filter(|wall| !wall.is_round()).filter_map(|wall| {
        let probe = scene.probes.iter().position(|probe| probe.at == *wall.row())?;
        let gaps = trajectory.displacements().get(probe)?.iter().map(|&w| wall.gap(w));
        Some((wall, wall.gap(wall.row().dot(&scene.initial.q)), gaps.reduce(f64::min)?))
    });
    let Some((wall, start, nearest)) = seen.min_by(|a, b| (a.2 / a.1).total_cmp(&(b.2 / b.1))) else {
        return Some(format!("{NO_CONTACT}, with any wall"));
    };
    let covered = if start > 0.0 { 100.0 * (1.0 - nearest / start) } else { 0.0 };
    Some(format!(
        "{NO_CONTACT}: in the rows, the body stays {nearest:.3e} m from the wall {:?}, having covered \
         {covered:.2} % of the {start:.3e} m at the start; positions and gaps are in m",
        wall.name
    ))
}

/// The note on a run without contact in a scene with round supports only: how much of the gap the
/// body used, as far as probes see it.
fn within(scene: &Scene, trajectory: &Trajectory) -> Option<String> {
    let column = |row: &Row| {
        let probe = scene.probes.iter().position(|probe| probe.at == *row)?;
        trajectory.displacements().get(probe)
    };
    let seen = scene.holes().filter_map(|hole| {
        let (y, z) = (column(&hole.at.y)?, column(&hole.at.z)?);
        let [cy, cz] = hole.centre;
        let farthest = y.iter().zip(z).map(|(y, z)| (y - cy).hypot(z - cz)).reduce(f64::max)?;
        Some((hole, farthest))
    });
    let farthest = seen.max_by(|a, b| (a.1 / a.0.gap).total_cmp(&(b.1 / b.0.gap)));
    match farthest {
        Some((hole, far)) => Some(format!(
            "{NO_CONTACT}: in the rows, the body stays within {far:.3e} m of the centre of the round support {:?}, \
             whose gap is {:.3e} m; positions and gaps are in m",
            hole.name, hole.gap
        )),
        None => scene.holes().next().map(|_| format!("{NO_CONTACT}, with any support")),
    }
}
