//! `generalized-alpha`: nonsmooth generalized-α, the walls on the displacement and on the velocity.
//!
//! Chen, Acary, Virlez & Brüls 2013, Int. J. Numer. Methods Engrg. 96, doi:10.1002/nme.4563, and
//! Brüls, Acary & Cardona 2014, Comput. Methods Appl. Mech. Engrg. 281,
//! doi:10.1016/j.cma.2014.07.025. Chung & Hulbert's rule carries an auxiliary acceleration a of the
//! smooth forces, which are evaluated at the state with the walls' corrections,
//!
//! M[(1−α_m)a⁺ + α_m a] = (1−α_f)F⁺ + α_f F,
//!
//! F = f − Cv − Kq + r_elastic at (t, q, v), F⁺ at (t⁺, q⁺, v⁺);
//!
//! the rigid walls act in addition, on the displacement by a correction U and on the velocity by
//! their impulses p:
//!
//! q⁺ = q + hv + h²[(½−β)a + βa⁺] + U,            0 ≤ gap(q⁺) ⟂ |ν| ≥ 0,
//!
//! v⁺ = v + h[(1−γ)a + γa⁺] + M⁻¹Gᵀp, 0 ≤ ±(ẇ⁺ + εẇ) ⟂ |p| ≥ 0 at the walls that are closed at q⁺,
//!
//! with ε = e where the body approaches or rests, 1 where it separates; ẇ is the velocity after the
//! step's blows, so v⁺ = −v is always admissible: a solution exists. A body at rest keeps v = 0, so
//! that M a = F and p = −hF: the force at rest is the static one in every step. (With the smooth
//! force at the state before the walls' correction it would be too small, by a factor of 1 +
//! (1−α_f)(hc/m + h²k/2m) for one degree of freedom.)
//!
//! The papers solve for U and p together; their problem is not symmetric. Here they are solved one
//! after the other, each by a convex programme. With μ = (1−α_m)/(1−α_f), q̂ and v̂ the parts of q⁺
//! and v⁺ without a⁺, and Δ = q⁺ − q̂,
//!
//! S Δ = b + Gᵀν,   S = [μM + hγC + h²βK]/(h²β);     T(v⁺ − v_c) = μ Gᵀp,   T = μM + hγC,
//!
//! where v_c is the velocity that the rule gives at q⁺ without p. Without damping U is that of the
//! papers, M U = Gᵀν/μ. With damping, U differs by the effect of p through C within a step; and
//! where a rigid wall is met, the damper in b takes v̂ − h(1−γ/2β)a, so that a body at rest is not
//! moved by an a that the walls cancel (at ρ∞ = 1, where γ = 2β, the difference is zero).
//!
//! No rigid wall is ever penetrated, and the force of a rigid wall never enters the acceleration a.
//! In return, the work of the smooth force over U is not accounted for: each impact gains or loses
//! energy of order h.
//!
//! An extra force over the step changes the velocity by hM⁻¹f_x and the displacement by ½h times
//! that; a blow at t_b changes the velocity by M⁻¹J and the displacement by (t⁺ − t_b) times that.
//! Neither enters a. Summed over all later steps, with γ = ½ + α_f − α_m, the rule lets the damper
//! act on M⁻¹J as if the blow came in the middle of the step: −C d with M d = (t⁺ − h/2 − t_b)J is
//! added to the momentum.

use super::Counters;
use super::body::Body;
use super::frame::Frame;
use super::programme::{Programme, Seat};
use super::rule::Rule;
use super::space::{Space, zero};
use super::start::StartForce;
use super::stop::Stop;
use crate::error::{Error, Result};
use crate::linear::Symmetric;
use crate::qp::Backend;
use crate::scene::{Scene, WallLaw};
use crate::step::Balance;

#[derive(Debug)]
pub(super) struct GeneralizedAlpha<S: Space> {
    body: Body<S>,
    /// α_m, α_f, β, γ.
    alpha: [f64; 4],
    /// h(1−γ/2β), s: times a, the velocity on which the damper does not act where a wall is met; 0
    /// without damping.
    unfelt: f64,
    /// True if a rigid wall is closed at the step's start.
    closed: bool,
    /// a, m/s².
    a: S::Vector,
    /// F at the step's start, N.
    force: S::Vector,
    /// Force of each elastic wall at the step's start, N, and the walls where it is not zero.
    held: Vec<f64>,
    holding: Vec<usize>,
    /// All walls, in Δ, m.
    place: Programme<S>,
    /// The rigid walls, in v⁺ − v_c, m/s.
    rate: Programme<S>,
    mass: S::Factor,
    /// T.
    drag: S::Factor,
    /// α_f F − α_m M a, over 1 − α_f; and b, N.
    past: S::Vector,
    b: S::Vector,
    /// q̂ and v̂, and the velocity change by the extra force, m/s.
    q: S::Vector,
    v: S::Vector,
    given: S::Vector,
    zero: S::Vector,
    /// Multipliers of the programmes, and the walls where they are not zero.
    multiplier: Vec<f64>,
    pushing: Vec<usize>,
}

impl<S: Space> GeneralizedAlpha<S> {
    pub fn new(scene: &Scene, balance: Balance, h: f64, backend: Backend) -> Result<Self> {
        let Balance::GeneralizedAlpha { alpha_m, alpha_f, beta, gamma } = balance else {
            return Err(Error::invalid("scheme", "another balance", "generalized-alpha"));
        };
        let body = Body::<S>::new(scene, h)?;
        let m = &body.matrices;
        let (mu, scale) = ((1.0 - alpha_m) / (1.0 - alpha_f), h * h * beta);
        let matrix = Symmetric::sum(&[(mu / scale, &m.mass), (gamma / (h * beta), &m.damping), (1.0, &m.stiffness)]);
        let drag = Symmetric::sum(&[(mu, &m.mass), (h * gamma, &m.damping)]);
        let gap = scene.gap_scale();
        let place = Programme::new(scene, matrix, gap, |k, c| 1.0 / (k + c / h), backend)?;
        let rate = Programme::over(scene, WallLaw::is_rigid, drag.clone(), gap / h, |_, _| 0.0, backend)?;
        let (zero, walls) = (zero::<S>(body.n), body.walls.len());
        Ok(Self {
            alpha: [alpha_m, alpha_f, beta, gamma],
            unfelt: if body.damped { h * (1.0 - gamma / (2.0 * beta)) } else { 0.0 },
            closed: false,
            a: zero.clone(),
            force: zero.clone(),
            held: vec![0.0; walls],
            holding: Vec::with_capacity(walls),
            place,
            rate,
            mass: S::mass(m)?,
            drag: S::factor(&drag)?,
            past: zero.clone(),
            b: zero.clone(),
            q: zero.clone(),
            v: zero.clone(),
            given: zero.clone(),
            zero,
            multiplier: vec![0.0; walls],
            pushing: Vec::with_capacity(walls),
            body,
        })
    }

    /// Computes q̂, v̂, f⁺ and `past`, the terms of the last step.
    fn predict(&mut self, frame: &mut Frame<S>) {
        let Self { body, alpha: [alpha_m, alpha_f, beta, gamma], a, force, past, given, q, v, .. } = self;
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
                self.damp_blows(1.0, frame);
            }
        }
    }

    /// q⁺, v⁺ without the rigid walls' impulses unless one was met, a⁺ likewise, and the elastic
    /// walls' forces. Returns whether a rigid wall was met.
    fn displace(&mut self, step: u64, frame: &mut Frame<S>) -> Result<bool> {
        let met = if self.unfelt == 0.0 {
            self.place(step, frame, 0.0)?
        } else if self.closed {
            // A wall that holds the body is met, whichever way a heavy damper would throw it.
            self.place(step, frame, self.unfelt)? || self.place(step, frame, 0.0)?
        } else {
            // The displacement of a met wall, unless by that none is.
            self.place(step, frame, 0.0)? && (self.place(step, frame, self.unfelt)? || self.place(step, frame, 0.0)?)
        };
        let Self { body, alpha: [.., beta, gamma], place, a, q, v, .. } = self;
        let h = body.h;
        for (i, delta) in place.x().as_ref().iter().enumerate() {
            frame.q[i] = q[i] + delta;
            if !met {
                a[i] = delta / (h * h * *beta);
                frame.v[i] = v[i] + h * *gamma * a[i];
            }
        }
        Ok(met)
    }

    /// Solves for Δ, the damper not feeling a and the extra force over `unfelt` (s). Returns
    /// whether a rigid wall pushes.
    fn place(&mut self, step: u64, frame: &Frame<S>, unfelt: f64) -> Result<bool> {
        let h = self.body.h;
        for wall in self.pushing.drain(..) {
            self.multiplier[wall] = 0.0;
        }
        let Self { body, place, past, b, q, v, .. } = self;
        for i in 0..body.n {
            b[i] = past[i] + body.load[i];
        }
        S::add_product(&body.damping, -1.0, v, b);
        if unfelt != 0.0 {
            S::add_product(&body.damping, unfelt, &self.a, b);
            S::add_product(&body.damping, unfelt / h, &self.given, b);
        }
        S::add_product(&body.stiffness, -1.0, q, b);
        place.free();
        for row in 0..place.count_rows() {
            let ahead = place.seen(row, q);
            for seat in place.seats(row) {
                let wall = place.seat(seat).stop;
                let bound = match wall.law {
                    WallLaw::Elastic { stiffness, damping } => {
                        // |r| = k_a s⁺ + c_a(s⁺ − s₊)/h, written in Δ.
                        let plate = wall.plate(place.seen(row, &frame.q));
                        let offset = stiffness * (ahead - wall.g) + damping * (ahead - plate) / h;
                        -offset / (stiffness + damping / h)
                    }
                    _ => wall.g - ahead,
                };
                place.bind(row, seat, bound);
            }
        }
        place.solve(b, (frame.start, step), &mut self.multiplier, &mut self.pushing)?;
        Ok(self.pushing.iter().any(|&wall| body.walls[wall].law.is_rigid()))
    }

    /// Writes the forces of the elastic walls, and the impulses ½h(r + r⁺) of those that push at
    /// either end of the step.
    fn press(&mut self, frame: &mut Frame<S>) {
        let h = self.body.h;
        for wall in self.holding.drain(..) {
            frame.impulse[wall] = 0.5 * h * self.held[wall];
            self.held[wall] = 0.0;
            frame.pushing.push(wall);
        }
        for &wall in self.pushing.iter().filter(|&&wall| !self.body.walls[wall].law.is_rigid()) {
            let force = self.multiplier[wall];
            if frame.impulse[wall] == 0.0 {
                frame.pushing.push(wall);
            }
            frame.impulse[wall] += 0.5 * h * force;
            frame.force[wall] = force;
            self.held[wall] = force;
            self.holding.push(wall);
        }
    }

    /// v_c = v̂ + hγa⁺ at q⁺, with T a⁺ = past + f⁺ − K q⁺ + Gᵀr − C v̂.
    fn free_velocity(&mut self, frame: &mut Frame<S>) {
        let Self { body, alpha: [.., gamma], past, b, v, drag, .. } = self;
        for i in 0..body.n {
            b[i] = past[i] + body.load[i];
        }
        S::add_product(&body.damping, -1.0, v, b);
        S::add_product(&body.stiffness, -1.0, &frame.q, b);
        for &wall in &self.holding {
            S::add_transposed(&body.rows, wall, self.held[wall], b);
        }
        S::solve(drag, b);
        for i in 0..body.n {
            frame.v[i] = v[i] + body.h * *gamma * b[i];
        }
    }

    /// Adds −`share` M⁻¹C d to v̂, with d the displacement that the blows cause in addition to half
    /// a step of the velocity that they give.
    fn damp_blows(&mut self, share: f64, frame: &Frame<S>) {
        let Self { body, b, v, mass, .. } = self;
        if body.find_blows(&[(frame.start, frame.end, frame.end - 0.5 * body.h)]) {
            b.as_mut().fill(0.0);
            body.damp_shift(share, b);
            S::solve(mass, b);
            (0..body.n).for_each(|i| v[i] += b[i]);
        }
    }

    /// True if the blows drive the body into a rigid wall that is closed at q⁺: it keeps the body
    /// from that displacement, and the momentum that they would lose to the damper goes to the
    /// wall.
    fn answers(&self, frame: &Frame<S>) -> bool {
        let Self { body, multiplier, .. } = self;
        let closed =
            |wall: usize| multiplier[wall] != 0.0 || body.walls[wall].depth(body.seen(wall, &frame.q)) >= -body.touch;
        (0..body.walls.len()).any(|wall| body.drives(wall) && closed(wall))
    }

    /// Solves for v⁺ and the impulses of the rigid walls that are closed. Returns whether one of
    /// them pushes.
    fn correct_velocity(&mut self, frame: &mut Frame<S>, step: u64) -> Result<bool> {
        let (h, rate) = (self.body.h, &mut self.rate);
        let mut approaches = false;
        self.closed = false;
        rate.free();
        for row in 0..rate.count_rows() {
            let w = rate.seen(row, &frame.q);
            if rate.is_clear(row, w) && self.pushing.is_empty() {
                continue;
            }
            for seat in rate.seats(row) {
                let Seat { wall: index, stop: wall } = rate.seat(seat);
                // A wall with a multiplier is closed too: q⁺ is at it to the rounding error of q.
                if self.multiplier[index] == 0.0 && wall.depth(w) < -self.body.touch {
                    continue;
                }
                self.closed = true;
                let struck = rate.seen(row, frame.struck());
                let epsilon = if wall.sign * struck <= 0.0 { wall.law.restitution().unwrap_or(0.0) } else { 1.0 };
                let bound = -epsilon * struck - rate.seen(row, &frame.v);
                rate.bind(row, seat, bound);
                approaches |= wall.sign * bound > 0.0;
            }
        }
        for wall in self.pushing.drain(..) {
            self.multiplier[wall] = 0.0;
        }
        if approaches {
            let [alpha_m, alpha_f, ..] = self.alpha;
            let mu = (1.0 - alpha_m) / (1.0 - alpha_f);
            self.rate.solve(&self.zero, (frame.start, step), &mut self.multiplier, &mut self.pushing)?;
            frame.v.as_mut().iter_mut().zip(self.rate.x().as_ref()).for_each(|(v, d)| *v += d);
            for &wall in &self.pushing {
                frame.impulse[wall] = self.multiplier[wall] / mu;
                frame.force[wall] = frame.impulse[wall] / h;
                frame.pushing.push(wall);
            }
        }
        Ok(approaches)
    }
}

impl<S: Space> Rule<S> for GeneralizedAlpha<S> {
    fn restart(&mut self, _: &Scene, time: f64, frame: &Frame<S>) -> Result<()> {
        self.body.restart(time);
        let StartForce { total, wall } = StartForce::smooth(&self.body, &frame.q, &frame.v);
        self.holding.clear();
        self.holding.extend((0..wall.len()).filter(|&index| wall[index] != 0.0));
        self.a.clone_from(&total);
        S::solve(&mut self.mass, &mut self.a);
        (self.force, self.held) = (total, wall);
        self.closed = closed(&self.body, &frame.q);
        for wall in self.pushing.drain(..) {
            self.multiplier[wall] = 0.0;
        }
        Ok(())
    }

    fn advance(&mut self, step: u64, frame: &mut Frame<S>) -> Result<()> {
        frame.begin(step, self.body.h);
        frame.before.clone_from(&frame.v);
        self.predict(frame);
        let met = self.displace(step, frame)?;
        self.press(frame);
        let answered = frame.blown && self.body.damped && self.answers(frame);
        if answered {
            self.damp_blows(-1.0, frame);
        }
        if met || answered {
            self.free_velocity(frame);
        }
        let pushed = self.correct_velocity(frame, step)?;
        // F⁺, and a⁺ again if the walls have changed the state.
        let Self { body, alpha: [alpha_m, alpha_f, ..], force, past, a, mass, .. } = self;
        force.clone_from(&body.load);
        S::add_product(&body.damping, -1.0, &frame.v, force);
        S::add_product(&body.stiffness, -1.0, &frame.q, force);
        for &wall in &self.holding {
            S::add_transposed(&body.rows, wall, self.held[wall], force);
        }
        if met || pushed || answered {
            let mu = (1.0 - *alpha_m) / (1.0 - *alpha_f);
            (0..body.n).for_each(|i| a[i] = (past[i] + force[i]) / mu);
            S::solve(mass, a);
        }
        frame.after.clone_from(&frame.v);
        Ok(())
    }

    fn count(&self, counters: &mut Counters) {
        self.rate.count(counters);
        self.place.count(counters);
    }

    fn backend(&self) -> Option<Backend> {
        Some(self.rate.backend())
    }
}

/// True if a rigid wall is closed at `q` (m).
fn closed<S: Space>(body: &Body<S>, q: &S::Vector) -> bool {
    let rests = |(wall, stop): (usize, &Stop)| stop.law.is_rigid() && stop.depth(body.seen(wall, q)) >= -body.touch;
    body.walls.iter().enumerate().any(rests)
}
