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

    /// The largest residuals so far: of a degree of freedom, N, and in the metric of the mass,
    /// N/√kg.
    pub fn largest_so_far(&self) -> [f64; 2] {
        [self.largest, self.force.value]
    }

    /// Counts the residuals of a part that exceed those `before` it as impulses over the whole
    /// step, of which the part is this `share`: over a part of nearly no length rounding would be a
    /// force.
    pub fn spread_over_step(&mut self, [largest, force]: [f64; 2], share: f64) {
        if self.largest > largest {
            self.largest = largest.max(share * self.largest);
        }
        if self.force.value > force {
            self.force.value = force.max(share * self.force.value);
        }
    }

    /// Notes the size of a force in the balance, N/√kg.
    #[inline(always)]
    pub fn raise_scale(&mut self, force: f64) {
        self.scale = self.scale.max(force);
    }
}
