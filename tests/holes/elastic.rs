//! Elastic round holes: closed forms, planar walls along a diameter, the judge, and who refuses
//! them.

use crate::random_structures::Draws;
use crate::rubbing::{body, hole, isotropic, load, random_scene, rotating, turned, with};
use crate::steps::{HoleStep, beside_line, follow, judged};
use signorini::{Finding, Load, Refuted, Row, Scene, Scheme, Stepper, Wall, WallLaw, heading};

const JEAN: Scheme = Scheme::MoreauJean { theta: 0.5 };
const EULER: Scheme = Scheme::ImplicitEuler;
const BOTH: [Scheme; 2] = [JEAN, EULER];
const ALL: [Scheme; 3] = [JEAN, EULER, Scheme::Located];

fn ring(hole: Wall, stiffness: f64, damping: f64) -> Wall {
    hole.with_elasticity(stiffness, damping)
}

/// The body of 100 kg and 1e4 N/m in a ring of 1e6 N/m with a gap of 20 mm (SDND101 of code_aster,
/// in another direction and with a gap).
fn thrown() -> Scene {
    let [c, s] = heading(30.0);
    with(isotropic(100.0, 0.0, 1e4), ring(hole("ring", body(), 0.02, 0.0, 0.0), 1e6, 0.0))
        .with_initial(&[0.0, 0.0], &[c, s])
}

#[test]
fn a_radial_throw_has_the_depth_force_and_impulse_of_two_springs() {
    let error = |scheme: &Scheme, h: f64| {
        let scene = thrown();
        let (mut depth, mut force, mut impulse) = (0.0_f64, 0.0_f64, 0.0);
        let [c, s] = heading(30.0);
        follow(&scene, scheme, h, (0.06 / h).round() as u64, |step| {
            depth = depth.max(step.q[0].hypot(step.q[1]) - 0.02);
            force = force.max(step.impulse[0] / h);
            impulse += step.impulse[0];
            // Along the throw, up to roundings.
            assert!((s * step.q[0] - c * step.q[1]).abs() < 1e-14, "{}", step.end);
            if step.impulse[0] > 0.0 {
                assert!((step.normal[0][0] - c).abs() < 1e-12, "{:?}", step.normal[0]);
            }
        });
        [
            depth / 0.009_553_324_556_233_767 - 1.0,
            force / 9_553.324_556_233_767 - 1.0,
            impulse / 187.908_917_327_360_3 - 1.0,
        ]
    };
    let worst = |errors: [f64; 3]| errors.iter().fold(0.0_f64, |most, e| most.max(e.abs()));
    // The θ-method with θ = ½: order 2, but for the instant of contact.
    for scheme in [JEAN, Scheme::Located] {
        let [coarse, fine] = [1e-4, 1e-5].map(|h| worst(error(&scheme, h)));
        assert!(coarse < 2e-4 && fine < 2e-6, "{scheme}: {coarse:e} {fine:e}");
    }
    // Backward Euler damps, with order 1.
    let [coarse, fine] = [1e-5, 1e-6].map(|h| worst(error(&EULER, h)));
    let order = (coarse / fine).log10();
    assert!(fine < 2e-3 && (0.9..1.1).contains(&order), "{coarse:e} {fine:e}");
}

#[test]
fn a_circular_orbit_beyond_the_gap_keeps_its_radius_and_force() {
    let (radius, rate) = (0.03, 58.594_652_770_823_15);
    let scene = thrown().with_initial(&[radius, 0.0], &[0.0, radius * rate]);
    let error = |scheme: &Scheme, h: f64| {
        let (mut force, mut out, steps) = (0.0_f64, 0.0_f64, (1.0 / h) as u64);
        follow(&scene, scheme, h, steps, |step| {
            force = force.max((step.impulse[0] / h / 1e4 - 1.0).abs());
            out = out.max((step.q[0].hypot(step.q[1]) / radius - 1.0).abs());
        });
        [force, out]
    };
    for scheme in [JEAN, Scheme::Located] {
        let [coarse, fine] = [1e-3, 1e-4].map(|h| error(&scheme, h));
        for k in [0, 1] {
            let order = (coarse[k] / fine[k]).log10();
            assert!(fine[k] < 1e-4 && (1.9..2.1).contains(&order), "{scheme}: {coarse:?} {fine:?}");
        }
    }
}

#[test]
fn motion_on_a_diameter_is_that_between_two_elastic_walls() {
    for scheme in ALL {
        for (degrees, damping) in [(0.0, 0.0), (35.0, 40.0), (215.0, 400.0)] {
            let [c, s] = heading(degrees);
            let line = Scene::oscillator(1.2, 0.6, 900.0)
                .with_wall(Wall::upper("upper", 2e-3).with_elasticity(2e5, damping))
                .with_wall(Wall::lower("lower", -2e-3).with_elasticity(2e5, damping))
                .with_load(Load::harmonic(5.0, 6.0, 0.3))
                .with_load(Load::impulse(0.3, 0.123_46))
                .with_initial(&[1e-3], &[0.2]);
            let along = Row::new(vec![(0, c), (1, s)]);
            let round = with(isotropic(1.2, 0.6, 900.0), ring(hole("ring", body(), 2e-3, 0.0, 0.0), 2e5, damping))
                .with_load(load(Load::harmonic(5.0, 6.0, 0.3), along.clone()))
                .with_load(load(Load::impulse(0.3, 0.123_46), along))
                .with_initial(&[1e-3 * c, 1e-3 * s], &[0.2 * c, 0.2 * s]);
            let pushes = beside_line([&line, &round], [c, s], &scheme, 6000, [1e-12, 1e-9, 1e-9]);
            assert!(pushes > 100, "{pushes}");
        }
    }
}

#[test]
fn a_ring_that_hardly_yields_is_a_rigid_hole() {
    // implicit-euler does not see how hard it is: a ring of 1e12 N/m presses as the hole does.
    let scene = |support| rotating(with(isotropic(1.0, 0.2, 100.0), support), 3.0, 5.0);
    let rigid = scene(hole("hole", body(), 5e-3, 0.0, 0.0));
    let hard = scene(ring(hole("ring", body(), 5e-3, 0.0, 0.0), 1e12, 0.0));
    let mut beside = Stepper::new(&rigid, &EULER, 1e-3).unwrap();
    let mut pushed = 0;
    follow(&hard, &EULER, 1e-3, 2000, |step| {
        let other = beside.step().unwrap();
        // M/h² of 1e6 N/m beside 1e12 N/m.
        let apart = (step.q[0] - other.q[0]).hypot(step.q[1] - other.q[1]);
        assert!(apart < 1e-6 * 5e-3, "{}: {apart:e}", step.end);
        pushed += u32::from(step.impulse[0] > 0.0);
    });
    assert!(pushed > 1000);
}

#[test]
fn rigid_holes_beside_a_ring_are_those_of_moreau_jean() {
    // A ring far off makes it a scene of the other solver; the motion is the same.
    for seed in 0..40 {
        let scene = random_scene(&mut Draws::new(seed), 0.0);
        let far = ring(hole("far", scene.supports[0].at.clone(), 1e3, 0.0, 0.0), 1.0, 0.0);
        let other = with(scene.clone(), far);
        let mut beside = Stepper::new(&other, &JEAN, 1e-4).unwrap();
        let mut apart = 0.0_f64;
        follow(&scene, &JEAN, 1e-4, 200, |step| {
            let image = beside.step().unwrap();
            apart = step.v.iter().zip(image.v).fold(apart, |most, (a, b)| most.max((a - b).abs()));
        });
        // Impacts multiply roundings.
        assert!(apart < 1e-7, "seed {seed}: {apart:e}");
    }
}

/// A random scene with this friction in which some of the holes yield.
fn random_rings(seed: u64, friction: f64) -> Scene {
    let mut draws = Draws::new(seed);
    let mut scene = random_scene(&mut draws, friction);
    for support in &scene.supports {
        if draws.chance(0.6) {
            let damping = if draws.chance(0.5) { 0.0 } else { draws.between(0.0, 100.0) };
            let law = WallLaw::Elastic { stiffness: draws.between(1e3, 1e6), damping };
            for wall in scene.walls[support.walls.clone()].iter_mut().filter(|wall| wall.is_round()) {
                wall.law = law;
            }
        }
    }
    let n = scene.initial.q.len();
    let blow = Load::impulse(draws.between(-0.1, 0.1), draws.between(0.0, 0.02));
    scene.with_load(load(blow, Row::dof(draws.below(n))))
}

#[test]
fn faultless_runs_are_not_accused() {
    for (scheme, friction) in [(JEAN, 0.0), (EULER, 0.0), (Scheme::Located, 0.0), (Scheme::Located, 0.3)] {
        let mut pushed = 0;
        for seed in 0..60 {
            let scene = random_rings(seed, friction);
            let findings = judged(&scene, &scheme, ([1e-4, 1e-3][seed as usize % 2], 300), |_, pushes, _| {
                pushed += pushes.normal.iter().filter(|normal| **normal != [0.0; 2]).count();
            });
            assert_eq!(findings, [], "{scheme:?}, friction {friction}, seed {seed}");
        }
        assert!(pushed > 1000, "{pushed}");
    }
}

/// The body of 1 kg on 100 N/m in a ring of 5e4 N/m and 20 N s/m, with a gap of 5 mm and this
/// friction.
fn damped(friction: f64) -> Scene {
    with(isotropic(1.0, 0.0, 100.0), ring(hole("ring", body(), 5e-3, 0.0, friction), 5e4, 20.0))
}

/// The state (w, ẇ) of [`damped`] after `seconds`, by the classical Runge–Kutta method in steps so
/// small (1e-6 s) that its error is rounding, while the body touches the ring and slides one way.
fn slid(friction: f64, start: [f64; 4], seconds: f64) -> [f64; 4] {
    let rate = |x: [f64; 4]| {
        let r = x[0].hypot(x[1]);
        let n = [x[0] / r, x[1] / r];
        let pressure = 5e4 * (r - 5e-3) + 20.0 * (n[0] * x[2] + n[1] * x[3]);
        let against = friction * pressure * (n[0] * x[3] - n[1] * x[2]).signum();
        assert!(pressure > 0.0);
        let force = |i: usize| -100.0 * x[i] - pressure * n[i] - against * [-n[1], n[0]][i];
        [x[2], x[3], force(0), force(1)]
    };
    let (steps, h) = ((seconds / 1e-6).round() as u64, 1e-6);
    let mut x = start;
    for _ in 0..steps {
        let ahead = |k: [f64; 4], share: f64| [0, 1, 2, 3].map(|i: usize| x[i] + share * h * k[i]);
        let k1 = rate(x);
        let k2 = rate(ahead(k1, 0.5));
        let k3 = rate(ahead(k2, 0.5));
        let k4 = rate(ahead(k3, 1.0));
        x = [0, 1, 2, 3].map(|i: usize| x[i] + h / 6.0 * (k1[i] + 2.0 * k2[i] + 2.0 * k3[i] + k4[i]));
    }
    x
}

#[test]
fn a_body_that_slides_in_a_ring_has_the_motion_of_the_differential_equation_with_order_2() {
    // In the ring, with a radial speed of 0: the force of the dashpot does not jump.
    let start = [5.1e-3, 0.0, 0.0, 0.15];
    for friction in [0.0, 0.2] {
        let exact = slid(friction, start, 0.05);
        let error = |h: f64| {
            let scene = damped(friction).with_initial(&start[..2], &start[2..]);
            let stepper = follow(&scene, &Scheme::Located, h, (0.05 / h).round() as u64, |_| {});
            let state = stepper.state();
            (state.q[0] - exact[0]).hypot(state.q[1] - exact[1])
        };
        let errors = [1e-3, 5e-4, 2.5e-4, 1.25e-4].map(error);
        let orders: Vec<f64> = errors.windows(2).map(|e| (e[0] / e[1]).log2()).collect();
        let of_order_2 = orders.iter().all(|order| (1.7..2.3).contains(order));
        assert!(errors[3] < 1e-3 * 5e-3 && of_order_2, "friction {friction}: {errors:?} {orders:?}");
    }
}

#[test]
fn a_dashpot_pushes_where_the_middle_of_the_path_is_clear_of_the_ring() {
    // From rest just behind the circle to the other side of the normal: along the normal at the
    // start the body leaves; in the middle of its path the spring would pull with 7 mN, the dashpot
    // pushes with 33.
    let scene = with(isotropic(1.0, 0.0, 0.0), ring(hole("ring", body(), 8.263e-4, 0.0, 0.0), 394.0, 14.5))
        .with_load(load(Load::constant(-0.31316), Row::dof(0)))
        .with_load(load(Load::constant(0.01976), Row::dof(1)))
        .with_initial(&[2.079e-4, -8.068e-4], &[0.0; 2]);
    let mut impulse = 0.0;
    let findings = judged(&scene, &Scheme::Located, (7.296e-2, 1), |_, pushes, _| impulse = pushes.impulse[0]);
    assert_eq!(findings, []);
    assert!(impulse > 0.0);
}

#[test]
fn faults_of_a_ring_are_found() {
    let ring = ring(hole("ring", body(), 5e-3, 0.0, 0.0), 5e3, 2.0);
    let scene = rotating(with(isotropic(1.0, 0.2, 100.0), ring), 3.0, 5.0);
    for scheme in BOTH {
        let with_fault = |fault: &dyn Fn(&mut HoleStep)| {
            judged(&scene, &scheme, (1e-3, 1500), |step, pushes, _| {
                if step.index == 1400 {
                    assert!(pushes.impulse[0] > 0.0);
                    pushes.alter(0, fault);
                }
            })
        };
        let found = |findings: &[Finding], refuted: Refuted| {
            let one = findings.iter().find(|finding| finding.refuted == refuted);
            one.unwrap_or_else(|| panic!("{refuted:?}: {findings:?}")).residual
        };
        let findings = with_fault(&|hole| hole.impulse *= 1.01);
        assert!(found(&findings, Refuted::WallLaw) > 1e-3, "{findings:?}");
        assert!(found(&findings, Refuted::MomentumBalance) > 1e-3, "{findings:?}");
        let findings = with_fault(&|hole| {
            let ([y, z], turn) = (hole.normal, 1e-2);
            hole.normal = [y - turn * z, z + turn * y];
        });
        assert!(found(&findings, Refuted::Normal) > 1e-3, "{findings:?}");
    }
}

#[test]
fn a_turned_scene_has_the_turned_motion() {
    let scene = with(isotropic(1.0, 0.3, 200.0), ring(hole("ring", body(), 1e-3, 0.0, 0.0), 3e4, 1.0))
        .with_load(load(Load::harmonic(4.0, 9.0, 0.2), Row::new(vec![(0, 1.0), (1, 0.4)])))
        .with_initial(&[0.1e-3, -0.2e-3], &[0.05, 0.02]);
    let other = turned(&scene, 37.0);
    let [c, s] = heading(37.0);
    for scheme in ALL {
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
}

#[test]
fn who_cannot_step_a_ring_says_so() {
    let scene = thrown();
    for scheme in [Scheme::GeneralizedAlpha { rho: 0.8 }, Scheme::Event, Scheme::PaoliSchatzman] {
        let error = Stepper::new(&scene, &scheme, 1e-4).unwrap_err();
        assert!(error.is_request() && error.to_string().contains("elastic round support \"ring\""), "{error}");
    }
    let mut rubs = scene.clone();
    rubs.walls[0].friction = 0.2.into();
    let error = Stepper::new(&rubs, &JEAN, 1e-4).unwrap_err();
    assert!(error.to_string().contains("expected located, no friction or rigid round supports: the normal"), "{error}");
    // What makes no sense is refused where it stands.
    for (stiffness, damping, words) in [(0.0, 0.0, "stiffness"), (f64::NAN, 0.0, "stiffness"), (1.0, -1.0, "damping")] {
        let mut wrong = scene.clone();
        wrong.walls[0] = ring(wrong.walls[0].clone(), stiffness, damping);
        let error = wrong.validate().unwrap_err().to_string();
        assert!(error.contains(words) && error.contains("ring"), "{error}");
    }
}
