//! How the flat and round walls of [`PlaneContacts`] bound the motion over a part of a step.

use super::super::body::Body;
use super::super::frame::Frame;
use super::super::matrices::Matrices;
use super::contacts::Place;
use super::part::THETA;
use super::plane_bound::{Guide, PlaneBound, Plate, Ring};
use super::plane_contacts::{INSTANT, PlaneContacts};

impl PlaneContacts {
    /// How a wall bounds the motion over a part of `length` seconds; `None` where it does not.
    pub(super) fn hold(
        &self,
        wall: usize,
        state: (&Body<Matrices>, &Frame<Matrices>),
        length: f64,
    ) -> Option<PlaneBound> {
        let ((body, frame), contact) = (state, &self.all[wall]);
        let bound = if !body.walls[wall].law.is_rigid() {
            self.spring(wall, state, (length, THETA))
        } else if contact.place == Place::Resting && length > INSTANT * body.h {
            let behind = (-self.gap(wall, body, &frame.q).0).max(0.0) / body.h;
            let guide = match contact.round {
                None => Guide::Flat(contact.normal, -behind),
                Some(_) => Guide::Chord { return_rate: 2.0 * behind },
            };
            self.velocity_bound(wall, state, guide)
        } else {
            return None;
        };
        Some(PlaneBound { slides: contact.slides(), ..bound })
    }

    /// The same over a part of implicit-euler.
    pub(super) fn hold_at_end(
        &self,
        wall: usize,
        state: (&Body<Matrices>, &Frame<Matrices>),
        length: f64,
    ) -> PlaneBound {
        let (body, frame) = state;
        if !body.walls[wall].law.is_rigid() {
            return self.spring(wall, state, (length, 1.0));
        }
        let (gap, normal) = self.gap(wall, body, &frame.q);
        let guide = match self.all[wall].round {
            None => Guide::Flat(normal, gap / length),
            Some((_, gap)) => Guide::End { gap },
        };
        self.velocity_bound(wall, state, guide)
    }

    /// The contact of a wall with this guide over a part.
    fn velocity_bound(
        &self,
        wall: usize,
        (body, frame): (&Body<Matrices>, &Frame<Matrices>),
        guide: Guide,
    ) -> PlaneBound {
        let contact = &self.all[wall];
        PlaneBound {
            wall,
            rows: contact.point.rows,
            guide,
            friction: contact.friction(),
            kinetic: contact.point.friction.sliding,
            compliance: 0.0,
            slides: 0.0,
            sign: if contact.round.is_some() { 1.0 } else { body.walls[wall].sign },
            from: contact.offset(&self.impact.places, &frame.q),
            rate: self.pair(wall, &frame.v),
            acceleration: contact.acceleration,
        }
    }

    /// The contact of an elastic wall over a part of `length` seconds of the weight θ.
    fn spring(&self, wall: usize, state: (&Body<Matrices>, &Frame<Matrices>), span: (f64, f64)) -> PlaneBound {
        let (body, frame) = state;
        let (face, contact, (length, theta)) = (body.walls[wall], &self.all[wall], span);
        if let (Some((_, gap)), Some(spring)) = (contact.round, face.law.spring()) {
            let from = contact.offset(&self.impact.places, &frame.q);
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
