//! The quadratic programme of a step over all walls: bounds of walls to rows, multipliers to
//! forces.
//!
//! minimise ½ xᵀA x − bᵀx over lᵢ ≤ gᵢ·x ≤ uᵢ, elastic rows yielding with a compliance.
//!
//! Of the walls that share a row ([`WallRows`]) the tightest bound of each side counts, and walls
//! that stand at that bound share its force equally.

use super::Counters;
use super::flat_row::FlatRow;
use super::space::{Solve, Space};
use super::wall_rows::WallRows;
use crate::error::{Error, Result};
use crate::linear::{Rows, Symmetric};
use crate::qp::{self, Backend, Failure};
use crate::scene::{Scene, Wall, WallLaw, WallSpring};

/// The programme, its bounds, and the solver that answers it.
#[derive(Debug)]
pub(super) struct Programme<S: Space> {
    solver: S::Solver,
    rows: S::Rows,
    layout: WallRows,
    /// Bounds of each row in the step, and the rows that have one.
    lo: Vec<f64>,
    hi: Vec<f64>,
    bounded: Vec<usize>,
    names: Vec<String>,
    /// Bound that each wall imposes on its row, in the row's unit.
    bound: Vec<f64>,
}

impl<S: Space> Programme<S> {
    /// The programme with the matrix `a`, a typical size `scale` of g·x (for the solver's
    /// tolerances), and the compliance of each elastic wall's row.
    pub fn new(
        scene: &Scene,
        a: Symmetric,
        scale: f64,
        compliance: impl Fn(WallSpring) -> f64,
        backend: Backend,
    ) -> Result<Self> {
        Self::over(scene, |_| true, a, scale, compliance, backend)
    }

    /// The same for only those walls whose law is `wanted`.
    pub fn over(
        scene: &Scene,
        wanted: impl Fn(&WallLaw) -> bool,
        a: Symmetric,
        scale: f64,
        compliance: impl Fn(WallSpring) -> f64,
        backend: Backend,
    ) -> Result<Self> {
        let layout = WallRows::new(scene, wanted);
        let (n, m) = (a.size(), layout.count());
        let first: Vec<&Wall> =
            (0..m).filter_map(|row| layout.first(row).and_then(|wall| scene.walls.get(wall))).collect();
        let soft = |wall: &&Wall| wall.law.spring().map_or(0.0, &compliance);
        let g = Rows::new(n, first.iter().map(|wall| wall.row().entries()));
        let problem = qp::Problem { a, g, compliance: first.iter().map(soft).collect() };
        let solver = S::Solver::new(problem, backend, scale).map_err(|f| failure(&f, None, 0.0, 0))?;
        Ok(Self {
            solver,
            rows: S::rows(n, first.into_iter().map(|wall| wall.row())),
            bound: vec![0.0; layout.count_walls()],
            layout,
            lo: vec![f64::NEG_INFINITY; m],
            hi: vec![f64::INFINITY; m],
            bounded: Vec::with_capacity(m),
            names: scene.walls.iter().map(|wall| wall.name.clone()).collect(),
        })
    }

    /// Number of rows.
    pub fn count_rows(&self) -> usize {
        self.lo.len()
    }

    /// g·x of a row.
    #[inline]
    pub fn seen(&self, row: usize, x: &S::Vector) -> f64 {
        S::dot(&self.rows, row, x)
    }

    /// True if no wall of a row is touched at the displacement `w` (m), with a margin of twice the
    /// touching distance, and none of them is elastic.
    #[inline]
    pub fn is_clear(&self, row: usize, w: f64) -> bool {
        let (lo, hi) = self.layout.clear[row];
        lo < w && w < hi
    }

    /// The first row for which [`Programme::is_clear`] is false at the displacements `q` (m);
    /// `None` if it is true for all.
    #[inline]
    pub fn first_near(&self, q: &S::Vector) -> Option<usize> {
        self.layout
            .clear
            .iter()
            .enumerate()
            .find(|&(row, &(lo, hi))| {
                let w = self.seen(row, q);
                !(lo < w && w < hi)
            })
            .map(|(row, _)| row)
    }

    /// The row of a wall.
    #[inline]
    pub fn row_of(&self, wall: usize) -> usize {
        self.layout.of(wall)
    }

    /// False for the row of an elastic wall.
    #[inline]
    pub fn is_rigid(&self, row: usize) -> bool {
        self.layout.wall(self.layout.walls(row).start).law.is_rigid()
    }

    /// Numbers of the walls of a row.
    #[inline]
    pub fn walls(&self, row: usize) -> std::ops::Range<usize> {
        self.layout.walls(row)
    }

    /// The wall of that number.
    #[inline]
    pub fn wall(&self, number: usize) -> FlatRow {
        self.layout.wall(number)
    }

    /// Removes the bounds of the last step.
    #[inline]
    pub fn free(&mut self) {
        if !self.bounded.is_empty() {
            self.free_bounded();
        }
    }

    #[inline(never)]
    fn free_bounded(&mut self) {
        for row in self.bounded.drain(..) {
            self.lo[row] = f64::NEG_INFINITY;
            self.hi[row] = f64::INFINITY;
        }
    }

    /// Adds the bound of the wall number `number` to row `row`: g·x ≤ `value` for an upper wall, ≥
    /// for a lower one. The tightest bound of a row counts. Always inlined: the row of an elastic
    /// wall is bound in every step.
    #[inline(always)]
    pub fn bind(&mut self, row: usize, number: usize, value: f64) {
        // The first bound of the row in this step: the bounds that its walls had in earlier steps
        // are removed.
        if self.lo[row] == f64::NEG_INFINITY && self.hi[row] == f64::INFINITY {
            self.bounded.push(row);
            self.bound[self.layout.walls(row)].fill(f64::NAN);
        }
        self.bound[number] = value;
        if self.layout.wall(number).upper {
            self.hi[row] = self.hi[row].min(value);
        } else {
            self.lo[row] = self.lo[row].max(value);
        }
    }

    /// Fixes row `row`, g·x = 0, for its only wall, which is elastic.
    #[inline]
    pub fn hold(&mut self, row: usize) {
        self.bounded.push(row);
        (self.lo[row], self.hi[row]) = (0.0, 0.0);
    }

    /// Solves the programme; the minimiser is [`Programme::x`] until the next call. Writes the
    /// multiplier of each wall that pushes to `force`, which must be all zero before, and appends
    /// its index to `pushing`.
    #[inline]
    pub fn solve(
        &mut self,
        b: &S::Vector,
        (time, step): (f64, u64),
        force: &mut [f64],
        pushing: &mut Vec<usize>,
    ) -> Result<()> {
        if self.bounded.is_empty() {
            return self.release(b, (time, step));
        }
        self.solve_bounded(b, (time, step), force, pushing)
    }

    /// The same if no row has a bound.
    #[inline]
    pub fn release(&mut self, b: &S::Vector, (time, step): (f64, u64)) -> Result<()> {
        let released = self.solver.release(b, (&self.lo, &self.hi));
        released.map_err(|fault| self.refusal(&fault, time, step))
    }

    /// The same if a row has a bound. Not inlined: in most steps no row has one.
    #[inline(never)]
    fn solve_bounded(
        &mut self,
        b: &S::Vector,
        (time, step): (f64, u64),
        force: &mut [f64],
        pushing: &mut Vec<usize>,
    ) -> Result<()> {
        if !self.bounded.is_sorted() {
            self.bounded.sort_unstable();
        }
        if let Err(fault) = self.solver.solve(b, (&self.lo, &self.hi), &self.bounded) {
            return Err(self.refusal(&fault, time, step));
        }
        let Some(multiplier) = self.solver.multiplier() else { return Ok(()) };
        for &row in &self.bounded {
            let r = multiplier[row];
            if r == 0.0 {
                continue;
            }
            let range = self.layout.walls(row);
            if range.len() == 1 {
                let wall = self.layout.wall(range.start).index;
                force[wall] = r;
                pushing.push(wall);
                continue;
            }
            // The walls whose bound is the active one share the force.
            let held = if r < 0.0 { self.hi[row] } else { self.lo[row] };
            let carries = |number: &usize| {
                self.layout.wall(*number).upper == (r < 0.0) && qp::is_one_place(self.bound[*number], held)
            };
            let carriers = range.clone().filter(carries).count();
            for number in range.filter(carries) {
                let wall = self.layout.wall(number).index;
                force[wall] = r / carriers as f64;
                pushing.push(wall);
            }
        }
        Ok(())
    }

    #[cold]
    fn refusal(&self, fault: &Failure, time: f64, step: u64) -> Error {
        let wall = match *fault {
            Failure::Infeasible { row, .. } => self.layout.first(row).and_then(|wall| self.names.get(wall).cloned()),
            _ => None,
        };
        match fault {
            // The matrices were checked at the beginning, so it is the motion that became infinite
            // or NaN.
            Failure::NotFinite { .. } => Error::NotFinite { time, step, what: "motion" },
            _ => failure(fault, wall, time, step),
        }
    }

    /// The minimiser of the last programme solved.
    #[inline]
    pub fn x(&self) -> &S::Vector {
        self.solver.x()
    }

    pub fn backend(&self) -> Backend {
        self.solver.backend()
    }

    /// Adds the work that the solver has done.
    pub fn count(&self, counters: &mut Counters) {
        let inner = self.solver.counters();
        counters.qp_solves += inner.solves - inner.free;
        counters.add_work(&inner);
    }

    /// The work that the solver has done.
    pub fn solver_counters(&self) -> qp::SolverCounters {
        self.solver.counters()
    }
}

pub(super) fn failure(failure: &Failure, wall: Option<String>, time: f64, step: u64) -> Error {
    Error::qp((time, step), wall, *failure)
}

#[cfg(test)]
mod tests {
    use super::super::line::Line;
    use super::*;
    use std::error::Error as _;

    #[test]
    fn a_wall_that_is_not_bound_in_a_step_does_not_share_its_force() {
        let scene =
            Scene::oscillator(1.0, 0.0, 0.0).with_wall(Wall::upper("one", 1.0)).with_wall(Wall::upper("other", 1.0));
        let unit = Symmetric::diagonal(&[1.0]);
        let mut programme = Programme::<Line>::new(&scene, unit, 1.0, |_| 0.0, Backend::Auto).expect("sound");
        // Minimise ½x² − 3x for x ≤ 1: the bound pulls with −2.
        let mut solve = |bound: &[usize]| {
            programme.free();
            bound.iter().for_each(|&number| programme.bind(0, number, 1.0));
            let mut force = [0.0; 2];
            programme.solve(&[3.0], (0.0, 0), &mut force, &mut Vec::new()).expect("solved");
            force
        };
        assert_eq!(solve(&[0, 1]), [-1.0, -1.0]);
        assert_eq!(solve(&[1]), [0.0, -2.0]);
        assert_eq!(solve(&[0]), [-2.0, 0.0]);
        // What it cost is added to what was counted before.
        let mut counters = Counters {
            qp_solves: 10,
            interior_point_iterations: 20,
            pivots: 30,
            qp_fallbacks: 40,
            ..Counters::default()
        };
        programme.count(&mut counters);
        assert_eq!((counters.qp_solves, counters.interior_point_iterations), (13, 20));
        assert_eq!((counters.pivots, counters.qp_fallbacks), (30, 40));
    }

    #[test]
    fn the_error_of_a_step_has_the_failure_of_the_solver_as_its_source() {
        let infeasible = Failure::Infeasible { row: 1, against: 0 };
        let error = failure(&infeasible, Some("stop".into()), 0.5, 12);
        assert_eq!(error.source().and_then(|source| source.downcast_ref()), Some(&infeasible));
        let text = error.to_string();
        assert!(text.contains("step 12") && text.contains("t = 0.5 s") && text.contains("\"stop\""), "{text}");
        assert!(text.ends_with(&infeasible.to_string()), "{text}");
    }
}
