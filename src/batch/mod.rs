//! Many oscillators at once: the exact motion of each from impact to impact, several side by side
//! in the lanes of a processor.
//!
//! [`Lane`] is one oscillator, [`Plan`] says how long each is followed, and [`Batch`] is what came
//! of them: the states once a period of the load, impacts and impulses, extremes, the growth of a
//! change of the start. It is what sweeps, bifurcation diagrams and basins of attraction are made
//! of. Nothing is discretised: every lane agrees with the scheme `event` to rounding, and to what
//! the motion itself makes of rounding.
//!
//! Each lane is at its own instant. It marches in steps of fixed length, for which its motion is a
//! few products (`series.rs`), up to the step on which it could meet a wall, or its period ends.
//! When all lanes have come to such a step, one round serves them together: a power series for the
//! step, the root of the gap by Halley's method, and a certificate that nothing was missed before
//! it (`state.rs`).
//!
//! Bits. What a lane computes depends on its own numbers alone, not on its neighbours, its place,
//! or the number of threads. See [`Width`] for what holds from machine to machine. Oscillators that
//! the lanes do not hold (elastic walls, more than four sines, a graze to rounding) are followed by
//! the scheme `event`; [`Outcome::by`] says which, [`Batch::handed`] how many.
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

mod engine;
mod handed;
mod lane;
mod outcome;
mod plan;
mod rest;
mod seat;
mod series;
mod state;
mod stretch;
mod vector;
mod width;
mod work;

pub use lane::{Lane, Sine, Stop};
pub use outcome::{AtWall, Batch, By, Outcome};
pub use plan::Plan;
pub use width::Width;
