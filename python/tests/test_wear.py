"""Wear over the years: the tables of the tool, and what it takes from its first windows."""

import csv
import math
from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np
import pytest

import signorini as sg

SHORT = {
    "time.end": 0.3, "time.statistics_from": 0.05, "system.modes": 6, "wear.coefficient": 1e-13, "wear.limit": 0.001,
}  # fmt: skip
SET = [word for key, value in SHORT.items() for word in ("--set", f"{key}={value}")]


def tube(**more: Any) -> sg.Case:
    return sg.load("tube-in-cross-flow", set={**SHORT, **more})


@pytest.fixture(scope="module")
def three() -> sg.WearStudy:
    return sg.wear(tube(), years=20, histories=3)


def assert_same(columns: Any, path: Path) -> None:
    """The columns are those of a file, number for number."""
    with path.open(encoding="utf-8", newline="") as file:
        header, *rows = csv.reader(file)
    assert list(columns) == header
    for index, column in enumerate(columns.values()):
        for value, row in zip(column, rows, strict=True):
            cell = row[index]
            if isinstance(value, str):
                assert value == cell
            else:
                assert float(value) == float(cell) if cell else math.isnan(value)


def test_years_and_histories_are_those_of_the_tool(three: sg.WearStudy, tool: Callable[..., Path]) -> None:
    folder = tool("wear", "tube-in-cross-flow", *SET, "--years", "20", "--histories", "3")
    assert_same(three.years, folder / "years.csv")
    assert_same(three.history, folder / "history.csv")
    assert_same(three.sectors, folder / "sector-means.csv")


FILES = ("history.csv", "years.csv", "wear.svg")


def test_more_years_go_on_from_a_folder_to_those_of_a_study_from_the_start(
    tool: Callable[..., Path], tmp_path: Path
) -> None:
    folder = tmp_path / "grown"
    asked: dict[str, Any] = {"histories": 2, "folder": folder}
    sg.wear(tube(), years=20, **asked)
    windows = (folder / "windows.journal").read_bytes()
    grown = sg.wear(tube(), years=60, **asked)
    # What was run stays, and what is run further is added.
    assert (folder / "windows.journal").read_bytes().startswith(windows)
    at_once = sg.wear(tube(), years=60, histories=2)
    np.testing.assert_array_equal(grown.to_pandas(), at_once.to_pandas())
    assert str(grown) == str(at_once)
    # The same call again runs nothing.
    windows = (folder / "windows.journal").read_bytes()
    np.testing.assert_array_equal(sg.wear(tube(), years=60, **asked).to_pandas(), at_once.to_pandas())
    assert (folder / "windows.journal").read_bytes() == windows
    # The tool writes the same bytes, and Python goes on from its folder.
    whole = tool("wear", "tube-in-cross-flow", *SET, "--years", "60", "--histories", "2")
    for name in (*FILES, "first-window/trajectory.csv"):
        assert (folder / name).read_bytes() == (whole / name).read_bytes()
    # The motion of the whole tube is kept for the page, which the command was not asked for.
    assert (folder / "first-window" / "shape.csv").exists()
    page = (folder / "report.html").read_text(encoding="utf-8")
    assert page.startswith("<!doctype html>") and '"runs":[{' in page.replace(" ", "")
    windows = (whole / "windows.journal").read_bytes()
    sg.wear(tube(), years=60, histories=2, folder=whole)
    assert (whole / "windows.journal").read_bytes() == windows
    others: list[tuple[dict[str, Any], str]] = [
        ({"years": 20}, "years: 60 there, 20 asked"),
        ({"years": 70, "histories": 3}, "histories: 2 there, 3 asked"),
        ({"years": 70, "histories": None, "until_interval": 0.5}, "until_interval"),
    ]
    for other, words in others:
        with pytest.raises(OSError, match=words) as refused:
            sg.wear(tube(), **{**asked, **other})
        assert "give another folder" in str(refused.value) and "--force" not in str(refused.value)
    for name in FILES:
        assert (folder / name).read_bytes() == (whole / name).read_bytes()


def test_an_interval_goes_on_from_a_folder_too(tool: Callable[..., Path], tmp_path: Path) -> None:
    asked: dict[str, Any] = {"until_interval": 0.9, "most_seeds": 20, "verdict": False, "folder": tmp_path / "w"}
    sg.wear(tube(), years=2, **asked)
    study = sg.wear(tube(), years=5, **asked)
    own = ("--until-interval", "90%", "--most-seeds", "20", "--no-verdict")
    whole = tool("wear", "tube-in-cross-flow", *SET, "--years", "5", *own)
    for name in (*FILES, "realisations.csv"):
        assert (tmp_path / "w" / name).read_bytes() == (whole / name).read_bytes()
    assert study.first is not None


def test_years_are_means_over_the_histories(three: sg.WearStudy) -> None:
    assert (three.supports, three.histories) == (("plate-1", "plate-2"), 3)
    assert three.years["year"][0] == 0.0 and three.years["year"][-1] == 20.0
    for row, (year, place) in enumerate(zip(three.years["year"], three.years["place"], strict=True)):
        own = (three.history["year"] == year) & (three.history["place"] == place)
        assert own.sum() == 3
        for name in ("gap_m", "depth_all_round_m", "work_rate_W"):
            # A sum of three numbers.
            assert three.years[name][row] == pytest.approx(three.history[name][own].mean(), rel=1e-14)
        # The deepest sector of the mean is no deeper than the deepest of each in the mean, and no
        # less deep than all sectors; nothing but rounding where the three agree.
        deepest, each = three.years["depth_deepest_m"][row], three.history["depth_deepest_m"][own].mean()
        assert three.years["depth_all_round_m"][row] * (1 - 1e-12) <= deepest <= each * (1 + 1e-12)
    assert len(three.to_pandas()) == len(three.years["year"])
    assert "plate-1" in str(three) and "evenly all round" in str(three)
    assert three.first is None


def test_the_year_of_the_limit_lies_on_the_curve_of_the_depth(three: sg.WearStudy) -> None:
    # A thousandth of the wall of the tube, 1.65 mm.
    assert three.limit == pytest.approx(1.65e-6, rel=1e-12)
    for place, limit in three.limit_years.items():
        own = three.years["place"] == place
        for found, name in [(limit.deepest, "deepest"), (limit.one_scar, "one_scar"), (limit.all_round, "all_round")]:
            depth = three.years[f"depth_{name}_m"][own]
            assert (found is None) == bool(depth[-1] < three.limit)
            if found is not None:
                # Points stand so close that the depth is straight between them to 2 % of its end.
                straight = np.interp(found, three.years["year"][own], depth)
                assert straight == pytest.approx(three.limit, rel=0.0, abs=0.021 * depth[-1])
        if all(year is not None for year in limit.one_scar_histories):
            # Student's t of two degrees of freedom.
            deviation = np.std(np.array(limit.one_scar_histories, dtype=float), ddof=1)
            assert limit.one_scar_half_width == pytest.approx(4.302652729911275 * deviation / 3**0.5, rel=1e-9)
    assert three.limit_years["plate-1"].one_scar is not None


def test_an_interval_begins_with_the_study_of_the_first_windows(tool: Callable[..., Path]) -> None:
    asked: dict[str, Any] = {"until_interval": 0.9, "most_seeds": 20}
    study = sg.wear(tube(), years=5, **asked)
    first = sg.realisations(tube(), **asked)
    assert study.first is not None and study.histories == first.count >= 6
    assert study.first.supports["plate-1"]["work_rate"] == first.supports["plate-1"]["work_rate"]
    assert first.supports["plate-1"]["work_rate"].error is not None
    folder = tool(
        "wear", "tube-in-cross-flow", *SET, "--years", "5", "--until-interval", "90%", "--most-seeds", "20"
    )  # fmt: skip
    assert_same(study.years, folder / "years.csv")
    assert_same(study.first.table, folder / "realisations.csv")


def test_curves_have_their_band_and_the_limit(three: sg.WearStudy) -> None:
    axes = three.plot()
    assert axes.get_ylabel() == "depth deepest (mm)" and len(axes.get_lines()) == 3
    own = three.years["place"] == "plate-2"
    np.testing.assert_array_equal(axes.get_lines()[1].get_ydata(), 1e3 * three.years["depth_deepest_m"][own])
    assert three.plot("work_rate").get_ylabel() == "work rate (W)"
    with pytest.raises(ValueError, match="quantity is 'depth'; expected gap, depth_deepest"):
        three.plot("depth")


def test_a_dataset_has_years_supports_and_histories_as_dimensions(three: sg.WearStudy) -> None:
    data = three.to_xarray()
    assert data["gap_m"].dims == ("year", "support")
    assert data["history_gap_m"].dims == ("year", "history", "support")
    assert data["support"].values.tolist() == ["plate-1", "plate-2"] and data["history"].values.tolist() == [1, 2, 3]
    of_tables = {*three.years, *(f"history_{name}" for name in three.history)}
    assert set(data) == {name for name in of_tables if name.split("_")[-1] not in ("year", "place", "history")}
    for name in set(three.years) - {"year", "place"}:
        for year, place, value in zip(three.years["year"], three.years["place"], three.years[name], strict=True):
            np.testing.assert_equal(float(data[name].sel(year=year, support=place)), value)
    for row in range(len(three.history["year"])):
        at = {key: three.history[column][row] for key, column in (("year", "year"), ("support", "place"))}
        for name in ("gap_m", "work_J", "shift_y_m"):
            own = data[f"history_{name}"].sel(history=three.history["history"][row], **at)
            assert float(own) == three.history[name][row]


def test_years_take_the_place_of_a_service() -> None:
    tables: dict[str, Any] = {
        "system": {"planes": 2, "oscillator": {"mass": 1.0, "damping": 6.0, "stiffness": 1000.0}},
        "support": [sg.hole("hole", 2e-4, restitution=0.5, friction=0.2, width=25e-3, radius=9.5e-3)],
        "load": [sg.Load.random(rms=3.0, band=(1.0, 40.0), seed=1, direction="both")],
        "time": {"end": 0.5, "step": 1e-4, "statistics_from": 0.1},
    }
    case = sg.case({**tables, "wear": sg.Archard(1e-12)})
    study = sg.wear(case, years=0.01, histories=2)
    served = sg.wear(sg.case({**tables, "wear": sg.Archard(1e-12, years=0.01)}), histories=2)
    for name, column in served.years.items():
        np.testing.assert_array_equal(study.years[name], column)
    assert case.run().wear == {} and sg.realisations(case, seeds=2, verdict=False).wear == {}
    with pytest.raises(ValueError, match=r"years is left out; expected a number above 0, or service = .* in \[wear\]"):
        sg.wear(case, histories=2)


@pytest.mark.parametrize(
    ("asked", "words"),
    [
        ({"histories": 0}, "histories is 0; expected 1 or more"),
        ({"years": 0.0}, "years is 0; expected a number above 0"),
        ({"years": math.inf}, "years is inf; expected a number above 0"),
        ({"histories": 4, "until_interval": 0.1}, "until_interval is 0.1; expected no interval beside"),
        ({"until_interval": 5}, "until_interval is 5.*above 0 and below 1"),
        ({"most_seeds": 9}, "most_seeds is 9; expected until_interval"),
        ({"most_time": 9.0}, "most_time is 9.0; expected until_interval"),
        ({"scheme": "event"}, "event"),
    ],
)
def test_what_makes_no_sense_is_refused(asked: dict[str, Any], words: str) -> None:
    with pytest.raises(ValueError, match=words):
        sg.wear(tube(), **asked)


def test_what_does_not_wear_is_refused(scene: sg.Scene) -> None:
    with pytest.raises(ValueError, match="expected a case with supports, and a coefficient in"):
        sg.wear(sg.load("rigid-walls-sine"))
    with pytest.raises(TypeError, match="expected a Case"):
        sg.wear(scene)  # type: ignore[arg-type]
