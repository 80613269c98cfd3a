"""Derivatives of the wear with respect to parameters, where contact is lost.

Within contact the wear rate is smooth, and the linearised equation is solved by weights, the same
for all parameters. On a rigid support the rate jumps where contact begins and ends: the phases of
these jumps change with the parameter, and with them the wear, by the rate times that change. While
the solids slide along the edge the wear is a function of the load alone. Where contact grazes a
turning point of the load the derivatives are those from one side.

References
    M. di Bernardo, C. J. Budd, A. R. Champneys, P. Kowalczyk, *Piecewise-smooth Dynamical Systems*,
    Springer 2008, 2.5 (saltation matrices).
"""

from __future__ import annotations

from collections.abc import Sequence
from itertools import pairwise
from typing import NamedTuple

import numpy as np

from wear.loss_of_contact.arrest import RESOLVABLE, TabulatedIterates
from wear.loss_of_contact.contact import ContactPart
from wear.loss_of_contact.edge import turning_points
from wear.loss_of_contact.increments import Coordinate, IncrementSeries, increments, located, step
from wear.loss_of_contact.period_map import AT_ONCE, SwitchedPeriodMap, switched_period_map
from wear.loss_of_contact.switching import Edge
from wear.numerics.chebyshev import chebyshev_analysis, chebyshev_nodes, chebyshev_values
from wear.numerics.gauss import BoolArray, FloatArray, Gauss, IntArray
from wear.numerics.rows import stacked, take
from wear.numerics.tolerances import ROUNDOFF
from wear.orbit import abel
from wear.orbit.iterates import Iterates
from wear.orbit.panels import CHECKS, near_checks
from wear.orbit.period_map import settings
from wear.orbit.segments import AnyIterates
from wear.orbit.tangent import Tangents, after_on_cells, sums_on_cells
from wear.orbit.transient import SAFETY
from wear.parameters import Gradient, ParametrisedEquation
from wear.scene_orbit import SceneOrbit

LIMIT_DIGITS = 1e12  # of the derivative of a limit wear, which follows from the margin alone
MORE = 4  # nodes than the derivative of the series has coefficients
NEGLIGIBLE = 1e-12  # coefficient of the derivative of the logarithm of the increments
SAME = 4 * ROUNDOFF  # phase
SMOOTH = 1e-3  # share of an increment in its second difference, at most
STIFF = 10.0  # decay over a part, as an exponent: then a system of equations is solved


@np.errstate(all="ignore")
def stage_tangents(
    found: SceneOrbit,
    equation: ParametrisedEquation,
    edge: Edge,
    cycles: FloatArray,
    rtol: float,
    start: FloatArray,
    start_error: FloatArray,
) -> Tangents:
    """Return the derivatives of the wear of one scene after `cycles` (1, n) on its orbit `found`,
    counted to `rtol`; the first wear has the derivative `start` (1, parameters), known up to
    `start_error`.

    The cycles of all segments are linearised at once; where many of them lie along a series of
    increments, their derivatives are a series, too.
    """
    size, scene = settings(rtol), ([equation.model], equation.loads, [edge])
    cycle = switched_period_map(*scene, size.finer_nodes, size.endpoint_tolerance)
    runs = _of_each(cycle, equation, [segment.iterates for segment in found.orbit.segments])
    u, error = (values[None] for values in found.after(cycles[0]))
    derivative, derivative_error = np.full((2, 1, equation.parameters, cycles.shape[1]), np.nan)
    increment = np.zeros(cycles.shape)
    now, now_error = start[0], start_error[0]
    for segment, run in zip(found.orbit.segments, runs, strict=True):
        begins, iterates = segment.begins, segment.iterates
        here = cycles[0] >= begins
        last = iterates.whole_cycles
        wanted = np.append(np.minimum(cycles[0, here] - begins, last), last)
        if isinstance(iterates, Iterates):
            part = _one_by_one(iterates, run, wanted, now, now_error)
        elif isinstance(iterates, TabulatedIterates):
            limit = _beside(equation, iterates.coordinate)
            part = _tabulated(iterates, run, limit, wanted, now, now_error)
        elif iterates.at_rest[0]:
            limit = np.tile(_of_grazing(equation, found.last_wear), (len(wanted), 1))
            part = _StageTangents(limit, np.abs(limit) / LIMIT_DIGITS, np.zeros_like(wanted))
        else:  # an unresolved segment: no cycle of it is known
            unknown = np.full((len(wanted), equation.parameters), np.inf)
            part = _StageTangents(unknown, unknown, np.zeros_like(wanted))
        derivative[0, :, here], derivative_error[0, :, here] = part.derivative[:-1], part.error[:-1]
        increment[0, here] = part.increment[:-1]
        now, now_error = part.derivative[-1], part.error[-1]
    # Errors by rounding and by the mesh of phase are relatively as large as those of the wear.
    derivative_error += error[:, None] * np.abs(derivative)
    derivative_error = np.where(np.isfinite(derivative_error), derivative_error, np.inf)
    return Tangents(u, error, derivative, derivative_error, increment)


class CycleDerivatives(NamedTuple):
    """Cycles from some starts (k,): the `increment` (k,), mm, and `tangent` (k, 1 + parameters),
    its derivatives with respect to the wear before the cycle, and to parameters if that wear moves
    with an `origin`, by its derivatives (k, parameters); and the `error` of the `tangent`.

    Near a limit wear that of the increment is small: from the derivative of the wear, one more, it
    would be lost to cancellation.
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
        equation: ParametrisedEquation,
        series: IncrementSeries,
        wear: FloatArray,
        run: CycleDerivatives,
    ) -> Response:
        """Return the response along a series by the cycles from the wears `_sampled` of it."""
        origin = _beside(equation, series.coordinate)
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
        of, z = np.zeros(len(wear), dtype=int), self.series.coordinate.at(wear)
        panel, t, _ = located([self.series], of, z)
        basis = chebyshev_values(t, self.coefficients.shape[1])[:, None]
        increment = increments([self.series], of, z)
        each = increment[:, None] * np.ones(1 + len(self.origin))
        each[:, 0] /= _distance(self.series.coordinate, wear)
        tangent = each * (basis @ self.coefficients[panel])[:, 0]
        error = np.abs(each) * near_checks(self.misfit[panel], t[:, None])[:, 0]
        origin = np.tile(self.origin, (len(wear), 1))
        return CycleDerivatives(increment, tangent, origin, error)


def _distance(coordinate: Coordinate, wear: FloatArray) -> FloatArray:
    """Return how far (mm) each wear is beyond the origin of a coordinate, and its shift."""
    return np.asarray(wear - coordinate.origin + coordinate.shift)


def _sampled(series: IncrementSeries) -> FloatArray:
    """Return the wears (mm) at which the response along a series is sampled: as many nodes of each
    panel as the derivative of the series needs, and the CHECKS, no nearer to a limit wear than
    rounding permits. There are none if the series is too short for its derivative."""
    order = np.arange(series.series.shape[1])
    needed = np.flatnonzero((np.abs(series.series) * order > NEGLIGIBLE).any(axis=0))
    number = int(needed.max(initial=0)) + MORE
    if number > len(order):
        return np.empty(0)
    t, domain = np.append(chebyshev_nodes(number), CHECKS), series.domain
    wear = domain.wear(series.frame.states(t)).ravel()
    nearest = RESOLVABLE * domain.uncertainty
    return np.minimum(wear, domain.coordinate.origin - nearest) if domain.tends else wear


class _StageTangents(NamedTuple):
    """The `derivative` (n, parameters) after some cycles of a stage, its `error`, and the
    `increment` (n,) of the last cycle."""

    derivative: FloatArray
    error: FloatArray
    increment: FloatArray


def _starts(iterates: AnyIterates) -> FloatArray:
    """Return the wears (mm) from which cycles of a segment are linearised: those of single cycles,
    some of them also moved by their error; the nodes and the CHECKS of panels."""
    if isinstance(iterates, Iterates):
        wear, beside = iterates.transient[0], iterates.transient[0] + iterates.transient_error[0]
        return np.concatenate([wear[:-1], beside[_rough(iterates)]])
    if isinstance(iterates, TabulatedIterates):
        return iterates.coordinate.wear(_resolved(iterates, _positions(iterates))).ravel()
    return np.empty(0)


def _rough(iterates: Iterates) -> IntArray:
    """Return the single cycles whose increments change abruptly, as next to a grazing wear: there
    the derivatives are sensitive to errors of the wear."""
    added = np.diff(iterates.transient[0])
    bend = np.abs(added[2:] - 2 * added[1:-1] + added[:-2])
    rough = np.full(len(added), True)
    rough[1:-1] = ~(bend <= SMOOTH * added[1:-1])
    return np.flatnonzero(rough)


def _positions(iterates: TabulatedIterates) -> FloatArray:
    """Return the nodes of panels, and then the CHECKS."""
    return np.append(chebyshev_nodes(iterates.panels.series.shape[1]), CHECKS)


def _resolved(iterates: TabulatedIterates, t: FloatArray) -> FloatArray:
    """Return z (panels, n) at the positions `t` (n,) of panels, no nearer to the limit wear than
    rounding permits."""
    z = iterates.panels.frame.states(t)
    limit_wear = iterates.limit_wear
    return z if limit_wear is None else np.minimum(z, 1.0 / limit_wear.nearest)


def _one_by_one(
    iterates: Iterates,
    run: CycleDerivatives,
    cycles: FloatArray,
    start: FloatArray,
    start_error: FloatArray,
) -> _StageTangents:
    """Return the derivatives after some of the single cycles (n,)."""
    values, errors = [start], [start_error]
    derivatives, derivatives_error = run.along(0.0)
    tangents, beside = np.split(derivatives, [iterates.integrated_cycles])
    difference, rough = derivatives_error[: len(tangents)], _rough(iterates)
    difference[rough] += np.abs(tangents[rough] - beside)
    for tangent, local_error in zip(tangents, difference, strict=True):
        multiplier, by_parameters = 1.0 + tangent[0], tangent[1:]
        by_start = multiplier * values[-1]
        local = local_error[0] * np.abs(values[-1]) + local_error[1:]
        error = np.abs(multiplier) * errors[-1] + SAFETY * local
        rounding = ROUNDOFF * (np.abs(by_start) + np.abs(by_parameters))
        values.append(by_start + by_parameters)
        errors.append(error + SAFETY * rounding)
    index = cycles.astype(int)
    added = np.concatenate([[0.0], np.diff(iterates.transient[0])])
    return _StageTangents(np.array(values)[index], np.array(errors)[index], added[index])


def _tabulated(
    iterates: TabulatedIterates,
    run: CycleDerivatives,
    limit: FloatArray,
    cycles: FloatArray,
    start: FloatArray,
    start_error: FloatArray,
) -> _StageTangents:
    """Return the derivatives after `cycles` (n,) in a table between two grazing wears.

    The sums are those of the difference to `limit` (parameters,), the derivative of the grazing
    wear: that is smooth in the distance. At a limit wear the last cycles hardly change it.
    """
    count, z = iterates.in_z, iterates.coordinate
    added = _added(iterates, run, limit)
    nodes, checks = (
        abel.SumIncrements(*(x[:, some] for x in added))
        for some in (slice(None, -len(CHECKS)), slice(-len(CHECKS), None))
    )
    into_z = 1.0 / z.rate(iterates.table.u[:1], np.ones(1))
    sums = sums_on_cells(
        count, nodes, checks, (into_z * (start - limit))[None], (into_z * start_error)[None]
    )
    wanted = np.minimum(cycles, iterates.reach)
    at, _ = count.after(wanted[None])
    by_z, error_of_z, rate = (part[0] for part in after_on_cells(count, sums, wanted[None], at))
    pace = z.rate(at[0], np.ones(1))[:, None]
    rounding = SAFETY * ROUNDOFF * np.abs(limit)
    derivative, error = limit + pace * by_z, pace * error_of_z + rounding
    return _StageTangents(derivative, error, pace[:, 0] * rate)


def _added(
    iterates: TabulatedIterates, run: CycleDerivatives, limit: FloatArray
) -> tuple[FloatArray, ...]:
    """Return the increments of z, and of dz/dp - its value for du/dp = `limit`, for cycles from the
    nodes and the CHECKS of each panel, with the derivative of their map and the error, as of
    `SumIncrements`; `limit` is (parameters,)."""
    panels, coordinate, t = iterates.panels, iterates.coordinate, _positions(iterates)
    z, at = panels.frame.states(t), _resolved(iterates, t)
    near = np.where(at < z, at / z, 1.0)  # nearer the difference shrinks with the distance
    increment = step(coordinate.ahead, at, run.increment.reshape(z.shape)) / near
    one, after = np.ones(1), coordinate.rate(z + increment, np.ones(1))
    into_z = (near / after)[..., None]
    multiplier = (1.0 + run.tangent[:, 0].reshape(z.shape)) * coordinate.rate(z, one) / after
    change, error = (x[:, 1:].reshape(*z.shape, -1) for x in run.along(limit))
    return increment, into_z * change, multiplier, SAFETY * into_z * error


def _beside(equation: ParametrisedEquation, coordinate: Coordinate) -> FloatArray:
    """Return the derivatives (parameters,) of the grazing wear that is the origin of a coordinate;
    zero if there is none."""
    origin, _, shift = coordinate
    found = _of_grazing(equation, origin) if shift == 0.0 else np.zeros(equation.parameters)
    return np.where(np.isfinite(found), found, 0.0)


def _of_grazing(equation: ParametrisedEquation, wear: float) -> FloatArray:
    """Return the derivatives (parameters,) of the grazing wear next to `wear` (mm), at which a
    turning point of the load just fails to make contact."""
    (load,) = equation.loads
    turns = turning_points(load)
    nearest = np.argmin(np.abs(equation.model.margin(np.array([wear]), load(turns))))
    slope, change = _margin(equation, np.array([wear]), turns[[nearest]])
    return np.asarray(-change[0, 1:] / slope[0])


def _of_each(
    cycle: SwitchedPeriodMap, equation: ParametrisedEquation, segments: Sequence[AnyIterates]
) -> list[CycleDerivatives]:
    """Return the derivatives of the cycles that each segment needs, all of them at once: by the
    response along a series of increments where that takes fewer cycles."""
    starts = [_starts(iterates) for iterates in segments]
    wear = np.concatenate(starts)
    alone = np.full(len(wear), True)
    sampled: list[tuple[IncrementSeries, FloatArray, BoolArray]] = []
    tables = [iterates for iterates in segments if isinstance(iterates, TabulatedIterates)]
    for series in {id(table.series): table.series for table in tables}.values():
        along = alone & (series.domain.start <= wear) & (wear < series.domain.end)
        if np.count_nonzero(along) > len(own := _sampled(series)) > 0:
            sampled.append((series, own, along))
            alone &= ~along
    parts = [wear[alone], *(own for _, own, _ in sampled)]
    found = map_derivatives(cycle, equation, np.concatenate(parts))
    first, *others = _split(found, parts)
    runs, order = [first], [np.flatnonzero(alone)]
    for (series, own, along), run in zip(sampled, others, strict=True):
        runs.append(Response.of(equation, series, own, run).map_derivatives(wear[along]))
        order.append(np.flatnonzero(along))
    back = np.argsort(np.concatenate(order))
    return _split(take(stacked(runs), back), starts)


def _split(run: CycleDerivatives, starts: Sequence[FloatArray]) -> list[CycleDerivatives]:
    """Return the cycles from each of several `starts`, which follow each other."""
    ends = np.cumsum([0, *(len(each) for each in starts)]).tolist()
    return [take(run, slice(*pair)) for pair in pairwise(ends)]


def map_derivatives(
    cycle: SwitchedPeriodMap, equation: ParametrisedEquation, starts: FloatArray
) -> CycleDerivatives:
    """Return the derivatives of one cycle from each start (k,), mm."""
    tangent = np.zeros((len(starts), 1 + equation.parameters))
    added, lasted = np.zeros((2, len(starts)))  # a cycle may begin in contact
    few = AT_ONCE // len(cycle.rule.nodes)
    for at in range(0, len(starts), few):
        some = slice(at, at + few)
        own, wear, until = tangent[some], starts[some], lasted[some]
        for piece, run in cycle.pieces_from(wear, np.zeros(len(wear), dtype=int)):
            _through(cycle, equation, run.parts, own, until)
            added[some] += run.added
            if len(slid := run.slid):
                slope, change = _margin(equation, (wear + added[some])[slid], piece.end[slid])
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

    These are the exponential of the integral of the slope up to the end; where much decays they
    solve the transposed equations of the collocation. Radau's last node is the end.
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
    `closed`, ends: (k, 1 + parameters); zero but for `which` (k,)."""
    found = np.zeros_like(tangent)
    if which.any():
        (load,), model = equation.loads, equation.model
        u, phase = u[which], phase[which]
        slope, change = _margin(equation, u, phase)
        rate = load.period * model.law_rate(u, load(phase))
        pull = load.slope(phase) + (slope * rate if closed else 0.0)
        found[which] = (rate / pull)[:, None] * (slope[:, None] * tangent[which] + change)
    return found


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
