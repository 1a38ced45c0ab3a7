"""Notes that limit the use of results: every study warns of them, once."""

import copy
import pickle
import re
import warnings
from collections.abc import Callable
from typing import Any

import numpy as np
import pandas as pd
import pytest

import signorini as sg

COARSE = sg.load("rigid-walls-sine", set={"time.end": 1.0, "time.step": 0.05})
RESTITUTION = {"wall.*.restitution": [0.5, 0.8]}
TURBULENT = {"time.end": 0.02, "time.statistics_from": 0.01, "time.step": 5e-3, "system.modes": 6}

STUDIES: list[tuple[Callable[[], object], str]] = [
    (lambda: sg.sweep(COARSE, RESTITUTION, "moreau-jean", measures=["contacts"]), "2 of 2 runs .* load 1"),
    (lambda: sg.sweep(COARSE, RESTITUTION, "implicit-euler", measures=["contacts"]), "2 of 2 runs .* realises e = 0"),
    (lambda: sg.sweep(COARSE, RESTITUTION, "newmark", measures=["contacts"]), "2 of 2 runs .* for demonstration"),
    (
        lambda: sg.one_at_a_time(COARSE, {"load.1.harmonic.amplitude": (2.0, 4.0)}, "moreau-jean", measures=["contacts"]),
        "3 of 3 runs .* load 1",
    ),
    (lambda: sg.compare(COARSE.scene, ["moreau-jean"], step=0.05), "1 of 2 runs .* load 1"),
    (
        lambda: sg.bifurcation(
            COARSE, "load.1.harmonic.frequency", [4.8, 5.0], scheme="moreau-jean", settle=4, keep=2, follow="up"
        ),
        "2 of 2 runs .* load 1",
    ),
    (
        lambda: sg.wear(sg.load("tube-in-cross-flow", set=TURBULENT), years=1e-6, histories=2),
        "do not resolve",
    ),
]


@pytest.mark.parametrize("study, message", STUDIES)
def test_a_study_warns_of_what_limits_its_results(study: Callable[[], object], message: str) -> None:
    with warnings.catch_warnings(record=True) as raised:
        warnings.simplefilter("always")
        study()
    own = [str(one.message) for one in raised if one.category is sg.ResultWarning]
    assert any(re.search(message, text) for text in own), own
    # Many runs warn once, with their number.
    assert len(own) == 1 or "runs" not in message


def test_a_sound_study_does_not_warn() -> None:
    case = sg.load("rigid-walls-sine", set={"time.end": 0.5, "time.step": 1e-3})
    assert len(sg.sweep(case, RESTITUTION, "moreau-jean", measures=["contacts"])["row"]) == 2


def test_a_run_of_a_case_has_the_notes_of_the_case() -> None:
    case = sg.load("tube-round-supports", set={"time.end": 0.01, "time.statistics_from": 0.0, "system.modes": 4})
    run = case.run()
    assert case.notes and set(case.notes) <= set(run.notes) and set(case.notes) <= set(run.summary["notes"])
    study = sg.wear(sg.load("tube-in-cross-flow", set={**TURBULENT, "time.step": 1e-4}), years=1e-6, histories=2)
    assert set(sg.load("tube-in-cross-flow", set=TURBULENT).notes) <= set(study.remarks)


def test_output_times_beyond_the_end_are_noted(scene: sg.Scene) -> None:
    run = scene.replace(duration=0.1, output_times=[0.05, 0.2, 0.3]).run("moreau-jean", step=1e-3)
    assert len(run.output["time_s"]) == 1
    assert "2 of 3 output times lie after the end, 0.1 s: they are left out" in run.notes


def tables() -> list[Any]:
    """A table of each kind that cannot be changed."""
    case = sg.load("rigid-walls-sine", set={"time.end": 0.2})
    swept = sg.sweep(case, RESTITUTION, measures=["contacts"])
    tube = sg.load("tube-round-supports", set={"time.end": 0.02, "time.statistics_from": 0.01, "system.modes": 4})
    study = sg.realisations(tube, seeds=2, verdict=False)
    run = tube.run()
    return [swept, swept.columns, study.table, study.supports, run.supports, run.wear]


def test_tables_are_frames_and_can_be_copied_and_pickled() -> None:
    swept, columns, table, *others = tables()
    for one in (swept, columns, table):
        frame = pd.DataFrame(one)
        assert list(frame.columns) == list(one) and len(frame) == len(next(iter(one.values())))
    for one in (swept, columns, table, *others):
        for again in (pickle.loads(pickle.dumps(one)), copy.deepcopy(one), copy.copy(one)):
            assert type(again) is type(one) and list(again) == list(one)
        with pytest.raises(TypeError, match="cannot be changed"):
            one["other"] = 0
        with pytest.raises(TypeError, match="cannot be changed"):
            one.update(other=0)
    again = pickle.loads(pickle.dumps(swept))
    np.testing.assert_array_equal(again["contacts_upper"], swept["contacts_upper"])
    assert again.design == "grid" and again.keys_varied == swept.keys_varied
