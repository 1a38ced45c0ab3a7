//! The programme on its rows: free motion, Delassus operator and multipliers.

use super::one::multiplier;
use super::{DiskBound, DiskProblem, dot, norm};
use crate::linear::{Factor, Rows};
use crate::qp::{Failure, NOISE};

/// An answer that misses by less than this share of the size of its terms is rounding.
const ROUNDED: f64 = 4.0 * f64::EPSILON;

/// An answer that misses by more than this share of the size of bound and free motion is none.
pub(super) const ACCEPTED: f64 = 1e-11;

/// Where a block stands.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum State {
    Free,
    /// On its circle.
    Circle,
    /// On the bound l or u of its strip.
    Low,
    High,
}

/// A programme condensed onto its m rows, block after block.
#[derive(Debug)]
pub(super) struct System {
    factor: Factor,
    rows: Rows,
    /// First row and number of rows of each block.
    pub blocks: Vec<(usize, usize)>,
    /// A⁻¹gᵀ of each row, n entries each.
    lift: Vec<f64>,
    /// W, m × m.
    pub delassus: Vec<f64>,
    /// G A⁻¹b.
    pub free: Vec<f64>,
    /// y and r for the multipliers found so far; the size of the terms of y.
    pub y: Vec<f64>,
    pub r: Vec<f64>,
    sizes: Vec<f64>,
    pub bounds: Vec<DiskBound>,
    pub states: Vec<State>,
    /// μ of each disk in play.
    pub mu: Vec<f64>,
}

/// How far multipliers are from solving a programme.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Miss {
    /// The largest distance of a block in play from its bound, or from the line of its multiplier,
    /// or beyond the bound of another block, over the size of its free motion and bound.
    pub distance: f64,
    /// The same over the size of all its terms, those of the multipliers included: what of it is
    /// rounding. Multipliers that grow without limit, as where bounds have no common point, make
    /// this small, and the others not.
    pub rounding: f64,
    /// The same over the largest size of free motion and bound of all blocks.
    pub share: f64,
}

impl Miss {
    /// True if what is missed is rounding, of multipliers that have not grown without limit.
    pub fn is_rounded(&self) -> bool {
        self.rounding <= ROUNDED && self.share <= ACCEPTED
    }
}

impl System {
    /// Factors A.
    pub fn new(problem: &DiskProblem) -> Result<Self, Failure> {
        let mut factor = Factor::new(&problem.a).map_err(|_| Failure::NotPositiveDefinite)?;
        let (n, m) = (problem.a.size(), problem.g.count());
        let mut blocks = Vec::with_capacity(problem.blocks.len());
        let mut first = 0;
        for &rows in &problem.blocks {
            blocks.push((first, rows));
            first += rows;
        }
        let mut lift = vec![0.0; n * m];
        let mut delassus = vec![0.0; m * m];
        for row in 0..m {
            let x = &mut lift[row * n..(row + 1) * n];
            problem.g.add_transposed(row, 1.0, x);
            factor.solve(x);
            for other in 0..m {
                delassus[other * m + row] = problem.g.dot(other, x);
            }
        }
        for (&(first, rows), compliance) in blocks.iter().zip(&problem.compliance) {
            (first..first + rows).for_each(|row| delassus[row * m + row] += compliance);
        }
        // Rounding leaves W almost symmetric.
        for i in 0..m {
            for j in 0..i {
                let mean = 0.5 * (delassus[i * m + j] + delassus[j * m + i]);
                (delassus[i * m + j], delassus[j * m + i]) = (mean, mean);
            }
        }
        if !delassus.iter().fold(true, |all, w| all & w.is_finite()) {
            return Err(Failure::NotPositiveDefinite);
        }
        let (count, zero) = (blocks.len(), || vec![0.0; m]);
        Ok(Self {
            factor,
            rows: problem.g.clone(),
            blocks,
            lift,
            delassus,
            free: zero(),
            y: zero(),
            r: zero(),
            sizes: zero(),
            bounds: vec![DiskBound::OPEN; count],
            states: vec![State::Free; count],
            mu: vec![0.0; count],
        })
    }

    /// Forgets the multipliers of the last programme, from which the next one would start.
    pub fn forget(&mut self) {
        self.r.fill(0.0);
        self.mu.fill(0.0);
        self.states.fill(State::Free);
    }

    /// Computes the free motion x = A⁻¹b and its rows.
    pub fn release(&mut self, b: &[f64], x: &mut [f64]) {
        x.copy_from_slice(b);
        self.factor.solve(x);
        self.rows.product(x, &mut self.free);
    }

    /// True if the free motion is within all `bounds`, which are kept.
    pub fn is_free(&mut self, bounds: &[DiskBound]) -> bool {
        self.bounds.copy_from_slice(bounds);
        let Self { blocks, bounds, free, .. } = self;
        blocks.iter().zip(&*bounds).all(|(&block, bound)| match *bound {
            DiskBound::Disk { centre, radius } => distance(block, free, centre) <= radius,
            DiskBound::Strip { normal, lo, hi } => {
                let y = dot(normal, pair(block, free));
                lo <= y && y <= hi
            }
        })
    }

    /// W of a block with another, [yy, yz, zy, zz]; 0 where a block has one row.
    pub fn between(&self, of: usize, by: usize) -> [f64; 4] {
        let m = self.free.len();
        let ((i, rows), (j, columns)) = (self.blocks[of], self.blocks[by]);
        let entry = |a: usize, b: usize| if a < rows && b < columns { self.delassus[(i + a) * m + j + b] } else { 0.0 };
        [entry(0, 0), entry(0, 1), entry(1, 0), entry(1, 1)]
    }

    /// y of a block less the centre of its disk.
    pub fn offset(&self, block: usize) -> [f64; 2] {
        let [y, z] = pair(self.blocks[block], &self.y);
        match self.bounds[block] {
            DiskBound::Disk { centre, .. } => [y - centre[0], z - centre[1]],
            DiskBound::Strip { .. } => [y, z],
        }
    }

    /// The multipliers of a block.
    pub fn push(&self, block: usize) -> [f64; 2] {
        pair(self.blocks[block], &self.r)
    }

    /// Sets the multipliers of a block.
    pub fn set_push(&mut self, block: usize, push: [f64; 2]) {
        let (first, rows) = self.blocks[block];
        self.r[first..first + rows].copy_from_slice(&push[..rows]);
    }

    /// Computes y and the sizes of its terms anew.
    pub fn renew(&mut self) {
        let m = self.free.len();
        let Self { delassus, free, y, r, sizes, .. } = self;
        for i in 0..m {
            let (mut sum, mut size) = (free[i], free[i].abs());
            for (w, r) in delassus[i * m..(i + 1) * m].iter().zip(&*r) {
                sum += w * r;
                size += (w * r).abs();
            }
            (y[i], sizes[i]) = (sum, size);
        }
    }

    /// The size of the terms of a block's distance from its bound.
    pub fn size(&self, block: usize) -> f64 {
        let (first, rows) = self.blocks[block];
        self.sizes[first..first + rows].iter().sum::<f64>() + self.reach(block)
    }

    /// The same without the terms of the multipliers.
    fn least_size(&self, block: usize) -> f64 {
        let [y, z] = pair(self.blocks[block], &self.free);
        y.abs() + z.abs() + self.reach(block)
    }

    /// The size of a block's bound.
    fn reach(&self, block: usize) -> f64 {
        match self.bounds[block] {
            DiskBound::Disk { centre, radius } => centre[0].abs() + centre[1].abs() + radius,
            DiskBound::Strip { lo, hi, .. } => {
                let finite = |x: f64| if x.is_finite() { x.abs() } else { 0.0 };
                finite(lo).max(finite(hi))
            }
        }
    }

    /// Answers a block alone, the multipliers of all others as they are, and updates y.
    pub fn answer(&mut self, block: usize) {
        let (own, old) = (self.between(block, block), self.push(block));
        let [a, b, c, d] = own;
        let offset = self.offset(block);
        let free = [offset[0] - (a * old[0] + b * old[1]), offset[1] - (c * old[0] + d * old[1])];
        let (state, mu, new) = match self.bounds[block] {
            DiskBound::Disk { radius, .. } => circle(own, free, radius),
            DiskBound::Strip { normal, lo, hi } => {
                let compliance = form(own, normal, normal);
                let y = dot(normal, free);
                let (state, bound) = if y < lo {
                    (State::Low, lo)
                } else if y > hi {
                    (State::High, hi)
                } else {
                    (State::Free, y)
                };
                (state, 0.0, normal.map(|n| n * (bound - y) / compliance))
            }
        };
        let new = if state == State::Free { [0.0; 2] } else { new };
        (self.states[block], self.mu[block]) = (state, mu);
        let m = self.free.len();
        let (first, rows) = self.blocks[block];
        for k in 0..rows {
            let change = new[k] - old[k];
            if change != 0.0 {
                // W is symmetric: its rows are its columns.
                let column = &self.delassus[(first + k) * m..(first + k + 1) * m];
                self.y.iter_mut().zip(column).for_each(|(y, w)| *y += w * change);
            }
        }
        self.set_push(block, new);
    }

    /// How far the multipliers are from the solution, with blocks in play as their states say.
    pub fn miss(&self) -> Miss {
        let (mut miss, mut largest) = (Miss { distance: 0.0, rounding: 0.0, share: 0.0 }, f64::MIN_POSITIVE);
        for block in 0..self.blocks.len() {
            let beyond = self.beyond(block);
            let off = match self.states[block] {
                State::Free => beyond.max(0.0),
                State::Circle => beyond.abs().max(self.askew(block)),
                State::Low | State::High => beyond.abs(),
            };
            let size = self.size(block);
            if !(off.is_finite() && size.is_finite()) {
                return Miss { distance: f64::INFINITY, rounding: f64::INFINITY, share: f64::INFINITY };
            }
            let least = self.least_size(block).max(f64::MIN_POSITIVE);
            largest = largest.max(least);
            miss.distance = miss.distance.max(off / least);
            miss.rounding = miss.rounding.max(off / size.max(f64::MIN_POSITIVE));
            miss.share = miss.share.max(off);
        }
        Miss { share: miss.share / largest, ..miss }
    }

    /// The distance of z of a disk from the line of its multiplier.
    fn askew(&self, block: usize) -> f64 {
        let ([y, z], push) = (self.offset(block), self.push(block));
        let size = norm(push);
        if size > 0.0 { (y * push[1] - z * push[0]).abs() / size } else { 0.0 }
    }

    /// How far a block is beyond its bound: of a free one the bound that it is farthest beyond.
    pub fn beyond(&self, block: usize) -> f64 {
        match (self.bounds[block], self.states[block]) {
            (DiskBound::Disk { radius, .. }, _) => norm(self.offset(block)) - radius,
            (DiskBound::Strip { normal, lo, hi }, state) => {
                let y = dot(normal, self.offset(block));
                match state {
                    State::Low => lo - y,
                    State::High => y - hi,
                    _ => (lo - y).max(y - hi),
                }
            }
        }
    }

    /// True if a free block is beyond its bound by more than rounding.
    pub fn is_passed(&self, block: usize) -> bool {
        self.states[block] == State::Free && self.beyond(block) > NOISE * self.size(block)
    }

    /// Adds the motion that the multipliers cause to the free motion `x`.
    pub fn respond(&self, x: &mut [f64]) {
        let n = x.len();
        for (row, &push) in self.r.iter().enumerate().filter(|(_, push)| **push != 0.0) {
            let lift = &self.lift[row * n..(row + 1) * n];
            x.iter_mut().zip(lift).for_each(|(x, lift)| *x += push * lift);
        }
    }
}

/// The state, μ and multipliers of a disk alone; of one row the second entries are 0.
fn circle([a, b, _, d]: [f64; 4], free: [f64; 2], radius: f64) -> (State, f64, [f64; 2]) {
    let size = norm(free);
    if size.is_nan() || size <= radius {
        return (State::Free, 0.0, [0.0; 2]);
    }
    let mu = multiplier([a, b, d], free, radius);
    let below = 1.0 + mu * (a + d + mu * (a * d - b * b).max(0.0));
    let z =
        [(free[0] + mu * (d * free[0] - b * free[1])) / below, (free[1] + mu * (a * free[1] - b * free[0])) / below];
    (State::Circle, mu, z.map(|z| -mu * z))
}

/// aᵀWb of a block.
pub(super) fn form([yy, yz, zy, zz]: [f64; 4], a: [f64; 2], b: [f64; 2]) -> f64 {
    a[0] * (yy * b[0] + yz * b[1]) + a[1] * (zy * b[0] + zz * b[1])
}

/// The entries of a block; 0 for the second of a block of one row.
fn pair((first, rows): (usize, usize), values: &[f64]) -> [f64; 2] {
    [values[first], if rows == 2 { values[first + 1] } else { 0.0 }]
}

fn distance(block: (usize, usize), y: &[f64], centre: [f64; 2]) -> f64 {
    let [y, z] = pair(block, y);
    norm([y - centre[0], z - centre[1]])
}

#[cfg(test)]
mod tests;
