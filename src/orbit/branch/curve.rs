//! A branch of orbits of one signature as a curve: the unknowns of the equations and a key's value.

use super::super::equations::{Closure, Equations};
use super::super::periodic::Orbit;
use super::super::problem::Problem;
use super::super::signature::Signature;
use super::super::strobe::Scales;
pub(super) use super::arclength::Vector;
use super::arclength::{self, extended};
use super::family::{self, Family};
use crate::error::{Error, Result};
use nalgebra::{DMatrix, DVector};

/// Most iterations that compute the derivative with respect to the key: the second is as near the
/// solution as its square, and the derivative enters the matrix only.
const OWN: usize = 2;

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
        let value = self.value(y);
        let problem = Problem::new((self.family)(value)?)?;
        // A key can make a wall rebound at which the orbit rests after one impact.
        self.signature.check(problem.scene())?;
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

    /// Residual and derivatives at `y`.
    pub fn linear(&self, y: &Vector) -> Result<Linear> {
        self.linear_with(y, &mut None)
    }

    /// The same, with the derivative with respect to the key from `column`; if it is `None` there,
    /// it is computed and stored.
    fn linear_with(&self, y: &Vector, column: &mut Option<Vector>) -> Result<Linear> {
        let problem = self.problem(y)?;
        let equations = Equations::new(&problem, &self.signature, self.scales);
        let n = equations.unknowns();
        let (mut residual, mut matrix) = (DVector::zeros(n), DMatrix::zeros(n, n + 1));
        let jacobian = Some((&mut matrix, Closure::Same));
        let mut arc = problem.arc();
        equations.evaluate(&problem, &mut arc, y.as_slice(), &mut residual, jacobian);
        if n > 0 {
            let column = match column {
                Some(known) => &*known,
                None => {
                    let tangent = family::tangent(self.family, self.value(y), self.width, problem.scene())?;
                    let own = equations.by_key(&problem, &mut arc, y.as_slice(), &tangent)?;
                    &*column.insert(own * self.width)
                }
            };
            matrix.set_column(n, column);
        }
        Ok(Linear { problem, residual, matrix })
    }

    /// The Jacobian for perturbations that change sign from one period of the orbit to the next:
    /// its determinant vanishes with det(M + 1) Πv_i, where M is the derivative over one period.
    pub fn twisted(&self, problem: &Problem, y: &Vector) -> DMatrix<f64> {
        let equations = Equations::new(problem, &self.signature, self.scales);
        let n = equations.unknowns();
        let (mut residual, mut matrix) = (DVector::zeros(n), DMatrix::zeros(n, n));
        let jacobian = Some((&mut matrix, Closure::Opposite));
        equations.evaluate(problem, &mut problem.arc(), y.as_slice(), &mut residual, jacobian);
        matrix
    }

    /// The point of the curve in the plane through `guess` with the normal `border`; with its
    /// linearised equations and the number of iterations.
    pub fn correct(&self, guess: &Vector, border: &Vector) -> Result<(Vector, Linear, usize)> {
        let (mut iteration, mut column) = (0, None);
        let linear = |y: &Vector| {
            if iteration < OWN {
                column = None;
            }
            iteration += 1;
            self.linear_with(y, &mut column)
        };
        arclength::correct(guess, border, linear, |linear| (&linear.residual, &linear.matrix))
    }
}
