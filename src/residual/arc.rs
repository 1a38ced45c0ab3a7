//! The judge on the exact motion of one degree of freedom.

use super::{Judge, PLACE_UNITS, quadrature};
use crate::flow::Arc;
use crate::step::Step;

impl Judge {
    /// A stretch between two events, or an instant.
    pub(super) fn see_arc(&mut self, step: &Step<'_>, arc: &Arc) {
        let ends = self.energy.see_arc(&self.scene, step, arc, &self.loads, &self.scratch.blow);
        for (index, wall) in self.scene.walls.iter().enumerate() {
            self.tension = self.tension.max(-wall.side.sign() * step.jump[index]);
        }
        // An instant knows no forces.
        if step.end <= step.start {
            return;
        }
        let weight = self.scales.root_mass.first().copied().unwrap_or(1.0);
        let balance = ends.balance / (step.end - step.start);
        self.balance = self.balance.max(balance);
        self.normal_balance = self.balance / weight;
        self.balance_scale = self.balance_scale.max(ends.largest_force / weight);
        self.rounding.load(0, ends.largest_force);
        for (t, _) in quadrature::nodes(step.start, step.end) {
            let (q, v) = arc.state(t);
            for index in 0..self.scene.walls.len() {
                let wall = &self.scene.walls[index];
                let (sign, rigid) = (wall.side.sign(), wall.law.is_rigid());
                let (w, wdot) = (wall.at.dot(&[q]), wall.at.dot(&[v]));
                let pressure = sign * arc.force_at(index, t, (q, v));
                self.force_scale = self.force_scale.max(pressure.abs());
                self.tension = self.tension.max(-pressure);
                self.depth[index] = self.depth[index].max(-wall.gap(w));
                self.rounding.state(&[q], &[v], 0.0);
                self.rounding.push(index, pressure, rigid);
                let size = self.reach.max(w.abs()) + wall.position.abs() + wdot.abs() * t;
                if rigid {
                    let gap = wall.gap(w);
                    self.pairs.add(gap, pressure);
                    self.doubt_gap(index, gap, size, pressure);
                } else {
                    let rounding = PLACE_UNITS * f64::EPSILON * size;
                    let law = |s: f64| wall.law.pressure(s, -sign * wdot);
                    let (low, high) = (law(-wall.gap(w) - rounding), law(-wall.gap(w) + rounding));
                    // Between the two, which differ by the wall's stiffness times the rounding, but at a damped wall's face.
                    let error = (low - pressure).max(pressure - high);
                    self.law_error = self.law_error.max(error);
                    self.doubt_law(index, error, 0.0);
                }
            }
        }
        self.doubt_balance(balance / weight);
    }
}
