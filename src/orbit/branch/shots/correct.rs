//! The points one step from another: Newton's method, first with the derivative of the other.

use super::Shots;
use super::step_start::StepStart;
use crate::error::{Error, Result};
use crate::orbit::branch::arclength::{Vector, bordered, extended, scaled, unit};
use crate::orbit::newton::SOLVED;
use crate::orbit::orbit_run::Recorded;

/// A step has stayed on the branch if it ends within this many step lengths of its start.
const NEAR: f64 = 2.0;

/// Most iterations with the derivative of the point before, and the factor by which each must
/// reduce the residual.
const CHORDS: usize = 10;
const FAST: f64 = 0.3;

impl Shots<'_> {
    /// The point one step from `now`, and the number of iterations of its correction.
    ///
    /// # Errors
    /// [`Error::NoOrbit`] where there is none nearby.
    pub(super) fn next(&self, now: &StepStart, step: f64) -> Result<(StepStart, usize)> {
        self.corrected(now, &(&now.y + &now.tangent * step), &now.tangent, step)
    }

    /// The same at the key's value `bound`, about a step from `now`.
    pub(super) fn at_bound(
        &self,
        now: &StepStart,
        bound: f64,
        range: [f64; 2],
        step: f64,
    ) -> Result<(StepStart, usize)> {
        let mut guess = &now.y + &now.tangent * step;
        let last = guess.len() - 1;
        guess[last] = scaled(bound, self.width, range);
        let (mut there, iterations) = self.corrected(now, &guess, &unit(last + 1, last), step)?;
        there.point.value = bound;
        Ok((there, iterations))
    }

    /// The point in the plane through `guess` with the normal `border`, one step from `now`.
    fn corrected(&self, now: &StepStart, guess: &Vector, border: &Vector, step: f64) -> Result<(StepStart, usize)> {
        let (y, linear, iterations) = match self.chord(now, guess, border)? {
            Some(y) => (y.clone(), self.linear(&y, &mut None)?, 0),
            None => self.correct(guess, border, Some(now.column.clone()))?,
        };
        if (&y - &now.y).norm() > NEAR * step.abs() {
            return Err(Error::no_orbit("Newton's method led too far from the branch"));
        }
        Ok((self.step_start(y, linear, &now.tangent)?, iterations))
    }

    /// The same point, by Newton's method with the derivative of `now` kept: an iteration then
    /// takes one run, while a new derivative takes as many as the state has entries. `None` where
    /// this does not converge fast.
    fn chord(&self, now: &StepStart, guess: &Vector, border: &Vector) -> Result<Option<Vector>> {
        let solver = bordered(&now.matrix, border).lu();
        let mut y = guess.clone();
        let mut last = f64::INFINITY;
        for _ in 0..CHORDS {
            let x = self.state(&y);
            let motion = self.run(&self.posed(self.value(&y))?, &x, Recorded::Events)?;
            let residual = self.scales.scaled(&(&motion.end * self.sign() - &x));
            let size = residual.amax();
            if last <= SOLVED {
                return Ok(Some(y));
            }
            if size.is_nan() || size > FAST * last {
                return Ok(None);
            }
            let Some(step) = solver.solve(&extended(&residual, border.dot(&(&y - guess)))) else { return Ok(None) };
            y -= step;
            last = size;
        }
        Ok(None)
    }
}
