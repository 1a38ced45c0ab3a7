//! The files of a run: tables, a summary and pictures, each written whole or not at all.
//!
//! | module | what it holds |
//! |---|---|
//! | [`atomic`] | files that appear complete or not at all |
//! | [`results`] | the folder of a request's results, and what it may replace |
//! | `manifest` | `request.json`: the contents of a folder of results |
//! | `record` | rows, length and digest of a table, and whether it still has them |
//! | `journal` | what a long computation has done, so that it goes on after an interruption |
//! | `lock` | one writer in a folder at a time |
//! | [`request`] | the request, as recorded beside its results |
//! | [`csv`] | `trajectory.csv`, `output.csv` and `contacts.csv` |
//! | [`derivatives`] | `derivatives.csv`, and the table of what 1 % more of a key changes |
//! | [`supports`] | `supports.csv`, `sectors.csv`, the table of supports and their part of the summary |
//! | `turbulence` | `turbulence.csv`, `turbulence-pairs.csv`: forces on modes, asked and applied |
//! | [`summary`] | `summary.json` |
//! | [`run`] | all files of one run, and its table |
//! | [`compare`] | all files of a comparison, its table and its JSON |
//! | `agreement` | the conclusion of a comparison in one sentence |
//! | [`document`] | a chart and a stability study as JSON |
//! | [`episodes`] | `episodes.csv` and `exceedances.csv`, and their table |
//! | [`realisations`] | `realisations.csv`, and its table |
//! | [`worn_means`] | worn volume and depths over realisations: a table, and a part of the summary |
//! | [`sector_means`] | `sector-means.csv`: where around each support a tube wears |
//! | [`error_parts`] | `errors.csv`, and its table |
//! | [`periodic`] | a periodic orbit: its document, motion and pictures |
//! | [`branches`] | branches of orbits: tables, document and picture |
//! | [`varied`] | a key whose value changes along branches, and its range |
//! | [`scene_family`] | the scenes of a case over one key or two |
//! | [`first_orbit`] | the orbit on which a case settles, or that of a file |
//! | [`branch_folder`] | the branches of a case, and the folder of their files |
//! | [`overlay`] | `beneath.csv`: points of other results beneath the branches |
//! | [`orbits`] | `orbits.csv`: the motion of the orbits along branches, for a drawing |
//! | [`loci`] | curves of special points over two keys |
//! | [`table`] | tables for people, as wide as the terminal |
//! | [`pictures`] | the figures of one or several runs |
//! | [`stability`] | tables and maps of a stability study |
//! | `stable_steps` | the largest stable step of each scheme, and the conclusion of a stability study |
//! | `cheapest` | the cheapest methods of a chart, and its conclusion |
//! | `floors` | how near penalties come to rigid walls, and why no nearer |
//! | [`wear_history`] | `history.csv` and `years.csv` of wear over the years, and their picture |
//! | [`wear_remarks`] | when wear reaches a limit, and what its figures mean, in sentences |
//! | [`wear_folder`] | the folder of a study of wear, from which it goes on |
//! | [`wear_journal`] | `windows.journal`: what an interrupted study of wear has run |
//! | [`work_precision`] | the chart of accuracy against speed, and its table |
//! | [`figure`] | data in, SVG text out |
//! | [`shape`] | `shape.csv`: the displacement of the whole structure, for a drawing |
//! | `sheets` | `tables.xlsx`: tables as the sheets of a workbook |
//! | `animation` | `animation.svg`: a tube in motion between its walls |
//! | [`mod@format`] | figures as files: SVG, PDF, PNG; the formats of a request |
//!
//! # Files
//!
//! The files of a request, each written whole or not at all: `results.rs` is the folder, which one
//! writer at a time (`lock.rs`) fills, `manifest.rs` says what it may replace and what belongs to
//! it, `record.rs` whether a table is still as it was written, `journal.rs` keeps what an
//! interrupted request has done, `atomic.rs` writes a file onto the disk before it gets its name,
//! `request.rs` records the request and `values.rs` the case by its keys, `run.rs` and `compare.rs`
//! write all files and tables of a run and of a comparison, `periodic.rs` and `branches.rs` those
//! of periodic orbits (`first_orbit.rs` finds or reads the first, `branch_folder.rs` follows the
//! branches of a case over the scenes of `scene_family.rs` and the key of `varied.rs`), `orbits.rs`
//! the motion of those along branches and `overlay.rs` points of other results under them,
//! `shape.rs` the shape of a structure over time; `summary/`, `csv.rs`, `derivatives.rs`,
//! `table.rs`, `json.rs`, `compare_table.rs` and `method_realisations.rs` (comparisons for the
//! terminal), `agreement.rs` (their conclusion), `verification.rs` (the manual), `document.rs`,
//! `detail.rs` (what `[statistics]` asks for: `episodes.rs`, `spectra.rs`), `turbulence.rs` (its
//! forces), `realisations.rs`, `sector_means.rs` (their sectors), `error_parts.rs` (the errors of
//! their means), `cheapest.rs` (the conclusion of a chart), `floors.rs` (why its penalties have
//! floors), `stable_steps.rs` (the conclusion of a stability study), figures (`labelled.rs` is a
//! run that is drawn, `motion.rs` its motion, `window.rs` the stretch of it, `orbit.rs` with
//! `ring.rs` its way between supports, `rubbed.rs` the supports over time; `site.rs` is a wall or
//! support with its results, `places.rs` says which fit on a page, `colours.rs` has the colour of
//! each, `part.rs` the walls that are drawn together), `format.rs` (figures as SVG, PDF or PNG),
//! `sheets.rs` (tables as a workbook, feature `xlsx`; feature `cli`).

pub(crate) mod agreement;
pub(crate) mod animation;
pub mod atomic;
pub mod branch_folder;
pub mod branches;
pub(crate) mod cheapest;
pub(crate) mod colours;
pub mod compare;
pub(crate) mod compare_table;
pub mod csv;
pub mod derivatives;
mod detail;
pub mod document;
pub mod episodes;
pub mod error_parts;
pub use signorini_figure as figure;
pub mod first_orbit;
pub(crate) mod floors;
pub mod format;
pub(crate) mod journal;
pub(crate) mod json;
mod labelled;
pub mod loci;
mod lock;
pub(crate) mod manifest;
pub(crate) mod method_realisations;
mod motion;
mod orbit;
pub mod orbits;
pub mod overlay;
mod part;
pub mod periodic;
pub mod pictures;
mod places;
pub mod realisations;
pub(crate) mod record;
pub mod request;
pub mod results;
pub(crate) mod ring;
mod rubbed;
pub mod run;
pub mod scene_family;
pub mod sector_means;
pub mod shape;
#[cfg(feature = "xlsx")]
mod sheets;
mod site;
mod spectra;
pub mod stability;
pub(crate) mod stable_steps;
pub mod summary;
pub mod supports;
pub mod table;
pub(crate) mod turbulence;
mod values;
pub mod varied;
pub(crate) mod verification;
pub mod wear_folder;
pub mod wear_history;
pub mod wear_journal;
pub mod wear_remarks;
mod window;
pub mod work_precision;
pub mod worn_means;

pub use window::Span;
pub(crate) use window::extent;
