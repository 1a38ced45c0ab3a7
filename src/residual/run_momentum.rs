//! Check of the momentum of the whole run: the walls' impulses must account for it, whatever
//! balance a scheme fulfils in each step:
//!
//! M(v_T − v_0) = ∫(f − C v − K q) dt + Σ J + Gᵀ Σ p
//!
//! from the states at the ends of the steps and the recorded impulses. The integral is taken by the
//! trapezoid rule over these ends. A scheme weights the same forces otherwise, or takes them at an
//! instant within the step: the two sums differ by at most one step's change of the force per step,
//! and by one step's force at either end of the run. What is open beyond that is momentum without a
//! wall's impulse. Changes of loads and of the structure's forces are summed separately: where the
//! two nearly balance, as under heavy damping, their sum changes little while each may change much.
//! A blow changes the force of the dampers within a step, by C M⁻¹ J.

use super::Judge;
use super::largest_residual::LargestResidual;
use super::momentum_sums::Forces;
use super::pushes::place_of;
use super::step_motion::StepMotion;
use crate::step::{Balance, Path, Step};
use pulp::Simd;

/// The weights of a scheme differ from those of the trapezoid rule by at most this many steps in
/// all.
const STEPS: f64 = 2.0;

impl Judge {
    /// Takes the recorder's sum of each wall's impulses over the whole run, N s, in the scene's
    /// order: [`Judge::findings`] then checks the run with these in place of the sums over the
    /// steps seen. A list with another number of walls is ignored.
    pub fn hear(&mut self, impulses: &[f64]) {
        if impulses.len() == self.sums.seen.len() {
            self.sums.recorded = Some(impulses.to_vec());
        }
    }

    /// As [`Judge::hear`], for the sums of each round support's impulses along y and z, N s: normal
    /// and friction together, in the order of the scene's round supports.
    pub fn hear_holes(&mut self, impulses: &[[f64; 2]]) {
        let holes = self.scene.holes().count();
        if let Some(supports) = self.supports.as_mut().filter(|_| holes == impulses.len()) {
            supports.recorded = Some(impulses.to_vec());
        }
    }

    /// The impulse of each wall over the run along y and z, without the normal ones of flats, with
    /// the recorder's sums where they are known, and the sum of the magnitudes, N s.
    fn planar(&self) -> Vec<([f64; 2], f64)> {
        let Some(supports) = &self.supports else { return Vec::new() };
        let mut all: Vec<_> = supports.impulse.iter().copied().zip(supports.size.iter().copied()).collect();
        for (hole, told) in self.scene.holes().zip(supports.recorded.iter().flatten()) {
            all[hole.index].0 = *told;
        }
        all
    }

    /// Adds a step, whose mean forces are in `scratch`; `self.q` still holds its state at the
    /// start.
    #[inline(always)]
    pub(super) fn sum<S: Simd>(&mut self, simd: S, step: &Step<'_>, per_h: f64, n: usize) {
        let sums = &mut self.sums;
        sums.begin(step);
        sums.steps += 1;
        for ((seen, size), &p) in sums.seen.iter_mut().zip(&mut sums.sizes).zip(step.impulse) {
            if p != 0.0 {
                *seen += p;
                *size += p.abs();
            }
        }
        sums.whole &= matches!(step.path, Path::Grid | Path::OneRestitution | Path::Part { .. });
        if !sums.whole {
            return;
        }
        let (h, first) = (self.h, sums.steps == 1);
        let loads = (&self.load[..], &self.load_end[..]);
        let moves = StepMotion::of(step, (h, per_h), (&self.q, step.q), loads, &self.blows.impulse);
        if let Some(previous) = &self.previous {
            // For generalized-α, the force at the end of the step, which includes dampers and the
            // walls that are springs.
            sums.add_way(h, step.velocity_after);
            for i in 0..n {
                let load = self.load_end[i];
                let mut forces = sums.forces.of(i);
                let force = previous.force[i] + step.extra[i];
                forces.add(first, h, [load, force - load, 0.0]);
                sums.forces.set(i, forces);
            }
            sums.add_ends(simd, &moves, n);
            // The dampers' force rises at a blow, and may have fallen again at the end of the step.
            if self.loads.has_blows() && self.blows.struck.iter().any(|&v| v != 0.0) {
                let mut risen = vec![0.0; n];
                self.scene.system.add_damping(1.0, &self.blows.struck, &mut risen);
                sums.forces.changes.iter_mut().zip(risen).for_each(|(changes, force)| *changes += force.abs());
            }
        } else {
            sums.add(simd, &moves, &self.scratch, first, n);
        }
    }

    /// The largest residual of the run's momentum, minus what a step's rule may miss and minus
    /// rounding, over the largest momentum exchanged.
    pub(super) fn open_momentum(&self) -> LargestResidual {
        let sums = &self.sums;
        let impulses = sums.recorded.as_ref().unwrap_or(&sums.seen);
        let mut worst = self.unrecorded(impulses);
        if !sums.whole || sums.steps == 0 || self.contract.balance == Balance::Exact {
            return worst;
        }
        let n = sums.last.len();
        let mut open: Vec<f64> = sums.load.iter().map(|load| -load).collect();
        let gained: Vec<f64> = sums.last.iter().zip(&sums.first).map(|(last, first)| last - first).collect();
        let system = &self.scene.system;
        system.add_mass(1.0, &gained, &mut open);
        let way: Vec<f64> = match self.contract.balance {
            Balance::GeneralizedAlpha { .. } => sums.rate.clone(),
            _ => self.q.iter().zip(&sums.start).map(|(q, start)| q - start).collect(),
        };
        system.add_damping(1.0, &way, &mut open);
        system.add_stiffness(1.0, &sums.place, &mut open);
        let mut blows = vec![0.0; n];
        // The last step of a staggered rule contains the blows up to its middle.
        let until = match self.contract.balance {
            Balance::Staggered(_) => (sums.steps as f64 - 0.5).mul_add(self.h, sums.from),
            _ => self.noise.end,
        };
        self.loads.blow(sums.from, until, &mut blows);
        let mut exchanged: Vec<f64> = sums.forces.exchanged.clone();
        let mut ends = self.end_forces();
        for (wall, (p, size)) in self.scene.walls.iter().zip(impulses.iter().zip(&sums.sizes)) {
            for &(i, weight) in wall.row().entries() {
                open[i] -= weight * p;
                exchanged[i] += weight.abs() * size;
                // A wall that is a spring also pushes over the last half step, and its force is not
                // among the loads.
                if !wall.law.is_rigid() {
                    let last = wall.law_force(wall.row().dot(&self.q), wall.row().dot(&sums.last));
                    ends[i] += weight.abs() * self.walls.force_scale.max(last.abs());
                }
            }
        }
        for (index, ([y, z], size)) in self.planar().into_iter().enumerate() {
            let Some(at) = place_of(&self.scene, index) else { continue };
            for (row, push) in [(&at.y, y), (&at.z, z)] {
                for &(i, weight) in row.entries() {
                    open[i] -= weight * push;
                    exchanged[i] += weight.abs() * size;
                }
            }
        }
        let rounding = sums.steps as f64 * self.h * self.noise.force_over(self.h);
        let roots = &self.weights.root_mass;
        let largest = exchanged.iter().zip(roots).map(|(x, root)| x / root).fold(0.0, f64::max);
        for i in 0..n {
            let missed = STEPS * self.h * (sums.forces.changes[i] + ends[i]);
            let left = (open[i] - blows[i]).abs() - missed;
            worst.observe(over(left / roots[i] - rounding, largest), self.noise.end, None);
        }
        worst
    }

    /// The largest difference between the sums of impulses over the steps seen and those of the
    /// recorder, of which `impulses` are those of the walls, over their size.
    fn unrecorded(&self, impulses: &[f64]) -> LargestResidual {
        let sums = &self.sums;
        let mut worst = LargestResidual::default();
        // A motion that decays without end leaves denormal impulses, whose last place is a share of
        // them.
        let rounding = |size: f64| (sums.steps as f64 * f64::EPSILON * size).max(f64::MIN_POSITIVE);
        for (wall, ((p, seen), size)) in impulses.iter().zip(&sums.seen).zip(&sums.sizes).enumerate() {
            worst.observe(over((p - seen).abs() - rounding(*size), *size), self.noise.end, Some(wall));
        }
        if let Some(supports) = &self.supports {
            for (hole, told) in self.scene.holes().zip(supports.recorded.iter().flatten()) {
                let ([y, z], size) = (supports.impulse[hole.index], supports.size[hole.index]);
                let apart = (told[0] - y).hypot(told[1] - z) - rounding(size);
                worst.observe(over(apart, size), self.noise.end, Some(hole.index));
            }
        }
        worst
    }

    /// The sizes of the forces on each degree of freedom at both ends of the run, N, which no
    /// step's mean contains: a staggered rule starts half a step before.
    fn end_forces(&self) -> Vec<f64> {
        let (sums, system) = (&self.sums, &self.scene.system);
        let mut begin = vec![0.0; sums.last.len()];
        self.loads.add_force(sums.from, 1.0, &mut begin);
        system.add_damping(-1.0, &sums.first, &mut begin);
        system.add_stiffness(-1.0, &sums.start, &mut begin);
        let mut end = self.load.clone();
        system.add_damping(-1.0, &sums.last, &mut end);
        system.add_stiffness(-1.0, &self.q, &mut end);
        let mut ends: Vec<f64> =
            sums.forces.largest.iter().zip(&end).map(|(largest, end)| largest.max(end.abs())).collect();
        for (i, size) in ends.iter_mut().enumerate() {
            let Forces { load, own, .. } = sums.forces.of(i);
            *size += begin[i].abs() + (self.load[i] - load).abs() + (end[i] - self.load[i] - own).abs();
        }
        ends
    }
}

fn over(x: f64, scale: f64) -> f64 {
    if x <= 0.0 { 0.0 } else { x / scale }
}
