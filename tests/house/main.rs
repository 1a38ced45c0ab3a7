//! The source itself: layers, circles of imports, the public interface, the width of lines.

mod circles;
mod layers;
mod public_api;
mod schemes;
mod width;
