"""The contact pressure on a compliant support: the root of p = p_max phi((h + p/k)/sigma).

The left side rises with p and the right side falls, so that there is exactly one root. The
residual is concave where the contact law is convex, and convex where it is concave; the generated
`start` is the pressure at the law's inflection (or the nearest one in [0, p_max]). If the root lies
above, the residual is negative and concave from there to the root; if below, positive and convex.
In both cases Newton's iteration from the start moves towards the root and never beyond it, for
every wear, load and stiffness. Far from the root each iteration gains at least about a factor e in
the pressure that is missing or in excess; near it the number of digits doubles.

So steps keep their sign until nothing but roundoff is left: that is where the iteration ends.
"""

from __future__ import annotations

from typing import Any, NamedTuple, Protocol

import numpy as np

from wear.faults import AccuracyError

MOST_ITERATIONS = 800  # a factor e each: more than the range of doubles
CLOSE = 2.0 * float(np.finfo(float).eps)

Real = Any  # a float or an array of floats


class CompliantModule(Protocol):
    """A generated module for a compliant support; `c` are its bound constants."""

    def start(self, u: Real, U_a: Real, c: Any) -> Real: ...

    def residual(self, p: Real, u: Real, U_a: Real, c: Any) -> Real: ...

    def residual_slope(self, p: Real, u: Real, U_a: Real, c: Any) -> Real: ...


class Root(NamedTuple):
    """The pressure in MPa, and how many iterations the slowest of its elements took."""

    p: Real
    iterations: int


def pressure(module: CompliantModule, u: Real, U_a: Real, c: Any) -> Root:
    """Solve for the contact pressure at wear `u` and displacement `U_a` (mm), which broadcast.

    The relative accuracy is that of the residual's terms: a few units of roundoff, times the
    argument of the law where that is large, however small the pressure.

    Raises
    ------
    AccuracyError
        if the arguments are no numbers for which the contact law has a value.
    """
    iterate = _one if isinstance(u, float) and isinstance(U_a, float) else _many
    found = iterate(module, u, U_a, c)
    if found is None:
        raise AccuracyError("the contact pressure on the compliant support could not be solved for")
    return found


def _one(module: CompliantModule, u: float, U_a: float, c: Any) -> Root | None:
    """The root for scalars, at a third of the time that arrays of no dimension take."""
    p = module.start(u, U_a, c)
    first = module.residual(p, u, U_a, c)
    if np.ndim(first) > 0:  # the constants of many scenes
        return _many(module, u, U_a, c)
    rises = first < 0.0
    for count in range(1, MOST_ITERATIONS + 1):
        residual = first if count == 1 else module.residual(p, u, U_a, c)
        step = residual / module.residual_slope(p, u, U_a, c)
        p = p - step
        if abs(step) <= CLOSE * p or (step >= 0.0 if rises else step <= 0.0):
            return Root(max(p, np.float64(0.0)), count)
    return None


def _many(module: CompliantModule, u: Real, U_a: Real, c: Any) -> Root | None:
    """The roots for arrays; an element that is done may be iterated on without harm."""
    p = module.start(u, U_a, c)
    towards: Real = None
    done: Real = np.False_
    for count in range(1, MOST_ITERATIONS + 1):
        step = module.residual(p, u, U_a, c) / module.residual_slope(p, u, U_a, c)
        p = p - step
        towards = np.sign(step) if towards is None else towards
        done = done | (np.abs(step) <= CLOSE * np.abs(p)) | (step * towards <= 0.0)
        if np.all(done):
            return Root(np.maximum(p, 0.0), count)
    return None
