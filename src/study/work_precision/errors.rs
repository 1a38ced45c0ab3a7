//! The difference between two runs: four errors, each dimensionless.

use super::graph::{Graph, Scales};
use crate::order::sort_by_number;
use crate::scene::Scene;
use crate::step::Contact;
use crate::study::difference::{error_length, largest};
use crate::trajectory::Trajectory;

/// Errors of a run against a reference that shares its rows.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Errors {
    /// Largest |Δu| of any probe over the gap scale, at the rows.
    pub displacement: f64,
    /// Distance between the completed graphs (t, u, v), the largest over the eight fastest probes:
    /// see [`Graph`].
    pub velocity: f64,
    /// |ΔJ| of each wall, in the scene's order, over the sum of |J| of the reference at all walls;
    /// empty where the reference has no impulse.
    pub impulse: Vec<f64>,
    /// Largest |Δt| of matched contacts over the duration; `None` where no contacts match. Two
    /// contacts at one wall match if each is the nearest to the other.
    pub contact_time: Option<f64>,
    /// Contacts of the reference that the run lacks.
    pub missing: usize,
    /// Contacts of the run that the reference lacks.
    pub spurious: usize,
}

/// A motion that others are compared with.
#[derive(Debug, Clone)]
pub(super) struct Yardstick {
    pub scene: Scene,
    pub trajectory: Trajectory,
    /// Its step, s; 0 for an exact motion.
    pub step: f64,
    pub scales: Scales,
    /// Indices of the probes whose graphs are compared.
    fastest: Vec<usize>,
}

/// Most probes whose graphs are compared.
const MOST_GRAPHS: usize = 8;

impl Yardstick {
    /// `trajectory`, made with `step` (s), as the reference for other runs of `scene` up to `until`
    /// (s).
    pub fn new(scene: &Scene, trajectory: Trajectory, step: f64, until: f64) -> Self {
        let speed = largest(trajectory.velocities());
        let speed = trajectory.contacts().iter().fold(speed, |a, c| a.max(c.approach_speed));
        let speed = if speed > 0.0 { speed } else { 1.0 };
        let scales = Scales { duration: until.min(scene.duration), length: error_length(scene, &trajectory), speed };
        let fastest = fastest(trajectory.velocities());
        Self { scene: scene.clone(), trajectory, step, scales, fastest }
    }

    /// Errors of `run`, made with `step` (s; 0 for an exact run); its rows must be rows of this
    /// motion.
    pub fn errors(&self, run: &Trajectory, step: f64) -> Errors {
        let all = |t: &Trajectory| t.time().len().saturating_sub(1).max(1);
        let stride = (all(&self.trajectory) / all(run)).max(1);
        let rows = self.rows(run);
        let probes = self.trajectory.displacements().iter().zip(run.displacements());
        let pairs = probes.flat_map(|(mine, other)| mine.iter().step_by(stride).zip(other).take(rows));
        let displacement = pairs.map(|(x, y)| (x - y).abs()).fold(0.0, worst);
        let graph = |t: &Trajectory, probe, stride, step| Graph::of(t, probe, stride, step, &self.scene, &self.scales);
        let apart = |p| graph(run, p, 1, step).distance(&graph(&self.trajectory, p, stride, self.step));
        let mut errors = Errors {
            displacement: displacement / self.scales.length,
            velocity: self.fastest.iter().copied().map(apart).fold(0.0, worst),
            impulse: self.impulse(run),
            ..Errors::default()
        };
        for wall in 0..self.scene.walls.len() {
            self.match_contacts(wall, run, &mut errors);
        }
        errors
    }

    /// Number of rows of `run` that are compared.
    fn rows(&self, run: &Trajectory) -> usize {
        run.time().partition_point(|t| *t <= self.scales.duration * (1.0 + 1e-12))
    }

    fn impulse(&self, run: &Trajectory) -> Vec<f64> {
        let of = |t: &Trajectory, wall: &str| {
            t.contact_impulse(wall).map_or(0.0, |rows| rows.iter().take(self.rows(t)).sum::<f64>())
        };
        let names = || self.scene.walls.iter().map(|w| w.name.as_str());
        let total: f64 = names().map(|name| of(&self.trajectory, name).abs()).sum();
        if total > 0.0 {
            names().map(|name| (of(run, name) - of(&self.trajectory, name)).abs() / total).collect()
        } else {
            Vec::new()
        }
    }

    fn match_contacts(&self, wall: usize, run: &Trajectory, errors: &mut Errors) {
        let starts = |t: &Trajectory| {
            let here = |c: &&Contact| c.wall == wall && c.start <= self.scales.duration;
            t.contacts().iter().filter(here).map(|c| c.start).collect::<Vec<_>>()
        };
        let (mine, theirs) = (starts(&self.trajectory), starts(run));
        let mut matched = 0;
        for (i, t) in mine.iter().enumerate() {
            let Some(j) = nearest(&theirs, *t) else { continue };
            let Some(other) = theirs.get(j).filter(|other| nearest(&mine, **other) == Some(i)) else { continue };
            matched += 1;
            let difference = (other - t).abs() / self.scales.duration;
            errors.contact_time = Some(errors.contact_time.unwrap_or(0.0).max(difference));
        }
        errors.missing += mine.len() - matched;
        errors.spurious += theirs.len() - matched;
    }
}

impl Errors {
    /// The larger of each error.
    #[must_use]
    pub fn max(&self, other: &Self) -> Self {
        let longer = self.impulse.len().max(other.impulse.len());
        let at = |e: &Self, i: usize| e.impulse.get(i).copied().unwrap_or(0.0);
        Self {
            displacement: worst(self.displacement, other.displacement),
            velocity: worst(self.velocity, other.velocity),
            impulse: (0..longer).map(|i| worst(at(self, i), at(other, i))).collect(),
            contact_time: self.contact_time.into_iter().chain(other.contact_time).reduce(f64::max),
            missing: self.missing.max(other.missing),
            spurious: self.spurious.max(other.spurious),
        }
    }

    /// Each error raised to at least `least`, the uncertainty that rounding leaves.
    pub(crate) fn at_least(mut self, least: f64) -> Self {
        self.displacement = self.displacement.max(least);
        self.velocity = self.velocity.max(least);
        self.impulse.iter_mut().for_each(|e| *e = e.max(least));
        self.contact_time = self.contact_time.map(|e| e.max(least));
        self
    }

    /// The impulse error of the worst wall.
    #[must_use]
    pub fn worst_impulse(&self) -> Option<f64> {
        self.impulse.iter().copied().reduce(worst)
    }
}

/// Indices of the columns with the largest entries, at most [`MOST_GRAPHS`], in their order.
fn fastest(velocities: &[Vec<f64>]) -> Vec<usize> {
    let speed = |column: &Vec<f64>| column.iter().fold(0.0_f64, |most, v| most.max(v.abs()));
    let mut numbered: Vec<(usize, f64)> = velocities.iter().map(speed).enumerate().collect();
    sort_by_number(&mut numbered, |a| -a.1);
    numbered.truncate(MOST_GRAPHS);
    let mut numbers: Vec<usize> = numbered.into_iter().map(|n| n.0).collect();
    numbers.sort_unstable();
    numbers
}

/// The larger; NaN counts as the worst.
fn worst(a: f64, b: f64) -> f64 {
    if a.is_nan() || b.is_nan() { f64::NAN } else { a.max(b) }
}

/// Index of the member of an increasing list that is nearest to `t`.
fn nearest(list: &[f64], t: f64) -> Option<usize> {
    let after = list.partition_point(|x| *x < t);
    let before = after.checked_sub(1);
    match (before.and_then(|i| list.get(i)), list.get(after)) {
        (Some(a), Some(b)) => Some(if t - a <= b - t { after - 1 } else { after }),
        (Some(_), None) => before,
        (None, Some(_)) => Some(after),
        (None, None) => None,
    }
}
