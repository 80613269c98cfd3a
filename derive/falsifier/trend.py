"""Trends: what a function of time does in the long run, judged from its values.

Overview
    Values come in windows, each much later than the one before (a factor in time, or, where the
    model allows it, a factor in its logarithm, so that 1/ln t halves from one window to the
    next) and each at several phases of the period.  A claim on a limit is judged by how its
    distance from the values changes between the last three windows:

    - *tends*: the largest distance is below 1e-9 of the values, or falls by at least 15 %;
    - *does not*: it stays (within 3 %) or grows, and is above 1/1000 of the values;
    - else there is no verdict.

    Divergence: the smallest value of a window gains as much as in the window before.
Key results
    tends_to, diverges   True, False, or None: no verdict
    limit                the limit as a ball; Undefined where values go on to oscillate
"""

from __future__ import annotations

from collections.abc import Sequence

from flint import arb

from .balls import Undecided, Undefined

Window = Sequence[arb]
_RESOLVED = arb(10) ** -9
_GROSS = arb(10) ** -3


def tends_to(windows: Sequence[Window], value: arb) -> bool | None:
    """Return whether values tend to ``value``."""
    first, before, last = (max(abs(v - value).mid() for v in w) for w in windows[-3:])
    size = max(*(abs(v).mid() for v in windows[-1]), abs(value).mid())
    if any(v.rad() > _GROSS * (abs(v - value) + _RESOLVED * size) for v in windows[-1]):
        return True if all(abs(v - value).upper() <= _GROSS * size for v in windows[-1]) else None
    if last <= _RESOLVED * size or (last < arb("0.85") * before and before < arb("0.95") * first):
        return True
    if last >= arb("0.97") * before and before >= arb("0.9") * first and last > _GROSS * size:
        return False
    return None


def diverges(windows: Sequence[Window], sign: int) -> bool | None:
    """Return whether values exceed (sign 1) or fall below (-1) every bound in the end."""
    first, before, last = (min(sign * v.mid() for v in window) for window in windows[-3:])
    gain, gained = last - before, before - first
    if gain > 0 and gained > 0 and gain >= arb("0.9") * gained:
        return True
    highest = max(sign * v.mid() for v in windows[-3])
    return False if gain <= arb("0.75") * gained or last <= highest else None


def limit(windows: Sequence[Window]) -> arb:
    """Return the limit by Aitken's extrapolation, a ball as wide as the last correction."""
    middles = [sum(window, arb(0)) / len(window) for window in windows[-3:]]
    spreads = [max(abs(v - m).mid() for v in w) for w, m in zip(windows[-3:], middles, strict=True)]
    size = max(abs(v).mid() for v in windows[-1])
    if spreads[-1] > _GROSS * size and spreads[-1] > arb("0.9") * spreads[-2]:
        raise Undefined("no limit: the values go on to vary")
    step, before = (abs(b - a).mid() for a, b in ((middles[1], middles[2]), middles[:2]))
    if step > _GROSS * size and step > arb("0.9") * before:
        raise Undefined("no finite limit")
    if step > _RESOLVED * size and step > arb("0.95") * before:
        raise Undecided("the values do not yet approach a limit")
    found, nearer = ([_extrapolated(*values) for values in zip(*part, strict=True)]
                     for part in (windows[-3:], windows[-4:-1]))  # fmt: skip
    value = sum(found, arb(0)) / len(found)
    last = windows[-1]
    error = max(min(abs(new - v).mid(), abs(new - old).mid()) + new.rad()
                for new, old, v in zip(found, nearer, last, strict=True))  # fmt: skip
    error += max(abs(new - value).mid() for new in found)
    if error > arb("0.03") * size and size > 0:
        raise Undecided("the limit is not resolved")
    return arb(value.mid(), error)


def _extrapolated(first: arb, before: arb, last: arb) -> arb:
    """Return the limit of ``a + b r^n`` from three of its values (Aitken)."""
    gained, gain = before - first, last - before
    bend = gained - gain
    return last if bend.contains(0) else last + gain**2 / bend
