//! The forces of turbulence on modes: what a field asks of them, against what a run applied.

use super::spectrum::{FEWEST, Spectrum};
use crate::error::Result;
use crate::scene::{Load, LoadKind, Modes, Turbulence};
use std::f64::consts::PI;

/// Frequencies of an estimate in the band of a field, at least where the run is long enough; fewer
/// than twice as many. A longer run has no finer spectrum but one that scatters less.
const FREQUENCIES: f64 = 64.0;

/// Lines at which the cross-densities that were asked for are summed up, at most.
const MOST_LINES: usize = 256;

/// Distance to the ends of the band, in frequencies: Hann's window smears what is there so far.
const SMEARED: f64 = 2.0;

/// The forces of a field on modes that are scaled to a largest displacement of 1 along its stretch.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Recovered {
    /// The modes that move along the stretch, from 0.
    pub modes: Vec<usize>,
    /// Hz; none where the run is too short.
    pub frequencies: Vec<f64>,
    /// For each mode the densities at these frequencies that were asked for and recovered, N²/Hz.
    pub densities: Vec<[Vec<f64>; 2]>,
    /// Standard deviation of a recovered density over that which was asked for, at most: √(2/ν) of
    /// a signal whose lines have random amplitudes. A mode whose force has few parts scatters less.
    pub scatter: f64,
    /// Each pair of modes.
    pub pairs: Vec<Pair>,
}

/// The correlation of the forces on two modes over the band.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Pair {
    /// Indices into the modes.
    pub modes: [usize; 2],
    /// Σ Dᵢⱼ/√(Σ Dᵢᵢ Σ Dⱼⱼ) over the lines.
    pub asked: f64,
    /// ⟨QᵢQⱼ⟩/√(⟨Qᵢ²⟩⟨Qⱼ²⟩) over the run.
    pub recovered: f64,
    /// Standard deviation of it, about.
    pub scatter: f64,
}

impl Recovered {
    /// Of the forces of `field` on `modes`, which a run of `end` seconds applied: the last of its
    /// `loads`.
    ///
    /// # Errors
    /// As [`Turbulence::forces`] and [`Spectrum::of`].
    pub fn of(field: &Turbulence, modes: &Modes, loads: &[Load], end: f64) -> Result<Self> {
        let asked = field.asked(modes);
        let own = loads.get(loads.len().saturating_sub(asked.modes.len())..).unwrap_or_default();
        let signals: Vec<Vec<f64>> = own.iter().zip(&asked.modes).map(|(load, (_, by))| period(load, *by)).collect();
        let mut found = Self {
            modes: asked.modes.iter().map(|(mode, _)| *mode).collect(),
            frequencies: Vec::new(),
            densities: vec![[Vec::new(), Vec::new()]; signals.len()],
            scatter: f64::NAN,
            pairs: Vec::new(),
        };
        for (signal, [_, recovered]) in signals.iter().zip(&mut found.densities) {
            let Some(estimate) = Estimate::of(signal, end, field.band)? else { break };
            (found.frequencies, *recovered, found.scatter) = (estimate.frequencies, estimate.density, estimate.scatter);
        }
        for f in &found.frequencies {
            let here = asked.at(*f);
            for (row, [asked, _]) in here.iter().zip(&mut found.densities) {
                asked.extend(row.last());
            }
        }
        let lines = asked.lines(end)?;
        let every = lines.len().div_ceil(MOST_LINES);
        let picked: Vec<_> = lines.skip(every / 2).step_by(every).map(|f| asked.at(f)).collect();
        found.pairs = pairs(&picked, every, &signals);
        Ok(found)
    }
}

/// The rows of one period of a load, times a factor.
fn period(load: &Load, factor: f64) -> Vec<f64> {
    let LoadKind::Table(table) = &load.kind else { return Vec::new() };
    // It goes one row beyond the end, where it begins again.
    let rows = table.force().len().saturating_sub(2);
    table.force().iter().take(rows).map(|force| factor * force).collect()
}

/// The spectrum of a periodic force within a band.
struct Estimate {
    frequencies: Vec<f64>,
    density: Vec<f64>,
    scatter: f64,
}

impl Estimate {
    /// Of the rows of a `signal` that lasts `end` seconds: the mean over pieces. `None` where it is
    /// too short.
    fn of(signal: &[f64], end: f64, [from, to]: [f64; 2]) -> Result<Option<Self>> {
        let spacing = end / signal.len() as f64;
        let least = ((FREQUENCIES / ((to - from) * spacing)).ceil() as usize).next_power_of_two();
        let pieces = (2 * signal.len() / (9 * least)).max(1);
        let rows = signal.len() / pieces;
        if rows < FEWEST {
            return Ok(None);
        }
        let spectra = signal.chunks_exact(rows).take(pieces).map(|piece| Spectrum::of(piece, spacing));
        let spectra = spectra.collect::<Result<Vec<_>>>()?;
        let Some(one) = spectra.first() else { return Ok(None) };
        let within = |f: f64| f >= from + SMEARED * one.spacing && f <= to - SMEARED * one.spacing;
        let (mut frequencies, mut density) = (Vec::new(), Vec::new());
        for (k, f) in one.frequencies().enumerate().filter(|(_, f)| within(*f)) {
            let sum: f64 = spectra.iter().filter_map(|spectrum| spectrum.density.get(k)).sum();
            // The force goes straight from row to row, which keeps so much of a sine's amplitude.
            let x = PI * f * spacing;
            let kept = (x.sin() / x).powi(2);
            frequencies.push(f);
            density.push(kept * kept * sum / spectra.len() as f64);
        }
        let scatter = (2.0 / (spectra.len() as f64 * one.degrees_of_freedom())).sqrt();
        Ok((!frequencies.is_empty()).then_some(Self { frequencies, density, scatter }))
    }
}

/// The correlations of the forces of all pairs of modes: of the cross-densities `picked`, one of
/// `every` so many lines, and of the `signals`.
fn pairs(picked: &[Vec<Vec<f64>>], every: usize, signals: &[Vec<f64>]) -> Vec<Pair> {
    let sum = |term: &dyn Fn(&[Vec<f64>]) -> f64| picked.iter().map(|d| term(d)).sum::<f64>();
    let mean = |i: usize, j: usize| signals[i].iter().zip(&signals[j]).map(|(a, b)| a * b).sum::<f64>();
    let own: Vec<[f64; 2]> = (0..signals.len()).map(|i| [sum(&|d| d[i][i]), mean(i, i)]).collect();
    let pair = |(i, j): (usize, usize)| {
        let [asked, recovered] = [0, 1].map(|k| (own[i][k] * own[j][k]).sqrt());
        // A line adds Re(ZᵢZⱼ*) with ⟨|Zᵢ|²⟩ = Dᵢᵢ, whose variance is at most about DᵢᵢDⱼⱼ/2 where
        // the two are independent; the estimate of a correlation r has (1 − r²)² of that.
        let r = sum(&|d| d[i][j]) / asked;
        let variance = 0.5 * sum(&|d| d[i][i] * d[j][j]) / every as f64;
        let scatter = (1.0 - r * r) * variance.sqrt() / asked;
        Pair { modes: [j, i], asked: r, recovered: mean(i, j) / recovered, scatter }
    };
    let all = (0..signals.len()).flat_map(|i| (0..i).map(move |j| (i, j)));
    all.map(pair).filter(|pair| pair.asked.is_finite() && pair.recovered.is_finite()).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scene::{Row, TurbulenceSpectrum};

    /// A field over 3 m in 240 cells, whose mean displacements are the degrees of freedom.
    fn field(spectrum: TurbulenceSpectrum, correlation_length: f64) -> Turbulence {
        Turbulence {
            cells: (0..240).map(Row::dof).collect(),
            along: [0.0, 3.0],
            spectrum,
            correlation_length,
            band: [2.0, 40.0],
            seed: 5,
            stream: 0,
        }
    }

    /// The modes 7 sin iπx/L in their means over cells.
    fn sines(count: usize) -> Modes {
        let shape = |i: usize| {
            let edge = |cell: usize| (PI * i as f64 * cell as f64 / 240.0).cos();
            (0..240).map(|cell| 7.0 * (edge(cell) - edge(cell + 1)) * 240.0 / (PI * i as f64)).collect()
        };
        Modes { omega: vec![1.0; count], shapes: (1..=count).map(shape).collect() }
    }

    fn found(field: &Turbulence, count: usize, end: f64) -> Recovered {
        let modes = sines(count);
        let loads = field.forces(&modes, end).expect("forces");
        Recovered::of(field, &modes, &loads, end).expect("recovered")
    }

    #[test]
    fn a_long_run_recovers_the_density_of_the_double_integral() {
        // S = f^(−2) (N/m)²/Hz; ∬ sin sin e^(−|x−x′|/λ) of the third sine over 3 m for λ = 0.1 m,
        // by quadrature in 30 digits, and sin has 1 as its largest value already.
        let spectrum = TurbulenceSpectrum::Even(vec![[1.0, 1.0], [100.0, 1e-4]]);
        let known = |f: f64| 0.274_686_165_379_587 / (f * f);
        let found = found(&field(spectrum, 0.1), 3, 400.0);
        let [asked, recovered] = &found.densities[2];
        assert!(found.frequencies.len() > 60 && found.scatter < 0.07, "{}", found.scatter);
        let mut shares = Vec::new();
        for ((f, asked), recovered) in found.frequencies.iter().zip(asked).zip(recovered) {
            // Cells of 12.5 mm: (kℓ)²/6 = 2.6e-4 at k = π, and (kℓ)²/12 of the largest value.
            assert!((asked / known(*f) - 1.0).abs() < 1e-3, "{f} Hz: {asked}");
            shares.push(recovered / known(*f));
        }
        // Four standard deviations of χ²_ν/ν. The spectrum of Hann's window has the second moment
        // Δ²/3: its bias is S″Δ²/6 = (Δ/f)² S, and three times that where f is a few Δ.
        let spacing = found.frequencies[1] - found.frequencies[0];
        for (f, share) in found.frequencies.iter().zip(&shares) {
            let bias = 3.0 * (spacing / f).powi(2);
            assert!((share - 1.0).abs() < 4.0 * found.scatter + bias, "{f} Hz: {share}");
        }
        // The mean over the frequencies from 10 Hz, where the bias is 0.3 %; of them half count,
        // since neighbours under Hann's window share much.
        let high: Vec<f64> =
            found.frequencies.iter().zip(&shares).filter(|(f, _)| **f > 10.0).map(|(_, s)| *s).collect();
        let mean = high.iter().sum::<f64>() / high.len() as f64;
        assert!((mean - 1.0).abs() < 4.0 * found.scatter / (0.5 * high.len() as f64).sqrt() + 0.005, "{mean}");
    }

    #[test]
    fn a_long_run_recovers_the_correlation_that_a_flow_over_half_the_tube_makes() {
        // Coherent over no length, so that Dᵢⱼ ∝ ∫ sin(iπx/L) sin(jπx/L) dx over the half that the
        // flow reaches: L/4 for i = j, 2L/3π for 1 and 2, 2L/5π for 2 and 3, 0 for 1 and 3.
        let flow = TurbulenceSpectrum::Flow {
            density: 1000.0,
            diameter: 0.02,
            velocity: (0..240).map(|cell| if cell < 120 { 2.0 } else { 0.0 }).collect(),
            reduced: vec![[1e-3, 1.0], [1e3, 1.0]],
        };
        let found = found(&field(flow, 1e-5), 3, 100.0);
        let known = [8.0 / (3.0 * PI), 0.0, 8.0 / (5.0 * PI)];
        assert_eq!(found.pairs.iter().map(|pair| pair.modes).collect::<Vec<_>>(), [[0, 1], [0, 2], [1, 2]]);
        for (pair, known) in found.pairs.iter().zip(known) {
            assert!((pair.asked - known).abs() < 1e-3, "{pair:?} for {known}");
            // 3801 lines of one density: (1 − r²)/√7602; four times that.
            let scatter = (1.0 - known * known) / 7602.0_f64.sqrt();
            assert!((pair.scatter / scatter - 1.0).abs() < 0.02, "{pair:?} for {scatter}");
            assert!((pair.recovered - known).abs() < 4.0 * scatter, "{pair:?} for {known}");
        }
    }

    #[test]
    fn a_short_run_has_correlations_and_no_spectrum() {
        let spectrum = TurbulenceSpectrum::Even(vec![[1.0, 1.0], [100.0, 1.0]]);
        let found = found(&field(spectrum, 0.1), 2, 0.1);
        assert_eq!((found.frequencies.len(), found.pairs.len()), (0, 1));
    }
}
