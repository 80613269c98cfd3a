"""Progress of a task, reported at intervals once it takes more than two seconds."""

from __future__ import annotations

import time
from collections.abc import Callable

SILENT, APART = 2.0, 0.5  # s, before the first report, and between two


class Pace:
    """Reports to `progress` the completed part of a task, and its remaining time at this pace."""

    def __init__(self, progress: Callable[[str], None] = lambda _: None) -> None:
        self._progress = progress
        self._next = time.monotonic() + SILENT
        self.begin("", 0)

    def begin(self, part: str, last: float) -> None:
        """Start a task of `last` parts, such as cycles or scenes."""
        self._part, self._last, self._start = part, last, time.monotonic()

    def at(self, done: float) -> None:
        """Report the number of completed parts."""
        seconds = time.monotonic() - self._start
        left = seconds * (self._last - done) / max(done, 1e-9)
        self.say(f"{self._part} {int(done)} of {self._last:.10g}, about {left:.0f} s left")

    def say(self, words: str) -> None:
        """Report the progress in words, if the last report is long enough ago."""
        now = time.monotonic()
        if now >= self._next:
            self._next = now + APART
            self._progress(words)
