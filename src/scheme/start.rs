//! The forces at the start.
//!
//! A rigid wall that the structure touches at rest pushes with the force that keeps it from
//! accelerating into the wall: with ẅ = G M⁻¹(F + Gᵀ r),
//!
//! minimise ½ aᵀM a − Fᵀa   subject to   ẅ ≥ 0 (lower), ≤ 0 (upper)
//!
//! over those walls, whose multipliers are the forces r.

use super::body::Body;
use super::programme::Programme;
use super::space::Space;
use crate::error::Result;
use crate::qp::Backend;
use crate::scene::{Scene, WallLaw};

/// A velocity ẇ below this many units in the last place of its terms counts as zero.
const REST_UNITS: f64 = 4.0;

/// Forces at the start, N.
#[derive(Debug)]
pub(super) struct StartForce<S: Space> {
    /// Smooth force and wall forces together, n entries.
    pub total: S::Vector,
    /// Force of each wall, signed.
    pub wall: Vec<f64>,
}

impl<S: Space> StartForce<S> {
    /// The forces without those of rigid walls, at displacement `q` and velocity `v`, after any
    /// blow at that instant.
    pub fn smooth(body: &Body<S>, q: &S::Vector, v: &S::Vector) -> Self {
        let mut total = body.load.clone();
        S::add_product(&body.damping, -1.0, v, &mut total);
        S::add_product(&body.stiffness, -1.0, q, &mut total);
        let mut wall = vec![0.0; body.walls.len()];
        for (index, (face, r)) in body.walls.iter().zip(&mut wall).enumerate() {
            *r = face.sign * face.law.pressure(face.depth(body.seen(index, q)), -face.sign * body.seen(index, v));
        }
        body.push(1.0, &wall, &mut total);
        Self { total, wall }
    }

    /// The forces with those of the rigid walls.
    pub fn new(scene: &Scene, body: &Body<S>, q: &S::Vector, v: &S::Vector) -> Result<Self> {
        let Self { mut total, mut wall } = Self::smooth(body, q, v);
        let rests = |index: usize| {
            let row = scene.walls.get(index).map(|wall| wall.row().entries()).unwrap_or_default();
            let speed = |i: usize| v.as_ref().get(i).copied().unwrap_or(0.0);
            let terms: f64 = row.iter().map(|&(i, weight)| (weight * speed(i)).abs()).sum();
            let still = body.seen(index, v).abs() <= REST_UNITS * f64::EPSILON * terms;
            let face = body.walls[index];
            face.law.is_rigid() && face.depth(body.seen(index, q)) >= -body.touch && still
        };
        let resting: Vec<usize> = (0..body.walls.len()).filter(|&index| rests(index)).collect();
        if !resting.is_empty() {
            let mass = body.matrices.mass.clone();
            let scale = scene.gap_scale() / (body.h * body.h);
            let mut programme: Programme<S> =
                Programme::over(scene, WallLaw::is_rigid, mass, scale, |_| 0.0, Backend::Auto)?;
            for row in 0..programme.count_rows() {
                for number in programme.walls(row) {
                    if resting.contains(&programme.wall(number).index) {
                        programme.bind(row, number, 0.0);
                    }
                }
            }
            let mut held = vec![0.0; body.walls.len()];
            programme.solve(&total, (0.0, 0), &mut held, &mut Vec::new())?;
            body.push(1.0, &held, &mut total);
            wall.iter_mut().zip(&held).for_each(|(r, held)| *r += held);
        }
        Ok(Self { total, wall })
    }
}
