"""The map of regimes: the long-time behaviour of the wear of one solid, with its formulas.

Overview
    Without cutoff the roughness growth f_c decides, and for f_c < 0 the gap at the wear at which
    the roughness would vanish; with the cutoff the threshold of f_c is 1/3 instead of 0.  The
    conditions are relations between data, so that the map can be evaluated for numbers; exactly
    one row holds for each set of data.  The derivations of the rows rest on these conditions; the
    logarithmic and the saturating row on a law that falls exponentially, too, as those of the
    package do.
Key results
    REGIMES    the rows of the map
    regime     the row that holds for given data
"""

from __future__ import annotations

from collections.abc import Mapping
from typing import NamedTuple

import sympy as sp

from ..hypotheses import KEPT, NOT_SMOOTHING, ROUGHENING, SMOOTHING, Hypothesis
from ..symbols import symbol, symbols

f_c, h_0, sigma_c0, U_max = symbols("f_c h_0 sigma_c0 U_max")

OUTGROWN, THIRD, ROUGHER = (
    Hypothesis(relation(f_c, sp.Rational(1, 3))) for relation in (sp.Lt, sp.Eq, sp.Gt)
)
"""The gap grows faster than the cutoff 3 sigma, equally fast, or more slowly."""
_gap = h_0 - sigma_c0 / f_c - U_max
OPEN, CLOSED = Hypothesis(sp.Gt(_gap, 0)), Hypothesis(sp.Le(_gap, 0))
"""Whether there is a gap at the wear at which the roughness would vanish.

At h* = 0 the roughness vanishes in finite time on a rigid support if the peak of the load is
smooth."""
_room = 3 * sigma_c0 - h_0 + U_max
TOUCHING, APART = Hypothesis(sp.Gt(_room, 0)), Hypothesis(sp.Le(_room, 0))
"""Whether the peak of the load makes contact at the start.

Where it just reaches h = 3 sigma, contact depends on how long it lasts there: the map has none."""


class Regime(NamedTuple):
    """A row of the map: its name, its conditions, and the ids of its equations."""

    name: str
    cutoff: bool
    conditions: tuple[Hypothesis, ...]
    equations: tuple[str, ...]


REGIMES = (
    Regime("steady", False, (ROUGHENING,), ("18", "19", "21", "22")),
    Regime("logarithmic", False, (KEPT,), ("logarithmic-wear",)),
    Regime("saturating", False, (SMOOTHING, OPEN), ("saturating-wear",)),
    Regime("finite-time", False, (SMOOTHING, CLOSED), ("closed-gap",)),
    Regime("arrest", True, (APART,), ("contact-condition",)),
    Regime("arrest", True, (TOUCHING, NOT_SMOOTHING, OUTGROWN), ("arrest-depth", "sliding-rate")),
    Regime("arrest", True, (TOUCHING, SMOOTHING, OPEN), ("arrest-depth", "sliding-rate")),
    Regime("finite-time", True, (TOUCHING, SMOOTHING, CLOSED), ("closed-gap",)),
    Regime("steady", True, (TOUCHING, THIRD), ("one-third",)),
    Regime("steady", True, (TOUCHING, ROUGHER), ("permanent-contact", "21", "22")),
)


def regime(values: Mapping[str, float], cutoff: bool) -> Regime:
    """Return the regime of one solid from f_c, h_0, sigma_c0 and U_max, in mm.

    >>> section_4 = {"f_c": 0.25, "h_0": 1.08e-3, "sigma_c0": 3.6e-4, "U_max": 5e-4}
    >>> regime(section_4, cutoff=False).name, regime(section_4, cutoff=True).name
    ('steady', 'arrest')
    """
    data = {symbol(name): value for name, value in values.items()}
    (match,) = (
        row
        for row in REGIMES
        if row.cutoff == cutoff and all(c.relation.subs(data) for c in row.conditions)
    )
    return match
