"""Siconos: Moreau-Jean time stepping and the event-driven scheme (LSODAR), with the load as a compiled plugin."""

import subprocess
import tempfile
from time import perf_counter

import numpy as np
import siconos.kernel as sk

from scene import ROWS

PROGRAM = "Siconos"
STEPS = (1e-3, 1e-4, 1e-5)
INTERVALS = (1e-2, 1e-3)


def runs(scene):
    if any(wall.restitution is None for wall in scene.walls):
        raise ValueError("elastic walls are not set up here")
    load = plugin(scene)
    for h in STEPS:
        yield "Moreau-Jean", f"h={h:g}", lambda record, h=h: stepping(scene, load, h, record)
    for h in INTERVALS:
        yield "event-driven", f"h={h:g}", lambda record, h=h: event_driven(scene, load, h, record)


def plugin(scene):
    """The load, compiled, as a path without its ending: a Python force would be called through the interpreter at every step."""
    terms = " + ".join([repr(scene.constant)] + [f"{a!r} * sin({w!r} * t + {p!r})" for a, w, p in scene.harmonics])
    folder = tempfile.mkdtemp(prefix="siconos-")
    with open(f"{folder}/plugin.c", "w") as file:
        file.write(f"#include <math.h>\nvoid FExt(double t, unsigned n, double *f, unsigned s, double *z) {{ f[0] = {terms}; }}\n")
    subprocess.run(["cc", "-O2", "-shared", "-fPIC", "-o", f"{folder}/plugin.so", f"{folder}/plugin.c", "-lm"], check=True)
    return f"{folder}/plugin"


def model(scene, load):
    body = sk.LagrangianLinearTIDS([scene.u], [scene.v], np.array([[scene.m]]), np.array([[scene.k]]), np.array([[scene.c]]))
    body.setComputeFExtFunction(load, "FExt")
    system = sk.NonSmoothDynamicalSystem(0.0, scene.end)
    system.insertDynamicalSystem(body)
    kept = []
    for wall in scene.walls:
        law = sk.NewtonImpactNSL(wall.restitution)
        relation = sk.LagrangianLinearTIR([[-wall.sign]], [wall.sign * wall.position])
        interaction = sk.Interaction(law, relation)
        system.link(interaction, body)
        kept += [law, relation, interaction]
    return body, system, kept


def stepping(scene, load, h, record):
    body, system, _kept = model(scene, load)
    simulation = sk.TimeStepping(system, sk.TimeDiscretisation(0.0, h), sk.MoreauJeanOSI(0.5), sk.LCP())
    simulation.initialize()
    steps = round(scene.end / h)
    stride = max(1, round(steps / ROWS))
    rows = []
    started = perf_counter()
    for i in range(1, steps + 1):
        simulation.computeOneStep()
        simulation.nextStep()
        if record and i % stride == 0:
            rows.append((round(i * h / scene.end * ROWS), body.q()[0]))
    return perf_counter() - started, rows


def event_driven(scene, load, h, record):
    body, system, _kept = model(scene, load)
    simulation = sk.EventDriven(system, sk.TimeDiscretisation(0.0, h))
    simulation.insertIntegrator(sk.LsodarOSI())
    simulation.insertNonSmoothProblem(sk.LCP(), sk.SICONOS_OSNSP_ED_IMPACT)
    simulation.insertNonSmoothProblem(sk.LCP(), sk.SICONOS_OSNSP_ED_SMOOTH_ACC)
    simulation.initialize()
    rows = []
    started = perf_counter()
    while simulation.hasNextEvent():
        simulation.advanceToEvent()
        simulation.processEvents()
        if record:
            row = simulation.startingTime() / scene.end * ROWS
            if abs(row - round(row)) < 1e-6:
                rows.append((round(row), body.q()[0]))
    return perf_counter() - started, rows
