//! A whole figure: title, panels one below the other, one horizontal axis, one legend.

use super::axis::Scale;
use super::labels;
use super::layout::Layout;
use super::legend::Legend;
use super::look::{LABEL, Look, Role, SMALL, TITLE, WIDTH, colour, look};
use super::panel::{Entry, Panel};
use super::plot_area::{Beyond, PlotArea, draw_axes, draw_grid, draw_upwards};
use super::svg::{Anchor, Canvas, Stroke, Text};
use super::text;

/// Most points in one figure, whatever the length of its data: about 250 kB.
const BUDGET: usize = 22_000;

/// A figure: panels one below the other that share the horizontal axis.
#[derive(Debug, Clone)]
pub struct Figure {
    title: String,
    subtitle: String,
    x_label: String,
    pub(super) x_scale: Scale,
    pub(super) x_range: Option<(f64, f64)>,
    pub(super) square: bool,
    pub(super) detail: Option<Detail>,
    pub(super) panels: Vec<Panel>,
}

/// A stretch of the horizontal axis that is drawn a second time beside the whole.
#[derive(Debug, Clone)]
pub(super) struct Detail {
    pub(super) from: f64,
    pub(super) to: f64,
    /// Headings of the two columns.
    headings: [String; 2],
}

/// Factor by which bold letters are wider.
const BOLD: f64 = 1.1;

impl Figure {
    /// A figure without panels; `x_label` gives quantity and unit, for example `Time (s)`.
    pub fn new(title: impl Into<String>, x_label: impl Into<String>) -> Self {
        Self {
            title: title.into(),
            subtitle: String::new(),
            x_label: x_label.into(),
            x_scale: Scale::Linear,
            x_range: None,
            square: false,
            detail: None,
            panels: Vec::new(),
        }
    }

    /// Adds a sentence below the title: what the figure shows.
    #[must_use]
    pub fn subtitle(mut self, subtitle: impl Into<String>) -> Self {
        self.subtitle = subtitle.into();
        self
    }

    /// Makes the horizontal axis logarithmic.
    #[must_use]
    pub fn log(mut self) -> Self {
        self.x_scale = Scale::Log;
        self
    }

    /// Sets the horizontal range: lines are cut off at the frame, and points of marked curves
    /// beyond it are marked at its edge.
    #[must_use]
    pub fn range(mut self, low: f64, high: f64) -> Self {
        self.x_range = Some((low, high));
        self
    }

    /// Draws every frame as a square in the middle of the page: with ranges of one length on both
    /// axes, a circle is round.
    #[must_use]
    pub fn square(mut self) -> Self {
        self.square = true;
        self
    }

    /// Draws every panel twice, side by side with one vertical axis: the whole, in which fast
    /// oscillations become their envelope, and the stretch from `from` to `to`. `headings` name the
    /// two columns.
    #[must_use]
    pub fn detail(mut self, from: f64, to: f64, headings: [&str; 2]) -> Self {
        self.detail = Some(Detail { from, to, headings: headings.map(str::to_owned) });
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
        let entries = self.entries();
        // A single label needs no legend: the title names it.
        let labelled = entries.iter().filter(|(label, _)| !label.is_empty());
        let shown: Vec<_> = labelled.filter(|_| entries.len() > 1).cloned().collect();
        let legend = Legend::new(shown, WIDTH - 20.0);
        let layout = self.layout();

        let title = text::wrap(&self.title, BOLD * TITLE, WIDTH - 20.0, 3);
        let below_title = text::wrap(&self.subtitle, LABEL, WIDTH - 20.0, 3);
        let lines = (title.len() + below_title.len()) as f64;
        let top = 12.0 + 17.0 * lines + if self.detail.is_some() { 15.0 } else { 0.0 };
        let frames = layout.heads.iter().sum::<f64>() + (layout.height + 10.0) * self.panels.len() as f64;
        // A power of ten has a line of its own between the numbers and the label.
        let factor = if layout.columns.iter().any(|c| c.axis.factor.is_some()) { 13.0 } else { 0.0 };
        let below = if legend.height() > 0.0 { 46.0 } else { 36.0 } + factor;
        let total = top + frames + below + legend.height();

        let mut canvas = Canvas::new(WIDTH, total, &self.title);
        for (i, line) in title.iter().chain(&below_title).enumerate() {
            let (bold, size) = if i < title.len() { (true, TITLE) } else { (false, LABEL) };
            let y = 22.0 + 17.0 * i as f64;
            canvas.text(Text { bold, ..Text::new(WIDTH / 2.0, y, line, size, Anchor::Middle) });
        }
        for (column, heading) in layout.columns.iter().zip(self.detail.iter().flat_map(|d| &d.headings)) {
            let heading = text::shorten(heading, LABEL, column.width);
            let middle = column.x + column.width / 2.0;
            canvas.text(Text::new(middle, top + 1.0, &heading, LABEL, Anchor::Middle));
        }
        let mut y = top;
        for (i, head) in layout.heads.iter().enumerate() {
            self.draw_panel(&mut canvas, &layout, i, y, &entries);
            y += head;
            y += layout.height + 10.0;
        }
        let x_label = text::shorten(&self.x_label, LABEL, WIDTH - 20.0);
        let middle = layout.left + layout.width / 2.0;
        canvas.text(Text::new(middle, y + 24.0 + factor, &x_label, LABEL, Anchor::Middle));
        legend.draw(&mut canvas, 10.0, y + 36.0 + factor, WIDTH - 20.0);
        canvas.finish()
    }

    /// Draws panel `index`, whose head begins at height `top`: its frames, labels and heading.
    fn draw_panel(&self, canvas: &mut Canvas, layout: &Layout, index: usize, top: f64, entries: &[(String, Look)]) {
        let Layout { height, left, columns, .. } = layout;
        let (panel, y_axis, head) = (&self.panels[index], &layout.y_axes[index], layout.heads[index]);
        let y = top + head;
        let last = index + 1 == self.panels.len();
        for (k, column) in columns.iter().enumerate() {
            let (x, width, x_axis) = (column.x, column.width, &column.axis);
            let frame = PlotArea { x, y, width, height: *height, x_axis, y_axis, envelopes: k == 0 };
            self.draw_frame(canvas, panel, &frame, entries, k == 0);
            draw_axes(canvas, &frame, k == 0, last);
            let free = match y_axis.factor.filter(|_| k == 0) {
                Some(power) => frame.x + factor_width(power),
                None => frame.x,
            };
            labels::draw_above(canvas, panel, &frame, free.min(frame.x + frame.width));
            if k + 1 == columns.len() {
                labels::draw_beside(canvas, panel, &frame);
            }
        }
        if !panel.heading.is_empty() {
            let heading = text::shorten(&panel.heading, BOLD * LABEL, layout.width);
            let text = Text::new(*left, y - head + 17.0, &heading, LABEL, Anchor::Start);
            canvas.text(Text { bold: true, ..text });
        }
        draw_upwards(canvas, &layout.y_labels[index], layout.aside + 18.0, y + height / 2.0);
    }

    /// Distinct labels in order of appearance, each with its look.
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
            look.stroke.colour = entry.colour.map_or(look.stroke.colour, colour);
            if !entry.line {
                look.stroke = Stroke::solid(look.stroke.colour, 1.0);
            }
            (entry.label.to_owned(), look)
        };
        known.into_iter().map(shown).collect()
    }

    fn draw_frame(
        &self,
        canvas: &mut Canvas,
        panel: &Panel,
        frame: &PlotArea<'_>,
        entries: &[(String, Look)],
        first: bool,
    ) {
        let drawn = self.panels.iter().map(|p| p.curves.len() + p.stems.len()).sum::<usize>().max(1);
        let budget = BUDGET / drawn / if self.detail.is_some() { 2 } else { 1 };
        let found = |label: &str| entries.iter().find(|(known, _)| known == label).map(|(_, look)| *look);
        canvas.open_window(frame.x, frame.y, frame.width, frame.height);
        if let Some(detail) = self.detail.as_ref().filter(|_| first) {
            let share = |value| frame.across(frame.x_axis.share(value).unwrap_or(0.0));
            let (from, to) = (share(detail.from), share(detail.to));
            canvas.rect(from, frame.y, (to - from).max(0.0), frame.height, "#ececec");
        }
        draw_grid(canvas, frame);
        let own = panel.colour.map(colour);
        frame.draw_areas(canvas, &panel.areas, own.unwrap_or("#c0452a"));
        for role in [Role::Front, Role::Backdrop] {
            for curve in panel.curves.iter().filter(|c| c.role == role) {
                frame.draw_curve(canvas, curve, look(0, role, role == Role::Front), budget);
            }
            for stems in panel.stems.iter().filter(|s| s.role == role) {
                frame.draw_stems(canvas, stems, look(0, role, true), budget);
            }
        }
        frame.draw_marks(canvas, &panel.marks);
        frame.draw_outlines(canvas, &panel.outlines, own.unwrap_or("#555"));
        for curve in panel.curves.iter().filter(|c| c.role == Role::Ordinary) {
            if let Some(found) = found(&curve.label) {
                frame.draw_band(canvas, curve, found.stroke.colour);
            }
        }
        for curve in panel.curves.iter().filter(|c| c.role == Role::Ordinary) {
            if let Some(found) = found(&curve.label) {
                let marker = found.marker.filter(|_| curve.marked);
                frame.draw_curve(canvas, curve, Look { marker, ..found }, budget);
            }
        }
        for stems in panel.stems.iter().filter(|s| s.role == Role::Ordinary) {
            if let Some(found) = found(&stems.label) {
                frame.draw_stems(canvas, stems, found, budget);
            }
        }
        if self.x_range.is_some() {
            let mut taken = Beyond::default();
            for curve in panel.curves.iter().filter(|c| c.role == Role::Ordinary && c.marked) {
                if let Some(found) = found(&curve.label) {
                    frame.draw_beyond(canvas, curve, found, &mut taken);
                }
            }
        }
        canvas.close_window();
    }
}

/// Width of a power of ten above an axis.
fn factor_width(power: i32) -> f64 {
    text::width("×10", SMALL) + text::width(&power.to_string(), 0.75 * SMALL) + 8.0
}
