"""diffrax (JAX), compiled, from impact to impact: one oscillator, and many side by side by vmap."""

from time import perf_counter

import diffrax
import jax
import jax.numpy as jnp
import optimistix

from scene import ROWS

jax.config.update("jax_enable_x64", True)

PROGRAM = "diffrax"
TOLERANCES = (1e-4, 1e-6, 1e-8, 1e-10)
SOLVERS = (diffrax.Tsit5, diffrax.Dopri8)
MANY = 1024  # oscillators side by side; the time is that of one
MOST_STEPS = 100_000  # of a flight


def runs(scene):
    if any(wall.restitution is None for wall in scene.walls):
        raise ValueError("only rigid walls are modelled here")
    for solver in SOLVERS:
        for rtol in TOLERANCES:
            for many in (1, MANY):
                method = solver.__name__ + (f", vmap {many}" if many > 1 else "")
                yield method, f"rtol={rtol:g}", compiled(scene, solver(), rtol, many)


def compiled(scene, solver, rtol, many):
    flight = prepared(scene, solver, rtol)
    start = jnp.array([scene.u, scene.v])
    one = jax.jit(lambda y: to_the_end(scene, flight, y))
    all_of_them = jax.jit(jax.vmap(lambda y: to_the_end(scene, flight, y)))
    starts = jnp.tile(start, (many, 1))

    def simulate(record):
        # The warm-up that every peer gets compiles.
        call = (lambda: one(start)) if many == 1 else (lambda: all_of_them(starts))
        if record:
            call()[1].block_until_ready()
        started = perf_counter()
        time, _ = jax.block_until_ready(call())
        seconds = (perf_counter() - started) / many
        if not bool(jnp.all(time >= scene.end)):
            raise RuntimeError("did not reach the end")
        return seconds, rows(scene, solver, rtol, start) if record else []

    return simulate


def prepared(scene, solver, rtol):
    """One flight: from (t, y) to the next wall or to the end. Returns time, state, and whether a wall was reached."""
    amplitudes, omegas, phases = (jnp.array([h[i] for h in scene.harmonics]) for i in range(3))
    positions = jnp.array([w.position for w in scene.walls])
    restitutions = jnp.array([w.restitution for w in scene.walls])

    def rate(t, y, args):
        force = scene.constant + jnp.sum(amplitudes * jnp.sin(omegas * t + phases))
        return jnp.array([y[1], (force - scene.c * y[1] - scene.k * y[0]) / scene.m])

    reaches = [lambda t, y, args, w=wall, **kwargs: y[0] - w.position for wall in scene.walls]
    event = diffrax.Event(
        reaches, optimistix.Newton(rtol=1e-13, atol=1e-15), direction=[wall.sign > 0 for wall in scene.walls]
    )
    control = diffrax.PIDController(rtol=rtol, atol=rtol * 1e-2 * scene.gap())

    def flight(t, y, saveat):
        solution = diffrax.diffeqsolve(
            diffrax.ODETerm(rate), solver, t, scene.end, None, y, saveat=saveat, stepsize_controller=control,
            event=event, max_steps=MOST_STEPS, throw=False,
        )
        hit = jnp.array([jnp.any(mask) for mask in solution.event_mask])
        wall = jnp.argmax(hit)
        def rebound(y):
            return jnp.array([positions[wall], -restitutions[wall] * y[1]])
        return solution, jnp.any(hit), rebound

    return flight


def to_the_end(scene, flight, y):
    def body(state):
        t, y = state
        solution, hit, rebound = flight(t, y, diffrax.SaveAt(t1=True))
        y = solution.ys[0]
        return solution.ts[0], jnp.where(hit, rebound(y), y)

    return jax.lax.while_loop(lambda state: state[0] < scene.end, body, (jnp.array(0.0), y))


def rows(scene, solver, rtol, y):
    """The displacement at the rows, by the same flights with dense output."""
    flight = prepared(scene, solver, rtol)
    grid = jnp.array([scene.row(i) for i in range(ROWS + 1)])

    @jax.jit
    def one(t, y):
        solution, hit, rebound = flight(t, y, diffrax.SaveAt(t1=True, dense=True))
        last = solution.ts[0]
        passed = jax.vmap(lambda s: solution.evaluate(jnp.clip(s, t, last))[0])(grid)
        return last, jnp.where(hit, rebound(solution.ys[0]), solution.ys[0]), passed

    t, found = 0.0, [(0, float(y[0]))]
    while t < scene.end:
        last, y, passed = one(t, y)
        found += [(i, float(passed[i])) for i in range(ROWS + 1) if t < scene.row(i) <= float(last)]
        t = float(last)
    return found
