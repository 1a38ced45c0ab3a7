//! The place that a support surrounds: what vectors are there.

use crate::linear::{Columns, Lanes, Pass, Segment, pass};
use crate::scene::{PlaneRows, Scene};
use pulp::Simd;
use std::sync::Arc;

/// Rounding of sums over any number of degrees of freedom, relative to the sum of the magnitudes.
pub(super) const SUM: f64 = 1e-9;

/// A quantity at a place: its values in y and z, and the sum of the magnitudes of the terms of
/// both.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub(super) struct AtPlace {
    pub value: [f64; 2],
    pub terms: f64,
}

/// The rows of a place, prepared for products.
#[derive(Debug, Clone)]
pub(super) struct Place {
    at: PlaneRows,
    /// The rows, if the entries of each follow one another.
    segments: Option<[Segment; 2]>,
    /// Σ |g|/√Mᵢᵢ over both rows: a place has terms of at most this times the largest |qᵢ|√Mᵢᵢ.
    pub weight: f64,
}

impl Place {
    /// `root_mass` has √Mᵢᵢ of each degree of freedom.
    pub fn new(at: &PlaneRows, root_mass: &[f64]) -> Self {
        let both = Segment::following(at.y.entries()).zip(Segment::following(at.z.entries()));
        let n = root_mass.len();
        let fits = |segments: &[Segment; 2]| segments.iter().all(|segment| segment.fits(n));
        let size = |&(i, weight): &(usize, f64)| root_mass.get(i).map_or(0.0, |root: &f64| f64::abs(weight) / root);
        Self {
            segments: both.map(|(y, z)| [y, z]).filter(fits),
            weight: at.y.entries().iter().chain(at.z.entries()).map(size).sum(),
            at: at.clone(),
        }
    }

    /// Several vectors of one value per degree of freedom, as the place sees them. They are taken
    /// together, since going through the rows costs more than the products.
    pub fn seen<'a, const K: usize>(&self, vectors: [&'a [f64]; K]) -> [AtPlace; K]
    where
        [&'a [f64]; K]: Columns<f64, K>,
    {
        let Some([y, z]) = &self.segments else { return at_place(&self.at, vectors) };
        let (y, z) = (y.products(vectors), z.products(vectors));
        std::array::from_fn(|k| AtPlace { value: [y.0[k], z.0[k]], terms: y.1[k] + z.1[k] })
    }

    /// Sum of the magnitudes of the terms of both rows.
    pub fn terms(&self, x: &[f64]) -> f64 {
        let [seen] = self.seen([x]);
        seen.terms
    }

    /// True if the terms of both rows are certain to add up to no more than `most`.
    #[inline(always)]
    pub fn stays_below(&self, most: f64, x: &[f64]) -> bool {
        // No closures here: each would be compiled by itself, without vector instructions.
        match &self.segments {
            Some([y, z]) => (y.size(x) + z.size(x)) * (1.0 + SUM) <= most,
            None => false,
        }
    }

    /// What a step does at the place, from the displacements at its start and at its end and the
    /// velocities that enter and leave its balance; the start moves on for `ahead` seconds. To
    /// rounding, with the terms of all sums in any order; `None` if the entries of a row do not
    /// follow one another, or one row has more of them.
    #[inline(always)]
    pub fn near<S: Simd>(&self, simd: S, ahead: f64, [a, b, c, d]: [&[f64]; 4]) -> Option<NearPlace> {
        let Some([y, z]) = &self.segments else { return None };
        // No closures here either.
        let (in_y, in_z) = (
            [y.beside(a), y.beside(b), y.beside(c), y.beside(d)],
            [z.beside(a), z.beside(b), z.beside(c), z.beside(d)],
        );
        let [(weight_y, a), (_, b), (_, c), (_, d)] = in_y;
        let [(weight_z, e), (_, f), (_, g), (_, h)] = in_z;
        let n = weight_y.len();
        if weight_z.len() != n {
            return None;
        }
        let read = [weight_y, a, b, c, d, weight_z, e, f, g, h];
        let [ahead_y, end_y, ahead_z, end_z, speed] = pass(simd, n, (read, []), &NearRows { ahead });
        Some(NearPlace { ahead: [ahead_y.sum(), ahead_z.sum()], end: [end_y.sum(), end_z.sum()], speed: speed.sum() })
    }
}

/// What a step does at a place, to rounding.
#[derive(Debug, Clone, Copy)]
pub(super) struct NearPlace {
    /// Its displacement some time after the start of the step and at its end, m.
    pub ahead: [f64; 2],
    pub end: [f64; 2],
    /// The sum of the magnitudes of the terms of both rows of its velocity at the end, m/s.
    pub speed: f64,
}

/// From the weights of each row, the displacements that it sees at the start and at the end of a
/// step and the velocities that enter and leave its balance: the sums of [`NearPlace`].
struct NearRows {
    ahead: f64,
}

impl Pass<10, 0, 5> for NearRows {
    #[inline(always)]
    fn of<S: Simd>(
        &self,
        [y, start_y, end_y, before_y, after_y, z, start_z, end_z, before_z, after_z]: [Lanes<S>; 10],
        _: [Lanes<S>; 0],
        [ahead_y, last_y, ahead_z, last_z, speed]: [Lanes<S>; 5],
    ) -> ([Lanes<S>; 0], [Lanes<S>; 5]) {
        let way_y = y * (start_y + before_y * self.ahead);
        let way_z = z * (start_z + before_z * self.ahead);
        let terms = (y * after_y).abs() + (z * after_z).abs();
        ([], [ahead_y + way_y, last_y + y * end_y, ahead_z + way_z, last_z + z * end_z, speed + terms])
    }
}

/// The places of the supports of a scene.
#[derive(Debug)]
pub(super) struct Places {
    pub scene: Arc<Scene>,
    /// Of its holes, and of its other supports.
    pub holes: Vec<Place>,
    pub flats: Vec<Place>,
    /// True if a wall is flat.
    pub has_flats: bool,
}

impl Places {
    /// `None` for a scene without round holes and friction.
    pub fn new(scene: &Arc<Scene>, root_mass: &[f64]) -> Option<Box<Self>> {
        let flats = scene.supports.iter().filter(|support| support.hole(&scene.walls).is_none());
        let places = Self {
            scene: Arc::clone(scene),
            holes: scene.holes().map(|hole| Place::new(hole.at, root_mass)).collect(),
            flats: flats.map(|support| Place::new(&support.at, root_mass)).collect(),
            has_flats: scene.walls.iter().any(|wall| !wall.is_round()),
        };
        scene.turns_or_rubs().then(|| Box::new(places))
    }
}

/// Several vectors at a place whose rows may have any entries.
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

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scene::Row;

    #[test]
    fn vectors_at_a_place_are_what_its_rows_and_their_terms_give_one_by_one() {
        let apart = PlaneRows { y: Row::new(vec![(2, -0.1), (0, 0.7)]), z: Row::new(vec![(1, 0.3), (2, 1e-3)]) };
        let beside = PlaneRows { y: Row::new(vec![(0, -0.1), (1, 0.7)]), z: Row::new(vec![(1, 0.3), (2, 1e-3)]) };
        let vectors = [[0.1, -0.2, 3.0], [-7.0, 1e-9, 0.4]];
        for (at, follow) in [(apart, false), (beside, true)] {
            let place = Place::new(&at, &[1.0; 3]);
            assert_eq!(place.segments.is_some(), follow);
            let both = place.seen([&vectors[0], &vectors[1]]);
            for (x, seen) in vectors.iter().zip(both) {
                let size = |row: &Row| row.entries().iter().map(|&(i, weight)| (weight * x[i]).abs()).sum::<f64>();
                assert_eq!((seen.value, seen.terms), (at.dot(x), size(&at.y) + size(&at.z)));
                assert_eq!([place.terms(x), terms(&at, x)], [seen.terms; 2]);
                assert!(!place.stays_below(seen.terms * (1.0 - 1e-12), x));
                assert_eq!(place.stays_below(seen.terms * (1.0 + 1e-8), x), follow);
            }
        }
    }
}
