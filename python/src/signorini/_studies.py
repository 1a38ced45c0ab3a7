"""Studies of one scene by several runs, as tables."""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np

from . import _core, _plot
from ._core import Case, Scene
from ._sweep import Table, warn_of_failures
from ._types import Array, names, positive, whole


def columns_of(rows: Sequence[Mapping[str, Any]], words: Iterable[str]) -> Table:
    """Columns of the rows; None is nan in a column of numbers, and stays in one of ``words``."""
    header = list(dict.fromkeys(name for row in rows for name in row))
    strings = set(words)
    columns: dict[str, list[Any]] = {name: [row.get(name) for row in rows] for name in header}
    return {
        name: np.array(column, object if name in strings else np.float64) for name, column in columns.items()
    }


@dataclass(frozen=True, repr=False)
class Chart:
    """Computing time against error: see `chart`.

    Attributes
    ----------
    table : dict of str to numpy.ndarray
        One row per method and step: ``method``, ``kind``, ``step_s``, ``seconds``,
        ``displacement_error``, ``impulse_error``, ``contact_time_error`` (shares), ``failure``
        (words).
    reference : str
        The reference of the errors.
    horizon : float
        Time up to which errors are taken, s.
    """

    table: Table
    reference: str
    horizon: float

    def __repr__(self) -> str:
        methods = len(set(self.table["method"]))
        return f"<Chart: {len(self.table['method'])} points of {methods} method{'' if methods == 1 else 's'}>"

    def errors(self, quantity: str) -> Array:
        """The column of the errors of a quantity.

        Parameters
        ----------
        quantity : str
            ``"displacement"``, ``"impulse"`` or ``"contact_time"``.

        Returns
        -------
        numpy.ndarray of shape (points,)
            Shares; nan where there is none.

        Raises
        ------
        ValueError
            For another quantity.

        Examples
        --------
        >>> import signorini as sg
        >>> scene = sg.load("rigid-walls-sine").scene.replace(duration=0.5)
        >>> bool(sg.chart(scene, ["event"], repeats=1).errors("impulse")[0] < 1e-9)
        True
        """
        if f"{quantity}_error" not in self.table:
            raise ValueError(f"quantity is {quantity!r}; expected 'displacement', 'impulse' or 'contact_time'")
        return self.table[f"{quantity}_error"]

    def cheapest(self, error: float, quantity: str = "displacement") -> tuple[str, float, float] | None:
        """The fastest method and step with at most this error.

        Parameters
        ----------
        error : float
            A share, as in the table.
        quantity : str
            ``"displacement"``, ``"impulse"`` or ``"contact_time"``: whose error.

        Returns
        -------
        tuple of str, float and float, or None
            Method, step (s) and computing time (s); None where no point has so small an error.

        Raises
        ------
        ValueError
            For another quantity.

        Examples
        --------
        >>> import signorini as sg
        >>> scene = sg.load("rigid-walls-sine").scene.replace(duration=0.5)
        >>> sg.chart(scene, ["event"], repeats=1).cheapest(1e-12)[0]
        'event'
        """
        errors, seconds = self.errors(quantity), self.table["seconds"]
        reached = np.flatnonzero(errors <= error)
        if reached.size == 0:
            return None
        best = reached[np.argmin(seconds[reached])]
        return self.table["method"][best], float(self.table["step_s"][best]), float(seconds[best])

    def plot(self, quantity: str = "displacement", ax: Any = None) -> Any:
        """Draw it with matplotlib.

        Parameters
        ----------
        quantity : str
            ``"displacement"``, ``"impulse"`` or ``"contact_time"``: whose error.
        ax : matplotlib axes, optional
            Made if left out.

        Returns
        -------
        matplotlib axes

        Raises
        ------
        ValueError
            For another quantity.
        ImportError
            Without matplotlib.

        Examples
        --------
        >>> import signorini as sg
        >>> scene = sg.load("rigid-walls-sine").scene.replace(duration=0.5)
        >>> sg.chart(scene, ["moreau-jean"], levels=3, repeats=1).plot().get_ylabel()
        'computing time (s)'
        """
        return _plot.chart(self, quantity, ax)


def chart(
    scene: Scene | Case,
    methods: Sequence[str] | None = None,
    *,
    coarsest: float | None = None,
    finest: float | None = None,
    levels: int | None = None,
    repeats: int = 5,
    most_seconds: float = 1.0,
) -> Chart:
    """Measure computing time against error, for methods over a range of steps.

    Parameters
    ----------
    scene : Scene or Case
        What is run.
    methods : sequence of str, optional
        Schemes, as in `Scene.run`; all if left out, and of penalties those of a case.
    coarsest, finest : float, optional
        The range of steps, s.
    levels : int, optional
        Number of steps.
    repeats : int
        Timed runs of each point, of which the fastest counts.
    most_seconds : float
        A run that is expected to take longer is left out, and its row says so.

    Returns
    -------
    Chart

    Raises
    ------
    ValueError
        For a wrong request. What one method cannot do, such as a penalty without stiffness, is the
        ``failure`` of its rows.
    TypeError
        For something else than a scene or a case.

    Warns
    -----
    RuntimeWarning
        Where methods failed at every step, with their number and the first reason.

    Examples
    --------
    >>> import signorini as sg
    >>> scene = sg.load("rigid-walls-sine").scene.replace(duration=0.5)
    >>> made = sg.chart(scene, ["event", "moreau-jean"], levels=3, repeats=1)
    >>> made.cheapest(1e-12)[0]
    'event'
    """
    given = None if methods is None else names("methods", methods, "moreau-jean")
    levels = None if levels is None else whole("levels", levels, 1)
    repeats, most_seconds = whole("repeats", repeats, 1), positive("most_seconds", most_seconds)
    rows, reference, horizon = _core._chart(scene, given, coarsest, finest, levels, repeats, most_seconds)
    # At some steps a method may diverge, or take too long, in a sound request: not at all of them.
    reasons: dict[str, list[str | None]] = {}
    for row in rows:
        reasons.setdefault(row["method"], []).append(row["failure"])
    warn_of_failures([own[0] if all(own) else None for own in reasons.values()], "methods")
    return Chart(columns_of(rows, ("method", "kind", "failure")), reference, horizon)


@dataclass(frozen=True, repr=False)
class Stability:
    """Where each scheme fails: see `stability`.

    Attributes
    ----------
    table : dict of str to numpy.ndarray
        One row per scheme, parameter and step: ``scheme``, ``parameter`` and its ``value``,
        ``step_s``, ``class`` (stable, dissipative, frozen, another-motion, energy-gaining,
        diverged) and its ``reason``.
    stable : dict of str to numpy.ndarray
        One row per scheme at the scene's own parameters: its largest ``stable_step_s`` (nan: there
        is none), and the first failure ``beyond`` it, in words.
    """

    table: Table
    stable: Table

    def __repr__(self) -> str:
        schemes = len(set(self.table["scheme"]))
        return f"<Stability: {len(self.table['scheme'])} runs of {schemes} scheme{'' if schemes == 1 else 's'}>"

    def plot(self, ax: Any = None) -> Any:
        """Draw the classes with matplotlib, at the scene's own parameters.

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
        >>> made = sg.stability(sg.load("bouncing-ball").scene, finest=0.03, per_decade=2, contacts=4)
        >>> made.plot().get_xlabel()
        'step (s)'
        """
        return _plot.stability(self, ax)


def stability(
    scene: Scene | Case,
    *,
    finest: float | None = None,
    coarsest: float | None = None,
    per_decade: float | None = None,
    contacts: int | None = None,
) -> Stability:
    """Find where each scheme fails, and its largest stable step. It takes seconds to minutes.

    Parameters
    ----------
    scene : Scene or Case
        What is run, with the penalties of a case among the schemes.
    finest, coarsest : float, optional
        The range of steps, times the angular frequency of the scene: 1e-4 to 3.2.
    per_decade : float, optional
        Steps tried in each decade.
    contacts : int, optional
        Number of contacts after which the runs end.

    Returns
    -------
    Stability

    Raises
    ------
    ValueError
        For a scene without walls, or a wrong number.
    TypeError
        For something else than a scene or a case.

    Examples
    --------
    >>> import signorini as sg
    >>> made = sg.stability(sg.load("bouncing-ball"), finest=0.03, per_decade=2, contacts=4)
    >>> bool((made.table["step_s"] > 0.0).all())
    True
    """
    contacts = None if contacts is None else whole("contacts", contacts, 1)
    cells, stable = _core._stability(scene, finest, coarsest, per_decade, contacts)
    words = ("scheme", "parameter", "class", "reason", "beyond")
    return Stability(columns_of(cells, words), columns_of(stable, words))
