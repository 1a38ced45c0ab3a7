//! `implicit-euler` (θ = 1) and `newmark` (β = ¼, γ = ½, that is θ = ½): the wall as a bound on the
//! displacement at t⁺.
//!
//! With q⁺ = q + Δ, v⁺ = (Δ/h − (1−θ)v)/θ and F = f − C v − K q, the balance
//!
//! M(v⁺ − v) = h[(1−θ)(F + r) + θ(F⁺ + r⁺)] + J − C d
//!
//! with J the load impulses in the step and d the displacement that they cause in addition to the
//! rule's (see [`crate::step::Balance`]), is, divided by hθ, the optimality condition A Δ = b + r⁺
//! of
//!
//! minimise ½ A Δ² − b Δ   subject to   g_l ≤ q + Δ ≤ g_u,    A = M/(hθ)² + C/(hθ) + K.
//!
//! θ = ½ is Newmark's average-acceleration rule (Newmark 1959, J. Eng. Mech. Div. ASCE 85(3)) with
//! the constraint at t⁺: the restitution comes out between 1/3 and 3, depending on where in the
//! step the impact falls, and energy is gained. It is here for demonstration. θ = 1 gives e = 0,
//! whatever the wall's restitution. Order 1; it damps, and the force of an impact grows like 1/h.

use super::Counters;
use super::body::Body;
use super::entry::{
    Coverage, NO_ENERGY_ON_A_CIRCLE, NO_LAW_OF_FRICTION, NO_LAW_OF_RINGS, NO_SPEED_TO_STICK_AT, Realised, SchemeEntry,
    SchemeKind,
};
use super::frame::Frame;
use super::programme::Programme;
use super::rule::Rule;
use super::space::{Space, zero};
use super::start::StartForce;
use crate::error::Result;
use crate::linear::Symmetric;
use crate::qp::Backend;
use crate::scene::{Scene, Wall};
use crate::step::{Balance, Bound, Conserves, Contract, Law, Promise, PromisedForce, Tolerances};

/// What is known of θ = 1 beside its rule.
pub(super) const IMPLICIT_EULER: SchemeEntry = SchemeEntry {
    name: "implicit-euler",
    settings: &[],
    default: "",
    kind: SchemeKind::Qp,
    restitution: Realised::Zero,
    realises: "0, whatever the case asks for",
    purpose: "plastic impacts (restitution 0)",
    order: Some(1),
    fails: "order 1; damps, also what slides round a hole; force of an impact ∝ 1/h",
    round: Coverage::Stepped(
        "puts the body within the circle, stops what arrives, whatever the restitution, and slows what slides",
    ),
    elastic_round: Coverage::Stepped("presses with the force of the ring at the step's end"),
    friction: Coverage::Refused(NO_SPEED_TO_STICK_AT),
    elastic_round_friction: Coverage::Refused(NO_SPEED_TO_STICK_AT),
};

/// What is known of θ = ½ beside its rule.
pub(super) const NEWMARK: SchemeEntry = SchemeEntry {
    name: "newmark",
    settings: &[],
    default: "",
    kind: SchemeKind::Qp,
    restitution: Realised::ByChance,
    realises: "between 1/3 and 3, by chance",
    purpose: "a demonstration: what happens without care at the walls",
    order: Some(1),
    fails: "**gains energy**",
    round: Coverage::Refused(NO_ENERGY_ON_A_CIRCLE),
    elastic_round: Coverage::Refused(NO_LAW_OF_RINGS),
    friction: Coverage::Refused(NO_LAW_OF_FRICTION),
    elastic_round_friction: Coverage::Refused(NO_LAW_OF_FRICTION),
};

/// What every step with this θ satisfies: walls on the displacement at its end, by the force there.
pub(super) const fn contract(theta: f64) -> Contract {
    let mut promise = Promise::constraints(Some(Bound::End), None, Law::Depth(1.0));
    (promise.rigid.force, promise.elastic.force) = (PromisedForce::End, PromisedForce::End);
    promise.hole = Some(Bound::End);
    let tolerances = Tolerances::of(Conserves::Nothing);
    Contract { balance: Balance::Theta(theta), promise, instant: 1.0, tolerances, divides: false }
}

#[derive(Debug)]
pub(super) struct Position<S: Space> {
    body: Body<S>,
    theta: f64,
    /// F + Gᵀ r at the step's start, N; kept where θ < 1 only.
    force: S::Vector,
    /// r of each wall at the step's start, N, and the walls where it is not zero.
    held: Vec<f64>,
    holding: Vec<usize>,
    /// Σ of the squared entries of each wall's row.
    weights: Vec<f64>,
    programme: Programme<S>,
    b: S::Vector,
}

impl<S: Space> Position<S> {
    pub fn new(scene: &Scene, theta: f64, h: f64, backend: Backend) -> Result<Self> {
        let body = Body::<S>::new(scene, h)?;
        let (ht, m) = (h * theta, &body.matrices);
        let a = Symmetric::sum(&[(1.0 / (ht * ht), &m.mass), (1.0 / ht, &m.damping), (1.0, &m.stiffness)]);
        let programme = Programme::new(scene, a, scene.gap_scale(), |spring| 1.0 / spring.stiffness_over(h), backend)?;
        let (n, walls) = (body.n, body.walls.len());
        let (held, holding) = (vec![0.0; walls], Vec::with_capacity(walls));
        let square = |wall: &Wall| wall.row().entries().iter().map(|entry| entry.1 * entry.1).sum();
        let weights = scene.walls.iter().map(square).collect();
        Ok(Self { body, theta, force: zero::<S>(n), held, holding, weights, programme, b: zero::<S>(n) })
    }

    /// Sets the bounds of the rows, in Δ. Those of rigid walls apply to the displacement with that
    /// by the blows.
    #[inline]
    fn bind(&mut self, frame: &Frame<S>, blown: bool) {
        let (body, programme) = (&self.body, &mut self.programme);
        programme.free();
        for row in 0..programme.count_rows() {
            let w = programme.seen(row, &frame.q);
            let shift = match &body.blows {
                Some(blows) if blown => programme.seen(row, &blows.shift),
                _ => 0.0,
            };
            for number in programme.walls(row) {
                let wall = programme.wall(number);
                let bound = match wall.law.spring() {
                    // |r| = k_a s⁺ + c_a(s⁺ − s₊)/h, written in Δ.
                    Some(spring) => -spring.force(w, wall.g, wall.plate(w), body.h) / spring.stiffness_over(body.h),
                    None => wall.g - w - shift,
                };
                programme.bind(row, number, bound);
            }
        }
    }

    /// Puts a body that a rigid wall stops exactly at the wall: w + (g − w) may differ from g in
    /// the last bit. For one degree of freedom only: with several rows, correcting one would move
    /// the others.
    #[inline(never)]
    fn place(&self, frame: &mut Frame<S>) {
        let depth =
            |wall: usize| self.body.walls[wall].depth(self.body.seen(wall, &frame.q)) / self.weights[wall].sqrt();
        // Walls that stand apart by less than the rounding of a far motion push together: the body
        // stands at the foremost of them.
        let pushing = frame.pushing.iter().copied().filter(|&wall| self.body.walls[wall].law.is_rigid());
        if let Some(wall) = pushing.max_by(|&a, &b| depth(a).total_cmp(&depth(b))) {
            let missed = self.body.walls[wall].g - self.body.seen(wall, &frame.q);
            S::add_transposed(&self.body.rows, wall, missed / self.weights[wall], &mut frame.q);
        }
    }

    /// Writes the impulses p = h[(1−θ) r + θ r⁺] of the walls that push at either end of the step.
    #[inline(never)]
    fn average(&mut self, frame: &mut Frame<S>) {
        let (h, theta) = (self.body.h, self.theta);
        let now = frame.pushing.len();
        for wall in self.holding.drain(..) {
            let p = h * (1.0 - theta) * self.held[wall];
            self.held[wall] = 0.0;
            frame.impulse[wall] = p;
            if p != 0.0 && frame.force[wall] == 0.0 {
                frame.pushing.push(wall);
            }
        }
        for &wall in &frame.pushing[..now] {
            frame.impulse[wall] += h * theta * frame.force[wall];
            self.held[wall] = frame.force[wall];
            self.holding.push(wall);
        }
    }
}

impl<S: Space> Rule<S> for Position<S> {
    fn restart(&mut self, scene: &Scene, time: f64, frame: &Frame<S>) -> Result<()> {
        self.body.restart(time);
        let StartForce { total, wall } = StartForce::new(scene, &self.body, &frame.q, &frame.v)?;
        self.holding.clear();
        self.holding.extend((0..wall.len()).filter(|&index| wall[index] != 0.0));
        (self.force, self.held) = (total, wall);
        Ok(())
    }

    fn carried(&mut self) -> [Option<(&mut S::Vector, i32)>; 2] {
        // With θ = 1 the force at the start of a step does not enter it, and is not kept.
        [(self.theta < 1.0).then_some((&mut self.force, 2)), None]
    }

    fn advance(&mut self, step: u64, frame: &mut Frame<S>) -> Result<()> {
        let Self { body, theta, force, b, .. } = self;
        let (h, theta) = (body.h, *theta);
        let (ht, rest) = (h * theta, (1.0 - theta) / theta);
        frame.begin(step, h);
        body.load_at(frame.end);
        // The extra force is constant over the step: it enters F as well as F⁺.
        let forces = force.as_ref().iter().zip(body.load.as_ref()).zip(frame.extra.as_ref());
        for (b, ((force, load), extra)) in b.as_mut().iter_mut().zip(forces) {
            *b = rest * (force + extra) + load + extra;
        }
        S::add_product(&body.mass, 1.0 / (ht * theta), &frame.v, b);
        if rest != 0.0 {
            S::add_product(&body.damping, rest, &frame.v, b);
        }
        S::add_product(&body.stiffness, -1.0, &frame.q, b);
        frame.before.clone_from(&frame.v);
        frame.blown = body.strike((frame.start, frame.end), 1.0 / ht, b, frame);
        // The damper also acts over the displacement that the blows cause.
        let blown = body.find_blows(&[(frame.start, frame.end, frame.end - ht)]);
        if blown {
            body.damp_shift(1.0 / ht, b);
        }
        self.bind(frame, blown);
        self.programme.solve(&self.b, (frame.start, step), &mut frame.force, &mut frame.pushing)?;
        for ((q, v), d) in frame.q.as_mut().iter_mut().zip(frame.v.as_mut()).zip(self.programme.x().as_ref()) {
            *q += d;
            *v = (d / h - (1.0 - theta) * *v) / theta;
        }
        if blown {
            self.body.shift(&mut frame.q);
        }
        frame.after.clone_from(&frame.v);
        if self.body.n == 1 && !frame.pushing.is_empty() {
            self.place(frame);
        }
        if !frame.pushing.is_empty() || !self.holding.is_empty() {
            self.average(frame);
        }
        if rest != 0.0 {
            let Self { body, force, .. } = self;
            force.clone_from(&body.load);
            S::add_product(&body.damping, -1.0, &frame.v, force);
            S::add_product(&body.stiffness, -1.0, &frame.q, force);
            for &wall in &frame.pushing {
                S::add_transposed(&body.rows, wall, frame.force[wall], force);
            }
        }
        Ok(())
    }

    fn count(&self, counters: &mut Counters) {
        self.programme.count(counters);
    }

    fn backend(&self) -> Option<Backend> {
        Some(self.programme.backend())
    }
}
