//! A body that has come to rest stays at rest.

use crate::common::{self, INTEGRATORS, MOREAU_JEAN, schemes, spring};
use crate::random_structures::Draws;
use signorini::linear::Symmetric;
use signorini::{Chain, Integrator, Load, Options, Row, Scene, Scheme, Stepper, Structure, Wall, equilibrium, run};

/// Bounds of a motion over many steps, and the number of contact episodes that ended.
#[derive(Debug)]
struct Bounds {
    least: f64,
    most: f64,
    speed: f64,
    ended: u64,
    pushed: f64,
}

fn bounds(scene: &Scene, scheme: &Scheme, h: f64, steps: u32) -> Bounds {
    let mut stepper = Stepper::new(scene, scheme, h).expect("a sound scene");
    let mut b = Bounds { least: f64::INFINITY, most: f64::NEG_INFINITY, speed: 0.0, ended: 0, pushed: 0.0 };
    for _ in 0..steps {
        let step = stepper.step().expect("a step");
        b.least = b.least.min(step.q[0]);
        b.most = b.most.max(step.q[0]);
        b.speed = b.speed.max(step.v[0].abs());
        b.ended += step.closed.len() as u64;
        b.pushed += step.impulse.iter().sum::<f64>();
    }
    b
}

#[test]
fn a_body_at_rest_on_a_wall_neither_creeps_nor_buzzes_in_a_million_steps() {
    const STEPS: u32 = 1_000_000;
    let rigid = [
        Scheme::ImplicitEuler,
        Scheme::PaoliSchatzman,
        MOREAU_JEAN,
        Scheme::MoreauJean { theta: 1.0 },
        Scheme::Newmark,
    ];
    for e in [0.0, 1e-6, 1.0] {
        for h in [1e-2, 1e-4] {
            // A floor at 0, and one at a place that is no short binary number, under a ball with a
            // spring and a damper.
            let sprung = Scene::oscillator(0.7, 0.3, 11.0)
                .with_wall(Wall::lower("floor", 0.1).with_restitution(e))
                .with_load(Load::constant(-9.81))
                .with_initial(&[0.1], &[0.0]);
            for (scene, floor, weight) in [(common::ball(0.0, e), 0.0, 9.81), (sprung, 0.1, 9.81 + 1.1)] {
                for scheme in rigid {
                    let b = bounds(&scene, &scheme, h, STEPS);
                    let what = format!("{scheme}, e = {e}, h = {h}, floor at {floor}: {b:?}");
                    assert!((b.least - floor).abs() <= 1e-15 && (b.most - floor).abs() <= 1e-15, "{what}");
                    // One ulp of the position over a step at most.
                    assert!(b.speed <= 2e-17 / h && b.ended == 0, "{what}");
                    // Every newton second of the weight is carried (a staggered or position-level
                    // rule starts within half a step).
                    let carried = b.pushed / (weight * h * f64::from(STEPS));
                    assert!((carried - 1.0).abs() <= 1.0 / f64::from(STEPS), "{what}: carried {carried}");
                }
            }
        }
    }
}

#[test]
fn a_body_at_rest_in_a_penalty_wall_stays_where_the_wall_carries_it() {
    let weight = 9.81;
    for stiffness in [1e4, 1e8] {
        for integrator in INTEGRATORS {
            let depth = weight / stiffness;
            let scene = common::ball(0.0, 1.0).with_initial(&[0.0], &[0.0]);
            // The spring stands where the rigid floor does: the body may start behind the floor in
            // the penalised scene only.
            let scheme = spring(stiffness, integrator);
            let settled = scene.penalised(match scheme {
                Scheme::Penalty { law, .. } => law,
                _ => continue,
            });
            let settled = settled.expect("a sound scene").with_initial(&[-depth], &[0.0]);
            for h in [1e-2, 1e-4] {
                if integrator == Integrator::CentralDifference && h * h * stiffness > 4.0 {
                    continue;
                }
                let b = bounds(&settled, &scheme, h, 1_000_000);
                let what = format!("{scheme}, h = {h}: {b:?}");
                // Rounding of the force, 1e-15 N, accelerates to 1e-15 m/s in a second.
                assert!((b.least / depth + 1.0).abs() < 1e-9 && (b.most / depth + 1.0).abs() < 1e-9, "{what}");
                assert!(b.speed < 1e-9 && b.ended == 0, "{what}");
            }
        }
    }
}

#[test]
fn a_bouncing_ball_comes_to_rest_and_stays() {
    // Exact rest at √(2h/g)(1 + e)/(1 − e), with h = 0.1 m and e = ½: 0.428 s.
    for scheme in [Scheme::ImplicitEuler, Scheme::PaoliSchatzman, MOREAU_JEAN, Scheme::MoreauJean { theta: 1.0 }] {
        for h in [1e-3, 1e-4] {
            let mut stepper = Stepper::new(&common::ball(0.1, 0.5), &scheme, h).expect("a sound scene");
            while stepper.time() < 0.5 {
                stepper.step().expect("a step");
            }
            let rest = stepper.state();
            // Within the height a step of gravity makes, and at no speed beyond it.
            assert!(rest.q[0].abs() < 10.0 * 9.81 * h * h && rest.v[0].abs() < 10.0 * h, "{scheme}, h = {h}: {rest:?}");
            let (mut least, mut most, mut episodes) = (f64::INFINITY, f64::NEG_INFINITY, 0);
            for _ in 0..100_000 {
                let step = stepper.step().expect("a step");
                least = least.min(step.q[0]);
                most = most.max(step.q[0]);
                episodes += step.closed.len();
            }
            println!("{scheme} {h}: {:e} {episodes} open {:?}", most - least, stepper.open_contacts());
            assert!(
                most - least < 9.81 * h * h && episodes <= 1,
                "{scheme}, h = {h}: {least:e} … {most:e}, {episodes}"
            );
        }
    }
}

#[test]
fn a_wall_touched_at_the_start_with_outward_velocity_is_not_felt() {
    for scheme in schemes() {
        for (wall, v) in [(Wall::upper("wall", 0.3), -0.5), (Wall::lower("wall", 0.3), 0.5)] {
            for wall in [wall.clone().with_restitution(0.5), wall.with_elasticity(1e5, 10.0)] {
                let free = Scene::oscillator(1.0, 0.1, 2.0).with_initial(&[0.3], &[v]);
                let held = free.clone().with_wall(wall);
                let (mut a, mut b) = (
                    Stepper::new(&free, &scheme, 1e-3).expect("sound"),
                    Stepper::new(&held, &scheme, 1e-3).expect("sound"),
                );
                for i in 0..200 {
                    let (free, held) = (a.step().expect("a step"), b.step().expect("a step"));
                    assert_eq!((free.q, free.v), (held.q, held.v), "{scheme}, step {i}");
                    assert_eq!(held.impulse, [0.0], "{scheme}, step {i}");
                }
            }
        }
    }
}

#[test]
fn a_body_that_grazes_a_wall_at_rest_there_goes_its_way() {
    // Starts at the wall with no velocity, drawn off it by the spring: no force, and none that
    // pulls.
    for scheme in schemes() {
        let scene =
            Scene::oscillator(1.0, 0.0, 100.0).with_wall(Wall::upper("wall", 0.01)).with_initial(&[0.01], &[0.0]);
        let b = bounds(&scene, &scheme, 1e-4, 5000);
        // It comes back after 0.628 s, not in this half second.
        assert!(b.pushed.abs() < 1e-12 && b.most <= 0.01 && (b.least + 0.01).abs() < 2e-5, "{scheme}: {b:?}");
    }
}

#[test]
fn a_body_struck_at_rest_on_a_wall_rebounds_like_one_that_arrives() {
    // A blow of −1 N s on 1 kg that a floor with e carries: the wall answers 1 m/s with e m/s, in
    // every scheme that honours e. Between there are gravity's h g of speed for the schemes on a
    // grid.
    let h = 1e-4;
    for e in [0.0, 0.5, 1.0] {
        for time in [0.05, 0.05003, 0.05005] {
            let scene = Scene::oscillator(1.0, 0.0, 0.0)
                .with_wall(Wall::lower("floor", 0.0).with_restitution(e))
                .with_load(Load::constant(-9.81))
                .with_load(Load::impulse(-1.0, time))
                .with_duration(0.08);
            for scheme in [Scheme::Event, MOREAU_JEAN, Scheme::MoreauJean { theta: 1.0 }, Scheme::PaoliSchatzman] {
                let run = run(&scene, &scheme, &Options::with_step(h)).expect("a run");
                let v = run.trajectory.velocity().last().copied().expect("rows");
                let expected = if e == 0.0 { 0.0 } else { e - 9.81 * (0.08 - time) };
                assert!(
                    (v - expected).abs() < 3.0 * 9.81 * h,
                    "{scheme}, e = {e}, blow at {time} s: {v} m/s, not {expected}"
                );
                // The contract holds in the step of the blow as in any other.
                assert!(run.residuals.complementarity < 1e-12, "{scheme}: {:?}", run.residuals);
                let hit = run.trajectory.contacts().iter().map(|c| c.approach_speed).fold(0.0, f64::max);
                assert!(
                    scheme == Scheme::Event || e == 0.0 || (hit - 1.0).abs() < 1e-9,
                    "{scheme}, e = {e}: approach {hit} m/s"
                );
            }
        }
    }
}

#[test]
fn a_mass_pressed_on_a_stop_rests_under_the_static_force_in_every_scheme() {
    // 35 N against a spring of 1e4 N/m, the stop at 1 mm: it holds 25 N. Started there, and at 0,
    // from where it lands.
    let scene = |start: f64| {
        Scene::oscillator(1.0, 20.0, 1e4)
            .with_wall(Wall::upper("stop", 1e-3).with_restitution(0.0))
            .with_load(Load::constant(35.0))
            .with_initial(&[start], &[0.0])
            .with_duration(4.0)
    };
    let rigid = [
        Scheme::ImplicitEuler,
        Scheme::PaoliSchatzman,
        MOREAU_JEAN,
        Scheme::MoreauJean { theta: 1.0 },
        Scheme::GeneralizedAlpha { rho: 0.8 },
        Scheme::GeneralizedAlpha { rho: 0.0 },
    ];
    for scheme in rigid {
        for h in [2e-2, 2e-3, 1e-3] {
            for start in [1e-3, 0.0] {
                let run = run(&scene(start), &scheme, &Options::with_step(h)).expect("a run");
                let force = -run.trajectory.contact_force("stop").expect("a wall").last().copied().expect("rows");
                let depth = run.trajectory.displacement().last().copied().expect("rows") - 1e-3;
                // Rounding of 35 N, of which moreau-jean's place takes k times its depth.
                assert!((force + 1e4 * depth - 25.0).abs() < 1e-9, "{scheme}, h = {h}: {force} N at {depth} m");
                let lands = matches!(scheme, Scheme::MoreauJean { .. }) && start == 0.0;
                assert!(lands || depth.abs() < 1e-15, "{scheme}, h = {h}: {depth} m");
                // Where it lands deep behind the stop, a note reports it.
                let said = run.notes.iter().any(|note| note.contains("behind wall \"stop\""));
                assert_eq!(said, depth > 1e-5, "{scheme}, h = {h}, {depth} m: {:?}", run.notes);
                // What the wall gave from the first row to the last is what the force was in all
                // that time, from rest.
                if start > 0.0 {
                    let impulse = -run.trajectory.impulse("stop").expect("a wall");
                    // The force at t = 0 counts where a scheme knows it; a step of rounding
                    // otherwise.
                    assert!((impulse - 100.0).abs() < 1e-9, "{scheme}, h = {h}: {impulse} N s");
                }
            }
        }
    }
}

#[test]
fn two_bodies_without_a_ground_stand_against_a_wall_with_the_spring_between_them() {
    // 7 N press the first of two bodies, 20 N/m apart, towards a wall of the second, or a pad of
    // it.
    for (wall, place, side) in [
        (Wall::upper("stop", 0.5), 0.5, 1.0),
        (Wall::lower("stop", -0.5), -0.5, -1.0),
        (Wall::upper("pad", 0.5).with_elasticity(10.0, 0.0), 1.2, 1.0),
    ] {
        for (m, scale) in [(1.0, 1.0), (300.0, 1e-3)] {
            let k = Symmetric::from_entries(2, [(0, 0, 20.0), (1, 0, -20.0), (1, 1, 20.0)]);
            let structure =
                Structure { mass: Symmetric::diagonal(&[m, 2.0 * m]), damping: Symmetric::zeros(2), stiffness: k };
            let mut scene = Scene::structure(structure)
                .with_wall(wall.clone().at(Row::dof(1)).with_position(scale * wall.position()))
                .with_load(Load { at: Row::dof(0), ..Load::constant(scale * side * 7.0) });
            scene = scene.with_initial(&[0.0; 2], &[0.0; 2]);
            let q = equilibrium(&scene).expect("a rest");
            let expected = [scale * (place + side * 0.35), scale * place];
            // Without a ground each programme moves the bodies by a part of what is left: they end
            // when it is 1e-13, at rates of 1e-4 and less of the slowest motion.
            assert!(
                q.iter().zip(expected).all(|(q, e)| (q - e).abs() < 1e-7 * scale),
                "{wall:?}, {m} kg: {q:?}, not {expected:?}"
            );
        }
    }
}

/// Schemes by which a body rests exactly on a rigid wall.
fn exact_at_rest() -> impl Iterator<Item = Scheme> {
    common::CONSTRAINED.into_iter().chain([Scheme::Event, Scheme::Located])
}

/// Fails unless the scene, all of whose walls stand at 0, has its equilibrium there and stays in it
/// by every scheme. Its loads alone move it by `way` (m) within the run.
fn stays(mut scene: Scene, way: f64, what: &str) {
    let q = equilibrium(&scene).expect("a rest");
    assert!(q.iter().all(|q| *q == 0.0), "{what}: {q:?}");
    scene = scene.with_initial(&q, &vec![0.0; q.len()]);
    assert_eq!(scene.validate(), Ok(()), "{what}");
    for scheme in exact_at_rest() {
        let found = run(&scene, &scheme, &Options::with_step(1e-3)).expect("a run");
        assert_eq!(found.findings, [], "{what}, {scheme}: {:?}", found.residuals);
        let farthest = found.trajectory.displacements().iter().flatten().fold(0.0_f64, |most, q| most.max(q.abs()));
        assert!(farthest <= 1e-12 * way, "{what}, {scheme}: {farthest:e} m");
    }
}

#[test]
fn a_stack_on_a_floor_at_0_is_at_rest_at_0() {
    for seed in 0..40 {
        let mut draws = Draws::new(seed);
        let n = 1 + seed as usize % 3;
        let masses: Vec<f64> = (0..n).map(|_| draws.between(0.3, 3.0)).collect();
        // Free, or between springs, of which some are stiff.
        let spring = |draws: &mut Draws| 10f64.powf(draws.between(1.0, 7.0));
        let springs: Vec<f64> = (1..n).map(|_| if seed % 2 == 0 { 0.0 } else { spring(&mut draws) }).collect();
        let ground = if seed % 4 < 2 { 0.0 } else { spring(&mut draws) };
        let chain = Chain { masses: masses.clone(), springs, grounds: [ground, 0.0] };
        let mut scene = Scene::structure(chain.structure().expect("a chain")).with_duration(0.02);
        for (i, m) in masses.iter().enumerate() {
            let on_the_last = i > 0 && draws.between(0.0, 1.0) < 0.7;
            let row = if on_the_last { Row::new(vec![(i, 1.0), (i - 1, -1.0)]) } else { Row::dof(i) };
            scene = scene.with_wall(Wall::lower(&format!("w{i}"), 0.0).with_restitution(0.5).at(row));
            scene = scene.with_load(Load { at: Row::dof(i), ..Load::constant(-9.81 * m) });
        }
        stays(scene, 0.5 * 9.81 * 0.02 * 0.02, &format!("seed {seed}, {masses:?}"));
    }
}

#[test]
fn a_body_pressed_into_a_corner_of_flats_without_gaps_is_at_rest_at_0() {
    for seed in 0..40 {
        let mut draws = Draws::new(seed);
        let (first, corner) = (draws.between(0.0, 360.0), draws.between(20.0, 160.0));
        let (k, force) = ([0.0, 100.0][seed as usize % 2], draws.between(0.1, 5.0));
        let towards = |degrees: f64| degrees.to_radians().sin_cos();
        let row = |degrees: f64| Row::new(vec![(0, towards(degrees).1), (1, towards(degrees).0)]);
        let identity = |x: f64| Symmetric::diagonal(&[x, x]);
        let structure = Structure { mass: identity(1.0), damping: identity(0.1), stiffness: identity(k) };
        let load = Load { at: row(first + corner * draws.between(0.1, 0.9)), ..Load::constant(force) };
        let scene = Scene::structure(structure)
            .with_wall(Wall::upper("one", 0.0).with_restitution(0.5).at(row(first)))
            .with_wall(Wall::upper("two", 0.0).with_restitution(0.5).at(row(first + corner)))
            .with_load(load)
            .with_duration(0.02);
        stays(scene, 0.5 * force * 0.02 * 0.02, &format!("seed {seed}, {first} and {corner} deg"));
    }
}
