//! The time up to which a pointwise comparison is meaningful, from the growth of a small change of
//! the start.
//!
//! For one degree of freedom the growth is exact: the derivative of the state with respect to the
//! start, along an exact run ([`variation`](crate::variation)). A rest on a rigid wall ends every
//! change of what came before; from then on it is that of the state in which the body leaves, which
//! a scheme meets with an error of its own.
//!
//! For several degrees of freedom the growth is estimated from below, by exact runs from slightly
//! perturbed starts; where the exact scheme cannot follow the scene, by such runs of a stepping
//! scheme.

pub use super::growth::{Growth, Source};

use super::exact::affordable;
use super::perturbation;
use crate::error::Result;
use crate::scene::{Scene, System};
use crate::scheme::{Method, Scheme, Stepper};
use crate::step::Path;
use crate::variation::Product;
use nalgebra::DMatrix;

/// A perturbation that has grown by this factor turns an error of 1e-3 of the gap into a tenth of
/// the gap: beyond that time, curves differ because the motion is sensitive, not because a scheme
/// is inaccurate.
pub const LARGEST_GROWTH: f64 = 1e2;

/// True where the body at `q` touches a wall with a dashpot. A body that arrives earlier by δt is
/// slower by c v δt/m there, however large c/m is, until the dashpot has slowed the other as well,
/// m/c later: what differs for so short a time says nothing of the motion. Until the body has left,
/// or the run ends, the change before it came counts.
fn at_dashpot(scene: &Scene, q: &[f64]) -> bool {
    let near = 1e-9 * scene.gap_scale();
    scene.walls.iter().any(|wall| wall.law.is_damped() && wall.gap(wall.row().dot(q)) <= near)
}

impl Growth {
    /// The growth along the exact run of `scene`.
    ///
    /// # Errors
    /// Errors of the exact scheme.
    pub fn of(scene: &Scene) -> Result<Self> {
        match scene.system {
            System::Oscillator(_) => Self::by_saltation(scene),
            _ => perturbation::growth(scene, &Method::new(Scheme::Event), scene.duration, perturbation::SMALL),
        }
    }

    /// As [`Growth::of`], where the exact motion is affordable.
    ///
    /// # Errors
    /// [`crate::Error::TooManyEvents`] where it is not, and errors of the exact scheme.
    pub fn affordable(scene: &Scene) -> Result<Self> {
        if let System::Oscillator(_) = scene.system {
            affordable(scene)?;
        }
        // Of a structure the beginnings are checked.
        Self::of(scene)
    }

    /// A lower bound of the growth along the run of `scene` by `method` with steps of `step` (s),
    /// for a perturbation as large as the errors that are compared: a thousandth of the largest
    /// speed.
    ///
    /// # Errors
    /// Errors of the runs.
    pub fn by_runs(scene: &Scene, method: &Method, step: f64) -> Result<Self> {
        perturbation::growth(scene, method, step, perturbation::COMPARED)
    }

    /// The same for a perturbation just above rounding.
    pub(super) fn of_rounding(scene: &Scene, method: &Method, step: f64) -> Result<Self> {
        perturbation::growth(scene, method, step, perturbation::SMALL)
    }

    fn by_saltation(scene: &Scene) -> Result<Self> {
        let mut stepper = Stepper::new(scene, &Scheme::Event, scene.duration)?;
        let (mut product, gap) = (Product::new(scene)?, scene.gap());
        let (mut time, mut products, mut speed) = (vec![0.0], vec![product.matrix().clone()], 0.0_f64);
        let (start, mut way) = (scene.initial.q.first().copied().unwrap_or(0.0), 0.0_f64);
        while stepper.time() < scene.duration {
            let step = stepper.step()?;
            // A change that an impact makes grow has not grown before it.
            if let (Path::Exact(arc), true) = (step.path, step.jump.iter().any(|&p| p != 0.0)) {
                let [[a, b], [c, d]] = arc.propagator();
                time.push(step.end);
                products.push(DMatrix::from_row_slice(2, 2, &[a, b, c, d]) * product.matrix());
            }
            if let (Path::Exact(arc), None) = (step.path, gap) {
                let within = |part: i32| arc.state(step.start + f64::from(part) / 4.0 * (step.end - step.start)).0;
                way = (1..=4).map(within).fold(way, |most, q| most.max((q - start).abs()));
            }
            // Without a derivative the change may be anything from here on.
            let known = product.observe(&step).is_ok();
            speed = speed.max(step.v.first().copied().unwrap_or(0.0).abs());
            let before = products.last().filter(|_| step.end < scene.duration && at_dashpot(scene, step.q)).cloned();
            let now = || before.unwrap_or_else(|| product.matrix().clone());
            time.push(step.end);
            products.push(if known { now() } else { DMatrix::from_element(2, 2, f64::NAN) });
            if !known {
                break;
            }
            if product.matrix().iter().all(|entry| *entry == 0.0) {
                product.restart();
            }
        }
        // Without a gap, as of a body that starts on a wall, the way that it goes is the length.
        let length = if way > 0.0 { way } else { scene.gap_scale() };
        let speed = if speed > 0.0 { speed } else { 1.0 };
        // Between far walls the free vibration relates speeds to displacements, not the gap: by the
        // gap a vibration without contact would grow.
        let [natural, _] = scene.system.frequencies();
        // Without a gap the vibration on an elastic wall does.
        let pressed = if gap.is_some() { natural } else { natural.hypot(stiffest(scene).sqrt()) };
        let rate = (speed / length).max(pressed);
        Ok(Self { time, factor: products.iter().map(|m| norm(m, rate)).collect(), source: Source::Saltation })
    }

    /// The time up to which no perturbation has grown by more than `most`; the end of the run if
    /// none ever does.
    #[must_use]
    pub fn horizon(&self, most: f64) -> f64 {
        let last = self.time.last().copied().unwrap_or(0.0);
        let mut before = 0.0;
        for (&t, &factor) in self.time.iter().zip(&self.factor) {
            if factor.is_nan() || factor > most {
                return before;
            }
            before = t;
        }
        last
    }

    /// The largest growth up to `time` (s). Where perturbed runs have separated completely, it
    /// counts as [`LARGEST_GROWTH`].
    #[must_use]
    pub fn until(&self, time: f64) -> f64 {
        let rows = self.time.iter().zip(&self.factor).filter(|(t, _)| **t <= time);
        rows.map(|(_, f)| if f.is_nan() { LARGEST_GROWTH } else { *f }).fold(1.0, f64::max)
    }
}

/// The largest stiffness of a wall over the mass that it feels, 1/s².
fn stiffest(scene: &Scene) -> f64 {
    let each = scene.walls.iter().zip(scene.wall_masses());
    each.map(|(wall, mass)| wall.law.tangent(f64::MIN_POSITIVE) / mass).fold(0.0, f64::max)
}

/// The largest singular value of a 2 × 2 matrix, with velocities counted in units of `rate` (1/s)
/// times displacements.
fn norm(matrix: &DMatrix<f64>, rate: f64) -> f64 {
    let entry = |row: usize, column: usize| matrix.get((row, column)).map_or(f64::NAN, |x| *x);
    let (a, b, c, d) = (entry(0, 0), entry(0, 1) * rate, entry(1, 0) / rate, entry(1, 1));
    let sum = (a + d).hypot(c - b);
    let difference = (a - d).hypot(b + c);
    0.5 * (sum + difference)
}
