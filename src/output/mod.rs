//! What a run leaves behind: tables, a summary and pictures, written whole.
//!
//! | module | what it holds |
//! |---|---|
//! | [`atomic`] | files that appear complete or not at all |
//! | [`csv`] | `trajectory.csv` and `contacts.csv` |
//! | [`summary`] | `summary.json` |
//! | [`pictures`] | the figures of one or several runs |
//! | [`stability`] | tables and maps of a stability study |
//! | [`figure`] | data in, SVG text out |

pub mod atomic;
pub mod csv;
pub mod figure;
pub mod pictures;
pub mod stability;
pub mod summary;
