//! Lines and signs over a scatter: branches of solutions and their special points.

use super::look::{Look, Marker, Role};
use super::plot_area::PlotArea;
use super::svg::{Canvas, Stroke};

/// How a line over the points of a [`Scatter`](super::Scatter) is drawn.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Line {
    /// Solid.
    Solid,
    /// Dashed.
    Dashed,
    /// Dotted and grey.
    Dotted,
}

/// The shape of a sign.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Sign {
    /// A triangle.
    Triangle,
    /// An open diamond.
    Diamond,
    /// A ring.
    Ring,
    /// A disc.
    Disc,
    /// A cross, ×.
    Cross,
    /// A cross, +.
    Plus,
    /// An open square.
    Square,
}

impl Line {
    const ALL: [Self; 3] = [Self::Solid, Self::Dashed, Self::Dotted];

    fn stroke(self) -> Stroke {
        match self {
            Self::Solid => Stroke::solid("#0072b2", 1.6),
            Self::Dashed => Stroke { dash: "5 2.5", ..Stroke::solid("#d55e00", 1.2) },
            Self::Dotted => Stroke { dash: "1.2 2", ..Stroke::solid("#777777", 1.0) },
        }
    }
}

impl Sign {
    fn marker(self) -> Marker {
        match self {
            Self::Triangle => Marker::Triangle,
            Self::Diamond => Marker::OpenDiamond,
            Self::Ring => Marker::Ring,
            Self::Disc => Marker::Disc,
            Self::Cross => Marker::Cross,
            Self::Plus => Marker::Plus,
            Self::Square => Marker::OpenSquare,
        }
    }

    fn look(self, line: Stroke) -> Look {
        Look { stroke: line, marker: Some(self.marker()), role: Role::Ordinary }
    }
}

/// One line.
#[derive(Debug, Clone)]
struct Run {
    line: Line,
    label: String,
    points: Vec<(f64, f64)>,
}

/// The lines and signs over the points.
#[derive(Debug, Clone, Default)]
pub(super) struct Overlay {
    lines: Vec<Run>,
    signs: Vec<(Sign, String, (f64, f64))>,
}

impl Overlay {
    pub fn line(&mut self, line: Line, label: &str, points: Vec<(f64, f64)>) {
        self.lines.push(Run { line, label: label.to_owned(), points });
    }

    pub fn sign(&mut self, sign: Sign, label: &str, at: (f64, f64)) {
        self.signs.push((sign, label.to_owned(), at));
    }

    pub fn is_empty(&self) -> bool {
        self.lines.is_empty() && self.signs.is_empty()
    }

    /// Draws lines, then signs; a point that cannot be drawn breaks a line.
    pub fn draw(&self, canvas: &mut Canvas, frame: &PlotArea<'_>) {
        let spot = |(x, y): (f64, f64)| Some((frame.across(frame.x_axis.share(x)?), frame.up(frame.y_axis.share(y)?)));
        // Unstable ones beneath, so that stable ones stay whole.
        for kind in Line::ALL.into_iter().rev() {
            let of_kind = self.lines.iter().filter(|run| run.line == kind);
            let mut runs = Vec::new();
            for run in of_kind {
                let spots: Vec<Option<(f64, f64)>> = run.points.iter().map(|&point| spot(point)).collect();
                runs.extend(spots.split(Option::is_none).map(|run| run.iter().flatten().copied().collect::<Vec<_>>()));
            }
            canvas.path(&runs, kind.stroke());
        }
        for (sign, _, at) in &self.signs {
            if let Some((x, y)) = spot(*at) {
                sign.marker().draw(canvas, x, y, 3.2, "#000000");
            }
        }
    }

    /// Entries of the legend: each label once.
    pub fn entries(&self) -> Vec<(String, Look)> {
        let mut entries: Vec<(String, Look)> = Vec::new();
        let mut add = |label: &str, look: Look| {
            if !label.is_empty() && !entries.iter().any(|(known, _)| known == label) {
                entries.push((label.to_owned(), look));
            }
        };
        for kind in Line::ALL {
            for run in self.lines.iter().filter(|run| run.line == kind) {
                add(&run.label, Look { stroke: kind.stroke(), marker: None, role: Role::Ordinary });
            }
        }
        for (sign, label, _) in &self.signs {
            add(label, sign.look(Stroke { width: 0.0, ..Stroke::solid("#000000", 0.0) }));
        }
        entries
    }
}
