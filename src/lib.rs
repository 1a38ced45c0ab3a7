//! signorini
#![forbid(unsafe_code)]

pub mod error;
pub mod flow;
pub mod qp;
pub mod scene;
pub mod scheme;
pub mod step;
