//! What the judge keeps of round holes and friction over a run.

use super::beyond::{Doubts, Worst};
use super::complementarity::Pairs;
use crate::scene::{Scene, Support};

/// Round supports and friction of a run.
#[derive(Debug)]
pub(super) struct Supports {
    /// Index of each hole's support in the scene, its gap and its restitution.
    pub holes: Vec<(usize, f64, f64)>,
    /// Deepest position behind each hole, m.
    pub depth: Vec<f64>,
    /// Largest part of a force that is not along the hole's normal, N, and what exceeds rounding.
    pub askew: f64,
    pub doubt: Worst,
    /// Largest speed by which an impact on a hole in exact motion misses its law, m/s, and what
    /// exceeds rounding.
    pub struck: f64,
    pub struck_doubt: Worst,
    pub rubs: Rubs,
    /// The mass that each wall feels, kg, and its impulse in the step before, N s.
    pub mass: Vec<f64>,
    pub pushed: Vec<f64>,
    /// Impulse of each support along y and z, without the normal ones of flats, N s; and the sum of
    /// the magnitudes.
    pub impulse: Vec<[f64; 2]>,
    pub size: Vec<f64>,
    /// The sums of the holes as the recorder has them, if told.
    pub recorded: Option<Vec<[f64; 2]>>,
}

impl Supports {
    /// `None` for a scene without round holes and friction.
    /// Walls feel these masses.
    pub fn new(scene: &Scene, masses: &[f64]) -> Option<Box<Self>> {
        if !scene.turns_or_rubs() {
            return None;
        }
        let hole = |(index, support): (usize, &Support)| support.hole().map(|hole| (index, hole.gap, hole.restitution));
        let holes: Vec<_> = scene.supports.iter().enumerate().filter_map(hole).collect();
        Some(Box::new(Self {
            depth: vec![0.0; holes.len()],
            holes,
            askew: 0.0,
            doubt: Worst::default(),
            struck: 0.0,
            struck_doubt: Worst::default(),
            rubs: Rubs { pairs: Pairs::default(), doubts: Doubts::default() },
            mass: masses.iter().copied().take(scene.walls.len()).collect(),
            pushed: vec![0.0; scene.walls.len()],
            impulse: vec![[0.0; 2]; scene.supports.len()],
            size: vec![0.0; scene.supports.len()],
            recorded: None,
        }))
    }
}

/// Pairs of sliding speed (m/s) and missing friction (N), and the same minus rounding.
#[derive(Debug)]
pub(super) struct Rubs {
    pub pairs: Pairs,
    pub doubts: Doubts,
}
