//! The trait of the contacts of a scene, as the division of a step needs them.

use super::super::Counters;
use super::super::body::Body;
use super::super::frame::Frame;
use super::super::space::Space;
use super::part::Part;
use crate::error::Result;
use crate::qp::Failure;
use std::fmt::Debug;

/// Whether the motion over a part was found; if not, it may be over a shorter one.
pub(super) type Solved = std::result::Result<bool, Failure>;

/// Where the body is at a rigid wall.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Place {
    /// In front of it.
    Away,
    /// On its face, without speed towards or away from it.
    Resting,
    /// On its face, moving away.
    Leaving,
    /// On its face, moving into it.
    Struck,
}

/// What ends a part before its time, at this wall.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Event {
    /// The path crosses the wall.
    Crossing(usize),
    /// Sliding along the wall ends.
    Reversal(usize),
    /// Sliding along it begins.
    Slip(usize),
}

impl Event {
    /// The wall.
    pub fn wall(self) -> usize {
        match self {
            Self::Crossing(wall) | Self::Reversal(wall) | Self::Slip(wall) => wall,
        }
    }
}

/// How far an event is from the end of a part.
#[derive(Debug, Clone, Copy)]
pub(super) struct Ahead {
    /// What is left of the gap (m), of the sliding velocity (m/s) or of the time (s), positive
    /// before the event, and its rate, 1/s.
    pub left: f64,
    pub rate: f64,
    /// At or below this much is left where the event is met.
    pub met: f64,
}

/// The contacts of a scene: on single rows ([`super::row_contacts`]), or at places in two planes
/// with round walls and friction ([`super::plane_contacts`]).
pub(super) trait Contacts<S: Space>: Debug + Send {
    /// Finds where the state of `frame` is at each rigid wall.
    fn classify(&mut self, body: &Body<S>, part: &Part<S>, frame: &Frame<S>);

    /// True if the body moves into a wall that it touches.
    fn is_struck(&self) -> bool;

    /// True if a blow at the end of a part must come in a part of its own.
    fn sets_blows_apart(&self) -> bool {
        false
    }

    /// Computes δ and what the walls give over a part of `length` seconds from the state of
    /// `frame`, whose momentum `part` has.
    fn solve_contacts(&mut self, body: &Body<S>, part: &mut Part<S>, frame: &Frame<S>, length: f64) -> Solved;

    /// Where no motion was found: whether walls along which the body slides must first stop its
    /// speed across them, by an impulse without rebound.
    fn stops(&mut self) -> bool {
        false
    }

    /// The number of parts that the rest of a step may have without rebounds, if too many impacts
    /// follow one another in it; after these, and where it is 0, comes [`Contacts::give_up`].
    fn parts_without_rebound(&self) -> u32 {
        0
    }

    /// Sets whether a body that strikes a wall rebounds.
    fn set_rebounds(&mut self, _rebounds: bool) {}

    /// The same by implicit-euler, at whose end the body is in front of all walls.
    fn give_up(&mut self, body: &Body<S>, part: &mut Part<S>, frame: &Frame<S>, length: f64) -> Solved;

    /// The first event on the path of `length` seconds that changes the velocity by `delta`, and
    /// its instant within the path, s.
    fn first_event(&self, body: &Body<S>, frame: &Frame<S>, motion: (&S::Vector, f64)) -> Option<(f64, Event)>;

    /// How far the end of that path is from an event.
    fn ahead(&self, body: &Body<S>, frame: &Frame<S>, event: Event, motion: (&S::Vector, f64)) -> Ahead;

    /// Forgets earlier impacts: the state is a new one.
    fn restart(&mut self) {}

    /// Notes a part of no length.
    fn stay(&mut self) {}

    /// Notes that the last part was one of implicit-euler.
    fn forget(&mut self) {}

    /// Keeps what a part of `length` seconds, at whose end `frame` is, leaves to the next one.
    fn keep(&mut self, body: &Body<S>, part: &Part<S>, frame: &Frame<S>, length: f64);

    /// Applies the impact law to the state of `frame`, if a wall is struck, and writes the impulses
    /// of the instant. Returns whether there was an impact.
    fn strike(&mut self, body: &Body<S>, part: &Part<S>, frame: &mut Frame<S>, step: u64) -> Result<bool>;

    /// Adds the work that the contacts have cost.
    fn count(&self, counters: &mut Counters);
}
