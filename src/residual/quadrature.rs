//! Integrals along exact motion, by Gauss's rule on panels whose length is chosen beforehand.
//!
//! The integrands are products of two functions of the motion and its load, and each of those is a
//! sum of sines and exponentials with known rates. So the panels need no adaptive refinement: a
//! sine of rate ω enters products with at most 2ω, and the rule of n points has an error of (2ωL)²ⁿ
//! L (n!)⁴/((2n+1)(2n)!³) of the integrand's size over a panel of length L. Refinement to a
//! tolerance would run into the rounding error of the load's phase, ε·ωt, which grows with the
//! time, and halve panels in vain.
//!
//! The integrals do not use the coefficients of the closed-form motion: those are what is checked
//! here.

/// A Gauss–Legendre rule: the radians of the fastest rate on a panel up to which its error is at
/// most 2e-18 (relative; see above), and the positive half of its nodes on [−1, 1] with their
/// weights.
type Rule = (f64, &'static [(f64, f64)]);

const RULES: [Rule; 4] = [
    (
        1.0,
        &[
            (0.183_434_642_495_649_8, 0.362_683_783_378_362),
            (0.525_532_409_916_329, 0.313_706_645_877_887_27),
            (0.796_666_477_413_626_7, 0.222_381_034_453_374_48),
            (0.960_289_856_497_536_2, 0.101_228_536_290_376_26),
        ],
    ),
    (
        2.0,
        &[
            (0.148_874_338_981_631_22, 0.295_524_224_714_752_87),
            (0.433_395_394_129_247_2, 0.269_266_719_309_996_35),
            (0.679_409_568_299_024_4, 0.219_086_362_515_982_04),
            (0.865_063_366_688_984_5, 0.149_451_349_150_580_6),
            (0.973_906_528_517_171_7, 0.066_671_344_308_688_14),
        ],
    ),
    (
        3.5,
        &[
            (0.125_233_408_511_468_9, 0.249_147_045_813_402_8),
            (0.367_831_498_998_180_2, 0.233_492_536_538_354_8),
            (0.587_317_954_286_617_4, 0.203_167_426_723_065_92),
            (0.769_902_674_194_304_7, 0.160_078_328_543_346_22),
            (0.904_117_256_370_474_9, 0.106_939_325_995_318_43),
            (0.981_560_634_246_719_4, 0.047_175_336_386_511_83),
        ],
    ),
    (
        6.5,
        &[
            (0.095_012_509_837_637_44, 0.189_450_610_455_068_5),
            (0.281_603_550_779_258_9, 0.182_603_415_044_923_58),
            (0.458_016_777_657_227_4, 0.169_156_519_395_002_54),
            (0.617_876_244_402_643_7, 0.149_595_988_816_576_74),
            (0.755_404_408_355_003, 0.124_628_971_255_533_88),
            (0.865_631_202_387_831_8, 0.095_158_511_682_492_79),
            (0.944_575_023_073_232_6, 0.062_253_523_938_647_89),
            (0.989_400_934_991_649_9, 0.027_152_459_411_754_096),
        ],
    ),
];

/// Radians of the fastest oscillation on one panel.
const RADIANS: f64 = 6.5;

/// A panel is at most this many times as long as the time from the arc's start to the panel's: over
/// [x, 3x/2] of a decay e⁻ˣ the rule of ten points has its largest error at x = 20, 3e-19.
const GROWTH: f64 = 0.5;

/// A panel: an interval of time, s, and the rule for it.
#[derive(Debug, Clone, Copy)]
pub(super) struct Panel {
    from: f64,
    to: f64,
    rule: &'static [(f64, f64)],
}

impl Panel {
    /// A panel on which no rate of oscillation or decay exceeds `fastest` (1/s); beyond 6.5 radians
    /// the error exceeds rounding.
    pub fn new(from: f64, to: f64, fastest: f64) -> Self {
        let radians = fastest * (to - from);
        let fits = RULES.iter().find(|(longest, _)| radians <= *longest);
        let rule = fits.unwrap_or(&RULES[RULES.len() - 1]).1;
        Self { from, to, rule }
    }
}

/// The nodes of a panel, all inside it, and their weights, s.
pub(super) fn nodes(panel: Panel) -> impl Iterator<Item = (f64, f64)> {
    let (middle, half) = (0.5 * (panel.from + panel.to), 0.5 * (panel.to - panel.from));
    panel.rule.iter().flat_map(|&(x, w)| [(-x, w), (x, w)]).map(move |(x, w)| (middle + half * x, half * w))
}

/// The panels of an arc on which oscillations have rates up to `fastest` (rad/s), and decays from
/// the arc's start have rates up to `rate` (1/s). The first panel is no longer than 1/rate, and the
/// following ones grow with the time since the start: a few nodes over the whole arc would miss the
/// decay.
pub(super) fn panels(start: f64, end: f64, rate: f64, fastest: f64) -> impl Iterator<Item = Panel> {
    let longest = if fastest > 0.0 { RADIANS / fastest } else { f64::INFINITY };
    let mut from = start;
    std::iter::from_fn(move || {
        if from >= end {
            return None;
        }
        let fading = if rate > 0.0 { (1.0 / rate).max(GROWTH * (from - start)) } else { f64::INFINITY };
        let to = from + longest.min(fading);
        // A panel shorter than an ulp of the time is replaced by the rest of the arc.
        let to = if to > from { to.min(end) } else { end };
        Some(Panel::new(std::mem::replace(&mut from, to), to, fastest.max(rate)))
    })
}

#[cfg(test)]
mod tests {
    use super::{nodes, panels};

    fn integral(end: f64, rate: f64, fastest: f64, f: impl Fn(f64) -> f64) -> (f64, usize) {
        let mut evaluations = 0;
        let panel = |panel| {
            evaluations += nodes(panel).count();
            nodes(panel).map(|(t, w)| w * f(t)).sum::<f64>()
        };
        (panels(0.0, end, rate, fastest).map(panel).sum(), evaluations)
    }

    #[test]
    fn products_of_sines_and_decays_are_integrated_to_rounding() {
        // ∫ sin²: against the closed form, over 0.3 to 3000 radians. A sum of n terms has a
        // rounding error of n ulp.
        for end in [0.3, 0.9, 2.0, 3.4, 6.4, 31.0, 3000.0] {
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

    #[test]
    fn a_decay_is_followed_wherever_its_arc_starts() {
        // ∫ e^{−2r(t − start)}, long after the clock began: times are rounded to 1e-13 s there.
        for (start, rate) in [(0.0, 40.0), (1.0, 40.0), (1024.0, 40.0), (1024.0, 3.0)] {
            let decay = |t: f64| (-2.0 * rate * (t - start)).exp();
            let sum: f64 =
                panels(start, start + 2.0, rate, 0.0).flat_map(nodes).map(|(t, weight)| weight * decay(t)).sum();
            let exact = -(-4.0 * rate).exp_m1() / (2.0 * rate);
            assert!((sum / exact - 1.0).abs() < 1e-10, "{start}, {rate}: {sum} {exact}");
        }
    }

    #[test]
    fn a_decay_within_an_ulp_of_the_time_has_one_panel() {
        // The ulp at 1e9 s is 1e-7 s.
        assert_eq!(panels(1e9, 1e9 + 1.0, 1e12, 0.0).take(9).count(), 1);
        assert_eq!(panels(1e9, 1e9 + 1.0, 0.0, 1e12).take(9).count(), 1);
        assert_eq!(panels(2.0, 2.0, 1.0, 1.0).count(), 0);
    }
}
