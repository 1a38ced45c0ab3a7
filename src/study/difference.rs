//! The difference |Δu| between two recorded motions of one scene, row by row; every study uses this
//! definition.

use crate::scene::Scene;
use crate::trajectory::Trajectory;

/// The common rows of `run` and `against`: time (s) and the largest |Δu| (m) over the probes. Empty
/// where they have no probe in common. A NaN difference is kept.
pub(crate) fn rows<'a>(run: &'a Trajectory, against: &'a Trajectory) -> impl Iterator<Item = (f64, f64)> + 'a {
    let probes = run.displacements().len().min(against.displacements().len());
    let (mine, others) = (run.displacements(), against.displacements());
    let length = run.time().len().min(against.time().len());
    let count = if probes == 0 { 0 } else { length };
    let largest = move |row: usize| {
        let pairs = mine.iter().zip(others).filter_map(move |(x, y)| Some((x.get(row)?, y.get(row)?)));
        pairs.fold(0.0, |most, (x, y)| worse(most, (x - y).abs()))
    };
    against.time().iter().take(count).enumerate().map(move |(row, &t)| (t, largest(row)))
}

/// The larger of two, and NaN if either is: a run whose state became NaN agrees with nothing.
pub(crate) fn worse(a: f64, b: f64) -> f64 {
    if b > a || b.is_nan() { b } else { a }
}

/// The largest |value| in several columns.
pub(crate) fn largest(columns: &[Vec<f64>]) -> f64 {
    columns.iter().flatten().fold(0.0, |most, x| most.max(x.abs()))
}

/// The length (m) of which errors of the displacement are shares: the gap of the scene; without
/// one, as where there is no wall, the largest displacement in the motion `against`.
pub(crate) fn error_length(scene: &Scene, against: &Trajectory) -> f64 {
    let largest = || Some(largest(against.displacements())).filter(|largest| *largest > 0.0);
    scene.gap().or_else(largest).unwrap_or_else(|| scene.gap_scale())
}

/// A contact slower than this share of the speed of the body is a graze.
const GRAZE: f64 = 0.01;

/// The largest speed at which each wall is struck from the time `from` (s) on, m/s, in the scene's
/// order, but at least [`GRAZE`] of the largest that the probe on its row sees (where there is
/// none, of that of the fastest probe); at a wall that is not struck, all of that.
pub(crate) fn wall_speeds(scene: &Scene, motion: &Trajectory, from: f64) -> Vec<f64> {
    let first = motion.time().partition_point(|t| *t < from);
    let largest = |column: &Vec<f64>| column.iter().skip(first).fold(0.0, |most: f64, v| most.max(v.abs()));
    let fastest = motion.velocities().iter().map(largest).fold(0.0, f64::max);
    let speed = |(index, wall): (usize, &crate::scene::Wall)| {
        let here = motion.contacts().iter().filter(|c| c.wall == index && c.start >= from);
        let struck = here.map(|c| c.approach_speed).reduce(f64::max);
        let probe = scene.probes.iter().position(|p| p.at == *wall.row()).and_then(|p| motion.velocities().get(p));
        let there = probe.map_or(fastest, largest);
        struck.map_or(there, |struck| struck.max(GRAZE * there))
    };
    scene.walls.iter().enumerate().map(speed).collect()
}
