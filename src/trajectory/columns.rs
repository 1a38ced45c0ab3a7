//! The columns of a recorded motion.

use super::output::OutputStates;
use super::worn::EpisodeWear;
use crate::scene::Scene;
use crate::step::Contact;
use serde::{Deserialize, Serialize};

/// What a [`Trajectory`](super::Trajectory) holds, by the names under which it is written down; as
/// read it may come from another program.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub(super) struct Columns {
    pub walls: Vec<String>,
    pub probes: Vec<String>,
    pub time: Vec<f64>,
    pub displacement: Vec<Vec<f64>>,
    pub velocity: Vec<Vec<f64>>,
    pub force: Vec<Vec<f64>>,
    pub impulse: Vec<Vec<f64>>,
    #[serde(default)]
    pub holes: Vec<String>,
    #[serde(default)]
    pub hole_force: Vec<[Vec<f64>; 2]>,
    #[serde(default)]
    pub hole_impulse: Vec<[Vec<f64>; 2]>,
    #[serde(default)]
    pub friction: Vec<Vec<f64>>,
    #[serde(default)]
    pub supports: Vec<String>,
    #[serde(default)]
    pub wear_work: Vec<Vec<f64>>,
    pub contacts: Vec<Contact>,
    #[serde(default)]
    pub contact_wear: Vec<Option<EpisodeWear>>,
    #[serde(default)]
    pub output: OutputStates,
}

impl Columns {
    /// The columns of `scene` without rows, with room for `rows` intervals.
    pub fn new(scene: &Scene, rows: u64) -> Self {
        let capacity = usize::try_from(rows).unwrap_or(0).saturating_add(1).min(1 << 24);
        let column = || Vec::with_capacity(capacity);
        let columns = |count: usize| (0..count).map(|_| column()).collect::<Vec<_>>();
        let holes: Vec<String> = scene.holes().map(|hole| hole.name.to_owned()).collect();
        let walls = scene.walls.len();
        Self {
            walls: scene.walls.iter().map(|w| w.name.clone()).collect(),
            probes: scene.probes.iter().map(|p| p.name.clone()).collect(),
            time: column(),
            displacement: columns(scene.probes.len()),
            velocity: columns(scene.probes.len()),
            force: Vec::new(),
            impulse: columns(walls),
            hole_force: Vec::new(),
            hole_impulse: holes.iter().map(|_| [column(), column()]).collect(),
            friction: columns(if scene.turns_or_rubs() { walls } else { 0 }),
            holes,
            supports: scene.supports.iter().map(|support| support.name.clone()).collect(),
            wear_work: columns(scene.supports.len()),
            contacts: Vec::new(),
            contact_wear: Vec::new(),
            output: OutputStates::default(),
        }
    }

    /// Writes the zeros that the columns of the walls lack up to the last row, and the forces: the
    /// impulse of each row times `rate`, the number of rows a second.
    pub fn fill(&mut self, rate: f64) {
        let rows = self.time.len();
        self.impulse.iter_mut().chain(&mut self.friction).for_each(|column| column.resize(rows, 0.0));
        let mean = |impulses: &Vec<f64>| impulses.iter().map(|p| p * rate).collect::<Vec<f64>>();
        self.force = self.impulse.iter().map(mean).collect();
        self.hole_force = self.hole_impulse.iter().map(|columns| columns.each_ref().map(mean)).collect();
    }

    /// True if there is a column for each wall, hole, support and probe, all of one length, and the
    /// contacts are at walls and holes there are.
    pub fn fit(&self) -> bool {
        let rows = self.time.len();
        let of = |names: &[String], columns: &[Vec<f64>]| {
            columns.len() == names.len() && columns.iter().all(|column| column.len() == rows)
        };
        let pairs = |names: &[String], columns: &[[Vec<f64>; 2]]| {
            columns.len() == names.len() && columns.iter().flatten().all(|column| column.len() == rows)
        };
        of(&self.probes, &self.displacement)
            && of(&self.probes, &self.velocity)
            && of(&self.walls, &self.force)
            && of(&self.walls, &self.impulse)
            && (self.friction.is_empty() || of(&self.walls, &self.friction))
            && of(&self.supports, &self.wear_work)
            && pairs(&self.holes, &self.hole_force)
            && pairs(&self.holes, &self.hole_impulse)
            && (self.contact_wear.is_empty() || self.contact_wear.len() == self.contacts.len())
            && self.output.fit(self.probes.len())
            && self.contacts.iter().all(|contact| contact.wall < self.walls.len())
    }
}
