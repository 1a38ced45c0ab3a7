//! The growth of a small change of the start, measured on perturbed runs: a lower bound, for scenes
//! without a closed form.
//!
//! The initial velocities are changed by pseudo-random amounts in a few directions: each by at most
//! δ times the largest speed for a coordinate of the least mass μ that a wall or probe feels, and
//! for one of the mass m by √(μ/m) of that, so that the change is the same in any units, also of
//! coordinates that are no displacements, as those of modes. At the rows, the displacement
//! difference wδ to the unperturbed run is taken at every wall and probe. The growth is the largest
//! √((wδ/gap)² + (ẇδ/speed)²) over its value at the start, at the same places. ẇδ is the slope of
//! wδ between two rows, the smallest of those next to a row: at an impact wδ itself jumps, to −e
//! wδ, and between the impacts of the two runs the velocities differ by the whole jump. While a
//! place is inside an elastic wall wδ counts alone: of two bodies that arrive δt apart the
//! velocities differ by δt times the acceleration there, and no more once both have left. A few
//! random directions rarely include the worst one, but soon turn towards it: where growth is large
//! the estimate is too small by a factor of order
//! 1.
//!
//! A stepping scheme meets walls at the grid's instants only; a perturbation far below its own
//! error may change nothing there, or shift a contact by a whole step. Where such runs are to show
//! how long errors can be compared, δ is as large as these errors ([`COMPARED`]); where they are to
//! show how far rounding grows, δ is small ([`SMALL`]). The scheme's response to the phase of an
//! impact within its step separates two of its runs too, and is part of the growth they show.

use super::difference::{error_length, largest, worse};
use super::exact::limit_events;
use super::growth::{Growth, Source};
use crate::error::Result;
use crate::scene::{Probe, Row, Scene, System};
use crate::scheme::{Method, Stepper};
use crate::time::{TimeGrid, TimeOptions};
use crate::trajectory::{Recorder, Trajectory};

/// δ far above rounding and solver residuals, far below the errors that are compared.
pub(super) const SMALL: f64 = 1e-10;
/// δ as large as the errors that are compared.
pub(super) const COMPARED: f64 = 1e-3;
/// Number of directions, where there is more than one degree of freedom.
const DIRECTIONS: u64 = 2;
/// A difference above this share of the gap is saturated.
const FULL: f64 = 0.1;
/// Number of rows at which runs are compared.
const ROWS: u64 = 1024;
/// Where the runs separate early, their beginning shows it: they are made up to these parts of the
/// rows first, at about a seventh of the cost of whole runs.
const BEGINNINGS: [u64; 3] = [ROWS / 64, ROWS / 8, ROWS];
/// Most places compared where there are neither walls nor probes.
const FEW: usize = 16;

/// The growth of a change of size `delta` along the run of `scene` by `method` with steps of `step`
/// (s), up to its end or somewhat beyond the instant at which the runs have separated; the exact
/// scheme ignores `step`.
///
/// # Errors
/// Errors of the runs; of exact ones also those of [`affordable`](super::exact::affordable).
pub(super) fn growth(scene: &Scene, method: &Method, step: f64, delta: f64) -> Result<Growth> {
    let watched = watching(scene);
    let spacing = scene.duration / ROWS as f64;
    let mut found = Growth { time: Vec::new(), factor: Vec::new(), source: Source::ExactRuns };
    for rows in BEGINNINGS {
        let share = rows as f64 / ROWS as f64;
        let beginning = watched.clone().with_duration(scene.duration * share);
        found = within(&beginning, method, step.min(spacing), delta, spacing)?;
        if found.factor.last().is_some_and(|factor| factor.is_nan()) {
            break;
        }
    }
    Ok(found)
}

/// The growth along the whole run of `watched`, whose probes are compared every `spacing` seconds.
fn within(watched: &Scene, method: &Method, step: f64, delta: f64, spacing: f64) -> Result<Growth> {
    let base = record(watched, method, step, spacing, None)?;
    let length = error_length(watched, &base);
    let speed = largest(base.velocities()).max(length / (spacing * ROWS as f64));
    let directions = if watched.initial.v.len() > 1 { DIRECTIONS } else { 1 };
    let weights = weights(watched);
    let mut start = 0.0_f64;
    let mut factor = vec![0.0_f64; base.time().len()];
    for direction in 0..directions {
        let changes = directions_of(watched.initial.v.len(), direction);
        let mut beside = watched.clone();
        for ((v, change), weight) in beside.initial.v.iter_mut().zip(changes).zip(&weights) {
            *v += delta * speed * change * weight;
        }
        let moved = record(&beside, method, step, spacing, Some((&base, FULL * length)))?;
        for ((w, w_moved), probe) in base.displacements().iter().zip(moved.displacements()).zip(&watched.probes) {
            let seen = probe.at.dot(&beside.initial.v) - probe.at.dot(&watched.initial.v);
            start = start.max(seen.abs() / speed);
            let elastic = watched.walls.iter().filter(|wall| !wall.law.is_rigid() && *wall.row() == probe.at);
            let inside = |w: &f64| elastic.clone().any(|wall| wall.gap(*w) < 0.0);
            let pressed: Vec<bool> = w.iter().zip(w_moved).map(|(w, moved)| inside(w) || inside(moved)).collect();
            follow(base.time(), (w, w_moved, &pressed), (length, speed), &mut factor);
        }
    }
    let start = if start > 0.0 { start } else { delta };
    let factor = factor.into_iter().map(|f| if f.is_nan() { f } else { (f / start).max(1.0) }).collect();
    let source = if method.scheme.is_exact() { Source::ExactRuns } else { Source::Runs(*method) };
    Ok(Growth { time: base.time().to_vec(), factor, source })
}

/// √(μ/m) of each coordinate of `watched`, with its mass m and the least mass μ that a probe feels.
fn weights(watched: &Scene) -> Vec<f64> {
    let System::Structure(structure) = &watched.system else { return vec![1.0] };
    let felt = watched.masses_along(watched.probes.iter().map(|probe| &probe.at));
    let least = felt.into_iter().reduce(f64::min).unwrap_or(f64::INFINITY);
    let weight = |mass: f64| if least.is_finite() { (least / mass).sqrt() } else { 1.0 };
    structure.mass.diagonal_entries().into_iter().map(weight).collect()
}

/// Raises `factor` to the size of the difference of two columns at each row, of the displacements
/// alone where they are `pressed`; NaN from the row on at which the difference is saturated, and
/// where `moved` has no row: its run ended soon after that.
fn follow(
    time: &[f64],
    (w, moved, pressed): (&[f64], &[f64], &[bool]),
    (length, speed): (f64, f64),
    factor: &mut [f64],
) {
    let difference = |row: usize| Some((moved.get(row)? - w.get(row)?, *time.get(row)?));
    let mut full = false;
    for (row, factor) in factor.iter_mut().enumerate() {
        let now = difference(row).map_or(f64::NAN, |difference| difference.0);
        let slope = |from: usize| {
            let ((a, t), (b, u)) = (difference(from)?, difference(from + 1)?);
            Some(((b - a) / (u - t)).abs())
        };
        let rates = (row.saturating_sub(2)..row + 2).filter_map(slope);
        let rate = if pressed.get(row) == Some(&true) { None } else { rates.reduce(f64::min) }.unwrap_or(0.0);
        full |= now.is_nan() || now.abs() > FULL * length;
        *factor = if full { f64::NAN } else { worse(*factor, (now / length).hypot(rate / speed)) };
    }
}

/// The scene with a probe on the row of every wall and of every probe it has; where it has neither,
/// at some of its degrees of freedom.
fn watching(scene: &Scene) -> Scene {
    let mut watched = scene.clone();
    let mut places: Vec<Row> = Vec::new();
    let flats = scene.walls.iter().filter(|wall| !wall.is_round());
    for row in flats.map(|wall| wall.row()).chain(scene.probes.iter().map(|p| &p.at)) {
        if !places.contains(row) {
            places.push(row.clone());
        }
    }
    if places.is_empty() {
        places = (0..scene.initial.q.len()).take(FEW).map(Row::dof).collect();
    }
    watched.probes = places.into_iter().enumerate().map(|(i, at)| Probe { name: i.to_string(), at }).collect();
    watched
}

/// Pseudo-random numbers from −1 to 1, scaled so that the largest has magnitude 1.
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

/// The motion at rows `spacing` seconds apart, without a judge. Beside another run it ends with the
/// row after the one at which a probe is more than the given distance (m) from that run's.
fn record(
    scene: &Scene,
    method: &Method,
    step: f64,
    spacing: f64,
    beside: Option<(&Trajectory, f64)>,
) -> Result<Trajectory> {
    let exact = method.scheme.is_exact();
    let rows = TimeOptions { sample: Some(spacing), ..TimeOptions::with_step(step) };
    let grid = TimeGrid::stepping(scene.duration, &rows)?;
    let step = if exact { scene.duration } else { grid.step };
    let mut stepper = Stepper::new(scene, method, step)?;
    let state = stepper.state();
    let mut recorder = Recorder::new(stepper.scene(), grid.rows, &state.q, &state.v);
    let mut count = 0;
    while if exact { stepper.time() < scene.duration } else { stepper.index() < grid.steps } {
        recorder.observe(&stepper.step()?);
        count += 1;
        match beside {
            Some((base, most)) if are_apart(recorder.displacements(), base.displacements(), most) => break,
            None if exact => limit_events(scene, stepper.time(), count)?,
            _ => {}
        }
    }
    Ok(recorder.finish(&stepper.open_contacts()))
}

/// True if a column was more than `most` from that of `base` at its last row but one.
fn are_apart(columns: &[Vec<f64>], base: &[Vec<f64>], most: f64) -> bool {
    let apart = |(column, base): (&Vec<f64>, &Vec<f64>)| {
        let row = column.len().checked_sub(2)?;
        Some((column.get(row)? - base.get(row)?).abs())
    };
    columns.iter().zip(base).filter_map(apart).any(|apart| apart.is_nan() || apart > most)
}
