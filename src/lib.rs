#![doc = include_str!("../docs/library.md")]
//!
//! # The rooms
//!
//! [`Scene`] is what is simulated, [`Scheme`] the time-stepping scheme. [`Stepper`] makes one step
//! at a time, [`run()`] all steps from start to end, checked by [`residual::Judge`], and
//! [`Trajectory`] is the recorded motion. [`qp`] is the convex programme of a step, [`flow`] the
//! exact motion between events, [`variation`] its derivative with respect to the start, [`wear`]
//! the wear by sliding at supports. Case files come with the feature `case`, output and the tool
//! itself with `cli`, which is the default and has `case` in it; the format of a case file is
//! documented in [`case`].
//!
//! # Examples
//!
//! In the folder `examples/`, each run by `cargo run --release --example NAME`:
//! `tube_contact_force` (the contact force of a tube in loose supports), `co_simulation` (a
//! controller in another program, with repeated steps), `work_precision` (what an error costs,
//! scheme by scheme), `poincare` (Poincaré points of an impact oscillator, with the Jacobian from
//! each to the next), `bifurcation` (the same of many at once, by [`batch`]), `hysteresis` (a sweep
//! by rising and falling frequency), `multipliers` (Floquet multipliers along branches of periodic
//! orbits).
#![forbid(unsafe_code)]

pub mod batch;
#[cfg(feature = "case")]
pub mod case;
// For the binary.
#[cfg(feature = "cli")]
#[doc(hidden)]
pub mod cli;
mod contact;
mod elementary;
mod error;
mod finite;
pub mod flow;
mod hash;
mod interrupt;
pub mod linear;
pub mod orbit;
mod order;
// The files that the tool writes; public for its benchmarks and tests.
#[cfg(feature = "cli")]
#[doc(hidden)]
pub mod output;
// For the Python package.
#[doc(hidden)]
pub mod parallel;
pub mod qp;
// The pages of the tool; public for the Python package.
#[cfg(feature = "cli")]
#[doc(hidden)]
pub mod report;
pub mod residual;
mod run;
mod scene;
pub mod scheme;
mod statistics;
mod step;
pub mod study;
#[cfg(feature = "cli")]
pub mod sweep;
mod time;
mod trajectory;
pub mod variation;
#[cfg(feature = "cli")]
mod verification;
pub mod wear;

pub use error::{Cause, Error, Part, Result, Subject};
pub use interrupt::Interrupt;
pub use residual::{Finding, Refuted};
pub use run::{
    Caution, Cautioned, Judged, Judging, NotedRuns, Options, Recorded, Recording, Run, Unjudged, Unrecorded, foreseen,
    run, run_with_progress,
};
pub use scene::{
    Bar, BarEnd, Beam, BeamEnd, BeamSection, Chain, Condensation, Connors, Damping, Face, Flat, Flats, FlowMargin,
    FlowPiece, FlowTube, FluidElastic, FrictionCoefficients, Hole, MOST_DENSE, MOST_ELEMENTS, MOST_FLATS, MOST_MODES,
    MassMatrix, ModalData, ModalPoint, Modes, PlaneRows, Reduction, SectionFault, WallTruncation, heading, matrices,
};
pub use scene::{
    Density, Forcing, Harmonic, Load, LoadKind, Loads, Oscillator, Probe, RandomForce, Row, Scatter, Scene, SceneKey,
    SharedStructure, Side, Slider, State, Structure, Support, System, Table, TimeFunction, Turbulence,
    TurbulenceSpectrum, Wall, WallLaw,
};
pub use scheme::{Counters, Handover, Integrator, Method, PenaltyLaw, Scheme, Stepper, equilibrium};
pub use statistics::{
    ContactPlace, Distribution, EpisodeStatistics, ForceStatistics, Forces, HalfWidths, LargestForce, PlaceKind,
    SectorStatistics, Spectrum, Statistics, Summary, SupportForce, SupportStatistics, WallStatistics, WearStatistics,
    WearTally,
};
pub use step::{
    Balance, Bound, Circle, Conserves, Contact, Contract, Elastic, Friction, Law, Normal, Path, Promise, PromisedForce,
    Reached, Rigid, Step, Tolerance, Tolerances, Turning,
};
pub use time::{MOST_ROWS, MOST_STEPS, TimeGrid, TimeOptions};
pub use trajectory::{EpisodeWear, OutputStates, Recorder, Trajectory};
