//! `generalized-alpha`: nonsmooth generalized-α, the walls on the displacement and on the velocity.
//!
//! Brüls, Acary & Cardona 2014, Comput. Methods Appl. Mech. Engrg. 281, doi:10.1016/j.cma.2014.07.025, decoupled. A step without walls, by
//! Chung & Hulbert's rule with an auxiliary acceleration a,
//!
//! q̃ = q + hv + h²[(½−β)a + βa⁺],   ṽ = v + h[(1−γ)a + γa⁺],   M[(1−α_m)a⁺ + α_m a] = (1−α_f)F̃⁺ + α_f F,
//!
//! with the smooth force F = f − Cv − Kq + r_elastic, at the end that of the uncorrected state; with Δ = h²βa⁺ it is the optimality
//! condition A Δ = b + Gᵀr of a programme over the elastic walls, A = [M(1−α_m)/(1−α_f) + hγC + h²βK]/(h²β). The rigid walls then correct
//! the displacement, and those that it leaves closed the velocity, both in the metric M:
//!
//! M(q⁺ − q̃) = Gᵀν,   0 ≤ gap(q⁺) ⟂ |ν| ≥ 0;   M(v⁺ − ṽ) = Gᵀp,   0 ≤ ±(ẇ⁺ + εẇ) ⟂ |p| ≥ 0,
//!
//! with ε = e where the body approaches or rests, 1 where it separates; ẇ is the velocity after the step's blows, so v⁺ = −v is among the
//! motions allowed: there is always one. p is the impulse of a wall, ν no force. No rigid wall is ever passed, and no force of one enters
//! the rule's memory a. In return nothing accounts for the work that the smooth force does on q⁺ − q̃: each impact makes or loses energy of
//! order h.
//!
//! What is given as an impulse (a blow, an extra force over the step) moves the velocity at once and the displacement by half a step of
//! that, outside of a.

use super::body::{Body, factor};
use super::frame::{Frame, Predicted};
use super::programme::{Programme, Seat};
use super::start::StartForce;
use crate::error::{Error, Result};
use crate::linear::{Factor, Symmetric};
use crate::qp::Backend;
use crate::scene::{Scene, WallLaw};
use crate::scheme::Counters;
use crate::step::Balance;

#[derive(Debug)]
pub(super) struct GeneralizedAlpha {
    body: Body,
    /// α_m, α_f, β, γ.
    alpha: [f64; 4],
    /// a, m/s².
    a: Vec<f64>,
    /// F at the step's start, N.
    force: Vec<f64>,
    /// Force of each elastic wall at the step's start, N, and the walls where it is not zero.
    held: Vec<f64>,
    holding: Vec<usize>,
    /// The elastic walls in Δ, m.
    smooth: Programme,
    /// The rigid walls, in q⁺ − q̃ and in h(v⁺ − ṽ), m.
    rigid: Programme,
    mass: Factor,
    b: Vec<f64>,
    /// Impulse given to the step, N s; then the velocity it makes, m/s.
    given: Vec<f64>,
    zero: Vec<f64>,
    /// Multipliers of the rigid walls, and the walls where they are not zero.
    multiplier: Vec<f64>,
    pushing: Vec<usize>,
    /// f⁺, N.
    load: Vec<f64>,
}

impl GeneralizedAlpha {
    pub fn new(scene: &Scene, balance: Balance, h: f64, backend: Backend, frame: &mut Frame) -> Result<Self> {
        let Balance::GeneralizedAlpha { alpha_m, alpha_f, beta, gamma } = balance else {
            return Err(Error::invalid("scheme", "another balance", "generalized-alpha"));
        };
        let body = Body::new(scene, h);
        let StartForce { total: force, wall: held } = StartForce::smooth(&body, &frame.q, &frame.v);
        let mut holding = Vec::with_capacity(held.len());
        holding.extend((0..held.len()).filter(|&wall| held[wall] != 0.0));
        let m = &body.matrices;
        let mut mass = factor(&m.mass)?;
        let mut a = force.clone();
        mass.solve(&mut a);
        let scale = h * h * beta;
        let inertia = (1.0 - alpha_m) / ((1.0 - alpha_f) * scale);
        let matrix = Symmetric::sum(&[(inertia, &m.mass), (gamma / (h * beta), &m.damping), (1.0, &m.stiffness)]);
        let elastic = |law: &WallLaw| !law.is_rigid();
        let gap = scene.gap_scale();
        let smooth = Programme::over(scene, elastic, matrix, gap, |k, c| 1.0 / (k + c / h), backend)?;
        let rigid = Programme::over(scene, WallLaw::is_rigid, m.mass.clone(), gap, |_, _| 0.0, backend)?;
        let zero = vec![0.0; body.n];
        frame.predicted = Some(Predicted { q: zero.clone(), v: zero.clone() });
        Ok(Self {
            alpha: [alpha_m, alpha_f, beta, gamma],
            a,
            force,
            held,
            holding,
            smooth,
            rigid,
            mass,
            b: zero.clone(),
            given: zero.clone(),
            zero,
            multiplier: vec![0.0; body.walls.len()],
            pushing: Vec::with_capacity(body.walls.len()),
            load: vec![0.0; body.n],
            body,
        })
    }

    pub fn advance(&mut self, step: u64, frame: &mut Frame) -> Result<()> {
        frame.begin(step, self.body.h);
        frame.before.copy_from_slice(&frame.v);
        self.predict(step, frame)?;
        let Some(predicted) = &frame.predicted else { return Ok(()) };
        frame.q.copy_from_slice(&predicted.q);
        frame.v.copy_from_slice(&predicted.v);
        let moved = self.correct_displacement(frame, step)?;
        if self.correct_velocity(frame, step)? || moved {
            // F where the walls have put the body.
            self.force.copy_from_slice(&self.load);
            self.body.damping.add_product(-1.0, &frame.v, &mut self.force);
            self.body.stiffness.add_product(-1.0, &frame.q, &mut self.force);
            for &wall in &self.holding {
                self.body.rows.add_transposed(wall, self.held[wall], &mut self.force);
            }
        }
        frame.after.copy_from_slice(&frame.v);
        Ok(())
    }

    /// q⁺, and the multipliers ν of the walls. Returns whether a wall was met.
    fn correct_displacement(&mut self, frame: &mut Frame, step: u64) -> Result<bool> {
        let programme = &mut self.rigid;
        let mut met = false;
        for row in 0..programme.count_rows() {
            let w = programme.seen(row, &frame.q);
            programme.free(row);
            for seat in programme.seats(row) {
                let wall = programme.seat(seat).stop;
                programme.bind(row, seat, wall.g - w);
                met |= wall.depth(w) > 0.0;
            }
        }
        self.forget();
        if met {
            self.rigid.solve(&self.zero, (frame.start, step), &mut self.multiplier, &mut self.pushing)?;
            frame.q.iter_mut().zip(self.rigid.x()).for_each(|(q, d)| *q += d);
        }
        Ok(met)
    }

    /// v⁺ and the impulses, at the walls that are closed. Returns whether one pushes.
    fn correct_velocity(&mut self, frame: &mut Frame, step: u64) -> Result<bool> {
        let (h, programme) = (self.body.h, &mut self.rigid);
        let mut approaches = false;
        for row in 0..programme.count_rows() {
            let w = programme.seen(row, &frame.q);
            programme.free(row);
            if programme.is_clear(row, w) && self.pushing.is_empty() {
                continue;
            }
            for seat in programme.seats(row) {
                let Seat { wall: index, stop: wall } = programme.seat(seat);
                // A multiplier says so too: q⁺ is on the wall to rounding of q.
                if self.multiplier[index] == 0.0 && wall.depth(w) < -self.body.touch {
                    continue;
                }
                let struck = programme.seen(row, frame.struck());
                let epsilon = if wall.sign * struck <= 0.0 { wall.law.restitution().unwrap_or(0.0) } else { 1.0 };
                let bound = -epsilon * struck - programme.seen(row, &frame.v);
                programme.bind(row, seat, h * bound);
                approaches |= wall.sign * bound > 0.0;
            }
        }
        self.forget();
        if approaches {
            self.rigid.solve(&self.zero, (frame.start, step), &mut self.multiplier, &mut self.pushing)?;
            frame.v.iter_mut().zip(self.rigid.x()).for_each(|(v, d)| *v += d / h);
            for &wall in &self.pushing {
                frame.impulse[wall] = self.multiplier[wall] / h;
                frame.force[wall] = frame.impulse[wall] / h;
                frame.pushing.push(wall);
            }
        }
        Ok(approaches)
    }

    /// Clears the multipliers.
    fn forget(&mut self) {
        for wall in self.pushing.drain(..) {
            self.multiplier[wall] = 0.0;
        }
    }

    /// q̃, ṽ, a and F̃⁺ of the step, and the elastic walls.
    fn predict(&mut self, step: u64, frame: &mut Frame) -> Result<()> {
        let Self { body, alpha: [alpha_m, alpha_f, beta, gamma], a, force, smooth, b, given, load, .. } = self;
        let (h, scale) = (body.h, body.h * body.h * *beta);
        let (alpha_m, alpha_f, beta, gamma) = (*alpha_m, *alpha_f, *beta, *gamma);
        given.iter_mut().zip(&frame.extra).for_each(|(given, extra)| *given = h * extra);
        frame.blown = body.strike((frame.start, frame.end), &frame.v, 1.0, given, &mut frame.struck);
        let Some(Predicted { q, v }) = &mut frame.predicted else { return Ok(()) };
        let driven = given.iter().any(|&p| p != 0.0);
        if driven {
            self.mass.solve(given);
        }
        // All but what a⁺ adds.
        for i in 0..q.len() {
            q[i] = frame.q[i] + h * (frame.v[i] + h * (0.5 - beta) * a[i]);
            v[i] = frame.v[i] + h * (1.0 - gamma) * a[i];
            if driven {
                q[i] += 0.5 * h * given[i];
                v[i] += given[i];
            }
            b[i] = alpha_f / (1.0 - alpha_f) * force[i];
        }
        body.mass.add_product(-alpha_m / (1.0 - alpha_f), a, b);
        load.fill(0.0);
        body.loads.add_force(frame.end, 1.0, load);
        force.copy_from_slice(load);
        body.damping.add_product(-1.0, v, force);
        body.stiffness.add_product(-1.0, q, force);
        b.iter_mut().zip(force.iter()).for_each(|(b, f)| *b += f);
        for row in 0..smooth.count_rows() {
            let (w, ahead) = (smooth.seen(row, &frame.q), smooth.seen(row, q));
            smooth.free(row);
            for seat in smooth.seats(row) {
                let wall = smooth.seat(seat).stop;
                if let WallLaw::Elastic { stiffness, damping } = wall.law {
                    // |r| = k_a s̃⁺ + c_a(s̃⁺ − s₊)/h, written in Δ.
                    let offset = stiffness * (ahead - wall.g) + damping * (ahead - wall.plate(w)) / h;
                    smooth.bind(row, seat, -offset / (stiffness + damping / h));
                }
            }
        }
        smooth.solve(b, (frame.start, step), &mut frame.force, &mut frame.pushing)?;
        force.copy_from_slice(load);
        for (i, delta) in smooth.x().iter().enumerate() {
            a[i] = delta / scale;
            q[i] += delta;
            v[i] += h * gamma * a[i];
        }
        body.damping.add_product(-1.0, v, force);
        body.stiffness.add_product(-1.0, q, force);
        for &wall in &frame.pushing {
            body.rows.add_transposed(wall, frame.force[wall], force);
        }
        // The elastic walls' impulses ½h(r + r⁺), of those that push at either end.
        let now = frame.pushing.len();
        for wall in self.holding.drain(..) {
            frame.impulse[wall] = 0.5 * h * self.held[wall];
            self.held[wall] = 0.0;
            if frame.force[wall] == 0.0 {
                frame.pushing.push(wall);
            }
        }
        for &wall in &frame.pushing[..now] {
            frame.impulse[wall] += 0.5 * h * frame.force[wall];
            self.held[wall] = frame.force[wall];
            self.holding.push(wall);
        }
        Ok(())
    }

    pub fn backend(&self) -> Backend {
        self.rigid.backend()
    }

    pub fn count(&self, counters: &mut Counters) {
        self.rigid.count(counters);
        self.smooth.count(counters);
    }
}
