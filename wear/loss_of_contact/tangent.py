"""Derivatives of the wear with respect to parameters, where contact is lost.

Within a stretch of contact the wear rate is smooth, and the equation linearised there is solved by
weights: one set for all parameters. On a rigid support the rate jumps where contact begins and
ends: the phases at which it does so change with the parameter, and with them the wear, by the rate
times that change. While the solids slide along the edge the wear is a function of the load alone.
Where contact grazes a turning point of the load the derivatives are those from one side.

References
    M. di Bernardo, C. J. Budd, A. R. Champneys, P. Kowalczyk, *Piecewise-smooth Dynamical Systems*,
    Springer 2008, 2.5 (saltation matrices).
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from wear.counted import Counted
from wear.loss_of_contact.arrest import TabulatedCount
from wear.loss_of_contact.contact import ContactPart
from wear.loss_of_contact.increments import step
from wear.loss_of_contact.period_map import AT_ONCE, SwitchedPeriodMap, switched_period_map
from wear.loss_of_contact.switching import Edge, turning_points
from wear.numerics.chebyshev import chebyshev_nodes
from wear.numerics.gauss import BoolArray, FloatArray, Gauss, IntArray
from wear.numerics.tolerances import ROUNDOFF
from wear.orbit import abel
from wear.orbit.iterates import Iterates
from wear.orbit.panels import CHECKS
from wear.orbit.period_map import settings
from wear.orbit.segments import Counted as SegmentCount
from wear.orbit.tangent import Added, Tangents, after_on_cells, sums_on_cells
from wear.orbit.transient import SAFETY
from wear.parameters import Gradient, ParametrisedEquation

LEFT = 1e12  # digits of the derivative of a limit, which follows from the margin alone
SAME = 4 * ROUNDOFF  # phase
SMOOTH = 1e-3  # share of an increment in its second difference, at most
STIFF = 10.0  # decay over a part, as an exponent: then a system of equations is solved


@np.errstate(all="ignore")
def stage_tangents(
    found: Counted,
    equation: ParametrisedEquation,
    edge: Edge,
    cycles: FloatArray,
    rtol: float,
    start: FloatArray,
    start_error: FloatArray,
) -> Tangents:
    """Return the derivatives of the wear of one scene after `cycles` (1, n), as the count `found`
    has it to `rtol`, if the first wear has the derivative `start` (1, parameters), known up to
    `start_error`.

    The cycles of all segments are linearised at once.
    """
    size, scene = settings(rtol), ([equation.model], equation.loads, [edge])
    cycle = switched_period_map(*scene, size.finer_nodes, size.endpoint_tolerance)
    starts = [_starts(segment.counted) for segment in found.orbit.segments]
    runs = _of_each(cycle, equation, starts)
    u, error = (values[None] for values in found.after(cycles[0]))
    derivative, missed = np.full((2, 1, equation.parameters, cycles.shape[1]), np.nan)
    increment = np.zeros(cycles.shape)
    now, now_error = start[0], start_error[0]
    for segment, run in zip(found.orbit.segments, runs, strict=True):
        begins, counted = segment.begins, segment.counted
        here = cycles[0] >= begins
        last = counted.whole_cycles
        wanted = np.append(np.minimum(cycles[0, here] - begins, last), last)
        if isinstance(counted, Iterates):
            part = _one_by_one(counted, run, wanted, now, now_error)
        elif isinstance(counted, TabulatedCount):
            limit = _beside(equation, counted)
            part = _tabulated(counted, run, limit, wanted, now, now_error)
        elif counted.at_rest[0]:
            limit = np.tile(_of_grazing(equation, found.last_wear), (len(wanted), 1))
            part = _Part(limit, np.abs(limit) / LEFT, np.zeros_like(wanted))
        else:  # an unresolved segment: no cycle of it is known
            unknown = np.full((len(wanted), equation.parameters), np.inf)
            part = _Part(unknown, unknown, np.zeros_like(wanted))
        derivative[0, :, here], missed[0, :, here] = part.derivative[:-1], part.error[:-1]
        increment[0, here] = part.increment[:-1]
        now, now_error = part.derivative[-1], part.error[-1]
    # What rounding and the phase's nodes make of the wear they make of its derivatives.
    missed += error[:, None] * np.abs(derivative)
    missed = np.where(np.isfinite(missed), missed, np.inf)
    return Tangents(u, error, derivative, missed, increment)


class Linearised(NamedTuple):
    """Cycles from some starts (k,): the `increment` (k,), mm, and `tangent` (k, 1 + parameters),
    its derivatives with respect to the wear before the cycle, and to parameters.

    Near a limit wear that of the increment is small: from the derivative of the wear, one more, it
    would be lost to cancellation.
    """

    increment: FloatArray
    tangent: FloatArray


class _Part(NamedTuple):
    """The `derivative` (n, parameters) after some cycles of a stage, its `error`, and what the last
    cycle has added, `increment` (n,)."""

    derivative: FloatArray
    error: FloatArray
    increment: FloatArray


def _starts(counted: SegmentCount) -> FloatArray:
    """Return the wears (mm) from which cycles of a segment are linearised: those that were taken
    one by one, and beside some by their error; at the nodes and the CHECKS of panels."""
    if isinstance(counted, Iterates):
        wear, beside = counted.transient[0], counted.transient[0] + counted.transient_error[0]
        return np.concatenate([wear[:-1], beside[_rough(counted)]])
    if isinstance(counted, TabulatedCount):
        return counted.coordinate.wear(_resolved(counted, _positions(counted))).ravel()
    return np.empty(0)


def _rough(counted: Iterates) -> IntArray:
    """Return which of the cycles taken one by one change abruptly, as next to a grazing wear: there
    an error of the wear is a larger one of the derivatives."""
    added = np.diff(counted.transient[0])
    bend = np.abs(added[2:] - 2 * added[1:-1] + added[:-2])
    rough = np.full(len(added), True)
    rough[1:-1] = ~(bend <= SMOOTH * added[1:-1])
    return np.flatnonzero(rough)


def _positions(counted: TabulatedCount) -> FloatArray:
    """Return the nodes of panels, and then the CHECKS."""
    return np.append(chebyshev_nodes(counted.panels.series.shape[1]), CHECKS)


def _resolved(counted: TabulatedCount, t: FloatArray) -> FloatArray:
    """Return z (panels, n) at the positions `t` (n,) of panels, no nearer to the limit wear than
    rounding permits."""
    z = counted.panels.frame.states(t)
    limit_wear = counted.limit_wear
    return z if limit_wear is None else np.minimum(z, 1.0 / limit_wear.nearest)


def _one_by_one(
    counted: Iterates,
    run: Linearised,
    cycles: FloatArray,
    start: FloatArray,
    start_error: FloatArray,
) -> _Part:
    """Return the derivatives after `cycles` (n,) that were taken one by one."""
    values, errors = [start], [start_error]
    each, beside = np.split(run.tangent, [counted.integrated_cycles])
    off, rough = np.zeros_like(each), _rough(counted)
    off[rough] = np.abs(each[rough] - beside)
    for own, apart in zip(each, off, strict=True):
        multiplier = 1.0 + own[0]
        by_start = multiplier * values[-1]
        by_parameters = apart[0] * np.abs(values[-1]) + apart[1:]
        error = np.abs(multiplier) * errors[-1] + SAFETY * by_parameters
        rounding = ROUNDOFF * (np.abs(by_start) + np.abs(own[1:]))
        values.append(by_start + own[1:])
        errors.append(error + SAFETY * rounding)
    index = cycles.astype(int)
    added = np.concatenate([[0.0], np.diff(counted.transient[0])])
    return _Part(np.array(values)[index], np.array(errors)[index], added[index])


def _tabulated(
    counted: TabulatedCount,
    run: Linearised,
    limit: FloatArray,
    cycles: FloatArray,
    start: FloatArray,
    start_error: FloatArray,
) -> _Part:
    """Return the derivatives after `cycles` (n,) that were counted between two grazing wears.

    The sums are those of the difference to `limit` (parameters,), the derivative of the grazing
    wear: that is smooth in the distance. At a limit wear the last cycles hardly change it.
    """
    count, z = counted.in_z, counted.coordinate
    increment, to_sums = _added(counted, run, limit)
    nodes, checks = (
        Added(increment[:, some], to_sums[:, some])
        for some in (slice(None, -len(CHECKS)), slice(-len(CHECKS), None))
    )
    into_z = 1.0 / z.rate(counted.table.u[:1], np.ones(1))
    sums = sums_on_cells(
        count, nodes, checks, (into_z * (start - limit))[None], (into_z * start_error)[None]
    )
    wanted = np.minimum(cycles, counted.reach)
    by_z, missed, rate = (part[0] for part in after_on_cells(count, sums, wanted[None]))
    at, _ = count.after(wanted[None])
    pace = z.rate(at[0], np.ones(1))[:, None]
    derivative, error = limit + pace * by_z, pace * missed + SAFETY * ROUNDOFF * np.abs(limit)
    return _Part(derivative, error, pace[:, 0] * rate)


def _added(counted: TabulatedCount, run: Linearised, limit: FloatArray) -> Added:
    """Return what cycles from the nodes and the CHECKS of each panel add to z, and to the sum of
    (dn/dz) (dz/dp), less what it would be if du/dp were `limit` (parameters,) all along."""
    panels, coordinate, t = counted.panels, counted.coordinate, _positions(counted)
    z, at = panels.frame.states(t), _resolved(counted, t)
    near = np.where(at < z, at / z, 1.0)  # nearer the difference shrinks with the distance
    increment = step(coordinate.ahead, at, run.increment.reshape(z.shape))
    tangent = run.tangent.reshape(*z.shape, -1)
    change = tangent[..., 1:] + limit * tangent[..., :1]
    increment = np.where(near < 1.0, increment / near, increment)
    density = abel.density_after(panels, t, increment)
    into_z = near / coordinate.rate(z + increment, np.ones(1))
    return Added(increment, (density * into_z)[..., None] * change)


def _beside(equation: ParametrisedEquation, counted: TabulatedCount) -> FloatArray:
    """Return the derivatives (parameters,) of the grazing wear from which a count measures the
    distance; zero if from none."""
    origin, _, shift = counted.coordinate
    found = _of_grazing(equation, origin) if shift == 0.0 else np.zeros(equation.parameters)
    return np.where(np.isfinite(found), found, 0.0)


def _of_grazing(equation: ParametrisedEquation, wear: float) -> FloatArray:
    """Return the derivatives (parameters,) of the `wear` (mm) at which a turning point of the load
    just fails to make contact: the nearest to that."""
    (load,) = equation.loads
    turns = turning_points(load)
    nearest = np.argmin(np.abs(equation.model.margin(np.array([wear]), load(turns))))
    slope, change = _margin(equation, np.array([wear]), turns[[nearest]])
    return np.asarray(-change[0, 1:] / slope[0])


def _of_each(
    cycle: SwitchedPeriodMap, equation: ParametrisedEquation, starts: list[FloatArray]
) -> list[Linearised]:
    """Return the cycles from the starts (mm) of each segment, all of them at once."""
    wear, few = np.concatenate(starts), AT_ONCE // len(cycle.rule.nodes)
    runs = [
        linearised(cycle, equation, wear[at : at + few]) for at in range(0, max(len(wear), 1), few)
    ]
    ends = np.cumsum([len(each) for each in starts])[:-1]
    arrays = (np.split(np.concatenate(parts), ends) for parts in zip(*runs, strict=True))
    return [Linearised(*each) for each in zip(*arrays, strict=True)]


def linearised(
    cycle: SwitchedPeriodMap, equation: ParametrisedEquation, starts: FloatArray
) -> Linearised:
    """Return the derivatives of one cycle from each start (k,), mm."""
    tangent = np.zeros((len(starts), 1 + equation.parameters))
    added, lasted = np.zeros((2, len(starts)))  # a cycle may begin in contact
    for piece, run in cycle.pieces_from(starts, np.zeros(len(starts), dtype=int)):
        _through(cycle, equation, run.parts, tangent, lasted)
        added = added + run.added
        if len(slid := run.slid):
            slope, change = _margin(equation, (starts + added)[slid], piece.end[slid])
            tangent[slid], lasted[slid] = -change / slope[:, None], piece.end[slid]
    return Linearised(added, tangent)


def _through(
    cycle: SwitchedPeriodMap,
    equation: ParametrisedEquation,
    parts: tuple[ContactPart, ...],
    tangent: FloatArray,
    lasted: FloatArray,
) -> None:
    """Carry the `tangent` (k, 1 + parameters) of the increment through parts of contact, and the
    phase up to which contact has `lasted` (k,)."""
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
    """Return the solution at the end of x' = slope x + change over a `length` (k, 1), whose `slope`
    (k, m) is known at the nodes: how often it is the x of the start (k,), and the weights (k, m) of
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
