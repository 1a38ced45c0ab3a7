//! An axis: its range, its ticks, and the position of a value on it.

use super::look::SMALL;
use super::text;

/// How values are spread along an axis.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum Scale {
    /// Linear: equal differences have equal lengths.
    #[default]
    Linear,
    /// Logarithmic: equal ratios have equal lengths; values that are not positive cannot be drawn.
    Log,
}

impl Scale {
    /// The value, or its logarithm on a logarithmic axis: lengths on the page are proportional to
    /// it. `None` if it cannot be drawn.
    pub(super) fn even(self, value: f64) -> Option<f64> {
        match self {
            // A magnitude below 1e-290 counts as zero: it is too small to divide into ticks.
            Self::Linear if value.abs() < 1e-290 => Some(0.0),
            Self::Linear => (value.abs() <= 1e300).then_some(value),
            Self::Log => (1e-300..=1e300).contains(&value).then(|| value.log10()),
        }
    }
}

/// Smallest and largest value included so far; as logarithms on a logarithmic axis.
#[derive(Debug, Clone, Copy)]
pub(super) struct Extent {
    pub low: f64,
    pub high: f64,
}

impl Extent {
    pub(super) const EMPTY: Self = Self { low: f64::INFINITY, high: f64::NEG_INFINITY };

    pub(super) fn include(&mut self, even: f64) {
        self.low = self.low.min(even);
        self.high = self.high.max(even);
    }

    pub(super) fn is_empty(self) -> bool {
        self.low > self.high
    }

    pub(super) fn span(self) -> f64 {
        (self.high - self.low).max(0.0)
    }

    /// Widened by a share of its length at both ends; a constant gets a visible range, an empty
    /// extent a range of one.
    pub(super) fn padded(self, share: f64, scale: Scale) -> Self {
        if self.is_empty() {
            return match scale {
                Scale::Linear => Self { low: 0.0, high: 1.0 },
                Scale::Log => Self { low: -1.0, high: 0.0 },
            };
        }
        let size = self.low.abs().max(self.high.abs());
        let margin = match scale {
            Scale::Linear if size == 0.0 => 1.0,
            Scale::Linear if self.span() <= 1e-6 * size => 0.1 * size,
            Scale::Log if self.span() < 0.2 => 0.5,
            _ => share * self.span(),
        };
        Self { low: self.low - margin, high: self.high + margin }
    }
}

/// A tick: its position (a logarithm on a logarithmic axis) and its label.
#[derive(Debug, Clone)]
pub(super) struct Tick {
    pub even: f64,
    pub body: String,
    pub exponent: Option<i32>,
}

/// A finished axis.
#[derive(Debug, Clone)]
pub(super) struct Axis {
    pub scale: Scale,
    pub extent: Extent,
    pub ticks: Vec<Tick>,
    /// Ticks without a number.
    pub minor: Vec<f64>,
    /// Power of ten by which the tick numbers are to be multiplied.
    pub factor: Option<i32>,
}

impl Axis {
    /// Ticks for about `wanted` numbers over `extent`.
    pub(super) fn new(scale: Scale, extent: Extent, wanted: usize) -> Self {
        let mut axis = Self { scale, extent, ticks: Vec::new(), minor: Vec::new(), factor: None };
        match scale {
            Scale::Linear => axis.number_evenly(wanted),
            Scale::Log => axis.number_decades(wanted),
        }
        axis
    }

    /// Ticks for a horizontal axis of that length, as many as their numbers leave room for.
    pub(super) fn across(scale: Scale, extent: Extent, length: f64) -> Self {
        let mut wanted = (length / 50.0).max(2.0) as usize;
        loop {
            let axis = Self::new(scale, extent, wanted);
            if wanted <= 1 || axis.numbers_apart(length) {
                return axis;
            }
            wanted -= 1;
        }
    }

    /// True if no number touches the next on an axis of that length.
    fn numbers_apart(&self, length: f64) -> bool {
        let half = |tick: &Tick| {
            let raised = tick.exponent.map_or(0.0, |e| text::width(&e.to_string(), 0.75 * SMALL));
            0.5 * (text::width(&tick.body, SMALL) + raised)
        };
        let numbered: Vec<&Tick> = self.ticks.iter().filter(|t| !t.body.is_empty()).collect();
        numbered.windows(2).all(|pair| match pair {
            [a, b] => (self.share_of_even(b.even) - self.share_of_even(a.even)) * length > half(a) + half(b) + 4.0,
            _ => true,
        })
    }

    /// Position of a value as a share of the axis length.
    pub(super) fn share(&self, value: f64) -> Option<f64> {
        self.scale.even(value).map(|even| self.share_of_even(even))
    }

    pub(super) fn share_of_even(&self, even: f64) -> f64 {
        (even - self.extent.low) / self.extent.span().max(f64::MIN_POSITIVE)
    }

    /// A single number does not define a scale: in that case twice as many ticks are wanted.
    fn number_evenly(&mut self, wanted: usize) {
        for times in [1, 2, 4] {
            self.ticks.clear();
            self.number_by(times * wanted);
            if self.ticks.len() > 1 {
                return;
            }
        }
    }

    fn number_by(&mut self, wanted: usize) {
        let step = nice_step(self.extent.span() / wanted.max(1) as f64);
        if !(step > 0.0 && step.is_finite()) {
            return;
        }
        let size = decade(self.extent.low.abs().max(self.extent.high.abs()));
        let factor = if (-3..5).contains(&size) { 0 } else { 3 * size.div_euclid(3) };
        self.factor = (factor != 0).then_some(factor);
        let decimals = (factor - decade(step * 1.000_001)).clamp(0, 12) as usize;
        let slack = 1e-9 * self.extent.span();
        let first = ((self.extent.low - slack) / step).ceil();
        for k in 0..50 {
            let even = (first + f64::from(k)) * step;
            if even > self.extent.high + slack {
                break;
            }
            let shown = format!("{:.decimals$}", even / 10_f64.powi(factor) + 0.0);
            let shown = if shown.bytes().all(|b| matches!(b, b'-' | b'0' | b'.')) {
                shown.trim_start_matches('-').to_owned()
            } else {
                shown.replace('-', "−")
            };
            self.ticks.push(Tick { even, body: shown, exponent: None });
        }
    }

    fn number_decades(&mut self, wanted: usize) {
        let (low, high) = (self.extent.low, self.extent.high);
        let first = (low - 1e-9).ceil() as i32;
        let last = (high + 1e-9).floor() as i32;
        let whole = last - first + 1;
        let every = (whole / wanted.max(1) as i32 + i32::from(whole % wanted.max(1) as i32 != 0)).max(1);
        for power in first - 1..=last {
            for digit in 1..10 {
                let even = f64::from(power) + f64::from(digit).log10();
                if even < low - 1e-9 || even > high + 1e-9 {
                    continue;
                }
                let numbered =
                    if whole >= 2 { digit == 1 && power.rem_euclid(every) == 0 } else { matches!(digit, 1 | 2 | 5) };
                if numbered {
                    let body = if digit == 1 { "10".to_owned() } else { format!("{digit}×10") };
                    self.ticks.push(Tick { even, body, exponent: Some(power) });
                } else if digit == 1 {
                    self.ticks.push(Tick { even, body: String::new(), exponent: None });
                } else if whole <= 12 {
                    self.minor.push(even);
                }
            }
        }
    }
}

/// 1, 2 or 5 times a power of ten, not below `rough`.
fn nice_step(rough: f64) -> f64 {
    let unit = 10_f64.powi(decade(rough));
    [1.0, 2.0, 5.0, 10.0].into_iter().map(|n| n * unit).find(|step| *step >= rough * 0.999).unwrap_or(rough)
}

/// The power of ten at or below `value`.
fn decade(value: f64) -> i32 {
    if value > 0.0 && value.is_finite() { value.log10().floor() as i32 } else { 0 }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn an_axis_about_zero_has_more_than_one_number() {
        // With a step of 100 the only number would be 0.
        let axis = Axis::new(Scale::Linear, Extent { low: -90.0, high: 90.0 }, 3);
        let numbers: Vec<&str> = axis.ticks.iter().map(|tick| tick.body.as_str()).collect();
        assert_eq!(numbers, ["−50", "0", "50"]);
    }
}
