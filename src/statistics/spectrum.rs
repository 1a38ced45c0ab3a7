//! Power spectral densities of recorded signals.

use crate::error::{Error, Result};
use crate::linear::fourier;
use serde::Serialize;
use std::f64::consts::TAU;

/// Fewest segments of an estimate.
const SEGMENTS: usize = 8;

/// Shortest segment, values.
const SHORTEST: usize = 16;

/// Fewest values of a signal: the segments overlap by half.
pub(crate) const FEWEST: usize = SHORTEST * (SEGMENTS + 1) / 2;

/// A one-sided power spectral density, estimated by Welch's method.
///
/// The signal less its mean is cut into segments of L values that overlap by half, L the largest
/// power of two that gives eight segments or more. Each is weighted by Hann's window
/// w_j = (1 − cos(2πj/L))/2, and with its transform X the density is
///
/// S_k = 2 ⟨|X_k|²⟩ / (f_s Σw²) at f_k = k f_s/L,
///
/// half of that at 0 and f_s/2, averaged over the segments (Welch 1967,
/// doi:10.1109/TAU.1967.1161901). So Σ S_k f_s/L is the mean over the segments of Σ(wx)²/Σw²: the
/// variance of the signal.
///
/// The estimate at a frequency scatters as S χ²_ν/ν with
/// [`degrees_of_freedom`](Spectrum::degrees_of_freedom): with eight segments, ν = 15, a 95 %
/// interval goes from 0.55 to 2.4 times the estimate. A line is smeared over ±2 f_s/L.
///
/// ```
/// use signorini::Spectrum;
///
/// // 2 sin(2π 50 t) at 1 kHz: the variance 2 lies around 50 Hz.
/// let signal: Vec<f64> = (0..4096).map(|i| 2.0 * (std::f64::consts::TAU * 0.05 * f64::from(i)).sin()).collect();
/// let spectrum = Spectrum::of(&signal, 1e-3)?;
/// let near = |f: f64| (f - 50.0).abs() < 5.0;
/// let density = spectrum.frequencies().zip(&spectrum.density).filter(|(f, _)| near(*f));
/// let power: f64 = density.map(|(_, s)| s * spectrum.spacing).sum();
/// assert!((power - 2.0).abs() < 1e-2);
/// # Ok::<(), signorini::Error>(())
/// ```
#[derive(Debug, Clone, PartialEq, Serialize)]
#[non_exhaustive]
pub struct Spectrum {
    /// Distance of the frequencies, f_s/L, Hz.
    pub spacing: f64,
    /// S at 0, f_s/L, 2 f_s/L, …, f_s/2: the square of the signal's unit per Hz.
    pub density: Vec<f64>,
    /// Number of segments, K.
    pub segments: usize,
}

impl Spectrum {
    /// That of `values`, `spacing` seconds apart.
    ///
    /// # Errors
    /// [`Error::Invalid`] under `spectrum` for a spacing that is not above 0, for fewer than 72
    /// values, and for values that are not finite.
    pub fn of(values: &[f64], spacing: f64) -> Result<Self> {
        if !(spacing.is_finite() && spacing > 0.0) {
            return Err(Error::invalid("spectrum", format_args!("a spacing of {spacing:?} s"), "a finite one above 0"));
        }
        if values.len() < FEWEST {
            let expected = format!("{FEWEST} or more: {SEGMENTS} segments of {SHORTEST}, which overlap by half");
            return Err(Error::invalid("spectrum", format_args!("of {} values", values.len()), expected));
        }
        if let Some(value) = values.iter().find(|value| !value.is_finite()) {
            return Err(Error::invalid("spectrum", format_args!("of {value:?}"), "finite values"));
        }
        // L/2 (K + 1) values hold K segments.
        let longest = 2 * values.len() / (SEGMENTS + 1);
        let length = 1_usize << longest.ilog2();
        let half = length / 2;
        let segments = values.len() / half - 1;
        let mean = values.iter().sum::<f64>() / values.len() as f64;
        let window: Vec<f64> = (0..length).map(|j| 0.5 * (1.0 - (TAU * j as f64 / length as f64).cos())).collect();
        let weight: f64 = window.iter().map(|w| w * w).sum();
        let mut density = vec![0.0; half + 1];
        for segment in 0..segments {
            let part = values.iter().skip(segment * half);
            let mut re: Vec<f64> = part.zip(&window).map(|(x, w)| w * (x - mean)).collect();
            let mut im = vec![0.0; length];
            fourier::inverse(&mut re, &mut im);
            // The sign of the exponent does not matter to |X|².
            density.iter_mut().zip(re.iter().zip(&im)).for_each(|(s, (re, im))| *s += re * re + im * im);
        }
        let scale = 2.0 * spacing / (weight * segments as f64);
        density.iter_mut().for_each(|s| *s *= scale);
        for end in [0, half] {
            density[end] *= 0.5;
        }
        Ok(Self { spacing: 1.0 / (length as f64 * spacing), density, segments })
    }

    /// The frequencies of the density, Hz.
    pub fn frequencies(&self) -> impl Iterator<Item = f64> + use<'_> {
        (0..self.density.len()).map(|k| k as f64 * self.spacing)
    }

    /// Degrees of freedom ν = 36K²/(19K − 1) of the estimate at a frequency away from the ends,
    /// where the density is flat over ±2 f_s/L: neighbouring segments share a part (1/6)² of their
    /// variance under Hann's window.
    #[must_use]
    pub fn degrees_of_freedom(&self) -> f64 {
        let k = self.segments as f64;
        36.0 * k * k / (19.0 * k - 1.0)
    }
}
