//! A solve allocates nothing after the first, what Clarabel allocates inside itself apart.

use signorini::linear::{Rows, Symmetric};
use signorini::qp::{Backend, Problem, Rhs, Solver};
use std::alloc::{GlobalAlloc, Layout, System};
use std::cell::Cell;

struct Counting;

thread_local! {
    static COUNT: Cell<u64> = const { Cell::new(0) };
}

// Counting needs an allocator, and an allocator needs unsafe: it only passes on.
unsafe impl GlobalAlloc for Counting {
    unsafe fn alloc(&self, layout: Layout) -> *mut u8 {
        let _ = COUNT.try_with(|count| count.set(count.get() + 1));
        unsafe { System.alloc(layout) }
    }
    unsafe fn dealloc(&self, pointer: *mut u8, layout: Layout) {
        unsafe { System.dealloc(pointer, layout) }
    }
}

#[global_allocator]
static ALLOCATOR: Counting = Counting;

/// Allocations of 100 solves after the first, on n boxes that the loads push against.
fn allocations(backend: Backend, n: usize) -> u64 {
    let unit: Vec<Vec<(usize, f64)>> = (0..n).map(|i| vec![(i, 1.0)]).collect();
    let g = Rows::new(n, unit.iter().map(Vec::as_slice));
    let problem = Problem { a: Symmetric::diagonal(&vec![1.0; n]), g, compliance: vec![0.0; n] };
    let mut solver = Solver::new(problem, backend, 1.0).expect("sound");
    let (lo, hi) = (vec![-1.0; n], vec![1.0; n]);
    let mut b = vec![3.0; n];
    solver.solve(&Rhs { b: &b, lo: &lo, hi: &hi }).expect("feasible");
    let before = COUNT.with(Cell::get);
    for step in 0..100 {
        b.fill(2.0 + f64::from(step) / 50.0);
        solver.solve(&Rhs { b: &b, lo: &lo, hi: &hi }).expect("feasible");
    }
    COUNT.with(Cell::get) - before
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
