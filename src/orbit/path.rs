//! The motion of a structure's orbit at one place.

use super::strobe::Strobe;
use crate::error::Result;
use crate::scene::{Row, Scene, forcing_period};
use crate::scheme::{Scheme, Stepper};
use crate::step::Path;

/// Most instants of one forcing period.
const MOST: f64 = 64.0;

/// Phase (cycles), displacement (m) and velocity (m/s) at the place `at` over `periods` forcing
/// periods of `scene` from the state `from` on, by the exact scheme; both sides of each impact.
///
/// # Errors
/// Those of a run.
pub(crate) fn path(scene: &Scene, from: &Strobe, periods: u32, at: &Row) -> Result<Vec<[f64; 3]>> {
    let period = forcing_period(scene)?;
    let start = from.phase * period;
    let end = start + f64::from(periods) * period;
    let mut stepper = Stepper::new(&scene.clone().with_duration(end), &Scheme::Event, end)?;
    stepper.set_state(start, &from.state)?;
    let n = from.state.q.len();
    let (mut q, mut v) = (vec![0.0; n], vec![0.0; n]);
    let mut motion: Vec<[f64; 3]> = Vec::new();
    while stepper.time() < end {
        let step = stepper.step()?;
        let Path::Series(series) = step.path else { continue };
        let (first, last) = (series.start(), series.end());
        let count = ((last - first) / period * MOST).ceil().max(1.0);
        for index in 0..=count as u64 {
            let time = if index as f64 == count { last } else { first + (last - first) * index as f64 / count };
            series.state(time, &mut q, &mut v);
            let now = [time / period, at.dot(&q), at.dot(&v)];
            // A stretch begins in the state in which the last one ended, except at impacts.
            if motion.last() != Some(&now) {
                motion.push(now);
            }
        }
    }
    Ok(motion)
}
