"""Types of arguments."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any

import numpy as np
import numpy.typing as npt

Array = npt.NDArray[np.float64]

Place = (
    int
    | float
    | str
    | tuple[float, float]
    | Sequence[tuple[int, float]]
    | Sequence[tuple[str, float]]
    | Mapping[str, Any]
    | None
)
"""A location: a degree of freedom, a position in m on a bar or beam, a stretch of it, a point
of modal data, or degrees of freedom (or points) with weights; None where there is one only. For
loads of `case` also a place of the case format, such as ``{"body": "left", "dof": 0}``."""

End = str | float | tuple[float, float]
"""The support of an end of a bar or beam: its name, or its stiffnesses."""
