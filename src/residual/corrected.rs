//! Checks of a step that predicts and then corrects: [`Balance::GeneralizedAlpha`].

use super::Judge;
use super::blows::divide;
use super::previous_step::{PreviousStep, smooth};
use super::step_motion::StepMotion;
use crate::scene::Wall;
use crate::step::{Balance, Step};
use pulp::Scalar;

impl Judge {
    /// Checks a step on a grid whose displacement and velocity its walls corrected.
    pub(super) fn observe_corrected(&mut self, step: &Step<'_>) {
        // In one piece, the balance of one step, from its terms to its residual.
        let Balance::GeneralizedAlpha { alpha_m, alpha_f, beta, gamma } = self.contract.balance else { return };
        let Some(mut previous) = self.previous.take() else { return };
        let h = self.h;
        self.walls_on_grid(step, false);
        let closed = self.closes(step);
        let PreviousStep { s, force, s_end, force_end, beyond, open } = &mut *previous;
        let scratch = &mut self.scratch;
        force_end.copy_from_slice(&self.load_end);
        smooth(&self.scene, step.q, step.v, step.force, force_end);
        // The displacement that the blows cause within the step, times M/h, N s.
        self.loads.blow_moment(step.start, step.end, step.end, open);
        let (before, after) = (step.velocity_before, step.velocity_after);
        for i in 0..s.len() {
            s_end[i] = ((1.0 - alpha_f) * force_end[i] + alpha_f * force[i] - alpha_m * s[i]) / (1.0 - alpha_m);
            let pushed = h * step.extra[i];
            scratch.load[i] = 0.5 * (self.load[i] + self.load_end[i]) + step.extra[i];
            // What M(v₊ − v₋) and M(q⁺ − q − hv₋)/h should be, N s, with the opposite sign; what
            // they are is added below.
            scratch.residual[i] = -h * ((1.0 - gamma) * s[i] + gamma * s_end[i]) - pushed - self.blows.impulse[i];
            open[i] = -h * ((0.5 - beta) * s[i] + beta * s_end[i]) - 0.5 * pushed - open[i] / h;
            scratch.gained[i] = after[i] - before[i];
            beyond[i] = step.q[i] - self.q[i] - h * before[i];
            let given = pushed.abs().max(self.blows.impulse[i].abs());
            let terms = s_end[i].abs().max(force_end[i].abs()).max(given / h);
            self.balance.raise_scale(terms / self.weights.root_mass[i]);
        }
        let system = &self.scene.system;
        system.add_mass(1.0, &scratch.gained, &mut scratch.residual);
        system.add_mass(1.0 / h, beyond, open);
        for (wall, &p) in self.scene.walls.iter().zip(step.impulse).filter(|(wall, _)| wall.law.is_rigid()) {
            for &(i, weight) in wall.row().entries() {
                scratch.residual[i] -= weight * p;
                self.balance.raise_scale((weight * p).abs() / (h * self.weights.root_mass[i]));
            }
        }
        if self.supports.is_some() {
            self.supports_on_grid(Scalar, step, false);
        }
        // Under this rule the damper feels a blow from the middle of the step on.
        let (from, to) = (step.start, step.end);
        if self.loads.has_blows() && self.loads.blow_moment(from, to, to - 0.5 * h, &mut self.blows.felt) {
            divide(&self.scene, self.mass.as_mut(), &mut self.blows.felt);
            let drives =
                |wall: &Wall| wall.law.is_rigid() && wall.side().sign() * wall.row().dot(&self.blows.struck) < 0.0;
            let either = closed && (self.scene.walls.iter().any(drives) || self.drives_into_hole(step));
            self.take_felt(either, step);
        }
        let (mut worst, mut path) = (0.0_f64, 0.0_f64);
        for (i, weight) in self.weights.root_mass.iter().enumerate() {
            let residual = self.scratch.residual[i].abs();
            self.balance.raise_largest(residual / h);
            worst = worst.max(residual / (h * weight));
            // The balance of the displacement is checked as a length: divided by h² it would be
            // dominated by the rounding error of q.
            if !closed {
                path = path.max(h * open[i].abs() / weight);
            }
            self.noise.load(s_end[i].abs().max(force_end[i].abs()) / weight);
        }
        self.noise.state(step.q, step.v, h, &self.weights);
        std::mem::swap(s, s_end);
        std::mem::swap(force, force_end);
        self.previous = Some(previous);
        let (hs, loads) = ((h, 1.0 / h), (&self.load[..], &self.load_end[..]));
        let moves = StepMotion::of(step, hs, (&self.q, step.q), loads, &self.blows.impulse);
        let rates = self.supports.as_ref().map_or(&[][..], |supports| &supports.rates);
        self.energy.observe_grid(Scalar, &moves, step, &self.scratch.load, rates, self.q.len());
        if self.blows.struck.iter().any(|v| *v != 0.0) {
            self.energy.answer(step, &self.blows.struck);
        }
        self.balance.observe(&self.noise, worst, path);
    }
}
