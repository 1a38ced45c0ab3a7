//! The coherence of a field that decays exponentially along a line, between equal cells.

/// Below this ratio of cell to correlation length 2(ℓ/λ − 1 + e^(−ℓ/λ))/(ℓ/λ)² is taken from its
/// series, whose next term is 1e-13 of it there: the difference would lose digits.
const SHORT: f64 = 2e-3;

/// The coherence e^(−|x − x′|/λ), averaged over pairs of cells of length ℓ, with r = ℓ/λ:
///
/// within a cell 2 (r − 1 + e^(−r))/r², between cells m apart ((1 − e^(−r))/r)² e^(−(m−1)r).
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct CellCoherence {
    /// Within a cell.
    own: f64,
    /// Between neighbours.
    next: f64,
    /// Its decay from one cell to the next, e^(−r).
    decay: f64,
}

impl CellCoherence {
    /// Of cells of `length` (m) under a correlation length (m).
    pub fn new(length: f64, correlation_length: f64) -> Self {
        let r = length / correlation_length;
        // 1 − e^(−r), without loss of digits.
        let lost = -(-r).exp_m1();
        let own = if r < SHORT { 1.0 - r / 3.0 + r * r / 12.0 - r.powi(3) / 60.0 } else { 2.0 * (r - lost) / (r * r) };
        Self { own, next: (lost / r).powi(2), decay: (-r).exp() }
    }

    /// Writes the product of the coherence and `values`, one a cell, to `product`. The exponential
    /// lets one pass in each direction carry the sum over all cells before.
    pub fn multiply(&self, values: &[f64], product: &mut [f64]) {
        let mut behind = 0.0;
        for (value, product) in values.iter().zip(&mut *product) {
            *product = self.own * value + self.next * behind;
            behind = value + self.decay * behind;
        }
        let mut ahead = 0.0;
        for (value, product) in values.iter().zip(product).rev() {
            *product += self.next * ahead;
            ahead = value + self.decay * ahead;
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn averages_over_cells_are_those_of_a_quadrature() {
        // r, then cells 0, 1 and 3 apart: double integrals by tanh-sinh quadrature in 30 digits.
        let known = [
            (1e-4, [0.999966667499983334, 0.999900005833083342, 0.999700045828583709]),
            (1.9e-3, [0.999366967385719524, 0.998102104119704923, 0.994316513301930337]),
            (2.1e-3, [0.999300367345704006, 0.997902570186423677, 0.993720168583136151]),
            (0.1, [0.967483607191914633, 0.905591700606271234, 0.741435775018542728]),
            (1.0, [0.735758882342884643, 0.399576400893728049, 0.0540767853896189862]),
            (10.0, [0.18000090799859525, 0.00999909202201628653, 2.06096647422753528e-11]),
        ];
        for (r, [own, next, third]) in known {
            let coherence = CellCoherence::new(0.3 * r, 0.3);
            let mut product = [0.0; 7];
            coherence.multiply(&[0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0], &mut product);
            // Rounding of r²/(r − 1 + e^(−r)) at r = 2e-3: 2.2e-16/r² of the value, 1e-10.
            for (found, known) in product.iter().zip([third, f64::NAN, next, own, next, f64::NAN, third]) {
                assert!(known.is_nan() || (found / known - 1.0).abs() < 1e-10, "{r}: {found} for {known}");
            }
        }
    }
}
