//! `located` on scenes with round walls or friction.

use super::super::Counters;
use super::super::body::Body;
use super::super::frame::{Frame, Stretch};
use super::super::matrices::Matrices;
use super::super::motion::Motion;
use super::contacts::Contacts;
use super::division::Division;
use super::part::THETA;
use super::plane_contacts::PlaneContacts;
use crate::contact::{Episodes, PartRates};
use crate::error::Result;
use crate::qp::Backend;
use crate::scene::{Checked, Scene};
use crate::step::{Contact, Contract, Step};

/// The motion of a scene with round walls or friction.
#[derive(Debug)]
pub(in crate::scheme) struct LocatedPlanar {
    body: Body<Matrices>,
    frame: Frame<Matrices>,
    division: Division<Matrices, PlaneContacts>,
    b: Vec<f64>,
    delta: Vec<f64>,
    episodes: Episodes,
}

impl LocatedPlanar {
    /// `scene` in steps of `h` seconds that satisfy `contract`.
    pub fn new(scene: &Checked, contract: Contract, h: f64) -> Result<Self> {
        let mut body = Body::<Matrices>::new(scene, h)?;
        body.restart(0.0);
        let mut contacts = PlaneContacts::new(scene, &body)?;
        contacts.begin(scene, &scene.initial.q, &scene.initial.v);
        let zero = || vec![0.0; body.n];
        Ok(Self {
            frame: Frame::new(scene)?,
            b: zero(),
            delta: zero(),
            division: Division::new(scene, &body, contacts, Backend::Auto)?,
            episodes: Episodes::new(scene, scene.wall_masses(), contract),
            body,
        })
    }

    /// Makes the step whole, if the body rests at no wall and its path crosses none. Returns
    /// whether it did.
    fn make_whole(&mut self) -> bool {
        let Self { body, frame, division, b, delta, .. } = self;
        division.contacts.release(b, delta);
        division.classify(body, frame);
        if !division.contacts.is_free(body, frame, delta)
            || division.contacts.first_event(body, frame, (delta, body.h)).is_some()
        {
            return false;
        }
        frame.add_change((body.h, THETA), delta);
        division.contacts.forget();
        true
    }

    /// Passes the step to the contact episodes.
    fn record_episodes(&mut self) {
        let Self { frame, episodes, division, body, .. } = self;
        if frame.pushing.is_empty() && episodes.idle() {
            return;
        }
        let length = match frame.stretch {
            Stretch::Part(length) | Stretch::Other(length, _) => length,
            Stretch::Grid | Stretch::OneRestitution => body.h,
        };
        // A flat wall's rates are those of its row, a round one counts as an upper wall.
        let rates = |wall: usize| {
            let sign = if frame.normal[wall] == [0.0; 2] { -body.walls[wall].sign } else { 1.0 };
            let along = |v: &Vec<f64>| sign * division.contacts.rate_along(wall, frame.normal[wall], v);
            let before = sign * division.contacts.rate_at_start(wall, frame.normal[wall], &frame.before, length);
            let struck = along(if frame.blown { &frame.struck } else { &frame.after });
            PartRates { before, arrived: along(&frame.after), struck, after: along(&frame.v) }
        };
        let impulses = (&frame.impulse[..], &frame.jump[..]);
        episodes.observe_part([frame.start, frame.end], length, impulses, &frame.pushing, rates);
    }
}

impl Motion for LocatedPlanar {
    fn advance(&mut self, step: u64, extra: Option<&[f64]>) -> Result<()> {
        self.frame.force(extra);
        self.frame.normal.fill([0.0; 2]);
        if self.division.is_under_way() {
            self.division.make_part(&mut self.body, step, &mut self.frame)?;
        } else {
            let Self { body, frame, b, .. } = self;
            frame.begin(step, body.h);
            (frame.stretch, frame.blown) = (Stretch::Grid, false);
            body.theta_momentum(THETA, frame, b);
            let breaks = self.division.has_break(self.frame.start, self.frame.end);
            if breaks || !self.make_whole() {
                self.division.begin(&self.body, [self.frame.start, self.frame.end], None);
                self.division.make_part(&mut self.body, step, &mut self.frame)?;
            }
        }
        self.frame.check(step)?;
        self.record_episodes();
        Ok(())
    }

    fn is_divided(&self) -> bool {
        self.frame.unfinished
    }

    fn flush(&mut self, tiny: f64) {
        self.frame.flush(tiny, self.body.h, [None, None]);
    }

    fn step(&self, index: u64) -> Step<'_> {
        Step { wedged: &self.division.contacts.impact.wedged, ..self.frame.step(index, self.episodes.closed()) }
    }

    fn restart(&mut self, scene: &Scene, time: f64, q: &[f64], v: &[f64]) -> Result<()> {
        self.frame.restart(time, q, v);
        self.division.restart(&mut self.body, time);
        self.division.contacts.begin(scene, q, v);
        self.episodes.forget();
        Ok(())
    }

    fn open_contacts(&self) -> Vec<Contact> {
        self.episodes.still_open()
    }

    fn count(&self, counters: &mut Counters) {
        self.division.count(counters);
    }
}
