//! The programme with disks as second-order cones, for Clarabel: where Newton's method does not
//! settle, it finds which blocks are in play.
//!
//! With x = x_free + v D x̂, D = diag(A)^(−1/2), ρ² the largest Wᵢᵢ of a block's rows and v the
//! largest violation of the free motion over its ρ, a disk is the cone
//!
//! (γ, z_free + v P D x̂)/(ρv),
//!
//! so that the matrix and the largest violation are of size 1. A block that yields has one more
//! unknown for each of its rows.

use super::system::{State, System};
use super::{DiskBound, DiskProblem, dot};
use crate::qp::Failure;
use crate::qp::clarabel::{Cone, solve_cones};

/// A block counts as in play where its dimensionless multiplier exceeds this and its gap.
const LEAST: f64 = 1e-10;

/// One row −A_c x̂ + b of the cones: its factors on the rows of a block, and b.
struct ConeRow {
    block: usize,
    along: [f64; 2],
    bound: f64,
}

/// The units of a programme: of the displacements of block i, ρᵢv, and of its multipliers, v/ρᵢ.
struct Units {
    /// ρ of each block.
    weight: Vec<f64>,
    /// v.
    violation: f64,
}

/// Solves for the free motion held in `system`: sets the multipliers that Clarabel finds, and the
/// states of the blocks. Returns the number of iterations.
///
/// # Errors
/// [`Failure::Infeasible`] with two of the blocks whose bounds have no common point;
/// [`Failure::NotSolved`].
pub(super) fn find(problem: &DiskProblem, system: &mut System) -> Result<u64, Failure> {
    system.forget();
    system.renew();
    let units = Units::of(system)?;
    let (lines, cones) = cones_of(system, &units);
    let (cost, rows) = scaled(problem, system);
    let mut columns: Vec<Vec<(usize, f64)>> = vec![Vec::new(); cost.len()];
    for (i, line) in lines.iter().enumerate() {
        let (first, count) = system.blocks[line.block];
        for (entries, along) in rows[first..first + count].iter().zip(line.along) {
            for &(j, value) in entries.iter().filter(|_| along != 0.0) {
                columns[j].push((i, along * value / units.weight[line.block]));
            }
        }
    }
    let bound: Vec<f64> = lines.iter().map(|line| line.bound).collect();
    let (dual, iterations) = solve_cones(&cost, &columns, &bound, &cones)?;
    let Some(iterations) = iterations else { return Err(apart(&lines, &dual)) };
    for (line, z) in lines.iter().zip(&dual) {
        // A x̂ + A_cᵀ z = 0 in scaled unknowns: the multiplier is −along z.
        let push = system.push(line.block);
        let share = -z * units.violation / units.weight[line.block];
        system.set_push(line.block, [push[0] + share * line.along[0], push[1] + share * line.along[1]]);
    }
    system.renew();
    set_states(system, &units);
    system.renew();
    Ok(iterations)
}

impl Units {
    /// Those of the free motion held in `system`, whose multipliers are 0.
    ///
    /// # Errors
    /// [`Failure::NotSolved`] where it violates no bound.
    fn of(system: &System) -> Result<Self, Failure> {
        let weight: Vec<f64> = (0..system.blocks.len())
            .map(|block| {
                let [yy, .., zz] = system.between(block, block);
                yy.max(zz).sqrt()
            })
            .collect();
        let violation =
            weight.iter().enumerate().map(|(block, weight)| system.beyond(block) / weight).fold(0.0, f64::max);
        if !(violation > 0.0 && violation.is_finite()) {
            return Err(Failure::NotSolved { status: "no violation to scale by" });
        }
        Ok(Self { weight, violation })
    }
}

/// The cones of all bounds, and their rows.
fn cones_of(system: &System, units: &Units) -> (Vec<ConeRow>, Vec<Cone>) {
    let (mut lines, mut cones) = (Vec::new(), Vec::new());
    for (block, bound) in system.bounds.iter().enumerate() {
        let unit = units.weight[block] * units.violation;
        match *bound {
            DiskBound::Disk { radius, .. } => {
                let [y, z] = system.offset(block);
                lines.push(ConeRow { block, along: [0.0; 2], bound: radius / unit });
                lines.push(ConeRow { block, along: [-1.0, 0.0], bound: y / unit });
                lines.push(ConeRow { block, along: [0.0, -1.0], bound: z / unit });
                cones.push(Cone::Disk);
            }
            DiskBound::Strip { normal, lo, hi } => {
                let y = dot(normal, system.offset(block));
                for (sign, gap) in [(1.0, hi - y), (-1.0, y - lo)] {
                    if gap.is_finite() {
                        lines.push(ConeRow { block, along: normal.map(|n| sign * n), bound: gap / unit });
                        cones.push(Cone::Half);
                    }
                }
            }
        }
    }
    (lines, cones)
}

/// Columns or rows of a matrix: the place and value of each entry.
type Entries = Vec<Vec<(usize, f64)>>;

/// D A D by columns, its upper triangle, and G D by rows; both with the yields behind them.
fn scaled(problem: &DiskProblem, system: &System) -> (Entries, Entries) {
    let n = problem.a.size();
    let unit: Vec<f64> = problem.a.diagonal_entries().iter().map(|d| 1.0 / d.sqrt()).collect();
    // The lower triangle by rows is the upper one by columns.
    let mut cost: Entries = vec![Vec::new(); n];
    for (i, j, value) in problem.a.entries() {
        cost[i].push((j, if i == j { 1.0 } else { unit[i] * value * unit[j] }));
    }
    let mut rows: Entries = Vec::with_capacity(problem.g.count());
    for (&(first, count), &compliance) in system.blocks.iter().zip(&problem.compliance) {
        for row in first..first + count {
            let mut entries: Vec<_> = problem.g.row(row).iter().map(|&(j, g)| (j, g * unit[j])).collect();
            if compliance > 0.0 {
                entries.push((cost.len(), compliance.sqrt()));
                cost.push(vec![(cost.len(), 1.0)]);
            }
            rows.push(entries);
        }
    }
    (cost, rows)
}

/// Sets the state of each block from its multiplier: in play where that exceeds the gap, both
/// dimensionless.
fn set_states(system: &mut System, units: &Units) {
    for (block, weight) in units.weight.iter().enumerate() {
        let push = system.push(block);
        let unit = weight * units.violation;
        let (pressure, gap) = (push[0].hypot(push[1]) * weight / units.violation, -system.beyond(block) / unit);
        if pressure <= gap.max(LEAST) {
            system.set_push(block, [0.0; 2]);
            continue;
        }
        match system.bounds[block] {
            DiskBound::Disk { radius, .. } => {
                system.states[block] = State::Circle;
                system.mu[block] = push[0].hypot(push[1]) / radius;
            }
            DiskBound::Strip { normal, .. } => {
                system.states[block] = if dot(normal, push) > 0.0 { State::Low } else { State::High };
            }
        }
    }
}

/// The two blocks that weigh most in Clarabel's certificate that there is no common point.
fn apart(lines: &[ConeRow], certificate: &[f64]) -> Failure {
    let mut most = [(0.0, usize::MAX); 2];
    for (line, z) in lines.iter().zip(certificate) {
        let entry = (z.abs(), line.block);
        if let Some(known) = most.iter_mut().find(|known| known.1 == line.block) {
            known.0 = entry.0.max(known.0);
        } else if entry.0 > most[0].0 {
            most = [entry, most[0]];
        } else if entry.0 > most[1].0 {
            most[1] = entry;
        }
        if most[1].0 > most[0].0 {
            most.swap(0, 1);
        }
    }
    let [(_, row), (_, against)] = most;
    Failure::Infeasible { row, against: if against == usize::MAX { row } else { against } }
}

#[cfg(test)]
mod tests;
