//! The motion of an orbit, flight by flight from its events.

use super::judge::Instant;
use super::periodic::Orbit;
use super::problem::Problem;
use super::signature::Kind;
use crate::error::Result;
use crate::flow::Arc;

/// Longest time between two instants, in units of the shortest period of motion and load over 2π.
/// The cubic through displacement and velocity at both then errs by 0.3⁴/384 = 2e-5 of the
/// amplitude in displacement, and by 0.3³√3/216 = 2e-4 in velocity: less than a drawing shows.
const STRIDE: f64 = 0.3;

/// Most instants of one flight.
const MOST: f64 = 128.0;

impl Problem {
    /// The motion over one period of `orbit`, from its first event on, computed by the flow from
    /// each event to the next; both sides of each impact. Nothing is checked: an orbit that passes
    /// through a wall gives the motion through the wall, and of impacts that accumulate only the
    /// first is included. [`Problem::judge`] makes the free run.
    ///
    /// # Errors
    /// As [`Problem::correct`] for an orbit that does not belong to this problem.
    pub fn flights(&self, orbit: &Orbit) -> Result<Vec<Instant>> {
        self.check(orbit)?;
        let whole = orbit.unfolded(self.mirror());
        let mut arc = self.arc();
        let mut motion = Vec::new();
        if whole.signature.events.is_empty() {
            self.fly(&mut arc, self.quiet()?, [0.0, whole.period()], &[], None);
            self.along(&arc, whole.period(), &mut motion);
            return Ok(motion);
        }
        let touching = self.touching(&whole.signature);
        for (index, event) in whole.signature.events.iter().enumerate() {
            let (Some(boundary), Some(phase)) = (self.boundary(event.wall), whole.phases.get(index)) else { continue };
            if event.kind == Kind::Chatter {
                continue;
            }
            let start = phase * self.forcing_period();
            let span = (whole.next_phase(index) - phase) * self.forcing_period();
            let from = boundary.after(event.kind, whole.speeds[index]).state;
            let support = (event.kind == Kind::Rest).then_some(event.wall);
            self.fly(&mut arc, from, [start, span], &touching[index], support);
            self.along(&arc, span, &mut motion);
        }
        Ok(motion)
    }

    /// Adds the instants of `arc` over `span` (s), both ends among them.
    fn along(&self, arc: &Arc, span: f64, motion: &mut Vec<Instant>) {
        let count = (span * arc.fastest_motion() / STRIDE).ceil().clamp(2.0, MOST) as u32;
        for index in 0..=count {
            let time = arc.start() + span * f64::from(index) / f64::from(count);
            let (displacement, velocity) = arc.state(time);
            let forces = (0..self.boundaries().len()).map(|wall| arc.contact_force(wall, time)).collect();
            motion.push(Instant { time, displacement, velocity, forces });
        }
    }
}
