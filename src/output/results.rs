//! The folder that holds the results of a request. Results of another request are not overwritten
//! unless that is asked for.
//!
//! `request.json` in the folder says what was asked, when it was done, and which files belong to
//! it.

use super::atomic::{check_folder, write_whole};
use super::format::Format;
use super::values::{VALUES, differing, shown};
use crate::error::{Error, Result};
use serde_json::{Map, Value, json};
use std::fs;
use std::path::{Component, Path, PathBuf};
use std::time::SystemTime;

/// The file that describes the contents of a folder.
pub(crate) const MANIFEST: &str = "request.json";

/// Largest manifest that is read, bytes.
const MOST_BYTES: u64 = 1 << 24;

/// Files that results consist of: a folder with one of them but no manifest holds results of an
/// unknown request.
const RESULTS: [&str; 9] = [
    "summary.json",
    "trajectory.csv",
    "compare.csv",
    "work-precision.csv",
    "stability.csv",
    "impact-map.csv",
    "sweep.csv",
    "orbit.json",
    "branches.csv",
];

/// A folder of results that is being written.
#[derive(Debug)]
pub struct Results {
    folder: PathBuf,
    request: Map<String, Value>,
    /// File formats of pictures.
    formats: Vec<Format>,
    /// When the results already in the folder were made, and their files.
    before: Option<Before>,
    files: Vec<String>,
    /// Further entries of the manifest, which do not affect what may be replaced.
    told: Map<String, Value>,
}

#[derive(Debug, Default)]
struct Before {
    made: Option<String>,
    files: Vec<String>,
}

impl Results {
    /// Checks that `folder` can be written and holds no results of another request than `request`.
    /// Call it before a long run rather than find out afterwards. With `force` the folder may hold
    /// anything. Pictures are written in each of `formats`.
    ///
    /// # Errors
    /// [`Error::Io`], marked as a wrong request; it says when the other results were made and what
    /// differs.
    pub fn open(folder: &Path, request: Map<String, Value>, force: bool, formats: Vec<Format>) -> Result<Self> {
        if !force {
            check(folder, &request)?;
        }
        let manifest = read(folder);
        check_folder(folder)?;
        let unknown = || RESULTS.iter().any(|name| folder.join(name).exists()).then(Before::default);
        let before = manifest.as_ref().map_or_else(unknown, |manifest| {
            let listed = manifest.get("files").and_then(Value::as_array).into_iter().flatten();
            let files = listed.filter_map(|name| name.as_str().map(str::to_owned)).collect();
            Some(Before { made: made(manifest).map(str::to_owned), files })
        });
        Ok(Self { folder: folder.to_owned(), request, formats, before, files: Vec::new(), told: Map::new() })
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

    /// The path for a file that belongs to the results; `name` may include folders.
    ///
    /// # Errors
    /// [`Error::Io`] where the older manifest cannot be removed: once a file is replaced it would
    /// no longer be true.
    pub fn place(&mut self, name: &str) -> Result<PathBuf> {
        if self.files.is_empty() {
            let manifest = self.folder.join(MANIFEST);
            match fs::remove_file(&manifest) {
                Err(error) if error.kind() != std::io::ErrorKind::NotFound => return Err(failure(&manifest, error)),
                _ => {}
            }
        }
        self.files.push(name.to_owned());
        Ok(self.folder.join(name))
    }

    /// Writes the picture `svg` in each format asked for, as `name` with the extension of the
    /// format; `name` may include folders. Returns the paths.
    ///
    /// # Errors
    /// As [`Results::place`] and [`Format::write`].
    pub fn draw(&mut self, name: &str, svg: &str) -> Result<Vec<PathBuf>> {
        let mut paths = Vec::new();
        for format in self.formats.clone() {
            let path = self.place(&format!("{name}.{format}"))?;
            format.write(&path, svg)?;
            paths.push(path);
        }
        Ok(paths)
    }

    /// Adds `value` to the manifest as `key`, beside the request.
    pub fn tell(&mut self, key: &str, value: Value) {
        self.told.insert(key.to_owned(), value);
    }

    /// The manifest: what was asked, when it was done, and which files belong to it.
    #[must_use]
    pub fn manifest(&self) -> Value {
        let mut manifest = Map::new();
        manifest.insert("program".to_owned(), json!(format!("signorini {}", env!("CARGO_PKG_VERSION"))));
        let made = humantime::format_rfc3339_seconds(SystemTime::now()).to_string();
        manifest.insert("made".to_owned(), json!(made));
        manifest.extend(self.told.clone());
        manifest.insert("request".to_owned(), json!(self.request));
        manifest.insert("files".to_owned(), json!(self.files));
        Value::Object(manifest)
    }

    /// Writes the manifest and removes what is left of the earlier results. Returns the sentence
    /// that says what was replaced, if anything was.
    ///
    /// # Errors
    /// [`Error::Io`] where the manifest cannot be written.
    pub fn finish(&self) -> Result<Option<String>> {
        if let Some(before) = &self.before {
            before.files.iter().filter(|name| !self.files.contains(name)).for_each(|name| self.take_away(name));
        }
        let manifest = self.manifest();
        write_whole(&self.folder.join(MANIFEST), format!("{manifest:#}\n").as_bytes())?;
        let replaced = |before: &Before| {
            let made = before.made.as_deref().map_or_else(String::new, |time| format!(", made {time}"));
            format!("replaced the results in {}{made}", self.folder.display())
        };
        Ok(self.before.as_ref().map(replaced))
    }

    /// Removes a file of the earlier results, and its folder if that is then empty. The manifest
    /// may name any path, so nothing outside the folder is touched. A file that cannot be removed
    /// stays.
    fn take_away(&self, name: &str) {
        let path = Path::new(name);
        if name.is_empty() || !path.components().all(|part| matches!(part, Component::Normal(_))) {
            return;
        }
        let linked = |path: &Path| fs::symlink_metadata(self.folder.join(path)).is_ok_and(|meta| meta.is_symlink());
        if path.ancestors().skip(1).any(|folder| !folder.as_os_str().is_empty() && linked(folder)) {
            return;
        }
        let _ = fs::remove_file(self.folder.join(path));
        for folder in path.ancestors().skip(1).filter(|folder| !folder.as_os_str().is_empty()) {
            // This removes empty folders only.
            let _ = fs::remove_dir(self.folder.join(folder));
        }
    }
}

/// Checks that `folder` holds no results of another request than `request`.
///
/// # Errors
/// [`Error::Io`], marked as a wrong request; it says when the other results were made and what
/// differs.
pub(crate) fn check(folder: &Path, request: &Map<String, Value>) -> Result<()> {
    let refused = match read(folder) {
        Some(other) => differences(other.get("request"), request).map(|what| {
            format!("holds results of another request, made {}:{what}", made(&other).unwrap_or("at some time"))
        }),
        None => RESULTS
            .iter()
            .find(|name| folder.join(name).exists())
            .map(|name| format!("holds results ({name}) but no {MANIFEST} that says which request made them")),
    };
    match refused {
        Some(reason) => {
            let reason = format!("{reason}\nhelp: --force replaces them, --out DIR writes elsewhere");
            Err(Error::io(folder.display(), reason, true))
        }
        None => Ok(()),
    }
}

/// The manifest in `folder`, if there is one that can be read.
pub(crate) fn read(folder: &Path) -> Option<Value> {
    let path = folder.join(MANIFEST);
    let meta = fs::metadata(&path).ok().filter(|meta| meta.is_file() && meta.len() <= MOST_BYTES)?;
    let text = fs::read_to_string(&path).ok().filter(|_| meta.len() > 0)?;
    serde_json::from_str(&text).ok()
}

fn made(manifest: &Value) -> Option<&str> {
    manifest.get("made").and_then(Value::as_str)
}

/// Adds the file `name` to those that `manifest`, the manifest in `folder`, lists.
///
/// # Errors
/// [`Error::Io`] where it cannot be written.
pub(crate) fn list(folder: &Path, mut manifest: Value, name: &str) -> Result<()> {
    let Some(files) =
        manifest.get_mut("files").and_then(Value::as_array_mut).filter(|files| !files.iter().any(|file| file == name))
    else {
        return Ok(());
    };
    files.push(json!(name));
    write_whole(&folder.join(MANIFEST), format!("{manifest:#}\n").as_bytes())
}

/// How `request` differs from `other`, one line per difference; `None` where both ask the same.
pub(crate) fn differences(other: Option<&Value>, request: &Map<String, Value>) -> Option<String> {
    let empty = Map::new();
    let other = other.and_then(Value::as_object).unwrap_or(&empty);
    let keys = other.keys().chain(request.keys().filter(|key| !other.contains_key(*key)));
    let (mut lines, mut parts) = (Vec::new(), Vec::new());
    for key in keys.filter(|key| other.get(*key).unwrap_or(&Value::Null) != request.get(*key).unwrap_or(&Value::Null)) {
        // A fingerprint shows that something differs; its digits mean nothing to the reader.
        match key.strip_suffix(FINGERPRINT) {
            Some(what) => parts.push(what),
            None if key == VALUES => {}
            None => lines.push(format!(
                "{key}: {} there, {} asked",
                shown(other.get(key).or(Some(&Value::Null))),
                shown(request.get(key).or(Some(&Value::Null)))
            )),
        }
    }
    let (values, unnamed) = differing(&parts, other, request);
    lines.extend(values);
    lines.extend(unnamed.iter().map(|part| format!("another {}", part.replace('_', " "))));
    (!lines.is_empty()).then(|| lines.iter().map(|line| format!("\n  {line}")).collect())
}

/// Suffix of the keys that hold fingerprints.
pub const FINGERPRINT: &str = "_fingerprint";

fn failure(path: &Path, error: std::io::Error) -> Error {
    Error::io(path.display(), error.to_string(), false).caused_by(error)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn request(end: f64) -> Map<String, Value> {
        let value = json!({ "command": "run", "end_s": end, "walls_fingerprint": format!("{end}") });
        value.as_object().cloned().unwrap_or_default()
    }

    fn fill(folder: &Path, end: f64, force: bool, name: &str) -> Result<Option<String>> {
        let mut results = Results::open(folder, request(end), force, Vec::new())?;
        let path = results.place(name)?;
        write_whole(&path, b"1")?;
        results.finish()
    }

    #[test]
    fn results_of_another_request_stay_unless_forced() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path();
        assert_eq!(fill(path, 10.0, false, "method/summary.json").unwrap(), None);
        let refused = fill(path, 1.0, false, "other.csv").unwrap_err();
        assert!(refused.is_request());
        let text = refused.to_string();
        for words in ["made 20", "end_s: 10 there, 1 asked", "another walls", "--force", "--out"] {
            assert!(text.contains(words), "{words}: {text}");
        }
        assert!(path.join("method/summary.json").exists());
        // The same request replaces, and says what.
        let replaced = fill(path, 10.0, false, "method/summary.json").unwrap();
        assert!(replaced.is_some_and(|text| text.contains("made 20")));
        // Forced, nothing of the other request is left beside the new files.
        fill(path, 1.0, true, "other.csv").unwrap();
        assert!(path.join("other.csv").exists() && !path.join("method").exists());
    }

    #[test]
    fn results_without_a_manifest_are_those_of_an_unknown_request() {
        let folder = tempfile::tempdir().unwrap();
        fs::write(folder.path().join("summary.json"), "{}").unwrap();
        assert!(fill(folder.path(), 1.0, false, "a.csv").unwrap_err().to_string().contains("summary.json"));
        fs::write(folder.path().join(MANIFEST), "no JSON").unwrap();
        assert!(fill(folder.path(), 1.0, false, "a.csv").is_err());
        assert!(fill(folder.path(), 1.0, true, "a.csv").unwrap().is_some());
    }

    #[test]
    fn a_manifest_takes_nothing_away_outside_its_folder() {
        let root = tempfile::tempdir().unwrap();
        let folder = root.path().join("results");
        let precious = root.path().join("precious");
        fs::create_dir(&folder).unwrap();
        fs::write(&precious, "1").unwrap();
        let files = json!({ "files": ["../precious", precious.display().to_string(), "", "."] });
        fs::write(folder.join(MANIFEST), files.to_string()).unwrap();
        fill(&folder, 1.0, true, "a.csv").unwrap();
        assert!(precious.exists() && folder.join("a.csv").exists());
    }
}
