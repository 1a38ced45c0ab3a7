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
//! | `file`, `keys`, `part`, `vary` | the same as a sweep file: its keys, its tables, the values in them |
//! | `axis`, `values`, `target`, `follow`, `random`, `layout` | the values that vary: lists, grids, ranges, tied keys, random designs |
//! | `measure`, `sample` | the quantities computed for a row, by name |
//! | `forcing` | the period of the loads |
//! | `plan`, `headers`, `check` | the rows, by number, the columns of the tables, and what is checked before a row runs |
//! | `row`, `lacking`, `status` | one row: built, run, measured; why a measure has no value |
//! | `realisations`, `scars`, `fold` | rows with several realisations of their random loads, the depths by their mean work, and the means over them |
//! | `until_interval`, `run_set`, `seeds` | how many that are, where intervals decide; which are run together |
//! | `batched` | rows of one degree of freedom side by side, by [`batch`](crate::batch) |
//! | `basin`, `attractors` | rows that find the attractor to which their start leads, and the numbers of attractors |
//! | `row_observer`, `motion`, `strobe` | collect from the steps of a row what its measures need |
//! | `run` | runs a sweep into a folder, where it can be continued |
//! | `chains` | computes rows on several threads |
//! | `found` | the rows that earlier processes have computed |
//! | `estimate` | time and size of a sweep, from its first rows |
//! | `block`, `folder` | the files of an unfinished sweep, and the check whether it may be continued |
//! | `finish`, `finished`, `record` | the tables |
//! | `picture`, `curves`, `maps`, `instants`, `tornado` | the pictures |
//! | `table`, `columns` | reading the tables |
//! | `runs`, `effects` | the runs by row and realisation; the effect of each key on each measure |
//! | `shares` | the share of each key in the variance of each measure |
//! | `sensitivity` | effects or shares, as the tables that all rows together give |
//! | `means` | the means over realisations, for the terminal |
//! | `instability` | what a reader of the table must know: of the case, and of rows that are unstable |
//! | `shard`, `merge` | parts of a sweep, and joining them |
//!
//! A chain of rows, each of which starts from the end of the last, runs on one thread; a row that
//! follows no other is a chain by itself. Each thread takes the next chain when it has finished
//! one. So chains begin in the order of the rows, the journal is nearly sorted, and the load is
//! balanced.

mod attractors;
mod axis;
mod basin;
mod batched;
mod block;
mod chains;
mod check;
mod columns;
mod curves;
mod effects;
mod estimate;
mod file;
mod finish;
mod finished;
mod fold;
mod folder;
mod follow;
mod forcing;
mod found;
mod headers;
mod instability;
mod instants;
mod keys;
mod lacking;
mod layout;
mod maps;
mod means;
mod measure;
mod merge;
mod motion;
mod part;
mod picture;
mod plan;
mod random;
mod realisations;
mod record;
mod request;
mod row;
mod row_observer;
mod run;
mod run_set;
mod runs;
mod sample;
mod scars;
mod seeds;
mod sensitivity;
mod shard;
mod shares;
mod status;
mod strobe;
mod table;
mod target;
mod tornado;
mod until_interval;
mod values;
mod vary;

pub use axis::Axis;
pub(crate) use effects::Effect;
pub use estimate::Estimate;
pub use finish::Tables;
pub use finished::Finished;
pub(crate) use folder::{first_rows, write_summary};
pub use follow::Follow;
pub(crate) use means::means;
pub use measure::{Measure, PlacedColumn, Scope};
pub(crate) use merge::merge_in;
pub use merge::{Merged, merge};
pub(crate) use picture::Pictures;
pub use picture::{Kind, Picture};
pub use plan::Plan;
pub use random::{Design, MOST_DIMENSIONS, Normal, Random};
pub use request::{Kernel, MOST_SAMPLES, Sweep, Window};
pub use row::Row;
pub use run::{Progress, SweepOptions};
pub use sample::{Sample, Samples};
pub(crate) use seeds::{asked, in_words};
pub(crate) use sensitivity::{SENSITIVITY_TABLES, Sensitivity};
pub use shard::Shard;
pub(crate) use shares::{NO_KEY, Share, Shares, caution, coefficients};
pub use status::Status;
pub use target::Target;
pub use values::Values;
