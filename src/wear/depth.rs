//! The depth of a scar of known volume on a tube, where it bears against a round hole, a flat or
//! another tube.
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
//!
//! Another tube of the radius R₂ beside it is a hole of the radius R_h = −R₂, for which c, x and
//! the area under the chord of the hole change their sign as well: A is the lens in which both
//! circles overlap, the sum of two segments.

use serde::{Deserialize, Serialize};
use std::f64::consts::PI;

/// What a tube bears against.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub enum Bearing {
    /// A flat.
    Flat,
    /// A round hole.
    Hole {
        /// Its radius less that of the tube, m.
        gap: f64,
    },
    /// Another tube beside it.
    Tube {
        /// Its radius, m.
        radius: f64,
    },
}

impl Bearing {
    /// Area (m²) of a tube of radius `radius` (m) that lies beyond the bearing when the tube is
    /// moved by `depth` (m) beyond touching; from 0 to twice the radius, of another tube to that of
    /// the smaller one.
    pub(super) fn area(self, depth: f64, radius: f64) -> f64 {
        match self.apart(radius) {
            None => flat_area(depth, radius),
            Some(apart) => circle_area(depth.clamp(0.0, 2.0 * self.smaller(radius)), radius, apart),
        }
    }

    /// Depth (m) at which `volume` (m³) over `width` (m) lies beyond the bearing, of a tube of
    /// radius `radius` (m); `None` where that is the whole tube or more, or a value is negative or
    /// not finite.
    pub(super) fn depth(self, volume: f64, width: f64, radius: f64) -> Option<f64> {
        let own = match self {
            Self::Flat => radius,
            Self::Hole { gap } => gap,
            Self::Tube { radius } => radius,
        };
        let sound = volume >= 0.0 && [width, radius, own].iter().all(|x| x.is_finite() && *x > 0.0);
        let half_width = |depth: f64| match self.apart(radius) {
            None => (depth * (2.0 * radius - depth)).max(0.0).sqrt(),
            Some(apart) => radius * half_angles(depth, radius, apart)[0].sin(),
        };
        let slope = |depth: f64| 2.0 * half_width(depth);
        sound.then(|| depth_of(volume / width, self.smaller(radius), |depth| self.area(depth, radius), slope)).flatten()
    }

    /// The radius of the smaller one of two tubes, m.
    fn smaller(self, radius: f64) -> f64 {
        if let Self::Tube { radius: other } = self { radius.min(other) } else { radius }
    }

    /// The distance of the centres of bearing and tube, m, where they touch: negative of another
    /// tube, whose centre lies beyond the contact; none of a flat.
    fn apart(self, radius: f64) -> Option<f64> {
        match self {
            Self::Flat => None,
            Self::Hole { gap } => Some(gap),
            Self::Tube { radius: other } => Some(-(radius + other)),
        }
    }
}

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
fn flat_area(depth: f64, radius: f64) -> f64 {
    let share = (depth / (2.0 * radius)).clamp(0.0, 1.0);
    radius * radius * segment(2.0 * share.sqrt().asin())
}

/// As [`flat_area`], beyond a circle whose centre is `apart` (m) from that of the tube where they
/// touch: the moon outside a hole, the lens within another tube.
fn circle_area(depth: f64, radius: f64, apart: f64) -> f64 {
    let [alpha, beta] = half_angles(depth, radius, apart);
    let circle = radius + apart;
    (radius * radius * segment(alpha) - circle * circle.abs() * segment(beta)).max(0.0)
}

/// α and β, half the angles under which the common chord is seen from the centres of tube and
/// circle.
fn half_angles(depth: f64, radius: f64, apart: f64) -> [f64; 2] {
    let (c, circle) = (apart + depth, radius + apart);
    let below = depth * (2.0 * radius - depth) / (2.0 * c);
    let x = circle - below;
    let h = (below * (circle + x)).max(0.0).sqrt();
    [h.atan2(x - c), h.atan2(x * circle.signum())]
}

/// Depth (m) by which `volume` (m³), taken off evenly all round a tube of radius `radius` (m) over
/// `width` (m), makes it thinner, V/(2πRL): the other extreme from a single scar.
pub(super) fn all_round(volume: f64, width: f64, radius: f64) -> f64 {
    volume / (2.0 * PI * radius * width)
}

/// The depth at which the increasing function `area` is `wanted` (m²), by Newton's method within a
/// bracket; the whole circle of radius `radius` is there at twice that.
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

    /// Radius of the tube, gap, width and volume of the reference values.
    const TUBE: [f64; 4] = [0.009_525, 0.000_2, 0.025, 3e-8];
    const HOLE: Bearing = Bearing::Hole { gap: TUBE[1] };

    #[test]
    fn a_scar_is_deeper_on_a_flat_than_in_a_hole() {
        // 30 mm³ off a tube of 19.05 mm, over 25 mm: on a flat, and in a hole wider by 0.2 mm.
        let (flat, hole) = (Bearing::Flat.depth(30e-9, 25e-3, 9.525e-3), HOLE.depth(30e-9, 25e-3, 9.525e-3));
        assert!((flat.unwrap() - 0.350e-3).abs() < 1e-6 && (hole.unwrap() - 0.109e-3).abs() < 1e-6);
    }

    #[test]
    fn the_depths_are_those_computed_with_40_digits() {
        let [radius, _, width, volume] = TUBE;
        let [round, flat] = [HOLE, Bearing::Flat].map(|bearing| bearing.depth(volume, width, radius).unwrap());
        // Some roundings of the areas, which grow with the depth to the power 1.5 and less.
        assert!((round / 0.000_109_216_051_031_080_68 - 1.0).abs() < 1e-13, "{round:e}");
        assert!((flat / 0.000_350_324_405_082_514_47 - 1.0).abs() < 1e-13, "{flat:e}");
        assert!((all_round(volume, width, radius) - volume / (2.0 * PI * radius * width)).abs() < 1e-20);
    }

    #[test]
    fn code_aster_finds_the_same_depth_in_a_hole() {
        // ZZZZ405A, T6: radii of tube and hole 1 and 2, half a width of 10, V = 1.5768e-3. Its test
        // file has 9.56453382969e-4, from an iteration that stops at 3e-7.
        let depth = Bearing::Hole { gap: 1.0 }.depth(1.5768e-3, 20.0, 1.0).unwrap();
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
            let area = HOLE.area(depth, radius);
            assert!((area / shallow - 1.0).abs() < depth / gap + 1e-11, "{depth:e}: {:e}", area / shallow - 1.0);
            let back = HOLE.depth(area * 0.01, 0.01, radius).unwrap();
            assert!((back / depth - 1.0).abs() < 1e-11, "{back:e}");
            let back = Bearing::Flat.depth(flat_area(depth, radius) * 0.01, 0.01, radius).unwrap();
            assert!((back / depth - 1.0).abs() < 1e-13, "{back:e}");
        }
    }

    #[test]
    fn depths_go_from_none_to_the_whole_tube() {
        let [radius, _, width, _] = TUBE;
        let whole = PI * radius * radius;
        assert!((flat_area(2.0 * radius, radius) / whole - 1.0).abs() < 1e-14);
        assert!((flat_area(radius, radius) / (0.5 * whole) - 1.0).abs() < 1e-14);
        for share in [1e-9, 1e-3, 0.3, 0.6, 0.9] {
            let round = HOLE.depth(share * whole * width, width, radius).unwrap();
            assert!((HOLE.area(round, radius) / (share * whole) - 1.0).abs() < 1e-10, "{share}");
            let flat = Bearing::Flat.depth(share * whole * width, width, radius).unwrap();
            assert!((flat_area(flat, radius) / (share * whole) - 1.0).abs() < 1e-12, "{share}");
            assert!(round < flat, "{share}: a hole bears on more of the tube");
        }
        assert_eq!(HOLE.depth(0.0, width, radius), Some(0.0));
        assert_eq!(HOLE.depth(whole * width, width, radius), None);
        for bad in [-1.0, f64::NAN] {
            let bearings = [Bearing::Hole { gap: bad }, Bearing::Tube { radius: bad }];
            assert_eq!(bearings.map(|bearing| bearing.depth(1e-9, width, radius)), [None, None]);
            assert_eq!(Bearing::Flat.depth(bad, width, radius), None);
        }
    }

    #[test]
    fn two_tubes_lose_the_lens_in_which_their_circles_overlap() {
        let [radius, _, width, volume] = TUBE;
        // Between equal tubes a plane halves the lens.
        let [lens, half] = [
            Bearing::Tube { radius }.depth(2.0 * volume, width, radius).unwrap(),
            Bearing::Flat.depth(volume, width, radius).unwrap(),
        ];
        assert!((lens / (2.0 * half) - 1.0).abs() < 1e-13, "{lens:e}");
        // A thinner tube: the lens by the midpoint rule over its thickness, in the angle φ of y =
        // R₂ sin φ. The thickness has corners where the circles cross: the error of the sum is of
        // the square of the spacing over the lens, at most 1e-7.
        let other = 0.006;
        for depth in [1e-5, 1e-3, 5e-3, 1.15e-2] {
            let centres = radius + other - depth;
            let thickness = |y: f64| {
                let [own, second] = [radius, other].map(|r| (r * r - y * y).max(0.0).sqrt());
                (own.min(centres + second) - (centres - second)).max(0.0)
            };
            let count = 200_000;
            let each = PI / f64::from(count);
            let strip = |k: i32| {
                let phi = (f64::from(k) + 0.5) * each - 0.5 * PI;
                thickness(other * phi.sin()) * other * phi.cos() * each
            };
            let wanted: f64 = (0..count).map(strip).sum();
            let found = Bearing::Tube { radius: other }.area(depth, radius);
            assert!((found / wanted - 1.0).abs() < 1e-7, "{depth}: {found:e} {wanted:e}");
            let back = Bearing::Tube { radius: other }.depth(found * width, width, radius).unwrap();
            assert!((back / depth - 1.0).abs() < 1e-11, "{back:e}");
            let swapped = Bearing::Tube { radius }.area(depth, other);
            assert!((swapped / found - 1.0).abs() < 1e-11, "the same lens of both: {swapped:e}");
        }
        assert_eq!(Bearing::Tube { radius: other }.depth(PI * other * other * width, width, radius), None);
    }
}
