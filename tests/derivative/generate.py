"""Writes the derivatives of random scenes that tests/derivative/scenes.rs compares with.

Independent of the crate: an integrator of its own with 42 digits (MPFR), whose flights are Taylor
series of 46 terms. The derivative is a central difference of two runs with the key changed by 1e-12
of itself, so that its error is about 1e-20 of it.

    python3 -m venv /tmp/venv && /tmp/venv/bin/pip install gmpy2 numpy
    /tmp/venv/bin/python tests/derivative/generate.py 0 1150 > tests/derivative/scenes.csv
    /tmp/venv/bin/python tests/derivative/generate.py 10000 10060 >> tests/derivative/scenes.csv

Scenes from number 10000 on are chains of five and six masses.

A line has the number of the scene, the derivatives of displacement and velocity of the first
degree of freedom at the end, and those of start, approach speed and impulse of its first contacts.
Both sides draw the scene from its number. Scenes in which a wall is nearly grazed, or which
accumulate impacts for too long, are left out.
"""

import multiprocessing
import sys

import gmpy2
import numpy as np
from gmpy2 import mpfr as mpf

gmpy2.get_context().precision = 140
TERMS = 46
CONTACTS = 4
TINY = mpf("1e-18")


class Skip(Exception):
    """The scene is not compared."""


class Draw:
    """The numbers of splitmix64, as in scenes.rs."""

    def __init__(self, seed):
        self.state = seed

    def unit(self):
        mask = (1 << 64) - 1
        self.state = (self.state + 0x9E3779B97F4A7C15) & mask
        z = self.state
        z = ((z ^ (z >> 30)) * 0xBF58476D1CE4E5B9) & mask
        z = ((z ^ (z >> 27)) * 0x94D049BB133111EB) & mask
        z ^= z >> 31
        return (z >> 11) * 2.0**-53

    def between(self, low, high):
        return low + (high - low) * self.unit()


def draw_law(draw):
    if draw.unit() < 0.55:
        e = draw.between(0.3, 0.95)
        if draw.unit() < 0.15:
            e = 0.0
        return {"rigid": True, "restitution": e, "stiffness": 0.0, "damping": 0.0}
    stiffness = draw.between(300.0, 3000.0)
    return {"rigid": False, "restitution": 0.0, "stiffness": stiffness, "damping": draw.between(0.0, 6.0)}


def draw_scene(number):
    """The scene of this number, and the key by which it is differentiated."""
    draw = Draw(number)
    n = 1 if draw.unit() < 0.6 else 2 + int(3.0 * draw.unit())
    if number >= 10000:
        n = 5 + number % 2
    s = {"n": n, "mass": [], "spring": [], "dash": [], "walls": []}
    for i in range(n):
        s["mass"].append(draw.between(0.5, 2.0))
        s["spring"].append(draw.between(20.0, 100.0))
        s["dash"].append(draw.between(0.0, 0.6))
    if n == 1 and draw.unit() < 0.25:
        s["spring"][0] = 0.0
    upper = {"row": [(n - 1, 1.0)], "sign": -1, "position": draw.between(0.02, 0.08)}
    s["walls"].append({**upper, **draw_law(draw)})
    if draw.unit() < 0.6:
        lower = {"row": [(0, 1.0)], "sign": 1, "position": -draw.between(0.02, 0.08)}
        s["walls"].append({**lower, **draw_law(draw)})
    if n > 1 and draw.unit() < 0.3:
        between = {"row": [(1, 1.0), (0, -1.0)], "sign": 1, "position": -draw.between(0.02, 0.06)}
        s["walls"].append({**between, **draw_law(draw)})
    s["amplitude"] = draw.between(1.0, 6.0)
    s["frequency"] = draw.between(0.6, 3.0)
    s["phase"] = draw.between(0.0, 6.0)
    s["constant"] = draw.between(-1.5, 1.5) if draw.unit() < 0.5 else 0.0
    s["blow"] = None
    if draw.unit() < 0.2:
        s["blow"] = draw.between(-0.3, 0.3)
        s["blow_time"] = draw.between(0.3, 1.0)
    s["q"] = [draw.between(-0.01, 0.01) for _ in range(n)]
    s["v"] = [draw.between(-0.3, 0.3) for _ in range(n)]
    s["duration"] = draw.between(1.2, 2.0)
    keys = [("mass", i) for i in range(n)]
    keys += [("spring", i) for i in range(n) if s["spring"][i] > 0.0]
    keys += [("dash", i) for i in range(n)]
    for w, wall in enumerate(s["walls"]):
        keys.append(("position", w))
        if wall["rigid"] and wall["restitution"] > 0.0:
            keys.append(("restitution", w))
        if not wall["rigid"]:
            keys += [("stiffness", w), ("damping", w)]
    keys += [("amplitude", 0), ("frequency", 0), ("phase", 0)]
    if s["constant"] != 0.0:
        keys.append(("constant", 0))
    if s["blow"] is not None:
        keys.append(("blow", 0))
    keys += [("q", i) for i in range(n)] + [("v", i) for i in range(n)]
    return s, keys[int(draw.unit() * len(keys))]


def changed(scene, key, change):
    """A copy of the scene in numbers of 42 digits, with the key changed by `change`."""
    name, index = key

    def number(x):
        return [number(y) for y in x] if isinstance(x, list) else mpf(x)

    s = {k: v if k in ("n", "walls") or v is None else number(v) for k, v in scene.items()}
    s["walls"] = [dict(wall) for wall in scene["walls"]]
    for wall in s["walls"]:
        for k in ("position", "restitution", "stiffness", "damping"):
            wall[k] = mpf(wall[k])
    if name in ("position", "restitution", "stiffness", "damping"):
        s["walls"][index][name] += change
    elif isinstance(s[name], list):
        s[name][index] += change
    else:
        s[name] += change
    return s


def dot(row, x):
    return sum((mpf(w) * x[i] for i, w in row), mpf(0))


class Run:
    """One motion, event by event."""

    def __init__(self, scene):
        self.s = scene
        self.t = mpf(0)
        self.q, self.v = list(scene["q"]), list(scene["v"])
        self.contacts, self.events = [], 0
        self.omega = 2 * gmpy2.const_pi() * scene["frequency"]
        self.blown = scene["blow"] is None
        for wall in scene["walls"]:
            wall["state"] = "out"
            wall["left"] = 0
            wall["open"] = None
        stiff = sum(float(k) for k in scene["spring"]) * 4 + sum(float(w["stiffness"]) for w in scene["walls"])
        lightest = min(float(m) for m in scene["mass"])
        damped = max(float(w["damping"]) for w in scene["walls"]) * 2 + 2.4
        self.rate = max((stiff * 2 / lightest) ** 0.5, damped * 2 / lightest, float(self.omega), 1.0)

    def series(self, held):
        """Coefficients of q in time from now, with those of the forces of held and touching walls."""
        s, n = self.s, self.s["n"]
        a = [self.q[:], self.v[:]]
        touching = [w for w in s["walls"] if w["state"] == "touch"]
        forces = {id(w): [] for w in touching + held}
        sin, cos = gmpy2.sin_cos(self.omega * self.t + s["phase"])
        power = mpf(1)
        for k in range(TERMS):
            if k > 0:
                power *= self.omega / k
            f = [mpf(0)] * n
            f[0] += s["amplitude"] * power * [sin, cos, -sin, -cos][k % 4]
            if k == 0:
                f[n - 1] += s["constant"]
            for i in range(n):
                left = (a[k][i] - a[k][i - 1], a[k + 1][i] - a[k + 1][i - 1]) if i else (a[k][0], a[k + 1][0])
                pull = s["spring"][i] * left[0] + s["dash"][i] * (k + 1) * left[1]
                f[i] -= pull
                if i:
                    f[i - 1] += pull
            for w in touching:
                depth = dot(w["row"], a[k]) - (w["position"] if k == 0 else 0)
                r = -w["stiffness"] * depth - w["damping"] * (k + 1) * dot(w["row"], a[k + 1])
                forces[id(w)].append(r)
                for i, g in w["row"]:
                    f[i] += mpf(g) * r
            acceleration = [f[i] / s["mass"][i] for i in range(n)]
            if held:
                for w, r in zip(held, self.balance(held, [-dot(w["row"], acceleration) for w in held])):
                    forces[id(w)].append(r)
                    for i, g in w["row"]:
                        acceleration[i] += mpf(g) * r / s["mass"][i]
            a.append([x / ((k + 1) * (k + 2)) for x in acceleration])
        return a, forces

    def balance(self, walls, wanted):
        """Impulses (or forces) at these walls that give their rows the wanted changes."""
        mass = self.s["mass"]

        def entry(a, b):
            return sum((mpf(g) * mpf(h) / mass[i] for i, g in a["row"] for j, h in b["row"] if i == j), mpf(0))

        rows = [[entry(a, b) for b in walls] + [x] for a, x in zip(walls, wanted)]
        for i, pivot in enumerate(rows):
            for row in rows[:i] + rows[i + 1 :]:
                share = row[i] / pivot[i]
                for j in range(i, len(row)):
                    row[j] -= share * pivot[j]
        return [row[-1] / row[i] for i, row in enumerate(rows)]

    def first_root(self, c, span, deflate):
        """The first root of a polynomial that is positive at first, in (0, span]; None without one."""
        c = c[deflate:]
        floats = np.array([float(x) for x in c][::-1])
        grid = np.linspace(0.0, span, 97)
        values = np.polyval(floats, grid)
        slope = np.polyval(np.polyder(floats), grid)
        size = abs(values).max()
        for i in range(96):
            if values[i] > 0 and values[i + 1] <= 0:
                x = mpf(grid[i] + (grid[i + 1] - grid[i]) * values[i] / (values[i] - values[i + 1]))
                low, high = mpf(grid[i]), mpf(grid[i + 1])
                for _ in range(60):
                    value, rate = mpf(0), mpf(0)
                    for coefficient in reversed(c):
                        rate = rate * x + value
                        value = value * x + coefficient
                    if value > 0:
                        low = x
                    else:
                        high = x
                    step = value / rate
                    x -= step
                    if abs(step) < mpf("1e-36"):
                        return x
                    if not low <= x <= high:
                        x = (low + high) / 2
                return x
            if slope[i] < 0 < slope[i + 1]:
                lowest = np.polyval(floats, np.linspace(grid[i], grid[i + 1], 33)).min()
                if lowest < 1e-3 * size:
                    raise Skip
        return None

    def run(self):
        s = self.s
        while self.t < s["duration"]:
            self.events += 1
            if self.events > 1500:
                raise Skip
            held = [w for w in s["walls"] if w["state"] == "held"]
            a, forces = self.series(held)
            until = s["duration"]
            if not self.blown and s["blow_time"] < until:
                until = s["blow_time"]
            rest = until - self.t
            span = min(rest, mpf(2.5 / self.rate))
            best = None
            for w in s["walls"]:
                for c, deflate, what in self.functions(w, a, forces):
                    x = self.first_root(c, float(span), deflate)
                    if x is not None and x <= span and (best is None or x < best[0]):
                        best = (x, w, what)
            x = best[0] if best else span
            for w in s["walls"]:
                if id(w) in forces and w["open"] is not None:
                    w["open"]["impulse"] += sum(
                        (f * x**(k + 1) / (k + 1) for k, f in enumerate(forces[id(w)])), mpf(0)
                    )
            powers = [mpf(1)]
            for _ in a[1:]:
                powers.append(powers[-1] * x)
            self.acceleration = [
                sum((a[k][i] * k * (k - 1) * powers[k - 2] for k in range(2, len(a))), mpf(0)) for i in range(s["n"])
            ]
            self.q, self.v = (
                [sum((a[k][i] * powers[k] for k in range(len(a))), mpf(0)) for i in range(s["n"])],
                [sum((a[k][i] * k * powers[k - 1] for k in range(1, len(a))), mpf(0)) for i in range(s["n"])],
            )
            self.t = self.t + x if best or span < rest else until
            for w in s["walls"]:
                w["left"] = 0
            if best:
                self.happen(best[1], best[2])
            elif not self.blown and self.t == s["blow_time"]:
                self.blown = True
                self.v[0] += s["blow"] / s["mass"][0]
                self.after_jump(True)
        return self.q[0], self.v[0], self.contacts

    def functions(self, w, a, forces):
        """Functions that are positive now, whose zero is an event of the wall."""
        gap = [w["sign"] * dot(w["row"], x) for x in a]
        gap[0] -= w["sign"] * w["position"]
        state = w["state"]
        if state == "out":
            return [(gap, w["left"], "hit")]
        if state == "held":
            return [([w["sign"] * f for f in forces[id(w)]], 0, "release")]
        if state == "touch":
            return [([w["sign"] * f for f in forces[id(w)]], w["left"], "end")]
        pull = [w["stiffness"] * gap[k] + w["damping"] * (k + 1) * gap[k + 1] for k in range(len(gap) - 1)]
        return [([-g for g in gap], 0, "emerge"), (pull, w["left"], "push")]

    def rate_of(self, w):
        return w["sign"] * dot(w["row"], self.v)

    def open(self, w, speed):
        w["open"] = {"wall": self.s["walls"].index(w), "start": self.t, "speed": speed, "impulse": mpf(0)}

    def close(self, w):
        if w["open"] is not None:
            self.contacts.append((w["open"]["wall"], w["open"]["start"], w["open"]["speed"], w["open"]["impulse"]))
            w["open"] = None

    def happen(self, w, what):
        if what == "hit" and w["rigid"]:
            self.impact(w)
        elif what == "hit":
            w["state"], w["left"] = "touch", int(w["damping"] == 0)
            self.open(w, -self.rate_of(w))
        elif what == "release":
            w["state"], w["left"] = "out", 3
            self.close(w)
        elif what == "end":
            w["state"], w["left"] = ("inside" if w["damping"] > 0 else "out"), 1
            self.close(w)
        elif what == "emerge":
            w["state"], w["left"] = "out", 1
        elif what == "push":
            w["state"], w["left"] = "touch", 1
            self.open(w, -self.rate_of(w))

    def impact(self, w):
        speed = -self.rate_of(w)
        if speed <= 0:
            raise Skip
        held = [h for h in self.s["walls"] if h["state"] == "held"]
        walls = [w] + held
        back = w["restitution"] * speed
        if back < TINY:
            back = mpf(0)
        while True:
            wanted = [w["sign"] * (speed + back)] + [mpf(0)] * (len(walls) - 1)
            pushes = self.balance(walls, wanted)
            wrong = [h for h, p in zip(walls[1:], pushes[1:]) if h["sign"] * p < 0]
            if not wrong:
                break
            walls = [h for h in walls if not any(h is x for x in wrong)]
        for h in held:
            if not any(h is x for x in walls):
                h["state"], h["left"] = "out", 1
                self.close(h)
        self.open(w, speed)
        for h, p in zip(walls, pushes):
            for i, g in h["row"]:
                self.v[i] += g * p / self.s["mass"][i]
            h["open"]["impulse"] += p
        if back > 0:
            w["left"] = 1
            self.close(w)
        else:
            w["state"] = "held"
        self.after_jump(False)

    def after_jump(self, blown):
        """Finds which walls hold and which elastic walls push after a jump of the velocity."""
        if blown:
            for w in [w for w in self.s["walls"] if w["state"] == "held"]:
                rate = self.rate_of(w)
                self.close(w)
                w["state"] = "out"
                if rate < 0:
                    self.impact(w)
                    return
                w["left"] = 1
        for w in self.s["walls"]:
            if w["rigid"]:
                continue
            depth = -w["sign"] * (dot(w["row"], self.q) - w["position"])
            if depth > 0:
                push = w["stiffness"] * depth - w["damping"] * self.rate_of(w)
                if push > 0 and w["state"] != "touch":
                    w["state"], w["left"] = "touch", 0
                    self.open(w, -self.rate_of(w))
                elif push <= 0 and w["state"] == "touch":
                    w["state"], w["left"] = "inside", 0
                    self.close(w)
            elif w["state"] != "out" and w["left"] == 0 and depth < 0:
                w["state"] = "out"
        held = [w for w in self.s["walls"] if w["state"] == "held"]
        if not held:
            return
        _, forces = self.series(held)
        for w in held:
            if w["sign"] * forces[id(w)][0] <= 0:
                w["state"], w["left"] = "out", 2
                self.close(w)
                return self.after_jump(False)


def value_of(scene, key):
    name, index = key
    if name in ("position", "restitution", "stiffness", "damping"):
        return scene["walls"][index][name]
    return scene[name][index] if isinstance(scene[name], list) else scene[name]


def line_of(number):
    scene, key = draw_scene(number)
    value = value_of(scene, key)
    change = mpf("1e-12") * mpf(abs(value))
    try:
        low, high = (Run(changed(scene, key, by)).run() for by in (-change, change))
    except (Skip, ZeroDivisionError):
        return None
    (q0, v0, c0), (q1, v1, c1) = low, high
    if [c[0] for c in c0] != [c[0] for c in c1]:
        return None
    numbers = [q1 - q0, v1 - v0]
    for a, b in list(zip(c0, c1))[:CONTACTS]:
        numbers += [y - x for x, y in zip(a[1:], b[1:])]
    return ",".join([str(number)] + [f"{float(x / (2 * change)):.10e}" for x in numbers])


def main():
    with multiprocessing.Pool(1) as pool:
        for line in pool.imap(line_of, range(int(sys.argv[1]), int(sys.argv[2])), chunksize=4):
            if line:
                print(line, flush=True)


if __name__ == "__main__":
    main()
