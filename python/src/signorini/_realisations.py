"""Means over realisations of the random loads of a case."""

from __future__ import annotations

import os
import warnings
from collections.abc import Iterable, Mapping
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any, Literal

from . import _core
from ._columns import Column, ReadOnly, columns, frame
from ._core import AccuracyWarning, Case, RefutedError, ResultWarning
from ._progress import Progress
from ._supports import ErrorPart, ErrorParts, Estimate, PlaceMeans, Refinement, Wear
from ._types import check_given

if TYPE_CHECKING:
    import pandas as pd


Means = Mapping[str, PlaceMeans]


@dataclass(frozen=True, eq=False)
class Realisations:
    """Means over ``count`` realisations of the random loads.

    ``supports`` and ``walls`` map a name to the `PlaceMeans` there, an `Estimate` of each measure:
    ``study.supports["plate-1"].work_rate`` is a mean work rate, W. ``wear`` maps the name of each
    support for which the case has a law of wear to the `Wear` there in service, of the same
    estimates. ``depth_deepest`` is the largest of the means of all sectors, or flats, with what
    taking the largest adds in its half width. ``table`` has the columns
    of ``realisations.csv``: a row for each realisation and place. ``sectors`` has those of
    ``sector-means.csv``, where around each support the tube wears in the mean: ``place``, ``part``
    (``sector``, or ``flat``), ``from_deg``, ``to_deg``, ``depth_m`` within the service, by the law
    of wear of the case, ``work_rate_W``, and the same with ``half_width_95`` in the name; nan where
    there is no value. ``accuracy`` is what was reached
    where an accuracy was asked for, as in the summary of the tool: ``step_s``, ``reached``,
    ``quantity``, ``levels``. ``print`` shows the tables of the tool.
    """

    count: int
    supports: Means
    walls: Means
    wear: Mapping[str, Wear[Estimate]]
    table: Mapping[str, Column]
    sectors: Mapping[str, Column]
    accuracy: Mapping[str, Any] | None
    _rows: tuple[dict[str, Any], ...]
    _text: str

    def __repr__(self) -> str:
        return f"<Realisations: {self.count} at {', '.join([*self.supports, *self.walls])}>"

    def __str__(self) -> str:
        return self._text

    def to_pandas(self) -> pd.DataFrame:
        """The means as a pandas DataFrame, a row for each place and measure.

        Returns
        -------
        pandas.DataFrame
            With the columns of ``errors.csv`` and ``standard_deviation``.

        Raises
        ------
        ImportError
            Without pandas.

        Examples
        --------
        >>> import signorini as sg
        >>> case = sg.load("tube-round-supports", set={"time.end": 0.2, "time.statistics_from": 0.1})
        >>> sg.realisations(case, seeds=2, verdict=False).to_pandas()["unit"][0]
        'N'
        """
        return frame(list(self._rows))


_PARTS = ("start", "step", "modes")


def _part(known: dict[str, float]) -> ErrorPart:
    return ErrorPart(known["mean"], known["half_width_95"])


def _error(known: dict[str, Any]) -> ErrorParts:
    step, modes = (None if known[name] is None else _part(known[name]) for name in ("step", "modes"))
    return ErrorParts(_part(known["start"]), step, modes, known["sampling_half_width_95"], known["total"])


def _estimate(known: dict[str, Any], seeds: bool) -> Estimate:
    half = known["half_width_95"]
    kind: Literal["seeds", "batches"] | None = None if half is None else "seeds" if seeds else "batches"
    error = None if known.get("error") is None else _error(known["error"])
    refinements = tuple(map(_refinement, known.get("refinements", [])))
    return Estimate(known["mean"], half, kind, known.get("standard_deviation"), error, refinements)


def _refinement(known: dict[str, Any]) -> Refinement:
    modes = known["refined"].get("more_modes")
    refined = "half the step" if modes is None else f"{modes['modes'][1]} modes"
    return Refinement(refined, known["own"], known["then"])


def _row(known: dict[str, Any]) -> dict[str, Any]:
    """A mean as a row of a frame."""
    nan = float("nan")
    error = known["error"] or dict.fromkeys((*_PARTS, "total"))
    names = ("place", "kind", "measure", "unit", "mean", "standard_deviation", "half_width_95")
    row = {name: nan if known[name] is None else known[name] for name in names}
    row["error"] = nan if error["total"] is None else error["total"]
    for name in _PARTS:
        part = error[name] or {"mean": nan, "half_width_95": nan}
        row |= {name: part["mean"], f"{name}_half_width_95": part["half_width_95"]}
    return row


def by_place(estimates: Iterable[dict[str, Any]], seeds: bool) -> tuple[Means, Means]:
    """The estimates at supports, and those at walls."""
    places: dict[str, dict[str, dict[str, Estimate]]] = {"support": {}, "wall": {}}
    for one in estimates:
        places[one["kind"]].setdefault(one["place"], {})[one["measure"]] = _estimate(one, seeds)
    supports, walls = (ReadOnly({name: PlaceMeans(own) for name, own in of.items()}) for of in places.values())
    return supports, walls


def _wear(supports: Means) -> Mapping[str, Wear[Estimate]]:
    """The wear at each support that has any."""
    names = ("worn_volume", "support_worn_volume", "depth_deepest", "depth_one_scar", "depth_all_round")
    worn = {place: Wear(place, *map(means.get, names)) for place, means in supports.items()}
    return ReadOnly({place: one for place, one in worn.items() if not (one.volume is one.support_volume is None)})


def made(known: dict[str, Any]) -> Realisations:
    """The study that the compiled half told."""
    document = known["document"]
    estimates = [*document["estimates"], *known["worn"]]
    supports, walls = by_place(estimates, seeds=document["count"] > 1)
    rows = tuple(map(_row, estimates))
    table, sectors = (ReadOnly(columns(*known[name])) for name in ("table", "sectors"))
    accuracy = known.get("accuracy")
    accuracy = None if accuracy is None else ReadOnly(accuracy)
    return Realisations(
        document["count"], supports, walls, _wear(supports), table, sectors, accuracy, rows, known["text"]
    )


def warn(known: dict[str, Any], stacklevel: int) -> None:
    """Warn of what limits the use of a study."""
    for note in known["notes"]:
        warnings.warn(note, ResultWarning, stacklevel=stacklevel + 1)
    for text in (*known["unknown"], *([known["shortfall"]] if known["shortfall"] else [])):
        warnings.warn(text, AccuracyWarning, stacklevel=stacklevel + 1)


def refuted(reasons: list[str], study: object) -> RefutedError:
    """The error of a study whose runs the judge refutes; it holds the study."""
    error = RefutedError(f"refuted by the judge, not to be used: {'; '.join(reasons)}")
    error.study = study
    return error


def of_case(case: object, name: str) -> Case:
    """``case``, unless it is something else."""
    if not isinstance(case, Case):
        raise TypeError(f"{case!r} in {name}; expected a Case, as of sg.tube, sg.case or sg.load: it knows its seeds")
    return case


def realisations(
    case: Case,
    scheme: str | None = None,
    *,
    seeds: int | None = None,
    until_interval: float | None = None,
    accuracy: float | None = None,
    most_seeds: int | None = None,
    most_time: float | None = None,
    step: float | None = None,
    verdict: bool = True,
    folder: str | os.PathLike[str] | None = None,
    progress: bool = True,
) -> Realisations:
    """Run a case under several realisations of its random loads, on all cores.

    Realisation k has the seeds of the case plus k - 1. The engine is that of ``signorini run
    --seeds``, and the numbers are the same.

    Parameters
    ----------
    case : Case
        With a random load, turbulence or a start that scatters (``initial.scatter``). With
        ``accuracy`` any other too: the velocities of its start scatter for it, as velocities at a
        wall by 1e-4 of the gap in a forcing period at most, ``accuracy["start_scatter"]`` says by
        how much. So a chaotic motion, which no step predicts, has means with an error.
    scheme, step : optional
        As in `Case.run`.
    seeds : int, optional
        How many realisations.
    until_interval : float, optional
        In place of ``seeds``: as many as bring the 95 % intervals of the work rates of supports
        (without supports, of the mean forces) within this share of them. Six realisations say how
        many that takes (Stein's procedure in two stages).
    accuracy : float, optional
        In place of ``seeds`` and ``step``: the coarsest step whose part in the errors of work
        rates, mean forces and RMS forces is within this share of them, and as many realisations as
        its interval and those of the means take. The engine is that of ``signorini run --accuracy
        --of means``.
    most_seeds : int, optional
        The most that ``until_interval`` or ``accuracy`` may take; 200 unless given.
    most_time : float, optional
        Seconds that ``until_interval`` may take: no more realisations, with the checks for their
        errors, than fit into them by the duration of the first six.
    verdict : bool
        Whether up to six realisations are run again with half the step, and with twice the modes
        where modes are left out, for the `Estimate.error` of each mean.
    folder : path, optional
        The files of ``signorini run`` with ``--seeds`` are written there, with its page,
        ``report.html``. A folder with results of another request is refused.
    progress : bool
        Whether a terminal shows the progress, after a second.

    Returns
    -------
    Realisations

    Raises
    ------
    ValueError
        For a wrong request, such as a case without random loads.
    TypeError
        For something else than a case.
    OSError
        For a ``folder`` that cannot be written, and one with other results.
    RunError
        For a realisation that failed; `RefutedError` where the judge refutes one, whose ``study``
        holds the study; its files are written all the same.

    Warns
    -----
    AccuracyWarning
        Where ``until_interval`` was not reached with ``most_seeds`` or in ``most_time``, or ``accuracy`` with them or
        with any step, and where a check for the errors failed, so that a part of them is not known.
    ResultWarning
        For each note that concerns the results, as in `Scene.run`.

    Examples
    --------
    >>> import signorini as sg
    >>> case = sg.load("tube-round-supports", set={"time.end": 0.2, "time.statistics_from": 0.1})
    >>> study = sg.realisations(case, seeds=3)
    >>> rate = study.supports["plate-1"].work_rate
    >>> rate.kind, rate.error.total > rate.half_width
    ('seeds', True)
    """
    case, asked = of_case(case, "realisations"), (seeds, until_interval, most_seeds)
    numbers = {"until_interval": until_interval, "accuracy": accuracy, "most_time": most_time, "step": step}
    check_given(numbers, {"seeds": seeds, "most_seeds": most_seeds})
    with Progress(0, progress) as shown:
        known = _core._realisations(case, scheme, step, asked, most_time, accuracy, verdict, folder, shown.reach)
    study = made(known)
    if known["refuted"]:
        raise refuted(known["refuted"], study)
    warn(known, 2)
    return study
