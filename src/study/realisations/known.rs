//! Realisations that have been run, by their step.

use super::batch::{Batch, Purpose};
use super::check::Refined;
use super::realisation::Realisation;
use crate::error::Result;

/// Realisations that have been run, by their step, so that none is run twice.
#[derive(Debug, Clone, Default)]
pub struct KnownRealisations {
    /// A step (s), and the realisations from 1 that were run with it.
    steps: Vec<(f64, Vec<Realisation>)>,
}

impl KnownRealisations {
    /// The realisations of `batch`; those that are not known yet are made by `make`, and are known
    /// afterwards, unless they leave out others before them or have other modes.
    ///
    /// # Errors
    /// Those of `make`.
    pub fn complete(
        &mut self,
        batch: &Batch<'_>,
        make: &mut dyn FnMut(&Batch<'_>) -> Result<Vec<Realisation>>,
    ) -> Result<Vec<Realisation>> {
        let (first, last) = (*batch.numbers.start(), *batch.numbers.end());
        let step = batch.step();
        // The same step, asked for in another way, may differ by a rounding.
        let at = self.steps.iter().position(|(known, _)| (known / step - 1.0).abs() < 1e-9);
        let have = at.and_then(|at| self.steps.get(at)).map_or(0, |(_, members)| members.len() as u64);
        if matches!(batch.purpose, Purpose::Check(Refined::MoreModes { .. })) || first > have + 1 {
            return make(batch);
        }
        let missing = if last > have { make(&batch.of(have + 1..=last))? } else { Vec::new() };
        let index = at.unwrap_or(self.steps.len());
        if at.is_none() {
            self.steps.push((step, Vec::new()));
        }
        let Some((_, members)) = self.steps.get_mut(index) else { return Ok(missing) };
        members.extend(missing);
        Ok(members.iter().filter(|member| batch.numbers.contains(&member.number)).cloned().collect())
    }

    /// Steps of all these runs over `duration` (s).
    pub(super) fn total_steps(&self, duration: f64) -> u64 {
        self.steps.iter().map(|(step, members)| (duration / step).round() as u64 * members.len() as u64).sum()
    }
}
