"""Sweeps over the keys of a case: the tables of the tool's `sweep`, from the same engine."""

from __future__ import annotations

import os
import tempfile
import warnings
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from numbers import Real
from pathlib import Path
from typing import TYPE_CHECKING, Any, Literal

import numpy as np

from . import _core
from ._columns import Column, ReadOnly, TableResult, Variables, dataset, frame, read
from ._core import Case, ResultWarning
from ._progress import Progress
from ._types import check_given, names, sequence, whole

if TYPE_CHECKING:
    import pandas as pd
    import xarray as xr


Design = Literal["grid", "one-at-a-time", "random"]
TableName = Literal["rows", "realisations", "effects", "shares", "attractors"]


@dataclass(frozen=True, eq=False, repr=False)
class SweepResult(TableResult):
    """The rows of a sweep over the keys of a case: a mapping of the columns of ``sweep.csv``.

    With several realisations of the random loads a measure is the mean over them, the column with
    ``half_width_95`` in its name the half width of its 95 % interval, and ``seeds`` their number;
    ``realisations`` has the columns of ``realisations.csv``: a line for each row and
    ``realisation`` k, which has the seeds of the case plus k - 1. ``effects`` has those of
    ``effects.csv`` where keys were varied one at a time, ``shares`` those of ``shares.csv`` where
    they were drawn at random. ``attractors`` has those of ``attractors.csv`` where the measure
    ``attractor`` was asked for: a line for each, with its number, its ``rows`` and their ``share``
    (the size of its basin), ``signature``, ``period`` in periods of the load and multipliers.
    Tables that a sweep does not have are empty. ``keys_varied`` names the columns of the keys, and
    ``design`` says how their values lie: ``"grid"``, ``"one-at-a-time"`` or ``"random"``. ``places``
    has, for each column of a measure at a place, its name without the place, ``"wall"``,
    ``"support"``, ``"place"`` (a support, or a wall that is no flat of one) or ``"probe"``, and
    the name of the place.
    """

    realisations: Mapping[str, Column]
    effects: Mapping[str, Column]
    shares: Mapping[str, Column]
    attractors: Mapping[str, Column]
    keys_varied: tuple[str, ...]
    design: Design
    places: Mapping[str, tuple[str, str, str]]

    def __repr__(self) -> str:
        return f"<SweepResult: {len(self['row'])} rows over {', '.join(self.keys_varied)}>"

    def to_pandas(self, table: TableName = "rows") -> pd.DataFrame:
        """A table as a pandas DataFrame.

        Parameters
        ----------
        table : str
            ``"rows"``, ``"realisations"``, ``"effects"``, ``"shares"`` or ``"attractors"``.

        Returns
        -------
        pandas.DataFrame
            The columns of that table; of ``"realisations"`` a line for each realisation of each
            row, of which rows may have different numbers.

        Raises
        ------
        ImportError
            Without pandas.
        ValueError
            For a table that this sweep does not have.

        Examples
        --------
        >>> import signorini as sg
        >>> case = sg.load("rigid-walls-sine", set={"time.end": 1.0})
        >>> sg.sweep(case, {"wall.*.restitution": [0.5, 0.8]}, measures=["contacts"]).to_pandas().shape
        (2, 6)
        """
        own = {
            "rows": self.columns, "realisations": self.realisations, "effects": self.effects, "shares": self.shares,
            "attractors": self.attractors,
        }  # fmt: skip
        known = [name for name, columns in own.items() if columns]
        if table not in known:
            raise ValueError(f"table is {table!r}; expected one that this sweep has: {', '.join(known)}")
        return frame(dict(own[table]))

    def to_xarray(self) -> xr.Dataset:
        """The numbers as an xarray Dataset over the varied keys and the places of each measure.

        A measure is one variable, ``work_rate_W``, with the dimension ``wall``, ``support``,
        ``place`` or ``probe`` after those of the keys. Variables of ``realisations`` have
        ``realisations_`` before their name, and the further dimension ``realisation``, as long as
        the row with the most has them. Where a row has fewer, since ``until_interval`` took fewer
        or some failed, the others are NaN, which means and other sums of xarray leave out; the
        variable ``seeds`` says how many there are. ``realisations_depths_m`` has the dimension
        ``part`` besides: the sectors of a hole, or the flats of a support. Only of a grid.

        Returns
        -------
        xarray.Dataset

        Raises
        ------
        ImportError
            Without xarray.
        ValueError
            For keys varied one at a time or drawn at random, whose rows are no grid.

        Examples
        --------
        >>> import signorini as sg
        >>> case = sg.load("rigid-walls-sine", set={"time.end": 1.0})
        >>> table = sg.sweep(case, {"wall.*.restitution": [0.5, 0.8]}, measures=["contacts"])
        >>> table.to_xarray()["contacts"].dims
        ('restitution', 'wall')
        """
        if self.design != "grid":
            how = {"one-at-a-time": "varied one at a time", "random": "drawn at random"}[self.design]
            raise ValueError(f"to_xarray of keys {how}; expected a sweep over a grid, or to_pandas")
        # The rows are in the order of the grid, the last key fastest.
        axes = {key: list(dict.fromkeys(self[key].tolist())) for key in self.keys_varied}
        shape = [len(values) for values in axes.values()]
        coordinates: dict[str, Any] = dict(axes)
        variables: Variables = {}
        for name, dimensions, values, own in self._placed(self.columns):
            coordinates |= own
            variables[name] = [*axes, *dimensions], values.reshape([*shape, *values.shape[1:]])
        if not self.realisations:
            return dataset(coordinates, variables)
        row, number = self.realisations["row"], self.realisations["realisation"]
        most = int(number.max())
        coordinates["realisation"] = np.arange(1, most + 1)
        for name, dimensions, values, own in self._placed(self.realisations):
            coordinates |= own
            # What is not there is NaN.
            padded = np.full((len(self["row"]), most, *values.shape[1:]), np.nan)
            padded[row, number - 1] = values
            of_row = padded.reshape([*shape, most, *values.shape[1:]])
            variables[f"realisations_{name}"] = [*axes, "realisation", *dimensions], of_row
        return dataset(coordinates, variables)

    def _placed(self, columns: Mapping[str, Column]) -> Iterator[Placed]:
        """The columns of numbers, those of a measure beside one another by their places."""
        skipped = {*self.keys_varied, "row", "realisation", "status", "error"}
        groups: dict[str, list[str]] = {}
        for column in columns:
            if column not in skipped:
                groups.setdefault(self.places.get(column, (column,))[0], []).append(column)
        for name, group in groups.items():
            if group[0] not in self.places:
                yield name, (), columns[name], {}
                continue
            dimension = self.places[group[0]][1]
            coordinates = {dimension: [self.places[column][2] for column in group]}
            parts = [_depths(columns[column]) for column in group] if name == "depths_m" else []
            if not parts:
                yield name, (dimension,), np.stack([columns[column] for column in group], axis=-1), coordinates
                continue
            values = np.full((len(columns[group[0]]), len(group), max(part.shape[1] for part in parts)), np.nan)
            for index, part in enumerate(parts):
                values[:, index, : part.shape[1]] = part
            yield name, (dimension, "part"), values, coordinates


Placed = tuple[str, tuple[str, ...], Column, dict[str, list[str]]]
"""A variable of a dataset: name, dimensions after that of the rows, values, coordinates."""


def _depths(cells: Column) -> Column:
    """The depths of the parts of a support, in a row for each cell; NaN where a cell has fewer."""
    lists = [[float(word) for word in str(cell or "").split()] for cell in cells]
    most = max((len(own) for own in lists), default=0)
    return np.array([own + [np.nan] * (most - len(own)) for own in lists]).reshape(len(lists), most)


Drawn = tuple[str, int | None, int | None]
"""A random design: its kind, its number of rows and its seed."""


def sweep_case(
    case: Case,
    keys: Mapping[str, Sequence[Any]],
    scheme: str | None,
    *,
    measures: Sequence[str],
    periods: tuple[int | None, int | None],
    asked: tuple[int | None, float | None, int | None],
    design: Design,
    drawn: Drawn | None,
    threads: int | None,
    folder: str | os.PathLike[str] | None,
    progress: bool,
) -> SweepResult:
    """The tables of a sweep by the engine of the tool."""
    if threads is not None:
        whole("threads", threads, 1)
    for argument, value in zip(("rows", "seed"), (drawn or ("", None, None))[1:], strict=True):
        if value is not None:
            whole(argument, value)
    for argument, value, least in zip(("settle", "keep"), periods, (0, 1), strict=True):
        if value is not None:
            whole(argument, value, least)
    seeds, until_interval, most_seeds = asked
    check_given({"until_interval": until_interval}, {"seeds": seeds, "most_seeds": most_seeds})
    if measures:
        names("measures", measures, "work_rate")
    expected = "a sequence of values" if design == "grid" else "its lower and upper bound"
    axes = [(key, sequence(key, values, expected)) for key, values in keys.items()]
    for key, values in axes:
        bounds = values[:2] if values[2:] == ["log"] else values
        if design == "random" and not (len(bounds) == 2 and all(isinstance(bound, Real) for bound in bounds)):
            expected = 'its lower and upper bound, "log" after them where its logarithm is drawn'
            raise ValueError(f"{key} is {values!r}; expected {expected}")
    with tempfile.TemporaryDirectory() as own, Progress(0, progress) as shown:
        place = Path(own) / "sweep" if folder is None else Path(folder)
        notes, count, bad, first = _core._sweep(
            case, axes, design == "one-at-a-time", drawn, scheme, list(measures), periods, asked, threads, place,
            shown.reach,
        )  # fmt: skip
        rows, realisations, effects, shares, attractors = (
            read(path) if (path := place / name).exists() else {}
            for name in ("sweep.csv", "realisations.csv", "effects.csv", "shares.csv", "attractors.csv")
        )
    for note in notes:
        warnings.warn(note, ResultWarning, stacklevel=3)
    if bad:
        warnings.warn(f"{bad} of {count} rows failed; the first: {first}", RuntimeWarning, stacklevel=3)
    if attractors and (undecided := count - bad - int(attractors["rows"].sum())):
        text = f"undecided: {undecided} of {count} starts, whose attractor was not found (nan): try a longer settle"
        warnings.warn(text, ResultWarning, stacklevel=3)
    header = list(rows)
    # The number of the row is before the columns of the keys, the realisations or the status after.
    ends = [header.index(name) for name in ("seeds", "status") if name in header]
    return SweepResult(
        ReadOnly(rows), ReadOnly(realisations), ReadOnly(effects), ReadOnly(shares), ReadOnly(attractors),
        tuple(header[1 : min(ends)]), design,
        {one: (name, kind, place) for one, name, kind, place in _core._placed_columns(case, list(measures))},
    )  # fmt: skip


def one_at_a_time(
    case: Case,
    keys: Mapping[str, tuple[float, float]],
    scheme: str | None = None,
    *,
    measures: Sequence[str],
    seeds: int | None = None,
    until_interval: float | None = None,
    most_seeds: int | None = None,
    threads: int | None = None,
    folder: str | os.PathLike[str] | None = None,
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
    until_interval, most_seeds : optional
        In place of ``seeds``, as in `sweep`.
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
        place, with half widths of 95 % intervals where there are realisations.

    Raises
    ------
    ValueError
        For a wrong request.

    Warns
    -----
    ResultWarning
        Once, with their number, where runs have notes that limit the use of their results; and where
        the case has very large random forces.
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
        case, keys, scheme, measures=measures, periods=(None, None), asked=(seeds, until_interval, most_seeds), design="one-at-a-time",
        drawn=None, threads=threads, folder=folder, progress=progress,
    )  # fmt: skip
