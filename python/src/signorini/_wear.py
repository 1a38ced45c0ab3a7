"""Wear over the years at the supports of a case."""

from __future__ import annotations

import os
import warnings
from collections.abc import Mapping
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

from . import _core
from ._columns import Column, ReadOnly, Variables, columns, dataset, frame
from ._core import Case, ResultWarning
from ._progress import Progress
from ._realisations import Realisations, made, of_case, refuted, warn
from ._types import check_given, whole

if TYPE_CHECKING:
    import pandas as pd
    import xarray as xr


@dataclass(frozen=True)
class LimitYears:
    """The years after which the mean depth at a support reaches the limit of the tube.

    ``deepest`` where it is deepest, ``one_scar`` if all of the wear comes off one scar,
    ``all_round`` if it comes off evenly all round; None where that is not within the years followed, or without limit.
    The ``histories`` of each are those of the single histories, by which the year scatters; none
    without limit; each has its own deepest sector, earlier than the mean. The ``half_width`` of
    each is that of its 95 % interval: of the histories, where each reaches the limit (of the
    deepest that of the depth over its rate), or of a single one by the half widths of the work
    rates of its windows. Where the limit is reached after the years followed only, ``at_last_rate``
    of each is the year at the last rates, None else.
    """

    deepest: float | None
    one_scar: float | None
    all_round: float | None
    deepest_histories: tuple[float | None, ...] = ()
    one_scar_histories: tuple[float | None, ...] = ()
    all_round_histories: tuple[float | None, ...] = ()
    deepest_half_width: float | None = None
    one_scar_half_width: float | None = None
    all_round_half_width: float | None = None
    deepest_at_last_rate: float | None = None
    one_scar_at_last_rate: float | None = None
    all_round_at_last_rate: float | None = None


@dataclass(frozen=True, eq=False)
class WearStudy:
    """Histories of the wear at ``supports``, whose gaps grow by it.

    ``years`` has the columns of ``years.csv``: means over the histories with the half widths of
    their 95 % intervals (``gap_m``, of flats the least; ``depth_deepest_m``,
    ``depth_all_round_m``, ``depth_one_scar_m``, ``work_rate_W`` and the same with
    ``half_width_95`` in the name), a row for each ``year`` and ``place``: at the windows, and between two
    where a depth does not grow straight. ``history`` has those of
    ``history.csv``, a row for each history as well, ``sectors`` those of ``sector-means.csv``: the
    depth at the end in each sector of a hole, and at each flat (``place``, ``part``, ``from_deg``,
    ``to_deg``, ``depth_m``, ``depth_half_width_95_m``). ``limit`` is the depth up to which the tube may wear, m, or None, and
    ``limit_years`` says when each support reaches it. ``histories`` is their number and
    ``windows`` how many runs they took. ``first`` is the study of the first windows, with its
    errors, where the number of histories follows from an interval. ``remarks`` say what the
    figures mean; ``print`` shows the table of the tool with them.
    """

    supports: tuple[str, ...]
    histories: int
    windows: int
    years: Mapping[str, Column]
    history: Mapping[str, Column]
    sectors: Mapping[str, Column]
    limit: float | None
    limit_years: Mapping[str, LimitYears]
    first: Realisations | None
    remarks: tuple[str, ...]
    _text: str

    def __repr__(self) -> str:
        end = float(self.years["year"][-1])
        return f"<WearStudy: {self.histories} histories over {end:.4g} years at {', '.join(self.supports)}>"

    def __str__(self) -> str:
        return "\n".join([self._text, *self.remarks])

    def to_pandas(self) -> pd.DataFrame:
        """The means over the years as a pandas DataFrame.

        Returns
        -------
        pandas.DataFrame
            The columns of ``years``.

        Raises
        ------
        ImportError
            Without pandas.

        Examples
        --------
        >>> import signorini as sg
        >>> short = {"time.end": 0.2, "time.statistics_from": 0.1, "system.modes": 6}
        >>> sg.wear(sg.load("tube-in-cross-flow", set=short), years=5, histories=2).to_pandas()["place"][0]
        'plate-1'
        """
        return frame(dict(self.years))

    def to_xarray(self) -> xr.Dataset:
        """The means over the years and the histories as an xarray Dataset.

        The columns of ``years`` are variables with the dimensions ``year`` and ``support``. Those
        of ``history`` have ``history_`` before their name, and the dimension ``history`` between.

        Returns
        -------
        xarray.Dataset

        Raises
        ------
        ImportError
            Without xarray.

        Examples
        --------
        >>> import signorini as sg
        >>> short = {"time.end": 0.2, "time.statistics_from": 0.1, "system.modes": 6}
        >>> study = sg.wear(sg.load("tube-in-cross-flow", set=short), years=5, histories=2)
        >>> study.to_xarray()["history_gap_m"].dims
        ('year', 'history', 'support')
        """
        # Rows are in the order of years, histories and supports, the supports fastest.
        years = self.years["year"][:: len(self.supports)]
        shape = {"year": len(years), "support": len(self.supports)}
        of_histories = {"year": len(years), "history": self.histories, "support": len(self.supports)}
        variables: Variables = {}
        for before, table, sizes in (("", self.years, shape), ("history_", self.history, of_histories)):
            for name in (name for name in table if name not in ("history", "year", "place")):
                variables[before + name] = tuple(sizes), table[name].reshape(tuple(sizes.values()))
        numbers = range(1, self.histories + 1)
        return dataset({"year": years, "history": numbers, "support": list(self.supports)}, variables)

    def plot(self, quantity: str = "depth_deepest", ax: Any = None) -> Any:
        """Draw a quantity over the years with matplotlib, a curve with its 95 % band per support.

        Parameters
        ----------
        quantity : str
            ``"depth_deepest"``, ``"depth_all_round"``, ``"depth_one_scar"``, ``"gap"`` or
            ``"work_rate"``.
        ax : matplotlib axes, optional
            Made if left out.

        Returns
        -------
        matplotlib axes

        Raises
        ------
        ImportError
            Without matplotlib.
        ValueError
            For another quantity.

        Examples
        --------
        >>> import signorini as sg
        >>> short = {"time.end": 0.2, "time.statistics_from": 0.1, "system.modes": 6}
        >>> study = sg.wear(sg.load("tube-in-cross-flow", set=short), years=5, histories=2)
        >>> study.plot("gap").get_ylabel()
        'gap (mm)'
        """
        from . import _plot

        return _plot.wear(self, quantity, ax)


def _limit_years(known: dict[str, Any]) -> LimitYears:
    names = [f"limit_{name}" for name in ("deepest", "one_scar", "all_round")]
    years = [known[f"{name}_years"] for name in names]
    histories = [tuple(known[f"{name}_years_of_histories"]) for name in names]
    half_widths = [known[f"{name}_half_width_95_years"] for name in names]
    later = [known[f"{name}_years_at_last_rate"] for name in names]
    return LimitYears(*years, *histories, *half_widths, *later)


def wear(
    case: Case,
    scheme: str | None = None,
    *,
    years: float | None = None,
    histories: int | None = None,
    until_interval: float | None = None,
    most_seeds: int | None = None,
    most_time: float | None = None,
    step: float | None = None,
    verdict: bool = True,
    folder: str | os.PathLike[str] | None = None,
    progress: bool = True,
) -> WearStudy:
    """Follow the wear at loose supports over the years, whose gaps grow by the wear they cause.

    The work rate is that of a run with the gap of that time; under random loads several histories
    are followed, each run with seeds of its own. The engine is that of ``signorini wear``, and the
    numbers are the same.

    Parameters
    ----------
    case : Case
        With supports that have a width, and wear coefficients: see `tube` and `Archard`.
    scheme, step : optional
        As in `Case.run`.
    years : float, optional
        In service, of 365.25 days; those of the case unless given.
    histories : int, optional
        Under random loads; 6 unless given.
    until_interval : float, optional
        In place of ``histories``: as many as bring the 95 % intervals of the work rates in the
        first gaps within this share of them, as in `realisations`, whose study is ``first``.
    most_seeds : int, optional
        The most histories that ``until_interval`` may take; 200 unless given.
    most_time : float, optional
        Seconds that ``until_interval`` may take, as in `realisations`, with about seven runs for
        each history.
    verdict : bool
        With ``until_interval``: whether the errors of the work rates in the first gaps are found.
        Else, with ``folder``: whether the page tells what half the step and more modes change in
        those of the first window.
    folder : path, optional
        The files of ``signorini wear`` are kept there, with its page ``report.html`` and the first
        window of the first history in ``first-window``. The same call goes on after an
        interruption, and one with more ``years`` from those that are there, with the results of so
        many years at once. The tool and Python go on from each other.
    progress : bool
        Whether a terminal shows the progress, after a second.

    Returns
    -------
    WearStudy

    Raises
    ------
    ValueError
        For a wrong request, such as a case in which nothing wears.
    TypeError
        For something else than a case.
    OSError
        For a ``folder`` that cannot be written, and one with other results, such as those of more
        years.
    RunError
        For a run that failed; `RefutedError` where the judge refutes one, whose ``study`` holds
        the study.

    Warns
    -----
    AccuracyWarning
        As `realisations`.
    ResultWarning
        For each note that limits the use of the results, such as a step that does not resolve a
        load; with ``until_interval`` those on the first run.

    Examples
    --------
    >>> import signorini as sg
    >>> short = {"time.end": 0.2, "time.statistics_from": 0.1, "system.modes": 6}
    >>> study = sg.wear(sg.load("tube-in-cross-flow", set=short), years=5, histories=2)
    >>> study
    <WearStudy: 2 histories over 5 years at plate-1, plate-2>
    >>> float(study.years["gap_m"][0])
    0.0002
    """
    case, within = of_case(case, "wear"), (until_interval, most_seeds, most_time)
    numbers = {"years": years, "until_interval": until_interval, "most_time": most_time, "step": step}
    check_given(numbers, {"most_seeds": most_seeds})
    if histories is not None:
        whole("histories", histories, 1)
    with Progress(0, progress) as runs, Progress(100, progress, of="per cent of the years") as shown:
        known = _core._wear(case, scheme, step, years, histories, within, verdict, folder, runs.reach, shown.tell)
    first = None if known["first"] is None else made(known["first"])
    study = WearStudy(
        tuple(known["supports"]),
        known["histories"],
        known["windows"],
        ReadOnly(columns(*known["years"])),
        ReadOnly(columns(*known["history"])),
        ReadOnly(columns(*known["sectors"])),
        known["limit"],
        ReadOnly({one["place"]: _limit_years(one) for one in known["limits"]}),
        first,
        tuple(known["remarks"]),
        known["text"],
    )
    if known["refuted"]:
        raise refuted(known["refuted"], study)
    if first is not None:
        warn(known["first"], 2)
    else:
        for note in known["notes"]:
            warnings.warn(note, ResultWarning, stacklevel=2)
    return study
