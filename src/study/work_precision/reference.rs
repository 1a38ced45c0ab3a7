//! The reference of the runs, its own uncertainty, and the time up to which a comparison is
//! meaningful.

use super::errors::{Errors, Yardstick};
use super::ladder::Ladder;
use crate::error::{Error, Result};
use crate::residual::Judge;
use crate::run::{Options, Run, run};
use crate::scene::Scene;
use crate::scheme::{Method, Scheme, Stepper};
use crate::study::exact::affordable;
use crate::study::horizon::{Growth, LARGEST_GROWTH};
use crate::trajectory::{Recorder, Trajectory};

/// Shares of the duration after which the exact scheme is made to start a new arc, so that it
/// rounds differently.
const STRIDES: [f64; 3] = [1.0 / 7.3, 1.0 / 31.7, 1.0 / 101.9];
/// Ratio of the steps of the finest run and of a refined reference: for a scheme of order 2 the
/// error of the reference is then a sixteenth of that run's.
const FINER: u64 = 4;
/// Most steps of the runs that show the growth where the exact scheme cannot follow the scene, for
/// one degree of freedom.
pub(super) const PERTURBED_STEPS: u64 = 262_144;
const FEWEST_PERTURBED: u64 = 1024;
/// The comparison ends at this share of the time at which growth exceeds the limit, so that no
/// impact falls on its last row.
const SHAVED: f64 = 0.99;

/// Time up to which a comparison is meaningful.
#[derive(Debug, Clone, PartialEq)]
#[non_exhaustive]
pub struct Horizon {
    /// End of the comparison, s.
    pub end: f64,
    /// Growth of a small change of the start up to then.
    pub growth: f64,
    /// Growth over the scene's whole duration.
    pub growth_of_all: f64,
    /// How the growth was found, and why the comparison ends there.
    pub how: String,
}

impl Horizon {
    /// The horizon of `scene`: from the exact motion, or from perturbed runs of `stand_in` in
    /// `steps` steps where the exact scheme cannot follow it.
    pub(super) fn of(scene: &Scene, stand_in: Method, steps: u64) -> Result<Self> {
        let exact = |scene: &Scene| Growth::affordable(scene);
        let exact = match stand_in.scheme {
            Scheme::Penalty { law, .. } => scene.penalised(law).and_then(|scene| exact(&scene)),
            _ => exact(scene),
        };
        let most = (PERTURBED_STEPS / scene.system.degrees_of_freedom().max(1) as u64).max(FEWEST_PERTURBED);
        let step = scene.duration / steps.clamp(FEWEST_PERTURBED, most) as f64;
        let growth = exact.or_else(|_| Growth::by_runs(scene, &stand_in, step))?;
        let found = growth.source.to_string();
        let whole = scene.duration;
        let limit = growth.horizon(LARGEST_GROWTH);
        let end = if limit >= whole {
            whole
        } else {
            // The first event may be a graze; then the comparison ends just before it.
            let first = growth.time.iter().copied().find(|t| *t > 0.0).unwrap_or(whole);
            SHAVED * if limit > 0.0 { limit } else { first }
        };
        Ok(Self { end, growth: growth.until(end), growth_of_all: growth.until(whole), how: found })
    }
}

/// A motion that others are compared with.
#[derive(Debug, Clone)]
pub struct Reference {
    pub(super) yardstick: Yardstick,
    /// How it was made.
    pub how: String,
    /// Its own uncertainty: an error below this is meaningless.
    pub uncertainty: Errors,
}

impl Reference {
    /// The exact motion of `scene` where the exact scheme can follow it, else a refined run of
    /// `stand_in`.
    pub(super) fn of(scene: &Scene, stand_in: Method, ladder: &Ladder, horizon: &Horizon, most: f64) -> Result<Self> {
        Self::exact(scene, ladder.rows, horizon).or_else(|error| {
            let mut reference = Self::refined(scene, scene, stand_in, ladder, horizon, most)?;
            reference.how = format!("{}, since `event` cannot follow the scene: {error}", reference.how);
            Ok(reference)
        })
    }

    /// The motion of `scene` with the springs of the penalty `method`: exact for linear springs,
    /// refined for the φ² law.
    pub(super) fn of_penalty(
        scene: &Scene,
        method: Method,
        ladder: &Ladder,
        horizon: &Horizon,
        most: f64,
    ) -> Result<Self> {
        let penalised = match method.scheme {
            Scheme::Penalty { law, .. } => scene.penalised(law)?,
            _ => scene.clone(),
        };
        Self::exact(&penalised, ladder.rows, horizon)
            .or_else(|_| Self::refined(scene, &penalised, method, ladder, horizon, most))
    }

    /// By the exact scheme. Its uncertainty is the change when its arcs start elsewhere, with other
    /// roundings; but at least one rounding, times the growth of the scene.
    fn exact(scene: &Scene, rows: u64, horizon: &Horizon) -> Result<Self> {
        affordable(scene)?;
        let yardstick = Yardstick::new(scene, cut(scene, scene.duration, rows)?, 0.0, horizon.end);
        let mut uncertainty = Errors::default();
        for share in STRIDES {
            uncertainty = uncertainty.max(&yardstick.errors(&cut(scene, share * scene.duration, rows)?, 0.0));
        }
        let uncertainty = uncertainty.at_least(f64::EPSILON * horizon.growth.clamp(1.0, LARGEST_GROWTH));
        Ok(Self { yardstick, how: "the exact motion (`event`)".into(), uncertainty })
    }

    /// By `method` with steps [`FINER`] times finer than the finest compared, or as fine as time
    /// allows; its uncertainty is the change by the last halving. `seen` is the scene as the method
    /// sees it.
    fn refined(
        scene: &Scene,
        seen: &Scene,
        method: Method,
        ladder: &Ladder,
        horizon: &Horizon,
        most: f64,
    ) -> Result<Self> {
        let go = |count| {
            let time = ladder.time(count);
            run(scene, &method, &Options::new(time)).and_then(Run::unrefuted)
        };
        let finest = ladder.counts.last().copied().unwrap_or(ladder.rows).max(ladder.rows);
        let mut count = ladder.rows;
        let mut last = go(count)?;
        loop {
            // Directly to the last two levels, where the time of the last run shows that they can
            // be afforded.
            let ahead = FINER / 2 * finest / count;
            let affordable = last.seconds * 2.0 * ahead as f64 <= most;
            count *= if affordable { ahead.max(2) } else { 2 };
            let next = go(count)?;
            let enough = count >= FINER * finest || 2.0 * next.seconds > FINER as f64 * most;
            if enough {
                let how = format!("{method} refined to steps of {:.1e} s", next.grid.step);
                let yardstick = Yardstick::new(seen, next.trajectory, next.grid.step, horizon.end);
                let uncertainty = yardstick.errors(&last.trajectory, last.grid.step);
                return Ok(Self { yardstick, how, uncertainty });
            }
            last = next;
        }
    }

    /// Errors of `run` against this motion.
    pub(super) fn errors(&self, run: &Run) -> Errors {
        self.yardstick.errors(&run.trajectory, run.grid.step)
    }

    /// Errors of this motion against `other`.
    pub(super) fn against(&self, other: &Self) -> Errors {
        other.yardstick.errors(&self.yardstick.trajectory, self.yardstick.step)
    }
}

/// The exact motion of `scene` at `rows` rows, its arcs cut at multiples of `stride` (s).
fn cut(scene: &Scene, stride: f64, rows: u64) -> Result<Trajectory> {
    let mut stepper = Stepper::new(scene, &Scheme::Event, stride)?;
    let state = stepper.state();
    let mut recorder = Recorder::new(scene, rows, &state.q, &state.v);
    let mut judge = Judge::new(scene, stepper.contract(), stride, &state.q, &state.v);
    while stepper.time() < scene.duration {
        let step = stepper.step()?;
        judge.observe(&step);
        recorder.observe(&step);
    }
    if let Some(finding) = judge.findings().first() {
        return Err(Error::Refuted { runs: vec![format!("{}: {finding}", Scheme::Event)] });
    }
    Ok(recorder.finish(&stepper.open_contacts()))
}
