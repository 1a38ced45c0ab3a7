//! `moreau-jean` on scenes with round holes or friction. [`super::moreau_jean`] steps all others.
//!
//! The step is that of moreau-jean: with v⁺ = v + δ, q⁺ = q + h(v + θδ) and A = M + hθC + h²θ²K,
//!
//! A δ = h[f_θ − C v − K(q + hθv)] + J − C d + Σ Pᵀ(−p n + f t),    t = (−n_z, n_y),
//!
//! over the walls and holes that the step reaches; P are the two rows of a place. [`reach`] has
//! their bounds on n·ẇ⁺. Friction follows Coulomb's law on the impulses and the velocity at the end
//! of the step ([`crate::step::Friction`]): with velocities at θ in its place, a body that sticks
//! would bounce along the surface.
//!
//! In the cross-section a contact has one tangent, so its law is piecewise linear and has an exact
//! answer ([`touch`]); sweeps over the contacts and one linear system answer all of them, or a
//! pivoting method ([`sweeps`]), on the 2 × 2 blocks of P A⁻¹ Pᵀ, which are constant. Where no
//! answer has the rebounds that the contacts demand, they give these up for the step.
//!
//! Order 1 through impacts, 2 while sliding with θ = ½. Without friction a step never adds energy.
//! With friction it may where W couples normal and tangent and e > 0 (Kane & Levinson 1985,
//! Dynamics: Theory and Applications; the ledger shows it). If h v exceeds the gap, the body stands
//! still between opposite sides of a hole: such steps are counted, and so is the largest angle by
//! which a normal turned.
//!
//! Why no other scheme steps such scenes: the bound of paoli-schatzman, |w⁺ + e w⁻| ≤ (1+e)γ, does
//! not keep energy on a circle (with e = 1, over a way of 200 gaps, it lost 95 % to gained 60 % at
//! h v = γ/10), and newmark does not keep it on any wall.

mod linear;
mod memory;
mod normal;
mod places;
mod points;
mod reach;
mod sweeps;
mod touch;

pub(super) use normal::{CROSSING, TURNING, meet, meet_middle};

use super::Counters;
use super::body::Body;
use super::frame::Frame;
use super::matrices::Matrices;
use super::motion::Motion;
use super::pushes::Pushes;
use super::space::Space;
use crate::contact::Rates;
use crate::error::Result;
use crate::linear::Factor;
use crate::qp::Backend;
use crate::scene::{Checked, Scene};
use crate::step::{Contact, Contract, HoleStep, Step};
use memory::Memory;
use normal::dot;
use places::Places;
use points::{ContactPoint, contact_points};
use reach::Reach;
use sweeps::Sweeps;

/// The motion of a scene with supports.
#[derive(Debug)]
pub(super) struct Supports {
    body: Body<Matrices>,
    theta: f64,
    frame: Frame<Matrices>,
    factor: Factor,
    places: Places,
    reach: Reach,
    sweeps: Sweeps,
    b: Vec<f64>,
    delta: Vec<f64>,
    /// v + δ without contacts.
    free: Vec<f64>,
    /// Friction of each wall, N s, and what the holes did.
    friction: Vec<f64>,
    holes: Vec<HoleStep>,
    /// The angle by which the normal of each hole in play turns in the step, rad.
    turns: Vec<f64>,
    memory: Memory,
    pushes: Pushes,
    /// True if the extra force of the last step may not be 0.
    forced: bool,
}

impl Supports {
    /// `scene` by moreau-jean with this θ, in steps of `h` seconds that satisfy `contract`.
    pub fn new(scene: &Checked, theta: f64, contract: Contract, h: f64) -> Result<Self> {
        let mut body = Body::<Matrices>::new(scene, h)?;
        body.restart(0.0);
        let a = body.theta_matrix(theta);
        let mut factor = Matrices::factor(&a)?;
        let (points, rows) = contact_points(scene);
        let places = Places::new(body.n, &rows, &mut factor);
        let (walls, holes, contacts) = (scene.walls.len(), scene.holes().count(), points.len());
        let zero = || vec![0.0; body.n];
        Ok(Self {
            theta,
            frame: Frame::new(scene)?,
            factor,
            sweeps: Sweeps::new(a, &rows, contacts),
            b: zero(),
            delta: zero(),
            free: zero(),
            friction: vec![0.0; walls],
            holes: vec![HoleStep::default(); holes],
            turns: vec![0.0; holes],
            memory: Memory::new(walls, contacts, places.count()),
            pushes: Pushes::new(scene, contract),
            forced: false,
            places,
            reach: Reach::new(scene, theta, points),
            body,
        })
    }

    /// Lists the walls and holes in play, with their bounds.
    fn gather(&mut self) {
        let Self { body, frame, places, reach, sweeps, holes, turns, memory, pushes, .. } = self;
        let walls = body.walls.len();
        reach.look(frame, body.h);
        sweeps.touches.clear();
        for wall in 0..walls {
            sweeps.touches.extend(reach.wall(wall, (body, frame), places, memory.warm[wall]));
        }
        for hole in 0..reach.holes() {
            let index = walls + hole;
            let found = reach.hole((hole, index), (frame, body.h), places, memory.warm[index]);
            let Some((touch, met)) = found else { continue };
            holes[hole].normal = met.normal;
            turns[hole] = met.turn;
            let rates = &mut pushes.rates[index];
            (rates.struck, rates.before) = (met.arriving, met.arriving);
            if frame.blown {
                // Less what the blows give towards the hole.
                let [struck, before] = [frame.struck(), &frame.before].map(|v| places.pair(touch.rows, v));
                rates.before -= dot(met.normal, [struck[0] - before[0], struck[1] - before[1]]);
            }
            sweeps.touches.push(touch);
        }
    }

    /// Solves for δ and the impulses, and writes the impulses.
    fn settle(&mut self) {
        let Self { factor, delta, b, sweeps, places, frame, free, .. } = self;
        delta.copy_from_slice(b);
        factor.solve(delta);
        if sweeps.touches.is_empty() {
            return;
        }
        for (free, (v, d)) in free.iter_mut().zip(frame.v.iter().zip(&*delta)) {
            *free = v + d;
        }
        for (row, rate) in sweeps.free.iter_mut().enumerate() {
            *rate = places.seen(row, free);
        }
        if sweeps.solve(places) {
            places.lift(&sweeps.impulse, delta);
            self.book();
        }
    }

    /// Writes the impulses of the contacts that push.
    fn book(&mut self) {
        let (walls, h) = (self.body.walls.len(), self.body.h);
        for touch in &self.sweeps.touches {
            let [p, f] = touch.impulse;
            if p == 0.0 {
                continue;
            }
            if let Some(hole) = touch.index.checked_sub(walls) {
                self.holes[hole].impulse = p;
                self.holes[hole].friction = f;
                self.pushes.push(touch.index, p);
            } else {
                let signed = self.body.walls[touch.index].sign * p;
                self.frame.impulse[touch.index] = signed;
                self.frame.force[touch.index] = signed / h;
                self.frame.pushing.push(touch.index);
                self.friction[touch.index] = f;
                self.pushes.push(touch.index, signed);
            }
        }
    }

    /// Takes back all impulses of the step.
    fn let_go(&mut self) {
        self.frame.let_go();
        self.pushes.clear();
        self.sweeps.wedged.clear();
        self.friction.fill(0.0);
        for hole in &mut self.holes {
            (hole.impulse, hole.friction) = (0.0, 0.0);
        }
    }

    /// As in moreau-jean: solves again with the displacement that the blows cause in addition to
    /// the rule's, unless they drive the structure into a rigid wall or hole that pushes. Returns
    /// whether that displacement must be added.
    #[inline(never)]
    fn carry(&mut self) -> bool {
        let Self { body, frame, theta, .. } = self;
        if !body.find_blows(&[(frame.start, frame.end, frame.end - body.h * *theta)]) {
            return false;
        }
        let walls = body.walls.len();
        let driven = |(hole, point): (&HoleStep, &ContactPoint)| match body.blows.as_deref() {
            Some(blows) => hole.impulse > 0.0 && dot(hole.normal, self.places.pair(point.rows, &blows.given)) > 0.0,
            None => false,
        };
        if body.answers(&frame.pushing) || self.holes.iter().zip(&self.reach.points[walls..]).any(driven) {
            return false;
        }
        if self.body.damped {
            self.let_go();
            self.body.damp_shift(1.0, &mut self.b);
            self.settle();
        }
        true
    }

    /// Passes the step to the contact episodes.
    fn tell(&mut self) {
        let Self { frame, places, reach, body, holes, pushes, .. } = self;
        let rates = |index: usize, known: Rates| match index.checked_sub(body.walls.len()) {
            None => {
                let seen = |v: &Vec<f64>| body.seen(index, v);
                Rates { before: seen(&frame.before), struck: seen(frame.struck()), after: seen(&frame.after) }
            }
            Some(hole) => {
                let after = dot(holes[hole].normal, places.pair(reach.points[index].rows, &frame.after));
                Rates { after, ..known }
            }
        };
        pushes.tell(frame.start, body.h, rates);
    }
}

impl Motion for Supports {
    fn advance(&mut self, step: u64, extra: Option<&[f64]>) -> Result<()> {
        if extra.is_some() || self.forced {
            self.frame.force(extra);
            self.forced = extra.is_some();
        }
        let h = self.body.h;
        self.let_go();
        self.holes.fill(HoleStep::default());
        self.frame.begin(step, h);
        let Self { body, frame, b, .. } = self;
        body.theta_momentum(self.theta, frame, b);
        frame.blown = body.strike((frame.start, frame.end), 1.0, b, frame);
        self.gather();
        self.settle();
        let carried = self.body.blows.is_some() && self.carry();
        let Self { frame, theta, delta, .. } = self;
        for ((q, v), d) in frame.q.iter_mut().zip(&mut frame.v).zip(&*delta) {
            *q += h * (*v + *theta * d);
            *v += d;
        }
        frame.after.clone_from(&frame.v);
        if carried {
            self.body.shift(&mut self.frame.q);
        }
        self.frame.check(step)?;
        self.memory.keep(&self.sweeps.touches, &self.turns);
        self.tell();
        Ok(())
    }

    fn flush(&mut self, tiny: f64) {
        self.frame.flush(tiny, self.body.h, [None, None]);
    }

    fn step(&self, index: u64) -> Step<'_> {
        Step {
            friction: &self.friction,
            holes: &self.holes,
            wedged: &self.sweeps.wedged,
            resting: &self.reach.resting,
            ..self.frame.step(index, self.pushes.closed())
        }
    }

    fn restart(&mut self, _: &Scene, time: f64, q: &[f64], v: &[f64]) -> Result<()> {
        self.let_go();
        self.frame.restart(time, q, v);
        self.body.restart(time);
        self.holes.fill(HoleStep::default());
        self.pushes.forget();
        self.memory.forget();
        self.forced = false;
        Ok(())
    }

    fn end(&self) -> f64 {
        self.frame.end
    }

    fn state(&self) -> (&[f64], &[f64]) {
        (&self.frame.q, &self.frame.v)
    }

    fn open_contacts(&self) -> Vec<Contact> {
        self.pushes.still_open()
    }

    fn count(&self, counters: &mut Counters) {
        counters.qp_solves += self.sweeps.solves;
        counters.qp_unsettled = self.sweeps.unsettled;
        counters.wedged_steps = self.sweeps.gave_up;
        counters.frozen_steps = self.memory.frozen;
        counters.largest_turn_rad = self.memory.turned;
    }

    fn backend(&self) -> Option<Backend> {
        None
    }
}

#[cfg(test)]
mod tests;
