//! Newton's method on the multipliers μ of the disks in play.
//!
//! For given μ, and with the strips in play on their bounds, the programme is linear: with D =
//! diag(√μ) over the rows of the disks and ρ = −D z, so that their multipliers are Dρ,
//!
//! (I + D W D) ρ + D W_r r = −D z_free,   W_rD ρ + W_rr r = bound − y_free.
//!
//! By dμ_t z changes by −B z_t dμ_t, B = (I + W D²)⁻¹W with the strips held, which the same matrix
//! gives. So Newton's step on all 1/|z_s| = 1/γ_s is
//!
//! N Δμ = |z|²(|z|/γ − 1),   N_st = z_s·B_st z_t.

use super::semidefinite::Semidefinite;
use super::system::{ACCEPTED, State, System, form};
use super::{DiskBound, dot, norm};
use crate::qp::NOISE;

/// Most steps of one attempt.
const MOST_STEPS: usize = 16;

/// After this many steps an answer is taken if it is acceptable, although it may become better.
const PATIENCE: usize = 6;

/// A row of the linear system: a row of a disk, or a strip.
#[derive(Debug, Clone, Copy)]
struct Unknown {
    block: usize,
    along: [f64; 2],
    /// √μ of a disk, 1 of a strip.
    weight: f64,
    /// True of a disk.
    bends: bool,
}

/// The work space of the method.
#[derive(Debug, Default)]
pub(super) struct Newton {
    unknowns: Vec<Unknown>,
    linear: Semidefinite,
    /// ρ of the disks and r of the strips.
    found: Vec<f64>,
    /// The disks in play; z, and for one dμ_t the change of the unknowns.
    disks: Vec<usize>,
    z: Vec<[f64; 2]>,
    change: Vec<f64>,
    bend: Semidefinite,
    step: Vec<f64>,
    /// Steps taken so far.
    pub steps: u64,
}

impl Newton {
    /// Settles a programme from the states and μ that it has. Returns whether it did.
    pub fn settle(&mut self, system: &mut System) -> bool {
        let mut last = f64::INFINITY;
        for step in 0..MOST_STEPS {
            self.steps += 1;
            self.hold(system);
            let miss = system.miss();
            if !miss.distance.is_finite() {
                return false;
            }
            let held = self.release_blocks(system) | enter(system);
            if !held {
                let stalls = miss.distance >= 0.5 * last || step >= PATIENCE;
                if miss.is_rounded() || (stalls && miss.distance <= ACCEPTED) {
                    return true;
                }
                last = miss.distance;
                if !self.climb(system) {
                    last = f64::INFINITY;
                }
            } else {
                last = f64::INFINITY;
            }
        }
        false
    }

    /// Solves for the multipliers with the μ and strips in play as they are.
    fn hold(&mut self, system: &mut System) {
        self.unknowns.clear();
        self.disks.clear();
        self.found.clear();
        for block in 0..system.blocks.len() {
            let (first, rows) = system.blocks[block];
            match (system.states[block], system.bounds[block]) {
                (State::Circle, DiskBound::Disk { centre, .. }) => {
                    self.disks.push(block);
                    let weight = system.mu[block].sqrt();
                    for (k, along) in [[1.0, 0.0], [0.0, 1.0]].into_iter().enumerate().take(rows) {
                        self.unknowns.push(Unknown { block, along, weight, bends: true });
                        self.found.push(-weight * (system.free[first + k] - centre[k]));
                    }
                }
                (state @ (State::Low | State::High), DiskBound::Strip { normal, lo, hi }) => {
                    self.unknowns.push(Unknown { block, along: normal, weight: 1.0, bends: false });
                    let free = [system.free[first], if rows == 2 { system.free[first + 1] } else { 0.0 }];
                    self.found.push(if state == State::Low { lo } else { hi } - dot(normal, free));
                }
                _ => system.set_push(block, [0.0; 2]),
            }
        }
        let count = self.unknowns.len();
        self.linear.begin(count);
        for (k, of) in self.unknowns.iter().enumerate() {
            for (l, by) in self.unknowns.iter().enumerate().take(k + 1) {
                let mut entry = of.weight * by.weight * form(system.between(of.block, by.block), of.along, by.along);
                if k == l && of.bends {
                    entry += 1.0;
                }
                self.linear.entries[k * count + l] = entry;
                self.linear.entries[l * count + k] = entry;
            }
        }
        self.linear.factor();
        self.linear.solve(&mut self.found);
        for (k, unknown) in self.unknowns.iter().enumerate() {
            let push = self.found[k] * unknown.weight;
            // The second row of a disk comes after its first.
            let before =
                if unknown.along == [0.0, 1.0] && unknown.bends { system.push(unknown.block) } else { [0.0; 2] };
            system.set_push(unknown.block, [0, 1].map(|i: usize| before[i] + push * unknown.along[i]));
        }
        system.renew();
    }

    /// Frees the strips that would pull, and returns whether there were any.
    fn release_blocks(&self, system: &mut System) -> bool {
        let mut freed = false;
        for (unknown, &push) in self.unknowns.iter().zip(&self.found).filter(|(unknown, _)| !unknown.bends) {
            let Unknown { block, along, .. } = *unknown;
            let towards = if system.states[block] == State::Low { push } else { -push };
            if towards < 0.0 {
                let moves = -towards * form(system.between(block, block), along, along);
                system.states[block] = State::Free;
                system.set_push(block, [0.0; 2]);
                freed |= moves > NOISE * system.size(block);
            }
        }
        freed
    }

    /// One step on the μ in play. Returns false if a disk left play.
    fn climb(&mut self, system: &mut System) -> bool {
        let (count, disks) = (self.unknowns.len(), self.disks.len());
        self.z.clear();
        self.z.extend(self.unknowns.iter().zip(&self.found).map(|(unknown, &rho)| {
            let z = if unknown.bends { -rho / unknown.weight } else { 0.0 };
            unknown.along.map(|along| along * z)
        }));
        self.bend.begin(disks);
        self.step.clear();
        for (t, &disk) in self.disks.iter().enumerate() {
            self.change.clear();
            for of in &self.unknowns {
                let moved = self.unknowns.iter().zip(&self.z).filter(|(by, _)| by.block == disk);
                let entry: f64 = moved.map(|(_, z)| form(system.between(of.block, disk), of.along, *z)).sum();
                self.change.push(of.weight * entry);
            }
            self.linear.solve(&mut self.change);
            for (s, &other) in self.disks.iter().enumerate() {
                let own = (0..count).filter(|&k| self.unknowns[k].block == other);
                let entry: f64 = own
                    .map(|k| dot(self.z[k], self.unknowns[k].along) * self.change[k] / self.unknowns[k].weight)
                    .sum();
                self.bend.entries[s * disks + t] = entry;
            }
            let own = self.unknowns.iter().zip(&self.z).filter(|(unknown, _)| unknown.block == disk);
            let size = own.map(|(_, z)| *z).fold([0.0; 2], |sum, z| [sum[0] + z[0], sum[1] + z[1]]);
            let (size, radius) = (norm(size), radius(system.bounds[disk]));
            self.step.push(size * size * (size / radius - 1.0));
        }
        for s in 0..disks {
            for t in 0..s {
                let mean = 0.5 * (self.bend.entries[s * disks + t] + self.bend.entries[t * disks + s]);
                self.bend.entries[s * disks + t] = mean;
                self.bend.entries[t * disks + s] = mean;
            }
        }
        self.bend.factor();
        self.bend.solve(&mut self.step);
        let mut all = true;
        for (&disk, change) in self.disks.iter().zip(&self.step) {
            let mu = system.mu[disk] + change;
            if mu > 0.0 {
                system.mu[disk] = mu;
            } else {
                (system.mu[disk], system.states[disk]) = (0.0, State::Free);
                system.set_push(disk, [0.0; 2]);
                all = false;
            }
        }
        all
    }
}

/// Brings the free blocks that are passed into play, and returns whether there were any.
fn enter(system: &mut System) -> bool {
    let mut entered = false;
    for block in 0..system.blocks.len() {
        if system.is_passed(block) {
            system.answer(block);
            entered = true;
        }
    }
    entered
}

fn radius(bound: DiskBound) -> f64 {
    match bound {
        DiskBound::Disk { radius, .. } => radius,
        DiskBound::Strip { .. } => f64::INFINITY,
    }
}

#[cfg(test)]
mod tests;
