//! Modes of a structure, and scenes cut to the slowest of them.
//!
//! | file | what it holds |
//! |---|---|
//! | `modes.rs` | [`Modes`]: ω and M-orthonormal shapes |
//! | `definite.rs` | the check of the mass matrix |
//! | `dense.rs` | all of them at once |
//! | `krylov.rs` | the slowest of many |
//! | `classical.rs` | whether damping couples them |
//! | `reduction.rs` | [`Reduction`]: a scene in modal coordinates, and what was lost |
//! | `residual.rs` | the static compliance that is left out |

mod classical;
mod definite;
mod dense;
mod krylov;
mod modes;
mod reduction;
mod residual;

pub use modes::{MOST_DENSE, MOST_MODES, Modes};
pub use reduction::{Reduction, WallTruncation};
