//! Many oscillators at once: the exact motion of each from impact to impact, several side by side
//! in the lanes of a processor.
//!
//! [`Lane`] is one oscillator, [`Plan`] says for how long each is computed, and [`Batch`] holds the
//! results: the states once per period of the load, impacts and impulses, extremes, the growth of a
//! small change of the initial state. Sweeps, bifurcation diagrams and basins of attraction are
//! computed from these. Nothing is discretised: every lane agrees with the scheme `event` up to
//! rounding errors, and their growth where the motion is chaotic.
//!
//! Each lane has its own time. It advances in steps of fixed length, which take a few products each
//! (`series.rs`), up to the step in which it could meet a wall, or its period ends. When all lanes
//! have reached such a step, it is computed for all of them together: a power series for the step,
//! the root of the gap by Halley's method, and a bound which proves that no earlier contact was
//! missed (`state.rs`).
//!
//! The result of a lane depends, to the bit, on its own input only, not on its neighbours, its
//! place, or the number of threads. [`Width`] says which results are equal between machines.
//! Oscillators that the lanes do not support (elastic walls, more than four sines, a contact that
//! grazes to within rounding) are computed by the scheme `event`; [`Outcome::by`] says which,
//! [`Batch::handed`] how many.
//!
//! ```
//! use signorini::batch::{Lane, Plan};
//! use signorini::{Load, Scene, Wall};
//!
//! // The same oscillator under sines of 4 to 6 Hz.
//! let lanes: Vec<Lane> = (0..20)
//!     .map(|i| {
//!         let frequency = 4.0 + 0.1 * f64::from(i);
//!         let scene = Scene::oscillator(1.0, 0.2, 100.0)
//!             .with_wall(Wall::upper("upper", 5e-3).with_restitution(0.8))
//!             .with_wall(Wall::lower("lower", -5e-3).with_restitution(0.8))
//!             .with_load(Load::harmonic(3.0, frequency, 0.0));
//!         Lane::of(&scene, 1.0 / frequency)
//!     })
//!     .collect::<Result<_, _>>()?;
//! let batch = Plan::new(100, 20).run(&lanes)?;
//! let last = batch.strobes(0)[19];
//! assert!(last[0].abs() <= 5e-3);
//! assert!(batch.outcomes()[0].as_ref().is_ok_and(|outcome| outcome.upper.impulse <= 0.0));
//! # Ok::<(), signorini::Error>(())
//! ```
//!
//! # Files
//!
//! Many oscillators at once, exactly: `lane.rs` (one oscillator), `plan.rs` (durations and
//! threads), `outcome.rs`; `series.rs` holds the constants of a lane, `state.rs` advances it,
//! `stretch.rs` finds impacts, `rest.rs` treats contact that lasts, `slots.rs` assigns oscillators
//! to lanes, `work.rs` shares a batch between lanes and the exact scheme, `engine.rs` is the loop,
//! `vector.rs` the arithmetic over pulp, `width.rs` the instruction sets; `fallback.rs` runs by the
//! exact scheme the oscillators that lanes do not cover.

mod engine;
mod fallback;
mod lane;
mod outcome;
mod plan;
mod rest;
mod series;
mod slots;
mod state;
mod stretch;
mod vector;
mod width;
mod work;

pub use lane::{Lane, LaneWall, Sine};
pub use outcome::{AtWall, Batch, By, Outcome};
pub use plan::Plan;
pub use width::Width;
