"""Means over a cycle of functions of the load, to roundoff.

Overview
    A cycle is cut where the load turns or has a kink, and where it crosses a level at which the
    function is not smooth. Towards the ends of each part the intervals of a Gauss rule shrink by
    halves until the load changes by less than the scale of the function, so that no pulse and no
    sharp peak is missed.
Key results
    cycle_mean    the mean of a function of the load
"""

from __future__ import annotations

from collections.abc import Callable, Iterable

import numpy as np

from wear.load import Load
from wear.loss_of_contact.edge import turning_points
from wear.loss_of_contact.roots import bracketed
from wear.numerics.gauss import FloatArray, integral, mesh

NODES = 20  # on each interval
MOST_HALVINGS = 45  # towards each end of a part


def cycle_mean(
    load: Load,
    function: Callable[[FloatArray], FloatArray],
    levels: Iterable[float] = (),
    scale: float = np.inf,
) -> float:
    """Return the mean over a cycle of a function of U_a (mm), which is smooth but at `levels` and
    changes by a factor of order one in `scale`, both in mm.

    >>> from wear.load import Sine
    >>> cycle_mean(Sine(1.0, 1.0), lambda U: np.where(U >= 0.5, 1.0, 0.0), [0.5])  # a third
    0.333333...
    """
    turns = turning_points(load)
    crossings = [_crossings(load, turns, level) for level in levels]
    cuts = np.unique(np.concatenate([turns, *crossings]))
    changes = np.abs(np.diff(load(cuts))) / scale
    halvings = np.clip(np.ceil(np.log2(np.maximum(changes, 1.0))), 0, MOST_HALVINGS).astype(int)
    over = mesh(np.append(np.concatenate([*map(_graded, cuts, cuts[1:], halvings)]), 1.0), NODES)
    return float(integral(function(load(over.phases)), over))


def _crossings(load: Load, turns: FloatArray, level: float) -> FloatArray:
    """Return the phases at which the load crosses a level, between the phases of its turns."""
    above = load(turns) - level
    crosses = above[1:] * above[:-1] < 0.0
    return bracketed(lambda x: load(x) - level, turns[:-1][crosses], turns[1:][crosses])[1]


def _graded(begin: float, end: float, halvings: int) -> FloatArray:
    """Return the edges from `begin` on, without `end`, of intervals that shrink towards both."""
    parts = 0.5 ** np.arange(1, halvings + 2)
    return np.concatenate([[begin], (begin + (end - begin) * parts)[::-1],
                           (end - (end - begin) * parts)[1:]])  # fmt: skip
