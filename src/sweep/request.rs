//! The request of a sweep.

use super::axis::Axis;
use super::follow::Follow;
use super::layout::Layout;
use super::measure::Measure;
use super::picture::Picture;
use super::random::Random;
use super::sample::Samples;
use super::target::Target;
use crate::case::{CaseFile, KeyValue};
use crate::error::{Error, Result, names};
use crate::study::realisations::RealisationCount;

/// The duration of a row, and the window of its measures.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Window {
    /// The case's `time.end` and `time.statistics_from`.
    Case,
    /// Numbers of forcing periods before the window, and in it.
    Periods {
        /// Before the window.
        settle: u32,
        /// In the window, one or more.
        keep: u32,
    },
    /// Times before the window, and in it.
    Seconds {
        /// Before the window, s.
        settle: f64,
        /// In the window, s, above 0.
        keep: f64,
    },
}

/// The engine that computes rows.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
#[non_exhaustive]
pub enum Kernel {
    /// One stepper per row: for every case and scheme.
    #[default]
    Scalar,
    /// [`batch`](crate::batch): oscillators side by side, by the scheme `event`, many times as
    /// fast. Its results differ from the scalar ones in the last digits, and in chaotic motion in
    /// all digits; so it is used only on request.
    Batch,
}

names!(Kernel: "kernel", Scalar => "scalar", Batch => "batch");

/// Default number of instants of a row that are kept: the last ones.
pub const MOST_SAMPLES: usize = 200;

/// Default number of rows of the batch engine that are judged: each of them is computed once more,
/// by the scheme `event`.
const JUDGED_OF_BATCH: u64 = 16;

/// A sweep: one case, the values of it that vary, and the measures computed for every row.
///
/// ```
/// use signorini::case::CaseFile;
/// use signorini::sweep::{Axis, Follow, Measure, Window, Sweep};
///
/// // The largest displacement over the frequency of the load, by rising frequencies, the state
/// // carried on.
/// let sweep = Sweep::new(CaseFile::embedded("rigid-walls-sine")?)
///     .set("wall.*.restitution", 0.8)?
///     .vary(Axis::linear("load.1.harmonic.frequency", 4.0, 5.0, 3)?.followed(Follow::Up))
///     .over(Window::Periods { settle: 20, keep: 10 })
///     .by("event")
///     .measure([Measure::DisplacementMax, Measure::Contacts]);
/// let plan = sweep.plan()?;
/// let rows = plan.rows(2)?; // on two threads; the numbers do not depend on that
/// assert_eq!(rows.len(), 3);
/// assert_eq!(plan.header()[..4], ["row", "direction", "frequency_Hz", "status"]);
/// assert!(rows.iter().all(|row| row.measures[0].is_some_and(|u| u <= 5e-3 * (1.0 + 1e-12))));
/// # Ok::<(), signorini::Error>(())
/// ```
#[derive(Debug, Clone)]
pub struct Sweep {
    pub(super) case: CaseFile,
    pub(super) axes: Vec<Axis>,
    pub(super) layout: Layout,
    pub(super) window: Window,
    pub(super) scheme: Option<String>,
    pub(super) measures: Vec<Measure>,
    pub(super) samples: Option<Samples>,
    pub(super) most_samples: usize,
    pub(super) judged: Option<u64>,
    pub(super) kernel: Kernel,
    pub(super) realisations: Option<RealisationCount>,
    pub(super) title: String,
    pub(super) picture: Picture,
}

impl Sweep {
    /// A sweep of `case` in which nothing varies yet.
    #[must_use]
    pub fn new(case: CaseFile) -> Self {
        Self {
            title: case.name().to_owned(),
            picture: Picture::default(),
            kernel: Kernel::Scalar,
            case,
            axes: Vec::new(),
            layout: Layout::Grid,
            window: Window::Case,
            scheme: None,
            measures: Vec::new(),
            samples: None,
            most_samples: MOST_SAMPLES,
            judged: None,
            realisations: None,
        }
    }

    /// The same sweep with a value of the case changed for all rows.
    ///
    /// # Errors
    /// As [`CaseFile::set`], and for a key that does not exist.
    pub fn set(mut self, key: &str, value: impl Into<KeyValue>) -> Result<Self> {
        self.case.set(&key.parse()?, &value.into())?;
        Ok(self)
    }

    /// The file of the case, whose values all rows share.
    pub(crate) fn case_file(&mut self) -> &mut CaseFile {
        &mut self.case
    }

    /// True where a row ends with its case, and not after its own settle and keep.
    pub(crate) fn ends_with_case(&self) -> bool {
        self.window == Window::Case
    }

    /// The same sweep with one more axis. Of several, the last one varies fastest from row to row;
    /// a followed axis varies fastest of all.
    #[must_use]
    pub fn vary(mut self, axis: Axis) -> Self {
        self.axes.push(axis);
        self
    }

    /// The same sweep with values drawn at random from the ranges of all its axes.
    #[must_use]
    pub fn drawn(mut self, random: Random) -> Self {
        self.layout = Layout::Random(random);
        self
    }

    /// The same sweep with each axis varied by itself: the case, then each axis at the lower and at
    /// the upper bound of its range, the others as in the case. It gives the effect of each axis on
    /// each measure.
    #[must_use]
    pub fn one_at_a_time(mut self) -> Self {
        self.layout = Layout::OneAtATime;
        self
    }

    /// The same sweep with the design that `word` names in a sweep file.
    pub(super) fn laid_out(self, word: &str) -> Result<Self> {
        let known = ["grid", "one-at-a-time"];
        match (word, self.layout) {
            ("grid", _) => Ok(self),
            ("one-at-a-time", Layout::Random(_)) => {
                Err(Error::invalid("[run] design", "one-at-a-time", "no [random] beside it"))
            }
            ("one-at-a-time", _) => Ok(self.one_at_a_time()),
            _ => {
                let (name, known) = (word.to_owned(), known.map(str::to_owned).to_vec());
                Err(Error::Unknown { kind: "design", name, known })
            }
        }
    }

    /// The same sweep with rows of that duration.
    #[must_use]
    pub fn over(mut self, window: Window) -> Self {
        self.window = window;
        self
    }

    /// The same sweep by a scheme, written as on the command line: `event`,
    /// `moreau-jean:theta=0.6`, `penalty:epsilon=1e-9`. By default, the scheme is the one that
    /// `run` would choose for the case.
    #[must_use]
    pub fn by(mut self, scheme: &str) -> Self {
        self.scheme = Some(scheme.to_owned());
        self
    }

    /// The same sweep with these measures too.
    #[must_use]
    pub fn measure(mut self, measures: impl IntoIterator<Item = Measure>) -> Self {
        for measure in measures {
            if !self.measures.contains(&measure) {
                self.measures.push(measure);
            }
        }
        self
    }

    /// The same sweep with the last `most` instants of that kind of each row.
    #[must_use]
    pub fn sample(mut self, samples: Samples, most: usize) -> Self {
        (self.samples, self.most_samples) = (Some(samples), most);
        self
    }

    /// The same sweep with that number of rows judged step by step, evenly spread over all rows; a
    /// row that violates what its scheme promises has the status `refuted`, and a row that is not
    /// judged the status `unjudged`. By default all rows are judged, of the batch engine 16, which
    /// the scheme `event` computes once more.
    #[must_use]
    pub fn judged(mut self, rows: u64) -> Self {
        self.judged = Some(rows);
        self
    }

    /// Number of rows that are judged.
    pub(super) fn rows_judged(&self) -> u64 {
        let default = if self.kernel == Kernel::Batch { JUDGED_OF_BATCH } else { u64::MAX };
        self.judged.unwrap_or(default)
    }

    /// The same sweep, computed by `kernel`.
    #[must_use]
    pub fn kernel(mut self, kernel: Kernel) -> Self {
        self.kernel = kernel;
        self
    }

    /// The same sweep with every row run under `count` realisations of its random loads, 2 or more,
    /// as [`Case::realisation`](crate::case::Case::realisation) makes them: the same seeds in every
    /// row, so that rows differ by what varies alone.
    #[must_use]
    pub fn realisations(mut self, count: u64) -> Self {
        self.realisations = Some(RealisationCount::Exactly(count));
        self
    }

    /// The same sweep with every row run under as many realisations of its random loads as bring
    /// the 95 % intervals of its work rates (without work, of its mean forces) within the share
    /// `share` of them, but at most `most`, or [`MOST_REALISATIONS`]: six of each row say how many
    /// (Stein), with the same seeds in every row. These measures decide as far as they are asked
    /// for.
    ///
    /// [`MOST_REALISATIONS`]: crate::study::realisations::MOST_REALISATIONS
    ///
    /// # Errors
    /// As [`RealisationCount::new`].
    pub fn until_interval(mut self, share: f64, most: Option<u64>) -> Result<Self> {
        self.realisations = RealisationCount::new(None, Some(share), most, None)?;
        Ok(self)
    }

    /// True if the scheme varies.
    pub(super) fn varies_scheme(&self) -> bool {
        self.axes.iter().flat_map(|axis| &axis.targets).any(|(target, _)| *target == Target::Scheme)
    }

    /// The title.
    #[must_use]
    pub fn title(&self) -> &str {
        &self.title
    }

    /// True if the work rates at supports are kept of each run: depths of a row are those of their
    /// means over the realisations.
    pub(super) fn keeps_work_rates(&self) -> bool {
        let by_mean = [Measure::DepthDeepest, Measure::DepthOneScar];
        self.realisations.is_some() && by_mean.iter().any(|depth| self.measures.contains(depth))
    }

    /// The number of the axis that is followed.
    pub(super) fn followed(&self) -> Option<usize> {
        self.axes.iter().position(|axis| axis.follow != Follow::No)
    }
}
