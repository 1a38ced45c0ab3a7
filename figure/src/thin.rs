//! Long curves reduced to what the page can show, with their extremes kept.

use std::collections::HashSet;

/// A point on the page, or a break in the line.
pub(super) type Spot = Option<(f64, f64)>;

/// Reduces `spots` to about `budget` points, as separate lines.
///
/// A curve that never goes back in x keeps the first, lowest, highest and last point of each of
/// `budget`/4 columns (Jugel and others, doi:10.14778/2732951.2732953: no pixel changes). Any other
/// curve loses the points that lie on the line between their neighbours, and the strokes that
/// repeat earlier ones.
pub(super) fn thin(spots: &[Spot], budget: usize) -> Vec<Vec<(f64, f64)>> {
    let drawn = spots.iter().flatten().count();
    let forward = never_goes_back(spots);
    if forward && drawn > budget {
        columns(spots, budget / 4)
    } else if !forward && drawn > budget.min(1000) {
        // An orbit drawn many times over fills the gaps of its own dashes.
        strokes(spots, budget)
    } else {
        runs(spots.iter().copied())
    }
}

/// True where x never decreases.
pub(super) fn never_goes_back(spots: &[Spot]) -> bool {
    let mut last = f64::NEG_INFINITY;
    spots.iter().flatten().all(|&(x, _)| {
        let forward = x >= last;
        last = x;
        forward
    })
}

fn runs(spots: impl Iterator<Item = Spot>) -> Vec<Vec<(f64, f64)>> {
    let mut out = Vec::new();
    let mut run = Vec::new();
    for spot in spots {
        match spot {
            Some(point) => run.push(point),
            None if run.is_empty() => {}
            None => out.push(std::mem::take(&mut run)),
        }
    }
    if !run.is_empty() {
        out.push(run);
    }
    out
}

/// One column of the page: four points and the order they came in.
struct Column {
    number: i64,
    after_break: bool,
    /// First, lowest, highest, last point, each with its index in the curve.
    kept: [(usize, (f64, f64)); 4],
}

impl Column {
    fn emit(&mut self, out: &mut Vec<Spot>) {
        if self.after_break {
            out.push(None);
        }
        self.kept.sort_by_key(|&(place, _)| place);
        let mut previous = None;
        for (place, point) in self.kept {
            if previous != Some(place) {
                out.push(Some(point));
            }
            previous = Some(place);
        }
    }
}

fn columns(spots: &[Spot], columns: usize) -> Vec<Vec<(f64, f64)>> {
    let xs = || spots.iter().flatten().map(|point| point.0);
    let (low, high) = (xs().fold(f64::INFINITY, f64::min), xs().fold(f64::NEG_INFINITY, f64::max));
    let per_unit = columns.max(1) as f64 / (high - low).max(f64::MIN_POSITIVE);
    let mut out = Vec::new();
    let mut current: Option<Column> = None;
    let mut after_break = false;
    for (place, spot) in spots.iter().enumerate() {
        let Some(point) = *spot else {
            after_break = true;
            continue;
        };
        let number = ((point.0 - low) * per_unit) as i64;
        match &mut current {
            // A break within one column is not visible.
            Some(column) if column.number == number => {
                let [_, lowest, highest, last] = &mut column.kept;
                if point.1 < lowest.1.1 {
                    *lowest = (place, point);
                }
                if point.1 > highest.1.1 {
                    *highest = (place, point);
                }
                *last = (place, point);
            }
            _ => {
                if let Some(mut column) = current.take() {
                    column.emit(&mut out);
                }
                current = Some(Column { number, after_break, kept: [(place, point); 4] });
            }
        }
        after_break = false;
    }
    if let Some(mut column) = current {
        column.emit(&mut out);
    }
    runs(out.into_iter())
}

/// Coarsens the curve step by step until the budget is met.
fn strokes(spots: &[Spot], budget: usize) -> Vec<Vec<(f64, f64)>> {
    let extremes = extremes(spots);
    let mut grain = 0.25;
    loop {
        let kept = drawn_once(&straightened(spots, grain, &extremes), grain);
        if kept.iter().flatten().count() <= budget || grain > 64.0 {
            return kept;
        }
        grain *= 1.5;
    }
}

/// Indices of the leftmost, rightmost, lowest and highest point.
fn extremes(spots: &[Spot]) -> [usize; 4] {
    let mut best = [(f64::INFINITY, 0); 4];
    for (place, spot) in spots.iter().enumerate() {
        if let &Some((x, y)) = spot {
            for (best, value) in best.iter_mut().zip([x, -x, y, -y]) {
                if value < best.0 {
                    *best = (value, place);
                }
            }
        }
    }
    best.map(|(_, place)| place)
}

/// Drops points within `grain` of the last one kept, and points that continue its direction to
/// within `grain`.
fn straightened(spots: &[Spot], grain: f64, always: &[usize; 4]) -> Vec<Spot> {
    let mut out: Vec<Spot> = Vec::new();
    let mut anchor: Spot = None;
    let mut ahead: Spot = None;
    let mut pending: Spot = None;
    for (place, spot) in spots.iter().enumerate() {
        let Some(point) = *spot else {
            out.extend(pending.take().map(Some));
            if !matches!(out.last(), Some(None)) {
                out.push(None);
            }
            (anchor, ahead) = (None, None);
            continue;
        };
        let bends = match (anchor, ahead) {
            (Some(a), Some(b)) => {
                let (ux, uy, vx, vy) = (b.0 - a.0, b.1 - a.1, point.0 - a.0, point.1 - a.1);
                let along = ux * vx + uy * vy;
                let length = ux.hypot(uy);
                let backwards = pending.is_some_and(|p| along < ux * (p.0 - a.0) + uy * (p.1 - a.1));
                (ux * vy - uy * vx).abs() > grain * length || backwards
            }
            _ => false,
        };
        if let Some(turn) = pending.take_if(|_| bends) {
            out.push(Some(turn));
            (anchor, ahead) = (Some(turn), None);
        }
        match anchor {
            None => {
                out.push(Some(point));
                anchor = Some(point);
            }
            Some(_) if always.contains(&place) => {
                out.extend(pending.take().map(Some));
                out.push(Some(point));
                (anchor, ahead) = (Some(point), None);
            }
            Some(a) if (point.0 - a.0).hypot(point.1 - a.1) >= grain => {
                ahead = ahead.or(Some(point));
                pending = Some(point);
            }
            Some(_) => {}
        }
    }
    out.extend(pending.map(Some));
    out
}

/// Drops strokes whose ends coincide, on a mesh of `grain`, with those of an earlier stroke.
fn drawn_once(spots: &[Spot], grain: f64) -> Vec<Vec<(f64, f64)>> {
    let cell = |(x, y): (f64, f64)| ((x / grain).round() as i32, (y / grain).round() as i32);
    let mut seen = HashSet::new();
    let mut out = Vec::new();
    let mut run: Vec<(f64, f64)> = Vec::new();
    let mut last: Spot = None;
    for spot in spots {
        if let (Some(a), Some(b)) = (last, *spot) {
            let (from, to) = (cell(a), cell(b));
            if seen.insert(if from < to { (from, to) } else { (to, from) }) {
                if run.is_empty() {
                    run.push(a);
                }
                run.push(b);
            } else if !run.is_empty() {
                out.push(std::mem::take(&mut run));
            }
        } else if !run.is_empty() {
            out.push(std::mem::take(&mut run));
        }
        last = *spot;
    }
    if !run.is_empty() {
        out.push(run);
    }
    out
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_million_samples_keep_their_extremes() {
        let mut spots: Vec<Spot> =
            (0..1_000_000).map(|i| f64::from(i) * 5e-4).map(|x| Some((x, 50.0 + 10.0 * (x * 40.0).sin()))).collect();
        spots[123_457] = Some((123_457.0 * 5e-4, -7.25));
        spots[876_543] = Some((876_543.0 * 5e-4, 199.5));
        let thinned = thin(&spots, 4000);
        let ys: Vec<f64> = thinned.iter().flatten().map(|p| p.1).collect();
        assert!(ys.len() <= 4004 && ys.contains(&-7.25) && ys.contains(&199.5));
        assert_eq!(thinned[0][0], spots[0].unwrap());
    }

    #[test]
    fn an_orbit_keeps_its_extremes_and_its_shape() {
        let mut spots: Vec<Spot> = (0..1_000_000)
            .map(|i| f64::from(i) * 0.01)
            .map(|t| Some((200.0 + 180.0 * t.cos(), 100.0 + 90.0 * t.sin())))
            .collect();
        spots[500_000] = Some((399.0, 3.0));
        let thinned = thin(&spots, 8000);
        let kept: Vec<(f64, f64)> = thinned.iter().flatten().copied().collect();
        assert!(kept.len() <= 8000, "{} points", kept.len());
        assert!(kept.contains(&(399.0, 3.0)));
        let on_the_ellipse = |p: &&(f64, f64)| (((p.0 - 200.0) / 180.0).hypot((p.1 - 100.0) / 90.0) - 1.0).abs() < 1e-9;
        assert!(kept.iter().filter(on_the_ellipse).count() + 1 >= kept.len() && kept.len() > 40);
    }

    #[test]
    fn noise_meets_the_budget_too() {
        let mut state = 1_u64;
        let mut draw = || {
            state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
            (state >> 40) as f64 / f64::from(1 << 24)
        };
        let spots: Vec<Spot> = (0..200_000).map(|_| Some((600.0 * draw(), 300.0 * draw()))).collect();
        assert!(thin(&spots, 4000).iter().flatten().count() <= 4000);
    }

    #[test]
    fn a_gap_breaks_the_line_and_many_gaps_stay_within_the_budget() {
        let mut spots: Vec<Spot> = (0..100_000).map(|i| Some((f64::from(i) * 5e-3, 1.0))).collect();
        for spot in spots.iter_mut().skip(40_000).take(20_000) {
            *spot = None;
        }
        assert_eq!(thin(&spots, 4000).len(), 2);
        for spot in spots.iter_mut().step_by(2) {
            *spot = None;
        }
        assert!(thin(&spots, 4000).iter().flatten().count() <= 4004);
    }
}
