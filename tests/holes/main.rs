//! Motion in two planes: flats, round holes, friction and wear.

#[path = "../support/draws.rs"]
mod draws;
#[path = "../support/random_structures.rs"]
mod random_structures;
#[path = "../support/recorded_momentum.rs"]
mod recorded_momentum;
#[path = "../support/rubbing.rs"]
mod rubbing;

mod accounts;
mod beside;
mod elastic;
mod event;
mod flats;
mod friction;
mod frictionless;
mod judge;
mod located;
mod penalty;
mod pendulum;
mod position;
mod recorded;
#[cfg(feature = "cli")]
mod sliders;
mod slides;
mod start;
mod static_friction;
mod steps;
#[cfg(feature = "cli")]
mod two_planes;
mod vanishing;
mod wear;
#[cfg(feature = "cli")]
mod wear_holes;
