//! Divided differences of the exponential function: the response to an exponential load, without
//! singular cases.

use nalgebra::Complex;

/// Up to this distance between nodes the power series is used. Beyond it, the difference quotient
/// amplifies rounding by at most the ratio of the exponential to its divided difference, n! / 2 for
/// n + 1 nodes: two or three units in the last place for the four nodes used here.
const SERIES_DIAMETER: f64 = 2.0;

/// Maximum number of terms of the series: 2ⁿ/n! < 1e-16 from n = 24 on.
const SERIES_TERMS: usize = 30;

/// exp[z₀, …, z_n] for two to four nodes in the left half plane.
///
/// The response from rest of (d/dt − λ₁)(d/dt − λ₂) x = e^{μt} is t² exp[λ₁t, λ₂t, μt]: resonance,
/// a double root and vanishing stiffness are coinciding nodes, where the divided difference stays
/// regular.
///
/// Far nodes: exp[z₀ … z_n] = (exp[z₀ … z_{n−1}] − exp[z₁ … z_n])/(z₀ − z_n) with the farthest pair
/// at the ends. Near nodes: e^{z̄} Σ_k h_k(z − z̄)/(k + n)! with h_k the complete symmetric
/// polynomials.
pub(super) fn divided_exp<const N: usize>(nodes: [Complex<f64>; N]) -> Complex<f64> {
    divided(&nodes)
}

fn divided(nodes: &[Complex<f64>]) -> Complex<f64> {
    let Some((&first, rest)) = nodes.split_first() else { return Complex::new(0.0, 0.0) };
    if rest.is_empty() {
        return first.exp();
    }
    let (mut widest, mut ends) = (0.0, (0, 1));
    for (i, a) in nodes.iter().enumerate() {
        for (j, b) in nodes.iter().enumerate().skip(i + 1) {
            let distance = (a - b).norm();
            if distance > widest {
                (widest, ends) = (distance, (i, j));
            }
        }
    }
    if widest < SERIES_DIAMETER {
        return series(nodes);
    }
    let (i, j) = ends;
    let without = |skip: usize| {
        let mut kept = [Complex::new(0.0, 0.0); 4];
        let mut count = 0;
        for (index, &z) in nodes.iter().enumerate() {
            if index != skip && count < kept.len() {
                kept[count] = z;
                count += 1;
            }
        }
        divided(&kept[..count])
    };
    (without(j) - without(i)) / (nodes[i] - nodes[j])
}

/// The power series about the mean of the nodes.
fn series(nodes: &[Complex<f64>]) -> Complex<f64> {
    let count = nodes.len();
    let mean = nodes.iter().sum::<Complex<f64>>() / count as f64;
    // symmetric[i] = h_k of the first i + 1 nodes; h_k(z₀ … z_i) = h_k(z₀ … z_{i−1}) + z_i
    // h_{k−1}(z₀ … z_i).
    let mut symmetric = [Complex::new(1.0, 0.0); 4];
    let mut factor: f64 = (1..count).map(|i| 1.0 / i as f64).product();
    let mut sum = Complex::new(factor, 0.0);
    for k in 1..SERIES_TERMS {
        let mut before = Complex::new(0.0, 0.0);
        for (h, &z) in symmetric.iter_mut().zip(nodes) {
            *h = before + (z - mean) * *h;
            before = *h;
        }
        factor /= (k + count - 1) as f64;
        let term = before * factor;
        sum += term;
        // h₁ vanishes since the series is about the mean, so a small first term is no sign of
        // convergence.
        if k > 1 && term.norm() <= 1e-18 * sum.norm() && symmetric[0].norm() * factor <= 1e-18 * sum.norm() {
            break;
        }
    }
    sum * mean.exp()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn known_values_hold_near_and_far() {
        let r = |x: f64| Complex::new(x, 0.0);
        let e = (-1.0f64).exp();
        assert!((divided_exp([r(0.0), r(0.0), r(0.0)]) - r(0.5)).norm() < 1e-16);
        assert!((divided_exp([r(-1.0), r(-1.0)]) - r(e)).norm() < 1e-16);
        // exp[0, 0, −x] = (e^{−x} − 1 + x)/x².
        assert!((divided_exp([r(0.0), r(-1.0), r(0.0)]) - r(e)).norm() < 2e-16);
        let x = 30.0f64;
        let exact = ((-x).exp() - 1.0 + x) / (x * x);
        assert!((divided_exp([r(0.0), r(-x), r(0.0)]) - r(exact)).norm() < 1e-16);
        // exp[iy, −iy] = sin(y)/y.
        for y in [1e-9, 0.3, 0.999, 1.001, 7.0] {
            let d = divided_exp([Complex::new(0.0, y), Complex::new(0.0, -y)]);
            assert!((d - r(y.sin() / y)).norm() < 4e-16, "{y}");
        }
    }
}
