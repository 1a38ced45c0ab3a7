//! `orbits.csv`: the motion of the orbits along branches, for a drawing.

use super::atomic::WholeFile;
use super::branches::Drawn;
use crate::error::{Error, Result};
use crate::orbit::branch::{Family, Point};
use crate::orbit::{Problem, path};
use crate::scene::{Scene, Wall};
use serde_json::{Value, json};
use std::io::Write;
use std::path::Path;

/// The file beside the branches.
pub const FILE: &str = "orbits.csv";

/// About this many instants are written (some megabytes); with more orbits, only every second,
/// third and so on is written.
const MOST_INSTANTS: usize = 60_000;

/// Approximate number of instants per forcing period, and per event.
const OF_PERIOD: usize = 24;
const OF_EVENT: usize = 2;

/// Writes the motion of the orbits of `drawn`, of the scenes of `family`, one row per instant with
/// six digits: a drawing shows no more. Branch and point are numbered as in `branches.csv`. Special
/// points are all written; of the others only every second, third and so on where there are many.
///
/// # Errors
/// Those of `family`; [`Error::Io`] where the file cannot be written, which is whole or not at all.
pub fn write(path: &Path, drawn: &Drawn<'_>, family: &Family<'_>) -> Result<()> {
    let failed = |error: std::io::Error| Error::io(path.display(), error.to_string(), false).caused_by(error);
    let points = drawn.points();
    let instants: usize = points
        .iter()
        .map(|(_, _, point, _)| {
            let signature = &point.orbit.signature;
            OF_PERIOD * signature.periods as usize + OF_EVENT * signature.events.len()
        })
        .sum();
    let every = instants.div_ceil(MOST_INSTANTS).max(1);
    let mut file = WholeFile::create(path)?;
    writeln!(file, "branch,point,phase_cycles,displacement_m,velocity_m_per_s").map_err(failed)?;
    for (branch, number, point, label) in points {
        if label.is_empty() && !number.is_multiple_of(every) {
            continue;
        }
        for [phase, displacement, velocity] in motion(family(point.value)?, point, drawn.place())? {
            writeln!(file, "{branch},{number},{phase:.6},{displacement:.5e},{velocity:.5e}").map_err(failed)?;
        }
    }
    file.finish()
}

/// Phase (cycles), displacement (m) and velocity (m/s) over one orbit; for a structure, at the
/// place of wall number `place`.
fn motion(scene: Scene, point: &Point, place: usize) -> Result<Vec<[f64; 3]>> {
    if let (Some(strobe), Some(wall)) = (&point.strobe, scene.walls.get(place)) {
        return path(&scene, strobe, point.orbit.signature.periods, wall.row());
    }
    let problem = Problem::new(scene)?;
    let flights = problem.flights(&point.orbit)?;
    Ok(flights.iter().map(|at| [at.time / problem.forcing_period(), at.displacement, at.velocity]).collect())
}

/// Name, side and place (m) of each wall of `scene`; without a place where `other`, the scene at
/// another value of the key, has the wall elsewhere, or where it does not stand at the place of
/// wall number `place`.
#[must_use]
pub fn walls(scene: &Scene, other: &Scene, place: usize) -> Value {
    let at = scene.walls.get(place).map(|wall| wall.row());
    let wall = |(wall, other): (&Wall, &Wall)| {
        json!({
            "name": wall.name,
            "side": wall.side().name(),
            "position_m": (wall.position() == other.position() && Some(wall.row()) == at).then_some(wall.position()),
            "rigid": wall.law.is_rigid(),
        })
    };
    scene.walls.iter().zip(&other.walls).map(wall).collect()
}
