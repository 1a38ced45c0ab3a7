//! One time step as data: what a scheme passes to the recorder and the judge.
//!
//! # Files
//!
//! `Step` and `Contact`, and what a scheme promises of every step, as data: its `Contract`
//! (`contract.rs`), with the conditions at the walls (`promise.rs`); all that the recorder and the
//! judge know of schemes; `between.rs` is the motion between the ends of a step; `load_jumps.rs` is
//! the force that makes up for a jump of a load within a step; `last_impacts.rs` tells where
//! impacts at a wall accumulate; `quiet_steps.rs` keeps steps of one degree of freedom between two
//! contacts, which both look at together.

mod between;
mod contract;
mod last_impacts;
mod load_jumps;
mod promise;
mod quiet_steps;

pub use contract::{Balance, Conserves, Contract, Tolerance, Tolerances};
pub(crate) use last_impacts::LastImpacts;
pub(crate) use load_jumps::LoadJumps;
pub use promise::{Bound, Circle, Elastic, Friction, Law, Normal, Promise, PromisedForce, Reached, Rigid, Turning};
pub(crate) use quiet_steps::QuietSteps;

use crate::flow::{Arc, Series};
use serde::{Deserialize, Serialize};

/// One episode of contact at one wall.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct Contact {
    /// Index of the wall in the scene ([`Scene::wall_name`](crate::Scene::wall_name)).
    pub wall: usize,
    /// Time at which it began, s.
    pub start: f64,
    /// Time at which it ended, s: equal to `start` for an instantaneous impact; `None` if still
    /// open at the end of the run.
    pub end: Option<f64>,
    /// Impulse of the wall on the body over the episode, N s; signed as the force (lower ≥ 0, upper
    /// ≤ 0). Of a round support the sum of the magnitudes along its normals, ≥ 0.
    pub impulse: f64,
    /// Largest |force| in the episode, N, without friction; `None` where the force was not finite
    /// (an impact).
    pub peak_force: Option<f64>,
    /// Speed towards the wall just before, m/s, ≥ 0.
    pub approach_speed: f64,
    /// Speed away from the wall just after, m/s, ≥ 0; `None` if still open.
    pub departure_speed: Option<f64>,
}

/// The motion between the two ends of a step.
#[derive(Debug, Clone, Copy)]
#[non_exhaustive]
pub enum Path<'a> {
    /// The motion is known only at the grid's instants.
    Grid,
    /// As [`Path::Grid`], in a step where no displacement satisfies all the bounds of
    /// [`Bound::Reflected`] with each wall's own e: all of them take the smallest e of the scene's
    /// rigid walls.
    OneRestitution,
    /// A part of a step on a grid, which ends where the step does or before: at an impact, a blow,
    /// a jump of a load. Between its ends it keeps the balance of a step of this length, by the
    /// impulses less [`Step::jump`] and without blows; at the instant `end` the velocity goes from
    /// [`Step::velocity_after`] to [`Step::v`], M(v − v₊) = J + [`Step::jump`], with J the blows at
    /// that instant.
    Part {
        /// Its length, s: end minus start of the step, without their rounding.
        length: f64,
    },
    /// The exact motion and wall forces of one degree of freedom.
    Exact(&'a Arc),
    /// The exact motion and wall forces of several degrees of freedom.
    Series(&'a Series),
    /// A step over a stretch that the scheme hands to another one, on a grid.
    Handed {
        /// The contract of this step, in place of the run's.
        contract: &'a Contract,
        /// Its length, s: end minus start of the step, without their rounding.
        step: f64,
    },
}

impl<'a> Step<'a> {
    /// A step of no length in which nothing moves, with zeros of all degrees of freedom and of all
    /// walls.
    #[inline]
    pub(crate) fn still(freedoms: &'a [f64], walls: &'a [f64]) -> Self {
        Self {
            index: 0,
            start: 0.0,
            end: 0.0,
            q: freedoms,
            v: freedoms,
            velocity_before: freedoms,
            velocity_after: freedoms,
            impulse: walls,
            jump: walls,
            force: walls,
            friction: &[],
            normal: &[],
            turned: &[],
            wedged: &[],
            resting: &[],
            extra: freedoms,
            closed: &[],
            path: Path::Grid,
        }
    }
}

impl Step<'_> {
    /// True if it is of a scene with `n` degrees of freedom and `walls` walls, of which it tells
    /// friction and normals of `planar`: of all or of none.
    #[inline]
    pub(crate) fn fits(&self, n: usize, walls: usize, planar: usize) -> bool {
        let moved = [self.q, self.v, self.velocity_before, self.velocity_after, self.extra];
        let pushed = [self.impulse, self.jump, self.force];
        let along = match self.path {
            Path::Series(series) => series.degrees_of_freedom() == n,
            Path::Exact(_) => n == 1,
            Path::Grid | Path::OneRestitution | Path::Part { .. } | Path::Handed { .. } => true,
        };
        let turned = [self.friction.len(), self.normal.len(), self.turned.len()] == [planar; 3];
        turned && along && moved.iter().all(|x| x.len() == n) && pushed.iter().all(|x| x.len() == walls)
    }

    /// The length of the step, s: that of the grid, `h`, except in parts of its steps.
    #[cfg(feature = "cli")]
    pub(crate) fn length(&self, h: f64) -> f64 {
        match self.path {
            Path::Part { length } => length,
            Path::Handed { step, .. } => step,
            Path::Exact(_) | Path::Series(_) => self.end - self.start,
            Path::Grid | Path::OneRestitution => h,
        }
    }

    /// The impulse −p n + f t of a round hole on the structure along y and z, with the part that
    /// the turning of its normal adds, N s; `hole` counts as [`Step::impulse`] does.
    #[must_use]
    pub fn hole_push(&self, hole: usize) -> [f64; 2] {
        let Some((&[y, z], turned)) = self.normal.get(hole).zip(self.turned.get(hole)) else { return [0.0; 2] };
        let of = |values: &[f64]| values.get(hole).copied().unwrap_or(0.0);
        let (p, f) = (of(self.impulse), of(self.friction));
        [-p * y - f * z + turned[0], -p * z + f * y + turned[1]]
    }
}

impl Path<'_> {
    /// Displacement (m) and velocity (m/s) at `t` within the step, into slices over degrees of
    /// freedom. Nothing is written for a step on a grid.
    pub fn state(&self, t: f64, q: &mut [f64], v: &mut [f64]) {
        match self {
            Self::Grid | Self::OneRestitution | Self::Part { .. } | Self::Handed { .. } => {}
            Self::Exact(arc) => {
                if let (Some(q), Some(v)) = (q.first_mut(), v.first_mut()) {
                    (*q, *v) = arc.state(t);
                }
            }
            Self::Series(series) => series.state(t, q, v),
        }
    }

    /// Acceleration (m/s²) at the start and at the end of the step, into slices over degrees of
    /// freedom. Nothing is written for a step on a grid.
    pub(crate) fn accelerations(&self, start: &mut [f64], end: &mut [f64]) {
        match self {
            Self::Grid | Self::OneRestitution | Self::Part { .. } | Self::Handed { .. } => {}
            Self::Exact(arc) => {
                if let (Some(start), Some(end)) = (start.first_mut(), end.first_mut()) {
                    (*start, *end) = (arc.acceleration(arc.start()), arc.acceleration(arc.end()));
                }
            }
            Self::Series(series) => {
                start.iter_mut().enumerate().for_each(|(dof, a)| *a = series.acceleration_at_start(dof));
                series.acceleration_at_end(end);
            }
        }
    }

    /// Force of wall `wall` at `t` within the step, N, signed; 0 on a grid.
    pub(crate) fn contact_force(&self, wall: usize, t: f64) -> f64 {
        match self {
            Self::Grid | Self::OneRestitution | Self::Part { .. } | Self::Handed { .. } => 0.0,
            Self::Exact(arc) => arc.contact_force(wall, t),
            Self::Series(series) => series.counted_force(wall, t),
        }
    }

    /// Impulse of wall `wall` over [from, to] within the step, N s, signed; 0 on a grid.
    pub(crate) fn contact_impulse(&self, wall: usize, from: f64, to: f64) -> f64 {
        match self {
            Self::Grid | Self::OneRestitution | Self::Part { .. } | Self::Handed { .. } => 0.0,
            Self::Exact(arc) => arc.contact_impulse(wall, from, to),
            Self::Series(series) => series.counted_impulse(wall, from, to),
        }
    }
}

/// One step, lent by the stepper until the next one.
///
/// Slices over degrees of freedom have length n. Slices over walls have one entry a wall, flat or
/// round, in the scene's order.
#[derive(Debug, Clone, Copy)]
#[non_exhaustive]
pub struct Step<'a> {
    /// Index of the step, from 0; the parts of one step share it.
    pub index: u64,
    /// Time at its start, s.
    pub start: f64,
    /// Time at its end, s. Equal to `start` for an impact at the very start of an exact run.
    pub end: f64,
    /// Displacement at the end, m.
    pub q: &'a [f64],
    /// Velocity at the end, m/s, right-continuous: after an impact at that instant.
    pub v: &'a [f64],
    /// Velocity that enters the momentum balance, m/s: (q − q⁻)/h for a staggered scheme, else that
    /// of the step's start.
    pub velocity_before: &'a [f64],
    /// Velocity that leaves the momentum balance, m/s: (q⁺ − q)/h for a staggered scheme, else `v`.
    pub velocity_after: &'a [f64],
    /// Impulse of each wall on the body over the step, N s: signed along the row of a wall; of a
    /// round hole its magnitude p ≥ 0 along −n, in exact motion ∫ of the magnitude of its force.
    pub impulse: &'a [f64],
    /// The part of `impulse` that acted at the instant `end`, N s; all zero for schemes that do not
    /// resolve instants.
    pub jump: &'a [f64],
    /// Force of each wall: at the instant `end` for the exact scheme, else the multiplier the
    /// scheme computed, which is impulse/h unless the scheme's impulse averages two of them; in a
    /// [`Path::Part`] the mean force over it, without the jump at its end. N, with the sign of the
    /// impulse.
    pub force: &'a [f64],
    /// Friction impulse at each wall over the step, N s, along t = (−n_z, n_y) with n the outward
    /// normal there; empty in scenes without friction and round holes, as are the next two.
    pub friction: &'a [f64],
    /// The outward unit normal n of each round hole at the contact of the step, in exact motion at
    /// its end; (0, 0) where it was out of reach, and at flats, whose normal the scene states.
    pub normal: &'a [[f64; 2]],
    /// The impulse of each round hole on the structure in addition to −p n + f t, since the normal
    /// turned in the step, N s along y and z; 0 for schemes on a grid, which use one normal a step.
    pub turned: &'a [[f64; 2]],
    /// Walls and round holes that gave up their rebound in the step since no impulses satisfy
    /// Coulomb's law together with it, or only some that add energy: their ε is 0 ([`Friction`]).
    pub wedged: &'a [usize],
    /// Walls whose rebounds end within the step: their ε is 0 (where there is friction by
    /// [`Friction`]; in a [`Path::Part`] where the acceleration a before the impact presses the
    /// body on the wall and 2e|ẇ| ≤ (1 − e) h a, or where it is struck in turn with others ever
    /// faster and weaker, so that the impacts left come within the step; with those at one wall end
    /// those at all that are approached no faster).
    pub resting: &'a [usize],
    /// Extra force given by the caller, and what a load that jumps within the step lacks of its
    /// impulse, N, as they enter the momentum balance: constant over the step, or for a staggered
    /// scheme, whose balance is centred at `start`, the mean of the last step's and this one's;
    /// length n.
    pub extra: &'a [f64],
    /// Contact episodes that ended in this step.
    pub closed: &'a [Contact],
    /// The motion inside the step, as far as it is known.
    pub path: Path<'a>,
}
