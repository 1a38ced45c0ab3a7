//! First roots and largest values of polynomials whose roots are chosen.

use super::*;
use crate::hash::Draws;

#[test]
fn the_first_root_is_found_to_rounding() {
    // (x − 0.3)(x − 0.30001)(x − 0.9) at the sign that starts above 0.
    let c = [0.3 * 0.30001 * 0.9, -(0.3 * 0.30001 + 0.3 * 0.9 + 0.30001 * 0.9), 0.3 + 0.30001 + 0.9, -1.0];
    let x = first_root(&c, 1.0).unwrap();
    // With two roots 1e-5 apart, rounding of the coefficients moves each by 1e-16/1e-5.
    assert!((x - 0.3).abs() < 1e-10, "{x}");
    assert_eq!(first_root(&c, 0.29), None);
}

#[test]
fn a_graze_counts_and_a_miss_does_not() {
    for (miss, met) in [(1e-3, false), (1e-12, false), (-1e-12, true)] {
        // (x − ½)² + miss: the second root of a hit is 2e-6 behind the first.
        let x = first_root(&[0.25 + miss, -1.0, 1.0], 1.0);
        assert_eq!(x.is_some(), met, "{miss}");
        if let Some(x) = x {
            assert!((x - (0.5 - 1e-6)).abs() < 1e-9, "{x}");
        }
    }
}

#[test]
fn the_first_root_and_the_lowest_value_of_a_cosine_are_found_to_rounding() {
    // The series of cos 2x + 0.3: its root is ½ arccos(−0.3), and on [0, 1] it falls throughout.
    let mut c = [0.0; TERMS];
    let mut term = 1.0;
    for (k, c) in c.iter_mut().enumerate() {
        if k > 0 {
            term *= 2.0 / k as f64;
        }
        *c = term * [1.0, 0.0, -1.0, 0.0][k % 4];
    }
    c[0] += 0.3;
    let x = first_root(&c, 1.0).unwrap();
    assert!((x - 0.5 * (-0.3_f64).acos()).abs() < 1e-15, "{x}");
    assert!((highest(&c, -1.0, 1.0) - (-0.3 - 2.0_f64.cos())).abs() < 1e-15);
}

#[test]
fn a_root_behind_a_dip_that_misses_is_found() {
    // ((x − 0.2)² + 1e-3)(0.7 − x): the dip at 0.2 stays above 0, the only root is 0.7.
    let (d, e) = (0.2_f64.powi(2) + 1e-3, 0.7);
    let c = [d * e, -d - 0.4 * e, e + 0.4, -1.0];
    let x = first_root(&c, 1.0).unwrap();
    // Rounding of the coefficients (≤ 1.1) over the slope at the root, 0.251.
    assert!((x - e).abs() <= 8.0 * f64::EPSILON * 1.1 / 0.251, "{x}");
    assert_eq!(first_root(&c, 0.69), None);
}

/// The coefficients of the product of 1 − x/r over the roots.
fn product(roots: &[f64]) -> Vec<f64> {
    let mut c = vec![0.0; roots.len() + 1];
    c[0] = 1.0;
    for r in roots {
        for n in (1..c.len()).rev() {
            c[n] -= c[n - 1] / r;
        }
    }
    c
}

#[test]
fn the_first_of_many_roots_is_found() {
    let (mut draws, mut tried) = (Draws::new(3, 1), 0);
    let mut draw = |low: f64, high: f64| draws.between(low, high);
    for _ in 0..3000 {
        // The others are behind it, some near, some outside the interval, or below 0.
        let first = draw(-6.0, 0.0).exp2();
        let mut roots = vec![first];
        for _ in 0..draw(0.0, 14.0) as usize {
            let other = match draw(0.0, 3.0) {
                x if x < 1.0 => first + draw(0.02, 1.0),
                x if x < 2.0 => draw(1.0, 9.0),
                _ => -draw(0.1, 9.0),
            };
            roots.push(other);
        }
        let c = product(&roots);
        // Rounding of each coefficient by each factor, over the slope at the root.
        let size = c.iter().rev().fold(0.0, |sum, c| sum * first + c.abs());
        let slope: f64 = roots[1..].iter().map(|r| 1.0 - first / r).product::<f64>() / first;
        let error = f64::EPSILON * (roots.len() + 1) as f64 * size / slope;
        if error > 1e-3 * first {
            continue;
        }
        tried += 1;
        let x = first_root(&c, 1.0);
        assert!(x.is_some_and(|x| (x - first).abs() <= error), "{roots:?}: {x:?}, {error:e}");
        assert_eq!(first_root(&c, first - error), None, "{roots:?}");
        // In other units, by a power of two, which changes no rounding.
        let other: Vec<f64> = c.iter().enumerate().map(|(n, c)| 8.0 * c * 0.25_f64.powi(n as i32)).collect();
        assert_eq!(first_root(&other, 4.0), x.map(|x| 4.0 * x), "{roots:?}");
    }
    assert!(tried > 2000, "{tried}");
}

#[test]
fn a_root_at_an_end_counts() {
    // Exact in binary numbers.
    assert_eq!(first_root(&[1.0, -1.0], 1.0), Some(1.0));
    assert_eq!(first_root(&[0.5, -0.25, -0.25], 1.0), Some(1.0));
    assert_eq!(first_root(&[0.5, -1.0], 1.0), Some(0.5));
    // With more terms than the quick test takes: 7/7 and 7/14 are exact too.
    let mut c = [0.0; 15];
    (c[0], c[1]) = (7.0, -7.0);
    assert_eq!(first_root(&c, 1.0), Some(1.0));
    // A touch is known to the square root of rounding.
    let x = first_root(&[1.0, -2.0, 1.0], 1.0).unwrap();
    assert!((x - 1.0).abs() <= f64::EPSILON.sqrt(), "{x}");
    // So near the start that a bisection would take more than a hundred steps.
    let x = first_root(&[1e-30, -1.0, -1.0], 1.0).unwrap();
    assert!((x - 1e-30).abs() <= 4.0 * f64::EPSILON * 1e-30, "{x}");
}

#[test]
fn roots_near_each_other_and_near_the_start_are_found() {
    for place in [1e-2, 1e-4, 1e-6, 3e-8] {
        // Two roots 1e-5 of their place apart: rounding moves each by 1e-16/1e-5 of it.
        let x = first_root(&product(&[place, place * 1.00001]), 1.0);
        assert!(x.is_some_and(|x| (x - place).abs() <= 1e-10 * place), "{place}: {x:?}");
    }
    // Touches so near the start that halving ends first.
    for place in [1e-10, 1e-18] {
        let x = first_root(&product(&[place, place]), 1.0);
        assert!(x.is_some_and(|x| (x - place).abs() <= 2.0 * f64::EPSILON), "{place}: {x:?}");
    }
}

#[test]
fn the_largest_value_is_that_of_the_peak_wherever_it_is() {
    for part in 0..=80 {
        // 3 − (x − a)² − (x − a)⁴: in the middle of a part, and at the border of two.
        let a = part as f64 / 64.0;
        let c = [3.0 - a * a - a.powi(4), 2.0 * a + 4.0 * a.powi(3), -1.0 - 6.0 * a * a, 4.0 * a, -1.0];
        let value = |x: f64| 3.0 - (x - a).powi(2) - (x - a).powi(4);
        let peak = value(a.min(1.0));
        // Rounding of the terms, up to 15.
        assert!((highest(&c, 1.0, 1.0) - peak).abs() <= 20.0 * f64::EPSILON * 15.0, "{a}");
        assert!((highest(&c.map(|c| -c), -1.0, 1.0) - peak).abs() <= 20.0 * f64::EPSILON * 15.0, "{a}");
        let low = value(if a < 0.5 { 1.0 } else { 0.0 });
        assert!((highest(&c, -1.0, 1.0) + low).abs() <= 20.0 * f64::EPSILON * 15.0, "{a}");
    }
}
