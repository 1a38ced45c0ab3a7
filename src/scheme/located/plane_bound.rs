//! How a contact in two planes bounds the motion over a part of a step.
//!
//! Over a part of length s, contacts in which the body rests or slides give Σ Pᵀ(−p n + f t). A
//! flat wall bounds n·ẇ⁺. Along a round wall the impulse acts along the middle of the path,
//!
//! n ∥ w + w⁺,   n·ẇ⁺ ≤ −n·ẇ,
//!
//! so that (w⁺ + w)·(w⁺ − w) = 0: the body stays on the circle, and p does no work. A step of
//! implicit-euler takes n ∥ w⁺ and n·w⁺ ≤ γ instead.
//!
//! An elastic round wall pushes along n ∥ w_θ = (1 − θ)w + θw⁺ with the force of its spring and
//! dashpot there. Since n·w_θ = |w_θ|, that force is linear in n·ẇ⁺, as at a flat elastic wall. The
//! dashpot feels the rate along n: a difference of distances from the centre would be wrong by
//! ¼s|ẇ|²/γ where the body slides along the ring.

use super::super::supports::{CROSSING, FrictionContact, dot};
use crate::scene::WallSpring;

/// How a contact bounds the motion.
#[derive(Debug, Clone, Copy)]
pub(super) enum Guide {
    /// A flat wall: n, and the bound on n·ẇ⁺, m/s.
    Flat([f64; 2], f64),
    /// A round wall along which the body slides; what rounding has left behind it returns at
    /// `return_rate` (m/s).
    Chord { return_rate: f64 },
    /// A round wall of this gap (m) that is not passed at the end.
    End { gap: f64 },
    /// An elastic round wall.
    Ring(Ring),
}

/// Where the plate of a dashpot of an elastic round wall begins, m.
#[derive(Debug, Clone, Copy)]
pub(super) enum Plate {
    /// At this distance from the centre.
    Distance(f64),
    /// On the body, which it touches.
    Body,
}

/// The force of an elastic round wall over a part of a step.
#[derive(Debug, Clone, Copy)]
pub(super) struct Ring {
    pub spring: WallSpring,
    /// γ, m.
    pub gap: f64,
    /// Its dashpot's plate at the start.
    pub plate: Plate,
    /// θ of the part.
    pub theta: f64,
}

impl Ring {
    /// The bound on n·ẇ⁺ beyond which the ring pushes along `normal` over `length` seconds, for a
    /// body that starts at w = n·w and n·ẇ = `speed` (m/s).
    fn bound(&self, (w, speed): (f64, f64), length: f64) -> f64 {
        let st = self.theta * length;
        let plate = match self.plate {
            Plate::Distance(distance) => distance,
            Plate::Body => w,
        };
        speed - length * self.spring.force(w + st * speed, self.gap, plate, st) * self.compliance(length)
    }

    /// n·ẇ⁺ beyond the bound over the impulse, m/s per N s.
    pub fn compliance(&self, length: f64) -> f64 {
        self.spring.compliance(self.theta * length)
    }
}

/// The unit vector along `x`.
fn unit(x: [f64; 2]) -> [f64; 2] {
    let size = dot(x, x).sqrt();
    if size > 0.0 { x.map(|x| x / size) } else { [1.0, 0.0] }
}

/// A contact that bounds the motion over a part.
#[derive(Debug, Clone, Copy)]
pub(super) struct PlaneBound {
    pub wall: usize,
    pub rows: [usize; 2],
    pub guide: Guide,
    /// μ, that once it slides, and the compliance of an elastic wall, m/s per N s.
    pub friction: f64,
    pub kinetic: f64,
    pub compliance: f64,
    /// As [`FrictionContact::slides`].
    pub slides: f64,
    /// The sign of the wall's impulse.
    pub sign: f64,
    /// Displacement from the centre of a round wall, m, and rate of the place, m/s, at the start.
    pub from: [f64; 2],
    pub rate: [f64; 2],
    /// Acceleration of the place in the part before, m/s².
    pub acceleration: [f64; 2],
}

impl PlaneBound {
    /// n, if the place moves by `way` (m); the same for a flat wall always.
    pub fn normal(&self, way: [f64; 2]) -> [f64; 2] {
        let share = match self.guide {
            Guide::Flat(normal, _) => return normal,
            Guide::Chord { .. } => 0.5,
            Guide::End { .. } => 1.0,
            Guide::Ring(ring) => ring.theta,
        };
        unit([0, 1].map(|i: usize| self.from[i] + share * way[i]))
    }

    /// The bound on n·ẇ⁺ over a part of `length` seconds, along `normal`, m/s.
    pub fn bound(&self, normal: [f64; 2], length: f64) -> f64 {
        let (w, speed) = (dot(normal, self.from), dot(normal, self.rate));
        match self.guide {
            Guide::Flat(_, bound) => bound,
            Guide::Chord { return_rate } => -speed - return_rate,
            Guide::End { gap } => (gap - w) / length,
            Guide::Ring(ring) => ring.bound((w, speed), length),
        }
    }

    /// n if the place accelerates as in the part before.
    pub fn first_normal(&self, span: (f64, f64)) -> [f64; 2] {
        self.normal(self.way(self.acceleration.map(|a| span.0 * a), span))
    }

    /// The way of the place over a part of `length` seconds of the weight θ that changes its rate
    /// by `change` (m/s), m.
    pub fn way(&self, change: [f64; 2], (length, theta): (f64, f64)) -> [f64; 2] {
        [0, 1].map(|i: usize| length * (self.rate[i] + theta * change[i]))
    }

    /// True if a path of `way` (m) over `length` seconds ends outside of a round wall, or is one
    /// along which an elastic one pushes.
    pub fn is_passed(&self, way: [f64; 2], length: f64) -> bool {
        let limit = match self.guide {
            Guide::Flat(..) => return false,
            Guide::Chord { .. } => dot(self.from, self.from),
            Guide::End { gap } => gap * gap,
            Guide::Ring(ring) => {
                // A dashpot may push where the middle of the path is clear of the ring.
                let normal = self.normal(way);
                let rate = dot(normal, self.rate);
                return rate + (dot(normal, way) / length - rate) / ring.theta > self.bound(normal, length);
            }
        };
        let end = [0, 1].map(|i: usize| self.from[i] + way[i]);
        dot(end, end) > limit
    }

    /// What the answer of the contacts gave up of the bound along a round wall, m/s. Where impulses
    /// that balance one another contradict a rebound, contacts give it up; here it is no rebound,
    /// but what keeps the body on the circle.
    pub fn given_up(&self, touch: &FrictionContact) -> f64 {
        match self.guide {
            Guide::Chord { return_rate } => touch.bound + dot(touch.normal, self.rate) + return_rate,
            _ => 0.0,
        }
    }

    /// True if the middle of the path along a round wall says little of its normal.
    pub fn turns_far(&self, way: [f64; 2]) -> bool {
        let middle = [0, 1].map(|i: usize| self.from[i] + 0.5 * way[i]);
        matches!(self.guide, Guide::Chord { .. }) && dot(middle, middle) < CROSSING.powi(2) * dot(self.from, self.from)
    }
}
