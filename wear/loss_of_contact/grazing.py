"""Grazing wears, at which the period map has a kink; at the last of them wear stops or tends to its
limit."""

from typing import NamedTuple

import numpy as np

from wear.load import Load
from wear.loss_of_contact.arrest import LimitWear
from wear.loss_of_contact.period_map import TOUCH, margin_roundoff
from wear.loss_of_contact.roots import bracketed
from wear.loss_of_contact.switching import NEARLY, Edge
from wear.model import Model
from wear.numerics.floating_point import ROUNDOFF, TINY

WEARS = np.expm1(np.linspace(0.0, 40.0, 400))  # samples, over the scale of the wear
GRAIN, BLURRED = 4096.0, 256.0  # roundoffs of the wear, times the uncertainty of a grazing wear:
# the smallest distance from it at which cycles are counted
TINY_WEARS = 16  # samples of them: roots are found to roundoff of the larger sample


class GrazingWear(NamedTuple):
    """A `wear` (mm) at which contact grazes, the number of pieces of the cycle `before` it does so,
    and the rounding error of the wear, `uncertainty` (mm)."""

    wear: float
    before: int
    uncertainty: float

    @property
    def nearest(self) -> float:
        """Return the smallest distance (mm) from it at which cycles are counted."""
        return max(GRAIN * ROUNDOFF * self.wear, BLURRED * self.uncertainty)


def grazing_wears(model: Model, load: Load, edge: Edge, shift: float) -> list[GrazingWear]:
    """Return the wears, rising, at which the edge of contact passes an end of a piece; on a
    compliant support also those at which the bend of the rate does.

    A kink where the margin is hardly more than its rounding error is left out: the map does not
    resolve it.
    """
    wear = shift * np.insert(WEARS, 1, np.geomspace(ROUNDOFF, 0.1 * WEARS[1], TINY_WEARS))
    resolved = margin_roundoff(model, load.maximum, wear)
    heights = edge.grazing[:, None]
    margin = model.margin(wear, heights)
    known = np.abs(margin) > resolved
    crossed = np.sign(margin[:, :-1]) * np.sign(margin[:, 1:]) < 0
    which, at = np.nonzero(crossed & (known[:, :-1] | known[:, 1:]))
    contact, height = margin[which, at] > 0.0, heights[which, 0]
    low, high = bracketed(
        lambda middle: np.where(model.margin(middle, height) > 0.0, 1.0, -1.0),
        wear[at],
        wear[at + 1],
    )
    roots = np.where(contact, low, high)
    positive = roots > TOUCH * ROUNDOFF * shift
    roots, peak = roots[positive], load.maximum
    terms = model.margin_terms(roots, peak + 0.0 * roots)
    rounding = ROUNDOFF * terms / (np.abs(model.margin_slope(roots, peak)) + TINY)
    before = edge.before[which[positive]]
    return sorted(map(GrazingWear, roots.tolist(), before.tolist(), rounding.tolist()))


def limit_wear_of(model: Model, load: Load, wear: float) -> LimitWear | None:
    """Return the limit wear next to a `wear` (mm), with its rounding error: there the peak of the
    load just fails to make contact. None if there is no such wear."""
    peak, worn = np.array(load.maximum), np.array(wear)
    rounding = ROUNDOFF * float(model.margin_terms(worn, peak))
    margin = abs(float(model.margin(worn, peak)))
    if wear <= 0 or margin > TOUCH * rounding:
        return None
    slope = abs(float(model.margin_slope(worn, peak)))
    return LimitWear(wear, (margin + rounding) / (slope + TINY))


def fades(model: Model, load: Load, edge: Edge, limit_wear: float) -> bool:
    """Return whether wear tends to the `limit_wear` (mm) without reaching it: each cycle leaves a
    part of the distance if the peak of the load is so sharp that contact does not slide along its
    edge, or if the pressure vanishes along with the distance."""
    if model.compliant:
        return True
    worn, peak = np.array(limit_wear), np.array(load.maximum)
    opens = -float(model.margin_slope(worn, peak) * load.period * model.rate(worn, peak))
    top = load.maximum - float(margin_roundoff(model, load.maximum, worn))
    pieces = edge.pieces.take(edge.pieces.top >= top)
    near, rising = NEARLY * (pieces.end - pieces.begin), pieces.rising
    steep = np.abs(load.slope(np.where(rising, pieces.end - near, pieces.begin + near)))
    kinked = np.isin(np.where(rising, pieces.end, pieces.begin) % 1.0, load.kinks)
    return bool(np.all(kinked & (steep > np.where(rising, opens, 0.0))))
