"""The wears at which contact grazes: there the one-cycle map has a kink, and at the last of them
wear ends or fades."""

from typing import NamedTuple

import numpy as np

from wear.count.cutoff import TOUCH, CutoffCycle, touch
from wear.count.edge import BISECTIONS, NEARLY, Piece
from wear.count.tail import Rest
from wear.load import Load
from wear.model import Model
from wear.numerics.tolerances import (
    ROUNDOFF,
    TINY,
)


class Kink(NamedTuple):
    """A `wear` (mm) at which contact grazes, when so many pieces of the cycle lie `before`."""

    wear: float
    before: int


def kinks(cycle: CutoffCycle, shift: float) -> list[Kink]:
    """Wears, rising, at which the edge of contact passes an end of a piece; on a compliant support
    also those at which the bend of the rate does.

    Where the margin is hardly more than its own rounding, the map does not feel the kink.
    """
    wear = shift * np.expm1(np.linspace(0.0, 40.0, 400))
    resolved = touch(cycle.model, cycle.load, wear)
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
    return sorted(map(Kink, found[some].tolist(), cycle.edge.before[which[some]].tolist()))


def rest_of(model: Model, load: Load, wear: float) -> Rest | None:
    """Return the wear (mm) at which the peak of the load just fails to make contact, a root of the
    margin, with what rounding makes of it; None if this is not such a wear."""
    peak, worn = np.array(load.maximum), np.array(wear)
    rounding = ROUNDOFF * float(model.margin_terms(worn, peak))
    left = abs(float(model.margin(worn, peak)))
    if wear <= 0 or left > TOUCH * rounding:
        return None
    return Rest(wear, (left + rounding) / (abs(float(model.margin_slope(worn, peak))) + TINY))


def fades(cycle: CutoffCycle, rest: float) -> bool:
    """Return whether wear only tends to `rest` (mm), at which the peak of the load just fails to
    make contact: each cycle leaves a part of the distance if the peak is so sharp that contact does
    not slide along its edge, or if the pressure vanishes along with the distance."""
    model, load = cycle.model, cycle.load
    if model.compliant:
        return True
    worn, peak = np.array(rest), np.array(load.maximum)
    opens = -float(model.margin_slope(worn, peak) * cycle.rate(worn, peak))
    top = load.maximum - float(touch(model, load, worn))

    def is_sharp(piece: Piece) -> bool:
        near = NEARLY * (piece.end - piece.begin)
        phase = piece.end - near if piece.rising else piece.begin + near
        steep = abs(float(load.slope(phase)))
        kink = (piece.end if piece.rising else piece.begin) % 1.0
        return kink in load.kinks and steep > (opens if piece.rising else 0.0)

    ends = [piece for piece in cycle.edge.pieces if max(piece.heights[[0, -1]]) >= top]
    return all(is_sharp(piece) for piece in ends)
