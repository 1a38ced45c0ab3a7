//! The free exact run over one orbit: does it come back, through the same events?

use super::boundary::BoundaryLaw;
use super::periodic::Orbit;
use super::problem::Problem;
use super::signature::Kind;
use super::strobe::Scales;
use super::watch::Watch;
use crate::error::{Error, Result};
use crate::flow::Arc;
use crate::scene::State;
use crate::scheme::{Scheme, Stepper};
use crate::step::{Contact, Path};

/// Tolerance for the free run to come back to its start, in gaps, and gaps times the forcing's Ω …
const CLOSES: f64 = 1e-10;

/// … or, for an orbit whose events amplify rounding, within this many units in the last place of
/// what is rounded at each event, grown until the end of the run.
const UNITS: f64 = 1e2;

/// Contacts and forces of one wall over one period of an orbit.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct WallShare {
    /// Contact episodes that ended.
    pub contacts: u64,
    /// Impulse on the body, N s, signed as the force.
    pub impulse: f64,
    /// The largest finite |force|, N; 0 where there were impacts only.
    pub peak_force: f64,
    /// The largest speed at which the wall was met, m/s.
    pub approach_speed: f64,
}

/// An instant of an orbit.
#[derive(Debug, Clone, PartialEq)]
pub struct Instant {
    /// s, from the start of the forcing's period 0.
    pub time: f64,
    /// m.
    pub displacement: f64,
    /// m/s.
    pub velocity: f64,
    /// Force of each wall on the body, N, in the scene's order; impacts have none.
    pub forces: Vec<f64>,
}

/// The result of the free run over one period of an orbit.
#[derive(Debug, Clone, PartialEq)]
pub struct Judged {
    /// Distance of its end from its start: the larger of displacement in gaps and velocity in gaps
    /// times the forcing's Ω; where the scene has no gap, in largest displacements of the orbit.
    pub closure: f64,
    /// The tolerance of the closure: 1e-10, or rounding amplified by the orbit's events.
    pub tolerance: f64,
    /// True if the run went through the events of the orbit, in order, and no other.
    pub same_events: bool,
    /// The walls, in the scene's order.
    pub walls: Vec<WallShare>,
    /// The contact episodes that ended, in order of time.
    pub contacts: Vec<Contact>,
    /// The motion, in order of time; both sides of each impact.
    pub motion: Vec<Instant>,
}

impl Judged {
    /// True if the free run is the orbit.
    #[must_use]
    pub fn holds(&self) -> bool {
        self.same_events && self.closure <= self.tolerance
    }

    /// No motion between `walls` walls.
    fn at_rest(walls: usize) -> Self {
        Self {
            closure: f64::INFINITY,
            tolerance: CLOSES,
            same_events: false,
            walls: vec![WallShare::default(); walls],
            contacts: Vec::new(),
            motion: Vec::new(),
        }
    }

    /// Adds the motion along `arc` until `end` (s), in instants that are at most `spacing` (s)
    /// apart, and the impulses of the walls, with their `jump` (N s) at the end.
    fn add_arc(&mut self, arc: &Arc, (end, spacing): (f64, f64), jump: &[f64]) {
        let instants = ((end - arc.start()) / spacing).ceil().max(1.0) as u64;
        for index in 0..=instants {
            let time = if index == instants { end } else { arc.start() + spacing * index as f64 };
            let (displacement, velocity) = arc.state(time);
            let forces: Vec<f64> = (0..self.walls.len()).map(|wall| arc.contact_force(wall, time)).collect();
            for (share, force) in self.walls.iter_mut().zip(&forces) {
                share.peak_force = share.peak_force.max(force.abs());
            }
            self.motion.push(Instant { time, displacement, velocity, forces });
        }
        for (index, share) in self.walls.iter_mut().enumerate() {
            share.impulse += jump.get(index).unwrap_or(&0.0) + arc.contact_impulse(index, arc.start(), end);
        }
    }

    /// Adds contacts that ended.
    fn add_contacts(&mut self, closed: &[Contact]) {
        for contact in closed {
            self.contacts.push(*contact);
            if let Some(share) = self.walls.get_mut(contact.wall) {
                share.contacts += 1;
                share.approach_speed = share.approach_speed.max(contact.approach_speed);
                // Between two instants of the motion the force may be larger than at both.
                share.peak_force = contact.peak_force.map_or(share.peak_force, |peak| share.peak_force.max(peak.abs()));
            }
        }
    }
}

impl Problem {
    /// Runs the body freely over one period of `orbit`, by the exact scheme, from a state on it
    /// between two events; `points` instants of the motion are kept beside the events. An orbit
    /// that no body can follow is not run: its closure is infinite, and it has no motion.
    ///
    /// # Errors
    /// Those of a run; [`Error::NoOrbit`] for an orbit without a stretch of free flight.
    pub fn judge(&self, orbit: &Orbit, points: u32) -> Result<Judged> {
        self.check(orbit)?;
        let mut judged = Judged::at_rest(self.boundaries().len());
        let admissible = self.admissible(orbit)?;
        if !admissible.holds() {
            return Ok(judged);
        }
        let whole = orbit.unfolded(self.mirror());
        let Scales { length: scale, speed } = self.scales();
        let length = self.scene().orbit_gap().or(Some(admissible.largest).filter(|q| *q > 0.0)).unwrap_or(scale);
        let (speed, rounding_scale) = (speed * (length / scale), scale / length);
        let Midway { time: start, state, rounding } = self.midway(&whole)?;
        let end = start + whole.period();
        let scene = self.scene().clone().with_duration(end + whole.period());
        let mut stepper = Stepper::new(&scene, &Scheme::Event, 2.0 * end)?;
        stepper.set_state(start, &State { q: vec![state[0]], v: vec![state[1]] })?;
        let mut watch = Watch::new(self.scene(), self.forcing_period());
        let spacing = whole.period() / f64::from(points.max(1));
        while judged.closure.is_infinite() {
            let step = stepper.step()?;
            let Path::Exact(arc) = step.path else { continue };
            watch.observe(&step);
            let last = step.end >= end;
            if last {
                judged.add_arc(arc, (end, spacing), &[]);
                let (q, v) = arc.state(end);
                judged.closure = ((q - state[0]).abs() / length).max((v - state[1]).abs() / speed);
            } else {
                judged.add_arc(arc, (step.end, spacing), step.jump);
                judged.add_contacts(step.closed);
            }
        }
        let end_phase = end / self.forcing_period();
        let seen: Vec<_> = watch.passages.iter().filter(|passage| passage.phase < end_phase).collect();
        judged.tolerance = CLOSES.max(UNITS * f64::EPSILON * rounding * rounding_scale);
        judged.same_events = self.same_events(&whole, start, &seen);
        Ok(judged)
    }

    fn same_events(&self, whole: &Orbit, start: f64, seen: &[&super::watch::Passage]) -> bool {
        let start = start / self.forcing_period();
        let turn = whole.signature.cycles();
        let until = |phase: &f64| (phase - start).rem_euclid(turn);
        let nearest = whole.phases.iter().enumerate().min_by(|(_, a), (_, b)| until(a).total_cmp(&until(b)));
        let first = nearest.map_or(0, |(index, _)| index);
        let mut events = whole.signature.events.clone();
        if !events.is_empty() {
            events.rotate_left(first);
        }
        // Impacts that accumulate count as one event of the orbit.
        let rigid_rest =
            |wall: usize| matches!(self.boundary(wall).map(|s| s.law), Some(BoundaryLaw::Rigid(e)) if e > 0.0);
        let mut index = 0;
        for passage in seen {
            let Some(expected) = events.get(index) else { return false };
            let chattering = expected.kind == Kind::Chatter && expected.wall == passage.event.wall;
            match passage.event.kind {
                Kind::Impact if chattering => {}
                Kind::Rest if chattering && rigid_rest(passage.event.wall) => index += 1,
                _ if passage.event == *expected => index += 1,
                _ => return false,
            }
        }
        index == events.len()
    }

    /// The middle of the longest free flight of `whole`.
    fn midway(&self, whole: &Orbit) -> Result<Midway> {
        let period = self.forcing_period();
        let mut arc = self.arc();
        if whole.phases.is_empty() {
            let state = self.quiet()?;
            self.fly(&mut arc, state, [0.0, whole.period()], &[], None);
            return Ok(Midway { time: 0.0, state, rounding: self.growth_of_rounding(whole, 0, arc.propagator()) });
        }
        let touching = self.touching(&whole.signature);
        let turn = whole.signature.cycles();
        let mut longest: Option<(usize, f64, [f64; 2])> = None;
        for (index, event) in whole.signature.events.iter().enumerate() {
            let (Some(boundary), Some(phase)) = (self.boundary(event.wall), whole.phases.get(index)) else { continue };
            let span = (whole.next_phase(index) - phase) * period;
            let free =
                touching.get(index).is_none_or(Vec::is_empty) && !matches!(event.kind, Kind::Rest | Kind::Chatter);
            if free && longest.is_none_or(|(_, longest, _)| span > longest) {
                longest = Some((index, span, boundary.after(event.kind, whole.speeds[index]).state));
            }
        }
        let (index, span, state) = longest.ok_or_else(|| Error::no_orbit("the orbit has no stretch of free flight"))?;
        // A start before t = 0 is moved by whole periods of the orbit.
        let start = whole.phases[index] * period;
        let start = start - (start / (turn * period)).floor() * turn * period;
        self.fly(&mut arc, state, [start, 0.5 * span], &[], None);
        let (q, v) = arc.state(arc.end());
        Ok(Midway { time: arc.end(), state: [q, v], rounding: self.growth_of_rounding(whole, index, arc.propagator()) })
    }
}

/// Where the free run over one orbit starts and ends.
struct Midway {
    /// s.
    time: f64,
    /// m, m/s.
    state: [f64; 2],
    /// How far roundings of the size 1 move the end of the run, in the scales of the problem.
    rounding: f64,
}
