//! Programmes with more rows than the motion has degrees of freedom.
//!
//! Where many more rows are violated than can be linearly independent, exchanging all of them at
//! once brings far too many into play, pass after pass. Here a dual active-set method, which never
//! has more rows in play than the motion has degrees of freedom, finds the motion, starting from
//! its rows of the last programme. Its forces are one of many sets that cause the same motion;
//! those of least Σ Wᵢᵢ rᵢ² over all touching rows follow from
//!
//! minimise ½ Σ Wᵢᵢ rᵢ² subject to Σ rᵢ pᵢ = z, sᵢ rᵢ ≥ 0, W = P Pᵀ, pᵢ row i of P, z = Pᵀ r,
//!
//! whose dual is a piecewise quadratic function of as many unknowns w as there are degrees of
//! freedom: Wᵢᵢ sᵢ rᵢ = max(0, sᵢ pᵢ·w). Newton's method with an exact line search ends at its
//! minimum (Hintermüller, Ito and Kunisch 2002, doi:10.1137/S1052623401383558, for the method; its
//! steps are exact where no row changes its state). The result is used only to tell which rows
//! share the force: [`super::pivoting`] solves for their forces and tests them.

use super::active_set::ActiveSet;
use super::delassus::Delassus;
use super::pivoting::Pivoting;
use super::side::Side;
use super::sums::{add, dot};
use super::{ROUNDING, Rhs};

/// The factorisation W = P Pᵀ ends when no row has more than this share of its Wᵢᵢ left
/// (dimensionless): its rounding error.
const LEFT: f64 = 1e-14;

/// Maximum number of passes of pivoting from the rows found; one is usual.
const PASSES: usize = 20;

/// Maximum number of Newton steps; about ten from a cold start, one or two from the last
/// programme's w.
const STEPS: usize = 60;

/// Newton's method stops when the residual falls to the share [`REMAINS`] of z; a force below the
/// share [`NONE`] of the largest counts as zero (dimensionless). Both only separate rows that share
/// the force from those that do not.
const REMAINS: f64 = 1e-11;
const NONE: f64 = 1e-9;

/// Added to the Hessian's diagonal, times the number of sharing rows (each adds up to 1 there), so
/// that it can be factored (dimensionless).
const SHIFT: f64 = 1e-13;

/// Finds the rows in play of such programmes.
pub(super) struct RedundantRows {
    play: ActiveSet,
    /// pᵢ/√Wᵢᵢ, one after the other, `rank` entries each.
    direction: Vec<f64>,
    rank: usize,
    /// Motion of all rows under the forces of the active set.
    y: Vec<f64>,
    /// Touching rows with the side they touch (a row may touch both); s p·w of each, and its change
    /// along a Newton step.
    touching: Vec<(usize, Side)>,
    along: Vec<f64>,
    change: Vec<f64>,
    breaks: Vec<(f64, f64)>,
    w: Vec<f64>,
    step: Vec<f64>,
    /// z, and its residual.
    goal: Vec<f64>,
    fall: Vec<f64>,
    hessian: Vec<f64>,
}

impl RedundantRows {
    pub(super) fn new(system: &Delassus) -> Self {
        let m = system.count();
        let (direction, rank) = directions(system);
        Self {
            play: ActiveSet::new(m),
            direction,
            rank,
            y: vec![0.0; m],
            touching: Vec::with_capacity(2 * m),
            along: Vec::with_capacity(2 * m),
            change: Vec::with_capacity(2 * m),
            breaks: Vec::with_capacity(2 * m),
            w: vec![0.0; rank],
            step: vec![0.0; rank],
            goal: vec![0.0; rank],
            fall: vec![0.0; rank],
            hessian: vec![0.0; rank * rank],
        }
    }

    /// Solves for the free motion held in `system`: leaves the active set in `pivoting`, and writes
    /// the exact r (m entries). Returns the number of exchanges; `None` if it did not settle.
    pub(super) fn solve(
        &mut self,
        system: &Delassus,
        pivoting: &mut Pivoting,
        rhs: &Rhs,
        bounded: &[usize],
        scale: f64,
        r: &mut [f64],
    ) -> Option<u64> {
        // Ten exchanges for each row that can be in play: beyond that, rounding makes the method
        // cycle.
        let limit = 100 + 10 * self.rank as u64;
        let pivots = self.play.solve(system, rhs, scale, limit, r).ok()?;
        self.touch(system, rhs, scale, r);
        pivoting.clear();
        if self.touching.len() > self.play.rows().count() {
            self.share(system, r);
            let most = self.along.iter().fold(0.0, |most, v| f64::max(most, *v));
            for (&(row, side), &v) in self.touching.iter().zip(&self.along) {
                if v > NONE * most {
                    pivoting.call(row, side);
                }
            }
        } else {
            self.play.rows().for_each(|(row, side)| pivoting.call(row, side));
        }
        Some(pivots + pivoting.solve(system, rhs, bounded, scale, PASSES, r)?)
    }

    /// Finds the rows that touch under the forces r.
    fn touch(&mut self, system: &Delassus, rhs: &Rhs, scale: f64, r: &[f64]) {
        self.y.copy_from_slice(&system.y);
        for (row, _) in self.play.rows() {
            system.push(row, r[row], &mut self.y);
        }
        self.touching.clear();
        for (row, y) in self.y.iter().enumerate() {
            let slack = ROUNDING * scale.max(system.y[row].abs());
            for side in [Side::Lower, Side::Upper] {
                let force = side.sign() * r[row] > 0.0;
                if force || (y - side.bound(rhs, row)).abs() <= slack {
                    self.touching.push((row, side));
                }
            }
        }
    }

    /// Divides the forces r among the touching rows: leaves √Wᵢᵢ |rᵢ| in `along`, negative for a
    /// row that carries no force.
    fn share(&mut self, system: &Delassus, r: &[f64]) {
        let Self { play, direction, rank, touching, along, change, breaks, w, step, goal, fall, hessian, .. } = self;
        let n = *rank;
        let of = |row: usize| &direction[row * n..(row + 1) * n];
        goal.fill(0.0);
        for (row, _) in play.rows() {
            add(r[row] * system.weight[row], of(row), goal);
        }
        let size = dot(goal, goal).sqrt();
        if w.iter().all(|&w| w == 0.0) {
            w.copy_from_slice(goal);
        }
        for _ in 0..STEPS {
            along.clear();
            along.extend(touching.iter().map(|&(row, side)| side.sign() * dot(of(row), w)));
            step.copy_from_slice(goal);
            hessian.fill(0.0);
            let mut count = 0.0;
            for (&(row, side), &v) in touching.iter().zip(along.iter()).filter(|(_, v)| **v > 0.0) {
                let p = of(row);
                add(-side.sign() * v, p, step);
                for (i, line) in hessian.chunks_exact_mut(n).enumerate() {
                    add(p[i], &p[..=i], &mut line[..=i]);
                }
                count += 1.0;
            }
            if dot(step, step).sqrt() <= REMAINS * size {
                break;
            }
            fall.copy_from_slice(step);
            factor(hessian, n, SHIFT * f64::max(count, 1.0));
            solve(hessian, n, step);
            change.clear();
            change.extend(touching.iter().map(|&(row, side)| side.sign() * dot(of(row), step)));
            let length = line_search(along, change, dot(fall, step), breaks);
            if !length.is_finite() {
                break;
            }
            add(length, step, w);
        }
    }
}

/// The step length that minimises ½ Σ max(0, aᵢ + length bᵢ)² minus a term linear in the length;
/// `fall` is the rate at which that difference falls at length 0.
fn line_search(a: &[f64], b: &[f64], fall: f64, breaks: &mut Vec<(f64, f64)>) -> f64 {
    let (mut rate, mut slope, mut length) = (-fall, 0.0, 0.0);
    breaks.clear();
    for (&a, &b) in a.iter().zip(b) {
        let inside = a > 0.0 || (a == 0.0 && b > 0.0);
        if inside {
            slope += b * b;
        }
        if (inside && b < 0.0) || (!inside && b > 0.0) {
            breaks.push((-a / b, b * b.abs()));
        }
    }
    breaks.sort_unstable_by(|x, y| x.0.total_cmp(&y.0));
    for &(at, curve) in breaks.iter() {
        let next = rate + slope * (at - length);
        if next >= 0.0 {
            break;
        }
        (rate, length, slope) = (next, at, slope + curve);
    }
    if slope > 0.0 { length - rate / slope } else { length }
}

/// The rows of P divided by their norms, from a factorisation with the largest pivot first, and the
/// number of columns of P.
fn directions(system: &Delassus) -> (Vec<f64>, usize) {
    let m = system.count();
    let mut left: Vec<f64> = (0..m).map(|i| system.own(i)).collect();
    let mut columns: Vec<Vec<f64>> = Vec::new();
    loop {
        let share = |i: usize| left[i] / system.square(i);
        let Some(p) = (0..m).max_by(|&i, &j| share(i).total_cmp(&share(j))) else { break };
        if share(p).is_nan() || share(p) <= LEFT || columns.len() == m {
            break;
        }
        let (first, w) = system.row(p);
        let mut column = vec![0.0; m];
        column[first..first + w.len()].copy_from_slice(w);
        for before in &columns {
            add(-before[p], before, &mut column);
        }
        let root = left[p].sqrt();
        for (v, left) in column.iter_mut().zip(&mut left) {
            *v /= root;
            *left -= *v * *v;
        }
        left[p] = f64::NEG_INFINITY;
        columns.push(column);
    }
    let rank = columns.len();
    let mut direction = Vec::with_capacity(m * rank);
    for i in 0..m {
        direction.extend(columns.iter().map(|column| column[i] / system.weight[i]));
    }
    (direction, rank)
}

/// L of H + shift I in the lower half of `h`, n × n.
fn factor(h: &mut [f64], n: usize, shift: f64) {
    for i in 0..n {
        let (done, rest) = h.split_at_mut(i * n);
        let line = &mut rest[..n];
        for j in 0..i {
            let above = &done[j * n..=j * n + j];
            line[j] = (line[j] - dot(&above[..j], &line[..j])) / above[j];
        }
        let pivot = line[i] + shift - dot(&line[..i], &line[..i]);
        line[i] = pivot.max(shift).sqrt();
    }
}

/// Solves L Lᵀ v = v in place.
fn solve(l: &[f64], n: usize, v: &mut [f64]) {
    for i in 0..n {
        let line = &l[i * n..=i * n + i];
        v[i] = (v[i] - dot(&line[..i], &v[..i])) / line[i];
    }
    for i in (0..n).rev() {
        let line = &l[i * n..=i * n + i];
        let (before, own) = v.split_at_mut(i);
        own[0] /= line[i];
        add(-own[0], &line[..i], before);
    }
}

#[cfg(test)]
mod tests;
