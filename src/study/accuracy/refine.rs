//! Halves the step until the tolerance is kept.

use super::judged::{Judged, exact};
use super::{Against, JudgedBy, Level, Target};
use crate::error::{Error, Result};
use crate::run::{Options, Run, run_with_progress};
use crate::scheme::Method;
use crate::study::change::agree_until;
use crate::time::TimeOptions;

/// Largest change by a halving, as a share of the tolerance, and the number of successive halvings
/// that must stay below it. One halving is not enough: over random trials the true error exceeded
/// the last change in 25 to 57 of 100, by up to 3.8 times.
const QUIET: f64 = 0.25;
const QUIET_HALVINGS: usize = 2;

/// The ratios of two successive changes by which the runs are taken to converge with order 2, which
/// gives 4: orders of 1.5 to 2.5. With two such ratios in succession one change below [`QUIET`] is
/// enough: the finest run then errs by about a third of it.
const ORDER_2: std::ops::RangeInclusive<f64> = 2.8..=5.7;

/// Number of levels before a trend is looked for: the coarsest steps may not see the motion at all.
const FEWEST_LEVELS: usize = 8;

/// Number of last levels from which the trend is taken.
const TREND: usize = 3;

/// An error above this is as large as the quantities compared.
const LOST: f64 = 0.1;

/// A coarser step is called sufficient if its run lies within this share of the tolerance from the
/// finest.
const SUFFICIENT: f64 = 0.5;

/// Outcome of a refinement.
#[derive(Debug)]
pub(super) struct Refined {
    /// The finest run.
    pub run: Run,
    /// How often its step was halved.
    pub level: u32,
    /// The level of the coarsest run that keeps the tolerance.
    pub sufficient: u32,
    /// All levels.
    pub levels: Vec<Level>,
    /// The last error or change, and the quantity it belongs to.
    pub worst: (f64, String),
    /// True if the tolerance is kept.
    pub kept: bool,
    /// Time (s) up to which the displacement of the finest run keeps the tolerance.
    pub agrees_until: f64,
    pub judged_by: JudgedBy,
}

/// True if the errors so far are as large as the motion and do not decrease: where a small change
/// grows exponentially, each halving of the step only keeps the motion for a little longer.
fn leads_nowhere(levels: &[Level]) -> bool {
    let errors: Vec<f64> = levels.iter().rev().map_while(|level| level.error).collect();
    let (Some(&last), Some(&before)) = (errors.first(), errors.get(TREND)) else { return false };
    errors.len() >= FEWEST_LEVELS && last > LOST && last > 0.5 * before
}

/// True if the changes by the last three halvings fall as those of order 2.
fn converges(levels: &[Level]) -> bool {
    let changes: Vec<f64> = levels.iter().rev().map_while(|level| level.error).take(3).collect();
    changes.len() == 3 && changes.windows(2).all(|pair| ORDER_2.contains(&(pair[1] / pair[0])))
}

/// Halves the step of `method` until the tolerance is kept, until the next run would take too many
/// steps, or until the runs so far show that the tolerance would still be missed by then. Where the
/// judge refutes every run, the last of them is returned as not kept; its findings say why.
///
/// # Errors
/// The error of the last run, where every run failed.
pub(super) fn refine(
    judged: &Judged,
    method: &Method,
    target: &Target,
    progress: &mut dyn FnMut(f64),
) -> Result<Refined> {
    refine_by(judged, target, &mut |options| run_with_progress(&judged.scene, method, options, progress))
}

/// The same, with runs made by `make`.
fn refine_by(judged: &Judged, target: &Target, make: &mut dyn FnMut(&Options) -> Result<Run>) -> Result<Refined> {
    let rows = TimeOptions { sample: Some(judged.coarse.sample), ..judged.time(&target.time) };
    let reference = match target.against {
        Against::Exact => exact(&judged.model, rows).ok(),
        Against::Refinements => None,
    };
    let judged_by = if reference.is_some() { JudgedBy::ExactMotion } else { JudgedBy::Halving };
    let share = if reference.is_some() { 1.0 } else { QUIET };
    let mut levels = Vec::new();
    let mut done: Vec<(u32, Run)> = Vec::new();
    let mut refuted: Option<(u32, Run)> = None;
    let mut worst = (f64::INFINITY, "nothing to compare".to_owned());
    let (mut kept, mut quiet, mut failure) = (false, 0, None);
    for level in 0..u64::BITS {
        let steps = judged.coarse.steps.saturating_mul(1 << level);
        if steps > target.most_steps {
            break;
        }
        let time = judged.time(&judged.coarse.options(level, &target.time));
        let options = Options::new(time);
        let made = make(&options).and_then(|run| match run.refuted() {
            Some(error) => {
                refuted = Some((level, run));
                Err(error)
            }
            None => Ok(run),
        });
        let run = match made {
            Ok(run) => run,
            Err(error) if error.is_request() => return Err(error),
            // If a step is too large for the scheme, a smaller one may still work.
            Err(error) => {
                levels.push(Level { step_s: time.step, steps, error: None, failure: Some(error.to_string()) });
                failure = Some(error);
                done.clear();
                quiet = 0;
                continue;
            }
        };
        let against = reference.as_ref().or(done.last().map(|(_, run)| run));
        let change = against.map(|against| judged.change(&run, against));
        levels.push(Level { step_s: run.grid.step, steps, error: change.as_ref().map(|c| c.worst().0), failure: None });
        if let Some(change) = change {
            worst = change.worst();
            // A body frozen between its walls does not change from halving to halving, and yet is
            // wrong.
            let moves = run.counters.frozen_steps == 0;
            quiet = if moves && worst.0 <= share * target.tolerance { quiet + 1 } else { 0 };
        }
        done.push((level, run));
        if done.len() > QUIET_HALVINGS + 1 {
            done.remove(0);
        }
        let enough = if reference.is_some() || converges(&levels) { 1 } else { QUIET_HALVINGS };
        kept = quiet >= enough;
        if kept || leads_nowhere(&levels) {
            break;
        }
    }
    if done.is_empty() && refuted.is_some() {
        worst = (f64::INFINITY, "refuted by the judge".to_owned());
        kept = false;
    }
    let Some((level, run)) = done.pop().or(refuted) else {
        return Err(failure.unwrap_or(Error::Inaccurate {
            tolerance: target.tolerance,
            reached: f64::INFINITY,
            quantity: worst.1,
            until: 0.0,
            steps: judged.coarse.steps,
        }));
    };
    let against = reference.as_ref().or(done.last().map(|(_, run)| run));
    let agree = |other: &Run| agree_until(&judged.scene, &run.trajectory, &other.trajectory, share * target.tolerance);
    let agrees_until = against.map_or(0.0, agree);
    let mut sufficient = level;
    if reference.is_none() {
        for (coarser, earlier) in done.iter().rev() {
            if judged.change(earlier, &run).worst().0 <= SUFFICIENT * target.tolerance {
                sufficient = *coarser;
            }
        }
    }
    Ok(Refined { run, level, sufficient, levels, worst, kept, agrees_until, judged_by })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::residual::{Finding, Refuted};
    use crate::run::run;
    use crate::scene::{Scene, Wall};
    use crate::scheme::Scheme;
    use crate::study::accuracy::coarse::CoarseGrid;

    #[test]
    fn where_every_run_is_refuted_the_last_is_the_result() {
        let scene = Scene::oscillator(1.0, 0.1, 100.0).with_wall(Wall::upper("stop", 0.1)).with_initial(&[0.0], &[2.0]);
        let method = Method::new(Scheme::MoreauJean { theta: 0.5 });
        let time = TimeOptions::with_step(1e-2);
        let target = Target { method: Some(method), most_steps: 10_000, ..Target::new(1e-9, time) };
        let coarse = CoarseGrid::of(&scene, &time).unwrap();
        let judged = Judged { model: scene.clone(), scene, coarse, from: 0.0 };
        let finding = Finding {
            refuted: Refuted::MomentumBalance,
            residual: 1.0,
            tolerance: 1e-9,
            reason: "a run made wrong for this test".into(),
            time_s: 0.5,
            wall: None,
        };
        let mut steps = 0;
        let refined = refine_by(&judged, &target, &mut |options| {
            let mut run = run(&judged.scene, &method, options)?;
            steps = run.grid.steps;
            run.findings.push(finding.clone());
            Ok(run)
        });
        let refined = refined.expect("results, marked");
        assert!(!refined.kept && refined.worst.0.is_infinite(), "{:?}", refined.worst);
        assert_eq!((refined.run.findings.len(), refined.run.grid.steps), (1, steps));
        assert!(refined.levels.len() > 1 && refined.levels.iter().all(|level| level.failure.is_some()));
    }
}
