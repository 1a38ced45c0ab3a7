//! Normal distributions by the inverse of their distribution function.

use crate::error::{Error, Result};
use std::f64::consts::{PI, SQRT_2};

/// A normal distribution, cut off where bounds are given: values beyond them are never drawn, and
/// those within keep their proportions.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Normal {
    /// Mean, before it is cut off.
    pub mean: f64,
    /// Standard deviation, before it is cut off; above 0.
    pub deviation: f64,
    /// Smallest value; `None` without a bound.
    pub least: Option<f64>,
    /// Largest value; `None` without a bound.
    pub most: Option<f64>,
}

impl Normal {
    /// The quantile of `share` (0 to 1): that share of the distribution lies below it.
    #[must_use]
    pub fn at(&self, share: f64) -> f64 {
        let standard = |x: f64| (x - self.mean) / self.deviation;
        let [low, high] = [
            self.least.map_or(0.0, |least| below(standard(least))),
            self.most.map_or(1.0, |most| below(standard(most))),
        ];
        // Random numbers of 32 or 53 bits are not closer to 0 or 1 than this, except 0 and 1
        // themselves.
        let share = (low + (high - low) * share).clamp(2.0_f64.powi(-54), 1.0 - 2.0_f64.powi(-53));
        let x = self.mean + self.deviation * quantile(share);
        x.max(self.least.unwrap_or(f64::NEG_INFINITY)).min(self.most.unwrap_or(f64::INFINITY))
    }

    pub(in crate::sweep) fn validate(&self, key: &str) -> Result<()> {
        let refuse = |what: &str, x: f64, expected: String| {
            Err(Error::invalid(format!("{key}.{what}"), format_args!("{x:?}"), expected))
        };
        if !self.mean.is_finite() {
            return refuse("mean", self.mean, "a finite number".to_owned());
        }
        if !(self.deviation.is_finite() && self.deviation > 0.0) {
            return refuse("deviation", self.deviation, "a finite number above 0".to_owned());
        }
        let [low, high] = [self.least.unwrap_or(f64::NEG_INFINITY), self.most.unwrap_or(f64::INFINITY)];
        if low >= high || low.is_nan() || high.is_nan() {
            return refuse("most", high, format!("a number above least, {low:?}"));
        }
        // Beyond five deviations on one side, double precision cannot resolve the distribution
        // function.
        let far = 5.0 * self.deviation;
        if low > self.mean + far || high < self.mean - far {
            let (what, x) = if low > self.mean { ("least", low) } else { ("most", high) };
            return refuse(what, x, format!("a bound within 5 deviations of the mean, {:?}", self.mean));
        }
        Ok(())
    }
}

/// Φ(x), the share of the standard normal distribution below `x`: by its series up to |x| = 3,
/// beyond by Laplace's continued fraction (Abramowitz & Stegun 26.2.11 and 26.2.14).
fn below(x: f64) -> f64 {
    let density = (-0.5 * x * x).exp() / (SQRT_2 * PI.sqrt());
    if x.abs() > 3.0 {
        let tail = (1..=60).rev().fold(x.abs(), |below, k| x.abs() + f64::from(k) / below);
        let outside = density / tail;
        return if x > 0.0 { 1.0 - outside } else { outside };
    }
    let (mut term, mut sum, mut n) = (x, x, 1.0);
    while term.abs() > 1e-18 * sum.abs() {
        n += 2.0;
        term *= x * x / n;
        sum += term;
    }
    0.5 + density * sum
}

/// Φ⁻¹(p): Wichura's algorithm AS 241, PPND16, to about 1e-16 (Applied Statistics 37(3), 1988,
/// doi:10.2307/2347330).
fn quantile(p: f64) -> f64 {
    let ratio = |r: f64, above: [f64; 8], below: [f64; 7]| {
        let over = above.iter().rev().fold(0.0, |sum, c| sum * r + c);
        let under = below.iter().rev().fold(0.0, |sum, c| sum * r + c);
        over / (under * r + 1.0)
    };
    let q = p - 0.5;
    if q.abs() <= 0.425 {
        return q * ratio(0.180625 - q * q, CENTRE.0, CENTRE.1);
    }
    let r = (-(if q < 0.0 { p } else { 1.0 - p }).ln()).sqrt();
    let x = if r <= 5.0 { ratio(r - 1.6, MIDDLE.0, MIDDLE.1) } else { ratio(r - 5.0, TAIL.0, TAIL.1) };
    x.copysign(q)
}

type Coefficients = ([f64; 8], [f64; 7]);

const CENTRE: Coefficients = (
    [
        3.387_132_872_796_366_5,
        133.141_667_891_784_38,
        1_971.590_950_306_551_3,
        13_731.693_765_509_46,
        45_921.953_931_549_87,
        67_265.770_927_008_7,
        33_430.575_583_588_13,
        2_509.080_928_730_122_7,
    ],
    [
        42.313_330_701_600_91,
        687.187_007_492_057_9,
        5_394.196_021_424_751,
        21_213.794_301_586_597,
        39_307.895_800_092_71,
        28_729.085_735_721_943,
        5_226.495_278_852_855,
    ],
);

const MIDDLE: Coefficients = (
    [
        1.423_437_110_749_683_5,
        4.630_337_846_156_546,
        5.769_497_221_460_691,
        3.647_848_324_763_204_5,
        1.270_458_252_452_368_4,
        0.241_780_725_177_450_6,
        0.022_723_844_989_269_184,
        7.745_450_142_783_414e-4,
    ],
    [
        2.053_191_626_637_759,
        1.676_384_830_183_803_8,
        0.689_767_334_985_1,
        0.148_103_976_427_480_08,
        0.015_198_666_563_616_457,
        5.475_938_084_995_345e-4,
        1.050_750_071_644_416_9e-9,
    ],
);

const TAIL: Coefficients = (
    [
        6.657_904_643_501_103,
        5.463_784_911_164_114,
        1.784_826_539_917_291_3,
        0.296_560_571_828_504_87,
        0.026_532_189_526_576_124,
        1.242_660_947_388_078_4e-3,
        2.711_555_568_743_487_6e-5,
        2.010_334_399_292_288_1e-7,
    ],
    [
        0.599_832_206_555_888,
        0.136_929_880_922_735_8,
        0.014_875_361_290_850_615,
        7.868_691_311_456_133e-4,
        1.846_318_317_510_054_7e-5,
        1.421_511_758_316_446e-7,
        2.044_263_103_389_939_8e-15,
    ],
);

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn quantiles_have_their_tabulated_values() {
        // Values with as many digits as are commonly tabulated; the first two are the algorithm's
        // own test values in the paper.
        for (p, x) in [
            (0.25, -0.674_489_750_196_081_7),
            (0.001, -3.090_232_306_167_813),
            (1e-20, -9.262_340_089_798_408),
            (0.975, 1.959_963_984_540_054),
            (0.5, 0.0),
        ] {
            assert!((quantile(p) - x).abs() <= 4e-15 * x.abs().max(1.0), "{p}: {}", quantile(p));
        }
    }

    #[test]
    fn the_quantile_undoes_the_distribution() {
        for i in -70..=70 {
            let x = 0.1 * f64::from(i);
            // Above 0 the tail is computed as a difference from 1, with an error of 1e-16.
            let slack = 1e-14 * (1.0 + x.abs()) + if x > 0.0 { 2e-16 * (0.5 * x * x).exp() * 2.6 } else { 0.0 };
            assert!((quantile(below(x)) - x).abs() < slack, "{x}: {:e}", quantile(below(x)) - x);
        }
    }

    #[test]
    fn cut_off_it_keeps_its_proportions_within_the_bounds() {
        let normal = Normal { mean: 1.0, deviation: 2.0, least: Some(0.0), most: None };
        let whole = Normal { least: None, ..normal };
        // To the rounding of Φ.
        assert!((0.0..1e-15).contains(&normal.at(0.0)));
        assert!((whole.at(0.5) - 1.0).abs() < 1e-15);
        // P(X > 3 | X > 0) = P(X > 3)/P(X > 0).
        let share = 1.0 - (1.0 - below(1.0)) / (1.0 - below(-0.5));
        assert!((normal.at(share) - 3.0).abs() < 1e-13);
        assert!(normal.at(1.0).is_finite() && whole.at(0.0).is_finite());
    }

    #[test]
    fn what_makes_no_sense_is_refused() {
        let good = Normal { mean: 1.0, deviation: 2.0, least: Some(0.0), most: Some(3.0) };
        good.validate("normal").unwrap();
        for bad in [
            Normal { deviation: 0.0, ..good },
            Normal { mean: f64::NAN, ..good },
            Normal { most: Some(-1.0), ..good },
            Normal { least: Some(12.0), most: None, ..good },
        ] {
            assert!(bad.validate("normal").is_err(), "{bad:?}");
        }
    }
}
