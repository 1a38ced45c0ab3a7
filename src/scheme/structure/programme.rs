//! The quadratic programme of a step over all walls: walls to rows, multipliers to forces.
//!
//! minimise ½ xᵀA x − bᵀx over lᵢ ≤ gᵢ·x ≤ uᵢ, elastic rows yielding with a compliance.
//!
//! Rigid walls at one place (one row g) share a row of the programme: the tightest bound of each side counts, and walls that stand at that bound share its force equally.
//! An elastic wall has a row of its own.

use crate::error::{Error, Result};
use crate::linear::{Rows, Symmetric};
use crate::qp::{self, Backend, Failure, Rhs};
use crate::scene::{Scene, Wall, WallLaw};
use crate::scheme::Counters;

/// A row of the programme and the walls behind it.
#[derive(Debug, Clone)]
pub(super) struct Place {
    /// Indices of the walls in the scene.
    pub walls: Vec<usize>,
    /// False for the single elastic wall.
    pub rigid: bool,
}

/// The programme, its bounds, and the solver that answers it.
#[derive(Debug)]
pub(super) struct Programme {
    solver: qp::Solver,
    pub rows: Rows,
    pub places: Vec<Place>,
    /// Bounds of each row; a kernel writes them before it solves.
    pub lo: Vec<f64>,
    pub hi: Vec<f64>,
    names: Vec<String>,
    /// Bound that each wall stands for, in the row's unit; written through [`Programme::bound`].
    bound: Vec<f64>,
}

/// Bounds of walls at one place that differ by less than this share of their size are one: their walls share the force.
const ONE_PLACE: f64 = 1e-12;

impl Programme {
    /// The programme with curvature `a`, a typical length `scale` of g·x, and the compliance of each elastic wall's row as a function of its stiffness and damping.
    pub fn new(
        scene: &Scene,
        a: Symmetric,
        scale: f64,
        compliance: impl Fn(f64, f64) -> f64,
        backend: Backend,
    ) -> Result<Self> {
        Self::over(scene, |_| true, a, scale, compliance, backend)
    }

    /// The same over those walls only whose law is `wanted`.
    pub fn over(
        scene: &Scene,
        wanted: impl Fn(&WallLaw) -> bool,
        a: Symmetric,
        scale: f64,
        compliance: impl Fn(f64, f64) -> f64,
        backend: Backend,
    ) -> Result<Self> {
        let mut places: Vec<Place> = Vec::new();
        for (index, wall) in scene.walls.iter().enumerate().filter(|(_, wall)| wanted(&wall.law)) {
            let rigid = wall.law.is_rigid();
            let shared = |place: &&mut Place| {
                let first = place.walls.first().and_then(|&w| scene.walls.get(w));
                rigid && place.rigid && first.is_some_and(|first: &Wall| first.at == wall.at)
            };
            match places.iter_mut().find(shared) {
                Some(place) => place.walls.push(index),
                None => places.push(Place { walls: vec![index], rigid }),
            }
        }
        let first = |place: &Place| place.walls.first().and_then(|&w| scene.walls.get(w));
        let n = a.size();
        let rows = Rows::new(n, places.iter().filter_map(|p| first(p).map(|wall| wall.at.entries())));
        let soft = |place: &Place| match first(place).map(|wall| wall.law) {
            Some(WallLaw::Elastic { stiffness, damping }) => compliance(stiffness, damping),
            _ => 0.0,
        };
        let compliance = places.iter().map(soft).collect();
        let names = scene.walls.iter().map(|wall| wall.name.clone()).collect();
        let problem = qp::Problem { a, g: rows.clone(), compliance };
        let solver = qp::Solver::new(problem, backend, scale).map_err(|f| failure(&f, None, 0.0, 0))?;
        let m = places.len();
        Ok(Self {
            solver,
            rows,
            places,
            lo: vec![f64::NEG_INFINITY; m],
            hi: vec![f64::INFINITY; m],
            names,
            bound: vec![0.0; scene.walls.len()],
        })
    }

    /// Frees row `row`, before its walls are bound.
    #[inline]
    pub fn free(&mut self, row: usize) {
        self.lo[row] = f64::NEG_INFINITY;
        self.hi[row] = f64::INFINITY;
    }

    /// Binds row `row` on behalf of `wall`: g·x ≤ `value` for an upper wall, ≥ for a lower one. The tightest of a row counts.
    #[inline]
    pub fn bound(&mut self, row: usize, wall: usize, upper: bool, value: f64) {
        self.bound[wall] = value;
        if upper {
            self.hi[row] = self.hi[row].min(value);
        } else {
            self.lo[row] = self.lo[row].max(value);
        }
    }

    /// Solves; the minimiser is [`Programme::x`] until the next call. Returns whether any wall pushes, with the multipliers of the walls in `force`, which is all zero before.
    #[inline]
    pub fn solve(
        &mut self,
        b: &[f64],
        time: f64,
        step: u64,
        upper: impl Fn(usize) -> bool,
        force: &mut [f64],
    ) -> Result<bool> {
        let rhs = Rhs { b, lo: &self.lo, hi: &self.hi };
        let solution = match self.solver.solve(&rhs) {
            Ok(solution) => solution,
            Err(fault) => {
                let name = |row: usize| {
                    let wall = self.places.get(row).and_then(|p| p.walls.first())?;
                    self.names.get(*wall).cloned()
                };
                let wall = if let Failure::Infeasible { row, .. } = fault { name(row) } else { None };
                return Err(failure(&fault, wall, time, step));
            }
        };
        let mut pushes = false;
        for ((row, place), &r) in self.places.iter().enumerate().zip(&solution.multiplier) {
            if r == 0.0 {
                continue;
            }
            pushes = true;
            if let [wall] = *place.walls {
                force[wall] = r;
                continue;
            }
            // The walls that stand at the bound which holds.
            let held = if r < 0.0 { self.hi[row] } else { self.lo[row] };
            let near = ONE_PLACE * held.abs();
            let carries = |wall: &&usize| upper(**wall) == (r < 0.0) && (self.bound[**wall] - held).abs() <= near;
            let carriers = place.walls.iter().filter(carries).count();
            for &wall in place.walls.iter().filter(carries) {
                force[wall] = r / carriers as f64;
            }
        }
        Ok(pushes)
    }

    /// The minimiser of the last programme solved.
    #[inline]
    pub fn x(&self) -> &[f64] {
        &self.solver.solution().x
    }

    pub fn backend(&self) -> Backend {
        self.solver.backend()
    }

    /// Adds what the programme has cost.
    pub fn count(&self, counters: &mut Counters) {
        let inner = self.solver.counters();
        counters.qp_solves += inner.solves - inner.free;
        counters.interior_point_iterations += inner.iterations;
        counters.pivots += inner.pivots;
    }
}

fn failure(failure: &Failure, wall: Option<String>, time: f64, step: u64) -> Error {
    Error::Qp { time, step, wall, reason: failure.to_string() }
}
