"""What the tests share."""

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
