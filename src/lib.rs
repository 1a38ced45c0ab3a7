//! signorini
#![forbid(unsafe_code)]

mod contact;
mod error;
pub mod flow;
mod notes;
pub mod qp;
pub mod residual;
pub mod run;
mod scene;
mod scheme;
pub mod statistics;
mod step;
mod trajectory;

pub use error::{Error, Result};
pub use run::{Options, Run, TimeGrid, run};
pub use scene::{
    Forcing, Harmonic, Load, LoadKind, Oscillator, Probe, Row, Scene, Side, State, System, Table, Wall, WallLaw,
};
pub use scheme::{Counters, Integrator, PenaltyLaw, Scheme, Stepper};
pub use step::{Balance, Contact, Contract, Path, Promise, Step};
pub use trajectory::{Recorder, Trajectory};
