//! One writer in a folder of results at a time.

use crate::error::{Error, Result};
use std::fs::{self, File, OpenOptions, TryLockError};
use std::io::{self, Write};
use std::path::{Path, PathBuf};

/// The file in the folder that is locked. It holds the number of the process once that has the
/// lock, and is removed with the lock.
const NAME: &str = ".signorini.lock";

/// The right to write into a folder, until it is dropped. A killed process leaves the file, but
/// not the lock.
#[derive(Debug)]
pub(crate) struct Lock {
    path: PathBuf,
    _file: File,
}

impl Lock {
    /// Takes the lock of `folder`, which exists.
    ///
    /// # Errors
    /// [`Error::Io`], marked as a wrong request, where another process has it, or where the folder
    /// cannot be written.
    pub fn take(folder: &Path) -> Result<Self> {
        let path = folder.join(NAME);
        let failed = |error: io::Error| Error::io(path.display(), error.to_string(), true).caused_by(error);
        loop {
            let opened = OpenOptions::new().read(true).write(true).create(true).truncate(false).open(&path);
            let mut file = opened.map_err(failed)?;
            match file.try_lock() {
                Err(TryLockError::WouldBlock) => {
                    let reason = "another process is at work in this folder".to_owned();
                    return Err(Error::io(folder.display(), reason, true));
                }
                // A file system without locks: the caller must not run two processes at once.
                Ok(()) | Err(TryLockError::Error(_)) => {}
            }
            // The file may have been removed, with the lock of another process, after it was
            // opened.
            if is_at(&file, &path) {
                // For who looks into the folder; the lock holds without it, on a full disk too.
                let _ = file.set_len(0).and_then(|()| writeln!(file, "{}", std::process::id()));
                return Ok(Self { path, _file: file });
            }
        }
    }
}

impl Drop for Lock {
    fn drop(&mut self) {
        // Removed while it is still locked, so that nobody holds a lock on it that counts.
        let _ = fs::remove_file(&self.path);
    }
}

/// True if `file` is the one at `path`.
#[cfg(unix)]
pub(super) fn is_at(file: &File, path: &Path) -> bool {
    use std::os::unix::fs::MetadataExt;
    let place = |meta: fs::Metadata| (meta.dev(), meta.ino());
    let (own, there) = (file.metadata().map(place), fs::symlink_metadata(path).map(place));
    matches!((own, there), (Ok(own), Ok(there)) if own == there)
}

/// True if there is a file at `path`: an open file cannot be removed here.
#[cfg(not(unix))]
pub(super) fn is_at(_: &File, path: &Path) -> bool {
    path.exists()
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::sync::atomic::{AtomicU32, Ordering};

    #[test]
    fn one_writer_holds_a_folder_at_a_time() {
        let folder = tempfile::tempdir().unwrap();
        let first = Lock::take(folder.path()).unwrap();
        let second = Lock::take(folder.path()).unwrap_err();
        assert!(second.is_request() && second.to_string().contains("another process"), "{second}");
        drop(first);
        drop(Lock::take(folder.path()).unwrap());
        assert_eq!(fs::read_dir(folder.path()).unwrap().count(), 0);
        // What a killed process leaves is no lock.
        fs::write(folder.path().join(NAME), "").unwrap();
        drop(Lock::take(folder.path()).unwrap());
        fs::create_dir(folder.path().join(NAME)).unwrap();
        assert!(Lock::take(folder.path()).unwrap_err().is_request());
    }

    /// The file goes with each lock, so the next owner locks another file of the same name.
    #[test]
    fn locks_taken_in_turn_are_never_held_twice() {
        let folder = tempfile::tempdir().unwrap();
        let (held, most, taken) = (AtomicU32::new(0), AtomicU32::new(0), AtomicU32::new(0));
        std::thread::scope(|scope| {
            for _ in 0..4 {
                scope.spawn(|| {
                    while taken.load(Ordering::SeqCst) < 400 {
                        let Ok(lock) = Lock::take(folder.path()) else { continue };
                        most.fetch_max(held.fetch_add(1, Ordering::SeqCst) + 1, Ordering::SeqCst);
                        std::thread::yield_now();
                        held.fetch_sub(1, Ordering::SeqCst);
                        drop(lock);
                        taken.fetch_add(1, Ordering::SeqCst);
                    }
                });
            }
        });
        assert_eq!(most.into_inner(), 1);
    }
}
