//! signorini
#![forbid(unsafe_code)]

#[cfg(feature = "cli")]
pub mod case;
#[cfg(feature = "cli")]
pub mod cli;
mod contact;
mod error;
pub mod flow;
mod notes;
#[cfg(feature = "cli")]
pub mod output;
pub mod qp;
pub mod residual;
mod run;
mod scene;
pub mod scheme;
mod statistics;
mod step;
#[cfg(feature = "cli")]
pub mod study;
mod time;
mod trajectory;

pub use error::{Error, Result};
pub use run::{Options, Run, run, run_with_progress};
pub use scene::{
    Forcing, Harmonic, Load, LoadKind, Oscillator, Probe, Row, Scene, Side, State, System, Table, Wall, WallLaw,
};
pub use scheme::{Counters, Integrator, Method, PenaltyLaw, Scheme, Stepper};
pub use statistics::{Statistics, Summary, WallStatistics};
pub use step::{Balance, Contact, Contract, Path, Promise, Step};
pub use time::{MOST_ROWS, MOST_STEPS, TimeGrid, TimeOptions};
pub use trajectory::{Recorder, Trajectory};
