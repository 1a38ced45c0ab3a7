//! `rows.journal`: the rows that are done, in the order in which they were finished, each complete
//! or not at all.
//!
//! A block is a line `@ROW LENGTH CRC` and LENGTH bytes: the state at the end of the row, in
//! hexadecimal, on a line of its own (empty if no row starts from it), the row's line of
//! `sweep.csv`, its lines of `samples.csv`. The journal ends at the first block that is incomplete
//! or damaged, for example after a power failure or on a full disk; later rows are computed again.

use crate::error::{Error, Result};
use crate::scene::State;
use std::fs::{File, OpenOptions};
use std::io::{BufRead, BufReader, BufWriter, Read, Seek, SeekFrom, Write};
use std::path::{Path, PathBuf};
use std::time::{Duration, Instant};

/// Name of the file.
pub(super) const JOURNAL: &str = "rows.journal";

/// Intervals at which rows are passed to the operating system, and written to the disk.
const FLUSH: Duration = Duration::from_secs(1);
const SYNC: Duration = Duration::from_secs(10);

/// Maximum length of a block, bytes: an upper limit for damaged lengths.
const MOST_BYTES: u64 = 1 << 32;

/// The extent of a block's body in the file; length 0 for a row that is not done.
#[derive(Debug, Clone, Copy, Default)]
struct Extent {
    offset: u64,
    length: u32,
}

/// An open journal, in a folder that is locked against other processes.
#[derive(Debug)]
pub(super) struct Journal {
    path: PathBuf,
    file: BufWriter<File>,
    /// One entry for each row of this journal, in their order.
    extents: Vec<Extent>,
    done: u64,
    end: u64,
    flushed: Instant,
    synced: Instant,
}

/// One row of the journal.
#[derive(Debug)]
pub(super) struct Block {
    /// The state at its end.
    pub end: Option<State>,
    /// Its line of `sweep.csv`.
    pub line: Vec<u8>,
    /// Its lines of `samples.csv`.
    pub samples: Vec<u8>,
}

impl Block {
    fn bytes(&self) -> Vec<u8> {
        let mut bytes = Vec::new();
        if let Some(state) = &self.end {
            for x in state.q.iter().chain(&state.v) {
                bytes.extend(format!("{:016x}", x.to_bits()).into_bytes());
            }
        }
        bytes.push(b'\n');
        bytes.extend_from_slice(&self.line);
        bytes.extend_from_slice(&self.samples);
        bytes
    }

    fn read(bytes: &[u8]) -> Option<Self> {
        let mut lines = bytes.splitn(3, |&b| b == b'\n');
        let (state, line, samples) = (lines.next()?, lines.next()?, lines.next()?);
        let hex = std::str::from_utf8(state).ok()?;
        let number = |chunk: &[u8]| {
            let text = std::str::from_utf8(chunk).ok()?;
            u64::from_str_radix(text, 16).ok().map(f64::from_bits)
        };
        let numbers: Vec<f64> = hex.as_bytes().chunks(16).map(number).collect::<Option<_>>()?;
        let (q, v) = numbers.split_at(numbers.len() / 2);
        let end = (!numbers.is_empty()).then(|| State { q: q.to_vec(), v: v.to_vec() });
        Some(Self { end, line: [line, b"\n"].concat(), samples: samples.to_vec() })
    }
}

impl Journal {
    /// Opens the journal in `folder` for `rows` rows, and reads it, or with `anew` empties it.
    /// `position` gives the position of a row in this journal from its number.
    ///
    /// # Errors
    /// [`Error::Io`] if it cannot be opened.
    pub fn open(folder: &Path, rows: u64, anew: bool, position: impl Fn(u64) -> Option<usize>) -> Result<Self> {
        let path = folder.join(JOURNAL);
        let failed = |error: &std::io::Error| failure(&path, error, true);
        let opened = OpenOptions::new().read(true).write(true).create(true).truncate(false).open(&path);
        let mut file = opened.map_err(|error| failed(&error))?;
        if !file.metadata().is_ok_and(|meta| meta.is_file()) {
            return Err(Error::io(path.display(), "not a regular file", true));
        }
        if anew {
            // On the disk before the folder says whose rows these are.
            file.set_len(0).and_then(|()| file.sync_all()).map_err(|error| failed(&error))?;
        }
        let mut extents = vec![Extent::default(); usize::try_from(rows).unwrap_or(usize::MAX)];
        let (mut done, mut end) = (0, 0);
        let mut reader = BufReader::new(&file);
        while let Some((row, length)) = header(&mut reader) {
            let offset = end + length.header;
            let mut body = Vec::new();
            let read = reader.by_ref().take(length.body).read_to_end(&mut body);
            if read.is_err() || body.len() as u64 != length.body || crc32(&[&row.to_le_bytes(), &body]) != length.crc {
                break;
            }
            let Some(slot) = position(row).and_then(|index| extents.get_mut(index)) else { break };
            done += u64::from(slot.length == 0);
            *slot = Extent { offset, length: length.body as u32 };
            end = offset + length.body;
        }
        file.set_len(end).and_then(|()| file.seek(SeekFrom::Start(end))).map_err(|error| failed(&error))?;
        let now = Instant::now();
        Ok(Self { path, file: BufWriter::with_capacity(1 << 16, file), extents, done, end, flushed: now, synced: now })
    }

    /// Number of rows done.
    pub fn done(&self) -> u64 {
        self.done
    }

    /// True if the row at that position is done.
    pub fn has(&self, position: usize) -> bool {
        self.extents.get(position).is_some_and(|extent| extent.length > 0)
    }

    /// Adds a row.
    ///
    /// # Errors
    /// [`Error::Io`] if writing fails; it says that no finished row is lost, and how to continue.
    pub fn add(&mut self, row: u64, position: usize, block: &Block) -> Result<()> {
        let body = block.bytes();
        let header = format!("@{row} {} {:08x}\n", body.len(), crc32(&[&row.to_le_bytes(), &body]));
        let written = self.file.write_all(header.as_bytes()).and_then(|()| self.file.write_all(&body));
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

    /// The row at that position; `None` if it is not done.
    ///
    /// # Errors
    /// [`Error::Io`] where it cannot be read.
    pub fn read(&mut self, position: usize) -> Result<Option<Block>> {
        let Some(&at) = self.extents.get(position).filter(|at| at.length > 0) else { return Ok(None) };
        let mut bytes = vec![0; at.length as usize];
        // The buffer is written at the end of the file, and so is what follows.
        let flushed = self.file.flush();
        let mut file = self.file.get_ref();
        let read =
            flushed.and_then(|()| file.seek(SeekFrom::Start(at.offset))).and_then(|_| file.read_exact(&mut bytes));
        let back = file.seek(SeekFrom::Start(self.end));
        read.and(back).map_err(|error| failure(&self.path, &error, false))?;
        Ok(Block::read(&bytes))
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
    let row = words.next()?.parse().ok()?;
    let body = words.next()?.parse().ok().filter(|&body| body < MOST_BYTES)?;
    let crc = u32::from_str_radix(words.next()?, 16).ok()?;
    words.next().is_none().then_some((row, Length { header: line.len() as u64, body, crc }))
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
        "{error}\nhelp: the rows done so far are kept in it; make room and give the same command \
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

    fn block(x: f64) -> Block {
        let end = Some(State { q: vec![x], v: vec![-x] });
        Block { end, line: format!("{x}\n").into_bytes(), samples: b"a\nb\n".to_vec() }
    }

    fn open(folder: &Path) -> Journal {
        Journal::open(folder, 10, false, |row| usize::try_from(row).ok()).unwrap()
    }

    #[test]
    fn the_checksum_is_the_published_one() {
        assert_eq!(crc32(&[b"1234", b"56789"]), 0xcbf4_3926);
    }

    #[test]
    fn rows_are_read_again_and_a_torn_one_ends_the_journal_wherever_it_is_torn() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join(JOURNAL);
        let mut journal = open(folder.path());
        for row in [3, 1, 2] {
            journal.add(row, row as usize, &block(row as f64 / 3.0)).unwrap();
        }
        journal.flush().unwrap();
        drop(journal);
        let whole = std::fs::read(&path).unwrap();
        let mut journal = open(folder.path());
        assert_eq!(journal.done(), 3);
        let read = journal.read(1).unwrap().unwrap();
        assert_eq!(read.end.unwrap().q, [1.0 / 3.0]);
        assert_eq!((read.line, read.samples), (block(1.0 / 3.0).line, b"a\nb\n".to_vec()));
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
