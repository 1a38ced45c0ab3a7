"""Sweeps over the keys of a case: the tables of the tool's `sweep`, from the same engine."""

from __future__ import annotations

import csv
import math
import tempfile
import warnings
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Any

from . import _core
from ._columns import Column, columns, frame
from ._core import Case, ResultWarning
from ._progress import Progress

if TYPE_CHECKING:
    import pandas as pd
    import xarray as xr


def _read(path: Path) -> dict[str, Column]:
    """A table of the engine, by columns."""
    with path.open(encoding="utf-8", newline="") as file:
        header, *rows = csv.reader(file)
    return columns(header, rows)


@dataclass(frozen=True, eq=False)
class SweepResult(Mapping[str, Column]):
    """The rows of a sweep over the keys of a case: a mapping of the columns of ``sweep.csv``.

    With several realisations of the random loads a measure is the mean over them, and the column
    with ``half_width_95`` in its name the half width of its 95 % interval; ``realisations`` has the
    columns of ``realisations.csv``, else it is empty. ``effects`` has those of ``effects.csv`` where
    keys were varied one at a time, else it is empty. ``keys_varied`` names the columns of the keys.
    """

    columns: Mapping[str, Column]
    realisations: Mapping[str, Column]
    effects: Mapping[str, Column]
    keys_varied: tuple[str, ...]

    def __getitem__(self, name: str) -> Column:
        if name not in self.columns:
            raise KeyError(f"no column {name}; there are {', '.join(self.columns)}")
        return self.columns[name]

    def __iter__(self) -> Iterator[str]:
        return iter(self.columns)

    def __len__(self) -> int:
        return len(self.columns)

    def __repr__(self) -> str:
        return f"<SweepResult: {len(self['row'])} rows over {', '.join(self.keys_varied)}>"

    def to_pandas(self) -> pd.DataFrame:
        """The rows as a pandas DataFrame.

        Returns
        -------
        pandas.DataFrame

        Raises
        ------
        ImportError
            Without pandas.

        Examples
        --------
        >>> import signorini as sg
        >>> case = sg.load("rigid-walls-sine", set={"time.end": 1.0})
        >>> sg.sweep(case, {"wall.*.restitution": [0.5, 0.8]}, measures=["contacts"]).to_pandas().shape
        (2, 6)
        """
        return frame(dict(self.columns))

    def to_xarray(self) -> xr.Dataset:
        """The numbers as an xarray Dataset over the varied keys.

        Variables of ``realisations`` have the name of their column with ``realisations_`` before
        it, and the further dimension ``realisation``. Not of keys varied one at a time.

        Returns
        -------
        xarray.Dataset

        Raises
        ------
        ImportError
            Without xarray.
        ValueError
            For keys varied one at a time, whose rows are no grid.

        Examples
        --------
        >>> import signorini as sg
        >>> case = sg.load("rigid-walls-sine", set={"time.end": 1.0})
        >>> table = sg.sweep(case, {"wall.*.restitution": [0.5, 0.8]}, measures=["contacts"])
        >>> table.to_xarray()["contacts_upper"].dims
        ('restitution',)
        """
        try:
            import xarray as xr
        except ImportError:
            raise ImportError("to_xarray needs xarray: pip install xarray") from None
        if self.effects:
            raise ValueError("to_xarray of keys varied one at a time; expected a sweep over a grid, or effects")
        # The rows are in the order of the grid, the last key fastest.
        axes = {key: list(dict.fromkeys(self[key].tolist())) for key in self.keys_varied}
        shape = [len(values) for values in axes.values()]
        skipped = {*axes, "row", "realisation", "status", "error"}
        variables = {
            name: (list(axes), column.reshape(shape)) for name, column in self.columns.items() if name not in skipped
        }
        coordinates: dict[str, Any] = dict(axes)
        if self.realisations:
            count = len(self.realisations["row"]) // len(self["row"])
            coordinates["realisation"] = self.realisations["realisation"][:count]
            for name, column in self.realisations.items():
                if name not in skipped:
                    variables[f"realisations_{name}"] = ([*axes, "realisation"], column.reshape([*shape, count]))
        return xr.Dataset(variables, coordinates)


def sweep_case(
    case: Case,
    keys: Mapping[str, Sequence[Any]],
    scheme: str | None,
    *,
    measures: Sequence[str],
    seeds: int | None,
    one_at_a_time: bool,
    threads: int | None,
    folder: str | Path | None,
    progress: bool,
) -> SweepResult:
    """The tables of a sweep by the engine of the tool."""
    if threads is not None and threads < 1:
        raise ValueError(f"threads is {threads}; expected 1 or more")
    axes = [(key, list(values)) for key, values in keys.items()]
    rows = 1 + 2 * len(axes) if one_at_a_time else math.prod(len(values) for _, values in axes)
    with tempfile.TemporaryDirectory() as own, Progress(rows * (seeds or 1), progress) as shown:
        place = Path(own) / "sweep" if folder is None else Path(folder)
        notes, count, bad, first = _core._sweep(
            case, axes, one_at_a_time, scheme, list(measures), seeds, threads, place, shown.tell
        )
        table, realisations, effects = (
            _read(path) if (path := place / name).exists() else {}
            for name in ("sweep.csv", "realisations.csv", "effects.csv")
        )
    for note in notes:
        warnings.warn(note, ResultWarning, stacklevel=3)
    if bad:
        warnings.warn(f"{bad} of {count} rows failed; the first: {first}", RuntimeWarning, stacklevel=3)
    names = list(table)
    # The number of the row is before the columns of the keys, the realisations or the status after.
    ends = [names.index(name) for name in ("seeds", "status") if name in names]
    return SweepResult(table, realisations, effects, tuple(names[1 : min(ends)]))


def one_at_a_time(
    case: Case,
    keys: Mapping[str, tuple[float, float]],
    scheme: str | None = None,
    *,
    measures: Sequence[str],
    seeds: int | None = None,
    threads: int | None = None,
    folder: str | Path | None = None,
    progress: bool = True,
) -> SweepResult:
    """Vary each key of a case by itself between two bounds, the others as in the case.

    Parameters
    ----------
    case : Case
    keys : mapping of str to pair of float
        The lower and the upper bound of each key of the case format.
    scheme
        As in `Scene.run`.
    measures : sequence of str
        Names of measures, as ``signorini sweep --measure``.
    seeds : int, optional
        Realisations of the random loads under which each row is run, 2 or more.
    threads : int, optional
        All cores if left out.
    folder : path, optional
        Where the tables are kept; the same call goes on from them after an interruption.
    progress : bool
        Whether a terminal shows the progress, after a second.

    Returns
    -------
    SweepResult
        Its ``effects`` are the measures at the upper bound less those at the lower, by key and
        place, with half widths of 95 % intervals where there are ``seeds``.

    Raises
    ------
    ValueError
        For a wrong request.

    Warns
    -----
    ResultWarning
        Where the case has very large random forces.
    RuntimeWarning
        Where rows failed, with their number and the first reason.

    Examples
    --------
    >>> import signorini as sg
    >>> case = sg.load("rigid-walls-sine", set={"time.end": 2.0})
    >>> keys = {"load.1.harmonic.amplitude": (2.0, 4.0)}
    >>> table = sg.one_at_a_time(case, keys, measures=["displacement_max"])
    >>> table.effects["key"][0], len(table["row"])
    ('load.1.harmonic.amplitude', 3)
    """
    return sweep_case(
        case, keys, scheme, measures=measures, seeds=seeds, one_at_a_time=True, threads=threads, folder=folder,
        progress=progress,
    )  # fmt: skip
