//! Impacts at one wall that follow one another ever faster.
//!
//! Between two walls that are struck in turn a body may lose its velocity into both in infinitely
//! many impacts within a finite time, without a force that presses it on either. Intervals Δ and
//! speeds then shrink like geometric sequences; with ρ = Δ₂/Δ₁ the ratio of the last two intervals,
//! the impacts that are left take Δ₂ρ + Δ₂ρ² + … = Δ₂ρ/(1 − ρ).

/// The instants (s) of the last two impacts at a wall, and the speeds of approach, m/s; the latest
/// is the second.
#[derive(Debug, Clone, Copy)]
pub(crate) struct LastImpacts([(f64, f64); 2]);

impl LastImpacts {
    /// No impact yet.
    pub const NONE: Self = Self([(f64::NEG_INFINITY, 0.0); 2]);

    /// Notes an impact at `time` (s), approached at `speed`, m/s.
    pub fn observe(&mut self, time: f64, speed: f64) {
        self.0 = [self.0[1], (time, speed)];
    }

    /// True if with these impacts the one at `time` (s) and `speed` (m/s) is one of ever faster and
    /// weaker ones of which all that are left come within a step of `h` seconds; speeds that are
    /// equal but for the factor `same` count as smaller.
    pub fn accumulate(&self, (time, speed): (f64, f64), h: f64, same: f64) -> bool {
        let [first, second] = self.0;
        let [before, last] = [second.0 - first.0, time - second.0];
        let weaker = speed < same * second.1 && second.1 < same * first.1;
        weaker && 0.0 <= last && before + last <= h && last <= before && last * last <= (before - last) * h
    }
}

#[cfg(test)]
mod tests {
    use super::LastImpacts;

    /// The last of three impacts at these instants and speeds, with a step of 1 s.
    fn accumulate(times: [f64; 3], speeds: [f64; 3]) -> bool {
        let mut last = LastImpacts::NONE;
        for (time, speed) in times.into_iter().zip(speeds).take(2) {
            assert!(!last.accumulate((time, speed), 1.0, 1.0), "fewer than three");
            last.observe(time, speed);
        }
        last.accumulate((times[2], speeds[2]), 1.0, 1.0)
    }

    #[test]
    fn what_is_left_of_a_geometric_sequence_must_fit_in_a_step() {
        // Intervals of ratio ρ: of Δ₁ = 0.4, ρ = ½ is left 0.2, of Δ₁ = 0.1, ρ = 0.95 is left 1.8.
        assert!(accumulate([5.0, 5.4, 5.6], [1.0, 0.5, 0.25]));
        assert!(!accumulate([5.0, 5.1, 5.195], [1.0, 0.95, 0.9025]));
        // Two intervals of more than a step, intervals that grow, speeds that do.
        assert!(!accumulate([5.0, 5.8, 6.1], [1.0, 0.5, 0.25]));
        assert!(!accumulate([5.0, 5.1, 5.3], [1.0, 0.5, 0.25]));
        assert!(!accumulate([5.0, 5.4, 5.6], [1.0, 0.5, 0.6]));
        // At one instant nothing is left but the speeds.
        assert!(accumulate([5.0; 3], [1.0, 0.5, 0.25]));
    }
}
