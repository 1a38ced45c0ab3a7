//! The schemes for several degrees of freedom: matrices in place of numbers, one quadratic programme over all walls in place of a clamp.
//!
//! | file | what it holds |
//! |---|---|
//! | `body.rs` | what every scheme knows of the scene: products, loads, walls |
//! | `frame.rs` | the state, and what a step shows of itself |
//! | `programme.rs` | the quadratic programme: walls to rows and back |
//! | `newton.rs` | walls that answer by laws: semismooth Newton on their forces |
//! | `start.rs` | what acts at t = 0 |
//! | `arrival.rs` | the velocity that a staggered scheme reports |
//! | `position.rs`, `paoli_schatzman.rs`, `moreau_jean.rs`, `generalized_alpha.rs`, `penalty.rs`, `central_difference.rs` | one file per scheme |
//!
//! The mathematics of a scheme stands above its scalar kernel in the room above; here stands what several unknowns add.

mod arrival;
mod body;
mod central_difference;
mod factor;
mod frame;
mod generalized_alpha;
mod moreau_jean;
mod newton;
mod paoli_schatzman;
mod penalty;
mod position;
mod programme;
mod start;

use super::grid::Counters;
use super::penalty::Mean;
use super::{Integrator, Scheme};
use crate::contact::{Episodes, Rates};
use crate::error::{Error, Result};
use crate::qp::Backend;
use crate::scene::Scene;
use crate::step::Step;
use central_difference::CentralDifference;
use frame::Frame;
use generalized_alpha::GeneralizedAlpha;
use moreau_jean::MoreauJean;
use paoli_schatzman::PaoliSchatzman;
use penalty::Penalty;
use position::Position;

/// The constants of one scheme on one scene.
#[derive(Debug)]
enum Method {
    Position(Position),
    PaoliSchatzman(PaoliSchatzman),
    MoreauJean(MoreauJean),
    GeneralizedAlpha(Box<GeneralizedAlpha>),
    Penalty(Penalty),
    CentralDifference(CentralDifference),
}

/// A scheme on a grid over several degrees of freedom, with the state it carries.
#[derive(Debug)]
pub(super) struct Structure {
    method: Method,
    frame: Frame,
}

impl Structure {
    /// `scene` by `scheme` with steps of `h` seconds; the walls are such that a quadratic programme can hold them, or springs for a penalty.
    pub fn new(scene: &Scene, scheme: &Scheme, h: f64, backend: Backend) -> Result<Self> {
        let frame = Frame::new(scene)?;
        let method = match *scheme {
            Scheme::ImplicitEuler => Method::Position(Position::new(scene, 1.0, h, backend, &frame)?),
            Scheme::Newmark => Method::Position(Position::new(scene, 0.5, h, backend, &frame)?),
            Scheme::PaoliSchatzman => Method::PaoliSchatzman(PaoliSchatzman::new(scene, h, backend, &frame)?),
            Scheme::MoreauJean { theta } => Method::MoreauJean(MoreauJean::new(scene, theta, h, backend)?),
            Scheme::GeneralizedAlpha { .. } => {
                let balance = scheme.contract().balance;
                Method::GeneralizedAlpha(Box::new(GeneralizedAlpha::new(scene, balance, h, backend, &frame)?))
            }
            Scheme::Penalty { integrator, .. } => match integrator {
                Integrator::Trapezoidal => Method::Penalty(Penalty::new(scene, 0.5, Mean::Ends, h)?),
                Integrator::ImplicitEuler => Method::Penalty(Penalty::new(scene, 1.0, Mean::Ends, h)?),
                Integrator::DiscreteGradient => Method::Penalty(Penalty::new(scene, 0.5, Mean::DiscreteGradient, h)?),
                Integrator::CentralDifference => Method::CentralDifference(CentralDifference::new(scene, h, &frame)?),
            },
            Scheme::Event => return Err(Error::invalid("scheme", scheme, "a scheme with a step")),
        };
        Ok(Self { method, frame })
    }

    /// Takes the motion up anew at `time` (s) from `q` (m) and `v` (m/s), n entries each.
    pub fn restart(&mut self, scene: &Scene, time: f64, q: &[f64], v: &[f64]) -> Result<()> {
        let Self { method, frame } = self;
        frame.restart(time, q, v);
        match method {
            Method::Position(kernel) => kernel.restart(scene, time, frame)?,
            Method::PaoliSchatzman(kernel) => kernel.restart(scene, time, frame)?,
            Method::MoreauJean(kernel) => kernel.restart(time),
            Method::GeneralizedAlpha(kernel) => kernel.restart(time, frame),
            Method::Penalty(kernel) => kernel.restart(time),
            Method::CentralDifference(kernel) => kernel.restart(scene, time, frame)?,
        }
        Ok(())
    }

    /// One step, number `step`, under the extra force (N, n entries); none is none.
    pub fn advance(&mut self, step: u64, extra: Option<&[f64]>) -> Result<()> {
        match extra {
            Some(extra) => self.frame.extra.copy_from_slice(extra),
            None => self.frame.extra.fill(0.0),
        }
        match &mut self.method {
            Method::Position(kernel) => kernel.advance(step, &mut self.frame),
            Method::PaoliSchatzman(kernel) => kernel.advance(step, &mut self.frame),
            Method::MoreauJean(kernel) => kernel.advance(step, &mut self.frame),
            Method::GeneralizedAlpha(kernel) => kernel.advance(step, &mut self.frame),
            Method::Penalty(kernel) => kernel.advance(step, &mut self.frame),
            Method::CentralDifference(kernel) => kernel.advance(step, &mut self.frame),
        }?;
        self.frame.check(step)
    }

    /// Shows the last step to the contact episodes.
    pub fn tell(&self, scene: &Scene, h: f64, episodes: &mut Episodes) {
        let frame = &self.frame;
        if frame.pushing.is_empty() && episodes.idle() {
            return;
        }
        let seen = |wall: usize, v: &[f64]| scene.walls.get(wall).map_or(0.0, |w| w.at.dot(v));
        let rates = |wall: usize| Rates {
            before: seen(wall, &frame.before),
            struck: seen(wall, frame.struck()),
            after: seen(wall, &frame.after),
        };
        episodes.see_some(frame.start, h, &frame.impulse, &frame.pushing, rates);
    }

    /// The last step.
    pub fn step<'a>(&'a self, index: u64, episodes: &'a Episodes) -> Step<'a> {
        self.frame.step(index, episodes.closed())
    }

    /// Time reached, s.
    pub fn end(&self) -> f64 {
        self.frame.end
    }

    /// Displacement and velocity there, m and m/s, n entries each.
    pub fn state(&self) -> (&[f64], &[f64]) {
        (&self.frame.q, &self.frame.v)
    }

    pub fn count(&self, counters: &mut Counters) {
        match &self.method {
            Method::Position(kernel) => kernel.count(counters),
            Method::PaoliSchatzman(kernel) => kernel.count(counters),
            Method::MoreauJean(kernel) => kernel.count(counters),
            Method::GeneralizedAlpha(kernel) => kernel.count(counters),
            Method::Penalty(kernel) => kernel.count(counters),
            Method::CentralDifference(_) => {}
        }
    }

    /// The solver of the quadratic programmes in force; none for a penalty, which has no such programmes.
    pub fn backend(&self) -> Option<Backend> {
        match &self.method {
            Method::Position(kernel) => Some(kernel.backend()),
            Method::PaoliSchatzman(kernel) => Some(kernel.backend()),
            Method::MoreauJean(kernel) => Some(kernel.backend()),
            Method::GeneralizedAlpha(kernel) => Some(kernel.backend()),
            Method::Penalty(_) | Method::CentralDifference(_) => None,
        }
    }
}
