//! The request, and the result: branches, and the special points that join them.

use super::label::Label;
use super::line::End;
use super::point::Point;
use crate::error::names;

/// At which special points the branches that begin there are followed.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum Switch {
    /// At none of them.
    No,
    /// Where the branch has stable orbits on one side of the point.
    #[default]
    Stable,
    /// At all of them.
    All,
}

names!(Switch: "switch", No => "no", Stable => "stable", All => "all");

/// A request for branches.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Request {
    /// The range of the key; the first value below the second.
    pub range: [f64; 2],
    /// Which branches are followed beside the first.
    pub switch: Switch,
    /// Maximum number of switches between the first branch and any other: 0 for the first branch
    /// only.
    pub depth: u32,
    /// Most points of a branch in each of the two directions in which it is followed.
    pub points: usize,
}

/// A branch of orbits of one signature.
#[derive(Debug, Clone)]
pub struct Branch {
    /// Its points in order along it.
    pub points: Vec<Point>,
    /// The special point where it was found, by its number; `None` for the first.
    pub from: Option<usize>,
    /// Switches from the first branch to this one.
    pub depth: u32,
    /// Why it ends before its first point, and after its last; `None` where it begins at `from`.
    pub ends: [Option<End>; 2],
}

/// A special point.
#[derive(Debug, Clone)]
pub struct Special {
    /// What happens there.
    pub label: Label,
    /// Index of the event concerned, from 0; 0 where the whole orbit is concerned.
    pub event: usize,
    /// Index of the wall at which it happens; `None` where the whole orbit is concerned.
    pub wall: Option<usize>,
    /// The branch on which it was found.
    pub branch: usize,
    /// Number of points of that branch before it.
    pub after: usize,
    /// The orbit.
    pub point: Point,
    /// Other branches through it.
    pub leads_to: Vec<usize>,
    /// Why no other branch was followed from here; `None` if one was, at a fold, where none begins,
    /// and where none was asked for at any point.
    pub reason: Option<String>,
}

/// Branches and the points that join them.
#[derive(Debug, Clone, Default)]
pub struct Graph {
    /// The branches, in the order in which they were found.
    pub branches: Vec<Branch>,
    /// The special points, in the order in which they were found.
    pub specials: Vec<Special>,
}
