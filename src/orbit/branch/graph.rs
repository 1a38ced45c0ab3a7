//! The graph of branches: which branch begins at which special point.

use super::super::periodic::Orbit;
use super::super::problem::Problem;
use super::super::shooting::Shot;
use super::arclength::check_range;
use super::curve::Curve;
use super::family::Family;
use super::net::Net;
use super::point::Point;
use super::request::{Graph, Request};
use super::shots::Shots;
use crate::error::{Error, Result};

/// Where branches begin: an orbit of one degree of freedom, or one of a structure.
#[derive(Debug, Clone, Copy)]
pub enum Start<'a> {
    /// An orbit of one degree of freedom, given by its events.
    Orbit(&'a Orbit),
    /// An orbit of a structure, given by one of its states.
    Shot(&'a Shot),
}

impl<'a> From<&'a Orbit> for Start<'a> {
    fn from(orbit: &'a Orbit) -> Self {
        Self::Orbit(orbit)
    }
}

impl<'a> From<&'a Shot> for Start<'a> {
    fn from(shot: &'a Shot) -> Self {
        Self::Shot(shot)
    }
}

/// Follows the orbits of `family` from `start`, an orbit at the key's value `value`, in both
/// directions, and switches to the branches that begin at special points. `seen` is called with
/// each point. An orbit of one degree of freedom is followed by its events, one of a structure
/// ([`shoot`](crate::orbit::shoot)) by its state once an orbit.
///
/// ```
/// use signorini::orbit::{Problem, branch};
/// use signorini::{Load, Scene, Wall};
///
/// // The source oscillator's symmetric orbit in the frequency: it ends at a fold.
/// let family = |frequency: f64| {
///     Ok(Scene::oscillator(1.0, 0.2, 100.0)
///         .with_wall(Wall::upper("upper", 5e-3).with_restitution(0.8))
///         .with_wall(Wall::lower("lower", -5e-3).with_restitution(0.8))
///         .with_load(Load::harmonic(3.0, frequency, 0.0)))
/// };
/// let start = Problem::new(family(5.0)?)?.settled(200)?;
/// let request = branch::Request { range: [5.0, 16.0], switch: branch::Switch::No, depth: 0, points: 2000 };
/// let graph = branch::graph(&family, &start, 5.0, &request, &mut |_| ())?;
/// let fold = graph.specials.iter().find(|special| special.label == branch::Label::Fold).unwrap();
/// assert!((fold.point.value - 14.610_019_877_539_26).abs() < 1e-9); // Hz
///
/// // The larger multiplier over the range.
/// for point in graph.branches[0].points.iter().step_by(50) {
///     let [re, im] = point.floquet.multipliers[0];
///     println!("{:.3} Hz: {:.4}", point.value, re.hypot(im));
/// }
/// # Ok::<(), signorini::Error>(())
/// ```
///
/// # Errors
/// [`Error::Invalid`] for a range whose ends are not two increasing numbers, or a start outside of
/// it; [`Error::NoOrbit`] for a start that is no orbit, one that no body can follow, or one of one
/// degree of freedom whose impacts accumulate; those of `family` at the start, and of a run.
pub fn graph<'s>(
    family: &Family<'_>,
    start: impl Into<Start<'s>>,
    value: f64,
    request: &Request,
    seen: &mut dyn FnMut(&Point),
) -> Result<Graph> {
    check_range(request.range, value)?;
    let [low, high] = request.range;
    let width = high - low;
    // If the key breaks the symmetry of the orbit, the whole orbit is followed instead of its half.
    let beside = if value + 1e-3 * width <= high { value + 1e-3 * width } else { value - 1e-3 * width };
    match start.into() {
        Start::Orbit(start) => {
            let problem = Problem::new(family(value)?)?;
            let keeps = Problem::new(family(beside)?)?.is_symmetric();
            let orbit = problem.correct(&if keeps { start.clone() } else { start.unfolded(problem.mirror()) })?;
            if let Some(reason) = problem.admissible(&orbit)?.reason(problem.scene()) {
                return Err(Error::no_orbit(format!("no body can follow the start: {reason}")));
            }
            let curve = Curve { family, signature: orbit.signature.clone(), scales: problem.scales(), width };
            let y = curve.gather(&problem, &orbit, value);
            Net::new(request).from(curve, y, seen)
        }
        Start::Shot(start) => {
            let (curve, y) = Shots::begin(family, start, value, beside, width)?;
            Net::new(request).from(curve, y, seen)
        }
    }
}
