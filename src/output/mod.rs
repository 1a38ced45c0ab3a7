//! The files of a request: tables, documents and pictures, each written whole or not at all. Where
//! one cannot be written, the function that writes it returns [`Error::Io`](crate::Error::Io).
//!
//! | module | what it holds |
//! |---|---|
//! | [`atomic`] | files that appear complete or not at all |
//! | [`results`] | the folder of a request's results, and what it may replace |
//! | `manifest` | `request.json`: the contents of a folder of results |
//! | `record` | rows, length and digest of a table, and whether it still has them |
//! | `journal` | what a long computation has done, so that it goes on after an interruption |
//! | `lock` | one writer in a folder at a time |
//! | [`request`], `values` | the request, as recorded beside its results, and the case by its keys |
//! | [`csv`] | `trajectory.csv`, `output.csv` and `contacts.csv` |
//! | [`derivatives`], [`orbit_derivatives`], [`effects`] | `derivatives.csv` of a run or an orbit, and the table of what 1 % more of a key changes |
//! | [`supports`] | `supports.csv`, `sectors.csv`, the table of supports and their part of the summary |
//! | `turbulence` | `turbulence.csv`, `turbulence-pairs.csv`: forces on modes, asked and applied |
//! | [`summary`], `json` | `summary.json`, and how JSON is written |
//! | [`run`] | all files of one run, and its table |
//! | [`run_folder`] | the folder of a run of a case, with its checks and its realisations |
//! | [`compare`], `compare_table` | all files of a comparison, its tables and its JSON |
//! | [`method_realisations`] | the methods of a comparison under several realisations: files, tables, JSON |
//! | `agreement` | the conclusion of a comparison in one sentence |
//! | `verification` | the page and the table of the manual |
//! | [`document`] | a chart and a stability study as JSON |
//! | `detail` | what `[statistics]` asks for: [`episodes`] (`episodes.csv`, `exceedances.csv`) and `spectra` |
//! | [`realisations`], [`refinements`] | `realisations.csv`, and its tables |
//! | [`through`] | depths of wear that the tube does not have |
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
//! | `labelled`, `motion`, `window` | a run that is drawn, its motion, and the stretch of it |
//! | `orbit`, `ring`, `rubbed` | its way between supports, and the supports over time |
//! | `places`, `part`, `colours` | walls and supports: which fit on a page, which are drawn together, and in which colour |
//! | [`stability`] | tables and maps of a stability study |
//! | `stable_steps` | the largest stable step of each scheme, and the conclusion of a stability study |
//! | `cheapest` | the cheapest methods of a chart, and its conclusion |
//! | `floors` | how near penalties come to rigid walls, and why no nearer |
//! | [`wear_history`] | `history.csv` and `years.csv` of wear over the years, and their picture |
//! | [`wear_remarks`] | when wear reaches a limit, and what its figures mean, in sentences |
//! | [`wear_folder`], [`first_window`] | the folder of a study of wear, from which it goes on, and what a check of its first window says |
//! | [`wear_journal`] | `windows.journal`: what an interrupted study of wear has run |
//! | [`work_precision`] | the chart of accuracy against speed, and its table |
//! | [`figure`] | data in, SVG text out |
//! | [`shape`] | `shape.csv`: the displacement of the whole structure, for a drawing |
//! | `sheets` | `tables.xlsx`: tables as the sheets of a workbook |
//! | `animation` | `animation.svg`: a tube in motion between its walls |
//! | [`mod@format`] | figures as files: SVG, PDF, PNG; the formats of a request |

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
pub mod effects;
pub mod episodes;
pub mod error_parts;
pub use signorini_figure as figure;
pub mod first_orbit;
pub mod first_window;
pub(crate) mod floors;
pub mod format;
pub(crate) mod journal;
pub(crate) mod json;
mod labelled;
pub mod loci;
mod lock;
pub(crate) mod manifest;
pub mod method_realisations;
mod motion;
mod orbit;
pub mod orbit_derivatives;
pub mod orbits;
pub mod overlay;
mod part;
pub mod periodic;
pub mod pictures;
mod places;
pub mod realisations;
pub(crate) mod record;
pub mod refinements;
pub mod request;
pub mod results;
pub(crate) mod ring;
mod rubbed;
pub mod run;
pub mod run_folder;
pub mod scene_family;
pub mod sector_means;
pub mod shape;
#[cfg(feature = "xlsx")]
mod sheets;
mod spectra;
pub mod stability;
pub(crate) mod stable_steps;
pub mod summary;
pub mod supports;
pub mod table;
pub mod through;
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
