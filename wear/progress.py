"""How far a task is, told now and then once it takes more than two seconds."""

from __future__ import annotations

import time
from collections.abc import Callable

SILENT, APART = 2.0, 0.5  # s, before the first report, and between two


class Pace:
    """Tells `progress` how far a task is, and how long it will take at the pace so far."""

    def __init__(self, progress: Callable[[str], None] = lambda _: None) -> None:
        self._progress = progress
        self._next = time.monotonic() + SILENT
        self.begin("", 0)

    def begin(self, what: str, last: float) -> None:
        """Start a task of so many parts, such as cycles or scenes."""
        self._what, self._last, self._start = what, last, time.monotonic()

    def at(self, done: float) -> None:
        """Report that so many parts are done."""
        seconds = time.monotonic() - self._start
        left = seconds * (self._last - done) / max(done, 1e-9)
        self.say(f"{self._what} {int(done)} of {self._last:.10g}, about {left:.0f} s left")

    def say(self, words: str) -> None:
        """Report how far the task is in words, if it is time to."""
        now = time.monotonic()
        if now >= self._next:
            self._next = now + APART
            self._progress(words)
