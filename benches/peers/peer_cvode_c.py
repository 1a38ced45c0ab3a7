"""CVODE with root-finding, called from C (Debian's libsundials-dev and a C compiler)."""

import ctypes
import subprocess
import tempfile
from pathlib import Path

from scene import ROWS

PROGRAM = "CVODE in C"
TOLERANCES = (1e-3, 1e-4, 1e-6, 1e-8, 1e-10, 1e-12)
LIBRARIES = ("-lsundials_cvode", "-lsundials_nvecserial", "-lsundials_sunmatrixdense", "-lm")
SOURCE = Path(__file__).absolute().with_name("cvode.c")


class Wall(ctypes.Structure):
    _fields_ = [(name, ctypes.c_double) for name in ("sign", "position", "restitution", "stiffness")]


class Scene(ctypes.Structure):
    _fields_ = [
        *((name, ctypes.c_double) for name in ("m", "c", "k", "constant")),
        ("harmonics", ctypes.c_int), ("walls", ctypes.c_int),
        ("harmonic", ctypes.POINTER(ctypes.c_double)), ("wall", ctypes.POINTER(Wall)), ("touching", ctypes.POINTER(ctypes.c_int)),
    ]


def built():
    library = Path(tempfile.mkdtemp(prefix="cvode-"), "cvode.so")
    try:
        subprocess.run(["cc", "-O3", "-march=native", "-shared", "-fPIC", SOURCE, "-o", library, *LIBRARIES], check=True, capture_output=True)
    except (OSError, subprocess.CalledProcessError) as missing:
        raise ImportError(f"no C compiler, or no libsundials-dev: {missing}") from missing
    simulate = ctypes.CDLL(str(library)).simulate
    simulate.restype = ctypes.c_double
    return simulate


SIMULATE = built()


def runs(scene):
    if len(scene.walls) > 16:
        raise ValueError("cvode.c has room for 16 walls")
    for adams, method in ((1, "Adams"), (0, "BDF")):
        for rtol in TOLERANCES:
            yield method, f"rtol={rtol:g}", lambda record, adams=adams, rtol=rtol: simulate(scene, adams, rtol, record)


def simulate(scene, adams, rtol, record):
    numbers = [x for harmonic in scene.harmonics for x in harmonic]
    walls = [Wall(w.sign, w.position, -1.0 if w.restitution is None else w.restitution, w.stiffness) for w in scene.walls]
    model = Scene(
        scene.m, scene.c, scene.k, scene.constant, len(scene.harmonics), len(walls),
        (ctypes.c_double * len(numbers))(*numbers), (Wall * len(walls))(*walls), (ctypes.c_int * len(walls))(),
    )
    rows = ROWS if record else 0
    out = (ctypes.c_double * (rows + 1))()
    number = ctypes.c_double
    seconds = SIMULATE(
        adams, number(rtol), number(rtol * 1e-2 * scene.gap()), ctypes.byref(model), number(scene.u), number(scene.v), number(scene.end), rows, out
    )
    if seconds < 0.0:
        raise RuntimeError("CVODE failed" if seconds == -1.0 else "impacts accumulate")
    return seconds, list(enumerate(out)) if record else []
