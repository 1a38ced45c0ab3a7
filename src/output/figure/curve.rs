//! What a panel shows: curves, stems and marks.

use super::look::Role;

/// A line through points, broken where a point cannot be drawn.
///
/// Curves of one label look the same in all panels of a figure and share one legend entry; an empty label has none.
#[derive(Debug, Clone)]
pub struct Curve {
    pub(super) label: String,
    /// Pairs (x, y) in the units of the axes; whoever makes the figure writes them.
    pub(super) points: Vec<(f64, f64)>,
    pub(super) role: Role,
    pub(super) marked: bool,
    pub(super) oscillates: bool,
    pub(super) look: Option<usize>,
}

impl Curve {
    /// A line through `points`, in their order.
    pub fn new(label: impl Into<String>, points: impl IntoIterator<Item = (f64, f64)>) -> Self {
        let points = points.into_iter().collect();
        Self { label: label.into(), points, role: Role::Ordinary, marked: false, oscillates: false, look: None }
    }

    /// Also draws a marker at every point (of very many, at some 200 evenly chosen ones).
    #[must_use]
    pub fn marked(mut self) -> Self {
        self.marked = true;
        self
    }

    /// Says that it oscillates: where it does so too fast for the page, a filled envelope between its lowest and highest
    /// values is drawn in its place.
    #[must_use]
    pub fn oscillating(mut self) -> Self {
        self.oscillates = true;
        self
    }

    /// Draws it wide and pale beneath the others: the reference that they are held against.
    #[must_use]
    pub fn backdrop(mut self) -> Self {
        self.role = Role::Backdrop;
        self
    }

    /// Draws it as the front of best points: a wide pale line beneath the others and a ring round each of its points.
    #[must_use]
    pub fn front(mut self) -> Self {
        self.role = Role::Front;
        self
    }

    /// Fixes the look by number (0 is black and solid) instead of by the order of labels, so that one method looks the
    /// same in several figures.
    #[must_use]
    pub fn look(mut self, number: usize) -> Self {
        self.look = Some(number);
        self
    }
}

/// Vertical strokes from zero with a marker at their end: impulses.
#[derive(Debug, Clone)]
pub struct Stems {
    pub(super) label: String,
    /// Pairs (x, y) in the units of the axes; whoever makes the figure writes them.
    pub(super) points: Vec<(f64, f64)>,
    pub(super) role: Role,
    pub(super) look: Option<usize>,
}

impl Stems {
    /// One stroke for each of `points`. Forces and impulses have different units: give each its own panel.
    pub fn new(label: impl Into<String>, points: impl IntoIterator<Item = (f64, f64)>) -> Self {
        Self { label: label.into(), points: points.into_iter().collect(), role: Role::Ordinary, look: None }
    }

    /// Draws them wide and pale beneath the others, as [`Curve::backdrop`] does.
    #[must_use]
    pub fn backdrop(mut self) -> Self {
        self.role = Role::Backdrop;
        self
    }

    /// Fixes the look by number, as [`Curve::look`] does.
    #[must_use]
    pub fn look(mut self, number: usize) -> Self {
        self.look = Some(number);
        self
    }
}

/// A labelled straight line across the panel.
///
/// The range grows to show it, unless that would leave less than a fifth of the panel to the curves; then its label
/// stands at the edge with an arrow towards it.
#[derive(Debug, Clone)]
pub struct Mark {
    pub(super) value: f64,
    pub(super) label: String,
    pub(super) upright: bool,
    pub(super) kind: MarkKind,
}

/// What a mark stands for, hence how it is drawn.
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

    /// The same line upright, at x = `value`: a wall of a phase plot.
    #[must_use]
    pub fn upright(mut self) -> Self {
        self.upright = true;
        self
    }
}
