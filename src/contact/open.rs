//! An episode that has not ended.

use crate::step::Contact;

/// An open episode at one wall.
#[derive(Debug, Clone, Copy, Default)]
pub(super) struct OpenEpisode {
    pub first: f64,
    pub last: f64,
    pub steps: u64,
    pub impulse: f64,
    /// ∫ t dp, for the instant of an impact spread over two steps.
    pub moment: f64,
    /// Largest finite force, N; `None` while every step had an impact in it.
    pub peak: Option<f64>,
    /// The middle (s) of the last two parts in which the wall pushed, and its mean force there, N.
    pub forces: [Option<(f64, f64)>; 2],
    /// ẅ over the last of them, m/s², and whether a blow acted at its end.
    pub acceleration: f64,
    pub blown: bool,
    /// Impulse and length of parts too short for a mean force of their own, N s and s.
    pub short: (f64, f64),
    pub approach: f64,
    pub departure: f64,
}

impl OpenEpisode {
    /// An episode that begins at `time` (s), at which the wall is approached with `approach` (m/s).
    #[inline]
    pub fn new(time: f64, approach: f64) -> Self {
        // Without the sign of a rate of −0.
        Self { first: time, last: time, approach: approach + 0.0, ..Self::default() }
    }

    /// The contact at `wall`, whose impulses have this sign: an impact or not, ended or still open.
    pub fn contact(&self, wall: usize, sign: f64, impact: bool, ended: bool) -> Contact {
        let (start, end) = if impact {
            let mean = self.moment / self.impulse;
            (mean, mean)
        } else {
            (self.first, self.last)
        };
        let (impulse, length) = self.short;
        let short = (length > 0.0).then(|| impulse / length);
        Contact {
            wall,
            start,
            end: ended.then_some(end),
            impulse: sign * self.impulse,
            peak_force: if impact { None } else { self.peak.or(short) },
            approach_speed: self.approach,
            departure_speed: ended.then_some(self.departure),
        }
    }
}
