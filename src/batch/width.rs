//! Which instructions the lanes use.

use crate::error::{Error, Result};
use pulp::{Arch, Scalar, Simd, WithSimd};

/// Lanes side by side: the instructions that a batch uses.
///
/// Those with fused products (AVX2, AVX-512, and what [`Width::Widest`] is on other processors with
/// them, such as NEON) give the same bits as one another. Plain lanes round products before they
/// add and differ from those in the last places, which chaos makes all places.
///
/// The lanes use no function of the system's mathematics library, whose last digit may hang on the
/// processor, but the logarithm of an exponent; the scheme `event`, which follows what lanes do not
/// hold, does.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Width {
    /// The widest that this machine has.
    Widest,
    /// Eight lanes.
    Avx512,
    /// Four lanes.
    Avx2,
    /// One, without special instructions.
    Plain,
}

impl Width {
    /// Those that this machine has.
    #[must_use]
    pub fn available() -> Vec<Self> {
        [Self::Widest, Self::Avx512, Self::Avx2, Self::Plain]
            .into_iter()
            .filter(|width| width.check().is_ok())
            .collect()
    }

    /// # Errors
    /// [`Error::Invalid`] where this machine does not have it.
    pub(super) fn check(self) -> Result<()> {
        let has = match self {
            Self::Widest | Self::Plain => true,
            #[cfg(target_arch = "x86_64")]
            Self::Avx512 => pulp::x86::V4::try_new().is_some(),
            #[cfg(target_arch = "x86_64")]
            Self::Avx2 => pulp::x86::V3::try_new().is_some(),
            #[cfg(not(target_arch = "x86_64"))]
            Self::Avx512 | Self::Avx2 => false,
        };
        if has {
            return Ok(());
        }
        Err(Error::invalid(
            "lanes",
            format!("{self:?}"),
            format!("one of {:?}, which this machine has", Self::available()),
        ))
    }

    /// Runs `op` on these instructions, or on the widest where this machine does not have them.
    pub(super) fn dispatch<O: WithSimd>(self, op: O) -> O::Output {
        #[cfg(target_arch = "x86_64")]
        match self {
            Self::Avx512 => {
                if let Some(simd) = pulp::x86::V4::try_new() {
                    return Simd::vectorize(simd, op);
                }
            }
            Self::Avx2 => {
                if let Some(simd) = pulp::x86::V3::try_new() {
                    return Simd::vectorize(simd, op);
                }
            }
            Self::Widest | Self::Plain => {}
        }
        match self {
            Self::Plain => Simd::vectorize(Scalar, op),
            _ => Arch::new().dispatch(op),
        }
    }
}
