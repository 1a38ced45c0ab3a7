//! The derivatives of loads, and their series.
//!
//! A load ψ(t) through the row g changes by gᵀ δψ + δgᵀ ψ. For a sine A sin θ with θ = ω t + φ,
//!
//! δψ = δA sin θ + A (t δω + δφ) cos θ.

use super::stencil::Stencil;
use crate::elementary::sin_cos;
use crate::flow::INVERSE;
use crate::scene::{Load, LoadKind, Row, Scene, Table};
use std::f64::consts::TAU;

/// The derivative of a load with respect to a key.
#[derive(Debug, Clone)]
pub(in crate::variation) struct LoadChange {
    /// The load itself, and its index in the scene.
    index: usize,
    load: Load,
    row: Row,
    kind: KindChange,
}

/// The derivative of its function of time, per unit of the key.
#[derive(Debug, Clone)]
enum KindChange {
    /// N.
    Constant(f64),
    /// Of amplitude (N), ω (rad/s) and phase (rad).
    Harmonic([f64; 3]),
    /// Of the impulse (N s) and the time (s) of a blow.
    Blow([f64; 2]),
    /// Of the forces of a table, N.
    Table(Option<Table>),
}

/// True for loads that differ in numbers only; tables at the same times.
pub(super) fn is_alike(a: &Load, b: &Load) -> bool {
    match (&a.kind, &b.kind) {
        (LoadKind::Table(a), LoadKind::Table(b)) => a.time() == b.time(),
        (LoadKind::Function(_), _) | (_, LoadKind::Function(_)) => false,
        (a, b) => std::mem::discriminant(a) == std::mem::discriminant(b),
    }
}

impl LoadChange {
    /// The derivative of load number `index`; `None` where it is 0.
    pub(super) fn new(stencil: &mut Stencil, index: usize) -> Option<Self> {
        let load = stencil.base.loads.get(index)?.clone();
        let row = stencil.row(|scene| scene.loads.get(index).map(|load| &load.at));
        let mut of = |part: fn(&LoadKind) -> f64| {
            stencil.derivative(|scene| scene.loads.get(index).map_or(0.0, |load| part(&load.kind)))
        };
        let kind = match &load.kind {
            LoadKind::Constant { .. } => KindChange::Constant(of(|kind| match kind {
                LoadKind::Constant { force } => *force,
                _ => 0.0,
            })),
            LoadKind::Harmonic { .. } => {
                KindChange::Harmonic([of(|kind| sine(kind)[0]), of(|kind| sine(kind)[1]), of(|kind| sine(kind)[2])])
            }
            LoadKind::Impulse { .. } => KindChange::Blow([of(|kind| blow(kind)[0]), of(|kind| blow(kind)[1])]),
            LoadKind::Table(table) => KindChange::Table(table_change(stencil, index, table)),
            LoadKind::Function(_) => return None,
        };
        let zero = match &kind {
            KindChange::Constant(x) => *x == 0.0,
            KindChange::Harmonic(x) => *x == [0.0; 3],
            KindChange::Blow(x) => *x == [0.0; 2],
            KindChange::Table(x) => x.is_none(),
        };
        (!zero || !row.entries().is_empty()).then_some(Self { index, load, row, kind })
    }

    /// The derivative of ln ω of the sine that is load number `index`; 0 if this is another load.
    pub fn hastening(&self, index: usize) -> f64 {
        match self.kind {
            KindChange::Harmonic([_, omega, _]) if self.index == index => omega / sine(&self.load.kind)[1],
            _ => 0.0,
        }
    }

    /// Adds the derivative of the momentum that a blow at `time` (s) gives, N s, to `out`, n
    /// entries.
    pub fn add_blow(&self, time: f64, out: &mut [f64]) {
        let (LoadKind::Impulse { impulse, time: own }, KindChange::Blow([change, _])) = (&self.load.kind, &self.kind)
        else {
            return;
        };
        if *own == time {
            self.load.at.add_transposed(*change, out);
            self.row.add_transposed(*impulse, out);
        }
    }

    /// By how much the instant of this blow moves, s, if it is one at `time` (s).
    pub fn blow_moves(&self, time: f64) -> f64 {
        match self.kind {
            KindChange::Blow([_, later]) if blow(&self.load.kind)[1] == time => later,
            _ => 0.0,
        }
    }

    /// Adds the momentum that this blow gives, N s, to `out`, n entries, `scale` times.
    pub fn add_own_blow(&self, scale: f64, out: &mut [f64]) {
        self.load.at.add_transposed(scale * blow(&self.load.kind)[0], out);
    }
}

/// Amplitude, ω and phase.
fn sine(kind: &LoadKind) -> [f64; 3] {
    match kind {
        LoadKind::Harmonic { amplitude, frequency, phase } => [*amplitude, TAU * frequency, *phase],
        _ => [0.0; 3],
    }
}

/// Impulse and time.
fn blow(kind: &LoadKind) -> [f64; 2] {
    match kind {
        LoadKind::Impulse { impulse, time } => [*impulse, *time],
        _ => [0.0; 2],
    }
}

fn table_change(stencil: &mut Stencil, index: usize, table: &Table) -> Option<Table> {
    let force = |scene: &Scene, i: usize| match scene.loads.get(index).map(|load| &load.kind) {
        Some(LoadKind::Table(table)) => table.force().get(i).copied().unwrap_or(0.0),
        _ => 0.0,
    };
    let size = table.force().iter().fold(0.0, |most: f64, f| most.max(f.abs()));
    let rows = 0..table.time().len();
    let changes: Vec<f64> = rows.map(|i| stencil.derivative_among(size, |scene| force(scene, i))).collect();
    let any = changes.iter().any(|&change| change != 0.0);
    Table::new(table.time().to_vec(), changes).ok().filter(|_| any)
}

/// The series of changed loads over a stretch: of δψ and ψ, for each load that changes.
#[derive(Debug, Clone, Default)]
pub(in crate::variation) struct LoadTerms {
    terms: usize,
    /// Two polynomials for each load, N.
    values: Vec<[f64; 2]>,
}

impl LoadTerms {
    /// Computes `terms` terms of the series of `loads` from `start` (s) on, in units of `unit` (s).
    pub fn fill(&mut self, loads: &[LoadChange], terms: usize, start: f64, unit: f64) {
        self.terms = terms;
        self.values.clear();
        self.values.resize(terms * loads.len(), [0.0; 2]);
        for (load, values) in loads.iter().zip(self.values.chunks_exact_mut(terms.max(1))) {
            match (&load.kind, &load.load.kind) {
                (KindChange::Constant(change), LoadKind::Constant { force }) => {
                    if let Some(first) = values.first_mut() {
                        *first = [*change, *force];
                    }
                }
                (KindChange::Harmonic(change), kind) => fill_sine(*change, sine(kind), (start, unit), values),
                (KindChange::Table(change), LoadKind::Table(table)) => {
                    let changed = change.as_ref().map_or((0.0, 0.0), |change| change.piece(start));
                    let own = table.piece(start);
                    let pieces = [[changed.0, own.0], [changed.1 * unit, own.1 * unit]];
                    values.iter_mut().zip(pieces).for_each(|(value, piece)| *value = piece);
                }
                _ => {}
            }
        }
    }

    /// Adds term `k` of the change of the loads to `force`, N.
    pub fn add(&self, loads: &[LoadChange], k: usize, force: &mut [f64]) {
        for (load, values) in loads.iter().zip(self.values.chunks_exact(self.terms.max(1))) {
            let Some(&[change, own]) = values.get(k) else { continue };
            if change != 0.0 {
                load.load.at.add_transposed(change, force);
            }
            if own != 0.0 {
                load.row.add_transposed(own, force);
            }
        }
    }
}

impl LoadTerms {
    /// Adds the change of the loads on one degree of freedom to the polynomial `force`, N.
    pub fn add_to_one(&self, loads: &[LoadChange], force: &mut [f64]) {
        for (load, values) in loads.iter().zip(self.values.chunks_exact(self.terms.max(1))) {
            let (at, row) = (load.load.at.dot(&[1.0]), load.row.dot(&[1.0]));
            force.iter_mut().zip(values).for_each(|(force, [change, own])| *force += at * change + row * own);
        }
    }
}

/// The terms of a sine and of its change. The factor t of δω is start + unit x, so that its term k
/// is start times term k of the cosine and unit times term k − 1.
fn fill_sine(
    change: [f64; 3],
    [amplitude, omega, phase]: [f64; 3],
    (start, unit): (f64, f64),
    values: &mut [[f64; 2]],
) {
    let (sin, cos) = sin_cos(omega * start + phase);
    let (sines, cosines) = ([sin, cos, -sin, -cos], [cos, -sin, -cos, sin]);
    let (mut power, mut before) = (1.0, 0.0);
    for (k, value) in values.iter_mut().enumerate() {
        if k > 0 {
            power *= omega * unit * INVERSE.get(k - 1).copied().unwrap_or(0.0);
        }
        let (sine, cosine) = (power * sines[k % 4], power * cosines[k % 4]);
        let late = change[1] * (start * cosine + unit * before) + change[2] * cosine;
        *value = [change[0] * sine + amplitude * late, amplitude * sine];
        before = cosine;
    }
}
