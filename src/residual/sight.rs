//! How a wall sees the structure: its row ready for a product, and whether it is out of all reach.

use crate::scene::Wall;

/// A row is kept with the zeros between its entries if that is at most this many times as long.
const FILL: usize = 4;

/// One wall.
#[derive(Debug, Clone)]
pub(super) struct Sight {
    /// First degree of freedom of the row and what follows it, zeros included; empty where the row is
    /// too long for that.
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

    /// True if the wall is rigid and both ends of a step, and whatever its first velocity reaches in `way` seconds before and after
    /// the first of them, are further than `touch` (m) before the wall: it then has no say in the step.
    #[inline(always)]
    pub fn is_clear(&self, (w0, w1): (f64, f64), rate: f64, way: f64, touch: f64) -> bool {
        let gap = |w: f64| self.sign * (w - self.position);
        self.rigid && gap(w0) - way * rate.abs() > touch && gap(w1) > touch
    }
}

/// a · b by four sums that do not wait for one another.
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
