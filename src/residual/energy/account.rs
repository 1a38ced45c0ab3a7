//! The energy ledger of a run as it is reported.

use serde::{Deserialize, Serialize};

/// The energy ledger of a run, J. E is kinetic and strain energy plus what elastic and penalised
/// walls store while they touch.
///
/// For a staggered scheme E is the energy at half steps, which is the one it conserves.
#[derive(Debug, Clone, Copy, Default, PartialEq, Serialize, Deserialize)]
#[non_exhaustive]
pub struct Energy {
    /// E at the start.
    pub initial_j: f64,
    /// E at the end.
    pub final_j: f64,
    /// Largest E: over the ends of all steps, and for exact motion inside them too.
    pub largest_j: f64,
    /// Work of the loads.
    pub load_work_j: f64,
    /// Dissipated by the structure's damping.
    pub damping_j: f64,
    /// Dissipated by impacts on rigid walls and holes, −Σ p(ẇ⁻ + ẇ⁺)/2; negative if the scheme
    /// created energy there.
    pub impact_loss_j: f64,
    /// Dissipated by the dashpots of elastic walls: the work done on a wall minus what it stores.
    pub wall_damping_j: f64,
    /// Dissipated by friction, −Σ f(ẇ_t⁻ + ẇ_t⁺)/2.
    #[serde(default)]
    pub friction_j: f64,
    /// E(t) − E(0) − work + damping + losses.
    pub residual_j: f64,
    /// Energy exchanged: the largest E plus the magnitudes of all flows. The work of loads counts
    /// as ∫|f q̇| for exact motion (to some percent: it is a scale), and as the sum of |work| over
    /// the steps on a grid.
    pub exchanged_j: f64,
    /// |residual| / exchanged.
    pub residual: f64,
}
