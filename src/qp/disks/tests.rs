//! Programmes with disks that look random, and the conditions that their solutions meet.

mod solver;

use super::{DiskBound, DiskProblem, dot, norm};
pub(super) use crate::hash::Draws;
use crate::linear::{Rows, Symmetric};

/// A programme with its b and bounds.
pub(super) struct Case {
    pub problem: DiskProblem,
    pub b: Vec<f64>,
    pub bounds: Vec<DiskBound>,
}

/// The units of length and force, and of each unknown after the other.
#[derive(Debug, Clone, Copy)]
pub(super) struct Units {
    pub length: f64,
    pub force: f64,
    pub unknown: f64,
}

impl Units {
    pub const SI: Self = Self { length: 1.0, force: 1.0, unknown: 1.0 };

    /// Of the other two, the first has rows of great compliance, the second of little. Powers of
    /// two keep the rounding of all numbers as it is.
    pub fn all() -> [Self; 3] {
        let [long, small] = [2.0_f64.powi(30), 2.0_f64.powi(-20)];
        [
            Self::SI,
            Self { length: long, force: small, unknown: 4.0 },
            Self { length: small, force: long, unknown: 0.25 },
        ]
    }
}

impl Case {
    /// Up to `most` disks and strips on a full matrix, rigid or not, with a point that all of them
    /// allow. Their rows are independent, or depend on `rank` unknowns.
    pub fn random(draws: &mut Draws, most: usize, rank: Option<usize>) -> Self {
        let blocks: Vec<usize> = (0..1 + draws.below(most)).map(|_| if draws.chance(0.3) { 1 } else { 2 }).collect();
        let m: usize = blocks.iter().sum();
        let n = rank.unwrap_or(m + draws.below(3));
        let mut full = |own: f64| -> Vec<Vec<f64>> {
            let entry = |i: usize, j: usize, x: f64| x + if i == j { own } else { 0.0 };
            (0..n).map(|i| (0..n).map(|j| entry(i, j, draws.between(-0.5, 0.5))).collect()).collect()
        };
        let half = full(1.5);
        let entry = |i: usize, j: usize| (0..n).map(|k| half[i][k] * half[j][k]).sum::<f64>();
        let entries = (0..n).flat_map(|i| (0..=i).map(move |j| (i, j)));
        let a = Symmetric::from_entries(n, entries.map(|(i, j)| (i, j, entry(i, j))).collect::<Vec<_>>());
        let mut point = |size: f64| -> Vec<f64> { (0..n).map(|_| size * draws.between(-1.0, 1.0)).collect() };
        let g: Vec<Vec<f64>> = (0..m).map(|_| point(1.0)).collect();
        let (inside, off) = (point(1.0), point(3.0));
        let free: Vec<f64> = inside.iter().zip(&off).map(|(x, off)| x + off).collect();
        let mut b = vec![0.0; n];
        a.add_product(1.0, &free, &mut b);
        let (mut bounds, mut compliance, mut first) = (Vec::new(), Vec::new(), 0);
        for &rows in &blocks {
            let at = |k: usize| {
                if k < rows { g[first + k].iter().zip(&inside).map(|(g, x)| g * x).sum::<f64>() } else { 0.0 }
            };
            let y = [at(0), at(1)];
            compliance.push(if draws.chance(0.3) { draws.between(0.01, 0.5) } else { 0.0 });
            let (radius, share, turn) = (draws.between(0.1, 2.0), draws.between(-0.9, 0.9), draws.between(0.0, 6.3));
            let normal = if rows == 1 { [1.0, 0.0] } else { [turn.cos(), turn.sin()] };
            bounds.push(if draws.chance(0.7) {
                DiskBound::Disk { centre: [0, 1].map(|i: usize| y[i] + share * radius * normal[i]), radius }
            } else {
                let (middle, open) = (dot(normal, y) + share * radius, draws.below(3));
                let lo = if open == 0 { f64::NEG_INFINITY } else { middle - radius };
                DiskBound::Strip { normal, lo, hi: if open == 1 { f64::INFINITY } else { middle + radius } }
            });
            first += rows;
        }
        let rows: Vec<Vec<(usize, f64)>> = g.into_iter().map(|row| row.into_iter().enumerate().collect()).collect();
        let g = Rows::new(n, rows.iter().map(Vec::as_slice));
        Self { problem: DiskProblem { a, g, blocks, compliance }, b, bounds }
    }

    /// The same programme in these units.
    pub fn in_units(&self, Units { length, force, unknown }: Units) -> Self {
        let DiskProblem { a, g, blocks, compliance } = &self.problem;
        let unit = |j: usize| unknown.powi(j as i32 % 3 - 1);
        let entries = a.entries().map(|(i, j, x)| (i, j, x * unit(i) * unit(j) * force / length));
        let rows: Vec<Vec<(usize, f64)>> =
            (0..g.count()).map(|row| g.row(row).iter().map(|&(j, x)| (j, x * unit(j))).collect()).collect();
        let problem = DiskProblem {
            a: Symmetric::from_entries(a.size(), entries.collect::<Vec<_>>()),
            g: Rows::new(a.size(), rows.iter().map(Vec::as_slice)),
            blocks: blocks.clone(),
            compliance: compliance.iter().map(|kappa| kappa * length / force).collect(),
        };
        let bounds = self.bounds.iter().map(|bound| match *bound {
            DiskBound::Disk { centre, radius } => {
                DiskBound::Disk { centre: centre.map(|c| c * length), radius: radius * length }
            }
            DiskBound::Strip { normal, lo, hi } => DiskBound::Strip { normal, lo: lo * length, hi: hi * length },
        });
        let b = self.b.iter().enumerate().map(|(j, b)| b * unit(j) * force).collect();
        Self { problem, b, bounds: bounds.collect() }
    }

    /// The most by which x and r miss A x = b + Gᵀr, the bounds, or the direction and sign of the
    /// multipliers, over the size of the terms.
    pub fn miss(&self, x: &[f64], r: &[f64]) -> f64 {
        let DiskProblem { a, g, blocks, compliance } = &self.problem;
        let mut left = self.b.iter().map(|b| -b).collect::<Vec<_>>();
        a.add_product(1.0, x, &mut left);
        (0..r.len()).for_each(|row| g.add_transposed(row, -r[row], &mut left));
        let mut size = vec![0.0_f64; x.len()];
        for (i, size) in size.iter_mut().enumerate() {
            let terms = (0..x.len()).map(|j| (a.get(i, j) * x[j]).abs());
            *size = terms.sum::<f64>() + self.b[i].abs();
        }
        let mut miss = left.iter().zip(&size).fold(0.0_f64, |most, (left, size)| most.max(left.abs() / size));
        let mut first = 0;
        for ((bound, &rows), kappa) in self.bounds.iter().zip(blocks).zip(compliance) {
            let (mut y, mut push, mut scale) = ([0.0; 2], [0.0; 2], 0.0);
            for (k, (y, push)) in y.iter_mut().zip(&mut push).enumerate().take(rows) {
                let row = first + k;
                (*y, *push) = (g.dot(row, x) + kappa * r[row], r[row]);
                scale += g.row(row).iter().map(|&(j, g)| (g * x[j]).abs()).sum::<f64>() + (kappa * r[row]).abs();
            }
            first += rows;
            let off = match *bound {
                DiskBound::Disk { centre, radius } => {
                    let (z, force) = ([y[0] - centre[0], y[1] - centre[1]], norm(push));
                    scale += radius + centre[0].abs() + centre[1].abs();
                    let askew = (push[0] * z[1] - push[1] * z[0]).abs() / force;
                    if force == 0.0 {
                        norm(z) - radius
                    } else if dot(push, z) < 0.0 {
                        (norm(z) - radius).abs().max(askew)
                    } else {
                        f64::INFINITY
                    }
                }
                DiskBound::Strip { normal, lo, hi } => {
                    let (y, along) = (dot(normal, y), dot(normal, push));
                    scale += [lo, hi].into_iter().filter(|x| x.is_finite()).fold(0.0, |most, x| x.abs().max(most));
                    let askew = (normal[0] * push[1] - normal[1] * push[0]).abs();
                    assert!(askew <= 1e-9 * norm(push), "{push:?} of a strip along {normal:?}");
                    if along > 0.0 {
                        (y - lo).abs()
                    } else if along < 0.0 {
                        (y - hi).abs()
                    } else {
                        (lo - y).max(y - hi)
                    }
                }
            };
            miss = miss.max(off / scale);
        }
        miss
    }
}
