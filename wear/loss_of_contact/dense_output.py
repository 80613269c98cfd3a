"""Increments up to given phases of cycles with loss of contact.

The phases at which contact begins and ends depend on the wear, so that the increment up to a phase
has kinks as a function of the initial wear. It is not interpolated between cycles: the requested
cycles are integrated, all at once, from their initial wears. Within contact the increment is the
collocation polynomial; two of different degree show its error, and pieces are cut until they agree.
"""

from typing import NamedTuple

import numpy as np
from numpy.polynomial.legendre import legvander

from wear.load import Load
from wear.loss_of_contact.contact import ContactPart
from wear.loss_of_contact.edge import edge_of_contact
from wear.loss_of_contact.period_map import switched_period_map
from wear.loss_of_contact.roots import wear_at
from wear.loss_of_contact.switching import PIECE_SAMPLES, Edge, Piece
from wear.model import Model
from wear.numerics.floating_point import ROUNDOFF
from wear.numerics.gauss import BoolArray, FloatArray, Gauss
from wear.orbit.dense_output import PhaseIncrements
from wear.orbit.period_map import settings

MOST_ROUNDS = 6  # of cutting the pieces in two
STRICTER = 0.1  # accuracy of an increment, over that of the wear


class SwitchedDenseOutput(NamedTuple):
    """The cycles of a scene, for increments up to the `phases` (m,) to the accuracy `rtol`."""

    model: Model
    load: Load
    edge: Edge
    phases: FloatArray
    rtol: float

    @np.errstate(all="ignore")  # of trial states; NaN fails the error estimate
    def added(self, cycles: FloatArray, starts: FloatArray) -> PhaseIncrements:
        """Return the increments of a cycle from each of the `starts` (n,), mm."""
        pieces = self.edge.pieces
        for _ in range(MOST_ROUNDS):
            size = settings(self.rtol, [pieces.begin])
            coarse, fine = (
                self._added(pieces, starts, number)
                for number in (size.phase_nodes, size.finer_nodes)
            )
            error = np.max(np.abs(coarse - fine), axis=1, initial=0.0)
            if np.all(error <= STRICTER * self.rtol * (starts + fine.max(axis=1, initial=0.0))):
                break
            pieces = _halved(pieces, self.load)
        order = np.argsort(self.phases)  # wear never falls, but its last digit may
        fine[:, order] = np.maximum.accumulate(fine[:, order], axis=1)
        return PhaseIncrements(fine, error, None, np.zeros(len(cycles)))

    def _added(self, pieces: Piece, starts: FloatArray, nodes: int) -> FloatArray:
        """Return the increments (n, m), mm, with so many nodes on each step of contact; NaN where
        the iteration failed."""
        edge = self.edge._replace(pieces=pieces)
        cycle = switched_period_map([self.model], [self.load], [edge], nodes, ROUNDOFF)
        added, total = np.zeros((len(starts), len(self.phases))), np.zeros(len(starts))
        for piece, run in cycle.pieces_from(starts, np.zeros(len(starts), dtype=np.intp)):
            for part in run.parts:
                self._in_contact(added, part, starts, cycle.rule)
            for row in run.slid.tolist():
                on = (piece.begin[row] <= self.phases) & (self.phases <= piece.end[row])
                added[row, on] = self._sliding(starts[row], total[row], added[row, on], on)
            total = total + np.where(run.sound, run.added, np.nan)
            after = ~(run.sound & (run.added == 0.0))[:, None] & (self.phases >= piece.end[:, None])
            added = np.where(after, total[:, None], added)
        return added

    def _in_contact(
        self, added: FloatArray, part: ContactPart, starts: FloatArray, rule: Gauss
    ) -> None:
        """Set what a step of contact has `added` (n, m) up to its phases, and up to those after."""
        x = (self.phases - part.begin[:, None]) / part.length[:, None]
        before = (part.start - starts[part.rows])[:, None]
        # The polynomial vanishes at the start: over x, it is known at the nodes.
        series = rule.coefficients @ (part.inside / rule.nodes[:, None])
        inner = np.clip(x, 0.0, 1.0)
        basis = legvander(2.0 * inner - 1.0, len(series) - 1)
        value = before + inner * np.einsum("kmj,jk->km", basis, series)
        added[part.rows] = np.where(x >= 0.0, value, added[part.rows])

    def _sliding(
        self, start: float, before: float, closed: FloatArray, on: BoolArray
    ) -> FloatArray:
        """Return what a cycle from the wear `start` (mm) has added up to the phases `on` (m,) a
        rising piece, on which the solids slide along the edge of contact at last: as `closed` as
        long as contact by the law lasts, at least what was added `before` the piece."""
        U_a, wear = self.load(self.phases[on]), start + closed
        edge = wear_at(self.model, U_a, wear, 0.0, self.edge.levels.turning_wear) - start
        return np.where(self.model.margin(wear, U_a) < 0.0, np.maximum(edge, before), closed)


def switched_dense_output(
    model: Model, load: Load, phases: FloatArray, rtol: float
) -> SwitchedDenseOutput:
    """Return the dense output of any cycles at `phases` (m,) in [0, 1]."""
    return SwitchedDenseOutput(model, load, edge_of_contact(model, load), phases, rtol)


def _halved(pieces: Piece, load: Load) -> Piece:
    """Return the pieces, each cut in two."""
    begin, end = np.repeat(pieces.begin, 2), np.repeat(pieces.end, 2)
    begin[1::2] = end[::2] = (pieces.begin + pieces.end) / 2
    inside = (1 - np.cos(np.pi * np.arange(PIECE_SAMPLES + 1) / PIECE_SAMPLES)) / 2
    at = begin + (end - begin) * inside[:, None]
    return Piece(at, load(at), np.repeat(pieces.closes, 2))
