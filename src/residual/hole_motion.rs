//! The place of a round hole over a step: where it is and how fast, at both ends, and the terms
//! that add up to each, from which their rounding errors follow.

use super::Judge;
use crate::scene::{Hole, PlaneRows};
use crate::step::Step;

/// A quantity at a place: its values in y and z, and the sum of the magnitudes of the terms of
/// both.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct AtPlace {
    pub value: [f64; 2],
    pub terms: f64,
}

/// Several vectors of one value per degree of freedom, as the place `at` sees them. They are taken
/// together, since going through the rows costs more than the products.
fn at_place<const K: usize>(at: &PlaneRows, vectors: [&[f64]; K]) -> [AtPlace; K] {
    let n = vectors.iter().map(|x| x.len()).min().unwrap_or(0);
    let vectors = vectors.map(|x| &x[..n]);
    let [y, z] = [&at.y, &at.z].map(|row| {
        let (mut values, mut terms) = ([0.0; K], [0.0; K]);
        for &(i, weight) in row.entries().iter().filter(|entry| entry.0 < n) {
            for ((value, sum), x) in values.iter_mut().zip(&mut terms).zip(&vectors) {
                let term = weight * x[i];
                (*value, *sum) = (*value + term, *sum + term.abs());
            }
        }
        (values, terms)
    });
    std::array::from_fn(|k| AtPlace { value: [y.0[k], z.0[k]], terms: y.1[k] + z.1[k] })
}

/// Sum of the magnitudes of the terms of both rows of a place.
pub(super) fn terms(at: &PlaneRows, x: &[f64]) -> f64 {
    let [seen] = at_place(at, [x]);
    seen.terms
}

/// The place of a hole in a step.
#[derive(Debug, Clone, Copy)]
pub(super) struct HoleMotion {
    /// Displacement from the centre at both ends of the step, m.
    pub start: [f64; 2],
    pub end: [f64; 2],
    /// Velocities that enter and leave the momentum balance, m/s, with their terms.
    pub before: AtPlace,
    pub after: AtPlace,
    /// Velocity that the blows of the step give, m/s.
    pub struck: AtPlace,
    /// Size of the terms of both places with centre and gap, m.
    pub size: f64,
}

impl Judge {
    /// The place of `hole` in `step`.
    pub(super) fn hole_motion(&self, step: &Step<'_>, hole: &Hole<'_>) -> HoleMotion {
        let (before, after, struck) = (step.velocity_before, step.velocity_after, &self.blows.struck[..]);
        let [start, end, before, after, struck] = at_place(hole.at, [&self.q[..], step.q, before, after, struck]);
        let [cy, cz] = hole.centre;
        let [from, to] = [start, end].map(|at| [at.value[0] - cy, at.value[1] - cz]);
        let size = start.terms + end.terms + (cy.abs() + cz.abs()) + hole.gap;
        HoleMotion { start: from, end: to, before, after, struck, size }
    }

    /// Size of the terms that add up to a place's distance from the centre, for its rounding error,
    /// and of its way within a step, m; with those of the other degrees of freedom, from which the
    /// equations of the step find it.
    pub(super) fn way(&self, hole: &Hole<'_>, motion: &HoleMotion) -> f64 {
        motion.size + self.h * (motion.before.terms + motion.after.terms) + self.noise.reach(hole.index)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scene::Row;

    #[test]
    fn vectors_at_a_place_are_what_its_rows_and_their_terms_give_one_by_one() {
        let at = PlaneRows { y: Row::new(vec![(2, -0.1), (0, 0.7)]), z: Row::new(vec![(1, 0.3), (2, 1e-3)]) };
        let vectors = [[0.1, -0.2, 3.0], [-7.0, 1e-9, 0.4]];
        let both = at_place(&at, [&vectors[0], &vectors[1]]);
        for (x, seen) in vectors.iter().zip(both) {
            let size = |row: &Row| row.entries().iter().map(|&(i, weight)| (weight * x[i]).abs()).sum::<f64>();
            assert_eq!((seen.value, seen.terms), (at.dot(x), size(&at.y) + size(&at.z)));
        }
    }
}
