//! The positions of the names of marks, so that they do not overlap.

use super::axis::Axis;
use super::look::{SMALL, WIDTH};
use super::panel::Panel;
use super::plot_area::PlotArea;
use super::svg::{Anchor, Canvas, Stroke, Text};
use super::text;

/// Height of a line of names.
const LINE: f64 = SMALL + 1.0;
/// Space between two names on one line.
const SPACE: f64 = 6.0;
/// Longest name beside or above a frame.
const BESIDE: f64 = 144.0;
const ABOVE: f64 = 180.0;

/// A name, or the joined names of several marks, with the position that it belongs to.
#[derive(Debug, Clone, PartialEq)]
struct Name {
    place: f64,
    first: String,
    last: String,
    count: usize,
}

impl Name {
    fn text(&self, room: f64) -> String {
        let whole = match self.count {
            1 => self.first.clone(),
            2 => format!("{}, {}", self.first, self.last),
            count => format!("{} … {} ({count})", self.first, self.last),
        };
        text::shorten(&whole, SMALL, room)
    }

    fn join(&mut self, next: &Self) {
        let count = (self.count + next.count) as f64;
        self.place = (self.place * self.count as f64 + next.place * next.count as f64) / count;
        self.last.clone_from(&next.last);
        self.count += next.count;
    }
}

/// Joins neighbours, the nearest first, until the sum of `size` over all names fits into `room`.
fn fitted(mut names: Vec<Name>, room: f64, size: impl Fn(&Name) -> f64) -> Vec<Name> {
    names.sort_by(|a, b| a.place.total_cmp(&b.place));
    while names.len() > 1 && names.iter().map(&size).sum::<f64>() > room {
        let distance =
            |i: &usize| names.get(i + 1).zip(names.get(*i)).map_or(f64::INFINITY, |(b, a)| b.place - a.place);
        let nearest = (0..names.len() - 1).min_by(|a, b| distance(a).total_cmp(&distance(b))).unwrap_or(0);
        let next = names.remove(nearest + 1);
        if let Some(name) = names.get_mut(nearest) {
            name.join(&next);
        }
    }
    names
}

/// Starts of intervals with the given lengths, in their order and without overlap within
/// `low`..`high`, each as near to its wished position as the others allow.
fn spread(wishes: &[(f64, f64)], low: f64, high: f64) -> Vec<f64> {
    let mut out = Vec::with_capacity(wishes.len());
    let mut free = low;
    for &(wish, length) in wishes {
        let begin = wish.max(free);
        free = begin + length;
        out.push(begin);
    }
    let mut limit = high;
    for (begin, &(_, length)) in out.iter_mut().zip(wishes).rev() {
        *begin = begin.min(limit - length);
        limit = *begin;
    }
    out
}

/// A mark outside the frame is named at the edge of the frame, with an arrow towards it.
fn arrowed(share: f64, label: &str, arrows: [&str; 2]) -> (f64, String) {
    let [below, above] = arrows;
    if share < 0.0 {
        (0.0, format!("{below}{label}"))
    } else if share > 1.0 {
        (1.0, format!("{above}{label}"))
    } else {
        (share, label.to_owned())
    }
}

/// Names of the horizontal marks of a panel, as many as fit beside a frame of that `height` that
/// begins at `y`.
fn beside(panel: &Panel, axis: &Axis, (y, height): (f64, f64)) -> Vec<Name> {
    let name = |(value, label): (f64, &str)| {
        let (share, first) = arrowed(axis.share(value)?, label, ["↓ ", "↑ "]);
        Some(Name { place: y + (1.0 - share) * height, last: first.clone(), first, count: 1 })
    };
    let level = panel.marks.iter().filter(|m| !m.upright).map(|m| (m.value, m.label.as_str()));
    fitted(level.filter_map(name).collect(), height + LINE, |_| LINE)
}

/// Width that these names need.
pub(super) fn room_beside(panel: &Panel, axis: &Axis, height: f64) -> f64 {
    let names = beside(panel, axis, (0.0, height));
    names.iter().map(|name| text::width(&name.text(BESIDE), SMALL) + 8.0).fold(0.0, f64::max)
}

/// Draws the names of the horizontal marks to the right of the frame.
pub(super) fn draw_beside(canvas: &mut Canvas, panel: &Panel, frame: &PlotArea<'_>) {
    let names = beside(panel, frame.y_axis, (frame.y, frame.height));
    let wishes: Vec<_> = names.iter().map(|n| (n.place - 0.5 * LINE, LINE)).collect();
    let begins = spread(&wishes, frame.y - 0.5 * LINE, frame.y + frame.height + 0.5 * LINE);
    let end = frame.x + frame.width;
    for (name, begin) in names.iter().zip(begins) {
        let y = begin + 0.5 * LINE;
        canvas.line((end, name.place), (end + 4.0, y), Stroke::solid("#333", 0.6));
        canvas.text(Text::new(end + 6.0, y + 3.5, &name.text(BESIDE), SMALL, Anchor::Start));
    }
}

/// Draws the names of the vertical marks above the frame, right of `free`.
pub(super) fn draw_above(canvas: &mut Canvas, panel: &Panel, frame: &PlotArea<'_>, free: f64) {
    let name = |(value, label): (f64, &str)| {
        let (share, first) = arrowed(frame.x_axis.share(value)?, label, ["← ", "→ "]);
        Some(Name { place: frame.across(share), last: first.clone(), first, count: 1 })
    };
    let size = |n: &Name| text::width(&n.text(ABOVE), SMALL) + SPACE;
    let upright = panel.marks.iter().filter(|m| m.upright).map(|m| (m.value, m.label.as_str()));
    let high = WIDTH - 4.0 + SPACE;
    let names = fitted(upright.filter_map(name).collect(), high - free, size);
    let wishes: Vec<_> = names.iter().map(|n| (n.place - 0.5 * (size(n) - SPACE), size(n))).collect();
    for (name, x) in names.iter().zip(spread(&wishes, free, high)) {
        canvas.text(Text::new(x, frame.y - 4.0, &name.text(ABOVE), SMALL, Anchor::Start));
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn name(place: f64, text: &str) -> Name {
        Name { place, first: text.into(), last: text.into(), count: 1 }
    }

    #[test]
    fn four_hundred_names_become_as_many_lines_as_there_is_room_for() {
        let names: Vec<Name> = (0..400).map(|i| name(f64::from(i) * 0.5, &format!("wall-{i}"))).collect();
        let fitted = fitted(names, 130.0, |_| LINE);
        assert!(fitted.len() as f64 * LINE <= 130.0 && fitted.len() > 8, "{}", fitted.len());
        assert_eq!(fitted.iter().map(|n| n.count).sum::<usize>(), 400);
        assert!(fitted[0].text(200.0).starts_with("wall-0 … wall-"), "{}", fitted[0].text(200.0));
    }

    #[test]
    fn names_that_want_one_place_are_spread_within_the_room() {
        let begins = spread(&[(95.0, 10.0), (95.0, 10.0), (95.0, 10.0)], 0.0, 100.0);
        assert_eq!(begins, [70.0, 80.0, 90.0]);
        assert_eq!(spread(&[(-5.0, 10.0), (3.0, 10.0)], 0.0, 100.0), [0.0, 10.0]);
    }
}
