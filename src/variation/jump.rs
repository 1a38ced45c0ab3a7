//! Saltation matrices of several degrees of freedom, without writing them out.
//!
//! Rows J receive an impulse at an instant: rows i that were in flight, struck at the speed vᵢ with
//! restitution eᵢ (0 where they come to rest), and rows held before, which only transmit it. With D
//! = M⁻¹Gᵀ(G M⁻¹Gᵀ)⁻¹ over J and dᵢ its columns,
//!
//! δq⁺ = δq − Σ (1 + eᵢ) dᵢ Gᵢδq,   δq̇⁺ = δq̇ − D (1 + e) G δq̇ + Σ wᵢ Gᵢδq,
//!
//! where wᵢ = (a⁺ − R a⁻)/vᵢ. With the accelerations inserted, and Q the projection onto the
//! velocities that the rows held after the instant allow,
//!
//! wᵢ = (1 + eᵢ) dᵢ Gᵢa⁻/vᵢ − Q M⁻¹Gₕᵀ rₕ/vᵢ + Q M⁻¹((1 + eᵢ) C dᵢ + Gₐᵀ Δrₐ/vᵢ).
//!
//! The first term is left out for a row that comes to rest (Q removes it). In the second, rₕ are
//! the reactions of rows that the impact releases. In the last, Δrₐ is the change of the force of
//! an elastic wall by the jump of the velocity: (1 + eᵢ) c_a Gₐdᵢ vᵢ while it pushes. So the matrix
//! of coming to rest does not contain the speed, and that of an impact acts on a change by a few
//! products of vectors.

use super::key_terms::{Instant, KeyTerms};
use crate::flow::{HeldRows, Propagator, held};

/// A row struck in flight.
#[derive(Debug, Clone, Copy)]
pub(super) struct Struck {
    pub row: usize,
    /// e, 0 where the row comes to rest.
    pub restitution: f64,
    /// True where it comes to rest, whatever e is.
    pub rests: bool,
    /// v = G q̇⁻, m/s, signed.
    pub speed: f64,
    /// True for a row that touched before, and is struck by a blow.
    pub held: bool,
    /// G a⁻/v, 1/s; 0 where the row comes to rest.
    pub pull: f64,
}

impl Struck {
    /// A row that comes to rest without an impact.
    pub fn resting(row: usize) -> Self {
        Self { row, restitution: 0.0, rests: true, speed: 0.0, held: true, pull: 0.0 }
    }
}

/// The saltation matrix of one instant.
#[derive(Debug)]
pub(super) struct Jump {
    struck: Vec<Struck>,
    /// The rows J.
    rows: HeldRows,
    /// (1 + eᵢ) dᵢ and wᵢ of each struck row, n entries each.
    shifts: Vec<f64>,
    kicks: Vec<f64>,
    /// For each row, its displacement by a change before the event, and the velocity required of it
    /// afterwards.
    seen: Vec<f64>,
    wanted: Vec<f64>,
    zero: Vec<f64>,
    work: Vec<f64>,
}

/// Two rows are coupled if an impulse on one moves the other by more than this share of its own
/// motion.
const APART: f64 = 1e-12;

impl Jump {
    /// A matrix with memory for a structure of `n` degrees of freedom and `rows` rows.
    pub fn with_room(n: usize, rows: usize) -> Self {
        Self {
            struck: Vec::with_capacity(rows),
            rows: HeldRows::with_room(rows),
            shifts: Vec::with_capacity(n),
            kicks: Vec::with_capacity(n),
            seen: vec![0.0; rows],
            wanted: vec![0.0; rows],
            zero: vec![0.0; n],
            work: vec![0.0; n],
        }
    }

    /// Begins the matrix of an instant at which the rows of `struck` are struck and the rows
    /// `passing` transmit impulses.
    pub fn begin(&mut self, flow: &mut Propagator, struck: &[Struck], passing: impl Iterator<Item = usize> + Clone) {
        self.struck.clear();
        self.struck.extend_from_slice(struck);
        let Self { struck, rows, shifts, work, .. } = self;
        rows.set(&flow.body, struck.iter().map(|s| s.row).chain(passing).map(held), std::iter::empty());
        shifts.clear();
        for s in &*struck {
            work.fill(0.0);
            rows.change(&flow.body, work, &mut flow.scratch, |held| if held.row == s.row { 1.0 } else { 0.0 });
            shifts.extend(work.iter().map(|d| (1.0 + s.restitution) * d));
        }
    }

    /// True if two of the struck rows are coupled: an impulse on one moves the other, or changes
    /// the damping force on it.
    pub fn is_coupled(&mut self, flow: &Propagator) -> bool {
        let Self { struck, rows, zero, work, .. } = self;
        if struck.len() > 1 && rows.rows().len() > struck.len() {
            return true;
        }
        let body = &flow.body;
        let mut drag = |of: usize, on: usize| {
            let mut y = vec![0.0; zero.len()];
            body.add_column(of, 1.0, &mut y);
            work.fill(0.0);
            body.add_force(zero, &y, work);
            body.answer(on, work)
        };
        let mut feels = |i: usize, j: usize| {
            let large = |a: f64, b: f64| APART * (a * b).abs().sqrt();
            body.delassus(i, j).abs() > large(body.delassus(i, i), body.delassus(j, j))
                || drag(i, j).abs() > large(drag(i, i), drag(j, j))
        };
        (1..struck.len()).any(|k| (0..k).any(|j| feels(struck[k].row, struck[j].row)))
    }

    /// Computes the wᵢ. `after` are the rows held after the instant; `push` adds Gₐᵀ Δrₐ/vᵢ − Gₕᵀ
    /// rₕ/vᵢ of a struck row to a force, given its (1 + eᵢ) dᵢ.
    pub fn kick(
        &mut self,
        flow: &mut Propagator,
        after: &HeldRows,
        mut push: impl FnMut(&Propagator, &Struck, &[f64], &mut [f64]),
    ) {
        let Self { struck, shifts, kicks, zero, work, .. } = self;
        kicks.clear();
        for (s, shift) in struck.iter().zip(shifts.chunks_exact(zero.len())) {
            work.fill(0.0);
            flow.body.add_force(zero, shift, work);
            // The product above was −C (1 + e) d.
            work.iter_mut().for_each(|f| *f = -*f);
            push(flow, s, shift, work);
            flow.body.solve(work);
            after.stop(&flow.body, work, &mut flow.scratch);
            work.iter_mut().zip(shift).for_each(|(w, d)| *w += s.pull * d);
            kicks.extend_from_slice(work);
        }
    }

    /// Applies the matrix to each of `columns`, changes of 2n entries. The first columns are those
    /// of `keys`, whose own terms at the instant `at` are added.
    pub fn apply_to(&mut self, flow: &mut Propagator, columns: &mut [f64], keys: &[KeyTerms], at: &Instant<'_>) {
        let n = self.zero.len();
        for (column, change) in columns.chunks_exact_mut(2 * n).enumerate() {
            let (q, v) = change.split_at_mut(n);
            self.apply(flow, (q, v), keys.get(column), at);
        }
    }

    /// With the terms of a key: Gδq + δG q − δg takes the place of Gδq, and the velocities are
    /// those for which M(δq̇⁺ − δq̇⁻) = Gᵀδp + δGᵀp − δM(q̇⁺ − q̇⁻) and G δq̇⁺ = −δG q̇⁺ − e(G δq̇⁻
    /// + δG q̇⁻) − δe G q̇⁻.
    fn apply(
        &mut self,
        flow: &mut Propagator,
        (q, v): (&mut [f64], &mut [f64]),
        key: Option<&KeyTerms>,
        at: &Instant<'_>,
    ) {
        let n = q.len();
        for at_row in 0..self.rows.rows().len() {
            let Some(row) = self.rows.rows().get(at_row).map(|held| held.row) else { continue };
            self.seen[row] = beyond(flow, row, q, key, at);
            self.wanted[row] = self.wanted(flow, row, v, key, at);
        }
        if let Some(key) = key {
            key.add_to_velocity(flow, at, v);
        }
        let Self { struck, rows, shifts, kicks, seen, wanted, .. } = self;
        rows.change(&flow.body, v, &mut flow.scratch, |held| wanted[held.row]);
        for (s, (shift, kick)) in struck.iter().zip(shifts.chunks_exact(n).zip(kicks.chunks_exact(n))) {
            let by = seen[s.row];
            q.iter_mut().zip(shift).for_each(|(q, d)| *q -= by * d);
            v.iter_mut().zip(kick).for_each(|(v, w)| *v += by * w);
        }
    }

    /// G δq̇⁺ of a row, given δq̇⁻.
    fn wanted(&self, flow: &Propagator, row: usize, v: &[f64], key: Option<&KeyTerms>, at: &Instant<'_>) -> f64 {
        let wall = at.wall_of.get(row).copied().unwrap_or(0);
        let (before, after) = key.map_or((0.0, 0.0), |key| (key.along(wall, at.before), key.along(wall, at.after)));
        let Some(s) = self.struck.iter().find(|s| s.row == row) else { return -after };
        let own = if s.rests { 0.0 } else { key.map_or(0.0, |key| key.restitution(wall)) };
        -s.restitution * (flow.body.rows.dot(row, v) + before) - own * flow.body.rows.dot(row, at.before) - after
    }

    /// By how much the impulse of each row (N s, one entry each) changes by the change (`q`, `v`)
    /// before the instant and a key, where the instant moves with them.
    pub fn impulses(
        &self,
        flow: &mut Propagator,
        (q, v): (&[f64], &[f64]),
        key: &KeyTerms,
        at: &Instant<'_>,
    ) -> Vec<f64> {
        let mut pushed = v.to_vec();
        key.add_to_velocity(flow, at, &mut pushed);
        let missing = |flow: &Propagator, row: usize| {
            // The instant is that of the row itself, or of the one that is struck.
            let s = self.struck.iter().find(|s| s.row == row).or(self.struck.first());
            let later = s.map_or(0.0, |s| s.moves_by(beyond(flow, s.row, q, Some(key), at)));
            let moved = |x: &[f64]| x.iter().zip(at.acceleration).map(|(x, a)| x + later * a).collect::<Vec<f64>>();
            self.wanted(flow, row, &moved(v), Some(key), at) - flow.body.rows.dot(row, &moved(&pushed))
        };
        let independent: Vec<f64> = self.rows.independent().iter().map(|held| missing(flow, held.row)).collect();
        let mut changes = vec![0.0; self.seen.len()];
        for (i, held) in self.rows.rows().iter().enumerate() {
            if let Some(change) = changes.get_mut(held.row) {
                *change = self.rows.inverse(i).iter().zip(&independent).map(|(w, b)| w * b).sum();
            }
        }
        changes
    }
}

impl Jump {
    /// By how much the velocity just after the instant (m/s, n entries) changes by the change `v`
    /// of that before it and a key, where the instant comes `later` (s).
    pub fn velocity_after(
        &self,
        flow: &mut Propagator,
        (v, later): (&[f64], f64),
        key: &KeyTerms,
        at: &Instant<'_>,
    ) -> Vec<f64> {
        let mut moved: Vec<f64> = v.iter().zip(at.acceleration).map(|(v, a)| v + later * a).collect();
        let mut wanted = vec![0.0; self.seen.len()];
        for held in self.rows.rows() {
            wanted[held.row] = self.wanted(flow, held.row, &moved, Some(key), at);
        }
        key.add_to_velocity(flow, at, &mut moved);
        self.rows.change(&flow.body, &mut moved, &mut flow.scratch, |held| wanted[held.row]);
        moved
    }
}

impl Struck {
    /// δt, s, of the impact: `beyond` is G δq + δG q − δg. A row without speed is struck by a blow,
    /// whose instant does not move.
    pub fn moves_by(&self, beyond: f64) -> f64 {
        if self.speed == 0.0 || self.held { 0.0 } else { -beyond / self.speed }
    }
}

/// G δq + δG q − δg of a row, m.
fn beyond(flow: &Propagator, row: usize, q: &[f64], key: Option<&KeyTerms>, at: &Instant<'_>) -> f64 {
    let wall = at.wall_of.get(row).copied().unwrap_or(0);
    flow.body.rows.dot(row, q) + key.map_or(0.0, |key| key.offset(wall, at.q))
}
