//! Programmes in sequence: what is counted, what changes with the units, and forces that rows
//! share.

mod counters;
mod shares;
mod units;

use super::*;
use crate::linear::{Rows, Symmetric};
use crate::qp::tests::trial::tridiagonal;

const INF: f64 = f64::INFINITY;

/// A programme whose rows are single unknowns, all rigid.
fn single(a: Symmetric) -> Problem {
    let n = a.size();
    let entries: Vec<[(usize, f64); 1]> = (0..n).map(|i| [(i, 1.0)]).collect();
    Problem { a, g: Rows::new(n, entries.iter().map(|row| row.as_slice())), compliance: vec![0.0; n] }
}

#[test]
fn clarabel_answers_where_pivoting_does_not_settle() {
    let chain = || single(tridiagonal(3, 2.0, -1.0));
    let rhs = Rhs { b: &[5.0, -4.0, 1.0], lo: &[-1.0; 3], hi: &[1.0; 3] };
    let mut sound = Solver::new(chain(), Backend::Condensed, 1.0).unwrap();
    let exact = sound.solve(&rhs).unwrap().clone();
    let mut hurried = Solver::new(chain(), Backend::Condensed, 1.0).unwrap();
    let Kind::Condensed(condensed) = &mut hurried.kind else { panic!("not condensed") };
    condensed.passes = 0;
    assert_eq!(hurried.solve(&rhs).unwrap(), &exact);
    assert_eq!((hurried.counters().fallbacks, sound.counters().fallbacks), (1, 0));
    assert!(hurried.counters().iterations > 0 && sound.counters().iterations == 0);
}

#[test]
fn a_solver_says_which_it_is() {
    let solver = |backend| Solver::new(single(tridiagonal(1, 2.0, 0.0)), backend, 1.0).unwrap();
    for backend in [Backend::Clamp, Backend::Condensed, Backend::Clarabel] {
        assert_eq!(solver(backend).backend(), backend);
    }
    let text = format!("{:?}", solver(Backend::Clarabel));
    assert!(text.starts_with("Solver { backend: Clarabel, unknowns: 1, rows: 1,"), "{text}");
}
