//! The checks of a study of realisations: its first realisations again with half the step, and with
//! more modes.

use super::repeats::Repeats;
use crate::error::{Error, Result};
use crate::study::realisations::{Check, MOST_CHECKED, Realisation, Refined};
use crate::study::truncation::more_modes;
use std::ops::RangeInclusive;

/// The checks that were made, and what kept others from being made, in sentences.
#[derive(Default)]
pub struct ErrorChecks {
    pub made: Vec<Check>,
    pub failures: Vec<String>,
}

impl ErrorChecks {
    /// The checks of a study of `count` realisations; none for a single one, whose differences have
    /// no interval.
    pub fn of(repeats: &Repeats<'_>, count: u64) -> Result<Self> {
        let mut checks = Self::default();
        let numbers = 1..=count.min(MOST_CHECKED);
        if count > 1 {
            checks.halve_step(repeats, numbers.clone())?;
            checks.add_modes(repeats, numbers)?;
        }
        Ok(checks)
    }

    /// By half the step, of a scheme that has one.
    fn halve_step(&mut self, repeats: &Repeats<'_>, numbers: RangeInclusive<u64>) -> Result<()> {
        let Some(order) = repeats.method.scheme.entry().order else { return Ok(()) };
        let (what, step_s) = ("half the step", 0.5 * repeats.run.grid.step);
        self.add(repeats, what, Refined::HalfStep { step_s, order }, repeats.run(what, numbers, step_s))
    }

    /// By twice the modes, of a case that leaves some out.
    fn add_modes(&mut self, repeats: &Repeats<'_>, numbers: RangeInclusive<u64>) -> Result<()> {
        let case = repeats.case;
        let Some(truncated) = &case.truncated else { return Ok(()) };
        let Some(modes) = more_modes(&truncated.reduction) else { return Ok(()) };
        let what = format!("{modes} modes");
        let scene = |number: u64| {
            let realisation = case.realisation(number)?;
            Ok(realisation.truncated.as_ref().unwrap_or(truncated).whole.cut(modes)?.scene)
        };
        let members =
            scene(1).and_then(|like| repeats.run_scenes(&what, numbers, repeats.run.grid.step, (&scene, &like)));
        let refined = Refined::MoreModes { modes: [truncated.reduction.modes.count(), modes] };
        self.add(repeats, &what, refined, members)
    }

    /// Adds a check, with `what` refined, or the reason why it failed; refutes the command where
    /// the judge refutes one of its runs.
    fn add(
        &mut self,
        repeats: &Repeats<'_>,
        what: &str,
        refined: Refined,
        members: Result<Vec<Realisation>>,
    ) -> Result<()> {
        match members {
            Err(Error::Stopped) => return Err(Error::Stopped),
            Err(error) => self.failures.push(format!("the check of the means with {what} failed: {error}")),
            Ok(members) => {
                for member in &members {
                    repeats.ui.refute(&format!("realisation {} with {what}", member.number), &member.findings);
                }
                self.made.push(Check::new(refined, members));
            }
        }
        Ok(())
    }
}
