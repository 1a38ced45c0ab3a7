"""MuJoCo: a slide joint whose limits are the walls, stepped in C by `rollout`.

A limit is a soft constraint: solref = (-stiffness, -damping) gives it a spring and a dashpot, and impedance next to 1 leaves them as they are."""

from time import perf_counter

import mujoco
import numpy as np
from mujoco import rollout

from scene import ROWS

PROGRAM = "MuJoCo"
STEPS = (1e-3, 1e-4, 1e-5, 2e-6)
STIFFNESSES = (1e5, 1e8)

MODEL = """<mujoco>
<option timestep="{h!r}" gravity="0 0 0" integrator="Euler" tolerance="1e-14" iterations="50"><flag contact="disable"/></option>
<worldbody><body><joint name="j" type="slide" axis="1 0 0" stiffness="{k!r}" damping="{c!r}" limited="true" range="{lower!r} {upper!r}"
 solreflimit="{a!r} {b!r}" solimplimit="0.9999 0.9999 0.00001 0.5 1"/><geom type="sphere" size="0.01" mass="{m!r}"/></body></worldbody>
<actuator><motor joint="j"/></actuator></mujoco>"""


def runs(scene):
    if any(wall.restitution is None for wall in scene.walls):
        raise ValueError("both limits of a joint are alike: no elastic wall beside a rigid one")
    for law in STIFFNESSES:
        for h in STEPS:
            yield f"Euler, k = {law:g}", f"h={h:g}", lambda record, law=law, h=h: simulate(scene, law, h, record)


def simulate(scene, law, h, record):
    stiffness, damping = scene.soft(law)[0]
    far = 1e3
    upper = min((w.position for w in scene.walls if w.sign > 0), default=far)
    lower = max((w.position for w in scene.walls if w.sign < 0), default=-far)
    a, b = -stiffness / scene.m, -damping / scene.m
    text = MODEL.format(h=h, k=scene.k, c=scene.c, m=scene.m, lower=lower, upper=upper, a=a, b=b)
    model = mujoco.MjModel.from_xml_string(text)
    data = mujoco.MjData(model)
    steps = round(scene.end / h)
    control = np.array([scene.force((i + 0.5) * h) for i in range(steps)]).reshape(1, steps, 1)
    full = mujoco.mjtState.mjSTATE_FULLPHYSICS
    start = np.zeros((1, mujoco.mj_stateSize(model, full)))
    data.qpos[0], data.qvel[0] = scene.u, scene.v
    mujoco.mj_getState(model, data, start[0], full)
    started = perf_counter()
    states, _ = rollout.rollout(model, [data], start, control)
    seconds = perf_counter() - started
    stride = steps / ROWS
    rows = [(i, states[0, round(i * stride) - 1, 1]) for i in range(1, ROWS + 1)] if record else []
    return seconds, rows
