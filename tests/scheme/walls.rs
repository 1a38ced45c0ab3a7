//! The laws of the walls, against closed forms and one another.

use signorini::{Scene, Wall, WallLaw};

/// Laws with the energy (J), the pressure (N) and the tangent (N/m) at a depth of 2 m, computed by
/// hand.
///
/// Of the φ² penalty with a span of 3 m and ε = 5 m³/N: φ = 2 · 5 = 10, φ' = 2s + span = 7, so that
/// U = φ²/2ε = 10, |r| = φφ'/ε = 14 and ∂|r|/∂s = (φ'² + 2φ)/ε = 69/5.
fn laws() -> [(WallLaw, [f64; 3]); 3] {
    [
        (WallLaw::Rigid { restitution: 0.5 }, [0.0, 0.0, 0.0]),
        (WallLaw::Elastic { stiffness: 7.0, damping: 0.0 }, [14.0, 14.0, 7.0]),
        (WallLaw::Quartic { epsilon: 5.0, span: 3.0 }, [10.0, 14.0, 13.8]),
    ]
}

#[test]
fn each_law_has_the_energy_the_force_and_the_stiffness_of_its_formula() {
    for (law, expected) in laws() {
        // A few products and one quotient.
        for (found, expected) in [law.energy(2.0), law.pressure(2.0, 0.0), law.tangent(2.0)].into_iter().zip(expected) {
            assert!((found - expected).abs() <= 8.0 * f64::EPSILON * expected, "{law:?}: {found}, not {expected}");
        }
    }
}

#[test]
fn the_force_is_the_slope_of_the_energy_and_the_stiffness_that_of_the_force() {
    let quartic = WallLaw::Quartic { epsilon: 0.3, span: 0.7 };
    for law in [quartic, WallLaw::Elastic { stiffness: 7.0, damping: 0.0 }] {
        for s in [1e-3, 0.1, 1.0, 4.0] {
            let d = 1e-4 * s;
            let slope = |f: &dyn Fn(f64) -> f64| (f(s + d) - f(s - d)) / (2.0 * d);
            let near = |found: f64, expected: f64| {
                // The third derivative of a polynomial of degree four, times d²; and rounding over
                // d.
                assert!((found / expected - 1.0).abs() < 1e-7, "{law:?} at {s}: {found}, not {expected}");
            };
            near(slope(&|s| law.energy(s)), law.pressure(s, 0.0));
            near(slope(&|s| law.pressure(s, 0.0)), law.tangent(s));
        }
    }
    // At the wall the penalty is a spring of span²/ε.
    assert!((quartic.tangent(1e-12) / (0.7 * 0.7 / 0.3) - 1.0).abs() < 1e-10);
}

#[test]
fn before_a_wall_and_at_its_face_nothing_pushes() {
    for (law, _) in laws() {
        for s in [0.0, -1e-300, -2.0] {
            assert_eq!((law.energy(s), law.pressure(s, 0.0), law.tangent(s)), (0.0, 0.0, 0.0), "{law:?}");
        }
    }
    // Nor does a dashpot that the body has not reached.
    assert_eq!(WallLaw::Elastic { stiffness: 7.0, damping: 2.0 }.pressure(0.0, 9.0), 0.0);
}

#[test]
fn a_wall_pushes_out_by_spring_and_dashpot_and_never_pulls() {
    for (wall, sign) in [(Wall::upper("upper", 3.0), 1.0), (Wall::lower("lower", -3.0), -1.0)] {
        let wall = wall.with_elasticity(10.0, 4.0);
        // ½ m deep, at rest, on the way in and on the way out at ½ m/s, and out faster than the
        // spring follows.
        for (speed, force) in [(0.0, 5.0), (0.5, 7.0), (-0.5, 3.0), (-1.25, 0.0), (-9.0, 0.0)] {
            let found = wall.law_force(sign * 3.5, sign * speed);
            assert_eq!(found, -sign * force, "{wall:?} at {speed} m/s");
        }
        assert_eq!(wall.law_force(sign * 2.5, sign), 0.0);
        assert_eq!((wall.gap(sign * 2.5), wall.gap(sign * 3.5)), (0.5, -0.5));
    }
}

#[test]
fn names_are_letters_digits_hyphens_and_underscores() {
    let check = |name: &str| Scene::oscillator(1.0, 0.0, 1.0).with_wall(Wall::upper(name, 1.0)).validate();
    for name in ["a", "Z9", "upper-left", "_", "a_b-1"] {
        check(name).unwrap_or_else(|error| panic!("{name:?}: {error}"));
    }
    for name in ["", " ", "a b", "a.b", "ü", "a,", "\n"] {
        let error = check(name).expect_err(name).to_string();
        assert!(error.contains("letters, digits, - and _"), "{name:?}: {error}");
    }
}
