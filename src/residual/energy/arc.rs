//! The ledger of exact motion: powers integrated along an arc, and what happens in the instant that ends it.

use super::{Flows, Ledger, stored};
use crate::flow::Arc;
use crate::scene::{Scene, System, WallLaw};
use crate::step::Step;

/// Units in the last place of the run's largest momentum by which those at the ends of an arc are not known.
const MOMENTUM_UNITS: f64 = 2.0;

/// Units in the last place by which the instants of an arc are not known: of the arc's own clock and of the load's.
const CLOCK_UNITS: f64 = 2.0;

/// An instant of an arc: displacement (m), velocity (m/s), load (N), and its weight in integrals over the arc, s.
#[derive(Debug, Clone, Copy)]
pub(in super::super) struct Instant {
    pub t: f64,
    pub weight: f64,
    pub q: f64,
    pub v: f64,
    pub load: f64,
}

/// What an arc sums up to.
#[derive(Debug, Default)]
pub(in super::super) struct Along {
    flows: Flows,
    /// ∫ of the net force, N s.
    net: f64,
    /// The largest force of the body's own, N.
    pub largest_force: f64,
    /// The same of the panel under way, whose sums are added up apart: so many terms round less.
    part: Flows,
    part_net: f64,
    /// Net force (N) and energy (J) at the instant under way.
    forces: f64,
    energy: f64,
}

impl Along {
    /// Adds a wall that pushes with `r` (N) and stores `stored` (J) at an instant.
    pub fn add_wall(&mut self, at: Instant, r: f64, stored: f64, damped: bool) {
        self.forces += r;
        self.energy += stored;
        if damped {
            self.part.dashpot -= at.weight * r * at.v;
        }
    }

    /// Ends an instant; returns the energy there, J.
    pub fn end_instant(&mut self, weight: f64) -> f64 {
        self.part_net += weight * self.forces;
        self.energy
    }

    /// Ends a panel.
    pub fn end_panel(&mut self) {
        let part = std::mem::take(&mut self.part);
        self.flows.work += part.work;
        self.flows.passed += part.passed;
        self.flows.damping += part.damping;
        self.flows.dashpot += part.dashpot;
        self.net += std::mem::take(&mut self.part_net);
    }
}

impl Ledger {
    /// The body and its load at an instant of an arc; returns the largest of its own forces, N.
    pub fn look(&self, scene: &Scene, at: Instant, along: &mut Along) -> f64 {
        let [m, c, k] = numbers(scene);
        let Instant { weight, q, v, load, .. } = at;
        let (spring, rub) = (k * q, c * v);
        along.forces = load - rub - spring;
        along.energy = 0.5 * (m * v * v + k * q * q);
        along.part.work += weight * load * v;
        along.part.passed += weight * (load * v).abs();
        along.part.damping += weight * c * v * v;
        along.largest_force = along.largest_force.max(load.abs()).max(rub.abs());
        along.largest_force
    }

    /// Takes in an energy on the way, J.
    pub fn reach(&mut self, energy: f64) {
        self.report.largest_j = self.report.largest_j.max(energy);
    }

    /// One exact arc and the instant at its end. Returns what its momentum balance leaves open beyond rounding, N s, ≥ 0.
    ///
    /// What a damped wall takes is the work done on it, ∫|r|ṡ, less what it stores: so nothing hangs on the moment at which it lets go or
    /// takes hold, which at a shared face is one of rounding. It stores only while it touches; what it holds when it lets go stays with it,
    /// since spring and dashpot then relax against each other.
    pub fn see_arc(&mut self, scene: &Scene, step: &Step<'_>, arc: &Arc, blow: &[f64], along: &Along) -> f64 {
        let [mass, _, stiffness] = numbers(scene);
        let mut flows = along.flows;
        let mut open = 0.0;
        let v_end = if step.end > step.start { arc.state(step.end).1 } else { first(step.velocity_before) };
        if step.end > step.start {
            let v_start = first(step.velocity_before);
            // Over an arc as short as the clock can tell, the rounding of the momentum would pass for a force.
            let speed = (2.0 * self.report.largest_j / mass).sqrt().max(v_start.abs()).max(v_end.abs());
            // The instants are known to an ulp of the time, and with them the phase of a load.
            let late = self.steepest * step.end * (step.end - step.start);
            let rounding = f64::EPSILON * (MOMENTUM_UNITS * mass * speed + CLOCK_UNITS * late);
            open = ((mass * (v_end - v_start) - along.net).abs() - rounding).max(0.0);
        }
        let mid = v_end + first(blow) / mass;
        let struck = 0.5 * first(blow) * (v_end + mid);
        flows.work += struck;
        flows.passed += struck.abs();
        let mut walls = 0.0;
        for (index, wall) in scene.walls.iter().enumerate() {
            if step.jump[index] != 0.0 {
                flows.impact -= 0.5 * step.jump[index] * (mid + first(step.v));
            }
            if wall.law.is_rigid() {
                continue;
            }
            let now = stored(wall, wall.at.dot(step.q), step.force[index] != 0.0);
            walls += now;
            let held = std::mem::replace(&mut self.held[index], now);
            if is_damped(wall.law) {
                flows.dashpot -= now - held;
            }
        }
        let (q, v) = (first(step.q), first(step.v));
        self.book(0.5 * (mass * v * v + stiffness * q * q) + walls, flows);
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

pub(in super::super) fn is_damped(law: WallLaw) -> bool {
    matches!(law, WallLaw::Elastic { damping, .. } if damping > 0.0)
}

fn first(x: &[f64]) -> f64 {
    x.first().copied().unwrap_or(0.0)
}
