"""Bad input: one clear exception, which says what, the value found, and what would be accepted."""

import functools
import math
import pickle
import re
import threading
from collections.abc import Callable
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path
from typing import Any

import numpy as np
import pytest
import scipy.sparse

import signorini as sg

EYE = np.eye(2)
WALL = sg.Wall.upper("stop", 5e-3)


def ball(**scene: Any) -> sg.Scene:
    return sg.oscillator(1.0, 0.0, 0.0, **scene)


def beam(**scene: Any) -> sg.Scene:
    return sg.beam(length=1.0, youngs_modulus=2e11, density=7850.0, outer_diameter=0.01, elements=4, **scene)


def closed(path: Path) -> Any:
    file = path.open("w")
    file.close()
    return file


VALUES: list[tuple[Callable[[], object], str]] = [
    (lambda: sg.oscillator(-1.0, 0.0, 0.0), r"mass is -1\.0; expected a finite number above 0"),
    (lambda: sg.oscillator(math.nan, 0.0, 0.0), "mass is NaN"),
    (lambda: sg.oscillator(1.0, math.inf, 0.0), "damping is inf"),
    (lambda: ball(duration=0.0), r"duration is 0\.0"),
    (lambda: ball(velocity=math.nan), "velocity is NaN"),
    (lambda: ball(velocity=[0.0, 1.0]), "velocity is 2 values; expected 1"),
    (lambda: sg.chain([1.0, 1.0], [1.0], velocity=1.0), "expected 2 values, one per degree of freedom"),
    (lambda: ball(walls=[WALL, WALL]), "another wall has"),
    (lambda: ball(walls=[WALL], displacement=1.0), r"expected at most 0\.005"),
    (lambda: ball(damping=0.1), "given twice|multiple values|damping"),
    (lambda: ball().replace(damping=0.1), "expected no damping here: `oscillator` takes it"),
    (lambda: ball().replace(modes=1), "one degree of freedom"),
    (lambda: sg.Wall.upper("a b", 0.0), "letters, digits"),
    (lambda: sg.Wall.upper("a", math.inf), "position is inf"),
    (lambda: sg.Wall.upper("a", 0.0, restitution=1.5), r"restitution is 1\.5; expected a number from 0 to 1"),
    (lambda: sg.Wall.upper("a", 0.0, restitution=1.0, stiffness=1.0), "a wall is rigid or elastic"),
    (lambda: sg.Wall.upper("a", 0.0, damping=1.0), "without a stiffness"),
    (lambda: sg.Wall.upper("a", 0.0, exponent=1.5), "exponent is without a stiffness"),
    (lambda: sg.Wall.upper("a", 0.0, stiffness=1e4, damping=1.0, dissipation=0.1), "dissipation is .* a stiffness alone"),
    (lambda: sg.Wall.upper("a", 0.0, stiffness=1e4, exponent=0.5), r"exponent is 0\.5; expected a number from 1 to 10"),
    (lambda: sg.Wall.upper("a", 0.0, stiffness=-1.0), r"stiffness is -1\.0"),
    (lambda: sg.Wall.upper("a", 0.0, at=object()), "at is <object object"),  # type: ignore[arg-type]
    (lambda: sg.support("s", math.nan), "gap is nan"),
    (lambda: sg.Load.harmonic(1.0, -5.0), r"load: frequency is -5\.0"),
    (lambda: sg.Load.constant(math.nan), "load: force is NaN"),
    (lambda: sg.Load.table([0.0, 0.0], [1.0, 1.0]), "more than the row before"),
    (lambda: sg.Load.table([0.0], [1.0]), "two rows or more"),
    (lambda: ball(walls=[sg.Wall.upper("a", 1.0, at=1.5)]), r"wall \"a\": at is 1\.5; expected a degree of freedom"),
    (lambda: ball(walls=[sg.Wall.upper("a", 1.0, at=7)]), "at is 7"),
    (lambda: ball(walls=[sg.Wall.upper("a", 1.0, at=-1)]), r"at is -1\.0"),
    (lambda: ball(walls=[sg.Wall.upper("a", 1.0, at=1e300)]), "at is"),
    (lambda: ball(probes={"p": "tip"}), "probe \"p\": at is \"tip\""),
    (lambda: beam(walls=[WALL]), "at is missing; expected a position in m"),
    (lambda: beam(walls=[sg.Wall.upper("a", 1.0, at=2.0)]), r"expected a position along the structure, from 0 to 1\.0 m"),
    (lambda: beam(walls=[sg.Wall.upper("a", 1.0, at=0.0)]), "a place that nothing moves"),
    (lambda: beam(left="glued"), "left is \"glued\"; expected \"free\""),
    (lambda: beam(modes=99), "modes is 99"),
    (lambda: beam(damping=-0.1), "damping"),
    (lambda: sg.modal([1.0, 2.0], {"tip": [1.0]}), "tip is 1 values; expected 2"),
    (lambda: sg.modal([1.0], {"tip": [1.0]}, walls=[sg.Wall.upper("a", 1.0, at="top")]), "no point is named \"top\""),
    (lambda: sg.matrices(EYE, None, np.eye(3)), "3 × 3; expected 2 × 2"),
    (lambda: sg.matrices(np.zeros(3), None, EYE), r"shape \(3,\)"),
    (lambda: sg.matrices(np.zeros((2, 3)), None, EYE), r"shape \(2, 3\)"),
    (lambda: sg.matrices(np.zeros((0, 0)), None, EYE), r"shape \(0, 0\)"),
    (lambda: sg.matrices(scipy.sparse.csr_array((2, 3)), None, EYE), r"shape \(2, 3\)"),
    (
        lambda: sg.matrices(EYE, None, [[1.0, 2.0], [0.0, 1.0]]),
        r"row 2, column 1 is 0\.0, and row 1, column 2 is 2\.0; expected a matrix symmetric to 1e-08",
    ),
    (lambda: sg.matrices(EYE, None, -EYE), "positive semidefinite"),
    (lambda: sg.matrices(EYE * math.nan, None, EYE), "NaN; expected a finite number"),
    (lambda: ball().run("nonsense", step=1.0), "no scheme is named \"nonsense\""),
    (lambda: ball().run("moreau-jean"), "step is missing"),
    (lambda: ball().run("moreau-jean", step=-1.0), r"step is -1\.0"),
    (lambda: ball().run("moreau-jean", step=math.nan), "step is NaN"),
    (lambda: ball().run("event", sample=0.0), r"sample is 0\.0"),
    (lambda: ball().run("event", step=1e-3), r"step is 0\.001; expected a scheme that has a step"),
    (lambda: sg.load("rigid-walls-sine").run("event", step=1e-3), "event has none, and sample sets its rows"),
    (lambda: ball().run("event", statistics_from=2.0), "statistics_from"),
    (lambda: ball().run(accuracy=2.0), "accuracy is 2"),
    (lambda: ball().run(accuracy=1e-3, step=1e-3), "no step beside accuracy"),
    (lambda: ball().run("event").contact_force("left"), "no wall is named \"left\": none exists"),
    (lambda: ball(walls=[WALL]).run("event").impulse("stp"), "did you mean stop"),
    (lambda: ball().run("event").probe("x"), "no probe is named"),
    (lambda: sg.load("rigid-wals-sine"), "did you mean rigid-walls-sine"),
    (lambda: sg.load("rigid-walls-sine", set={"wall.*.restitution": 2.0}), "expected a number from 0 to 1"),
    (lambda: sg.load("rigid-walls-sine", set={"wal.x": 2.0}), "wal"),
    (lambda: sg.load("rigid-walls-sine", set={"time.end": object()}), "time.end is <object"),
    (lambda: sg.Stepper(ball(), "moreau-jean", 0.0), "step is 0"),
    (lambda: sg.Stepper(ball(), "moreau-jean", 1e-3).step([1.0, 2.0]), "extra force is 2 values; expected 1"),
    (lambda: sg.Stepper(ball(), "moreau-jean", 1e-3).step(math.nan), "extra force is NaN"),
    (lambda: sg.Stepper(ball(), "moreau-jean", 1e-3).advance(math.inf), "end is inf"),
    (lambda: sg.Stepper(ball(), "moreau-jean", 1e-3).set_state(0.5e-3, 0.0, 0.0), "a multiple of the step"),
    (lambda: sg.compare(ball(), ["x"], step=1e-3), "no scheme is named \"x\""),
    (lambda: sg.stability(ball()), "wall"),
    (lambda: sg.bifurcation(sg.load("rigid-walls-sine"), "load.9.x", [1.0]), "load"),
    (lambda: sg.bifurcation(sg.load("rigid-walls-sine"), "load.1.harmonic.frequency", []), "value"),
    (lambda: sg.run_many([ball(), ball(walls=[WALL])], "event"), "walls are stop"),
    (lambda: sg.run_many([ball()], "nonsense"), "no scheme"),
    (lambda: sg.run_many([ball()], "event", threads=0), "threads is 0"),
    (lambda: sg.sweep(ball, [{"duration": 1.0}, {"velocity": 1.0}], "event"), "point 1 has velocity; expected duration"),
    (lambda: sg.Wall._restore("0.0.0", b""), "use one version on all machines"),
    (lambda: sg.Scene._restore(sg.__version__, b"nonsense"), "not a pickle"),
]


@pytest.mark.parametrize("call, message", VALUES, ids=[message for _, message in VALUES])
def test_a_wrong_value_is_a_value_error(call: Callable[[], object], message: str) -> None:
    with pytest.raises((ValueError, TypeError), match=message) as caught:
        call()
    # Only Python's own check of names may answer with a TypeError here.
    assert type(caught.value) is ValueError or "multiple values" in str(caught.value)


TYPES: list[Callable[[], object]] = [
    lambda: sg.oscillator("1", 0.0, 0.0),  # type: ignore[arg-type]
    lambda: sg.oscillator(1.0, 0.0, None),  # type: ignore[arg-type]
    lambda: sg.oscillator(1.0, 0.0, 0.0, wals=[]),  # type: ignore[call-arg]
    lambda: ball(walls=["upper"]),
    lambda: ball(walls=WALL),
    lambda: ball(velocity="fast"),
    lambda: ball(velocity=np.zeros((2, 2))),
    lambda: beam(left=None),
    lambda: beam(damping="light"),
    lambda: ball(velocity=np.array(["a"])),
    lambda: ball(velocity=np.array([1j])),
    lambda: ball().run("moreau-jean", step="1e-3"),  # type: ignore[arg-type]
    lambda: ball().run(5),  # type: ignore[arg-type]
    lambda: sg.matrices(np.array([["a"]]), None, np.eye(1)),
    lambda: sg.matrices(np.array([[1j]]), None, np.eye(1)),
    lambda: sg.Load.function(3.0),  # type: ignore[arg-type]
    lambda: sg.Load.function(lambda t: "force"),  # type: ignore[arg-type,return-value]
    lambda: sg.Load.table("time", "force"),  # type: ignore[arg-type]
    lambda: sg.Stepper(ball(), "moreau-jean", 1e-3).step("push"),  # type: ignore[arg-type]
    lambda: sg.Stepper(ball(), "moreau-jean", 1e-3).advance(1.0, lambda t, q, v: None),  # type: ignore[arg-type,return-value]
    lambda: sg.sweep(lambda x: x, [{"x": 1}], "event"),
    lambda: sg.load(3.0),  # type: ignore[arg-type]
]


@pytest.mark.parametrize("call", TYPES)
def test_a_wrong_type_is_a_type_error(call: Callable[[], object]) -> None:
    with pytest.raises(TypeError):
        call()


def test_files_that_cannot_be_read(tmp_path: Path) -> None:
    with pytest.raises(OSError, match=r"none\.toml: no such file"):
        sg.load(tmp_path / "none.toml")
    with pytest.raises(OSError):
        sg.load(tmp_path)
    broken = tmp_path / "broken.toml"
    broken.write_text("[system\n")
    with pytest.raises(ValueError, match=r"broken\.toml:1"):
        sg.load(broken)
    broken.write_bytes(b"\xff\xfe\x00")
    with pytest.raises((ValueError, OSError)):
        sg.load(broken)
    with pytest.raises(TypeError):
        sg.load(closed(tmp_path / "closed"))


def test_a_function_has_no_pickled_form() -> None:
    load = sg.Load.function(math.sin)
    for thing in (load, ball(loads=[load]), ball(loads=[load]).run("moreau-jean", step=0.1)):
        with pytest.raises(TypeError, match="Python function as a load"):
            pickle.dumps(thing)
    with pytest.raises(ValueError, match="exact scheme|closed form|function"):
        ball(loads=[load]).run("event")


def test_an_exception_of_a_load_ends_the_run_and_is_passed_on() -> None:
    def late(t: float) -> float:
        if t > 0.5:
            raise ZeroDivisionError("late")
        return 1.0

    made = ball(loads=[sg.Load.function(late)])
    with pytest.raises(ZeroDivisionError, match="late"):
        made.run("moreau-jean", step=1e-3)
    with pytest.raises(ZeroDivisionError, match="late"):
        sg.Stepper(made, "moreau-jean", 1e-3).advance(1.0)
    # And is forgotten then.
    assert ball().run("event").walls == []
    with pytest.warns(RuntimeWarning, match="late"):
        table = sg.run_many([made], "moreau-jean", step=1e-3)
        sg.sweep(lambda: made, [{}], "moreau-jean", step=1e-3)
    assert "late" in table["error"][0]


def test_a_run_that_fails_is_a_run_error() -> None:
    # A force without bound: the state overflows.
    made = ball(loads=[sg.Load.function(lambda t: 0.0 if t == 0.0 else 1.7e308)], duration=1e6)
    with pytest.raises(sg.DivergedError, match="no longer finite"):
        made.run("moreau-jean", step=1e3)
    # Four times above its stability limit, 2/sqrt(1e7) s, it keeps the rows up to where it diverged.
    walls = [sg.Wall.upper("stop", 5e-3, restitution=1.0)]
    fast = sg.oscillator(1.0, 0.0, 100.0, walls=walls, velocity=1.0, duration=2.0)
    with pytest.raises(sg.DivergedError, match="stable below a step") as caught:
        fast.run("penalty:stiffness=1e7,integrator=central-difference", step=2.5e-3)
    assert 0.0 < caught.value.run.time[-1] < 2.0
    walls = [sg.Wall.lower("floor", 0.0, restitution=1.0), sg.Wall.upper("lid", 1e-12, restitution=1.0)]
    with pytest.raises(sg.TooManyEventsError, match="contact events"):
        ball(walls=walls, velocity=1.0).run("event")
    assert issubclass(sg.DivergedError, sg.RunError) and issubclass(sg.RunError, RuntimeError)


def nested(run: Callable[[sg.Scene, float], float]) -> sg.Scene:
    """A scene whose load runs the scene itself, by ``run``, which returns the force."""
    made: list[sg.Scene] = []
    load = sg.Load.function(lambda t: run(made[0], t) if made else 0.0)
    made.append(ball(loads=[load]))
    return made[0]


def many(scene: sg.Scene) -> float:
    """A run among many, whose error is a text."""
    error = sg.run_many([scene], "moreau-jean", step=0.1)["error"][0]
    if error is not None:
        raise RecursionError(error)
    return 0.0


@pytest.mark.parametrize(
    "run",
    [
        lambda scene, t: scene.run("moreau-jean", step=0.1).displacement[-1],
        lambda scene, t: sg.compare(scene, ["moreau-jean"], step=0.1).horizon,
        lambda scene, t: many(scene),
        lambda scene, t: sg.Stepper(scene, "moreau-jean", 0.1).step(),
    ],
)
@pytest.mark.parametrize("beside", [False, True])
@pytest.mark.filterwarnings("ignore:1 of 1 rows failed:RuntimeWarning")
def test_a_load_that_runs_its_own_scene_is_an_error(run: Callable[[sg.Scene, float], float], beside: bool) -> None:
    def start() -> None:
        with pytest.raises(RecursionError, match="5 runs within one another"):
            nested(run).run("moreau-jean", step=0.1)

    if not beside:
        start()
        return
    # Threads may have a far smaller stack than the first one.
    usual = threading.stack_size(512 * 1024)
    try:
        ThreadPoolExecutor(1).submit(start).result()
    finally:
        threading.stack_size(usual)


def test_a_load_that_makes_itself_is_an_error() -> None:
    def force(t: float) -> float:
        sg.Load.function(force)
        return 0.0

    with pytest.raises(RecursionError):
        sg.Load.function(force)


def test_a_load_may_run_another_scene() -> None:
    # The force is the end of another run, some levels deep: 1 N s² on 1 kg over a second from rest.
    force = sg.Load.constant(1.0)

    def twice_the_end(inner: sg.Scene, t: float) -> float:
        return 2.0 * float(inner.run("moreau-jean", step=0.5).displacement[-1])

    for _ in range(5):
        force = sg.Load.function(functools.partial(twice_the_end, ball(loads=[force])))
    # Each level has the displacement of a constant force of 1 N, ½ m.
    assert ball(loads=[force]).run("moreau-jean", step=0.5).displacement[-1] == pytest.approx(0.5, rel=1e-12)


EVIL = "a\x1b[31m\n\0\x9b"


def test_control_characters_of_names_are_shown_escaped(tmp_path: Path) -> None:
    texts = []
    for wrong in (
        lambda: sg.Wall.upper(EVIL, 1.0),
        lambda: ball(probes={EVIL: None}),
        lambda: ball(walls=[sg.Wall.upper("a", 1.0)]).run("event").impulse(EVIL),
        lambda: sg.load("rigid-walls-sine", set={EVIL: 1.0}),
        lambda: sg.load("rigid-walls-sine", set={f"wall.{EVIL}.position": 1.0}),
        lambda: sg.load("rigid-walls-sine", set={"wall.upper.position": EVIL}),
        lambda: ball().run(EVIL),
        lambda: sg.modal([1.0], {EVIL: [1.0]}, walls=[sg.Wall.upper("a", 1.0, at="b")]),
        lambda: sg.load(tmp_path / EVIL.replace("\0", "")),
    ):
        with pytest.raises((ValueError, OSError)) as caught:
            wrong()
        texts.append(str(caught.value))
    case = tmp_path / EVIL.replace("\0", "")
    text = sg.load("rigid-walls-sine").text
    lines = [line for line in text.splitlines() if not line.startswith("title")]
    case.write_text("\n".join([r'title = "t\u001b\n\u0000"', *lines]), encoding="utf-8")
    loaded = sg.load(case)
    texts += [loaded.name, str(loaded.title), repr(loaded), repr(sg.modal([1.0], {EVIL: [1.0]}))]
    assert loaded.title == "t\\u{1b}\\u{a}\\u{0}"
    for said in texts:
        assert not re.search(r"[\x00-\x09\x0b-\x1f\x7f-\x9f]", said), repr(said)
        assert "31m\n" not in said, repr(said)


def test_a_case_too_large_is_refused_and_a_large_one_says_its_size(tmp_path: Path) -> None:
    def case(band: float) -> Path:
        file = tmp_path / "case.toml"
        random = f"random = {{ rms = 1.0, from = 1.0, to = {band}, seed = 1 }}"
        file.write_text(
            "[system.oscillator]\nmass = 1.0\ndamping = 0.2\nstiffness = 100.0\n"
            f"[[load]]\n{random}\n[time]\nend = 1.0\nstep = 1e-5\n"
        )
        return file

    with pytest.raises(ValueError, match=r"expected at most 1\.048576e6 Hz at this end: .* at most 2\^24 rows"):
        sg.load(case(1e7))
    # 16 rows in each of the 1e5 periods, and so many that their number is a power of 2.
    with pytest.warns(UserWarning, match=r"load 1: random: a table of 20971\d\d rows, 34 MB"):
        sg.load(case(1e5))


def test_reduced_matrices_are_symmetric_to_the_rounding_of_their_products() -> None:
    stiffness = 2 * np.eye(60) - np.eye(60, k=1) - np.eye(60, k=-1)
    _, shapes = np.linalg.eigh(stiffness)
    reduced = shapes.T @ stiffness @ shapes
    assert (reduced != reduced.T).any()
    sg.matrices(shapes.T @ shapes, None, reduced)
