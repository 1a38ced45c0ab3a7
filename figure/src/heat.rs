//! A heat map: classes or numbers over two axes, readable in greyscale.

use super::axis::{Axis, Extent, Scale};
use super::class::Class;
use super::look::{LABEL, SMALL, TITLE, WIDTH, draw_heading};
use super::plot_area::{PlotArea, draw_axes, draw_labels};
use super::regions::letter_places;
use super::svg::{Anchor, Canvas, Stroke, Text};
use super::text;
use super::tone::{TONES, draw_bar, draw_keys, ramp};

/// Height of the map itself.
const HEIGHT: f64 = 300.0;

/// A grid of cells over two axes, each a class or a number.
///
/// Classes differ in lightness and have a letter on the map; numbers have a colour bar whose
/// lightness decreases steadily. Equal neighbours in a row are drawn as one rectangle; a map of 40
/// × 40 different numbers takes 110 kB.
///
/// ```
/// use signorini_figure::{Class, HeatMap, Scale};
///
/// let (steps, stiffnesses) = ([0.01, 0.1, 1.0], [1e2, 1e4]);
/// let svg = HeatMap::new(
///     "Stability",
///     ("Step × angular frequency (–)", Scale::Log, &steps),
///     ("Wall stiffness (N/m)", Scale::Log, &stiffnesses),
/// )
/// .classes(vec![Class::new("stable", 'S'), Class::new("diverged", 'X')], vec![0, 0, 0, 0, 0, 1])
/// .to_svg();
/// assert!(svg.contains("diverged"));
/// ```
#[derive(Debug, Clone)]
pub struct HeatMap {
    title: String,
    axes: [Side; 2],
    cells: Cells,
}

/// Label, scale and cell centres along one side.
#[derive(Debug, Clone)]
struct Side {
    label: String,
    scale: Scale,
    centres: Vec<f64>,
}

#[derive(Debug, Clone)]
enum Cells {
    Empty,
    /// Class index of each cell, row by row from the first `y`.
    Classes(Vec<Class>, Vec<usize>),
    /// Value of each cell, row by row from the first `y`.
    Numbers(String, Scale, Vec<f64>),
}

impl HeatMap {
    /// An empty map over cell centres `x` and `y`, both increasing; the labels give quantity and
    /// unit.
    pub fn new(
        title: impl Into<String>,
        (x_label, x_scale, x): (&str, Scale, &[f64]),
        (y_label, y_scale, y): (&str, Scale, &[f64]),
    ) -> Self {
        let side = |label: &str, scale, centres: &[f64]| Side { label: label.into(), scale, centres: centres.into() };
        Self { title: title.into(), axes: [side(x_label, x_scale, x), side(y_label, y_scale, y)], cells: Cells::Empty }
    }

    /// Fills the cells with classes, row by row from the first `y`; up to six classes, listed from
    /// harmless to worst (drawn from light to dark), and a seventh for the rest (drawn in green).
    /// An index beyond the list, or a missing cell, is drawn as no value.
    #[must_use]
    pub fn classes(mut self, classes: Vec<Class>, cells: Vec<usize>) -> Self {
        self.cells = Cells::Classes(classes, cells);
        self
    }

    /// Fills the cells with numbers, row by row from the first `y`, and adds a colour bar labelled
    /// `label`.
    #[must_use]
    pub fn numbers(mut self, label: impl Into<String>, scale: Scale, cells: Vec<f64>) -> Self {
        self.cells = Cells::Numbers(label.into(), scale, cells);
        self
    }

    /// The map as SVG text.
    #[must_use]
    pub fn to_svg(&self) -> String {
        let [x_side, y_side] = &self.axes;
        let (x_edges, y_edges) = (x_side.edges(), y_side.edges());
        let (left, right) = (84.0, if matches!(self.cells, Cells::Numbers(..)) { 96.0 } else { 24.0 });
        let width = WIDTH - left - right;
        let axis = |side: &Side, edges: &[f64], wanted| {
            let mut extent = Extent::EMPTY;
            edges.iter().for_each(|edge| extent.include(*edge));
            Axis::new(side.scale, extent.padded(0.0, side.scale), wanted)
        };
        let (x_axis, y_axis) = (axis(x_side, &x_edges, 8), axis(y_side, &y_edges, 8));
        let title = text::wrap(&self.title, TITLE, WIDTH - 40.0, 3);
        let top = 24.0 + 17.0 * title.len() as f64;
        let legend_rows = if let Cells::Classes(classes, _) = &self.cells { classes.len().div_ceil(3) } else { 0 };
        let total = top + HEIGHT + 50.0 + 18.0 * legend_rows as f64;
        let missing = self.has_missing(x_edges.len().saturating_sub(1) * y_edges.len().saturating_sub(1));
        let mut canvas = Canvas::new(WIDTH, total, &self.title);
        draw_heading(&mut canvas, &title, left + width / 2.0);
        let frame =
            PlotArea { x: left, y: top, width, height: HEIGHT, x_axis: &x_axis, y_axis: &y_axis, envelopes: false };
        self.draw_cells(&mut canvas, &frame, &x_edges, &y_edges);
        draw_axes(&mut canvas, &frame, true, true);
        draw_labels(&mut canvas, &frame, [&x_side.label, &y_side.label], width - 150.0);
        match &self.cells {
            Cells::Empty => {}
            Cells::Classes(classes, _) => draw_keys(&mut canvas, classes, left, top + HEIGHT + 44.0, width),
            Cells::Numbers(label, scale, values) => {
                draw_bar(&mut canvas, label, &number_axis(*scale, values), (left + width + 18.0, top), HEIGHT);
            }
        }
        if missing {
            let (x, y) = (left + width - 66.0, top + HEIGHT + 24.0);
            canvas.frame(x, y, 16.0, 10.0, Stroke::solid("#999", 0.6));
            canvas.line((x, y + 10.0), (x + 16.0, y), Stroke::solid("#999", 0.6));
            canvas.text(Text::new(x + 20.0, y + 9.0, "no value", SMALL, Anchor::Start));
        }
        canvas.finish()
    }

    /// True where one of `count` cells has no value that can be drawn.
    fn has_missing(&self, count: usize) -> bool {
        let drawn = match &self.cells {
            Cells::Empty => 0,
            Cells::Classes(classes, cells) => cells.iter().take(count).filter(|c| **c < classes.len()).count(),
            Cells::Numbers(_, scale, values) => values.iter().take(count).filter_map(|v| scale.even(*v)).count(),
        };
        drawn < count
    }

    fn draw_cells(&self, canvas: &mut Canvas, frame: &PlotArea<'_>, x_edges: &[f64], y_edges: &[f64]) {
        let columns = x_edges.len().saturating_sub(1);
        let rows = y_edges.len().saturating_sub(1);
        let xs: Vec<f64> = x_edges.iter().map(|e| frame.across(frame.x_axis.share_of_even(*e))).collect();
        let ys: Vec<f64> = y_edges.iter().map(|e| frame.up(frame.y_axis.share_of_even(*e))).collect();
        if columns == 0 || rows == 0 {
            return;
        }
        // No value: white with a diagonal line.
        let fills: Vec<Option<String>> = match &self.cells {
            Cells::Empty => vec![None; columns * rows],
            Cells::Classes(classes, cells) => {
                let tone = |class: usize| TONES.get(class).filter(|_| class < classes.len()).map(|t| t.0.to_owned());
                (0..columns * rows).map(|i| cells.get(i).and_then(|class| tone(*class))).collect()
            }
            Cells::Numbers(_, scale, values) => {
                let axis = number_axis(*scale, values);
                (0..columns * rows).map(|i| values.get(i).and_then(|v| axis.share(*v)).map(ramp)).collect()
            }
        };
        let mut strokes = Vec::new();
        for ((row, y), fills) in ys.windows(2).enumerate().zip(fills.chunks(columns)) {
            let &[below, above] = y else { continue };
            let mut column = 0;
            for run in fills.chunk_by(|a, b| a == b) {
                let ends = (xs.get(column).copied(), xs.get(column + run.len()).copied());
                column += run.len();
                let (Some(from), Some(to)) = ends else { continue };
                match run.first().and_then(Option::as_ref) {
                    // A slight overlap hides the seams that renderers leave between neighbours.
                    Some(fill) => {
                        let (over_x, over_y) =
                            (if column < columns { 0.5 } else { 0.0 }, if row > 0 { 0.5 } else { 0.0 });
                        canvas.rect(from, above, to - from + over_x, below - above + over_y, fill);
                    }
                    None => {
                        let crossed = xs.windows(2).skip(column - run.len()).take(run.len());
                        strokes.extend(crossed.filter_map(|x| Some(vec![(*x.first()?, below), (*x.last()?, above)])));
                    }
                }
            }
        }
        canvas.path(&strokes, Stroke::solid("#999", 0.6));
        if let Cells::Classes(classes, cells) = &self.cells {
            let (wide, high) = (frame.width / columns as f64, frame.height / rows as f64);
            let mut grid = cells.clone();
            grid.resize(columns * rows, usize::MAX);
            for (class, column, row, side) in letter_places(&grid, columns) {
                let (Some(known), Some((_, ink))) = (classes.get(class), TONES.get(class)) else { continue };
                if side as f64 * wide.min(high) < 15.0 {
                    continue;
                }
                let x = along(&xs, column);
                let y = along(&ys, row) + 4.0;
                let letter = known.letter.to_string();
                canvas.text(Text { bold: true, colour: ink, ..Text::new(x, y, &letter, LABEL, Anchor::Middle) });
            }
        }
    }
}

impl Side {
    /// Edges between the cells (logarithms on a logarithmic axis): midway between centres, one more
    /// than there are centres.
    fn edges(&self) -> Vec<f64> {
        let centres: Vec<f64> = self.centres.iter().filter_map(|c| self.scale.even(*c)).collect();
        let (Some(first), Some(last)) = (centres.first(), centres.last()) else { return Vec::new() };
        let mut edges: Vec<f64> =
            centres.windows(2).map(|pair| if let &[a, b] = pair { 0.5 * (a + b) } else { 0.0 }).collect();
        let (before, after) = match (edges.first(), edges.last()) {
            (Some(a), Some(b)) => (2.0 * first - a, 2.0 * last - b),
            _ => (first - 0.5, last + 0.5),
        };
        edges.insert(0, before);
        edges.push(after);
        edges
    }
}

/// Position at a fractional index.
fn along(edges: &[f64], index: f64) -> f64 {
    let whole = index.floor() as usize;
    let at = |i: usize| edges.get(i).or(edges.last()).copied().unwrap_or(0.0);
    at(whole) + (index - index.floor()) * (at(whole + 1) - at(whole))
}

fn number_axis(scale: Scale, values: &[f64]) -> Axis {
    let mut extent = Extent::EMPTY;
    values.iter().filter_map(|value| scale.even(*value)).for_each(|even| extent.include(even));
    Axis::new(scale, extent.padded(0.0, scale), 6)
}
