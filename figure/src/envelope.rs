//! The envelope, between lowest and highest values, of a curve that oscillates too fast for the
//! page.

use super::thin::Spot;

/// Reversals per unit of page width above which single oscillations can no longer be told apart: a
/// period of 12 units, 3 mm.
const REVERSALS_PER_UNIT: f64 = 1.0 / 6.0;
/// A rise or fall smaller than this on the page is not counted as an oscillation.
const NOISE: f64 = 4.0;
/// Narrowest column, and columns per oscillation: narrower ones would show the oscillation itself.
const NARROWEST: f64 = 2.0;
const PERIODS_PER_COLUMN: f64 = 1.25;

/// Lowest and highest values over columns of the page.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Envelope {
    /// From left to right: (x, y of the upper edge, y of the lower edge) on the page.
    pub columns: Vec<(f64, f64, f64)>,
}

impl Envelope {
    /// The envelope of `spots`, which never go back in x and lie between `left` and `right`; `None`
    /// where the page can show every oscillation.
    pub(super) fn of(spots: &[Spot], left: f64, right: f64) -> Option<Self> {
        let points: Vec<(f64, f64)> = spots.iter().flatten().copied().collect();
        let reversals = reversals(&points) as f64;
        let (first, last) = (points.first()?.0.max(left), points.last()?.0.min(right));
        let length = last - first;
        if length <= 0.0 || reversals <= (length * REVERSALS_PER_UNIT).max(8.0) {
            return None;
        }
        let column = (PERIODS_PER_COLUMN * 2.0 * length / reversals).max(NARROWEST);
        let count = (length / column).ceil().max(2.0) as usize;
        let column = length / count as f64;
        let edges = |k: usize| first + k as f64 * column;
        // An edge point stands at the border between two columns and includes the extremes of both.
        let mut columns: Vec<(f64, f64, f64)> =
            (0..=count).map(|k| (edges(k), f64::INFINITY, f64::NEG_INFINITY)).collect();
        for &(x, y) in points.iter().filter(|p| (first..=last).contains(&p.0)) {
            let k = (((x - first) / column) as usize).min(count - 1);
            for (_, top, bottom) in columns.iter_mut().skip(k).take(2) {
                *top = top.min(y);
                *bottom = bottom.max(y);
            }
        }
        columns.retain(|c| c.1 <= c.2);
        Some(Self { columns })
    }

    /// Its outline, as one closed loop.
    pub(super) fn outline(&self) -> Vec<(f64, f64)> {
        let top = self.columns.iter().map(|c| (c.0, c.1));
        top.chain(self.columns.iter().rev().map(|c| (c.0, c.2))).collect()
    }

    /// Its two edges.
    pub(super) fn edges(&self) -> Vec<Vec<(f64, f64)>> {
        vec![self.columns.iter().map(|c| (c.0, c.1)).collect(), self.columns.iter().map(|c| (c.0, c.2)).collect()]
    }
}

/// How often a curve turns from rising to falling or back by more than [`NOISE`].
fn reversals(points: &[(f64, f64)]) -> usize {
    let mut count = 0;
    let mut rising = None;
    let mut extreme = points.first().map_or(0.0, |p| p.1);
    for &(_, y) in points {
        match rising {
            Some(true) if y > extreme => extreme = y,
            Some(false) if y < extreme => extreme = y,
            _ if (y - extreme).abs() > NOISE => {
                count += usize::from(rising.is_some());
                rising = Some(y > extreme);
                extreme = y;
            }
            _ => {}
        }
    }
    count
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_sine_of_a_hundred_periods_becomes_its_amplitude_and_one_of_ten_stays_a_line() {
        let wave = |periods: f64| -> Vec<Spot> {
            let at = |i: u32| f64::from(i) / 20_000.0;
            let y = |x: f64| 50.0 + 40.0 * (std::f64::consts::TAU * periods * x).sin();
            (0..=20_000).map(|i| Some((300.0 * at(i), y(at(i))))).collect()
        };
        assert_eq!(Envelope::of(&wave(10.0), 0.0, 300.0), None);
        let envelope = Envelope::of(&wave(100.0), 0.0, 300.0).unwrap();
        for (_, top, bottom) in &envelope.columns {
            // 200 samples per period: a sample lies within 40 (1 − cos(π/200)) = 5e-3 of each
            // extreme.
            assert!((top - 10.0).abs() < 6e-3 && (bottom - 90.0).abs() < 6e-3, "{top} to {bottom}");
        }
        assert_eq!((envelope.columns[0].0, envelope.columns.last().unwrap().0), (0.0, 300.0));
    }

    #[test]
    fn a_single_spike_stays_in_the_envelope() {
        let mut spots: Vec<Spot> =
            (0..10_000).map(|i| Some((f64::from(i) * 0.03, if i % 20 < 10 { 40.0 } else { 60.0 }))).collect();
        spots[5000] = Some((150.0, 3.0));
        let envelope = Envelope::of(&spots, 0.0, 300.0).unwrap();
        assert!(envelope.columns.iter().any(|c| c.1 == 3.0));
    }
}
