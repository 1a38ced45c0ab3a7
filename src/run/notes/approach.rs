//! How near the body came to walls and round supports that it never touched.

use crate::scene::{Face, Hole, Row, Scene, Support, Wall, heading};
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
    let seen =
        scene.walls.iter().filter(|wall| !wall.is_round()).filter_map(|wall| {
            Some((wall, wall.gap(wall.row().dot(&scene.initial.q)), nearest(scene, wall, trajectory)?))
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

/// Most supports without contact with a note each.
const MOST_UNTOUCHED: usize = 5;

/// Notes on the supports that were never touched in a run with contacts elsewhere, whose numbers
/// are all 0.
pub(super) fn untouched_supports(scene: &Scene, trajectory: &Trajectory) -> Vec<String> {
    let mut touched = vec![trajectory.contacts().is_empty(); scene.walls.len()];
    for contact in trajectory.contacts() {
        if let Some(wall) = touched.get_mut(contact.wall) {
            *wall = true;
        }
    }
    let reached = |index: usize| touched.get(index).is_none_or(|touched| *touched) || scene.is_slider(index);
    let free = scene.supports.iter().filter(|support| !support.walls.clone().any(reached));
    let mut notes: Vec<String> =
        free.clone().take(MOST_UNTOUCHED).map(|one| at_support(scene, one, trajectory)).collect();
    if let Some(more) = free.count().checked_sub(MOST_UNTOUCHED).filter(|&more| more > 0) {
        notes.push(format!("no contact at {more} more supports"));
    }
    notes
}

/// The note on a support without contact: how near the body came, as far as probes see it.
fn at_support(scene: &Scene, support: &Support, trajectory: &Trajectory) -> String {
    let none = format!("no contact at the support {:?}", support.name);
    if let Some(hole) = support.hole(&scene.walls) {
        return match farthest(scene, &hole, trajectory) {
            Some(far) => format!(
                "{none}: in the rows, the body stays within {far:.3e} m of its centre, and its gap is {:.3e} m",
                hole.gap
            ),
            None => format!("{none}; no probe there shows how near the body came"),
        };
    }
    let flats = support.members(&scene.walls).map(|(_, wall)| wall).zip(support.gaps(&scene.walls));
    let seen = flats.filter_map(|(wall, gap)| Some((wall, to_flat(scene, (support, wall, gap), trajectory)?)));
    match seen.min_by(|a, b| a.1.total_cmp(&b.1)) {
        Some((wall, gap)) => format!("{none}: in the rows, the body stays {gap:.3e} m from its wall {:?}", wall.name),
        None => format!("{none}; no probe there shows how near the body came"),
    }
}

/// The smallest distance (m) at the rows from a flat that is `gap` from the centre of its support:
/// by probes on the place along y and z, or by one towards the flat.
fn to_flat(scene: &Scene, (support, wall, gap): (&Support, &Wall, f64), trajectory: &Trajectory) -> Option<f64> {
    let Face::Flat { direction: Some(direction), .. } = &wall.face else { return None };
    let [y, z] = [&support.at.y, &support.at.z].map(|row| column(scene, row, trajectory));
    let Some((y, z)) = y.zip(z) else { return nearest(scene, wall, trajectory) };
    let ([ny, nz], [cy, cz]) = (heading(*direction), support.centre);
    y.iter().zip(z).map(|(y, z)| gap - ny * (y - cy) - nz * (z - cz)).reduce(f64::min)
}

/// The displacement of `row` at the rows of the results, where a probe is on it.
fn column<'a>(scene: &Scene, row: &Row, trajectory: &'a Trajectory) -> Option<&'a [f64]> {
    let probe = scene.probes.iter().position(|probe| probe.at == *row)?;
    trajectory.displacements().get(probe).map(|column| &column[..])
}

/// The smallest gap (m) of a flat wall at the rows.
fn nearest(scene: &Scene, wall: &Wall, trajectory: &Trajectory) -> Option<f64> {
    column(scene, wall.row(), trajectory)?.iter().map(|&w| wall.gap(w)).reduce(f64::min)
}

/// The largest distance (m) from the centre of a round wall at the rows.
fn farthest(scene: &Scene, hole: &Hole<'_>, trajectory: &Trajectory) -> Option<f64> {
    let [y, z] = [&hole.at.y, &hole.at.z].map(|row| column(scene, row, trajectory));
    let [cy, cz] = hole.centre;
    y?.iter().zip(z?).map(|(y, z)| (y - cy).hypot(z - cz)).reduce(f64::max)
}

/// The note on a run without contact in a scene with round supports only: how much of the gap the
/// body used, as far as probes see it.
fn within(scene: &Scene, trajectory: &Trajectory) -> Option<String> {
    let seen = scene.holes().filter_map(|hole| Some((hole, farthest(scene, &hole, trajectory)?)));
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
