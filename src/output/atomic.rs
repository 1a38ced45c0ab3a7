//! Files that appear whole or not at all: written beside their final place and onto the disk, then
//! renamed into it.

use super::lock::is_at;
use crate::error::{Error, Result};
use std::ffi::OsStr;
use std::fs::{self, File, TryLockError};
use std::io::{self, BufWriter, Write};
use std::path::{Path, PathBuf};
use std::sync::atomic::{AtomicU64, Ordering};

/// Writes `bytes` to `path` and creates the folders that lead there. A reader sees the old file or
/// the whole new one, never a part.
///
/// # Errors
/// [`Error::Io`] with the path and what the operating system said; nothing is left behind then.
///
/// ```
/// # fn main() -> signorini::Result<()> {
/// let folder = std::env::temp_dir().join("signorini-doc-write-whole");
/// signorini::output::atomic::write_whole(&folder.join("a/picture.svg"), b"<svg/>")?;
/// # let _ = std::fs::remove_dir_all(folder);
/// # Ok(())
/// # }
/// ```
pub fn write_whole(path: &Path, bytes: &[u8]) -> Result<()> {
    let mut file = WholeFile::create(path)?;
    file.write_all(bytes).map_err(|e| failure(path, e, false))?;
    file.finish()
}

/// Checks that files can be written into `folder`, and creates it. Call it before a long run rather
/// than find out afterwards.
///
/// # Errors
/// [`Error::Io`], marked as a wrong request.
pub fn check_folder(folder: &Path) -> Result<()> {
    // Opened beside its final place and dropped at once: no file remains.
    WholeFile::create(&folder.join("summary.json")).map(drop)
}

/// A long file that is being written under a temporary name. [`finish`](Self::finish) renames it
/// into place; dropping it before that removes the temporary file.
///
/// Writes are buffered. The file at the final place is untouched until `finish`.
#[derive(Debug)]
pub struct WholeFile {
    /// Where the file will stand.
    path: PathBuf,
    /// Where it is being written.
    partial: Partial,
    /// Buffered handle; `None` once finished.
    writer: Option<BufWriter<File>>,
}

/// The temporary sibling; removed when dropped, unless it has been renamed.
#[derive(Debug)]
struct Partial {
    path: PathBuf,
    kept: bool,
}

impl Drop for Partial {
    fn drop(&mut self) {
        if !self.kept {
            // A failure to remove it cannot be reported from `drop`; its name says what it is.
            let _ = fs::remove_file(&self.path);
        }
    }
}

impl WholeFile {
    /// Opens a temporary sibling of `path`, creating the folders that lead there.
    ///
    /// # Errors
    /// [`Error::Io`], marked as a wrong request: the path asked for cannot be written.
    pub fn create(path: &Path) -> Result<Self> {
        let wrong = |reason: &str| Error::io(shown(path), reason, true);
        let name = path.file_name().ok_or_else(|| wrong("this is not a file name"))?;
        if path.is_dir() {
            return Err(wrong("this is a folder, where a file is to be written"));
        }
        if let Some(folder) = path.parent().filter(|folder| !folder.as_os_str().is_empty()) {
            fs::create_dir_all(folder).map_err(|e| no_folder(folder, e))?;
        }
        remove_abandoned(path.parent().unwrap_or(Path::new("")), Some(name));
        loop {
            let (partial, file) = open_sibling(path, name).map_err(|e| failure(path, e, true))?;
            if let Some(file) = file {
                let partial = Partial { path: partial, kept: false };
                return Ok(Self {
                    path: path.to_owned(),
                    partial,
                    writer: Some(BufWriter::with_capacity(1 << 16, file)),
                });
            }
        }
    }

    /// The place where the file will stand.
    #[must_use]
    pub fn path(&self) -> &Path {
        &self.path
    }

    /// Writes the file onto the disk, unless it is staged, and renames it into its place, so that
    /// after a power failure no empty file has its name. [`sync_folder`] makes the rename itself
    /// last.
    ///
    /// # Errors
    /// [`Error::Io`] when the write or the rename fails; the temporary file is then removed, and an
    /// older file stays as it was.
    pub fn finish(mut self) -> Result<()> {
        if let Some(writer) = self.writer.take() {
            let file = writer.into_inner().map_err(|e| failure(&self.path, e.into_error(), false))?;
            if !self.path.components().any(|part| part.as_os_str() == STAGE) {
                file.sync_all().map_err(|e| failure(&self.path, e, false))?;
            }
        }
        fs::rename(&self.partial.path, &self.path).map_err(|e| failure(&self.path, e, false))?;
        self.partial.kept = true;
        Ok(())
    }
}

impl Write for WholeFile {
    fn write(&mut self, bytes: &[u8]) -> io::Result<usize> {
        self.writer.as_mut().map_or_else(|| Err(io::ErrorKind::NotConnected.into()), |writer| writer.write(bytes))
    }

    fn flush(&mut self) -> io::Result<()> {
        self.writer.as_mut().map_or(Ok(()), BufWriter::flush)
    }
}

/// The folder, within one of results, of files that are not yet in their places: they are staged.
pub(crate) const STAGE: &str = ".signorini.partial";

/// Most files that are written onto the disk at once.
const AT_ONCE: usize = 16;

/// Writes the files at `paths` onto the disk, several at once: a file system puts what it is asked
/// at once into one write.
///
/// # Errors
/// [`Error::Io`] where the disk fails.
pub(crate) fn sync_files(paths: &[PathBuf]) -> Result<()> {
    let sync = |path: &PathBuf| File::open(path).and_then(|file| file.sync_all()).map_err(|e| failure(path, e, false));
    for part in paths.chunks(AT_ONCE) {
        let synced: Vec<Result<()>> = std::thread::scope(|scope| {
            let threads: Vec<_> = part.iter().map(|path| (path, scope.spawn(move || sync(path)))).collect();
            let lost = |path: &Path| Err(failure(path, io::ErrorKind::Other.into(), false));
            threads.into_iter().map(|(path, thread)| thread.join().unwrap_or_else(|_| lost(path))).collect()
        });
        synced.into_iter().collect::<Result<()>>()?;
    }
    Ok(())
}

/// The end of the names of temporary files.
const PARTIAL: &str = ".partial";

/// A new sibling `.NAME.PROCESS-NUMBER.partial`, locked for as long as it is open; `None` in place
/// of the file where that name is taken.
fn open_sibling(path: &Path, name: &OsStr) -> io::Result<(PathBuf, Option<File>)> {
    static NUMBER: AtomicU64 = AtomicU64::new(0);
    let mut sibling = std::ffi::OsString::from(".");
    sibling.push(name);
    sibling.push(format!(".{}-{}{PARTIAL}", std::process::id(), NUMBER.fetch_add(1, Ordering::Relaxed)));
    let sibling = path.with_file_name(sibling);
    match File::create_new(&sibling) {
        Ok(file) => {
            // Another process may have taken it for an abandoned one before it was locked.
            let lost = matches!(file.try_lock(), Err(TryLockError::WouldBlock)) || !is_at(&file, &sibling);
            Ok((sibling, (!lost).then_some(file)))
        }
        Err(e) if e.kind() == io::ErrorKind::AlreadyExists => Ok((sibling, None)),
        Err(e) => Err(e),
    }
}

/// Removes from `folder` the temporary files of [`WholeFile`]s for a file `name`, or for any file,
/// that processes left behind which were killed: those that nobody has locked.
pub(crate) fn remove_abandoned(folder: &Path, name: Option<&OsStr>) {
    let folder = if folder.as_os_str().is_empty() { Path::new(".") } else { folder };
    for entry in fs::read_dir(folder).into_iter().flatten().flatten() {
        let path = entry.path();
        let is_partial =
            entry.file_name().to_str().and_then(target).is_some_and(|of| name.is_none_or(|name| name == of));
        let is_file = entry.file_type().is_ok_and(|kind| kind.is_file());
        if is_partial && is_file && File::open(&path).is_ok_and(|file| file.try_lock().is_ok()) {
            let _ = fs::remove_file(&path);
        }
    }
}

/// The file for which the temporary file of that name is written: `NAME` of
/// `.NAME.PROCESS-NUMBER.partial`.
fn target(partial: &str) -> Option<&str> {
    let (name, number) = partial.strip_prefix('.')?.strip_suffix(PARTIAL)?.rsplit_once('.')?;
    let (process, count) = number.split_once('-')?;
    let is_number = |text: &str| !text.is_empty() && text.bytes().all(|b| b.is_ascii_digit());
    (is_number(process) && is_number(count)).then_some(name)
}

/// Writes the entries of `folder` onto the disk: which files are in it, and under which names.
///
/// # Errors
/// [`Error::Io`] where the disk fails.
pub(crate) fn sync_folder(folder: &Path) -> Result<()> {
    if cfg!(not(unix)) {
        return Ok(());
    }
    let folder = if folder.as_os_str().is_empty() { Path::new(".") } else { folder };
    match File::open(folder).and_then(|file| file.sync_all()) {
        // Some network file systems cannot, and write entries at once.
        Err(e) if matches!(e.kind(), io::ErrorKind::InvalidInput | io::ErrorKind::Unsupported) => Ok(()),
        done => done.map_err(|e| failure(folder, e, false)),
    }
}

fn failure(path: &Path, error: io::Error, request: bool) -> Error {
    Error::io(shown(path), error.to_string(), request).caused_by(error)
}

/// The error for a folder that cannot be created.
fn no_folder(folder: &Path, error: io::Error) -> Error {
    let file = folder.ancestors().find(|path| path.exists() && !path.is_dir());
    let reason = match file {
        Some(file) if file == folder => "this is a file, where a folder for results is expected".to_owned(),
        Some(file) => format!("{} is a file, where a folder is expected", file.display()),
        None => format!("no folder can be made there ({error}); expected one that can be written to"),
    };
    Error::io(shown(folder), reason, true).caused_by(error)
}

fn shown(path: &Path) -> String {
    path.display().to_string()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn names(folder: &Path) -> Vec<String> {
        let mut names: Vec<String> =
            fs::read_dir(folder).unwrap().map(|entry| entry.unwrap().file_name().into_string().unwrap()).collect();
        names.sort();
        names
    }

    #[test]
    fn what_a_killed_process_left_goes_with_the_next_file_of_that_name() {
        let folder = tempfile::tempdir().unwrap();
        let path = |name: &str| folder.path().join(name);
        for name in [".a.csv.12-0.partial", ".b.csv.12-3.partial", ".a.csv.x-0.partial", "a.csv.12-0.partial"] {
            fs::write(path(name), "left").unwrap();
        }
        write_whole(&path("a.csv"), b"1").unwrap();
        let others = [".a.csv.x-0.partial", "a.csv", "a.csv.12-0.partial"];
        assert_eq!(names(folder.path()), [&[".a.csv.x-0.partial", ".b.csv.12-3.partial"], &others[1..]].concat());
        // One that is being written is nobody else's.
        let mut file = WholeFile::create(&path("a.csv")).unwrap();
        file.write_all(b"2").unwrap();
        remove_abandoned(folder.path(), None);
        assert_eq!(names(folder.path()).len(), 4);
        file.finish().unwrap();
        assert_eq!(names(folder.path()), others);
        assert_eq!(fs::read(path("a.csv")).unwrap(), b"2");
    }
}
