"""Means over realisations: those of the tool, and of runs with raised seeds."""

import copy
import csv
import json
import math
import pickle
from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np
import pandas as pd
import pytest
from scipy.stats import t as student

import signorini as sg

SHORT = {"time.end": 0.3, "time.statistics_from": 0.05, "system.modes": 6, "system.beam.elements": 12}
SET = [word for key, value in SHORT.items() for word in ("--set", f"{key}={value}")]


def tube(**more: Any) -> sg.Case:
    return sg.load("tube-round-supports", set={**SHORT, **more})


def rows(path: Path) -> list[dict[str, str]]:
    with path.open(encoding="utf-8", newline="") as file:
        return list(csv.DictReader(file))


def assert_same(column: Any, cells: list[str]) -> None:
    """Every cell of a file is the value of the column: the text reads back as the same number."""
    for value, cell in zip(column, cells, strict=True):
        if isinstance(value, str):
            assert value == cell
        else:
            assert float(value) == float(cell) if cell else math.isnan(value)


@pytest.fixture(scope="module")
def three() -> sg.Realisations:
    return sg.realisations(tube(), seeds=3)


def test_the_largest_force_is_the_mean_of_those_of_runs_with_raised_seeds(three: sg.Realisations) -> None:
    found = []
    for k in range(3):
        run = tube(**{f"load.{i}.random.seed": 1 + k for i in (1, 2)}).run()
        found.append(run.supports["plate-1"].force_largest or 0.0)
        # The table of a notebook has the same rule: of rigid walls the largest mean over a stretch.
        assert f"<td>{run._summary()['statistics']['walls'][0]['force_largest']['mean_n']:.4g}</td>" in run._repr_html_()
    # A sum of three numbers.
    assert three.supports["plate-1"]["force_largest"].value == pytest.approx(np.mean(found), rel=1e-14)


def test_numbers_are_those_of_the_tool(three: sg.Realisations, tool: Callable[..., Path]) -> None:
    folder = tool("run", "tube-round-supports", *SET, "--seeds", "3")
    table = rows(folder / "realisations.csv")
    assert list(three.table) == list(table[0])
    for name, column in three.table.items():
        assert_same(column, [row[name] for row in table])
    sectors = rows(folder / "sector-means.csv")
    assert list(three.sectors) == list(sectors[0]) and len(sectors) == 24
    for name, column in three.sectors.items():
        assert_same(column, [row[name] for row in sectors])
    frame = three.to_pandas()
    judged = frame[frame["error"].notna()]
    errors = rows(folder / "errors.csv")
    assert set(errors[0]) == set(frame.columns) - {"standard_deviation"}
    for name in set(errors[0]):
        assert_same(judged[name], [row[name] for row in errors])
    summary = json.loads((folder / "summary.json").read_text(encoding="utf-8"))["realisations"]
    for one in summary["estimates"]:
        mine = getattr(three, f"{one['kind']}s")[one["place"]][one["measure"]]
        assert (mine.value, mine.half_width, mine.deviation) == (
            one["mean"], one["half_width_95"], one["standard_deviation"],
        )  # fmt: skip
        assert (mine.error is None) == (one["error"] is None)
        if mine.error is not None:
            assert mine.error.total == one["error"]["total"]
            assert mine.error.modes is not None and mine.error.modes.half_width == one["error"]["modes"]["half_width_95"]
        assert [(told.own, told.then) for told in mine.refinements] == [
            (told["own"], told["then"]) for told in one["refinements"]
        ]
    contacts = three.supports["plate-1"]["contacts"]
    assert contacts.error is None
    assert [told.refined for told in contacts.refinements] == ["half the step", "24 modes"]
    # All three were run again, so that the mean of those is that of the study.
    assert {told.own for told in contacts.refinements} == {contacts.value}


def test_the_measures_of_a_place_are_attributes_as_well(three: sg.Realisations) -> None:
    means = three.supports["plate-1"]
    assert isinstance(means, sg.PlaceMeans) and means.work_rate is means["work_rate"]
    # Every measure of the engine is known to type checkers and editors.
    assert set(means) <= set(sg.PlaceMeans.__annotations__) and set(means) <= set(dir(means))
    with pytest.raises(AttributeError, match="no measure work; there are force_mean, .*work_rate.*worn_volume"):
        means.work  # type: ignore[attr-defined]  # noqa: B018
    with pytest.raises(KeyError, match="no measure work; there are force_mean, "):
        means["work"]
    with pytest.raises(TypeError, match="this PlaceMeans cannot be changed"):
        means.work_rate = means.force_mean
    assert not hasattr(means, "__array__") and means.get("work") is None
    for other in (pickle.loads(pickle.dumps(means)), copy.copy(means), copy.deepcopy(means)):
        assert type(other) is sg.PlaceMeans and other == means and other.work_rate == means.work_rate
    assert repr(means) == repr(dict(means))
    stop = sg.case({
        "system": {"oscillator": {"mass": 1.0, "damping": 2.0, "stiffness": 400.0}},
        "wall": [{"name": "stop", "side": "upper", "position": 2e-3, "restitution": 0.5}],
        "load": [{"random": {"rms": 3.0, "from": 1.0, "to": 20.0}}],
        "time": {"end": 2.0, "step": 1e-3},
    })  # fmt: skip
    study = sg.realisations(stop, seeds=2, verdict=False)
    assert study.walls["stop"].impact_power is study.walls["stop"]["impact_power"]
    assert set(study.walls["stop"]) <= set(sg.PlaceMeans.__annotations__) and study.wear == {}


def test_wear_is_that_of_runs_with_means_in_place_of_numbers() -> None:
    wearing: dict[str, Any] = {"wear.support_coefficient": 3e-14}
    study = sg.realisations(tube(**wearing), seeds=2, verdict=False)
    runs = [tube(**wearing, **{f"load.{i}.random.seed": 1 + k for i in (1, 2)}).run() for k in range(2)]
    assert list(study.wear) == list(runs[0].wear) == ["plate-1", "plate-2"]
    for name, worn in study.wear.items():
        assert worn.name == name and worn.volume is study.supports[name].worn_volume
        for quantity in ("volume", "support_volume", "depth_one_scar", "depth_all_round"):
            mean = getattr(worn, quantity)
            if quantity == "depth_one_scar":
                # That of the mean work: more than the mean of depths, which grow slower than the work.
                own = [run.wear[name].depth_one_scar or 0.0 for run in runs]
                assert np.mean(own) < mean.value < max(own)
                continue
            # A sum of two numbers.
            assert mean.value == pytest.approx(np.mean([getattr(run.wear[name], quantity) for run in runs]), rel=1e-14)
            assert mean.kind == "seeds"
        assert worn.depth_deepest is study.supports[name].depth_deepest
    assert pickle.loads(pickle.dumps(study)).wear == study.wear


def test_an_interval_takes_as_many_as_it_takes_the_tool(tool: Callable[..., Path]) -> None:
    study = sg.realisations(tube(), until_interval=0.9, verdict=False)
    folder = tool("run", "tube-round-supports", *SET, "--until-interval", "0.9", "--no-verdict")
    table = rows(folder / "realisations.csv")
    assert study.count == int(table[-1]["realisation"]) >= 6
    assert_same(study.table["work_rate_W"], [row["work_rate_W"] for row in table])


def test_realisations_are_runs_with_raised_seeds_and_means_have_the_intervals_of_student(
    three: sg.Realisations,
) -> None:
    for name, own in three.supports.items():
        runs = [tube(**{f"load.{i}.random.seed": 1 + k for i in (1, 2)}).run() for k in range(3)]
        values = np.array([run.supports[name].work_rate.value for run in runs])
        assert (three.table["work_rate_W"][three.table["place"] == name] == values).all()
        rate = own["work_rate"]
        assert rate.kind == "seeds" and rate.half_width is not None and rate.error is not None
        half = student.ppf(0.975, 2) * values.std(ddof=1) / np.sqrt(3)
        # Sums of three numbers, and a quantile that the library computes by itself.
        assert rate.value == pytest.approx(values.mean(), rel=1e-14)
        assert rate.half_width == pytest.approx(half, rel=1e-6)
        assert rate.error.sampling == rate.half_width
        # Archard's volume is proportional to the work rate.
        worn = own["worn_volume"]
        for found, of_rate in [(worn.value, rate.value), (worn.half_width, rate.half_width)]:
            assert found == pytest.approx(1e-14 * 3.156e8 * of_rate, rel=1e-12)
        assert own["depth_deepest"].value > own["depth_all_round"].value
        parts = [part for part in (rate.error.start, rate.error.step, rate.error.modes) if part is not None]
        halves = sum(part.half_width**2 for part in parts) + rate.half_width**2
        total = sum(abs(part.mean) for part in parts) + np.sqrt(halves)
        # Roundings of seven numbers.
        assert len(parts) == 3 and abs(rate.error.total / total - 1.0) < 1e-14


def test_without_a_verdict_there_are_no_errors_and_one_realisation_has_batches() -> None:
    one = sg.realisations(tube(), seeds=1, verdict=False)
    assert one.supports["plate-1"]["work_rate"].kind in ("batches", None)
    assert one.supports["plate-1"]["work_rate"].error is None and one.count == 1
    assert one.to_pandas()["error"].isna().all()
    assert "plate-1" in str(one) and "plate-2" in repr(one)
    assert isinstance(pd.DataFrame(dict(one.table)), pd.DataFrame)


def test_an_interval_that_is_out_of_reach_is_a_warning() -> None:
    with pytest.warns(sg.AccuracyWarning, match="an interval of ± 1.0 % was not reached: 7 of"):
        study = sg.realisations(tube(), until_interval=0.01, most_seeds=7, verdict=False)
    assert study.count == 7
    # No more than the first six, which are run in any case.
    with pytest.warns(sg.AccuracyWarning, match="an interval of ± 1.0 % was not reached: 6 of"):
        assert sg.realisations(tube(), until_interval=0.01, most_time=1e-9, verdict=False).count == 6


def test_a_refuted_realisation_is_an_error_with_the_study(shaken: sg.Case) -> None:
    with pytest.raises(sg.RefutedError, match="realisation 2: ") as caught:
        sg.realisations(shaken, "penalty:integrator=central-difference", seeds=2)
    assert isinstance(caught.value.study, sg.Realisations)


@pytest.mark.parametrize(
    ("asked", "words"),
    [
        ({}, "seeds is missing; expected"),
        ({"seeds": 0}, "seeds is 0; expected 1 or more"),
        ({"seeds": -2}, "seeds is -2; expected 1 or more"),
        ({"seeds": 2, "until_interval": 0.1}, "until_interval is 0.1; expected no interval beside"),
        ({"until_interval": 5.0}, "until_interval is 5.*above 0 and below 1"),
        ({"until_interval": 0.1, "most_seeds": 3}, "most_seeds is 3; expected 6 or more"),
        ({"seeds": 2, "most_time": 60.0}, "most_time is 60.0; expected until_interval beside it"),
        ({"accuracy": 0.1, "most_time": 60.0}, "most_time is 60.0; expected none beside accuracy"),
        ({"until_interval": 0.1, "most_time": 0.0}, "most_time is 0.0 s; expected a time above 0"),
        ({"seeds": 2, "scheme": "event"}, "event"),
        ({"seeds": 2, "step": -1.0}, "step"),
    ],
)
def test_what_makes_no_sense_is_refused(asked: dict[str, Any], words: str) -> None:
    with pytest.raises(ValueError, match=words):
        sg.realisations(tube(), **asked)


def test_what_has_no_seeds_is_refused(scene: sg.Scene, tmp_path: Path) -> None:
    with pytest.raises(ValueError, match="seeds is 3; expected a case with a random load"):
        sg.realisations(sg.load("rigid-walls-sine"), seeds=3)
    free = tmp_path / "free.toml"
    free.write_text(
        "[system.oscillator]\nmass = 1.0\ndamping = 1.0\nstiffness = 1e3\n[time]\nend = 1.0\nstep = 1e-3\n"
        "[[load]]\nrandom = { rms = 1.0, from = 1.0, to = 10.0 }\n"
    )
    with pytest.raises(ValueError, match="with a wall or a support"):
        sg.realisations(sg.load(free), seeds=3)
    with pytest.raises(TypeError, match="expected a Case"):
        sg.realisations(scene, seeds=3)  # type: ignore[arg-type]


def test_an_accuracy_of_means_has_the_step_that_was_found_or_warns_and_is_refused_by_name() -> None:
    with pytest.warns(sg.AccuracyWarning, match="an error of the step|an interval of"):
        study = sg.realisations(tube(), accuracy=0.01, most_seeds=6)
    assert study.count == 6 and study.accuracy is not None
    assert study.accuracy["judged_by"] == "realisations" and study.accuracy["sufficient_step_s"] is None
    for wrong, words in (
        ({"seeds": 3}, "seeds is 3; expected none beside accuracy"),
        ({"until_interval": 0.1}, "until_interval is 0.1; expected none beside accuracy"),
        ({"step": 1e-4}, "no step beside accuracy"),
        ({"verdict": False}, "verdict is False"),
        ({"scheme": "event"}, "scheme is event|a scheme with a step"),
    ):
        with pytest.raises(ValueError, match=words):
            sg.realisations(tube(), accuracy=0.2, **wrong)
    with pytest.raises(ValueError, match="sg.realisations"):
        tube().run(accuracy=0.2)
    mass = {"mass": 1.0, "damping": 0.0, "stiffness": 4.0}
    free = sg.case({"system": {"oscillator": mass}, "time": {"end": 1.0, "step": 1e-3}})
    with pytest.raises(ValueError, match="a case with a wall or support"):
        sg.realisations(free, accuracy=0.2)


def test_two_attractors_are_warned_of() -> None:
    """By its start the motion goes to one of two orbits, with mean forces of 1.645 and 1.76 N."""
    given = {"initial.scatter.velocity": 0.2, "wall.*.restitution": 0.8, "load.1.harmonic.frequency": 5.3}
    case = sg.load("rigid-walls-sine", set={**given, "time.end": 100.0, "time.statistics_from": 80.0})
    with pytest.warns(sg.ResultWarning, match="fall into two groups at wall .* two attractors, unless it is chance"):
        sg.realisations(case, seeds=16, verdict=False)


def test_a_chaotic_motion_has_means_and_an_accuracy_says_what_it_is_one_of() -> None:
    window = {"time.end": 30.0, "time.statistics_from": 10.0}
    chaotic = sg.load("rigid-walls-sine", set=window)
    # It settles slower than in 10 s: free vibration decays by e⁻¹ in that time. By then the motions
    # are near one of two orbits, whose mean forces are 1.54 and 1.74 N.
    unsettled, groups = [pytest.warns(sg.ResultWarning, match=words) for words in ("of 6 runs have not settled", "two groups")]
    with unsettled, groups:
        study = sg.realisations(chaotic, accuracy=0.3)
    # 5 mm in a period of 0.2 s: a ten-thousandth of it, as a power of ten.
    assert study.accuracy is not None and study.accuracy["start_scatter"] == 1e-6
    assert study.accuracy["of"] == "means" and study.accuracy["reached"] <= 0.3
    scattered = sg.load("rigid-walls-sine", set={**window, "initial.scatter.velocity": 1e-6})
    with pytest.warns(sg.ResultWarning, match="of 6 runs have not settled"), pytest.warns(sg.ResultWarning, match="two groups"):
        again = sg.realisations(scattered, accuracy=0.3)
    assert again.accuracy is not None and "start_scatter" not in again.accuracy
    assert (again.table["force_mean_N"] == study.table["force_mean_N"]).all()
    short = sg.load("rigid-walls-sine", set={"time.end": 0.5})
    assert short.run(accuracy=1e-2, of="motion").summary["accuracy"]["of"] == "motion"
    # One draw of a random load has a motion, too.
    draw = tube().run(accuracy=0.1, of="motion")
    assert draw.summary["accuracy"]["of"] == "motion"
    for asked, words in (
        ({"accuracy": 0.1, "of": "means"}, "sg.realisations"),
        ({"accuracy": 0.1, "of": "wear"}, 'of is "wear"; expected "motion"'),
        ({"of": "motion"}, "accuracy beside it"),
    ):
        with pytest.raises(ValueError, match=words):
            short.run(**asked)
