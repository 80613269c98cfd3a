"""Abel's equation on panels of wear: solved with one map of a cycle, tested off the nodes with a
finer one, which says what to refine.
"""

from typing import NamedTuple

import numpy as np

from wear.count import abel
from wear.count.checks import CHECKS, MISSED, at_checks, missed_by_phase
from wear.count.cycle import Cost, OneCycle, Settings
from wear.count.scan import SPLIT, cut_far_out, cycles_if_cut, halves
from wear.numerics.chebyshev import (
    chebyshev_nodes,
)
from wear.numerics.collocation import (
    unresolved,
)
from wear.numerics.gauss import (
    BoolArray,
    FloatArray,
)

FAR_OUT = 10.0  # times the residual elsewhere: then the fault lies at the end of the panel
SAFETY = 3.0  # on measured discrepancies
MOST_ROUNDS = 12  # of refinement
MOST_PANELS = 200
NONE: FloatArray = np.empty(0)


class Maps(NamedTuple):
    """The one-cycle map twice: `coarse` gives the result, `fine` judges it."""

    coarse: OneCycle
    fine: OneCycle


class Solved(NamedTuple):
    """Panels between wear `starts` and `ends` (mm) with Abel's equation solved on them: `series`
    (panels, m), the greatest `residual` (panels,) off the nodes, the `share` (panels,) of each up
    to where it would be cut in two, and roughly how many cycles that part would take `if_cut`
    (panels,)."""

    starts: FloatArray
    ends: FloatArray
    series: FloatArray
    residual: FloatArray
    share: FloatArray
    if_cut: FloatArray

    def where(self, chosen: BoolArray) -> "Solved":
        """Some of the panels."""
        return Solved(*(array[chosen] for array in self))

    def joined(self, other: "Solved") -> "Solved":
        """Both, in rising order."""
        both = [np.concatenate(pair) for pair in zip(self, other, strict=True)]
        order = np.argsort(both[0])
        return Solved(*(array[order] for array in both))

    def panels(self, shift: float) -> abel.Panels:
        """The panels with their density."""
        across = abel.widths(shift, self.starts, self.ends)
        return abel.Panels(shift, self.starts, across, self.series)


def solve_panels(
    both: Maps, shift: float, starts: FloatArray, ends: FloatArray, size: Settings
) -> tuple[Solved, BoolArray, Cost]:
    """Solve Abel's equation with the coarse map, and test it off the nodes with the fine one.

    Returns also the intervals of phase (q,) to be refined, should the fault lie there.
    """
    across = abel.widths(shift, starts, ends)
    wear = abel.panel_wear(shift, starts, across, chebyshev_nodes(size.panel_nodes))
    ahead = both.coarse.advance(wear)
    panels = abel.solve(shift, starts, across, ahead.increment)
    check = abel.panel_wear(shift, starts, across, CHECKS)
    fine = both.fine.advance(check, at_checks(ahead, size.finer_nodes))
    residuals = np.abs(abel.residual(panels, CHECKS, fine.increment))
    far = np.max(residuals[:, -2:], axis=1) > FAR_OUT * np.max(residuals[:, :-2], axis=1)
    by_phase = missed_by_phase(ahead, both.coarse.over)
    residual = np.maximum(np.max(residuals, axis=1), np.max(by_phase, axis=1))
    cost = Cost(wear.size + check.size, ahead.evaluations + fine.evaluations)
    step = abel.reach(shift, starts, across, chebyshev_nodes(size.panel_nodes), ahead.increment)
    share = np.where(far, cut_far_out(shift, across), SPLIT)
    if_cut = cycles_if_cut(2 / step[..., 0], share)
    solved = Solved(starts, ends, panels.series, residual, share, if_cut)
    rough = ~ahead.converged
    hazy = by_phase > size.residual_tolerance
    share_of_one = size.residual_tolerance / (MISSED * len(rough))
    rough |= unresolved(ahead.rate[hazy], both.coarse.over, share_of_one)
    worst = ~(residual <= size.residual_tolerance)
    if worst.any():
        again = both.coarse.advance(check[worst])
        cost = cost.plus(again.increment.size, again.evaluations)
        apart = np.max(np.abs(again.increment / fine.increment[worst] - 1.0))
        # Only what the two maps differ by is a fault of the phase.
        if not apart < max(size.residual_tolerance / 4, np.max(residual[worst]) / 10):
            rates = again.rate.reshape(-1, *again.rate.shape[-2:])
            rough |= unresolved(rates, both.coarse.over, size.phase_tolerance)
            rough |= ~rough.any()
    return solved, rough, cost


class Filled(NamedTuple):
    """Panels with Abel's equation solved, or the intervals `rough` (q,) of phase to refine first;
    `cost` is that of all so far."""

    solved: Solved
    rough: BoolArray
    cost: Cost


def fill(both: Maps, shift: float, edges: FloatArray, size: Settings, cost: Cost) -> Filled:
    """Solve panels between `edges` (mm), and cut those with too large a residual."""
    starts, ends = edges[:-1], edges[1:]
    done = Solved(NONE, NONE, np.empty((0, size.panel_nodes)), NONE, NONE, NONE)
    for rounds in range(MOST_ROUNDS):
        fresh, rough, spent = solve_panels(both, shift, starts, ends, size)
        cost = cost.plus(*spent)
        worst = ~(fresh.residual <= size.residual_tolerance)
        # A panel of few cycles would hide an oscillation.
        worst &= ~(fresh.if_cut < size.panel_nodes)
        last = rounds == MOST_ROUNDS - 1 or len(done.starts) + len(starts) > MOST_PANELS
        if rough.any() or last or not worst.any():
            break
        done = done.joined(fresh.where(~worst))
        starts, ends = halves(shift, starts[worst], ends[worst], fresh.share[worst])
    return Filled(done.joined(fresh), rough, cost)
