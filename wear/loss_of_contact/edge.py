"""The edge of contact: where the load begins and ends contact, of many scenes at once.

At the edge, where the margin U_a - B(u) vanishes, closed contact would change the margin at the
rate q = U_a' - B'(u) r, a function of the phase alone, since u = B^-1(U_a). The cycle is cut where
the load turns or has a kink, and where q rises through zero; on a compliant support also where it
falls.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import NamedTuple

import numpy as np

from wear.load import Load
from wear.loss_of_contact.roots import (
    FEW_BISECTIONS,
    bracketed,
    displacement_at,
    nearest_to_zero,
    wear_at,
)
from wear.loss_of_contact.switching import (
    NEARLY,
    PIECE_SAMPLES,
    Cycles,
    Edge,
    ModelLevels,
    Piece,
    cycles_of,
    displacements,
    roughness,
)
from wear.model import Model, stacked
from wear.numerics.gauss import BoolArray, FloatArray, IntArray

SAMPLES = 512  # of a cycle, between which q may rise through zero
LOOKS = np.array([[NEARLY], [0.1], [0.5], [0.9], [1 - NEARLY]])  # at the slope between two peaks
FAR = 1e6  # times the roughness: wear from which on the margin is practically linear
_FIRST, _LAST = slice(None, -1), slice(1, None)


class _Legs(NamedTuple):
    """Parts of cycles (k,) between two turning points of the load, from the phases `low` to `high`,
    with the number of the `scene` of each."""

    cycles: Cycles
    scene: IntArray
    low: FloatArray
    high: FloatArray

    def take(self, which: BoolArray | IntArray) -> _Legs:
        """Return some of the legs, each perhaps several times."""
        cycles = self.cycles.take(which)
        return _Legs(cycles, self.scene[which], self.low[which], self.high[which])

    def above_the_edge(self, phase: FloatArray) -> FloatArray:
        """Return the distance (mm) of the load at phases (..., k) to the displacement above which
        contact has no edge."""
        highest = self.cycles.highest + self.cycles.held
        return np.asarray(self.cycles.load(phase) - highest)

    def closing_speed(self, phase: FloatArray) -> FloatArray:
        """Return the speed at which contact at its edge closes at phases (..., k), in mm per
        cycle."""
        model, turning_wear = self.cycles.model, self.cycles.turning_wear
        U_a, speed = self.cycles.load(phase), self.cycles.load.slope(phase)
        wear = wear_at(model, U_a - self.cycles.held, np.zeros_like(U_a), 0.0, turning_wear)
        turns = np.isfinite(turning_wear)
        if np.any(turns):
            least = np.where(turns, turning_wear, 0.0)
            far = FAR * roughness(model, np.zeros_like(self.low)) + np.zeros_like(U_a)
            worn = wear_at(model, U_a - self.cycles.held, far, least, np.inf)
            wear = np.where((speed < 0.0) & turns, worn, wear)
        opening = model.margin_slope(wear, U_a) * self.cycles.period * model.law_rate(wear, U_a)
        return np.asarray(speed + opening)


def edge_of_contact(model: Model, load: Load) -> Edge:
    """Return the edge of contact of a model with loss of contact."""
    return edges_of_contact([model], [load])[0]


def edges_of_contact(models: Sequence[Model], loads: Sequence[Load]) -> list[Edge]:
    """Return the edges of contact of scenes of one variant, whose loads are all straight between
    corners, or all waves."""
    levels, turns = _levels(models), [turning_points(load) for load in loads]
    number = np.array([len(phases) - 1 for phases in turns])
    legs = _legs(cycles_of(models, loads, levels), loads, turns)
    distance = [legs.above_the_edge(end) < 0.0 for end in (legs.low, legs.high)]
    some = legs.take(np.flatnonzero(distance[0] != distance[1]))
    appears = bracketed(some.above_the_edge, some.low, some.high)[1]
    closings, scene = _closings(legs, models[0].compliant)
    inner, scene = np.append(appears, closings), np.append(some.scene, scene)
    bends = [inner[scene == i] for i in range(len(models))]
    cuts = [np.unique(np.append(*phases)) for phases in zip(turns, bends, strict=True)]
    middles = [(phases[1:] + phases[:-1]) / 2 for phases in cuts]
    of = [  # the middle of two neighbouring numbers may be the last turning point
        np.minimum(np.searchsorted(at, middle, side="right"), len(at) - 1) - 1
        for at, middle in zip(turns, middles, strict=True)
    ]
    leg = np.concatenate(of) + np.repeat(np.cumsum(number) - number, [len(each) for each in of])
    closes = legs.take(leg).closing_speed(np.concatenate(middles)) >= 0.0
    each = np.split(closes, np.cumsum([len(phases) for phases in middles])[:-1])
    return [_edge(*scene) for scene in zip(loads, levels, turns, bends, cuts, each, strict=True)]


def _edge(
    load: Load,
    levels: ModelLevels,
    turns: FloatArray,
    bends: FloatArray,
    cuts: FloatArray,
    closes: BoolArray,
) -> Edge:
    """Return the edge of contact of one scene, whose cycle is cut at `cuts` (k + 1,)."""
    inside = (1 - np.cos(np.pi * np.arange(PIECE_SAMPLES + 1) / PIECE_SAMPLES)) / 2
    phases, acting = cuts[:-1] + np.diff(cuts) * inside[:, None], displacements([load])
    # At the bend wear continues: contact turns not with the load but where its closing speed does.
    bending = np.append(turns[np.isin(turns, [0.0, *load.kinks, 1.0])], bends)
    heights = np.append(acting(bending) - levels.held, acting(turns))
    grazing, first = np.unique(heights, return_index=True)
    before = np.searchsorted(cuts, np.append(bending, turns)[first])
    return Edge(Piece(phases, acting(phases), closes), levels, grazing, before)


def _legs(cycles: Cycles, loads: Sequence[Load], turns: Sequence[FloatArray]) -> _Legs:
    """Return the legs of the cycles of some scenes, between the phases `turns` of each."""
    scene = np.repeat(np.arange(len(turns)), [len(phases) - 1 for phases in turns])
    heights = [displacements([load])(at) for load, at in zip(loads, turns, strict=True)]
    ends, height = (
        np.stack([np.concatenate([part[some] for part in parts]) for some in (_FIRST, _LAST)])
        for parts in (turns, heights)
    )
    leg = Piece(ends, height, np.zeros(len(scene), dtype=bool))
    return _Legs(cycles.take(scene).on(leg), scene, *ends)


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


def _closings(legs: _Legs, both: bool) -> tuple[FloatArray, IntArray]:
    """Return the phases between two turns at which the load starts to close contact at its edge,
    if `both` also those at which it ceases to, and the scene of each."""
    number = np.maximum(2, SAMPLES // (np.bincount(legs.scene) + 1))[legs.scene]
    leg = np.repeat(np.arange(len(number)), number + 1)
    at, last = np.arange(len(leg)) - (np.cumsum(number + 1) - number - 1)[leg], number[leg]
    share = np.clip((1 - np.cos(np.pi * at / last)) / 2, NEARLY, 1 - NEARLY)
    phase = legs.low[leg] + (legs.high - legs.low)[leg] * share
    value = legs.take(leg).closing_speed(phase)
    near, of = nearest_to_zero(lambda rows: legs.take(rows).closing_speed, phase, value, leg)
    phase, leg = np.append(phase, near), np.append(leg, of)
    value = np.append(value, legs.take(of).closing_speed(near))
    order = np.lexsort((phase, leg))
    phase, leg, value = phase[order], leg[order], value[order]
    turned = (value[:-1] < 0.0) & (value[1:] >= 0.0)
    if both:
        turned |= (value[:-1] >= 0.0) & (value[1:] < 0.0)
    rows = np.flatnonzero(turned & (np.diff(leg) == 0))
    legs = legs.take(leg[rows])
    phases = bracketed(legs.closing_speed, phase[rows], phase[rows + 1], FEW_BISECTIONS)[1]
    return phases, legs.scene


def _levels(models: Sequence[Model]) -> list[ModelLevels]:
    """Return the levels of models of one variant. The turning wear is zero if the displacement that
    just makes contact falls with wear from the start, infinite if it always rises."""
    model, none = stacked(models), np.zeros(len(models))
    scale, far = roughness(model, none), none + np.log(FAR)
    first, last = (model.margin_slope(scale * np.expm1(y), none) for y in (none, far))
    turning_wear = np.where(first >= 0.0, 0.0, np.inf)
    rows = np.flatnonzero((first < 0.0) & (last > 0.0))
    some, size = model.select(rows), scale[rows]
    y = bracketed(lambda y: some.margin_slope(size * np.expm1(y), 0.0 * y), none[rows], far[rows])
    turning_wear[rows] = size * np.expm1(y[1])
    turns = np.isfinite(turning_wear)
    highest = np.where(turns, displacement_at(model, np.where(turns, turning_wear, 0.0)), np.inf)
    numbers = np.array([turning_wear, highest, model.held_margin + none])
    return [ModelLevels(*each) for each in numbers.T.tolist()]
