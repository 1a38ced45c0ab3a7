//! Orbits with one impact per period of the orbit in closed form, for any number of degrees of
//! freedom.
//!
//! One rigid wall with row G and gap g is struck once in N periods T = 2πN/Ω of one sine. With
//! E = exp(AT) the free part of the motion just before the impact is v w, w = (1 − E)⁻¹ E (0,
//! −(1+e)d), where d = M⁻¹Gᵀ/(G M⁻¹Gᵀ) and v is the approach speed. With B = G z the complex steady
//! motion at the wall, α = G w_q and β = G w_q̇,
//!
//! (g − αv)² + ((1 − β)v/Ω)² = |B|²,
//!
//! a quadratic in v, whose discriminant vanishes at a fold. Between mirrored walls a symmetric
//! orbit has E over half the time and (1 + E)⁻¹ E (0, (1+e)d).

use super::periodic::Orbit;
use super::problem::Problem;
use super::shooting::check_dense;
use super::signature::Signature;
use super::strobe::{is_stable, square};
use super::symmetry::mirror;
use crate::error::{Error, Result};
use crate::order::sort_by_number;
use crate::scene::{LoadKind, Scene, System, Wall, forcing_period, frequencies};
use crate::scheme::check_exact;
use nalgebra::{Complex, DMatrix, DVector};
use std::f64::consts::TAU;

/// An orbit with one impact per period of the orbit.
#[derive(Debug, Clone, PartialEq)]
pub struct ClosedForm {
    /// Index of the wall that it strikes; a symmetric one strikes the opposite wall too.
    pub wall: usize,
    /// Forcing periods of one orbit.
    pub periods: u32,
    /// True if it is its own mirror image half an orbit later.
    pub symmetric: bool,
    /// The instant of the impact, in cycles of the forcing period from t = 0, in [0, 1).
    pub phase: f64,
    /// Approach speed at the impact, m/s.
    pub speed: f64,
    /// Floquet multipliers over one orbit, real and imaginary parts, the largest first; 2n of them.
    pub multipliers: Vec<[f64; 2]>,
    /// Whether the motion between the impacts stays in front of all walls, at instants a fortieth
    /// of a radian of its fastest vibration apart; `None` where that are too many. For one degree
    /// of freedom [`Problem::admissible`] says it exactly.
    pub admissible: Option<bool>,
}

impl ClosedForm {
    /// True if all multipliers lie inside the unit circle.
    #[must_use]
    pub fn is_stable(&self) -> bool {
        is_stable(&self.multipliers)
    }

    /// The orbit of a problem of one degree of freedom.
    #[must_use]
    pub fn orbit(&self, problem: &Problem) -> Orbit {
        let signature = Signature { symmetric: self.symmetric, ..Signature::impacts(&[self.wall], self.periods) };
        Orbit {
            signature,
            phases: vec![self.phase],
            speeds: vec![self.speed],
            forcing_period: problem.forcing_period(),
        }
    }
}

/// M, C, K, the static displacement and the steady motion Im(z e^{iΩt}).
struct Linear {
    inverse_mass: DMatrix<f64>,
    damping: DMatrix<f64>,
    stiffness: DMatrix<f64>,
    still: DVector<f64>,
    steady: DVector<Complex<f64>>,
    amplitude: DVector<Complex<f64>>,
    constant: DVector<f64>,
    omega: f64,
    /// A.
    generator: DMatrix<f64>,
    /// e^{AT/2}, T the forcing period.
    half: DMatrix<f64>,
}

/// An impact that an orbit consists of.
struct Found {
    phase: f64,
    speed: f64,
    multipliers: Vec<[f64; 2]>,
    /// The free part of the state after it, the displacements first.
    free: DVector<f64>,
}

/// All orbits of `scene` that strike one rigid wall once in 1 to `most` forcing periods, or each of
/// two mirrored walls once in an odd number of them; for any number of degrees of freedom. Those
/// whose motion passes a wall between the impacts are among them, see [`ClosedForm::admissible`].
///
/// # Errors
/// [`Error::Invalid`] for a scene that does not validate, round walls, friction, loads other than
/// constants and sines of one frequency, more than 200 degrees of freedom, or a body that no spring
/// holds (its steady motion is not determined).
pub fn closed_forms(scene: &Scene, most: u32) -> Result<Vec<ClosedForm>> {
    scene.validate()?;
    if let Some(hole) = scene.holes().next() {
        let found = format!("round, at the support {:?}", hole.name);
        let expected = "walls and flats: in a round hole no orbit in closed form is known";
        return Err(Error::invalid("support", found, expected));
    }
    check_exact(scene, "orbits in closed form")?;
    let period = forcing_period(scene)?;
    let all = frequencies(scene);
    if all.len() > 1 {
        return Err(Error::invalid(
            "load",
            format!("sines of {} frequencies", all.len()),
            "sines of one frequency: orbits in closed form need this (a settled run does not)",
        ));
    }
    let linear = Linear::of(scene, TAU / period, period)?;
    let whole = &linear.half * &linear.half;
    let orbit = |wall: usize, periods: u32, symmetric: bool, found: Found| {
        let span = f64::from(periods) * period / if symmetric { 2.0 } else { 1.0 };
        let admissible = linear.stays_in_front(scene, &found, span);
        let Found { phase, speed, mut multipliers, .. } = found;
        if symmetric {
            multipliers.iter_mut().for_each(|one| *one = square(*one));
        }
        ClosedForm { wall, periods, symmetric, phase, speed, multipliers, admissible }
    };
    let opposite = mirror(scene, period);
    let mut found = Vec::new();
    for (index, wall) in scene.walls.iter().enumerate() {
        let Some(restitution) = wall.law.restitution() else { continue };
        let (mut full, mut part) = (whole.clone(), linear.half.clone());
        for periods in 1..=most {
            linear.solve(wall, restitution, &full, 1.0, &mut |one| found.push(orbit(index, periods, false, one)));
            // Each pair of walls is looked at once.
            if periods % 2 == 1 && opposite.as_ref().and_then(|of| of.get(index)).is_some_and(|other| index < *other) {
                linear.solve(wall, restitution, &part, -1.0, &mut |one| found.push(orbit(index, periods, true, one)));
            }
            full = &full * &whole;
            if periods % 2 == 1 {
                part = &part * &whole;
            }
        }
    }
    Ok(found)
}

/// The instants at which the motion between impacts is looked at are so many radians of its fastest
/// vibration apart.
const RADIANS: f64 = 0.025;

/// A motion behind a wall by less than this share of the gap touches it: more than what it does
/// between two instants, (0.025)²/8 of the vibration.
const CLEAR: f64 = 1e-4;

/// Most multiplications for the instants of one orbit.
const MOST_WORK: f64 = 2e9;

/// A speed below this share of those of the steady motion is rounding.
const ROUNDING: f64 = 1e-12;

impl Linear {
    fn of(scene: &Scene, omega: f64, period: f64) -> Result<Self> {
        let n = scene.system.degrees_of_freedom();
        check_dense(scene, "closed forms")?;
        let (mass, damping, stiffness) = match &scene.system {
            System::Oscillator(body) => {
                let one = |x: f64| DMatrix::from_element(1, 1, x);
                (one(body.mass), one(body.damping), one(body.stiffness))
            }
            System::Structure(s) => {
                let dense = |m: &crate::linear::Symmetric| DMatrix::from_fn(n, n, |i, j| m.get(i, j));
                (dense(&s.mass), dense(&s.damping), dense(&s.stiffness))
            }
        };
        let free = || {
            let expected = "a structure that springs hold, not at the resonance of an undamped \
                one: else its steady motion is not determined (a settled run needs none)";
            Error::invalid("system", "without a steady motion", expected)
        };
        let inverse_mass = mass.clone().try_inverse().ok_or_else(free)?;
        let (mut amplitude, mut constant) = (DVector::from_element(n, Complex::new(0.0, 0.0)), DVector::zeros(n));
        for load in &scene.loads {
            for &(dof, weight) in load.at.entries() {
                match load.kind {
                    LoadKind::Constant { force } => constant[dof] += weight * force,
                    LoadKind::Harmonic { amplitude, phase, frequency: 0.0 } => {
                        constant[dof] += weight * amplitude * phase.sin();
                    }
                    LoadKind::Harmonic { amplitude: a, phase, .. } => {
                        amplitude[dof] += Complex::from_polar(weight * a, phase);
                    }
                    _ => {}
                }
            }
        }
        let still = if constant.amax() == 0.0 {
            DVector::zeros(n)
        } else {
            stiffness.clone().lu().solve(&constant).ok_or_else(free)?
        };
        let dynamic = DMatrix::from_fn(n, n, |i, j| {
            Complex::new(stiffness[(i, j)] - omega * omega * mass[(i, j)], omega * damping[(i, j)])
        });
        let steady = dynamic.lu().solve(&amplitude).ok_or_else(free)?;
        if !still.iter().chain(steady.iter().flat_map(|z| [&z.re, &z.im])).all(|x| x.is_finite()) {
            return Err(free());
        }
        let mut a = DMatrix::zeros(2 * n, 2 * n);
        a.view_mut((0, n), (n, n)).fill_with_identity();
        a.view_mut((n, 0), (n, n)).copy_from(&(-&inverse_mass * &stiffness));
        a.view_mut((n, n), (n, n)).copy_from(&(-&inverse_mass * &damping));
        let half = (&a * (0.5 * period)).exp();
        Ok(Self { inverse_mass, damping, stiffness, still, steady, amplitude, constant, omega, generator: a, half })
    }

    /// Calls `take` with the impact of each orbit whose flight has the propagator `e` and ends
    /// where it began (`sign` 1) or in the mirror image (−1).
    fn solve(&self, wall: &Wall, restitution: f64, e: &DMatrix<f64>, sign: f64, take: &mut dyn FnMut(Found)) {
        let n = self.still.len();
        // The row towards the wall, and the gap in its direction.
        let toward = -wall.side().sign();
        let mut row = DVector::zeros(n);
        wall.row().add_transposed(1.0, row.as_mut_slice());
        row *= toward;
        let direction = &self.inverse_mass * &row;
        let direction = &direction / row.dot(&direction);
        let gap = toward * wall.position() - row.dot(&self.still);
        let mut jump = DVector::zeros(2 * n);
        jump.rows_mut(n, n).copy_from(&(&direction * (-(1.0 + restitution))));
        // y⁻ = sign E (y⁻ + v jump).
        let system = DMatrix::identity(2 * n, 2 * n) - e * sign;
        let Some(w) = system.lu().solve(&(e * &jump * sign)) else { return };
        let (alpha, beta) = (row.dot(&w.rows(0, n)), row.dot(&w.rows(n, n)));
        let response: Complex<f64> = row.iter().zip(self.steady.iter()).map(|(g, z)| z * *g).sum();
        let slope = (1.0 - beta) / self.omega;
        let (a, b, c) = (alpha * alpha + slope * slope, alpha * gap, gap * gap - response.norm_sqr());
        let discriminant = b * b - a * c;
        if discriminant.is_nan() || discriminant < 0.0 {
            return;
        }
        let large = b + discriminant.sqrt().copysign(b);
        let speeds = if large == 0.0 { [0.0, 0.0] } else { [large / a, c / large] };
        for (index, speed) in speeds.into_iter().enumerate() {
            // Where free motion repeats itself over the flight, 1 - E is singular but for rounding,
            // and the speed rounding alone: no impact leaves the motion as it is.
            let rounding = ROUNDING * self.omega * gap.hypot(response.norm());
            if !(speed > rounding && speed.is_finite()) || (index == 1 && speed == speeds[0]) {
                continue;
            }
            // The steady motion at the wall is Im(B e^{iΩt}), its velocity over Ω the real part.
            let angle = (gap - alpha * speed).atan2(slope * speed) - response.arg();
            let phase = (angle / TAU).rem_euclid(1.0);
            let multipliers = self.multipliers(&row, &direction, restitution, e, sign, &w, speed, phase);
            take(Found { phase, speed, multipliers, free: (&w + &jump) * speed });
        }
    }

    #[expect(clippy::too_many_arguments, reason = "one formula, of these parts")]
    fn multipliers(
        &self,
        row: &DVector<f64>,
        direction: &DVector<f64>,
        restitution: f64,
        e: &DMatrix<f64>,
        sign: f64,
        w: &DVector<f64>,
        speed: f64,
        phase: f64,
    ) -> Vec<[f64; 2]> {
        let n = row.len();
        let turn = Complex::from_polar(1.0, TAU * phase);
        let q: DVector<f64> = DVector::from_fn(n, |i, _| self.still[i] + (self.steady[i] * turn).im + speed * w[i]);
        let before: DVector<f64> =
            DVector::from_fn(n, |i, _| self.omega * (self.steady[i] * turn).re + speed * w[n + i]);
        let after = &before - direction * ((1.0 + restitution) * speed);
        let load = DVector::from_fn(n, |i, _| self.constant[i] + (self.amplitude[i] * turn).im);
        let acceleration = |v: &DVector<f64>| &self.inverse_mass * (&load - &self.damping * v - &self.stiffness * &q);
        let reset = DMatrix::identity(n, n) - direction * row.transpose() * (1.0 + restitution);
        let shear = (acceleration(&after) - &reset * acceleration(&before)) * row.transpose() / speed;
        let mut saltation = DMatrix::zeros(2 * n, 2 * n);
        saltation.view_mut((0, 0), (n, n)).copy_from(&reset);
        saltation.view_mut((n, 0), (n, n)).copy_from(&shear);
        saltation.view_mut((n, n), (n, n)).copy_from(&reset);
        let values = (e * saltation * sign).complex_eigenvalues();
        let mut values: Vec<[f64; 2]> = values.iter().map(|z| [z.re, z.im]).collect();
        sort_by_number(&mut values, |a| -a[0].hypot(a[1]));
        values
    }

    /// Whether the motion over `span` seconds after the impact stays in front of all walls of
    /// `scene`; `None` where the instants are too many.
    fn stays_in_front(&self, scene: &Scene, impact: &Found, span: f64) -> Option<bool> {
        let n = self.still.len();
        let [_, fastest] = scene.system.frequencies();
        let count = (span * fastest.max(self.omega) / RADIANS).ceil().max(1.0);
        if count * (2 * n).pow(2) as f64 > MOST_WORK {
            return None;
        }
        let dt = span / count;
        let (step, mut free) = ((&self.generator * dt).exp(), impact.free.clone());
        let below = -CLEAR * scene.gap_scale();
        let mut number = 1.0;
        // The impact at the end is the orbit's own.
        while number < count {
            free = &step * free;
            let turn = Complex::from_polar(1.0, TAU * impact.phase + self.omega * (number * dt));
            let place = |i: usize| self.still[i] + (self.steady[i] * turn).im + free[i];
            let behind = |wall: &Wall| {
                let along: f64 = wall.row().entries().iter().map(|&(i, weight)| weight * place(i)).sum();
                wall.gap(along) < below
            };
            if scene.walls.iter().any(behind) {
                return Some(false);
            }
            number += 1.0;
        }
        Some(true)
    }
}
