//! The one error type of the crate.
//!
//! # Files
//!
//! The one error type, its words (`words.rs`), what it refers to (`subject.rs`) and its cause
//! (`cause.rs`); `is_request` separates a wrong request (exit code 2) from a failed run (exit code
//! 1); `escape.rs` writes control characters of names as `\u{1b}`;
//! `names.rs` names the values of enums.

mod cause;
mod escape;
mod names;
mod subject;
mod words;

pub use cause::Cause;
pub(crate) use cause::unnumbered;
pub(crate) use escape::{escaped, escaped_lines};
pub(crate) use names::names;
pub use subject::{Part, Subject};
#[cfg(feature = "case")]
pub(crate) use words::nearest;
pub(crate) use words::{amount, counted, named};

use std::fmt;

/// Everything that can fail, with the data that locate the fault: key, value, time, step, wall.
///
/// [`Error::is_request`] separates a request that no run could meet (bad scene, unknown name: exit
/// code 2 of the tool) from a run that failed (exit code 1).
#[derive(Debug, Clone, PartialEq)]
#[non_exhaustive]
pub enum Error {
    /// An invalid value of the scene, the scheme or the time grid.
    Invalid {
        /// Path to the value, for example `wall "upper": restitution`.
        subject: Subject,
        /// The value found, as text.
        value: String,
        /// What would be accepted.
        expected: String,
    },
    /// A name that does not exist (of a wall, a probe, a scheme, a case).
    Unknown {
        /// What kind of thing was named, for example `wall`.
        kind: &'static str,
        /// The name asked for.
        name: String,
        /// The names that exist.
        known: Vec<String>,
    },
    /// A case file that cannot be read.
    Case {
        /// What is wrong, with file, line and column.
        report: String,
        /// The error reported by the reader of the text, or by the library for the value.
        cause: Option<Cause>,
    },
    /// A file or folder that cannot be read or written.
    Io {
        /// The path.
        path: String,
        /// Reason given by the operating system, or by the reader of the format.
        reason: String,
        /// True while reading a request or opening the output; false once a run has started.
        request: bool,
        /// The error of the operating system, or of the reader of the format.
        cause: Option<Cause>,
    },
    /// A folder that holds the results of another request, which are not replaced unless that is
    /// asked for.
    OtherResults {
        /// The folder.
        path: String,
        /// When they were made, and what differs.
        reason: String,
    },
    /// The convex programme of a step was not solved.
    Qp {
        /// Time at the start of the step, s.
        time: f64,
        /// Number of the step, from 0.
        step: u64,
        /// Name of the wall concerned, when one is.
        wall: Option<String>,
        /// What failed.
        reason: String,
        /// The solver's error, when it gave one: a [`crate::qp::Failure`].
        cause: Option<Cause>,
    },
    /// Newton's method did not converge within a step.
    Newton {
        /// Time at the start of the step, s.
        time: f64,
        /// Number of the step, from 0.
        step: u64,
        /// Last residual force, N.
        residual: f64,
    },
    /// The state became NaN or infinite.
    NotFinite {
        /// Time at the end of the step, s.
        time: f64,
        /// Number of the step, from 0.
        step: u64,
        /// What is no longer finite.
        what: &'static str,
    },
    /// The run is far faster than the energy of its start and the work of its loads allow.
    Diverged {
        /// Time at which that was seen, s.
        time: f64,
        /// Number of steps made.
        step: u64,
        /// Its speed over the largest that start and loads can give.
        ratio: f64,
        /// The likely cause.
        cause: String,
    },
    /// More contact events than the bound allows in a window: the exact scheme gives up instead of
    /// running for ever.
    TooManyEvents {
        /// Time at which it gave up, s.
        time: f64,
        /// Name of the wall last touched.
        wall: String,
        /// Events counted in the window.
        count: u64,
        /// Length of the window, s.
        window: f64,
    },
    /// The error asked for was not reached with the largest number of steps allowed.
    Inaccurate {
        /// The error asked for.
        tolerance: f64,
        /// The error reached, or the last change where there is no exact motion.
        reached: f64,
        /// The quantity with the largest error.
        quantity: String,
        /// Time up to which the displacement kept the tolerance, s.
        until: f64,
        /// Steps of the finest run.
        steps: u64,
    },
    /// The interval asked for was not reached with the largest number of realisations allowed.
    Scattered {
        /// The half width asked for, as a share of the mean.
        share: f64,
        /// The one reached.
        reached: f64,
        /// The quantity with the widest interval.
        quantity: String,
        /// Realisations that were run.
        count: u64,
        /// Realisations that are needed.
        needed: u64,
    },
    /// A part of the error of a mean over realisations is larger than was asked for, or may be.
    Biased {
        /// Which part: `start`, `step` or `modes`.
        part: &'static str,
        /// The largest share of the mean that was asked for.
        tolerance: f64,
        /// The share that it has at most, by its 95 % interval; infinite where it is not known.
        reached: f64,
        /// Whether its interval leaves out 0.
        seen: bool,
        /// The mean with the largest such part.
        quantity: String,
        /// What keeps it from being smaller, or from being known.
        why: String,
    },
    /// Checks of a result failed, so that its error is not known; the result itself stands.
    Unchecked {
        /// What was refined in them, in words.
        checks: Vec<String>,
    },
    /// Adding modes still changes impulses or peaks at walls by more than was allowed.
    Truncated {
        /// The change that was allowed.
        tolerance: f64,
        /// The last change.
        reached: f64,
        /// The quantity with that change.
        quantity: String,
        /// The most modes that were tried.
        modes: usize,
    },
    /// An [`Interrupt`](crate::Interrupt) stopped the computation.
    Stopped,
    /// Runs that violated what their schemes promise: the judge's findings, in words.
    Refuted {
        /// The runs, each with its findings.
        runs: Vec<String>,
    },
    /// Values of the verification manual that are not within their tolerances.
    Unverified {
        /// The values, each with its case.
        values: Vec<String>,
    },
    /// A periodic orbit was looked for and not found, or a branch of orbits could not be followed.
    NoOrbit {
        /// Why.
        reason: String,
    },
    /// The motion is predictable for a shorter time than the run lasts.
    Unpredictable {
        /// The error asked for.
        tolerance: f64,
        /// The error reached up to the horizon.
        reached: f64,
        /// Time at which rounding has grown to a quarter of the error asked for, s.
        horizon: f64,
        /// End of the run, s.
        end: f64,
    },
}

/// Result of every function of the crate that can fail.
pub type Result<T> = std::result::Result<T, Error>;

impl Error {
    /// An [`Error::Invalid`].
    pub(crate) fn invalid(subject: impl Into<Subject>, value: impl fmt::Display, expected: impl Into<String>) -> Self {
        Self::Invalid { subject: subject.into(), value: value.to_string(), expected: expected.into() }
    }

    /// An [`Error::Io`], of a wrong request or not.
    pub(crate) fn io(path: impl fmt::Display, reason: impl Into<String>, request: bool) -> Self {
        Self::Io { path: path.to_string(), reason: unnumbered(&reason.into()), request, cause: None }
    }

    /// An [`Error::Qp`]: the programme of the step that starts at `time` (s) was not solved, and
    /// `failure` says why.
    pub(crate) fn qp(
        (time, step): (f64, u64),
        wall: Option<String>,
        failure: impl std::error::Error + Send + Sync + 'static,
    ) -> Self {
        Self::Qp { time, step, wall, reason: failure.to_string(), cause: Some(Cause::new(failure)) }
    }

    /// An [`Error::NoOrbit`].
    pub(crate) fn no_orbit(reason: impl Into<String>) -> Self {
        Self::NoOrbit { reason: reason.into() }
    }

    /// The same error with its cause, for variants that have one.
    pub(crate) fn caused_by(mut self, error: impl std::error::Error + Send + Sync + 'static) -> Self {
        if let Self::Case { cause, .. } | Self::Io { cause, .. } = &mut self {
            *cause = Some(Cause::new(error));
        }
        self
    }

    /// The error of a value of a case file without its place there, where it has one.
    #[cfg(feature = "cli")]
    pub(crate) fn without_place(self) -> Self {
        match &self {
            Self::Case { cause: Some(cause), .. } => cause.error().downcast_ref().cloned().unwrap_or(self),
            _ => self,
        }
    }

    /// True where the request was wrong (exit code 2 of the tool), false where the run failed (exit
    /// code 1).
    #[must_use]
    pub fn is_request(&self) -> bool {
        match self {
            Self::Invalid { .. } | Self::Unknown { .. } | Self::Case { .. } | Self::OtherResults { .. } => true,
            Self::Io { request, .. } => *request,
            _ => false,
        }
    }
}

impl std::error::Error for Error {
    fn source(&self) -> Option<&(dyn std::error::Error + 'static)> {
        match self {
            Self::Case { cause, .. } | Self::Io { cause, .. } | Self::Qp { cause, .. } => {
                cause.as_ref().map(Cause::error)
            }
            _ => None,
        }
    }
}
