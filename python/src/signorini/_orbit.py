"""Periodic orbits."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

import numpy as np
import numpy.typing as npt

from . import _core, _plot
from ._core import Case, RunError, Scene
from ._derivative import Keys, Source, builds, resolved
from ._types import Array, whole


@dataclass(frozen=True, repr=False)
class OrbitDerivative:
    """The derivatives of a periodic orbit with respect to keys: see `orbit`.

    Attributes
    ----------
    keys : list of str
        The names of the keys.
    values : numpy.ndarray
        Their values; shape (keys,).
    events : structured numpy.ndarray
        The events of the whole orbit: ``wall``, ``kind``, ``phase`` (periods of the load) and
        ``speed`` (m/s), of a structure ``approach_speed`` (m/s) and ``impulse`` (N s); ``phase_by``
        and so on have the derivatives under the names of the keys, per unit of the key.
    forcing_period : numpy.ndarray
        The derivatives of the period of the load, s per unit of each key; shape (keys,).
    multipliers : numpy.ndarray of complex or None
        The Floquet multipliers that ``multipliers_by`` differentiates; None for a structure, and
        where two of them coincide.
    multipliers_by : structured numpy.ndarray or None
        Their derivatives under the names of the keys.
    """

    keys: list[str]
    values: Array
    events: npt.NDArray[np.void]
    forcing_period: Array
    multipliers: npt.NDArray[np.complex128] | None
    multipliers_by: npt.NDArray[np.void] | None

    def __repr__(self) -> str:
        return f"<OrbitDerivative by {', '.join(self.keys)}: {len(self.events)} events>"


def _differentiated(made: dict[str, Any], values: dict[str, float]) -> OrbitDerivative:
    keys = list(values)
    by = np.dtype([(key, np.float64) for key in keys])
    names = [name for name, _, _ in made["numbers"][0]] if made["numbers"] else ["phase", "speed"]
    walls, kinds = np.array(made["walls"] or [""]), np.array(made["kinds"] or [""])
    fields = [("wall", walls.dtype), ("kind", kinds.dtype), *((name, np.float64) for name in names)]
    events = np.empty(len(made["numbers"]), [*fields, *((f"{name}_by", by) for name in names)])
    for index, numbers in enumerate(made["numbers"]):
        events["wall"][index], events["kind"][index] = walls[index], kinds[index]
        for name, value, derivatives in numbers:
            events[name][index], events[f"{name}_by"][index] = value, tuple(derivatives)
    multipliers, multipliers_by = None, None
    if made["multipliers"] is not None:
        multipliers = np.array([complex(*value) for value, _ in made["multipliers"]])
        rows = [tuple(complex(*pair) for pair in pairs) for _, pairs in made["multipliers"]]
        multipliers_by = np.array(rows, [(key, np.complex128) for key in keys])
    return OrbitDerivative(
        keys=keys,
        values=np.array(list(values.values()), np.float64),
        events=events,
        forcing_period=np.array(made["forcing_period"], np.float64),
        multipliers=multipliers,
        multipliers_by=multipliers_by,
    )


@dataclass(frozen=True, repr=False)
class Orbit:
    """A periodic orbit, by its events: see `orbit`.

    Attributes
    ----------
    kinds : list of str
        The kind of each event: impact, rest, release, enter, leave and so on.
    walls : list of str
        The wall of each event.
    phases : numpy.ndarray
        The instant of each event, in periods of the load from t = 0; shape (events,).
    speeds : numpy.ndarray
        Speed at each event, m/s; shape (events,).
    symmetric : bool
        Whether the events are the first half of an orbit whose second half is the mirror image.
    period : float
        Its period, s.
    forcing_period : float
        Period of the load, s.
    multipliers : numpy.ndarray of complex
        The Floquet multipliers, the largest first, two for each degree of freedom.
    stable : bool
        Whether all multipliers are within the unit circle.
    closure : float
        Distance between start and end of a free run over one period, as a share of the scales.
    state : pair of numpy.ndarray
        Displacement (m) and velocity (m/s) of every degree of freedom at the first instant of that
        run.
    time : numpy.ndarray
        Instants of that run, s; shape (rows,).
    displacement : numpy.ndarray
        Of a structure that of its first probe, m; shape (rows,), or (0,) without a probe.
    velocity : numpy.ndarray
        The same, m/s.
    derivative : OrbitDerivative or None
        Its derivatives by the keys asked for.
    """

    kinds: list[str]
    walls: list[str]
    phases: Array
    speeds: Array
    symmetric: bool
    period: float
    forcing_period: float
    multipliers: npt.NDArray[np.complex128]
    stable: bool
    closure: float
    state: tuple[Array, Array]
    time: Array
    displacement: Array
    velocity: Array
    derivative: OrbitDerivative | None

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


def orbit(
    scene: Source, *, settle: int = _core._SETTLE, rows: int = 400, derivative: Keys = ()
) -> Orbit:
    """The periodic orbit on which a motion settles, to rounding, with its Floquet multipliers.

    Parameters
    ----------
    scene : Scene, Case or callable
        Under loads with a common period: one degree of freedom between walls, or a structure of up
        to 200 degrees of freedom or modes, whose orbit is found by shooting; or a function that
        returns such a scene of the numbers in ``derivative``.
    settle : int
        Periods of the load that are run, exactly, before the motion is checked for repetition; 400
        by default, as in ``signorini orbit``.
    rows : int
        Instants of its motion that are kept beside the events.
    derivative : sequence of str or mapping of str to float
        Keys, or keys with their values, by which the orbit is differentiated, as in `derivative`: exactly, no orbit beside it is
        computed. Those of the start and of the time are refused, since no orbit depends on them.

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
        Where the motion does not repeat itself, or no orbit is found near it, and at a fold or a
        graze, where an orbit has no derivative.

    Examples
    --------
    >>> import signorini as sg
    >>> case = sg.load("rigid-walls-sine", set={"wall.*.restitution": 0.8})
    >>> found = sg.orbit(case)
    >>> found.period, found.stable, round(float(found.speeds[0]), 9)
    (0.2, True, 0.169410591)
    >>> sg.orbit(sg.load("two-masses")).multipliers.shape
    (4,)
    >>> by = sg.orbit(case, derivative=["wall.upper.restitution"]).derivative
    >>> [round(float(slope), 6) for slope in by.events["speed_by"]["wall.upper.restitution"]]
    [-0.008906, -0.074417]
    """
    values: dict[str, float] = {}
    keys: list[Any] = []
    subject: Any = scene
    if len(derivative) or (callable(scene) and not isinstance(scene, (Scene, Case))):
        scene_of, values = resolved(scene, derivative, "derivative")
        keys = builds(scene_of, values)
        if isinstance(derivative, Mapping):
            subject = scene_of(values)
    made = _core._orbit(subject, whole("settle", settle), whole("rows", rows, 1), keys)
    refused, holds = made.pop("refused"), made.pop("holds")
    if refused is not None or not holds:
        reason = refused or f"a free run misses it by {made['closure']:.1e} after a period"
        raise RunError(f"no body can follow the orbit that was found: {reason}")
    for name in ("phases", "speeds", "time", "displacement", "velocity"):
        made[name] = np.array(made[name], np.float64)
    made["state"] = tuple(np.array(part, np.float64) for part in made["state"])
    made["multipliers"] = np.array([complex(*pair) for pair in made["multipliers"]])
    by = made.pop("derivative")
    return Orbit(**made, derivative=None if by is None else _differentiated(by, values))
