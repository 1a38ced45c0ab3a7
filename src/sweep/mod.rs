//! Sweeps: one case, the values of it that vary, and the measures computed for every row.
//!
//! A [`Sweep`] is the request; [`Sweep::plan`] checks it and numbers its rows; [`Plan::rows`]
//! computes them in memory, [`Plan::run_into`] into a folder, where an interrupted sweep can be
//! continued. The results of a row depend on the row only: threads, shards and interruptions change
//! no bit. A row that fails has the reason in place of its measures.
//!
//! | module | what it holds |
//! |---|---|
//! | `request` | [`Sweep`]: the request |
//! | `file` | the same as a sweep file |
//! | `axis`, `target`, `follow`, `random` | the values that vary: lists, grids, ranges, tied keys, random designs |
//! | `measure`, `sample` | the quantities computed for a row, by name |
//! | `forcing` | the period of the loads |
//! | `plan` | the rows, by number |
//! | `row` | one row: built, run, measured |
//! | `batched` | rows of one degree of freedom side by side, by [`batch`](crate::batch) |
//! | `basin`, `attractors` | rows that find the attractor to which their start leads, and the numbers of attractors |
//! | `watch`, `motion`, `strobe` | collect from the steps of a row what its measures need |
//! | `run` | the threads that compute rows, and the one that writes them |
//! | `journal`, `folder` | the files of an unfinished sweep, and the check whether it may be continued |
//! | `finish`, `record` | the tables |
//! | `picture`, `curves`, `maps`, `instants` | the pictures |
//! | `table`, `columns` | reading the tables |
//! | `shard`, `merge` | parts of a sweep, and joining them |
//!
//! A chain of rows, each of which starts from the end of the last, runs on one thread; a row that
//! follows no other is a chain by itself. Each thread takes the next chain when it has finished
//! one. So chains begin in the order of the rows, the journal is nearly sorted, and the load is
//! balanced.
//!
#![doc = include_str!("../../docs/sweep.md")]

mod attractors;
mod axis;
mod basin;
mod batched;
mod check;
mod columns;
mod curves;
mod file;
mod finish;
mod folder;
mod follow;
mod forcing;
mod instants;
mod journal;
mod maps;
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
mod target;
mod vary;
mod watch;

pub use axis::{Axis, Values};
pub use finish::Tables;
pub(crate) use folder::write_summary;
pub use follow::Follow;
pub use measure::{Measure, Scope};
pub(crate) use merge::merge_in;
pub use merge::{Merged, merge};
pub use picture::{Kind, Picture};
pub use plan::Plan;
pub use random::{Design, MOST_DIMENSIONS, Normal, Random};
pub use request::{Kernel, MOST_SAMPLES, Stretch, Sweep};
pub use row::{Row, Status};
pub use run::{Estimate, Finished, Manner, Progress};
pub use sample::{Sample, Samples};
pub use shard::Shard;
pub use target::Target;
