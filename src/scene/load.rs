//! Loads: forces that are given functions of time.

use super::function::TimeFunction;
use super::row::Row;
use super::system::{finite, nonnegative};
use super::table::Table;
use crate::error::{Error, Result, Subject};
use serde::{Deserialize, Serialize};
use std::f64::consts::TAU;

/// The time dependence of a load.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[non_exhaustive]
pub enum LoadKind {
    /// A constant force.
    Constant {
        /// Force, N.
        force: f64,
    },
    /// amplitude · sin(2π frequency t + phase).
    Harmonic {
        /// Amplitude, N.
        amplitude: f64,
        /// Frequency, Hz.
        frequency: f64,
        /// Phase, rad.
        phase: f64,
    },
    /// A blow, that is an impulsive load: the momentum jumps by `impulse` at `time`.
    Impulse {
        /// Impulse, N s.
        impulse: f64,
        /// Time, s; zero or more.
        time: f64,
    },
    /// Tabulated, linear between rows, zero outside.
    Table(Table),
    /// Any function of time, for the stepping schemes, which evaluate it at the ends of their
    /// steps. The exact scheme needs the motion in closed form and refuses it; [`Table::sampled`]
    /// makes a table of it with a stated error. It cannot be serialised.
    #[serde(skip)]
    Function(TimeFunction),
}

/// One load and the row through which it acts. Loads add up.
///
/// ```
/// use signorini::{Load, Options, Row, Scene, Scheme, Table, Wall, run};
///
/// // A sine of 3 N at 5 Hz; half a newton second at 0.2 s; a ramp from a table; a chirp of 10 to
/// // 20 Hz as a Rust closure.
/// let sine = Load::harmonic(3.0, 5.0, 0.0);
/// let blow = Load::impulse(0.5, 0.2);
/// let ramp = Load::table(Table::new(vec![0.0, 1.0], vec![0.0, 2.0])?);
/// let chirp = Load::function(|t| (std::f64::consts::TAU * (10.0 + 5.0 * t) * t).sin());
///
/// let stop = Wall::upper("stop", 5e-3).with_restitution(0.5);
/// let scene = Scene::oscillator(1.0, 0.2, 100.0).with_wall(stop);
/// let scene = [sine, blow, ramp, chirp].into_iter().fold(scene, Scene::with_load);
/// let run = run(&scene, &Scheme::MoreauJean { theta: 0.5 }, &Options::with_step(1e-4))?;
/// assert!(run.trajectory.impulse("stop")? < 0.0);
///
/// // On a structure a load acts through a row: here on the relative motion of two of its degrees
/// // of freedom.
/// let between = Load { at: Row::new(vec![(0, 1.0), (1, -1.0)]), ..Load::constant(1.0) };
/// assert_eq!(between.at.dot(&[0.3, 0.1]), 0.3 - 0.1);
/// # Ok::<(), signorini::Error>(())
/// ```
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Load {
    /// Its time dependence.
    pub kind: LoadKind,
    /// The row through which it acts.
    pub at: Row,
}

impl Load {
    /// A constant force (N) on the first degree of freedom.
    #[must_use]
    pub fn constant(force: f64) -> Self {
        Self::on_first(LoadKind::Constant { force })
    }

    /// amplitude · sin(2π frequency t + phase) on the first degree of freedom: N, Hz, rad.
    #[must_use]
    pub fn harmonic(amplitude: f64, frequency: f64, phase: f64) -> Self {
        Self::on_first(LoadKind::Harmonic { amplitude, frequency, phase })
    }

    /// An impulse (N s) at a time (s) on the first degree of freedom.
    #[must_use]
    pub fn impulse(impulse: f64, time: f64) -> Self {
        Self::on_first(LoadKind::Impulse { impulse, time })
    }

    /// A tabulated force on the first degree of freedom.
    #[must_use]
    pub fn table(table: Table) -> Self {
        Self::on_first(LoadKind::Table(table))
    }

    /// The force `f`(t) (N, with t in s) on the first degree of freedom: see
    /// [`LoadKind::Function`]. It must depend on the time only: a scheme may evaluate it at one
    /// instant more than once, and the judge evaluates it again.
    #[must_use]
    pub fn function(f: impl Fn(f64) -> f64 + Send + Sync + 'static) -> Self {
        Self::on_first(LoadKind::Function(TimeFunction::new(f)))
    }

    fn on_first(kind: LoadKind) -> Self {
        Self { kind, at: Row::dof(0) }
    }

    pub(crate) fn validate(&self, index: usize) -> Result<()> {
        let key = |what: &'static str| Subject::nth("load", index).part(what);
        match &self.kind {
            LoadKind::Constant { force } => finite(key("force"), *force),
            LoadKind::Harmonic { amplitude, frequency, phase } => {
                finite(key("amplitude"), *amplitude)?;
                nonnegative(key("frequency"), *frequency)?;
                if !(TAU * frequency).is_finite() {
                    let expected = "a frequency whose circular one, in rad/s, is a finite number";
                    return Err(Error::invalid(key("frequency"), format_args!("{frequency:?}"), expected));
                }
                finite(key("phase"), *phase)
            }
            LoadKind::Impulse { impulse, time } => {
                finite(key("impulse"), *impulse)?;
                nonnegative(key("time"), *time)
            }
            LoadKind::Table(_) => Ok(()),
            LoadKind::Function(function) => finite(key("f(0)"), function.at(0.0)),
        }
    }
}
