//! A branch of orbits of one signature as a curve: the unknowns of the equations and a key's value.

use super::super::equations::{Equations, Scales, Turn};
use super::super::newton::{ACCEPTED, SOLVED};
use super::super::periodic::Orbit;
use super::super::problem::Problem;
use super::super::signature::Signature;
use crate::error::{Error, Result};
use crate::scene::Scene;
use nalgebra::{DMatrix, DVector};

/// Most iterations of a correction.
const ITERATIONS: usize = 12;

/// The step of the difference that gives the column of the key, as a share of its value: it enters
/// the matrix only, so that the solution does not depend on it.
const DIFFERENCE: f64 = 1e-6;

/// A scene for each value of a key.
///
/// # Errors
/// [`Error::Invalid`] or [`Error::Case`] for a value that the key does not accept.
pub type Family<'a> = dyn Fn(f64) -> Result<Scene> + 'a;

/// One point: the unknowns, scaled, and after them the key's value over its scale.
pub(super) type Vector = DVector<f64>;

/// The curve.
pub(super) struct Curve<'a> {
    pub family: &'a Family<'a>,
    pub signature: Signature,
    pub scales: Scales,
    /// What the key's value is divided by: the width of its range.
    pub width: f64,
}

/// The linearised equations at a point.
pub(super) struct Linear {
    pub problem: Problem,
    pub residual: Vector,
    /// n × (n + 1): the derivatives with the unknowns, and with the key.
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
            // At the end of what the key accepts, from one side.
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

    /// The determinant of the Jacobian of perturbations that change sign from one turn to the next:
    /// it vanishes with det(M + 1) Πv_i, where M is the derivative over one turn.
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

    /// The unit tangent at a point, on the side of `along`.
    pub fn tangent(&self, linear: &Linear, along: &Vector) -> Result<Vector> {
        let mut right = DVector::zeros(along.len());
        right[along.len() - 1] = 1.0;
        let tangent = bordered(&linear.matrix, along).lu().solve(&right);
        let tangent = tangent.filter(|t| t.iter().all(|x| x.is_finite())).ok_or_else(singular)?;
        let norm = tangent.norm();
        Ok(tangent / norm)
    }

    /// The point of the curve in the plane through `guess` across `border`; with its linearised
    /// equations, and how many iterations that took.
    pub fn correct(&self, guess: &Vector, border: &Vector) -> Result<(Vector, Linear, usize)> {
        let mut y = guess.clone();
        let mut last = f64::INFINITY;
        for iteration in 0..ITERATIONS {
            let linear = self.linear(&y)?;
            let size = if linear.residual.is_empty() { 0.0 } else { linear.residual.amax() };
            if !size.is_finite() {
                return Err(Error::no_orbit("Newton's method left the numbers"));
            }
            if last <= SOLVED || (size >= 0.5 * last && size <= ACCEPTED) {
                return Ok((y, linear, iteration));
            }
            let right = extended(&linear.residual, border.dot(&(&y - guess)));
            let step = bordered(&linear.matrix, border).lu().solve(&right).ok_or_else(singular)?;
            if !step.iter().all(|x| x.is_finite()) || step.norm() > 2.0 {
                return Err(Error::no_orbit("Newton's method left the neighbourhood"));
            }
            y -= step;
            last = size;
        }
        Err(Error::no_orbit(format!("Newton's method did not converge: the residual is {last:.1e} of the gap")))
    }
}

/// `matrix` with the row `border` below it.
fn bordered(matrix: &DMatrix<f64>, border: &Vector) -> DMatrix<f64> {
    let n = matrix.nrows();
    DMatrix::from_fn(n + 1, n + 1, |i, j| if i < n { matrix[(i, j)] } else { border[j] })
}

/// `vector` with one more entry.
fn extended(vector: &Vector, last: f64) -> Vector {
    DVector::from_iterator(vector.len() + 1, vector.iter().copied().chain([last]))
}

fn singular() -> Error {
    Error::no_orbit("the equations are singular across the branch: two branches cross there")
}
