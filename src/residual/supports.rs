//! What the judge keeps of round holes and friction over a run.

use super::front::ComplementarityFront;
use super::worst::Residual;
use crate::scene::Scene;

/// Round supports and friction of a run.
#[derive(Debug)]
pub(super) struct Supports {
    /// Parts of forces that are not along the hole's normal, N.
    pub askew: Residual,
    /// Speeds by which impacts on holes in exact motion miss their law, m/s.
    pub struck: Residual,
    /// Pairs of sliding speed (m/s) and missing friction (N).
    pub rubs: ComplementarityFront,
    /// The mass that each wall feels, kg, and its impulse in the step before, N s.
    pub mass: Vec<f64>,
    pub pushed: Vec<f64>,
    /// Impulse of each wall along y and z, without the normal ones of flats, N s; and the sum of
    /// the magnitudes.
    pub impulse: Vec<[f64; 2]>,
    pub size: Vec<f64>,
    /// The sums of the round walls as the recorder has them, in their order, if told.
    pub recorded: Option<Vec<[f64; 2]>>,
}

impl Supports {
    /// `None` for a scene without round holes and friction.
    /// Walls feel these masses.
    pub fn new(scene: &Scene, masses: &[f64]) -> Option<Box<Self>> {
        if !scene.turns_or_rubs() {
            return None;
        }
        Some(Box::new(Self {
            askew: Residual::default(),
            struck: Residual::default(),
            rubs: ComplementarityFront::default(),
            mass: masses.iter().copied().take(scene.walls.len()).collect(),
            pushed: vec![0.0; scene.walls.len()],
            impulse: vec![[0.0; 2]; scene.walls.len()],
            size: vec![0.0; scene.walls.len()],
            recorded: None,
        }))
    }
}
