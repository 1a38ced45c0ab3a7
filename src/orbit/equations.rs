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

use super::boundary::{Boundary, OnWall};
use super::periodic::Orbit;
use super::problem::Problem;
use super::signature::{Kind, Signature};
use super::strobe::Scales;
use crate::flow::{Arc, Support};
use crate::scene::Side;
use nalgebra::{DMatrix, DVector};

/// The unknowns are made dimensionless by a tenth of a cycle, the gap, and the gap times the
/// forcing's Ω.
pub(super) const CYCLE: f64 = 0.1;

/// A flight from an event to the next, `j`.
#[derive(Debug, Clone, Copy)]
pub(super) struct Flight<'a> {
    /// Its number.
    pub i: usize,
    /// That of the event at which it ends, and −1 if its end is the mirror image of that.
    pub j: usize,
    pub sign: f64,
    /// The kinds of both events, their boundaries and walls, and their speeds (m/s).
    pub kinds: [Kind; 2],
    pub boundaries: [&'a Boundary; 2],
    pub walls: [usize; 2],
    pub speeds: [f64; 2],
    /// Its start and its end, cycles.
    pub phases: [f64; 2],
    /// The states just after the one event and just before the other.
    pub from: OnWall,
    pub to: OnWall,
    /// The wall on which the body rests.
    pub carrier: Option<usize>,
}

impl Flight<'_> {
    /// The reaction of the wall on which the body rests at the end of the flight, `span` (s) after
    /// its start, and its derivatives with respect to time: N, N/s, …
    pub fn reaction(&self, arc: &Arc, wall: usize, span: f64) -> [f64; 4] {
        let side = if self.boundaries[0].toward > 0.0 { Side::Upper } else { Side::Lower };
        arc.pressing(Support { wall, side }, span)
    }
}

/// Sign with which a perturbation at the end of the last flight is passed on to the first event.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) enum Closure {
    /// It comes back to itself.
    Same,
    /// It comes back with the other sign: the Jacobian is singular where the period doubles, or
    /// where a symmetric orbit loses its symmetry (a multiplier of its half map is −1).
    Opposite,
}

/// The equations of one signature.
#[derive(Debug)]
pub(super) struct Equations<'a> {
    pub signature: &'a Signature,
    pub touching: Vec<Vec<usize>>,
    /// Of the unknowns and residuals; the same along a branch.
    pub scales: Scales,
}

impl<'a> Equations<'a> {
    pub fn new(problem: &Problem, signature: &'a Signature, scales: Scales) -> Self {
        Self { signature, touching: problem.touching(signature), scales }
    }

    /// The scale of forces, N.
    pub fn force(&self, problem: &Problem) -> f64 {
        let omega = std::f64::consts::TAU / problem.forcing_period();
        problem.body().mass * self.scales.length * omega * omega
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

    /// Flight number `i` at `unknowns`, scaled; `None` beyond the walls and unknowns.
    pub fn flight<'b>(&self, problem: &'b Problem, i: usize, unknowns: &[f64]) -> Option<Flight<'b>> {
        let events = &self.signature.events;
        let last = i + 1 == events.len();
        let j = if last { 0 } else { i + 1 };
        let (event, next) = (events.get(i)?, events.get(j)?);
        let boundaries = [problem.boundary(event.wall)?, problem.boundary(next.wall)?];
        let at = |index: usize| unknowns.get(index).copied();
        let speeds = [at(2 * i + 1)? * self.scales.speed, at(2 * j + 1)? * self.scales.speed];
        let shift = if last { self.signature.cycles() } else { 0.0 };
        Some(Flight {
            i,
            j,
            sign: if last && self.signature.symmetric { -1.0 } else { 1.0 },
            kinds: [event.kind, next.kind],
            boundaries,
            walls: [event.wall, next.wall],
            speeds,
            phases: [at(2 * i)? * CYCLE, at(2 * j)? * CYCLE + shift],
            from: boundaries[0].after(event.kind, speeds[0]),
            to: boundaries[1].before(next.kind, speeds[1]),
            carrier: (event.kind == Kind::Rest).then_some(event.wall),
        })
    }

    /// Fills the arc of a flight, and gives its length, s.
    pub fn fly(&self, problem: &Problem, arc: &mut Arc, flight: &Flight<'_>) -> f64 {
        let [start, end] = flight.phases.map(|phase| phase * problem.forcing_period());
        let touching = self.touching.get(flight.i).map_or(&[][..], Vec::as_slice);
        problem.fly(arc, flight.from.state, [start, end - start], touching, flight.carrier);
        end - start
    }

    /// The residual at `unknowns`, scaled; and its Jacobian, where one is asked for.
    pub fn evaluate(
        &self,
        problem: &Problem,
        arc: &mut Arc,
        unknowns: &[f64],
        residual: &mut DVector<f64>,
        mut jacobian: Option<(&mut DMatrix<f64>, Closure)>,
    ) {
        let events = &self.signature.events;
        let period = problem.forcing_period();
        let Scales { length, speed } = self.scales;
        let force = self.force(problem);
        if let Some((matrix, _)) = &mut jacobian {
            matrix.fill(0.0);
        }
        for i in 0..events.len() {
            let Some(flight) = self.flight(problem, i, unknowns) else { continue };
            let Flight { j, sign, from, to, carrier, .. } = flight;
            let (r0, r1) = (2 * i, 2 * i + 1);
            let span = self.fly(problem, arc, &flight);
            // The derivatives of both rows with respect to phase and speed of event i, and of event
            // j.
            let (own, other);
            if let Some(wall) = carrier {
                let [reaction, rate, ..] = flight.reaction(arc, wall, span);
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
            let factor = if j == 0 && *turn == Closure::Opposite { -1.0 } else { 1.0 };
            for (k, row) in [r0, r1].into_iter().enumerate() {
                for column in 0..2 {
                    matrix[(row, 2 * i + column)] += own[k][column];
                    matrix[(row, 2 * j + column)] += factor * other[k][column];
                }
            }
        }
    }
}
