//! One frame of a figure: its vertical axis and what it shows.

use super::axis::{Axis, Extent, Scale};
use super::curve::{Curve, Mark, MarkKind, Stems};
use super::look::{Look, Role};
use super::svg::{Canvas, Stroke};
use super::thin::{Spot, never_goes_back, thin};

/// One frame: a vertical axis, curves, stems and marks.
#[derive(Debug, Clone, Default)]
pub struct Panel {
    pub(super) heading: String,
    pub(super) y_label: String,
    pub(super) y_scale: Scale,
    pub(super) y_range: Option<(f64, f64)>,
    pub(super) curves: Vec<Curve>,
    pub(super) stems: Vec<Stems>,
    pub(super) marks: Vec<Mark>,
}

impl Panel {
    /// An empty frame whose vertical axis says `y_label`, for example `Displacement (mm)`.
    pub fn new(y_label: impl Into<String>) -> Self {
        Self { y_label: y_label.into(), ..Self::default() }
    }

    /// A heading above the frame: the method or the wall that the panel is about.
    #[must_use]
    pub fn heading(mut self, heading: impl Into<String>) -> Self {
        self.heading = heading.into();
        self
    }

    /// Makes the vertical axis logarithmic.
    #[must_use]
    pub fn log(mut self) -> Self {
        self.y_scale = Scale::Log;
        self
    }

    /// Fixes the vertical range; what lies outside is cut off at the frame.
    #[must_use]
    pub fn range(mut self, low: f64, high: f64) -> Self {
        self.y_range = Some((low, high));
        self
    }

    /// Adds a curve.
    #[must_use]
    pub fn curve(mut self, curve: Curve) -> Self {
        self.curves.push(curve);
        self
    }

    /// Adds stems.
    #[must_use]
    pub fn stems(mut self, stems: Stems) -> Self {
        self.stems.push(stems);
        self
    }

    /// Adds a wall or a floor.
    #[must_use]
    pub fn mark(mut self, mark: Mark) -> Self {
        self.marks.push(mark);
        self
    }

    /// What the legend has to tell apart, in the order of drawing.
    pub(super) fn entries(&self) -> Vec<Entry<'_>> {
        let curve = |c: &Curve| (c.role, c.marked, c.look);
        let curves = self.curves.iter().map(|c| (c.label.as_str(), curve(c), true));
        let stems = self.stems.iter().map(|s| (s.label.as_str(), (Role::Ordinary, true, s.look), false));
        let entry = |(label, (role, marked, look), line)| Entry { label, role, marked, line, look };
        curves.chain(stems).map(entry).collect()
    }

    /// Range of what is drawn: (horizontal, vertical), before padding and without marks.
    pub(super) fn extents(&self, x_scale: Scale) -> (Extent, Extent) {
        let (mut xs, mut ys) = (Extent::EMPTY, Extent::EMPTY);
        let points = self.curves.iter().map(|c| &c.points).chain(self.stems.iter().map(|s| &s.points));
        for (x, y) in points.flatten().filter_map(|p| Some((x_scale.even(p.0)?, self.y_scale.even(p.1)?))) {
            xs.include(x);
            ys.include(y);
        }
        if !self.stems.is_empty() && self.y_scale == Scale::Linear {
            ys.include(0.0);
        }
        (xs, ys)
    }

    /// True where every curve goes steadily forward: time runs from edge to edge, everything else gets a margin.
    pub(super) fn goes_forward(&self) -> bool {
        self.curves.iter().all(|curve| {
            let spots: Vec<Spot> = curve.points.iter().map(|p| p.0.is_finite().then_some(*p)).collect();
            !curve.marked && curve.role != Role::Front && never_goes_back(&spots)
        })
    }

    /// The vertical axis of a frame `height` high.
    pub(super) fn y_axis(&self, x_scale: Scale, height: f64) -> Axis {
        let wanted = ((height / 34.0) as usize).max(3);
        let given = self.y_range.and_then(|(a, b)| Some((self.y_scale.even(a)?, self.y_scale.even(b)?)));
        let extent = match given.filter(|(low, high)| low < high) {
            Some((low, high)) => Extent { low, high },
            None => {
                let marks = self.marks.iter().filter(|m| !m.upright).map(|m| m.value);
                include_marks(self.extents(x_scale).1, marks, self.y_scale).padded(0.06, self.y_scale)
            }
        };
        Axis::new(self.y_scale, extent, wanted)
    }
}

/// One label of a panel and how what bears it is drawn.
#[derive(Debug, Clone, Copy)]
pub(super) struct Entry<'a> {
    pub label: &'a str,
    pub role: Role,
    pub marked: bool,
    /// False for stems, which have no dash pattern.
    pub line: bool,
    pub look: Option<usize>,
}

/// Grows a range to hold the marks, as long as a fifth of it is left to the data.
pub(super) fn include_marks(data: Extent, marks: impl Iterator<Item = f64>, scale: Scale) -> Extent {
    let mut grown = data;
    let mut evens: Vec<f64> = marks.filter_map(|mark| scale.even(mark)).collect();
    evens.sort_by(|a, b| a.abs().total_cmp(&b.abs()));
    for even in evens {
        let mut tried = grown;
        tried.include(even);
        if data.is_empty() || data.span() == 0.0 || tried.span() <= 5.0 * data.span() {
            grown = tried;
        }
    }
    grown
}

/// The rectangle of a panel on the page, with both axes.
#[derive(Debug)]
pub(super) struct Frame<'a> {
    pub x: f64,
    pub y: f64,
    pub width: f64,
    pub height: f64,
    pub x_axis: &'a Axis,
    pub y_axis: &'a Axis,
}

impl Frame<'_> {
    pub(super) fn across(&self, share: f64) -> f64 {
        self.x + share * self.width
    }

    pub(super) fn up(&self, share: f64) -> f64 {
        self.y + (1.0 - share) * self.height
    }

    fn spot(&self, point: (f64, f64)) -> Spot {
        Some((self.across(self.x_axis.share(point.0)?), self.up(self.y_axis.share(point.1)?)))
    }

    /// Lines of the marks that lie in the frame.
    pub(super) fn draw_marks(&self, canvas: &mut Canvas, marks: &[Mark]) {
        for mark in marks {
            let stroke = match mark.kind {
                MarkKind::Wall => Stroke::solid("#555", 1.8),
                MarkKind::Floor => Stroke { colour: "#666", width: 1.0, dash: "5 3" },
            };
            let axis = if mark.upright { self.x_axis } else { self.y_axis };
            let Some(share) = axis.share(mark.value).filter(|share| (0.0..=1.0).contains(share)) else { continue };
            if mark.upright {
                let x = self.across(share);
                canvas.line((x, self.y), (x, self.y + self.height), stroke);
            } else {
                let y = self.up(share);
                canvas.line((self.x, y), (self.x + self.width, y), stroke);
            }
        }
    }

    /// A curve of at most about `budget` points, and at most a hundredth as many markers.
    pub(super) fn draw_curve(&self, canvas: &mut Canvas, curve: &Curve, look: Look, budget: usize) {
        let spots: Vec<Spot> = curve.points.iter().map(|p| self.spot(*p)).collect();
        canvas.path(&thin(&spots, budget), look.stroke);
        if look.marker.is_some() {
            let drawn = spots.iter().flatten().count();
            for (x, y) in spots.iter().flatten().step_by(drawn.div_ceil((budget / 100).clamp(4, 200)).max(1)) {
                look.mark(canvas, *x, *y);
            }
        }
    }

    /// Stems from zero; of those that share a column of the page the lowest and the highest.
    pub(super) fn draw_stems(&self, canvas: &mut Canvas, stems: &Stems, look: Look, budget: usize) {
        let columns = (budget as f64 / (4.0 * self.width)).min(2.0);
        let foot = self.up(self.y_axis.share(0.0).unwrap_or(0.0).clamp(0.0, 1.0));
        let spots: Vec<Spot> = stems.points.iter().map(|p| self.spot(*p)).collect();
        let mut ends: Vec<(f64, f64)> = spots.into_iter().flatten().collect();
        ends.sort_by(|a, b| a.0.total_cmp(&b.0));
        let mut kept: Vec<(f64, f64)> = Vec::new();
        for column in ends.chunk_by(|a, b| (columns * a.0).floor() == (columns * b.0).floor()) {
            let lowest = column.iter().copied().reduce(|a, b| if b.1 > a.1 { b } else { a });
            let highest = column.iter().copied().reduce(|a, b| if b.1 < a.1 { b } else { a });
            kept.extend(lowest);
            kept.extend(highest.filter(|_| lowest != highest));
        }
        let strokes: Vec<Vec<(f64, f64)>> = kept.iter().map(|&(x, y)| vec![(x, foot), (x, y)]).collect();
        canvas.path(&strokes, Stroke::solid(look.stroke.colour, if kept.len() > 250 { 0.6 } else { 1.0 }));
        let radius = match kept.len() {
            0..=120 => 2.2,
            121..=250 => 1.4,
            _ => return,
        };
        for (x, y) in kept {
            if let Some(marker) = look.marker {
                marker.draw(canvas, x, y, radius, look.stroke.colour);
            }
        }
    }
}
