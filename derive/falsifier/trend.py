"""Trends: the long-time behaviour of a function of time, judged from its values.

Overview
    Values are in windows, each much later than the previous one (by a factor in time, or, if the
    model allows it, by a factor in its logarithm, so that 1/ln t halves from one window to the
    next) and each at several phases of the period.  A claimed limit is judged by the change of
    its distance from the values between the last three windows:

    - *tends*: the largest distance is below 1e-9 of the values, or decreases by at least 15 %;
    - *does not*: it stays (within 3 %) or grows, does not fall ever faster, and is above 1/1000 of
      the values;
    - otherwise there is no verdict.

    Divergence: the smallest value increases from window to window by as much as before.
Key results
    tends_to   True, False, or None: no verdict
    limit      the limit as a ball; UndefinedError if the values keep oscillating
"""

from __future__ import annotations

from collections.abc import Sequence
from itertools import pairwise

from flint import arb

from .balls import UndecidedError, UndefinedError

Window = Sequence[arb]
_RESOLVED = arb(10) ** -9
_GROSS = arb(10) ** -3


def tends_to(windows: Sequence[Window], value: arb, apart: bool = False) -> bool | None:
    """Return whether values tend to ``value``, which may be infinite.

    If windows are ``apart`` by large factors in the logarithm of time, a trend is clear only if the
    distances that remain in the end are: they are extrapolated.
    """
    if not value.is_finite():
        return _diverges(windows, 1 if value > 0 else -1)
    first, before, last = (max(abs(v - value).mid() for v in w) for w in windows[-3:])
    size = max(*(abs(v).mid() for v in windows[-1]), abs(value).mid())
    if any(v.rad() > _GROSS * (abs(v - value) + _RESOLVED * size) for v in windows[-1]):
        return True if all(abs(v - value).upper() <= _GROSS * size for v in windows[-1]) else None
    falls = last < arb("0.85") * before and before < arb("0.95") * first
    stops = apart and _extrapolated(first, before, last) > arb("0.2") * last
    if last <= _RESOLVED * size or (falls and not stops):
        return True
    distances = [abs(v - value).mid() for v in windows[-1]]
    falling = all(later < now for now, later in pairwise(distances))
    hastens = falling and before - last > (arb("0.75") if apart else 1) * (first - before)
    stays = last >= arb("0.97") * before and before >= arb("0.9") * first and not hastens
    return False if stays and last > _GROSS * size else None


def _diverges(windows: Sequence[Window], sign: int) -> bool | None:
    """Return whether values finally exceed (sign 1) or fall below (-1) every bound."""
    first, before, last = (min(sign * v.mid() for v in window) for window in windows[-3:])
    gain, gained = last - before, before - first
    if gain > 0 and gained > 0 and gain >= arb("0.9") * gained:
        return True
    highest = max(sign * v.mid() for v in windows[-3])
    return False if gain <= arb("0.75") * gained or last <= highest else None


def limit(windows: Sequence[Window]) -> arb:
    """Return the limit by Aitken's extrapolation, as a ball with the last correction as radius."""
    middles = [sum(window, arb(0)) / len(window) for window in windows[-3:]]
    spreads = [max(abs(v - m).mid() for v in w) for w, m in zip(windows[-3:], middles, strict=True)]
    *earlier, size = sizes = [max(abs(v).mid() for v in window) for window in windows]
    lasting = size >= arb("0.9") * max(earlier)  # values that decrease may tend to 0
    steady = 2 * min(sizes) >= max(sizes)  # else the sharp peaks of the values are not seen
    turns = {a < b for a, b in pairwise(windows[-1])} == {True, False}
    varies = turns and spreads[-1] > _GROSS * size and spreads[-1] > arb("0.9") * spreads[-2]
    if lasting and varies and steady:
        raise UndefinedError("no limit: the values go on to vary")
    step, before = (abs(b - a).mid() for a, b in ((middles[1], middles[2]), middles[:2]))
    if lasting and step > arb("0.1") * size and step > arb("0.9") * before:
        raise UndefinedError("no finite limit")
    if step > _RESOLVED * size and step > arb("0.95") * before:
        raise UndecidedError("the values do not yet approach a limit")
    found, nearer = ([_extrapolated(*values) for values in zip(*part, strict=True)]
                     for part in (windows[-3:], windows[-4:-1]))  # fmt: skip
    value = sum(found, arb(0)) / len(found)
    last = windows[-1]
    error = max(min(abs(new - v).mid(), abs(new - old).mid()) + new.rad()
                for new, old, v in zip(found, nearer, last, strict=True))  # fmt: skip
    error += max(abs(new - value).mid() for new in found)
    if error > arb("0.03") * size and size > 0:
        raise UndecidedError("the limit is not resolved")
    return arb(value.mid(), error)


def _extrapolated(first: arb, before: arb, last: arb) -> arb:
    """Return the limit of ``a + b r^n`` from three of its values (Aitken)."""
    gained, gain = before - first, last - before
    curvature = gained - gain
    return last if curvature.contains(0) else last + gain**2 / curvature
