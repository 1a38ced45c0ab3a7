//! The steps that are tried. Their ratios are powers of two, so that the rows of all runs coincide.

use crate::error::{Error, Result};
use crate::scene::Scene;
use crate::time::{MOST_STEPS, TimeOptions};

/// Fewest steps of a run over the duration, and over the fastest period of the scene.
const COARSE: f64 = 64.0;
const COARSE_A_PERIOD: f64 = 16.0;
/// Steps of the finest run unless asked otherwise: some hundredths of a second for a penalty. With
/// n degrees of freedom 4/n times as many, but at least [`FEWEST_FINE`].
const FINE: f64 = 1e6;
const FEWEST_FINE: f64 = 2e4;
/// Most rows at which runs are compared, where the coarsest run does not have more steps.
const MOST_ROWS: u64 = 2048;

/// The steps to try. No step is finer than the finest asked for; where all levels are tried, the
/// last is within a factor of two of it.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Steps {
    /// Coarsest step, s; `None`: a sixteenth of the scene's fastest period, and at least 64 steps.
    pub coarsest: Option<f64>,
    /// Finest step, s; `None`: some 10⁶ steps, fewer where many degrees of freedom make a step
    /// expensive.
    pub finest: Option<f64>,
    /// Most levels; `None`: 8.
    pub levels: Option<u32>,
}

/// Numbers of steps over one duration, and the rows that all runs share.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Ladder {
    /// Number of steps of each run, increasing.
    pub counts: Vec<u64>,
    /// Number of rows of the reference: a power of two times the first count.
    pub rows: u64,
    pub duration: f64,
}

impl Ladder {
    pub fn new(scene: &Scene, steps: &Steps) -> Result<Self> {
        let duration = scene.duration;
        for (key, step) in [("coarsest step", steps.coarsest), ("finest step", steps.finest)] {
            let sensible = |h: f64| h.is_finite() && h > 0.0 && h < duration && duration / h <= MOST_STEPS;
            if let Some(step) = step.filter(|h| !sensible(*h)) {
                return Err(Error::invalid(key, step, format!("a step above 0, below the {duration} s compared")));
            }
        }
        let coarsest =
            steps.coarsest.unwrap_or_else(|| (duration / COARSE).min(fastest_period(scene) / COARSE_A_PERIOD));
        let first = (duration / coarsest * (1.0 - 1e-12)).ceil().clamp(2.0, MOST_STEPS);
        let n = scene.system.degrees_of_freedom().max(1) as f64;
        let fine = (4.0 * FINE / n).clamp(FEWEST_FINE, FINE);
        let finest = steps.finest.unwrap_or(duration / fine.max(first));
        if finest > coarsest * (1.0 + 1e-12) {
            return Err(Error::invalid("finest step", finest, format!("at most the coarsest, {coarsest}")));
        }
        let doublings = (duration / finest / first * (1.0 + 1e-9)).log2().floor().max(0.0) as u32;
        let levels = steps.levels.unwrap_or(8).max(1);
        let stride = if levels > 1 { doublings.div_ceil(levels - 1).max(1) } else { 1 };
        let last = if levels > 1 { doublings } else { 0 };
        let first = first as u64;
        let counts = (0..=last).step_by(stride as usize).map(|k| first << k).collect();
        let mut rows = first;
        while rows * 2 <= MOST_ROWS.min(first << last) {
            rows *= 2;
        }
        Ok(Self { counts, rows, duration })
    }

    /// Step and rows of a run of `count` steps.
    pub fn time(&self, count: u64) -> TimeOptions {
        let rows = self.rows.min(count);
        let step = self.duration / count as f64;
        TimeOptions { sample: Some(self.duration / rows as f64), ..TimeOptions::with_step(step) }
    }
}

/// The shortest period of the scene, s: of its harmonic loads and of its free motion without walls
/// (with several degrees of freedom the slowest mode; finer steps resolve the others one by one).
fn fastest_period(scene: &Scene) -> f64 {
    let natural = std::f64::consts::TAU / scene.system.frequencies()[0];
    let loads = scene.harmonic_frequencies().filter(|frequency| *frequency > 0.0).map(f64::recip);
    // At most 10⁵ steps in the coarsest run, however short the periods of the scene.
    loads.chain([natural]).fold(f64::INFINITY, f64::min).max(COARSE_A_PERIOD * 1e-5 * scene.duration)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_run_shares_rows_with_the_reference() {
        let scene = Scene::oscillator(1.0, 0.2, 100.0).with_duration(1.0);
        let steps = Steps { coarsest: Some(1e-2), finest: Some(1e-5), levels: Some(4) };
        let ladder = Ladder::new(&scene, &steps).unwrap();
        assert_eq!(ladder.counts, [100, 800, 6400, 51_200]);
        assert_eq!(ladder.rows, 1600);
        let defaults = Ladder::new(&scene, &Steps::default()).unwrap();
        assert_eq!((defaults.counts.first(), defaults.counts.len()), (Some(&64), 7));
        assert!(Ladder::new(&scene, &Steps { coarsest: Some(2.0), ..steps }).is_err());
        assert!(Ladder::new(&scene, &Steps { finest: Some(f64::NAN), ..steps }).is_err());
    }
}
