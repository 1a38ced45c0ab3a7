"""CVODE with root-finding, from Python (scikit-sundae)."""

from time import perf_counter

import numpy as np
from sksundae.cvode import CVODE

from scene import ROWS, event_driven

PROGRAM = "CVODE"
TOLERANCES = (1e-3, 1e-4, 1e-6, 1e-8, 1e-10, 1e-12)


def runs(scene):
    for method in ("Adams", "BDF"):
        for rtol in TOLERANCES:
            yield method, f"rtol={rtol:g}", lambda record, method=method, rtol=rtol: simulate(scene, method, rtol, record)


def simulate(scene, method, rtol, record):
    grid = np.array([scene.row(i) for i in range(ROWS + 1)])
    solvers = {}

    def solver(touching):
        k = scene.k + sum(scene.walls[w].stiffness for w in touching)
        shift = sum(scene.walls[w].stiffness * scene.walls[w].position for w in touching)

        def rate(t, y, yp):
            yp[0] = y[1]
            yp[1] = (scene.force(t) + shift - scene.c * y[1] - k * y[0]) / scene.m

        def reach(t, y, out):
            for w, wall in enumerate(scene.walls):
                out[w] = y[0] - wall.position

        reach.terminal = [True] * len(scene.walls)
        reach.direction = [int(w.sign) * (-1 if i in touching else 1) for i, w in enumerate(scene.walls)]
        return CVODE(rate, method=method, rtol=rtol, atol=rtol * 1e-2 * scene.gap(), eventsfn=reach,
                     num_events=len(scene.walls), max_num_steps=1_000_000)

    def advance(t, y, touching, record):
        if touching not in solvers:
            solvers[touching] = solver(touching)
        ahead = grid[np.searchsorted(grid, t + 1e-12, side="right"):] if record else [scene.end]
        sol = solvers[touching].solve(np.concatenate([[t], ahead]), np.array(y))
        if not sol.success:
            raise RuntimeError(sol.message)
        hit = sol.status == 2  # a root; the lists of events hold those of earlier calls too
        passed = []
        if record:
            times = zip(sol.t[1:-1], sol.y[1:-1]) if hit else zip(sol.t[1:], sol.y[1:])
            passed = [(round(s / scene.end * ROWS), state[0]) for s, state in times]
        if not hit:
            return scene.end, None, None, passed
        return float(sol.t_events[-1]), list(sol.y_events[-1]), int(np.flatnonzero(sol.i_events[-1])[0]), passed

    solvers[frozenset()] = solver(frozenset())  # setting up, not timed
    started = perf_counter()
    rows = event_driven(scene, advance, record)
    return perf_counter() - started, rows
