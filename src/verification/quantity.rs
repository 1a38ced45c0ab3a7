//! Values of a run that an entry of the manual compares.

use crate::run::Run;
use crate::step::Contact;

/// Rows are at multiples of the sample interval, to rounding.
const ROW: f64 = 1e-9;

/// The row at the instant `t`, s.
fn row(run: &Run, t: f64) -> Option<usize> {
    run.trajectory.time().iter().position(|time| (time - t).abs() <= ROW)
}

/// Displacement of the first probe at the instant `t` (s), m.
pub(super) fn displacement(run: &Run, t: f64) -> Option<f64> {
    run.trajectory.displacements().first()?.get(row(run, t)?).copied()
}

/// Velocity of the first probe at the instant `t` (s), m/s.
pub(super) fn velocity(run: &Run, t: f64) -> Option<f64> {
    run.trajectory.velocities().first()?.get(row(run, t)?).copied()
}

/// Displacement of the first probe in the last row, m.
pub(super) fn last_displacement(run: &Run) -> Option<f64> {
    run.trajectory.displacements().first()?.last().copied()
}

/// Contact number `index`, from 0, in order of time.
pub(super) fn contact(run: &Run, index: usize) -> Option<&Contact> {
    run.trajectory.contacts().get(index)
}

/// Size of the mean force of the first wall in the last row, N.
pub(super) fn last_force(run: &Run) -> Option<f64> {
    run.trajectory.contact_forces().first()?.last().map(|force| force.abs())
}

/// Mean work rate of the first support, W.
pub(super) fn work_rate(run: &Run) -> Option<f64> {
    run.statistics.wear.first().map(|wear| wear.work_rate_w)
}

/// Root mean square of the force of the walls whose names begin with `name`, of which one pushes at
/// a time, N.
pub(super) fn rms_force(run: &Run, name: &str) -> Option<f64> {
    let own = run.statistics.walls.iter().filter(|wall| wall.wall.starts_with(name));
    let squares: Option<Vec<f64>> = own.map(|wall| wall.force.map(|force| force.rms_n.powi(2))).collect();
    squares.filter(|squares| !squares.is_empty()).map(|squares| squares.iter().sum::<f64>().sqrt())
}
