//! Loci: the curves of special points in the plane of two keys.
//!
//! The equations are those of the orbit and, as one more, the test function of the special point;
//! both keys are unknown. The curve is followed by pseudo-arclength, as a branch is. The gradient
//! of the test function is a finite difference, which enters the matrix only.

use super::super::admissible::Admissible;
use super::super::equations::{Closure, Equations};
use super::super::periodic::Orbit;
use super::super::problem::Problem;
use super::super::strobe::Scales;
use super::arclength::{GROWTH, Vector, beyond, bordered, check_range, extended, tangent, turns_little, unit};
use super::label::Label;
use super::line::End;
use super::request::Special;
use crate::error::{Error, Result};
use crate::scene::Scene;
use nalgebra::DMatrix;

/// A scene for each pair of values of two keys.
///
/// # Errors
/// [`Error::Invalid`] or [`Error::Case`] for values that the keys do not accept.
pub type Plane<'a> = dyn Fn([f64; 2]) -> Result<Scene> + 'a;

/// The first, the longest and the shortest step, in the scaled unknowns.
const STEPS: [f64; 3] = [3e-3, 5e-2, 1e-7];

/// Most iterations of a correction, and the size of its step below which it has converged.
const ITERATIONS: usize = 10;
const CLOSE: f64 = 1e-11;

/// Step of the finite differences, in the scaled unknowns.
const DIFFERENCE: f64 = 1e-6;

/// A wall that is passed by less than this share of the scales is passed by rounding only.
const ROUNDING: f64 = 1e-8;

/// A special point of a locus.
#[derive(Debug, Clone, PartialEq)]
pub struct OnLocus {
    /// The values of both keys.
    pub values: [f64; 2],
    /// The orbit.
    pub orbit: Orbit,
}

/// A curve of special points.
#[derive(Debug, Clone)]
pub struct Locus {
    /// What happens at each of its points.
    pub label: Label,
    /// Its points in order along it.
    pub points: Vec<OnLocus>,
    /// Why it ends before its first point, and after its last.
    pub ends: [End; 2],
}

/// Follows the special point `special`, found at the second key's value `second`, in the plane of
/// two keys, in both directions, at most `most` points to each, while the keys stay in `ranges`.
///
/// ```
/// use signorini::orbit::branch::{Label, Request, Switch, graph, locus};
/// use signorini::orbit::Problem;
/// use signorini::{Load, Scene, Wall};
///
/// // The fold of the source oscillator's symmetric orbit, over frequency and restitution.
/// let plane = |[frequency, restitution]: [f64; 2]| {
///     let scene = Scene::oscillator(1.0, 0.2, 100.0)
///         .with_wall(Wall::upper("upper", 5e-3).with_restitution(restitution))
///         .with_wall(Wall::lower("lower", -5e-3).with_restitution(restitution))
///         .with_load(Load::harmonic(3.0, frequency, 0.0));
///     Ok(scene)
/// };
/// let start = Problem::new(plane([5.0, 0.8])?)?.settled(200)?;
/// let request = Request { range: [5.0, 16.0], switch: Switch::No, depth: 0, points: 2000 };
/// let found = graph(&|frequency| plane([frequency, 0.8]), &start, 5.0, &request, &mut |_| ())?;
/// let fold = found.specials.iter().find(|special| special.label == Label::Fold).unwrap();
/// let curve = locus(&plane, fold, 0.8, [[5.0, 20.0], [0.5, 0.9]], 1000)?;
/// // Its end at e = 0.5 is the fold of that restitution.
/// let at_half = curve.points.iter().find(|point| point.values[1] == 0.5).unwrap();
/// assert!((at_half.values[0] - 8.742_829_292_083_56).abs() < 1e-8); // Hz
/// # Ok::<(), signorini::Error>(())
/// ```
///
/// # Errors
/// [`Error::Invalid`] for ranges whose ends are not two increasing numbers, a start outside of
/// them, or a label without a locus; [`Error::NoOrbit`] where the start is not on it; those of
/// `plane` at the start.
pub fn locus(plane: &Plane<'_>, special: &Special, second: f64, ranges: [[f64; 2]; 2], most: usize) -> Result<Locus> {
    let start = [special.point.value, second];
    ranges.into_iter().zip(start).try_for_each(|(range, value)| check_range(range, value))?;
    if !Label::WITH_LOCUS.contains(&special.label) {
        let expected = "fold, period-doubling, symmetry-breaking, grazing-out or grazing-in";
        return Err(Error::invalid("locus", special.label, expected));
    }
    let problem = Problem::new(plane(start)?)?;
    let traced = Traced {
        plane,
        orbit: special.point.orbit.clone(),
        label: special.label,
        event: special.event,
        scales: problem.scales(),
        widths: ranges.map(|[low, high]| high - low),
    };
    let y = traced.gather(&problem, start);
    let along = unit(y.len(), y.len() - 1);
    let (y, tangent) = traced.correct(&y, &along)?;
    let ahead = traced.follow(y.clone(), tangent.clone(), ranges, most)?;
    let behind = traced.follow(y, -tangent, ranges, most)?;
    let mut points: Vec<OnLocus> = behind.0.into_iter().skip(1).rev().collect();
    points.extend(ahead.0);
    Ok(Locus { label: special.label, points, ends: [behind.1, ahead.1] })
}

struct Traced<'a> {
    plane: &'a Plane<'a>,
    orbit: Orbit,
    label: Label,
    event: usize,
    scales: Scales,
    /// The scales of the values of the keys: the widths of their ranges.
    widths: [f64; 2],
}

impl Traced<'_> {
    fn values(&self, y: &Vector) -> [f64; 2] {
        let n = y.len() - 2;
        [y[n] * self.widths[0], y[n + 1] * self.widths[1]]
    }

    fn problem(&self, y: &Vector) -> Result<Problem> {
        let problem = Problem::new((self.plane)(self.values(y))?)?;
        if self.orbit.signature.symmetric && !problem.is_symmetric() {
            return Err(Error::no_orbit("a key takes the scene's mirror symmetry away, which the orbit has"));
        }
        Ok(problem)
    }

    fn gather(&self, problem: &Problem, values: [f64; 2]) -> Vector {
        let unknowns = Equations::new(problem, &self.orbit.signature, self.scales).gather(&self.orbit);
        let keys = [values[0] / self.widths[0], values[1] / self.widths[1]];
        Vector::from_iterator(unknowns.len() + 2, unknowns.iter().copied().chain(keys))
    }

    /// The residual of the equations and the test function at `y`, in the scene of its keys.
    fn residual(&self, problem: &Problem, y: &Vector) -> Result<Vector> {
        let equations = Equations::new(problem, &self.orbit.signature, self.scales);
        let n = equations.unknowns();
        let mut residual = Vector::zeros(n);
        let mut jacobian = |turn: Closure| {
            let mut matrix = DMatrix::zeros(n, n);
            let into = Some((&mut matrix, turn));
            equations.evaluate(problem, &mut problem.arc(), y.as_slice(), &mut residual, into);
            matrix.determinant()
        };
        let test = match self.label {
            Label::Fold => jacobian(Closure::Same),
            Label::PeriodDoubling | Label::SymmetryBreaking => jacobian(Closure::Opposite),
            _ => {
                jacobian(Closure::Same);
                match self.label {
                    Label::GrazingOut => y[2 * self.event + 1],
                    _ => self.admissible(problem, y)?.nearest.map_or(1.0, |nearest| nearest.gap / self.scales.length),
                }
            }
        };
        Ok(extended(&residual, test))
    }

    fn admissible(&self, problem: &Problem, y: &Vector) -> Result<Admissible> {
        let equations = Equations::new(problem, &self.orbit.signature, self.scales);
        problem.admissible(&equations.orbit(y.as_slice(), problem))
    }

    /// The residual at `y` and its derivatives, (n + 1) × (n + 2), by differences. The test
    /// function has another magnitude: its row is scaled to that of the others.
    fn linear(&self, y: &Vector) -> Result<(Vector, DMatrix<f64>)> {
        let problem = self.problem(y)?;
        let mut residual = self.residual(&problem, y)?;
        let (count, last) = (y.len(), y.len() - 2);
        let mut matrix = DMatrix::zeros(count - 1, count);
        for column in 0..count {
            let moved = |step: f64| {
                let mut y = y.clone();
                y[column] += step;
                // The last two unknowns are the keys, which make another scene.
                if column < last { self.residual(&problem, &y) } else { self.residual(&self.problem(&y)?, &y) }
            };
            let slope = match (moved(DIFFERENCE), moved(-DIFFERENCE)) {
                (Ok(above), Ok(below)) => (above - below) / (2.0 * DIFFERENCE),
                (Ok(above), Err(_)) => (above - &residual) / DIFFERENCE,
                (Err(_), Ok(below)) => (&residual - below) / DIFFERENCE,
                (Err(error), Err(_)) => return Err(error),
            };
            matrix.set_column(column, &slope);
        }
        let size = matrix.row(last).amax().max(f64::MIN_POSITIVE);
        matrix.row_mut(last).iter_mut().for_each(|slope| *slope /= size);
        residual[last] /= size;
        Ok((residual, matrix))
    }

    /// The point of the locus in the plane through `guess` with the normal `border`, and the unit
    /// tangent there in the direction of that normal.
    fn correct(&self, guess: &Vector, border: &Vector) -> Result<(Vector, Vector)> {
        let mut y = guess.clone();
        for _ in 0..ITERATIONS {
            let (residual, matrix) = self.linear(&y)?;
            let right = extended(&residual, border.dot(&(&y - guess)));
            let step = bordered(&matrix, border).lu().solve(&right).ok_or_else(singular)?;
            let length = step.norm();
            if !length.is_finite() || length > 1.0 {
                return Err(Error::no_orbit("Newton's method led too far from the locus"));
            }
            y -= step;
            if length <= CLOSE {
                return Ok((y, tangent(&matrix, border).map_err(|_| singular())?));
            }
        }
        Err(Error::no_orbit("Newton's method did not converge"))
    }

    /// Why no body can follow the orbit at `y`, apart from the quantity that is 0 on the locus.
    fn reason(&self, problem: &Problem, y: &Vector) -> Result<Option<String>> {
        let mut found = self.admissible(problem, y)?;
        let least = self.orbit.signature.events.iter().enumerate().filter(|(i, event)| {
            event.kind != super::super::signature::Kind::Release
                && !(self.label == Label::GrazingOut && *i == self.event)
        });
        let least = least.map(|(i, _)| y[2 * i + 1]).fold(f64::INFINITY, f64::min);
        found.least_speed = if least > -ROUNDING { f64::INFINITY } else { least * self.scales.speed };
        for nearest in [&mut found.nearest, &mut found.nearest_change] {
            *nearest = nearest.filter(|nearest| nearest.gap < -ROUNDING * self.scales.length);
        }
        Ok(found.reason(problem.scene()))
    }

    fn follow(
        &self,
        mut y: Vector,
        mut tangent: Vector,
        ranges: [[f64; 2]; 2],
        most: usize,
    ) -> Result<(Vec<OnLocus>, End)> {
        let n = y.len() - 2;
        let mut points = vec![self.point(&self.problem(&y)?, &y)];
        let mut step = STEPS[0];
        while points.len() < most {
            let (next, turned) = match self.correct(&(&y + &tangent * step), &tangent) {
                Ok((next, turned)) if turns_little(&tangent, &turned) => (next, turned),
                tried => {
                    step *= 0.5;
                    if step < STEPS[2] {
                        let sharp = || End::Stuck("the locus turns too sharply".to_owned());
                        return Ok((points, tried.err().map_or_else(sharp, |error| End::of(&error))));
                    }
                    continue;
                }
            };
            let values = self.values(&next);
            if let Some((k, bound)) = (0..2).find_map(|k| Some((k, beyond(ranges[k], values[k])?))) {
                let share = (bound - self.values(&y)[k]) / (values[k] - self.values(&y)[k]);
                let mut guess = &y + (&next - &y) * share;
                guess[n + k] = bound / self.widths[k];
                if let Ok((last, _)) = self.correct(&guess, &unit(n + 2, n + k)) {
                    let mut last = self.point(&self.problem(&last)?, &last);
                    last.values[k] = bound;
                    points.push(last);
                }
                return Ok((points, End::Range));
            }
            let problem = self.problem(&next)?;
            if let Some(reason) = self.reason(&problem, &next)? {
                return Ok((points, End::Stuck(reason)));
            }
            points.push(self.point(&problem, &next));
            (y, tangent) = (next, turned);
            step = (step * GROWTH).min(STEPS[1]);
        }
        Ok((points, End::Points))
    }

    fn point(&self, problem: &Problem, y: &Vector) -> OnLocus {
        let orbit = Equations::new(problem, &self.orbit.signature, self.scales).orbit(y.as_slice(), problem);
        OnLocus { values: self.values(y), orbit }
    }
}

fn singular() -> Error {
    Error::no_orbit("the equations are singular there: two loci meet")
}
