"""The source scene against values from 50-digit arithmetic, computed by another program."""

import numpy as np
import pytest

import signorini as sg

# Displacement (m) and velocity (m/s) at times (s).
States = dict[float, tuple[float, float]]
RIGID: States = {
    1.0: (-0.0042732657481526961976, 0.15822641285911645162),
    2.0: (0.0048198444012089150177, 0.16924331196471478964),
}
DISSIPATIVE: States = {
    1.0: (-0.00066964695799148853561, 0.063944158912728478044),
    2.0: (-0.00089661027147989510095, 0.066645045501405070971),
    5.0: (-0.00091912285840366647826, 0.067430940134800498306),
    10.0: (-0.00091912358267830562076, 0.067432135430038047142),
}
ELASTIC: States = {1.0: (0.0088898373915063881284, -0.23469784103887320102)}
IMPULSE: States = {
    1.0: (0.0036602721982939401598, -0.075227196627182892087),
    2.0: (-0.0032068476403969225853, 0.062956750229846163573),
    5.0: (-0.0045301503780682094834, -0.013213654331731555954),
    10.0: (-0.0024301032590958490829, -0.015025484938159972009),
}


def source(e: float, **scene: object) -> sg.Scene:
    walls = [sg.Wall.upper("upper", 5e-3, restitution=e), sg.Wall.lower("lower", -5e-3, restitution=e)]
    options = {"walls": walls, "loads": [sg.Load.harmonic(3.0, 5.0)], "duration": 10.0} | scene
    return sg.oscillator(1.0, 0.2, 100.0, **options)  # type: ignore[arg-type]


ELASTIC_WALLS = [sg.Wall.upper("upper", 5e-3, stiffness=100.0), sg.Wall.lower("lower", -5e-3)]


@pytest.mark.parametrize(
    "made, states, tolerance",
    [
        # At e = 1 a rounding error grows some 1e6-fold in 2 s; elsewhere it does not.
        (source(1.0), RIGID, 1e-13),
        (source(0.8), DISSIPATIVE, 1e-15),
        (source(1.0, walls=ELASTIC_WALLS), ELASTIC, 1e-14),
        (source(1.0, loads=[], velocity=0.1), IMPULSE, 1e-14),
    ],
    ids=["rigid", "dissipative", "elastic", "impulse"],
)
def test_states(made: sg.Scene, states: States, tolerance: float) -> None:
    run = made.run("event", sample=0.5)
    for time, (displacement, velocity) in states.items():
        row = int(np.flatnonzero(run.time == time)[0])
        assert run.displacement[row] == pytest.approx(displacement, rel=0, abs=tolerance)
        # A speed is some 30 times a displacement here.
        assert run.velocity[row] == pytest.approx(velocity, rel=0, abs=30 * tolerance)


def test_impacts_and_impulses() -> None:
    run = source(0.8).run("event")
    assert len(run.contacts) == 100
    upper, lower = run.contacts[:2]
    assert (upper["wall"], lower["wall"]) == ("upper", "lower")
    assert upper["start"] == pytest.approx(0.076102054389197125067, rel=1e-14)
    assert upper["approach_speed"] == pytest.approx(0.1536722548376708542, rel=1e-14)
    assert lower["start"] == pytest.approx(0.15167781503477387843, rel=1e-14)
    assert lower["departure_speed"] == pytest.approx(0.15990737964359293151, rel=1e-14)
    # A hundred impulses summed.
    assert -run.impulse("upper") == pytest.approx(15.22826967181515605, rel=1e-13)
    assert run.impulse("lower") == pytest.approx(15.304799995988605325, rel=1e-13)


def test_a_stepping_scheme_comes_near_as_its_order_says() -> None:
    # moreau-jean is of order 1 through impacts; 0.08 % of the gap at 1e-4 s and e = 0.8.
    run = source(0.8).run("moreau-jean", step=1e-4, sample=1.0)
    assert abs(run.displacement[1] - DISSIPATIVE[1.0][0]) < 2e-3 * 5e-3
