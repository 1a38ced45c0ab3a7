//! Sine, cosine and exponential to about one unit in the last place, by additions and products
//! alone: inlined, they cost a third of the calls into the system's mathematics library, and their
//! bits are the same on every machine.

/// Beyond this many radians the reduction below loses digits.
const FAR: f64 = 1e6;

/// π/2 as a sum: two numbers of 33 bits, whose products with a count of quarter turns up to 2²⁰ are
/// exact, and the rest (Cody & Waite; the values are those of fdlibm).
const QUARTER: [f64; 3] = [1.570_796_326_734_125_6, 6.077_100_506_303_966e-11, 2.022_266_248_795_950_6e-21];

/// Adding this rounds to a whole number, which is then in the low bits (Rust never reorders sums).
const ROUNDING: f64 = 6_755_399_441_055_744.0;

/// sin x/x = 1 + x² (s₀ + s₁x² + …) on |x| ≤ π/4, minimax (fdlibm, `k_sin.c`).
const SINE: [f64; 6] = [
    -1.666_666_666_666_663_2e-1,
    8.333_333_333_322_49e-3,
    -1.984_126_982_985_795e-4,
    2.755_731_370_707_007e-6,
    -2.505_076_025_340_686e-8,
    1.589_690_995_211_55e-10,
];

/// cos x = 1 − x²/2 + x⁴ (c₀ + c₁x² + …) on |x| ≤ π/4, minimax (fdlibm, `k_cos.c`).
const COSINE: [f64; 6] = [
    4.166_666_666_666_66e-2,
    -1.388_888_888_887_411e-3,
    2.480_158_728_947_673e-5,
    -2.755_731_435_139_066_3e-7,
    2.087_572_321_298_175e-9,
    -1.135_964_755_778_819_5e-11,
];

/// sin x and cos x.
#[inline]
pub(crate) fn sin_cos(x: f64) -> (f64, f64) {
    // NaN is in no range.
    if (-FAR..FAR).contains(&x) { near(x) } else { x.sin_cos() }
}

/// Number of times for which users of the loops below have room.
pub(crate) const TOGETHER: usize = 16;

/// Writes the sines and cosines of ωt + φ at several times t, as [`sin_cos`] gives them.
#[inline]
pub(crate) fn sines((omega, phase): (f64, f64), times: &[f64], sin: &mut [f64], cos: &mut [f64]) {
    let far = |&t: &f64| !(-FAR..FAR).contains(&(omega * t + phase));
    let each = times.iter().zip(sin).zip(cos);
    if times.iter().any(far) {
        each.for_each(|((&t, sin), cos)| (*sin, *cos) = sin_cos(omega * t + phase));
    } else {
        // Without a branch, so that the compiler computes two at a time.
        each.for_each(|((&t, sin), cos)| (*sin, *cos) = near(omega * t + phase));
    }
}

/// sin x and cos x of a number that is not far.
#[inline(always)]
fn near(x: f64) -> (f64, f64) {
    let rounded = x * std::f64::consts::FRAC_2_PI + ROUNDING;
    let quarters = rounded - ROUNDING;
    // x less the quarter turns, as the sum y + tail.
    let exact = x - quarters * QUARTER[0];
    let second = quarters * QUARTER[1];
    let close = exact - second;
    let rest = quarters * QUARTER[2] - ((exact - close) - second);
    let y = close - rest;
    let tail = (close - y) - rest;
    let z = y * y;
    let w = z * z;
    let s = &SINE;
    let cube = z * y;
    let high = (s[1] + z * s[2]) + w * (s[3] + z * s[4] + w * s[5]);
    let sin = y - ((z * (0.5 * tail - cube * high) - tail) - cube * s[0]);
    let c = &COSINE;
    let high = z * (c[0] + z * c[1] + w * c[2]) + w * w * (c[3] + z * c[4] + w * c[5]);
    let half = 0.5 * z;
    let near = 1.0 - half;
    let cos = near + (((1.0 - near) - half) + (z * high - y * tail));
    let bits = rounded.to_bits();
    // An odd number of quarter turns exchanges the two.
    let swapped = (sin.to_bits() ^ cos.to_bits()) & (bits & 1).wrapping_neg();
    let [first, second] = [sin, cos].map(|x| f64::from_bits(x.to_bits() ^ swapped));
    // Quarter turns 2 and 3 change the sign of the sine, 1 and 2 that of the cosine.
    let sign = |x: f64, odd: u64| f64::from_bits(x.to_bits() ^ ((odd & 2) << 62));
    (sign(first, bits), sign(second, bits + 1))
}

/// Down to this the series of eleven terms has the digits of a double: the next is 3e-18.
const NEAR: f64 = 0.125;

/// eˣ; short for small |x|, as in a flight of a lightly damped body.
#[inline]
pub(crate) fn exp(x: f64) -> f64 {
    if (-NEAR..=NEAR).contains(&x) { short(x) } else { x.exp() }
}

/// Writes e^{rate·t} for several times t, as [`exp`] gives it.
#[inline]
pub(crate) fn exps(rate: f64, times: &[f64], out: &mut [f64]) {
    let each = out.iter_mut().zip(times);
    if times.iter().all(|&t| (-NEAR..=NEAR).contains(&(rate * t))) {
        each.for_each(|(out, &t)| *out = short(rate * t));
    } else {
        each.for_each(|(out, &t)| *out = exp(rate * t));
    }
}

#[inline(always)]
fn short(x: f64) -> f64 {
    let z = x * x;
    let w = z * z;
    let low = 0.5 + x * (1.0 / 6.0);
    let middle = (1.0 / 24.0 + x * (1.0 / 120.0)) + z * (1.0 / 720.0 + x * (1.0 / 5040.0));
    let high = (1.0 / 40_320.0 + x * (1.0 / 362_880.0)) + z * (1.0 / 3_628_800.0);
    1.0 + (x + z * (low + (z * middle + z * w * high)))
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Numbers of all sizes and signs up to `most`, from a Weyl sequence.
    fn samples(most: f64) -> impl Iterator<Item = f64> {
        (1..200_000u64).map(move |n| {
            let share = (n as f64 * 0.618_033_988_749_894_9).fract();
            let size = [1.0, 1e-1, 1e-3, 1e-8][(n % 4) as usize];
            if n % 8 < 4 { most * size * share } else { -most * size * share }
        })
    }

    #[test]
    fn sine_and_cosine_are_those_of_the_library_to_an_ulp() {
        // Both are within 0.8 units in the last place of the truth: they differ by at most one or
        // two.
        for x in samples(9.9e5).chain(samples(7.0)).chain([0.0, 1e-300, 0.5, 1.0]) {
            let ((s, c), (sin, cos)) = (sin_cos(x), x.sin_cos());
            let close = |a: f64, b: f64| a.to_bits().abs_diff(b.to_bits()) <= 1;
            assert!(close(s, sin) && close(c, cos), "{x:e}: {s:e} {sin:e}, {c:e} {cos:e}");
        }
    }

    #[test]
    fn several_sines_are_those_of_each() {
        for (omega, phase) in [(1.0, 0.0), (-31.4, 1.0), (1e7, 0.3)] {
            let times: Vec<f64> = samples(3.0).take(77).collect();
            let (mut sin, mut cos) = ([0.0; 77], [0.0; 77]);
            sines((omega, phase), &times, &mut sin, &mut cos);
            for (k, &t) in times.iter().enumerate() {
                assert_eq!((sin[k], cos[k]), sin_cos(omega * t + phase), "{omega} {t:e}");
            }
        }
    }

    #[test]
    fn several_exponentials_are_those_of_each() {
        for rate in [-0.04, 0.0, -7.0] {
            let times: Vec<f64> = samples(3.0).take(77).collect();
            let mut out = [0.0; 77];
            exps(rate, &times, &mut out);
            times.iter().zip(out).for_each(|(t, out)| assert_eq!(out, exp(rate * t), "{rate} {t:e}"));
        }
    }

    #[test]
    fn multiples_of_a_quarter_turn_keep_their_small_value() {
        // The double nearest to nπ/2 is off by up to half an ulp, which is the sine or cosine
        // there.
        for n in (1..600_000u32).step_by(7) {
            let x = f64::from(n) * std::f64::consts::FRAC_PI_2;
            let ((s, c), (sin, cos)) = (sin_cos(x), x.sin_cos());
            let close = |a: f64, b: f64| (a - b).abs() <= 4e-16 * b.abs().max(1e-14);
            assert!(close(s, sin) && close(c, cos), "{x:e}: {s:e} {sin:e}, {c:e} {cos:e}");
        }
    }

    #[test]
    fn what_is_far_or_no_number_goes_to_the_library() {
        for x in [1e6, -3e7, 1e300] {
            assert_eq!(sin_cos(x), x.sin_cos());
        }
        for x in [f64::NAN, f64::INFINITY, f64::NEG_INFINITY] {
            assert!(sin_cos(x).0.is_nan() && sin_cos(x).1.is_nan());
        }
        assert!(exp(f64::NAN).is_nan());
        assert_eq!((exp(0.0), exp(-750.0), exp(f64::NEG_INFINITY)), (1.0, 0.0, 0.0));
    }

    #[test]
    fn the_short_exponential_is_that_of_the_library_to_an_ulp() {
        for x in samples(0.125).chain([0.125, -0.125]) {
            assert!(exp(x).to_bits().abs_diff(x.exp().to_bits()) <= 1, "{x:e}");
        }
    }
}
