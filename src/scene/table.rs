//! A force over time as a table.

use super::system::{finite, nonnegative, positive};
use crate::error::{Error, Result, Subject};
use serde::{Deserialize, Serialize};
use std::sync::Arc;

/// Most rows of a sampled function.
const MOST_SAMPLES: f64 = 1e7;

/// A change by this share of the range of a table within a step is a steep one, and the most of
/// them that are listed.
const STEEP: f64 = 0.1;
const MOST_STEEP: usize = 32;

/// A force over time, piecewise linear between rows and zero outside them.
///
/// Clones share its rows. A row is found by its index where rows are evenly spaced, else by
/// bisection.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(try_from = "Columns", into = "Columns")]
pub struct Table {
    time: Arc<Vec<f64>>,
    force: Arc<Vec<f64>>,
    /// Rows per second, on average.
    pace: f64,
}

/// A table as it was serialised, perhaps by another program.
#[derive(Serialize, Deserialize)]
struct Columns {
    time: Vec<f64>,
    force: Vec<f64>,
}

impl TryFrom<Columns> for Table {
    type Error = Error;

    fn try_from(Columns { time, force }: Columns) -> Result<Self> {
        Self::new(time, force)
    }
}

impl From<Table> for Columns {
    fn from(Table { time, force, .. }: Table) -> Self {
        Self { time: Arc::unwrap_or_clone(time), force: Arc::unwrap_or_clone(force) }
    }
}

impl Table {
    /// A table of `time` (s, strictly increasing) and `force` (N), of equal length with at least
    /// two rows.
    ///
    /// # Errors
    /// [`Error::Invalid`] naming the first row that violates this.
    pub fn new(time: Vec<f64>, force: Vec<f64>) -> Result<Self> {
        if time.len() != force.len() || time.len() < 2 {
            let rows = format!("{} times and {} forces", time.len(), force.len());
            return Err(Error::invalid("load table", rows, "as many times as forces, two rows or more"));
        }
        for (i, (&t, &f)) in time.iter().zip(&force).enumerate() {
            finite(Subject::of("load table").row(i).part("time_s"), t)?;
            finite(Subject::of("load table").row(i).part("force_N"), f)?;
        }
        for (i, pair) in time.windows(2).enumerate() {
            if pair[1] <= pair[0] {
                let key = Subject::of("load table").row(i + 1).part("time_s");
                return Err(Error::invalid(key, pair[1], format!("more than the row before, {}", pair[0])));
            }
        }
        let pace = (time.len() - 1) as f64 / (time[time.len() - 1] - time[0]);
        Ok(Self { time: Arc::new(time), force: Arc::new(force), pace })
    }

    /// A table of other forces at the times of this one, which both share.
    pub(super) fn with_force(&self, force: Vec<f64>) -> Result<Self> {
        if force.len() != self.time.len() {
            let rows = format!("{} times and {} forces", self.time.len(), force.len());
            return Err(Error::invalid("load table", rows, "as many times as forces"));
        }
        for (i, &f) in force.iter().enumerate() {
            finite(Subject::of("load table").row(i).part("force_N"), f)?;
        }
        Ok(Self { time: Arc::clone(&self.time), force: Arc::new(force), pace: self.pace })
    }

    /// Times of the rows, s.
    #[must_use]
    pub fn time(&self) -> &[f64] {
        &self.time
    }

    /// Forces of the rows, N.
    #[must_use]
    pub fn force(&self) -> &[f64] {
        &self.force
    }

    /// The largest force less the least, N.
    pub(crate) fn range(&self) -> f64 {
        let [least, most] = [f64::min, f64::max].map(|pick| self.force.iter().copied().reduce(pick).unwrap_or(0.0));
        most - least
    }

    /// The rows between which the force changes by more than a tenth of its range within less than
    /// `step` seconds, s, as where a jump is written as two rows; none where there are many, as in
    /// a record that the steps only sample.
    pub(crate) fn steep_rows(&self, step: f64) -> Vec<f64> {
        let range = self.range();
        let is_steep = |row: &usize| {
            let [time, force] = [&self.time, &self.force].map(|column| (column[row + 1] - column[*row]).abs());
            time < step && force > STEEP * range
        };
        let steep: Vec<usize> = (0..self.time.len() - 1).filter(is_steep).take(MOST_STEEP + 1).collect();
        if steep.len() > MOST_STEEP {
            return Vec::new();
        }
        steep.into_iter().flat_map(|row| [self.time[row], self.time[row + 1]]).collect()
    }

    /// A table of the function `f` (N, of a time in s) over [`from`, `to`] that differs from it by
    /// at most `error` (N), given a bound `curvature` on |f″| there (N/s²). The spacing of the rows
    /// is the largest that this allows: linear interpolation errs by at most h²/8 · |f″|. With such
    /// a table the exact scheme can run under a function without a closed form of the motion, with
    /// a stated error.
    ///
    /// ```
    /// use signorini::Table;
    ///
    /// let pulse = |t: f64| 10.0 * (-(t - 0.5).powi(2) / 0.02).exp(); // |f″| ≤ 2 · 10/0.02 N/s²
    /// let table = Table::sampled(pulse, [0.0, 1.0], 1000.0, 1e-4)?;
    /// let missed = |t: f64| (table.piece(t).0 - pulse(t)).abs();
    /// let worst = (0..10_000).map(|i| missed(1e-4 * f64::from(i))).fold(0.0, f64::max);
    /// assert!(worst <= 1e-4);
    /// # Ok::<(), signorini::Error>(())
    /// ```
    ///
    /// # Errors
    /// [`Error::Invalid`] for an interval without length, an invalid bound or error, more than 1e7
    /// rows, or a value that is not finite.
    pub fn sampled(f: impl Fn(f64) -> f64, [from, to]: [f64; 2], curvature: f64, error: f64) -> Result<Self> {
        if !(from.is_finite() && to.is_finite() && to > from) {
            return Err(Error::invalid(
                ("sampled load", "interval"),
                format!("{from:?} to {to:?}"),
                "from < to, both finite",
            ));
        }
        nonnegative("sampled load: curvature", curvature)?;
        positive(("sampled load", "error"), error)?;
        let intervals = ((to - from) * (curvature / (8.0 * error)).sqrt()).ceil().max(1.0);
        if intervals > MOST_SAMPLES {
            let least = curvature / 8.0 * ((to - from) / MOST_SAMPLES).powi(2);
            let expected = format!("{least:e} N or more: a table of 1e7 rows is the largest");
            return Err(Error::invalid(("sampled load", "error"), format_args!("{error:e}"), expected));
        }
        let at = |i: u64| if i as f64 == intervals { to } else { from + (to - from) * (i as f64 / intervals) };
        let time: Vec<f64> = (0..=intervals as u64).map(at).collect();
        let force = time.iter().map(|&t| f(t)).collect();
        Self::new(time, force)
    }

    /// The same forces times `weight`.
    pub(super) fn scaled(&self, weight: f64) -> Self {
        let force = if weight == 1.0 {
            Arc::clone(&self.force)
        } else {
            Arc::new(self.force.iter().map(|f| weight * f).collect())
        };
        Self { time: Arc::clone(&self.time), force, pace: self.pace }
    }

    /// Value and slope (N, N/s) at `t`, from the right: the piece that starts at or before `t`;
    /// zero outside the rows.
    #[inline]
    #[must_use]
    pub fn piece(&self, t: f64) -> (f64, f64) {
        self.piece_at(t).map_or((0.0, 0.0), |piece| (piece.force(t), piece.slope))
    }

    /// The piece that starts at or before `t`; `None` outside the rows.
    #[inline]
    fn piece_at(&self, t: f64) -> Option<TablePiece> {
        let next = self.after(t);
        let (&from, &to) = (self.time.get(next.checked_sub(1)?)?, self.time.get(next)?);
        let (start, end) = (self.force[next - 1], self.force[next]);
        Some(TablePiece { from, to, start, slope: (end - start) / (to - from) })
    }

    /// Force at `t`, N, as [`Table::piece`] gives it; from the piece `last` while `t` is on it,
    /// else from that of `t`, which takes its place.
    #[inline]
    pub(super) fn force_near(&self, t: f64, last: &mut TablePiece) -> f64 {
        if !(last.from <= t && t < last.to) {
            *last = self.piece_at(t).unwrap_or(TablePiece::NONE);
        }
        // Of no piece it is 0.
        if last.from <= t { last.force(t) } else { 0.0 }
    }

    /// Index of the first row after `t`.
    #[inline]
    fn after(&self, t: f64) -> usize {
        let time = self.time.as_slice();
        // The cast saturates, and takes NaN to 0. Rounding may put the index off by one.
        let near = ((t - time[0]) * self.pace) as usize;
        let starts = |next: usize| {
            let piece = next.checked_sub(1).and_then(|from| time.get(from..=next));
            matches!(piece, Some([from, to]) if *from <= t && t < *to)
        };
        if starts(near.saturating_add(1)) {
            return near.saturating_add(1);
        }
        let found = [2, 0].into_iter().map(|by| near.saturating_add(by)).find(|&next| starts(next));
        found.unwrap_or_else(|| time.partition_point(|&x| x <= t))
    }
}

/// A table between two of its rows.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct TablePiece {
    /// Times of the rows, s.
    from: f64,
    to: f64,
    /// Force at the first, N.
    start: f64,
    /// N/s.
    slope: f64,
}

impl TablePiece {
    /// One that contains no time.
    pub(super) const NONE: Self = Self { from: f64::NAN, to: f64::NAN, start: 0.0, slope: 0.0 };

    #[inline]
    fn force(&self, t: f64) -> f64 {
        self.start + self.slope * (t - self.from)
    }
}
