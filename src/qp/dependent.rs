//! Square systems whose rows may depend on one another, by elimination with complete pivoting.

/// A pivot below this belongs to rows that depend on those before; the diagonal of the matrix is
/// near 1.
const DEPENDENT: f64 = 1e-11;

/// Solves the system of `matrix`, row by row with the right-hand side as last column, which the
/// solution replaces; `order` is room for the order of its columns. Unknowns left over at pivots
/// that are rounding are 0.
pub(crate) fn solve_dependent(matrix: &mut [f64], order: &mut Vec<usize>) {
    let a = matrix;
    let m = a.len().isqrt();
    let width = m + 1;
    order.clear();
    order.extend(0..m);
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
        order.swap(rank, column);
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
    for (k, &place) in order.iter().enumerate() {
        a[place * width + m] = a[k * width + k];
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
        let mut matrix = matrix.to_vec();
        solve_dependent(&mut matrix, &mut Vec::new());
        (0..m).map(|k| matrix[k * (m + 1) + m]).collect()
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
