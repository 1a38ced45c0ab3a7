"""Ctrl-C ends long work soon, and what was written stays; in a process of its own, with its signals."""

import os
import signal
import subprocess
import sys
import time
from collections.abc import Callable
from pathlib import Path

import numpy as np
import pytest

import signorini as sg

PROGRAM = """
import signal
import time
import numpy as np
import signorini as sg

# A shell starts what runs in its background with this signal ignored.
signal.signal(signal.SIGINT, signal.default_int_handler)

def make(restitution):
    walls = [sg.Wall.upper("upper", 5e-3, restitution=restitution)]
    load = sg.Load.harmonic(3.0, 5.0)
    return sg.oscillator(1.0, 0.2, 100.0, walls=walls, loads=[load], duration={duration})

scene = make(0.8)
case = sg.load("rigid-walls-sine", set={{"wall.*.restitution": 0.8, "time.sample": 1.0}})
print("ready", flush=True)
try:
    {call}
except KeyboardInterrupt:
    print("stopped", time.time(), flush=True)
"""

CALLS = [
    "scene.run('moreau-jean', step=1e-4, sample=1e3)",
    # Shorter, so that neither refuses by itself before the signal; both take seconds.
    "scene.replace(duration=4e5).run('event', sample=1e3)",
    "scene.replace(duration=2e4).run('moreau-jean', accuracy=1e-4, sample=1e3)",
    "sg.compare(scene, ['moreau-jean'], step=1e-4, sample=1e3)",
    "sg.chart(scene, ['moreau-jean'], most_seconds=1e6)",
    "sg.stability(scene, contacts=1_000_000)",
    "sg.run_many([scene] * 4, 'moreau-jean', step=1e-4)",
    "sg.bifurcation(case, 'load.1.harmonic.frequency', [4.9, 5.0], settle=4_000_000)",
    "sg.branches(case, 'load.1.harmonic.frequency', (0.5, 16.0), settle=100, switch='all', depth=50)",
    "sg.Stepper(scene, 'moreau-jean', 1e-4).advance(1e6)",
    "sg.Stepper(scene, 'moreau-jean', 1e-4).advance(1e6, lambda t, q, v: 0.0)",
    "sg.realisations(sg.load('tube-round-supports', set={'time.end': 100.0}), seeds=4)",
    "sg.wear(sg.load('tube-in-cross-flow', set={'time.end': 100.0}), years=40)",
    "sg.sweep(make, sg.grid(restitution=[0.7, 0.8]), 'moreau-jean', step=1e-4)",
    "scene.replace(loads=[sg.Load.function(lambda t: 0.0)]).run('moreau-jean', step=1e-4, sample=1e3)",
    # A reduction to modes, in seconds of work without a step.
    "sg.chain(np.ones(200_000), np.full(199_999, 1e4), grounds=(1e4, 0.0), modes=200)",
    # Random forces of 2^24 rows.
    "sg.load('tube-round-supports', set={'load.1.random.to': 1e5, 'load.2.random.to': 1e5, 'time.end': 10.0})",
    "sg.beam(length=3.0, youngs_modulus=2e11, density=7850.0, outer_diameter=0.02, elements=100_000, duration=1e3,"
    " walls=[sg.Wall.upper('stop', 1e-3, at=1.0)]).run('moreau-jean', step=1e-4, sample=1.0)",
]


def interrupted(call: str, duration: float, ready: Callable[[], bool]) -> float:
    """Seconds from the signal, which is sent once it is ``ready``, to the exception."""
    program = [sys.executable, "-c", PROGRAM.format(call=call, duration=duration)]
    child = subprocess.Popen(program, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)
    assert child.stdout is not None
    assert child.stdout.readline() == "ready\n"
    waited = time.monotonic()
    time.sleep(0.3)
    while not ready() and time.monotonic() - waited < 60.0:
        time.sleep(0.05)
    sent = time.time()
    child.send_signal(signal.SIGINT)
    out, errors = child.communicate(timeout=60)
    word, when = out.split() if out else ("", "nan")
    assert word == "stopped", f"{call}: {out}{errors}"
    return float(when) - sent


@pytest.mark.skipif(os.name == "nt", reason="signals of Windows")
@pytest.mark.parametrize("call", CALLS)
def test_ctrl_c_ends_it(call: str) -> None:
    # 0.2 s on an idle machine; the bound is for one that does other things as well.
    assert interrupted(call, 1e6, lambda: True) < 5.0


@pytest.mark.skipif(os.name == "nt", reason="signals of Windows")
# Its windows hold the transient of the start.
@pytest.mark.filterwarnings("ignore:.* have not settled:signorini.ResultWarning")
def test_a_sweep_goes_on_from_what_it_had_kept(tmp_path: Path) -> None:
    grid = "sg.grid(restitution=[0.5 + 0.001 * i for i in range(400)])"
    call = f"sg.sweep(make, {grid}, 'moreau-jean', step=1e-4, threads=1, folder={str(tmp_path)!r})"
    interrupted(call, 20.0, lambda: any(tmp_path.glob("*.npz")))
    kept = {path: path.read_bytes() for path in tmp_path.glob("*.npz")}
    assert kept and not list(tmp_path.glob("*.part"))

    def make(restitution: float) -> sg.Scene:
        walls = [sg.Wall.upper("upper", 5e-3, restitution=restitution)]
        load = sg.Load.harmonic(3.0, 5.0)
        return sg.oscillator(1.0, 0.2, 100.0, walls=walls, loads=[load], duration=20.0)

    points = sg.grid(restitution=[0.5 + 0.001 * i for i in range(40)])
    again = sg.sweep(make, points, "moreau-jean", step=1e-4, folder=tmp_path)
    # Nothing that was there is written anew, and the table is that of one sweep.
    assert {path: path.read_bytes() for path in kept} == kept
    whole = sg.sweep(make, points, "moreau-jean", step=1e-4)
    for name, column in whole.items():
        np.testing.assert_array_equal(again[name], column)
