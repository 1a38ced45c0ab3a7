"""Every public function has an example, and every example is right."""

import ast
import dataclasses
import doctest
import inspect
import textwrap
from collections.abc import Iterator
from typing import Any, is_typeddict

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
                if not part.startswith("_") and callable(member) and not is_typeddict(thing):
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


@pytest.mark.parametrize(
    "name, thing", [(name, thing) for name, thing, _ in public() if dataclasses.is_dataclass(thing)]
)
def test_help_of_a_class_has_what_is_written_of_its_fields(name: str, thing: Any) -> None:
    text = inspect.getdoc(thing) or ""
    fields = [field.name for field in dataclasses.fields(thing) if not field.name.startswith("_")]
    listed = [line.split(" : ")[0] for line in lists_of(text, "Attributes")]
    assert listed == fields or not listed
    assert listed or name not in ("Derivative", "Fit", "Orbit", "OrbitDerivative")
    # Other classes say it in sentences. A string under a field is not shown by help().
    tree = ast.parse(textwrap.dedent(inspect.getsource(thing))).body[0]
    assert isinstance(tree, ast.ClassDef)
    strings = [node for node in tree.body if isinstance(node, ast.Expr) and isinstance(node.value, ast.Constant)]
    assert len(strings) == 1


def lists_of(text: str, section: str) -> list[str]:
    """The lines of a section of a docstring that name something."""
    lines = text.splitlines()
    heads = [i for i, line in enumerate(lines) if line == section and lines[i + 1 : i + 2] == ["-" * len(section)]]
    if not heads:
        return []
    own = lines[heads[0] + 2 :]
    ends = [i for i, line in enumerate(own) if line and set(line) == {"-"}]
    return [line for line in own[: ends[0] - 1 if ends else None] if line and not line.startswith(" ")]


@pytest.mark.parametrize(
    "name, thing", [(name, thing) for name, thing, due in public() if due or name in ("Stepper", "Rayleigh")]
)
def test_a_docstring_has_the_sections_of_numpydoc(name: str, thing: Any) -> None:
    text = inspect.getdoc(thing) or ""
    assert "-------" not in " ".join(line for line in text.splitlines() if set(line) != {"-"}), "a paragraph"
    named = [word.strip(" *") for line in lists_of(text, "Parameters") for word in line.split(" : ")[0].split(",")]
    taken = [word for word in inspect.signature(thing).parameters if word != "self"]
    assert sorted(named) == sorted(taken)
    assert lists_of(text, "Returns") or inspect.isclass(thing) or name == "Stepper.set_state"
    assert lists_of(text, "Raises") or name in ("grid", "Rayleigh", "Run.plot")
