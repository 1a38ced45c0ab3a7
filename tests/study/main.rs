//! What several runs tell together, and statistics of one.

#[path = "../support/random_structures.rs"]
mod random_structures;
#[path = "../support/rubbing.rs"]
mod rubbing;

#[cfg(feature = "cli")]
mod accuracy;
mod batches;
mod chart;
mod episodes;
mod error_parts;
mod horizon;
mod intervals;
mod realisations;
mod spectrum;
#[cfg(feature = "cli")]
mod stability;
mod statistics;
mod step_search;
#[cfg(feature = "cli")]
mod studies_many;
#[cfg(feature = "cli")]
mod truncation;
#[cfg(feature = "case")]
mod wear_history;
