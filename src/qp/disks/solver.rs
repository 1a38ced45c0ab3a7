//! The solver of one programme with disks after another.

use super::newton::Newton;
use super::system::System;
use super::{DiskBound, DiskProblem, cones, strips};
use crate::qp::{Failure, Solution, finite, shape};

/// Sweeps over all blocks before the first attempt of Newton's method; each further attempt has
/// [`MORE`] times as many.
const SWEEPS: u32 = 2;
const MORE: u32 = 4;

/// Attempts of Newton's method before Clarabel is asked, and after.
const ATTEMPTS: u32 = 6;

/// Solves one [`DiskProblem`] for one b and set of bounds after another. It allocates nothing after
/// the first few, but where Clarabel is needed.
///
/// ```
/// use signorini::linear::{Rows, Symmetric};
/// use signorini::qp::{DiskBound, DiskProblem, DiskSolver};
///
/// // ½(4x² + y²) − 6x − y in the unit disk.
/// let mut solver = DiskSolver::new(DiskProblem {
///     a: Symmetric::diagonal(&[4.0, 1.0]),
///     g: Rows::new(2, [[(0, 1.0)], [(1, 1.0)]].iter().map(|row| row.as_slice())),
///     blocks: vec![2],
///     compliance: vec![0.0],
/// }, 1.0)?;
/// let disk = DiskBound::Disk { centre: [0.0, 0.0], radius: 1.0 };
/// let solution = solver.solve(&[6.0, 1.0], &[disk])?;
/// let [x, y] = [solution.x[0], solution.x[1]];
/// assert!((x.hypot(y) - 1.0).abs() < 1e-15);
/// // The multiplier points to the centre and balances the gradient.
/// assert!((4.0 * x - 6.0 - solution.multiplier[0]).abs() < 1e-14);
/// assert!((y * solution.multiplier[0] - x * solution.multiplier[1]).abs() < 1e-14);
/// # Ok::<(), signorini::qp::Failure>(())
/// ```
#[derive(Debug)]
pub struct DiskSolver {
    problem: DiskProblem,
    system: System,
    newton: Newton,
    scale: f64,
    solution: Solution,
    counters: DiskCounters,
}

/// What a [`DiskSolver`] has done since it was made.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub struct DiskCounters {
    /// Programmes solved or refused.
    pub solves: u64,
    /// Programmes whose free motion violated no bound.
    pub free: u64,
    /// Steps of Newton's method.
    pub newton: u64,
    /// Programmes on which Newton's method did not settle, so that Clarabel was asked.
    pub fallbacks: u64,
    /// Iterations of Clarabel.
    pub iterations: u64,
}

impl DiskCounters {
    /// The work of two solvers together.
    pub(crate) fn and(self, other: Self) -> Self {
        Self {
            solves: self.solves + other.solves,
            free: self.free + other.free,
            newton: self.newton + other.newton,
            fallbacks: self.fallbacks + other.fallbacks,
            iterations: self.iterations + other.iterations,
        }
    }
}

impl DiskSolver {
    /// Factors what stays the same. `scale` > 0 is a typical size of the bounds.
    ///
    /// # Errors
    /// [`Failure::Shape`] if sizes do not fit; [`Failure::NotFinite`] for a NaN, an infinity, a
    /// negative compliance or a scale that is not positive; [`Failure::NotPositiveDefinite`].
    pub fn new(problem: DiskProblem, scale: f64) -> Result<Self, Failure> {
        problem.check()?;
        finite("scale", &[scale], |v| v > 0.0 && v.is_finite())?;
        let system = System::new(&problem)?;
        let solution = Solution { x: vec![0.0; problem.a.size()], multiplier: vec![0.0; problem.g.count()] };
        let (newton, counters) = (Newton::default(), DiskCounters::default());
        Ok(Self { problem, system, newton, scale, solution, counters })
    }

    /// The minimiser and its multipliers for b (n entries) and the bounds of all blocks. After a
    /// failure the solver can be used as before, but the solution it holds is meaningless.
    ///
    /// Where rows are linearly dependent, the multipliers are not unique, and any that solve the
    /// programme are returned.
    ///
    /// # Errors
    /// [`Failure::Shape`]; [`Failure::NotFinite`]; [`Failure::Infeasible`] with two blocks whose
    /// bounds have no common point (or one, whose own bounds cross); [`Failure::NotSolved`] where
    /// no method settles.
    pub fn solve(&mut self, b: &[f64], bounds: &[DiskBound]) -> Result<&Solution, Failure> {
        shape("entries of b", self.problem.a.size(), b.len())?;
        shape("bounds", self.problem.blocks.len(), bounds.len())?;
        self.counters.solves += 1;
        let Self { system, solution, .. } = self;
        system.release(b, &mut solution.x);
        if !solution.x.iter().chain(&system.free).fold(true, |all, x| all & x.is_finite()) {
            finite("b", b, f64::is_finite)?;
            finite("free motion", &solution.x, f64::is_finite)?;
            finite("free displacement of row", &system.free, f64::is_finite)?;
        }
        bounds.iter().enumerate().try_for_each(|(index, bound)| bound.check(index, self.scale))?;
        if system.is_free(bounds) {
            self.counters.free += 1;
            system.forget();
            solution.multiplier.fill(0.0);
            return Ok(&self.solution);
        }
        if !self.settle() {
            self.counters.fallbacks += 1;
            self.counters.iterations += cones::find(&self.problem, &mut self.system)?;
            let polished = self.newton.settle(&mut self.system) || self.settle();
            self.counters.newton = self.newton.steps;
            if !polished && strips::find(&self.problem, &mut self.system, b, self.scale).is_none() {
                self.system.forget();
                return Err(Failure::NotSolved { status: "the disks in play do not settle" });
            }
        }
        self.counters.newton = self.newton.steps;
        let Self { system, solution, .. } = self;
        solution.multiplier.copy_from_slice(&system.r);
        system.respond(&mut solution.x);
        finite("solution", &solution.x, f64::is_finite)?;
        Ok(&self.solution)
    }

    /// Sweeps and Newton's method in turn, from the multipliers that there are. Returns whether
    /// they settled.
    fn settle(&mut self) -> bool {
        let Self { system, newton, .. } = self;
        let mut sweeps = SWEEPS;
        for _ in 0..ATTEMPTS {
            system.renew();
            for _ in 0..sweeps {
                (0..system.blocks.len()).for_each(|block| system.answer(block));
            }
            system.renew();
            if system.miss().is_rounded() || newton.settle(system) {
                return true;
            }
            if !system.r.iter().fold(true, |all, r| all & r.is_finite()) {
                return false;
            }
            sweeps *= MORE;
        }
        false
    }

    /// The last solution; meaningless before the first solve and after a failure.
    #[must_use]
    pub fn solution(&self) -> &Solution {
        &self.solution
    }

    /// What it has done so far.
    #[must_use]
    pub fn counters(&self) -> DiskCounters {
        self.counters
    }
}
