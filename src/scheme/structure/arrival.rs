//! The velocity that a staggered scheme reports at t⁺, from v₊ at t⁺ − ½h.
//!
//! Half a step under the smooth force, v⁺ = v₊ + δ, is the minimiser of
//!
//! ½ δᵀ(M + ½hC)δ − ½h(f⁺ − K q⁺ − C v₊ + Gᵀ r⁺)ᵀδ   subject to   G δ ≥ 0 (lower), ≤ 0 (upper)
//!
//! over the rigid walls that q⁺ touches: the structure is not accelerated further into them. At an elastic wall too stiff for the step v₊ is all that
//! is known: there G δ = 0. A blow since t⁺ − ½h is not in v₊ yet, and the caller's to add.

use super::body::Body;
use super::frame::Frame;
use super::programme::{Programme, Seat};
use crate::error::Result;
use crate::linear::Symmetric;
use crate::qp::Backend;
use crate::scene::Scene;
use crate::scheme::paoli_schatzman::blow_spans;

#[derive(Debug)]
pub(super) struct Arrival {
    programme: Programme,
    /// Mass that each wall feels, kg.
    masses: Vec<f64>,
    b: Vec<f64>,
    held: Vec<f64>,
    holding: Vec<usize>,
}

impl Arrival {
    pub fn new(scene: &Scene, body: &Body) -> Result<Self> {
        let m = &body.matrices;
        let a = Symmetric::sum(&[(1.0, &m.mass), (0.5 * body.h, &m.damping)]);
        let programme = Programme::new(scene, a, scene.gap_scale() / body.h, |_, _| 0.0, Backend::Auto)?;
        let m = body.walls.len();
        Ok(Self {
            programme,
            masses: scene.wall_masses(),
            b: vec![0.0; body.n],
            held: vec![0.0; m],
            holding: Vec::with_capacity(m),
        })
    }

    /// Ends step number `step` of a staggered scheme that has moved the frame's displacement with the velocity `v` = v₊: shows it, takes the load at the end (N) for the
    /// last and writes the velocity there, under the caller's extra force (N) and after the blows since.
    pub fn finish(
        &mut self,
        body: &mut Body,
        step: u64,
        v: &[f64],
        (load, extra): (&mut [f64], &[f64]),
        frame: &mut Frame,
    ) -> Result<()> {
        frame.after.copy_from_slice(v);
        body.land(&blow_spans(step, body.h), frame);
        load.fill(0.0);
        body.loads.add_force(frame.end, 1.0, load);
        let felt = load.iter().zip(extra).map(|(load, extra)| load + extra);
        self.velocity(body, (step, frame.end), &frame.q, v, felt, &mut frame.v)?;
        body.kick((step as f64 + 0.5) * body.h, frame.end, &mut frame.v);
        Ok(())
    }

    /// Writes v⁺ to `v`, from q⁺, v₊ and the load f⁺ (N) at the end of step number `step`.
    fn velocity(
        &mut self,
        body: &Body,
        (step, time): (u64, f64),
        q: &[f64],
        v_half: &[f64],
        load: impl Iterator<Item = f64>,
        v: &mut [f64],
    ) -> Result<()> {
        let Self { programme, masses, b, held, holding } = self;
        let h = body.h;
        b.iter_mut().zip(load).for_each(|(b, load)| *b = 0.5 * h * load);
        body.stiffness.add_product(-0.5 * h, q, b);
        body.damping.add_product(-0.5 * h, v_half, b);
        for row in 0..programme.count_rows() {
            let w = programme.seen(row, q);
            programme.free(row);
            if programme.is_clear(row, w) {
                continue;
            }
            for seat in programme.seats(row) {
                let Seat { wall: index, stop: wall } = programme.seat(seat);
                let depth = wall.depth(w);
                if depth < -body.touch {
                    continue;
                }
                if wall.law.is_rigid() {
                    programme.bind(row, seat, 0.0);
                } else if h * h * wall.law.tangent(depth) > masses[index] {
                    programme.hold(row);
                } else {
                    let rate = programme.seen(row, v_half);
                    let force = wall.sign * wall.law.pressure(depth, -wall.sign * rate);
                    body.rows.add_transposed(index, 0.5 * h * force, b);
                }
            }
        }
        for wall in holding.drain(..) {
            held[wall] = 0.0;
        }
        programme.solve(b, (time, step), held, holding)?;
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
    super::factor::factor(&a)?.solve(&mut change);
    Ok(v.iter().zip(&change).map(|(v, a)| v - 0.5 * body.h * a).collect())
}
