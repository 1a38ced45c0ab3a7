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
use super::crossing::GapPath;
use super::impact::Impact;
use super::part::{Part, THETA, size_of};
use super::plane_bound::{Guide, PlaneBound, Plate, Ring};
use super::plane_contact::PlaneContact;
use super::response::Response;
use super::round_path::RoundPath;
use crate::error::Result;
use crate::scene::{Row, Scene};

/// A part shorter than this share of the step ends at a blow, and no rigid contact acts in it.
const INSTANT: f64 = 1e-12;

/// Parts of a step after its rebounds are given up.
const PARTS_WITHOUT_REBOUND: u32 = 256;

/// Speeds that count as rest where rebounds are given up, in multiples of those where they are not.
const SLOW: f64 = 1e4;

/// A part shorter than this share of the step is not worth the begin of a slide.
const SOON: f64 = 1e-9;

/// The walls of a scene in two planes.
#[derive(Debug)]
pub(super) struct PlaneContacts {
    all: Vec<PlaneContact>,
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

    /// Displacement from the centre of a round wall, m.
    fn offset(&self, wall: usize, centre: [f64; 2], q: &[f64]) -> [f64; 2] {
        let [y, z] = self.pair(wall, q);
        [y - centre[0], z - centre[1]]
    }

    /// The gap of a wall, m, and its outward normal.
    fn gap(&self, wall: usize, body: &Body<Matrices>, q: &Vec<f64>) -> (f64, [f64; 2]) {
        match self.all[wall].round {
            None => (-body.walls[wall].depth(body.seen(wall, q)), self.all[wall].point.normal),
            Some((centre, gap)) => {
                let from = self.offset(wall, centre, q);
                let distance = dot(from, from).sqrt();
                (gap - distance, if distance > 0.0 { from.map(|x| x / distance) } else { [1.0, 0.0] })
            }
        }
    }

    /// True if the motion of a whole step is that without walls, apart from crossings.
    pub fn is_free(&self, body: &Body<Matrices>, frame: &Frame<Matrices>, delta: &[f64]) -> bool {
        let elastic = |(wall, face): (usize, &super::super::flat_row::FlatRow)| {
            if let Some((centre, gap)) = self.all[wall].round {
                let (from, rate, change) =
                    (self.offset(wall, centre, &frame.q), self.pair(wall, &frame.v), self.pair(wall, delta));
                let end = [0, 1].map(|i: usize| from[i] + body.h * (rate[i] + THETA * change[i]));
                return face.law.is_rigid() || dot(from, from).max(dot(end, end)) <= gap * gap;
            }
            let (w, change) = (body.seen(wall, &frame.q), body.seen(wall, &frame.v));
            let end =
                w + body.h * (change + 0.5 * dot(self.all[wall].point.normal, self.pair(wall, delta)) * -face.sign);
            face.law.is_rigid() || (face.depth(w) <= 0.0 && face.depth(end) <= 0.0)
        };
        self.all.iter().all(|contact| matches!(contact.place, Place::Away | Place::Leaving))
            && body.walls.iter().enumerate().all(elastic)
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

    /// The contact of a wall with this guide over a part.
    fn velocity_bound(
        &self,
        wall: usize,
        (body, frame): (&Body<Matrices>, &Frame<Matrices>),
        guide: Guide,
    ) -> PlaneBound {
        let contact = &self.all[wall];
        let centre = contact.round.map_or([0.0; 2], |(centre, _)| centre);
        PlaneBound {
            wall,
            rows: contact.point.rows,
            guide,
            friction: contact.friction(),
            kinetic: contact.point.friction.sliding,
            compliance: 0.0,
            slides: 0.0,
            sign: if contact.round.is_some() { 1.0 } else { body.walls[wall].sign },
            from: self.offset(wall, centre, &frame.q),
            rate: self.pair(wall, &frame.v),
            acceleration: contact.acceleration,
        }
    }

    /// The contact of an elastic wall over a part of `length` seconds of the weight θ.
    fn spring(&self, wall: usize, state: (&Body<Matrices>, &Frame<Matrices>), span: (f64, f64)) -> PlaneBound {
        let (body, frame) = state;
        let (face, contact, (length, theta)) = (body.walls[wall], &self.all[wall], span);
        if let (Some((centre, gap)), Some(spring)) = (contact.round, face.law.spring()) {
            let from = self.offset(wall, centre, &frame.q);
            let distance = from[0].hypot(from[1]);
            let plate =
                if theta == THETA && distance >= gap { Plate::Body } else { Plate::Distance(distance.max(gap)) };
            let ring = Ring { spring, gap, plate, theta };
            let compliance = ring.compliance(length);
            return PlaneBound { compliance, ..self.velocity_bound(wall, state, Guide::Ring(ring)) };
        }
        let (w, rate) = (body.seen(wall, &frame.q), body.seen(wall, &frame.v));
        let (bound, compliance) = face.spring_bound(w, rate, span);
        let guide = Guide::Flat(contact.point.normal, -face.sign * (rate + bound));
        PlaneBound { compliance, ..self.velocity_bound(wall, state, guide) }
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
            let contact = self.all[wall];
            if !body.walls[wall].law.is_rigid() {
                let spring = self.spring(wall, (body, frame), (length, THETA));
                self.holds.push(PlaneBound { slides: contact.slides(), ..spring });
                continue;
            }
            if contact.place != Place::Resting || length <= INSTANT * body.h {
                continue;
            }
            let behind = (-self.gap(wall, body, &frame.q).0).max(0.0) / body.h;
            let guide = match contact.round {
                None => Guide::Flat(contact.normal, -behind),
                Some(_) => Guide::Chord { return_rate: 2.0 * behind },
            };
            self.holds.push(PlaneBound { slides: contact.slides(), ..self.velocity_bound(wall, (body, frame), guide) });
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
            let hold = if body.walls[wall].law.is_rigid() {
                let (gap, normal) = self.gap(wall, body, &frame.q);
                let guide = match self.all[wall].round {
                    None => Guide::Flat(normal, gap / length),
                    Some((_, gap)) => Guide::End { gap },
                };
                self.velocity_bound(wall, (body, frame), guide)
            } else {
                self.spring(wall, (body, frame), (length, 1.0))
            };
            self.holds.push(hold);
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
        (delta, length): (&Vec<f64>, f64),
    ) -> Option<(f64, Event)> {
        let mut first: Option<(f64, Event)> = None;
        let mut add = |at: f64, event: Event| {
            if first.is_none_or(|(earliest, _)| at < earliest) {
                first = Some((at, event));
            }
        };
        for (wall, face) in body.walls.iter().enumerate() {
            let contact = &self.all[wall];
            let rests = contact.place == Place::Resting;
            if rests || (contact.pushes && contact.point.friction.acts()) {
                let ahead = self.ahead(body, frame, Event::Reversal(wall), (delta, length));
                let slides = contact.slides() != 0.0;
                if slides && ahead.left < -ahead.met {
                    let start = contact.rate[1].abs();
                    add(length * start / (start - ahead.left), Event::Reversal(wall));
                }
                // In the first and the last of a step's roundings it is not worth a part.
                let slips = contact.slips().map(|time| time - frame.start);
                if let Some(at) = slips.filter(|at| !slides && *at > SOON * body.h && *at < length - SOON * body.h) {
                    add(at, Event::Slip(wall));
                }
            }
            if rests {
                continue;
            }
            let damped = face.law.damping() > 0.0;
            if !face.law.is_rigid() && !damped {
                continue;
            }
            let crossing = match contact.round {
                None => {
                    let path = self.gap_path(body, frame, wall, (delta, length));
                    if damped && path.gap <= body.touch {
                        continue;
                    }
                    path.crossing(body.touch)
                }
                Some(_) if damped && self.gap(wall, body, &frame.q).0 <= body.touch => continue,
                Some(_) => self.round_path(frame, wall, (delta, length)).and_then(|path| path.crossing(body.touch)),
            };
            if let Some(at) = crossing {
                add(at, Event::Crossing(wall));
            }
        }
        first
    }

    fn ahead(
        &self,
        body: &Body<Matrices>,
        frame: &Frame<Matrices>,
        event: Event,
        (delta, length): (&Vec<f64>, f64),
    ) -> Ahead {
        match event {
            Event::Reversal(wall) => {
                let contact = &self.all[wall];
                // The direction of the friction over the part.
                let hold = self.holds.iter().find(|hold| hold.wall == wall);
                let change = self.pair(wall, delta);
                let normal = hold.map_or(contact.normal, |hold| hold.normal(hold.way(change, (length, THETA))));
                let along = |[y, z]: [f64; 2]| contact.rate[1].signum() * (normal[0] * z - normal[1] * y);
                let (start, change) = (along(self.pair(wall, &frame.v)), along(change));
                Ahead { left: start + change, rate: change / length, met: body.touch / body.h }
            }
            Event::Slip(wall) => {
                let at = self.all[wall].slips().map_or(length, |time| time - frame.start);
                Ahead { left: at - length, rate: -1.0, met: SOON * body.h }
            }
            Event::Crossing(wall) => {
                let (left, rate) = match self.round_path(frame, wall, (delta, length)) {
                    None => {
                        let path = self.gap_path(body, frame, wall, (delta, length));
                        return Ahead { left: path.end(), rate: path.rate + path.change, met: body.touch };
                    }
                    Some(path) => path.end(),
                };
                // The search aims at half of the touching distance, so that rounding leaves the
                // body in front of the wall.
                Ahead { left: left - 0.5 * body.touch, rate, met: 0.5 * body.touch }
            }
        }
    }

    fn forget(&mut self) {
        self.all.iter_mut().for_each(PlaneContact::forget);
    }

    fn keep(&mut self, body: &Body<Matrices>, part: &Part<Matrices>, frame: &Frame<Matrices>, length: f64) {
        self.unsettled += u64::from(!std::mem::replace(&mut self.settled, true));
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

impl PlaneContacts {
    /// The gap of a flat wall along a path.
    fn gap_path(
        &self,
        body: &Body<Matrices>,
        frame: &Frame<Matrices>,
        wall: usize,
        (delta, length): (&Vec<f64>, f64),
    ) -> GapPath {
        let face = body.walls[wall];
        let [rate, change] = [&frame.v, delta].map(|v| face.sign * body.seen(wall, v));
        GapPath { gap: -face.depth(body.seen(wall, &frame.q)), rate, change, span: length }
    }

    /// The path of the place of a round wall; `None` for a flat one.
    fn round_path(&self, frame: &Frame<Matrices>, wall: usize, (delta, length): (&Vec<f64>, f64)) -> Option<RoundPath> {
        let (centre, gap) = self.all[wall].round?;
        let from = self.offset(wall, centre, &frame.q);
        let [rate, change] = [&frame.v, delta].map(|v| self.pair(wall, v));
        Some(RoundPath { from, rate, change, span: length, gap })
    }
}
