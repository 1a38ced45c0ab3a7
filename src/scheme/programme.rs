//! The quadratic programme of a step over all walls: walls to rows, multipliers to forces.
//!
//! minimise ½ xᵀA x − bᵀx over lᵢ ≤ gᵢ·x ≤ uᵢ, elastic rows yielding with a compliance.
//!
//! Rigid walls at one place (one row g) share a row of the programme: the tightest bound of each
//! side counts, and walls that stand at that bound share its force equally. An elastic wall has a
//! row of its own.

use super::Counters;
use super::space::{Solve, Space};
use super::stop::Stop;
use crate::error::{Error, Result};
use crate::linear::{Rows, Symmetric};
use crate::qp::{self, Backend, Failure};
use crate::scene::{Row, Scene, Side, Wall, WallLaw, distinct};

/// A wall of a row of the programme. Several walls can have the same row; each of them has its own
/// number ("seat") in [`Programme`].
#[derive(Debug, Clone, Copy)]
pub(super) struct Seat {
    /// Index of the wall in the scene.
    pub wall: usize,
    pub stop: Stop,
}

/// The programme, its bounds, and the solver that answers it.
#[derive(Debug)]
pub(super) struct Programme<S: Space> {
    solver: S::Solver,
    rows: S::Rows,
    /// The walls in the order of their rows, and the number of the first wall of each row.
    seats: Vec<Seat>,
    starts: Vec<usize>,
    row_of: Vec<usize>,
    /// The open interval of g·q, m, in which a row's rigid walls are not touched; empty for the row
    /// of an elastic wall, which must be checked in every step.
    clear: Vec<(f64, f64)>,
    /// Bounds of each row in the step, and the rows that have one.
    lo: Vec<f64>,
    hi: Vec<f64>,
    bounded: Vec<usize>,
    names: Vec<String>,
    /// Bound that each wall imposes on its row, in the row's unit.
    bound: Vec<f64>,
}

/// Relative tolerance within which the bounds of walls of one row count as equal; these walls share
/// the force.
const ONE_PLACE: f64 = 1e-12;

impl<S: Space> Programme<S> {
    /// The programme with the matrix `a`, a typical size `scale` of g·x (for the solver's
    /// tolerances), and the compliance of each elastic wall's row as a function of its stiffness
    /// and damping.
    pub fn new(
        scene: &Scene,
        a: Symmetric,
        scale: f64,
        compliance: impl Fn(f64, f64) -> f64,
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
        compliance: impl Fn(f64, f64) -> f64,
        backend: Backend,
    ) -> Result<Self> {
        let mut places: Vec<Vec<usize>> = Vec::new();
        let distinct = distinct(scene.walls.iter().map(|wall| &wall.at));
        // The place of the rigid walls of each distinct row.
        let mut shared: Vec<Option<usize>> = vec![None; distinct.rows.len()];
        for (index, wall) in scene.walls.iter().enumerate().filter(|(_, wall)| wanted(&wall.law)) {
            match &mut shared[distinct.of[index]] {
                Some(place) if wall.law.is_rigid() => places[*place].push(index),
                place => {
                    if wall.law.is_rigid() {
                        *place = Some(places.len());
                    }
                    places.push(vec![index]);
                }
            }
        }
        let walls = |place: &[usize]| place.iter().filter_map(|&w| scene.walls.get(w)).collect::<Vec<_>>();
        let at: Vec<&Row> = places.iter().filter_map(|place| walls(place).first().map(|wall| &wall.at)).collect();
        let (n, g) = (a.size(), Rows::new(a.size(), at.iter().map(|row| row.entries())));
        let soft = |place: &Vec<usize>| match walls(place).first().map(|wall| wall.law) {
            Some(WallLaw::Elastic { stiffness, damping }) => compliance(stiffness, damping),
            _ => 0.0,
        };
        let problem = qp::Problem { a, g, compliance: places.iter().map(soft).collect() };
        let solver = S::Solver::new(problem, backend, scale).map_err(|f| failure(&f, None, 0.0, 0))?;
        let (mut seats, mut starts, m) = (Vec::new(), vec![0], places.len());
        for place in &places {
            seats.extend(place.iter().filter_map(|&w| Some(Seat { wall: w, stop: Stop::new(scene.walls.get(w)?) })));
            starts.push(seats.len());
        }
        let mut row_of = vec![0; scene.walls.len()];
        for (row, place) in places.iter().enumerate() {
            place.iter().for_each(|&wall| row_of[wall] = row);
        }
        let touch = scene.touching_distance();
        let interval = |place: &Vec<usize>| {
            let ends = |(lo, hi): (f64, f64), w: &&Wall| match (w.law.is_rigid(), w.side) {
                (false, _) => (f64::INFINITY, f64::NEG_INFINITY),
                (true, Side::Upper) => (lo, hi.min(w.position - 2.0 * touch)),
                (true, Side::Lower) => (lo.max(w.position + 2.0 * touch), hi),
            };
            walls(place).iter().fold((f64::NEG_INFINITY, f64::INFINITY), ends)
        };
        Ok(Self {
            solver,
            rows: S::rows(n, at.into_iter()),
            clear: places.iter().map(interval).collect(),
            bound: vec![0.0; seats.len()],
            seats,
            starts,
            row_of,
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
        let (lo, hi) = self.clear[row];
        lo < w && w < hi
    }

    /// The first row for which [`Programme::is_clear`] is false at the displacements `q` (m);
    /// `None` if it is true for all.
    #[inline]
    pub fn first_near(&self, q: &S::Vector) -> Option<usize> {
        self.clear
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
        self.row_of[wall]
    }

    /// False for the row of an elastic wall.
    #[inline]
    pub fn is_rigid(&self, row: usize) -> bool {
        self.seats[self.starts[row]].stop.law.is_rigid()
    }

    /// Numbers of the walls of a row.
    #[inline]
    pub fn seats(&self, row: usize) -> std::ops::Range<usize> {
        self.starts[row]..self.starts[row + 1]
    }

    /// The wall of that number.
    #[inline]
    pub fn seat(&self, seat: usize) -> Seat {
        self.seats[seat]
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

    /// Adds the bound of the wall number `seat` to row `row`: g·x ≤ `value` for an upper wall, ≥
    /// for a lower one. The tightest bound of a row counts.
    #[inline]
    pub fn bind(&mut self, row: usize, seat: usize, value: f64) {
        // The first bound of the row in this step: the bounds that its walls had in earlier steps
        // are removed.
        if self.lo[row] == f64::NEG_INFINITY && self.hi[row] == f64::INFINITY {
            self.bounded.push(row);
            self.bound[self.starts[row]..self.starts[row + 1]].fill(f64::NAN);
        }
        self.bound[seat] = value;
        if self.seats[seat].stop.upper {
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
        self.meet(b, (time, step), force, pushing)
    }

    /// The same if no row has a bound.
    #[inline]
    pub fn release(&mut self, b: &S::Vector, (time, step): (f64, u64)) -> Result<()> {
        let released = self.solver.release(b, (&self.lo, &self.hi));
        released.map_err(|fault| self.refusal(&fault, time, step))
    }

    /// The same if a row has a bound. Not inlined: in most steps no row has one.
    #[inline(never)]
    fn meet(
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
            let range = self.starts[row]..self.starts[row + 1];
            if let [seat] = self.seats[range.clone()] {
                force[seat.wall] = r;
                pushing.push(seat.wall);
                continue;
            }
            // The walls whose bound is the active one.
            let held = if r < 0.0 { self.hi[row] } else { self.lo[row] };
            let near = ONE_PLACE * held.abs();
            let carries =
                |seat: &usize| self.seats[*seat].stop.upper == (r < 0.0) && (self.bound[*seat] - held).abs() <= near;
            let carriers = range.clone().filter(carries).count();
            for seat in range.filter(carries) {
                let wall = self.seats[seat].wall;
                force[wall] = r / carriers as f64;
                pushing.push(wall);
            }
        }
        Ok(())
    }

    #[cold]
    fn refusal(&self, fault: &Failure, time: f64, step: u64) -> Error {
        let name = |row: usize| {
            let seat = self.starts.get(row).and_then(|&first| self.seats.get(first))?;
            self.names.get(seat.wall).cloned()
        };
        let wall = if let Failure::Infeasible { row, .. } = *fault { name(row) } else { None };
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
        counters.interior_point_iterations += inner.iterations;
        counters.pivots += inner.pivots;
        counters.qp_fallbacks += inner.fallbacks;
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
        let mut programme = Programme::<Line>::new(&scene, unit, 1.0, |_, _| 0.0, Backend::Auto).expect("sound");
        // Minimise ½x² − 3x for x ≤ 1: the bound pulls with −2.
        let mut solve = |bound: &[usize]| {
            programme.free();
            bound.iter().for_each(|&seat| programme.bind(0, seat, 1.0));
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
