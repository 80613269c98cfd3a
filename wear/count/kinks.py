"""The wears at which contact grazes: there the one-cycle map has a kink, and at the last of them
wear ends or fades."""

import numpy as np

from wear.count.cutoff import TOUCH, CutoffCycle, touch
from wear.count.edge import NEARLY, Piece
from wear.count.tail import Rest
from wear.load import Load
from wear.model import Model
from wear.numerics.gauss import (
    FloatArray,
)
from wear.numerics.tolerances import (
    ROUNDOFF,
    TINY,
)


def kinks(cycle: CutoffCycle, shift: float) -> FloatArray:
    """Wear (mm), rising, at which the edge of contact passes an end of a piece; on a compliant
    support also that at which the bend of the rate does.

    Where the margin is hardly more than its own rounding, the map does not feel the kink.
    """
    wear = shift * np.expm1(np.linspace(0.0, 40.0, 400))
    blur = touch(cycle.model, cycle.load, wear)
    found = []
    for height in cycle.edge.grazing:
        margin = cycle.model.margin(wear, np.full_like(wear, height))
        told = np.abs(margin) > blur
        crossed = np.sign(margin[:-1]) * np.sign(margin[1:]) < 0
        for i in np.flatnonzero(crossed & (told[:-1] | told[1:])):
            found.append(_root(cycle, wear[i], wear[i + 1], float(height)))
    return np.array(sorted(kink for kink in found if kink > TOUCH * ROUNDOFF * shift))


def _root(cycle: CutoffCycle, low: float, high: float, height: float) -> float:
    """The wear between `low` and `high` at which the margin vanishes, by bisection."""

    def inside(wear: float) -> bool:
        return bool(cycle.model.margin(np.array(wear), np.array(height)) > 0.0)

    contact = inside(low)
    while low < (middle := (low + high) / 2) < high:
        low, high = (middle, high) if inside(middle) == contact else (low, middle)
    return low if contact else high


def rest_of(model: Model, load: Load, wear: float) -> Rest | None:
    """The wear (mm) at which the peak of the load just fails to make contact, a root of the margin,
    with what rounding makes of it; None if this is not such a wear."""
    peak, worn = np.array(load.maximum), np.array(wear)
    blur = ROUNDOFF * float(model.margin_terms(worn, peak))
    left = abs(float(model.margin(worn, peak)))
    if wear <= 0 or left > TOUCH * blur:
        return None
    return Rest(wear, (left + blur) / (abs(float(model.margin_slope(worn, peak))) + TINY))


def fades(cycle: CutoffCycle, rest: float) -> bool:
    """Whether wear only tends to `rest` (mm), at which the peak of the load just fails to make
    contact: each cycle leaves a part of the distance if the peak is so sharp that contact does not
    slide along its edge, or if the pressure vanishes along with the distance."""
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
