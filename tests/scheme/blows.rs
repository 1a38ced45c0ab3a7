//! Blows (impulsive loads) act at their instants, wherever in a step these fall.

use crate::common::{self, MOREAU_JEAN, error, on_grid, schemes, slope};
use crate::random_structures::{self, on, scene};
use signorini::linear::Symmetric;
use signorini::{Load, Options, Probe, Row, Scene, Scheme, Wall, run};

/// Blows (s, N s): two of them in one step of 10 ms, one on a row, and a last one that stops the
/// motion left by the others.
const BLOWS: [(f64, f64); 5] = [(0.0431, 1.0), (0.1234, 0.7), (0.1278, -0.4), (0.2, 0.25), (0.3567, -1.55)];

/// Where they have taken a free body of 1 kg by `t`, m.
fn free(t: f64) -> f64 {
    BLOWS.iter().map(|&(at, p)| p * (t - at).max(0.0)).sum()
}

#[test]
fn a_free_body_is_where_the_blows_have_taken_it_at_every_row() {
    let mut oscillator = Scene::oscillator(2.0, 0.0, 0.0).with_wall(Wall::upper("far", 10.0)).with_duration(0.6);
    for (time, impulse) in BLOWS {
        oscillator = oscillator.with_load(Load::impulse(2.0 * impulse, time));
    }
    // Three masses that feel one another's inertia; the blows on the first, through M = L Lᵀ with
    // known M⁻¹ e₀.
    let mass = Symmetric::from_entries(3, [(0, 0, 2.0), (1, 0, 1.0), (1, 1, 2.0), (2, 1, 1.0), (2, 2, 2.0)]);
    let zero = || Symmetric::diagonal(&[0.0; 3]);
    let mut structure = scene(mass, zero(), zero()).with_wall(Wall::upper("far", 10.0)).with_duration(0.6);
    for (time, impulse) in BLOWS {
        structure = structure.with_load(on(Load::impulse(impulse, time), 0));
    }
    // M x = e₀.
    let given = [0.75, -0.5, 0.25];
    for scheme in schemes() {
        let run = run(&oscillator, &scheme, &Options::with_step(1e-2)).expect("a run");
        for (&t, &q) in run.trajectory.time().iter().zip(run.trajectory.displacement()) {
            // Sixty steps round by an ulp of some 0.3 m each.
            assert!((q - free(t)).abs() < 1e-14, "{scheme} at {t} s: {q} m, not {}", free(t));
        }
        assert!(run.residuals.force_balance < 1e-13 && run.residuals.energy.residual < 1e-13, "{:?}", run.residuals);
        for (dof, weight) in given.iter().enumerate() {
            let mut seen = structure.clone();
            seen.probes = vec![Probe { name: "seen".into(), at: Row::dof(dof) }];
            let run = signorini::run(&seen, &scheme, &Options::with_step(1e-2)).expect("a run");
            for (&t, &q) in run.trajectory.time().iter().zip(run.trajectory.displacement()) {
                assert!((q - weight * free(t)).abs() < 1e-14, "{scheme}, mass {dof} at {t} s: {q} m");
            }
            assert!(run.residuals.force_balance < 1e-13, "{scheme}: {:?}", run.residuals);
        }
    }
}

#[test]
fn a_blow_between_two_instants_of_the_grid_costs_no_order() {
    // With a damper: the rule lets it feel the blow from the instant where the rule counts it, an
    // error of hC/M of the blow.
    let oscillator = Scene::oscillator(1.0, 3.0, 100.0).with_initial(&[2e-3], &[0.05]);
    let masses = random_structures::chain(2, 100.0, 0.02).with_initial(&[2e-3, 0.0], &[0.05, 0.0]);
    for scene in [oscillator, masses] {
        let scene = scene
            .with_wall(Wall::upper("far", 10.0))
            .with_load(Load::impulse(0.1, 0.1234567))
            .with_load(Load::impulse(-0.07, 0.31415926));
        keeps_order(&scene);
    }
}

fn keeps_order(scene: &Scene) {
    let mut options = Options::with_step(1e-2);
    options.time.sample = Some(1e-2);
    let exact = run(&scene.clone().with_duration(1.0), &Scheme::Event, &options).expect("a run").trajectory;
    for (scheme, order) in [
        (MOREAU_JEAN, 2.0),
        (Scheme::Newmark, 2.0),
        (Scheme::PaoliSchatzman, 2.0),
        (Scheme::GeneralizedAlpha { rho: 0.8 }, 2.0),
        (common::spring(1e4, signorini::Integrator::DiscreteGradient), 2.0),
        (common::spring(1e4, signorini::Integrator::CentralDifference), 2.0),
        (Scheme::ImplicitEuler, 1.0),
    ] {
        let points = [4_u64, 16, 64, 256]
            .map(|per| (1.0 / per as f64, error(&on_grid(scene, &scheme, 1e-2, per, 1.0), &exact.displacement()[1..])));
        println!("{scheme}: {points:?}");
        // Where in a step the blows fall differs from run to run: the slope of four of them
        // scatters by that.
        assert!(slope(&points) > order - 0.2, "{scheme}: {points:?}");
    }
}

#[test]
fn the_ledger_of_a_blow_in_the_middle_of_a_step_closes() {
    let scene = common::source(0.8, 0.8)
        .with_load(Load::impulse(0.05, 0.25321))
        .with_load(Load::impulse(-0.03, 0.41777))
        .with_duration(2.0);
    for step in [1e-2, 1e-3] {
        for scheme in [MOREAU_JEAN, common::spring(1e5, signorini::Integrator::DiscreteGradient)] {
            let run = run(&scene, &scheme, &Options::with_step(step)).expect("a run");
            // Rounding of 2000 steps.
            assert!(run.residuals.energy.residual < 1e-13, "{scheme}: {:?}", run.residuals);
            assert!(
                run.residuals.force_balance < 1e-13 && run.residuals.complementarity < 1e-12,
                "{:?}",
                run.residuals
            );
        }
    }
}

#[test]
fn a_body_that_rests_on_a_wall_with_a_damper_hands_a_blow_into_it_over_whole() {
    // It does not move, so no damper has an impulse: 25 N of the load and 0.3 N s.
    let pressed = Scene::oscillator(1.0, 20.0, 1e4).with_initial(&[1e-3], &[0.0]);
    let masses = random_structures::chain(2, 1e4, 1e-3).with_initial(&[1e-3, 0.5e-3], &[0.0, 0.0]);
    for (scene, force) in [(pressed, 25.0), (masses, 20.0)] {
        let load = force + 1e4 * 1e-3 * if force == 25.0 { 1.0 } else { 1.5 };
        let scene = scene
            .with_wall(Wall::upper("stop", 1e-3).with_restitution(0.0))
            .with_load(Load::constant(load))
            .with_load(Load::impulse(0.3, 0.10321))
            .with_duration(0.2);
        for scheme in
            [MOREAU_JEAN, Scheme::PaoliSchatzman, Scheme::GeneralizedAlpha { rho: 0.8 }, Scheme::ImplicitEuler]
        {
            let run = run(&scene, &scheme, &Options::with_step(1e-3)).expect("a run");
            let pushed: f64 = run.trajectory.contact_impulses()[0].iter().sum();
            // Two hundred steps of rounding. Where the wall holds the place and not the velocity,
            // the dampers of the body and of its neighbour take what moves for a step: of the order
            // of c h over m of the blow.
            let allowed = match scheme {
                Scheme::ImplicitEuler | Scheme::GeneralizedAlpha { .. } => 0.3 * 20.0 * 1e-3,
                _ => 1e-10,
            };
            assert!((pushed + 0.2 * force + 0.3).abs() < allowed, "{scheme}: {pushed} N s, not {}", -0.2 * force - 0.3);
            assert!(run.residuals.force_balance < 1e-12, "{scheme}: {:?}", run.residuals);
        }
    }
}
