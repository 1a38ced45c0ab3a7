"""Scenes from numbers, dimensions, matrices and modes."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any, TypedDict, Unpack

import numpy as np
import numpy.typing as npt

from . import _core
from ._core import Load, Rayleigh, Scene, Wall
from ._keywords import keywords
from ._matrix import Entries, lower
from ._types import End, Place, check_number, real_numbers, whole


class SceneOptions(TypedDict, total=False):
    """Arguments of every function that makes a scene, besides its own: see `Scene.replace`."""

    walls: Sequence[Wall]
    loads: Sequence[Load]
    probes: Mapping[str, Place]
    displacement: float | Sequence[float] | npt.NDArray[np.float64]
    velocity: float | Sequence[float] | npt.NDArray[np.float64]
    duration: float
    output_times: Sequence[float] | npt.NDArray[np.float64]


class ReducedOptions(SceneOptions, total=False):
    """The same for structures that may be reduced to modes."""

    modes: int
    static_correction: bool


class StructureOptions(ReducedOptions, total=False):
    """The same for structures whose damping is not among their own arguments."""

    damping: float | Sequence[float] | Rayleigh


@keywords(SceneOptions)
def oscillator(mass: float, damping: float, stiffness: float, **scene: Unpack[SceneOptions]) -> Scene:
    """One degree of freedom, m q̈ + c q̇ + k q = f, at rest at 0 for one second unless told otherwise.

    Parameters
    ----------
    mass, damping, stiffness : float
        kg, N s/m, N/m.
    **scene
        Walls, loads and so on: see `Scene.replace`.

    Returns
    -------
    Scene

    Raises
    ------
    ValueError
        For the first value that makes no sense: which, and what would be accepted.

    Examples
    --------
    >>> import signorini as sg
    >>> sg.oscillator(1.0, 0.2, 100.0, walls=[sg.Wall.upper("stop", 5e-3)])
    <Scene: oscillator of 1.0 kg, 0.2 N s/m, 100.0 N/m, 1 wall, 0 loads, 1.0 s>
    """
    return _core._oscillator(mass, damping, stiffness).replace(**scene)


@keywords(StructureOptions)
def chain(
    masses: Sequence[float] | npt.NDArray[np.float64],
    springs: Sequence[float] | npt.NDArray[np.float64],
    *,
    grounds: tuple[float, float] = (0.0, 0.0),
    **scene: Unpack[StructureOptions],
) -> Scene:
    """Masses in a line with springs between neighbours.

    Parameters
    ----------
    masses : sequence of float
        n masses, kg.
    springs : sequence of float
        n - 1 stiffnesses, N/m.
    grounds : pair of float
        Stiffnesses that hold the first and the last mass, N/m.
    **scene
        Walls, loads and so on, whose places are numbers of masses from 0: see `Scene.replace`.

    Returns
    -------
    Scene

    Raises
    ------
    ValueError
        For the first value that makes no sense.

    Examples
    --------
    >>> import signorini as sg
    >>> stop = sg.Wall.upper("stop", 1e-3, restitution=0.5, at=1)
    >>> sg.chain([2.0, 2.0], [1e4], grounds=(3e4, 0.0), walls=[stop], velocity=[0.0, 0.1])
    <Scene: 2 degrees of freedom, 1 wall, 0 loads, 1.0 s>
    """
    return _core._chain(masses, springs, grounds).replace(**scene)


@keywords(StructureOptions)
def bar(
    *,
    length: float,
    area: float,
    youngs_modulus: float,
    density: float,
    elements: int,
    left: End = "free",
    right: End = "free",
    lumped: bool = False,
    **scene: Unpack[StructureOptions],
) -> Scene:
    """A bar in axial motion, by linear elements of equal length.

    Parameters
    ----------
    length, area, youngs_modulus, density : float
        m, m², Pa, kg/m³.
    elements : int
        1 to 100 000.
    left, right : str or float
        ``"free"``, ``"fixed"``, or the stiffness of a spring to the ground, N/m.
    lumped : bool
        Whether the mass of an element sits at its nodes.
    **scene
        Walls, loads and so on, whose places are positions in m from the left: see `Scene.replace`.

    Returns
    -------
    Scene

    Raises
    ------
    ValueError
        For the first value that makes no sense.

    Examples
    --------
    >>> import signorini as sg
    >>> sg.bar(length=1.0, area=1e-4, youngs_modulus=2e11, density=7850.0, elements=50, left="fixed",
    ...        walls=[sg.Wall.upper("stop", 1e-4, at=1.0)], modes=10)
    <Scene: 10 of 50 modes, 1 wall, 0 loads, 1.0 s>
    """
    elements = whole("elements", elements, 1)
    made = _core._bar(length, area, youngs_modulus, density, elements, left, right, lumped)
    return made.replace(**scene)


@keywords(StructureOptions)
def beam(
    *,
    length: float,
    youngs_modulus: float,
    density: float,
    outer_diameter: float | None = None,
    elements: int,
    inner_diameter: float | None = None,
    width: float | None = None,
    height: float | None = None,
    added_mass: float = 0.0,
    left: End = "pinned",
    right: End = "pinned",
    **scene: Unpack[StructureOptions],
) -> Scene:
    """A tube, rod or rectangular beam in bending, by Euler–Bernoulli elements of equal length.

    Parameters
    ----------
    length, youngs_modulus, density : float
        m, Pa, kg/m³.
    outer_diameter, inner_diameter : float
        Of a tube, m; a rod has no inner one.
    width, height : float
        Of a solid rectangle, m, in place of the diameters: across the vibration, and in its direction.
    added_mass : float
        Mass of the fluid that moves with it, kg/m.
    elements : int
        1 to 100 000.
    left, right : str or pair of float
        ``"free"``, ``"pinned"``, ``"clamped"``, or the stiffnesses of springs, N/m and N m/rad.
    **scene
        Walls, loads and so on, whose places are positions in m from the left: see `Scene.replace`.

    Returns
    -------
    Scene

    Raises
    ------
    ValueError
        For the first value that makes no sense.

    Examples
    --------
    >>> import signorini as sg
    >>> sg.beam(length=3.0, youngs_modulus=2e11, density=7850.0, outer_diameter=19.05e-3,
    ...         inner_diameter=15.75e-3, added_mass=0.565, elements=30,
    ...         walls=sg.support("first", 2e-4, at=1.0, restitution=0.5),
    ...         loads=[sg.Load.harmonic(10.0, 25.0, at=0.5)], modes=20, damping=0.01, duration=0.2)
    <Scene: 20 of 60 modes, 2 walls, 1 load, 0.2 s>
    """
    made = _core._beam(
        length, youngs_modulus, density, (outer_diameter, inner_diameter), (width, height), added_mass,
        whole("elements", elements, 1), left, right,
    )  # fmt: skip
    return made.replace(**scene)


@keywords(ReducedOptions)
def matrices(
    mass: Any, damping: Any | None, stiffness: Any, **scene: Unpack[ReducedOptions]
) -> Scene:
    """A structure by its matrices, M q̈ + C q̇ + K q = f.

    Parameters
    ----------
    mass, stiffness : array of shape (n, n), or a sparse matrix of SciPy
        Symmetric, kg and N/m. Degrees of freedom without mass are condensed: a rigid wall that pushes
        them is a spring of their static compliance then, without restitution.
    damping : array of shape (n, n), sparse matrix, float, sequence of float, Rayleigh or None
        N s/m; or as in `Scene.replace`.
    **scene
        Walls, loads and so on, whose places are degrees of freedom from 0: see `Scene.replace`.

    Returns
    -------
    Scene

    Raises
    ------
    ValueError
        For matrices of wrong shapes, not symmetric or not definite, and other values that make no
        sense.
    TypeError
        For entries that are no numbers.

    Examples
    --------
    >>> import numpy as np
    >>> import signorini as sg
    >>> sg.matrices(np.eye(2), sg.Rayleigh(0.0, 1e-4), np.array([[4e4, -1e4], [-1e4, 1e4]]))
    <Scene: 2 degrees of freedom, 0 walls, 0 loads, 1.0 s>
    """
    n, m = lower("mass", mass)
    size, k = lower("stiffness", stiffness)
    sizes = {"stiffness": size}
    c: Entries = (np.empty(0, np.int64), np.empty(0, np.int64), np.empty(0))
    if hasattr(damping, "tocoo") or (damping is not None and np.ndim(damping) == 2):
        sizes["damping"], c = lower("damping", damping)
        damping = None
    for name, size in sizes.items():
        if size != n:
            raise ValueError(f"{name} matrix is {size} × {size}; expected {n} × {n}, as the mass")
    return _core._matrices(n, m, c, k).replace(damping=damping, **scene)


@keywords(SceneOptions)
def modal(
    frequencies: Sequence[float] | npt.NDArray[np.float64],
    shapes: Mapping[str, Sequence[float] | npt.NDArray[np.float64]],
    *,
    masses: Sequence[float] | npt.NDArray[np.float64] | None = None,
    ratios: float | Sequence[float] | npt.NDArray[np.float64] = 0.0,
    **scene: Unpack[SceneOptions],
) -> Scene:
    """A structure by its modes, from a finite-element program or a modal test.

    Parameters
    ----------
    frequencies : sequence of float
        Hz, 0 for a rigid-body motion; one per mode.
    shapes : mapping of str to sequence of float
        The mode shapes at each named point, one value per mode.
    masses : sequence of float, optional
        Generalised masses, kg; 1 for mass-normalised shapes, the default.
    ratios : float or sequence of float
        Damping ratios, one for all modes or one per mode.
    **scene
        Walls, loads and so on, whose places are names of points: see `Scene.replace`.

    Returns
    -------
    Scene

    Raises
    ------
    ValueError
        For the first value that makes no sense.

    Examples
    --------
    >>> import signorini as sg
    >>> sg.modal([12.0, 48.0], {"tip": [1.0, -1.0]}, ratios=0.01, walls=[sg.Wall.upper("stop", 1e-3, at="tip")])
    <Scene: 2 degrees of freedom, 1 wall, 0 loads, 1.0 s>
    """
    omega = 2.0 * np.pi * real_numbers("frequencies", frequencies)
    k = len(omega)
    each = np.full(k, float(ratios)) if isinstance(ratios, (int, float)) else real_numbers("ratios", ratios)
    points = [(name, real_numbers(f"the shape of {name!r}", shape).tolist()) for name, shape in shapes.items()]
    return _core._modal(omega, np.ones(k) if masses is None else masses, each, points).replace(**scene)


@keywords()
def support(
    name: str,
    gap: float,
    *,
    at: Place = None,
    centre: float = 0.0,
    restitution: float | None = None,
    stiffness: float | None = None,
    damping: float | None = None,
) -> list[Wall]:
    """A loose support: the walls ``name-upper`` and ``name-lower`` at ``centre`` ± ``gap``.

    Parameters
    ----------
    name : str
        Letters, digits, ``-`` and ``_``.
    gap : float
        Distance of each wall from the centre, m; 0 or more.
    at, restitution, stiffness, damping
        As in `Wall.upper`.
    centre : float
        m.

    Returns
    -------
    list of Wall
        The upper one, the lower one.

    Raises
    ------
    ValueError
        For values that make no sense.
    TypeError
        For a gap or a centre that is no number.

    Examples
    --------
    >>> import signorini as sg
    >>> sg.support("first", 2e-4, at=1.0, restitution=0.5)[0]
    Wall.upper("first-upper", 0.0002, restitution=0.5, at=1.0)
    """
    for label, value in (("gap", gap), ("centre", centre)):
        check_number(f"support {name!r}: {label}", value)
    if not gap >= 0.0:
        raise ValueError(f"support {name!r}: gap is {gap!r}; expected a number of m, 0 or more")
    upper = Wall.upper(
        f"{name}-upper", centre + gap, restitution=restitution, stiffness=stiffness, damping=damping, at=at
    )
    lower = Wall.lower(
        f"{name}-lower", centre - gap, restitution=restitution, stiffness=stiffness, damping=damping, at=at
    )
    return [upper, lower]
