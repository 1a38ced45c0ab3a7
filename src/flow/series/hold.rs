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

/// The rows that lasting contact holds, and the forces that hold them.
///
/// λ = −W⁻¹ G M⁻¹ F makes G q̈ = 0, and the same holds for every derivative. Where rows depend on one another, W_jI = C W_II for rows j
/// beyond an independent set I, the share of least Σ Wᵢᵢ λᵢ² is taken, as the quadratic programme does: (D_J + C D_I Cᵀ) λ_J = C D_I λ*,
/// λ_I = λ* − Cᵀ λ_J with λ* = −W_II⁻¹ b_I and D the diagonal of W. All of it is linear in b_I, and is kept as one matrix.
#[derive(Debug, Clone, Default)]
pub(crate) struct Hold {
    /// The independent rows, then those that depend on them.
    rows: Vec<Held>,
    independent: usize,
    /// S in λ = −S b_I, by rows of as many entries as there are independent rows.
    inverse: Vec<f64>,
    /// Work space: a Cholesky factor, C, and a vector.
    factor: Vec<f64>,
    relations: Vec<f64>,
    work: Vec<f64>,
    stride: usize,
}

/// A pivot below this share of Wᵢᵢ is none: the row sees what those before it see.
const DEPENDENT: f64 = 1e-10;

impl Hold {
    /// Room for `rows` rows.
    pub fn with_room(rows: usize) -> Self {
        let square = || vec![0.0; rows * rows];
        Self {
            rows: Vec::with_capacity(rows),
            independent: 0,
            inverse: square(),
            factor: square(),
            relations: square(),
            work: vec![0.0; rows],
            stride: rows,
        }
    }

    /// Holds `rows`, and those of `idle` that are independent of them and of one another: the others carry nothing.
    pub fn set(&mut self, body: &Body, rows: impl Iterator<Item = Held> + Clone, idle: impl Iterator<Item = Held>) {
        self.rows.clear();
        for held in rows.clone().chain(idle) {
            self.extend(body, held);
        }
        self.independent = self.rows.len();
        self.invert();
        for held in rows {
            if !self.rows.iter().any(|known| known.row == held.row) {
                self.rows.push(held);
            }
        }
        if self.rows.len() > self.independent {
            self.share(body);
        }
    }

    /// One more row of the Cholesky factor of W, if it is independent of those before.
    fn extend(&mut self, body: &Body, held: Held) {
        let (k, stride) = (self.rows.len(), self.stride);
        let (done, line) = self.factor.split_at_mut(k * stride);
        let whole = body.delassus(held.row, held.row);
        let mut pivot = whole;
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

    /// W_II⁻¹ from its factor.
    fn invert(&mut self) {
        let k = self.independent;
        for column in 0..k {
            let work = &mut self.work[..k];
            work.fill(0.0);
            work[column] = 1.0;
            solve(&self.factor, self.stride, work);
            for (i, &value) in work.iter().enumerate() {
                self.inverse[i * k + column] = value;
            }
        }
    }

    /// The share of the rows that depend on others.
    fn share(&mut self, body: &Body) {
        let Self { rows, independent, inverse, factor, relations, work, stride } = self;
        let (k, stride) = (*independent, *stride);
        let (first, rest) = rows.split_at(k);
        let size = |held: &Held| body.delassus(held.row, held.row);
        for (j, held) in rest.iter().enumerate() {
            for i in 0..k {
                let sum =
                    first.iter().enumerate().map(|(l, other)| body.delassus(held.row, other.row) * inverse[l * k + i]);
                relations[j * k + i] = sum.sum();
            }
        }
        for j in 0..rest.len() {
            for l in 0..=j {
                let (a, b) = (&relations[j * k..(j + 1) * k], &relations[l * k..(l + 1) * k]);
                let product: f64 = a.iter().zip(b).zip(first).map(|((a, b), held)| a * b * size(held)).sum();
                let whole = product + if j == l { size(&rest[j]) } else { 0.0 };
                let dot: f64 = (0..l).map(|m| factor[j * stride + m] * factor[l * stride + m]).sum();
                let left = whole - dot;
                factor[j * stride + l] = if j == l { left.sqrt() } else { left / factor[l * stride + l] };
            }
        }
        for column in 0..k {
            for (j, work) in work.iter_mut().enumerate().take(rest.len()) {
                let terms = first
                    .iter()
                    .enumerate()
                    .map(|(i, held)| relations[j * k + i] * size(held) * inverse[i * k + column]);
                *work = terms.sum();
            }
            solve(factor, stride, &mut work[..rest.len()]);
            for (j, &value) in work.iter().enumerate().take(rest.len()) {
                inverse[(k + j) * k + column] = value;
                for i in 0..k {
                    inverse[i * k + column] -= relations[j * k + i] * value;
                }
            }
        }
    }

    /// The rows held.
    #[inline]
    pub fn rows(&self) -> &[Held] {
        &self.rows
    }

    /// The rows that are independent of one another.
    #[inline]
    pub fn independent(&self) -> &[Held] {
        &self.rows[..self.independent]
    }

    /// Row `i` of S: one entry for each independent row.
    #[inline]
    pub fn inverse(&self, i: usize) -> &[f64] {
        let k = self.independent;
        &self.inverse[i * k..(i + 1) * k]
    }

    /// Puts displacements that are there to rounding exactly where the rows are held, by the nearest change in the metric of M.
    pub fn place(&self, body: &Body, q: &mut [f64], scratch: &mut [f64]) {
        for (b, held) in scratch.iter_mut().zip(self.independent()) {
            *b = held.position - body.rows.dot(held.row, q);
        }
        self.change(body, q, scratch);
    }

    /// Takes from velocities what the rows still see of them, in the same way.
    pub fn stop(&self, body: &Body, v: &mut [f64], scratch: &mut [f64]) {
        for (b, held) in scratch.iter_mut().zip(self.independent()) {
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

/// Solves L Lᵀ x = x in place, with L by rows of `stride`.
fn solve(factor: &[f64], stride: usize, x: &mut [f64]) {
    for i in 0..x.len() {
        let line = &factor[i * stride..=i * stride + i];
        let dot: f64 = line[..i].iter().zip(&x[..i]).map(|(l, x)| l * x).sum();
        x[i] = (x[i] - dot) / line[i];
    }
    for i in (0..x.len()).rev() {
        x[i] /= factor[i * stride + i];
        for j in 0..i {
            x[j] -= factor[i * stride + j] * x[i];
        }
    }
}
