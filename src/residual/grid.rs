//! Checks of a step on a grid against its scheme's contract.

use super::matrices::Part;
use super::most::most;
use super::pushes::pushes;
use super::{Judge, divide};
use crate::scene::{Scene, Wall};
use crate::step::{Balance, Bound, Promise, Step};

/// True if the blows, which give the velocity `given`, drive the body into a rigid wall that pushes
/// in this step, under a promise by which blow and answer take effect together. Under a bound on
/// the displacement at the step's end they do not, since that bound includes the displacement by
/// the blows.
fn answered(scene: &Scene, promise: Promise, impulse: &[f64], given: &[f64]) -> bool {
    let drives =
        |(wall, &p): (&Wall, &f64)| wall.law.is_rigid() && p != 0.0 && wall.side.sign() * wall.at.dot(given) < 0.0;
    promise.rigid.displacement != Some(Bound::End) && scene.walls.iter().zip(impulse).any(drives)
}

impl Judge {
    /// Checks a step between two instants of a grid.
    pub(super) fn see_grid(&mut self, step: &Step<'_>) {
        match self.q.len() {
            // With n constant the compiler removes the loops.
            1 => self.see_grid_of(step, 1),
            n => self.see_grid_of(step, n),
        }
    }

    #[inline(always)]
    fn see_grid_of(&mut self, step: &Step<'_>, n: usize) {
        let beyond = self.loads.has_blows() && self.find_beyond(step);
        let per_h = 1.0 / self.h;
        let path = self.terms_of(step, beyond, per_h, n);
        self.walls_on_grid(step, beyond);
        if self.supports.is_some() {
            self.supports_on_grid(step, beyond);
        }
        self.products_of(per_h, n);
        for (wall, &p) in self.scene.walls.iter().zip(step.impulse) {
            if p != 0.0 {
                for &(i, weight) in wall.at.entries() {
                    self.scratch.residual[i] -= weight * p;
                }
            }
        }
        if self.loads.has_blows() {
            self.feel_blows(step, beyond);
        }
        let mut worst = 0.0;
        let s = &self.scratch;
        for (r, per_weight) in s.residual[..n].iter().zip(&self.scales.per_root_mass[..n]) {
            let open = r.abs() * per_h;
            self.balance = most(self.balance, open);
            worst = most(worst, open * per_weight);
        }
        self.normal_balance = most(self.normal_balance, worst);
        self.kinematics = most(self.kinematics, path);
        let arrived: &[f64] = if beyond { &s.arrived } else { step.q };
        let ends = (&self.q[..], arrived);
        self.energy.see_grid(&self.scene, &self.matrices, (self.h, per_h), ends, step, (&s.load, &s.blow), n);
        if beyond {
            self.energy.displace(&self.scene, &self.matrices, self.h, step);
        }
        self.doubt_balance(worst);
        self.doubt_path(path);
        self.sum(step, per_h, n);
        self.go_on(step, n);
    }

    /// Computes the mean load, displacement and velocity of a step and their terms in its balance,
    /// and notes the sizes of all these. Returns the difference of the displacement and the one
    /// that follows from the velocities, m√kg.
    #[inline(always)]
    fn terms_of(&mut self, step: &Step<'_>, beyond: bool, per_h: f64, n: usize) -> f64 {
        (self.now, self.span, self.clock) = (step.end, self.h, 1.0);
        let h = self.h;
        let s = &mut self.scratch;
        let arrived: &[f64] = if beyond { &s.arrived } else { step.q };
        let (q0, q1, shown) = (&self.q[..n], &arrived[..n], &step.q[..n]);
        let (before, after, extra) = (&step.velocity_before[..n], &step.velocity_after[..n], &step.extra[..n]);
        let (load_start, load_end) = (&self.load[..n], &s.load_end[..n]);
        let (load, blow, residual) = (&mut s.load[..n], &s.blow[..n], &mut s.residual[..n]);
        let (mean_q, mean_v, inertia) = (&mut s.mean_q[..n], &mut s.mean_v[..n], &mut s.gained[..n]);
        let root_mass = &self.scales.root_mass[..n];
        let mut path = 0.0;
        match self.contract.balance {
            Balance::Theta(theta) => {
                let mean = |a: f64, b: f64| (1.0 - theta) * a + theta * b;
                for i in 0..n {
                    load[i] = mean(load_start[i], load_end[i]);
                    mean_q[i] = mean(q0[i], q1[i]);
                    mean_v[i] = mean(before[i], after[i]);
                    path = most(path, (q1[i] - q0[i] - h * mean_v[i]).abs() * root_mass[i]);
                }
            }
            Balance::Staggered(b) => {
                for i in 0..n {
                    let back = q0[i] - h * before[i];
                    load[i] = load_start[i];
                    mean_q[i] = b * back + (1.0 - 2.0 * b) * q0[i] + b * q1[i];
                    mean_v[i] = 0.5 * (before[i] + after[i]);
                    path = most(path, (q1[i] - q0[i] - h * after[i]).abs() * root_mass[i]);
                }
            }
            Balance::GeneralizedAlpha { .. } | Balance::Exact => {}
        }
        for i in 0..n {
            load[i] += extra[i];
            residual[i] = -h * load[i] - blow[i];
            inertia[i] = after[i] - before[i];
        }
        self.rounding.step((shown, before, after), h, n);
        self.rounding.loads_of((load, load_end, extra, blow), per_h, n);
        self.rounding.book();
        path
    }

    /// Adds the terms of inertia, damping and stiffness to the balance.
    #[inline(always)]
    fn products_of(&mut self, per_h: f64, n: usize) {
        let h = self.h;
        let s = &mut self.scratch;
        self.matrices.product(Part::Mass, 1.0, &s.gained[..n], &mut s.inertia[..n]);
        self.matrices.product(Part::Damping, h, &s.mean_v[..n], &mut s.damper[..n]);
        self.matrices.product(Part::Stiffness, h, &s.mean_q[..n], &mut s.spring[..n]);
        let (inertia, damper, spring) = (&s.inertia[..n], &s.damper[..n], &s.spring[..n]);
        let (load, blow, residual) = (&s.load[..n], &s.blow[..n], &mut s.residual[..n]);
        let per_root_mass = &self.scales.per_root_mass[..n];
        let mut scale = self.balance_scale;
        for i in 0..n {
            residual[i] += inertia[i] + damper[i] + spring[i];
            let moved = most(most(inertia[i].abs(), damper[i].abs()), most(spring[i].abs(), blow[i].abs()));
            scale = most(scale, most(load[i].abs(), moved * per_h) * per_root_mass[i]);
        }
        self.balance_scale = scale;
    }

    /// Computes the displacement that the blows of the step add to that of the rule (`beyond`), and
    /// the step's displacement without it (`arrived`). Returns whether they add any; if not,
    /// `arrived` is not to be read.
    #[inline(never)]
    fn find_beyond(&mut self, step: &Step<'_>) -> bool {
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
        // Work space for the velocity that the blows give.
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
        let by_hole = |(index, _, [push, _]): (usize, _, [[f64; 2]; 2])| {
            let given = self.scene.supports[index].seen(given);
            let rigid = self.scene.supports[index].hole().is_none_or(|hole| hole.law.is_rigid());
            rigid && push[0] * given[0] + push[1] * given[1] < 0.0
        };
        let by_hole = |push| self.contract.promise.hole.is_none() && by_hole(push);
        if answered(&self.scene, self.contract.promise, step.impulse, given) || pushes(&self.scene, step).any(by_hole) {
            // The wall may push only because the damper felt the blow, so both cases are possible:
            // take the one that the displacement fits better.
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

    /// Adds the term −C d to the balance: the impulse of the damper over the displacement d that
    /// the blows add to that of the rule.
    #[inline(never)]
    fn feel_blows(&mut self, step: &Step<'_>, beyond: bool) {
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

    /// Adds C times the displacement `felt` to the residual, unless a wall answered the blows
    /// (`either`) and the residual is smaller without it.
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
