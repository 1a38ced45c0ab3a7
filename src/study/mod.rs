//! Studies: questions that take many runs to answer.
//!
//! # Files
//!
//! Studies over several runs: `choice.rs` (scheme and solver), `compare/`, `exact.rs` (the exact
//! motion as a reference), `horizon.rs`, `perturbation.rs` and `growth.rs` (growth of a small
//! change), `attractor/` (which motion a start leads to), `difference.rs` and `change.rs` (between
//! two runs), `verdict/` (half the step), `realisations/` (means over random loads with their
//! intervals), `wear_history/` (gaps that grow by wear), `derivatives.rs`, `orbit_derivatives.rs`
//! (what a key changes), `truncation/`, `accuracy/`, `work_precision/`, `stability/` (runs in
//! parallel: feature `cli`).

pub mod accuracy;
pub mod attractor;
pub mod change;
pub mod choice;
pub mod compare;
pub mod derivatives;
pub(crate) mod difference;
mod exact;
mod growth;
pub mod horizon;
pub mod orbit_derivatives;
mod perturbation;
pub mod realisations;
#[cfg(feature = "cli")]
pub mod stability;
pub mod truncation;
pub mod verdict;
pub mod wear_history;
pub mod work_precision;
