//! Lemke's method for the linear complementarity problem, for few unknowns.
//!
//! w = M z + q,   0 ≤ w ⟂ z ≥ 0
//!
//! Lemke 1965, doi:10.1287/mnsc.11.7.681; Cottle, Pang & Stone 1992, The Linear Complementarity
//! Problem, ch. 4.4. An artificial unknown z₀ is added to every row with a positive weight and
//! driven to zero by exchanging one basic unknown for another; of the rows that block an exchange,
//! the one that is least in the lexicographic order leaves, so that no basis returns where several
//! block at once. The method ends in a solution or in a ray: a direction z̃ ≥ 0 in which w stays
//! ≥ 0 and complementary. For a copositive M a ray has q·z̃ < 0, M z̃ ≥ 0 and z̃·M z̃ = 0: there is
//! none if every z̃ ≥ 0 with the latter two has q·z̃ ≥ 0.

/// A number in the tableau below this, relative to the largest of its column, is rounding.
const PIVOT: f64 = 1e-11;

/// Most exchanges, as a multiple of the number of unknowns.
const MOST: usize = 50;

/// How the method ended.
#[derive(Debug, Clone, PartialEq)]
pub(crate) enum Lemke {
    /// A solution z.
    Solution(Vec<f64>),
    /// The direction z̃ of a ray.
    Ray(Vec<f64>),
    /// Neither in many exchanges: rounding decides.
    Lost,
}

/// The tableau: a row of each basic unknown, a column of each w, each z, z₀, and q.
struct Tableau {
    n: usize,
    width: usize,
    numbers: Vec<f64>,
    /// The basic unknown of each row: w as 0 … n − 1, z from n, z₀ is 2n.
    basis: Vec<usize>,
}

/// Solves for z from `m`, row by row, and `q`, both scaled to numbers near 1, with these weights of
/// z₀. Ratios of rows that differ by less than `equal` are equal.
pub(crate) fn lemke(m: &[f64], q: &[f64], weights: &[f64], equal: f64) -> Lemke {
    let n = q.len();
    let artificial = 2 * n;
    if q.iter().all(|q| *q >= 0.0) {
        return Lemke::Solution(vec![0.0; n]);
    }
    let mut tableau = Tableau::new(m, q, weights);
    // The last of equal rows, which is least in the lexicographic order.
    let ratio = |row: usize| q[row] / weights[row];
    let first = (0..n).fold(0, |least, row| if ratio(row) <= ratio(least) { row } else { least });
    let mut left = tableau.exchange(first, artificial);
    for _ in 0..MOST * n {
        let enters = if left < n { left + n } else { left - n };
        let Some(row) = tableau.leaves(enters, equal) else { return Lemke::Ray(tableau.ray(enters)) };
        left = tableau.exchange(row, enters);
        if left == artificial {
            return Lemke::Solution(tableau.solution());
        }
    }
    Lemke::Lost
}

impl Tableau {
    fn new(m: &[f64], q: &[f64], weights: &[f64]) -> Self {
        let n = q.len();
        let width = 2 * n + 2;
        let mut numbers = vec![0.0; n * width];
        for (i, row) in numbers.chunks_exact_mut(width).enumerate() {
            row[i] = 1.0;
            for (to, m) in row[n..2 * n].iter_mut().zip(&m[i * n..]) {
                *to = -m;
            }
            row[2 * n] = -weights[i];
            row[2 * n + 1] = q[i];
        }
        Self { n, width, numbers, basis: (0..n).collect() }
    }

    fn at(&self, row: usize, column: usize) -> f64 {
        self.numbers[row * self.width + column]
    }

    /// The row whose unknown becomes 0 first as `enters` grows, the least in lexicographic order;
    /// that of z₀ wherever it is among those that block. `None` if none does.
    fn leaves(&self, enters: usize, equal: f64) -> Option<usize> {
        let n = self.n;
        let largest = (0..n).fold(1.0_f64, |most, row| most.max(self.at(row, enters).abs()));
        let blocks = |row: &usize| self.at(*row, enters) > PIVOT * largest;
        let ratio = |row: usize, column: usize| self.at(row, column) / self.at(row, enters);
        let mut rows: Vec<usize> = (0..n).filter(blocks).collect();
        // q first, then the columns of w, which hold the inverse of the basis.
        for column in std::iter::once(2 * n + 1).chain(0..n) {
            if rows.len() <= 1 {
                break;
            }
            let least = rows.iter().fold(f64::INFINITY, |least, &row| least.min(ratio(row, column)));
            rows.retain(|&row| ratio(row, column) <= least + equal * (1.0 + least.abs()));
            if let Some(&row) = rows.iter().find(|row| self.basis[**row] == 2 * n) {
                return Some(row);
            }
        }
        rows.first().copied()
    }

    /// Exchanges the basic unknown of `row` for `enters`; returns the one that left.
    fn exchange(&mut self, row: usize, enters: usize) -> usize {
        let width = self.width;
        let pivot = self.at(row, enters);
        let mut own = self.numbers[row * width..(row + 1) * width].to_vec();
        own.iter_mut().for_each(|x| *x /= pivot);
        own[enters] = 1.0;
        for (i, other) in self.numbers.chunks_exact_mut(width).enumerate() {
            let factor = other[enters];
            if i == row {
                other.copy_from_slice(&own);
            } else if factor != 0.0 {
                other.iter_mut().zip(&own).for_each(|(x, own)| *x -= factor * own);
                other[enters] = 0.0;
            }
        }
        std::mem::replace(&mut self.basis[row], enters)
    }

    fn solution(&self) -> Vec<f64> {
        self.z(|tableau, row| tableau.at(row, tableau.width - 1))
    }

    fn ray(&self, enters: usize) -> Vec<f64> {
        let mut z = self.z(|tableau, row| -tableau.at(row, enters));
        if let Some(own) = enters.checked_sub(self.n) {
            z[own] = 1.0;
        }
        z
    }

    /// z of what is in the basis, at least 0.
    fn z(&self, value: impl Fn(&Self, usize) -> f64) -> Vec<f64> {
        let mut z = vec![0.0; self.n];
        for (row, &unknown) in self.basis.iter().enumerate() {
            if (self.n..2 * self.n).contains(&unknown) {
                z[unknown - self.n] = value(self, row).max(0.0);
            }
        }
        z
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_solution_of_small_problems_is_the_known_one() {
        // Nothing to do; one unknown; two of two unknowns.
        assert_eq!(lemke(&[1.0], &[2.0], &[1.0], 1e-12), Lemke::Solution(vec![0.0]));
        assert_eq!(lemke(&[2.0], &[-1.0], &[1.0], 1e-12), Lemke::Solution(vec![0.5]));
        let one = lemke(&[1.0, 0.0, 2.0, 1.0], &[-1.0, -1.0], &[1.0, 1.0], 1e-12);
        assert_eq!(one, Lemke::Solution(vec![1.0, 0.0]));
        let Lemke::Solution(z) = lemke(&[2.0, 1.0, 1.0, 2.0], &[-5.0, -6.0], &[1.0, 1.0], 1e-12) else {
            panic!("a ray")
        };
        assert!((z[0] - 4.0 / 3.0).abs() < 1e-15 && (z[1] - 7.0 / 3.0).abs() < 1e-15, "{z:?}");
    }

    #[test]
    fn a_problem_without_a_solution_ends_in_a_ray_that_contradicts_it() {
        // w₁ = z₁ − z₂ − 1 and w₂ = z₂ − z₁ − 1 have the sum −2.
        let Lemke::Ray(z) = lemke(&[1.0, -1.0, -1.0, 1.0], &[-1.0, -1.0], &[1.0, 1.0], 1e-12) else {
            panic!("a solution")
        };
        assert!(z[0] == z[1] && z[0] > 0.0, "{z:?}");
    }

    #[test]
    fn equal_rows_that_block_together_do_not_make_the_method_go_round() {
        // n equal rows, any of which may carry the whole: Σz = 1.
        for n in 2..12 {
            let Lemke::Solution(z) = lemke(&vec![1.0; n * n], &vec![-1.0; n], &vec![1.0; n], 1e-12) else {
                panic!("{n}")
            };
            assert!((z.iter().sum::<f64>() - 1.0).abs() < 1e-15, "{z:?}");
        }
    }
}
