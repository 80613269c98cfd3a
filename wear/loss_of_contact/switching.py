"""The edge of contact of a rigid support with cutoff: where the load begins and ends contact.

The contact ends where h = 3 sigma: the `margin` 3 sigma - h = U_a - B(u) vanishes. There, closed
contact would change the margin at the rate q = U_a' - B'(u) r, a function of the phase alone, since
u = B^-1(U_a). The cycle is cut where the load turns or has a kink, and where q rises through zero.
On a piece, then, contact reaches its edge in one direction only, and the smooth solution that is
continued beyond the edge does not come back: the sign of the margin at the end of a piece, or of
any part of it, tells for certain whether contact has been lost on it.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any, NamedTuple

import numpy as np

from wear.load import Constant, Harmonics, Load, Sine, Table, Waves, waves
from wear.loss_of_contact.roots import (
    FEW_BISECTIONS,
    Function,
    bracketed,
    displacement_at,
    nearest_to_zero,
    wear_at,
)
from wear.model import Model, stacked
from wear.numerics.gauss import BoolArray, FloatArray, IntArray
from wear.numerics.tolerances import ROUNDOFF

SAMPLES = 512  # of a cycle, to look for where q rises through zero
PIECE_SAMPLES = 16  # of the load on a piece, to look up phases
NEARLY = 1e-13  # of a stretch: how near to its ends one looks
LOOKS = np.array([[NEARLY], [0.1], [0.5], [0.9], [1 - NEARLY]])  # at the slope between two peaks
PHASE_NEWTON = 60  # for a phase: a few, but for a load that is far from a parabola at its turns
PHASE_PATIENCE = 3  # of them; then one that is no smaller than the last is rounding
FAR = 1e6  # times the roughness: wear at which the margin is as good as linear
Numbers = Any  # a float, or an array of floats


class Piece(NamedTuple):
    """Parts of cycles (k,) on which the load is smooth and does not turn: `phases` (samples, k)
    from their begin to their end, the load's `heights` (mm) there, and whether load and wear
    together close contact that is at its edge in the middle of the piece."""

    phases: FloatArray
    heights: FloatArray
    closes: BoolArray

    def take(self, which: BoolArray | IntArray) -> Piece:
        """Return some of the pieces, each perhaps several times."""
        return Piece(self.phases[:, which], self.heights[:, which], self.closes[which])

    @property
    def begin(self) -> FloatArray:
        """Their first phases."""
        return np.asarray(self.phases[0])

    @property
    def end(self) -> FloatArray:
        """Their last phases."""
        return np.asarray(self.phases[-1])

    @property
    def rising(self) -> BoolArray:
        """Or level."""
        return np.asarray(self.heights[-1] >= self.heights[0])

    @property
    def top(self) -> FloatArray:
        """The higher ends (mm)."""
        return np.asarray(np.maximum(self.heights[0], self.heights[-1]))


class Edge(NamedTuple):
    """The edge of contact of a model under a load, and the cycle cut into `pieces`.

    The margin falls with wear up to the wear `turning_wear` (mm), and rises beyond; under
    displacements above `highest` (mm) contact has no edge. A compliant support holds the contact at
    its edge until the margin is as large as `held` (mm), zero for a rigid one. Where the
    displacement that just makes contact is one of those `grazing` (mm), the one-cycle map has a
    kink.
    """

    pieces: Piece
    turning_wear: float
    highest: float
    held: float
    grazing: FloatArray
    before: IntArray


class Cycles(NamedTuple):
    """Cycles (k,) of scenes: the model and the load of each, and its edge of contact; for one scene
    numbers, which hold for all of its cycles. `swing` is the largest displacement, either way."""

    model: Model
    load: Load | Waves | Lines
    period: Numbers
    peak: Numbers
    swing: Numbers
    turning_wear: Numbers
    highest: Numbers
    held: Numbers

    def take(self, which: BoolArray | IntArray) -> Cycles:
        """Return some of the cycles, each perhaps several times."""
        if which.dtype == bool and which.all():
            return self
        load, of_one = self.load, isinstance(self.period, float)
        if isinstance(load, Lines) or (isinstance(load, Waves) and not of_one):
            load = load.take(which)
        if of_one:
            return self._replace(load=load)
        return Cycles(self.model.select(which), load, *(array[which] for array in self[2:]))

    def on(self, piece: Piece) -> Cycles:
        """Return the cycles on a piece of each: there a table is a straight line."""
        if not isinstance(self.load, (Table, Constant, Lines)):
            return self
        rise = (piece.heights[-1] - piece.heights[0]) / (piece.end - piece.begin)
        return self._replace(load=Lines(piece.begin, piece.heights[0], rise))

    def is_over(self, start: FloatArray, wear: FloatArray, U_a: FloatArray) -> BoolArray:
        """Return whether contact from the wear `start` has come to wear at which it closes anew, on
        the other side of the turning wear."""
        over: BoolArray = (
            (start < self.turning_wear) & (wear >= self.turning_wear) & (U_a < self.highest)
        )
        return over

    def rate(self, u: FloatArray, U_a: FloatArray) -> FloatArray:
        """Return the wear rate in contact, mm per cycle."""
        rate: FloatArray = self.period * self.model.rate(u, U_a)
        return rate


class Lines(NamedTuple):
    """Displacements in cycles (k,) on pieces on which they are straight: the height (mm) where each
    begins, and the slope."""

    begin: FloatArray
    height: FloatArray
    rise: FloatArray

    def take(self, which: BoolArray | IntArray) -> Lines:
        """Return those of some of the cycles."""
        return Lines(self.begin[which], self.height[which], self.rise[which])

    def __call__(self, phase: FloatArray) -> FloatArray:
        """Return the displacement (mm) at phases (..., k)."""
        return np.asarray(self.height + self.rise * (phase - self.begin))

    def slope(self, phase: FloatArray) -> FloatArray:
        """Return its derivative with respect to the phase, mm."""
        return np.asarray(self.rise + 0.0 * phase)


def cycles_of(models: Sequence[Model], loads: Sequence[Load], edges: Sequence[Edge]) -> Cycles:
    """Return a cycle of each of some scenes of one variant."""
    numbers = [
        (
            load.period,
            load.maximum,
            max(abs(load.minimum), abs(load.maximum)),
            edge.turning_wear,
            edge.highest,
            edge.held,
        )
        for load, edge in zip(loads, edges, strict=True)
    ]
    if len(models) == 1:
        return Cycles(models[0], displacements(loads), *map(float, numbers[0]))
    return Cycles(stacked(models), displacements(loads), *np.array(numbers).T)


def displacements(loads: Sequence[Load]) -> Load | Waves:
    """Return the displacements of loads of one kind; of tables and measured histories, which are
    straight on every piece, those of the first, see `Cycles.on`."""
    first, *others = loads
    of_waves = isinstance(first, Harmonics) or (isinstance(first, Sine) and others)
    return waves(loads) if of_waves else first


def edge_of_contact(model: Model, load: Load) -> Edge:
    """Return the edge of contact of a model with cutoff."""
    turning_wear, held = _crest(model), float(model.held_margin)
    turns, acting = turning_points(load), displacements([load])
    highest = (
        float(displacement_at(model, np.array(turning_wear)))
        if np.isfinite(turning_wear)
        else np.inf
    )
    low, high = turns[:-1], turns[1:]
    top = highest + held
    over = (acting(low) < top) != (acting(high) < top)
    appears = bracketed(lambda phase: acting(phase) - top, low[over], high[over])[1]
    closing_speed = _closing_speed(model, acting, load.period, turning_wear, held)
    closings = _closings(closing_speed, turns, model.compliant)
    cuts = np.unique(np.concatenate([turns, appears, closings]))
    inside = (1 - np.cos(np.pi * np.arange(PIECE_SAMPLES + 1) / PIECE_SAMPLES)) / 2
    phases = cuts[:-1, None] + np.diff(cuts)[:, None] * inside
    closes = closing_speed(phases[:, PIECE_SAMPLES // 2]) >= 0.0
    pieces = Piece(phases.T, acting(phases.T), closes)
    # At the bend wear continues: contact turns not with the load but where its closing speed does.
    sharp = turns[np.isin(turns, [0.0, *load.kinks, 1.0])]
    bending = np.concatenate([sharp, appears, closings])
    heights = np.concatenate([acting(bending) - held, acting(turns)])
    grazing, first = np.unique(heights, return_index=True)
    before = np.searchsorted(cuts, np.concatenate([bending, turns])[first])
    return Edge(pieces, turning_wear, highest, held, grazing, before)


def turning_points(load: Load) -> FloatArray:
    """Return the phases from 0 to 1 between which the load is smooth and rises or falls
    throughout."""
    cuts = np.unique([0.0, *load.kinks, *load.peaks, 1.0])
    # Between two peaks or kinks there is a trough at most; next to flat ones the slope is rounding.
    phases, slope = cuts[:-1] + LOOKS * np.diff(cuts), displacements([load]).slope
    steepness, row = slope(phases), np.arange(len(cuts) - 1)
    falls, rises = np.argmin(steepness, axis=0), np.argmax(steepness, axis=0)
    turns = (steepness[falls, row] < 0.0) & (steepness[rises, row] > 0.0) & (falls < rises)
    low, high = phases[falls, row], phases[rises, row]
    return np.unique(np.concatenate([cuts, bracketed(slope, low[turns], high[turns])[1]]))


def _closing_speed(
    model: Model, load: Load | Waves, period: float, turning_wear: float, held: float
) -> Function:
    """Return the speed at which contact at its edge closes at each phase, in mm per cycle."""

    def closing_speed(phase: FloatArray) -> FloatArray:
        U_a, speed = load(phase), load.slope(phase)
        wear = wear_at(model, U_a - held, np.zeros_like(U_a), 0.0, turning_wear)
        if np.isfinite(turning_wear):
            scale = float(model.fields(np.array(0.0), np.array(0.0)).sigma)
            worn = wear_at(model, U_a - held, np.full_like(U_a, FAR * scale), turning_wear, np.inf)
            wear = np.where(speed < 0.0, worn, wear)
        opening = model.margin_slope(wear, U_a) * period * model.law_rate(wear, U_a)
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
    phases = np.unique(np.concatenate([phases, nearest_to_zero(closing_speed, phases)]))
    value = closing_speed(phases)
    same = np.diff(np.searchsorted(turns, phases)) == 0
    turned = (value[:-1] < 0.0) & (value[1:] >= 0.0)
    if both:
        turned |= (value[:-1] >= 0.0) & (value[1:] < 0.0)
    turned &= same
    return bracketed(closing_speed, phases[:-1][turned], phases[1:][turned], FEW_BISECTIONS)[1]


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
    return float(scale * np.expm1(bracketed(slope, ends[:1], ends[1:])[1][0]))


def phase_of(
    load: Load | Waves | Lines, piece: Piece, height: FloatArray, tolerance: float = ROUNDOFF
) -> FloatArray:
    """Return where the load reaches a height (k,) on each piece; the nearest end if it does not.

    By Newton's method from a secant between samples, next to the ends of a piece from a parabola.
    """
    direction = np.where(piece.rising, 1.0, -1.0)
    rising, wanted = direction * piece.heights, direction * height
    at, row = np.clip(np.sum(rising < wanted, axis=0), 1, PIECE_SAMPLES), np.arange(len(height))
    low, high = piece.phases[at - 1, row], piece.phases[at, row]
    before, after = rising[at - 1, row], rising[at, row]
    share = np.clip((wanted - before) / np.where(after == before, 1.0, after - before), 0.0, 1.0)
    share = np.where(at == 1, np.sqrt(share), share)
    share = np.where(at == PIECE_SAMPLES, 1.0 - np.sqrt(1.0 - share), share)
    phase = low + (high - low) * share
    outside = (wanted <= rising[0]) | (wanted >= rising[-1])
    phase[outside] = np.where(wanted <= rising[0], piece.begin, piece.end)[outside]
    low, high = np.where(outside, phase, low), np.where(outside, phase, high)
    last, done = np.full(len(phase), np.inf), outside
    for iteration in range(PHASE_NEWTON):
        slope = load.slope(phase)
        step = (height - load(phase)) / np.where(slope == 0.0, np.inf, slope)
        corrected = np.clip(phase + step, low, high)
        change, phase = np.abs(corrected - phase), np.where(done, phase, corrected)
        done |= (change <= tolerance) | ((iteration > PHASE_PATIENCE) & (change >= last))
        if done.all():
            break
        last = change
    return np.asarray(phase)


def roughness(model: Model, u: FloatArray) -> FloatArray:
    """Return the equivalent roughness (mm) at each wear; it does not depend on the pressure."""
    none = np.zeros_like(u)
    fields = model.fields_under(none, u, none) if model.compliant else model.fields(u, none)
    return np.asarray(fields.sigma)
