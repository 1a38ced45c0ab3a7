//! The power spectral density of a turbulent force per length.

use crate::error::{Error, Result, Subject};
use crate::scene::random::{straight_in_logarithms, validate_points};
use crate::scene::system::{nonnegative, positive};
use serde::{Deserialize, Serialize};

/// Values within this share of an end of a spectrum count as on it.
const ON_END: f64 = 1e-9;

/// The one-sided power spectral density of a force per length, (N/m)²/Hz.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[non_exhaustive]
pub enum TurbulenceSpectrum {
    /// The same along the whole stretch: pairs of a frequency (Hz) and a density ((N/m)²/Hz),
    /// straight between them in logarithms of both, zero outside.
    Even(Vec<[f64; 2]>),
    /// That of a cross flow on a tube,
    ///
    /// S(x, f) = (½ρV²D)² (D/V) Φ(fD/V),
    ///
    /// as in code_aster's Reference Manual, R4.07.02, but for V in fD/V, which is the local one.
    Flow {
        /// Density ρ of the fluid, kg/m³.
        density: f64,
        /// Outer diameter D of the tube, m.
        diameter: f64,
        /// Velocity V of the fluid in the gaps at the middle of each cell, m/s; 0 or more.
        velocity: Vec<f64>,
        /// Pairs of a reduced frequency fD/V and Φ there, straight in logarithms, zero outside.
        reduced: Vec<[f64; 2]>,
    },
}

impl TurbulenceSpectrum {
    /// Refuses what is no spectrum of `cells` cells.
    pub(super) fn validate(&self, subject: &Subject, cells: usize) -> Result<()> {
        let key = |part: &'static str| subject.clone().part(part);
        match self {
            Self::Even(points) => validate_points(&key("spectrum"), points, ["frequency", "density"]),
            Self::Flow { density, diameter, velocity, reduced } => {
                positive(key("density"), *density)?;
                positive(key("diameter"), *diameter)?;
                if velocity.len() != cells {
                    let value = format!("{} values", velocity.len());
                    return Err(Error::invalid(key("velocity"), value, format!("one of each of {cells} cells")));
                }
                velocity.iter().try_for_each(|v| nonnegative(key("velocity"), *v))?;
                validate_points(&key("reduced"), reduced, ["reduced frequency", "reduced density"])
            }
        }
    }

    /// The density in `cell` at the frequency `f` (Hz), (N/m)²/Hz.
    #[must_use]
    pub fn at(&self, cell: usize, f: f64) -> f64 {
        match self {
            Self::Even(points) => within(points, f),
            Self::Flow { density, diameter, velocity, reduced } => match velocity.get(cell) {
                Some(&v) if v > 0.0 => {
                    let pressure = 0.5 * density * v * v * diameter;
                    pressure * pressure * (diameter / v) * within(reduced, f * diameter / v)
                }
                _ => 0.0,
            },
        }
    }

    /// The frequencies (Hz) between which the density in `cell` is not zero.
    #[must_use]
    pub fn band(&self, cell: usize) -> [f64; 2] {
        let ends = |points: &[[f64; 2]], scale: f64| {
            [points.first(), points.last()].map(|point| scale * point.map_or(0.0, |point| point[0]))
        };
        match self {
            Self::Even(points) => ends(points, 1.0),
            Self::Flow { diameter, velocity, reduced, .. } => {
                ends(reduced, velocity.get(cell).copied().unwrap_or(0.0) / diameter)
            }
        }
    }
}

/// The value at `x` between the points, zero beyond them.
fn within(points: &[[f64; 2]], x: f64) -> f64 {
    let (Some([first, _]), Some([last, _])) = (points.first(), points.last()) else { return 0.0 };
    if x < first * (1.0 - ON_END) || x > last * (1.0 + ON_END) { 0.0 } else { straight_in_logarithms(points, x) }
}
