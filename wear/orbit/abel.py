"""Abel's equation n(P(u)) = n(u) + 1: the number of cycles n as a function of the state u.

Overview
    The unknown is the logarithm of the density dn/du, a Chebyshev series in u/(u + c) on each panel
    of states: one panel may reach to infinity. Where a cycle adds d to u, the equation is: the
    integral of the density from u to u + d is 1. Collocated at the Chebyshev nodes it is solved by
    Newton's method, all panels at once.
Key results
    Grid               panels of states and their coordinates
    solve              the density on them, from increments at their nodes
    residual           ln(n(P(u)) - n(u)) off the nodes
    matching_defect    the difference between the counts of neighbours where they meet
    sum_per_cycle      sums of a function over the orbit, by the linearised equation
References
    M. Kuczma, B. Choczewski, R. Ger, *Iterative Functional Equations*, Cambridge University Press
    1990, chapter 3.
"""

from __future__ import annotations

import math
from typing import NamedTuple

import numpy as np

from wear.numerics.chebyshev import chebyshev_analysis, chebyshev_nodes, chebyshev_values
from wear.numerics.gauss import FloatArray, Gauss, gauss, product

ACROSS_A_CYCLE = 6  # Gauss nodes where the density changes by less than a factor 2 in a cycle
ACROSS_A_FAST_CYCLE = 12  # good to rounding for a factor of 1e3
ACROSS_JUDGED = 24  # more than in any solution, or both would have the same error
GENTLE = 0.5  # change of ln(density) within a cycle for which the fewest nodes do
MOST_ITERATIONS = 30
STEADY = 0.3  # change of ln(density) below which Newton's method keeps its matrix
CONVERGED = 1e-13  # change of ln(density): the next one would be its square

WHOLE = np.ones(1)  # a cycle


class Grid(NamedTuple):
    """Panels of states from `starts` (panels,) over `widths` in y = ln(u + c), with the scale `c`
    (panels,) of each. The coordinate x = (u - start)/(u + c) is 1 - exp(-y) with y from the start;
    or y itself where c is zero: then the states have no scale."""

    c: FloatArray
    starts: FloatArray
    widths: FloatArray

    @property
    def ends(self) -> FloatArray:
        """Return where the panels end."""
        ends: FloatArray = self.starts + (self.starts + self.c) * np.expm1(self.widths)
        return ends

    @property
    def x_ends(self) -> FloatArray:
        """Return the coordinate x (panels,) of the ends."""
        return self.x_of(self.widths[:, None])[:, 0]

    def x_of(self, y: FloatArray) -> FloatArray:
        """Return the coordinate x of y, (panels, k)."""
        return np.where(self.c[:, None] > 0.0, -np.expm1(-y), y)

    def y_of(self, x: FloatArray) -> FloatArray:
        """Return y at the coordinate x, (panels, k)."""
        scaled = self.c[:, None] > 0.0
        return np.where(scaled, -np.log1p(-x * scaled), x)

    def y_at(self, t: FloatArray) -> FloatArray:
        """Return y from the start of each panel at the positions `t` (k,) in [-1, 1]."""
        return self.y_of(self.x_ends[:, None] * ((t + 1) / 2))

    def states(self, t: FloatArray) -> FloatArray:
        """Return the states (panels, k) at the positions `t` (k,).

        Written so that states much smaller than c keep their digits. Of much larger ones only the
        position is exact, which is all that a series in x feels.
        """
        scale = (self.starts + self.c)[:, None]
        states: FloatArray = self.starts[:, None] + scale * np.expm1(self.y_at(t))
        return states

    def positions(self, u: FloatArray) -> FloatArray:
        """Return the positions t of the states u (panels, k)."""
        y = np.log1p((u - self.starts[:, None]) / (self.starts + self.c)[:, None])
        result: FloatArray = 2 * self.x_of(y) / self.x_ends[:, None] - 1
        return result

    def step(self, t: FloatArray, increments: FloatArray, parts: FloatArray = WHOLE) -> FloatArray:
        """Return the steps (panels, k, n) in t from the positions `t` (k,) by the `parts` (n,) of a
        cycle that adds `increments` (panels, k)."""
        left = np.exp(-self.y_at(t))
        part = (left * increments / (self.starts + self.c)[:, None])[..., None] * parts
        y, scaled = np.log1p(part), self.c[:, None, None] > 0.0
        x = np.where(scaled, -np.expm1(-y), y) * (2 / self.x_ends)[:, None, None]
        return np.asarray(x * np.where(scaled, left[..., None], 1.0))

    def cut(self, share: FloatArray | float) -> tuple[Grid, Grid]:
        """Return every panel cut in two, the first part a `share` of it in x."""
        first = self.y_of((share * self.x_ends)[:, None])[:, 0]
        middles = self.starts + (self.starts + self.c) * np.expm1(first)
        return self._replace(widths=first), Grid(self.c, middles, self.widths - first)


class Density(NamedTuple):
    """The density dn/du on a `grid` of panels: Chebyshev coefficients `series` (panels, m) of its
    logarithm."""

    grid: Grid
    series: FloatArray


def grid(c: float | FloatArray, starts: FloatArray, ends: FloatArray) -> Grid:
    """Return panels between two states each, with a scale c for all or one for each."""
    c = np.broadcast_to(np.asarray(c, dtype=float), starts.shape)
    return Grid(c, starts, np.log1p((ends - starts) / (starts + c)))


def solve(grid: Grid, increments: FloatArray) -> Density:
    """Return the density on every panel, from the increments at its Chebyshev nodes (panels, m).

    Newton's method, from the density 1/increment, which is exact when the density does not change
    within a cycle; near the solution its slope hardly changes.
    """
    m = increments.shape[1]
    nodes = chebyshev_nodes(m)
    with np.errstate(all="ignore"):  # far too wide a panel: its series is no number
        step = grid.step(nodes, increments)[..., 0]
        gentle = np.max(change_in_a_cycle(np.log(increments), step)) < GENTLE
        rule = gauss(ACROSS_A_CYCLE if gentle else ACROSS_A_FAST_CYCLE)
        basis = _within(nodes, grid.step(nodes, increments, rule.nodes), m)
        last = increments[:, -1:]
        weights = (increments / last)[..., None] * rule.weights
        series = product(-np.log(increments / last), chebyshev_analysis(m).T)
        change, inverse = np.zeros_like(series), None
        for _ in range(MOST_ITERATIONS):
            density, cycles = _density(series, basis, weights)
            if inverse is None or np.any(np.abs(change) > STEADY):
                inverse = _inverse_slope(density, cycles, basis)
            change = (inverse @ -np.log(cycles)[..., None])[..., 0]
            series = series + change
            if not np.any(np.abs(change) >= CONVERGED):
                break
        series[:, :1] -= np.log(last)
    return Density(grid, series)


def change_in_a_cycle(density: FloatArray, step: FloatArray) -> FloatArray:
    """Return the largest change (panels,) of the logarithm of the `density` (panels, m), known at
    the Chebyshev nodes, within a cycle that takes a `step` in t (panels, m)."""
    slope = np.abs(np.diff(density, axis=1)) / np.diff(chebyshev_nodes(density.shape[1]))
    change: FloatArray = np.max(slope * np.maximum(step[:, 1:], step[:, :-1]), axis=1)
    return change


def _within(t: FloatArray, steps: FloatArray, m: int) -> FloatArray:
    """Return the Chebyshev polynomials within cycles that start at the positions `t` (k,) of each
    panel, the `steps` (panels, k, nodes) beyond: shape (panels, m, k, nodes)."""
    return np.moveaxis(chebyshev_values(t[:, None] + steps, m), -1, 1)


def _density(
    series: FloatArray, basis: FloatArray, weights: FloatArray
) -> tuple[FloatArray, FloatArray]:
    """Return the density dn/du times `weights` (panels, k, nodes) and its sums, the cycles
    (panels, k)."""
    panels, m, *rest = basis.shape
    logarithm = (series[:, None] @ basis.reshape(panels, m, math.prod(rest))).reshape(panels, *rest)
    density = np.exp(logarithm) * weights
    return density, np.sum(density, axis=-1)


def _inverse_slope(density: FloatArray, cycles: FloatArray, basis: FloatArray) -> FloatArray:
    """Return the inverse (panels, m, m) of the derivative of ln(cycles) with respect to the series;
    no number where there is none."""
    slope = np.einsum("pig,pkig->pik", density, basis) / cycles[..., None]
    singular = ~np.isfinite(slope).all(axis=(1, 2))
    slope[singular] = np.eye(slope.shape[1])
    inverse: FloatArray = np.linalg.inv(slope)
    inverse[singular] = np.nan
    return inverse


def residual(panels: Density, t: FloatArray, increments: FloatArray) -> FloatArray:
    """Return ln(n(P(u)) - n(u)) at the positions `t` of each panel: zero for the exact n.

    `increments` (panels, len(t)) are those of a finer period map. A residual r means that the
    density is wrong by about a factor 1 - r.
    """
    with np.errstate(all="ignore"):  # of a panel far too wide: infinite or no number
        _, cycles, _ = _cycles_from(panels, t, increments, gauss(ACROSS_JUDGED))
        result: FloatArray = np.log(cycles)
    return result


class SumIncrements(NamedTuple):
    """Cycles from some positions of panels: the increments of the state (panels, n), and of k
    derivatives of it, `change` (panels, n, k), with their `error`; and the derivative dP/du of the
    period map, `multiplier` (panels, n)."""

    increment: FloatArray
    change: FloatArray
    multiplier: FloatArray
    error: FloatArray | float = 0.0


def sum_per_cycle(panels: Density, cycles: SumIncrements) -> FloatArray:
    """Return the coefficients (panels, m, k) of dS/dn, where the `cycles` from the nodes of a panel
    add dn/du times their `change` to S, with dn/du at their ends.

    S(P(u)) - S(u) is given: this is Abel's equation with another right-hand side; the integral of
    (dS/dn) (dn/du) over a cycle has the matrix of Newton's method for n.
    """
    rule, nodes = gauss(ACROSS_A_FAST_CYCLE), chebyshev_nodes(cycles.increment.shape[1])
    slope, after = _sums_from(panels, nodes, cycles.increment, rule)
    lost = ~np.isfinite(slope).all(axis=(1, 2))
    slope[lost] = np.eye(slope.shape[1])
    result = np.asarray(np.linalg.solve(slope, after * cycles.change), dtype=float)
    result[lost] = np.nan
    return result


def sum_residual(
    panels: Density, t: FloatArray, cycles: SumIncrements, series: FloatArray
) -> tuple[FloatArray, FloatArray]:
    """Return the error (panels, n, k) of S(P(u)) - S(u) for the `cycles` from the positions `t`
    (n,) of each panel, for S with the coefficients `series` (panels, m, k) of dS/dn; and the
    relative error (panels, n) of dn/du in a cycle, by dP/du.

    The residual of Abel's equation may be small and its derivative large: at the ends of a panel.
    """
    slope, after = _sums_from(panels, t, cycles.increment, gauss(ACROSS_JUDGED))
    error: FloatArray = np.abs(slope @ series - after * cycles.change) + after * cycles.error
    level, shape = level_and_shape(panels.series)
    before = level * np.exp(shape @ chebyshev_values(t, shape.shape[1]).T)
    return error, np.abs(after[..., 0] * cycles.multiplier / before - 1.0)


def _sums_from(
    panels: Density, t: FloatArray, increments: FloatArray, rule: Gauss
) -> tuple[FloatArray, FloatArray]:
    """Return the matrices (panels, n, m) from coefficients of dS/dn to the increments of S in
    cycles from the positions `t` (n,), by the nodes of a rule, and dn/du (panels, n, 1) at their
    ends."""
    to_end = rule._replace(nodes=np.append(rule.nodes, 1.0), weights=np.append(rule.weights, 1.0))
    density, _, basis = _cycles_from(panels, t, increments, to_end)
    slope = np.einsum("pig,pkig->pik", density[..., :-1], basis[..., :-1])
    return slope, density[..., -1:] / increments[..., None]


def _cycles_from(
    panels: Density, t: FloatArray, increments: FloatArray, rule: Gauss
) -> tuple[FloatArray, FloatArray, FloatArray]:
    """Return the weighted density at the nodes of a rule within the cycles from the positions `t`,
    its sums, and the polynomials there."""
    steps = panels.grid.step(t, increments, rule.nodes)
    basis = _within(t, steps, panels.series.shape[1])
    level, shape = level_and_shape(panels.series)
    density, cycles = _density(shape, basis, (level * increments)[..., None] * rule.weights)
    return density, cycles, basis


def matching_defect(before: Density, after: Density) -> FloatArray:
    """Return the difference in cycles (panels,) between the counts on each panel of `before` and on
    its neighbour in `after`, within a cycle of where they meet.

    Abel's equation leaves a function of period 1 in n free. Every panel picks its own, which does
    no harm within a panel; but where two meet it shifts the count.
    """
    m = before.series.shape[1]
    rule = gauss(ACROSS_A_FAST_CYCLE)
    level, shape = level_and_shape(after.series)
    steps = np.exp(-shape @ chebyshev_values(np.array([-1.0]), m).T) / level
    difference = np.zeros((len(steps), len(rule.nodes)))
    for side, t in ((before, 1.0), (after, -1.0)):
        at = np.array([t])
        basis = _within(at, side.grid.step(at, steps, rule.nodes), m)
        level, shape = level_and_shape(side.series)
        difference += t * _density(shape, basis, (level * steps)[..., None])[0][:, 0]
    result: FloatArray = np.max(np.abs(difference @ rule.integrate.T), axis=1)
    return result


def level_and_shape(series: FloatArray) -> tuple[FloatArray, FloatArray]:
    """Return the mean level of the density (panels, 1) and the series of the logarithm less it: a
    large constant would cost the logarithm its last digits."""
    shape = series.copy()
    shape[:, 0] = 0.0
    return np.exp(series[:, :1]), shape
