//! Pickles: the bytes of a value, behind the version of the package that wrote them.

use pyo3::exceptions::{PyTypeError, PyValueError};
use pyo3::prelude::*;
use pyo3::types::PyBytes;
use serde::Serialize;
use serde::de::DeserializeOwned;

/// Version and bytes.
pub type State<'py> = (&'static str, Bound<'py, PyBytes>);
/// What `__reduce__` returns: the function that restores an object, and its arguments.
pub type Reduced<'py, A> = (Bound<'py, PyAny>, A);

const VERSION: &str = env!("CARGO_PKG_VERSION");

/// The bytes of `value`, and the version that can read them.
pub fn pickled<'py, T: Serialize>(py: Python<'py>, value: &T) -> PyResult<State<'py>> {
    let bytes = postcard::to_stdvec(value).map_err(|error| {
        PyTypeError::new_err(format!("cannot be pickled, because it holds a Python function as a load: {error}"))
    })?;
    Ok((VERSION, PyBytes::new(py, &bytes)))
}

/// The value of which these are the bytes.
pub fn unpickled<T: DeserializeOwned>(version: &str, bytes: &[u8]) -> PyResult<T> {
    if version != VERSION {
        let text = format!("pickled by signorini {version}, and this is {VERSION}: use one version on all machines");
        return Err(PyValueError::new_err(text));
    }
    postcard::from_bytes(bytes).map_err(|error| PyValueError::new_err(format!("not a pickle of this class: {error}")))
}
