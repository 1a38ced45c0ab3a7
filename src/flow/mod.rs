//! The exact motion between two events: in closed form for one degree of freedom, by its Taylor
//! series for a structure.
//!
//! # Files
//!
//! The exact motion between events: `arc.rs`, `arc_bounds.rs`, `touch.rs`, `contact.rs`,
//! `response.rs`, `force.rs`, `divided.rs`, `roots.rs` in closed form for one degree of freedom,
//! `series/` by Taylor series for structures (along a circle in round holes); `propagator.rs`
//! carries a small change of a structure's state along, `bisect.rs` finds a root between two times.

mod arc;
mod arc_bounds;
mod bisect;
mod contact;
mod divided;
mod force;
mod propagator;
mod response;
mod roots;
mod series;
mod touch;

pub use arc::Arc;
pub(crate) use arc::Start;
pub(crate) use bisect::bisect;
pub(crate) use propagator::{Propagator, held};
pub(crate) use response::Jet;
pub use series::Series;
pub(crate) use series::{
    Changes, Drive, HeldRow, HeldRows, INVERSE, Response, Responses, Round, SeriesBody, Start as SeriesStart, TERMS,
    Touching, add_sine, value,
};
pub(crate) use touch::{Support, Touch};
