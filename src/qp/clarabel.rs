//! The interior-point solver Clarabel, which finds the rows in play. No other file names it.
//!
//! Clarabel is given a dimensionless programme relative to the free motion. With x = x_free + v D
//! x̂, D = diag(A)^(−1/2), ρᵢ = √Wᵢᵢ and v the largest violation (l − y)/ρ or (y − u)/ρ of the free
//! motion,
//!
//! minimise ½ x̂ᵀ D A D x̂   subject to   ±(ρ⁻¹ G D) x̂ ≤ ±(bound − y_free)/(ρ v),
//!
//! so that every diagonal entry of the matrix and of its Delassus operator is 1, the largest
//! violation is 1 whatever the units (the stopping test compares with 1), the linear term is 0 and
//! only `update_b` is needed between programmes. An elastic row is stated as a rigid one with one
//! more unknown, the yield s, added to g·x at a cost of s²/(2c).

use super::clamp::ordered_bounds;
use super::delassus::Delassus;
use super::pivoting::Pivoting;
use super::side::Side;
use super::{Failure, NOISE, Problem, Rhs};
use crate::order::sort_by_number;
use clarabel::algebra::CscMatrix;
use clarabel::solver::{DefaultSettings, DefaultSolver, IPSolver, NonnegativeConeT, SecondOrderConeT, SolverStatus};

/// Stopping tolerance of duality gap and feasibility (dimensionless). The solution only has to tell
/// rows in play from free ones, since the forces are then solved for exactly; below 1e-12 the
/// solver stalls.
const TOLERANCE: f64 = 1e-9;

/// A bound further than this from the free motion, in units of the largest violation, is moved to
/// this distance: infinite and distant bounds would set the scale of the stopping test. Pivoting
/// afterwards checks the true bounds of every row.
const DISTANT: f64 = 1e2;

/// Every bound is moved outwards by this much, in units of the largest violation, so that walls at
/// one place leave an interior: far above [`TOLERANCE`], far below what separates a touching row
/// from a free one. Pivoting afterwards uses the true bounds.
const OPENING: f64 = 1e-7;

/// Longest step, as a fraction of the way to the boundary: Clarabel's default, then shorter ones
/// for the few programmes in 1e5 on which the predictor and corrector cycle through four iterates
/// for ever with the default.
const STEPS: [f64; 3] = [0.99, 0.9, 0.7];

/// Maximum number of iterations, after which a cycle is assumed; 8 is usual, and 23 the most that
/// 2e5 random programmes took.
const ITERATIONS: u32 = 40;

/// One persistent solver over all bounds that have been finite so far.
pub(super) struct Clarabel {
    /// D A D with the yields of elastic rows behind it; upper triangle.
    cost: CscMatrix<f64>,
    /// ρ⁻¹ [G D, yields], m rows.
    rows: Vec<Vec<(usize, f64)>>,
    /// Row and side of each inequality, in the solver's order.
    sides: Vec<(usize, Side)>,
    /// Whether each row's lower and upper bound is among them.
    known: Vec<[bool; 2]>,
    bound: Vec<f64>,
    solver: Option<Box<DefaultSolver<f64>>>,
}

impl Clarabel {
    pub(super) fn new(problem: &Problem, system: &Delassus) -> Self {
        let (n, m) = (problem.a.size(), problem.g.count());
        let unit: Vec<f64> = problem.a.diagonal_entries().iter().map(|d| 1.0 / d.sqrt()).collect();
        let elastic: Vec<usize> = (0..m).filter(|&i| problem.compliance[i] > 0.0).collect();
        // The lower triangle by rows is the upper one by columns.
        let mut cost: Vec<Vec<(usize, f64)>> = vec![Vec::new(); n + elastic.len()];
        for (i, j, value) in problem.a.entries() {
            cost[i].push((j, if i == j { 1.0 } else { unit[i] * value * unit[j] }));
        }
        let mut rows: Vec<Vec<(usize, f64)>> = (0..m)
            .map(|i| problem.g.row(i).iter().map(|&(j, g)| (j, g * unit[j] / system.weight[i])).collect())
            .collect();
        for (k, &i) in elastic.iter().enumerate() {
            cost[n + k].push((n + k, 1.0));
            rows[i].push((n + k, problem.compliance[i].sqrt() / system.weight[i]));
        }
        Self {
            cost: by_columns(cost.len(), &cost),
            rows,
            sides: Vec::with_capacity(2 * m),
            known: vec![[false; 2]; m],
            bound: Vec::with_capacity(2 * m),
            solver: None,
        }
    }

    /// Solves for the free motion held in `system`, whose largest violation is `violation` > 0. In
    /// `play` it puts on their bounds the rows whose multiplier exceeds their gap (both
    /// dimensionless), and frees all others. Returns the number of iterations.
    pub(super) fn find(
        &mut self,
        system: &Delassus,
        rhs: &Rhs,
        violation: f64,
        scale: f64,
        play: &mut Pivoting,
    ) -> Result<u64, Failure> {
        self.learn(rhs);
        self.bound.clear();
        for &(row, side) in &self.sides {
            let (lo, hi) = ordered_bounds(rhs.lo[row], rhs.hi[row]);
            let gap = if side == Side::Lower { system.y[row] - lo } else { hi - system.y[row] };
            let unit = system.weight[row] * violation;
            // Bounds are also moved outwards by their rounding error: where the violation is that
            // small, the bounds of walls at one place may cross by as much.
            self.bound.push((gap / unit).min(DISTANT) + OPENING + NOISE * scale / unit);
        }
        match &mut self.solver {
            Some(solver) => {
                solver.update_b(&self.bound).map_err(|_| Failure::NotSolved { status: "update refused" })?
            }
            None => self.solver = Some(self.build()?),
        }
        let Some(solver) = &mut self.solver else { return Err(Failure::NotSolved { status: "not built" }) };
        let iterations = run(solver)?;
        play.clear();
        let solution = &solver.solution;
        for (i, &(row, side)) in self.sides.iter().enumerate() {
            if solution.z[i] > solution.s[i] {
                play.call(row, side);
            }
        }
        Ok(iterations)
    }

    /// Adds bounds that are finite for the first time; a bound once added stays, [`DISTANT`] away
    /// when it is infinite.
    fn learn(&mut self, rhs: &Rhs) {
        for (row, known) in self.known.iter_mut().enumerate() {
            let finite = [rhs.lo[row].is_finite(), rhs.hi[row].is_finite()];
            for (side, index) in [(Side::Lower, 0), (Side::Upper, 1)] {
                if finite[index] && !known[index] {
                    known[index] = true;
                    self.sides.push((row, side));
                    self.solver = None;
                }
            }
        }
    }

    fn build(&self) -> Result<Box<DefaultSolver<f64>>, Failure> {
        let mut columns: Vec<Vec<(usize, f64)>> = vec![Vec::new(); self.cost.n];
        for (i, &(row, side)) in self.sides.iter().enumerate() {
            for &(j, value) in &self.rows[row] {
                columns[j].push((i, -side.sign() * value));
            }
        }
        let inequality = by_columns(self.sides.len(), &columns);
        let settings = DefaultSettings {
            verbose: false,
            max_threads: 1,
            max_iter: ITERATIONS,
            max_step_fraction: STEPS[0],
            // Clarabel refuses updates where presolve may have removed something.
            presolve_enable: false,
            tol_gap_abs: TOLERANCE,
            tol_gap_rel: TOLERANCE,
            tol_feas: TOLERANCE,
            ..DefaultSettings::default()
        };
        DefaultSolver::new(
            &self.cost,
            &vec![0.0; self.cost.n],
            &inequality,
            &self.bound,
            &[NonnegativeConeT(self.sides.len())],
            settings,
        )
        .map(Box::new)
        .map_err(|_| Failure::NotSolved { status: "programme refused" })
    }
}

/// Solves, with shorter steps if the default ones cycle or stall. Returns the number of iterations.
fn run(solver: &mut DefaultSolver<f64>) -> Result<u64, Failure> {
    let mut iterations = 0;
    for (attempt, step) in STEPS.into_iter().enumerate() {
        if attempt > 0 {
            shorten(solver, step)?;
        }
        solver.solve();
        iterations += u64::from(solver.solution.iterations);
        if matches!(solver.solution.status, SolverStatus::Solved | SolverStatus::PrimalInfeasible) {
            break;
        }
    }
    if solver.settings().max_step_fraction < STEPS[0] {
        shorten(solver, STEPS[0])?;
    }
    match solver.solution.status {
        // Pivoting afterwards tests every condition, so reduced accuracy will do.
        SolverStatus::Solved | SolverStatus::AlmostSolved => Ok(iterations),
        status => Err(Failure::NotSolved { status: words(status) }),
    }
}

fn shorten(solver: &mut DefaultSolver<f64>, step: f64) -> Result<(), Failure> {
    let settings = DefaultSettings { max_step_fraction: step, ..solver.settings().clone() };
    solver.update_settings(settings).map_err(|_| Failure::NotSolved { status: "settings refused" })
}

/// A cone of a programme with disks.
#[derive(Debug, Clone, Copy)]
pub(super) enum Cone {
    /// s ≥ 0: one line.
    Half,
    /// |(s₁, s₂)| ≤ s₀: three lines.
    Disk,
}

/// Stopping tolerance of programmes with disks (dimensionless).
const ROUND_TOLERANCE: f64 = 1e-10;

/// Minimises ½ xᵀP x with b − C x in these cones; P (its upper triangle) and C by columns. Returns
/// the dual variables and the number of iterations; `None` for the iterations if these are a
/// certificate that there is no such x.
///
/// # Errors
/// [`Failure::NotSolved`].
pub(super) fn solve_cones(
    cost: &[Vec<(usize, f64)>],
    columns: &[Vec<(usize, f64)>],
    bound: &[f64],
    cones: &[Cone],
) -> Result<(Vec<f64>, Option<u64>), Failure> {
    let settings = DefaultSettings {
        verbose: false,
        max_threads: 1,
        presolve_enable: false,
        tol_gap_abs: ROUND_TOLERANCE,
        tol_gap_rel: ROUND_TOLERANCE,
        tol_feas: ROUND_TOLERANCE,
        ..DefaultSettings::default()
    };
    let cones: Vec<_> = cones
        .iter()
        .map(|cone| match cone {
            Cone::Half => NonnegativeConeT(1),
            Cone::Disk => SecondOrderConeT(3),
        })
        .collect();
    let (cost, inequality) = (by_columns(cost.len(), cost), by_columns(bound.len(), columns));
    let zero = vec![0.0; cost.n];
    let mut solver = DefaultSolver::new(&cost, &zero, &inequality, bound, &cones, settings)
        .map_err(|_| Failure::NotSolved { status: "programme refused" })?;
    solver.solve();
    let dual = solver.solution.z.clone();
    match solver.solution.status {
        // What is found is polished and tested, so reduced accuracy will do.
        SolverStatus::Solved | SolverStatus::AlmostSolved | SolverStatus::InsufficientProgress => {
            Ok((dual, Some(u64::from(solver.solution.iterations))))
        }
        SolverStatus::PrimalInfeasible | SolverStatus::AlmostPrimalInfeasible => Ok((dual, None)),
        status => Err(Failure::NotSolved { status: words(status) }),
    }
}

/// Compressed columns without zeros; entries at one place are added up.
fn by_columns(height: usize, columns: &[Vec<(usize, f64)>]) -> CscMatrix<f64> {
    let (mut starts, mut rows, mut values) = (vec![0], Vec::<usize>::new(), Vec::<f64>::new());
    for column in columns {
        let start = rows.len();
        let mut sorted = column.clone();
        sort_by_number(&mut sorted, |entry| entry.0 as f64);
        for (i, value) in sorted.into_iter().filter(|entry| entry.1 != 0.0) {
            match values.last_mut() {
                Some(sum) if rows.len() > start && rows.last() == Some(&i) => *sum += value,
                _ => {
                    rows.push(i);
                    values.push(value);
                }
            }
        }
        starts.push(rows.len());
    }
    CscMatrix::new(height, columns.len(), starts, rows, values)
}

const fn words(status: SolverStatus) -> &'static str {
    match status {
        SolverStatus::Unsolved => "not run",
        SolverStatus::Solved => "solved",
        SolverStatus::PrimalInfeasible => "primal infeasible",
        SolverStatus::DualInfeasible => "dual infeasible",
        SolverStatus::AlmostSolved => "solved to reduced accuracy only",
        SolverStatus::AlmostPrimalInfeasible => "probably primal infeasible",
        SolverStatus::AlmostDualInfeasible => "probably dual infeasible",
        SolverStatus::MaxIterations => "too many iterations",
        SolverStatus::MaxTime => "out of time",
        SolverStatus::NumericalError => "numerical error",
        SolverStatus::InsufficientProgress => "no progress",
        SolverStatus::CallbackTerminated => "interrupted",
    }
}

#[cfg(test)]
mod tests;
