//! Turns residuals, minus their rounding errors, into findings.

use super::largest_residual::LargestResidual;
use super::{Finding, Judge, Refuted};
use crate::finite::first_not_finite;
use crate::order::sort_by_number;
use crate::step::{Bound, Conserves, Path, Step, Tolerance};

/// Contact forces below this share of the largest force in the balance are measured by that share
/// of it: where forces cancel, the remainder is rounding, and a residual relative to rounding means
/// nothing.
const LEAST_FORCE: f64 = 1e-6;

impl Judge {
    /// Notes the sizes of a step's terms, before the step is checked.
    pub(super) fn prepare(&mut self, step: &Step<'_>) {
        match step.path {
            Path::Exact(_) | Path::Series(_) => self.noise.begin_exact(step.start, step.end),
            Path::Grid | Path::OneRestitution | Path::Part { .. } | Path::Handed { .. } => {
                self.noise.begin(self.h, step.end)
            }
        }
        let way = if matches!(step.path, Path::Exact(_) | Path::Series(_)) { 0.0 } else { self.noise.span };
        self.noise.state(step.q, step.velocity_before, way, &self.weights);
        self.noise.state(step.q, step.velocity_after, way, &self.weights);
        for ((extra, load), per_root) in step.extra.iter().zip(&self.load_end).zip(&self.weights.per_root_mass) {
            self.noise.load((extra.abs() + load.abs()) * per_root);
        }
        self.noise.book(self.q.len() as f64, 1.0);
    }

    /// r₀, with a lower limit where forces are rounding; 0 where no wall pushed.
    pub(super) fn contact_scale(&self) -> f64 {
        if self.walls.force_scale == 0.0 {
            return 0.0;
        }
        let largest = self.balance.scale.max(self.scales.spring);
        self.walls.force_scale.max(LEAST_FORCE * self.scales.wall_force(largest))
    }

    /// The scale of momentum balances, N/√kg.
    pub(super) fn balance_scale(&self) -> f64 {
        self.balance.scale.max(self.scales.normal_force(self.walls.force_scale)).max(self.scales.spring)
    }

    /// The scale of displacements in the metric of the mass, m√kg.
    pub(super) fn path_scale(&self) -> f64 {
        self.extent.normal_reach.max(self.scales.gap)
    }

    /// The scheme's promises that the run so far has broken, the worst first; empty if it kept all
    /// of them. Rounding errors, estimated from the largest terms of the run and the lengths of its
    /// steps, have been subtracted from the residuals.
    #[must_use]
    pub fn findings(&self) -> Vec<Finding> {
        let (gap, speed) = (self.energy.gap_scale, self.rebound_scale());
        let force = self.contact_scale();
        let law = if force > 0.0 { force } else { self.scales.wall };
        let balance = self.balance_scale();
        let (walls, allowed) = (&self.walls, &self.contract.tolerances);
        let stands = matches!(self.contract.promise.rigid.displacement, Some(Bound::End | Bound::Throughout));
        let behind = if stands { Refuted::Penetration } else { Refuted::Complementarity };
        let energy = self.energy.report();
        let open = energy.residual_j.abs() - self.noise.energy;
        let ledger =
            LargestResidual { value: if self.keeps_ledger() { open } else { 0.0 }, time: self.noise.end, wall: None };
        let nothing = LargestResidual::default;
        let none = [nothing(), nothing(), nothing(), nothing()];
        let [askew, sliding, beyond, struck] = self.supports.as_ref().map_or(none, |supports| {
            let (askew, struck) = (supports.askew.excess.over(force), supports.struck.excess.over(speed));
            let rubs = &supports.rubs;
            [askew, rubs.worst_excess(speed, force), rubs.pull.excess.over(force), struck]
        });
        let mut findings: Vec<Finding> = [
            (behind, walls.gaps.outside.excess.over(gap), allowed.walls),
            (Refuted::Complementarity, walls.gaps.worst_excess(gap, force), allowed.walls),
            (Refuted::Complementarity, walls.rebounds.outside.excess.over(speed), allowed.walls),
            (Refuted::Complementarity, walls.rebounds.worst_excess(speed, force), allowed.walls),
            (Refuted::Tension, walls.gaps.pull.excess.over(force), allowed.walls),
            (Refuted::Tension, walls.rebounds.pull.excess.over(force), allowed.walls),
            (Refuted::WallLaw, walls.law.excess.over(law), allowed.walls),
            (Refuted::Normal, askew, allowed.walls),
            (Refuted::Complementarity, struck, allowed.walls),
            (Refuted::Friction, sliding, allowed.walls),
            (Refuted::Friction, beyond, allowed.walls),
            (Refuted::MomentumBalance, self.balance.force.excess.over(balance), allowed.balance),
            (Refuted::Impulses, self.open_momentum(), allowed.impulses),
            (Refuted::Kinematics, self.balance.path.excess.over(self.path_scale()), allowed.balance),
            (Refuted::Energy, ledger.over(energy.exchanged_j), allowed.energy),
        ]
        .into_iter()
        .filter(|(_, worst, allowed)| worst.value > allowed.limit || worst.value.is_nan())
        .map(|(refuted, worst, allowed)| self.finding(refuted, worst, allowed))
        .collect();
        sort_by_number(&mut findings, |a| -(a.residual / a.tolerance));
        // A residual whose rounding error overflows has none of the above.
        if let Some(part) = first_not_finite(&self.residuals()).filter(|_| findings.is_empty()) {
            findings.push(Finding::not_finite(&format!("residuals.{part}"), self.noise.end));
        }
        findings
    }

    fn finding(&self, refuted: Refuted, worst: LargestResidual, allowed: Tolerance) -> Finding {
        Finding {
            refuted,
            residual: worst.value,
            tolerance: allowed.limit,
            reason: allowed.reason.into(),
            time_s: worst.time,
            wall: worst.wall.and_then(|wall| self.scene.wall_name(wall)).map(str::to_owned),
        }
    }

    /// True where the scheme promises a closed energy ledger on this scene.
    fn keeps_ledger(&self) -> bool {
        let mut walls = self.scene.walls.iter().map(|wall| wall.law);
        match self.contract.tolerances.conserves {
            _ if self.handed => false,
            Conserves::Nothing => false,
            Conserves::RigidWalls => walls.all(|law| law.is_rigid()),
            Conserves::UndampedWalls => !walls.any(|law| law.is_damped()),
            Conserves::Everything => true,
        }
    }
}
