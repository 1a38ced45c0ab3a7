//! Figures.
#![cfg(feature = "cli")]

#[path = "../support/draws.rs"]
mod draws;

mod file;
mod gallery;
mod text;
