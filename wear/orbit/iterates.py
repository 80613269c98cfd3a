"""The number of cycles n(u) and its inverse u(n), from the density on panels (`wear.orbit.abel`).

Overview
    A panel is cut into cells on which the density per y = ln(u + c) changes little. Each cell
    counts from its own start, so that neither n nor u loses digits to a difference of large
    numbers.
Key results
    CountTable   n(u) and u(n) on the cells of panels
    Iterates     u after any number of cycles: integrated cycles first, then the table; with the
                 estimated error
"""

from __future__ import annotations

from functools import lru_cache
from typing import NamedTuple

import numpy as np
from numpy.polynomial.chebyshev import chebval

from wear.numerics.chebyshev import chebyshev_nodes, chebyshev_values
from wear.numerics.floating_point import TINY
from wear.numerics.gauss import BoolArray, FloatArray, IntArray, coefficients, gauss, product
from wear.numerics.rows import take
from wear.orbit.abel import Density, level_and_shape
from wear.orbit.panels import PanelCycles

NODES = 16  # on each cell
SERIES = 4  # coefficients of the panel's series that a cell resolves
GROWTH = 1.2  # largest change of the logarithm of the density within a cell
MOST_CELLS = 400  # of a panel
ACCURATE = 1e-8  # relative step of Newton's method: the next would be its square
FLAT = 1e-6  # growth below which an exponential is a straight line to six digits
MOST_NEWTON = 20
NO_DIGIT = 0.1  # relative error: with a larger one the error estimate is void, too
NEARLY = 1 - 1e-9  # of the limit of the states


class CountTable(NamedTuple):
    """n(u) and its inverse on consecutive cells; all arrays run along the cells, those of several
    scenes one after the other.

    State `u`, `offset` u + c and `cycles` n where a cell starts; its `length` in y = ln(u + c), the
    `number` of cycles in it, and the `truncation` error of that. With x from 0 to 1 on the cell and
    z = 2 x - 1, `series` (NODES, 2, cells) has the coefficients of the powers of z of the density
    dn/dx, and of the curvature of n that `_values` defines.
    """

    u: FloatArray
    offset: FloatArray
    cycles: FloatArray
    length: FloatArray
    number: FloatArray
    truncation: FloatArray
    series: FloatArray

    def take(self, which: slice | IntArray) -> CountTable:
        """Return some of the cells."""
        return CountTable(*(array[..., which] for array in self))

    def of_each(self, scenes: int) -> list[CountTable]:
        """Return the table of each scene; all have the same number of cells."""
        size = len(self.u) // scenes
        return [self.take(slice(at, at + size)) for at in range(0, len(self.u), size)]

    @property
    def bounds(self) -> FloatArray:
        """Return u where each cell starts, and where the last one ends."""
        return np.append(self.u, self.ends[-1])

    @property
    def last_cycles(self) -> float:
        """Return n where the last cell ends."""
        return float(self.cycles[-1] + self.number[-1])

    @property
    def ends(self) -> FloatArray:
        """Return u where each cell ends."""
        ends: FloatArray = self.u + self.offset * np.expm1(self.length)
        return ends

    @property
    def first_rate(self) -> FloatArray:
        """Return du/dn per cycle where each cell starts."""
        even, odd = self.series[::2, 0], self.series[1::2, 0]
        density = np.sum(even, axis=0) - np.sum(odd, axis=0)  # at z = -1
        rate: FloatArray = self.length * self.offset / density
        return rate

    def state_after(
        self, cycles: FloatArray, cell: IntArray | None = None
    ) -> tuple[FloatArray, FloatArray]:
        """Return u after `cycles` (k,), each inside its `cell` (found if not given), and du/dn per
        cycle."""
        if cell is None:
            cell = cell_of(self.cycles, cycles)
        series = self.series[..., cell]
        since, number = cycles - self.cycles[cell], self.number[cell]
        # The first guess takes the density as exponential over the cell.
        growth = nonzero(2 * series[1, 0] / number)
        x = np.log1p(np.clip(since / number, 0.0, 1.0) * np.expm1(growth)) / growth
        for _ in range(MOST_NEWTON):
            density, total = _values(series, number, x)
            change = (since - total) / density
            x = np.clip(x + change, 0.0, 1.0)
            if not np.any(np.abs(change) > ACCURATE * x):
                break
        offset, length = self.offset[cell], self.length[cell]
        u = self.u[cell] + offset * np.expm1(length * x)
        return u, length * offset * np.exp(length * x) / density

    def cycles_at(self, u: FloatArray, cell: IntArray | None = None) -> FloatArray:
        """Return the real numbers n(u) for states (k,) inside the range."""
        if cell is None:
            cell = cell_of(self.u, u)
        x = np.log1p((u - self.u[cell]) / self.offset[cell]) / self.length[cell]
        _, total = _values(self.series[..., cell], self.number[cell], x)
        result: FloatArray = self.cycles[cell] + total
        return result


def count_table(
    panels: Density, first: float = 0.0, scenes: int = 1, start: FloatArray | None = None
) -> CountTable:
    """Return n(u), the integral of the density on the panels of some scenes; all scenes have the
    same number of panels, all panels the same number of cells. n is `first` where the first panel
    of a scene starts, or at the states `start` (scenes,) on it."""
    grid = panels.grid
    rule, edges = gauss(NODES), _cell_edges(panels)
    if start is not None:
        c, begins, widths = take(grid, slice(None, None, len(edges) // scenes))
        y = np.log1p((start - begins) / (begins + c))[:, None]
        edges[:: len(edges) // scenes] *= 1.0 - y / widths[:, None]
        edges[:: len(edges) // scenes] += y
    length = np.diff(edges, axis=1)
    y = (edges[:, :-1, None] + length[..., None] * rule.nodes).reshape(len(edges), -1)
    t = 2 * grid.x_of(y) / grid.x_ends[:, None] - 1
    level, shape = level_and_shape(panels.series)
    offset = (grid.starts + grid.c)[:, None]
    density = level * offset * np.exp(chebval(t, shape.T[..., None], tensor=False) + y)
    density = density.reshape(-1, NODES) * length.reshape(-1, 1)
    number = product(density, rule.weights)
    sums = np.cumsum(number.reshape(scenes, -1)[:, :-1], axis=1)
    cycles = (first + np.concatenate([np.zeros((scenes, 1)), sums], axis=1)).ravel()
    y = edges[:, :-1]
    u, offset = grid.starts[:, None] + offset * np.expm1(y), offset * np.exp(y)
    # By Legendre coefficients: the high ones are small, and so are the powers they become.
    legendre = coefficients(rule.coefficients, density)
    truncation = np.max(np.abs(legendre[-2:]), axis=0)
    series = np.stack([coefficients(powers, legendre.T) for powers in _powers(NODES)], axis=1)
    return CountTable(u.ravel(), offset.ravel(), cycles, length.ravel(), number, truncation, series)


def nonzero(growth: FloatArray) -> FloatArray:
    """Return the growth of exponentials, FLAT where it is smaller: one divides by it."""
    return np.where(np.abs(growth) < FLAT, FLAT, growth)


def cell_of(begins: FloatArray, at: FloatArray) -> IntArray:
    """Return the cell in which each value lies, or the nearest."""
    return np.clip(np.searchsorted(begins, at, side="right") - 1, 0, len(begins) - 1)


def _cell_edges(panels: Density) -> FloatArray:
    """Return where to cut every panel into cells, in y from its start (panels, cells + 1), so that
    a cell resolves few coefficients of the series and the density dn/dy grows little on it."""
    m = panels.series.shape[1]
    t, taken, basis = _with_ends(m)
    y = panels.grid.y_at(t)
    y[:, -1] = panels.grid.widths
    growth = np.abs(np.diff(product(panels.series, basis.T) + y, axis=1)) / GROWTH
    growth = np.nan_to_num(np.minimum(growth, MOST_CELLS), nan=0.0)
    cells = np.concatenate([np.zeros((len(y), 1)), np.cumsum(growth, axis=1)], axis=1)
    cells += taken / SERIES
    number = min(int(np.ceil(np.max(cells[:, -1]))), MOST_CELLS)
    share = np.arange(number + 1) / number
    rows = [np.interp(share * row[-1], row, at) for row, at in zip(cells, y, strict=True)]
    return np.array(rows)


@lru_cache(maxsize=4)
def _with_ends(m: int) -> tuple[FloatArray, FloatArray, FloatArray]:
    """Return the Chebyshev nodes with the ends of a panel (m + 2,), the number of m coefficients
    that resolve a function from the start to each, and the polynomials there (m + 2, m)."""
    t = np.concatenate([[-1.0], chebyshev_nodes(m), [1.0]])
    return t, np.concatenate([[0.0], np.arange(m) + 0.5, [float(m)]]), chebyshev_values(t, m)


@lru_cache(maxsize=4)
def _powers(m: int) -> FloatArray:
    """Return the matrices from Legendre coefficients of a density to coefficients of powers, of the
    density and of its curvature: shape (2, m, m)."""
    legendre = np.polynomial.legendre
    matrix = np.zeros((2, m, m))
    for k, unit in enumerate(np.eye(m)):
        matrix[0, : k + 1, k] = legendre.leg2poly(unit[: k + 1])
        if k > 0:
            matrix[1, :k, k] = legendre.leg2poly(legendre.legder(unit[: k + 1])) / (k * (k + 1))
    return matrix


def _values(series: FloatArray, number: FloatArray, x: FloatArray) -> tuple[FloatArray, FloatArray]:
    """Return the density dn/dx and its integral from 0 at `x` (k,) in [0, 1] of cells with these
    series and numbers of cycles.

    The integral of P_k from -1 is (z^2 - 1) P_k'(z)/(k (k + 1)), here with z^2 - 1 = -4 x (1 - x):
    a cell may hold 1e9 cycles, of which the first few are to keep their digits. The curvature is
    the sum of the coefficients times P_k'/(k (k + 1)).
    """
    z = 2 * x - 1
    while len(series) > 1:  # Estrin's scheme: neighbours first, then pairs, each pair as one
        series, z = series[::2] + z * series[1::2], z * z
    density, curvature = series[0]
    return density, x * (number - 2 * (1 - x) * curvature)


class Iterates(NamedTuple):
    """States after any numbers of cycles, of scenes (s,) with equally many integrated cycles and
    cells.

    `transient` (s, k + 1) holds the states after 0, 1, ... k cycles, integrated one by one, and
    `transient_error` their estimated errors. Beyond them the `table` of all scenes counts; the
    estimated error of n where each cell starts and where the last one ends is `count_error`
    (s, cells + 1). Without a table the state stays as it is. States from `limit` (s,) on have no
    meaning. The mesh of phase has `edges` (s, q + 1); `cycles` are those from the nodes of panels
    and from the CHECKS, if they were kept.
    """

    transient: FloatArray
    transient_error: FloatArray
    table: CountTable | None
    density: Density | None
    count_error: FloatArray
    limit: FloatArray
    edges: FloatArray
    cycles: tuple[PanelCycles, ...] = ()

    def take(self, rows: IntArray) -> Iterates:
        """Return some of the scenes."""
        table, density, cycles = self.table, self.density, self.cycles
        if table is not None and density is not None:
            cells = np.arange(len(table.u)).reshape(len(self.transient), -1)[rows].ravel()
            panels = np.arange(len(density.series)).reshape(len(self.transient), -1)[rows].ravel()
            table, density, cycles = table.take(cells), take(density, panels), take(cycles, panels)
        return Iterates(
            self.transient[rows],
            self.transient_error[rows],
            table,
            density,
            self.count_error[rows],
            self.limit[rows],
            self.edges[rows],
            cycles,
        )

    @property
    def integrated_cycles(self) -> int:
        """Return how many cycles were integrated one by one."""
        return int(self.transient.shape[1]) - 1

    @property
    def last_state(self) -> FloatArray:
        """Return the states (s,) up to which the cycles are counted."""
        if self.table is None:
            return np.asarray(self.transient[:, -1])
        return np.asarray(self._rows(self.table.ends)[:, -1])

    @property
    def at_rest(self) -> BoolArray:
        """Return whether the last cycle of each scene (s,) adds nothing: then no cycle after it
        does."""
        moves = np.sum(np.diff(self.transient[:, -2:], axis=1), axis=1) > 0
        return np.asarray(~moves & (self.table is None))

    @property
    def first_idle_cycle(self) -> int:
        """Return the first cycle, counted from 0, that adds nothing to the first scene."""
        return int(np.argmax(np.diff(self.transient[0]) <= 0))

    @property
    def reach(self) -> FloatArray:
        """Return the number of cycles in reach (s,)."""
        if self.table is None:
            return np.where(self.at_rest, np.inf, float(self.integrated_cycles))
        return np.asarray(self._ends[:, -1])

    @property
    def whole_cycles(self) -> FloatArray:
        """Return the number of whole cycles in reach (s,), at rest only those integrated."""
        if self.table is None:
            return np.full(len(self.transient), float(self.integrated_cycles))
        return np.floor(self._ends[:, -1])

    @property
    def first_increment(self) -> FloatArray:
        """Return the increment of the first cycle (s,)."""
        if self.integrated_cycles == 0 and self.table is not None:
            return np.asarray(self._rows(self.table.first_rate)[:, 0])
        return np.asarray(np.sum(np.diff(self.transient[:, :2], axis=1), axis=1))

    @property
    def largest_error(self) -> FloatArray:
        """Return the largest relative error (s,) of the states where cells meet."""
        if self.table is None:
            return np.zeros(len(self.transient))
        rate, u = (self._rows(x)[:, 1:] for x in (self.table.first_rate, self.table.u))
        return np.asarray(np.max(self.count_error[:, 1:-1] * rate / u, axis=1, initial=0.0))

    def after(self, cycles: FloatArray) -> tuple[FloatArray, FloatArray]:
        """Return the states after `cycles` (s, c) and their estimated relative errors, infinite
        where out of reach."""
        number = self.integrated_cycles
        early = cycles <= number if self.table else np.full(cycles.shape, True)
        index = np.minimum(np.where(early, cycles, 0), number).astype(int)
        u = np.take_along_axis(self.transient, index, axis=1)
        error = np.take_along_axis(self.transient_error, index, axis=1)
        if self.table is not None and not early.all():
            late = np.maximum(cycles, float(number))
            cell = self._cell(self._ends[:, :-1], late)
            state, rate = self.table.state_after(late.ravel(), cell.ravel())
            uncertain = _interpolated(late, self._ends, self.count_error)
            u = np.where(early, u, state.reshape(late.shape))
            error = np.where(early, error, rate.reshape(late.shape) * uncertain)
        error = error / np.where(u > 0, u, 1.0)
        limit = self.limit[:, None]
        known = (u < NEARLY * limit) & (error < NO_DIGIT) & (cycles <= self.reach[:, None])
        return np.minimum(u, limit), np.where(known, error, np.inf)

    def until(self, u: FloatArray) -> tuple[FloatArray, FloatArray]:
        """Return the whole cycles after which each state (s, c) is first reached, infinite where
        the count ends before, and the estimated error in cycles."""
        count, error = np.empty(u.shape), np.empty(u.shape)
        for row, states in enumerate(u):
            count[row], error[row] = self._until(row, states)
        if self.table is None:
            return count, error
        late = np.isinf(count) & (u <= self.last_state[:, None])
        if late.any():
            cell = self._cell(self._rows(self.table.u), u)
            exact = self.table.cycles_at(u.ravel(), cell.ravel()).reshape(u.shape)
            uncertain = _interpolated(exact, self._ends, self.count_error)
            count[late] = np.ceil(exact - uncertain)[late]
            error[late] = 2 * uncertain[late]
        return count, error

    def _until(self, row: int, u: FloatArray) -> tuple[FloatArray, FloatArray]:
        """Return cycles and error of one scene by its integrated cycles alone."""
        first, error = self.transient[row], self.transient_error[row]
        # A state that is reached at the very end of a cycle needs no further one.
        known = error <= NO_DIGIT * first
        index = np.searchsorted(first + np.where(known, error, 0.0), u, side="left")
        # Between the least and the largest count, at the rate of the next cycle, which is slower.
        single = self.first_increment[row : row + 1]
        added = np.diff(first) if len(first) > 1 else single
        after, before = np.append(added, added[-1]), np.append(added[0], added)
        after = np.where(after > 0, after, before)[: len(first)]
        uncertainty = np.where(known, 2 * error / (after + TINY), np.inf)
        return np.where(index == len(first), np.inf, index), np.append(uncertainty, 0.0)[index]

    @property
    def _ends(self) -> FloatArray:
        """Return n (s, cells + 1) where each cell starts and where the last one ends."""
        assert self.table is not None
        begins, number = self._rows(self.table.cycles), self._rows(self.table.number)
        return np.concatenate([begins, begins[:, -1:] + number[:, -1:]], axis=1)

    def _rows(self, values: FloatArray) -> FloatArray:
        """Return values at all cells, scene by scene (s, cells)."""
        return values.reshape(len(self.transient), -1)

    def _cell(self, begins: FloatArray, at: FloatArray) -> IntArray:
        """Return the cell in which each value (s, c) lies, among those of all scenes."""
        if len(begins) == 1:
            return cell_of(begins[0], at)
        inside = np.sum(begins[:, 1:, None] <= at[:, None], axis=1)
        return np.asarray(inside + begins.shape[1] * np.arange(len(begins))[:, None])


def _interpolated(at: FloatArray, x: FloatArray, y: FloatArray) -> FloatArray:
    """Return linear interpolation at (s, c) between points x, y (s, n)."""
    return np.stack([np.interp(*row) for row in zip(at, x, y, strict=True)])
