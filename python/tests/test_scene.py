"""Scenes: built, changed, compared, pickled, read from files."""

import copy
import pickle
from pathlib import Path

import numpy as np
import pytest
import scipy.sparse

import signorini as sg


def tube(restitution: float = 0.5, **scene: object) -> sg.Scene:
    """A steel tube of three spans in two loose supports."""
    options = {"duration": 0.05} | scene
    return sg.beam(
        length=3.0,
        youngs_modulus=2e11,
        density=7850.0,
        outer_diameter=19.05e-3,
        inner_diameter=15.75e-3,
        added_mass=0.565,
        elements=30,
        walls=sg.support("first", 2e-4, at=1.0, restitution=restitution)
        + sg.support("second", 2e-4, at=2.0, restitution=restitution),
        loads=[sg.Load.harmonic(10.0, 25.0, at=0.5)],
        probes={"mid": 1.5},
        **options,  # type: ignore[arg-type]
    )


def scenes() -> list[sg.Scene]:
    stop = sg.Wall.upper("stop", 1e-3, stiffness=1e5, damping=3.0, at=[(1, 1.0), (0, -1.0)])
    return [
        sg.oscillator(1.0, 0.2, 100.0, loads=[sg.Load.table([0.0, 0.1], [0.0, 1 / 3]), sg.Load.impulse(0.5, 0.2)]),
        sg.chain([2.0, 2.0], [1e4], grounds=(3e4, 0.0), walls=[stop], damping=sg.Rayleigh(0.1, 1e-5)),
        sg.bar(length=1.0, area=1e-4, youngs_modulus=2e11, density=7850.0, elements=20, left="fixed", damping=0.01),
        tube(),
        tube(modes=20, damping=0.01),
        tube(1.0, modes=8, static_correction=True),
        sg.modal([12.0, 48.0], {"tip": [1.0, -1.0], "base": [0.2, 0.1]}, walls=sg.support("s", 1e-3, at="tip")),
    ]


@pytest.mark.parametrize("made", scenes(), ids=repr)
def test_scenes_are_equal_by_value_and_survive_pickling(made: sg.Scene) -> None:
    back = pickle.loads(pickle.dumps(made))
    assert back == made == copy.copy(made) and pickle.dumps(back) == pickle.dumps(made)
    assert made != made.replace(duration=0.123)
    assert str(back) == str(made)
    # What comes back is the whole scene: a change of it goes through the same places.
    assert back.replace(duration=0.2) == made.replace(duration=0.2)


def test_a_beam_has_diameters_or_the_sides_of_a_rectangle() -> None:
    def beam(**section: float) -> sg.Scene:
        return sg.beam(length=1.0, youngs_modulus=2e11, density=7850.0, elements=20, **section)  # type: ignore[arg-type]

    made = beam(width=0.05, height=0.02)
    assert pickle.loads(pickle.dumps(made)) == made != beam(width=0.02, height=0.05)
    for section, said in [
        ({}, "outer_diameter is missing"),
        ({"width": 0.05}, "height is missing"),
        ({"height": 0.02}, "width is missing"),
        ({"height": 0.02, "outer_diameter": 0.02}, "of a tube and of a rectangle"),
        ({"width": 0.05, "height": -0.02}, "height is -0.02"),
    ]:
        with pytest.raises(ValueError, match=said):
            beam(**section)


def test_a_structure_by_matrices_is_the_same_dense_or_sparse() -> None:
    n = 6
    mass = np.diag(np.linspace(1.0, 2.0, n))
    stiffness = 1e4 * (np.diag(np.full(n, 2.0)) - np.diag(np.ones(n - 1), 1) - np.diag(np.ones(n - 1), -1))
    walls = [sg.Wall.upper("stop", 1e-4, restitution=0.5, at=n - 1)]
    velocity = np.eye(n)[n - 1]
    dense = sg.matrices(mass, 1e-4 * stiffness, stiffness, walls=walls, velocity=velocity)
    sparse = sg.matrices(
        scipy.sparse.csr_array(mass), scipy.sparse.csc_array(1e-4 * stiffness), scipy.sparse.coo_matrix(stiffness),
        walls=walls, velocity=velocity,
    )  # fmt: skip
    assert sparse == dense
    # The same as a chain of springs to the ground at both ends.
    chain = sg.chain(np.diag(mass), np.full(n - 1, 1e4), grounds=(1e4, 1e4), walls=walls, velocity=velocity)
    same = chain.replace(damping=sg.Rayleigh(0.0, 1e-4)).run("event", sample=0.1)
    assert dense.run("event", sample=0.1).impulse("stop") == pytest.approx(same.impulse("stop"), rel=1e-9)


def test_massless_degrees_of_freedom_are_condensed() -> None:
    # Two springs in series, the point between them without mass: 1/(1/k₁ + 1/k₂) = 50 N/m.
    mass, stiffness = np.diag([0.0, 1.0]), np.array([[200.0, -100.0], [-100.0, 100.0]])
    made = sg.matrices(mass, None, stiffness, velocity=[0.0, 1.0], probes={"tip": 1})
    assert made.degrees_of_freedom == 1
    run = made.run("event")
    omega = np.sqrt(50.0)
    np.testing.assert_allclose(run.displacement, np.sin(omega * run.time) / omega, atol=1e-12)


def test_a_place_on_a_beam_is_a_position() -> None:
    # A static force at midspan of a pinned beam sags it by F L³/(48 E I) there; Hermite elements
    # are exact at nodes. After 3 s the damping of 50 per second has left nothing of the swing.
    made = tube(damping=sg.Rayleigh(50.0, 0.0), duration=3.0).replace(walls=[], loads=[sg.Load.constant(1.0, at=1.5)])
    inertia = np.pi / 64 * (19.05e-3**4 - 15.75e-3**4)
    sag = 3.0**3 / (48 * 2e11 * inertia)
    run = made.replace(modes=10).run("moreau-jean", step=1e-3)
    # The tenth mode and beyond hold some 1e-4 of the sag.
    assert run.displacement[-1] == pytest.approx(sag, rel=1e-3)


def test_a_reduced_scene_keeps_its_whole() -> None:
    reduced = tube(modes=5, damping=0.01)
    assert reduced.degrees_of_freedom == 5
    more = reduced.replace(modes=12)
    assert more == tube(modes=12, damping=0.01) and more.walls == reduced.walls
    assert reduced.replace(walls=sg.support("only", 1e-4, at=1.5)).walls[0].name == "only-upper"


def test_cases_are_read_and_changed(tmp_path: Path) -> None:
    case = sg.load("rigid-walls-sine", set={"wall.*.restitution": 0.8, "time.end": 2.0, "time.step": 1e-3})
    assert [wall.restitution for wall in case.scene.walls] == [0.8, 0.8]
    assert (case.name, case.scene.duration, case.step) == ("rigid-walls-sine", 2.0, 1e-3)
    path = tmp_path / "mine.toml"
    path.write_text(case.text)
    again = sg.load(path)
    assert again.scene == case.scene
    np.testing.assert_array_equal(again.run().displacement, case.run().displacement)
    tubes = sg.load("tube-loose-supports")
    assert tubes.scene.replace(modes=5).degrees_of_freedom == 5


def test_a_wall_shows_how_it_is_made() -> None:
    for wall in [
        sg.Wall.upper("a", 1e-3, restitution=0.5),
        sg.Wall.lower("b", -1e-3, stiffness=1e4, damping=2.0, at=3),
        sg.Wall.upper("c", 0.0, at=[(1, 1.0), (0, -1.0)]),
        sg.Wall.upper("d", 0.0, at="tip"),
    ]:
        assert eval(f"sg.{wall!r}") == wall


def test_every_built_in_case_is_a_scene_that_can_be_pickled() -> None:
    with pytest.raises(ValueError) as told:
        sg.load("none-of-them")
    names = str(told.value).split("there is ")[1].split(", ")
    assert len(names) > 12
    for name in names:
        made = sg.load(name).scene
        assert pickle.loads(pickle.dumps(made)) == made and made.replace(duration=0.5).duration == 0.5
        assert made.walls == made.replace(walls=made.walls).walls


def test_a_scene_in_two_planes_has_rows_for_places() -> None:
    case = sg.load("tube-lattice-bars")
    assert all(isinstance(eval(repr(wall).split("at=")[1][:-1]), list) for wall in case.scene.walls)
    short = case.scene.replace(duration=0.02)
    assert short.run("moreau-jean", step=case.step).notes is not None


def test_turbulence_of_a_case_stays_as_its_scene_is_changed(tmp_path: Path) -> None:
    """The forces of a field follow from modes and duration, which a changed scene may change."""
    text = (
        "[system]\nmodes = 4\n[system.beam]\nspans = [1.0, 2.0]\nyoungs_modulus = 2e11\n"
        "density = 7850.0\nouter_diameter = 0.02\nelements = 20\nleft = 'pinned'\nright = 'pinned'\n"
        "[[turbulence]]\nspectrum = [[1.0, 0.02], [40.0, 0.02]]\nfrom = 1.0\nto = 40.0\n"
        "correlation_length = 0.06\nseed = 3\n[[probe]]\nname = 'joint'\nat = {{ joint = 1 }}\n"
        "[time]\nend = {}\nstep = 1e-3\n"
    )
    (tmp_path / "tube.toml").write_text(text.format(0.5))
    short = sg.load(tmp_path / "tube.toml")
    long = sg.load(tmp_path / "tube.toml", set={"time.end": 1.0})
    changed = pickle.loads(pickle.dumps(short.scene)).replace(duration=1.0)
    assert np.array_equal(
        changed.run("moreau-jean", step=1e-3).displacement,
        long.scene.run("moreau-jean", step=1e-3).displacement,
    )
