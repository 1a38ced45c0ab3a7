#!/usr/bin/env python3
"""Runs every built-in case with two builds of the tool and names the result files that differ.

    python3 tests/compare_builds.py OLD/signorini target/release/signorini

Each case runs by its own scheme to its own end, and by each scheme of --schemes for --end seconds.
Compared are all CSV and SVG files, byte for byte, and the exit codes. A change that moves code and
no results leaves no difference; every difference that is left needs its reason in the commit.
Exit code 1 if anything differs.
"""

import argparse
import subprocess
import sys
import tempfile
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

CASES = Path(__file__).parent.parent / "cases"
KINDS = (".csv", ".svg")


def run(build: str, case: Path, options: list[str], out: Path) -> int:
    command = [build, "run", str(case), "--quiet", "--no-verdict", "--no-report", "--out", str(out)]
    return subprocess.run(command + options, capture_output=True).returncode


def first_difference(old: bytes, new: bytes) -> str:
    lines = list(zip(old.split(b"\n"), new.split(b"\n")))
    for number, (left, right) in enumerate(lines, 1):
        if left != right:
            return f"line {number}: {left[:60]!r} -> {right[:60]!r}"
    return f"{len(old)} -> {len(new)} bytes"


def compare(job: tuple[argparse.Namespace, Path, str | None]) -> tuple[int, list[str]]:
    asked, case, scheme = job
    title = f"{case.stem} by {scheme or 'its own scheme'}"
    options = ["--scheme", scheme, "--end", asked.end] if scheme else []
    differences = []
    with tempfile.TemporaryDirectory() as folder:
        outs = [Path(folder, side) for side in ("old", "new")]
        builds = (asked.old, asked.new)
        codes = [run(build, case, options, out) for build, out in zip(builds, outs)]
        if codes[0] != codes[1]:
            differences.append(f"{title}: exit code {codes[0]} -> {codes[1]}")
        files = [{f.relative_to(out) for f in out.rglob("*") if f.suffix in KINDS} for out in outs]
        names = sorted(files[0] | files[1])
        for name in names:
            if name not in files[0] & files[1]:
                side = "old" if name in files[1] else "new"
                differences.append(f"{title}: {name} is missing in the {side} results")
                continue
            old, new = [(out / name).read_bytes() for out in outs]
            if old != new:
                differences.append(f"{title}: {name}, {first_difference(old, new)}")
    return len(names), differences


def main() -> int:
    raw = argparse.RawDescriptionHelpFormatter
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=raw)
    parser.add_argument("old", help="the tool as it was")
    parser.add_argument("new", help="the tool as it is")
    schemes = "event,moreau-jean,generalized-alpha,penalty"
    parser.add_argument("--schemes", default=schemes, help=f"comma-separated [{schemes}]")
    parser.add_argument("--end", default="2", help="end of the runs by --schemes, s")
    parser.add_argument("--threads", type=int, default=2)
    asked = parser.parse_args()
    asked_schemes = [None, *filter(None, asked.schemes.split(","))]
    cases = sorted(CASES.glob("*.toml"))
    jobs = [(asked, case, scheme) for case in cases for scheme in asked_schemes]
    with ThreadPoolExecutor(asked.threads) as pool:
        results = list(pool.map(compare, jobs))
    differences = [line for _, lines in results for line in lines]
    compared = sum(count for count, _ in results)
    print(*differences, f"{compared} files compared, {len(differences)} differences", sep="\n")
    return int(bool(differences))


if __name__ == "__main__":
    sys.exit(main())
