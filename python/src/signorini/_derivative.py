"""Derivatives of exact runs with respect to the numbers of a scene."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from functools import partial
from typing import Any, TypeAlias

import numpy as np
import numpy.typing as npt

from . import _core
from ._core import Case, Scene
from ._types import Array, names
from ._types import times as checked_times

Source: TypeAlias = Scene | Case | Callable[..., Scene]
"""A scene, a case, or a function that returns a scene of named numbers."""

Keys = Sequence[str] | Mapping[str, float]

Build = tuple[str, float, Callable[[float], Scene]]
"""A key: its name, its value, and the scene at another value."""


@dataclass(frozen=True, repr=False)
class Derivative:
    """The derivatives of an exact run: see `derivative`.

    Attributes
    ----------
    keys : list of str
        The names of the keys.
    values : numpy.ndarray
        Their values; shape (keys,).
    contacts : structured numpy.ndarray
        The contacts in the order of their ends, shape (contacts,): ``wall``, ``start`` and ``end``
        (s), ``approach_speed`` and ``departure_speed`` (m/s), ``impulse`` (N s), ``growth``;
        ``start_by``, ``end_by``, ``approach_speed_by``, ``departure_speed_by`` and ``impulse_by``
        have the derivatives under the names of the keys, per unit of the key. Those of end and
        departure speed are NaN where several impacts elsewhere at once end a lasting contact.
    time : numpy.ndarray
        The times asked for, s; shape (times,).
    displacement : numpy.ndarray
        Of the probe at these times, m; shape (times,). NaN after ``until``.
    velocity : numpy.ndarray
        The same, m/s; shape (times,).
    displacement_by : structured numpy.ndarray
        Its derivatives under the names of the keys, m per unit of the key; shape (times,).
    velocity_by : structured numpy.ndarray
        Those of the velocity, m/s per unit of the key; shape (times,).
    mean : structured numpy.ndarray or None
        Means over the whole run, one row for each number: ``name`` (``displacement`` and ``rms``,
        in m, with the name of the probe after a colon where it has one, and ``force:``, in N, with
        that of the wall), ``value``, and ``by``, the derivatives under the names of the keys. None
        if the derivatives end before the run does.
    growth : float
        The largest growth of a small change of the start since it was smallest.
    until : float
        The time up to which there are derivatives, s.
    ended : str or None
        Why there are none after it; None if they reach to the end.
    until_by : dict of str to float
        For each key the time up to which there are derivatives by it, s; they are NaN afterwards.
    ended_by : dict of str to str
        Why they end, of the keys by which they end alone while those by other keys go on.
    """

    keys: list[str]
    values: Array
    contacts: npt.NDArray[np.void]
    time: Array
    displacement: Array
    velocity: Array
    displacement_by: npt.NDArray[np.void]
    velocity_by: npt.NDArray[np.void]
    mean: npt.NDArray[np.void] | None
    growth: float
    until: float
    ended: str | None
    until_by: dict[str, float]
    ended_by: dict[str, str]

    def __repr__(self) -> str:
        reasons = list(self.ended_by.values())
        if self.ended and len(reasons) < len(self.keys):
            reasons.append(self.ended)
        ended = "".join(f"; {reason}" for reason in reasons)
        return f"<Derivative by {', '.join(self.keys)}: {len(self.contacts)} contacts to {self.until:.6g} s{ended}>"


def resolved(
    source: Source, keys: Keys, called: str = "keys"
) -> tuple[Callable[[Mapping[str, float]], Scene], dict[str, float]]:
    """The function from the values of `keys`, which errors call `called`, to a scene, and their
    values in `source`."""
    names(called, keys, "wall.stop.position")

    def given(own: dict[str, float]) -> dict[str, float]:
        return {**own, **keys} if isinstance(keys, Mapping) else own

    if isinstance(source, Scene):
        own = {key: _core._value_at(source, key) for key in keys}
        scene = source
        return lambda values: _core._scene_at(scene, list(values.items())), given(own)
    if isinstance(source, Case):
        own = {key: _core._case_value_at(source, key) for key in keys}
        case = source
        return lambda values: _core._case_scene_at(case, list(values.items())), given(own)
    if not isinstance(keys, Mapping):
        raise ValueError(f"{called} is {keys!r}; expected a mapping of the arguments of the function to their values")
    return lambda values: source(**values), dict(keys)


def builds(scene_of: Callable[[Mapping[str, float]], Scene], values: Mapping[str, float]) -> list[Build]:
    """Each key with the function from its value to a scene, the others staying as they are."""

    def at(key: str, value: float) -> Scene:
        return scene_of({**values, key: value})

    return [(key, float(value), partial(at, key)) for key, value in values.items()]


def found(
    scene_of: Callable[[Mapping[str, float]], Scene],
    values: Mapping[str, float],
    times: Sequence[float] | Array = (),
    probe: str | None = None,
) -> Derivative:
    """The derivatives at these values of the keys."""
    scene = scene_of(values)
    rows = checked_times("times", times, scene.duration)
    made = _core._derivative(scene, builds(scene_of, values), rows.tolist())
    keys = list(values)
    by = np.dtype([(key, np.float64) for key in keys])

    def named(flat: Array, count: int) -> npt.NDArray[np.void]:
        return np.ascontiguousarray(flat.reshape(count, len(keys))).view(by).reshape(count)

    count = len(made["wall"])
    walls = np.array(made["wall"] or [""])
    numbers = ["start", "end", "approach_speed", "departure_speed", "impulse", "growth"]
    derived = [f"{name}_by" for name in numbers[:-1]]
    contacts = np.empty(
        count, [("wall", walls.dtype), *((name, np.float64) for name in numbers), *((name, by) for name in derived)]
    )
    contacts["wall"] = walls[:count]
    for name in numbers:
        contacts[name] = made["contact_growth" if name == "growth" else name]
    for name in derived:
        contacts[name] = named(made[name], count)
    if probe is not None and probe not in scene.probes:
        raise ValueError(f"probe is {probe!r}; expected one of {', '.join(map(repr, scene.probes)) or 'none'}")
    number = scene.probes.index(probe) if probe is not None else 0
    shape = (len(rows), max(len(scene.probes), 1))

    mean = None
    if made["mean"] is not None:
        rows_of_mean: list[tuple[str, float, list[float]]] = made["mean"]
        names = np.array([name for name, _, _ in rows_of_mean] or [""])
        mean = np.empty(len(rows_of_mean), [("name", names.dtype), ("value", np.float64), ("by", by)])
        for number_of_mean, (name, value, derivatives) in enumerate(rows_of_mean):
            mean[number_of_mean] = (name, value, tuple(derivatives))

    def of_probe(flat: Array) -> Array:
        column: Array = np.full(len(rows), np.nan) if not scene.probes else flat.reshape(shape)[:, number].copy()
        return column

    def by_probe(flat: Array) -> npt.NDArray[np.void]:
        if not scene.probes:
            return np.full((len(rows), len(keys)), np.nan).view(by).reshape(len(rows))
        return named(np.ascontiguousarray(flat.reshape(*shape, len(keys))[:, number]), len(rows))

    return Derivative(
        keys=keys,
        values=np.array(list(values.values()), np.float64),
        contacts=contacts,
        time=rows,
        displacement=of_probe(made["displacement"]),
        velocity=of_probe(made["velocity"]),
        displacement_by=by_probe(made["displacement_by"]),
        velocity_by=by_probe(made["velocity_by"]),
        mean=mean,
        growth=made["growth"],
        until=made["until"],
        ended=made["ended"],
        until_by={**dict.fromkeys(keys, made["until"]), **{key: time for key, time, _ in made["lost"]}},
        ended_by={key: reason for key, _, reason in made["lost"]},
    )


def of_run(scene: Scene, keys: Sequence[str], times: Sequence[float]) -> Derivative:
    """The derivatives of a run of `scene`, as `Run.derivative` says."""
    return derivative(scene, keys, times=times)


def derivative(
    source: Source, keys: Keys, *, times: Sequence[float] | Array | None = None, probe: str | None = None
) -> Derivative:
    """The derivatives of the exact run of a scene with respect to its numbers.

    They are exact, through flights, impacts and lasting contact: no motion is repeated with changed
    numbers. Where a derivative means nothing (a wall that is grazed, a time beyond which the motion
    is not predictable) there is none, and ``ended`` says why. Where one key is the reason (a blow
    that it moves into a rest, a restitution of 0), ``ended_by`` says so and the others go on.

    Parameters
    ----------
    source : Scene, Case or callable
        A scene; a case, whose keys are those of its file; or a function that returns the scene of
        the numbers given to it.
    keys : sequence of str or mapping of str to float
        Of a scene ``wall.NAME.position``, ``.restitution``, ``.stiffness``, ``.damping``,
        ``load.N.constant.force``, ``load.N.harmonic.amplitude``, ``.frequency``, ``.phase``,
        ``load.N.impulse.impulse``, ``initial.displacement.I``, ``initial.velocity.I``,
        ``system.oscillator.mass``, ``.damping``, ``.stiffness``; of a case any key of its file that
        has a number; of a function its arguments with their values.
    times : sequence of float, optional
        Where displacement and velocity are wanted, s; increasing, from 0 to the end of the motion.
    probe : str, optional
        Of which; the first if left out.

    Returns
    -------
    Derivative

    Raises
    ------
    ValueError
        For a key that the scene does not have, or on which it does not depend smoothly, for times
        beyond the motion, and for a scene with round supports.
    RunError
        Where the exact scheme cannot follow the motion.

    Examples
    --------
    >>> import signorini as sg
    >>> def scene(gap, restitution):
    ...     stop = sg.Wall.upper("stop", gap, restitution=restitution)
    ...     return sg.oscillator(1.0, 0.2, 100.0, walls=[stop], loads=[sg.Load.harmonic(3.0, 2.5)])
    >>> by = sg.derivative(scene, {"gap": 5e-3, "restitution": 0.6})
    >>> first = by.contacts[0]
    >>> float(first["impulse_by"]["restitution"] / first["impulse"]).__round__(6)  # 1/(1 + e)
    0.625
    """
    scene_of, values = resolved(source, keys)
    return found(scene_of, values, () if times is None else times, probe)
