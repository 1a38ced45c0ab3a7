//! Walls and round supports, and the results of a run there.

use crate::case::Case;
use crate::run::Run;
use crate::step::Contact;

/// A place of contact of a scene: a wall or a round support.
#[derive(Clone, Copy)]
pub(super) enum Site<'a> {
    /// With its index.
    Wall(usize, &'a str),
    /// With the index among all supports.
    Round(usize, &'a str),
}

impl<'a> Site<'a> {
    /// All of a case.
    pub fn all(case: &'a Case) -> impl Iterator<Item = Self> {
        let scene = &case.scene;
        let flats = scene.walls.iter().enumerate().filter(|(_, wall)| !wall.is_round());
        let walls = flats.map(|(index, wall)| Self::Wall(index, &wall.name));
        let supports = scene.supports.iter().enumerate().filter(|(_, support)| support.hole(&scene.walls).is_some());
        walls.chain(supports.map(|(index, support)| Self::Round(index, &support.name)))
    }

    pub fn name(self) -> &'a str {
        match self {
            Self::Wall(_, name) | Self::Round(_, name) => name,
        }
    }

    /// Contacts that began in the window of the statistics.
    pub fn contacts(self, run: &Run) -> Option<usize> {
        match self {
            Self::Wall(index, _) => run.statistics.walls.get(index).map(|wall| wall.contacts),
            Self::Round(index, _) => run.statistics.supports.get(index).map(|support| support.contacts),
        }
    }

    /// Impulse of a wall over the window, signed as the force, or Σ|p| of a round support, N s.
    pub fn impulse(self, run: &Run) -> Option<f64> {
        let statistics = &run.statistics;
        match self {
            Self::Wall(index, _) => statistics.walls.get(index)?.force.map(|force| force.impulse_n_s),
            Self::Round(index, _) => {
                let force = statistics.supports.get(index)?.force;
                force.map(|force| force.mean_n * (statistics.to_s - statistics.from_s))
            }
        }
    }

    /// Largest force of the contacts in the window, N; `None` where an impact is among them, whose
    /// force is not finite.
    pub fn peak(self, run: &Run) -> Option<f64> {
        match self {
            Self::Wall(index, _) => {
                let reaches = |c: &&Contact| c.wall == index && c.end.is_none_or(|end| end >= run.statistics.from_s);
                let struck = run.trajectory.contacts().iter().filter(reaches).any(|c| c.peak_force.is_none());
                let peak = run.statistics.walls.get(index)?.episode_peak_force_n.max;
                peak.filter(|_| !struck)
            }
            Self::Round(index, _) => run.statistics.supports.get(index)?.episode_peak_force_n.max,
        }
    }
}
