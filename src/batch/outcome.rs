//! What a batch leaves behind.

use crate::error::Result;

/// Who followed a lane.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum By {
    /// The lanes, side by side.
    Lanes,
    /// The scheme `event`, by itself: the lanes do not hold this one, or met what they do not
    /// decide.
    Event,
}

/// One wall over the window.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub struct AtWall {
    /// Impacts on a rigid wall.
    pub impacts: u64,
    /// Impulse on the body, N s, signed: of impacts and of contact that lasts.
    pub impulse: f64,
    /// The largest |impulse| of one impact, N s.
    pub largest_impulse: f64,
    /// The largest |force| of a contact that lasts and reaches into the window, N; none without
    /// one.
    pub peak_force: Option<f64>,
}

/// One oscillator over the window: the last [`Plan::keep`](super::Plan::keep) periods.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Outcome {
    /// Who followed it.
    pub by: By,
    /// At the lower wall; zeros if there is none.
    pub lower: AtWall,
    /// At the upper wall.
    pub upper: AtWall,
    /// The least and the largest displacement, m, turns between strobes included.
    pub extent: [f64; 2],
    /// The growth of a change of the start over the window, 1/s: ln|δ(end)|/|δ(begin)| over its
    /// length, the largest Lyapunov exponent for a window that is long enough. −∞ once the
    /// oscillator has rested on a wall, which forgets how it came there.
    pub exponent: f64,
}

/// The oscillators of a batch, in the order in which they were given.
#[derive(Debug, Clone, PartialEq)]
pub struct Batch {
    pub(super) keep: usize,
    pub(super) strobes: Vec<[f64; 2]>,
    pub(super) outcomes: Vec<Result<Outcome>>,
}

impl Batch {
    /// What came of every oscillator: the reason where one could not be followed.
    pub fn outcomes(&self) -> &[Result<Outcome>] {
        &self.outcomes
    }

    /// Displacement (m) and velocity (m/s) of oscillator `lane` at the ends of the periods of the
    /// window; no numbers if it could not be followed, none at all of one that there is not.
    #[must_use]
    pub fn strobes(&self, lane: usize) -> &[[f64; 2]] {
        let from = lane.saturating_mul(self.keep);
        self.strobes.get(from..from.saturating_add(self.keep)).unwrap_or(&[])
    }

    /// How many oscillators were handed to the scheme `event`, those that it could not follow
    /// either included.
    #[must_use]
    pub fn handed(&self) -> usize {
        self.outcomes.iter().filter(|o| !matches!(o, Ok(Outcome { by: By::Lanes, .. }))).count()
    }

    /// How many could not be followed.
    #[must_use]
    pub fn failed(&self) -> usize {
        self.outcomes.iter().filter(|o| o.is_err()).count()
    }
}

/// ln of what a change of the start of size e^`began` has grown by that is of `size` now: −∞ for
/// nothing, whatever it was before.
pub(super) fn grown(began: f64, size: f64) -> f64 {
    if size > 0.0 { size.ln() - began } else { f64::NEG_INFINITY }
}
