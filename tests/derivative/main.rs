//! Derivatives of exact runs with respect to keys of the scene.

mod closed_forms;
#[cfg(feature = "case")]
mod differences;
mod orbits;
mod releases;
mod scenes;
mod single_keys;
