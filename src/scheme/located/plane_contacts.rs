//! Flat and round walls at places in two planes, with friction: which of them the body touches, the
//! motion of a part along them, and what ends it.
//!
//! Friction is Coulomb's, on the impulse over a part and the velocity at its end. A body that
//! slides at the start of a part slides with full friction until its sliding velocity, which is
//! linear in time, vanishes: the part ends there (`Event::Reversal`), and from rest the law decides
//! whether the body sticks or slides back. It begins to slide where the straight line through what
//! its last two parts left of the static friction vanishes (`Event::Slip`). The static coefficient
//! is that of a contact which pushed just before and does not slide; a part at whose end it slides
//! is one with its kinetic friction throughout.

use super::super::Counters;
use super::super::body::Body;
use super::super::frame::Frame;
use super::super::matrices::Matrices;
use super::super::space::indefinite;
use super::super::supports::{contact_points, dot};
use super::contacts::{Ahead, Contacts, Event, Place, Solved};
use super::impact::Impact;
use super::part::{Part, THETA, size_of};
use super::plane_bound::PlaneBound;
use super::plane_contact::PlaneContact;
use super::plane_path::PlanePath;
use super::response::Response;
use crate::error::Result;
use crate::scene::{Row, Scene};

/// A part shorter than this share of the step ends at a blow, and no rigid contact acts in it.
pub(super) const INSTANT: f64 = 1e-12;

/// Parts of a step after its rebounds are given up.
const PARTS_WITHOUT_REBOUND: u32 = 256;

/// Speeds that count as rest where rebounds are given up, in multiples of those where they are not.
const SLOW: f64 = 1e4;

/// The walls of a scene in two planes.
#[derive(Debug)]
pub(super) struct PlaneContacts {
    pub(super) all: Vec<PlaneContact>,
    rows: Vec<Row>,
    pub impact: Impact,
    /// The response over a whole step, and that over the last part.
    whole: Response,
    short: Response,
    holds: Vec<PlaneBound>,
    /// True if a body that strikes a wall rebounds.
    rebounds: bool,
    /// True if the contacts of the last part that was computed were settled.
    settled: bool,
    /// True if round walls must take the speed across them at once, and how often they did.
    stops: bool,
    stopped: u64,
    unsettled: u64,
}

impl PlaneContacts {
    pub fn new(scene: &Scene, body: &Body<Matrices>) -> Result<Self> {
        let (points, rows) = contact_points(scene);
        let [whole, short] = [(); 2].map(|()| Response::new(body.theta_matrix(THETA)).map_err(indefinite));
        let impact = Impact::new(body, &rows, points.len())?;
        let walls = points.into_iter().zip(&scene.walls).enumerate();
        Ok(Self {
            all: walls.map(|(index, (point, wall))| PlaneContact::new(index, point, wall)).collect(),
            rows: rows.into_iter().cloned().collect(),
            impact,
            whole: whole?,
            short: short?,
            holds: Vec::new(),
            rebounds: true,
            settled: true,
            stops: false,
            stopped: 0,
            unsettled: 0,
        })
    }

    /// Begins at the displacement `q` (m) and the velocity `v` (m/s).
    pub fn begin(&mut self, scene: &Scene, q: &[f64], v: &[f64]) {
        self.forget();
        for (index, contact) in self.all.iter_mut().enumerate() {
            contact.pushed = scene.stands_on(index, q, v);
        }
    }

    /// The displacement of a place of a velocity or a displacement.
    pub fn pair(&self, wall: usize, x: &[f64]) -> [f64; 2] {
        self.impact.places.pair(self.all[wall].point.rows, x)
    }

    /// The rates of a wall's place along its normal `normal` (of a flat one, its own).
    pub fn rate_along(&self, wall: usize, normal: [f64; 2], v: &[f64]) -> f64 {
        let contact = &self.all[wall];
        dot(if contact.round.is_some() { normal } else { contact.point.normal }, self.pair(wall, v))
    }

    /// The same at the start of a part of `length` seconds, with the velocity `v` there and the
    /// normal in the middle, up to which that of a round wall turns.
    pub fn rate_at_start(&self, wall: usize, normal: [f64; 2], v: &[f64], length: f64) -> f64 {
        let along = self.rate_along(wall, normal, v);
        let Some((_, gap)) = self.all[wall].round.filter(|(_, gap)| *gap > 0.0) else { return along };
        let [y, z] = self.pair(wall, v);
        let across = normal[0] * z - normal[1] * y;
        along - 0.5 * length * across * across / gap
    }

    /// The gap of a wall, m, and its outward normal.
    pub(super) fn gap(&self, wall: usize, body: &Body<Matrices>, q: &Vec<f64>) -> (f64, [f64; 2]) {
        self.all[wall].gap((body, &self.impact.places), q)
    }

    /// The path of a part of `length` seconds that changes the velocity by `delta` (m/s).
    fn path<'a>(
        &'a self,
        body: &'a Body<Matrices>,
        frame: &'a Frame<Matrices>,
        (delta, length): (&'a Vec<f64>, f64),
    ) -> PlanePath<'a> {
        let Self { all: contacts, holds, impact, .. } = self;
        PlanePath { contacts, holds, places: &impact.places, body, frame, delta, length }
    }

    /// True if the motion of a whole step is that without walls, apart from crossings.
    pub fn is_free(&self, body: &Body<Matrices>, frame: &Frame<Matrices>, delta: &Vec<f64>) -> bool {
        self.path(body, frame, (delta, body.h)).is_free()
    }

    /// δ of a whole step without walls, from the momentum `b`.
    pub fn release(&mut self, b: &[f64], delta: &mut Vec<f64>) {
        self.whole.release(b, delta);
    }

    fn solve(
        &mut self,
        body: &Body<Matrices>,
        part: &mut Part<Matrices>,
        v: &[f64],
        (length, theta): (f64, f64),
    ) -> Solved {
        let Self { whole, short, rows, holds, .. } = self;
        let response = if length == body.h && theta == THETA {
            whole
        } else {
            short.renew(part.polynomial.at(length * theta))?;
            short
        };
        self.settled = response.solve(body, (rows, holds), part, (v, length, theta));
        self.all.iter_mut().for_each(|contact| contact.pushes = false);
        part.pushes.iter().for_each(|push| self.all[push.wall].pushes = true);
        Ok(self.settled)
    }
}

impl Contacts<Matrices> for PlaneContacts {
    fn classify(&mut self, body: &Body<Matrices>, _: &Part<Matrices>, frame: &Frame<Matrices>) {
        for (wall, face) in body.walls.iter().enumerate() {
            let (gap, normal) = self.gap(wall, body, &frame.q);
            let pair = self.pair(wall, &frame.v);
            let size: f64 = self.all[wall].point.rows.iter().map(|&row| size_of(&self.rows[row], &frame.v)).sum();
            // Where rebounds are given up, impacts of walls on one another end sooner.
            let rest = if self.rebounds { body.touch } else { SLOW * body.touch } / body.h;
            let touches = face.law.is_rigid() && gap <= body.touch;
            self.all[wall].classify(touches, (normal, pair, size), (body.touch, rest), frame.blown);
        }
    }

    fn is_struck(&self) -> bool {
        self.all.iter().any(|contact| contact.place == Place::Struck)
    }

    fn sets_blows_apart(&self) -> bool {
        self.all.iter().any(|contact| contact.place == Place::Resting)
    }

    fn solve_contacts(
        &mut self,
        body: &Body<Matrices>,
        part: &mut Part<Matrices>,
        frame: &Frame<Matrices>,
        length: f64,
    ) -> Solved {
        self.holds.clear();
        for wall in 0..self.all.len() {
            self.holds.extend(self.hold(wall, (body, frame), length));
        }
        self.solve(body, part, &frame.v, (length, THETA))
    }

    fn give_up(
        &mut self,
        body: &Body<Matrices>,
        part: &mut Part<Matrices>,
        frame: &Frame<Matrices>,
        length: f64,
    ) -> Solved {
        self.holds.clear();
        self.impact.wedged.clear();
        for wall in 0..self.all.len() {
            self.holds.push(self.hold_at_end(wall, (body, frame), length));
        }
        self.solve(body, part, &frame.v, (length, 1.0))
    }

    fn stops(&mut self) -> bool {
        let across = |contact: &PlaneContact| contact.place == Place::Resting && contact.rate[0] > contact.rounding;
        self.stops = self.all.iter().any(across);
        self.stops
    }

    fn parts_without_rebound(&self) -> u32 {
        PARTS_WITHOUT_REBOUND
    }

    fn set_rebounds(&mut self, rebounds: bool) {
        self.rebounds = rebounds;
    }

    fn first_event(
        &self,
        body: &Body<Matrices>,
        frame: &Frame<Matrices>,
        motion: (&Vec<f64>, f64),
    ) -> Option<(f64, Event)> {
        self.path(body, frame, motion).first_event()
    }

    fn ahead(&self, body: &Body<Matrices>, frame: &Frame<Matrices>, event: Event, motion: (&Vec<f64>, f64)) -> Ahead {
        self.path(body, frame, motion).ahead(event)
    }

    fn forget(&mut self) {
        self.all.iter_mut().for_each(PlaneContact::forget);
    }

    fn keep(&mut self, body: &Body<Matrices>, part: &Part<Matrices>, frame: &Frame<Matrices>, length: f64) {
        self.unsettled += u64::from(!std::mem::replace(&mut self.settled, true));
        self.impact.ended = 0.0;
        if length <= INSTANT * body.h {
            self.all.iter_mut().for_each(|contact| contact.lasts = false);
            return;
        }
        for wall in 0..self.all.len() {
            let (_, normal) = self.gap(wall, body, &frame.q);
            let (change, rate) = (self.pair(wall, &part.delta), self.pair(wall, &frame.v));
            let push = part.pushes.iter().find(|push| push.wall == wall);
            let ends = (length, frame.end - 0.5 * length, body.h);
            self.all[wall].keep(push, (normal, rate, change), ends);
        }
    }

    fn strike(
        &mut self,
        body: &Body<Matrices>,
        part: &Part<Matrices>,
        frame: &mut Frame<Matrices>,
        _: u64,
    ) -> Result<bool> {
        self.impact.wedged.clear();
        // What pushes over a part has no impulse at its end: a part of no length follows.
        if frame.pushing.iter().any(|&wall| body.walls[wall].law.is_rigid()) {
            return Ok(false);
        }
        self.classify(body, part, frame);
        let stops = std::mem::take(&mut self.stops);
        if !self.is_struck() && !stops {
            return Ok(false);
        }
        self.stopped += u64::from(stops);
        let rebounds = self.rebounds && !stops;
        self.impact.strike(body, &self.all, frame, rebounds);
        for (contact, jump) in self.all.iter_mut().zip(&frame.jump) {
            contact.pushed |= *jump != 0.0;
            contact.stopped = false;
        }
        for contact in self.all.iter_mut().filter(|contact| contact.lasts) {
            let after = dot(contact.normal, self.impact.places.pair(contact.point.rows, &frame.v));
            contact.lasts = contact.place == Place::Resting && after.abs() <= contact.rate[0].abs() + contact.least;
        }
        Ok(true)
    }

    fn count(&self, counters: &mut Counters) {
        let [unsettled, wedged] = self.impact.unsettled_and_wedged();
        counters.qp_solves += self.whole.solves() + self.short.solves() + self.impact.instants;
        counters.qp_unsettled += self.unsettled + unsettled;
        counters.wedged_steps += wedged + self.stopped;
    }
}
