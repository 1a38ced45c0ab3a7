//! The work of wear of an impulse, and the distance slid in a step.
//!
//! During an impact the velocity changes in proportion to the impulse so far, whatever the force
//! over time: v_t = v₀ + (v₁ − v₀) s with s the share of the impulse reached. So the work of a
//! rigid impact is finite, although its force is not, and it does not depend on a contact
//! stiffness:
//!
//! W = ∫ |v_t| dp = p (|v₀| + |v₁|)/2, or p (v₀² + v₁²)/(2|v₁ − v₀|) where v_t changes its sign.

/// Mean of |v| where v goes from `from` to `to` in equal parts.
fn mean_size(from: f64, to: f64) -> f64 {
    let (a, b) = (from.abs(), to.abs());
    if (from < 0.0) == (to < 0.0) {
        return 0.5 * (a + b);
    }
    // One of them is above 0. Scaled by the larger, squares neither vanish nor overflow.
    let (most, ratio) = (a.max(b), a.min(b) / a.max(b));
    0.5 * most * (1.0 + ratio * ratio) / (1.0 + ratio)
}

/// Work of wear ∫ |v_t| dp of a normal impulse `impulse` (N s, 0 or more), J, while the sliding
/// velocity goes from `before` to `after` (m/s) in proportion to it.
pub(super) fn work_of_impulse(impulse: f64, before: f64, after: f64) -> f64 {
    impulse * mean_size(before, after)
}

/// Distance ∫ |v_t| dt slid in `time` (s), m, while the sliding velocity goes evenly from `before`
/// to `after` (m/s).
pub(super) fn sliding_distance(time: f64, before: f64, after: f64) -> f64 {
    time * mean_size(before, after)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_body_that_is_turned_round_slides_at_half_its_speed_in_the_mean() {
        // 2 N s while it is turned round from 1 m/s to −1 m/s.
        assert_eq!(work_of_impulse(2.0, 1.0, -1.0), 1.0);
    }

    #[test]
    fn the_mean_speed_of_a_straight_line_is_its_area() {
        for (from, to, mean) in [(1.0, 3.0, 2.0), (-1.0, -3.0, 2.0), (0.0, 3.0, 1.5), (0.0, 0.0, 0.0), (2.0, 2.0, 2.0)]
        {
            assert_eq!(mean_size(from, to), mean, "{from} {to}");
        }
        // Two triangles: of 1 m/s over a quarter of the time, and of 3 m/s over the rest.
        for (from, to) in [(1.0, -3.0), (-3.0, 1.0)] {
            assert!((mean_size(from, to) - (0.25 * 0.5 + 0.75 * 1.5)).abs() < 1e-15);
        }
        assert!((mean_size(1e-300, -1e-300) / 5e-301 - 1.0).abs() < 1e-14);
    }

    #[test]
    fn an_oblique_impact_does_the_work_of_the_closed_form() {
        // Quadrature of |v_t| over the impulse with 40 digits.
        let work = work_of_impulse(1.112_951_674_372_232, -0.070_772_452_992_450_89, 0.180_210_301_292_418_46);
        assert!((work / 0.083_110_150_610_689_87 - 1.0).abs() < 1e-15);
    }
}
