//! `generalized-alpha`: nonsmooth generalized-α, the walls on the displacement and on the velocity.
//!
//! Brüls, Acary & Cardona 2014, Comput. Methods Appl. Mech. Engrg. 281, doi:10.1016/j.cma.2014.07.025, decoupled. A step without walls, by Chung & Hulbert's rule
//! with an auxiliary acceleration a,
//!
//! q̃ = q + hv + h²[(½−β)a + βa⁺],   ṽ = v + h[(1−γ)a + γa⁺],   (1−α_m)a⁺ + α_m a = M⁻¹[(1−α_f)F̃⁺ + α_f F̃],
//!
//! with the smooth force F̃ = f − Cṽ − Kq̃ + r_elastic at the uncorrected state; with Δ = h²βa⁺ it is the optimality condition of a programme over the elastic walls,
//! A = [M(1−α_m)/(1−α_f) + hγC + h²βK]/(h²β). The rigid walls then correct the displacement, and those that it leaves closed the velocity, both in the metric M:
//!
//! M(q⁺ − q̃) = Gᵀν,   0 ≤ gap(q⁺) ⟂ ν ≥ 0;   M(v⁺ − ṽ) = Gᵀp,   0 ≤ ±(ẇ⁺ + εẇ) ⟂ |p| ≥ 0,
//!
//! with ε = e where the body approaches or rests, 1 where it separates, so that several walls of unequal e create no energy; ẇ is the velocity after the step's
//! blows. p is the impulse of a wall, ν no force. No wall is ever penetrated, and no wall's force enters the rule's memory a: impacts leave no trace in it.
//!
//! What is given as an impulse (a blow, an extra force over the step) moves the velocity at once and the displacement by half a step of that, outside of a.

use super::body::{Body, factor};
use super::frame::{Frame, Predicted};
use super::programme::Programme;
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
    /// F̃, N.
    force: Vec<f64>,
    /// Force of each elastic wall at the step's start, N.
    held: Vec<f64>,
    /// The elastic walls in Δ, m.
    smooth: Programme,
    /// The rigid walls, in q⁺ − q̃ and in h(v⁺ − ṽ), m.
    rigid: Programme,
    mass: Factor,
    b: Vec<f64>,
    /// Impulse given to the step, N s; then the velocity it makes, m/s.
    given: Vec<f64>,
    zero: Vec<f64>,
    /// Multipliers of the walls, and which of them are closed.
    multiplier: Vec<f64>,
    closed: Vec<bool>,
}

impl GeneralizedAlpha {
    pub fn new(scene: &Scene, balance: Balance, h: f64, backend: Backend, frame: &mut Frame) -> Result<Self> {
        let Balance::GeneralizedAlpha { alpha_m, alpha_f, beta, gamma } = balance else {
            return Err(Error::invalid("scheme", "another balance", "generalized-alpha"));
        };
        let body = Body::new(scene, h);
        let StartForce { total: force, wall: held } = StartForce::smooth(&body, &frame.q, &frame.v);
        let m = &body.matrices;
        let mut mass = factor(&m.mass)?;
        let mut a = force.clone();
        mass.solve(&mut a);
        let scale = h * h * beta;
        let inertia = (1.0 - alpha_m) / ((1.0 - alpha_f) * scale);
        let matrix =
            Symmetric::sum(&[(inertia, &m.mass), (gamma / (h * beta), &m.damping), (1.0, &m.stiffness)]);
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
            smooth,
            rigid,
            mass,
            b: zero.clone(),
            given: zero.clone(),
            zero,
            multiplier: vec![0.0; body.walls.len()],
            closed: vec![false; body.walls.len()],
            body,
        })
    }

    pub fn advance(&mut self, step: u64, frame: &mut Frame) -> Result<()> {
        frame.begin(step, self.body.h);
        frame.before.copy_from_slice(&frame.v);
        self.predict(step, frame)?;
        let (start, h) = (frame.start, self.body.h);
        let Some(predicted) = &frame.predicted else { return Ok(()) };
        frame.q.copy_from_slice(&predicted.q);
        frame.v.copy_from_slice(&predicted.v);
        // The displacement first.
        let mut met = false;
        for row in 0..self.rigid.places.len() {
            let w = self.rigid.rows.dot(row, &frame.q);
            self.rigid.free(row);
            for seat in 0..self.rigid.places[row].walls.len() {
                let index = self.rigid.places[row].walls[seat];
                let wall = self.body.walls[index];
                self.rigid.bound(row, index, wall.upper, wall.g - w);
                met |= wall.depth(w) > 0.0;
            }
        }
        let body = &self.body;
        let upper = |wall: usize| body.walls[wall].upper;
        self.multiplier.fill(0.0);
        if met && self.rigid.solve(&self.zero, start, step, upper, &mut self.multiplier)? {
            frame.q.iter_mut().zip(self.rigid.x()).for_each(|(q, d)| *q += d);
        }
        // Then the velocity, at the walls that are closed.
        let mut approaches = false;
        for row in 0..self.rigid.places.len() {
            let w = self.rigid.rows.dot(row, &frame.q);
            self.rigid.free(row);
            for seat in 0..self.rigid.places[row].walls.len() {
                let index = self.rigid.places[row].walls[seat];
                let wall = body.walls[index];
                let closed = self.multiplier[index] != 0.0 || wall.depth(w) >= -body.touch;
                self.closed[index] = closed;
                if closed {
                    let struck = self.rigid.rows.dot(row, frame.struck());
                    let epsilon = if wall.sign * struck <= 0.0 { wall.law.restitution().unwrap_or(0.0) } else { 1.0 };
                    let bound = -epsilon * struck - self.rigid.rows.dot(row, &frame.v);
                    self.rigid.bound(row, index, wall.upper, h * bound);
                    approaches |= wall.sign * bound > 0.0;
                }
            }
        }
        if approaches {
            self.multiplier.fill(0.0);
            if self.rigid.solve(&self.zero, start, step, upper, &mut self.multiplier)? {
                frame.v.iter_mut().zip(self.rigid.x()).for_each(|(v, d)| *v += d / h);
                for (wall, r) in self.multiplier.iter().enumerate() {
                    frame.impulse[wall] += r / h;
                    frame.force[wall] += r / (h * h);
                }
                frame.touched = true;
            }
        }
        frame.after.copy_from_slice(&frame.v);
        Ok(())
    }

    /// q̃, ṽ, a and F̃ of the step, and the elastic walls.
    fn predict(&mut self, step: u64, frame: &mut Frame) -> Result<()> {
        let Self { body, alpha: [alpha_m, alpha_f, beta, gamma], a, force, smooth, b, given, .. } = self;
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
        force.fill(0.0);
        body.loads.add_force(frame.end, 1.0, force);
        body.damping.add_product(-1.0, v, force);
        body.stiffness.add_product(-1.0, q, force);
        b.iter_mut().zip(force.iter()).for_each(|(b, f)| *b += f);
        for row in 0..smooth.places.len() {
            let (w, ahead) = (smooth.rows.dot(row, &frame.q), smooth.rows.dot(row, q));
            smooth.free(row);
            for seat in 0..smooth.places[row].walls.len() {
                let index = smooth.places[row].walls[seat];
                let wall = body.walls[index];
                if let WallLaw::Elastic { stiffness, damping } = wall.law {
                    // |r| = k_a s̃⁺ + c_a(s̃⁺ − s₊)/h, written in Δ.
                    let offset = stiffness * (ahead - wall.g) + damping * (ahead - wall.plate(w)) / h;
                    smooth.bound(row, index, wall.upper, -offset / (stiffness + damping / h));
                }
            }
        }
        let upper = |wall: usize| body.walls[wall].upper;
        let meets = smooth.solve(b, frame.start, step, upper, &mut frame.force)?;
        // F̃⁺ by its terms: what acts at t⁺.
        force.fill(0.0);
        body.loads.add_force(frame.end, 1.0, force);
        for (i, delta) in smooth.x().iter().enumerate() {
            a[i] = delta / scale;
            q[i] += delta;
            v[i] += h * gamma * a[i];
        }
        body.damping.add_product(-1.0, v, force);
        body.stiffness.add_product(-1.0, q, force);
        body.push(1.0, &frame.force, force);
        for ((p, held), &r) in frame.impulse.iter_mut().zip(&mut self.held).zip(&frame.force) {
            *p = 0.5 * h * (*held + r);
            frame.touched |= *p != 0.0;
            *held = r;
        }
        frame.touched |= meets;
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
