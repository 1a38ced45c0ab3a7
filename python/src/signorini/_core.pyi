from collections.abc import Callable, Mapping, Sequence
from os import PathLike
from pathlib import Path
from typing import Any, Final, Literal, final

import numpy as np
import numpy.typing as npt
import pandas as pd

from ._derivative import Derivative
from ._flow import FluidElastic
from ._supports import SupportStatistics, Wear
from ._types import Array, End, Place

__all__ = [
    "AccuracyWarning",
    "Case",
    "DivergedError",
    "Load",
    "NotSolvedError",
    "Rayleigh",
    "RefutedError",
    "ResultWarning",
    "Run",
    "RunError",
    "Scene",
    "Stepper",
    "TooManyEventsError",
    "Wall",
    "_SETTLE",
    "__version__",
    "_bar",
    "_beam",
    "_bifurcation",
    "_branches",
    "_case",
    "_case_scene_at",
    "_case_value_at",
    "_cautioned",
    "_chain",
    "_chart",
    "_columns",
    "_compare",
    "_derivative",
    "_matrices",
    "_modal",
    "_orbit",
    "_oscillator",
    "_placed_columns",
    "_realisations",
    "_report",
    "_run_many",
    "_scene_at",
    "_stability",
    "_sweep",
    "_unit",
    "_value_at",
    "_wear",
    "load",
]
__version__: Final[str]
_SETTLE: Final[int]

_Numbers = float | Sequence[float] | Array
_Entries = tuple[npt.NDArray[np.int64], npt.NDArray[np.int64], Array]

class RunError(RuntimeError): ...

class DivergedError(RunError):
    run: Run

class TooManyEventsError(RunError): ...
class NotSolvedError(RunError): ...

class RefutedError(RunError):
    run: Run
    study: object

class AccuracyWarning(UserWarning): ...
class ResultWarning(UserWarning): ...

@final
class Wall:
    @staticmethod
    def upper(
        name: str,
        position: float,
        *,
        restitution: float | None = None,
        stiffness: float | None = None,
        damping: float | None = None,
        exponent: float | None = None,
        dissipation: float | None = None,
        at: Place = None,
    ) -> Wall: ...
    @staticmethod
    def lower(
        name: str,
        position: float,
        *,
        restitution: float | None = None,
        stiffness: float | None = None,
        damping: float | None = None,
        exponent: float | None = None,
        dissipation: float | None = None,
        at: Place = None,
    ) -> Wall: ...
    @property
    def name(self) -> str: ...
    @property
    def position(self) -> float: ...
    @property
    def side(self) -> str: ...
    @property
    def restitution(self) -> float | None: ...
    @property
    def stiffness(self) -> float | None: ...
    @property
    def damping(self) -> float | None: ...
    @property
    def exponent(self) -> float | None: ...
    @property
    def dissipation(self) -> float | None: ...
    @staticmethod
    def _restore(version: str, bytes: bytes) -> Wall: ...
    def __eq__(self, value: object, /) -> bool: ...
    def __ne__(self, value: object, /) -> bool: ...
    def __reduce__(self) -> tuple[Any, ...]: ...

@final
class Load:
    @staticmethod
    def constant(force: float, *, at: Place = None, direction: float | str | None = None) -> Load: ...
    @staticmethod
    def harmonic(
        amplitude: float,
        frequency: float,
        phase: float = 0.0,
        *,
        at: Place = None,
        direction: float | str | None = None,
    ) -> Load: ...
    @staticmethod
    def impulse(
        impulse: float, time: float = 0.0, *, at: Place = None, direction: float | str | None = None
    ) -> Load: ...
    @staticmethod
    def random(
        *,
        rms: float | None = None,
        band: tuple[float, float] | None = None,
        psd: Sequence[tuple[float, float]] | None = None,
        seed: int = 0,
        at: Place = None,
        direction: float | str | None = None,
    ) -> Load: ...
    @staticmethod
    def base(
        file: str | PathLike[str] | None = None,
        *,
        amplitude: float | None = None,
        frequency: float | None = None,
        phase: float | None = None,
        time: str | None = None,
        acceleration: str | None = None,
        scale: float | None = None,
        rms: float | None = None,
        band: tuple[float, float] | None = None,
        psd: Sequence[tuple[float, float]] | None = None,
        seed: int | None = None,
        direction: float | str | None = None,
    ) -> Load: ...
    @staticmethod
    def gravity(acceleration: float, *, direction: float | str | None = None) -> Load: ...
    @staticmethod
    def table(time: Sequence[float] | Array, force: Sequence[float] | Array, *, at: Place = None) -> Load: ...
    @staticmethod
    def function(force: Callable[[float], float], *, at: Place = None) -> Load: ...
    def _table(self) -> dict[str, Any]: ...
    @staticmethod
    def _restore(version: str, bytes: bytes) -> Load: ...
    def __eq__(self, value: object, /) -> bool: ...
    def __ne__(self, value: object, /) -> bool: ...
    def __reduce__(self) -> tuple[Any, ...]: ...

@final
class Rayleigh:
    def __new__(cls, mass: float, stiffness: float) -> Rayleigh: ...
    @property
    def mass(self) -> float: ...
    @property
    def stiffness(self) -> float: ...
    def __eq__(self, value: object, /) -> bool: ...
    def __ne__(self, value: object, /) -> bool: ...
    def __reduce__(self) -> tuple[Any, ...]: ...

@final
class Scene:
    def replace(
        self,
        *,
        walls: Sequence[Wall] | None = None,
        loads: Sequence[Load] | None = None,
        probes: Mapping[str, Place] | None = None,
        output_times: Sequence[float] | Array | None = None,
        displacement: _Numbers | None = None,
        velocity: _Numbers | None = None,
        duration: float | None = None,
        damping: _Numbers | Rayleigh | None = None,
        modes: int | None = None,
        static_correction: bool | None = None,
    ) -> Scene: ...
    def run(
        self,
        scheme: str | None = None,
        *,
        step: float | None = None,
        accuracy: float | None = None,
        sample: float | None = None,
        statistics_from: float = 0.0,
    ) -> Run: ...
    @property
    def walls(self) -> tuple[Wall, ...]: ...
    @property
    def _wall_names(self) -> tuple[str, ...]: ...
    @property
    def loads(self) -> tuple[Load, ...]: ...
    @property
    def probes(self) -> tuple[str, ...]: ...
    @property
    def duration(self) -> float: ...
    @property
    def degrees_of_freedom(self) -> int: ...
    @property
    def gap_scale(self) -> float: ...
    @staticmethod
    def _restore(version: str, bytes: bytes) -> Scene: ...
    def __eq__(self, value: object, /) -> bool: ...
    def __ne__(self, value: object, /) -> bool: ...
    def __reduce__(self) -> tuple[Any, ...]: ...

@final
class Case:
    @property
    def name(self) -> str: ...
    @property
    def title(self) -> str | None: ...
    @property
    def scene(self) -> Scene: ...
    @property
    def step(self) -> float: ...
    @property
    def sample(self) -> float | None: ...
    @property
    def statistics_from(self) -> float: ...
    @property
    def text(self) -> str: ...
    @property
    def notes(self) -> list[str]: ...
    @property
    def fluid_elastic(self) -> FluidElastic | None: ...
    def _fluid_elastic(self) -> dict[str, Any] | None: ...
    def run(
        self,
        scheme: str | None = None,
        *,
        step: float | None = None,
        accuracy: float | None = None,
        of: Literal["motion", "means"] | None = None,
        folder: str | PathLike[str] | None = None,
        verdict: bool = True,
    ) -> Run: ...
    @staticmethod
    def _restore(version: str, bytes: bytes) -> Case: ...
    def __reduce__(self) -> tuple[Any, ...]: ...

@final
class Run:
    @property
    def scene(self) -> Scene: ...
    @property
    def scheme(self) -> str: ...
    @property
    def step(self) -> float | None: ...
    @property
    def time(self) -> Array: ...
    @property
    def displacement(self) -> Array: ...
    @property
    def velocity(self) -> Array: ...
    def probe(self, name: str) -> tuple[Array, Array]: ...
    def contact_force(self, wall: str) -> Array: ...
    def contact_impulse(self, wall: str) -> Array: ...
    def impulse(self, wall: str) -> float: ...
    @property
    def holes(self) -> list[str]: ...
    def hole_force(self, name: str) -> tuple[Array, Array]: ...
    def hole_impulse(self, name: str) -> tuple[Array, Array]: ...
    @property
    def supports(self) -> Mapping[str, SupportStatistics]: ...
    def wear_work(self, name: str) -> Array: ...
    @property
    def walls(self) -> list[str]: ...
    @property
    def probes(self) -> list[str]: ...
    @property
    def state(self) -> tuple[Array, Array]: ...
    @property
    def seconds(self) -> float: ...
    @property
    def notes(self) -> list[str]: ...
    @property
    def findings(self) -> list[str]: ...
    @property
    def contacts(self) -> npt.NDArray[np.void]: ...
    @property
    def columns(self) -> dict[str, Array]: ...
    @property
    def output(self) -> dict[str, Array]: ...
    @property
    def statistics(self) -> dict[str, dict[str, Any]]: ...
    @property
    def wear(self) -> Mapping[str, Wear[float]]: ...
    @property
    def summary(self) -> dict[str, Any]: ...
    def to_pandas(self) -> pd.DataFrame: ...
    def plot(self, axes: Any = None) -> Any: ...
    def verdict(self) -> dict[str, Any]: ...
    def derivative(self, keys: Sequence[str], *, times: Sequence[float] | None = None) -> Derivative: ...
    def _output(self) -> tuple[Array, list[tuple[Array, Array]]]: ...
    def _contacts(self) -> dict[str, npt.NDArray[Any]]: ...
    def _summary(self) -> dict[str, Any]: ...
    def _supports(self) -> list[dict[str, Any]]: ...
    def _repr_html_(self) -> str: ...
    @staticmethod
    def _restore(version: str, scene: Scene, bytes: bytes) -> Run: ...
    def __reduce__(self) -> tuple[Any, ...]: ...

@final
class Stepper:
    def __new__(cls, scene: Scene, scheme: str, step: float) -> Stepper: ...
    def step(self, force: _Numbers | None = None) -> float: ...
    def advance(self, end: float, force: Callable[[float, Any, Any], _Numbers] | None = None) -> int: ...
    def set_state(self, time: float, q: _Numbers, v: _Numbers) -> None: ...
    @property
    def time(self) -> float: ...
    @property
    def q(self) -> Array: ...
    @property
    def v(self) -> Array: ...
    @property
    def force(self) -> Array: ...
    @property
    def impulse(self) -> Array: ...

def load(case: str | PathLike[str], *, set: Mapping[str, Any] | None = None) -> Case: ...
def _case(text: str, name: str) -> Case: ...
def _case_scene_at(case: Case, values: Sequence[tuple[str, float]]) -> Scene: ...
def _case_value_at(case: Case, key: str) -> float: ...
def _scene_at(scene: Scene, values: Sequence[tuple[str, float]]) -> Scene: ...
def _value_at(scene: Scene, key: str) -> float: ...
def _derivative(
    scene: Scene, keys: Sequence[tuple[str, float, Callable[[float], Scene]]], times: Sequence[float]
) -> dict[str, Any]: ...
def _oscillator(mass: float, damping: float, stiffness: float) -> Scene: ...
def _chain(
    masses: Sequence[float] | Array, springs: Sequence[float] | Array, grounds: tuple[float, float]
) -> Scene: ...
def _bar(
    length: float,
    area: float,
    youngs_modulus: float,
    density: float,
    elements: int,
    left: End,
    right: End,
    lumped: bool,
) -> Scene: ...
def _beam(
    length: float,
    youngs_modulus: float,
    density: float,
    diameters: tuple[float | None, float | None],
    sides: tuple[float | None, float | None],
    added_mass: float,
    elements: int,
    left: End,
    right: End,
) -> Scene: ...
def _matrices(n: int, mass: _Entries, damping: _Entries, stiffness: _Entries) -> Scene: ...
def _modal(
    omega: Sequence[float] | Array,
    masses: Sequence[float] | Array,
    ratios: Sequence[float] | Array,
    points: Sequence[tuple[str, Sequence[float]]],
) -> Scene: ...
def _compare(
    scene: Scene | Case,
    methods: Sequence[str],
    step: float | None,
    sample: float | None,
    statistics_from: float | None,
    seeds: int | None,
    verdict: bool,
    progress: Callable[[int, int], None],
) -> tuple[list[dict[str, Any]], list[str], float, dict[str, Any] | None]: ...
def _chart(
    scene: Scene | Case,
    methods: Sequence[str] | None,
    coarsest: float | None,
    finest: float | None,
    levels: int | None,
    repeats: int,
    most_seconds: float,
) -> tuple[list[dict[str, Any]], str, float]: ...
def _stability(
    scene: Scene | Case,
    finest: float | None,
    coarsest: float | None,
    per_decade: float | None,
    contacts: int | None,
) -> tuple[list[dict[str, Any]], list[dict[str, Any]]]: ...
def _bifurcation(
    case: Case,
    key: str,
    values: Sequence[Any],
    scheme: str,
    settle: int,
    keep: int,
    follow: str,
    samples: str,
    threads: int,
) -> tuple[list[dict[str, Any]], list[tuple[str | None, str | None]]]: ...
def _orbit(
    scene: Scene | Case, settle: int, rows: int, keys: list[tuple[str, float, Callable[[float], Scene]]]
) -> dict[str, Any]: ...
def _branches(
    case: Case,
    key: str,
    range: tuple[float, float],
    asked: tuple[str | PathLike[str] | None, int, str, int, int],
    folder: str | PathLike[str],
    page: bool,
) -> list[str]: ...
def _report(
    folder: str | PathLike[str], over: str | PathLike[str] | None, out: str | PathLike[str] | None
) -> tuple[Path, str | None]: ...
def _realisations(
    case: Case,
    scheme: str | None,
    step: float | None,
    asked: tuple[int | None, float | None, int | None],
    most_time: float | None,
    accuracy: float | None,
    verdict: bool,
    folder: str | PathLike[str] | None,
    progress: Callable[[int, int], None],
) -> dict[str, Any]: ...
def _wear(
    case: Case,
    scheme: str | None,
    step: float | None,
    years: float | None,
    histories: int | None,
    within: tuple[float | None, int | None, float | None],
    verdict: bool,
    folder: str | PathLike[str] | None,
    counted: Callable[[int, int], None],
    progress: Callable[[int], None],
) -> dict[str, Any]: ...
def _cautioned(cautions: Sequence[tuple[str | None, str | None]]) -> list[str]: ...
def _columns(walls: Sequence[str]) -> list[str]: ...
def _unit(key: str) -> str | None: ...
def _placed_columns(case: Case, measures: Sequence[str]) -> list[tuple[str, str, str, str]]: ...
def _run_many(
    scenes: Sequence[Scene],
    scheme: str | None,
    step: float | None,
    statistics_from: float,
    judge: bool,
    threads: int,
    progress: Callable[[int], None] | None,
) -> tuple[Array, list[str | None], list[tuple[str | None, str | None]]]: ...
def _sweep(
    case: Case,
    axes: Sequence[tuple[str, Sequence[Any]]],
    one_at_a_time: bool,
    random: tuple[str, int | None, int | None] | None,
    scheme: str | None,
    measures: Sequence[str],
    periods: tuple[int | None, int | None],
    asked: tuple[int | None, float | None, int | None],
    threads: int | None,
    folder: str | PathLike[str],
    progress: Callable[[int, int], None],
) -> tuple[list[str], int, int, str | None]: ...
