//! Journals: what a long computation has done, part by part, in the order in which parts were
//! finished, each complete or not at all, so that an interrupted computation goes on.
//!
//! A block is a line `@PART LENGTH CRC` and LENGTH bytes, which are the caller's. The journal ends
//! at the first block that is incomplete or damaged, for example after a power failure or on a full
//! disk; later parts are computed again.

use super::manifest;
use crate::error::{Error, Result};
use std::fs::{File, OpenOptions};
use std::io::{BufRead, BufReader, BufWriter, Read, Seek, SeekFrom, Write};
use std::path::{Path, PathBuf};
use std::time::{Duration, Instant};

/// Intervals at which blocks are passed to the operating system, and written to the disk.
const FLUSH: Duration = Duration::from_secs(1);
const SYNC: Duration = Duration::from_secs(10);

/// Maximum length of a block, bytes: an upper limit for damaged lengths.
const MOST_BYTES: u64 = 1 << 32;

/// The extent of a block's body in the file; length 0 for a part that is not done.
#[derive(Debug, Clone, Copy, Default)]
struct Extent {
    offset: u64,
    length: u32,
}

/// An open journal, in a folder that is locked against other processes.
#[derive(Debug)]
pub(crate) struct Journal {
    path: PathBuf,
    file: BufWriter<File>,
    /// One entry for each part of this journal, in their order.
    extents: Vec<Extent>,
    done: u64,
    end: u64,
    flushed: Instant,
    synced: Instant,
}

/// True if `folder` has results, finished or not, that go on from the journal `name`.
pub(crate) fn is_there(folder: &Path, name: &str) -> bool {
    manifest::read(folder).is_some_and(|manifest| manifest::files(&manifest).any(|file| file == name))
}

impl Journal {
    /// Opens the journal `name` in `folder` for `parts` parts, and reads it, or with `anew` empties
    /// it. `position` gives the position of a part in this journal from its number.
    ///
    /// # Errors
    /// [`Error::Io`] if it cannot be opened.
    pub fn open(
        folder: &Path,
        name: &str,
        parts: u64,
        anew: bool,
        position: impl Fn(u64) -> Option<usize>,
    ) -> Result<Self> {
        let path = folder.join(name);
        let failed = |error: &std::io::Error| failure(&path, error, true);
        let opened = OpenOptions::new().read(true).write(true).create(true).truncate(false).open(&path);
        let mut file = opened.map_err(|error| failed(&error))?;
        if !file.metadata().is_ok_and(|meta| meta.is_file()) {
            return Err(Error::io(path.display(), "not a regular file", true));
        }
        if anew {
            // On the disk before the folder says whose parts these are.
            file.set_len(0).and_then(|()| file.sync_all()).map_err(|error| failed(&error))?;
        }
        let mut extents = vec![Extent::default(); usize::try_from(parts).unwrap_or(usize::MAX)];
        let (mut done, mut end) = (0, 0);
        let mut reader = BufReader::new(&file);
        while let Some((part, length)) = header(&mut reader) {
            let offset = end + length.header;
            let mut body = Vec::new();
            let read = reader.by_ref().take(length.body).read_to_end(&mut body);
            if read.is_err() || body.len() as u64 != length.body || crc32(&[&part.to_le_bytes(), &body]) != length.crc {
                break;
            }
            let Some(slot) = position(part).and_then(|index| extents.get_mut(index)) else { break };
            done += u64::from(slot.length == 0);
            *slot = Extent { offset, length: length.body as u32 };
            end = offset + length.body;
        }
        file.set_len(end).and_then(|()| file.seek(SeekFrom::Start(end))).map_err(|error| failed(&error))?;
        let now = Instant::now();
        Ok(Self { path, file: BufWriter::with_capacity(1 << 16, file), extents, done, end, flushed: now, synced: now })
    }

    /// Number of parts done.
    pub fn done(&self) -> u64 {
        self.done
    }

    /// True if the part at that position is done.
    pub fn has(&self, position: usize) -> bool {
        self.extents.get(position).is_some_and(|extent| extent.length > 0)
    }

    /// Adds the part number `part` at that position; its `body` has one byte or more.
    ///
    /// # Errors
    /// [`Error::Io`] if writing fails; it says that no finished part is lost, and how to continue.
    pub fn add(&mut self, part: u64, position: usize, body: &[u8]) -> Result<()> {
        let header = format!("@{part} {} {:08x}\n", body.len(), crc32(&[&part.to_le_bytes(), body]));
        let written = self.file.write_all(header.as_bytes()).and_then(|()| self.file.write_all(body));
        written.and_then(|()| self.flush_now_and_then()).map_err(|error| interrupted(&self.path, &error))?;
        let offset = self.end + header.len() as u64;
        if let Some(slot) = self.extents.get_mut(position) {
            self.done += u64::from(slot.length == 0);
            *slot = Extent { offset, length: body.len() as u32 };
        }
        self.end = offset + body.len() as u64;
        Ok(())
    }

    fn flush_now_and_then(&mut self) -> std::io::Result<()> {
        if self.flushed.elapsed() > FLUSH {
            self.file.flush()?;
            self.flushed = Instant::now();
            if self.synced.elapsed() > SYNC {
                self.file.get_ref().sync_data()?;
                self.synced = Instant::now();
            }
        }
        Ok(())
    }

    /// Writes everything to the disk.
    ///
    /// # Errors
    /// As [`Journal::add`].
    pub fn flush(&mut self) -> Result<()> {
        let flushed = self.file.flush().and_then(|()| self.file.get_ref().sync_data());
        flushed.map_err(|error| interrupted(&self.path, &error))
    }

    /// The bytes of the part at that position; `None` if it is not done.
    ///
    /// # Errors
    /// [`Error::Io`] where it cannot be read.
    pub fn read(&mut self, position: usize) -> Result<Option<Vec<u8>>> {
        let Some(&at) = self.extents.get(position).filter(|at| at.length > 0) else { return Ok(None) };
        let mut bytes = vec![0; at.length as usize];
        // The buffer is written at the end of the file, and so is what follows.
        let flushed = self.file.flush();
        let mut file = self.file.get_ref();
        let read =
            flushed.and_then(|()| file.seek(SeekFrom::Start(at.offset))).and_then(|_| file.read_exact(&mut bytes));
        let back = file.seek(SeekFrom::Start(self.end));
        read.and(back).map_err(|error| failure(&self.path, &error, false))?;
        Ok(Some(bytes))
    }
}

/// The numbers in the first line of a block.
struct Length {
    header: u64,
    body: u64,
    crc: u32,
}

fn header(reader: &mut impl BufRead) -> Option<(u64, Length)> {
    let mut line = Vec::new();
    // Maximum length of a header, so that a damaged one does not make us read the whole file.
    reader.by_ref().take(64).read_until(b'\n', &mut line).ok()?;
    let text = std::str::from_utf8(&line).ok()?.strip_prefix('@')?.strip_suffix('\n')?;
    let mut words = text.split(' ');
    let part = words.next()?.parse().ok()?;
    let body = words.next()?.parse().ok().filter(|&body| body < MOST_BYTES)?;
    let crc = u32::from_str_radix(words.next()?, 16).ok()?;
    words.next().is_none().then_some((part, Length { header: line.len() as u64, body, crc }))
}

/// CRC-32 of IEEE 802.3, as in zip files, of the concatenated `parts`.
fn crc32(parts: &[&[u8]]) -> u32 {
    let step = |crc: u32, byte: &u8| (crc >> 8) ^ TABLE[((crc ^ u32::from(*byte)) & 0xff) as usize];
    !parts.iter().copied().flatten().fold(!0, step)
}

/// The remainder of each byte value.
const TABLE: [u32; 256] = {
    let mut table = [0; 256];
    let mut byte = 0;
    while byte < 256 {
        let (mut crc, mut bit) = (byte as u32, 0);
        while bit < 8 {
            crc = if crc & 1 == 1 { (crc >> 1) ^ 0xedb8_8320 } else { crc >> 1 };
            bit += 1;
        }
        table[byte] = crc;
        byte += 1;
    }
    table
};

fn interrupted(path: &Path, error: &std::io::Error) -> Error {
    let reason = format!(
        "{error}\nhelp: what is done so far is kept in it; make room and give the same command \
         again, and it goes on from there"
    );
    Error::io(path.display(), reason, false)
}

fn failure(path: &Path, error: &std::io::Error, request: bool) -> Error {
    Error::io(path.display(), error.to_string(), request)
}

#[cfg(test)]
mod tests {
    use super::*;

    const NAME: &str = "parts.journal";

    fn block(x: f64) -> Vec<u8> {
        format!("{x}\na\nb\n").into_bytes()
    }

    fn open(folder: &Path) -> Journal {
        Journal::open(folder, NAME, 10, false, |part| usize::try_from(part).ok()).unwrap()
    }

    #[test]
    fn the_checksum_is_the_published_one() {
        assert_eq!(crc32(&[b"1234", b"56789"]), 0xcbf4_3926);
    }

    #[test]
    fn parts_are_read_again_and_a_torn_one_ends_the_journal_wherever_it_is_torn() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join(NAME);
        let mut journal = open(folder.path());
        for part in [3, 1, 2] {
            journal.add(part, part as usize, &block(part as f64 / 3.0)).unwrap();
        }
        journal.flush().unwrap();
        drop(journal);
        let whole = std::fs::read(&path).unwrap();
        let mut journal = open(folder.path());
        assert_eq!(journal.done(), 3);
        assert_eq!(journal.read(1).unwrap(), Some(block(1.0 / 3.0)));
        assert_eq!(journal.read(4).unwrap(), None);
        // What is added after a look back stands at the end.
        journal.add(7, 7, &block(7.0)).unwrap();
        journal.flush().unwrap();
        drop(journal);
        assert_eq!(open(folder.path()).done(), 4);
        let second = whole.iter().enumerate().filter(|(_, b)| **b == b'@').map(|(at, _)| at).nth(1).unwrap();
        let third = whole.iter().enumerate().filter(|(_, b)| **b == b'@').map(|(at, _)| at).nth(2).unwrap();
        for cut in 0..whole.len() {
            std::fs::write(&path, &whole[..cut]).unwrap();
            let expected = if cut >= third { 2 } else { u64::from(cut >= second) };
            let mut journal = open(folder.path());
            assert_eq!(journal.done(), expected, "cut at {cut}");
            // What is added then is found.
            journal.add(5, 5, &block(5.0)).unwrap();
            drop(journal);
            assert_eq!(open(folder.path()).done(), expected + 1, "cut at {cut}");
        }
        // One bit turned anywhere is noticed.
        for at in 0..whole.len() {
            let mut damaged = whole.clone();
            damaged[at] ^= 1;
            std::fs::write(&path, &damaged).unwrap();
            assert!(open(folder.path()).done() < 3, "bit at {at}");
        }
    }
}
