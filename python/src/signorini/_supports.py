"""Statistics of the supports of a run, and the wear there."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import TYPE_CHECKING, Any, Generic, Literal, TypeVar

import numpy as np
import numpy.typing as npt

from ._columns import ReadOnly

if TYPE_CHECKING:
    from ._core import Run

V = TypeVar("V")


@dataclass(frozen=True)
class ErrorPart:
    """What a refinement is expected to add to a mean, with the half width of its 95 % interval."""

    mean: float
    half_width: float


@dataclass(frozen=True)
class ErrorParts:
    """The error of a mean over realisations, in parts, in the unit of the mean.

    ``start`` is the second half of the window less the first; ``step`` what further halvings of
    the step change, ``modes`` what twice the modes change, None where there is no such part or it
    is not known; ``sampling`` the half width of the interval of the mean. ``total`` is the sum of
    the sizes of the means and the root of the sum of all squared half widths.
    """

    start: ErrorPart
    step: ErrorPart | None
    modes: ErrorPart | None
    sampling: float
    total: float


@dataclass(frozen=True)
class Refinement:
    """What a refinement makes of a mean that need not converge.

    ``refined`` is "half the step" or a number of modes; ``own`` the mean of the realisations that
    were run again, ``then`` that of the same with the refinement.
    """

    refined: str
    own: float
    then: float


@dataclass(frozen=True)
class Estimate:
    """A mean with its 95 % interval.

    ``half_width`` is None where there is too little to tell; ``kind`` says what the interval is
    made of: ``"batches"`` are equal parts of the window of a run, ``"periodic"`` such parts of
    whole periods of the loads, ``"seeds"`` independent realisations of the random loads. Of the
    latter ``deviation`` is the standard deviation of one realisation, and ``error`` the error in
    parts, where it is known. What need not converge (impact share, sliding, contacts, impact power)
    has ``refinements`` in its place.
    """

    value: float
    half_width: float | None
    kind: Literal["batches", "periodic", "seeds"] | None
    deviation: float | None = None
    error: ErrorParts | None = None
    refinements: tuple[Refinement, ...] = ()

    def __str__(self) -> str:
        return f"{self.value:.4g}" if self.half_width is None else f"{self.value:.4g} ± {self.half_width:.2g}"


class PlaceMeans(ReadOnly[str, Estimate]):
    """The means of the measures at one support or wall, each under its name.

    A mapping, ``means["work_rate"]``, whose measures are attributes as well: ``means.work_rate``.
    ``force_mean``, ``force_mean_y``, ``force_mean_z``, ``force_rms`` and ``force_largest`` are in
    N, ``work_rate``, ``friction_power`` and ``impact_power`` in W, ``sliding_rate`` in m/s,
    ``impact_share`` is a share of the work rate and ``contacts`` a number. By the law of wear of
    the case, within its service, ``worn_volume`` and ``support_worn_volume`` (m³),
    ``depth_deepest``, ``depth_one_scar`` and ``depth_all_round`` (m) follow. ``list(means)`` are
    those that the place has; another is an `AttributeError`, or a `KeyError`.
    """

    force_mean: Estimate
    force_mean_y: Estimate
    force_mean_z: Estimate
    force_rms: Estimate
    force_largest: Estimate
    work_rate: Estimate
    friction_power: Estimate
    impact_share: Estimate
    sliding_rate: Estimate
    contacts: Estimate
    impact_power: Estimate
    worn_volume: Estimate
    support_worn_volume: Estimate
    depth_deepest: Estimate
    depth_one_scar: Estimate
    depth_all_round: Estimate

    def __missing__(self, name: str) -> Estimate:
        raise KeyError(f"no measure {name}; there are {', '.join(self)}")

    if not TYPE_CHECKING:

        def __getattr__(self, name: str) -> Estimate:
            if name in self:
                return self[name]
            raise AttributeError(f"no measure {name}; there are {', '.join(self)}")

    def __setattr__(self, name: str, value: Any) -> None:
        self._refuse()

    def __dir__(self) -> list[str]:
        return [*super().__dir__(), *self]


@dataclass(frozen=True, eq=False)
class SupportStatistics:
    """What one support did over the window of the statistics.

    ``work_rate`` is the work of wear ∫ F_n |v_t| dt per time, W, an upper figure where
    ``upper_figure`` is True (without friction); ``impact_share`` the share of it that impacts did.
    ``force_mean`` and ``force_rms`` are of the normal force and of the force vector, N,
    ``force_largest`` the largest normal force, N, around the time ``force_largest_at``, s: of an
    elastic support at an instant, of a rigid one the largest mean over a stretch of
    ``force_averaging``; ``peak_force`` is that of one wall of it at an instant, N,
    None where an impact on a rigid support has no finite one. ``sliding_rate`` is the
    distance slid in contact per time, m/s, ``sliding_speed`` the mean speed while in contact, m/s,
    ``friction_power`` what friction takes out of the motion, W, and ``contact_time_ratio`` the share
    of the time in all steps in which it pushes (a wall's is that of its contacts, up to half a step
    less at both ends of each). ``sectors`` is an array with the fields ``from_deg``, ``to_deg``,
    ``work_rate`` (W) and ``impulse_share``. None stands where there is no value.
    """

    name: str
    contacts: int
    friction: float
    upper_figure: bool
    work_rate: Estimate
    impact_share: float | None
    force_mean: Estimate | None
    force_rms: Estimate | None
    force_largest: float | None
    force_largest_at: float | None
    peak_force: float | None
    sliding_rate: float
    sliding_speed: float | None
    friction_power: float
    contact_time_ratio: float
    sectors: npt.NDArray[np.void] = field(repr=False)


@dataclass(frozen=True)
class Wear(Generic[V]):
    """The wear in service at one support, by Archard's law; None where there is no value.

    Its values are numbers for a run, ``Wear[float]``, and means over realisations for a study,
    ``Wear[Estimate]``. Volumes are in m³: ``volume`` worn off the tube, ``support_volume`` off the
    support. Depths on the tube are in m, as the measures of sweeps of these names:
    ``depth_deepest`` where it is deepest, in a sector or at a flat, ``depth_one_scar`` if all of it
    comes off one scar, ``depth_all_round`` if it comes off evenly all round. Of one run under
    random loads the deepest is an upper figure: a sector counts that is the deepest by chance; that
    of `realisations` is the largest of the means of all sectors.
    """

    name: str
    volume: V | None
    support_volume: V | None
    depth_deepest: V | None
    depth_one_scar: V | None
    depth_all_round: V | None


def _statistics(known: dict[str, Any]) -> SupportStatistics:
    def estimate(of: dict[str, Any], name: str, unit: str) -> Estimate:
        half_width = of[f"{name}_half_width_95_{unit}"]
        kind: Literal["batches", "periodic"] = "periodic" if known["periodic"] else "batches"
        return Estimate(of[f"{name}_{unit}"], half_width, None if half_width is None else kind)

    wear, contact = known["wear"], known["contact"]
    force = contact["force"]
    largest = contact["force_largest"]
    fields = [("from_deg", "f8"), ("to_deg", "f8"), ("work_rate", "f8"), ("impulse_share", "f8")]
    keys = ("from_deg", "to_deg", "work_rate_w", "impulse_share")
    sectors = np.array([tuple(sector[key] for key in keys) for sector in wear["sectors"]], fields)
    sectors.flags.writeable = False
    return SupportStatistics(
        name=wear["support"],
        contacts=contact["contacts"],
        friction=wear["friction"],
        upper_figure=wear["upper_figure"],
        work_rate=estimate(wear, "work_rate", "w"),
        impact_share=wear["impact_share"],
        force_mean=force and estimate(force, "mean", "n"),
        force_rms=force and estimate(force, "rms", "n"),
        force_largest=largest and largest["mean_n"],
        force_largest_at=largest and largest["at_s"],
        peak_force=contact["episode_peak_force_n"]["max"],
        sliding_rate=wear["sliding_m"] / known["window_s"],
        sliding_speed=wear["sliding_speed_m_per_s"],
        friction_power=wear["friction_power_w"],
        contact_time_ratio=wear["contact_time_ratio"],
        sectors=sectors,
    )


def supports(run: Run) -> Mapping[str, SupportStatistics]:
    """The statistics of each support, as `Run.supports` says."""
    known = run._supports()
    return ReadOnly({one["wear"]["support"]: _statistics(one) for one in known})


def wear(run: Run) -> Mapping[str, Wear[float]]:
    """The wear in service at each support, as `Run.wear` says."""
    worn = {one["wear"]["support"]: one["worn"] for one in run._supports() if one["worn"] is not None}
    names = ("volume_m3", "support_volume_m3", "depth_deepest_m", "depth_one_scar_m", "depth_all_round_m")
    return ReadOnly({name: Wear(name, *(known[key] for key in names)) for name, known in worn.items()})
