//! What a run has shown of the momentum balance of its steps.

use super::largest_residual::Residual;
use super::noise::NoiseModel;

/// Residuals of the momentum balance and of the kinematics, in the metric of the mass.
#[derive(Debug, Default)]
pub(super) struct BalanceCheck {
    /// Largest residual of a degree of freedom, N.
    pub largest: f64,
    /// Residuals, N/√kg, and the largest force in a balance.
    pub force: Residual,
    pub scale: f64,
    /// Differences of q⁺ − q from what the velocities give, m√kg.
    pub path: Residual,
}

impl BalanceCheck {
    /// Notes the residuals of a step: of its momentum balance, N/√kg, and of its path, m√kg.
    #[inline(always)]
    pub fn observe(&mut self, noise: &NoiseModel, force: f64, path: f64) {
        self.force.observe(force, noise.force(), noise.end, None);
        self.path.observe(path, noise.path(), noise.end, None);
    }

    /// Notes the largest residual of a degree of freedom, N.
    #[inline(always)]
    pub fn raise_largest(&mut self, force: f64) {
        self.largest = self.largest.max(force);
    }

    /// Notes the size of a force in the balance, N/√kg.
    #[inline(always)]
    pub fn raise_scale(&mut self, force: f64) {
        self.scale = self.scale.max(force);
    }
}
