//! An error is named, not a step: the scheme and the step that keep it are found.

mod coarse;
mod horizon;
mod refine;

pub use coarse::CoarseGrid;
pub use horizon::foresee;

use super::change::Change;
use super::choice::{self, Choice};
use super::exact::{affordable, replay};
use super::horizon::Growth;
use crate::error::{Error, Result};
use crate::qp::Backend;
use crate::run::{Options, Run, run, run_with_progress};
use crate::scene::Scene;
use crate::scheme::{Method, Scheme, Stepper};
use crate::time::TimeOptions;
use refine::{Refined, refine};
use serde::Serialize;
use std::fmt;

/// Steps that one run of a refinement may take unless a target says otherwise: seconds of a scalar scheme.
pub const MOST_STEPS: u64 = 1 << 24;

/// What a stepping run is held against.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Against {
    /// The exact motion where there is one, else its own refinements.
    Exact,
    /// Its own refinements only.
    Refinements,
}

/// The error asked for.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Target {
    /// Largest error: of the displacement over the gap scale, and of each wall's numbers in the sense of [`Change`]. Above 0, below 1.
    pub tolerance: f64,
    /// The method to refine; none leaves it to the scene.
    pub method: Option<Method>,
    /// Rows and window for statistics; its step is not used.
    pub time: TimeOptions,
    /// What a stepping run is held against.
    pub against: Against,
    /// Most steps of one run.
    pub most_steps: u64,
}

impl Target {
    /// An error of `tolerance`, by whatever the scene needs, with the rows and the window of `time`.
    #[must_use]
    pub fn new(tolerance: f64, time: TimeOptions) -> Self {
        Self { tolerance, method: None, time, against: Against::Exact, most_steps: MOST_STEPS }
    }

    /// Checks the error asked for.
    ///
    /// # Errors
    /// [`Error::Invalid`] for one that is no share.
    pub fn validate(&self) -> Result<()> {
        if self.tolerance > 0.0 && self.tolerance < 1.0 {
            return Ok(());
        }
        Err(Error::invalid("accuracy", self.tolerance, "a number above 0 and below 1, as a share of the gap"))
    }
}

/// How the error of a result was judged.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum JudgedBy {
    /// Against the exact motion.
    ExactMotion,
    /// By two halvings in succession, each of which changed less than a quarter of the tolerance.
    Halving,
    /// The exact motion itself: against the same with other roundings.
    OtherRounding,
}

/// One run of a refinement.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Level {
    /// Its step, s.
    pub step_s: f64,
    /// Its steps.
    pub steps: u64,
    /// Its error, or the change since the level before it; none for the first level of a run that is held against its refinements, and for
    /// one that failed.
    pub error: Option<f64>,
    /// Why it failed, if it did.
    pub failure: Option<String>,
}

/// What was reached, and how.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Accuracy {
    /// The error asked for.
    pub tolerance: f64,
    /// The error of the result or, by halving, its last change; infinite if nothing could be compared.
    pub reached: f64,
    /// The quantity that `reached` belongs to: the worst of all.
    pub quantity: String,
    /// Time up to which it was judged, s: the end, or the horizon of predictability.
    pub until_s: f64,
    /// Largest growth of a small change of the start up to then; none where it is not known.
    pub growth: Option<f64>,
    /// How it was judged.
    pub judged_by: JudgedBy,
    /// The step of the result, s; none for the exact scheme.
    pub step_s: Option<f64>,
    /// The coarsest step tried that keeps the tolerance, s. Judged by halving it lies within half the tolerance of the result.
    pub sufficient_step_s: Option<f64>,
    /// The runs of the refinement, coarse to fine.
    pub levels: Vec<Level>,
    /// Steps of all of them.
    pub total_steps: u64,
}

/// The result, which is worth having even if it falls short.
#[derive(Debug, Clone)]
pub struct Outcome {
    /// The method that made it.
    pub method: Method,
    /// Why this method, in a sentence.
    pub reason: String,
    /// The run, over the whole duration.
    pub run: Run,
    /// What was reached.
    pub accuracy: Accuracy,
    /// [`Error::Inaccurate`] or [`Error::Unpredictable`] where that is less than was asked for.
    pub shortfall: Option<Error>,
}

/// Finds scheme and step for `target` on `scene`. `progress` hears the time (s) that the run under way has reached.
///
/// # Errors
/// [`Error::Invalid`] for a request that makes no sense, [`Error::Inaccurate`] if the first step would already be one too many, and what
/// the last of the runs reports. A tolerance that was not reached is no error here: see [`Outcome::shortfall`].
pub fn reach(scene: &Scene, target: &Target, progress: &mut dyn FnMut(f64)) -> Result<Outcome> {
    target.validate()?;
    scene.validate()?;
    let chosen = match target.method {
        Some(method) => Choice { method, reason: "asked for".to_owned() },
        None => choice::for_error(scene, &exact(scene, target.time)),
    };
    let method = chosen.method;
    // A penalty's motion is that between its springs; the exact scheme follows those too where they are linear.
    let model = Stepper::with_backend(scene, &method.scheme, scene.duration, method.backend)?.scene().clone();
    let coarse = CoarseGrid::of(&model, &target.time)?;
    let growth = affordable(&model).and_then(|()| Growth::of(&model));
    if let (Scheme::Event, Err(error)) = (method.scheme, &growth) {
        return Err(error.clone());
    }
    let growth = growth.ok();
    let cut = growth.as_ref().and_then(|g| horizon::cut(g, target.tolerance, coarse.sample));
    let judged = Judged {
        scene: scene.clone().with_duration(cut.unwrap_or(scene.duration)),
        model: model.clone().with_duration(cut.unwrap_or(scene.duration)),
        coarse,
        from: if cut.is_none_or(|t| t > target.time.statistics_from) { target.time.statistics_from } else { 0.0 },
    };
    let refined = match method.scheme {
        Scheme::Event => other_rounding(&judged, target)?,
        _ => refine(&judged, &method, target, progress)?,
    };
    let growth = growth.map(|g| g.until(judged.scene.duration));
    let mut outcome = finish(scene, target, chosen, &judged, refined, growth, progress)?;
    horizon::explain(scene, &mut outcome);
    Ok(outcome)
}

/// The exact motion of `scene`, at the rows of `time`, where it can be afforded and the judge has not refuted it.
fn exact(scene: &Scene, time: TimeOptions) -> Result<Run> {
    affordable(scene)?;
    unchecked(scene, time)?.unrefuted()
}

/// The same, whatever the judge says of it.
fn unchecked(scene: &Scene, time: TimeOptions) -> Result<Run> {
    run(scene, &Scheme::Event, &Options::new(time, Backend::Auto))
}

/// What is judged: the scene up to the horizon.
#[derive(Debug)]
struct Judged {
    scene: Scene,
    /// The scene as the scheme sees it.
    model: Scene,
    coarse: CoarseGrid,
    /// Start of the window for statistics, s.
    from: f64,
}

impl Judged {
    fn change(&self, run: &Run, against: &Run) -> Change {
        Change::of_runs(&self.model, run, against, self.scene.duration)
    }

    fn time(&self, time: &TimeOptions) -> TimeOptions {
        TimeOptions { statistics_from: self.from, ..*time }
    }
}

/// The exact motion, held against itself with other roundings.
fn other_rounding(judged: &Judged, target: &Target) -> Result<Refined> {
    let time = judged.time(&TimeOptions { sample: Some(judged.coarse.sample), ..target.time });
    let run = unchecked(&judged.scene, time)?;
    let again = replay(&judged.scene, &run, &time)?;
    let pair = ((&run.trajectory, &run.statistics), (&again.trajectory, &again.statistics));
    let change = Change::between(&judged.model, pair.0, pair.1, judged.scene.duration);
    let worst = change.worst();
    let steps = run.counters.steps;
    let level = Level { step_s: judged.scene.duration, steps, error: Some(worst.0), failure: None };
    Ok(Refined {
        kept: worst.0 <= target.tolerance,
        agrees_until: super::change::agree_until(&judged.scene, &run.trajectory, &again.trajectory, target.tolerance),
        judged_by: JudgedBy::OtherRounding,
        level: 0,
        sufficient: 0,
        levels: vec![level],
        worst,
        run,
    })
}

/// Puts the result together; a run that was judged up to the horizon only is made once more over the whole duration.
fn finish(
    scene: &Scene,
    target: &Target,
    chosen: Choice,
    judged: &Judged,
    refined: Refined,
    growth: Option<f64>,
    progress: &mut dyn FnMut(f64),
) -> Result<Outcome> {
    let Choice { method, reason } = chosen;
    let stepping = method.scheme != Scheme::Event;
    let until_s = judged.scene.duration;
    let (reached, quantity) = refined.worst;
    let step_of = |level: u32| stepping.then(|| judged.coarse.options(level, &target.time).step);
    let perturbed = match (refined.kept && growth.is_none(), refined.judged_by) {
        (true, JudgedBy::Halving) => horizon::perturbed(judged, &method, target, refined.level, &refined.run)?,
        _ => None,
    };
    let shortfall = if !refined.kept {
        // Where all runs are refuted there is no error to speak of.
        Some(refined.run.refuted().unwrap_or(Error::Inaccurate {
            tolerance: target.tolerance,
            reached,
            quantity: quantity.clone(),
            until: refined.agrees_until,
            steps: refined.levels.last().map_or(0, |l| l.steps),
        }))
    } else {
        let horizon = perturbed.unwrap_or(until_s);
        let short = horizon < scene.duration;
        short.then_some(Error::Unpredictable { tolerance: target.tolerance, reached, horizon, end: scene.duration })
    };
    let run = if until_s < scene.duration {
        let time = match stepping {
            true => judged.coarse.options(refined.level, &target.time),
            false => target.time,
        };
        let options = Options::new(time, method.backend);
        run_with_progress(scene, &method.scheme, &options, progress)?
    } else {
        refined.run
    };
    let accuracy = Accuracy {
        tolerance: target.tolerance,
        reached,
        quantity,
        until_s: perturbed.unwrap_or(until_s),
        growth,
        judged_by: refined.judged_by,
        step_s: step_of(refined.level),
        sufficient_step_s: if refined.kept { step_of(refined.sufficient) } else { None },
        total_steps: refined.levels.iter().map(|l| l.steps).sum(),
        levels: refined.levels,
    };
    Ok(Outcome { method, reason, run, accuracy, shortfall })
}

impl fmt::Display for Accuracy {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let how = match self.judged_by {
            JudgedBy::ExactMotion => "against the exact motion",
            JudgedBy::Halving => "by halving the step",
            JudgedBy::OtherRounding => "the exact motion, against itself with other roundings",
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
            Some(step) if self.step_s.is_some_and(|s| s < 0.75 * step) => write!(f, "; {step:.3e} s would do"),
            _ => Ok(()),
        }
    }
}
