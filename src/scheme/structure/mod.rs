//! The schemes for several degrees of freedom: matrices in place of numbers, one quadratic programme over all walls in place of a clamp.
//!
//! | file | what it holds |
//! |---|---|
//! | `body.rs` | what every scheme knows of the scene: products, loads, walls by place |
//! | `frame.rs` | the state, and what a step shows of itself |
//! | `programme.rs` | the quadratic programme: walls to rows and back |
//! | `moreau_jean.rs` | one file per scheme |
//!
//! The mathematics of a scheme stands above its scalar kernel in the room above; here stands what several unknowns add.

mod body;
mod frame;
mod moreau_jean;
mod programme;

use super::Scheme;
use super::grid::Counters;
use crate::contact::{Episodes, Rates};
use crate::error::{Error, Result};
use crate::qp::Backend;
use crate::scene::Scene;
use crate::step::Step;
use frame::Frame;
use moreau_jean::MoreauJean;

/// The constants of one scheme on one scene.
#[derive(Debug)]
enum Method {
    MoreauJean(MoreauJean),
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
            Scheme::MoreauJean { theta } => Method::MoreauJean(MoreauJean::new(scene, theta, h, backend)?),
            _ => return Err(Error::invalid("scheme", scheme, "moreau-jean for several degrees of freedom")),
        };
        Ok(Self { method, frame })
    }

    /// One step, number `step`, under the extra force (N, n entries); none is none.
    pub fn advance(&mut self, step: u64, extra: Option<&[f64]>) -> Result<()> {
        match extra {
            Some(extra) => self.frame.extra.copy_from_slice(extra),
            None => self.frame.extra.fill(0.0),
        }
        match &mut self.method {
            Method::MoreauJean(kernel) => kernel.advance(step, &mut self.frame),
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
            Method::MoreauJean(kernel) => kernel.count(counters),
        }
    }

    /// The solver in force.
    pub fn backend(&self) -> Backend {
        match &self.method {
            Method::MoreauJean(kernel) => kernel.backend(),
        }
    }
}
