"""Branches of periodic orbits, orbits of structures, and the pages of folders."""

import json
import pickle
import re
from collections.abc import Callable
from pathlib import Path
from typing import Any

import matplotlib.pyplot as plt
import numpy as np
import pandas as pd
import pytest

import signorini as sg

FREQUENCY = "load.1.harmonic.frequency"
AMPLITUDE = "load.1.harmonic.amplitude"
RESTITUTION = {"wall.*.restitution": 0.8}
RANGE = (4.4, 5.0)


def oscillator() -> sg.Case:
    return sg.load("rigid-walls-sine", set=RESTITUTION)


@pytest.fixture(scope="module")
def followed(tmp_path_factory: pytest.TempPathFactory) -> tuple[sg.Branches, Path]:
    folder = tmp_path_factory.mktemp("branches") / "continue"
    return sg.branches(oscillator(), FREQUENCY, RANGE, folder=folder), folder


def test_branches_are_the_files_of_the_tool(followed: tuple[sg.Branches, Path], tool: Callable[..., Path]) -> None:
    found, folder = followed
    settings = ("--set", "wall.*.restitution=0.8", "--key", FREQUENCY, "--range", "4.4:5")
    written = tool("continue", "rigid-walls-sine", *settings)
    for name in ("branches.csv", "special.csv", "branches.json"):
        assert (folder / name).read_bytes() == (written / name).read_bytes(), name
    table = pd.read_csv(written / "branches.csv")
    for name in ("frequency_Hz", "period_s", "multiplier_1_re", "speed_1_m_per_s"):
        np.testing.assert_array_equal(found[name], table[name], name)


def test_a_branch_has_its_orbits_ends_and_special_points(followed: tuple[sg.Branches, Path]) -> None:
    found, _ = followed
    # The symmetric orbit loses its symmetry at 4.57083913378074 Hz, from 50-digit arithmetic.
    assert list(found.special["label"]) == ["symmetry-breaking"] and list(found.special["leads_to"]) == ["2"]
    assert found.special["frequency_Hz"][0] == pytest.approx(4.57083913378074, rel=1e-12)
    assert list(found.ends["begins"]) == ["end of the range", "special point"]
    assert list(found.ends["ends"]) == ["end of the range"] * 2
    assert found.ends["branch"].dtype == np.int64 and list(found.ends["switches"]) == [0, 1]
    assert found.events == ((("impact", "lower"),), (("impact", "lower"), ("impact", "upper")))
    # Stable where both multipliers are within the unit circle; all of these bodies can follow.
    own = np.array([label is None for label in found["label"]])
    inside = np.abs(found.multipliers).max(axis=1) < 1.0
    np.testing.assert_array_equal(found["stable"][own], inside[own])
    assert found["admissible"].all() and found["stable"].dtype == bool
    # Liouville: e² at each of two impacts, times exp(−c T/m).
    product = found.multipliers.prod(axis=1)
    np.testing.assert_allclose(product, 0.8**4 * np.exp(-0.2 * found["period_s"]), rtol=1e-9)
    # The orbit that a run settles on is one of them.
    orbit = sg.orbit(sg.load("rigid-walls-sine", set={**RESTITUTION, FREQUENCY: 5.0}))
    last = int(np.flatnonzero(found["branch"] == 1)[-1])
    assert found["frequency_Hz"][last] == 5.0
    np.testing.assert_allclose(found["speed_1_m_per_s"][last], orbit.speeds[0], rtol=1e-10)


def test_branches_are_a_mapping_drawn_copied_and_framed(followed: tuple[sg.Branches, Path]) -> None:
    found, _ = followed
    assert repr(found) == f"<Branches: {len(found['branch'])} orbits on 2 branches over {FREQUENCY}, 1 special points>"
    again = pickle.loads(pickle.dumps(found))
    assert type(again) is sg.Branches and again.events == found.events
    pd.testing.assert_frame_equal(found.to_pandas(), again.to_pandas())
    assert found.to_pandas("special").shape[0] == 1 and found.to_pandas("ends").shape[0] == 2
    ax = found.plot()
    assert (ax.get_xlabel(), ax.get_ylabel()) == (f"{FREQUENCY} (Hz)", "approach speed (m/s)")
    # The unstable half of the first branch is dashed; of the second both impacts are drawn.
    assert [line.get_linestyle() for line in ax.lines[:-1]] == ["--", "-", "-", "-"]
    ax.figure.canvas.draw()
    plt.close("all")
    with pytest.raises(KeyError, match="no column speed; there are branch, "):
        found["speed"]
    with pytest.raises(ValueError, match="table is 'rows'; expected points, special, ends"):
        found.to_pandas("rows")  # type: ignore[arg-type]
    with pytest.raises(TypeError, match="this Branches cannot be changed"):
        found["branch"] = np.zeros(1)


def test_branches_of_a_structure_are_those_of_its_states(tool: Callable[..., Path], tmp_path: Path) -> None:
    folder = tmp_path / "own"
    found = sg.branches(sg.load("two-masses"), FREQUENCY, (1.9, 2.0), switch="no", folder=folder)
    assert found.multipliers.shape == (len(found["branch"]), 4)
    # Without contact C = 0.2 M: the product of all multipliers is exp(−0.2 · 2 T).
    free = found["signature"] == ""
    np.testing.assert_allclose(found.multipliers[free].prod(axis=1), np.exp(-0.4 * found["period_s"][free]), rtol=1e-9)
    assert "neimark-sacker" in found.special["label"]
    settings = ("--key", FREQUENCY, "--range", "1.9:2", "--switch", "no")
    written = tool("continue", "two-masses", *settings)
    for name in ("branches.csv", "special.csv", "branches.json"):
        assert (folder / name).read_bytes() == (written / name).read_bytes(), name


def test_an_orbit_of_a_structure_is_found_by_shooting() -> None:
    case = sg.load("two-masses", set={FREQUENCY: 1.92, "time.end": 200.0})
    found = sg.orbit(case)
    assert found.kinds == ["impact"] and found.walls == ["stop"] and found.stable and not found.symmetric
    assert found.period == pytest.approx(1 / 1.92, rel=1e-12) and found.closure < 1e-10
    # Liouville: e² of the impact times exp(−0.2 · 2 T).
    product = np.prod(found.multipliers)
    assert product.real == pytest.approx(0.7**2 * np.exp(-0.4 * found.period), rel=1e-8)
    # A long run comes to the same speed, and the orbit is closed.
    run = case.scene.run("event", sample=200.0)
    assert run.contacts["approach_speed"][-1] == pytest.approx(found.speeds[0], rel=1e-6)
    q, v = found.state
    assert q.shape == v.shape == (2,)
    assert [found.displacement[0], found.velocity[0]] == pytest.approx([q[0], v[0]], rel=1e-12)
    assert found.displacement[-1] == pytest.approx(found.displacement[0], abs=1e-10)
    assert found.time[-1] - found.time[0] == pytest.approx(found.period, rel=1e-12)
    assert repr(found).startswith("<Orbit: 1 event in 0.520833 s")
    found.plot().figure.canvas.draw()
    plt.close("all")


def test_keys_change_an_orbit_as_in_the_tool(tool: Callable[..., Path]) -> None:
    keys = ["wall.upper.restitution", "load.1.harmonic.frequency"]
    for name, values in (("rigid-walls-sine", {"wall.*.restitution": 0.8}), ("two-masses", {AMPLITUDE: 60.0})):
        asked = keys if name == "rigid-walls-sine" else [AMPLITUDE, "wall.stop.position"]
        given = [word for key, value in values.items() for word in ("--set", f"{key}={value}")]
        written = tool("orbit", name, *given, "--derivative", ",".join(asked), "--force")
        known = json.loads((written / "orbit.json").read_text(encoding="utf-8"))["derivatives"]
        case = sg.load(name, set=dict(values))
        for source in (case, case.scene):
            by = sg.orbit(source, derivative=asked).derivative
            assert by is not None and by.keys == asked and len(by.events) == len(known["events"]) == 2
            for own, event in zip(by.events, known["events"], strict=True):
                assert (own["wall"], own["kind"]) == (event["wall"], event["kind"])
                for number in event["numbers"]:
                    assert own[number["name"]] == pytest.approx(number["value"], rel=1e-12)
                    derivatives = list(own[f"{number['name']}_by"])
                    assert derivatives == pytest.approx(number["derivative"], rel=1e-8, abs=1e-12)
            assert list(by.forcing_period) == pytest.approx(known["forcing_period_s"], rel=1e-12)
            if known["multipliers"] is None:
                assert by.multipliers is None and by.multipliers_by is None
            else:
                assert by.multipliers is not None and by.multipliers_by is not None
                first = complex(*known["multipliers"][0]["value"])
                assert by.multipliers[0] == pytest.approx(first, rel=1e-12)
                of_first = [complex(*pair) for pair in known["multipliers"][0]["derivative"]]
                assert list(by.multipliers_by[0]) == pytest.approx(of_first, rel=1e-8, abs=1e-12)
        assert sg.orbit(case).derivative is None
    with pytest.raises(ValueError, match="side"):
        sg.orbit(sg.load("rigid-walls-sine"), derivative=["wall.side.restitution"])


def test_an_orbit_has_derivatives_by_the_arguments_of_a_function() -> None:
    def scene(initial: float, restitution: float) -> sg.Scene:
        # The first argument is the amplitude, whatever a table of a case is called.
        stop = sg.Wall.upper("stop", 5e-3, restitution=restitution)
        return sg.oscillator(1.0, 0.2, 100.0, walls=[stop], loads=[sg.Load.harmonic(initial, 4.0)])

    values = {"initial": 3.0, "restitution": 0.8}
    found = sg.orbit(scene, derivative=values)
    same = sg.orbit(scene(3.0, 0.8), derivative=["load.1.harmonic.amplitude", "wall.stop.restitution"])
    assert found.derivative is not None and same.derivative is not None
    assert found.derivative.keys == list(values) and found.speeds[0] == same.speeds[0]
    by, expected = found.derivative.events["speed_by"], same.derivative.events["speed_by"]
    for key, of_scene in zip(values, same.derivative.keys, strict=True):
        np.testing.assert_allclose(by[key], expected[of_scene], rtol=1e-9)
    # Keys with their values change the scene.
    changed = sg.orbit(scene(2.9, 0.8), derivative={"load.1.harmonic.amplitude": 3.0})
    assert changed.speeds[0] == found.speeds[0] and changed.derivative is not None
    with pytest.raises(ValueError, match="derivative is empty; expected one or more"):
        sg.orbit(scene)
    with pytest.raises(ValueError, match="expected a mapping of the arguments of the function"):
        sg.orbit(scene, derivative=["initial"])


def test_an_orbit_of_a_structure_is_that_of_the_tool(tool: Callable[..., Path]) -> None:
    written = tool("orbit", "two-masses", "--set", f"{FREQUENCY}=1.92")
    known = json.loads((written / "orbit.json").read_text(encoding="utf-8"))
    found = sg.orbit(sg.load("two-masses", set={FREQUENCY: 1.92}))
    assert [list(part) for part in found.state] == [known["displacement_m"], known["velocity_m_per_s"]]
    assert [[number.real, number.imag] for number in found.multipliers] == known["multipliers"]
    assert (found.time[0], found.closure) == (known["time_s"], known["closure"])


def test_a_branch_begins_at_an_orbit_of_the_tool(tool: Callable[..., Path]) -> None:
    written = tool("orbit", "rigid-walls-sine", "--set", "wall.*.restitution=0.8")
    found = sg.branches(oscillator(), FREQUENCY, RANGE, start=written / "orbit.json", switch="no")
    assert found.special["frequency_Hz"][0] == pytest.approx(4.57083913378074, rel=1e-12)


def test_a_page_is_written_beside_branches(followed: tuple[sg.Branches, Path], tmp_path: Path) -> None:
    _, folder = followed
    assert sg.report(folder) == folder / "report.html"
    page = (folder / "report.html").read_text(encoding="utf-8")
    # With the command that finds an orbit again, from the case beside it.
    assert "symmetry-breaking" in page and "signorini orbit case.toml" in page
    assert sg.load(folder / "case.toml").text == oscillator().text
    assert sg.report(folder, out=tmp_path / "page.html") == tmp_path / "page.html"
    with pytest.raises(OSError, match="holds no request.json that can be read; expected a folder of results"):
        sg.report(tmp_path)
    # Another request does not overwrite them.
    with pytest.raises(OSError, match="give another folder"):
        sg.branches(oscillator(), FREQUENCY, (4.5, 5.0), folder=folder)


WRONG: list[tuple[dict[str, Any], type[Exception], str]] = [
    ({"key": "time.step"}, ValueError, "key is time.step; expected a key on which orbits depend"),
    ({"key": "wall.upper.restituton"}, ValueError, "did you mean"),
    ({"key": "wall.*.position"}, ValueError, "expected a key with one value in the case"),
    ({"range": (6.0, 7.0)}, ValueError, "range is 6:7; expected a range with the case's value of the key, 5.0, in it"),
    ({"range": (7.0, 6.0)}, ValueError, "range is 7:6; expected two finite numbers, the first below the second"),
    ({"switch": "some"}, ValueError, 'no switch is named "some"'),
    ({"points": 1}, ValueError, "points is 1; expected 2 or more"),
    ({"depth": -1}, ValueError, "depth is -1; expected 0 or more"),
    ({"case": 3}, TypeError, "case is 3; expected a Case"),
    ({"case": oscillator().scene}, TypeError, "expected a Case"),
    ({"case": sg.load("bouncing-ball")}, ValueError, "expected"),
    ({"start": "nowhere.json"}, OSError, "nowhere.json"),
]


@pytest.mark.parametrize("changed, error, message", WRONG, ids=[message for _, _, message in WRONG])
def test_wrong_requests_are_refused_by_name(changed: dict[str, Any], error: type[Exception], message: str) -> None:
    with pytest.raises(error, match=re.escape(message)):
        sg.branches(**{"case": oscillator(), "key": FREQUENCY, "range": (4.9, 5.1), **changed})
