"""Bifurcation diagrams."""

from __future__ import annotations

import os
import warnings
from collections.abc import Iterable
from dataclasses import dataclass
from typing import Any

import numpy as np
import numpy.typing as npt

from . import _core, _plot
from ._core import Case
from ._studies import columns_of
from ._sweep import Table, warn_of_runs
from ._types import sequence, whole


@dataclass(frozen=True, repr=False)
class Bifurcation:
    """The motions that runs settle on, over the values of a key: see `bifurcation`.

    Attributes
    ----------
    table : dict of str to numpy.ndarray
        One row per sample: ``value``, ``direction`` (up, down or None), ``error``; of impacts
        ``wall``, ``time_s``, ``phase_cycles``, ``approach_speed_m_per_s``,
        ``departure_speed_m_per_s``, ``impulse_N_s``; of periods ``time_s``, ``displacement_m``,
        ``velocity_m_per_s``.
    key : str
        The key that was varied.
    """

    table: Table
    key: str

    def __repr__(self) -> str:
        values = self.table["value"]
        ends = f" from {values.min():.6g} to {values.max():.6g}" if values.size else ""
        return f"<Bifurcation: {values.size} samples over {self.key}{ends}>"

    def plot(self, column: str | None = None, ax: Any = None) -> Any:
        """Draw a column over the values with matplotlib.

        Parameters
        ----------
        column : str, optional
            Of the table; the approach speed of impacts or the displacement if left out.
        ax : matplotlib axes, optional
            Made if left out.

        Returns
        -------
        matplotlib axes

        Raises
        ------
        ValueError
            For a column that the table does not have; it lists those there are.
        ImportError
            Without matplotlib.

        Examples
        --------
        >>> import signorini as sg
        >>> case = sg.load("rigid-walls-sine", set={"wall.*.restitution": 0.8})
        >>> made = sg.bifurcation(case, "load.1.harmonic.frequency", [4.8, 5.0], settle=20, keep=5)
        >>> made.plot().get_xlabel()
        'load.1.harmonic.frequency (Hz)'
        """
        impacts = "approach_speed_m_per_s" in self.table
        column = column or ("approach_speed_m_per_s" if impacts else "displacement_m")
        if column not in self.table:
            raise ValueError(f"no column is named {column!r}; there is {', '.join(self.table) or 'none'}")
        return _plot.bifurcation(self, column, ax)


def bifurcation(
    case: Case,
    key: str,
    values: Iterable[float] | npt.NDArray[np.float64],
    *,
    scheme: str = "event",
    settle: int = _core._SETTLE,
    keep: int = 30,
    follow: str = "both",
    samples: str = "impacts",
    threads: int | None = None,
) -> Bifurcation:
    """Step a value of a case up and down while the state is carried on, and sample what it settles to.

    Parameters
    ----------
    case : Case
        From `load`.
    key : str
        What is varied, by the keys of the case format: ``"load.1.harmonic.frequency"``.
    values : iterable of float
        Rising.
    scheme : str
        As in `Scene.run`.
    settle, keep : int
        Periods of the load before the samples (400 by default), and with samples, at each value.
    follow : str
        ``"up"``, ``"down"`` or ``"both"``; ``"no"`` starts each value from the case's own start.
    samples : str
        ``"impacts"``, or ``"periods"``: the first probe once a period, a Poincaré section.
    threads : int, optional
        All cores if left out; values that follow one another run on one thread.

    Returns
    -------
    Bifurcation

    Raises
    ------
    ValueError
        For a wrong request.
    TypeError
        For something else than a case, or values that are no sequence.

    Warns
    -----
    ResultWarning
        Once, with their number, where runs have notes that limit the use of their results.
    RuntimeWarning
        Where some value has no sound motion; its row says why.

    Examples
    --------
    >>> import signorini as sg
    >>> case = sg.load("rigid-walls-sine", set={"wall.*.restitution": 0.8})
    >>> made = sg.bifurcation(case, "load.1.harmonic.frequency", [4.8, 5.0, 5.2], settle=50, keep=5)
    >>> sorted(set(made.table["direction"]))
    ['down', 'up']
    """
    count = (os.cpu_count() or 1) if threads is None else whole("threads", threads, 1)
    settle, keep = whole("settle", settle), whole("keep", keep, 1)
    listed = sequence("values", values)
    rows, cautions = _core._bifurcation(case, key, listed, scheme, settle, keep, follow, samples, count)
    warn_of_runs(cautions)
    failed = [row for row in rows if row["error"] is not None]
    if failed:
        first = f"{failed[0]['value']!r}: {failed[0]['error']}"
        warnings.warn(f"not every value has a sound motion; the first at {first}", RuntimeWarning, stacklevel=2)
    return Bifurcation(columns_of(rows, ("direction", "error", "wall")), key)
