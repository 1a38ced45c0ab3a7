//! The observers of the steps of a run: judge and recorder.

use super::{Judging, Recording};
use crate::error::Result;
use crate::scheme::Stepper;
use crate::step::QuietSteps;

/// The judge and the recorder of a run. Steps of one degree of freedom between two contacts are
/// passed to them in groups, if that is faster.
pub(super) struct Observers<J: Judging, R: Recording> {
    pub judge: J::Judge,
    pub recorder: R::Recorder,
    /// Steps that have not been passed on yet; `None` where each step is passed on at once.
    calm: Option<QuietSteps>,
}

impl<J: Judging, R: Recording> Observers<J, R> {
    /// The observers of a run by `stepper`.
    pub fn new(judge: J::Judge, recorder: R::Recorder, stepper: &Stepper) -> Self {
        let together = J::batches_quiet_steps(&judge).unwrap_or(!R::ROWLESS);
        let calm = (together && stepper.is_line()).then(|| QuietSteps::new(stepper.scene().walls.len()));
        Self { judge, recorder, calm }
    }

    /// Makes the next step, or several between two contacts but at most `most`; returns how many
    /// were completed, and the time reached, s.
    #[inline(always)]
    pub fn follow(&mut self, stepper: &mut Stepper, most: u64) -> Result<(u64, f64)> {
        let Some(calm) = &mut self.calm else {
            let index = stepper.index();
            let step = stepper.step()?;
            J::observe(&mut self.judge, &step);
            R::observe(&mut self.recorder, &step);
            let end = step.end;
            return Ok((stepper.index() - index, end));
        };
        let made = stepper.advance_quiet_into(calm, most)?;
        if made > 0 {
            if calm.is_full() {
                self.catch_up();
            }
            return Ok((made, stepper.time()));
        }
        let index = stepper.index();
        let step = stepper.step()?;
        let end = step.end;
        if !calm.take(&step) {
            self.catch_up();
            J::observe(&mut self.judge, &step);
            R::observe(&mut self.recorder, &step);
        } else if calm.is_full() {
            self.catch_up();
        }
        Ok((stepper.index() - index, end))
    }

    /// Passes on the steps that have not been passed on yet.
    pub fn catch_up(&mut self) {
        if let Some(calm) = self.calm.as_mut().filter(|calm| calm.len() > 0) {
            J::observe_quiet(&mut self.judge, calm);
            R::observe_quiet(&mut self.recorder, calm);
            calm.clear();
        }
    }
}
