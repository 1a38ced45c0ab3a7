//! The exact motion of a structure over a short stretch: its Taylor series, down to rounding.
//!
//! Between events M q̈ + C q̇ + K q = f(t) + Gᵀ r with r linear in the state. From (q, q̇) at the
//! start all derivatives follow,
//!
//! M q⁽ᵏ⁺²⁾ = f⁽ᵏ⁾ − C q⁽ᵏ⁺¹⁾ − K q⁽ᵏ⁾ + Gᵀ r⁽ᵏ⁾,
//!
//! which is the action of the exponential of the first-order system on its state (Al-Mohy and
//! Higham 2011, doi:10.1137/100788860): it takes products with M⁻¹, C and K only, for any
//! structure. A stretch is no longer than two radians of the fastest motion, so that no term is
//! much larger than the motion itself and no digits cancel, and the series goes on until its terms
//! are below rounding. There is no discretisation error.
//!
//! An elastic wall that touches gives r⁽ᵏ⁾ = −k_a (w − g)⁽ᵏ⁾ − c_a w⁽ᵏ⁺¹⁾. Rigid walls in lasting
//! contact give the r⁽ᵏ⁾ for which G q⁽ᵏ⁺²⁾ = 0, and round holes round which the structure slides
//! those that keep it on their circles (`circle.rs`).

mod around;
mod body;
mod change;
mod circle;
mod held_rows;
mod responses;
mod round;
mod terms;
mod truncation;
mod wave;

use crate::scene::Row;
pub(crate) use body::SeriesBody;
pub(crate) use change::{Changes, Drive};
use circle::Circle;
pub(crate) use held_rows::{HeldRow, HeldRows};
pub(crate) use responses::{INVERSE, Response, Responses, add_sine};
pub(crate) use round::Round;
pub(crate) use terms::{Start, Touching};
use wave::Wave;

/// Number of terms of the longest series, and the stride of a polynomial.
pub(crate) const TERMS: usize = 32;

/// A stretch of exact motion of a structure on which the set of touching walls does not change.
///
/// With x = (t − start)/unit the displacement is q(t) = Σ aₖ xᵏ, n entries each.
#[derive(Debug, Clone, PartialEq)]
pub struct Series {
    n: usize,
    start: f64,
    end: f64,
    /// The unit of x, s: 0 ≤ x ≤ 1 on the stretch.
    unit: f64,
    /// Number of terms in use.
    terms: usize,
    /// aₖ one after the other, n entries each.
    motion: Vec<f64>,
    /// Displacements at the rows of the walls, m: a polynomial in x each. The value at the row of a
    /// hole is such that its distance to the wall of this row is the gap (γ² − |w|²)/2γ.
    seen: Vec<f64>,
    /// The indices of the round walls; number of the rows of flat ones, and of the terms at the
    /// rows of round ones.
    round_walls: Vec<usize>,
    fixed: usize,
    squares: usize,
    /// One for each round hole.
    circles: Vec<Circle>,
    /// Work space: the accelerations that the circles demand at the held rows.
    wanted: Vec<f64>,
    /// Force polynomials, N: of the touching elastic walls, then of the held rows.
    forces: Vec<f64>,
    /// The acting walls, by increasing index.
    acting: Vec<Acting>,
    waves: Vec<Wave>,
    /// The fastest rate that the stretch was made for, 1/s.
    rate: f64,
    /// The length that it would have without an event, s: its unit, unless events that follow one
    /// another quickly were expected to end it long before.
    longest: f64,
}

/// A wall that exerts a force during a stretch.
#[derive(Debug, Clone, Copy, PartialEq)]
struct Acting {
    wall: usize,
    /// Index of its force polynomial.
    slot: usize,
    /// Its share of that force: walls at one place carry it equally.
    share: f64,
    /// For a rigid wall the sign of its force; the opposite sign can only be rounding, and is cut
    /// to 0.
    sign: Option<f64>,
}

impl Series {
    /// Time at which it starts, s.
    #[must_use]
    pub fn start(&self) -> f64 {
        self.start
    }

    /// Time at which it ends, s.
    #[must_use]
    pub fn end(&self) -> f64 {
        self.end
    }

    /// n.
    #[must_use]
    pub fn degrees_of_freedom(&self) -> usize {
        self.n
    }

    /// Displacement (m) and velocity (m/s) at `t`, from the right at the start and from the left at
    /// the end, into slices of n entries; others are left as they are.
    pub fn state(&self, t: f64, q: &mut [f64], v: &mut [f64]) {
        if q.len() != self.n || v.len() != self.n {
            return;
        }
        self.state_at((t - self.start) / self.unit, q, v);
    }

    /// As [`Series::state`], at x.
    pub(crate) fn state_at(&self, x: f64, q: &mut [f64], v: &mut [f64]) {
        let n = self.n;
        let (q, v) = (&mut q[..n], &mut v[..n]);
        if x == 0.0 {
            q.copy_from_slice(self.term(0));
            let inverse = 1.0 / self.unit;
            v.iter_mut().enumerate().for_each(|(i, v)| *v = self.motion.get(n + i).map_or(0.0, |a| a * inverse));
            return;
        }
        q.fill(0.0);
        v.fill(0.0);
        for k in (0..self.terms).rev() {
            let term = &self.motion[k * n..(k + 1) * n];
            if k > 0 {
                let factor = k as f64;
                for ((q, v), a) in q.iter_mut().zip(&mut *v).zip(term) {
                    *q = *q * x + a;
                    *v = *v * x + factor * a;
                }
            } else {
                for (q, a) in q.iter_mut().zip(term) {
                    *q = *q * x + a;
                }
            }
        }
        let inverse = 1.0 / self.unit;
        v.iter_mut().for_each(|v| *v *= inverse);
    }

    /// Acceleration (m/s²) at the end, from the left, into a slice of n entries.
    pub(crate) fn acceleration_at_end(&self, out: &mut [f64]) {
        let (x, inverse) = (self.span(), 1.0 / (self.unit * self.unit));
        out.fill(0.0);
        for k in (2..self.terms).rev() {
            let factor = (k * (k - 1)) as f64 * inverse;
            for (out, a) in out.iter_mut().zip(self.term(k)) {
                *out = *out * x + factor * a;
            }
        }
    }

    /// Acceleration (m/s²) of degree of freedom `dof` at the start, from the right.
    pub(crate) fn acceleration_at_start(&self, dof: usize) -> f64 {
        if self.terms > 2 { 2.0 * self.term(2).get(dof).copied().unwrap_or(0.0) / (self.unit * self.unit) } else { 0.0 }
    }

    /// Force of wall `wall` on the structure at `t`, N, signed: 0 if it does not act.
    #[must_use]
    pub fn contact_force(&self, wall: usize, t: f64) -> f64 {
        let x = (t - self.start) / self.unit;
        let Some(acting) = self.of_wall(wall) else { return 0.0 };
        acting.keep(value(self.force(acting.slot), x))
    }

    /// Impulse of wall `wall` on the structure over [from, to] within the stretch, N s, in closed
    /// form.
    #[must_use]
    pub fn contact_impulse(&self, wall: usize, from: f64, to: f64) -> f64 {
        let Some(acting) = self.of_wall(wall) else { return 0.0 };
        let force = self.force(acting.slot);
        let (a, b) = ((from - self.start) / self.unit, (to - self.start) / self.unit);
        // ∫ xᵏ over [a, b] is (b − a) Σ aʲ bᵏ⁻ʲ/(k + 1), which avoids a difference of large powers.
        let (mut sum, mut mixed, mut power) = (0.0, 1.0, 1.0);
        for (k, c) in force.iter().enumerate() {
            sum += c * mixed / (k + 1) as f64;
            power *= b;
            mixed = a * mixed + power;
        }
        acting.keep(sum * (b - a) * self.unit)
    }

    /// Walls that act, each with the force polynomial in x of its row and its share of it.
    pub(crate) fn acting(&self) -> impl Iterator<Item = (usize, &[f64], f64)> {
        self.acting.iter().map(|a| (a.wall, self.force(a.slot), a.share))
    }

    /// Walls that act, each with its share of the force at its row.
    pub(crate) fn acting_shares(&self) -> impl Iterator<Item = (usize, f64)> {
        self.acting.iter().map(|a| (a.wall, a.share))
    }

    /// Walls that act, each with whether it is one that holds a row; the others are elastic walls
    /// that touch.
    pub(crate) fn acting_walls(&self) -> impl Iterator<Item = (usize, bool)> {
        self.acting.iter().map(|a| (a.wall, a.sign.is_some()))
    }

    /// The force polynomial of held row number `held`, N: positive where lower walls push.
    pub(crate) fn held_force(&self, held: usize) -> &[f64] {
        let touching = self.acting.iter().filter(|a| a.sign.is_none()).count();
        self.force(touching + held)
    }

    /// The displacement polynomial of row `row`, m; at a hole the gap to the wall of its row is (γ²
    /// − |w|²)/2γ, which is γ − |w| near the circle.
    #[inline]
    pub(crate) fn seen(&self, row: usize) -> &[f64] {
        let terms = if row < self.fixed { self.terms } else { self.squares };
        &self.seen[row * TERMS..row * TERMS + terms]
    }

    /// The polynomial in x of a weighted sum of the displacements of two rows, m.
    pub(crate) fn seen_along(&self, rows: [&Row; 2], weights: [f64; 2]) -> [f64; TERMS] {
        let mut out = [0.0; TERMS];
        for (k, c) in out.iter_mut().enumerate().take(self.terms) {
            let [a, b] = rows.map(|row| row.dot(self.term(k)));
            *c = weights[0] * a + weights[1] * b;
        }
        out
    }

    /// The value of a polynomial in x at `t`, m.
    pub(crate) fn value_of(&self, c: &[f64; TERMS], t: f64) -> f64 {
        value(&c[..self.terms], (t - self.start) / self.unit)
    }

    /// Its rate at `t`, m/s.
    pub(crate) fn rate_of(&self, c: &[f64; TERMS], t: f64) -> f64 {
        let x = (t - self.start) / self.unit;
        let rate = (1..self.terms).rev().fold(0.0, |sum, k| sum * x + k as f64 * c[k]);
        rate / self.unit
    }

    /// Number of terms of the motion.
    #[inline]
    pub(crate) fn terms(&self) -> usize {
        self.terms
    }

    /// The unit of x, s.
    #[inline]
    pub(crate) fn unit(&self) -> f64 {
        self.unit
    }

    /// The length that the stretch would have if no event ended or was expected to end it, s.
    pub(crate) fn longest(&self) -> f64 {
        self.longest
    }

    /// The end in x.
    pub(crate) fn span(&self) -> f64 {
        (self.end - self.start) / self.unit
    }

    /// aₖ, n entries.
    pub(crate) fn term(&self, k: usize) -> &[f64] {
        &self.motion[k * self.n..(k + 1) * self.n]
    }

    /// Cuts it off at `end` (s).
    pub(crate) fn cut(&mut self, end: f64) {
        self.end = end;
    }

    fn of_wall(&self, wall: usize) -> Option<&Acting> {
        self.acting.binary_search_by_key(&wall, |acting| acting.wall).ok().and_then(|at| self.acting.get(at))
    }

    #[inline]
    fn force(&self, slot: usize) -> &[f64] {
        &self.forces[slot * TERMS..slot * TERMS + self.terms]
    }
}

impl Acting {
    #[inline]
    fn keep(&self, force: f64) -> f64 {
        let force = self.share * force;
        self.sign.map_or(force, |sign| sign * (sign * force).max(0.0))
    }
}

/// Σ cₖ xᵏ.
#[inline]
pub(crate) fn value(c: &[f64], x: f64) -> f64 {
    c.iter().rev().fold(0.0, |sum, c| sum * x + c)
}
