//! Turbulence: random forces along a structure that are coherent over a length, as forces on its
//! modes.
//!
//! Of a force per length with the one-sided density S(x, f) and the cross-density
//!
//! √(S(x₁, f) S(x₂, f)) e^(−|x₁−x₂|/λ)
//!
//! the modes φᵢ get forces Qᵢ with the cross-densities
//!
//! Dᵢⱼ(f) = ∬ φᵢ φⱼ √(S S′) e^(−|x−x′|/λ) dx dx′ ≈ Wᵀ √S C̄ √S W,   W_aᵢ = ∫ over cell a of φᵢ dx,
//!
//! with the coherence C̄ averaged over pairs of cells (`coherence.rs`): the error is that of S and
//! φ within a cell of length ℓ, (kℓ)²/6 of Dᵢᵢ at a wave number k, whatever λ/ℓ. For each line f_k
//! = k/T of the spectrum, with D = LLᵀ,
//!
//! Qᵢ(t) = Σ_k √(2/T) Σ_j Lᵢⱼ(f_k) cos(2πf_k t + φ_jk),
//!
//! with independent phases that follow from the seed: the simulation of several correlated
//! processes of Shinozuka & Deodatis 1991 (doi:10.1115/1.3119501). L is lower triangular in the
//! order of the modes, so that the forces on the first modes stay as more modes are added, and the
//! forces depend neither on the step nor on the scheme, nor on other bodies. The mean square of a
//! force over T scatters from seed to seed by about 1/√(lines), where its lines have contributions
//! of several modes; that of the first mode, whose lines have one, does not scatter.

#[cfg(feature = "cli")]
mod asked;
mod coherence;
mod spectrum;

pub use spectrum::TurbulenceSpectrum;

use super::modal::Modes;
use super::random::Lines;
use super::row::Row;
use super::system::positive;
use super::{Load, Table};
use crate::error::{Error, Result, Subject};
use crate::hash;
use coherence::CellCoherence;
use serde::{Deserialize, Serialize};
use std::f64::consts::TAU;

/// Most values of the forces of one field: rows times modes, 0.5 GB.
const MOST_VALUES: usize = 1 << 26;

/// Weights of a mode below this share of the largest are rounding: the mode does not move there.
const STILL: f64 = 1e-12;

/// Pivots below this share of their diagonal are zero: the mode has no force of its own.
const DEPENDENT: f64 = 1e-14;

/// A field of turbulent forces along a stretch of a structure, in one direction.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Turbulence {
    /// The stretch as equal cells from one end to the other: for each the row of its mean
    /// displacement, on the structure before its reduction to modes.
    pub cells: Vec<Row>,
    /// Where the stretch begins and ends, m.
    pub along: [f64; 2],
    /// S.
    pub spectrum: TurbulenceSpectrum,
    /// λ, m.
    pub correlation_length: f64,
    /// The frequencies between which there are forces, Hz.
    pub band: [f64; 2],
    /// The same seed gives the same forces.
    pub seed: u64,
    /// Fields of one seed and different streams are independent.
    pub stream: u64,
}

impl Turbulence {
    /// The stream of a field of table `index`, from 0, of a case: of the only one, or of those
    /// along y (0) and z (1).
    #[cfg(feature = "case")]
    pub(crate) fn stream(index: usize, plane: usize) -> u64 {
        2 * index as u64 + plane as u64
    }

    /// The number of its table in the case, from 1.
    #[cfg(feature = "case")]
    pub(crate) fn number(&self) -> u64 {
        self.stream / 2 + 1
    }

    /// True for the first field of its table.
    #[cfg(feature = "cli")]
    pub(crate) fn is_first(&self) -> bool {
        self.stream.is_multiple_of(2)
    }

    /// The forces on `modes` from 0 to `end` (s): one load for each mode that moves along the
    /// stretch, on that coordinate of the reduced scene, as a table that goes one row beyond the
    /// end.
    ///
    /// # Errors
    /// [`Error::Invalid`] under `turbulence` for an invalid value, a band without a line at this
    /// duration, or tables that are too large.
    pub fn forces(&self, modes: &Modes, end: f64) -> Result<Vec<Load>> {
        let lines = self.lines(end)?;
        let weights = self.weights(modes);
        let values = lines.rows().saturating_mul(weights.len());
        if values > MOST_VALUES {
            let most = self.band[1] * MOST_VALUES as f64 / (2 * values) as f64;
            let value = format!("up to {:?} Hz over {end:?} s on {} modes", self.band[1], weights.len());
            let expected = format!("at most {most:.3e} Hz, a shorter run, or fewer modes: 2^26 values in all");
            return Err(Error::invalid(("turbulence", "band"), value, expected));
        }
        let amplitudes = self.amplitudes(&lines, &weights);
        let Some(((first, _), others)) = weights.split_first() else { return Ok(Vec::new()) };
        let mut amplitudes = amplitudes.into_iter();
        let mut signal = || {
            let pairs = lines.numbers().zip(amplitudes.next().unwrap_or_default());
            lines.signal(pairs.map(|(line, (a, b))| (a / lines.kept(line), b / lines.kept(line))))
        };
        let table = Table::new(lines.times(), signal())?;
        let mut loads = vec![Load { at: Row::dof(*first), ..Load::table(table.clone()) }];
        for (mode, _) in others {
            loads.push(Load { at: Row::dof(*mode), ..Load::table(table.with_force(signal())?) });
        }
        Ok(loads)
    }

    /// The root mean square of the force per length in each cell over a run of `end` seconds, N/m.
    ///
    /// # Errors
    /// As [`Turbulence::forces`].
    pub fn root_mean_squares(&self, end: f64) -> Result<Vec<f64>> {
        let lines = self.lines(end)?;
        let square = |cell: usize| {
            let densities = lines.numbers().map(|line| self.spectrum.at(cell, lines.frequency(line)));
            densities.sum::<f64>() / lines.end
        };
        Ok((0..self.cells.len()).map(|cell| square(cell).sqrt()).collect())
    }

    /// ℓ, m.
    fn cell_length(&self) -> f64 {
        (self.along[1] - self.along[0]) / self.cells.len() as f64
    }

    /// Refuses invalid values, and a band that has no line or too many in a run of `end` seconds.
    #[cfg(feature = "case")]
    pub(crate) fn check(&self, end: f64) -> Result<()> {
        self.lines(end).map(drop)
    }

    fn lines(&self, end: f64) -> Result<Lines> {
        let subject = Subject::of("turbulence");
        self.validate(&subject)?;
        Lines::new(&subject, self.band, end)
    }

    fn validate(&self, subject: &Subject) -> Result<()> {
        let key = |part: &'static str| subject.clone().part(part);
        positive(key("along"), self.cell_length())?;
        positive(key("correlation_length"), self.correlation_length)?;
        let [from, to] = self.band;
        positive(key("from"), from)?;
        positive(key("to"), to)?;
        if to <= from {
            return Err(Error::invalid(key("to"), format_args!("{to:?}"), format!("more than from, {from:?}")));
        }
        self.spectrum.validate(subject, self.cells.len())
    }

    /// W: each mode that moves along the stretch, with ∫ φ dx over each cell.
    fn weights(&self, modes: &Modes) -> Vec<(usize, Vec<f64>)> {
        let length = self.cell_length();
        let seen: Vec<Vec<f64>> = self.cells.iter().map(|row| modes.seen(row)).collect();
        let largest = seen.iter().flatten().fold(0.0_f64, |most, x| most.max(x.abs()));
        let of = |mode: usize| (mode, seen.iter().map(|cell| length * cell[mode]).collect::<Vec<_>>());
        let moves = |(_, weights): &(usize, Vec<f64>)| {
            largest > 0.0 && weights.iter().any(|w| w.abs() > STILL * length * largest)
        };
        (0..modes.count()).map(of).filter(moves).collect()
    }

    /// D at the frequency `f` (Hz), N²/Hz: the lower triangle by rows, one row a mode of `weights`.
    fn cross_densities(&self, coherence: CellCoherence, weights: &[(usize, Vec<f64>)], f: f64) -> Vec<Vec<f64>> {
        let root: Vec<f64> = (0..self.cells.len()).map(|cell| self.spectrum.at(cell, f).sqrt()).collect();
        let scaled = |(_, w): &(usize, Vec<f64>)| w.iter().zip(&root).map(|(w, s)| w * s).collect::<Vec<f64>>();
        let scaled: Vec<Vec<f64>> = weights.iter().map(scaled).collect();
        let mut product = vec![0.0; root.len()];
        let row = |(i, y): (usize, &Vec<f64>)| {
            coherence.multiply(y, &mut product);
            let with = |other: &Vec<f64>| other.iter().zip(&product).map(|(a, b)| a * b).sum();
            scaled[..=i].iter().map(with).collect()
        };
        scaled.iter().enumerate().map(row).collect()
    }

    /// The pair of amplitudes of each line, N, for each mode of `weights`.
    fn amplitudes(&self, lines: &Lines, weights: &[(usize, Vec<f64>)]) -> Vec<Vec<(f64, f64)>> {
        let coherence = CellCoherence::new(self.cell_length(), self.correlation_length);
        let mut amplitudes = vec![Vec::with_capacity(lines.numbers().len()); weights.len()];
        let scale = (2.0 / lines.end).sqrt();
        for line in lines.numbers() {
            let mut factor = self.cross_densities(coherence, weights, lines.frequency(line));
            factorise(&mut factor);
            // By the number among the modes that the field moves: those of other bodies and of the
            // other plane, which lie between them, change nothing.
            let phase = |number: usize| {
                let bits = hash::mix(hash::mix(self.seed, self.stream, number as u64), MODES, line as u64);
                (TAU * hash::unit(bits)).sin_cos()
            };
            let phases: Vec<(f64, f64)> = (0..weights.len()).map(phase).collect();
            for (row, amplitudes) in factor.iter().zip(&mut amplitudes) {
                let add = |(a, b): (f64, f64), (l, (sin, cos)): (&f64, &(f64, f64))| (a + l * cos, b + l * sin);
                let (a, b) = row.iter().zip(&phases).fold((0.0, 0.0), add);
                amplitudes.push((scale * a, scale * b));
            }
        }
        amplitudes
    }
}

/// The stream of the phases of modes, apart from those of random loads of the same seed.
const MODES: u64 = 0x6d6f_6465;

/// Replaces the lower triangle of D, by rows, by L with D = LLᵀ. D may be singular: a column whose
/// pivot is rounding becomes zero.
fn factorise(d: &mut [Vec<f64>]) {
    for j in 0..d.len() {
        let (before, rest) = d.split_at_mut(j);
        let Some(row) = rest.first_mut() else { return };
        let diagonal = row[j];
        for (k, above) in before.iter().enumerate() {
            let known: f64 = row[..k].iter().zip(above).map(|(a, b)| a * b).sum();
            row[k] = if above[k] > 0.0 { (row[k] - known) / above[k] } else { 0.0 };
        }
        let pivot = diagonal - row[..j].iter().map(|l| l * l).sum::<f64>();
        row[j] = if pivot > DEPENDENT * diagonal { pivot.sqrt() } else { 0.0 };
    }
}

#[cfg(test)]
mod tests;
