//! Sweeps: one case, what of it is varied, and what is asked of every row.
//!
//! A [`Sweep`] says what; [`Sweep::plan`] checks it and numbers its rows; [`Plan::rows`] computes
//! them in memory, [`Plan::run_into`] into a folder, from where an interrupted one goes on. Every
//! number of a row follows from the row alone: threads, shards and interruptions change no bit.
//! Rows that fail are rows with their reason.
//!
//! | module | what it holds |
//! |---|---|
//! | `request` | [`Sweep`]: what is asked |
//! | `file` | the same as a sweep file |
//! | `axis`, `random` | what is varied: lists, grids, ranges, tied keys, random designs |
//! | `measure`, `sample` | what is asked of a row, by name |
//! | `forcing` | the period of the loads |
//! | `plan` | the rows, by number |
//! | `row` | one row: built, run, measured |
//! | `batched` | rows of one degree of freedom side by side, by [`batch`](crate::batch) |
//! | `watch`, `motion`, `strobe` | what measures need of a row's steps |
//! | `run` | threads, and the one writer |
//! | `journal`, `folder` | what is on disk while it runs, and what a folder may be gone on with |
//! | `finish`, `record` | the tables |
//! | `picture`, `curves`, `instants` | the picture |
//! | `table`, `columns` | the tables read again |
//! | `shard`, `merge` | parts, and the whole of them |
//!
//! The rows of one thread do not wait for those of another, and a chain of followed rows runs on
//! one. Threads are plain ones that take the next chain when they have done one: work is handed out
//! in the order of the rows, which keeps the journal nearly sorted, and nothing has to be balanced.
//!
#![doc = include_str!("../../docs/sweep.md")]

mod axis;
mod batched;
mod columns;
mod curves;
mod file;
mod finish;
mod folder;
mod forcing;
mod instants;
mod journal;
mod measure;
mod merge;
mod motion;
mod picture;
mod plan;
mod random;
mod record;
mod request;
mod row;
mod run;
mod sample;
mod shard;
mod strobe;
mod table;
mod watch;

pub use axis::{Axis, Follow, Target, Values};
pub use finish::Tables;
pub(crate) use folder::write_summary;
pub use measure::{Measure, Scope};
pub use merge::{Merged, merge};
pub use picture::{Kind, Picture};
pub use plan::Plan;
pub use random::{Design, MOST_DIMENSIONS, Normal, Random};
pub use request::{JUDGED, Kernel, MOST_SAMPLES, Stretch, Sweep};
pub use row::{Row, Status};
pub use run::{Estimate, Finished, Manner, Progress};
pub use sample::{Sample, Samples};
pub use shard::Shard;
