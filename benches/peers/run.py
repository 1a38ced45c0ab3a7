"""Times other programs on a scene of signorini's and writes the points that `signorini chart --with` lays over its own.

    python run.py ../../cases/rigid-walls-sine.toml --end 1 --restitution 1 --out peers.csv

A program that is not installed is skipped by name; a run that fails is a row with the reason in it."""

import argparse
import csv
import importlib
import importlib.util
import os
import shutil
import subprocess
import sys
import tempfile
from pathlib import Path

import scene as scenes

PEERS = ("scipy", "cvode", "cvode_c", "diffrax", "mujoco", "opensees", "siconos")
COLUMNS = ("program", "method", "setting", "error_over_gap", "seconds", "remark")
HERE = Path(__file__).absolute().parent
LONGEST = 5.0  # s; a run longer than this is not repeated


def measure(simulate, repeats):
    """Best of `repeats` after a warm-up, and the rows of one more run; nothing recorded while the clock runs for a time."""
    warm, rows = simulate(True)
    if warm > LONGEST:
        return warm, rows
    return min(simulate(False)[0] for _ in range(repeats)), rows


def points(name, scene, reference, repeats):
    try:
        peer = importlib.import_module(f"peer_{name}")
    except Exception as missing:  # OpenSeesPy raises more than ImportError
        print(f"{name}: skipped, {missing}", file=sys.stderr)
        return
    try:
        for method, setting, simulate in peer.runs(scene):
            try:
                seconds, rows = measure(simulate, repeats)
                error = scenes.error(scene, reference, rows)
                print(f"{peer.PROGRAM:12}{method:20}{setting:12}{error:10.1e}{seconds:12.3e} s", file=sys.stderr)
                yield peer.PROGRAM, method, setting, repr(float(error)), repr(float(seconds)), ""
            except Exception as failure:  # whatever a program throws is its row
                print(f"{peer.PROGRAM:12}{method:20}{setting:12}failed: {failure}", file=sys.stderr)
                yield peer.PROGRAM, method, setting, "", "", f"failed: {failure}"
    except ValueError as refusal:
        print(f"{name}: skipped, {refusal}", file=sys.stderr)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("case", help="case file")
    parser.add_argument("--end", type=float, help="end of the run, s")
    parser.add_argument("--restitution", type=float, help="restitution of every rigid wall")
    parser.add_argument("--out", default="peers.csv", help="file to write")
    parser.add_argument("--only", help="peers to run, separated by commas", default=",".join(PEERS))
    parser.add_argument("--repeats", type=int, default=5, help="timed runs of each point; the fastest counts")
    parser.add_argument("--signorini", default=shutil.which("signorini") or "../../target/release/signorini")
    parser.add_argument("--siconos-python", default="/usr/bin/python3", help="the interpreter that has Siconos, if this one has not")
    args = parser.parse_args()
    scene = scenes.Scene.read(args.case, args.end, args.restitution)
    reference = scenes.exact(args.signorini, args.case, scene, args.restitution)
    out, args.case, args.signorini = Path(args.out).absolute(), str(Path(args.case).absolute()), shutil.which(args.signorini)
    rows = []
    os.chdir(tempfile.mkdtemp(prefix="peers-"))  # MuJoCo leaves a log where it stands
    for name in args.only.split(","):
        if name == "siconos" and importlib.util.find_spec("siconos") is None and shutil.which(args.siconos_python):
            rows += elsewhere(args, out)
        else:
            rows += points(name, scene, reference, args.repeats)
    with open(out, "w", newline="") as file:
        writer = csv.writer(file)
        writer.writerow(COLUMNS)
        writer.writerows(rows)


def elsewhere(args, out):
    """Siconos by the interpreter that has it: Debian's is built for Debian's Python and NumPy."""
    part = out.with_suffix(".siconos.csv")
    command = [args.siconos_python, str(HERE / "run.py"), args.case, "--only", "siconos", "--out", str(part), "--siconos-python", ""]
    command += ["--signorini", args.signorini, "--repeats", str(args.repeats)]
    for option, value in (("--end", args.end), ("--restitution", args.restitution)):
        command += [] if value is None else [option, repr(value)]
    if subprocess.run(command).returncode != 0 or not part.exists():
        return []
    with open(part) as file:
        rows = list(csv.reader(file))[1:]
    os.remove(part)
    return rows


if __name__ == "__main__":
    main()
