"""Sweeps of a case: the tables of the tool's engine."""

import csv
import re
import sys
from collections.abc import Callable
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
    places = ["plate-1", "plate-2"]
    assert dict(data.sizes) == {"gap_m": 2, "friction": 2, "support": 2, "realisation": SEEDS}
    assert list(data["support"].to_numpy()) == places
    at = data.sel(gap_m=2e-4, friction=0.1)
    for place, word in zip(places, ["plate_1", "plate_2"], strict=True):
        assert float(at["work_rate_W"].sel(support=place)) == table[f"work_rate_{word}_W"][2]
        half = float(at["work_rate_half_width_95_W"].sel(support=place))
        assert half == table[f"work_rate_half_width_95_{word}_W"][2]
    seen = at["realisations_work_rate_W"].sel(support="plate-1").to_numpy()
    np.testing.assert_array_equal(seen, table.realisations["work_rate_plate_1_W"][2 * SEEDS : 3 * SEEDS])


def test_effects_are_differences_of_pairs() -> None:
    keys = {"support.*.gap": (1e-4, 4e-4), "support.*.friction": (0.1, 0.3)}
    table = sg.one_at_a_time(tube(), keys, measures=["work_rate"], seeds=SEEDS)
    assert len(table["row"]) == 5  # The case, then two bounds of each key.
    values = table.realisations["work_rate_plate_1_W"].reshape(5, SEEDS)
    for number, key in enumerate(keys):
        pairs = values[2 + 2 * number] - values[1 + 2 * number]
        where = (table.effects["key"] == key) & (table.effects["place"] == "plate-1")
        assert where.sum() == 1
        # The rounding of a mean of three numbers.
        np.testing.assert_allclose(table.effects["effect"][where], pairs.mean(), rtol=1e-12)
        half = student.ppf(0.975, SEEDS - 1) * pairs.std(ddof=1) / np.sqrt(SEEDS)
        np.testing.assert_allclose(table.effects["half_width_95"][where], half, rtol=1e-6)
    with pytest.raises(ValueError, match="varied one at a time"):
        table.to_xarray()


# 1 kg before a stop under a random force.
STOP: dict[str, Any] = {
    "system": {"oscillator": {"mass": 1.0, "damping": 2.0, "stiffness": 400.0}},
    "wall": [{"name": "stop", "side": "upper", "position": 5e-3, "restitution": 0.5}],
    "load": [{"random": {"rms": 3.0, "from": 1.0, "to": 20.0, "seed": 7}}],
    "time": {"end": 1.0, "step": 1e-3},
}
PLACES = [1e-3, 5e-3]


def stop(position: float = 5e-3) -> sg.Case:
    return sg.case({**STOP, "wall": [{**STOP["wall"][0], "position": position}]})


def test_a_row_has_as_many_realisations_as_its_interval_takes() -> None:
    table = sg.sweep(stop(), {"wall.stop.position": PLACES}, measures=["force_mean"], until_interval=0.2)
    assert table["seeds"][0] != table["seeds"][1]
    frame = table.to_pandas("realisations")
    for row, position in enumerate(PLACES):
        # Stein: from the scatter of the first six, at least these.
        own = frame[frame["row"] == row]
        first = own["force_mean_stop_N"].to_numpy()[:6]
        needed = (student.ppf(0.975, 5) * first.std(ddof=1) / (0.2 * first.mean())) ** 2
        assert len(own) == table["seeds"][row] == max(6, int(np.ceil(needed)))
        assert list(own["realisation"]) == list(range(1, len(own) + 1))
        # Those of a study of this row alone.
        study = sg.realisations(stop(position), until_interval=0.2, verdict=False)
        assert study.count == len(own)
        np.testing.assert_array_equal(study.table["force_mean_N"], own["force_mean_stop_N"])


def test_datasets_of_rows_of_different_numbers_are_padded() -> None:
    table = sg.sweep(stop(), {"wall.stop.position": PLACES}, measures=["force_mean"], until_interval=0.2)
    data = table.to_xarray()
    most = int(table["seeds"].max())
    assert data.sizes["realisation"] == most and list(data["realisation"]) == list(range(1, most + 1))
    np.testing.assert_array_equal(data["seeds"], table["seeds"])
    padded = data["realisations_force_mean_N"].sel(place="stop")
    np.testing.assert_array_equal(padded.count("realisation"), data["seeds"])
    # Their mean leaves out what is not there; sums in another order.
    np.testing.assert_allclose(padded.mean("realisation"), table["force_mean_stop_N"], rtol=1e-13)


def test_datasets_have_the_depths_of_all_sectors() -> None:
    law = {"support.*.width": 0.02, "wear.coefficient": 1e-14, "wear.service": 3e7}
    worn = sg.load("tube-round-supports", set={**SHORT, **law})
    table = sg.sweep(worn, {"support.*.gap": [1e-4, 2e-4]}, measures=["depth_deepest", "contacts"], seeds=2)
    data = table.to_xarray()
    depths = data["realisations_depths_m"]
    assert depths.dims == ("gap_m", "realisation", "support", "part") and depths.sizes["part"] == 12
    # Those by the mean work, whose mean the row has: its deepest sector is the row's. Sums in another order.
    place = [f"depth_deepest_{name}_m" for name in ("plate_1", "plate_2")]
    deepest = depths.mean("realisation").max("part")
    np.testing.assert_allclose(deepest, np.stack([table[name] for name in place], axis=1), rtol=1e-13)
    assert set(data["contacts"].dims) == {"gap_m", "wall"} and float(depths.max()) > 0.0


def test_keys_drawn_at_random_have_their_shares() -> None:
    # Without contact the displacement is in proportion to the load: all of its variance is the
    # load's. The motion is computed to rounding, and a straight line fits exactly.
    load = {"harmonic": {"amplitude": 3.0, "frequency": 2.0}}
    free = sg.case({**STOP, "wall": [{**STOP["wall"][0], "position": 10.0}], "load": [load]})
    keys = {"load.1.harmonic.amplitude": (1.0, 5.0), "wall.stop.restitution": (0.2, 0.9, "log")}
    table = sg.sweep(free, keys, measures=["displacement_max"], random="lhs", rows=20, seed=3)
    assert table.design == "random" and len(table["row"]) == 20
    assert list(table.shares["key"]) == [*keys, "interactions"]
    np.testing.assert_allclose(table.shares["share"], [1.0, 0.0, 0.0], atol=1e-9)
    # One row in each slice of the logarithm.
    slices = np.log(table["restitution"] / 0.2) / np.log(0.9 / 0.2) * 20
    assert sorted(slices.astype(int)) == list(range(20))
    pd.testing.assert_frame_equal(table.to_pandas("shares"), pd.DataFrame(dict(table.shares)))
    with pytest.raises(ValueError, match="to_xarray of keys drawn at random; expected a sweep over a grid"):
        table.to_xarray()
    with pytest.raises(ValueError, match="table is 'effects'; expected one that this sweep has: rows, shares"):
        table.to_pandas("effects")


PLANE = {"initial.displacement": [-4e-3, 0.0, 4e-3], "initial.velocity": [-0.3, 0.0, 0.3]}


def broken() -> sg.Case:
    """Where two orbits, mirror images of each other, have taken the place of the symmetric one."""
    return sg.load("rigid-walls-sine", set={"wall.*.restitution": 0.8, "load.1.harmonic.frequency": 4.4})


def test_basins_are_those_of_the_tool(tool: Callable[..., Path], tmp_path: Path) -> None:
    measures, folder = ["attractor", "period"], tmp_path / "own"
    table = sg.sweep(broken(), PLANE, "event", measures=measures, settle=200, keep=30, folder=folder)
    # Two orbits of one period; of each the other is the mirror image.
    assert list(table.attractors["attractor"]) == [1, 2] and list(table.attractors["period"]) == [1, 1]
    counts = [int((table["attractor"] == number).sum()) for number in (1, 2)]
    assert counts == list(table.attractors["rows"]) and sum(counts) == 9
    np.testing.assert_allclose(table.attractors["share"], np.array(counts) / 9, rtol=1e-15)
    # They are the orbits of the branch that begins where the symmetry breaks.
    case = sg.load("rigid-walls-sine", set={"wall.*.restitution": 0.8})
    branches = sg.branches(case, "load.1.harmonic.frequency", (4.4, 5.0))
    last = int(np.flatnonzero(branches["branch"] == 2)[-1])
    speeds = sorted(branches[f"speed_{i}_m_per_s"][last] for i in (1, 2))
    for cell in table.attractors["approach_speeds_m_per_s"]:
        np.testing.assert_allclose(sorted(float(word) for word in cell.split()), speeds, rtol=1e-8)
    pd.testing.assert_frame_equal(table.to_pandas("attractors"), pd.DataFrame(dict(table.attractors)))
    assert table.to_xarray()["attractor"].shape == (3, 3)
    assert sg.report(folder) == folder / "report.html"
    vary = [f"--vary={key}={','.join(map(repr, values))}" for key, values in PLANE.items()]
    sets = ["--set=wall.*.restitution=0.8", "--set=load.1.harmonic.frequency=4.4"]
    rest = ["--measure=attractor,period", "--scheme=event", "--settle=200", "--keep=30"]
    written = tool("sweep", "rigid-walls-sine", *sets, *vary, *rest)
    for name in ("sweep.csv", "attractors.csv"):
        assert (folder / name).read_bytes() == (written / name).read_bytes(), name


def test_starts_whose_attractor_is_not_found_are_undecided() -> None:
    with pytest.warns(sg.ResultWarning, match="undecided: 1 of 1 starts, whose attractor was not found"):
        start = {"initial.displacement": [4e-3]}
        table = sg.sweep(broken(), start, "event", measures=["attractor"], keep=1)
    assert np.isnan(table["attractor"]).all() and table["status"][0] == "ok"


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
        ({"keep": 0}, "keep is 0; expected 1 or more"),
        ({"settle": 9}, "settle is 9; expected keep beside it"),
        ({"measures": ["period"]}, "keep=N in Python) beside it"),
        ({"until_interval": 5}, "until_interval is 5; expected a share above 0 and below 1"),
        ({"until_interval": 0.05, "seeds": 3}, "expected no interval beside a number"),
        ({"most_seeds": 9}, "expected until_interval beside it"),
        ({"random": "sobl", "rows": 8, "points": {"support.*.gap": (1e-4, 2e-4)}}, "did you mean sobol?"),
        ({"random": "lhs", "points": {"support.*.gap": (1e-4, 2e-4)}}, "rows is missing; expected the number"),
        ({"random": "lhs", "rows": 0, "points": {"support.*.gap": (1e-4, 2e-4)}}, "rows is 0; expected"),
        ({"random": "lhs", "rows": 8, "points": {"support.*.gap": (1e-4, 2e-4, 3e-4)}}, "its lower and upper bound"),
        ({"random": "lhs", "rows": 8, "points": {"support.*.gap": (2e-4, 1e-4)}}, "more than from"),
        ({"rows": 8}, "rows is 8; expected random beside it"),
        ({"seed": 8}, "seed is 8; expected random beside it"),
    ]
    for arguments, message in wrong:
        with pytest.raises(ValueError, match=re.escape(message)):
            sg.sweep(case, **{"points": keys, "measures": MEASURES, **arguments})
    with pytest.raises(ValueError, match="expected a case in place of a function"):
        sg.sweep(lambda: case.scene, [{}], seeds=2)  # type: ignore[call-overload]
    with pytest.raises(ValueError, match="keep is 3; expected a case in place of a function beside it"):
        sg.sweep(lambda: case.scene, [{}], keep=3)  # type: ignore[call-overload]
    with pytest.raises(ValueError, match="random is 'lhs'; expected a case in place of a function"):
        sg.sweep(lambda: case.scene, [{}], random="lhs", rows=3)  # type: ignore[call-overload]


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
