"""The one-cycle map with the cutoff. On a compliant support see `wear.loss_of_contact.compliant`; a
rigid one:

Where the load rises, contact starts at a root of U_a = B(u) that is known beforehand; if it is
lost, the solids slide along the edge (Filippov) to the end of the piece, where the wear is
B^-1(U_a). Where the load falls, contact that is lost stays so; its end is found along with the
wear. See `wear.loss_of_contact.switching` for the pieces of the cycle.
"""

from __future__ import annotations

from collections.abc import Iterator
from typing import NamedTuple

import numpy as np

from wear.load import Load
from wear.loss_of_contact.compliant import Support, on_support
from wear.loss_of_contact.contact import Contact, ContactResult, Interval, wear_in_contact
from wear.loss_of_contact.switching import (
    Edge,
    Piece,
    displacement_at,
    edge_of_contact,
    phase_of,
    wear_at,
)
from wear.model import Model
from wear.numerics.collocation import (
    CycleSolution,
    InitialGuess,
)
from wear.numerics.gauss import (
    BoolArray,
    FloatArray,
    Gauss,
    Mesh,
    mesh,
    radau,
)
from wear.numerics.tolerances import ROUNDOFF
from wear.orbit.period_map import Settings

TOUCH = 16.0  # roundoffs of the margin by which contact is told
APART = 1e-9  # of roughness and wear: a small difference


class SwitchedPeriodMap(NamedTuple):
    """A model with cutoff under a load, with the edge of its contact. `over` has the nodes for each
    stretch of contact, which is cut until the rate is resolved to `tolerance`."""

    model: Model
    load: Load
    edge: Edge
    over: Mesh
    tolerance: float

    @property
    def rule(self) -> Gauss:
        """Return the nodes on a stretch of contact: a stiff support makes wear follow the load."""
        return radau(len(self.over.rule.nodes))

    @property
    def most_intervals(self) -> int:
        """Stretches are cut as needed: nothing is left to refine."""
        return 1

    def on(self, over: Mesh) -> SwitchedPeriodMap:
        """Return the same on another mesh; one of more nodes is to judge the other, and cuts
        stretches until nothing but rounding is left."""
        judges = len(over.rule.nodes) > len(self.over.rule.nodes)
        return self._replace(over=over, tolerance=ROUNDOFF if judges else self.tolerance)

    def resolved(self, size: Settings) -> SwitchedPeriodMap:
        """With so many nodes an interval, resolved to its strict tolerance."""
        over = mesh(np.array([0.0, 1.0]), size.phase_nodes)
        return self._replace(over=over, tolerance=size.endpoint_tolerance)

    def advance(self, starts: FloatArray, near: InitialGuess | None = None) -> CycleSolution:
        """Return the wear added by one cycle from each start, shape (...); guesses are of no
        use."""
        flat = starts.ravel()
        added = np.zeros(len(flat))
        sound, evaluations = True, 0
        for _, run in self.pieces_from(flat):
            added = added + run.added
            sound &= run.sound
            evaluations += run.evaluations
        nothing = np.zeros((*starts.shape, *self.over.phases.shape))
        converged = np.full(len(self.over.lengths), sound)
        left = np.zeros(starts.shape)
        return CycleSolution(
            added.reshape(starts.shape), nothing, nothing, evaluations, converged, left
        )

    def pieces_from(self, starts: FloatArray) -> Iterator[tuple[Piece, ContactResult]]:
        """Return the pieces of a cycle from each start (k,), and what each adds."""
        added = np.zeros(len(starts))
        run_piece = _on_support if self.model.compliant else _run
        for piece in self.edge.pieces:
            run = run_piece(self, piece, starts + added, added)
            added = added + run.added
            yield piece, run

    def increment_without_feedback(self, wear: FloatArray) -> FloatArray:
        """Return the wear added by one cycle if the rate did not feel it, any shape."""
        return np.asarray(self.increments_without_feedback(wear.ravel())[-1].reshape(wear.shape))

    def increments_without_feedback(self, wear: FloatArray) -> FloatArray:
        """Return the same of each wear (k,) up to every piece and to the end, (pieces + 1, k)."""
        x = self.over.phases.ravel()
        weights = (self.over.lengths[:, None] * self.over.rule.weights).ravel()
        added = np.zeros((len(self.edge.pieces) + 1, len(wear)))
        for i, piece in enumerate(self.edge.pieces):
            added[i + 1] = added[i]
            for begin, end in _frozen_contact(self, piece, wear):
                length = end - begin
                U_a = self.load(begin[:, None] + length[:, None] * x)
                added[i + 1] += length * (self.rate(wear[:, None], U_a) @ weights)
        return added

    def rate(self, u: FloatArray, U_a: FloatArray) -> FloatArray:
        """Return the wear rate in contact, mm per cycle."""
        rate: FloatArray = self.load.period * self.model.rate(u, U_a)
        return rate

    def response(self, added: FloatArray, growth: FloatArray) -> FloatArray:
        """Return the response (mm), at most, of cycles that have `added` so much (k,) to a relative
        error of the rate: what is made early grows by the factor `growth`, but once the wear
        exceeds the roughness the rate hardly grows any more."""
        roughness = float(self.model.fields(np.array(0.0), np.array(0.0)).sigma)
        response: FloatArray = added + np.minimum(added, roughness) * growth
        return response


class Maps(NamedTuple):
    """The one-cycle map twice: `coarse` gives the result, `fine` judges it."""

    coarse: SwitchedPeriodMap
    fine: SwitchedPeriodMap


def switched_period_map(model: Model, load: Load) -> SwitchedPeriodMap:
    """Return the map of one cycle with a cutoff."""
    whole = mesh(np.array([0.0, 1.0]), 8)
    return SwitchedPeriodMap(model, load, edge_of_contact(model, load), whole, 1.0)


def margin_roundoff(model: Model, load: Load, wear: FloatArray) -> FloatArray:
    """Return the margin (mm) that rounding cannot tell from none, at each wear (mm)."""
    peak = np.full_like(wear, load.maximum)
    uncertainty: FloatArray = TOUCH * ROUNDOFF * model.margin_terms(wear, peak)
    return uncertainty


def _run(
    cycle: SwitchedPeriodMap, piece: Piece, wear: FloatArray, before: FloatArray
) -> ContactResult:
    """Return a piece from each wear (k,), `before` (k,) of it added by this cycle already."""
    added = np.zeros(len(wear))
    active, begin, end = _contact(cycle, piece, wear)
    if not active.any():
        return ContactResult(added, added, True, 0)
    u, edge = wear[active], cycle.edge
    level = None if piece.rising else 0.0
    contact = Contact(cycle.model, cycle.load, cycle.model.law_rate_and_slope, level)
    over = Interval(begin, piece.end - begin, end - begin)
    run = wear_in_contact(contact, cycle.rule, cycle.tolerance, u, over, before[active])
    added[active] = run.added
    last = u + run.added
    rows = np.flatnonzero(active)
    run = run._replace(parts=run.of(rows))
    if piece.rising:
        top = np.full(len(u), piece.heights[-1])
        lost = (cycle.model.margin(last, top) < 0.0) | edge.is_over(u, last, top)
        if lost.any():
            slid = wear_at(cycle.model, top[lost], u[lost], 0.0, edge.turning_wear)
            added[rows[lost]] = slid - u[lost]
        return run._replace(added=added, slid=rows[lost])
    over_crest = edge.is_over(u, last, cycle.load(begin + run.length))
    return run._replace(added=added, sound=run.sound and not over_crest.any())


def _contact(
    cycle: SwitchedPeriodMap, piece: Piece, wear: FloatArray
) -> tuple[BoolArray, FloatArray, FloatArray]:
    """Return which wears (k,) make contact on a piece, and the phases of its begin and end for
    those if the wear stays as it is."""
    needed = displacement_at(cycle.model, wear)
    deepest = max(piece.heights[0], piece.heights[-1])
    active = deepest - needed > margin_roundoff(cycle.model, cycle.load, wear)
    edge = phase_of(cycle.load, piece, needed[active])
    if piece.rising:
        return active, edge, np.full_like(edge, piece.end)
    return active, np.full_like(edge, piece.begin), edge


def _frozen_contact(
    cycle: SwitchedPeriodMap, piece: Piece, wear: FloatArray
) -> list[tuple[FloatArray, FloatArray]]:
    """Return the phases between which each wear (k,), if it stays as it is, makes contact of one
    kind on a piece: on a compliant support there are two kinds."""
    begin, end = (np.full_like(wear, phase) for phase in (piece.begin, piece.end))
    needed = displacement_at(cycle.model, wear)
    opens, bends = (phase_of(cycle.load, piece, needed + at) for at in (0.0, cycle.edge.held))
    if piece.rising:
        return [(opens, bends), (bends, end)]
    return [(begin, bends), (bends, opens)]


def _on_support(
    cycle: SwitchedPeriodMap, piece: Piece, wear: FloatArray, before: FloatArray
) -> ContactResult:
    """Return a piece on a compliant support, from each wear (k,)."""
    support = Support(cycle.model, cycle.load, cycle.edge, cycle.rule, cycle.tolerance)
    return on_support(support, piece, wear, before, margin_roundoff(cycle.model, cycle.load, wear))
