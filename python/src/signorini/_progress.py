"""Progress of a long computation, on the terminal."""

from __future__ import annotations

import sys
import time
from types import TracebackType
from typing import Self

_PATIENCE = 1.0
_INTERVAL = 0.2


class Progress:
    """A line on stderr, if that is a terminal, after the first second."""

    def __init__(self, total: int, wanted: bool, done: int = 0, of: str = "runs") -> None:
        self.total, self.done, self.found, self.of = total, done, done, of
        self.wanted = wanted and sys.stderr is not None and sys.stderr.isatty()
        self.started = self.told = time.monotonic()
        self.shown = False

    def tell(self, further: int) -> None:
        """Show that ``further`` runs are done beyond those counted."""
        now = time.monotonic()
        if not self.wanted or now - self.started < _PATIENCE or now - self.told < _INTERVAL:
            return
        self.told, self.shown = now, True
        done = min(self.done + further, self.total)
        rate = (done - self.found) / (now - self.started)
        left = f", {(self.total - done) / rate:.0f} s left" if rate > 0 else ""
        print(f"\r{done} of {self.total} {self.of}{left}\033[K", end="", file=sys.stderr, flush=True)

    def reach(self, done: int, total: int) -> None:
        """Show that ``done`` runs of ``total`` are done, where their number is not known before."""
        self.total = total
        self.tell(done - self.done)

    def step(self, further: int) -> None:
        """Count ``further`` runs as done."""
        self.done += further
        self.tell(0)

    def __enter__(self) -> Self:
        return self

    def __exit__(
        self, kind: type[BaseException] | None, error: BaseException | None, trace: TracebackType | None
    ) -> None:
        if self.shown:
            print("\r\033[K", end="", file=sys.stderr, flush=True)
