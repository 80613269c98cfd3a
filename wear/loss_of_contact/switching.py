"""Cycles with loss of contact, cut into pieces on which contact reaches its edge in one direction.

Contact ends where h = 3 sigma: the `margin` 3 sigma - h = U_a - B(u) vanishes. On a piece contact
reaches its edge in one direction only, and the smooth solution that is continued beyond the edge
does not come back: the sign of the margin at the end of a piece, or of any part of it, shows
whether contact has been lost on it. `wear.loss_of_contact.edge` finds the pieces.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any, NamedTuple

import numpy as np

from wear.load import Constant, Harmonics, HistoryPart, Load, Sine, Table, Waves, waves
from wear.model import Fields, Model, stacked
from wear.numerics.floating_point import ROUNDOFF
from wear.numerics.gauss import BoolArray, FloatArray, IntArray
from wear.numerics.rows import take

PIECE_SAMPLES = 16  # of the load on a piece, to look up phases
NEARLY = 1e-13  # of a part of the cycle: the distance of a sample from its ends
PHASE_NEWTON = 60  # Newton steps to a phase; a few, unless the load turns unlike a parabola
PHASE_PATIENCE = 3  # of them; then a step no smaller than the last is rounding
STRAIGHT = Table, Constant, HistoryPart  # loads that are straight between their kinks
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
        """Return the first phases."""
        return np.asarray(self.phases[0])

    @property
    def end(self) -> FloatArray:
        """Return the last phases."""
        return np.asarray(self.phases[-1])

    @property
    def rising(self) -> BoolArray:
        """Return whether the load rises or is level."""
        return np.asarray(self.heights[-1] >= self.heights[0])

    @property
    def top(self) -> FloatArray:
        """Return the higher of the loads (mm) at both ends."""
        return np.asarray(np.maximum(self.heights[0], self.heights[-1]))


class ModelLevels(NamedTuple):
    """Levels of a model: the margin falls with wear up to the wear `turning_wear` (mm), and rises
    beyond; under displacements above `highest` (mm) contact has no edge. A compliant support holds
    the contact at its edge until the margin is as large as `held` (mm), zero for a rigid one."""

    turning_wear: float
    highest: float
    held: float


class Edge(NamedTuple):
    """The edge of contact of a model under a load: the cycle cut into `pieces`, and the `levels` of
    the model. The period map has a kink where the displacement that just makes contact is one of
    `grazing` (k,), mm, to which the load comes after `before` (k,) pieces."""

    pieces: Piece
    levels: ModelLevels
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
        if isinstance(load, Lines):
            load = take(load, which)
        elif isinstance(load, Waves) and not of_one:
            load = load.take(which)
        if of_one:
            return self._replace(load=load)
        return Cycles(self.model.select(which), load, *(array[which] for array in self[2:]))

    def on(self, piece: Piece) -> Cycles:
        """Return the cycles on a piece of each: there a table is a straight line."""
        if not isinstance(self.load, (*STRAIGHT, Lines)):
            return self
        rise = (piece.heights[-1] - piece.heights[0]) / (piece.end - piece.begin)
        return self._replace(load=Lines(piece.begin, piece.heights[0], rise))

    def is_over(self, start: FloatArray, wear: FloatArray, U_a: FloatArray) -> BoolArray:
        """Return whether contact from the wear `start` has reached a wear at which it closes anew,
        on the other side of the turning wear."""
        passed = (start < self.turning_wear) & (wear >= self.turning_wear)
        return np.asarray(passed & (U_a < self.highest))

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

    def __call__(self, phase: FloatArray) -> FloatArray:
        """Return the displacement (mm) at phases (..., k)."""
        return np.asarray(self.height + self.rise * (phase - self.begin))

    def slope(self, phase: FloatArray) -> FloatArray:
        """Return its derivative with respect to the phase, mm."""
        return np.asarray(self.rise + 0.0 * phase)


def cycles_of(
    models: Sequence[Model], loads: Sequence[Load], levels: Sequence[ModelLevels]
) -> Cycles:
    """Return a cycle of each of some scenes of one variant."""
    numbers = [
        (load.period, load.maximum, max(abs(load.minimum), abs(load.maximum)), *level)
        for load, level in zip(loads, levels, strict=True)
    ]
    if len(models) == 1:
        return Cycles(models[0], displacements(loads), *map(float, numbers[0]))
    return Cycles(stacked(models), displacements(loads), *np.array(numbers).T)


def displacements(loads: Sequence[Load]) -> Load | Waves:
    """Return the displacements of loads of one kind; for tables and measured histories, which are
    straight on every piece (`Cycles.on`), those of the first."""
    first, *others = loads
    of_waves = isinstance(first, Harmonics) or (isinstance(first, Sine) and others)
    return waves(loads) if of_waves else first


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
        corrected = np.minimum(np.maximum(phase + step, low), high)
        change, phase = np.abs(corrected - phase), np.where(done, phase, corrected)
        done |= (change <= tolerance) | ((iteration > PHASE_PATIENCE) & (change >= last))
        if done.all():
            break
        last = change
    return np.asarray(phase)


def undeflected(model: Model, u: FloatArray, U_a: FloatArray) -> Fields:
    """Return the fields at each wear and displacement, on springs those of the unloaded system."""
    return model.fields_under(0.0 * u, u, U_a) if model.compliant else model.fields(u, U_a)


def roughness(model: Model, u: FloatArray) -> FloatArray:
    """Return the equivalent roughness (mm) at each wear; it does not depend on the pressure."""
    return np.asarray(undeflected(model, u, np.zeros_like(u)).sigma)
