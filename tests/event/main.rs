//! The exact scheme of planar walls, and the batch engine.

#[path = "../support/common/mod.rs"]
mod common;
#[path = "../support/counting.rs"]
mod counting;
#[path = "../support/draws.rs"]
mod draws;
#[path = "../support/random_structures.rs"]
mod random_structures;

mod batch;
mod benchmarks;
mod flow;
mod many;
mod many_allocations;
mod many_handed;
mod many_random;
mod many_rest;
mod random;
mod returns;
mod settling;
mod source;
mod vanishing;
