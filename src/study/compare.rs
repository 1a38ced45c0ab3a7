//! Several methods on one scene, compared with the exact motion.

use super::choice::choose;
use super::difference;
use super::exact::affordable;
use super::horizon::{Growth, LARGEST_GROWTH, Source};
use crate::error::{Error, Result};
use crate::qp::Backend;
use crate::run::{Options, Run, run_with_progress};
use crate::scene::{LoadKind, Scene, System, WallLaw};
use crate::scheme::{Method, Realised, Scheme, Stepper};
use crate::time::{TimeGrid, TimeOptions};
use std::time::Instant;

/// What begins the finding that names the reference where there is no exact run.
pub(crate) const NO_EXACT_MOTION: &str = "no exact motion: errors are against ";

/// What begins the finding that there is neither an exact run nor another reference.
pub(crate) const NO_REFERENCE: &str = "no reference: ";

/// Error over the gap beyond which a run no longer agrees with the reference.
pub const AGREEMENT: f64 = 0.1;

/// Most steps of the timing runs, and the number of these runs.
const TIMED_STEPS: u64 = 20_000;
const TIMED_RUNS: usize = 3;

/// Where the exact scheme cannot follow the scene, the reference is the chosen stepping scheme with
/// steps finer by this factor.
pub const FINER: f64 = 8.0;

/// Impacts slower than this share of the fastest are left out of the restitution: rounding and
/// loads falsify it there.
const SLOW: f64 = 1e-2;

/// Departure speed over approach speed at the rigid walls and round supports of a scene, as a run
/// realised it.
#[derive(Debug, Clone, Copy, PartialEq)]
#[non_exhaustive]
pub struct Restitution {
    /// Smallest of all impacts.
    pub least: f64,
    /// Median of all impacts.
    pub median: f64,
    /// Largest of all impacts.
    pub largest: f64,
}

/// One method of the comparison.
#[derive(Debug, Clone)]
pub struct Row {
    /// The method.
    pub method: Method,
    /// The run, or why there is none.
    pub outcome: Result<Run>,
    /// Restitution at the rigid walls and round supports; `None` without impacts.
    pub restitution: Option<Restitution>,
    /// Largest |Δu| of any probe against the reference over the gap scale, up to the horizon;
    /// `None` without a probe.
    pub error: Option<f64>,
    /// Time up to which |Δu| stays below [`AGREEMENT`] of the gap scale, s.
    pub agrees_until: Option<f64>,
    /// Nanoseconds per step: stepping only, without recorder or judge, best of three. One step of
    /// the exact scheme goes from event to event.
    pub step_ns: Option<f64>,
}

/// A comparison.
#[derive(Debug, Clone)]
#[non_exhaustive]
pub struct Comparison {
    /// The methods in the order asked for, the exact scheme last.
    pub rows: Vec<Row>,
    /// The exact run, or why there is none; a run that the judge refutes counts as none.
    pub reference: Result<Run>,
    /// The reference where there is no exact run: the chosen stepping scheme with steps finer by
    /// [`FINER`].
    pub refined: Option<(Method, Run)>,
    /// Time up to which a pointwise error is meaningful, s.
    pub horizon: f64,
    /// Growth of a small perturbation over the whole run; `None` where it is not known.
    pub growth: Option<f64>,
    /// How the growth was found.
    pub growth_by: Option<Source>,
    /// Explanations of the differences, in sentences.
    pub findings: Vec<String>,
}

/// The methods of the main comparison: the constrained QP by its own solver and through Clarabel,
/// and every penalty.
#[must_use]
pub fn default_methods(chosen: Method, penalties: impl Iterator<Item = Method>) -> Vec<Method> {
    let mut methods = vec![chosen];
    if chosen.backend != Backend::Clarabel {
        methods.push(Method { backend: Backend::Clarabel, ..chosen });
    }
    methods.extend(penalties);
    methods
}

/// Runs every method on `scene`, the reference first. `progress` is called with the runs done, as a
/// fraction. A method that fails is a row that gives the reason.
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
    let stand_in = choose(scene).method;
    let finer = TimeOptions { step: grid.step / FINER, ..time };
    let refined = match &reference {
        Err(_) if structure => timed(0, &stand_in, finer).ok(),
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
    for (index, method) in others.chain(std::iter::once(&exact)).enumerate() {
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
    comparison.findings = findings(scene, &comparison);
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

/// Largest error over the gap up to the horizon, and the time up to which run and reference agree.
fn against(scene: &Scene, run: &Run, reference: &Run, horizon: f64) -> (Option<f64>, Option<f64>) {
    let gap = scene.gap_scale();
    let (mut error, mut until) = (None, None);
    for (t, difference) in difference::rows(&run.trajectory, &reference.trajectory) {
        let difference = difference / gap;
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

/// True under loads that need not repeat themselves, such as random ones: perturbations may then
/// grow exponentially, but there is no attractor whose chaos that would be.
#[must_use]
pub fn is_aperiodic(scene: &Scene) -> bool {
    scene.loads.iter().any(|load| matches!(load.kind, LoadKind::Table(_)))
}

fn findings(scene: &Scene, comparison: &Comparison) -> Vec<String> {
    let mut findings = law_findings(scene, comparison);
    findings.extend(clarabel_difference(scene, comparison));
    match (&comparison.reference, &comparison.refined) {
        (Err(error), None) => findings.push(format!("{NO_REFERENCE}{error}")),
        (Err(_), Some((method, run))) => {
            findings.push(format!("{NO_EXACT_MOTION}{method} with steps of {:.2e} s", run.grid.step))
        }
        _ => {}
    }
    findings.extend(growth_finding(scene, comparison));
    findings
}

/// Where the methods realise another restitution than the walls ask for.
fn law_findings(scene: &Scene, comparison: &Comparison) -> Vec<String> {
    let mut findings = Vec::new();
    let asked: Vec<f64> = scene.walls.iter().map(|wall| wall.law).filter_map(|law| law.restitution()).collect();
    let realised = |restitution| {
        comparison.rows.iter().map(|row| row.method.scheme).find(|s| s.entry().restitution == restitution)
    };
    if comparison.rows.iter().any(|row| row.method.scheme.is_lossless()) {
        findings.push(if asked.iter().all(|&e| e == 1.0) {
            "every wall has e = 1, the limit of a lossless penalty spring: QP and penalty converge to one \
             motion, the penalty as ε → 0 and h²k_w/m → 0 both"
                .into()
        } else {
            let mut distinct: Vec<f64> = Vec::new();
            for e in &asked {
                if !distinct.contains(e) {
                    distinct.push(*e);
                }
            }
            let e = distinct.iter().map(f64::to_string).collect::<Vec<_>>().join(", ");
            format!(
                "the walls ask for e = {e}, a lossless penalty spring tends to e = 1: the two do not \
                     converge to one another"
            )
        });
    }
    if let Some(scheme) = realised(Realised::Zero).filter(|_| asked.iter().any(|&e| e > 0.0)) {
        findings.push(format!("{scheme} on positions tends to e = 0: it does not converge to walls that rebound"));
    }
    if let Some(scheme) = realised(Realised::ByChance).filter(|_| !asked.is_empty()) {
        findings.push(format!(
            "{scheme} shows what goes wrong: by chance it realises an e between 1/3 and 3, and it gains energy"
        ));
    }
    findings
}

/// Whether a perturbation of the start grows, and up to when errors are taken for that reason.
fn growth_finding(scene: &Scene, comparison: &Comparison) -> Option<String> {
    let held = comparison.reference.is_ok() || comparison.refined.is_some();
    let by =
        comparison.growth_by.filter(|by| *by != Source::Saltation).map_or_else(String::new, |by| format!(" ({by})"));
    // A table need not repeat itself, and random loads do not.
    let [chaotic, predictable] =
        if is_aperiodic(scene) { ["sensitive", "not sensitive"] } else { ["chaos", "not chaotic"] };
    let growth = comparison.growth.filter(|_| held)?;
    Some(if comparison.horizon < scene.duration {
        format!(
            "{chaotic}: a perturbation of the start grows {growth:.1e}-fold over the run{by}, and \
             {LARGEST_GROWTH:e}-fold by t = {:.3} s; errors are taken up \
             to then, later compare impulses, contact counts and RMS",
            comparison.horizon
        )
    } else {
        format!(
            "{predictable}: a perturbation of the start never grows beyond {growth:.1}-fold{by}, so errors are \
             taken over the whole run"
        )
    })
}

/// How much solving through Clarabel changed, where a method was run both ways.
fn clarabel_difference(scene: &Scene, comparison: &Comparison) -> Option<String> {
    let through = comparison.rows.iter().find(|r| r.method.backend == Backend::Clarabel)?;
    let own = comparison
        .rows
        .iter()
        .find(|r| r.method.scheme == through.method.scheme && r.method.backend != Backend::Clarabel)?;
    let (a, b) = (own.outcome.as_ref().ok()?, through.outcome.as_ref().ok()?);
    let gap = scene.gap_scale();
    let (mut near, mut all) = (0.0_f64, 0.0_f64);
    for (t, difference) in difference::rows(&a.trajectory, &b.trajectory) {
        let difference = difference / gap;
        all = all.max(difference);
        if t <= comparison.horizon {
            near = near.max(difference);
        }
    }
    let until = a.trajectory.time().iter().take_while(|t| **t <= comparison.horizon).count();
    let walls = a.trajectory.contact_forces().iter().zip(b.trajectory.contact_forces());
    let pairs = walls.flat_map(|(x, y)| x.iter().zip(y).take(until));
    let force = pairs.map(|(x, y)| (x - y).abs()).fold(0.0, f64::max);
    let scale = a.residuals.force_scale_n.max(f64::MIN_POSITIVE);
    // Clarabel's solution is polished by the same routine that the condensed solver uses.
    let both = if a.backend == Backend::Condensed {
        "; the same exact solve ends both, so a difference shows only where other walls push"
    } else {
        ""
    };
    Some(format!(
        "{} by {} against every contact step through Clarabel ({} QPs, {} interior-point iterations): \
         displacement differs by at most {near:.1e} of the gap \
         up to the horizon ({all:.1e} over the run), force by {:.1e} of the largest{both}",
        own.method.scheme,
        a.backend,
        b.counters.qp_solves,
        b.counters.interior_point_iterations,
        force / scale
    ))
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
