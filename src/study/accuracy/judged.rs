//! What a refinement is judged on: a scene up to its horizon, and its exact motion.

use super::CoarseGrid;
use crate::error::Result;
use crate::run::{Options, Run, run};
use crate::scene::Scene;
use crate::scheme::Scheme;
use crate::study::change::Change;
use crate::study::exact::affordable;
use crate::time::TimeOptions;

/// The exact motion of `scene` at the rows of `time`; an error where it takes too many events or
/// the judge refutes it.
pub(super) fn exact(scene: &Scene, time: TimeOptions) -> Result<Run> {
    affordable(scene)?;
    unchecked(scene, time)?.unrefuted()
}

/// The same, without the judge's verdict.
pub(super) fn unchecked(scene: &Scene, time: TimeOptions) -> Result<Run> {
    run(scene, &Scheme::Event, &Options::new(time))
}

/// What is judged: the scene up to the horizon.
#[derive(Debug)]
pub(super) struct Judged {
    pub scene: Scene,
    /// The scene as the scheme sees it: a penalty's walls are springs.
    pub model: Scene,
    pub coarse: CoarseGrid,
    /// Start of the window for statistics, s.
    pub from: f64,
}

impl Judged {
    pub fn change(&self, run: &Run, against: &Run) -> Change {
        Change::of_runs(&self.model, run, against, self.scene.duration)
    }

    pub fn time(&self, time: &TimeOptions) -> TimeOptions {
        TimeOptions { statistics_from: self.from, ..*time }
    }
}
