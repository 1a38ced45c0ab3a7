//! The static compliance of the modes left out.

use super::modes::Modes;
use crate::error::{Error, Result};
use crate::linear::{Factor, Symmetric};
use crate::scene::structure::matrix_of;
use crate::scene::{Row, Structure};

/// Most iterations; each reduces the error at least a hundredfold.
const PASSES: usize = 40;

/// Computes the static response of the modes left out of Φ: x = (K⁺ − ΦΩ⁻²Φᵀ) gᵀ.
///
/// With P = I − MΦΦᵀ, which removes from a force the part that the modes carry, K x = P gᵀ has
/// exactly one solution with ΦᵀM x = 0, also for a singular K, if the rigid-body motions are among
/// the modes. It is found by x ← P⊤(K + σM)⁻¹(P gᵀ + σ M x), which reduces the error by σ/(ω² + σ)
/// for each ω left out; σ is a hundredth of the slowest of their ω².
pub(super) struct Residual<'a> {
    mass: &'a Symmetric,
    modes: &'a Modes,
    factor: Factor,
    sigma: f64,
}

impl<'a> Residual<'a> {
    /// `next` is ω of the slowest mode that is left out, rad/s.
    pub fn new(structure: &'a Structure, modes: &'a Modes, next: f64) -> Result<Self> {
        let sigma = if modes.rigid() > 0 { 0.01 * next * next } else { 0.0 };
        let shifted = Symmetric::sum(&[(1.0, &structure.stiffness), (sigma, &structure.mass)]);
        let factor = Factor::new(&shifted).map_err(|fault| {
            let key = matrix_of("stiffness").row(fault.row);
            let value =
                format_args!("{:?} on the diagonal, without a positive pivot", shifted.get(fault.row, fault.row))
                    .to_string();
            Error::invalid(key, value, "a matrix that holds all but the rigid-body motions, for a static compliance")
        })?;
        Ok(Self { mass: &structure.mass, modes, factor, sigma })
    }

    /// The response x to a row.
    pub fn response(&mut self, row: &Row) -> Vec<f64> {
        let n = self.mass.size();
        let seen = self.modes.seen(row);
        let carried = self.modes.expand(&seen);
        let mut force = vec![0.0; n];
        self.mass.add_product(-1.0, &carried, &mut force);
        row.add_transposed(1.0, &mut force);
        let mut x = vec![0.0; n];
        for _ in 0..PASSES {
            let mut y = force.clone();
            self.mass.add_product(self.sigma, &x, &mut y);
            self.factor.solve(&mut y);
            // Rounding adds small components along the modes, which are removed.
            let back = self.modes.expand(&self.modes.coordinates(self.mass, &y));
            y.iter_mut().zip(&back).for_each(|(y, b)| *y -= b);
            let change = row.dot(&y) - row.dot(&x);
            x = y;
            if self.sigma == 0.0 || change.abs() <= 1e-15 * row.dot(&x).abs() {
                break;
            }
        }
        x
    }
}
