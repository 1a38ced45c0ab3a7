"""What the tests share."""

import os
import subprocess
from collections.abc import Callable
from pathlib import Path

import matplotlib
import pytest

import signorini as sg

# No window.
matplotlib.use("Agg")


@pytest.fixture
def scene() -> sg.Scene:
    """1 kg between rigid walls at ±5 mm, driven by 3 sin(2π 5 t) N."""
    return sg.oscillator(
        1.0,
        0.2,
        100.0,
        walls=[sg.Wall.upper("upper", 5e-3, restitution=0.8), sg.Wall.lower("lower", -5e-3, restitution=0.8)],
        loads=[sg.Load.harmonic(3.0, 5.0)],
        duration=2.0,
    )


@pytest.fixture
def tool(tmp_path: Path) -> Callable[..., Path]:
    """Runs the command-line tool, and gives the folder of its results, with ``page=True`` with its page.

    It is that of the environment's ``SIGNORINI_TOOL``, or what cargo has built for release.
    """
    name = os.environ.get("SIGNORINI_TOOL", Path(__file__).parents[2] / "target/release/signorini")
    if not Path(name).exists():
        pytest.skip(f"no tool at {name}: cargo build --release, or SIGNORINI_TOOL")

    def run(*arguments: str, page: bool = False) -> Path:
        without = [] if page else ["--no-report"]
        subprocess.run([name, *arguments, *without, "--out", tmp_path / "out"], check=True, capture_output=True)
        return tmp_path / "out"

    return run


@pytest.fixture
def shaken() -> sg.Case:
    """A mass that a random force shakes against a stop, with steps too long for an explicit penalty.

    That is stable at the wall up to 2/√(1e5 N/m / 1 kg), 6.3 ms.
    """
    return sg.case({
        "system": {"oscillator": {"mass": 1.0, "damping": 0.0, "stiffness": 400.0}},
        "wall": [{"name": "stop", "side": "upper", "position": 2e-3}],
        "load": [{"random": {"rms": 3.0, "from": 1.0, "to": 2.0, "seed": 1}}],
        "penalty": {"stiffness": [1e5]},
        "time": {"end": 20.0, "step": 0.02},
    })  # fmt: skip
