//! `moreau-jean` on scenes with round holes or friction. [`super::moreau_jean`] steps all others.
//!
//! The step is that of moreau-jean: with v⁺ = v + δ, q⁺ = q + h(v + θδ) and A = M + hθC + h²θ²K,
//!
//! A δ = h[f_θ − C v − K(q + hθv)] + J − C d + Σ Pᵀ(−p n + f t),    t = (−n_z, n_y),
//!
//! over the walls and holes that q + ½h v reaches; P are the two rows of a place. The bound on n·ẇ⁺
//! is −ε ẇ at a flat, whose normal stays, and that of [`Turning`](crate::step::Turning) at a hole,
//! whose normal turns. Elastic walls yield as in moreau-jean. Friction follows Coulomb's law on the
//! impulses and the velocity at the end of the step ([`crate::step::Friction`]): with velocities at
//! θ in its place, a body that sticks would bounce along the surface.
//!
//! In the cross-section a contact has one tangent, so its law is piecewise linear and has an exact
//! answer ([`touch`]); sweeps over the contacts and one linear system answer all of them
//! ([`sweeps`]), on the 2 × 2 blocks of P A⁻¹ Pᵀ, which are constant.
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
mod normal;
mod places;
mod seats;
mod sweeps;
mod touch;

pub(super) use normal::{TURNING, meet, split};

use super::Counters;
use super::body::Body;
use super::frame::Frame;
use super::matrices::Matrices;
use super::motion::Motion;
use super::space::Space;
use crate::contact::{Episodes, Rates};
use crate::error::Result;
use crate::linear::Factor;
use crate::qp::Backend;
use crate::scene::{Checked, Scene, WallLaw};
use crate::step::{Contact, Contract, HoleStep, Step};
use normal::{AHEAD, dot};
use places::Places;
use seats::{Seat, seats};
use sweeps::Sweeps;
use touch::Touch;

/// Normals of flats at one place that are opposite to rounding.
const OPPOSITE: f64 = -1.0 + 1e-9;

/// A hole.
#[derive(Debug, Clone, Copy)]
struct Round {
    centre: [f64; 2],
    gap: f64,
    restitution: f64,
    /// Below this distance from the centre, squared, it is out of reach.
    clear: f64,
}

/// The motion of a scene with supports.
#[derive(Debug)]
pub(super) struct Supports {
    body: Body<Matrices>,
    theta: f64,
    frame: Frame<Matrices>,
    factor: Factor,
    places: Places,
    /// The walls, then the holes.
    seats: Vec<Seat>,
    rounds: Vec<Round>,
    sweeps: Sweeps,
    b: Vec<f64>,
    ahead: Vec<f64>,
    delta: Vec<f64>,
    /// v + δ without contacts.
    free: Vec<f64>,
    /// Friction of each wall, N s, and what the holes did.
    friction: Vec<f64>,
    holes: Vec<HoleStep>,
    /// The angle by which the normal of each hole in play turns in the step, rad.
    turns: Vec<f64>,
    /// Impulses p and f of each seat in the last step, N s, from which the next one starts.
    warm: Vec<[f64; 2]>,
    /// Normal of the last contact that pushed at each row's place in the last step, if any.
    last: Vec<Option<[f64; 2]>>,
    /// For the contact episodes: impulse and velocities of each seat, and the seats that push.
    pushes: Vec<f64>,
    rates: Vec<Rates>,
    pushing: Vec<usize>,
    episodes: Episodes,
    frozen: u64,
    turned: f64,
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
        let (seats, rows) = seats(scene);
        let places = Places::new(body.n, &rows, &mut factor);
        let round = |hole: crate::scene::Hole<'_>| Round {
            centre: hole.support.centre,
            gap: hole.gap,
            restitution: hole.restitution,
            clear: (hole.gap * (1.0 - 2.0 * TURNING.touching)).powi(2),
        };
        let rounds: Vec<Round> = scene.holes().map(round).collect();
        let still = Rates { before: 0.0, struck: 0.0, after: 0.0 };
        let zero = || vec![0.0; body.n];
        Ok(Self {
            theta,
            frame: Frame::new(scene)?,
            factor,
            sweeps: Sweeps::new(a, &rows, seats.len()),
            b: zero(),
            ahead: zero(),
            delta: zero(),
            free: zero(),
            friction: vec![0.0; scene.walls.len()],
            holes: vec![HoleStep::default(); rounds.len()],
            turns: vec![0.0; rounds.len()],
            warm: vec![[0.0; 2]; seats.len()],
            last: vec![None; places.count()],
            pushes: vec![0.0; seats.len()],
            rates: vec![still; seats.len()],
            pushing: Vec::with_capacity(seats.len()),
            episodes: Episodes::new(scene, scene.wall_masses(), contract),
            frozen: 0,
            turned: 0.0,
            forced: false,
            places,
            seats,
            rounds,
            body,
        })
    }

    /// Lists the walls and holes in play, with their bounds.
    fn gather(&mut self) {
        self.sweeps.touches.clear();
        for wall in 0..self.body.walls.len() {
            self.gather_wall(wall);
        }
        for hole in 0..self.rounds.len() {
            self.gather_hole(hole);
        }
    }

    fn gather_wall(&mut self, wall: usize) {
        let Self { body, frame, theta, seats, .. } = self;
        let (stop, seat, ht) = (body.walls[wall], seats[wall], body.h * *theta);
        let (bound, compliance) = match stop.law {
            WallLaw::Elastic { stiffness, damping } => {
                // As in moreau-jean: the row exceeds a bound on δ by compliance times impulse.
                let stiff = stiffness + damping / ht;
                let (w, before) = (body.seen(wall, &frame.q), body.seen(wall, &frame.v));
                let ahead = w + ht * before;
                let offset = body.h * (stiffness * (ahead - stop.g) + damping * (ahead - stop.plate(w)) / ht);
                let compliance = 1.0 / (ht * ht * stiff);
                (-stop.sign * (before - offset * compliance), compliance)
            }
            WallLaw::Rigid { restitution } if stop.depth(body.seen(wall, &self.ahead)) >= -body.touch => {
                let struck = body.seen(wall, frame.struck());
                let epsilon = if stop.sign * struck <= 0.0 { restitution } else { 1.0 };
                (stop.sign * epsilon * struck, 0.0)
            }
            _ => return,
        };
        let touch = Touch::new(
            &self.places,
            (wall, seat.rows),
            (seat.normal, bound),
            (seat.friction, compliance),
            self.warm[wall],
        );
        self.sweeps.touches.push(touch);
    }

    fn gather_hole(&mut self, hole: usize) {
        let (round, index) = (self.rounds[hole], self.body.walls.len() + hole);
        let seat = self.seats[index];
        let from = |q: &Vec<f64>| {
            let [y, z] = self.places.pair(seat.rows, q);
            [y - round.centre[0], z - round.centre[1]]
        };
        let ahead = from(&self.ahead);
        if dot(ahead, ahead) < round.clear {
            return;
        }
        let rate = self.places.pair(seat.rows, self.frame.struck());
        let Some(met) = meet((round.gap, round.restitution), from(&self.frame.q), rate, self.body.h) else { return };
        self.holes[hole].normal = met.normal;
        self.rates[index].struck = met.arriving;
        self.rates[index].before = met.arriving;
        if self.frame.blown {
            // Less what the blows give towards the hole.
            let before = self.places.pair(seat.rows, &self.frame.before);
            self.rates[index].before -= dot(met.normal, [rate[0] - before[0], rate[1] - before[1]]);
        }
        self.turns[hole] = met.turn;
        let touch = Touch::new(
            &self.places,
            (index, seat.rows),
            (met.normal, met.bound),
            (seat.friction, 0.0),
            self.warm[index],
        );
        self.sweeps.touches.push(touch);
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
            self.pushing.push(touch.index);
            if let Some(hole) = touch.index.checked_sub(walls) {
                self.holes[hole].impulse = p;
                self.holes[hole].friction = f;
                self.pushes[touch.index] = p;
            } else {
                let signed = self.body.walls[touch.index].sign * p;
                self.frame.impulse[touch.index] = signed;
                self.frame.force[touch.index] = signed / h;
                self.frame.pushing.push(touch.index);
                self.friction[touch.index] = f;
                self.pushes[touch.index] = signed;
            }
        }
    }

    /// Takes back all impulses of the step.
    fn let_go(&mut self) {
        self.frame.let_go();
        for &index in &self.pushing {
            self.pushes[index] = 0.0;
        }
        self.pushing.clear();
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
        let driven = |(hole, seen): (&HoleStep, &Seat)| match body.blows.as_deref() {
            Some(blows) => hole.impulse > 0.0 && dot(hole.normal, self.places.pair(seen.rows, &blows.given)) > 0.0,
            None => false,
        };
        if body.answers(&frame.pushing) || self.holes.iter().zip(&self.seats[walls..]).any(driven) {
            return false;
        }
        if self.body.damped {
            self.let_go();
            self.body.damp_shift(1.0, &mut self.b);
            self.settle();
        }
        true
    }

    /// What the next step needs of this one, and the counters.
    fn watch(&mut self) {
        let walls = self.body.walls.len();
        let mut frozen = false;
        for touch in self.sweeps.touches.iter().filter(|touch| touch.impulse[0] > 0.0) {
            if let Some(last) = self.last[touch.rows[0]] {
                frozen |= dot(last, touch.normal) < if touch.index < walls { OPPOSITE } else { 0.0 };
            }
            if let Some(hole) = touch.index.checked_sub(walls) {
                self.turned = self.turned.max(self.turns[hole]);
            }
        }
        self.frozen += u64::from(frozen);
        self.last.fill(None);
        self.warm.fill([0.0; 2]);
        for touch in self.sweeps.touches.iter().filter(|touch| touch.impulse[0] > 0.0) {
            self.warm[touch.index] = touch.impulse;
            if touch.compliance == 0.0 {
                self.last[touch.rows[0]] = Some(touch.normal);
            }
        }
    }

    /// Passes the step to the contact episodes.
    fn tell(&mut self) {
        let Self { frame, places, seats, rates, body, holes, .. } = self;
        for &index in &self.pushing {
            let rows = seats[index].rows;
            match index.checked_sub(body.walls.len()) {
                None => {
                    let seen = |v: &Vec<f64>| body.seen(index, v);
                    rates[index] =
                        Rates { before: seen(&frame.before), struck: seen(frame.struck()), after: seen(&frame.after) };
                }
                Some(hole) => rates[index].after = dot(holes[hole].normal, places.pair(rows, &frame.after)),
            }
        }
        self.episodes.see(frame.start, body.h, &self.pushes, &self.pushing, |index| rates[index]);
    }
}

impl Motion for Supports {
    fn advance(&mut self, step: u64, extra: Option<&[f64]>) -> Result<()> {
        if extra.is_some() || self.forced {
            match extra {
                Some(extra) => self.frame.extra.copy_from_slice(extra),
                None => self.frame.extra.fill(0.0),
            }
            self.forced = extra.is_some();
        }
        let h = self.body.h;
        self.let_go();
        self.holes.fill(HoleStep::default());
        self.frame.begin(step, h);
        let Self { body, frame, b, .. } = self;
        body.theta_momentum(self.theta, frame, b);
        frame.blown = body.strike((frame.start, frame.end), 1.0, b, frame);
        for (ahead, (q, v)) in self.ahead.iter_mut().zip(frame.q.iter().zip(frame.struck())) {
            *ahead = q + AHEAD * h * v;
        }
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
        self.watch();
        if !self.pushing.is_empty() || !self.episodes.idle() {
            self.tell();
        }
        Ok(())
    }

    fn step(&self, index: u64) -> Step<'_> {
        Step { friction: &self.friction, holes: &self.holes, ..self.frame.step(index, self.episodes.closed()) }
    }

    fn restart(&mut self, _: &Scene, time: f64, q: &[f64], v: &[f64]) -> Result<()> {
        self.let_go();
        self.frame.restart(time, q, v);
        self.body.restart(time);
        self.holes.fill(HoleStep::default());
        self.episodes.forget();
        self.last.fill(None);
        self.warm.fill([0.0; 2]);
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
        self.episodes.still_open()
    }

    fn count(&self, counters: &mut Counters) {
        counters.qp_solves += self.sweeps.solves;
        counters.qp_unsettled = self.sweeps.unsettled;
        counters.frozen_steps = self.frozen;
        counters.largest_turn_rad = self.turned;
    }

    fn backend(&self) -> Option<Backend> {
        None
    }
}
