//! Whether a body can follow an orbit: it passes through no wall, and walls only push, and push
//! whenever they can.

use super::boundary::BoundaryLaw;
use super::extremes::extremes;
use super::periodic::Orbit;
use super::problem::Problem;
use super::signature::Kind;
use crate::error::Result;
use crate::flow::Arc;

/// Where the motion between events comes nearest to a wall that it does not meet.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Nearest {
    /// The gap there, m; below 0 where the motion passes through the wall.
    pub gap: f64,
    /// Index of the wall in the scene.
    pub wall: usize,
    /// Index of the event that begins this flight.
    pub flight: usize,
    /// The instant, in cycles of the forcing period from t = 0.
    pub phase: f64,
}

/// The quantities that decide whether a body can follow an orbit.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Admissible {
    /// The least speed of an event (releases have none), m/s; infinite without events.
    pub least_speed: f64,
    /// The nearest approach to a wall inside a flight; `None` where no flight turns back from
    /// a wall.
    pub nearest: Option<Nearest>,
    /// The least force with which a wall carries a body at rest, N; infinite without a rest. It is
    /// 0 at the release itself, which is left out.
    pub least_push: f64,
    /// Where an elastic wall comes nearest to letting go of the body within a contact, or, with a
    /// dashpot, behind its face once it has let go, to pushing again; its `gap` is the force there
    /// over the stiffness of the wall, below 0 where it does so. `None` where no force turns back
    /// from 0, and for structures.
    pub nearest_change: Option<Nearest>,
    /// The largest |displacement|, m; of accumulating impacts only the first counts.
    pub largest: f64,
}

impl Admissible {
    /// True if a body can follow the orbit.
    #[must_use]
    pub fn holds(&self) -> bool {
        let clear = |nearest: Option<Nearest>| nearest.is_none_or(|nearest| nearest.gap > 0.0);
        self.least_speed > 0.0 && self.least_push > 0.0 && clear(self.nearest) && clear(self.nearest_change)
    }

    /// Why no body can follow the orbit; `None` if one can. `walls` are the names.
    #[must_use]
    pub fn reason(&self, scene: &crate::scene::Scene) -> Option<String> {
        if self.least_speed <= 0.0 {
            return Some(format!("an event has the speed {:.3e} m/s: it comes from behind its wall", self.least_speed));
        }
        if self.least_push <= 0.0 {
            return Some(format!("a wall pulls the body at rest with {:.3e} N", -self.least_push));
        }
        let passed = |nearest: &Nearest| nearest.gap <= 0.0;
        let name = |nearest: Nearest| scene.wall_name(nearest.wall).unwrap_or_default();
        if let Some(nearest) = self.nearest.filter(passed) {
            let (wall, gap, phase) = (name(nearest), -nearest.gap, nearest.phase);
            return Some(format!("the motion passes {gap:.3e} m through wall {wall:?} at {phase:.6} cycles"));
        }
        let change = self.nearest_change.filter(passed)?;
        let (wall, phase) = (name(change), change.phase);
        Some(format!("wall {wall:?} lets go of the body, or pushes it again, at {phase:.6} cycles"))
    }
}

impl Problem {
    /// Whether a body can follow `orbit`: speeds towards the walls, no wall passed inside a flight
    /// (from the exact extremes), and a wall that carries the body pushes all the time.
    ///
    /// # Errors
    /// As [`Problem::correct`] for an orbit that does not belong to this problem.
    pub fn admissible(&self, orbit: &Orbit) -> Result<Admissible> {
        self.check(orbit)?;
        let signature = &orbit.signature;
        let mut arc = self.arc();
        let mut found = Admissible {
            least_speed: f64::INFINITY,
            nearest: None,
            least_push: f64::INFINITY,
            nearest_change: None,
            largest: 0.0,
        };
        if signature.events.is_empty() {
            let cycles = signature.cycles();
            self.fly(&mut arc, self.quiet()?, [0.0, cycles * self.forcing_period()], &[], None);
            self.near(&arc, 0, 0.0, &mut found);
            return Ok(found);
        }
        let touching = self.touching(signature);
        for (index, event) in signature.events.iter().enumerate() {
            let Some(boundary) = self.boundary(event.wall) else { continue };
            if event.kind != Kind::Release {
                found.least_speed = found.least_speed.min(orbit.speeds[index]);
            }
            let from = boundary.after(event.kind, orbit.speeds[index]);
            found.largest = found.largest.max(from.state[0].abs());
            let start = orbit.phases[index] * self.forcing_period();
            let span = orbit.next_phase(index) * self.forcing_period() - start;
            match event.kind {
                // Accumulating impacts are run by the exact scheme, which finds all contacts
                // itself.
                Kind::Chatter => {}
                Kind::Rest => {
                    self.fly(&mut arc, from.state, [start, span], &touching[index], Some(event.wall));
                    found.least_push = found.least_push.min(self.pushes(&arc, event.wall, span));
                }
                _ => {
                    self.fly(&mut arc, from.state, [start, span], &touching[index], None);
                    self.near(&arc, index, orbit.phases[index], &mut found);
                    let change = self.nearest_change(&arc, index, orbit.phases[index]);
                    let gap = |nearest: Option<Nearest>| nearest.map_or(f64::INFINITY, |nearest| nearest.gap);
                    if gap(change) < gap(found.nearest_change) {
                        found.nearest_change = change;
                    }
                }
            }
        }
        Ok(found)
    }

    fn near(&self, arc: &Arc, flight: usize, phase: f64, found: &mut Admissible) {
        extremes(arc, arc.end() - arc.start(), [1.0, 0.0], |tau, &[q, ..], acceleration| {
            found.largest = found.largest.max(q.abs());
            for (wall, boundary) in self.boundaries().iter().enumerate() {
                // A wall is approached where the motion turns back from its side.
                if arc.touching().any(|touching| touching == wall) || acceleration * boundary.toward > 0.0 {
                    continue;
                }
                let gap = boundary.gap(q);
                if found.nearest.is_none_or(|nearest| gap < nearest.gap) {
                    let phase = phase + tau / self.forcing_period();
                    found.nearest = Some(Nearest { gap, wall, flight, phase });
                }
            }
        });
    }

    /// Where an elastic wall comes nearest to an event inside the flight of `arc`, which event
    /// number `flight` begins at `phase` (cycles). Its force is P = k s + c ṡ at depth s. While the
    /// wall pushes, the least P counts; once it has let go of a body that is still behind its face,
    /// as with a dashpot, the largest one.
    pub(super) fn nearest_change(&self, arc: &Arc, flight: usize, phase: f64) -> Option<Nearest> {
        let mut found: Option<Nearest> = None;
        for (wall, boundary) in self.boundaries().iter().enumerate() {
            let BoundaryLaw::Elastic { stiffness, damping } = boundary.law else { continue };
            let pushes = arc.touching().any(|touching| touching == wall);
            if damping == 0.0 && !pushes {
                continue;
            }
            let away = if pushes { boundary.toward } else { -boundary.toward };
            extremes(arc, arc.end() - arc.start(), [1.0, damping / stiffness], |tau, &[q, v, ..], curvature| {
                let turns_back = away * curvature > 0.0 && (pushes || boundary.gap(q) < 0.0);
                let gap = away * (q - boundary.position + damping / stiffness * v);
                if turns_back && found.is_none_or(|nearest| gap < nearest.gap) {
                    found = Some(Nearest { gap, wall, flight, phase: phase + tau / self.forcing_period() });
                }
            });
        }
        found
    }

    /// The least force of `wall` on the body that rests on it, N; over `span` (s) without its end.
    fn pushes(&self, arc: &Arc, wall: usize, span: f64) -> f64 {
        const SAMPLES: u32 = 64;
        let at = |i: u32| arc.start() + span * f64::from(i) / f64::from(SAMPLES);
        let push = |t: f64| -self.boundary(wall).map_or(0.0, |boundary| boundary.toward) * arc.contact_force(wall, t);
        (0..SAMPLES).map(at).map(push).fold(f64::INFINITY, f64::min)
    }
}
