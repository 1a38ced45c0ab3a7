//! The ends of lasting contacts.

use super::contact_changes::ContactChanges;
use super::jump::{Jump, Struck};
use super::key_terms::{Instant, KeyTerms};
use super::stretch::Stretch;
use super::structure::{At, StructureVariation};
use crate::flow::Propagator;
use crate::step::Step;

impl StructureVariation {
    /// Notes by how much the ends and departure speeds of lasting contacts change that end at the
    /// end of `step`, where their forces vanish and nothing else happens: the end moves by −δr/ṙ.
    pub fn note_ends(&mut self, step: &Step<'_>, stretch: &Stretch<'_>, columns: &[f64]) {
        let Self { flow, walls, v, a, keys, .. } = self;
        let n = v.len();
        for contact in step.closed.iter().filter(|contact| contact.start < step.end) {
            let wall = contact.wall;
            let Some((at, rate)) = walls.get(wall).zip(stretch.force_rate_at_end(wall)) else { continue };
            let pull = flow.body.rows.dot(at.row, a);
            for (number, (terms, change)) in keys.terms.iter().zip(columns.chunks_exact(2 * n)).enumerate() {
                let later = -keys.contacts.force(wall, number) / rate;
                let faster = flow.body.rows.dot(at.row, &change[n..]) + terms.along(wall, v) + pull * later;
                keys.contacts.set_end(wall, number, [later, at.sign * faster]);
            }
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
                    None => flow.body.rows.dot(at.row, &change[n..]) + terms.along(contact.wall, v),
                };
                keys.contacts.set_end(contact.wall, number, [0.0, at.sign * faster]);
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
