//! Branches joined at their special points.

use super::super::periodic::Orbit;
use super::arclength::{Vector, unit};
use super::label::Label;
use super::line::{Begin, End, Followed, Line, Metric, NODE, Passed};
use super::point::Point;
use super::request::{Branch, Graph, Request, Special, Switch};
use crate::error::{Error, Result};
use std::collections::VecDeque;

/// The graph found so far, and the special points whose branches have not been followed yet.
pub(super) struct Net<'r, C> {
    graph: Graph,
    queue: VecDeque<(usize, Passed<C>)>,
    request: &'r Request,
    /// For each branch, the number of its own points plus those of the branches that it continues.
    used: Vec<usize>,
}

impl<'r, C: Followed> Net<'r, C> {
    pub fn new(request: &'r Request) -> Self {
        Self { graph: Graph::default(), queue: VecDeque::new(), request, used: Vec::new() }
    }

    /// All branches asked for; the first goes through `y` in the direction in which the key grows.
    pub fn from(mut self, curve: C, y: Vector, seen: &mut dyn FnMut(&Point)) -> Result<Graph> {
        let along = unit(y.len(), y.len() - 1);
        self.both(&curve, y, &along, None, (0, 0), seen)?;
        while let Some((special, passed)) = self.queue.pop_front() {
            self.leave(special, passed, seen);
        }
        Ok(self.graph)
    }

    fn add(&mut self, branch: Branch, before: usize) -> usize {
        self.used.push(before + branch.points.len());
        self.graph.branches.push(branch);
        self.graph.branches.len() - 1
    }

    /// Follows a branch from `y` in both directions, and adds it; `depth` switches lead to it, and
    /// the branches that it continues have `used` points.
    fn both(
        &mut self,
        curve: &C,
        y: Vector,
        along: &Vector,
        from: Option<usize>,
        (depth, used): (u32, usize),
        seen: &mut dyn FnMut(&Point),
    ) -> Result<()> {
        let range = self.request.range;
        let points = self.request.points.saturating_sub(used);
        let tangent = curve.tangent_at(&y, along)?;
        let ahead = curve.follow(y.clone(), &tangent, range, points, seen)?;
        let behind = match ahead.end {
            End::Closed => Line { points: Vec::new(), passed: Vec::new(), end: End::Closed },
            _ => curve.follow(y, &(-&tangent), range, points, seen)?,
        };
        let before = behind.points.len().saturating_sub(1);
        let mut all: Vec<Point> = behind.points.into_iter().skip(1).rev().collect();
        all.extend(ahead.points);
        let number = self.add(Branch { points: all, from, depth, ends: [Some(behind.end), Some(ahead.end)] }, used);
        for mut passed in behind.passed.into_iter().rev() {
            passed.after = (before + 1).saturating_sub(passed.after);
            self.note(number, passed);
        }
        for mut passed in ahead.passed {
            passed.after += before;
            self.note(number, passed);
        }
        Ok(())
    }

    fn note(&mut self, branch: usize, passed: Passed<C>) {
        let special = Special {
            label: passed.label,
            event: passed.event,
            wall: passed.wall,
            branch,
            after: passed.after,
            point: passed.point.clone(),
            leads_to: Vec::new(),
            reason: None,
        };
        self.queue.push_back((self.graph.specials.len(), passed));
        self.graph.specials.push(special);
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
    fn leave(&mut self, number: usize, mut passed: Passed<C>, seen: &mut dyn FnMut(&Point)) {
        let own = self.graph.specials.get(number).map_or(0, |special| special.branch);
        let depth = self.graph.branches.get(own).map_or(0, |branch| branch.depth);
        // Beyond a change of its contacts the same curve continues: this does not count as a
        // switch.
        let goes_on = passed.beyond.is_some();
        if passed.label == Label::Fold || !goes_on && self.request.switch == Switch::No {
            return;
        }
        let against = if goes_on { None } else { self.against(number, depth) };
        let depth = depth + u32::from(!goes_on);
        let used = if goes_on { self.used.get(own).copied().unwrap_or(0) } else { 0 };
        let begin = match (&against, passed.beyond.take()) {
            (Some(reason), _) if self.request.switch == Switch::Stable => Err(reason.clone()),
            (_, Some(begin)) => Ok(*begin),
            (_, None) => passed.curve.switch(&passed).map_err(|error| error.to_string()),
        };
        let outcome = match (begin, against) {
            // A branch that is not wanted may be known.
            (Ok(begin), Some(reason)) => self.meets(number, &begin).map(Some).ok_or(reason),
            (Err(_), Some(reason)) | (Err(reason), None) => Err(reason),
            (Ok(begin), None) => self.begin(number, begin, (depth, used), seen).map_err(|error| error.to_string()),
        };
        let Some(special) = self.graph.specials.get_mut(number) else { return };
        match outcome {
            Ok(Some(branch)) => special.leads_to.push(branch),
            Ok(None) => special.reason = Some("its curve has as many points as were asked for".to_owned()),
            Err(reason) => special.reason = Some(reason),
        }
    }

    /// The known branch with which the one that begins at special point `number` coincides.
    fn meets(&self, number: usize, begin: &Begin<C>) -> Option<usize> {
        let (orbit, metric) = begin.curve.orbit_at(&begin.y).ok()?;
        self.known(number, &orbit, &metric)
    }

    /// Why the request does not want the branch that begins at a special point of a branch to which
    /// `depth` switches lead.
    fn against(&self, special: usize, depth: u32) -> Option<String> {
        if self.request.switch == Switch::Stable && !self.stable_beside(special) {
            return Some("no orbit of its own branch beside it is stable".to_owned());
        }
        let most = self.request.depth;
        (depth >= most)
            .then(|| format!("it is {} switches from the first branch, and at most {most} were asked for", depth + 1))
    }

    /// Follows the branch that begins at special point `number`; gives its number, or that of the
    /// known branch with which it coincides. `None` where no points are left for it.
    fn begin(
        &mut self,
        number: usize,
        begin: Begin<C>,
        (depth, used): (u32, usize),
        seen: &mut dyn FnMut(&Point),
    ) -> Result<Option<usize>> {
        let Begin { curve, y, along, both } = begin;
        let (orbit, metric) = curve.orbit_at(&y)?;
        if orbit.part(metric.mirror.as_deref()).is_some() {
            return Err(Error::no_orbit(
                "beside it only the orbits of this branch were found, run over more than once",
            ));
        }
        if let Some(known) = self.known(number, &orbit, &metric) {
            return Ok(Some(known));
        }
        let Request { range, points, .. } = *self.request;
        if used >= points {
            return Ok(None);
        }
        let next = self.graph.branches.len();
        if both {
            self.both(&curve, y, &along, Some(number), (depth, used), seen)?;
            return Ok(Some(next));
        }
        let line = curve.follow(y, &along, range, points - used, seen)?;
        self.add(Branch { points: line.points, from: Some(number), depth, ends: [None, Some(line.end)] }, used);
        for passed in line.passed {
            self.note(next, passed);
        }
        Ok(Some(next))
    }

    /// The known branch with `orbit`'s signature and a special point at this orbit.
    fn known(&self, number: usize, orbit: &Orbit, metric: &Metric) -> Option<usize> {
        let mirror = metric.mirror.as_deref();
        let here = self.graph.specials.get(number)?;
        let bare = bare(&here.point.orbit, metric);
        let whole = orbit.unfolded(mirror);
        let [low, high] = self.request.range;
        let same = |special: &Special| {
            (special.point.value - here.point.value).abs() <= NODE * (high - low)
                && self::bare(&special.point.orbit, metric).is(&bare, metric.near)
        };
        let alike = |branch: &Branch| {
            let Some(first) = branch.points.first() else { return false };
            let other = first.orbit.unfolded(mirror);
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
}

/// The whole orbit without its events of speed 0.
fn bare(orbit: &Orbit, metric: &Metric) -> Orbit {
    let mirror = metric.mirror.as_deref();
    let whole = orbit.unfolded(mirror);
    let least = metric.near * metric.speed;
    let kept: Vec<usize> = (0..whole.phases.len()).filter(|&i| whole.speeds[i].abs() > least).collect();
    let mut bare = whole.clone();
    bare.signature.events = kept.iter().map(|&i| whole.signature.events[i]).collect();
    bare.phases = kept.iter().map(|&i| whole.phases[i]).collect();
    bare.speeds = kept.iter().map(|&i| whole.speeds[i]).collect();
    bare.part(mirror).map_or(bare, |(once, _)| once.unfolded(mirror))
}
