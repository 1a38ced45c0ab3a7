"""A tube in two planes, its loose supports, and the law of their wear."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Any

from ._core import Case, Load
from ._document import case
from ._keywords import keywords
from ._turbulence import Turbulence, shown
from ._types import End, Place, sequence

SECONDS_PER_YEAR = 365.25 * 86400.0


@dataclass(frozen=True, repr=False)
class Support:
    """A loose support in two planes, or a slider in one: see `hole`, `flats` and `slider`."""

    name: str
    values: Mapping[str, Any]

    def __repr__(self) -> str:
        return f"Support({shown(self._table())})"

    def _table(self) -> dict[str, Any]:
        return {"name": self.name, **self.values}


CasePlace = Mapping[str, Any]
Friction = Mapping[str, float]


def _at(at: Place | CasePlace) -> Any:
    """A place as a table of a case file."""
    return {"position": at} if isinstance(at, (int, float)) else at


@keywords()
def hole(
    name: str,
    gap: float,
    *,
    at: float | CasePlace | None = None,
    centre: Sequence[float] | None = None,
    restitution: float | None = None,
    stiffness: float | None = None,
    damping: float | None = None,
    friction: float | Friction | None = None,
    width: float | None = None,
    radius: float | None = None,
    coefficient: float | None = None,
    support_coefficient: float | None = None,
    growth: str | None = None,
) -> Support:
    """A round hole around a place, as in the plates of a steam generator.

    Parameters
    ----------
    name : str
        Letters, digits, ``-`` and ``_``.
    gap : float
        Radius of the hole less that of the tube, m; above 0.
    at : float or mapping, optional
        The place: m from the left end of a tube, or a place of the case format such as
        ``{"joint": 1}`` (the end of the first span), ``{"dof": 0}``, or of several bodies
        ``{"body": "a", "position": 1.0, "relative_to": {"body": "b", "position": 1.0}}``.
    centre : pair of float, optional
        Along y and z, m; 0 unless given.
    restitution : float, optional
        Of a rigid hole, 0 to 1; the default is 1.
    stiffness, damping : float, optional
        N/m and N s/m of an elastic hole.
    friction : float or mapping, optional
        Coefficient of Coulomb friction; none unless given. With a larger one of a contact that
        sticks, ``{"static": 0.3, "kinetic": 0.2}``.
    width : float, optional
        Along the tube, m, for the depth of wear.
    radius : float, optional
        Of what wears, m, for the depth of wear; a tube has its own.
    coefficient, support_coefficient : float, optional
        Wear coefficients of tube and support here, 1/Pa, in place of those of `Archard`.
    growth : str, optional
        What ``signorini wear`` does to the gap over the years: ``"even"`` unless given, or
        ``"shifted"``.

    Returns
    -------
    Support
        For the ``supports`` of `tube`, or the list ``support`` of `case`, which check it.

    Raises
    ------
    TypeError
        For arguments that do not exist.

    Examples
    --------
    >>> import signorini as sg
    >>> sg.hole("plate-1", 2e-4, at=1.0, restitution=0.5)
    Support(name='plate-1', at={'position': 1.0}, shape='round', gap=0.0002, restitution=0.5)
    """
    values = {
        "at": _at(at), "shape": "round", "gap": gap, "centre": centre, "restitution": restitution,
        "stiffness": stiffness, "damping": damping, "friction": friction, "width": width, "radius": radius,
        "coefficient": coefficient, "support_coefficient": support_coefficient, "growth": growth,
    }  # fmt: skip
    return Support(name, values)


@keywords()
def flats(
    name: str,
    gap: float | Sequence[float],
    directions: Sequence[float] | None = None,
    *,
    sides: int | None = None,
    turn: float | None = None,
    at: float | CasePlace | None = None,
    centre: Sequence[float] | None = None,
    restitution: float | None = None,
    stiffness: float | None = None,
    damping: float | None = None,
    friction: float | Friction | None = None,
    width: float | None = None,
    radius: float | None = None,
    coefficient: float | None = None,
    support_coefficient: float | None = None,
    growth: str | None = None,
) -> Support:
    """Flats around a place, as the bars of a lattice.

    Parameters
    ----------
    name : str
        Letters, digits, ``-`` and ``_``; its walls are ``name-flat-1`` and so on.
    gap : float or sequence of float
        From the centre to each flat, m; 0 or more.
    directions : sequence of float, optional
        Where the flats stand, degrees from +y towards +z.
    sides : int, optional
        In place of directions: so many flats, evenly round.
    turn : float, optional
        Beside ``sides``: where the first flat stands, degrees.
    at, centre, restitution, stiffness, damping, friction, width, radius, coefficient, support_coefficient
        As in `hole`, of each flat.
    growth : str, optional
        ``"flats"`` for flats that recede by their scars over the years; they stay unless given.

    Returns
    -------
    Support
        For the ``supports`` of `tube`, or the list ``support`` of `case`, which check it.

    Raises
    ------
    TypeError
        For arguments that do not exist.

    Examples
    --------
    >>> import signorini as sg
    >>> sg.flats("bars", 2e-4, sides=4, at=1.0)
    Support(name='bars', at={'position': 1.0}, shape='flats', gap=0.0002, sides=4)
    """
    same = hole(
        name, 0.0, at=at, centre=centre, restitution=restitution, stiffness=stiffness, damping=damping,
        friction=friction, width=width, radius=radius, coefficient=coefficient,
        support_coefficient=support_coefficient, growth=growth,
    )  # fmt: skip
    own = {"shape": "flats", "gap": gap, "directions": directions, "sides": sides, "turn": turn}
    return Support(name, {**same.values, **own})


@keywords()
def slider(
    name: str,
    normal_force: float,
    friction: float | Friction,
    *,
    at: float | Mapping[str, Any] | None = None,
) -> Support:
    """A place that rubs under a known normal force, in one plane: a dry-friction damper.

    Parameters
    ----------
    name : str
        Letters, digits, ``-`` and ``_``.
    normal_force : float
        The force that presses it, N; above 0.
    friction : float or mapping
        Coefficient of Coulomb friction. With a larger one while it sticks,
        ``{"static": 0.3, "kinetic": 0.2}``.
    at : float or mapping, optional
        The place: m from the left end of a beam or bar, or a place of the case format such as
        ``{"dof": 0}``; left out for an oscillator.

    Returns
    -------
    Support
        For the list ``slider`` of `case`, which checks it.

    Raises
    ------
    TypeError
        For arguments that do not exist.

    Examples
    --------
    >>> import signorini as sg
    >>> sg.slider("pad", 10.0, 0.1)
    Support(name='pad', normal_force=10.0, friction=0.1)
    """
    values = {"at": _at(at), "normal_force": normal_force, "friction": friction}
    return Support(name, values)


@dataclass(frozen=True)
class Archard:
    """Archard's law of wear: volume = coefficient × work rate × time in service.

    Parameters
    ----------
    coefficient, support_coefficient : float, optional
        Of the tube and of its supports, 1/Pa.
    years, service : float, optional
        The time in service: years of 365.25 days, or s.
    limit : float, optional
        The depth up to which the tube may wear, as a share of its wall.
    sectors : int, optional
        Equal parts of the circle around each support; 12 unless given.

    Examples
    --------
    >>> import signorini as sg
    >>> sg.Archard(1e-14, years=40).coefficient
    1e-14
    """

    coefficient: float | None = None
    support_coefficient: float | None = None
    years: float | None = None
    service: float | None = None
    limit: float | None = None
    sectors: int | None = None

    def _table(self) -> dict[str, Any]:
        if self.years is not None and self.service is not None:
            raise ValueError(f"Archard: years is {self.years!r}, beside service; expected one of the two")
        service = self.service if self.years is None else self.years * SECONDS_PER_YEAR
        return {
            "coefficient": self.coefficient,
            "support_coefficient": self.support_coefficient,
            "service": service,
            "limit": self.limit,
            "sectors": self.sectors,
        }


def _end(end: End) -> Any:
    """The support of an end as a value of a case file."""
    if isinstance(end, tuple):
        stiffness, rotational = end
        return {"stiffness": stiffness, "rotational": rotational}
    return end


def _parts(name: str, given: Any, kinds: tuple[type, ...], makers: str) -> list[Any]:
    """The parts ``given``, unless it is one part, or has others than these ``kinds``."""
    parts = sequence(name, given, f"a sequence of what {makers} make")
    for part in parts:
        if not isinstance(part, kinds):
            raise TypeError(f"{name} has {part!r}; expected what {makers} make")
    return parts


@keywords()
def tube(
    *,
    length: float | None = None,
    spans: Sequence[float] | None = None,
    youngs_modulus: float,
    density: float,
    outer_diameter: float,
    inner_diameter: float | None = None,
    added_mass: float | None = None,
    elements: int | None = None,
    left: End = "pinned",
    right: End = "pinned",
    modes: int | None = None,
    damping: float | Sequence[float] | None = None,
    supports: Sequence[Support] = (),
    loads: Sequence[Load | Turbulence] = (),
    wear: Archard | None = None,
    connors: float | None = None,
    duration: float,
    step: float | None = None,
    sample: float | None = None,
    statistics_from: float | None = None,
    name: str = "tube",
) -> Case:
    """A tube in bending in two planes, in round holes and between flats, as a case.

    It is the case that a file with these values describes: `Case.text` is that file.

    Parameters
    ----------
    length : float, optional
        m.
    spans : sequence of float, optional
        In place of the length: what lies between supports, m; ``at={"joint": 1}`` is the end of
        the first.
    youngs_modulus, density : float
        Pa, kg/m³.
    outer_diameter, inner_diameter : float
        m; a rod has no inner one.
    added_mass : float, optional
        Mass of the fluid that moves with it, kg/m.
    elements : int, optional
        Of the whole tube, of equal length; 20 of each span unless given, and two and a half for
        each mode at least.
    left, right : str or pair of float
        ``"free"``, ``"pinned"``, ``"clamped"``, or the stiffnesses of springs, N/m and N m/rad.
    modes : int, optional
        How many modes of each plane are kept, the slowest.
    damping : float or sequence of float, optional
        Share of critical damping of every mode, or of each from the slowest on.
    supports : sequence of Support
        Made by `hole` and `flats`.
    loads : sequence of Load or Turbulence
        Each with a ``direction``; at positions in m, or along the tube.
    wear : Archard, optional
        Wear coefficients and the time in service.
    connors : float, optional
        Connors' constant of the bundle, about 3: `Case.fluid_elastic` are the margins in the flow
        of the turbulence among the loads.
    duration : float
        s.
    step : float, optional
        s; with ``modes`` unless given the largest of one digit that is at most 5e-5 and a tenth of
        the period of the fastest mode.
    sample : float, optional
        Time between two recorded rows, s; every step unless given.
    statistics_from : float, optional
        Where the window of the statistics begins, s.
    name : str
        Of the case.

    Returns
    -------
    Case

    Raises
    ------
    ValueError
        For the first value that makes no sense: line and key of the case, and what would be
        accepted.
    TypeError
        For supports or loads that are no sequence, or made by other functions.

    Examples
    --------
    >>> import signorini as sg
    >>> case = sg.tube(length=3.0, youngs_modulus=2e11, density=7850.0, outer_diameter=19.05e-3,
    ...     inner_diameter=15.75e-3, added_mass=0.565, elements=30, modes=10, damping=0.01,
    ...     supports=[sg.hole("plate", 2e-4, at=1.0, restitution=0.5, friction=0.2)],
    ...     loads=[sg.Load.harmonic(10.0, 25.0, at=0.5, direction=30.0)], duration=0.1, step=1e-4)
    >>> case.scene
    <Scene: 20 of 120 modes, 1 wall, 1 load, 0.1 s>
    """
    supports = _parts("supports", supports, (Support, Mapping), "sg.hole, sg.flats and sg.slider")
    loads = _parts("loads", loads, (Load, Turbulence, Mapping), "sg.Load and sg.turbulence")
    beam = {
        "length": length, "spans": spans, "youngs_modulus": youngs_modulus, "density": density,
        "outer_diameter": outer_diameter, "inner_diameter": inner_diameter, "added_mass": added_mass,
        "elements": elements, "left": _end(left), "right": _end(right),
    }  # fmt: skip
    ratio = "ratio" if isinstance(damping, (int, float)) else "ratios"
    system = {"planes": 2, "modes": modes, "beam": beam, "damping": None if damping is None else {ratio: damping}}
    time = {"end": duration, "step": step, "sample": sample, "statistics_from": statistics_from}
    flows = [load for load in loads if isinstance(load, Turbulence)]
    forces = [load for load in loads if not isinstance(load, Turbulence)]
    lists = {"support": list(supports) or None, "load": forces or None, "turbulence": flows or None}
    flow = None if connors is None else {"connors": connors}
    return case({"system": system, **lists, "flow": flow, "wear": wear, "time": time}, name=name)
