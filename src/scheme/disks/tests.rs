//! Steps in round holes by each scheme, judged by closed forms, by the same scene turned or without
//! what cannot matter, and by the scheme between walls.

mod alpha;
mod blows;

use crate::linear::Symmetric;
use crate::scene::{Load, PlaneRows, Row, Scene, Structure, Wall};
use crate::scheme::{Integrator, PenaltyLaw, Scheme, Stepper};
use crate::step::Step;

const MOREAU_JEAN: Scheme = Scheme::MoreauJean { theta: 0.5 };

/// A structure of these masses (kg) and dampers (N s/m) without springs.
fn masses(mass: &[f64], damping: &[f64]) -> Scene {
    let [mass, damping] = [mass, damping].map(Symmetric::diagonal);
    let stiffness = Symmetric::zeros(mass.size());
    Scene::structure(Structure { mass, damping, stiffness })
}

/// A rigid hole about the first two degrees of freedom.
fn hole(gap: f64, restitution: f64) -> Wall {
    Wall::round("hole", PlaneRows { y: Row::dof(0), z: Row::dof(1) }, gap).with_restitution(restitution)
}

/// A ring that is out of reach, for which moreau-jean is stepped by other code.
fn ring() -> Wall {
    Wall { name: "ring".to_owned(), ..hole(1.0, 0.0).with_elasticity(1e3, 0.0) }
}

/// The scene with these round walls.
fn with(scene: Scene, holes: &[Wall]) -> Scene {
    holes.iter().cloned().fold(scene, Scene::with_wall)
}

/// A force in y and z.
fn pushed(scene: Scene, kind: &Load, [y, z]: [f64; 2]) -> Scene {
    scene.with_load(Load { at: Row::new(vec![(0, y), (1, z)]), ..kind.clone() })
}

/// The schemes, and the supports beside the hole that they need.
fn schemes() -> [(Scheme, Vec<Wall>); 5] {
    let law = PenaltyLaw::Linear { stiffness: 1e5, damping: 1.0 };
    [
        (MOREAU_JEAN, vec![]),
        (MOREAU_JEAN, vec![ring()]),
        (Scheme::ImplicitEuler, vec![]),
        (Scheme::GeneralizedAlpha { rho: 0.8 }, vec![]),
        (Scheme::Penalty { law, integrator: Integrator::DiscreteGradient }, vec![]),
    ]
}

/// `steps` steps, each shown to `observe`.
fn follow(scene: &Scene, scheme: &Scheme, h: f64, steps: u64, mut observe: impl FnMut(u64, &Step<'_>)) -> Stepper {
    let mut stepper = Stepper::new(scene, scheme, h).expect("a scene");
    (1..=steps).for_each(|number| observe(number, &stepper.step().expect("a step")));
    stepper
}

#[test]
fn the_largest_turn_of_a_normal_is_the_angle_that_a_sliding_body_covers_in_a_step() {
    let (gap, speed, h) = (1e-3, 0.1, 1e-5);
    for (scheme, beside) in schemes() {
        for angle in [0.1, 0.8, 2.4, 3.9] {
            let (c, s) = (f64::cos(angle), f64::sin(angle));
            let supports = [&[hole(gap, 0.0)], &beside[..]].concat();
            let scene = with(masses(&[1.0; 2], &[0.0; 2]), &supports)
                .with_initial(&[gap * c, gap * s], &[-speed * s, speed * c]);
            let stepper = follow(&scene, &scheme, h, 5, |_, _| ());
            let turn = stepper.counters().largest_turn_rad;
            // Schemes take the normal at different times, half of 1e-3 rad apart, and the spring of
            // the penalty takes a while to turn the body.
            assert!((turn / (h * speed / gap) - 1.0).abs() < 1e-2, "{scheme}, {angle}: {turn}");
        }
    }
}

#[test]
fn a_mass_that_rests_at_a_wall_is_held_from_the_first_step_with_the_force_of_its_load() {
    let (h, load) = (1e-3, 5.0);
    for (scheme, beside) in schemes().into_iter().filter(|(scheme, _)| !matches!(scheme, Scheme::Penalty { .. })) {
        for wall in [Wall::upper("wall", 1e-3), Wall::lower("wall", -1e-3)] {
            let place = wall.position();
            let sign = place.signum();
            let wall = wall.with_restitution(0.5).at(Row::dof(0));
            let supports = [&[hole(1.0, 0.0)], &beside[..]].concat();
            let scene = with(masses(&[1.0; 2], &[0.0; 2]), &supports).with_wall(wall);
            let scene = pushed(scene, &Load::constant(load), [sign, 0.0]).with_initial(&[place, 0.0], &[0.0; 2]);
            follow(&scene, &scheme, h, 5, |number, step| {
                let p = step.impulse[supports.len()];
                // generalized-alpha starts with the acceleration of the free mass.
                let alpha = matches!(scheme, Scheme::GeneralizedAlpha { .. });
                assert!(
                    p * sign < 0.0 && (alpha || (p.abs() / (h * load) - 1.0).abs() < 1e-9),
                    "{scheme}: {number}, {p}"
                );
                assert!(
                    (step.q[0] - place).abs() < 1e-15 && step.v[0].abs() < 1e-12,
                    "{scheme}: {number}, {:?}",
                    step.q
                );
            });
        }
    }
}

#[test]
fn programmes_that_need_clarabel_are_counted_with_its_iterations() {
    let mut state = 1_u64;
    let mut draw = |low: f64, high: f64| {
        state += 1;
        low + (high - low) * crate::hash::unit(crate::hash::mix(23, 0, state))
    };
    let (mut asked, mut free) = (0, 0);
    for number in 0..300 {
        // Many holes and walls that depend on three degrees of freedom, thrown far out of them.
        let mut row = || Row::new((0..3).map(|i| (i, draw(-1.0, 1.0))).collect());
        let places: Vec<[Row; 3]> = (0..7).map(|_| [row(), row(), row()]).collect();
        let mut scene = masses(&[1.0, 2.0, 0.7], &[0.0; 3]);
        for (k, [y, z, other]) in places.into_iter().enumerate() {
            let (gap, angle) = (draw(0.1, 2.0), draw(0.0, 6.3));
            let off = gap * draw(0.0, 0.99);
            let (name, centre) = (format!("hole-{k}"), [off * angle.cos(), off * angle.sin()]);
            scene =
                scene.with_wall(Wall::round(&name, PlaneRows { y, z }, gap).with_centre(centre).with_restitution(0.0));
            scene.walls.push(Wall::upper(&format!("wall-{k}"), draw(0.05, 2.0)).at(other));
        }
        let far = if number % 10 == 0 { 1e-3 } else { 10.0 };
        let v: Vec<f64> = (0..3).map(|_| far * draw(-1.0, 1.0)).collect();
        let scene = scene.with_initial(&[0.0; 3], &v);
        let mut pushing = 0;
        let stepper = follow(&scene, &Scheme::ImplicitEuler, 1.0, 2, |_, step| {
            let force = step.impulse.iter().any(|p| *p != 0.0);
            pushing += u64::from(force);
        });
        let counters = stepper.counters();
        // A programme whose free motion violates a bound has a force.
        assert_eq!(counters.qp_solves, pushing, "{number}");
        let (fallbacks, iterations) = (counters.qp_fallbacks, counters.interior_point_iterations);
        assert!(fallbacks <= 2 && (3 * fallbacks..200 * fallbacks + 1).contains(&iterations), "{number}: {counters:?}");
        asked += fallbacks;
        free += 2 - pushing;
    }
    assert!(asked > 0 && free > 10, "{asked} {free}");
}
