"""Abel's equation n(P(u)) = n(u) + 1: the number of cycles n as a function of the wear u.

The unknown is the logarithm of the density dn/du, a Chebyshev series in u/(u + c) on each panel
of wear: one panel may reach as far as wear ever goes. Where a cycle adds d to u, the equation is:
the integral of the density from u to u + d is 1. Collocated at the Chebyshev nodes it is solved by
Newton's method, all panels at once.
See docs/method.md.
"""

import math
from typing import NamedTuple

import numpy as np

from wear.numerics.chebyshev import chebyshev_analysis, chebyshev_nodes, chebyshev_values
from wear.numerics.gauss import (
    FloatArray,
    gauss,
)

ACROSS_A_CYCLE = 6  # Gauss nodes where the density changes by less than a factor 2 in a cycle
ACROSS_A_FAST_CYCLE = 12  # good to rounding for a factor of 1e3
ACROSS_JUDGED = 24  # more than in any solution, or both would miss the same
MOST_ITERATIONS = 30
STEADY = 0.3  # change of ln(density) after which Newton's method goes on with the same slope

WHOLE = np.ones(1)  # a cycle

Shift = float | FloatArray


class Panels(NamedTuple):
    """Panels of wear from `starts` (mm) over `widths` in y = ln(u + shift); `series` (panels, m)
    holds the Chebyshev coefficients of ln(dn/du) in x = (u - start)/(u + shift), which is
    1 - exp(-y) with y from the start; or in y itself where the shift is zero: then wear has no
    scale.

    The `shift` (mm) is one for all or one a panel, so that panels of many scenes go together.
    """

    shift: Shift
    starts: FloatArray
    widths: FloatArray
    series: FloatArray

    def take(self, chosen: slice) -> "Panels":
        """Some of the panels."""
        shift = self.shift if isinstance(self.shift, float) else self.shift[chosen]
        return Panels(shift, self.starts[chosen], self.widths[chosen], self.series[chosen])


def widths(shift: Shift, starts: FloatArray, ends: FloatArray) -> FloatArray:
    """The widths in y of panels between two wears (mm)."""
    return np.log1p((ends - starts) / (starts + shift))


def panel_wear(shift: Shift, starts: FloatArray, across: FloatArray, t: FloatArray) -> FloatArray:
    """Wear (mm) at the positions `t` in [-1, 1] of panels `across` wide, (panels, len(t)).

    Written so that wear much smaller than the shift keeps its digits. Of wear much larger only the
    position is exact, which is all that a series in x feels.
    """
    y = way(shift, across, t)
    wear: FloatArray = starts[:, None] + (starts + shift)[:, None] * np.expm1(y)
    return wear


def folded(shift: Shift, y: FloatArray) -> FloatArray:
    """The coordinate x of y."""
    return y if _without_scale(shift) else -np.expm1(-y)


def way(shift: Shift, across: FloatArray, t: FloatArray) -> FloatArray:
    """The y from the start of each panel at the positions `t` (k,), (panels, k)."""
    x = folded(shift, across)[:, None] * ((t + 1) / 2)
    y: FloatArray = x if _without_scale(shift) else -np.log1p(-x)
    return y


def _without_scale(shift: Shift) -> bool:
    return isinstance(shift, float) and shift == 0.0


def positions(shift: Shift, start: FloatArray, across: FloatArray, wear: FloatArray) -> FloatArray:
    """The positions t in [-1, 1] of `wear` (mm) on one panel, or each on its own."""
    y = np.log1p((wear - start) / (start + shift))
    result: FloatArray = 2 * folded(shift, y) / folded(shift, across) - 1
    return result


def solve(shift: Shift, starts: FloatArray, across: FloatArray, increments: FloatArray) -> Panels:
    """The density on every panel, from the wear that a cycle adds at its Chebyshev nodes.

    `increments` (panels, m) in mm. Newton's method, from the density 1/increment, which is exact
    when the density does not change within a cycle; near the solution its slope hardly changes.
    """
    m = increments.shape[1]
    nodes = chebyshev_nodes(m)
    step = reach(shift, starts, across, nodes, increments)[..., 0]
    gentle = np.max(change_in_a_cycle(np.log(increments), step)) < 0.5
    rule = gauss(ACROSS_A_CYCLE if gentle else ACROSS_A_FAST_CYCLE)
    basis = _within(nodes, reach(shift, starts, across, nodes, increments, rule.nodes), m)
    pace = increments[:, -1:]
    weights = (increments / pace)[..., None] * rule.weights
    series = -np.log(increments / pace) @ chebyshev_analysis(m).T
    change, inverse = np.zeros_like(series), None
    with np.errstate(all="ignore"):  # far too wide a panel: its series is no number
        for _ in range(MOST_ITERATIONS):
            density, cycles = _density(series, basis, weights)
            if inverse is None or np.any(np.abs(change) > STEADY):
                inverse = _inverse_slope(density, cycles, basis)
            change = (inverse @ -np.log(cycles)[..., None])[..., 0]
            series = series + change
            if not np.any(np.abs(change) >= 1e-13):
                break
    series[:, :1] -= np.log(pace)
    return Panels(shift, starts, across, series)


def change_in_a_cycle(density: FloatArray, step: FloatArray) -> FloatArray:
    """By how much the logarithm of the `density` (panels, m) at the Chebyshev nodes of panels
    changes within a cycle that takes a `step` in t (panels, m), at most, (panels,)."""
    slope = np.abs(np.diff(density, axis=1)) / np.diff(chebyshev_nodes(density.shape[1]))
    change: FloatArray = np.max(slope * np.maximum(step[:, 1:], step[:, :-1]), axis=1)
    return change


def reach(
    shift: Shift,
    starts: FloatArray,
    across: FloatArray,
    t: FloatArray,
    increments: FloatArray,
    within: FloatArray = WHOLE,
) -> FloatArray:
    """How far in t the parts `within` (n,) of a cycle go from the positions `t` (k,) of each panel,
    (panels, k, n), if the cycle adds `increments` (panels, k) mm."""
    left = np.exp(-way(shift, across, t))
    part = (left * increments / (starts + shift)[:, None])[..., None] * within
    step = folded(shift, np.log1p(part)) * (2 / folded(shift, across))[:, None, None]
    if _without_scale(shift):
        return step
    step *= left[..., None]
    return step


def _within(t: FloatArray, steps: FloatArray, m: int) -> FloatArray:
    """The Chebyshev polynomials within cycles that start at the positions `t` (k,) of each panel,
    the `steps` (panels, k, nodes) beyond: shape (panels, m, k, nodes)."""
    return np.moveaxis(chebyshev_values(t[:, None] + steps, m), -1, 1)


def _density(
    series: FloatArray, basis: FloatArray, weights: FloatArray
) -> tuple[FloatArray, FloatArray]:
    """The density dn/du times `weights` (panels, k, nodes) and its sums, the cycles (panels, k)."""
    panels, m, *rest = basis.shape
    logarithm = (series[:, None] @ basis.reshape(panels, m, math.prod(rest))).reshape(panels, *rest)
    density = np.exp(logarithm) * weights
    return density, np.sum(density, axis=-1)


def _inverse_slope(density: FloatArray, cycles: FloatArray, basis: FloatArray) -> FloatArray:
    """The inverse (panels, m, m) of the derivative of ln(cycles) with respect to the series; no
    number where there is none."""
    slope = np.einsum("pig,pkig->pik", density, basis) / cycles[..., None]
    lost = ~np.isfinite(slope).all(axis=(1, 2))
    slope[lost] = np.eye(slope.shape[1])
    inverse: FloatArray = np.linalg.inv(slope)
    inverse[lost] = np.nan
    return inverse


def residual(panels: Panels, t: FloatArray, increments: FloatArray) -> FloatArray:
    """ln(n(P(u)) - n(u)) at the positions `t` of each panel: zero for the exact n.

    `increments` (panels, len(t)) in mm, as found for these positions by a finer one-cycle map.
    A residual r means that the density is wrong by a factor 1 - r, about.
    """
    rule = gauss(ACROSS_JUDGED)
    steps = reach(panels.shift, panels.starts, panels.widths, t, increments, rule.nodes)
    basis = _within(t, steps, panels.series.shape[1])
    with np.errstate(all="ignore"):  # of a panel far too wide: infinite or no number
        level, shape = level_and_shape(panels.series)
        cycles = _density(shape, basis, (level * increments)[..., None] * rule.weights)[1]
        result: FloatArray = np.log(cycles)
    return result


def junctions(before: Panels, after: Panels) -> FloatArray:
    """By how many cycles the counts of two neighbours part within a cycle of their junction.

    Abel's equation leaves a function of period 1 in n free. Every panel picks its own: that does
    no harm within a panel, but where two meet it shifts the count. One value for every panel of
    `before` and its neighbour in `after`.
    """
    m = before.series.shape[1]
    rule = gauss(ACROSS_A_FAST_CYCLE)
    level, shape = level_and_shape(after.series)
    steps = np.exp(-shape @ chebyshev_values(np.array([-1.0]), m).T) / level
    apart = np.zeros((len(steps), len(rule.nodes)))
    for side, t in ((before, 1.0), (after, -1.0)):
        at = np.array([t])
        basis = _within(at, reach(side.shift, side.starts, side.widths, at, steps, rule.nodes), m)
        level, shape = level_and_shape(side.series)
        apart += t * _density(shape, basis, (level * steps)[..., None])[0][:, 0]
    result: FloatArray = np.max(np.abs(apart @ rule.integrate.T), axis=1)
    return result


def level_and_shape(series: FloatArray) -> tuple[FloatArray, FloatArray]:
    """The mean level of the density (panels, 1) and the series of the logarithm less it: a large
    constant would cost the logarithm its last digits."""
    shape = series.copy()
    shape[:, 0] = 0.0
    return np.exp(series[:, :1]), shape
