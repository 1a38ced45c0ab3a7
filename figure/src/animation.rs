//! A picture that moves: lines and points that change from frame to frame, without a script, in
//! every program that shows SVG files with their animations.

use super::axis::Extent;
use super::look::{LABEL, SMALL, TITLE, WIDTH, colour};
use super::svg::{Anchor, Canvas, Stroke, Text};
use super::text::shorten;

/// Distance of views from the edges of the page and from one another.
const MARGIN: f64 = 14.0;
/// Height of the lines of text above the views, and above each view.
const HEAD: f64 = 40.0;
const LABEL_ROOM: f64 = 18.0;
/// Share of a view that its lines fill.
const FILLED: f64 = 0.92;

/// A picture that moves.
#[derive(Debug, Clone, Default)]
pub struct Animation {
    title: String,
    caption: String,
    seconds: f64,
    rows: Vec<(f64, Vec<View>)>,
}

/// A frame of its own within an [`Animation`], with lines that stand and lines that move; positive
/// is to the right and up.
#[derive(Debug, Clone, Default)]
pub struct View {
    label: String,
    equal: bool,
    path: Vec<(f64, f64)>,
    still: Vec<(usize, Vec<(f64, f64)>)>,
    moving: Vec<Vec<(f64, f64)>>,
}

impl Animation {
    /// An empty picture that repeats itself every `seconds`.
    #[must_use]
    pub fn new(title: &str, caption: &str, seconds: f64) -> Self {
        Self { title: title.to_owned(), caption: caption.to_owned(), seconds, rows: Vec::new() }
    }

    /// The same picture with a row of views of this height below, which share its width.
    #[must_use]
    pub fn row(mut self, height: f64, views: Vec<View>) -> Self {
        self.rows.push((height, views));
        self
    }

    /// The picture.
    #[must_use]
    pub fn to_svg(&self) -> String {
        let height = HEAD + self.rows.iter().map(|(height, _)| height + LABEL_ROOM + MARGIN).sum::<f64>();
        let mut canvas = Canvas::new(WIDTH, height, &self.title);
        let room = WIDTH - 2.0 * MARGIN;
        let title = shorten(&self.title, TITLE, room);
        canvas.text(Text { bold: true, ..Text::new(MARGIN, 16.0, &title, TITLE, Anchor::Start) });
        canvas.text(Text::new(MARGIN, 32.0, &shorten(&self.caption, SMALL, room), SMALL, Anchor::Start));
        let mut top = HEAD;
        for (height, views) in &self.rows {
            let width = (room + MARGIN) / views.len().max(1) as f64 - MARGIN;
            for (index, view) in views.iter().enumerate() {
                let left = MARGIN + index as f64 * (width + MARGIN);
                let label = shorten(&view.label, LABEL, width);
                canvas.text(Text::new(left, top + 12.0, &label, LABEL, Anchor::Start));
                view.draw(&mut canvas, left, top + LABEL_ROOM, width, *height, self.seconds);
            }
            top += height + LABEL_ROOM + MARGIN;
        }
        canvas.finish()
    }
}

impl View {
    /// A view of this name; with `equal` scales along both axes.
    #[must_use]
    pub fn new(label: &str, equal: bool) -> Self {
        Self { label: label.to_owned(), equal, ..Self::default() }
    }

    /// The same view with a line that stands, in the colour of the look `look`.
    #[must_use]
    pub fn line(mut self, look: usize, points: Vec<(f64, f64)>) -> Self {
        self.still.push((look, points));
        self
    }

    /// The same view with the whole path of what moves, as a thin grey line behind it.
    #[must_use]
    pub fn path(mut self, points: Vec<(f64, f64)>) -> Self {
        self.path = points;
        self
    }

    /// The same view with a line that moves: its points in each frame. A line of one point is a
    /// dot.
    #[must_use]
    pub fn moving(mut self, frames: Vec<Vec<(f64, f64)>>) -> Self {
        self.moving = frames;
        self
    }

    /// Draws the view in the rectangle of this size whose upper left corner is at `left`, `top`.
    fn draw(&self, canvas: &mut Canvas, left: f64, top: f64, width: f64, height: f64, seconds: f64) {
        let (mut across, mut up) = (Extent::EMPTY, Extent::EMPTY);
        let still = self.still.iter().map(|(_, points)| points);
        for &(x, y) in still.chain(&self.moving).chain([&self.path]).flatten() {
            across.include(x);
            up.include(y);
        }
        if across.is_empty() || up.is_empty() {
            return;
        }
        let scale = |extent: Extent, room: f64| FILLED * room / extent.span().max(f64::MIN_POSITIVE);
        let (mut along, mut upwards) = (scale(across, width), scale(up, height));
        if self.equal {
            along = along.min(upwards);
            upwards = along;
        }
        let (x0, y0) = (across.low + 0.5 * across.span(), up.low + 0.5 * up.span());
        let at =
            |&(x, y): &(f64, f64)| (left + 0.5 * width + along * (x - x0), top + 0.5 * height - upwards * (y - y0));
        let on_page = |points: &Vec<(f64, f64)>| points.iter().map(at).collect::<Vec<_>>();
        canvas.frame(left, top, width, height, Stroke::solid("#e6e6e6", 0.6));
        canvas.path(&[on_page(&self.path)], Stroke::solid("#c4c4c4", 0.8));
        for (look, points) in &self.still {
            canvas.path(&[on_page(points)], Stroke::solid(colour(*look), 2.0));
        }
        let frames: Vec<_> = self.moving.iter().map(on_page).collect();
        canvas.animate(&frames, Stroke::solid("#000", 1.8), seconds);
    }
}
