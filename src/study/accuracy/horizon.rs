//! The time up to which an error can be kept at all.

use super::judged::{Judged, exact};
use super::{CoarseGrid, JudgedBy, Outcome, Target};
use crate::error::Result;
use crate::run::{Options, Run, run};
use crate::scene::{Scene, System};
use crate::scheme::{Method, Scheme};
use crate::statistics::{Statistics, WallStatistics};
use crate::study::change::Change;
use crate::study::horizon::{Growth, LARGEST_GROWTH};
use crate::time::TimeOptions;

/// Error over the gap, before it grows, of any run however small its step: rounding, with two
/// digits in reserve.
const ROUNDING: f64 = 1e-14;

/// Rounding may grow to this share of the tolerance.
const SHARE: f64 = 0.25;

/// Perturbation of the start, over the gap, that is followed where the growth is not known.
const PERTURBATION: f64 = 1e-10;

/// A perturbation that has reached this size, over the gap, is no longer growing: it fills the gap.
const SATURATED: f64 = 0.1;

/// Shares of the run, shortest first, over which exact runs of a structure show how fast rounding
/// grows: where it grows fast, a fraction of a run is enough to know.
const SHORT: [f64; 3] = [1.0 / 16.0, 0.25, 1.0];

/// The time (s) beyond which no step keeps the error asked for, since rounding alone grows to it;
/// `None` if it never does, or if that is not known. This takes a few short runs and is meant to be
/// called before [`reach`](super::reach). For one degree of freedom it is exact. For a structure it
/// is an upper bound, found by short exact runs where the exact scheme can follow the motion, else
/// by runs of the method with the coarsest step that could see the motion.
///
/// # Errors
/// [`crate::Error::Invalid`] for a request that makes no sense, and errors of the runs.
pub fn foresee(scene: &Scene, target: &Target) -> Result<Option<f64>> {
    target.validate()?;
    scene.validate()?;
    let most = SHARE * target.tolerance / ROUNDING;
    if let System::Structure(_) = scene.system {
        for share in SHORT {
            let short = scene.clone().with_duration(share * scene.duration);
            let Ok(growth) = Growth::affordable(&short) else { break };
            let until = growth.horizon(most);
            if until < short.duration * (1.0 - 1e-9) {
                return Ok(Some(until));
            }
        }
    }
    let growth = match scene.system {
        System::Oscillator(_) => Growth::affordable(scene)?,
        System::Structure(_) => {
            let method = target.method.filter(|m| !m.scheme.is_exact());
            let method = method.unwrap_or_else(|| crate::study::choice::choose(scene).method);
            let coarse = CoarseGrid::of(scene, &target.time)?;
            Growth::of_rounding(scene, &method, coarse.options(0, &target.time).step)?
        }
    };
    let until = growth.horizon(most);
    Ok((until < scene.duration * (1.0 - 1e-9)).then_some(until))
}

/// The row (s) up to which rounding has not grown beyond its share of `tolerance`; `None` if it
/// never does. It lies between two events, so that no impact falls on the last row compared.
pub(super) fn cut(growth: &Growth, tolerance: f64, sample: f64) -> Option<f64> {
    let horizon = growth.horizon(SHARE * tolerance / ROUNDING);
    if growth.time.last().is_none_or(|&end| horizon >= end) {
        return None;
    }
    let before = growth.time.iter().copied().take_while(|&t| t < horizon).last().unwrap_or(0.0);
    Some((0.5 * (before + horizon) / sample).floor().max(1.0) * sample)
}

/// The time (s) up to which a run from a perturbed start stays within the tolerance when the
/// perturbation is scaled down to rounding; `None` if it does so to the end, or if the start leaves
/// no room for a perturbation.
pub(super) fn perturbed(
    judged: &Judged,
    method: &Method,
    target: &Target,
    level: u32,
    found: &Run,
) -> Result<Option<f64>> {
    let gap = judged.scene.gap_scale();
    let time = judged.time(&judged.coarse.options(level, &target.time));
    if let System::Structure(_) = judged.scene.system {
        let growth = Growth::of_rounding(&judged.scene, method, time.step)?;
        let until = growth.horizon(SHARE * target.tolerance / ROUNDING);
        return Ok((until < judged.scene.duration * (1.0 - 1e-9)).then_some(until));
    }
    let beside = [PERTURBATION * gap, -PERTURBATION * gap].into_iter().find_map(|by| {
        let mut scene = judged.scene.clone();
        scene.initial.q.first_mut().map(|q| *q += by)?;
        scene.validate().is_ok().then_some(scene)
    });
    let Some(beside) = beside else { return Ok(None) };
    let other = run(&beside, method, &Options::new(time))?;
    let most = (SHARE * target.tolerance * PERTURBATION / ROUNDING).min(SATURATED);
    let until = crate::study::change::agree_until(&judged.scene, &other.trajectory, &found.trajectory, most);
    Ok((until < judged.scene.duration).then_some(until))
}

/// A remark on the statistics' own scatter, where it is wider than the error asked for; it names
/// the wall with the widest interval. Walls with fewer contacts than batches have no interval.
fn sampling(statistics: &Statistics, tolerance: f64) -> Option<String> {
    let share = |wall: &WallStatistics| {
        let force = wall.force.filter(|force| wall.half_width_95.is_some() && force.mean_n > 0.0)?;
        Some(force.mean_half_width_95_n? / force.mean_n)
    };
    let shares = statistics.walls.iter().filter_map(|wall| Some((share(wall)?, &wall.wall)));
    let (widest, wall) = shares.filter(|(share, _)| *share > tolerance).max_by(|a, b| a.0.total_cmp(&b.0))?;
    Some(format!(
        "the mean force of wall {wall:?} scatters along the window: its 95 % interval by batches is ±{:.1} \
         % of it, wider than the {tolerance:e} asked for; the error holds for this stretch of motion, and as an \
         average over a longer one the force is known no better than the interval",
        100.0 * widest
    ))
}

/// Adds to the run's notes what a reader must know about an error that was kept.
pub(super) fn explain(scene: &Scene, outcome: &mut Outcome) {
    let until = outcome.accuracy.until_s;
    if let Some(growth) = outcome.accuracy.growth.filter(|&g| g > LARGEST_GROWTH) {
        outcome.run.notes.push(format!(
            "a small change of the start or of the values of the case grows {growth:.1e}-fold up to t = \
             {until:.4} s: the error is that of the calculation, for exactly these values"
        ));
    }
    outcome.run.notes.extend(sampling(&outcome.run.statistics, outcome.accuracy.tolerance));
    let rigid = scene.walls.iter().any(|w| w.law.is_rigid());
    if !(rigid && matches!(outcome.method.scheme, Scheme::Penalty { .. })) {
        return;
    }
    let sample = outcome.run.grid.row_spacing();
    let time = TimeOptions { sample: Some(sample), ..TimeOptions::with_step(sample) };
    let judged =
        if outcome.accuracy.judged_by == JudgedBy::Halving { "its own refinements" } else { "its own springs" };
    let rigid = exact(scene, time).map(|exact| Change::of_runs(scene, &outcome.run, &exact, until));
    if let Ok(change) = rigid {
        outcome.run.notes.push(format!(
            "the error is against {judged}: from the motion between rigid walls the displacement differs by {:.1e} \
             of the gap up to t = {until:.4} s, which no step changes",
            change.displacement
        ));
    }
}
