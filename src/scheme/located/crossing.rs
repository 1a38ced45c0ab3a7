//! The first instant at which a wall is crossed within a step.
//!
//! The θ-rule with θ = ½ makes the velocity linear over a step of length s, so that the gap of a
//! flat wall is a parabola, γ(τ) = γ₀ + γ̇τ + Δγ̇ τ²/2s, with Δγ̇ the change of its rate over the
//! step. Its smallest value and its roots are known in closed form: no crossing is skipped, also
//! where the path comes back before the end.

/// The gap of a wall along a step.
#[derive(Debug, Clone, Copy)]
pub(super) struct GapPath {
    /// Gap at the start, m.
    pub gap: f64,
    /// Its rate there, m/s.
    pub rate: f64,
    /// The change of that rate over the step, m/s.
    pub change: f64,
    /// Length of the step, s.
    pub span: f64,
}

impl GapPath {
    /// The gap at the end, m.
    pub fn end(&self) -> f64 {
        self.gap + self.span * (self.rate + 0.5 * self.change)
    }

    /// The smallest gap after the start, m.
    fn least(&self) -> f64 {
        let turns = self.rate < 0.0 && self.rate + self.change > 0.0;
        if turns { self.gap - 0.5 * self.rate * self.rate * self.span / self.change } else { self.end() }
    }

    /// The first τ in [0, s] at which the path crosses the wall from the front, if it goes deeper
    /// than `touch` (m) behind it or ends within `touch` of it, or behind it, while approaching: an
    /// impact at the end of a step belongs to that step. A wall within `touch` at the start counts
    /// as touched.
    #[inline(always)]
    pub fn crossing(&self, touch: f64) -> Option<f64> {
        // A parabola lies within the hull of its control points.
        let in_front = self.gap > touch && self.gap + 0.5 * self.span * self.rate > 0.0 && self.end() > touch;
        if in_front { None } else { self.root(touch) }
    }

    /// The same of any path.
    fn root(&self, touch: f64) -> Option<f64> {
        let Self { rate, change, span, .. } = *self;
        let touched = self.gap <= touch;
        if touched && rate < 0.0 {
            return Some(0.0);
        }
        let arrives = self.end() <= touch && rate + change < 0.0;
        if self.least() >= -touch && !arrives {
            return None;
        }
        let root = if touched {
            // It leaves with γ̇ > 0 and comes back.
            -2.0 * rate * span / change
        } else {
            let discriminant = (rate * rate - 2.0 * change / span * self.gap).max(0.0).sqrt();
            if rate < 0.0 { 2.0 * self.gap / (discriminant - rate) } else { -(rate + discriminant) * span / change }
        };
        Some(if root.is_finite() { root.clamp(0.0, span) } else { span })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn crossing(gap: f64, rate: f64, change: f64) -> Option<f64> {
        GapPath { gap, rate, change, span: 2.0 }.crossing(1e-12)
    }

    #[test]
    fn the_first_root_of_the_gap_is_found_where_the_path_crosses() {
        // γ = 1 − τ.
        assert_eq!(crossing(1.0, -1.0, 0.0), Some(1.0));
        // γ = 3 − 4τ + τ²: behind the wall from 1 to 3, the step ends at 2.
        assert_eq!(crossing(3.0, -4.0, 4.0), Some(1.0));
        // γ = ½ − ½·3τ + τ²: behind it from ½ to 1, in front at both ends.
        let there_and_back = crossing(0.5, -1.5, 4.0);
        assert!(there_and_back.is_some_and(|root| (root - 0.5).abs() < 1e-15), "{there_and_back:?}");
        // γ = 2 + τ − 1.5τ²: away first, then across at (1 + √13)/3.
        let root = crossing(2.0, 1.0, -6.0).expect("a crossing");
        assert!((root - (1.0 + 13.0_f64.sqrt()) / 3.0).abs() < 1e-15);
    }

    #[test]
    fn a_path_that_stays_in_front_or_touches_from_there_crosses_nothing() {
        assert_eq!(crossing(3.0, -1.0, 0.0), None);
        // γ = (τ − 1)²: touches at 1.
        assert_eq!(crossing(1.0, -2.0, 4.0), None);
        assert_eq!(crossing(0.0, 1.0, 0.0), None);
    }

    #[test]
    fn a_body_that_leaves_a_wall_comes_back_at_the_second_root() {
        // γ = τ − τ².
        assert_eq!(crossing(0.0, 1.0, -4.0), Some(1.0));
        assert_eq!(crossing(5e-13, 1.0, -4.0), Some(1.0));
        // It approaches at the start.
        assert_eq!(crossing(0.0, -1.0, 0.0), Some(0.0));
        // It ends exactly on the wall, approaching.
        assert_eq!(crossing(2.0, -1.0, 0.0), Some(2.0));
        // It ends in front of the wall by less than the touching distance, then by more.
        assert_eq!(crossing(2.0 + 5e-13, -1.0, 0.0), Some(2.0));
        assert_eq!(crossing(2.0 + 2e-12, -1.0, 0.0), None);
    }
}
