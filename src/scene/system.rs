//! The linear system, without walls and loads.

use super::shared::SharedStructure;
use super::structure::Structure;
use crate::error::{Error, Result, Subject};
use crate::linear::Symmetric;
use serde::{Deserialize, Serialize};

/// One degree of freedom, m q̈ + c q̇ + k q = f.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct Oscillator {
    /// Mass m, kg; positive.
    pub mass: f64,
    /// Viscous damping c, N s/m; zero or more.
    pub damping: f64,
    /// Stiffness k, N/m; zero (a free body) or more.
    pub stiffness: f64,
}

/// M q̈ + C q̇ + K q = f, symmetric, M positive definite, C and K positive semidefinite.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[non_exhaustive]
pub enum System {
    /// A single degree of freedom: three numbers, no matrices.
    Oscillator(Oscillator),
    /// Several, by matrices.
    Structure(SharedStructure),
}

impl From<Structure> for System {
    fn from(structure: Structure) -> Self {
        Self::Structure(structure.into())
    }
}

impl System {
    /// M, C and K as matrices.
    #[must_use]
    pub fn structure(&self) -> SharedStructure {
        match self {
            Self::Oscillator(o) => {
                let one = |x: f64| Symmetric::diagonal(&[x]);
                Structure { mass: one(o.mass), damping: one(o.damping), stiffness: one(o.stiffness) }.into()
            }
            Self::Structure(s) => s.clone(),
        }
    }

    /// n, the length of q.
    #[must_use]
    pub fn degrees_of_freedom(&self) -> usize {
        match self {
            Self::Oscillator(_) => 1,
            Self::Structure(s) => s.mass.size(),
        }
    }

    /// aᵀ M b; for velocities (m/s) twice the kinetic energy, J.
    #[must_use]
    pub fn mass_form(&self, a: &[f64], b: &[f64]) -> f64 {
        match self {
            Self::Oscillator(o) => o.mass * first(a) * first(b),
            Self::Structure(s) => s.mass.form(a, b),
        }
    }

    /// aᵀ C b; for velocities (m/s) the power that damping dissipates, W.
    #[must_use]
    pub fn damping_form(&self, a: &[f64], b: &[f64]) -> f64 {
        match self {
            Self::Oscillator(o) => o.damping * first(a) * first(b),
            Self::Structure(s) => s.damping.form(a, b),
        }
    }

    /// aᵀ K b; for displacements (m) twice the strain energy, J.
    #[must_use]
    pub fn stiffness_form(&self, a: &[f64], b: &[f64]) -> f64 {
        match self {
            Self::Oscillator(o) => o.stiffness * first(a) * first(b),
            Self::Structure(s) => s.stiffness.form(a, b),
        }
    }

    /// ½vᵀMv + ½qᵀKq: kinetic and strain energy at a state, without walls, J.
    pub(crate) fn energy(&self, q: &[f64], v: &[f64]) -> f64 {
        0.5 * (self.mass_form(v, v) + self.stiffness_form(q, q))
    }

    /// Adds `scale` M x to `out`, both of length n.
    pub fn add_mass(&self, scale: f64, x: &[f64], out: &mut [f64]) {
        match self {
            Self::Oscillator(o) => add(scale * o.mass, x, out),
            Self::Structure(s) => s.mass.add_product(scale, x, out),
        }
    }

    /// Adds `scale` C x to `out`, both of length n.
    pub fn add_damping(&self, scale: f64, x: &[f64], out: &mut [f64]) {
        match self {
            Self::Oscillator(o) => add(scale * o.damping, x, out),
            Self::Structure(s) => s.damping.add_product(scale, x, out),
        }
    }

    /// Adds `scale` K x to `out`, both of length n.
    pub fn add_stiffness(&self, scale: f64, x: &[f64], out: &mut [f64]) {
        match self {
            Self::Oscillator(o) => add(scale * o.stiffness, x, out),
            Self::Structure(s) => s.stiffness.add_product(scale, x, out),
        }
    }

    pub(crate) fn validate(&self) -> Result<()> {
        match self {
            Self::Oscillator(o) => {
                positive(("oscillator", "mass"), o.mass)?;
                nonnegative(("oscillator", "damping"), o.damping)?;
                nonnegative(("oscillator", "stiffness"), o.stiffness)
            }
            Self::Structure(s) => s.validate(),
        }
    }
}

fn add(factor: f64, x: &[f64], out: &mut [f64]) {
    if let (Some(y), Some(x)) = (out.first_mut(), x.first()) {
        *y += factor * x;
    }
}

fn first(x: &[f64]) -> f64 {
    x.first().copied().unwrap_or(0.0)
}

fn checked(subject: impl Into<Subject>, value: f64, fits: bool, expected: &str) -> Result<()> {
    if value.is_finite() && fits { Ok(()) } else { Err(Error::invalid(subject, format_args!("{value:?}"), expected)) }
}

pub(crate) fn positive(subject: impl Into<Subject>, value: f64) -> Result<()> {
    checked(subject, value, value > 0.0, "a finite number above 0")
}

pub(crate) fn nonnegative(subject: impl Into<Subject>, value: f64) -> Result<()> {
    checked(subject, value, value >= 0.0, "a finite number, 0 or more")
}

/// Refuses a damping ratio of −1 or less: M + s C + s² K would not be positive definite for every s
/// > 0.
pub(crate) fn above_minus_one(subject: impl Into<Subject>, value: f64) -> Result<()> {
    checked(subject, value, value > -1.0, "a finite number above -1")
}

pub(crate) fn finite(subject: impl Into<Subject>, value: f64) -> Result<()> {
    checked(subject, value, true, "a finite number")
}
