"""OpenSeesPy: elastic gap springs for the walls, Newmark's average acceleration."""

from time import perf_counter

import openseespy.opensees as ops

from scene import ROWS

PROGRAM = "OpenSeesPy"
STEPS = (1e-3, 1e-4, 1e-5, 2e-6)
STIFFNESSES = (1e5, 1e8, 1e10)


def runs(scene):
    if any(wall.restitution not in (None, 1.0) for wall in scene.walls):
        raise ValueError("its gap springs lose nothing: e = 1 or elastic walls only")
    if any(phase for _, _, phase in scene.harmonics):
        raise ValueError("no phase of the load here")
    for law in STIFFNESSES:
        for h in STEPS:
            yield f"Newmark, k = {law:g}", f"h={h:g}", lambda record, law=law, h=h: simulate(scene, law, h)


def simulate(scene, law, h):
    ops.wipe()
    ops.model("basic", "-ndm", 1, "-ndf", 1)
    ops.node(1, 0.0)
    ops.node(2, 0.0)
    ops.fix(1, 1)
    ops.mass(2, scene.m)
    ops.uniaxialMaterial("Elastic", 1, scene.k, scene.c)
    materials = [1]
    for wall, (stiffness, _) in zip(scene.walls, scene.soft(law)):
        materials.append(len(materials) + 1)
        ops.uniaxialMaterial("ElasticPPGap", materials[-1], stiffness, wall.sign * 1e12, wall.position)
    ops.element("zeroLength", 1, 1, 2, "-mat", *materials, "-dir", *[1] * len(materials), "-doRayleigh", 0)
    for tag, (amplitude, omega, _) in enumerate(scene.harmonics, 1):
        ops.timeSeries("Trig", tag, 0.0, 1e9, 2 * 3.141592653589793 / omega, "-factor", amplitude)
        ops.pattern("Plain", tag, tag)
        ops.load(2, 1.0)
    ops.timeSeries("Constant", 99, "-factor", scene.constant)
    ops.pattern("Plain", 99, 99)
    ops.load(2, 1.0)
    ops.setNodeDisp(2, 1, scene.u, "-commit")
    ops.setNodeVel(2, 1, scene.v, "-commit")
    ops.constraints("Plain")
    ops.numberer("Plain")
    ops.system("ProfileSPD")
    ops.test("NormDispIncr", 1e-12, 20, 0)
    ops.algorithm("Newton")
    ops.integrator("Newmark", 0.5, 0.25)
    ops.analysis("Transient")
    each = max(1, round(scene.end / h / ROWS))
    rows, done = [], 0
    started = perf_counter()
    while done < round(scene.end / h):
        if ops.analyze(each, h) != 0:
            raise RuntimeError("no convergence")
        done += each
        rows.append((round(done * h / scene.end * ROWS), ops.nodeDisp(2, 1)))
    return perf_counter() - started, rows
