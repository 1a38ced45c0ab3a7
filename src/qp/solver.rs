//! The solver in force, and what it has done.

use super::active_set::ActiveSet;
use super::clamp::{Clamp, meet};
use super::clarabel::{Clarabel, NOISE};
use super::delassus::Delassus;
use super::{Backend, Failure, Problem, Rhs, Solution};
use std::fmt;

/// Solves one [`Problem`] for one [`Rhs`] after another. Allocates nothing after the first (what Clarabel allocates
/// inside itself apart, and its rebuilding when a bound that was always infinite becomes finite).
pub struct Solver {
    kind: Kind,
    n: usize,
    m: usize,
    scale: f64,
    reason: &'static str,
    solution: Solution,
    counters: Counters,
}

/// What a solver has done since it was made.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub struct Counters {
    /// Programmes solved or refused.
    pub solves: u64,
    /// Those whose free motion met no bound: no solver was needed.
    pub free: u64,
    /// Iterations of the interior point.
    pub iterations: u64,
    /// Changes that the polishing made to the rows the interior point called in play.
    pub pivots: u64,
}

enum Kind {
    Clamp(Clamp),
    Clarabel(Box<Polished>),
}

/// Clarabel, made exact: the rows it finds in play are solved as equalities, signs are checked, and pivots mend them.
struct Polished {
    system: Delassus,
    interior: Option<Clarabel>,
    play: ActiveSet,
}

impl Solver {
    /// Factors what stays the same. `scale` > 0 is a typical size of the bounds, in the unit of G x (a gap, where x is
    /// a displacement; gap over step, where it is a velocity): signs of gaps are tested at 1e-12 of it, or of the
    /// largest free G x where that is larger.
    ///
    /// # Errors
    /// [`Failure::Shape`] if sizes do not fit, or the clamp is asked for more than one unknown;
    /// [`Failure::NotFinite`] for a NaN, an infinity, a negative compliance or a scale that is not positive;
    /// [`Failure::NotPositiveDefinite`].
    pub fn new(problem: Problem, backend: Backend, scale: f64) -> Result<Self, Failure> {
        problem.check()?;
        super::finite("scale", &[scale], |v| v > 0.0 && v.is_finite())?;
        let (n, m) = (problem.a.size(), problem.g.count());
        let (clamp, reason) = match backend {
            Backend::Auto if n == 1 => (true, "one unknown: the programme is a clamp, exact and without iteration"),
            Backend::Auto => (false, "several unknowns: condensed onto the walls, exact"),
            Backend::Clamp => (true, "the clamp was asked for"),
            Backend::Condensed => (false, "the condensed solver was asked for"),
            Backend::Clarabel => (false, "Clarabel was asked for"),
        };
        let kind = if clamp {
            Kind::Clamp(Clamp::new(&problem, scale)?)
        } else {
            let system = Delassus::new(&problem)?;
            let interior = (backend == Backend::Clarabel).then(|| Clarabel::new(&problem, &system));
            Kind::Clarabel(Box::new(Polished { system, interior, play: ActiveSet::new(m) }))
        };
        let solution = Solution { x: vec![0.0; n], multiplier: vec![0.0; m] };
        Ok(Self { kind, n, m, scale, reason, solution, counters: Counters::default() })
    }

    /// The minimiser and its multipliers for b and bounds of this step. After a failure the solver is as good as new,
    /// and the solution it holds means nothing.
    ///
    /// Rigid rows that see the same motion (walls at one place) share no force: rows that follow from those in play stay
    /// out of it. Which of them carries it is settled by order for the clamp, by the interior point for Clarabel.
    ///
    /// # Errors
    /// [`Failure::Shape`]; [`Failure::NotFinite`]; [`Failure::Infeasible`] if bounds cross by more than rounding;
    /// [`Failure::NotSolved`] if Clarabel reports anything but `Solved`, or the polishing does not settle.
    pub fn solve(&mut self, rhs: &Rhs) -> Result<&Solution, Failure> {
        self.counters.solves += 1;
        match &mut self.kind {
            Kind::Clamp(clamp) => {
                clamp.solve(rhs, &mut self.solution)?;
                self.counters.free += u64::from(self.solution.multiplier.iter().all(|&r| r == 0.0));
            }
            Kind::Clarabel(polished) => {
                rhs.check(self.n, self.m, self.scale)?;
                polished.solve(rhs, self.scale, &mut self.solution, &mut self.counters)?;
            }
        }
        Ok(&self.solution)
    }

    /// The last solution; it means nothing before the first and after a failure.
    #[must_use]
    pub fn solution(&self) -> &Solution {
        &self.solution
    }

    /// The solver in force: never [`Backend::Auto`].
    #[must_use]
    pub fn backend(&self) -> Backend {
        match &self.kind {
            Kind::Clamp(_) => Backend::Clamp,
            Kind::Clarabel(polished) if polished.interior.is_some() => Backend::Clarabel,
            Kind::Clarabel(_) => Backend::Condensed,
        }
    }

    /// Why this one: a sentence for a summary.
    #[must_use]
    pub fn reason(&self) -> &'static str {
        self.reason
    }

    /// What it has done so far.
    #[must_use]
    pub fn counters(&self) -> Counters {
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

impl Polished {
    fn solve(
        &mut self,
        rhs: &Rhs,
        scale: f64,
        solution: &mut Solution,
        counters: &mut Counters,
    ) -> Result<(), Failure> {
        let Self { system, interior, play } = self;
        system.release(rhs.b)?;
        let scale = scale.max(system.y.amax());
        let violation = violation(system, rhs, NOISE * scale);
        if violation <= 0.0 {
            counters.free += 1;
            solution.multiplier.fill(0.0);
            system.respond(&solution.multiplier, &mut solution.x);
            return Ok(());
        }
        super::finite("violation", &[violation], f64::is_finite)?;
        play.clear();
        match interior.as_mut().map(|interior| interior.find(system, rhs, violation, scale, play)) {
            None => {}
            Some(Ok(iterations)) => counters.iterations += iterations,
            Some(Err(failure)) => {
                // The interior point cannot say which bounds cross; the active set, from nothing, can.
                play.clear();
                play.solve(system, rhs.lo, rhs.hi, scale, &mut solution.multiplier)?;
                return Err(failure);
            }
        }
        counters.pivots += play.solve(system, rhs.lo, rhs.hi, scale, &mut solution.multiplier)?;
        system.respond(&solution.multiplier, &mut solution.x);
        super::finite("solution", &solution.x, f64::is_finite)
    }
}

/// The largest violation of a bound by the free motion that is more than `noise`, in units of √Wᵢᵢ; 0 without one.
fn violation(system: &Delassus, rhs: &Rhs, noise: f64) -> f64 {
    (0..system.y.len()).fold(0.0, |most, row| {
        let (lo, hi) = meet(rhs.lo[row], rhs.hi[row]);
        let excess = (lo - system.y[row]).max(system.y[row] - hi);
        if excess > noise { f64::max(most, excess / system.weight[row]) } else { most }
    })
}
