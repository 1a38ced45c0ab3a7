"""Pictures with matplotlib, which is imported only here, in the look of the tool's figures."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np

from ._core import _unit
from ._types import Array, sequence

if TYPE_CHECKING:
    from ._bifurcation import Bifurcation
    from ._branches import Branches
    from ._core import Run
    from ._orbit import Orbit
    from ._studies import Chart, Stability
    from ._wear import WearStudy

# Neighbours differ in lightness as well as in hue (after Okabe and Ito), and in dashes and markers.
COLOURS = ("#000000", "#0072b2", "#d55e00", "#56b4e9", "#7b3294", "#e69f00", "#00614a", "#8a8a8a")
DASHES = ("-", (0, (7, 2.5)), (0, (2, 2)), (0, (7, 2, 1.5, 2)), (0, (12, 3)), (0, (4, 1.5)))
MARKERS = "os^DxvP*<>"
TONES = {
    "stable": "#f7f7f7",
    "dissipative": "#b5cfe6",
    "frozen": "#dc9a33",
    "another-motion": "#c0452a",
    "energy-gaining": "#4b2357",
    "diverged": "#111111",
}

# 160 mm, the width of a figure in a paper.
_WIDTH = 6.3


def _frame(ax: Any, x: str | None, y: str) -> None:
    ax.grid(color="#e6e6e6", linewidth=0.6)
    ax.set_axisbelow(True)
    ax.set_ylabel(y)
    if x is not None:
        ax.set_xlabel(x)


def _new(rows: int, height: float) -> Any:
    import matplotlib.pyplot as plt

    _, axes = plt.subplots(rows, 1, sharex=True, layout="constrained", figsize=(_WIDTH, height))
    return axes


def _legend(ax: Any, beside: int = 0) -> None:
    """A legend above the axes, where no curve is, in as many columns as fit beside one another, and
    beside names of ``beside`` letters on the vertical axis."""
    longest = max(len(name) for name in ax.get_legend_handles_labels()[1])
    # Inches of a handle with its margins, and of a letter.
    columns = int((_WIDTH - 1.0 - 0.085 * beside) / (0.5 + 0.085 * longest))
    ax.legend(
        loc="lower left", bbox_to_anchor=(0.0, 0.97), ncols=min(max(columns, 1), 4), fontsize="small", frameon=False
    )


# Units as column names and the case format write them, the longest first.
_UNITS = (
    *("N_m_per_rad", "N_s_per_m", "N2_per_Hz", "m3_per_N", "kg_per_m3", "m_per_s", "N_per_m", "kg_per_m", "per_s"),
    *("cycles", "N_s", "deg", "rad", "Hz", "Pa", "kg", "m3", "m2", "m", "s", "N", "W", "J"),
)


def unit(word: str) -> str:
    """A unit as it is read: ``N_s_per_m`` is N s/m."""
    over, _, under = word.replace("3", "³").replace("2", "²").partition("per_")
    over, under = over.rstrip("_").replace("_", " "), under.replace("_", " ")
    return f"{over or '1'}/{under}" if under else over


def label(column: str) -> str:
    """The name of a column with its unit in brackets: ``time_s`` is time (s)."""
    for word in _UNITS:
        name = column.removesuffix(f"_{word}")
        if name != column:
            return f"{name.replace('_', ' ')} ({unit(word)})"
    return column.replace("_", " ")


def run(made: Run, axes: Any = None) -> Any:
    """Displacement between its walls, velocity, and contact forces or impulses: see `Run.plot`."""
    axes = _new(3, 5.6) if axes is None else axes
    expected = "three matplotlib axes, such as plt.subplots(3, 1)[1]"
    own = sequence("axes", axes, expected)
    if len(own) != 3:
        raise ValueError(f"axes has {len(own)}; expected {expected}")
    if not all(hasattr(one, "plot") for one in own):
        raise TypeError(f"axes is {axes!r}; expected {expected}")
    position, speed, wall_axes = own
    for name, dash in zip(made.probes, DASHES * (1 + len(made.probes) // len(DASHES))):
        q, v = made.probe(name)
        style: dict[str, Any] = {"color": COLOURS[0], "linewidth": 1.2, "linestyle": dash, "label": name}
        position.plot(made.time, 1e3 * q, **style)
        speed.plot(made.time, v, **style)
    # On a structure a wall bounds the displacement of its own place, which need not be a probe's.
    if made.scene.degrees_of_freedom == 1:
        for wall in made.scene.walls:
            position.axhline(1e3 * wall.position, color="#8a8a8a", linewidth=1.5)
    _frame(position, None, "displacement (mm)")
    _frame(speed, None, "velocity (m/s)")
    episodes = made.contacts
    # The force of an impact is not finite: impulses are drawn where all contacts are impacts.
    lasting = bool(np.isfinite(episodes["peak_force"]).any())
    places = made.walls + made.holes
    for number, place in enumerate(places):
        colour = COLOURS[1 + number % (len(COLOURS) - 1)]
        if lasting:
            # A round support pushes towards its centre, from any side: its force has a size.
            force = np.hypot(*made.hole_force(place)) if number >= len(made.walls) else made.contact_force(place)
            dash = DASHES[number // (len(COLOURS) - 1) % len(DASHES)]
            wall_axes.plot(made.time, force, color=colour, linewidth=1.0, linestyle=dash, label=place)
        else:
            own = episodes[episodes["wall"] == place]
            wall_axes.vlines(own["start"], 0.0, own["impulse"], color=colour, linewidth=1.0)
            marker = MARKERS[number % len(MARKERS)]
            wall_axes.plot(own["start"], own["impulse"], marker, color=colour, markersize=3, label=place)
    _frame(wall_axes, "time (s)", "contact force (N)" if lasting else "contact impulse (N s)")
    if not places:
        wall_axes.text(0.5, 0.5, "no walls or supports", transform=wall_axes.transAxes, ha="center", va="center")
        wall_axes.set_yticks([])
    if 1 < len(made.probes) <= 8:
        _legend(position)
    if 0 < len(places) <= 8:
        _legend(wall_axes)
    return axes


def chart(made: Chart, quantity: str, ax: Any = None) -> Any:
    """Computing time against error: see `Chart.plot`."""
    ax = _new(1, 4.4) if ax is None else ax
    errors, seconds = made.errors(quantity), made.table["seconds"]
    for number, method in enumerate(dict.fromkeys(made.table["method"])):
        own = (made.table["method"] == method) & np.isfinite(errors) & (errors > 0.0)
        if own.any():
            colour, marker = COLOURS[number % len(COLOURS)], MARKERS[number % len(MARKERS)]
            ax.loglog(errors[own], seconds[own], marker=marker, color=colour, linewidth=1.0, markersize=4, label=method)
    _frame(ax, f"error of the {quantity.replace('_', ' ')}", "computing time (s)")
    ax.legend(loc="best", fontsize="x-small")
    return ax


def _log_steps(ax: Any, steps: Array) -> None:
    """A logarithmic axis of steps, with numbers at 1, 2 and 5 of each decade where there are few."""
    from matplotlib.ticker import LogLocator, NullFormatter

    ax.set_xscale("log")
    few = steps.max() < 100.0 * steps.min()
    ax.xaxis.set_major_locator(LogLocator(subs=(1.0, 2.0, 5.0) if few else (1.0,)))
    ax.xaxis.set_minor_formatter(NullFormatter())


def stability(made: Stability, ax: Any = None) -> Any:
    """The class of every step, one line per scheme: see `Stability.plot`."""
    schemes = list(dict.fromkeys(made.stable["scheme"]))
    ax = _new(1, 1.2 + 0.35 * len(schemes)) if ax is None else ax
    values = dict(zip(made.stable["scheme"], made.stable["value"], strict=True))
    table = made.table
    for name, tone in TONES.items():
        own = [
            cell == name and value == values.get(scheme)
            for cell, scheme, value in zip(table["class"], table["scheme"], table["value"], strict=True)
        ]
        rows = [schemes.index(scheme) for scheme in table["scheme"][own]]
        ax.scatter(table["step_s"][own], rows, marker="s", s=60, color=tone, edgecolor="k", linewidth=0.4, label=name)
    _log_steps(ax, table["step_s"])
    ax.set_yticks(range(len(schemes)), schemes)
    ax.invert_yaxis()
    _frame(ax, "step (s)", "")
    _legend(ax, beside=max(map(len, schemes)))
    return ax


def orbit(made: Orbit, ax: Any = None) -> Any:
    """Velocity over displacement: see `Orbit.plot`."""
    ax = _new(1, 4.0) if ax is None else ax
    order = np.argsort(made.time, kind="stable")
    q, v = 1e3 * made.displacement[order], made.velocity[order]
    ax.plot(np.append(q, q[0]), np.append(v, v[0]), color=COLOURS[1], linewidth=1.2)
    _frame(ax, "displacement (mm)", "velocity (m/s)")
    return ax


#: Signs of special points, as the tool draws them.
_SIGNS = {
    "fold": "^", "period-doubling": "D", "symmetry-breaking": "o", "grazing-in": "x", "grazing-out": "+",
    "neimark-sacker": "h",
}  # fmt: skip


def branches(made: Branches, ax: Any = None) -> Any:
    """Approach speeds over the key: see `Branches.plot`."""
    ax = _new(1, 4.4) if ax is None else ax
    key = made[made.column]
    for number, events in enumerate(made.events, 1):
        own = np.flatnonzero(made["branch"] == number)
        met = [i for i, (kind, _) in enumerate(events, 1) if kind in made._arrivals]
        speeds = [made[f"speed_{i}_m_per_s"][own] for i in met] if events else [np.zeros(len(own))]
        # Stretches of one kind, each up to the first point of the next one.
        kinds = np.where(made["admissible"][own], np.where(made["stable"][own], 0, 1), 2)
        for stretch in np.split(np.arange(len(own)), np.flatnonzero(np.diff(kinds)) + 1):
            drawn = np.append(stretch, stretch[-1] + 1) if stretch[-1] + 1 < len(own) else stretch
            line = ("-", "--", ":")[kinds[stretch[0]]]
            for speed in speeds:
                ax.plot(key[own][drawn], speed[drawn], color=COLOURS[1], linewidth=1.2, linestyle=line)
    for label in dict.fromkeys(made.special["label"]):
        own = np.flatnonzero(made.special["label"] == label)
        grazes = label in ("grazing-in", "grazing-out")
        # A graze is on the axis; of other points the fastest arrival is marked.
        top = [0.0 if grazes else _fastest(made, int(row)) for row in own]
        ax.plot(made.special[made.column][own], top, _SIGNS.get(label, "s"), color=COLOURS[2], markersize=5, label=label)
    found = _unit(made.key)
    _frame(ax, made.key if found is None else f"{made.key} ({unit(found)})", "approach speed (m/s)")
    if len(made.special["label"]):
        _legend(ax)
    return ax


def _fastest(made: Branches, row: int) -> float:
    """The fastest arrival of the orbit at a special point."""
    events = made.events[int(made.special["branch"][row]) - 1]
    met = [i for i, (kind, _) in enumerate(events, 1) if kind in made._arrivals]
    return max((float(made.special[f"speed_{i}_m_per_s"][row]) for i in met), default=0.0)


def bifurcation(made: Bifurcation, column: str, ax: Any = None) -> Any:
    """Every sample over the value: see `Bifurcation.plot`."""
    ax = _new(1, 4.0) if ax is None else ax
    for number, direction in enumerate(dict.fromkeys(made.table["direction"])):
        own = made.table["direction"] == direction
        # Smaller ones on larger ones, so that both show where they agree.
        marker: dict[str, Any] = {"color": COLOURS[number % len(COLOURS)], "linestyle": "none", "marker": "o"}
        marker |= {"markersize": 3.0 - 1.6 * number, "markeredgewidth": 0}
        ax.plot(made.table["value"][own], made.table[column][own], label=direction or None, **marker)
    found = _unit(made.key)
    _frame(ax, made.key if found is None else f"{made.key} ({unit(found)})", label(column))
    if any(made.table["direction"]):
        ax.legend(loc="best", fontsize="small", markerscale=4)
    return ax


def wear(made: WearStudy, quantity: str, ax: Any = None) -> Any:
    """A quantity over the years, with its band: see `WearStudy.plot`."""
    columns = {name.rpartition("_")[0]: name for name in made.years if name not in ("year", "place")}
    known = [name for name in columns if "half_width" not in name]
    if quantity not in known:
        raise ValueError(f"quantity is {quantity!r}; expected {', '.join(known)}")
    ax = _new(1, 4.0) if ax is None else ax
    column = columns[quantity]
    metres = column.endswith("_m")
    scale = 1e3 if metres else 1.0
    for number, place in enumerate(made.supports):
        own = made.years["place"] == place
        year, mean = made.years["year"][own], scale * made.years[column][own]
        half = scale * made.years[columns[f"{quantity}_half_width_95"]][own]
        colour = COLOURS[1 + number % (len(COLOURS) - 1)]
        ax.plot(year, mean, color=colour, linewidth=1.2, marker="o", markersize=3, label=place)
        ax.fill_between(year, mean - half, mean + half, color=colour, alpha=0.2, linewidth=0)
    if made.limit is not None and quantity.startswith("depth") and scale * made.limit < ax.get_ylim()[1]:
        ax.axhline(scale * made.limit, color="#8a8a8a", linewidth=1.5)
    _frame(ax, "time in service (years)", f"{quantity.replace('_', ' ')} (mm)" if metres else label(column))
    _legend(ax)
    return ax
