//! Tones of a heat map and their legend: boxes with letters for classes, a colour bar for numbers.

use super::axis::Axis;
use super::class::Class;
use super::look::{FRAME, LABEL, SMALL};
use super::svg::{Anchor, Canvas, Text};
use super::text;

/// Fill of the classes in their order, from light to dark in even steps of grey, and the colour of
/// letters on it; the last one, out of that order, is for a seventh.
pub(super) const TONES: [(&str, &str); 7] = [
    ("#f7f7f7", "#000"),
    ("#b5cfe6", "#000"),
    ("#dc9a33", "#000"),
    ("#c0452a", "#fff"),
    ("#4b2357", "#fff"),
    ("#111111", "#fff"),
    ("#7fa98c", "#000"),
];

/// Colours of numbers from small to large: lightness decreases steadily, so that the order survives
/// in greyscale.
const RAMP: [(f64, f64, f64); 5] =
    [(247.0, 247.0, 235.0), (190.0, 215.0, 190.0), (100.0, 165.0, 185.0), (45.0, 90.0, 150.0), (20.0, 20.0, 70.0)];

/// Colour of a number at a share of the range.
pub(super) fn ramp(share: f64) -> String {
    let place = share.clamp(0.0, 1.0) * (RAMP.len() - 1) as f64;
    let i = (place.floor() as usize).min(RAMP.len() - 2);
    let t = place - i as f64;
    let (a, b) = (RAMP.get(i).copied().unwrap_or_default(), RAMP.get(i + 1).copied().unwrap_or_default());
    let mix = |a: f64, b: f64| (a + t * (b - a)).round() as u8;
    format!("#{:02x}{:02x}{:02x}", mix(a.0, b.0), mix(a.1, b.1), mix(a.2, b.2))
}

/// Draws the colour bar.
pub(super) fn draw_bar(canvas: &mut Canvas, label: &str, axis: &Axis, (x, top): (f64, f64), height: f64) {
    const STEPS: u32 = 60;
    let slice = height / f64::from(STEPS);
    for k in 0..STEPS {
        let fill = ramp((f64::from(k) + 0.5) / f64::from(STEPS));
        let y = top + height - f64::from(k + 1) * slice;
        canvas.rect(x, y, 12.0, slice + if k > 0 { 0.5 } else { 0.0 }, &fill);
    }
    canvas.frame(x, top, 12.0, height, FRAME);
    for tick in &axis.ticks {
        let y = top + height * (1.0 - axis.share_of_even(tick.even));
        canvas.line((x + 12.0, y), (x + 16.0, y), FRAME);
        let text = Text::new(x + 18.0, y + 3.6, &tick.body, SMALL, Anchor::Start);
        canvas.text(Text { exponent: tick.exponent, ..text });
    }
    if let Some(power) = axis.factor {
        let text = Text::new(x, top - 6.0, "×10", SMALL, Anchor::Start);
        canvas.text(Text { exponent: Some(power), ..text });
    }
    let label = text::shorten(label, LABEL, height);
    let text = Text::new(x + 68.0, top + height / 2.0, &label, LABEL, Anchor::Middle);
    canvas.text(Text { upwards: true, ..text });
}

/// Draws the legend of classes: filled boxes with their letters.
pub(super) fn draw_keys(canvas: &mut Canvas, classes: &[Class], x: f64, y: f64, width: f64) {
    let column = width / 3.0;
    for (i, (class, (fill, ink))) in classes.iter().zip(TONES).enumerate() {
        let (x, y) = (x + column * (i % 3) as f64, y + 18.0 * (i / 3) as f64);
        canvas.rect(x, y, 22.0, 13.0, fill);
        canvas.frame(x, y, 22.0, 13.0, FRAME);
        let letter = class.letter.to_string();
        canvas.text(Text { bold: true, colour: ink, ..Text::new(x + 11.0, y + 10.2, &letter, SMALL, Anchor::Middle) });
        let name = text::shorten(&class.name, LABEL, column - 34.0);
        canvas.text(Text::new(x + 28.0, y + 10.5, &name, LABEL, Anchor::Start));
    }
}
