//! Steps given one by one, many at once and between rows make the same rows.

use super::*;
use crate::scene::{Face, PlaneRows, Support, Wall};
use crate::step::{Balance, Conserves, Contract, Promise, Tolerances};

fn scene(duration: f64) -> Scene {
    Scene::oscillator(1.0, 0.0, 1.0).with_wall(Wall::upper("stop", 2.0)).with_duration(duration)
}

/// What a step of one body shows: its times, q and v at its end, v at its start, and the impulse.
struct Shown {
    span: [f64; 2],
    q: [f64; 1],
    v: [f64; 1],
    before: [f64; 1],
    impulse: [f64; 1],
}

impl Shown {
    fn step<'a>(&'a self, index: u64, path: Path<'a>) -> Step<'a> {
        let [start, end] = self.span;
        Step {
            index,
            start,
            end,
            q: &self.q,
            v: &self.v,
            velocity_before: &self.before,
            velocity_after: &self.v,
            impulse: &self.impulse,
            path,
            ..Step::still(&[0.0], &[0.0])
        }
    }
}

#[test]
fn the_last_row_is_at_the_end_itself() {
    let mut rounded = 0;
    for tenths in 1..50 {
        let duration = f64::from(tenths) * 0.1;
        for rows in 1..60 {
            let recorder = Recorder::new(&scene(duration), rows, &[0.0], &[0.0]);
            assert_eq!(recorder.row_time(rows), duration, "{rows} rows");
            // A quotient by the rate would be another number.
            rounded += u32::from(rows as f64 / (rows as f64 / duration) != duration);
        }
    }
    assert!(rounded > 10, "{rounded}");
}

#[test]
fn steps_seen_together_make_the_rows_of_steps_seen_one_by_one() {
    let mut beside_a_support = scene(1.0);
    if let Face::Flat { direction, .. } = &mut beside_a_support.walls[0].face {
        *direction = Some(0.0);
    }
    let at = PlaneRows { y: Row::dof(0), z: Row::new(Vec::new()) };
    beside_a_support.supports.push(Support { name: "plate".into(), at, centre: [0.0; 2], walls: 0..1 });
    for scene in [scene(1.0), beside_a_support] {
        // Impulses before a row, which belong to it; two steps make a row.
        for pushed in [0, 1, 2] {
            let at = |k: u64| 0.05 * k as f64;
            let shown = |k: u64| Shown {
                span: [at(k), at(k + 1)],
                q: [at(k + 1).sin()],
                v: [at(k + 1).cos()],
                before: [at(k).cos()],
                impulse: [if k < pushed { -1.0 } else { 0.0 }],
            };
            let start = || Recorder::new(&scene, 10, &[0.0], &[1.0]);
            let (mut one, mut many, mut quiet) = (start(), start(), QuietSteps::new(1));
            for k in 0..20 {
                let shown = shown(k);
                one.observe(&shown.step(k, Path::Grid));
                if k < pushed {
                    many.observe(&shown.step(k, Path::Grid));
                } else {
                    assert!(quiet.take(&shown.step(k, Path::Grid)));
                    if k % 7 == 6 || k == 19 {
                        many.observe_quiet(&quiet);
                        quiet.clear();
                    }
                }
            }
            let (one, many) = (one.finish(&[]), many.finish(&[]));
            assert_eq!((one.time().len(), one.time()[10]), (11, 1.0));
            assert_eq!(one, many, "{pushed} steps with an impulse");
        }
    }
}

#[test]
fn an_impulse_waits_for_its_row_however_many_steps_come_between() {
    let start = || Recorder::new(&scene(1.0), 1, &[0.0], &[0.0]);
    let (mut one, mut many, mut quiet) = (start(), start(), QuietSteps::new(1));
    for k in 0..512 {
        let at = |k: u64| k as f64 / 512.0;
        let (q, impulse) = ([at(k + 1)], [if k == 0 { -1.0 } else { 0.0 }]);
        let shown = Shown { span: [at(k), at(k + 1)], q, v: [1.0], before: [1.0], impulse };
        one.observe(&shown.step(k, Path::Grid));
        if k == 0 {
            many.observe(&shown.step(k, Path::Grid));
        } else {
            assert!(quiet.take(&shown.step(k, Path::Grid)));
        }
        if quiet.is_full() || k == 511 {
            many.observe_quiet(&quiet);
            quiet.clear();
        }
    }
    let (one, many) = (one.finish(&[]), many.finish(&[]));
    assert_eq!(one.contact_impulses()[0], [0.0, -1.0]);
    assert_eq!(one, many);
}

fn contract() -> Contract {
    Contract {
        balance: Balance::Theta(0.5),
        promise: Promise::throughout(),
        instant: 0.5,
        tolerances: Tolerances::of(Conserves::Nothing),
        divides: false,
    }
}

#[test]
fn a_row_at_which_the_first_step_handed_over_begins_has_the_velocity_there() {
    let mut recorder = Recorder::new(&scene(1.0), 4, &[0.0], &[1.0]);
    let shown = Shown { span: [0.25, 0.5], q: [1.0], v: [-3.0], before: [1.0], impulse: [-4.0] };
    recorder.observe(&shown.step(1, Path::Handed { contract: &contract(), step: 0.25 }));
    let found = recorder.finish(&[]);
    assert_eq!((found.time(), found.velocity()), (&[0.0, 0.25, 0.5][..], &[1.0, 1.0, -3.0][..]));
    assert_eq!(found.displacement(), [0.0, 1.25, 1.0]);
}

#[test]
fn rows_within_steps_that_were_handed_over_lie_straight_between_their_ends() {
    let contract = contract();
    // Speeds before and after each step; the displacement grows by their mean times the length.
    let steps = [(0.125, 1.0, 3.0), (0.625, 3.0, -1.0), (0.75, -1.0, 0.5), (1.0, 0.5, 0.5)];
    let mut recorder = Recorder::new(&scene(1.0), 4, &[0.0], &[1.0]);
    let (mut t, mut q) = (0.0, 0.0);
    for (index, (end, before, after)) in (0..).zip(steps) {
        let mean = 0.5 * (before + after);
        q += mean * (end - t);
        let shown = Shown { span: [t, end], q: [q], v: [after], before: [before], impulse: [-1.0] };
        recorder.observe(&shown.step(index, Path::Handed { contract: &contract, step: end - t }));
        t = end;
    }
    let found = recorder.finish(&[]);
    assert_eq!(found.time(), [0.0, 0.25, 0.5, 0.75, 1.0]);
    // 0.25 m after the first step, then 1 m/s; −0.25 m/s from 0.75 m at 0.625 s on, then 0.5 m/s.
    assert_eq!(found.displacement(), [0.0, 0.375, 0.625, 0.71875, 0.84375]);
    assert_eq!(found.velocity(), [1.0, -1.0, -1.0, 0.5, 0.5]);
    // The impulses of all steps that had begun.
    assert_eq!(found.contact_impulses()[0], [0.0, -2.0, 0.0, -1.0, -1.0]);
}

#[test]
fn steps_with_friction_or_holes_that_the_scene_does_not_have_are_passed_over() {
    let shown = Shown { span: [0.0, 0.5], q: [1.0], v: [1.0], before: [1.0], impulse: [-1.0] };
    let record = |friction: &[f64]| {
        let mut recorder = Recorder::new(&scene(1.0), 2, &[0.0], &[1.0]);
        recorder.observe(&Step { friction, ..shown.step(0, Path::Grid) });
        recorder.finish(&[]).time().len()
    };
    assert_eq!((record(&[]), record(&[0.0])), (2, 1));
}
