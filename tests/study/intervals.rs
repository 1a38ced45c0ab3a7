//! Forces over time against closed forms, and the intervals of statistics against what is known of
//! random processes.

use signorini::study::verdict::Verdict;
use signorini::{Contact, Load, Method, Options, Scene, Scheme, Statistics, Wall, run};
use std::f64::consts::TAU;

/// Student's t, 95 % two-sided, nine degrees of freedom (any table).
const T: f64 = 2.262_157;

fn contact(start: f64, impulse: f64, peak: Option<f64>) -> Contact {
    let departure_speed = Some(0.5 * impulse);
    Contact { wall: 0, start, end: Some(start), impulse, peak_force: peak, approach_speed: impulse, departure_speed }
}

fn still(duration: f64) -> Scene {
    Scene::oscillator(1.0, 0.0, 1.0).with_wall(Wall::upper("upper", 1.0)).with_duration(duration)
}

/// A ball of 1 kg on a floor without loss, started at its highest point 5 m up under g = 10: down
/// in 1 s, 10 m/s, a blow of 20 N s every 2 s from t = 1 s on.
fn ball(duration: f64) -> Scene {
    Scene::oscillator(1.0, 0.0, 0.0)
        .with_wall(Wall::lower("floor", 0.0))
        .with_load(Load::constant(-10.0))
        .with_initial(&[5.0], &[0.0])
        .with_duration(duration)
}

#[test]
fn the_mean_force_of_a_periodic_orbit_is_its_impulse_over_its_period() {
    // Ten whole periods from wherever they begin: 20 N s / 2 s = m g.
    for from in [0.0, 2.3] {
        for scheme in [Scheme::Event, Scheme::MoreauJean { theta: 0.5 }] {
            let mut options = Options::with_step(1e-4).with_sample(0.1);
            options.time.statistics_from = from;
            let run = run(&ball(20.0 + from), &scheme, &options).expect("a run");
            let force = run.statistics.walls[0].force.expect("a window");
            // The exact scheme to rounding; on a grid a step moves the instant of a blow but not
            // its number, and its speed by g h at most, 1e-4 of 10 m/s.
            let tolerance = if scheme == Scheme::Event { 1e-9 } else { 1e-4 };
            assert!((force.mean_n / 10.0 - 1.0).abs() < tolerance, "{scheme}, from {from}: {force:?}");
            assert!((force.impulse_n_s / 200.0 - 1.0).abs() < tolerance, "{scheme}, from {from}: {force:?}");
        }
    }
}

#[test]
fn the_rms_of_a_rigid_wall_is_that_of_the_force_averaged_over_the_stretch_asked_for() {
    // Blows of 20 N s at t = 1, 3, 5, …, 39 s. By hand: Σ (impulse in each stretch)² / stretch / 40
    // s.
    for averaging in [1e-3, 0.5, 0.8, 4.0, 1e9] {
        let mut options = Options::with_step(1e-3).with_sample(1.0);
        options.time.force_averaging = averaging;
        let force = run(&ball(40.0), &Scheme::Event, &options).expect("a run").statistics.walls[0].force.expect("it");
        let stretch = force.rms_averaged_over_s.expect("a rigid wall");
        // A tenth of the window at most.
        assert!((stretch - averaging.min(4.0)).abs() < 1e-9, "{averaging}: {stretch}");
        let count = (40.0 / stretch).round() as usize;
        let mut bins = vec![0.0_f64; count];
        for k in 0..20 {
            // None falls on an edge but at 0.5 and 1e-3 s, where it belongs to either of two that
            // hold no other.
            bins[((1.0 + 2.0 * f64::from(k)) / stretch) as usize] += 20.0;
        }
        let expected = (bins.iter().map(|p| p * p / stretch).sum::<f64>() / 40.0).sqrt();
        assert!((force.rms_n / expected - 1.0).abs() < 1e-9, "{averaging}: {force:?}, expected {expected}");
    }
    // A body held at a stop by 3 + 2 sin(ωt) N: the mean of the force over a stretch [a, b] in
    // closed form.
    let (omega, length) = (TAU * 2.0, 10.0);
    let scene = Scene::oscillator(1.0, 0.0, 0.0)
        .with_wall(Wall::upper("stop", 0.0).with_restitution(0.0))
        .with_load(Load::constant(3.0))
        .with_load(Load::harmonic(2.0, 2.0, 0.0))
        .with_duration(length);
    let stretch = 0.1;
    let count = (length / stretch).round();
    let mean =
        |k: f64| 3.0 + 2.0 * ((omega * k * stretch).cos() - (omega * (k + 1.0) * stretch).cos()) / (omega * stretch);
    let squares: f64 = (0..count as u32).map(|k| mean(f64::from(k)).powi(2)).sum();
    let expected = (squares / count).sqrt();
    // The effect of averaging is large enough to be seen: without it the RMS is √(9 + 2).
    assert!((expected / 11.0_f64.sqrt() - 1.0).abs() > 1e-2);
    // The trapezoid's error of the load over a step is (ωh)²/12 = 1e-7 at h = 1e-4.
    for (scheme, tolerance) in [(Scheme::Event, 1e-9), (Scheme::MoreauJean { theta: 0.5 }, 1e-6)] {
        let mut options = Options::with_step(1e-4).with_sample(1.0);
        options.time.force_averaging = stretch;
        let force = run(&scene, &scheme, &options).expect("a run").statistics.walls[0].force.expect("it");
        assert!((force.rms_n / expected - 1.0).abs() < tolerance, "{scheme}: {force:?}, expected {expected}");
    }
}

#[test]
fn a_stretch_of_averaging_is_above_0_and_costs_no_more_than_a_million_of_them() {
    for wrong in [0.0, -1e-3, f64::NAN, f64::INFINITY] {
        let mut options = Options::with_step(1e-3);
        options.time.force_averaging = wrong;
        let error = run(&ball(1.0), &Scheme::Event, &options).expect_err("a wrong stretch");
        assert!(error.is_request() && error.to_string().contains("force_averaging"), "{error}");
    }
    let mut options = Options::with_step(1e-3);
    options.time.force_averaging = 1e-300;
    let force = run(&ball(10.0), &Scheme::Event, &options).expect("a run").statistics.walls[0].force.expect("it");
    assert_eq!(force.rms_averaged_over_s, Some(1e-5));
}

#[test]
fn means_over_episodes_have_the_interval_of_the_ratio_estimator() {
    // One contact of 1 N s in each second, and ten of 3 N s more in one of them.
    let mut contacts: Vec<Contact> = (0..10).map(|k| contact(f64::from(k) + 0.5, 1.0, Some(1.0))).collect();
    let even = Statistics::new(&still(10.0), &contacts, 0.0).walls[0].half_width_95.expect("ten contacts");
    assert_eq!((even.episode_impulse_n_s, even.episode_peak_force_n), (0.0, Some(0.0)));
    contacts.extend((0..10).map(|k| contact(3.1 + 0.01 * f64::from(k), 3.0, None)));
    let all = Statistics::new(&still(10.0), &contacts, 0.0);
    let uneven = all.walls[0].half_width_95.expect("twenty contacts");
    // R = 40/20 = 2; z = 1 − 2 nine times and 31 − 22 once: s² = (9 + 81)/9 = 10, and t √(10/10)
    // over 2 episodes a batch.
    assert_eq!(all.walls[0].episode_impulse_n_s.mean, Some(2.0));
    assert!((uneven.episode_impulse_n_s - 0.5 * T).abs() < 1e-6, "{uneven:?}");
    // Ten peaks, all alike.
    assert_eq!(uneven.episode_peak_force_n, Some(0.0));
    // What came and went: ½(p² − p²/4) each, 3/8 nine times and 3/8 + 10 · 27/8 once; a mean of 10
    // of 3/8 and 270/8 over ten.
    let (low, high) = (3.0 / 8.0, 3.0 / 8.0 + 270.0 / 8.0);
    let mean = (9.0 * low + high) / 10.0;
    let s = ((9.0 * (low - mean) * (low - mean) + (high - mean) * (high - mean)) / 9.0_f64).sqrt();
    assert!((uneven.arrived_less_departed_power_w - T * s / 10.0_f64.sqrt()).abs() < 1e-5, "{uneven:?}");
}

#[test]
fn too_few_episodes_have_no_interval() {
    let mut contacts: Vec<Contact> = (0..12).map(|k| contact(0.8 * f64::from(k), 1.0, Some(2.0))).collect();
    contacts.iter_mut().take(3).for_each(|c| c.peak_force = None);
    let wall = |contacts: &[Contact]| Statistics::new(&still(10.0), contacts, 0.0).walls[0].clone();
    assert_eq!(wall(&contacts).half_width_95.expect("twelve").episode_peak_force_n, None);
    assert_eq!(wall(&contacts[..9]).half_width_95, None);
    // From three blows the scatter of their mean is not known; a lasting contact, a single episode,
    // has an interval.
    let few = run(&ball(6.0), &Scheme::Event, &Options::with_step(1e-3)).expect("a run");
    let force = few.statistics.walls[0].force.expect("a window");
    assert!(force.mean_n > 9.0, "{force:?}");
    assert_eq!(
        [force.impulse_half_width_95_n_s, force.mean_half_width_95_n, force.rms_half_width_95_n],
        [None, None, None]
    );
    let rests = ball(6.0).with_initial(&[0.0], &[0.0]);
    let rests = run(&rests, &Scheme::Event, &Options::with_step(1e-3)).expect("a run");
    let force = rests.statistics.walls[0].force.expect("a window");
    assert!(force.mean_half_width_95_n.is_some_and(|x| x < 1e-9), "{force:?}");
}

/// SplitMix64 (Steele, Lea, Flood 2014), as numbers in (0, 1).
struct Random(u64);

impl Random {
    fn next(&mut self) -> f64 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let mut z = self.0;
        z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        ((z ^ (z >> 31)) >> 11) as f64 * 2f64.powi(-53) + 2f64.powi(-54)
    }

    fn exponential(&mut self, mean: f64) -> f64 {
        -mean * self.next().ln()
    }
}

#[test]
fn nineteen_of_twenty_intervals_hold_the_truth() {
    // Contacts as a Poisson process of 2 per second; every second or so a spell begins that has
    // larger or smaller impulses than the last, so that neighbours are alike. Impulses are uniform
    // on (0.5, 1.5) times the spell's 1 or 3 N s: 2 N s in the mean over time, and over episodes.
    const RATE: f64 = 2.0;
    const LENGTH: f64 = 300.0;
    const SEEDS: u64 = 2000;
    let scene = still(LENGTH);
    let mut held = [0u64; 3];
    for seed in 0..SEEDS {
        let mut random = Random(seed.wrapping_mul(0x1234_5678_9abc_def1));
        let (mut t, mut turn, mut size) = (random.exponential(1.0 / RATE), 0.0, 1.0);
        let mut contacts = Vec::new();
        while t < LENGTH {
            while turn < t {
                size = if random.next() < 0.5 { 1.0 } else { 3.0 };
                turn += random.exponential(1.0);
            }
            contacts.push(contact(t, size * (0.5 + random.next()), Some(size)));
            t += random.exponential(1.0 / RATE);
        }
        let statistics = Statistics::new(&scene, &contacts, 0.0);
        let wall = &statistics.walls[0];
        let width = wall.half_width_95.expect("hundreds of contacts");
        let mean = |of: Option<f64>| of.expect("hundreds of contacts");
        let off = [
            (wall.contact_rate_per_s - RATE, width.contact_rate_per_s),
            (mean(wall.episode_impulse_n_s.mean) - 2.0, width.episode_impulse_n_s),
            (mean(wall.episode_peak_force_n.mean) - 2.0, mean(width.episode_peak_force_n)),
        ];
        for (held, (off, width)) in held.iter_mut().zip(off) {
            *held += u64::from(off.abs() <= width);
        }
    }
    // 95 % of 2000 trials are known to ±1.5 % (three standard deviations, 3 √(0.95 · 0.05/2000));
    // sums of sixty contacts a batch are normal and independent to half a percent of coverage.
    for held in held {
        let share = held as f64 / SEEDS as f64;
        assert!((share - 0.95).abs() < 0.02, "{share}");
    }
}

#[test]
fn the_verdict_speaks_of_the_window_that_the_table_has() {
    let scene = ball(6.0);
    for scheme in [Scheme::Event, Scheme::MoreauJean { theta: 0.5 }] {
        let method = Method::new(scheme);
        let mut options = Options::with_step(1e-3);
        options.time.statistics_from = 4.0;
        let run = run(&scene, &scheme, &options).expect("a run");
        let verdict = Verdict::of(&scene, &method, &run, &options.time, &mut |_| {}).expect("a verdict");
        // Blows of 20 N s at 1, 3 and 5 s, of which the window has the last.
        let [before, after] = verdict.walls[0].impulse_n_s;
        assert_eq!(before, run.statistics.walls[0].force.expect("a window").impulse_n_s);
        let whole = run.trajectory.impulse("floor").expect("a floor");
        assert!(
            (whole - before - 40.0).abs() < 0.1 && (before - 20.0).abs() < 0.1 && (after - 20.0).abs() < 0.1,
            "{scheme}: {verdict:?}, {whole}"
        );
    }
}
