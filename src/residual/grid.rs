//! A step on a grid, held to its word.

use super::Judge;
use super::complementarity::{self, expected_pressure};
use crate::step::{Balance, Promise, Step};

impl Judge {
    /// A step between two instants of a grid.
    pub(super) fn see_grid(&mut self, step: &Step<'_>) {
        self.walls_on_grid(step);
        let h = self.h;
        let s = &mut self.scratch;
        let (before, after) = (step.velocity_before, step.velocity_after);
        for i in 0..s.residual.len() {
            let (q0, q1) = (self.q[i], step.q[i]);
            match self.contract.balance {
                Balance::Theta(theta) => {
                    let mean = |a: f64, b: f64| (1.0 - theta) * a + theta * b;
                    s.load[i] = mean(self.load[i], s.load_end[i]);
                    s.mean_q[i] = mean(q0, q1);
                    s.mean_v[i] = mean(before[i], after[i]);
                    self.kinematics = self.kinematics.max((q1 - q0 - h * s.mean_v[i]).abs() * self.scales.root_mass[i]);
                }
                Balance::Staggered(b) => {
                    let back = q0 - h * before[i];
                    s.load[i] = self.load[i];
                    s.mean_q[i] = b * back + (1.0 - 2.0 * b) * q0 + b * q1;
                    s.mean_v[i] = 0.5 * (before[i] + after[i]);
                    self.kinematics = self.kinematics.max((q1 - q0 - h * after[i]).abs() * self.scales.root_mass[i]);
                }
                Balance::GeneralizedAlpha { .. } | Balance::Exact => {}
            }
            s.load[i] += step.extra[i];
            s.residual[i] = -h * s.load[i] - s.blow[i];
            let largest = s.load[i].abs().max(s.blow[i].abs() / h);
            self.balance_scale = self.balance_scale.max(largest / self.scales.root_mass[i]);
            (s.inertia[i], s.damper[i], s.spring[i]) = (0.0, 0.0, 0.0);
        }
        let system = &self.scene.system;
        system.add_mass(1.0, after, &mut s.inertia);
        system.add_mass(-1.0, before, &mut s.inertia);
        system.add_damping(h, &s.mean_v, &mut s.damper);
        system.add_stiffness(h, &s.mean_q, &mut s.spring);
        for i in 0..s.residual.len() {
            let (inertia, damper, spring) = (s.inertia[i], s.damper[i], s.spring[i]);
            s.residual[i] += inertia + damper + spring;
            let largest = inertia.abs().max(damper.abs()).max(spring.abs()) / h;
            self.balance_scale = self.balance_scale.max(largest / self.scales.root_mass[i]);
        }
        for (wall, &p) in self.scene.walls.iter().zip(step.impulse) {
            for &(i, weight) in wall.at.entries() {
                s.residual[i] -= weight * p;
            }
        }
        for (r, weight) in s.residual.iter().zip(&self.scales.root_mass) {
            self.balance = self.balance.max(r.abs() / h);
            self.normal_balance = self.normal_balance.max(r.abs() / (h * weight));
        }
        self.energy.see_grid(&self.scene, h, &self.q, step, &s.load, &s.blow);
    }

    fn walls_on_grid(&mut self, step: &Step<'_>) {
        for (index, wall) in self.scene.walls.iter().enumerate() {
            let sign = wall.side.sign();
            // The multiplier where the promise is made on it, else the mean force of the step.
            let force = if self.contract.promise == Promise::EndPosition {
                step.force[index]
            } else {
                step.impulse[index] / self.h
            };
            let pressure = sign * force;
            self.force_scale = self.force_scale.max(pressure.abs()).max(step.impulse[index].abs() / self.h);
            self.tension = self.tension.max(-pressure);
            let (w0, w1) = (wall.at.dot(&self.q), wall.at.dot(step.q));
            let rates = (wall.at.dot(step.velocity_before), wall.at.dot(step.velocity_after));
            if wall.law.is_rigid() {
                let gap_scale = self.energy.gap_scale;
                let struck = rates.0 + wall.at.dot(&self.scratch.struck);
                let (ends, rates) = ((w0, w1), (struck, rates.1));
                match complementarity::slack(&self.scene, index, self.contract, self.h, ends, rates, gap_scale) {
                    Some(slack) if self.contract.promise == Promise::Velocity => self.rebounds.add(slack, pressure),
                    Some(slack) => self.pairs.add(slack, pressure),
                    None => self.law_error = self.law_error.max(pressure.abs()),
                }
            } else {
                let expected = expected_pressure(wall, self.contract, self.h, (w0, w1), rates);
                self.law_error = self.law_error.max((pressure - expected).abs());
            }
        }
    }
}
