//! Minima that are 0 to rounding.

use super::*;

#[test]
fn a_minimum_that_is_0_to_rounding_is_found_where_it_is() {
    let mut draws = Draws::new(5, 7);
    for _ in 0..4000 {
        let (curve, noise) = (draws.size(10.0), draws.size(10.0));
        let unit = (noise / curve).sqrt();
        // The minimum, and how much higher g is at `s`, in units of the noise. All is so near that
        // rounding does not count, and the curve changes by less than 1e-3 on the way.
        let (height, above) = (draws.between(-6.0, 4.0), draws.between(0.1, 8.0));
        let away = (2.0 * above).sqrt() * unit;
        let (c3, bound) = (draws.number(2.0) * 1e-6 * curve / unit, draws.size(2.0) * 1e-6 * curve / unit.powi(2));
        let s = draws.size(6.0) * unit;
        let w = s + draws.size(6.0) * unit;
        let c = later(&[height * noise, 0.0, curve, c3, -bound], -away - s);
        let excess = height.abs().max(height + above) - 4.0;
        if excess.abs() < 0.01 {
            continue;
        }
        let counts = excess < 0.0;
        let what = format!("{c:?} {noise} {s} {away}: {excess}");
        let g = below(&c, bound, noise);
        match g.touch(s, w) {
            Some(Step::Touch(t)) => assert!(counts && (t - s - away).abs() <= 1e-3 * away && t < w, "{what}: {t}"),
            Some(step) => assert!(counts && step == Step::Free(w) && s + 1.001 * away >= w, "{what}"),
            None => assert!(!counts, "{what}"),
        }
        // Past it: where g is clearly above 0 again, not much farther.
        match (Below { passes_touch: true, ..g }.touch(s, w)) {
            Some(Step::Free(t)) => {
                assert!(counts && t > s && t <= w && (t == w || value(&c, t).0 > noise), "{what}: {t}");
                assert!(t - s <= 3.0 * away + 5.0 * unit, "{what}: {t}");
            }
            step => assert!(step.is_none() && !counts, "{what}"),
        }
    }
}

#[test]
fn a_touch_is_told_only_where_the_curve_stays() {
    let mut draws = Draws::new(5, 8);
    let (mut told, mut open) = (0, 0);
    for _ in 0..10000 {
        let (curve, noise) = (draws.size(10.0), draws.size(10.0));
        let unit = (noise / curve).sqrt();
        let s = if draws.chance(0.3) { 0.0 } else { draws.size(6.0) * unit };
        let (above, away) = (draws.between(0.0, 4.0), draws.between(0.0, 2.0) * unit);
        let (c3, bound) = (draws.number(6.0) * curve / unit, draws.number(6.0).abs() * curve / unit.powi(2));
        let c = later(&[above * noise, -curve * away, curve, c3, -bound], -s);
        let past = 2.0 * away + 4.0 * unit;
        match (Below { passes_touch: true, ..below(&c, bound, noise) }).touch(s, f64::INFINITY) {
            Some(Step::Free(t)) => {
                told += 1;
                for part in 0..=50 {
                    let there = later(&c, s + (t - s) * part as f64 / 50.0)[2];
                    assert!((there / curve - 1.0).abs() <= 0.501, "{c:?} {s} {t}: {there} of {curve}");
                }
            }
            // The curve of a function of the family may change by half of it.
            step => {
                open += 1;
                let varies = past * (c[3].abs() + bound * (s + past));
                assert!(step.is_none() && varies > 0.499 * curve, "{c:?} {s}: {varies} of {curve}");
            }
        }
    }
    assert!(told > 1000 && open > 1000, "{told} {open}");
}
