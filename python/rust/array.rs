//! Columns of a run as NumPy arrays that share its memory.

#![allow(unsafe_code)]

use numpy::ndarray::ArrayView1;
use numpy::{PyArray1, PyArrayMethods};
use pyo3::PyClass;
use pyo3::prelude::*;
use pyo3::pyclass::boolean_struct::True;

/// A vector of numbers.
pub type Array<'py> = Bound<'py, PyArray1<f64>>;

/// A read-only array over `column`, which has to belong to `owner` and to stay as it is while that
/// lives. The class is frozen: no Python code can change its fields.
pub fn view<'py, T: PyClass<Frozen = True>>(owner: &Bound<'py, T>, column: &[f64]) -> Array<'py> {
    let view = ArrayView1::from(column);
    // SAFETY: the array keeps `owner` alive, and nothing writes, moves or drops the column before.
    let array = unsafe { PyArray1::borrow_from_array(&view, owner.clone().into_any()) };
    array.readwrite().make_nonwriteable();
    array
}
