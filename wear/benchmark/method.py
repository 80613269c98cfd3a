"""What the benchmark asks of a method, and what it gets."""

from __future__ import annotations

from collections.abc import Callable
from typing import TYPE_CHECKING, NamedTuple

if TYPE_CHECKING:
    from wear.scene import Scene


class Answer(NamedTuple):
    """Wear in mm after the last cycle.

    `estimate` is the method's own estimate of the relative error and `evaluations` the number of
    right-hand sides, None where it tells none; `complaint` is empty if it says that all went well;
    `stopped` if it was cut short by its time limit.
    """

    wear: float
    estimate: float | None = None
    evaluations: int | None = None
    complaint: str = ""
    stopped: bool = False


Run = Callable[[int, float], Answer]
"""Solve from the fresh state for the wear after so many cycles, to a relative tolerance."""


class Method(NamedTuple):
    """A way to solve a scene.

    `imports` are the modules whose import is part of its start-up, all of which have to be
    installed. `prepare` does what is done once a scene (bind, compile) and raises `UnsuitableError`
    for a scene that the method cannot solve. `tolerances` are those worth trying. `steps`: it goes
    through every cycle, so that time is expected to grow with their number.
    """

    name: str
    imports: tuple[str, ...]
    prepare: Callable[[Scene], Run]
    tolerances: tuple[float, ...]
    steps: bool = True


class UnsuitableError(Exception):
    """The method cannot solve the scene; the message says why."""
