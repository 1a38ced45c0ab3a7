//! The step of one degree of freedom that may meet a wall: Newton's method in a bracket.

use super::{LawResponse, Penalty};
use crate::error::{Error, Result};
use crate::scheme::frame::Frame;
use crate::scheme::space::Space;

/// Maximum number of Newton iterations. A few are enough; reaching this many means that numbers are
/// not finite.
const NEWTON_LIMIT: u64 = 200;

impl<S: Space> Penalty<S> {
    /// v_θ of one degree of freedom in a step that may meet a wall, whose impulses it writes: the
    /// root of (A/θ)(v_θ − v) − b − h Gᵀ P̄, a function that increases with it.
    #[inline(never)]
    pub(super) fn solve_alone(&mut self, frame: &mut Frame<S>, step: u64) -> Result<f64> {
        let v = frame.v[0];
        let (mut lo, mut hi) = (f64::NEG_INFINITY, f64::INFINITY);
        let mut mean = v + self.theta * self.delta[0];
        for _ in 0..NEWTON_LIMIT {
            self.walls.iterations += 1;
            let size = self.evaluate_laws(mean, v);
            let (residual, slope) = self.balance(mean, v);
            // Below two units of rounding of the terms that cancel, the residual is rounding error.
            if residual.abs() <= 2.0 * f64::EPSILON * size {
                return Ok(self.balanced_velocity(mean, frame));
            }
            if residual > 0.0 {
                hi = hi.min(mean);
            } else {
                lo = lo.max(mean);
            }
            let next = mean - residual / slope;
            let bracketed = lo.is_finite() && hi.is_finite() && !(next > lo && next < hi);
            let next = if bracketed { 0.5 * (lo + hi) } else { next };
            if next == mean || next == lo || next == hi {
                // A face may lie between both ends: the steeper side has all walls in contact.
                let steepness = |this: &mut Self, mean: f64| {
                    this.evaluate_laws(mean, v);
                    this.balance(mean, v).1
                };
                let other = if next == mean || next == lo { hi } else { lo };
                let steeper = other.is_finite() && steepness(self, other) > steepness(self, next);
                let mean = if steeper { other } else { next };
                self.evaluate_laws(mean, v);
                return Ok(self.balanced_velocity(mean, frame));
            }
            mean = next;
        }
        let (residual, _) = self.balance(mean, v);
        Err(Error::Newton { time: frame.start, step, residual: residual.abs() / self.body.h })
    }

    /// Takes the forces of the walls and their slopes at v_θ = `mean`, and returns the size of the
    /// terms of [`Self::balance`].
    fn evaluate_laws(&mut self, mean: f64, v: f64) -> f64 {
        let mut size = self.alone * (mean.abs() + v.abs()) + self.b[0].abs();
        for wall in 0..self.rate.len() {
            let weight = self.rate[wall];
            let LawResponse { force, slope, noise } = self.law_response(wall, weight * mean);
            (self.walls.force[wall], self.walls.slope[wall]) = (force, slope);
            // The depth itself has the rounding error of its terms.
            size += self.body.h * weight.abs() * (force.abs() + slope * (noise + (weight * mean).abs()));
        }
        size
    }

    /// (A/θ)(v_θ − v) − b − h Gᵀ P̄ at v_θ = `mean` with the forces taken there, and its slope.
    fn balance(&self, mean: f64, v: f64) -> (f64, f64) {
        let (mut residual, mut slope) = (self.alone * (mean - v) - self.b[0], self.alone);
        for wall in 0..self.rate.len() {
            let (h, weight) = (self.body.h, self.rate[wall]);
            residual -= h * weight * self.walls.force[wall];
            slope += h * weight * weight * self.walls.slope[wall];
        }
        (residual, slope)
    }

    /// v_θ where the tangents of the laws at `mean` keep the balance, and writes the impulses of
    /// these forces. A wall that would pull, which is rounding error, has no force.
    fn balanced_velocity(&mut self, mean: f64, frame: &mut Frame<S>) -> f64 {
        loop {
            let (residual, slope) = self.balance(mean, frame.v[0]);
            let shift = -residual / slope;
            let mut pulls = false;
            for wall in 0..self.rate.len() {
                let force = self.walls.force[wall] - self.walls.slope[wall] * self.rate[wall] * shift;
                frame.force[wall] = force;
                if force * self.walls.force[wall] < 0.0 {
                    (self.walls.force[wall], self.walls.slope[wall], pulls) = (0.0, 0.0, true);
                }
            }
            if !pulls {
                frame.push_by_force(self.body.h);
                return mean + shift;
            }
        }
    }
}
