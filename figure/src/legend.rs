//! The legend: below the frame, in columns of equal width.

use super::look::{LABEL, Look};
use super::svg::{Anchor, Canvas, Text};
use super::text;

const SAMPLE: f64 = 34.0;
const GAP: f64 = 6.0;
const ROW: f64 = 16.0;

/// Labels with their samples, arranged for a given width.
#[derive(Debug)]
pub(super) struct Legend {
    entries: Vec<(String, Look)>,
    column: f64,
    columns: usize,
}

impl Legend {
    /// Arranges `entries` within `room`; a label too long for it is shortened.
    pub(super) fn new(entries: Vec<(String, Look)>, room: f64) -> Self {
        let longest = entries.iter().map(|(label, _)| text::width(label, LABEL)).fold(0.0, f64::max);
        let column = (SAMPLE + GAP + longest + 16.0).min(room);
        let columns = ((room / column) as usize).clamp(1, entries.len().max(1));
        // As few columns as this number of rows allows, so that the last row is nearly full.
        let columns = entries.len().div_ceil(entries.len().div_ceil(columns).max(1)).max(1);
        Self { entries, column, columns }
    }

    pub(super) fn height(&self) -> f64 {
        ROW * self.entries.len().div_ceil(self.columns) as f64
    }

    /// Draws it downwards from `y`, centred on the `room` that begins at `x`.
    pub(super) fn draw(&self, canvas: &mut Canvas, x: f64, y: f64, room: f64) {
        let left = x + (room - self.column * self.columns as f64).max(0.0) / 2.0;
        for (i, (label, look)) in self.entries.iter().enumerate() {
            let x = left + self.column * (i % self.columns) as f64;
            let y = y + ROW * ((i / self.columns) as f64 + 0.5);
            look.sample(canvas, x, y, SAMPLE);
            let label = text::shorten(label, LABEL, self.column - SAMPLE - GAP - 4.0);
            canvas.text(Text::new(x + SAMPLE + GAP, y + 4.0, &label, LABEL, Anchor::Start));
        }
    }
}
