//! The energy flows at walls and round holes.

use super::super::complementarity::mean_pressure;
use super::super::pushes::pushes;
use super::{Flows, Ledger, half, stored};
use crate::step::Step;

impl Ledger {
    /// Adds the flows at the walls; returns the energy that they store after the step, J.
    #[inline(never)]
    pub(super) fn observe_walls(
        &mut self,
        h: f64,
        (q0, q1): (&[f64], &[f64]),
        step: &Step<'_>,
        flows: &mut Flows,
    ) -> f64 {
        let (before, after) = (step.velocity_before, step.velocity_after);
        let staggered = self.staggered().is_some();
        let mut walls = 0.0;
        for (index, (wall, &p)) in self.scene.walls.iter().zip(step.impulse).enumerate() {
            if wall.law.is_rigid() {
                if p != 0.0 {
                    flows.impact -= p * 0.5 * (wall.row().dot(before) + wall.row().dot(after));
                }
                continue;
            }
            let rate = 0.5 * (wall.row().dot(before) + wall.row().dot(after));
            let (w0, w1) = (wall.coordinate(q0), wall.coordinate(q1));
            let touches = p != 0.0;
            let now =
                if staggered { half(wall, w0, h * wall.row().dot(after), touches) } else { stored(wall, w1, touches) };
            walls += now;
            let held = std::mem::replace(&mut self.held[index], now);
            if wall.law.is_damped() {
                if touches {
                    let plate = |w: f64| (-wall.gap(w)).max(0.0);
                    let rate = if staggered { rate } else { (plate(w1) - plate(w0)) / h };
                    let dashpot = wall.law.dashpot(mean_pressure(&wall.law, -wall.gap(w0), -wall.gap(w1)));
                    flows.dashpot += dashpot * rate * rate * h;
                    // Where contact begins with the body already behind the face, the energy of the
                    // spring there counts as supplied by the wall.
                    flows.dashpot -= if held == 0.0 { wall.law.energy(-wall.gap(w0)) } else { 0.0 };
                } else {
                    // What a damped wall stores when contact ends is dissipated: spring and dashpot
                    // relax against each other.
                    flows.dashpot += held;
                }
            }
        }
        walls
    }

    /// Takes what elastic walls store at the end of exact motion in place of what they stored
    /// before, which the flow of their dashpots lacks; returns what they store now, J.
    pub(super) fn store(&mut self, step: &Step<'_>, flows: &mut Flows) -> f64 {
        let mut walls = 0.0;
        for (index, wall) in self.scene.walls.iter().enumerate().filter(|(_, wall)| !wall.law.is_rigid()) {
            let now = stored(wall, wall.row().dot(step.q), step.force[index] != 0.0);
            walls += now;
            let held = std::mem::replace(&mut self.held[index], now);
            if wall.law.is_damped() {
                flows.dashpot -= now - held;
            }
        }
        walls
    }

    /// Adds the flows at round holes, and those of friction.
    #[inline(never)]
    pub(super) fn observe_supports(&self, step: &Step<'_>, rates: &[[[f64; 2]; 2]], flows: &mut Flows) {
        for (index, _, [push, rub]) in pushes(&self.scene, step) {
            let [before, after] = rates.get(index).copied().unwrap_or_default();
            let work = |force: [f64; 2]| 0.5 * (force[0] * (before[0] + after[0]) + force[1] * (before[1] + after[1]));
            let rigid = self.scene.walls[index].law.is_rigid();
            flows.impact -= if rigid { work(push) } else { 0.0 };
            flows.friction -= work(rub);
        }
    }
}
