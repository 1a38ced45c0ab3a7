//! The time up to which a pointwise comparison is meaningful, from the growth of a small change of
//! the start.
//!
//! For one degree of freedom the growth is exact. Along an exact run the derivative of the state
//! with respect to the start is a product of free flows and of jumps at events (saltation matrices;
//! Leine & Nijmeijer 2004, doi:10.1007/978-3-540-44398-8, ch. 7). On (u, v), with accelerations a⁻,
//! a⁺ before and after:
//!
//! rigid impact [[−e, 0], [(a⁺ + e a⁻)/v⁻, −e]];   elastic entry and exit [[1, 0], [(a⁺ − a⁻)/v,
//! 1]];   coming to rest 0.
//!
//! For several degrees of freedom the growth is estimated from below, by exact runs from slightly
//! perturbed starts; where the exact scheme cannot follow the scene, by such runs of a stepping
//! scheme.

pub use super::growth::{Growth, Source};

use super::perturbation;
use crate::error::Result;
use crate::scene::{Scene, System};
use crate::scheme::{Method, Scheme, Stepper};
use crate::step::Path;

/// A perturbation that has grown by this factor turns an error of 1e-3 of the gap into a tenth of
/// the gap: beyond that time, curves differ because the motion is sensitive, not because a scheme
/// is inaccurate.
pub const LARGEST_GROWTH: f64 = 1e2;

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
        let mut product = [[1.0, 0.0], [0.0, 1.0]];
        let (mut time, mut products, mut speed) = (vec![0.0], vec![product], 0.0_f64);
        // Acceleration at the end of the last arc, and the damping there: entering or leaving a
        // damped wall changes both.
        let mut last: Option<(f64, f64)> = None;
        while stepper.time() < scene.duration {
            let step = stepper.step()?;
            let Path::Exact(arc) = step.path else { break };
            let after = step.v.first().copied().unwrap_or(0.0);
            speed = speed.max(after.abs());
            if step.end > step.start {
                let before = arc.state(step.end).1;
                if let Some((a_before, _)) = last.filter(|l| l.1 != arc.damping()) {
                    let (_, v) = arc.state(step.start);
                    if v != 0.0 {
                        product = multiply([[1.0, 0.0], [(arc.acceleration(step.start) - a_before) / v, 1.0]], product);
                    }
                }
                product = multiply(arc.propagator(), product);
                let jumped = step.jump.iter().any(|&p| p != 0.0);
                let a_before = arc.acceleration(step.end);
                last = (!jumped).then_some((a_before, arc.damping()));
                if jumped && before != 0.0 {
                    let e = -after / before;
                    // At the impact the smooth force changes only through the velocity.
                    let a_after = a_before + (arc.damping() / arc.mass()) * (before - after);
                    product = multiply([[-e, 0.0], [(a_after + e * a_before) / before, -e]], product);
                }
            }
            time.push(step.end);
            products.push(product);
        }
        let (length, speed) = (scene.gap_scale(), if speed > 0.0 { speed } else { 1.0 });
        let scaled = |[[a, b], [c, d]]: [[f64; 2]; 2]| norm([[a, b * speed / length], [c * length / speed, d]]);
        Ok(Self { time, factor: products.into_iter().map(scaled).collect(), source: Source::Saltation })
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

fn multiply(a: [[f64; 2]; 2], b: [[f64; 2]; 2]) -> [[f64; 2]; 2] {
    let entry = |i: usize, j: usize| a[i][0] * b[0][j] + a[i][1] * b[1][j];
    [[entry(0, 0), entry(0, 1)], [entry(1, 0), entry(1, 1)]]
}

/// The largest singular value of a 2 × 2 matrix.
fn norm([[a, b], [c, d]]: [[f64; 2]; 2]) -> f64 {
    let sum = (a + d).hypot(c - b);
    let difference = (a - d).hypot(b + c);
    0.5 * (sum + difference)
}
