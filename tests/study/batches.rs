//! Half widths, the edges of the window and of its batches, and what slides, against closed forms.

use crate::rubbing::{body, isotropic, with_flats};
use crate::statistics::lasting;
use signorini::{Forces, Load, Options, Row, Scene, Scheme, Statistics, Stepper, Table, Wall, heading, run};

/// Half width of the 95 % interval of the mean of ten numbers, by its definition.
fn half_width(x: [f64; 10]) -> f64 {
    let mean = x.iter().sum::<f64>() / 10.0;
    2.262_157_162_798_205 * (x.iter().map(|x| (x - mean) * (x - mean)).sum::<f64>() / 90.0).sqrt()
}

#[test]
fn half_widths_are_those_of_ten_batches_of_the_window() {
    // A window from 5 s to 25 s: batches of 2 s, with one or two contacts of their own each, which
    // last, arrive and leave differently; the last begins at the very end.
    let scene = Scene::oscillator(2.0, 0.0, 1.0)
        .with_wall(Wall::upper("upper", 1.0))
        .with_wall(Wall::lower("lower", -1.0).with_elasticity(10.0, 0.0))
        .with_duration(25.0);
    let (mut contacts, mut sums) = (vec![lasting(4.0, Some(6.5), 9.0, 90.0, 7.0, Some(0.0))], [[0.0; 10]; 6]);
    // The one before the window lasts 1.5 s into it, and its peak counts in the first batch.
    (sums[1][0], sums[5][0]) = (1.5, 90.0);
    for k in 0..10_usize {
        for twin in 0..1 + k % 3 % 2 {
            let x = 1.0 + 0.1 * (k * k) as f64 + 0.3 * twin as f64;
            let (start, end) = (5.0 + 2.0 * k as f64 + 0.9 * twin as f64, 0.2 + 0.03 * x);
            contacts.push(lasting(start, Some(start + end), -x, 3.0 * x, x, Some(0.5 * x)));
            // ½ · 2 kg · x² arrives, and three quarters of it stay.
            let parts = [1.0, end, x * x, 0.75 * x * x, x, 3.0 * x];
            sums.iter_mut().zip(parts).for_each(|(sum, part)| sum[k] += part);
        }
    }
    contacts.push(lasting(25.0, None, -2.0, 1.0, 3.0, None));
    let last = [1.0, 0.0, 9.0, 0.0, 2.0, 1.0];
    sums.iter_mut().zip(last).for_each(|(sum, part)| sum[9] += part);
    let [counts, times, powers, left, impulses, peaks] = sums;
    let found = Statistics::new(&scene, &contacts, 5.0).walls[1].half_width_95.expect("more than ten contacts");
    let near = |found: f64, expected: f64| assert!((found / expected - 1.0).abs() < 1e-12, "{found}, {expected}");
    near(found.contact_rate_per_s, half_width(counts) / 2.0);
    near(found.contact_time_ratio, half_width(times) / 2.0);
    near(found.impact_power_w, half_width(powers) / 2.0);
    near(found.arrived_less_departed_power_w, half_width(left) / 2.0);
    // Of ratios: that of x − R n over the mean of n.
    let ratio = |x: [f64; 10], n: [f64; 10]| {
        let (all, number) = (x.iter().sum::<f64>(), n.iter().sum::<f64>());
        half_width(std::array::from_fn(|k| x[k] - all / number * n[k])) / (number / 10.0)
    };
    near(found.episode_impulse_n_s, ratio(impulses, counts));
    let mut peaked = counts;
    peaked[0] += 1.0;
    near(found.episode_peak_force_n.expect("forces"), ratio(peaks, peaked));
}

#[test]
fn a_force_that_grows_has_the_half_widths_of_a_straight_line() {
    // (1 + 2t) N press a body onto a stop; from 1 s to 6 s, so that batch k has the mean
    // 3.5 + k N and, of the square, that of a straight line.
    let push = |values: [f64; 4]| {
        let table = Table::new(vec![0.0, 6.0, 7.0, 8.0], values.to_vec()).expect("a table");
        Scene::oscillator(1.0, 0.0, 0.0)
            .with_wall(Wall::upper("stop", 0.0).with_restitution(0.5))
            .with_load(Load::table(table))
            .with_duration(6.0)
    };
    let options = || {
        let mut options = Options::with_step(1e-3);
        options.time.statistics_from = 1.0;
        options
    };
    let jean = Scheme::MoreauJean { theta: 0.5 };
    for scheme in [jean, Scheme::Event] {
        let made = run(&push([1.0, 13.0, 13.0, 13.0]), &scheme, &options()).expect("a run");
        let force = made.statistics.walls[0].force.expect("a window");
        let (means, mut squares) = (std::array::from_fn(|k| 3.5 + k as f64), [0.0; 10]);
        // Over 0.5 s the force changes by 1 N: the mean square is that of the mean and 1/12.
        squares.iter_mut().zip(means).for_each(|(square, mean): (&mut f64, f64)| *square = mean * mean + 1.0 / 12.0);
        let rms = (squares.iter().sum::<f64>() / 10.0).sqrt();
        let near = |found: f64, expected: f64| {
            // The squares are of means over a millisecond, in which the force changes by 2e-3 N:
            // (2e-3)²/12 of a square of 10 N² and more.
            assert!((found / expected - 1.0).abs() < 1e-6, "{scheme}: {found}, not {expected}: {force:?}");
        };
        near(force.mean_n, 8.0);
        near(force.impulse_n_s, -40.0);
        near(force.rms_n, rms);
        near(force.mean_half_width_95_n.expect("all batches"), half_width(means));
        near(force.impulse_half_width_95_n_s.expect("all batches"), 5.0 * half_width(means));
        near(force.rms_half_width_95_n.expect("all batches"), half_width(squares) / (2.0 * rms));
        // Pulled off after 5 s, two batches have no force, and one contact makes no interval.
        let table = Table::new(vec![0.0, 5.0, 5.001, 8.0], vec![1.0, 1.0, -1.0, -1.0]).expect("a table");
        let mut scene = push([0.0; 4]);
        scene.loads = vec![Load::table(table)];
        let pulled = run(&scene, &scheme, &options()).expect("a run");
        let force = pulled.statistics.walls[0].force.expect("a window");
        assert_eq!((force.mean_half_width_95_n, force.rms_half_width_95_n), (None, None), "{scheme}");
        assert!((force.mean_n - 4.0 / 5.0).abs() < 1e-3, "{scheme}: {force:?}");
    }
}

#[test]
fn steps_of_another_scene_and_impacts_after_the_end_are_no_part_of_the_force() {
    let one = Scene::oscillator(1.0, 0.0, 0.0)
        .with_wall(Wall::upper("stop", 0.1))
        .with_initial(&[0.0], &[1.0])
        .with_duration(0.35);
    let two = one.clone().with_wall(Wall::lower("floor", -0.1));
    for scheme in [Scheme::Event, Scheme::MoreauJean { theta: 0.5 }] {
        for (stepped, impulse) in [(&one, -2.0), (&two, 0.0)] {
            let mut forces = Forces::new(&one, 0.0, 1e-3);
            let mut stepper = Stepper::new(stepped, &scheme, 0.01).expect("a stepper");
            // 1 m/s: impacts at 0.1, 0.3 (the floor), and 0.5 s (after the end).
            let steps = if scheme == Scheme::Event { 35 } else { 60 };
            for _ in 0..steps {
                forces.observe(&stepper.step().expect("a step"));
            }
            let statistics = Statistics::new(&one, &[], 0.0).with_forces(&forces);
            let found = statistics.walls[0].force.expect("a window").impulse_n_s;
            assert!((found - impulse).abs() < 1e-12, "{scheme}: {found}, not {impulse}");
        }
    }
}

/// The load along the normal of a flat in this direction, or along its tangent.
fn along(load: Load, degrees: f64, tangent: bool) -> Load {
    let [c, s] = heading(degrees + if tangent { 90.0 } else { 0.0 });
    Load { at: Row::new(vec![(0, c), (1, s)]), ..load }
}

/// A free body that slides at 0.3 m/s along a flat at its face, 90° from its normal.
fn on_a_flat(mass: f64, direction: f64, friction: f64) -> Scene {
    let [c, s] = heading(direction);
    let scene = isotropic(mass, 0.0, 0.0).with_initial(&[0.0, 0.0], &[-0.3 * s, 0.3 * c]);
    with_flats(scene, "bar", body(), &[(direction, 0.0)], 0.0, friction)
}

#[test]
fn sliding_under_a_force_that_grows_wears_with_the_half_width_of_a_straight_line() {
    // 2 kg slide along a flat at 0.3 m/s, pressed by (1 + 2t) N, while a load carries the friction
    // of 0.25: from 1 s to 6 s, batch k has a mean force of 3.5 + k N.
    for (direction, sector) in [(0.0, 0), (20.0, 0), (140.0, 4), (200.0, 6)] {
        for (scheme, friction) in
            [(Scheme::MoreauJean { theta: 0.5 }, 0.25), (Scheme::MoreauJean { theta: 0.5 }, 0.0), (Scheme::Event, 0.0)]
        {
            let line =
                |share: f64| Load::table(Table::new(vec![0.0, 6.0], vec![share, 13.0 * share]).expect("a table"));
            let scene = on_a_flat(2.0, direction, friction)
                .with_load(along(line(1.0), direction, false))
                .with_load(along(line(friction), direction, true))
                .with_duration(6.0);
            let mut options = Options::with_step(1e-3);
            options.time.statistics_from = 1.0;
            let made = run(&scene, &scheme, &options).expect("a run");
            let near = |found: f64, expected: f64, what: &str| {
                // A step of the load, 1e-3 of what it changes by, and the first steps.
                assert!(
                    (found - expected).abs() < 2e-3 * expected.abs().max(1e-3),
                    "{scheme}, {what}: {found}, not {expected}"
                );
            };
            let [wear] = &made.statistics.wear[..] else { panic!("{:?}", made.statistics.wear) };
            near(wear.work_rate_w, 0.3 * 8.0, "work rate");
            let means: [f64; 10] = std::array::from_fn(|k| 3.5 + k as f64);
            near(wear.work_rate_half_width_95_w.expect("all batches"), 0.3 * half_width(means), "its half width");
            near(wear.sliding_m, 1.5, "sliding");
            near(wear.contact_time_ratio, 1.0, "time in contact");
            near(wear.friction_power_w, friction * 0.3 * 8.0, "friction");
            near(wear.sectors[sector].impulse_share, 1.0, "the sector");
            let force = made.statistics.supports[0].force.expect("a window");
            near(force.mean_n, 8.0, "normal force");
            // The flat pushes along −n, and friction along −t: both in proportion to the force.
            let [c, s] = heading(direction);
            let unit = [-c + friction * s, -s - friction * c];
            let half = force.mean_vector_half_width_95_n.expect("all batches");
            for axis in [0, 1] {
                near(force.mean_vector_n[axis], unit[axis] * 8.0, "the vector");
                near(half[axis], unit[axis].abs() * half_width(means), "its half width");
            }
        }
    }
}

#[test]
fn two_steps_of_contact_are_an_impact_that_slides_nowhere_and_three_last() {
    // Pressed onto a flat by 2 N for some steps of 0.01 s while sliding at 0.3 m/s, then pulled
    // off.
    let (h, jean) = (1e-2, Scheme::MoreauJean { theta: 0.5 });
    for pushed in 1..6_u32 {
        let until = f64::from(pushed) * h;
        let table = Table::new(vec![0.0, until, until + 1e-6, 1.0], vec![2.0, 2.0, -2.0, -2.0]);
        let load = Load::table(table.expect("a table"));
        let scene = on_a_flat(1.0, 0.0, 0.0).with_load(along(load, 0.0, false)).with_duration(0.2);
        let made = run(&scene, &jean, &Options::with_step(h)).expect("a run");
        let wear = &made.statistics.wear[0];
        let lasts = pushed > 2;
        // All steps slide once the contact lasts; the work of the first two is that of an impact.
        let (sliding, share) = if lasts { (0.3 * until, 2.0 / f64::from(pushed)) } else { (0.0, 1.0) };
        assert!((wear.sliding_m - sliding).abs() < 1e-15, "{pushed}: {wear:?}");
        assert!((wear.impact_share.expect("a rigid flat") - share).abs() < 1e-12, "{pushed}: {wear:?}");
        let time = if lasts { until / 0.2 } else { 0.0 };
        assert!((wear.contact_time_ratio - time).abs() < 1e-12, "{pushed}: {wear:?}");
        assert!((wear.work_rate_w - 0.3 * 2.0 * until / 0.2).abs() < 1e-12, "{pushed}: {wear:?}");
    }
}
