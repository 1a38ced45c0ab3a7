//! The observers of the steps of a run: judge and recorder.

use super::divergence::{Diverged, Divergence};
use super::{Judging, Recording};
use crate::error::Result;
use crate::scheme::Stepper;
use crate::step::QuietSteps;
use crate::time::TimeGrid;

/// Maximum number of steps between two reports of progress.
const PROGRESS_STRIDE: u64 = 1 << 14;

/// At the beginning reports come more often: one part in this many of the steps so far lies between
/// two, since a step may take a nanosecond or a second.
const PROGRESS_SHARE: u64 = 8;

/// The judge and the recorder of a run. Steps of one degree of freedom between two contacts are
/// passed to them in groups, if that is faster.
pub(super) struct Observers<J: Judging, R: Recording> {
    pub judge: J::Judge,
    pub recorder: R::Recorder,
    /// Steps that have not been passed on yet; `None` where each step is passed on at once.
    quiet: Option<QuietSteps>,
}

impl<J: Judging, R: Recording> Observers<J, R> {
    /// The observers of a run by `stepper`.
    pub fn new(judge: J::Judge, recorder: R::Recorder, stepper: &Stepper) -> Self {
        let together = J::batches_quiet_steps(&judge).unwrap_or(!R::ROWLESS);
        let quiet = (together && stepper.is_line()).then(|| QuietSteps::new(stepper.scene().walls.len()));
        Self { judge, recorder, quiet }
    }

    /// Makes the steps of `grid`, or as many as it takes the exact scheme to reach its end, calling
    /// `progress` with the time (s) now and then. Returns where the run diverged, which ends it.
    pub fn follow_to_end(
        &mut self,
        stepper: &mut Stepper,
        grid: &TimeGrid,
        divergence: &mut Divergence,
        progress: &mut dyn FnMut(f64),
    ) -> Result<Option<Diverged>> {
        let exact = stepper.scheme().is_exact();
        let (mut count, mut report) = (0, 1);
        let diverged = loop {
            let (made, time) = match self.follow(stepper, grid.steps - count.min(grid.steps)) {
                Ok(made) => made,
                Err(error) => break Some(divergence.overflow(&error).ok_or(error)?),
            };
            count += made;
            if let Some(diverged) = divergence.at(time, stepper.velocity()) {
                break Some(diverged);
            }
            if count >= report {
                report = count + (count / PROGRESS_SHARE).clamp(1, PROGRESS_STRIDE);
                progress(time);
            }
            let ended = if exact { time >= grid.end } else { count >= grid.steps };
            if ended {
                break None;
            }
        };
        self.catch_up();
        Ok(diverged)
    }

    /// Makes the next step, or several between two contacts but at most `most`; returns how many
    /// were completed, and the time reached, s.
    #[inline(always)]
    pub fn follow(&mut self, stepper: &mut Stepper, most: u64) -> Result<(u64, f64)> {
        let Some(quiet) = &mut self.quiet else {
            let index = stepper.index();
            let step = stepper.step()?;
            J::observe(&mut self.judge, &step);
            R::observe(&mut self.recorder, &step);
            let end = step.end;
            return Ok((stepper.index() - index, end));
        };
        let made = stepper.advance_quiet_into(quiet, most)?;
        if made > 0 {
            if quiet.is_full() {
                self.catch_up();
            }
            return Ok((made, stepper.time()));
        }
        let index = stepper.index();
        let step = stepper.step()?;
        let end = step.end;
        if !quiet.take(&step) {
            self.catch_up();
            J::observe(&mut self.judge, &step);
            R::observe(&mut self.recorder, &step);
        } else if quiet.is_full() {
            self.catch_up();
        }
        Ok((stepper.index() - index, end))
    }

    /// Passes on the steps that have not been passed on yet.
    fn catch_up(&mut self) {
        if let Some(quiet) = self.quiet.as_mut().filter(|quiet| quiet.len() > 0) {
            J::observe_quiet(&mut self.judge, quiet);
            R::observe_quiet(&mut self.recorder, quiet);
            quiet.clear();
        }
    }
}
