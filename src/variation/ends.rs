//! The ends of lasting contacts.

use super::structure::StructureVariation;
use crate::flow::Series;
use crate::step::Step;

impl StructureVariation {
    /// Notes by how much the ends and departure speeds of lasting contacts change that end at the
    /// end of `step`, where their forces vanish and nothing else happens: the end moves by −δr/ṙ.
    pub fn note_ends(&mut self, step: &Step<'_>, series: &Series, columns: &[f64]) {
        let Self { flow, walls, v, a, keys, .. } = self;
        let n = v.len();
        for contact in step.closed.iter().filter(|contact| contact.start < step.end) {
            let wall = contact.wall;
            let acts = series.acting().find(|acting| acting.0 == wall);
            let (Some(at), Some((_, force, share))) = (walls.get(wall), acts) else { continue };
            let x = series.span();
            let slope = force.iter().enumerate().skip(1).rev().fold(0.0, |sum, (k, c)| sum * x + k as f64 * c);
            let (rate, pull) = (share * slope / series.unit(), flow.body.rows.dot(at.row, a));
            for (number, (terms, change)) in keys.terms.iter().zip(columns.chunks_exact(2 * n)).enumerate() {
                let later = -keys.contacts.force(wall, number) / rate;
                let faster = flow.body.rows.dot(at.row, &change[n..]) + terms.along(wall, v) + pull * later;
                keys.contacts.set_end(wall, number, [later, at.sign * faster]);
            }
        }
    }
}
