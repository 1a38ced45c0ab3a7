//! Motions do not depend on the units: scaled by powers of two, which change no rounding, every
//! number is the same.

use super::*;
use crate::step::Contact;

#[derive(Debug, Clone, Copy)]
struct Units {
    length: f64,
    mass: f64,
    time: f64,
}

impl Units {
    fn force(self) -> f64 {
        self.mass * self.length / (self.time * self.time)
    }

    fn stiffness(self) -> f64 {
        self.force() / self.length
    }

    fn speed(self) -> f64 {
        self.length / self.time
    }

    fn body(self, [mass, damping, stiffness]: [f64; 3], q: f64, v: f64) -> Scene {
        let s = self.stiffness();
        Scene::oscillator(mass * self.mass, damping * s * self.time, stiffness * s)
            .with_initial(&[q * self.length], &[v * self.speed()])
            .with_duration(8.0 * self.time)
    }

    fn lower(self, name: &str, place: f64) -> Wall {
        Wall::lower(name, place * self.length)
    }

    fn upper(self, name: &str, place: f64) -> Wall {
        Wall::upper(name, place * self.length)
    }

    fn soft(self, wall: Wall, k: f64, c: f64) -> Wall {
        wall.with_elasticity(k * self.stiffness(), c * self.stiffness() * self.time)
    }

    fn constant(self, force: f64) -> Load {
        Load::constant(force * self.force())
    }

    fn sine(self, force: f64, frequency: f64) -> Load {
        Load::harmonic(force * self.force(), frequency / self.time, 0.3)
    }

    fn table(self, time: &[f64], force: &[f64]) -> Load {
        let scaled = |x: &[f64], by: f64| x.iter().map(|x| x * by).collect();
        Load::table(Table::new(scaled(time, self.time), scaled(force, self.force())).unwrap())
    }

    fn blow(self, impulse: f64, time: f64) -> Load {
        Load::impulse(impulse * self.force() * self.time, time * self.time)
    }

    fn scenes(self) -> Vec<Scene> {
        let e = |wall: Wall, e: f64| wall.with_restitution(e);
        vec![
            // Chatter between walls, with blows.
            self.body([1.5, 0.4, 30.0], 0.0, 0.5)
                .with_wall(e(self.lower("lower", -0.1), 0.7))
                .with_wall(e(self.upper("upper", 0.15), 0.4))
                .with_load(self.sine(9.0, 0.9))
                .with_load(self.blow(-2.0, 1.7)),
            // A ball comes to rest, is lifted by a ramp and a sine, and lands again.
            self.body([2.0, 0.0, 0.0], 1.0, 0.0)
                .with_wall(e(self.lower("floor", 0.0), 0.5))
                .with_load(self.constant(-20.0))
                .with_load(self.table(&[0.0, 4.0, 5.0, 6.0, 8.0], &[0.0, 0.0, 24.0, 0.0, 1.0]))
                .with_load(self.sine(0.7, 1.3)),
            // Elastic walls with and without dashpots before a rigid one.
            self.body([1.0, 0.1, 5.0], 0.2, -3.0)
                .with_wall(self.soft(self.lower("soft", -0.2), 300.0, 9.0))
                .with_wall(self.soft(self.upper("spring", 0.4), 500.0, 0.0))
                .with_wall(e(self.lower("hard", -0.3), 0.6))
                .with_load(self.sine(8.0, 0.7)),
            // Near resonance, let go by walls that stop it.
            self.body([1.0, 2e-4, 100.0], 0.0, 0.0)
                .with_wall(e(self.upper("upper", 5e-3), 0.0))
                .with_wall(e(self.lower("lower", -5e-3), 0.1))
                .with_load(self.sine(3.0, 1.5915)),
            // Impacts that die of drag.
            self.body([1e-3, 2e3, 0.0], 0.02, 0.0).with_wall(self.lower("floor", 0.0)).with_load(self.constant(-9.81)),
            // A creeping body, which fades at a wall.
            self.body([1e-3, 20.0, 1e4], 1e-3, -1.0).with_wall(self.soft(self.lower("soft", 0.0), 50.0, 500.0)),
            // A slow sway, at rest on a wall for a while.
            self.body([3.0, 0.2, 0.5], 0.3, 0.2)
                .with_wall(e(self.upper("upper", 0.5), 0.0))
                .with_wall(self.lower("lower", -0.9))
                .with_load(self.sine(2.0, 0.2))
                .with_load(self.constant(0.4)),
        ]
    }
}

/// Everything that a run shows, in units of one.
#[derive(Debug, PartialEq)]
struct StepOutput {
    state: Vec<[f64; 3]>,
    impulse: Vec<f64>,
    force: Vec<f64>,
    contacts: Vec<Contact>,
    accumulation: Option<f64>,
    counters: EventCounters,
}

fn follow(scene: &Scene, stride: f64, units: Units) -> StepOutput {
    let mut event = Event::new(scene, stride * units.time).unwrap();
    let (mut state, mut impulse, mut force, mut contacts) = (vec![], vec![], vec![], vec![]);
    let Units { time, .. } = units;
    while !event.is_done() {
        event.advance(0.0).unwrap();
        state.push([event.end() / time, event.q()[0] / units.length, event.v()[0] / units.speed()]);
        impulse.extend(event.step().impulse.iter().map(|p| p / (units.force() * time)));
        force.extend(event.step().force.iter().map(|f| f / units.force()));
        contacts.extend(event.step().closed.iter().map(|c| Contact {
            start: c.start / time,
            end: c.end.map(|t| t / time),
            impulse: c.impulse / (units.force() * time),
            peak_force: c.peak_force.map(|f| f / units.force()),
            approach_speed: c.approach_speed / units.speed(),
            departure_speed: c.departure_speed.map(|v| v / units.speed()),
            ..*c
        }));
        assert!(state.len() < 3000, "{:?}", state.last());
    }
    StepOutput {
        state,
        impulse,
        force,
        contacts,
        accumulation: event.accumulation().map(|t| t / time),
        counters: event.counters(),
    }
}

#[test]
fn a_run_in_other_units_is_the_same_to_the_last_digit() {
    let one = Units { length: 1.0, mass: 1.0, time: 1.0 };
    let mut contacts = 0;
    for (number, scene) in one.scenes().iter().enumerate() {
        for stride in [0.5, 8.0] {
            let expected = follow(scene, stride, one);
            contacts += expected.contacts.len();
            for [length, mass, time] in [[20, 10, 20], [-24, 7, -30], [8, -30, 40], [0, 0, -60]] {
                let [length, mass, time] = [length, mass, time].map(|n: i32| f64::powi(2.0, n));
                let units = Units { length, mass, time };
                let found = follow(&units.scenes()[number], stride, units);
                assert_eq!(found.counters, expected.counters, "{number} {stride} {units:?}");
                for (found, expected) in found.state.iter().zip(&expected.state) {
                    assert_eq!(found, expected, "{number} {stride} {units:?}");
                }
                assert!(found == expected, "{number} {stride} {units:?}");
            }
        }
    }
    assert!(contacts > 200, "{contacts}");
}
