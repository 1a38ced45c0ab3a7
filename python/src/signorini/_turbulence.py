"""Turbulence: random forces along a tube that are coherent over a length."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Any

from ._keywords import keywords


def shown(values: Mapping[str, Any]) -> str:
    """The values that are given, as arguments."""
    return ", ".join(f"{name}={value!r}" for name, value in values.items() if value is not None)


@dataclass(frozen=True, repr=False)
class Turbulence:
    """A field of random force along a tube: see `turbulence`."""

    values: Mapping[str, Any]

    def __repr__(self) -> str:
        return f"Turbulence({shown(self.values)})"

    def _table(self) -> dict[str, Any]:
        return dict(self.values)


@keywords()
def turbulence(
    *,
    band: tuple[float, float],
    correlation_length: float,
    density: float | None = None,
    velocity: float | Sequence[tuple[float, float]] | None = None,
    reduced: Sequence[tuple[float, float]] | None = None,
    spectrum: Sequence[tuple[float, float]] | None = None,
    direction: float | str = "both",
    along: tuple[float, float] | None = None,
    seed: int = 0,
) -> Turbulence:
    """The turbulence of a cross flow along a tube, as forces on its modes.

    Parameters
    ----------
    band : pair of float
        Hz: the frequencies between which there are forces.
    correlation_length : float
        m: the coherence of two points falls by e over it.
    density : float, optional
        Of the fluid, kg/m³.
    velocity : float or sequence of pairs, optional
        Of the fluid in the gaps, m/s; pairs are a position in m and the velocity there, straight
        between.
    reduced : sequence of pairs, optional
        Reduced frequencies fD/V and the reduced densities there, straight in logarithms.
    spectrum : sequence of pairs, optional
        In place of these three: Hz and (N/m)²/Hz, one-sided, the same along the tube.
    direction : float or str
        Degrees from +y towards +z, or ``"both"``: independent fields along y and z.
    along : pair of float, optional
        From and to, m; the whole tube unless given.
    seed : int
        0 or more.

    Returns
    -------
    Turbulence
        For the ``loads`` of `tube`, or the list ``turbulence`` of `case`, which check it.

    Raises
    ------
    TypeError
        For arguments that do not exist.

    Examples
    --------
    >>> import signorini as sg
    >>> flow = sg.turbulence(density=740.0, velocity=[(0.0, 3.0), (3.0, 1.5)], band=(5.0, 150.0),
    ...     reduced=[(0.01, 0.05), (0.2, 0.0112), (3.0, 8.6e-7)], correlation_length=0.06, seed=1)
    """
    start, end = band
    return Turbulence(
        {
            "direction": direction, "density": density, "velocity": velocity, "reduced": reduced,
            "spectrum": spectrum, "along": along, "from": start, "to": end,
            "correlation_length": correlation_length, "seed": seed,
        }  # fmt: skip
    )
