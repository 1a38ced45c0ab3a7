//! The options of a run besides the scene and the method: its times, and whether it is judged and
//! recorded.

use super::judging::{Judged, Judging, Unjudged};
use super::recording::{Recorded, Recording, Unrecorded};
use crate::error::Result;
use crate::scene::Scene;
use crate::time::{TimeGrid, TimeOptions};

/// The options of a run besides the scene and the method.
///
/// A run is judged and recorded by default. A study that needs only one of the two, or only the
/// state at the end, leaves the other out and saves its time. The result then has no such field
/// full of zeros: it is absent from the type of the [`Run`](crate::Run):
///
/// ```
/// use signorini::{Load, Options, Scene, Scheme, Wall, run};
///
/// let scene = Scene::oscillator(1.0, 0.2, 100.0)
///     .with_wall(Wall::upper("upper", 5e-3))
///     .with_load(Load::harmonic(3.0, 5.0, 0.0));
/// let options = Options::with_step(1e-4);
///
/// let full = run(&scene, &Scheme::Event, &options)?;
/// let judged = run(&scene, &Scheme::Event, &options.unrecorded())?; // residuals, no trajectory
/// // The state at the end, and counters.
/// let bare = run(&scene, &Scheme::Event, &options.unjudged().unrecorded())?;
/// assert_eq!(judged.residuals, full.residuals);
/// assert_eq!(bare.state, full.state);
/// # Ok::<(), signorini::Error>(())
/// ```
///
/// `bare.residuals` would not compile to a number:
///
/// ```compile_fail
/// # use signorini::{Options, Scene, Scheme, run};
/// let options = Options::with_step(1e-4).unjudged();
/// let bare = run(&Scene::oscillator(1.0, 0.0, 1.0), &Scheme::Event, &options).unwrap();
/// println!("{}", bare.residuals.complementarity);
/// ```
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Options<J: Judging = Judged, R: Recording = Recorded> {
    /// Step, rows and the window of the statistics. The exact scheme ignores the step.
    pub time: TimeOptions,
    /// Whether the run is judged.
    pub judge: J,
    /// Whether it is recorded.
    pub record: R,
}

impl Options {
    /// As [`TimeOptions::with_step`]: the exact scheme records 1000 intervals, whatever the step.
    #[must_use]
    pub fn with_step(step: f64) -> Self {
        Self::new(TimeOptions::with_step(step))
    }

    /// A judged and recorded run.
    #[must_use]
    pub fn new(time: TimeOptions) -> Self {
        Self { time, judge: Judged, record: Recorded }
    }
}

impl<J: Judging, R: Recording> Options<J, R> {
    /// These options with a row every `sample` seconds instead of every step.
    #[must_use]
    pub fn with_sample(mut self, sample: f64) -> Self {
        self.time.sample = Some(sample);
        self
    }

    /// These options without the judge: [`Run::residuals`](crate::Run::residuals) is then `()`.
    #[must_use]
    pub fn unjudged(self) -> Options<Unjudged, R> {
        let Self { time, record, .. } = self;
        Options { time, judge: Unjudged, record }
    }

    /// These options without rows, contacts and statistics:
    /// [`Run::trajectory`](crate::Run::trajectory) and [`Run::statistics`](crate::Run::statistics)
    /// are then `()`. (For contacts and statistics with two rows only, give the duration to
    /// [`Options::with_sample`].)
    #[must_use]
    pub fn unrecorded(self) -> Options<J, Unrecorded> {
        let Self { time, judge, .. } = self;
        Options { time, judge, record: Unrecorded }
    }

    /// The steps and rows of a run over `scene`.
    pub(super) fn grid(&self, scene: &Scene, exact: bool) -> Result<TimeGrid> {
        let mut time = self.time;
        if R::ROWLESS && time.sample.is_none() {
            // The maximum number of rows does not apply to a run without rows. A given spacing
            // stays: steps end on its rows.
            time.sample = Some(scene.duration);
        }
        if exact { TimeGrid::exact(scene.duration, &time) } else { TimeGrid::stepping(scene.duration, &time) }
    }
}
