//! The source itself: layers, circles of imports, the public interface, the width of lines, what
//! the packages hold.

mod circles;
mod layers;
mod package;
mod public_api;
mod schemes;
mod width;
