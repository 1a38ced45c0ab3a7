//! Scenes and the case files that describe them.

#[path = "../support/draws.rs"]
mod draws;
#[path = "../support/refused.rs"]
mod refused;

#[cfg(feature = "cli")]
mod base_motion;
#[cfg(feature = "cli")]
mod bodies;
#[cfg(feature = "cli")]
mod case_errors;
#[cfg(feature = "cli")]
mod case_errors_planes;
#[cfg(feature = "cli")]
mod case_files;
#[cfg(feature = "cli")]
mod case_mutations;
#[cfg(feature = "cli")]
mod chosen_step;
mod error_subjects;
mod fluid_elastic;
#[cfg(feature = "cli")]
mod massless;
mod modes;
#[cfg(feature = "cli")]
mod psd;
mod serialised;
mod structures;
#[cfg(feature = "cli")]
mod support_files;
#[cfg(feature = "cli")]
mod turbulence;
mod turbulence_modal;
#[cfg(feature = "cli")]
mod wrong_requests;
