//! The force of a support over time: that of all its flats together.

use super::batch::{BATCHES, Sums, batch_of, half_width};
use crate::scene::{FlatWall, Scene, Shape, heading};
use crate::step::Contact;
use serde::{Deserialize, Serialize};

/// Statistics of one support of flats within the window.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[non_exhaustive]
pub struct SupportStatistics {
    /// The support's name.
    pub support: String,
    /// The force over time of its flats together; `None` where only the contacts are known.
    pub force: Option<SupportForce>,
    /// Kinetic energy that arrived at its flats per unit time, W: the sum of
    /// [`WallStatistics::impact_power_w`](super::WallStatistics::impact_power_w).
    pub impact_power_w: f64,
    /// Half width of its 95 % interval by batch means, W; `None` where fewer than ten contacts began
    /// in the window.
    pub impact_power_half_width_95_w: Option<f64>,
}

/// The force of one support over the window.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
#[non_exhaustive]
pub struct SupportForce {
    /// Mean over time of the sum of its flats' |force|, Σ|p|/T, N.
    pub mean_n: f64,
    /// Half width of its 95 % interval by batch means, N. This and those below are `None` unless
    /// ten contacts began in the window, or the support pushed in each of its ten batches.
    pub mean_half_width_95_n: Option<f64>,
    /// Mean of the force vector on the structure, along y and z, N: what the support carries.
    pub mean_vector_n: [f64; 2],
    /// Half widths of their 95 % intervals, N.
    pub mean_vector_half_width_95_n: Option<[f64; 2]>,
    /// Root mean square of the force vector averaged over intervals of `rms_averaged_over_s`, N.
    pub rms_n: f64,
    /// Half width of its 95 % interval, N.
    pub rms_half_width_95_n: Option<f64>,
    /// Length of those intervals, s.
    pub rms_averaged_over_s: f64,
}

/// The forces of one support, by batches.
#[derive(Debug, Clone)]
pub(super) struct SupportTally {
    /// Its flats: the wall, and the outward unit normal times the sign of the wall's force along it.
    flats: Vec<(usize, [f64; 2])>,
    /// Σ of the vector impulse, N s, and of its square over an interval's length, N² s.
    vector: [[f64; BATCHES]; 2],
    square: [f64; BATCHES],
}

impl SupportTally {
    /// One per support of flats of `scene`, in its order.
    pub fn all(scene: &Scene) -> Vec<Self> {
        // A wall's impulse is signed along its row, which points along the normal of an upper wall
        // and against that of a lower one.
        let along = |flat: &FlatWall| {
            let wall = scene.walls.get(flat.wall)?;
            Some((flat.wall, heading(flat.direction).map(|x| -wall.side.sign() * x)))
        };
        let tally = |flats: &[FlatWall]| Self {
            flats: flats.iter().filter_map(along).collect(),
            vector: [[0.0; BATCHES]; 2],
            square: [0.0; BATCHES],
        };
        flats(scene).map(|(_, flats)| tally(flats)).collect()
    }

    /// Adds an interval of length `bin` (s) in `batch`, in which wall w gave the impulse `impulse(w)`.
    pub fn close(&mut self, batch: usize, bin: f64, impulse: impl Fn(usize) -> f64) {
        let mut vector = [0.0; 2];
        for (wall, normal) in &self.flats {
            let p = impulse(*wall);
            vector.iter_mut().zip(normal).for_each(|(sum, n)| *sum += p * n);
        }
        self.vector.iter_mut().zip(vector).for_each(|(sums, p)| sums[batch] += p);
        self.square[batch] += vector.iter().map(|p| p * p).sum::<f64>() / bin;
    }

    /// Its statistics, where wall w pushed `pushed(w)` (Σ|p| of each batch, N s) and `contacts` of
    /// its flats began in the window.
    pub fn statistics(
        &self,
        sums: Sums,
        contacts: impl Fn(usize) -> usize,
        pushed: impl Fn(usize) -> [f64; BATCHES],
    ) -> SupportForce {
        let mut all = [0.0; BATCHES];
        for (wall, _) in &self.flats {
            all.iter_mut().zip(pushed(*wall)).for_each(|(sum, p)| *sum += p);
        }
        let contacts = self.flats.iter().map(|(wall, _)| contacts(*wall)).sum();
        let (mean, mean_half) = sums.mean(&all, &all, contacts);
        let [y, z] = [0, 1].map(|axis| sums.mean(&self.vector[axis], &all, contacts));
        let (rms, rms_half) = sums.root_mean(&self.square, &all, contacts);
        SupportForce {
            mean_n: mean,
            mean_half_width_95_n: mean_half,
            mean_vector_n: [y.0, z.0],
            mean_vector_half_width_95_n: y.1.zip(z.1).map(|(y, z)| [y, z]),
            rms_n: rms,
            rms_half_width_95_n: rms_half,
            rms_averaged_over_s: sums.bin,
        }
    }
}

/// The statistics of the supports of flats of `scene`, whose walls feel `masses` (kg), from their
/// contacts `by_wall` that begin in the window `[from, to]` (s); without the force over time.
pub(super) fn of_supports(
    scene: &Scene,
    masses: &[f64],
    by_wall: &[Vec<&Contact>],
    [from, to]: [f64; 2],
) -> Vec<SupportStatistics> {
    let length = to - from;
    let batch = length / BATCHES as f64;
    let support = |(name, flats): (&str, &[FlatWall])| {
        let (mut powers, mut count) = ([0.0; BATCHES], 0);
        for flat in flats {
            let mass = masses.get(flat.wall).copied().unwrap_or(0.0);
            for contact in by_wall.get(flat.wall).into_iter().flatten().filter(|c| c.start >= from && length > 0.0) {
                let energy = 0.5 * mass * contact.approach_speed * contact.approach_speed;
                powers[batch_of(contact.start - from, length)] += energy / batch;
                count += 1;
            }
        }
        SupportStatistics {
            support: name.to_owned(),
            force: None,
            impact_power_w: powers.iter().sum::<f64>() / BATCHES as f64,
            impact_power_half_width_95_w: (count >= BATCHES).then(|| half_width(&powers)),
        }
    };
    flats(scene).map(support).collect()
}

/// The supports of flats of `scene`: name and flats.
pub(super) fn flats(scene: &Scene) -> impl Iterator<Item = (&str, &[FlatWall])> {
    scene.supports.iter().filter_map(|support| match &support.shape {
        Shape::Flats(flats) => Some((support.name.as_str(), flats.as_slice())),
        Shape::Round { .. } => None,
    })
}
