//! The derivatives of a periodic orbit of one degree of freedom with respect to keys.
//!
//! With r(u; λ) = 0 the equations of the orbit, its unknowns u (phases and speeds) change by
//!
//! δu = −(∂r/∂u)⁻¹ ∂r/∂λ.
//!
//! The multipliers follow from these changes, see `monodromy_derivative.rs`. A symmetric orbit is
//! differentiated as a whole: a key may change one of two mirrored walls alone.

use super::equations::{CYCLE, Closure, Equations};
use super::periodic::Orbit;
use super::problem::Problem;
use super::signature::Event;
use crate::error::{Error, Result};
use crate::variation::SceneTangent;
use nalgebra::{DMatrix, DVector};

/// Below this share of its largest singular value the least one of the equations is that of a fold:
/// rounding over it leaves fewer than eight digits.
const FOLD: f64 = 1e-8;

/// Above this residual, in gaps, phases and speeds are not those of an orbit.
const SOLVED: f64 = 1e-6;

/// The derivatives of a periodic orbit of one degree of freedom with respect to several keys.
#[derive(Debug, Clone, PartialEq)]
#[non_exhaustive]
pub struct OrbitDerivative {
    /// Of the forcing period, s per unit of each key.
    pub forcing_period: Vec<f64>,
    /// Of the phase of each event, cycles per unit of each key: for each event a list of keys. For
    /// a symmetric orbit the events of both halves, as [`Problem::whole`] has them.
    pub phases: Vec<Vec<f64>>,
    /// Of the speed of each event, m/s per unit of each key.
    pub speeds: Vec<Vec<f64>>,
    /// Of real and imaginary part of each multiplier, in the order of
    /// [`Floquet::multipliers`](super::Floquet::multipliers), per unit of each key. `None` where
    /// two multipliers coincide: they part like a square root, whose derivative is infinite.
    pub multipliers: Option<Vec<Vec<[f64; 2]>>>,
    /// Of [`Floquet::trace`](super::Floquet::trace) of the whole orbit, per unit of each key.
    pub trace: Vec<f64>,
    /// Of [`Floquet::determinant`](super::Floquet::determinant) of the whole orbit, per unit of
    /// each key.
    pub determinant: Vec<f64>,
}

impl Problem {
    /// The derivatives of `orbit`, a solution of the equations ([`Problem::correct`]), with respect
    /// to the keys of `tangents`: of its phases, its speeds and its Floquet multipliers. They are
    /// exact; no orbit beside this one is computed.
    ///
    /// ```
    /// use signorini::orbit::Problem;
    /// use signorini::variation::SceneTangent;
    /// use signorini::{Load, Scene, Wall};
    ///
    /// let scene = |e: f64| {
    ///     Ok(Scene::oscillator(1.0, 0.2, 100.0)
    ///         .with_wall(Wall::upper("stop", 5e-3).with_restitution(e))
    ///         .with_load(Load::harmonic(3.0, 2.5, 0.0)))
    /// };
    /// let problem = Problem::new(scene(0.6)?)?;
    /// let orbit = problem.settled(200)?;
    /// let by = problem.derivative(&orbit, &[SceneTangent::new("restitution", 0.6, scene)?])?;
    /// // One impact a period: the product of the multipliers is e² exp(−c T/m).
    /// let expected = 2.0 * 0.6 * (-0.2 * orbit.period()).exp();
    /// assert!((by.determinant[0] - expected).abs() < 1e-12);
    /// # Ok::<(), signorini::Error>(())
    /// ```
    ///
    /// # Errors
    /// [`Error::Invalid`] for an orbit that does not belong to this problem, or a key that changes
    /// the frequencies of the loads by different shares; [`Error::NoOrbit`] where phases and speeds
    /// are no solution, impacts accumulate, or an impact has the speed 0, and at a fold.
    pub fn derivative(&self, orbit: &Orbit, tangents: &[SceneTangent]) -> Result<OrbitDerivative> {
        self.check(orbit)?;
        if orbit.signature.chatters() {
            return Err(Error::no_orbit("impacts that accumulate are infinitely many: such an orbit is not solved"));
        }
        let orbit = &self.whole(orbit);
        let equations = Equations::new(self, &orbit.signature, self.scales());
        let unknowns = equations.gather(orbit);
        let longer: Vec<f64> =
            tangents.iter().map(|one| one.period(self.scene(), self.forcing_period())).collect::<Result<_>>()?;
        let changes = self.changes(&equations, &unknowns, tangents)?;
        let of = |offset: usize, scale: f64| {
            let events = 0..orbit.signature.events.len();
            let each = |event: usize| changes.iter().map(|change| scale * change[2 * event + offset]).collect();
            events.map(each).collect::<Vec<Vec<f64>>>()
        };
        let (phases, speeds) = (of(0, CYCLE), of(1, equations.scales.speed));
        let floquet = self.floquet(orbit)?;
        let (mut traces, mut determinants, mut multipliers) = (Vec::new(), Vec::new(), Vec::new());
        for ((tangent, change), longer) in tangents.iter().zip(&changes).zip(&longer) {
            let by = self.monodromy_derivative(&equations, [&unknowns, change], tangent, *longer);
            if !by.iter().all(|x| x.is_finite()) {
                return Err(Error::no_orbit(
                    "an impact has the speed 0, or two events coincide: there is no derivative",
                ));
            }
            traces.push(by[0]);
            determinants.push(by[1]);
            multipliers.push(floquet.derivative(by));
        }
        let by_key: Option<Vec<Vec<[f64; 2]>>> = multipliers.into_iter().collect();
        let count = floquet.multipliers.len();
        let turned = |by_key: Vec<Vec<[f64; 2]>>| {
            let of = |index: usize| by_key.iter().filter_map(|one| one.get(index).copied()).collect();
            (0..count).map(of).collect()
        };
        Ok(OrbitDerivative {
            forcing_period: longer,
            phases,
            speeds,
            multipliers: by_key.map(turned),
            trace: traces,
            determinant: determinants,
        })
    }

    /// The orbit by the events of its whole period: of a symmetric one those of the first half,
    /// then those of its mirror image. The same orbit for a problem that is not symmetric.
    #[must_use]
    pub fn whole(&self, orbit: &Orbit) -> Orbit {
        let Some(mirror) = self.mirror().filter(|_| orbit.signature.symmetric) else { return orbit.clone() };
        let mut whole = orbit.clone();
        whole.signature.symmetric = false;
        let opposite = |event: &Event| mirror.get(event.wall).map(|&wall| Event { wall, ..*event });
        whole.signature.events.extend(orbit.signature.events.iter().filter_map(opposite));
        whole.phases.extend(orbit.phases.iter().map(|phase| phase + orbit.signature.cycles()));
        whole.speeds.extend(&orbit.speeds);
        whole
    }

    /// The change of the scaled unknowns by each key.
    fn changes(
        &self,
        equations: &Equations<'_>,
        unknowns: &DVector<f64>,
        tangents: &[SceneTangent],
    ) -> Result<Vec<DVector<f64>>> {
        let (n, mut arc) = (equations.unknowns(), self.arc());
        if n == 0 {
            return Ok(vec![DVector::zeros(0); tangents.len()]);
        }
        let (mut residual, mut matrix) = (DVector::zeros(n), DMatrix::zeros(n, n));
        let jacobian = Some((&mut matrix, Closure::Same));
        equations.evaluate(self, &mut arc, unknowns.as_slice(), &mut residual, jacobian);
        let missed = residual.amax();
        if missed.is_nan() || missed > SOLVED {
            return Err(Error::no_orbit(format!(
                "these phases and speeds are no orbit: they miss one by {missed:.1e} of the gap"
            )));
        }
        let singular = matrix.singular_values();
        if singular.min() < FOLD * singular.max() {
            return Err(Error::no_orbit("at a fold of its branch an orbit has no derivative"));
        }
        let factors = matrix.lu();
        let change = |tangent: &SceneTangent, arc: &mut _| {
            let column = equations.by_key(self, arc, unknowns.as_slice(), tangent)?;
            let solved = factors.solve(&column).map(|change| -change);
            solved.ok_or_else(|| Error::no_orbit("at a fold of its branch an orbit has no derivative"))
        };
        tangents.iter().map(|tangent| change(tangent, &mut arc)).collect()
    }
}
