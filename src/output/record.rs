//! What is recorded of a finished table or document: its rows, its length and its SHA-256. A file
//! that was emptied, shortened or changed since does not have them.

use crate::case::open_regular;
use crate::error::{Error, Result, counted};
use serde::{Deserialize, Serialize};
use serde_json::{Map, Value};
use sha2::{Digest, Sha256};
use std::io::{self, Read};
use std::path::Path;

/// The key of a manifest, and of a summary, under which tables are recorded by their names.
pub(crate) const TABLES: &str = "tables";

/// The key of a manifest under which JSON documents are recorded by their names.
pub(crate) const DOCUMENTS: &str = "documents";

/// Most bytes of a file of results of which nothing is recorded.
pub(crate) const MOST_BYTES: u64 = 1 << 32;

/// Rows below the header, length and digest of a table; a document has its lines below the first in
/// place of rows.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
pub(crate) struct Record {
    pub rows: u64,
    pub bytes: u64,
    pub sha256: String,
}

impl Record {
    /// The record of the table that `source` holds.
    ///
    /// # Errors
    /// Those of `source`.
    pub fn of(mut source: impl Read) -> io::Result<Self> {
        let (mut digest, mut bytes, mut lines, mut quoted) = (Sha256::new(), 0, 0_u64, false);
        let mut block = vec![0; 1 << 16];
        loop {
            let read = match source.read(&mut block) {
                Err(error) if error.kind() == io::ErrorKind::Interrupted => continue,
                read => read?,
            };
            let Some(part) = block.get(..read).filter(|part| !part.is_empty()) else { break };
            digest.update(part);
            bytes += part.len() as u64;
            for byte in part {
                // A line break within quotes is part of a cell (RFC 4180).
                quoted ^= *byte == b'"';
                lines += u64::from(*byte == b'\n' && !quoted);
            }
        }
        let sha256 = digest.finalize().iter().map(|byte| format!("{byte:02x}")).collect();
        Ok(Self { rows: lines.saturating_sub(1), bytes, sha256 })
    }

    /// The record of the table or document `name` in a manifest; `None` where there is none, as in
    /// manifests of versions before records.
    pub fn read(manifest: &Value, name: &str) -> Option<Self> {
        let found = [TABLES, DOCUMENTS].iter().find_map(|key| manifest.get(key)?.get(name))?;
        serde_json::from_value(found.clone()).ok()
    }

    /// Checks that every file of which `manifest`, the manifest in `folder`, has a record is as it
    /// was written.
    ///
    /// # Errors
    /// As [`Record::bytes`].
    pub fn verify_all(folder: &Path, manifest: &Value) -> Result<()> {
        let of = |key: &str| manifest.get(key).and_then(Value::as_object).into_iter().flat_map(Map::keys);
        let recorded = [TABLES, DOCUMENTS].into_iter().flat_map(of);
        let mut records = recorded.filter_map(|name| Some((folder.join(name), Self::read(manifest, name)?)));
        records.try_for_each(|(path, record)| record.verify(&path))
    }

    /// The bytes of the file at `path`, which is the one that was recorded.
    ///
    /// # Errors
    /// [`Error::Io`], a wrong request, that says what was recorded and what is there.
    pub fn bytes(&self, path: &Path) -> Result<Vec<u8>> {
        let mut bytes = Vec::new();
        self.check(path, |part| bytes.extend_from_slice(part))?;
        Ok(bytes)
    }

    /// Checks that the file at `path` is the table that was recorded.
    ///
    /// # Errors
    /// As [`Record::bytes`].
    pub fn verify(&self, path: &Path) -> Result<()> {
        self.check(path, |_| {})
    }

    fn check(&self, path: &Path, take: impl FnMut(&[u8])) -> Result<()> {
        let damaged = |found: String| {
            let written = format!("{} were written", size(path, self.rows, self.bytes));
            let help = "the command that wrote it writes it again";
            Error::io(path.display(), format!("{found}, where {written}\nhelp: {help}"), true)
        };
        let (file, length) = open_regular(path).map_err(&damaged)?;
        if length == 0 && self.bytes > 0 {
            return Err(damaged("is empty".to_owned()));
        }
        if length > self.bytes {
            return Err(damaged(format!("has {length} bytes")));
        }
        let found = Self::of(TeeReader { source: file.take(self.bytes), take })
            .map_err(|error| damaged(format!("cannot be read ({error})")))?;
        if found.bytes != self.bytes {
            return Err(damaged(format!("has {}", size(path, found.rows, found.bytes))));
        }
        if found.sha256 != self.sha256 {
            let reason = format!("was changed, to the SHA-256 {} from {}", found.sha256, self.sha256);
            return Err(damaged(reason));
        }
        Ok(())
    }
}

/// The size of the file at `path` in words.
fn size(path: &Path, rows: u64, bytes: u64) -> String {
    let is_table = path.extension().is_some_and(|extension| extension == "csv");
    if is_table { format!("{} in {bytes} bytes", counted(rows as usize, "row")) } else { format!("{bytes} bytes") }
}

/// A source whose bytes are also passed to `take`.
struct TeeReader<R, F> {
    source: R,
    take: F,
}

impl<R: Read, F: FnMut(&[u8])> Read for TeeReader<R, F> {
    fn read(&mut self, block: &mut [u8]) -> io::Result<usize> {
        let read = self.source.read(block)?;
        (self.take)(block.get(..read).unwrap_or_default());
        Ok(read)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn rows_are_those_below_the_header_wherever_lines_break() {
        let table = "a,b\n1,\"two\nlines, and \"\"quotes\"\"\"\n3,4\n";
        struct Pieces<'a>(&'a [u8], usize);
        impl Read for Pieces<'_> {
            fn read(&mut self, block: &mut [u8]) -> io::Result<usize> {
                let most = self.1.min(block.len());
                self.0.read(&mut block[..most])
            }
        }
        for piece in [1, 7, 1 << 16] {
            assert_eq!(Record::of(Pieces(table.as_bytes(), piece)).unwrap().rows, 2, "pieces of {piece} bytes");
        }
        assert_eq!(Record::of(&b""[..]).unwrap().rows, 0);
    }

    #[test]
    fn every_changed_byte_and_every_cut_is_noticed() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("a.csv");
        let table = b"a,b\n1,2\n3,4\n";
        let record = Record::of(&table[..]).unwrap();
        // The digest is what `sha256sum` prints.
        assert_eq!(record.sha256, crate::case::sha256(table));
        std::fs::write(&path, table).unwrap();
        assert_eq!(record.bytes(&path).unwrap(), table);
        for at in 0..table.len() {
            let mut changed = table.to_vec();
            changed[at] ^= 1;
            std::fs::write(&path, changed).unwrap();
            let said = record.verify(&path).unwrap_err();
            assert!(said.is_request() && said.to_string().contains("SHA-256"), "{at}: {said}");
            std::fs::write(&path, &table[..at]).unwrap();
            let said = record.verify(&path).unwrap_err().to_string();
            let found = if at == 0 { "is empty".to_owned() } else { format!("in {at} bytes") };
            assert!(said.contains(&found) && said.contains("2 rows in 12 bytes were written"), "{at}: {said}");
        }
        std::fs::write(&path, [&table[..], b"5,6\n"].concat()).unwrap();
        assert!(record.verify(&path).unwrap_err().to_string().contains("has 16 bytes"));
        std::fs::remove_file(&path).unwrap();
        assert!(record.verify(&path).unwrap_err().to_string().contains("no such file"));
        std::fs::create_dir(&path).unwrap();
        assert!(record.verify(&path).unwrap_err().to_string().contains("a folder"));
    }
}
