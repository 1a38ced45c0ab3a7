//! What a change of a key adds to the change of the motion.

use super::tangent::{LoadTerms, SceneTangent};
use crate::flow::{Drive, HeldRow, Propagator, Series, Touching};
use crate::scene::Row;

/// The terms of one key along a run.
#[derive(Debug)]
pub(super) struct KeyTerms {
    pub tangent: SceneTangent,
    /// δm of one degree of freedom, kg.
    mass: f64,
    loads: LoadTerms,
    /// The walls behind the held rows, by row.
    carriers: Vec<usize>,
    /// The row and position (m) of each wall.
    places: Vec<(Row, f64)>,
}

/// An instant at which the velocity jumps.
pub(super) struct Instant<'a> {
    /// Time, s.
    pub time: f64,
    /// Displacement, m; velocity before and after, m/s; acceleration before, m/s².
    pub q: &'a [f64],
    pub before: &'a [f64],
    pub after: &'a [f64],
    pub acceleration: &'a [f64],
    /// Impulse of each wall, N s, signed.
    pub impulse: &'a [f64],
    /// For each row the wall that acts there.
    pub wall_of: &'a [usize],
}

impl KeyTerms {
    pub fn new(tangent: SceneTangent, places: &[(Row, f64)], rows: usize) -> Self {
        let mass = tangent.body()[0];
        Self { mass, tangent, loads: LoadTerms::default(), carriers: vec![0; rows], places: places.to_vec() }
    }

    /// Prepares the terms over the stretch of `base`, in which the walls of `wall_of` act at their
    /// rows.
    pub fn begin(&mut self, base: &Series, wall_of: &[usize]) {
        self.carriers.clear();
        self.carriers.extend_from_slice(wall_of);
        self.loads.fill(&self.tangent.loads, base.terms(), base.start(), base.unit());
    }

    /// Adds the change of the loads on one degree of freedom from `start` (s) on to the polynomial
    /// `force` in x, N, whose unit is `unit` (s).
    pub fn add_loads(&mut self, (start, unit): (f64, f64), force: &mut [f64]) {
        self.loads.fill(&self.tangent.loads, force.len(), start, unit);
        self.loads.add_to_one(&self.tangent.loads, force);
    }

    /// δG q − δg, m: by how much the change of the wall alone brings the displacement `q` beyond
    /// it.
    pub fn offset(&self, wall: usize, q: &[f64]) -> f64 {
        self.tangent.walls.get(wall).map_or(0.0, |wall| wall.row.dot(q) - wall.position)
    }

    /// δG x.
    pub fn along(&self, wall: usize, x: &[f64]) -> f64 {
        self.tangent.walls.get(wall).map_or(0.0, |wall| wall.row.dot(x))
    }

    /// δe.
    pub fn restitution(&self, wall: usize) -> f64 {
        self.tangent.walls.get(wall).map_or(0.0, |wall| wall.restitution)
    }

    /// δm of one degree of freedom, kg; of a structure it means nothing.
    pub fn mass_of_one(&self) -> f64 {
        self.mass
    }

    /// True where the key changes two walls in different ways.
    pub fn differ(&self, a: usize, b: usize) -> bool {
        let (Some(a), Some(b)) = (self.tangent.walls.get(a), self.tangent.walls.get(b)) else { return false };
        a.position != b.position || a.restitution != b.restitution || a.row != b.row
    }

    /// Adds M⁻¹(Σ δGᵀ p − δM (q̇⁺ − q̇⁻)), m/s, to `velocity`: what the change of rows and masses
    /// makes of the impulses of an instant.
    pub fn add_to_velocity(&self, flow: &mut Propagator, at: &Instant<'_>, velocity: &mut [f64]) {
        let pushed = |(wall, p): (usize, &f64)| *p != 0.0 && !self.row(wall).entries().is_empty();
        let rows = at.impulse.iter().enumerate().any(pushed);
        if !rows && self.tangent.mass.is_none() {
            return;
        }
        let mut momentum = vec![0.0; velocity.len()];
        self.add_inertia(at, &mut momentum);
        for (wall, p) in at.impulse.iter().enumerate() {
            self.row(wall).add_transposed(*p, &mut momentum);
        }
        flow.body.solve(&mut momentum);
        velocity.iter_mut().zip(&momentum).for_each(|(v, change)| *v += change);
    }

    /// Adds M⁻¹(δJ − δM (q̇⁺ − q̇⁻)), m/s, to `velocity`, for the blows J of an instant.
    pub fn add_blow(&self, flow: &mut Propagator, at: &Instant<'_>, velocity: &mut [f64]) {
        let mut momentum = vec![0.0; velocity.len()];
        self.add_inertia(at, &mut momentum);
        self.tangent.loads.iter().for_each(|load| load.add_blow(at.time, &mut momentum));
        flow.body.solve(&mut momentum);
        velocity.iter_mut().zip(&momentum).for_each(|(v, change)| *v += change);
    }

    /// What the moved instants of blows at `time` (s) make of displacements, m: (q̇⁻ − q̇⁺) δt =
    /// −M⁻¹J δt. `None` if none moves.
    pub fn moved_blow(&self, flow: &mut Propagator, time: f64) -> Option<Vec<f64>> {
        let moving = self.tangent.loads.iter().map(|load| (load, load.blow_moves(time)));
        let mut moving = moving.filter(|(_, later)| *later != 0.0).peekable();
        moving.peek()?;
        let mut change = vec![0.0; self.tangent.q.len()];
        moving.for_each(|(load, later)| load.add_own_blow(-later, &mut change));
        flow.body.solve(&mut change);
        Some(change)
    }

    fn add_inertia(&self, at: &Instant<'_>, momentum: &mut [f64]) {
        if let Some(mass) = &self.tangent.mass {
            mass.add_product(-1.0, at.after, momentum);
            mass.add_product(1.0, at.before, momentum);
        }
    }

    fn row(&self, wall: usize) -> &Row {
        static NONE: Row = Row::NONE;
        self.tangent.walls.get(wall).map_or(&NONE, |wall| &wall.row)
    }
}

impl Drive for KeyTerms {
    fn pushes(&self) -> bool {
        let SceneTangent { mass, damping, stiffness, walls, loads, .. } = &self.tangent;
        let matrices = [mass, damping, stiffness].iter().any(|matrix| matrix.is_some());
        matrices || !loads.is_empty() || walls.iter().any(|wall| !wall.row.entries().is_empty())
    }

    fn add_force(&self, base: &Series, k: usize, force: &mut [f64]) {
        let (rate, unit) = ((k + 1) as f64, base.unit());
        let SceneTangent { mass, damping, stiffness, walls, loads, .. } = &self.tangent;
        if let Some(mass) = mass {
            mass.add_product(-rate * (k + 2) as f64 / (unit * unit), base.term(k + 2), force);
        }
        if let Some(damping) = damping {
            damping.add_product(-rate / unit, base.term(k + 1), force);
        }
        if let Some(stiffness) = stiffness {
            stiffness.add_product(-1.0, base.term(k), force);
        }
        self.loads.add(loads, k, force);
        for (wall, poly, share) in base.acting() {
            if let (Some(wall), Some(push)) = (walls.get(wall), poly.get(k)) {
                wall.row.add_transposed(share * push, force);
            }
        }
    }

    fn push(&self, base: &Series, k: usize, touching: &Touching) -> f64 {
        let (Some(change), Some((row, position))) =
            (self.tangent.walls.get(touching.wall), self.places.get(touching.wall))
        else {
            return 0.0;
        };
        let rate = (k + 1) as f64 / base.unit();
        let (now, next) = (base.term(k), base.term(k + 1));
        let at_first = |x: f64| if k == 0 { x } else { 0.0 };
        let depth = change.row.dot(now) - at_first(change.position);
        -touching.stiffness * depth
            - touching.damping * rate * change.row.dot(next)
            - change.stiffness * (row.dot(now) - at_first(*position))
            - change.damping * rate * row.dot(next)
    }

    fn acceleration(&self, base: &Series, k: usize, held: &HeldRow) -> f64 {
        let Some(&wall) = self.carriers.get(held.row) else { return 0.0 };
        if self.row(wall).entries().is_empty() {
            return 0.0;
        }
        let rate = ((k + 1) * (k + 2)) as f64 / (base.unit() * base.unit());
        -rate * self.along(wall, base.term(k + 2))
    }
}
