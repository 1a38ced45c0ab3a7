//! Case files: a scene, its times and its penalty as TOML, with errors that point at line and
//! column.
//!
//! ```
//! use signorini::case::Case;
//!
//! let case = Case::embedded("rigid-walls-sine")?;
//! assert_eq!(case.scene.walls.len(), 2);
//! assert_eq!(case.time.step, 1e-4);
//! # Ok::<(), signorini::Error>(())
//! ```
//!
//!
//! # Files
//!
//! Case file → scene, with errors that point at line and column (`report.rs`): `read.rs` reads a
//! file, a text or a case of `embedded.rs`; `keys.rs` lists every key (`key_entry.rs`) with its
//! type, unit, default and accepted values, which `schema.rs` looks up; `value.rs` reads TOML with
//! the position of each value, `check.rs` checks it against the keys, `build.rs` builds the case
//! table by table from what `builder.rs` holds, `system.rs`, `damping.rs`, `modal.rs`, `beam.rs`,
//! `bodies.rs`, `model.rs`, `place.rs`, `points.rs`, `line.rs`, `planes.rs` and `direction.rs` read
//! the structure, the locations on it and their directions, `walls.rs`, `supports.rs`, `flats.rs`
//! and `sliders.rs` what it touches, `materials.rs` their wear, `initial.rs` the state at the
//! start, `penalty.rs`, `statistics.rs`, `time.rs`, `flow.rs` and `method.rs` their tables and
//! settings, `loads.rs`, `random.rs`, `turbulence.rs` and `base.rs` (with `rigid_motion.rs`) the
//! loads, `table.rs` those of other files (`columns.rs`, `text.rs`, with their `digest.rs`),
//! `truncated.rs` keeps the full scene of a case reduced to modes, `realisations.rs` and `wear.rs`
//! give the scenes of realisations and of worn supports, `wording.rs` finds the key of each value
//! of the scene, `written.rs` keeps what the scene itself no longer shows, `notes.rs` says what
//! readers of a run must know, `units.rs` which values are more likely meant in another unit;
//! `case_file.rs` is the document that a case keeps, `key.rs` the path of a value, by which it is
//! changed to a `key_value.rs` before it is built (`changes.rs`, many times by `template.rs`),
//! `tangent.rs` differentiates the scene by a key, `summary.rs` reads the case of a finished run
//! (feature `case`).
#![doc = include_str!("../../cases/README.md")]

mod base;
mod beam;
mod bodies;
mod build;
mod builder;
mod case_file;
mod changes;
mod check;
mod columns;
mod damping;
mod digest;
mod direction;
mod embedded;
mod flats;
mod flow;
mod initial;
mod key;
mod key_entry;
mod key_value;
mod keys;
mod line;
mod loads;
mod materials;
mod method;
mod modal;
mod model;
mod notes;
mod penalty;
mod place;
mod planes;
mod points;
mod random;
mod read;
mod realisations;
mod report;
mod rigid_motion;
mod schema;
mod sliders;
mod statistics;
mod summary;
mod supports;
mod system;
mod table;
mod tangent;
mod template;
mod text;
mod time;
mod truncated;
mod turbulence;
mod units;
mod value;
mod walls;
mod wear;
mod wording;
mod written;

pub use case_file::CaseFile;
#[cfg(feature = "cli")]
pub(crate) use check::read as read_values;
#[cfg(feature = "cli")]
pub(crate) use digest::sha256;
pub use embedded::Embedded;
#[cfg(feature = "cli")]
pub(crate) use flow::{BEYOND_LIMIT, UNSTABLE, margin_in_words};
pub use key::Key;
#[cfg(feature = "cli")]
pub(crate) use key_entry::{KeyEntry, Kind, REQUIRED, entry};
pub use key_value::KeyValue;
pub use model::{Body, Model, Place};
pub use penalty::PenaltyOptions;
pub use planes::Planes;
#[cfg(feature = "cli")]
pub(crate) use realisations::RANDOM;
#[cfg(feature = "cli")]
pub(crate) use report::Source;
#[cfg(feature = "cli")]
pub(crate) use schema::{SETTABLE, Schema};
pub use statistics::StatisticsOptions;
#[cfg(feature = "cli")]
pub(crate) use statistics::rows_of;
pub use table::TableColumns;
pub use template::Template;
#[cfg(feature = "cli")]
pub(crate) use text::{MOST_TABLE_BYTES, open_regular, read_text};
pub use truncated::Truncated;
#[cfg(feature = "cli")]
pub(crate) use value::{Section, Value};
pub use wear::WearOptions;
pub use written::{FileRead, Line, Origin, ScatteredStart, Support, SupportShape, WallsOverBase, WearData, Written};

use crate::error::{Error, Result};
use crate::scene::{Condensation, FluidElastic, Scene, Slider};
use crate::time::TimeOptions;

/// The contents of a case file. Another value makes another case: [`Case::with`].
#[derive(Debug, Clone, PartialEq)]
pub struct Case {
    /// The file from which the case was built, with all changes of its values.
    pub document: CaseFile,
    /// Name of the file without folder and extension.
    pub name: String,
    /// One line that describes the case.
    pub title: Option<String>,
    /// Where the case comes from.
    pub source: Option<String>,
    /// The model from which its system was built.
    pub model: Model,
    /// The planes in which it moves.
    pub planes: Planes,
    /// The location of each wall, in the scene's order.
    pub places: Vec<Place>,
    /// The scene that is simulated, in modal coordinates if the case is reduced to modes; its
    /// duration is `time.end`.
    pub scene: Scene,
    /// The sliders of the scene, each with its place on the scene before any reduction to modes.
    pub sliders: Vec<Slider>,
    /// The massless degrees of freedom that were condensed, before any reduction to modes; `None`
    /// where all have mass.
    pub condensation: Option<Condensation>,
    /// The scene before the reduction to modes, and the errors of the reduction; `None` for a case
    /// that is not reduced.
    pub truncated: Option<Truncated>,
    /// The margins of tubes in a cross flow; `None` where the file has no table `flow`.
    pub fluid_elastic: Option<FluidElastic>,
    /// Step, recording and statistics.
    pub time: TimeOptions,
    /// Further statistics; `None` where the file has no such table.
    pub statistics: Option<StatisticsOptions>,
    /// The springs and the integrator of penalty runs.
    pub penalty: PenaltyOptions,
    /// Wear coefficients and the time in service.
    pub wear: WearOptions,
    /// Contents of the file that the scene no longer shows.
    pub written: Written,
}

impl Case {
    /// What stands above its results: its title, or its name where it has none.
    #[must_use]
    pub fn heading(&self) -> &str {
        self.title.as_deref().unwrap_or(&self.name)
    }

    /// True where walls, loads and probes have a place: not for one degree of freedom.
    #[cfg(feature = "cli")]
    pub(crate) fn has_places(&self) -> bool {
        !matches!(self.model, Model::Oscillator) || self.planes.is_two()
    }

    /// Checks scene and options, with errors in their terms.
    fn check(&self) -> Result<()> {
        self.scene.validate()?;
        self.time.validate(self.scene.duration)?;
        let rows = self.scene.duration / self.time.sample.map_or(self.time.step, |s| s.max(self.time.step));
        let columns = 1 + 2 * (self.scene.probes.len() + self.scene.walls.len());
        if rows * columns as f64 > MOST_VALUES {
            let least = self.scene.duration * columns as f64 / MOST_VALUES;
            let value = self.time.sample.map_or("left out".to_owned(), |sample| format!("{sample:?}"));
            let expected =
                format!("at least {least:.1e} s: a row has {columns} values, and a table at most {MOST_VALUES:e}");
            return Err(Error::invalid("sample", value, expected));
        }
        if let Some(statistics) = self.statistics {
            statistics.validate(self.scene.duration, &self.time)?;
        }
        self.penalty.validate(&self.scene)
    }
}

/// Most values in a trajectory: rows times columns.
const MOST_VALUES: f64 = 2e8;
