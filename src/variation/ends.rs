//! The ends of lasting contacts.

use super::stretch::Stretch;
use super::structure::StructureVariation;
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
