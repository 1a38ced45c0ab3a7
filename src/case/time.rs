//! Reads the table `[time]`: step, recording and statistics.

use super::Case;
use super::builder::Builder;
use super::value::Section;
use crate::error::{Result, Subject};
use crate::scene::{System, positive};
use crate::time::TimeOptions;
use std::f64::consts::TAU;
use toml::Spanned;

/// The largest step of all, s: impacts of tubes in their supports, of some kHz, are seen with it.
const LARGEST: f64 = 5e-5;

impl Builder<'_> {
    /// The end of the run, s. It is checked at once: random loads, which are made up to it, would
    /// be blamed for one that is none.
    pub fn end_of_run(&mut self, time: &Section<'_>) -> Result<f64> {
        let end = self.required("duration", time, "end");
        positive("duration", end).map_err(|error| self.at_key(error)).map(|()| end)
    }

    /// The table `[time]` of a run of `duration` (s); where it gives no step it has one for now.
    pub fn time(&mut self, time: &Section<'_>, duration: f64, sectors: usize) -> TimeOptions {
        TimeOptions {
            step: self.optional("step", time, "step").unwrap_or(0.5 * duration),
            sample: self.optional("sample", time, "sample"),
            statistics_from: self.optional("statistics_from", time, "statistics_from").unwrap_or(0.0),
            force_averaging: self
                .optional("force_averaging", time, "force_averaging")
                .unwrap_or(TimeOptions::FORCE_AVERAGING),
            sectors,
        }
    }

    /// Gives the case of a `file` without a step that which its modes, or its one degree of
    /// freedom, need.
    pub fn choose_step(&self, file: &Section<'_>, case: &mut Case) -> Result<()> {
        let time = file.required_section("time");
        if time.get("step").is_some() {
            return Ok(());
        }
        let step = for_modes(&case.scene.system).ok_or_else(|| {
            let help = "expected step = a number above 0, in s; a structure in modes, `modes` in [system], does \
                        without it";
            self.source.error(time.span.clone(), "`step` is missing in `time`", help)
        })?;
        case.time.step = step.min(0.5 * case.scene.duration);
        case.written.chosen_step = Some(case.time.step);
        Ok(())
    }

    /// The times at which the states of the probes are asked for.
    pub fn output_times(&mut self, time: &Section<'_>) -> Vec<f64> {
        let times = time.numbers("output_times").map(Spanned::into_inner).unwrap_or_default();
        let value = |index| Subject::of("output times").value(index);
        times.iter().enumerate().map(|(index, time)| self.number(value(index), time)).collect()
    }
}

/// The largest step of one digit, s, that is at most 50 µs and a tenth of the period of the
/// fastest mode. `None` for a structure with coupled degrees of freedom, whose fastest motion may
/// be that of its smallest elements.
fn for_modes(system: &System) -> Option<f64> {
    let in_modes = match system {
        System::Oscillator(_) => true,
        System::Structure(structure) => structure.uncoupled_squares().is_some(),
    };
    in_modes.then(|| {
        let [_, fastest] = system.frequencies();
        one_digit((TAU / (10.0 * fastest)).min(LARGEST))
    })
}

/// The largest number of one digit that is at most `most`.
fn one_digit(most: f64) -> f64 {
    // A quotient just below a whole number is that number; text, since 5 times 1e-5 is not 5e-5.
    let exponent = most.log10().floor();
    let digit = (most / 10f64.powf(exponent) * (1.0 + 1e-9)).floor();
    format!("{digit}e{exponent}").parse().unwrap_or(most)
}

#[cfg(test)]
mod tests {
    use super::{for_modes, one_digit};
    use crate::scene::{Oscillator, System};

    #[test]
    fn steps_have_one_digit_and_are_a_tenth_of_the_period_or_less() {
        assert_eq!([5e-5, 4.99e-5, 1e-5, 1.9e-6, 9.99e-7].map(one_digit), [5e-5, 4e-5, 1e-5, 1e-6, 9e-7]);
        // Periods of 2π, 2π/1e6 s, and none.
        let step = |stiffness: f64| for_modes(&System::Oscillator(Oscillator { mass: 1.0, damping: 0.0, stiffness }));
        assert_eq!([1.0, 1e12, 0.0].map(step), [Some(5e-5), Some(6e-7), Some(5e-5)]);
    }
}
