//! Masses in a line.

use crate::error::{Error, Result, Subject};
use crate::linear::Symmetric;
use crate::scene::Structure;
use crate::scene::system::{nonnegative, positive};

/// Masses in a line, each joined to its neighbours by springs, the first and the last also to the
/// ground:
///
/// mᵢ q̈ᵢ = kᵢ₋₁ (qᵢ₋₁ − qᵢ) + kᵢ (qᵢ₊₁ − qᵢ),  q₀ = qₙ₊₁ = 0.
///
/// M is diagonal and K tridiagonal. Degree of freedom i (from 0) is the displacement of mass i, m.
#[derive(Debug, Clone, PartialEq)]
pub struct Chain {
    /// The masses, kg; one or more, each positive.
    pub masses: Vec<f64>,
    /// The springs between neighbours, N/m; one fewer than masses, each 0 (cut) or more.
    pub springs: Vec<f64>,
    /// The springs from the ground to the first mass and from the last mass to the ground, N/m; 0
    /// for a free end.
    pub grounds: [f64; 2],
}

impl Chain {
    /// M and K, without damping.
    ///
    /// # Errors
    /// [`Error::Invalid`] under `system.chain.masses`, `system.chain.springs` or
    /// `system.chain.grounds`.
    pub fn structure(&self) -> Result<Structure> {
        let n = self.masses.len();
        if n == 0 {
            return Err(Error::invalid(("chain", "masses"), "an empty list", "one mass or more, kg"));
        }
        if self.springs.len() + 1 != n {
            let expected = format!("{}, one between each two of {n} masses", n - 1);
            return Err(Error::invalid(("chain", "springs"), format!("{} values", self.springs.len()), expected));
        }
        for (i, &mass) in self.masses.iter().enumerate() {
            positive(Subject::from(("chain", "masses")).value(i), mass)?;
        }
        for (i, &spring) in self.springs.iter().enumerate() {
            nonnegative(Subject::from(("chain", "springs")).value(i), spring)?;
        }
        for (i, &spring) in self.grounds.iter().enumerate() {
            nonnegative(Subject::from(("chain", "grounds")).value(i), spring)?;
        }
        let between =
            self.springs.iter().enumerate().flat_map(|(i, &k)| [(i, i, k), (i + 1, i + 1, k), (i + 1, i, -k)]);
        let [first, last] = self.grounds;
        let stiffness = Symmetric::from_entries(n, between.chain([(0, 0, first), (n - 1, n - 1, last)]));
        Ok(Structure { mass: Symmetric::diagonal(&self.masses), damping: Symmetric::zeros(n), stiffness })
    }
}
