//! All loads on one degree of freedom, sorted by kind.

use super::function::TimeFunction;
use super::load::{Load, LoadKind};
use super::table::Table;
use crate::elementary::{TOGETHER, sines};
use crate::order::sort_by_number;
use std::f64::consts::TAU;

/// One sine of a [`Forcing`]: amplitude · sin(ω t + phase).
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Harmonic {
    /// Amplitude, N.
    pub amplitude: f64,
    /// Circular frequency ω, rad/s.
    pub omega: f64,
    /// Phase, rad.
    pub phase: f64,
}

/// All loads on one degree of freedom, sorted by kind, so that a step sums them without branching
/// on kinds.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Forcing {
    /// Sum of the constant forces, N.
    pub constant: f64,
    /// The sines.
    pub harmonics: Vec<Harmonic>,
    /// The tables.
    pub tables: Vec<Table>,
    /// The functions and their weights.
    pub functions: Vec<(f64, TimeFunction)>,
    /// The blows (impulsive loads; time s, impulse N s), in order of time.
    pub impulses: Vec<(f64, f64)>,
}

impl Forcing {
    /// The loads that act on degree of freedom `dof`, weighted by their rows.
    #[must_use]
    pub fn on(dof: usize, loads: &[Load]) -> Self {
        let mut forcing = Self::default();
        for load in loads {
            let weight: f64 = load.at.entries().iter().filter(|&&(i, _)| i == dof).map(|&(_, w)| w).sum();
            if weight == 0.0 {
                continue;
            }
            match &load.kind {
                LoadKind::Constant { force } => forcing.constant += weight * force,
                LoadKind::Harmonic { amplitude, frequency, phase } => forcing.harmonics.push(Harmonic {
                    amplitude: weight * amplitude,
                    omega: TAU * frequency,
                    phase: *phase,
                }),
                LoadKind::Impulse { impulse, time } => forcing.impulses.push((*time, weight * impulse)),
                LoadKind::Table(table) => {
                    forcing.tables.push(table.scaled(weight));
                }
                LoadKind::Function(function) => forcing.functions.push((weight, function.clone())),
            }
        }
        sort_by_number(&mut forcing.impulses, |a| a.0);
        forcing
    }

    /// Force at `t`, N, without the impulses; right-continuous where a table begins or ends.
    #[inline]
    #[must_use]
    pub fn force(&self, t: f64) -> f64 {
        self.force_by(t, |table| table.piece(t).0)
    }

    /// The same with the force of each table as `of_table` gives it.
    #[inline(always)]
    pub(super) fn force_by(&self, t: f64, of_table: impl FnMut(&Table) -> f64) -> f64 {
        let mut f = self.constant;
        for h in &self.harmonics {
            f += h.amplitude * (h.omega * t + h.phase).sin();
        }
        if self.tables.is_empty() && self.functions.is_empty() { f } else { f + self.irregular_by(t, of_table) }
    }

    /// Writes the forces at several `times`, N, as [`Forcing::force`] gives them to rounding.
    pub(crate) fn forces(&self, times: &[f64], out: &mut [f64]) {
        for (force, &t) in out.iter_mut().zip(times) {
            let others = !(self.tables.is_empty() && self.functions.is_empty());
            *force = self.constant + if others { self.irregular(t) } else { 0.0 };
        }
        let (mut sin, mut cos) = ([0.0; TOGETHER], [0.0; TOGETHER]);
        for h in &self.harmonics {
            for (times, out) in times.chunks(TOGETHER).zip(out.chunks_mut(TOGETHER)) {
                sines((h.omega, h.phase), times, &mut sin, &mut cos);
                out.iter_mut().zip(&sin).for_each(|(force, sin)| *force += h.amplitude * sin);
            }
        }
    }

    /// Force of tables and functions at `t`, N.
    pub(crate) fn irregular(&self, t: f64) -> f64 {
        self.irregular_by(t, |table| table.piece(t).0)
    }

    #[inline(always)]
    fn irregular_by(&self, t: f64, mut of_table: impl FnMut(&Table) -> f64) -> f64 {
        let mut tables = 0.0;
        // No sum of an iterator, which would be compiled by itself.
        for table in &self.tables {
            tables += of_table(table);
        }
        tables + self.functions.iter().map(|(weight, function)| weight * function.at(t)).sum::<f64>()
    }

    /// A bound on the rate of change of the force between the jumps of tables, N/s; functions are
    /// not included.
    pub(crate) fn steepest(&self) -> f64 {
        let waves: f64 = self.harmonics.iter().map(|h| h.amplitude.abs() * h.omega).sum();
        let rise = |t: &[f64], f: &[f64]| ((f[1] - f[0]) / (t[1] - t[0])).abs();
        let pieces = |table: &Table| {
            let pairs = table.time().windows(2).zip(table.force().windows(2));
            pairs.map(|(t, f)| rise(t, f)).fold(0.0, f64::max)
        };
        waves + self.tables.iter().map(pieces).sum::<f64>()
    }

    /// Sum of the impulses in the half-open interval (from, to], N s.
    #[inline]
    #[must_use]
    pub fn impulse(&self, from: f64, to: f64) -> f64 {
        if self.impulses.is_empty() {
            return 0.0;
        }
        self.impulses.iter().filter(|&&(t, _)| t > from && t <= to).map(|&(_, p)| p).sum()
    }

    /// Moment of the impulses in (from, to] about `about` (s), Σ (about − t_b) J_b, N s²: divided
    /// by the mass, the displacement that they give a free body until then.
    pub(crate) fn impulse_moment(&self, from: f64, to: f64, about: f64) -> f64 {
        self.impulses.iter().filter(|&&(t, _)| t > from && t <= to).map(|&(t, p)| (about - t) * p).sum()
    }

    /// Sum of the impulses within half a step `h` (s) of the instant `step` · h, N s: each impulse
    /// after t = 0 belongs to exactly one step.
    #[inline]
    pub(crate) fn impulse_about(&self, step: u64, h: f64) -> f64 {
        self.impulse_about_since(0.0, step, h)
    }

    /// The same for the impulses after the time `since` (s) only: where a motion was set to a new
    /// state, that state includes the earlier ones.
    #[inline]
    pub(crate) fn impulse_about_since(&self, since: f64, step: u64, h: f64) -> f64 {
        // The limit between two steps is computed as the same product for both: t − h/2 of one and
        // t + h/2 of the other would differ in the last digit.
        let edge = |half_steps: f64| (half_steps * h).max(since);
        self.impulse(edge(step as f64 - 0.5), edge(step as f64 + 0.5))
    }

    /// Sum of the impulses at t = 0, N s; the run starts from the state after them.
    pub(crate) fn initial_impulse(&self) -> f64 {
        self.impulses.iter().filter(|&&(t, _)| t == 0.0).map(|&(_, p)| p).sum()
    }
}
