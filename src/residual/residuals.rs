//! The residuals of a run.

use super::largest_residual::over;
use super::{Energy, Judge};
use crate::scene::Scene;
#[cfg(doc)]
use crate::step::Promise;
use serde::{Deserialize, Serialize};

/// Residuals of a run against the contract of its scheme, over all steps, however few rows were
/// recorded.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[non_exhaustive]
pub struct Residuals {
    /// Largest |min(γ/γ₀, |r|/r₀)| over steps and rigid walls, and of | |r| − law |/r₀ over elastic
    /// ones; dimensionless. γ and r are taken where the scheme promises them ([`Promise`]). The law
    /// of a damped wall jumps at its face, from 0 to c_a ṡ: where the body is there to within
    /// rounding, any pressure between the two is accepted. Round holes and friction are measured
    /// alike: the largest part of a hole's force that is not along its normal over r₀, and the
    /// largest min(|ẇ_t|/v₀, |μp − friction|/r₀) of sliding and missing friction.
    pub complementarity: f64,
    /// Deepest position behind each wall, then behind each round hole, at the end of a step, m, ≥
    /// 0, in the scene's order; of exact motion behind elastic walls also within a step.
    pub depth_m: Vec<f64>,
    /// Deepest position behind a rigid wall or hole, m. In a run by `penalty` behind those that the
    /// scene calls rigid, whose springs give way.
    pub penetration_m: f64,
    /// Largest force with which a wall pulled, N, ≥ 0.
    pub tension_n: f64,
    /// Largest residual of the momentum balance of a step, or of a part of one, divided by h, N (N
    /// m in the balance of a rotation, N/√kg in that of a mode of unit mass).
    pub force_balance_n: f64,
    /// The larger of two: that residual over the largest force in the balance; and the difference
    /// of q⁺ − q from what the velocities give, over the gap scale or the largest |q|, whichever is
    /// larger. Balances of several degrees of freedom, whose units may differ, are compared in the
    /// metric of the mass: forces over √Mᵢᵢ, displacements times it.
    pub force_balance: f64,
    /// The energy ledger.
    pub energy: Energy,
    /// γ₀: the scale of gaps, m. For a promise about velocities it is a speed, m/s: the run's
    /// largest speed at a rigid wall (Σ|gᵢvᵢ|, the size of the terms of that speed), or the gap
    /// scale over the run's duration if that is larger (the speed of a body held fast is rounding).
    /// A promise about both measures gaps by the first and speeds by the second; the first is
    /// given.
    pub gap_scale: f64,
    /// r₀: the largest contact force of the run, N (impulse/h for a scheme on a grid). Contact
    /// forces below 1e-6 of the largest force in the momentum balance may be rounding, and are
    /// measured by that share of it. Where no wall ever pushed, the error of an elastic wall is
    /// measured by the force of the stiffest one over the gap scale.
    pub force_scale_n: f64,
}

/// Deepest position behind a wall that `scene` calls rigid, m, by the depths behind all walls.
pub(crate) fn penetration(scene: &Scene, depths: &[f64]) -> f64 {
    let rigid = scene.walls.iter().zip(depths).filter(|(wall, _)| wall.law.is_rigid());
    rigid.fold(0.0, |most, (_, depth)| most.max(*depth))
}

impl Judge {
    /// The residuals of the steps so far.
    #[must_use]
    pub fn residuals(&self) -> Residuals {
        let speed_scale = self.rebound_scale();
        let force_scale = self.contact_scale();
        let rigid = self.contract.promise.rigid;
        let speeds_only = rigid.displacement.is_none() && rigid.velocity.is_some();
        let gap_scale = if speeds_only { speed_scale } else { self.energy.gap_scale };
        // Where no wall ever pushed, the force error of an elastic wall is measured by its force
        // over the gap scale.
        let law = over(self.walls.law.value, if force_scale > 0.0 { force_scale } else { self.scales.wall });
        let gaps = self.walls.gaps.worst(self.energy.gap_scale, force_scale);
        let rebounds = self.walls.rebounds.worst(speed_scale, force_scale);
        let balance = over(self.balance.force.value, self.balance_scale());
        let path = over(self.balance.path.value, self.path_scale());
        let supports = self.supports.as_ref().map_or(0.0, |supports| {
            let laws = over(supports.askew.value, force_scale).max(over(supports.struck.value, speed_scale));
            supports.rubs.worst(speed_scale, force_scale).max(laws)
        });
        Residuals {
            complementarity: gaps.max(rebounds).max(law).max(supports),
            depth_m: self.walls.depth.clone(),
            penetration_m: penetration(&self.scene, &self.walls.depth),
            tension_n: self.walls.tension,
            force_balance_n: self.balance.largest,
            force_balance: balance.max(path),
            energy: self.energy.report(),
            gap_scale,
            force_scale_n: self.walls.force_scale,
        }
    }
}
