//! Realisations of a case, run on all cores with the rows of its first run.

use crate::case::Case;
use crate::cli::estimate::DurationEstimate;
use crate::cli::ui::Ui;
use crate::error::Result;
use crate::run::{Options, Run};
use crate::scene::Scene;
use crate::scheme::Method;
use crate::study::realisations::{Realisation, realisations};
use crate::time::TimeOptions;
use std::num::NonZero;
use std::ops::RangeInclusive;

/// A case and its run, which is repeated.
#[derive(Clone, Copy)]
pub struct Repeats<'a> {
    pub case: &'a Case,
    /// The first realisation.
    pub run: &'a Run,
    pub method: &'a Method,
    pub ui: &'a Ui,
}

impl Repeats<'_> {
    /// Runs the realisations `numbers` of the case with steps of `step` (s); what the progress
    /// shows is called `label`.
    pub fn run(&self, label: &str, numbers: RangeInclusive<u64>, step: f64) -> Result<Vec<Realisation>> {
        let case = self.case;
        let scene = |number: u64| Ok(case.realisation(number)?.scene);
        self.run_scenes(label, numbers, step, (&scene, &case.scene))
    }

    /// The same of other scenes: `scene` makes the scene of each, and `like` is one of them.
    pub fn run_scenes(
        &self,
        label: &str,
        numbers: RangeInclusive<u64>,
        step: f64,
        (scene, like): (&(dyn Fn(u64) -> Result<Scene> + Sync), &Scene),
    ) -> Result<Vec<Realisation>> {
        let count = (numbers.end() + 1).saturating_sub(*numbers.start()) as f64;
        let cores = std::thread::available_parallelism().map_or(1, NonZero::get) as f64;
        let estimate = DurationEstimate::of_run(like, self.method, step).times(count / cores.min(count.max(1.0)));
        // The rows of the first run.
        let sample = Some(self.run.grid.row_spacing());
        let options = Options::new(TimeOptions { step, sample, ..self.case.time });
        self.ui.with_estimate(label, estimate, |bar| {
            realisations(numbers, scene, self.method, &options, &mut |done| bar.set_share(done))
        })
    }
}
