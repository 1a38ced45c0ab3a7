//! The recorded impulses account for the momentum of the run, in every scheme: checked from the
//! recorded rows.

use crate::common::{MOREAU_JEAN, schemes, source};
use crate::random_structures::{at, chain, on};
use crate::recorded_momentum::momentum;
use signorini::linear::Symmetric;
use signorini::residual::Judge;
use signorini::{
    Finding, Integrator, Load, Options, Probe, Refuted, Row, Scene, Scheme, Stepper, Structure, Table, Wall, run,
};

/// 35 N press 1 kg on a stop at 1 mm against 1e4 N/m: it rests under 25 N for ten seconds.
fn pressed() -> Scene {
    Scene::oscillator(1.0, 20.0, 1e4)
        .with_wall(Wall::upper("stop", 1e-3).with_restitution(0.3))
        .with_load(Load::constant(35.0))
        .with_duration(10.0)
}

/// Three masses between stops, one of them pressed on its own, with blows in the middle of steps.
fn masses() -> Scene {
    let mut scene = chain(3, 150.0, 4e-3).with_duration(2.0);
    for i in 0..3 {
        scene = scene.with_wall(at(Wall::upper(&format!("u{i}"), 3e-3).with_restitution(0.5), Row::dof(i)));
        scene = scene.with_wall(at(Wall::lower(&format!("l{i}"), -4e-3).with_restitution(0.5), Row::dof(i)));
    }
    scene.probes = (0..3).map(|i| Probe { name: format!("mass-{i}"), at: Row::dof(i) }).collect();
    scene
        .with_load(on(Load::harmonic(3.0, 3.0, 0.0), 0))
        .with_load(on(Load::constant(2.0), 2))
        .with_load(on(Load::impulse(0.02, 0.51237), 1))
}

#[test]
fn the_recorded_impulses_close_the_momentum_balance_of_any_run() {
    for (name, scene) in [("pressed", pressed()), ("source", source(0.8, 0.8).with_duration(5.0)), ("masses", masses())]
    {
        let others = [Scheme::Located, Scheme::GeneralizedAlpha { rho: 0.0 }, Scheme::Event];
        for scheme in schemes().into_iter().chain(others) {
            // Newmark gains energy without end.
            if scheme == Scheme::Newmark && name != "pressed" {
                continue;
            }
            for h in [2e-3, 2e-4] {
                let mut options = Options::with_step(h);
                options.time.sample = Some(h);
                let run = run(&scene, &scheme, &options).expect("a run");
                let seen = momentum(&scene, &run.trajectory).expect("a probe on every mass");
                // The rules' weights differ from the trapezoid's at the ends of the run, by one
                // step at each; and each contact may shift the place, whose velocity the damper
                // feels, by a step: c h v of an impact of m v.
                let impacts = run.trajectory.contacts().len() as f64;
                let damper = if name == "pressed" { 20.0 * 1e-3 } else { 1.2 * 1e-2 };
                let allowed = 2.0 * seen.step_n_s.min(h * 40.0) + impacts * damper * h * 10.0 + 1e-11;
                println!("{name} {scheme} h = {h}: {seen:?}, {impacts} contacts, allowed {allowed:e}");
                assert!(seen.residual_n_s <= allowed, "{name}, {scheme}, h = {h}: {seen:?}, not {allowed:e}");
                assert!(allowed < 0.05 * seen.exchanged_n_s, "{name}, {scheme}: a test of nothing, {seen:?}");
            }
        }
    }
}

#[test]
fn an_impulse_column_that_is_short_of_what_the_wall_gave_is_seen() {
    // Half of the wall's impulses are another wall's, which stands where nothing is met.
    let scene = pressed();
    let run = run(&scene, &MOREAU_JEAN, &Options::with_step(1e-3)).expect("a run");
    let moved = Scene { walls: vec![at(Wall::upper("stop", 1e-3), Row::new(vec![(0, 0.5)]))], ..scene.clone() };
    let seen = momentum(&moved, &run.trajectory).expect("a probe");
    // Half of 25 N over ten seconds.
    assert!((seen.residual_n_s - 125.0).abs() < 2.0, "{seen:?}");
    assert!(momentum(&scene, &run.trajectory).expect("a probe").residual_n_s < 0.1);
}

/// The findings of a judge that is told `share` of the recorded impulses, and is shown steps with
/// `shown` of the walls' impulses.
fn heard(scene: &Scene, scheme: &Scheme, h: f64, shown: f64, share: f64) -> Vec<Finding> {
    let mut stepper = Stepper::new(scene, scheme, h).expect("a stepper");
    let start = stepper.state();
    let mut judge = Judge::new(stepper.scene(), stepper.contract(), h, &start.q, &start.v);
    let mut sums = vec![0.0; scene.walls.len()];
    for _ in 0..(scene.duration / h).round() as u64 {
        let step = stepper.step().expect("a step");
        let impulse: Vec<f64> = step.impulse.iter().map(|p| shown * p).collect();
        sums.iter_mut().zip(&impulse).for_each(|(sum, p)| *sum += share * p);
        let mut altered = step;
        altered.impulse = &impulse;
        judge.observe(&altered);
    }
    judge.hear(&sums);
    judge.findings()
}

fn on_impulses(findings: &[Finding]) -> bool {
    findings.iter().any(|finding| finding.refuted == Refuted::Impulses)
}

#[test]
fn impulses_that_do_not_carry_the_momentum_are_a_finding_whatever_each_step_says() {
    for scheme in schemes().into_iter().chain([0.0, 1.0].map(|rho| Scheme::GeneralizedAlpha { rho })) {
        for (name, scene) in [("pressed", pressed()), ("masses", masses())] {
            // Newmark throws the body back and forth and gains energy without end: what a step may
            // miss of such forces is much.
            if scheme == Scheme::Newmark {
                continue;
            }
            assert_eq!(heard(&scene, &scheme, 1e-3, 1.0, 1.0), [], "{name}, {scheme}");
            // The steps are right, but the table is not: one part in ten thousand is missing.
            assert!(on_impulses(&heard(&scene, &scheme, 1e-3, 1.0, 0.9999)), "{name}, {scheme}");
            // The table and the steps agree, and both are short by a tenth: the states tell, but
            // where a stiff spring stands for the wall, whose force over one step is as much as the
            // few blows of a short run.
            if name == "pressed" || !matches!(scheme, Scheme::Penalty { .. }) {
                assert!(on_impulses(&heard(&scene, &scheme, 1e-3, 0.9, 1.0)), "{name}, {scheme}");
            }
        }
        // A former defect: a body resting under 25 N of which the wall's impulses counted 24.19, at
        // a step of 2 ms.
        assert!(
            matches!(scheme, Scheme::Newmark | Scheme::Penalty { .. })
                || on_impulses(&heard(&pressed(), &scheme, 2e-3, 24.19 / 25.0, 1.0)),
            "{scheme}"
        );
    }
}

#[test]
fn steps_whose_own_balance_closes_on_wrong_forces_are_refuted_by_the_end_states() {
    // A scheme that counts the load short in its own rule and the wall's force with it: each step's
    // balance holds under that load, and the judge, which knows the load, sees what the run as a
    // whole leaves open.
    let scene = pressed();
    let short = Scene { loads: vec![Load::constant(34.19)], ..scene.clone() };
    let mut stepper = Stepper::new(&short, &MOREAU_JEAN, 1e-3).expect("a stepper");
    let start = stepper.state();
    let mut judge = Judge::new(&scene, stepper.contract(), 1e-3, &start.q, &start.v);
    for _ in 0..10_000 {
        judge.observe(&stepper.step().expect("a step"));
    }
    let findings = judge.findings();
    let open = findings.iter().find(|finding| finding.refuted == Refuted::Impulses).expect("a finding");
    // 0.81 N over ten seconds, of some 600 N s that load, spring and wall exchange.
    assert!(open.residual > 5e-3 && open.wall.is_none(), "{open:?}");
}

#[test]
fn a_table_that_begins_or_ends_with_a_step_gives_its_whole_impulse() {
    // A free mass takes ∫ f dt, wherever in a step the load jumps; a scheme that sums the loads at
    // the ends of the steps is exact for a constant one. On the grid, between two instants of it,
    // and where the product k·h and the table's time differ in the last digit.
    let h = 1e-2;
    for (from, to) in [(0.0, 0.3), (0.0, 0.3037), (0.11, 0.29), (0.1141, 0.2873), (0.07, 0.7), (0.113, 0.118)] {
        let table = Table::new(vec![from, to], vec![3.0, 3.0]).unwrap();
        let impulse = 3.0 * (to - from);
        for scheme in schemes().into_iter().chain([Scheme::Located]) {
            for n in [1, 2] {
                let structure = || {
                    let pair = |x: f64| Symmetric::diagonal(&[x; 2]);
                    Scene::structure(Structure { mass: pair(2.0), damping: pair(0.0), stiffness: pair(0.0) })
                };
                let scene = if n == 1 { Scene::oscillator(2.0, 0.0, 0.0) } else { structure() };
                // A wall out of reach, which a penalty replaces by a spring.
                let scene = scene.with_load(on(Load::table(table.clone()), n - 1)).with_wall(Wall::upper("far", 50.0));
                let mut stepper = Stepper::new(&scene, &scheme, h).unwrap();
                let start = stepper.state();
                let mut judge = Judge::new(stepper.scene(), stepper.contract(), h, &start.q, &start.v);
                while stepper.time() < 199.5 * h {
                    judge.observe(&stepper.step().unwrap());
                }
                // Rounding of 200 steps; generalized-α has forgotten the jump to 1e-12 by then.
                let found = 2.0 * stepper.state().v[n - 1];
                let what = format!("{scheme} on {n}: {from} to {to} s: {found}, not {impulse} N s");
                assert!((found - impulse).abs() < 1e-11, "{what}");
                assert_eq!(judge.findings(), [], "{what}");
            }
        }
    }
}

#[test]
fn at_the_end_of_a_table_and_of_the_run_its_impulse_is_complete() {
    // A table as long as the run: the last step has its last row, not the 0 N after it. The filter
    // of generalized-α has a jump of the force in its memory, whose share here is 0.009 h F.
    for scheme in schemes().into_iter().chain([Scheme::Located]) {
        let table = Table::new(vec![0.0, 0.5], vec![2.0, 4.0]).unwrap();
        let scene = Scene::oscillator(1.0, 0.0, 0.0).with_load(Load::table(table)).with_wall(Wall::upper("far", 50.0));
        for h in [0.01, 0.0625] {
            let mut stepper = Stepper::new(&scene, &scheme, h).unwrap();
            while stepper.time() < 0.5 - 0.5 * h {
                stepper.step().unwrap();
            }
            // With the weight θ of its ends a step takes (θ − ½) h² of the ramp's 4 N/s more.
            let theta = match scheme {
                Scheme::MoreauJean { theta } => theta,
                Scheme::ImplicitEuler | Scheme::Penalty { integrator: Integrator::ImplicitEuler, .. } => 1.0,
                _ => 0.5,
            };
            let ramp = (theta - 0.5) * h * 2.0;
            let allowed = if matches!(scheme, Scheme::GeneralizedAlpha { .. }) { 0.1 * h } else { 1e-13 };
            let found = stepper.state().v[0];
            assert!((found - 1.5 - ramp).abs() < allowed, "{scheme}, h = {h}: {found}");
        }
    }
}

#[test]
fn a_loop_over_steps_without_contact_stops_for_a_jump_of_the_load() {
    let table = Table::new(vec![0.1, 0.3], vec![5.0, -2.0]).unwrap();
    let scene = Scene::oscillator(1.0, 0.1, 30.0)
        .with_load(Load::table(table))
        .with_wall(Wall::upper("far", 50.0))
        .with_initial(&[0.01], &[0.0]);
    for scheme in schemes() {
        let [mut one, mut loops] = [0, 1].map(|_| Stepper::new(&scene, &scheme, 1e-3).unwrap());
        (0..500).for_each(|_| _ = one.step().unwrap());
        (0..10).for_each(|_| _ = loops.advance_quiet(50).unwrap());
        assert_eq!(loops.time(), one.time());
        // To the last bit.
        assert_eq!(loops.state(), one.state(), "{scheme}");
    }
}
