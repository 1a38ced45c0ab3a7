//! The energy ledger of a structure's exact motion: integrals over a stretch, and the jump at its
//! end.

use super::super::pushes::pushes;
use super::{Flows, Ledger, stored};
use crate::scene::Scene;
use crate::step::Step;

/// Energy flows over a stretch, J.
#[derive(Debug, Clone, Copy, Default)]
pub(in super::super) struct Moved {
    /// ∫ f·q̇ and ∫ |f·q̇|.
    pub work: f64,
    pub passed: f64,
    /// ∫ q̇ᵀC q̇.
    pub damping: f64,
    /// ∫ −r ẇ over damped walls.
    pub push: f64,
    /// The largest energy at the nodes.
    pub largest: f64,
}

impl Ledger {
    /// Energy of structure and walls at a state; `force` is that of each wall.
    pub fn energy_at(scene: &Scene, q: &[f64], v: &[f64], force: impl Fn(usize) -> f64) -> f64 {
        let walls = scene.walls.iter().enumerate();
        let held: f64 = walls.map(|(index, wall)| stored(wall, wall.row().dot(q), force(index) != 0.0)).sum();
        scene.system.energy(q, v) + held
    }

    /// Adds a stretch and the jump at its end, where the velocity goes from `left` by blows (N s)
    /// to `mid` and by impacts to the step's.
    pub fn observe_series(&mut self, step: &Step<'_>, moved: Moved, blow: &[f64], left: &[f64], mid: &[f64]) {
        let mut flows = Flows {
            work: moved.work,
            passed: moved.passed,
            damping: moved.damping,
            dashpot: moved.push,
            impact: 0.0,
            friction: 0.0,
        };
        self.report.largest_j = self.report.largest_j.max(moved.largest);
        for ((blow, left), mid) in blow.iter().zip(left).zip(mid) {
            let struck = 0.5 * blow * (left + mid);
            flows.work += struck;
            flows.passed += struck.abs();
        }
        for (wall, jump) in self.scene.walls.iter().zip(step.jump) {
            flows.impact -= 0.5 * jump * (wall.row().dot(mid) + wall.row().dot(step.v));
        }
        let walls = self.store(step, &mut flows);
        for hole in self.scene.holes().filter(|hole| step.jump[hole.index] != 0.0) {
            let (jump, [y, z]) = (step.jump[hole.index], step.normal[hole.index]);
            let [before, after] = [mid, step.v].map(|v| hole.seen(v));
            flows.impact += 0.5 * jump * (y * (before[0] + after[0]) + z * (before[1] + after[1]));
        }
        if !step.friction.is_empty() {
            for (_, at, [_, rub]) in pushes(&self.scene, step).filter(|(index, ..)| step.jump[*index] != 0.0) {
                let [before, after] = [mid, step.v].map(|v| at.dot(v));
                flows.friction -= 0.5 * (rub[0] * (before[0] + after[0]) + rub[1] * (before[1] + after[1]));
            }
        }
        if step.jump.iter().any(|jump| *jump != 0.0) {
            self.reach(self.scene.system.energy(step.q, mid) + walls);
        }
        self.book(self.scene.system.energy(step.q, step.v) + walls, flows);
    }
}
