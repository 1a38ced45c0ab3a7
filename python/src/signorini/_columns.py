"""Columns of tables that the engine writes."""

from __future__ import annotations

import csv
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, fields
from pathlib import Path
from typing import TYPE_CHECKING, Any, NoReturn, TypeVar

import numpy as np
import numpy.typing as npt

if TYPE_CHECKING:
    import pandas as pd
    import xarray as xr

Column = npt.NDArray[Any]

K = TypeVar("K")
V = TypeVar("V")


class ReadOnly(dict[K, V]):
    """A mapping that stays as it is made. It can be copied and pickled, and is a frame to pandas."""

    def _refuse(self, *_: Any, **__: Any) -> NoReturn:
        raise TypeError(f"this {type(self).__name__} cannot be changed; dict(..) of it can")

    __setitem__ = __delitem__ = __ior__ = _refuse
    clear = pop = popitem = setdefault = update = _refuse

    def __reduce__(self) -> tuple[Any, ...]:
        return type(self), (dict(self),)


@dataclass(frozen=True, eq=False, repr=False)
class TableResult(ReadOnly[str, Column]):
    """A result that is a mapping of the columns of its main table; a subclass has what stands beside."""

    columns: Mapping[str, Column]

    def __post_init__(self) -> None:
        dict.update(self, self.columns)

    def __missing__(self, name: str) -> Column:
        raise KeyError(f"no column {name}; there are {', '.join(self.columns)}")

    def __reduce__(self) -> tuple[Any, ...]:
        return type(self), tuple(getattr(self, field.name) for field in fields(self))


_OF_WORDS = {
    *("error", "place", "part", "kind", "less", "wall", "signature", "label", "leads_to", "not_followed_because"),
    *("phases_cycles", "approach_speeds_m_per_s", "multipliers", "displacements_m", "velocities_m_per_s"),
}


def words(cells: Sequence[str]) -> Column:
    """The cells of a column of words; None where there is none."""
    return np.array([cell or None for cell in cells], object)


def column(cells: Sequence[str]) -> Column:
    """The cells of a column: whole numbers, numbers (nan where there is none), or words."""
    for kind in (np.int64, np.float64):
        try:
            filled = cells if kind is np.int64 else [cell or "nan" for cell in cells]
            return np.array([kind(cell) for cell in filled], kind)
        except ValueError:
            continue
    return words(cells)


def columns(header: Sequence[str], rows: Sequence[Sequence[str]]) -> dict[str, Column]:
    """A table by columns; those of names, reasons and lists are words, also where no row has one."""
    cells = {name: [row[i] for row in rows] for i, name in enumerate(header)}
    return {name: words(own) if name in _OF_WORDS else column(own) for name, own in cells.items()}


def read(path: Path) -> dict[str, Column]:
    """A table of the engine, by columns."""
    with path.open(encoding="utf-8", newline="") as file:
        header, *rows = csv.reader(file)
    return columns(header, rows)


Variables = dict[str, tuple[Sequence[str], Column]]
"""The variables of a dataset: the dimensions and the values of each."""


def dataset(coordinates: Mapping[str, Sequence[Any] | Column], variables: Variables) -> xr.Dataset:
    """An xarray Dataset; an `ImportError` without xarray."""
    try:
        import xarray as xr
    except ImportError:
        raise ImportError("to_xarray needs xarray: pip install xarray") from None
    return xr.Dataset(variables, coordinates)


def frame(table: Mapping[str, Column] | Sequence[Mapping[str, Any]]) -> pd.DataFrame:
    """A table, by columns or by rows, as a pandas DataFrame; an `ImportError` without pandas."""
    try:
        import pandas as pd
    except ImportError:
        raise ImportError("to_pandas needs pandas: pip install pandas") from None
    return pd.DataFrame(table)
