//! Joins shards into the files of the whole sweep, with the same bytes as without shards. The
//! tables of the shards are those that were recorded when they were written, or nothing is written.

use super::attractors::{ATTRACTORS, Joined};
use super::finish::{Columns, Tables};
use super::folder::{self, Study, wrong};
use super::picture::Picture;
use super::seeds::asked;
use super::shard::Shard;
use super::table::{REALISATIONS, SAMPLES, TABLE, cells_of};
use crate::case::open_regular;
use crate::error::{Error, Result};
use crate::order::sort_by_number;
use crate::output::atomic::WholeFile;
use crate::output::format::Formats;
use crate::output::manifest;
use crate::output::results::Results;
use crate::study::realisations::RealisationCount;
use serde_json::{Map, Value};
use std::fs::File;
use std::io::{BufRead, BufReader, Take, Write};
use std::path::{Path, PathBuf};

/// The result of a merge.
#[derive(Debug, Clone, PartialEq)]
#[non_exhaustive]
pub struct Merged {
    /// Number of rows.
    pub rows: u64,
    /// Number of shards.
    pub shards: usize,
    /// Number of rows by status.
    pub tables: Tables,
    /// The request of the whole sweep.
    pub(crate) request: Map<String, Value>,
    /// Its title, and its picture.
    pub title: String,
    /// What it shows.
    pub picture: Picture,
    /// True if the shards were computed with mathematical libraries that differ in their last bits.
    pub differing_arithmetic: bool,
    /// The shards of a version that recorded nothing of its tables, so that only their numbers of
    /// rows were checked.
    pub unverified: Vec<PathBuf>,
}

/// One shard, in its folder.
struct Part {
    folder: PathBuf,
    shard: Shard,
    request: Map<String, Value>,
    arithmetic: Value,
    study: Study,
    finished: bool,
    manifest: Value,
}

impl Part {
    fn read(folder: &Path) -> Result<Self> {
        let manifest = manifest::read(folder)
            .ok_or_else(|| wrong(folder, "not a shard of a sweep: it has no request.json".to_owned()))?;
        let mut request = manifest["request"].as_object().cloned().unwrap_or_default();
        if request.get("command").and_then(Value::as_str) != Some("sweep") {
            return Err(wrong(folder, "not a shard of a sweep: it holds results of another command".to_owned()));
        }
        let shard: Shard = match request.remove("shard") {
            Some(shard) => shard.as_str().unwrap_or_default().parse()?,
            None => Shard::WHOLE,
        };
        let finished = manifest::is_finished(&manifest) && manifest::files(&manifest).any(|file| file == TABLE);
        Ok(Self {
            folder: folder.to_owned(),
            shard,
            request,
            arithmetic: manifest["arithmetic"].clone(),
            study: Study::read(&manifest),
            finished,
            manifest,
        })
    }
}

/// The folders of shards: each of `folders` is one, or contains some.
fn expanded(folders: &[PathBuf]) -> Result<Vec<PathBuf>> {
    let mut all = Vec::new();
    for folder in folders {
        if manifest::read(folder).is_some() {
            all.push(folder.clone());
            continue;
        }
        let expected = "expected a shard of a sweep, or a folder that holds shards";
        let entries =
            std::fs::read_dir(folder).map_err(|error| wrong(folder, format!("not a folder ({error}); {expected}")))?;
        let mut within: Vec<PathBuf> = entries
            .filter_map(|entry| Some(entry.ok()?.path()))
            .filter(|path| path.file_name().is_some_and(|name| name.to_string_lossy().starts_with("shard-")))
            .collect();
        if within.is_empty() {
            return Err(wrong(folder, "not a shard of a sweep, and contains none".to_owned()));
        }
        within.sort();
        all.append(&mut within);
    }
    Ok(all)
}

/// Joins the shards in `folders`, and writes the result to `out`.
///
/// # Errors
/// [`Error::Io`] (a wrong request) for a shard that is missing, unfinished, given twice or of
/// another request, for one with a table that is no longer as it was written, and for an `out` to
/// which another process writes; [`Error::OtherResults`]. Nothing is written then.
pub fn merge(folders: &[PathBuf], out: &Path, force: bool) -> Result<Merged> {
    merge_in(folders, out, force, Formats::default()).map(|(merged, _)| merged)
}

/// As [`merge`]; also returns the folder, where files can be added in `formats`.
pub(crate) fn merge_in(folders: &[PathBuf], out: &Path, force: bool, formats: Formats) -> Result<(Merged, Results)> {
    let mut parts = expanded(folders)?.iter().map(|folder| Part::read(folder)).collect::<Result<Vec<_>>>()?;
    sort_by_number(&mut parts, |part| part.shard.index() as f64);
    let first = parts.first().ok_or_else(|| Error::invalid("merge", "nothing", "the folders of shards"))?;
    check_parts(&parts, first, folders)?;
    let request = first.request.clone();
    let number = |key: &str| request.get(key).and_then(Value::as_u64).filter(|x| *x > 0);
    let (Some(rows), Some(length)) = (number("rows"), number("rows_of_a_chain")) else {
        return Err(wrong(&first.folder, "its request.json does not say how many rows there are".to_owned()));
    };
    // The tables, and how many lines of each a row has, where that is known.
    let mut names = vec![(TABLE, Some(1))];
    // Where the interval of a row decides, nothing else says how many it has.
    let runs = asked(&request).map(|count| match count {
        RealisationCount::Exactly(count) => Some(count),
        RealisationCount::Within { .. } => None,
    });
    names.extend(runs.map(|runs| (REALISATIONS, runs)));
    names.extend(request.get("sample_columns").filter(|columns| columns.is_array()).map(|_| (SAMPLES, None)));
    let mut unverified = Vec::new();
    for part in &parts {
        if folder::verified(&part.folder, &part.manifest)?.is_empty() {
            unverified.push(part.folder.clone());
        }
    }
    let mut results = Results::open(out, request.clone(), force, formats)?;
    let mut study = first.study.clone();
    // Of each shard's runs, where they are not of the case.
    for note in parts.iter().flat_map(|part| &part.study.notes) {
        if !study.notes.contains(note) {
            study.notes.push(note.clone());
        }
    }
    folder::record_request(&mut results, &study, Shard::WHOLE);
    let tables = tables(&parts, &mut results, (rows, length), &names)?;
    results.finish()?;
    let differing_arithmetic = parts.iter().any(|part| part.arithmetic != first.arithmetic);
    let Study { title, picture, .. } = study;
    let shards = parts.len();
    Ok((Merged { rows, shards, tables, request, title, picture, differing_arithmetic, unverified }, results))
}

/// Refuses parts, sorted by their shards, that are not those of `first`, not finished, given twice
/// or not all in `folders`.
fn check_parts(parts: &[Part], first: &Part, folders: &[PathBuf]) -> Result<()> {
    let of = first.shard.of();
    for part in parts {
        if let Some(what) = manifest::differences(Some(&Value::Object(first.request.clone())), &part.request) {
            return Err(wrong(
                &part.folder,
                format!("a shard of another request than {}:{what}", first.folder.display()),
            ));
        }
        if part.shard.of() != of {
            let reason = format!("a shard of {}, where {} is one of {of}", part.shard.of(), first.folder.display());
            return Err(wrong(&part.folder, reason));
        }
        if !part.finished {
            let reason = format!(
                "shard {} is not finished: give the command that began it again, which continues it",
                part.shard
            );
            return Err(wrong(&part.folder, reason));
        }
    }
    if let Some(twice) = parts.windows(2).find(|pair| matches!(pair, [a, b] if a.shard == b.shard)) {
        let folders: Vec<_> = twice.iter().map(|part| part.folder.display().to_string()).collect();
        return Err(wrong(
            &twice[0].folder,
            format!("shard {} is given twice: {}", twice[0].shard, folders.join(" and ")),
        ));
    }
    let missing: Vec<String> = (1..=of)
        .filter(|index| parts.iter().all(|part| part.shard.index() != *index))
        .map(|index| format!("{index}/{of}"))
        .collect();
    if !missing.is_empty() {
        let shown = missing.iter().take(20).cloned().collect::<Vec<_>>().join(", ");
        let more = if missing.len() > 20 { ", …" } else { "" };
        let folders: Vec<_> = folders.iter().map(|folder| folder.display().to_string()).collect();
        let reason = format!("{} of {of} shards are missing: {shown}{more}", missing.len());
        return Err(wrong(Path::new(&folders.join(", ")), reason));
    }
    Ok(())
}

/// Lines of one file, each with the number of its row.
struct Lines {
    path: PathBuf,
    reader: BufReader<Take<File>>,
    line: Vec<u8>,
}

impl Lines {
    /// Opens the file; the header is the first line.
    fn open(path: PathBuf) -> Result<Self> {
        let (file, _) = open_regular(&path).map_err(|reason| wrong(&path, reason))?;
        let mut lines = Self { path, reader: BufReader::with_capacity(1 << 16, file), line: Vec::new() };
        lines.next()?;
        Ok(lines)
    }

    fn next(&mut self) -> Result<()> {
        self.line.clear();
        let read = self.reader.read_until(b'\n', &mut self.line);
        read.map(drop).map_err(|error| wrong(&self.path, error.to_string()))
    }

    /// The row of the current line; `None` at the end.
    fn row(&self) -> Option<u64> {
        let cell = self.line.split(|&b| b == b',').next()?;
        std::str::from_utf8(cell).ok()?.parse().ok()
    }
}

/// Joins the tables of `names`, of so many `rows` in chains of that `length`, each with the number
/// of lines that a row has.
fn tables(
    parts: &[Part],
    results: &mut Results,
    (rows, length): (u64, u64),
    names: &[(&str, Option<u64>)],
) -> Result<Tables> {
    let failed = |path: &Path, error: &std::io::Error| Error::io(path.display(), error.to_string(), false);
    let open = |name: &str| parts.iter().map(|part| Lines::open(part.folder.join(name))).collect::<Result<Vec<_>>>();
    let folders: Vec<&Path> = parts.iter().map(|part| part.folder.as_path()).collect();
    let mut tables = Tables::default();
    for &(name, expected) in names {
        let mut sources = open(name)?;
        let mut file = WholeFile::create(&results.place(name)?)?;
        let header = sources.first().map(|lines| lines.line.clone()).unwrap_or_default();
        let columns = Columns::of(&cells_of(&header));
        let mut joined = if name == TABLE { Joined::of(&cells_of(&header), &folders)? } else { None };
        file.write_all(&header).map_err(|error| failed(file.path(), &error))?;
        sources.iter_mut().try_for_each(Lines::next)?;
        for row in 0..rows {
            let shard = (row / length) % parts.len() as u64;
            let Some(lines) = sources.get_mut(shard as usize) else { continue };
            let mut found = 0;
            while lines.row() == Some(row) {
                let mut numbered = None;
                if name == TABLE {
                    let record = cells_of(&lines.line);
                    columns.count(&record, &mut tables);
                    numbered = joined.as_mut().and_then(|joined| joined.line(shard as usize, &record));
                }
                let line = numbered.as_ref().unwrap_or(&lines.line);
                file.write_all(line).map_err(|error| failed(file.path(), &error))?;
                found += 1;
                lines.next()?;
            }
            if let Some(expected) = expected.filter(|expected| found != *expected) {
                let reason = format!("row {row} is there {found} times, not {expected}");
                return Err(wrong(&lines.path, reason));
            }
        }
        if let Some(left) = sources.iter().find(|lines| !lines.line.is_empty()) {
            let line = String::from_utf8_lossy(left.line.split(|&b| b == b',').next().unwrap_or_default()).into_owned();
            return Err(wrong(&left.path, format!("a line of row {line:?} stands where none belongs")));
        }
        if let Some(joined) = joined {
            joined.all.write(&results.place(ATTRACTORS)?, rows)?;
        }
        file.finish()?;
    }
    Ok(tables)
}
