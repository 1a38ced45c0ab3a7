//! Contacts and pauses of elastic walls that begin, end or change their order at a special point.

use super::super::admissible::Nearest;
use super::super::boundary::BoundaryLaw;
use super::super::equations::CYCLE;
use super::super::periodic::Orbit;
use super::super::problem::Problem;
use super::super::signature::{Event, Kind};
use super::arclength::unit;
use super::curve::{Curve, Vector};
use super::label::Label;
use super::line::{Begin, Passed};
use crate::error::{Error, Result};
use nalgebra::DVector;

/// A gap, or a speed, of which a smaller one is 0, as a share of the scales of the curve.
const SLIGHT: f64 = 1e-4;

/// Half of the duration of a push or pause with which a new branch begins, in [`CYCLE`].
const SHORT: f64 = 1e-3;

impl Curve<'_> {
    /// Adds a contact, push or pause of short duration by the events `kinds` at an elastic wall,
    /// about the instant at which its force is nearest to what ends or begins there.
    pub(super) fn insert_short(
        &self,
        problem: &Problem,
        at: &Passed<Self>,
        nearest: Nearest,
        kinds: [Kind; 2],
    ) -> Result<Begin<Self>> {
        let none = || Error::no_orbit("no such event");
        let boundary = problem.boundary(nearest.wall).ok_or_else(none)?;
        let mut orbit = at.point.orbit.clone();
        let (touching, events) = (problem.touching(&orbit.signature), &orbit.signature.events);
        let flight = events.get(nearest.flight).zip(orbit.phases.get(nearest.flight).zip(touching.get(nearest.flight)));
        let (from, phase, touching, index) = match flight {
            Some((event, (phase, touching))) => {
                let speed = orbit.speeds.get(nearest.flight).ok_or_else(none)?;
                let boundary = problem.boundary(event.wall).ok_or_else(none)?;
                (boundary.after(event.kind, *speed).state, *phase, &touching[..], nearest.flight + 1)
            }
            None => (problem.quiet()?, 0.0, &[][..], 0),
        };
        let (period, half, mut arc) = (problem.forcing_period(), SHORT * CYCLE, problem.arc());
        problem.fly(&mut arc, from, [phase * period, (nearest.phase + half - phase) * period], touching, None);
        // With a dashpot the body moves at that instant; else it turns there, and crosses the face
        // with what it has half the duration later.
        let speed = match boundary.law {
            BoundaryLaw::Elastic { damping, .. } if damping > 0.0 && !kinds.contains(&Kind::Enter) => {
                -boundary.toward * arc.state(nearest.phase * period).1
            }
            _ => arc.state((nearest.phase + half) * period).1.abs(),
        };
        for (kind, phase) in kinds.into_iter().zip([nearest.phase - half, nearest.phase + half]).rev() {
            orbit.insert(index, Event { kind, wall: nearest.wall }, phase, speed);
        }
        // The duration is kept: the equations are singular for duration 0.
        let share = std::f64::consts::FRAC_1_SQRT_2;
        let along = DVector::from_fn(2 * orbit.phases.len() + 1, |i, _| match i {
            i if i == 2 * index => -share,
            i if i == 2 * index + 2 => share,
            _ => 0.0,
        });
        self.begin_short(problem, &orbit, at.point.value, along)
    }

    /// The branch that begins at the orbit near `orbit`, one with a contact or pause of short
    /// duration, in the direction `along`, across which that orbit is found.
    fn begin_short(&self, problem: &Problem, orbit: &Orbit, value: f64, along: Vector) -> Result<Begin<Self>> {
        let curve = self.of(&orbit.signature);
        let guess = curve.gather(problem, orbit, value);
        let (y, ..) = curve.correct(&guess, &along)?;
        if (&y - &guess).norm() > CYCLE {
            return Err(Error::no_orbit("no orbit with a short contact or pause was found beside the touching one"));
        }
        Ok(Begin { curve, y, along, both: false })
    }

    /// Adds a short pause where an elastic wall lets go of the body, or a short push where one with
    /// a dashpot pushes again behind its face; `None` at another special point.
    pub(super) fn divide(&self, problem: &Problem, at: &Passed<Self>) -> Option<Result<Begin<Self>>> {
        let change = at.point.admissible.nearest_change.filter(|_| at.label == Label::ContactEnds)?;
        if change.gap.abs() > SLIGHT * self.scales.length {
            return None;
        }
        let touches = problem.touching(&at.point.orbit.signature).get(change.flight)?.contains(&change.wall);
        let undamped = matches!(problem.boundary(change.wall)?.law, BoundaryLaw::Elastic { damping: 0.0, .. });
        let kinds = match (undamped, touches) {
            (true, _) => [Kind::Leave, Kind::Enter],
            (_, true) => [Kind::Leave, Kind::Again],
            _ => [Kind::Again, Kind::Leave],
        };
        Some(self.insert_short(problem, at, change, kinds))
    }

    /// Leaves out a pause within a contact with an elastic wall, or a push behind its face, whose
    /// duration has become 0; `None` at another special point.
    pub(super) fn join(&self, problem: &Problem, at: &Passed<Self>) -> Option<Result<Begin<Self>>> {
        let mut orbit = at.point.orbit.clone();
        let count = orbit.signature.events.len();
        let next = (at.event + 1) % count.max(1);
        let [first, second] = [*orbit.signature.events.get(at.event)?, *orbit.signature.events.get(next)?];
        let pair = matches!((first.kind, second.kind), (Kind::Leave, Kind::Again) | (Kind::Again, Kind::Leave));
        if at.label != Label::Corner || first.wall != second.wall || !pair || next == 0 {
            return None;
        }
        orbit.remove(next);
        orbit.remove(at.event);
        // Of a wall that is never left no event remains.
        orbit.signature.events.iter().find(|event| event.wall == first.wall)?;
        Some(self.begin(problem, &orbit, at.point.value, Some(at), false))
    }

    /// Exchanges two events at different elastic walls that coincide: neither changes the velocity,
    /// and the motion does not depend on which is first. `None` at another special point.
    pub(super) fn exchange(&self, problem: &Problem, at: &Passed<Self>) -> Option<Result<Begin<Self>>> {
        let mut orbit = at.point.orbit.clone();
        let next = at.event + 1;
        let [first, second] = [*orbit.signature.events.get(at.event)?, *orbit.signature.events.get(next)?];
        let elastic = |event: Event| matches!(event.kind, Kind::Enter | Kind::Leave | Kind::Again);
        if at.label != Label::Corner || first.wall == second.wall || !(elastic(first) && elastic(second)) {
            return None;
        }
        orbit.signature.events.swap(at.event, next);
        orbit.speeds.swap(at.event, next);
        Some(self.begin(problem, &orbit, at.point.value, Some(at), false))
    }

    /// Behind the face of an elastic wall with a dashpot, which the body has left there: where it
    /// no longer comes out to the face, it meets the wall again behind it.
    pub(super) fn stay_behind(&self, problem: &Problem, at: &Passed<Self>) -> Result<Begin<Self>> {
        let mut orbit = at.point.orbit.clone();
        let event = orbit.signature.events.get_mut(at.event).ok_or_else(|| Error::no_orbit("no such event"))?;
        event.kind = Kind::Again;
        self.begin(problem, &orbit, at.point.value, Some(at), false)
    }

    /// The opposite of [`Curve::stay_behind`]: a wall with a dashpot that pushes again at its face,
    /// with speed 0, is entered anew beyond; `None` at another special point.
    pub(super) fn come_out(&self, problem: &Problem, at: &Passed<Self>) -> Option<Result<Begin<Self>>> {
        let mut orbit = at.point.orbit.clone();
        let event = orbit.signature.events.get_mut(at.event).filter(|event| event.kind == Kind::Again)?;
        event.kind = Kind::Enter;
        let slow = orbit.speeds.get(at.event)?.abs() <= SLIGHT * self.scales.speed;
        (at.label == Label::ContactEnds && slow).then(|| {
            let curve = self.of(&orbit.signature);
            let y = curve.gather(problem, &orbit, at.point.value);
            // At speed 0 the key does not tell these orbits apart, but the speed does.
            let along = unit(y.len(), 2 * at.event + 1);
            Ok(Begin { curve, y, along, both: false })
        })
    }
}
