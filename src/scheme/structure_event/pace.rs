//! How long a series is to be where events follow one another quickly.
//!
//! A series over two radians of the fastest motion has some 25 terms. Where a structure bounces a
//! thousand times in that time, each impact would begin such a series, of which the next impact
//! leaves a thousandth. Over the time within which the next event is expected, 10 terms are as
//! exact, and roots are found among fewer coefficients. Where no event comes within that time, the
//! series ends there, and the next one is longer.

/// The times between the last events.
#[derive(Debug, Clone, Copy)]
pub(super) struct Pace {
    /// The time within which the next event is expected, s; infinite if nothing is known.
    reach: f64,
}

/// The next event is expected within this many times the time to the last.
const FLIGHTS: f64 = 8.0;

/// The share of the last expectation below which the next one is not: a few quick events among
/// slow ones, as where impacts accumulate, shorten few series.
const LEAST: f64 = 0.5;

/// Factor on the expectation where no event came.
const GROWTH: f64 = 16.0;

impl Pace {
    pub fn new() -> Self {
        Self { reach: f64::INFINITY }
    }

    pub fn reach(&self) -> f64 {
        self.reach
    }

    /// Takes note of a series of this length (s), which an event ended or not; without events it
    /// might have lasted for `longest` (s).
    pub fn note(&mut self, length: f64, met: bool, longest: f64) {
        if !met {
            if length >= LEAST * self.reach {
                self.reach *= GROWTH;
            }
        } else if length > 0.0 {
            self.reach = (FLIGHTS * length).max(LEAST * self.reach.min(longest));
        }
    }
}

#[cfg(test)]
mod tests;
