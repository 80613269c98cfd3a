"""The edge of contact of a rigid support with cutoff: where the load begins and ends contact.

The contact ends where h = 3 sigma: the `margin` 3 sigma - h = U_a - B(u) vanishes. There, closed
contact would change the margin at the rate q = U_a' - B'(u) r, a function of the phase alone, since
u = B^-1(U_a). The cycle is cut where the load turns or has a kink, and where q rises through zero.
On a piece, then, contact reaches its edge in one direction only, and the smooth solution that is
continued beyond the edge does not come back: the sign of the margin at the end of a piece, or of
any part of it, tells for certain whether contact has been lost on it.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import NamedTuple

import numpy as np

from wear.load import Load
from wear.model import Model
from wear.numerics.gauss import BoolArray, FloatArray, IntArray
from wear.numerics.tolerances import (
    ROUNDOFF,
)

SAMPLES = 2048  # of a cycle, to look for where q rises through zero
PIECE_SAMPLES = 16  # of the load on a piece, to look up phases
NEARLY = 1e-13  # of a stretch: how near to its ends one looks
BISECTIONS = 60  # to roundoff
FEW_BISECTIONS = 30  # where a small error has no effect of first order
MOST_NEWTON = 60  # for the wear at the edge, which may be far off
PHASE_NEWTON = 60  # from a secant of the samples of a piece: near a peak each halves the distance
PHASE_PATIENCE = 6  # of them; then one that is no smaller than the last is rounding
FAR = 1e6  # times the roughness: wear at which the margin is as good as linear
Function = Callable[[FloatArray], FloatArray]


class Piece(NamedTuple):
    """A part of the cycle on which the load is smooth and does not turn: `phases` from its begin to
    its end, the load's `heights` (mm) there, and whether load and wear together close contact that
    is at its edge in the middle of the piece."""

    phases: FloatArray
    heights: FloatArray
    closes: bool

    @property
    def begin(self) -> float:
        """Its first phase."""
        return float(self.phases[0])

    @property
    def end(self) -> float:
        """Its last phase."""
        return float(self.phases[-1])

    @property
    def rising(self) -> bool:
        """Or level."""
        return bool(self.heights[-1] >= self.heights[0])


class Edge(NamedTuple):
    """The edge of contact of a model under a load, and the cycle cut into `pieces`.

    The margin falls with wear up to the wear `turning_wear` (mm), and rises beyond; under
    displacements above `highest` (mm) contact has no edge. A compliant support holds the contact at
    its edge until the margin is as large as `held` (mm), zero for a rigid one. Where the
    displacement that just makes contact is one of those `grazing` (mm), the one-cycle map has a
    kink.
    """

    pieces: tuple[Piece, ...]
    turning_wear: float
    highest: float
    held: float
    grazing: FloatArray
    before: IntArray

    def is_over(self, start: FloatArray, wear: FloatArray, U_a: FloatArray) -> BoolArray:
        """Return whether contact from the wear `start` has come to wear at which it closes anew, on
        the other side of the turning_wear."""
        over: BoolArray = (
            (start < self.turning_wear) & (wear >= self.turning_wear) & (U_a < self.highest)
        )
        return over


def edge_of_contact(model: Model, load: Load) -> Edge:
    """Return the edge of contact of a model with cutoff."""
    turning_wear, held = _crest(model), float(model.held_margin)
    turns = turning_points(load)
    highest = (
        float(displacement_at(model, np.array(turning_wear)))
        if np.isfinite(turning_wear)
        else np.inf
    )
    low, high = turns[:-1], turns[1:]
    top = highest + held
    over = (load(low) < top) != (load(high) < top)
    appears = _bisected(lambda phase: load(phase) - top, low[over], high[over])
    closing_speed = _pull(model, load, turning_wear, held)
    closings = _closings(closing_speed, turns, model.compliant)
    cuts = np.unique(np.concatenate([turns, appears, closings]))
    inside = (1 - np.cos(np.pi * np.arange(PIECE_SAMPLES + 1) / PIECE_SAMPLES)) / 2
    phases = cuts[:-1, None] + np.diff(cuts)[:, None] * inside
    closes = closing_speed(phases[:, PIECE_SAMPLES // 2]) >= 0.0
    pieces = tuple(map(Piece, phases, load(phases), closes.tolist()))
    # Wear goes on at the bend: there contact turns not with the load but where its closing_speed
    # does.
    sharp = turns[np.isin(turns, [0.0, *load.kinks, 1.0])]
    bending = np.concatenate([sharp, appears, closings])
    heights = np.concatenate([load(bending) - held, load(turns)])
    grazing, first = np.unique(heights, return_index=True)
    before = np.searchsorted(cuts, np.concatenate([bending, turns])[first])
    return Edge(pieces, turning_wear, highest, held, grazing, before)


def turning_points(load: Load) -> FloatArray:
    """Return the phases from 0 to 1 between which the load is smooth and rises or falls
    throughout."""
    cuts = np.unique([0.0, *load.kinks, *load.peaks, 1.0])
    # Between two peaks or kinks there is a trough at most.
    low, high = cuts[:-1] + NEARLY * np.diff(cuts), cuts[1:] - NEARLY * np.diff(cuts)
    turns = (load.slope(low) < 0.0) & (load.slope(high) > 0.0)
    return np.unique(np.concatenate([cuts, _bisected(load.slope, low[turns], high[turns])]))


def _pull(model: Model, load: Load, turning_wear: float, held: float) -> Function:
    """Return how fast contact at its edge closes at each phase, in mm per cycle."""

    def closing_speed(phase: FloatArray) -> FloatArray:
        U_a, speed = load(phase), load.slope(phase)
        wear = wear_at(model, U_a - held, np.zeros_like(U_a), 0.0, turning_wear)
        if np.isfinite(turning_wear):
            scale = float(model.fields(np.array(0.0), np.array(0.0)).sigma)
            worn = wear_at(model, U_a - held, np.full_like(U_a, FAR * scale), turning_wear, np.inf)
            wear = np.where(speed < 0.0, worn, wear)
        opening = model.margin_slope(wear, U_a) * load.period * model.law_rate(wear, U_a)
        result: FloatArray = speed + opening
        return result

    return closing_speed


def _closings(closing_speed: Function, turns: FloatArray, both: bool) -> FloatArray:
    """Return the phases at which the load starts to close contact at its edge, between two turns;
    if `both`, also those at which it ceases to."""
    number = max(2, SAMPLES // len(turns))
    inside = (1 - np.cos(np.pi * np.arange(number + 1) / number)) / 2
    inside[0], inside[-1] = NEARLY, 1 - NEARLY
    phases = (turns[:-1, None] + np.diff(turns)[:, None] * inside).ravel()
    phases = np.unique(np.concatenate([phases, _extremes(closing_speed, phases)]))
    value = closing_speed(phases)
    same = np.diff(np.searchsorted(turns, phases)) == 0
    turned = (value[:-1] < 0.0) & (value[1:] >= 0.0)
    if both:
        turned |= (value[:-1] >= 0.0) & (value[1:] < 0.0)
    turned &= same
    return _bisected(closing_speed, phases[:-1][turned], phases[1:][turned], FEW_BISECTIONS)


def _extremes(function: Function, x: FloatArray) -> FloatArray:
    """Return where a function comes nearest to zero between samples at `x` of one sign."""
    value = function(x)
    sign, size = np.sign(value[1:-1]), np.abs(value)
    nearest = (size[1:-1] < size[:-2]) & (size[1:-1] < size[2:])
    at = 1 + np.flatnonzero(nearest & (sign == np.sign(value[:-2])) & (sign == np.sign(value[2:])))
    low, high, sign = x[at - 1], x[at + 1], np.sign(value[at])
    for _ in range(FEW_BISECTIONS if len(at) else 0):
        third = (high - low) / 3
        falls = sign * function(low + third) > sign * function(high - third)
        low, high = np.where(falls, low + third, low), np.where(falls, high, high - third)
    return (low + high) / 2


def _bisected(
    function: Function, low: FloatArray, high: FloatArray, steps: int = BISECTIONS
) -> FloatArray:
    """Return where a function changes its sign, in each of many intervals at whose ends it
    differs."""
    sign = np.sign(function(low))
    for _ in range(steps):
        middle = (low + high) / 2
        before = np.sign(function(middle)) == sign
        low, high = np.where(before, middle, low), np.where(before, high, middle)
    return high


def displacement_at(model: Model, wear: FloatArray) -> FloatArray:
    """Return the displacement (mm) that just makes contact at each wear: the margin rises with it
    by as much."""
    edge: FloatArray = -model.margin(wear, np.zeros_like(wear))
    return edge


def _crest(model: Model) -> float:
    """Return the wear (mm) at which the displacement that just makes contact is largest: zero if it
    falls from the start, infinite if it always rises."""
    scale = float(model.fields(np.array(0.0), np.array(0.0)).sigma)

    def slope(y: FloatArray) -> FloatArray:
        wear = scale * np.expm1(y)
        result: FloatArray = model.margin_slope(wear, np.zeros_like(wear))
        return result

    ends = np.array([0.0, np.log(FAR)])
    first, last = slope(ends)
    if first >= 0.0:
        return 0.0
    if last <= 0.0:
        return np.inf
    return float(scale * np.expm1(_bisected(slope, ends[:1], ends[1:])[0]))


def wear_at(
    model: Model, displacement: FloatArray, guess: FloatArray, least: float, most: float
) -> FloatArray:
    """Return the wear (mm) at which contact ends under a displacement, by Newton's method; the
    nearest of `least` and `most` if there is none between.

    The margin is convex in the wear, so that from the side of contact no step goes too far.
    """
    wear = guess
    for _ in range(MOST_NEWTON):
        slope = model.margin_slope(wear, displacement)
        fresh = np.clip(wear - model.margin(wear, displacement) / slope, least, most)
        change = np.abs(fresh - wear)
        wear = fresh
        if not np.any(change > 2 * ROUNDOFF * np.abs(wear)):
            break
    return wear


def phase_of(load: Load, piece: Piece, height: FloatArray) -> FloatArray:
    """Return where the load reaches each height (k,) on a piece; the nearest end if it does not."""
    direction = 1.0 if piece.rising else -1.0
    rising = direction * piece.heights
    phase = np.where(direction * height <= rising[0], piece.begin, piece.end)
    inside = (direction * height > rising[0]) & (direction * height < rising[-1])
    if inside.any():
        at = np.searchsorted(rising, direction * height[inside])
        low, high = piece.phases[at - 1], piece.phases[at]
        rise = piece.heights[at] - piece.heights[at - 1]
        share = (height[inside] - piece.heights[at - 1]) / rise
        phase[inside] = _sought(load, height[inside], low, high, low + (high - low) * share)
    return phase


def _sought(
    load: Load, height: FloatArray, low: FloatArray, high: FloatArray, phase: FloatArray
) -> FloatArray:
    """Return where the load reaches each height (k,) between the phases `low` and `high`, by
    Newton's method from a `phase` between."""
    last = np.inf
    for iteration in range(PHASE_NEWTON):
        slope = load.slope(phase)
        step = (height - load(phase)) / np.where(slope == 0.0, np.inf, slope)
        fresh = np.clip(phase + step, low, high)
        change, phase = np.max(np.abs(fresh - phase)), fresh
        if change <= ROUNDOFF or (iteration > PHASE_PATIENCE and change >= last):
            break
        last = change
    return phase
