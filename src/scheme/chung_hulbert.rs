//! The generalized-α rule of smooth forces (Chung & Hulbert 1993, J. Appl. Mech. 60, 371,
//! doi:10.1115/1.2900803), with extra forces and blows.
//!
//! An auxiliary acceleration a follows the smooth forces F = f − Cv − Kq + r_elastic,
//!
//! M[(1−α_m)a⁺ + α_m a] = (1−α_f)F⁺ + α_f F.
//!
//! Without a⁺ the state would be q̂ = q + hv + h²(½−β)a and v̂ = v + h(1−γ)a. With Δ = q⁺ − q̂ =
//! h²βa⁺ the rule is
//!
//! S Δ = b + Gᵀν,   S = [μM + hγC + h²βK]/(h²β),   b = past + f⁺ − C v̂ − K q̂,
//!
//! past = (α_f F − α_m M a)/(1−α_f), μ = (1−α_m)/(1−α_f), ν the forces of the walls. Where rigid
//! walls have changed the displacement, the rule gives at q⁺ the velocity v_c = v̂ + hγa⁺ with
//!
//! T a⁺ = past + f⁺ − K q⁺ + Gᵀr − C v̂,   T = μM + hγC.
//!
//! An extra force over the step changes the velocity by hM⁻¹f_x and the displacement by ½h times
//! that; a blow at t_b changes the velocity by M⁻¹J and the displacement by (t⁺ − t_b) times that.
//! Neither enters a. Summed over all later steps, with γ = ½ + α_f − α_m, the rule lets the damper
//! act on M⁻¹J as if the blow came in the middle of the step: −C d with M d = (t⁺ − h/2 − t_b)J is
//! added to the momentum.

use super::body::Body;
use super::frame::Frame;
use super::space::{Space, zero};
use super::start::StartForce;
use crate::error::{Error, Result};
use crate::linear::Symmetric;
use crate::step::Balance;

/// The rule's weights (Chung & Hulbert 1993, doi:10.1115/1.2900803, eqs 17, 20 and 25): order 2,
/// and the least damping of slow vibrations that ρ∞ allows.
pub(super) fn weights(rho: f64) -> Balance {
    let (alpha_m, alpha_f) = ((2.0 * rho - 1.0) / (rho + 1.0), rho / (rho + 1.0));
    let gamma = 0.5 + alpha_f - alpha_m;
    Balance::GeneralizedAlpha { alpha_m, alpha_f, beta: 0.25 * (gamma + 0.5).powi(2), gamma }
}

/// The rule, with its acceleration.
#[derive(Debug)]
pub(super) struct ChungHulbert<S: Space> {
    /// α_m, α_f, β, γ.
    alpha: [f64; 4],
    /// h(1−γ/2β), s: times a, the velocity on which the damper does not act where a wall is met; 0
    /// without damping.
    pub unfelt: f64,
    /// a, m/s².
    a: S::Vector,
    /// F at the step's start, N.
    force: S::Vector,
    mass: S::Factor,
    /// T.
    drag: S::Factor,
    past: S::Vector,
    pub b: S::Vector,
    /// q̂ and v̂, and the velocity change by the extra force, m/s.
    pub q: S::Vector,
    v: S::Vector,
    given: S::Vector,
}

impl<S: Space> ChungHulbert<S> {
    /// # Errors
    /// [`Error::Invalid`] for the balance of another scheme.
    pub fn new(body: &Body<S>, balance: Balance) -> Result<Self> {
        let Balance::GeneralizedAlpha { alpha_m, alpha_f, beta, gamma } = balance else {
            return Err(Error::invalid("scheme", "another balance", "generalized-alpha"));
        };
        let (alpha, zero) = ([alpha_m, alpha_f, beta, gamma], zero::<S>(body.n));
        Ok(Self {
            alpha,
            unfelt: if body.damped { body.h * (1.0 - gamma / (2.0 * beta)) } else { 0.0 },
            a: zero.clone(),
            force: zero.clone(),
            mass: S::mass(&body.matrices)?,
            drag: S::factor(&velocity_matrix(alpha, body))?,
            past: zero.clone(),
            b: zero.clone(),
            q: zero.clone(),
            v: zero.clone(),
            given: zero,
        })
    }

    /// μ.
    pub fn mu(&self) -> f64 {
        mu(self.alpha)
    }

    /// S.
    pub fn matrix(&self, body: &Body<S>) -> Symmetric {
        let ([.., beta, gamma], h, m) = (self.alpha, body.h, &body.matrices);
        let scale = h * h * beta;
        Symmetric::sum(&[(self.mu() / scale, &m.mass), (gamma / (h * beta), &m.damping), (1.0, &m.stiffness)])
    }

    /// T.
    pub fn velocity_matrix(&self, body: &Body<S>) -> Symmetric {
        velocity_matrix(self.alpha, body)
    }

    /// Starts from `q` and `v`; returns the forces of the elastic walls.
    pub fn restart(&mut self, body: &Body<S>, q: &S::Vector, v: &S::Vector) -> Vec<f64> {
        let StartForce { total, wall } = StartForce::smooth(body, q, v);
        self.a.clone_from(&total);
        S::solve(&mut self.mass, &mut self.a);
        self.force = total;
        wall
    }

    /// The accelerations and forces that it carries, as in `Rule::carried`.
    pub fn carried(&mut self) -> [Option<(&mut S::Vector, i32)>; 2] {
        [Some((&mut self.a, 2)), Some((&mut self.force, 2))]
    }

    /// Computes q̂, v̂, f⁺ and `past`, the terms of the last step.
    #[inline]
    pub fn predict(&mut self, body: &mut Body<S>, frame: &mut Frame<S>) {
        let Self { alpha: [alpha_m, alpha_f, beta, gamma], a, force, past, given, q, v, .. } = self;
        let (h, alpha_m, alpha_f) = (body.h, *alpha_m, *alpha_f);
        let (first, second) = (h * h * (0.5 - *beta), h * (1.0 - *gamma));
        for i in 0..body.n {
            q[i] = frame.q[i] + h * frame.v[i] + first * a[i];
            v[i] = frame.v[i] + second * a[i];
            past[i] = alpha_f / (1.0 - alpha_f) * force[i];
        }
        S::add_product(&body.mass, -alpha_m / (1.0 - alpha_f), a, past);
        body.load_at(frame.end);
        (0..body.n).for_each(|i| given[i] = h * frame.extra[i]);
        if given.as_ref().iter().any(|&p| p != 0.0) {
            S::solve(&mut self.mass, given);
            for i in 0..body.n {
                q[i] += 0.5 * h * given[i];
                v[i] += given[i];
            }
        }
        frame.blown = body.find_blows(&[(frame.start, frame.end, frame.end)]);
        if let (true, Some(blows)) = (frame.blown, &body.blows) {
            for i in 0..body.n {
                q[i] += blows.shift[i];
                v[i] += blows.given[i];
                frame.struck[i] = frame.v[i] + blows.given[i];
            }
            if body.damped {
                self.damp_blows(1.0, body, frame);
            }
        }
    }

    /// Adds −`share` M⁻¹C d to v̂, with d the displacement that the blows cause in addition to half
    /// a step of the velocity that they give.
    pub fn damp_blows(&mut self, share: f64, body: &mut Body<S>, frame: &Frame<S>) {
        let Self { b, v, mass, .. } = self;
        if body.find_blows(&[(frame.start, frame.end, frame.end - 0.5 * body.h)]) {
            b.as_mut().fill(0.0);
            body.damp_shift(share, b);
            S::solve(mass, b);
            (0..body.n).for_each(|i| v[i] += b[i]);
        }
    }

    /// Computes b, the damper not feeling a and the extra force over `unfelt` (s).
    #[inline]
    pub fn ask(&mut self, body: &Body<S>, unfelt: f64) {
        let Self { past, b, q, v, .. } = self;
        for i in 0..body.n {
            b[i] = past[i] + body.load[i];
        }
        S::add_product(&body.damping, -1.0, v, b);
        if unfelt != 0.0 {
            S::add_product(&body.damping, unfelt, &self.a, b);
            S::add_product(&body.damping, unfelt / body.h, &self.given, b);
        }
        S::add_product(&body.stiffness, -1.0, q, b);
    }

    /// q⁺ from Δ, and unless a rigid wall was `met` also a⁺ and v⁺.
    #[inline]
    pub fn displace(&mut self, delta: &[f64], met: bool, h: f64, frame: &mut Frame<S>) {
        let Self { alpha: [.., beta, gamma], a, q, v, .. } = self;
        for (i, delta) in delta.iter().enumerate() {
            frame.q[i] = q[i] + delta;
            if !met {
                a[i] = delta / (h * h * *beta);
                frame.v[i] = v[i] + h * *gamma * a[i];
            }
        }
    }

    /// v_c at q⁺; `push` adds the forces Gᵀr of the elastic walls.
    pub fn free_velocity(&mut self, body: &Body<S>, frame: &mut Frame<S>, push: impl FnOnce(&mut S::Vector)) {
        let Self { alpha: [.., gamma], past, b, v, drag, .. } = self;
        for i in 0..body.n {
            b[i] = past[i] + body.load[i];
        }
        S::add_product(&body.damping, -1.0, v, b);
        S::add_product(&body.stiffness, -1.0, &frame.q, b);
        push(b);
        S::solve(drag, b);
        for i in 0..body.n {
            frame.v[i] = v[i] + body.h * *gamma * b[i];
        }
    }

    /// F⁺, and a⁺ again if the walls have changed the state; `push` adds the forces of the elastic
    /// ones.
    #[inline]
    pub fn renew(&mut self, body: &Body<S>, frame: &Frame<S>, changed: bool, push: impl FnOnce(&mut S::Vector)) {
        let Self { alpha, force, past, a, mass, .. } = self;
        force.clone_from(&body.load);
        S::add_product(&body.damping, -1.0, &frame.v, force);
        S::add_product(&body.stiffness, -1.0, &frame.q, force);
        push(force);
        if changed {
            let mu = mu(*alpha);
            (0..body.n).for_each(|i| a[i] = (past[i] + force[i]) / mu);
            S::solve(mass, a);
        }
    }
}

/// Whether a rigid wall or hole is met, as `place` finds with the damper not feeling a and the
/// extra force over a time (s); `closed` if one held the body before.
#[inline]
pub(super) fn is_met(unfelt: f64, closed: bool, mut place: impl FnMut(f64) -> Result<bool>) -> Result<bool> {
    if unfelt == 0.0 {
        place(0.0)
    } else if closed {
        // What holds the body is met, whichever way a heavy damper would throw it.
        Ok(place(unfelt)? || place(0.0)?)
    } else {
        // The displacement of what is met, unless by that nothing is.
        Ok(place(0.0)? && (place(unfelt)? || place(0.0)?))
    }
}

fn mu([alpha_m, alpha_f, ..]: [f64; 4]) -> f64 {
    (1.0 - alpha_m) / (1.0 - alpha_f)
}

/// T.
fn velocity_matrix<S: Space>(alpha: [f64; 4], body: &Body<S>) -> Symmetric {
    let ([.., gamma], m) = (alpha, &body.matrices);
    Symmetric::sum(&[(mu(alpha), &m.mass), (body.h * gamma, &m.damping)])
}
