//! Fronts, against all their pairs and numbers worked out by hand.

use super::*;

/// The largest violation by definition, over all pairs.
fn worst(pairs: &[(f64, f64)], gap_scale: f64, force_scale: f64) -> f64 {
    pairs.iter().map(|&(s, p)| (s / gap_scale).min(p / force_scale).abs()).fold(0.0, f64::max)
}

fn of(pairs: &[(f64, f64)]) -> ComplementarityFront {
    let mut all = ComplementarityFront::default();
    pairs.iter().for_each(|&(slack, pressure)| all.add((slack, 0.0), (pressure, 0.0), 0.0, 0));
    all
}

/// `count` pairs none of which exceeds another in both, in an order that is neither rising nor
/// falling.
fn falling(count: usize) -> Vec<(f64, f64)> {
    (0..count).map(|i| (i * 37 % count) as f64).map(|i| (1.0 + i, count as f64 - i)).collect()
}

const SCALES: [(f64, f64); 5] = [(1.0, 1.0), (1e-3, 1.0), (1.0, 1e-3), (7.0, 3.0), (1e-6, 1e6)];

#[test]
fn few_pairs_are_kept_as_they_are_whatever_the_scales() {
    let mut pairs = falling(PAIRS);
    // Pairs that another exceeds in both, equal ones, and what is behind a wall or pulls, or
    // touches without force.
    pairs.extend([(0.5, 0.5), pairs[3], (-2.0, 0.0), (0.0, -3.0), (0.0, 9e9), (9e9, 0.0), (-1.0, 5.0)]);
    for (gap, force) in SCALES {
        assert_eq!(of(&pairs).worst(gap, force), worst(&pairs, gap, force), "{gap}, {force}");
    }
    // One that exceeds them all takes their place.
    pairs.push((1e3, 1e3));
    assert_eq!(of(&pairs).pairs, [(1e3, 1e3)]);
}

#[test]
fn a_pair_under_another_takes_no_room_from_later_ones() {
    // One value stays while the other rises or falls, for more than PAIRS pairs.
    for k in 0..4 {
        let number = |i: u32| f64::from(if k < 2 { i } else { 101 - i });
        let pair = |i: u32| if k % 2 == 0 { (1.0, number(i)) } else { (number(i), 1.0) };
        let expected = if k % 2 == 0 { (1.0, 100.0) } else { (100.0, 1.0) };
        assert_eq!(of(&(1..=100).map(pair).collect::<Vec<_>>()).pairs, [expected], "{k}");
    }
}

#[test]
fn many_pairs_are_merged_upwards_never_down() {
    for count in [PAIRS + 1, 100, 1000] {
        let pairs = falling(count);
        let all = of(&pairs);
        assert!(all.pairs.len() <= PAIRS, "{}", all.pairs.len());
        // Each pair is under a stair: no violation is lost, at any scales.
        for &(slack, pressure) in &pairs {
            assert!(all.pairs.iter().any(|&(s, p)| s >= slack && p >= pressure), "{slack}, {pressure}");
        }
        for (gap, force) in SCALES {
            let (found, least) = (all.worst(gap, force), worst(&pairs, gap, force));
            // And no stair is higher than the largest of either.
            let most = (count as f64 / gap).min(count as f64 / force);
            assert!(least <= found && found <= most, "{count}, {gap}, {force}: {least} <= {found} <= {most}");
        }
    }
}

#[test]
fn a_scale_of_nothing_measures_nothing() {
    // No wall ever pushed: the scale of forces is 0, and so is every force.
    assert_eq!(of(&[(1.0, 0.0), (0.0, 0.0)]).worst(1.0, 0.0), 0.0);
    assert_eq!(of(&[(-1.0, 0.0)]).worst(2.0, 0.0), 0.5);
}

#[test]
fn the_worst_pair_is_that_of_all_pairs_less_their_rounding() {
    let pairs: Vec<(f64, f64)> = (0..40i32).map(|i| (f64::from(i * 17 % 40) - 6.0, f64::from(34 - i))).collect();
    let (gap_noise, force_noise) = (0.5, 1.5);
    let mut front = ComplementarityFront::default();
    for (k, &(slack, pressure)) in pairs.iter().enumerate() {
        front.add((slack, gap_noise), (pressure, force_noise), k as f64, k);
    }
    // The largest of a number for each pair, and where it is: times and walls are numbered.
    let most = |of: &dyn Fn(f64, f64) -> f64| -> (f64, f64, Option<usize>) {
        let values: Vec<f64> = pairs.iter().map(|&(s, p)| of(s - gap_noise, p - force_noise)).collect();
        let at = (0..40).max_by(|&a, &b| values[a].total_cmp(&values[b])).expect("pairs");
        (values[at], at as f64, Some(at))
    };
    let shown = |worst: LargestResidual| (worst.value, worst.time, worst.wall);
    assert_eq!(shown(front.outside.excess), most(&|slack, _| -slack - 2.0 * gap_noise));
    assert_eq!(shown(front.pull.excess), most(&|_, pressure| -pressure - 2.0 * force_noise));
    for (gap, force) in [(1.0, 1.0), (0.3, 2.0), (5.0, 1.0)] {
        let both = most(&|slack, pressure| if slack > 0.0 { (slack / gap).min(pressure / force) } else { 0.0 });
        assert_eq!(shown(front.worst_excess(gap, force)), both, "{gap}, {force}");
    }
}

#[test]
fn of_equal_residuals_the_first_is_shown() {
    let mut worst = LargestResidual::default();
    worst.observe(0.0, 1.0, Some(1));
    assert_eq!((worst.time, worst.wall), (0.0, None));
    worst.observe(2.0, 3.0, Some(3));
    worst.observe(2.0, 4.0, Some(4));
    assert_eq!((worst.value, worst.time, worst.wall), (2.0, 3.0, Some(3)));
    let mut front = ComplementarityFront::default();
    front.add((1.0, 0.0), (2.0, 0.0), 3.0, 3);
    front.add((1.0, 0.0), (2.0, 0.0), 4.0, 4);
    let both = front.worst_excess(1.0, 1.0);
    assert_eq!((both.value, both.time, both.wall), (1.0, 3.0, Some(3)));
}

#[test]
fn a_pair_under_another_less_rounding_takes_no_room_from_later_ones() {
    let noise = 0.5;
    let mut front = ComplementarityFront::default();
    // No more than rounding.
    front.add((noise, noise), (9.0, noise), 0.0, 0);
    front.add((9.0, noise), (noise, noise), 0.0, 0);
    assert!(front.excess.is_empty());
    // One value stays while the other rises, or falls, or both rise: a row of more than PAIRS.
    let rows: [&dyn Fn(f64) -> (f64, f64); 5] =
        [&|x| (1.0, x), &|x| (x, 1.0), &|x| (1.0, 200.0 - x), &|x| (200.0 - x, 1.0), &|x| (x, 2.0 * x)];
    for (number, row) in rows.iter().enumerate() {
        let mut front = ComplementarityFront::default();
        for (slack, pressure) in (1..=100).map(|k| row(f64::from(k))) {
            front.add((slack + noise, noise), (pressure + noise, noise), slack + pressure, 0);
        }
        let most = [101.0, 101.0, 200.0, 200.0, 300.0][number];
        let places: Vec<f64> = front.excess.iter().map(|stair| stair.2.time).collect();
        assert_eq!(places, [most], "row {number}");
    }
}
