//! Many points over two axes, binned as they are added, so that the size of the picture does not
//! grow with their number.

use super::axis::{Axis, Extent, Scale};
use super::legend::Legend;
use super::look::{Look, Role, TITLE, WIDTH, colour, draw_heading, look};
use super::overlay::{Line, Overlay, Sign};
use super::plot_area::{PlotArea, draw_axes, draw_grid, draw_labels};
use super::svg::{Canvas, Stroke};
use super::text;

/// Height of the frame, and side of a cell: 0.2 mm.
const HEIGHT: f64 = 320.0;
const CELL: f64 = 0.8;
/// A dot is wider than its cell, so that a single dot is visible.
const DOT: f64 = 1.5;
const LEFT: f64 = 84.0;
const RIGHT: f64 = 24.0;

/// Colour of a single group, and of cells with points of both of two groups, which have the colours
/// of the looks 1 and 2.
const ALONE: &str = "#000000";
const BOTH: &str = "#000000";
/// Colour of a group beneath lines.
const BENEATH: &str = "#b4b4b4";

/// Points of up to two groups over two axes.
///
/// ```
/// use signorini_figure::{Scale, Scatter};
///
/// let mut scatter = Scatter::new(
///     "Logistic map",
///     ("Parameter (–)", Scale::Linear, (2.8, 4.0)),
///     ("Value (–)", Scale::Linear, (0.0, 1.0)),
///     &[""],
/// );
/// for k in 0..400 {
///     let (r, mut x) = (2.8 + 0.003 * f64::from(k), 0.5);
///     for step in 0..300 {
///         x = r * x * (1.0 - x);
///         if step > 200 {
///             scatter.add(0, r, x);
///         }
///     }
/// }
/// assert!(scatter.to_svg().starts_with("<svg"));
/// ```
#[derive(Debug, Clone)]
pub struct Scatter {
    title: String,
    labels: [String; 2],
    axes: [Axis; 2],
    groups: Vec<String>,
    columns: usize,
    rows: usize,
    /// For each cell, a bit for each group that has a point in it.
    cells: Vec<u8>,
    overlay: Overlay,
}

impl Scatter {
    /// An empty frame over those ranges; labels say quantity and unit. `groups` are one or two,
    /// with their labels for the legend.
    #[must_use]
    pub fn new(
        title: impl Into<String>,
        (x_label, x_scale, x_range): (&str, Scale, (f64, f64)),
        (y_label, y_scale, y_range): (&str, Scale, (f64, f64)),
        groups: &[&str],
    ) -> Self {
        let axis = |scale: Scale, (low, high): (f64, f64), across: bool| {
            let mut extent = Extent::EMPTY;
            [low, high].into_iter().filter_map(|x| scale.even(x)).for_each(|x| extent.include(x));
            let extent = extent.padded(0.02, scale);
            if across { Axis::across(scale, extent, WIDTH - LEFT - RIGHT) } else { Axis::new(scale, extent, 7) }
        };
        let (columns, rows) = (((WIDTH - LEFT - RIGHT) / CELL) as usize, (HEIGHT / CELL) as usize);
        Self {
            title: title.into(),
            labels: [x_label.to_owned(), y_label.to_owned()],
            axes: [axis(x_scale, x_range, true), axis(y_scale, y_range, false)],
            groups: groups.iter().take(2).map(|&label| label.to_owned()).collect(),
            columns,
            rows,
            cells: vec![0; columns * rows],
            overlay: Overlay::default(),
        }
    }

    /// Adds a point to group number `group`; one outside the frame is left out.
    pub fn add(&mut self, group: usize, x: f64, y: f64) {
        let [x_axis, y_axis] = &self.axes;
        let (Some(x), Some(y)) = (x_axis.share(x), y_axis.share(y)) else { return };
        if !(0.0..=1.0).contains(&x) || !(0.0..=1.0).contains(&y) {
            return;
        }
        let column = ((x * self.columns as f64) as usize).min(self.columns - 1);
        let row = ((y * self.rows as f64) as usize).min(self.rows - 1);
        if let Some(cell) = self.cells.get_mut(row * self.columns + column) {
            *cell |= 1 << group.min(1);
        }
    }

    /// Draws a line over the points, which are grey then; a point that cannot be drawn breaks it.
    /// Lines of the same label share one entry in the legend; lines without a label have no entry.
    pub fn line(&mut self, line: Line, label: &str, points: Vec<(f64, f64)>) {
        self.overlay.line(line, label, points);
    }

    /// Draws a sign over points and lines, with its label in the legend.
    pub fn sign(&mut self, sign: Sign, label: &str, at: (f64, f64)) {
        self.overlay.sign(sign, label, at);
    }

    /// The figure as SVG text.
    #[must_use]
    pub fn to_svg(&self) -> String {
        let width = WIDTH - LEFT - RIGHT;
        let title = text::wrap(&self.title, 1.1 * TITLE, WIDTH - 40.0, 3);
        let top = 24.0 + 17.0 * title.len() as f64;
        let legend = Legend::new(self.entries(), WIDTH - 20.0);
        let mut canvas = Canvas::new(WIDTH, top + HEIGHT + 46.0 + legend.height(), &self.title);
        draw_heading(&mut canvas, &title, WIDTH / 2.0);
        let [x_axis, y_axis] = &self.axes;
        let frame = PlotArea { x: LEFT, y: top, width, height: HEIGHT, x_axis, y_axis, envelopes: false };
        draw_grid(&mut canvas, &frame);
        canvas.open_window(LEFT, top, width, HEIGHT);
        for (bits, colour) in self.colours() {
            canvas.path(&self.runs(bits, top), Stroke::solid(colour, DOT));
        }
        self.overlay.draw(&mut canvas, &frame);
        canvas.close_window();
        draw_axes(&mut canvas, &frame, true, true);
        draw_labels(&mut canvas, &frame, self.labels.each_ref().map(String::as_str), width);
        legend.draw(&mut canvas, 10.0, top + HEIGHT + 42.0, WIDTH - 20.0);
        canvas.finish()
    }

    /// The colour of each combination of groups.
    fn colours(&self) -> Vec<(u8, &'static str)> {
        match self.groups.len() {
            0 | 1 if !self.overlay.is_empty() => vec![(1, BENEATH)],
            0 | 1 => vec![(1, ALONE)],
            _ => vec![(1, colour(1)), (2, colour(2)), (3, BOTH)],
        }
    }

    fn entries(&self) -> Vec<(String, Look)> {
        let [first, second] = self.groups.as_slice() else { return self.overlay.entries() };
        let entry = |label: String, colour| {
            let line = look(0, Role::Ordinary, false);
            (label, Look { stroke: Stroke::solid(colour, 4.0), ..line })
        };
        let mut entries = vec![
            entry(first.clone(), colour(1)),
            entry(second.clone(), colour(2)),
            entry(format!("{first} and {second}"), BOTH),
        ];
        entries.extend(self.overlay.entries());
        entries
    }

    /// Cells of one kind beside one another, as lines.
    fn runs(&self, bits: u8, top: f64) -> Vec<Vec<(f64, f64)>> {
        let mut runs = Vec::new();
        for (row, cells) in self.cells.chunks(self.columns).enumerate() {
            let y = top + HEIGHT - (row as f64 + 0.5) * CELL;
            let mut column = 0;
            for run in cells.chunk_by(|a, b| a == b) {
                let x = LEFT + column as f64 * CELL;
                column += run.len();
                if run.first() == Some(&bits) {
                    let wider = 0.5 * (DOT - CELL);
                    runs.push(vec![(x - wider, y), (x + run.len() as f64 * CELL + wider, y)]);
                }
            }
        }
        runs
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn scatter(points: u32) -> Scatter {
        let axis = ("x", Scale::Linear, (0.0, 1.0));
        let mut scatter = Scatter::new("t", axis, axis, &["up", "down"]);
        for i in 0..points {
            // Two sequences that fill the square.
            let x = (f64::from(i) * 0.618_033_988_75).fract();
            scatter.add((i % 2) as usize, x, (f64::from(i) * 0.754_877_666_25).fract());
        }
        scatter
    }

    #[test]
    fn the_picture_stays_small_however_many_points_there_are() {
        let (few, many) = (scatter(1000).to_svg().len(), scatter(3_000_000).to_svg().len());
        assert!(few > 10_000 && many < 2_000_000, "{few} and {many} bytes");
    }

    #[test]
    fn what_cannot_be_drawn_is_left_out() {
        let mut empty = scatter(0);
        for (x, y) in [(f64::NAN, 0.5), (0.5, f64::INFINITY), (2.0, 0.5), (0.5, -1.0)] {
            empty.add(0, x, y);
        }
        assert!(empty.cells.iter().all(|&cell| cell == 0));
        empty.add(1, 0.0, 1.0);
        assert_eq!(empty.cells.iter().filter(|&&cell| cell == 2).count(), 1);
    }
}
