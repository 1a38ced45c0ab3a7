//! The chain of 20 masses between walls against its exact motion, up to t = 0.2 s (later it is
//! chaotic): every scheme at its order.

use signorini::case::Case;
use signorini::{Integrator, Options, PenaltyLaw, Probe, Row, Scene, Scheme, Stepper, TimeOptions, Trajectory, run};

const GAP: f64 = 1e-3;
const ROWS: f64 = 50.0;

/// The built-in case up to `end` (s), with a probe on every mass.
fn scene(end: f64) -> Scene {
    let mut scene = Case::embedded("chain-20").unwrap().scene.with_duration(end);
    scene.probes = (0..20).map(|i| Probe { name: format!("mass-{i}"), at: Row::dof(i) }).collect();
    scene
}

fn motion(scene: &Scene, scheme: &Scheme, step: f64) -> Trajectory {
    let time = TimeOptions { sample: Some(scene.duration / ROWS), ..TimeOptions::with_step(step) };
    let run = run(scene, scheme, &Options { time, ..Options::with_step(step) }).unwrap();
    assert!(run.residuals.complementarity < 1e-12, "{scheme}: {:?}", run.residuals);
    assert!(run.residuals.force_balance < 1e-10, "{scheme}: {:?}", run.residuals);
    run.trajectory
}

/// The largest difference of any mass at any row, over the gap; and that of the walls' impulses,
/// over their sum.
fn errors(run: &Trajectory, exact: &Trajectory) -> [f64; 2] {
    let mut displacement = 0.0_f64;
    for probe in exact.probes() {
        let pairs = run.probe(probe).unwrap().0.iter().zip(exact.probe(probe).unwrap().0);
        displacement = pairs.map(|(a, b)| (a - b).abs() / GAP).fold(displacement, f64::max);
    }
    let all: f64 = exact.walls().iter().map(|w| exact.impulse(w).unwrap().abs()).sum();
    let difference = |w: &String| (run.impulse(w).unwrap() - exact.impulse(w).unwrap()).abs();
    [displacement, exact.walls().iter().map(difference).sum::<f64>() / all]
}

const SCHEMES: [Scheme; 4] = [
    Scheme::MoreauJean { theta: 0.5 },
    Scheme::ImplicitEuler,
    Scheme::PaoliSchatzman,
    Scheme::GeneralizedAlpha { rho: 0.8 },
];

#[test]
fn every_scheme_converges_to_the_exact_chain_at_its_order() {
    let scene = scene(0.12);
    let exact = motion(&scene, &Scheme::Event, 0.1);
    assert!(exact.contacts().len() > 3, "{} contacts", exact.contacts().len());
    // Impacts at e = 0 are of order 1 in every scheme: a mass stops up to a step early or late.
    // Where in its step decides the constant, which scatters; the worst of three neighbouring steps
    // takes most of that out, and a quarter of an order is left for the rest.
    for scheme in SCHEMES {
        let worst = |h: f64| {
            let neighbours = [1.0, 0.8, 0.6].map(|share| errors(&motion(&scene, &scheme, share * h), &exact));
            neighbours.into_iter().fold([0.0_f64; 2], |a, b| [a[0].max(b[0]), a[1].max(b[1])])
        };
        let [coarse, fine] = [4e-5, 2e-6].map(worst);
        println!("{scheme}: {coarse:?} to {fine:?}");
        for i in [0, 1] {
            let slope = (coarse[i] / fine[i]).ln() / 20_f64.ln();
            assert!(slope > 0.75, "{scheme}: order {slope}: {coarse:?} to {fine:?}");
        }
    }
}

#[test]
fn every_scheme_is_near_the_exact_chain_as_long_as_it_is_predictable() {
    // Between 0.12 s and 0.2 s there are contacts that barely happen, past which errors fall more
    // slowly than the step: one step is held, to a bound.
    let scene = scene(0.2);
    let exact = motion(&scene, &Scheme::Event, 0.1);
    for scheme in SCHEMES {
        let [displacement, impulse] = errors(&motion(&scene, &scheme, 2e-6), &exact);
        println!("{scheme}: {displacement:e}, {impulse:e}");
        assert!(
            displacement < 0.05 && impulse < 0.01,
            "{scheme}: {displacement:e} of the gap, {impulse:e} of the impulse"
        );
    }
}

#[test]
fn penalties_converge_to_the_exact_motion_between_their_springs() {
    let law = PenaltyLaw::Linear { stiffness: 1e6, damping: 0.0 };
    let integrators = [
        (Integrator::Trapezoidal, 2.0),
        (Integrator::DiscreteGradient, 2.0),
        (Integrator::CentralDifference, 2.0),
        (Integrator::ImplicitEuler, 1.0),
    ];
    for (integrator, order) in integrators {
        let scheme = Scheme::Penalty { law, integrator };
        // The exact scheme follows linear springs too.
        let springs = Stepper::new(&scene(0.2), &scheme, 1e-3).unwrap().scene().clone();
        let exact = motion(&springs, &Scheme::Event, 0.1);
        // Implicit Euler damps the springs it does not resolve: its order shows at a finer step
        // only.
        let steps = if order < 2.0 { [4e-6, 2.5e-7] } else { [5e-5, 6.25e-6] };
        let [coarse, fine] = steps.map(|h| errors(&motion(&scene(0.2), &scheme, h), &exact));
        println!("{scheme}: {coarse:?} to {fine:?}");
        let slope = (coarse[0] / fine[0]).ln() / (steps[0] / steps[1]).ln();
        assert!(slope > order - 0.25, "{scheme}: order {slope}");
    }
}
