//! The branches of periodic orbits of a case over a key, and the folder of their files.

use super::branches::Drawn;
use super::first_orbit::FirstOrbit;
use super::results::Results;
use super::scene_family::SceneFamily;
use super::{json, orbits, overlay};
use crate::error::Result;
use crate::interrupt::Carried;
use crate::orbit::branch::{Graph, Point, Request, Switch, graph};
use serde::Serialize;
use serde_json::{Value, json};
use std::path::Path;

/// How far branches are followed from the first orbit.
#[derive(Debug, Clone, Copy)]
pub struct BranchRequest {
    /// Which branches are followed beside the first.
    pub switch: Switch,
    /// Maximum number of switches between the first branch and any other.
    pub depth: u32,
    /// Most points of a branch in each direction.
    pub points: u32,
}

impl BranchRequest {
    /// Follows the branches of `family` from `first`, an orbit at the case's value of the key.
    /// `seen` is called with the place of each point in the range, from 0 to 1.
    ///
    /// # Errors
    /// As [`graph`]; [`crate::Error::Stopped`].
    pub fn follow(&self, family: &SceneFamily, first: &FirstOrbit, seen: &mut dyn FnMut(f64)) -> Result<Graph> {
        let (value, range) = (family.key.value, family.key.range);
        let request = Request { range, switch: self.switch, depth: self.depth, points: self.points as usize };
        let [low, high] = range;
        let mut seen = |point: &Point| seen((point.value - low) / (high - low));
        let found = graph(&|value| family.scene(value), first.start(), value, &request, &mut seen)?;
        // What was stopped looks like a branch that ends.
        Carried::here().check()?;
        Ok(found)
    }
}

/// What decides on the results beside the case, as the folder records it: the key and its range,
/// the file of the first orbit or the forcing periods that are run first, and how far branches are
/// followed.
#[derive(Debug, Serialize)]
pub struct BranchSettings<'a> {
    /// The key.
    pub key: &'a str,
    /// Its range, `A:B`.
    pub range: &'a str,
    /// The file of the first orbit.
    pub from: Option<&'a Path>,
    /// Forcing periods that are run before the motion is checked for repetition.
    pub settle: u32,
    /// The name of a [`Switch`].
    pub switch: &'a str,
    /// As in [`BranchRequest`].
    pub depth: u32,
    /// As in [`BranchRequest`].
    pub points: u32,
    /// Results that are drawn beneath.
    pub over: Option<&'a Path>,
    /// A second key, over which special points are followed.
    pub second: Option<&'a str>,
    /// Its range.
    pub second_range: Option<&'a str>,
    /// Which special points; all if empty.
    pub locus: &'a [String],
}

/// The branches `found`, as they are written and drawn.
#[must_use]
pub fn drawn<'a>(found: &'a Graph, family: &'a SceneFamily) -> Drawn<'a> {
    let key = &family.key;
    Drawn { graph: found, column: key.column(), label: key.label(), scene: &family.case.scene }
}

/// Writes the files of the branches, with the points `beneath` of other results in the picture and,
/// where they are to be drawn in a `report`, the motion of the orbits. Returns their document.
///
/// # Errors
/// [`crate::Error::Io`] where a file cannot be written; those of a run over an orbit.
pub fn write(
    results: &mut Results,
    drawn: &Drawn<'_>,
    family: &SceneFamily,
    beneath: Option<&[(f64, f64)]>,
    report: bool,
) -> Result<Value> {
    drawn.branches(&results.place("branches.csv")?)?;
    drawn.specials(&results.place("special.csv")?)?;
    let scene = &family.case.scene;
    let mut document = drawn.document();
    // Another value of the key shows which walls it moves.
    let mut points = drawn.graph.branches.iter().flat_map(|branch| &branch.points);
    let moved = points.find(|point| point.value != family.key.value);
    let other = moved.map(|point| family.scene(point.value)).transpose()?;
    document["walls"] = orbits::walls(scene, other.as_ref().unwrap_or(scene), drawn.place());
    if drawn.tells_states() {
        document["place"] = json!(scene.walls.get(drawn.place()).map(|wall| &wall.name));
    }
    results.write("branches.json", json::text(&document))?;
    let title = format!("{}: branches of periodic orbits", family.title());
    results.draw("branches", &drawn.picture(&title, beneath.unwrap_or_default()))?;
    if let Some(points) = beneath {
        overlay::write(&results.place(overlay::FILE)?, &drawn.column, points)?;
    }
    if report {
        orbits::write(&results.place(orbits::FILE)?, drawn, &|value| family.scene(value))?;
    }
    results.add_to_manifest("case_file", family.case.document.json()?);
    Ok(document)
}
