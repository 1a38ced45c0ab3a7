//! One degree of freedom: the derivative over each step.

use super::no_derivative::NoDerivative;
use super::saltation::{self, IDENTITY, Matrix2, REST};
use crate::error::{Error, Result};
use crate::flow::Arc;
use crate::scene::{Oscillator, Scene, System};
use crate::step::{Path, Step};

/// A body nearer to the face of an elastic wall than this share of the scene's gap scale counts as
/// on it. The value lies far above rounding, and far below the depth at which a push ends.
pub(super) const ON_THE_FACE: f64 = 1e-9;

/// An elastic wall with a dashpot.
#[derive(Debug, Clone, Copy)]
struct Dashpot {
    wall: usize,
    /// The sign of its force.
    sign: f64,
    position: f64,
    damping: f64,
    /// True if it pushes after the last event.
    touches: bool,
}

/// The derivative of the state at the end of a step with respect to that at its start, for one
/// degree of freedom between walls that stand on it directly, along a run of the scheme `event`.
///
/// The steps must be seen in turn: whether an elastic wall is entered shows in two of them. It
/// allocates nothing.
///
/// Once a body rests on a rigid wall, its motion does not depend on that before: the matrix is 0
/// then, as is every product with it. A touch at speed 0 (a graze) is ignored; near one the matrix
/// grows without bound.
#[derive(Debug, Clone)]
pub struct OscillatorVariation {
    body: Oscillator,
    /// e of each wall; `None` for an elastic one.
    restitution: Vec<Option<f64>>,
    dashpots: Vec<Dashpot>,
    /// A typical displacement, m.
    length: f64,
    /// True once a step has been seen.
    began: bool,
}

impl OscillatorVariation {
    /// The derivative along runs of `scene`.
    ///
    /// # Errors
    /// [`Error::Invalid`] for a scene of several degrees of freedom, or with a wall behind a lever:
    /// [`Variation`](super::Variation) takes those too.
    pub fn new(scene: &Scene) -> Result<Self> {
        let (System::Oscillator(body), true) = (&scene.system, scene.is_line()) else {
            return Err(Error::invalid(
                "system",
                "a structure",
                "one degree of freedom, with its walls on it directly",
            ));
        };
        let dashpots = scene.walls.iter().enumerate().filter_map(|(wall, w)| {
            let damping = w.law.dashpot(0.0);
            let at_rest = Dashpot { wall, sign: w.side().sign(), position: w.position(), damping, touches: false };
            (damping > 0.0).then_some(at_rest)
        });
        Ok(Self {
            body: *body,
            restitution: scene.walls.iter().map(|wall| wall.law.restitution()).collect(),
            dashpots: dashpots.collect(),
            length: scene.gap_scale(),
            began: false,
        })
    }

    /// ∂(q, q̇ at the end)/∂(q, q̇ at the start) of `step`, the event at its end included.
    ///
    /// # Errors
    /// [`NoDerivative::Unresolved`] for a step of another scheme.
    pub fn over(&mut self, step: &Step<'_>) -> std::result::Result<Matrix2, NoDerivative> {
        let Path::Exact(arc) = step.path else { return Err(NoDerivative::Unresolved { time: step.end }) };
        let mut whole = self.entered_between(arc);
        whole = saltation::multiply(arc.propagator(), whole);
        let event = match step.jump.iter().position(|&p| p != 0.0) {
            Some(wall) => self.impact(step, arc, wall),
            None => self.entered_now(step, arc),
        };
        for d in &mut self.dashpots {
            d.touches = force(step, d.wall) != 0.0;
        }
        self.began = true;
        Ok(saltation::multiply(event, whole))
    }

    /// Walls that began to push at the end of the last step, which only the present step shows.
    fn entered_between(&self, arc: &Arc) -> Matrix2 {
        let mut whole = IDENTITY;
        if self.dashpots.is_empty() || !self.began {
            return whole;
        }
        let state = arc.state(arc.start());
        for d in &self.dashpots {
            if !d.touches && arc.touches_wall(d.wall) && d.is_entered(state, self.length) {
                whole = saltation::multiply(saltation::entry(d.damping, self.body.mass), whole);
            }
        }
        whole
    }

    /// Walls that begin to push at the end of the step.
    fn entered_now(&self, step: &Step<'_>, arc: &Arc) -> Matrix2 {
        let mut whole = IDENTITY;
        for d in &self.dashpots {
            let begins = force(step, d.wall) != 0.0 && !arc.touches_wall(d.wall);
            if begins && d.is_entered(arc.state(arc.end()), self.length) {
                whole = saltation::multiply(saltation::entry(d.damping, self.body.mass), whole);
            }
        }
        whole
    }

    fn impact(&self, step: &Step<'_>, arc: &Arc, wall: usize) -> Matrix2 {
        let after = step.v.first().copied().unwrap_or(0.0);
        let e = self.restitution.get(wall).copied().flatten().unwrap_or(0.0);
        // A body that has lost its velocity rests if it is pressed, or if the rest of an
        // accumulation has been cut off.
        if after == 0.0 && (e > 0.0 || force(step, wall) != 0.0) {
            return REST;
        }
        // The approach velocity of the scheme itself, to the last digit: near a graze the closed
        // form has lost digits.
        let before = if e > 0.0 { -after / e } else { arc.state(arc.end()).1 };
        // The load is the same on both sides of the instant: only the velocity changes the force,
        // and a jump of the velocity may begin or end the push of a dashpot.
        let mut change = self.body.damping * (before - after);
        for d in &self.dashpots {
            change += match (arc.touches_wall(d.wall), force(step, d.wall)) {
                (true, force) if force != 0.0 => d.damping * (before - after),
                (true, _) => -arc.contact_force(d.wall, arc.end()),
                (false, force) => force,
            };
        }
        let acceleration = arc.acceleration(arc.end());
        saltation::impact(e, before, [acceleration, acceleration + change / self.body.mass])
    }
}

impl Dashpot {
    /// True for a body on the face (m, m/s) that moves into the wall: a push that begins elsewhere
    /// begins with a force of 0.
    fn is_entered(&self, (q, v): (f64, f64), length: f64) -> bool {
        -self.sign * v > 0.0 && (q - self.position).abs() <= ON_THE_FACE * length
    }
}

/// The force of a wall just after the step, N, signed.
fn force(step: &Step<'_>, wall: usize) -> f64 {
    step.force.get(wall).copied().unwrap_or(0.0)
}
