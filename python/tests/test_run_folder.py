"""Folders of runs and of realisations: the files of the tool."""

import json
from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest

import signorini as sg

SHORT = {"time.end": 0.2, "time.statistics_from": 0.05, "system.modes": 6, "system.beam.elements": 12}


def arguments(values: dict[str, Any]) -> list[str]:
    return [word for key, value in values.items() for word in ("--set", f"{key}={value}")]


def tube(**more: Any) -> sg.Case:
    return sg.load("tube-round-supports", set={**SHORT, **more})


def without_times(value: Any) -> Any:
    """A document without what differs between two runs of the same case: seconds, lengths, digests."""
    if isinstance(value, dict):
        timed = ("wall_clock_s", "made", "command_line", "documents")
        return {key: without_times(one) for key, one in value.items() if key not in timed}
    return value


def document(path: Path) -> Any:
    return without_times(json.loads(path.read_text(encoding="utf-8")))


def assert_same_files(mine: Path, tools: Path) -> None:
    """The files of two folders; in the page, seconds and the line of the command differ."""
    names = sorted(str(path.relative_to(tools)) for path in tools.rglob("*") if path.is_file())
    assert sorted(str(path.relative_to(mine)) for path in mine.rglob("*") if path.is_file()) == names
    assert "report.html" in names and "summary.json" in names and "trajectory.csv" in names
    for name in names:
        if name.endswith(".json"):
            assert document(mine / name) == document(tools / name), name
        elif name != "report.html":
            assert (mine / name).read_bytes() == (tools / name).read_bytes(), name


def assert_page(folder: Path) -> None:
    """The page is that of `report`, from the files in the folder."""
    page = (folder / "report.html").read_bytes()
    assert sg.report(folder) == folder / "report.html"
    assert (folder / "report.html").read_bytes() == page and b"<html" in page


def test_a_run_writes_the_files_of_the_tool(tool: Callable[..., Path], tmp_path: Path) -> None:
    folder = tmp_path / "mine"
    run = tube().run(folder=folder)
    assert_same_files(folder, tool("run", "tube-round-supports", *arguments(SHORT), page=True))
    assert {"shape.csv", "animation.svg", "supports.csv"} <= {path.name for path in folder.iterdir()}
    assert_page(folder)
    # The run is that without a folder, and that of the case in the folder.
    plain = tube().run()
    again = sg.load(folder / "summary.json").run()
    for other in (plain, again):
        assert run.displacement.tobytes() == other.displacement.tobytes()
        assert run.probes == other.probes and run.notes == other.notes


def test_a_step_and_a_scheme_are_those_of_the_command(tool: Callable[..., Path], tmp_path: Path) -> None:
    folder = tmp_path / "mine"
    case = sg.load("rigid-walls-sine", set={"time.end": 1.0})
    run = case.run("moreau-jean", step=2e-4, folder=folder, verdict=False)
    assert run.step == 2e-4
    settings = ["--set", "time.end=1.0", "--scheme", "moreau-jean", "--step", "2e-4", "--no-verdict"]
    assert_same_files(folder, tool("run", "rigid-walls-sine", *settings, page=True))
    # Another request is not written over it; the same is.
    with pytest.raises(OSError, match="other results|another request|step_s"):
        case.run("moreau-jean", step=1e-4, folder=folder, verdict=False)
    case.run("moreau-jean", step=2e-4, folder=folder, verdict=False)


def test_realisations_write_the_files_of_the_tool(tool: Callable[..., Path], tmp_path: Path) -> None:
    folder = tmp_path / "mine"
    study = sg.realisations(tube(), seeds=3, folder=folder)
    assert_same_files(folder, tool("run", "tube-round-supports", *arguments(SHORT), "--seeds", "3", page=True))
    assert {"realisations.csv", "errors.csv", "sector-means.csv"} <= {path.name for path in folder.iterdir()}
    assert_page(folder)
    plain = sg.realisations(tube(), seeds=3)
    assert (plain.table["work_rate_W"] == study.table["work_rate_W"]).all()


def test_an_interval_has_the_request_of_the_tool(tool: Callable[..., Path], tmp_path: Path) -> None:
    folder = tmp_path / "mine"
    sg.realisations(tube(), until_interval=0.9, verdict=False, folder=folder)
    own = ["--until-interval", "90%", "--no-verdict"]
    assert_same_files(folder, tool("run", "tube-round-supports", *arguments(SHORT), *own, page=True))


def test_an_accuracy_has_the_files_of_the_tool(tool: Callable[..., Path], tmp_path: Path) -> None:
    folder, window = tmp_path / "mine", {"time.end": 30.0, "time.statistics_from": 10.0}
    # It settles slower than in 10 s.
    unsettled = pytest.warns(sg.ResultWarning, match="of 6 runs have not settled")
    with unsettled, pytest.warns(sg.ResultWarning, match="fall into two groups"):
        study = sg.realisations(sg.load("rigid-walls-sine", set=window), accuracy=0.3, folder=folder)
    own = [*arguments(window), "--accuracy", "0.3", "--of", "means"]
    assert_same_files(folder, tool("run", "rigid-walls-sine", *own, page=True))
    accuracy = json.loads((folder / "summary.json").read_text(encoding="utf-8"))["accuracy"]
    assert accuracy == study.accuracy and accuracy["start_scatter"] == 1e-6


def test_what_has_no_folder_is_refused_by_name(tmp_path: Path) -> None:
    case = sg.load("rigid-walls-sine", set={"time.end": 0.5})
    with pytest.raises(ValueError, match='folder is ".*"; expected none beside accuracy'):
        case.run(accuracy=1e-2, folder=tmp_path / "run")
    file = tmp_path / "file"
    file.write_text("", encoding="utf-8")
    with pytest.raises(OSError):
        case.run(folder=file / "run")
    with pytest.raises(ValueError, match="step"):
        case.run(step=-1.0, folder=tmp_path / "run")


def test_a_refuted_run_has_its_files(tmp_path: Path) -> None:
    shaken = sg.case({
        "system": {"oscillator": {"mass": 1.0, "damping": 0.0, "stiffness": 400.0}},
        "wall": [{"name": "stop", "side": "upper", "position": 2e-3}],
        "load": [{"harmonic": {"amplitude": 3.0, "frequency": 2.0}}],
        "penalty": {"stiffness": [1e5]},
        "time": {"end": 20.0, "step": 0.02},
    })  # fmt: skip
    # Explicit: stable at the wall up to 2/√(1e5 N/m / 1 kg), 6.3 ms.
    with pytest.raises(sg.RunError) as caught:
        shaken.run("penalty:integrator=central-difference", folder=tmp_path / "run", verdict=False)
    assert isinstance(caught.value, (sg.RefutedError, sg.DivergedError))
    assert json.loads((tmp_path / "run/summary.json").read_text(encoding="utf-8"))["refuted"]
    assert (tmp_path / "run/report.html").exists()
