//! The force of a support over time: that of all its flats together, or of a round hole.

use super::batch::{BatchSums, NO_SUMS, Window};
use super::largest_force::LargestForce;
use super::summary::Summary;
use crate::scene::{Face, Scene, Support, Wall, heading};
use crate::step::{Contact, Path, Step};
use serde::{Deserialize, Serialize};

/// Statistics of one support within the window.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[non_exhaustive]
pub struct SupportStatistics {
    /// The support's name.
    pub support: String,
    /// Number of contacts that began in the window, of all its flats.
    pub contacts: usize,
    /// Largest |normal force| of each contact that overlaps the window, N; nothing where one of
    /// them was an impact on a rigid support, whose force is not finite.
    #[serde(default)]
    pub episode_peak_force_n: Summary,
    /// The force over time; `None` where only the contacts are known.
    pub force: Option<SupportForce>,
    /// Its largest normal force: of an elastic support at an instant, of a rigid one the largest
    /// mean over a stretch, [`SupportForce::largest`]. At an instant it is that of one flat; where
    /// the mean of several that push together is larger, it is that mean. `None` where nothing
    /// pushed.
    #[serde(default)]
    pub force_largest: Option<LargestForce>,
}

impl SupportStatistics {
    /// Adds the force over time.
    pub(super) fn add_force(&mut self, force: SupportForce) {
        self.force_largest = LargestForce::of_elastic(self.force_largest, force.largest);
        self.force = Some(force);
    }
}

/// The force of one support over the window.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
#[non_exhaustive]
pub struct SupportForce {
    /// Mean over time of the |normal force|, at flats of all of them together, Σ|p|/T, N.
    pub mean_n: f64,
    /// Half width of its 95 % interval by batch means, N. This and those below are `None` unless
    /// ten contacts began in the window, or the support pushed in each of its batches.
    pub mean_half_width_95_n: Option<f64>,
    /// That mean over the first and over the last half of the batches, N.
    #[serde(default)]
    pub mean_of_halves_n: [f64; 2],
    /// Mean of the force vector on the structure, along y and z, with friction, N: what the support
    /// carries.
    pub mean_vector_n: [f64; 2],
    /// Half widths of their 95 % intervals, N.
    pub mean_vector_half_width_95_n: Option<[f64; 2]>,
    /// Root mean square of the force vector averaged over intervals of `rms_averaged_over_s`, N.
    pub rms_n: f64,
    /// Half width of its 95 % interval, N.
    pub rms_half_width_95_n: Option<f64>,
    /// That root over the first and over the last half of the batches, N.
    #[serde(default)]
    pub rms_of_halves_n: [f64; 2],
    /// Length of those intervals, s.
    pub rms_averaged_over_s: f64,
    /// The largest mean of the |normal force|, at flats of all of them together, over any stretch
    /// of such a length; `None` where nothing pushed.
    #[serde(default)]
    pub largest: Option<LargestForce>,
}

/// A wall of a support.
#[derive(Debug, Clone)]
enum Source {
    /// A flat one: its index, the outward unit normal times the sign of the wall's force along it,
    /// and the tangent.
    Flat(usize, [f64; 2], [f64; 2]),
    /// A round one: its index.
    Round(usize),
}

/// The forces of one support, by batches.
#[derive(Debug, Clone)]
pub(super) struct SupportTally {
    sources: Vec<Source>,
    /// Σ of the vector impulse, N s, and of its square over an interval's length, N² s.
    vector: [BatchSums; 2],
    square: BatchSums,
    /// The vector impulse in the current interval of a round hole, or of the friction at flats, N
    /// s.
    stretch: [f64; 2],
}

impl SupportTally {
    /// One per support of `scene`, in its order.
    pub fn all(scene: &Scene) -> Vec<Self> {
        // A wall's impulse is signed along its row, which points along the normal of an upper wall
        // and against that of a lower one.
        let source = |(index, wall): (usize, &Wall)| match wall.face {
            Face::Flat { side, direction, .. } => {
                let [y, z] = heading(direction?);
                Some(Source::Flat(index, [y, z].map(|x| -side.sign() * x), [-z, y]))
            }
            Face::Round { .. } => Some(Source::Round(index)),
        };
        let tally = |support: &Support| Self {
            sources: support.members(&scene.walls).filter_map(source).collect(),
            vector: [NO_SUMS; 2],
            square: NO_SUMS,
            stretch: [0.0; 2],
        };
        scene.supports.iter().map(tally).collect()
    }

    /// Indices of its walls.
    pub fn walls(&self) -> impl Iterator<Item = usize> {
        self.sources.iter().map(|source| match source {
            Source::Flat(wall, ..) | Source::Round(wall) => *wall,
        })
    }

    /// Adds what a round wall and friction did in `step` between two times in it, s: the force of
    /// exact motion over it, or that share of the step's impulses. The normal impulses of flats are
    /// those of walls.
    pub fn add(&mut self, step: &Step<'_>, [from, to]: [f64; 2]) {
        let share = (to - from) / (step.end - step.start);
        for source in &self.sources {
            let (Source::Flat(wall, ..) | Source::Round(wall)) = source;
            // A wall with an impulse at the end of a part of a step has its friction there.
            let at_end = matches!(step.path, Path::Part { .. }) && step.jump.get(*wall).is_some_and(|p| *p != 0.0);
            let push = match (source, step.path) {
                _ if at_end => continue,
                (Source::Flat(wall, _, tangent), _) => {
                    let friction = step.friction.get(*wall).copied().unwrap_or(0.0);
                    tangent.map(|t| share * (t * friction))
                }
                (Source::Round(wall), Path::Series(series)) => series.hole_impulse(*wall, from, to),
                (Source::Round(wall), _) => step.hole_push(*wall).map(|p| share * p),
            };
            self.stretch.iter_mut().zip(push).for_each(|(sum, p)| *sum += p);
        }
    }

    /// Adds what round walls and friction gave at the instant of the end of a step of exact motion,
    /// or of a part of a step.
    pub fn jump(&mut self, step: &Step<'_>) {
        for source in &self.sources {
            let (Source::Flat(wall, ..) | Source::Round(wall)) = source;
            let Some(jump) = step.jump.get(*wall).copied().filter(|p| *p != 0.0) else { continue };
            let friction = step.friction.get(*wall).copied().unwrap_or(0.0);
            let push = match source {
                Source::Flat(_, _, tangent) => tangent.map(|t| t * friction),
                Source::Round(_) => {
                    let [y, z] = step.normal.get(*wall).copied().unwrap_or_default();
                    [-jump * y - friction * z, -jump * z + friction * y]
                }
            };
            self.stretch.iter_mut().zip(push).for_each(|(sum, p)| *sum += p);
        }
    }

    /// Ends an interval of length `bin` (s) in `batch`, in which wall w gave the impulse
    /// `impulse(w)`.
    pub fn close(&mut self, batch: usize, bin: f64, impulse: impl Fn(usize) -> f64) {
        let mut vector = std::mem::take(&mut self.stretch);
        for source in &self.sources {
            if let Source::Flat(wall, normal, _) = source {
                let p = impulse(*wall);
                vector.iter_mut().zip(normal).for_each(|(sum, n)| *sum += p * n);
            }
        }
        self.vector.iter_mut().zip(vector).for_each(|(sums, p)| sums[batch] += p);
        self.square[batch] += vector.iter().map(|p| p * p).sum::<f64>() / bin;
    }

    /// Its statistics over `window` with intervals of length `bin` (s), where wall w pushed
    /// `pushed(w)` (Σ|p| of each batch, N s) and `contacts` began in the window.
    pub fn statistics(
        &self,
        (window, bin): (&Window, f64),
        contacts: usize,
        pushed: impl Fn(usize) -> BatchSums,
        largest: Option<LargestForce>,
    ) -> SupportForce {
        let mut all = NO_SUMS;
        for wall in self.walls() {
            all.iter_mut().zip(pushed(wall)).for_each(|(sum, p)| *sum += p);
        }
        let interval = window.has_interval(&all, contacts);
        let half = |sums: &BatchSums| window.half_width(sums).filter(|_| interval);
        let (rms, rms_half) = window.root_mean(&self.square, interval);
        SupportForce {
            mean_n: window.mean(&all),
            mean_half_width_95_n: half(&all),
            mean_of_halves_n: window.means_of_halves(&all),
            mean_vector_n: self.vector.map(|sums| window.mean(&sums)),
            mean_vector_half_width_95_n: half(&self.vector[0]).zip(half(&self.vector[1])).map(|(y, z)| [y, z]),
            rms_n: rms,
            rms_half_width_95_n: rms_half,
            rms_of_halves_n: window.means_of_halves(&self.square).map(f64::sqrt),
            rms_averaged_over_s: bin,
            largest,
        }
    }
}

/// The statistics of the supports of `scene`, from the contacts `by_wall` in `window`; without the
/// force over time.
pub(super) fn of_supports(scene: &Scene, by_wall: &[Vec<&Contact>], window: &Window) -> Vec<SupportStatistics> {
    let from = window.from;
    let support = |support: &Support| {
        let all = by_wall.get(support.walls.clone()).unwrap_or_default().iter().flatten();
        let is_elastic = support.members(&scene.walls).all(|(_, wall)| !wall.law.is_rigid());
        let reaching = all.clone().filter(|c| c.end.is_none_or(|end| end >= from));
        SupportStatistics {
            support: support.name.clone(),
            force_largest: LargestForce::of_contacts(reaching.clone().copied(), [from, from + window.length])
                .filter(|_| is_elastic),
            contacts: all.filter(|c| c.start >= from).count(),
            episode_peak_force_n: match reaching.map(|c| c.peak_force).collect::<Option<Vec<f64>>>() {
                Some(peaks) => Summary::of(peaks.into_iter()),
                None => Summary::default(),
            },
            force: None,
        }
    };
    scene.supports.iter().map(support).collect()
}
