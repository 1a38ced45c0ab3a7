//! The sheet: title, panels under one another, one horizontal axis, one legend.

use super::axis::{Axis, Extent, Scale};
use super::legend::Legend;
use super::look::{FRAME, GRID, LABEL, Look, Role, SMALL, TITLE, look};
use super::panel::{Entry, Frame, Panel, include_marks};
use super::svg::{Anchor, Canvas, Stroke, Text};
use super::text;

/// Width of every figure: 160 mm.
pub(super) const WIDTH: f64 = 640.0;
/// Points in one figure, whatever it is given: about 250 kB.
const BUDGET: usize = 22_000;

/// A figure: panels under one another that share the horizontal axis.
#[derive(Debug, Clone)]
pub struct Figure {
    title: String,
    x_label: String,
    x_scale: Scale,
    panels: Vec<Panel>,
}

impl Figure {
    /// A figure without panels; `x_label` says quantity and unit, for example `Time (s)`.
    pub fn new(title: impl Into<String>, x_label: impl Into<String>) -> Self {
        Self { title: title.into(), x_label: x_label.into(), x_scale: Scale::Linear, panels: Vec::new() }
    }

    /// Makes the horizontal axis logarithmic.
    #[must_use]
    pub fn log(mut self) -> Self {
        self.x_scale = Scale::Log;
        self
    }

    /// Adds a panel below those already there.
    #[must_use]
    pub fn panel(mut self, panel: Panel) -> Self {
        self.panels.push(panel);
        self
    }

    /// The figure as SVG text.
    #[must_use]
    pub fn to_svg(&self) -> String {
        let height = match self.panels.len() {
            0 | 1 if self.x_scale == Scale::Log => 320.0,
            0 | 1 => 260.0,
            2 => 165.0,
            _ => 130.0,
        };
        let entries = self.entries();
        let shown = entries.iter().filter(|(label, _)| !label.is_empty()).cloned().collect();
        let legend = Legend::new(shown, WIDTH - 20.0);
        let y_axes: Vec<Axis> = self.panels.iter().map(|p| p.y_axis(self.x_scale, height)).collect();

        // Margins, the same for all panels so that their frames stand under one another.
        let y_labels: Vec<_> = self.panels.iter().map(|p| text::wrap(&p.y_label, LABEL, height + 10.0, 2)).collect();
        let label_lines = y_labels.iter().map(Vec::len).max().unwrap_or(0) as f64;
        let left = 12.0 + 14.0 * label_lines + y_axes.iter().map(widest).fold(0.0, f64::max) + 8.0;
        let beside =
            |p: &Panel| p.marks.iter().filter(|m| !m.upright).map(|m| mark_width(&m.label)).fold(0.0, f64::max);
        let right = self.panels.iter().map(beside).fold(18.0, f64::max);
        let width = WIDTH - left - right;
        let x_axis = self.x_axis(width);

        let title = text::wrap(&self.title, TITLE, WIDTH - 40.0, 3);
        let heads: Vec<f64> = self.panels.iter().zip(&y_axes).map(|(p, axis)| head_height(p, axis)).collect();
        let top = 12.0 + 17.0 * title.len() as f64;
        let frames = heads.iter().sum::<f64>() + (height + 10.0) * self.panels.len() as f64;
        let total = top + frames + 40.0 + legend.height() + 6.0;

        let mut canvas = Canvas::new(WIDTH, total, &self.title);
        for (i, line) in title.iter().enumerate() {
            let y = 22.0 + 17.0 * i as f64;
            canvas.text(Text { bold: true, ..Text::new(left + width / 2.0, y, line, TITLE, Anchor::Middle) });
        }
        let mut y = top;
        for (i, ((panel, y_axis), head)) in self.panels.iter().zip(&y_axes).zip(&heads).enumerate() {
            y += head;
            let frame = Frame { x: left, y, width, height, x_axis: &x_axis, y_axis };
            let last = i + 1 == self.panels.len();
            draw_grid(&mut canvas, &frame);
            self.draw_inside(&mut canvas, panel, &frame, &entries);
            draw_axes(&mut canvas, &frame, last);
            draw_labels(&mut canvas, panel, &frame);
            let middle = y + height / 2.0;
            for (k, line) in y_labels.get(i).into_iter().flatten().enumerate() {
                let text = Text::new(18.0 + 14.0 * k as f64, middle, line, LABEL, Anchor::Middle);
                canvas.text(Text { upwards: true, ..text });
            }
            y += height + 10.0;
        }
        let x_label = text::shorten(&self.x_label, LABEL, WIDTH - 20.0);
        canvas.text(Text::new(left + width / 2.0, y + 24.0, &x_label, LABEL, Anchor::Middle));
        legend.draw(&mut canvas, 10.0, y + 36.0, WIDTH - 20.0);
        canvas.finish()
    }

    fn x_axis(&self, width: f64) -> Axis {
        let mut extent = Extent::EMPTY;
        for (xs, _) in self.panels.iter().map(|p| p.extents(self.x_scale)).filter(|(xs, _)| !xs.is_empty()) {
            extent.include(xs.low);
            extent.include(xs.high);
        }
        let marks = self.panels.iter().flat_map(|p| &p.marks).filter(|m| m.upright).map(|m| m.value);
        let forward = self.x_scale == Scale::Linear && self.panels.iter().all(Panel::goes_forward);
        let share = match forward {
            true if self.panels.iter().all(|p| p.stems.is_empty()) => 0.0,
            true => 0.01,
            false => 0.05,
        };
        let extent = include_marks(extent, marks, self.x_scale).padded(share, self.x_scale);
        Axis::new(self.x_scale, extent, (width / 50.0) as usize)
    }

    /// Distinct labels in the order of appearance, each with its look.
    fn entries(&self) -> Vec<(String, Look)> {
        let mut known: Vec<Entry<'_>> = Vec::new();
        let mut next = 0;
        for entry in self.panels.iter().flat_map(Panel::entries) {
            if let Some(known) = known.iter_mut().find(|known| known.label == entry.label) {
                known.marked |= entry.marked;
                known.line |= entry.line;
            } else {
                next += usize::from(entry.role == Role::Ordinary);
                known.push(Entry { look: Some(entry.look.unwrap_or(next.max(1) - 1)), ..entry });
            }
        }
        let shown = |entry: Entry<'_>| {
            let mut look = look(entry.look.unwrap_or(0), entry.role, entry.marked);
            if !entry.line {
                look.stroke = Stroke::solid(look.stroke.colour, 1.0);
            }
            (entry.label.to_owned(), look)
        };
        known.into_iter().map(shown).collect()
    }

    fn draw_inside(&self, canvas: &mut Canvas, panel: &Panel, frame: &Frame<'_>, entries: &[(String, Look)]) {
        let budget = BUDGET / self.panels.iter().map(|p| p.curves.len() + p.stems.len()).sum::<usize>().max(1);
        let found = |label: &str| entries.iter().find(|(known, _)| known == label).map(|(_, look)| *look);
        canvas.open_window(frame.x, frame.y, frame.width, frame.height);
        for role in [Role::Front, Role::Backdrop] {
            for curve in panel.curves.iter().filter(|c| c.role == role) {
                frame.draw_curve(canvas, curve, look(0, role, true), budget);
            }
        }
        frame.draw_marks(canvas, &panel.marks);
        for curve in panel.curves.iter().filter(|c| c.role == Role::Ordinary) {
            if let Some(found) = found(&curve.label) {
                let marker = found.marker.filter(|_| curve.marked);
                frame.draw_curve(canvas, curve, Look { marker, ..found }, budget);
            }
        }
        for stems in &panel.stems {
            if let Some(found) = found(&stems.label) {
                frame.draw_stems(canvas, stems, found, budget);
            }
        }
        canvas.close_window();
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

fn mark_width(label: &str) -> f64 {
    // An arrow stands before it where the mark lies outside.
    (text::width(label, SMALL) + 18.0).clamp(18.0, 150.0)
}

fn draw_grid(canvas: &mut Canvas, frame: &Frame<'_>) {
    let upright = frame.x_axis.ticks.iter().map(|t| frame.across(frame.x_axis.share_of_even(t.even)));
    let level = frame.y_axis.ticks.iter().map(|t| frame.up(frame.y_axis.share_of_even(t.even)));
    let mut lines: Vec<_> = upright.map(|x| vec![(x, frame.y), (x, frame.y + frame.height)]).collect();
    lines.extend(level.map(|y| vec![(frame.x, y), (frame.x + frame.width, y)]));
    canvas.path(&lines, GRID);
}

/// Frame, ticks and numbers; those of the horizontal axis only under the `last` panel.
pub(super) fn draw_axes(canvas: &mut Canvas, frame: &Frame<'_>, last: bool) {
    let bottom = frame.y + frame.height;
    let end = frame.x + frame.width;
    let mut ticks = Vec::new();
    for (evens, length) in [(&frame.x_axis.minor, 2.5), (&evens(frame.x_axis), 4.5)] {
        for x in evens.iter().map(|even| frame.across(frame.x_axis.share_of_even(*even))) {
            ticks.push(vec![(x, bottom), (x, bottom + length)]);
        }
    }
    for (evens, length) in [(&frame.y_axis.minor, 2.5), (&evens(frame.y_axis), 4.5)] {
        for y in evens.iter().map(|even| frame.up(frame.y_axis.share_of_even(*even))) {
            ticks.push(vec![(frame.x, y), (frame.x - length, y)]);
        }
    }
    canvas.path(&ticks, FRAME);
    canvas.frame(frame.x, frame.y, frame.width, frame.height, FRAME);
    for tick in &frame.y_axis.ticks {
        let y = frame.up(frame.y_axis.share_of_even(tick.even)) + 3.6;
        let text = Text::new(frame.x - 7.0, y, &tick.body, SMALL, Anchor::End);
        canvas.text(Text { exponent: tick.exponent, ..text });
    }
    if let Some(power) = frame.y_axis.factor {
        let text = Text::new(frame.x, frame.y - 5.0, "×10", SMALL, Anchor::Start);
        canvas.text(Text { exponent: Some(power), ..text });
    }
    if last {
        for tick in &frame.x_axis.ticks {
            let x = frame.across(frame.x_axis.share_of_even(tick.even));
            let text = Text::new(x, bottom + 15.5, &tick.body, SMALL, Anchor::Middle);
            canvas.text(Text { exponent: tick.exponent, ..text });
        }
        if let Some(power) = frame.x_axis.factor {
            let text = Text::new(end, bottom + 29.0, "×10", SMALL, Anchor::End);
            canvas.text(Text { exponent: Some(power), ..text });
        }
    }
}

fn evens(axis: &Axis) -> Vec<f64> {
    axis.ticks.iter().map(|tick| tick.even).collect()
}

/// Heading, and the names of the marks: beside the frame, or above it for upright ones.
fn draw_labels(canvas: &mut Canvas, panel: &Panel, frame: &Frame<'_>) {
    let level: Vec<_> = panel.marks.iter().filter(|m| !m.upright).collect();
    let mut placed: Vec<(f64, String)> = Vec::new();
    for mark in level {
        let Some(share) = frame.y_axis.share(mark.value) else { continue };
        let (share, label) = arrowed(share, &mark.label, ["↓ ", "↑ "]);
        placed.push((frame.up(share), text::shorten(&label, SMALL, 144.0)));
    }
    placed.sort_by(|a, b| a.0.total_cmp(&b.0));
    let mut lowest = f64::NEG_INFINITY;
    for (y, label) in &placed {
        let y_text = y.max(lowest + SMALL + 1.0);
        lowest = y_text;
        let end = frame.x + frame.width;
        canvas.line((end, *y), (end + 4.0, y_text), Stroke::solid("#333", 0.6));
        canvas.text(Text::new(end + 6.0, y_text + 3.5, label, SMALL, Anchor::Start));
    }
    let mut free = frame.x + if frame.y_axis.factor.is_some() { 34.0 } else { 0.0 };
    let mut upright: Vec<_> = panel.marks.iter().filter(|m| m.upright).collect();
    upright.sort_by(|a, b| a.value.total_cmp(&b.value));
    let mut placed: Vec<(f64, f64, String)> = Vec::new();
    for mark in upright {
        let Some(share) = frame.x_axis.share(mark.value) else { continue };
        let (share, label) = arrowed(share, &mark.label, ["← ", "→ "]);
        let label = text::shorten(&label, SMALL, 180.0);
        let width = text::width(&label, SMALL);
        let x = (frame.across(share) - width / 2.0).max(free);
        free = x + width + 6.0;
        placed.push((x, width, label));
    }
    let mut limit = WIDTH - 4.0;
    for (x, width, label) in placed.iter().rev() {
        let x = x.min(limit - width).max(4.0);
        limit = x - 6.0;
        canvas.text(Text::new(x, frame.y - 4.0, label, SMALL, Anchor::Start));
    }
    if !panel.heading.is_empty() {
        let y = frame.y - head_height(panel, frame.y_axis) + 17.0;
        let heading = text::shorten(&panel.heading, LABEL, frame.width);
        canvas.text(Text { bold: true, ..Text::new(frame.x, y, &heading, LABEL, Anchor::Start) });
    }
}

/// A mark outside the frame is named at its edge, with an arrow towards it.
fn arrowed(share: f64, label: &str, arrows: [&str; 2]) -> (f64, String) {
    let [below, above] = arrows;
    if share < 0.0 {
        (0.0, format!("{below}{label}"))
    } else if share > 1.0 {
        (1.0, format!("{above}{label}"))
    } else {
        (share, label.to_owned())
    }
}
