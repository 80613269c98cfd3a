"""Wear in contact over a part of the cycle: collocation on the contact alone, up to its end.

Within contact the rate is smooth, if stiff: on a stiff support, and where wear is fast, the wear
follows the load within a small part of the cycle. Newton's method
on all nodes of a step converges all the same, and Radau nodes damp the fast decay. Where contact
ends, or changes its kind, the margin of contact has come to a known level; the phase at which it
does so is found along with the wear, so that no node lies beyond and the collocation stays
spectral.

Arrays are (nodes, cycles): the cycles go together, whichever scenes and parts they belong to.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from wear.loss_of_contact.switching import Cycles, undeflected
from wear.numerics.collocation import NOISE
from wear.numerics.floating_point import ROUNDOFF, TINY
from wear.numerics.gauss import BoolArray, FloatArray, Gauss, IntArray

MOST_ITERATIONS = 12  # of Newton
PATIENCE = 4  # iterations that may diverge at first
SHORTEST = 1e-12  # step, of an interval
MOST_PARTS = 1000  # steps, then an interval is not sound
CAUTION, SHRINK, GROW = 0.9, 0.25, 4.0  # from one step to the next
LEAST = 0.1  # of the length of contact: the most that an iteration may shorten it to
NEARLY_AS_FAST = 1.5  # of the 2 falls by as much that lie between the coefficients m and 2 m
SETTLED = 1e-2  # of the tolerance: iteration error of Newton's method
STALLED = 1e-7  # relative change by rounding from one iteration to the next, at most
UNCERTAINTY = 4 * ROUNDOFF  # of the end of contact, in the margin's terms and the phase
LAYER = 0.25  # of the roughness: wear that changes the pressure by a factor of order one
BY_PHASE = 0.02  # share of the phase's rounding in that of a series of the rate
STIFF = 3.0  # decay over a part, as an exponent: then a system of equations is solved
FLAT = 1e-30  # mm per cycle: a margin that does not change
DIVERGED = 1e30  # relative change from one iteration to the next


class PhaseInterval(NamedTuple):
    """Intervals of phase (k,): where each begins, its `whole` length, and the length after which
    contact is `expected` to end."""

    begin: FloatArray
    whole: FloatArray
    expected: FloatArray


class ContactMode(NamedTuple):
    """Contact of one kind in some `cycles` (k,): by the law, or held at its edge by a compliant
    support. It ends where the margin comes to a `level` (k,), mm, by falling where `direction`
    (k,) is 1 and by rising where it is -1; where that is 0 it lasts."""

    cycles: Cycles
    by_law: bool
    level: FloatArray
    direction: FloatArray

    def take(self, which: BoolArray | IntArray) -> ContactMode:
        """Return the contact in some of the cycles."""
        if which.dtype == bool and which.all():
            return self
        return ContactMode(
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
        """Return the sensitivity to rounding of the phase of contact that begins at wears and
        phases (k,): by the law, in roundoffs of the rate; held, in mm of the margin per
        roundoff."""
        steepest = np.abs(self.cycles.load.slope(phase))
        if not self.by_law:
            return np.asarray(steepest + self.cycles.swing)
        # A phase is rounded, too, and under a steep load the pressure with it.
        model = self.cycles.model
        fields = undeflected(model, u, self.cycles.load(phase))
        of_law = model.law_roundoff(fields.h / fields.sigma) / ROUNDOFF
        by_phase = BY_PHASE * steepest / (LAYER * fields.sigma)
        return np.asarray(np.maximum(np.maximum(1.0, of_law), by_phase))

    def noise(
        self, u: FloatArray, U_a: FloatArray, rate: FloatArray, steepness: FloatArray
    ) -> FloatArray:
        """Return the rounding error (k,) of the rate at the nodes (m, k), mm per cycle."""
        largest = np.abs(rate).max(axis=0)
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
        """Return the distance in phase to the end of contact from wears and phases (k,), by a
        tangent, zero where contact lasts; and its rounding error. The `rate` is in mm per
        cycle."""
        model, direction = self.cycles.model, self.direction
        distance = direction * (model.margin(u, U_a) - self.level)
        closing = self.cycles.load.slope(phase) + model.margin_slope(u, U_a) * rate
        falls = np.minimum(direction * closing, -FLAT)
        uncertain = UNCERTAINTY * (model.margin_terms(u, U_a) - falls)
        # Only a margin that is rounding makes the end uncertain: trial states may be far off.
        uncertainty = np.where(np.abs(distance) <= uncertain, -uncertain / falls, 0.0)
        return np.where(direction == 0.0, 0.0, -distance / falls), uncertainty


class ContactPart(NamedTuple):
    """A step of contact, by the law or not, of the cycles `rows` (k,): from the phases `begin` (k,)
    over a `length` (k,), from a wear `start` (k,), mm, with the increment since, `inside` (m, k),
    at the nodes; contact may have `ended` (k,) with it."""

    by_law: bool
    rows: IntArray
    begin: FloatArray
    length: FloatArray
    start: FloatArray
    inside: FloatArray
    ended: BoolArray


class ContactResult(NamedTuple):
    """The wear `added` (k,) by contact over a `length` (k,), mm, with its estimated `error` (k,),
    mm; whether the solution is `sound` (k,); the number of right-hand sides evaluated; the `parts`
    in order; and the rows `slid`, in which the solids slide along the edge of contact at the
    end."""

    added: FloatArray
    error: FloatArray
    length: FloatArray
    sound: BoolArray
    evaluations: int
    parts: tuple[ContactPart, ...] = ()
    slid: IntArray = np.empty(0, dtype=np.intp)

    def where_sound(self) -> ContactResult:
        """Return the wears whose solution is sound, without parts."""
        added, error, length = (array[self.sound] for array in self[:3])
        return ContactResult(added, error, length, self.sound[self.sound], self.evaluations)

    def among(self, rows: IntArray, number: int) -> ContactResult:
        """Return the result for so many wears, of which those in `rows` were in contact."""
        if len(rows) == number:
            return self
        added, error, length = np.zeros((3, number))
        added[rows], error[rows], length[rows] = self.added, self.error, self.length
        sound = np.full(number, True)
        sound[rows] = self.sound
        parts = tuple(part._replace(rows=rows[part.rows]) for part in self.parts)
        slid = rows[self.slid]
        return ContactResult(added, error, length, sound, self.evaluations, parts, slid)


def wear_in_contact(
    contact: ContactMode,
    rule: Gauss,
    tolerance: float,
    u: FloatArray,
    over: PhaseInterval,
    before: FloatArray,
) -> ContactResult:
    """Return the wear added in contact from each wear u (k,), mm, over intervals of phase; the
    cycle has added `before` (k,) mm so far.

    An interval is taken in steps so long that the rate is resolved to `tolerance`, relative to the
    increment of the cycle; all wears take a step at once, each of its own length.
    """
    (added, error, length), step = np.zeros((3, len(u))), over.whole.copy()
    going, sound = np.full((2, len(u)), True)
    evaluations, parts = 0, list[ContactPart]()
    rows = np.arange(len(u))
    while len(rows):
        remaining = over.whole[rows] - length[rows]
        steps = np.ceil(remaining / step[rows])
        whole = remaining / steps
        expected = over.expected[rows] - length[rows]
        expected = np.minimum(np.where(expected > 0.0, expected, LEAST * whole), whole)
        interval = PhaseInterval((over.begin + length)[rows], whole, expected)
        start, earlier = (u + added)[rows], (before + added)[rows]
        part = _step(contact.take(going), rule, tolerance, start, interval)
        evaluations += part.evaluations
        excess = _step_error(rule, part, earlier) / tolerance
        given_up = (whole <= SHORTEST * over.whole[rows]) | (len(parts) >= MOST_PARTS)
        sound[rows] &= ~given_up | (excess <= 1.0)
        fine = given_up | (excess <= 1.0)
        change = CAUTION * np.maximum(excess, TINY) ** (-0.5 / len(rule.nodes))
        step[rows] = whole * np.clip(change, SHRINK, GROW)
        some, ended = rows[fine], (part.length < whole)[fine]
        parts.append(
            ContactPart(
                contact.by_law,
                some,
                interval.begin[fine],
                part.length[fine],
                start[fine],
                part.inside[:, fine],
                ended,
            )
        )
        added[some] += np.maximum(part.added[fine], 0.0)  # rounding may be negative
        by_now = np.maximum(earlier + part.added, 0.0)
        iteration_error = part.iteration_error * np.abs(part.added)
        error[some] += (excess * tolerance * by_now + iteration_error)[fine]
        length[some] += part.length[fine]
        # Steps that are no longer resolved would only shrink: there the interval ends.
        going[some] = (steps[fine] > 1.0) & ~ended & sound[some]
        rows = np.flatnonzero(going)
    error[~sound] = np.inf
    return ContactResult(added, error, length, sound, evaluations, tuple(parts))


class _ContactStep(NamedTuple):
    """A step of contact: the wear `added` (k,), mm, over a `length` (k,); at the nodes (m, k) the
    increment since the start, `inside`, and the `rate`, mm per cycle; the rounding error of the
    rate, `noise` (k,); the `stiffness` (k,): the length times the largest slope of the rate; the
    relative `iteration_error` (k,) of the increment, and whether the iteration converged, `sound`
    (k,); the number of right-hand sides evaluated."""

    added: FloatArray
    length: FloatArray
    inside: FloatArray
    rate: FloatArray
    noise: FloatArray
    stiffness: FloatArray
    iteration_error: FloatArray
    sound: BoolArray
    evaluations: int


def _step_error(rule: Gauss, part: _ContactStep, before: FloatArray) -> FloatArray:
    """Return the truncation error of each step (k,), relative to the increment of the cycle up to
    its end, of which `before` (k,) mm came before the step.

    Gauss quadrature with m nodes neglects the coefficients from 2 m on, which are extrapolated from
    the decay between m/2 and m. Where the wear follows the load within less than the distance of
    two nodes, it neglects those from m on, over that time.
    """
    series = np.abs(rule.coefficients @ part.rate)
    half = len(series) // 2
    middle, tail = (np.max(series[k - 3 : k], axis=0) for k in (half, 2 * half))
    gain = np.minimum(tail / (middle + TINY), 1.0) ** NEARLY_AS_FAST
    follows = part.stiffness > half
    gain[follows] = np.maximum(gain, 1.0 / part.stiffness)[follows]
    neglected = tail * gain * part.length
    allowed = part.noise / np.maximum(1.0, part.stiffness / len(series) ** 2)
    neglected[tail < 100 * allowed] = 0.0
    error = neglected / (np.maximum(before + part.added, 0.0) + TINY)
    return np.where(part.sound & ~np.isnan(error), error, np.inf)


def _step(
    contact: ContactMode, rule: Gauss, tolerance: float, u: FloatArray, over: PhaseInterval
) -> _ContactStep:
    """Take a step by Newton's method, until another iteration would change the wear by a small part
    of the `tolerance`. Where contact ends at a level, its end is found along with the wear, by
    tangents: Radau's last node is the end."""
    settled = max(ROUNDOFF, SETTLED * tolerance)
    length = np.where(contact.direction == 0.0, over.whole, over.expected)
    ends, nodes = (contact.direction != 0.0).any(), rule.nodes[:, None]
    inside = np.zeros((len(nodes), len(u)))
    (last, error), evaluations = np.ones((2, len(u))), 0
    done, diverged = np.full((2, len(u)), False)
    steepness = contact.steepness(u, over.begin)
    U_a = contact.cycles.load(over.begin + length * nodes)
    for iteration in range(MOST_ITERATIONS):
        rate, slope = contact.rate_per_cycle(u + inside, U_a)
        evaluations += rate.size
        residual = length * (rule.integrate @ rate) - inside
        step = np.where(done, 0.0, _newton(rule, length * slope, residual))
        rate, inside = rate + slope * step, inside + step
        added = length * (rule.weights @ rate)
        correction = np.abs(step).max(axis=0) / (np.abs(added) + TINY)
        noise = contact.noise(u + inside, U_a, rate, steepness)
        stiffness = length * np.abs(slope).max(axis=0)
        allowed = NOISE / ROUNDOFF * noise * length / np.maximum(1.0, stiffness)
        allowed /= np.abs(added) + TINY
        if ends:
            change, uncertainty = contact.to_its_end(
                u + added, U_a[-1], over.begin + length, rate[-1]
            )
            change = np.minimum(np.maximum(length + change, LEAST * length), over.whole) - length
            change = np.where(done, 0.0, change)
            correction = np.maximum(correction, np.abs(change) / length)
            inside = inside + rate * nodes * change
            added, length = added + rate[-1] * change, length + change
            allowed += np.where(length < over.whole, uncertainty / length, 0.0)
        grows = correction > last
        diverged |= ~(correction < DIVERGED) | (grows & ~done & (iteration > PATIENCE))
        # A change that was large predicts nothing; one that is small and grows is rounding.
        predicted = correction * np.minimum(1.0, correction / np.minimum(last, 1.0))
        error = np.where(done, error, predicted)
        done |= (error <= settled) | (correction <= allowed)
        done |= (last < STALLED) & (correction >= last)
        if (done | diverged).all():
            break
        last = correction
        if ends:
            U_a = contact.cycles.load(over.begin + length * nodes)
    return _ContactStep(added, length, inside, rate, noise, stiffness, error, done, evaluations)


def _newton(rule: Gauss, slope: FloatArray, residual: FloatArray) -> FloatArray:
    """Return the solution x (m, k) of x = residual + the integral of slope x.

    Where little decays it is residual + E times the integral of slope residual/E, with
    E = exp(integral of slope), but for a truncation error that the next iteration removes.
    """
    decay = rule.integrate @ slope
    stiff = ~(np.abs(decay).max(axis=0) < STIFF)
    factor = np.exp(np.where(stiff, 0.0, decay) if stiff.any() else decay)
    x = residual + factor * (rule.integrate @ (slope * residual / factor))
    if stiff.any():
        matrix = np.eye(len(rule.nodes)) - rule.integrate * slope.T[stiff][:, None, :]
        x[:, stiff] = np.linalg.solve(matrix, residual.T[stiff][..., None])[..., 0].T
    return np.asarray(x)
