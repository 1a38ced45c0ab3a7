"""Runs: their arrays, contacts, statistics and verdicts."""

import math
import pickle
import threading
import time
import warnings

import numpy as np
import pytest

import signorini as sg


def test_a_run_has_its_motion_and_contacts(scene: sg.Scene) -> None:
    run = scene.run("moreau-jean", step=1e-4)
    assert run.time.shape == run.displacement.shape == run.contact_force("upper").shape == (20001,)
    assert run.time[-1] == 2.0
    assert (run.contact_force("upper") <= 0.0).all() and (run.contact_force("lower") >= 0.0).all()
    # The impulses of the rows are those of the episodes: both count every step, in another order.
    episodes = run.contacts
    own = episodes[episodes["wall"] == "upper"]["impulse"].sum()
    assert run.impulse("upper") == pytest.approx(own, rel=1e-12)
    # Momentum: what load, spring and walls gave is what the mass has at the end. The integrals are
    # trapezoidal sums of 1e-4 s, whose error is of the order of the step.
    t, q, v = run.time, run.displacement, run.velocity
    force = 3.0 * np.sin(2 * np.pi * 5.0 * t) - 100.0 * q - 0.2 * v
    given = np.trapezoid(force, t) + run.impulse("upper") + run.impulse("lower")
    assert run.velocity[-1] == pytest.approx(given, abs=1e-4)


def test_arrays_are_read_only_views_that_outlive_the_run(scene: sg.Scene) -> None:
    run = scene.run("event")
    views = [run.time, run.displacement, run.velocity, run.contact_force("upper"), *run.state]
    for array in views:
        base: object = array.base
        assert base is run and not array.flags.owndata and not array.flags.writeable
    # The same memory every time: nothing is copied.
    assert run.time.ctypes.data == run.time.ctypes.data
    kept, copy = run.displacement, run.displacement.copy()
    del run, views, array, base
    np.testing.assert_array_equal(kept, copy)
    with pytest.raises(ValueError, match="read-only"):
        kept[0] = 1.0


def test_columns_are_those_of_the_csv_file(scene: sg.Scene) -> None:
    run = scene.run("event", sample=0.1)
    names = ["time_s", "displacement_m", "velocity_m_per_s", "contact_force_upper_N", "contact_impulse_upper_N_s"]
    names += ["contact_force_lower_N", "contact_impulse_lower_N_s"]
    assert list(run.columns) == names
    frame = run.to_pandas()
    assert list(frame.columns) == names and len(frame) == 21
    np.testing.assert_array_equal(frame["displacement_m"], run.displacement)


def test_states_at_output_times_are_those_of_the_exact_motion() -> None:
    # Dropped from 1 m onto a floor of restitution 0.8: closed form, before and after the impact.
    ball = sg.oscillator(
        2.0, 0.0, 0.0, walls=[sg.Wall.lower("floor", 0.0, restitution=0.8)], loads=[sg.Load.constant(-19.62)],
        displacement=1.0, duration=1.0,
    )
    assert ball.run("event").output == {}
    found = ball.replace(output_times=np.array([0.3, 0.6])).run("event").output
    assert list(found) == ["time_s", "displacement_m", "velocity_m_per_s"]
    speed, after = 0.8 * np.sqrt(2.0 * 9.81), 0.6 - np.sqrt(2.0 / 9.81)
    np.testing.assert_allclose(found["displacement_m"], [1.0 - 4.905 * 0.09, speed * after - 4.905 * after**2], 1e-12)
    np.testing.assert_allclose(found["velocity_m_per_s"], [-2.943, speed - 9.81 * after], 1e-12)
    with pytest.raises(ValueError, match="output times: value 2"):
        ball.replace(output_times=[0.2, 0.1])


def test_names_become_words_and_equal_ones_get_numbers() -> None:
    chain = sg.chain([1.0] * 3, [1e3] * 2, probes={"a-b": 0, "a_b": 1}, velocity=[0.1, 0.0, 0.0])
    assert list(chain.run("event").columns)[1::2] == ["displacement_a_b_m", "displacement_a_b_2_m"]


def test_statistics_are_by_wall(scene: sg.Scene) -> None:
    run = scene.replace(duration=20.0).run("event", statistics_from=10.0)
    upper = run.statistics["upper"]
    episodes = run.contacts
    own = episodes[(episodes["wall"] == "upper") & (episodes["start"] >= 10.0)]
    assert upper["contacts"] == len(own)
    # ½ m v² of every impact over the window, m = 1 kg; sums in another order.
    assert upper["impact_power_w"] == pytest.approx(0.5 * (own["approach_speed"] ** 2).sum() / 10.0, rel=1e-12)
    assert upper["half_width_95"]["impact_power_w"] > 0.0
    assert run.summary["residuals"]["complementarity"] < 1e-12
    assert "impact power" in run._repr_html_()


def test_the_verdict_says_what_half_the_step_changes(scene: sg.Scene) -> None:
    verdict = scene.run("moreau-jean", step=1e-3).verdict()
    assert "half the step" in verdict["text"]
    impulse, finer = verdict["walls"][0]["impulse_n_s"]
    assert finer == scene.run("moreau-jean", step=5e-4).impulse("upper") != impulse


def test_an_accuracy_is_kept_or_a_warning_says_until_when(scene: sg.Scene) -> None:
    exact = scene.run("event", sample=0.05)
    run = scene.run("moreau-jean", accuracy=1e-2, sample=0.05)
    assert run.summary["accuracy"]["reached"] <= 1e-2
    # Judged here against the exact motion, at the rows of both: 1 % of the gap of 5 mm.
    assert abs(run.displacement - exact.displacement).max() <= 1e-2 * scene.gap_scale
    walls = [sg.Wall.upper("upper", 5e-3), sg.Wall.lower("lower", -5e-3)]
    chaotic = scene.replace(duration=30.0, walls=walls)
    with pytest.warns(sg.AccuracyWarning, match="until t ="):
        assert chaotic.run("event", accuracy=1e-6).summary["accuracy"]["until_s"] < 30.0


def test_round_supports_have_columns_of_their_own() -> None:
    scene = sg.load("whirl-in-a-hole").scene.replace(duration=0.2)
    run = scene.run("moreau-jean", step=1e-4)
    assert run.holes == list(run.supports) == ["hole"]
    names = [f"contact_{what}_hole_{plane}_{unit}" for plane in "yz" for what, unit in (("force", "N"), ("impulse", "N_s"))]
    assert [name for name in run.columns if "hole" in name and not name.startswith(("disp", "velo"))] == [
        *names,
        "wear_work_hole_J",
    ]
    # The impulses of a row are those of its one step: force times step.
    force, impulse = run.hole_force("hole"), run.hole_impulse("hole")
    for f, p in zip(force, impulse, strict=True):
        assert np.allclose(p[1:], 1e-4 * f[1:], rtol=1e-9, atol=1e-15)
    # The body is pressed round the hole all the time: its work only grows.
    assert (np.diff(run.wear_work("hole")) > 0.0).all()
    # The closed form of the case, W; the midpoint rule on the circle is 7e-7 off.
    rate = run.supports["hole"].work_rate.value
    assert abs(rate - 1.109652491907) < 1e-6
    assert abs(run.wear_work("hole")[-1] / run.time[-1] / rate - 1.0) < 1e-9
    # One contact without end, which does all the work and slides at the speed of the whirl.
    (only,) = run.contacts
    assert only["wall"] == "hole" and np.isnan(only["end"])
    assert abs(only["work"] / run.wear_work("hole")[-1] - 1.0) < 1e-9
    slid = run.supports["hole"].sliding_rate * run.time[-1]
    assert abs(only["sliding"] / slid - 1.0) < 1e-6 and 0.0 <= only["angle"] < 360.0
    with pytest.raises(ValueError, match="round support"):
        run.hole_force("elsewhere")
    back = pickle.loads(pickle.dumps(run))
    assert (back.wear_work("hole") == run.wear_work("hole")).all()


def test_runs_survive_pickling(scene: sg.Scene) -> None:
    run = scene.run("moreau-jean", step=1e-3)
    back = pickle.loads(pickle.dumps(run))
    assert back.scene == scene and repr(back) == repr(run)
    for name, column in run.columns.items():
        np.testing.assert_array_equal(back.columns[name], column)
    assert back.contacts.tobytes() == run.contacts.tobytes()
    assert back.summary == run.summary


def test_other_threads_go_on_during_a_run(scene: sg.Scene) -> None:
    long = scene.replace(duration=1000.0)
    done: list[sg.Run] = []
    thread = threading.Thread(target=lambda: done.append(long.run("moreau-jean", step=1e-4, sample=1.0)))
    thread.start()
    ticks = 0
    while thread.is_alive():
        time.sleep(1e-3)
        ticks += 1
    # It takes a second or so: with the lock held there would be none.
    assert ticks > 20 and len(done) == 1


def test_a_refuted_run_is_an_error_that_holds_it() -> None:
    # A force that is no function of the time: the judge, who asks it again, misses momentum.
    count = iter(range(10**9))
    load = sg.Load.function(lambda t: float(next(count) % 7))
    scene = sg.oscillator(1.0, 0.0, 100.0, loads=[load])
    with pytest.raises(sg.RefutedError, match="momentum balance") as caught:
        scene.run("moreau-jean", step=1e-3)
    assert caught.value.run.findings and repr(caught.value.run).startswith("<refuted Run")
    assert isinstance(caught.value, sg.RunError) and isinstance(caught.value, RuntimeError)


def test_plots(scene: sg.Scene) -> None:
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        axes = scene.run("event").plot()
        axes[0].figure.canvas.draw()
        lasting = sg.load("elastic-wall").run().plot()
    assert axes[2].get_ylabel() == "contact impulse (N s)"
    assert lasting[2].get_ylabel() == "contact force (N)"


def test_notes_that_concern_the_result_are_warnings(scene: sg.Scene) -> None:
    # A period of the load is 5 steps of 0.04 s.
    with pytest.warns(sg.ResultWarning) as caught:
        run = scene.run("moreau-jean", step=0.04)
    said = [str(warning.message) for warning in caught]
    assert any("fewer than 10 do not resolve it" in text for text in said)
    assert said == run.notes and all(warning.filename == __file__ for warning in caught)
    # That a step was shortened to end at the end concerns the grid only, and that the motion has not
    # settled in two seconds is no fault of the run.
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        run = scene.run("moreau-jean", step=1.7e-4)
    assert len(run.notes) == 2 and "shortened" in run.notes[0] and "still settling" in run.notes[1]
    # A refuted run raises, and does not warn besides.
    assert issubclass(sg.ResultWarning, UserWarning)


def test_the_picture_of_a_run_shows_supports_with_whole_legends() -> None:
    import matplotlib.pyplot as plt

    hole = sg.load("whirl-in-a-hole").scene.replace(duration=0.2).run(step=1e-3)
    axes = hole.plot()
    (line,) = axes[2].get_lines()
    np.testing.assert_allclose(line.get_ydata(), np.hypot(*hole.hole_force("hole")))
    assert line.get_label() == "hole" and line.get_ydata().max() > 0.0
    names = [f"a-rather-long-name-of-a-support-{number}" for number in range(3)]
    walls = [wall for number, name in enumerate(names) for wall in sg.support(name, 1e-3 + 1e-4 * number)]
    free = sg.oscillator(1.0, 0.2, 100.0, velocity=0.1)
    made = [hole, free.replace(walls=walls).run("event"), free.run("event")]
    for run in made:
        axes = run.plot()
        figure = axes[0].figure
        figure.canvas.draw()
        for ax in axes:
            legend = ax.get_legend()
            if legend is not None:
                box = legend.get_window_extent()
                assert box.x0 >= 0.0 and box.x1 <= figure.bbox.x1 and box.y1 <= figure.bbox.y1, box
        # No panel is empty.
        assert all(ax.lines or ax.collections or ax.texts for ax in axes)
    plt.close("all")


def test_an_impact_on_a_wall_of_hunt_and_crossley_has_the_restitution_of_its_closed_form() -> None:
    stop = sg.Wall.upper("stop", 0.0, stiffness=1e6, exponent=1.5, dissipation=0.4)
    assert (stop.stiffness, stop.exponent, stop.dissipation, stop.damping) == (1e6, 1.5, 0.4, None)
    scene = sg.oscillator(1.0, 0.0, 0.0, walls=[stop], displacement=-1e-3, velocity=0.8, duration=0.05)
    run = scene.run(step=2e-6)
    assert "penalty" in repr(run)
    x, y = 0.4 * 0.8, 0.4 * run.contacts["departure_speed"][0]
    # x - ln(1 + x) = -y - ln(1 - y) for the speeds times the dissipation; the step's order is 2.
    assert x - math.log1p(x) == pytest.approx(-y - math.log1p(-y), rel=1e-4)
