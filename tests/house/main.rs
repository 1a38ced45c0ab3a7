//! The source itself: layers, circles of imports, the public interface, the width of lines and
//! length of functions, what the packages hold, what is compiled once.

mod circles;
mod layers;
mod length;
mod package;
mod public_api;
mod schemes;
mod shared_build;
mod width;
