//! The rectangle of a panel on the page, and what is drawn inside it.

use super::axis::Axis;
use super::curve::{Curve, Mark, MarkKind};
use super::envelope::Envelope;
use super::look::{FRAME, GRID, LABEL, Look, Role, SMALL};
use super::svg::{Anchor, Canvas, Stroke, Text};
use super::text;
use super::thin::{Spot, never_goes_back, thin};

/// Opacity of the band about a curve: bands that overlap remain visible.
const BAND: f64 = 0.18;

/// Width of an arrow towards a point beside the frame, with the space after it, and the height that
/// it needs.
const ARROW: f64 = 8.0;
const ARROW_HEIGHT: f64 = 7.0;

/// What stands at the edges of a frame for points beside it.
#[derive(Debug, Default)]
pub(super) struct Beyond {
    /// Heights of the names of curves.
    names: Vec<f64>,
    /// Of each arrow the direction inwards of its edge, its place counted from there, its height.
    arrows: Vec<(f64, f64, f64)>,
}

impl Beyond {
    /// The places from that edge that arrows take at that height.
    fn taken(&self, inwards: f64, y: f64) -> impl Iterator<Item = f64> {
        let near = move |arrow: &&(f64, f64, f64)| arrow.0 == inwards && (arrow.2 - y).abs() < ARROW_HEIGHT;
        self.arrows.iter().filter(near).map(|arrow| arrow.1)
    }

    /// How many places from the edge are taken at that height, by arrows.
    fn columns(&self, inwards: f64, y: f64) -> f64 {
        self.taken(inwards, y).map(|place| place + 1.0).fold(0.0, f64::max)
    }

    /// Takes the place nearest to the edge for an arrow at that height.
    fn column(&mut self, inwards: f64, y: f64) -> f64 {
        let used: Vec<f64> = self.taken(inwards, y).collect();
        let column = (0..=used.len()).map(|n| n as f64).find(|n| !used.contains(n)).unwrap_or(0.0);
        self.arrows.push((inwards, column, y));
        column
    }
}

/// The rectangle of a panel on the page, with both axes.
#[derive(Debug)]
pub(super) struct PlotArea<'a> {
    pub x: f64,
    pub y: f64,
    pub width: f64,
    pub height: f64,
    pub x_axis: &'a Axis,
    pub y_axis: &'a Axis,
    /// False for a detail, which shows every oscillation.
    pub envelopes: bool,
}

impl PlotArea<'_> {
    pub(super) fn across(&self, share: f64) -> f64 {
        self.x + share * self.width
    }

    pub(super) fn up(&self, share: f64) -> f64 {
        self.y + (1.0 - share) * self.height
    }

    fn spot(&self, point: (f64, f64)) -> Spot {
        Some((self.across(self.x_axis.share(point.0)?), self.up(self.y_axis.share(point.1)?)))
    }

    /// Draws the lines of the marks that lie in the frame.
    pub(super) fn draw_marks(&self, canvas: &mut Canvas, marks: &[Mark]) {
        for mark in marks {
            let stroke = match mark.kind {
                MarkKind::Wall => Stroke::solid("#555", 1.8),
                MarkKind::Floor => Stroke { colour: "#666", width: 1.0, dash: "5 3" },
            };
            let axis = if mark.upright { self.x_axis } else { self.y_axis };
            let Some(share) = axis.share(mark.value).filter(|share| (0.0..=1.0).contains(share)) else { continue };
            if mark.upright {
                let x = self.across(share);
                canvas.line((x, self.y), (x, self.y + self.height), stroke);
            } else {
                let y = self.up(share);
                canvas.line((self.x, y), (self.x + self.width, y), stroke);
            }
        }
    }

    /// Fills areas.
    pub(super) fn draw_areas(&self, canvas: &mut Canvas, areas: &[Vec<(f64, f64)>], colour: &'static str) {
        for corners in areas {
            let corners: Vec<(f64, f64)> = corners.iter().filter_map(|point| self.spot(*point)).collect();
            canvas.area(&corners, colour, 0.75);
        }
    }

    /// Draws the outlines of what bounds a motion.
    pub(super) fn draw_outlines(&self, canvas: &mut Canvas, outlines: &[Vec<(f64, f64)>], colour: &'static str) {
        let runs: Vec<Vec<(f64, f64)>> =
            outlines.iter().map(|points| points.iter().filter_map(|point| self.spot(*point)).collect()).collect();
        canvas.path(&runs, Stroke::solid(colour, 1.8));
    }

    /// Points on the page, from the last one before the frame to the first one after it; all points
    /// of a curve that goes back in x.
    fn spots(&self, points: &[(f64, f64)]) -> Vec<Spot> {
        let spots: Vec<Spot> = points.iter().map(|p| self.spot(*p)).collect();
        if !never_goes_back(&spots) {
            return spots;
        }
        let before = |x: f64| spots.iter().rposition(|s| s.is_some_and(|s| s.0 < x));
        let after = |x: f64| spots.iter().position(|s| s.is_some_and(|s| s.0 > x));
        let first = before(self.x).unwrap_or(0);
        let last = after(self.x + self.width).map_or(spots.len(), |i| i + 1);
        spots.get(first..last).unwrap_or_default().to_vec()
    }

    /// Draws a curve with at most about `budget` points and a hundredth as many markers; as an
    /// envelope where it oscillates too fast for the frame.
    pub(super) fn draw_curve(&self, canvas: &mut Canvas, curve: &Curve, look: Look, budget: usize) {
        let spots = self.spots(&curve.points);
        let may = self.envelopes && curve.oscillates && never_goes_back(&spots);
        let envelope = may.then(|| Envelope::of(&spots, self.x, self.x + self.width)).flatten();
        if let Some(envelope) = envelope {
            let width = look.stroke.width.min(0.8);
            canvas.area(&envelope.outline(), look.stroke.colour, if curve.role == Role::Backdrop { 0.6 } else { 0.3 });
            return canvas.path(&envelope.edges(), Stroke { width, ..look.stroke });
        }
        canvas.path(&thin(&spots, budget), look.stroke);
        if look.marker.is_some() {
            let drawn = spots.iter().flatten().count();
            for (x, y) in spots.iter().flatten().step_by(drawn.div_ceil((budget / 100).clamp(4, 200)).max(1)) {
                look.mark(canvas, *x, *y);
            }
        }
    }

    /// Fills the band about a curve.
    pub(super) fn draw_band(&self, canvas: &mut Canvas, curve: &Curve, colour: &'static str) {
        for band in curve.bands() {
            let lower: Vec<(f64, f64)> = band.iter().filter_map(|&(x, low, _)| self.spot((x, low))).collect();
            let upper: Vec<(f64, f64)> = band.iter().rev().filter_map(|&(x, _, high)| self.spot((x, high))).collect();
            match (lower.as_slice(), upper.as_slice()) {
                ([low], [high]) => canvas.line(*low, *high, Stroke::solid(colour, 1.0)),
                ([], []) => {}
                _ => canvas.area(&[upper, lower].concat(), colour, BAND),
            }
        }
    }

    /// For points of a marked curve that lie beside the frame: draws an arrow for each, beside
    /// those that are there already, and the value of the farthest point of each curve where there
    /// is room.
    pub(super) fn draw_beyond(&self, canvas: &mut Canvas, curve: &Curve, look: Look, taken: &mut Beyond) {
        let outside = |side: fn(f64) -> bool| {
            let shares = curve.points.iter().filter_map(|p| Some((self.x_axis.share(p.0)?, p)));
            let beyond = shares.filter(move |(share, _)| side(*share));
            beyond.filter_map(|(share, p)| Some((share, p.0, self.up(self.y_axis.share(p.1)?)))).collect::<Vec<_>>()
        };
        type Side = (f64, f64, fn(f64) -> bool);
        let sides: [Side; 2] = [(self.x, 1.0, |s| s < 0.0), (self.x + self.width, -1.0, |s| s > 1.0)];
        for (edge, inwards, side) in sides {
            let points = outside(side);
            for (_, _, y) in &points {
                let tip = edge + inwards * (1.5 + ARROW * taken.column(inwards, *y));
                let back = tip + inwards * (ARROW - 1.5);
                canvas.shape(
                    &[(tip, *y), (back, y - 3.2), (back, y + 3.2)],
                    look.stroke.colour,
                    Stroke::solid("#000", 0.5),
                );
            }
            let far = |share: f64| (share - 0.5).abs();
            let farthest = points.iter().max_by(|a, b| far(a.0).total_cmp(&far(b.0)));
            let Some((_, value, y)) =
                farthest.filter(|p| inwards > 0.0 && taken.names.iter().all(|t| (t - p.2).abs() > 12.0))
            else {
                continue;
            };
            taken.names.push(*y);
            let text = format!("{} {value:.0e}", curve.label);
            let x = edge + 4.0 + ARROW * taken.columns(inwards, *y);
            canvas.text(Text::new(x, y + 3.5, text.trim(), SMALL, Anchor::Start));
        }
    }

    /// Draws stems from zero; of those in one column of the page only the lowest and the highest.
    pub(super) fn draw_stems(&self, canvas: &mut Canvas, stems: &Curve, look: Look, budget: usize) {
        let columns = (budget as f64 / (4.0 * self.width)).min(2.0);
        let foot = self.up(self.y_axis.share(0.0).unwrap_or(0.0).clamp(0.0, 1.0));
        let inside = |x: f64| (self.x - 1.0..=self.x + self.width + 1.0).contains(&x);
        let spots = stems.points.iter().map(|p| self.spot(*p).filter(|s| inside(s.0)));
        let mut ends: Vec<(f64, f64)> = spots.flatten().collect();
        ends.sort_by(|a, b| a.0.total_cmp(&b.0));
        let mut kept: Vec<(f64, f64)> = Vec::new();
        for column in ends.chunk_by(|a, b| (columns * a.0).floor() == (columns * b.0).floor()) {
            let lowest = column.iter().copied().reduce(|a, b| if b.1 > a.1 { b } else { a });
            let highest = column.iter().copied().reduce(|a, b| if b.1 < a.1 { b } else { a });
            kept.extend(lowest);
            kept.extend(highest.filter(|_| lowest != highest));
        }
        let width = match look.role {
            Role::Backdrop => 3.0,
            _ if kept.len() > 250 => 0.6,
            _ => 1.0,
        };
        let strokes: Vec<Vec<(f64, f64)>> = kept.iter().map(|&(x, y)| vec![(x, foot), (x, y)]).collect();
        canvas.path(&strokes, Stroke::solid(look.stroke.colour, width));
        let radius = match kept.len() {
            0..=120 => 2.2,
            121..=250 => 1.4,
            _ => return,
        };
        for (x, y) in kept {
            if let Some(marker) = look.marker {
                marker.draw(
                    canvas,
                    x,
                    y,
                    if look.role == Role::Backdrop { 1.6 * radius } else { radius },
                    look.stroke.colour,
                );
            }
        }
    }
}

pub(super) fn draw_grid(canvas: &mut Canvas, frame: &PlotArea<'_>) {
    let upright = frame.x_axis.ticks.iter().map(|t| frame.across(frame.x_axis.share_of_even(t.even)));
    let level = frame.y_axis.ticks.iter().map(|t| frame.up(frame.y_axis.share_of_even(t.even)));
    let mut lines: Vec<_> = upright.map(|x| vec![(x, frame.y), (x, frame.y + frame.height)]).collect();
    lines.extend(level.map(|y| vec![(frame.x, y), (frame.x + frame.width, y)]));
    canvas.path(&lines, GRID);
}

/// Draws frame, ticks and numbers. The numbers of the vertical axis stand beside the first frame of
/// a row, those of the horizontal axis under the last frame of a column.
pub(super) fn draw_axes(canvas: &mut Canvas, frame: &PlotArea<'_>, beside: bool, below: bool) {
    let bottom = frame.y + frame.height;
    let end = frame.x + frame.width;
    let mut ticks = Vec::new();
    for (evens, length) in [(&frame.x_axis.minor, 2.5), (&evens(frame.x_axis), 4.5)] {
        for x in evens.iter().map(|even| frame.across(frame.x_axis.share_of_even(*even))) {
            ticks.push(vec![(x, bottom), (x, bottom + length)]);
        }
    }
    for (evens, length) in [(&frame.y_axis.minor, 2.5), (&evens(frame.y_axis), 4.5)] {
        for y in evens.iter().map(|even| frame.up(frame.y_axis.share_of_even(*even))) {
            ticks.push(vec![(frame.x, y), (frame.x - length, y)]);
        }
    }
    canvas.path(&ticks, FRAME);
    canvas.frame(frame.x, frame.y, frame.width, frame.height, FRAME);
    for tick in frame.y_axis.ticks.iter().filter(|_| beside) {
        let y = frame.up(frame.y_axis.share_of_even(tick.even)) + 3.6;
        let text = Text::new(frame.x - 7.0, y, &tick.body, SMALL, Anchor::End);
        canvas.text(Text { exponent: tick.exponent, ..text });
    }
    if let Some(power) = frame.y_axis.factor.filter(|_| beside) {
        let text = Text::new(frame.x, frame.y - 5.0, "×10", SMALL, Anchor::Start);
        canvas.text(Text { exponent: Some(power), ..text });
    }
    if below {
        for tick in &frame.x_axis.ticks {
            let x = frame.across(frame.x_axis.share_of_even(tick.even));
            let text = Text::new(x, bottom + 15.5, &tick.body, SMALL, Anchor::Middle);
            canvas.text(Text { exponent: tick.exponent, ..text });
        }
        if let Some(power) = frame.x_axis.factor {
            let text = Text::new(end, bottom + 28.0, "×10", SMALL, Anchor::End);
            canvas.text(Text { exponent: Some(power), ..text });
        }
    }
}

/// Draws the labels of both axes; that of the horizontal one is shortened to `room`.
pub(super) fn draw_labels(canvas: &mut Canvas, frame: &PlotArea<'_>, [x_label, y_label]: [&str; 2], room: f64) {
    let label = text::shorten(x_label, LABEL, room);
    canvas.text(Text::new(frame.across(0.5), frame.y + frame.height + 33.0, &label, LABEL, Anchor::Middle));
    draw_upwards(canvas, &text::wrap(y_label, LABEL, frame.height, 2), 18.0, frame.up(0.5));
}

/// Draws the lines of a label of the vertical axis, the first at `x`.
pub(super) fn draw_upwards(canvas: &mut Canvas, lines: &[String], x: f64, middle: f64) {
    for (i, line) in lines.iter().enumerate() {
        let text = Text::new(x + 14.0 * i as f64, middle, line, LABEL, Anchor::Middle);
        canvas.text(Text { upwards: true, ..text });
    }
}

fn evens(axis: &Axis) -> Vec<f64> {
    axis.ticks.iter().map(|tick| tick.even).collect()
}

#[cfg(test)]
mod tests {
    use super::Beyond;

    #[test]
    fn arrows_that_would_lie_on_one_another_stand_side_by_side() {
        let mut beyond = Beyond::default();
        let places = [10.0, 12.0, 10.0, 19.0, 40.0].map(|y| beyond.column(-1.0, y));
        // That at 19 is too near to the one at 12 alone, which is second.
        assert_eq!(places, [0.0, 1.0, 2.0, 0.0, 0.0]);
        assert_eq!((beyond.column(1.0, 10.0), beyond.columns(-1.0, 40.0), beyond.columns(-1.0, 80.0)), (0.0, 1.0, 0.0));
    }
}
