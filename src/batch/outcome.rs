//! The results of a batch.

use crate::error::Result;

/// The method that computed an oscillator.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum By {
    /// The lanes, side by side.
    Lanes,
    /// The scheme `event`: the lanes do not support this oscillator, or could not decide whether it
    /// meets a wall.
    Event,
}

/// One wall over the window.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub struct AtWall {
    /// Impacts on a rigid wall.
    pub impacts: u64,
    /// Impulse on the body, N s, signed, by impacts and lasting contacts.
    pub impulse: f64,
    /// The largest |impulse| of one impact, N s.
    pub largest_impulse: f64,
    /// The largest |force| of a lasting contact that reaches into the window, N; `None` if there is
    /// none.
    pub peak_force: Option<f64>,
}

/// One oscillator over the window: the last [`Plan::keep`](super::Plan::keep) periods.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Outcome {
    /// The method that computed it.
    pub by: By,
    /// Results at the lower wall; zeros if there is none.
    pub lower: AtWall,
    /// Results at the upper wall; zeros if there is none.
    pub upper: AtWall,
    /// The smallest and the largest displacement, m, over the whole window.
    pub extent: [f64; 2],
    /// The growth rate of a small change δ of the initial state over the window, 1/s:
    /// ln(|δ(end)|/|δ(begin)|) over its length, the largest Lyapunov exponent if the window is long
    /// enough. −∞ once the oscillator has rested on a wall, after which its motion no longer
    /// depends on the initial state.
    pub exponent: f64,
}

/// The results of the oscillators of a batch, in the order in which they were given.
#[derive(Debug, Clone, PartialEq)]
pub struct Batch {
    pub(super) keep: usize,
    pub(super) strobes: Vec<[f64; 2]>,
    pub(super) outcomes: Vec<Result<Outcome>>,
}

impl Batch {
    /// The result of every oscillator, or the error if it could not be computed.
    pub fn outcomes(&self) -> &[Result<Outcome>] {
        &self.outcomes
    }

    /// Displacement (m) and velocity (m/s) of oscillator `lane` at the ends of the periods of the
    /// window; NaN if it could not be computed, and empty if there is no such oscillator.
    #[must_use]
    pub fn strobes(&self, lane: usize) -> &[[f64; 2]] {
        let from = lane.saturating_mul(self.keep);
        self.strobes.get(from..from.saturating_add(self.keep)).unwrap_or(&[])
    }

    /// Number of oscillators left to the scheme `event`, including those that it could not compute
    /// either.
    #[must_use]
    pub fn handed(&self) -> usize {
        self.outcomes.iter().filter(|o| !matches!(o, Ok(Outcome { by: By::Lanes, .. }))).count()
    }

    /// Number of oscillators that could not be computed.
    #[must_use]
    pub fn failed(&self) -> usize {
        self.outcomes.iter().filter(|o| o.is_err()).count()
    }
}

/// ln of the growth of a change of the initial state from e^`began` to `size`; −∞ if `size` is 0.
pub(super) fn grown(began: f64, size: f64) -> f64 {
    if size > 0.0 { size.ln() - began } else { f64::NEG_INFINITY }
}
