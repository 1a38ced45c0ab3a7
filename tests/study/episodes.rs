//! Contacts joined into episodes, and their distributions.

use signorini::{Contact, EpisodeStatistics, Load, Options, PlaceKind, Scene, Scheme, State, Statistics, Wall, run};

fn contact(wall: usize, start: f64, end: Option<f64>, impulse: f64, approach: f64) -> Contact {
    let (approach_speed, departure_speed) = (approach, end.map(|_| 0.5 * approach));
    Contact { wall, start, end, impulse, peak_force: None, approach_speed, departure_speed }
}

fn two_walls() -> Scene {
    let scene = Scene::oscillator(1.0, 0.0, 100.0).with_wall(Wall::upper("upper", 1e-3));
    scene.with_wall(Wall::lower("lower", -1e-3)).with_duration(2.0)
}

#[test]
fn contacts_are_joined_where_less_than_the_rest_lies_between_them() {
    let scene = two_walls();
    let contacts = [
        contact(0, 0.10, Some(0.10), -1.0, 0.1),
        contact(0, 0.50, Some(0.50), -2.0, 0.3),
        contact(1, 0.505, Some(0.505), 8.0, 0.9),
        contact(0, 0.51, Some(0.60), -3.0, 0.2),
        contact(0, 0.625, Some(0.625), -4.0, 0.4),
        contact(0, 1.50, None, -5.0, 0.5),
    ];
    let statistics = Statistics::new(&scene, &contacts, 0.2);
    let of = |rest: f64| EpisodeStatistics::of(&scene, &statistics, &contacts, rest);
    // The first began before the window. Between the others lie 0.01, 0.025 and 0.875 s.
    for (rest, episodes, impulses) in
        [(0.0, 4, vec![2.0, 3.0, 4.0, 5.0]), (0.02, 3, vec![5.0, 4.0, 5.0]), (0.03, 2, vec![9.0, 5.0])]
    {
        let all = of(rest);
        let upper = &all[0];
        assert_eq!((upper.place.name.as_str(), upper.place.kind, upper.episodes), ("upper", PlaceKind::Wall, episodes));
        assert!((upper.episodes_per_s - episodes as f64 / 1.8).abs() < 1e-12);
        let impulse = upper.impulse_n_s.as_ref().unwrap();
        assert!((impulse.mean - impulses.iter().sum::<f64>() / episodes as f64).abs() < 1e-15);
        assert_eq!(impulse.max, impulses.iter().copied().fold(0.0, f64::max));
        assert_eq!(upper.approach_speed_m_per_s.as_ref().unwrap().max, 0.5);
        assert!(upper.peak_force_n.is_none());
        // The other wall keeps its own.
        assert_eq!((all[1].episodes, all[1].impulse_n_s.as_ref().unwrap().max), (1, 8.0));
    }
    // The largest approach of the joined episode is that of its last contact.
    assert!((of(0.03)[0].approach_speed_m_per_s.as_ref().unwrap().quantiles[0] - 0.45).abs() < 1e-15);
    let none = EpisodeStatistics::of(&scene, &Statistics::new(&scene, &[], 0.0), &[], 0.0);
    assert!(none.iter().all(|one| one.episodes == 0 && one.impulse_n_s.is_none()));
}

#[test]
fn the_last_bounces_of_a_ball_are_one_episode() {
    // 2 kg fall from 1 m at e = 0.8 under 9.81 m/s²: impact k = 0, 1, … at the speed v e^k, and
    // between it and the next 2 v e^(k+1)/g. Flights shorter than 0.05 s are joined.
    let (mass, g, e, rest) = (2.0, 9.81, 0.8_f64, 0.05);
    let initial = State { q: vec![1.0], v: vec![0.0] };
    let scene = Scene::oscillator(mass, 0.0, 0.0).with_wall(Wall::lower("floor", 0.0).with_restitution(e));
    let scene = Scene { initial, ..scene.with_load(Load::constant(-mass * g)).with_duration(6.0) };
    let run = run(&scene, &Scheme::Event, &Options::with_step(1e-3)).unwrap();
    let v = (2.0 * g).sqrt();
    let flight = |k: i32| 2.0 * v * e.powi(k + 1) / g;
    let alone = (0..).find(|&k| flight(k) < rest).unwrap();
    let all = EpisodeStatistics::of(&scene, &run.statistics, run.trajectory.contacts(), rest);
    let floor = &all[0];
    assert_eq!(floor.episodes, alone as usize + 1);
    // The last one holds what is left of the floor's impulse: the momentum that arrives with impact
    // `alone`, and the weight from then on.
    let arrival = (2.0 / g).sqrt() + (0..alone).map(flight).sum::<f64>();
    let last = mass * v * e.powi(alone) + mass * g * (6.0 - arrival);
    let impulse = floor.impulse_n_s.as_ref().unwrap();
    // The exact scheme closes the accumulation at rounding, relative to the first impact.
    assert!((impulse.max / last - 1.0).abs() < 1e-9, "{} {last}", impulse.max);
    let speed = floor.approach_speed_m_per_s.as_ref().unwrap();
    assert!((speed.max / v - 1.0).abs() < 1e-12);
    let mean = (0..=alone).map(|k| v * e.powi(k)).sum::<f64>() / f64::from(alone + 1);
    assert!((speed.mean / mean - 1.0).abs() < 1e-9, "{} {mean}", speed.mean);
}

#[test]
fn elastic_walls_alone_have_peak_forces() {
    let wall = |elastic: bool| {
        let stop = Wall::upper("stop", 1e-3);
        if elastic { stop.with_elasticity(1e5, 0.0) } else { stop.with_restitution(0.5) }
    };
    for elastic in [true, false] {
        let scene = Scene::oscillator(1.0, 0.2, 100.0).with_wall(wall(elastic));
        let scene = scene.with_load(Load::harmonic(3.0, 5.0, 0.0)).with_duration(2.0);
        let run = run(&scene, &Scheme::Event, &Options::with_step(1e-3)).unwrap();
        let all = EpisodeStatistics::of(&scene, &run.statistics, run.trajectory.contacts(), 0.0);
        assert_eq!(all[0].peak_force_n.is_some(), elastic);
        if let Some(peak) = &all[0].peak_force_n {
            assert_eq!(Some(peak.max), run.statistics.walls[0].episode_peak_force_n.max);
            assert_eq!(peak.thresholds.len(), 20);
            assert_eq!(peak.exceedances[0], all[0].episodes);
        }
    }
}
