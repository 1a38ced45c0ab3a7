//! The velocity that a staggered scheme reports at t⁺, from v₊ at t⁺ − ½h.
//!
//! Half a step under the smooth force, v⁺ = v₊ + δ, is the minimiser of
//!
//! ½ δᵀ(M + ½hC)δ − ½h(f⁺ − K q⁺ − C v₊ + Gᵀ r⁺)ᵀδ   subject to   G δ ≥ 0 (lower), ≤ 0 (upper)
//!
//! over the rigid walls that q⁺ touches: the structure is not accelerated further into them. At an elastic wall too stiff for the step v₊ is all that
//! is known: there G δ = 0. A blow since t⁺ − ½h is not in v₊ yet, and the caller's to add.

use super::body::Body;
use super::programme::Programme;
use crate::error::Result;
use crate::linear::Symmetric;
use crate::qp::Backend;
use crate::scene::Scene;

#[derive(Debug)]
pub(super) struct Arrival {
    programme: Programme,
    /// Mass that each wall feels, kg.
    masses: Vec<f64>,
    b: Vec<f64>,
    held: Vec<f64>,
}

impl Arrival {
    pub fn new(scene: &Scene, body: &Body) -> Result<Self> {
        let m = &body.matrices;
        let a = Symmetric::sum(&[(1.0, &m.mass), (0.5 * body.h, &m.damping)]);
        let programme = Programme::new(scene, a, scene.gap_scale() / body.h, |_, _| 0.0, Backend::Auto)?;
        Ok(Self { programme, masses: scene.wall_masses(), b: vec![0.0; body.n], held: vec![0.0; body.walls.len()] })
    }

    /// Writes v⁺ to `v`, from q⁺, v₊ and the load f⁺ (N) at the end of step number `step`.
    pub fn velocity(
        &mut self,
        body: &Body,
        (step, time): (u64, f64),
        q: &[f64],
        v_half: &[f64],
        load: impl Iterator<Item = f64>,
        v: &mut [f64],
    ) -> Result<()> {
        let Self { programme, masses, b, held } = self;
        let h = body.h;
        b.iter_mut().zip(load).for_each(|(b, load)| *b = 0.5 * h * load);
        body.stiffness.add_product(-0.5 * h, q, b);
        body.damping.add_product(-0.5 * h, v_half, b);
        for row in 0..programme.places.len() {
            programme.free(row);
            for seat in 0..programme.places[row].walls.len() {
                let index = programme.places[row].walls[seat];
                let wall = body.walls[index];
                let depth = wall.depth(body.rows.dot(index, q));
                if depth < -body.touch {
                    continue;
                }
                if wall.law.is_rigid() {
                    programme.bound(row, index, wall.upper, 0.0);
                } else if h * h * wall.law.tangent(depth) > masses[index] {
                    programme.bound(row, index, true, 0.0);
                    programme.bound(row, index, false, 0.0);
                } else {
                    let rate = body.rows.dot(index, v_half);
                    let force = wall.sign * wall.law.pressure(depth, -wall.sign * rate);
                    body.rows.add_transposed(index, 0.5 * h * force, b);
                }
            }
        }
        held.fill(0.0);
        programme.solve(b, time, step, |index| body.walls[index].upper, held)?;
        for ((v, v_half), d) in v.iter_mut().zip(v_half).zip(programme.x()) {
            *v = v_half + d;
        }
        Ok(())
    }
}

/// v₋ half a step before the start, v − ½h a, with the damping that a contains divided as an implicit half step would, (M + ½hC)a = F.
pub(super) fn back(body: &Body, v: &[f64], force: &[f64]) -> Result<Vec<f64>> {
    let m = &body.matrices;
    let a = Symmetric::sum(&[(1.0, &m.mass), (0.5 * body.h, &m.damping)]);
    let mut change = force.to_vec();
    super::body::factor(&a)?.solve(&mut change);
    Ok(v.iter().zip(&change).map(|(v, a)| v - 0.5 * body.h * a).collect())
}
