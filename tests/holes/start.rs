//! Static equilibrium in round holes: closed forms, and what holds of every scene.

use crate::random_structures::Draws;
use crate::rubbing::{self, body, change_hole, hole, isotropic, load, random_scene, turned, with, with_flats};
use signorini::case::CaseFile;
use signorini::linear::Symmetric;
use signorini::{Load, Row, Scene, Stepper, Structure, equilibrium};

/// K, loads along y and z, and a mass that must not matter.
fn pressed(k: [f64; 3], force: [f64; 2]) -> Scene {
    let stiffness = Symmetric::from_entries(2, [(0, 0, k[0]), (1, 0, k[1]), (1, 1, k[2])]);
    let (mass, damping) = (Symmetric::diagonal(&[3.0, 0.7]), Symmetric::zeros(2));
    let scene = Scene::structure(Structure { mass, damping, stiffness });
    scene
        .with_load(load(Load::constant(force[0]), Row::dof(0)))
        .with_load(load(Load::constant(force[1]), Row::dof(1)))
        // Not part of the equilibrium.
        .with_load(load(Load::harmonic(5.0, 3.0, 0.2), Row::dof(1)))
}

#[test]
fn a_body_rests_on_an_offset_hole_where_the_secular_equation_says() {
    let off = hole("hole", body(), 1e-3, 0.5, 0.3).with_centre([0.3e-3, 0.1e-3]);
    let scene = with(pressed([5000.0, 800.0, 2000.0], [4.0, -7.0]), off);
    let q = equilibrium(&scene).unwrap();
    // 1e-13 of the size: what the repeated programmes leave.
    assert!((q[0] - 0.000_589_251_023_939_351_3).abs() < 1e-15, "{q:?}");
    assert!((q[1] - -0.000_857_253_281_608_392_7).abs() < 1e-15, "{q:?}");
}

#[test]
fn an_elastic_hole_yields_by_its_force_over_its_stiffness() {
    // A body of 1000 N/m pressed by 5 N towards (3, 4)/5 into a ring of 2 mm and 9000 N/m:
    // 1000 r + 9000 (r − 0.002) = 5.
    let ring = hole("ring", body(), 2e-3, 0.0, 0.0).with_elasticity(9000.0, 3.0);
    let q = equilibrium(&with(pressed([1000.0, 0.0, 1000.0], [3.0, 4.0]), ring)).unwrap();
    assert!((q[0] - 0.6 * 2.3e-3).abs() < 1e-15 && (q[1] - 0.8 * 2.3e-3).abs() < 1e-15, "{q:?}");
}

#[test]
fn a_body_without_springs_rests_in_the_hole_below_the_load() {
    let scene = with(isotropic(1.3, 0.2, 0.0), hole("hole", body(), 2e-3, 0.5, 0.0))
        .with_load(load(Load::constant(-3.0), Row::dof(0)))
        .with_load(load(Load::constant(4.0), Row::dof(1)));
    let q = equilibrium(&scene).unwrap();
    assert!((q[0] - -1.2e-3).abs() < 1e-13 && (q[1] - 1.6e-3).abs() < 1e-13, "{q:?}");
    // Between a flat at z = 1 mm and the hole: the corner.
    let q = equilibrium(&with_flats(scene, "flat", body(), &[(90.0, 1e-3)], 0.5, 0.0)).unwrap();
    assert!((q[0] - -3.0_f64.sqrt() * 1e-3).abs() < 1e-13 && (q[1] - 1e-3).abs() < 1e-15, "{q:?}");
}

#[test]
fn holes_without_a_common_point_are_named() {
    let off = hole("off", body(), 1e-3, 0.5, 0.0).with_centre([5e-3, 0.0]);
    let scene = with(with(isotropic(1.0, 0.0, 100.0), hole("here", body(), 2e-3, 0.5, 0.0)), off);
    let said = equilibrium(&scene).unwrap_err().to_string();
    assert!(said.contains("\"here\"") && said.contains("\"off\"") && said.contains("cannot be met together"), "{said}");
}

/// A random structure in holes and between flats that are off by more than their gaps, under
/// random constant loads.
fn off_centre(draws: &mut Draws) -> Scene {
    let mut scene = random_scene(draws, 0.0);
    let n = scene.initial.q.len();
    // A hole at the centre may be left without a place, with others far off.
    for support in 0..scene.supports.len() {
        if scene.supports[support].hole(&scene.walls).is_some() {
            let centre = [draws.between(-1e-4, 1e-4), draws.between(-1e-4, 1e-4)];
            change_hole(&mut scene, support, |hole| hole.with_centre(centre));
        }
    }
    for dof in 0..n {
        scene = scene.with_load(load(Load::constant(draws.between(-20.0, 20.0)), Row::dof(dof)));
    }
    scene
}

#[test]
fn whatever_presses_is_balanced_and_stays() {
    let mut draws = Draws::new(11);
    let mut held = 0;
    for case in 0..60 {
        let scene = off_centre(&mut draws);
        let Ok(q) = equilibrium(&scene) else { continue };
        // Valid as a start, with the body within all gaps.
        let rest = scene.clone().with_initial(&q, &vec![0.0; q.len()]);
        assert!(rest.validate().is_ok(), "case {case}: {:?}", rest.validate());
        // A step from there leaves it at rest: moreau-jean's forces are those of statics.
        let h = 1e-4;
        let mut stepper = Stepper::new(&rest, &rubbing::MOREAU_JEAN, h).unwrap();
        let step = stepper.step().unwrap();
        let speed = step.v.iter().fold(0.0_f64, |most, v| most.max(v.abs()));
        held += usize::from(step.normal.iter().zip(step.impulse).any(|(n, p)| *n != [0.0; 2] && *p > 0.0));
        // 20 N on masses of 0.3 kg and more would give 7e-3 m/s in a step.
        assert!(speed < 1e-9, "case {case}: {speed:e}");
    }
    assert!(held > 20, "{held}");
}

#[test]
fn a_turned_scene_rests_turned() {
    let off = hole("hole", body(), 1e-3, 0.5, 0.0).with_centre([0.3e-3, 0.1e-3]);
    let scene = with(isotropic(1.0, 0.0, 3000.0), off)
        .with_load(load(Load::constant(4.0), Row::dof(0)))
        .with_load(load(Load::constant(-7.0), Row::dof(1)));
    let q = equilibrium(&scene).unwrap();
    for degrees in [30.0_f64, 90.0, 203.0] {
        let other = equilibrium(&turned(&scene, degrees)).unwrap();
        let (sin, cos) = degrees.to_radians().sin_cos();
        let wanted = [cos * q[0] - sin * q[1], sin * q[0] + cos * q[1]];
        for (found, wanted) in other.iter().zip(wanted) {
            assert!((found - wanted).abs() < 1e-15, "{degrees}: {found} {wanted}");
        }
    }
}

/// A free steel tube of 2 m in two round holes under its weight of 17.75 N in any direction: only
/// the holes hold it, with the forces of a beam on two supports.
#[test]
fn a_free_tube_lies_in_two_holes_whatever_the_direction_of_its_weight() {
    let text = |place: f64, degrees: f64| {
        let hole = |name: &str, at: f64| {
            format!("[[support]]\nname = \"{name}\"\nat = {{ position = {at} }}\nshape = \"round\"\ngap = 1e-3\n")
        };
        format!(
            "[system]\nplanes = 2\n[system.beam]\nlength = 2.0\nyoungs_modulus = 2e11\ndensity = 8000.0\n\
             outer_diameter = 0.02\ninner_diameter = 0.016\nelements = 8\nleft = \"free\"\nright = \"free\"\n\
             {}{}[[load]]\ndirection = {degrees}\ngravity = {{ acceleration = 9.81 }}\n\
             [initial]\nequilibrium = true\n[time]\nend = 1e-3\nstep = 1e-5\n",
            hole("a", 0.5),
            hole("b", place)
        )
    };
    let weight = 8000.0 * 0.25 * std::f64::consts::PI * (0.02_f64.powi(2) - 0.016_f64.powi(2)) * 2.0 * 9.81;
    for degrees in [0.0, 90.0, 180.0, 200.0, 270.0] {
        for place in [1.2, 1.5, 1.75] {
            let case = CaseFile::from_text(&text(place, degrees), "tube.toml", "").case().unwrap();
            let mut stepper = Stepper::new(&case.scene, &rubbing::MOREAU_JEAN, 1e-5).unwrap();
            let step = stepper.step().unwrap();
            let far = weight * 0.5 / (place - 0.5);
            for (impulse, wanted) in step.impulse.iter().zip([weight - far, far]) {
                // Rounding of the displacements (1e-16 of 1 mm) times the stiffness of an element
                // (2e7 N/m), and of its factor.
                assert!((impulse / 1e-5 - wanted).abs() < 1e-6, "{degrees}°, {place} m: {:?}", step.impulse);
            }
        }
    }
}
