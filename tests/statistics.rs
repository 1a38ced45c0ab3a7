//! Contact statistics against sums done by hand.

use signorini::{Contact, Scene, Statistics, Wall};

fn scene() -> Scene {
    // 2 kg, ten seconds.
    Scene::oscillator(2.0, 0.0, 1.0)
        .with_wall(Wall::upper("upper", 1.0))
        .with_wall(Wall::lower("lower", -1.0).with_elasticity(10.0, 0.0))
        .with_duration(10.0)
}

fn impact(start: f64, impulse: f64, approach: f64, departure: f64) -> Contact {
    Contact {
        wall: 0,
        start,
        end: Some(start),
        impulse,
        peak_force: None,
        approach_speed: approach,
        departure_speed: Some(departure),
    }
}

fn lasting(start: f64, end: Option<f64>, impulse: f64, peak: f64, approach: f64, departure: Option<f64>) -> Contact {
    Contact {
        wall: 1,
        start,
        end,
        impulse,
        peak_force: Some(peak),
        approach_speed: approach,
        departure_speed: departure,
    }
}

/// Sums of a few short decimals.
fn close(found: Option<f64>, expected: f64) {
    let found = found.expect("a value");
    assert!((found - expected).abs() < 1e-15 * expected.abs().max(1.0), "{found}, expected {expected}");
}

#[test]
fn impacts_are_counted_and_their_impulses_and_energies_summed() {
    let contacts = [impact(1.0, -3.0, 1.0, 0.5), impact(2.0, -4.0, 1.5, 0.5), impact(7.0, -12.0, 4.0, 2.0)];
    let statistics = Statistics::new(&scene(), &contacts, 0.0);
    let [upper, lower] = &statistics.walls[..] else { panic!("{statistics:?}") };
    assert_eq!((upper.wall.as_str(), upper.contacts, lower.contacts), ("upper", 3, 0));
    close(upper.impulse_n_s.mean, 19.0 / 3.0);
    close(upper.impulse_n_s.max, 12.0);
    close(upper.impulse_n_s.rms, (169.0_f64 / 3.0).sqrt());
    // No force of an impact is finite, and none lasts.
    assert_eq!((upper.peak_force_n.mean, upper.peak_force_n.max, upper.peak_force_n.rms), (None, None, None));
    assert_eq!(upper.contact_time_ratio, 0.0);
    // ½ · 2 kg · (1 + 2.25 + 16) over 10 s; 0.25 + 0.25 + 4 of it leave again.
    close(Some(upper.impact_power_w), 1.925);
    close(Some(upper.unreturned_power_w), 1.475);
    // A wall without contacts has no means, and no power.
    assert_eq!((lower.impulse_n_s.mean, lower.impact_power_w, lower.unreturned_power_w), (None, 0.0, 0.0));
}

#[test]
fn forces_and_times_of_lasting_contacts_are_those_of_the_window() {
    // One before the window, one that reaches into it, one inside, one still open at the end.
    let contacts = [
        lasting(0.5, Some(1.0), 1.0, 10.0, 1.0, Some(1.0)),
        lasting(1.5, Some(2.5), 2.0, 20.0, 1.0, Some(1.0)),
        lasting(4.0, Some(5.0), 3.0, 30.0, 2.0, Some(1.0)),
        lasting(9.0, None, 4.0, 40.0, 3.0, None),
    ];
    let statistics = Statistics::new(&scene(), &contacts, 2.0);
    assert_eq!((statistics.from_s, statistics.to_s), (2.0, 10.0));
    let wall = &statistics.walls[1];
    // Episodes count where they begin; time counts where it passes: 0.5 + 1 + 1 of 8 s.
    assert_eq!(wall.contacts, 2);
    close(Some(wall.contact_time_ratio), 2.5 / 8.0);
    close(wall.peak_force_n.mean, 35.0);
    close(wall.peak_force_n.max, 40.0);
    close(wall.peak_force_n.rms, 1250.0_f64.sqrt());
    close(wall.impulse_n_s.mean, 3.5);
    // 4 + 9 J arrive over 8 s. What is still in the wall is not lost: only the closed episode's 4 − 1.
    close(Some(wall.impact_power_w), 13.0 / 8.0);
    close(Some(wall.unreturned_power_w), 3.0 / 8.0);
}

#[test]
fn an_episode_at_the_start_of_the_window_belongs_to_it() {
    let statistics = Statistics::new(&scene(), &[impact(2.0, -1.0, 1.0, 1.0)], 2.0);
    assert_eq!(statistics.walls[0].contacts, 1);
    assert_eq!(statistics.walls[0].unreturned_power_w, 0.0);
}

#[test]
fn a_bouncing_ball_arrives_with_the_energy_it_fell_by() {
    // g = 10, h = 5 m, e = ½: impacts at 1 s (10 m/s) and 2 s (5 m/s), then 2.5 s; measured by a run over 2.2 s.
    let scene = Scene::oscillator(1.0, 0.0, 0.0)
        .with_wall(Wall::lower("floor", 0.0).with_restitution(0.5))
        .with_load(signorini::Load::constant(-10.0))
        .with_initial(&[5.0], &[0.0])
        .with_duration(2.2);
    let options = signorini::Options::with_step(1e-4);
    for scheme in [signorini::Scheme::MoreauJean { theta: 0.5 }, signorini::Scheme::PaoliSchatzman] {
        let run = signorini::run(&scene, &scheme, &options).expect("a run");
        let floor = &run.statistics.walls[0];
        assert_eq!(floor.contacts, 2, "{scheme}: {:?}", run.trajectory.contacts());
        // Two speeds within g h of the true ones.
        let near =
            |found: f64, expected: f64| assert!((found / expected - 1.0).abs() < 1e-3, "{scheme}: {found}, {expected}");
        near(floor.impact_power_w, (50.0 + 12.5) / 2.2);
        near(floor.unreturned_power_w, 0.75 * (50.0 + 12.5) / 2.2);
        near(floor.impulse_n_s.max.expect("two"), 15.0);
        near(floor.impulse_n_s.mean.expect("two"), 11.25);
    }
}

#[test]
fn a_window_of_no_length_has_no_powers_and_no_numbers_that_are_none() {
    let contacts = [impact(10.0, -3.0, 1.0, 0.5), lasting(9.0, None, 4.0, 40.0, 3.0, None)];
    for from in [10.0, 11.0, f64::INFINITY, f64::NAN] {
        let statistics = Statistics::new(&scene(), &contacts, from);
        assert_eq!((statistics.from_s, statistics.to_s), (10.0, 10.0), "from {from}");
        for wall in &statistics.walls {
            assert_eq!((wall.contact_time_ratio, wall.impact_power_w, wall.unreturned_power_w), (0.0, 0.0, 0.0));
        }
    }
}

#[test]
fn a_lossless_wall_may_return_more_than_arrived_for_the_load_works_meanwhile() {
    // 2 N towards free flight push a body of 1 kg all the while it is in a spring: it leaves by their work over the way, which is 0 from
    // face to face, but a load that sets in at the deepest point gives all of its work.
    let table = signorini::Table::new(vec![0.05, 0.5], vec![-2.0, -2.0]).expect("a table");
    let scene = Scene::oscillator(1.0, 0.0, 0.0)
        .with_wall(Wall::upper("upper", 0.0).with_elasticity(986.960_440_108_935_8, 0.0))
        .with_load(signorini::Load::table(table))
        .with_initial(&[0.0], &[1.0])
        .with_duration(0.4);
    let run = signorini::run(&scene, &signorini::Scheme::Event, &signorini::Options::with_step(1e-3)).expect("a run");
    let wall = &run.statistics.walls[0];
    // ω = 10π, a quarter period of 0.05 s, 1/ω deep; 2 N over that way.
    let given = 2.0 / 986.960_440_108_935_8_f64.sqrt();
    assert_eq!(wall.contacts, 1);
    assert!((wall.unreturned_power_w * 0.4 + given).abs() < 1e-14, "{wall:?}, expected {}", -given / 0.4);
    assert_eq!(run.residuals.energy.wall_damping_j, 0.0);
}
