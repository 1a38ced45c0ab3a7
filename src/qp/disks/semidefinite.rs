//! Dense symmetric systems that may be singular, by Cholesky's method with the largest pivot first.

/// A pivot below this share of its diagonal entry, which is scaled to 1, is rounding: its unknown
/// depends on those before, and stays 0.
const DEPENDENT: f64 = 1e-13;

/// S = L Lᵀ of a positive semidefinite matrix, in the order of its pivots.
#[derive(Debug, Default)]
pub(super) struct Semidefinite {
    /// S, then L below its diagonal, row by row.
    pub entries: Vec<f64>,
    n: usize,
    rank: usize,
    order: Vec<usize>,
    /// 1/√Sᵢᵢ.
    scale: Vec<f64>,
    room: Vec<f64>,
}

impl Semidefinite {
    /// Begins an n × n matrix of zeros, whose `entries` the caller writes.
    pub fn begin(&mut self, n: usize) {
        self.n = n;
        self.entries.clear();
        self.entries.resize(n * n, 0.0);
    }

    /// Factors what was written.
    pub fn factor(&mut self) {
        let Self { entries: s, n, order, scale, .. } = self;
        let n = *n;
        scale.clear();
        scale.extend((0..n).map(|i| if s[i * n + i] > 0.0 { 1.0 / s[i * n + i].sqrt() } else { 0.0 }));
        for i in 0..n {
            for j in 0..n {
                s[i * n + j] *= scale[i] * scale[j];
            }
        }
        order.clear();
        order.extend(0..n);
        self.rank = n;
        for k in 0..n {
            let (mut best, mut size) = (k, s[k * n + k]);
            for i in k + 1..n {
                if s[i * n + i] > size {
                    (best, size) = (i, s[i * n + i]);
                }
            }
            if size.is_nan() || size <= DEPENDENT {
                self.rank = k;
                break;
            }
            if best != k {
                order.swap(k, best);
                for j in 0..n {
                    s.swap(k * n + j, best * n + j);
                }
                for i in 0..n {
                    s.swap(i * n + k, i * n + best);
                }
            }
            let pivot = s[k * n + k].sqrt();
            s[k * n + k] = pivot;
            for i in k + 1..n {
                s[i * n + k] /= pivot;
            }
            for i in k + 1..n {
                let left = s[i * n + k];
                if left != 0.0 {
                    for j in k + 1..=i {
                        s[i * n + j] -= left * s[j * n + k];
                        s[j * n + i] = s[i * n + j];
                    }
                }
            }
        }
    }

    /// Solves S x = b in place; 0 for the unknowns that depend on others.
    pub fn solve(&mut self, x: &mut [f64]) {
        let Self { entries: l, n, rank, order, scale, room } = self;
        let (n, rank) = (*n, *rank);
        room.clear();
        room.extend(order[..rank].iter().map(|&i| x[i] * scale[i]));
        for k in 0..rank {
            let known: f64 = (0..k).map(|j| l[k * n + j] * room[j]).sum();
            room[k] = (room[k] - known) / l[k * n + k];
        }
        for k in (0..rank).rev() {
            let known: f64 = (k + 1..rank).map(|i| l[i * n + k] * room[i]).sum();
            room[k] = (room[k] - known) / l[k * n + k];
        }
        x.fill(0.0);
        for (&i, value) in order[..rank].iter().zip(&*room) {
            x[i] = value * scale[i];
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn factored(n: usize, entries: &[f64]) -> Semidefinite {
        let mut s = Semidefinite::default();
        s.begin(n);
        s.entries.copy_from_slice(entries);
        s.factor();
        s
    }

    #[test]
    fn a_definite_system_is_solved_and_a_singular_one_by_independent_unknowns() {
        // [[4, 2, 0], [2, 5, 3], [0, 3, 6]] (1, −2, 3) = (0, 1, 12).
        let mut x = [0.0, 1.0, 12.0];
        factored(3, &[4.0, 2.0, 0.0, 2.0, 5.0, 3.0, 0.0, 3.0, 6.0]).solve(&mut x);
        for (found, exact) in x.iter().zip([1.0, -2.0, 3.0]) {
            assert!((found - exact).abs() < 1e-14, "{x:?}");
        }
        // Of three rows of rank 2, S = G Gᵀ with G = (1, 0), (0, 2), (1, 2): any solution will do.
        let s = [1.0, 0.0, 1.0, 0.0, 4.0, 4.0, 1.0, 4.0, 5.0];
        let (b, mut x) = ([3.0, 8.0, 11.0], [3.0, 8.0, 11.0]);
        factored(3, &s).solve(&mut x);
        for i in 0..3 {
            let sum: f64 = (0..3).map(|j| s[3 * i + j] * x[j]).sum();
            assert!((sum - b[i]).abs() < 1e-13, "{x:?}");
        }
        assert_eq!(x.iter().filter(|x| **x == 0.0).count(), 1, "{x:?}");
    }

    #[test]
    fn an_unknown_that_repeats_another_or_has_no_stiffness_stays_still_wherever_it_stands() {
        // Each order of the unknowns u, u, v, v and one without stiffness: S = G Gᵀ with the rows
        // g_u = (2, 0) and g_v = (1, 3).
        let kinds = [Some([2.0, 0.0]), Some([2.0, 0.0]), Some([1.0, 3.0]), Some([1.0, 3.0]), None];
        for turn in 0..5 {
            for flip in [false, true] {
                let place =
                    |i: usize| kinds[if flip { (9 + turn - i) % 5 } else { (i + turn) % 5 }].unwrap_or([0.0; 2]);
                let s: Vec<f64> =
                    (0..25).map(|at| (place(at / 5), place(at % 5))).map(|(a, b)| a[0] * b[0] + a[1] * b[1]).collect();
                // b = G (5, −7).
                let b: Vec<f64> = (0..5).map(|i| 5.0 * place(i)[0] - 7.0 * place(i)[1]).collect();
                let mut x = b.clone();
                factored(5, &s).solve(&mut x);
                for (i, b) in b.iter().enumerate() {
                    let sum: f64 = (0..5).map(|j| s[5 * i + j] * x[j]).sum();
                    // Some roundings of numbers up to 16.
                    assert!((sum - b).abs() < 1e-13, "{turn}, {flip}: {x:?}");
                }
                assert_eq!(x.iter().filter(|x| **x == 0.0).count(), 3, "{turn}, {flip}: {x:?}");
            }
        }
    }
}
