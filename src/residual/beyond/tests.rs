//! Sizes and worst places, against numbers worked out by hand.

use super::*;

#[test]
fn the_worst_pair_is_that_of_all_pairs_less_their_rounding() {
    let pairs: Vec<(f64, f64)> = (0..40i32).map(|i| (f64::from(i * 17 % 40) - 6.0, f64::from(34 - i))).collect();
    let (gap_noise, force_noise) = (0.5, 1.5);
    let mut doubts = Doubts::default();
    for (k, &(slack, pressure)) in pairs.iter().enumerate() {
        doubts.add((slack, gap_noise), (pressure, force_noise), k as f64, k);
    }
    // The largest of a number for each pair, and where it is: times and walls are numbered.
    let most = |of: &dyn Fn(f64, f64) -> f64| -> (f64, f64, Option<usize>) {
        let values: Vec<f64> = pairs.iter().map(|&(s, p)| of(s - gap_noise, p - force_noise)).collect();
        let at = (0..40).max_by(|&a, &b| values[a].total_cmp(&values[b])).expect("pairs");
        (values[at], at as f64, Some(at))
    };
    let told = |worst: Worst| (worst.value, worst.time, worst.wall);
    assert_eq!(told(doubts.outside), most(&|slack, _| -slack - 2.0 * gap_noise));
    assert_eq!(told(doubts.pull), most(&|_, pressure| -pressure - 2.0 * force_noise));
    for (gap, force) in [(1.0, 1.0), (0.3, 2.0), (5.0, 1.0)] {
        let both = most(&|slack, pressure| if slack > 0.0 { (slack / gap).min(pressure / force) } else { 0.0 });
        assert_eq!(told(doubts.both(gap, force)), both, "{gap}, {force}");
    }
}

#[test]
fn of_equal_residuals_the_first_is_told() {
    let mut worst = Worst::default();
    worst.see(0.0, 1.0, Some(1));
    assert_eq!((worst.time, worst.wall), (0.0, None));
    worst.see(2.0, 3.0, Some(3));
    worst.see(2.0, 4.0, Some(4));
    assert_eq!((worst.value, worst.time, worst.wall), (2.0, 3.0, Some(3)));
    let mut doubts = Doubts::default();
    doubts.add((1.0, 0.0), (2.0, 0.0), 3.0, 3);
    doubts.add((1.0, 0.0), (2.0, 0.0), 4.0, 4);
    let both = doubts.both(1.0, 1.0);
    assert_eq!((both.value, both.time, both.wall), (1.0, 3.0, Some(3)));
}

#[test]
fn a_pair_under_another_takes_no_room_from_later_ones() {
    let noise = 0.5;
    let mut doubts = Doubts::default();
    // No more than rounding.
    doubts.add((noise, noise), (9.0, noise), 0.0, 0);
    doubts.add((9.0, noise), (noise, noise), 0.0, 0);
    assert!(doubts.stairs.is_empty());
    // One value stays while the other rises, or falls, or both rise: a row of more than STAIRS.
    let rows: [&dyn Fn(f64) -> (f64, f64); 5] =
        [&|x| (1.0, x), &|x| (x, 1.0), &|x| (1.0, 200.0 - x), &|x| (200.0 - x, 1.0), &|x| (x, 2.0 * x)];
    for (number, row) in rows.iter().enumerate() {
        let mut doubts = Doubts::default();
        for (slack, pressure) in (1..=100).map(|k| row(f64::from(k))) {
            doubts.add((slack + noise, noise), (pressure + noise, noise), slack + pressure, 0);
        }
        let most = [101.0, 101.0, 200.0, 200.0, 300.0][number];
        let places: Vec<f64> = doubts.stairs.iter().map(|stair| stair.2.time).collect();
        assert_eq!(places, [most], "row {number}");
    }
}

#[test]
fn sizes_of_a_step_make_the_rounding_errors_of_its_balances() {
    // m = 4 kg, k = 9 N/m, c = 16 N s/m, and a wall that feels 16 kg.
    let weights =
        Weights { root_mass: vec![2.0], per_root_mass: vec![0.5], roots: vec![[2.0, 3.0, 4.0]], seen: vec![1.0] };
    let mut rounding = Rounding::new(&weights, &[16.0]);
    let unit = UNITS * f64::EPSILON;
    // A step of 0.5 s ends at −2 m with 3 m/s, under −8 N, at its end −7 N, an extra force of
    // 2 N, and a blow of 1 N s. The largest force is that at the end with the extra one, 9 N.
    let moves = Moves {
        from: &[0.0],
        to: &[-2.0],
        shown: &[-2.0],
        before: &[-1.0],
        after: &[3.0],
        v: &[3.0],
        load_start: &[0.0],
        load_end: &[-7.0],
        extra: &[2.0],
        blow: &[1.0],
    };
    rounding.step(&moves, &[-8.0], &weights, (0.5, 2.0), 1);
    // Way 2 + 0.5 · 3 m: 7 m√kg and 10.5 √J; 6 √J of speed, 12 √W in the damper, 4.5 N/√kg.
    let (spring, damper) = (1.5 * 10.5, 2.0 * 12.0);
    assert_eq!(rounding.path(), unit * 7.0);
    assert_eq!(rounding.force(0.25, 1.0), unit * (6.0 / 0.25 + spring + damper + 4.5));
    assert_eq!(rounding.force(0.25, 3.0), unit * (6.0 / 0.25 + 3.0 * (spring + damper + 4.5)));
    // A rigid wall of 12 N is no load, an elastic one of 20 N is one.
    rounding.push(0, 0.0, false);
    rounding.push(0, -12.0, true);
    assert_eq!(rounding.force(1.0, 1.0), unit * (6.0 + spring + damper + 4.5 + 3.0));
    rounding.push(0, 20.0, false);
    assert_eq!(rounding.force(1.0, 1.0), unit * (6.0 + spring + damper + 5.0 + 5.0));
    assert_eq!(rounding.wall_force(0, 1.0, 1.0), 4.0 * rounding.force(1.0, 1.0));
    rounding.load(-5.5);
    assert_eq!(rounding.force(1.0, 1.0), unit * (6.0 + spring + damper + 5.5 + 5.0));
    assert_eq!((rounding.of(3.0), rounding.met(3.0, 0.5)), (unit * 3.0, unit * 3.0 + 0.5 * MET));
    // Two steps of 2 s, in which the load gives 11 √J.
    rounding.book(1.0, 2.0, 2.0);
    let one = unit * (36.0 + 10.5 * 10.5 + 121.0 + 5.5 * 7.0);
    assert_eq!(rounding.energy, 2.0 * one);
    rounding.book(3.0, 1.0, 2.0);
    assert_eq!(rounding.energy, 2.0 * one + unit * (3.0 * (36.0 + 10.5 * 10.5 + 121.0) + 5.5 * 7.0));
    // A state notes the same sizes as a step with one velocity, and a blow those of its force.
    let mut state = Rounding::new(&weights, &[]);
    state.state(&[-2.0], &[-3.0], 0.5, &weights);
    assert_eq!((state.path(), state.force(0.25, 1.0)), (unit * 7.0, unit * (6.0 / 0.25 + spring + damper)));
    let mut struck = Rounding::new(&weights, &[]);
    struck.step(&Moves { blow: &[-10.0], ..moves }, &[-8.0], &weights, (0.5, 2.0), 1);
    assert_eq!(struck.force(1.0, 1.0), unit * (6.0 + spring + damper + 10.0));
    // Sums over four degrees of freedom have twice the rounding; one without springs has no rate.
    let mut four = weights.repeated(4);
    four.roots[0] = [1.0, 0.0, 0.0];
    let mut many = Rounding::new(&four, &[]);
    many.state(&[0.0, -2.0, 0.0, 0.0], &[0.0, 3.0, 0.0, 0.0], 0.5, &four);
    assert_eq!(many.force(1.0, 1.0), 2.0 * unit * (6.0 + spring + damper));
}
