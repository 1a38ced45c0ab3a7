//! The coherence of a field that decays exponentially along a line, between equal cells.

/// Below this ratio r of cell to correlation length 2(r − 1 + e^(−r))/r² is taken from its series
/// 1 − r/3 (1 − r/4 (1 − …)), whose term after the last is 1e-17 there: the difference would lose
/// digits.
const SHORT: f64 = 0.5;

/// The last divisor of that series.
const LAST: u32 = 16;

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
        let series = || (3..=LAST).rev().fold(1.0, |sum, divisor| 1.0 - r / f64::from(divisor) * sum);
        let own = if r < SHORT { series() } else { 2.0 * (r - lost) / (r * r) };
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
            (1e-4, [0.999_966_667_499_983_3, 0.999_900_005_833_083_4, 0.999_700_045_828_583_7]),
            (1.9e-3, [0.999_366_967_385_719_5, 0.998_102_104_119_704_9, 0.994_316_513_301_930_4]),
            (2.1e-3, [0.999_300_367_345_704, 0.997_902_570_186_423_7, 0.993_720_168_583_136_2]),
            (0.1, [0.967_483_607_191_914_6, 0.905_591_700_606_271_3, 0.741_435_775_018_542_7]),
            (0.49, [0.854_863_758_304_173_8, 0.624_982_550_947_802_6, 0.234_562_887_959_170_6]),
            (0.51, [0.849_639_206_553_371_3, 0.613_624_692_612_635_2, 0.221_269_959_321_376_74]),
            (1.0, [0.735_758_882_342_884_7, 0.399_576_400_893_728_03, 0.054_076_785_389_618_985]),
            (10.0, [0.180_000_907_998_595_25, 0.009_999_092_022_016_286, 2.060_966_474_227_535_4e-11]),
        ];
        for (r, [own, next, third]) in known {
            let coherence = CellCoherence::new(0.3 * r, 0.3);
            let mut product = [0.0; 7];
            coherence.multiply(&[0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0], &mut product);
            // Rounding, and the powers of the decay.
            for (found, known) in product.iter().zip([third, f64::NAN, next, own, next, f64::NAN, third]) {
                assert!(known.is_nan() || (found / known - 1.0).abs() < 1e-14, "{r}: {found} for {known}");
            }
        }
    }
}
