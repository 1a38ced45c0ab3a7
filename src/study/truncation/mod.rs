//! Modal truncation: the effect of the modes left out, and the number of modes needed.
//!
//! A truncation without static correction keeps restitution but changes the mass that a wall feels,
//! 1/(g M⁻¹ gᵀ). This mass falls as modes are added (on a continuous string or bar to 0), and with
//! it the impulse of one impact, while the number of impacts grows. What converges is the total
//! impulse of the contacts. So a truncation is judged by each wall's impulse over the window of the
//! statistics, and by its largest force; or, where contacts are impacts without a finite force, by
//! the largest impulse of one contact.

mod choose;
mod unreduced;

pub use choose::{ChosenModes, MOST_CHOSEN, ModesLevel, choose_modes};
pub use unreduced::{Start, Unreduced};

use super::change::{Change, relative};
use super::difference::error_length;
use super::verdict::WorkRateVerdict;
use crate::error::Result;
use crate::residual::Finding;
use crate::run::{Options, Run, run_with_progress};
use crate::scene::Reduction;
use crate::scheme::Method;
use crate::statistics::PlaceKind;
use crate::time::TimeOptions;
use serde::Serialize;
use std::fmt;

/// One wall or round support in the run and in the run with more modes.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct WallTruncated {
    /// Its name.
    pub wall: String,
    /// Which of the two it is.
    pub kind: PlaceKind,
    /// Impulse over the window for statistics, N s, signed: of the run, and with more modes.
    pub impulse_n_s: [f64; 2],
    /// Its change, defined as [`WallChange::impulse`](super::change::WallChange::impulse).
    pub impulse_change: f64,
    /// Largest force in the window for statistics, N; `None` where an impact is among the contacts.
    pub peak_force_n: [Option<f64>; 2],
    /// Largest impulse of one contact in that window, N s; `None` without contact.
    pub largest_impulse_n_s: [Option<f64>; 2],
    /// Change of the peak force where both are finite, else of the largest impulse of one contact;
    /// as a share of the largest value at any wall.
    pub peak_change: f64,
    /// Mass that it feels, kg.
    pub effective_mass_kg: [f64; 2],
    /// Share of the static compliance at the wall that the modes carry, 0 to 1; NaN at a round
    /// support, where it depends on the direction.
    pub compliance_share: [f64; 2],
}

/// What one wall or round support felt in a run, in the window of the statistics.
struct Felt {
    /// Impulse, N s: of a wall signed, of a round support Σ|p|.
    impulse: f64,
    /// Largest force, N; `None` where an impact is among the contacts.
    peak: Option<f64>,
    /// Largest |impulse| of one contact, N s.
    largest: Option<f64>,
}

impl Felt {
    /// Number `index` of the walls of the run's scene.
    fn of(run: &Run, index: usize) -> Self {
        let statistics = &run.statistics;
        Self {
            impulse: statistics.impulse(index),
            peak: statistics.peak_force(run.trajectory.contacts(), index),
            largest: statistics.walls.get(index).and_then(|wall| wall.episode_impulse_n_s.max),
        }
    }
}

/// The effect of more modes on a run.
#[derive(Debug, Clone, PartialEq, Serialize)]
#[non_exhaustive]
pub struct Truncation {
    /// Number of modes of the run, and of the run it is compared with.
    pub modes: [usize; 2],
    /// Degrees of freedom of the whole structure, hence its number of modes.
    pub degrees_of_freedom: usize,
    /// True if walls were given the compliance of the modes left out.
    pub static_correction: bool,
    /// Largest |Δu| of the first probe over the gap scale, over the whole run; meaningless where
    /// the motion is chaotic.
    pub displacement: f64,
    /// That gap scale, m: [`Scene::gap_scale`](crate::Scene::gap_scale).
    pub length_m: f64,
    /// One entry per wall, then per round support, in the scene's order; none of a slider, whose
    /// normal force is given.
    pub walls: Vec<WallTruncated>,
    /// One entry per support: its work rate in the run and with more modes.
    pub work_rates: Vec<WorkRateVerdict>,
    /// What the judge refutes in the run with more modes; if there is anything, this comparison is
    /// meaningless.
    pub findings: Vec<Finding>,
}

impl Truncation {
    /// Compares `run` of the `reduction`, made by `method` with the options `time`, with the run of
    /// twice its modes, or of all of them; where these do not move every wall, of more. `None` if
    /// it has all. `progress` is called with the time (s) that the other run has reached.
    ///
    /// # Errors
    /// Errors of the other reduction or run.
    pub fn of(
        whole: &Unreduced,
        reduction: &Reduction,
        run: &Run,
        method: &Method,
        time: &TimeOptions,
        progress: &mut dyn FnMut(f64),
    ) -> Result<Option<Self>> {
        let Some(more) = whole.check_of(reduction, |modes| whole.cut(modes))? else { return Ok(None) };
        // The same rows for any scheme.
        let rows = TimeOptions { sample: Some(run.grid.row_spacing()), ..*time };
        let options = Options::new(rows);
        let against = run_with_progress(&more.scene, method, &options, progress)?;
        let between = Self::between(whole, [reduction, &more], [run, &against]);
        Ok(Some(Self { findings: against.findings, ..between }))
    }

    /// The changes from one reduction and its run to the other.
    fn between(whole: &Unreduced, cuts: [&Reduction; 2], runs: [&Run; 2]) -> Self {
        let [run, against] = runs;
        let change = Change::of_runs(&cuts[1].scene, run, against, against.grid.end);
        let mut walls = Vec::new();
        // Changes are shares of the largest wall's value, so that a wall that is hardly touched, or
        // in one of the runs only, does not dominate.
        let scene = &cuts[1].scene;
        // Sliders come after all walls of a reduction, and are none of them.
        let count = cuts[1].walls.len();
        let felt: Vec<[Felt; 2]> = (0..count).map(|index| runs.map(|run| Felt::of(run, index))).collect();
        let most = |part: fn(&Felt) -> Option<f64>| felt.iter().flatten().filter_map(part).fold(0.0, f64::max);
        let (most_force, most_impulse) = (most(|felt| felt.peak), most(|felt| felt.largest));
        let masses = cuts.map(|cut| cut.scene.wall_masses());
        for (wall, felt) in change.walls.iter().filter_map(|wall| Some((wall, felt.get(wall.index)?))) {
            let index = wall.index;
            let peaks = [felt[0].peak, felt[1].peak];
            let largest = [felt[0].largest, felt[1].largest];
            let peak_change = match peaks {
                [Some(a), Some(b)] => relative([a, b], most_force),
                _ => relative(largest.map(|x| x.unwrap_or(0.0)), most_impulse),
            };
            let kept = cuts.map(|cut| cut.walls.get(index).copied());
            walls.push(WallTruncated {
                wall: wall.wall.clone(),
                kind: wall.kind,
                impulse_n_s: [felt[0].impulse, felt[1].impulse],
                impulse_change: wall.impulse,
                peak_force_n: peaks,
                largest_impulse_n_s: largest,
                peak_change,
                effective_mass_kg: [0, 1].map(|cut: usize| masses[cut].get(index).copied().unwrap_or(f64::NAN)),
                compliance_share: kept.map(|w| w.map_or(f64::NAN, |w| w.share())),
            });
        }
        Self {
            modes: cuts.map(|cut| cut.modes.count()),
            degrees_of_freedom: cuts[0].degrees_of_freedom,
            static_correction: whole.static_correction,
            displacement: change.displacement,
            length_m: error_length(scene, &against.trajectory),
            walls,
            work_rates: WorkRateVerdict::between(&run.statistics, &against.statistics),
            findings: Vec::new(),
        }
    }

    /// The largest change of any wall's impulse or peak, and of any support's work rate as a share
    /// of the largest, and the quantity it belongs to; in a scene without walls, of the
    /// displacement and of work rates.
    #[must_use]
    pub fn worst(&self) -> (f64, String) {
        let most = self.work_rates.iter().flat_map(|one| one.work_rate_w).fold(0.0, f64::max);
        let change = |one: &WorkRateVerdict| relative(one.work_rate_w, most);
        let of_walls = match self.walls.is_empty() {
            true => (self.displacement, "displacement".to_owned()),
            false => self.worst_of_walls(),
        };
        let rates = self.work_rates.iter().map(|one| (change(one), format!("work rate of support {:?}", one.support)));
        rates.fold(of_walls, |worst, rate| if rate.0 > worst.0 { rate } else { worst })
    }

    fn worst_of_walls(&self) -> (f64, String) {
        let parts = self.walls.iter().flat_map(|w| {
            let peak = if w.peak_force_n.iter().all(Option::is_some) {
                "peak force"
            } else {
                "largest impulse of one contact"
            };
            [(w.impulse_change, "impulse", w), (w.peak_change, peak, w)]
        });
        let mut worst = (0.0, "impulse".to_owned());
        for (part, name, wall) in parts {
            if part > worst.0 || part.is_nan() {
                worst = (part, format!("{name} of {} {:?}", wall.kind.word(), wall.wall));
            }
        }
        worst
    }
}

impl fmt::Display for Truncation {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let [kept, more] = self.modes;
        write!(f, "with {more} of {} modes in place of {kept}", self.degrees_of_freedom)?;
        self.write_walls(f)?;
        WorkRateVerdict::hardest(&self.work_rates).into_iter().try_for_each(|support| write!(f, "; {support}"))
    }
}

impl Truncation {
    /// Writes what changes at the walls; without any, of the displacement.
    fn write_walls(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        if self.walls.is_empty() {
            return write!(f, " the displacement changes by {:.1e} m", self.displacement * self.length_m);
        }
        let largest = |part: fn(&WallTruncated) -> f64| {
            self.walls.iter().max_by(|a, b| part(a).total_cmp(&part(b))).map(|w| (part(w), w))
        };
        if let (Some((impulse, at)), Some((peak, peak_at))) =
            (largest(|w| w.impulse_change), largest(|w| w.peak_change))
        {
            write!(
                f,
                " the impulse changes by up to {:.2} % of the largest ({} {:?}: {:+.4} to {:+.4} N s)",
                100.0 * impulse,
                at.kind.word(),
                at.wall,
                at.impulse_n_s[0],
                at.impulse_n_s[1]
            )?;
            write!(
                f,
                ", the peak by up to {:.2} % of the largest ({} {:?}: ",
                100.0 * peak,
                peak_at.kind.word(),
                peak_at.wall
            )?;
            match (peak_at.peak_force_n, peak_at.largest_impulse_n_s) {
                ([Some(a), Some(b)], _) => write!(f, "{a:.4} to {b:.4} N)")?,
                (_, [a, b]) => {
                    write!(
                        f,
                        "largest impulse of one contact {:.4e} to {:.4e} N s)",
                        a.unwrap_or(0.0),
                        b.unwrap_or(0.0)
                    )?;
                }
            }
        }
        if !self.static_correction
            && let Some((_, wall)) = largest(|w| w.effective_mass_kg[0] / w.effective_mass_kg[1])
        {
            let [kept, more] = wall.effective_mass_kg;
            write!(
                f,
                "; the mass that {} {:?} feels goes from {kept:.4} to {more:.4} kg",
                wall.kind.word(),
                wall.wall
            )?;
        }
        Ok(())
    }
}
