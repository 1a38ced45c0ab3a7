"""Every public function has an example, and every example is right."""

import doctest
import inspect
from collections.abc import Iterator
from typing import Any

import matplotlib.pyplot as plt
import numpy as np
import pytest

import signorini as sg


def public() -> Iterator[tuple[str, Any, bool]]:
    """Names, objects, and whether an example is due: functions, and methods of classes."""
    for name in sg.__all__:
        thing = getattr(sg, name)
        if inspect.isclass(thing):
            yield name, thing, False
            for part in vars(thing):
                member = getattr(thing, part)
                if not part.startswith("_") and callable(member) and not issubclass(thing, dict):
                    yield f"{name}.{part}", member, True
        elif inspect.isroutine(thing):
            yield name, thing, True


@pytest.mark.parametrize("name, thing, due", list(public()), ids=[name for name, _, _ in public()])
def test_example(name: str, thing: Any, due: bool) -> None:
    text = inspect.getdoc(thing)
    assert text, f"{name} has no docstring"
    examples = doctest.DocTestParser().get_doctest(text, {}, name, None, None)
    assert examples.examples or not due, f"{name} has no example"
    with np.printoptions(legacy=False):
        result = doctest.DocTestRunner(verbose=False).run(examples)
    plt.close("all")
    assert result.failed == 0


def test_the_example_of_the_package() -> None:
    examples = doctest.DocTestParser().get_doctest(sg.__doc__ or "", {}, "signorini", None, None)
    assert examples.examples
    assert doctest.DocTestRunner(verbose=False).run(examples).failed == 0
