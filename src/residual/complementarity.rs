//! What contact laws demand of a wall's force, from the positions and velocities of a step.

use crate::scene::{Scene, Side, Wall, WallLaw};
use crate::step::{Bound, Law, Path};

/// γ of a rigid wall at the bound that the scheme promises, from the displacements at both ends of
/// a step and the velocity after its blows.
pub(super) fn slack(
    scene: &Scene,
    index: usize,
    (bound, path): (Bound, Path<'_>),
    h: f64,
    (w0, w1): (f64, f64),
    struck: f64,
) -> f64 {
    let wall = &scene.walls[index];
    let Bound::Reflected = bound else { return wall.gap(w1) };
    let back = w0 - h * struck;
    let e = match path {
        Path::OneRestitution => least_restitution(scene),
        _ => shared_restitution(scene, wall, back),
    };
    let e = e.or(wall.law.restitution()).unwrap_or(0.0);
    wall.side().sign() * ((w1 - wall.position()) + e * (back - wall.position()))
}

/// The speed of rebound of a rigid wall, m/s, from the velocities after the step's blows and after
/// the step, with the restitution e.
pub(super) fn rebound(wall: &Wall, e: f64, struck: f64, after: f64) -> f64 {
    let sign = wall.side().sign();
    let epsilon = if sign * struck <= 0.0 { e } else { 1.0 };
    sign * (after + epsilon * struck)
}

/// The smallest restitution of all rigid walls.
fn least_restitution(scene: &Scene) -> Option<f64> {
    scene.walls.iter().filter_map(|wall| wall.law.restitution()).reduce(f64::min)
}

/// The smallest restitution of the rigid walls on the row of `wall`, if with each its own the
/// bounds (1+e)g − e w⁻ would cross.
fn shared_restitution(scene: &Scene, wall: &Wall, back: f64) -> Option<f64> {
    let (mut lo, mut hi, mut least) = (f64::NEG_INFINITY, f64::INFINITY, 1.0_f64);
    for other in scene.walls.iter().filter(|other| other.row() == wall.row()) {
        let Some(e) = other.law.restitution() else { continue };
        let bound = (1.0 + e) * other.position() - e * back;
        (lo, hi) = if other.side() == Side::Upper { (lo, hi.min(bound)) } else { (lo.max(bound), hi) };
        least = least.min(e);
    }
    (lo > hi).then_some(least)
}

/// The relative change of the depth from which on ΔU/Δs is a quotient.
const MUCH: f64 = 1e-3;

/// |r| of an elastic or penalised wall as the scheme promises it for a step.
pub(super) fn expected_pressure(
    wall: &Wall,
    at: Law,
    h: f64,
    (w0, w1): (f64, f64),
    (before, after): (f64, f64),
) -> f64 {
    let (s0, s1) = (-wall.gap(w0), -wall.gap(w1));
    let law = &wall.law;
    let (k, c) = law.spring().map_or((0.0, 0.0), |spring| (spring.stiffness, spring.damping));
    let damped = |elastic: f64, rate: f64| elastic + law.dashpot(elastic) * rate;
    let rate = (s1.max(0.0) - s0.max(0.0)) / h;
    let pressure = match at {
        Law::Depth(theta) => {
            let depth = (1.0 - theta) * s0 + theta * s1;
            k * depth + c * (depth - s0.max(0.0)) / (theta * h)
        }
        Law::MeanDepth(b) => {
            let back = -wall.gap(w0 - h * before);
            k * (b * back + (1.0 - 2.0 * b) * s0 + b * s1) + 0.5 * c * (s1 - back.max(0.0)) / h
        }
        Law::Ends(theta) => damped((1.0 - theta) * law.pressure(s0, 0.0) + theta * law.pressure(s1, 0.0), rate),
        Law::Start if s0 <= 0.0 => 0.0,
        Law::Start => damped(law.pressure(s0, 0.0), -wall.side().sign() * 0.5 * (before + after)),
        Law::Gradient => damped(mean_pressure(law, s0, s1), rate),
        Law::Throughout => 0.0,
    };
    pressure.max(0.0)
}

/// The mean of |r|(s) over depths from `s0` to `s1`, which is ΔU/Δs: where the depth changes much,
/// by that quotient; else by Simpson's rule, which is exact for cubic polynomials, and off by 1e-12
/// for other powers.
pub(super) fn mean_pressure(law: &WallLaw, s0: f64, s1: f64) -> f64 {
    let (a, b) = (s0.max(0.0), s1.max(0.0));
    if a == 0.0 && b == 0.0 {
        return 0.0;
    }
    let p = |s: f64| law.pressure(s, 0.0);
    let quotient = !law.is_cubic() && (b - a).abs() > MUCH * a.max(b);
    let mean =
        if quotient { (law.energy(b) - law.energy(a)) / (b - a) } else { (p(a) + 4.0 * p(0.5 * (a + b)) + p(b)) / 6.0 };
    // Both depths are ≥ 0: the whole way is inside the wall.
    if a == s0 && b == s1 { mean } else { mean * (b - a) / (s1 - s0) }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn at_its_face_a_damped_wall_does_not_push_yet() {
        // The law at the step's start holds while s > 0.
        let wall = Wall::upper("pad", 1.0).with_elasticity(8.0, 4.0);
        let at = |w0: f64| expected_pressure(&wall, Law::Start, 0.5, (w0, 2.0), (1.0, 3.0));
        // 8 N/m times 0.25 m, and 4 N s/m times the mean of 1 and 3 m/s.
        assert_eq!([0.75, 1.0, 1.25].map(at), [0.0, 0.0, 10.0]);
    }

    #[test]
    fn the_mean_pressure_of_a_spring_is_its_energy_over_the_depth() {
        let spring = WallLaw::Elastic { stiffness: 8.0, damping: 0.0 };
        // Outside the wall, also at rest there, where ΔU/Δs is 0/0; half inside; all inside; at
        // rest inside, where the mean is the pressure. All values are exact in binary.
        for (s0, s1, mean) in [
            (-1.0, -2.0, 0.0),
            (-1.0, -1.0, 0.0),
            (-1.0, 0.0, 0.0),
            (0.0, 0.0, 0.0),
            (-1.0, 1.0, 0.5 * 8.0 / 2.0),
            (1.0, -3.0, 0.5 * 8.0 / 4.0),
            (1.0, 2.0, 0.5 * 8.0 * (4.0 - 1.0)),
            (2.0, 2.0, 8.0 * 2.0),
        ] {
            // Simpson's sum divides by 6: one rounding, and one more of the division by Δs.
            let found = mean_pressure(&spring, s0, s1);
            assert!((found - mean).abs() <= 2.0 * f64::EPSILON * mean, "{s0}, {s1}: {found}, expected {mean}");
        }
        let quartic = WallLaw::Quartic { epsilon: 2.0, span: 1.0 };
        for (s0, s1) in [(-1.0, 1.0), (0.5, 2.0), (3.0, -0.25)] {
            let mean = (quartic.energy(s1) - quartic.energy(s0)) / (s1 - s0);
            let found = mean_pressure(&quartic, s0, s1);
            assert!((found - mean).abs() <= 8.0 * f64::EPSILON * mean, "{s0}, {s1}: {found}, expected {mean}");
        }
    }
}
