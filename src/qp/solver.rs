//! The solver in force, and what it has done.

use super::active_set::ActiveSet;
use super::clamp::{Clamp, meet};
use super::clarabel::Clarabel;
use super::crowd::Crowd;
use super::delassus::Delassus;
use super::elimination::Elimination;
use super::pivoting::{Pivoting, Side, passes};
use super::{Backend, Failure, NOISE, Problem, Rhs, Solution};
use std::fmt;

/// Solves one [`Problem`] for one [`Rhs`] after another. Allocates nothing after the first (what Clarabel allocates
/// inside itself apart, its rebuilding when a bound that was always infinite becomes finite, and what is made where a method
/// is first needed).
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
    /// Rows that pivoting brought into play or freed, beyond those that it started from.
    pub pivots: u64,
    /// Programmes on which the condensed solver's pivoting did not settle, or found that bounds cross, so that Clarabel told it where to
    /// start once more.
    pub fallbacks: u64,
    /// Programmes with so many rows in play that their unknowns were eliminated on the band of A.
    pub eliminated: u64,
    /// Programmes with more rows than the motion has freedoms that a dual active set took over from pivoting, whether or not it settled.
    pub crowded: u64,
}

enum Kind {
    Clamp(Clamp),
    Condensed(Box<Condensed>),
}

/// The programme on its rows, solved by pivoting from the last programme's rows in play or from those that Clarabel finds.
struct Condensed {
    system: Delassus,
    pivoting: Pivoting,
    /// Where A is a narrow band and every row has an unknown of its own.
    elimination: Option<Box<Elimination>>,
    /// What the interior point is built from when it is needed.
    problem: Problem,
    interior: Option<Clarabel>,
    /// Made where pivoting first leaves a programme with more rows than freedoms.
    crowd: Option<Box<Crowd>>,
    /// Rows that the interior point called.
    start: Vec<(usize, Side)>,
    /// True if the interior point is asked every time.
    always: bool,
    /// Passes that pivoting has before another method is asked.
    passes: usize,
}

/// Passes of pivoting where rows can depend on one another: most programmes take one or two, and what has not settled by then mostly
/// brings ever more rows into play than are needed.
const FEW: usize = 30;

/// Rows per freedom of the motion from which on pivoting is asked only whether the last programme's rows still are those in play.
const CROWDED: usize = 2;

/// Rows of a programme that pivoting is left with: all its passes cost little, and where nearly dependent rows close a cone it settles more
/// often.
const SMALL: usize = 16;

/// Most rows for which a dual active set is kept: its factor takes 32 MB.
const MOST_ROWS: usize = 2048;

/// Passes that pivoting has for m rows of which `rank` can be independent, before another method is asked.
fn patience(m: usize, rank: usize) -> usize {
    match rank {
        _ if rank == m || m <= SMALL || m > MOST_ROWS => passes(m),
        _ if m > CROWDED * rank => 1,
        _ => FEW,
    }
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
        Ok(Self { kind, n, m, scale, reason, solution, counters: Counters::default() })
    }

    /// The minimiser and its multipliers for b and bounds of this step. After a failure the solver is as good as new,
    /// and the solution it holds means nothing.
    ///
    /// Rigid rows that see the same motion (walls at one place, or more walls than the motion has freedoms) make the multipliers
    /// ambiguous: of all that solve the programme, those of least Σ Wᵢᵢ rᵢ² are returned, W = G A⁻¹ Gᵀ + diag(c). Equal walls at one
    /// place share equally.
    ///
    /// # Errors
    /// [`Failure::Shape`]; [`Failure::NotFinite`]; [`Failure::Infeasible`] if bounds cross by more than rounding;
    /// [`Failure::NotSolved`] if Clarabel was asked for and fails, or where no method settles.
    pub fn solve(&mut self, rhs: &Rhs) -> Result<&Solution, Failure> {
        self.counters.solves += 1;
        match &mut self.kind {
            Kind::Clamp(clamp) => {
                clamp.solve(rhs, &mut self.solution)?;
                self.counters.free += u64::from(self.solution.multiplier.iter().all(|&r| r == 0.0));
            }
            Kind::Condensed(condensed) => {
                rhs.shape(self.n, self.m)?;
                if condensed.system.release(rhs, &mut self.solution.x) {
                    self.counters.free += 1;
                    self.solution.multiplier.fill(0.0);
                } else {
                    condensed.solve(rhs, self.scale, &mut self.solution, &mut self.counters)?;
                }
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
            Kind::Condensed(condensed) if condensed.always => Backend::Clarabel,
            Kind::Condensed(_) => Backend::Condensed,
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

impl Condensed {
    /// Solves for the free motion held in `system` and `solution`, which is not strictly inside the bounds, or at fault.
    fn solve(
        &mut self,
        rhs: &Rhs,
        scale: f64,
        solution: &mut Solution,
        counters: &mut Counters,
    ) -> Result<(), Failure> {
        let Solution { x, multiplier: r } = solution;
        rhs.check(scale)?;
        super::finite("free motion", x, |v| v.is_finite())?;
        super::finite("free displacement of row", &self.system.y, |v| v.is_finite())?;
        let Self { system, pivoting, .. } = self;
        if !self.always {
            if system.loose {
                pivoting.call_violated(system, rhs);
            }
            if let Some(elimination) = self.elimination.as_mut().filter(|e| e.pays(system, pivoting))
                && let Some(pivots) = elimination.solve(system, pivoting, rhs, scale, (x, r))
            {
                counters.pivots += pivots;
                counters.eliminated += 1;
                return super::finite("solution", x, |v| v.is_finite());
            }
            match pivoting.solve(system, rhs, scale, self.passes, r) {
                Ok(pivots) => {
                    counters.pivots += pivots;
                    return self.answer(rhs, solution);
                }
                // That bounds cross is told after a second opinion only.
                Err(_) if pivoting.rank() < r.len() && r.len() <= MOST_ROWS => {
                    counters.crowded += 1;
                    let crowd = self.crowd.get_or_insert_with(|| Box::new(Crowd::new(system)));
                    if let Ok(pivots) = crowd.solve(system, pivoting, rhs, scale, r) {
                        counters.pivots += pivots;
                        return self.answer(rhs, solution);
                    }
                    counters.fallbacks += 1;
                }
                Err(_) => counters.fallbacks += 1,
            }
        }
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
            if let Ok(pivots) = pivoting.solve(system, rhs, scale, passes(r.len()), r) {
                counters.pivots += pivots;
                return self.answer(rhs, solution);
            }
            pivoting.clear();
            self.start.iter().for_each(|&(row, side)| pivoting.call(row, side));
        } else {
            pivoting.clear();
        }
        // What neither settles is left to a method that cannot go round in circles, and can say which bounds cross.
        let mut play = ActiveSet::new(r.len());
        pivoting.called().for_each(|(row, side)| play.push(system, row, side));
        // Far above the few exchanges per row ever seen; a wrong bound here would hang, so it is a failure instead.
        let limit = 100 + 50 * r.len() as u64;
        counters.pivots += play.solve(system, rhs.lo, rhs.hi, largest, limit, r)?;
        if self.always {
            found?;
        }
        let forces = r.clone();
        pivoting.clear();
        play.rows().for_each(|(row, side)| pivoting.call(row, side));
        // From there the share of dependent rows, if pivoting can tell it.
        if pivoting.solve(system, rhs, scale, passes(r.len()), r).is_err() {
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

/// The largest violation of a bound by the free motion that is more than `noise`, in units of √Wᵢᵢ; 0 without one.
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
