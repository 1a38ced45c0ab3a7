//! The look of curves: what distinguishes a curve from its neighbours, in colour and in greyscale.

use super::svg::{Anchor, Canvas, Stroke, Text};

/// Width of every figure: 160 mm.
pub(super) const WIDTH: f64 = 640.0;
/// Sizes in quarters of a millimetre: body text of a paper at 160 mm width.
pub(super) const TITLE: f64 = 13.0;
/// Axis labels, legend.
pub(super) const LABEL: f64 = 11.5;
/// Tick numbers, wall labels.
pub(super) const SMALL: f64 = 10.0;
/// Frame and ticks.
pub(super) const FRAME: Stroke = Stroke::solid("#000", 0.8);
/// Lines at the ticks.
pub(super) const GRID: Stroke = Stroke::solid("#e6e6e6", 0.6);

/// Neighbours differ in lightness as well as in hue (after Okabe and Ito).
const COLOURS: [&str; 8] = ["#000000", "#0072b2", "#d55e00", "#56b4e9", "#7b3294", "#e69f00", "#00614a", "#8a8a8a"];
const DASHES: [&str; 8] = ["", "7 2.5", "2 2", "7 2 1.5 2", "12 3", "4 1.5", "9 2 1.5 2 1.5 2", "1.2 1.6"];
const MARKERS: [Marker; 10] = [
    Marker::Disc,
    Marker::Square,
    Marker::Triangle,
    Marker::Diamond,
    Marker::Cross,
    Marker::Ring,
    Marker::OpenSquare,
    Marker::Down,
    Marker::OpenDiamond,
    Marker::Plus,
];

/// Marker shapes, distinguishable without colour.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Marker {
    Disc,
    Square,
    Triangle,
    Diamond,
    Cross,
    Ring,
    OpenSquare,
    Down,
    OpenDiamond,
    Plus,
}

/// The role of a curve in its figure.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub(super) enum Role {
    /// One of several curves.
    #[default]
    Ordinary,
    /// The reference that others are compared with: a wide pale line beneath them.
    Backdrop,
    /// The front of best points: a wide pale line and a ring round every point.
    Front,
}

/// All that is needed to draw a curve and its legend sample.
#[derive(Debug, Clone, Copy)]
pub(super) struct Look {
    pub stroke: Stroke,
    pub marker: Option<Marker>,
    pub role: Role,
}

/// The colour of the look `number`.
pub(super) fn colour(number: usize) -> &'static str {
    COLOURS.get(number % COLOURS.len()).copied().unwrap_or_default()
}

/// The look of label number `number` in a figure; looks repeat after 80.
pub(super) fn look(number: usize, role: Role, marked: bool) -> Look {
    let dash = DASHES.get((number + number / 8) % DASHES.len()).copied().unwrap_or_default();
    let stroke = match role {
        Role::Ordinary => Stroke { colour: colour(number), width: 1.2, dash },
        Role::Backdrop => Stroke::solid("#c4c4c4", 3.6),
        Role::Front => Stroke::solid("#d9d9d9", 7.0),
    };
    let marker = match role {
        Role::Ordinary => MARKERS.get(number % MARKERS.len()).copied().filter(|_| marked),
        Role::Backdrop => Some(Marker::Disc).filter(|_| marked),
        Role::Front => Some(Marker::Ring),
    };
    Look { stroke, marker, role }
}

impl Look {
    /// Draws one marker.
    pub(super) fn mark(&self, canvas: &mut Canvas, x: f64, y: f64) {
        let Some(marker) = self.marker else { return };
        if self.role == Role::Front {
            canvas.circle(x, y, 5.0, "none", Stroke::solid("#444", 1.1));
            return;
        }
        marker.draw(canvas, x, y, 2.8, self.stroke.colour);
    }

    /// Draws the sample of the legend, from `x` to `x + length` at height `y`.
    pub(super) fn sample(&self, canvas: &mut Canvas, x: f64, y: f64, length: f64) {
        canvas.line((x, y), (x + length, y), self.stroke);
        self.mark(canvas, x + length / 2.0, y);
    }
}

impl Marker {
    /// Draws the shape with half-width `r`.
    pub(super) fn draw(self, canvas: &mut Canvas, x: f64, y: f64, r: f64, colour: &'static str) {
        let solid = Stroke::solid(colour, 0.8);
        let open = Stroke::solid(colour, 1.1);
        let square = [(x - r, y - r), (x + r, y - r), (x + r, y + r), (x - r, y + r)];
        let d = 1.35 * r;
        let diamond = [(x, y - d), (x + d, y), (x, y + d), (x - d, y)];
        match self {
            Self::Disc => canvas.circle(x, y, 1.1 * r, colour, solid),
            Self::Ring => canvas.circle(x, y, 1.1 * r, "#fff", open),
            Self::Square => canvas.shape(&square, colour, solid),
            Self::OpenSquare => canvas.shape(&square, "#fff", open),
            Self::Triangle => canvas.shape(&[(x, y - d), (x + d, y + r), (x - d, y + r)], colour, solid),
            Self::Down => canvas.shape(&[(x, y + d), (x + d, y - r), (x - d, y - r)], colour, solid),
            Self::Diamond => canvas.shape(&diamond, colour, solid),
            Self::OpenDiamond => canvas.shape(&diamond, "#fff", open),
            Self::Cross => canvas.path(
                &[vec![(x - r, y - r), (x + r, y + r)], vec![(x - r, y + r), (x + r, y - r)]],
                Stroke::solid(colour, 1.4),
            ),
            Self::Plus => {
                canvas.path(&[vec![(x - d, y), (x + d, y)], vec![(x, y - d), (x, y + d)]], Stroke::solid(colour, 1.4));
            }
        }
    }
}

/// Draws the lines of the title of a figure, centred at `x`.
pub(super) fn draw_heading(canvas: &mut Canvas, lines: &[String], x: f64) {
    for (i, line) in lines.iter().enumerate() {
        let y = 22.0 + 17.0 * i as f64;
        canvas.text(Text { bold: true, ..Text::new(x, y, line, TITLE, Anchor::Middle) });
    }
}
