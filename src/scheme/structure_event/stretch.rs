//! A stretch that moreau-jean steps, and the count of events that decides on it.

use crate::scheme::Handover;
use crate::scheme::motion::Motion;
use crate::step::Contract;

/// The current stretch.
#[derive(Debug)]
pub(super) struct Stretch {
    pub grid: Box<dyn Motion>,
    pub from: f64,
    pub to: f64,
    /// Its step, s.
    pub h: f64,
    pub step: u64,
    /// The contract that its steps keep.
    pub contract: Contract,
}

/// Counts events, to detect that there are too many.
#[derive(Debug, Default)]
pub(super) struct ImpactBurst {
    pub since: f64,
    pub at_since: u64,
    /// End of the last stretch handed over, s.
    pub handed: f64,
    /// Stretches handed over; adjacent ones are joined.
    pub stretches: Vec<Handover>,
    pub steps: u64,
}

impl ImpactBurst {
    /// Restarts the count at `time` (s), after `events` events so far.
    pub fn restart(&mut self, time: f64, events: u64) {
        (self.since, self.at_since) = (time, events);
    }
}
