//! The energy ledger of the exact motion of one degree of freedom: powers integrated along an arc,
//! and the jump at its end.

use super::{Flows, Ledger};
use crate::flow::Arc;
use crate::linear::running_max;
use crate::scene::{Scene, System};
use crate::step::Step;

/// Rounding error of the momenta at the ends of an arc, in units in the last place of the run's
/// largest momentum.
const MOMENTUM_UNITS: f64 = 2.0;

/// Rounding error of the instants of an arc, in units in the last place: of the arc's own time and
/// of the load's.
const CLOCK_UNITS: f64 = 2.0;

/// Maximum number of instants of a panel.
const MOST: usize = 16;

/// The instants of a panel of an arc: times (s), weights in integrals over the arc (s),
/// displacements (m), velocities (m/s) and loads (N); then net force (N) and energy (J).
#[derive(Debug, Default)]
pub(in super::super) struct Instants {
    pub count: usize,
    pub t: [f64; MOST],
    pub weight: [f64; MOST],
    pub q: [f64; MOST],
    pub v: [f64; MOST],
    pub load: [f64; MOST],
    force: [f64; MOST],
    energy: [f64; MOST],
}

impl Instants {
    /// Those of a panel, with their times and weights.
    pub fn of(nodes: impl Iterator<Item = (f64, f64)>) -> Self {
        let mut instants = Self::default();
        for (t, weight) in nodes.take(MOST) {
            let at = instants.count;
            (instants.t[at], instants.weight[at], instants.count) = (t, weight, at + 1);
        }
        instants
    }

    /// Adds a wall that pushes with `r` (N) and stores `stored` (J) at instant `k`.
    pub fn add_wall(&mut self, k: usize, r: f64, stored: f64) {
        self.force[k] += r;
        self.energy[k] += stored;
    }
}

/// Integrals along an arc.
#[derive(Debug, Default)]
pub(in super::super) struct Along {
    flows: Flows,
    /// ∫ of the net force, N s.
    net: f64,
    /// The largest force on the body other than the walls' and the spring's, N.
    pub largest_force: f64,
    /// The same of the current panel, which is summed separately to reduce rounding.
    part: Flows,
}

impl Along {
    /// Adds the work done on a damped wall, J.
    pub fn add_damped(&mut self, work: f64) {
        self.part.dashpot += work;
    }

    /// Ends a panel, with the forces and energies at its instants. Returns the largest energy, J.
    pub fn end_panel(&mut self, at: &Instants) -> f64 {
        let (weight, force) = (&at.weight[..at.count], &at.force[..at.count]);
        self.net += weight.iter().zip(force).map(|(weight, force)| weight * force).sum::<f64>();
        let part = std::mem::take(&mut self.part);
        self.flows.work += part.work;
        self.flows.passed += part.passed;
        self.flows.damping += part.damping;
        self.flows.dashpot += part.dashpot;
        at.energy[..at.count].iter().fold(0.0, |largest, &energy| running_max(largest, energy))
    }
}

impl Ledger {
    /// Starts a panel with the body and its load; returns the largest of their forces so far, N.
    pub fn sample(&self, at: &mut Instants, along: &mut Along) -> f64 {
        let [m, c, k] = numbers(&self.scene);
        let n = at.count;
        let (weight, q, v, load) = (&at.weight[..n], &at.q[..n], &at.v[..n], &at.load[..n]);
        let (force, energy) = (&mut at.force[..n], &mut at.energy[..n]);
        let Flows { mut work, mut passed, mut damping, .. } = along.part;
        let mut largest = along.largest_force;
        for i in 0..n {
            let (rub, power) = (c * v[i], load[i] * v[i]);
            force[i] = load[i] - rub - k * q[i];
            energy[i] = 0.5 * (m * v[i] * v[i] + k * q[i] * q[i]);
            work += weight[i] * power;
            passed += weight[i] * power.abs();
            damping += weight[i] * rub * v[i];
            largest = running_max(largest, running_max(load[i].abs(), rub.abs()));
        }
        along.part = Flows { work, passed, damping, ..along.part };
        along.largest_force = largest;
        largest
    }

    /// Updates the largest energy of the run, J.
    pub fn reach(&mut self, energy: f64) {
        self.report.largest_j = self.report.largest_j.max(energy);
    }

    /// Adds one exact arc and the jump at its end. Returns the residual of its momentum balance
    /// beyond rounding, N s, ≥ 0.
    ///
    /// A damped wall dissipates the work done on it, ∫|r|ṡ, minus the change of what it stores. So
    /// the result does not depend on the moment at which contact begins or ends, which at a shared
    /// face is decided by rounding. The wall stores energy only while it touches; what it stores
    /// when contact ends counts as dissipated, since spring and dashpot then relax against each
    /// other.
    pub fn observe_arc(&mut self, step: &Step<'_>, arc: &Arc, blow: &[f64], along: &Along) -> f64 {
        let [mass, _, stiffness] = numbers(&self.scene);
        let mut flows = along.flows;
        let mut open = 0.0;
        let v_end = if step.end > step.start { arc.state(step.end).1 } else { first(step.velocity_before) };
        if step.end > step.start {
            let v_start = first(step.velocity_before);
            // Over an arc of some ulps of the time, the rounding error of the momentum would count
            // as a force.
            let speed = (2.0 * self.report.largest_j / mass).sqrt().max(v_start.abs()).max(v_end.abs());
            // The instants, and with them the phase of a load, are known only to an ulp of the
            // time.
            let late = self.steepest * step.end * (step.end - step.start);
            let rounding = f64::EPSILON * (MOMENTUM_UNITS * mass * speed + CLOCK_UNITS * late);
            open = ((mass * (v_end - v_start) - along.net).abs() - rounding).max(0.0);
        }
        let mid = v_end + first(blow) / mass;
        let struck = 0.5 * first(blow) * (v_end + mid);
        flows.work += struck;
        flows.passed += struck.abs();
        for jump in step.jump.iter().filter(|jump| **jump != 0.0) {
            flows.impact -= 0.5 * jump * (mid + first(step.v));
        }
        let walls = self.store(step, &mut flows);
        let (q, v) = (first(step.q), first(step.v));
        let energy = |v: f64| 0.5 * (mass * v * v + stiffness * q * q) + walls;
        // A body is fastest as it strikes.
        self.reach(energy(v_end.abs().max(mid.abs())));
        self.book(energy(v), flows);
        open
    }
}

/// m, c and k of a body of one degree of freedom.
fn numbers(scene: &Scene) -> [f64; 3] {
    match &scene.system {
        System::Oscillator(o) => [o.mass, o.damping, o.stiffness],
        system => [
            system.mass_form(&[1.0], &[1.0]),
            system.damping_form(&[1.0], &[1.0]),
            system.stiffness_form(&[1.0], &[1.0]),
        ],
    }
}

fn first(x: &[f64]) -> f64 {
    x.first().copied().unwrap_or(0.0)
}
