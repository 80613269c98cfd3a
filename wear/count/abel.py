"""Abel's equation n(P(u)) = n(u) + 1: the number of cycles n as a function of the wear u.

The unknown is the logarithm of the density dn/du, a Chebyshev series in u/(u + c) on each panel
of wear: one panel may reach as far as wear ever goes. Where a cycle adds d to u, the equation is:
the integral of the density from u to u + d is 1. Collocated at the Chebyshev nodes it is solved by
Newton's method, all panels at once.
See docs/method.md.
"""

import math
from functools import lru_cache
from typing import NamedTuple

import numpy as np

from wear.count.collocation import (
    FloatArray,
    IntArray,
    chebyshev_analysis,
    chebyshev_nodes,
    chebyshev_values,
    gauss,
)

ACROSS_A_CYCLE = 6  # Gauss nodes where the density changes by less than a factor 2 in a cycle
ACROSS_A_FAST_CYCLE = 12  # good to rounding for a factor of 1e3
MOST_ITERATIONS = 30
STEADY = 0.3  # change of ln(density) after which Newton's method goes on with the same slope
PART_NODES = 16  # for n(u) and its inverse, on each part of a panel
PART_SERIES = 4  # coefficients of the panel's series to each part, at most
PART_GROWTH = 1.2  # of the logarithm of the density within a part, at most
MOST_PARTS = 400

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
    y = _way(shift, across, t)
    wear: FloatArray = starts[:, None] + (starts + shift)[:, None] * np.expm1(y)
    return wear


def _folded(shift: Shift, y: FloatArray) -> FloatArray:
    """The coordinate x of y."""
    return y if _without_scale(shift) else -np.expm1(-y)


def _way(shift: Shift, across: FloatArray, t: FloatArray) -> FloatArray:
    """The y from the start of each panel at the positions `t` (k,), (panels, k)."""
    x = _folded(shift, across)[:, None] * ((t + 1) / 2)
    y: FloatArray = x if _without_scale(shift) else -np.log1p(-x)
    return y


def _without_scale(shift: Shift) -> bool:
    return isinstance(shift, float) and shift == 0.0


def positions(shift: Shift, start: FloatArray, across: FloatArray, wear: FloatArray) -> FloatArray:
    """The positions t in [-1, 1] of `wear` (mm) on one panel, or each on its own."""
    y = np.log1p((wear - start) / (start + shift))
    result: FloatArray = 2 * _folded(shift, y) / _folded(shift, across) - 1
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
    left = np.exp(-_way(shift, across, t))
    part = (left * increments / (starts + shift)[:, None])[..., None] * within
    step = _folded(shift, np.log1p(part)) * (2 / _folded(shift, across))[:, None, None]
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
    rule = gauss(ACROSS_A_FAST_CYCLE)
    steps = reach(panels.shift, panels.starts, panels.widths, t, increments, rule.nodes)
    basis = _within(t, steps, panels.series.shape[1])
    with np.errstate(all="ignore"):  # of a panel far too wide: infinite or no number
        level, shape = _level_and_shape(panels.series)
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
    level, shape = _level_and_shape(after.series)
    steps = np.exp(-shape @ chebyshev_values(np.array([-1.0]), m).T) / level
    apart = np.zeros((len(steps), len(rule.nodes)))
    for side, t in ((before, 1.0), (after, -1.0)):
        at = np.array([t])
        basis = _within(at, reach(side.shift, side.starts, side.widths, at, steps, rule.nodes), m)
        level, shape = _level_and_shape(side.series)
        apart += t * _density(shape, basis, (level * steps)[..., None])[0][:, 0]
    result: FloatArray = np.max(np.abs(apart @ rule.integrate.T), axis=1)
    return result


class Count(NamedTuple):
    """n(u) and its inverse on consecutive parts of panels; all arrays run along the parts.

    `wear` u (mm), `offset` u + shift (mm) and `cycles` n where a part starts; its `length` in
    y = ln(u + shift), its `gain` in n, and what n may have `missed` within; `series` (q, 2, parts):
    coefficients of the powers of z of dn/dx and of the bend of n, see `_part_values`, where x goes
    from 0 to 1 on the part and x = (z + 1)/2.
    Every part counts from its own start, so that neither n nor u loses digits to a difference.
    """

    wear: FloatArray
    offset: FloatArray
    cycles: FloatArray
    length: FloatArray
    gain: FloatArray
    missed: FloatArray
    series: FloatArray

    @property
    def last_cycles(self) -> float:
        """n where the last part ends."""
        return float(self.cycles[-1] + self.gain[-1])

    @property
    def last_wear(self) -> float:
        """u (mm) where the last part ends."""
        return float(self.wear[-1] + self.offset[-1] * np.expm1(self.length[-1]))


def count(panels: Panels, first: float) -> Count:
    """Integrate the density; n is `first` at the start of the first panel."""
    rule, edges = gauss(PART_NODES), _part_edges(panels)
    length = np.diff(edges, axis=1)
    y = (edges[:, :-1, None] + length[..., None] * rule.nodes).reshape(len(edges), -1)
    whole = _folded(panels.shift, panels.widths)[:, None]
    t = 2 * _folded(panels.shift, y) / whole - 1
    level, shape = _level_and_shape(panels.series)
    basis = chebyshev_values(t, panels.series.shape[1])
    offset = (panels.starts + panels.shift)[:, None]
    density = level * offset * np.exp((basis @ shape[..., None])[..., 0] + y)
    density = density.reshape(-1, PART_NODES) * length.reshape(-1, 1)
    gain = density @ rule.weights
    cycles = first + np.concatenate([[0.0], np.cumsum(gain[:-1])])
    y = edges[:, :-1]
    wear, offset = panels.starts[:, None] + offset * np.expm1(y), offset * np.exp(y)
    # By Legendre coefficients: the high ones are small, and so are the powers they turn to.
    legendre = rule.coefficients @ density.T
    missed = np.max(np.abs(legendre[-2:]), axis=0)
    series = np.moveaxis(_powers(PART_NODES) @ legendre, 0, 1)
    return Count(wear.ravel(), offset.ravel(), cycles, length.ravel(), gain, missed, series)


def _part_edges(panels: Panels) -> FloatArray:
    """Where to cut every panel, in y from its start, (panels, parts + 1): into parts on which few
    coefficients of its series count and the density dn/dy grows little."""
    m = panels.series.shape[1]
    t, taken, basis = _with_ends(m)
    y = _way(panels.shift, panels.widths, t)
    y[:, -1] = panels.widths
    growth = np.abs(np.diff(panels.series @ basis.T + y, axis=1)) / PART_GROWTH
    growth = np.nan_to_num(np.minimum(growth, MOST_PARTS), nan=0.0)
    wanted = np.concatenate([np.zeros((len(y), 1)), np.cumsum(growth, axis=1)], axis=1)
    wanted += taken / PART_SERIES
    parts = min(int(np.ceil(np.max(wanted[:, -1]))), MOST_PARTS)
    share = np.arange(parts + 1) / parts
    rows = [np.interp(share * row[-1], row, at) for row, at in zip(wanted, y, strict=True)]
    return np.array(rows)


@lru_cache(maxsize=4)
def _with_ends(m: int) -> tuple[FloatArray, FloatArray, FloatArray]:
    """The Chebyshev nodes and the ends of a panel (m + 2,), how many of m coefficients it takes to
    resolve a function from the start up to there, and the polynomials there (m + 2, m)."""
    t = np.concatenate([[-1.0], chebyshev_nodes(m), [1.0]])
    return t, np.concatenate([[0.0], np.arange(m) + 0.5, [float(m)]]), chebyshev_values(t, m)


def _level_and_shape(series: FloatArray) -> tuple[FloatArray, FloatArray]:
    """The mean level of the density (panels, 1) and the series of the logarithm less it: a large
    constant would cost the logarithm its last digits."""
    shape = series.copy()
    shape[:, 0] = 0.0
    return np.exp(series[:, :1]), shape


@lru_cache(maxsize=4)
def _powers(m: int) -> FloatArray:
    """From Legendre coefficients of a density to coefficients of powers, of the density and of its
    bend: shape (2, m, m)."""
    legendre = np.polynomial.legendre
    matrix = np.zeros((2, m, m))
    for k, unit in enumerate(np.eye(m)):
        matrix[0, : k + 1, k] = legendre.leg2poly(unit[: k + 1])
        if k > 0:
            matrix[1, :k, k] = legendre.leg2poly(legendre.legder(unit[: k + 1])) / (k * (k + 1))
    return matrix


def _part_values(
    series: FloatArray, gain: FloatArray, x: FloatArray
) -> tuple[FloatArray, FloatArray]:
    """Density dn/dx and its integral from 0, at `x` (n,) in [0, 1] of parts with these series.

    The integral of P_k from -1 is (z^2 - 1) P_k'(z)/(k (k + 1)), here with z^2 - 1 = -4 x (1 - x):
    a part may hold 1e9 cycles, of which the first few are to keep their digits. The bend is the sum
    of the coefficients times P_k'/(k (k + 1)).
    """
    z = 2 * x - 1
    values = series[-1] * z
    for coefficients in series[-2:0:-1]:
        values += coefficients
        values *= z
    density, bend = values + series[0]
    return density, x * (gain - 2 * (1 - x) * bend)


def part_of(begins: FloatArray, at: FloatArray) -> IntArray:
    """The part that each value lies in, or the nearest."""
    return np.clip(np.searchsorted(begins, at, side="right") - 1, 0, len(begins) - 1)


def wear_after(table: Count, cycles: FloatArray, part: IntArray) -> tuple[FloatArray, FloatArray]:
    """Wear u (mm) after `cycles`, each inside its `part`, and du/dn (mm per cycle)."""
    series = table.series[..., part]
    wanted = cycles - table.cycles[part]
    # A density that grows exponentially from one end of the part to the other is close.
    gain = table.gain[part]
    growth = 2 * series[1, 0] / gain
    growth = np.where(np.abs(growth) < 1e-6, 1e-6, growth)
    x = np.log1p(np.clip(wanted / gain, 0.0, 1.0) * np.expm1(growth)) / growth
    for _ in range(20):
        density, total = _part_values(series, gain, x)
        change = (wanted - total) / density
        x = np.clip(x + change, 0.0, 1.0)
        if not np.any(np.abs(change) > 1e-8 * x):  # Newton: the next change would be its square
            break
    offset, length = table.offset[part], table.length[part]
    wear = table.wear[part] + offset * np.expm1(length * x)
    return wear, length * offset * np.exp(length * x) / density


def first_pace(table: Count) -> FloatArray:
    """du/dn (mm per cycle) where each part starts."""
    even, odd = table.series[::2, 0], table.series[1::2, 0]
    density = np.sum(even, axis=0) - np.sum(odd, axis=0)  # at z = -1
    pace: FloatArray = table.length * table.offset / density
    return pace


def cycles_until(table: Count, wear: FloatArray) -> FloatArray:
    """The count n(u), a real number, for wear (mm) inside the range of the table."""
    part = part_of(table.wear, wear)
    x = np.log1p((wear - table.wear[part]) / table.offset[part]) / table.length[part]
    _, total = _part_values(table.series[..., part], table.gain[part], x)
    result: FloatArray = table.cycles[part] + total
    return result
