//! signorini
#![forbid(unsafe_code)]

pub mod error;
pub mod flow;
#[cfg(feature = "cli")]
pub mod output;
pub mod qp;
pub mod scene;
pub mod step;
