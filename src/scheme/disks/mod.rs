//! Schemes whose steps bound displacements in round holes: position-level schemes at the end of the
//! step, moreau-jean in elastic rings at θ.
//!
//! A rigid hole is the disk |w⁺| ≤ γ, an elastic one of stiffness k_a and radial damping c_a is a
//! disk that yields: with r₊ = max(|w|, γ) and k = k_a + c_a/h, the pressure k_a(|w⁺| − γ) +
//! c_a(|w⁺| − r₊)/h is k(|w⁺| − ρ) for the radius ρ = (k_aγ + c_a r₊/h)/k. So a step is the
//! programme of the same scheme between planar walls with disks beside the bounds, and
//! [`DiskSolver`](crate::qp::DiskSolver) answers it. `position.rs` is implicit-euler, `alpha.rs`
//! generalized-alpha, `velocity.rs` moreau-jean with elastic rings. In the penalty (`springs.rs`)
//! every contact is a spring, and there is no programme.
//!
//! Friction is refused: a bound on the displacement leaves a contact no velocity at which it could
//! stick, and between the impulse of one step and that of the next it would bounce along the
//! surface.

mod alpha;
mod disk_programme;
mod hole_body;
mod position;
mod springs;
mod velocity;

pub(super) use disk_programme::DiskProgramme;

use super::Counters;
use super::motion::Motion;
use crate::contact::{Episodes, Rates};
use crate::error::Result;
use crate::qp::DiskCounters;
use crate::scene::{Checked, Scene};
use crate::step::{Balance, Contact, Contract, Law, Step};
use alpha::Alpha;
use hole_body::{HoleBody, pair};
use position::Position;
use springs::Springs;
use velocity::Velocity;

/// The scheme of a motion.
#[derive(Debug)]
enum DiskRule {
    Position(Box<Position>),
    Alpha(Box<Alpha>),
    Velocity(Box<Velocity>),
    Springs(Box<Springs>),
}

impl DiskRule {
    fn advance(&mut self, step: u64, held: &mut HoleBody) -> Result<()> {
        match self {
            Self::Position(rule) => rule.advance(step, held),
            Self::Alpha(rule) => rule.advance(step, held),
            Self::Velocity(rule) => rule.advance(step, held),
            Self::Springs(rule) => rule.advance(step, held),
        }
    }

    fn counters(&self) -> DiskCounters {
        match self {
            Self::Position(rule) => rule.bounds.counters(),
            Self::Alpha(rule) => rule.counters(),
            Self::Velocity(rule) => rule.bounds.counters(),
            // It solves no programme.
            Self::Springs(_) => DiskCounters::default(),
        }
    }
}

/// The motion of a scene with round holes by a scheme whose bounds are on displacements.
#[derive(Debug)]
pub(super) struct Disks {
    held: HoleBody,
    rule: DiskRule,
    episodes: Episodes,
    turned: f64,
}

impl Disks {
    /// `scene` in steps of `h` seconds that satisfy `contract`: that of implicit-euler, of
    /// generalized-alpha, of moreau-jean, or of the penalty with the discrete gradient.
    pub fn new(scene: &Checked, contract: Contract, h: f64) -> Result<Self> {
        let held = HoleBody::new(scene, h)?;
        Ok(Self {
            rule: match contract.balance {
                Balance::GeneralizedAlpha { .. } => {
                    DiskRule::Alpha(Box::new(Alpha::new(scene, contract.balance, &held)?))
                }
                _ if contract.promise.elastic.law == Law::Gradient => {
                    DiskRule::Springs(Box::new(Springs::new(scene, &held)?))
                }
                Balance::Theta(theta) if contract.promise.hole.is_none() => {
                    DiskRule::Velocity(Box::new(Velocity::new(scene, theta, &held)?))
                }
                _ => DiskRule::Position(Box::new(Position::new(scene, &held)?)),
            },
            held,
            episodes: Episodes::new(scene, scene.wall_masses(), contract),
            turned: 0.0,
        })
    }

    /// Passes the step to the contact episodes, and notes by how much normals turned.
    fn record_episodes(&mut self) {
        let Self { held, episodes, turned, .. } = self;
        let HoleBody { body, frame, rows, rounds, .. } = &*held;
        if frame.pushing.is_empty() && episodes.idle() {
            return;
        }
        for (index, hole) in frame.pushing.iter().filter_map(|&index| Some((index, held.hole(index)?))) {
            let ([y, z], [vy, vz]) = (frame.normal[index], pair(rows, hole, &frame.after));
            *turned = turned.max(body.h * (y * vz - z * vy).abs() / rounds[hole].gap);
        }
        episodes.observe(frame.start, body.h, &frame.impulse, &frame.pushing, |index| {
            let seen = |v: &Vec<f64>| match held.hole(index) {
                None => body.seen(index, v),
                Some(hole) => {
                    let ([y, z], [vy, vz]) = (frame.normal[index], pair(rows, hole, v));
                    y * vy + z * vz
                }
            };
            Rates { before: seen(&frame.before), struck: seen(frame.struck()), after: seen(&frame.after) }
        });
    }
}

impl Motion for Disks {
    fn advance(&mut self, step: u64, extra: Option<&[f64]>) -> Result<()> {
        self.held.frame.force(extra);
        self.held.frame.normal.fill([0.0; 2]);
        self.held.frame.begin(step, self.held.body.h);
        self.rule.advance(step, &mut self.held)?;
        self.held.frame.check(step)?;
        self.record_episodes();
        Ok(())
    }

    fn flush(&mut self, tiny: f64) {
        let carried = if let DiskRule::Alpha(rule) = &mut self.rule { rule.carried() } else { [None, None] };
        self.held.frame.flush(tiny, self.held.body.h, carried);
    }

    fn step(&self, index: u64) -> Step<'_> {
        self.held.frame.step(index, self.episodes.closed())
    }

    fn restart(&mut self, _: &Scene, time: f64, q: &[f64], v: &[f64]) -> Result<()> {
        self.held.frame.restart(time, q, v);
        self.held.body.restart(time);
        match &mut self.rule {
            DiskRule::Alpha(rule) => rule.restart(&self.held),
            DiskRule::Velocity(rule) => rule.restart(),
            _ => {}
        }
        self.held.frame.normal.fill([0.0; 2]);
        self.episodes.forget();
        Ok(())
    }

    fn open_contacts(&self) -> Vec<Contact> {
        self.episodes.still_open()
    }

    fn count(&self, counters: &mut Counters) {
        let DiskCounters { solves, free, fallbacks, iterations, .. } = self.rule.counters();
        counters.qp_solves += solves - free;
        counters.qp_fallbacks += fallbacks;
        counters.interior_point_iterations += iterations;
        counters.largest_turn_rad = self.turned;
        if let DiskRule::Springs(rule) = &self.rule {
            counters.newton_iterations = rule.iterations();
        }
    }
}

#[cfg(test)]
mod tests;
