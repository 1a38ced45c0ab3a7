"""Fluid-elastic margins of tubes in a cross flow."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from ._core import Case


@dataclass(frozen=True)
class FlowMargin:
    """A mode in a cross flow: ``margin`` is the critical velocity over the effective one.

    Below 1 the mode is unstable; the margin is infinite where no flow reaches the mode.
    ``frequency`` is in Hz, ``damping_ratio`` a share of critical damping, ``effective_velocity``
    and ``critical_velocity`` are in m/s. ``bodies`` are those in the flow that the mode moves, where
    the case has several.
    """

    frequency: float
    damping_ratio: float
    effective_velocity: float
    critical_velocity: float
    margin: float
    bodies: tuple[str, ...] = ()


@dataclass(frozen=True)
class FluidElastic:
    """The margins of tubes by Connors' criterion with the constant ``connors``, slowest modes first.

    ``inactive`` are those of the modes that no support holds, ``active`` those with all supports
    active; the latter is empty without supports.
    """

    connors: float
    inactive: tuple[FlowMargin, ...]
    active: tuple[FlowMargin, ...]


def _margin(mode: dict[str, Any]) -> FlowMargin:
    margin = mode["margin"]
    return FlowMargin(
        mode["frequency_hz"],
        mode["damping_ratio"],
        mode["effective_velocity_m_per_s"],
        mode["critical_velocity_m_per_s"],
        float("inf") if margin is None else margin,
        tuple(mode["bodies"]),
    )


def fluid_elastic(case: Case) -> FluidElastic | None:
    """The margins of a case, as `Case.fluid_elastic` says."""
    found = case._fluid_elastic()
    if found is None:
        return None
    inactive, active = (tuple(map(_margin, found[supports])) for supports in ("inactive", "active"))
    return FluidElastic(found["connors"], inactive, active)
