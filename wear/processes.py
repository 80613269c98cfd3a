"""Other processes: workers, and an assistant for tasks that can be done meanwhile."""

from __future__ import annotations

import multiprocessing
import os
import signal
from collections.abc import Callable, Iterator
from concurrent.futures import ProcessPoolExecutor
from contextlib import contextmanager
from multiprocessing.context import SpawnContext, SpawnProcess
from typing import Any

Ask = Callable[..., Callable[[], Any]]
"""Submits a task, with the arguments of `submit`; returns a function that fetches the result."""


def cores() -> int:
    """Return the number of cores that this process may use."""
    counted = os.process_cpu_count() if hasattr(os, "process_cpu_count") else os.cpu_count()
    return counted or 1


class _Worker(SpawnProcess):
    """A process that Ctrl-C does not end: not even while it starts, before `_ignore_interrupts`."""

    def start(self) -> None:
        if not hasattr(signal, "pthread_sigmask"):
            super().start()
            return
        before = signal.pthread_sigmask(signal.SIG_BLOCK, {signal.SIGINT})
        try:
            super().start()  # the process inherits the mask
        finally:
            signal.pthread_sigmask(signal.SIG_SETMASK, before)


class _Context(SpawnContext):
    Process = _Worker


@contextmanager
def workers(number: int) -> Iterator[ProcessPoolExecutor]:
    """Provide a number of processes; an exception, such as Ctrl-C, ends their work."""
    pool = ProcessPoolExecutor(number, mp_context=_Context(), initializer=_ignore_interrupts)
    try:
        yield pool
        pool.shutdown()
    except BaseException:  # unfinished tasks are not waited for
        pool.shutdown(wait=False, cancel_futures=True)
        for process in multiprocessing.active_children():
            process.terminate()
        raise


@contextmanager
def assistant() -> Iterator[Ask]:
    """Provide a function that submits tasks to a second core, if there is one, where they run one
    after another; a task that is fetched before it has begun runs here."""

    def alone(task, *given, **named):  # type: ignore[no-untyped-def]
        return lambda: task(*given, **named)

    if cores() == 1:
        yield alone
        return
    with workers(1) as pool:

        def ask(task, *given, **named):  # type: ignore[no-untyped-def]
            future = pool.submit(task, *given, **named)
            return lambda: task(*given, **named) if future.cancel() else future.result()

        yield ask


def _ignore_interrupts() -> None:
    """Leave Ctrl-C to the process that the user started."""
    signal.signal(signal.SIGINT, signal.SIG_IGN)
