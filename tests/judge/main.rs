//! The judge, the contacts, and what every run must keep.

#[path = "../support/common/mod.rs"]
mod common;
#[path = "../support/random_structures.rs"]
mod random_structures;
#[path = "../support/rubbing.rs"]
mod rubbing;

mod blows;
mod complementarity;
mod contacts;
mod depths;
mod divergence;
mod faults;
mod findings;
mod ledger;
mod parts;
mod parts_planar;
mod shown;
mod structures;
mod together;
#[cfg(feature = "case")]
mod units;
