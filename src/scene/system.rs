//! The linear system: what vibrates when nothing touches it.

use crate::error::{Error, Result};

/// One degree of freedom, m q̈ + c q̇ + k q = f.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Oscillator {
    /// Mass m, kg; positive.
    pub mass: f64,
    /// Viscous damping c, N s/m; zero or more.
    pub damping: f64,
    /// Stiffness k, N/m; zero (a free body) or more.
    pub stiffness: f64,
}

/// M q̈ + C q̇ + K q = f, symmetric, M positive definite, C and K positive semidefinite.
#[derive(Debug, Clone, PartialEq)]
#[non_exhaustive]
pub enum System {
    /// A single degree of freedom: three numbers, no matrices.
    Oscillator(Oscillator),
}

impl System {
    /// n, the length of q.
    #[must_use]
    pub fn degrees_of_freedom(&self) -> usize {
        match self {
            Self::Oscillator(_) => 1,
        }
    }

    pub(crate) fn validate(&self) -> Result<()> {
        match self {
            Self::Oscillator(o) => {
                positive("system.oscillator.mass", o.mass)?;
                nonnegative("system.oscillator.damping", o.damping)?;
                nonnegative("system.oscillator.stiffness", o.stiffness)
            }
        }
    }
}

pub(crate) fn positive(key: &str, value: f64) -> Result<()> {
    if value.is_finite() && value > 0.0 {
        Ok(())
    } else {
        Err(Error::invalid(key, format_args!("{value:?}"), "a finite number above 0"))
    }
}

pub(crate) fn nonnegative(key: &str, value: f64) -> Result<()> {
    if value.is_finite() && value >= 0.0 {
        Ok(())
    } else {
        Err(Error::invalid(key, format_args!("{value:?}"), "a finite number, 0 or more"))
    }
}

pub(crate) fn finite(key: &str, value: f64) -> Result<()> {
    if value.is_finite() { Ok(()) } else { Err(Error::invalid(key, format_args!("{value:?}"), "a finite number")) }
}
