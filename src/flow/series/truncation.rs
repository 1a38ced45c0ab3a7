//! Where a series is cut: after how many terms, and at which end of its stretch, so that what it
//! leaves out is below rounding.

use super::{Series, TERMS};

/// Length of the longest stretch, in radians of the fastest motion: no term of its series is more
/// than twice the motion.
pub(super) const RADIANS: f64 = 2.0;

/// The series ends where a term of the acceleration is below this share of the first.
pub(super) const LAST: f64 = 1e-18;

/// Minimum number of terms, so that oscillations of the load are included besides its constant and
/// ramp.
pub(super) const FEWEST: usize = 8;

/// If the last term is above this share of the largest, the fastest rate was underestimated and the
/// stretch is cut.
const TRUNCATION: f64 = 1e-16;

/// The same for a stretch along a circle. Its series is that of elliptic functions, whose terms
/// fall geometrically, so that the sum of all terms left out is at most twice this.
const ROUND_TRUNCATION: f64 = 2e-17;

/// The largest term of the motion at a round hole over a stretch, in γ: the structure may cross the
/// hole within it.
const MOST_TRAVEL: f64 = 2.0;

/// A stretch is not cut below this share of the time at which it starts: it would not end later.
const SHORTEST: f64 = 16.0 * f64::EPSILON;

impl Series {
    /// True if the terms of the motion and of the `slots` forces, whose last is that of order `k`,
    /// have fallen below rounding: along circles, no bound on the terms is known before.
    pub(super) fn vanishes(&self, k: usize, slots: usize) -> bool {
        let n = self.n;
        let vanish = |size: &dyn Fn(usize) -> f64, last: usize| {
            let least = LAST * (0..4).map(size).fold(0.0, f64::max);
            (last - 2..=last).rev().all(|k| size(k) <= least)
        };
        vanish(&|k| self.motion[k * n..(k + 1) * n].iter().fold(0.0, |a: f64, x| a.max(x.abs())), k + 2)
            && self.circles.iter().all(|circle| vanish(&|k| circle.size(k), k + 2))
            && (0..slots).all(|slot| vanish(&|k| self.forces[slot * TERMS + k].abs(), k))
    }

    /// Cuts a stretch along circles, whose series converge on a part of the unit only, to where the
    /// last terms of motion and forces are below rounding, and makes its length the unit.
    pub(super) fn shorten(&mut self, slots: std::ops::Range<usize>) {
        let (n, top) = (self.n, self.terms - 1);
        let mut share = 1.0_f64;
        let mut observe = |size: &dyn Fn(usize) -> f64, last: usize| {
            let largest = (0..4).map(size).fold(0.0, f64::max);
            let end = size(last).max(size(last - 1));
            if end > ROUND_TRUNCATION * largest && largest > 0.0 {
                share = share.min((ROUND_TRUNCATION * largest / end).powf(1.0 / (last - 1) as f64));
            }
        };
        observe(&|k| self.motion[k * n..(k + 1) * n].iter().fold(0.0, |a: f64, x| a.max(x.abs())), top);
        for circle in &self.circles {
            observe(&|k| circle.size(k), top);
        }
        for slot in slots {
            observe(&|k| self.forces[slot * TERMS + k].abs(), top - 2);
        }
        self.scale(share);
        self.rate = self.rate.max(RADIANS / self.longest);
    }

    /// Cuts the stretch to where no term of the motion at a hole exceeds [`MOST_TRAVEL`] of its
    /// gap: the gap polynomial (γ² − |w|²)/2γ has the rounding error of its largest value, which
    /// far behind the hole is that of |w|²/2γ.
    pub(super) fn stay_near(&mut self) {
        let mut share = 1.0_f64;
        for circle in &self.circles {
            let most = MOST_TRAVEL * circle.radius;
            for k in (1..self.terms).filter(|&k| circle.size(k) > most) {
                share = share.min((most / circle.size(k)).powf(1.0 / k as f64));
            }
        }
        self.scale(share.max(SHORTEST * self.start / self.unit));
    }

    /// Makes this share of the unit the new one, and ends the stretch there; 1 or more changes
    /// nothing.
    fn scale(&mut self, share: f64) {
        if share >= 1.0 {
            return;
        }
        let (n, mut power) = (self.n, 1.0);
        for k in 0..self.terms {
            self.motion[k * n..(k + 1) * n].iter_mut().for_each(|a| *a *= power);
            self.seen.iter_mut().skip(k).step_by(TERMS).for_each(|c| *c *= power);
            self.forces.iter_mut().skip(k).step_by(TERMS).for_each(|c| *c *= power);
            self.circles.iter_mut().for_each(|circle| circle.scale(k, power));
            power *= share;
        }
        self.unit *= share;
        self.longest = self.unit;
        self.end = self.end.min(self.start + self.unit);
    }

    /// Shortens the stretch to where its last terms are below rounding, if they are not.
    pub(super) fn check(&mut self) {
        let n = self.n;
        let size = |k: usize| self.motion[k * n..(k + 1) * n].iter().fold(0.0_f64, |a, x| a.max(x.abs()));
        let last = size(self.terms - 1).max(size(self.terms - 2));
        let largest = (0..4.min(self.terms)).map(size).fold(0.0, f64::max);
        if last > TRUNCATION * largest && largest > 0.0 {
            let share = (TRUNCATION * largest / last).powf(1.0 / (self.terms - 2) as f64);
            self.end = self.end.min(self.start + share * self.unit);
        }
    }
}

/// The number of terms after which all are below `least` at x = 1, for a motion of `radians`:
/// terms of the acceleration go as xᵏ⁻²/(k − 2)!.
pub(super) fn terms_for(radians: f64, least: f64) -> usize {
    let (mut term, mut k) = (1.0, 0);
    while term > least && k + 3 < TERMS {
        k += 1;
        term *= radians / k as f64;
    }
    (k + 3).max(FEWEST)
}
