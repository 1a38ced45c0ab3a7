//! Round holes in the schemes that bound displacements: closed forms, the motion between planar
//! walls, what holds of every scene, and the judge.

use crate::draws::{cases, seed};
use crate::pendulum::{GAP, IMPULSE, PERIOD, WORK, pendulum};
use crate::random_structures::Draws;
use crate::rubbing::{Sums, body, hole, isotropic, load, random_scene, rotating, turned, with, with_flats};
use crate::steps::{HoleStep, beside_line, follow, judged};
use signorini::{Finding, Load, Refuted, Row, Scene, Scheme, Stepper, Wall, equilibrium, heading};

const EULER: Scheme = Scheme::ImplicitEuler;
const ALPHA: Scheme = Scheme::GeneralizedAlpha { rho: 0.8 };
const BOTH: [Scheme; 2] = [EULER, ALPHA];

#[test]
fn motion_on_a_diameter_is_that_between_two_walls() {
    for scheme in BOTH {
        // The last one is damped far beyond critical: the damper feels the acceleration of a step,
        // and whether a wall pushes in it depends on that.
        let cases = [(0.0, 0.3, 0.6, 5.0), (35.0, 0.8, 0.6, 5.0), (215.0, 0.0, 0.6, 5.0), (35.0, 0.5, 6e3, 200.0)];
        for (degrees, e, damping, force) in cases {
            let [c, s] = heading(degrees);
            let loads = [Load::harmonic(force, 6.0, 0.3), Load::constant(0.02 * damping), Load::impulse(0.3, 0.123_46)];
            let mut line = Scene::oscillator(1.2, damping, 900.0)
                .with_wall(Wall::upper("upper", 2e-3).with_restitution(e))
                .with_wall(Wall::lower("lower", -2e-3).with_restitution(e))
                .with_initial(&[1e-3], &[0.2]);
            let along = Row::new(vec![(0, c), (1, s)]);
            let mut round = with(isotropic(1.2, damping, 900.0), hole("hole", body(), 2e-3, e, 0.0))
                .with_initial(&[1e-3 * c, 1e-3 * s], &[0.2 * c, 0.2 * s]);
            for one in loads {
                line = line.with_load(one.clone());
                round = round.with_load(load(one, along.clone()));
            }
            // Roundings of the gap, and over h of the velocity.
            let within = [1e-13 * 2e-3 * 1e3, 1e-10, 1e-10];
            let pushes = beside_line([&line, &round], [c, s], &scheme, 8000, within);
            assert!(pushes > 10, "{e}: {pushes}");
        }
    }
}

#[test]
fn a_plane_that_nothing_moves_stays_at_rest() {
    let scene = with(isotropic(1.0, 0.2, 400.0), hole("hole", body(), 1e-3, 0.5, 0.0))
        .with_load(load(Load::harmonic(3.0, 7.0, 0.0), Row::dof(0)));
    for scheme in BOTH {
        let mut pushed = 0;
        follow(&scene, &scheme, 1e-4, 10_000, |step| {
            assert_eq!((step.q[1], step.v[1]), (0.0, 0.0));
            pushed += u32::from(step.impulse[0] > 0.0);
        });
        assert!(pushed > 10);
    }
}

#[test]
fn a_turned_scene_has_the_turned_motion() {
    let scene = with(isotropic(1.0, 0.3, 200.0), hole("hole", body(), 1e-3, 0.5, 0.0));
    let scene = with_flats(scene, "flats", body(), &[(10.0, 0.9e-3), (130.0, 1.1e-3), (250.0, 0.8e-3)], 0.4, 0.0)
        .with_load(load(Load::harmonic(4.0, 9.0, 0.2), Row::new(vec![(0, 1.0), (1, 0.4)])))
        .with_initial(&[0.1e-3, -0.2e-3], &[0.05, 0.02]);
    let (other, hole) = (turned(&scene, 37.0), scene.wall_index("hole").unwrap());
    let [c, s] = heading(37.0);
    for scheme in BOTH {
        let mut beside = Stepper::new(&other, &scheme, 1e-4).unwrap();
        let mut pushed = 0;
        follow(&scene, &scheme, 1e-4, 2000, |step| {
            let image = beside.step().unwrap();
            let back = [c * image.q[0] + s * image.q[1], c * image.q[1] - s * image.q[0]];
            assert!((back[0] - step.q[0]).hypot(back[1] - step.q[1]) < 1e-9 * 1e-3, "{}", step.end);
            pushed += u32::from(step.impulse[hole] > 0.0);
        });
        assert!(pushed > 20, "{pushed}");
    }
}

#[test]
fn a_pressed_body_rests_with_the_force_of_statics() {
    // Unequal and coupled stiffness in an offset hole: 6.013 971 811 554 549 N from the secular
    // equation.
    let off = hole("hole", body(), 1e-3, 0.5, 0.0).with_centre([0.3e-3, 0.1e-3]);
    let entries = [(0, 0, 5000.0), (1, 0, 800.0), (1, 1, 2000.0)];
    let stiffness = signorini::linear::Symmetric::from_entries(2, entries);
    let mut scene = with(isotropic(1.3, 2.0, 0.0), off)
        .with_load(load(Load::constant(4.0), Row::dof(0)))
        .with_load(load(Load::constant(-7.0), Row::dof(1)));
    if let signorini::System::Structure(structure) = &scene.system {
        let mut structure = signorini::Structure::clone(structure);
        structure.stiffness = stiffness;
        scene.system = structure.into();
    }
    let q = equilibrium(&scene).unwrap();
    let scene = scene.with_initial(&q, &[0.0; 2]);
    for scheme in BOTH {
        follow(&scene, &scheme, 1e-3, 500, |step| {
            let force = step.impulse[0] / 1e-3;
            // Some 1e-15 m of the start times M/h² of 1e6 N/m.
            assert!((force - 6.013_971_811_554_549).abs() < 1e-8, "{}: {force}", step.end);
            assert!(step.q.iter().zip(&q).all(|(a, b)| (a - b).abs() < 1e-14), "{}", step.end);
        });
    }
}

#[test]
fn implicit_euler_projects_a_free_body_onto_the_disk() {
    // Without springs the programme of a step is the projection of w + hv onto the disk.
    let gap = 2e-3;
    let scene = with(isotropic(1.3, 0.0, 0.0), hole("hole", body(), gap, 0.5, 0.0))
        .with_initial(&[0.5e-3, -0.3e-3], &[0.11, 0.07]);
    let (h, mut w, mut v) = (1e-4, [0.5e-3, -0.3e-3], [0.11, 0.07]);
    let mut speed = [0.0; 2];
    let stepper = follow(&scene, &EULER, h, 3000, |step| {
        let ahead = [w[0] + h * v[0], w[1] + h * v[1]];
        let distance = ahead[0].hypot(ahead[1]);
        let held = if distance > gap { ahead.map(|x| x * gap / distance) } else { ahead };
        v = [(held[0] - w[0]) / h, (held[1] - w[1]) / h];
        w = held;
        assert!((step.q[0] - w[0]).hypot(step.q[1] - w[1]) < 1e-12 * gap * 1e2, "{}", step.end);
        if step.index == 999 || step.index == 2999 {
            speed[usize::from(step.index == 2999)] = step.v[0].hypot(step.v[1]);
        }
    });
    // It arrives once and slides for ever, losing speed at the rate h v²/γ²: 1/v² grows by 2h/γ² t.
    let grown = (1.0 / speed[1].powi(2) - 1.0 / speed[0].powi(2)) / (2.0 * h / gap.powi(2) * 2000.0 * h);
    assert!((grown - 1.0).abs() < 1e-2, "{grown}");
    assert_eq!(stepper.open_contacts().len(), 1);
    assert!(stepper.counters().largest_turn_rad > 1e-3);
}

#[test]
fn a_body_pressed_round_a_hole_has_the_force_of_the_closed_form_in_the_limit() {
    let (gap, omega, lag) = (5e-3_f64, std::f64::consts::TAU * 5.0, 0.010_472_166_918_182_78_f64);
    let scene = rotating(with(isotropic(1.0, 0.2, 100.0), hole("hole", body(), gap, 0.3, 0.0)), 3.0, 5.0)
        .with_initial(&[gap * lag.cos(), -gap * lag.sin()], &[gap * omega * lag.sin(), gap * omega * lag.cos()]);
    let error = |h: f64| {
        let (mut sum, mut count) = (0.0, 0_u32);
        follow(&scene, &EULER, h, (2.0 / h) as u64, |step| {
            // The first half leads to the lag of this step.
            if step.end > 1.0 {
                sum += step.impulse[0] / h;
                count += 1;
            }
        });
        (sum / f64::from(count) / 7.434_637_702_628_067 - 1.0).abs()
    };
    let [coarse, fine] = [1e-4, 1e-5].map(error);
    // Order 1: the scheme damps what slides.
    let order = (coarse / fine).log10();
    assert!(fine < 1e-2 && order > 0.9, "{coarse:e} {fine:e}");
}

#[test]
fn faultless_runs_are_not_accused() {
    for scheme in BOTH {
        let (mut pushed, first) = (0, seed(0));
        for seed in 0..cases(60_u64) {
            let mut draws = Draws::new(first + seed);
            let mut scene = random_scene(&mut draws, 0.0);
            let n = scene.initial.q.len();
            for _ in 0..draws.below(4) {
                let load_of = if draws.chance(0.5) {
                    Load::impulse(draws.between(-0.1, 0.1), draws.between(0.0, 0.05))
                } else {
                    Load::harmonic(draws.between(0.0, 5.0), draws.between(1.0, 50.0), 0.0)
                };
                scene = scene.with_load(load(load_of, Row::dof(draws.below(n))));
            }
            let h = [1e-4, 1e-3][draws.below(2)];
            let findings = judged(&scene, &scheme, (h, 300), |step, pushes, _| {
                pushed += pushes.normal.iter().filter(|normal| **normal != [0.0; 2]).count();
                for hole in scene.holes() {
                    let [y, z] = hole.offset(step.q);
                    assert!(y.hypot(z) <= hole.gap * (1.0 + 1e-9), "seed {seed}: {}", y.hypot(z) / hole.gap);
                    assert!(pushes.impulse[hole.index] >= 0.0);
                }
            });
            assert_eq!(findings, [], "{scheme:?}, seed {seed}, h = {h}");
        }
        assert!(pushed > 1000, "{pushed}");
    }
}

#[test]
fn every_fault_of_a_hole_is_found() {
    let scene = rotating(with(isotropic(1.0, 0.2, 100.0), hole("hole", body(), 5e-3, 0.4, 0.0)), 3.0, 5.0);
    let found = |findings: &[Finding], refuted: Refuted| {
        let one = findings.iter().find(|finding| finding.refuted == refuted);
        one.unwrap_or_else(|| panic!("{refuted:?}: {findings:?}")).residual
    };
    for scheme in BOTH {
        let with_fault = |fault: &dyn Fn(&mut HoleStep, &mut Vec<f64>)| {
            judged(&scene, &scheme, (1e-4, 3000), |step, pushes, q| {
                if step.index == 2500 {
                    assert!(pushes.impulse[0] > 0.0);
                    pushes.alter(0, |hole| fault(hole, q));
                }
            })
        };
        // The normal turned: a force of that share is askew, and the balance misses as much. The
        // scale is the force of the first impact, of some 1000 N.
        let findings = with_fault(&|hole, _| {
            let ([y, z], turn) = (hole.normal, 1e-2);
            hole.normal = [y - turn * z, z + turn * y];
        });
        assert!(found(&findings, Refuted::Normal) > 1e-6, "{findings:?}");
        assert!(found(&findings, Refuted::MomentumBalance) > 1e-6, "{findings:?}");
        // A hole that pulls, and one that is passed by a part in 1e4 of its gap.
        let findings = with_fault(&|hole, _| hole.impulse = -hole.impulse);
        assert!(found(&findings, Refuted::Tension) > 1e-3, "{findings:?}");
        let findings = with_fault(&|_, q| q.iter_mut().for_each(|q| *q *= 1.0 + 1e-4));
        assert!(found(&findings, Refuted::Penetration) > 0.9e-4, "{findings:?}");
        // One that pushes from within.
        let findings = with_fault(&|_, q| q.iter_mut().for_each(|q| *q *= 1.0 - 1e-3));
        assert!(found(&findings, Refuted::Complementarity) > 1e-4, "{findings:?}");
    }
}

#[test]
fn friction_is_refused_with_the_reason() {
    let scene = with(isotropic(1.0, 0.2, 100.0), hole("hole", body(), 5e-3, 0.4, 0.2));
    for scheme in BOTH {
        let error = Stepper::new(&scene, &scheme, 1e-4).unwrap_err();
        assert!(error.is_request() && error.to_string().contains("or no friction"), "{error}");
    }
}

#[test]
fn generalized_alpha_keeps_its_speed_round_a_hole() {
    let scene = pendulum();
    let error = |steps: u64| {
        let mut sums = Sums::default();
        follow(&scene, &ALPHA, PERIOD / steps as f64, steps, |step| {
            assert!(step.q[0].hypot(step.q[1]) <= GAP * (1.0 + 1e-13), "{}", step.end);
            sums.observe(&scene, step);
        });
        [sums.work / WORK - 1.0, sums.impulse / IMPULSE - 1.0]
    };
    let [coarse, fine] = [2000, 8000].map(error);
    // Order 2: 2.2e-6 and 1.4e-7.
    for k in [0, 1] {
        let order = (coarse[k] / fine[k]).abs().log2() / 2.0;
        assert!(coarse[k].abs() < 5e-6 && (1.8..2.2).contains(&order), "{coarse:?} {fine:?}");
    }
}

#[test]
fn generalized_alpha_settles_after_infinitely_many_impacts() {
    const IMPULSE: f64 = 0.702_536_953_348_094_1;
    const WORK: f64 = 0.023_886_256_413_835_2;
    let scene = with(isotropic(1.3, 0.0, 0.0), hole("hole", body(), 2e-3, 0.5, 0.0))
        .with_initial(&[0.5e-3, -0.3e-3], &[0.11, 0.07]);
    let error = |h: f64, steps: u64| {
        let (mut sums, mut speed) = (Sums::default(), 0.0);
        follow(&scene, &ALPHA, h, steps, |step| {
            sums.observe(&scene, step);
            speed = step.v[0].hypot(step.v[1]);
        });
        assert!((speed / 0.034 - 1.0).abs() < 400.0 * h, "h = {h}: {speed}");
        [(sums.work / WORK - 1.0).abs(), (sums.impulse / IMPULSE - 1.0).abs()]
    };
    let [coarse, fine] = [(1e-5, 50_000), (1e-6, 500_000)].map(|(h, steps)| error(h, steps));
    // Order 1 through impacts: 6e-4 and 6e-5.
    assert!(coarse.iter().all(|e| *e < 1e-3) && fine.iter().all(|e| *e < 1e-4), "{coarse:?} {fine:?}");
}

#[test]
fn generalized_alpha_presses_a_body_round_a_hole_with_the_exact_force() {
    let (gap, omega, lag) = (5e-3_f64, std::f64::consts::TAU * 5.0, 0.010_472_166_918_182_78_f64);
    let scene = rotating(with(isotropic(1.0, 0.2, 100.0), hole("hole", body(), gap, 0.3, 0.0)), 3.0, 5.0)
        .with_initial(&[gap * lag.cos(), -gap * lag.sin()], &[gap * omega * lag.sin(), gap * omega * lag.cos()]);
    let error = |h: f64| {
        let mut sum = 0.0;
        follow(&scene, &ALPHA, h, (2.0 / h) as u64, |step| sum += step.impulse[0]);
        (sum / 2.0 / 7.434_637_702_628_067 - 1.0).abs()
    };
    let [coarse, fine] = [1e-3, 1e-4].map(error);
    // Order 2: 2.4e-4 and 2.4e-6.
    assert!(coarse < 3e-4 && fine < 3e-6, "{coarse:e} {fine:e}");
}

#[test]
fn a_body_that_crosses_the_hole_in_a_step_rebounds_as_between_two_walls() {
    // On a diameter, from one side to the other within a step: the middle of the step is the
    // centre, to rounding or exactly.
    let h = 0.02;
    for degrees in [0.0, 35.0, 90.0, 215.0] {
        for e in [0.0, 0.4, 1.0] {
            for speed in [0.1, 0.35, 2.0] {
                let [c, s] = heading(degrees);
                let line = Scene::oscillator(1.0, 0.0, 2300.0)
                    .with_wall(Wall::upper("upper", 7e-4).with_restitution(e))
                    .with_wall(Wall::lower("lower", -7e-4).with_restitution(e))
                    .with_initial(&[0.0], &[speed]);
                let round = with(isotropic(1.0, 0.0, 2300.0), hole("hole", body(), 7e-4, e, 0.0))
                    .with_initial(&[0.0; 2], &[speed * c, speed * s]);
                let mut beside = Stepper::new(&line, &ALPHA, h).unwrap();
                follow(&round, &ALPHA, h, 50, |step| {
                    let other = beside.step().unwrap();
                    let [w, v] = [step.q, step.v].map(|x| c * x[0] + s * x[1]);
                    // Roundings of the gap, and over h of the velocity; 50 steps add them up.
                    let what = format!("{degrees}°, e = {e}, {speed} m/s, t = {}", step.end);
                    assert!((w - other.q[0]).abs() < 1e-15, "{what}: {w} for {}", other.q[0]);
                    assert!((v - other.v[0]).abs() < 1e-13 * speed, "{what}: {v} for {}", other.v[0]);
                });
            }
        }
    }
}
