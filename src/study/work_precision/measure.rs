//! The study: first the errors of every method at every step, then the times.

use super::errors::Errors;
use super::ladder::Ladder;
use super::reference::{Horizon, PERTURBED_STEPS, Reference};
use super::timing::{self, Job};
use super::{Effort, Floor, Measured, MethodPoints, Outcome, Point, WorkPrecision};
use crate::error::{Error, Result};
use crate::run::{Options, Run, run};
use crate::scene::Scene;
use crate::scheme::{Counters, Integrator, Method, Scheme};
use crate::study::choice::stepping_for_error;

/// Measures `methods` on `scene`; `progress` is called with the share done, from 0 to 1.
///
/// # Errors
/// [`crate::Error::Invalid`] for steps that make no sense, and any error that leaves the study
/// without a reference. The error of a single run is in its point.
pub fn study(scene: &Scene, methods: &[Method], effort: &Effort, progress: &dyn Fn(f64)) -> Result<WorkPrecision> {
    scene.validate()?;
    if scene.probes.is_empty() {
        return Err(Error::invalid("probe", "missing", "a scene with a probe to compare"));
    }
    let stand_in = stepping_for_error(scene).method;
    let horizon = Horizon::of(scene, stand_in, PERTURBED_STEPS)?;
    let scene = &scene.clone().with_duration(horizon.end);
    let ladder = Ladder::new(scene, &effort.steps)?;
    let reference = Reference::of(scene, stand_in, &ladder, &horizon, effort.most_seconds)?;
    let floors = floors(scene, methods, &reference, &ladder, effort);
    // Half of the progress bar for the errors, half for the times.
    let mut series = Vec::with_capacity(methods.len());
    for (done, method) in methods.iter().enumerate() {
        series.push(errors_of(scene, *method, &reference, &floors, &ladder, effort));
        progress(0.5 * (done + 1) as f64 / methods.len() as f64);
    }
    let mut turns = 0.0;
    time_all(scene, &mut series, &ladder, effort, &mut || {
        turns += 1.0;
        progress(0.5 + 0.5 * turns / (1.0 + f64::from(effort.repeats)));
    });
    Ok(WorkPrecision { horizon, reference, series, floors })
}

fn floors(scene: &Scene, methods: &[Method], rigid: &Reference, ladder: &Ladder, effort: &Effort) -> Vec<Floor> {
    let finest = ladder.counts.last().copied().unwrap_or(ladder.rows);
    let mut floors: Vec<Floor> = Vec::new();
    for method in methods {
        let Scheme::Penalty { law, .. } = method.scheme else { continue };
        if floors.iter().any(|f| f.law == law) {
            continue;
        }
        let stand_in = Method::new(Scheme::Penalty { law, integrator: Integrator::DiscreteGradient });
        let own = Horizon::of(scene, stand_in, finest).and_then(|horizon| {
            Ok((Reference::of_penalty(scene, stand_in, ladder, &horizon, effort.most_seconds)?, horizon.end))
        });
        let errors: Option<Errors> = own.as_ref().ok().map(|(own, _)| own.against(rigid));
        let (reference, end) = match own {
            Ok((reference, end)) => (Ok(reference), end),
            Err(error) => (Err(error), 0.0),
        };
        floors.push(Floor { law, reference, end, errors });
    }
    floors
}

/// The errors of one method at every step, without the times.
fn errors_of(
    scene: &Scene,
    method: Method,
    reference: &Reference,
    floors: &[Floor],
    ladder: &Ladder,
    effort: &Effort,
) -> MethodPoints {
    let ran = |measured| Outcome::Ran(Box::new(measured));
    if method.scheme.is_exact() {
        let outcome = match exact(scene) {
            Ok(counters) => {
                let errors = reference.uncertainty.clone();
                ran(Measured { errors, own: None, seconds: f64::INFINITY, counters, notes: Vec::new() })
            }
            Err(error) => Outcome::Failed(error),
        };
        return MethodPoints { method, points: vec![Point { step: None, outcome }] };
    }
    let own = floors.iter().find(|f| matches!(method.scheme, Scheme::Penalty { law, .. } if law == f.law));
    let own = own.and_then(|f| f.reference.as_ref().ok());
    let mut points: Vec<Point> = Vec::new();
    // Seconds per step, recorded and judged, of the last run that was long enough to measure.
    let mut pace = 0.0;
    for &count in &ladder.counts {
        let expected = pace * count as f64;
        let time = ladder.time(count);
        let outcome = if expected > effort.most_seconds {
            Outcome::LeftOut(expected)
        } else {
            match run(scene, &method, &Options::new(time)).and_then(Run::unrefuted) {
                Ok(run) => {
                    pace = run.seconds / count as f64;
                    ran(measure(run, reference, own))
                }
                Err(error) => Outcome::Failed(error),
            }
        };
        points.push(Point { step: Some(time.step), outcome });
    }
    MethodPoints { method, points }
}

fn measure(run: Run, reference: &Reference, own: Option<&Reference>) -> Measured {
    Measured {
        errors: reference.errors(&run),
        own: own.map(|own| own.errors(&run)),
        seconds: f64::INFINITY,
        counters: run.counters,
        notes: run.notes,
    }
}

/// Counters of the exact scheme; an error where the judge refutes its run.
fn exact(scene: &Scene) -> Result<Counters> {
    let options = Options::with_step(scene.duration).unrecorded();
    Ok(run(scene, &Scheme::Event, &options)?.unrefuted()?.counters)
}

fn time_all(scene: &Scene, series: &mut [MethodPoints], ladder: &Ladder, effort: &Effort, progress: &mut dyn FnMut()) {
    let mut jobs = Vec::new();
    let mut points = Vec::new();
    for series in series {
        let method = series.method;
        for (i, point) in series.points.iter_mut().enumerate() {
            if point.measured().is_some() {
                jobs.push(Job { method, count: ladder.counts.get(i).copied().unwrap_or(1) });
                points.push(&mut point.outcome);
            }
        }
    }
    let times = timing::best(scene, &jobs, effort.repeats, ladder, progress);
    for (outcome, seconds) in points.into_iter().zip(times) {
        match (&mut *outcome, seconds) {
            (Outcome::Ran(measured), Ok(seconds)) => measured.seconds = seconds,
            (_, Err(error)) => *outcome = Outcome::Failed(error),
            _ => {}
        }
    }
}
