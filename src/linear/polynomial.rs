//! M + sC + s²K for many s.

use super::Symmetric;

/// The matrix polynomial M + sC + s²K: the matrices of implicit steps of several lengths, over one
/// pattern of entries.
#[derive(Debug, Clone)]
pub(crate) struct MatrixPolynomial {
    /// The entries of M, C and K over the pattern of `sum`.
    coefficients: [Vec<f64>; 3],
    sum: Symmetric,
}

impl MatrixPolynomial {
    /// Of `coefficients` M, C, K, of one size.
    pub fn new(coefficients: [&Symmetric; 3]) -> Self {
        let sum = Symmetric::sum(&coefficients.map(|matrix| (1.0, matrix)));
        let spread = |matrix| Symmetric::sum(&[(1.0, matrix), (0.0, &sum)]).into_values();
        Self { coefficients: coefficients.map(spread), sum }
    }

    /// Its value at `s`.
    pub fn at(&mut self, s: f64) -> &Symmetric {
        let [m, c, k] = &self.coefficients;
        for (value, (m, (c, k))) in self.sum.values_mut().iter_mut().zip(m.iter().zip(c.iter().zip(k))) {
            *value = m + s * c + s * s * k;
        }
        &self.sum
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn its_values_are_the_sums_of_the_matrices() {
        let mass = Symmetric::diagonal(&[1.0, 2.0, 3.0]);
        let damping = Symmetric::from_entries(3, [(0, 1, 0.5)]);
        let stiffness = Symmetric::from_entries(3, [(0, 0, 4.0), (1, 2, -7.0)]);
        let mut polynomial = MatrixPolynomial::new([&mass, &damping, &stiffness]);
        for s in [0.0, 0.25, 3.0] {
            let sum = Symmetric::sum(&[(1.0, &mass), (s, &damping), (s * s, &stiffness)]);
            assert_eq!(*polynomial.at(s), sum, "s = {s}");
        }
    }
}
