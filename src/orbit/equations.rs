//! The equations of a periodic orbit with explicit times.
//!
//! The unknowns are the phase θ_i (cycles) and the speed v_i of every event. For each flight from
//! event i to event j, the state that the flow reaches at t_j is the state before event j:
//!
//! r_i = φ(t_j; t_i, x_i⁺(v_i)) − s x_j⁻(v_j) = 0,
//!
//! where s is −1 for the last flight of a symmetric orbit, which ends in the mirror, and 1
//! otherwise. The impact law is applied whatever the sign of v_i, so that r is analytic in all
//! unknowns, through grazing impacts (v_i = 0) too. A rest on a wall ends where its force vanishes:
//! r_i = (reaction at t_j, v_j).
//!
//! ∂r_i/∂t_j = f(x_j), ∂r_i/∂t_i = −Φ f(x_i⁺), ∂r_i/∂v_i = Φ ∂x_i⁺/∂v_i, ∂r_i/∂v_j = −s ∂x_j⁻/∂v_j
//!
//! with Φ the propagator of the flight and f the right-hand side of the differential equation.

use super::periodic::Orbit;
use super::problem::Problem;
use super::signature::{Kind, Signature};
use crate::flow::{Arc, Support};
use nalgebra::{DMatrix, DVector};

/// The unknowns are made dimensionless by a tenth of a cycle, the gap, and the gap times the
/// forcing's Ω.
pub(super) const CYCLE: f64 = 0.1;

/// The scales of the unknowns and residuals; the same along a branch.
#[derive(Debug, Clone, Copy)]
pub(super) struct Scales {
    /// m.
    pub length: f64,
    /// m/s.
    pub speed: f64,
}

impl Scales {
    pub fn of(problem: &Problem) -> Self {
        let [length, speed] = problem.scales();
        Self { length, speed }
    }
}

/// Sign with which a perturbation at the end of the last flight is passed on to the first event.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) enum Turn {
    /// It comes back to itself.
    Same,
    /// It comes back with the other sign: the Jacobian is singular where the period doubles, or
    /// where a symmetric orbit loses its symmetry (a multiplier of its half map is −1).
    Opposite,
}

/// The equations of one signature.
#[derive(Debug)]
pub(super) struct Equations<'a> {
    signature: &'a Signature,
    touching: Vec<Vec<usize>>,
    scales: Scales,
}

impl<'a> Equations<'a> {
    pub fn new(problem: &Problem, signature: &'a Signature, scales: Scales) -> Self {
        Self { signature, touching: problem.touching(signature), scales }
    }

    pub fn unknowns(&self) -> usize {
        2 * self.signature.events.len()
    }

    /// The unknowns of `orbit`, scaled.
    pub fn gather(&self, orbit: &Orbit) -> DVector<f64> {
        let pairs = orbit.phases.iter().zip(&orbit.speeds);
        let values = pairs.flat_map(|(phase, speed)| [phase / CYCLE, speed / self.scales.speed]);
        DVector::from_iterator(self.unknowns(), values)
    }

    /// The orbit of the unknowns.
    pub fn orbit(&self, unknowns: &[f64], problem: &Problem) -> Orbit {
        let pick = |offset: usize, scale: f64| {
            unknowns.iter().skip(offset).step_by(2).take(self.signature.events.len()).map(|x| x * scale).collect()
        };
        Orbit {
            signature: self.signature.clone(),
            phases: pick(0, CYCLE),
            speeds: pick(1, self.scales.speed),
            forcing_period: problem.forcing_period(),
        }
    }

    /// The residual at `unknowns`, scaled; and its Jacobian, where one is asked for.
    pub fn evaluate(
        &self,
        problem: &Problem,
        arc: &mut Arc,
        unknowns: &[f64],
        residual: &mut DVector<f64>,
        jacobian: Option<(&mut DMatrix<f64>, Turn)>,
    ) {
        let events = &self.signature.events;
        let period = problem.forcing_period();
        let Scales { length, speed } = self.scales;
        let omega = std::f64::consts::TAU / period;
        let force = problem.body().mass * length * omega * omega;
        let mut jacobian = jacobian;
        if let Some((matrix, _)) = &mut jacobian {
            matrix.fill(0.0);
        }
        for (i, event) in events.iter().enumerate() {
            let last = i + 1 == events.len();
            let j = if last { 0 } else { i + 1 };
            let next = events[j];
            let (Some(boundary), Some(target)) = (problem.boundary(event.wall), problem.boundary(next.wall)) else {
                continue;
            };
            let shift = if last { self.signature.cycles() } else { 0.0 };
            let mirrored = last && self.signature.symmetric;
            let sign = if mirrored { -1.0 } else { 1.0 };
            let start = unknowns[2 * i] * CYCLE * period;
            let span = (unknowns[2 * j] * CYCLE + shift) * period - start;
            let from = boundary.after(event.kind, unknowns[2 * i + 1] * speed);
            let to = target.before(next.kind, unknowns[2 * j + 1] * speed);
            let touching = self.touching.get(i).map_or(&[][..], Vec::as_slice);
            let (r0, r1) = (2 * i, 2 * i + 1);
            let carrier = (event.kind == Kind::Rest).then_some(event.wall);
            problem.fly(arc, from.state, [start, span], touching, carrier);
            // The derivatives of both rows with respect to phase and speed of event i, and of event
            // j.
            let (own, other);
            if let Some(wall) = carrier {
                let side = if boundary.toward > 0.0 { crate::scene::Side::Upper } else { crate::scene::Side::Lower };
                let [reaction, rate, ..] = arc.pressing(Support { wall, side }, span);
                residual[r0] = reaction / force;
                residual[r1] = unknowns[2 * j + 1];
                own = [[0.0; 2]; 2];
                other = [[rate * period * CYCLE / force, 0.0], [0.0, 1.0]];
            } else {
                let jet = arc.jet(span);
                residual[r0] = (jet[0] - sign * to.state[0]) / length;
                residual[r1] = (jet[1] - sign * to.state[1]) / speed;
                if jacobian.is_none() {
                    continue;
                }
                let phi = arc.propagator();
                let begin = arc.start_jet();
                let (field, step) = ([begin[1], begin[2]], period * CYCLE);
                let row = |k: usize, scale: f64| {
                    let along = |x: [f64; 2]| phi[k][0] * x[0] + phi[k][1] * x[1];
                    (
                        [-step * along(field) / scale, along(from.rate) * speed / scale],
                        [step * jet[k + 1] / scale, -sign * to.rate[k] * speed / scale],
                    )
                };
                let (first, second) = (row(0, length), row(1, speed));
                own = [first.0, second.0];
                other = [first.1, second.1];
            }
            let Some((matrix, turn)) = &mut jacobian else { continue };
            let factor = if last && *turn == Turn::Opposite { -1.0 } else { 1.0 };
            for (k, row) in [r0, r1].into_iter().enumerate() {
                for column in 0..2 {
                    matrix[(row, 2 * i + column)] += own[k][column];
                    matrix[(row, 2 * j + column)] += factor * other[k][column];
                }
            }
        }
    }
}
