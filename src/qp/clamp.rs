//! One unknown: the programme is a monotone, piecewise linear scalar equation, solved exactly.
//!
//! a x = b + Σ rᵢ(x), rᵢ(x) = (lᵢ − x)/cᵢ below lᵢ, (uᵢ − x)/cᵢ above uᵢ, 0 between (elastic rows),
//! and x held within the rigid rows' bounds, whose force closes the balance.

use super::{Failure, Problem, ROUNDING, Rhs, Solution};

/// Bounds of one place differ by the roundings of their sums and of the division by a weight only:
/// a few units in the last place. Bounds that differ by more are of walls apart, of which the
/// foremost one pushes alone, however far the body would go.
const ULPS_OF_ONE_PLACE: f64 = 32.0;

/// True if both bounds of one row are those of walls at one place.
pub(crate) fn is_one_place(bound: f64, other: f64) -> bool {
    (bound - other).abs() <= ULPS_OF_ONE_PLACE * f64::EPSILON * other.abs()
}

/// A row of the scalar programme, with coefficient 1: l ≤ x ≤ u.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ScalarRow {
    /// l, in the unit of x; −∞ for none.
    pub lo: f64,
    /// u, in the unit of x; +∞ for none.
    pub hi: f64,
    /// c, unit of x per unit of b: 0 for a rigid row, above 0 for an elastic one.
    pub compliance: f64,
}

/// Minimises ½ a x² − b x over `rows` and writes the signed force of each row to `r`, so that a x =
/// b + Σ r.
///
/// If several rigid rows bind at one place (bounds that differ by at most 32 units in the last
/// place), they share the force equally. Rigid bounds that cross by rounding only (1e-12 of the
/// largest of |l|, |u| and |b/a|) count as one place, their midpoint.
///
/// ```
/// use signorini::qp::{clamp, ScalarRow};
/// let rows = [ScalarRow { lo: -1.0, hi: 1.0, compliance: 0.0 }];
/// let mut r = [0.0];
/// assert_eq!(clamp(2.0, 6.0, &rows, &mut r), Ok(1.0));
/// assert_eq!(r, [-4.0]);
/// ```
///
/// # Errors
/// [`Failure::NotPositiveDefinite`] unless a > 0; [`Failure::NotFinite`] if a, b or a row is NaN,
/// or b/a is infinite; [`Failure::Infeasible`] if rigid bounds cross; [`Failure::Shape`] unless
/// `rows` and `r` are equally long.
#[inline]
pub fn clamp(a: f64, b: f64, rows: &[ScalarRow], r: &mut [f64]) -> Result<f64, Failure> {
    let free = b / a;
    // One pass settles the steps without contact. A NaN anywhere makes a comparison false, and the
    // slower path names it.
    let mut inside = a > 0.0 && free.is_finite() && rows.len() == r.len();
    for row in rows {
        inside &= row.lo <= free && free <= row.hi;
    }
    if inside {
        r.fill(0.0);
        return Ok(free);
    }
    contact(a, b, rows, r)
}

/// The remaining cases: a bound is violated, or an argument is invalid.
#[inline]
fn contact(a: f64, b: f64, rows: &[ScalarRow], r: &mut [f64]) -> Result<f64, Failure> {
    // In one piece, the step of one degree of freedom: the bounds of its rows, then their forces.
    let free = b / a;
    if rows.len() != r.len() {
        return Err(Failure::Shape { what: "forces", expected: rows.len(), found: r.len() });
    }
    if !(a > 0.0 && free.is_finite()) {
        return Err(fault(a, b));
    }
    // The narrowest rigid interval and the first row on each of its ends; the elastic rows the free
    // motion violates.
    let (mut lo, mut first_lo) = (f64::NEG_INFINITY, 0);
    let (mut hi, mut first_hi) = (f64::INFINITY, 0);
    let (mut yielding, mut sound) = (false, true);
    for (i, row) in rows.iter().enumerate() {
        sound &= row.lo < f64::INFINITY && row.hi > f64::NEG_INFINITY;
        if row.compliance > 0.0 {
            yielding |= free < row.lo || free > row.hi;
            sound &= row.lo <= row.hi && row.compliance < f64::INFINITY;
        } else {
            sound &= row.compliance == 0.0;
            if row.lo > lo {
                (lo, first_lo) = (row.lo, i);
            }
            if row.hi < hi {
                (hi, first_hi) = (row.hi, i);
            }
        }
    }
    if !sound {
        return Err(unsound(rows));
    }
    if lo > hi {
        if lo - hi > ROUNDING * lo.abs().max(hi.abs()).max(free.abs()) {
            return Err(Failure::Infeasible { row: first_lo, against: first_hi });
        }
        let middle = 0.5 * (lo + hi);
        (lo, hi) = (middle, middle);
    }
    r.fill(0.0);
    let x = if yielding { yield_to(a, b, rows, r) } else { free };
    if lo <= x && x <= hi {
        return Ok(x);
    }
    let (x, bearer) = if x < lo { (lo, first_lo) } else { (hi, first_hi) };
    let mut rest = a * x - b;
    if yielding || rows.iter().any(|row| row.compliance > 0.0) {
        for (force, row) in r.iter_mut().zip(rows) {
            *force = row.elastic(x);
            rest -= *force;
        }
    }
    let bears = |row: &ScalarRow| {
        let bound = if rest < 0.0 { row.hi } else { row.lo };
        row.compliance == 0.0 && is_one_place(bound, x)
    };
    let bearers = rows.iter().filter(|row| bears(row)).count();
    if bearers <= 1 {
        if let Some(force) = r.get_mut(bearer) {
            *force = rest;
        }
        return Ok(x);
    }
    for (force, _) in r.iter_mut().zip(rows).filter(|(_, row)| bears(row)) {
        *force = rest / bearers as f64;
    }
    Ok(x)
}

/// Solves the balance of the elastic rows alone: finds the linear piece that holds the root, then
/// its x and forces.
fn yield_to(a: f64, b: f64, rows: &[ScalarRow], r: &mut [f64]) -> f64 {
    let free = b / a;
    let elastic = || rows.iter().filter(|row| row.compliance > 0.0);
    // The residual a x − b − Σ r(x) increases with x, so its signs at the breakpoints bracket the
    // piece.
    let (mut left, mut right) = (f64::NEG_INFINITY, f64::INFINITY);
    for place in elastic().flat_map(|row| [row.lo, row.hi]).filter(|place| place.is_finite()) {
        let pull: f64 = elastic().map(|row| row.elastic(place)).sum();
        if a * (place - free) <= pull { left = f64::max(left, place) } else { right = f64::min(right, place) }
    }
    // Between them a row acts if its bound lies at or beyond the far end; δ = x − b/a.
    let bound = |row: &ScalarRow| {
        let elastic = row.compliance > 0.0;
        if elastic && row.lo >= right {
            Some(row.lo)
        } else if elastic && row.hi <= left {
            Some(row.hi)
        } else {
            None
        }
    };
    let (mut pull, mut slope, mut stiffest) = (0.0, a, None);
    for (i, row) in rows.iter().enumerate() {
        if let Some(place) = bound(row) {
            pull += (place - free) / row.compliance;
            slope += 1.0 / row.compliance;
            if stiffest.is_none_or(|(_, compliance)| row.compliance < compliance) {
                stiffest = Some((i, row.compliance));
            }
        }
    }
    let shift = pull / slope;
    let x = free + shift;
    // (bound − x)/c loses digits to cancellation when c is small, so the stiffest row takes what
    // the balance a δ = Σ r leaves.
    let Some((stiffest, _)) = stiffest else { return free };
    let mut rest = a * shift;
    for (i, (force, row)) in r.iter_mut().zip(rows).enumerate() {
        if i != stiffest {
            *force = bound(row).map_or(0.0, |place| (place - x) / row.compliance);
            rest -= *force;
        }
    }
    if let Some(force) = r.get_mut(stiffest) {
        *force = rest;
    }
    x
}

#[cold]
fn fault(a: f64, b: f64) -> Failure {
    match (a.is_nan(), b.is_finite(), a > 0.0) {
        (true, _, _) => Failure::NotFinite { what: "A", index: 0 },
        (_, true, false) => Failure::NotPositiveDefinite,
        _ => Failure::NotFinite { what: "b", index: 0 },
    }
}

#[cold]
fn unsound(rows: &[ScalarRow]) -> Failure {
    for (index, row) in rows.iter().enumerate() {
        if row.lo.is_nan() || row.lo == f64::INFINITY {
            return Failure::NotFinite { what: "lower bound", index };
        }
        if row.hi.is_nan() || row.hi == f64::NEG_INFINITY {
            return Failure::NotFinite { what: "upper bound", index };
        }
        if !(row.compliance >= 0.0 && row.compliance.is_finite()) {
            return Failure::NotFinite { what: "compliance", index };
        }
        if row.lo > row.hi {
            return Failure::Infeasible { row: index, against: index };
        }
    }
    Failure::NotSolved { status: "unsound rows" }
}

impl ScalarRow {
    /// Force of an elastic row at x.
    fn elastic(&self, x: f64) -> f64 {
        let elastic = self.compliance > 0.0;
        if elastic && x < self.lo {
            (self.lo - x) / self.compliance
        } else if elastic && x > self.hi {
            (self.hi - x) / self.compliance
        } else {
            0.0
        }
    }
}

/// The scalar programme behind the matrices of [`Problem`]: coefficients gᵢ other than 1 are taken
/// into bounds and compliances, x-row i being lᵢ/gᵢ ≤ x ≤ uᵢ/gᵢ with compliance cᵢ/gᵢ² and force gᵢ
/// rᵢ.
#[derive(Debug, Clone)]
pub(super) struct Clamp {
    a: f64,
    coefficient: Vec<f64>,
    compliance: Vec<f64>,
    scale: f64,
    rows: Vec<ScalarRow>,
}

impl Clamp {
    pub(super) fn new(problem: &Problem, scale: f64) -> Result<Self, Failure> {
        super::shape("unknowns of the clamp", 1, problem.a.size())?;
        let a = problem.a.get(0, 0);
        if a <= 0.0 || a.is_nan() {
            return Err(Failure::NotPositiveDefinite);
        }
        let coefficient: Vec<f64> = (0..problem.g.count()).map(|i| problem.g.dot(i, &[1.0])).collect();
        let compliance = problem.compliance.clone();
        let rows = coefficient
            .iter()
            .zip(&compliance)
            .map(|(&g, &c)| ScalarRow { lo: f64::NEG_INFINITY, hi: f64::INFINITY, compliance: free_of(g, c / (g * g)) })
            .collect();
        Ok(Self { a, coefficient, compliance, scale, rows })
    }

    pub(super) fn solve(&mut self, rhs: &Rhs, solution: &mut Solution) -> Result<(), Failure> {
        rhs.shape(1, self.rows.len())?;
        super::finite("b", rhs.b, f64::is_finite)?;
        rhs.check(self.scale, 0..self.rows.len())?;
        for (i, (row, &g)) in self.rows.iter_mut().zip(&self.coefficient).enumerate() {
            let (lo, hi) = ordered_bounds(rhs.lo[i], rhs.hi[i]);
            (row.lo, row.hi) = if g > 0.0 {
                (lo / g, hi / g)
            } else if g < 0.0 {
                (hi / g, lo / g)
            } else {
                (f64::NEG_INFINITY, f64::INFINITY)
            };
        }
        let x = clamp(self.a, rhs.b[0], &self.rows, &mut solution.multiplier)?;
        solution.x[0] = x;
        for (i, (force, &g)) in solution.multiplier.iter_mut().zip(&self.coefficient).enumerate() {
            *force = if g == 0.0 {
                blind(i, rhs.lo[i], rhs.hi[i], self.compliance[i], ROUNDING * self.scale)?
            } else {
                *force / g
            };
        }
        Ok(())
    }
}

/// A row's own bounds; where they cross by rounding, both become their midpoint.
pub(super) fn ordered_bounds(lo: f64, hi: f64) -> (f64, f64) {
    if lo > hi {
        let middle = 0.5 * (lo + hi);
        (middle, middle)
    } else {
        (lo, hi)
    }
}

/// The force of a row with g = 0: its displacement is 0 whatever x is.
fn blind(row: usize, lo: f64, hi: f64, compliance: f64, tolerance: f64) -> Result<f64, Failure> {
    if compliance > 0.0 {
        Ok((0.0_f64.max(lo).min(hi)) / compliance)
    } else if lo > tolerance || hi < -tolerance {
        Err(Failure::Infeasible { row, against: row })
    } else {
        Ok(0.0)
    }
}

fn free_of(g: f64, value: f64) -> f64 {
    if g == 0.0 { 0.0 } else { value }
}

#[cfg(test)]
mod tests;
