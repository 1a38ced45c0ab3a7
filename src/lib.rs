//! signorini
#![forbid(unsafe_code)]

#[cfg(feature = "cli")]
pub mod case;
pub mod error;
pub mod flow;
pub mod qp;
pub mod scene;
pub mod scheme;
pub mod step;
