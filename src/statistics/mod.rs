//! Contact statistics: the quantities of a run that wear models need.
//!
//! Everything here refers to one window, from `statistics_from` to the end. Batch means measure how
//! much a number scatters within the window: ten equal batches, of whole periods where the loads
//! have a common period, give the half width of a 95 % interval. It is the sampling error of a
//! motion that does not repeat itself, not the error of the time step. Fewer than ten events cannot
//! fill ten batches: then there is no interval. Extremes have no interval in any case, since the
//! largest of a longer window is larger.
//!
//! # Files
//!
//! Contact statistics for wear models, over one window; `force.rs` sums up each wall's force over
//! time, piece by piece of each step (`step_force.rs`), `support.rs` that of each support,
//! `largest_force.rs` finds the stretch in which it is largest, `wear_tally.rs` sums up the work of
//! wear of every support; `batch.rs` and `student.rs` make intervals; `settling.rs` finds windows
//! that begin too early; `episodes.rs` joins contacts into episodes, `distribution.rs` counts them,
//! `summary.rs` has mean and largest, `place.rs` names where they are, `spectrum.rs` estimates
//! spectra, `recovered.rs` compares those of turbulent forces with what was asked.

mod batch;
mod distribution;
mod episodes;
mod force;
mod largest_force;
mod place;
#[cfg(feature = "cli")]
mod recovered;
mod settling;
mod spectrum;
mod step_force;
mod student;
mod summary;
mod support;
mod wear_tally;

pub use distribution::Distribution;
pub use episodes::EpisodeStatistics;
pub use force::{ForceStatistics, Forces};
pub use largest_force::LargestForce;
pub(crate) use place::ContactSite;
pub use place::{ContactPlace, PlaceKind};
#[cfg(feature = "cli")]
pub(crate) use recovered::{Pair, Recovered};
pub use settling::Unsettled;
#[cfg(feature = "case")]
pub(crate) use spectrum::FEWEST as FEWEST_VALUES;
pub use spectrum::Spectrum;
pub(crate) use student::{spread, student_95};
pub use summary::Summary;
pub use support::{SupportForce, SupportStatistics};
pub use wear_tally::{SectorStatistics, WearStatistics, WearTally};

use crate::scene::{Scene, Wall};
use crate::step::Contact;
use batch::{BATCHES, NO_SUMS, Window};
use serde::{Deserialize, Serialize};

/// Half widths of the 95 % intervals, by batch means, of the quantities drawn from a wall's
/// contacts; there are none where fewer than ten contacts began in the window.
#[derive(Debug, Clone, Copy, Default, PartialEq, Serialize, Deserialize)]
#[non_exhaustive]
pub struct HalfWidths {
    /// Of the rate of contacts, 1/s.
    pub contact_rate_per_s: f64,
    /// Of the share of time in contact.
    pub contact_time_ratio: f64,
    /// Of the mean impulse of an episode, N s: by the ratio estimator, t √(Σ(xₖ − R nₖ)²/9/10)/n̄
    /// with R = Σxₖ/Σnₖ, since the number nₖ of episodes in a batch scatters too (Crane & Iglehart
    /// 1975, doi:10.1287/opre.23.1.33).
    pub episode_impulse_n_s: f64,
    /// Of the mean peak of an episode, N, likewise; `None` where fewer than ten episodes had a
    /// finite force.
    pub episode_peak_force_n: Option<f64>,
    /// Of the impact power, W.
    pub impact_power_w: f64,
    /// Of the power that arrived minus the power that left, W.
    pub arrived_less_departed_power_w: f64,
}

/// Contacts at one wall within the window. An episode counts if it begins in the window; contact
/// time counts as far as it lies in the window.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[non_exhaustive]
pub struct WallStatistics {
    /// The wall's name.
    pub wall: String,
    /// True for a round wall, whose impulse and force count by their magnitude.
    #[serde(default)]
    pub round: bool,
    /// Number of contact episodes that began in the window.
    pub contacts: usize,
    /// That number per second.
    pub contact_rate_per_s: f64,
    /// Time in contact over the window's length.
    pub contact_time_ratio: f64,
    /// The wall's force over time; `None` where only the contacts are known.
    pub force: Option<ForceStatistics>,
    /// Its largest force: of an elastic wall at an instant, of a rigid one the largest mean over a
    /// stretch. `None` where nothing pushed. Where only the contacts are known, the largest force
    /// of those in which it is finite.
    #[serde(default)]
    pub force_largest: Option<LargestForce>,
    /// Largest |force| of each episode that overlaps the window and whose force is finite, N: at an
    /// elastic wall that in the window, in a lasting contact on a rigid one that of the whole
    /// episode, as both where the contacts alone are known. The mean is over episodes.
    pub episode_peak_force_n: Summary,
    /// |impulse| of each episode that began in the window, N s.
    pub episode_impulse_n_s: Summary,
    /// Kinetic energy that arrived at the wall per unit time, Σ ½m·approach²/T, W, with m the mass
    /// that the wall feels ([`Scene::wall_masses`]). The motion is normal to the wall and
    /// frictionless: this is impact power and contains no sliding wear.
    pub impact_power_w: f64,
    /// That power minus the kinetic energy with which the body left, Σ ½m(approach² −
    /// departure²)/T, W; what rests at a rigid wall has not left with any. At impacts this is what
    /// restitution dissipates. In a lasting contact (elastic walls, penalties, rest) the loads and
    /// the structure do work on the body, and that work is included: the value is negative where
    /// the body leaves with more energy than it brought. What dashpots of walls dissipate is
    /// [`Energy::wall_damping_j`](crate::residual::Energy::wall_damping_j).
    pub arrived_less_departed_power_w: f64,
    /// Half widths of the intervals of the numbers above; those of the force are in `force`.
    pub half_width_95: Option<HalfWidths>,
}

impl WallStatistics {
    /// Whether its mean force has an interval.
    fn has_mean(&self) -> bool {
        self.force.is_some_and(|force| force.mean_half_width_95_n.is_some())
    }
}

/// Contact statistics of a run.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[non_exhaustive]
pub struct Statistics {
    /// Start of the window, s.
    pub from_s: f64,
    /// End of the window, s.
    pub to_s: f64,
    /// Number of batches from which half widths are made.
    #[serde(default)]
    pub batches: usize,
    /// Forcing periods in each batch; `None` where the loads have no common period, or the window
    /// has fewer than three: then its batches are equal parts of the window.
    #[serde(default)]
    pub periods_per_batch: Option<u64>,
    /// One entry per wall, in the scene's order.
    pub walls: Vec<WallStatistics>,
    /// One entry per support, in the scene's order; flats are walls too.
    #[serde(default)]
    pub supports: Vec<SupportStatistics>,
    /// What slides at each support, in the scene's order; empty in one plane, and where only the
    /// contacts are known.
    #[serde(default)]
    pub wear: Vec<WearStatistics>,
    /// Mean forces of walls and work rates of supports that have an interval, and are others in the
    /// beginning of the window than in the rest of it; where the force over time is known.
    #[serde(default)]
    pub unsettled: Vec<Unsettled>,
}

impl Statistics {
    /// Statistics of `contacts` from the time `from` (s) to the scene's end, without the force over
    /// time. A `from` below 0 is 0. If it is at or after the end, or NaN, the window has length 0,
    /// and times and powers are 0.
    #[must_use]
    pub fn new(scene: &Scene, contacts: &[Contact], from: f64) -> Self {
        Self::of(scene, &scene.wall_masses(), contacts, from)
    }

    /// As [`Statistics::new`], for a scene whose walls feel `masses` (kg).
    pub(crate) fn of(scene: &Scene, masses: &[f64], contacts: &[Contact], from: f64) -> Self {
        let window = Window::new(scene, from);
        let (from, to) = (window.from, scene.duration);
        let by_wall = by_wall(contacts, scene.walls.len());
        let wall = |(index, (wall, all)): (usize, (&Wall, &Vec<&Contact>))| {
            of_wall(wall, all, masses.get(index).copied().unwrap_or(0.0), &window)
        };
        let walls = scene.walls.iter().zip(&by_wall).enumerate().map(wall).collect();
        let supports = support::of_supports(scene, &by_wall, &window);
        let Window { batches, periods, .. } = window;
        Self {
            from_s: from,
            to_s: to,
            batches,
            periods_per_batch: periods,
            walls,
            supports,
            wear: Vec::new(),
            unsettled: Vec::new(),
        }
    }

    /// Adds the force over time, as summed step by step.
    #[must_use]
    pub fn with_forces(mut self, forces: &Forces) -> Self {
        for (index, wall) in self.walls.iter_mut().enumerate() {
            wall.force = forces.statistics(index, wall.contacts);
            if let Some(force) = wall.force {
                wall.force_largest = match force.rms_averaged_over_s {
                    None => LargestForce::of_elastic(wall.force_largest, force.largest),
                    Some(_) => force.largest,
                };
            }
        }
        let contacts = |index: usize| self.supports.get(index).map_or(0, |support| support.contacts);
        let all = forces.of_supports(contacts);
        self.supports.iter_mut().zip(all).for_each(|(support, force)| support.add_force(force));
        let means = self.means();
        for (index, wall) in self.walls.iter().enumerate().filter(|(_, wall)| wall.has_mean()) {
            let place = || ContactPlace { name: wall.wall.clone(), kind: PlaceKind::Wall };
            self.unsettled.extend(forces.beginning(index, means).map(|found| Unsettled::of(place(), false, found)));
        }
        self
    }

    /// Adds what slides at supports, as summed step by step.
    pub(crate) fn with_wear(mut self, wear: &WearTally) -> Self {
        self.wear = wear.statistics();
        let means = self.means();
        for (index, own) in self.wear.iter().enumerate().filter(|(_, own)| own.work_rate_half_width_95_w.is_some()) {
            let place = || ContactPlace { name: own.support.clone(), kind: PlaceKind::Support };
            self.unsettled.extend(wear.beginning(index, means).map(|found| Unsettled::of(place(), true, found)));
        }
        self
    }

    /// How many means are looked at for [`Statistics::unsettled`].
    fn means(&self) -> usize {
        self.walls.len() + self.supports.len()
    }

    /// Impulse of the wall number `wall` on the body over the window, N s, signed as the force; 0
    /// where it is not known.
    pub(crate) fn impulse(&self, wall: usize) -> f64 {
        self.walls.get(wall).and_then(|wall| wall.force).map_or(0.0, |force| force.impulse_n_s)
    }

    /// Contacts with the wall number `wall` that began in the window.
    pub(crate) fn contacts(&self, wall: usize) -> usize {
        self.walls.get(wall).map_or(0, |wall| wall.contacts)
    }

    /// Largest force of those of all `contacts` with the wall number `wall` that reach into the
    /// window, N; `None` where an impact is among them, whose force is not finite.
    pub(crate) fn peak_force(&self, contacts: &[Contact], wall: usize) -> Option<f64> {
        let reaches = |c: &&Contact| c.wall == wall && c.end.is_none_or(|end| end >= self.from_s);
        let struck = contacts.iter().filter(reaches).any(|c| c.peak_force.is_none());
        self.walls.get(wall).and_then(|wall| wall.episode_peak_force_n.max).filter(|_| !struck)
    }
}

/// The contacts of each of so many walls.
fn by_wall(contacts: &[Contact], walls: usize) -> Vec<Vec<&Contact>> {
    let mut by_wall = vec![Vec::new(); walls];
    for contact in contacts {
        if let Some(list) = by_wall.get_mut(contact.wall) {
            list.push(contact);
        }
    }
    by_wall
}

fn of_wall(wall: &Wall, all: &[&Contact], mass: f64, window: &Window) -> WallStatistics {
    let Window { from, length, .. } = *window;
    let to = from + length;
    let per_time = |x: f64| if length > 0.0 { x / length } else { 0.0 };
    let here = all.iter().copied().filter(|c| c.start >= from);
    let energy = |speed: f64| 0.5 * mass * speed * speed;
    // An empty sum of floats is −0; starting from 0 prints 0.
    let total = |values: &mut dyn Iterator<Item = f64>| values.fold(0.0, |sum, x| sum + x);
    let end = |c: &Contact| c.end.unwrap_or(to).min(to);
    let lost = |c: &Contact| match c.departure_speed {
        Some(departure) => energy(c.approach_speed) - energy(departure),
        // What still rests at a rigid wall has left with nothing so far; a spring may give it back.
        None if wall.law.is_rigid() => energy(c.approach_speed),
        None => 0.0,
    };
    let touching = |[a, b]: [f64; 2]| total(&mut all.iter().map(|c| (end(c).min(b) - c.start.max(a)).max(0.0)));
    let contacts = here.clone().count();
    let reaching = all.iter().filter(|c| c.end.is_none_or(|end| end >= from));
    let arrived = total(&mut here.clone().map(|c| energy(c.approach_speed)));
    let peaks = reaching.clone().filter_map(|c| Some((c.start, c.peak_force?)));
    let [mut counts, mut times, mut powers, mut left, mut impulses] = [NO_SUMS; 5];
    for c in here.clone() {
        let k = window.index(c.start);
        counts[k] += 1.0;
        impulses[k] += c.impulse.abs();
        powers[k] += energy(c.approach_speed);
        left[k] += lost(c);
    }
    for (k, time) in times.iter_mut().take(window.batches).enumerate() {
        *time = touching([window.start_of(k), window.start_of(k + 1)]);
    }
    times[BATCHES] = touching([from, window.first]);
    let half_widths = || {
        Some(HalfWidths {
            contact_rate_per_s: window.half_width(&counts)?,
            contact_time_ratio: window.half_width(&times)?,
            episode_impulse_n_s: window.ratio_half_width(&impulses, &counts).unwrap_or(0.0),
            episode_peak_force_n: scatter_of_peaks(peaks.clone(), window),
            impact_power_w: window.half_width(&powers)?,
            arrived_less_departed_power_w: window.half_width(&left)?,
        })
    };
    let half_width_95 = (contacts >= BATCHES && length > 0.0).then(half_widths).flatten();
    WallStatistics {
        wall: wall.name.clone(),
        round: wall.is_round(),
        contacts,
        contact_rate_per_s: per_time(contacts as f64),
        contact_time_ratio: per_time(touching([from, to])),
        force: None,
        force_largest: LargestForce::of_contacts(reaching.copied(), [from, to]),
        episode_peak_force_n: Summary::of(peaks.map(|(_, force)| force)),
        episode_impulse_n_s: Summary::of(here.clone().map(|c| c.impulse.abs())),
        impact_power_w: per_time(arrived),
        arrived_less_departed_power_w: per_time(total(&mut here.map(lost))),
        half_width_95,
    }
}

/// Half width of the 95 % interval of the mean of `peaks` (time at which the episode began, s;
/// force, N) in the window; `None` for fewer than ten.
fn scatter_of_peaks(peaks: impl Iterator<Item = (f64, f64)>, window: &Window) -> Option<f64> {
    let [mut counts, mut sums] = [NO_SUMS; 2];
    for (start, force) in peaks {
        // An episode that began before the window counts at its start.
        let k = window.index(start.max(window.from));
        counts[k] += 1.0;
        sums[k] += force;
    }
    if counts.iter().sum::<f64>() < BATCHES as f64 { None } else { window.ratio_half_width(&sums, &counts) }
}

#[cfg(test)]
mod tests;
