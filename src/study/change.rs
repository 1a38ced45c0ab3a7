//! The difference between two runs of one scene, in displacements and in contact quantities.

use super::difference::{self, wall_speeds, worse};
use crate::run::Run;
use crate::scene::Scene;
use crate::statistics::{ContactSite, PlaceKind, Statistics, WallStatistics};
use crate::step::Contact;
use crate::trajectory::Trajectory;
use serde::Serialize;

/// Contacts slower than this share of the fastest at their wall are grazes, or the end of an
/// accumulation of impacts.
const SLOW: f64 = 1e-2;

/// Difference between two runs. Every number is dimensionless, and zero where nothing differs.
#[derive(Debug, Clone, PartialEq, Serialize)]
#[non_exhaustive]
pub struct Change {
    /// Largest |Δu| of any probe over the gap, or without one over the largest displacement, at the
    /// rows up to the time asked for.
    pub displacement: f64,
    /// One entry per wall, then per round support, in the scene's order.
    pub walls: Vec<WallChange>,
}

/// Changes at one wall or round support, over the window of the statistics. Each is relative to the
/// largest value at any wall of the scene, or to the value of a single impact at the speed v if
/// that is larger (with the mass m that the wall feels, [`Scene::wall_masses`]): the largest at
/// which this wall is struck in the window, and at least a hundredth of that of the body there;
/// where it is not struck, all of that. So a wall that one of two motions grazes does not dominate,
/// and one that both touch softly counts by what it gets.
#[derive(Debug, Clone, PartialEq, Serialize)]
#[non_exhaustive]
pub struct WallChange {
    /// Its name.
    pub wall: String,
    /// Which of the two it is.
    pub kind: PlaceKind,
    /// Its index among the walls of the scene.
    #[serde(skip)]
    pub(crate) index: usize,
    /// Change of its impulse, at a round support of Σ|p|; the reference is at least m v.
    pub impulse: f64,
    /// Change of its number of contacts; the reference is at least 1. `None` at a rigid wall where
    /// impacts accumulate (0 < e < 1, and a contact lasts or some impacts are slower than 1 % of
    /// the fastest): of infinitely many impacts a stepping scheme makes as many as its step
    /// resolves, so their number has no limit. Impulse, energy and time of contact do converge.
    pub contacts: Option<f64>,
    /// Change of the kinetic energy that arrived at it; the reference is at least ½ m v².
    pub impact_energy: f64,
    /// Change of its time in contact, as a share of the window.
    pub contact_time: f64,
    /// Change of its largest force, if the wall is elastic; the reference is at least v √(k_a m).
    pub peak_force: f64,
}

impl WallChange {
    fn parts(&self) -> impl Iterator<Item = (f64, &'static str)> {
        let parts = [
            (self.impulse, "impulse"),
            (self.contacts.unwrap_or(0.0), "number of contacts"),
            (self.impact_energy, "impact energy"),
            (self.contact_time, "contact time"),
            (self.peak_force, "peak force"),
        ];
        parts.into_iter()
    }
}

impl Change {
    /// The change from `run` to `against`, both runs of `scene` with the same rows and the same
    /// window of statistics; the statistics must hold the forces over time. Displacements are
    /// compared up to the time `until` (s).
    #[must_use]
    pub fn between(
        scene: &Scene,
        run: (&Trajectory, &Statistics),
        against: (&Trajectory, &Statistics),
        until: f64,
    ) -> Self {
        let statistics = [run.1, against.1];
        let (run, against) = (run.0, against.0);
        let from = statistics[1].from_s;
        let length = difference::error_length(scene, against);
        let rows = difference::rows(run, against).take_while(|(t, _)| *t <= until * (1.0 + 1e-12));
        let displacement = rows.fold(0.0, |largest, (_, difference)| worse(largest, difference / length));
        let speeds = wall_speeds(scene, against, from);
        let masses = scene.wall_masses();
        let window = statistics[1].to_s - from;
        let numbers = |index: usize| [run, against].map(|t| number(scene, t.contacts(), index, from));
        let of =
            |index: usize, part: fn(&WallStatistics) -> f64| statistics.map(|s| s.walls.get(index).map_or(0.0, part));
        let power = |index: usize| of(index, |w| w.impact_power_w);
        // A rigid wall has a finite force in lasting contacts only.
        let spring = |index: usize| scene.walls.get(index).and_then(|wall| wall.law.spring());
        let force = |index: usize| of(index, |w| w.episode_peak_force_n.max.unwrap_or(0.0));
        // Largest value of any wall, taken from the motion compared with.
        let mut most = Largest::default();
        for index in 0..scene.walls.len() {
            most.impulse = most.impulse.max(statistics[1].impulse(index).abs());
            most.number = most.number.max(numbers(index)[1].unwrap_or(0.0));
            most.power = most.power.max(power(index)[1]);
            if spring(index).is_some() {
                most.force = most.force.max(force(index)[1]);
            }
        }
        let change = |site: ContactSite<'_>| {
            let index = site.wall;
            let [mass, speed] = [&masses, &speeds].map(|list| list.get(index).copied().unwrap_or(0.0));
            let contacts = match numbers(index) {
                [Some(a), Some(b)] => Some(relative([a, b], most.number.max(1.0))),
                _ => None,
            };
            let [time, time_against] = of(index, |w| w.contact_time_ratio);
            let peak_force = spring(index)
                .map_or(0.0, |spring| relative(force(index), most.force.max(speed * (spring.stiffness * mass).sqrt())));
            WallChange {
                wall: site.name.to_owned(),
                kind: site.kind,
                index,
                impulse: relative(statistics.map(|s| s.impulse(index)), most.impulse.max(mass * speed)),
                contacts,
                impact_energy: relative(power(index), most.power.max(0.5 * mass * speed * speed / window)),
                contact_time: (time - time_against).abs(),
                peak_force,
            }
        };
        let walls = ContactSite::all(scene).map(change).collect();
        Self { displacement, walls }
    }

    /// The same between two finished runs with the same window of statistics.
    #[must_use]
    pub fn of_runs(scene: &Scene, run: &Run, against: &Run, until: f64) -> Self {
        let against = (&against.trajectory, &against.statistics);
        Self::between(scene, (&run.trajectory, &run.statistics), against, until)
    }

    /// The largest of all changes, and the quantity it belongs to.
    #[must_use]
    pub fn worst(&self) -> (f64, String) {
        let mut worst = (self.displacement, "displacement".to_owned());
        for wall in &self.walls {
            for (part, name) in wall.parts() {
                if part > worst.0 || part.is_nan() && !worst.0.is_nan() {
                    worst = (part, format!("{name} of {} {:?}", wall.kind.word(), wall.wall));
                }
            }
        }
        worst
    }
}

pub(super) fn relative([a, b]: [f64; 2], least: f64) -> f64 {
    let difference = (a - b).abs();
    if difference == 0.0 { 0.0 } else { difference / b.abs().max(least) }
}

/// Largest values at any wall or round support.
#[derive(Debug, Default)]
struct Largest {
    /// Impulse, N s.
    impulse: f64,
    number: f64,
    /// Power of impacts, W.
    power: f64,
    /// Force of elastic walls, N.
    force: f64,
}

/// Contacts of a wall or round support that begin at or after `from` (s); `None` where impacts
/// accumulate. Slow contacts count in proportion to their speed, so that a graze that only one of
/// two runs has changes little.
fn number(scene: &Scene, contacts: &[Contact], wall: usize, from: f64) -> Option<f64> {
    let here = contacts.iter().filter(|c| c.wall == wall && c.start >= from);
    let speeds = here.clone().map(|c| c.approach_speed);
    let slow = SLOW * speeds.clone().fold(0.0, f64::max);
    let bounces = |e: f64| e > 0.0 && e < 1.0;
    // Where the step is too long for slow impacts, they appear as the lasting contact at their end.
    let lasts = here.clone().any(|c| c.end != Some(c.start));
    let settles = lasts || speeds.clone().filter(|v| *v < slow).count() > 1;
    let restitution = scene.walls.get(wall).and_then(|wall| wall.law.restitution());
    let accumulates = restitution.is_some_and(bounces) && settles;
    (!accumulates).then(|| speeds.map(|v| if v >= slow { 1.0 } else { v / slow }).sum())
}

/// The time (s) up to which the displacements of two runs with the same rows agree at every probe
/// to within `tolerance` of the gap, or without one of the largest displacement.
pub(crate) fn agree_until(scene: &Scene, run: &Trajectory, against: &Trajectory, tolerance: f64) -> f64 {
    let length = difference::error_length(scene, against);
    if against.displacements().is_empty() {
        return scene.duration;
    }
    let mut until = 0.0;
    for (t, difference) in difference::rows(run, against) {
        let agrees = difference <= tolerance * length;
        if !agrees {
            return until;
        }
        until = t;
    }
    until
}
