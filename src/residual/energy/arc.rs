//! The ledger of exact motion: powers integrated along an arc, and what happens in the instant that ends it.

use super::super::quadrature::{Sample, integrate};
use super::{Flows, Ledger, stored};
use crate::flow::Arc;
use crate::scene::{Loads, Scene, WallLaw};
use crate::step::Step;

/// Units in the last place of the run's largest momentum by which those at the ends of an arc are not known.
const MOMENTUM_UNITS: f64 = 2.0;

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
            let mut largest = self.report.largest_j;
            let fastest = (2.0 * largest / system.mass_form(&[1.0], &[1.0])).sqrt();
            let radians = arc.fastest_motion() * (step.end - step.start);
            // Tables jump at their ends: the arc stops there, so a load read just inside is the load of the arc.
            let mut integrand = |t: f64| {
                let (q, v) = arc.state(t);
                let mut load = [first(step.extra)];
                loads.add_force(t, 1.0, &mut load);
                let [load] = load;
                let (spring, rub) = (system.stiffness_form(&[1.0], &[q]), system.damping_form(&[1.0], &[v]));
                let (mut net, mut forces) = (load - rub - spring, load.abs() + rub.abs() + spring.abs());
                let (mut push, mut pushes) = (0.0, 0.0);
                let mut energy = body(q, v);
                for (index, wall) in scene.walls.iter().enumerate() {
                    let r = arc.contact_force(index, t);
                    net += r;
                    forces += r.abs();
                    energy += stored(wall, wall.at.dot(&[q]), r != 0.0);
                    if is_damped(wall.law) {
                        push -= r;
                        pushes += r.abs();
                    }
                }
                largest = largest.max(energy);
                largest_force = largest_force.max(load.abs()).max(rub.abs());
                // A body that hardly moves has a velocity of rounding: powers are held to those at the speed the run's energy allows.
                let speed = v.abs().max(fastest);
                let (taken, lost) = (system.damping_form(&[v], &[v]), system.damping_form(&[speed], &[speed]));
                let value = [load * v, taken, push * v, net];
                let size = [load.abs() * speed, lost, pushes * speed, forces];
                Sample { value, size, along: (load * v).abs() }
            };
            let ([work, damping, dashpot, net], passed) =
                integrate(step.start, step.end, arc.damping() / arc.mass(), radians, &mut integrand);
            flows = Flows { work, passed, damping, dashpot, impact: 0.0 };
            self.report.largest_j = largest;
            let v_start = first(step.velocity_before);
            // Over an arc as short as the clock can tell, the rounding of the momentum would pass for a force.
            let speed = fastest.max(v_start.abs()).max(v_end.abs());
            let rounding = MOMENTUM_UNITS * f64::EPSILON * system.mass_form(&[1.0], &[speed]);
            momentum = ((system.mass_form(&[1.0], &[v_end - v_start]) - net).abs() - rounding).max(0.0);
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
