//! The solver of one programme after another, and counters of what it has done.

use super::active_set::ActiveSet;
use super::clamp::{Clamp, meet};
use super::clarabel::Clarabel;
use super::crowd::Crowd;
use super::delassus::Delassus;
use super::elimination::Elimination;
use super::pivoting::{Pivoting, Side, passes};
use super::{Backend, Failure, NOISE, Problem, Rhs, Solution};
use std::fmt;

/// Solves one [`Problem`] for one [`Rhs`] after another. It allocates nothing after the first, with
/// two exceptions: Clarabel allocates internally and is rebuilt when a bound that was always
/// infinite becomes finite, and a method's work space is made when that method is first needed.
pub struct Solver {
    kind: Kind,
    n: usize,
    m: usize,
    scale: f64,
    reason: &'static str,
    solution: Solution,
    counters: SolverCounters,
    /// The rows of the last programme that have a bound, where the caller has not listed them.
    bounded: Vec<usize>,
}

/// What a solver has done since it was made.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub struct SolverCounters {
    /// Programmes solved or refused.
    pub solves: u64,
    /// Programmes whose free motion violated no bound: no solver was needed.
    pub free: u64,
    /// Iterations of the interior-point method.
    pub iterations: u64,
    /// Rows whose state pivoting changed (brought into play or freed), relative to its warm start.
    pub pivots: u64,
    /// Programmes on which the condensed solver's pivoting did not settle, or found that bounds
    /// cross, so that it started once more from the active set that Clarabel found.
    pub fallbacks: u64,
    /// Programmes with so many rows in play that their unknowns were eliminated on the band of A.
    pub eliminated: u64,
    /// Programmes with more rows than the motion has degrees of freedom that a dual active-set
    /// method took over from pivoting, whether or not it settled.
    pub crowded: u64,
}

enum Kind {
    Clamp(Clamp),
    Condensed(Box<Condensed>),
}

/// The programme on its rows, solved by pivoting from the last programme's active set or from the
/// one that Clarabel finds.
struct Condensed {
    system: Delassus,
    pivoting: Pivoting,
    /// `Some` where A is a narrow band and every row sees one unknown that no other row sees.
    elimination: Option<Box<Elimination>>,
    /// What the interior-point solver is built from when it is needed.
    problem: Problem,
    interior: Option<Clarabel>,
    /// Made when pivoting first gives up on a programme with more rows than degrees of freedom.
    crowd: Option<Box<Crowd>>,
    /// The active set that the interior-point solver found.
    start: Vec<(usize, Side)>,
    /// True if the interior-point solver is run on every programme ([`Backend::Clarabel`]).
    always: bool,
    /// Maximum number of passes of pivoting before another method is tried.
    passes: usize,
}

/// Maximum number of passes of pivoting where rows can be linearly dependent: most programmes take
/// one or two, and one that has not settled by then mostly brings ever more rows into play than are
/// needed.
const FEW: usize = 30;

/// With more rows than this per degree of freedom of the motion, pivoting gets one pass only, which
/// tests whether the last programme's active set still holds.
const CROWDED: usize = 2;

/// Up to this many rows, pivoting gets all its passes: they cost little, and where nearly dependent
/// rows close a cone it settles more often than the other methods.
const SMALL: usize = 16;

/// Maximum number of rows for which a dual active-set solver is kept: its factor then takes 32 MB.
const MOST_ROWS: usize = 2048;

/// Maximum number of passes of pivoting for m rows of which `rank` can be linearly independent,
/// before another method is tried.
fn patience(m: usize, rank: usize) -> usize {
    match rank {
        _ if rank == m || m <= SMALL || m > MOST_ROWS => passes(m),
        _ if m > CROWDED * rank => 1,
        _ => FEW,
    }
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
        let (clamp, reason) = match backend {
            Backend::Auto if n == 1 => (true, "one unknown: the programme is a clamp, exact and without iteration"),
            Backend::Auto => (
                false,
                "several unknowns: condensed onto the walls, which is exact, and starts from the last step's contacts",
            ),
            Backend::Clamp => (true, "the clamp was asked for"),
            Backend::Condensed => (false, "the condensed solver was asked for"),
            Backend::Clarabel => (false, "Clarabel was asked for"),
        };
        let kind = if clamp {
            Kind::Clamp(Clamp::new(&problem, scale)?)
        } else {
            let system = Delassus::new(&problem)?;
            let pivoting = Pivoting::new(&system);
            let always = backend == Backend::Clarabel;
            let elimination = Elimination::new(&problem).map(Box::new);
            let passes = patience(m, pivoting.rank());
            Kind::Condensed(Box::new(Condensed {
                system,
                pivoting,
                elimination,
                problem,
                interior: None,
                start: Vec::new(),
                always,
                crowd: None,
                passes,
            }))
        };
        let solution = Solution { x: vec![0.0; n], multiplier: vec![0.0; m] };
        Ok(Self {
            kind,
            n,
            m,
            scale,
            reason,
            solution,
            counters: SolverCounters::default(),
            bounded: Vec::with_capacity(m),
        })
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

    /// Why this solver was chosen: a sentence for a summary.
    #[must_use]
    pub fn reason(&self) -> &'static str {
        self.reason
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

impl Condensed {
    /// Solves for the free motion held in `system` and `solution`, which violates one of the bounds
    /// of the rows `bounded`.
    fn solve(
        &mut self,
        rhs: &Rhs,
        bounded: &[usize],
        scale: f64,
        solution: &mut Solution,
        counters: &mut SolverCounters,
    ) -> Result<(), Failure> {
        let Solution { x, multiplier: r } = solution;
        rhs.check(scale, bounded.iter().copied())?;
        if let Some(&index) = bounded.iter().find(|&&row| !self.system.y[row].is_finite()) {
            return Err(Failure::NotFinite { what: "free displacement of row", index });
        }
        let Self { system, pivoting, .. } = self;
        if !self.always {
            if system.loose {
                pivoting.call_violated(system, rhs, bounded);
            }
            if let Some(elimination) = self.elimination.as_mut().filter(|e| e.pays())
                && let Some(pivots) = elimination.solve(system, pivoting, rhs, scale, (x, r))
            {
                counters.pivots += pivots;
                counters.eliminated += 1;
                return super::finite("solution", x, |v| v.is_finite());
            }
            match pivoting.solve(system, rhs, bounded, scale, self.passes, r) {
                Ok(pivots) => {
                    counters.pivots += pivots;
                    if let Some(elimination) = &mut self.elimination {
                        elimination.note(system, pivoting.rows().iter().copied());
                    }
                    return self.answer(rhs, solution);
                }
                // Whatever the error (crossing bounds included), it is reported only if the next
                // method fails too.
                Err(_) if pivoting.rank() < r.len() && r.len() <= MOST_ROWS => {
                    counters.crowded += 1;
                    system.complete(x);
                    let crowd = self.crowd.get_or_insert_with(|| Box::new(Crowd::new(system)));
                    if let Ok(pivots) = crowd.solve(system, pivoting, rhs, bounded, scale, r) {
                        counters.pivots += pivots;
                        return self.answer(rhs, solution);
                    }
                    counters.fallbacks += 1;
                }
                Err(_) => counters.fallbacks += 1,
            }
        }
        system.complete(x);
        let largest = system.y.iter().fold(scale, |most, y| f64::max(most, y.abs()));
        let violation = violation(system, rhs, NOISE * largest);
        if violation <= 0.0 {
            counters.free += 1;
            r.fill(0.0);
            return Ok(());
        }
        super::finite("violation", &[violation], f64::is_finite)?;
        let interior = self.interior.get_or_insert_with(|| Clarabel::new(&self.problem, system));
        let found = interior.find(system, rhs, violation, largest, pivoting);
        if let Ok(iterations) = found {
            counters.iterations += iterations;
            self.start.clear();
            self.start.extend(pivoting.called());
            if let Ok(pivots) = pivoting.solve(system, rhs, bounded, scale, passes(r.len()), r) {
                counters.pivots += pivots;
                return self.answer(rhs, solution);
            }
            pivoting.clear();
            self.start.iter().for_each(|&(row, side)| pivoting.call(row, side));
        } else {
            pivoting.clear();
        }
        // What neither settles is left to a dual active-set method, which cannot cycle and can name
        // the bounds that cross.
        let mut play = ActiveSet::new(r.len());
        pivoting.called().for_each(|(row, side)| play.push(system, row, side));
        // Far above the few exchanges per row ever seen. Without a limit, a defect of the method
        // would hang; with it, the solve fails.
        let limit = 100 + 50 * r.len() as u64;
        counters.pivots += play.solve(system, rhs.lo, rhs.hi, largest, limit, r)?;
        if self.always {
            found?;
        }
        let forces = r.clone();
        pivoting.clear();
        play.rows().for_each(|(row, side)| pivoting.call(row, side));
        // Pivoting from this active set divides the forces among dependent rows, if it settles.
        if pivoting.solve(system, rhs, bounded, scale, passes(r.len()), r).is_err() {
            r.copy_from_slice(&forces);
        }
        let all: Vec<usize> = (0..r.len()).collect();
        system.respond(rhs.b, &all, r, x);
        super::finite("solution", x, |v| v.is_finite())
    }

    fn answer(&mut self, rhs: &Rhs, solution: &mut Solution) -> Result<(), Failure> {
        self.system.respond(rhs.b, self.pivoting.rows(), &solution.multiplier, &mut solution.x);
        super::finite("solution", &solution.x, |v| v.is_finite())
    }
}

/// The largest violation of a bound by the free motion above `noise`, in units of √Wᵢᵢ; 0 if there
/// is none.
fn violation(system: &Delassus, rhs: &Rhs, noise: f64) -> f64 {
    (0..system.y.len()).fold(0.0, |most, row| {
        let (lo, hi) = meet(rhs.lo[row], rhs.hi[row]);
        let excess = (lo - system.y[row]).max(system.y[row] - hi);
        if excess > noise { f64::max(most, excess / system.weight[row]) } else { most }
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::linear::{Rows, Symmetric};

    #[test]
    fn clarabel_answers_where_pivoting_does_not_settle() {
        let chain = || Problem {
            a: Symmetric::from_entries(3, [(0, 0, 2.0), (1, 1, 2.0), (2, 2, 2.0), (1, 0, -1.0), (2, 1, -1.0)]),
            g: Rows::new(3, [[(0, 1.0)], [(1, 1.0)], [(2, 1.0)]].iter().map(|row| row.as_slice())),
            compliance: vec![0.0; 3],
        };
        let rhs = Rhs { b: &[5.0, -4.0, 1.0], lo: &[-1.0; 3], hi: &[1.0; 3] };
        let mut sound = Solver::new(chain(), Backend::Condensed, 1.0).unwrap();
        let exact = sound.solve(&rhs).unwrap().clone();
        let mut hurried = Solver::new(chain(), Backend::Condensed, 1.0).unwrap();
        let Kind::Condensed(condensed) = &mut hurried.kind else { panic!("not condensed") };
        condensed.passes = 0;
        assert_eq!(hurried.solve(&rhs).unwrap(), &exact);
        assert_eq!((hurried.counters().fallbacks, sound.counters().fallbacks), (1, 0));
        assert!(hurried.counters().iterations > 0 && sound.counters().iterations == 0);
    }
}
