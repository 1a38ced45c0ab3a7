//! The results that a folder held before.

use crate::output::atomic::remove_abandoned;
use crate::output::manifest;
use std::fs;
use std::path::{Component, Path};

/// Results that others take the place of.
#[derive(Debug, Default)]
pub(super) struct EarlierResults {
    /// When they were made, where their manifest says it.
    made: Option<String>,
    /// Their files.
    pub files: Vec<String>,
}

impl EarlierResults {
    /// Those in `folder`; `None` where there are none.
    pub fn of(folder: &Path) -> Option<Self> {
        let Some(manifest) = manifest::read(folder) else {
            return manifest::unknown_results(folder).map(|_| Self::default());
        };
        let files = manifest::files(&manifest).map(str::to_owned).collect();
        Some(Self { made: manifest::made(&manifest).map(str::to_owned), files })
    }

    /// The sentence that says that they were replaced.
    pub fn replaced(self, folder: &Path) -> String {
        let made = self.made.map_or_else(String::new, |time| format!(", made {time}"));
        format!("replaced the results in {}{made}", folder.display())
    }
}

/// Removes a file of the earlier results, and its folder if that is then empty. The manifest
/// may name any path, so nothing outside the folder is touched. A file that cannot be removed
/// stays.
pub(super) fn take_away(results: &Path, name: &str) {
    let path = Path::new(name);
    if name.is_empty() || !path.components().all(|part| matches!(part, Component::Normal(_))) {
        return;
    }
    let linked = |path: &Path| fs::symlink_metadata(results.join(path)).is_ok_and(|meta| meta.is_symlink());
    if path.ancestors().skip(1).any(|folder| !folder.as_os_str().is_empty() && linked(folder)) {
        return;
    }
    let _ = fs::remove_file(results.join(path));
    for folder in path.ancestors().skip(1).filter(|folder| !folder.as_os_str().is_empty()) {
        remove_abandoned(&results.join(folder), None);
        // This removes empty folders only.
        let _ = fs::remove_dir(results.join(folder));
    }
}
