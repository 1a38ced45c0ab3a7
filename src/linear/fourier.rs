//! The fast Fourier transform of a number of values that is a power of two.

use std::f64::consts::TAU;

/// Replaces X by x_j = Σ_i X_i e^{2πi·ij/n}, without the factor 1/n; `re` and `im` have the same
/// length n, a power of two.
///
/// The transform of Cooley & Tukey (1965, doi:10.1090/S0025-5718-1965-0178586-1) by squares of two,
/// in place. Its roots of unity are computed one by one, each to an ulp, so that its error stays at
/// some ulps of the root mean square, times √log₂ n.
pub(crate) fn inverse(re: &mut [f64], im: &mut [f64]) {
    let n = re.len();
    if n < 2 || !n.is_power_of_two() || im.len() != n {
        return;
    }
    let shift = usize::BITS - n.trailing_zeros();
    for i in 0..n {
        let j = i.reverse_bits() >> shift;
        if i < j {
            re.swap(i, j);
            im.swap(i, j);
        }
    }
    let root = |k: usize| (TAU * k as f64 / n as f64).sin_cos();
    let roots: Vec<(f64, f64)> = (0..n / 2).map(root).collect();
    let mut half = 1;
    while half < n {
        let stride = n / (2 * half);
        for (re, im) in re.chunks_exact_mut(2 * half).zip(im.chunks_exact_mut(2 * half)) {
            let ((re0, re1), (im0, im1)) = (re.split_at_mut(half), im.split_at_mut(half));
            let pairs = re0.iter_mut().zip(re1).zip(im0.iter_mut().zip(im1));
            for (((a, c), (b, d)), &(sin, cos)) in pairs.zip(roots.iter().step_by(stride)) {
                let (x, y) = (*c * cos - *d * sin, *c * sin + *d * cos);
                (*c, *d) = (*a - x, *b - y);
                (*a, *b) = (*a + x, *b + y);
            }
        }
        half *= 2;
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn it_is_the_sum_that_defines_it() {
        for n in [1_usize, 2, 4, 64, 512] {
            let value = |i: usize, k: f64| (k * i as f64 + 0.3).sin();
            let (mut re, mut im): (Vec<f64>, Vec<f64>) = (0..n).map(|i| (value(i, 1.7), value(i, 2.9))).unzip();
            inverse(&mut re, &mut im);
            for j in 0..n {
                let (mut x, mut y) = (0.0, 0.0);
                for i in 0..n {
                    let (sin, cos) = (TAU * ((i * j) % n) as f64 / n as f64).sin_cos();
                    x += value(i, 1.7) * cos - value(i, 2.9) * sin;
                    y += value(i, 1.7) * sin + value(i, 2.9) * cos;
                }
                // n terms of at most 1, each with a rounding.
                let error = (re[j] - x).abs().max((im[j] - y).abs());
                assert!(error < 4.0 * n as f64 * f64::EPSILON, "{n} {j}: {error:e}");
            }
        }
    }
}
