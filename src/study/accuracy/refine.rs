//! Halves the step until the tolerance is kept.

use super::judged::{Judged, exact};
use super::{Against, JudgedBy, Level, Target};
use crate::error::{Error, Result};
use crate::run::{Options, Run, run_with_progress};
use crate::scene::Scene;
use crate::scheme::Method;
use crate::study::change::agree_until;
use crate::time::TimeOptions;

/// Largest change by a halving, as a share of the tolerance, and the number of successive halvings
/// that must stay below it. One halving is not enough: over random trials the true error exceeded
/// the last change in 25 to 57 of 100, by up to 3.8 times.
const QUIET: f64 = 0.25;
const QUIET_HALVINGS: usize = 2;

/// The ratios of two successive changes by which the runs are taken to converge with order 2, which
/// gives 4: orders of 1.5 to 2.5. With two such ratios in succession one change below [`QUIET`] is
/// enough: the finest run then errs by about a third of it.
const ORDER_2: std::ops::RangeInclusive<f64> = 2.8..=5.7;

/// Number of levels before a trend is looked for: the coarsest steps may not see the motion at all.
const FEWEST_LEVELS: usize = 8;

/// Number of last levels from which the trend is taken.
const TREND: usize = 3;

/// An error above this is as large as the quantities compared.
const LOST: f64 = 0.1;

/// A coarser step is called sufficient if its run lies within this share of the tolerance from the
/// finest.
const SUFFICIENT: f64 = 0.5;

/// Outcome of a refinement.
#[derive(Debug)]
pub(super) struct Refined {
    /// The finest run.
    pub run: Run,
    /// How often its step was halved.
    pub level: u32,
    /// The level of the coarsest run that keeps the tolerance.
    pub sufficient: u32,
    /// All levels.
    pub levels: Vec<Level>,
    /// The last error or change, and the quantity it belongs to.
    pub worst: (f64, String),
    /// True if the tolerance is kept.
    pub kept: bool,
    /// Time (s) up to which the displacement of the finest run keeps the tolerance.
    pub agrees_until: f64,
    pub judged_by: JudgedBy,
}

/// True if the errors so far are as large as the motion and do not decrease: where a small change
/// grows exponentially, each halving of the step only keeps the motion for a little longer.
fn leads_nowhere(levels: &[Level]) -> bool {
    let errors: Vec<f64> = levels.iter().rev().map_while(|level| level.error).collect();
    let (Some(&last), Some(&before)) = (errors.first(), errors.get(TREND)) else { return false };
    errors.len() >= FEWEST_LEVELS && last > LOST && last > 0.5 * before
}

/// True if the changes by the last three halvings fall as those of order 2.
fn converges(levels: &[Level]) -> bool {
    let changes: Vec<f64> = levels.iter().rev().map_while(|level| level.error).take(3).collect();
    changes.len() == 3 && changes.windows(2).all(|pair| ORDER_2.contains(&(pair[1] / pair[0])))
}

/// Halves the step of `method` until the tolerance is kept, until the next run would take too many
/// steps, or until the runs so far show that the tolerance would still be missed by then. Where the
/// judge refutes every run, the last of them is returned as not kept; its findings say why.
///
/// # Errors
/// The error of the last run, where every run failed.
pub(super) fn refine(
    judged: &Judged,
    method: &Method,
    target: &Target,
    progress: &mut dyn FnMut(f64),
) -> Result<Refined> {
    let halvings = Halvings::new(judged, target);
    if halvings.reference.is_none() {
        check_halving(&judged.model, method)?;
    }
    refine_by(halvings, &mut |options| run_with_progress(&judged.scene, method, options, progress))
}

/// Refuses a scheme of order 1 at a wall with a dashpot, which pushes from the step on in which a
/// contact begins: half the step changes nothing where it leaves the first instant within the wall,
/// whatever the error.
fn check_halving(scene: &Scene, method: &Method) -> Result<()> {
    let Some(wall) = scene.dashpot_wall() else { return Ok(()) };
    if method.scheme.entry().order != Some(1) {
        return Ok(());
    }
    let found = format!("{method}, asked for an accuracy at the dashpot of {:?}", wall.name);
    let expected = "located or no dashpot: a contact begins with a whole step here, so that half the step may change \
                    far less than the error";
    Err(Error::invalid("scheme", found, expected))
}

/// The same, with runs made by `make`.
fn refine_by(mut halvings: Halvings<'_>, make: &mut dyn FnMut(&Options) -> Result<Run>) -> Result<Refined> {
    let Halvings { judged, target, .. } = halvings;
    for level in 0..u64::BITS {
        let steps = judged.coarse.steps.saturating_mul(1 << level);
        if steps > target.most_steps {
            break;
        }
        let time = judged.time(&judged.coarse.options(level, &target.time));
        match make(&Options::new(time)).and_then(|run| halvings.unrefuted(level, run)) {
            Ok(run) => halvings.add(level, steps, run),
            Err(error) if error.is_request() => return Err(error),
            // If a step is too large for the scheme, a smaller one may still work.
            Err(error) => halvings.add_failed(Level { step_s: time.step, steps, error: None, failure: None }, error),
        }
        if halvings.kept || leads_nowhere(&halvings.levels) {
            break;
        }
    }
    halvings.refined()
}

/// The runs so far, each with half the step of the one before.
struct Halvings<'a> {
    judged: &'a Judged,
    target: &'a Target,
    /// The exact motion, where the runs are judged by it.
    reference: Option<Run>,
    /// Largest error or change, as a share of the scale of its quantity.
    allowed: f64,
    levels: Vec<Level>,
    /// The last runs since one failed, with their levels.
    done: Vec<(u32, Run)>,
    /// The last run that the judge refuted.
    refuted: Option<(u32, Run)>,
    /// The last error or change, and the quantity it belongs to.
    worst: (f64, String),
    /// Number of successive halvings up to the last whose change is allowed.
    quiet: usize,
    kept: bool,
    failure: Option<Error>,
}

impl<'a> Halvings<'a> {
    fn new(judged: &'a Judged, target: &'a Target) -> Self {
        let rows = TimeOptions { sample: Some(judged.coarse.sample), ..judged.time(&target.time) };
        let reference = match target.against {
            Against::Exact => exact(&judged.model, rows).ok(),
            Against::Refinements => None,
        };
        Self {
            judged,
            target,
            allowed: if reference.is_some() { 1.0 } else { QUIET } * target.tolerance,
            reference,
            levels: Vec::new(),
            done: Vec::new(),
            refuted: None,
            worst: (f64::INFINITY, "nothing to compare".to_owned()),
            quiet: 0,
            kept: false,
            failure: None,
        }
    }

    /// What the finest run is compared with: the exact motion, or the run before it.
    fn against(&self) -> Option<&Run> {
        self.reference.as_ref().or(self.done.last().map(|(_, run)| run))
    }

    /// The run, unless the judge refutes it.
    fn unrefuted(&mut self, level: u32, run: Run) -> Result<Run> {
        match run.refuted() {
            Some(error) => {
                self.refuted = Some((level, run));
                Err(error)
            }
            None => Ok(run),
        }
    }

    fn add_failed(&mut self, level: Level, error: Error) {
        self.levels.push(Level { failure: Some(error.to_string()), ..level });
        self.failure = Some(error);
        self.done.clear();
        self.quiet = 0;
    }

    fn add(&mut self, level: u32, steps: u64, run: Run) {
        let change = self.against().map(|against| self.judged.change(&run, against).worst());
        let error = change.as_ref().map(|worst| worst.0);
        self.levels.push(Level { step_s: run.grid.step, steps, error, failure: None });
        if let Some(worst) = change {
            // A body frozen between its walls does not change from halving to halving, and yet is
            // wrong.
            let moves = run.counters.frozen_steps == 0;
            self.quiet = if moves && worst.0 <= self.allowed { self.quiet + 1 } else { 0 };
            self.worst = worst;
        }
        self.done.push((level, run));
        if self.done.len() > QUIET_HALVINGS + 1 {
            self.done.remove(0);
        }
        let enough = if self.reference.is_some() || converges(&self.levels) { 1 } else { QUIET_HALVINGS };
        self.kept = self.quiet >= enough;
    }

    /// The finest run, or the last refuted one where no other is left.
    fn refined(mut self) -> Result<Refined> {
        if self.done.is_empty() && self.refuted.is_some() {
            self.worst = (f64::INFINITY, "refuted by the judge".to_owned());
            self.kept = false;
        }
        let Some((level, run)) = self.done.pop().or_else(|| self.refuted.take()) else {
            return Err(self.failure.unwrap_or(Error::Inaccurate {
                tolerance: self.target.tolerance,
                reached: f64::INFINITY,
                quantity: self.worst.1,
                until: 0.0,
                steps: self.judged.coarse.steps,
            }));
        };
        let agree = |other: &Run| agree_until(&self.judged.scene, &run.trajectory, &other.trajectory, self.allowed);
        let agrees_until = self.against().map_or(0.0, agree);
        let mut sufficient = level;
        if self.reference.is_none() {
            for (coarser, earlier) in self.done.iter().rev() {
                if self.judged.change(earlier, &run).worst().0 <= SUFFICIENT * self.target.tolerance {
                    sufficient = *coarser;
                }
            }
        }
        let judged_by = if self.reference.is_some() { JudgedBy::ExactMotion } else { JudgedBy::Halving };
        let Self { levels, worst, kept, .. } = self;
        Ok(Refined { run, level, sufficient, levels, worst, kept, agrees_until, judged_by })
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::residual::{Finding, Refuted};
    use crate::run::run;
    use crate::scene::{Scene, Wall};
    use crate::scheme::Scheme;
    use crate::study::accuracy::coarse::CoarseGrid;

    #[test]
    fn where_every_run_is_refuted_the_last_is_the_result() {
        let scene = Scene::oscillator(1.0, 0.1, 100.0).with_wall(Wall::upper("stop", 0.1)).with_initial(&[0.0], &[2.0]);
        let method = Method::new(Scheme::MoreauJean { theta: 0.5 });
        let time = TimeOptions::with_step(1e-2);
        let target = Target { method: Some(method), most_steps: 10_000, ..Target::new(1e-9, time) };
        let coarse = CoarseGrid::of(&scene, &time).unwrap();
        let judged = Judged { model: scene.clone(), scene, coarse, from: 0.0 };
        let finding = Finding {
            refuted: Refuted::MomentumBalance,
            residual: 1.0,
            tolerance: 1e-9,
            reason: "a run made wrong for this test".into(),
            time_s: 0.5,
            wall: None,
        };
        let mut steps = 0;
        let refined = refine_by(Halvings::new(&judged, &target), &mut |options| {
            let mut run = run(&judged.scene, &method, options)?;
            steps = run.grid.steps;
            run.findings.push(finding.clone());
            Ok(run)
        });
        let refined = refined.expect("results, marked");
        assert!(!refined.kept && refined.worst.0.is_infinite(), "{:?}", refined.worst);
        assert_eq!((refined.run.findings.len(), refined.run.grid.steps), (1, steps));
        assert!(refined.levels.len() > 1 && refined.levels.iter().all(|level| level.failure.is_some()));
    }
}
