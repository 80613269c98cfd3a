"""The number of cycles n(u) and its inverse u(n), from the density on panels (`wear.orbit.abel`).

Overview
    A panel is cut into cells on which the density per y = ln(u + c) changes little. Each cell
    counts from its own start, so that neither n nor u loses digits to a difference of large
    numbers.
Key results
    Cells        n(u) and u(n) on the cells of panels
    Iterates     u after any number of cycles, of scenes with as many panels: integrated cycles
                 first, then cells; with the estimated error
"""

from __future__ import annotations

from collections.abc import Sequence
from functools import lru_cache
from typing import NamedTuple

import numpy as np
from numpy.polynomial.chebyshev import chebval

from wear.numerics.chebyshev import chebyshev_nodes, chebyshev_values
from wear.numerics.floating_point import TINY
from wear.numerics.gauss import BoolArray, FloatArray, IntArray, coefficients, gauss, product
from wear.numerics.rows import take
from wear.orbit.abel import Panels, level_and_shape
from wear.orbit.panels import PanelCycles

NODES = 16  # on each cell
SERIES = 4  # coefficients of the panel's series to each cell, at most
GROWTH = 1.2  # of the logarithm of the density within a cell, at most
MOST_CELLS = 400
ACCURATE = 1e-8  # relative step of Newton's method: the next would be its square
MOST_NEWTON = 20
NO_DIGIT = 0.1  # relative error: with a larger one the error estimate is void, too
NEARLY = 1 - 1e-9  # of the limit of the states


class Cells(NamedTuple):
    """n(u) and its inverse on consecutive cells; all arrays run along the cells, those of several
    scenes one after the other.

    State `u`, `offset` u + c and `cycles` n where a cell starts; its `length` in y = ln(u + c), the
    number of cycles in it, `gain`, and the `truncation` error of that; `series` (NODES, 2, cells):
    coefficients of the powers of z of dn/dx and of the curvature of n, see `_values`, where x goes
    from 0 to 1 on the cell and x = (z + 1)/2.
    """

    u: FloatArray
    offset: FloatArray
    cycles: FloatArray
    length: FloatArray
    gain: FloatArray
    truncation: FloatArray
    series: FloatArray

    def take(self, which: slice | IntArray) -> Cells:
        """Return some of the cells."""
        return Cells(*(array[..., which] for array in self))

    def parts(self, scenes: int) -> list[Cells]:
        """Return the cells of each of some scenes that have as many."""
        size = len(self.u) // scenes
        return [self.take(slice(at, at + size)) for at in range(0, len(self.u), size)]

    @property
    def bounds(self) -> FloatArray:
        """Return u where each cell starts, and where the last one ends."""
        return np.append(self.u, self.ends[-1])

    @property
    def last_cycles(self) -> float:
        """Return n where the last cell ends."""
        return float(self.cycles[-1] + self.gain[-1])

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
        since, gain = cycles - self.cycles[cell], self.gain[cell]
        # A density that grows exponentially from one end of the cell to the other is close.
        growth = 2 * series[1, 0] / gain
        growth = np.where(np.abs(growth) < 1e-6, 1e-6, growth)
        x = np.log1p(np.clip(since / gain, 0.0, 1.0) * np.expm1(growth)) / growth
        for _ in range(MOST_NEWTON):
            density, total = _values(series, gain, x)
            change = (since - total) / density
            x = np.clip(x + change, 0.0, 1.0)
            if not np.any(np.abs(change) > ACCURATE * x):
                break
        offset, length = self.offset[cell], self.length[cell]
        u = self.u[cell] + offset * np.expm1(length * x)
        return u, length * offset * np.exp(length * x) / density

    def cycles_until(self, u: FloatArray, cell: IntArray | None = None) -> FloatArray:
        """Return n(u), a real number, for states (k,) inside the range."""
        if cell is None:
            cell = cell_of(self.u, u)
        x = np.log1p((u - self.u[cell]) / self.offset[cell]) / self.length[cell]
        _, total = _values(self.series[..., cell], self.gain[cell], x)
        result: FloatArray = self.cycles[cell] + total
        return result


def cells(
    panels: Panels, first: float = 0.0, scenes: int = 1, start: FloatArray | None = None
) -> Cells:
    """Integrate the density; n is `first` where the first panel of each of the scenes starts, which
    have as many panels each, or at the states `start` (scenes,) on it. Every panel has as many
    cells."""
    frame = panels.frame
    rule, edges = gauss(NODES), _cell_edges(panels)
    if start is not None:
        c, begins, widths = take(frame, slice(None, None, len(edges) // scenes))
        y = np.log1p((start - begins) / (begins + c))[:, None]
        edges[:: len(edges) // scenes] *= 1.0 - y / widths[:, None]
        edges[:: len(edges) // scenes] += y
    length = np.diff(edges, axis=1)
    y = (edges[:, :-1, None] + length[..., None] * rule.nodes).reshape(len(edges), -1)
    t = 2 * frame.x_of(y) / frame.x_ends[:, None] - 1
    level, shape = level_and_shape(panels.series)
    offset = (frame.starts + frame.c)[:, None]
    density = level * offset * np.exp(chebval(t, shape.T[..., None], tensor=False) + y)
    density = density.reshape(-1, NODES) * length.reshape(-1, 1)
    gain = product(density, rule.weights)
    sums = np.cumsum(gain.reshape(scenes, -1)[:, :-1], axis=1)
    cycles = (first + np.concatenate([np.zeros((scenes, 1)), sums], axis=1)).ravel()
    y = edges[:, :-1]
    u, offset = frame.starts[:, None] + offset * np.expm1(y), offset * np.exp(y)
    # By Legendre coefficients: the high ones are small, and so are the powers they turn to.
    legendre = coefficients(rule.coefficients, density)
    truncation = np.max(np.abs(legendre[-2:]), axis=0)
    series = np.stack([coefficients(powers, legendre.T) for powers in _powers(NODES)], axis=1)
    return Cells(u.ravel(), offset.ravel(), cycles, length.ravel(), gain, truncation, series)


def joined(tables: Sequence[Cells]) -> Cells:
    """Return the cells of several scenes, one after the other."""
    return Cells(*(np.concatenate(each, axis=-1) for each in zip(*tables, strict=True)))


def cell_of(begins: FloatArray, at: FloatArray) -> IntArray:
    """Return the cell that each value lies in, or the nearest."""
    return np.clip(np.searchsorted(begins, at, side="right") - 1, 0, len(begins) - 1)


def _cell_edges(panels: Panels) -> FloatArray:
    """Return where to cut every panel, in y from its start, (panels, cells + 1): into cells on
    which few coefficients of its series count and the density dn/dy grows little."""
    m = panels.series.shape[1]
    t, taken, basis = _with_ends(m)
    y = panels.frame.y_at(t)
    y[:, -1] = panels.frame.widths
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
    """Return the Chebyshev nodes and the ends of a panel (m + 2,), how many of m coefficients it
    takes to resolve a function from the start up to there, and the polynomials there (m + 2, m)."""
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


def _values(series: FloatArray, gain: FloatArray, x: FloatArray) -> tuple[FloatArray, FloatArray]:
    """Return the density dn/dx and its integral from 0, at `x` (k,) in [0, 1] of cells with these
    series.

    The integral of P_k from -1 is (z^2 - 1) P_k'(z)/(k (k + 1)), here with z^2 - 1 = -4 x (1 - x):
    a cell may hold 1e9 cycles, of which the first few are to keep their digits. The curvature is
    the sum of the coefficients times P_k'/(k (k + 1)).
    """
    z = 2 * x - 1
    while len(series) > 1:  # Estrin's scheme: neighbours first, then pairs, each pair as one
        series, z = series[::2] + z * series[1::2], z * z
    density, curvature = series[0]
    return density, x * (gain - 2 * (1 - x) * curvature)


class Iterates(NamedTuple):
    """States after any numbers of cycles, of scenes (s,) with equally many integrated cycles and
    cells.

    `transient` (s, k + 1) holds the states after 0, 1, ... k cycles, integrated one by one, and
    `transient_error` their estimated errors; the cells of all scenes, one after the other, count
    beyond, and `count_error` (s, cells + 1) is the estimated error of n where each cell starts and
    where the last one ends. Without cells the state stays as it is. States from `limit` (s,) on
    have no meaning. The mesh of phase has `edges` (s, q + 1), and `cycles` are those from the nodes
    of panels and from the CHECKS, if they were kept.
    """

    transient: FloatArray
    transient_error: FloatArray
    cells: Cells | None
    panels: Panels | None
    count_error: FloatArray
    limit: FloatArray
    edges: FloatArray
    cycles: tuple[PanelCycles, ...] = ()

    def take(self, rows: IntArray) -> Iterates:
        """Return some of the scenes."""
        table, panels, cycles = self.cells, self.panels, self.cycles
        if table is not None and panels is not None:
            of_scene = len(table.u) // len(self.transient)
            chosen = (rows[:, None] * of_scene + np.arange(of_scene)).ravel()
            table = table.take(chosen)
            each = len(panels.series) // len(self.transient)
            mine = (rows[:, None] * each + np.arange(each)).ravel()
            panels, cycles = take(panels, mine), take(cycles, mine)
        return Iterates(
            self.transient[rows],
            self.transient_error[rows],
            table,
            panels,
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
        if self.cells is None:
            return np.asarray(self.transient[:, -1])
        return np.asarray(self._rows(self.cells.ends)[:, -1])

    @property
    def at_rest(self) -> BoolArray:
        """Return whether the last cycle of each scene (s,) adds nothing: then no cycle after it
        does."""
        moves = np.sum(np.diff(self.transient[:, -2:], axis=1), axis=1) > 0
        return np.asarray(~moves & (self.cells is None))

    @property
    def first_idle_cycle(self) -> int:
        """Return the first cycle, counted from 0, that adds nothing to the first scene."""
        return int(np.argmax(np.diff(self.transient[0]) <= 0))

    @property
    def reach(self) -> FloatArray:
        """Return the number of cycles in reach (s,)."""
        if self.cells is None:
            return np.where(self.at_rest, np.inf, float(self.integrated_cycles))
        return np.asarray(self._ends[:, -1])

    @property
    def whole_cycles(self) -> FloatArray:
        """Return the number of whole cycles in reach (s,), at rest only those integrated."""
        if self.cells is None:
            return np.full(len(self.transient), float(self.integrated_cycles))
        return np.floor(self._ends[:, -1])

    @property
    def first_increment(self) -> FloatArray:
        """Return the increment of the first cycle (s,)."""
        if self.integrated_cycles == 0 and self.cells is not None:
            return np.asarray(self._rows(self.cells.first_rate)[:, 0])
        return np.asarray(np.sum(np.diff(self.transient[:, :2], axis=1), axis=1))

    @property
    def largest_error(self) -> FloatArray:
        """Return the largest relative error (s,) of the states where cells meet."""
        if self.cells is None:
            return np.zeros(len(self.transient))
        rate, u = (self._rows(x)[:, 1:] for x in (self.cells.first_rate, self.cells.u))
        return np.asarray(np.max(self.count_error[:, 1:-1] * rate / u, axis=1, initial=0.0))

    def after(self, cycles: FloatArray) -> tuple[FloatArray, FloatArray]:
        """Return the states after `cycles` (s, c) and their estimated relative errors, infinite
        where out of reach."""
        number = self.integrated_cycles
        early = cycles <= number if self.cells else np.full(cycles.shape, True)
        index = np.minimum(np.where(early, cycles, 0), number).astype(int)
        u = np.take_along_axis(self.transient, index, axis=1)
        error = np.take_along_axis(self.transient_error, index, axis=1)
        if self.cells is not None and not early.all():
            late = np.maximum(cycles, float(number))
            cell = self._cell(self._ends[:, :-1], late)
            state, rate = self.cells.state_after(late.ravel(), cell.ravel())
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
        if self.cells is None:
            return count, error
        late = np.isinf(count) & (u <= self.last_state[:, None])
        if late.any():
            cell = self._cell(self._rows(self.cells.u), u)
            found = self.cells.cycles_until(u.ravel(), cell.ravel()).reshape(u.shape)
            uncertain = _interpolated(found, self._ends, self.count_error)
            count[late] = np.ceil(found - uncertain)[late]
            error[late] = 2 * uncertain[late]
        return count, error

    def _until(self, row: int, u: FloatArray) -> tuple[FloatArray, FloatArray]:
        """Return the same for the integrated cycles of one scene."""
        first, error = self.transient[row], self.transient_error[row]
        # A state that is reached at the very end of a cycle takes no other one.
        known = error <= NO_DIGIT * first
        index = np.searchsorted(first + np.where(known, error, 0.0), u, side="left")
        # From the least count to the largest, at the rate of the cycle after, which is slower.
        single = self.first_increment[row : row + 1]
        added = np.diff(first) if len(first) > 1 else single
        after, before = np.append(added, added[-1]), np.append(added[0], added)
        after = np.where(after > 0, after, before)[: len(first)]
        uncertainty = np.where(known, 2 * error / (after + TINY), np.inf)
        return np.where(index == len(first), np.inf, index), np.append(uncertainty, 0.0)[index]

    @property
    def _ends(self) -> FloatArray:
        """Return n (s, cells + 1) where each cell starts and where the last one ends."""
        assert self.cells is not None
        begins, gain = self._rows(self.cells.cycles), self._rows(self.cells.gain)
        return np.concatenate([begins, begins[:, -1:] + gain[:, -1:]], axis=1)

    def _rows(self, values: FloatArray) -> FloatArray:
        """Return values at all cells, scene by scene (s, cells)."""
        return values.reshape(len(self.transient), -1)

    def _cell(self, begins: FloatArray, at: FloatArray) -> IntArray:
        """Return the cell among those of all scenes that each value (s, c) lies in."""
        if len(begins) == 1:
            return cell_of(begins[0], at)
        inside = np.sum(begins[:, 1:, None] <= at[:, None], axis=1)
        return np.asarray(inside + begins.shape[1] * np.arange(len(begins))[:, None])


def _interpolated(at: FloatArray, x: FloatArray, y: FloatArray) -> FloatArray:
    """Return linear interpolation at (s, c) between points x, y (s, n)."""
    return np.stack([np.interp(*row) for row in zip(at, x, y, strict=True)])
