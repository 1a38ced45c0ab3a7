//! The quantile of Student's t distribution, and the spread of values: intervals are made of both.

use std::f64::consts::{FRAC_2_PI, FRAC_PI_2};

/// The share of the distribution between −t and t.
const LEVEL: f64 = 0.95;

/// The same quantile of the normal distribution.
const NORMAL: f64 = 1.959_963_984_540_054;

/// Above this many degrees of freedom the expansion about the normal quantile errs by less than
/// 1e-12 of t.
const MANY: u64 = 400;

/// The mean, and the sum of the squares about it.
pub(crate) fn spread(values: &[f64]) -> (f64, f64) {
    let mean = values.iter().sum::<f64>() / values.len() as f64;
    (mean, values.iter().map(|x| (x - mean) * (x - mean)).sum())
}

/// Student's t for a two-sided interval of 95 % with `freedom` degrees of freedom, 1 or more;
/// infinite for none.
///
/// For few degrees of freedom the finite sums of the distribution (Abramowitz & Stegun, Handbook of
/// Mathematical Functions, 26.7.3 and 26.7.4) are inverted by bisection, else the expansion 26.7.5.
pub(crate) fn student_95(freedom: u64) -> f64 {
    if freedom > MANY { expanded(freedom as f64) } else { student(freedom, LEVEL) }
}

/// The same for an interval that has the share `level`; exact for any, but slow for many degrees of
/// freedom.
pub(super) fn student(freedom: u64, level: f64) -> f64 {
    if freedom == 0 {
        return f64::INFINITY;
    }
    // t = √ν tan θ: the share grows with θ.
    let (mut low, mut high) = (0.0, FRAC_PI_2);
    for _ in 0..64 {
        let middle = 0.5 * (low + high);
        if share(freedom, middle) < level { low = middle } else { high = middle }
    }
    (freedom as f64).sqrt() * (0.5 * (low + high)).tan()
}

/// The share of the distribution between −t and t, with t = √ν tan θ.
fn share(freedom: u64, theta: f64) -> f64 {
    let (sin, cos) = theta.sin_cos();
    let odd = freedom % 2 == 1;
    // The terms are cosᵏ θ times (2·4…)/(3·5…) for odd ν, (1·3…)/(2·4…) for even ν.
    let mut term = if odd { cos } else { 1.0 };
    let mut sum = 0.0;
    let mut k = if odd { 1 } else { 0 };
    while k + 2 <= freedom {
        sum += term;
        term *= cos * cos * (k + 1) as f64 / (k + 2) as f64;
        k += 2;
    }
    if odd { FRAC_2_PI * (theta + sin * sum) } else { sin * sum }
}

/// The expansion in powers of 1/ν.
fn expanded(nu: f64) -> f64 {
    let z = NORMAL;
    let z2 = z * z;
    let terms = [
        (z2 + 1.0) / 4.0,
        ((5.0 * z2 + 16.0) * z2 + 3.0) / 96.0,
        (((3.0 * z2 + 19.0) * z2 + 17.0) * z2 - 15.0) / 384.0,
        ((((79.0 * z2 + 776.0) * z2 + 1482.0) * z2 - 1920.0) * z2 - 945.0) / 92_160.0,
    ];
    z * (1.0 + terms.iter().rev().fold(0.0, |sum, term| (sum + term) / nu))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn quantiles_are_those_of_the_tables() {
        // ν = 1: tan(0.475 π); ν = 2: √(2·0.95²/(1 − 0.95²)); the others by integration of the
        // density with Simpson's rule, to 1e-13 of the share.
        let closed = (0.475 * std::f64::consts::PI).tan();
        let two = (2.0 * 0.95_f64.powi(2) / (1.0 - 0.95_f64.powi(2))).sqrt();
        for (freedom, t) in [
            (1, closed),
            (2, two),
            (3, 3.182_446_305_284_263),
            (9, 2.262_157_162_798_205),
            (30, 2.042_272_456_301_238),
            (1000, 1.962_339_080_826_407),
        ] {
            let error = student_95(freedom) / t - 1.0;
            assert!(error.abs() < 1e-11, "{freedom}: {error:e}");
        }
        assert!(student_95(0).is_infinite());
    }

    #[test]
    fn both_ways_meet() {
        // The first term left out is about 2/ν⁵ = 2e-13 at 400; bisection ends at rounding.
        let theta = (expanded(400.0) / 20.0).atan();
        assert!((share(400, theta) - LEVEL).abs() < 1e-12, "{:e}", share(400, theta) - LEVEL);
    }
}
