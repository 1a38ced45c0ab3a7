//! Cost of a step's programme: the clamp, bare Clarabel (`update_q`, `update_b`, `solve`), and the polished solver,
//! measured in turn in one run. Prints a table; asserts nothing about time.

use clarabel::algebra::CscMatrix;
use clarabel::solver::{DefaultSolver, IPSolver, NonnegativeConeT};
use signorini::linear::{Rows, Symmetric};
use signorini::qp::{Backend, Problem, Rhs, ScalarRow, Solver, clamp};
use std::hint::black_box;

mod support;
use support::{clarabel_settings, race, time};

/// Best of these rounds counts; sides take turns within each.
const ROUNDS: usize = 15;

/// A chain of n springs with a box of ±1 on every unknown; loads that push a varying part of it against the walls.
fn chain(n: usize) -> (Problem, Vec<Vec<f64>>) {
    let a = Symmetric::from_entries(n, (0..n).map(|i| (i, i, 3.0)).chain((1..n).map(|i| (i, i - 1, -1.0))));
    let unit: Vec<[(usize, f64); 1]> = (0..n).map(|i| [(i, 1.0)]).collect();
    let g = Rows::new(n, unit.iter().map(|row| row.as_slice()));
    let problem = Problem { a, g, compliance: vec![0.0; n] };
    let loads = (0..64)
        .map(|step| (0..n).map(|i| 5.0 * (0.37 * f64::from(step) + 0.9 * i as f64).sin() + 4.0).collect())
        .collect();
    (problem, loads)
}

fn by_columns(height: usize, columns: &[Vec<(usize, f64)>]) -> CscMatrix<f64> {
    let (mut starts, mut rows, mut values) = (vec![0], vec![], vec![]);
    for column in columns {
        rows.extend(column.iter().map(|entry| entry.0));
        values.extend(column.iter().map(|entry| entry.1));
        starts.push(rows.len());
    }
    CscMatrix::new(height, columns.len(), starts, rows, values)
}

/// Clarabel as one would call it by hand, at the same tolerance, on the same (already dimensionless) programme.
fn bare(problem: &Problem) -> DefaultSolver<f64> {
    let n = problem.a.size();
    // Rows of the lower triangle are columns of the upper one; a box's rows are its columns.
    let mut columns = vec![vec![]; n];
    problem.a.entries().for_each(|(i, j, value)| columns[i].push((j, value)));
    let cost = by_columns(n, &columns);
    let rows = by_columns(2 * n, &(0..n).map(|i| vec![(i, 1.0), (n + i, -1.0)]).collect::<Vec<_>>());
    DefaultSolver::new(&cost, &vec![0.0; n], &rows, &vec![1.0; 2 * n], &[NonnegativeConeT(2 * n)], clarabel_settings())
        .expect("a sound programme")
}

fn main() {
    println!("{:>5} {:>14} {:>14} {:>8} {:>18}", "n", "bare ns", "polished ns", "ratio", "iterations a step");
    for n in [1, 5, 20, 40] {
        let (problem, loads) = chain(n);
        // Only steps that meet a wall: the free ones cost the polished solver next to nothing.
        let mut polished = Solver::new(problem.clone(), Backend::Clarabel, 1.0).expect("a sound problem");
        let (lo, hi) = (vec![-1.0; n], vec![1.0; n]);
        let mut met = |b: &Vec<f64>| {
            let found = polished.solve(&Rhs { b, lo: &lo, hi: &hi }).expect("feasible");
            found.multiplier.iter().any(|&r| r != 0.0)
        };
        let loads: Vec<_> = loads.into_iter().filter(|b| met(b)).collect();
        let mut direct = bare(&problem);
        let bounds = vec![1.0; 2 * n];
        let calls = loads.len() * (400 / n).max(1);
        let mut q = vec![0.0; n];
        let (mut hand, mut before) = (0_u64, polished.counters());
        let [best_bare, best_polished] = race(ROUNDS, || {
            hand = 0;
            let by_hand = time(calls, |call| {
                for (q, b) in q.iter_mut().zip(&loads[call % loads.len()]) {
                    *q = -b;
                }
                direct.update_q(&q).expect("updatable");
                direct.update_b(&bounds).expect("updatable");
                direct.solve();
                hand += u64::from(direct.solution.iterations);
                black_box(&direct.solution.x);
            });
            before = polished.counters();
            let ours = time(calls, |call| {
                let rhs = Rhs { b: &loads[call % loads.len()], lo: &lo, hi: &hi };
                black_box(polished.solve(&rhs).expect("feasible"));
            });
            [by_hand, ours]
        });
        let ours = polished.counters().iterations - before.iterations;
        println!(
            "{n:>5} {best_bare:>14.0} {best_polished:>14.0} {:>8.2} {:>8.1} / {:>7.1}",
            best_polished / best_bare,
            hand as f64 / calls as f64,
            ours as f64 / calls as f64
        );
    }

    let rows = [
        ScalarRow { lo: -1.0, hi: f64::INFINITY, compliance: 0.0 },
        ScalarRow { lo: f64::NEG_INFINITY, hi: 1.0, compliance: 0.0 },
    ];
    let layer = [ScalarRow { compliance: 0.1, ..rows[0] }, rows[1]];
    let (mut r, calls) = ([0.0; 2], 1_000_000);
    let problem = Problem {
        a: Symmetric::diagonal(&[3.0]),
        g: Rows::new(1, [[(0, 1.0)].as_slice(); 2]),
        compliance: vec![0.0; 2],
    };
    let mut matrices = Solver::new(problem, Backend::Clamp, 1.0).expect("a sound problem");
    let (lo, hi) = ([-1.0, f64::NEG_INFINITY], [f64::INFINITY, 1.0]);
    let best = race(ROUNDS, || {
        [
            time(calls, |_| {
                let b: f64 = black_box(6.0);
                let x = (b / 3.0).clamp(-1.0, 1.0);
                black_box((x, 3.0 * x - b));
            }),
            time(calls, |_| {
                black_box(clamp(3.0, black_box(1.0), &rows, &mut r)).ok();
            }),
            time(calls, |_| {
                black_box(clamp(3.0, black_box(6.0), &rows, &mut r)).ok();
            }),
            time(calls, |_| {
                black_box(clamp(3.0, black_box(-6.0), &layer, &mut r)).ok();
            }),
            time(calls, |_| {
                black_box(matrices.solve(&Rhs { b: &[black_box(6.0)], lo: &lo, hi: &hi })).ok();
            }),
        ]
    });
    println!("\nscalar, ns a call");
    let names =
        ["bare clamp of one float", "clamp(), free", "clamp(), rigid contact", "clamp(), elastic", "Solver, clamp"];
    for (name, best) in names.iter().zip(best) {
        println!("{name:<26} {best:>8.1}");
    }
}
