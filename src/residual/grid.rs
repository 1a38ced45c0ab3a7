//! A step on a grid, held to its word.

use super::{Judge, divide};
use crate::scene::{Scene, Wall};
use crate::step::{Balance, Bound, Promise, Step};

/// True if a rigid wall that pushes is what the blows, which give the velocity `given`, drive into, where a promise keeps the two together:
/// a bound at the step's end does not, for it holds where the blows leave the displacement.
fn answered(scene: &Scene, promise: Promise, impulse: &[f64], given: &[f64]) -> bool {
    let drives =
        |(wall, &p): (&Wall, &f64)| wall.law.is_rigid() && p != 0.0 && wall.side.sign() * wall.at.dot(given) < 0.0;
    promise.rigid.displacement != Some(Bound::End) && scene.walls.iter().zip(impulse).any(drives)
}

impl Judge {
    /// A step between two instants of a grid.
    pub(super) fn see_grid(&mut self, step: &Step<'_>) {
        let beyond = self.find_beyond(step);
        self.walls_on_grid(step, beyond);
        let h = self.h;
        let per_h = 1.0 / h;
        let (mut worst, mut path) = (0.0_f64, 0.0_f64);
        let s = &mut self.scratch;
        let arrived: &[f64] = if beyond { &s.arrived } else { step.q };
        let (before, after) = (step.velocity_before, step.velocity_after);
        for i in 0..s.residual.len() {
            let (q0, q1) = (self.q[i], arrived[i]);
            match self.contract.balance {
                Balance::Theta(theta) => {
                    let mean = |a: f64, b: f64| (1.0 - theta) * a + theta * b;
                    s.load[i] = mean(self.load[i], s.load_end[i]);
                    s.mean_q[i] = mean(q0, q1);
                    s.mean_v[i] = mean(before[i], after[i]);
                    path = path.max((q1 - q0 - h * s.mean_v[i]).abs() * self.scales.root_mass[i]);
                }
                Balance::Staggered(b) => {
                    let back = q0 - h * before[i];
                    s.load[i] = self.load[i];
                    s.mean_q[i] = b * back + (1.0 - 2.0 * b) * q0 + b * q1;
                    s.mean_v[i] = 0.5 * (before[i] + after[i]);
                    path = path.max((q1 - q0 - h * after[i]).abs() * self.scales.root_mass[i]);
                }
                Balance::GeneralizedAlpha { .. } | Balance::Exact => {}
            }
            s.load[i] += step.extra[i];
            s.residual[i] = -h * s.load[i] - s.blow[i];
            self.rounding.load(i, s.load[i].abs().max(s.blow[i].abs() * per_h));
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
            let moved = inertia.abs().max(damper.abs()).max(spring.abs()).max(s.blow[i].abs());
            let largest = s.load[i].abs().max(moved * per_h);
            self.balance_scale = self.balance_scale.max(largest * self.scales.per_root_mass[i]);
        }
        for (wall, &p) in self.scene.walls.iter().zip(step.impulse) {
            for &(i, weight) in wall.at.entries() {
                s.residual[i] -= weight * p;
            }
        }
        self.feel_blows(step, beyond);
        let s = &self.scratch;
        let arrived: &[f64] = if beyond { &s.arrived } else { step.q };
        for (r, per_weight) in s.residual.iter().zip(&self.scales.per_root_mass) {
            let open = r.abs() * per_h;
            self.balance = self.balance.max(open);
            worst = worst.max(open * per_weight);
        }
        self.normal_balance = self.normal_balance.max(worst);
        self.kinematics = self.kinematics.max(path);
        self.energy.see_grid(&self.scene, h, (&self.q, arrived), step, &s.load, &s.blow);
        if beyond {
            self.energy.displace(&self.scene, h, step);
        }
        self.doubt_balance(worst);
        self.doubt_path(path);
    }

    /// What the blows of the step add to the displacement, and the displacement without, in `arrived`; returns whether they add anything: if
    /// not, the displacement is the step's, and `arrived` is not set.
    fn find_beyond(&mut self, step: &Step<'_>) -> bool {
        if !self.loads.has_blows() {
            return false;
        }
        let s = &mut self.scratch;
        s.arrived.copy_from_slice(step.q);
        let (start, end, h) = (step.start, step.end, self.h);
        let spans = match self.contract.balance {
            Balance::Theta(theta) => [(start, end, end - theta * h), (end, end, end)],
            _ => {
                let middle = (step.index as f64 + 0.5) * h;
                [(start, middle, start), (middle, end, end)]
            }
        };
        // The velocity that the blows give, for a while.
        let given = &mut s.mean_v;
        s.beyond.fill(0.0);
        let mut any = false;
        for (from, to, about) in spans {
            any |= self.loads.blow_moment(from, to, about, given);
            s.beyond.iter_mut().zip(given.iter()).for_each(|(sum, moment)| *sum += moment);
        }
        if !any {
            return false;
        }
        self.loads.blow(start, end, given);
        divide(&self.scene, self.mass.as_mut(), &mut s.beyond);
        divide(&self.scene, self.mass.as_mut(), given);
        if answered(&self.scene, self.contract.promise, step.impulse, given) {
            // The wall may push because the damper felt the blow, and only then: which of the two it is shows in the displacement.
            let mut apart = [0.0, 0.0];
            for i in 0..s.beyond.len() {
                let mean = match self.contract.balance {
                    Balance::Theta(theta) => (1.0 - theta) * step.velocity_before[i] + theta * step.velocity_after[i],
                    _ => step.velocity_after[i],
                };
                let moved = step.q[i] - self.q[i] - h * mean;
                for (apart, by) in apart.iter_mut().zip([0.0, s.beyond[i]]) {
                    *apart += ((moved - by) * self.scales.root_mass[i]).powi(2);
                }
            }
            if apart[0] <= apart[1] {
                s.beyond.fill(0.0);
                return false;
            }
        }
        s.arrived.iter_mut().zip(&s.beyond).for_each(|(q, beyond)| *q -= beyond);
        true
    }

    /// Takes −C d into the balance: what the damper feels of the way on which the blows take the body beside the rule's.
    fn feel_blows(&mut self, step: &Step<'_>, beyond: bool) {
        if !self.loads.has_blows() {
            return;
        }
        let s = &mut self.scratch;
        match self.contract.balance {
            Balance::Theta(_) if beyond => s.felt.copy_from_slice(&s.beyond),
            Balance::Staggered(_) => {
                let about = |half_steps: f64| (half_steps * self.h).max(0.0);
                let (from, to) = (about(step.index as f64 - 0.5), about(step.index as f64 + 0.5));
                if !self.loads.blow_moment(from, to, step.start, &mut s.felt) {
                    return;
                }
                divide(&self.scene, self.mass.as_mut(), &mut s.felt);
            }
            _ => return,
        }
        let either = matches!(self.contract.balance, Balance::Staggered(_))
            && answered(&self.scene, self.contract.promise, step.impulse, &s.struck);
        self.sums.whole &= !either;
        self.take_felt(either, step);
    }

    /// Adds C times what the damper felt of blows to the residual, unless a wall answered these (`either`) and without it less is left.
    pub(super) fn take_felt(&mut self, either: bool, step: &Step<'_>) {
        let s = &mut self.scratch;
        let felt = &mut s.mean_v;
        felt.fill(0.0);
        self.scene.system.add_damping(1.0, &s.felt, felt);
        let left = |share: f64| -> f64 {
            let terms = s.residual.iter().zip(&*felt).zip(&self.scales.root_mass);
            terms.map(|((r, felt), weight)| ((r + share * felt) / weight).powi(2)).sum()
        };
        if either && left(0.0) <= left(1.0) {
            return;
        }
        let mut lost = 0.0;
        for (i, &felt) in felt.iter().enumerate() {
            s.residual[i] += felt;
            s.blow[i] -= felt;
            lost += 0.5 * felt * (step.velocity_before[i] + step.velocity_after[i]);
            self.balance_scale = self.balance_scale.max(felt.abs() / (self.h * self.scales.root_mass[i]));
        }
        self.energy.damp(lost);
    }
}
