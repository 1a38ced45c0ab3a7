"""Branches of periodic orbits over a key of a case."""

from __future__ import annotations

import json
import os
import tempfile
from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Any, Literal

import numpy as np
import numpy.typing as npt

from . import _core, _plot
from ._columns import Column, ReadOnly, TableResult, columns, frame, read
from ._core import Case
from ._types import whole

if TYPE_CHECKING:
    import pandas as pd


Switch = Literal["no", "stable", "all"]
TableName = Literal["points", "special", "ends"]


@dataclass(frozen=True, eq=False, repr=False)
class Branches(TableResult):
    """Branches of periodic orbits over a key: a mapping of the columns of ``branches.csv``.

    A row is an orbit, in order along its ``branch``: the value of the key in the column named
    ``column``, ``period`` in periods of the load, ``signature`` (empty: it meets no wall),
    ``stable`` and ``admissible`` (whether a body can follow it), ``label`` (None, or what happens
    at a special point), ``period_s``, ``least_speed_m_per_s``, ``least_gap_m``,
    ``displacement_max_m``, the parts of the multipliers, and ``phase_1_cycles``,
    ``speed_1_m_per_s`` and so on of its events.

    ``special`` has the columns of ``special.csv``: the special points, such as folds, with the
    branches that each ``leads_to`` and why one was ``not_followed_because``. ``ends`` has a row for
    each branch: where it goes ``from`` and ``to`` (values of the key), why it ``begins`` and
    ``ends`` there, ``found_at_special`` and the ``switches`` from the first branch to it.
    ``events`` has for each branch the kind and the wall of its events.
    """

    special: Mapping[str, Column]
    ends: Mapping[str, Column]
    events: tuple[tuple[tuple[str, str | None], ...], ...]
    column: str
    key: str
    _arrivals: tuple[str, ...]

    def __repr__(self) -> str:
        count, points, special = (len(table["branch"]) for table in (self.ends, self.columns, self.special))
        return f"<Branches: {points} orbits on {count} branches over {self.key}, {special} special points>"

    @property
    def multipliers(self) -> npt.NDArray[np.complex128]:
        """The Floquet multipliers of each orbit, shape (rows, multipliers): the largest, eight at most."""
        count = sum(name.startswith("multiplier_") for name in self.columns) // 2
        parts = [self[f"multiplier_{i}_re"] + 1j * self[f"multiplier_{i}_im"] for i in range(1, count + 1)]
        return np.stack(parts, axis=1).astype(np.complex128)

    def to_pandas(self, table: TableName = "points") -> pd.DataFrame:
        """A table as a pandas DataFrame.

        Parameters
        ----------
        table : str
            ``"points"``, ``"special"`` or ``"ends"``.

        Returns
        -------
        pandas.DataFrame
            The columns of that table.

        Raises
        ------
        ImportError
            Without pandas.
        ValueError
            For another table.

        Examples
        --------
        >>> import signorini as sg
        >>> case = sg.load("rigid-walls-sine", set={"wall.*.restitution": 0.8})
        >>> found = sg.branches(case, "load.1.harmonic.frequency", (4.9, 5.1), switch="no")
        >>> found.to_pandas("ends")["ends"][0]
        'end of the range'
        """
        own = {"points": self.columns, "special": self.special, "ends": self.ends}
        if table not in own:
            raise ValueError(f"table is {table!r}; expected {', '.join(own)}")
        return frame(dict(own[table]))

    def plot(self, ax: Any = None) -> Any:
        """Draw the approach speeds over the key with matplotlib, special points marked.

        Stable orbits are solid, unstable ones dashed, those that no body can follow dotted.

        Parameters
        ----------
        ax : matplotlib axes, optional
            Made if left out.

        Returns
        -------
        matplotlib axes

        Raises
        ------
        ImportError
            Without matplotlib.

        Examples
        --------
        >>> import signorini as sg
        >>> case = sg.load("rigid-walls-sine", set={"wall.*.restitution": 0.8})
        >>> found = sg.branches(case, "load.1.harmonic.frequency", (4.9, 5.1), switch="no")
        >>> found.plot().get_ylabel()
        'approach speed (m/s)'
        """
        return _plot.branches(self, ax)


def _told(table: dict[str, Column]) -> ReadOnly[str, Column]:
    """A table with its truths as such, so that they select rows, and all signatures as words."""
    truths = {name: table[name].astype(bool) for name in ("symmetric", "stable", "admissible") if name in table}
    signature = np.array([word or "" for word in table["signature"]], object)
    return ReadOnly(table | truths | {"signature": signature})


def _cell(value: Any) -> str:
    """A value of JSON as the tables of the engine write it."""
    return "" if value is None else value if isinstance(value, str) else repr(+value)


def branches(
    case: Case,
    key: str,
    range: tuple[float, float],
    *,
    settle: int = _core._SETTLE,
    start: str | os.PathLike[str] | None = None,
    switch: Switch = "stable",
    depth: int = 4,
    points: int = 5000,
    folder: str | os.PathLike[str] | None = None,
) -> Branches:
    """Follow periodic orbits over a key, with their special points and the branches that begin there.

    The engine is that of ``signorini continue``, and the numbers are the same. The orbit on which
    the case settles is followed by pseudo-arclength in both directions, of one degree of freedom by
    its events, of a structure by its state. ``docs/orbits.md`` has the method and the labels.

    Parameters
    ----------
    case : Case
        Under loads with a common period, between walls; a structure has up to 200 degrees of freedom
        or modes.
    key : str
        The key whose value changes, such as ``"load.1.harmonic.frequency"``.
    range : pair of float
        Its least and its greatest value, with that of the case between them.
    settle : int
        Periods of the load that are run before the motion is checked for repetition; 400 by
        default.
    start : path, optional
        In place of a run that settles: an ``orbit.json`` of ``signorini orbit``.
    switch : str
        At which special points the branches that begin there are followed: ``"no"``, ``"stable"``
        (where the orbits on one side are stable) or ``"all"``.
    depth : int
        Most switches between the first branch and any other.
    points : int
        Most orbits of a branch in each direction, 2 or more.
    folder : path, optional
        Where the files of ``signorini continue`` are kept, with the case as ``case.toml``; `report`
        writes their page.

    Returns
    -------
    Branches

    Raises
    ------
    ValueError
        For a wrong request, such as a key on which no orbit depends, or a case without a load that
        repeats itself.
    TypeError
        For something else than a case.
    OSError
        For a ``folder`` that cannot be written or has other results; for a file of an orbit that
        cannot be read.
    RunError
        Where the motion does not repeat itself, or no body can follow the first orbit.

    Examples
    --------
    >>> import signorini as sg
    >>> case = sg.load("rigid-walls-sine", set={"wall.*.restitution": 0.8})
    >>> found = sg.branches(case, "load.1.harmonic.frequency", (4.4, 5.0), switch="no")
    >>> found.special["label"][0], round(float(found.special["frequency_Hz"][0]), 9)
    ('symmetry-breaking', 4.570839134)
    """
    if not isinstance(case, Case):
        raise TypeError(f"case is {case!r}; expected a Case, as of sg.load or sg.case: its key changes")
    low, high = (float(value) for value in range)
    asked = (start, whole("settle", settle), switch, whole("depth", depth), whole("points", points, 2))
    with tempfile.TemporaryDirectory() as own:
        place = Path(own) / "continue" if folder is None else Path(folder)
        arrivals = _core._branches(case, key, (low, high), asked, place, folder is not None)
        table, special = (_told(read(place / name)) for name in ("branches.csv", "special.csv"))
        document = json.loads((place / "branches.json").read_text(encoding="utf-8"))
    rows = document["branches"]
    events = tuple(tuple((event["kind"], event["wall"]) for event in row.pop("events") or ()) for row in rows)
    ends = columns(list(rows[0]), [[_cell(value) for value in row.values()] for row in rows])
    return Branches(table, special, _told(ends), events, document["key"], key, tuple(arrivals))
