//! Quantities of the generalized-α rule that carry over from step to step.

use crate::scene::Scene;
use crate::step::{Balance, Contract};

/// Quantities that carry over from step to step: M a and F at the step's start, N, n entries each.
#[derive(Debug)]
pub(super) struct PreviousStep {
    pub s: Vec<f64>,
    pub force: Vec<f64>,
    /// s⁺ and F⁺ of the current step.
    pub s_end: Vec<f64>,
    pub force_end: Vec<f64>,
    /// Work space: the displacement of the current step beyond that at its first velocity, m, and
    /// what is open of the balance of displacements, N s.
    pub beyond: Vec<f64>,
    pub open: Vec<f64>,
}

impl PreviousStep {
    /// Values at the start of a run, where M a = F with the forces of `load` (N) and of the walls
    /// that are springs, `walls` (N). `None` under the contract of another rule.
    pub fn new(
        scene: &Scene,
        contract: Contract,
        (q, v): (&[f64], &[f64]),
        load: &[f64],
        walls: &[f64],
    ) -> Option<Box<Self>> {
        let Balance::GeneralizedAlpha { .. } = contract.balance else { return None };
        let mut force = load.to_vec();
        smooth(scene, q, v, walls, &mut force);
        let [s, s_end, force_end, beyond, open] = std::array::from_fn(|_| force.clone());
        Some(Box::new(Self { s, force, s_end, force_end, beyond, open }))
    }
}

/// Adds −C v − K q and the forces of the walls to `out`.
pub(super) fn smooth(scene: &Scene, q: &[f64], v: &[f64], walls: &[f64], out: &mut [f64]) {
    scene.system.add_damping(-1.0, v, out);
    scene.system.add_stiffness(-1.0, q, out);
    for (wall, &r) in scene.walls.iter().zip(walls).filter(|(wall, _)| !wall.law.is_rigid()) {
        wall.row().add_transposed(r, out);
    }
}
