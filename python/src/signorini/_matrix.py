"""Matrices of NumPy and SciPy as entries."""

from __future__ import annotations

from typing import Any

import numpy as np
import numpy.typing as npt

from ._types import check_unmasked

Entries = tuple[npt.NDArray[np.int64], npt.NDArray[np.int64], npt.NDArray[np.float64]]

# Between an entry and its mirror, relative to the larger or to sqrt(|a_ii a_jj|), as of matrices in
# files: reduced matrices are symmetric to the rounding of their products.
_ASYMMETRY = 1e-8


def lower(name: str, matrix: Any) -> tuple[int, Entries]:
    """Size and the entries of the lower triangle of a symmetric matrix, means of both triangles."""
    check_unmasked(f"{name} matrix", matrix)
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
    rows, columns = np.asarray(rows, np.int64), np.asarray(columns, np.int64)
    keys, where = np.unique(np.maximum(rows, columns) * n + np.minimum(rows, columns), return_inverse=True)
    low, high = (np.bincount(where, values * half, len(keys)) for half in (rows >= columns, rows <= columns))
    i, j = np.asarray(keys // n, np.int64), np.asarray(keys % n, np.int64)
    diagonal = np.zeros(n)
    diagonal[i[i == j]] = low[i == j]
    scale = np.maximum(np.maximum(np.abs(low), np.abs(high)), np.sqrt(np.abs(diagonal[i] * diagonal[j])))
    wrong = np.flatnonzero(np.abs(low - high) > _ASYMMETRY * scale)
    if wrong.size:
        first = wrong[0]
        row, column = int(i[first]) + 1, int(j[first]) + 1
        raise ValueError(
            f"{name} matrix, row {row}, column {column} is {float(low[first])}, and row {column}, column {row} is "
            f"{float(high[first])}; expected a matrix symmetric to {_ASYMMETRY} of the entry or of sqrt(|a_ii a_jj|)"
        )
    return n, (i, j, np.asarray(0.5 * (low + high), np.float64))
