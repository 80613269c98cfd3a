"""Wear in contact over a part of the cycle: collocation on the contact alone, up to its end.

Within contact the rate is smooth, if stiff: on a stiff support, and where wear is fast, the wear
follows the load within a small part of the cycle. Newton's method on all nodes of a part does not
mind, and Radau nodes damp what was before. Where contact ends, or changes its kind, the margin of
contact has come to a known level; the phase at which it does so is found along with the wear, so
that no node lies beyond and the collocation stays spectral.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import NamedTuple

import numpy as np

from wear.load import Load
from wear.model import Model
from wear.numerics.collocation import (
    NOISE,
)
from wear.numerics.gauss import (
    BoolArray,
    FloatArray,
    Gauss,
    IntArray,
)
from wear.numerics.tolerances import (
    ROUNDOFF,
    TINY,
)

MOST_ITERATIONS = 12  # of Newton
PATIENCE = 4  # iterations that may diverge at first
SHORTEST = 1e-12  # part of a stretch
MOST_PARTS = 1000  # of a stretch, then it is not sound
LEAST = 0.1  # of the length of contact, that may be left from one iteration to the next
STALLED = 1e-7  # what rounding may change from one iteration to the next, at the very most
BLUR = 4 * ROUNDOFF  # of the margin's terms and of the phase: what the end of contact is known to
LAYER = 0.25  # of the roughness: wear that changes the pressure by a factor of order one
BY_PHASE = 0.02  # share of the phase's rounding in that of a series of the rate
STIFF = 3.0  # decay over a part, as an exponent: then a system of equations is solved
FLAT = 1e-30  # mm per cycle: a margin that does not change


class Interval(NamedTuple):
    """Stretches of phase of a cycle, (k,): where each begins, `whole` lengths, and where contact is
    `expected` to end, as lengths."""

    begin: FloatArray
    whole: FloatArray
    expected: FloatArray


class Contact(NamedTuple):
    """Contact of one kind under a load: its wear `rate` (mm/s) at any wear and displacement (mm),
    with its derivative with respect to the wear (1/s), and the `level` (mm) of the margin at which
    it ends, which comes from above if it `falls`; no level if it lasts. The rate may be
    `proportional` to the margin, and so as inexact."""

    model: Model
    load: Load
    rate: Callable[[FloatArray, FloatArray], tuple[FloatArray, FloatArray]]
    level: float | None = None
    falls: bool = True
    proportional: bool = False

    def rate_per_cycle(self, u: FloatArray, U_a: FloatArray) -> tuple[FloatArray, FloatArray]:
        """Return the wear rate in mm per cycle, and its derivative with respect to the wear."""
        rate, slope = self.rate(u, U_a)
        return self.load.period * rate, self.load.period * slope

    def noise(
        self, u: FloatArray, U_a: FloatArray, rate: FloatArray, steepest: FloatArray
    ) -> FloatArray:
        """Return what rounding makes of the `rate` (k, m), mm per cycle, at wears and displacements
        (k, m) under a load that changes by `steepest` (k,) mm per cycle; at most, (k,)."""
        largest = ROUNDOFF * np.max(np.abs(rate), axis=1)
        if not self.proportional:
            # A phase is rounded, too, and under a steep load the pressure with it.
            follows = np.abs(steepest) / (LAYER * _roughness(self.model, u[:, 0]))
            return np.asarray(largest * np.maximum(1.0, BY_PHASE * follows))
        none = np.array(0.0)
        per_margin, _ = self.rate_per_cycle(none, 1.0 - self.model.margin(none, none))
        terms = np.max(self.model.margin_terms(u, U_a), axis=1) + np.abs(steepest)
        terms += max(abs(self.load.minimum), abs(self.load.maximum))
        return np.asarray(largest + ROUNDOFF * per_margin * terms)

    def to_its_end(
        self, u: FloatArray, phase: FloatArray
    ) -> tuple[FloatArray, FloatArray, FloatArray]:
        """Return how far it is to the end of contact (cycles) from wears and phases (k,), by a
        tangent; what of that is rounding; and the rate there (mm per cycle)."""
        assert self.level is not None
        sign = 1.0 if self.falls else -1.0
        U_a = self.load(phase)
        left = sign * (self.model.margin(u, U_a) - self.level)
        rate, _ = self.rate_per_cycle(u, U_a)
        widens = self.model.margin_slope(u, U_a) * rate
        falls = np.minimum(sign * (self.load.slope(phase) + widens), -FLAT)
        uncertain = BLUR * (self.model.margin_terms(u, U_a) - falls)
        # Only a margin that is rounding makes the end uncertain: trial states may be far off.
        uncertainty = np.where(np.abs(left) <= uncertain, -uncertain / falls, 0.0)
        return -left / falls, uncertainty, rate


class ContactPart(NamedTuple):
    """A part of contact that the wears in `rows` (k,) of those asked for have come through: from
    the phases `begin` (k,) over a `length` (k,), from a wear `start` (k,), mm, with what has been
    added since, `inside` (k, m), at the nodes; and whether contact has `ended` (k,) there."""

    contact: Contact
    rows: IntArray
    begin: FloatArray
    length: FloatArray
    start: FloatArray
    inside: FloatArray
    ended: BoolArray


class ContactResult(NamedTuple):
    """What contact adds to each wear (k,), mm, over its `length` (k,); whether that is sound; the
    number of right-hand sides evaluated; its `parts` in order; and which wears, in `slid`, have
    ended by sliding along the edge."""

    added: FloatArray
    length: FloatArray
    sound: bool
    evaluations: int
    parts: tuple[ContactPart, ...] = ()
    slid: IntArray | None = None

    def of(self, rows: IntArray) -> tuple[ContactPart, ...]:
        """Return the parts, where the wears were those in `rows` of others."""
        return tuple(part._replace(rows=rows[part.rows]) for part in self.parts)


def wear_in_contact(
    contact: Contact,
    rule: Gauss,
    tolerance: float,
    u: FloatArray,
    over: Interval,
    before: FloatArray,
) -> ContactResult:
    """Return the wear from each u (k,) over stretches of the cycle that has added `before` (k,) mm
    so far.

    Each stretch is cut in two until the rate is resolved to `tolerance` of what the cycle adds.
    """
    added, length = np.zeros(len(u)), np.zeros(len(u))
    todo: list[tuple[IntArray, float, float]] = [(np.arange(len(u)), 0.0, 1.0)]
    evaluations, parts, sound = 0, 0, True
    passed: list[ContactPart] = []
    ended = np.zeros(len(u), dtype=bool)
    while todo:
        rows, begin, end = todo.pop()
        rows = rows[~ended[rows]]
        if len(rows) == 0:
            continue
        whole = (end - begin) * over.whole[rows]
        left = over.expected[rows] - begin * over.whole[rows]
        start, earlier = (u + added)[rows], (before + added)[rows]
        expected = np.minimum(np.where(left > 0.0, left, LEAST * whole), whole)
        stretch = Interval(over.begin[rows] + begin * over.whole[rows], whole, expected)
        part = _part(contact, rule, start, stretch)
        evaluations, parts = evaluations + part.evaluations, parts + 1
        fine = part.sound & _is_fine(rule, part, tolerance, earlier)
        if end - begin <= SHORTEST or parts >= MOST_PARTS:
            sound &= bool(fine.all())
            fine[:] = True
        some = rows[fine]
        passed.append(
            ContactPart(
                contact,
                some,
                stretch.begin[fine],
                part.length[fine],
                start[fine],
                part.inside[fine],
                part.length[fine] < whole[fine],
            )
        )
        added[some] += np.maximum(part.added[fine], 0.0)  # rounding may be negative
        length[some] += part.length[fine]
        ended[some] = part.length[fine] < whole[fine]
        if not fine.all():
            middle, again = (begin + end) / 2, rows[~fine]
            todo += [(again, middle, end), (again, begin, middle)]
    return ContactResult(added, length, sound, evaluations, tuple(passed))


class _Part(NamedTuple):
    """As `ContactResult`, with what is added `inside` (k, m) and the rate (k, m) in mm per cycle at
    the nodes, what is `noise` of it (k,), and how often wear alone would turn over in the part: its
    `stiffness` (k,)."""

    added: FloatArray
    length: FloatArray
    inside: FloatArray
    rate: FloatArray
    noise: FloatArray
    stiffness: FloatArray
    sound: BoolArray
    evaluations: int


def _is_fine(rule: Gauss, part: _Part, tolerance: float, before: FloatArray) -> BoolArray:
    """Return whether the nodes resolve the rate, as measured by what this cycle has added (k,),
    (k,).

    Gauss quadrature with m nodes leaves the coefficients from 2 m on, which the fall from m/2 to m
    foretells. Where the wear follows the load within less than the distance of two nodes, it leaves
    those from m on, over that time.
    """
    series = np.abs(part.rate @ rule.coefficients.T)
    half = series.shape[1] // 2
    middle, tail = (np.max(series[:, k - 3 : k], axis=1) for k in (half, 2 * half))
    gain = np.minimum(tail / (middle + TINY), 1.0) ** 2
    follows = part.stiffness > half
    gain[follows] = np.maximum(gain, 1.0 / part.stiffness)[follows]
    left = tail * gain * part.length
    allowed = part.noise / np.maximum(1.0, part.stiffness / series.shape[1] ** 2)
    left[tail < 100 * allowed] = 0.0
    resolved: BoolArray = left <= tolerance * np.maximum(before + part.added, 0.0)
    return resolved


def _roughness(model: Model, u: FloatArray) -> FloatArray:
    """Return the equivalent roughness (mm) at each wear (k,); it does not depend on the
    pressure."""
    none = np.zeros_like(u)
    fields = model.fields_under(none, u, none) if model.compliant else model.fields(u, none)
    return np.asarray(fields.sigma)


def _part(contact: Contact, rule: Gauss, u: FloatArray, over: Interval) -> _Part:
    """Newton's method on contact; where it has a level, the end of contact is found by tangents
    along with the wear."""
    length = over.expected if contact.level is not None else over.whole
    inside = np.zeros((len(u), len(rule.nodes)))
    last, done, evaluations = np.ones(len(u)), np.full(len(u), False), 0
    for iteration in range(MOST_ITERATIONS):
        phases = over.begin[:, None] + length[:, None] * rule.nodes
        U_a = contact.load(phases)
        rate, slope = contact.rate_per_cycle(u[:, None] + inside, U_a)
        evaluations += rate.size
        missing = length[:, None] * (rate @ rule.integrate.T) - inside
        step = _newton(rule, length, slope, missing)
        rate, inside = rate + slope * step, inside + step
        added = length * (rate @ rule.weights)
        apart = np.max(np.abs(step), axis=1) / (np.abs(added) + TINY)
        noise = contact.noise(u[:, None] + inside, U_a, rate, contact.load.slope(over.begin))
        stiffness = length * np.max(np.abs(slope), axis=1)
        allowed = NOISE / ROUNDOFF * noise * length / np.maximum(1.0, stiffness)
        allowed /= np.abs(added) + TINY
        if contact.level is not None:
            change, uncertainty, at_end = contact.to_its_end(u + added, over.begin + length)
            change = np.clip(length + change, LEAST * length, over.whole) - length
            apart = np.maximum(apart, np.abs(change) / length)
            inside = inside + rate * rule.nodes * change[:, None]
            added, length = added + at_end * change, length + change
            allowed += np.where(length < over.whole, uncertainty / length, 0.0)
        done |= _has_settled(apart, last, allowed)
        grows = bool(np.any((apart > last) & ~done)) and iteration > PATIENCE
        if done.all() or grows or not np.max(apart) < 1e30:
            break
        last = apart
    return _Part(added, length, inside, rate, noise, stiffness, done, evaluations)


def _newton(rule: Gauss, length: FloatArray, slope: FloatArray, missing: FloatArray) -> FloatArray:
    """Return the solution x (k, m) of x = missing + length times the integral of slope x.

    Where nothing decays much it is missing + E times the integral of slope missing/E, with
    E = exp(integral of slope): but for a truncation error, of which the next iteration takes care.
    """
    scaled = length[:, None] * slope
    decay = scaled @ rule.integrate.T
    stiff = ~(np.max(np.abs(decay), axis=1) < STIFF)
    factor = np.exp(np.where(stiff[:, None], 0.0, decay))
    x = missing + factor * ((scaled * missing / factor) @ rule.integrate.T)
    if stiff.any():
        matrix = np.eye(len(rule.nodes)) - rule.integrate * scaled[stiff][:, None, :]
        x[stiff] = np.linalg.solve(matrix, missing[stiff][..., None])[..., 0]
    return np.asarray(x)


def _has_settled(apart: FloatArray, last: FloatArray, noise: FloatArray) -> BoolArray:
    """Return whether an iteration that has changed by `apart`, after `last`, has come to its
    end."""
    # A change that was large foretells nothing; one that is small and grows is rounding.
    foretold = apart * np.minimum(1.0, apart / np.minimum(last, 1.0))
    stalled = (last < STALLED) & (apart >= last)
    settled: BoolArray = (foretold <= ROUNDOFF) | (apart <= noise) | stalled
    return settled
