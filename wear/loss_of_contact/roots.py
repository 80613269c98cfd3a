"""Roots: where a function changes its sign, and the wear at which contact ends."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np

from wear.model import Model
from wear.numerics.gauss import FloatArray, IntArray

SECTIONS = 64  # of an interval at once
BISECTIONS = 9  # into so many sections, to roundoff
FEW_BISECTIONS = 5  # to roundoff of a cycle
FEWER_BISECTIONS = 3  # for the least value of a function
MOST_NEWTON = 60  # for the wear at the edge, which may be far off
ACCURATE = 1e-8  # relative step of Newton's method: the next would be its square
PATIENCE = 8  # of them; then a change no smaller than the last is rounding
MAY_VANISH = 0.5  # of the least sample: a parabola whose least value is larger does not vanish
Function = Callable[[FloatArray], FloatArray]
Bound = FloatArray | float


def bracketed(
    function: Function, low: FloatArray, high: FloatArray, steps: int = BISECTIONS
) -> tuple[FloatArray, FloatArray]:
    """Return the points (k,), (k,) between which a function of points (n, k) changes its sign, in
    each of many intervals (k,) at whose ends the signs differ."""
    sign, row = np.sign(function(low)), np.arange(len(low))
    inner = np.arange(1, SECTIONS)[:, None] / SECTIONS
    for _ in range(steps if len(low) else 0):
        points = np.concatenate([low[None], low + (high - low) * inner, high[None]])
        other = np.append(np.sign(function(points[1:-1])) != sign, [row >= 0], axis=0)
        at = np.argmax(other, axis=0)
        low, high = points[at, row], points[at + 1, row]
    return low, high


def nearest_to_zero(
    function: Callable[[IntArray], Function], x: FloatArray, value: FloatArray, of: IntArray
) -> tuple[FloatArray, IntArray]:
    """Return the points between samples at which functions come nearest to zero, if they may vanish
    there, and the number of each function. The samples at `x` (n,), with their `value` (n,), are
    those of the functions `of` (n,), one after the other; neighbours have one sign."""
    sign, size = np.sign(value), np.abs(value)
    nearest = (size[1:-1] < size[:-2]) & (size[1:-1] < size[2:]) & (of[:-2] == of[2:])
    nearest &= (sign[1:-1] == sign[:-2]) & (sign[1:-1] == sign[2:])
    at = 1 + np.flatnonzero(nearest)
    before, middle, after = size[at - 1], size[at], size[at + 1]
    least = middle - (after - before) ** 2 / (8 * (after - 2 * middle + before))  # a parabola's
    at = at[least < MAY_VANISH * middle]
    low, high, sign, row = x[at - 1], x[at + 1], sign[at], np.arange(len(at))
    inner, some = np.arange(SECTIONS + 1)[:, None] / SECTIONS, function(of[at])
    for _ in range(FEWER_BISECTIONS if len(at) else 0):
        points = low + (high - low) * inner
        lowest = np.argmin(sign * some(points), axis=0)
        low = points[np.maximum(lowest - 1, 0), row]
        high = points[np.minimum(lowest + 1, SECTIONS), row]
    return (low + high) / 2, of[at]


def displacement_at(model: Model, wear: FloatArray) -> FloatArray:
    """Return the displacement (mm) that just makes contact at each wear; the margin is linear in
    it, with slope 1."""
    return np.asarray(-model.margin(wear, np.zeros_like(wear)))


@np.errstate(divide="ignore")  # at the turning wear: the step is infinite, and clipped
def wear_at(
    model: Model, displacement: FloatArray, guess: FloatArray, least: Bound, most: Bound
) -> FloatArray:
    """Return the wear (mm) at which contact ends under a displacement, by Newton's method; the
    nearer of `least` and `most` if there is none between.

    The margin is convex in the wear, so that from the side of contact no step goes too far.
    """
    wear, last = guess, np.full_like(guess, np.inf)
    for iteration in range(MOST_NEWTON):
        slope = model.margin_slope(wear, displacement)
        corrected = np.clip(wear - model.margin(wear, displacement) / slope, least, most)
        change = np.abs(corrected - wear)
        wear = corrected
        moves = change > ACCURATE * np.abs(wear)
        if not np.any(moves & ((change < last) | (iteration < PATIENCE))):
            break
        last = change
    return wear
