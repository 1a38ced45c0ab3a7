//! Work space of the judge for many steps of one degree of freedom.

use super::scratch::Scratch;
use super::weights::Weights;
use crate::scene::Scene;
use crate::step::{Balance, Contract, QuietSteps};

/// Work space for as many steps as a [`QuietSteps`] holds.
#[derive(Debug)]
pub(super) struct QuietScratch {
    pub weights: Weights,
    pub scratch: Scratch,
    /// Displacements (m) and loads (N) at the start of the first step and at the end of each.
    pub q: Vec<f64>,
    pub load: Vec<f64>,
    pub zeros: Vec<f64>,
}

impl QuietScratch {
    /// `None` where each step is to be seen by itself, as in a scene with `blows`.
    pub fn new(scene: &Scene, contract: Contract, weights: &Weights, blows: bool) -> Option<Box<Self>> {
        let free = scene.is_line() && scene.supports.is_empty() && !blows;
        let one_step = matches!(contract.balance, Balance::Theta(_) | Balance::Staggered(_));
        if !free || !one_step {
            return None;
        }
        let most = QuietSteps::capacity();
        Some(Box::new(Self {
            weights: weights.repeated(most),
            scratch: Scratch::new(most),
            q: vec![0.0; most + 1],
            load: vec![0.0; most + 1],
            zeros: vec![0.0; most],
        }))
    }
}
