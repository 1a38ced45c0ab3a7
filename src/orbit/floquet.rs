//! Floquet multipliers: how a small change of an orbit has grown one period later.

use super::boundary::BoundaryLaw;
use super::periodic::Orbit;
use super::problem::Problem;
use super::signature::Kind;
use super::strobe::{is_stable, square};
use crate::error::Result;
use crate::variation::saltation::{IDENTITY, Matrix2, entry, impact, multiply};

/// The Floquet multipliers of an orbit.
///
/// The derivative of the state one period later with respect to the state now is the product of the
/// propagators Φ of the flights and of the saltation matrices S of the events (Leine & Nijmeijer
/// 2004, doi:10.1007/978-3-540-44398-8), in the order in which they happen; the multipliers are its
/// eigenvalues. For an impact at velocity q̇ with accelerations a⁻ before and a⁺ after it,
///
/// S = [[−e, 0], [(a⁺ + e a⁻)/q̇, −e]],
///
/// which grows without bound towards a grazing impact, for one degree of freedom; [`variation`] has
/// that of structures. With one degree of freedom, the motion after a rest does not depend on that
/// before: S = 0. The product of all multipliers is e₁² e₂² … exp(−cT/m) there.
///
/// [`variation`]: crate::variation
#[derive(Debug, Clone, PartialEq)]
pub struct Floquet {
    /// The multipliers over the period of the orbit, real and imaginary part, the largest first: 2n
    /// of them for n degrees of freedom.
    pub multipliers: Vec<[f64; 2]>,
    /// For a symmetric orbit the multipliers of its half map (half an orbit and the mirror), whose
    /// squares `multipliers` are.
    pub half: Option<Vec<[f64; 2]>>,
    /// Trace of the derivative, that of the half map for a symmetric orbit.
    pub trace: f64,
    /// Its determinant.
    pub determinant: f64,
}

impl Floquet {
    /// True if all multipliers lie inside the unit circle: runs settle on such orbits.
    #[must_use]
    pub fn is_stable(&self) -> bool {
        is_stable(&self.multipliers)
    }

    /// The multipliers of a 2 × 2 derivative with the given trace and determinant, over half an
    /// orbit (`half`) or a whole one.
    fn new(trace: f64, determinant: f64, half: bool) -> Self {
        Self::of(eigenvalues(trace, determinant).to_vec(), [trace, determinant], half)
    }

    /// The multipliers of a derivative with the eigenvalues `own` and the given trace and
    /// determinant, over half an orbit (`half`) or a whole one.
    pub(super) fn of(own: Vec<[f64; 2]>, [trace, determinant]: [f64; 2], half: bool) -> Self {
        if !half {
            return Self { multipliers: own, half: None, trace, determinant };
        }
        Self { multipliers: own.iter().copied().map(square).collect(), half: Some(own), trace, determinant }
    }
}

/// Both roots of μ² − trace μ + determinant, without cancellation in the smaller.
fn eigenvalues(trace: f64, determinant: f64) -> [[f64; 2]; 2] {
    let mean = 0.5 * trace;
    let square = mean * mean - determinant;
    if square < 0.0 {
        let imaginary = (-square).sqrt();
        return [[mean, imaginary], [mean, -imaginary]];
    }
    let large = mean + square.sqrt().copysign(mean);
    let small = if large == 0.0 { 0.0 } else { determinant / large };
    [[large, 0.0], [small, 0.0]]
}

impl Problem {
    /// The Floquet multipliers of `orbit`. At an impact of speed 0 they are infinite.
    ///
    /// # Errors
    /// As [`Problem::correct`] for an orbit that does not belong to this problem.
    pub fn floquet(&self, orbit: &Orbit) -> Result<Floquet> {
        self.check(orbit)?;
        let signature = &orbit.signature;
        let sign = if signature.symmetric { -1.0 } else { 1.0 };
        let mut arc = self.arc();
        if signature.events.is_empty() {
            self.fly(&mut arc, [0.0; 2], [0.0, signature.cycles() * self.forcing_period()], &[], None);
            let [[a, b], [c, d]] = arc.propagator();
            return Ok(Floquet::new(sign * (a + d), a * d - b * c, signature.symmetric));
        }
        if signature.rests() {
            return Ok(Floquet::new(0.0, 0.0, signature.symmetric));
        }
        let touching = self.touching(signature);
        let count = signature.events.len();
        // The accelerations at both ends of each flight, and its propagator.
        let mut flights = Vec::with_capacity(count);
        for (index, event) in signature.events.iter().enumerate() {
            let Some(boundary) = self.boundary(event.wall) else { continue };
            let from = boundary.after(event.kind, orbit.speeds[index]);
            let start = orbit.phases[index] * self.forcing_period();
            let span = orbit.next_phase(index) * self.forcing_period() - start;
            self.fly(&mut arc, from.state, [start, span], &touching[index], None);
            flights.push((arc.start_jet()[2], arc.jet(span)[2], arc.propagator()));
        }
        let mut whole = IDENTITY;
        let mut determinant = 1.0;
        for (index, event) in signature.events.iter().enumerate() {
            let (Some(boundary), Some((after, _, phi))) = (self.boundary(event.wall), flights.get(index)) else {
                continue;
            };
            let before = match index {
                0 => flights.last().map_or(0.0, |flight| sign * flight.1),
                _ => flights[index - 1].1,
            };
            let saltation = match (event.kind, boundary.law) {
                (Kind::Impact, BoundaryLaw::Rigid(e)) => {
                    impact(e, boundary.toward * orbit.speeds[index], [before, *after])
                }
                (Kind::Enter, BoundaryLaw::Elastic { damping, .. }) => entry(damping, self.body().mass),
                _ => IDENTITY,
            };
            let size = |m: &Matrix2| m[0][0] * m[1][1] - m[0][1] * m[1][0];
            determinant *= size(&saltation) * size(phi);
            whole = multiply(*phi, multiply(saltation, whole));
        }
        Ok(Floquet::new(sign * (whole[0][0] + whole[1][1]), determinant, signature.symmetric))
    }
}
