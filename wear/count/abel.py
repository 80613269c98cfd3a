"""Abel's equation n(P(u)) = n(u) + 1: the number of cycles n as a function of the wear u.

The unknown is the logarithm of the density dn/dy in y = ln(u + c), a Chebyshev series on each
panel of y. Where a cycle takes y to y + d, the equation is: the integral of the density from y to
y + d is 1. Collocated at the Chebyshev nodes it is solved by Newton's method, all panels at once.
See docs/method.md.
"""

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
PART_NODES = 16  # for n(u) and its inverse, on each part of a panel
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

    `increments` (panels, m) in mm. Newton's method from the density 1/d, which is exact when the
    density does not change within a cycle.
    """
    m = increments.shape[1]
    nodes = chebyshev_nodes(m)
    steps = _steps(shift, starts, across, nodes, increments)
    reach = (2 / across)[:, None] * steps
    change = np.diff(np.log(steps), axis=1) / np.diff(nodes)
    change *= np.maximum(reach[:, 1:], reach[:, :-1])
    rule = gauss(ACROSS_A_CYCLE if np.max(np.abs(change)) < 0.5 else ACROSS_A_FAST_CYCLE)
    basis = chebyshev_values(nodes[:, None] + reach[..., None] * rule.nodes, m)
    weights = steps[..., None] * rule.weights
    series = -np.log(steps) @ chebyshev_analysis(m).T
    for _ in range(12):
        with np.errstate(all="ignore"):  # far too wide a panel: its series is no number
            density = np.exp((basis @ series[:, None, :, None])[..., 0]) * weights
            cycles = np.sum(density, axis=-1)
            slope = (density[..., None, :] @ basis)[..., 0, :] / cycles[..., None]
            lost = ~np.isfinite(slope).all(axis=(1, 2))
            slope[lost] = np.eye(m)
            change = np.linalg.solve(slope, -np.log(cycles)[..., None])[..., 0]
            change[lost] = np.nan
            series = series + change
        if not np.any(np.abs(change) >= 1e-13):
            break
    return Panels(shift, starts, across, series)


def residual(panels: Panels, t: FloatArray, increments: FloatArray) -> FloatArray:
    """ln(n(P(u)) - n(u)) at the positions `t` of each panel: zero for the exact n.

    `increments` (panels, len(t)) in mm, as found for these positions by a finer one-cycle map.
    A residual r means that the density is wrong by a factor 1 - r, about.
    """
    steps = _steps(panels.shift, panels.starts, panels.widths, t, increments)
    rule = gauss(ACROSS_A_FAST_CYCLE)
    at = t[:, None] + (2 / panels.widths)[:, None, None] * steps[..., None] * rule.nodes
    basis = chebyshev_values(at, panels.series.shape[1])
    with np.errstate(all="ignore"):  # of a panel far too wide: infinite or no number
        density = np.exp((basis @ panels.series[:, None, :, None])[..., 0])
        result: FloatArray = np.log(np.sum(density * rule.weights, axis=-1) * steps)
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
    its `gain` in n; `series` (parts, q): Legendre coefficients of dn/dx, x from 0 to 1 on the part.
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
    probes = np.linspace(-1, 1, 33)
    growth = np.diff(panels.series @ chebyshev_values(probes, m).T, axis=1)
    parts = int(max(6.0, np.ceil(np.max(np.abs(growth)) * growth.shape[1] / PART_GROWTH)))
    rule = gauss(PART_NODES)
    position = (np.arange(parts)[:, None] + rule.nodes) * (2 / parts) - 1
    basis = chebyshev_values(position.ravel(), m)
    length = np.repeat(panels.widths / parts, parts)
    density = np.exp(panels.series @ basis.T).reshape(len(length), PART_NODES) * length[:, None]
    gain = density @ rule.weights
    cycles = first + np.concatenate([[0.0], np.cumsum(gain[:-1])])
    begins = np.linspace(-1, 1, parts + 1)[:-1]
    wear = panel_wear(panels.shift, panels.starts, panels.widths, begins)
    y = panels.widths[:, None] * ((begins + 1) / 2)
    offset = (panels.starts + panels.shift)[:, None] * np.exp(y)
    series = density @ rule.coefficients.T
    return Count(wear.ravel(), offset.ravel(), cycles, length, gain, series)


def _part_values(series: FloatArray, x: FloatArray) -> tuple[FloatArray, FloatArray]:
    """Density dn/dx and its integral from 0, at `x` in [0, 1] of parts with these series.

    The integral of P_k from -1 is (z^2 - 1) P_k'(z)/(k (k + 1)), here with z^2 - 1 = -4 x (1 - x):
    a part may hold 1e9 cycles, of which the first few are to keep their digits.
    """
    z = 2 * x - 1
    before, here = np.ones_like(z), z  # P_{k-1}, P_k
    slope_before, slope = np.zeros_like(z), np.ones_like(z)  # their derivatives
    density, bend = series[:, 0].copy(), np.zeros_like(z)
    for k in range(1, series.shape[1]):
        density += series[:, k] * here
        bend += series[:, k] / (k * (k + 1)) * slope
        after = ((2 * k + 1) * z * here - k * before) / (k + 1)
        slope_before, slope = slope, slope_before + (2 * k + 1) * here
        before, here = here, after
    return density, x * (series[:, 0] - 2 * (1 - x) * bend)


def part_of(begins: FloatArray, at: FloatArray) -> IntArray:
    """The part that each value lies in, or the nearest."""
    return np.clip(np.searchsorted(begins, at, side="right") - 1, 0, len(begins) - 1)


def wear_after(table: Count, cycles: FloatArray, part: IntArray) -> tuple[FloatArray, FloatArray]:
    """Wear u (mm) after `cycles`, each inside its `part`, and du/dn (mm per cycle)."""
    series = table.series[part]
    wanted = cycles - table.cycles[part]
    # A density that grows exponentially from one end of the part to the other is close.
    gain = table.gain[part]
    growth = 2 * series[:, 1] / gain
    growth = np.where(np.abs(growth) < 1e-6, 1e-6, growth)
    x = np.log1p(np.clip(wanted / gain, 0.0, 1.0) * np.expm1(growth)) / growth
    for _ in range(20):
        density, total = _part_values(series, x)
        change = (wanted - total) / density
        x = np.clip(x + change, 0.0, 1.0)
        if not np.any(np.abs(change) > 1e-8 * x):  # Newton: the next change would be its square
            break
    offset, length = table.offset[part], table.length[part]
    wear = table.wear[part] + offset * np.expm1(length * x)
    return wear, length * offset * np.exp(length * x) / density


def first_pace(table: Count) -> FloatArray:
    """du/dn (mm per cycle) where each part starts."""
    even, odd = table.series[:, ::2], table.series[:, 1::2]
    density = np.sum(even, axis=1) - np.sum(odd, axis=1)  # P_k(-1) = (-1)^k
    pace: FloatArray = table.length * table.offset / density
    return pace


def cycles_until(table: Count, wear: FloatArray) -> FloatArray:
    """The count n(u), a real number, for wear (mm) inside the range of the table."""
    part = part_of(table.wear, wear)
    x = np.log1p((wear - table.wear[part]) / table.offset[part]) / table.length[part]
    _, total = _part_values(table.series[part], x)
    result: FloatArray = table.cycles[part] + total
    return result
