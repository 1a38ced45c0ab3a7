//! The first root of a polynomial: never passed, and reached.

use super::*;

#[test]
fn a_polynomial_that_is_said_to_stay_above_does_and_one_with_a_margin_is_said_to() {
    let mut draws = Draws::new(5, 1);
    for _ in 0..1000 {
        let (c, b, w) = draws.polynomial();
        // What the terms that fall can take away at most.
        let fall = -value(&lowest(c.map(|c| c.min(0.0)), b), w).0;
        for share in [0.5, 0.999, 1.001, 2.0] {
            let enough = c[0] - share * fall;
            let stays = stays_above(c, b, w, enough);
            assert_eq!(stays, share > 1.0 && fall > 0.0, "{c:?} {b} {w}: {share}");
            if stays {
                assert_above(&lowest([c[0] - enough, c[1], c[2], c[3]], b), w);
            }
        }
        let rises = c.map(f64::abs);
        assert!(stays_above(rises, 0.0, w, 0.5 * c[0]) && !stays_above(rises, 0.0, w, 2.0 * c[0]));
    }
}

#[test]
fn the_root_of_a_parabola_is_never_passed_and_missed_by_little() {
    let mut draws = Draws::new(5, 2);
    for _ in 0..2000 {
        // ½M(r − u)(u + q).
        let (r, q, m) = (draws.size(3.0), draws.size(20.0), draws.size(30.0));
        let (p, p1) = (0.5 * m * r * q, 0.5 * m * (r - q));
        let u = below_root(p, p1, m, f64::NAN);
        assert!(u <= r * (1.0 + ROUNDING), "{p} {p1} {m}: {u} > {r}");
        // For x = Mp/p′² ≤ 1 Halley's step is used, short of the root by the share
        // x²/((2 + x)(1 + x + √(1 + 2x))) ≤ x²/4.
        let x = m * p / (p1 * p1);
        let short = if p1 < 0.0 && x <= 1.0 { 0.25 * x * x } else { 0.0 };
        assert!(u >= r * (1.0 - short - ROUNDING), "{p} {p1} {m}: {u} < {r}");
        let root = (2.0 * p / m).sqrt();
        assert!((below_root(p, 0.0, m, r) - root).abs() <= ROUNDING * root);
        // Straight lines.
        assert!((below_root(p, -q, 0.0, r) * q - p).abs() <= ROUNDING * p);
        assert_eq!([below_root(p, 0.0, 0.0, r), below_root(p, q, 0.0, r)], [r, r]);
    }
}

#[test]
fn no_root_of_a_polynomial_is_passed() {
    let mut draws = Draws::new(5, 3);
    let (mut ends, mut whole) = (0, 0);
    for _ in 0..4000 {
        let (c, b, w) = draws.polynomial();
        let enough = if draws.chance(0.5) { 0.0 } else { c[0] * draws.between(-50.0, -2.0).exp2() };
        let (s, left) = first_root(c, b, w, enough);
        assert!(s > 0.0 && s <= w, "{c:?} {b} {w}: {s}");
        assert_above(&lowest(c, b), s);
        if s == w {
            whole += 1;
        } else if left <= enough {
            ends += 1;
            let (g, size) = value(&lowest(c, b), s);
            assert!((g.abs() - left).abs() <= ROUNDING * size, "{c:?} {b} {w}: {g:e}, not {left:e}");
        }
    }
    assert!(ends > 300 && whole > 500, "{ends} {whole}");
}

#[test]
fn the_first_root_is_reached_from_a_window_of_any_length() {
    let mut draws = Draws::new(5, 4);
    for _ in 0..4000 {
        let (c, root, noise) = draws.noisy();
        if c[4] > 0.0 {
            continue;
        }
        let w = root * (1.0 + draws.size(20.0));
        let (s, left) = first_root([c[0], c[1], c[2], c[3]], -c[4], w, noise);
        let what = format!("{c:?} {root} {w} {noise:e}: {s}");
        let (g, size) = value(&c, s);
        assert!(s <= root + late(&c, root), "{what}");
        assert!((g.abs() - left).abs() <= ROUNDING * size, "{what}");
        // Within the noise, or a tenth of what the bound takes away; by that far at least half way.
        assert!(s >= 0.5 * root && left <= noise.max(-0.1 / 24.0 * c[4] * s.powi(4)), "{what}");
        // A window that ends before the root is a step, unless the noise is met in a dip.
        let w = root * draws.between(0.0, 0.99);
        if c[4] == 0.0 && (0..100).all(|part| value(&c, 0.01 * part as f64 * w).0 > 2.0 * noise) {
            assert_eq!(first_root([c[0], c[1], c[2], c[3]], 0.0, w, noise).0, w, "{what}");
        }
    }
}
