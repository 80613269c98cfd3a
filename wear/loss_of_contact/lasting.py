"""Contact by the law that lasts over many straight pieces of the load: all of them at once.

Where the rows of a table stay above the edge of contact nothing switches from piece to piece. The
wear is collocated on all of them together, as in a cycle without loss of contact.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from wear.loss_of_contact.contact import SETTLED, ContactResult
from wear.loss_of_contact.roots import displacement_at
from wear.loss_of_contact.switching import Cycles, Piece
from wear.model import Model
from wear.numerics.collocation import NOISE, Tangent, iterate, truncation_error
from wear.numerics.gauss import FloatArray, Mesh, mesh


class _LawRates(NamedTuple):
    """Rates by the contact law on a mesh whose intervals are pieces, under the displacements `U_a`
    (k, 1, q, m), mm; the constants of the model, and the `period`, lie along the first axis."""

    model: Model
    period: FloatArray | float
    over: Mesh
    U_a: FloatArray
    tolerance: float

    def rate_per_interval(self, u: FloatArray, near: Tangent | None = None) -> FloatArray:
        """Return the wear rate (mm per cycle) times the length of each piece."""
        times = self.period * self.over.lengths[..., None]
        known = near.end / times if self.model.compliant and near is not None else None
        rate: FloatArray = times * self.model.rate(u, self.U_a, known)
        return rate


def lasting_contact(
    cycles: Cycles, pieces: Piece, nodes: int, tolerance: float, u: FloatArray, before: FloatArray
) -> ContactResult:
    """Return the wear added on `pieces` (k, q) in a row, from each wear u (k,), mm; the cycle has
    added `before` (k,) mm so far. It is sound where contact lasts, and is resolved to the
    `tolerance`, relative to the increment of the cycle."""
    edges = np.column_stack([pieces.begin, pieces.end[:, -1]])
    over, starts = mesh(edges[:, None], nodes), u[:, None]
    low, high = pieces.heights[0][:, None, :, None], pieces.heights[-1][:, None, :, None]
    model, period = cycles.model, cycles.period
    if not isinstance(period, float):
        model, period = model.reshaped((-1, 1, 1, 1)), period[:, None, None, None]
    U_a = low + (high - low) * over.rule.nodes
    rates = _LawRates(model, period, over, U_a, max(NOISE, SETTLED * tolerance))
    run = iterate(rates, starts)
    added = run.increment[:, 0]
    neglected = np.sum(truncation_error(run.rate, over), axis=-1)[:, 0]
    lowest = np.min(np.minimum(low, high), axis=(1, 2, 3))
    sound = run.converged & (neglected <= tolerance * (before + added))
    sound &= lowest > displacement_at(cycles.model, u + added) + cycles.held
    sound &= (u < cycles.turning_wear) == (u + added < cycles.turning_wear)
    error = neglected + run.iteration_error[:, 0] * added
    return ContactResult(added, error, edges[:, -1] - edges[:, 0], sound, run.evaluations)
