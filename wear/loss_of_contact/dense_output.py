"""What a cycle with the cutoff adds up to given phases.

Contact begins and ends where the wear lets it, so that what is added up to a phase has kinks in the
wear. It is not interpolated: the wanted cycles are integrated, all at once, from the wear that the
count gives for their starts. The pieces of the cycle are cut at the phases.
"""

from collections.abc import Iterator
from itertools import pairwise
from typing import NamedTuple

import numpy as np

from wear.load import Load
from wear.loss_of_contact.period_map import SwitchedPeriodMap, switched_period_map
from wear.loss_of_contact.switching import PIECE_SAMPLES, Piece
from wear.model import Model
from wear.numerics.gauss import (
    FloatArray,
    mesh,
)
from wear.orbit.dense_output import Added
from wear.orbit.period_map import settings

NODES = 8  # on each part of a piece, most of which are short
NEARLY = 1e-12  # of a cycle: phases that are one


class SwitchedDenseOutput(NamedTuple):
    """A cycle in `parts`: as many as `upto` (m,) lie before each phase. The one-cycle maps are for
    the result and to judge it."""

    upto: tuple[int, ...]
    parts: tuple[Piece, ...]
    both: tuple[SwitchedPeriodMap, SwitchedPeriodMap]

    @np.errstate(all="ignore")  # of trial states; what is no number fails the estimate of error
    def added(self, cycles: FloatArray, starts: FloatArray) -> Added:
        """Return what a cycle adds from each of the `starts` (n,), mm."""
        coarse, fine = (self._wear(cycle, starts) for cycle in self.both)
        missed = np.max(np.abs(coarse - fine), axis=1, initial=0.0)
        return Added(coarse, missed, None, np.zeros(len(cycles)))

    def _wear(self, cycle: SwitchedPeriodMap, starts: FloatArray) -> FloatArray:
        """Return the wear added (n, m) up to each phase, mm; no number where it was not found."""
        added = [np.zeros(len(starts))]
        for part in self.parts:
            alone = cycle._replace(edge=cycle.edge._replace(pieces=(part,)))
            run = alone.advance(starts + added[-1])
            added.append(added[-1] + np.where(run.converged.all(), run.increment, np.nan))
        return np.stack([added[i] for i in self.upto], axis=1)


def switched_dense_output(
    model: Model, load: Load, phases: FloatArray, rtol: float
) -> SwitchedDenseOutput:
    """Prepare for any cycles and for `phases` (m,) in [0, 1]."""
    cycle = switched_period_map(model, load)
    parts = tuple(part for piece in cycle.edge.pieces for part in _cut(piece, load, phases))
    ends = np.array([part.end for part in parts])
    upto = tuple(np.sum(ends <= phases[:, None] + NEARLY, axis=1).tolist())
    coarse = cycle.resolved(settings(rtol)._replace(phase_nodes=NODES))
    fine = coarse.on(mesh(coarse.over.edges, NODES + 4))
    return SwitchedDenseOutput(upto, parts, (coarse, fine))


def _cut(piece: Piece, load: Load, phases: FloatArray) -> Iterator[Piece]:
    """Yield the piece, cut at those of the phases that lie within."""
    within = (phases > piece.begin + NEARLY) & (phases < piece.end - NEARLY)
    for begin, end in pairwise([piece.begin, *np.unique(phases[within]).tolist(), piece.end]):
        inside = (1 - np.cos(np.pi * np.arange(PIECE_SAMPLES + 1) / PIECE_SAMPLES)) / 2
        at = begin + (end - begin) * inside
        yield piece._replace(phases=at, heights=load(at))
