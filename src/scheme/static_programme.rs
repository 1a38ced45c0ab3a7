//! The convex programme of a static shape between walls and in holes.

use crate::linear::{Rows, Symmetric};
use crate::qp::{Backend, DiskBound, DiskProblem, DiskSolver, Failure, Problem, Rhs, Solver};
use crate::scene::{Face, Scene, Side, Wall, WallLaw};

/// The tangent of a wall's static force over the depth: that of a spring whose face has receded. A
/// rigid wall, and one whose force begins without a slope, is hard.
struct Tangent {
    /// m/N.
    compliance: f64,
    /// By how much the face of the spring lies behind that of the wall, m.
    recess: f64,
}

impl Tangent {
    /// That of `law` at `depth` (m).
    fn of(law: &WallLaw, depth: f64) -> Self {
        let (stiffness, exponent) = match *law {
            WallLaw::Elastic { stiffness, .. } => (stiffness, 1.0),
            WallLaw::HuntCrossley { stiffness, exponent, .. } => (stiffness, exponent),
            _ => return Self { compliance: 0.0, recess: 0.0 },
        };
        let slope = exponent * stiffness * depth.max(0.0).powf(exponent - 1.0);
        let compliance = if slope > 0.0 { 1.0 / slope } else { 0.0 };
        Self { compliance, recess: depth.max(0.0) * (1.0 - 1.0 / exponent) }
    }
}

/// The depth of a wall that stiffens at which its static force is `force` (N), m; 0 of others.
pub(super) fn depth_at(law: &WallLaw, force: f64) -> f64 {
    let WallLaw::HuntCrossley { stiffness, exponent, .. } = *law else { return 0.0 };
    (force / stiffness).powf(1.0 / exponent)
}

/// The programme of a static shape.
pub(super) enum StaticProgramme {
    /// Between walls alone.
    Walls { solver: Box<Solver>, lo: Vec<f64>, hi: Vec<f64> },
    /// In holes, and between walls too.
    Holes { solver: Box<DiskSolver>, bounds: Vec<DiskBound> },
}

impl StaticProgramme {
    /// With the matrix `a`, for lengths of the size `scale`.
    ///
    /// The walls have the tangents of their laws at these `depths` (m).
    pub fn new(scene: &Scene, a: Symmetric, scale: f64, depths: &[f64]) -> std::result::Result<Self, Failure> {
        let n = a.size();
        let tangents: Vec<Tangent> =
            scene.walls.iter().zip(depths).map(|(wall, depth)| Tangent::of(&wall.law, *depth)).collect();
        let soft: Vec<f64> = tangents.iter().map(|tangent| tangent.compliance).collect();
        let bound = |(wall, tangent): (&Wall, &Tangent), side: Side, none: f64| {
            if wall.side() == side { wall.position() - side.sign() * tangent.recess } else { none }
        };
        let walls = || scene.walls.iter().zip(&tangents);
        let (lo, hi) = (
            walls().map(|wall| bound(wall, Side::Lower, f64::NEG_INFINITY)),
            walls().map(|wall| bound(wall, Side::Upper, f64::INFINITY)),
        );
        if !scene.walls.iter().any(Wall::is_round) {
            let g = Rows::new(n, scene.walls.iter().map(|wall| wall.row().entries()));
            let solver = Solver::new(Problem { a, g, compliance: soft }, Backend::Condensed, scale)?;
            return Ok(Self::Walls { solver: Box::new(solver), lo: lo.collect(), hi: hi.collect() });
        }
        let (mut rows, mut blocks, mut bounds) = (Vec::new(), Vec::new(), Vec::new());
        for ((wall, tangent), (lo, hi)) in walls().zip(lo.zip(hi)) {
            match &wall.face {
                Face::Flat { at, .. } => {
                    rows.push(at);
                    bounds.push(DiskBound::Strip { normal: [1.0, 0.0], lo, hi });
                    blocks.push(1);
                }
                Face::Round { at, centre, gap } => {
                    rows.extend([&at.y, &at.z]);
                    bounds.push(DiskBound::Disk { centre: *centre, radius: *gap + tangent.recess });
                    blocks.push(2);
                }
            }
        }
        let g = Rows::new(n, rows.iter().map(|row| row.entries()));
        let solver = DiskSolver::new(DiskProblem { a, g, blocks, compliance: soft }, scale)?;
        Ok(Self::Holes { solver: Box::new(solver), bounds })
    }

    /// The force of each wall, N.
    pub fn forces(&self, walls: &[Wall]) -> Vec<f64> {
        let solution = match self {
            Self::Walls { solver, .. } => solver.solution(),
            Self::Holes { solver, .. } => solver.solution(),
        };
        let mut next = 0;
        let force = |wall: &Wall| {
            let first = next;
            next += if wall.is_round() { 2 } else { 1 };
            let parts = solution.multiplier.get(first..next).unwrap_or_default();
            parts.iter().fold(0.0, |force: f64, part| force.hypot(*part))
        };
        walls.iter().map(force).collect()
    }

    /// The holes and walls that press: the rounding of a displacement of many gaps is more than the
    /// distance within which a wall counts as touched.
    pub fn pressed(&self, walls: &[Wall]) -> Vec<usize> {
        let forces = self.forces(walls).into_iter().enumerate();
        forces.filter(|(_, force)| *force != 0.0).map(|(index, _)| index).collect()
    }

    /// The minimiser for b, n entries.
    pub fn solve(&mut self, b: &[f64]) -> std::result::Result<&[f64], Failure> {
        Ok(match self {
            Self::Walls { solver, lo, hi } => &solver.solve(&Rhs { b, lo, hi })?.x,
            Self::Holes { solver, bounds } => &solver.solve(b, bounds)?.x,
        })
    }
}
