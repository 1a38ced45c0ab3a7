//! The largest force of a wall or support. Of an elastic one it is that at an instant. Impacts have
//! no largest force, but the impulse of a stretch of one length has a largest value, whatever the
//! rows, the step and the scheme: of a rigid one it is the largest mean over any such stretch.

use crate::step::Contact;
use serde::{Deserialize, Serialize};
use std::collections::VecDeque;

/// The largest mean of |force| over any stretch of one length within a window, or at an elastic
/// wall or support the largest |force|.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
#[non_exhaustive]
pub struct LargestForce {
    /// Σ|p| in that stretch over its length, or |force|, N.
    pub mean_n: f64,
    /// The middle of the stretch, or of the contact with that force, s. Where a later stretch holds
    /// the same, as about a single impact, it is the middle of what pushes: the instant of that
    /// impact.
    pub at_s: f64,
    /// The length, s; 0 for a force at an instant.
    pub averaged_over_s: f64,
}

/// The share of the largest force at an instant from which on the largest mean is near it.
const NEARLY: f64 = 0.9;

impl LargestForce {
    /// The largest finite force of `contacts` between two times (s), at the middle of its contact;
    /// of the last where several are equal.
    pub(super) fn of_contacts<'a>(contacts: impl Iterator<Item = &'a Contact>, [from, to]: [f64; 2]) -> Option<Self> {
        let middle = |c: &Contact| 0.5 * (c.start.max(from) + c.end.unwrap_or(to).min(to));
        let peaks = contacts.filter_map(|c| Some((middle(c), c.peak_force?)));
        let largest = peaks.max_by(|a, b| a.1.total_cmp(&b.1));
        largest.map(|(at_s, mean_n)| Self { mean_n, at_s, averaged_over_s: 0.0 })
    }

    /// That of an elastic wall or support, from its largest force at an `instant` and its largest
    /// `mean`. The mean is larger, by more than rounding, only where several flats of a support
    /// push at once; with no `instant` it is what remains.
    pub(super) fn of_elastic(instant: Option<Self>, mean: Option<Self>) -> Option<Self> {
        let (Some(peak), Some(stretch)) = (instant, mean) else { return instant.or(mean) };
        if stretch.mean_n > (1.0 + 1e-9) * peak.mean_n {
            return mean;
        }
        // Where the largest mean is nearly the largest force, that acts in its stretch.
        let at_s = if stretch.mean_n >= NEARLY * peak.mean_n { stretch.at_s } else { peak.at_s };
        Some(Self { at_s, ..peak })
    }
}

/// Σ|p| up to an instant, before and after what acts at the instant itself, N s.
#[derive(Debug, Clone, Copy)]
struct Point {
    time: f64,
    before: f64,
    after: f64,
}

/// Finds the largest impulse of any stretch of a given length.
///
/// Σ|p| is linear between the points at which it was given: the impulse of a stretch is then
/// largest where the stretch begins or ends at a point.
#[derive(Debug, Clone)]
pub(super) struct LargestStretch {
    /// s.
    length: f64,
    /// The points of the last stretch, and the one before them.
    points: VecDeque<Point>,
    /// Number of `points` from which a stretch that begins there has been measured.
    measured: usize,
    /// The largest impulse, N s, and the middle of its stretch, s.
    largest: (f64, f64),
}

impl LargestStretch {
    pub fn new(length: f64) -> Self {
        Self { length, points: VecDeque::new(), measured: 0, largest: (0.0, 0.0) }
    }

    /// Adds an impulse of size `p` (N s) that acts evenly between two times (s), after all others.
    pub fn add(&mut self, [from, to]: [f64; 2], p: f64) {
        if p == 0.0 {
            return;
        }
        self.pass_to(from);
        let sum = self.sum();
        self.points.push_back(Point { time: to, before: sum + p, after: sum + p });
        self.measure(to);
    }

    /// Adds an impulse of size `p` (N s) at the instant `t` (s), after all others.
    pub fn jump(&mut self, t: f64, p: f64) {
        if p == 0.0 {
            return;
        }
        self.pass_to(t);
        if let Some(last) = self.points.back_mut() {
            last.after += p;
        }
        self.measure(t);
    }

    /// The largest mean; `None` where nothing has pushed.
    pub fn largest(&self) -> Option<LargestForce> {
        let (impulse, at_s) = self.largest;
        let averaged_over_s = self.length;
        // A stretch may begin before the run does.
        let at_s = at_s.max(0.0);
        (impulse > 0.0).then(|| LargestForce { mean_n: impulse / averaged_over_s, at_s, averaged_over_s })
    }

    fn sum(&self) -> f64 {
        self.points.back().map_or(0.0, |last| last.after)
    }

    /// Ends the time without an impulse at `t` (s), where a point begins.
    fn pass_to(&mut self, t: f64) {
        if self.points.back().is_some_and(|last| last.time >= t) {
            return;
        }
        let sum = self.sum();
        let start = Point { time: t, before: sum, after: sum };
        self.points.push_back(start);
        self.measure(t);
        // Sums begin anew after a pause, so that they do not lose digits over a long window.
        if self.points.len() >= 2 && self.points.iter().rev().nth(1).is_some_and(|last| last.time < t - self.length) {
            self.points = VecDeque::from([Point { time: t, before: 0.0, after: 0.0 }]);
            self.measured = 0;
        }
    }

    /// Measures the stretches that end at the last point, `t`, and that end before it and begin at
    /// a point; then forgets the points that no later stretch reaches.
    fn measure(&mut self, t: f64) {
        // No stretch has more than all that is kept, which is seldom more than the largest so far.
        let all = self.sum() - self.points.front().map_or(0.0, |first| first.before);
        let may_be_largest = all > self.largest.0;
        while let Some(first) = self.points.get(self.measured).copied().filter(|p| p.time + self.length <= t) {
            self.measured += 1;
            if may_be_largest {
                let impulse = self.sum_at(first.time + self.length, |point| point.after) - first.before;
                self.note(impulse, first.time + 0.5 * self.length);
            }
        }
        if may_be_largest {
            let from = t - self.length;
            let before = self.sum_at(from, |point| point.before);
            self.note(self.sum() - before, 0.5 * (self.first_push(from, before) + t));
        }
        while self.points.get(1).is_some_and(|next| next.time <= t - self.length) {
            self.points.pop_front();
            self.measured = self.measured.saturating_sub(1);
        }
    }

    fn note(&mut self, impulse: f64, middle: f64) {
        if impulse > self.largest.0 {
            self.largest = (impulse, middle);
        }
    }

    /// The first instant from `from` (s) on at which something pushes, s, where Σ|p| up to there is
    /// `before`, N s.
    fn first_push(&self, from: f64, before: f64) -> f64 {
        let next = self.points.iter().position(|point| point.after > before);
        let Some((index, point)) = next.and_then(|index| Some((index, self.points.get(index)?))) else { return from };
        let last = index.checked_sub(1).and_then(|index| self.points.get(index));
        let begins = if point.before > before { last.map_or(from, |last| last.time) } else { point.time };
        begins.max(from)
    }

    /// Σ|p| up to `t` (s), at a point on the `side` given.
    fn sum_at(&self, t: f64, side: fn(&Point) -> f64) -> f64 {
        let next = self.points.partition_point(|point| point.time < t);
        let before = next.checked_sub(1).and_then(|index| self.points.get(index));
        match (before, self.points.get(next)) {
            (_, Some(point)) if point.time == t => side(point),
            (Some(a), Some(b)) => a.after + (b.before - a.after) * (t - a.time) / (b.time - a.time),
            (Some(last), None) => last.after,
            (None, first) => first.map_or(0.0, |first| first.before),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::hash::next_unit;

    fn found(stretch: &LargestStretch) -> (f64, f64) {
        let largest = stretch.largest().expect("a push");
        assert_eq!(largest.averaged_over_s, stretch.length);
        (largest.mean_n, largest.at_s)
    }

    #[test]
    fn impacts_within_a_stretch_add_up_wherever_it_lies() {
        let mut stretch = LargestStretch::new(1.0);
        assert_eq!(stretch.largest(), None);
        // Three within 0.9 s, across any grid of stretches; alone none is as large.
        for (t, p) in [(0.5, 2.5), (3.55, 1.0), (3.95, 1.5), (4.45, 0.5), (4.56, 1.4), (9.0, 2.9)] {
            stretch.jump(t, p);
        }
        // 1.5 + 0.5 + 1.4 from 3.95 to 4.56.
        let (mean, at) = found(&stretch);
        assert!((mean - 3.4).abs() < 1e-14 && (at - 4.255).abs() < 1e-14, "{mean} at {at}");
        // A larger one by itself, at its instant.
        stretch.jump(12.0, 3.5);
        assert_eq!(found(&stretch), (3.5, 12.0));
    }

    #[test]
    fn an_even_force_has_its_own_size_and_a_short_one_its_share() {
        let mut stretch = LargestStretch::new(1e-3);
        // 50 N over 0.4 ms.
        stretch.add([1.0, 1.0004], 0.02);
        assert!((found(&stretch).0 - 20.0).abs() < 1e-9);
        // 30 N over 2 ms, in steps of 0.3 ms: the rounding of a time of 2 s in a step of 0.3 ms.
        for k in 0..7 {
            let t = 2.0 + 3e-4 * f64::from(k);
            stretch.add([t, t + 3e-4], 30.0 * 3e-4);
        }
        assert!((found(&stretch).0 - 30.0).abs() < 1e-9, "{:?}", stretch.largest());
    }

    /// Against the largest of ten thousand stretches a length, each summed from all impulses.
    #[test]
    fn no_stretch_has_more_and_one_has_as_much() {
        let mut seed = 7_u64;
        let mut draw = || next_unit(&mut seed);
        for _ in 0..50 {
            let length = 0.05 + 0.3 * draw();
            let mut stretch = LargestStretch::new(length);
            let (mut t, mut pushes) = (0.0, Vec::new());
            while t < 3.0 {
                t += if draw() < 0.3 { 0.4 * draw() } else { 0.0 };
                let span = if draw() < 0.5 { 0.0 } else { 0.1 * draw() };
                let p = draw();
                if span == 0.0 {
                    stretch.jump(t, p)
                } else {
                    stretch.add([t, t + span], p)
                }
                pushes.push((t, t + span, p));
                t += span;
            }
            let within = |from: f64| -> f64 {
                let to = from + length;
                let part = |&(a, b, p): &(f64, f64, f64)| match b > a {
                    true => p * ((b.min(to) - a.max(from)) / (b - a)).clamp(0.0, 1.0),
                    false => {
                        if a >= from && a <= to {
                            p
                        } else {
                            0.0
                        }
                    }
                };
                pushes.iter().map(part).sum()
            };
            let (mean, at) = found(&stretch);
            let impulse = mean * length;
            let most = (0..10_000).map(|k| within(-1.0 + 5e-4 * f64::from(k))).fold(0.0, f64::max);
            // Rounding of sums below 50 N s; an instant at an end may be in or out by it.
            assert!(most <= impulse + 1e-12, "{most} {impulse}");
            let own = [-1e-12, 0.0, 1e-12].map(|off| within(at - 0.5 * length + off)).into_iter().fold(0.0, f64::max);
            assert!((own - impulse).abs() < 1e-9, "{own} {impulse} at {at}");
        }
    }
}
