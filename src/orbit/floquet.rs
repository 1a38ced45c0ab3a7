//! Floquet multipliers: how a small change of an orbit has grown one period later.

use super::boundary::BoundaryLaw;
use super::periodic::Orbit;
use super::problem::Problem;
use super::signature::Kind;
use super::strobe::{Scales, is_stable, largest_first, square};
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
    /// squares `multipliers` are, in an order of their own.
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
        let mut multipliers: Vec<[f64; 2]> = own.iter().copied().map(square).collect();
        multipliers.sort_by(|a, b| largest_first(*a, *b));
        Self { multipliers, half: Some(own), trace, determinant }
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

/// The flight after an event of an orbit.
struct FlightMap {
    /// The rates of the state at its start and at its end: velocity and acceleration, m/s, m/s².
    rates: [[f64; 2]; 2],
    /// The derivative of the state at its end with respect to that at its start.
    propagator: Matrix2,
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
        if signature.events.is_empty() {
            let mut arc = self.arc();
            self.fly(&mut arc, [0.0; 2], [0.0, signature.cycles() * self.forcing_period()], &[], None);
            let [[a, b], [c, d]] = arc.propagator();
            return Ok(Floquet::new(sign * (a + d), a * d - b * c, signature.symmetric));
        }
        if signature.rests() {
            return Ok(Floquet::new(0.0, 0.0, signature.symmetric));
        }
        let flights = self.flight_maps(orbit);
        let mut whole = IDENTITY;
        let mut determinant = 1.0;
        let size = |m: &Matrix2| m[0][0] * m[1][1] - m[0][1] * m[1][0];
        for (index, flight) in flights.iter().enumerate() {
            let saltation = self.saltation(orbit, &flights, index);
            determinant *= size(&saltation) * size(&flight.propagator);
            whole = multiply(flight.propagator, multiply(saltation, whole));
        }
        Ok(Floquet::new(sign * (whole[0][0] + whole[1][1]), determinant, signature.symmetric))
    }

    /// The flight after each event of `orbit`.
    fn flight_maps(&self, orbit: &Orbit) -> Vec<FlightMap> {
        let signature = &orbit.signature;
        let touching = self.touching(signature);
        let mut arc = self.arc();
        let maps = signature.events.iter().enumerate().map(|(index, event)| {
            let boundary = self.boundary(event.wall)?;
            let from = boundary.after(event.kind, *orbit.speeds.get(index)?);
            let start = orbit.phases.get(index)? * self.forcing_period();
            let span = orbit.next_phase(index) * self.forcing_period() - start;
            self.fly(&mut arc, from.state, [start, span], touching.get(index)?, None);
            let rates = [arc.start_jet(), arc.jet(span)].map(|jet| [jet[1], jet[2]]);
            Some(FlightMap { rates, propagator: arc.propagator() })
        });
        maps.map_while(|map| map).collect()
    }

    /// The saltation matrix of event number `index` of `orbit`, between its `flights`.
    fn saltation(&self, orbit: &Orbit, flights: &[FlightMap], index: usize) -> Matrix2 {
        let end = |flight: Option<&FlightMap>| flight.map_or(0.0, |flight| flight.rates[1][1]);
        let before = match index.checked_sub(1) {
            Some(last) => end(flights.get(last)),
            None if orbit.signature.symmetric => -end(flights.last()),
            None => end(flights.last()),
        };
        let after = flights.get(index).map_or(0.0, |flight| flight.rates[0][1]);
        let event = orbit.signature.events.get(index);
        let boundary = event.and_then(|event| self.boundary(event.wall));
        match (event.map(|event| event.kind), boundary.map(|boundary| (boundary.law, boundary.toward))) {
            (Some(Kind::Impact), Some((BoundaryLaw::Rigid(e), toward))) => {
                impact(e, toward * orbit.speeds.get(index).unwrap_or(&0.0), [before, after])
            }
            (Some(Kind::Enter), Some((BoundaryLaw::Elastic { damping, .. }, _))) => entry(damping, self.body().mass),
            _ => IDENTITY,
        }
    }

    /// How far roundings move the end of a run over one period of `whole`, an orbit that is not
    /// told by half: the larger of displacement and velocity in the scales of the problem, for
    /// roundings of the size 1 relative to what is rounded; to be multiplied by the unit in the
    /// last place.
    ///
    /// The run begins and ends within the flight after event number `last`, whose derivative until
    /// then is `propagator`. Rounded at each event are the state, relative to the scales, and the
    /// instant, relative to the period, which moves the state by its rate; both grow by the
    /// derivative of the state at the end with respect to that at the event. The multipliers do not
    /// bound this growth: what impacts amplify may shrink again before the orbit closes.
    pub(super) fn growth_of_rounding(&self, whole: &Orbit, last: usize, propagator: Matrix2) -> f64 {
        let flights = self.flight_maps(whole);
        let Scales { length, speed } = self.scales();
        let at_end = |m: &Matrix2, rate: [f64; 2]| {
            let row = |row: [f64; 2]| {
                let instant = (row[0] * rate[0] + row[1] * rate[1]).abs() * whole.period();
                instant + (row[0] * length).abs() + (row[1] * speed).abs()
            };
            (row(m[0]) / length).max(row(m[1]) / speed)
        };
        let mut until_end = propagator;
        let mut moved = flights.get(last).map_or(1.0, |flight| at_end(&until_end, flight.rates[0]));
        for back in 0..flights.len() {
            let index = (last + flights.len() - back) % flights.len();
            // What was before a rest does not matter after it.
            if whole.signature.events.get(index).is_some_and(|event| event.kind == Kind::Release) {
                break;
            }
            let before = &flights[(index + flights.len() - 1) % flights.len()];
            until_end = multiply(until_end, self.saltation(whole, &flights, index));
            moved += at_end(&until_end, before.rates[1]);
            until_end = multiply(until_end, before.propagator);
        }
        moved
    }
}
