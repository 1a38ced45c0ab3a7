//! The ledger of exact motion: powers integrated along an arc, and what happens in the instant that ends it.

use super::super::quadrature::{nodes, panels};
use super::{Flows, Ledger, stored};
use crate::flow::Arc;
use crate::scene::{Loads, Scene, WallLaw};
use crate::step::Step;

/// Units in the last place of the run's largest momentum by which those at the ends of an arc are not known.
const MOMENTUM_UNITS: f64 = 2.0;

/// Units in the last place by which the instants of an arc are not known: of the arc's own clock and of the load's.
const CLOCK_UNITS: f64 = 2.0;

/// What an arc leaves for the momentum balance: its residual beyond rounding, N s, ≥ 0, and the largest force of the body's own, N.
pub(in super::super) struct ArcBalance {
    pub balance: f64,
    pub largest_force: f64,
}

impl Ledger {
    /// One exact arc and the instant at its end.
    ///
    /// What a damped wall takes is the work done on it, ∫|r|ṡ, less what it stores: so nothing hangs on the moment at which it lets go or
    /// takes hold, which at a shared face is one of rounding. It stores only while it touches; what it holds when it lets go stays with it,
    /// since spring and dashpot then relax against each other.
    pub fn see_arc(&mut self, scene: &Scene, step: &Step<'_>, arc: &Arc, loads: &Loads, blow: &[f64]) -> ArcBalance {
        let system = &scene.system;
        let mut flows = Flows::default();
        let mut largest_force = 0.0_f64;
        let mut momentum = 0.0;
        let v_end = if step.end > step.start { arc.state(step.end).1 } else { first(step.velocity_before) };
        let body = |q: f64, v: f64| 0.5 * (system.mass_form(&[v], &[v]) + system.stiffness_form(&[q], &[q]));
        if step.end > step.start {
            let mut net = 0.0;
            let (rate, fastest) = (arc.damping() / arc.mass(), arc.fastest_motion());
            for (from, to) in panels(step.start, step.end, rate, fastest) {
                let (mut part, mut balance) = (Flows::default(), 0.0);
                // Tables jump at their ends: the arc stops there, so a load read just inside is the load of the arc.
                for (t, weight) in nodes(from, to) {
                    let (q, v) = arc.state(t);
                    let mut load = [first(step.extra)];
                    loads.add_force(t, 1.0, &mut load);
                    let [load] = load;
                    let (spring, rub) = (system.stiffness_form(&[1.0], &[q]), system.damping_form(&[1.0], &[v]));
                    let mut forces = load - rub - spring;
                    let mut energy = body(q, v);
                    for (index, wall) in scene.walls.iter().enumerate() {
                        let r = arc.force_at(index, t, (q, v));
                        forces += r;
                        energy += stored(wall, wall.at.dot(&[q]), r != 0.0);
                        if is_damped(wall.law) {
                            part.dashpot -= weight * r * v;
                        }
                    }
                    self.report.largest_j = self.report.largest_j.max(energy);
                    largest_force = largest_force.max(load.abs()).max(rub.abs());
                    part.work += weight * load * v;
                    part.passed += weight * (load * v).abs();
                    part.damping += weight * system.damping_form(&[v], &[v]);
                    balance += weight * forces;
                }
                flows.work += part.work;
                flows.passed += part.passed;
                flows.damping += part.damping;
                flows.dashpot += part.dashpot;
                net += balance;
            }
            let v_start = first(step.velocity_before);
            let mass = system.mass_form(&[1.0], &[1.0]);
            // Over an arc as short as the clock can tell, the rounding of the momentum would pass for a force.
            let speed = (2.0 * self.report.largest_j / mass).sqrt().max(v_start.abs()).max(v_end.abs());
            // The instants are known to an ulp of the time, and with them the phase of a load.
            let late = self.steepest * step.end * (step.end - step.start);
            let rounding = f64::EPSILON * (MOMENTUM_UNITS * mass * speed + CLOCK_UNITS * late);
            momentum = ((mass * (v_end - v_start) - net).abs() - rounding).max(0.0);
        }
        let mid = v_end + first(blow) / system.mass_form(&[1.0], &[1.0]);
        let struck = 0.5 * first(blow) * (v_end + mid);
        flows.work += struck;
        flows.passed += struck.abs();
        let mut walls = 0.0;
        for (index, wall) in scene.walls.iter().enumerate() {
            flows.impact -= 0.5 * step.jump[index] * (mid + first(step.v));
            let now = stored(wall, wall.at.dot(step.q), step.force[index] != 0.0);
            walls += now;
            let held = std::mem::replace(&mut self.held[index], now);
            if is_damped(wall.law) {
                flows.dashpot -= now - held;
            }
        }
        self.book(body(first(step.q), first(step.v)) + walls, flows);
        ArcBalance { balance: momentum, largest_force }
    }
}

fn is_damped(law: WallLaw) -> bool {
    matches!(law, WallLaw::Elastic { damping, .. } if damping > 0.0)
}

fn first(x: &[f64]) -> f64 {
    x.first().copied().unwrap_or(0.0)
}
