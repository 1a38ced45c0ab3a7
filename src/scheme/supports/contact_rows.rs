//! The places where contacts push, and the motion that their impulses cause there.

use crate::linear::{Factor, Rows, Segment};
use crate::scene::Row;

/// The rows of all places, and the response of the structure to an impulse on each: A⁻¹gᵀ, and W =
/// G A⁻¹ Gᵀ. All of it is computed once, since only the directions of the contacts change.
#[derive(Debug)]
pub(in crate::scheme) struct ContactRows {
    rows: Vec<Segment>,
    /// A⁻¹gᵢᵀ.
    lift: Vec<Segment>,
    /// W, row by row.
    delassus: Vec<f64>,
    /// The rows as they were given, of n entries.
    sparse: Rows,
    n: usize,
}

impl ContactRows {
    /// For a structure of `n` degrees of freedom with the factor of A.
    pub fn new(n: usize, rows: &[&Row], factor: &mut Factor) -> Self {
        let sparse = Rows::new(n, rows.iter().map(|row| row.entries()));
        let count = sparse.count();
        let (rows, lift) = (Vec::with_capacity(count), Vec::with_capacity(count));
        let mut places = Self { rows, lift, delassus: vec![0.0; count * count], sparse, n };
        places.rows = (0..count).map(|i| Segment::of(&places.dense(i))).collect();
        places.renew(factor);
        places
    }

    /// Row `i` with its zeros.
    fn dense(&self, i: usize) -> Vec<f64> {
        let mut x = vec![0.0; self.n];
        self.sparse.add_transposed(i, 1.0, &mut x);
        x
    }

    /// Computes the responses anew, for another A.
    pub fn renew(&mut self, factor: &mut Factor) {
        let count = self.count();
        self.lift.clear();
        for i in 0..count {
            let mut x = self.dense(i);
            factor.solve(&mut x);
            for j in 0..count {
                self.delassus[j * count + i] = self.sparse.dot(j, &x);
            }
            self.lift.push(Segment::of(&x));
        }
    }

    /// Number of rows.
    pub fn count(&self) -> usize {
        self.rows.len()
    }

    /// g·x of a row.
    #[inline(always)]
    pub fn seen(&self, row: usize, x: &[f64]) -> f64 {
        self.rows[row].dot(x)
    }

    /// g·x of two rows.
    #[inline(always)]
    pub fn pair(&self, [y, z]: [usize; 2], x: &[f64]) -> [f64; 2] {
        [self.seen(y, x), self.seen(z, x)]
    }

    /// The motion of row `i` by a unit impulse on row `j`.
    #[inline]
    pub fn response(&self, i: usize, j: usize) -> f64 {
        self.delassus[i * self.count() + j]
    }

    /// The motion of `to`, in the direction `along`, by an impulse on `from`.
    #[inline]
    pub fn between(&self, to: ([usize; 2], [f64; 2]), from: ([usize; 2], [f64; 2])) -> f64 {
        let ((to, along), (from, push)) = (to, from);
        let mut sum = 0.0;
        for (i, along) in to.into_iter().zip(along) {
            for (j, push) in from.into_iter().zip(push) {
                sum += along * push * self.response(i, j);
            }
        }
        sum
    }

    /// Adds the motion of all rows by the impulse `push` on `rows` to `y`.
    #[inline]
    pub fn add(&self, rows: [usize; 2], push: [f64; 2], y: &mut [f64]) {
        // W is symmetric: its rows are its columns.
        let count = self.count();
        for (row, push) in rows.into_iter().zip(push) {
            if push != 0.0 {
                let column = &self.delassus[row * count..(row + 1) * count];
                y.iter_mut().zip(column).for_each(|(y, w)| *y += push * w);
            }
        }
    }

    /// Adds the motion of the structure by the impulse of each row to `x`, n entries.
    #[inline(always)]
    pub fn lift(&self, impulse: &[f64], x: &mut [f64]) {
        for (lift, &push) in self.lift.iter().zip(impulse).filter(|(_, push)| **push != 0.0) {
            lift.add(push, x);
        }
    }
}
