//! Studies: questions that take many runs to answer.

pub mod accuracy;
pub mod attractor;
pub mod change;
pub mod choice;
pub mod compare;
pub(crate) mod difference;
mod exact;
mod growth;
pub mod horizon;
mod perturbation;
pub mod realisations;
#[cfg(feature = "cli")]
pub mod stability;
pub mod truncation;
pub mod verdict;
pub mod work_precision;
