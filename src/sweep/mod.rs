//! Sweeps: one case, the values of it that vary, and the measures computed for every row.
//!
//! A [`Sweep`] is the request; [`Sweep::plan`] checks it and numbers its rows; [`Plan::rows`]
//! computes them in memory, [`Plan::run_into`] into a folder, where an interrupted sweep can be
//! continued. The numbers of a row depend on the row alone: threads, shards and interruptions
//! change no bit. A row that fails has the reason in place of its measures.
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
//! A chain of rows, each of which starts from the end of the last, runs on one thread; a row that
//! follows no other is a chain by itself. Each thread takes the next chain when it has finished
//! one. So chains begin in the order of the rows, the journal is nearly sorted, and the load is
//! balanced.
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
