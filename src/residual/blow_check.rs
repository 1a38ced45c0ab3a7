//! Checks of steps on a grid with blows.

use super::Judge;
use super::blows::divide;
use super::pushes::pushes;
use crate::scene::{PlaneRows, Scene, Wall};
use crate::step::{Balance, Bound, Path, Promise, Step};

/// True if the blows, which give the velocity `given`, drive the body into a rigid wall that pushes
/// in this step, under a promise by which blow and answer take effect together. Under a bound on
/// the displacement at the step's end they do not, since that bound includes the displacement by
/// the blows.
fn answered(scene: &Scene, promise: Promise, impulse: &[f64], given: &[f64]) -> bool {
    let drives =
        |(wall, &p): (&Wall, &f64)| wall.law.is_rigid() && p != 0.0 && wall.side().sign() * wall.row().dot(given) < 0.0;
    promise.rigid.displacement != Some(Bound::End) && scene.walls.iter().zip(impulse).any(drives)
}

impl Judge {
    /// Sets the blows of a step. Exact motion has them at the ends of its steps: the momentum of
    /// one strictly inside is open.
    pub(super) fn take_blows(&mut self, step: &Step<'_>) {
        let struck = match (step.path, self.contract.balance) {
            (Path::Exact(_) | Path::Series(_) | Path::Part { .. }, _) => {
                let last = step.end.next_down().max(step.start);
                if self.loads.blow(step.start, last, &mut self.blows.impulse) {
                    self.miss_blow(step);
                }
                self.loads.blow(last, step.end, &mut self.blows.impulse)
            }
            (_, Balance::Staggered(_)) => self.loads.blow_about(step.index, self.h, &mut self.blows.impulse),
            _ => self.loads.blow(step.start, step.end, &mut self.blows.impulse),
        };
        self.blows.struck.copy_from_slice(&self.blows.impulse);
        if struck {
            divide(&self.scene, self.mass.as_mut(), &mut self.blows.struck);
        }
    }

    /// Counts blows that no step took as open momentum, by the force that gives it over the step.
    #[cold]
    fn miss_blow(&mut self, step: &Step<'_>) {
        let span = step.end - step.start;
        for (impulse, weight) in self.blows.impulse.iter().zip(&self.weights.root_mass) {
            let force = impulse.abs() / span;
            self.balance.raise_largest(force);
            self.balance.force.observe(force / weight, 0.0, step.end, None);
        }
    }

    /// Computes the displacement that the blows of the step add to that of the rule (`beyond`), and
    /// the step's displacement without it (`arrived`). Returns whether they add any; if not,
    /// `arrived` is not to be read.
    #[inline(never)]
    pub(super) fn find_beyond(&mut self, step: &Step<'_>) -> bool {
        let s = &mut self.blows;
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
        let given = &mut self.scratch.mean_v;
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
        let by_hole = |(index, at, [push, _]): (usize, &PlaneRows, [[f64; 2]; 2])| {
            let given = at.dot(given);
            let rigid = self.scene.walls[index].law.is_rigid();
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
                    *apart += ((moved - by) * self.weights.root_mass[i]).powi(2);
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
    pub(super) fn feel_blows(&mut self, step: &Step<'_>, beyond: bool) {
        let s = &mut self.blows;
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
            && answered(&self.scene, self.contract.promise, step.impulse, &self.blows.struck);
        self.sums.whole &= !either;
        self.take_felt(either, step);
    }

    /// Adds C times the displacement `felt` to the residual, unless a wall answered the blows
    /// (`either`) and the residual is smaller without it.
    pub(super) fn take_felt(&mut self, either: bool, step: &Step<'_>) {
        let s = &mut self.scratch;
        let felt = &mut s.mean_v;
        felt.fill(0.0);
        self.scene.system.add_damping(1.0, &self.blows.felt, felt);
        let left = |share: f64| -> f64 {
            let terms = s.residual.iter().zip(&*felt).zip(&self.weights.root_mass);
            terms.map(|((r, felt), weight)| ((r + share * felt) / weight).powi(2)).sum()
        };
        if either && left(0.0) <= left(1.0) {
            return;
        }
        let mut lost = 0.0;
        for (i, &felt) in felt.iter().enumerate() {
            s.residual[i] += felt;
            self.blows.impulse[i] -= felt;
            lost += 0.5 * felt * (step.velocity_before[i] + step.velocity_after[i]);
            self.balance.raise_scale(felt.abs() / (self.h * self.weights.root_mass[i]));
        }
        self.energy.damp(lost);
    }
}
