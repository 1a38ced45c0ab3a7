"""Studies of several runs."""

from collections.abc import Callable
from typing import Any

import matplotlib.pyplot as plt
import numpy as np
import pytest

import signorini as sg


def test_compare_takes_errors_against_the_exact_motion(scene: sg.Scene) -> None:
    with pytest.warns(sg.ResultWarning, match="1 of 3 runs have notes .*: a penalty spring without damping"):
        made = sg.compare(scene, ["moreau-jean", "penalty:epsilon=1e-9"], step=1e-3, sample=0.01)
    assert list(made.table["method"]) == ["moreau-jean", "penalty:epsilon=1e-9", "event"]
    stepped, _, exact = made.runs
    assert stepped is not None and exact is not None
    within = stepped.time <= made.horizon
    error = abs(stepped.displacement - exact.displacement)[within].max() / scene.gap_scale
    assert made.table["error"][0] == pytest.approx(error, rel=1e-12)
    # What the scheme realised is what the walls ask for, to rounding of its momentum balance.
    assert made.table["restitution"][0] == pytest.approx(0.8, rel=1e-9)
    assert any("do not converge to one another" in text for text in made.findings)
    assert "moreau-jean" in repr(made)


def test_a_method_that_fails_is_a_row(scene: sg.Scene) -> None:
    one = scene.replace(walls=[sg.Wall.upper("upper", 5e-3, restitution=0.8)])
    with pytest.warns(RuntimeWarning, match="1 of 3 methods failed; the first: .* nothing facing the wall"):
        made = sg.compare(one, ["penalty:epsilon=1e-9", "moreau-jean"], step=1e-3)
    assert made.runs[0] is None and "nothing facing the wall" in made.table["failure"][0]
    assert made.table["failure"][1] is None and np.isnan(made.table["error"][0])


def test_chart_finds_the_cheapest(scene: sg.Scene) -> None:
    made = sg.chart(scene.replace(duration=1.0), ["event", "moreau-jean", "paoli-schatzman"], levels=4, repeats=1)
    assert made.cheapest(1e-12) is not None and made.cheapest(1e-300) is None
    own = made.table["method"] == "moreau-jean"
    step, error = made.table["step_s"][own], made.table["displacement_error"][own]
    # Of order 1 through impacts: the error falls with the step, and by no more than the square.
    slope = np.log(error[0] / error[-1]) / np.log(step[0] / step[-1])
    assert 0.5 < slope < 2.0
    assert np.isnan(made.table["step_s"][made.table["method"] == "event"]).all()
    made.plot("impulse").figure.canvas.draw()
    plt.close("all")


def test_stability_tells_newmark_from_moreau_jean(scene: sg.Scene) -> None:
    made = sg.stability(scene, finest=3e-3, per_decade=2, contacts=20)
    classes = {
        name: {c for c, s in zip(made.table["class"], made.table["scheme"], strict=True) if s.startswith(name)}
        for name in ("moreau-jean", "newmark")
    }
    assert "stable" in classes["moreau-jean"]
    # Newmark realises a restitution by chance, up to 3: it gains energy at some steps.
    assert classes["newmark"] & {"energy-gaining", "diverged"}
    assert list(made.stable) == ["scheme", "parameter", "value", "stable_step_s", "beyond"]
    made.plot().figure.canvas.draw()
    plt.close("all")


def test_bifurcation_settles_to_the_closed_orbit() -> None:
    case = sg.load("rigid-walls-sine", set={"wall.*.restitution": 0.8})
    made = sg.bifurcation(case, "load.1.harmonic.frequency", np.array([5.0, 5.1]), settle=300, keep=10)
    table = made.table
    assert set(table["direction"]) == {"up", "down"}
    up = (table["value"] == 5.0) & (table["direction"] == "up")
    # The settled orbit at 5 Hz, from 50-digit arithmetic: one impact a period at each wall.
    assert up.sum() == 20
    np.testing.assert_allclose(table["approach_speed_m_per_s"][up], 0.169410591, rtol=1e-8)
    options = {"settle": 300, "keep": 4, "samples": "periods", "follow": "no"}
    section = sg.bifurcation(case, "load.1.harmonic.frequency", [5.0], **options)  # type: ignore[arg-type]
    # A Poincaré section of a motion of one period is one point; it has settled to rounding.
    assert np.ptp(section.table["displacement_m"]) < 1e-12
    made.plot().figure.canvas.draw()
    section.plot().figure.canvas.draw()
    plt.close("all")


def test_studies_fail_as_runs_do() -> None:
    ball = sg.oscillator(1.0, 0.0, 0.0)
    with pytest.raises(ValueError, match="no scheme is named"):
        sg.chart(ball, ["nonsense"])
    # Between walls of a picometre there are more events than the exact scheme follows.
    case = sg.load("rigid-walls-sine", set={"wall.upper.position": 1e-12, "wall.lower.position": 0.0})
    with pytest.warns(RuntimeWarning, match="not every value has a sound motion"):
        made = sg.bifurcation(case, "load.1.harmonic.frequency", [5.0], settle=100, keep=10)
    assert made.table["error"][0] is not None


def test_an_orbit_is_the_settled_motion() -> None:
    case = sg.load("rigid-walls-sine", set={"wall.*.restitution": 0.8})
    found = sg.orbit(case.scene)
    # From 50-digit arithmetic: one impact a period at each wall, mirror images of one another.
    assert found.symmetric and found.kinds == ["impact"]
    assert found.speeds[0] == pytest.approx(0.169410591358373, rel=1e-12)
    # Liouville: the product of the multipliers is e² at each of the two impacts times exp(−c T/m).
    product = np.prod(found.multipliers)
    assert product.real == pytest.approx(0.8**4 * np.exp(-0.2 * found.period), rel=1e-10)
    assert found.stable and abs(product.imag) < 1e-12
    # A long run of the same scene comes to the same speeds.
    run = case.scene.replace(duration=60.0).run("event", sample=60.0)
    assert run.contacts["approach_speed"][-5:] == pytest.approx(found.speeds[0], rel=1e-9)
    found.plot().figure.canvas.draw()
    plt.close("all")
    with pytest.raises(sg.RunError, match="no periodic orbit"):
        # Without losses nothing settles.
        sg.orbit(sg.load("rigid-walls-sine").scene, settle=20)
    with pytest.raises(ValueError, match="no load is a sine; expected a harmonic load"):
        sg.orbit(sg.chain([1.0, 1.0], [1.0], walls=[sg.Wall.upper("a", 1.0, at=0)]))


def test_studies_take_a_case_with_its_own_times_and_penalties() -> None:
    case = sg.load("rigid-walls-sine", set={"wall.*.restitution": 0.8, "time.end": 0.5, "time.step": 1e-3})
    made = sg.compare(case, ["moreau-jean"])
    times: dict[str, Any] = {"sample": case.sample, "statistics_from": case.statistics_from}
    of_scene = sg.compare(case.scene, ["moreau-jean"], step=1e-3, **times)
    np.testing.assert_array_equal(made.table["error"], of_scene.table["error"])
    run, other = made.runs[0], of_scene.runs[0]
    assert run is not None and other is not None and run.step == 1e-3
    np.testing.assert_array_equal(run.displacement, other.displacement)
    finer = sg.compare(case, ["moreau-jean"], step=5e-4).runs[0]
    assert finer is not None and finer.step == 5e-4
    # The penalty that its name leaves open is that of the case.
    soft = sg.load("penalty-epsilon", set={"time.end": 0.1})
    assert sg.compare(soft, ["penalty"]).table["method"][0].startswith("penalty:epsilon=")
    chart = sg.chart(case, ["event", "moreau-jean"], levels=2, repeats=1)
    assert set(chart.table["method"]) == {"event", "moreau-jean"}
    maps = sg.stability(sg.load("bouncing-ball"), finest=0.03, per_decade=2, contacts=4)
    assert len(maps.stable["scheme"]) > 0
    assert sg.orbit(case).speeds[0] == sg.orbit(case.scene).speeds[0]
    with pytest.raises(ValueError, match="step is missing; expected the step of the methods in s, or a case"):
        sg.compare(case.scene, ["moreau-jean"])
    studies: tuple[Callable[[Any], object], ...] = (sg.orbit, sg.chart, sg.stability)
    for study in studies:
        with pytest.raises(TypeError, match="3; expected a Scene or a Case"):
            study(3)


def test_studies_have_short_representations() -> None:
    case = sg.load("rigid-walls-sine", set={"wall.*.restitution": 0.8})
    assert repr(sg.orbit(case.scene)) == "<Orbit: 2 events in 0.2 s, the period of the load; stable>"
    key = "load.1.harmonic.frequency"
    made = sg.bifurcation(case, key, [5.0, 5.1], settle=20, keep=5, follow="up")
    count = len(made.table["value"])
    assert repr(made) == f"<Bifurcation: {count} samples over {key} from 5 to 5.1>"
    chart = sg.chart(case.scene.replace(duration=0.5), ["event"], repeats=1)
    assert repr(chart) == f"<Chart: {len(chart.table['method'])} points of 1 method>"
    ball = sg.stability(sg.load("bouncing-ball").scene, finest=0.03, per_decade=2, contacts=4)
    assert repr(ball).startswith("<Stability: ") and len(repr(ball)) < 60


def test_the_legend_of_a_stability_map_is_whole_beside_long_names() -> None:
    made = sg.stability(sg.load("bouncing-ball"), finest=0.03, per_decade=2, contacts=4)
    ax = made.plot()
    ax.figure.canvas.draw()
    assert max(len(text.get_text()) for text in ax.get_yticklabels()) > 30
    legend, width = ax.get_legend().get_window_extent(), ax.figure.bbox.width
    assert 0.0 <= legend.x0 and legend.x1 <= width
    # Numbers on the axis of steps stand apart.
    boxes = [text.get_window_extent() for text in ax.get_xticklabels(which="both") if text.get_text()]
    inside = sorted((box.x0, box.x1) for box in boxes if ax.bbox.x0 - 1.0 <= box.x0 <= ax.bbox.x1)
    assert len(inside) > 1 and all(a[1] < b[0] for a, b in zip(inside, inside[1:], strict=False))
    plt.close("all")


def test_axes_have_names_and_units() -> None:
    case = sg.load("rigid-walls-sine", set={"wall.*.restitution": 0.8})
    made = sg.bifurcation(case, "load.1.harmonic.frequency", [5.0], settle=20, keep=5, follow="up")
    for column, label in [
        (None, "approach speed (m/s)"),
        ("impulse_N_s", "impulse (N s)"),
        ("phase_cycles", "phase (cycles)"),
        ("time_s", "time (s)"),
    ]:
        ax = made.plot(column)
        assert (ax.get_xlabel(), ax.get_ylabel()) == ("load.1.harmonic.frequency (Hz)", label)
    plain = sg.bifurcation(case, "wall.upper.restitution", [0.7, 0.8], settle=5, keep=5)
    assert plain.plot().get_xlabel() == "wall.upper.restitution"
    with pytest.raises(ValueError, match="no column is named 'speed'; there is value, direction"):
        made.plot("speed")
    plt.close("all")


def test_an_orbit_is_the_shortest_that_repeats_itself() -> None:
    stop = sg.Wall.upper("stop", 5e-3, restitution=0.8)
    one = sg.oscillator(1.0, 0.2, 100.0, walls=[stop], loads=[sg.Load.harmonic(3.0, 4.0)])
    # The run alternates about this orbit for long; its period is three of the load.
    for made in (sg.orbit(one, settle=200), sg.orbit(one)):
        assert made.period == pytest.approx(0.75, rel=1e-12) and made.kinds == ["impact"] * 2
