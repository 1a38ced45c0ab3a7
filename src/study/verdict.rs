//! The refinement verdict: the same run with half the step, and the change that makes.

use super::change::Change;
use super::exact::{Replay, replay, stride};
use super::horizon::{Growth, LARGEST_GROWTH};
use crate::error::Result;
use crate::parallel::both;
use crate::residual::{Finding, Refuted};
use crate::run::{Options, Run, run_with_progress};
use crate::scene::{Scene, System};
use crate::scheme::{Method, Stepper};
use crate::statistics::{PlaceKind, Statistics};
use crate::time::TimeOptions;
use serde::Serialize;
use std::fmt;

/// Cost of a verdict, in runs like the one it checks.
pub const COST: f64 = 2.0;

/// Most walls that the text of a verdict names one by one.
const MOST_NAMED: usize = 4;

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
    /// Largest force of the run and of its check in that window, N; `None` where no force is
    /// finite.
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
    /// One entry per wall, then per round support, in the scene's order. Unlike displacements,
    /// these are compared over the whole run. Sliders have none: their normal impulse is given.
    pub walls: Vec<WallVerdict>,
    /// One entry per support, likewise.
    pub work_rates: Vec<WorkRateVerdict>,
    /// What the judge refutes in the check's own run; if there is anything, the verdict is
    /// meaningless.
    pub findings: Vec<Finding>,
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
        let work_rates =
            run.statistics.wear.iter().zip(&again.statistics.wear).map(|(before, after)| WorkRateVerdict {
                support: before.support.clone(),
                work_rate_w: [before.work_rate_w, after.work_rate_w],
                half_width_95_w: before.work_rate_half_width_95_w,
            });
        Ok(Self {
            work_rates: work_rates.collect(),
            check,
            displacement: compared.then_some(change.displacement),
            length_m: scene.gap_scale(),
            is_gap: scene.gap().is_some(),
            horizon_s,
            walls: wall_verdicts(scene, [&run.statistics, &again.statistics]),
            findings: again.findings,
        })
    }

    /// Largest change of a wall's impulse, as a share of the largest impulse at any wall in either
    /// run; 0 where nothing differs.
    #[must_use]
    pub fn impulse_change(&self) -> f64 {
        largest_change(self.walls.iter().map(|wall| wall.impulse_n_s))
    }

    /// The walls named in the text: all where they are few, else those with the largest impulses.
    fn foremost(&self) -> Vec<&WallVerdict> {
        let mut walls: Vec<&WallVerdict> = self.walls.iter().collect();
        if walls.len() > MOST_NAMED {
            walls.sort_by(|a, b| b.impulse_n_s[0].abs().total_cmp(&a.impulse_n_s[0].abs()));
            walls.truncate(MOST_NAMED);
        }
        walls
    }

    /// The supports named in the text: those with the largest work rates.
    fn hardest(&self) -> Vec<&WorkRateVerdict> {
        let mut supports: Vec<&WorkRateVerdict> = self.work_rates.iter().collect();
        if supports.len() > MOST_NAMED {
            supports.sort_by(|a, b| b.work_rate_w[0].total_cmp(&a.work_rate_w[0]));
            supports.truncate(MOST_NAMED);
        }
        supports
    }

    /// What the check changes in the displacement, as the rest of a sentence.
    pub(crate) fn displacement_words(&self) -> String {
        let horizon = match self.horizon_s {
            t if t < 0.1 => format!("{t:.3e}"),
            t => format!("{t:.4}"),
        };
        match self.displacement {
            None => format!(
                "was not compared: beyond t = {horizon} s, before the first row, a change of the start has grown \
                 {LARGEST_GROWTH:.0e}-fold, or a run has diverged"
            ),
            Some(share) if self.is_gap => format!("changes by {share:.1e} of the gap up to t = {horizon} s"),
            Some(share) => format!("changes by {:.1e} m up to t = {horizon} s", share * self.length_m),
        }
    }

    /// By how many contacts the check exceeds the run, all walls together.
    #[must_use]
    pub fn contacts_gained(&self) -> i64 {
        self.walls.iter().map(|w| w.contacts[1] as i64 - w.contacts[0] as i64).sum()
    }
}

impl fmt::Display for Verdict {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self.check {
            Check::HalfStep { step_s } => write!(f, "with half the step, {step_s:.3e} s,")?,
            Check::OtherRounding { .. } => f.write_str("the exact scheme has no step; with other roundings")?,
        }
        write!(f, " the displacement {}", self.displacement_words())?;
        for wall in self.foremost() {
            write!(f, "; {} {:?}: impulse {}", wall.kind.word(), wall.wall, relative(wall.impulse_n_s, "N s"))?;
            let [before, after] = wall.contacts;
            match before {
                _ if before != after => write!(f, ", contacts {before} → {after}")?,
                0 => f.write_str(", no contact as before")?,
                1 => f.write_str(", 1 contact as before")?,
                _ => write!(f, ", {before} contacts as before")?,
            }
            if let [Some(before), Some(after)] = wall.peak_force_n {
                write!(f, ", peak force {}", relative([before, after], "N"))?;
            }
        }
        if self.walls.len() > MOST_NAMED {
            write!(
                f,
                "; all {} walls: impulse {:.1e} of the largest wall's at most, contacts {:+}",
                self.walls.len(),
                self.impulse_change(),
                self.contacts_gained()
            )?;
        }
        self.hardest().into_iter().try_for_each(|support| write!(f, "; {support}"))
    }
}

impl fmt::Display for WorkRateVerdict {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "work rate of support {:?} {}", self.support, relative(self.work_rate_w, "W"))?;
        let [before, after] = self.work_rate_w;
        match self.half_width_95_w {
            Some(half) if before != after && (after - before).abs() <= half => {
                write!(f, ", within the run's own interval of ± {:.1e}", half / after.abs())
            }
            _ => Ok(()),
        }
    }
}

/// The verdicts of the walls that are not round, and then of the round supports, by the statistics
/// of the run and of its check.
fn wall_verdicts(scene: &Scene, both: [&Statistics; 2]) -> Vec<WallVerdict> {
    let contacts = |index: usize| both.map(|s| s.walls.get(index).map_or(0, |wall| wall.contacts));
    let flat = scene.walls.iter().enumerate().filter(|(index, wall)| !wall.is_round() && !scene.is_slider(*index));
    let flat = flat.map(|(index, wall)| WallVerdict {
        wall: wall.name.clone(),
        kind: PlaceKind::Wall,
        impulse_n_s: both.map(|s| s.impulse(index)),
        contacts: contacts(index),
        peak_force_n: both.map(|s| s.walls.get(index).and_then(|wall| wall.episode_peak_force_n.max)),
    });
    let round = scene.holes().map(|hole| WallVerdict {
        wall: hole.name.to_owned(),
        kind: PlaceKind::Support,
        impulse_n_s: both.map(|s| s.impulse(hole.index)),
        contacts: contacts(hole.index),
        peak_force_n: [None, None],
    });
    flat.chain(round).collect()
}

/// Largest change of a value of the run to that of its check, as a share of the largest value in
/// either, so that a wall that is hardly touched, or in one run only, does not dominate. With one
/// value this is the change over the larger of the two; 0 where nothing differs.
#[must_use]
pub(crate) fn largest_change(values: impl Iterator<Item = [f64; 2]>) -> f64 {
    let (change, largest) = values.fold((0.0, 0.0), |(change, largest): (f64, f64), [before, after]| {
        (change.max((after - before).abs()), largest.max(before.abs()).max(after.abs()))
    });
    if change == 0.0 { 0.0 } else { change / largest }
}

/// The change of a value in `unit`, as a share of the value after it.
fn relative([before, after]: [f64; 2], unit: &str) -> String {
    if before == after {
        "unchanged".into()
    } else if after == 0.0 {
        format!("{before:.1e} {unit} → none")
    } else {
        format!("{:+.1e} of its value", (after - before) / after.abs())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn verdict(impulses: &[[f64; 2]]) -> Verdict {
        let wall = |(i, &impulse_n_s): (usize, &[f64; 2])| WallVerdict {
            wall: format!("wall-{i}"),
            kind: PlaceKind::Wall,
            impulse_n_s,
            contacts: [1, 1],
            peak_force_n: [None, None],
        };
        let walls = impulses.iter().enumerate().map(wall).collect();
        Verdict {
            check: Check::HalfStep { step_s: 1e-3 },
            displacement: Some(0.0),
            length_m: 1e-3,
            is_gap: true,
            horizon_s: 1.0,
            walls,
            work_rates: Vec::new(),
            findings: Vec::new(),
        }
    }

    #[test]
    fn a_wall_that_only_one_run_touches_is_measured_by_the_largest() {
        assert!(verdict(&[[1.0, 1.1]]).to_string().contains(", 1 contact as before"));
        let one_run_only = verdict(&[[-2.0, -2.0], [0.5, 0.0], [0.0, -0.25]]);
        assert!((one_run_only.impulse_change() - 0.25).abs() < 1e-15);
        assert!(one_run_only.to_string().contains("5.0e-1 N s → none"), "{one_run_only}");
        assert!(verdict(&[[1.0, 0.8]]).to_string().contains("impulse -2.5e-1 of its value"));
        assert!(verdict(&[[0.0, 0.0], [0.0, 0.0]]).impulse_change() == 0.0);
        assert!((verdict(&[[1.0, 0.8]]).impulse_change() - 0.2).abs() < 1e-15);
    }

    #[test]
    fn a_work_rate_that_changes_less_than_it_scatters_says_so() {
        let said = |work_rate_w, half_width_95_w| {
            let support = WorkRateVerdict { support: "plate".to_owned(), work_rate_w, half_width_95_w };
            Verdict { work_rates: vec![support], ..verdict(&[]) }.to_string()
        };
        assert!(said([0.01, 0.02], Some(0.002)).ends_with("; work rate of support \"plate\" +5.0e-1 of its value"));
        let within = said([0.01, 0.0104], Some(0.001));
        assert!(within.ends_with("+3.8e-2 of its value, within the run's own interval of ± 9.6e-2"), "{within}");
        assert!(said([0.01, 0.01], Some(0.001)).ends_with("unchanged"));
        assert!(said([0.01, 0.0], Some(0.1)).contains("1.0e-2 W → none"));
    }

    #[test]
    fn a_displacement_that_was_not_compared_or_has_no_gap_does_not_read_as_a_share_of_it() {
        let mut said = Verdict { displacement: Some(1.3e-8), length_m: 2e-3, ..verdict(&[]) };
        assert_eq!(said.displacement_words(), "changes by 1.3e-8 of the gap up to t = 1.0000 s");
        said.is_gap = false;
        assert_eq!(said.displacement_words(), "changes by 2.6e-11 m up to t = 1.0000 s");
        (said.displacement, said.horizon_s) = (None, 2e-5);
        let words = said.displacement_words();
        assert!(words.starts_with("was not compared: beyond t = 2.000e-5 s"), "{words}");
    }
}
