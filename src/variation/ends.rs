//! The ends of lasting contacts.

use super::contact_changes::{ContactChanges, is_late};
use super::jump::{Jump, Struck};
use super::key_terms::{Instant, KeyTerms};
use super::stretch::{Release, Stretch};
use super::structure::{At, StructureVariation};
use crate::flow::Propagator;
use crate::step::{Contact, Step};

impl StructureVariation {
    /// Notes what the forces do at the end of `stretch`, of the walls that act in it.
    pub(super) fn note_releases(&mut self, stretch: &Stretch<'_>) {
        let Self { flow, walls, a, keys, releases, .. } = self;
        if keys.terms.is_empty() {
            return;
        }
        for (wall, (at, release)) in walls.iter().zip(releases).enumerate() {
            let acts = (at.during || at.restitution.is_some()).then(|| stretch.force_rate_at_end(wall)).flatten();
            let found = acts.map(|rate| Release { rate, pull: flow.body.rows.dot(at.row, a) });
            *release = found.or_else(|| release.filter(|_| stretch.is_empty()));
        }
    }

    /// Notes by how much end and departure speed of a lasting `contact` change that has just ended,
    /// where its force vanishes and nothing else happens: the end moves by −δr/ṙ. A rest ends
    /// without speed, whatever the keys are.
    pub fn note_end(&mut self, contact: &Contact, columns: &[f64]) {
        let Self { flow, walls, v, keys, releases, .. } = self;
        let (n, wall) = (v.len(), contact.wall);
        let Some((at, Release { rate, pull })) = walls.get(wall).zip(releases.get(wall).copied().flatten()) else {
            return;
        };
        for (number, (terms, change)) in keys.terms.iter().zip(columns.chunks_exact(2 * n)).enumerate() {
            let later = -keys.contacts.force(wall, number) / rate;
            let faster = match at.restitution {
                Some(_) => 0.0,
                None => at.sign * (flow.body.rows.dot(at.row, &change[n..]) + terms.along(wall, v) + pull * later),
            };
            keys.contacts.set_end(wall, number, [later, faster]);
        }
    }

    /// Ends the contacts that have ended before the motion of `step` begins, while the state is
    /// still that at the end of the last one.
    pub fn note_late_ends(&mut self, step: &Step<'_>, columns: &[f64]) {
        for contact in step.closed.iter().filter(|contact| is_late(contact, step)) {
            self.note_end(contact, columns);
            self.keys.contacts.end(contact);
        }
    }
}

impl StructureVariation {
    /// Ends the lasting contacts that the blows at the end of `step` end, and notes by how much
    /// their ends and departure speeds change: a rest ends without speed, a push with the speed
    /// that the blows give, which is not known beside impacts. Neither instant moves.
    pub fn end_with_blow(&mut self, step: &Step<'_>, columns: &[f64]) {
        let Self { flow, walls, v, keys, .. } = self;
        let n = v.len();
        let struck = step.jump.iter().any(|&p| p != 0.0);
        for contact in step.closed.iter().filter(|contact| contact.start < step.end) {
            let Some(at) = walls.get(contact.wall) else { continue };
            for (number, (terms, change)) in keys.terms.iter().zip(columns.chunks_exact(2 * n)).enumerate() {
                let faster = match at.restitution {
                    Some(_) => 0.0,
                    None if struck => f64::NAN,
                    None => at.sign * (flow.body.rows.dot(at.row, &change[n..]) + terms.along(contact.wall, v)),
                };
                keys.contacts.set_end(contact.wall, number, [0.0, faster]);
            }
            keys.contacts.end(contact);
        }
    }
}

impl ContactChanges {
    /// Notes by how much the ends and departure speeds of lasting contacts at other walls change
    /// that end with the impact of `s`, which key number `number` moves by `later` (s): of one that
    /// follows a blow it is not known.
    pub fn note_ends_elsewhere(
        &mut self,
        (flow, jump): (&mut Propagator, &Jump),
        (walls, s): (&[At], &Struck),
        (step, number): (&Step<'_>, usize),
        (dv, later): (&[f64], f64),
        (terms, at): (&KeyTerms, &Instant<'_>),
    ) {
        for contact in step.closed.iter().filter(|contact| contact.start < step.end && !s.held) {
            let elsewhere = |of: &&At| of.row != s.row || of.restitution.is_none();
            let Some(of) = walls.get(contact.wall).filter(elsewhere) else { continue };
            let faster = jump.velocity_after(flow, (dv, later), terms, at);
            let speed = flow.body.rows.dot(of.row, &faster) + terms.along(contact.wall, at.after);
            self.set_end(contact.wall, number, [later, of.sign * speed]);
        }
    }
}
