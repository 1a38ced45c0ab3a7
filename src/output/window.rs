//! Which stretch of a run a picture shows: the whole and, of a long run, also its last periods.

use super::figure::Figure;
use crate::error::amount;
use crate::run::Run;
use crate::scene::Scene;

/// Most periods that one frame can show so that they can be told apart; beyond that a second frame
/// shows the last ones.
const MOST_PERIODS: f64 = 40.0;
/// Periods of that second frame.
const LAST_PERIODS: f64 = 10.0;
/// Where the response is this many times faster than the load, its period is used instead of the
/// load's.
const FASTER: f64 = 4.0;

/// A stretch of time, s.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Span {
    /// Its beginning.
    pub from: f64,
    /// Its end.
    pub to: f64,
}

impl Span {
    /// True if `time` lies in the stretch; both ends belong to it, and so does a time beyond them
    /// by rounding.
    pub(super) fn holds(&self, time: f64) -> bool {
        let slack = 1e-12 * self.to.abs();
        (self.from - slack..=self.to + slack).contains(&time)
    }
}

/// The least and the largest of `values`; without any, infinities the wrong way round.
pub(crate) fn extent(values: impl Iterator<Item = f64>) -> (f64, f64) {
    values.fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), x| (low.min(x), high.max(x)))
}

/// The stretch shown, and the part of it that is shown a second time.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Window {
    pub whole: Span,
    pub last: Option<Span>,
    periods: Option<f64>,
}

impl Window {
    /// The window over `whole` for a motion like that of `run`, seen at the probe with index
    /// `probe`.
    pub fn new(scene: &Scene, run: Option<&Run>, probe: Option<usize>, whole: Span) -> Self {
        let length = whole.to - whole.from;
        let response = run.zip(probe).and_then(|(run, probe)| response_period(run, probe, whole));
        let period = match (load_period(scene), response) {
            (Some(load), Some(response)) if FASTER * response < load => Some(response),
            (load, response) => load.or(response),
        };
        let long = period.filter(|period| length > MOST_PERIODS * period);
        let last = long.map(|period| Span { from: whole.to - LAST_PERIODS * period, to: whole.to });
        Self { whole, last, periods: long }
    }

    /// The stretch in which single oscillations can be told apart.
    pub fn detail(&self) -> Span {
        self.last.unwrap_or(self.whole)
    }

    /// `figure` over time, with the last periods drawn beside the whole where there are many.
    pub fn over_time(&self, figure: Figure) -> Figure {
        match self.last {
            Some(last) => {
                let whole = format!("{} to {} s", amount(self.whole.from, 4), amount(self.whole.to, 4));
                figure.detail(last.from, last.to, [&whole, &self.last_words()])
            }
            None => figure,
        }
    }

    /// Remark for a picture that shows only the last periods; no-break spaces keep numbers with
    /// their units.
    pub fn words(&self) -> Option<String> {
        self.last.map(|last| {
            let words = self.last_words().replace("Last", "last").replace(" Hz", "\u{a0}Hz");
            format!("{words}, {} to {}\u{a0}s", amount(last.from, 4), amount(last.to, 4))
        })
    }

    fn last_words(&self) -> String {
        let frequency = self.periods.map_or(0.0, |period| 1.0 / period);
        format!("Last {LAST_PERIODS} periods of {} Hz", amount(frequency, 4))
    }
}

/// The period of the slowest harmonic load, s.
fn load_period(scene: &Scene) -> Option<f64> {
    scene.harmonic_frequencies().filter(|frequency| *frequency > 0.0).map(f64::recip).reduce(f64::max)
}

/// The mean time between upward passages of the displacement through its mean, s.
fn response_period(run: &Run, probe: usize, span: Span) -> Option<f64> {
    let column = run.trajectory.displacements().get(probe)?;
    let rows = run.trajectory.time().iter().zip(column).filter(|(t, _)| span.holds(**t));
    let values: Vec<f64> = rows.map(|(_, u)| *u).collect();
    let mean = values.iter().sum::<f64>() / values.len().max(1) as f64;
    let passages = values.windows(2).filter(|pair| matches!(pair, [a, b] if *a < mean && *b >= mean)).count();
    (passages > 1).then(|| (span.to - span.from) / passages as f64)
}
