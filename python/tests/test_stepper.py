"""One step at a time: co-simulation and control."""

import threading

import numpy as np
import pytest

import signorini as sg


def test_steps_are_those_of_a_run(scene: sg.Scene) -> None:
    run = scene.run("moreau-jean", step=1e-3)
    stepper = sg.Stepper(scene, "moreau-jean", 1e-3)
    impulse = np.zeros(2)
    for row in range(1, 401):
        time = stepper.step()
        impulse += stepper.impulse
        assert time == stepper.time == pytest.approx(run.time[row], rel=1e-12)
        assert stepper.q[0] == run.displacement[row] and stepper.v[0] == run.velocity[row]
    # The same impulses, summed in the same order.
    np.testing.assert_array_equal(impulse, [run.contact_impulse(name)[:401].sum() for name in run.walls])


def test_a_force_from_python_is_a_force() -> None:
    # A dashpot of 2 N s/m by the force of each step: m v̇ = −2 v, held over a step of 1e-3 s, so
    # that the speed is (1 − 2e-3)ⁿ exactly.
    stepper = sg.Stepper(sg.oscillator(1.0, 0.0, 0.0, velocity=1.0), "moreau-jean", 1e-3)
    assert stepper.advance(0.5, lambda t, q, v: -2.0 * v) == 500
    assert stepper.v[0] == pytest.approx((1 - 2e-3) ** 500, rel=1e-12)


def test_forces_on_several_degrees_of_freedom() -> None:
    chain = sg.chain([1.0, 2.0], [1e3])
    one, other = (sg.Stepper(chain, "moreau-jean", 1e-3) for _ in range(2))
    wide = np.array([1.0, 9.0, -3.0, 9.0])
    for _ in range(10):
        one.step(wide[::2])
        other.step([1.0, -3.0])
    np.testing.assert_array_equal(one.q, other.q)
    # The mean momentum: (1 − 3) N over 10 ms.
    assert one.v @ [1.0, 2.0] == pytest.approx(-0.02, rel=1e-12)


def test_a_step_is_repeated_from_a_saved_state(scene: sg.Scene) -> None:
    stepper = sg.Stepper(scene, "moreau-jean", 1e-3)
    stepper.advance(0.1)
    saved = stepper.time, stepper.q, stepper.v
    stepper.step(5.0)
    guess = stepper.q
    stepper.set_state(*saved)
    stepper.step(5.0)
    np.testing.assert_array_equal(stepper.q, guess)


def test_a_load_from_python_acts_as_its_closed_form(scene: sg.Scene) -> None:
    own = scene.replace(loads=[sg.Load.function(lambda t: 3.0 * np.sin(2 * np.pi * 5.0 * t))])
    ours, theirs = (s.run("moreau-jean", step=1e-3).displacement for s in (own, scene))
    # Two ways to compute a sine: roundings of 3 N, which grow 1e3-fold at e = 0.8 in 2 s at most.
    np.testing.assert_allclose(ours, theirs, rtol=0, atol=1e-11)


def test_a_function_may_look_but_not_step_the_stepper_it_serves(scene: sg.Scene) -> None:
    stepper = sg.Stepper(scene, "moreau-jean", 1e-3)
    seen = []
    stepper.advance(0.01, lambda t, q, v: seen.append(stepper.time) or 0.0)  # type: ignore[func-returns-value]
    assert seen[:2] == [0.0, pytest.approx(1e-3)]
    looking: list[sg.Stepper] = []
    load = sg.Load.function(lambda t: looking[0].time if looking else 0.0)
    looking.append(sg.Stepper(scene.replace(loads=[load]), "moreau-jean", 1e-3))
    with pytest.raises(RuntimeError, match="Already borrowed|Already mutably borrowed"):
        looking[0].step()


def test_two_threads_may_hold_one_stepper(scene: sg.Scene) -> None:
    stepper = sg.Stepper(scene, "moreau-jean", 1e-4)
    refused = []

    def look() -> None:
        for _ in range(2000):
            try:
                stepper.time
            except RuntimeError as error:
                refused.append(str(error))

    thread = threading.Thread(target=look)
    thread.start()
    stepper.advance(20.0)
    thread.join()
    assert stepper.time == pytest.approx(20.0)
    assert all("borrowed" in text for text in refused)


def test_a_python_function_in_a_run_of_many_threads(scene: sg.Scene) -> None:
    load = sg.Load.function(lambda t: 3.0 if t < 1.0 else -3.0)
    scenes = [scene.replace(loads=[load], duration=0.2 + 0.1 * i) for i in range(8)]
    many = sg.run_many(scenes, "moreau-jean", step=1e-3, threads=4)
    one = sg.run_many(scenes, "moreau-jean", step=1e-3, threads=1)
    for name, column in one.items():
        np.testing.assert_array_equal(many[name], column)
