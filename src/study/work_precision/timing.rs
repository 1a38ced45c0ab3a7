//! Wall-clock time of stepping under equal conditions: nothing recorded or judged, set-up excluded,
//! after a warm-up, the runs in turn, the best of several.

use super::ladder::Ladder;
use crate::error::Result;
use crate::scene::Scene;
use crate::scheme::{Method, Stepper};
use std::hint::black_box;
use std::time::Instant;

/// A shorter run is repeated within its turn, up to this often: the resolution of a clock is some
/// tens of nanoseconds.
const TURN: f64 = 1e-3;
const MOST_IN_A_TURN: f64 = 32.0;

/// One run to be timed.
#[derive(Debug, Clone, Copy)]
pub(super) struct Job {
    pub method: Method,
    /// Number of steps over the duration; the exact scheme chooses its own.
    pub count: u64,
}

/// Seconds of each job: the best of `repeats` turns after a warm-up turn. Every turn runs every job
/// once, so that other load on the machine affects all of them alike.
pub(super) fn best(
    scene: &Scene,
    jobs: &[Job],
    repeats: u32,
    ladder: &Ladder,
    progress: &mut dyn FnMut(),
) -> Vec<Result<f64>> {
    let mut seconds: Vec<Result<f64>> = jobs.iter().map(|job| once(scene, job, ladder)).collect();
    progress();
    let warm: Vec<f64> = seconds.iter().map(|s| s.as_ref().copied().unwrap_or(TURN)).collect();
    seconds.iter_mut().filter(|s| s.is_ok()).for_each(|s| *s = Ok(f64::INFINITY));
    for _ in 0..repeats.max(1) {
        for ((job, best), warm) in jobs.iter().zip(&mut seconds).zip(&warm) {
            for _ in 0..(TURN / warm).clamp(1.0, MOST_IN_A_TURN) as u32 {
                let Ok(least) = *best else { break };
                *best = once(scene, job, ladder).map(|s| s.min(least));
            }
        }
        progress();
    }
    seconds
}

/// Seconds of the steps of one run.
fn once(scene: &Scene, job: &Job, ladder: &Ladder) -> Result<f64> {
    let exact = job.method.scheme.is_exact();
    let step = if exact { scene.duration } else { ladder.time(job.count).step };
    let mut stepper = Stepper::new(scene, &job.method, step)?;
    let started = Instant::now();
    if exact {
        while stepper.time() < scene.duration {
            black_box(stepper.step()?.q);
        }
    } else {
        while stepper.index() < job.count {
            black_box(stepper.step()?.q);
        }
    }
    Ok(started.elapsed().as_secs_f64())
}
