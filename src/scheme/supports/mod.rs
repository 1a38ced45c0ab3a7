//! `moreau-jean` on scenes with round holes or friction. [`super::moreau_jean`] steps all others.
//!
//! The step is that of moreau-jean: with v⁺ = v + δ, q⁺ = q + h(v + θδ) and A = M + hθC + h²θ²K,
//!
//! A δ = h[f_θ − C v − K(q + hθv)] + J − C d + Σ Pᵀ(−p n + f t),    t = (−n_z, n_y),
//!
//! over the walls and holes that the step reaches; P are the two rows of a place. [`walls_in_play`]
//! has their bounds on n·ẇ⁺. Friction follows Coulomb's law on the impulses and the velocity at the
//! end of the step ([`crate::step::Friction`]): with velocities at θ in its place, a body that
//! sticks would bounce along the surface. Whether the static or the kinetic coefficient applies
//! follows from what the contact did in the step before, and from the answer
//! ([`friction_contact`]).
//!
//! In the cross-section a contact has one tangent, so its law is piecewise linear and has an exact
//! answer ([`friction_contact`]); sweeps over the contacts and one linear system answer all of
//! them, or a pivoting method ([`friction_contacts`]), on the 2 × 2 blocks of P A⁻¹ Pᵀ, which are
//! constant. Where no answer has the rebounds that the contacts demand, they give these up for the
//! step.
//!
//! Order 1 through impacts, 2 while sliding with θ = ½. Without friction a step never adds energy.
//! With friction it might where W couples normal and tangent and e > 0 (Kane & Levinson 1985,
//! Dynamics: Theory and Applications): there, too, the contacts give up their rebounds. Where a
//! step does not resolve a mode, hω ≥ 2, the sliding velocity may turn in every step, and friction,
//! of one sign over the step, may add energy (½ p_t t·ẇ⁻) until the run diverges. If h v
//! exceeds the gap, the body stands still between opposite sides of a hole: such steps are counted,
//! and so is the largest angle by which a normal turned.
//!
//! `view.rs` has the motion as the stepper drives it.
//!
//! `located` steps such scenes with order 2 ([`super::located`]). Why others do not: the bound of
//! paoli-schatzman, |w⁺ + e w⁻| ≤ (1+e)γ, does not keep energy on a circle (with e = 1, over a way
//! of 200 gaps, it lost 95 % to gained 60 % at h v = γ/10), and newmark does not keep it on any
//! wall.

mod contact_rows;
mod corner;
mod friction_contact;
mod friction_contacts;
mod last_step;
mod linear;
mod normal;
mod points;
mod view;
mod walls_in_play;

pub(super) use contact_rows::ContactRows;
pub(super) use friction_contact::FrictionContact;
pub(super) use friction_contacts::FrictionContacts;
pub(super) use normal::{CROSSING, TURNING, closed_hole_state, dot, hole_state};
pub(super) use points::{ContactPoint, contact_points};

use super::body::Body;
use super::frame::Frame;
use super::matrices::Matrices;
use super::space::Space;
use crate::contact::{Episodes, Rates};
use crate::error::Result;
use crate::linear::{Factor, Lanes, Pass, pass, update};
use crate::scene::{Checked, Wall};
use crate::step::Contract;
use last_step::LastStep;
use normal::HoleState;
use pulp::Simd;
use walls_in_play::WallsInPlay;

/// The motion of a scene with supports.
#[derive(Debug)]
pub(super) struct Supports {
    body: Body<Matrices>,
    theta: f64,
    frame: Frame<Matrices>,
    factor: Factor,
    places: ContactRows,
    reach: WallsInPlay,
    sweeps: FrictionContacts,
    b: Vec<f64>,
    delta: Vec<f64>,
    /// v + δ without contacts.
    free: Vec<f64>,
    /// What is known of the holes in play before the step is solved, one entry a contact.
    met: Vec<Option<HoleState>>,
    /// What the blows of the step give towards each hole in play, m/s, one entry a contact.
    given: Vec<f64>,
    memory: LastStep,
    episodes: Episodes,
    /// The vector instructions of the machine.
    arch: pulp::Arch,
}

impl Supports {
    /// `scene` by moreau-jean with this θ, in steps of `h` seconds that satisfy `contract`.
    pub fn new(scene: &Checked, theta: f64, contract: Contract, h: f64) -> Result<Self> {
        let mut body = Body::<Matrices>::new(scene, h)?;
        body.restart(0.0);
        let a = body.theta_matrix(theta);
        let mut factor = Matrices::factor(&a)?;
        let (points, rows) = contact_points(scene);
        let places = ContactRows::new(body.n, &rows, &mut factor);
        let contacts = points.len();
        let zero = || vec![0.0; body.n];
        let round = scene.walls.iter().map(Wall::is_round).collect();
        let mut memory = LastStep::new(round, scene.snug(), places.count());
        memory.begin(scene, &scene.initial.q, &scene.initial.v);
        Ok(Self {
            theta,
            frame: Frame::new(scene)?,
            factor,
            sweeps: FrictionContacts::new(a, &rows, contacts),
            b: zero(),
            delta: zero(),
            free: zero(),
            met: vec![None; contacts],
            given: vec![0.0; contacts],
            memory,
            episodes: Episodes::new(scene, scene.wall_masses(), contract),
            arch: pulp::Arch::new(),
            places,
            reach: WallsInPlay::new(scene, theta, points),
            body,
        })
    }

    /// Lists the walls and holes in play, with their bounds.
    #[inline(always)]
    fn gather(&mut self) {
        let Self { body, frame, places, reach, sweeps, met, given, memory, .. } = self;
        reach.set_reach(frame, body.h);
        sweeps.touches.clear();
        for index in 0..body.walls.len() {
            let did = memory.did[index];
            if !reach.is_round(index) {
                let last = (memory.pushes[index], did);
                sweeps.touches.extend(reach.wall(index, (body, frame), places, last));
                continue;
            }
            let found = reach.hole(index, (frame, body.h), places, (memory.turns[index], did));
            met[index] = found.map(|(_, met)| met);
            let Some((touch, met)) = found else { continue };
            frame.normal[index] = met.normal;
            given[index] = 0.0;
            if frame.blown {
                let [struck, before] = [frame.struck(), &frame.before].map(|v| places.pair(touch.rows, v));
                given[index] = dot(met.normal, [struck[0] - before[0], struck[1] - before[1]]);
            }
            sweeps.touches.push(touch);
        }
    }

    /// Solves for δ and the impulses, and writes the impulses.
    #[inline(always)]
    fn settle(&mut self) {
        let Self { factor, delta, b, sweeps, places, frame, free, .. } = self;
        delta.copy_from_slice(b);
        factor.solve(delta);
        if sweeps.touches.is_empty() {
            return;
        }
        update(free, [&frame.v, delta], |_, [v, d]| v + d);
        for (row, rate) in sweeps.free.iter_mut().enumerate() {
            *rate = places.seen(row, free);
            sweeps.before[row] = places.seen(row, frame.struck());
        }
        if sweeps.strike(places) {
            places.lift(&sweeps.impulse, delta);
            self.book();
        }
    }

    /// Writes the impulses of the contacts that push.
    fn book(&mut self) {
        let h = self.body.h;
        for touch in &self.sweeps.touches {
            let [p, f] = touch.impulse;
            if p == 0.0 {
                continue;
            }
            let sign = if self.reach.is_round(touch.index) { 1.0 } else { self.body.walls[touch.index].sign };
            self.frame.push(touch.index, sign * p, h);
            self.frame.friction[touch.index] = f;
        }
    }

    /// Takes back all impulses of the step.
    fn take_back_impulses(&mut self) {
        self.frame.take_back_impulses();
        self.sweeps.wedged.clear();
    }

    /// As in moreau-jean: solves again with the displacement that the blows cause in addition to
    /// the rule's, unless they drive the structure into a rigid wall or hole that pushes. Returns
    /// whether that displacement must be added.
    #[inline(never)]
    fn solve_with_blows(&mut self) -> bool {
        let Self { body, frame, theta, .. } = self;
        if !body.find_blows(&[(frame.start, frame.end, frame.end - body.h * *theta)]) {
            return false;
        }
        let driven = |&index: &usize| match (body.blows.as_deref(), self.reach.is_round(index)) {
            (Some(_), false) => body.drives(index),
            (Some(blows), true) => {
                let given = self.places.pair(self.reach.points[index].rows, &blows.given);
                dot(frame.normal[index], given) > 0.0
            }
            (None, _) => false,
        };
        if frame.pushing.iter().any(driven) {
            return false;
        }
        if self.body.damped {
            self.take_back_impulses();
            self.body.damp_shift(1.0, &mut self.b);
            self.settle();
        }
        true
    }

    /// Passes the step to the contact episodes.
    #[inline(never)]
    fn record_episodes(&mut self) {
        let Self { frame, places, reach, body, met, given, episodes, .. } = self;
        episodes.observe(frame.start, body.h, &frame.impulse, &frame.pushing, |index| match met[index] {
            None => {
                let seen = |v: &Vec<f64>| body.seen(index, v);
                Rates { before: seen(&frame.before), struck: seen(frame.struck()), after: seen(&frame.after) }
            }
            Some(HoleState { normal, arriving, .. }) => {
                let after = dot(normal, places.pair(reach.points[index].rows, &frame.after));
                Rates { before: arriving - given[index], struck: arriving, after }
            }
        });
    }

    /// Makes step number `step` under the extra force.
    #[inline(always)]
    fn make<S: Simd>(&mut self, simd: S, step: u64, extra: Option<&[f64]>) -> Result<()> {
        self.frame.force(extra);
        let h = self.body.h;
        self.take_back_impulses();
        self.frame.normal.fill([0.0; 2]);
        self.frame.begin(step, h);
        let Self { body, frame, b, .. } = self;
        body.theta_momentum(self.theta, frame, b);
        frame.blown = body.strike((frame.start, frame.end), 1.0, b, frame);
        self.gather();
        self.settle();
        let carried = self.body.blows.is_some() && self.solve_with_blows();
        let Frame { q, v, after, .. } = &mut self.frame;
        let end = ([&self.delta[..]], [&mut q[..], v, after]);
        let [] = pass(simd, self.body.n, end, &AddChange { h, theta: self.theta });
        if carried {
            self.body.shift(&mut self.frame.q);
        }
        self.frame.check(step)?;
        let met = &self.met;
        self.memory.keep(&self.sweeps.touches, |index| met[index].map_or(0.0, |met| met.turned));
        if !(self.frame.pushing.is_empty() && self.episodes.idle()) {
            self.record_episodes();
        }
        Ok(())
    }
}

/// From the change of velocity δ in a step of h seconds: q⁺ = q + h(v + θδ), v⁺ = v + δ, and v⁺
/// once more.
struct AddChange {
    h: f64,
    theta: f64,
}

impl Pass<1, 3, 0> for AddChange {
    #[inline(always)]
    fn of<S: Simd>(
        &self,
        [change]: [Lanes<S>; 1],
        [q, v, _]: [Lanes<S>; 3],
        _: [Lanes<S>; 0],
    ) -> ([Lanes<S>; 3], [Lanes<S>; 0]) {
        let after = v + change;
        ([q + (v + change * self.theta) * self.h, after, after], [])
    }
}

#[cfg(test)]
mod tests;
