//! Random scenes of every kind by every scheme.

#[path = "../support/draws.rs"]
mod draws;
#[path = "../support/random_scenes.rs"]
mod random_scenes;
#[path = "../support/random_structures.rs"]
mod random_structures;
#[path = "../support/rubbing.rs"]
mod rubbing;

mod alike;
mod exact;
mod scenes;
