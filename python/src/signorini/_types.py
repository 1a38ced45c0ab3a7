"""Types of arguments, and their checks."""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from numbers import Real
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

_MOST = 2**32 - 1


def check_whole(name: str, value: Any, least: int = 0) -> None:
    """Refuses what is no whole number; which of them are accepted is judged elsewhere."""
    if not isinstance(value, (int, np.integer)) or isinstance(value, bool):
        raise TypeError(f"{name} is {value!r}; expected a whole number, {least} or more")


def check_number(name: str, value: Any) -> None:
    """Refuses what is no number; which of them are accepted is judged elsewhere."""
    one = value[()] if isinstance(value, np.ndarray) and value.ndim == 0 else value
    if not isinstance(one, Real) or isinstance(one, bool):
        raise TypeError(f"{name} is {value!r}; expected a number")


def check_given(numbers: Mapping[str, Any], whole_numbers: Mapping[str, Any]) -> None:
    """Refuses the first of the arguments that are given, and not None, which is no such number."""
    for name, value in numbers.items():
        if value is not None:
            check_number(name, value)
    for name, value in whole_numbers.items():
        if value is not None:
            check_whole(name, value, 1)


def whole(name: str, value: Any, least: int = 0, most: int = _MOST) -> int:
    """``value``, unless it is no whole number from ``least`` to ``most``."""
    check_whole(name, value, least)
    if not least <= value:
        raise ValueError(f"{name} is {value!r}; expected {least} or more")
    if value > most:
        raise ValueError(f"{name} is {value!r}; expected at most {most}")
    return int(value)


def positive(name: str, value: Any) -> float:
    """``value``, unless it is no number above 0."""
    check_number(name, value)
    if not value > 0.0:
        raise ValueError(f"{name} is {value!r}; expected a number above 0")
    return float(value)


def sequence(name: str, values: Any, expected: str = "a sequence of values") -> list[Any]:
    """``values`` as a list, unless they are one value or one text."""
    if isinstance(values, (str, Mapping)) or not isinstance(values, Iterable):
        raise TypeError(f"{name} is {values!r}; expected {expected}")
    return list(values)


def names(name: str, values: Any, example: str) -> list[str]:
    """``values``, unless they are one text or no texts at all."""
    if isinstance(values, str) or not isinstance(values, Iterable):
        raise TypeError(f"{name} is {values!r}; expected a sequence, such as [{example!r}]")
    listed = list(values)
    if not listed:
        raise ValueError(f"{name} is empty; expected one or more, such as [{example!r}]")
    for one in listed:
        if not isinstance(one, str):
            raise TypeError(f"{name} has {one!r}; expected texts, such as {example!r}")
    return listed


def known(name: str, given: Mapping[str, Any] | None, keys: Iterable[str]) -> dict[str, Any]:
    """The mapping ``given``, unless it has other keys than ``keys``."""
    for key in given or ():
        if key not in (accepted := list(keys)):
            raise ValueError(f"{name} has {key!r}; expected {', '.join(map(repr, accepted)) or 'no key'}")
    return dict(given or {})


def check_unmasked(name: str, values: Any) -> None:
    """Refuses an array some of whose entries are masked."""
    if np.ma.is_masked(values):
        raise ValueError(f"{name} has masked entries; expected all of them")


def real_numbers(name: str, values: Any) -> Array:
    """``values`` as numbers, unless they are complex or masked."""
    check_unmasked(name, values)
    found = np.asarray(values)
    if np.iscomplexobj(found):
        raise TypeError(f"{name} has complex numbers; expected real ones")
    return np.asarray(found, np.float64)


def check_within(name: str, column: Array, end: float) -> None:
    """Refuses times, in s, before 0 or after ``end``."""
    beyond = column[(column < 0.0) | (column > end * (1.0 + 1e-12))]
    if beyond.size:
        raise ValueError(f"{name} has {beyond[0]:g} s; expected times from 0 to the end of the motion, {end:g} s")


def times(name: str, values: Any, end: float) -> Array:
    """``values`` as times, unless some are before 0 or after ``end``, or one is not after the last."""
    column = np.atleast_1d(real_numbers(name, values))
    if column.ndim != 1 or not np.isfinite(column).all():
        raise ValueError(f"{name}: expected a column of finite times, in s")
    check_within(name, column, end)
    if (np.diff(column) <= 0.0).any():
        raise ValueError(f"{name} does not increase: {column[int(np.argmin(np.diff(column))) + 1]:g} s comes too late")
    return column
