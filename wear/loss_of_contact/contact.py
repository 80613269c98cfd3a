"""Wear in contact over a part of the cycle: collocation on the contact alone, up to its end.

Within contact the rate is smooth, if stiff: on a stiff support, and where wear is fast, the wear
follows the load within a small part of the cycle. Newton's method on all nodes of a part does not
mind, and Radau nodes damp what was before. Where contact ends, or changes its kind, the margin of
contact has come to a known level; the phase at which it does so is found along with the wear, so
that no node lies beyond and the collocation stays spectral.

Arrays are (nodes, cycles): the cycles go together, whichever scenes and parts they belong to.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from wear.loss_of_contact.switching import Cycles, roughness
from wear.numerics.collocation import NOISE
from wear.numerics.gauss import BoolArray, FloatArray, Gauss, IntArray
from wear.numerics.tolerances import ROUNDOFF, TINY

MOST_ITERATIONS = 12  # of Newton
PATIENCE = 4  # iterations that may diverge at first
SHORTEST = 1e-12  # step, of a stretch
MOST_PARTS = 1000  # steps, then a stretch is not sound
CAUTION, SHRINK, GROW = 0.9, 0.25, 4.0  # from one step to the next
LEAST = 0.1  # of the length of contact, that may be left from one iteration to the next
NEARLY_AS_FAST = 1.5  # of the 2 falls by as much that lie between the coefficients m and 2 m
SETTLED = 1e-2  # of the tolerance: what Newton's method may leave
STALLED = 1e-7  # what rounding may change from one iteration to the next, at the very most
BLUR = 4 * ROUNDOFF  # of the margin's terms and of the phase: what the end of contact is known to
LAYER = 0.25  # of the roughness: wear that changes the pressure by a factor of order one
BY_PHASE = 0.02  # share of the phase's rounding in that of a series of the rate
STIFF = 3.0  # decay over a part, as an exponent: then a system of equations is solved
FLAT = 1e-30  # mm per cycle: a margin that does not change
DIVERGED = 1e30  # relative change from one iteration to the next


class Interval(NamedTuple):
    """Stretches of phase (k,): where each begins, `whole` lengths, and where contact is `expected`
    to end, as lengths."""

    begin: FloatArray
    whole: FloatArray
    expected: FloatArray


class Contact(NamedTuple):
    """Contact of one kind in some `cycles` (k,): by the law, or held at its edge by a compliant
    support. It ends where the margin comes to a `level` (k,), mm, by falling where `direction`
    (k,) is 1 and by rising where it is -1; where that is 0 it lasts."""

    cycles: Cycles
    by_law: bool
    level: FloatArray
    direction: FloatArray

    def take(self, which: BoolArray | IntArray) -> Contact:
        """Return the contact in some of the cycles."""
        if which.dtype == bool and which.all():
            return self
        return Contact(
            self.cycles.take(which), self.by_law, self.level[which], self.direction[which]
        )

    def rate_per_cycle(self, u: FloatArray, U_a: FloatArray) -> tuple[FloatArray, FloatArray]:
        """Return the wear rate in mm per cycle, and its derivative with respect to the wear."""
        model, period = self.cycles.model, self.cycles.period
        rate, slope = (model.law_rate_and_slope if self.by_law else model.edge_rate_and_slope)(
            u, U_a
        )
        return period * rate, period * slope

    def steepness(self, u: FloatArray, phase: FloatArray) -> FloatArray:
        """Return what rounding of the phase makes of contact that begins at wears and phases (k,):
        by the law, in roundoffs of the rate; held, in mm of the margin per roundoff."""
        steepest = np.abs(self.cycles.load.slope(phase))
        if not self.by_law:
            return np.asarray(steepest + self.cycles.swing)
        # A phase is rounded, too, and under a steep load the pressure with it.
        sigma = roughness(self.cycles.model, u)
        return np.maximum(1.0, BY_PHASE * steepest / (LAYER * sigma))

    def noise(
        self, u: FloatArray, U_a: FloatArray, rate: FloatArray, steepness: FloatArray
    ) -> FloatArray:
        """Return the rounding error (k,) of the rate at the nodes (m, k), mm per cycle."""
        largest = np.max(np.abs(rate), axis=0)
        if self.by_law:
            return np.asarray(ROUNDOFF * steepness * largest)
        # Proportional to the margin, and so as inexact.
        model, none = self.cycles.model, np.zeros_like(steepness)
        per_margin, _ = self.rate_per_cycle(none, 1.0 - model.margin(none, none))
        terms = np.max(model.margin_terms(u, U_a), axis=0) + steepness
        return np.asarray(ROUNDOFF * (largest + per_margin * terms))

    def to_its_end(
        self, u: FloatArray, U_a: FloatArray, phase: FloatArray, rate: FloatArray
    ) -> tuple[FloatArray, FloatArray]:
        """Return how far it is to the end of contact (cycles) from wears and phases (k,), by a
        tangent, zero where it lasts; and what of that is rounding. The `rate` is in mm per
        cycle."""
        model, direction = self.cycles.model, self.direction
        left = direction * (model.margin(u, U_a) - self.level)
        closing = self.cycles.load.slope(phase) + model.margin_slope(u, U_a) * rate
        falls = np.minimum(direction * closing, -FLAT)
        uncertain = BLUR * (model.margin_terms(u, U_a) - falls)
        # Only a margin that is rounding makes the end uncertain: trial states may be far off.
        uncertainty = np.where(np.abs(left) <= uncertain, -uncertain / falls, 0.0)
        return np.where(direction == 0.0, 0.0, -left / falls), uncertainty


class ContactPart(NamedTuple):
    """A part of contact, by the law or not, that the cycles in `rows` (k,) of those asked for have
    come through: from the phases `begin` (k,) over a `length` (k,), from a wear `start` (k,), mm,
    with what has been added since, `inside` (m, k), at the nodes; and whether contact has `ended`
    (k,) there."""

    by_law: bool
    rows: IntArray
    begin: FloatArray
    length: FloatArray
    start: FloatArray
    inside: FloatArray
    ended: BoolArray


class ContactResult(NamedTuple):
    """What contact adds to each wear (k,), mm, and what the nodes have `missed` of that, by
    estimate, over its `length` (k,); whether that is `sound` (k,); the number of right-hand sides
    evaluated; its `parts` in order; and which wears, in `slid`, have ended by sliding along the
    edge."""

    added: FloatArray
    missed: FloatArray
    length: FloatArray
    sound: BoolArray
    evaluations: int
    parts: tuple[ContactPart, ...] = ()
    slid: IntArray = np.empty(0, dtype=np.intp)

    def among(self, rows: IntArray, number: int) -> ContactResult:
        """Return the result where the wears were those in `rows` of so many others, which add
        nothing."""
        if len(rows) == number:
            return self
        added, missed, length = np.zeros((3, number))
        added[rows], missed[rows], length[rows] = self.added, self.missed, self.length
        sound = np.full(number, True)
        sound[rows] = self.sound
        parts = tuple(part._replace(rows=rows[part.rows]) for part in self.parts)
        slid = rows[self.slid]
        return ContactResult(added, missed, length, sound, self.evaluations, parts, slid)


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

    Each stretch is taken in steps, as long as the rate on them is resolved to `tolerance` of what
    the cycle adds; all wears take a step at once, each its own.
    """
    (added, lost, length), step = np.zeros((3, len(u))), over.whole.copy()
    going, sound = np.full((2, len(u)), True)
    evaluations, parts = 0, list[ContactPart]()
    rows = np.arange(len(u))
    while len(rows):
        left = over.whole[rows] - length[rows]
        steps = np.ceil(left / step[rows])
        whole = left / steps
        expected = over.expected[rows] - length[rows]
        expected = np.minimum(np.where(expected > 0.0, expected, LEAST * whole), whole)
        stretch = Interval((over.begin + length)[rows], whole, expected)
        start, earlier = (u + added)[rows], (before + added)[rows]
        part = _part(contact.take(going), rule, tolerance, start, stretch)
        evaluations += part.evaluations
        missed = _missed(rule, part, earlier) / tolerance
        given_up = (whole <= SHORTEST * over.whole[rows]) | (len(parts) >= MOST_PARTS)
        sound[rows] &= ~given_up | (missed <= 1.0)
        fine = given_up | (missed <= 1.0)
        change = CAUTION * np.maximum(missed, TINY) ** (-0.5 / len(rule.nodes))
        step[rows] = whole * np.clip(change, SHRINK, GROW)
        some, ended = rows[fine], (part.length < whole)[fine]
        parts.append(
            ContactPart(
                contact.by_law,
                some,
                stretch.begin[fine],
                part.length[fine],
                start[fine],
                part.inside[:, fine],
                ended,
            )
        )
        added[some] += np.maximum(part.added[fine], 0.0)  # rounding may be negative
        by_now = np.maximum(earlier + part.added, 0.0)
        lost[some] += (missed * tolerance * by_now + part.left * np.abs(part.added))[fine]
        length[some] += part.length[fine]
        going[some] = (steps[fine] > 1.0) & ~ended
        rows = np.flatnonzero(going)
    return ContactResult(added, lost, length, sound, evaluations, tuple(parts))


class _Part(NamedTuple):
    """As `ContactResult`, with what is added `inside` (m, k) and the rate (m, k) in mm per cycle at
    the nodes, what is `noise` of it (k,), how often wear alone would turn over in the part: its
    `stiffness` (k,); and what the next iteration would change, relatively: `left` (k,)."""

    added: FloatArray
    length: FloatArray
    inside: FloatArray
    rate: FloatArray
    noise: FloatArray
    stiffness: FloatArray
    left: FloatArray
    sound: BoolArray
    evaluations: int


def _missed(rule: Gauss, part: _Part, before: FloatArray) -> FloatArray:
    """Return what the nodes miss of each step (k,), relative to what this cycle has added with it
    and `before` (k,).

    Gauss quadrature with m nodes leaves the coefficients from 2 m on, which the fall from m/2 to m
    predicts, if it goes on nearly as fast. Where the wear follows the load within less than the
    distance of two nodes, it leaves those from m on, over that time.
    """
    series = np.abs(rule.coefficients @ part.rate)
    half = len(series) // 2
    middle, tail = (np.max(series[k - 3 : k], axis=0) for k in (half, 2 * half))
    gain = np.minimum(tail / (middle + TINY), 1.0) ** NEARLY_AS_FAST
    follows = part.stiffness > half
    gain[follows] = np.maximum(gain, 1.0 / part.stiffness)[follows]
    left = tail * gain * part.length
    allowed = part.noise / np.maximum(1.0, part.stiffness / len(series) ** 2)
    left[tail < 100 * allowed] = 0.0
    missed = left / (np.maximum(before + part.added, 0.0) + TINY)
    return np.where(part.sound & ~np.isnan(missed), missed, np.inf)


def _part(contact: Contact, rule: Gauss, tolerance: float, u: FloatArray, over: Interval) -> _Part:
    """Newton's method on contact, until an iteration more would change the wear by a small part of
    the `tolerance`; where contact has a level, its end is found by tangents along with the wear, of
    which Radau's last node is the last."""
    settled = max(ROUNDOFF, SETTLED * tolerance)
    length = np.where(contact.direction == 0.0, over.whole, over.expected)
    ends, nodes = np.any(contact.direction != 0.0), rule.nodes[:, None]
    inside = np.zeros((len(nodes), len(u)))
    (last, left), evaluations = np.ones((2, len(u))), 0
    done, lost = np.full((2, len(u)), False)
    steepness = contact.steepness(u, over.begin)
    U_a = contact.cycles.load(over.begin + length * nodes)
    for iteration in range(MOST_ITERATIONS):
        rate, slope = contact.rate_per_cycle(u + inside, U_a)
        evaluations += rate.size
        missing = length * (rule.integrate @ rate) - inside
        step = np.where(done, 0.0, _newton(rule, length * slope, missing))
        rate, inside = rate + slope * step, inside + step
        added = length * (rule.weights @ rate)
        apart = np.max(np.abs(step), axis=0) / (np.abs(added) + TINY)
        noise = contact.noise(u + inside, U_a, rate, steepness)
        stiffness = length * np.max(np.abs(slope), axis=0)
        allowed = NOISE / ROUNDOFF * noise * length / np.maximum(1.0, stiffness)
        allowed /= np.abs(added) + TINY
        if ends:
            change, uncertainty = contact.to_its_end(
                u + added, U_a[-1], over.begin + length, rate[-1]
            )
            change = np.clip(length + change, LEAST * length, over.whole) - length
            change = np.where(done, 0.0, change)
            apart = np.maximum(apart, np.abs(change) / length)
            inside = inside + rate * nodes * change
            added, length = added + rate[-1] * change, length + change
            allowed += np.where(length < over.whole, uncertainty / length, 0.0)
        lost |= ~(apart < DIVERGED) | ((apart > last) & ~done & (iteration > PATIENCE))
        # A change that was large predicts nothing; one that is small and grows is rounding.
        left = np.where(done, left, apart * np.minimum(1.0, apart / np.minimum(last, 1.0)))
        done |= (left <= settled) | (apart <= allowed) | ((last < STALLED) & (apart >= last))
        if np.all(done | lost):
            break
        last = apart
        if ends:
            U_a = contact.cycles.load(over.begin + length * nodes)
    return _Part(added, length, inside, rate, noise, stiffness, left, done, evaluations)


def _newton(rule: Gauss, slope: FloatArray, missing: FloatArray) -> FloatArray:
    """Return the solution x (m, k) of x = missing + the integral of slope x.

    Where nothing decays much it is missing + E times the integral of slope missing/E, with
    E = exp(integral of slope): but for a truncation error, of which the next iteration takes care.
    """
    decay = rule.integrate @ slope
    stiff = ~(np.max(np.abs(decay), axis=0) < STIFF)
    factor = np.exp(np.where(stiff, 0.0, decay))
    x = missing + factor * (rule.integrate @ (slope * missing / factor))
    if stiff.any():
        matrix = np.eye(len(rule.nodes)) - rule.integrate * slope.T[stiff][:, None, :]
        x[:, stiff] = np.linalg.solve(matrix, missing.T[stiff][..., None])[..., 0].T
    return np.asarray(x)
