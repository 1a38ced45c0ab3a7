"""Periodic orbits."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np
import numpy.typing as npt

from . import _core, _plot
from ._core import Case, RunError, Scene
from ._types import Array, whole


@dataclass(frozen=True, repr=False)
class Orbit:
    """A periodic orbit, by its events: see `orbit`."""

    kinds: list[str]
    """The kind of each event: impact, rest, release, enter, leave and so on."""
    walls: list[str]
    """The wall of each event."""
    phases: Array
    """The instant of each event, in periods of the load from t = 0; shape (events,)."""
    speeds: Array
    """Speed at each event, m/s; shape (events,)."""
    symmetric: bool
    """Whether the events are the first half of an orbit whose second half is the mirror image."""
    period: float
    """s."""
    forcing_period: float
    """Period of the load, s."""
    multipliers: npt.NDArray[np.complex128]
    """The Floquet multipliers, the largest first, two for each degree of freedom; the orbit is stable
    if all are within the unit circle."""
    stable: bool
    closure: float
    """Distance between start and end of a free run over one period, as a share of the scales."""
    state: tuple[Array, Array]
    """Displacement (m) and velocity (m/s) of every degree of freedom at the first instant of that run."""
    time: Array
    """Instants of that run, s; shape (rows,)."""
    displacement: Array
    """Of a structure that of its first probe, m; shape (rows,), or (0,) without a probe."""
    velocity: Array
    """The same, m/s."""

    def __repr__(self) -> str:
        count = len(self.kinds) * (2 if self.symmetric else 1)
        events = f"{count} event{'' if count == 1 else 's'}"
        periods = round(self.period / self.forcing_period)
        of_load = "the period of the load" if periods == 1 else f"{periods} periods of the load"
        stable = "stable" if self.stable else "unstable"
        return f"<Orbit: {events} in {self.period:.6g} s, {of_load}; {stable}>"

    def plot(self, ax: Any = None) -> Any:
        """Draw velocity over displacement with matplotlib.

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
        >>> sg.orbit(case.scene).plot().get_ylabel()
        'velocity (m/s)'
        """
        return _plot.orbit(self, ax)


def orbit(scene: Scene | Case, *, settle: int = _core._SETTLE, rows: int = 400) -> Orbit:
    """The periodic orbit on which a motion settles, to rounding, with its Floquet multipliers.

    Parameters
    ----------
    scene : Scene or Case
        Under loads with a common period: one degree of freedom between walls, or a structure of up
        to 200 degrees of freedom or modes, whose orbit is found by shooting.
    settle : int
        Periods of the load that are run, exactly, before the motion is checked for repetition; 400
        by default, as in ``signorini orbit``.
    rows : int
        Instants of its motion that are kept beside the events.

    Returns
    -------
    Orbit
        The shortest that the motion repeats.

    Raises
    ------
    ValueError
        For a scene that cannot have one, such as one without a load that repeats itself.
    TypeError
        For something else than a scene or a case.
    RunError
        Where the motion does not repeat itself, or no orbit is found near it.

    Examples
    --------
    >>> import signorini as sg
    >>> case = sg.load("rigid-walls-sine", set={"wall.*.restitution": 0.8})
    >>> found = sg.orbit(case)
    >>> found.period, found.stable, round(float(found.speeds[0]), 9)
    (0.2, True, 0.169410591)
    >>> sg.orbit(sg.load("two-masses")).multipliers.shape
    (4,)
    """
    made = _core._orbit(scene, whole("settle", settle), whole("rows", rows, 1))
    refused, holds = made.pop("refused"), made.pop("holds")
    if refused is not None or not holds:
        reason = refused or f"a free run misses it by {made['closure']:.1e} after a period"
        raise RunError(f"no body can follow the orbit that was found: {reason}")
    for name in ("phases", "speeds", "time", "displacement", "velocity"):
        made[name] = np.array(made[name], np.float64)
    made["state"] = tuple(np.array(part, np.float64) for part in made["state"])
    made["multipliers"] = np.array([complex(*pair) for pair in made["multipliers"]])
    return Orbit(**made)
