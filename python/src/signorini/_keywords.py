"""Keywords of the functions that make scenes, cases and their parts."""

from __future__ import annotations

import difflib
import functools
import inspect
from collections.abc import Callable
from typing import ParamSpec, TypeVar

P = ParamSpec("P")
R = TypeVar("R")


def keywords(options: type | None = None) -> Callable[[Callable[P, R]], Callable[P, R]]:
    """Names the function in the refusal of a keyword that it does not have, and the one that was meant.

    ``options`` is the TypedDict of its further keywords, of a function that makes a scene in one
    plane.
    """

    def decorate(function: Callable[P, R]) -> Callable[P, R]:
        parameters = inspect.signature(function).parameters.values()
        own = [one.name for one in parameters if one.kind is not inspect.Parameter.VAR_KEYWORD]
        known = [*own, *(options.__annotations__ if options is not None else ())]

        @functools.wraps(function)
        def checked(*args: P.args, **kwargs: P.kwargs) -> R:
            for name in kwargs:
                if name == "planes" and options is not None:
                    expected = "sg.tube, or sg.case of the tables of a case file, for a structure in two planes"
                    raise TypeError(f"{function.__name__} has no argument planes; expected {expected}")
                if name not in known:
                    near = difflib.get_close_matches(name, known, 1)
                    meant = f"; did you mean {near[0]}?" if near else ""
                    raise TypeError(f"{function.__name__} has no argument {name}{meant}; expected {', '.join(known)}")
            return function(*args, **kwargs)

        return checked

    return decorate
