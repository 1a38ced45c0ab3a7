//! Where the frames of a figure stand on the page, and its axes.

use super::axis::{Axis, Extent, Scale};
use super::labels;
use super::look::{LABEL, SMALL, WIDTH};
use super::panel::{Panel, include_marks};
use super::sheet::Figure;
use super::text;

/// Frames one below the other with one horizontal axis.
pub(super) struct Column {
    pub x: f64,
    pub width: f64,
    pub axis: Axis,
}

/// Where the frames stand: panels one below the other, with the same margins, so that their frames
/// are aligned.
pub(super) struct Layout {
    /// Height of each frame; left edge and width of all columns together.
    pub height: f64,
    pub left: f64,
    pub width: f64,
    /// By how much a square figure is moved to the right.
    pub aside: f64,
    pub columns: Vec<Column>,
    /// Of each panel: its vertical axis, the lines of that axis' label, and the height of its head.
    pub y_axes: Vec<Axis>,
    pub y_labels: Vec<Vec<String>>,
    pub heads: Vec<f64>,
}

/// Side of the frame of a square figure with one panel, and with several.
const SIDE: f64 = 420.0;
const SIDE_OF_SEVERAL: f64 = 300.0;

/// Share of the width for the whole beside a detail, and the space between the two.
const WHOLE: f64 = 0.42;
const BETWEEN: f64 = 26.0;

impl Figure {
    pub(super) fn layout(&self) -> Layout {
        let height = match self.panels.len() {
            0 | 1 if self.square => SIDE,
            _ if self.square => SIDE_OF_SEVERAL,
            0 | 1 if self.x_scale == Scale::Log => 320.0,
            0 | 1 => 260.0,
            2 => 165.0,
            _ if self.x_scale == Scale::Log => 155.0,
            _ => 130.0,
        };
        let y_axes: Vec<Axis> = self.panels.iter().map(|p| p.y_axis(self.x_scale, height)).collect();
        let y_labels: Vec<_> = self.panels.iter().map(|p| text::wrap(&p.y_label, LABEL, height + 10.0, 2)).collect();
        let label_lines = y_labels.iter().map(Vec::len).max().unwrap_or(0) as f64;
        let left = 12.0 + 14.0 * label_lines + y_axes.iter().map(widest).fold(0.0, f64::max) + 8.0;
        let beside = self.panels.iter().zip(&y_axes).map(|(p, axis)| labels::room_beside(p, axis, height));
        let right = beside.fold(18.0, f64::max);
        let room = WIDTH - left - right;
        // A square stands in the middle of the room, and its labels stand beside it.
        let (width, aside) = if self.square { (height.min(room), 0.5 * (room - height).max(0.0)) } else { (room, 0.0) };
        let left = left + aside;
        let columns = self.columns(left, width);
        let heads = self.panels.iter().zip(&y_axes).map(|(p, axis)| head_height(p, axis)).collect();
        Layout { height, left, width, aside, columns, y_axes, y_labels, heads }
    }

    /// The columns that share `width` from `left` on: the whole and, if there is one, the detail.
    fn columns(&self, left: f64, width: f64) -> Vec<Column> {
        let Some(detail) = &self.detail else {
            return vec![Column { x: left, width, axis: self.x_axis(width) }];
        };
        let whole = WHOLE * (width - BETWEEN);
        let rest = width - BETWEEN - whole;
        let extent = Extent { low: detail.from, high: detail.to.max(detail.from) }.padded(0.0, Scale::Linear);
        vec![
            Column { x: left, width: whole, axis: self.x_axis(whole) },
            Column { x: left + whole + BETWEEN, width: rest, axis: Axis::across(Scale::Linear, extent, rest) },
        ]
    }

    fn x_axis(&self, width: f64) -> Axis {
        let given = self.x_range.and_then(|(low, high)| Some((self.x_scale.even(low)?, self.x_scale.even(high)?)));
        if let Some((low, high)) = given.filter(|(low, high)| low < high) {
            return Axis::across(self.x_scale, Extent { low, high }, width);
        }
        let mut extent = Extent::EMPTY;
        for (xs, _) in self.panels.iter().map(|p| p.extents(self.x_scale)).filter(|(xs, _)| !xs.is_empty()) {
            extent.include(xs.low);
            extent.include(xs.high);
        }
        let marks = self.panels.iter().flat_map(|p| &p.marks).filter(|m| m.upright).map(|m| m.value);
        let forward = self.x_scale == Scale::Linear && self.panels.iter().all(Panel::goes_forward);
        let share = if !forward {
            0.05
        } else if self.panels.iter().any(|p| !p.stems.is_empty()) {
            0.01
        } else {
            0.0
        };
        let extent = include_marks(extent, marks, self.x_scale).padded(share, self.x_scale);
        Axis::across(self.x_scale, extent, width)
    }
}

/// Room above a frame: for a heading, labels of upright marks, or the power of ten of the axis.
fn head_height(panel: &Panel, axis: &Axis) -> f64 {
    let labels = panel.marks.iter().any(|m| m.upright) || axis.factor.is_some();
    6.0 + if panel.heading.is_empty() { 0.0 } else { 15.0 } + if labels { 13.0 } else { 0.0 }
}

fn widest(axis: &Axis) -> f64 {
    let width = |body: &str, exponent: Option<i32>| {
        text::width(body, SMALL) + exponent.map_or(0.0, |e| text::width(&e.to_string(), 0.78 * SMALL))
    };
    axis.ticks.iter().map(|tick| width(&tick.body, tick.exponent)).fold(0.0, f64::max)
}
