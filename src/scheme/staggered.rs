//! What the staggered schemes share, which carry the velocity half a step behind the displacement:
//! the start, the instants at which blows and extra forces count, and the velocity reported at t⁺,
//! which follows from v₊ at t⁺ − ½h.
//!
//! Half a step under the smooth force, v⁺ = v₊ + δ, is the minimiser of
//!
//! ½ δᵀ(M + ½hC)δ − ½h(f⁺ − K q⁺ − C v₊ + Gᵀ r⁺)ᵀδ   subject to   G δ ≥ 0 (lower), ≤ 0 (upper)
//!
//! over the rigid walls that q⁺ touches: the structure is not accelerated further into them. At an
//! elastic wall whose vibration the step does not resolve, G δ = 0: v₊ is reported. A blow after t⁺
//! − ½h is not yet part of v₊, and is added.

use super::body::Body;
use super::frame::Frame;
use super::programme::Programme;
use super::space::{Space, zero};
use super::start::StartForce;
use crate::error::Result;
use crate::linear::Symmetric;
use crate::qp::Backend;
use crate::scene::Scene;

/// What a staggered scheme carries from one step to the next, and the end of its steps.
#[derive(Debug)]
pub(super) struct Staggered<S: Space> {
    /// v₋ = (q − q⁻)/h, m/s.
    pub v: S::Vector,
    /// The caller's extra force in the last step, N; 0 before the first.
    extra: S::Vector,
    programme: Programme<S>,
    /// M + ½hC.
    half_step: S::Factor,
    /// Mass that each wall feels, kg.
    masses: Vec<f64>,
    b: S::Vector,
    held: Vec<f64>,
    holding: Vec<usize>,
}

impl<S: Space> Staggered<S> {
    pub fn new(scene: &Scene, body: &Body<S>) -> Result<Self> {
        let m = &body.matrices;
        let a = Symmetric::sum(&[(1.0, &m.mass), (0.5 * body.h, &m.damping)]);
        let half_step = S::factor(&a)?;
        let programme = Programme::new(scene, a, scene.gap_scale() / body.h, |_| 0.0, Backend::Auto)?;
        let (n, walls) = (body.n, body.walls.len());
        Ok(Self {
            v: zero::<S>(n),
            extra: zero::<S>(n),
            programme,
            half_step,
            masses: scene.wall_masses(),
            b: zero::<S>(n),
            held: vec![0.0; walls],
            holding: Vec::with_capacity(walls),
        })
    }

    /// Starts the motion at `time` (s) from the frame's state, under all forces that act there. The
    /// walls' reactions are among them: without them a body at rest on a wall with e = 1 would
    /// bounce. v₋ = v − ½h a with (M + ½hC)a = F, an implicit half step: it differs from M a = F by
    /// order h² in v₋, and a heavy damper does not make v₋ huge.
    ///
    /// # Errors
    /// As [`StartForce::new`].
    pub fn restart(&mut self, scene: &Scene, body: &mut Body<S>, time: f64, frame: &Frame<S>) -> Result<()> {
        body.restart(time);
        let (h, v) = (body.h, &frame.v);
        self.b.clone_from(&StartForce::new(scene, body, &frame.q, v)?.total);
        S::solve(&mut self.half_step, &mut self.b);
        for ((back, v), a) in self.v.as_mut().iter_mut().zip(v.as_ref()).zip(self.b.as_ref()) {
            *back = v - 0.5 * h * a;
        }
        self.extra.as_mut().fill(0.0);
        for wall in self.holding.drain(..) {
            self.held[wall] = 0.0;
        }
        Ok(())
    }

    /// Begins step number `step`: the frame's extra force, constant over the step, becomes its mean
    /// over t ± ½h, and v₋ becomes the velocity before the step. At t = 0 the half before the start
    /// counts as zero: v₋ is extrapolated without the extra force.
    #[inline]
    pub fn begin(&mut self, step: u64, h: f64, frame: &mut Frame<S>) {
        frame.begin(step, h);
        for (last, felt) in self.extra.as_mut().iter_mut().zip(frame.extra.as_mut()) {
            let extra = *felt;
            *felt = 0.5 * (*last + extra);
            *last = extra;
        }
        frame.before.clone_from(&self.v);
    }

    /// Ends step number `step`, which has advanced the frame's displacement with the velocity
    /// `self.v` = v₊: writes v₊ as the velocity after the step, updates the loads and writes the
    /// velocity at the end of the step, under the caller's extra force and after the blows of its
    /// second half.
    pub fn finish(&mut self, body: &mut Body<S>, step: u64, frame: &mut Frame<S>) -> Result<()> {
        let h = body.h;
        frame.after.clone_from(&self.v);
        // The momentum balance is centred at the instants of the grid: it counts a blow as if it
        // came at the nearest one.
        let (start, middle, end) = (step as f64 * h, (step as f64 + 0.5) * h, (step + 1) as f64 * h);
        body.land(&[(start, middle, start), (middle, end, end)], frame);
        body.load_at(frame.end);
        self.arrive(body, (step, frame.end), frame)?;
        if let Some(blows) = &mut body.blows {
            blows.kick(middle, frame.end, &mut frame.v);
        }
        Ok(())
    }

    /// Writes v⁺, the velocity at the end of the step, with the forces at the frame's displacement.
    fn arrive(&mut self, body: &Body<S>, (step, time): (u64, f64), frame: &mut Frame<S>) -> Result<()> {
        let Self { programme, masses, b, held, holding, v: v_half, extra, .. } = self;
        let (h, q) = (body.h, &frame.q);
        for (b, (load, extra)) in b.as_mut().iter_mut().zip(body.load.as_ref().iter().zip(extra.as_ref())) {
            *b = 0.5 * h * (load + extra);
        }
        S::add_product(&body.stiffness, -0.5 * h, q, b);
        S::add_product(&body.damping, -0.5 * h, v_half, b);
        programme.free();
        for row in 0..programme.count_rows() {
            let w = programme.seen(row, q);
            if programme.is_clear(row, w) {
                continue;
            }
            for number in programme.walls(row) {
                let wall = programme.wall(number);
                let depth = wall.depth(w);
                if depth < -body.touch {
                    continue;
                }
                if wall.law.is_rigid() {
                    programme.bind(row, number, 0.0);
                } else if h * h * wall.law.tangent(depth) > masses[wall.index] {
                    programme.hold(row);
                } else {
                    let rate = programme.seen(row, v_half);
                    let force = wall.sign * wall.law.pressure(depth, -wall.sign * rate);
                    S::add_transposed(&body.rows, wall.index, 0.5 * h * force, b);
                }
            }
        }
        for wall in holding.drain(..) {
            held[wall] = 0.0;
        }
        programme.solve(b, (time, step), held, holding)?;
        let change = programme.x().as_ref();
        for ((v, v_half), d) in frame.v.as_mut().iter_mut().zip(v_half.as_ref()).zip(change) {
            *v = v_half + d;
        }
        Ok(())
    }
}

/// The interval of blows that the momentum balance of step number `step` counts as if they came at
/// its start, and that instant: (from, to, t), s.
#[inline]
pub(super) fn counted_blows(step: u64, h: f64) -> (f64, f64, f64) {
    // The edges of `Forcing::impulse_about`.
    let edge = |half_steps: f64| (half_steps * h).max(0.0);
    (edge(step as f64 - 0.5), edge(step as f64 + 0.5), step as f64 * h)
}

#[cfg(test)]
mod tests;
