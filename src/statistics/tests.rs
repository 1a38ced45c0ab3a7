//! What begins, ends or happens at the very edge of a window, and what does not happen at all.

use super::*;
use crate::linear::Symmetric;
use crate::scene::{Face, Load, PlaneRows, Row, Scene, Side, Structure, Wall};
use crate::step::Step;

fn contact(wall: usize, start: f64, end: f64, peak_force: Option<f64>) -> Contact {
    let (impulse, speed) = (-1.0, 1.0);
    Contact { wall, start, end: Some(end), impulse, peak_force, approach_speed: speed, departure_speed: Some(speed) }
}

/// A body in two planes between two flats, which are one support.
fn between_flats(duration: f64) -> Scene {
    let unit = |x: f64| Symmetric::diagonal(&[x, x]);
    let structure = Structure { mass: unit(1.0), damping: unit(0.0), stiffness: unit(1.0) };
    let flat = |side: Side, position, degrees| Face::Flat { side, position, at: Row::dof(0), direction: Some(degrees) };
    let right = Wall { face: flat(Side::Upper, 1.0, 0.0), ..Wall::upper("right", 1.0) };
    let left = Wall { face: flat(Side::Lower, -1.0, 180.0), ..Wall::lower("left", -1.0) };
    let at = PlaneRows { y: Row::dof(0), z: Row::dof(1) };
    Scene::structure(structure).with_duration(duration).with_support("plate", at, [0.0; 2], vec![right, left])
}

/// A step on a grid in which the first wall gives `impulse`, of which `jump` at its end.
fn step<'a>(index: u64, [start, end]: [f64; 2], impulse: &'a [f64], jump: &'a [f64]) -> Step<'a> {
    let none = &[0.0; 2];
    Step {
        index,
        start,
        end,
        q: &[1.0, 0.0],
        velocity_before: &[2.0, 0.0],
        impulse,
        jump,
        friction: none,
        ..Step::still(none, none)
    }
}

#[test]
fn ten_contacts_make_an_interval_and_nothing_at_all_makes_none_that_is_no_number() {
    let (none, window) = (NO_SUMS, Window::new(&between_flats(10.0), 0.0));
    assert_eq!(window.ratio_half_width(&none, &none), None);
    assert!(!window.has_interval(&none, 9) && window.has_interval(&none, 10));
    assert_eq!((window.mean(&none), window.half_width(&none)), (0.0, Some(0.0)));
    assert_eq!(window.root_mean(&none, true), (0.0, Some(0.0)));
    let mut one = NO_SUMS;
    one[..BATCHES].fill(1.0);
    assert!(window.has_interval(&one, 0));
    one[3] = 0.0;
    assert!(!window.has_interval(&one, 0));
}

/// Draws that are nearly normal: sums of twelve even ones.
struct Normal(u64);

impl Normal {
    fn next(&mut self) -> f64 {
        let even = |state: &mut u64| {
            // xorshift64* (Vigna 2016, doi:10.1145/2845077).
            *state ^= *state >> 12;
            *state ^= *state << 25;
            *state ^= *state >> 27;
            (state.wrapping_mul(0x2545_f491_4f6c_dd1d) >> 11) as f64 / (1_u64 << 53) as f64
        };
        (0..12).map(|_| even(&mut self.0)).sum::<f64>() - 6.0
    }
}

#[test]
fn nineteen_of_twenty_intervals_hold_the_mean_also_of_draws_that_depend_on_each_other() {
    // xₖ = φ xₖ₋₁ + normal draws, of mean 0: with φ = 0.9 a draw is forgotten after 19 others, and
    // a batch has 200.
    let (trials, count) = (1000, 10 * 200_u32);
    for (phi, periodic) in [(0.0, false), (0.9, false), (0.9, true)] {
        let loads = if periodic { vec![Load::harmonic(1.0, 1.0, 0.0)] } else { Vec::new() };
        let window = Window::new(&Scene { loads, ..between_flats(12.0) }, 0.0);
        let mut normal = Normal(0x9e37_79b9_7f4a_7c15);
        let held = (0..trials).filter(|_| {
            let (mut sums, mut x) = (NO_SUMS, 0.0);
            for k in 0..count {
                x = phi * x + normal.next();
                sums[window.index(window.length * (f64::from(k) + 0.5) / f64::from(count))] += x;
            }
            window.mean(&sums).abs() <= window.half_width(&sums).unwrap()
        });
        // 950 of 1000, with a standard deviation of 7; three of them either way.
        let held = held.count();
        assert!((929..=971).contains(&held), "{phi} {periodic}: {held}");
    }
}

#[test]
fn batches_are_whole_periods_of_loads_that_have_one_and_end_with_the_window() {
    // Length of the window in periods of 0.5 s: batches, periods in each, periods before the first.
    for (all, batches, periods, before) in [
        (40.0, 10, Some(4), 0.0),
        (10.5, 10, Some(1), 0.5),
        (12.0, 6, Some(2), 0.0),
        (19.25, 9, Some(2), 1.25),
        (8.0, 8, Some(1), 0.0),
        (3.75, 3, Some(1), 0.75),
        (2.5, 2, None, 0.0),
    ] {
        let scene = Scene { loads: vec![Load::harmonic(1.0, 2.0, 0.3)], ..between_flats(1.0 + 0.5 * all) };
        let window = Window::new(&scene, 1.0);
        assert_eq!((window.batches, window.periods), (batches, periods), "{all}");
        assert!((window.first - 1.0 - 0.5 * before).abs() < 1e-12, "{all}");
        // What comes once a period has no scatter, but what is left out beside the batches counts.
        let (mut counts, step) = (NO_SUMS, 1e-3);
        let mut at = 1.0 + 0.5 * step;
        while at < scene.duration {
            counts[window.index(at)] += if (at / 0.5).fract() < 0.1 { step } else { 0.0 };
            at += step;
        }
        let share = counts.iter().sum::<f64>() / window.length;
        assert!((window.mean(&counts) - share).abs() < 1e-12, "{all}");
        match window.half_width(&counts) {
            None => assert_eq!(batches, 2),
            // Rounding moves a count or two from one batch to the next.
            Some(half) => assert!((half - (share - 0.1).abs()).abs() < 3.0 * step / (0.5 * all), "{all}: {half}"),
        }
    }
    // Loads that do not repeat themselves: ten equal parts.
    let incommensurable = vec![Load::harmonic(1.0, 2.0, 0.0), Load::harmonic(1.0, 2.0_f64.sqrt(), 0.0)];
    for loads in [Vec::new(), incommensurable] {
        let window = Window::new(&Scene { loads, ..between_flats(7.3) }, 1.0);
        assert_eq!((window.batches, window.periods, window.first), (BATCHES, None, 1.0));
    }
}

#[test]
fn a_window_without_length_has_no_rates_and_no_intervals() {
    let scene = between_flats(1.0);
    let contacts: Vec<Contact> = (0..10).map(|_| contact(0, 1.0, 1.0, None)).collect();
    let statistics = Statistics::new(&scene, &contacts, 1.0);
    assert_eq!((statistics.walls[0].contacts, &statistics.walls[0].half_width_95), (10, &None));
    assert_eq!(EpisodeStatistics::of(&scene, &statistics, &contacts, 0.1)[0].episodes_per_s, 0.0);
    let (mut forces, mut wear) = (Forces::new(&scene, 1.0, 0.1), WearTally::new(&scene, 1.0, 4));
    let last = step(9, [0.9, 1.0], &[-1.0, 0.0], &[-1.0, 0.0]);
    forces.observe(&last);
    wear.observe(&last);
    assert_eq!(forces.statistics(0, 10), None);
    assert!(wear.statistics().is_empty());
}

#[test]
fn a_support_has_the_contacts_that_begin_in_the_window_and_the_forces_of_those_that_reach_it() {
    let contacts = [
        contact(0, 0.1, 0.2, Some(9.0)),
        contact(1, 0.3, 0.6, Some(5.0)),
        contact(0, 0.5, 0.6, Some(2.0)),
        contact(1, 0.7, 0.9, Some(2.0)),
    ];
    let support = &Statistics::new(&between_flats(1.0), &contacts, 0.5).supports[0];
    assert_eq!(support.contacts, 2);
    assert_eq!((support.episode_peak_force_n.mean, support.episode_peak_force_n.max), (Some(3.0), Some(5.0)));
    // An impact has no largest force, so those of the other contacts are not the largest.
    let struck = [&contacts[..], &[contact(0, 0.95, 0.95, None)]].concat();
    let support = &Statistics::new(&between_flats(1.0), &struck, 0.5).supports[0];
    assert_eq!((support.contacts, support.episode_peak_force_n.max), (3, None));
}

#[test]
fn the_largest_force_of_an_elastic_support_is_at_an_instant_and_of_a_rigid_one_a_mean_over_a_stretch() {
    let elastic = |scene: Scene| {
        let walls = scene.walls.into_iter().map(|wall| wall.with_elasticity(1e3, 0.0)).collect();
        Scene { walls, ..scene }
    };
    let contacts = [contact(0, 0.52, 0.58, Some(9.0)), contact(1, 0.7, 0.9, Some(2.0))];
    let largest = |scene: &Scene, impulse: [f64; 2]| {
        let mut forces = Forces::new(scene, 0.0, 0.1);
        forces.observe(&step(0, [0.5, 0.6], &impulse, &[0.0; 2]));
        let statistics = Statistics::new(scene, &contacts, 0.0).with_forces(&forces);
        statistics.supports[0].force_largest.expect("a push")
    };
    // Means of 5 N over 0.1 s by one flat; of 5 N and 6 N by both.
    let (rigid, springs) = (between_flats(1.0), elastic(between_flats(1.0)));
    for (scene, impulse, expected, over) in
        [(&rigid, [0.5, 0.0], 5.0, 0.1), (&springs, [0.5, 0.0], 9.0, 0.0), (&springs, [0.5, 0.6], 11.0, 0.1)]
    {
        let found = largest(scene, impulse);
        assert!((found.mean_n - expected).abs() < 1e-12 && found.averaged_over_s == over, "{found:?}");
        assert!((found.at_s - 0.55).abs() < 1e-12, "{found:?}");
    }
}

#[test]
fn a_round_wall_has_its_own_contacts_and_the_impulse_of_its_force() {
    let at = PlaneRows { y: Row::dof(0), z: Row::dof(1) };
    let ring = Wall::round("ring", at.clone(), 1.0);
    let scene = between_flats(3.0).with_support("ring", at, [0.0; 2], vec![ring]);
    let contacts = [contact(0, 2.0, 2.0, None), contact(2, 0.25, 0.25, None), contact(2, 2.5, 2.5, None)];
    let statistics = Statistics::new(&scene, &contacts, 1.0);
    assert_eq!((statistics.walls[2].contacts, statistics.supports[1].contacts), (1, 1));
    // Half a newton second in each step of which one lies in the window, from 1 s on.
    let mut forces = Forces::new(&scene, 1.0, 0.1);
    for start in [0.5, 2.0] {
        let (impulse, planes) = ([0.0, 0.0, 0.5], [[0.0; 2]; 3]);
        let normal = [[0.0; 2], [0.0; 2], [1.0, 0.0]];
        let one = Step {
            normal: &normal,
            turned: &planes,
            friction: &[0.0; 3],
            ..step(0, [start, start + 0.1], &impulse, &[0.0; 3])
        };
        forces.observe(&Step { force: &[0.0; 3], ..one });
    }
    let statistics = statistics.with_forces(&forces);
    assert_eq!(statistics.impulse(2), 0.5);
    // 0.5 N s over the two seconds of the window.
    let force = statistics.supports[1].force.expect("a window");
    assert!((force.mean_n - 0.25).abs() < 1e-15 && (force.mean_vector_n[0] + 0.25).abs() < 1e-15, "{force:?}");
}

#[test]
fn contacts_are_one_episode_if_less_than_the_rest_lies_between_them_and_not_if_just_the_rest_does() {
    let scene = between_flats(2.5);
    let contacts = [0.5, 1.0, 2.0].map(|start| contact(0, start, start, None));
    let statistics = Statistics::new(&scene, &contacts, 0.5);
    // The first begins with the window.
    for (rest, episodes) in [(0.5, 3), (0.75, 2), (1.0, 2), (1.25, 1)] {
        let found = &EpisodeStatistics::of(&scene, &statistics, &contacts, rest)[0];
        assert_eq!((found.episodes, found.episodes_per_s), (episodes, 0.5 * episodes as f64), "{rest} s");
    }
}

#[test]
fn an_impact_at_the_beginning_of_the_window_counts_and_one_after_its_end_does_not() {
    let scene = between_flats(12.0);
    let total = |span: [f64; 2], jump: f64| {
        let mut forces = Forces::new(&scene, 2.0, 0.1);
        forces.observe(&step(0, span, &[-3.0, 0.0], &[jump, 0.0]));
        forces.statistics(0, 0).map(|force| force.impulse_n_s)
    };
    assert_eq!(total([1.5, 2.0], -3.0), Some(-3.0));
    assert_eq!(total([1.5, 1.75], -3.0), Some(0.0));
    assert_eq!(total([11.5, 12.0], -3.0), Some(-3.0));
    assert_eq!(total([11.5, 12.5], -3.0), Some(0.0));
    // Of a force over a step the part in the window: a sum over five intervals.
    assert!(total([11.5, 12.5], 0.0).is_some_and(|p| (p + 1.5).abs() < 1e-12));
    assert!(total([1.5, 2.5], 0.0).is_some_and(|p| (p + 1.5).abs() < 1e-12));
}

#[test]
fn a_support_at_which_nothing_slides_has_no_shares_of_nothing() {
    let scene = between_flats(10.0);
    let mut wear = WearTally::new(&scene, 0.0, 4);
    let untouched = &wear.statistics()[0];
    assert!(untouched.sectors.iter().all(|sector| sector.impulse_share == 0.0 && sector.work_rate_w == 0.0));
    assert_eq!((untouched.impact_share, untouched.sliding_speed_m_per_s), (None, None));
    assert_eq!(untouched.work_rate_half_width_95_w, None);
    // An impact straight onto a flat: all of the impulse in its sector, and no work.
    wear.observe(&step(3, [0.3, 0.4], &[-2.0, 0.0], &[0.0, 0.0]));
    let struck = &wear.statistics()[0];
    assert_eq!(struck.sectors.iter().map(|sector| sector.impulse_share).sum::<f64>(), 1.0);
    assert_eq!((struck.impact_share, struck.sliding_speed_m_per_s), (None, None));
    assert_eq!((struck.work_rate_w, struck.work_rate_half_width_95_w), (0.0, None));
}

#[test]
fn places_are_named_in_files() {
    assert_eq!([PlaceKind::Wall.word(), PlaceKind::Support.word()], ["wall", "support"]);
}
