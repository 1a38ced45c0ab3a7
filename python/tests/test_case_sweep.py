"""Sweeps of a case: the tables of the tool's engine."""

import csv
import sys
from pathlib import Path
from typing import Any

import numpy as np
import pandas as pd
import pytest
from scipy.stats import t as student

import signorini as sg

SHORT = {"time.end": 0.3, "time.statistics_from": 0.05, "system.modes": 6, "system.beam.elements": 12}
MEASURES = ["work_rate", "impact_share"]
SEEDS = 3


def tube() -> sg.Case:
    return sg.load("tube-round-supports", set=SHORT)


@pytest.fixture(scope="module")
def swept(tmp_path_factory: pytest.TempPathFactory) -> tuple[sg.SweepResult, Path]:
    folder = tmp_path_factory.mktemp("rows") / "sweep"
    keys = {"support.*.gap": [1e-4, 2e-4], "support.*.friction": [0.1, 0.2]}
    return sg.sweep(tube(), keys, measures=MEASURES, seeds=SEEDS, folder=folder), folder


def test_realisations_are_runs_with_raised_seeds(swept: tuple[sg.SweepResult, Path]) -> None:
    table, _ = swept
    row = 2  # The last key varies fastest.
    assert (table["gap_m"][row], table["friction"][row]) == (2e-4, 0.1)
    for k in range(SEEDS):
        seeds = {f"load.{i}.random.seed": 1 + k for i in (1, 2)}
        changed = {**SHORT, **seeds, "support.*.gap": 2e-4, "support.*.friction": 0.1}
        run = sg.load("tube-round-supports", set=changed).run()
        for name in ("plate-1", "plate-2"):
            column = table.realisations[f"work_rate_{name.replace('-', '_')}_W"]
            assert column[SEEDS * row + k] == run.supports[name].work_rate.value


def test_rows_are_means_with_the_intervals_of_student(swept: tuple[sg.SweepResult, Path]) -> None:
    table, _ = swept
    assert (table["seeds"] == SEEDS).all() and list(table["status"]) == ["ok"] * 4
    values = table.realisations["work_rate_plate_1_W"].reshape(4, SEEDS)
    half = student.ppf(0.975, SEEDS - 1) * values.std(axis=1, ddof=1) / np.sqrt(SEEDS)
    # Sums of three numbers, and a quantile that the library computes by itself.
    np.testing.assert_allclose(table["work_rate_plate_1_W"], values.mean(axis=1), rtol=1e-14)
    np.testing.assert_allclose(table["work_rate_half_width_95_plate_1_W"], half, rtol=1e-6)


def test_frames_are_the_tables_on_disk(swept: tuple[sg.SweepResult, Path]) -> None:
    table, folder = swept
    frame = table.to_pandas()
    for name, columns in [("sweep.csv", frame), ("realisations.csv", pd.DataFrame(dict(table.realisations)))]:
        with (folder / name).open(encoding="utf-8", newline="") as file:
            header, *rows = csv.reader(file)
        assert list(columns) == header and len(columns) == len(rows)
        for number, row in enumerate(rows):
            for word, seen in zip(row, columns.iloc[number], strict=True):
                # An empty cell is None; no measure of these rows lacks a number.
                assert seen == word if isinstance(seen, str) else seen is None if not word else float(word) == seen
    # A finished sweep is read, not run again, and is the same.
    again = sg.sweep(
        tube(),
        {"support.*.gap": [1e-4, 2e-4], "support.*.friction": [0.1, 0.2]},
        measures=MEASURES,
        seeds=SEEDS,
        folder=folder,
    )
    pd.testing.assert_frame_equal(again.to_pandas(), frame)


def test_datasets_have_the_keys_as_dimensions(swept: tuple[sg.SweepResult, Path]) -> None:
    table, _ = swept
    data = table.to_xarray()
    assert dict(data.sizes) == {"gap_m": 2, "friction": 2, "realisation": SEEDS}
    at = data.sel(gap_m=2e-4, friction=0.1)
    assert float(at["work_rate_plate_1_W"]) == table["work_rate_plate_1_W"][2]
    seen = at["realisations_work_rate_plate_1_W"].to_numpy()
    np.testing.assert_array_equal(seen, table.realisations["work_rate_plate_1_W"][2 * SEEDS : 3 * SEEDS])


def test_effects_are_differences_of_pairs() -> None:
    keys = {"support.*.gap": (1e-4, 4e-4), "support.*.friction": (0.1, 0.3)}
    table = sg.one_at_a_time(tube(), keys, measures=["work_rate"], seeds=SEEDS)
    assert len(table["row"]) == 5  # The case, then two bounds of each key.
    values = table.realisations["work_rate_plate_1_W"].reshape(5, SEEDS)
    for number, key in enumerate(keys):
        pairs = values[2 + 2 * number] - values[1 + 2 * number]
        where = (table.effects["key"] == key) & (table.effects["place"] == "plate_1")
        assert where.sum() == 1
        # The rounding of a mean of three numbers.
        np.testing.assert_allclose(table.effects["effect"][where], pairs.mean(), rtol=1e-12)
        half = student.ppf(0.975, SEEDS - 1) * pairs.std(ddof=1) / np.sqrt(SEEDS)
        np.testing.assert_allclose(table.effects["half_width_95"][where], half, rtol=1e-6)
    with pytest.raises(ValueError, match="varied one at a time"):
        table.to_xarray()


def test_wrong_requests_are_refused() -> None:
    case, keys = tube(), {"support.*.gap": [1e-4]}
    wrong: list[tuple[dict[str, Any], str]] = [
        ({"points": {"support.*.gas": [1.0]}}, "gas"),
        ({"points": {}}, "what is varied is nothing"),
        ({"measures": []}, "one measure or more of"),
        ({"measures": ["wear_rate"]}, "wear_rate"),
        ({"seeds": 1}, "2 or more"),
        ({"step": 1e-4}, "no such argument beside a case"),
        ({"points": sg.grid(gap=[1e-4])}, "a mapping of keys to values"),
        ({"threads": 0}, "expected 1 or more"),
    ]
    for arguments, message in wrong:
        with pytest.raises(ValueError, match=message.replace("*", r"\*")):
            sg.sweep(case, **{"points": keys, "measures": MEASURES, **arguments})
    with pytest.raises(ValueError, match="expected a case in place of a function"):
        sg.sweep(lambda: case.scene, [{}], seeds=2)  # type: ignore[call-overload]


def test_rows_that_fail_say_why() -> None:
    with pytest.warns(RuntimeWarning, match="1 of 2 rows failed; the first: row 0"):
        table = sg.sweep(tube(), {"support.*.friction": [-1.0, 0.2]}, measures=MEASURES)
    assert table["error"][0] is not None and np.isnan(table["work_rate_plate_1_W"][0])
    assert table["status"][1] == "ok" and table["work_rate_plate_1_W"][1] > 0.0
    with pytest.raises(KeyError, match="no column wear; there are row, "):
        table["wear"]


@pytest.mark.parametrize("package, method", [("pandas", "to_pandas"), ("xarray", "to_xarray")])
def test_a_missing_package_is_named(package: str, method: str, monkeypatch: pytest.MonkeyPatch) -> None:
    table = sg.sweep(sg.load("rigid-walls-sine", set={"time.end": 0.1}), {"time.step": [1e-3]}, measures=["contacts"])
    monkeypatch.setitem(sys.modules, package, None)
    with pytest.raises(ImportError, match=f"{method} needs {package}: pip install {package}"):
        getattr(table, method)()
