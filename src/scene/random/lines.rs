//! The lines of the spectrum of a random signal, and the signal as a table.

use crate::error::{Error, Result, Subject};
use crate::linear::fourier::inverse;
use crate::scene::Table;
use crate::scene::system::positive;
use std::f64::consts::PI;

/// Most rows of a random table, which has 16 per shortest period.
const MOST_ROWS: f64 = 16_777_216.0;

/// Rows of the table in the period of the fastest line, at least.
const ROWS_A_PERIOD: usize = 16;

/// Rounding allowance for the ends of a band, in spacings of lines: a line at an end is included.
const ON_LINE: f64 = 1e-9;

/// The lines i/T of a band, with T the duration.
#[derive(Debug, Clone, Copy)]
pub(in crate::scene) struct Lines {
    /// Numbers of the first and the last line.
    pub first: usize,
    pub last: usize,
    /// T, s.
    pub end: f64,
}

impl Lines {
    /// The lines from `from` to `to` (Hz); errors name a part of `subject`.
    pub fn new(subject: &Subject, [from, to]: [f64; 2], end: f64) -> Result<Self> {
        positive(subject.clone().part("duration"), end)?;
        let rounded = |x: f64| ON_LINE * x.max(1.0);
        let first = (from * end - rounded(from * end)).ceil().max(1.0);
        let last = (to * end + rounded(to * end)).floor();
        if last < first {
            let value = format!("{from:?} to {to:?} Hz, without a line");
            let expected = format!("a band that contains a multiple of 1/end = {:e} Hz", 1.0 / end);
            return Err(Error::invalid(subject.clone().part("band"), value, expected));
        }
        if last * ROWS_A_PERIOD as f64 > MOST_ROWS {
            let most = MOST_ROWS / ROWS_A_PERIOD as f64 / end;
            let value = format!("up to {to:?} Hz over {end:?} s");
            let expected =
                format!("at most {most:e} Hz at this end: a random table has at most 2^24 rows, 16 a period");
            return Err(Error::invalid(subject.clone().part("band"), value, expected));
        }
        Ok(Self { first: first as usize, last: last as usize, end })
    }

    /// Numbers of the lines.
    pub fn numbers(&self) -> impl ExactSizeIterator<Item = usize> + use<> {
        self.first..self.last + 1
    }

    /// Frequency of line `number`, Hz.
    pub fn frequency(&self, number: usize) -> f64 {
        number as f64 / self.end
    }

    /// Rows of a period of the signal.
    pub fn rows(&self) -> usize {
        (ROWS_A_PERIOD * self.last).next_power_of_two()
    }

    /// The times of the rows, s: from 0 to one row beyond the end.
    pub fn times(&self) -> Vec<f64> {
        let rows = self.rows();
        (0..=rows + 1).map(|j| self.end * (j as f64 / rows as f64)).collect()
    }

    /// The share of line `number` that linear interpolation between the rows keeps, by which its
    /// amplitude is divided.
    pub fn kept(&self, number: usize) -> f64 {
        let x = PI * number as f64 / self.rows() as f64;
        (x.sin() / x).powi(2)
    }

    /// The signal Σ aᵢ cos 2πfᵢt − bᵢ sin 2πfᵢt at those times, from the pairs (aᵢ, bᵢ) of the
    /// lines.
    pub fn signal(&self, pairs: impl Iterator<Item = (f64, f64)>) -> Vec<f64> {
        let rows = self.rows();
        let (mut re, mut im) = (vec![0.0; rows], vec![0.0; rows]);
        for (i, pair) in self.numbers().zip(pairs) {
            (re[i], im[i]) = pair;
        }
        inverse(&mut re, &mut im);
        drop(im);
        re.extend_from_within(..2);
        re
    }

    /// The signal as a table.
    pub fn table(&self, pairs: impl Iterator<Item = (f64, f64)>) -> Result<Table> {
        Table::new(self.times(), self.signal(pairs))
    }
}
