//! Wear at supports: the work of wear of each step, where around the support it is done, and the
//! depth of the scar that follows.
//!
//! The work of wear is W = ∫ F_n |v_t| dt, with F_n the normal force of a support and v_t the speed
//! at which the structure slides there. Archard's law makes a worn volume of it, V = k W, with k
//! the wear coefficient (Archard 1953, doi:10.1063/1.1721448).
//!
//! # Files
//!
//! Wear at supports: `contacts.rs` finds the contacts that slide in a step, `piece.rs` what each of
//! them does over a piece of it, `blows.rs` how the impulses of loads change its velocity before,
//! `stretch.rs` integrates over exact motion, `work.rs` is the work of wear of an impulse,
//! `sectors.rs` the part of the circle in which a contact lies, `archard.rs` the volume that the
//! work wears off, `depth.rs` the depth of its scar, `growth.rs` what that does to the gaps of a
//! support, `wear_work.rs` the work by sectors and walls.

mod archard;
mod blows;
mod contacts;
mod depth;
mod growth;
mod piece;
mod sectors;
mod stretch;
mod wear_work;
mod work;

#[cfg(feature = "case")]
pub(crate) use archard::SCAR;
pub use archard::{Archard, Scar, Worn};
pub(crate) use contacts::SlidingContacts;
pub use depth::Bearing;
pub use growth::{Growth, Opening};
pub(crate) use piece::{ImpulseDuration, SlidingPiece};
pub(crate) use sectors::sectors_over;
pub use wear_work::WearWork;
