"""Many runs: on this machine's cores, or on those of any executor."""

from __future__ import annotations

import itertools
import math
import os
import time
import traceback
import warnings
from collections.abc import Callable, Iterable, Mapping, Sequence
from concurrent.futures import BrokenExecutor, as_completed
from typing import Any, overload

import numpy as np
import numpy.typing as npt

from ._case_sweep import SweepResult, sweep_case
from ._core import Case, ResultWarning, Scene, _cautioned, _columns, _run_many
from ._progress import Progress
from ._store import Store
from ._types import check_given, sequence, whole

Table = dict[str, npt.NDArray[Any]]
"""Columns of equal length, by name."""

Caution = tuple[str | None, str | None]
"""What limits the use of a run: a note, and that it has not settled."""

# Numbers, the reasons where there are none, and what limits the use of each row.
_Rows = tuple[npt.NDArray[np.float64], list[str | None], list[Caution]]

# For a task of two seconds the overhead of a scheduler is a thousandth, and a lost machine loses
# only so much work. Where this would make few tasks, they are shorter, but still long compared with
# the overhead.
_SECONDS_PER_TASK = 2.0
_LEAST_SECONDS = 0.05
_TASKS = 64
_TRIED = 8


def grid(**axes: Iterable[Any]) -> list[dict[str, Any]]:
    """Every combination of the values of ``axes``, the last axis fastest.

    Parameters
    ----------
    **axes : iterable
        The values of each name.

    Returns
    -------
    list of dict
        A dict of one value for each name, for each combination.

    Examples
    --------
    >>> import signorini as sg
    >>> sg.grid(gap=[1e-3, 2e-3], restitution=[0.5, 0.8])[1]
    {'gap': 0.001, 'restitution': 0.8}
    """
    for name, values in axes.items():
        if not isinstance(values, Iterable):
            raise TypeError(f"{name} is {values!r}; expected a sequence of values")
    return [dict(zip(axes, point, strict=True)) for point in itertools.product(*axes.values())]


def run_many(
    scenes: Iterable[Scene],
    scheme: str | None = None,
    *,
    step: float | None = None,
    statistics_from: float = 0.0,
    judge: bool = True,
    threads: int | None = None,
    progress: bool = True,
) -> Table:
    """Run scenes side by side on this machine's cores; the motions themselves are not kept.

    Parameters
    ----------
    scenes : iterable of Scene
        With walls of the same names.
    scheme, step, statistics_from
        As in `Scene.run`.
    judge : bool
        Whether every run is checked step by step; it takes most of the time of a short run. Without
        it rows have the status ``unjudged``.
    threads : int, optional
        All cores if left out.
    progress : bool
        Whether a terminal shows the progress, after a second.

    Returns
    -------
    dict of str to numpy.ndarray of shape (scenes,)
        Contact statistics of each wall over the window, with half widths of 95 % intervals;
        ``status`` is ``ok``, ``unjudged`` (nothing checked its steps) or ``failed``; ``error`` is
        None, or the reason why a row has no numbers.

    Raises
    ------
    ValueError
        For a scheme that there is not, a step that is missing, and walls of other names. What a
        scene cannot be run with (a step or a window beyond its duration, a penalty without
        stiffness) is the ``error`` of its row.

    Warns
    -----
    ResultWarning
        Once, with their number, where runs have notes that limit the use of their results, and once
        where more have not settled when their statistics begin than chance finds.
    RuntimeWarning
        Where rows failed, with their number and the first reason.

    Examples
    --------
    >>> import signorini as sg
    >>> scene = sg.load("rigid-walls-sine").scene
    >>> table = sg.run_many([scene.replace(duration=d) for d in (0.5, 1.0)], "event")
    >>> table["contacts_upper"]
    array([3., 5.])
    """
    if isinstance(scenes, Scene):
        raise TypeError(f"scenes is {scenes!r}; expected a sequence of scenes")
    scenes = list(scenes)
    for number, scene in enumerate(scenes):
        if not isinstance(scene, Scene):
            raise TypeError(f"scenes[{number}] is {scene!r}; expected a Scene, as that of a case: case.scene")
    options = _options(scheme, step, statistics_from, judge, threads)
    names = scenes[0]._wall_names if scenes else ()
    with Progress(len(scenes), progress) as shown:
        rows = _run_many(scenes, *options, shown.tell)
    warn_of_failures(rows[1])
    warn_of_runs(rows[2])
    return _table(names, rows, judge)


@overload
def sweep(
    make: Case,
    points: Mapping[str, Sequence[Any]],
    scheme: str | None = None,
    *,
    measures: Sequence[str],
    settle: int | None = None,
    keep: int | None = None,
    seeds: int | None = None,
    until_interval: float | None = None,
    most_seeds: int | None = None,
    random: str | None = None,
    rows: int | None = None,
    seed: int | None = None,
    threads: int | None = None,
    folder: str | os.PathLike[str] | None = None,
    progress: bool = True,
) -> SweepResult: ...


@overload
def sweep(
    make: Callable[..., Scene],
    points: Iterable[Mapping[str, Any]],
    scheme: str | None = None,
    *,
    step: float | None = None,
    statistics_from: float | None = None,
    judge: bool | None = None,
    threads: int | None = None,
    executor: Any = None,
    chunk: int | None = None,
    folder: str | os.PathLike[str] | None = None,
    progress: bool = True,
) -> Table: ...


def sweep(
    make: Callable[..., Scene] | Case,
    points: Any,
    scheme: str | None = None,
    *,
    measures: Sequence[str] | None = None,
    settle: int | None = None,
    keep: int | None = None,
    seeds: int | None = None,
    until_interval: float | None = None,
    most_seeds: int | None = None,
    random: str | None = None,
    rows: int | None = None,
    seed: int | None = None,
    step: float | None = None,
    statistics_from: float | None = None,
    judge: bool | None = None,
    threads: int | None = None,
    executor: Any = None,
    chunk: int | None = None,
    folder: str | os.PathLike[str] | None = None,
    progress: bool = True,
) -> Table | SweepResult:
    """Run ``make(**point)`` for every point, or a case for every combination of values of its keys.

    The table is the same to the last bit wherever it is run. That of a case is the one that
    ``signorini sweep`` writes; the values of its keys may also be drawn at random.

    Parameters
    ----------
    make : callable or Case
        Returns the Scene of a point. For an executor of other processes it has to be pickled: a
        function of a module (Dask also takes one of a notebook).
    points : iterable of mapping, or mapping of str to sequence
        All with the same names, none of them that of a column of results; `grid` makes them. Of a
        case: the values of each key of the case format, ``{"support.*.gap": [1e-4, 2e-4]}``; the
        last key varies fastest. With ``random`` the bounds of each, ``{"support.*.gap": (1e-4,
        4e-4)}``, or ``(1e-4, 4e-4, "log")`` to draw its logarithm.
    scheme
        As in `run_many`.
    measures : sequence of str
        Of a case: names of measures, as ``signorini sweep --measure``. ``"attractor"`` over
        ``initial.displacement`` and ``initial.velocity`` gives basins of attraction:
        `SweepResult.attractors` describes the attractors by the numbers of that column.
    settle, keep : int, optional
        Of a case: periods of the load before the window of the measures and in it, in place of its
        ``time.statistics_from`` and ``time.end``. ``"attractor"`` and ``"period"`` need ``keep``.
    seeds : int, optional
        Of a case: realisations of its random loads under which each row is run, 2 or more.
    until_interval : float, optional
        Of a case, in place of ``seeds``: each row under as many realisations as bring the 95 %
        intervals of its own work rates (without work, of its mean forces) within this share of
        them. Six of each row say how many that takes (Stein's procedure in two stages).
    most_seeds : int, optional
        The most that ``until_interval`` may take of a row; 200 unless given. A row that needs more
        has the status ``partial``.
    random : str, optional
        Of a case: draw the values of all keys at random between their bounds, ``"uniform"``,
        ``"lhs"`` (Latin hypercube) or ``"sobol"``. `SweepResult.shares` has the share of each key
        in the variance of each measure, where there are more than 1 + 3K rows for K keys.
    rows : int, optional
        With ``random``: the number of rows.
    seed : int, optional
        With ``random``: that of the values; ``"sobol"`` without one is the plain sequence.
    step, statistics_from, judge
        As in `run_many`; a case has its own step and window, and is judged.
    threads : int, optional
        Threads of this process: all cores; with an executor, threads of each of its tasks: one.
    executor : concurrent.futures.Executor, optional
        Where to run instead of here: a ``ProcessPoolExecutor``, that of a Dask client
        (``client.get_executor(pure=False)``), ``mpi4py.futures.MPIPoolExecutor`` and the like.
    chunk : int, optional
        Points per task; by default derived from the time that some of the points take here.
    folder : path, optional
        Finished rows are kept there; a sweep that is repeated takes them from there, and goes on
        after an interruption.
    progress : bool
        Whether a terminal shows the progress, after a second.

    Returns
    -------
    dict of str to numpy.ndarray of shape (points,), or SweepResult
        The columns of the points, then those of `run_many`; of a case, a `SweepResult`. A point
        whose scene is refused, or whose run fails, is a row with the reason in ``error``; a warning
        says how many.

    Raises
    ------
    ValueError
        For a wrong request.
    TypeError
        For points that are no mappings, or no sequence of them.
    Exception
        Whatever ``make`` raises besides ValueError.

    Warns
    -----
    ResultWarning
        Once, with their number, where runs have notes that limit the use of their results; of
        basins, where starts are undecided.
    RuntimeWarning
        Where rows failed, with their number and the first reason.

    Examples
    --------
    >>> import signorini as sg
    >>> def make(gap):
    ...     walls = sg.support("stop", gap, restitution=0.8)
    ...     return sg.oscillator(1.0, 0.2, 100.0, walls=walls, loads=[sg.Load.harmonic(3.0, 5.0)], duration=4.0)
    >>> table = sg.sweep(make, sg.grid(gap=[2e-3, 4e-3, 6e-3]), "event", statistics_from=2.0)
    >>> table["gap"], table["contacts_stop-upper"] > 0
    (array([0.002, 0.004, 0.006]), array([ True,  True,  True]))
    """
    if isinstance(make, Case):
        own = {"step": step, "statistics_from": statistics_from, "judge": judge, "executor": executor, "chunk": chunk}
        _refuse(own, "no such argument beside a case: its keys time.step and time.statistics_from say it")
        if not isinstance(points, Mapping):
            raise ValueError(f"points is {points!r}; expected a mapping of keys to values beside a case")
        if random is None:
            _refuse({"rows": rows, "seed": seed}, "random beside it, which draws the values of the keys")
        return sweep_case(
            make, points, scheme, measures=measures or (), periods=(settle, keep),
            asked=(seeds, until_interval, most_seeds), design="grid" if random is None else "random",
            drawn=None if random is None else (random, rows, seed), threads=threads, folder=folder, progress=progress,
        )  # fmt: skip
    of_case: dict[str, Any] = {"seeds": seeds, "until_interval": until_interval, "most_seeds": most_seeds, "random": random}
    of_case |= {"measures": measures, "settle": settle, "keep": keep, "rows": rows, "seed": seed}
    _refuse(of_case, "a case in place of a function beside it")
    if isinstance(points, Mapping):
        raise ValueError(f"points is {points!r}; expected {_POINTS}")
    statistics_from, judge = statistics_from or 0.0, judge is not False
    points = [_point(i, point) for i, point in enumerate(sequence("points", points, _POINTS))]
    names = list(points[0]) if points else []
    for i, point in enumerate(points):
        if list(point) != names:
            raise ValueError(f"point {i} has {', '.join(point)}; expected {', '.join(names)}, as the first point")
    options = _options(scheme, step, statistics_from, judge, threads if executor is None else threads or 1)
    walls = _first_walls(make, points)
    columns = _columns(walls)
    for name in names:
        if name in (*columns, "status", "error"):
            raise ValueError(f"points has the parameter {name!r}, a column of results; expected another name for it")
    width = len(columns)
    values, errors = np.full((len(points), width), np.nan), list[str | None]([None] * len(points))
    cautions: list[Caution] = []
    store = Store(folder, make, points, options, width)
    missing = store.missing(values, errors)

    def take(indices: Sequence[int], rows: _Rows) -> None:
        for row, index in enumerate(indices):
            values[index], errors[index] = rows[0][row], rows[1][row]
        cautions.extend(rows[2])
        store.add(indices, rows[:2])

    with Progress(len(points), progress, len(points) - len(missing)) as shown:
        if not missing:
            pass  # All rows are in the folder.
        elif executor is None:
            # In pieces, so that finished rows can be kept, and progress shown.
            size = len(missing) if folder is None else _size(make, points, missing, walls, options)
            for piece in _pieces(missing, size):
                take(piece, _task(make, [points[i] for i in piece], walls, options, shown.tell))
                shown.step(len(piece))
        else:
            size = chunk or _size(make, points, missing, walls, options)
            _send(executor, make, points, _pieces(missing, size), walls, options, take, shown)
    table: Table = {name: np.array([point[name] for point in points]) for name in names}
    table |= _table(walls, (values, errors, cautions), judge)
    warn_of_failures(errors)
    warn_of_runs(cautions)
    return table


def warn_of_failures(reasons: Sequence[str | None], what: str = "rows") -> None:
    """A warning of a study for those that have a reason why there is no result."""
    failed = [text for text in reasons if text is not None]
    if failed:
        text = f"{len(failed)} of {len(reasons)} {what} failed; the first: {failed[0]}"
        warnings.warn(text, RuntimeWarning, stacklevel=3)


def warn_of_runs(cautions: Sequence[Caution]) -> None:
    """A warning of a study for the notes of its runs, and one for those that have not settled."""
    for text in _cautioned(cautions):
        warnings.warn(text, ResultWarning, stacklevel=3)


_POINTS = "a mapping for each point beside a function: grid makes them, or to_dict('records') of a DataFrame"


def _point(number: int, point: Any) -> dict[str, Any]:
    try:
        if not isinstance(point, str):
            return dict(point)
    except (TypeError, ValueError):
        pass
    raise TypeError(f"points has {point!r} as point {number}; expected {_POINTS}")


def _refuse(arguments: Mapping[str, Any], expected: str) -> None:
    for name, value in arguments.items():
        if value is not None:
            raise ValueError(f"{name} is {value!r}; expected {expected}")


_Options = tuple[str | None, float | None, float, bool, int]


def _options(
    scheme: str | None, step: float | None, statistics_from: float, judge: bool, threads: int | None
) -> _Options:
    if threads is not None:
        whole("threads", threads, 1)
    check_given({"step": step, "statistics_from": statistics_from}, {})
    return scheme, step, statistics_from, judge, threads or os.cpu_count() or 1


def _table(walls: Sequence[str], rows: _Rows, judge: bool) -> Table:
    values, errors, _ = rows
    table: Table = {name: np.ascontiguousarray(values[:, i]) for i, name in enumerate(_columns(list(walls)))}
    good = "ok" if judge else "unjudged"
    table["status"] = np.array([good if text is None else "failed" for text in errors], object)
    table["error"] = np.array(errors, object)
    return table


def _first_walls(make: Callable[..., Scene], points: Sequence[Mapping[str, Any]]) -> list[str]:
    """The walls of the first point that has a scene. A defect of ``make`` raises before anything runs."""
    for point in points:
        try:
            scene = make(**point)
        except ValueError:
            continue
        if not isinstance(scene, Scene):
            raise TypeError(f"make returned {scene!r}; expected a Scene")
        return list(scene._wall_names)
    return []


def _task(
    make: Callable[..., Scene],
    points: Sequence[Mapping[str, Any]],
    walls: Sequence[str],
    options: _Options,
    tell: Callable[[int], None] | None = None,
) -> _Rows:
    """The rows of some points; executors run this function."""
    values = np.full((len(points), len(_columns(list(walls)))), np.nan)
    errors: list[str | None] = [None] * len(points)
    cautions: list[Caution] = [(None, None)] * len(points)
    scenes, rows = [], []
    for row, point in enumerate(points):
        try:
            scene = make(**point)
        except ValueError as error:
            errors[row] = str(error)
            continue
        names = list(scene._wall_names)
        if names == list(walls):
            scenes.append(scene)
            rows.append(row)
        else:
            errors[row] = f"walls are {', '.join(names)}; expected {', '.join(walls)}, as at the first point"
    if not scenes:
        return values, errors, cautions
    made, failed, found = _run_many(scenes, *options, tell)
    values[rows] = made
    for row, text, caution in zip(rows, failed, found, strict=True):
        errors[row], cautions[row] = text, caution
    return values, errors, cautions


def _pieces(indices: Sequence[int], size: int) -> list[Sequence[int]]:
    return [indices[i : i + size] for i in range(0, len(indices), max(1, size))]


def _size(
    make: Callable[..., Scene],
    points: Sequence[Mapping[str, Any]],
    missing: Sequence[int],
    walls: Sequence[str],
    options: _Options,
) -> int:
    """Points of a task, from the time that some of them, spread over the sweep, take here."""
    tried = missing[:: max(1, math.ceil(len(missing) / _TRIED))]
    started = time.perf_counter()
    _task(make, [points[i] for i in tried], walls, (*options[:4], 1))
    seconds = max((time.perf_counter() - started) / max(1, len(tried)), 1e-7)
    most = min(_SECONDS_PER_TASK / seconds, len(missing) / _TASKS)
    return max(1, math.ceil(max(most, _LEAST_SECONDS / seconds)))


def _of_dask(error: Exception) -> bool:
    """Whether Dask's executor itself has failed, as it does where a worker dies just after its result was fetched."""
    frames = traceback.extract_tb(error.__traceback__)
    return bool(frames) and frames[-1].filename.replace("\\", "/").endswith("/distributed/cfexecutor.py")


def _send(
    executor: Any,
    make: Callable[..., Scene],
    points: Sequence[Mapping[str, Any]],
    pieces: Sequence[Sequence[int]],
    walls: Sequence[str],
    options: _Options,
    take: Callable[[Sequence[int], _Rows], None],
    shown: Progress,
) -> None:
    """Gives each piece to the executor; pieces that fail there are run here."""
    futures = {executor.submit(_task, make, [points[i] for i in p], walls, options): p for p in pieces}
    lost = []
    try:
        for future in as_completed(futures):
            piece = futures[future]
            try:
                take(piece, future.result())
            except BrokenExecutor:
                lost.append(piece)
                continue
            except Exception as error:
                if not _of_dask(error):
                    raise
                take(piece, _task(make, [points[i] for i in piece], walls, options))
            shown.step(len(piece))
    except BaseException:
        for future in futures:
            future.cancel()
        raise
    if lost:
        text = f"a worker of the executor was lost: {len(lost)} of {len(pieces)} tasks are run here again"
        warnings.warn(text, RuntimeWarning, stacklevel=3)
    for piece in lost:
        take(piece, _task(make, [points[i] for i in piece], walls, options))
        shown.step(len(piece))
