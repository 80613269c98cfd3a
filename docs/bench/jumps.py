"""Cycle jumps and averaging, for `wear bench --peers` in a checkout.

Overview
    The usual methods for many cycles: few of them are integrated, and the wear of one is
    extrapolated over the next.  All methods here take the wear D(u) of the cycle that starts at u
    from the package's own collocation, to rounding: the jump alone is compared.
Key results
    fixed_jumps        u + L D(u), L a share of all cycles (Euler)
    adaptive_jumps     the same, L such that a jump wears off a share of the roughness
    averaged           du/dn = the wear of a cycle at frozen wear (averaging of first order)
    envelope           the trapezoidal rule of the sum over L cycles, L by error control
    stroboscopic       du/dn = ln(P) from four cycles on end, an integrator for the rest
References
    L. R. Petzold, SIAM J. Numer. Anal. 18 (1981) 455 (envelope following).
    M. P. Calvo, Ph. Chartier, A. Murua, J. M. Sanz-Serna, Appl. Numer. Math. 61 (2011) 1077
    (stroboscopic averaging).
    J. A. Sanders, F. Verhulst, J. Murdock, Averaging Methods (2007), chapter 2.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator
from typing import TYPE_CHECKING, Any

import numpy as np

from wear.benchmark.methods import Answer, Method, Run, UnsuitableError
from wear.equation import equation_of
from wear.orbit.period_map import PeriodMap, resolved, settings

if TYPE_CHECKING:
    from wear.scene import Scene

RTOL = 1e-12  # of the wear of one cycle
DECADES = 10.0 ** np.arange(-1, 5)  # of the roughness: wears at which the mesh of phase resolves
CYCLES_ON_END = 4
FIRST_AT_ONCE = 16
LEAST_GROWTH, MOST_GROWTH, CAUTION = 0.2, 5.0, 0.9  # of a jump by error control


class Cycles:
    """The cycles of one scene: their wear in mm, and how many right-hand sides were asked for."""

    def __init__(self, periods: PeriodMap, roughness: Callable[[float], float]) -> None:
        self.periods = periods
        self.roughness = roughness
        self.evaluations = 0

    def wear(self, u: float) -> float:
        """Return D(u), the wear of the cycle that starts at the wear u."""
        return float(self.on_end(u, 1)[0])

    def on_end(self, u: float, number: int) -> Any:
        """Return the wear of each of so many cycles, the first of which starts at u."""
        run = self.periods.consecutive(np.array([u]), number)
        self.evaluations += run.evaluations
        return run.increment[0]

    def frozen(self, u: float) -> float:
        """Return the wear of a cycle if its rate stayed that at the wear u."""
        self.evaluations += self.periods.forcing.size
        return float(self.periods.increment_without_feedback(np.array([[u]]))[0, 0])


def cycles_of(scene: Scene) -> Cycles:
    """Return the cycles of a scene.

    Raises
    ------
    UnsuitableError
        unless the load repeats and the rate is smooth in the wear.
    """
    from wear.faults import UsageError

    if scene.contact.ends_at_3_sigma:
        raise UnsuitableError("not set up for loss of contact")
    try:
        equation = equation_of([scene])
    except UsageError as fault:
        raise UnsuitableError(str(fault)) from fault
    states = np.append(0.0, 4 * equation.scale * DECADES)[None]
    ((_, periods),) = resolved(equation, equation.breakpoints, states, settings(RTOL))
    peak, model = scene.periodic_load.maximum, equation.model
    return Cycles(periods, lambda u: float(model.fields(u, peak).sigma))


Jumps = Callable[[Cycles, int, float], float]
"""The wear after so many cycles, with a number that says how far to jump."""


def extrapolated(
    cycles: Cycles, number: int, length: Callable[[float, float], float]
) -> tuple[float, int]:
    """Return the wear after jumps of Euler's method, and how many there were.

    `length` says how many cycles to jump over from the wear at the start of a cycle and that
    which the cycle adds.
    """
    u, done, jumps = 0.0, 0, 0
    while done < number:
        wear = cycles.wear(u)
        over = min(max(1, int(length(u, wear))), number - done)
        u, done, jumps = u + over * wear, done + over, jumps + 1
    return u, jumps


def fixed_jumps(cycles: Cycles, number: int, share: float) -> float:
    """Return the wear after jumps of this share of all cycles, one at least."""
    return extrapolated(cycles, number, lambda *_: round(share * number))[0]


def adaptive_jumps(cycles: Cycles, number: int, share: float) -> float:
    """Return the wear after jumps that wear off this share of the roughness each."""
    return extrapolated(cycles, number, lambda u, wear: share * cycles.roughness(u) / wear)[0]


def envelope(cycles: Cycles, number: int, tolerance: float) -> float:
    """Return the wear after jumps over which the first and the last cycle are integrated.

    The sum over L cycles is L times the mean of the two, exactly if the wear per cycle is linear in
    their number, and for L = 1.  Half their difference, L times, estimates the error.
    """
    u, done, length, first = 0.0, 0, 1, cycles.wear(0.0)
    while done < number:
        length = min(length, number - done)
        last = cycles.wear(u + (length - 1) * first) if length > 1 else first
        gained = length * (first + last) / 2
        error = length * abs(last - first) / 2
        allowed = tolerance * (u + gained)
        accepted = length == 1 or error <= allowed
        if accepted:
            u, done, first = u + gained, done + length, cycles.wear(u + gained)
        growth = CAUTION * np.sqrt(allowed / error) if error else MOST_GROWTH
        length = max(1 + accepted, int(length * min(max(growth, LEAST_GROWTH), MOST_GROWTH)))
    return u


def averaged(cycles: Cycles, number: int, tolerance: float) -> float:
    """Return the wear by averaging of first order."""
    return _integrated(cycles.frozen, 0.0, number, tolerance)


def stroboscopic(cycles: Cycles, number: int, tolerance: float) -> float:
    """Return the wear by stroboscopic averaging with four cycles on end.

    Where the differences of the wear of a cycle are too large for the series, its first cycles are
    integrated one by one.
    """
    u = 0.0
    for count, increments in _first_cycles(cycles, number, tolerance):
        u += float(np.sum(increments))
        number -= count
    return _integrated(lambda state: _generator(cycles, state)[0], u, number, tolerance)


def _first_cycles(cycles: Cycles, number: int, tolerance: float) -> Iterator[tuple[int, Any]]:
    u, done = 0.0, 0
    while done < number:
        generator, omitted = _generator(cycles, u)
        if omitted <= tolerance * abs(generator):
            return
        increments = cycles.on_end(u, min(FIRST_AT_ONCE, number - done))
        u, done = u + float(np.sum(increments)), done + len(increments)
        yield len(increments), increments


def _generator(cycles: Cycles, u: float) -> tuple[float, float]:
    """Return the rate F per cycle with exp(F) = P, ln(1 + d) = d - d^2/2 + ... in the forward
    differences of P, and the last term of the series."""
    row, terms = cycles.on_end(u, CYCLES_ON_END), []
    for order in range(1, CYCLES_ON_END + 1):
        terms.append((-1) ** (order + 1) * row[0] / order)
        row = np.diff(row)
    return float(sum(terms)), float(abs(terms[-1]))


def _integrated(rate: Callable[[float], float], u: float, number: int, tolerance: float) -> float:
    from scipy.integrate import solve_ivp

    if not number:
        return u
    unit = rate(u)
    found = solve_ivp(
        lambda _, y: [rate(u + unit * y[0]) / unit],
        (0.0, number),
        [0.0],
        method="DOP853",
        t_eval=[number],
        rtol=max(tolerance, 1e-13),
        atol=tolerance,
    )
    return u + unit * float(found.y[0, -1])


def prepared(jumps: Jumps) -> Callable[[Scene], Run]:
    """Return a method's way to get ready for a scene."""

    def prepare(scene: Scene) -> Run:
        cycles = cycles_of(scene)

        def run(number: int, tolerance: float) -> Answer:
            before = cycles.evaluations
            wear = jumps(cycles, number, tolerance)
            return Answer(wear, evaluations=cycles.evaluations - before)

        return run

    return prepare


def _method(name: str, jumps: Jumps, *tolerances: float) -> Method:
    imports = ("wear.orbit.period_map", "scipy.integrate")
    return Method(name, imports, prepared(jumps), tolerances, steps=False)


JUMPS = (
    _method("cycle jump, fixed", fixed_jumps, 1e-1, 1e-2, 1e-3),
    _method("cycle jump, adaptive", adaptive_jumps, 1.0, 0.1, 1e-2),
    _method("averaging, order 1", averaged, 1e-4, 1e-8),
    _method("envelope, order 2", envelope, 1e-2, 1e-4, 1e-6),
    _method("stroboscopic, order 4", stroboscopic, 1e-4, 1e-6, 1e-9, 1e-12),
)
