"""The wears at which contact grazes: there the one-cycle map has a kink, and at the last of them
wear ends or fades."""

from typing import NamedTuple

import numpy as np

from wear.load import Load
from wear.loss_of_contact.arrest import LimitWear
from wear.loss_of_contact.period_map import TOUCH, SwitchedPeriodMap, margin_roundoff
from wear.loss_of_contact.switching import BISECTIONS, NEARLY, Piece
from wear.model import Model
from wear.numerics.tolerances import (
    ROUNDOFF,
    TINY,
)


class GrazingWear(NamedTuple):
    """A `wear` (mm) at which contact grazes, when so many pieces of the cycle lie `before`."""

    wear: float
    before: int


def grazing_wears(cycle: SwitchedPeriodMap, shift: float) -> list[GrazingWear]:
    """Wears, rising, at which the edge of contact passes an end of a piece; on a compliant support
    also those at which the bend of the rate does.

    Where the margin is hardly more than its own rounding, the map does not feel the kink.
    """
    wear = shift * np.expm1(np.linspace(0.0, 40.0, 400))
    resolved = margin_roundoff(cycle.model, cycle.load, wear)
    heights = cycle.edge.grazing[:, None]
    margin = cycle.model.margin(wear, heights)
    known = np.abs(margin) > resolved
    crossed = np.sign(margin[:, :-1]) * np.sign(margin[:, 1:]) < 0
    which, at = np.nonzero(crossed & (known[:, :-1] | known[:, 1:]))
    low, high = wear[at], wear[at + 1]
    contact = margin[which, at] > 0.0
    for _ in range(BISECTIONS):
        middle = (low + high) / 2
        before = (cycle.model.margin(middle, heights[which, 0]) > 0.0) == contact
        low, high = np.where(before, middle, low), np.where(before, high, middle)
    found = np.where(contact, low, high)
    some = found > TOUCH * ROUNDOFF * shift
    return sorted(map(GrazingWear, found[some].tolist(), cycle.edge.before[which[some]].tolist()))


def limit_wear_of(model: Model, load: Load, wear: float) -> LimitWear | None:
    """Return the wear (mm) at which the peak of the load just fails to make contact, a root of the
    margin, with what rounding makes of it; None if this is not such a wear."""
    peak, worn = np.array(load.maximum), np.array(wear)
    rounding = ROUNDOFF * float(model.margin_terms(worn, peak))
    left = abs(float(model.margin(worn, peak)))
    if wear <= 0 or left > TOUCH * rounding:
        return None
    return LimitWear(wear, (left + rounding) / (abs(float(model.margin_slope(worn, peak))) + TINY))


def fades(cycle: SwitchedPeriodMap, limit_wear: float) -> bool:
    """Return whether wear only tends to `limit_wear` (mm), at which the peak of the load just fails
    to make contact: each cycle leaves a part of the distance if the peak is so sharp that contact
    does not slide along its edge, or if the pressure vanishes along with the distance."""
    model, load = cycle.model, cycle.load
    if model.compliant:
        return True
    worn, peak = np.array(limit_wear), np.array(load.maximum)
    opens = -float(model.margin_slope(worn, peak) * cycle.rate(worn, peak))
    top = load.maximum - float(margin_roundoff(model, load, worn))

    def is_sharp(piece: Piece) -> bool:
        near = NEARLY * (piece.end - piece.begin)
        phase = piece.end - near if piece.rising else piece.begin + near
        steep = abs(float(load.slope(phase)))
        kink = (piece.end if piece.rising else piece.begin) % 1.0
        return kink in load.kinks and steep > (opens if piece.rising else 0.0)

    ends = [piece for piece in cycle.edge.pieces if max(piece.heights[[0, -1]]) >= top]
    return all(is_sharp(piece) for piece in ends)
