"""Vibrating structures between walls: contact forces by one convex QP per time step, by penalty, and exactly.

>>> import signorini as sg
>>> scene = sg.oscillator(
...     1.0, 0.2, 100.0,  # kg, N s/m, N/m
...     walls=[sg.Wall.upper("upper", 5e-3, restitution=0.8), sg.Wall.lower("lower", -5e-3, restitution=0.8)],
...     loads=[sg.Load.harmonic(3.0, 5.0)],
...     duration=2.0,
... )
>>> run = scene.run("moreau-jean", step=1e-4)
>>> run
<Run: moreau-jean, 20001 rows to 2.0 s, 20 contacts>
>>> bool((run.contact_force("upper") <= 0.0).all())
True

All values are in SI units. Forces of walls are signed: a lower wall pushes up, an upper wall down.
"""

from ._bifurcation import Bifurcation, bifurcation
from ._branches import Branches, branches
from ._builders import SceneOptions, bar, beam, chain, matrices, modal, oscillator, support
from ._case_sweep import SweepResult, one_at_a_time
from ._compare import Comparison, Differences, MethodRealisations, compare
from ._core import (
    AccuracyWarning,
    Case,
    DivergedError,
    Load,
    NotSolvedError,
    Rayleigh,
    RefutedError,
    ResultWarning,
    Run,
    RunError,
    Scene,
    Stepper,
    TooManyEventsError,
    Wall,
    __version__,
    load,
)
from ._derivative import Derivative, derivative
from ._document import case
from ._fit import Fit, fit
from ._flow import FlowMargin, FluidElastic
from ._orbit import Orbit, OrbitDerivative, orbit
from ._realisations import Realisations, realisations
from ._report import report
from ._studies import Chart, Stability, chart, stability
from ._supports import ErrorPart, ErrorParts, Estimate, PlaceMeans, Refinement, SupportStatistics, Wear
from ._sweep import Table, grid, run_many, sweep
from ._tube import Archard, Support, flats, hole, slider, tube
from ._turbulence import Turbulence, turbulence
from ._wear import LimitYears, WearStudy, wear

__all__ = [
    "AccuracyWarning",
    "Archard",
    "Bifurcation",
    "Branches",
    "Case",
    "Chart",
    "Comparison",
    "Derivative",
    "Differences",
    "DivergedError",
    "ErrorPart",
    "ErrorParts",
    "Estimate",
    "Fit",
    "FlowMargin",
    "FluidElastic",
    "LimitYears",
    "Load",
    "MethodRealisations",
    "NotSolvedError",
    "Orbit",
    "OrbitDerivative",
    "PlaceMeans",
    "Rayleigh",
    "Realisations",
    "Refinement",
    "RefutedError",
    "ResultWarning",
    "Run",
    "RunError",
    "Scene",
    "SceneOptions",
    "Stability",
    "Stepper",
    "Support",
    "SupportStatistics",
    "SweepResult",
    "Table",
    "TooManyEventsError",
    "Turbulence",
    "Wall",
    "Wear",
    "WearStudy",
    "__version__",
    "bar",
    "beam",
    "bifurcation",
    "branches",
    "case",
    "chain",
    "chart",
    "compare",
    "derivative",
    "fit",
    "flats",
    "grid",
    "hole",
    "load",
    "matrices",
    "modal",
    "one_at_a_time",
    "orbit",
    "oscillator",
    "realisations",
    "report",
    "run_many",
    "slider",
    "stability",
    "support",
    "sweep",
    "tube",
    "turbulence",
    "wear",
]
