//! Faults of known size in the exact motion of a structure, each against its closed form.

use crate::shown::of_kind;
use signorini::linear::Symmetric;
use signorini::residual::{Judge, Residuals};
use signorini::{Finding, Load, Options, Refuted, Row, Scene, Scheme, Step, Stepper, Structure, Wall, run};

/// Two bodies of different mass that do not touch each other, each on its own spring, N/m.
fn bodies(masses: [f64; 2], springs: [f64; 2]) -> Scene {
    Scene::structure(Structure {
        mass: Symmetric::diagonal(&masses),
        damping: Symmetric::diagonal(&[0.0, 0.0]),
        stiffness: Symmetric::diagonal(&springs),
    })
}

/// A constant load on one of the bodies, N.
fn pushed(scene: Scene, body: usize, force: f64) -> Scene {
    scene.with_load(Load { at: Row::dof(body), ..Load::constant(force) })
}

/// `steps` steps of `scene` of at most `h` seconds, as a judge of `judged` sees them, each passed
/// through `alter` before: the velocity from which it starts can be another.
fn judge(
    (scene, judged): (&Scene, &Scene),
    (h, steps): (f64, u32),
    mut alter: impl FnMut(&Step<'_>, &mut Vec<f64>),
) -> (Vec<Finding>, Residuals) {
    let mut stepper = Stepper::new(scene, &Scheme::Event, h).expect("a sound scene");
    let state = stepper.state();
    let mut judge = Judge::new(judged, stepper.contract(), h, &state.q, &state.v);
    for _ in 0..steps {
        let mut step = stepper.step().expect("a step");
        let mut before = step.velocity_before.to_vec();
        alter(&step, &mut before);
        step.velocity_before = &before;
        judge.observe(&step);
    }
    (judge.findings(), judge.residuals())
}

#[test]
fn a_load_that_is_off_by_a_force_misses_the_balance_by_that_force() {
    // 3 N that the judge takes for 3.03 N, on either body, the other one loaded with 1 N. In the
    // metric of the mass a force counts by 1/√m: the largest is that on the light body or the
    // pushed one.
    let masses = [4.0, 0.25];
    for body in [0, 1] {
        let other = 1 - body;
        let scene = |force: f64| pushed(pushed(bodies(masses, [0.0; 2]), body, force), other, 1.0).with_duration(0.5);
        let (faultless, _) = judge((&scene(3.0), &scene(3.0)), (0.05, 10), |_, _| {});
        assert_eq!(faultless, []);
        let (findings, residuals) = judge((&scene(3.0), &scene(3.03)), (0.05, 10), |_, _| {});
        // The momentum of a stretch is known to some ulps of the largest, 1e-15, over 0.05 s.
        assert!((residuals.force_balance_n - 0.03).abs() < 1e-12, "{residuals:?}");
        let balance = of_kind(&findings, Refuted::MomentumBalance);
        let scaled = |i: usize, force: f64| force / f64::sqrt(masses[i]);
        let expected = scaled(body, 0.03) / scaled(body, 3.03).max(scaled(other, 1.0));
        // What the judge allows for rounding is 64 units of the forces and of the momentum over the
        // stretch, 1e-13.
        assert!((balance.residual - expected).abs() < 1e-11, "{balance:?}, {expected}");
    }
}

#[test]
fn a_mass_that_is_off_is_wrong_by_its_share_of_the_inertia() {
    // The judge takes 4 kg for 4.04 kg: of a mean force of 3 N on 4 kg, it misses a hundredth.
    let scene = |mass: f64| pushed(bodies([mass, 0.25], [0.0; 2]), 0, 3.0).with_duration(0.5);
    let (findings, residuals) = judge((&scene(4.0), &scene(4.04)), (0.05, 10), |_, _| {});
    assert!((residuals.force_balance_n - 0.03).abs() < 1e-12, "{residuals:?}");
    let balance = of_kind(&findings, Refuted::MomentumBalance);
    assert!((balance.residual - 0.01).abs() < 1e-11, "{balance:?}");
}

#[test]
fn a_stretch_that_does_not_start_where_the_last_one_ended_is_found() {
    // A jump of the velocity by 1e-6 m/s without a cause, up or down. As a force it is measured
    // over one radian of the fastest motion, which these two bodies have at 10 rad/s, but over no
    // less than the stretch: 0.1 s, of the spring's force of 100 N/m × 3 cm.
    let scene = bodies([1.0, 1.0], [100.0, 100.0]).with_initial(&[0.03, 0.0], &[0.0, 0.0]).with_duration(1.0);
    for jump in [-1e-6, 1e-6] {
        let (findings, _) = judge((&scene, &scene), (0.1, 10), |step, before| {
            if step.index == 4 {
                before[1] += jump;
            }
        });
        let balance = of_kind(&findings, Refuted::MomentumBalance);
        let expected = 1e-6 / 0.1 / 3.0;
        assert!(balance.residual > 0.2 * expected && balance.residual < 2.0 * expected, "{balance:?}");
    }
}

#[test]
fn the_largest_energy_is_found_inside_a_stretch() {
    // From rest under a constant load F the energy is the work F q, 2F²/k at the turning point.
    // With steps of two radians that lies in the second one, near its node at 3.149 rad; at the
    // ends of the steps the energy is at most 1.66 F²/k.
    let (k, force) = (100.0, 3.0);
    for body in [0, 1] {
        let scene = pushed(bodies([1.0, 1.0], [k, k]), body, force).with_duration(0.6);
        let mut end = 0.0;
        let (findings, residuals) = judge((&scene, &scene), (0.2, 3), |step, _| end = step.end);
        assert_eq!(findings, []);
        let largest = residuals.energy.largest_j / (2.0 * force * force / k);
        assert!(largest > 0.999 && largest < 1.0 + 1e-12, "{largest}");
        // The load does all the work, F q(t), and the magnitudes of its powers sum up to the way to
        // the turning point and back.
        let q = force / k * (1.0 - f64::cos(10.0 * end));
        let (there, back) = (2.0 * force / k, 2.0 * force / k - q);
        assert!(end > 0.35 && end < 0.61, "{end}");
        assert!((residuals.energy.load_work_j - force * (there - back)).abs() < 1e-13, "{residuals:?}");
        let exchanged = residuals.energy.largest_j + force * (there + back);
        // The integral of a magnitude with a kink is good to some percent.
        assert!((residuals.energy.exchanged_j / exchanged - 1.0).abs() < 0.05, "{residuals:?}");
    }
}

#[test]
fn a_spring_that_is_off_is_wrong_by_its_share_of_the_force() {
    // Into a spring of 400 N/m at 0.3 m/s, which the judge takes for one by a hundredth stiffer or
    // softer: its largest force is v√(km), which the judge sees within half a percent at its nodes.
    let (k, v) = (400.0, 0.3);
    let pad = |stiffness: f64| {
        let wall = Wall::upper("pad", 0.01).with_elasticity(stiffness, 0.0);
        let scene = bodies([1.0, 2.0], [0.0; 2]).with_wall(wall.at(Row::dof(0)));
        scene.with_initial(&[0.0, 0.0], &[v, 0.0]).with_duration(0.5)
    };
    let (findings, residuals) = judge((&pad(k), &pad(k)), (0.05, 10), |_, _| {});
    assert_eq!(findings, []);
    let depth = v / k.sqrt();
    assert!((residuals.depth_m[0] / depth - 1.0).abs() < 1e-2, "{:?}, exactly {depth}", residuals.depth_m);
    assert!((residuals.force_scale_n / (v * k.sqrt()) - 1.0).abs() < 1e-2, "{residuals:?}");
    for share in [-0.01, 0.01] {
        let (findings, _) = judge((&pad(k), &pad(k * (1.0 + share))), (0.05, 10), |_, _| {});
        let law = of_kind(&findings, Refuted::WallLaw);
        assert!((law.residual - 0.01).abs() < 2e-4 && law.wall.as_deref() == Some("pad"), "{law:?}");
    }
}

#[test]
fn bodies_that_travel_far_together_are_not_accused_for_the_rounding_of_their_places() {
    // Two free bodies pressed together for 2 km: the rounding of their distance is 1e-13 m, and a
    // wall counts as touched within 1e-15 m.
    let mut pair = pushed(pushed(bodies([1.0, 2.0], [0.0, 0.0]), 0, 9.0), 1, 3.0).with_duration(30.0);
    let between = Row::new(vec![(0, 1.0), (1, -1.0)]);
    pair.walls.push(Wall::upper("between", 1e-3).with_restitution(0.3).at(between));
    let others = [Scheme::PaoliSchatzman, Scheme::ImplicitEuler, Scheme::MoreauJean { theta: 0.5 }];
    for scheme in others.into_iter().chain([0.0, 0.4, 0.8, 1.0].map(|rho| Scheme::GeneralizedAlpha { rho })) {
        let run = run(&pair, &scheme, &Options::with_step(0.05)).expect("a run");
        assert_eq!(run.findings, [], "{scheme}");
        // Together they have 4 m/s².
        assert!((run.state.q[1] / 1800.0 - 1.0).abs() < 1e-2, "{scheme}: {:?}", run.state);
    }
}

/// Two bodies on springs, of which the second is pulled by two springs alone: their forces have no
/// sum. What moves is rounding, and adding up 1e4 equal displacements must not be more.
#[test]
fn a_structure_that_rests_in_equilibrium_exchanges_no_momentum() {
    let (first, second, tie, load) = (3055.4, 1663.2, 1988.9, 0.8316);
    let scene = Scene::structure(Structure {
        mass: Symmetric::diagonal(&[2.261, 3.36]),
        damping: Symmetric::diagonal(&[1.0, 1.0]),
        stiffness: Symmetric::from_entries(2, [(0, 0, first + tie), (0, 1, -tie), (1, 1, second + tie)]),
    });
    let determinant = (first + tie) * (second + tie) - tie * tie;
    let rest = [load * (second + tie) / determinant, load * tie / determinant];
    let scene = pushed(scene, 0, load).with_initial(&rest, &[0.0; 2]).with_duration(3.0);
    for scheme in [Scheme::MoreauJean { theta: 0.5 }, Scheme::Located, Scheme::ImplicitEuler] {
        let run = run(&scene, &scheme, &Options::with_step(3e-4)).unwrap();
        assert_eq!(run.findings, [], "{scheme}");
    }
}
