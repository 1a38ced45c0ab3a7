//! What the tests of this room share: numbers that look random, and programmes as full matrices.

pub(in crate::qp) use crate::hash::Draws;
use crate::linear::{Rows, Symmetric};
use crate::qp::Problem;
use crate::qp::delassus::Delassus;
use nalgebra::{DMatrix, DVector};

impl Draws {
    /// A whole number from `low` to `high`.
    pub(in crate::qp) fn whole(&mut self, low: i32, high: i32) -> f64 {
        self.between(f64::from(low) - 0.5, f64::from(high) + 0.5).round()
    }

    pub(in crate::qp) fn vector(&mut self, n: usize) -> DVector<f64> {
        DVector::from_fn(n, |_, _| self.between(-1.0, 1.0))
    }
}

/// A programme with equal masses, so that W = G Gᵀ/mass + diag(c).
pub(in crate::qp) struct Dense {
    pub mass: f64,
    pub g: DMatrix<f64>,
    pub compliance: Vec<f64>,
}

impl Dense {
    /// Rigid rows on unit masses.
    pub(in crate::qp) fn rigid<const M: usize, const N: usize>(rows: [[f64; N]; M]) -> Self {
        let g = DMatrix::from_fn(M, N, |i, j| rows[i][j]);
        Self { mass: 1.0, g, compliance: vec![0.0; M] }
    }

    /// m rows on m unknowns whose equal masses have any size; each row yields a little.
    pub(in crate::qp) fn yielding(draws: &mut Draws, m: usize) -> Self {
        let g = DMatrix::from_fn(m, m, |_, _| draws.between(-1.0, 1.0));
        let mass = 10_f64.powf(draws.between(-6.0, 6.0));
        Self { mass, g, compliance: vec![0.3 / mass; m] }
    }

    pub(in crate::qp) fn problem(&self) -> Problem {
        let (m, n) = self.g.shape();
        let entries = |i: usize| (0..n).map(|j| (j, self.g[(i, j)])).filter(|entry| entry.1 != 0.0).collect();
        let rows: Vec<Vec<(usize, f64)>> = (0..m).map(entries).collect();
        Problem {
            a: Symmetric::diagonal(&vec![self.mass; n]),
            g: Rows::new(n, rows.iter().map(Vec::as_slice)),
            compliance: self.compliance.clone(),
        }
    }

    /// The condensed programme; its free motion is that of the displacements `x`.
    pub(in crate::qp) fn system(&self, x: &[f64]) -> Delassus {
        let mut system = Delassus::new(&self.problem()).expect("definite");
        system.complete(x);
        system
    }

    /// The condensed programme where no force moves anything yet.
    pub(in crate::qp) fn at_rest(&self) -> Delassus {
        self.system(&vec![0.0; self.g.ncols()])
    }

    pub(in crate::qp) fn w(&self) -> DMatrix<f64> {
        &self.g * self.g.transpose() / self.mass + DMatrix::from_diagonal(&DVector::from_column_slice(&self.compliance))
    }
}

/// The lines and columns `rows` of W.
pub(in crate::qp) fn block(w: &DMatrix<f64>, rows: &[usize]) -> DMatrix<f64> {
    DMatrix::from_fn(rows.len(), rows.len(), |i, j| w[(rows[i], rows[j])])
}

/// Entries `rows` of column `column` of W.
pub(in crate::qp) fn part(w: &DMatrix<f64>, rows: &[usize], column: usize) -> DVector<f64> {
    DVector::from_fn(rows.len(), |i, _| w[(rows[i], column)])
}

/// The solution of a regular system, of no equation, too.
pub(in crate::qp) fn solution(matrix: &DMatrix<f64>, asked: &DVector<f64>) -> DVector<f64> {
    if asked.is_empty() { asked.clone() } else { matrix.clone().lu().solve(asked).expect("regular") }
}

/// A tridiagonal matrix.
pub(in crate::qp) fn tridiagonal(n: usize, own: f64, neighbour: f64) -> Symmetric {
    Symmetric::from_entries(n, (0..n).map(|i| (i, i, own)).chain((1..n).map(|i| (i, i - 1, neighbour))))
}

/// A chain of masses on springs, in a unit of stiffness far from 1, with rows that see some of it:
/// A, G and the programme.
pub(in crate::qp) fn chain(draws: &mut Draws, n: usize, m: usize) -> (DMatrix<f64>, DMatrix<f64>, Problem) {
    let unit = 10_f64.powf(draws.between(-12.0, 12.0));
    let mut a = DMatrix::from_diagonal(&DVector::from_fn(n, |_, _| unit * draws.between(0.5, 2.0)));
    for i in 1..n {
        let k = unit * draws.between(0.0, 1.0);
        (a[(i, i - 1)], a[(i - 1, i)]) = (-k, -k);
        a[(i, i)] += k;
        a[(i - 1, i - 1)] += k;
    }
    let g = DMatrix::from_fn(m, n, |_, _| if draws.chance(0.3) { draws.between(-2.0, 2.0) } else { 0.0 });
    // Rows that see nothing have a spring, so that no entry of W is 0.
    let soft: Vec<bool> = (0..m).map(|i| draws.chance(0.5) || g.row(i).amax() == 0.0).collect();
    let compliance = soft.iter().map(|&soft| if soft { draws.between(0.01, 1.0) / unit } else { 0.0 }).collect();
    let entries = (0..n).flat_map(|i| (i.saturating_sub(1)..=i).map(move |j| (i, j)));
    let row = |i: usize| (0..n).map(|j| (j, g[(i, j)])).filter(|entry| entry.1 != 0.0).collect::<Vec<_>>();
    let rows: Vec<_> = (0..m).map(row).collect();
    let problem = Problem {
        a: Symmetric::from_entries(n, entries.map(|(i, j)| (i, j, a[(i, j)]))),
        g: Rows::new(n, rows.iter().map(Vec::as_slice)),
        compliance,
    };
    (a, g, problem)
}
