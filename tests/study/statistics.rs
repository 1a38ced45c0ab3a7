//! Contact statistics against sums done by hand.

use crate::rubbing::{body, isotropic, with_flats};
use signorini::{Contact, Load, Options, Scene, Scheme, Statistics, TimeOptions, Wall};

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

/// A contact of the second wall over time, from `start` on.
pub fn lasting(
    start: f64,
    end: Option<f64>,
    impulse: f64,
    peak: f64,
    approach: f64,
    departure: Option<f64>,
) -> Contact {
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
    close(upper.episode_impulse_n_s.mean, 19.0 / 3.0);
    close(upper.episode_impulse_n_s.max, 12.0);
    // No force of an impact is finite, and none lasts.
    assert_eq!((upper.episode_peak_force_n.mean, upper.episode_peak_force_n.max), (None, None));
    assert_eq!(upper.contact_time_ratio, 0.0);
    // ½ · 2 kg · (1 + 2.25 + 16) over 10 s; 0.25 + 0.25 + 4 of it leave again.
    close(Some(upper.impact_power_w), 1.925);
    close(Some(upper.arrived_less_departed_power_w), 1.475);
    // A wall without contacts has no means, and no power.
    assert_eq!(
        (lower.episode_impulse_n_s.mean, lower.impact_power_w, lower.arrived_less_departed_power_w),
        (None, 0.0, 0.0)
    );
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
    // The second episode began before the window and reaches into it: its force is there.
    close(wall.episode_peak_force_n.mean, 30.0);
    close(wall.episode_peak_force_n.max, 40.0);
    close(wall.episode_impulse_n_s.mean, 3.5);
    // 4 + 9 J arrive over 8 s. What is still in the wall is not lost: only the closed episode's 4 −
    // 1.
    close(Some(wall.impact_power_w), 13.0 / 8.0);
    close(Some(wall.arrived_less_departed_power_w), 3.0 / 8.0);
}

#[test]
fn a_support_has_the_forces_of_all_its_flats_within_the_window() {
    let scene = with_flats(isotropic(1.0, 0.0, 1.0), "hole", body(), &[(0.0, 1e-3), (90.0, 1e-3)], 0.5, 0.0);
    // Two before the window, of which one ends with its start; one that begins there; one open.
    let contacts = [
        lasting(0.5, Some(1.0), 1.0, 50.0, 1.0, Some(1.0)),
        Contact { wall: 0, ..lasting(1.5, Some(2.0), 2.0, 20.0, 1.0, Some(1.0)) },
        lasting(2.0, Some(5.0), 3.0, 30.0, 2.0, Some(1.0)),
        Contact { wall: 0, ..lasting(9.0, None, 4.0, 40.0, 3.0, None) },
    ];
    let statistics = Statistics::new(&scene.with_duration(10.0), &contacts, 2.0);
    let [hole] = &statistics.supports[..] else { panic!("{statistics:?}") };
    assert_eq!((hole.support.as_str(), hole.contacts), ("hole", 2));
    close(hole.episode_peak_force_n.mean, 30.0);
    close(hole.episode_peak_force_n.max, 40.0);
}

#[test]
fn an_episode_at_the_start_of_the_window_belongs_to_it() {
    let statistics = Statistics::new(&scene(), &[impact(2.0, -1.0, 1.0, 1.0)], 2.0);
    assert_eq!(statistics.walls[0].contacts, 1);
    assert_eq!(statistics.walls[0].arrived_less_departed_power_w, 0.0);
}

#[test]
fn a_bouncing_ball_arrives_with_the_energy_it_fell_by() {
    // g = 10, h = 5 m, e = ½: impacts at 1 s (10 m/s) and 2 s (5 m/s), then 2.5 s; measured by a
    // run over 2.2 s.
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
        near(floor.arrived_less_departed_power_w, 0.75 * (50.0 + 12.5) / 2.2);
        near(floor.episode_impulse_n_s.max.expect("two"), 15.0);
        near(floor.episode_impulse_n_s.mean.expect("two"), 11.25);
    }
}

#[test]
fn a_window_of_no_length_has_no_powers_and_no_numbers_that_are_none() {
    let contacts = [impact(10.0, -3.0, 1.0, 0.5), lasting(9.0, None, 4.0, 40.0, 3.0, None)];
    for from in [10.0, 11.0, f64::INFINITY, f64::NAN] {
        let statistics = Statistics::new(&scene(), &contacts, from);
        assert_eq!((statistics.from_s, statistics.to_s), (10.0, 10.0), "from {from}");
        for wall in &statistics.walls {
            assert_eq!(
                (wall.contact_time_ratio, wall.impact_power_w, wall.arrived_less_departed_power_w),
                (0.0, 0.0, 0.0)
            );
        }
    }
}

#[test]
fn a_lossless_wall_may_return_more_than_arrived_for_the_load_works_meanwhile() {
    // 2 N towards free flight push a body of 1 kg all the while it is in a spring: it leaves by
    // their work over the way, which is 0 from face to face, but a load that sets in at the deepest
    // point gives all of its work.
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
    assert!((wall.arrived_less_departed_power_w * 0.4 + given).abs() < 1e-14, "{wall:?}, expected {}", -given / 0.4);
    assert_eq!(run.residuals.energy.wall_damping_j, 0.0);
}

#[test]
fn the_force_over_time_is_that_of_the_window_and_of_every_scheme() {
    // 2 N presses a body onto a stop for 1 s; it has lain there from the start. Mean, RMS and
    // impulse are exact in any window, and nothing scatters; what came before the window is not in
    // it.
    let scene = Scene::oscillator(1.0, 0.0, 0.0)
        .with_wall(Wall::upper("stop", 0.0).with_restitution(0.5))
        .with_load(signorini::Load::constant(2.0))
        .with_duration(1.0);
    for scheme in
        [signorini::Scheme::MoreauJean { theta: 0.5 }, signorini::Scheme::PaoliSchatzman, signorini::Scheme::Event]
    {
        for from in [0.0, 0.25, 0.9371] {
            let mut options = signorini::Options::with_step(1e-4);
            options.time.statistics_from = from;
            let run = signorini::run(&scene, &scheme, &options).expect("a run");
            let force = run.statistics.walls[0].force.expect("a window with a length");
            let near =
                |found: f64, expected: f64| assert!((found - expected).abs() < 1e-9, "{scheme}, {from}: {force:?}");
            near(force.impulse_n_s, -2.0 * (1.0 - from));
            near(force.mean_n, 2.0);
            near(force.rms_n, 2.0);
            near(force.mean_half_width_95_n.expect("a push in every batch"), 0.0);
            let stretch = force.rms_averaged_over_s.expect("a rigid wall");
            assert!(
                stretch <= signorini::TimeOptions::FORCE_AVERAGING * (1.0 + 1e-12) && stretch > 0.5e-3,
                "{stretch}"
            );
            // The contact began before the window, and its force is there all the same.
            near(run.statistics.walls[0].episode_peak_force_n.max.expect("a lasting contact"), 2.0);
            assert_eq!(run.statistics.walls[0].contacts, usize::from(from == 0.0));
        }
    }
}

#[test]
fn the_rms_of_a_rigid_wall_does_not_depend_on_the_step_and_that_of_a_spring_is_the_force_itself() {
    // Ten impacts of 2 N s a second: once in ten stretches of a millisecond each is 2000 N, so RMS²
    // = 10/1000 · 2000² N².
    let scene = Scene::oscillator(1.0, 0.0, 0.0)
        .with_wall(Wall::upper("upper", 0.05))
        .with_wall(Wall::lower("lower", -0.05))
        .with_initial(&[0.0123], &[1.0])
        .with_duration(10.0);
    let mut found = Vec::new();
    for (scheme, step) in [
        (signorini::Scheme::Event, 1e-3),
        (signorini::Scheme::MoreauJean { theta: 0.5 }, 1e-4),
        (signorini::Scheme::MoreauJean { theta: 0.5 }, 1e-5),
    ] {
        let run =
            signorini::run(&scene, &scheme, &signorini::Options::with_step(step).with_sample(0.1)).expect("a run");
        let upper = &run.statistics.walls[0];
        let force = upper.force.expect("a window");
        // 50 impacts in 10 s, 2 N s each.
        assert_eq!(upper.contacts, 50);
        assert!((upper.contact_rate_per_s - 5.0).abs() < 1e-12 && (force.mean_n - 10.0).abs() < 1e-6, "{upper:?}");
        found.push(force.rms_n);
    }
    let expected = (5.0 * 2.0 * 2.0 / 1e-3_f64).sqrt();
    assert!((found[0] - expected).abs() < 1e-6, "{found:?}, expected {expected}");
    // A step that straddles two stretches shares its impulse between them: at most one in ten, and
    // in a hundred, of all.
    assert!((found[1] / expected - 1.0).abs() < 0.05 && (found[2] / expected - 1.0).abs() < 0.01, "{found:?}");
    // A spring: half a sine of force, amplitude k/ω, whose mean square over the half period is half
    // of its square.
    let k = 1e4;
    let spring = Scene::oscillator(1.0, 0.0, 0.0)
        .with_wall(Wall::upper("pad", 0.0).with_elasticity(k, 0.0))
        .with_initial(&[-0.01], &[1.0])
        .with_duration(0.1);
    let omega = k.sqrt();
    let expected = ((k / omega).powi(2) * 0.5 * std::f64::consts::PI / omega / 0.1).sqrt();
    for (scheme, tolerance) in [(signorini::Scheme::Event, 1e-3), (signorini::Scheme::MoreauJean { theta: 0.5 }, 1e-2)]
    {
        let run = signorini::run(&spring, &scheme, &signorini::Options::with_step(1e-5)).expect("a run");
        let force = run.statistics.walls[0].force.expect("a window");
        assert!((force.rms_n / expected - 1.0).abs() < tolerance, "{scheme}: {force:?}, expected {expected}");
        assert!((force.mean_n * 0.1 - 2.0).abs() < 1e-3 && force.rms_averaged_over_s.is_none(), "{scheme}: {force:?}");
    }
    // The whole contact, 3.14 rad of exact motion, in one piece: the quadrature of its squared
    // force has seven parts.
    let times = signorini::TimeOptions { force_averaging: 0.1, ..signorini::TimeOptions::with_step(0.1) };
    let run = signorini::run(&spring, &signorini::Scheme::Event, &signorini::Options::new(times)).expect("a run");
    let force = run.statistics.walls[0].force.expect("a window");
    assert!((force.rms_n / expected - 1.0).abs() < 1e-4, "{force:?}, expected {expected}");
}

#[test]
fn batch_means_tell_how_far_a_rate_scatters() {
    // Contacts at the middle of the ten seconds' batches, one in each; then with ten more in one of
    // them.
    let each: Vec<Contact> = (0..10).map(|k| impact(f64::from(k) + 0.5, -1.0, 1.0, 1.0)).collect();
    let even = Statistics::new(&scene(), &each, 0.0).walls[0].half_width_95.expect("ten contacts");
    assert_eq!((even.contact_rate_per_s, even.impact_power_w), (0.0, 0.0));
    let mut more = each.clone();
    more.extend((0..10).map(|k| impact(3.1 + 0.01 * f64::from(k), -1.0, 1.0, 1.0)));
    let uneven = Statistics::new(&scene(), &more, 0.0).walls[0].half_width_95.expect("twenty contacts");
    // Nine batches of 1 and one of 11 a second: mean 2, s² = (9·1 + 81)/9 = 10, t s/√10 = t.
    assert!((uneven.contact_rate_per_s - 2.262_157_162_798_205).abs() < 1e-12, "{uneven:?}");
    assert!(Statistics::new(&scene(), &each[..9], 0.0).walls[0].half_width_95.is_none());
    // Impulses of 2 N s in every second batch, of 4 in the others, two in each: mean R = 3, zₖ =
    // ±2, s² = 10·4/9, and two episodes in a batch: t s/√10/2 = t/3.
    let twice: Vec<Contact> =
        (0..20).map(|k| impact(0.5 * f64::from(k) + 0.25, -2.0 - 2.0 * f64::from(k / 2 % 2), 1.0, 1.0)).collect();
    let ratio = Statistics::new(&scene(), &twice, 0.0).walls[0].half_width_95.expect("twenty contacts");
    assert!((ratio.episode_impulse_n_s - 2.262_157_162_798_205 / 3.0).abs() < 1e-12, "{ratio:?}");
}

#[test]
fn the_last_blows_of_an_accumulation_are_no_peak_force() {
    // A ball that comes to rest under its weight: 9.81 N, whatever the step makes of its last
    // bounces.
    let scene = Scene::oscillator(1.0, 0.0, 0.0)
        .with_wall(Wall::lower("floor", 0.0).with_restitution(0.5))
        .with_load(signorini::Load::constant(-9.81))
        .with_initial(&[0.1], &[0.0])
        .with_duration(1.5);
    for step in [1e-2, 1e-3, 3.7e-4] {
        let scheme = signorini::Scheme::MoreauJean { theta: 0.5 };
        let run = signorini::run(&scene, &scheme, &signorini::Options::with_step(step)).expect("a run");
        let peak = run.statistics.walls[0].episode_peak_force_n.max.expect("it rests");
        assert!((peak / 9.81 - 1.0).abs() < 0.02, "h = {step}: {peak} N");
    }
}

#[test]
fn a_graze_without_force_is_no_broken_complementarity() {
    // Swings up to the wall and touches it at rest: the reaction is rounding, and a ratio of
    // rounding errors means nothing.
    let scene = Scene::oscillator(1.0, 0.0, 100.0)
        .with_wall(Wall::upper("stop", 5e-3))
        .with_initial(&[-5e-3], &[0.0])
        .with_duration(2.0);
    for e in [0.0, 0.5, 1.0] {
        let mut scene = scene.clone();
        scene.walls[0] = Wall::upper("stop", 5e-3).with_restitution(e);
        let run =
            signorini::run(&scene, &signorini::Scheme::Event, &signorini::Options::with_step(1e-3)).expect("a run");
        assert!(run.residuals.complementarity < 1e-8, "e = {e}: {:?}", run.residuals);
        assert_eq!(run.findings, []);
    }
}

#[test]
fn a_contact_that_ends_after_the_window_counts_up_to_its_end() {
    // Open at the end of the run, ended beyond it, and in the last instant: each half a second of
    // the window of five.
    for end in [None, Some(10.0), Some(10.5), Some(1e9)] {
        let statistics = Statistics::new(&scene(), &[lasting(9.5, end, 2.0, 20.0, 1.0, None)], 5.0);
        close(Some(statistics.walls[1].contact_time_ratio), 0.1);
    }
    // One that lasts from before the window to beyond it counts in full, and one beyond it does not
    // count.
    let around = Statistics::new(&scene(), &[lasting(1.0, Some(12.0), 2.0, 20.0, 1.0, None)], 5.0);
    assert_eq!(around.walls[1].contact_time_ratio, 1.0);
    let after = Statistics::new(&scene(), &[lasting(11.0, Some(12.0), 2.0, 20.0, 1.0, None)], 5.0);
    assert_eq!(after.walls[1].contact_time_ratio, 0.0);
    // Nor may it make a batch longer than it is: ten contacts, one in each second, the last ending
    // a second late.
    let mut contacts: Vec<Contact> =
        (0..10).map(|k| lasting(f64::from(k), Some(f64::from(k) + 0.5), 1.0, 1.0, 1.0, Some(1.0))).collect();
    contacts[9].start = 9.5;
    contacts[9].end = Some(11.0);
    let even = Statistics::new(&scene(), &contacts, 0.0).walls[1].half_width_95.expect("ten contacts");
    assert!(even.contact_time_ratio < 1e-15, "{even:?}");
}

/// A mass pushed onto an elastic stop by a step of force swings, and rests after 1 s to e⁻⁶⁰: the
/// window after that has the force of the springs at rest, none of the swing, in a contact that has
/// lasted since.
#[test]
fn the_largest_force_of_a_contact_that_began_before_the_window_is_one_of_the_window() {
    let stop = Wall::upper("stop", 0.0).with_elasticity(1e5, 100.0);
    let scene = Scene::oscillator(1.0, 20.0, 100.0).with_wall(stop).with_load(Load::constant(10.0)).with_duration(2.0);
    let rest = 10.0 * 1e5 / (1e5 + 100.0);
    let options = Options::new(TimeOptions { statistics_from: 1.0, ..TimeOptions::with_step(1e-4) });
    for scheme in [Scheme::Event, Scheme::MoreauJean { theta: 0.5 }, Scheme::Located] {
        let run = signorini::run(&scene, &scheme, &options).unwrap();
        let swing = run.trajectory.contacts()[0].peak_force.unwrap();
        assert!(swing > 1.5 * rest, "{scheme}: {swing}");
        let wall = &run.statistics.walls[0];
        for found in [wall.force_largest.unwrap().mean_n, wall.episode_peak_force_n.max.unwrap()] {
            // The rounding of the springs' displacement over a step.
            assert!((found / rest - 1.0).abs() < 1e-7, "{scheme}: {found} for {rest}");
        }
    }
}
