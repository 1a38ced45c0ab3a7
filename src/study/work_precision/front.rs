//! Results read from a set of points: the order of a scheme, the Pareto front, the cheapest point
//! at a tolerance.

use crate::order::sort_by_number;

/// The points that no other point beats in both error and time, sorted by decreasing error and
/// increasing time.
#[must_use]
pub fn pareto(points: impl IntoIterator<Item = (f64, f64)>) -> Vec<(f64, f64)> {
    let drawn = |p: &(f64, f64)| p.0 > 0.0 && p.1 > 0.0 && p.0.is_finite() && p.1.is_finite();
    let mut points: Vec<_> = points.into_iter().filter(drawn).collect();
    sort_by_number(&mut points, |point| point.0);
    sort_by_number(&mut points, |point| point.1);
    let mut least = f64::INFINITY;
    points.retain(|p| {
        let better = p.0 < least;
        least = least.min(p.0);
        better
    });
    points
}

/// Slope of ln(error) over ln(step), by least squares; `None` from fewer than two different steps.
///
/// ```
/// use signorini::study::work_precision::order;
///
/// let second = (1..5).map(|k| 0.1_f64.powi(k)).map(|h| (h, 3.0 * h * h));
/// assert!((order(second).unwrap() - 2.0).abs() < 1e-12);
/// ```
#[must_use]
pub fn order(points: impl IntoIterator<Item = (f64, f64)>) -> Option<f64> {
    let logs: Vec<(f64, f64)> =
        points.into_iter().filter(|p| p.0 > 0.0 && p.1 > 0.0).map(|(h, e)| (h.ln(), e.ln())).collect();
    let n = logs.len() as f64;
    let mean = |f: fn(&(f64, f64)) -> f64| logs.iter().map(f).sum::<f64>() / n;
    let (x, y) = (mean(|p| p.0), mean(|p| p.1));
    let above: f64 = logs.iter().map(|p| (p.0 - x) * (p.1 - y)).sum();
    let below: f64 = logs.iter().map(|p| (p.0 - x) * (p.0 - x)).sum();
    (below > 0.0).then_some(above / below)
}

/// Index of the first of `errors`, coarsest step first, from which on all are at most `tolerance`.
/// A coarse run within the tolerance by chance, followed by finer ones that exceed it, does not
/// count.
#[must_use]
pub fn reached(errors: &[f64], tolerance: f64) -> Option<usize> {
    // NaN counts as exceeding the tolerance.
    let misses = errors.iter().rposition(|e| e.is_nan() || *e > tolerance);
    let first = misses.map_or(0, |i| i + 1);
    (first < errors.len()).then_some(first)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_front_keeps_what_nothing_beats() {
        let points = [(1e-2, 1.0), (1e-3, 2.0), (5e-3, 3.0), (1e-4, 9.0), (0.0, 0.1), (f64::NAN, 0.1)];
        assert_eq!(pareto(points), vec![(1e-2, 1.0), (1e-3, 2.0), (1e-4, 9.0)]);
    }

    #[test]
    fn a_lucky_coarse_run_does_not_reach_a_tolerance() {
        assert_eq!(reached(&[1e-4, 1e-1, 1e-2, 1e-3], 1e-2), Some(2));
        assert_eq!(reached(&[1e-4, 1e-1], 1e-2), None);
        assert_eq!(reached(&[1e-4], 1e-2), Some(0));
        assert_eq!(reached(&[], 1.0), None);
    }
}
