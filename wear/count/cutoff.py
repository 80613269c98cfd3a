"""One cycle with the cutoff and a rigid support: collocation on the intervals of contact.

The contact ends where h = 3 sigma: the `margin` 3 sigma - h vanishes. It changes with the load, by
as much, and with the wear. Between two turning points of the load it starts or ends at most once:
where the load rises, contact starts at a root in phase that is known beforehand; where it falls,
contact ends at a root that is found along with the wear. If wear opens the gap faster than the
rising load closes it (possible only where the margin falls with wear), the solids slide along the
edge of contact: margin zero, up to the turning point. There the wear is what the margin says.
"""

from __future__ import annotations

from itertools import pairwise
from typing import NamedTuple

import numpy as np

from wear.count.collocation import BoolArray, FloatArray, Mesh, mesh
from wear.count.cycle import (
    MOST_ITERATIONS,
    NOISE,
    ROUNDOFF,
    TINY,
    Advance,
    OneCycle,
    drive,
    first_edges,
)
from wear.load import Load
from wear.model import Model

SAMPLES = 256  # of a load, to find its turning points
BISECTIONS = 24  # then Newton's method
NEWTON = 4
EDGE = 16.0  # roundoffs of the margin by which the edge of contact is told
LOST = 1e-9  # of the margin's terms, below which contact is lost
FLAT = 1e-30  # mm per cycle: a margin that does not fall


class CutoffCycle(NamedTuple):
    """A model with cutoff under a load that turns at `turns` (phases from 0 to 1).

    `over` divides the contact on each stretch between two turns, scaled to [0, 1].
    """

    model: Model
    load: Load
    turns: FloatArray
    over: Mesh

    @property
    def most_intervals(self) -> int:
        """Where refining stops: what is not sound by then is no matter of the mesh."""
        return 12

    def on(self, over: Mesh) -> CutoffCycle:
        """The same on another mesh."""
        return self._replace(over=over)

    def resolved(self, wear: FloatArray, m: int, tolerance: float) -> CutoffCycle:
        """On a mesh of m nodes an interval. Contact ends where the pressure is small: its course
        is smooth on the scale of the contact, and what more it needs the first cycles show."""
        return self.on(mesh(np.array([0.0, 0.5, 1.0]), m))

    def advance(self, starts: FloatArray) -> Advance:
        """Wear added by one cycle from each start, shape (...)."""
        flat = starts.ravel()
        added = np.zeros(len(flat))
        rates, evaluations = [], 0
        sound = np.full(len(flat), True)
        for begin, end in pairwise(self.turns):
            stretch = _stretch(self, flat + added, begin, end, frozen=False)
            added += stretch.added
            rates.append(stretch.rate)
            sound &= stretch.sound
            evaluations += stretch.evaluations
        rate = np.concatenate(rates)
        converged = np.full(len(self.over.lengths), bool(sound.all()))
        return Advance(added.reshape(starts.shape), rate, rate, evaluations, converged)

    def frozen(self, wear: FloatArray) -> FloatArray:
        """Wear added by one cycle if the rate did not feel it, any shape."""
        flat = wear.ravel()
        parts = [
            _stretch(self, flat, begin, end, frozen=True).added
            for begin, end in pairwise(self.turns)
        ]
        added: FloatArray = np.sum(parts, axis=0).reshape(wear.shape)
        return added

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
        )


class _Stretch(NamedTuple):
    added: FloatArray  # (k,) mm
    rate: FloatArray  # (k, q, m), times the length of contact; zero where there is none
    sound: BoolArray  # (k,)
    evaluations: int


def one_cycle(model: Model, load: Load) -> OneCycle:
    """The map of one cycle that a model needs, on a mesh yet to be resolved."""
    if model.cutoff and not model.compliant:
        return CutoffCycle(model, load, turning_points(load), mesh(np.array([0.0, 1.0]), 8))
    return drive(model, load, mesh(first_edges(load), 8))


def margin_terms(model: Model, wear: FloatArray) -> FloatArray:
    """Sum of the absolute terms (mm) of which the margin at `wear` is made, but for the load's:
    it is known to as many roundoffs."""
    still = np.zeros_like(wear)
    slope = np.abs(model.margin_slope(wear, still)) if model.linear_margin else 2.0
    fresh = 2 * np.abs(model.fields(still, still).h)
    terms: FloatArray = np.abs(model.margin(wear, still)) + slope * wear + fresh
    return terms


def turning_points(load: Load) -> FloatArray:
    """Phases from 0 to 1 between which the load is smooth and rises or falls throughout."""
    kinks = np.unique([0.0, *load.kinks, 1.0])
    found = [kinks]
    for begin, end in pairwise(kinks):
        edges = begin + (end - begin) * (np.arange(SAMPLES) + 0.5) / SAMPLES
        sign = np.sign(load.slope(edges))
        at = np.flatnonzero(sign[:-1] * sign[1:] < 0)
        low, high = edges[at], edges[at + 1]
        for _ in range(60):
            middle = (low + high) / 2
            left = np.sign(load.slope(middle)) == sign[at]
            low, high = np.where(left, middle, low), np.where(left, high, middle)
        exact = [phase for phase in load.peaks if np.any(np.abs(high - phase) < 1e-9)]
        found += [high[[not np.any(np.abs(exact - x) < 1e-9) for x in high]], np.array(exact)]
    return np.unique(np.concatenate(found))


def _stretch(
    cycle: CutoffCycle, wear: FloatArray, begin: float, end: float, frozen: bool
) -> _Stretch:
    """What is added to each wear (k,) between two turning points."""
    model, load = cycle.model, cycle.load
    first, last = float(load(begin)), float(load(end))
    rising = last >= first
    needed = -model.margin(wear, np.zeros_like(wear))  # the displacement where contact starts
    touching = EDGE * ROUNDOFF * (margin_terms(model, wear) + abs(load.maximum))
    active = max(first, last) - needed > touching
    shape = (len(wear), *cycle.over.phases.shape)
    result = _Stretch(np.zeros(len(wear)), np.zeros(shape), np.full(len(wear), True), 0)
    if not active.any():
        return result
    u, needed = wear[active], needed[active]
    edge = _phase_of(load, needed, begin, end, rising)
    start = np.where(first >= needed, begin, edge) if rising else np.full(len(u), begin)
    stop = np.full(len(u), end) if rising else np.where(last >= needed, end, edge)
    if frozen:
        part = _contact(cycle, u, start, stop, None, once=True)
    else:
        part = _contact(cycle, u, start, stop, None if rising else end, once=False)
    if rising and not frozen:
        part = _slide(cycle, u, start, end, part)
    result.added[active], result.rate[active] = part.added, part.rate
    result.sound[active] = part.sound
    return result._replace(evaluations=part.evaluations)


def _phase_of(load: Load, value: FloatArray, begin: float, end: float, rising: bool) -> FloatArray:
    """Where the load takes each value (k,) between two turning points; the nearest end if not."""
    low, high = np.full(len(value), begin), np.full(len(value), end)
    for _ in range(BISECTIONS):
        middle = (low + high) / 2
        before = (load(middle) < value) == rising
        low, high = np.where(before, middle, low), np.where(before, high, middle)
    phase = (low + high) / 2
    for _ in range(NEWTON):
        slope = load.slope(phase)
        step = (value - load(phase)) / np.where(slope == 0.0, np.inf, slope)
        phase = np.clip(phase + step, low, high)
    found: FloatArray = phase
    return found


def _contact(
    cycle: CutoffCycle,
    u: FloatArray,
    start: FloatArray,
    stop: FloatArray,
    end: float | None,
    once: bool,
) -> _Stretch:
    """Picard iteration on contact from `start` to `stop` (k,).

    With `end` the load falls: contact stops where the margin vanishes, at `end` the latest, which
    Newton's method finds along with the iteration. `once` keeps the wear frozen.
    """
    model, load, over = cycle.model, cycle.load, cycle.over
    length = stop - start
    integrate = _unit_integral(over)
    weights = (over.lengths[:, None] * over.rule.weights).ravel()
    x = over.phases.ravel()
    inside = np.zeros((len(u), x.size))
    last, evaluations, sound = 1.0, 0, np.full(len(u), False)
    noise = np.full(len(u), NOISE)
    terms = margin_terms(model, u) + abs(load.maximum)
    for _ in range(MOST_ITERATIONS):
        displacement = load(start[:, None] + length[:, None] * x)
        rate = load.period * length[:, None] * model.rate(u[:, None] + inside, displacement)
        evaluations += rate.size
        added = rate @ weights
        if once:
            sound[:] = True
            break
        fresh = rate @ integrate
        apart = np.abs(fresh - inside).max(axis=1) / (added + TINY)
        inside = fresh
        if end is not None:
            phase = start + length
            edge = model.margin(u + added, load(phase))
            falls = load.slope(phase) + model.margin_slope(u + added, load(phase)) * (
                load.period * model.rate(u + added, load(phase))
            )
            falls = np.minimum(falls, -FLAT)
            moved = np.clip(length - edge / falls, 0.0, end - start)
            # The margin's own rounding moves its root.
            blur = np.where(moved < end - start, 8 * ROUNDOFF * terms / -falls, 0.0)
            noise = NOISE + 2 * blur / (moved + TINY)
            apart = np.maximum(apart, np.abs(moved - length) / (moved + TINY))
            length = moved
        sound = apart <= noise
        change = float(apart.max())
        if sound.all() or change * min(1.0, change / last) <= ROUNDOFF:
            sound[:] = True
            break
        last = change
    if not once:
        # Contact that is lost on the way and found again is not what was integrated.
        lost = model.margin(u[:, None] + inside, displacement) < -LOST * terms[:, None]
        again = (lost[:, :-1] & ~lost[:, 1:]).any(axis=1)
        sound = sound & ~(again if end is None else lost.any(axis=1))
    return _Stretch(added, rate.reshape(len(u), *over.phases.shape), sound, evaluations)


def _unit_integral(over: Mesh) -> FloatArray:
    """Matrix (nodes, nodes) from values at all nodes of a mesh to running integrals."""
    m = len(over.rule.nodes)
    full = np.zeros((over.phases.size, over.phases.size))
    for i, length in enumerate(over.lengths):
        at = slice(i * m, (i + 1) * m)
        full[at, at] = length * over.rule.integrate.T
        full[at, (i + 1) * m :] = (length * over.rule.weights)[:, None]
    return full


def _slide(
    cycle: CutoffCycle, u: FloatArray, start: FloatArray, end: float, closed: _Stretch
) -> _Stretch:
    """Where contact would not last to the turning point, wear that keeps the margin at zero.

    Sound only if sliding, once begun, goes on to the end: the load must rise more slowly than
    contact would open the gap.
    """
    model, load, over = cycle.model, cycle.load, cycle.over
    top = float(load(end))
    margin = model.margin(u + closed.added, np.full(len(u), top))
    slides = margin < 0.0
    # From the turning point back to where contact starts, along the edge of contact.
    phase = end - (end - start)[:, None] * np.append(over.phases.ravel(), 1.0) ** 2
    at = load(phase)
    path = np.maximum(_wear_at_edge(model, np.repeat(u[:, None], phase.shape[1], 1), at), 0.0)
    opening = -model.margin_slope(path, at) * load.period * model.rate(path, at)
    held = load.slope(phase) <= opening
    # Once begun, sliding lasts if the load rises more slowly from some phase on.
    lasting = held[:, 0] & (np.sum(held[:, 1:] != held[:, :-1], axis=1) <= 1)
    at_once = held[:, -1] & ~held.all(axis=1)  # it would slide, and close later
    closed.sound[:] &= ~at_once & (lasting | ~slides)
    top_wear = _wear_at_edge(model, u[slides], top)
    closed.added[slides] = top_wear - u[slides]
    return closed


def _wear_at_edge(model: Model, guess: FloatArray, displacement: FloatArray | float) -> FloatArray:
    """The wear at which contact ends under a displacement, by Newton's method."""
    wear = guess
    for _ in range(6):  # the margin of one worn solid is linear in the wear
        U = np.broadcast_to(displacement, wear.shape)
        wear = wear - model.margin(wear, U) / model.margin_slope(wear, U)
    return wear
