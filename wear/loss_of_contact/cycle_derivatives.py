"""Derivatives of a cycle with loss of contact, with respect to its initial wear and to parameters.

Within contact the wear rate is smooth, and the linearised equation is solved by weights, the same
for all parameters. On a rigid support the rate jumps where contact begins and ends: the phases of
these jumps change with the parameter, and with them the wear, by the rate times that change. While
the solids slide along the edge the wear is a function of the load alone. Where contact grazes a
turning point of the load the derivatives are those from one side. Along a series of increments the
derivatives are a series, too.

References
    M. di Bernardo, C. J. Budd, A. R. Champneys, P. Kowalczyk, *Piecewise-smooth Dynamical Systems*,
    Springer 2008, 2.5 (saltation matrices).
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import NamedTuple

import numpy as np

from wear.loss_of_contact.arrest import RESOLVABLE
from wear.loss_of_contact.contact import ContactPart
from wear.loss_of_contact.edge import turning_points
from wear.loss_of_contact.increments import Coordinate, IncrementSeries, increments, located
from wear.loss_of_contact.period_map import AT_ONCE, SwitchedPeriodMap, margin_roundoff
from wear.numerics.chebyshev import chebyshev_analysis, chebyshev_nodes, chebyshev_values
from wear.numerics.floating_point import ROUNDOFF
from wear.numerics.gauss import BoolArray, FloatArray, Gauss
from wear.orbit.panels import CHECKS, near_checks
from wear.parameters import Gradient, ParametrisedEquation

MORE = 4  # nodes than the derivative of the series has coefficients
NEGLIGIBLE = 1e-12  # coefficient of the derivative of the logarithm of the increments
SAME = 4 * ROUNDOFF  # phase
STIFF = 10.0  # decay over a part, as an exponent: then a system of equations is solved


class CycleDerivatives(NamedTuple):
    """Cycles from some initial wears (k,): the `increment` (k,), mm, and its derivatives `tangent`
    (k, 1 + parameters), with their `error`: with respect to the initial wear, and to parameters at
    a fixed distance of that wear from an `origin`, which has the derivatives (k, parameters).

    Derivatives are those of the increment, not of the wear: near a limit wear they are small, and
    would be lost in a difference to 1.
    """

    increment: FloatArray
    tangent: FloatArray
    origin: FloatArray
    error: FloatArray

    def along(self, origin: FloatArray | float) -> tuple[FloatArray, FloatArray]:
        """Return the derivatives (k, 1 + parameters) if the wear moves with another origin, by its
        derivatives (parameters,), and their error."""
        difference = origin - self.origin
        tangent, error = self.tangent.copy(), self.error.copy()
        tangent[:, 1:] += difference * tangent[:, :1]
        error[:, 1:] += np.abs(difference) * error[:, :1]
        return tangent, error


class Response(NamedTuple):
    """Relative derivatives of the increments along a `series` of them: with respect to the
    logarithm of the distance to the origin of its coordinate, and to parameters at a fixed
    distance. Chebyshev `coefficients` (p, m, 1 + parameters) on the panels of the series, and their
    `misfit` (p, checks, 1 + parameters); and the derivatives (parameters,) of the `origin`."""

    series: IncrementSeries
    coefficients: FloatArray
    misfit: FloatArray
    origin: FloatArray

    @classmethod
    def of(
        cls,
        series: IncrementSeries,
        origin: FloatArray,
        wear: FloatArray,
        run: CycleDerivatives,
    ) -> Response:
        """Return the response along a series by the cycles from the wears `sample_wears` of it."""
        distance = _distance(series.coordinate, wear)
        relative = run.along(origin)[0] / run.increment[:, None]
        relative[:, 0] *= distance
        relative = relative.reshape(len(series.level), -1, relative.shape[1])
        nodes, checks = np.split(relative, [-len(CHECKS)], axis=1)
        coefficients = chebyshev_analysis(nodes.shape[1]) @ nodes
        misfit = np.abs(chebyshev_values(CHECKS, nodes.shape[1]) @ coefficients - checks)
        return cls(series, coefficients, misfit, origin)

    def map_derivatives(self, wear: FloatArray) -> CycleDerivatives:
        """Return the derivatives of the cycles from each wear (k,), mm."""
        which, z = np.zeros(len(wear), dtype=int), self.series.coordinate.at(wear)
        panel, t, _ = located([self.series], which, z)
        basis = chebyshev_values(t, self.coefficients.shape[1])[:, None]
        increment = increments([self.series], which, z)
        scale = increment[:, None] * np.ones(1 + len(self.origin))
        scale[:, 0] /= _distance(self.series.coordinate, wear)
        tangent = scale * (basis @ self.coefficients[panel])[:, 0]
        error = np.abs(scale) * near_checks(self.misfit[panel], t[:, None])[:, 0]
        origin = np.tile(self.origin, (len(wear), 1))
        return CycleDerivatives(increment, tangent, origin, error)


def _distance(coordinate: Coordinate, wear: FloatArray) -> FloatArray:
    """Return the distance (mm) of each wear from the origin of a coordinate, plus its shift."""
    return np.asarray(wear - coordinate.origin + coordinate.shift)


def sample_wears(series: IncrementSeries) -> FloatArray:
    """Return the wears (mm) at which the response along a series is sampled: as many nodes of each
    panel as the derivative of the series needs, and the CHECKS, no nearer to a limit wear than
    rounding permits. There are none if the series is too short for its derivative."""
    order = np.arange(series.series.shape[1])
    needed = np.flatnonzero((np.abs(series.series) * order > NEGLIGIBLE).any(axis=0))
    number = int(needed.max(initial=0)) + MORE
    if number > len(order):
        return np.empty(0)
    t, domain = np.append(chebyshev_nodes(number), CHECKS), series.domain
    wear = domain.wear(series.grid.states(t)).ravel()
    nearest = RESOLVABLE * domain.uncertainty
    return np.minimum(wear, domain.coordinate.origin - nearest) if domain.tends else wear


def derivatives_of_origins(
    equation: ParametrisedEquation, coordinates: Sequence[Coordinate]
) -> FloatArray:
    """Return the derivatives (k, parameters) of the grazing wears that are the origins of k
    coordinates; zero where there is none."""
    if not coordinates:
        return np.zeros((0, equation.parameters))
    origin, shift = np.array([(each.origin, each.shift) for each in coordinates]).T
    derivatives = derivatives_of_grazing_wears(equation, origin)
    return np.where((shift == 0.0)[:, None] & np.isfinite(derivatives), derivatives, 0.0)


def derivatives_of_grazing_wears(equation: ParametrisedEquation, wear: FloatArray) -> FloatArray:
    """Return the derivatives (k, parameters) of the grazing wears next to each `wear` (k,), mm, at
    which a turning point of the load just fails to make contact."""
    (load,) = equation.loads
    turns = turning_points(load)
    margin = equation.model.margin(wear[:, None], load(turns))
    slope, change = _margin(equation, wear, turns[np.argmin(np.abs(margin), axis=1)])
    return np.asarray(-change[:, 1:] / slope[:, None])


def map_derivatives(
    cycle: SwitchedPeriodMap, equation: ParametrisedEquation, starts: FloatArray
) -> CycleDerivatives:
    """Return the derivatives of one cycle from each start (k,), mm."""
    tangent = np.zeros((len(starts), 1 + equation.parameters))
    added, (load,) = np.zeros(len(starts)), equation.loads
    # A cycle may begin in contact; one that makes it at once makes it later if worn a little more.
    margin = equation.model.margin(starts, load(0.0 * starts))
    lasted = np.where(margin > margin_roundoff(equation.model, load.maximum, starts), 0.0, -1.0)
    few = AT_ONCE // len(cycle.rule.nodes)
    for at in range(0, len(starts), few):
        rows = slice(at, at + few)
        own, wear, until = tangent[rows], starts[rows], lasted[rows]
        for piece, run in cycle.pieces_from(wear, np.zeros(len(wear), dtype=int)):
            _through(cycle, equation, run.parts, own, until)
            added[rows] += run.added
            if len(slid := run.slid):
                slope, change = _margin(equation, (wear + added[rows])[slid], piece.end[slid])
                own[slid], until[slid] = -change / slope[:, None], piece.end[slid]
    return CycleDerivatives(added, tangent, np.zeros_like(tangent[:, 1:]), np.zeros_like(tangent))


def _through(
    cycle: SwitchedPeriodMap,
    equation: ParametrisedEquation,
    parts: tuple[ContactPart, ...],
    tangent: FloatArray,
    lasted: FloatArray,
) -> None:
    """Propagate the `tangent` (k, 1 + parameters) of the increment through parts of contact, and
    the phase up to which contact has `lasted` (k,), both in place."""
    rigid = not equation.model.compliant
    for part in (part for part in parts if len(part.rows)):
        rows, last, end = part.rows, part.start + part.inside[-1], part.begin + part.length
        opens = rigid & (part.begin > lasted[rows] + SAME)
        ends = rigid & part.ended
        tangent[rows] += _jump(equation, part.start, part.begin, tangent[rows], opens, False)
        tangent[rows] = _smooth(cycle, equation, part, tangent[rows])
        tangent[rows] -= _jump(equation, last, end, tangent[rows], ends, True)
        lasted[rows] = np.where(part.ended, 0.0, end)


def _smooth(
    cycle: SwitchedPeriodMap, equation: ParametrisedEquation, part: ContactPart, tangent: FloatArray
) -> FloatArray:
    """Return the tangent (k, 1 + parameters) at the end of a part."""
    (load,), model = equation.loads, equation.model
    phases = part.begin[:, None] + part.length[:, None] * cycle.rule.nodes
    u, U_a = part.start[:, None] + part.inside.T, load(phases)
    rates = model.law_rate_and_slope if part.by_law else model.edge_rate_and_slope
    gradient = model.rate_gradient if part.by_law else model.edge_rate_gradient
    slope = load.period * rates(u, U_a)[1]
    multiplier, weights = _weights(cycle.rule, part.length[:, None], slope)
    by_parameters = _along(equation, gradient, u, phases, U_a, load.period * weights)
    by_wear = np.sum(weights * slope, axis=1, keepdims=True)
    return np.asarray(multiplier[:, None] * tangent + np.column_stack([by_wear, by_parameters]))


def _weights(rule: Gauss, length: FloatArray, slope: FloatArray) -> tuple[FloatArray, FloatArray]:
    """Return the solution of x' = slope x + change at the end of a `length` (k, 1), whose `slope`
    (k, m) is known at the nodes: the multiplier (k,) of the initial x, and the weights (k, m) of
    the changes.

    These follow from the exponential of the integral of the slope up to the end; where that decays
    fast, from the transposed equations of the collocation. Radau's last node is the end.
    """
    decay = length * slope @ rule.integrate.T
    ahead = decay[:, -1:] - decay
    weights, multiplier = length * rule.weights * np.exp(ahead), np.exp(decay[:, -1])
    stiff = ~(np.max(np.abs(decay), axis=1) < STIFF)
    if stiff.any():
        transposed = np.eye(len(rule.nodes)) - (length * slope)[stiff, :, None] * rule.integrate.T
        last = np.eye(len(rule.nodes))[:, -1:]
        adjoint = np.linalg.solve(transposed, last[None])[..., 0]
        weights[stiff] = length[stiff] * (adjoint @ rule.integrate)
        multiplier[stiff] = np.sum(adjoint, axis=1)
    return multiplier, weights


def _jump(
    equation: ParametrisedEquation,
    u: FloatArray,
    phase: FloatArray,
    tangent: FloatArray,
    which: BoolArray,
    closed: bool,
) -> FloatArray:
    """Return the wear rate times the advance of the phase at which contact begins, or, if it was
    `closed`, ends: (k, 1 + parameters); zero except in the rows `which` (k,)."""
    jump = np.zeros_like(tangent)
    if which.any():
        (load,), model = equation.loads, equation.model
        u, phase = u[which], phase[which]
        slope, change = _margin(equation, u, phase)
        rate = load.period * model.law_rate(u, load(phase))
        speed = load.slope(phase) + (slope * rate if closed else 0.0)  # of the margin
        jump[which] = (rate / speed)[:, None] * (slope[:, None] * tangent[which] + change)
    return jump


def _margin(
    equation: ParametrisedEquation, u: FloatArray, phase: FloatArray
) -> tuple[FloatArray, FloatArray]:
    """Return the derivative (k,) of the margin of contact with respect to the wear, and those
    (k, 1 + parameters) with respect to the wear and to parameters, at the same phase."""
    (load,), model = equation.loads, equation.model
    U_a, at = load(phase), phase[:, None]
    one = np.ones(at.shape)
    by_parameters = _along(equation, model.margin_gradient, u[:, None], at, U_a[:, None], one)
    slope = model.margin_slope(u, U_a)
    return slope, np.column_stack([slope, by_parameters])


def _along(equation: ParametrisedEquation, gradient: Gradient, *each: FloatArray) -> FloatArray:
    """Return the sums (k, parameters) of derivatives over nodes (k, m), see
    `ParametrisedEquation.along`."""
    return equation.along(gradient, *(values[:, None, None] for values in each))[:, 0]
