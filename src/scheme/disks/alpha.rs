//! `generalized-alpha` with round holes: as [`super::super::generalized_alpha`], where the
//! equations stand, with disks on the displacement and half-planes on the velocity.
//!
//! The displacement is corrected so that every hole holds it, |w⁺| ≤ γ. Of the holes that are then
//! closed, the velocity obeys the law of [`Turning`](crate::step::Turning) with the normal n in the
//! middle of w and w⁺: what arrives rebounds by e, what only the turning of the normal adds is
//! reflected. With n at w⁺ a body that slides would lose speed as in implicit-euler.

use super::super::space::indefinite;
use super::super::start::StartForce;
use super::super::supports::split;
use super::bounds::Bounds;
use super::held::Held;
use crate::error::{Error, Result};
use crate::linear::{Factor, Symmetric};
use crate::qp::{DiskBound, DiskCounters};
use crate::scene::{Scene, WallLaw};
use crate::step::Balance;

#[derive(Debug)]
pub(super) struct Alpha {
    /// α_m, α_f, β, γ.
    alpha: [f64; 4],
    /// h(1−γ/2β), s, as in the scheme between walls; 0 without damping.
    unfelt: f64,
    /// True if a rigid wall or hole is closed at the step's start.
    closed: bool,
    /// a, m/s², and F at the step's start, N.
    a: Vec<f64>,
    force: Vec<f64>,
    /// Force of each elastic wall at the step's start, N.
    held: Vec<f64>,
    /// All walls and holes, in Δ, m; the rigid ones in v⁺ − v_c, m/s.
    place: Bounds,
    rate: Bounds,
    mass: Factor,
    /// T.
    drag: Factor,
    /// α_f F − α_m M a, over 1 − α_f; and b, N.
    past: Vec<f64>,
    b: Vec<f64>,
    /// q̂ and v̂, and the velocity change by the extra force, m/s.
    q: Vec<f64>,
    v: Vec<f64>,
    given: Vec<f64>,
    zero: Vec<f64>,
    /// w of each hole at the step's start, m.
    start: Vec<[f64; 2]>,
}

impl Alpha {
    pub fn new(scene: &Scene, balance: Balance, held: &Held) -> Result<Self> {
        let Balance::GeneralizedAlpha { alpha_m, alpha_f, beta, gamma } = balance else {
            return Err(Error::invalid("scheme", "another balance", "generalized-alpha"));
        };
        let (h, m) = (held.body.h, &held.body.matrices);
        let (mu, scale) = ((1.0 - alpha_m) / (1.0 - alpha_f), h * h * beta);
        let matrix = Symmetric::sum(&[(mu / scale, &m.mass), (gamma / (h * beta), &m.damping), (1.0, &m.stiffness)]);
        let drag = Symmetric::sum(&[(mu, &m.mass), (h * gamma, &m.damping)]);
        let (zero, gap) = (vec![0.0; held.body.n], scene.gap_scale());
        let mut rule = Self {
            alpha: [alpha_m, alpha_f, beta, gamma],
            unfelt: if held.body.damped { h * (1.0 - gamma / (2.0 * beta)) } else { 0.0 },
            closed: false,
            a: zero.clone(),
            force: zero.clone(),
            held: vec![0.0; scene.walls.len()],
            place: Bounds::new(scene, matrix, gap, |k, c| 1.0 / (k + c / h))?,
            rate: Bounds::new(scene, drag.clone(), gap / h, |_, _| 0.0)?,
            mass: m.mass_factor().map_err(indefinite)?,
            drag: Factor::new(&drag).map_err(indefinite)?,
            past: zero.clone(),
            b: zero.clone(),
            q: zero.clone(),
            v: zero.clone(),
            given: zero.clone(),
            zero,
            start: vec![[0.0; 2]; held.rounds.len()],
        };
        rule.restart(held);
        Ok(rule)
    }

    /// Starts from the state of `held`.
    pub fn restart(&mut self, held: &Held) {
        let StartForce { total, wall } = StartForce::smooth(&held.body, &held.frame.q, &held.frame.v);
        self.a.clone_from(&total);
        self.mass.solve(&mut self.a);
        (self.force, self.held) = (total, wall);
        let q = &held.frame.q;
        let stands = |wall: usize| {
            let stop = held.body.walls[wall];
            stop.law.is_rigid() && stop.depth(held.body.seen(wall, q)) >= -held.body.touch
        };
        self.closed =
            (0..held.body.walls.len()).any(stands) || (0..held.rounds.len()).any(|hole| held.touches(hole, q));
    }

    /// Makes a step.
    pub fn advance(&mut self, step: u64, held: &mut Held) -> Result<()> {
        held.frame.before.clone_from(&held.frame.v);
        for (hole, start) in self.start.iter_mut().enumerate() {
            *start = held.offset(hole, &held.frame.q);
        }
        self.predict(held);
        let met = self.displace(step, held)?;
        self.press(held);
        let answered = held.frame.blown && held.body.damped && self.answers(held);
        if answered {
            self.damp_blows(-1.0, held);
        }
        if met || answered {
            self.free_velocity(held);
        }
        let pushed = self.correct_velocity(step, held)?;
        let Self { alpha: [alpha_m, alpha_f, ..], force, past, a, mass, .. } = self;
        let (body, frame) = (&held.body, &mut held.frame);
        force.clone_from(&body.load);
        body.damping.add_product(-1.0, &frame.v, force);
        body.stiffness.add_product(-1.0, &frame.q, force);
        body.push(1.0, &self.held, force);
        if met || pushed || answered {
            let mu = (1.0 - *alpha_m) / (1.0 - *alpha_f);
            (0..body.n).for_each(|i| a[i] = (past[i] + force[i]) / mu);
            mass.solve(a);
        }
        frame.after.clone_from(&frame.v);
        Ok(())
    }

    /// Computes q̂, v̂, f⁺ and `past`, the terms of the last step.
    fn predict(&mut self, held: &mut Held) {
        let Self { alpha: [alpha_m, alpha_f, beta, gamma], a, force, past, given, q, v, .. } = self;
        let (body, frame) = (&mut held.body, &mut held.frame);
        let (h, alpha_m, alpha_f) = (body.h, *alpha_m, *alpha_f);
        let (first, second) = (h * h * (0.5 - *beta), h * (1.0 - *gamma));
        for i in 0..body.n {
            q[i] = frame.q[i] + h * frame.v[i] + first * a[i];
            v[i] = frame.v[i] + second * a[i];
            past[i] = alpha_f / (1.0 - alpha_f) * force[i];
            given[i] = h * frame.extra[i];
        }
        body.mass.add_product(-alpha_m / (1.0 - alpha_f), a, past);
        body.load_at(frame.end);
        if given.iter().any(|&p| p != 0.0) {
            self.mass.solve(given);
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
                self.damp_blows(1.0, held);
            }
        }
    }

    /// q⁺, v⁺ without the impulses of rigid walls and holes unless one was met, a⁺ likewise, and the
    /// forces of elastic walls. Returns whether a rigid wall or hole was met.
    fn displace(&mut self, step: u64, held: &mut Held) -> Result<bool> {
        let met = if self.unfelt == 0.0 {
            self.put(step, held, 0.0)?
        } else if self.closed {
            // A hole that holds the body is met, whichever way a heavy damper would throw it.
            self.put(step, held, self.unfelt)? || self.put(step, held, 0.0)?
        } else {
            self.put(step, held, 0.0)? && (self.put(step, held, self.unfelt)? || self.put(step, held, 0.0)?)
        };
        let Self { alpha: [.., beta, gamma], place, a, q, v, .. } = self;
        let (h, frame) = (held.body.h, &mut held.frame);
        for (i, delta) in place.x().iter().enumerate() {
            frame.q[i] = q[i] + delta;
            if !met {
                a[i] = delta / (h * h * *beta);
                frame.v[i] = v[i] + h * *gamma * a[i];
            }
        }
        Ok(met)
    }

    /// Solves for Δ, the damper not feeling a and the extra force over `unfelt` (s). Returns whether
    /// a rigid wall or hole pushes.
    fn put(&mut self, step: u64, held: &Held, unfelt: f64) -> Result<bool> {
        let (body, frame) = (&held.body, &held.frame);
        let Self { place, past, b, q, v, .. } = self;
        for i in 0..body.n {
            b[i] = past[i] + body.load[i];
        }
        body.damping.add_product(-1.0, v, b);
        if unfelt != 0.0 {
            body.damping.add_product(unfelt, &self.a, b);
            body.damping.add_product(unfelt / body.h, &self.given, b);
        }
        body.stiffness.add_product(-1.0, q, b);
        for (wall, &stop) in body.walls.iter().enumerate() {
            let ahead = body.seen(wall, q);
            let bound = match stop.law {
                WallLaw::Elastic { stiffness, damping } => {
                    // |r| = k_a s⁺ + c_a(s⁺ − s₊)/h, written in Δ.
                    let plate = stop.plate(body.seen(wall, &frame.q));
                    let offset = stiffness * (ahead - stop.g) + damping * (ahead - plate) / body.h;
                    -offset / (stiffness + damping / body.h)
                }
                _ => stop.g - ahead,
            };
            place.bind_wall(wall, stop, bound);
        }
        for hole in 0..held.rounds.len() {
            place.bind_hole(hole, held.disk(hole, self.start[hole], held.offset(hole, q)));
        }
        place.solve(b, (frame.start, step))?;
        let walls = body.walls.iter().enumerate().any(|(wall, stop)| stop.law.is_rigid() && place.of_wall(wall) != 0.0);
        Ok(walls || (0..held.rounds.len()).any(|hole| place.of_hole(hole) != [0.0; 2]))
    }

    /// Writes the forces of the elastic walls, and the impulses ½h(r + r⁺) of those that push at
    /// either end of the step.
    fn press(&mut self, held: &mut Held) {
        let (body, frame) = (&held.body, &mut held.frame);
        for (wall, _) in body.walls.iter().enumerate().filter(|(_, stop)| !stop.law.is_rigid()) {
            let force = self.place.of_wall(wall);
            let impulse = 0.5 * body.h * (self.held[wall] + force);
            self.held[wall] = force;
            if impulse != 0.0 {
                (frame.impulse[wall], frame.force[wall]) = (impulse, force);
                frame.pushing.push(wall);
            }
        }
    }

    /// v_c = v̂ + hγa⁺ at q⁺, with T a⁺ = past + f⁺ − K q⁺ + Gᵀr − C v̂.
    fn free_velocity(&mut self, held: &mut Held) {
        let Self { alpha: [.., gamma], past, b, v, drag, .. } = self;
        let (body, frame) = (&held.body, &mut held.frame);
        for i in 0..body.n {
            b[i] = past[i] + body.load[i];
        }
        body.damping.add_product(-1.0, v, b);
        body.stiffness.add_product(-1.0, &frame.q, b);
        body.push(1.0, &self.held, b);
        drag.solve(b);
        for i in 0..body.n {
            frame.v[i] = v[i] + body.h * *gamma * b[i];
        }
    }

    /// Adds −`share` M⁻¹C d to v̂, with d the displacement that the blows cause in addition to half
    /// a step of the velocity that they give.
    fn damp_blows(&mut self, share: f64, held: &mut Held) {
        let Self { b, v, mass, .. } = self;
        let (body, frame) = (&mut held.body, &held.frame);
        if body.find_blows(&[(frame.start, frame.end, frame.end - 0.5 * body.h)]) {
            b.fill(0.0);
            body.damp_shift(share, b);
            mass.solve(b);
            (0..body.n).for_each(|i| v[i] += b[i]);
        }
    }

    /// True if a rigid wall is closed at q⁺.
    fn closes_wall(&self, held: &Held, wall: usize) -> bool {
        let stop = held.body.walls[wall];
        // A wall with a multiplier is closed too: q⁺ is at it to the rounding error of q.
        let presses = self.place.of_wall(wall) != 0.0;
        stop.law.is_rigid() && (presses || stop.depth(held.body.seen(wall, &held.frame.q)) >= -held.body.touch)
    }

    /// True if a rigid hole is closed at q⁺.
    fn closes_hole(&self, held: &Held, hole: usize) -> bool {
        held.rounds[hole].law.is_rigid() && (self.place.of_hole(hole) != [0.0; 2] || held.touches(hole, &held.frame.q))
    }

    /// True if the blows drive the body into a rigid wall or hole that is closed at q⁺: it keeps
    /// the body from that displacement, and the momentum that they would lose to the damper goes to
    /// it.
    fn answers(&self, held: &Held) -> bool {
        let Some(blows) = &held.body.blows else { return false };
        let into = |hole: usize| {
            let ([y, z], [vy, vz]) = (held.offset(hole, &held.frame.q), held.seen(hole, &blows.given));
            y * vy + z * vz > 0.0
        };
        (0..held.body.walls.len()).any(|wall| held.body.drives(wall) && self.closes_wall(held, wall))
            || (0..held.rounds.len()).any(|hole| into(hole) && self.closes_hole(held, hole))
    }

    /// Solves for v⁺ and the impulses of the rigid walls and holes that are closed. Returns whether
    /// one of them may push.
    fn correct_velocity(&mut self, step: u64, held: &mut Held) -> Result<bool> {
        let h = held.body.h;
        self.closed = false;
        for wall in 0..held.body.walls.len() {
            if !self.closes_wall(held, wall) {
                self.rate.open_wall(wall);
                continue;
            }
            self.closed = true;
            let (stop, body) = (held.body.walls[wall], &held.body);
            let struck = body.seen(wall, held.frame.struck());
            let epsilon = if stop.sign * struck <= 0.0 { stop.law.restitution().unwrap_or(0.0) } else { 1.0 };
            self.rate.bind_wall(wall, stop, -epsilon * struck - body.seen(wall, &held.frame.v));
        }
        for hole in 0..held.rounds.len() {
            if !self.closes_hole(held, hole) {
                self.rate.bind_hole(hole, DiskBound::OPEN);
                continue;
            }
            self.closed = true;
            let (start, end) = (self.start[hole], held.offset(hole, &held.frame.q));
            let middle = [start[0] + end[0], start[1] + end[1]];
            let size = middle[0].hypot(middle[1]);
            let normal = if size > 0.0 { middle.map(|w| w / size) } else { end.map(|w| w / held.rounds[hole].gap) };
            let struck = held.seen(hole, held.frame.struck());
            let (gap, e) = (held.rounds[hole].gap, held.rounds[hole].law.restitution().unwrap_or(0.0));
            let met = split((gap, e), start, struck, normal, h);
            let [vy, vz] = held.seen(hole, &held.frame.v);
            let hi = met.bound - (normal[0] * vy + normal[1] * vz);
            self.rate.bind_hole(hole, DiskBound::Strip { normal, lo: f64::NEG_INFINITY, hi });
            held.holes[hole].normal = normal;
        }
        if !self.closed {
            return Ok(false);
        }
        let [alpha_m, alpha_f, ..] = self.alpha;
        let mu = (1.0 - alpha_m) / (1.0 - alpha_f);
        self.rate.solve(&self.zero, (held.frame.start, step))?;
        held.frame.v.iter_mut().zip(self.rate.x()).for_each(|(v, d)| *v += d);
        for wall in 0..held.body.walls.len() {
            let r = self.rate.of_wall(wall);
            if r != 0.0 {
                held.frame.impulse[wall] = r / mu;
                held.frame.force[wall] = r / mu / h;
                held.frame.pushing.push(wall);
            }
        }
        for (hole, did) in held.holes.iter_mut().enumerate() {
            let [y, z] = self.rate.of_hole(hole);
            did.impulse = -(y * did.normal[0] + z * did.normal[1]) / mu;
        }
        Ok(true)
    }

    /// The work of both programmes.
    pub fn counters(&self) -> DiskCounters {
        let (place, rate) = (self.place.counters(), self.rate.counters());
        DiskCounters {
            solves: place.solves + rate.solves,
            free: place.free + rate.free,
            newton: place.newton + rate.newton,
            fallbacks: place.fallbacks + rate.fallbacks,
            iterations: place.iterations + rate.iterations,
        }
    }
}
