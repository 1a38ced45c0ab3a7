//! The source itself: layers, circles of imports, the public interface.

mod circles;
mod layers;
mod public_api;
