//! Variation, periodic orbits, their branches and basins.

#[cfg(feature = "cli")]
#[path = "../support/command.rs"]
mod command;

#[cfg(feature = "cli")]
mod basins;
mod branches;
mod orbits;
mod source;
mod structures;
#[cfg(feature = "cli")]
mod tool;
mod variation;
