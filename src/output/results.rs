//! The folder that holds the results of a request. Results of another request are not overwritten
//! unless that is asked for.
//!
//! One process at a time writes into a folder. Files are first written into a folder of their own
//! within it, onto the disk; only when all are there do they take the places of earlier results,
//! and then `request.json` says what was asked, when it was done, which files belong to it, and
//! what is recorded of each table and document. An interruption before that leaves the earlier
//! results as they were. One amidst it leaves a manifest that says so, and the same request
//! replaces everything that it lists.

mod earlier;
mod stage;
#[cfg(test)]
mod tests;
#[cfg(feature = "xlsx")]
mod workbook;

use super::atomic::{check_folder, remove_abandoned, sync_files, sync_folder, write_whole};
use super::format::Formats;
use super::lock::Lock;
use super::manifest::{self, UNFINISHED};
use super::record::{DOCUMENTS, Record, TABLES};
use super::request::program;
use crate::error::{Error, Result};
use earlier::{EarlierResults, take_away};
use serde_json::{Map, Value, json};
use stage::Stage;
use std::collections::{BTreeMap, BTreeSet};
use std::ffi::OsStr;
use std::fs;
use std::path::{Path, PathBuf};
use std::time::SystemTime;

/// A folder of results that is being written.
#[derive(Debug)]
pub struct Results {
    folder: PathBuf,
    request: Map<String, Value>,
    formats: Formats,
    /// The results already in the folder.
    earlier: Option<EarlierResults>,
    files: Vec<String>,
    /// Number of `files`, the first ones, that are in their places.
    placed: usize,
    /// True once the manifest says that the files in their places are whole.
    finished: bool,
    tables: BTreeMap<String, Record>,
    documents: BTreeMap<String, Record>,
    /// Further entries of the manifest, which do not affect what may be replaced.
    told: Map<String, Value>,
    /// The file from which this request goes on after an interruption.
    journal: Option<String>,
    /// True where it stays beside the finished results.
    journal_stays: bool,
    /// Folders in which folders were made that lead to this one.
    entered: Vec<PathBuf>,
    stage: Stage,
    _lock: Lock,
}

impl Results {
    /// Checks that `folder` can be written and holds no results of another request than `request`,
    /// and keeps other processes from writing there. Call it before a long run rather than find out
    /// afterwards. With `force` the folder may hold anything. Pictures and tables are written in
    /// `formats`.
    ///
    /// # Errors
    /// [`Error::OtherResults`]; [`Error::Io`], marked as a wrong request, for a folder that cannot
    /// be written, or in which another process is at work.
    pub fn open(folder: &Path, request: Map<String, Value>, force: bool, formats: Formats) -> Result<Self> {
        Self::open_growing(folder, request, None, force, formats)
    }

    /// As [`Results::open`]; with `growing`, a key of the request, the folder may also hold results
    /// of the same request with a smaller number there, from which this one goes on.
    ///
    /// # Errors
    /// As [`Results::open`].
    pub(crate) fn open_growing(
        folder: &Path,
        request: Map<String, Value>,
        growing: Option<&str>,
        force: bool,
        formats: Formats,
    ) -> Result<Self> {
        let check = || if force { Ok(()) } else { manifest::check(folder, &request, growing) };
        check()?;
        let absent = folder.ancestors().take_while(|ancestor| !ancestor.as_os_str().is_empty() && !ancestor.exists());
        let entered = absent.filter_map(Path::parent).map(Path::to_owned).collect();
        check_folder(folder)?;
        let lock = Lock::take(folder)?;
        // Another process may have been at work in between.
        check()?;
        remove_abandoned(folder, None);
        Ok(Self {
            folder: folder.to_owned(),
            request,
            formats,
            earlier: EarlierResults::of(folder),
            files: Vec::new(),
            placed: 0,
            finished: false,
            tables: BTreeMap::new(),
            documents: BTreeMap::new(),
            told: Map::new(),
            journal: None,
            journal_stays: false,
            entered,
            stage: Stage::of(folder),
            _lock: lock,
        })
    }

    /// The folder.
    #[must_use]
    pub fn folder(&self) -> &Path {
        &self.folder
    }

    /// Paths of the files written so far, relative to the folder.
    #[must_use]
    pub fn files(&self) -> &[String] {
        &self.files
    }

    /// The path to write a file to that belongs to the results; `name`, its path in the folder, may
    /// include folders. [`Results::finish`] moves it there.
    ///
    /// # Errors
    /// [`Error::Io`], marked as a wrong request, where there is a folder of that name.
    pub fn place(&mut self, name: &str) -> Result<PathBuf> {
        let place = self.folder.join(name);
        if place.is_dir() {
            return Err(Error::io(place.display(), "this is a folder, where a file is to be written", true));
        }
        self.files.push(name.to_owned());
        Ok(self.staged(name))
    }

    /// Writes `bytes` as the file `name`, as [`Results::place`] places it.
    ///
    /// # Errors
    /// As [`Results::place`].
    pub fn write(&mut self, name: &str, bytes: impl AsRef<[u8]>) -> Result<()> {
        write_whole(&self.place(name)?, bytes.as_ref())
    }

    fn staged(&self, name: &str) -> PathBuf {
        self.stage.place(name)
    }

    /// Writes the picture `svg` in each format asked for, as `name` with the extension of the
    /// format; `name` may include folders. Returns the paths that they get.
    ///
    /// # Errors
    /// As [`Results::place`] and [`Format::write`].
    pub fn draw(&mut self, name: &str, svg: &str) -> Result<Vec<PathBuf>> {
        let mut paths = Vec::new();
        for format in self.formats.pictures.clone() {
            let name = format!("{name}.{format}");
            format.write(&self.place(&name)?, svg)?;
            paths.push(self.folder.join(name));
        }
        Ok(paths)
    }

    /// Adds `value` to the manifest as `key`, beside the request.
    pub fn add_to_manifest(&mut self, key: &str, value: Value) {
        self.told.insert(key.to_owned(), value);
    }

    /// The manifest: what was asked, when it was done, which files belong to it, and what is
    /// recorded of its tables and documents.
    #[must_use]
    pub fn manifest(&self) -> Value {
        let mut manifest = Map::new();
        manifest.insert("program".to_owned(), json!(program()));
        let made = humantime::format_rfc3339_seconds(SystemTime::now()).to_string();
        manifest.insert("made".to_owned(), json!(made));
        manifest.extend(self.told.clone());
        manifest.insert("request".to_owned(), json!(self.request));
        let journal = self.journal.iter().filter(|_| self.journal_stays);
        manifest.insert("files".to_owned(), json!(self.files.iter().chain(journal).collect::<Vec<_>>()));
        manifest.insert(TABLES.to_owned(), json!(self.tables));
        manifest.insert(DOCUMENTS.to_owned(), json!(self.documents));
        Value::Object(manifest)
    }

    /// What is recorded of the tables written so far in the folder `prefix` of the results (empty
    /// for these themselves), by their names there: rows, bytes, and the SHA-256.
    ///
    /// # Errors
    /// [`Error::Io`] where one cannot be read.
    pub fn tables(&mut self, prefix: &str) -> Result<Value> {
        self.record()?;
        let within = |name: &str| match prefix {
            "" => Some(name.to_owned()),
            prefix => name.strip_prefix(prefix)?.strip_prefix('/').map(str::to_owned),
        };
        Ok(self.tables.iter().filter_map(|(name, record)| Some((within(name)?, json!(record)))).collect())
    }

    fn record(&mut self) -> Result<()> {
        for name in self.files.iter().skip(self.placed) {
            let records = match Path::new(name).extension().and_then(OsStr::to_str) {
                Some("csv") => &mut self.tables,
                Some("json") => &mut self.documents,
                _ => continue,
            };
            if !records.contains_key(name) {
                let path = self.stage.place(name);
                let record = fs::File::open(&path).and_then(Record::of).map_err(|error| failure(&path, error))?;
                records.insert(name.clone(), record);
            }
        }
        Ok(())
    }

    /// Writes the workbooks that are asked for: `tables.xlsx` in each folder that has tables, from
    /// these as they stand. Returns a sentence for each table that no sheet can hold. `progress` is
    /// called with the share of the work that is done.
    ///
    /// # Errors
    /// [`Error::Io`] where a table cannot be read or a workbook cannot be written, and as
    /// [`Formats::checked`].
    #[cfg_attr(not(feature = "xlsx"), expect(unused_variables, reason = "there is no workbook"))]
    pub fn write_workbooks(&mut self, progress: &mut (dyn FnMut(f64) + Send)) -> Result<Vec<String>> {
        match self.formats.clone().checked()?.workbook {
            #[cfg(feature = "xlsx")]
            true => self.write_sheets(progress),
            _ => Ok(Vec::new()),
        }
    }

    /// Records the request in the folder, with the file `journal` in it, from which the request
    /// goes on after an interruption, and which [`Results::finish`] removes last.
    pub(crate) fn begin(&mut self, journal: &str) -> Result<()> {
        self.journal = Some(journal.to_owned());
        self.write_unfinished()
    }

    /// As [`Results::begin`], with a journal that stays beside the finished results: a larger
    /// request can go on from there.
    ///
    /// # Errors
    /// As [`Results::begin`].
    pub(crate) fn begin_and_keep(&mut self, journal: &str) -> Result<()> {
        self.journal_stays = true;
        self.begin(journal)
    }

    /// The manifest from the first change in the folder to the last: with the files of the earlier
    /// results, which are still to be removed.
    fn write_unfinished(&self) -> Result<()> {
        let earlier = self.earlier.iter().flat_map(|earlier| &earlier.files).filter(|name| !self.is_own(name));
        let files: Vec<&String> = self.files.iter().chain(&self.journal).chain(earlier).collect();
        let mut manifest = self.manifest();
        manifest["files"] = json!(files);
        manifest[UNFINISHED] = json!(true);
        manifest::write(&self.folder, &manifest)?;
        self.entered.iter().try_for_each(|folder| sync_folder(folder))
    }

    /// True if `name` is a file of these results, or their journal.
    fn is_own(&self, name: &String) -> bool {
        self.files.contains(name) || self.journal.as_ref() == Some(name)
    }

    /// Takes over the results of this request in the folder, as they are: those of the tables
    /// `tables`.
    pub(crate) fn keep(&mut self, tables: impl IntoIterator<Item = (String, Record)>) {
        self.tables.extend(tables);
        self.files = self.tables.keys().cloned().collect();
        self.placed = self.files.len();
        self.finished = true;
    }

    /// Moves the files into their places, removes what is left of earlier results, and writes the
    /// manifest; all of that reaches the disk in this order. Returns the sentence that says what
    /// was replaced, if anything was. Files can be added afterwards, and it be called again.
    ///
    /// # Errors
    /// [`Error::Io`] where a file cannot be moved or the manifest cannot be written.
    pub fn finish(&mut self) -> Result<Option<String>> {
        self.record()?;
        let staged: Vec<PathBuf> = self.files.iter().skip(self.placed).map(|name| self.staged(name)).collect();
        sync_files(&staged)?;
        if !self.finished {
            self.write_unfinished()?;
        }
        let mut folders = BTreeSet::new();
        for name in self.files.iter().skip(self.placed) {
            let place = self.folder.join(name);
            let folder = place.parent().unwrap_or(&self.folder).to_owned();
            if !folders.contains(&folder) {
                fs::create_dir_all(&folder).map_err(|error| failure(&folder, error))?;
                remove_abandoned(&folder, None);
            }
            fs::rename(self.staged(name), &place).map_err(|error| failure(&place, error))?;
            folders.insert(folder);
        }
        // The folder itself is written with the manifest.
        folders.iter().filter(|folder| **folder != self.folder).try_for_each(|folder| sync_folder(folder))?;
        self.placed = self.files.len();
        // Results that are taken over are not replaced.
        let (earlier, taken_over) = (self.earlier.take(), self.finished);
        if let Some(earlier) = &earlier {
            earlier.files.iter().filter(|name| !self.is_own(name)).for_each(|name| take_away(&self.folder, name));
        }
        manifest::write(&self.folder, &self.manifest())?;
        if let Some(journal) = self.journal.take_if(|_| !self.journal_stays) {
            // If it cannot be removed, the next process finds the results finished.
            let _ = fs::remove_file(self.folder.join(journal));
        }
        self.finished = true;
        Ok(earlier.filter(|_| !taken_over).map(|earlier| earlier.replaced(&self.folder)))
    }
}

fn failure(path: &Path, error: std::io::Error) -> Error {
    Error::io(path.display(), error.to_string(), false).caused_by(error)
}
