"""Tests the tests: which mutants of the source does no test notice?

    python3 -m venv target/mutants/venv && . target/mutants/venv/bin/activate
    pip install tree-sitter tree-sitter-rust
    python3 tests/mutants/hunt.py plant src/qp src/contact.rs   # one copy, one build: minutes
    python3 tests/mutants/hunt.py trace                         # each test once, alone
    python3 tests/mutants/hunt.py hunt --seconds 15             # at most so long for each mutant
    python3 tests/mutants/hunt.py list src/qp/clamp.rs          # those that live
    python3 tests/mutants/hunt.py name 17 18 --why "..."        # these two are harmless

Everything but the list of harmless mutants lies in target/mutants/. `hunt` can be stopped and
started again, and again with more seconds; each test runs once on a mutant, the most likely ones
first.
"""

import argparse
import collections
import json
import os
import signal
import subprocess
import threading
import time
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

import harmless
from plant import plant

ROOT = Path(__file__).resolve().parents[2]
PLACE = ROOT / "target/mutants"
COPY, COVER, RESULTS, TESTS = (
    PLACE / "copy",
    PLACE / "cover",
    PLACE / "results.jsonl",
    PLACE / "tests.jsonl",
)
# These look at the source or start the tool, which is another program.
NOT_RUN = {"house", "figure", "tool", "report", "memory"}
# A mutant whose tests take this many times longer than usual does not end.
PATIENCE = 10.0


def lines(path):
    return [json.loads(line) for line in path.read_text().splitlines()] if path.exists() else []


def build():
    """Builds the tests of the copy; returns the programs by name, and what did not compile."""
    quick = {
        "INCREMENTAL": "1",
        "PROFILE_RELEASE_OPT_LEVEL": "1",
        "PROFILE_RELEASE_CODEGEN_UNITS": "64",
    }
    environment = os.environ | {f"CARGO_{key}": value for key, value in quick.items()}
    environment |= {"CARGO_TARGET_DIR": str(PLACE / "target"), "RUSTFLAGS": "--cap-lints allow"}
    command = [
        "cargo",
        "test",
        "--no-run",
        "--release",
        "-p",
        "signorini",
        "--lib",
        "--tests",
        "--message-format=json",
    ]
    said = subprocess.run(
        command, cwd=COPY, env=environment, stdout=subprocess.PIPE, text=True
    ).stdout
    programs, wrong = {}, []
    for message in map(json.loads, said.splitlines()):
        if (
            message["reason"] == "compiler-artifact"
            and message.get("executable")
            and message["profile"]["test"]
        ):
            target = message["target"]
            name = "lib" if "lib" in target["kind"] else target["name"]
            if "bin" not in target["kind"] and name not in NOT_RUN:
                programs[name] = message["executable"]
        elif message["reason"] == "compiler-message" and message["message"]["level"] == "error":
            wrong += [place(span) for span in message["message"]["spans"]]
    return programs, wrong


def place(span):
    """File and line of what the compiler shows: for a macro, of the place that calls it."""
    while span["expansion"] is not None:
        span = span["expansion"]["span"]
    return span["file_name"], span["line_start"]


def sow(paths):
    """Plants and builds, leaving out the mutants of lines that do not compile."""
    skip = set()
    for _ in range(10):
        mutants = plant(ROOT, COPY, paths, skip)
        programs, wrong = build()
        if not wrong:
            (PLACE / "programs.json").write_text(json.dumps(programs))
            for old in (RESULTS, TESTS):
                old.unlink(missing_ok=True)
            print(
                f"{len(mutants)} mutants, {len(skip)} that do not compile left out; "
                f"{len(programs)} programs of tests"
            )
            return
        # The copy has the lines of the source: a rewritten expression stays on its lines.
        skip |= {
            (m["file"], *m["place"], m["kind"])
            for m in mutants
            if (m["file"], m["place"][0]) in wrong
        }
    raise SystemExit(f"does not compile: {wrong[:5]}")


def trace():
    """Runs each test alone, once, and notes its time and the mutants that it reaches."""
    programs = json.loads((PLACE / "programs.json").read_text())
    COVER.mkdir(parents=True, exist_ok=True)
    found = []
    for name, path in programs.items():
        listed = subprocess.run([path, "--list"], cwd=COPY, capture_output=True, text=True).stdout
        found += [(name, line[:-6]) for line in listed.splitlines() if line.endswith(": test")]

    def one(number):
        name, test = found[number]
        began = time.monotonic()
        environment = os.environ | {"MUTANT": f"trace:{COVER / str(number)}"}
        try:
            made = subprocess.run(
                [programs[name], "--exact", test],
                cwd=COPY,
                env=environment,
                capture_output=True,
                timeout=60,
            ).returncode
        except subprocess.TimeoutExpired:
            made = None
        return {
            "number": number,
            "program": name,
            "test": test,
            "s": time.monotonic() - began,
            "passed": made == 0,
        }

    with ThreadPoolExecutor(os.cpu_count()) as pool:
        tests = list(pool.map(one, range(len(found))))
    TESTS.write_text("".join(json.dumps(test) + "\n" for test in tests))
    slow = sum(not test["passed"] for test in tests)
    print(f"{len(tests)} tests, {slow} of them too slow or failing, left out")


class Hunt:
    """The search for a test that fails on each mutant."""

    def __init__(self, seconds):
        self.seconds, self.lock = seconds, threading.Lock()
        self.programs = json.loads((PLACE / "programs.json").read_text())
        self.mutants = {
            mutant["id"]: mutant for mutant in json.loads((COPY / "mutants.json").read_text())
        }
        self.names, self.reasons = harmless.names(self.mutants.values()), harmless.load()
        self.tests = {test["number"]: test for test in lines(TESTS) if test["passed"]}
        self.able = collections.defaultdict(list)
        for number in self.tests:
            cover = COVER / str(number)
            for mutant, byte in enumerate(cover.read_bytes() if cover.exists() else b""):
                if byte & 2:
                    self.able[mutant].append(number)
        self.ran, self.dead = collections.defaultdict(set), {}
        self.killers = collections.defaultdict(collections.Counter)
        for result in lines(RESULTS):
            self.ran[result["id"]] |= set(result["ran"])
            if result["by"] is not None:
                self.bury(result["id"], result["by"])

    def bury(self, mutant, test):
        entry = self.mutants[mutant]
        self.dead[mutant] = test
        self.killers[entry["file"]][test] += 1
        self.killers[entry["file"], entry["function"]][test] += 1

    def is_harmless(self, mutant):
        return self.names[mutant] in self.reasons

    def ordered(self, mutant):
        """The tests that may kill the mutant: short ones first, and those that killed its
        neighbours."""
        entry = self.mutants[mutant]
        near, far = self.killers[entry["file"], entry["function"]], self.killers[entry["file"]]

        def worth(test):
            kills = 1 + 20 * min(near[test], 3) + 3 * min(far[test], 3)
            return kills / (self.tests[test]["s"] + 0.03)

        left = (test for test in self.able[mutant] if test not in self.ran[mutant])
        return sorted(left, key=worth, reverse=True)

    def fails(self, mutant, program, tests):
        """The first of these tests of a program that fails on the mutant, or does not end."""
        names = {self.tests[test]["test"]: test for test in tests}
        process = subprocess.Popen(
            [self.programs[program], "--exact", "--test-threads=1", *names],
            cwd=COPY,
            text=True,
            errors="replace",
            env=os.environ | {"MUTANT": str(mutant)},
            stdout=subprocess.PIPE,
            stderr=subprocess.DEVNULL,
            start_new_session=True,
        )

        def stop():
            os.killpg(process.pid, signal.SIGKILL)

        timer = threading.Timer(5 + PATIENCE * sum(self.tests[test]["s"] for test in tests), stop)
        timer.start()
        failed = None
        for line in process.stdout:
            if line.startswith("test ") and line.rstrip().endswith("FAILED"):
                failed = names.get(line[5:].split(" ... ")[0], tests[0])
                stop()
                break
        timer.cancel()
        return failed if failed is not None or process.wait() == 0 else tests[0]

    def one(self, mutant):
        """Runs tests in groups of growing length until one fails or the time is up."""
        with self.lock:
            tests = self.ordered(mutant)
        ran, spent, group, killer = [], 0.0, 0.15, None
        while tests and killer is None and spent < self.seconds:
            chosen, length = [], 0.0
            while tests and (not chosen or length + self.tests[tests[0]]["s"] <= group):
                chosen.append(tests.pop(0))
                length += self.tests[chosen[-1]]["s"]
            by_program = collections.defaultdict(list)
            for test in chosen:
                by_program[self.tests[test]["program"]].append(test)
            for program, some in by_program.items():
                killer = self.fails(mutant, program, some) if killer is None else killer
            ran, spent, group = ran + chosen, spent + length, 2 * group
        with self.lock, RESULTS.open("a") as results:
            results.write(
                json.dumps({"id": mutant, "by": killer, "ran": ran, "left": len(tests)}) + "\n"
            )
            if killer is not None:
                self.bury(mutant, killer)

    def go(self, workers):
        alive = [
            mutant
            for mutant in self.mutants
            if mutant not in self.dead and not self.is_harmless(mutant) and self.ordered(mutant)
        ]
        print(f"{len(alive)} of {len(self.mutants)} mutants to hunt", flush=True)
        with ThreadPoolExecutor(workers) as pool:
            for done, _ in enumerate(pool.map(self.one, alive), 1):
                if done % 100 == 0:
                    print(f"{done} hunted, {len(self.dead)} dead", flush=True)
        named = sum(self.is_harmless(mutant) for mutant in self.mutants)
        beyond = sum(not self.able[mutant] for mutant in self.mutants)
        print(
            f"{len(self.mutants)} mutants, {len(self.dead)} dead, {named} named harmless, "
            f"{beyond} out of reach of all tests"
        )

    def show(self, paths):
        for number, mutant in self.mutants.items():
            asked = any(mutant["file"].startswith(path) for path in paths or [""])
            if asked and number not in self.dead and not self.is_harmless(number):
                able = f"{len(self.able[number])} tests" if self.able[number] else "out of reach"
                place = f"{mutant['file']}:{mutant['line']}:{mutant['column']}"
                print(
                    f"{number} {place} {mutant['change']} ({able}) in {mutant['function']}: "
                    f"{mutant['source']}"
                )
        planted = {mutant["file"] for mutant in self.mutants.values()}
        known = set(self.names.values())
        for file, text in self.reasons:
            if file in planted and (file, text) not in known:
                print(f"harmless.toml names a mutant that is no more: {file}: {text}")

    def name(self, mutants, why):
        harmless.save(self.reasons | {self.names[mutant]: why for mutant in mutants})


def main():
    parser = argparse.ArgumentParser(
        description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter
    )
    commands = parser.add_subparsers(dest="command", required=True)
    commands.add_parser("plant").add_argument("paths", nargs="+", help="files and folders of src")
    commands.add_parser("trace")
    hunt = commands.add_parser("hunt")
    hunt.add_argument("--seconds", type=float, default=15.0, help="time of tests for each mutant")
    hunt.add_argument("--workers", type=int, default=os.cpu_count())
    commands.add_parser("list").add_argument("paths", nargs="*", help="files and folders of src")
    name = commands.add_parser("name")
    name.add_argument("mutants", nargs="+", type=int, help="their numbers in `list`")
    name.add_argument("--why", required=True, help="why no result can change")
    asked = parser.parse_args()
    match asked.command:
        case "plant":
            sow(asked.paths)
        case "trace":
            trace()
        case "hunt":
            Hunt(asked.seconds).go(asked.workers)
        case "list":
            Hunt(0.0).show(asked.paths)
        case "name":
            Hunt(0.0).name(asked.mutants, asked.why)


if __name__ == "__main__":
    main()
