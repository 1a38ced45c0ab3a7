//! Contact statistics: what wear models ask of a run.

use crate::scene::{Scene, Wall};
use crate::step::Contact;
use serde::Serialize;

/// Mean, largest and root-mean-square of a set of magnitudes; all `None` if the set is empty.
#[derive(Debug, Clone, Copy, Default, PartialEq, Serialize)]
pub struct Summary {
    /// Arithmetic mean.
    pub mean: Option<f64>,
    /// Largest.
    pub max: Option<f64>,
    /// Root mean square.
    pub rms: Option<f64>,
}

impl Summary {
    fn of(values: impl Iterator<Item = f64> + Clone) -> Self {
        let count = values.clone().count();
        if count == 0 {
            return Self::default();
        }
        let n = count as f64;
        let max = values.clone().fold(0.0, f64::max);
        let mean = values.clone().sum::<f64>() / n;
        let rms = (values.map(|x| x * x).sum::<f64>() / n).sqrt();
        Self { mean: Some(mean), max: Some(max), rms: Some(rms) }
    }
}

/// Contacts at one wall within the window: the episodes that began in it.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct WallStatistics {
    /// The wall's name.
    pub wall: String,
    /// Number of contact episodes.
    pub contacts: usize,
    /// Largest |force| of each episode whose force is finite, N.
    pub peak_force_n: Summary,
    /// |impulse| of each episode, N s.
    pub impulse_n_s: Summary,
    /// Time in contact over the window's length.
    pub contact_time_ratio: f64,
    /// Kinetic energy that arrived at the wall per time, Σ ½m·approach²/T, W, with m the mass that the wall feels ([`Scene::wall_masses`]).
    /// The motion is normal to the wall and frictionless: this is impact power, there is no sliding wear in it.
    pub impact_power_w: f64,
    /// The part of it that had not returned to the body when it left, Σ ½m(approach² − departure²)/T, W; of closed episodes. At impacts
    /// this is what restitution takes. Where a contact lasts (elastic walls, penalties, rest), the loads and the structure work on the body
    /// meanwhile, and that work is in it: negative where they give more than the wall takes. What dashpots of walls dissipate is
    /// [`Energy::wall_damping_j`](crate::residual::Energy::wall_damping_j).
    pub unreturned_power_w: f64,
}

/// Contact statistics of a run.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Statistics {
    /// Start of the window, s.
    pub from_s: f64,
    /// End of the window, s.
    pub to_s: f64,
    /// One entry a wall, in the scene's order.
    pub walls: Vec<WallStatistics>,
}

impl Statistics {
    /// Statistics of `contacts` from the time `from` (s) to the scene's end. A window of no length, if `from` is the end or later (or no
    /// number), has times and powers of 0.
    #[must_use]
    pub fn new(scene: &Scene, contacts: &[Contact], from: f64) -> Self {
        let to = scene.duration;
        let from = from.min(to);
        let masses = scene.wall_masses();
        let per_time = |x: f64| if to > from { x / (to - from) } else { 0.0 };
        let mut by_wall = vec![Vec::new(); scene.walls.len()];
        for contact in contacts {
            if let Some(list) = by_wall.get_mut(contact.wall) {
                list.push(contact);
            }
        }
        let wall = |(index, (wall, all)): (usize, (&Wall, &Vec<&Contact>))| {
            let here = all.iter().copied().filter(|c| c.start >= from);
            let mass = masses.get(index).copied().unwrap_or(0.0);
            let energy = |speed: f64| 0.5 * mass * speed * speed;
            // An empty sum of floats is −0, which nobody wants to read.
            let total = |values: &mut dyn Iterator<Item = f64>| values.fold(0.0, |sum, x| sum + x);
            let time = total(&mut all.iter().map(|c| (c.end.unwrap_or(to).min(to) - c.start.max(from)).max(0.0)));
            let arrived = total(&mut here.clone().map(|c| energy(c.approach_speed)));
            let lost = |c: &Contact| c.departure_speed.map_or(0.0, |d| energy(c.approach_speed) - energy(d));
            WallStatistics {
                wall: wall.name.clone(),
                contacts: here.clone().count(),
                peak_force_n: Summary::of(here.clone().filter_map(|c| c.peak_force)),
                impulse_n_s: Summary::of(here.clone().map(|c| c.impulse.abs())),
                contact_time_ratio: per_time(time),
                impact_power_w: per_time(arrived),
                unreturned_power_w: per_time(total(&mut here.map(lost))),
            }
        };
        Self { from_s: from, to_s: to, walls: scene.walls.iter().zip(&by_wall).enumerate().map(wall).collect() }
    }
}
