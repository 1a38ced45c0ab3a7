"""Many runs: one table, the same wherever they are run."""

import os
import sys
from concurrent.futures import Future, ProcessPoolExecutor, ThreadPoolExecutor
from multiprocessing import get_context
from pathlib import Path
from typing import Any

import numpy as np
import pytest

import signorini as sg

sys.path.insert(0, str(Path(__file__).parent))
import cluster

# Most windows here begin with the run, and hold its transient.
pytestmark = pytest.mark.filterwarnings("ignore:.* have not settled:signorini.ResultWarning")

POINTS = sg.grid(gap=np.linspace(2e-3, 8e-3, 60), restitution=[0.5, 0.8])


def assert_same(table: sg.Table, other: sg.Table) -> None:
    """The same to the last bit."""
    assert list(table) == list(other)
    for name, column in table.items():
        if column.dtype == object:
            assert list(column) == list(other[name])
        else:
            assert column.tobytes() == other[name].tobytes(), name


@pytest.fixture(scope="module")
def whole() -> sg.Table:
    return sg.sweep(cluster.make, POINTS, "event", threads=1)


def test_a_row_is_what_its_run_says(whole: sg.Table) -> None:
    for row in (0, 17, 119):
        made = cluster.make(**POINTS[row])
        run = made.run("event", sample=4.0)
        upper = run.statistics["stop-upper"]
        assert whole["gap"][row] == POINTS[row]["gap"]
        assert whole["contacts_stop-upper"][row] == upper["contacts"]
        assert whole["impact_power_stop-upper_W"][row] == upper["impact_power_w"]
        # Impulses of the window, which is the whole run, and of the rows: sums in another order.
        assert whole["impulse_stop-upper_N_s"][row] == pytest.approx(run.impulse("stop-upper"), rel=1e-12)
        half = upper["half_width_95"]
        if half is not None:
            assert whole["impact_power_half_width_95_stop-upper_W"][row] == half["impact_power_w"]
    assert all(error is None for error in whole["error"])


def test_threads_and_the_judge_change_no_bit(whole: sg.Table) -> None:
    assert_same(sg.sweep(cluster.make, POINTS, "event", threads=2), whole)
    unjudged = sg.sweep(cluster.make, POINTS, "event", judge=False)
    assert set(unjudged["status"]) == {"unjudged"} and set(whole["status"]) == {"ok"}
    assert_same(unjudged | {"status": whole["status"]}, whole)
    assert_same(sg.run_many([cluster.make(**p) for p in POINTS], "event"), {k: whole[k] for k in list(whole)[2:]})


@pytest.mark.parametrize("chunk", [None, 7])
def test_executors_give_the_same_table(whole: sg.Table, chunk: int | None) -> None:
    with ThreadPoolExecutor(2) as executor:
        assert_same(sg.sweep(cluster.make, POINTS, "event", executor=executor, chunk=chunk), whole)
    with ProcessPoolExecutor(2, mp_context=get_context("spawn")) as executor:
        assert_same(sg.sweep(cluster.make, POINTS, "event", executor=executor, chunk=chunk), whole)


def test_what_a_broken_pool_loses_is_run_again(
    whole: sg.Table, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setenv("SIGNORINI_TEST_PID", str(os.getpid()))
    points = [point | {"flag": str(tmp_path / "died")} for point in POINTS]
    with ProcessPoolExecutor(2, mp_context=get_context("spawn")) as executor:
        with pytest.warns(RuntimeWarning, match="run here again"):
            table = sg.sweep(cluster.deadly, points, "event", executor=executor, chunk=10)
    assert (tmp_path / "died").exists()
    del table["flag"]
    assert_same({name: table[name] for name in whole}, whole)


def test_points_that_fail_are_rows_with_a_reason() -> None:
    points = sg.grid(gap=[4e-3, -1e-3, 6e-3])
    with pytest.warns(RuntimeWarning, match=r"1 of 3 rows failed; the first: support 'stop': gap is -0\.001"):
        table = sg.sweep(cluster.make, points, "event")
    assert np.isnan(table["contacts_stop-upper"]).tolist() == [False, True, False]
    assert [error is None for error in table["error"]] == [True, False, True]
    # The exact scheme gives up between walls of a picometre.
    with pytest.warns(RuntimeWarning, match="contact events"):
        sg.sweep(lambda gap: cluster.make(gap, 1.0).replace(velocity=1.0), [{"gap": 1e-12}], "event")


@pytest.mark.parametrize(
    "options, reason",
    [
        ({"scheme": "moreau-jean", "step": 1e-3, "statistics_from": 5.0}, r"statistics_from is 5\.0; expected 0 or"),
        ({"scheme": "moreau-jean", "step": 5.0}, r"step is 5\.0; expected less than the duration, 2\.0"),
        ({"scheme": "penalty", "step": 1e-3}, "setting of penalty is neither epsilon nor stiffness"),
    ],
)
def test_requests_that_cannot_be_run_are_told(scene: sg.Scene, options: dict[str, Any], reason: str) -> None:
    with pytest.warns(RuntimeWarning, match=f"^2 of 2 rows failed; the first: {reason}") as caught:
        table = sg.run_many([scene, scene], **options)
    assert len(caught) == 1 and caught[0].filename == __file__
    assert list(table["status"]) == ["failed"] * 2


def test_methods_that_fail_are_told(scene: sg.Scene) -> None:
    message = "^1 of 2 methods failed; the first: setting of penalty is neither epsilon nor stiffness"
    with pytest.warns(RuntimeWarning, match=message) as caught:
        compared = sg.compare(scene, ["penalty", "event"], step=1e-3)
    assert compared.runs[0] is None and compared.runs[1] is not None and caught[0].filename == __file__
    with pytest.warns(RuntimeWarning, match=message) as caught:
        sg.chart(scene, ["penalty", "event"], levels=3, repeats=1)
    assert caught[0].filename == __file__
    # A method that diverges at some steps is no wrong request.
    made = sg.chart(scene, ["penalty:epsilon=1e-9,integrator=central-difference"], levels=3, repeats=1)
    assert 0 < sum(text is not None for text in made.table["failure"]) < len(made.table["failure"])


def test_walls_are_those_of_the_first_point() -> None:
    def make(name: str) -> sg.Scene:
        return sg.oscillator(1.0, 0.0, 1.0, walls=[sg.Wall.upper(name, 1.0)])

    with pytest.warns(RuntimeWarning, match="walls are b; expected a"):
        table = sg.sweep(make, sg.grid(name=["a", "b"]), "event")
    assert table["error"][0] is None


@pytest.mark.parametrize("threads", [1, 2])
def test_a_defect_of_make_is_told_at_once(threads: int) -> None:
    ran: list[float] = []

    def make(gap: float) -> sg.Scene:
        ran.append(gap)
        return undefined(gap)  # type: ignore[name-defined,no-any-return] # noqa: F821

    with pytest.raises(NameError):
        sg.sweep(make, sg.grid(gap=[1.0, 2.0]), "event", threads=threads)
    assert ran == [1.0]


def test_a_callable_that_cannot_be_pickled_is_told() -> None:
    with ProcessPoolExecutor(1, mp_context=get_context("spawn")) as executor:
        with pytest.raises(Exception, match="pickle"):
            sg.sweep(lambda gap: cluster.make(gap), sg.grid(gap=[4e-3]), "event", executor=executor)
    closed = ThreadPoolExecutor(1)
    closed.shutdown()
    with pytest.raises(RuntimeError, match="shutdown"):
        sg.sweep(cluster.make, sg.grid(gap=[4e-3]), "event", executor=closed)


def test_an_error_of_dasks_own_costs_no_row(whole: sg.Table) -> None:
    class Failing(ThreadPoolExecutor):
        """Fails as Dask does where a worker dies just after its result was fetched."""

        def submit(self, *_: Any) -> Future[Any]:  # type: ignore[override]
            future: Future[Any] = Future()
            try:
                exec(compile("_, _, _ = 1, 2", "/site-packages/distributed/cfexecutor.py", "exec"))
            except ValueError as error:
                future.set_exception(error)
            return future

    assert_same(sg.sweep(cluster.make, POINTS, "event", executor=Failing(1), chunk=40), whole)


def test_a_folder_keeps_rows_of_equal_scenes_only(tmp_path: Path, whole: sg.Table) -> None:
    def count() -> int:
        return sum(len(np.load(path)["digests"]) for path in tmp_path.glob("*.npz"))

    options: dict[str, Any] = {"folder": tmp_path}
    sg.sweep(cluster.make, POINTS[:50], "event", **options)
    assert count() == 50
    assert_same(sg.sweep(cluster.make, POINTS, "event", **options), whole)
    assert count() == len(POINTS)
    # Another window, another scheme: other rows.
    sg.sweep(cluster.make, POINTS[:2], "event", statistics_from=1.0, **options)
    sg.sweep(cluster.make, POINTS[:2], "moreau-jean", step=1e-3, **options)
    assert count() == len(POINTS) + 4
    with ThreadPoolExecutor(2) as executor:
        assert_same(sg.sweep(cluster.make, POINTS, "event", executor=executor, **options), whole)
    assert count() == len(POINTS) + 4


def test_a_damaged_file_of_rows_is_named_and_an_abandoned_one_removed(tmp_path: Path) -> None:
    points = POINTS[:3]
    table = sg.sweep(cluster.make, points, "event", folder=tmp_path)
    abandoned, fresh = tmp_path / "killed.part", tmp_path / "written-now.part"
    for part in (abandoned, fresh):
        part.write_bytes(b"half")
    os.utime(abandoned, (0.0, 0.0))
    path = next(tmp_path.glob("*.npz"))
    whole = path.read_bytes()
    # A changed digit in the middle, half a file, an empty one, no archive, and a pipe, which has no end.
    changed = bytearray(whole)
    changed[len(whole) // 2] ^= 1
    for damaged in (bytes(changed), whole[: len(whole) // 2], b"", b"no archive"):
        path.write_bytes(damaged)
        with pytest.raises(OSError, match=path.name):
            sg.sweep(cluster.make, points, "event", folder=tmp_path)
    path.unlink()
    os.mkfifo(path)
    with pytest.raises(OSError, match=f"{path.name}.*not a regular file"):
        sg.sweep(cluster.make, points, "event", folder=tmp_path)
    path.unlink()
    assert_same(sg.sweep(cluster.make, points, "event", folder=tmp_path), table)
    assert not abandoned.exists() and fresh.exists()


def test_a_folder_that_has_all_rows_gives_the_table_without_a_run(
    tmp_path: Path, whole: sg.Table, monkeypatch: pytest.MonkeyPatch
) -> None:
    for shard in range(3):
        sg.sweep(cluster.make, POINTS[shard::3], "event", folder=tmp_path)
    monkeypatch.setattr("signorini._sweep._task", lambda *_: pytest.fail("a run"))
    assert_same(sg.sweep(cluster.make, POINTS, "event", folder=tmp_path), whole)
    with ThreadPoolExecutor(1) as executor:
        assert_same(sg.sweep(cluster.make, POINTS, "event", folder=tmp_path, executor=executor), whole)


@pytest.mark.parametrize("chunk", [1, 5])
def test_points_that_are_all_refused_are_rows_with_their_reasons(chunk: int) -> None:
    def make(mass: float) -> sg.Scene:
        return sg.oscillator(mass, 0.2, 100.0, duration=1.0, loads=[sg.Load.harmonic(3.0, 5.0)])

    with ThreadPoolExecutor(1) as executor:
        for options in ({}, {"executor": executor, "chunk": chunk}):
            with pytest.warns(RuntimeWarning, match="4 of 5 rows failed"):
                table = sg.sweep(make, sg.grid(mass=[1.0, -1.0, -2.0, -3.0, 0.0]), "event", **options)  # type: ignore[call-overload]
            assert [error is None for error in table["error"]] == [True, False, False, False, False]
            with pytest.warns(RuntimeWarning, match="2 of 2 rows failed"):
                table = sg.sweep(make, sg.grid(mass=[-1.0, -2.0]), "event", **options)  # type: ignore[call-overload]
            assert all("mass" in error for error in table["error"])
            assert list(table["status"]) == ["failed"] * 2


def test_round_supports_have_the_columns_of_walls() -> None:
    round_ = sg.load("tube-round-supports").scene
    points = sg.grid(duration=[0.1, 0.2])
    table = sg.sweep(lambda duration: round_.replace(duration=duration), points, "moreau-jean", step=5e-5)
    assert list(table["status"]) == ["ok", "ok"]
    for name, (short, long) in [(name, table[f"impulse_{name}_N_s"]) for name in ("plate-1", "plate-2")]:
        # The longer run begins with the shorter one.
        assert 0.0 < short < long, name


def test_notes_that_limit_results_are_told_once_with_a_count(scene: sg.Scene) -> None:
    # A period of the load is 5 steps of 0.04 s.
    points = sg.grid(duration=[1.0, 2.0, -1.0])
    with pytest.warns() as caught:
        table = sg.sweep(lambda duration: scene.replace(duration=duration), points, "moreau-jean", step=0.04)
    assert [warning.category for warning in caught] == [RuntimeWarning, sg.ResultWarning]
    assert "2 of 3 runs have notes that limit the use of their results; the first: " in str(caught[1].message)
    assert "fewer than 10 do not resolve it" in str(caught[1].message)
    assert all(warning.filename == __file__ for warning in caught)
    assert list(table["status"]) == ["ok", "ok", "failed"]
    with pytest.warns(sg.ResultWarning, match="1 of 1 runs"):
        sg.run_many([scene], "moreau-jean", step=0.04, judge=False)


def test_nothing_to_run() -> None:
    assert list(sg.run_many([], "event")) == ["status", "error"]
    assert list(sg.sweep(cluster.make, [], "event")) == ["status", "error"]
    assert sg.grid() == [{}]


def test_progress_is_for_terminals(capsys: pytest.CaptureFixture[str]) -> None:
    sg.sweep(cluster.make, POINTS, "event")
    out, errors = capsys.readouterr()
    assert (out, errors) == ("", "")


def test_runs_that_have_not_settled_are_told_beyond_chance(scene: sg.Scene) -> None:
    # Free vibration decays by e⁻¹ in 10 s: a window from 2 s begins before that.
    cases = [sg.load("rigid-walls-sine", set={"initial.velocity": 1e-6 * i, "time.end": 30.0}) for i in range(8)]
    scenes = [case.scene for case in cases]
    with pytest.warns(sg.ResultWarning, match="[2-8] of 8 runs have not settled"):
        sg.run_many(scenes, "located", step=1e-3, statistics_from=2.0)
