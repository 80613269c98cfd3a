"""Derivatives of the wear with respect to parameters, where contact is lost.

Within a stretch of contact the wear rate is smooth, and the equation linearised there has the
matrix of the collocation. On a rigid support the rate jumps where contact begins and ends: the
phases at which it does so change with the parameter, and with them the wear, by the rate times that
change. While the solids slide along the edge the wear is a function of the load alone. Where
contact grazes a turning point of the load the derivatives are those from one side.

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
from wear.loss_of_contact.period_map import SwitchedPeriodMap, switched_period_map
from wear.loss_of_contact.switching import Piece, edge_of_contact
from wear.numerics.chebyshev import chebyshev_nodes
from wear.numerics.gauss import FloatArray
from wear.numerics.tolerances import ROUNDOFF
from wear.orbit import abel
from wear.orbit.iterates import Iterates
from wear.orbit.panels import CHECKS
from wear.orbit.period_map import settings
from wear.orbit.tangent import Added, Tangents, after_on_cells, sums_on_cells
from wear.orbit.transient import SAFETY
from wear.parameters import ParametrisedEquation

LEFT = 1e12  # digits of the derivative of a limit, which follows from the margin alone


@np.errstate(all="ignore")
def stage_tangents(
    found: Counted,
    equation: ParametrisedEquation,
    cycles: FloatArray,
    rtol: float,
    start: FloatArray,
    start_error: FloatArray,
) -> Tangents:
    """Return the derivatives of the wear of one scene after `cycles` (1, n), as the count `found`
    has it to `rtol`, if the first wear has the derivative `start` (1, parameters), known up to
    `start_error`."""
    size = settings(rtol)
    scene = [equation.model], equation.loads, [edge_of_contact(equation.model, equation.loads[0])]
    both = _Maps(
        switched_period_map(*scene, size.phase_nodes, size.endpoint_tolerance),
        switched_period_map(*scene, size.finer_nodes),
    )
    u, error = (values[None] for values in found.after(cycles[0]))
    derivative, missed = np.full((2, 1, equation.parameters, cycles.shape[1]), np.nan)
    increment = np.zeros(cycles.shape)
    now, now_error = start[0], start_error[0]
    for segment in found.orbit.segments:
        begins, counted = segment.begins, segment.counted
        here = cycles[0] >= begins
        last = counted.whole_cycles
        wanted = np.append(np.minimum(cycles[0, here] - begins, last), last)
        if isinstance(counted, Iterates):
            part = _one_by_one(both, equation, counted, wanted, now, now_error)
        elif isinstance(counted, TabulatedCount):
            part = _tabulated(both, equation, counted, wanted, now, now_error)
        elif counted.at_rest[0]:
            limit = np.tile(_limit(equation, found.last_wear), (len(wanted), 1))
            part = _Part(limit, np.abs(limit) / LEFT, np.zeros_like(wanted))
        else:  # an unresolved segment: no cycle of it is known
            unknown = np.full((len(wanted), equation.parameters), np.inf)
            part = _Part(unknown, unknown, np.zeros_like(wanted))
        derivative[0, :, here], missed[0, :, here] = part.derivative[:-1], part.error[:-1]
        increment[0, here] = part.increment[:-1]
        now, now_error = part.derivative[-1], part.error[-1]
    missed = np.where(np.isfinite(error)[:, None] & np.isfinite(missed), missed, np.inf)
    return Tangents(u, error, derivative, missed, increment)


class _Maps(NamedTuple):
    """The one-cycle map twice: `coarse` gives the result, `fine` judges it."""

    coarse: SwitchedPeriodMap
    fine: SwitchedPeriodMap


class _Part(NamedTuple):
    """The `derivative` (n, parameters) after some cycles of a stage, its `error`, and what the last
    cycle has added, `increment` (n,)."""

    derivative: FloatArray
    error: FloatArray
    increment: FloatArray


def _one_by_one(
    both: _Maps,
    equation: ParametrisedEquation,
    counted: Iterates,
    cycles: FloatArray,
    start: FloatArray,
    start_error: FloatArray,
) -> _Part:
    """Return the derivatives after `cycles` (n,) that were taken one by one."""
    wear, uncertain = counted.transient[0], counted.transient_error[0]
    fine = linearised(both.fine, equation, wear[:-1]).tangent
    # Beside the start by its error: near a grazing wear that may be the larger part.
    judge = linearised(both.coarse, equation, wear[:-1] + uncertain[:-1]).tangent
    values, errors = [start], [start_error]
    for own, other in zip(fine, judge, strict=True):
        multiplier = 1.0 + own[0]
        by_start, apart = multiplier * values[-1], np.abs(own - other)
        by_parameters = apart[0] * np.abs(values[-1]) + apart[1:]
        error = np.abs(multiplier) * errors[-1] + SAFETY * by_parameters
        rounding = ROUNDOFF * (np.abs(by_start) + np.abs(own[1:]))
        values.append(by_start + own[1:])
        errors.append(error + SAFETY * rounding)
    index = cycles.astype(int)
    added = np.concatenate([[0.0], np.diff(wear)])
    return _Part(np.array(values)[index], np.array(errors)[index], added[index])


def _tabulated(
    both: _Maps,
    equation: ParametrisedEquation,
    counted: TabulatedCount,
    cycles: FloatArray,
    start: FloatArray,
    start_error: FloatArray,
) -> _Part:
    """Return the derivatives after `cycles` (n,) that were counted between two grazing wears.

    Where wear tends to a limit the derivative tends to that of the limit: the sums are those of the
    difference, which the last cycles before rounding hardly change.
    """
    limit_wear, z = counted.limit_wear, counted.coordinate
    limit = (
        np.zeros(equation.parameters) if limit_wear is None else _limit(equation, limit_wear.wear)
    )
    count, panels = counted.in_z, counted.panels
    t = chebyshev_nodes(panels.series.shape[1])
    nodes = _added(both.coarse, equation, counted, t, limit)
    checks = _added(both.fine, equation, counted, CHECKS, limit)
    first = counted.table.u[:1]
    into_z = 1.0 / z.rate(first, np.ones(1))
    sums = sums_on_cells(
        count, nodes, checks, (into_z * (start - limit))[None], (into_z * start_error)[None]
    )
    wanted = np.minimum(cycles, counted.reach)
    by_z, missed, rate = (part[0] for part in after_on_cells(count, sums, wanted[None]))
    at, _ = count.after(wanted[None])
    pace = z.rate(at[0], np.ones(1))[:, None]
    derivative, error = limit + pace * by_z, pace * missed + SAFETY * ROUNDOFF * np.abs(limit)
    return _Part(derivative, error, pace[:, 0] * rate)


def _added(
    cycle: SwitchedPeriodMap,
    equation: ParametrisedEquation,
    counted: TabulatedCount,
    t: FloatArray,
    limit: FloatArray,
) -> Added:
    """Return what cycles from the positions `t` (n,) of each panel add to z, and to the sum of
    (dn/dz) (dz/dp), less what it would be if du/dp were `limit` (parameters,) all along."""
    panels, coordinate = counted.panels, counted.coordinate
    z = panels.frame.states(t)
    near = np.ones(z.shape)
    at = z
    if counted.limit_wear is not None:
        # Nearer to the limit than rounding permits, the difference shrinks with the distance.
        at = np.minimum(z, 1.0 / counted.limit_wear.nearest)
        near = at / z
    run = linearised(cycle, equation, coordinate.wear(at).ravel())
    increment = coordinate.step(at, run.increment.reshape(z.shape))
    tangent = run.tangent.reshape(*z.shape, -1)
    change = tangent[..., 1:] + limit * tangent[..., :1]
    increment = np.where(near < 1.0, increment / near, increment)
    density = abel.density_after(panels, t, increment)
    into_z = near / coordinate.rate(z + increment, np.ones(1))
    return Added(increment, (density * into_z)[..., None] * change)


def _limit(equation: ParametrisedEquation, wear: float) -> FloatArray:
    """Return the derivatives (parameters,) of the `wear` (mm) at which the peak of the load just
    fails to make contact."""
    (load,) = equation.loads
    phase = np.array(load.peaks)
    highest = phase[[int(np.argmax(load(phase)))]]
    slope, change = _margin(equation, np.array([wear]), highest)
    return np.asarray(-change[0, 1:] / slope[0])


class Linearised(NamedTuple):
    """Cycles from some starts (k,): the `increment` (k,), mm, and `tangent` (k, 1 + parameters),
    its derivatives with respect to the wear before the cycle, and to parameters.

    Near a limit wear that of the increment is small: from the derivative of the wear, one more, it
    would be lost to cancellation.
    """

    increment: FloatArray
    tangent: FloatArray


def linearised(
    cycle: SwitchedPeriodMap, equation: ParametrisedEquation, starts: FloatArray
) -> Linearised:
    """Return the derivatives of one cycle from each start (k,), mm."""
    tangent = np.zeros((len(starts), 1 + equation.parameters))
    added = np.zeros(len(starts))
    for piece, run in cycle.pieces_from(starts, np.zeros(len(starts), dtype=int)):
        _through(cycle, equation, piece, run.parts, tangent)
        added = added + run.added
        if len(run.slid):
            slope, change = _margin(equation, (starts + added)[run.slid], piece.end[run.slid])
            tangent[run.slid] = -change / slope[:, None]
    return Linearised(added, tangent)


def _through(
    cycle: SwitchedPeriodMap,
    equation: ParametrisedEquation,
    piece: Piece,
    parts: tuple[ContactPart, ...],
    tangent: FloatArray,
) -> None:
    """Carry the `tangent` (k, 1 + parameters) of the increment through the parts of contact on a
    piece."""
    fresh = np.full(len(tangent), True)
    for part in parts:
        rows, first = part.rows, fresh[part.rows]
        fresh[rows] = False
        if not equation.model.compliant:
            opens = first & (part.begin > piece.begin[rows])
            tangent[rows[opens]] += _jump(
                equation, part.start[opens], part.begin[opens], tangent[rows[opens]], closed=False
            )
        tangent[rows] = _smooth(cycle, equation, part, tangent[rows])
        if not equation.model.compliant:
            ended, end = part.ended, part.begin + part.length
            last = part.start + part.inside[-1]
            tangent[rows[ended]] -= _jump(
                equation, last[ended], end[ended], tangent[rows[ended]], closed=True
            )


def _smooth(
    cycle: SwitchedPeriodMap, equation: ParametrisedEquation, part: ContactPart, tangent: FloatArray
) -> FloatArray:
    """Return the tangent (k, 1 + parameters) at the end of a part: the collocation, linearised."""
    (load,), model, rule = equation.loads, equation.model, cycle.rule
    phases = part.begin[:, None] + part.length[:, None] * rule.nodes
    u, U_a = part.start[:, None] + part.inside.T, load(phases)
    rates = model.law_rate_and_slope if part.by_law else model.edge_rate_and_slope
    slope = load.period * rates(u, U_a)[1]
    gradient = model.rate_gradient if part.by_law else model.edge_rate_gradient
    by_parameters = load.period * equation.along(gradient(u, U_a), phases)
    changes = np.concatenate([slope[..., None], by_parameters], axis=-1)
    integrate = part.length[:, None, None] * rule.integrate
    matrix = np.eye(len(rule.nodes)) - integrate * slope[:, None, :]
    right = tangent[:, None] + integrate @ changes
    return np.asarray(np.linalg.solve(matrix, right)[:, -1])  # Radau's last node is the end


def _jump(
    equation: ParametrisedEquation,
    u: FloatArray,
    phase: FloatArray,
    tangent: FloatArray,
    closed: bool,
) -> FloatArray:
    """Return the wear rate times the advance of the phase at which contact begins, or, if it was
    `closed`, ends: (k, 1 + parameters)."""
    (load,), model = equation.loads, equation.model
    slope, change = _margin(equation, u, phase)
    rate = load.period * model.law_rate(u, load(phase))
    pull = load.slope(phase) + (slope * rate if closed else 0.0)
    return np.asarray((rate / pull)[:, None] * (slope[:, None] * tangent + change))


def _margin(
    equation: ParametrisedEquation, u: FloatArray, phase: FloatArray
) -> tuple[FloatArray, FloatArray]:
    """Return the derivative (k,) of the margin of contact with respect to the wear, and those
    (k, 1 + parameters) with respect to the wear and to parameters, at the same phase."""
    (load,), model = equation.loads, equation.model
    U_a = load(phase)
    gradient = {symbol: each[:, None] for symbol, each in model.margin_gradient(u, U_a).items()}
    slope, by_parameters = model.margin_slope(u, U_a), equation.along(gradient, phase[:, None])
    return slope, np.column_stack([slope, by_parameters[:, 0]])
