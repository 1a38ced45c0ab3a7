//! The programme of the strips alone, for the pivoting method of a plain programme: where no disk
//! is in play but more strips than degrees of freedom nearly meet in a point, Newton's method
//! takes them all for equations, and has no rule by which one of them leaves.

use super::system::{ACCEPTED, State, System};
use super::{DiskBound, DiskProblem};
use crate::linear::Rows;
use crate::qp::{Backend, Problem, Rhs, Solver};

/// Solves for the strips with this `b`, and sets the multipliers and states of all blocks. `None`
/// where that fails, or the answer passes a disk.
pub(super) fn find(problem: &DiskProblem, system: &mut System, b: &[f64], scale: f64) -> Option<()> {
    let mut strips: Vec<(usize, [f64; 2])> = Vec::new();
    let mut rows: Vec<Vec<(usize, f64)>> = Vec::new();
    let (mut lows, mut highs) = (Vec::new(), Vec::new());
    for (block, bound) in system.bounds.iter().enumerate() {
        let DiskBound::Strip { normal, lo, hi } = *bound else { continue };
        if lo.is_finite() || hi.is_finite() {
            let (first, count) = system.blocks[block];
            rows.push(problem.g.combination((first..first + count).zip(normal)));
            strips.push((block, normal));
            lows.push(lo);
            highs.push(hi);
        }
    }
    let g = Rows::new(problem.a.size(), rows.iter().map(Vec::as_slice));
    let compliance = strips.iter().map(|&(block, _)| problem.compliance[block]).collect();
    let mut solver = Solver::new(Problem { a: problem.a.clone(), g, compliance }, Backend::Auto, scale).ok()?;
    let solution = solver.solve(&Rhs { b, lo: &lows, hi: &highs }).ok()?;
    system.forget();
    for (&(block, normal), &push) in strips.iter().zip(&solution.multiplier) {
        system.states[block] = match push {
            push if push > 0.0 => State::Low,
            push if push < 0.0 => State::High,
            _ => State::Free,
        };
        system.set_push(block, normal.map(|n| n * push));
    }
    system.renew();
    (system.miss().share <= ACCEPTED).then_some(())
}
