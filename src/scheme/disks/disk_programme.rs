//! The walls of a scene as blocks of a programme with disks: flat ones with a row each, round ones
//! with two.

use super::super::flat_row::FlatRow;
use super::super::programme::failure;
use crate::error::{Error, Result};
use crate::linear::{Rows, Symmetric};
use crate::qp::{DiskBound, DiskCounters, DiskProblem, DiskSolver, Failure};
use crate::scene::{Face, Row, Scene, WallSpring};

/// A programme over all walls and holes, and its bounds in a step.
#[derive(Debug)]
pub(in crate::scheme) struct DiskProgramme {
    solver: DiskSolver,
    bounds: Vec<DiskBound>,
    /// The first row of each wall.
    first: Vec<usize>,
    names: Vec<String>,
}

impl DiskProgramme {
    /// With the matrix `a`, a typical size `scale` of the rows' values, and the compliance of
    /// elastic walls and holes.
    pub fn new(scene: &Scene, a: Symmetric, scale: f64, compliance: impl Fn(WallSpring) -> f64) -> Result<Self> {
        let compliance = scene.walls.iter().map(|wall| wall.law.spring().map_or(0.0, &compliance)).collect();
        let (mut rows, mut blocks, mut first): (Vec<&Row>, _, _) = (Vec::new(), Vec::new(), Vec::new());
        for wall in &scene.walls {
            first.push(rows.len());
            match &wall.face {
                Face::Flat { at, .. } => rows.push(at),
                Face::Round { at, .. } => rows.extend([&at.y, &at.z]),
            }
            blocks.push(rows.len() - first.last().copied().unwrap_or(0));
        }
        let count = blocks.len();
        let g = Rows::new(a.size(), rows.iter().map(|row| row.entries()));
        let problem = DiskProblem { a, g, blocks, compliance };
        let solver = DiskSolver::new(problem, scale).map_err(|fault| failure(&fault, None, 0.0, 0))?;
        let names = (0..count).map(|index| scene.wall_name(index).unwrap_or_default().to_owned()).collect();
        Ok(Self { solver, bounds: vec![DiskBound::OPEN; count], first, names })
    }

    /// Bounds the row of a wall by `value`, from its side.
    pub fn bind_wall(&mut self, wall: usize, face: FlatRow, value: f64) {
        let (lo, hi) = if face.upper { (f64::NEG_INFINITY, value) } else { (value, f64::INFINITY) };
        self.bounds[wall] = DiskBound::Strip { normal: [1.0, 0.0], lo, hi };
    }

    /// Leaves a wall without a bound.
    pub fn open_wall(&mut self, wall: usize) {
        self.bounds[wall] = DiskBound::OPEN;
    }

    /// Bounds a hole.
    pub fn bind_hole(&mut self, hole: usize, bound: DiskBound) {
        self.bounds[hole] = bound;
    }

    /// Solves for b in a step; the minimiser is [`DiskProgramme::x`] until the next call.
    pub fn solve(&mut self, b: &[f64], (time, step): (f64, u64)) -> Result<()> {
        match self.solver.solve(b, &self.bounds) {
            Ok(_) => Ok(()),
            Err(Failure::NotFinite { .. }) => Err(Error::NotFinite { time, step, what: "motion" }),
            Err(fault) => {
                let place =
                    if let Failure::Infeasible { row, .. } = fault { self.names.get(row).cloned() } else { None };
                Err(failure(&fault, place, time, step))
            }
        }
    }

    /// The minimiser of the last programme.
    pub fn x(&self) -> &Vec<f64> {
        &self.solver.solution().x
    }

    /// The multiplier of a wall in the last programme, signed.
    pub fn of_wall(&self, wall: usize) -> f64 {
        self.solver.solution().multiplier[self.first[wall]]
    }

    /// The multipliers of a hole in the last programme.
    pub fn of_hole(&self, hole: usize) -> [f64; 2] {
        let first = self.first[hole];
        [self.solver.solution().multiplier[first], self.solver.solution().multiplier[first + 1]]
    }

    pub fn counters(&self) -> DiskCounters {
        self.solver.counters()
    }
}
