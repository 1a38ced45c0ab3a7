//! The energy ledger: E(t) − E(0) = work of the load − damping − losses at the walls + residual.

mod account;
mod arc;
mod series;
mod walls;
mod work;

pub use account::Energy;
pub(super) use arc::{Along, Instants};
pub(super) use series::Moved;

use super::matrices::{Matrices, Part};
use super::momentum_sums::compensated;
use super::pushes::pushes;
use super::step_motion::StepMotion;
use crate::linear::{pass, running_max};
use crate::scene::{Forcing, Scene, Wall};
use crate::step::{Balance, Contract, QuietSteps, Step};
use pulp::Simd;
use std::sync::Arc;
use work::Work;

#[derive(Debug, Clone)]
pub(super) struct Ledger {
    scene: Arc<Scene>,
    matrices: Matrices,
    contract: Contract,
    pub gap_scale: f64,
    report: Energy,
    /// E after the last step, J.
    energy: f64,
    /// Σ of the magnitudes of all flows, J.
    flowed: f64,
    started: bool,
    /// The energy that each wall stored after the last step, J.
    held: Vec<f64>,
    /// Σ of the steps' residuals, and the rounding error of that sum, so that 1e7 steps can be
    /// checked to rounding.
    residual: f64,
    lost: f64,
    /// The largest rate of the load on the first degree of freedom, N/s.
    steepest: f64,
    /// True if a wall is not rigid.
    springs: bool,
    /// Vectors of length n at least.
    shift: Vec<f64>,
    middle: Vec<f64>,
    /// Work of the loads on each degree of freedom in a step, J, and its size.
    work: Vec<f64>,
    passed: Vec<f64>,
}

/// Energy flows of a step, J.
#[derive(Debug, Clone, Copy, Default)]
struct Flows {
    work: f64,
    /// Σ of the magnitudes of the loads' work; `work` is its signed sum.
    passed: f64,
    damping: f64,
    impact: f64,
    dashpot: f64,
    friction: f64,
}

impl Ledger {
    pub fn new(scene: &Arc<Scene>, contract: Contract, q: &[f64], v: &[f64]) -> Self {
        let touching = |wall: &Wall| {
            let (w, rate) = (wall.coordinate(q), wall.rate(q, v));
            stored(wall, w, wall.law_force(w, rate) != 0.0)
        };
        let held: Vec<f64> = scene.walls.iter().map(touching).collect();
        let walls = held.iter().sum::<f64>();
        let room = || vec![0.0; q.len().max(QuietSteps::capacity())];
        let energy = scene.system.energy(q, v) + walls;
        Self {
            scene: Arc::clone(scene),
            matrices: Matrices::new(&scene.system),
            contract,
            gap_scale: scene.gap_scale(),
            report: Energy { initial_j: energy, largest_j: energy, ..Energy::default() },
            energy,
            flowed: 0.0,
            started: false,
            held,
            residual: 0.0,
            lost: 0.0,
            steepest: Forcing::on(0, &scene.loads).steepest(),
            shift: room(),
            work: room(),
            passed: room(),
            middle: vec![0.0; q.len()],
            springs: scene.walls.iter().any(|wall| !wall.law.is_rigid()),
        }
    }

    /// Adds one step on a grid under the mean load `load` (N); n degrees of freedom. `rates` are
    /// the velocities that enter and leave the balance at the places of walls that push or rub,
    /// m/s.
    #[inline(always)]
    pub fn observe_grid<S: Simd>(
        &mut self,
        simd: S,
        moves: &StepMotion<'_>,
        step: &Step<'_>,
        load: &[f64],
        rates: &[[[f64; 2]; 2]],
        n: usize,
    ) {
        let &StepMotion { h, from: q0, to: q1, .. } = moves;
        if let (Some(b), false) = (self.staggered(), self.started) {
            self.start((h, b), q0, moves.before);
        }
        self.started = true;
        let mut flows = self.flows(simd, moves, load, n);
        let walls = if self.springs || step.impulse.iter().any(|&p| p != 0.0) {
            self.observe_walls(h, (q0, q1), step, &mut flows)
        } else {
            0.0
        };
        if !step.friction.is_empty() {
            self.observe_supports(step, rates, &mut flows);
        }
        let energy = self.after(h, (q0, q1), (moves.after, moves.v), n);
        self.book(energy + walls, flows);
    }

    /// Adds n steps of one degree of freedom in which no wall touches it, after the first step.
    pub fn observe_quiet<S: Simd>(&mut self, simd: S, moves: &StepMotion<'_>, load: &[f64], n: usize) {
        let flows = self.flows(simd, moves, load, n);
        let (q0, q1, after, v) = (&moves.from[..n], &moves.to[..n], &moves.after[..n], &moves.v[..n]);
        let (mut energy, mut largest) = (self.energy, self.report.largest_j);
        for i in 0..n {
            energy = self.after(moves.h, (&q0[i..=i], &q1[i..=i]), (&after[i..=i], &v[i..=i]), 1);
            largest = running_max(largest, energy);
        }
        self.report.largest_j = largest;
        self.book(energy, flows);
    }

    /// Energy of the structure after a step from `q0` to `q1`, with the velocity `after` in its
    /// balance and `v` shown; under a staggered rule that of half a step from `q0`, back where `h`
    /// is negative.
    #[inline(always)]
    fn after(&mut self, h: f64, (q0, q1): (&[f64], &[f64]), (after, v): (&[f64], &[f64]), n: usize) -> f64 {
        match self.staggered() {
            Some(b) => self.half_step((h, b), q0, after, n),
            None => 0.5 * (self.matrices.form(Part::Mass, &v[..n]) + self.matrices.form(Part::Stiffness, &q1[..n])),
        }
    }

    /// True if a wall stored energy after the last step.
    pub fn walls_store(&self) -> bool {
        self.held.iter().any(|&energy| energy != 0.0)
    }

    /// Balance of a staggered rule: the weight b of its displacements.
    fn staggered(&self) -> Option<f64> {
        if let Balance::Staggered(b) = self.contract.balance { Some(b) } else { None }
    }

    /// Work of the loads and dissipation by the structure's damping.
    #[inline(always)]
    fn flows<S: Simd>(&mut self, simd: S, moves: &StepMotion<'_>, load: &[f64], n: usize) -> Flows {
        let &StepMotion { h, per_h, from, to, before, after, blow, .. } = moves;
        let (shift, work, passed) = (&mut self.shift[..n], &mut self.work[..n], &mut self.passed[..n]);
        let terms = ([from, to, before, after, load, blow], [&mut *shift, work, passed]);
        let [] = match self.contract.balance {
            Balance::Staggered(_) => pass(simd, n, terms, &Work { by_rate: Some(h) }),
            _ => pass(simd, n, terms, &Work { by_rate: None }),
        };
        let mut flows = Flows::default();
        // One after another: the ledger closes to the rounding of such a sum.
        for (work, passed) in self.work[..n].iter().zip(&self.passed[..n]) {
            flows.work += work;
            flows.passed += passed;
        }
        flows.damping = self.matrices.form(Part::Damping, &self.shift[..n]) * per_h;
        flows
    }

    /// Sets the energy at the start of a staggered rule: half a step before the first instant.
    #[cold]
    fn start(&mut self, (h, b): (f64, f64), q: &[f64], before: &[f64]) {
        for (wall, held) in self.scene.walls.iter().zip(&mut self.held) {
            let (w, rate) = (wall.row().dot(q), wall.row().dot(before));
            *held = half(wall, w, -h * rate, wall.law_force(w, rate) != 0.0);
        }
        let n = q.len();
        self.energy = self.half_step((-h, b), q, before, n) + self.held.iter().sum::<f64>();
        (self.report.initial_j, self.report.largest_j) = (self.energy, self.energy);
    }

    /// Adds to load work and damping, J, the part of the blows' work that the dampers take:
    /// [`Ledger::observe_grid`] is given the blows without it.
    pub fn damp(&mut self, lost: f64) {
        self.report.load_work_j += lost;
        self.report.damping_j += lost;
        self.flowed += lost.abs();
    }

    /// Adds to load work and to the losses at walls, J, that the blows of a step, which alone give
    /// the velocity `struck` (m/s), and the impulses of walls act one after the other: of both
    /// [`Ledger::observe_grid`] takes the work at the mean velocity of the step. What acts first
    /// does not feel the other: half of impulse times `struck` is work of the blow that the wall
    /// takes, or the other way round.
    #[cold]
    pub fn answer(&mut self, step: &Step<'_>, struck: &[f64]) {
        let rigid = |index: usize| self.scene.walls[index].law.is_rigid();
        let (mut impact, mut friction) = (0.0, 0.0);
        for (index, (wall, p)) in self.scene.walls.iter().zip(step.impulse).enumerate() {
            if rigid(index) && *p != 0.0 && !wall.is_round() {
                impact += 0.5 * (p * wall.row().dot(struck)).abs();
            }
        }
        for (index, at, [push, rub]) in pushes(&self.scene, step) {
            let given = [at.y.dot(struck), at.z.dot(struck)];
            let work = |force: [f64; 2]| 0.5 * (force[0] * given[0] + force[1] * given[1]).abs();
            impact += if rigid(index) { work(push) } else { 0.0 };
            friction += work(rub);
        }
        self.report.load_work_j += impact + friction;
        self.report.impact_loss_j += impact;
        self.report.friction_j += friction;
    }

    /// Adds the work of the blows of the last step beyond its rule: they work at their own
    /// instants, where the velocity is not the mean of the step's ends, and the difference is the
    /// work of the forces that depend on the displacement over the displacement that the blows add.
    pub fn displace(&mut self, h: f64, step: &Step<'_>) {
        let after = step.velocity_after;
        let staggered = self.staggered();
        let mut energy = self.after(-h, (step.q, step.q), (after, step.v), step.q.len());
        for (wall, held) in self.scene.walls.iter().zip(&mut self.held) {
            let (w, touching) = (wall.coordinate(step.q), *held != 0.0);
            *held = match staggered {
                Some(_) => half(wall, w, -h * wall.row().dot(after), touching),
                None => stored(wall, w, touching),
            };
            energy += *held;
        }
        let work = energy - self.energy;
        self.book(energy, Flows { work, passed: work.abs(), ..Flows::default() });
    }

    /// Energy half a step from `q`, on the way to q + h v, without the walls: ½vᵀMv + ½[x̄ᵀKx̄ −
    /// (1−4b)(½hv)ᵀK(½hv)] with x̄ = q + ½hv, which the staggered balance conserves. A negative `h`
    /// looks back.
    #[inline(always)]
    fn half_step(&mut self, (h, b): (f64, f64), q: &[f64], v: &[f64], n: usize) -> f64 {
        let (q, v) = (&q[..n], &v[..n]);
        let (shift, middle) = (&mut self.shift[..n], &mut self.middle[..n]);
        for i in 0..n {
            shift[i] = 0.5 * h * v[i];
            middle[i] = q[i] + shift[i];
        }
        let mut strain = self.matrices.form(Part::Stiffness, middle);
        let beside = 1.0 - 4.0 * b;
        if beside != 0.0 {
            strain -= beside * self.matrices.form(Part::Stiffness, shift);
        }
        0.5 * (self.matrices.form(Part::Mass, v) + strain)
    }

    #[inline(always)]
    fn book(&mut self, energy: f64, flows: Flows) {
        let Flows { work, passed, damping, impact, dashpot, friction } = flows;
        let residual = (energy - self.energy) - work + damping + impact + dashpot + friction;
        [self.residual, self.lost] = compensated([self.residual, self.lost], residual);
        self.energy = energy;
        let r = &mut self.report;
        r.largest_j = r.largest_j.max(energy);
        r.load_work_j += work;
        r.damping_j += damping;
        r.impact_loss_j += impact;
        r.wall_damping_j += dashpot;
        r.friction_j += friction;
        self.flowed += passed + damping.abs() + impact.abs() + dashpot.abs() + friction.abs();
    }

    pub fn report(&self) -> Energy {
        let exchanged = self.report.largest_j.max(self.report.initial_j) + self.flowed;
        let residual = if self.residual == 0.0 { 0.0 } else { self.residual.abs() / exchanged };
        Energy { final_j: self.energy, residual_j: self.residual, exchanged_j: exchanged, residual, ..self.report }
    }
}

/// Energy stored in a wall at displacement `w`, J; 0 for a damped wall that does not touch the
/// body.
pub(super) fn stored(wall: &Wall, w: f64, touching: bool) -> f64 {
    if wall.law.is_damped() && !touching { 0.0 } else { wall.law.energy(-wall.gap(w)) }
}

/// Energy stored half a step on the way from `w` to `w + shift`: the mean of both ends.
fn half(wall: &Wall, w: f64, shift: f64, touching: bool) -> f64 {
    0.5 * (stored(wall, w, touching) + stored(wall, w + shift, touching))
}

#[cfg(test)]
mod tests;
