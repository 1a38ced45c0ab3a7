//! The penalty in round holes: what it conserves, its limits, planar walls along a diameter, the
//! judge.

use crate::random_structures::Draws;
use crate::rubbing::{body, change_hole, hole, isotropic, load, random_scene, rotating, turned, with};
use crate::steps::{HoleStep, Pushes, beside_line, follow};
use signorini::residual::Judge;
use signorini::study::compare::compare;
use signorini::{
    Finding, Integrator, Load, Method, Options, PenaltyLaw, Refuted, Row, Scene, Scheme, Stepper, Wall, heading, run,
};

fn penalty(law: PenaltyLaw) -> Scheme {
    Scheme::Penalty { law, integrator: Integrator::DiscreteGradient }
}

fn linear(stiffness: f64, damping: f64) -> PenaltyLaw {
    PenaltyLaw::Linear { stiffness, damping }
}

const GAP: f64 = 5e-3;

/// Both laws, as stiff as each other at the circle of [`GAP`]: (2γ)²/ε = k.
fn both(stiffness: f64) -> [PenaltyLaw; 2] {
    [linear(stiffness, 0.0), PenaltyLaw::Quartic { epsilon: 4.0 * GAP * GAP / stiffness }]
}

/// A free body of 1 kg in a hole that is off by a fifth of its gap.
fn free() -> Scene {
    let off = hole("hole", body(), GAP, 1.0, 0.0).with_centre([1e-3, 0.5e-3]);
    with(isotropic(1.0, 0.0, 0.0), off).with_initial(&[0.5e-3, 0.0], &[0.3, 0.17])
}

#[test]
fn energy_and_angular_momentum_are_kept_at_any_step() {
    let scene = free();
    let about = |q: &[f64], v: &[f64]| (q[0] - 1e-3) * v[1] - (q[1] - 0.5e-3) * v[0];
    let (energy, moment) = (0.5 * (0.3_f64.powi(2) + 0.17_f64.powi(2)), about(&[0.5e-3, 0.0], &[0.3, 0.17]));
    for law in both(1e6) {
        // A contact lasts 3 ms: from 60 steps a contact to about one.
        for h in [5e-5, 3e-3] {
            let (mut apart, mut pushed, mut clear) = ([0.0_f64; 2], 0, 0);
            follow(&scene, &penalty(law), h, 40_000, |step| {
                pushed += u32::from(step.impulse[0] > 0.0);
                let inside = (step.q[0] - 1e-3).hypot(step.q[1] - 0.5e-3) < GAP;
                apart[0] = apart[0].max((about(step.q, step.v) / moment - 1.0).abs());
                if inside {
                    clear += 1;
                    let kinetic = 0.5 * (step.v[0].powi(2) + step.v[1].powi(2));
                    apart[1] = apart[1].max((kinetic / energy - 1.0).abs());
                }
            });
            assert!(pushed > 1000 && clear > 1000, "{law}, {h}: {pushed}, {clear}");
            // Roundings of thousands of contacts: of the place over its way, and of the velocity.
            assert!(apart[0] < 1e-11 && apart[1] < 1e-11, "{law}, {h}: {apart:?}");
        }
    }
}

#[test]
fn motion_on_a_diameter_is_that_between_two_penalised_walls() {
    for law in [both(2e5)[0], both(2e5)[1], linear(2e5, 40.0)] {
        for degrees in [0.0, 35.0, 215.0] {
            let [c, s] = heading(degrees);
            let line = Scene::oscillator(1.2, 0.6, 900.0)
                .with_wall(Wall::upper("upper", GAP))
                .with_wall(Wall::lower("lower", -GAP))
                .with_load(Load::harmonic(12.0, 5.0, 0.3))
                .with_load(Load::impulse(0.3, 0.123_46))
                .with_initial(&[1e-3], &[0.2]);
            let along = Row::new(vec![(0, c), (1, s)]);
            let round = with(isotropic(1.2, 0.6, 900.0), hole("hole", body(), GAP, 0.5, 0.0))
                .with_load(load(Load::harmonic(12.0, 5.0, 0.3), along.clone()))
                .with_load(load(Load::impulse(0.3, 0.123_46), along))
                .with_initial(&[1e-3 * c, 1e-3 * s], &[0.2 * c, 0.2 * s]);
            // Roundings, which each contact amplifies a little.
            let pushes = beside_line([&line, &round], [c, s], &penalty(law), 6000, [1e-12, 1e-9, 1e-9]);
            assert!(pushes > 100, "{law}, {degrees}: {pushes}");
        }
    }
}

/// The stiffer the spring, the closer to the rigid hole of restitution 1, whose exact motion is
/// known: by the delay of half a period of the spring, so by 1/√k.
#[test]
fn stiffer_springs_approach_the_rigid_hole() {
    let scene = free().with_duration(0.06);
    let mut exact = Stepper::new(&scene, &Scheme::Event, 1.0).unwrap();
    while exact.time() < 0.06 {
        exact.step().unwrap();
    }
    let exact = exact.state();
    for which in [0, 1] {
        let error = |stiffness: f64| {
            // 60 steps a contact.
            let steps = (0.06 * stiffness.sqrt() / std::f64::consts::PI * 60.0).round();
            let mut end = [0.0; 2];
            follow(&scene, &penalty(both(stiffness)[which]), 0.06 / steps, steps as u64, |step| {
                end = [step.q[0], step.q[1]];
            });
            (end[0] - exact.q[0]).hypot(end[1] - exact.q[1])
        };
        let [soft, stiff] = [1e7, 1e9].map(error);
        let ratio = soft / stiff;
        assert!(stiff < 0.05 * GAP && (8.0..12.5).contains(&ratio), "{which}: {soft:e} {stiff:e}");
    }
}

/// A circular orbit beyond the gap of an elastic ring, which the penalty leaves as it is: m ω² r =
/// k r + k_a (r − γ).
#[test]
fn a_circular_orbit_in_a_ring_is_followed_with_order_2() {
    let (radius, rate) = (0.03, 58.594_652_770_823_15);
    let scene = with(isotropic(100.0, 0.0, 1e4), hole("ring", body(), 0.02, 0.0, 0.0).with_elasticity(1e6, 0.0))
        .with_initial(&[radius, 0.0], &[0.0, radius * rate]);
    assert!((100.0 * rate * rate * radius - (1e4 * radius + 1e6 * 0.01_f64)).abs() < 1e-7, "the orbit itself");
    let error = |h: f64| {
        let (mut force, mut out) = (0.0_f64, 0.0_f64);
        follow(&scene, &penalty(linear(1e3, 0.0)), h, (1.0 / h) as u64, |step| {
            force = force.max((step.impulse[0] / h / 1e4 - 1.0).abs());
            out = out.max((step.q[0].hypot(step.q[1]) / radius - 1.0).abs());
        });
        [force, out]
    };
    let [coarse, fine] = [1e-3, 1e-4].map(error);
    let order = (coarse[0] / fine[0]).log10();
    assert!(fine[0] < 1e-5 && (1.9..2.1).contains(&order), "{coarse:?} {fine:?}");
    // Energy and angular momentum fix the radius: it is kept to roundings.
    assert!(coarse[1] < 1e-13 && fine[1] < 1e-13, "{coarse:?} {fine:?}");
}

#[test]
fn a_turned_scene_has_the_turned_motion() {
    let scene = with(isotropic(1.0, 0.3, 200.0), hole("hole", body(), 1e-3, 0.0, 0.0))
        .with_load(load(Load::harmonic(4.0, 9.0, 0.2), Row::new(vec![(0, 1.0), (1, 0.4)])))
        .with_initial(&[0.1e-3, -0.2e-3], &[0.05, 0.02]);
    let (other, scheme, [c, s]) = (turned(&scene, 37.0), penalty(linear(3e4, 1.0)), heading(37.0));
    let mut beside = Stepper::new(&other, &scheme, 1e-4).unwrap();
    let mut pushed = 0;
    follow(&scene, &scheme, 1e-4, 2000, |step| {
        let image = beside.step().unwrap();
        let back = [c * image.q[0] + s * image.q[1], c * image.q[1] - s * image.q[0]];
        assert!((back[0] - step.q[0]).hypot(back[1] - step.q[1]) < 1e-12, "{}", step.end);
        pushed += u32::from(step.impulse[0] > 0.0);
    });
    assert!(pushed > 20, "{pushed}");
}

#[test]
fn faultless_runs_are_not_accused() {
    let mut pushed = 0;
    for seed in 0..60 {
        let mut draws = Draws::new(seed);
        let scene = random_scene(&mut draws, 0.0);
        let n = scene.initial.q.len();
        let blow = Load::impulse(draws.between(-0.1, 0.1), draws.between(0.0, 0.02));
        let h = [1e-4, 1e-3][seed as usize % 2];
        let scene = scene.with_load(load(blow, Row::dof(draws.below(n)))).with_duration(300.0 * h);
        let damping = if draws.chance(0.5) { 0.0 } else { draws.between(0.0, 100.0) };
        let law = linear(draws.between(1e3, 1e6), damping);
        let run = run(&scene, &penalty(law), &Options::with_step(h)).unwrap_or_else(|error| panic!("{seed}: {error}"));
        assert_eq!(run.findings, [], "seed {seed}");
        pushed += run.trajectory.contacts().len();
    }
    assert!(pushed > 100, "{pushed}");
}

#[test]
fn faults_of_a_penalised_hole_are_found() {
    let law = linear(5e3, 2.0);
    let scene = rotating(with(isotropic(1.0, 0.2, 100.0), hole("hole", body(), GAP, 0.0, 0.0)), 3.0, 5.0);
    let seen = scene.penalised(law).unwrap();
    let with_fault = |fault: &dyn Fn(&mut HoleStep)| {
        let mut stepper = Stepper::new(&scene, &penalty(law), 1e-3).unwrap();
        let state = stepper.state();
        let mut judge = Judge::new(&seen, stepper.contract(), 1e-3, &state.q, &state.v);
        for index in 0..1500 {
            let mut step = stepper.step().unwrap();
            let mut pushes = Pushes::of(&step);
            if index == 1400 {
                assert!(pushes.impulse[0] > 0.0);
                pushes.alter(0, fault);
            }
            pushes.show(&mut step);
            judge.observe(&step);
        }
        judge.findings()
    };
    let found = |findings: &[Finding], refuted: Refuted| {
        let one = findings.iter().find(|finding| finding.refuted == refuted);
        one.unwrap_or_else(|| panic!("{refuted:?}: {findings:?}")).residual
    };
    assert_eq!(with_fault(&|_| ()), []);
    let findings = with_fault(&|hole| hole.impulse *= 1.01);
    assert!(found(&findings, Refuted::WallLaw) > 1e-3, "{findings:?}");
    assert!(found(&findings, Refuted::MomentumBalance) > 1e-3, "{findings:?}");
    let findings = with_fault(&|hole| {
        let ([y, z], turn) = (hole.normal, 1e-2);
        hole.normal = [y - turn * z, z + turn * y];
    });
    assert!(found(&findings, Refuted::Normal) > 1e-3, "{findings:?}");
}

#[test]
fn other_integrators_and_friction_are_refused() {
    for integrator in [Integrator::Trapezoidal, Integrator::ImplicitEuler, Integrator::CentralDifference] {
        let error = Stepper::new(&free(), &Scheme::Penalty { law: linear(1e6, 0.0), integrator }, 1e-4).unwrap_err();
        assert!(error.is_request() && error.to_string().contains("expected discrete-gradient"), "{error}");
    }
    let mut rubs = free();
    rubs.walls[0].friction = 0.2.into();
    let error = Stepper::new(&rubs, &penalty(linear(1e6, 0.0)), 1e-4).unwrap_err();
    let expected = "expected moreau-jean, located or no friction: this scheme has no law of friction";
    assert!(error.is_request() && error.to_string().contains(expected), "{error}");
}

/// Forces, statistics and work of wear of a run are there as with every other scheme.
#[test]
fn a_run_shows_the_forces_of_the_hole() {
    let scene = rotating(with(isotropic(1.0, 0.2, 100.0), hole("hole", body(), GAP, 0.0, 0.0)), 3.0, 5.0);
    let run = run(&scene.with_duration(4.0), &penalty(linear(1e6, 10.0)), &Options::with_step(1e-4)).unwrap();
    assert_eq!(run.findings, []);
    let force = run.statistics.supports[0].force.unwrap();
    let [y, z] = &run.trajectory.hole_impulses()[0];
    let pushed = [y, z].map(|impulses| impulses.iter().sum::<f64>() / 4.0);
    assert!(force.mean_n > 0.1, "{force:?}");
    for (mean, pushed) in force.mean_vector_n.iter().zip(pushed) {
        assert!((mean - pushed).abs() < 1e-9, "{force:?} {pushed}");
    }
    assert!(run.statistics.wear[0].upper_figure && run.statistics.wear[0].work_rate_w > 0.0);
}

/// A comparison compares with the restitution that the hole asks for, and shows what each method
/// realises there.
#[test]
fn a_comparison_names_the_restitution_of_the_hole() {
    let scene = free();
    let mut scene = Scene { duration: 0.1, ..scene };
    change_hole(&mut scene, 0, |hole| hole.with_restitution(0.5));
    scene.probes.push(signorini::Probe { name: "y".into(), at: Row::dof(0) });
    let schemes = [Scheme::MoreauJean { theta: 0.5 }, penalty(linear(1e6, 0.0)), Scheme::ImplicitEuler];
    let time = Options::with_step(1e-4).time;
    let comparison = compare(&scene, &schemes.map(Method::new), &time, &|_| ()).unwrap();
    let said = |words: &str| comparison.findings.iter().any(|finding| finding.contains(words));
    assert!(said("the walls ask for e = 0.5") && said("implicit-euler on positions tends to e = 0"));
    assert!(!said("every wall has e = 1"), "{:?}", comparison.findings);
    let median = |row: usize| comparison.rows[row].restitution.map(|restitution| restitution.median);
    // Of the exact motion to rounding. In moreau-jean the normal turns within a step, in the
    // penalty within a contact, whose spring without dashpot gives all back; implicit-euler stays
    // and slides.
    let [jean, spring, exact] = [0, 1, 3].map(|row| median(row).unwrap());
    assert!((jean - 0.5).abs() < 1e-4 && (exact - 0.5).abs() < 1e-9, "{jean} {exact}");
    assert!((spring - 1.0).abs() < 1e-4 && median(2).is_none(), "{spring} {:?}", median(2));
}
