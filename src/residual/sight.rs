//! A wall's row, prepared for products, and a test whether the wall is out of reach in a step.

use crate::scene::Wall;

/// A row is stored with the zeros between its entries if that makes it at most this many times as
/// long.
const FILL: usize = 4;

/// One wall.
#[derive(Debug, Clone)]
pub(super) struct Sight {
    /// First degree of freedom of the row, and its values from there on, zeros included; empty
    /// where the row would be too long.
    first: usize,
    run: Vec<f64>,
    /// +1 of a lower wall, −1 of an upper one.
    sign: f64,
    position: f64,
    rigid: bool,
}

impl Sight {
    pub fn new(wall: &Wall) -> Self {
        let entries = wall.at.entries();
        let first = entries.iter().map(|entry| entry.0).min().unwrap_or(0);
        let length = entries.iter().map(|entry| entry.0 + 1 - first).max().unwrap_or(0);
        let mut run = if length <= FILL * entries.len() { vec![0.0; length] } else { Vec::new() };
        for &(i, weight) in entries {
            if let Some(sum) = run.get_mut(i - first) {
                *sum += weight;
            }
        }
        Self { first, run, sign: wall.side.sign(), position: wall.position, rigid: wall.law.is_rigid() }
    }

    /// The row times `x`.
    #[inline(always)]
    pub fn of(&self, wall: &Wall, x: &[f64]) -> f64 {
        match (&self.run[..], x.get(self.first..self.first + self.run.len())) {
            (&[weight], Some(&[x])) => weight * x,
            ([], _) | (_, None) => wall.at.dot(x),
            (run, Some(x)) => dot(run, x),
        }
    }

    /// True if the wall is rigid and cannot matter in the step: more than `touch` (m) away from the
    /// displacements at both ends of the step, and from all that the body can reach from the first
    /// with speed `rate` in `way` seconds.
    #[inline(always)]
    pub fn is_clear(&self, (w0, w1): (f64, f64), rate: f64, way: f64, touch: f64) -> bool {
        let gap = |w: f64| self.sign * (w - self.position);
        self.rigid && gap(w0) - way * rate.abs() > touch && gap(w1) > touch
    }
}

/// a · b in four independent sums, so that their additions overlap.
#[inline]
fn dot(a: &[f64], b: &[f64]) -> f64 {
    let (mut a, mut b) = (a.chunks_exact(4), b.chunks_exact(4));
    let mut sums = [0.0; 4];
    for (a, b) in a.by_ref().zip(b.by_ref()) {
        for (sum, (a, b)) in sums.iter_mut().zip(a.iter().zip(b)) {
            *sum += a * b;
        }
    }
    let rest: f64 = a.remainder().iter().zip(b.remainder()).map(|(a, b)| a * b).sum();
    (sums[0] + sums[1]) + (sums[2] + sums[3]) + rest
}
