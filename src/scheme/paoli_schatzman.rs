//! `paoli-schatzman`: central differences with the restitution written into the bound.
//!
//! Paoli & Schatzman 2002, SIAM J. Numer. Anal. 40(2), doi:10.1137/S003614290037873X. With q⁺ = q +
//! Δ and q⁻ = q − h v₋,
//!
//! M(Δ/h − v₋)/h + C(Δ/h + v₋)/2 + K(¼q⁻ + ½q + ¼q⁺) = f(t) + r (blows: see
//! [`crate::step::Balance`])
//!
//! is the optimality condition A Δ = b + r of
//!
//! minimise ½ A Δ² − b Δ   subject to   (1+e_l)g_l − e_l q⁻ ≤ q⁺ ≤ (1+e_u)g_u − e_u q⁻,
//!
//! with A = M/h² + C/2h + K/4.
//!
//! The multiplier r is the force at t. The scheme carries the velocity between the grid's instants,
//! v₋ and v₊ = Δ/h; without walls it is the trapezoidal rule on the half steps, and conserves their
//! energy.
//!
//! Order 2 at e = 0, 1 at e > 0, where a wall is penetrated by up to 2ehv/(1+e).
//!
//! If e differs between walls whose rows are linearly dependent (two masses and their distance),
//! and one of them is penetrated, these bounds may contradict one another. With the same e for all
//! they never do, since q⁺ = (1+e)q_a − e q⁻ satisfies them for every admissible q_a: such a step
//! is made with the smallest e for all walls. Of two walls at one place the bound of the smaller e
//! is the tighter one and acts, where Moreau's law has the larger.

use super::Counters;
use super::body::Body;
use super::entry::{
    Coverage, NO_ENERGY_ON_A_CIRCLE, NO_LAW_OF_FRICTION, NO_LAW_OF_RINGS, Realised, SchemeEntry, SchemeKind,
};
use super::frame::{Frame, Stretch};
use super::programme::Programme;
use super::rule::Rule;
use super::space::{Space, zero};
use super::staggered::{Staggered, counted_blows};
use crate::error::{Error, Result};
use crate::linear::Symmetric;
use crate::qp::Backend;
use crate::scene::{Scene, WallSpring};
use crate::step::{Balance, Bound, Conserves, Contract, Law, Promise, Tolerances};

/// What is known of the scheme beside its rule.
pub(super) const ENTRY: SchemeEntry = SchemeEntry {
    name: "paoli-schatzman",
    settings: &[],
    default: "",
    kind: SchemeKind::Qp,
    restitution: Realised::PerWall,
    realises: "e, per wall",
    purpose: "impacts and lasting contact by positions; order 2 at restitution 0",
    order: Some(1),
    fails: "order 1 at e > 0; penetrates by up to 2ehv/(1+e)",
    round: Coverage::Refused(NO_ENERGY_ON_A_CIRCLE),
    elastic_round: Coverage::Refused(NO_LAW_OF_RINGS),
    friction: Coverage::Refused(NO_LAW_OF_FRICTION),
    elastic_round_friction: Coverage::Refused(NO_LAW_OF_FRICTION),
};

/// What every step satisfies.
pub(super) fn contract() -> Contract {
    let promise = Promise::constraints(Some(Bound::Reflected), None, Law::MeanDepth(0.25));
    let tolerances = Tolerances::of(Conserves::Nothing);
    Contract { balance: Balance::Staggered(0.25), promise, instant: 0.0, tolerances, divides: false }
}

#[derive(Debug)]
pub(super) struct PaoliSchatzman<S: Space> {
    body: Body<S>,
    staggered: Staggered<S>,
    /// Of each row: true if its rigid walls differ in e, so that their bounds could cross.
    unequal: Vec<bool>,
    /// The smallest e of all rigid walls, if they differ.
    least: Option<f64>,
    programme: Programme<S>,
    b: S::Vector,
    /// q − ¼h v₋, m.
    mean: S::Vector,
}

impl<S: Space> PaoliSchatzman<S> {
    pub fn new(scene: &Scene, h: f64, backend: Backend) -> Result<Self> {
        let body = Body::<S>::new(scene, h)?;
        let m = &body.matrices;
        let a = Symmetric::sum(&[(1.0 / (h * h), &m.mass), (0.5 / h, &m.damping), (0.25, &m.stiffness)]);
        let compliance = |spring: WallSpring| 1.0 / (0.25 * spring.stiffness + 0.5 * spring.damping / h);
        let programme = Programme::<S>::new(scene, a, scene.gap_scale(), compliance, backend)?;
        let differ = |row: usize| {
            let mut rigid = programme.walls(row).filter_map(|number| programme.wall(number).law.restitution());
            rigid.next().is_some_and(|first| rigid.any(|e| e != first))
        };
        let unequal = (0..programme.count_rows()).map(differ).collect();
        let rigid = || body.walls.iter().filter_map(|wall| wall.law.restitution());
        let (least, most) = (rigid().reduce(f64::min), rigid().reduce(f64::max));
        let least = if least == most { None } else { least };
        let (staggered, b, mean) = (Staggered::new(scene, &body)?, zero::<S>(body.n), zero::<S>(body.n));
        Ok(Self { body, staggered, unequal, least, programme, b, mean })
    }

    /// Solves for Δ and the walls' forces.
    #[inline]
    fn settle(&mut self, step: u64, frame: &mut Frame<S>) -> Result<()> {
        self.bind(frame, None);
        frame.stretch = Stretch::Grid;
        let at = (frame.start, step);
        let solved = self.programme.solve(&self.b, at, &mut frame.force, &mut frame.pushing);
        if let (Err(Error::Qp { .. }), Some(least)) = (&solved, self.least) {
            self.bind(frame, Some(least));
            frame.stretch = Stretch::OneRestitution;
            return self.programme.solve(&self.b, at, &mut frame.force, &mut frame.pushing);
        }
        solved
    }

    /// Sets the bounds of the rows, in Δ, with the restitution `one` for all rigid walls, or with
    /// each wall's own.
    #[inline]
    fn bind(&mut self, frame: &Frame<S>, one: Option<f64>) {
        let h = self.body.h;
        self.programme.free();
        for row in 0..self.programme.count_rows() {
            let (w, before) = (self.programme.seen(row, &frame.q), self.programme.seen(row, &frame.before));
            let struck = if frame.blown { self.programme.seen(row, &frame.struck) } else { before };
            let shared = if self.unequal[row] { self.shared_restitution(row, w - h * struck) } else { None };
            for number in self.programme.walls(row) {
                let wall = self.programme.wall(number);
                let bound = match wall.law.spring() {
                    Some(WallSpring { stiffness, damping }) => {
                        // |r| = k_a s̄ + c_a(s⁺ − s⁻₊)/2h, written in Δ.
                        let plate = wall.plate(w - h * before);
                        let offset = stiffness * (w - 0.25 * h * before - wall.g) + 0.5 * damping * (w - plate) / h;
                        -offset / (0.25 * stiffness + 0.5 * damping / h)
                    }
                    None => {
                        let e = one.or(shared).or(wall.law.restitution()).unwrap_or(0.0);
                        (1.0 + e) * (wall.g - w) + e * h * struck
                    }
                };
                self.programme.bind(row, number, bound);
            }
        }
    }

    /// The smallest e of the rigid walls of a row, if with its own e for each the bounds of a lower
    /// and an upper one would cross, `back` being w⁻.
    fn shared_restitution(&self, row: usize, back: f64) -> Option<f64> {
        let (mut lo, mut hi, mut least) = (f64::NEG_INFINITY, f64::INFINITY, 1.0_f64);
        for number in self.programme.walls(row) {
            let wall = self.programme.wall(number);
            let Some(e) = wall.law.restitution() else { continue };
            let bound = (1.0 + e) * wall.g - e * back;
            (lo, hi) = if wall.upper { (lo, hi.min(bound)) } else { (lo.max(bound), hi) };
            least = least.min(e);
        }
        (lo > hi).then_some(least)
    }

    /// The damper acts over the displacement by the blows, unless these drive the structure into a
    /// rigid wall that pushes, which shows only after the first solution: solves the step again if
    /// it does.
    #[inline(never)]
    fn damp_blows(&mut self, step: u64, frame: &mut Frame<S>) -> Result<()> {
        let h = self.body.h;
        if self.body.find_blows(&[counted_blows(step, h)]) && self.body.damped && !self.body.answers(&frame.pushing) {
            frame.take_back_impulses();
            self.body.damp_shift(1.0 / h, &mut self.b);
            self.settle(step, frame)?;
        }
        Ok(())
    }
}

impl<S: Space> Rule<S> for PaoliSchatzman<S> {
    fn restart(&mut self, scene: &Scene, time: f64, frame: &Frame<S>) -> Result<()> {
        self.staggered.restart(scene, &mut self.body, time, frame)
    }

    fn carried(&mut self) -> [Option<(&mut S::Vector, i32)>; 2] {
        [Some((&mut self.staggered.v, 1)), None]
    }

    fn advance(&mut self, step: u64, frame: &mut Frame<S>) -> Result<()> {
        let Self { body, staggered, b, mean, .. } = self;
        let h = body.h;
        staggered.begin(step, h, frame);
        body.applied(frame, b);
        for (mean, (q, v)) in mean.as_mut().iter_mut().zip(frame.q.as_ref().iter().zip(staggered.v.as_ref())) {
            *mean = q - 0.25 * h * v;
        }
        S::add_product(&body.mass, 1.0 / h, &staggered.v, b);
        S::add_product(&body.damping, -0.5, &staggered.v, b);
        S::add_product(&body.stiffness, -1.0, mean, b);
        // Blows come first: the bound refers to the velocity after them, and q⁻ in it is the
        // displacement from which that velocity would have led to q.
        frame.blown = body.strike_about(step, 1.0 / h, b, frame);
        self.settle(step, frame)?;
        if self.body.blows.is_some() {
            self.damp_blows(step, frame)?;
        }
        let Self { body, staggered, programme, .. } = self;
        for &wall in &frame.pushing {
            frame.impulse[wall] = h * frame.force[wall];
        }
        let moved = frame.q.as_mut().iter_mut().zip(staggered.v.as_mut());
        for ((q, v), d) in moved.zip(programme.x().as_ref()) {
            *q += d;
            *v = d / h;
        }
        staggered.finish(body, step, frame)
    }

    fn count(&self, counters: &mut Counters) {
        self.programme.count(counters);
    }

    fn backend(&self) -> Option<Backend> {
        Some(self.programme.backend())
    }
}
