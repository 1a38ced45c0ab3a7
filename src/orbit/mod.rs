//! Periodic orbits: found, corrected to rounding, with their stability from Floquet multipliers.
//!
//! An orbit is its *signature*, the cyclic list of its events (which wall, and what happens there),
//! and the instant and speed of each event. These are the unknowns of its equations ("explicit
//! times"): the flow between two events is known in closed form, and the equations stay analytic
//! where an impact becomes grazing, at which the map from period to period has a singularity
//! (Nordmark 1991, doi:10.1016/0022-460X(91)90592-8).
//!
//! [`Problem`] takes a scene of one degree of freedom; [`Problem::settled`] finds the orbit on
//! which a run settles, [`closed_forms`] lists all with one impact per period of the orbit,
//! [`Problem::correct`] solves the equations from any start, [`Problem::floquet`] gives the
//! multipliers, [`Problem::admissible`] says whether a body can follow the orbit, and
//! [`Problem::judge`] makes an exact run over it. [`branch`] follows orbits over a key. For
//! structures, [`shoot`] finds the orbit on which a run settles, and [`branch`] follows it by one
//! of its states.
//!
//! # Files
//!
//! Periodic orbits, of one degree of freedom unless said otherwise: `signature.rs` and
//! `periodic.rs` are an orbit, `problem.rs` the scene it is looked for in and `boundary.rs` its
//! walls, `equations.rs` its equations with explicit times, `newton.rs` solves them, `settled.rs`
//! starts from a run seen by `watch.rs`, `closed.rs` lists orbits of one impact in closed form for
//! any number of degrees of freedom, `floquet.rs` has the multipliers, `admissible.rs` and
//! `extremes.rs` check that walls are not passed, `flights.rs` gives the motion from event to
//! event, `judge.rs` lets the exact scheme run once around, `symmetry.rs` finds the
//! mirror of a scene; `branch/` follows orbits over a key: `branch/arclength.rs` is
//! what all curves share (steps, corrections, points located between two), `branch/line.rs` what
//! any curve of orbits can do, `branch/net.rs` joins branches, `branch/graph.rs` begins; of one
//! degree of freedom `branch/curve.rs` is a branch as a curve over the scenes of
//! `branch/family.rs`, with the derivative by the key of `key_column.rs`, `branch/follow.rs` steps
//! along it, `branch/events.rs` has the test functions, `branch/switch.rs` finds the branch that
//! begins there, `branch/locus.rs` follows special points over two keys; `branch/shots/` are
//! branches of structures: `branch/shots/step_start.rs` is what is known at a point,
//! `branch/shots/correct.rs` the points beside it, `branch/shots/follow.rs` the steps,
//! `branch/shots/moved.rs` moves the strobe, `branch/shots/change.rs` and `branch/shots/graze.rs`
//! find where the walls that are met change, `branch/shots/switch.rs` the branches that begin
//! there; `shooting.rs` finds orbits of structures, by `strobe.rs` and the runs of `orbit_run.rs`,
//! `path.rs` is the motion of one at a place, and `shot_derivative.rs` differentiates them by keys,
//! as `orbit_derivative.rs` (with `monodromy_derivative.rs` for the multipliers) those of one
//! degree of freedom; it imports no case.

mod admissible;
mod boundary;
pub mod branch;
mod closed;
mod equations;
mod extremes;
mod flights;
mod floquet;
mod judge;
mod key_column;
mod monodromy_derivative;
mod newton;
mod orbit_derivative;
mod orbit_run;
#[cfg(feature = "cli")]
mod path;
mod periodic;
mod problem;
mod settled;
mod shooting;
mod shot_derivative;
mod signature;
pub(crate) mod strobe;
mod symmetry;
mod watch;

pub use admissible::{Admissible, Nearest};
pub use closed::{ClosedForm, closed_forms};
pub use floquet::Floquet;
pub use judge::{Instant, Judged, WallShare};
pub use orbit_derivative::OrbitDerivative;
#[cfg(feature = "cli")]
pub(crate) use path::path;
pub use periodic::Orbit;
pub use problem::Problem;
pub use settled::SETTLE;
pub use shooting::{Shot, shoot};
pub use shot_derivative::ShotDerivative;
pub use signature::{Event, Kind, MOST_EVENTS, MOST_PERIODS, Signature};
pub use strobe::Strobe;
