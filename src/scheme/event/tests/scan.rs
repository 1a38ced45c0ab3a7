//! First events against a dense look at the motion.

use super::*;
use crate::hash::{mix, unit};

/// A body between two rigid walls under a sine and a constant, of any damping and stiffness.
fn scene(number: u64) -> Scene {
    let draw = |k: u64, low: f64, high: f64| low + (high - low) * unit(mix(7, number, k));
    let of = |k: u64, choice: [f64; 3]| choice[draw(k, 0.0, 3.0) as usize];
    let half = draw(1, 0.05, 0.5);
    Scene::oscillator(1.0, of(2, [0.0, 1.0, 40.0]), of(3, [0.0, 30.0, 300.0]))
        .with_wall(Wall::upper("upper", half))
        .with_wall(Wall::lower("lower", -half))
        .with_load(Load::constant(draw(4, -5.0, 5.0)))
        .with_load(Load::harmonic(draw(5, 0.0, 30.0), draw(6, 0.0, 3.0), draw(7, 0.0, 6.0)))
        .with_initial(&[half * draw(8, -1.0, 1.0)], &[draw(9, -2.0, 2.0)])
        .with_duration(2.0)
}

#[test]
fn no_wall_is_passed_before_the_first_event_and_one_is_met_at_it() {
    let mut met = 0;
    for number in 0..500 {
        let mut event = Event::new(&scene(number), 2.0).unwrap();
        event.begin_arc(2.0, 0.0);
        let mut careful = event.clone();
        careful.room = None;
        let hit = event.search(2.0).unwrap();
        let slow = careful.search(2.0).unwrap();
        let gap = |wall: &ExactWall, t: f64| wall.gap(event.arc.state(t).0);
        // Rounding of a motion of less than 1 m whose steady part may be some metres.
        let rounding = 1e-13;
        for wall in &event.barriers {
            let nearest = (0..=400).map(|i| gap(wall, hit.tau * f64::from(i) / 400.0)).fold(1.0, f64::min);
            assert!(nearest >= -rounding, "{number}: {nearest:e} m behind {} before {hit:?}", wall.name);
        }
        assert_eq!(hit.wall, slow.wall, "{number}");
        match hit.wall {
            Some(wall) => {
                met += 1;
                assert!(gap(&event.barriers[wall], hit.tau).abs() < rounding, "{number}: {hit:?}");
                assert!(((hit.tau - slow.tau) * hit.state[1]).abs() < rounding, "{number}: {hit:?} {slow:?}");
                // The speed of the closed form at that instant, which the acceleration of some
                // 100 m/s² changes within its rounding.
                assert!((hit.state[1] - event.arc.state(hit.tau).1).abs() < 1e-12, "{number}: {hit:?}");
            }
            None => assert!((hit.tau - 2.0).abs() < 1e-15 && (slow.tau - 2.0).abs() < 1e-15),
        }
    }
    assert!((200..450).contains(&met), "{met}");
}
