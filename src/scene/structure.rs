//! A structure by its matrices.

use crate::error::{Error, Result};
use crate::linear::{Factor, Symmetric};

/// M q̈ + C q̇ + K q = f by matrices, all n × n: M symmetric positive definite (kg), C (N s/m) and K (N/m) symmetric positive semidefinite. In modal
/// coordinates all three may be diagonal, and in coordinates that are rotations the units are those of the conjugate quantities.
#[derive(Debug, Clone, PartialEq)]
pub struct Structure {
    /// M.
    pub mass: Symmetric,
    /// C.
    pub damping: Symmetric,
    /// K.
    pub stiffness: Symmetric,
}

impl Structure {
    pub(crate) fn validate(&self) -> Result<()> {
        let n = self.mass.size();
        if n == 0 {
            return Err(Error::invalid("system", "without degrees of freedom", "one or more"));
        }
        for (name, matrix) in [("mass", &self.mass), ("damping", &self.damping), ("stiffness", &self.stiffness)] {
            if matrix.size() != n {
                let size = format!("{0} × {0}", matrix.size());
                return Err(Error::invalid(format!("system: {name} matrix"), size, format!("{n} × {n}, as the mass")));
            }
            if let Some((i, j, value)) = matrix.not_finite() {
                let key = format!("system: {name} matrix, row {}, column {}", i + 1, j + 1);
                return Err(Error::invalid(key, format_args!("{value:?}"), "a finite number"));
            }
        }
        if let Err(fault) = Factor::new(&self.mass) {
            let (row, value) = (fault.row, self.mass.get(fault.row, fault.row));
            return Err(Error::invalid(
                format!("system: mass matrix, row {}", row + 1),
                format_args!("{value:?} on the diagonal, without a positive pivot"),
                "a positive definite matrix: every motion has kinetic energy",
            ));
        }
        semidefinite("damping", &self.damping)?;
        semidefinite("stiffness", &self.stiffness)
    }
}

/// Rounding of an assembled matrix, relative to its diagonal: shifted by this much, a semidefinite one is definite.
const SHIFT: f64 = 1e-9;

fn semidefinite(name: &str, matrix: &Symmetric) -> Result<()> {
    let diagonal = matrix.diagonal_entries();
    let largest = diagonal.iter().fold(0.0_f64, |a, d| a.max(d.abs()));
    if largest == 0.0 && matrix.entries().all(|entry| entry.2 == 0.0) {
        return Ok(());
    }
    let shift: Vec<f64> = diagonal.iter().map(|d| SHIFT * if *d > 0.0 { *d } else { largest }).collect();
    let shifted = Symmetric::sum(&[(1.0, matrix), (1.0, &Symmetric::diagonal(&shift))]);
    match Factor::new(&shifted) {
        Ok(_) => Ok(()),
        Err(fault) => Err(Error::invalid(
            format!("system: {name} matrix, row {}", fault.row + 1),
            format_args!("{:?} on the diagonal, with a negative pivot", matrix.get(fault.row, fault.row)),
            "a positive semidefinite matrix",
        )),
    }
}
