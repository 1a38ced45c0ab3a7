//! Turns residuals, minus their rounding errors, into findings.

use super::beyond::Worst;
use super::{Finding, Judge, Refuted};
use crate::finite::first_not_finite;
use crate::step::{Bound, Conserves, Path, Step, Tolerance};

/// Contact forces below this share of the largest force in the balance are measured by that share
/// of it: where forces cancel, the remainder is rounding, and a residual relative to rounding means
/// nothing.
const LEAST_FORCE: f64 = 1e-6;

impl Judge {
    /// Notes the sizes of a step's terms, before the step is checked.
    pub(super) fn prepare(&mut self, step: &Step<'_>) {
        self.now = step.end;
        (self.span, self.clock) = match step.path {
            Path::Exact(_) | Path::Series(_) => {
                let span = (step.end - step.start).max(f64::EPSILON * step.end).max(f64::MIN_POSITIVE);
                (span, 1.0 + step.end / span)
            }
            Path::Grid | Path::OneRestitution | Path::Handed { .. } => (self.h, 1.0),
        };
        let way = if matches!(step.path, Path::Exact(_) | Path::Series(_)) { 0.0 } else { self.span };
        self.rounding.state(step.q, step.velocity_before, way, &self.weights);
        self.rounding.state(step.q, step.velocity_after, way, &self.weights);
        for ((extra, load), per_root) in step.extra.iter().zip(&self.load_end).zip(&self.weights.per_root_mass) {
            self.rounding.load((extra.abs() + load.abs()) * per_root);
        }
        self.rounding.book(self.q.len() as f64, 1.0, self.span);
    }

    /// Adds a gap (or the slack of a bound) whose terms are of this `size`, m, minus its rounding
    /// error.
    pub(super) fn doubt_gap(&mut self, wall: usize, gap: f64, size: f64, pressure: f64) {
        if gap < 0.0 || pressure != 0.0 {
            let noise = self.rounding.met(size, self.energy.gap_scale);
            let force = self.rounding.wall_force(wall, self.span, self.clock);
            self.doubts.gaps.add((gap, noise), (pressure, force), self.now, wall);
        }
    }

    /// Adds a speed of rebound, minus its rounding error.
    pub(super) fn doubt_rebound(&mut self, index: usize, slack: f64, step: &Step<'_>, pressure: f64) {
        if slack < 0.0 || pressure != 0.0 {
            let Some(wall) = self.scene.walls.get(index) else { return };
            let speeds = |v: &[f64]| wall.at.entries().iter().map(|&(i, g)| (g * v[i]).abs()).sum::<f64>();
            let size = speeds(step.velocity_before) + speeds(step.velocity_after) + speeds(&self.blows.struck);
            let noise = self.rounding.met(size, self.energy.gap_scale / self.span);
            let force = self.rounding.wall_force(index, self.span, self.clock);
            self.doubts.rebounds.add((slack, noise), (pressure, force), self.now, index);
        }
    }

    /// Adds the `error` of a wall's force against its law, N, minus its rounding error and minus
    /// `place`, the part that the rounding error of the body's position explains.
    pub(super) fn doubt_law(&mut self, wall: usize, error: f64, place: f64) {
        if error > 0.0 || error.is_nan() {
            let force = self.rounding.wall_force(wall, self.span, self.clock);
            self.doubts.law.see(error - place - force, self.now, Some(wall));
        }
    }

    /// Adds the residual of a step's momentum balance, N/√kg, minus its rounding error.
    pub(super) fn doubt_balance(&mut self, residual: f64) {
        self.doubts.balance.see(residual - self.rounding.force(self.span, self.clock), self.now, None);
    }

    /// Adds the residual of the displacement against the velocities, m√kg, minus its rounding
    /// error.
    pub(super) fn doubt_path(&mut self, residual: f64) {
        self.doubts.path.see(residual - self.rounding.path(), self.now, None);
    }

    /// r₀, with a lower limit where forces are rounding; 0 where no wall pushed.
    pub(super) fn contact_scale(&self) -> f64 {
        if self.force_scale == 0.0 {
            return 0.0;
        }
        let largest = self.balance_scale.max(self.scales.spring);
        self.force_scale.max(LEAST_FORCE * self.scales.wall_force(largest))
    }

    /// The scheme's promises that the run so far has broken, the worst first; empty if it kept all
    /// of them. Rounding errors, estimated from the largest terms of the run and the lengths of its
    /// steps, have been subtracted from the residuals.
    #[must_use]
    pub fn findings(&self) -> Vec<Finding> {
        let (gap, speed) = (self.energy.gap_scale, self.rebound_scale());
        let force = self.contact_scale();
        let law = if force > 0.0 { force } else { self.scales.wall };
        let balance = self.balance_scale.max(self.scales.normal_force(self.force_scale)).max(self.scales.spring);
        let (doubts, allowed) = (&self.doubts, &self.contract.tolerances);
        let stands = matches!(self.contract.promise.rigid.displacement, Some(Bound::End | Bound::Throughout));
        let behind = if stands { Refuted::Penetration } else { Refuted::Complementarity };
        let energy = self.energy.report();
        let open = energy.residual_j.abs() - self.rounding.energy;
        let ledger = Worst { value: if self.keeps_ledger() { open } else { 0.0 }, time: self.now, wall: None };
        let nothing = Worst::default;
        let none = [nothing(), nothing(), nothing(), nothing()];
        let [askew, sliding, beyond, struck] = self.supports.as_ref().map_or(none, |supports| {
            let rubs = &supports.rubs.doubts;
            let (askew, struck) = (supports.doubt.over(force), supports.struck_doubt.over(speed));
            [askew, rubs.both(speed, force), rubs.pull.over(force), struck]
        });
        let mut findings: Vec<Finding> = [
            (behind, doubts.gaps.outside.over(gap), allowed.walls),
            (Refuted::Complementarity, doubts.gaps.both(gap, force), allowed.walls),
            (Refuted::Complementarity, doubts.rebounds.outside.over(speed), allowed.walls),
            (Refuted::Complementarity, doubts.rebounds.both(speed, force), allowed.walls),
            (Refuted::Tension, doubts.gaps.pull.over(force), allowed.walls),
            (Refuted::Tension, doubts.rebounds.pull.over(force), allowed.walls),
            (Refuted::WallLaw, doubts.law.over(law), allowed.walls),
            (Refuted::Normal, askew, allowed.walls),
            (Refuted::Complementarity, struck, allowed.walls),
            (Refuted::Friction, sliding, allowed.walls),
            (Refuted::Friction, beyond, allowed.walls),
            (Refuted::MomentumBalance, doubts.balance.over(balance), allowed.balance),
            (Refuted::Impulses, self.open_momentum(), allowed.impulses),
            (Refuted::Kinematics, doubts.path.over(self.extent.normal_reach.max(self.scales.gap)), allowed.balance),
            (Refuted::Energy, ledger.over(energy.exchanged_j), allowed.energy),
        ]
        .into_iter()
        .filter(|(_, worst, allowed)| worst.value > allowed.limit || worst.value.is_nan())
        .map(|(refuted, worst, allowed)| self.finding(refuted, worst, allowed))
        .collect();
        findings.sort_by(|a, b| (b.residual / b.tolerance).total_cmp(&(a.residual / a.tolerance)));
        // A residual whose rounding error overflows has none of the above.
        if let Some(part) = first_not_finite(&self.residuals()).filter(|_| findings.is_empty()) {
            findings.push(Finding::not_finite(&format!("residuals.{part}"), self.now));
        }
        findings
    }

    fn finding(&self, refuted: Refuted, worst: Worst, allowed: Tolerance) -> Finding {
        Finding {
            refuted,
            residual: worst.value,
            tolerance: allowed.limit,
            reason: allowed.reason.into(),
            time_s: worst.time,
            wall: worst.wall.and_then(|wall| self.scene.contact_name(wall)).map(str::to_owned),
        }
    }

    /// True where the scheme promises a closed energy ledger on this scene.
    fn keeps_ledger(&self) -> bool {
        let laws: Vec<_> =
            self.scene.walls.iter().map(|wall| wall.law).chain(self.scene.holes().map(|hole| hole.law)).collect();
        let mut walls = laws.iter();
        match self.contract.tolerances.conserves {
            _ if self.doubts.handed => false,
            Conserves::Nothing => false,
            Conserves::RigidWalls => walls.all(|law| law.is_rigid()),
            Conserves::UndampedWalls => !walls.any(|law| law.damping() > 0.0),
            Conserves::Everything => true,
        }
    }
}
