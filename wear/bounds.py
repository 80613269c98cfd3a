"""Rigorous bounds: enclosures of the wear after N cycles that are proofs.

Overview
    One cycle takes the wear u to u + d.  With the wear frozen at its start, d would be G(u), the
    integral of the rate r(phase) over the cycle.  While the wear is in the cycle's range, the
    slope of the rate lies between a(phase) and b(phase), and Gronwall's lemma gives
    ``int r exp(A) <= d <= int r exp(B)`` with A, B the integrals of a, b over the rest of the
    cycle.  The map u -> u + d increases, so lower and upper bounds run on by themselves.

    Everything is evaluated in ball arithmetic (Arb, through python-flint) on the generated rate
    and slope: every rounding error is inside the bounds.  G is a mean over equidistant phases.  For
    a rate that is analytic and bounded by its largest value in the strip |Im phase| <= w its
    relative error is at most 2/(exp(2 pi w m) - 1) (Trefethen and Weideman, SIAM Review 56 (2014)
    385, theorem 3.2).
Key results
    wear_bounds     bounds for the given load
    static_bounds   bounds from the least and the largest load alone
References
    Comparison principle: derive's monotonicity; strip of analyticity: its id ``strip``.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import replace
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from wear.binding import bound, generated
from wear.faults import Faults, UsageError
from wear.load import Constant, Harmonics, Sine
from wear.request import whole_cycles
from wear.scene import Scene

Ball = Any  # flint.arb
Balls = NDArray[np.object_]

PRECISION = 64
"""Bits of the balls."""
PHASES = 64
"""Phases, and panels of phase, of one cycle."""
FINE_PANELS = 256
"""Panels of a cycle in which wear is fast."""
MOST_CYCLES = 10**6
"""Cycles, which take half a millisecond each."""
SMALL_STEP = 0.1
"""Wear in a cycle, as a share of the roughness, up to which the frozen wear is a good start."""
STRIP = math.pi / 8
"""Largest |Im h/sigma| at which the tanh law stays below p_max in modulus: id ``strip``."""


class Enclosure(NamedTuple):
    """Bounds of a wear depth, in mm."""

    low: float
    high: float


class _WearRange(NamedTuple):
    """Bounds that hold for every wear between ``low`` and ``high``."""

    low: Ball
    high: Ball
    least_change: Ball  # bounds of d - G, mm
    most_change: Ball
    quadrature: Ball  # error of the mean over equidistant phases
    largest: Ball  # wear of one cycle at the largest pressure

    def most(self, frozen: Ball) -> Ball:
        """Return an upper bound of the increment whose frozen value is ``frozen``."""
        return min((frozen + self.quadrature + self.most_change).upper(), self.largest)

    def least(self, frozen: Ball) -> Ball:
        """Return a lower bound of the same increment, not negative."""
        return max((frozen - self.quadrature + self.least_change).lower(), 0 * frozen)


def wear_bounds(scene: Scene, cycles: Sequence[int]) -> tuple[Enclosure, ...]:
    """Return proven bounds of u_c after each number of cycles.

    The numbers of the scene are taken as the doubles that they are.  On a compliant support the
    bounds are those of rigid ones under ``U_a - p_max/k`` and ``U_a``.

    Raises
    ------
    UsageError
        for loss of contact, a law other than tanh, more than a million cycles, or a load with
        kinks; `static_bounds` admits kinks.

    >>> from wear import load_scene
    >>> low, high = wear_bounds(load_scene("section4"), [1])[0]
    >>> low < 3.02533577274748e-5 < high
    True
    """
    return _both(scene, cycles, scene.load, scene.load)


def static_bounds(scene: Scene, cycles: Sequence[int]) -> tuple[Enclosure, ...]:
    """Return bounds of u_c from the extremes of the load: looser, for any periodic load."""
    load = scene.periodic_load
    low = Constant(load.minimum, load.period)
    high = Constant(load.maximum, load.period)
    return _both(scene, cycles, low, high)


def _both(scene: Scene, cycles: Sequence[int], low: Any, high: Any) -> tuple[Enclosure, ...]:
    """Run the lower bound with the load ``low`` and the upper one with ``high``."""
    import flint

    faults = Faults()
    if scene.contact.ends_at_3_sigma or scene.contact.law != "tanh" or scene.given_load:
        faults.append(
            "bounds need a given displacement, the tanh contact law, and contact that does not end "
            "at 3 sigma"
        )
    count = whole_cycles(cycles, faults, least=1)
    if max(count, default=0) > MOST_CYCLES:
        faults.append(
            f"bounds go cycle by cycle, up to {MOST_CYCLES} of them (some minutes); "
            "for more, solve gives the wear with an estimated error"
        )
    faults.stop_if_any()
    lift = 0.0
    if scene.support is not None:
        lift = scene.contact.max_pressure_MPa / scene.support.stiffness_MPa_per_mm
        scene = replace(scene, support=None)
    with flint.ctx.workprec(PRECISION):
        below = _run(_Flow.of(scene, low, -lift * (1 + 4e-16)), count, upper=False)
        above = _run(_Flow.of(scene, high, 0.0), count, upper=True)
    return tuple(Enclosure(below[n], above[n]) for n in count)


class _Flow(NamedTuple):
    """The wear of one cycle, in balls."""

    module: Any
    constants: Any
    largest: Ball  # wear of one cycle at the largest pressure, mm
    loads: Balls  # U_a at equidistant phases
    panels: Balls  # U_a over panels that cover the cycle
    fine_panels: Balls  # the same, narrower
    harmonics: tuple[tuple[int, Ball], ...]  # order and amplitude, for the strip
    scale: Ball  # largest rate (mm/s) times this is the wear of a cycle

    @classmethod
    def of(cls, scene: Scene, load: Any, lift: float) -> _Flow:
        """Bind a scene's numbers as balls; ``lift`` is added to the load."""
        from flint import arb

        module = generated(scene.variant)
        numbers = {name: arb(value) for name, value in scene.parameters().items()}
        numbers["n"] *= arb.pi() / arb(np.pi)  # bind multiplies by np.pi
        constants = bound(module, numbers, int(scene.pin_wear_sign)).constants
        mean, terms = _terms(load)
        wave = [(j, arb(cosine), arb(sine)) for j, cosine, sine in terms]
        period, count = arb(load.period), PHASES if terms else 1

        def loads(turns: list[Ball]) -> Balls:
            """Return U_a at the phases of half turns."""
            waves = [
                [c * (j * turn).cos_pi() + s * (j * turn).sin_pi() for j, c, s in wave]
                for turn in turns
            ]
            return np.array([sum(each, arb(mean) + lift) for each in waves], dtype=object)

        return cls(
            module,
            constants,
            constants.largest_rate * period,
            loads([arb(2 * i) / count for i in range(count)]),
            loads([arb(2 * i + 1, 1) / count for i in range(count)]),
            loads([arb(2 * i + 1, 1) / FINE_PANELS for i in range(FINE_PANELS)]),
            tuple((j, abs(cosine) + abs(sine)) for j, cosine, sine in wave),
            period,
        )

    def increment(self, u: Ball) -> Ball:
        """Return the wear of a cycle with the wear frozen at u, without the quadrature error."""
        rates = self.module.rate(u, self.loads, self.constants)
        return self.scale * rates.sum() / len(rates)

    def rate(self, wear: Ball, load: Ball) -> Ball:
        """Return the wear rate at one load; all possible rates where the clamp of exp is
        undecided."""
        possible = self.constants.largest_rate * type(wear)(0).union(type(wear)(1))
        try:
            rate = self.module.rate(wear, load, self.constants)
        except TypeError:  # the minimum of a ball and a number was the number
            return possible
        return rate if rate.is_finite() else possible

    def roughness(self, wear: Ball) -> Ball:
        """Return the equivalent roughness."""
        return self.module.fields(wear, self.loads[0], self.constants).sigma

    def range(self, low: Ball, high: Ball) -> _WearRange:
        """Return the bounds for every wear between two."""
        from flint import arb

        wear, weight = low.union(high), self.scale / len(self.panels)
        rates, slopes = self.module.rate_and_slope(wear, self.panels, self.constants)
        rates, slopes = rates * weight, slopes * weight
        least = _change(rates, [slope.lower() for slope in slopes]).lower()
        most = _change(rates, [slope.upper() for slope in slopes]).upper()
        error = self.largest * (self._quadrature(wear) + arb("1e-300"))  # the clamp in rate
        return _WearRange(low, high, least, most, error.upper(), self.largest.upper())

    def _quadrature(self, wear: Ball) -> Ball:
        """Return the relative error of the mean over equidistant phases."""
        from flint import arb

        if not self.harmonics:
            return arb(0)
        room = (arb(STRIP) * self.roughness(wear)).lower()
        if not room > 0:
            return arb("inf")
        order, total = self.harmonics[-1][0], sum(a for _, a in self.harmonics)
        width = float((room / total).asinh()) / (2 * math.pi * order)
        while not sum(a * (2 * arb.pi() * j * width).sinh() for j, a in self.harmonics) < room:
            width *= 0.99
        return 2 / ((2 * arb.pi() * width * len(self.loads)).exp() - 1)


def _change(rates: Balls, slopes: Sequence[Ball]) -> Ball:
    """Return the integral of r (exp(A) - 1) over a cycle, A that of the slope over its rest."""
    from flint import arb

    rest, change = arb(0), arb(0)
    for rate, slope in zip(rates[::-1], reversed(slopes), strict=True):
        change += rate * (rest.union(rest + slope).exp() - 1)
        rest += slope
    return change


def _terms(load: Any) -> tuple[float, list[tuple[int, float, float]]]:
    """Return the mean of a load and its harmonics: order, cosine, sine."""
    if isinstance(load, Constant):
        return load.mean, []
    if isinstance(load, Sine | Harmonics):
        orders, *waves = load.terms().tolist()
        terms = zip(map(int, orders), *waves, strict=True)
        return load.mean, [term for term in terms if any(term[1:])]
    raise UsageError("bounds cycle by cycle need a smooth periodic load; try static_bounds")


def _run(flow: _Flow, cycles: Sequence[int], upper: bool) -> dict[int, float]:
    """Return the bound after each number of cycles, rounded outwards."""
    from flint import arb

    wear, known, bounds = arb(0), None, dict[int, float]()
    marks = set(cycles)
    for cycle in range(1, max(marks) + 1):
        frozen = flow.increment(wear)
        if frozen < SMALL_STEP * flow.roughness(wear):
            known = _covering(flow, known, wear, frozen)
        else:
            known = None
        if known is None:
            wear = _march(flow, wear, upper)
        else:
            step = known.most(frozen) if upper else known.least(frozen)
            wear = (wear + step).upper() if upper else (wear + step).lower()
        if cycle in marks:
            outward = math.inf if upper else 0.0
            bounds[cycle] = math.nextafter(float(wear), outward)
    return bounds


def _march(flow: _Flow, wear: Ball, upper: bool) -> Ball:
    """Return the bound after a cycle of fast wear, panel by panel: crude, but never vacuous."""
    share = flow.scale / FINE_PANELS
    ceiling = (flow.largest / FINE_PANELS).upper()
    for load in flow.fine_panels:
        reach = min((flow.rate(wear.union(wear + ceiling), load) * share).upper(), ceiling)
        step = flow.rate(wear.union(wear + reach), load) * share
        wear = (wear + min(step.upper(), ceiling)).upper() if upper else (wear + step).lower()
    return wear


def _covering(flow: _Flow, known: _WearRange | None, wear: Ball, frozen: Ball) -> _WearRange | None:
    """Return a range that the wear does not leave in the cycle that starts at ``wear``, or None.

    The wear stays inside while the bound for the range is below the end of the range.  The range is
    a little wider than the wear of a cycle, so that it serves for several.
    """
    if known is not None and wear >= known.low and wear + known.most(frozen) < known.high:
        return known
    reach = 1.1 * frozen + 2e-3 * flow.roughness(wear)
    while reach < SMALL_STEP * 4 * flow.roughness(wear):
        known = flow.range(wear, (wear + reach).upper())
        if wear + known.most(frozen) < known.high:
            return known
        reach = 2 * reach
    return None
