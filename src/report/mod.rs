//! The report: one HTML file that shows the contents of a folder of results, opens without network,
//! and can be forwarded by itself.
//!
//! | module | what it holds |
//! |---|---|
//! | `folder` | the files of a folder, read and checked |
//! | `column` | numbers as base64, long series by their extremes |
//! | `motion` | `trajectory.csv`, `contacts.csv` and `shape.csv` of one run |
//! | `scene` | what is drawn: the structure, its walls and loads |
//! | `cards` | how reliable a run is, in sentences |
//! | `run`, `compare`, `chart`, `stability`, `sweep`, `orbit`, `branches`, `wear` | the contents of each kind of page |
//! | `older` | what folders of older versions lack |
//! | `over` | other results in the figures of a page |
//! | `paths` | absolute paths, which a page does not show |
//! | `html` | the file itself: escapes, and what it may load (nothing) |
//! | `verification` | the verification manual as a page |
//! | `page/` | the page's HTML, CSS and JavaScript |
//!
//! A report is made from the files of the folder only, so that `signorini report FOLDER` writes the
//! same bytes as the command that filled the folder.
//!
//! # Files
//!
//! The report: one HTML page from the files of a folder of results, which `folder.rs` reads and
//! checks; `motion.rs`, `scene.rs`, `cards.rs` and one file for each kind of page make its data,
//! `column.rs` packs numbers, `html.rs` fills the frame and states what the page may load; `page/`
//! is HTML, CSS and JavaScript (feature `cli`).
//!
//! # The page
//!
//! The scripts in `src/report/page/js/` run in one scope, in the order that `html.rs` lists:
//! `base.js` (elements, numbers), `look.js` (colours), `axes.js`, `plot.js`, `curves.js`,
//! `pointer.js` (plots), `motion.js` (runs, the instant, the view), `controls.js`, `table.js`, then
//! one file for each drawing and section, and `page.js` last, which puts the page together. Plots
//! are drawn on canvas by the page itself rather than by a library: the walls, the stems, the phase
//! plane, the maps and the drawing in motion would each be a plug-in of a library of time series,
//! and the page is as fast. A new kind of page is a file beside `run.rs`, a branch in `mod.rs` and
//! a section in `page.js`; a new drawing is a stage beside `body.js`, chosen in `stage.js`.

mod branches;
mod cards;
mod chart;
mod column;
mod compare;
mod folder;
mod html;
mod motion;
mod older;
mod orbit;
mod over;
mod paths;
mod run;
mod scene;
mod stability;
mod sweep;
pub(crate) mod verification;
mod wear;

pub use html::FILE;

use crate::error::{Error, Result};
use crate::output::atomic::write_whole;
use crate::output::manifest::{self, MANIFEST};
use crate::output::record::{Record, TABLES};
use crate::output::results::Results;
use folder::Folder;
use serde_json::{Map, Value, json};
use std::path::{Path, PathBuf};

/// What is said of results whose tables cannot be verified.
pub const UNVERIFIED: &str = "the version that made these results recorded no digests: their tables are not verified";

/// A report that was written.
#[derive(Debug)]
pub struct Written {
    /// The page.
    pub path: PathBuf,
    /// False where the version that made the results recorded no digests to verify their tables by.
    pub verified: bool,
}

/// Writes the report on the results in `folder`, with those in `over` in its figures: as `out`, or
/// as [`FILE`] in that folder.
///
/// # Errors
/// As [`page`] and [`page_over`]; [`Error::Io`] for a folder without results, for one in which any
/// table or document that was recorded is not as it was written, and where the page cannot be
/// written.
pub fn write(folder: &Path, over: Option<&Path>, out: Option<&Path>) -> Result<Written> {
    let manifest = manifest_of(folder)?;
    let over = over.map(|over| Ok((over, manifest_of(over)?))).transpose()?;
    let page = match &over {
        Some((over, theirs)) => page_over(folder, &manifest, (over, theirs))?,
        None => page(folder, &manifest)?,
    };
    // Those that the page shows were verified as they were read; results are damaged where one of
    // the others is.
    for (folder, manifest) in [(folder, &manifest)].into_iter().chain(over.iter().map(|(over, theirs)| (*over, theirs)))
    {
        Record::verify_all(folder, manifest)?;
    }
    let verified = manifest.get(TABLES).is_some();
    let path = out.map_or_else(|| folder.join(FILE), Path::to_owned);
    match out {
        Some(path) => write_whole(path, page.as_bytes())?,
        // Listed, so that a later run without a report takes this one away.
        None => manifest::add(folder, manifest, FILE, page.as_bytes())?,
    }
    Ok(Written { path, verified })
}

/// Results whose files are in their places.
#[derive(Debug)]
pub struct Finished {
    /// The page, where there is one.
    pub page: Option<PathBuf>,
    /// What is to be said: why there is no page, and what was replaced.
    pub said: Vec<String>,
}

/// Finishes `results`, with the page on them beside them where one is `wanted`.
///
/// # Errors
/// As [`Results::finish`], and as [`page`].
pub fn finish(results: &mut Results, wanted: bool) -> Result<Finished> {
    // The page is made from the files in their places.
    let replaced = results.finish()?;
    let mut finished = Finished { page: None, said: Vec::new() };
    if wanted {
        let (folder, manifest) = (results.folder().to_owned(), results.manifest());
        match too_large(&folder, &manifest)? {
            Some(reason) => finished.said.push(reason),
            None => {
                results.write(FILE, page(&folder, &manifest)?)?;
                results.finish()?;
                finished.page = Some(folder.join(FILE));
            }
        }
    }
    finished.said.extend(replaced);
    Ok(finished)
}

/// What was asked for the results in `folder`.
fn manifest_of(folder: &Path) -> Result<Value> {
    manifest::read(folder).ok_or_else(|| {
        let reason =
            format!("holds no {MANIFEST} that can be read; expected a folder of results, such as out/CASE/run");
        Error::io(folder.display(), reason, true)
    })
}

/// Why the results in `path` get no report beside them, although their command writes one, and what
/// to do: their tables are too large for a page. `None` where they are not.
///
/// # Errors
/// [`Error::Io`] where a table cannot be read.
pub fn too_large(path: &Path, manifest: &Value) -> Result<Option<String>> {
    match manifest["request"]["command"].as_str() {
        Some("sweep") => {
            Ok(sweep::too_large(&Folder { path, manifest })?.map(|reason| sweep::without_page(path, &reason)))
        }
        _ => Ok(None),
    }
}

/// The report on the results in `path`, of which `manifest` says what was asked: an HTML page.
///
/// # Errors
/// [`Error::Io`], a wrong request, where the folder holds the results of a command that has no
/// report, or results that are not finished, or where one of its files is missing, was changed or
/// is not what that command writes.
pub fn page(path: &Path, manifest: &Value) -> Result<String> {
    page_of(&Folder { path, manifest }, None)
}

/// The same page with the results in `other`, a path and its manifest, in its figures.
///
/// # Errors
/// As [`page`], and where the other results do not go into the figures of the page.
pub fn page_over(path: &Path, manifest: &Value, other: (&Path, &Value)) -> Result<String> {
    page_of(&Folder { path, manifest }, Some(&Folder { path: other.0, manifest: other.1 }))
}

fn page_of(folder: &Folder<'_>, other: Option<&Folder<'_>>) -> Result<String> {
    for folder in [Some(folder), other].into_iter().flatten() {
        if !manifest::is_finished(folder.manifest) {
            let reason = "its results are not finished: a run was interrupted, or is still at work\n\
                          help: the same command writes them again, a sweep and wear go on";
            return Err(Error::io(folder.path.display(), reason, true));
        }
    }
    let (path, manifest) = (folder.path, folder.manifest);
    let command = manifest["request"]["command"].as_str().unwrap_or_default();
    let mut contents = match command {
        "run" => run::contents(folder)?,
        "compare" => compare::contents(folder)?,
        "chart" => chart::contents(folder)?,
        "stability" => stability::contents(folder)?,
        "sweep" => sweep::contents(folder)?,
        "orbit" => orbit::contents(folder)?,
        "continue" => branches::contents(folder)?,
        "wear" => wear::contents(folder)?,
        other => {
            let reason = format!(
                "holds results of {other:?}, which has no report\n\
                 help: there is one of run, compare, chart, stability, sweep, orbit, continue and wear"
            );
            return Err(Error::io(path.display(), reason, true));
        }
    };
    if let Some(other) = other {
        over::add(&mut contents, command, other, &other.path.display().to_string())?;
    }
    let word = |key: &str| manifest[key].as_str();
    let name = manifest["request"]["case"].as_str().unwrap_or(command);
    let titles = [contents["title"].as_str(), word("title")];
    let title = titles.into_iter().flatten().find(|title| !title.is_empty()).unwrap_or(name).to_owned();
    let mut data = Map::new();
    data.insert("kind".to_owned(), json!(command));
    data.insert("program".to_owned(), json!(word("program").unwrap_or("signorini")));
    data.insert("name".to_owned(), json!(name));
    data.insert("command".to_owned(), json!(word("command_line")));
    if let Value::Object(contents) = contents {
        data.extend(contents);
    }
    data.insert("title".to_owned(), json!(title));
    let mut data = Value::Object(data);
    paths::shorten(&mut data);
    html::file(&title, &data)
}
