//! A solve allocates nothing after the first, what Clarabel allocates inside itself apart.

use crate::counting;
use signorini::linear::{Rows, Symmetric};
use signorini::qp::{Backend, Problem, Rhs, Solver};

/// Allocations of 100 solves after the first, on n boxes that the loads push against.
fn allocations(backend: Backend, n: usize) -> u64 {
    let unit: Vec<Vec<(usize, f64)>> = (0..n).map(|i| vec![(i, 1.0)]).collect();
    let g = Rows::new(n, unit.iter().map(Vec::as_slice));
    let problem = Problem { a: Symmetric::diagonal(&vec![1.0; n]), g, compliance: vec![0.0; n] };
    let mut solver = Solver::new(problem, backend, 1.0).expect("sound");
    let (lo, hi) = (vec![-1.0; n], vec![1.0; n]);
    let mut b = vec![3.0; n];
    solver.solve(&Rhs { b: &b, lo: &lo, hi: &hi }).expect("feasible");
    let before = counting::count();
    for step in 0..100 {
        b.fill(2.0 + f64::from(step) / 50.0);
        solver.solve(&Rhs { b: &b, lo: &lo, hi: &hi }).expect("feasible");
    }
    counting::count() - before
}

#[test]
fn the_clamp_allocates_nothing() {
    assert_eq!(allocations(Backend::Clamp, 1), 0);
}

#[test]
fn the_polished_solver_allocates_only_what_clarabel_does() {
    for n in [1, 2, 10] {
        let count = allocations(Backend::Clarabel, n);
        println!("{n}: {count} in 100 solves");
        assert!(count <= 100, "{n} unknowns: {count} allocations in 100 solves"); // Clarabel: one a solve
    }
}

#[test]
fn the_condensed_solver_allocates_nothing_while_rows_come_and_go() {
    // Chains of all stiffness, with every third wall doubled and with rows that depend on others:
    // loads that wander through.
    for (n, coupling, twice) in [(2, 0.1, false), (30, 0.0025, false), (30, 10.0, true), (60, 0.5, true)] {
        let chain = (0..n).map(|i| (i, i, 1.0 + 2.0 * coupling)).chain((1..n).map(|i| (i, i - 1, -coupling)));
        let mut rows: Vec<Vec<(usize, f64)>> = (0..n).map(|i| vec![(i, 1.0)]).collect();
        if twice {
            rows.extend((0..n).step_by(3).map(|i| vec![(i, 1.0)]));
            rows.push(vec![(0, 1.0), (n - 1, 1.0)]);
        }
        let m = rows.len();
        let g = Rows::new(n, rows.iter().map(Vec::as_slice));
        let problem = Problem { a: Symmetric::from_entries(n, chain), g, compliance: vec![0.0; m] };
        let mut solver = Solver::new(problem, Backend::Condensed, 1.0).expect("sound");
        let (mut lo, mut hi, mut b) = (vec![-1.0; m], vec![1.0; m], vec![0.0; n]);
        (lo[m - 1], hi[m - 1]) = (-2.0, 2.0);
        let mut before = 0;
        for step in 0..200 {
            for (i, b) in b.iter_mut().enumerate() {
                *b = 3.0 * (0.1 * f64::from(step) + 0.4 * i as f64).sin();
            }
            solver.solve(&Rhs { b: &b, lo: &lo, hi: &hi }).expect("feasible");
            if step == 0 {
                before = counting::count();
            }
        }
        let counters = solver.counters();
        assert_eq!(counting::count() - before, 0, "{n}, {coupling}: {counters:?}");
        assert!(counters.fallbacks == 0 && counters.free < 100, "{counters:?}");
    }
}
