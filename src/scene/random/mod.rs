//! Random forces with a given power spectral density.

mod lines;
mod scatter;

pub(super) use lines::Lines;
pub use scatter::Scatter;

use super::system::{finite, positive};
use super::{Load, Table};
use crate::error::{Error, Result, Subject};
use crate::hash;
use std::f64::consts::TAU;

/// A one-sided power spectral density.
#[derive(Debug, Clone, PartialEq)]
pub enum Density {
    /// A force of this mean square, evenly over a band.
    Flat {
        /// Root mean square of the force, N.
        rms: f64,
        /// Lower end of the band, Hz.
        from: f64,
        /// Upper end of the band, Hz.
        to: f64,
    },
    /// Pairs (frequency in Hz, density in N²/Hz), with increasing frequencies: straight between
    /// them in logarithms of both, zero outside.
    Points(Vec<[f64; 2]>),
}

/// A random force: a stationary Gaussian-like signal of a given density.
///
/// With the lines f_i = i/T in the band, T the duration and Δf = 1/T,
///
/// f(t) = Σ √(2 S(f_i) Δf) cos(2π f_i t + φ_i),
///
/// with phases φ_i that are uniform and independent and follow from the seed: Shinozuka & Deodatis
/// 1991 (doi:10.1115/1.3119501). The amplitudes are deterministic: every realisation has the mean
/// square that was asked for, of points Σ S(f_i) Δf, where a line at an end of the band counts in
/// full, while random amplitudes would scatter it. By the central limit
/// theorem the values are nearly Gaussian where there are many lines.
///
/// The force is a table of linear pieces, at least 16 in the period of the fastest line, so every
/// scheme treats it as a table: `event` stays exact, and a run with half the step sees the same
/// force. Linear interpolation multiplies a line at f by sinc²(f Δt) with sinc x = sin πx/(πx), so
/// the amplitudes are divided by it: the density in the band is exact. Images above the band, near
/// multiples of 1/Δt, have less than 1e-5 of the power.
///
/// ```
/// use signorini::{Density, RandomForce};
///
/// let force = RandomForce { density: Density::Flat { rms: 3.0, from: 1.0, to: 50.0 }, seed: 7,
/// stream: 0 }; let table = force.table(4.0)?; let values: Vec<f64> = (0..40_000).map(|i|
/// table.piece(1e-4 * f64::from(i)).0).collect(); let square = values.iter().map(|f| f *
/// f).sum::<f64>() / values.len() as f64; assert!((square.sqrt() - 3.0).abs() < 1e-4);
/// # Ok::<(), signorini::Error>(())
/// ```
#[derive(Debug, Clone, PartialEq)]
pub struct RandomForce {
    /// S.
    pub density: Density,
    /// The same seed gives the same force.
    pub seed: u64,
    /// Signals of one seed and different streams are independent.
    pub stream: u64,
}

impl RandomForce {
    /// The force from 0 to `end` (s) as a table, which goes one row beyond the end.
    ///
    /// # Errors
    /// [`Error::Invalid`] under `random load` for an invalid density, a band without a line at this
    /// duration, or more than 2^24 rows.
    pub fn table(&self, end: f64) -> Result<Table> {
        self.density.validate()?;
        let lines = Lines::new(&Subject::of("random load"), self.density.band(), end)?;
        let share = match self.density {
            Density::Flat { .. } => 1.0 / lines.numbers().len() as f64,
            Density::Points(_) => 1.0 / end,
        };
        lines.table(lines.numbers().map(|i| {
            let amplitude = (2.0 * self.density.at(lines.frequency(i)) * share).sqrt() / lines.kept(i);
            let (sin, cos) = (TAU * hash::unit(hash::mix(self.seed, self.stream, i as u64))).sin_cos();
            (amplitude * cos, amplitude * sin)
        }))
    }

    /// A load of this force on the first degree of freedom, for a scene of the duration `end` (s).
    ///
    /// # Errors
    /// As [`RandomForce::table`].
    pub fn load(&self, end: f64) -> Result<Load> {
        Ok(Load::table(self.table(end)?))
    }
}

impl Density {
    /// The frequencies between which the density is not zero, Hz.
    pub(crate) fn band(&self) -> [f64; 2] {
        match self {
            Self::Flat { from, to, .. } => [*from, *to],
            Self::Points(points) => [points.first(), points.last()].map(|point| point.map_or(0.0, |point| point[0])),
        }
    }

    /// S(f) within the band, N²/Hz; for [`Density::Flat`] the whole mean square, N², since the
    /// share of each line depends on the number of lines.
    fn at(&self, f: f64) -> f64 {
        match self {
            Self::Flat { rms, .. } => rms * rms,
            Self::Points(points) => straight_in_logarithms(points, f),
        }
    }

    /// Refuses an invalid density.
    pub(crate) fn validate(&self) -> Result<()> {
        match self {
            Self::Flat { rms, from, to } => {
                positive(key("rms"), *rms)?;
                positive(key("from"), *from)?;
                finite(key("to"), *to)?;
                if to > from {
                    Ok(())
                } else {
                    Err(Error::invalid(key("to"), format_args!("{to:?}"), format!("more than from, {from:?}")))
                }
            }
            Self::Points(points) => validate_points(&key("psd"), points, ["frequency", "density"]),
        }
    }
}

/// The value at `x` between the points, which are positive, straight in logarithms of both; beyond
/// them, that of the nearest: a line within rounding of an end of the band counts as on it.
pub(super) fn straight_in_logarithms(points: &[[f64; 2]], x: f64) -> f64 {
    let after = points.partition_point(|point| point[0] <= x).clamp(1, points.len() - 1);
    let [[x0, y0], [x1, y1]] = [points[after - 1], points[after]];
    let along = ((x / x0).ln() / (x1 / x0).ln()).clamp(0.0, 1.0);
    y0 * ((y1 / y0).ln() * along).exp()
}

/// Refuses points that are fewer than two, not positive, or not in order of their first values;
/// `words` name the first and the second value in errors about `subject`.
pub(super) fn validate_points(subject: &Subject, points: &[[f64; 2]], words: [&'static str; 2]) -> Result<()> {
    if points.len() < 2 {
        let count = format!("{} pairs", points.len());
        let expected = format!("two pairs of {} and {} or more", words[0], words[1]);
        return Err(Error::invalid(subject.clone(), count, expected));
    }
    for (i, &[x, y]) in points.iter().enumerate() {
        positive(subject.clone().value(i).part(words[0]), x)?;
        positive(subject.clone().value(i).part(words[1]), y)?;
    }
    match points.windows(2).position(|pair| pair[1][0] <= pair[0][0]) {
        None => Ok(()),
        Some(i) => Err(Error::invalid(
            subject.clone().value(i + 1).part(words[0]),
            format_args!("{:?}", points[i + 1][0]),
            format!("more than the one before, {:?}", points[i][0]),
        )),
    }
}

fn key(part: &'static str) -> Subject {
    Subject::of("random load").part(part)
}
