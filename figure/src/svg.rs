//! The page: SVG elements appended to a string. Lengths are in quarters of a millimetre.

use std::fmt::Write;

use super::text::escape_into;

/// How a line is drawn.
#[derive(Debug, Clone, Copy)]
pub(super) struct Stroke {
    pub colour: &'static str,
    pub width: f64,
    /// `stroke-dasharray`, empty for a solid line.
    pub dash: &'static str,
}

impl Stroke {
    pub(super) const fn solid(colour: &'static str, width: f64) -> Self {
        Self { colour, width, dash: "" }
    }
}

/// Which point of a text its position refers to.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Anchor {
    Start,
    Middle,
    End,
}

/// A text: horizontal or rotated to read upwards, with an optional raised exponent.
#[derive(Debug, Clone, Copy)]
pub(super) struct Text<'a> {
    pub x: f64,
    pub y: f64,
    pub body: &'a str,
    pub exponent: Option<i32>,
    pub size: f64,
    pub anchor: Anchor,
    pub bold: bool,
    pub upwards: bool,
    pub colour: &'static str,
}

impl<'a> Text<'a> {
    pub(super) const fn new(x: f64, y: f64, body: &'a str, size: f64, anchor: Anchor) -> Self {
        Self { x, y, body, exponent: None, size, anchor, bold: false, upwards: false, colour: "#000" }
    }
}

/// An SVG document under construction.
#[derive(Debug)]
pub(super) struct Canvas {
    out: String,
}

impl Canvas {
    /// A white page; `name` is the title that screen readers announce.
    pub(super) fn new(width: f64, height: f64, name: &str) -> Self {
        let mut out = String::with_capacity(1 << 14);
        let _ = write!(
            out,
            "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{:.1}mm\" height=\"{:.1}mm\" \
             viewBox=\"0 0 {:.0} {:.0}\" font-family=\"Helvetica, Arial, 'DejaVu Sans', \
             sans-serif\" fill=\"none\" stroke-linejoin=\"round\">\n<title>",
            width / 4.0,
            height / 4.0,
            width,
            height
        );
        escape_into(&mut out, name);
        out.push_str("</title>\n");
        let mut canvas = Self { out };
        // Slightly larger than the page, since renderers round the page up to whole pixels.
        canvas.rect(0.0, 0.0, width + 4.0, height + 4.0, "#fff");
        canvas
    }

    pub(super) fn line(&mut self, from: (f64, f64), to: (f64, f64), stroke: Stroke) {
        self.path(&[vec![from, to]], stroke);
    }

    /// Several separate lines as one element; a line of one point becomes a dot.
    pub(super) fn path(&mut self, runs: &[Vec<(f64, f64)>], stroke: Stroke) {
        if runs.iter().all(Vec::is_empty) {
            return;
        }
        self.out.push_str("<path d=\"");
        for run in runs {
            for (i, &(x, y)) in run.iter().enumerate() {
                self.out.push(match i {
                    0 => 'M',
                    1 => 'L',
                    _ => ' ',
                });
                self.pair(x, y);
            }
            if run.len() == 1 {
                self.out.push_str("h0");
            }
        }
        let _ = write!(self.out, "\" stroke=\"{}\" stroke-width=\"{}\"", stroke.colour, stroke.width);
        if !stroke.dash.is_empty() {
            let _ = write!(self.out, " stroke-dasharray=\"{}\"", stroke.dash);
        }
        if runs.iter().any(|run| run.len() == 1) {
            self.out.push_str(" stroke-linecap=\"round\"");
        }
        self.out.push_str("/>\n");
    }

    /// A line, or a dot of one point, that goes through these frames every `seconds`.
    pub(super) fn animate(&mut self, frames: &[Vec<(f64, f64)>], stroke: Stroke, seconds: f64) {
        let Some(first) = frames.first().filter(|first| !first.is_empty()) else { return };
        if let &[(x, y)] = first.as_slice() {
            self.out.push_str("<circle cx=\"");
            self.number(x);
            self.out.push_str("\" cy=\"");
            self.number(y);
            let _ = writeln!(self.out, "\" r=\"4\" fill=\"{}\">", stroke.colour);
            for (name, part) in [("cx", 0), ("cy", 1)] {
                self.values(name, frames, seconds, |canvas, points| {
                    points.iter().for_each(|&(x, y)| canvas.number([x, y][part]));
                });
            }
            self.out.push_str("</circle>\n");
            return;
        }
        self.out.push_str("<polyline points=\"");
        self.points(first);
        let _ = writeln!(self.out, "\" stroke=\"{}\" stroke-width=\"{}\">", stroke.colour, stroke.width);
        self.values("points", frames, seconds, Self::points);
        self.out.push_str("</polyline>\n");
    }

    fn points(&mut self, points: &[(f64, f64)]) {
        for (i, &(x, y)) in points.iter().enumerate() {
            if i > 0 {
                self.out.push(' ');
            }
            self.pair(x, y);
        }
    }

    /// The values of an attribute of the open element, one for each frame.
    fn values(
        &mut self,
        name: &str,
        frames: &[Vec<(f64, f64)>],
        seconds: f64,
        value: impl Fn(&mut Self, &[(f64, f64)]),
    ) {
        let _ = write!(
            self.out,
            "<animate attributeName=\"{name}\" dur=\"{seconds}s\" repeatCount=\"indefinite\" values=\""
        );
        for (i, frame) in frames.iter().enumerate() {
            if i > 0 {
                self.out.push(';');
            }
            value(self, frame);
        }
        self.out.push_str("\"/>\n");
    }

    /// A closed outline with its own filling.
    pub(super) fn shape(&mut self, corners: &[(f64, f64)], fill: &str, stroke: Stroke) {
        self.outline(corners);
        let _ =
            writeln!(self.out, "Z\" fill=\"{fill}\" stroke=\"{}\" stroke-width=\"{}\"/>", stroke.colour, stroke.width);
    }

    /// A closed outline filled with a translucent colour, so that overlapping areas remain visible.
    pub(super) fn area(&mut self, corners: &[(f64, f64)], fill: &str, opacity: f64) {
        self.outline(corners);
        let _ = writeln!(self.out, "Z\" fill=\"{fill}\" fill-opacity=\"{opacity}\"/>");
    }

    fn outline(&mut self, corners: &[(f64, f64)]) {
        self.out.push_str("<path d=\"");
        for (i, &(x, y)) in corners.iter().enumerate() {
            self.out.push(if i == 0 { 'M' } else { 'L' });
            self.pair(x, y);
        }
    }

    pub(super) fn circle(&mut self, x: f64, y: f64, radius: f64, fill: &str, stroke: Stroke) {
        self.out.push_str("<circle cx=\"");
        self.number(x);
        self.out.push_str("\" cy=\"");
        self.number(y);
        let _ = writeln!(
            self.out,
            "\" r=\"{radius}\" fill=\"{fill}\" stroke=\"{}\" stroke-width=\"{}\"/>",
            stroke.colour, stroke.width
        );
    }

    pub(super) fn rect(&mut self, x: f64, y: f64, width: f64, height: f64, fill: &str) {
        self.open("rect", x, y, width, height);
        let _ = writeln!(self.out, " fill=\"{fill}\"/>");
    }

    /// A rectangle with an outline and no filling.
    pub(super) fn frame(&mut self, x: f64, y: f64, width: f64, height: f64, stroke: Stroke) {
        self.open("rect", x, y, width, height);
        let _ = writeln!(self.out, " stroke=\"{}\" stroke-width=\"{}\"/>", stroke.colour, stroke.width);
    }

    /// Opens an element and gives it its place and its size.
    fn open(&mut self, element: &str, x: f64, y: f64, width: f64, height: f64) {
        let _ = write!(self.out, "<{element}");
        for (name, value) in [(" x=\"", x), (" y=\"", y), (" width=\"", width), (" height=\"", height)] {
            self.out.push_str(name);
            self.number(value);
            self.out.push('"');
        }
    }

    pub(super) fn text(&mut self, text: Text<'_>) {
        self.out.push_str("<text ");
        if text.upwards {
            self.out.push_str("transform=\"translate(");
            self.pair(text.x, text.y);
            self.out.push_str(") rotate(-90)\"");
        } else {
            self.out.push_str("x=\"");
            self.number(text.x);
            self.out.push_str("\" y=\"");
            self.number(text.y);
            self.out.push('"');
        }
        let _ = write!(self.out, " font-size=\"{}\" fill=\"{}\"", text.size, text.colour);
        match text.anchor {
            Anchor::Start => {}
            Anchor::Middle => self.out.push_str(" text-anchor=\"middle\""),
            Anchor::End => self.out.push_str(" text-anchor=\"end\""),
        }
        if text.bold {
            self.out.push_str(" font-weight=\"bold\"");
        }
        self.out.push('>');
        escape_into(&mut self.out, text.body);
        if let Some(exponent) = text.exponent {
            let raised = exponent.to_string().replace('-', "−");
            let _ = write!(self.out, "<tspan dy=\"-4\" font-size=\"{}\">{raised}</tspan>", text.size * 0.75);
        }
        self.out.push_str("</text>\n");
    }

    /// Opens a clipping window: coordinates stay those of the page, what lies outside is cut off.
    /// It is a nested `svg` element, which needs no identifier, so that figures can be combined on
    /// one page.
    pub(super) fn open_window(&mut self, x: f64, y: f64, width: f64, height: f64) {
        self.open("svg", x, y, width, height);
        self.out.push_str(" viewBox=\"");
        for value in [x, y, width, height] {
            self.number(value);
            self.out.push(' ');
        }
        self.out.pop();
        self.out.push_str("\" overflow=\"hidden\">\n");
    }

    pub(super) fn close_window(&mut self) {
        self.out.push_str("</svg>\n");
    }

    pub(super) fn finish(mut self) -> String {
        self.out.push_str("</svg>\n");
        self.out
    }

    fn pair(&mut self, x: f64, y: f64) {
        self.number(x);
        self.out.push(',');
        self.number(y);
    }

    /// Writes a length with at most one decimal, as short as possible. Whole tenths are written as
    /// integers, since a figure has thousands of lengths and the digits of a float take far longer.
    fn number(&mut self, value: f64) {
        let tenths = (value.clamp(-1e5, 1e5) * 10.0).round() as i32;
        if tenths < 0 {
            self.out.push('-');
        }
        let (whole, tenth) = (tenths.unsigned_abs() / 10, tenths.unsigned_abs() % 10);
        let _ = write!(self.out, "{whole}");
        if tenth != 0 {
            let _ = write!(self.out, ".{tenth}");
        }
    }
}
