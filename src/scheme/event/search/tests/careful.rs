//! The careful search, where no flight is plain to see.

use super::*;

/// A body of 1 kg between walls at ±1 m.
fn between(damping: f64, stiffness: f64, q: f64, v: f64) -> Event {
    let scene = Scene::oscillator(1.0, damping, stiffness)
        .with_wall(Wall::lower("lower", -1.0))
        .with_wall(Wall::upper("upper", 1.0))
        .with_initial(&[q], &[v])
        .with_duration(64.0);
    Event::new(&scene, 64.0).unwrap()
}

/// The search over `span` (s) from the present, without a look at whole flights.
fn search(event: &mut Event, span: f64) -> Hit {
    event.begin_arc(span, 0.0);
    event.room = None;
    event.search(span).unwrap()
}

#[test]
fn of_two_walls_the_one_met_first_is_found_in_one_evaluation_where_the_motion_is_straight() {
    for (q, v, wall) in [(0.5, 2.0, 1), (0.5, -2.0, 0), (-0.25, 0.5, 1), (-0.25, -0.5, 0)] {
        let mut event = between(0.0, 0.0, q, v);
        let hit = search(&mut event, 50.0);
        let place = [-1.0, 1.0][wall];
        assert_eq!((hit.tau, hit.state, hit.wall), ((place - q) / v, [place, v], Some(wall)));
        assert_eq!(event.counters().evaluations, 1);
    }
}

#[test]
fn a_search_ends_at_its_span_unless_the_motion_fades() {
    // Free of the walls: windows of 1.5 rad of 2 rad/s, and the end.
    let mut event = between(0.0, 4.0, 0.25, 0.5);
    let hit = search(&mut event, 30.0);
    let expected = event.arc.state(30.0);
    assert_eq!((hit.tau, hit.state, hit.wall), (30.0, [expected.0, expected.1], None));
    let evaluations = event.counters().evaluations;
    assert!((41..=43).contains(&evaluations), "{evaluations}");
    // e^{−3t}: below ε² = e^{−72} after 24 s.
    let mut event = between(6.0, 10.0, 0.25, 0.5);
    let hit = search(&mut event, 60.0);
    assert!(hit.tau > 20.0 && hit.tau < 32.0 && hit.wall.is_none(), "{hit:?}");
    assert!(event.has_faded(hit.state));
    // What has not moved at all does not fade.
    let mut event = between(0.0, 4.0, 0.0, 0.0);
    assert_eq!(search(&mut event, 60.0).tau, 60.0);
}

#[test]
fn behind_the_face_of_a_wall_that_does_not_touch_is_an_event_unless_the_wall_has_just_changed() {
    // The rounding of another arc, which has put a body behind the face by ten times that of this
    // one, may be what ended the contact.
    for (changed, now) in [(f64::NEG_INFINITY, true), (-1.0, true), (0.0, false)] {
        let scene = Scene::oscillator(1.0, 0.0, 0.0)
            .with_wall(Wall::upper("soft", 1.0).with_elasticity(100.0, 0.0))
            .with_initial(&[0.5], &[-1.0])
            .with_duration(8.0);
        let mut event = Event::new(&scene, 8.0).unwrap();
        event.q = 1.0 + 10.0 * event.resolution;
        event.barriers[0].changed = changed;
        let hit = search(&mut event, 8.0);
        let expected = if now { (0.0, Some(0)) } else { (8.0, None) };
        assert_eq!((hit.tau, hit.wall), expected, "{changed}");
    }
}

#[test]
fn a_wall_is_met_at_the_end_of_an_arc_by_a_body_within_rounding_that_moves_into_it() {
    let mut event = between(0.0, 0.0, 0.0, 1.0);
    event.begin_arc(1.0, 0.0);
    let noise = [1e-3, 1e-4, 1e-5, 1e-6];
    for (side, wall) in [(-1.0, 0), (1.0, 1)] {
        for (gap, speed, curve, met) in [
            (0.0, 1.0, 0.0, true),
            (1e-4, 1.0, 0.0, true),
            (-1.0, 1.0, 0.0, true),
            (2e-3, 1.0, 0.0, false),
            (0.0, 0.0, 0.0, false),
            (0.0, 0.5e-4, 0.0, false),
            (0.0, -1.0, 0.0, false),
            // Slowly, and turned back before it could be told.
            (0.0, 1e-3, 1.0, false),
            (0.0, 1e-3, -1.0, true),
        ] {
            let mut jet = Jet::default();
            (jet[0], jet[1], jet[2]) = (side * (1.0 - gap), side * speed, -side * curve);
            let found = event.hit_at_end(&jet, &noise);
            assert_eq!(found, met.then_some(wall), "{side} {gap} {speed} {curve}");
        }
    }
}

#[test]
fn a_body_that_was_let_go_is_not_caught_by_the_rounding_of_its_acceleration() {
    // At a floor at 11 m, pressed by 2e-14 N, the difference of two forces of 2.75 N: four times
    // their noise of 4 ulps of 5.5, and a quarter of what is forgiven.
    let scene = Scene::oscillator(1.0, 0.0, 0.25)
        .with_wall(Wall::lower("floor", 11.0))
        .with_load(Load::constant(2.75 - 2e-14))
        .with_initial(&[11.0], &[0.0])
        .with_duration(8.0);
    for (released, caught) in [(f64::NEG_INFINITY, true), (-1.0, true), (0.0, false)] {
        let mut event = Event::new(&scene, 8.0).unwrap();
        event.released = released;
        let hit = search(&mut event, 8.0);
        assert_eq!(hit.tau == 0.0 && hit.wall == Some(0), caught, "{released}: {hit:?}");
    }
}

#[test]
fn near_resonance_the_start_of_an_arc_is_as_exact_as_its_forces() {
    // The steady motion under 3 N is 3e6 m, and its acceleration has a noise of 5e-7 m/s²; the
    // forces on the body at a floor at 0 press it by 1e-10 N, soon to be lifted by 30 N/s.
    let frequency = (100.0_f64 - 1e-6).sqrt() / std::f64::consts::TAU;
    let scene = Scene::oscillator(1.0, 0.0, 100.0)
        .with_wall(Wall::lower("floor", 0.0))
        .with_load(Load::harmonic(3.0, frequency, 0.0))
        .with_load(Load::constant(-1e-10))
        .with_duration(1e8);
    let mut event = Event::new(&scene, 1e8).unwrap();
    let hit = search(&mut event, 1e8);
    assert!(event.arc.steady_size() > 1e8, "{}", event.arc.steady_size());
    assert_eq!((hit.tau, hit.wall), (0.0, Some(0)));
}
