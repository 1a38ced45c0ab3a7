//! Viscous damping of a structure.

use super::Structure;
use super::modal::{MOST_DENSE, Modes};
use super::structure::of_size;
use super::system::{above_minus_one, nonnegative};
use crate::error::{Error, Result, Subject};
use crate::linear::Symmetric;
use crate::order::sort_by_number;
use nalgebra::DMatrix;
use serde::{Deserialize, Serialize};

/// Viscous damping: how C follows from M and K.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[non_exhaustive]
pub enum Damping {
    /// C = 0.
    None,
    /// Rayleigh damping C = α M + β K: mode i has ζᵢ = α/2ωᵢ + β ωᵢ/2.
    Rayleigh {
        /// α, 1/s; 0 or more. It also damps rigid-body motions.
        mass: f64,
        /// β, s; 0 or more.
        stiffness: f64,
    },
    /// C = M Φ diag(2 ζᵢ ωᵢ) Φᵀ M with the M-orthonormal modes Φ, slowest first: one ratio ζ per
    /// mode; the last one holds for all further modes. Rigid-body motions are not damped. C is a
    /// full matrix (where the modes are not the coordinates), so a structure beyond [`MOST_DENSE`]
    /// degrees of freedom must be reduced to modes first. Where the modes are the coordinates, a
    /// ratio may be negative, above −1: a flow that feeds energy into a mode makes it unstable, and
    /// only walls limit its motion.
    Modal(Vec<f64>),
    /// The matrix C, N s/m.
    Matrix(Symmetric),
}

impl Damping {
    /// C for the M and K of `structure`.
    ///
    /// # Errors
    /// [`Error::Invalid`] under the damping's `mass`, `stiffness`, `ratios` or `matrix`; for a K
    /// that has another size than M; where modal ratios meet a structure too large; or the errors
    /// of [`Modes::lowest`].
    pub fn matrix(&self, structure: &Structure) -> Result<Symmetric> {
        let n = structure.mass.size();
        of_size("stiffness", &structure.stiffness, n)?;
        match self {
            Self::None => Ok(Symmetric::zeros(n)),
            Self::Rayleigh { mass, stiffness } => {
                nonnegative(("damping", "mass"), *mass)?;
                nonnegative(("damping", "stiffness"), *stiffness)?;
                Ok(Symmetric::sum(&[(*mass, &structure.mass), (*stiffness, &structure.stiffness)]))
            }
            Self::Modal(ratios) => modal(ratios, structure),
            Self::Matrix(matrix) if matrix.size() == n => Ok(matrix.clone()),
            Self::Matrix(matrix) => {
                let expected = format!("{n} × {n}, as the mass matrix");
                Err(Error::invalid(("damping", "matrix"), format!("{0} × {0}", matrix.size()), expected))
            }
        }
    }
}

impl Structure {
    /// The structure with C from `damping`, in place of the C it has.
    ///
    /// # Errors
    /// As [`Damping::matrix`].
    pub fn with_damping(mut self, damping: &Damping) -> Result<Self> {
        self.damping = damping.matrix(&self)?;
        Ok(self)
    }
}

fn modal(ratios: &[f64], structure: &Structure) -> Result<Symmetric> {
    let Some(&last) = ratios.last() else {
        return Err(Error::invalid(("damping", "ratios"), "an empty list", "one ratio or more"));
    };
    // The modes are uncoupled already, as after a modal reduction: C is diagonal too, for any n.
    let uncoupled = structure.mass.half_bandwidth() == 0 && structure.stiffness.half_bandwidth() == 0;
    for (i, &ratio) in ratios.iter().enumerate() {
        let key = Subject::from(("damping", "ratios")).value(i);
        if uncoupled {
            above_minus_one(key, ratio)?;
        } else if ratio < 0.0 {
            let expected = "0 or more, or a structure cut to modes: negative ratios are for uncoupled modes";
            return Err(Error::invalid(key, format_args!("{ratio:?}"), expected));
        } else {
            nonnegative(key, ratio)?;
        }
    }
    let ratio = |i: usize| ratios.get(i).copied().unwrap_or(last);
    let n = structure.mass.size();
    if uncoupled {
        let (m, k) = (structure.mass.diagonal_entries(), structure.stiffness.diagonal_entries());
        let mut order: Vec<usize> = (0..n).collect();
        sort_by_number(&mut order, |&a| k[a] / m[a]);
        let mut c = vec![0.0; n];
        order.into_iter().enumerate().for_each(|(rank, i)| c[i] = 2.0 * ratio(rank) * (k[i] * m[i]).sqrt());
        return Ok(Symmetric::diagonal(&c));
    }
    if n > MOST_DENSE {
        let expected = format!(
            "at most {MOST_DENSE}: modal ratios make C full; cut the structure to modes, or give Rayleigh coefficients"
        );
        return Err(Error::invalid(("damping", "ratios"), format!("for {n} degrees of freedom"), expected));
    }
    let modes = Modes::lowest(structure, n)?;
    // Columns √(2ζω) M φ: C is the product of this matrix with its transpose, hence exactly
    // symmetric and semidefinite.
    let mut columns = DMatrix::zeros(n, n);
    for (i, (omega, shape)) in modes.omega.iter().zip(&modes.shapes).enumerate() {
        let mut column = vec![0.0; n];
        structure.mass.add_product((2.0 * ratio(i) * omega).sqrt(), shape, &mut column);
        columns.column_mut(i).copy_from_slice(&column);
    }
    let c = &columns * columns.transpose();
    Ok(Symmetric::from_entries(n, (0..n).flat_map(|i| (0..=i).map(move |j| (i, j))).map(|(i, j)| (i, j, c[(i, j)]))))
}
