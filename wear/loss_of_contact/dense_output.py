"""Increments up to given phases of cycles with loss of contact.

The phases at which contact begins and ends depend on the wear, so that the increment up to a phase
has kinks as a function of the initial wear. It is not interpolated: the requested cycles are
integrated, all at once, from their initial wears. The pieces of the cycle are cut at the phases.
"""

from typing import NamedTuple

import numpy as np

from wear.load import Load
from wear.loss_of_contact.edge import edge_of_contact
from wear.loss_of_contact.period_map import SwitchedPeriodMap, switched_period_map
from wear.loss_of_contact.switching import PIECE_SAMPLES, Piece
from wear.model import Model
from wear.numerics.gauss import FloatArray
from wear.orbit.dense_output import PhaseIncrements
from wear.orbit.period_map import settings

NODES = 8  # on each part of a piece, most of which are short
NEARLY = 1e-12  # of a cycle: the distance between phases that are one


class SwitchedDenseOutput(NamedTuple):
    """A cycle in `parts` (k,), of which the first `upto` (m,) lie before each phase; the period
    maps are those of the result and of its error estimate."""

    upto: tuple[int, ...]
    parts: Piece
    both: tuple[SwitchedPeriodMap, SwitchedPeriodMap]

    @np.errstate(all="ignore")  # of trial states; NaN fails the error estimate
    def added(self, cycles: FloatArray, starts: FloatArray) -> PhaseIncrements:
        """Return the increments of a cycle from each of the `starts` (n,), mm."""
        coarse, fine = (self._wear(cycle, starts) for cycle in self.both)
        error = np.max(np.abs(coarse - fine), axis=1, initial=0.0)
        return PhaseIncrements(coarse, error, None, np.zeros(len(cycles)))

    def _wear(self, cycle: SwitchedPeriodMap, starts: FloatArray) -> FloatArray:
        """Return the wear added (n, m) up to each phase, mm; NaN where the iteration failed."""
        added, nothing = [np.zeros(len(starts))], np.zeros(len(starts))
        for i in range(len(self.parts.closes)):
            part = self.parts.take(np.full(len(starts), i))
            run = cycle.through(cycle.cycles, part, starts + added[-1], nothing)
            added.append(added[-1] + np.where(run.sound.all(), run.added, np.nan))
        return np.stack([added[i] for i in self.upto], axis=1)


def switched_dense_output(
    model: Model, load: Load, phases: FloatArray, rtol: float
) -> SwitchedDenseOutput:
    """Return the dense output of any cycles at `phases` (m,) in [0, 1]."""
    edge = edge_of_contact(model, load)
    parts = _cut(edge.pieces, load, phases)
    upto = tuple(np.sum(parts.end <= phases[:, None] + NEARLY, axis=1).tolist())
    size = settings(rtol)
    coarse = switched_period_map([model], [load], [edge], NODES, size.endpoint_tolerance)
    fine = switched_period_map([model], [load], [edge], NODES + 4)
    return SwitchedDenseOutput(upto, parts, (coarse, fine))


def _cut(pieces: Piece, load: Load, phases: FloatArray) -> Piece:
    """Return the pieces, cut at the phases inside them."""
    cuts = np.append(pieces.begin, pieces.end[-1])
    within = np.min(np.abs(phases[:, None] - cuts), axis=1) > NEARLY
    cuts = np.union1d(cuts, phases[within])
    of_piece = np.searchsorted(pieces.begin, cuts[:-1], side="right") - 1
    inside = (1 - np.cos(np.pi * np.arange(PIECE_SAMPLES + 1) / PIECE_SAMPLES)) / 2
    at = cuts[:-1] + np.diff(cuts) * inside[:, None]
    return Piece(at, load(at), pieces.closes[of_piece])
