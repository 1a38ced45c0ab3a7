//! Tornado diagrams: how far each of several inputs moves a number, as bars from its value at the
//! lower to that at the upper bound of the input.

use super::axis::{Axis, Extent, Scale};
use super::look::{FRAME, GRID, LABEL, SMALL, TITLE, WIDTH, colour, draw_heading};
use super::svg::{Anchor, Canvas, Stroke, Text};
use super::text;

/// Height of a bar, and of a bar with the space to the next.
const BAR: f64 = 15.0;
const PITCH: f64 = 24.0;
const RIGHT: f64 = 24.0;
/// Widest column of names.
const NAMES: f64 = 220.0;
/// Room for the bound of an input beside the end of a bar.
const BOUND: f64 = 52.0;

/// One input: a bar from the number at its lower bound to that at its upper bound.
#[derive(Debug, Clone, PartialEq)]
pub struct Bar {
    /// The name of the input.
    pub name: String,
    /// Its bounds, as they stand beside the ends of the bar.
    pub bounds: [String; 2],
    /// The number at its bounds.
    pub at: [f64; 2],
    /// True for an effect that is not distinguished from none: the bar is then hollow.
    pub hollow: bool,
}

/// The bars of one number.
#[derive(Debug, Clone, PartialEq)]
pub struct Bars {
    /// What the number is, with its unit.
    pub label: String,
    /// The number where all inputs have their base values; a vertical line.
    pub base: f64,
    /// From top to bottom.
    pub bars: Vec<Bar>,
}

/// A tornado diagram, a frame for each number.
///
/// ```
/// use signorini_figure::{Bar, Bars, Tornado};
///
/// let bar = |name: &str, at, hollow| {
///     let bounds = ["low".to_owned(), "high".to_owned()];
///     Bar { name: name.to_owned(), bounds, at, hollow }
/// };
/// let bars = vec![bar("gap", [0.08, 0.04], false), bar("friction", [0.055, 0.061], true)];
/// let work_rate = Bars { label: "Work rate (W)".to_owned(), base: 0.06, bars };
/// let svg = Tornado::new("Two inputs").bars(work_rate).to_svg();
/// assert!(svg.starts_with("<svg"));
/// ```
#[derive(Debug, Clone)]
pub struct Tornado {
    title: String,
    frames: Vec<Bars>,
}

impl Tornado {
    /// A diagram without frames.
    #[must_use]
    pub fn new(title: impl Into<String>) -> Self {
        Self { title: title.into(), frames: Vec::new() }
    }

    /// Adds a frame.
    #[must_use]
    pub fn bars(mut self, bars: Bars) -> Self {
        self.frames.push(bars);
        self
    }

    /// The figure as SVG text.
    #[must_use]
    pub fn to_svg(&self) -> String {
        let title = text::wrap(&self.title, 1.1 * TITLE, WIDTH - 40.0, 3);
        let names = self.frames.iter().flat_map(|frame| &frame.bars).map(|bar| text::width(&bar.name, LABEL));
        let left = 20.0 + names.fold(40.0, f64::max).min(NAMES);
        let top = 20.0 + 17.0 * title.len() as f64;
        let height = |frame: &Bars| 56.0 + PITCH * frame.bars.len() as f64;
        let mut canvas = Canvas::new(WIDTH, top + self.frames.iter().map(height).sum::<f64>() + 30.0, &self.title);
        draw_heading(&mut canvas, &title, WIDTH / 2.0);
        let mut y = top;
        for frame in &self.frames {
            frame.draw(&mut canvas, left, y);
            y += height(frame);
        }
        let hollow = self.frames.iter().flat_map(|frame| &frame.bars).any(|bar| bar.hollow);
        draw_key(&mut canvas, left, y + 8.0, hollow);
        canvas.finish()
    }
}

impl Bars {
    /// The axis, with room beside the bars for the bounds.
    fn axis(&self, width: f64) -> Axis {
        let mut extent = Extent::EMPTY;
        let numbers = self.bars.iter().flat_map(|bar| bar.at).chain([self.base]);
        numbers.filter_map(|x| Scale::Linear.even(x)).for_each(|x| extent.include(x));
        let share = BOUND / (width - 2.0 * BOUND);
        Axis::across(Scale::Linear, extent.padded(share, Scale::Linear), width)
    }

    fn draw(&self, canvas: &mut Canvas, left: f64, top: f64) {
        let width = WIDTH - left - RIGHT;
        let axis = self.axis(width);
        let across = |x: f64| axis.share(x).map(|share| left + share * width);
        let (top, bottom) = (top + 8.0, top + 8.0 + PITCH * self.bars.len() as f64);
        let ticks: Vec<f64> = axis.ticks.iter().map(|tick| left + axis.share_of_even(tick.even) * width).collect();
        canvas.path(&ticks.iter().map(|&x| vec![(x, top), (x, bottom)]).collect::<Vec<_>>(), GRID);
        for (i, bar) in self.bars.iter().enumerate() {
            let middle = top + PITCH * (i as f64 + 0.5);
            let name = text::shorten(&bar.name, LABEL, left - 16.0);
            canvas.text(Text::new(left - 8.0, middle + 4.0, &name, LABEL, Anchor::End));
            self.draw_bar(canvas, bar, middle, &across);
        }
        if let Some(x) = across(self.base) {
            canvas.line((x, top), (x, bottom), Stroke::solid("#000", 1.2));
        }
        canvas.frame(left, top, width, bottom - top, FRAME);
        for (tick, &x) in axis.ticks.iter().zip(&ticks) {
            canvas.line((x, bottom), (x, bottom + 4.5), FRAME);
            let text = Text::new(x, bottom + 15.5, &tick.body, SMALL, Anchor::Middle);
            canvas.text(Text { exponent: tick.exponent, ..text });
        }
        if let Some(power) = axis.factor {
            let text = Text::new(left + width, bottom + 28.0, "×10", SMALL, Anchor::End);
            canvas.text(Text { exponent: Some(power), ..text });
        }
        let label = text::shorten(&self.label, LABEL, width - 60.0);
        canvas.text(Text::new(left + width / 2.0, bottom + 31.0, &label, LABEL, Anchor::Middle));
    }

    /// The two halves of a bar, from the base to the number at each bound. Where both lie on one
    /// side, the longer half is drawn first and shows beyond the other.
    fn draw_bar(&self, canvas: &mut Canvas, bar: &Bar, middle: f64, across: &dyn Fn(f64) -> Option<f64>) {
        let Some(base) = across(self.base) else { return };
        let mut halves: Vec<(usize, f64)> =
            bar.at.iter().enumerate().filter_map(|(side, x)| Some((side, across(*x)?))).collect();
        halves.sort_by(|a, b| (b.1 - base).abs().total_cmp(&(a.1 - base).abs()));
        let same_side = matches!(halves.as_slice(), [(_, a), (_, b)] if (a - base) * (b - base) > 0.0);
        for (order, &(side, end)) in halves.iter().enumerate() {
            let (y0, y1) = (middle - BAR / 2.0, middle + BAR / 2.0);
            let fill = if bar.hollow { "#fff" } else { tone(side) };
            let corners = [(base, y0), (end, y0), (end, y1), (base, y1)];
            canvas.shape(&corners, fill, Stroke::solid(tone(side), 1.2));
            // The bound of a half that lies within the other has no room.
            if !(same_side && order == 1) {
                let (x, anchor) = if end >= base { (end + 5.0, Anchor::Start) } else { (end - 5.0, Anchor::End) };
                let bound = bar.bounds.get(side).map_or("", String::as_str);
                let bound = text::shorten(bound, SMALL, BOUND - 8.0);
                canvas.text(Text::new(x, middle + 3.5, &bound, SMALL, anchor));
            }
        }
    }
}

/// The colour of the lower and of the upper bound.
fn tone(side: usize) -> &'static str {
    colour(if side == 0 { 3 } else { 2 })
}

/// What the colours stand for, and hollow bars where there are any.
fn draw_key(canvas: &mut Canvas, left: f64, y: f64, hollow: bool) {
    let mut x = left;
    let filled = [(tone(0), tone(0), "at the lower bound"), (tone(1), tone(1), "at the upper bound")];
    let hollow = hollow.then_some(("#fff", "#000", "not distinguished from none"));
    for (fill, stroke, words) in filled.into_iter().chain(hollow) {
        let corners = [(x, y - 5.0), (x + 16.0, y - 5.0), (x + 16.0, y + 5.0), (x, y + 5.0)];
        canvas.shape(&corners, fill, Stroke::solid(stroke, 1.2));
        canvas.text(Text::new(x + 21.0, y + 3.6, words, SMALL, Anchor::Start));
        x += 21.0 + text::width(words, SMALL) + 14.0;
    }
}

#[cfg(test)]
mod tests {
    use super::{Bar, Bars, Tornado};

    fn drawn(hollow: bool, at: [f64; 2]) -> String {
        let bar = Bar { name: "gap".to_owned(), bounds: ["1e-4".to_owned(), "4e-4".to_owned()], at, hollow };
        Tornado::new("t").bars(Bars { label: "Work rate (W)".to_owned(), base: 2.0, bars: vec![bar] }).to_svg()
    }

    #[test]
    fn a_bar_is_filled_or_hollow_and_names_its_bounds() {
        let fills = |svg: &str| svg.matches("fill=\"#d55e00\"").count();
        // The key has one filled sample of each colour.
        assert_eq!((fills(&drawn(false, [1.0, 3.0])), fills(&drawn(true, [1.0, 3.0]))), (2, 1));
        let svg = drawn(false, [1.0, 3.0]);
        assert!(svg.contains(">1e-4<") && svg.contains(">4e-4<") && svg.contains(">gap<"), "{svg}");
        // Where both numbers lie on one side, the longer half alone has room for its bound.
        let svg = drawn(false, [2.5, 3.0]);
        assert!(!svg.contains(">1e-4<") && svg.contains(">4e-4<"), "{svg}");
    }

    #[test]
    fn a_number_that_is_missing_leaves_its_half_out() {
        let svg = drawn(false, [f64::NAN, 3.0]);
        assert!(!svg.contains("NaN") && !svg.contains(">1e-4<") && svg.contains(">4e-4<"), "{svg}");
    }
}
