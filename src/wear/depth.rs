//! The depth of a scar of known volume on a tube, where it bears against a round hole or a flat.
//!
//! A tube of radius R that has worn by the depth d bears with a scar whose cross-section, over the
//! width of the support, has the volume V = L A(d). On a flat A is the segment that a chord at
//! depth d cuts off the circle; in a hole of radius R_h = R + γ it is the part of the circle
//! outside the hole when the tube is moved by d beyond the position in which it touches, a moon:
//!
//! A = R² acos((x − c)/R) − R_h² acos(x/R_h) + h c,   c = γ + d,   x = (R_h² − R² + c²)/(2c),
//! h² = R_h² − x²
//!
//! (geometry `TUBE_ALESAGE` of code_aster's POST_USURE, document R7.04.10). With the half angles α
//! and β under which the common chord 2h is seen from the centres of tube and hole, that is a
//! difference of two segments, R²(α − sin α cos α) − R_h²(β − sin β cos β). In this form, and with
//! R_h − x = d(2R − d)/(2c), no digits are lost where d is small. The slope is dA/dd = 2h.

use std::f64::consts::PI;

/// α − sin α cos α: the area of a segment of half angle α in a circle of radius 1.
fn segment(alpha: f64) -> f64 {
    let turn = 2.0 * alpha;
    if turn > 1.0 {
        return 0.5 * (turn - turn.sin());
    }
    // y − sin y = y³/6 (1 − y²/20 (1 − y²/42 (1 − ...))); the term after the last is below 1e-17.
    let square = turn * turn;
    let factors = [342.0, 272.0, 210.0, 156.0, 110.0, 72.0, 42.0, 20.0];
    let sum = factors.iter().fold(1.0, |sum, factor| 1.0 - square / factor * sum);
    turn * square * sum / 12.0
}

/// Area (m²) of the segment that a flat cuts off a tube of radius `radius` (m) at `depth` (m), from
/// 0 to twice the radius.
pub(super) fn flat_area(depth: f64, radius: f64) -> f64 {
    let share = (depth / (2.0 * radius)).clamp(0.0, 1.0);
    radius * radius * segment(2.0 * share.sqrt().asin())
}

/// Area (m²) of the moon by which a tube of radius `radius` (m) lies outside a hole that is wider
/// by the radial gap `gap` (m, above 0), when it is moved by `depth` (m) beyond touching; from 0 to
/// twice the radius.
fn moon_area(depth: f64, radius: f64, gap: f64) -> f64 {
    let depth = depth.clamp(0.0, 2.0 * radius);
    let [alpha, beta] = half_angles(depth, radius, gap);
    let hole = radius + gap;
    (radius * radius * segment(alpha) - hole * hole * segment(beta)).max(0.0)
}

/// α and β of a moon.
fn half_angles(depth: f64, radius: f64, gap: f64) -> [f64; 2] {
    let (c, hole) = (gap + depth, radius + gap);
    let below = depth * (2.0 * radius - depth) / (2.0 * c);
    let x = hole - below;
    let h = (below * (hole + x)).max(0.0).sqrt();
    [h.atan2(x - c), h.atan2(x)]
}

/// Depth (m) of a scar that takes `volume` (m³) off a tube of radius `radius` (m) on a flat over
/// `width` (m); `None` where that is the whole tube or more, or a value is negative or not finite.
pub(super) fn flat_depth(volume: f64, width: f64, radius: f64) -> Option<f64> {
    let sound = volume >= 0.0 && [width, radius].iter().all(|x| x.is_finite() && *x > 0.0);
    let slope = |depth: f64| 2.0 * (depth * (2.0 * radius - depth)).max(0.0).sqrt();
    sound.then(|| depth_of(volume / width, radius, |depth| flat_area(depth, radius), slope)).flatten()
}

/// As [`flat_depth`], in a round hole that is wider than the tube by the radial gap `gap` (m, above
/// 0).
pub(super) fn moon_depth(volume: f64, width: f64, radius: f64, gap: f64) -> Option<f64> {
    let sound = volume >= 0.0 && [width, radius, gap].iter().all(|x| x.is_finite() && *x > 0.0);
    let slope = |depth: f64| 2.0 * radius * half_angles(depth, radius, gap)[0].sin();
    sound.then(|| depth_of(volume / width, radius, |depth| moon_area(depth, radius, gap), slope)).flatten()
}

/// Depth (m) by which `volume` (m³), taken off evenly all round a tube of radius `radius` (m) over
/// `width` (m), makes it thinner, V/(2πRL): the other extreme from a single scar.
pub(super) fn all_round(volume: f64, width: f64, radius: f64) -> f64 {
    volume / (2.0 * PI * radius * width)
}

/// The depth at which the increasing function `area` is `wanted` (m²), by Newton's method within a
/// bracket.
fn depth_of(wanted: f64, radius: f64, area: impl Fn(f64) -> f64, slope: impl Fn(f64) -> f64) -> Option<f64> {
    if wanted <= 0.0 {
        return Some(0.0);
    }
    if wanted >= PI * radius * radius {
        return None;
    }
    let (mut low, mut high) = (0.0, 2.0 * radius);
    // A shallow segment has the area 4/3 √(2R) d^(3/2), and a moon is larger.
    let mut depth = (0.75 * wanted / (2.0 * radius).sqrt()).powf(2.0 / 3.0).min(radius);
    for _ in 0..200 {
        let over = area(depth) - wanted;
        if over > 0.0 {
            high = depth
        } else {
            low = depth
        }
        let newton = depth - over / slope(depth);
        // Where the bracket is wide, its geometric mean: a depth may be far smaller than the
        // radius.
        let middle = if low > 0.0 { (low * high).sqrt() } else { 1e-3 * high };
        let next = if newton > low && newton < high { newton } else { middle };
        if (next - depth).abs() <= 2.0 * f64::EPSILON * depth {
            return Some(next);
        }
        depth = next;
    }
    Some(depth)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_scar_is_deeper_on_a_flat_than_in_a_hole() {
        // 30 mm³ off a tube of 19.05 mm, over 25 mm: on a flat, and in a hole wider by 0.2 mm.
        let (flat, hole) = (flat_depth(30e-9, 25e-3, 9.525e-3), moon_depth(30e-9, 25e-3, 9.525e-3, 0.2e-3));
        assert!((flat.unwrap() - 0.350e-3).abs() < 1e-6 && (hole.unwrap() - 0.109e-3).abs() < 1e-6);
    }

    /// Radius of the tube, gap, width and volume of the reference values.
    const TUBE: [f64; 4] = [0.009_525, 0.000_2, 0.025, 3e-8];

    #[test]
    fn the_depths_are_those_computed_with_40_digits() {
        let [radius, gap, width, volume] = TUBE;
        let round = moon_depth(volume, width, radius, gap).unwrap();
        let flat = flat_depth(volume, width, radius).unwrap();
        // Some roundings of the areas, which grow with the depth to the power 1.5 and less.
        assert!((round / 0.000_109_216_051_031_080_68 - 1.0).abs() < 1e-13, "{round:e}");
        assert!((flat / 0.000_350_324_405_082_514_47 - 1.0).abs() < 1e-13, "{flat:e}");
        assert!((all_round(volume, width, radius) - volume / (2.0 * PI * radius * width)).abs() < 1e-20);
    }

    #[test]
    fn code_aster_finds_the_same_depth_in_a_hole() {
        // ZZZZ405A, T6: radii of tube and hole 1 and 2, half a width of 10, V = 1.5768e-3. Its test
        // file has 9.56453382969e-4, from an iteration that stops at 3e-7.
        let depth = moon_depth(1.5768e-3, 20.0, 1.0, 1.0).unwrap();
        assert!((depth / 9.564_533_829_69e-4 - 1.0).abs() < 5e-7, "{depth:e}");
    }

    #[test]
    fn small_scars_keep_their_digits() {
        // A shallow moon: near the contact the circles part like x²(1/R − 1/R_h)/2, so that
        // A = 4/3 √(2/(1/R − 1/R_h)) d^(3/2) up to a share of d/γ.
        let [radius, gap, ..] = TUBE;
        let apart = 1.0 / radius - 1.0 / (radius + gap);
        for depth in [1e-10, 1e-12, 1e-15] {
            let shallow = 4.0 / 3.0 * (2.0 / apart).sqrt() * depth * depth.sqrt();
            let area = moon_area(depth, radius, gap);
            assert!((area / shallow - 1.0).abs() < depth / gap + 1e-11, "{depth:e}: {:e}", area / shallow - 1.0);
            let back = moon_depth(area * 0.01, 0.01, radius, gap).unwrap();
            assert!((back / depth - 1.0).abs() < 1e-11, "{back:e}");
            let back = flat_depth(flat_area(depth, radius) * 0.01, 0.01, radius).unwrap();
            assert!((back / depth - 1.0).abs() < 1e-13, "{back:e}");
        }
    }

    #[test]
    fn depths_go_from_none_to_the_whole_tube() {
        let [radius, gap, width, _] = TUBE;
        let whole = PI * radius * radius;
        assert!((flat_area(2.0 * radius, radius) / whole - 1.0).abs() < 1e-14);
        assert!((flat_area(radius, radius) / (0.5 * whole) - 1.0).abs() < 1e-14);
        for share in [1e-9, 1e-3, 0.3, 0.6, 0.9] {
            let round = moon_depth(share * whole * width, width, radius, gap).unwrap();
            assert!((moon_area(round, radius, gap) / (share * whole) - 1.0).abs() < 1e-10, "{share}");
            let flat = flat_depth(share * whole * width, width, radius).unwrap();
            assert!((flat_area(flat, radius) / (share * whole) - 1.0).abs() < 1e-12, "{share}");
            assert!(round < flat, "{share}: a hole bears on more of the tube");
        }
        assert_eq!(moon_depth(0.0, width, radius, gap), Some(0.0));
        assert_eq!(moon_depth(whole * width, width, radius, gap), None);
        for bad in [-1.0, f64::NAN] {
            assert_eq!((flat_depth(bad, width, radius), moon_depth(1e-9, width, radius, bad)), (None, None));
        }
    }
}
