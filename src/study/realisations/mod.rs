//! Realisations of random loads: the same scene under signals of the same density and other seeds.
//!
//! Under a random load, the mean force of a run is one draw. N independent realisations give the
//! mean x̄, the standard deviation s of one of them, and the 95 % interval x̄ ± t s/√N of the mean,
//! with t of Student's distribution with N − 1 degrees of freedom. It is an interval for the
//! expectation over all realisations of this density and this duration; errors of the step, the
//! modes and the data are not in it. The first two, and that of a window that begins too early, are
//! therefore estimated from the same realisations, and stand beside it ([`ErrorParts`]).
//! [`RealisationPlan`] is a whole study: the number of realisations that an interval needs, the
//! realisations, and the checks for the errors. [`StepSearch`] finds the coarsest step of such a
//! study whose part in the errors is within a share that is named beforehand.
//!
//! ```
//! use signorini::study::realisations::{Measure, Realisations, realisations};
//! use signorini::{Density, Options, RandomForce, Scene, Scheme, Wall};
//!
//! let density = Density::Flat { rms: 3.0, from: 1.0, to: 20.0 };
//! let scene = |number: u64| {
//!     let force = RandomForce { density: density.clone(), seed: number, stream: 0 };
//!     let scene = Scene::oscillator(1.0, 2.0, 400.0).with_wall(Wall::upper("stop", 2e-3).with_restitution(0.5));
//!     Ok(scene.with_load(force.load(5.0)?).with_duration(5.0))
//! };
//! let method = Scheme::MoreauJean { theta: 0.5 }.into();
//! let members = realisations(1..=4, &scene, &method, &Options::with_step(1e-3), &mut |_| {})?;
//! let study = Realisations::new(members);
//! let force = study.estimates.iter().find(|one| one.measure == Measure::ForceMean).expect("there is a wall");
//! println!("{:.3} ± {:.3} N", force.mean, force.half_width_95.expect("four realisations"));
//! # Ok::<(), signorini::Error>(())
//! ```

mod batch;
mod check;
mod count;
mod counted;
mod deepest;
mod error_parts;
mod estimate;
mod found_step;
mod groups;
mod known;
mod measure;
mod paired;
mod plan;
mod realisation;
mod runner;
mod sample;
mod stein;
mod step_search;
mod time_limit;
mod verdict;

pub use batch::{Batch, Purpose, RandomScenes};
pub use check::{Check, MOST_CHECKED, Refined, checked};
pub use count::{MOST_REALISATIONS, PILOTS, Pilots, RealisationCount};
pub(crate) use deepest::Deepest;
pub use error_parts::{ErrorPart, ErrorParts};
pub(crate) use estimate::mean_of;
pub use estimate::{Estimate, Interval, Refinement};
pub use found_step::FoundStep;
pub use groups::{Groups, PlaceGroups};
pub use known::KnownRealisations;
pub use measure::{Figure, Measure};
pub use paired::Difference;
#[cfg(feature = "cli")]
pub(crate) use plan::shortfall;
pub use plan::{FailedCheck, RealisationPlan, RealisationStudy};
pub use realisation::Realisation;
pub use runner::realisations;
pub use sample::Realisations;
pub use stein::{NeededRealisations, widest};
pub use step_search::StepSearch;
pub use time_limit::TimeLimit;
