//! The contents of a panel: curves and marks.

use super::look::Role;

/// A line through points, broken where a point cannot be drawn.
///
/// Curves of one label look the same in all panels of a figure and share one legend entry; an empty
/// label has none.
#[derive(Debug, Clone)]
pub struct Curve {
    pub(super) label: String,
    /// Pairs (x, y) in the units of the axes.
    pub(super) points: Vec<(f64, f64)>,
    /// Half the height of the band at each point; empty without a band.
    pub(super) half_widths: Vec<f64>,
    pub(super) role: Role,
    pub(super) marked: bool,
    pub(super) oscillates: bool,
    pub(super) look: Option<usize>,
    pub(super) colour: Option<usize>,
}

impl Curve {
    /// A line through `points`, in their order.
    pub fn new(label: impl Into<String>, points: impl IntoIterator<Item = (f64, f64)>) -> Self {
        let points = points.into_iter().collect();
        Self {
            label: label.into(),
            points,
            half_widths: Vec::new(),
            role: Role::Ordinary,
            marked: false,
            oscillates: false,
            look: None,
            colour: None,
        }
    }

    /// Also draws a marker at every point (at some 200 evenly chosen points where there are more).
    #[must_use]
    pub fn marked(mut self) -> Self {
        self.marked = true;
        self
    }

    /// Also fills a band about the curve, in its colour: the interval of each value, y ± half
    /// width, in the order of the points. It is broken where a half width is not finite; about a
    /// point between two breaks it is a vertical stroke.
    #[must_use]
    pub fn banded(mut self, half_widths: impl IntoIterator<Item = f64>) -> Self {
        self.half_widths = half_widths.into_iter().collect();
        self
    }

    /// The stretches of the band: at each point its x, and the two edges.
    pub(super) fn bands(&self) -> Vec<Vec<(f64, f64, f64)>> {
        let known = |pair: &(&(f64, f64), &f64)| pair.0.1.is_finite() && pair.1.is_finite();
        let pairs: Vec<_> = self.points.iter().zip(&self.half_widths).collect();
        let edges = |&(&(x, y), half): &(&(f64, f64), &f64)| (x, y - half, y + half);
        pairs.split(|pair| !known(pair)).map(|run| run.iter().map(edges).collect()).collect()
    }

    /// Says that the curve oscillates: where it does so too fast for the page, a filled envelope
    /// between its lowest and highest values is drawn instead.
    #[must_use]
    pub fn oscillating(mut self) -> Self {
        self.oscillates = true;
        self
    }

    /// Draws the curve wide and pale beneath the others, as the reference that they are compared
    /// with.
    #[must_use]
    pub fn backdrop(mut self) -> Self {
        self.role = Role::Backdrop;
        self
    }

    /// Draws the curve as the front of best points: a wide pale line beneath the others and a ring
    /// round each point.
    #[must_use]
    pub fn front(mut self) -> Self {
        self.role = Role::Front;
        self
    }

    /// Sets the look by index (0 is black and solid) instead of by the order of labels, so that a
    /// method looks the same in several figures.
    #[must_use]
    pub fn look(mut self, number: usize) -> Self {
        self.look = Some(number);
        self
    }

    /// Draws the curve in the colour of the look `number`, if there is one, with the dashes and the
    /// marker of its own look: what the colour stands for has it in every figure.
    #[must_use]
    pub fn colour(mut self, number: impl Into<Option<usize>>) -> Self {
        self.colour = number.into();
        self
    }
}

/// A labelled straight line across the panel.
///
/// The range of the axis grows to include the line, unless that would leave less than a fifth of
/// the panel to the curves; in that case its label stands at the edge, with an arrow towards the
/// line.
#[derive(Debug, Clone)]
pub struct Mark {
    pub(super) value: f64,
    pub(super) label: String,
    pub(super) upright: bool,
    pub(super) kind: MarkKind,
}

/// What a mark stands for, which decides how it is drawn.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum MarkKind {
    Wall,
    Floor,
}

impl Mark {
    /// A wall: a dark solid line at height `value`.
    pub fn wall(value: f64, label: impl Into<String>) -> Self {
        Self { value, label: label.into(), upright: false, kind: MarkKind::Wall }
    }

    /// A floor, a limit, an asymptote: a grey dashed line at height `value`.
    pub fn floor(value: f64, label: impl Into<String>) -> Self {
        Self { value, label: label.into(), upright: false, kind: MarkKind::Floor }
    }

    /// The same line vertical, at x = `value`: a wall in a phase plot.
    #[must_use]
    pub fn upright(mut self) -> Self {
        self.upright = true;
        self
    }
}

#[cfg(test)]
mod tests {
    use super::Curve;

    #[test]
    fn a_band_is_broken_where_a_value_or_its_half_width_is_missing() {
        let points = [(0.0, 1.0), (1.0, 2.0), (2.0, f64::NAN), (3.0, 4.0), (4.0, 5.0), (5.0, 6.0)];
        let half_widths = [0.5, 1.0, 1.0, 0.25, f64::NAN, 2.0];
        let bands = Curve::new("mean", points).banded(half_widths).bands();
        let bands: Vec<_> = bands.into_iter().filter(|band| !band.is_empty()).collect();
        let expected = [vec![(0.0, 0.5, 1.5), (1.0, 1.0, 3.0)], vec![(3.0, 3.75, 4.25)], vec![(5.0, 4.0, 8.0)]];
        assert_eq!(bands, expected);
    }
}
