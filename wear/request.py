"""Checks of a request to a solver: every fault becomes a sentence among its `faults`."""

from __future__ import annotations

import math
import numbers
import os
from collections.abc import Iterable, Sequence, Sized
from itertools import islice
from typing import Any

import numpy as np
from numpy.typing import ArrayLike

from wear import direct
from wear.faults import Faults, UsageError
from wear.load import HistoryLoad
from wear.load.spans import most_cycles
from wear.quantities import MOST_CYCLES
from wear.scene import Scene, as_scenes

METHODS = ("auto", "abel", "collocation", *direct.METHODS)
ONE_PERIOD = 'take one period of the record, kind = "table", repeat = true'
LEAST_RTOL, LARGEST_RTOL = 1e-15, 0.1
MOST_ITERATED = 10**6  # numbers taken from an iterator, which may be endless


def is_number(given: object) -> bool:
    """Return whether an object is a real number and no truth value."""
    return isinstance(given, numbers.Real) and not isinstance(given, bool)


def whole_cycles(
    cycles: float | Iterable[float], faults: Faults, least: int = 0
) -> tuple[int, ...]:
    """Return numbers of cycles, or one, as integers; invalid ones are added to the `faults`."""
    several = _several(cycles)
    wanted = []
    for n in several:
        if is_number(n) and least <= n <= MOST_CYCLES and n == int(n):
            wanted.append(int(n))
        else:
            faults.append(f"cycles: {n!r} is not a whole number from {least} to 1e12")
    if not several:
        faults.append("cycles: give at least one number of cycles")
    return tuple(wanted)


def cycles_along(first: float, last: float, points: int, *others: ArrayLike) -> list[int]:
    """Return numbers of cycles in geometric progression for a curve, merged with `others`.

    >>> cycles_along(1, 1000, 4, [0, 500])
    [0, 1, 10, 100, 500, 1000]
    """
    every = np.concatenate([np.geomspace(first, last, points), *map(np.asarray, others)])
    return [int(cycle) for cycle in np.unique(np.rint(every))]


def wear_depths(wear_mm: float | Iterable[float], faults: Faults) -> tuple[float, ...]:
    """Return depths of wear in mm, or one; invalid ones are added to the `faults`."""
    depths = []
    for depth in _several(wear_mm):
        if is_number(depth) and 0.0 <= depth < math.inf:
            depths.append(float(depth))
        else:
            faults.append(f"wear: {depth!r} is not a depth in mm; give a number >= 0")
    return tuple(depths)


def _several(given: Any) -> list[Any]:
    """Return a list of the numbers of a list, an array, a series of pandas or xarray, or of one
    number."""
    if hasattr(given, "to_numpy"):
        given = given.to_numpy()
    if isinstance(given, np.ndarray | np.generic):
        given = given.tolist()
    if not isinstance(given, Iterable) or isinstance(given, str | bytes):
        return [given]
    in_memory = isinstance(given, Sized) and not isinstance(given, range)
    numbers = list(given) if in_memory else list(islice(given, MOST_ITERATED + 1))
    if not in_memory and len(numbers) > MOST_ITERATED:
        said = f"a {type(given).__name__} gives more than {MOST_ITERATED} numbers"
        raise UsageError(f"{said}; give a list")
    return numbers


def check_rtol(rtol: float, faults: Faults, least: float = LEAST_RTOL) -> None:
    """Check a requested relative accuracy."""
    if not is_number(rtol) or not least <= rtol <= LARGEST_RTOL:
        faults.append(f"rtol: {rtol!r} is not between {least:g} and {LARGEST_RTOL:g}")


def checked_scenes(
    scenes: Sequence[Scene | str | os.PathLike[str]],
    rtol: float,
    faults: Faults,
    cycles: Iterable[float] = (),
) -> list[Scene]:
    """Return the scenes of a request, or raise its `faults` and those of these checks."""
    check_rtol(rtol, faults)
    faults.stop_if_any()
    known = as_scenes(scenes)
    check_end(known, cycles, faults)
    faults.stop_if_any()
    return known


def check_end(scenes: Iterable[Scene], cycles: Iterable[float], faults: Faults) -> None:
    """Check that the loads of all scenes go on for these numbers of cycles."""
    last = min((most_cycles(scene.load) for scene in scenes), default=MOST_CYCLES)
    if max(cycles, default=0) > last:
        faults.append(f"cycles: the last whole cycle of the load is {last}; name cycles up to that")


def obstacle(scene: Scene) -> str | None:
    """Return the reason why cycles of this scene cannot be counted, None if they can."""
    return "the load does not repeat" if isinstance(scene.load, HistoryLoad) else None


def checked_request(
    scene: Scene,
    cycles: float | Iterable[float],
    rtol: float,
    method: str = "abel",
    time_limit: float | None = None,
) -> tuple[int, ...]:
    """Return the numbers of cycles as integers.

    Raises
    ------
    UsageError
        with all faults of the request.
    """
    faults = Faults()
    wanted = whole_cycles(cycles, faults)
    check_rtol(rtol, faults)
    if method not in METHODS:
        faults.append(f"method: {method!r} is none of {', '.join(METHODS)}")
    elif method == "abel" and obstacle(scene) is not None:
        faults.append(f"method: abel is not for this scene: {obstacle(scene)}; take auto")
    elif method == "collocation" and obstacle(scene) is None:
        faults.append("method: collocation is for a measured history; take auto")
    if time_limit is not None and not (is_number(time_limit) and time_limit > 0.0):
        faults.append(f"time_limit: {time_limit!r} is not a positive number of seconds")
    check_end([scene], wanted, faults)
    faults.stop_if_any()
    return wanted
