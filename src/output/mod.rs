//! What a run leaves behind: files written whole, and pictures.
//!
//! | module | what it holds |
//! |---|---|
//! | [`atomic`] | files that appear complete or not at all |
//! | [`figure`] | data in, SVG text out |

pub mod atomic;
pub mod figure;
