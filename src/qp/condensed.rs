//! The programme of several unknowns, condensed onto its rows.

use super::active_set::ActiveSet;
use super::clamp::ordered_bounds;
use super::clarabel::Clarabel;
use super::counters::SolverCounters;
use super::delassus::Delassus;
use super::elimination::Elimination;
use super::pivoting::{Pivoting, passes};
use super::redundant_rows::RedundantRows;
use super::side::Side;
use super::{Failure, NOISE, Problem, Rhs, Solution};

/// The programme on its rows, solved by pivoting from the last programme's active set or from the
/// one that Clarabel finds.
pub(super) struct Condensed {
    pub system: Delassus,
    pivoting: Pivoting,
    /// `Some` where A is a narrow band and every row sees one unknown that no other row sees.
    elimination: Option<Box<Elimination>>,
    /// What the interior-point solver is built from when it is needed.
    problem: Problem,
    interior: Option<Clarabel>,
    /// Made when pivoting first gives up on a programme with more rows than degrees of freedom.
    crowd: Option<Box<RedundantRows>>,
    /// The active set that the interior-point solver found.
    start: Vec<(usize, Side)>,
    /// True if the interior-point solver is run on every programme ([`Backend::Clarabel`]).
    pub always: bool,
    /// Maximum number of passes of pivoting before another method is tried.
    pub passes: usize,
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

impl Condensed {
    /// Factors what stays the same. If `always`, the interior-point solver is run on every
    /// programme.
    ///
    /// # Errors
    /// As [`Solver::new`](super::Solver::new).
    pub fn new(problem: Problem, always: bool) -> Result<Self, Failure> {
        let system = Delassus::new(&problem)?;
        let pivoting = Pivoting::new(&system);
        let elimination = Elimination::new(&problem).map(Box::new);
        let passes = patience(problem.g.count(), pivoting.rank());
        let (interior, crowd, start) = (None, None, Vec::new());
        Ok(Self { system, pivoting, elimination, problem, interior, start, always, crowd, passes })
    }

    /// Solves for the free motion held in `system` and `solution`, which violates one of the bounds
    /// of the rows `bounded`.
    pub fn solve(
        &mut self,
        rhs: &Rhs,
        bounded: &[usize],
        scale: f64,
        solution: &mut Solution,
        counters: &mut SolverCounters,
    ) -> Result<(), Failure> {
        rhs.check(scale, bounded.iter().copied())?;
        if let Some(&index) = bounded.iter().find(|&&row| !self.system.y[row].is_finite()) {
            return Err(Failure::NotFinite { what: "free displacement of row", index });
        }
        if !self.always && self.pivoted(rhs, bounded, scale, solution, counters)? {
            return Ok(());
        }
        let Solution { x, multiplier: r } = solution;
        let Self { system, pivoting, .. } = self;
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
            if let Some(pivots) = pivoting.solve(system, rhs, bounded, scale, passes(r.len()), r) {
                counters.pivots += pivots;
                return self.answer(rhs, solution);
            }
            pivoting.clear();
            self.start.iter().for_each(|&(row, side)| pivoting.call(row, side));
        } else {
            pivoting.clear();
        }
        counters.pivots += self.find_active_set(rhs, bounded, (scale, largest), r)?;
        if self.always {
            found?;
        }
        let all: Vec<usize> = (0..r.len()).collect();
        self.system.respond(rhs.b, &all, r, x);
        super::finite("solution", x, |v| v.is_finite())
    }

    /// Solves for the forces `r`, where pivoting and the interior-point method do not settle, by a
    /// dual active-set method, which cannot cycle and can name the bounds that cross. Signs are
    /// tested relative to `scale`, violations to the `largest` displacement. Returns the number of
    /// exchanges.
    fn find_active_set(
        &mut self,
        rhs: &Rhs,
        bounded: &[usize],
        (scale, largest): (f64, f64),
        r: &mut [f64],
    ) -> Result<u64, Failure> {
        let Self { system, pivoting, .. } = self;
        let mut play = ActiveSet::new(r.len());
        pivoting.called().for_each(|(row, side)| play.push(system, row, side));
        // Far above the few exchanges per row ever seen. Without a limit, a defect of the method
        // would hang; with it, the solve fails.
        let limit = 100 + 50 * r.len() as u64;
        let pivots = play.solve(system, rhs, largest, limit, r)?;
        let forces = r.to_vec();
        pivoting.clear();
        play.rows().for_each(|(row, side)| pivoting.call(row, side));
        // Pivoting from this active set divides the forces among dependent rows, if it settles.
        if pivoting.solve(system, rhs, bounded, scale, passes(r.len()), r).is_none() {
            r.copy_from_slice(&forces);
        }
        Ok(pivots)
    }

    /// Solves from the last programme's active set: by elimination in a band where that pays, by
    /// pivoting, or by the method for redundant rows. Returns false where none of them settles.
    fn pivoted(
        &mut self,
        rhs: &Rhs,
        bounded: &[usize],
        scale: f64,
        solution: &mut Solution,
        counters: &mut SolverCounters,
    ) -> Result<bool, Failure> {
        let Solution { x, multiplier: r } = solution;
        let Self { system, pivoting, .. } = self;
        if system.loose {
            pivoting.call_violated(system, rhs, bounded);
        }
        if let Some(elimination) = self.elimination.as_mut().filter(|e| e.pays())
            && let Some(pivots) = elimination.solve(system, pivoting, rhs, scale, (x, r))
        {
            counters.pivots += pivots;
            counters.eliminated += 1;
            return super::finite("solution", x, |v| v.is_finite()).map(|()| true);
        }
        if let Some(pivots) = pivoting.solve(system, rhs, bounded, scale, self.passes, r) {
            counters.pivots += pivots;
            if let Some(elimination) = &mut self.elimination {
                elimination.note(system, pivoting.rows().iter().copied());
            }
            return self.answer(rhs, solution).map(|()| true);
        }
        // Whether it did not settle or found that bounds cross, the next method decides.
        if pivoting.rank() < r.len() && r.len() <= MOST_ROWS {
            counters.crowded += 1;
            system.complete(x);
            let crowd = self.crowd.get_or_insert_with(|| Box::new(RedundantRows::new(system)));
            if let Some(pivots) = crowd.solve(system, pivoting, rhs, bounded, scale, r) {
                counters.pivots += pivots;
                return self.answer(rhs, solution).map(|()| true);
            }
        }
        counters.fallbacks += 1;
        Ok(false)
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
        let (lo, hi) = ordered_bounds(rhs.lo[row], rhs.hi[row]);
        let excess = (lo - system.y[row]).max(system.y[row] - hi);
        if excess > noise { f64::max(most, excess / system.weight[row]) } else { most }
    })
}
