//! The judge against closed forms: what a fault of known size is worth, that faultless runs are not
//! accused, and that a run and its mirror image are judged alike.

use crate::common::{CONSTRAINED, INTEGRATORS, MOREAU_JEAN, elastic, source, spring};
use crate::random_structures::{Draws, random_scene};
use crate::shown::{Shown, of_kind};
use signorini::residual::{Judge, Residuals};
use signorini::{Face, Finding, Load, LoadKind, Refuted, Scene, Scheme, Side, Step, Stepper, Table, Wall};

const GENERALIZED_ALPHA: Scheme = Scheme::GeneralizedAlpha { rho: 0.8 };

/// The wall, this much farther from the origin.
fn scaled(wall: &Wall, by: f64) -> Wall {
    wall.clone().with_position(wall.position() * by)
}

/// `steps` steps of `scene` as a judge of `judged` sees them, each passed through `alter` before,
/// under an extra force of `extra` N on every degree of freedom in every third step.
fn judge(
    (scene, judged): (&Scene, &Scene),
    scheme: &Scheme,
    (h, steps, extra): (f64, u32, f64),
    mut alter: impl FnMut(&Step<'_>, &mut Shown),
) -> (Vec<Finding>, Residuals) {
    let mut stepper = Stepper::new(scene, scheme, h).expect("a sound scene");
    let state = stepper.state();
    let mut judge = Judge::new(judged, stepper.contract(), h, &state.q, &state.v);
    for number in 0..steps {
        let force = vec![if number % 3 == 1 { extra } else { 0.0 }; state.q.len()];
        let step = if extra == 0.0 { stepper.step() } else { stepper.step_with(&force) };
        let step = step.expect("a step");
        let mut shown = Shown::of(&step);
        alter(&step, &mut shown);
        judge.observe(&shown.in_place(&step));
    }
    (judge.findings(), judge.residuals())
}

/// The scene that the judge of a run of `scene` needs: with springs for the walls of a penalty.
fn as_seen(scene: &Scene, scheme: Scheme) -> Scene {
    match scheme {
        Scheme::Penalty { law, .. } => scene.penalised(law).expect("walls to replace"),
        _ => scene.clone(),
    }
}

fn schemes() -> Vec<Scheme> {
    let mut all: Vec<Scheme> = CONSTRAINED.into_iter().chain([GENERALIZED_ALPHA, Scheme::Event]).collect();
    all.extend(INTEGRATORS.map(|integrator| spring(3e4, integrator)));
    all
}

/// Scenes of one degree of freedom and of several, with dampers, blows and walls of both kinds.
fn scenes() -> Vec<(String, Scene)> {
    let mut scenes = vec![
        ("rigid walls".to_owned(), source(0.8, 0.4)),
        ("a damped elastic wall".into(), elastic(3.0, 0.5).with_load(Load::constant(1.0))),
        ("a blow".into(), elastic(0.0, 1.0).with_load(Load::impulse(0.1, 0.0303))),
        // The damper takes most of the momentum of the load.
        (
            "a damper".into(),
            Scene::oscillator(1.0, 5.0, 0.0)
                .with_wall(Wall::upper("far", 9.0))
                .with_wall(Wall::lower("behind", -9.0))
                .with_load(Load::constant(3.0)),
        ),
    ];
    for seed in 0..4 {
        let scene = random_scene(&mut Draws::new(seed)).with_duration(0.25);
        if scene.walls.iter().any(|wall| wall.law.is_rigid()) {
            scenes.push((format!("seed {seed}"), scene));
        }
    }
    scenes
}

#[test]
fn a_faultless_run_is_not_accused_with_and_without_extra_forces() {
    for (name, scene) in scenes() {
        for scheme in schemes() {
            for extra in [0.0, 2.5] {
                let judged = as_seen(&scene, scheme);
                let (findings, residuals) = judge((&scene, &judged), &scheme, (1e-3, 200, extra), |_, _| {});
                let what = format!("{name}, {scheme}, extra force {extra} N");
                assert_eq!(findings, [], "{what}");
                // What the README promises of every scheme but the demonstration.
                assert!(scheme == Scheme::Newmark || residuals.complementarity < 1e-9, "{what}: {residuals:?}");
            }
        }
    }
}

#[test]
fn a_run_and_its_mirror_image_are_judged_alike() {
    let mirrored = |scene: &Scene| {
        let mut other = scene.clone();
        for wall in &mut other.walls {
            let Face::Flat { side, position, .. } = &mut wall.face else { panic!("a round wall") };
            *side = if *side == Side::Upper { Side::Lower } else { Side::Upper };
            *position = -*position;
        }
        for load in &mut other.loads {
            match &mut load.kind {
                LoadKind::Constant { force } => *force = -*force,
                LoadKind::Harmonic { amplitude, .. } => *amplitude = -*amplitude,
                LoadKind::Impulse { impulse, .. } => *impulse = -*impulse,
                LoadKind::Table(table) => {
                    let forces = table.force().iter().map(|force| -force).collect();
                    *table = Table::new(table.time().to_vec(), forces).expect("a sound table");
                }
                kind => panic!("{kind:?} is new"),
            }
        }
        let minus = |values: &[f64]| values.iter().map(|x| -x).collect::<Vec<_>>();
        other.with_initial(&minus(&scene.initial.q), &minus(&scene.initial.v))
    };
    // Forces that are too large, velocities too high, walls elsewhere: sizes of both signs differ.
    let larger = |share: f64| {
        move |_: &Step<'_>, shown: &mut Shown| {
            shown.impulse.iter_mut().chain(&mut shown.force).for_each(|x| *x *= 1.0 + share);
        }
    };
    let faster = |_: &Step<'_>, shown: &mut Shown| shown.after.iter_mut().for_each(|x| *x *= 1.001);
    let (mut found, mut pushed) = (0, 0);
    for (name, scene) in scenes() {
        for scheme in schemes() {
            for fault in 0..4 {
                let judged = |mut scene: Scene, extra: f64| {
                    let stepped = scene.clone();
                    if fault == 3 {
                        scene.walls.iter_mut().for_each(|wall| *wall = scaled(wall, 0.97));
                    }
                    let scene = (&stepped, &as_seen(&scene, scheme));
                    let times = (1e-3, 200, extra);
                    match fault {
                        1 => judge(scene, &scheme, times, larger(1e-3)),
                        2 => judge(scene, &scheme, times, faster),
                        _ => judge(scene, &scheme, times, |_, _| {}),
                    }
                };
                let (one, other) = (judged(scene.clone(), 1.5), judged(mirrored(&scene), -1.5));
                let what = format!("{name}, {scheme}, fault {fault}");
                assert_eq!(one, other, "{what}");
                (found, pushed) = (found + one.0.len(), pushed + usize::from(one.1.depth_m.iter().any(|d| *d > 0.0)));
            }
        }
    }
    assert!(found > 100 && pushed > 50, "{found} findings, {pushed} runs with depths");
}

#[test]
fn faults_of_exact_motion_are_found_by_kind_and_size() {
    // Into a spring of 400 N/m at 0.3 m/s: depth v√(m/k) = 15 mm, without a load.
    let (k, v) = (400.0, 0.3);
    let pad = |stiffness: f64| {
        Scene::oscillator(1.0, 0.0, 0.0)
            .with_wall(Wall::upper("pad", 0.01).with_elasticity(stiffness, 0.0))
            .with_initial(&[0.0], &[v])
    };
    let run = |judged: &Scene| judge((&pad(k), judged), &Scheme::Event, (0.05, 10, 0.0), |_, _| {});
    let (findings, residuals) = run(&pad(k));
    assert_eq!(findings, []);
    let depth = v / k.sqrt();
    // The judge looks at the nodes of its quadrature; near the peak the depth changes by (ωΔt)²/2.
    assert!((residuals.depth_m[0] / depth - 1.0).abs() < 1e-2, "{:?}, exactly {depth}", residuals.depth_m);
    // A law that is stiffer or softer than the springs by one in a hundred.
    for share in [-0.01, 0.01] {
        let (findings, _) = run(&pad(k * (1.0 + share)));
        let law = of_kind(&findings, Refuted::WallLaw);
        assert!((law.residual - 0.01).abs() < 2e-4 && law.wall.as_deref() == Some("pad"), "{law:?}");
    }
    // Loads of 3 N that the judge takes for 3.03 N: 0.03 N on the average of a stretch, of 3.03 N.
    for mass in [1.0, 4.0] {
        let free = |load: f64| {
            Scene::oscillator(mass, 0.0, 0.0).with_wall(Wall::upper("far", 9.0)).with_load(Load::constant(load))
        };
        let (findings, seen) = judge((&free(3.0), &free(3.03)), &Scheme::Event, (0.05, 10, 0.0), |_, _| {});
        let balance = of_kind(&findings, Refuted::MomentumBalance);
        assert!((balance.residual - 0.03 / 3.03).abs() < 1e-9, "{balance:?}");
        assert!((seen.force_balance_n - 0.03).abs() < 1e-9, "{seen:?}");
    }
}

#[test]
fn a_force_in_mid_air_is_found_after_a_long_contact() {
    // Pressed onto its floor for a second, more steps than the judge keeps pairs; then lifted.
    let press = Table::new(vec![0.0, 1.0, 1.001, 3.0], vec![-5.0, -5.0, 5.0, 5.0]).expect("a sound table");
    let scene = Scene::oscillator(1.0, 0.0, 0.0)
        .with_wall(Wall::lower("floor", 0.0).with_restitution(0.0))
        .with_wall(Wall::upper("ceiling", 9.0))
        .with_load(Load::table(press));
    for (scheme, shown) in [
        (Scheme::ImplicitEuler, [1.0, 1.0]),
        (Scheme::ImplicitEuler, [0.0, 1.0]),
        (Scheme::Newmark, [0.0, 1.0]),
        (Scheme::PaoliSchatzman, [1.0, 0.0]),
        (GENERALIZED_ALPHA, [1.0, 0.0]),
    ] {
        // The force of 1 N, in the step 0.3 s after the body has left, as an impulse or not.
        let (findings, _) = judge((&scene, &scene), &scheme, (1e-2, 150, 0.0), |step, seen| {
            if step.index == 130 {
                (seen.impulse[0], seen.force[0]) = (1e-2 * shown[0], shown[1]);
            }
        });
        if scheme == GENERALIZED_ALPHA {
            // It promises nothing of the rebound at a wall that is not closed: the momentum tells.
            of_kind(&findings, Refuted::MomentumBalance);
            continue;
        }
        let finding = of_kind(&findings, Refuted::Complementarity);
        assert!((finding.time_s - 1.31).abs() < 1e-9, "{scheme}: {finding:?}");
        // Less than the force is of the largest, 5 N.
        assert!(finding.residual > 1e-4 && finding.residual < 0.21, "{scheme}: {finding:?}");
    }
}

#[test]
fn a_body_that_goes_through_a_closed_wall_is_found() {
    // The rebound of the first impact is taken out: no impulse, and the velocity as it was.
    for scheme in [GENERALIZED_ALPHA, MOREAU_JEAN] {
        let mut done = false;
        let (findings, _) = judge((&source(0.8, 0.8), &source(0.8, 0.8)), &scheme, (1e-3, 120, 0.0), |step, seen| {
            if step.impulse[0] != 0.0 && !done {
                done = true;
                (seen.impulse[0], seen.force[0]) = (0.0, 0.0);
                seen.after.copy_from_slice(step.velocity_before);
                seen.v.copy_from_slice(step.velocity_before);
            }
        });
        let finding = of_kind(&findings, Refuted::Complementarity);
        // Missed is (1 + e) of the speed, in scales of the largest speed: at least that much.
        assert!(done && finding.residual > 1.0 && finding.wall.as_deref() == Some("upper"), "{finding:?}");
    }
}

#[test]
fn a_step_with_too_large_an_impulse_is_wrong_by_its_share_of_the_impulse() {
    let (findings, _) =
        judge((&source(0.8, 0.8), &source(0.8, 0.8)), &GENERALIZED_ALPHA, (1e-4, 2000, 0.0), |_, seen| {
            seen.impulse.iter_mut().chain(&mut seen.force).for_each(|p| *p *= 1.001);
        });
    let finding = of_kind(&findings, Refuted::MomentumBalance);
    // In a step of 0.1 ms the impulse is the largest term by far.
    assert!((finding.residual - 0.001 / 1.001).abs() < 1e-6, "{finding:?}");
}

#[test]
fn impulses_that_miss_the_momentum_of_a_run_are_wrong_by_their_share_of_it() {
    // Held by a spring of 200 N/m at 10 mm, pressed by 5 N, for one second: 5 N s from the load,
    // −2 N s from the spring and −3 N s from the wall.
    let scene = Scene::oscillator(1.0, 0.0, 200.0)
        .with_wall(Wall::upper("stop", 0.01).with_restitution(0.0))
        .with_load(Load::constant(5.0))
        .with_initial(&[0.01], &[0.0]);
    let h = 1e-3;
    for scheme in [MOREAU_JEAN, Scheme::ImplicitEuler, GENERALIZED_ALPHA] {
        // The judge hears of a tenth less.
        let (findings, _) = judge((&scene, &scene), &scheme, (h, 1000, 0.0), |_, seen| seen.impulse[0] *= 0.9);
        let finding = of_kind(&findings, Refuted::Impulses);
        // 0.3 N s, less two steps of the forces at the ends of the run, 5 + 2 N in a step and
        // 3 N at the start, over what was exchanged: 3 N s by load and spring, 2.7 by the wall.
        let expected = (0.3 - 2.0 * h * (7.0 + 3.0)) / (3.0 + 2.7);
        assert!((finding.residual - expected).abs() < 1e-9, "{scheme}: {finding:?}, expected {expected}");
    }
}

#[test]
fn a_spring_that_does_not_push_at_all_is_measured_by_its_stiffness() {
    // The judge's wall stands 1 mm before where the body turns round without meeting any.
    let swing = |position: f64| {
        Scene::oscillator(1.0, 0.0, 100.0)
            .with_wall(Wall::upper("pad", position).with_elasticity(2000.0, 0.0))
            .with_initial(&[0.0], &[0.1])
            .with_duration(0.5)
    };
    let worth = |scale: f64| {
        let units = |mut scene: Scene| {
            scene.walls[0] = scaled(&scene.walls[0], scale);
            scene.with_initial(&[0.0], &[0.1 * scale])
        };
        let (far, near) = (units(swing(0.02)), units(swing(0.009)));
        let (findings, residuals) = judge((&far, &near), &MOREAU_JEAN, (1e-3, 300, 0.0), |_, _| {});
        (of_kind(&findings, Refuted::WallLaw).residual, residuals.complementarity)
    };
    // 2000 N/m · 1 mm missed, over 2000 N/m · 9 mm, the force of the wall over the gap scale.
    let (law, complementarity) = worth(1.0);
    assert!((law - 1.0 / 9.0).abs() < 1e-3 && (complementarity - law).abs() < 1e-9, "{law}, {complementarity}");
    // The same at a millionth of the size.
    let (small, _) = worth(1e-6);
    assert!((small / law - 1.0).abs() < 1e-9, "{small}, {law}");
}

#[test]
fn a_blow_strictly_inside_a_stretch_of_exact_motion_is_open_momentum() {
    // The run takes the blow of 0.3 N s at 0.5 s, where a stretch ends; the judge's scene has it at
    // 0.4 s, inside of that stretch.
    let line = Scene::oscillator(1.0, 0.0, 4.0).with_initial(&[0.1], &[0.2]);
    let planes = line.clone().with_wall(Wall::upper("far", 50.0).at(signorini::Row::new(vec![(0, 0.5)])));
    for scene in [line, planes] {
        let with = |time: f64| scene.clone().with_load(Load::impulse(0.3, time));
        for (judged, inside) in [(0.5, false), (0.4, true)] {
            let given = (&with(0.5), &with(judged));
            let (findings, _) = judge(given, &Scheme::Event, (0.25, 8, 0.0), |_, _| {});
            let accused = findings.iter().any(|finding| finding.refuted == Refuted::MomentumBalance);
            assert_eq!(accused, inside, "{findings:?}");
        }
    }
}
