"""The mutants that need no test, with the reason why: reads and writes harmless.toml.

A mutant is named by file, function, change and source line, and by its number among mutants that
have all of these in common (`a * b * c` has two `* to /`), so that a name outlives changes
elsewhere in the file. If the line itself changes, its names fit no mutant any more: `hunt.py list`
says so, and the new mutants of the line are looked at anew.
"""

import collections
import json
import tomllib
from pathlib import Path

LIST = Path(__file__).parent / "harmless.toml"
HEAD = """\
# Mutants that no test needs to notice: under each file the reason, and below it the mutants as
# "function | change | source line", with their number where a line has several such changes.
# `hunt.py name` adds to this list, `hunt.py list` leaves out what it names.
"""


def names(mutants):
    """The name of each mutant by its number: file and text."""
    met, found = collections.Counter(), {}
    for mutant in sorted(mutants, key=lambda m: (m["file"], m["line"], m["column"])):
        text = " | ".join(mutant[key] for key in ("function", "change", "source"))
        met[mutant["file"], text] += 1
        count = met[mutant["file"], text]
        found[mutant["id"]] = (mutant["file"], text + (f" | {count}" if count > 1 else ""))
    return found


def load():
    """The reason by name."""
    files = tomllib.loads(LIST.read_text()) if LIST.exists() else {}
    return {
        (file, text): why
        for file, reasons in files.items()
        for why, texts in reasons.items()
        for text in texts
    }


def save(reasons):
    """Writes all reasons, ordered by file, reason and text."""
    files = collections.defaultdict(lambda: collections.defaultdict(list))
    for (file, text), why in reasons.items():
        files[file][why].append(text)

    def quoted(text):
        return json.dumps(text, ensure_ascii=False)

    out = HEAD
    for file in sorted(files):
        out += f"\n[{quoted(file)}]\n"
        for why in sorted(files[file]):
            listed = "".join(f"  {quoted(text)},\n" for text in sorted(files[file][why]))
            out += f"{quoted(why)} = [\n{listed}]\n"
    LIST.write_text(out)
