//! What was reached, and how.

use crate::error::Error;
use crate::run::Run;
use crate::scheme::Method;
use serde::Serialize;
use std::fmt;

/// How the error of a result was judged.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum JudgedBy {
    /// Against the exact motion.
    ExactMotion,
    /// By halving the step: two halvings in succession each changed the result by less than a
    /// quarter of the tolerance.
    Halving,
    /// The result is the exact motion; it was compared with the exact motion computed with other
    /// roundings.
    OtherRounding,
    /// By the part of the step in the errors of means over realisations of the random loads
    /// ([`StepSearch`](crate::study::realisations::StepSearch)).
    Realisations,
}

/// What an accuracy is one of.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum AccuracyOf {
    /// Of one motion: its displacement, and what the walls receive from it.
    Motion,
    /// Of the means over realisations: work rates, mean forces and RMS forces.
    Means,
}

/// The realisations by which a step was judged.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize)]
#[non_exhaustive]
pub struct StepPairs {
    /// How many were run with the step and with half of it.
    pub count: u64,
    /// Whether the interval of the change leaves out 0.
    pub seen: bool,
}

/// The largest error of a mean with all its parts: start, step, modes and sampling.
#[derive(Debug, Clone, PartialEq, Serialize)]
#[non_exhaustive]
pub struct WholeError {
    /// As a share of the mean.
    pub share: f64,
    /// Which mean.
    pub quantity: String,
}

/// One run of a refinement.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Level {
    /// Its step, s.
    pub step_s: f64,
    /// Its steps.
    pub steps: u64,
    /// Its error, or its change from the level before; `None` for the first level where levels are
    /// compared with each other, and for a run that failed. Over realisations the most that the
    /// part of the step may be.
    pub error: Option<f64>,
    /// Why the run failed, if it did.
    pub failure: Option<String>,
}

/// What was reached, and how.
#[derive(Debug, Clone, PartialEq, Serialize)]
#[non_exhaustive]
pub struct Accuracy {
    /// The error asked for.
    pub tolerance: f64,
    /// What it is an error of.
    pub of: AccuracyOf,
    /// The error of the result or, by halving, the last change; over realisations the most that
    /// the part of the step may be of the mean, by its 95 % interval; infinite if nothing could be
    /// compared.
    pub reached: f64,
    /// The quantity with the largest error, to which `reached` belongs.
    pub quantity: String,
    /// Time up to which the error was judged, s: the end, or the horizon of predictability.
    pub until_s: f64,
    /// Largest growth of a small change of the start up to then; `None` where it is not known.
    pub growth: Option<f64>,
    /// How it was judged.
    pub judged_by: JudgedBy,
    /// The step of the result, s; `None` for the exact scheme.
    pub step_s: Option<f64>,
    /// The coarsest step tried that keeps the tolerance, s. Where the error is judged by halving,
    /// its run lies within half the tolerance of the result.
    pub sufficient_step_s: Option<f64>,
    /// The runs of the refinement, coarse to fine.
    pub levels: Vec<Level>,
    /// Steps of all these runs together.
    pub total_steps: u64,
    /// The pairs of runs behind `reached`; `None` unless realisations are judged.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub pairs: Option<StepPairs>,
    /// The largest error of a mean that counts with all its parts, of which a search keeps those of
    /// the step and of sampling; `None` unless realisations are judged.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub whole: Option<WholeError>,
    /// Standard deviation of the velocities of the start, m/s, where a case without anything random
    /// was given one ([`Case::with_scattered_start`](crate::case::Case::with_scattered_start)), as
    /// its means are those over starts that nobody can tell apart.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub start_scatter: Option<f64>,
}

/// The result; it is returned even if it falls short of the tolerance.
#[derive(Debug, Clone)]
#[non_exhaustive]
pub struct Outcome {
    /// The method that made it.
    pub method: Method,
    /// Why this method, in a sentence.
    pub reason: String,
    /// The run, over the whole duration.
    pub run: Run,
    /// What was reached.
    pub accuracy: Accuracy,
    /// [`Error::Inaccurate`] or [`Error::Unpredictable`] where less was reached than asked for.
    pub shortfall: Option<Error>,
}

impl fmt::Display for Accuracy {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        if let Some(StepPairs { count, seen }) = self.pairs {
            write!(
                f,
                "asked for {:e}: the part of the step {:.3e} s is {}seen, at most {:.1e} ({}), by {count} pairs of \
                 realisations with it and with half of it; {:.1e} steps in all",
                self.tolerance,
                self.step_s.unwrap_or(0.0),
                if seen { "" } else { "not " },
                self.reached,
                self.quantity,
                self.total_steps as f64
            )?;
            return match &self.whole {
                Some(WholeError { share, quantity }) if *share > self.tolerance => write!(
                    f,
                    "; with what start and modes may add, which are not searched, the largest error is {share:.1e} \
                     ({quantity})"
                ),
                _ => Ok(()),
            };
        }
        let how = match self.judged_by {
            JudgedBy::ExactMotion => "against the exact motion",
            JudgedBy::Halving => "by halving the step",
            JudgedBy::OtherRounding => "the exact motion, against itself with other roundings",
            JudgedBy::Realisations => "over realisations",
        };
        write!(
            f,
            "asked for {:e}, reached {:.1e} ({}) up to t = {:.4} s, {how}",
            self.tolerance, self.reached, self.quantity, self.until_s
        )?;
        if let Some(step) = self.step_s {
            write!(f, "; step {step:.3e} s, {} steps in {} runs", self.total_steps, self.levels.len())?;
        }
        match self.sufficient_step_s {
            Some(step) if self.step_s.is_some_and(|s| s < 0.75 * step) => write!(f, "; {step:.3e} s would suffice"),
            _ => Ok(()),
        }
    }
}
