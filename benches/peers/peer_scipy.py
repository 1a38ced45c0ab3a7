"""SciPy: solve_ivp with terminal events, restarted at each."""

from time import perf_counter

import numpy as np
from scipy.integrate import solve_ivp

from scene import ROWS, event_driven

PROGRAM = "SciPy"
TOLERANCES = (1e-3, 1e-4, 1e-6, 1e-8, 1e-10, 1e-12)


def runs(scene):
    for method in ("RK45", "DOP853", "LSODA"):
        for rtol in TOLERANCES:
            yield method, f"rtol={rtol:g}", lambda record, method=method, rtol=rtol: simulate(scene, method, rtol, record)


def simulate(scene, method, rtol, record):
    grid = np.array([scene.row(i) for i in range(ROWS + 1)])

    def advance(t, y, touching, record):
        k = scene.k + sum(scene.walls[w].stiffness for w in touching)
        shift = sum(scene.walls[w].stiffness * scene.walls[w].position for w in touching)

        def rate(t, y):
            return y[1], (scene.force(t) + shift - scene.c * y[1] - k * y[0]) / scene.m

        events = []
        for w, wall in enumerate(scene.walls):
            def reach(t, y, at=wall.position):
                return y[0] - at
            reach.terminal, reach.direction = True, wall.sign * (-1.0 if w in touching else 1.0)
            events.append(reach)
        here = grid[np.searchsorted(grid, t, side="right"):] if record else None
        sol = solve_ivp(rate, (t, scene.end), y, method, t_eval=here, rtol=rtol, atol=rtol * 1e-2 * scene.gap(), events=events)
        if sol.status < 0:
            raise RuntimeError(sol.message)
        passed = [(round(s / scene.end * ROWS), u) for s, u in zip(sol.t, sol.y[0])] if record else []
        for w, (times, states) in enumerate(zip(sol.t_events, sol.y_events)):
            if len(times):
                return times[0], list(states[0]), w, passed
        return scene.end, None, None, passed

    started = perf_counter()
    rows = event_driven(scene, advance, record)
    return perf_counter() - started, rows
