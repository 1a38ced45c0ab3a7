//! Random forces with a given power spectral density.

use super::system::{finite, positive};
use super::{Load, Table};
use crate::error::{Error, Result, Subject};
use crate::hash;
use crate::linear::fourier::inverse;
use std::f64::consts::{PI, TAU};

/// Most rows of a random table, which has 16 per shortest period.
const MOST_ROWS: f64 = 16_777_216.0;

/// Rows of the table in the period of the fastest line, at least.
const ROWS_A_PERIOD: usize = 16;

/// Rounding allowance for the ends of a band, in spacings of lines: a line at an end is included.
const ON_LINE: f64 = 1e-9;

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
/// square that was asked for, while random amplitudes would scatter it. By the central limit
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
/// let force = RandomForce { density: Density::Flat { rms: 3.0, from: 1.0, to: 50.0 }, seed: 7, stream: 0 };
/// let table = force.table(4.0)?;
/// let values: Vec<f64> = (0..40_000).map(|i| table.piece(1e-4 * f64::from(i)).0).collect();
/// let square = values.iter().map(|f| f * f).sum::<f64>() / values.len() as f64;
/// assert!((square.sqrt() - 3.0).abs() < 1e-4);
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

/// A line of the spectrum: its number, i = f_i T, and its amplitude, N.
type Line = (usize, f64);

impl RandomForce {
    /// The force from 0 to `end` (s) as a table, which goes one row beyond the end.
    ///
    /// # Errors
    /// [`Error::Invalid`] under `random load` for an invalid density, a band without a line at this
    /// duration, or more than 2^24 rows.
    pub fn table(&self, end: f64) -> Result<Table> {
        let lines = self.lines(end)?;
        let last = lines.last().map_or(1, |line| line.0);
        let rows = (ROWS_A_PERIOD * last).next_power_of_two();
        let (mut re, mut im) = (vec![0.0; rows], vec![0.0; rows]);
        for (i, amplitude) in lines {
            let x = PI * i as f64 / rows as f64;
            let kept = (x.sin() / x).powi(2);
            let (sin, cos) = (TAU * hash::unit(hash::mix(self.seed, self.stream, i as u64))).sin_cos();
            (re[i], im[i]) = (amplitude / kept * cos, amplitude / kept * sin);
        }
        inverse(&mut re, &mut im);
        drop(im);
        let time = (0..=rows + 1).map(|j| end * (j as f64 / rows as f64)).collect();
        let force = (0..=rows + 1).map(|j| re[j % rows]).collect();
        Table::new(time, force)
    }

    /// A load of this force on the first degree of freedom, for a scene of the duration `end` (s).
    ///
    /// # Errors
    /// As [`RandomForce::table`].
    pub fn load(&self, end: f64) -> Result<Load> {
        Ok(Load::table(self.table(end)?))
    }

    /// The lines in the band, with their amplitudes.
    fn lines(&self, end: f64) -> Result<Vec<Line>> {
        positive(key("duration"), end)?;
        self.density.validate()?;
        let [from, to] = self.density.band();
        let rounded = |x: f64| ON_LINE * x.max(1.0);
        let first = (from * end - rounded(from * end)).ceil().max(1.0);
        let last = (to * end + rounded(to * end)).floor();
        if last < first {
            let value = format!("{from:?} to {to:?} Hz, without a line");
            let expected = format!("a band that contains a multiple of 1/end = {:e} Hz", 1.0 / end);
            return Err(Error::invalid(key("band"), value, expected));
        }
        if last * ROWS_A_PERIOD as f64 > MOST_ROWS {
            let most = MOST_ROWS / ROWS_A_PERIOD as f64 / end;
            let value = format!("up to {to:?} Hz over {end:?} s");
            let expected =
                format!("at most {most:e} Hz at this end: a random table has at most 2^24 rows, 16 a period");
            return Err(Error::invalid(key("band"), value, expected));
        }
        let (first, last) = (first as usize, last as usize);
        let share = match self.density {
            Density::Flat { .. } => 1.0 / (last - first + 1) as f64,
            Density::Points(_) => 1.0 / end,
        };
        let amplitude = |i: usize| (2.0 * self.density.at(i as f64 / end) * share).sqrt();
        Ok((first..=last).map(|i| (i, amplitude(i))).collect())
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
            Self::Points(points) => {
                let after = points.partition_point(|point| point[0] <= f).clamp(1, points.len() - 1);
                let [[f0, s0], [f1, s1]] = [points[after - 1], points[after]];
                // A line within rounding of an end of the band counts as on it.
                let along = ((f / f0).ln() / (f1 / f0).ln()).clamp(0.0, 1.0);
                s0 * ((s1 / s0).ln() * along).exp()
            }
        }
    }

    /// Refuses an invalid density.
    fn validate(&self) -> Result<()> {
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
            Self::Points(points) => {
                if points.len() < 2 {
                    let count = format!("{} pairs", points.len());
                    return Err(Error::invalid(key("psd"), count, "two pairs of frequency and density or more"));
                }
                for (i, &[f, s]) in points.iter().enumerate() {
                    positive(key("psd").value(i).part("frequency"), f)?;
                    positive(key("psd").value(i).part("density"), s)?;
                }
                match points.windows(2).position(|pair| pair[1][0] <= pair[0][0]) {
                    None => Ok(()),
                    Some(i) => Err(Error::invalid(
                        key("psd").value(i + 1).part("frequency"),
                        format_args!("{:?}", points[i + 1][0]),
                        format!("more than the one before, {:?}", points[i][0]),
                    )),
                }
            }
        }
    }
}

fn key(part: &'static str) -> Subject {
    Subject::of("random load").part(part)
}
