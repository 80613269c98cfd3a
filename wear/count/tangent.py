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

from wear.count.contact import Walked
from wear.count.cutoff import CutoffCycle
from wear.count.edge import Piece
from wear.numerics.gauss import FloatArray
from wear.parameters import ParametrisedEquation


class Linearised(NamedTuple):
    """Cycles from some starts (k,): the `increment` (k,), mm, and `tangent` (k, 1 + parameters),
    the derivatives of the wear after the cycle with respect to that before, and to parameters."""

    increment: FloatArray
    tangent: FloatArray


def linearised(cycle: CutoffCycle, equation: ParametrisedEquation, starts: FloatArray) -> Linearised:
    """Return the derivatives of one cycle from each start (k,), mm."""
    tangent = np.zeros((len(starts), 1 + equation.parameters))
    tangent[:, 0] = 1.0
    added = np.zeros(len(starts))
    for piece, run in cycle.runs(starts):
        _through(cycle, equation, piece, run.parts, tangent)
        added = added + run.added
        if run.slid is not None and len(run.slid):
            end = np.full(len(run.slid), piece.end)
            slope, change = _margin(equation, (starts + added)[run.slid], end)
            tangent[run.slid] = -change / slope[:, None]
    return Linearised(added, tangent)


def _through(
    cycle: CutoffCycle,
    equation: ParametrisedEquation,
    piece: Piece,
    parts: tuple[Walked, ...],
    tangent: FloatArray,
) -> None:
    """Carry the `tangent` (k, 1 + parameters) through the parts of contact on a piece."""
    fresh = np.full(len(tangent), True)
    for part in parts:
        rows, first = part.rows, fresh[part.rows]
        fresh[rows] = False
        if not cycle.model.compliant:
            opens = first & (part.begin > piece.begin)
            tangent[rows[opens]] += _jump(
                equation, part.start[opens], part.begin[opens], tangent[rows[opens]], closed=False
            )
        tangent[rows] = _smooth(cycle, equation, part, tangent[rows])
        if not cycle.model.compliant:
            ended, end = part.ended, part.begin + part.length
            last = part.start + part.inside[:, -1]
            tangent[rows[ended]] -= _jump(
                equation, last[ended], end[ended], tangent[rows[ended]], closed=True
            )


def _smooth(
    cycle: CutoffCycle, equation: ParametrisedEquation, part: Walked, tangent: FloatArray
) -> FloatArray:
    """Return the tangent (k, 1 + parameters) at the end of a part: the collocation, linearised."""
    model, load, rule = cycle.model, cycle.load, cycle.rule
    phases = part.begin[:, None] + part.length[:, None] * rule.nodes
    u, U_a = part.start[:, None] + part.inside, load(phases)
    _, slope = part.contact.pace(u, U_a)
    gradient = model.edge_rate_gradient if part.contact.proportional else model.rate_gradient
    changes = load.period * equation.along(gradient(u, U_a), phases)
    integrate = part.length[:, None, None] * rule.integrate
    matrix = np.eye(len(rule.nodes)) - integrate * slope[:, None, :]
    right = np.repeat(tangent[:, None], len(rule.nodes), axis=1)
    right[..., 1:] += integrate @ changes
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
    (k, 1 + parameters) with respect to parameters at the same wear and phase."""
    (load,), model = equation.loads, equation.model
    U_a = load(phase)
    gradient = {symbol: each[:, None] for symbol, each in model.margin_gradient(u, U_a).items()}
    change = np.zeros((len(u), 1 + equation.parameters))
    change[:, 1:] = equation.along(gradient, phase[:, None])[:, 0]
    return model.margin_slope(u, U_a), change
