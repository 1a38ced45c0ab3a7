//! When the impacts that follow one are not followed one by one.

use super::*;

/// A body that leaves a lower wall at 0, and what decides whether it sticks.
#[derive(Debug, Clone, Copy)]
struct Tail {
    mass: f64,
    damping: f64,
    stiffness: f64,
    /// The load at this instant, N, downwards, and its rate, N/s.
    load: f64,
    rate: f64,
    length: f64,
    resolution: f64,
    time: f64,
    speed: f64,
}

/// 2 kg under 20 N after 3 s, in a scene whose rounding is negligible.
const TAIL: Tail = Tail {
    mass: 2.0,
    damping: 0.0,
    stiffness: 0.0,
    load: 20.0,
    rate: 0.0,
    length: 1e-300,
    resolution: 1e-300,
    time: 3.0,
    speed: 0.0,
};

impl Tail {
    fn event(&self) -> Event {
        let Self { mass, damping, stiffness, load, rate, time, .. } = *self;
        let mut scene = Scene::oscillator(mass, damping, stiffness)
            .with_wall(Wall::lower("floor", 0.0))
            .with_load(Load::constant(-load));
        if rate != 0.0 {
            let table = Table::new(vec![0.0, 2.0 * time], vec![-rate * time, rate * time]);
            scene = scene.with_load(Load::table(table.unwrap()));
        }
        let mut event = Event::new(&scene, 1.0).unwrap();
        (event.time, event.v) = (time, self.speed);
        (event.length, event.resolution) = (self.length, self.resolution);
        event.force_size = [load / mass, 0.0];
        event
    }

    /// Whether the body sticks, and t∞.
    fn sticks(&self, e: f64) -> (bool, Option<f64>) {
        let mut event = self.event();
        (event.sticks(1.0, e, 0.0), event.accumulation)
    }
}

#[test]
fn a_flight_lower_than_1e_12_of_the_scene_is_a_tail_that_ends_after_a_geometric_series() {
    for length in [1.0 / 1024.0, 1.0, 1024.0, 1e30] {
        for share in [0.01, 0.9, 1.1, 1.9, 2.1, 100.0] {
            // Thrown up so high at 10 m/s².
            let speed = f64::sqrt(2.0 * 10.0 * share * 1e-12 * length);
            let tail = Tail { length, speed, ..TAIL };
            for e in [0.25, 0.5, 0.96875] {
                // Flights of 2v/g, each shorter by e.
                let end = 3.0 + 2.0 * speed / 10.0 / (1.0 - e);
                let expected = if share < 1.0 { (true, Some(end)) } else { (false, None) };
                assert_eq!(tail.sticks(e), expected, "{length} {share} {e}");
            }
        }
    }
}

#[test]
fn a_flight_below_the_rounding_of_the_place_or_of_the_time_is_none() {
    for share in [0.01, 0.9, 1.1, 100.0] {
        // Drag doubles the deceleration, or makes it ten times as large.
        for drag in [1.0, 9.0] {
            let (speed, mass) = (4.0, 0.125);
            let load = 10.0 * mass;
            let press = 10.0 + 10.0 * drag;
            let resolution = 0.5 * speed * speed / press / share;
            let damping = drag * load / speed;
            let tail = Tail { mass, damping, load, resolution, time: 0.0, speed, ..TAIL };
            assert_eq!(tail.sticks(0.5), (share < 1.0, None), "{share} {drag}");
        }
        for time in [2.0, 2.0_f64.powi(20), 2.0_f64.powi(80)] {
            // Eight ulps of the time, to and fro at 10 m/s².
            let flight = share * 8.0 * f64::EPSILON * time;
            let tail = Tail { time, speed: 0.5 * 10.0 * flight, ..TAIL };
            assert_eq!(tail.sticks(0.5), (share < 1.0, None), "{share} {time}");
        }
    }
    // An elastic wall may press more than the forces at the start of its arc.
    let walls = [Wall::lower("hard", 0.0), Wall::upper("soft", -0.5).with_elasticity(1e4, 0.0)];
    let mut event = body(&walls, 0.0, &[]);
    assert!(event.arc.touches());
    (event.v, event.resolution, event.length, event.force_size) = (1e-6, 1e-15, 1e-300, [1e-3, 0.0]);
    // 2500 m/s² for 1e-6 m/s: a height of 2e-16 m.
    assert!(event.sticks(1.0, 0.5, 0.0));
}

#[test]
fn a_tail_has_an_end_where_the_pressure_stays_the_same_until_then() {
    let (e, length) = (0.75, 1.0);
    let speed = f64::sqrt(2.0 * 10.0 * 0.5e-12 * length);
    let remaining = 2.0 * speed / 10.0 / (1.0 - e);
    // The rate of 10 m/s² that changes them by a millionth in that time, m/s³.
    let limit = 1e-6 * 10.0 / remaining;
    for (of_load, of_drag, of_spring) in [
        (0.9, 0.0, 0.0),
        (-0.9, 0.0, 0.0),
        (0.0, 0.9, 0.0),
        (0.0, 0.0, 0.9),
        (0.3, 0.3, 0.3),
        (1.1, 0.0, 0.0),
        (-1.1, 0.0, 0.0),
        (0.0, 1.1, 0.0),
        (0.0, 0.0, 1.1),
        (0.6, 0.6, 0.0),
        (0.6, 0.0, 0.6),
        (0.0, 0.6, 0.6),
        (-0.4, 0.4, 0.4),
    ] {
        let tail = Tail {
            rate: of_load * limit * 2.0,
            damping: of_drag * limit * 2.0 / 10.0,
            stiffness: of_spring * limit * 2.0 / speed,
            length,
            speed,
            ..TAIL
        };
        let ends = tail.sticks(e).1;
        let sum = f64::abs(of_load) + of_drag + of_spring;
        assert_eq!(ends.is_some(), sum < 1.0, "{of_load} {of_drag} {of_spring}");
        // The drag itself changes the pressure by 1e-7, and 3 s are rounded.
        assert!(ends.is_none_or(|end| (end - 3.0 - remaining).abs() < 1e-6 * remaining), "{ends:?}");
    }
}

/// How long impacts at e = 1 go on until the speed has fallen from `u` to `least` (m/s): each
/// flight of 2u/p loses 2cu²/3mp.
fn settling(mass: f64, damping: f64, press: f64, mut u: f64, least: f64) -> f64 {
    let mut time = 0.0;
    while u > least {
        time += 2.0 * u / press;
        u -= 2.0 * damping * u * u / (3.0 * mass * press);
    }
    time
}

#[test]
fn impacts_die_of_drag_where_the_load_cannot_lift_the_body_before() {
    let (mass, press, speed, least) = (0.5, 8.0, 2.5, 0.05);
    let damping = 0.01 * mass * press / speed;
    let remaining = settling(mass, damping, press, speed, least);
    let half = 0.5 * press * mass;
    for share in [0.97, 1.03] {
        for parts in [[0.6, 0.2, 0.2], [0.2, 0.6, 0.2], [0.2, 0.2, 0.6], [0.9, 0.05, 0.05]] {
            let [of_load, of_drag, of_spring] = parts.map(|part| share * part * half);
            // Half of the spring and most of the drag are those of another wall.
            let spring = of_spring / (0.5 * speed * speed / press);
            let other = Wall::lower("soft", -5.0).with_elasticity(0.5 * spring, of_drag / speed - damping);
            let scene =
                Scene::oscillator(mass, damping, 0.5 * spring).with_wall(Wall::lower("floor", 0.0)).with_wall(other);
            let mut event = Event::new(&scene, 1.0).unwrap();
            event.sizes[3] = of_load / remaining;
            // The least speed is that of a flight as high as the displacement is resolved, or as
            // long as eight ulps of the time.
            for (resolution, time) in
                [(0.5 * least * least / press, 0.0), (1e-300, 2.0 * least / press / (8.0 * f64::EPSILON))]
            {
                (event.resolution, event.time) = (resolution, time);
                assert_eq!(event.dies_of_drag(speed, press), share < 1.0, "{share} {parts:?} {resolution:e} {time:e}");
            }
        }
    }
}
