"""Arguments that a function would not use as they are given: refused under their names."""

import math
from collections.abc import Callable
from pathlib import Path
from typing import Any

import matplotlib.pyplot as plt
import numpy as np
import pandas as pd
import pytest

import signorini as sg

CASE = sg.load("rigid-walls-sine", set={"time.end": 0.5})
SCENE = CASE.scene
TUBE = sg.load("tube-in-cross-flow")
AMPLITUDE = ["load.1.harmonic.amplitude"]
HARMONIC = "load.1.harmonic.frequency"


STEEL: dict[str, Any] = {"youngs_modulus": 2e11, "density": 7850.0, "outer_diameter": 0.02}


def pair(**scene: Any) -> sg.Scene:
    return sg.chain([1.0, 1.0], [100.0], **scene)


def beam(**scene: Any) -> sg.Scene:
    sizes = {"outer_diameter": 0.01, "elements": 4, **scene}
    return sg.beam(length=1.0, youngs_modulus=2e11, density=7850.0, **sizes)


def fitted(data: dict[str, Any], **more: Any) -> sg.Fit:
    return sg.fit(SCENE, AMPLITUDE, data, **more)


def starting(t: float) -> float:
    return 1.0 if t < 0.02 else math.nan


VALUES: list[tuple[Callable[[], object], str]] = [
    (lambda: sg.derivative(SCENE, AMPLITUDE, times=[-1.0]), r"times has -1 s; expected times from 0 to .* 0\.5 s"),
    (lambda: sg.derivative(SCENE, AMPLITUDE, times=[0.1, 0.6]), r"times has 0\.6 s; expected times from 0"),
    (lambda: sg.derivative(SCENE, AMPLITUDE, times=[0.2, 0.1]), r"times does not increase: 0\.1 s"),
    (lambda: sg.derivative(SCENE, []), "keys is empty"),
    (lambda: SCENE.run("event").derivative([]), "keys is empty"),
    (lambda: sg.derivative(pair(probes={}), {}), "keys is empty"),
    (lambda: fitted({"start": [0.1, 0.3]}, bounds={"foo": (0.0, 1.0)}), "bounds has 'foo'; expected 'load.1.harmonic"),
    (lambda: fitted({"start": [0.1, 0.3], "wall": "upper"}, error={"force": 1.0}), "error has 'force'; expected kinds"),
    (lambda: fitted({"start": [0.1, 0.3], "wall": "upper"}, error={"impulse": 0.1}), "error has 'impulse'; .* 'start'"),
    (lambda: fitted({"start": [0.1, 0.3], "wall": "upper", "foo": 1}), "data has 'foo'; expected displacement over"),
    (lambda: fitted({"time": [0.1], "displacement": [0.0], "foo": 1}), "data has 'foo'; expected displacement over t"),
    (lambda: fitted({"time": [0.1], "displacement": [0.0], "wall": "upper"}), "data has 'wall' beside displacement"),
    (lambda: fitted({"time": [0.1], "start": [0.1], "wall": "upper"}), "data has 'time' without displacement"),
    (
        lambda: fitted(
            {"time": [0.1], "displacement": [0.0], "start": [0.1], "wall": "roof"},
            error={"displacement": 1e-6, "start": 1e-3},
        ),
        "wall is 'roof'; expected 1 of upper, lower",
    ),
    (lambda: fitted({"start": [0.3, 0.1], "wall": "upper"}), "starts at wall 'upper' do not increase"),
    (lambda: fitted({"time": [0.1, 0.6], "displacement": [0.0, 0.0]}), r"data: time has 0\.6 s"),
    (lambda: fitted({"time": [0.2, 0.1], "displacement": [0.0, 0.0]}), "data: time does not increase"),
    (lambda: fitted({"start": [0.3, 9.0], "wall": "upper"}), "start has 9 s; expected times from 0 to the end of the motion"),
    (lambda: fitted({"approach_speed": [0.3, -0.1], "wall": "upper"}), r"approach_speed is -0\.1 m/s; expected 0 or more"),
    (lambda: fitted({}), "data has nothing; expected"),
    (lambda: fitted({"start": [0.1, 0.3], "wall": "upper"}, error={"start": [1.0] * 3}), r"error of start has the shape"),
    (lambda: pair(walls=[sg.Wall.upper("w", 1.0, at=[(0, 1.0), (0, 2.0)])]), 'wall "w": at is .* once'),
    (lambda: pair(probes={"p": [(1, 1.0), (1, 2.0)]}), 'probe "p": at is .* once'),
    (lambda: sg.chart(SCENE, ["event"], levels=0), "levels is 0; expected 1 or more"),
    (lambda: sg.chart(SCENE, ["event"], repeats=0), "repeats is 0; expected 1 or more"),
    (lambda: sg.chart(SCENE, ["event"], most_seconds=-1.0), r"most_seconds is -1\.0; expected a number above 0"),
    (lambda: sg.stability(SCENE, finest=0.1, coarsest=0.01), r"coarsest is 0\.01; expected at least the finest, 0\.1"),
    (lambda: sg.stability(SCENE, per_decade=-1.0), r"per_decade is -1\.0; expected a number above 0"),
    (lambda: sg.stability(SCENE, contacts=0), "contacts is 0; expected 1 or more"),
    (lambda: sg.bifurcation(CASE, HARMONIC, [5.0], threads=0), "threads is 0; expected 1 or more"),
    (lambda: sg.bifurcation(CASE, HARMONIC, [5.0], settle=-1), "settle is -1; expected 0 or more"),
    (lambda: sg.bifurcation(CASE, HARMONIC, [5.0], keep=2**40), "keep is 1099511627776; expected at most"),
    (lambda: sg.orbit(SCENE, settle=-1), "settle is -1; expected 0 or more"),
    (lambda: pair(modes=1, static_correction=True, walls=[sg.Wall.upper("w", 1.0, at=0, restitution=0.5)]),
     "static correction is true, beside the restitution 0.5 of the wall"),
    (lambda: pair(static_correction=True), "static_correction is True, without modes; expected modes"),
    (lambda: sg.orbit(SCENE, derivative=["initial.velocity.0"]), "expected a key on which orbits depend: none of initial"),
    (lambda: sg.Stepper(SCENE, "moreau-jean", 1e-3).advance(-1.0), r"end is -1\.0; expected a time, 0 or more"),
    (lambda: sg.Load.random(rms=1.0, band=(1.0, 2.0), seed=-1), "seed is -1; expected 0 or more"),
    (lambda: sg.Load.random(psd=[(1.0, math.nan), (2.0, 1.0)]), "load: psd is NaN; expected finite numbers"),
    (lambda: sg.Load.gravity(math.nan), "load: acceleration is NaN"),
    (lambda: sg.Load.base(amplitude=math.inf, frequency=1.0), "load: amplitude is inf"),
    (lambda: beam(elements=-2), "elements is -2; expected 1 or more"),
    (lambda: beam(modes=-1), "modes is -1; expected 1 or more"),
    (lambda: sg.sweep(CASE, {HARMONIC: (4.0, 5.0)}, measures=["contacts"], random="lhs", rows=-1), "rows is -1"),
    (
        lambda: sg.sweep(lambda gap: SCENE, {"gap": [1.0]}, "event"),  # type: ignore[dict-item]
        "points is .* expected a mapping for each point",
    ),
    *(
        (
            lambda name=name: sg.sweep(lambda **_: SCENE, [{name: 1.0}], "event"),
            f"the parameter '{name}', a column of results",
        )
        for name in ("error", "status", "impulse_upper_N_s")
    ),
    (lambda: sg.compare(SCENE, [], step=1e-3), "methods is empty"),
    (lambda: SCENE.run("event").plot(axes=plt.subplots(2)[1]), "^axes has 2; expected three matplotlib axes"),
    (lambda: SCENE.run("event").probe("zz"), 'no probe is named "zz"; there is ""'),
    (lambda: sg.orbit(sg.chain([1.0], [])), "no load is a sine; expected a harmonic load"),
    (lambda: sg.run_many([SCENE, sg.oscillator(1.0, 0.0, 1.0)], "event"), "walls are none; expected upper, lower"),
    (lambda: sg.oscillator(1.0, 0.0, 1.0, loads=[sg.Load.function(abs)]).run("event"), "a table, such as one of values"),
]


@pytest.mark.parametrize("call, message", VALUES, ids=[message for _, message in VALUES])
def test_a_wrong_value_is_refused_by_its_name(call: Callable[[], object], message: str) -> None:
    with pytest.raises(ValueError, match=message):
        call()
    plt.close("all")


# Called with what their types refuse.
sweep: Any = sg.sweep
bifurcation: Any = sg.bifurcation
one_at_a_time: Any = sg.one_at_a_time
tube: Any = sg.tube
support: Any = sg.support
fit: Any = sg.fit

TYPES: list[tuple[Callable[[], object], str]] = [
    (lambda: sg.compare(SCENE, "moreau-jean", step=1e-3), r"methods is 'moreau-jean'; expected a sequence"),
    (lambda: sg.chart(SCENE, "event"), "methods is 'event'; expected a sequence"),
    (lambda: sg.derivative(SCENE, AMPLITUDE[0]), "keys is 'load.1.harmonic.amplitude'; expected a sequence"),
    (lambda: sg.sweep(CASE, {HARMONIC: [5.0]}, measures="contacts"), "measures is 'contacts'; expected a sequence"),
    (lambda: beam(elements=2.5), "elements is 2.5; expected a whole number"),
    (lambda: sg.run_many(SCENE), "scenes is <Scene"),  # type: ignore[arg-type]
    (lambda: sg.wear(TUBE, years="40"), "^years is '40'; expected a number$"),  # type: ignore[arg-type]
    (lambda: sg.wear(TUBE, until_interval="5%"), "^until_interval is '5%'; expected a number"),  # type: ignore[arg-type]
    (lambda: sg.wear(TUBE, most_time="9"), "^most_time is '9'; expected a number"),  # type: ignore[arg-type]
    (lambda: sg.wear(TUBE, step="1e-4"), "^step is '1e-4'; expected a number"),  # type: ignore[arg-type]
    (lambda: sg.wear(TUBE, most_seeds=9.5), "^most_seeds is 9.5; expected a whole number"),  # type: ignore[arg-type]
    (lambda: sg.realisations(TUBE, seeds="4"), "^seeds is '4'; expected a whole number, 1 or more"),  # type: ignore[arg-type]
    (lambda: sg.realisations(TUBE, accuracy="5%"), "^accuracy is '5%'; expected a number"),  # type: ignore[arg-type]
    (lambda: sg.sweep(CASE, {HARMONIC: [5.0]}, measures=["contacts"], seeds="4"), "^seeds is '4'"),  # type: ignore[call-overload]
    (lambda: sg.sweep(starting, [], "event", step="1"), "^step is '1'; expected a number"),  # type: ignore[call-overload]
    (lambda: sg.run_many([SCENE], step="1e-3"), "^step is '1e-3'; expected a number"),  # type: ignore[arg-type]
    (lambda: sg.compare(CASE, ["event"], sample="1e-3"), "^sample is '1e-3'; expected a number"),  # type: ignore[arg-type]
    (lambda: sg.grid(gap=3.0), "gap is 3.0; expected a sequence"),  # type: ignore[arg-type]
    (lambda: support("a", np.array([1, 2])), r"support 'a': gap is array\(\[1, 2\]\); expected a number"),
    (lambda: support("a", "1"), "support 'a': gap is '1'; expected a number"),
    (lambda: support("a", 1.0, centre="0"), "support 'a': centre is '0'; expected a number"),
    (lambda: fit(SCENE, AMPLITUDE, {"start": [0.1, 0.3]}, error=1e-3), "error is 0.001; expected a mapping"),
    (lambda: fit(SCENE, AMPLITUDE, [0.1, 0.3]), "data is .*; expected a mapping"),
    (lambda: sweep(starting, pd.DataFrame({"t": [0.0]})), r"points has 't' as point 0; expected .* to_dict\('records"),
    (lambda: sweep(starting, [1e-3]), "points has 0.001 as point 0; expected a mapping for each point"),
    (lambda: sweep(starting, 1e-3), "points is 0.001; expected a mapping for each point"),
    (lambda: bifurcation(CASE, HARMONIC, 5.0), "^values is 5.0; expected a sequence of values"),
    (lambda: sweep(CASE, {HARMONIC: 0.5}, measures=["contacts"]), f"^{HARMONIC} is 0.5; expected a sequence"),
    (
        lambda: one_at_a_time(CASE, {HARMONIC: 0.5}, measures=["contacts"]),
        f"^{HARMONIC} is 0.5; expected its lower and upper bound",
    ),
    (
        lambda: tube(**STEEL, duration=1.0, supports=sg.hole("h", 1e-4)),
        r"^supports is Support\(.*; expected a sequence of what sg.hole, sg.flats and sg.slider make",
    ),
    (lambda: tube(**STEEL, duration=1.0, supports=sg.support("a", 1e-4)), "^supports has Wall.*; expected what"),
    (lambda: tube(**STEEL, duration=1.0, loads=sg.Load.gravity(9.81)), "^loads is .*; expected a sequence of what"),
    (lambda: SCENE.run("event").plot(axes=plt.figure().gca()), "^axes is <Axes.*; expected three matplotlib axes"),
    (lambda: SCENE.run("event").plot(axes="abc"), "^axes is 'abc'; expected three matplotlib axes"),
]


@pytest.mark.parametrize("call, message", TYPES, ids=[message for _, message in TYPES])
def test_a_wrong_type_is_refused_by_its_name(call: Callable[[], object], message: str) -> None:
    with pytest.raises(TypeError, match=message):
        call()
    plt.close("all")


def test_a_force_that_is_no_number_names_its_load_and_the_time() -> None:
    scene = sg.oscillator(1.0, 0.0, 1.0, loads=[sg.Load.function(starting)], duration=0.1)
    with pytest.raises(ValueError, match=r"load <function starting .*: the force at t = 0\.0\d* s is NaN; expected a finite"):
        scene.run("moreau-jean", step=1e-3)
    words = sg.oscillator(1.0, 0.0, 1.0, loads=[sg.Load.function(lambda t: 0.0 if t < 0.02 else "N")], duration=0.1)  # type: ignore[arg-type,return-value]
    with pytest.raises(TypeError, match=r"load <function .*: the force at t = 0\.0\d* s is 'N'; expected a number"):
        words.run("moreau-jean", step=1e-3)


def test_the_results_of_another_request_are_told_in_words(tmp_path: Path) -> None:
    sg.sweep(CASE, {HARMONIC: [4.0, 5.0]}, measures=["contacts"], folder=tmp_path / "rows")
    with pytest.raises(OSError, match=r"\[4\.0, 5\.0\]") as caught:
        sg.sweep(CASE, {HARMONIC: [4.0, 6.0]}, measures=["contacts"], folder=tmp_path / "rows")
    assert "KeyValue" not in str(caught.value)


def test_what_is_given_is_shown() -> None:
    assert repr(sg.Load.harmonic(1.0, 2.0, direction=30.0)) == "Load.harmonic(1.0, 2.0, 0.0, direction=30.0)"
    assert eval(repr(sg.Load.constant(1.0, direction=30.0)), {"Load": sg.Load}) == sg.Load.constant(1.0, direction=30.0)
    assert repr(sg.hole("h", 2e-4, radius=0.01)) == "Support(name='h', shape='round', gap=0.0002, radius=0.01)"
    flow = sg.turbulence(band=(5.0, 150.0), correlation_length=0.06, spectrum=[(1.0, 1.0)])
    assert repr(flow).startswith("Turbulence(direction='both', spectrum=[(1.0, 1.0)], from=5.0, to=150.0")
    run = sg.load("whirl-in-a-hole", set={"time.end": 0.02}).run()
    assert "sectors" not in repr(run.supports["hole"])


def test_a_hole_has_the_radius_of_what_wears_in_it() -> None:
    case = sg.case({
        "system": {"planes": 2, "oscillator": {"mass": 1.0, "damping": 2.0, "stiffness": 1000.0}},
        "support": [sg.hole("h", 1e-3, stiffness=1e6, friction=0.2, width=0.02, radius=0.01)],
        "load": [sg.Load.harmonic(12.0, 5.0, direction=10.0)],
        "wear": sg.Archard(1e-14, years=1.0),
        "time": {"end": 0.2, "step": 1e-4},
    })  # fmt: skip
    assert case.run().wear["h"].depth_one_scar is not None


MISSPELT: list[tuple[Callable[[], object], str]] = [
    (lambda: sg.oscillator(1.0, 0.2, 100.0, plane=2), "^oscillator has no argument plane; expected mass, damping, "),  # type: ignore[call-arg]
    (lambda: sg.oscillator(1.0, 0.2, 100.0, planes=2), "^oscillator has no argument planes; expected sg.tube, or sg.case"),  # type: ignore[call-arg]
    (lambda: pair(planes=2), "^chain has no argument planes; expected sg.tube, or sg.case"),
    (lambda: beam(planes=2), "^beam has no argument planes; expected sg.tube, or sg.case"),
    (lambda: sg.matrices([[1.0]], None, [[1.0]], planes=2), "^matrices has no argument planes; expected sg.tube"),  # type: ignore[call-arg]
    (lambda: sg.modal([1.0], {"tip": [1.0]}, planes=2), "^modal has no argument planes; expected sg.tube"),  # type: ignore[call-arg]
    (lambda: sg.oscillator(1.0, 0.2, 100.0, wall=[]), "^oscillator has no argument wall; did you mean walls"),  # type: ignore[call-arg]
    (lambda: pair(ground=(1.0, 0.0)), "^chain has no argument ground; did you mean grounds"),
    (lambda: beam(inner_diametre=0.005), "^beam has no argument inner_diametre; did you mean inner_diameter"),
    (lambda: sg.matrices([[1.0]], None, [[1.0]], modus=1), "^matrices has no argument modus; did you mean modes"),  # type: ignore[call-arg]
    (lambda: sg.modal([1.0], {"tip": [1.0]}, ratio=0.01), "^modal has no argument ratio; did you mean ratios"),  # type: ignore[call-arg]
    (lambda: sg.support("stop", 1e-3, restituton=0.5), "^support has no argument restituton; did you mean restitution"),  # type: ignore[call-arg]
    (lambda: sg.hole("plate", 1e-4, frction=0.2), "^hole has no argument frction; did you mean friction"),  # type: ignore[call-arg]
    (lambda: sg.slider("pad", normalforce=1.0), "^slider has no argument normalforce; did you mean normal_force"),  # type: ignore[call-arg]
    (lambda: sg.turbulence(densty=740.0), "^turbulence has no argument densty; did you mean density"),  # type: ignore[call-arg]
    (lambda: sg.tube(**STEEL, duraton=1.0), "^tube has no argument duraton; did you mean duration"),  # type: ignore[call-arg]
]  # fmt: skip


@pytest.mark.parametrize("wrong, message", MISSPELT)
def test_a_misspelt_keyword_is_refused_by_the_name_of_the_builder(wrong: Callable[[], object], message: str) -> None:
    with pytest.raises(TypeError, match=message):
        wrong()


def test_every_keyword_of_a_scene_is_known_to_its_builder() -> None:
    options: dict[str, Any] = {"walls": [], "loads": [], "probes": {}, "displacement": 0.0, "velocity": 0.0}
    assert sg.oscillator(mass=1.0, damping=0.2, stiffness=100.0, duration=2.0, **options).duration == 2.0
    assert sg.chain([1.0, 1.0], springs=[1e4], damping=0.01, modes=1, static_correction=False).degrees_of_freedom == 1


def test_complex_and_masked_numbers_are_refused_rather_than_read_in_part() -> None:
    masked = np.ma.masked_greater([1.0, 5.0], 3.0)
    calls: list[tuple[Callable[[], object], type[Exception], str]] = [
        (lambda: sg.modal([1.0, 2.0], {"tip": np.array([1.0 + 1.0j, 2.0])}), TypeError, "'tip' has complex numbers"),
        (lambda: sg.modal(np.array([1.0, 2.0j]), {"tip": [1.0, 2.0]}), TypeError, "frequencies has complex numbers"),
        (lambda: sg.Load.table([0.0, 1.0], np.array([1.0 + 1.0j, 2.0])), TypeError, "expected real numbers"),
        (lambda: sg.matrices(np.eye(2), None, np.ma.masked_greater(np.diag([1.0, 5.0]), 3.0)), ValueError, "stiffness matrix has masked entries"),
        (lambda: sg.modal(masked, {"tip": [1.0, 2.0]}), ValueError, "frequencies has masked entries"),
    ]
    for call, error, words in calls:
        with pytest.raises(error, match=words):
            call()


def test_a_case_takes_any_text() -> None:
    system = {"oscillator": {"mass": 1.0, "damping": 0.0, "stiffness": 1.0}}
    case = sg.case({"title": "\U0001d714 \u00fc \"quoted\"", "system": system, "time": {"end": 1.0, "step": 0.1}})
    assert case.title == "\U0001d714 \u00fc \"quoted\""


def test_a_scene_is_made_with_its_output_times() -> None:
    made = sg.oscillator(1.0, 0.0, 100.0, displacement=1.0, output_times=[0.25, 0.5])
    assert made == sg.oscillator(1.0, 0.0, 100.0, displacement=1.0).replace(output_times=[0.25, 0.5])
