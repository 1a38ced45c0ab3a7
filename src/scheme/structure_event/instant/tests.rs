//! What happens at one instant: which rows are closed, what a blow does, and what episodes tell.

use super::super::tests::{masses, near, on, rigid, started};
use super::*;
use crate::scene::{Load, Scene, Table, Wall};

/// Masses (kg), each above a floor of its own at 0.
fn on_floors(mass: &[f64], e: f64) -> Scene {
    let floor = |dof: usize| rigid(Wall::lower(&format!("{dof}"), 0.0), e, &[(dof, 1.0)]);
    (0..mass.len()).map(floor).fold(masses(mass, &[], &[]), Scene::with_wall)
}

/// The contacts that end until `end` (s).
fn ended(event: &mut StructureEvent, end: f64) -> Vec<Contact> {
    let mut all = Vec::new();
    while event.time < end {
        event.advance(None).unwrap();
        all.extend_from_slice(&event.shown.closed);
    }
    all
}

#[test]
fn a_gap_within_the_rounding_of_the_instant_is_closed_unless_it_opens() {
    // At 1e6 s and 1 m/s the rounding of the instant is 9e-10 m.
    for (gap, v, after) in [(5e-10, -1.0, [0.0, 0.5]), (5e-10, 1.0, [5e-10, 1.0]), (5e-9, -1.0, [5e-9, -1.0])] {
        let mut event = started(&on_floors(&[1.0, 1.0], 0.5), 1.0);
        event.restart(1e6, &[0.0, gap], &[-1.0, v]).unwrap();
        event.advance(None).unwrap();
        let what = format!("{gap} {v}: {:?} {:?}", event.q, event.v);
        assert!(event.time == 1e6 && event.q[0] == 0.0 && near(event.v[0], 0.5), "{what}");
        assert!((event.q[1] - after[0]).abs() < 1e-20 && near(event.v[1], after[1]), "{what}");
    }
}

#[test]
fn the_fastest_closed_row_is_known_in_metres_and_in_the_metric_of_the_mass() {
    let scene = masses(&[2.0, 50.0, 1.0], &[], &[])
        .with_wall(rigid(Wall::lower("a", 0.0), 0.5, &[(0, 3.0)]))
        .with_wall(rigid(Wall::lower("b", 0.0), 0.5, &[(1, 1.0)]))
        .with_wall(rigid(Wall::lower("c", -1.0), 0.5, &[(2, 1.0)]))
        .with_initial(&[0.0; 3], &[-0.5, 0.75, 9.0]);
    let mut event = started(&scene, 1.0);
    event.close_rows(None);
    assert_eq!(event.closed_rows.iter().map(|s| s.row).collect::<Vec<_>>(), [0, 1]);
    // 1.5 m/s over √(9/2), and 0.75 m/s over √(1/50), which is more.
    assert!(event.fastest_row == 1.5 && near(event.fastest_weighed, 0.75 * f64::sqrt(50.0)));
}

#[test]
fn a_blow_towards_a_spring_that_has_let_go_finds_it_pushing_at_once() {
    // Behind its face, on the way out faster than the dashpot lets the spring follow.
    let scene = masses(&[1.0], &[], &[])
        .with_wall(Wall::lower("spring", 0.0).with_elasticity(1.0, 10.0))
        .with_load(on(Load::impulse(-3.0, 0.05), 0))
        .with_initial(&[-0.1], &[1.0]);
    let mut event = started(&scene, 1.0);
    event.advance(None).unwrap();
    // At −0.05 m, from 1 to −2 m/s.
    let force = 0.05 + 10.0 * 2.0;
    assert!(event.time == 0.05 && (event.shown.force[0] - force).abs() < 1e-12, "{:?}", event.shown.force);
}

#[test]
fn a_blow_ends_the_rest_of_the_body_that_it_strikes_and_no_other() {
    for light in [1.0, 0.25] {
        let scene = on_floors(&[1.0, light], 0.5)
            .with_load(on(Load::constant(-10.0), 0))
            .with_load(on(Load::constant(-10.0), 1))
            .with_load(on(Load::impulse(-2.0, 0.5), 0));
        let mut event = started(&scene, 1.0);
        let contacts = ended(&mut event, 0.5);
        // Half a second of 10 N; then from 2 m/s to 1 m/s away. The other goes on.
        assert_eq!(contacts.len(), 2, "{contacts:?}");
        let [rest, impact] = [contacts[0], contacts[1]];
        assert!((rest.wall, rest.start, rest.end, rest.departure_speed) == (0, 0.0, Some(0.5), Some(0.0)), "{rest:?}");
        assert!((impact.wall, impact.start, impact.end) == (0, 0.5, Some(0.5)), "{impact:?}");
        assert!((rest.impulse - 5.0).abs() < 1e-14 && (impact.impulse - 3.0).abs() < 1e-14, "{contacts:?}");
        let speeds = (impact.approach_speed, impact.departure_speed.unwrap());
        assert!((speeds.0 - 2.0).abs() < 1e-14 && (speeds.1 - 1.0).abs() < 1e-14, "{impact:?}");
        // Through the impact of the first at 0.7 s too.
        assert!(ended(&mut event, 0.75).iter().all(|c| c.wall == 0));
        let other = event.barriers[1].open.unwrap();
        assert!(other.start == 0.0 && (other.impulse - 10.0 * event.time).abs() < 1e-13, "{other:?}");
    }
}

#[test]
fn a_contact_ends_with_the_speed_away_from_its_wall() {
    for sign in [1.0, -1.0] {
        let wall = |name: &str| if sign > 0.0 { Wall::lower(name, 0.0) } else { Wall::upper(name, 0.0) };
        // A force that falls to 0 at half a second lets go without a speed, a blow of 6 N s with
        // that of 2 kg.
        let ramp = Table::new(vec![0.0, 10.0], vec![-10.0 * sign, 190.0 * sign]).unwrap();
        for (blow, end, speed) in [(0.0, 0.5, 0.0), (6.0, 0.25, 3.0)] {
            let scene = masses(&[2.0], &[], &[])
                .with_wall(rigid(wall("wall"), 0.5, &[(0, 1.0)]))
                .with_load(Load::table(ramp.clone()))
                .with_load(Load::impulse(blow * sign, 0.25));
            let contacts = ended(&mut started(&scene, 1.0), 0.6);
            assert_eq!(contacts.len(), 1, "{contacts:?}");
            let departure = contacts[0].departure_speed.unwrap();
            assert!((contacts[0].end.unwrap() - end).abs() < 1e-14, "{contacts:?}");
            assert!((departure - speed).abs() < 1e-13, "{sign} {blow}: {departure}");
        }
    }
}

#[test]
fn the_most_elastic_walls_at_one_place_share_an_impulse() {
    let wall = |e: f64| rigid(Wall::upper(&format!("{e}"), 0.0), e, &[(0, 1.0)]);
    let scene = masses(&[4.0], &[], &[]).with_wall(wall(0.2)).with_wall(wall(0.5)).with_wall(wall(0.5));
    let mut event = started(&scene.with_initial(&[0.0], &[1.0]), 1.0);
    event.advance(None).unwrap();
    // 4 kg from 1 m/s to −0.5 m/s.
    assert_eq!(event.shown.jump, [0.0, -3.0, -3.0]);
}
