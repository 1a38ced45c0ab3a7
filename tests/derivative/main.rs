//! Derivatives of exact runs with respect to keys of the scene.

mod closed_forms;
mod orbits;
mod scenes;
