//! The caller names an error instead of a step; scheme and step that keep it are found.

mod coarse;
mod horizon;
mod judged;
mod outcome;
mod refine;
mod target;

pub use coarse::CoarseGrid;
pub use horizon::foresee;
pub use outcome::{Accuracy, AccuracyOf, JudgedBy, Level, Outcome, StepPairs, WholeError};
pub use target::{Against, MOST_STEPS, Target, most_steps};

use super::change::Change;
use super::choice::{self, Choice};
use super::exact::replay;
use super::horizon::Growth;
use crate::error::{Error, Result};
use crate::run::{Options, run_with_progress};
use crate::scene::Scene;
use crate::scheme::{Scheme, Stepper};
use crate::time::TimeOptions;
use judged::{Judged, exact, unchecked};
use refine::{Refined, refine};

/// Finds scheme and step for `target` on `scene`. `progress` is called with the time (s) that the
/// current run has reached.
///
/// # Errors
/// [`Error::Invalid`] for a request that makes no sense, [`Error::Inaccurate`] if even the first
/// run would take more steps than allowed, and the errors of the last run. A tolerance that was not
/// reached is not an error here: see [`Outcome::shortfall`].
pub fn reach(scene: &Scene, target: &Target, progress: &mut dyn FnMut(f64)) -> Result<Outcome> {
    target.validate()?;
    scene.validate()?;
    let chosen = match target.method {
        Some(method) => Choice { method, reason: "asked for".to_owned() },
        None => choice::for_error(scene, &exact(scene, target.time)),
    };
    let method = chosen.method;
    // A penalty run moves between springs, and so does its reference; the exact scheme follows
    // linear springs too.
    let model = Stepper::new(scene, &method, scene.duration)?.scene().clone();
    let coarse = CoarseGrid::of(&model, &target.time)?;
    let growth = Growth::affordable(&model);
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

/// The exact motion, compared with the exact motion computed with other roundings.
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

/// Assembles the result. A run that was judged only up to the horizon is repeated over the whole
/// duration.
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
    let stepping = !method.scheme.is_exact();
    let until_s = judged.scene.duration;
    let (reached, quantity) = refined.worst;
    let step_of = |level: u32| stepping.then(|| judged.coarse.options(level, &target.time).step);
    let perturbed = match (refined.kept && growth.is_none(), refined.judged_by) {
        (true, JudgedBy::Halving) => horizon::perturbed(judged, &method, target, refined.level, &refined.run)?,
        _ => None,
    };
    let shortfall = if !refined.kept {
        // Where all runs are refuted, no error can be stated.
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
        let time = if stepping { judged.coarse.options(refined.level, &target.time) } else { target.time };
        let options = Options::new(time);
        run_with_progress(scene, &method, &options, progress)?
    } else {
        refined.run
    };
    let accuracy = Accuracy {
        tolerance: target.tolerance,
        of: AccuracyOf::Motion,
        reached,
        quantity,
        until_s: perturbed.unwrap_or(until_s),
        growth,
        judged_by: refined.judged_by,
        step_s: step_of(refined.level),
        sufficient_step_s: if refined.kept { step_of(refined.sufficient) } else { None },
        total_steps: refined.levels.iter().map(|l| l.steps).sum(),
        levels: refined.levels,
        pairs: None,
        whole: None,
        start_scatter: None,
    };
    Ok(Outcome { method, reason, run, accuracy, shortfall })
}
