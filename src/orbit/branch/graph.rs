//! The graph of branches: what begins where.

use super::super::equations::Scales;
use super::super::periodic::Orbit;
use super::super::problem::Problem;
use super::curve::{Curve, Family};
use super::events::{Label, Point};
use super::follow::{End, Line, Passed, follow};
use crate::error::{Error, Result};
use nalgebra::DVector;
use std::collections::VecDeque;

/// At which special points the branches that begin there are followed.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum Switch {
    /// At none.
    No,
    /// Where the branch has stable orbits on one side of the point.
    #[default]
    Stable,
    /// At all.
    All,
}

/// What is asked for.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Request {
    /// The range of the key; the first value below the second.
    pub range: [f64; 2],
    /// Which branches are followed beside the first.
    pub switch: Switch,
    /// How many switches lead from the first branch to the last: 0 for the first alone.
    pub depth: u32,
    /// Most points of a branch.
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
    /// The event that it happens to, from 0; 0 where it is the whole orbit's.
    pub event: usize,
    /// The branch on which it was found.
    pub branch: usize,
    /// The points of that branch before it.
    pub after: usize,
    /// The orbit.
    pub point: Point,
    /// Other branches through it.
    pub leads_to: Vec<usize>,
    /// Why no other branch was followed from here; `None` if one was, or none was asked for.
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

/// Values of the key within this share of its range, and orbits within the same, are one node.
const NODE: f64 = 1e-6;

/// Follows the orbits of `family` from `start`, an orbit at the key's value `value`, in both
/// directions, and switches to the branches that begin at special points. `seen` is told each
/// point.
///
/// ```
/// use signorini::orbit::{Problem, branch};
/// use signorini::{Load, Scene, Wall};
///
/// // The source oscillator's symmetric orbit in the frequency: it ends at a fold.
/// let family = |frequency: f64| {
///     Ok(Scene::oscillator(1.0, 0.2, 100.0)
///         .with_wall(Wall::upper("upper", 5e-3).with_restitution(0.8))
///         .with_wall(Wall::lower("lower", -5e-3).with_restitution(0.8))
///         .with_load(Load::harmonic(3.0, frequency, 0.0)))
/// };
/// let start = Problem::new(family(5.0)?)?.settled(200)?;
/// let request = branch::Request { range: [5.0, 16.0], switch: branch::Switch::No, depth: 0, points: 2000 };
/// let graph = branch::graph(&family, &start, 5.0, &request, &mut |_| ())?;
/// let fold = graph.specials.iter().find(|special| special.label == branch::Label::Fold).unwrap();
/// assert!((fold.point.value - 14.610_019_877_539_26).abs() < 1e-9); // Hz
///
/// // The larger multiplier over the range.
/// for point in graph.branches[0].points.iter().step_by(50) {
///     let [re, im] = point.floquet.multipliers[0];
///     println!("{:.3} Hz: {:.4}", point.value, re.hypot(im));
/// }
/// # Ok::<(), signorini::Error>(())
/// ```
///
/// # Errors
/// [`Error::Invalid`] for a range that is none, or a start outside of it; [`Error::NoOrbit`] for a
/// start that is no orbit, or one that no body can follow, or whose impacts accumulate; those of
/// `family` at the start.
pub fn graph(
    family: &Family<'_>,
    start: &Orbit,
    value: f64,
    request: &Request,
    seen: &mut dyn FnMut(&Point),
) -> Result<Graph> {
    let [low, high] = request.range;
    if !(low.is_finite() && high.is_finite() && low < high) {
        return Err(Error::invalid("range", format!("{low:?} to {high:?}"), "two numbers, the first below the second"));
    }
    if !(low..=high).contains(&value) {
        return Err(Error::invalid("start", value, format!("a value of the key from {low:?} to {high:?}")));
    }
    let problem = Problem::new(family(value)?)?;
    let width = high - low;
    // An orbit whose symmetry the key breaks is followed as a whole.
    let beside = if value + 1e-3 * width <= high { value + 1e-3 * width } else { value - 1e-3 * width };
    let keeps = Problem::new(family(beside)?)?.is_symmetric();
    let orbit = problem.correct(&if keeps { start.clone() } else { start.unfolded(problem.mirror()) })?;
    if let Some(reason) = problem.admissible(&orbit)?.reason(problem.scene()) {
        return Err(Error::no_orbit(format!("no body can follow the start: {reason}")));
    }
    let curve = Curve { family, signature: orbit.signature.clone(), scales: Scales::of(&problem), width };
    let y = curve.gather(&problem, &orbit, value);
    let n = y.len();
    let along = DVector::from_fn(n, |i, _| if i + 1 == n { 1.0 } else { 0.0 });
    let mut net = Net { graph: Graph::default(), queue: VecDeque::new(), request, width };
    net.both(curve, y, &along, None, 0, seen)?;
    while let Some((special, passed, curve)) = net.queue.pop_front() {
        net.leave(special, &passed, &curve, seen);
    }
    Ok(net.graph)
}

struct Net<'a, 'r> {
    graph: Graph,
    queue: VecDeque<(usize, Passed, Curve<'a>)>,
    request: &'r Request,
    width: f64,
}

impl<'a> Net<'a, '_> {
    /// Follows a branch to both sides of `y`, and adds it.
    fn both(
        &mut self,
        curve: Curve<'a>,
        y: DVector<f64>,
        along: &DVector<f64>,
        from: Option<usize>,
        depth: u32,
        seen: &mut dyn FnMut(&Point),
    ) -> Result<()> {
        let Request { range, points, .. } = *self.request;
        let linear = curve.linear(&y)?;
        let tangent = curve.tangent(&linear, along)?;
        let ahead = follow(&curve, y.clone(), &tangent, range, points, seen)?;
        let behind = match ahead.end {
            End::Closed => Line { points: Vec::new(), passed: Vec::new(), end: End::Closed },
            _ => follow(&curve, y, &(-&tangent), range, points, seen)?,
        };
        let before = behind.points.len().saturating_sub(1);
        let mut all: Vec<Point> = behind.points.into_iter().skip(1).rev().collect();
        all.extend(ahead.points);
        let number = self.graph.branches.len();
        self.graph.branches.push(Branch { points: all, from, depth, ends: [Some(behind.end), Some(ahead.end)] });
        for mut passed in behind.passed.into_iter().rev() {
            passed.after = (before + 1).saturating_sub(passed.after);
            self.note(number, passed, &curve);
        }
        for mut passed in ahead.passed {
            passed.after += before;
            self.note(number, passed, &curve);
        }
        Ok(())
    }

    fn note(&mut self, branch: usize, passed: Passed, curve: &Curve<'a>) {
        let special = Special {
            label: passed.label,
            event: passed.event,
            branch,
            after: passed.after,
            point: passed.point.clone(),
            leads_to: Vec::new(),
            reason: None,
        };
        let number = self.graph.specials.len();
        self.graph.specials.push(special);
        let copy =
            Curve { family: curve.family, signature: curve.signature.clone(), scales: curve.scales, width: self.width };
        self.queue.push_back((number, passed, copy));
    }

    /// Whether the branch has stable orbits beside the special point.
    fn stable_beside(&self, special: usize) -> bool {
        let Some(special) = self.graph.specials.get(special) else { return false };
        let Some(branch) = self.graph.branches.get(special.branch) else { return false };
        let beside = special.after.saturating_sub(1)..(special.after + 2).min(branch.points.len());
        // At the point itself a multiplier may be infinite.
        branch.points.get(beside).into_iter().flatten().any(|point| point.floquet.is_stable())
    }

    /// Follows the branch that begins at a special point, unless it is known.
    fn leave(&mut self, number: usize, passed: &Passed, curve: &Curve<'a>, seen: &mut dyn FnMut(&Point)) {
        let depth =
            self.graph.specials.get(number).and_then(|s| self.graph.branches.get(s.branch)).map_or(0, |b| b.depth);
        let wanted = match self.request.switch {
            Switch::No => false,
            Switch::Stable => self.stable_beside(number),
            Switch::All => true,
        };
        if !wanted || depth >= self.request.depth || passed.label == Label::Fold {
            return;
        }
        let outcome = curve.switch(passed).and_then(|begin| {
            let problem = begin.curve.problem(&begin.y)?;
            let orbit = begin.curve.orbit(&problem, &begin.y);
            if let Some(known) = self.known(number, &orbit, &problem) {
                return Ok(known);
            }
            let next = self.graph.branches.len();
            if begin.both {
                self.both(begin.curve, begin.y, &begin.along, Some(number), depth + 1, seen)?;
                return Ok(next);
            }
            let Request { range, points, .. } = *self.request;
            let line = follow(&begin.curve, begin.y, &begin.along, range, points, seen)?;
            let branch =
                Branch { points: line.points, from: Some(number), depth: depth + 1, ends: [None, Some(line.end)] };
            self.graph.branches.push(branch);
            for passed in line.passed {
                self.note(next, passed, &begin.curve);
            }
            Ok(next)
        });
        let Some(special) = self.graph.specials.get_mut(number) else { return };
        match outcome {
            Ok(branch) => special.leads_to.push(branch),
            Err(error) => special.reason = Some(error.to_string()),
        }
    }

    /// The branch that has `orbit`'s signature and a special point here already.
    fn known(&self, number: usize, orbit: &Orbit, problem: &Problem) -> Option<usize> {
        let here = self.graph.specials.get(number)?;
        let bare = self.bare(&here.point.orbit, problem);
        let whole = orbit.unfolded(problem.mirror());
        let same = |special: &Special| {
            (special.point.value - here.point.value).abs() <= NODE * self.width
                && self.bare(&special.point.orbit, problem).is(&bare, NODE)
        };
        let alike = |branch: &Branch| {
            let Some(first) = branch.points.first() else { return false };
            let other = first.orbit.unfolded(problem.mirror());
            let count = whole.signature.events.len();
            other.signature.periods == whole.signature.periods
                && other.signature.events.len() == count
                && (count == 0
                    || (0..count).any(|shift| {
                        (0..count).all(|i| other.signature.events[i] == whole.signature.events[(i + shift) % count])
                    }))
        };
        self.graph.branches.iter().enumerate().position(|(index, branch)| {
            let meets = self
                .graph
                .specials
                .iter()
                .enumerate()
                .any(|(other, special)| other != number && special.branch == index && same(special));
            let begins = branch.from.and_then(|from| self.graph.specials.get(from)).is_some_and(same);
            index != here.branch && alike(branch) && (meets || begins)
        })
    }

    /// The whole orbit without its events of speed 0.
    fn bare(&self, orbit: &Orbit, problem: &Problem) -> Orbit {
        let whole = orbit.unfolded(problem.mirror());
        let least = NODE * problem.scales()[1];
        let kept: Vec<usize> = (0..whole.phases.len()).filter(|&i| whole.speeds[i].abs() > least).collect();
        let mut bare = whole.clone();
        bare.signature.events = kept.iter().map(|&i| whole.signature.events[i]).collect();
        bare.phases = kept.iter().map(|&i| whole.phases[i]).collect();
        bare.speeds = kept.iter().map(|&i| whole.speeds[i]).collect();
        problem.halves(&bare).map_or(bare, |(once, _)| once.unfolded(problem.mirror()))
    }
}
