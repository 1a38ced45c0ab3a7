"""Matrices of NumPy and SciPy as entries."""

from __future__ import annotations

from typing import Any

import numpy as np
import numpy.typing as npt

Entries = tuple[npt.NDArray[np.int64], npt.NDArray[np.int64], npt.NDArray[np.float64]]

# Assembled matrices are symmetric to the rounding of their sums.
_ASYMMETRY = 1e-9


def lower(name: str, matrix: Any) -> tuple[int, Entries]:
    """Size and the entries of the lower triangle of a symmetric matrix."""
    if hasattr(matrix, "tocoo"):
        coo = matrix.tocoo()
        shape, rows, columns, values = coo.shape, coo.row, coo.col, coo.data
    else:
        full = np.asarray(matrix)
        if full.ndim != 2:
            raise ValueError(f"{name} matrix is of shape {full.shape}; expected (n, n)")
        shape = full.shape
        rows, columns = np.nonzero(full)
        values = full[rows, columns]
    if shape[0] != shape[1] or shape[0] == 0:
        raise ValueError(f"{name} matrix is of shape {tuple(shape)}; expected (n, n), n from 1")
    values = np.asarray(values)
    if values.dtype.kind not in "fiub":
        raise TypeError(f"{name} matrix is of dtype {values.dtype}; expected real numbers")
    values = values.astype(np.float64)
    n = int(shape[0])
    # Duplicates of a sparse matrix are summed, so triangles are compared as sums over one key.
    key = np.maximum(rows, columns).astype(np.int64) * n + np.minimum(rows, columns)
    sign = np.sign(np.asarray(rows, np.int64) - np.asarray(columns, np.int64))
    keys, where = np.unique(key, return_inverse=True)
    skew = np.bincount(where, weights=sign * values, minlength=len(keys))
    size = np.bincount(where, weights=np.abs(values), minlength=len(keys))
    wrong = np.flatnonzero(np.abs(skew) > _ASYMMETRY * size)
    if wrong.size:
        i, j = divmod(int(keys[wrong[0]]), n)
        raise ValueError(
            f"{name} matrix, row {i + 1}, column {j + 1} differs from row {j + 1}, column {i + 1}; "
            "expected a symmetric matrix"
        )
    keep = rows >= columns
    index = (np.asarray(rows[keep], np.int64), np.asarray(columns[keep], np.int64))
    return n, (*index, values[keep])
