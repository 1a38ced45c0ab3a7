"""Methods side by side on one scene."""

from __future__ import annotations

import warnings
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

from . import _core
from ._columns import Column, ReadOnly, columns, frame
from ._core import AccuracyWarning, Case, ResultWarning, Run, Scene
from ._progress import Progress
from ._realisations import Means, Realisations, by_place, made, of_case
from ._studies import columns_of
from ._sweep import Table, warn_of_failures, warn_of_runs
from ._types import check_given, names

if TYPE_CHECKING:
    import pandas as pd


@dataclass(frozen=True, eq=False)
class Differences:
    """What the means of a method differ by from those of another, over the same realisations.

    ``supports`` and ``walls`` map a name to the `PlaceMeans` there, of differences of the measures
    in their units; a difference within its half width is not distinguished from none.
    """

    supports: Means
    walls: Means


@dataclass(frozen=True, eq=False)
class MethodRealisations:
    """The methods of a comparison over the same ``count`` realisations of the random loads.

    ``studies`` maps the name of each method that has means to its `Realisations`, ``differences``
    that of each but the ``reference`` to its `Differences` from that: the exact method, or else the
    first. ``table`` has the columns of ``compare-realisations.csv``, a row for each method, place
    and measure; ``remarks`` say what the figures mean, and which methods have none. ``print`` shows
    the tables of the tool.
    """

    count: int
    reference: str
    studies: Mapping[str, Realisations]
    differences: Mapping[str, Differences]
    table: Mapping[str, Column]
    remarks: tuple[str, ...]
    _text: str

    def __repr__(self) -> str:
        return f"<MethodRealisations: {self.count} by {', '.join(self.studies)}>"

    def __str__(self) -> str:
        return "\n".join([self._text, *self.remarks])

    def to_pandas(self) -> pd.DataFrame:
        """The means and the differences as a pandas DataFrame.

        Returns
        -------
        pandas.DataFrame
            The columns of ``table``.

        Raises
        ------
        ImportError
            Without pandas.

        Examples
        --------
        >>> import signorini as sg
        >>> case = sg.load("tube-round-supports", set={"time.end": 0.1, "time.statistics_from": 0.0})
        >>> made = sg.compare(case, ["moreau-jean", "located"], seeds=2, verdict=False)
        >>> made.realisations.to_pandas()["less"].iloc[-1]
        'moreau-jean'
        """
        return frame(dict(self.table))


@dataclass(frozen=True)
class Comparison:
    """Methods side by side: see `compare`.

    Attributes
    ----------
    table : dict of str to numpy.ndarray
        One row per method: ``method``, ``error`` (share of the gap, up to the horizon),
        ``agrees_until_s``, ``restitution`` (median over the impacts), ``step_ns``, ``failure`` and
        ``refuted`` (words).
    runs : list of Run or None
        The runs, as the rows; None where one failed.
    findings : list of str
        Findings of the comparison, in sentences.
    horizon : float
        Time up to which errors are meaningful, s.
    realisations : MethodRealisations or None
        The methods over several realisations of the random loads, where ``seeds`` are asked for.
    """

    table: Table
    runs: list[Run | None]
    findings: list[str]
    horizon: float
    realisations: MethodRealisations | None = None

    def __repr__(self) -> str:
        lines = ["method                             error   agrees until (s)   ns a step"]
        for i, method in enumerate(self.table["method"]):
            error, until, cost = (self.table[name][i] for name in ("error", "agrees_until_s", "step_ns"))
            lines.append(f"{method:<32}{error:>8.1e}{until:>19.4g}{cost:>12.3g}")
        below = [] if self.realisations is None else [str(self.realisations)]
        return "\n".join(lines + self.findings + below)


def _differences(known: list[dict[str, Any]]) -> Differences:
    return Differences(*by_place(known, seeds=True))


def _of_methods(known: dict[str, Any]) -> MethodRealisations:
    """What the compiled half told of the methods over several realisations."""
    methods, reference = known["methods"], known["reference"]
    others = [one for one in methods if one["method"] != reference]
    return MethodRealisations(
        known["count"],
        reference,
        ReadOnly({one["method"]: made(one["study"]) for one in methods}),
        ReadOnly({one["method"]: _differences(one["differences"]) for one in others}),
        ReadOnly(columns(*known["table"])),
        tuple(known["remarks"]),
        known["text"],
    )


def compare(
    scene: Scene | Case,
    methods: Sequence[str],
    *,
    step: float | None = None,
    sample: float | None = None,
    statistics_from: float | None = None,
    seeds: int | None = None,
    verdict: bool = True,
    progress: bool = True,
) -> Comparison:
    """Run a scene by several methods, and compare them with its exact motion.

    With ``seeds`` every method also runs so many realisations of the random loads, the same for
    all: means with their 95 % intervals, and what they differ by from those of the exact method,
    from the differences between runs with the same seeds. The engine is that of ``signorini compare
    --seeds``, and the numbers are the same.

    Parameters
    ----------
    scene : Scene or Case
        What is run; the settings that the names of methods leave open are those of a case.
    methods : sequence of str
        Schemes, as in `Scene.run`.
    step, sample, statistics_from : float, optional
        s, as in `Scene.run`; those of a case unless given. Of a scene the step is required.
    seeds : int, optional
        How many realisations; of a case with random loads, turbulence or a start that scatters.
        Realisation k has the seeds of the case plus k - 1.
    verdict : bool
        With ``seeds``: whether up to six realisations by each method are run again with half the
        step, and with twice the modes where modes are left out, for the `Estimate.error` of its
        means.
    progress : bool
        Whether a terminal shows the progress of the realisations, after a second.

    Returns
    -------
    Comparison

    Raises
    ------
    ValueError
        For a wrong request, such as ``seeds`` of a case without random loads. What one method
        cannot do, such as a penalty without stiffness, is the ``failure`` of its row.
    TypeError
        For something else than a scene or a case; with ``seeds`` for a scene, which knows none.

    Warns
    -----
    ResultWarning
        Once, with their number, where runs have notes that limit the use of their results, such as
        those of a method that does not realise the walls' restitution. With ``seeds`` for each
        method of which the judge refutes a realisation, and for each of which one failed.
    AccuracyWarning
        For each check of means that failed, so that a part of their errors is not known.
    RuntimeWarning
        Where methods failed, with their number and the first reason.

    Examples
    --------
    >>> import signorini as sg
    >>> case = sg.load("rigid-walls-sine")
    >>> comparison = sg.compare(case, ["moreau-jean", "located"])
    >>> list(comparison.table["method"])
    ['moreau-jean', 'located', 'event']
    """
    methods = names("methods", methods, "moreau-jean")
    check_given({"step": step, "sample": sample, "statistics_from": statistics_from}, {"seeds": seeds})
    if seeds is not None:
        scene = of_case(scene, "compare with seeds")
    with Progress(0, progress) as shown:
        rows, findings, horizon, known = _core._compare(
            scene, methods, step, sample, statistics_from, seeds, verdict, shown.reach
        )
    runs = [row.pop("run") for row in rows]
    # One motion by several methods, whose window is asked for: that it has not settled is among the
    # notes of its runs.
    warn_of_failures([row["failure"] for row in rows], "methods")
    warn_of_runs([(row.pop("note"), None) for row in rows])
    if known is not None:
        for kind, texts in ((ResultWarning, known["warnings"]), (AccuracyWarning, known["unknown"])):
            for text in texts:
                warnings.warn(text, kind, stacklevel=2)
    of_methods = None if known is None else _of_methods(known)
    return Comparison(columns_of(rows, ("method", "failure", "refuted")), runs, findings, horizon, of_methods)
