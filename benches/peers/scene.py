"""A case file as the peers need it, and the error every one of them is judged by."""

import csv
import dataclasses
import math
import subprocess
import tempfile
import tomllib
from pathlib import Path

ROWS = 1000


@dataclasses.dataclass
class Wall:
    sign: float  # +1 upper, -1 lower
    position: float  # m
    restitution: float | None  # none: elastic
    stiffness: float  # N/m


@dataclasses.dataclass
class Scene:
    m: float
    c: float
    k: float
    walls: list[Wall]
    harmonics: list[tuple[float, float, float]]  # N, rad/s, rad
    constant: float  # N
    u: float
    v: float
    end: float  # s

    @classmethod
    def read(cls, path, end, restitution):
        case = tomllib.loads(Path(path).read_text())
        body = case["system"]["oscillator"]
        walls, harmonics, constant = [], [], 0.0
        for wall in case.get("wall", []):
            stiffness = wall.get("stiffness", 0.0)
            if wall.get("damping", 0.0):
                raise ValueError("no peer here knows a damped wall")
            e = None if stiffness else (wall.get("restitution", 1.0) if restitution is None else restitution)
            walls.append(Wall(1.0 if wall["side"] == "upper" else -1.0, wall["position"], e, stiffness))
        for load in case.get("load", []):
            if "harmonic" in load:
                h = load["harmonic"]
                harmonics.append((h["amplitude"], 2 * math.pi * h["frequency"], h.get("phase", 0.0)))
            elif "constant" in load:
                constant += load["constant"]["force"]
            else:
                raise ValueError("no peer here knows a load that is neither harmonic nor constant")
        start = case.get("initial", {})
        return cls(
            body["mass"], body.get("damping", 0.0), body.get("stiffness", 0.0), walls, harmonics, constant,
            start.get("displacement", 0.0), start.get("velocity", 0.0), end or case["time"]["end"],
        )

    def force(self, t):
        return self.constant + sum(a * math.sin(w * t + p) for a, w, p in self.harmonics)

    def gap(self):
        """Half the least distance between facing walls; else the start's distance from a wall: signorini's scale."""
        upper = [w.position for w in self.walls if w.sign > 0]
        lower = [w.position for w in self.walls if w.sign < 0]
        if upper and lower:
            return 0.5 * (min(upper) - max(lower))
        return max((abs(w.position - self.u) for w in self.walls), default=1.0) or 1.0

    def row(self, i):
        return self.end * i / ROWS

    def soft(self, law):
        """Stiffness and damping, N/m and N s/m, for each wall of a program that knows springs only: those of an elastic wall, else `law`'s
        stiffness with the damping that makes a free body rebound with e."""
        def of(wall):
            if wall.restitution is None:
                return wall.stiffness, 0.0
            if wall.restitution == 0.0:
                return law, 2.0 * math.sqrt(law * self.m)
            log = math.log(wall.restitution)
            return law, -2.0 * log / math.hypot(math.pi, log) * math.sqrt(law * self.m)
        return [of(wall) for wall in self.walls]


def exact(program, case, scene, restitution):
    """The exact displacement at the rows, by signorini itself: its `event` scheme is tested against 50-digit arithmetic."""
    with tempfile.TemporaryDirectory() as folder:
        command = [program, "--quiet", "run", case, "--scheme", "event", "--end", repr(scene.end), "--out", folder]
        command += ["--sample", repr(scene.end / ROWS)]
        command += [] if restitution is None else ["--restitution", repr(restitution)]
        subprocess.run(command, check=True, stdout=subprocess.DEVNULL)
        with open(Path(folder, "trajectory.csv")) as file:
            return [float(row["displacement_m"]) for row in csv.DictReader(file)]


def error(scene, reference, rows):
    """Largest |difference| over the gap at `rows`, pairs of row number and displacement."""
    return max(abs(u - reference[i]) for i, u in rows) / scene.gap()


def event_driven(scene, advance, record):
    """From impact to impact. `advance(t, y, touching, record)` integrates m u'' + c u' + k u + (springs of `touching`) = f until a wall is
    reached or left, or to the end: it returns the time, the state, the wall (or none), and the rows passed."""
    t, y, touching, rows = 0.0, [scene.u, scene.v], frozenset(), []
    for _ in range(100_000):
        t, y, wall, passed = advance(t, y, touching, record)
        rows += passed
        if wall is None:
            return rows
        y[0] = scene.walls[wall].position
        if scene.walls[wall].restitution is None:
            touching = touching ^ {wall}
        else:
            y[1] = -scene.walls[wall].restitution * y[1]
            if abs(y[1]) < 1e-9:
                raise RuntimeError(f"impacts accumulate at t = {t:.6f} s")
    raise RuntimeError(f"100000 impacts by t = {t:.6f} s")
