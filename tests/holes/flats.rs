//! Friction between flats: no scene is refuted, wedged bodies, and bodies that come to rest.

use crate::draws::cases;
use crate::rubbing::{MOREAU_JEAN, body, follow, isotropic, load, with_flats};
use signorini::{Load, Options, Row, Scene, Stepper, heading, run};

/// Some roundings of a speed or an impulse of 0.1 m/s or N s.
const ROUNDING: f64 = 1e-16;

/// A body of 1 kg on springs among `sides` flats, driven in this direction (degrees).
fn driven(sides: usize, direction: f64, friction: f64) -> Scene {
    let flats: Vec<(f64, f64)> = (0..sides).map(|k| (360.0 * k as f64 / sides as f64, 1e-3)).collect();
    let [y, z] = heading(direction);
    with_flats(isotropic(1.0, 0.2, 100.0), "flats", body(), &flats, 0.5, friction)
        .with_load(load(Load::harmonic(20.0, 3.0, 0.0), Row::new(vec![(0, y), (1, z)])))
}

#[test]
fn no_scene_with_friction_on_flats_is_refuted() {
    // All 180 with SIGNORINI_CASES=180. Number 61 has steps that sweeps alone do not settle.
    let (share, mut counted) = (cases(30_usize).clamp(1, 180), [0; 2]);
    for number in 0..180 {
        if number * 7 % 180 >= share && number != 61 {
            continue;
        }
        let (sides, way, friction) = ([3, 4, 6, 8][number % 4], number / 4 % 15, [0.1, 0.3, 0.8][number / 60]);
        let scene = driven(sides, 20.0 + 24.0 * way as f64, friction).with_duration(2.0);
        let run = run(&scene, &MOREAU_JEAN, &Options::with_step(1e-3).unrecorded()).unwrap();
        assert_eq!(run.findings, [], "{sides} flats, way {way}, μ = {friction}");
        assert_eq!(run.counters.qp_unsettled, 0, "{sides} flats, way {way}, μ = {friction}");
        assert!(run.counters.qp_solves > 300, "{:?}", run.counters);
        counted = [counted[0] + run.counters.wedged_steps, counted[1] + run.counters.qp_solves];
    }
    // Bodies are wedged at few of their impacts.
    assert!(counted[0] * 100 < counted[1], "{counted:?}");
}

#[test]
fn a_wedged_body_gives_up_its_rebound_is_counted_and_noted() {
    // Symmetrically into a corner of a right angle: with μ = 2 no impulses give the rebound.
    let into = |friction: f64| {
        let flats = [(0.0, 1e-3), (90.0, 1e-3)];
        with_flats(isotropic(1.0, 0.0, 0.0), "corner", body(), &flats, 0.5, friction)
            .with_initial(&[0.0, 0.0], &[0.1, 0.1])
            .with_duration(0.02)
    };
    let noted = |friction: f64| {
        let run = run(&into(friction), &MOREAU_JEAN, &Options::with_step(1e-3)).unwrap();
        assert_eq!((run.findings, run.counters.qp_unsettled), (vec![], 0), "μ = {friction}");
        (run.counters.wedged_steps, run.state.v, run.notes.iter().any(|note| note.contains("wedged")))
    };
    let (count, v, said) = noted(2.0);
    assert!(count == 1 && said && v.iter().all(|v| v.abs() < ROUNDING), "{count} {said} {v:?}");
    let (count, v, said) = noted(0.3);
    assert!(count == 0 && !said && v[0] < -0.04 && v[1] < -0.04, "{count} {v:?}");
    // The step names both flats, and its impulse is that of a body that stops: −m v.
    let mut stepper = Stepper::new(&into(2.0), &MOREAU_JEAN, 1e-3).unwrap();
    loop {
        let step = stepper.step().unwrap();
        if step.impulse.iter().any(|p| *p != 0.0) {
            let mut wedged = step.wedged.to_vec();
            wedged.sort_unstable();
            let push = [step.impulse[0] - step.friction[1], step.impulse[1] + step.friction[0]];
            assert!(wedged == [0, 1] && push.iter().all(|p| (p + 0.1).abs() < ROUNDING), "{step:?}");
            break;
        }
    }
}

#[test]
fn a_body_under_a_constant_load_comes_to_rest_when_its_rebounds_end() {
    // Free fall by 1 mm at 10 m/s²: bounces of 2v/g and e times that, which end at
    // (1 + e)/(1 − e) √(2H/g). The load along the flat is within the friction.
    let flats: Vec<(f64, f64)> = (0..4).map(|k| (90.0 * f64::from(k), 1e-3)).collect();
    for e in [0.5, 0.9] {
        for friction in [0.1, 0.8] {
            let scene = with_flats(isotropic(1.0, 0.0, 0.0), "flats", body(), &flats, e, friction)
                .with_load(load(Load::constant(10.0), Row::new(vec![(0, 1.0), (1, 0.05)])));
            let (mut last, mut at) = (f64::NAN, f64::NAN);
            follow(&scene, 1e-3, 1000, |step| {
                if step.v.iter().any(|v| v.abs() > ROUNDING) {
                    (last, at) = (step.end, step.q[0]);
                    return;
                }
                if step.velocity_before.iter().any(|v| v.abs() > ROUNDING) {
                    return;
                }
                // At rest the flats give what the load gives.
                let mut given = [0.01, 0.0005];
                for (k, (p, f)) in step.impulse.iter().zip(step.friction).enumerate() {
                    let [y, z] = heading(90.0 * k as f64);
                    given = [given[0] + p * y - f * z, given[1] + p * z + f * y];
                }
                assert!(given.iter().all(|left| left.abs() < ROUNDING), "{step:?}");
            });
            let end = (1.0 + e) / (1.0 - e) * (2e-3_f64 / 10.0).sqrt();
            // Each of the impacts is late or early by up to a step. With rebounds of any size the
            // body would move for three times as long.
            assert!((last - end).abs() < 0.05 * end + 4e-3, "e = {e}, μ = {friction}: {last}, expected {end}");
            // Behind the face by no more than half a step of the arrival at 0.14 m/s.
            assert!((0.9e-3..1.08e-3).contains(&at), "{at:?}");
        }
    }
}

#[test]
fn rebounds_that_last_longer_than_a_step_keep_their_restitution() {
    // From 1 mm above the floor under 10 m/s²: bounces of 2v/g = 28 ms and e times that, in steps
    // of 10 µs, end at (1 + e)/(1 − e) √(2H/g); e = 1 goes on for ever at its height.
    let floor = |e: f64| {
        let scene = with_flats(isotropic(1.0, 0.0, 0.0), "floor", body(), &[(0.0, 1e-3)], e, 0.3);
        scene.with_load(load(Load::constant(10.0), Row::dof(0)))
    };
    for e in [0.3, 0.7] {
        let mut last = f64::NAN;
        follow(&floor(e), 1e-5, 20_000, |step| {
            if step.v[0].abs() > ROUNDING {
                last = step.end;
            }
        });
        let end = (1.0 + e) / (1.0 - e) * (2e-3_f64 / 10.0).sqrt();
        // Each of the impacts is late or early by up to a step.
        assert!((last - end).abs() < 0.02 * end, "e = {e}: {last}, expected {end}");
    }
    let mut largest = 0.0_f64;
    follow(&floor(1.0), 1e-3, 20_000, |step| {
        let energy = 0.5 * step.v[0] * step.v[0] - 10.0 * step.q[0];
        largest = largest.max(energy.abs());
        assert!(step.resting.is_empty(), "{}", step.end);
    });
    // The energy of the start is 0; that of a fall by 1 mm is 1e-2 J.
    assert!(largest < 1e-2 * 1e-10, "{largest:e}");
}

/// A blow into an obtuse corner that the body touches: the impacts follow each other as if the gaps
/// were tiny, by both schemes. The flat that the blow moves the body away from does not push first.
#[test]
fn a_blow_in_a_corner_is_what_it_is_beside_it() {
    let struck = |gap: f64, scheme: &signorini::Scheme| {
        let flats = [(0.0, gap), (150.0, gap)];
        let [y, z] = heading(45.0);
        let scene = with_flats(isotropic(1.0, 0.0, 0.0), "corner", body(), &flats, 0.5, 0.2)
            .with_load(load(Load::impulse(0.1, 0.05), Row::new(vec![(0, y), (1, z)])))
            .with_duration(0.1);
        let run = run(&scene, scheme, &Options::with_step(1e-3)).unwrap();
        assert_eq!(run.findings, []);
        let sum =
            |wall: usize| run.trajectory.contacts().iter().filter(|c| c.wall == wall).map(|c| c.impulse).sum::<f64>();
        [sum(0), sum(1), run.state.v[0], run.state.v[1]]
    };
    let expected = struck(0.0, &MOREAU_JEAN);
    for gap in [0.0, 1e-9] {
        let found = struck(gap, &signorini::Scheme::Located);
        // Nothing accelerates the body in the 1e-8 s that the gap takes.
        assert!(found.iter().zip(expected).all(|(a, b)| (a - b).abs() < 1e-13), "{gap:e}: {found:?} {expected:?}");
    }
}

/// A body that friction holds in a V of two flats 150° apart: what the two press against each other
/// is no result of the load, and nothing keeps that of the landing. With elastic flats of 1e6 N/m
/// the mean of both forces is 2.25 N under loads of some 1 N.
#[test]
fn a_wedge_does_not_hold_the_impulse_of_its_landing() {
    let flats = [(105.0, 1e-3), (255.0, 1e-3)];
    let scene = with_flats(isotropic(1.0, 1.0, 100.0), "v", body(), &flats, 0.0, 0.3)
        .with_load(load(Load::constant(-1.0), Row::dof(0)))
        .with_load(load(Load::harmonic(0.3, 2.0, 0.0), Row::dof(1)))
        .with_initial(&[0.0; 2], &[-0.1, 0.03])
        .with_duration(0.5);
    let mean = |scheme: &signorini::Scheme, step: f64| {
        let run = run(&scene, scheme, &Options::with_step(step)).unwrap();
        assert_eq!(run.findings, []);
        run.trajectory.contacts().iter().map(|contact| contact.impulse.abs()).sum::<f64>() / 0.5
    };
    let located = mean(&signorini::Scheme::Located, 1e-3);
    assert!(located < 2.25, "{located}");
    // The landing is a step of moreau-jean early or late, of some ten milliseconds of 0.5 s.
    for step in [1e-3, 1e-4] {
        let found = mean(&MOREAU_JEAN, step);
        assert!((found - located).abs() < 30.0 * step * located, "{step:e}: {found}, {located}");
    }
}

/// A body slides along one flat into another one, 120° from it, with e = ½ and μ = 0.5. Back along
/// the first flat with half the speed it would take pushes of 10 and 9 times its momentum, whose
/// friction adds energy. It stops: with −m v = p (−n ± μ t) + q (−n' ± μ t') of the least p + q,
/// p = 0.86993 m v and q = 0.05834 m v.
#[test]
fn a_body_that_slides_into_a_corner_stops_there() {
    let (speed, e) = (0.1, 0.5);
    let scene = with_flats(isotropic(1.0, 0.0, 0.0), "corner", body(), &[(0.0, 1e-3), (120.0, 0.0)], e, 0.5)
        .with_initial(&[0.0; 2], &heading(30.0).map(|x| speed * x))
        .with_duration(0.05);
    for scheme in [MOREAU_JEAN, signorini::Scheme::Located] {
        let run = run(&scene, &scheme, &Options::with_step(1e-3)).unwrap();
        assert_eq!(run.findings, [], "{scheme}");
        assert!(run.state.v.iter().all(|v| v.abs() < 1e-15), "{scheme}: {:?}", run.state);
        assert!(run.counters.wedged_steps > 0, "{scheme}");
        let sum =
            |wall: usize| run.trajectory.contacts().iter().filter(|c| c.wall == wall).map(|c| c.impulse.abs()).sum();
        let [p, q]: [f64; 2] = [sum(0), sum(1)];
        if scheme == signorini::Scheme::Located {
            let [a, b] = [p / speed, q / speed];
            // (1, μ) p and the edge of the other cone next to it, by hand.
            let (cos, sin) = (0.5, 0.75_f64.sqrt());
            let edge = [cos - 0.5 * sin, -sin - 0.5 * cos];
            let q = (0.5 - 0.5 * sin) / (-edge[1] + 0.5 * edge[0]);
            assert!((a - sin - edge[0] * q).abs() < 1e-12 && (b - q).abs() < 1e-12, "{a} {b}");
        }
    }
}
