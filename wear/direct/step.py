"""One leg of an integration: SciPy's solver from one phase to another, where the rate is smooth.

Only this module uses SciPy's solvers. A leg ends early where contact is lost or the rate has a
kink, or by an exception: the roughness vanishes, the time limit passes, or the solver fails.
"""

from __future__ import annotations

import time
from collections.abc import Callable
from dataclasses import dataclass, field
from typing import Any, NamedTuple

import numpy as np

from wear.direct.problem import Real, Setting, WearODE
from wear.numerics.floating_point import ROUNDOFF
from wear.progress import Pace

METHODS = ("DOP853", "RK45", "RK23", "Radau", "BDF", "LSODA")
FINEST_TOLERANCE = 110 * ROUNDOFF  # SciPy accepts no relative tolerance below 100 units of roundoff
NEAR = 1e-6  # of a cycle: largest error of the interpolated end of contact
SAMPLES_PER_STEP = 8  # at which a step is searched for the end of contact
NEARLY, HARDLY_BELOW = 1.0 - 1e-9, 1.0 - 1e-12  # of the wear at which the model ends


class EndOfModelError(Exception):
    """The integration cannot go on; the message says why."""


@dataclass
class Meter:
    """The cost of an integration so far, and its deadline (`time.monotonic`)."""

    deadline: float = np.inf
    pace: Pace = field(default_factory=Pace)
    evaluations: int = 0
    steps: int = 0
    cycles: int = 0
    before: int = 0  # cycles of earlier runs

    def begin(self, run: str, last: int) -> None:
        """Start a run up to the cycle `last`."""
        self.before = self.cycles
        self.pace.begin(f"{run}: cycle", last)

    def step(self, phase: float = 0.0) -> None:
        """Count a step, which ends `phase` cycles after the last counted cycle; raise after the
        deadline."""
        self.steps += 1
        if time.monotonic() > self.deadline:
            raise TimeoutError
        self.pace.at(self.cycles - self.before + phase)


class Leg(NamedTuple):
    """The end of a leg: phase, wear in mm, and whether contact was lost there."""

    phase: float
    u: float
    opened: bool


def leg(
    ode: WearODE,
    u: float,
    start: float,
    end: float,
    setting: Setting,
    meter: Meter,
    longest: float,
    slack: float | None = None,
    kink: Callable[[Real, Real], Real] | None = None,
) -> Leg:
    """Integrate in contact from phase `start` with wear `u` to phase `end`.

    With `slack` (mm) the leg ends as soon as the margin of contact falls below `-slack`; with
    `kink`, a function of phase and wear, where the function changes sign: a kink of the rate.

    Raises
    ------
    TimeoutError, EndOfModelError
    """
    solver = _solver(ode, u, start, end, setting, meter, longest)
    side = 0.0
    while solver.status == "running":
        before = Leg(float(solver.t), u, False)
        complaint = solver.step()
        meter.step(float(solver.t))
        if solver.status == "failed":
            raise EndOfModelError(f"{setting.method} gave up: {str(complaint).rstrip('.')}")
        u = float(solver.y[0]) * ode.unit
        if u >= ode.limit * NEARLY:
            raise EndOfModelError(
                f"the only rough surface has become smooth at u_c = {ode.limit:.6g} mm, "
                "where the model ends"
            )
        if slack is None and kink is None:
            continue
        step = _SolverStep(solver.dense_output(), before.phase, float(solver.t), ode.unit)
        side = side or (0.0 if kink is None else step.side(kink))
        kink_phase = None if kink is None else step.first(kink, factor=side)
        opened = None if slack is None else step.first(ode.margin, slack=slack)
        found = opened if kink_phase is None else kink_phase
        if found is None:
            continue
        # The interpolant is less accurate than a step, and a step over a kink is inaccurate.
        if found > before.phase:
            before = leg(ode, before.u, before.phase, found, setting, meter, longest)
        if kink_phase is not None:
            return before
        return _opened(ode, before, slack or 0.0)
    return Leg(float(solver.t), u, False)


def _opened(ode: WearODE, at: Leg, slack: float) -> Leg:
    """Return the end of contact near a leg's end, by a step of Newton's method on the margin."""
    speed = ode.speed(at.phase, at.u)
    slope = ode.model.margin_slope(at.u, ode.load(at.phase))
    falls = float(ode.load.slope(at.phase) + slope * speed)
    left = float(ode.margin(at.phase, at.u)) + slack
    ahead = float(np.clip(-left / falls, -NEAR, NEAR)) if falls < 0.0 else 0.0
    return Leg(at.phase + ahead, at.u + float(speed) * ahead, True)


def _solver(
    ode: WearODE, u: float, start: float, end: float, setting: Setting, meter: Meter, longest: float
) -> Any:
    from scipy import integrate

    ceiling = ode.limit * HARDLY_BELOW  # no stage of a step may look beyond the end of the model
    scale = ode.load.period / ode.unit
    rate, slope, load = ode.model.rate, ode.model.slope, ode.load

    def right_hand_side(phase: float, y: Any) -> Any:
        meter.evaluations += 1
        return [scale * rate(min(y[0] * ode.unit, ceiling), float(load(phase)))]

    def jacobian(phase: float, y: Any) -> Any:
        meter.evaluations += 1
        return np.array(
            [[ode.load.period * slope(min(y[0] * ode.unit, ceiling), float(load(phase)))]]
        )

    options: dict[str, Any] = (
        {"jac": jacobian} if setting.method in ("Radau", "BDF", "LSODA") else {}
    )
    kind = getattr(integrate, setting.method)
    return kind(
        right_hand_side,
        start,
        [u / ode.unit],
        end,
        rtol=setting.tolerance,
        atol=setting.tolerance,
        max_step=min(longest, end - start) * setting.share,
        **options,
    )


class _SolverStep(NamedTuple):
    """A completed step, with its interpolant."""

    dense: Callable[[Real], Any]
    start: float
    end: float
    unit: float

    def wear(self, phase: Real) -> Real:
        """Return the wear in mm inside the step."""
        return self.dense(phase)[0] * self.unit

    def side(self, function: Callable[[Real, Real], Real]) -> float:
        """Return the sign of a function shortly after the start, where it may be zero."""
        phase = self.start + (self.end - self.start) / SAMPLES_PER_STEP
        return float(np.sign(function(phase, float(self.wear(phase)))))

    def first(
        self, function: Callable[[Real, Real], Real], factor: float = 1.0, slack: float = 0.0
    ) -> float | None:
        """Return the first phase at which a function of phase and wear, times a factor, falls below
        `-slack`."""

        def value(phase: Real) -> Real:
            return factor * function(phase, self.wear(phase)) + slack

        phases = np.linspace(self.start, self.end, SAMPLES_PER_STEP + 1)
        below = np.flatnonzero(value(phases)[1:] < 0.0)
        if len(below) == 0:
            return None
        at = int(below[0])
        return first_zero(value, float(phases[at]), float(phases[at + 1]))


def first_zero(function: Callable[[float], Any], start: float, end: float) -> float:
    """Return the zero of a function that changes sign between `start` and `end`, to roundoff.

    Without a change of sign, as by roundoff, it is the end with the smaller value.
    """
    from scipy.optimize import brentq

    first, last = float(function(start)), float(function(end))
    if first * last >= 0.0:
        return start if abs(first) <= abs(last) else end
    near = ROUNDOFF * max(1.0, abs(end))
    return float(brentq(function, start, end, xtol=near, rtol=8 * ROUNDOFF))
