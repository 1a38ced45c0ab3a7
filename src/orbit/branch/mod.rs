//! Branches of periodic orbits in a key of the scene: followed by pseudo-arclength, with their
//! special points located, and the branches that begin there found automatically.
//!
//! | label | test function that changes sign | what begins there |
//! |---|---|---|
//! | fold | the key's part of the tangent | nothing: the branch turns |
//! | period-doubling | det(M + 1) Πv_i, M the derivative over one orbit | orbits of twice the period |
//! | symmetry-breaking | det(H + 1) Πv_i, H that of the half map | two orbits without the symmetry |
//! | grazing-out | v_i of an impact | orbits without that impact |
//! | grazing-in | the least gap inside a flight | orbits with one more impact |
//! | rest-begins, rest-ends | reaction of the wall at an arrival with e = 0 | orbits with a rest more or less |
//! | contact-ends | least force in a contact with an elastic wall, speed at its end | orbits with a contact or pause more or less |
//! | corner | time between two events | of elastic walls, orbits with the two exchanged, or without the pause between them |
//!
//! det(M + 1) alone has a pole where v_i = 0. Both products are the determinant of the Jacobian of
//! perturbations that come back with the other sign, which is analytic. A Neimark–Sacker
//! bifurcation needs a complex pair of modulus 1, whose product is the determinant e₁²e₂² …
//! exp(−cT/m) ≤ 1: with one degree of freedom there is none.
//!
//! An orbit of a structure is followed by one of its states instead of its events
//! ([`Start::Shot`]). There complex pairs do cross the unit circle (neimark-sacker), and other
//! branches cross where a multiplier passes 1 without a fold (branch-point). There a branch also
//! ends where the list of walls that are met changes; another branch begins at this point.

mod arclength;
mod curve;
mod elastic;
mod events;
mod family;
mod follow;
mod graph;
mod label;
mod line;
mod locus;
mod net;
mod point;
mod request;
mod shots;
mod switch;

pub use family::Family;
pub use graph::{Start, graph};
pub use label::Label;
pub use line::End;
pub use locus::{Locus, OnLocus, Plane, locus};
pub use point::Point;
pub use request::{Branch, Graph, Request, Special, Switch};
