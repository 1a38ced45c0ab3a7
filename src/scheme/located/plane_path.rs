//! The path of a part of a step past walls in two planes, and the first event on it.

use super::super::body::Body;
use super::super::frame::Frame;
use super::super::matrices::Matrices;
use super::super::supports::ContactRows;
use super::contacts::{Ahead, Event, Place};
use super::crossing::GapPath;
use super::part::THETA;
use super::plane_bound::PlaneBound;
use super::plane_contact::PlaneContact;
use super::round_path::RoundPath;

/// A part shorter than this share of the step is not worth the begin of a slide.
const SOON: f64 = 1e-9;

/// The path of a part from the state of `frame`.
#[derive(Debug, Clone, Copy)]
pub(super) struct PlanePath<'a> {
    pub contacts: &'a [PlaneContact],
    /// The bounds of the part.
    pub holds: &'a [PlaneBound],
    pub places: &'a ContactRows,
    pub body: &'a Body<Matrices>,
    pub frame: &'a Frame<Matrices>,
    /// The change of the velocity, m/s, and the length of the part, s.
    pub delta: &'a Vec<f64>,
    pub length: f64,
}

impl PlanePath<'_> {
    /// True if the motion is that without walls, apart from crossings.
    pub fn is_free(&self) -> bool {
        let clear = |contact: &PlaneContact| {
            let face = self.body.walls[contact.wall];
            if face.law.is_rigid() {
                return true;
            }
            match self.round(contact) {
                Some(path) => path.stays_within(),
                None => {
                    let path = self.flat(contact);
                    path.gap >= 0.0 && path.end() >= 0.0
                }
            }
        };
        self.contacts.iter().all(|contact| matches!(contact.place, Place::Away | Place::Leaving) && clear(contact))
    }

    /// The first event, and its instant within the part, s.
    pub fn first_event(&self) -> Option<(f64, Event)> {
        let first = |contact| {
            let within = [self.reversal(contact), self.slip(contact), self.crossing(contact)];
            within.into_iter().flatten().min_by(|a, b| a.0.total_cmp(&b.0))
        };
        self.contacts.iter().filter_map(first).min_by(|a, b| a.0.total_cmp(&b.0))
    }

    /// True if friction may act on the contact.
    fn rubs(contact: &PlaneContact) -> bool {
        contact.place == Place::Resting || (contact.pushes && contact.point.friction.acts())
    }

    fn reversal(&self, contact: &PlaneContact) -> Option<(f64, Event)> {
        if !Self::rubs(contact) || contact.slides() == 0.0 {
            return None;
        }
        let (event, start) = (Event::Reversal(contact.wall), contact.rate[1].abs());
        let Ahead { left, met, .. } = self.ahead(event);
        (left < -met).then(|| (self.length * start / (start - left), event))
    }

    fn slip(&self, contact: &PlaneContact) -> Option<(f64, Event)> {
        if !Self::rubs(contact) || contact.slides() != 0.0 {
            return None;
        }
        // In the first and the last of a step's roundings it is not worth a part.
        let soon = SOON * self.body.h;
        let at = contact.slips().map(|time| time - self.frame.start);
        at.filter(|at| *at > soon && *at < self.length - soon).map(|at| (at, Event::Slip(contact.wall)))
    }

    fn crossing(&self, contact: &PlaneContact) -> Option<(f64, Event)> {
        let (law, touch) = (self.body.walls[contact.wall].law, self.body.touch);
        if contact.place == Place::Resting {
            return None;
        }
        // An elastic wall that pushes is not entered again.
        let elastic = !law.is_rigid();
        let at = match self.round(contact) {
            Some(_) if elastic && contact.gap((self.body, self.places), &self.frame.q).0 <= touch => None,
            Some(path) => path.crossing(touch),
            None => Some(self.flat(contact)).filter(|path| !elastic || path.gap > touch)?.crossing(touch),
        };
        at.map(|at| (at, Event::Crossing(contact.wall)))
    }

    /// How far its end is from an event.
    pub fn ahead(&self, event: Event) -> Ahead {
        let (contact, touch) = (&self.contacts[event.wall()], self.body.touch);
        match event {
            Event::Reversal(wall) => {
                // The direction of the friction over the part.
                let hold = self.holds.iter().find(|hold| hold.wall == wall);
                let [start, change] = [&self.frame.v, self.delta].map(|v| self.places.pair(contact.point.rows, v));
                let span = (self.length, THETA);
                let normal = hold.map_or(contact.normal, |hold| hold.normal(hold.way(change, span)));
                let along = |[y, z]: [f64; 2]| contact.rate[1].signum() * (normal[0] * z - normal[1] * y);
                let change = along(change);
                Ahead { left: along(start) + change, rate: change / self.length, met: touch / self.body.h }
            }
            Event::Slip(_) => {
                let at = contact.slips().map_or(self.length, |time| time - self.frame.start);
                Ahead { left: at - self.length, rate: -1.0, met: SOON * self.body.h }
            }
            Event::Crossing(_) => match self.round(contact) {
                Some(path) => {
                    let (left, rate) = path.end();
                    // The search aims at half of the touching distance, so that rounding leaves the
                    // body in front of the wall.
                    Ahead { left: left - 0.5 * touch, rate, met: 0.5 * touch }
                }
                None => {
                    let path = self.flat(contact);
                    Ahead { left: path.end(), rate: path.rate + path.change, met: touch }
                }
            },
        }
    }

    /// The gap of a flat wall.
    fn flat(&self, contact: &PlaneContact) -> GapPath {
        let (body, face) = (self.body, self.body.walls[contact.wall]);
        let [rate, change] = [&self.frame.v, self.delta].map(|v| face.sign * body.seen(contact.wall, v));
        GapPath { gap: -face.depth(body.seen(contact.wall, &self.frame.q)), rate, change, span: self.length }
    }

    /// The path of the place of a round wall; `None` for a flat one.
    fn round(&self, contact: &PlaneContact) -> Option<RoundPath> {
        let (_, gap) = contact.round?;
        let from = contact.offset(self.places, &self.frame.q);
        let [rate, change] = [&self.frame.v, self.delta].map(|v| self.places.pair(contact.point.rows, v));
        Some(RoundPath { from, rate, change, span: self.length, gap })
    }
}
