//! Integrals along exact motion, by Gauss's rule on panels whose length is known beforehand.
//!
//! What is integrated are products of two functions of the motion and its load, and each of those is a sum of sines and of
//! exponentials whose rates are known. So the panels need no search for an accuracy: a sine of rate ω enters products at 2ω at
//! most, which the rule of ten points integrates over two radians of ω with an error of 1e-18 of its size. A tolerance on
//! halved panels would meet the rounding of the load's phase instead, ε·ωt, which grows with the time, and halve for nothing.
//!
//! The integrals are not taken from the coefficients of the closed-form motion: those are what is judged here.

/// Nodes and weights of the ten-point Gauss–Legendre rule on [−1, 1], the positive half.
const GAUSS: [(f64, f64); 5] = [
    (0.148_874_338_981_631_21, 0.295_524_224_714_752_87),
    (0.433_395_394_129_247_2, 0.269_266_719_309_996_35),
    (0.679_409_568_299_024_4, 0.219_086_362_515_982_04),
    (0.865_063_366_688_984_5, 0.149_451_349_150_580_6),
    (0.973_906_528_517_171_7, 0.066_671_344_308_688_14),
];

/// Radians of the fastest oscillation on one panel.
const RADIANS: f64 = 2.0;

/// A panel is at most this much longer than the time since the arc's start: over [x, 3x/2] of a decay e⁻ˣ the rule's error is largest
/// at x = 20, 3e-19.
const GROWTH: f64 = 0.5;

/// Instants of a panel at which it is looked at, inside it and never at its ends, and their weights, s.
pub(super) fn nodes(from: f64, to: f64) -> impl Iterator<Item = (f64, f64)> {
    let (middle, half) = (0.5 * (from + to), 0.5 * (to - from));
    GAUSS.into_iter().flat_map(|(x, w)| [(-x, w), (x, w)]).map(move |(x, w)| (middle + half * x, half * w))
}

/// The panels of an arc. What oscillates on it does so at `fastest` (rad/s) at most. What decays does so from the start, at `rate`
/// (1/s) at most: the first panel is no longer than 1/rate and those that follow grow with the time since the start, or a few nodes over
/// the whole arc would miss it.
pub(super) fn panels(start: f64, end: f64, rate: f64, fastest: f64) -> impl Iterator<Item = (f64, f64)> {
    let longest = if fastest > 0.0 { RADIANS / fastest } else { f64::INFINITY };
    let mut from = start;
    std::iter::from_fn(move || {
        if from >= end {
            return None;
        }
        let fading = if rate > 0.0 { (1.0 / rate).max(GROWTH * (from - start)) } else { f64::INFINITY };
        let to = from + longest.min(fading);
        // Too short a panel for the clock is none that it can see.
        let to = if to > from { to.min(end) } else { end };
        Some((std::mem::replace(&mut from, to), to))
    })
}

#[cfg(test)]
mod tests {
    use super::{nodes, panels};

    fn integral(end: f64, rate: f64, fastest: f64, f: impl Fn(f64) -> f64) -> (f64, usize) {
        let mut evaluations = 0;
        let panel = |(a, b)| {
            evaluations += nodes(a, b).count();
            nodes(a, b).map(|(t, w)| w * f(t)).sum::<f64>()
        };
        (panels(0.0, end, rate, fastest).map(panel).sum(), evaluations)
    }

    #[test]
    fn products_of_sines_and_decays_are_integrated_to_rounding() {
        // ∫ sin²: against the closed form, over 0.3 to 3000 radians. A sum of n terms may round by n ulp.
        for end in [0.3, 2.0, 31.0, 3000.0] {
            let (found, evaluations) = integral(end, 0.0, 1.0, |t| t.sin() * t.sin());
            let exact = 0.5 * (end - end.sin() * end.cos());
            assert!((found / exact - 1.0).abs() < 1e-15 * evaluations as f64, "{end}: {found} {exact}");
        }
        // ∫ e^{−2rt} over far more than it lasts, fast and slow.
        for rate in [0.1, 1.0, 30.0, 5e4] {
            let (found, _) = integral(1.0, rate, 0.0, |t| (-2.0 * rate * t).exp());
            let exact = -(-2.0 * rate).exp_m1() / (2.0 * rate);
            assert!((found / exact - 1.0).abs() < 1e-14, "{rate}: {found} {exact}");
        }
    }

    #[test]
    fn the_rounding_of_a_late_clock_costs_no_more_nodes() {
        let count = |start: f64| panels(start, start + 1.0, 0.2, 31.4).count();
        assert!(count(0.0).abs_diff(count(1e6)) <= 1, "{} {}", count(0.0), count(1e6));
    }
}
