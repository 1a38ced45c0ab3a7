//! The order of every scheme, as the least-squares slope of log error over log step.

mod common;

use common::event_driven::EventDriven;
use common::penalty_values::PENALTY;
use common::{MOREAU_JEAN, error, on_grid, penalty, slope, spread};
use signorini::{Integrator, Scene, Scheme};

#[test]
fn the_event_driven_solution_holds_the_fifty_digit_values() {
    let states = |scene: &Scene, values: &[(f64, f64, f64)], tolerance: f64| {
        let mut motion = EventDriven::new(scene);
        for &(t, u, v) in values {
            let (q, w) = motion.advance(t);
            println!("{t}: {:e} {:e}", q - u, w - v);
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
            let order = report(&format!("{scheme} e = {e}"), &errors(&scene, &scheme, &exact, &parts));
            assert!((order - 1.0).abs() < 0.2, "{scheme} at e = {e}: order {order}");
        }
    }
}

#[test]
fn at_restitution_zero_paoli_schatzman_is_of_order_two_and_implicit_euler_of_order_one() {
    let scene = common::source(0.0, 0.0);
    let exact = EventDriven::displacements(&scene, 1e-3, 2.0);
    let points = errors(&scene, &Scheme::PaoliSchatzman, &exact, &spread(1, 1000, 22));
    let order = report("paoli-schatzman e = 0", &points);
    assert!((order - 1.9).abs() < 0.2, "order {order}");
    let at = error(&on_grid(&scene, &Scheme::PaoliSchatzman, 1e-3, 10, 2.0), &exact);
    println!("paoli-schatzman e = 0 at 1e-4: {at:e}");
    let points = errors(&scene, &Scheme::ImplicitEuler, &exact, &spread(1, 1000, 22));
    let order = report("implicit-euler e = 0", &points);
    println!("implicit-euler e = 0: {} h", points[10].1 / points[10].0);
    assert!((order - 1.0).abs() < 0.2, "order {order}");
}

#[test]
fn an_elastic_wall_is_met_at_the_order_of_every_scheme() {
    let integrators = Integrator::ALL.map(|i| penalty(1e-9, i));
    for damping in [0.0, 3.0] {
        // Beside a rigid wall of restitution 1: the schemes that honour it.
        let scene = common::elastic(damping, 1.0);
        let exact = EventDriven::displacements(&scene, 1e-3, 1.0);
        for scheme in [Scheme::PaoliSchatzman, MOREAU_JEAN, Scheme::MoreauJean { theta: 1.0 }] {
            let points = errors(&scene, &scheme, &exact, &spread(1, 300, 20));
            report(&format!("{scheme} elastic, c = {damping}, rigid e = 1"), &points);
        }
        // Beside one of restitution 0.
        let scene = common::elastic(damping, 0.0);
        let exact = EventDriven::displacements(&scene, 1e-3, 1.0);
        for scheme in [Scheme::PaoliSchatzman, Scheme::ImplicitEuler] {
            let points = errors(&scene, &scheme, &exact, &spread(1, 300, 20));
            report(&format!("{scheme} elastic, c = {damping}, rigid e = 0"), &points);
        }
        // Without a rigid wall: all of them.
        let scene = common::all_elastic(damping);
        let exact = EventDriven::displacements(&scene, 1e-3, 1.0);
        let grid = [
            Scheme::ImplicitEuler,
            Scheme::PaoliSchatzman,
            MOREAU_JEAN,
            Scheme::MoreauJean { theta: 0.75 },
            Scheme::Newmark,
        ];
        for scheme in grid.into_iter().chain(integrators) {
            let points = errors(&scene, &scheme, &exact, &spread(1, 300, 20));
            report(&format!("{scheme} elastic, c = {damping}, both"), &points);
        }
    }
}

#[test]
fn each_penalty_integrator_converges_to_its_own_epsilon_at_its_own_order() {
    for (epsilon, coarse, fine, end) in [(1e-12, 1e-5, 5e-7, 1.0), (1e-9, 2e-4, 2e-6, 1.0), (1e-6, 1e-3, 1e-5, 2.0)] {
        let (_, exact) = PENALTY.iter().find(|(e, _)| *e == epsilon).expect("a value of each");
        let rows = (end / 0.05_f64).round() as usize;
        let scene = common::source(1.0, 1.0);
        for integrator in Integrator::ALL {
            let scheme = penalty(epsilon, integrator);
            let parts = spread((0.05_f64 / coarse).round() as u64, (0.05_f64 / fine).round() as u64, 20);
            let points: Vec<(f64, f64)> = parts
                .iter()
                .map(|&n| (0.05 / n as f64, error(&on_grid(&scene, &scheme, 0.05, n, end), &exact[..rows])))
                .collect();
            let order = report(&scheme.to_string(), &points);
            let _ = order;
        }
    }
}
