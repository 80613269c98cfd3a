"""Abel's equation n(P(u)) = n(u) + 1: the number of cycles n as a function of the wear u.

The unknown is the logarithm of the density dn/dy in y = ln(u + c), a Chebyshev series on each
panel of y. Where a cycle takes y to y + d, the equation is: the integral of the density from y to
y + d is 1. Collocated at the Chebyshev nodes it is solved by Newton's method, all panels at once.
See docs/method.md.
"""

from functools import lru_cache
from typing import NamedTuple

import numpy as np

from wear.count.collocation import (
    FloatArray,
    Gauss,
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
PROBES = 32  # of the density on a panel, to choose its parts
PART_GROWTH = 1.2  # of the logarithm of the density within a part, at most

Shift = float | FloatArray


class Panels(NamedTuple):
    """Panels of y = ln(u + shift) from wear `starts` (mm) over `widths` (in y); `series`
    (panels, m) holds the Chebyshev coefficients of ln(dn/dy).

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

    Written so that wear much smaller than the shift keeps its digits.
    """
    y = across[:, None] * ((t + 1) / 2)
    wear: FloatArray = starts[:, None] + (starts + shift)[:, None] * np.expm1(y)
    return wear


def _steps(
    shift: Shift, starts: FloatArray, across: FloatArray, t: FloatArray, increments: FloatArray
) -> FloatArray:
    """How far a cycle goes in y, from the positions `t` of each panel."""
    y = across[:, None] * ((t + 1) / 2)
    return np.log1p(increments / ((starts + shift)[:, None] * np.exp(y)))


def solve(shift: Shift, starts: FloatArray, across: FloatArray, increments: FloatArray) -> Panels:
    """The density on every panel, from the wear that a cycle adds at its Chebyshev nodes.

    `increments` (panels, m) in mm. Newton's method, from the density 1/d, which is exact when the
    density does not change within a cycle; near the solution its slope hardly changes.
    """
    m = increments.shape[1]
    nodes = chebyshev_nodes(m)
    steps = _steps(shift, starts, across, nodes, increments)
    reach = (2 / across)[:, None] * steps
    change = np.diff(np.log(steps), axis=1) / np.diff(nodes)
    change *= np.maximum(reach[:, 1:], reach[:, :-1])
    rule = gauss(ACROSS_A_CYCLE if np.max(np.abs(change)) < 0.5 else ACROSS_A_FAST_CYCLE)
    basis = _within(nodes, reach, rule, m)
    weights = steps[..., None] * rule.weights
    series = -np.log(steps) @ chebyshev_analysis(m).T
    inverse = None
    with np.errstate(all="ignore"):  # far too wide a panel: its series is no number
        for _ in range(MOST_ITERATIONS):
            density, cycles = _density(series, basis, weights)
            if inverse is None or np.any(np.abs(change) > STEADY):
                inverse = _inverse_slope(density, cycles, basis)
            change = (inverse @ -np.log(cycles)[..., None])[..., 0]
            series = series + change
            if not np.any(np.abs(change) >= 1e-13):
                break
    return Panels(shift, starts, across, series)


def _within(t: FloatArray, reach: FloatArray, rule: Gauss, m: int) -> FloatArray:
    """The Chebyshev polynomials within cycles that start at the positions `t` (k,) of each panel
    and `reach` so far beyond (panels, k), at the nodes of a rule: shape (panels, m, k, nodes)."""
    return np.moveaxis(chebyshev_values(t[:, None] + reach[..., None] * rule.nodes, m), -1, 1)


def _density(
    series: FloatArray, basis: FloatArray, weights: FloatArray
) -> tuple[FloatArray, FloatArray]:
    """The density dn/dy times `weights` (panels, k, nodes) and its sums, the cycles (panels, k)."""
    flat = basis.reshape(*series.shape, -1)
    density = np.exp((series[:, None] @ flat).reshape(weights.shape)) * weights
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
    steps = _steps(panels.shift, panels.starts, panels.widths, t, increments)
    rule = gauss(ACROSS_A_FAST_CYCLE)
    reach = (2 / panels.widths)[:, None] * steps
    basis = _within(t, reach, rule, panels.series.shape[1])
    with np.errstate(all="ignore"):  # of a panel far too wide: infinite or no number
        cycles = _density(panels.series, basis, steps[..., None] * rule.weights)[1]
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
    steps = np.exp(-after.series @ chebyshev_values(np.array([-1.0]), m)[0])
    within = 2 * steps[:, None] * rule.nodes
    beyond = chebyshev_values(1 + within / before.widths[:, None], m)
    inside = chebyshev_values(-1 + within / after.widths[:, None], m)
    left = np.exp((beyond @ before.series[..., None])[..., 0])
    right = np.exp((inside @ after.series[..., None])[..., 0])
    apart = ((left - right) * steps[:, None]) @ rule.integrate.T
    result: FloatArray = np.max(np.abs(apart), axis=1)
    return result


class Count(NamedTuple):
    """n(u) and its inverse on consecutive parts of panels; all arrays run along the parts.

    `wear` u (mm), `offset` u + shift (mm) and `cycles` n where a part starts; its `length` in y and
    its `gain` in n; `series` (q, 2, parts): coefficients of the powers of z of dn/dx and of the
    bend of n, see `_part_values`, x = (z + 1)/2 from 0 to 1 on the part.
    Every part counts from its own start, so that neither n nor u loses digits to a difference.
    """

    wear: FloatArray
    offset: FloatArray
    cycles: FloatArray
    length: FloatArray
    gain: FloatArray
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
    m = panels.series.shape[1]
    growth = np.diff(panels.series @ _positions(1, PROBES, m), axis=1)
    parts = int(max(6.0, np.ceil(np.max(np.abs(growth)) * growth.shape[1] / PART_GROWTH)))
    rule = gauss(PART_NODES)
    length = np.repeat(panels.widths / parts, parts)
    density = np.exp(panels.series @ _positions(parts, PART_NODES, m)).reshape(len(length), -1)
    density *= length[:, None]
    gain = density @ rule.weights
    cycles = first + np.concatenate([[0.0], np.cumsum(gain[:-1])])
    y = panels.widths[:, None] * (np.arange(parts) / parts)
    start = (panels.starts + panels.shift)[:, None]
    wear = panels.starts[:, None] + start * np.expm1(y)
    offset = start * np.exp(y)
    # By Legendre coefficients: the high ones are small, and so are the powers they turn to.
    series = np.moveaxis(_powers(PART_NODES) @ (rule.coefficients @ density.T), 0, 1)
    return Count(wear.ravel(), offset.ravel(), cycles, length, gain, series)


@lru_cache(maxsize=32)
def _positions(parts: int, nodes: int, m: int) -> FloatArray:
    """The Chebyshev polynomials (m, parts * nodes) at Gauss nodes of equal parts of a panel."""
    at = (np.arange(parts)[:, None] + gauss(nodes).nodes) * (2 / parts) - 1
    return np.ascontiguousarray(chebyshev_values(at.ravel(), m).T)


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
