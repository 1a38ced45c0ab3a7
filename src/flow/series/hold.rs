//! Rows that are held: rigid walls in lasting contact.

use super::Body;

/// A row held in place, and the side whose walls carry it.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Held {
    pub row: usize,
    /// The sign of the walls' force: +1 for lower walls, −1 for upper ones.
    pub sign: f64,
    /// Where it is held, m.
    pub position: f64,
}

/// The rows that lasting contact holds, with the inverse of the Delassus operator on them.
///
/// λ = −W⁻¹ G M⁻¹ F makes G q̈ = 0, and the same holds for every derivative. A row that depends on those before it is left out: it is held by them, and carries
/// no force.
#[derive(Debug, Clone, Default)]
pub(crate) struct Hold {
    rows: Vec<Held>,
    /// Cholesky factor of W on `rows`, lower, row by row with the room's stride; then its inverse.
    factor: Vec<f64>,
    /// W⁻¹, k × k by rows.
    inverse: Vec<f64>,
    stride: usize,
    work: Vec<f64>,
}

/// A pivot below this share of Wᵢᵢ is none: the row sees what those before it see.
const DEPENDENT: f64 = 1e-10;

impl Hold {
    /// Room for `rows` rows.
    pub fn with_room(rows: usize) -> Self {
        Self {
            rows: Vec::with_capacity(rows),
            factor: vec![0.0; rows * rows],
            inverse: vec![0.0; rows * rows],
            stride: rows,
            work: vec![0.0; rows],
        }
    }

    /// Holds those of `rows` that are independent.
    pub fn set(&mut self, body: &Body, rows: impl Iterator<Item = Held>) {
        self.rows.clear();
        let stride = self.stride;
        for held in rows {
            let k = self.rows.len();
            let (done, line) = self.factor.split_at_mut(k * stride);
            let mut pivot = body.delassus(held.row, held.row);
            let whole = pivot;
            for (j, other) in self.rows.iter().enumerate() {
                let above = &done[j * stride..=j * stride + j];
                let dot: f64 = above[..j].iter().zip(&line[..j]).map(|(a, b)| a * b).sum();
                line[j] = (body.delassus(held.row, other.row) - dot) / above[j];
                pivot -= line[j] * line[j];
            }
            if pivot > DEPENDENT * whole {
                line[k] = pivot.sqrt();
                self.rows.push(held);
            }
        }
        let k = self.rows.len();
        for column in 0..k {
            let work = &mut self.work[..k];
            work.fill(0.0);
            work[column] = 1.0;
            for i in column..k {
                let line = &self.factor[i * stride..=i * stride + i];
                let dot: f64 = line[..i].iter().zip(&work[..i]).map(|(a, b)| a * b).sum();
                work[i] = (work[i] - dot) / line[i];
            }
            for i in (0..k).rev() {
                work[i] /= self.factor[i * stride + i];
                for j in 0..i {
                    work[j] -= self.factor[i * stride + j] * work[i];
                }
            }
            for (i, &value) in work.iter().enumerate() {
                self.inverse[i * k + column] = value;
            }
        }
    }

    /// The rows held.
    #[inline]
    pub fn rows(&self) -> &[Held] {
        &self.rows
    }

    /// W⁻¹, row `i` of k entries.
    #[inline]
    pub fn inverse(&self, i: usize) -> &[f64] {
        let k = self.rows.len();
        &self.inverse[i * k..(i + 1) * k]
    }

    /// Puts displacements that are there to rounding exactly where the rows are held, by the nearest change in the metric of M.
    pub fn place(&self, body: &Body, q: &mut [f64], scratch: &mut [f64]) {
        for (b, held) in scratch.iter_mut().zip(&self.rows) {
            *b = held.position - body.rows.dot(held.row, q);
        }
        self.change(body, q, scratch);
    }

    /// Takes from velocities what the rows still see of them, in the same way.
    pub fn stop(&self, body: &Body, v: &mut [f64], scratch: &mut [f64]) {
        for (b, held) in scratch.iter_mut().zip(&self.rows) {
            *b = -body.rows.dot(held.row, v);
        }
        self.change(body, v, scratch);
    }

    fn change(&self, body: &Body, x: &mut [f64], wanted: &[f64]) {
        for (i, held) in self.rows.iter().enumerate() {
            let push: f64 = self.inverse(i).iter().zip(wanted).map(|(w, b)| w * b).sum();
            body.add_column(held.row, push, x);
        }
    }
}
