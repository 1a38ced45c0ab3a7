//! Whether damping couples the modes.

use super::dense::{congruent, eigen};
use super::modes::{MOST_DENSE, Modes};
use crate::linear::Symmetric;
use crate::scene::Structure;
use nalgebra::DMatrix;

/// Damping is classical if the terms that couple modes are below this share of those that damp
/// them.
const CLASSICAL: f64 = 1e-10;
/// … or if they are rounding, below this share of the strongest damping of any mode.
const ROUNDING: f64 = 1e-13;
/// Relative tolerance, in ‖C̃‖ ‖K̃‖, between C M⁻¹ K and its transpose; rounding of the products is
/// some 1e-14.
const COMMUTES: f64 = 1e-12;
/// Frequencies within this relative distance count as equal: their shapes may be rotated among
/// themselves.
const EQUAL: f64 = 1e-9;

impl Structure {
    /// True if one basis of modes makes M, C and K diagonal (classical damping): C M⁻¹ K is
    /// symmetric (Caughey & O'Kelly 1965, doi 10.1115/1.3627262).
    ///
    /// C = 0, matrices that are all diagonal, and C = αM + βK are recognised for any size; any
    /// other C up to [`MOST_DENSE`] degrees of freedom, beyond which the answer is no.
    #[must_use]
    pub fn is_classically_damped(&self) -> bool {
        let n = self.mass.size();
        let diagonal = [&self.mass, &self.damping, &self.stiffness].iter().all(|m| m.half_bandwidth() == 0);
        if diagonal || self.damping.entries().all(|entry| entry.2 == 0.0) || self.rayleigh().is_some() {
            return true;
        }
        if n > MOST_DENSE {
            return false;
        }
        let (Ok((c, _)), Ok((k, _))) = (congruent(&self.mass, &self.damping), congruent(&self.mass, &self.stiffness))
        else {
            return false;
        };
        let product = &c * &k;
        (&product - product.transpose()).norm() <= COMMUTES * c.norm() * k.norm()
    }

    /// (α, β) with C = αM + βK, entry by entry to 1e-12 of the terms; `None` if C is no such sum.
    /// The smaller of the two terms is known only as far as the rounding of C allows: on a fine
    /// mesh βK may hide α.
    #[must_use]
    pub fn rayleigh(&self) -> Option<(f64, f64)> {
        let m = self.mass.diagonal_entries();
        let n = m.len();
        if self.damping.size() != n || self.stiffness.size() != n || m.iter().any(|m| m.is_nan() || *m <= 0.0) {
            return None;
        }
        // Least squares with every entry over √(mᵢᵢ mⱼⱼ), so that the units of the degrees of
        // freedom do not matter, and each matrix over its largest entry.
        let weigh = |(i, j, value): (usize, usize, f64)| value / (m[i].sqrt() * m[j].sqrt());
        let largest = |matrix: &Symmetric| {
            let largest = matrix.entries().map(|entry| weigh(entry).abs()).fold(0.0, f64::max);
            if largest > 0.0 { largest } else { 1.0 }
        };
        let (unit_k, unit_c) = (largest(&self.stiffness), largest(&self.damping));
        let inner = |(a, unit_a): (&Symmetric, f64), (b, unit_b): (&Symmetric, f64)| {
            let mut b = b.entries().peekable();
            let mut sum = 0.0;
            for entry in a.entries() {
                while b.peek().is_some_and(|other| (other.0, other.1) < (entry.0, entry.1)) {
                    b.next();
                }
                if let Some(other) = b.peek().filter(|other| (other.0, other.1) == (entry.0, entry.1)) {
                    sum += (weigh(entry) / unit_a) * (weigh(*other) / unit_b);
                }
            }
            sum
        };
        let (mass, stiffness) = ((&self.mass, 1.0), (&self.stiffness, unit_k));
        let (mm, mk, kk) = (inner(mass, mass), inner(mass, stiffness), inner(stiffness, stiffness));
        let determinant = mm * kk - mk * mk;
        let (mut alpha, mut beta) = (0.0, 0.0);
        let mut left = self.damping.clone();
        // A second pass fits the residual that the rounding of long sums left in the first.
        for _ in 0..2 {
            let (mc, kc) = (inner(mass, (&left, unit_c)), inner(stiffness, (&left, unit_c)));
            // K is proportional to M, as for one degree of freedom: αM alone is enough.
            if determinant > 1e-12 * mm * kk {
                alpha += unit_c * ((mc * kk - kc * mk) / determinant);
                beta += unit_c / unit_k * ((kc * mm - mc * mk) / determinant);
            } else {
                alpha += unit_c * (mc / mm);
            }
            left = Symmetric::sum(&[(1.0, &self.damping), (-alpha, &self.mass), (-beta, &self.stiffness)]);
        }
        let diagonal = self.stiffness.diagonal_entries();
        let size = |i: usize, j: usize| {
            let term =
                |factor: f64, diagonal: &[f64]| factor.abs() * (diagonal[i].abs().sqrt() * diagonal[j].abs().sqrt());
            term(alpha, &m) + term(beta, &diagonal)
        };
        left.entries().all(|(i, j, value)| value.abs() <= 1e-12 * size(i, j)).then_some((alpha, beta))
    }
}

impl Modes {
    /// The damping of each mode, φᵀCφ = 2ζω (1/s), if C couples no modes: off the diagonal ΦᵀCΦ is
    /// at most 1e-10 of √(diagonal · diagonal). Shapes of equal ω are rotated among themselves to
    /// achieve this. `None` if C couples modes, or is of another size than the shapes; the shapes
    /// are then unchanged.
    #[must_use]
    pub fn uncouple(&mut self, damping: &Symmetric) -> Option<Vec<f64>> {
        let k = self.count();
        if self.shapes.len() != k || self.shapes.iter().any(|shape| shape.len() != damping.size()) {
            return None;
        }
        let c = self.project(damping);
        let strongest = c.diagonal().iter().fold(0.0_f64, |a, x| a.max(x.abs()));
        let coupled = |c: &DMatrix<f64>, i: usize, j: usize| {
            let bound = CLASSICAL * (c[(i, i)] * c[(j, j)]).max(0.0).sqrt() + ROUNDING * strongest;
            c[(i, j)].abs() > bound
        };
        let fastest = self.omega.last().copied().unwrap_or(0.0);
        let mut turned = self.shapes.clone();
        let mut from = 0;
        while from < k {
            let mut to = from + 1;
            while to < k && self.omega[to] - self.omega[to - 1] <= EQUAL * self.omega[to].max(1e-6 * fastest) {
                to += 1;
            }
            // Shapes that are uncoupled already stay as they are: where C is equal for all of them
            // any rotation would do, and would mix shapes of slightly different ω.
            if (from..to).any(|i| (from..i).any(|j| coupled(&c, i, j))) {
                let block = c.view((from, from), (to - from, to - from)).into_owned();
                let (_, turn) = eigen(block)?;
                for j in from..to {
                    let mut shape = vec![0.0; turned[j].len()];
                    for i in from..to {
                        let y = turn[(i - from, j - from)];
                        shape.iter_mut().zip(&self.shapes[i]).for_each(|(s, x)| *s += y * x);
                    }
                    turned[j] = shape;
                }
            }
            from = to;
        }
        let before = std::mem::replace(&mut self.shapes, turned);
        let c = self.project(damping);
        if (0..k).any(|i| (0..i).any(|j| coupled(&c, i, j))) {
            self.shapes = before;
            return None;
        }
        Some(c.diagonal().iter().map(|x| x.max(0.0)).collect())
    }

    /// Φᵀ A Φ, k × k.
    pub(super) fn project(&self, matrix: &Symmetric) -> DMatrix<f64> {
        let k = self.count();
        let mut out = DMatrix::zeros(k, k);
        let mut product = vec![0.0; matrix.size()];
        for j in 0..k {
            product.fill(0.0);
            matrix.add_product(1.0, &self.shapes[j], &mut product);
            for i in 0..=j {
                let form: f64 = self.shapes[i].iter().zip(&product).map(|(a, b)| a * b).sum();
                (out[(i, j)], out[(j, i)]) = (form, form);
            }
        }
        out
    }
}
