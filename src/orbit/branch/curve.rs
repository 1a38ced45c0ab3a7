//! A branch of orbits of one signature as a curve: the unknowns of the equations and a key's value.

use super::super::equations::{Equations, Scales, Turn};
use super::super::periodic::Orbit;
use super::super::problem::Problem;
use super::super::signature::Signature;
pub(super) use super::arclength::Vector;
use super::arclength::{self, extended};
use crate::error::{Error, Result};
use crate::scene::Scene;
use nalgebra::{DMatrix, DVector};

/// Relative step of the finite difference that gives the derivative with respect to the key. It
/// enters the matrix only, so that the solution does not depend on it.
const DIFFERENCE: f64 = 1e-6;

/// A scene for each value of a key.
///
/// # Errors
/// [`Error::Invalid`] or [`Error::Case`] for a value that the key does not accept.
pub type Family<'a> = dyn Fn(f64) -> Result<Scene> + 'a;

/// A curve of orbits: the family of scenes and the scales of its unknowns.
#[derive(Clone)]
pub(super) struct Curve<'a> {
    pub family: &'a Family<'a>,
    pub signature: Signature,
    pub scales: Scales,
    /// The scale of the key's value: the width of its range.
    pub width: f64,
}

/// The linearised equations at a point.
pub(super) struct Linear {
    pub problem: Problem,
    pub residual: Vector,
    /// n × (n + 1): the derivatives with respect to the unknowns, and to the key.
    pub matrix: DMatrix<f64>,
}

impl Curve<'_> {
    pub fn value(&self, y: &Vector) -> f64 {
        y[y.len() - 1] * self.width
    }

    pub fn problem(&self, y: &Vector) -> Result<Problem> {
        self.problem_at(self.value(y))
    }

    fn problem_at(&self, value: f64) -> Result<Problem> {
        let problem = Problem::new((self.family)(value)?)?;
        if self.signature.symmetric && !problem.is_symmetric() {
            return Err(Error::no_orbit(format!("the scene at {value} is not its own mirror image, as the orbit is")));
        }
        Ok(problem)
    }

    /// The point of `orbit` at `value`.
    pub fn gather(&self, problem: &Problem, orbit: &Orbit, value: f64) -> Vector {
        let equations = Equations::new(problem, &self.signature, self.scales);
        extended(&equations.gather(orbit), value / self.width)
    }

    pub fn orbit(&self, problem: &Problem, y: &Vector) -> Orbit {
        Equations::new(problem, &self.signature, self.scales).orbit(y.as_slice(), problem)
    }

    fn residual(&self, problem: &Problem, y: &Vector) -> Vector {
        let equations = Equations::new(problem, &self.signature, self.scales);
        let mut residual = DVector::zeros(equations.unknowns());
        equations.evaluate(problem, &mut problem.arc(), y.as_slice(), &mut residual, None);
        residual
    }

    /// Residual and derivatives at `y`.
    pub fn linear(&self, y: &Vector) -> Result<Linear> {
        let problem = self.problem(y)?;
        let equations = Equations::new(&problem, &self.signature, self.scales);
        let n = equations.unknowns();
        let (mut residual, mut matrix) = (DVector::zeros(n), DMatrix::zeros(n, n + 1));
        let jacobian = Some((&mut matrix, Turn::Same));
        equations.evaluate(&problem, &mut problem.arc(), y.as_slice(), &mut residual, jacobian);
        if n > 0 {
            let value = self.value(y);
            let step = DIFFERENCE * value.abs().max(1e-3 * self.width);
            // At the end of the values that the key accepts the difference is one-sided.
            let (above, below) = (self.problem_at(value + step), self.problem_at(value - step));
            let column = match (above, below) {
                (Ok(above), Ok(below)) => (self.residual(&above, y) - self.residual(&below, y)) / (2.0 * step),
                (Ok(above), Err(_)) => (self.residual(&above, y) - &residual) / step,
                (Err(_), Ok(below)) => (&residual - self.residual(&below, y)) / step,
                (Err(error), Err(_)) => return Err(error),
            };
            matrix.set_column(n, &(column * self.width));
        }
        Ok(Linear { problem, residual, matrix })
    }

    /// The determinant of the Jacobian for perturbations that change sign from one period of the
    /// orbit to the next: it vanishes with det(M + 1) Πv_i, where M is the derivative over one
    /// period.
    pub fn twist(&self, problem: &Problem, y: &Vector) -> f64 {
        self.twisted(problem, y).determinant()
    }

    pub fn twisted(&self, problem: &Problem, y: &Vector) -> DMatrix<f64> {
        let equations = Equations::new(problem, &self.signature, self.scales);
        let n = equations.unknowns();
        let (mut residual, mut matrix) = (DVector::zeros(n), DMatrix::zeros(n, n));
        let jacobian = Some((&mut matrix, Turn::Opposite));
        equations.evaluate(problem, &mut problem.arc(), y.as_slice(), &mut residual, jacobian);
        matrix
    }

    /// The unit tangent at a point, in the direction of `along`.
    pub fn tangent(&self, linear: &Linear, along: &Vector) -> Result<Vector> {
        arclength::tangent(&linear.matrix, along)
    }

    /// The point of the curve in the plane through `guess` with the normal `border`; with its
    /// linearised equations and the number of iterations.
    pub fn correct(&self, guess: &Vector, border: &Vector) -> Result<(Vector, Linear, usize)> {
        arclength::correct(guess, border, |y| self.linear(y), |linear| (&linear.residual, &linear.matrix))
    }
}
