"""Numbers of a scene from measured contacts or displacements."""

from __future__ import annotations

import math
import warnings
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np
import numpy.typing as npt

from ._core import ResultWarning, RunError, Scene
from ._derivative import Derivative, Keys, Source, found, resolved
from ._types import Array, check_within, known, real_numbers
from ._types import times as checked_times

_OF_CONTACTS = ("start", "approach_speed", "impulse")
_KINDS = ("displacement", *_OF_CONTACTS)

_MOST_GROWTH = 1e2
"""A small change may grow by this much: beyond, a record tells of the start more than of the keys."""

_STAGES = (0.125, 0.25, 0.5)
"""Shares of a record that are fitted one after another before the whole: a sum of squares over many
impacts has minima beside the one sought, where other impacts occur, that over few has not."""

_MOST_ALIKE = 4.0
"""Neighbouring residuals of noise correlate by chance, times the root of their number, by more than
this in one of 3e4 fits."""

_MOST_SCATTER = 10.0
"""Beyond this size, in units of their standard errors, residuals are no errors of the data."""

_OPPOSITE = 3.0
"""So many standard errors beyond zero an impulse is no small one of the other sign."""

_NO_EFFECT = 1e-12
"""A key does not change the data where its whole value, that from which the search starts if it is
larger, changes them by less than this share of the values: rounding."""

_AT_LIMIT = 1e-6
"""So near to a bound, as a share of its size, a key is at it."""

_APART = 1e-8
"""Data that one key changes as others together do, to this share, do not tell it from them: the
derivatives are exact to it."""


@dataclass(frozen=True, repr=False)
class Fit:
    """Numbers of a scene that fit data: see `fit`.

    Attributes
    ----------
    values : dict of str to float
        The fitted values of the keys.
    intervals : dict of str to pair of float
        The interval of each at the confidence asked for; from minus to plus infinity for a key that
        the data do not tell, whose value is one of many.
    covariance : numpy.ndarray
        That of the values; shape (keys, keys). Infinite variances, and NaN beside them, of keys that the
        data do not tell.
    residuals : numpy.ndarray
        Model less data, in units of the standard errors of the data; shape (data,).
    scale : float
        The root mean square of the residuals, by the degrees of freedom: 1 where the standard
        errors given are those of the data.
    until : float
        The time of the last datum used, s.
    runs : int
        Number of exact runs.
    scene : Scene
        The scene with the fitted values.
    """

    values: dict[str, float]
    intervals: dict[str, tuple[float, float]]
    covariance: Array
    residuals: Array
    scale: float
    until: float
    runs: int
    scene: Scene

    def __repr__(self) -> str:
        of = [f"{key} = {value:.6g} ({low:.6g} to {high:.6g})" for (key, value), (low, high) in self._rows()]
        return f"<Fit: {', '.join(of)}>"

    def _rows(self) -> list[tuple[tuple[str, float], tuple[float, float]]]:
        return list(zip(self.values.items(), self.intervals.values(), strict=True))


@dataclass(frozen=True)
class _Column:
    """Values of one kind, with their standard errors, and how they and their times are read from
    derivatives."""

    name: str
    values: Array
    errors: Array
    read: Callable[[Derivative], tuple[Array, npt.NDArray[np.void]]]
    times: Callable[[Derivative], Array]

    def first(self, count: int) -> _Column:
        """The first values of a record."""
        return _Column(self.name, self.values[:count], self.errors[:count], self.read, self.times)


def _numbers(name: str, values: Any) -> Array:
    column = np.atleast_1d(real_numbers(name, values))
    if column.ndim != 1:
        raise ValueError(f"{name} has the shape {column.shape}; expected a column of finite numbers")
    for row in np.flatnonzero(~np.isfinite(column))[:1]:
        raise ValueError(f"{name}[{row}] is {column[row]}; expected finite numbers: leave out what was not measured")
    return column


def _errors(name: str, values: Array, error: Mapping[str, Any] | None, several: bool) -> Array:
    if error is None or name not in error:
        if several:
            raise ValueError(f"error has no {name}; expected a standard error for each kind of data")
        return np.ones_like(values)
    errors = real_numbers(f"error of {name}", error[name])
    if errors.shape not in ((), values.shape):
        raise ValueError(f"error of {name} has the shape {errors.shape}; expected a number, or one for each datum")
    errors = np.broadcast_to(errors, values.shape)
    if not (errors > 0.0).all() or not np.isfinite(errors).all():
        raise ValueError(f"error of {name} is {error[name]!r}; expected finite numbers above 0")
    return np.array(errors)


def _check_kinds(data: Mapping[str, Any], error: Mapping[str, Any] | None) -> list[str]:
    """The kinds of the data, unless some of them, or of their errors, would not be used."""
    if not hasattr(data, "keys"):
        raise TypeError(f"data is {data!r}; expected a mapping of kinds to their values")
    if error is not None and not isinstance(error, Mapping):
        raise TypeError(f"error is {error!r}; expected a mapping of kinds to their standard errors")
    kinds = [name for name in _KINDS if name in data]
    expected = "displacement over time, start, approach_speed, impulse, and the wall of these three"
    if not kinds:
        raise ValueError(f"data has {', '.join(data) or 'nothing'}; expected {expected}")
    for name in data:
        if name not in (*_KINDS, "time", "wall"):
            raise ValueError(f"data has {name!r}; expected {expected}")
    if "time" in data and "displacement" not in data:
        raise ValueError("data has 'time' without displacement; expected both or none of them")
    if "wall" in data and kinds == ["displacement"]:
        raise ValueError("data has 'wall' beside displacement alone; expected start, approach_speed or impulse with it")
    for name in error or ():
        if name not in kinds:
            raise ValueError(f"error has {name!r}; expected kinds that data has: {', '.join(map(repr, kinds))}")
    return kinds


def _contact_columns(
    data: Mapping[str, Any], error: Mapping[str, Any] | None, scene: Scene, several: bool
) -> list[_Column]:
    """The columns of contact data: number i at a wall is its contact i in the run."""
    walls = list(scene._wall_names)
    names = [name for name in _OF_CONTACTS if name in data]
    columns = {name: _numbers(name, data[name]) for name in names}
    sizes = {len(column) for column in columns.values()}
    if len(sizes) != 1:
        raise ValueError(f"data has columns of {sorted(sizes)} values; expected one for each contact")
    count = sizes.pop()
    given = data.get("wall", walls[0] if len(walls) == 1 else None)
    if given is None:
        raise ValueError(f"data has no wall; expected one of {', '.join(walls) or 'a scene with walls'}, or one for each contact")
    wall = [given] * count if isinstance(given, str) else [str(name) for name in given]
    if len(wall) != count or not set(wall) <= set(walls):
        raise ValueError(f"data: wall is {given!r}; expected {count} of {', '.join(walls) or 'a scene with walls'}")
    errors = {name: _errors(name, column, error, several) for name, column in columns.items()}
    if "impulse" in columns:
        least = _OPPOSITE * errors["impulse"] if error is not None and "impulse" in error else np.zeros(count)
        _check_signs(columns["impulse"], least, wall, {one.name: one.side for one in scene.walls})
    if "approach_speed" in columns:
        least = _OPPOSITE * errors["approach_speed"] if error is not None else np.zeros(count)
        for speed in columns["approach_speed"][columns["approach_speed"] < -least]:
            raise ValueError(f"data: approach_speed is {speed:g} m/s; expected 0 or more, as in run.contacts")
    if "start" in columns:
        check_within("data: start", columns["start"], scene.duration)
    number = [wall[:i].count(name) for i, name in enumerate(wall)]
    for name in set(wall) if "start" in columns else ():
        own = columns["start"][[one == name for one in wall]]
        if (np.diff(own) <= 0.0).any():
            raise ValueError(f"data: the starts at wall {name!r} do not increase; expected contacts in their order")

    def rows(by: Derivative) -> npt.NDArray[np.int64] | None:
        own = {name: np.flatnonzero(by.contacts["wall"] == name) for name in set(wall)}
        for name, places in own.items():
            own[name] = places[np.argsort(by.contacts["start"][places], kind="stable")]
        if any(i >= len(own[name]) for name, i in zip(wall, number, strict=True)):
            return None
        return np.array([own[name][i] for name, i in zip(wall, number, strict=True)], np.int64)

    def reader(name: str) -> Callable[[Derivative], tuple[Array, npt.NDArray[np.void]]]:
        def read(by: Derivative) -> tuple[Array, npt.NDArray[np.void]]:
            at = rows(by)
            if at is None:
                return np.full(count, np.nan), np.full((count, len(by.keys)), np.nan).view(
                    by.contacts[f"{name}_by"].dtype
                ).reshape(count)
            return by.contacts[name][at], by.contacts[f"{name}_by"][at]

        return read

    def times(by: Derivative) -> Array:
        at = rows(by)
        return np.empty(0) if at is None else by.contacts["start"][at]

    return [_Column(name, columns[name], errors[name], reader(name), times) for name in names]


def _check_signs(impulses: Array, least: Array, walls: Sequence[str], sides: Mapping[str, str]) -> None:
    """Refuses impulses that a wall cannot give, by more than ``least``: magnitudes, at an upper wall."""
    signs = {"upper": -1.0, "lower": 1.0}
    for impulse, one, name in zip(impulses, least, walls, strict=True):
        if (side := sides.get(name)) in signs and signs[side] * impulse < -one:
            sign = "negative" if side == "upper" else "positive"
            expected = f"{sign} ones on the structure by this {side} wall, as in run.contacts"
            raise ValueError(f"data: impulse at wall {name!r} is {impulse:g} N s; expected {expected}")


def fit(
    source: Source,
    keys: Keys,
    data: Mapping[str, Any],
    *,
    error: Mapping[str, Any] | None = None,
    probe: str | None = None,
    bounds: Mapping[str, tuple[float, float]] | None = None,
    confidence: float = 0.95,
) -> Fit:
    """The values of keys with which the exact motion of a scene fits data best, in the sense of
    least squares, with their intervals.

    SciPy's ``least_squares`` does the search; residuals and their derivatives are exact
    (`derivative`). A record is fitted in stages, its first eighth, quarter, half and the whole, each
    from the values of the one before: beside the values sought there are others with other impacts,
    at which the residuals of the whole are smallest around. The intervals are those of the
    linearised model: by Student's t from the scatter of the residuals, whatever the size of the
    standard errors given. A key has none where it does not change the data, or where other keys
    together change them in the same way (mass, damping, stiffness and load leave all instants as
    they are when they grow by one factor): a warning names these keys.

    Parameters
    ----------
    source : Scene, Case or callable
        As in `derivative`; its duration has to reach beyond the data.
    keys : sequence of str or mapping of str to float
        The keys, or the values from which the search starts; else those of the source.
    data : mapping
        Contacts: one or several of ``start`` (s), ``approach_speed`` (m/s) and ``impulse`` (N s, on
        the structure: negative at an upper wall, as in `Run.contacts`), and ``wall``, a name or one
        for each, where there are several walls; number i at a wall is its contact i in the motion.
        Or a record: ``time`` (s, increasing) and ``displacement`` (m). Of a record the rows are
        left out beyond which a small change has grown by 100 in the motion from which the search
        starts: those tell nothing of the keys. Contacts and a record may be given together.
    error : mapping of str to float or array, optional
        The standard error of each kind of data; needed where there is more than one kind.
    probe : str, optional
        That of the record; the first if left out.
    bounds : mapping of str to (low, high), optional
        Bounds of keys.
    confidence : float
        Of the intervals.

    Returns
    -------
    Fit

    Raises
    ------
    ValueError
        For data that do not fit the scene, as fewer contacts in its motion than in the data, a start
        after its end, a negative approach speed, or impulses of the other sign than a wall gives,
        for a key that starts outside of its bounds, and as `derivative`.
    TypeError
        For data or errors that are no mapping.
    RunError
        Where the search does not converge.
    ImportError
        Without SciPy.

    Warns
    -----
    ResultWarning
        For keys that the data do not tell, and where the residuals are above 10 standard errors.
        For keys that end at a bound, or where the scene takes no values beyond, as at a damping of
        0: intervals of a linearised model are none of the confidence asked for there. For an
        interval that reaches beyond the bounds of its key, or the values that the scene takes. And
        where neighbouring residuals correlate more than noise does.

    Examples
    --------
    >>> import signorini as sg
    >>> def ball(height, restitution):
    ...     floor = sg.Wall.lower("floor", 0.0, restitution=restitution)
    ...     weight = sg.Load.constant(-9.81)
    ...     return sg.oscillator(1.0, 0.0, 0.0, walls=[floor], loads=[weight], displacement=height, duration=3.0)
    >>> start = [0.3193, 0.8301, 1.2384, 1.5648]  # heard, s
    >>> found = sg.fit(ball, {"height": 0.4, "restitution": 0.7}, {"start": start})
    >>> round(found.values["height"], 2), round(found.values["restitution"], 2)
    (0.5, 0.8)
    """
    try:
        from scipy.optimize import least_squares
        from scipy.stats import t as student
    except ImportError as missing:
        raise ImportError("sg.fit needs SciPy: pip install 'signorini[fit]'") from missing
    scene_of, values = resolved(source, keys)
    names, x0 = list(values), np.array(list(values.values()), np.float64)
    if not 0.0 < confidence < 1.0:
        raise ValueError(f"confidence is {confidence!r}; expected a number between 0 and 1")
    bounds = known("bounds", bounds, names)
    kinds = _check_kinds(data, error)
    for name, value in zip(names, x0, strict=True):
        lowest, highest = bounds.get(name, (-np.inf, np.inf))
        if not lowest <= value <= highest:
            raise ValueError(f"{name} starts from {value:g}; expected from {lowest:g} to {highest:g}, its bounds")
    first = scene_of(values)
    times: Array = np.empty(0)
    columns: list[_Column] = []
    if "displacement" in data:
        record = _record(scene_of, values, data, error, probe, len(kinds) > 1)
        times, columns = record.times, [record.column]
    if kinds != ["displacement"]:
        columns += _contact_columns(data, error, first, len(kinds) > 1)
    count = sum(len(column.values) for column in columns)
    if count <= len(names):
        raise ValueError(f"data has {count} usable values; expected more than the {len(names)} keys")
    model = _Model(scene_of, names, columns, times, probe)
    began = model.at(x0)
    if not np.isfinite(began[0]).all():
        raise ValueError(f"no residuals in the motion from which the search starts: {model.reason}")
    low = [bounds.get(name, (-np.inf, np.inf))[0] for name in names]
    high = [bounds.get(name, (-np.inf, np.inf))[1] for name in names]
    size = np.where(x0 == 0.0, 1.0, np.abs(x0))

    def search(model: _Model, x: Array, tolerance: float) -> Any:
        def residuals_at(x: Array) -> Array:
            return model.at(x)[0]

        def jacobian_at(x: Array) -> Array:
            return model.at(x)[1]

        # No bound of the gradient: it has the unit of the residuals.
        return least_squares(
            residuals_at, x, jac=jacobian_at, bounds=(low, high), x_scale=size,
            xtol=tolerance, ftol=tolerance, gtol=None,
        )  # fmt: skip

    x = x0
    for share in _STAGES if len(times) else ():
        rows = int(share * len(times))
        stage = _Model(scene_of, names, [columns[0].first(rows)], times[:rows], probe)
        residuals, jacobian = stage.at(x)
        if rows > 2 * len(names) and np.isfinite(residuals).all():
            if _told(_scale(x0, x, np.subtract(high, low)), jacobian, stage.size()).rank == len(names):
                staged = search(stage, x, 1e-6)
                x = staged.x if staged.success and np.isfinite(model.at(staged.x)[0]).all() else x
        model.runs += stage.runs
    made = search(model, x, 1e-12)
    if not made.success:
        raise RunError(f"the search did not converge: {made.message}")
    residuals, jacobian = model.at(made.x)
    scale = _scale(x0, made.x, np.subtract(high, low))
    told = _told(scale, jacobian, model.size())
    limits = _limits(scene_of, dict(zip(names, made.x.tolist(), strict=True)), scale, bounds)
    limits = {name: limit for (name, limit), unseen in zip(limits.items(), told.unseen, strict=True) if not unseen}
    for text in [*_untold(names, told), *_limited(limits, confidence, len(names))]:
        warnings.warn(text, ResultWarning, stacklevel=2)
    freedom = count - told.rank
    quantile = float(student.ppf(0.5 + confidence / 2, freedom))
    summary = _summary(made.x, names, (residuals, told), (model, scene_of), freedom, quantile)
    within = {name: ends for name, ends in summary.intervals.items() if limits.get(name) is None}
    texts = [*_beyond(scene_of, summary.values, within, bounds), *_no_noise(columns, residuals)]
    if error and summary.scale > _MOST_SCATTER:
        text = f"scale is {summary.scale:.3g}: the residuals are so many standard errors of the data, "
        texts.append(text + "so the scene with these values does not describe them")
    for text in texts:
        warnings.warn(text, ResultWarning, stacklevel=2)
    return summary


def _beyond(
    scene_of: Callable[[Mapping[str, float]], Scene],
    values: Mapping[str, float],
    intervals: Mapping[str, tuple[float, float]],
    bounds: Mapping[str, tuple[float, float]],
) -> list[str]:
    """Which intervals reach beyond the bounds of their keys, or the values that the scene takes, in words."""
    texts = []
    for name, (a, b) in intervals.items():
        if not math.isfinite(b - a):
            continue
        least, most = bounds.get(name, (-math.inf, math.inf))
        if not least <= a <= b <= most:
            texts.append(f"the interval of {name}, {a:.6g} to {b:.6g}, reaches beyond its bounds, {least:g} to {most:g}")
        elif not all(_taken(scene_of, {**values, name: end}) for end in (a, b)):
            texts.append(f"the interval of {name}, {a:.6g} to {b:.6g}, reaches beyond the values that the scene takes")
    return texts


def _no_noise(columns: Sequence[_Column], residuals: Array) -> list[str]:
    """That neighbouring residuals of a kind of data correlate, in words."""
    texts = []
    parts = np.split(residuals, np.cumsum([len(one.values) for one in columns])[:-1])
    for column, own in zip(columns, parts, strict=True):
        square = float(own @ own)
        alike = float(own[:-1] @ own[1:]) / square if square > 0.0 else 0.0
        # Of exact data what is left is rounding.
        rounding = np.sqrt(square) <= _APART * np.linalg.norm(column.values / column.errors)
        if alike * math.sqrt(len(own)) > _MOST_ALIKE and not rounding:
            text = f"the residuals of the {column.name} are no noise: those of neighbours correlate by {alike:.2f}, "
            text += "so the intervals mean nothing; the scene may lack something, or the search may have ended "
            texts.append(text + "beside the values sought: start nearer to them, or with fewer data")
    return texts


@dataclass(frozen=True)
class _Told:
    """What the data tell of the keys."""

    unseen: npt.NDArray[np.bool_]
    """The keys that do not change the data."""
    mixed: npt.NDArray[np.bool_]
    """Those whose effect on the data is one that others together have."""
    rank: int
    """Number of combinations of keys that the data tell."""
    inverse: Array
    """The pseudo-inverse of the Jacobian; shape (keys, data)."""


def _scale(x0: Array, x: Array, width: Array) -> Array:
    """The sizes of keys that go from ``x0`` to ``x`` between bounds that are ``width`` apart."""
    size = np.maximum(np.abs(x0), np.abs(x))
    return np.where(size > 0.0, np.minimum(size, width), np.where(np.isfinite(width), width, 1.0))


def _taken(scene_of: Callable[[Mapping[str, float]], Scene], values: Mapping[str, float]) -> bool:
    """True if there is a scene with these values."""
    try:
        scene_of(values)
    except Exception:  # Whatever a function raises beyond the values that it was made for.
        return False
    return True


def _limits(
    scene_of: Callable[[Mapping[str, float]], Scene],
    values: Mapping[str, float],
    scale: Array,
    bounds: Mapping[str, tuple[float, float]],
) -> dict[str, float | None]:
    """The limit at which each key is: a bound, or where there is no scene with larger or smaller values."""

    def taken(key: str, value: float) -> bool:
        return _taken(scene_of, {**values, key: value})

    def at(key: str, near: float) -> float | None:
        value = values[key]
        for end in bounds.get(key, ()):
            if abs(value - end) <= near:
                return end
        for beyond in (value - near, value + near):
            if not taken(key, beyond):
                inside = value
                for _ in range(10):
                    middle = 0.5 * (inside + beyond)
                    inside, beyond = (middle, beyond) if taken(key, middle) else (inside, middle)
                # To a digit that the halves have told; no minus before 0.
                return round(inside, 2 - math.floor(math.log10(near))) + 0.0
        return None

    return {key: at(key, _AT_LIMIT * float(size)) for key, size in zip(values, scale, strict=True)}


def _limited(limits: Mapping[str, float | None], confidence: float, keys: int) -> list[str]:
    """Which keys are at their limits, in words."""
    what = "its interval is no" if keys == 1 else "its interval and those of the others are no"
    return [
        f"{name} is at its limit {limit:.6g}: {what} {100.0 * confidence:g} % interval{'' if keys == 1 else 's'}"
        for name, limit in limits.items()
        if limit is not None
    ]


def _told(scale: Array, jacobian: Array, data: float) -> _Told:
    """By the Jacobian for keys of the sizes ``scale``, of data of the size ``data``, both in units of
    the standard errors."""
    size = np.linalg.norm(jacobian, axis=0)
    unseen = size * scale <= _NO_EFFECT * data
    # In units of the columns, which may differ by far.
    size[unseen] = 1.0
    columns = np.where(unseen, 0.0, jacobian / size)
    mixed = np.zeros(len(scale), bool)
    for key in np.flatnonzero(~unseen):
        others = np.delete(columns, key, axis=1)
        like = others @ (np.linalg.pinv(others, rcond=_APART) @ columns[:, key])
        mixed[key] = np.linalg.norm(columns[:, key] - like) < _APART
    rank = int(np.linalg.matrix_rank(columns, tol=_APART))
    return _Told(unseen, mixed, rank, np.linalg.pinv(columns, rcond=_APART) / size[:, None])


def _untold(names: list[str], told: _Told) -> list[str]:
    """What the data do not tell, in words."""
    unseen, mixed = ([name for name, one in zip(names, of, strict=True) if one] for of in (told.unseen, told.mixed))
    texts = []
    if unseen:
        subject, verb = ", ".join(unseen), "does" if len(unseen) == 1 else "do"
        texts.append(f"{subject} {verb} not change the data: no interval")
    if mixed:
        *most, last = mixed
        together = f"{', '.join(most)} and {last}" if most else last
        texts.append(f"the data do not tell {together} apart: no intervals; keep one of them fixed, or give other data too")
    return texts


def _summary(
    x: Array,
    names: list[str],
    found: tuple[Array, _Told],
    origin: tuple[_Model, Callable[[Mapping[str, float]], Scene]],
    freedom: int,
    quantile: float,
) -> Fit:
    (residuals, told), (model, scene_of) = found, origin
    variance = float(residuals @ residuals) / freedom
    covariance = variance * (told.inverse @ told.inverse.T)
    none = np.flatnonzero(told.unseen | told.mixed)
    covariance[none, :] = covariance[:, none] = np.nan
    covariance[none, none] = np.inf
    half = quantile * np.sqrt(np.diag(covariance))
    values = {name: float(value) for name, value in zip(names, x, strict=True)}
    return Fit(
        values=values,
        intervals={name: (float(a - h), float(a + h)) for name, a, h in zip(names, x, half, strict=True)},
        covariance=covariance,
        residuals=residuals,
        scale=float(np.sqrt(variance)),
        until=model.until,
        runs=model.runs,
        scene=scene_of(values),
    )


@dataclass(frozen=True)
class _Record:
    times: Array
    column: _Column


def _record(
    scene_of: Callable[[Mapping[str, float]], Scene],
    values: Mapping[str, float],
    data: Mapping[str, Any],
    error: Mapping[str, Any] | None,
    probe: str | None,
    several: bool,
) -> _Record:
    """A record of displacements, up to the horizon of the motion from which the search starts."""
    if "time" not in data:
        raise ValueError("data has no time; expected the times of the displacements, s")
    times, measured = _numbers("time", data["time"]), _numbers("displacement", data["displacement"])
    if times.shape != measured.shape:
        raise ValueError(f"data has {len(times)} times and {len(measured)} displacements; expected as many")
    checked_times("data: time", times, scene_of(values).duration)
    errors = _errors("displacement", measured, error, several)
    by = found(scene_of, values, (), None)
    late = by.contacts["start"][by.contacts["growth"] > _MOST_GROWTH]
    until = min([*by.until_by.values(), *late.tolist()])
    kept = times < until if until < float(times[-1]) else np.ones(len(times), bool)

    def read(by: Derivative) -> tuple[Array, npt.NDArray[np.void]]:
        return by.displacement, by.displacement_by

    return _Record(times[kept], _Column("displacement", measured[kept], errors[kept], read, lambda by: by.time))


class _Model:
    """Residuals and Jacobian at values of the keys, the last ones kept."""

    def __init__(
        self,
        scene_of: Callable[[Mapping[str, float]], Scene],
        names: list[str],
        columns: list[_Column],
        times: Array,
        probe: str | None,
    ) -> None:
        self._scene_of, self._names, self._columns = scene_of, names, columns
        self._times, self._probe = times, probe
        self._last: tuple[Array, Array, Array] | None = None
        self.reason, self.until, self.runs = "", 0.0, 0

    def at(self, x: Array) -> tuple[Array, Array]:
        """Residuals and Jacobian; NaN where the motion does not reach the data, a step that
        ``least_squares`` then shortens."""
        if self._last is None or not np.array_equal(self._last[0], x):
            self._last = (np.array(x), *self._computed(x))
        return self._last[1], self._last[2]

    def size(self) -> float:
        """The size of the data, in units of their standard errors."""
        return float(np.linalg.norm(np.concatenate([column.values / column.errors for column in self._columns])))

    def _computed(self, x: Array) -> tuple[Array, Array]:
        count = sum(len(column.values) for column in self._columns)
        values = dict(zip(self._names, x.tolist(), strict=True))
        self.runs += 1
        try:
            by = found(self._scene_of, values, self._times, self._probe)
        except (ValueError, RunError) as refused:
            self.reason = str(refused)
            return np.full(count, np.nan), np.full((count, len(x)), np.nan)
        residuals, jacobian = [], []
        for column in self._columns:
            model, derived = column.read(by)
            residuals.append((model - column.values) / column.errors)
            jacobian.append(np.column_stack([derived[name] for name in self._names]) / column.errors[:, None])
        self.reason = next(iter(by.ended_by.values()), by.ended or "it has fewer contacts than the data")
        self.until = float(np.concatenate([column.times(by) for column in self._columns]).max(initial=0.0))
        known = np.isfinite(np.concatenate(jacobian)).all(axis=1)
        return np.where(known, np.concatenate(residuals), np.nan), np.concatenate(jacobian)
