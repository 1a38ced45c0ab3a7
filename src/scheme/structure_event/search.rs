//! The search for the first event of a stretch.

use super::StructureEvent;
use super::closed_row::Cause;
use super::root::highest;
use super::rows::{FirstRoot, LeadingZeros, Rounding, RowPolynomial, SIGNS};
use crate::flow::TERMS;
use crate::scheme::exact::{Phase, noise};

/// An event: when, in the stretch's x, and which.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Hit {
    pub x: f64,
    pub cause: Cause,
}

/// A gap above this share of the sizes of the row's motion and of its wall's position exceeds
/// rounding, however its terms cancel.
const NEAR: f64 = 1e-9;

impl StructureEvent {
    /// The first event of the stretch, `None` if there is none.
    pub(super) fn search(&mut self) -> Option<Hit> {
        let mut end = self.series.span();
        let mut hit = None;
        for row in 0..self.places.len() {
            let place = self.places[row];
            let seen = self.series.seen(row);
            let (w, reach) = (seen[0], seen[1..].iter().map(|c| c.abs()).sum::<f64>());
            self.places[row].travel = place.travel.max(reach);
            if place.held != 0.0 {
                self.search_hold(row, &mut end, &mut hit);
            }
            for (side, sign) in SIGNS.into_iter().enumerate() {
                // Apart from rounding, a gap wider than all the row can move stays open.
                if place.gap(side, w) > reach || place.held == sign || place.bound[side].is_infinite() {
                    continue;
                }
                if place.held != 0.0 && place.bound[0] == place.bound[1] {
                    continue;
                }
                self.search_gap(row, side, reach, &mut end, &mut hit);
            }
        }
        for wall in 0..self.barriers.len() {
            if !matches!(self.barriers[wall].phase, Phase::Rigid(_)) {
                self.search_elastic(wall, &mut end, &mut hit);
            }
        }
        hit
    }

    fn search_gap(&mut self, row: usize, side: usize, reach: f64, end: &mut f64, hit: &mut Option<Hit>) {
        let place = self.places[row];
        let mut watched = RowPolynomial { c: [0.0; TERMS], terms: 0 };
        let seen = self.series.seen(row);
        watched.terms = seen.len();
        for (c, s) in watched.c.iter_mut().zip(seen) {
            *c = SIGNS[side] * s;
        }
        watched.c[0] = place.gap(side, seen[0]);
        let near = watched.c[0] <= NEAR * (reach + place.bound[side].abs() + seen[0].abs());
        if near || place.gap_zeros[side].is_some() {
            self.measure();
        }
        let rounding = || self.rounding(row, place.bound[side]).doubted(self.doubt);
        let found = watched.first(place.gap_zeros[side], rounding, near, false, *end);
        self.places[row].drifts |= matches!(found, FirstRoot::Now | FirstRoot::Below(_));
        note(found, Cause::Gap(row, side), end, hit);
    }

    fn search_hold(&mut self, row: usize, end: &mut f64, hit: &mut Option<Hit>) {
        let Some(k) = self.hold.rows().iter().position(|held| held.row == row) else { return };
        let place = self.places[row];
        if place.force_zeros == Some(LeadingZeros::All) {
            return;
        }
        let mut watched = RowPolynomial { c: [0.0; TERMS], terms: 0 };
        let force = self.series.held_force(k);
        // The last two coefficients of a force are not known, and are left out.
        watched.terms = force.len() - 2;
        for (c, f) in watched.c.iter_mut().zip(force) {
            *c = place.held * f;
        }
        self.measure();
        let terms = watched.c[1..watched.terms].iter().map(|c| c.abs()).sum();
        let rounding = || Rounding::new(self.force_noises(k), terms).doubted(self.doubt);
        let found = watched.first(place.force_zeros, rounding, true, true, *end);
        note(found, Cause::Release(row), end, hit);
    }

    fn search_elastic(&mut self, wall: usize, end: &mut f64, hit: &mut Option<Hit>) {
        let b = &self.barriers[wall];
        let (sign, stiffness, damping, position) = (b.sign, b.stiffness, b.damping, b.position);
        let (phase, changed) = (b.phase, b.changed == self.series.start());
        let row = self.body.row_of[wall];
        let seen = self.series.seen(row);
        let reach = seen[1..].iter().map(|c| c.abs()).sum::<f64>();
        if phase == Phase::Outside && b.gap(seen[0]) > reach {
            return;
        }
        let (terms, unit) = (seen.len(), self.series.unit());
        let mut gap = RowPolynomial { c: [0.0; TERMS], terms };
        for (c, s) in gap.c.iter_mut().zip(seen) {
            *c = sign * s;
        }
        gap.c[0] = b.gap(seen[0]);
        // k_a s + c_a ṡ, without its last coefficient, which needs a term beyond the series.
        let mut sum = RowPolynomial { c: [0.0; TERMS], terms: if damping > 0.0 { terms - 1 } else { terms } };
        for k in 0..sum.terms {
            let next = if k + 1 < terms { gap.c[k + 1] } else { 0.0 };
            sum.c[k] = -stiffness * gap.c[k] - damping * (k + 1) as f64 * next / unit;
        }
        self.measure();
        let noises = self.noises(row, position);
        let travel = self.travel(row, 1.0);
        let of_sum = of_sum(noises, travel, (stiffness, damping, unit));
        let noises = Rounding::new(noises, travel);
        let looks: [Option<(RowPolynomial, f64, Rounding)>; 2] = match phase {
            Phase::Rigid(_) => [None, None],
            Phase::Outside => [Some((gap, 1.0, noises)), None],
            Phase::Touching => [Some((sum, 1.0, of_sum)), None],
            Phase::Detached => [Some((sum, -1.0, of_sum)), Some((gap, -1.0, noises))],
        };
        for (mut watched, sign, rounding) in looks.into_iter().flatten() {
            watched.c.iter_mut().for_each(|c| *c *= sign);
            if changed {
                // It was 0 to the rounding of the stretch before, which may be coarser than that of
                // this stretch.
                watched.c[0] = watched.c[0].max(0.0);
            }
            note(watched.first(None, || rounding, true, false, *end), Cause::Elastic(wall), end, hit);
        }
    }

    /// Rounding errors of the first coefficients of a row's displacement at the start, m: of
    /// displacement, velocity, acceleration and its rate.
    pub(super) fn noises(&self, row: usize, position: f64) -> [f64; 4] {
        let unit = self.series.unit();
        let answer = |x: &[f64]| self.body.answer_size(row, x);
        let second = noise(answer(&self.sizes.force[0])) * unit * unit / 2.0;
        if self.body.round(row).is_some() {
            return self.round_noises(row, [second, noise(answer(&self.sizes.force[1])) * unit * unit * unit / 6.0]);
        }
        [
            self.resolution(row, position),
            // Where forces balance, the velocity has the rounding error of their terms.
            noise(self.body.size(row, self.series.term(1))) + 2.0 * second,
            second,
            noise(answer(&self.sizes.force[1])) * unit * unit * unit / 6.0,
        ]
    }

    /// Rounding errors of the gap of a row at a wall, m. The sizes must be measured.
    pub(super) fn rounding(&self, row: usize, position: f64) -> Rounding {
        self.rounding_until(row, position, 1.0)
    }

    /// The same over the beginning of the stretch, up to `x`.
    pub(super) fn rounding_until(&self, row: usize, position: f64, x: f64) -> Rounding {
        let mut noises = self.noises(row, position);
        let mut power = 1.0;
        for noise in &mut noises {
            *noise *= power;
            power *= x;
        }
        Rounding::new(noises, self.travel(row, x))
    }

    /// Σ of the sizes of the terms of a row's displacement after the first, m, up to `x`.
    fn travel(&self, row: usize, x: f64) -> f64 {
        if let Some(round) = self.body.round(row) {
            return self.round_travel(round, x);
        }
        let terms = (1..self.series.seen(row).len()).rev();
        terms.fold(0.0, |sum, k| x * (sum + self.body.size(row, self.series.term(k))))
    }

    /// Rounding errors of the first coefficients of the force on held row number `k`, N.
    fn force_noises(&self, k: usize) -> [f64; 4] {
        let unit = self.series.unit();
        let mut out = [0.0; 4];
        for (held, w) in self.hold.independent().iter().zip(self.hold.inverse(k)) {
            for (order, out) in out.iter_mut().take(2).enumerate() {
                *out += noise(w.abs() * self.body.answer_size(held.row, &self.sizes.force[order]));
            }
        }
        if !self.body.rounds.is_empty() {
            self.add_bend_noises(k, &mut out);
        }
        // For the higher ones, the second times powers of the fastest rate.
        let fast = self.series.rate() * unit;
        [out[0], out[1] * unit, out[1] * unit * fast, out[1] * unit * fast * fast]
    }

    /// Records the pressures of the stretch up to `x` in the open episodes.
    pub(super) fn note_pressures(&mut self, x: f64) {
        let Self { series, barriers, .. } = self;
        for (wall, force, share) in series.acting() {
            if let Some(b) = barriers.get_mut(wall) {
                let peak = share * highest(force, b.sign, x);
                b.note(peak);
            }
        }
    }
}

/// Rounding errors of k_a s + c_a ṡ, N, from those of s and the sizes of its further terms, m, with
/// k_a (N/m), c_a (N s/m) and the unit of the series (s).
fn of_sum(noises: [f64; 4], travel: f64, (stiffness, damping, unit): (f64, f64, f64)) -> Rounding {
    let damping = damping / unit;
    let of = std::array::from_fn(|k| {
        let next = noises.get(k + 1).copied().unwrap_or(noises[3]);
        stiffness * noises[k] + damping * (k + 1) as f64 * next
    });
    Rounding::new(of, (stiffness + damping) * travel)
}

fn note(found: FirstRoot, cause: Cause, end: &mut f64, hit: &mut Option<Hit>) {
    let x = match found {
        FirstRoot::Now => 0.0,
        FirstRoot::Root(x) | FirstRoot::Below(x) => x,
        FirstRoot::Nothing => return,
    };
    if hit.is_none() || x < *end {
        *end = x;
        *hit = Some(Hit { x, cause });
    }
}

#[cfg(test)]
mod tests;
