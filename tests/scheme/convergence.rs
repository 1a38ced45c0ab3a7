//! The order of every scheme, as the least-squares slope of log error over log step.

use crate::common::event_driven::EventDriven;
use crate::common::penalty_values::PENALTY;
use crate::common::{self, MOREAU_JEAN, error, on_grid, penalty, slope, spread};
use signorini::{Integrator, Options, Scene, Scheme, TimeOptions, Wall, run};

#[test]
fn the_event_driven_solution_holds_the_fifty_digit_values() {
    let states = |scene: &Scene, values: &[(f64, f64, f64)], tolerance: f64| {
        let mut motion = EventDriven::new(scene);
        for &(t, u, v) in values {
            let (q, w) = motion.advance(t);
            assert!((q - u).abs() < tolerance && (w - v).abs() < 40.0 * tolerance, "at {t} s: {q} {w}");
        }
    };
    // Rounding grows by 8 in the first second of the chaotic motion; 1e-12 m leaves four digits.
    states(&common::source(1.0, 1.0), &common::RIGID_E1, 1e-12);
    states(&common::source(0.8, 0.8), &common::RIGID_E08, 1e-12);
    states(&common::elastic(0.0, 1.0), &common::ELASTIC_UPPER, 1e-12);
    let mut free = common::source(1.0, 1.0).with_initial(&[0.0], &[0.1]);
    free.loads.clear();
    states(&free, &common::IMPULSE_E1, 1e-12);
    for (e, t) in common::SECOND_IMPACT {
        let mut motion = EventDriven::new(&common::source(e, e));
        motion.advance(0.3);
        // The values are printed to 1e-8 s.
        assert!((motion.events[1].time - t).abs() < 6e-9, "e = {e}: {}", motion.events[1].time);
    }
}

/// Errors over steps of 1 ms / n against displacements on the 1 ms grid.
fn errors(scene: &Scene, scheme: &Scheme, exact: &[f64], parts: &[u64]) -> Vec<(f64, f64)> {
    let end = exact.len() as f64 * 1e-3;
    parts.iter().map(|&n| (1e-3 / n as f64, error(&on_grid(scene, scheme, 1e-3, n, end), exact))).collect()
}

fn report(what: &str, points: &[(f64, f64)]) -> f64 {
    let order = slope(points);
    let (first, last) = (points[0], points[points.len() - 1]);
    println!("{what}: slope {order:.3}, {:.2e} at {:.1e} s, {:.2e} at {:.1e} s", first.1, first.0, last.1, last.0);
    order
}

#[test]
fn the_schemes_that_honour_restitution_converge_at_order_one_through_impacts() {
    let parts = spread(1, 1000, 22);
    for (e, end) in [(1.0, 1.0), (0.8, 2.0)] {
        let scene = common::source(e, e);
        let exact = EventDriven::displacements(&scene, 1e-3, end);
        for scheme in [Scheme::PaoliSchatzman, MOREAU_JEAN] {
            expect(&format!("{scheme} e = {e}"), &errors(&scene, &scheme, &exact, &parts), 1.0);
        }
    }
}

#[test]
fn at_restitution_zero_paoli_schatzman_is_of_order_two_and_implicit_euler_of_order_one() {
    let scene = common::source(0.0, 0.0);
    let exact = EventDriven::displacements(&scene, 1e-3, 2.0);
    let points = errors(&scene, &Scheme::PaoliSchatzman, &exact, &spread(1, 1000, 22));
    expect("paoli-schatzman e = 0", &points, 1.9);
    let at = error(&on_grid(&scene, &Scheme::PaoliSchatzman, 1e-3, 10, 2.0), &exact);
    // 1.5e-6 of the gap at 1e-4 s, as printed: two digits.
    assert!((at - 1.5e-6).abs() < 0.05e-6, "{at:e}");
    let points = errors(&scene, &Scheme::ImplicitEuler, &exact, &spread(1, 1000, 22));
    expect("implicit-euler e = 0", &points, 1.0);
    // 36 h gaps, as printed: two digits.
    for (h, e) in points {
        assert!((e / h - 36.0).abs() < 0.5, "{e:e} at {h:e}");
    }
}

/// Asserts an order to 0.2, the tolerance of all slopes here: single pairs of steps scatter by
/// more, since the phase of an impact within its step is nearly random.
fn expect(what: &str, points: &[(f64, f64)], order: f64) {
    let found = report(what, points);
    assert!((found - order).abs() < 0.2, "{what}: order {found}, expected {order}");
}

#[test]
fn an_elastic_wall_is_met_at_the_order_of_every_scheme() {
    let parts = spread(1, 300, 20);
    let theta = |theta| Scheme::MoreauJean { theta };
    for damping in [0.0, 3.0] {
        // With a rigid wall of restitution 1: the schemes that honour it, at their order through
        // impacts.
        let scene = common::elastic(damping, 1.0);
        let exact = EventDriven::displacements(&scene, 1e-3, 1.0);
        for scheme in [Scheme::PaoliSchatzman, MOREAU_JEAN, theta(1.0)] {
            expect(&format!("{scheme}, c = {damping}, rigid e = 1"), &errors(&scene, &scheme, &exact, &parts), 1.0);
        }
        // With a rigid wall of restitution 0.
        let scene = common::elastic(damping, 0.0);
        let exact = EventDriven::displacements(&scene, 1e-3, 1.0);
        for (scheme, order) in [(Scheme::PaoliSchatzman, 2.0), (Scheme::ImplicitEuler, 1.0)] {
            expect(&format!("{scheme}, c = {damping}, rigid e = 0"), &errors(&scene, &scheme, &exact, &parts), order);
        }
        // Without a rigid wall: all of them. A dashpot's rate taken at one end of the step, or a
        // contact that begins with a jump of force on a whole step, costs an order.
        let scene = common::all_elastic(damping);
        let exact = EventDriven::displacements(&scene, 1e-3, 1.0);
        let undamped_only = if damping > 0.0 { 1.0 } else { 2.0 };
        let schemes = [
            (Scheme::ImplicitEuler, 1.0),
            (Scheme::PaoliSchatzman, 2.0),
            (MOREAU_JEAN, undamped_only),
            (theta(0.75), 1.0),
            (Scheme::Newmark, undamped_only),
            (penalty(1e-9, Integrator::Trapezoidal), 2.0),
            (penalty(1e-9, Integrator::ImplicitEuler), 1.0),
            (penalty(1e-9, Integrator::CentralDifference), undamped_only),
            (penalty(1e-9, Integrator::DiscreteGradient), 2.0),
        ];
        for (scheme, order) in schemes {
            expect(&format!("{scheme}, c = {damping}"), &errors(&scene, &scheme, &exact, &parts), order);
        }
    }
}

/// Steps are chosen by h√(k_w/m), with k_w = (10 mm)²/ε the stiffness at the wall. The integrators
/// of order two need its square small: from 0.1 down. Implicit Euler loses a share of h√(k_w/m) in
/// each contact and needs that itself small: from 0.01 down, and over the first two contacts only
/// where the wall is stiffest. Below, the values' own 2e-10 m (4e-8 of the gap) end the fit.
#[test]
fn each_penalty_integrator_converges_to_its_own_epsilon_at_its_own_order() {
    let scene = common::source(1.0, 1.0);
    let second = [(1e-12, 1e-5, 5e-7, 1.0), (1e-9, 2e-4, 2e-6, 1.0), (1e-6, 1e-3, 1e-5, 2.0)];
    let first = [(1e-12, 1e-6, 5e-8, 0.2), (1e-9, 2e-5, 1e-6, 1.0), (1e-6, 5e-4, 1e-5, 1.0)];
    for integrator in Integrator::ALL {
        let (ranges, order) = if integrator == Integrator::ImplicitEuler { (first, 1.0) } else { (second, 2.0) };
        for (epsilon, coarse, fine, end) in ranges {
            let (_, exact) = PENALTY.iter().find(|(e, _)| *e == epsilon).expect("a value of each");
            let exact = &exact[..(end / 0.05_f64).round() as usize];
            let scheme = penalty(epsilon, integrator);
            let parts = spread((0.05_f64 / coarse).round() as u64, (0.05_f64 / fine).round() as u64, 20);
            let at = |&n: &u64| (0.05 / n as f64, error(&on_grid(&scene, &scheme, 0.05, n, end), exact));
            expect(&scheme.to_string(), &parts.iter().map(at).collect::<Vec<_>>(), order);
        }
    }
}

#[test]
fn walls_of_unequal_restitution_keep_their_own_in_every_scheme_that_honours_it() {
    // Against the exact scheme: at most 1 % of the gap at h = 1e-5, where the schemes' error is of
    // order h (1e-4 of the gap at equal e).
    let scene = common::source(0.9, 0.4).with_duration(1.0);
    let time = TimeOptions { sample: Some(1e-3), ..TimeOptions::with_step(1e-5) };
    let options = Options { time, ..Options::with_step(1e-5) };
    let exact = run(&scene, &Scheme::Event, &options).expect("a run");
    for scheme in [Scheme::PaoliSchatzman, MOREAU_JEAN] {
        let found = run(&scene, &scheme, &options).expect("a run");
        let pairs = found.trajectory.displacement().iter().zip(exact.trajectory.displacement());
        let error = pairs.map(|(a, b)| (a - b).abs() / 5e-3).fold(0.0, f64::max);
        assert!(error < 1e-2, "{scheme}: {error}");
    }
}

#[test]
fn the_trapezoid_on_a_bouncing_spring_converges_through_steps_that_are_lucky() {
    // A ball on a spring, 1e4 N/m: the kink of the force falls anywhere within a step, at entry and
    // at exit. The trapezoid errs there by (ωh)²φ(1 − φ)/2 of the speed, φ the place in the step;
    // entry and exit have opposite signs. Where both fall alike the errors cancel: 2¹⁶ steps over
    // 10 s are such a step, and their error is a tenth to a hundredth of their neighbours'. The
    // chart, whose steps are powers of two, showed it as an error that stops falling near 2e-6.
    let scene = common::ball(1.0, 0.0).with_duration(10.0);
    let scheme = common::spring(1e4, Integrator::Trapezoidal);
    let rows = |scene: &Scene, scheme: &Scheme, steps: u64| {
        let time = TimeOptions { sample: Some(10.0 / 64.0), ..TimeOptions::with_step(10.0 / steps as f64) };
        run(scene, scheme, &Options { time, ..Options::with_step(1.0) }).unwrap().trajectory.displacement().to_vec()
    };
    let mut springs = scene.clone();
    springs.walls = vec![Wall::lower("floor", 0.0).with_elasticity(1e4, 0.0)];
    let exact = rows(&springs, &Scheme::Event, 64);
    let error = |steps: u64| {
        let found = rows(&scene, &scheme, steps);
        found.iter().zip(&exact).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max)
    };
    let neighbours = |steps: u64| (1..=8).map(|i| error(steps + 64 * (1 + steps / 16_384) * i)).fold(0.0, f64::max);
    let lucky = error(1 << 16);
    assert!(lucky < 2e-5 && neighbours(1 << 16) > 5.0 * lucky, "{lucky:e} {:e}", neighbours(1 << 16));
    // Order 2 in the worst of nine steps: sixteen times over two halvings, to a factor of 4 for
    // chance.
    let ratio = neighbours(1 << 16) / neighbours(1 << 18);
    assert!(ratio > 4.0 && ratio < 64.0, "{ratio}");
}
