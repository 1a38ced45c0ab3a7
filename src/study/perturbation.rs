//! The growth of a small change of the start, seen in runs that really are changed: an estimate from below, for scenes that have no formula.
//!
//! The velocities of the start are changed by pseudo-random amounts, δ of the largest speed at most, in a few directions. Of the difference
//! to the unchanged run the displacement wδ at every wall and probe is watched, at the rows: its growth is the largest of √((wδ/gap)² +
//! (ẇδ/speed)²) over what the change was at the start, in the same places. ẇδ is the slope of wδ between two rows, the least of those about
//! a row: at an impact wδ itself jumps, to −e wδ, and the velocities differ by a whole jump for the instant that lies between the two
//! impacts. A few directions rarely hold the worst one, but soon turn towards it: where growth is large the estimate falls short of it by a
//! factor of order 1.
//!
//! A stepping scheme touches walls at the grid's instants, and a change far below its own error may change nothing there, or a whole step.
//! Where runs of such a scheme are to say how long errors can be compared, δ is as large as these errors ([`COMPARED`]); where they are to
//! say how far rounding grows, it is small ([`SMALL`]). What a scheme makes of the phase of an impact within its step separates two of its
//! runs like any other change, and is part of what they show.

use super::difference::largest;
use super::growth::{Growth, Source};
use crate::error::Result;
use crate::scene::{Probe, Row, Scene};
use crate::scheme::{Method, Scheme, Stepper};
use crate::time::{TimeGrid, TimeOptions};
use crate::trajectory::{Recorder, Trajectory};

/// Far above rounding and what solvers leave, far below what is compared.
pub(super) const SMALL: f64 = 1e-10;
/// As large as errors that are compared.
pub(super) const COMPARED: f64 = 1e-3;
/// Directions, where there is more than one degree of freedom.
const DIRECTIONS: u64 = 2;
/// A difference above this share of the gap grows no further: the gap is full.
const FULL: f64 = 0.1;
/// Rows at which runs are compared.
const ROWS: u64 = 1024;
/// Places watched at most, where neither walls nor probes are.
const FEW: usize = 16;

/// The growth of a change of size `delta` along the run of `scene` by `method` with steps of `step` (s), which the exact scheme does without.
///
/// # Errors
/// What the runs report.
pub(super) fn growth(scene: &Scene, method: &Method, step: f64, delta: f64) -> Result<Growth> {
    let watched = watching(scene);
    let base = record(&watched, method, step)?;
    let length = scene.gap_scale();
    let speed = largest(base.velocities()).max(length / scene.duration);
    let directions = if scene.initial.v.len() > 1 { DIRECTIONS } else { 1 };
    let mut start = 0.0_f64;
    let mut factor = vec![0.0_f64; base.time().len()];
    for direction in 0..directions {
        let changes = directions_of(scene.initial.v.len(), direction);
        let mut beside = watched.clone();
        for (v, change) in beside.initial.v.iter_mut().zip(changes) {
            *v += delta * speed * change;
        }
        let moved = record(&beside, method, step)?;
        for ((w, w_moved), probe) in base.displacements().iter().zip(moved.displacements()).zip(&watched.probes) {
            let seen = probe.at.dot(&beside.initial.v) - probe.at.dot(&watched.initial.v);
            start = start.max(seen.abs() / speed);
            follow(base.time(), w, w_moved, (length, speed), &mut factor);
        }
    }
    let start = if start > 0.0 { start } else { delta };
    let factor = factor.into_iter().map(|f| if f.is_nan() { f } else { (f / start).max(1.0) }).collect();
    let source = if method.scheme == Scheme::Event { Source::ExactRuns } else { Source::Runs(*method) };
    Ok(Growth { time: base.time().to_vec(), factor, source })
}

/// Raises `factor` to the size of the difference of two columns at each row; no number from where the gap is full.
fn follow(time: &[f64], w: &[f64], moved: &[f64], (length, speed): (f64, f64), factor: &mut [f64]) {
    let difference = |row: usize| Some((moved.get(row)? - w.get(row)?, *time.get(row)?));
    let mut full = false;
    for (row, factor) in factor.iter_mut().enumerate() {
        let Some((now, _)) = difference(row) else { return };
        let slope = |from: usize| {
            let ((a, t), (b, u)) = (difference(from)?, difference(from + 1)?);
            Some(((b - a) / (u - t)).abs())
        };
        let rate = (row.saturating_sub(2)..row + 2).filter_map(slope).reduce(f64::min).unwrap_or(0.0);
        full |= now.is_nan() || now.abs() > FULL * length;
        *factor = if full { f64::NAN } else { super::difference::worse(*factor, (now / length).hypot(rate / speed)) };
    }
}

/// The scene with a probe at every wall and where its own look; at some degrees of freedom where there is neither.
fn watching(scene: &Scene) -> Scene {
    let mut watched = scene.clone();
    let mut places: Vec<Row> = Vec::new();
    for row in scene.walls.iter().map(|w| &w.at).chain(scene.probes.iter().map(|p| &p.at)) {
        if !places.contains(row) {
            places.push(row.clone());
        }
    }
    if places.is_empty() {
        places = (0..scene.initial.q.len()).take(FEW).map(Row::dof).collect();
    }
    watched.probes = places.into_iter().map(|at| Probe { name: String::new(), at }).collect();
    watched
}

/// Pseudo-random numbers from −1 to 1, the largest of them of size 1.
pub(super) fn directions_of(n: usize, direction: u64) -> Vec<f64> {
    let mut state = 0x9e37_79b9_7f4a_7c15_u64.wrapping_mul(direction + 1);
    let mut draw = || {
        state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        (state >> 40) as f64 / f64::from(1 << 23) - 1.0
    };
    let mut values: Vec<f64> = (0..n).map(|_| draw()).collect();
    let most = values.iter().fold(f64::MIN_POSITIVE, |most, x| most.max(x.abs()));
    values.iter_mut().for_each(|x| *x /= most);
    values
}

/// The motion at the rows, without a judge.
fn record(scene: &Scene, method: &Method, step: f64) -> Result<Trajectory> {
    let sample = Some(scene.duration / ROWS as f64);
    let exact = method.scheme == Scheme::Event;
    let step = step.min(scene.duration / ROWS as f64);
    let grid = TimeGrid::stepping(scene.duration, &TimeOptions { sample, ..TimeOptions::with_step(step) })?;
    let step = if exact { scene.duration } else { grid.step };
    let mut stepper = Stepper::new(scene, method, step)?;
    let state = stepper.state();
    let mut recorder = Recorder::new(stepper.scene(), grid.rows, &state.q, &state.v);
    let mut steps = 0;
    while if exact { stepper.time() < scene.duration } else { steps < grid.steps } {
        recorder.see(&stepper.step()?);
        steps += 1;
    }
    Ok(recorder.finish(&stepper.open_contacts()))
}
