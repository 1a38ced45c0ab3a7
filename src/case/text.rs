//! Text files, and reasons why one cannot be read.

use std::fs;
use std::io::Read;
use std::path::Path;

/// Largest case file, bytes.
pub(super) const MOST_CASE_BYTES: u64 = 1 << 20;
/// Largest table file, bytes.
pub(super) const MOST_TABLE_BYTES: u64 = 1 << 28;

/// The text of a file, or why it cannot be read.
pub(super) fn read_text(path: &Path, most: u64) -> std::result::Result<String, String> {
    let said = |error: std::io::Error| match error.kind() {
        std::io::ErrorKind::NotFound => "no such file".to_owned(),
        std::io::ErrorKind::PermissionDenied => "not allowed to read it".to_owned(),
        _ => error.to_string(),
    };
    let meta = fs::metadata(path).map_err(said)?;
    if meta.is_dir() {
        return Err("a folder, not a file".to_owned());
    }
    if !meta.is_file() {
        return Err("not a regular file".to_owned());
    }
    let mut bytes = Vec::new();
    fs::File::open(path).and_then(|file| file.take(most + 1).read_to_end(&mut bytes)).map_err(said)?;
    if bytes.len() as u64 > most {
        return Err(format!("more than {most} bytes"));
    }
    String::from_utf8(bytes).map_err(|error| {
        let line = error.as_bytes().iter().take(error.utf8_error().valid_up_to()).filter(|b| **b == b'\n').count() + 1;
        format!("line {line} is not UTF-8 text")
    })
}
