//! The data at a point of the curve: the orbit, its multipliers, and test functions.

use super::{Linear, Shots};
use crate::error::Result;
use crate::orbit::admissible::{Admissible, Nearest};
use crate::orbit::branch::arclength::{Vector, bordered, tangent};
use crate::orbit::branch::point::Point;
use crate::orbit::floquet::Floquet;
use crate::orbit::orbit_run::{OrbitRun, Touch};
use crate::orbit::periodic::Orbit;
use crate::orbit::signature::Event;
use crate::orbit::strobe::{Strobe, multipliers, state};
use crate::orbit::watch::Passage;
use nalgebra::{Complex, DMatrix};

/// The point at which a step begins.
pub(super) struct StepStart {
    pub y: Vector,
    pub tangent: Vector,
    /// The derivatives of the equations, and the column of the key among them.
    pub matrix: DMatrix<f64>,
    pub column: Vector,
    pub point: Point,
    /// The events after the strobe, and where the motion turns back before walls.
    pub passages: Vec<Passage>,
    pub touches: Vec<Touch>,
    pub tests: Tests,
}

/// Test functions: smooth as long as the walls and their order stay.
#[derive(Debug, Clone, Copy)]
pub(super) struct Tests {
    /// The key's part of the tangent: a fold.
    pub fold: f64,
    /// The determinant of the equations with the tangent below them: another branch.
    pub crossing: f64,
    /// det(H + 1) times all impact speeds, H the derivative of the map: a multiplier −1.
    pub flip: f64,
    /// Number of multipliers outside the unit circle, and the distance of the nearest complex pair
    /// from it.
    pub outside: usize,
    pub pair: f64,
}

impl StepStart {
    /// True if both orbits meet the same walls in the same order.
    pub fn meets_as(&self, other: &Self) -> bool {
        events(&self.passages).eq(events(&other.passages))
    }

    /// The largest entry of the point, 1 or more: what steps along the branch are compared with.
    pub fn size(&self) -> f64 {
        self.y.amax().max(1.0)
    }
}

pub(super) fn events(passages: &[Passage]) -> impl Iterator<Item = Event> + '_ {
    passages.iter().map(|passage| passage.event)
}

/// The multipliers of the map, the largest first.
pub(super) fn multipliers_of(linear: &Linear) -> Vec<Complex<f64>> {
    let n = linear.matrix.nrows();
    multipliers(&(linear.matrix.columns(0, n) + DMatrix::identity(n, n)))
}

impl Shots<'_> {
    /// The data at the solution `y`, with the tangent in the direction of `along`.
    pub(super) fn step_start(&self, y: Vector, linear: Linear, along: &Vector) -> Result<StepStart> {
        let tangent = tangent(&linear.matrix, along)?;
        let n = y.len() - 1;
        let square = linear.matrix.columns(0, n).into_owned();
        let own = multipliers_of(&linear);
        let speeds = linear.motion.passages.iter().filter(|p| p.event.kind.is_approach() && p.event.kind.is_rigid());
        let flip = (&square + DMatrix::identity(n, n) * 2.0).determinant();
        let flip = speeds.fold(flip, |product, p| product * p.speed.abs() / self.scales.speed);
        let distance = |z: &&Complex<f64>| (z.norm() - 1.0).abs();
        let nearest = own.iter().filter(|z| z.im != 0.0).min_by(|a, b| distance(a).total_cmp(&distance(b)));
        let tests = Tests {
            fold: tangent[n],
            crossing: bordered(&linear.matrix, &tangent).determinant(),
            flip,
            outside: own.iter().filter(|z| z.norm() > 1.0).count(),
            pair: nearest.map_or(f64::INFINITY, |z| (z.norm() - 1.0).abs()),
        };
        let column = linear.matrix.column(n).into_owned();
        let point = self.point(&y, linear.posed.period, &linear.motion, own);
        let Linear { motion: OrbitRun { passages, touches, .. }, matrix, .. } = linear;
        Ok(StepStart { y, tangent, matrix, column, point, passages, touches, tests })
    }

    /// The orbit whose run is `motion`, and whose map has the multipliers `own`.
    pub(super) fn point(&self, y: &Vector, period: f64, motion: &OrbitRun, own: Vec<Complex<f64>>) -> Point {
        let mut orbit = motion.orbit(self.periods, period);
        orbit.signature.symmetric = self.symmetric;
        let approaches = motion.passages.iter().filter(|p| p.event.kind.is_approach());
        let nearest = motion.touches.iter().min_by(|a, b| a.gap.total_cmp(&b.gap));
        let flight = |phase: f64| motion.passages.iter().filter(|p| p.phase <= phase).count();
        let count = motion.passages.len();
        let admissible = Admissible {
            least_speed: approaches.map(|p| p.speed).fold(f64::INFINITY, f64::min),
            nearest: nearest.map(|touch| Nearest {
                gap: touch.gap,
                wall: touch.wall,
                // The flight after the last event is the one before the first.
                flight: if count == 0 { 0 } else { (flight(touch.phase) + 2 * count - 1 - self.first % count) % count },
                phase: touch.phase,
            }),
            least_push: f64::INFINITY,
            nearest_change: None,
            largest: motion.largest,
        };
        let product = own.iter().fold(Complex::from(1.0), |product, z| product * z).re;
        let trace = own.iter().map(|z| z.re).sum();
        let floquet = Floquet::of(own.iter().map(|z| [z.re, z.im]).collect(), [trace, product], self.symmetric);
        let strobe = Strobe { phase: self.strobe, state: state(&self.state(y)) };
        Point { value: self.value(y), orbit: self.turned(orbit), floquet, admissible, strobe: Some(strobe) }
    }

    /// The orbit listed from the branch's first event on; this event falls into the first period of
    /// the orbit after t = 0.
    fn turned(&self, orbit: Orbit) -> Orbit {
        let whole = orbit.unfolded(self.mirror.as_deref()).rotated(self.first, self.periods);
        let count = whole.phases.len();
        if count == 0 {
            return orbit;
        }
        let half = whole.first(count / 2, self.periods, true).filter(|_| orbit.signature.symmetric);
        half.unwrap_or(whole)
    }
}
