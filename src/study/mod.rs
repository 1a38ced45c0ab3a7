//! Questions asked of many runs.

pub mod choice;
pub mod compare;
pub mod horizon;
pub mod work_precision;
