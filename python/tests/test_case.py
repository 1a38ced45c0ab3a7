"""Cases made in Python are those of case files, to the last bit."""

import copy
import pickle
import tomllib
from pathlib import Path
from typing import Any

import numpy as np
import pytest

import signorini as sg

CASES = Path(__file__).parents[2] / "cases"
TUBE: dict[str, Any] = {
    "length": 3.0,
    "youngs_modulus": 2e11,
    "density": 7850.0,
    "outer_diameter": 19.05e-3,
    "inner_diameter": 15.75e-3,
    "added_mass": 0.565,
    "elements": 60,
    "modes": 20,
    "damping": 0.01,
    "duration": 5.0,
    "step": 5e-5,
    "sample": 5e-4,
    "statistics_from": 1.0,
}
LOADS = [sg.Load.random(rms=3.0, band=(1.0, 100.0), seed=1, at=x, direction="both") for x in (0.5, 2.3)]



def test_a_case_goes_to_another_process_with_its_files(tmp_path: Path) -> None:
    (tmp_path / "push.csv").write_text("time_s,force_N\n0.0,0.0\n0.1,5.0\n0.2,0.0\n")
    (tmp_path / "pushed.toml").write_text(
        "[system.oscillator]\nmass = 1.0\ndamping = 0.2\nstiffness = 100.0\n[[wall]]\nname = 'stop'\nside = 'upper'\n"
        "position = 5e-3\nrestitution = 0.5\n[[load]]\ntable = { file = 'push.csv' }\n[time]\nend = 0.2\nstep = 1e-3\n"
    )
    case = sg.load(tmp_path / "pushed.toml", set={"wall.stop.position": 4e-3})
    packed = pickle.dumps(case)
    (tmp_path / "push.csv").unlink()
    for again in (pickle.loads(packed), copy.deepcopy(case)):
        assert (again.name, again.text) == (case.name, case.text) and again.scene == case.scene
        assert again.run().contacts.tobytes() == case.run().contacts.tobytes()


def tube(**other: Any) -> sg.Case:
    return sg.tube(**{**TUBE, **other})


@pytest.mark.parametrize("name", sorted(path.stem for path in CASES.glob("*.toml")))
def test_the_mapping_of_a_file_is_its_case(name: str, monkeypatch: pytest.MonkeyPatch) -> None:
    # The files that cases name are found there.
    monkeypatch.chdir(CASES)
    text = (CASES / f"{name}.toml").read_text(encoding="utf-8")
    made, read = sg.case(tomllib.loads(text), name=name), sg.load(name)
    assert made.scene == read.scene
    assert (made.name, made.title) == (name, read.title)
    assert (made.step, made.sample, made.statistics_from) == (read.step, read.sample, read.statistics_from)
    assert tomllib.loads(made.text) == tomllib.loads(text)


def test_a_tube_in_holes_is_the_case_of_the_file() -> None:
    plates = [
        sg.hole("plate-1", 0.2e-3, at=1.0, restitution=0.5, friction=0.2, width=25e-3),
        sg.hole("plate-2", 0.2e-3, at=2.0, centre=(0.1e-3, 0.0), restitution=0.5, friction=0.2, width=25e-3),
    ]
    wear = sg.Archard(1e-14, 1e-14, service=3.156e8)
    made = tube(supports=plates, loads=LOADS, wear=wear, duration=0.3, statistics_from=0.1)
    read = sg.load("tube-round-supports", set={"time.end": 0.3, "time.statistics_from": 0.1})
    assert made.scene == read.scene
    ours, theirs = made.run(), read.run()
    for name, column in theirs.columns.items():
        np.testing.assert_array_equal(ours.columns[name], column, strict=True)
    assert ours.wear == theirs.wear and set(ours.wear) == {"plate-1", "plate-2"}


def test_a_tube_between_flats_is_the_case_of_the_file() -> None:
    bars = [
        sg.flats("bars-1", 0.2e-3, sides=4, at=1.0, restitution=0.5),
        sg.flats("bars-2", 0.2e-3, sides=4, turn=45, at=2.0, centre=(0.1e-3, 0.0), restitution=0.5),
    ]
    assert tube(supports=bars, loads=LOADS).scene == sg.load("tube-lattice-bars").scene
    named = sg.flats("bars-1", [0.2e-3] * 4, [0, 90, 180, 270], at={"joint": 1}, restitution=0.5)
    spans = tube(length=None, spans=[1.0, 1.0, 1.0], supports=[named, bars[1]], loads=LOADS)
    assert spans.scene.walls == tube(supports=bars, loads=LOADS).scene.walls


def test_loads_and_ends_become_what_a_file_says(tmp_path: Path) -> None:
    quake = tmp_path / "quake.csv"
    quake.write_text("t,a\n0,0\n0.1,1\n0.2,0\n", encoding="utf-8")
    loads = [
        sg.Load.constant(1.0, at=0.5, direction=30.0),
        sg.Load.harmonic(2.0, 25.0, 0.1, at=(0.5, 1.0), direction=0.0),
        sg.Load.impulse(0.1, 0.01, at=1.5, direction=90.0),
        sg.Load.random(psd=[(1.0, 0.5), (40.0, 0.3)], at=0.5, direction=10.0),
        sg.Load.base(quake, time="t", acceleration="a", scale=9.80665, direction=90.0),
    ]
    table = tomllib.loads(tube(left=(1e6, 10.0), right="clamped", damping=[0.01, 0.02], loads=loads, duration=1.5).text)
    assert table["load"] == [
        {"at": {"position": 0.5}, "direction": 30.0, "constant": {"force": 1.0}},
        {"at": {"spread": [0.5, 1.0]}, "direction": 0.0, "harmonic": {"amplitude": 2.0, "frequency": 25.0, "phase": 0.1}},
        {"at": {"position": 1.5}, "direction": 90.0, "impulse": {"impulse": 0.1, "time": 0.01}},
        {"at": {"position": 0.5}, "direction": 10.0, "random": {"psd": [[1.0, 0.5], [40.0, 0.3]], "seed": 0}},
        {"direction": 90.0, "base": {"file": str(quake), "time": "t", "acceleration": "a", "scale": 9.80665}},
    ]
    beam = table["system"]["beam"]
    assert (beam["left"], beam["right"]) == ({"stiffness": 1e6, "rotational": 10.0}, "clamped")
    assert table["system"]["damping"] == {"ratios": [0.01, 0.02]}


def test_forty_years_are_those_of_365_and_a_quarter_days() -> None:
    plate = sg.hole("plate", 2e-4, at=1.0)
    text = tube(supports=[plate], wear=sg.Archard(1e-14, years=40)).text
    assert tomllib.loads(text)["wear"] == {"coefficient": 1e-14, "service": 40 * 365.25 * 24 * 3600}


HOLE: dict[str, Any] = {"name": "plate", "gap": 2e-4, "at": 1.0}


@pytest.mark.parametrize(
    "wrong, message",
    [
        ({"supports": [sg.hole("plate", 0.0, at=1.0)]}, "a number above 0, in m: the radius of the hole less"),
        ({"supports": [sg.hole("plate", 2e-4)]}, "plate"),
        ({"supports": [sg.hole("plate", 2e-4, at=4.0)]}, "4"),
        ({"supports": [sg.hole(**HOLE, friction=11.0)]}, "0 to 10"),
        ({"supports": [sg.hole(**HOLE, friction={"static": 0.1, "kinetic": 0.2})]}, "at least the kinetic coefficient"),
        ({"supports": [sg.hole(**HOLE, friction={"static": 0.1})]}, "no kinetic coefficient"),
        ({"supports": [sg.hole(**HOLE, centre=(1e-4,))]}, "two numbers in m"),
        ({"supports": [sg.hole(**HOLE), sg.hole(**HOLE)]}, "a name of its own for each support"),
        ({"supports": [sg.hole(**HOLE, restitution=0.5, stiffness=1e6)]}, "restitution"),
        ({"supports": [sg.flats("bars", 2e-4, at=1.0)]}, "directions"),
        ({"supports": [sg.flats("bars", [2e-4], sides=4, at=1.0)]}, "4"),
        ({"loads": [sg.Load.constant(1.0, at=0.5)]}, "direction"),
        ({"loads": [sg.Load.constant(1.0, at=0.5, direction="both")]}, "both"),
        ({"loads": [sg.Load.random(rms=3.0, at=0.5, direction="both")]}, "from"),
        ({"loads": [sg.Load.random(rms=3.0, band=(1, 9), psd=[(1, 1), (2, 1)], at=0.5, direction=0)]}, "psd"),
        ({"loads": [sg.Load.table([0.0, 1.0], [0.0, 1.0], at=0.5)]}, "expected a load that a case file describes"),
        ({"loads": [sg.Load.base("nowhere.csv", direction=0.0)]}, "no such file"),
        ({"supports": [sg.hole(**HOLE)], "wear": sg.Archard(1e-14, years=1, service=1.0)}, "expected one of the two"),
        ({"wear": sg.Archard(1e-14, years=1)}, "without a support"),
        ({"spans": [1.0, 2.0]}, "spans"),
        ({"step": 0.0}, "step"),
    ],
)
def test_a_tube_that_makes_no_sense_is_refused(wrong: dict[str, Any], message: str) -> None:
    with pytest.raises(ValueError, match="expected") as refused:
        tube(**wrong)
    assert message in str(refused.value)


def test_other_values_are_refused() -> None:
    with pytest.raises(TypeError, match="title is <object .*; expected a number, a text"):
        sg.case({"title": object()})
    with pytest.raises(TypeError, match="tables is 'bouncing-ball'; expected a mapping .*; load reads a case by name"):
        sg.case("bouncing-ball")  # type: ignore[arg-type]
    with pytest.raises(TypeError, match="expected a number of degrees"):
        sg.Load.constant(1.0, direction=[1.0])  # type: ignore[arg-type]
    with pytest.raises(ValueError, match="load 1: kind is random; expected a case"):
        sg.oscillator(1.0, 0.0, 1.0, loads=[sg.Load.random(rms=1.0, band=(1.0, 2.0))])
    with pytest.raises(ValueError, match="load 1: direction is given; expected a case"):
        sg.oscillator(1.0, 0.0, 1.0, loads=[sg.Load.constant(1.0, direction=0.0)])


def test_texts_survive() -> None:
    title = 'a "quoted" title, µm, and a \\ backslash'
    tables = {**tomllib.loads(sg.load("bouncing-ball").text), "title": title}
    assert sg.case(tables).title == title


def test_supports_have_statistics_with_types() -> None:
    run = sg.load("whirl-in-a-hole").run()
    assert list(run.supports) == ["hole"] and run.wear == {}
    hole = run.supports["hole"]
    # The closed form of the case; the midpoint rule on the circle is 7e-7 off.
    assert abs(hole.work_rate.value - 1.109652491907) < 1e-6
    assert hole.force_mean is not None and abs(hole.force_mean.value - 7.064267168) < 1e-5
    # Pressed round the hole without a rest: it slides all the time, and of some 20 000 steps the
    # first two count as an impact.
    assert hole.impact_share is not None and 0.0 < hole.impact_share < 2e-4
    assert abs(hole.contact_time_ratio - 1.0) < 1e-3
    assert hole.sliding_speed is not None
    assert abs(hole.work_rate.value / (hole.force_mean.value * hole.sliding_speed) - 1.0) < 1e-3
    # The parts make the whole, but for the rounding of their sum.
    assert abs(hole.sectors["work_rate"].sum() / hole.work_rate.value - 1.0) < 1e-12
    assert (hole.work_rate.kind is None) == (hole.work_rate.half_width is None)
    with pytest.raises(AttributeError):
        hole.contacts = 0  # type: ignore[misc]
    with pytest.raises(TypeError):
        run.supports["hole"] = hole  # type: ignore[index]
    assert sg.load("rigid-walls-sine", set={"time.end": 0.1}).run().supports == {}


def test_wear_follows_work() -> None:
    case = sg.load("tube-round-supports", set={"time.end": 1.0, "time.statistics_from": 0.2, "support.plate-1.coefficient": 2e-14})
    run = case.run()
    for name, coefficient in [("plate-1", 2e-14), ("plate-2", 1e-14)]:
        # V = k W T, and the depth all round V / (2π R w) of that tube and plate.
        volume = coefficient * run.supports[name].work_rate.value * 3.156e8
        wear = run.wear[name]
        assert wear.volume is not None and wear.depth_all_round is not None and wear.depth_one_scar is not None
        assert abs(wear.volume / volume - 1.0) < 1e-12
        assert abs(wear.depth_all_round / (volume / (2 * np.pi * 9.525e-3 * 25e-3)) - 1.0) < 1e-12
        assert wear.depth_one_scar > wear.depth_all_round
    # Another scene of the case keeps its laws of wear.
    shorter = case.scene.replace(duration=0.5).run(step=5e-5)
    assert set(shorter.wear) == set(run.wear)


def test_a_tube_in_a_turbulent_flow_is_the_case_of_the_file() -> None:
    plates = [
        sg.hole("plate-1", 0.2e-3, at={"joint": 1}, restitution=0.5, friction=0.2, width=25e-3),
        sg.hole("plate-2", 0.2e-3, at={"joint": 2}, centre=(0.1e-3, 0.0), restitution=0.5, friction=0.2, width=25e-3),
    ]
    flow = sg.turbulence(
        density=740.0,
        velocity=[(0.0, 3.0), (1.0, 3.0), (1.2, 1.5), (3.0, 1.5)],
        reduced=[(0.01, 0.05), (0.2, 0.0112), (3.0, 8.6e-7)],
        band=(5.0, 150.0),
        correlation_length=0.06,
        seed=1,
    )
    wear = sg.Archard(1e-14, 1e-14, years=40, limit=0.4)
    own = {"length": None, "spans": [1.0] * 3, "duration": 0.3, "statistics_from": 0.1}
    made = tube(supports=plates, loads=[flow], wear=wear, **own)
    read = sg.load("tube-in-cross-flow", set={"time.end": 0.3, "time.statistics_from": 0.1})
    assert made.scene == read.scene
    ours, theirs = made.run(), read.run()
    for name, column in theirs.columns.items():
        np.testing.assert_array_equal(ours.columns[name], column, strict=True)
    with pytest.raises(ValueError, match="correlation_length is 0.0"):
        tube(loads=[sg.turbulence(spectrum=[(1.0, 1.0), (2.0, 1.0)], band=(1.0, 2.0), correlation_length=0.0)])


def test_margins_of_a_tube_in_a_flow_are_those_of_the_case_and_warn() -> None:
    plates = [sg.hole(f"plate-{i}", 0.2e-3, at=float(i), restitution=0.5) for i in (1, 2)]

    def flow(velocity: float) -> sg.Turbulence:
        return sg.turbulence(
            density=740.0, velocity=velocity, reduced=[(0.01, 0.05), (0.2, 0.0112), (3.0, 8.6e-7)],
            band=(5.0, 50.0), correlation_length=0.06,
        )  # fmt: skip

    own = {"supports": plates, "connors": 3.0, "modes": 3, "duration": 0.3, "statistics_from": 0.1}
    slow = tube(loads=[flow(0.5)], **own)
    found = slow.fluid_elastic
    assert found is not None and found.connors == 3.0 and len(found.inactive) == len(found.active) == 3
    # Closed forms: modes of 4.05987 Hz free and of 36.53886 Hz held at 1 and 2 m.
    assert found.inactive[0].critical_velocity == pytest.approx(0.126627, rel=1e-5)
    assert found.active[0].critical_velocity == pytest.approx(1.139646, rel=1e-4)
    assert found.active[0].margin == pytest.approx(1.139646 / 0.5, rel=1e-4)
    assert any("no support active" in note for note in slow.notes)
    with pytest.warns(sg.ResultWarning, match="work rates mean nothing"):
        tube(loads=[flow(1.5)], **own).run()
    # Of a sweep, its rows say so, and whether the case itself is stable does not matter.
    with pytest.warns(sg.ResultWarning, match="1 of 2 rows is beyond the fluid-elastic limit.*row 1"):
        swept = sg.sweep(slow, {"turbulence.1.velocity": [0.5, 1.5]}, measures=["work_rate"])
    assert swept["error"][0] is None and "margin 0.760" in swept["error"][1]
    still = tube(loads=[flow(0.0)], **own).fluid_elastic
    assert still is not None and still.active[0].margin == float("inf")
    assert tube(supports=plates, loads=LOADS).fluid_elastic is None
    with pytest.raises(ValueError, match="connors is 0.0"):
        tube(loads=[flow(0.5)], **{**own, "connors": 0.0})
    several = sg.load("two-tubes", set={"flow.connors": 3.0}).fluid_elastic
    assert several is not None and {one.bodies for one in several.inactive} == {("left",), ("right",)}
    assert ("left", "right") in {one.bodies for one in several.active}


def test_a_load_stands_on_one_of_several_bodies() -> None:
    place = {"body": "a", "dof": 0}
    body = {"mass": 1.0, "damping": 0.0, "stiffness": 100.0}
    tables = {
        "body": [{"name": name, "oscillator": body} for name in ("a", "b")],
        "load": [sg.Load.constant(2.0, at=place)],
        "wall": [{"name": "w", "at": place, "side": "upper", "position": 1.0, "restitution": 0.5}],
        "time": {"end": 0.1, "step": 1e-3},
    }
    made = sg.case(tables)
    assert tomllib.loads(made.text)["load"] == [{"constant": {"force": 2.0}, "at": place}]
    assert repr(sg.Load.constant(2.0, at=place)) == 'Load.constant(2.0, at={"body": "a", "dof": 0})'
    with pytest.raises(ValueError, match="a place of sg.case"):
        sg.oscillator(mass=1.0, damping=0.0, stiffness=100.0, loads=[sg.Load.constant(2.0, at=place)])


def test_a_shaken_tube_under_its_weight_is_the_case_of_these_keys() -> None:
    loads = [sg.Load.base(amplitude=2.0, frequency=5.0, phase=0.1, direction=0.0), sg.Load.gravity(9.81, direction=270.0)]
    made = tube(loads=loads, duration=0.1, statistics_from=0.0)
    written = tomllib.loads(made.text)["load"]
    assert written == [
        {"base": {"amplitude": 2.0, "frequency": 5.0, "phase": 0.1}, "direction": 0.0},
        {"gravity": {"acceleration": 9.81}, "direction": 270.0},
    ]
    assert made.scene == sg.case(tomllib.loads(made.text)).scene
    with pytest.raises(ValueError, match="base has no motion"):
        tube(loads=[sg.Load.base(direction=0.0)])


def test_a_random_motion_of_the_base_has_realisations() -> None:
    def shaken(seed: int) -> sg.Case:
        plate = sg.hole("plate-1", 0.2e-3, at=1.0, restitution=0.5)
        motion = sg.Load.base(rms=20.0, band=(5.0, 60.0), seed=seed, direction=90.0)
        return tube(supports=[plate], loads=[motion], duration=0.5, statistics_from=0.1)

    means = sg.realisations(shaken(3), seeds=2)
    forces = [shaken(seed).run().supports["plate-1"].force_mean for seed in (3, 4)]
    found = means.supports["plate-1"]["force_mean"].value
    # A mean of two numbers.
    assert found > 0 and found == pytest.approx(sum(force.value for force in forces if force) / 2, rel=1e-14)


def test_a_slider_stops_a_released_mass_where_the_spring_pulls_less_than_it_holds() -> None:
    system = {"oscillator": {"mass": 1.0, "damping": 0.0, "stiffness": 1e4}}
    tables = {
        "system": system, "slider": [sg.slider("pad", 10.0, 0.1)],
        "initial": {"displacement": 0.85e-3}, "time": {"end": 0.15, "step": 1e-4},
    }  # fmt: skip
    case = sg.case(tables)
    # Each half swing loses 2 μN/k = 0.2 mm; 3.6 mm of sliding under 10 N in 0.15 s.
    run = case.run("located")
    assert abs(run.displacement[-1] - 0.05e-3) < 2e-8
    assert abs(run.supports["pad"].work_rate.value - 0.24) < 1e-5
    assert (case.scene.degrees_of_freedom, case.scene.probes) == (1, ("",))
    # Another start of the same scene, and values that make no slider.
    again = case.scene.replace(displacement=0.05e-3)
    assert again.run("located", step=1e-4).displacement[-1] == 0.05e-3
    with pytest.raises(ValueError, match='slider "pad": normal_force is -1'):
        sg.case({**tables, "slider": [sg.slider("pad", -1.0, 0.1)]})


def test_bodies_touch_each_other_in_python_as_in_files() -> None:
    # Two free carts of 1 kg and 3 kg at 2 m/s and at rest: with restitution 1/2 they leave with
    # -1/4 and 3/4 m/s.
    cart = {"damping": 0.0, "stiffness": 0.0}
    places = {name: {"body": name, "dof": 0} for name in ("left", "right")}
    carts = sg.case(
        {
            "body": [
                {"name": "left", "oscillator": {"mass": 1.0, **cart}},
                {"name": "right", "oscillator": {"mass": 3.0, **cart}},
            ],
            "wall": [
                {
                    "name": "touch",
                    "side": "upper",
                    "position": 0.5,
                    "restitution": 0.5,
                    "at": {**places["left"], "relative_to": places["right"]},
                }
            ],
            "probe": [{"name": name, "at": at} for name, at in places.items()],
            "initial": {"velocity": {"left": 2.0}},
            "time": {"end": 1.0, "step": 1e-3},
        }
    )
    run = carts.run()
    speeds = [run.probe(name)[1][-1] for name in ("left", "right")]
    # Some roundings of 2 m/s.
    np.testing.assert_allclose(speeds, [-0.25, 0.75], atol=1e-14)


def test_a_hole_may_surround_the_motion_relative_to_another_body() -> None:
    rod = {"mass": 0.5, "damping": 2.0, "stiffness": 2e4}
    at = {"body": "rod", "dof": 0, "relative_to": {"body": "sleeve", "dof": 0}}
    pair = sg.case(
        {
            "system": {"planes": 2},
            "body": [{"name": name, "oscillator": rod} for name in ("rod", "sleeve")],
            "support": [sg.hole("gap", 1e-3, at=at, friction=0.2)],
            "initial": {"velocity": {"y": {"rod": 1.0}}},
            "time": {"end": 0.05, "step": 1e-4},
        }
    )
    run = pair.run()
    assert len(run.contacts) > 0
