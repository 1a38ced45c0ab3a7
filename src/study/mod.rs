//! Questions asked of many runs.

pub mod accuracy;
pub mod change;
pub mod choice;
pub mod compare;
mod exact;
pub mod horizon;
#[cfg(feature = "cli")]
pub mod stability;
pub mod truncation;
pub mod verdict;
pub mod work_precision;
