//! Blocks alone, and what multipliers miss, by hand.

use super::super::tests::{Case, Draws};
use super::*;
use crate::linear::Symmetric;

/// Disks and strips on unknowns of stiffness 1, one for each row, at this free motion.
fn system(blocks: &[usize], bounds: &[DiskBound], free: &[f64]) -> System {
    let rows: Vec<[(usize, f64); 1]> = (0..free.len()).map(|i| [(i, 1.0)]).collect();
    let problem = DiskProblem {
        a: Symmetric::diagonal(&vec![1.0; free.len()]),
        g: Rows::new(free.len(), rows.iter().map(|row| row.as_slice())),
        blocks: blocks.to_vec(),
        compliance: vec![0.0; blocks.len()],
    };
    let mut system = System::new(&problem).expect("a definite matrix");
    system.release(free, &mut vec![0.0; free.len()]);
    system.is_free(bounds);
    system.renew();
    system
}

/// Rounding of numbers up to 100.
const ROUNDING: f64 = 1e-13;

#[test]
fn a_block_alone_is_answered_exactly_whatever_was_there_before() {
    let mut seen = [0; 4];
    for seed in 0..400 {
        let mut draws = Draws::new(11, 3000 + seed);
        let case = Case::random(&mut draws, 1, None);
        let mut system = System::new(&case.problem).expect("a definite matrix");
        let mut x = vec![0.0; case.b.len()];
        system.release(&case.b, &mut x);
        system.is_free(&case.bounds);
        if let DiskBound::Strip { normal, .. } = case.bounds[0] {
            system.set_push(0, normal.map(|n| n * draws.between(-1.0, 1.0)));
        } else {
            let push = [draws.between(-1.0, 1.0), draws.between(-1.0, 1.0)];
            system.set_push(0, push);
        }
        system.renew();
        system.answer(0);
        let y = system.y.clone();
        system.renew();
        let moved = y.iter().zip(&system.y).fold(0.0_f64, |most, (a, b)| most.max((a - b).abs()));
        assert!(moved < ROUNDING, "{seed}: {moved:e}");
        system.respond(&mut x);
        let miss = case.miss(&x, &system.r);
        // The condition of two rows, up to some hundred, times roundings.
        assert!(miss < 1e-12, "{seed}: {miss:e}");
        let (state, push) = (system.states[0], system.push(0));
        seen[state as usize] += 1;
        let along = |normal: [f64; 2]| dot(normal, push);
        match (state, case.bounds[0]) {
            (State::Free, _) => assert_eq!(push, [0.0; 2]),
            (State::Circle, DiskBound::Disk { radius, .. }) => {
                let z = system.offset(0);
                assert!((norm(z) / radius - 1.0).abs() < 1e-12 && system.mu[0] > 0.0, "{seed}");
                let off = norm([push[0] + system.mu[0] * z[0], push[1] + system.mu[0] * z[1]]);
                assert!(off < 1e-12 * norm(push), "{seed}: {off:e}");
            }
            (State::Low, DiskBound::Strip { normal, .. }) => assert!(along(normal) > 0.0, "{seed}"),
            (State::High, DiskBound::Strip { normal, .. }) => assert!(along(normal) < 0.0, "{seed}"),
            other => panic!("{seed}: {other:?}"),
        }
    }
    assert!(seen.iter().all(|&count| count > 10), "{seen:?}");
}

#[test]
fn a_miss_is_the_distance_from_the_bound_over_the_sizes_of_its_terms() {
    // At (6, 0) a disk of radius 3 about (2, 0) is passed by 1; the terms are 6, 2 and 3.
    let disk = DiskBound::Disk { centre: [2.0, 0.0], radius: 3.0 };
    let mut one = system(&[2], &[disk], &[6.0, 0.0]);
    let near = |miss: Miss, distance: f64, rounding: f64, share: f64| {
        let off = [miss.distance - distance, miss.rounding - rounding, miss.share - share];
        assert!(off.iter().all(|off| off.abs() < 1e-15), "{miss:?}: {distance} {rounding} {share}");
    };
    near(one.miss(), 1.0 / 11.0, 1.0 / 11.0, 1.0 / 11.0);
    // With a push of (−3, 4): at (3, 4), √17 from the centre, and off the line of the push by
    // |(1, 4) × (−3, 4)|/5 = 16/5. The terms are 9 and 4 in place of 6 and 0.
    one.set_push(0, [-3.0, 4.0]);
    one.states[0] = State::Circle;
    one.renew();
    near(one.miss(), 3.2 / 11.0, 3.2 / 18.0, 3.2 / 11.0);
    // On the line of the push, (−1.5, 0): at 4.5, short of the circle by 0.5.
    one.set_push(0, [-1.5, 0.0]);
    one.renew();
    near(one.miss(), 0.5 / 11.0, 0.5 / 12.5, 0.5 / 11.0);
    // A strip beside it, at 40 in [10, 20]: 20 over 60 of its own terms; 0.5 of the disk remains
    // the smaller miss, and 60 the larger size.
    let strip = DiskBound::Strip { normal: [1.0, 0.0], lo: 10.0, hi: 20.0 };
    let mut two = system(&[2, 1], &[disk, strip], &[6.0, 0.0, 40.0]);
    near(two.miss(), 20.0 / 60.0, 20.0 / 60.0, 20.0 / 60.0);
    two.states[1] = State::Low;
    two.set_push(1, [-35.0, 0.0]);
    two.renew();
    near(two.miss(), 1.0 / 11.0, 1.0 / 11.0, 5.0 / 60.0);
    two.set_push(1, [f64::NAN, 0.0]);
    two.renew();
    assert_eq!(two.miss().distance, f64::INFINITY);
}

#[test]
fn a_free_block_is_passed_if_it_is_beyond_its_bound_by_more_than_rounding() {
    // Terms of 3 and 3 lengths, in each block: 96 roundings of a length are nothing.
    for size in [1e-9, 1.0, 1e9] {
        for (beyond, passed) in [(72.0, false), (128.0, true)] {
            let at = size * (3.0 + beyond * f64::EPSILON);
            let disk = DiskBound::Disk { centre: [size, 0.0], radius: 2.0 * size };
            let strip = DiskBound::Strip { normal: [1.0, 0.0], lo: f64::NEG_INFINITY, hi: 3.0 * size };
            let mut both = system(&[2, 1], &[disk, strip], &[at, 0.0, at]);
            assert_eq!([both.is_passed(0), both.is_passed(1)], [passed; 2], "{size:e}, {beyond}");
            both.states = vec![State::Circle, State::High];
            assert_eq!([both.is_passed(0), both.is_passed(1)], [false; 2], "{size:e}, {beyond}");
        }
    }
}
