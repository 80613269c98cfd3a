"""A limit of CPU time for symbolic steps: a clear error instead of an endless simplification."""

from __future__ import annotations

import signal
import threading
from collections.abc import Iterator
from contextlib import contextmanager
from types import FrameType


class TimeLimitError(ValueError):
    """A step exceeded its time limit; the message names it."""


@contextmanager
def time_limit(seconds: float, step: str) -> Iterator[None]:
    """Raise TimeLimitError, which names the step, when the block needs more CPU time.

    Signals reach the main thread of a POSIX process only; elsewhere there is no limit.  Limits
    may be nested: after the inner block the outer limit continues with its remaining time.
    """

    def stop(_: int, __: FrameType | None) -> None:
        raise TimeLimitError(f"{step}: not done after {seconds:g} s of CPU time")

    usable = hasattr(signal, "setitimer")
    if not usable or threading.current_thread() is not threading.main_thread():
        yield
        return
    before = signal.signal(signal.SIGVTALRM, stop)
    remaining, _ = signal.setitimer(signal.ITIMER_VIRTUAL, seconds)
    try:
        yield
    finally:
        used = seconds - signal.getitimer(signal.ITIMER_VIRTUAL)[0]
        signal.signal(signal.SIGVTALRM, before)
        signal.setitimer(signal.ITIMER_VIRTUAL, max(remaining - used, 1e-3) if remaining else 0)
