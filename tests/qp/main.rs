//! Programmes of one time step, and the solvers of them.

#[path = "../../benches/support/beam.rs"]
mod beam;
#[path = "../support/counting.rs"]
mod counting;
#[path = "../support/draws.rs"]
mod draws;
#[path = "../support/qp_support/mod.rs"]
mod qp_support;

mod allocations;
mod backends;
mod band;
mod condensed;
mod crowded;
mod dependent;
mod disks;
mod scalar;
