//! Newton's method on the equations with explicit times.

use super::equations::{Closure, Equations};
use super::periodic::{Orbit, REPEATED};
use super::problem::Problem;
use super::signature::Signature;
use crate::error::{Error, Result};
use nalgebra::{DMatrix, DVector};

/// Most iterations.
const ITERATIONS: usize = 30;

/// Longest step, in the scaled unknowns.
const LONGEST: f64 = 2.0;

/// The equations are solved where the residual is below this …
pub(super) const SOLVED: f64 = 1e-12;

/// … or below this and no longer falls: rounding of a motion with large steady terms.
pub(super) const ACCEPTED: f64 = 1e-9;

impl Problem {
    /// The periodic orbit near `guess`, by Newton's method on the instants and speeds of its
    /// events. It converges from starts from which Newton's method on the map from period to period
    /// does not: from starts with an error of 3 % it also reaches orbits with multipliers of 1e8.
    /// Where the result repeats a shorter orbit, it is that one.
    ///
    /// The result may pass through a wall ([`Problem::admissible`] says so): the equations do not
    /// look at what happens between the events.
    ///
    /// # Errors
    /// [`Error::Invalid`] for a signature that the walls do not have, or a guess whose lists differ
    /// in length or are not finite; [`Error::NoOrbit`] where Newton's method does not converge, or
    /// where its result has events in another order.
    pub fn correct(&self, guess: &Orbit) -> Result<Orbit> {
        self.check(guess)?;
        if guess.signature.chatters() {
            return Err(Error::no_orbit(
                "impacts that accumulate are infinitely many: such an orbit is run, not solved",
            ));
        }
        if guess.signature.events.is_empty() {
            self.quiet()?;
            let signature = Signature { periods: 1, ..guess.signature.clone() };
            return Ok(Orbit { signature, forcing_period: self.forcing_period(), ..guess.clone() });
        }
        let found = self.solved(guess)?;
        let Some(once) = found.unfolded(self.mirror()).repeated(REPEATED) else { return Ok(found) };
        let half = once.folded(self.mirror(), REPEATED).filter(|_| found.signature.symmetric);
        self.solved(&half.unwrap_or(once))
    }

    /// The solution of the equations near `guess`, which must have events.
    fn solved(&self, guess: &Orbit) -> Result<Orbit> {
        let equations = Equations::new(self, &guess.signature, self.scales());
        let count = equations.unknowns();
        let mut arc = self.arc();
        let mut unknowns = equations.gather(guess);
        let (mut residual, mut matrix) = (DVector::zeros(count), DMatrix::zeros(count, count));
        let mut last = f64::INFINITY;
        for _ in 0..ITERATIONS {
            equations.evaluate(self, &mut arc, unknowns.as_slice(), &mut residual, Some((&mut matrix, Closure::Same)));
            let size = residual.amax();
            if !size.is_finite() {
                return Err(Error::no_orbit(
                    "in Newton's method the residual became NaN or infinite: the start is too far from an orbit",
                ));
            }
            // One more step after the residual is small enough costs little, and removes the rest
            // of the error.
            if last <= SOLVED || (size >= 0.5 * last && size <= ACCEPTED) {
                return self.ordered(equations.orbit(unknowns.as_slice(), self));
            }
            let Some(mut step) = matrix.clone().lu().solve(&residual) else {
                return Err(Error::no_orbit(
                    "the equations are singular there: a fold of the branch of orbits, or a doubly grazing one",
                ));
            };
            let length = step.norm();
            if length > LONGEST {
                step *= LONGEST / length;
            }
            unknowns -= step;
            last = size;
        }
        Err(Error::no_orbit(format!(
            "Newton's method did not converge in {ITERATIONS} iterations: the residual is {last:.1e} of the gap"
        )))
    }

    /// The orbit, if its instants are in order; it is shifted so that its first event falls into
    /// the first forcing period.
    fn ordered(&self, orbit: Orbit) -> Result<Orbit> {
        let turn = orbit.signature.cycles();
        let next = orbit.phases.iter().skip(1).copied().chain(orbit.phases.first().map(|phase| phase + turn));
        if let Some(index) = orbit.phases.iter().zip(next).position(|(phase, next)| next <= *phase) {
            let event = index + 1;
            return Err(Error::no_orbit(format!(
                "Newton's method ended where event {event} comes after the one that follows it: \
                 start nearer, or with another signature"
            )));
        }
        Ok(orbit.rotated(0, 1))
    }

    pub(super) fn check(&self, orbit: &Orbit) -> Result<()> {
        orbit.signature.check(self.scene())?;
        if orbit.signature.symmetric && !self.is_symmetric() {
            return Err(Error::invalid(
                "signature",
                "symmetric",
                "one that is not: the scene is not its own mirror image half a period later",
            ));
        }
        let count = orbit.signature.events.len();
        if orbit.phases.len() != count || orbit.speeds.len() != count {
            return Err(Error::invalid(
                "start",
                format!("{} phases and {} speeds", orbit.phases.len(), orbit.speeds.len()),
                format!("{count} of each, one for each event"),
            ));
        }
        match orbit.phases.iter().chain(&orbit.speeds).find(|x| !x.is_finite()) {
            Some(x) => Err(Error::invalid("start", x, "finite numbers")),
            None => Ok(()),
        }
    }
}
