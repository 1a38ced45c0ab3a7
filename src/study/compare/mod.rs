//! Several methods on one scene, compared with the exact motion; what explains their differences is
//! told by `findings.rs`; `comparison.rs` has what a comparison holds, `method_studies.rs` its
//! methods under several realisations.

mod comparison;
mod findings;
mod method_studies;

pub use comparison::{AGREEMENT, Comparison, Restitution, Row, is_aperiodic};
pub use findings::other_restitution;
pub use method_studies::{MethodFailure, MethodStudies, MethodStudy};

use super::choice::stepping_for_error;
use super::difference;
use super::exact::affordable;
use super::horizon::{Growth, LARGEST_GROWTH};
use crate::error::{Error, Result};
use crate::qp::Backend;
use crate::run::{Options, Run, run_with_progress};
use crate::scene::{Scene, System, WallLaw};
use crate::scheme::{Method, Scheme, Stepper};
use crate::time::{TimeGrid, TimeOptions};
use std::time::Instant;

/// Most steps of the timing runs, and the number of these runs.
const TIMED_STEPS: u64 = 20_000;
const TIMED_RUNS: usize = 3;

/// Where the exact scheme cannot follow the scene, the reference is the chosen stepping scheme with
/// steps finer by this factor.
pub const FINER: f64 = 8.0;

/// Impacts slower than this share of the fastest are left out of the restitution: rounding and
/// loads falsify it there.
const SLOW: f64 = 1e-2;

/// The methods that are compared on `scene` by default: the `chosen` one, a second way to solve it,
/// and those of `penalties` that have a rule for its walls. The second way is Clarabel; with round
/// supports or friction, where a step is no quadratic programme, it is the scheme that converges
/// fastest.
#[must_use]
pub fn default_methods(scene: &Scene, chosen: Method, penalties: impl Iterator<Item = Method>) -> Vec<Method> {
    let mut methods = vec![chosen];
    if scene.walls.is_empty() {
        return methods;
    }
    let second = if scene.turns_or_rubs() {
        Some(stepping_for_error(scene).method)
    } else {
        chosen.scheme.has_qp().then_some(Method { backend: Backend::Clarabel, ..chosen })
    };
    let penalties = penalties.filter(|penalty| Stepper::takes(scene, &penalty.scheme, scene.duration));
    for method in second.into_iter().chain(penalties) {
        if !methods.contains(&method) {
            methods.push(method);
        }
    }
    methods
}

/// Runs every method on `scene`, and the exact scheme where it has a law for the walls of the
/// scene, the reference first. `progress` is called with the runs done, as a fraction. A method
/// that fails is a row that gives the reason.
///
/// # Errors
/// [`Error::Invalid`] for times that make no sense. Errors of a method are in its row.
pub fn compare(scene: &Scene, methods: &[Method], time: &TimeOptions, progress: &dyn Fn(f64)) -> Result<Comparison> {
    // All runs, the exact one too, share one set of rows, so that they can be subtracted.
    let grid = TimeGrid::stepping(scene.duration, time)?;
    let time = TimeOptions { sample: Some(grid.row_spacing()), ..*time };
    let structure = matches!(scene.system, System::Structure(_));
    let possible = if structure { affordable(scene) } else { Ok(()) };
    let done = |before: usize, reached: f64| progress(before as f64 + reached / scene.duration);
    let timed = |before: usize, method: &Method, time| {
        let options = Options::new(time);
        run_with_progress(scene, method, &options, &mut |reached| done(before, reached))
    };
    let exact = Method::new(Scheme::Event);
    let reference = possible.and_then(|()| timed(0, &exact, time));
    // With several degrees of freedom, where the exact scheme cannot follow the scene, a refined
    // stepping scheme is the reference and also shows how perturbations grow.
    let stand_in = stepping_for_error(scene).method;
    let finer = TimeOptions { step: grid.step / FINER, ..time };
    let refined = match &reference {
        Err(_) => timed(0, &stand_in, finer).ok(),
        _ => None,
    };
    let growth = match &refined {
        Some(_) => Growth::by_runs(scene, &stand_in, grid.step).ok(),
        None => Growth::of(scene).ok(),
    };
    let horizon = growth.as_ref().map_or(scene.duration, |g| g.horizon(LARGEST_GROWTH));
    let mut rows = Vec::new();
    progress(1.0);
    let others = methods.iter().filter(|m| !m.scheme.is_exact());
    // A scene that the exact scheme has no law for gets no row of it unless that was asked for.
    let asked = methods.iter().any(|m| m.scheme.is_exact()) || Stepper::takes(scene, &exact.scheme, scene.duration);
    for (index, method) in others.chain(asked.then_some(&exact)).enumerate() {
        let outcome = match method.scheme {
            Scheme::Event => reference.clone(),
            _ => timed(index + 1, method, time),
        };
        rows.push(row(scene, *method, outcome, reference.as_ref().ok().or(refined.as_ref()), horizon, &time));
        progress(index as f64 + 2.0);
    }
    let growth_by = growth.as_ref().map(|g| g.source);
    let growth = growth.map(|g| g.until(scene.duration));
    let refined = refined.map(|run| (stand_in, run));
    let mut comparison = Comparison { rows, reference, refined, horizon, growth, growth_by, findings: Vec::new() };
    comparison.findings = findings::of(scene, &comparison);
    Ok(comparison)
}

fn row(
    scene: &Scene,
    method: Method,
    outcome: Result<Run>,
    reference: Option<&Run>,
    horizon: f64,
    time: &TimeOptions,
) -> Row {
    let mut row = Row { method, outcome, restitution: None, error: None, agrees_until: None, step_ns: None };
    let Ok(run) = &row.outcome else { return row };
    row.restitution = restitution(scene, run);
    if let Some(reference) = reference.filter(|_| !method.scheme.is_exact()) {
        (row.error, row.agrees_until) = against(scene, run, reference, horizon);
    }
    row.step_ns = step_ns(scene, &method, time).ok();
    row
}

/// Largest error over the gap, or without one over the largest displacement, up to the horizon, and
/// the time up to which run and reference agree.
fn against(scene: &Scene, run: &Run, reference: &Run, horizon: f64) -> (Option<f64>, Option<f64>) {
    let length = difference::error_length(scene, &reference.trajectory);
    let (mut error, mut until) = (None, None);
    for (t, difference) in difference::rows(&run.trajectory, &reference.trajectory) {
        let difference = difference / length;
        if t <= horizon * (1.0 + 1e-12) {
            error = Some(difference::worse(error.unwrap_or(0.0), difference));
        }
        // NaN counts as disagreement.
        if until.is_none() && (difference.is_nan() || difference > AGREEMENT) {
            until = Some(t);
        }
    }
    (error, error.map(|_| until.unwrap_or(scene.duration)))
}

/// Restitution at the walls and round supports that are rigid in `scene`, also where the method
/// replaced them by springs.
fn restitution(scene: &Scene, run: &Run) -> Option<Restitution> {
    let laws: Vec<WallLaw> = scene.walls.iter().map(|wall| wall.law).collect();
    let rigid = |wall: usize| laws.get(wall).is_some_and(WallLaw::is_rigid);
    let seen = run.trajectory.contacts().iter().filter(|c| rigid(c.wall));
    let fastest = seen.clone().map(|c| c.approach_speed).fold(0.0, f64::max);
    let counted = seen.filter(|c| c.approach_speed > SLOW * fastest);
    let mut ratios: Vec<f64> = counted.filter_map(|c| c.departure_speed.map(|d| d / c.approach_speed)).collect();
    ratios.sort_by(f64::total_cmp);
    Some(Restitution { least: *ratios.first()?, median: *ratios.get(ratios.len() / 2)?, largest: *ratios.last()? })
}

fn step_ns(scene: &Scene, method: &Method, time: &TimeOptions) -> Result<f64> {
    let exact = method.scheme.is_exact();
    let grid = TimeGrid::stepping(scene.duration, time)?;
    let step = if exact { scene.duration } else { grid.step };
    let mut best = f64::INFINITY;
    for _ in 0..TIMED_RUNS {
        let mut stepper = Stepper::new(scene, method, step)?;
        let mut steps = 0;
        let started = Instant::now();
        while steps < grid.steps.min(TIMED_STEPS) && stepper.time() < scene.duration {
            stepper.step()?;
            steps += 1;
        }
        best = best.min(started.elapsed().as_secs_f64() * 1e9 / steps as f64);
    }
    Ok(best)
}

/// Checks that at least one method succeeded.
///
/// # Errors
/// The first failure among the rows, if every method failed.
pub fn any_succeeded(comparison: &Comparison) -> Result<()> {
    let mut failures = comparison.rows.iter().map(|row| row.outcome.as_ref().err());
    if failures.clone().all(|failure| failure.is_some()) {
        failures.find_map(|failure| failure).map_or(Ok(()), |error: &Error| Err(error.clone()))
    } else {
        Ok(())
    }
}
