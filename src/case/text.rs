//! Text files, and reasons why one cannot be read.

use crate::error::unnumbered;
use std::fs;
use std::io::{Read, Take};
use std::path::Path;

/// Largest case file, bytes.
pub(super) const MOST_CASE_BYTES: u64 = 1 << 20;
/// Largest table file, bytes.
pub(crate) const MOST_TABLE_BYTES: u64 = 1 << 28;

fn said(error: std::io::Error) -> String {
    match error.kind() {
        std::io::ErrorKind::NotFound => "no such file".to_owned(),
        std::io::ErrorKind::PermissionDenied => "not allowed to read it".to_owned(),
        _ => unnumbered(&error.to_string()),
    }
}

/// A regular file, open from its first byte to that of its length, and the length; or why it cannot
/// be read. A pipe waits for its writer, and a device has no end; so has a file of /proc that waits
/// for messages, whose length is 0.
pub(crate) fn open_regular(path: &Path) -> std::result::Result<(Take<fs::File>, u64), String> {
    let length = |meta: fs::Metadata| {
        if meta.is_dir() {
            return Err("a folder, not a file".to_owned());
        }
        if meta.is_file() { Ok(meta.len()) } else { Err("not a regular file".to_owned()) }
    };
    // Before it is opened, since to open a pipe already waits.
    fs::metadata(path).map_err(said).and_then(length)?;
    let file = fs::File::open(path).map_err(said)?;
    let length = file.metadata().map_err(said).and_then(length)?;
    Ok((file.take(length), length))
}

/// The text of a regular file of at most `most` bytes, or why it cannot be read.
pub(crate) fn read_text(path: &Path, most: u64) -> std::result::Result<String, String> {
    let (mut file, length) = open_regular(path)?;
    if length > most {
        return Err(format!("more than {most} bytes"));
    }
    let mut bytes = Vec::new();
    file.read_to_end(&mut bytes).map_err(said)?;
    String::from_utf8(bytes).map_err(|error| {
        let line = error.as_bytes().iter().take(error.utf8_error().valid_up_to()).filter(|b| **b == b'\n').count() + 1;
        format!("line {line} is not UTF-8 text")
    })
}

#[cfg(all(test, target_os = "linux"))]
mod tests {
    use super::*;

    /// Of a file of /proc that waits for the next message, nothing is read.
    #[test]
    fn nothing_is_read_that_has_no_end() {
        assert_eq!(read_text(Path::new("/dev/zero"), 1 << 20).unwrap_err(), "not a regular file");
        assert_eq!(read_text(Path::new("/dev"), 1 << 20).unwrap_err(), "a folder, not a file");
        // Neither the log of the kernel, which root may open, nor a list that may be read.
        assert!(read_text(Path::new("/proc/kmsg"), 1 << 20).map_or(true, |text| text.is_empty()));
        assert_eq!(read_text(Path::new("/proc/self/maps"), 1 << 20).unwrap(), "");
    }
}
