//! The instruction set of the lanes.

use crate::error::{Error, Result};
use pulp::{Arch, Scalar, Simd, WithSimd};

/// The instruction set that a batch uses, and with it the number of lanes.
///
/// Those with fused multiply-add (AVX2, AVX-512, and [`Width::Widest`] on other processors that
/// have it, such as NEON) give the same bits. Plain lanes round products before adding, and their
/// results differ in the last digits, and in chaotic motion in all digits.
///
/// Apart from the logarithm for exponents, the lanes do not use the system's mathematical library,
/// whose last digits may depend on the processor; the scheme `event`, which computes what the lanes
/// do not support, does.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Width {
    /// The widest instructions of this machine.
    Widest,
    /// Eight lanes.
    Avx512,
    /// Four lanes.
    Avx2,
    /// One, without special instructions.
    Plain,
}

impl Width {
    /// The widths that this machine has.
    #[must_use]
    pub fn available() -> Vec<Self> {
        [Self::Widest, Self::Avx512, Self::Avx2, Self::Plain].into_iter().filter(|width| width.is_available()).collect()
    }

    /// True if this machine has it.
    fn is_available(self) -> bool {
        match self {
            Self::Widest | Self::Plain => true,
            #[cfg(target_arch = "x86_64")]
            Self::Avx512 => pulp::x86::V4::try_new().is_some(),
            #[cfg(target_arch = "x86_64")]
            Self::Avx2 => pulp::x86::V3::try_new().is_some(),
            #[cfg(not(target_arch = "x86_64"))]
            Self::Avx512 | Self::Avx2 => false,
        }
    }

    /// # Errors
    /// [`Error::Invalid`] if this machine does not have it.
    pub(super) fn check(self) -> Result<()> {
        if self.is_available() {
            return Ok(());
        }
        Err(Error::invalid(
            "lanes",
            format!("{self:?}"),
            format!("one of {:?}, which this machine has", Self::available()),
        ))
    }

    /// Runs `op` with these instructions, or with the widest if this machine does not have them.
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
