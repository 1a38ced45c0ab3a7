//! The folder within a folder of results in which files are written.

use crate::output::atomic::STAGE;
use std::fs;
use std::path::{Path, PathBuf};

/// The folder of files that are not yet in their places; it is removed in the end, whatever is left
/// in it.
#[derive(Debug)]
pub(super) struct Stage(PathBuf);

impl Stage {
    /// That of `folder`, empty, whatever a process left there that was killed.
    pub fn of(folder: &Path) -> Self {
        let stage = Self(folder.join(STAGE));
        stage.clear();
        stage
    }

    /// The path in it of the file `name`.
    pub fn place(&self, name: &str) -> PathBuf {
        self.0.join(name)
    }

    fn clear(&self) {
        let _ = match fs::symlink_metadata(&self.0) {
            Ok(meta) if meta.is_dir() => fs::remove_dir_all(&self.0),
            Ok(_) => fs::remove_file(&self.0),
            Err(_) => Ok(()),
        };
    }
}

impl Drop for Stage {
    fn drop(&mut self) {
        self.clear();
    }
}
