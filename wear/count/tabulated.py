"""The cycle count n(u) and its inverse u(n), from the density on panels (see `wear.count.abel`).

A panel is cut into parts on which the density per y = ln(u + c) changes little. Each part counts
from its own start, so that neither n nor u loses digits to a difference of large numbers.
"""

from functools import lru_cache
from typing import NamedTuple

import numpy as np

from wear.count.abel import Panels, folded, level_and_shape, way
from wear.numerics.chebyshev import chebyshev_nodes, chebyshev_values
from wear.numerics.gauss import (
    FloatArray,
    IntArray,
    gauss,
)

NODES = 16  # on each part
SERIES = 4  # coefficients of the panel's series to each part, at most
GROWTH = 1.2  # of the logarithm of the density within a part, at most
MOST_PARTS = 400


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
    rule, edges = gauss(NODES), _part_edges(panels)
    length = np.diff(edges, axis=1)
    y = (edges[:, :-1, None] + length[..., None] * rule.nodes).reshape(len(edges), -1)
    whole = folded(panels.shift, panels.widths)[:, None]
    t = 2 * folded(panels.shift, y) / whole - 1
    level, shape = level_and_shape(panels.series)
    basis = chebyshev_values(t, panels.series.shape[1])
    offset = (panels.starts + panels.shift)[:, None]
    density = level * offset * np.exp((basis @ shape[..., None])[..., 0] + y)
    density = density.reshape(-1, NODES) * length.reshape(-1, 1)
    gain = density @ rule.weights
    cycles = first + np.concatenate([[0.0], np.cumsum(gain[:-1])])
    y = edges[:, :-1]
    wear, offset = panels.starts[:, None] + offset * np.expm1(y), offset * np.exp(y)
    # By Legendre coefficients: the high ones are small, and so are the powers they turn to.
    legendre = rule.coefficients @ density.T
    missed = np.max(np.abs(legendre[-2:]), axis=0)
    series = np.moveaxis(_powers(NODES) @ legendre, 0, 1)
    return Count(wear.ravel(), offset.ravel(), cycles, length.ravel(), gain, missed, series)


def _part_edges(panels: Panels) -> FloatArray:
    """Where to cut every panel, in y from its start, (panels, parts + 1): into parts on which few
    coefficients of its series count and the density dn/dy grows little."""
    m = panels.series.shape[1]
    t, taken, basis = _with_ends(m)
    y = way(panels.shift, panels.widths, t)
    y[:, -1] = panels.widths
    growth = np.abs(np.diff(panels.series @ basis.T + y, axis=1)) / GROWTH
    growth = np.nan_to_num(np.minimum(growth, MOST_PARTS), nan=0.0)
    wanted = np.concatenate([np.zeros((len(y), 1)), np.cumsum(growth, axis=1)], axis=1)
    wanted += taken / SERIES
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


def wear_after(
    table: Count, cycles: FloatArray, part: IntArray | None = None
) -> tuple[FloatArray, FloatArray]:
    """Wear u (mm) after `cycles`, each inside its `part` (found if not given), and du/dn (mm per
    cycle)."""
    if part is None:
        part = part_of(table.cycles, cycles)
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
