//! Builders of structures with many degrees of freedom, from dimensions and material data to
//! matrices.
//!
//! | type | what it builds |
//! |---|---|
//! | [`Chain`] | masses in a line, springs between them |
//! | [`Bar`] | axial motion, linear elements |
//! | [`Beam`] | bending of a tube or a rectangular beam, Hermite elements |
//! | [`ModalData`] | modes and shapes computed or measured elsewhere |

mod bar;
mod beam;
mod chain;
mod mesh;
mod modal;
mod profile;

pub use bar::{Bar, BarEnd, MassMatrix};
pub use beam::{Beam, BeamEnd, BeamSection, SectionFault};
pub use chain::Chain;
pub use mesh::MOST_ELEMENTS;
pub use modal::{ModalData, ModalPoint};
