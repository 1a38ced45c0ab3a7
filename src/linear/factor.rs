//! The factor of a positive definite matrix.

use super::Symmetric;
use super::band::{BandFactor, is_band};
use super::definite::NotDefinite;
use super::sparse::SparseFactor;

/// A = L D Lᵀ, factored once and solved many times.
///
/// A narrow band, a diagonal and a full matrix are factored as bands, in their own order, with cost n · width² once and 4 n · width a solve; any
/// other sparse matrix with an order that keeps its factor sparse.
#[derive(Debug)]
pub struct Factor {
    n: usize,
    kind: Kind,
}

#[derive(Debug)]
enum Kind {
    Band(BandFactor),
    Sparse(Box<SparseFactor>),
}

impl Factor {
    /// Factors `matrix`.
    ///
    /// # Errors
    /// [`NotDefinite`].
    pub fn new(matrix: &Symmetric) -> Result<Self, NotDefinite> {
        let kind = if is_band(matrix) {
            Kind::Band(BandFactor::new(matrix)?)
        } else {
            Kind::Sparse(Box::new(SparseFactor::new(matrix)?))
        };
        Ok(Self { n: matrix.size(), kind })
    }

    /// Solves A x = b in place; `x` has n entries, others are left as they are.
    #[inline]
    pub fn solve(&mut self, x: &mut [f64]) {
        if x.len() != self.n {
            return;
        }
        match &mut self.kind {
            Kind::Band(factor) => factor.solve(x),
            Kind::Sparse(factor) => factor.solve(x),
        }
    }

    /// Multiplications and additions of one solve.
    #[must_use]
    pub fn work(&self) -> usize {
        match &self.kind {
            Kind::Band(factor) => self.n * (4 * factor.width() + 1),
            Kind::Sparse(factor) => self.n + 4 * factor.stored(),
        }
    }

    /// What kind of factor it is: a word or two for a summary.
    #[must_use]
    pub fn describe(&self) -> String {
        match &self.kind {
            Kind::Band(factor) => match factor.width() {
                0 => "diagonal".to_owned(),
                1 => "tridiagonal".to_owned(),
                width if width + 1 >= self.n => "dense".to_owned(),
                width => format!("banded, half bandwidth {width}"),
            },
            Kind::Sparse(_) => "sparse, minimum-degree order".to_owned(),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn random(seed: &mut u64) -> f64 {
        *seed = seed.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        (*seed >> 11) as f64 / (1_u64 << 53) as f64 - 0.5
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
    fn a_matrix_that_is_not_positive_definite_is_refused_with_its_row() {
        let singular = Symmetric::from_entries(3, [(0, 0, 1.0), (1, 1, 1.0), (1, 0, 1.0), (2, 2, 1.0)]);
        assert_eq!(Factor::new(&singular).map(|_| ()), Err(NotDefinite { row: 1 }));
        assert!(Factor::new(&Symmetric::diagonal(&[1.0, -1.0])).is_err());
        assert!(Factor::new(&Symmetric::diagonal(&[1.0, f64::NAN])).is_err());
    }
}
