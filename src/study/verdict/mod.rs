//! The refinement verdict: the same run with half the step, and the change that makes. `words.rs`
//! puts it into words.

mod words;

use crate::error::Result;
use crate::order::sort_by_number;
use crate::parallel::both;
use crate::residual::{Finding, Refuted};
use crate::run::{Options, Run, run_with_progress};
use crate::scene::{Scene, System};
use crate::scheme::{Method, Stepper};
use crate::statistics::{ContactSite, PlaceKind, Statistics, WearStatistics};
use crate::study::change::Change;
use crate::study::difference::error_length;
use crate::study::exact::{Replay, replay, stride};
use crate::study::horizon::{Growth, LARGEST_GROWTH};
use crate::time::TimeOptions;
use crate::trajectory::Trajectory;
use serde::Serialize;

/// Cost of a verdict, in runs like the one it checks.
pub const COST: f64 = 2.0;

/// Most walls, and supports, that the text of a verdict names one by one.
const MOST_NAMED: usize = 4;

/// Values of motions that have parted are not alike to this share.
const ALIKE: f64 = 1e-6;

/// Motions whose displacements differ by more than this share of the gap have parted.
const PARTED: f64 = 0.1;

/// How a run was checked.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
#[serde(rename_all = "snake_case")]
#[non_exhaustive]
pub enum Check {
    /// By the same scheme with half the step.
    HalfStep {
        /// The halved step, s.
        step_s: f64,
    },
    /// The exact scheme has no step: by the same motion with other roundings.
    OtherRounding {
        /// Distance of the stops that change the rounding, s.
        stride_s: f64,
    },
}

/// One wall or round support in the run and in its check.
#[derive(Debug, Clone, PartialEq, Serialize)]
#[non_exhaustive]
pub struct WallVerdict {
    /// Its name.
    pub wall: String,
    /// Which of the two it is.
    pub kind: PlaceKind,
    /// Impulse of the run and of its check in the window for statistics, N s: of a wall signed, of
    /// a round support Σ|p|.
    pub impulse_n_s: [f64; 2],
    /// Contacts of the run and of its check in that window.
    pub contacts: [usize; 2],
    /// Largest force of the run and of its check in that window, N; `None` where an impact is among
    /// the contacts, whose force is not finite.
    pub peak_force_n: [Option<f64>; 2],
}

/// The work rate of one support in the run and in its check.
#[derive(Debug, Clone, PartialEq, Serialize)]
#[non_exhaustive]
pub struct WorkRateVerdict {
    /// The support.
    pub support: String,
    /// Work rate of the run and of its check in the window for statistics, W.
    pub work_rate_w: [f64; 2],
    /// Half width of the 95 % interval of that of the run, by batch means, W; `None` where the
    /// window has too few contacts.
    pub half_width_95_w: Option<f64>,
}

/// The changes that the check found.
#[derive(Debug, Clone, PartialEq, Serialize)]
#[non_exhaustive]
pub struct Verdict {
    /// How the run was checked.
    pub check: Check,
    /// Largest |Δu| of any probe over [`Scene::gap_scale`] up to the horizon; `None` where the
    /// horizon is before the first row after the start, so that nothing was compared.
    pub displacement: Option<f64>,
    /// [`Scene::gap_scale`], m.
    pub length_m: f64,
    /// True if that length is a gap of the scene.
    pub is_gap: bool,
    /// Time up to which displacements were compared, s: the end, or where a perturbation of the
    /// start has grown [`LARGEST_GROWTH`]-fold, or the last row of a run that diverged.
    pub horizon_s: f64,
    /// End of the run, s.
    pub end_s: f64,
    /// One entry per wall, then per round support, in the scene's order. Unlike displacements,
    /// these are compared over the whole run. Sliders have none: their normal impulse is given.
    pub walls: Vec<WallVerdict>,
    /// One entry per support, likewise.
    pub work_rates: Vec<WorkRateVerdict>,
    /// What the judge refutes in the check's own run; if there is anything, the verdict is
    /// meaningless.
    pub findings: Vec<Finding>,
}

impl WorkRateVerdict {
    /// Those of all supports, by the statistics of a run and of its check.
    pub(crate) fn between(run: &Statistics, check: &Statistics) -> Vec<Self> {
        let both = run.wear.iter().zip(&check.wear);
        let verdict = |(before, after): (&WearStatistics, &WearStatistics)| Self {
            support: before.support.clone(),
            work_rate_w: [before.work_rate_w, after.work_rate_w],
            half_width_95_w: before.work_rate_half_width_95_w,
        };
        both.map(verdict).collect()
    }

    /// The ones with the largest work rates of `all`, as many as a text names.
    pub(crate) fn hardest(all: &[Self]) -> Vec<&Self> {
        let mut supports: Vec<&Self> = all.iter().collect();
        if supports.len() > MOST_NAMED {
            sort_by_number(&mut supports, |a| -a.work_rate_w[0]);
            supports.truncate(MOST_NAMED);
        }
        supports
    }
}

impl Verdict {
    /// Checks `run` of `scene`, made by `method` with the options `time`; `progress` is called with
    /// the time (s) that the check has reached.
    ///
    /// # Errors
    /// Errors of the check's run.
    pub fn of(
        scene: &Scene,
        method: &Method,
        run: &Run,
        time: &TimeOptions,
        progress: &mut dyn FnMut(f64),
    ) -> Result<Self> {
        let rows = TimeOptions { sample: Some(run.grid.row_spacing()), ..*time };
        let check = || {
            if method.scheme.is_exact() {
                return Ok((Check::OtherRounding { stride_s: stride(scene) }, replay(scene, run, time)?));
            }
            let step_s = 0.5 * run.grid.step;
            let options = Options::new(TimeOptions { step: step_s, ..rows });
            let half = run_with_progress(scene, method, &options, progress)?;
            let Run { trajectory, statistics, findings, .. } = half;
            Ok((Check::HalfStep { step_s }, Replay { trajectory, statistics, findings }))
        };
        let growth = || {
            // A penalty run moves between springs, where perturbations grow otherwise than between
            // rigid walls.
            let model = Stepper::new(scene, method, run.grid.step)?.scene().clone();
            let growth = Growth::affordable(&model);
            Ok(match (&model.system, growth) {
                // With several degrees of freedom, where the exact scheme cannot follow the scene,
                // runs of the method itself show the growth.
                (System::Structure(_), Err(_)) => Growth::by_runs(scene, method, run.grid.step).ok(),
                (_, growth) => growth.ok(),
            })
        };
        let (growth, checked) = both(growth, check);
        let ((check, again), growth) = (checked?, growth?);
        // A run that diverged has no rows after that.
        let ended = [(&run.trajectory, &run.findings), (&again.trajectory, &again.findings)].map(|(rows, findings)| {
            let diverged = findings.iter().any(|found| found.refuted == Refuted::Diverged);
            if diverged { rows.time().last().copied().unwrap_or(0.0) } else { scene.duration }
        });
        let horizon_s = growth.map_or(scene.duration, |g| g.horizon(LARGEST_GROWTH)).min(ended[0]).min(ended[1]);
        let pair = ((&run.trajectory, &run.statistics), (&again.trajectory, &again.statistics));
        let change = Change::between(scene, pair.0, pair.1, horizon_s);
        let first = run.trajectory.time().get(1);
        let compared = first.is_some_and(|first| *first <= horizon_s * (1.0 + 1e-12));
        Ok(Self {
            work_rates: WorkRateVerdict::between(&run.statistics, &again.statistics),
            check,
            displacement: compared.then_some(change.displacement),
            length_m: error_length(scene, &again.trajectory),
            is_gap: scene.gap().is_some(),
            horizon_s,
            end_s: scene.duration,
            walls: wall_verdicts(scene, [pair.0, pair.1]),
            findings: again.findings,
        })
    }

    /// Largest change of a wall's impulse, as a share of the largest impulse at any wall of the
    /// run; 0 where nothing differs, infinite where the run has no impulse.
    #[must_use]
    pub fn impulse_change(&self) -> f64 {
        largest_change(self.walls.iter().map(|wall| wall.impulse_n_s))
    }

    /// True if the motions of run and check part before the end, so that what is compared over the
    /// whole run are differences between two motions, and no errors of one.
    #[must_use]
    pub fn parts(&self) -> bool {
        let rates = self.work_rates.iter().map(|support| support.work_rate_w);
        let mut told = self.walls.iter().map(|wall| wall.impulse_n_s).chain(rates);
        let differ = told.any(|[before, after]| (after - before).abs() > ALIKE * before.abs());
        let ends = self.horizon_s < self.end_s * (1.0 - 1e-9);
        self.displacement.is_some_and(|share| share > PARTED) || (ends && differ)
    }

    /// By how many contacts the check exceeds the run, all walls together.
    #[must_use]
    pub fn contacts_gained(&self) -> i64 {
        self.walls.iter().map(|w| w.contacts[1] as i64 - w.contacts[0] as i64).sum()
    }
}

/// The verdicts of the walls and round supports, by the motions and the statistics of the run and
/// of its check.
fn wall_verdicts(scene: &Scene, both: [(&Trajectory, &Statistics); 2]) -> Vec<WallVerdict> {
    let verdict = |site: ContactSite<'_>| WallVerdict {
        wall: site.name.to_owned(),
        kind: site.kind,
        impulse_n_s: both.map(|(_, s)| s.impulse(site.wall)),
        contacts: both.map(|(_, s)| s.contacts(site.wall)),
        peak_force_n: both.map(|(run, s)| s.peak_force(run.contacts(), site.wall)),
    };
    ContactSite::all(scene).filter(|site| !scene.is_slider(site.wall)).map(verdict).collect()
}

/// Largest change of a value of the run to that of its check, as a share of the largest value of
/// the run, so that a wall that is hardly touched, or in the check only, does not dominate; 0 where
/// nothing differs, infinite where all values of the run are 0.
#[must_use]
pub(crate) fn largest_change(values: impl Iterator<Item = [f64; 2]>) -> f64 {
    let (change, largest) = values.fold((0.0, 0.0), |(change, largest): (f64, f64), [before, after]| {
        (change.max((after - before).abs()), largest.max(before.abs()))
    });
    if change == 0.0 { 0.0 } else { change / largest }
}
