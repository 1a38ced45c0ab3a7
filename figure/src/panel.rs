//! One frame of a figure: its vertical axis and its contents.

use super::axis::{Axis, Extent, Scale};
use super::curve::{Curve, Mark};
use super::look::Role;
use super::thin::{Spot, never_goes_back};

/// One frame: a vertical axis, curves, stems and marks.
#[derive(Debug, Clone, Default)]
pub struct Panel {
    pub(super) heading: String,
    pub(super) y_label: String,
    pub(super) y_scale: Scale,
    pub(super) y_range: Option<(f64, f64)>,
    pub(super) curves: Vec<Curve>,
    pub(super) stems: Vec<Curve>,
    pub(super) marks: Vec<Mark>,
    pub(super) outlines: Vec<Vec<(f64, f64)>>,
    pub(super) areas: Vec<Vec<(f64, f64)>>,
    /// The look whose colour outlines and areas have.
    pub(super) colour: Option<usize>,
    /// Smallest range that is drawn as such, and the range drawn instead of a smaller one.
    pub(super) still: (f64, f64),
}

impl Panel {
    /// An empty frame whose vertical axis is labelled `y_label`, for example `Displacement (mm)`.
    pub fn new(y_label: impl Into<String>) -> Self {
        Self { y_label: y_label.into(), ..Self::default() }
    }

    /// A heading above the frame: the method or the wall that the panel shows.
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

    /// Sets the vertical range; what lies outside is cut off at the frame.
    #[must_use]
    pub fn range(mut self, low: f64, high: f64) -> Self {
        self.y_range = Some((low, high));
        self
    }

    /// Draws data that vary by less than `limit` on a linear vertical axis as a flat line, on an
    /// axis of at least `span`: a motion of 1e-81 m is rounding, not a motion to be magnified.
    #[must_use]
    pub fn still_below(mut self, limit: f64, span: f64) -> Self {
        self.still = (limit, span);
        self
    }

    /// Adds a curve.
    #[must_use]
    pub fn curve(mut self, curve: Curve) -> Self {
        self.curves.push(curve);
        self
    }

    /// Adds vertical strokes from zero with a marker at their end, one for each point of `stems`:
    /// impulses. Forces and impulses have different units: give each its own panel.
    #[must_use]
    pub fn stems(mut self, stems: Curve) -> Self {
        self.stems.push(stems);
        self
    }

    /// Adds a wall or a floor.
    #[must_use]
    pub fn mark(mut self, mark: Mark) -> Self {
        self.marks.push(mark);
        self
    }

    /// Adds a line through `points`, drawn as a wall: the outline of what bounds a motion in the
    /// plane of both axes. The ranges of the axes do not grow for it.
    #[must_use]
    pub fn outline(mut self, points: impl IntoIterator<Item = (f64, f64)>) -> Self {
        self.outlines.push(points.into_iter().collect());
        self
    }

    /// Adds an area with these corners, filled behind all lines. The ranges of the axes do not grow
    /// for it.
    #[must_use]
    pub fn area(mut self, corners: impl IntoIterator<Item = (f64, f64)>) -> Self {
        self.areas.push(corners.into_iter().collect());
        self
    }

    /// Draws outlines and areas in the colour of the look `number`.
    #[must_use]
    pub fn colour(mut self, number: usize) -> Self {
        self.colour = Some(number);
        self
    }

    /// The labels of the legend, in the order of drawing.
    pub(super) fn entries(&self) -> Vec<Entry<'_>> {
        let curve = |c: &Curve| (c.role, c.marked, (c.look, c.colour));
        let curves = self.curves.iter().map(|c| (c.label.as_str(), curve(c), true));
        let stems = self.stems.iter().map(|s| (s.label.as_str(), (s.role, true, (s.look, s.colour)), false));
        let entry = |(label, (role, marked, (look, colour)), line)| Entry { label, role, marked, line, look, colour };
        curves.chain(stems).map(entry).collect()
    }

    /// Range of the contents: (horizontal, vertical), before padding and without marks.
    pub(super) fn extents(&self, x_scale: Scale) -> (Extent, Extent) {
        let (mut xs, mut ys) = (Extent::EMPTY, Extent::EMPTY);
        let points = self.curves.iter().map(|c| &c.points).chain(self.stems.iter().map(|s| &s.points)).flatten();
        let bands = self.curves.iter().flat_map(Curve::bands).flatten();
        let edges = bands.flat_map(|(x, low, high)| [(x, low), (x, high)]);
        for (x, y) in points.copied().chain(edges).filter_map(|p| Some((x_scale.even(p.0)?, self.y_scale.even(p.1)?))) {
            xs.include(x);
            ys.include(y);
        }
        if !self.stems.is_empty() && self.y_scale == Scale::Linear {
            ys.include(0.0);
        }
        (xs, ys)
    }

    /// True where no curve has markers and x never decreases along any: the axis then ends where
    /// the data end; otherwise it gets a margin.
    pub(super) fn goes_forward(&self) -> bool {
        self.curves.iter().all(|curve| {
            let spots: Vec<Spot> = curve.points.iter().map(|p| p.0.is_finite().then_some(*p)).collect();
            !curve.marked && curve.role != Role::Front && never_goes_back(&spots)
        })
    }

    /// The vertical axis of a frame of that `height`.
    pub(super) fn y_axis(&self, x_scale: Scale, height: f64) -> Axis {
        let wanted = ((height / 34.0) as usize).max(3);
        let given = self.y_range.and_then(|(a, b)| Some((self.y_scale.even(a)?, self.y_scale.even(b)?)));
        let extent = match given.filter(|(low, high)| low < high) {
            Some((low, high)) => Extent { low, high },
            None => {
                let marks = self.marks.iter().filter(|m| !m.upright).map(|m| m.value);
                let mut data = self.extents(x_scale).1;
                if self.y_scale == Scale::Linear && !data.is_empty() && data.span() < self.still.0 {
                    let middle = 0.5 * (data.low + data.high);
                    data = Extent { low: middle, high: middle };
                    let grown = include_marks(data, marks, self.y_scale);
                    let missing = 0.5 * (self.still.1 - grown.span()).max(0.0);
                    Extent { low: grown.low - missing, high: grown.high + missing }.padded(0.06, self.y_scale)
                } else {
                    include_marks(data, marks, self.y_scale).padded(0.06, self.y_scale)
                }
            }
        };
        Axis::new(self.y_scale, extent, wanted)
    }
}

/// One label of a panel and how its curves or stems are drawn.
#[derive(Debug, Clone, Copy)]
pub(super) struct Entry<'a> {
    pub label: &'a str,
    pub role: Role,
    pub marked: bool,
    /// False for stems, which have no dash pattern.
    pub line: bool,
    pub look: Option<usize>,
    pub colour: Option<usize>,
}

/// Grows a range to include the marks, as long as the data keep a fifth of it.
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

#[cfg(test)]
mod tests {
    use super::{Curve, Panel, Scale};

    #[test]
    fn the_axis_holds_the_band_about_a_curve() {
        let curve = Curve::new("mean", [(0.0, 1.0), (1.0, 2.0), (2.0, 4.0)]).banded([0.5, 3.0, f64::NAN]);
        let (xs, ys) = Panel::new("y").curve(curve).extents(Scale::Linear);
        assert_eq!([xs.low, xs.high, ys.low, ys.high], [0.0, 2.0, -1.0, 5.0]);
    }
}
