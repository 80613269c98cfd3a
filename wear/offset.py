"""The offset: what steady wear remembers of its start.

Overview
    In the steady regime ``u_c(N T) = R N + A ln N + B + o(1)``.  R and A follow from the data;
    B needs the whole history, but after enough cycles it can be read off: the wear at one cycle
    is inserted into the long-time expansion (``derive show expansion``), here to a high order
    and for any load, variant and contact law.  The series of the rate in 1/u comes from the
    generated code itself, evaluated with Laurent series; averaging separates drift and
    oscillation order by order.
Key results
    Expansion     R, A, and B from the wear after any number of cycles
    expand        the expansion of a scene; None if its wear does not become steady
    offset        B of a scene, with an error estimate
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from wear.faults import AccuracyError
from wear.history import History
from wear.laurent import Laurent, NotSteady
from wear.model import Model, bind
from wear.numerics.gauss import (
    Mesh,
    integral,
    mesh,
    running_integral,
)
from wear.scene import Scene
from wear.solver import solve

FloatArray = NDArray[np.float64]

ORDER = 10
"""Powers of 1/u in the expansion."""

_NODES = 48
_CYCLES = tuple(10**n for n in range(1, 13))
"""Numbers of cycles after which the wear is tried."""

_SETTLED = 40
"""Iterations that invert z(m); each gains a factor m^2/w_1."""

_FAR = 1e12
"""Roughnesses of wear at which a contact that comes to last does so."""

_RESOLVED = 1e-6
"""Relative error of B beyond which it is not known."""


class Offset(NamedTuple):
    """B in mm, an estimate of its absolute error, and the cycle that it was found from."""

    value: float
    error: float
    cycle: float


@dataclass(frozen=True)
class Expansion:
    """Wear in the steady regime, ``z = u + shift = m + sum of wave_n/m^n`` at whole cycles.

    ``m`` grows by ``rate (1 + sum of drift_n/m^n)`` per cycle; both lists begin at n = 1.
    """

    rate: float
    shift: float
    drift: FloatArray
    wave: FloatArray

    @property
    def log_coefficient(self) -> float:
        """A, mm."""
        return float(self.drift[0])

    def offset(self, u: float, cycle: float) -> tuple[float, float]:
        """Return B from the wear after ``cycle`` cycles, and the size of the last terms used.

        Not a number where the wear is too small for the expansion.
        """
        z = u + self.shift
        powers = np.arange(1.0, len(self.drift) + 1)
        with np.errstate(all="ignore"):
            m = z
            for _ in range(_SETTLED):
                m = z - float(np.sum(self.wave / m**powers))
            inverse = _reciprocal(self.drift)
            tail = inverse[1:] / (powers[:-1] * m ** powers[:-1])
            slow = m + inverse[0] * np.log(m) - np.sum(tail)
            start = slow - self.rate * cycle
            value = start + self.log_coefficient * np.log(self.rate) - self.shift
        return float(value), float(abs(tail[-1]) + abs(tail[-2]))


def expand(scene: Scene, order: int = ORDER) -> Expansion | None:
    """Return the long-time expansion of a scene, or None if its wear does not become steady."""
    model, load = bind(scene), scene.periodic_load
    over = mesh(np.array(sorted({0.0, *load.kinks, 1.0})), _NODES)
    displacement = load(over.phases)
    infinite = 1.0 / Laurent.variable(order + 2)
    try:
        roughness = _roughness(model, infinite)
        if roughness.valuation != -1 or not roughness.coefficients[0] > 0.0:
            return None
        shift = float(roughness.coefficients[1] / roughness.coefficients[0])
        rate = _rate(model, infinite - shift, displacement)
    except NotSteady:
        return None
    if rate.valuation != 0 or not np.all(rate.coefficients[0] > 0.0):
        return None
    steady = float(rate.coefficients[0].flat[0])
    terms = rate.coefficients[: order + 1] / steady
    per_cycle = steady * load.period
    drift, wave = _average(terms, per_cycle, over)
    return Expansion(per_cycle, shift, drift, wave)


def offset(scene: Scene, rtol: float = 1e-13) -> Offset | None:
    """Return B of a scene in mm; None if its wear does not become steady within 1e12 cycles.

    Where contact may be lost that takes contact which lasts throughout the cycle in the end.

    The wear after 10, 100, ... cycles gives B as many times, once contact is never lost.  The
    estimated error is that of the wear and of rounding, which grow with the number of cycles, and
    the last terms of the expansion, which fall; the cycle with the least of both is taken.
    """
    expansion = expand(scene) if _contact_lasts(scene) else None
    if expansion is None:
        return None
    history = _history(scene, rtol)
    if history is None:
        return None
    found, model = [], bind(scene)
    for cycle, u, error in zip(history.cycles, history.u_c, history.error, strict=True):
        value, last = expansion.offset(float(u), float(cycle))
        rounding = float(u) * (float(error) + 4.0 * np.finfo(float).eps)
        known = last + rounding <= _RESOLVED * abs(value)
        if known and _is_permanent(model, scene, float(u)):
            found.append(Offset(value, last + rounding, float(cycle)))
    return min(found, key=lambda each: each.error, default=None)


def _contact_lasts(scene: Scene) -> bool:
    """Whether cycles can be counted until contact, once for all, lasts throughout the cycle."""
    if not scene.contact.ends_at_3_sigma:
        return True
    return _is_permanent(bind(scene), scene, _FAR * scene.initial_roughness)


def _is_permanent(model: Model, scene: Scene, u: float) -> bool:
    """Whether contact by the law lasts throughout the cycle at the wear `u` (mm) and beyond."""
    if not model.ends_at_3_sigma:
        return True
    return bool(model.margin(u, scene.periodic_load.minimum) > model.held_margin)


def _history(scene: Scene, rtol: float) -> History | None:
    """The wear after each number of cycles, by the cycle count alone: no other reaches so far."""
    try:
        return solve(scene, _CYCLES, rtol, method="abel")
    except AccuracyError as fault:
        best: History | None = fault.best
        return best


def _roughness(model: Model, u: Laurent) -> Laurent:
    """Return the equivalent roughness as a series."""
    arguments = (0.0, u) if model.compliant else (u,)
    fields = model.module.fields(*arguments, 0.0, model.constants)
    return u.like(fields.sigma)


def _rate(model: Model, u: Laurent, load: FloatArray) -> Laurent:
    """Return the wear rate as a series; the pressure of a compliant support by iteration.

    The pressure acts back with a factor 1/u, so that each iteration settles one coefficient.
    """
    if not model.compliant:
        return u.like(model.module.rate(u, load, model.constants))
    p = u.like(0.0 * load)
    for _ in range(u.terms):
        p = p - model.module.residual(p, u, load, model.constants)
    return u.like(model.module.rate(p, model.constants))


def _average(terms: FloatArray, rate: float, over: Mesh) -> tuple[FloatArray, FloatArray]:
    """Average ``dz/dtau = rate * sum of terms_n(tau)/z^n`` order by order.

    Returns the drift c_n and the oscillation w_n at phase 0, for n = 1, 2, ...  See
    ``derive.averaging``, which does the same with symbols.
    """
    terms = np.broadcast_to(terms, (len(terms), *over.phases.shape))
    flat = np.zeros(over.phases.shape)
    drift, waves, begins = [1.0], [flat], [0.0]
    for n in range(1, len(terms)):
        known = _right(terms, waves, n)
        known = known - sum((-k * drift[n - k - 1] * waves[k] for k in range(1, n)), flat)
        mean = float(integral(known, over))
        running = running_integral(known - mean, over)
        start = -float(integral(running, over))
        drift.append(mean)
        waves.append(rate * (running + start))
        begins.append(rate * start)
    return np.array(drift[1:]), np.array(begins[1:])


def _right(terms: FloatArray, waves: list[FloatArray], n: int) -> FloatArray:
    """Return the coefficient of 1/m^n in ``sum of terms_k/z^k``."""
    ratio = np.zeros((n + 1, *terms.shape[1:]))  # z/m
    ratio[0] = 1.0
    for k in range(1, n):
        ratio[k + 1] = waves[k]
    inverse = 1.0 / Laurent(ratio, -1)
    power: Laurent = inverse.like(1.0)
    total = np.zeros(terms.shape[1:])
    for k in range(n + 1):
        total = total + terms[k] * power.from_power(0)[n]
        power = power * inverse
    return total


def _reciprocal(drift: FloatArray) -> FloatArray:
    """Return the coefficients n >= 1 of ``1/(1 + sum of drift_n e^n)``."""
    series = Laurent(np.concatenate([[1.0], drift]))
    return (1.0 / series).coefficients[1:]
