"""Conversions of a run: called by the compiled class."""

from __future__ import annotations

from html import escape
from typing import TYPE_CHECKING, Any

import numpy as np
import numpy.typing as npt

from ._supports import supports, wear

if TYPE_CHECKING:
    import pandas as pd

    from collections.abc import Sequence

    from ._core import Run
    from ._types import Array

__all__ = ["columns", "contacts", "html", "output", "statistics", "summary", "supports", "to_pandas", "wear"]


def contacts(run: Run) -> npt.NDArray[np.void]:
    """The contact episodes, as `Run.contacts` says."""
    columns = run._contacts()
    names = np.array(list(columns.pop("names")) or [""])
    columns["wall"] = names[columns["wall"]]
    table = np.empty(len(columns["wall"]), [(name, column.dtype) for name, column in columns.items()])
    for name, column in columns.items():
        table[name] = column
    table.flags.writeable = False
    return table


def _words(names: list[str]) -> list[str]:
    """Names as the headers of CSV files have them: ``-`` becomes ``_``, equal ones get numbers."""
    words: list[str] = []
    for name in names:
        word = name.replace("-", "_")
        number, base = 2, word
        while word in words:
            word, number = f"{base}_{number}", number + 1
        words.append(word)
    return words


def _states(run: Run, time: Array, states: Sequence[tuple[Array, Array]]) -> dict[str, Array]:
    """The columns of the time and of the states of all probes."""
    out = {"time_s": time}
    for word, state in zip(_words(run.probes), states, strict=True):
        suffix = f"_{word}" if word else ""
        out[f"displacement{suffix}_m"], out[f"velocity{suffix}_m_per_s"] = state
    return out


def output(run: Run) -> dict[str, Array]:
    """The states at the output times, as `Run.output` says."""
    time, states = run._output()
    return _states(run, time, states) if len(time) else {}


def columns(run: Run) -> dict[str, npt.NDArray[np.float64]]:
    """All rows, as `Run.columns` says."""
    out = _states(run, run.time, [run.probe(name) for name in run.probes])
    for name, word in zip(run.walls, _words(run.walls), strict=True):
        out[f"contact_force_{word}_N"] = run.contact_force(name)
        out[f"contact_impulse_{word}_N_s"] = run.contact_impulse(name)
    for name, word in zip(run.holes, _words(run.holes), strict=True):
        parts = zip("yz", run.hole_force(name), run.hole_impulse(name), strict=True)
        for plane, force, impulse in parts:
            out[f"contact_force_{word}_{plane}_N"] = force
            out[f"contact_impulse_{word}_{plane}_N_s"] = impulse
    supports = list(run.supports)
    for name, word in zip(supports, _words(supports), strict=True):
        out[f"wear_work_{word}_J"] = run.wear_work(name)
    return out


def summary(run: Run) -> dict[str, Any]:
    """Everything but the motion, as `Run.summary` says."""
    return run._summary()


def statistics(run: Run) -> dict[str, dict[str, Any]]:
    """The statistics of each wall, as `Run.statistics` says."""
    return {wall["wall"]: wall for wall in run._summary()["statistics"]["walls"]}


def to_pandas(run: Run) -> pd.DataFrame:
    """The rows as a frame."""
    import pandas as pd

    return pd.DataFrame(columns(run))


def html(run: Run) -> str:
    """A table of the walls, for notebooks."""
    head = ("wall", "contacts", "impulse (N s)", "largest impulse (N s)", "largest force (N)", "impact power (W)")

    def number(x: float | None) -> str:
        return "–" if x is None else f"{x:.4g}"

    lines = []
    for name, wall in statistics(run).items():
        cells = [escape(name), str(wall["contacts"]), number(run.impulse(name))]
        largest = wall["force_largest"]
        cells += [number(wall["episode_impulse_n_s"]["max"]), number(largest and largest["mean_n"])]
        cells.append(number(wall["impact_power_w"]))
        lines.append("<tr>" + "".join(f"<td>{cell}</td>" for cell in cells) + "</tr>")
    notes = "".join(f"<li>{escape(note)}</li>" for note in run.notes)
    header = "".join(f"<th>{title}</th>" for title in head)
    return f"<p>{escape(repr(run))}</p><table><tr>{header}</tr>{''.join(lines)}</table><ul>{notes}</ul>"
