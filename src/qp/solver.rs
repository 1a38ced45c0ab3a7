//! The solver of one programme after another.

use super::clamp::Clamp;
use super::condensed::Condensed;
use super::counters::SolverCounters;
use super::{Backend, Failure, Problem, Rhs, Solution};
use std::fmt;

/// Solves one [`Problem`] for one [`Rhs`] after another. It allocates nothing after the first, with
/// two exceptions: Clarabel allocates internally and is rebuilt when a bound that was always
/// infinite becomes finite, and a method's work space is made when that method is first needed.
pub struct Solver {
    kind: Kind,
    n: usize,
    m: usize,
    scale: f64,
    solution: Solution,
    counters: SolverCounters,
    /// The rows of the last programme that have a bound, where the caller has not listed them.
    bounded: Vec<usize>,
}

enum Kind {
    Clamp(Clamp),
    Condensed(Box<Condensed>),
}

impl Solver {
    /// Factors what stays the same. `scale` > 0 is a typical size of the bounds, in the unit of G x
    /// (a gap, where x is a displacement; gap over time step, where x is a velocity): signs of gaps
    /// are tested with a tolerance of 1e-12 times `scale`, or times the row's free G x where that
    /// is larger.
    ///
    /// # Errors
    /// [`Failure::Shape`] if sizes do not fit, or the clamp is requested for more than one unknown;
    /// [`Failure::NotFinite`] for a NaN, an infinity, a negative compliance or a scale that is not
    /// positive; [`Failure::NotPositiveDefinite`].
    pub fn new(problem: Problem, backend: Backend, scale: f64) -> Result<Self, Failure> {
        problem.check()?;
        super::finite("scale", &[scale], |v| v > 0.0 && v.is_finite())?;
        let (n, m) = (problem.a.size(), problem.g.count());
        let clamp = backend == Backend::Clamp || (backend == Backend::Auto && n == 1);
        let kind = if clamp {
            Kind::Clamp(Clamp::new(&problem, scale)?)
        } else {
            Kind::Condensed(Box::new(Condensed::new(problem, backend == Backend::Clarabel)?))
        };
        let solution = Solution { x: vec![0.0; n], multiplier: vec![0.0; m] };
        Ok(Self { kind, n, m, scale, solution, counters: SolverCounters::default(), bounded: Vec::with_capacity(m) })
    }

    /// The minimiser and its multipliers for b and bounds of this step. After a failure the solver
    /// can be used as before, but the solution it holds is meaningless.
    ///
    /// Rigid rows that see the same motion (walls at one place, or more walls than the motion has
    /// degrees of freedom) make the multipliers ambiguous: of all that solve the programme, those
    /// of least Σ Wᵢᵢ rᵢ² are returned, W = G A⁻¹ Gᵀ + diag(c). Equal walls at one place share the
    /// force equally.
    ///
    /// # Errors
    /// [`Failure::Shape`]; [`Failure::NotFinite`]; [`Failure::Infeasible`] if bounds cross by more
    /// than rounding; [`Failure::NotSolved`] if Clarabel was requested and fails, or where no
    /// method settles.
    pub fn solve(&mut self, rhs: &Rhs) -> Result<&Solution, Failure> {
        rhs.shape(self.n, self.m)?;
        let mut bounded = std::mem::take(&mut self.bounded);
        bounded.clear();
        let is_bounded = |row: &usize| rhs.lo[*row] != f64::NEG_INFINITY || rhs.hi[*row] != f64::INFINITY;
        bounded.extend((0..self.m).filter(is_bounded));
        let solved = self.solve_bounded(rhs, &bounded);
        self.bounded = bounded;
        solved?;
        Ok(&self.solution)
    }

    /// The same for a caller that knows which rows have a bound: `bounded`, increasing and below m;
    /// all others have −∞ and +∞. The cost of a programme then depends on their number, not on m.
    ///
    /// # Errors
    /// As [`Solver::solve`].
    pub(crate) fn solve_bounded(&mut self, rhs: &Rhs, bounded: &[usize]) -> Result<(), Failure> {
        self.counters.solves += 1;
        match &mut self.kind {
            Kind::Clamp(clamp) => {
                clamp.solve(rhs, &mut self.solution)?;
                self.counters.free += u64::from(self.solution.multiplier.iter().all(|&r| r == 0.0));
            }
            Kind::Condensed(condensed) => {
                rhs.shape(self.n, self.m)?;
                let Solution { x, multiplier } = &mut self.solution;
                condensed.system.release(rhs.b, x);
                if !x.iter().fold(true, |all, x| all & x.is_finite()) {
                    super::finite("b", rhs.b, f64::is_finite)?;
                    super::finite("free motion", x, f64::is_finite)?;
                }
                if condensed.system.is_free(rhs, bounded, x) {
                    self.counters.free += 1;
                    multiplier.fill(0.0);
                } else {
                    condensed.solve(rhs, bounded, self.scale, &mut self.solution, &mut self.counters)?;
                }
            }
        }
        Ok(())
    }

    /// The last solution; meaningless before the first solve and after a failure.
    #[must_use]
    pub fn solution(&self) -> &Solution {
        &self.solution
    }

    /// The solver in force: never [`Backend::Auto`].
    #[must_use]
    pub fn backend(&self) -> Backend {
        match &self.kind {
            Kind::Clamp(_) => Backend::Clamp,
            Kind::Condensed(condensed) if condensed.always => Backend::Clarabel,
            Kind::Condensed(_) => Backend::Condensed,
        }
    }

    /// What it has done so far.
    #[must_use]
    pub fn counters(&self) -> SolverCounters {
        self.counters
    }
}

impl fmt::Debug for Solver {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct("Solver")
            .field("backend", &self.backend())
            .field("unknowns", &self.n)
            .field("rows", &self.m)
            .field("counters", &self.counters)
            .finish_non_exhaustive()
    }
}

#[cfg(test)]
mod tests;
