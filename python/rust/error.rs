//! The library's errors as Python's exceptions.

use pyo3::create_exception;
use pyo3::exceptions::{PyOSError, PyRuntimeError, PyTypeError, PyUserWarning, PyValueError};
use pyo3::prelude::*;
use signorini::Error;

create_exception!(signorini, RunError, PyRuntimeError, "A run that failed on its way.");
create_exception!(
    signorini,
    DivergedError,
    RunError,
    "The run is far faster than its start and its loads can make it, or its state became infinite or NaN. ``run`` \
     holds its rows up to there, if there is one."
);
create_exception!(signorini, TooManyEventsError, RunError, "More contact events than the exact scheme follows.");
create_exception!(signorini, NotSolvedError, RunError, "The equations of a step were not solved.");
create_exception!(
    signorini,
    RefutedError,
    RunError,
    "A run broke what its scheme promises: do not use its numbers. ``run`` holds it, for inspection, if there is \
     one; of several runs ``study`` holds what was found."
);

create_exception!(
    signorini,
    ResultWarning,
    PyUserWarning,
    "A note that concerns the results of a run; ``Run.notes`` has all notes."
);
create_exception!(signorini, AccuracyWarning, PyUserWarning, "The accuracy asked for is not kept to the end.");

/// The exception of an error: `ValueError` for a wrong request, `OSError` for a file, `RunError`
/// for a run that failed.
pub fn raise(error: Error) -> PyErr {
    let text = error.to_string();
    match &error {
        Error::Io { .. } => PyOSError::new_err(text),
        Error::OtherResults { .. } => PyOSError::new_err(text + "\nhelp: give another folder, or remove this one"),
        Error::NotFinite { .. } | Error::Diverged { .. } => DivergedError::new_err(text),
        Error::TooManyEvents { .. } => TooManyEventsError::new_err(text),
        Error::Qp { .. } | Error::Newton { .. } => NotSolvedError::new_err(text),
        Error::Refuted { .. } => RefutedError::new_err(text),
        error if error.is_request() => PyValueError::new_err(text),
        _ => RunError::new_err(text),
    }
}

/// A `ValueError` in the form of the library's: what, the value found, what would be accepted.
pub fn wrong(what: &str, found: impl std::fmt::Display, expected: &str) -> PyErr {
    PyValueError::new_err(format!("{what} is {found}; expected {expected}"))
}

/// A `TypeError`: the object found, what would be accepted. Python adds the argument's name.
pub fn wrong_type(found: &Bound<'_, PyAny>, expected: &str) -> PyErr {
    let text = found.repr().map_or_else(|_| "an object without a representation".to_owned(), |text| text.to_string());
    PyTypeError::new_err(format!("{text}; expected {expected}"))
}
