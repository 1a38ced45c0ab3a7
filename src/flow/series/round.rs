//! A round hole of a structure: the two rows of its place, and the row along its normal, which
//! turns with the motion.

use crate::linear::{Factor, Rows};
use crate::scene::Hole;

/// A round hole. Its row n·P stands beside the rows of the walls, as that of an upper wall at γ +
/// n·c where |w| = γ.
#[derive(Debug)]
pub(crate) struct Round {
    /// Its index among the scene's walls.
    pub wall: usize,
    /// γ, m.
    pub gap: f64,
    /// n.
    pub normal: [f64; 2],
    centre: [f64; 2],
    /// The degrees of freedom of the two rows of the place, with both weights.
    entries: Vec<(usize, [f64; 2])>,
    /// M⁻¹ g_yᵀ and M⁻¹ g_zᵀ, from entry `first` on.
    first: usize,
    columns: Vec<[f64; 2]>,
    /// P M⁻¹ Pᵀ, 1/kg: yy, yz and zz.
    own: [f64; 3],
}

impl Round {
    /// A hole of a structure with `n` degrees of freedom and this factor of M; its normal points
    /// along y.
    pub(super) fn new(hole: &Hole<'_>, n: usize, mass: &mut Factor) -> Self {
        let mut weights = vec![[0.0; 2]; n];
        let mut columns = [vec![0.0; n], vec![0.0; n]];
        for (plane, row) in [&hole.at.y, &hole.at.z].into_iter().enumerate() {
            for &(i, weight) in row.entries().iter().filter(|entry| entry.0 < n) {
                weights[i][plane] += weight;
                columns[plane][i] += weight;
            }
            mass.solve(&mut columns[plane]);
        }
        let own = |a: usize, b: usize| weights.iter().zip(&columns[b]).map(|(w, x)| w[a] * x).sum::<f64>();
        let own = [own(0, 0), own(0, 1), own(1, 1)];
        let moves = |i: &usize| columns[0][*i] != 0.0 || columns[1][*i] != 0.0;
        let first = (0..n).find(moves).unwrap_or(0);
        let end = (first..n).rev().find(moves).map_or(first, |last| last + 1);
        let columns = (first..end).map(|i| [columns[0][i], columns[1][i]]).collect();
        let seen = |entry: &(usize, [f64; 2])| entry.1 != [0.0; 2];
        Self {
            wall: hole.index,
            gap: hole.gap,
            normal: [1.0, 0.0],
            centre: hole.centre,
            entries: weights.into_iter().enumerate().filter(seen).collect(),
            first,
            columns,
            own,
        }
    }

    /// The entries of its row along the normal as it stands.
    pub(super) fn row(&self) -> impl Iterator<Item = (usize, f64)> {
        let [y, z] = self.normal;
        self.entries.iter().map(move |&(i, [a, b])| (i, y * a + z * b))
    }

    /// The column M⁻¹ (n·P)ᵀ, from entry `first` on, and n·W n.
    pub(super) fn column(&self) -> (usize, impl Iterator<Item = f64>, f64) {
        let ([y, z], [yy, yz, zz]) = (self.normal, self.own);
        let values = self.columns.iter().map(move |[a, b]| y * a + z * b);
        (self.first, values, y * y * yy + 2.0 * y * z * yz + z * z * zz)
    }

    /// (g_y · x, g_z · x).
    #[inline]
    pub fn pair(&self, x: &[f64]) -> [f64; 2] {
        let mut pair = [0.0; 2];
        for &(i, [a, b]) in &self.entries {
            let x = x.get(i).copied().unwrap_or(0.0);
            pair = [pair[0] + a * x, pair[1] + b * x];
        }
        pair
    }

    /// w = P q − c, m.
    #[inline]
    pub fn offset(&self, q: &[f64]) -> [f64; 2] {
        let [y, z] = self.pair(q);
        [y - self.centre[0], z - self.centre[1]]
    }

    /// Adds Pᵀ `force` to `out`.
    #[inline]
    pub fn push(&self, force: [f64; 2], out: &mut [f64]) {
        for &(i, [a, b]) in &self.entries {
            if let Some(out) = out.get_mut(i) {
                *out += a * force[0] + b * force[1];
            }
        }
    }

    /// Adds the sizes of the terms of Pᵀ `force` to `out`.
    pub fn push_size(&self, force: [f64; 2], out: &mut [f64]) {
        for &(i, [a, b]) in &self.entries {
            if let Some(out) = out.get_mut(i) {
                *out += (a * force[0]).abs() + (b * force[1]).abs();
            }
        }
    }

    /// The position of the wall of its row, γ + n·c, m.
    #[inline]
    pub fn bound(&self) -> f64 {
        self.gap + self.normal[0] * self.centre[0] + self.normal[1] * self.centre[1]
    }

    /// Size of the terms of w and of γ, m: their rounding errors do not depend on the normal.
    pub fn place_size(&self, q: &[f64]) -> f64 {
        self.size(q) + self.centre[0].abs() + self.centre[1].abs() + self.gap
    }

    /// Σ (|g_y| + |g_z|) |x|.
    pub fn size(&self, x: &[f64]) -> f64 {
        self.entries.iter().map(|&(i, [a, b])| (a.abs() + b.abs()) * x.get(i).map_or(0.0, |x| x.abs())).sum()
    }

    /// Size of the terms of P M⁻¹ x.
    pub(super) fn answer_size(&self, x: &[f64]) -> f64 {
        let columns = self.columns.iter().zip(x.get(self.first..).unwrap_or(&[]));
        columns.map(|([a, b], x)| (a.abs() + b.abs()) * x.abs()).sum()
    }
}

/// The rows of `walls` and those of `rounds`.
pub(super) fn with_rounds(n: usize, walls: &Rows, rounds: &[Round]) -> Rows {
    // Every entry stays in place when the normal turns, also where its weight is 0 now.
    let turning: Vec<Vec<(usize, f64)>> = rounds.iter().map(|round| round.row().collect()).collect();
    let fixed = (0..walls.count()).map(|row| walls.row(row));
    Rows::new(n, fixed.chain(turning.iter().map(Vec::as_slice)))
}
