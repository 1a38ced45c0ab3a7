//! Questions asked of many runs.

pub mod accuracy;
pub mod change;
pub mod choice;
pub mod compare;
mod exact;
pub mod horizon;
pub mod stability;
pub mod verdict;
