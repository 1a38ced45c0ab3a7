//! The linear system of the contacts of a step whose states are known.

use super::places::Places;
use super::touch::{State, Touch};

/// Most states that are tried after one another between sweeps.
const MOST_GUESSES: u32 = 8;

/// A pivot below this share of the diagonal, which is scaled to 1, belongs to contacts whose rows
/// depend on those before: their impulses stay as the sweeps left them, and the result is accepted
/// only if it meets their bounds too.
const DEPENDENT: f64 = 1e-11;

/// The linear system of contacts whose states are known.
#[derive(Debug, Default)]
pub(super) struct Linear {
    /// The unknowns: contact, and whether the unknown is f rather than p; and the factor that
    /// scales each, 1/√(its own response).
    unknowns: Vec<(usize, bool)>,
    scale: Vec<f64>,
    /// The matrix, row by row, with the right-hand side as its last column, and the order of the
    /// columns.
    matrix: Vec<f64>,
    order: Vec<usize>,
    kept: Vec<(State, [f64; 2])>,
}

impl Linear {
    pub fn with_capacity(unknowns: usize) -> Self {
        Self {
            unknowns: Vec::with_capacity(unknowns),
            scale: Vec::with_capacity(unknowns),
            matrix: Vec::with_capacity(unknowns * (unknowns + 1)),
            order: Vec::with_capacity(unknowns),
            kept: Vec::with_capacity(unknowns),
        }
    }

    /// Solves for the impulses of contacts in the states that they have. If the result does not
    /// confirm these states within `noise` (m/s), tries the states that it suggests, some times; if
    /// none is confirmed, all stays as it is.
    pub fn settle(
        &mut self,
        places: &Places,
        touches: &mut [Touch],
        (free, y): (&[f64], &mut [f64]),
        noise: f64,
    ) -> bool {
        self.kept.clear();
        self.kept.extend(touches.iter().map(|touch| (touch.state, touch.impulse)));
        for _ in 0..MOST_GUESSES {
            self.solve(places, touches, (free, y));
            if touches.iter().all(|touch| touch.holds(y, noise)) {
                // A force of −1e-20 N is none.
                for touch in touches.iter_mut().filter(|touch| touch.impulse[0] < 0.0) {
                    touch.impulse = [0.0; 2];
                }
                return true;
            }
            let mut changed = false;
            for touch in touches.iter_mut() {
                let state = touch.guess(y);
                changed |= state != touch.state;
                touch.state = state;
                touch.comply();
            }
            if !changed {
                break;
            }
        }
        for (touch, kept) in touches.iter_mut().zip(&self.kept) {
            (touch.state, touch.impulse) = *kept;
        }
        renew(places, touches, free, y);
        false
    }

    /// Solves for the impulses of contacts in the states that they have.
    pub fn solve(&mut self, places: &Places, touches: &mut [Touch], (free, y): (&[f64], &mut [f64])) {
        renew(places, touches, free, y);
        self.set(places, touches, y);
        self.eliminate();
        let m = self.unknowns.len();
        for (k, &(index, rubs)) in self.unknowns.iter().enumerate() {
            let change = self.matrix[k * (m + 1) + m] * self.scale[k];
            touches[index].impulse[usize::from(rubs)] += change;
        }
        touches.iter_mut().for_each(Touch::comply);
        renew(places, touches, free, y);
    }

    /// Sets up the system for the changes of the impulses: one row for n·ẇ⁺ − κp = β of each
    /// contact that is not open, one for t·ẇ⁺ = 0 of each that sticks.
    fn set(&mut self, places: &Places, touches: &[Touch], y: &[f64]) {
        self.unknowns.clear();
        self.scale.clear();
        for (index, touch) in touches.iter().enumerate().filter(|(_, touch)| touch.state != State::Open) {
            self.unknowns.push((index, false));
            self.scale.push(1.0 / touch.own[0].sqrt());
            if touch.state == State::Stick {
                self.unknowns.push((index, true));
                self.scale.push(1.0 / touch.own[2].sqrt());
            }
        }
        self.matrix.clear();
        for (&(to, rubbed), scale) in self.unknowns.iter().zip(&self.scale) {
            let touch = &touches[to];
            // The direction of the velocity, so that the diagonal is positive.
            let along = if rubbed { touch.tangent } else { touch.normal.map(|n| -n) };
            for (&(from, rubs), other) in self.unknowns.iter().zip(&self.scale) {
                let source = &touches[from];
                let push = if rubs { [0.0, 1.0] } else { [1.0, -source.state.sign() * source.friction] };
                let mut entry = places.between((touch.rows, along), (source.rows, source.push(push)));
                if from == to && !rubs && !rubbed {
                    entry += touch.compliance;
                }
                self.matrix.push(entry * scale * other);
            }
            let [n, t] = touch.excess(y);
            self.matrix.push(scale * if rubbed { -t } else { n });
        }
    }

    /// Solves the system by elimination with complete pivoting; the solution replaces the
    /// right-hand side. Unknowns left over at pivots that are rounding do not change.
    fn eliminate(&mut self) {
        let m = self.unknowns.len();
        let width = m + 1;
        let a = &mut self.matrix;
        self.order.clear();
        self.order.extend(0..m);
        let mut rank = 0;
        while rank < m {
            let mut best = (0.0, rank, rank);
            for row in rank..m {
                for column in rank..m {
                    let size = a[row * width + column].abs();
                    if size > best.0 {
                        best = (size, row, column);
                    }
                }
            }
            let (size, row, column) = best;
            if size <= DEPENDENT {
                break;
            }
            for k in 0..width {
                a.swap(rank * width + k, row * width + k);
            }
            for k in 0..m {
                a.swap(k * width + rank, k * width + column);
            }
            self.order.swap(rank, column);
            let pivot = a[rank * width + rank];
            for row in rank + 1..m {
                let factor = a[row * width + rank] / pivot;
                if factor != 0.0 {
                    for k in rank..width {
                        a[row * width + k] -= factor * a[rank * width + k];
                    }
                }
            }
            rank += 1;
        }
        // Back substitution; the solution in the order of the columns, in the diagonal.
        for k in (0..m).rev() {
            let mut x = 0.0;
            if k < rank {
                x = a[k * width + m];
                for j in k + 1..rank {
                    x -= a[k * width + j] * a[j * width + j];
                }
                x /= a[k * width + k];
            }
            a[k * width + k] = x;
        }
        for (k, &place) in self.order.iter().enumerate() {
            a[place * width + m] = a[k * width + k];
        }
    }
}

/// Computes the velocities of all rows anew from those without contacts.
pub(super) fn renew(places: &Places, touches: &[Touch], free: &[f64], y: &mut [f64]) {
    y.copy_from_slice(free);
    for touch in touches {
        places.add(touch.rows, touch.push(touch.impulse), y);
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::hash::{mix, unit};

    /// Random numbers from −1 to 1.
    fn number(seed: u64, index: usize) -> f64 {
        2.0 * unit(mix(seed, 0, index as u64)) - 1.0
    }

    /// Solves A x = b, both given row by row with b last.
    fn solved(m: usize, matrix: &[f64]) -> Vec<f64> {
        let mut linear = Linear { unknowns: vec![(0, false); m], matrix: matrix.to_vec(), ..Linear::default() };
        linear.eliminate();
        (0..m).map(|k| linear.matrix[k * (m + 1) + m]).collect()
    }

    #[test]
    fn elimination_solves_systems_of_full_rank_and_dependent_ones_that_agree() {
        for seed in 0..60 {
            let m = 1 + seed as usize % 7;
            // Products of m × rank matrices have that rank; b = A x agrees with every dependence.
            for rank in 1..=m {
                let factor = |i: usize, j: usize, side: usize| number(seed, (i * m + j) * 2 + side);
                let entry = |i: usize, j: usize| -> f64 { (0..rank).map(|k| factor(i, k, 0) * factor(j, k, 1)).sum() };
                let x: Vec<f64> = (0..m).map(|j| number(seed + 1000, j)).collect();
                let row = |i: usize| (0..m).map(move |j| entry(i, j));
                let b: Vec<f64> = (0..m).map(|i| row(i).zip(&x).map(|(a, x)| a * x).sum()).collect();
                let matrix: Vec<f64> = (0..m).flat_map(|i| row(i).chain([b[i]])).collect();
                let found = solved(m, &matrix);
                for (i, b) in b.iter().enumerate() {
                    let got: f64 = row(i).zip(&found).map(|(a, x)| a * x).sum();
                    // Pivots down to the limit of dependence, 1e-11, leave five digits.
                    assert!((got - b).abs() < 1e-5, "seed {seed}, {m} rows, rank {rank}: {got} for {b}");
                }
                // What depends on others stays unchanged.
                let unchanged = found.iter().filter(|x| **x == 0.0).count();
                assert_eq!(unchanged, m - rank, "seed {seed}, {m} rows, rank {rank}: {found:?}");
            }
        }
        assert_eq!(solved(2, &[0.0, 2.0, 6.0, 4.0, 0.0, 2.0]), [0.5, 3.0]);
        assert_eq!(solved(2, &[1e-12, 0.0, 1.0, 0.0, 1.0, 2.0]), [0.0, 2.0]);
    }
}
