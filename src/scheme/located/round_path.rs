//! The first instant at which a place crosses a round wall within a step.
//!
//! Its path is a parabola, w(u) = (1−u)² p₀ + 2u(1−u) p₁ + u² p₂ with u = τ/s, p₀ = w, p₁ = w + ½sẇ
//! and p₂ = w⁺, which lies within the hull of these points. γ² − |w(u)|² is a polynomial of degree
//! 4 in u, and not below the least of its coefficients over Bernstein's basis; halving the interval
//! (de Casteljau) until they tell finds the first crossing, and skips none.

use super::super::supports::dot;

/// The path of a place in a round wall along a step.
#[derive(Debug, Clone, Copy)]
pub(super) struct RoundPath {
    /// Displacement from the centre at the start, m.
    pub from: [f64; 2],
    /// Its rate there, m/s, and the change of that rate over the step.
    pub rate: [f64; 2],
    pub change: [f64; 2],
    /// Length of the step, s.
    pub span: f64,
    /// The radial gap γ, m.
    pub gap: f64,
}

/// Coefficients over Bernstein's basis of degree 4.
type Quartic = [f64; 5];

/// Most halvings: the interval is that of neighbouring numbers then.
const MOST_HALVINGS: u32 = 53;

impl RoundPath {
    /// Displacement from the centre, m, and its rate, m/s, at the share `u` of the step.
    fn at(&self, u: f64) -> ([f64; 2], [f64; 2]) {
        let tau = u * self.span;
        let along = |i: usize| self.rate[i] + u * self.change[i];
        let place = |i: usize| self.from[i] + tau * (self.rate[i] + 0.5 * u * self.change[i]);
        ([0, 1].map(place), [0, 1].map(along))
    }

    /// The gap at the share `u` of the step, m, and its rate, m/s.
    fn gap_at(&self, u: f64) -> (f64, f64) {
        let (place, rate) = self.at(u);
        let distance = dot(place, place).sqrt();
        (self.gap - distance, if distance > 0.0 { -dot(place, rate) / distance } else { 0.0 })
    }

    /// True if both of its ends are within the wall.
    pub fn stays_within(&self) -> bool {
        let (end, _) = self.at(1.0);
        dot(self.from, self.from).max(dot(end, end)) <= self.gap * self.gap
    }

    /// The gap at the end, m, and its rate, m/s.
    pub fn end(&self) -> (f64, f64) {
        self.gap_at(1.0)
    }

    /// The first τ in [0, s] at which the path crosses the wall from inside, if it goes deeper than
    /// `touch` (m) behind it or ends behind it while approaching; just before it, where half of
    /// `touch` is left. A wall within `touch` at the start counts as touched.
    pub fn crossing(&self, touch: f64) -> Option<f64> {
        let (start, rate) = self.gap_at(0.0);
        if start <= touch && rate < 0.0 {
            return Some(0.0);
        }
        let (end, end_rate) = self.end();
        let middle = [0, 1].map(|i: usize| self.from[i] + 0.5 * self.span * self.rate[i]);
        let inside = dot(middle, middle) <= self.gap * self.gap;
        if inside && start >= 0.0 && end > 0.0 {
            return None;
        }
        let last = self.at(1.0).0;
        // A place that leaves from behind the wall has not crossed it.
        let limit = (self.gap.max(self.gap - start) + touch).powi(2);
        let products =
            [(self.from, self.from), (self.from, middle), (middle, last), (last, last)].map(|(a, b)| dot(a, b));
        let [first, second, fourth, fifth] = products;
        let third = (dot(self.from, last) + 2.0 * dot(middle, middle)) / 3.0;
        let left = [first, second, third, fourth, fifth].map(|product| limit - product);
        let beyond = first_negative(left, 0.0, 1.0, MOST_HALVINGS);
        if beyond.is_none() && !(end <= 0.0 && end_rate < 0.0) {
            return None;
        }
        let upto = beyond.unwrap_or(1.0);
        let mut u = upto;
        for _ in 0..8 {
            let (gap, rate) = self.gap_at(u);
            let next = u - (gap - 0.5 * touch) / (rate * self.span);
            if !(0.0 < next && next <= upto) || next == u {
                break;
            }
            u = next;
        }
        Some(u * self.span)
    }
}

/// The first argument in [`from`, `to`] at which a polynomial of these coefficients is negative.
fn first_negative(coefficients: Quartic, from: f64, to: f64, halvings: u32) -> Option<f64> {
    if coefficients.iter().all(|c| *c >= 0.0) {
        return None;
    }
    if coefficients[0] < 0.0 {
        return Some(from);
    }
    if halvings == 0 {
        return (coefficients[4] < 0.0).then_some(to);
    }
    let (mut left, mut right) = ([0.0; 5], coefficients);
    for (k, left) in left.iter_mut().enumerate() {
        *left = right[0];
        for i in 0..4 - k {
            right[i] = 0.5 * (right[i] + right[i + 1]);
        }
    }
    // What is left in `right` are the coefficients of the second half.
    let middle = 0.5 * (from + to);
    first_negative(left, from, middle, halvings - 1).or_else(|| first_negative(right, middle, to, halvings - 1))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn path(from: [f64; 2], rate: [f64; 2], change: [f64; 2]) -> RoundPath {
        RoundPath { from, rate, change, span: 2.0, gap: 1.0 }
    }

    #[test]
    fn a_straight_path_crosses_where_the_circle_equation_says() {
        for k in 0..40 {
            let turn = 0.37 * f64::from(k);
            let rate = [turn.cos(), turn.sin()];
            let from = [0.3, -0.2];
            // |from + τ rate| = 1 with |rate| = 1.
            let along = dot(from, rate);
            let root = -along + (along * along + 1.0 - dot(from, from)).sqrt();
            let found = path(from, rate, [0.0; 2]).crossing(1e-12).expect("a crossing");
            // Half of the touching distance before it, at a slope of at least √(1 − 0.13).
            assert!((found - root).abs() < 1e-12 && found < root, "{found} {root}");
        }
    }

    #[test]
    fn a_path_that_comes_back_within_the_step_is_found_and_one_that_turns_before_is_not() {
        // Up to 1.01 and back, at its highest in the middle of the step; then up to 0.99.
        let there_and_back = |top: f64| path([0.2, 0.0], [2.0 * (top - 0.2), 0.0], [-4.0 * (top - 0.2), 0.0]);
        let found = there_and_back(1.01).crossing(1e-12).expect("a crossing");
        // 1.01 − 0.81 (1 − τ)² = 1.
        assert!((found - (1.0 - (0.01_f64 / 0.81).sqrt())).abs() < 1e-11, "{found}");
        assert_eq!(there_and_back(0.99).crossing(1e-12), None);
    }

    #[test]
    fn a_place_on_the_circle_crosses_at_once_if_it_approaches_and_else_where_it_comes_back() {
        assert_eq!(path([1.0, 0.0], [0.1, 0.3], [0.0; 2]).crossing(1e-12), Some(0.0));
        assert_eq!(path([1.0, 0.0], [-0.1, 0.0], [0.0; 2]).crossing(1e-12), None);
        // w = 1 − τ + ¾τ² comes back at 4/3.
        let found = path([1.0, 0.0], [-1.0, 0.0], [3.0, 0.0]).crossing(1e-12).expect("a crossing");
        assert!((found - 4.0 / 3.0).abs() < 1e-12, "{found}");
        // Across the hole to the other side.
        let found = path([1.0, 0.0], [-1.5, 0.0], [0.0; 2]).crossing(1e-12).expect("a crossing");
        assert!((found - 4.0 / 3.0).abs() < 1e-12, "{found}");
    }
}
