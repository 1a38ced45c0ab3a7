//! The places where contacts push, and the motion that their impulses cause there.

use crate::linear::{Factor, Rows};
use crate::scene::Row;

/// The rows of all places, and the response of the structure to an impulse on each: A⁻¹gᵀ, and W =
/// G A⁻¹ Gᵀ. All of it is computed once, since only the directions of the contacts change.
#[derive(Debug)]
pub(super) struct Places {
    rows: Rows,
    /// A⁻¹gᵢᵀ, n entries for each row.
    lift: Vec<f64>,
    /// W, row by row.
    delassus: Vec<f64>,
    n: usize,
}

impl Places {
    /// For a structure of `n` degrees of freedom with the factor of A.
    pub fn new(n: usize, rows: &[&Row], factor: &mut Factor) -> Self {
        let rows = Rows::new(n, rows.iter().map(|row| row.entries()));
        let count = rows.count();
        let mut lift = vec![0.0; n * count];
        let mut delassus = vec![0.0; count * count];
        for (i, x) in lift.chunks_exact_mut(n).enumerate() {
            rows.add_transposed(i, 1.0, x);
            factor.solve(x);
            for j in 0..count {
                delassus[j * count + i] = rows.dot(j, x);
            }
        }
        Self { rows, lift, delassus, n }
    }

    /// Number of rows.
    pub fn count(&self) -> usize {
        self.rows.count()
    }

    /// g·x of a row.
    #[inline]
    pub fn seen(&self, row: usize, x: &[f64]) -> f64 {
        self.rows.dot(row, x)
    }

    /// g·x of two rows.
    #[inline]
    pub fn pair(&self, rows: [usize; 2], x: &[f64]) -> [f64; 2] {
        rows.map(|row| self.rows.dot(row, x))
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
    #[inline]
    pub fn lift(&self, impulse: &[f64], x: &mut [f64]) {
        for (lift, &push) in self.lift.chunks_exact(self.n).zip(impulse) {
            if push != 0.0 {
                x.iter_mut().zip(lift).for_each(|(x, lift)| *x += push * lift);
            }
        }
    }
}
