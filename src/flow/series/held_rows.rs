//! Rows that are held: rigid walls in lasting contact.

use super::SeriesBody;

/// A row held in place, and the side of the walls that hold it.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct HeldRow {
    pub row: usize,
    /// The sign of the walls' force: +1 for lower walls, −1 for upper ones.
    pub sign: f64,
    /// Where it is held, m.
    pub position: f64,
}

/// The rows held in lasting contact, and the forces that hold them.
///
/// λ = −W⁻¹ G M⁻¹ F makes G q̈ = 0, and the same holds for every derivative. Where rows are
/// linearly dependent, W_jI = C W_II for rows j beyond an independent set I, the solution of least
/// Σ Wᵢᵢ λᵢ² is taken, as in the quadratic programme: (D_J + C D_I Cᵀ) λ_J = C D_I λ*, λ_I = λ* −
/// Cᵀ λ_J with λ* = −W_II⁻¹ b_I and D the diagonal of W. All of it is linear in b_I, and is kept as
/// one matrix.
#[derive(Debug, Clone, Default)]
pub(crate) struct HeldRows {
    /// The independent rows, then those that depend on them.
    rows: Vec<HeldRow>,
    independent: usize,
    /// S in λ = −S b_I, by rows of as many entries as there are independent rows.
    inverse: Vec<f64>,
    /// The rows of the last setting, while they are set again.
    last: Vec<HeldRow>,
    /// Work space: a Cholesky factor by rows without gaps, C, and a vector.
    factor: Vec<f64>,
    relations: Vec<f64>,
    work: Vec<f64>,
    /// Number of passes that find the forces: each after the first removes the rounding error of
    /// the one before.
    passes: usize,
}

/// With a pivot below this share of Wᵢᵢ a row depends on those before it.
const DEPENDENT: f64 = 1e-10;

/// Number of rows for which memory is reserved at the start.
const ROOM: usize = 64;

/// A pivot below this share of Wᵢᵢ has lost digits that the forces need. One example is a light
/// mass that is held, with a held wall between it and a heavy mass.
const COARSE: f64 = 1e-3;

/// Number of passes where there is such a pivot: the first leaves at most 1e-16/1e-10, each further
/// one the same share of that.
const PASSES: usize = 3;

impl HeldRows {
    /// Reserves memory for `rows` rows, up to [`ROOM`]; more is allocated when more are held.
    pub fn with_room(rows: usize) -> Self {
        let rows = rows.min(ROOM);
        let square = || Vec::with_capacity(rows * rows);
        Self {
            rows: Vec::with_capacity(rows),
            independent: 0,
            last: Vec::with_capacity(rows),
            inverse: square(),
            factor: square(),
            relations: square(),
            work: Vec::with_capacity(rows),
            passes: 1,
        }
    }

    /// Holds `rows`, and those of `idle` that are independent of them and of one another; the other
    /// rows of `idle` carry no force.
    pub fn set(
        &mut self,
        body: &SeriesBody,
        rows: impl Iterator<Item = HeldRow> + Clone,
        idle: impl Iterator<Item = HeldRow>,
    ) {
        self.rows.clear();
        self.factor.clear();
        self.passes = 1;
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

    /// Holds the same rows again, after rows of holes have turned: each at the position (m) that
    /// `position` gives for its row and its last position.
    pub fn renew(&mut self, body: &SeriesBody, position: impl Fn(usize, f64) -> f64) {
        let mut rows = std::mem::take(&mut self.last);
        rows.clear();
        rows.extend(self.rows.iter().map(|held| HeldRow { position: position(held.row, held.position), ..*held }));
        self.set(body, rows.iter().copied(), std::iter::empty());
        self.last = rows;
    }

    /// Appends a row to the Cholesky factor of W, if it is independent of those before.
    fn extend(&mut self, body: &SeriesBody, held: HeldRow) {
        let (k, whole) = (self.rows.len(), body.delassus(held.row, held.row));
        let (mut pivot, start) = (whole, self.factor.len());
        for (j, other) in self.rows.iter().enumerate() {
            let above = &self.factor[line(j)..=line(j) + j];
            let dot: f64 = above[..j].iter().zip(&self.factor[start..]).map(|(a, b)| a * b).sum();
            let entry = (body.delassus(held.row, other.row) - dot) / above[j];
            self.factor.push(entry);
            pivot -= entry * entry;
        }
        if pivot > DEPENDENT * whole {
            if pivot < COARSE * whole {
                self.passes = PASSES;
            }
            self.factor.push(pivot.sqrt());
            self.rows.push(held);
        } else {
            self.factor.truncate(line(k));
        }
    }

    /// W_II⁻¹ from its factor.
    fn invert(&mut self) {
        let k = self.independent;
        self.inverse.clear();
        self.inverse.resize(k * k, 0.0);
        for column in 0..k {
            let work = &mut self.work;
            work.clear();
            work.resize(k, 0.0);
            work[column] = 1.0;
            solve(&self.factor, work);
            for (i, &value) in work.iter().enumerate() {
                self.inverse[i * k + column] = value;
            }
        }
    }

    /// Computes the forces' share on the dependent rows.
    fn share(&mut self, body: &SeriesBody) {
        let Self { rows, independent, inverse, factor, relations, work, .. } = self;
        let k = *independent;
        let (first, rest) = rows.split_at(k);
        inverse.resize(rows.len() * k, 0.0);
        relations.clear();
        relations.resize(rest.len() * k, 0.0);
        factor.clear();
        work.clear();
        work.resize(rest.len(), 0.0);
        let size = |held: &HeldRow| body.delassus(held.row, held.row);
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
                let dot: f64 = (0..l).map(|m| factor[line(j) + m] * factor[line(l) + m]).sum();
                let left = whole - dot;
                factor.push(if j == l { left.sqrt() } else { left / factor[line(l) + l] });
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
            solve(factor, &mut work[..rest.len()]);
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
    pub fn rows(&self) -> &[HeldRow] {
        &self.rows
    }

    /// The independent rows.
    #[inline]
    pub fn independent(&self) -> &[HeldRow] {
        &self.rows[..self.independent]
    }

    /// Row `i` of S: one entry for each independent row.
    #[inline]
    pub fn inverse(&self, i: usize) -> &[f64] {
        let k = self.independent;
        &self.inverse[i * k..(i + 1) * k]
    }

    /// Adds to `force` (N, n entries; or a derivative of it) the forces that hold the rows, and
    /// calls `tell` with each, row by row, once per pass. Each row then has the acceleration
    /// `wanted`: 0 at a wall, that along the circle at a hole.
    pub fn balance(
        &self,
        body: &SeriesBody,
        force: &mut [f64],
        scratch: &mut [f64],
        wanted: impl Fn(&HeldRow) -> f64,
        mut tell: impl FnMut(usize, f64),
    ) {
        for _ in 0..self.passes {
            for (b, held) in scratch.iter_mut().zip(self.independent()) {
                *b = body.answer(held.row, force) - wanted(held);
            }
            for (i, held) in self.rows.iter().enumerate() {
                let push = -self.inverse(i).iter().zip(&*scratch).map(|(w, b)| w * b).sum::<f64>();
                body.rows.add_transposed(held.row, push, force);
                tell(i, push);
            }
        }
    }

    /// Moves displacements that are within rounding of the held positions exactly onto them, by the
    /// smallest change in the metric of M.
    pub fn place(&self, body: &SeriesBody, q: &mut [f64], scratch: &mut [f64]) {
        self.change(body, q, scratch, |held| held.position);
    }

    /// Makes the velocities of the held rows 0, by the smallest change in the same metric.
    pub fn stop(&self, body: &SeriesBody, v: &mut [f64], scratch: &mut [f64]) {
        self.change(body, v, scratch, |_| 0.0);
    }

    /// Changes `x` by the least change in the metric of M after which each held row has the value
    /// `wanted`.
    pub fn change(&self, body: &SeriesBody, x: &mut [f64], scratch: &mut [f64], wanted: impl Fn(&HeldRow) -> f64) {
        for _ in 0..self.passes {
            for (b, held) in scratch.iter_mut().zip(self.independent()) {
                *b = wanted(held) - body.rows.dot(held.row, x);
            }
            for (i, held) in self.rows.iter().enumerate() {
                let push: f64 = self.inverse(i).iter().zip(&*scratch).map(|(w, b)| w * b).sum();
                body.add_column(held.row, push, x);
            }
        }
    }
}

/// Where row k of a factor begins.
const fn line(k: usize) -> usize {
    k * (k + 1) / 2
}

/// Solves L Lᵀ x = x in place.
fn solve(factor: &[f64], x: &mut [f64]) {
    for i in 0..x.len() {
        let row = &factor[line(i)..=line(i) + i];
        let dot: f64 = row[..i].iter().zip(&x[..i]).map(|(l, x)| l * x).sum();
        x[i] = (x[i] - dot) / row[i];
    }
    for i in (0..x.len()).rev() {
        x[i] /= factor[line(i) + i];
        for j in 0..i {
            x[j] -= factor[line(i) + j] * x[i];
        }
    }
}
