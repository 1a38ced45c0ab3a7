//! How time advances.

pub mod event;
