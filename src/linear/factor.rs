//! The factor of a positive definite matrix.

use super::Symmetric;
use super::band::is_band;
use super::band_factor::BandFactor;
use super::definite::NotDefinite;
use super::sparse::SparseFactor;
use std::ops::Range;
use std::sync::Arc;

/// A = L D Lᵀ, factored once and solved many times.
///
/// A narrow band, a diagonal and a full matrix are factored as bands, without reordering, at a cost
/// of n · width² once and 4 n · width per solve; any other sparse matrix is factored in an order
/// that keeps its factor sparse. A clone shares the factor, and has its own work space for solving.
#[derive(Debug, Clone)]
pub struct Factor {
    n: usize,
    kind: Kind,
    /// Work space: n entries for a sparse matrix, empty for a band.
    room: Vec<f64>,
}

#[derive(Debug, Clone)]
enum Kind {
    Band(Arc<BandFactor>),
    Sparse(Arc<SparseFactor>),
}

impl Factor {
    /// Factors `matrix`.
    ///
    /// # Errors
    /// [`NotDefinite`].
    pub fn new(matrix: &Symmetric) -> Result<Self, NotDefinite> {
        #[cfg(test)]
        counted::count(matrix.size());
        let n = matrix.size();
        if is_band(matrix) {
            return Ok(Self { n, kind: Kind::Band(Arc::new(BandFactor::new(matrix)?)), room: Vec::new() });
        }
        Ok(Self { n, kind: Kind::Sparse(Arc::new(SparseFactor::new(matrix)?)), room: vec![0.0; n] })
    }

    /// Makes it the factor of `matrix`; a band keeps its memory.
    ///
    /// # Errors
    /// [`NotDefinite`]; it is then the factor of nothing.
    pub(crate) fn renew(&mut self, matrix: &Symmetric) -> Result<(), NotDefinite> {
        match &mut self.kind {
            Kind::Band(factor) if matrix.size() == self.n && is_band(matrix) => Arc::make_mut(factor).renew(matrix),
            _ => {
                *self = Self::new(matrix)?;
                Ok(())
            }
        }
    }

    /// Solves A x = b in place; `x` has n entries. Others are left as they are, and a debug build
    /// panics.
    #[inline(always)]
    pub fn solve(&mut self, x: &mut [f64]) {
        debug_assert_eq!(x.len(), self.n);
        if x.len() != self.n {
            return;
        }
        match &self.kind {
            Kind::Band(factor) => factor.solve(x),
            Kind::Sparse(factor) => factor.solve(x, &mut self.room),
        }
    }

    /// As [`Factor::solve`], for a b that is zero outside the rows `span`: returns the rows outside
    /// of which x is zero, or negligible beside the rest (1e-16 of it at most, in the norm of A).
    /// For a band in which the response to a force decays, the cost does not depend on n.
    pub(crate) fn solve_near(&mut self, x: &mut [f64], span: Range<usize>) -> Range<usize> {
        if let (Kind::Band(factor), true) =
            (&self.kind, x.len() == self.n && span.start < span.end && span.end <= self.n)
        {
            return factor.solve_near(x, span);
        }
        self.solve(x);
        0..self.n
    }

    /// Multiplications and additions of one solve.
    #[must_use]
    pub fn work(&self) -> usize {
        match &self.kind {
            Kind::Band(factor) => self.n * (4 * factor.width() + 1),
            Kind::Sparse(factor) => self.n + 4 * factor.stored(),
        }
    }

    /// The kind of factor: a word or two for a summary.
    #[must_use]
    pub fn describe(&self) -> String {
        match &self.kind {
            Kind::Band(factor) => describe(self.n, Some(factor.width())),
            Kind::Sparse(_) => describe(self.n, None),
        }
    }

    /// The kind of factor that `matrix` would have.
    #[must_use]
    pub fn described(matrix: &Symmetric) -> String {
        describe(matrix.size(), is_band(matrix).then(|| matrix.half_bandwidth()))
    }
}

/// The kind of a factor of n rows and, for a band, of this half bandwidth.
fn describe(n: usize, width: Option<usize>) -> String {
    match width {
        Some(0) => "diagonal".to_owned(),
        Some(1) => "tridiagonal".to_owned(),
        Some(width) if width + 1 >= n => "dense".to_owned(),
        Some(width) => format!("banded, half bandwidth {width}"),
        None => "sparse, minimum-degree order".to_owned(),
    }
}

/// Records the matrices that this thread has factored, for tests.
#[cfg(test)]
pub(crate) mod counted {
    use std::cell::RefCell;

    thread_local!(static SIZES: RefCell<Vec<usize>> = const { RefCell::new(Vec::new()) });

    pub(super) fn count(n: usize) {
        SIZES.with_borrow_mut(|sizes| sizes.push(n));
    }

    /// The sizes n of the matrices factored since the last call.
    pub(crate) fn take() -> Vec<usize> {
        SIZES.take()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn random(seed: &mut u64) -> f64 {
        crate::hash::next_unit(seed) - 0.5
    }

    #[test]
    fn every_kind_of_factor_solves_to_rounding() {
        let mut seed = 1;
        for (n, width, far) in
            [(1, 0, 0), (7, 0, 0), (9, 1, 0), (2, 1, 0), (3, 1, 0), (10, 1, 0), (30, 3, 0), (12, 11, 0), (200, 1, 60)]
        {
            let mut entries = Vec::new();
            for i in 0..n {
                entries.push((i, i, 3.0 + 2.0 * width as f64));
                entries.extend((1..=width.min(i)).map(|d| (i, i - d, random(&mut seed))));
                if far > 0 && i >= far && i % 7 == 0 {
                    entries.push((i, i - far, random(&mut seed)));
                }
            }
            let matrix = Symmetric::from_entries(n, entries);
            let mut factor = Factor::new(&matrix).unwrap();
            assert_eq!(matches!(factor.kind, Kind::Sparse(_)), far > 0, "{}", factor.describe());
            let x: Vec<f64> = (0..n).map(|_| random(&mut seed)).collect();
            let (mut b, mut c) = (vec![0.0; n], vec![0.0; n]);
            matrix.add_product(1.0, &x, &mut b);
            super::super::Operator::new(&matrix).add_product(1.0, &x, &mut c);
            for (b, c) in b.iter().zip(&c) {
                assert!((b - c).abs() < 1e-14 * (1.0 + b.abs()) * (1.0 + width as f64));
            }
            factor.solve(&mut b);
            // Condition of these matrices is below 10; some ulps of each sum.
            let error = b.iter().zip(&x).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max);
            assert!(error < 1e-14, "n {n}, width {width}: {error:e}");
        }
    }

    #[test]
    fn a_solution_near_a_row_is_the_whole_one() {
        let mut seed = 7;
        for (n, width) in [(300, 0), (301, 1), (300, 1), (4, 1), (300, 3), (90, 5)] {
            // From a matrix whose response decays at once to one whose response reaches every row.
            for stiff in [0.1, 3.0, 1e3] {
                let mut entries: Vec<(usize, usize, f64)> =
                    (0..n).map(|i| (i, i, 1.0 + stiff * width as f64)).collect();
                for i in 0..n {
                    entries.extend((1..=width.min(i)).map(|d| (i, i - d, stiff * random(&mut seed))));
                }
                let matrix = Symmetric::from_entries(n, entries);
                let mut factor = Factor::new(&matrix).unwrap();
                for start in [0, 1, n / 2 - 1, n / 2, n - 2] {
                    let (mut near, mut whole) = (vec![0.0; n], vec![0.0; n]);
                    for i in start..start + 2 {
                        (near[i], whole[i]) = (1.0, 1.0);
                    }
                    let rows = factor.solve_near(&mut near, start..start + 2);
                    factor.solve(&mut whole);
                    let size = whole.iter().fold(0.0_f64, |most, x| most.max(x.abs()));
                    for (i, (near, whole)) in near.iter().zip(&whole).enumerate() {
                        assert!(
                            (near - whole).abs() <= 1e-15 * size,
                            "n {n}, width {width}, {stiff}: row {i} of {start}"
                        );
                        assert!(rows.contains(&i) || *near == 0.0);
                    }
                    // Where the coupling is weak, the response to a force stays near it, except for
                    // rows near the middle of a tridiagonal matrix, where both halves meet.
                    let divided = width == 1 && start.abs_diff(n / 2) < 60;
                    assert!(stiff > 1.0 || divided || rows.len() < 120.min(n + 1), "{} rows of {n}", rows.len());
                }
            }
        }
    }

    #[test]
    fn a_matrix_that_is_not_positive_definite_is_refused_with_its_row() {
        let singular = Symmetric::from_entries(3, [(0, 0, 1.0), (1, 1, 1.0), (1, 0, 1.0), (2, 2, 1.0)]);
        assert_eq!(Factor::new(&singular).map(|_| ()), Err(NotDefinite { row: 1 }));
        assert!(Factor::new(&Symmetric::diagonal(&[1.0, -1.0])).is_err());
        assert!(Factor::new(&Symmetric::diagonal(&[1.0, f64::NAN])).is_err());
    }
}
