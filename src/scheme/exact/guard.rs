//! Work counters, and the limit that stops a run which would not end.

/// Maximum number of events, or of evaluations in root searches, within one window before a run is
/// abandoned.
pub const EVENTS_PER_WINDOW: u64 = 1_000_000;

/// Number of windows into which the duration of a scene is divided: a run follows at most twenty
/// million events, some ten seconds of computing.
pub const WINDOWS: f64 = 20.0;

/// Work done since the start of a run.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq)]
pub struct EventCounters {
    /// Changes of contact: impacts, entries, releases.
    pub events: u64,
    /// Impacts on rigid walls.
    pub impacts: u64,
    /// Evaluations of the flow in the search for events.
    pub evaluations: u64,
}

/// Counts within the current window.
#[derive(Debug, Clone, Copy, Default)]
pub(in crate::scheme) struct Guard {
    pub total: EventCounters,
    since: f64,
    at_since: EventCounters,
}

impl Guard {
    /// Starts a window at `time` (s).
    pub fn restart(&mut self, time: f64) {
        (self.since, self.at_since) = (time, self.total);
    }

    /// The count of events or evaluations in the window if it exceeds the limit. `window` in s.
    #[inline]
    pub fn exceeded(&mut self, time: f64, window: f64) -> Option<u64> {
        if time >= self.since + window {
            self.since = time;
            self.at_since = self.total;
        }
        let events = self.total.events - self.at_since.events;
        let count = events.max(self.total.evaluations - self.at_since.evaluations);
        (count > EVENTS_PER_WINDOW).then_some(count)
    }
}

#[cfg(test)]
mod tests;
