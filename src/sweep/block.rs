//! `rows.journal`: what each row that is done adds to the tables of a sweep.

use crate::error::Result;
use crate::output::journal::Journal;
use crate::scene::State;

/// Name of the file.
pub(super) const JOURNAL: &str = "rows.journal";

/// One row of the journal: the state at its end, in hexadecimal, on a line of its own (empty if no
/// row starts from it), its line of `sweep.csv`, its lines of `samples.csv`.
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
    pub fn bytes(&self) -> Vec<u8> {
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

    /// The row at that position of a journal; `None` if it is not done.
    ///
    /// # Errors
    /// As [`Journal::read`].
    pub fn read(journal: &mut Journal, position: usize) -> Result<Option<Self>> {
        Ok(journal.read(position)?.and_then(|bytes| Self::of(&bytes)))
    }

    fn of(bytes: &[u8]) -> Option<Self> {
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

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_row_is_what_was_kept_of_it() {
        for end in [None, Some(State { q: vec![1.0 / 3.0], v: vec![-0.0] })] {
            let block = Block { end: end.clone(), line: b"1,2\n".to_vec(), samples: b"a\nb\n".to_vec() };
            let read = Block::of(&block.bytes()).unwrap();
            assert_eq!((read.end, read.line, read.samples), (end, block.line, block.samples));
        }
    }
}
