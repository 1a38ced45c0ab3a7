//! What a run leaves behind: tables, a summary and pictures, written whole.
//!
//! | module | what it holds |
//! |---|---|
//! | [`atomic`] | files that appear complete or not at all |
//! | [`csv`] | `trajectory.csv` and `contacts.csv` |
//! | [`summary`] | `summary.json` |
//! | [`pictures`] | the figures of one or several runs |
//! | [`stability`] | tables and maps of a stability study |
//! | [`work_precision`] | the chart of accuracy against speed, and its table |
//! | [`figure`] | data in, SVG text out |

pub mod atomic;
pub mod csv;
pub mod figure;
mod json;
mod motion;
pub mod pictures;
mod places;
pub mod stability;
pub mod summary;
mod window;
pub mod work_precision;

pub use window::Span;
