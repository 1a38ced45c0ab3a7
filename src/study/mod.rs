//! Questions asked of many runs.

pub mod accuracy;
pub mod change;
pub mod choice;
pub mod compare;
pub mod horizon;
mod replay;
pub mod stability;
pub mod verdict;
