//! Forces, their rates and the sizes of their terms, against the equation of motion written out.

use super::super::tests::{hole, masses, near, on, started, with};
use super::*;
use crate::scene::{Load, Row, Wall};

#[test]
fn a_wall_that_touches_adds_its_spring_and_its_dashpot() {
    let wall = Wall::upper("pad", 0.3).at(Row::new(vec![(0, 2.0), (1, -1.0)]));
    let scene = masses(&[1.0, 1.0], &[(0, 0, 3.0)], &[(1, 1, 70.0)])
        .with_wall(wall.with_elasticity(500.0, 11.0))
        .with_load(on(Load::constant(2.0), 1));
    let mut event = started(&scene, 1.0);
    event.barriers[0].phase = Phase::Touching;
    event.derivatives[0] = vec![0.4, 0.1];
    event.derivatives[1] = vec![-0.2, 0.5];
    event.derivatives[2] = vec![6.0, -4.0];
    // w = 2 q₀ − q₁: the pad is pressed by 0.4 m, ẇ = −0.9 and ẅ = 16.
    event.forces(0);
    let push = -500.0 * 0.4 + 11.0 * 0.9;
    let wanted = [0.6 + 2.0 * push, 2.0 - 7.0 - push];
    (0..2).for_each(|i| assert!(near(event.rhs[i], wanted[i]), "{:?} {wanted:?}", event.rhs));
    let size = 500.0 * (0.9 + 0.3) + 11.0 * 0.9;
    let wanted = [0.6 + 2.0 * size, 2.0 + 7.0 + size];
    (0..2).for_each(|i| assert!(near(event.rhs_size[i], wanted[i]), "{:?} {wanted:?}", event.rhs_size));
    // Its rate, in which the place of the wall does not occur; the acceleration has terms of these
    // sizes.
    event.sizes.derivative[2] = vec![8.0, 5.0];
    event.forces(1);
    let push = 500.0 * 0.9 - 11.0 * 16.0;
    let wanted = [-18.0 + 2.0 * push, -35.0 - push];
    (0..2).for_each(|i| assert!(near(event.rhs[i], wanted[i]), "{:?} {wanted:?}", event.rhs));
    let size = 500.0 * 0.9 + 11.0 * 21.0;
    let wanted = [24.0 + 2.0 * size, 35.0 + size];
    (0..2).for_each(|i| assert!(near(event.rhs_size[i], wanted[i]), "{:?} {wanted:?}", event.rhs_size));
}

#[test]
fn a_body_that_slides_in_a_hole_presses_with_its_centrifugal_force() {
    let (mass, gap, speed) = (0.8, 1.0 / 512.0, 0.03);
    let scene = with(masses(&[mass; 2], &[], &[]), hole(gap, 0.5, [0.0; 2])).with_initial(&[gap, 0.0], &[0.0, speed]);
    let mut event = started(&scene, 0.05);
    while event.time < 0.2 {
        event.advance(None).unwrap();
        // Once the body is held, from its first step on.
        let force = event.shown.force[0];
        assert!((force - mass * speed * speed / gap).abs() < 1e-13, "{}: {force}", event.time);
    }
    // Of the forces at the start of a series: m v²/γ along the normal, which turns at v/γ.
    event.begin_series(event.limit());
    event.measure();
    let [y, z] = [event.q[0] / gap, event.q[1] / gap];
    let push = mass * speed * speed / gap;
    for (i, normal, along) in [(0, y, z), (1, z, y)] {
        let [force, rate] = [event.sizes.force[0][i], event.sizes.force[1][i]];
        // The speed has the rounding of the stretches before.
        assert!((force - push * normal.abs()).abs() < 1e-12 * push, "{i}: {force}");
        assert!((rate - push * speed / gap * along.abs()).abs() < 1e-10 * push * speed / gap, "{i}: {rate}");
    }
}

#[test]
fn a_series_that_an_event_is_expected_to_end_is_the_beginning_of_the_long_one_with_fewer_terms() {
    let sine = on(Load::harmonic(7.0, 1.5, 0.4), 1);
    let flight = masses(&[1.3, 0.4, 1.0], &[(0, 1, -0.2), (1, 1, 0.9)], &[(0, 0, 80.0), (0, 1, -30.0), (1, 1, 50.0)])
        .with_load(sine)
        .with_initial(&[0.3, -0.2, 0.0], &[1.0, 2.0, -1.0]);
    // Round a hole, pressed against it by a spring.
    let slide = with(masses(&[1.3; 2], &[], &[(0, 0, -20.0), (1, 1, -20.0)]), hole(0.75, 0.5, [0.0; 2]))
        .with_initial(&[0.75, 0.0], &[0.0, 0.6]);
    for scene in [flight, slide] {
        let mut event = started(&scene, 10.0);
        event.advance(None).unwrap();
        let limit = event.limit();
        let state = |event: &StructureEvent, t: f64| {
            let [mut q, mut v] = [(); 2].map(|()| vec![0.0; event.q.len()]);
            event.series.state(t, &mut q, &mut v);
            [q, v]
        };
        event.begin_series(limit);
        let (start, longest, terms) = (event.time, event.series.unit(), event.series.terms());
        let shares = [0.5, 0.125, 1.0 / 64.0, 1e-9];
        let times = shares.map(|share: f64| [0.3, 1.0].map(|x| start + x * share.max(1.0 / 256.0) * longest));
        let wanted = times.map(|times| times.map(|t| state(&event, t)));
        for ((share, times), wanted) in shares.into_iter().zip(times).zip(wanted) {
            event.begin_within(limit, share * longest);
            assert!(near(event.series.unit(), share.max(1.0 / 256.0) * longest), "{share}: {}", event.series.unit());
            assert!(near(event.series.longest(), longest) && event.series.terms() < terms, "{share}");
            for (t, wanted) in times.into_iter().zip(wanted) {
                for (found, wanted) in state(&event, t).into_iter().zip(wanted) {
                    // Some roundings of the largest entry.
                    let most = wanted.iter().fold(0.0_f64, |most, x| most.max(x.abs()));
                    let apart = found.iter().zip(&wanted).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max);
                    assert!(apart <= 1e-14 * most, "{share} {t}: {found:?} for {wanted:?}");
                }
            }
        }
    }
}
