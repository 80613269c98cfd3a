"""The increment of a cycle between two grazing wears: a series, fitted to a few integrated cycles.

Where contact grazes a turning point of the load the period map has a branch point: the duration of
contact changes like the root of the distance d to that wear. In w = d^(1/2) the map is smooth. So
between two grazing wears the logarithm of the increment D(u), less that of the power of d with
which it vanishes at a limit wear, is a Chebyshev series of few coefficients in w/(w + c). The
cycles from the nodes of all panels are integrated at once. Abel's equation and single cycles then
evaluate the series.
"""

from __future__ import annotations

import math
from bisect import bisect_left, bisect_right
from collections.abc import Sequence
from typing import NamedTuple

import numpy as np

from wear.loss_of_contact.period_map import SwitchedPeriodMap
from wear.numerics.chebyshev import chebyshev_analysis, chebyshev_nodes, chebyshev_values
from wear.numerics.floating_point import ROUNDOFF
from wear.numerics.gauss import BoolArray, FloatArray, IntArray, product
from wear.numerics.rows import stacked, take
from wear.orbit import abel
from wear.orbit.abel import Grid
from wear.orbit.panels import CHECKS, SPLIT, near_checks

MOST_ROUNDS = 6  # of cutting panels: those not resolved by then are discarded
GRAIN = 16.0  # times the uncertainty of a distance: the rounding error of an increment
WIDE = 2.0  # panel, in ln(z + shift): it is cut in the middle of that
FAR_OFF = 1e3  # times the tolerance: then a panel is cut in four, else in two
FAR_BEYOND = 700.0  # logarithm of an increment over the level of its panel
SAME = 1e-9  # of w and its scale: two that differ by less are one
USABLE = 10.0  # times the tolerance: the largest misfit of a series in use
TO_ROUNDOFF = 0.25 * ROUNDOFF  # of the wear: the distance from its limit at which a count ends
TERMS = 6  # at most, by which a series is extrapolated to a limit wear
EASED = 10.0  # times the tolerance, at most: an error of the distance is a smaller one of the wear


class Coordinate(NamedTuple):
    """A function z of the wear u (mm) that rises with it: u - origin, or 1/(origin - u) if the
    origin lies `ahead`. A count runs in ln z without a `shift`, else in z/(z + shift)."""

    origin: float
    ahead: bool = False
    shift: float = 0.0

    def at(self, wear: FloatArray) -> FloatArray:
        """Return z at each wear (mm)."""
        return np.asarray(1.0 / (self.origin - wear) if self.ahead else wear - self.origin)

    def wear(self, z: FloatArray) -> FloatArray:
        """Return the wear (mm) at each z."""
        return np.asarray(self.origin - 1.0 / z if self.ahead else z + self.origin)

    def rate(self, z: FloatArray, rate: FloatArray) -> FloatArray:
        """Return the wear per cycle (mm) where z rises at the `rate` per cycle."""
        return np.asarray(rate / z**2 if self.ahead else rate)


def step(ahead: BoolArray | bool, z: FloatArray, increment: FloatArray) -> FloatArray:
    """Return the increment of each z when the wear rises by an `increment` (mm); its origin lies
    `ahead` or behind."""
    taken = z * increment
    return np.where(ahead, z * taken / (1.0 - taken), increment)


class SeriesDomain(NamedTuple):
    """The domain of a series of increments: from the wear `start` to `end` (mm), in a coordinate z
    whose origin has the rounding error `uncertainty` (mm); up to the origin if wear `tends` to it.

    The series is that of D/w^vanishes in w/(w + scale) with w = z^power, or in ln w if the scale is
    zero.
    """

    coordinate: Coordinate
    start: float
    end: float
    power: float
    scale: float
    uncertainty: float = 0.0
    vanishes: float = 0.0
    tends: bool = False

    def wear(self, w: FloatArray) -> FloatArray:
        """Return the wear (mm) at each w."""
        return self.coordinate.wear(w ** (1.0 / self.power))

    @property
    def ends(self) -> tuple[float, float]:
        """Return its first and last z; towards a limit wear, the last z that double precision
        distinguishes from the limit."""
        first, last = self.coordinate.at(np.array([self.start, self.end])).tolist()
        return first, 1.0 / (TO_ROUNDOFF * self.coordinate.origin) if self.tends else last

    @property
    def grid(self) -> Grid:
        """Return one panel of w."""
        ends = np.sort(self.coordinate.at(np.array([self.start, self.end])) ** self.power)
        return abel.grid(self.scale, ends[:1], ends[1:])


class IncrementSeries(NamedTuple):
    """The increments D of cycles on a `domain`: ln(D/(level w^vanishes)) as Chebyshev `series` (p,
    m) on a `grid` of panels of w, each with its `level` (p,). The relative error `misfit` (p, 6)
    at the CHECKS is the difference to integrated cycles, and the error of these."""

    domain: SeriesDomain
    grid: Grid
    level: FloatArray
    series: FloatArray
    misfit: FloatArray

    @property
    def coordinate(self) -> Coordinate:
        """Return the coordinate z of the domain."""
        return self.domain.coordinate

    def walk(self, wear: float, end: float, most: float) -> tuple[list[float], list[float]]:
        """Return the wear (mm) before and after each cycle from `wear` on, until z passes `end` or
        the number of cycles exceeds `most`; and the error (mm) of each increment: the larger misfit
        at the two CHECKS next to it."""
        origin, ahead, _ = self.coordinate
        power, scale, vanishes = self.domain.power, self.domain.scale, self.domain.vanishes
        starts, across = self.grid.starts.tolist(), self.grid.x_ends.tolist()
        series, level = [row[::-1] for row in self.series.tolist()], self.level.tolist()
        checks, misfit = CHECKS.tolist()[1:-1], self.misfit.tolist()
        walked, errors, distance = [wear], list[float](), origin - wear
        z = 1.0 / distance if ahead else -distance
        while z < end and len(walked) <= most:
            w = z**power
            i = max(bisect_right(starts, w) - 1, 0)
            x = (w - starts[i]) / (w + scale) if scale else math.log(w / starts[i])
            twice = 4.0 * x / across[i] - 2.0
            last = before = 0.0
            for coefficient in series[i]:  # Clenshaw
                last, before = coefficient + twice * last - before, last
            logarithm = last - before * twice / 2.0
            if not logarithm < FAR_BEYOND:
                break
            added = level[i] * w**vanishes * math.exp(logarithm)
            distance -= added
            if not math.isfinite(distance) or (ahead and distance <= 0.0):
                break
            walked.append(origin - distance)
            before_check = bisect_left(checks, twice / 2.0)
            errors.append(max(misfit[i][before_check : before_check + 2]) * added)
            z = 1.0 / distance if ahead else -distance
        return walked, errors


def increments(fits: Sequence[IncrementSeries], which: IntArray, z: FloatArray) -> FloatArray:
    """Return the increment (mm) of a cycle from each z (k,), by the fit with the number `which`
    (k,)."""
    panel, t, w = located(fits, which, z)
    series, level = (np.concatenate([fit[i] for fit in fits]) for i in (3, 2))
    vanishes = np.array([fit.domain.vanishes for fit in fits])[which]
    logarithm = np.einsum("ij,ij->i", chebyshev_values(t, series.shape[1]), series[panel])
    return np.asarray(level[panel] * np.exp(logarithm) * w**vanishes)


def relative_error(fits: Sequence[IncrementSeries], which: IntArray, z: FloatArray) -> FloatArray:
    """Return the relative error of the increment at each z (k,) by the fit with the number `which`
    (k,): the larger misfit at the two CHECKS next to it."""
    panel, t, _ = located(fits, which, z)
    misfit = np.concatenate([fit.misfit for fit in fits])
    return near_checks(misfit[panel], t[:, None])[:, 0]


def located(
    fits: Sequence[IncrementSeries], which: IntArray, z: FloatArray
) -> tuple[IntArray, FloatArray, FloatArray]:
    """Return, for each z (k,) on the fit with the number `which` (k,), its panel among those of all
    fits, or the nearest; its position on that panel; and w."""
    power, scale = np.array([(fit.domain.power, fit.domain.scale) for fit in fits])[which].T
    number = [len(fit.level) for fit in fits]
    starts, across = (np.concatenate([getattr(fit.grid, name) for fit in fits])
                      for name in ("starts", "x_ends"))  # fmt: skip
    begins = np.full((len(fits), max(number)), np.inf)
    begins[np.arange(max(number)) < np.array(number)[:, None]] = starts
    w = z**power
    panel = (np.cumsum(number) - number)[which] + np.sum(begins[which, 1:] <= w[:, None], axis=1)
    start = starts[panel]
    x = np.where(scale > 0.0, (w - start) / (w + scale), np.log(w / start))
    return panel, 2 * x / across[panel] - 1, w


class _Fits(NamedTuple):
    """Series on panels of the domains with the numbers `of` (p,), as in an `IncrementSeries`; and
    the largest misfit of each over the permitted one, `excess` (p,)."""

    of: IntArray
    grid: Grid
    level: FloatArray
    series: FloatArray
    misfit: FloatArray
    excess: FloatArray


def fitted(
    domains: Sequence[SeriesDomain],
    scene: IntArray,
    cycle: SwitchedPeriodMap,
    number: int,
    tolerance: float,
) -> tuple[list[list[IncrementSeries]], FloatArray]:
    """Fit the increments on every domain of the scenes (n,), with `number` coefficients on each
    panel, to a relative `tolerance`: the panels of all domains at once; those that miss it are cut.
    Return the series of each domain, one for each part of it on which the fit succeeds; and its
    cost (2, n): cycles and right-hand sides."""
    cost, done = np.zeros((2, len(domains))), list[_Fits]()
    if not domains:
        return [], cost
    t, of = np.append(chebyshev_nodes(number), CHECKS), np.arange(len(domains))
    grid = stacked([domain.grid for domain in domains])
    numbers = [(*each.coordinate[:2], each.uncertainty, *each[3:7:3]) for each in domains]
    for rounds in range(MOST_ROUNDS):
        origin, ahead, uncertainty, power, vanishes = np.array(numbers)[of].T[..., None]
        w = grid.states(t)
        z = w ** (1.0 / power)
        distance = np.where(ahead > 0.0, 1.0 / z, np.inf)
        wear = origin + np.where(ahead > 0.0, -distance, z)
        run = cycle.advance(wear.ravel(), np.repeat(scene[of], len(t)))
        each = np.array([[len(t)], [run.evaluations / len(of)]])
        cost += each * np.bincount(of, minlength=len(domains))
        increment, error = run.increment.reshape(w.shape), run.error.reshape(w.shape)
        fits = _series(increment / w**vanishes, (error / increment)[:, number:])
        eased = tolerance * np.clip(origin / distance, 1.0, EASED)
        allowed = np.maximum(eased, GRAIN * uncertainty / distance)[:, number:]
        excess = np.max(fits[-1] / allowed, axis=1)
        coarse = ~(excess <= 1.0) & (rounds < MOST_ROUNDS - 1)
        done.append(take(_Fits(of, grid, *fits, excess), ~coarse & (excess <= USABLE)))
        if not coarse.any():
            break
        halves, of = cut(take(grid, coarse)), np.tile(of[coarse], 2)
        far = np.tile(excess[coarse] > FAR_OFF, 2)
        grid = stacked([take(halves, ~far), cut(take(halves, far))])
        of = np.concatenate([of[~far], np.tile(of[far], 2)])
    return _joined(domains, stacked(done)), cost


def _series(smooth: FloatArray, error: FloatArray) -> tuple[FloatArray, FloatArray, FloatArray]:
    """Return level, series and misfit of an `IncrementSeries` from D/w^vanishes at the nodes of
    panels and then at the CHECKS, (p, n), and the relative `error` at the latter."""
    number = smooth.shape[1] - len(CHECKS)
    level = smooth[:, number // 2]
    series = product(np.log(smooth[:, :number] / level[:, None]), chebyshev_analysis(number).T)
    values = level[:, None] * np.exp(product(series, chebyshev_values(CHECKS, number).T))
    return level, series, np.abs(values / smooth[:, number:] - 1.0) + error


def _joined(domains: Sequence[SeriesDomain], fits: _Fits) -> list[list[IncrementSeries]]:
    """Return the series of each domain: one for each run of adjacent panels."""
    fits = take(fits, np.lexsort((fits.grid.starts, fits.of)))
    starts, ends = fits.grid.starts, fits.grid.ends
    apart = (np.diff(fits.of) > 0) | (starts[1:] > ends[:-1] * (1 + SAME))
    bounds = [0, *(np.flatnonzero(apart) + 1).tolist(), len(starts)] if len(starts) else []
    joined: list[list[IncrementSeries]] = [[] for _ in domains]
    for run in map(slice, bounds[:-1], bounds[1:]):
        domain, panels = domains[fits.of[run.start]], take(fits[1:5], run)
        joined[fits.of[run.start]].append(_completed(IncrementSeries(domain, *panels)))
    return joined


def _completed(fit: IncrementSeries) -> IncrementSeries:
    """Return a series on adjacent panels with its own part of the domain, up to a limit wear to
    which that tends."""
    domain, grid = fit.domain, fit.grid
    first, last = domain.grid.starts[0], domain.grid.ends[0]
    begin, end = np.sort(domain.wear(np.array([grid.starts[0], grid.ends[-1]])))
    complete = [
        grid.starts[0] <= first + SAME * (first + domain.scale),
        grid.ends[-1] >= last - SAME * (last + domain.scale),
    ]
    from_start, to_end = complete if domain.power > 0.0 else complete[::-1]
    tends = domain.tends and to_end
    begin = domain.start if from_start else float(begin)
    end = domain.coordinate.origin if tends else domain.end if to_end else float(end)
    part = fit._replace(domain=domain._replace(start=begin, end=end, tends=tends))
    return stacked([_to_limit(part), part]) if tends else part


def _to_limit(fit: IncrementSeries) -> IncrementSeries:
    """Return the panel from w = 0 to the first one, on which the first one's series is extrapolated
    by the terms of its Taylor expansion that exceed their error by the misfit. The first neglected
    term, at w = 0, is the error of the extrapolation."""
    first, m = take(fit, slice(1)), fit.series.shape[1]
    grid = abel.grid(first.grid.c, np.zeros(1), first.grid.starts)
    d = first.grid.positions(grid.states(chebyshev_nodes(TERMS)))[0] + 1.0
    k, factor, values = np.arange(m), (-1.0) ** np.arange(m), np.zeros(TERMS)
    for n in range(TERMS):  # of T_k(-1 + d), a polynomial in d
        term = float(np.sum(factor * first.series[0]))
        if n > 0 and abs(term) <= np.max(first.misfit) * abs(factor[-1]):
            break
        values += term * d**n
        factor = factor * (n**2 - k**2) / ((n + 1) * (2 * n + 1))
    series = np.zeros((1, m))
    series[0, :TERMS] = chebyshev_analysis(TERMS) @ values
    misfit = np.repeat(first.misfit[:, :1], len(CHECKS), axis=1) + abs(term) * np.max(-d) ** n
    return first._replace(grid=grid, series=series, misfit=misfit)


def cut(grid: Grid) -> Grid:
    """Return every panel cut in two."""
    middle = grid.x_of(grid.widths[:, None] / 2)[:, 0] / grid.x_ends
    share = np.where((grid.c > 0.0) & (grid.widths < WIDE), SPLIT, middle)
    return stacked(grid.cut(share))
