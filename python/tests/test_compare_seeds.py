"""Methods over the same realisations: the files of the tool, and differences between equal seeds."""

import csv
import math
from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from scipy.stats import t as student

import signorini as sg

METHODS = ["moreau-jean", "penalty:stiffness=1e6"]


def before_a_stop(**time: float) -> sg.Case:
    """1 kg before a rigid stop, 2 mm from it, under a random force."""
    return sg.case({
        "system": {"oscillator": {"mass": 1.0, "damping": 2.0, "stiffness": 400.0}},
        "wall": [{"name": "stop", "side": "upper", "position": 2e-3, "restitution": 0.5}],
        "load": [{"random": {"rms": 3.0, "from": 1.0, "to": 20.0, "seed": 7}}],
        "penalty": {"stiffness": [1e6]},
        "time": {"end": 2.0, "step": 1e-3, "sample": 1e-3, **time},
    })  # fmt: skip


@pytest.fixture(scope="module")
def compared() -> sg.Comparison:
    with pytest.warns(sg.ResultWarning, match="runs have notes"):
        return sg.compare(before_a_stop(), METHODS, seeds=4)


def of(compared: sg.Comparison) -> sg.MethodRealisations:
    assert compared.realisations is not None
    return compared.realisations


def rows(path: Path) -> list[dict[str, str]]:
    with path.open(encoding="utf-8", newline="") as file:
        return list(csv.DictReader(file))


def assert_same(column: Any, cells: list[str]) -> None:
    """Every cell of a file is the value of the column: the text reads back as the same number."""
    for value, cell in zip(column, cells, strict=True):
        if value is None or isinstance(value, str):
            assert (value or "") == cell
        else:
            assert float(value) == float(cell) if cell else math.isnan(value)


def test_files_of_the_tool_have_the_same_numbers(
    compared: sg.Comparison, tool: Callable[..., Path], tmp_path: Path
) -> None:
    file = tmp_path / "stop.toml"
    file.write_text(before_a_stop().text, encoding="utf-8")
    folder = tool("compare", str(file), "--schemes", ",".join(METHODS), "--seeds", "4")
    found = of(compared)
    means = rows(folder / "compare-realisations.csv")
    assert list(found.table) == list(means[0]) and list(found.to_pandas()) == list(means[0])
    for name, column in found.table.items():
        assert_same(column, [row[name] for row in means])
    single, errors = rows(folder / "realisations.csv"), rows(folder / "errors.csv")
    for method, study in found.studies.items():
        own = [row for row in single if row["method"] == method]
        for name, column in study.table.items():
            assert_same(column, [row[name] for row in own])
        judged = study.to_pandas()
        judged = judged[judged["error"].notna()]
        for name in set(errors[0]) - {"method"}:
            assert_same(judged[name], [row[name] for row in errors if row["method"] == method])
    for row in means:
        measure = row["measure"]
        mine = found.studies[row["method"]].walls[row["place"]][measure]
        assert (mine.value, mine.half_width) == (float(row["mean"]), float(row["half_width_95"]))
        if row["less"]:
            assert row["less"] == found.reference == "event"
            less = found.differences[row["method"]].walls[row["place"]][measure]
            assert (less.value, less.kind) == (float(row["difference"]), "seeds")
            assert less.half_width == float(row["difference_half_width_95"])
        else:
            assert row["method"] not in found.differences


def test_differences_are_between_runs_with_the_same_seeds(compared: sg.Comparison) -> None:
    found = of(compared)
    assert found.count == 4 and list(found.studies) == [*METHODS, "event"]
    forces = {method: study.table["force_mean_N"] for method, study in found.studies.items()}
    alone = sg.realisations(before_a_stop(), "moreau-jean", seeds=4, verdict=False)
    assert (alone.table["force_mean_N"] == forces["moreau-jean"]).all()
    for method in METHODS:
        pairs = forces[method] - forces["event"]
        less = found.differences[method].walls["stop"]["force_mean"]
        # Sums of four numbers, and a quantile that the library computes by itself.
        assert less.value == pytest.approx(pairs.mean(), rel=1e-14)
        half = student.ppf(0.975, 3) * pairs.std(ddof=1) / 2.0
        assert less.half_width == pytest.approx(half, rel=1e-6)
        # Pairs scatter less than the means of independent draws.
        mean = found.studies[method].walls["stop"]["force_mean"]
        assert less.half_width is not None and mean.half_width is not None and less.half_width < mean.half_width
    assert "less event" in str(found) and "over 4 realisations" in repr(compared)
    assert repr(found) == "<MethodRealisations: 4 by moreau-jean, penalty:stiffness=1e6, event>"


def test_times_that_are_given_are_those_of_all_realisations() -> None:
    case = before_a_stop()
    made = sg.compare(case, ["moreau-jean"], step=5e-4, statistics_from=1.0, seeds=2, verdict=False)
    same = sg.compare(before_a_stop(step=5e-4, statistics_from=1.0), ["moreau-jean"], seeds=2, verdict=False)
    for name, column in of(made).table.items():
        np.testing.assert_array_equal(column, of(same).table[name])
    assert of(made).studies["moreau-jean"].walls["stop"]["force_mean"].error is None


def test_one_realisation_has_intervals_of_its_batches_and_differences_without() -> None:
    found = of(sg.compare(before_a_stop(), ["moreau-jean"], seeds=1))
    assert found.studies["moreau-jean"].walls["stop"]["force_mean"].kind in ("batches", None)
    less = found.differences["moreau-jean"].walls["stop"]["force_mean"]
    assert less.half_width is None and less.kind is None


def test_without_seeds_there_are_none(scene: sg.Scene) -> None:
    made = sg.compare(scene, ["moreau-jean"], step=1e-3)
    assert made.realisations is None and "±" not in repr(made)


def test_what_has_no_seeds_is_refused(scene: sg.Scene) -> None:
    with pytest.raises(ValueError, match="seeds is 3; expected a case with a random load"):
        sg.compare(sg.load("rigid-walls-sine"), ["moreau-jean"], seeds=3)
    with pytest.raises(ValueError, match="seeds is 0; expected 1 or more"):
        sg.compare(before_a_stop(), ["moreau-jean"], seeds=0)
    with pytest.raises(ValueError, match="seeds is -1; expected 1 or more"):
        sg.compare(before_a_stop(), ["moreau-jean"], seeds=-1)
    with pytest.raises(TypeError, match="in compare with seeds; expected a Case"):
        sg.compare(scene, ["moreau-jean"], step=1e-3, seeds=3)


def test_a_method_with_refuted_realisations_is_told(
    shaken: sg.Case, tool: Callable[..., Path], tmp_path: Path
) -> None:
    central = "penalty:stiffness=1e5,integrator=central-difference"
    with pytest.warns(sg.ResultWarning) as told:
        found = of(sg.compare(shaken, [central], seeds=2, verdict=False))
    texts = [str(warning.message) for warning in told]
    refuted = [text for text in texts if "realisations are refuted: its means are wrong" in text]
    assert refuted and refuted[0].startswith(central)
    count = int(refuted[0].split(": ")[1].split()[0]) if ": " in refuted[0] else 0
    own = found.table["method"] == central
    assert (found.table["refuted"][own] == count).all() and count > 0
