//! A load that is a Rust closure.

use crate::common::{MOREAU_JEAN, source};
use signorini::{Error, Integrator, Load, LoadKind, Options, PenaltyLaw, Row, Scene, Scheme, Stepper, Table, run};
use std::f64::consts::TAU;

/// The source scene with its sine as a function; `structure` makes matrices of the oscillator.
fn scenes(structure: bool) -> [Scene; 2] {
    let mut known = source(0.8, 0.8).with_duration(0.5);
    if structure {
        known.system = Scene::structure(known.system.structure()).system;
    }
    let mut function = known.clone();
    function.loads = vec![Load::function(|t| 3.0 * (TAU * 5.0 * t + 0.0).sin())];
    [known, function]
}

#[test]
fn a_sine_as_a_function_is_the_same_load_to_every_stepping_scheme_and_to_the_judge() {
    let law = PenaltyLaw::Linear { stiffness: 1e5, damping: 1.0 };
    for structure in [false, true] {
        let [known, function] = scenes(structure);
        for scheme in [
            MOREAU_JEAN,
            Scheme::PaoliSchatzman,
            Scheme::ImplicitEuler,
            Scheme::GeneralizedAlpha { rho: 0.8 },
            Scheme::Penalty { law, integrator: Integrator::DiscreteGradient },
            Scheme::Penalty { law, integrator: Integrator::CentralDifference },
        ] {
            let [a, b] = [&known, &function].map(|s| run(s, &scheme, &Options::with_step(1e-3)).expect("a run"));
            if structure {
                assert_eq!(a.trajectory, b.trajectory, "{scheme}");
                assert_eq!(a.residuals, b.residuals, "{scheme}");
                continue;
            }
            // The sine of one degree of freedom turns from step to step, and is off by 16 ulps of
            // its amplitude at most, which the impacts of half a second multiply by less than 1e3.
            let pairs = a.trajectory.displacement().iter().zip(b.trajectory.displacement());
            let apart = pairs.map(|(a, b)| (a - b).abs()).fold(0.0, f64::max);
            assert!(apart < 1e-14, "{scheme}: {apart:e}");
            assert_eq!(a.trajectory.contacts().len(), b.trajectory.contacts().len(), "{scheme}");
            // The judge evaluates both by libm: what it finds is rounding of forces of some
            // newtons.
            let balance = (a.residuals.force_balance - b.residuals.force_balance).abs();
            assert!(balance < 1e-12, "{scheme}: {balance:e}");
        }
    }
}

#[test]
fn the_exact_scheme_refuses_a_function_and_says_what_would_do() {
    for structure in [false, true] {
        let [_, function] = scenes(structure);
        let refused = Stepper::new(&function, &Scheme::Event, 1.0).expect_err("no closed form");
        assert!(
            refused.is_request() && refused.to_string().contains("a table, such as one of values of the function"),
            "{refused}"
        );
    }
}

#[test]
fn a_force_that_is_not_finite_is_told_by_its_load_and_time() {
    let scene = Scene::oscillator(1.0, 0.0, 1.0).with_load(Load::function(|t| 1.0 / t));
    assert!(matches!(Stepper::new(&scene, &MOREAU_JEAN, 1e-3), Err(Error::Invalid { .. })));
    let law = PenaltyLaw::Linear { stiffness: 1e5, damping: 1.0 };
    for structure in [false, true] {
        let [mut late, _] = scenes(structure);
        late.loads.push(Load::function(|t| if t > 0.3 { f64::NAN } else { 0.0 }));
        for scheme in [
            MOREAU_JEAN,
            Scheme::Located,
            Scheme::PaoliSchatzman,
            Scheme::ImplicitEuler,
            Scheme::Newmark,
            Scheme::GeneralizedAlpha { rho: 0.8 },
            Scheme::Penalty { law, integrator: Integrator::DiscreteGradient },
            Scheme::Penalty { law, integrator: Integrator::CentralDifference },
        ] {
            let told = run(&late, &scheme, &Options::with_step(1e-3)).expect_err("no finite force");
            let shown = told.to_string();
            assert!(told.is_request() && shown.starts_with("load 2: f(0.3"), "{scheme}, {structure}: {shown}");
            assert!(shown.ends_with("is NaN; expected a finite number"), "{scheme}, {structure}: {shown}");
        }
    }
}

#[test]
fn a_sampled_function_is_as_near_as_it_says_and_carries_the_exact_scheme() {
    let omega = TAU * 5.0;
    let sine = move |t: f64| 3.0 * (omega * t).sin();
    for error in [1e-2, 1e-5] {
        let table = Table::sampled(sine, [0.0, 0.5], 3.0 * omega * omega, error).expect("a table");
        let off = |i: u32| 0.5 * f64::from(i) / 100_003.0;
        let worst = (0..100_003).map(|i| (table.piece(off(i)).0 - sine(off(i))).abs()).fold(0.0, f64::max);
        // The bound is met, and no finer table was made than it takes: a sine comes near its
        // largest curvature.
        assert!(worst <= error && worst > 0.9 * error, "{worst:e}");
        let [known, mut sampled] = scenes(false);
        sampled.loads = vec![Load::table(table)];
        let [a, b] = [&known, &sampled].map(|s| run(s, &Scheme::Event, &Options::with_step(1e-3)).expect("a run"));
        let apart = (a.state.q[0] - b.state.q[0]).abs();
        // An error of the force moves 1 kg by at most ½ε t² between impacts, half a second with
        // some ten of them.
        assert!(apart < 20.0 * error, "{apart:e}");
    }
    for (interval, curvature, error) in [
        ([1.0, 1.0], 1.0, 1.0),
        ([0.0, 1.0], -1.0, 1.0),
        ([0.0, 1.0], 1.0, 0.0),
        ([0.0, 1.0], 1e9, 1e-9),
        ([0.0, f64::NAN], 1.0, 1.0),
    ] {
        assert!(matches!(Table::sampled(sine, interval, curvature, error), Err(Error::Invalid { .. })));
    }
}

#[test]
fn functions_add_up_with_other_loads_through_their_rows() {
    let load = Load { at: Row::new(vec![(0, 2.0)]), ..Load::function(|_| 1.5) };
    assert!(matches!(load.kind, LoadKind::Function(_)) && load == load.clone() && load != Load::function(|_| 1.5));
    let scene = Scene::oscillator(1.0, 0.0, 0.0).with_load(load).with_load(Load::constant(-3.0));
    let run = run(&scene, &MOREAU_JEAN, &Options::with_step(1e-2)).expect("a run");
    assert_eq!(run.state.q, [0.0]);
}
