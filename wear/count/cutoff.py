"""One cycle with the cutoff and a rigid support: collocation on the intervals of contact.

The contact ends where h = 3 sigma: the `margin` 3 sigma - h = U_a - B(u) vanishes. There, closed
contact would change the margin at the rate q = U_a' - B'(u) r, a function of the phase alone, since
u = B^-1(U_a). The cycle is cut where the load turns or has a kink, and where q rises through zero.
On a piece, then, contact reaches its edge in one direction only, and the smooth solution that is
continued beyond the edge does not come back: the sign of the margin at the end of a piece, or of
any part of it, tells for certain whether contact has been lost on it.

Where the load rises, contact starts at a root of U_a = B(u) that is known beforehand; if it is
lost, the solids slide along the edge (Filippov) to the end of the piece, where the wear is
B^-1(U_a). Where the load falls, contact that is lost stays so; its end is found along with the
wear.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import NamedTuple

import numpy as np

from wear.count.collocation import BoolArray, FloatArray, Mesh, mesh
from wear.count.cycle import (
    NOISE,
    PATIENCE,
    ROUNDOFF,
    TINY,
    Advance,
    Near,
    OneCycle,
    drive,
    first_edges,
)
from wear.load import Load
from wear.model import Model

SAMPLES = 2048  # of a cycle, to look for where q rises through zero
PIECE_SAMPLES = 16  # of the load on a piece, to look up phases
NEARLY = 1e-13  # of a stretch: how near to its ends one looks
BISECTIONS = 60  # to roundoff
FEW_BISECTIONS = 30  # where a small error has no effect of first order
MOST_NEWTON = 60  # for the wear at the edge, which may be far off
PHASE_NEWTON = 12  # from a secant of the samples of a piece
MOST_ITERATIONS = 60  # of Picard
SHORTEST = 1e-12  # part of a piece
MOST_EVALUATIONS = 10_000_000  # on a piece, then it is not sound
EDGE = 16.0  # roundoffs of the margin by which the edge of contact is told
LEAST = 0.1  # of the length of contact, that may be left from one iteration to the next
STALLED = 1e-7  # what rounding may change from one iteration to the next, at the very most
LAYER = 0.25  # of the roughness: wear that changes the pressure by a factor of order one
APART = 1e-9  # of roughness and wear: a small difference
FLAT = 1e-30  # mm per cycle: a margin that does not fall
FAR = 1e6  # times the roughness: wear at which the margin is as good as linear
Function = Callable[[FloatArray], FloatArray]


class Piece(NamedTuple):
    """A part of the cycle on which the load is smooth and does not turn: `phases` from its begin to
    its end, and the load's `heights` (mm) there."""

    phases: FloatArray
    heights: FloatArray

    @property
    def end(self) -> float:
        """Its last phase."""
        return float(self.phases[-1])

    @property
    def rising(self) -> bool:
        """Or level."""
        return bool(self.heights[-1] >= self.heights[0])


class CutoffCycle(NamedTuple):
    """A model with cutoff under a load, the cycle cut into `pieces`.

    The margin falls with wear up to the wear `crest` (mm), and rises beyond; under displacements
    above `highest` (mm) contact has no edge. `over` divides each
    piece, scaled to [0, 1]; parts in which the rate is not resolved to `tolerance` are cut further.
    """

    model: Model
    load: Load
    pieces: tuple[Piece, ...]
    crest: float
    highest: float
    over: Mesh
    tolerance: float

    @property
    def most_intervals(self) -> int:
        """Parts are cut as needed: nothing is left to refine."""
        return 1

    @property
    def heights(self) -> FloatArray:
        """Displacements (mm) at the ends of pieces."""
        return np.unique([piece.heights[i] for piece in self.pieces for i in (0, -1)])

    def on(self, over: Mesh) -> CutoffCycle:
        """The same on another mesh."""
        return self._replace(over=over)

    def resolved(self, wear: FloatArray, m: int, tolerance: float) -> CutoffCycle:
        """On a mesh of m nodes an interval."""
        return self._replace(over=mesh(np.array([0.0, 1.0]), m), tolerance=tolerance)

    def advance(self, starts: FloatArray, near: Near | None = None) -> Advance:
        """Wear added by one cycle from each start, shape (...); guesses are of no use."""
        flat = starts.ravel()
        added = np.zeros(len(flat))
        sound, evaluations = True, 0
        for piece in self.pieces:
            run = _run(self, piece, flat + added, added)
            added = added + run.added
            sound &= run.sound
            evaluations += run.evaluations
        nothing = np.zeros((*starts.shape, *self.over.phases.shape))
        converged = np.full(len(self.over.lengths), sound)
        left = np.zeros(starts.shape)
        return Advance(added.reshape(starts.shape), nothing, nothing, evaluations, converged, left)

    def frozen(self, wear: FloatArray) -> FloatArray:
        """Wear added by one cycle if the rate did not feel it, any shape."""
        flat = wear.ravel()
        added = np.zeros(len(flat))
        x = self.over.phases.ravel()
        weights = (self.over.lengths[:, None] * self.over.rule.weights).ravel()
        for piece in self.pieces:
            active, begin, end = _contact(self, piece, flat)
            length = end - begin
            U_a = self.load(begin[:, None] + length[:, None] * x)
            mean = self.model.rate(flat[active, None], U_a) @ weights
            added[active] += self.load.period * length * mean
        return added.reshape(wear.shape)

    def growth(self, starts: FloatArray) -> FloatArray:
        """By how much one cycle changes a small difference in the wears it starts from (k,): where
        contact begins or ends at a touch, by a lot."""
        roughness = float(self.model.fields(np.array(0.0), np.array(0.0)).sigma)
        beside = starts + APART * (roughness + starts)
        added = self.advance(np.stack([starts, beside])).increment
        factor: FloatArray = np.abs(1 + (added[1] - added[0]) / (beside - starts))
        return factor

    def several(self, start: float, number: int) -> Advance:
        """Some cycles on end from wear `start`; increments have shape (number,)."""
        runs, wear = [], start
        for _ in range(number):
            run = self.advance(np.array([wear]))
            wear += float(run.increment[0])
            runs.append(run)
        return Advance(
            np.concatenate([run.increment for run in runs]),
            np.concatenate([run.inside for run in runs]),
            np.concatenate([run.rate for run in runs]),
            sum(run.evaluations for run in runs),
            np.all([run.converged for run in runs], axis=0),
            np.concatenate([run.left for run in runs]),
        )


def one_cycle(model: Model, load: Load) -> OneCycle:
    """The map of one cycle that a model needs, on a mesh yet to be resolved."""
    if not model.cutoff or model.compliant:
        return drive(model, load, mesh(first_edges(load), 8))
    crest = crest_of_edge(model)
    turns = turning_points(load)
    highest = float(edge_of(model, np.array(crest))) if np.isfinite(crest) else np.inf
    low, high = turns[:-1], turns[1:]
    over = (load(low) < highest) != (load(high) < highest)
    appears = bisected(lambda phase: load(phase) - highest, low[over], high[over])
    cuts = np.unique(np.concatenate([turns, appears, closings(model, load, crest, turns)]))
    inside = (1 - np.cos(np.pi * np.arange(PIECE_SAMPLES + 1) / PIECE_SAMPLES)) / 2
    phases = cuts[:-1, None] + np.diff(cuts)[:, None] * inside
    pieces = tuple(map(Piece, phases, load(phases)))
    return CutoffCycle(model, load, pieces, crest, highest, mesh(np.array([0.0, 1.0]), 8), 1.0)


def edge_of(model: Model, wear: FloatArray) -> FloatArray:
    """The displacement (mm) that just makes contact at each wear: the margin rises with it by as
    much."""
    edge: FloatArray = -model.margin(wear, np.zeros_like(wear))
    return edge


def crest_of_edge(model: Model) -> float:
    """The wear (mm) at which the displacement that just makes contact is largest: zero if it falls
    from the start, infinite if it always rises."""
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
    return float(scale * np.expm1(bisected(slope, ends[:1], ends[1:])[0]))


def turning_points(load: Load) -> FloatArray:
    """Phases from 0 to 1 between which the load is smooth and rises or falls throughout."""
    cuts = np.unique([0.0, *load.kinks, *load.peaks, 1.0])
    # Between two peaks or kinks there is a trough at most.
    low, high = cuts[:-1] + NEARLY * np.diff(cuts), cuts[1:] - NEARLY * np.diff(cuts)
    turns = (load.slope(low) < 0.0) & (load.slope(high) > 0.0)
    return np.unique(np.concatenate([cuts, bisected(load.slope, low[turns], high[turns])]))


def closings(model: Model, load: Load, crest: float, turns: FloatArray) -> FloatArray:
    """The phases at which the load starts to close contact at its edge, between two turns."""

    def pull(phase: FloatArray) -> FloatArray:
        U_a, speed = load(phase), load.slope(phase)
        wear = edge_wear(model, U_a, np.zeros_like(U_a), 0.0, crest)
        if np.isfinite(crest):
            scale = float(model.fields(np.array(0.0), np.array(0.0)).sigma)
            worn = edge_wear(model, U_a, np.full_like(U_a, FAR * scale), crest, np.inf)
            wear = np.where(speed < 0.0, worn, wear)
        opening = model.margin_slope(wear, U_a) * load.period * model.rate(wear, U_a)
        result: FloatArray = speed + opening
        return result

    number = max(2, SAMPLES // len(turns))
    inside = (1 - np.cos(np.pi * np.arange(number + 1) / number)) / 2
    inside[0], inside[-1] = NEARLY, 1 - NEARLY
    phases = (turns[:-1, None] + np.diff(turns)[:, None] * inside).ravel()
    phases = np.unique(np.concatenate([phases, _extremes(pull, phases)]))
    value = pull(phases)
    same = np.diff(np.searchsorted(turns, phases)) == 0
    rises = (value[:-1] < 0.0) & (value[1:] >= 0.0) & same
    return bisected(pull, phases[:-1][rises], phases[1:][rises], FEW_BISECTIONS)


def _extremes(function: Function, x: FloatArray) -> FloatArray:
    """Where a function comes nearest to zero between samples at `x` of one sign."""
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


def bisected(
    function: Function, low: FloatArray, high: FloatArray, steps: int = BISECTIONS
) -> FloatArray:
    """Where a function changes its sign, in each of many intervals at whose ends it differs."""
    sign = np.sign(function(low))
    for _ in range(steps):
        middle = (low + high) / 2
        before = np.sign(function(middle)) == sign
        low, high = np.where(before, middle, low), np.where(before, high, middle)
    return high


def edge_wear(
    model: Model, displacement: FloatArray, guess: FloatArray, least: float, most: float
) -> FloatArray:
    """The wear (mm) at which contact ends under a displacement, by Newton's method; the nearest of
    `least` and `most` if there is none between.

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


class _Run(NamedTuple):
    """What a piece adds to each wear (k,), mm, and whether that is sound."""

    added: FloatArray
    sound: bool
    evaluations: int


def _run(cycle: CutoffCycle, piece: Piece, wear: FloatArray, before: FloatArray) -> _Run:
    """A piece from each wear (k,), `before` (k,) of it added by this cycle already."""
    added = np.zeros(len(wear))
    active, begin, end = _contact(cycle, piece, wear)
    if not active.any():
        return _Run(added, True, 0)
    u = wear[active]
    run = _closed(cycle, piece, u, begin, end, before[active])
    added[active] = run.added
    if piece.rising:
        top = np.full(len(u), piece.heights[-1])
        lost = _is_lost(cycle, u, u + run.added, top)
        if lost.any():
            edge = edge_wear(cycle.model, top[lost], u[lost], 0.0, cycle.crest)
            added[np.flatnonzero(active)[lost]] = edge - u[lost]
    return run._replace(added=added)


def _contact(
    cycle: CutoffCycle, piece: Piece, wear: FloatArray
) -> tuple[BoolArray, FloatArray, FloatArray]:
    """Which wears (k,) make contact on a piece, and the phases of its begin and end for those if
    the wear stays as it is."""
    model, heights = cycle.model, piece.heights
    needed = edge_of(model, wear)
    peak = np.full_like(wear, cycle.load.maximum)
    touching = EDGE * ROUNDOFF * model.margin_terms(wear, peak)
    active = max(heights[0], heights[-1]) - needed > touching
    edge = _phase_of(cycle.load, piece, needed[active])
    if piece.rising:
        return active, edge, np.full_like(edge, piece.phases[-1])
    return active, np.full_like(edge, piece.phases[0]), edge


def _phase_of(load: Load, piece: Piece, height: FloatArray) -> FloatArray:
    """Where the load reaches each height (k,) on a piece; the nearest end if it does not."""
    direction = 1.0 if piece.rising else -1.0
    height = np.clip(height, np.min(piece.heights), np.max(piece.heights))
    rising = direction * piece.heights
    at = np.clip(np.searchsorted(rising, direction * height), 1, len(rising) - 1)
    low, high = piece.phases[at - 1], piece.phases[at]
    share = (height - piece.heights[at - 1]) / (piece.heights[at] - piece.heights[at - 1])
    phase = low + (high - low) * np.clip(np.nan_to_num(share), 0.0, 1.0)
    for _ in range(PHASE_NEWTON):
        slope = load.slope(phase)
        step = (height - load(phase)) / np.where(slope == 0.0, np.inf, slope)
        fresh = np.clip(phase + step, low, high)
        change, phase = np.max(np.abs(fresh - phase), initial=0.0), fresh
        if change <= ROUNDOFF:
            break
    return phase


def _is_lost(cycle: CutoffCycle, start: FloatArray, wear: FloatArray, U_a: FloatArray) -> BoolArray:
    """Whether contact from the wear `start` to `wear`, continued smoothly, has left its edge."""
    lost: BoolArray = cycle.model.margin(wear, U_a) < 0.0
    return lost | _is_over(cycle, start, wear, U_a)


def _is_over(cycle: CutoffCycle, start: FloatArray, wear: FloatArray, U_a: FloatArray) -> BoolArray:
    """Whether it has come to wear at which contact closes anew, on the other side of the crest."""
    over: BoolArray = (start < cycle.crest) & (wear >= cycle.crest) & (U_a < cycle.highest)
    return over


def _closed(
    cycle: CutoffCycle,
    piece: Piece,
    u: FloatArray,
    begin: FloatArray,
    end: FloatArray,
    before: FloatArray,
) -> _Run:
    """Closed contact on a piece, part by part, from the phase `begin` and the wear u (k,), each
    part cut in two until it is sound; where the load falls, to the end of contact, which is
    expected at `end`."""
    length = piece.end - begin
    worn, closed = np.zeros(len(u)), np.full(len(u), True)
    done, todo = 0.0, cycle.over.edges[:0:-1].tolist()
    evaluations, sound = 0, True
    while todo and closed.any():
        span = todo[-1] - done
        at, whole = begin[closed] + done * length[closed], span * length[closed]
        start = (u + worn)[closed]
        expected = whole if piece.rising else np.clip(end[closed] - at, LEAST * whole, whole)
        part = _part(cycle, start, at, whole, expected, piece.rising)
        evaluations += part.evaluations
        fine = part.sound and _is_fine(cycle, part, start, (before + worn)[closed])
        if not fine and span > SHORTEST and evaluations < MOST_EVALUATIONS:
            todo.append(done + span / 2)
            continue
        sound &= fine
        worn[closed] += part.added
        closed[closed] = part.length >= whole
        done = todo.pop()
    return _Run(worn, sound, evaluations)


class _Part(NamedTuple):
    """What contact adds to each wear (k,), mm, over its `length` (k,); the rate (k, m) in mm per
    cycle; whether the iteration converged."""

    added: FloatArray
    length: FloatArray
    rate: FloatArray
    sound: bool
    evaluations: int


def _is_fine(cycle: CutoffCycle, part: _Part, u: FloatArray, before: FloatArray) -> bool:
    """Whether the nodes resolve the rate, as measured by what this cycle has added (k,).

    Gauss quadrature with m nodes leaves the coefficients from 2 m on, which the fall from m/2 to m
    foretells. No node sees a layer before the first, where wear opens the gap: up to there wear
    must be small against the roughness.
    """
    series = np.abs(part.rate @ cycle.over.rule.coefficients.T)
    half = series.shape[1] // 2
    middle, tail = (np.max(series[:, k - 3 : k], axis=1) for k in (half, 2 * half))
    left = tail * np.minimum(tail / (middle + TINY), 1.0) ** 2 * part.length
    left[tail < 100 * ROUNDOFF * np.max(series, axis=1)] = 0.0
    roughness = cycle.model.fields(u, np.zeros_like(u)).sigma
    skipped = part.length * cycle.over.rule.nodes[0] * np.max(part.rate, axis=1)
    seen = skipped <= LAYER * roughness
    return bool(np.all(seen & (left <= cycle.tolerance * (before + part.added))))


def _part(
    cycle: CutoffCycle,
    u: FloatArray,
    at: FloatArray,
    whole: FloatArray,
    length: FloatArray,
    rising: bool,
) -> _Part:
    """Picard iteration on contact from the phase `at` over the length `whole`, each (k,).

    Where the load falls contact may end before, where the margin vanishes: Newton's method finds
    that along with the iteration, from the guess `length`.
    """
    model, load, rule = cycle.model, cycle.load, cycle.over.rule
    inside = np.zeros((len(u), len(rule.nodes)))
    last, done, evaluations = np.ones(len(u)), np.full(len(u), False), 0
    for iteration in range(MOST_ITERATIONS):
        U_a = load(at[:, None] + length[:, None] * rule.nodes)
        rate = load.period * model.rate(u[:, None] + inside, U_a)
        evaluations += rate.size
        added = length * (rate @ rule.weights)
        fresh = length[:, None] * (rate @ rule.integrate.T)
        apart = np.max(np.abs(fresh - inside), axis=1) / (added + TINY)
        if not rising:
            U_a = load(at + length)
            margin = model.margin(u + added, U_a)
            widens = model.margin_slope(u + added, U_a) * load.period * model.rate(u + added, U_a)
            falls = np.minimum(load.slope(at + length) + widens, -FLAT)
            change = np.clip(length - margin / falls, LEAST * length, whole) - length
            apart = np.maximum(apart, np.abs(change) / length)
            fresh += rate * rule.nodes * change[:, None]
            length = length + change
        inside = fresh
        # A change that was large foretells nothing; one that is small and grows is rounding.
        foretold = apart * np.minimum(1.0, apart / np.minimum(last, 1.0))
        stalled = (last < STALLED) & (apart >= last)
        done |= (foretold <= ROUNDOFF) | (apart <= NOISE) | stalled
        grows = bool(np.any((apart > last) & ~done)) and iteration > PATIENCE
        if done.all() or grows or not np.max(apart) < 1e30:
            break
        last = apart
    converged = bool(done.all())
    if not rising:
        converged &= not np.any(_is_over(cycle, u, u + added, load(at + length)))
    return _Part(added, length, rate, converged, evaluations)
