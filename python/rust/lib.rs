//! The compiled half of the Python package: thin classes over the library, without numerics of
//! their own. What needs no Rust is in `src/signorini/`.

#![deny(unsafe_code)]

mod array;
mod branches;
mod builders;
mod case;
mod derivative;
mod error;
mod json;
mod load;
mod orbit;
mod origin;
mod pickle;
mod place;
mod plan;
mod realisations;
mod run;
mod run_folder;
mod scene;
mod start;
mod stepper;
mod study;
mod subject;
mod sweep;
mod values;
mod wall;
mod wear;
mod work;

use pyo3::prelude::*;

/// The compiled half of the package signorini.
#[pymodule]
mod _core {
    #[pymodule_export]
    use super::branches::{_branches, _report};
    #[pymodule_export]
    use super::builders::{_bar, _beam, _chain, _matrices, _modal, _oscillator};
    #[pymodule_export]
    use super::case::{_case, Case, load};
    #[pymodule_export]
    use super::derivative::{_case_scene_at, _case_value_at, _derivative, _scene_at, _value_at};
    #[pymodule_export]
    use super::error::{
        AccuracyWarning, DivergedError, NotSolvedError, RefutedError, ResultWarning, RunError, TooManyEventsError,
    };
    #[pymodule_export]
    use super::load::Load;
    #[pymodule_export]
    use super::orbit::_orbit;
    #[pymodule_export]
    use super::realisations::_realisations;
    #[pymodule_export]
    use super::run::Run;
    #[pymodule_export]
    use super::scene::Scene;
    #[pymodule_export]
    use super::stepper::Stepper;
    #[pymodule_export]
    use super::study::{_bifurcation, _chart, _compare, _stability};
    #[pymodule_export]
    use super::sweep::{_cautioned, _columns, _placed_columns, _run_many, _sweep, _unit};
    #[pymodule_export]
    use super::values::Rayleigh;
    #[pymodule_export]
    use super::wall::Wall;
    #[pymodule_export]
    use super::wear::_wear;

    #[pymodule_export]
    #[expect(non_upper_case_globals, reason = "Python's name")]
    const __version__: &str = env!("CARGO_PKG_VERSION");

    /// Periods of the load that are run before a motion counts as settled, unless told otherwise.
    #[pymodule_export]
    const _SETTLE: u32 = signorini::orbit::SETTLE;
}
