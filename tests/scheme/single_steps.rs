//! Single steps of the schemes on a grid, against the equations that they solve: each quantity is
//! computed here from the data of the step, or in closed form.

use crate::common::{CONSTRAINED, INTEGRATORS, MOREAU_JEAN, spring};
use crate::random_structures::{self, at, on};
use signorini::linear::Symmetric;
use signorini::qp::Backend;
use signorini::{Integrator, Load, Method, Options, Path, PenaltyLaw, Row, Scene, Scheme, Stepper, Wall, run};

const GENERALIZED_ALPHA: Scheme = Scheme::GeneralizedAlpha { rho: 0.8 };

/// The schemes that constrain by a QP, but for `located`, whose steps are parts.
fn whole_steps() -> impl Iterator<Item = Scheme> {
    CONSTRAINED.into_iter().filter(|scheme| *scheme != Scheme::Located).chain([GENERALIZED_ALPHA])
}

/// The schemes whose first step depends on the acceleration at the start.
fn with_memory() -> [Scheme; 4] {
    [Scheme::PaoliSchatzman, Scheme::Newmark, GENERALIZED_ALPHA, spring(1e4, Integrator::CentralDifference)]
}

fn stepper(scene: &Scene, scheme: &Scheme, h: f64) -> Stepper {
    Stepper::new(scene, scheme, h).expect("a sound scene")
}

/// Fails unless `found` is `expected` to `units` of rounding of a sum of terms of this `size`.
#[track_caller]
fn close(found: f64, expected: f64, units: f64, size: f64, what: &str) {
    assert!((found - expected).abs() <= units * f64::EPSILON * size, "{what}: {found:e}, expected {expected:e}");
}

#[test]
fn a_body_at_rest_far_from_its_walls_starts_as_if_there_were_none() {
    // 2 kg under 3 N: ½at², on which each of these schemes is exact.
    let scene = Scene::oscillator(2.0, 0.0, 0.0)
        .with_wall(Wall::upper("far", 10.0))
        .with_wall(Wall::lower("behind", -10.0))
        .with_load(Load::constant(3.0));
    for scheme in with_memory() {
        let mut stepper = stepper(&scene, &scheme, 0.1);
        for step in 1..=5 {
            let t = 0.1 * f64::from(step);
            let q = stepper.step().expect("a step").q[0];
            close(q, 0.5 * 1.5 * t * t, 16.0, 1.0, &format!("{scheme}, step {step}"));
        }
    }
}

#[test]
fn the_first_step_inside_a_damped_spring_is_of_order_two() {
    // A body of 2 kg 10 mm inside a wall of 100 N/m and 3 N s/m, still going in at 3 m/s.
    let (m, k, c, q0, v0) = (2.0, 100.0, 3.0, -0.01, -3.0);
    let scene = Scene::oscillator(m, 0.0, 0.0)
        .with_wall(Wall::lower("pad", 0.0).with_elasticity(k, c))
        .with_initial(&[q0], &[v0]);
    let (decay, h) = (0.5 * c / m, 1e-3_f64);
    let omega = (k / m - decay * decay).sqrt();
    let exact = (-decay * h).exp() * (q0 * (omega * h).cos() + (v0 + decay * q0) / omega * (omega * h).sin());
    let (a0, jerk) = (-(k * q0 + c * v0) / m, |a: f64| (k * v0 + c * a).abs() / m);
    for scheme in with_memory() {
        let q = stepper(&scene, &scheme, h).step().expect("a step").q[0];
        // Exact up to ½a₀h²; the next term of the series is j h³/6, and a scheme of order 2 may be
        // off by a few of those.
        assert!((q - exact).abs() < jerk(a0) * h.powi(3), "{scheme}: {q:e}, exactly {exact:e}");
    }
}

#[test]
fn the_velocity_that_a_staggered_scheme_reports_is_that_at_the_end_of_its_step() {
    let scene = Scene::oscillator(1.0, 0.2, 100.0).with_wall(Wall::upper("far", 9.0)).with_initial(&[1.0], &[0.5]);
    let (decay, omega, h) = (0.1, (100.0_f64 - 0.01).sqrt(), 1e-3);
    for scheme in [Scheme::PaoliSchatzman, spring(1e3, Integrator::CentralDifference)] {
        let mut stepper = stepper(&scene, &scheme, h);
        for step in 1..=100 {
            let t = h * f64::from(step);
            let (sin, cos) = (omega * t).sin_cos();
            let b = (0.5 + decay) / omega;
            let v = (-decay * t).exp() * ((b * omega - decay) * cos - (omega + decay * b) * sin);
            let found = stepper.step().expect("a step").v[0];
            // Order 2: (ωh)² = 1e-4 of the largest speed, 10 m/s. Half a step of acceleration is
            // 0.05 m/s.
            assert!((found - v).abs() < 1e-3, "{scheme}, step {step}: {found}, exactly {v}");
        }
    }
}

#[test]
fn a_body_pressed_onto_a_wall_rests_there_though_others_stand_around() {
    let scene = Scene::oscillator(2.0, 0.0, 0.0)
        .with_wall(Wall::lower("floor", 0.0))
        .with_wall(Wall::upper("ceiling", 1.0))
        .with_load(Load::constant(-5.0));
    for scheme in CONSTRAINED.into_iter().chain([GENERALIZED_ALPHA]) {
        let mut stepper = stepper(&scene, &scheme, 0.01);
        for _ in 0..5 {
            let step = stepper.step().expect("a step");
            assert_eq!((step.q[0], step.v[0], step.impulse[1]), (0.0, 0.0, 0.0), "{scheme}");
            // Instants of impulses belong to the exact scheme.
            assert_eq!((step.jump, step.force[1]), (&[0.0, 0.0][..], 0.0), "{scheme}");
            // From the first step on the floor carries the load: h · 5 N.
            close(step.impulse[0], 0.05, 4.0, 0.05, &scheme.to_string());
        }
    }
}

/// Two bodies of 1 kg behind one lower wall at 0 on the displacement `row`, body 0 pressed by 1 N.
fn pressed_pair(row: [f64; 2], v: [f64; 2]) -> Scene {
    random_structures::scene(Symmetric::diagonal(&[1.0, 1.0]), Symmetric::zeros(2), Symmetric::zeros(2))
        .with_wall(at(Wall::lower("link", 0.0), Row::new(vec![(0, row[0]), (1, row[1])])))
        .with_load(on(Load::constant(-row[0].signum()), 0))
        .with_initial(&[0.0, 0.0], &v)
}

#[test]
fn bodies_whose_relative_speed_is_rounding_are_at_rest_at_their_wall() {
    // The speeds 3s and s cancel in 0.1·3s − 0.3·s, up to rounding: a speed s is taken for which
    // they do not cancel exactly.
    let speed = (1..100).map(|i| 1e5 + f64::from(i)).find(|s| 0.1 * (3.0 * s) - 0.3 * s != 0.0).expect("rounding");
    let v = [3.0 * speed, speed];
    let step = |h: f64| {
        let scene = pressed_pair([0.1, -0.3], v);
        stepper(&scene, &Scheme::PaoliSchatzman, h).step().expect("a step").q.to_vec()
    };
    // The wall holds from the start: the acceleration is that of the load of −1 N along the row's
    // null space, (−0.9, −0.3) m/s². Not held, the pair would rebound to 0.05 m.
    let q = step(1.0);
    for (i, a) in [-0.9, -0.3].into_iter().enumerate() {
        close(q[i], v[i] + 0.5 * a, 8.0, v[i], "held");
    }
}

#[test]
fn bodies_that_leave_their_wall_however_slowly_are_not_held_by_it() {
    // Apart at 1e-15 m/s in the wall's row, a relative speed of 1e-9: far above its rounding error.
    let scene = pressed_pair([1e-6, -1e-6], [1.0 + 1e-9, 1.0]);
    let step = stepper(&scene, &Scheme::PaoliSchatzman, 1.0).step().expect("a step").q.to_vec();
    // v₋ = v − ½h a with a = −1 m/s² for body 0: w⁻ = w − h g·v₋ = −(0.5e-6 + 1e-15), and the bound
    // at e = 1 is w⁺ ≥ −w⁻.
    let w = 1e-6 * step[0] - 1e-6 * step[1];
    // Rounding of displacements of 1 m, times 1e-6, and the 1e-12 m of the solver.
    assert!((w - 0.5e-6).abs() < 2e-12, "{w:e}");
}

#[test]
fn central_differences_meet_their_dashpots_and_their_balance() {
    let (m, c, k, load) = (2.0, 0.5, 10.0, 1.0);
    let (stiffness, damping, h) = (1000.0, 8.0, 1e-3);
    for start in [[-0.01, -0.2], [0.01, -1.0]] {
        let scene = Scene::oscillator(m, c, k)
            .with_wall(Wall::lower("floor", 0.0).with_elasticity(stiffness, damping))
            .with_wall(Wall::upper("ceiling", 1.0))
            .with_load(Load::constant(load))
            .with_initial(&start[..1], &start[1..]);
        let law = PenaltyLaw::Linear { stiffness, damping };
        let scheme = Scheme::Penalty { law, integrator: Integrator::CentralDifference };
        let (mut stepper, mut q, mut pushed) = (stepper(&scene, &scheme, h), start[0], 0);
        for _ in 0..200 {
            let step = stepper.step().expect("a step");
            let (before, after) = (step.velocity_before[0], step.velocity_after[0]);
            let (mean, depth) = (0.5 * (before + after), -q);
            let force = if depth > 0.0 { (stiffness * depth - damping * mean).max(0.0) } else { 0.0 };
            let size = stiffness * depth.abs() + damping * (before.abs() + after.abs());
            close(step.force[0], force, 8.0, size, "the law of the floor");
            assert_eq!(step.force[1], 0.0, "the ceiling is not reached");
            let balance = load - c * mean - k * q + force;
            // m/h · Δv cancels most of its terms.
            close(m * (after - before) / h, balance, 8.0, m * (after.abs() + before.abs()) / h + size, "the balance");
            pushed += u32::from(force > 0.0);
            q = step.q[0];
        }
        assert!(pushed > 10 && pushed < 150, "{pushed}");
    }
}

#[test]
fn elastic_walls_follow_their_law_in_every_scheme() {
    let (g, k, c, h, q0) = (0.1, 500.0, 4.0, 1e-2, 0.05);
    let scene = Scene::oscillator(1.0, 0.0, 20.0)
        .with_wall(Wall::upper("pad", g).with_elasticity(k, c))
        .with_initial(&[q0], &[1.0]);
    for scheme in whole_steps() {
        let (mut stepper, mut q, mut pushed) = (stepper(&scene, &scheme, h), q0, 0);
        let (mut impulses, mut contacts) = (0.0, 0.0);
        for _ in 0..60 {
            let step = stepper.step().expect("a step");
            impulses += step.impulse[0];
            contacts += step.closed.iter().map(|contact| contact.impulse).sum::<f64>();
            let (s0, s1) = (q - g, step.q[0] - g);
            let (force, pressure) = match scheme {
                Scheme::MoreauJean { theta } => {
                    let depth = (1.0 - theta) * s0 + theta * s1;
                    (step.impulse[0] / h, k * depth + c * (depth - s0.max(0.0)) / (theta * h))
                }
                Scheme::PaoliSchatzman => {
                    let back = s0 - h * step.velocity_before[0];
                    let depth = 0.25 * back + 0.5 * s0 + 0.25 * s1;
                    (step.force[0], k * depth + 0.5 * c * (s1 - back.max(0.0)) / h)
                }
                _ => (step.force[0], k * s1 + c * (s1 - s0.max(0.0)) / h),
            };
            // Forces of up to 1e2 N from displacements of 0.1 m by slopes of (k + c/h) = 900 N/m.
            close(force, -pressure.max(0.0), 64.0, 0.1 * 900.0, &scheme.to_string());
            pushed += u32::from(force < 0.0);
            q = step.q[0];
        }
        assert!(pushed > 2 && pushed < 50, "{scheme}: {pushed}");
        // Every step of a contact is part of its episode.
        close(contacts, impulses, 64.0, impulses.abs(), &scheme.to_string());
    }
}

#[test]
fn an_extra_force_moves_a_free_body_as_the_same_load_does() {
    // h f = 1 N s, and others.
    for force in [2.0, 3.0, -0.7] {
        for scheme in CONSTRAINED.into_iter().chain([GENERALIZED_ALPHA]) {
            let scene = Scene::oscillator(4.0, 0.0, 0.0).with_wall(Wall::upper("far", 9.0));
            let mut stepper = stepper(&scene, &scheme, 0.5);
            let step = stepper.step_with(&[force]).expect("a step");
            close(step.v[0], 0.5 * force / 4.0, 8.0, 1.0, &scheme.to_string());
        }
    }
}

#[test]
fn a_wall_gives_back_the_blow_that_drives_a_damped_body_into_it_once() {
    // At rest on the floor under 5 N, with a blow of 1 N s within the second step.
    let scene = Scene::oscillator(2.0, 3.0, 0.0)
        .with_wall(Wall::lower("floor", 0.0).with_restitution(0.0))
        .with_load(Load::constant(-5.0))
        .with_load(Load::impulse(-1.0, 0.013));
    for scheme in whole_steps().filter(|scheme| *scheme != Scheme::Newmark) {
        let mut stepper = stepper(&scene, &scheme, 0.01);
        let total: f64 = (0..10).map(|_| stepper.step().expect("a step").impulse[0]).sum();
        assert_eq!(stepper.state().v, [0.0], "{scheme}");
        close(total, 1.5, 16.0, 1.5, &scheme.to_string());
    }
}

#[test]
fn a_body_behind_a_lever_stands_exactly_on_its_wall() {
    // g = 2q is exact, so that the wall's position can be met to the last bit.
    let mut met = 0;
    for i in 1..200 {
        let g = 0.1 + 1e-3 * (f64::from(i) * std::f64::consts::SQRT_2).fract();
        let scene = Scene::oscillator(1.0, 0.0, 0.0)
            .with_wall(at(Wall::upper("stop", g), Row::new(vec![(0, 2.0)])))
            .with_initial(&[-0.02 - 1e-5 * f64::from(i) * std::f64::consts::PI], &[1.0]);
        let mut stepper = stepper(&scene, &Scheme::ImplicitEuler, 0.1);
        let step = stepper.step().expect("a step");
        assert!(step.force[0] < 0.0);
        assert_eq!(2.0 * step.q[0], g);
        met += 1;
    }
    assert_eq!(met, 199);
}

#[test]
fn a_lower_wall_above_the_origin_is_met() {
    for scheme in CONSTRAINED.into_iter().filter(|scheme| *scheme != Scheme::Newmark) {
        let scene = Scene::oscillator(1.0, 0.0, 0.0).with_wall(Wall::lower("floor", 0.1)).with_initial(&[0.2], &[-1.0]);
        let mut stepper = stepper(&scene, &scheme, 0.01);
        for _ in 0..20 {
            stepper.step().expect("a step");
        }
        let (q, v) = (stepper.state().q[0], stepper.state().v[0]);
        // e = 1, or 0 for implicit Euler; a rebound is known to a step of 0.01 s at 1 m/s.
        let (place, speed) = if scheme == Scheme::ImplicitEuler { (0.1, 0.0) } else { (0.2, 1.0) };
        assert!((q - place).abs() < 0.0201 && (v - speed).abs() < 1e-12, "{scheme}: {q} m, {v} m/s");
    }
}

#[test]
fn at_a_spring_too_stiff_for_the_step_the_velocity_known_is_reported() {
    // −3 N at t = 0 and +3 N a step later; the body rests in the spring in between.
    let (h, k) = (0.1, 1e6);
    let turning = Load::harmonic(3.0, 0.5 / h, -0.5 * std::f64::consts::PI);
    let scene = Scene::oscillator(1.0, 0.0, 0.0)
        .with_wall(Wall::lower("pad", 0.0).with_elasticity(k, 0.0))
        .with_load(turning)
        .with_initial(&[-3.0 / k], &[0.0]);
    let mut stepper = stepper(&scene, &Scheme::PaoliSchatzman, h);
    let step = stepper.step().expect("a step");
    assert!(step.q[0] < 0.0 && step.force[0] > 0.0, "{step:?}");
    // Half a step under +3 N would add 0.15 m/s, and the spring takes it back within the step.
    assert_eq!(step.v, step.velocity_after);
}

#[test]
fn a_frozen_body_is_counted_beside_one_that_rests() {
    // Body 0 goes 1 m per step between walls 0.1 m apart; body 1, if there, rests on its floor.
    let frozen = |bodies: usize| {
        let zero = || Symmetric::zeros(bodies);
        let mut scene = random_structures::scene(Symmetric::diagonal(&vec![1.0; bodies]), zero(), zero())
            .with_wall(Wall::upper("up", 0.05))
            .with_wall(Wall::lower("down", -0.05));
        if bodies == 2 {
            let floor = Wall::lower("floor", 0.0).with_restitution(0.0);
            scene = scene.with_wall(at(floor, Row::dof(1))).with_load(on(Load::constant(-2.0), 1));
        }
        let start = [10.0, 0.0];
        let scene = scene.with_initial(&[0.0, 0.0][..bodies], &start[..bodies]).with_duration(1.0);
        run(&scene, &MOREAU_JEAN, &Options::with_step(0.1)).expect("a run").counters.frozen_steps
    };
    let alone = frozen(1);
    assert!(alone > 5, "{alone}");
    assert_eq!(frozen(2), alone);
}

#[test]
fn a_damper_on_one_of_two_bodies_feels_the_blow_on_its_body() {
    let load = || Load::impulse(0.7, 0.0137);
    let alone = Scene::oscillator(2.0, 30.0, 0.0).with_wall(Wall::upper("far", 9.0)).with_load(load());
    let pair = random_structures::scene(
        Symmetric::diagonal(&[2.0, 1.0]),
        Symmetric::diagonal(&[30.0, 0.0]),
        Symmetric::zeros(2),
    )
    .with_wall(Wall::upper("far", 9.0))
    .with_load(on(load(), 0));
    let (mut compared, mut moved) = (0, 0.0_f64);
    for scheme in whole_steps() {
        let (mut one, mut two) = (stepper(&alone, &scheme, 0.01), stepper(&pair, &scheme, 0.01));
        for _ in 0..4 {
            let (one, two) = (one.step().expect("a step"), two.step().expect("a step"));
            close(two.q[0], one.q[0], 8.0, 0.01, &scheme.to_string());
            close(two.v[0], one.v[0], 8.0, 0.35, &scheme.to_string());
            (compared, moved) = (compared + 1, moved.max(one.q[0]));
        }
    }
    assert!(compared == 32 && moved > 1e-3, "{compared}, {moved}");
}

#[test]
fn counters_tell_how_often_each_solver_worked() {
    // A ball of 1 kg rests on its floor: every one of the ten steps meets it.
    let scene = Scene::oscillator(1.0, 0.0, 0.0)
        .with_wall(Wall::lower("floor", 0.0).with_restitution(0.0))
        .with_load(Load::constant(-9.81))
        .with_duration(0.1);
    for scheme in CONSTRAINED.into_iter().chain([GENERALIZED_ALPHA]) {
        let counters = run(&scene, &scheme, &Options::with_step(1e-2)).expect("a run").counters;
        // generalized-alpha solves one programme for the displacement and one for the velocity.
        let solves = if scheme == GENERALIZED_ALPHA { 20 } else { 10 };
        assert_eq!(counters.qp_solves, solves, "{scheme}");
        assert_eq!((counters.interior_point_iterations, counters.pivots, counters.newton_iterations), (0, 0, 0));
        assert_eq!(counters.qp_fallbacks, 0, "{scheme}");
    }
    // The same by an interior point, and with two bodies by pivoting: a handful for each programme.
    let interior = Method { scheme: MOREAU_JEAN, backend: Backend::Clarabel };
    let counters = run(&scene, &interior, &Options::with_step(1e-2)).expect("a run").counters;
    assert!((10..=500).contains(&counters.interior_point_iterations), "{counters:?}");
    let pivots = |seed| {
        let scene = random_structures::random_scene(&mut random_structures::Draws::new(seed)).with_duration(0.5);
        let counters = run(&scene, &MOREAU_JEAN, &Options::with_step(2e-3)).expect("a run").counters;
        // Steps without a bound are not counted.
        assert!(counters.steps == 250 && counters.qp_solves <= 250, "seed {seed}: {counters:?}");
        counters.pivots
    };
    let total: u64 = (0..20).map(pivots).sum();
    assert!((1..=20 * 250 * 8).contains(&total), "{total} pivots in 20 runs of 250 steps");
    for integrator in INTEGRATORS {
        let counters = run(&scene, &spring(1e4, integrator), &Options::with_step(1e-2)).expect("a run").counters;
        assert_eq!(counters.qp_solves, 0);
        let implicit = integrator != Integrator::CentralDifference;
        // A linear spring, which is met from outside once: a few iterations a step.
        assert_eq!((10..=50).contains(&counters.newton_iterations), implicit, "{integrator}: {counters:?}");
    }
}

#[test]
fn newtons_method_takes_no_more_iterations_behind_a_lever() {
    // q behind a lever of ratio 16 is a body of mass m/16² at u = 16 q: powers of 2, so that both
    // are the same numbers.
    let speed = 2.0;
    for law in [PenaltyLaw::Linear { stiffness: 1e5, damping: 3.0 }, PenaltyLaw::Quartic { epsilon: 1e-7 }] {
        for integrator in INTEGRATORS.into_iter().filter(|i| *i != Integrator::CentralDifference) {
            let scheme = Scheme::Penalty { law, integrator };
            let iterations = |ratio: f64| {
                let wall = |wall: Wall| at(wall, Row::new(vec![(0, ratio)]));
                let scene = Scene::oscillator(ratio * ratio, 0.0, 50.0 * ratio * ratio)
                    .with_wall(wall(Wall::upper("up", 0.0625)))
                    .with_wall(wall(Wall::lower("down", -0.0625)))
                    .with_initial(&[0.0], &[speed / ratio])
                    .with_duration(1.0);
                let found = run(&scene, &scheme, &Options::with_step(1e-3)).expect("a run");
                (found.counters.newton_iterations, found.trajectory.contacts().len())
            };
            let ((direct, contacts), (lever, same)) = (iterations(1.0), iterations(16.0));
            assert_eq!((direct, contacts), (lever, same), "{scheme}");
            // Quadratic convergence: steps in contact take a handful each, in all 1000 steps.
            assert!(contacts > 3 && direct < 6000, "{scheme}: {direct} iterations, {contacts} contacts");
        }
    }
}

#[test]
fn one_wall_of_another_restitution_is_enough_for_bounds_to_cross() {
    // Behind the upper stop at w = 0.1, 0.06 after a step from 0.16: at e = 1 that stop asks for
    // w⁺ ≤ 2·0.1 − 0.16 = 0.04, the two below at 0.09 and e = 0 for w⁺ ≥ 0.09.
    let walls = |scene: Scene| {
        scene
            .with_wall(Wall::lower("floor", 0.09).with_restitution(0.0))
            .with_wall(Wall::lower("same", 0.09).with_restitution(0.0))
            .with_wall(Wall::upper("stop", 0.1))
    };
    let scene = walls(Scene::oscillator(1.0, 0.0, 0.0)).with_initial(&[0.095], &[-0.65]);
    let mut stepper = stepper(&scene, &Scheme::PaoliSchatzman, 0.1);
    let step = stepper.step().expect("a step");
    // Not the whole scene, only this row takes the smallest e: w⁺ stands between both walls.
    assert!(matches!(step.path, Path::Grid), "{:?}", step.path);
    assert!((0.09..=0.1).contains(&step.q[0]), "{}", step.q[0]);
}

#[test]
fn an_extra_force_acts_in_its_step_alone() {
    // 3 N over one step of 0.01 s on a free body of 2 kg: 0.015 m/s from then on.
    let scene = Scene::oscillator(2.0, 0.0, 0.0).with_wall(Wall::upper("far", 9.0));
    let penalties = INTEGRATORS.map(|integrator| spring(1e3, integrator));
    for scheme in CONSTRAINED.into_iter().chain([GENERALIZED_ALPHA, Scheme::Event]).chain(penalties) {
        let (mut plain, mut told) = (stepper(&scene, &scheme, 0.01), stepper(&scene, &scheme, 0.01));
        for number in 0..6 {
            let force = if number == 1 { 3.0 } else { 0.0 };
            let one = if force == 0.0 { plain.step() } else { plain.step_with(&[force]) };
            let one = one.expect("a step").q[0];
            let other = told.step_with(&[force]).expect("a step").q[0];
            assert_eq!(one, other, "{scheme}, step {number}: a step without a force is one with a force of 0");
        }
        close(plain.state().v[0], 0.015, 16.0, 0.015, &scheme.to_string());
        // The middle of the step with the force at 0.015 s, the end at 0.06 s.
        let place = plain.state().q[0];
        assert!((place - 0.015 * 0.045).abs() < 0.015 * 0.005 * (1.0 + 1e-9), "{scheme}: {place}");
    }
}

#[test]
fn an_extra_force_that_is_no_number_is_named() {
    let scene = random_structures::chain(2, 100.0, 0.0).with_wall(Wall::upper("far", 9.0));
    let mut stepper = stepper(&scene, &MOREAU_JEAN, 0.01);
    for (force, named) in [(vec![1.5, f64::NAN], "NaN"), (vec![f64::INFINITY, 2.5], "inf"), (vec![1.0], "1 values")] {
        let error = stepper.step_with(&force).expect_err("no force").to_string();
        assert!(error.contains(named), "{force:?}: {error}");
    }
    // The stepper is as it was.
    assert_eq!((stepper.time(), stepper.step().expect("a step").q), (0.0, &[0.0, 0.0][..]));
}
