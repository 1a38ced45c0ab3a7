//! The derivative of the equations of a periodic orbit with respect to a key.
//!
//! The unknowns stay as they are: the phases in cycles, so that a key that changes the forcing
//! period T moves an event at the phase θ by δt = θ δT, and the speeds. With δx₀ the change of the
//! state after event i, and F the change that the key makes of the flight between fixed instants,
//!
//! δr_i = F(δx₀ − f(x_i⁺) δt_i) + f(x_j) δt_j − s δx_j⁻.

use super::equations::{Equations, Flight};
use super::problem::Problem;
use super::strobe::Scales;
use crate::error::{Error, Result};
use crate::flow::Arc;
use crate::variation::{SceneTangent, StructureVariation};
use nalgebra::DVector;

impl Equations<'_> {
    /// ∂r/∂λ at `unknowns`, scaled, per unit of the key λ of `tangent`. Where the body rests, it is
    /// that of a solution, at which the reaction at the end vanishes.
    ///
    /// # Errors
    /// [`Error::Invalid`] for a key that changes the frequencies of the loads by different shares;
    /// [`Error::NoOrbit`] where the derivative does not exist.
    pub fn by_key(
        &self,
        problem: &Problem,
        arc: &mut Arc,
        unknowns: &[f64],
        tangent: &SceneTangent,
    ) -> Result<DVector<f64>> {
        let longer = tangent.period(problem.scene(), problem.forcing_period())?;
        let mut variation = StructureVariation::with_keys(problem.scene(), std::slice::from_ref(tangent), &[])?;
        let mut column = DVector::zeros(self.unknowns());
        let Scales { length, speed } = self.scales;
        for i in 0..self.signature.events.len() {
            let Some(flight) = self.flight(problem, i, unknowns) else { continue };
            let span = self.fly(problem, arc, &flight);
            let [later, until] = flight.phases.map(|phase| phase * longer);
            if let Some(wall) = flight.carrier {
                let [_, rate, ..] = flight.reaction(arc, wall, span);
                let change = self.reaction_by(problem, &flight, tangent) + rate * until;
                column[2 * i] = change / self.force(problem);
                continue;
            }
            let ([_, v, a, ..], [_, end_v, end_a, ..]) = (arc.start_jet(), arc.jet(span));
            let (mut change, to) = flight.ends_by(tangent);
            change[0] -= v * later;
            change[1] -= a * later;
            variation.fly(arc, &mut change).map_err(|reason| Error::no_orbit(reason.to_string()))?;
            column[2 * i] = (change[0] + end_v * until - flight.sign * to[0]) / length;
            column[2 * i + 1] = (change[1] + end_a * until - flight.sign * to[1]) / speed;
        }
        Ok(column)
    }

    /// The change of the reaction of the wall on which the body rests at the end of `flight`, at a
    /// fixed instant: N per unit of the key. With σ the sign of the reaction it is σ times that of
    /// k g − f − Σ r_a.
    fn reaction_by(&self, problem: &Problem, flight: &Flight<'_>, tangent: &SceneTangent) -> f64 {
        let [boundary, _] = flight.boundaries;
        let moved = tangent.wall(flight.walls[0]).map_or(0.0, |wall| wall.position);
        let [_, _, stiffer] = tangent.body();
        let mut change = stiffer * boundary.position + problem.body().stiffness * moved;
        for touch in self.touching.get(flight.i).into_iter().flatten().filter_map(|&wall| problem.touch(wall)) {
            let Some(by) = tangent.wall(touch.wall) else { continue };
            change += by.stiffness * (boundary.position - touch.position) + touch.stiffness * (moved - by.position);
        }
        -boundary.toward * (change - tangent.force(flight.phases[1] * problem.forcing_period()))
    }
}

impl Flight<'_> {
    /// The derivatives of the states at both ends with respect to the key of `tangent`, at fixed
    /// speeds.
    pub fn ends_by(&self, tangent: &SceneTangent) -> ([f64; 2], [f64; 2]) {
        let ([from, to], [kind, next], [v, w]) = (self.boundaries, self.kinds, self.speeds);
        let after = tangent.wall(self.walls[0]).map_or([0.0; 2], |by| from.after_by(kind, v, by));
        let before = tangent.wall(self.walls[1]).map_or([0.0; 2], |by| to.before_by(next, w, by));
        (after, before)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::orbit::Kind;
    use crate::scene::{Load, Scene, Wall};

    /// Gap, restitution or stiffness of the wall, its dashpot, amplitude, frequency, phase, mass,
    /// damping, stiffness and static load.
    type Numbers = [f64; 10];

    fn rigid([gap, e, _, amplitude, frequency, phase, m, c, k, still]: Numbers) -> Scene {
        body([amplitude, frequency, phase, m, c, k, still]).with_wall(Wall::upper("stop", gap).with_restitution(e))
    }

    fn soft([gap, stiff, damped, amplitude, frequency, phase, m, c, k, still]: Numbers) -> Scene {
        let wall = Wall::upper("stop", gap).with_elasticity(stiff, damped);
        body([amplitude, frequency, phase, m, c, k, still]).with_wall(wall)
    }

    fn body([amplitude, frequency, phase, m, c, k, still]: [f64; 7]) -> Scene {
        Scene::oscillator(m, c, k)
            .with_load(Load::harmonic(amplitude, frequency, phase))
            .with_load(Load::constant(still))
    }

    /// The column against the central difference of the residual, which errs by 1e-9 of its size:
    /// by rounding over a step of 1e-6, and by the cube of the step.
    fn check(scene: fn(Numbers) -> Scene, numbers: Numbers, kinds: &[Kind]) {
        let problem = Problem::new(scene(numbers)).unwrap();
        let orbit = problem.settled(400).unwrap();
        let found: Vec<Kind> = orbit.signature.events.iter().map(|event| event.kind).collect();
        assert_eq!(found, kinds);
        let equations = Equations::new(&problem, &orbit.signature, problem.scales());
        let unknowns = equations.gather(&orbit);
        for index in 0..numbers.len() {
            let at = |x: f64| {
                let mut changed = numbers;
                changed[index] = x;
                scene(changed)
            };
            let own = SceneTangent::new("key", numbers[index], |x| Ok(at(x)));
            // What the scene does not have, and a restitution of 0, which has no smaller one.
            let Some(tangent) = own.ok().filter(|_| numbers[index] > 0.0) else { continue };
            let column = equations.by_key(&problem, &mut problem.arc(), unknowns.as_slice(), &tangent).unwrap();
            let step = 1e-6 * numbers[index].abs().max(1e-2);
            let residual = |x: f64| {
                let other = Problem::new(at(x)).unwrap();
                let mut residual = DVector::zeros(equations.unknowns());
                equations.evaluate(&other, &mut other.arc(), unknowns.as_slice(), &mut residual, None);
                residual
            };
            let difference = (residual(numbers[index] + step) - residual(numbers[index] - step)) / (2.0 * step);
            let size = difference.amax() + 1.0 / numbers[index].abs().max(1e-2);
            assert!((&column - &difference).amax() <= 1e-8 * size, "key {index}: {column} {difference}");
        }
    }

    #[test]
    fn the_derivative_by_each_key_is_that_of_the_residual() {
        check(rigid, [5e-3, 0.6, 0.0, 3.0, 2.6, 0.3, 1.0, 0.8, 100.0, 0.2], &[Kind::Impact]);
        check(soft, [5e-3, 2e3, 8.0, 3.0, 2.6, 0.3, 1.0, 0.8, 100.0, 0.2], &[Kind::Enter, Kind::Leave]);
        check(rigid, [2e-3, 0.0, 0.0, 1.0, 1.0, 0.3, 1.0, 0.8, 100.0, 0.9], &[Kind::Release, Kind::Rest]);
    }
}
