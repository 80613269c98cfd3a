"""Abel's equation for many scenes: panels of all of them in one array, each cut in two where the
residual off its nodes asks for it.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from wear.count import abel
from wear.count.checks import CHECKS, at_checks, missed_by_phase
from wear.count.cycle import Settings
from wear.count.many import ManyDrives
from wear.count.scan import cycles_if_cut, halves
from wear.numerics.chebyshev import (
    chebyshev_nodes,
)
from wear.numerics.gauss import (
    BoolArray,
    FloatArray,
    IntArray,
)

MOST_ROUNDS = 12  # of cutting panels


class ManyPanels(NamedTuple):
    """Panels of many scenes, in rising order scene by scene: the `scene` (panels,) of each, its
    `shift`, where it `starts` and `ends` (mm), the density's `series` (panels, m) and the greatest
    `residual` (panels,) of Abel's equation off the nodes."""

    scene: IntArray
    shift: FloatArray
    starts: FloatArray
    ends: FloatArray
    series: FloatArray
    residual: FloatArray

    def where(self, chosen: BoolArray | IntArray) -> ManyPanels:
        """Some of the panels."""
        return ManyPanels._make(array[chosen] for array in self)

    def joined(self, other: ManyPanels) -> ManyPanels:
        """Both, in order."""
        both = ManyPanels._make(np.concatenate(pair) for pair in zip(self, other, strict=True))
        return both.where(np.lexsort((both.starts, both.scene)))

    @property
    def density(self) -> abel.Panels:
        """The panels alone."""
        across = abel.widths(self.shift, self.starts, self.ends)
        return abel.Panels(self.shift, self.starts, across, self.series)


def fill(coarse: ManyDrives, fine: ManyDrives, blank: ManyPanels, size: Settings) -> ManyPanels:
    """Solve Abel's equation on panels with the coarse map, test it with the fine one, and cut those
    with too large a residual in two; scenes that this does not cure keep it."""
    found = blank.where(np.zeros(len(blank.scene), dtype=bool))
    for rounds in range(MOST_ROUNDS):
        fresh, if_cut = _solved(coarse, fine, blank, size)
        rough = ~(fresh.residual <= size.residual_tolerance)
        # A panel of few cycles would hide an oscillation; nor is there a cure for no number.
        lost = rough & ~(if_cut >= size.panel_nodes)
        rough &= ~np.isin(fresh.scene, fresh.scene[lost])
        if rounds == MOST_ROUNDS - 1 or not rough.any():
            break
        found = found.joined(fresh.where(~rough))
        worst = fresh.where(rough)
        starts, ends = halves(worst.shift, worst.starts, worst.ends)
        blank = worst.where(np.tile(np.arange(len(worst.scene)), 2))
        blank = blank._replace(starts=starts, ends=ends)
    return found.joined(fresh)


def _solved(
    coarse: ManyDrives, fine: ManyDrives, blank: ManyPanels, size: Settings
) -> tuple[ManyPanels, FloatArray]:
    """The panels with series and residual, and roughly how many cycles (panels,) the first part of
    each would take if it were cut."""
    shift, starts, m = blank.shift, blank.starts, size.panel_nodes
    across = abel.widths(shift, starts, blank.ends)
    nodes = abel.panel_wear(shift, starts, across, chebyshev_nodes(m))
    solver = coarse.take(blank.scene)
    ahead = solver.advance(nodes)
    panels = abel.solve(shift, starts, across, ahead.increment)
    checks = abel.panel_wear(shift, starts, across, CHECKS)
    judged = fine.take(blank.scene).advance(checks, at_checks(ahead, size.finer_nodes))
    residual = np.abs(abel.residual(panels, CHECKS, judged.increment))
    # What the iterations may have left, nothing else tells.
    residual = np.max(residual + judged.iteration_error, axis=1) + np.max(
        ahead.iteration_error, axis=1
    )
    by_phase = np.max(missed_by_phase(ahead, solver.over), axis=1)
    residual = np.maximum(residual, by_phase)
    sound = np.all(ahead.converged & judged.converged, axis=1)
    sound &= ~(by_phase > size.residual_tolerance)  # no cut cures it
    residual = np.where(sound, residual, np.inf)
    step = abel.reach(shift, starts, across, chebyshev_nodes(m), ahead.increment)
    if_cut = np.where(sound, cycles_if_cut(2 / step[..., 0]), 0.0)
    return blank._replace(series=panels.series, residual=residual), if_cut
