//! Counts of small programmes, by hand.

use super::*;
use crate::qp::tests::trial::Dense;

#[test]
fn programmes_without_a_force_are_counted() {
    for backend in [Backend::Clamp, Backend::Condensed, Backend::Clarabel] {
        let mut solver = Solver::new(single(tridiagonal(1, 1.0, 0.0)), backend, 1.0).unwrap();
        let mut free = |b: f64| {
            solver.solve(&Rhs { b: &[b], lo: &[-1.0], hi: &[1.0] }).unwrap();
            solver.counters().free
        };
        // Within the bounds, on one of them, and beyond.
        assert_eq!((free(0.5), free(1.0), free(-1.0), free(2.0), free(0.0)), (1, 2, 3, 3, 4), "{backend}");
        // What lies an ulp beyond a bound is not shown to the interior point.
        let expected = if backend == Backend::Clarabel { 5 } else { 4 };
        assert_eq!(free(1.0 + f64::EPSILON), expected, "{backend}");
    }
}

/// b, lo and hi.
type Step<'a> = (&'a [f64], &'a [f64], &'a [f64]);

/// Pivots after each of some programmes.
fn pivots(problem: Problem, programmes: &[Step]) -> Vec<u64> {
    let mut solver = Solver::new(problem, Backend::Condensed, 1.0).unwrap();
    let mut count = |&(b, lo, hi): &Step| {
        solver.solve(&Rhs { b, lo, hi }).unwrap();
        solver.counters().pivots
    };
    programmes.iter().map(&mut count).collect()
}

#[test]
fn rows_that_change_their_state_are_counted() {
    let (lo, hi): (&[f64], &[f64]) = (&[-1.0; 2], &[1.0; 2]);
    // Rows that hardly move one another start where the free motion puts them: nothing changes.
    let loose: [Step; 2] = [(&[4.0, -4.0], lo, hi), (&[-4.0, 0.1], lo, hi)];
    assert_eq!(pivots(single(tridiagonal(2, 2.0, -0.1)), &loose), [0, 0]);
    // Others start from the last programme's. At first both are held. Then 2x₁ − 1 = −5 with x₀ = 1
    // makes the second one pull, which is freed; it falls to −2, where the first pulls. That is
    // freed and the second held at −1, where x₀ = ½.
    let both: &[f64] = &[2.0, 2.0];
    let tight: [Step; 3] = [(both, lo, hi), (both, lo, hi), (&[2.0, -5.0], lo, hi)];
    assert_eq!(pivots(single(tridiagonal(2, 2.0, -1.0)), &tight), [2, 2, 5]);
    // A row between two bounds at one place is brought into play once, whichever way it pushes.
    let coincide = [[2.0, 0.0], [-2.0, 0.0], [2.0, 0.0]];
    let coincide = coincide.each_ref().map(|b| (&b[..], &[0.0, -9.0][..], &[0.0, 9.0][..]));
    assert_eq!(pivots(single(tridiagonal(2, 2.0, -1.0)), &coincide), [1, 1, 1]);
    // A row that touches without a force stays: y = 1 for both with r = (−1, −1), then (0, −1).
    let dense = Dense::rigid([[1.0, 0.0], [0.5, 1.0]]);
    assert_eq!(pivots(dense.problem(), &[(&[2.5, 1.5], lo, hi), (&[1.5, 1.5], lo, hi)]), [2, 2]);
}

#[test]
fn programmes_solved_on_the_band_are_counted() {
    let n = 200;
    let mut solver = Solver::new(single(tridiagonal(n, 1.0, -0.1)), Backend::Condensed, 1.0).unwrap();
    let mut solve = |lifted: usize| {
        let b: Vec<f64> = (0..n).map(|i| if i < lifted { -1.0 } else { 1.0 }).collect();
        solver.solve(&Rhs { b: &b, lo: &vec![-INF; n], hi: &vec![0.0; n] }).unwrap();
        (solver.counters().eliminated, solver.counters().pivots)
    };
    // All rows come into play; a pass over W then costs more than one over the band. Ten pull.
    assert_eq!((solve(0), solve(0), solve(10)), ((0, 200), (1, 200), (2, 210)));
}

#[test]
fn programmes_with_far_more_rows_than_unknowns_are_counted() {
    // A corner of 20 edges around the circle of radius 1, and a load far beyond it.
    let edge = |i: usize| (0.08 * i as f64).sin_cos();
    let mut rows: [[f64; 2]; 20] = std::array::from_fn(|i| [edge(i).0, edge(i).1]);
    rows[19] = rows[0];
    let mut solver = Solver::new(Dense::rigid(rows).problem(), Backend::Condensed, 1.0).unwrap();
    let found = solver.solve(&Rhs { b: &[10.0, 9.0], lo: &[-INF; 20], hi: &[1.0; 20] }).unwrap().clone();
    let sum = |k: usize| rows.iter().zip(&found.multiplier).map(|(g, r)| g[k] * r).sum::<f64>();
    assert!((found.x[0] - 10.0 - sum(0)).abs() < 1e-13 && (found.x[1] - 9.0 - sum(1)).abs() < 1e-13, "{found:?}");
    for (g, &r) in rows.iter().zip(&found.multiplier) {
        let y = g[0] * found.x[0] + g[1] * found.x[1];
        assert!(y < 1.0 + 1e-12 && r <= 0.0 && (r == 0.0 || y > 1.0 - 1e-12), "{found:?}");
    }
    let counters = solver.counters();
    assert_eq!((counters.crowded, counters.fallbacks, counters.iterations), (1, 0, 0), "{counters:?}");
    // Few edges come and go before the two next to the corner are found.
    assert!((1..=40).contains(&counters.pivots), "{counters:?}");
    // The first and the last edge face the same way: the one cannot be above 2 with the other below
    // 1. Every method is asked in vain.
    let (mut lo, mut hi) = ([-INF; 20], [INF; 20]);
    (lo[19], hi[0]) = (2.0, 1.0);
    let failure = solver.solve(&Rhs { b: &[10.0, 9.0], lo: &lo, hi: &hi }).unwrap_err();
    assert_eq!(failure, Failure::Infeasible { row: 19, against: 0 });
    let counters = solver.counters();
    assert_eq!((counters.crowded, counters.fallbacks), (2, 1), "{counters:?}");
}

#[test]
fn bounds_that_cross_are_named_behind_a_hundred_other_rows() {
    // Rows on unknowns of their own, all held, and two rows on one more that leave no room.
    let n = 121;
    let entries: Vec<[(usize, f64); 1]> = (0..n + 1).map(|i| [(i.min(n - 1), 1.0)]).collect();
    let g = Rows::new(n, entries.iter().map(|row| row.as_slice()));
    let problem = Problem { a: Symmetric::diagonal(&vec![1.0; n]), g, compliance: vec![0.0; n + 1] };
    let mut solver = Solver::new(problem, Backend::Condensed, 1.0).unwrap();
    let (mut b, mut lo, mut hi) = (vec![2.0; n], vec![-INF; n + 1], vec![1.0; n + 1]);
    (b[n - 1], lo[n - 1], hi[n - 1], hi[n]) = (0.0, 0.01, INF, -0.01);
    let failure = solver.solve(&Rhs { b: &b, lo: &lo, hi: &hi }).unwrap_err();
    assert_eq!(failure, Failure::Infeasible { row: n - 1, against: n });
}

#[test]
fn changes_after_the_interior_point_are_counted() {
    // y₀ = 0 and y₁ ≥ 1 put x₁ at 200. The interior point is shown no bound further than 100 of the
    // violations, and puts the third row, whose bound is at 400, into play with the others. There
    // x₂ would be 400 and x₁ 200 with r₂ = 800: that row pulls, and so does the second, whose force
    // would be 200 (200 − 800). Both are freed, and the second comes back.
    let problem = |row| Dense::rigid([[1.0, 0.0, 0.0], [1.0, 5e-3, 0.0], row]).problem();
    let rhs = Rhs { b: &[0.0; 3], lo: &[0.0, 1.0, -INF], hi: &[0.0, INF, 400.0] };
    let mut solver = Solver::new(problem([0.0, 1.0, 0.5]), Backend::Clarabel, 1.0).unwrap();
    let found = solver.solve(&rhs).unwrap();
    // The angle of 5e-3 makes some 1e5 of the rounding of 200, 3e-14.
    assert!((found.x[1] - 200.0).abs() < 1e-7 && found.x[2].abs() < 1e-7 && found.multiplier[2] == 0.0, "{found:?}");
    assert_eq!(solver.counters().pivots, 3);
    // A third row on x₁ alone leaves the interior point no room. The dual method brings the second
    // and then the first row into play, but what was asked for is the interior point.
    let mut solver = Solver::new(problem([0.0, 1.0, 0.0]), Backend::Clarabel, 1.0).unwrap();
    assert!(matches!(solver.solve(&rhs), Err(Failure::NotSolved { .. })));
    assert_eq!(solver.counters().pivots, 2);
}
