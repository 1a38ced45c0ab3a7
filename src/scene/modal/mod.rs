//! Modes of a structure, and scenes reduced to the slowest of them.
//!
//! | file | what it holds |
//! |---|---|
//! | `modes.rs` | [`Modes`]: ω and M-orthonormal shapes |
//! | `definite.rs` | the check of the mass matrix |
//! | `dense.rs` | all modes at once |
//! | `krylov.rs` | the slowest modes of large structures |
//! | `classical.rs` | whether damping couples the modes |
//! | `reduction.rs` | [`Reduction`]: a scene in modal coordinates, and what was left out |
//! | `residual.rs` | the static compliance of the modes left out |

mod classical;
mod definite;
mod dense;
mod krylov;
mod modes;
mod reduction;
mod residual;

pub use modes::{MOST_DENSE, MOST_MODES, Modes};
pub use reduction::{Reduction, WallTruncation};
