"""The contact pressure on a compliant support: the root of p = p_max phi(ratio + softness p).

`ratio` is the closure over the roughness with an undeflected support, `softness` the deflection of
the support per pressure, in roughnesses. The left side rises with p and the right side falls, so
that there is exactly one root.

It lies between two known pressures, `lower` and `upper`: the pressure at which h/sigma is at the
law's inflection, and the law's value there. Between them the residual is concave (the law convex)
or convex throughout. Therefore Newton's iteration converges from every start between them: the
first step ends on the side of the root from which tangents do not cross it, or is brought back to
the nearer bound, which is on that side too; every further step goes towards the root and never
beyond. A good start only saves iterations: the generated one solves the law's exponential tail by
Lambert's function; four iterations then suffice unless a soft support is pressed to nearly p_max.

After a step the error is at most half its square times the curvature over the slope of the
residual, that is at most

    softness step^2/2 times the largest |phi''/phi'|

as |phi'| grows towards the inflection. The iteration ends where softness step^2 is a quarter of the
roundoff of p. The remaining error is then below the rounding error of p, which is a roundoff of
h/sigma times |phi'/phi|. See `derive.results.pressure_root`.
"""

from __future__ import annotations

from typing import Any, NamedTuple

import numpy as np

from wear.faults import AccuracyError
from wear.numerics.floating_point import ROUNDOFF

MOST_ITERATIONS = 200  # a factor e each from a bad start: more than the range of doubles needs
CLOSE = ROUNDOFF / 4.0

Real = Any  # a float or an array of floats


class Root(NamedTuple):
    """The pressure in MPa, and the number of iterations of its slowest element."""

    p: Real
    iterations: int


def pressure(module: Any, u: Real, U_a: Real, c: Any, near: Real | None = None) -> Root:
    """Solve for the contact pressure at wear `u` and displacement `U_a` (mm), which broadcast, with
    a generated `module` for a compliant support and its constants `c`.

    `near` is a pressure to start from instead of the general start; any number is allowed. The
    relative accuracy is that of the law's value: a few units of roundoff, times the argument of
    the law where that is large, however small the pressure. Among many states, those without a
    pressure (trial states may be NaN, or have a negative roughness) give NaN.

    Raises
    ------
    AccuracyError
        if a single state has no pressure.
    """
    ratio, softness = module.undeflected(u, U_a, c), module.softness(u, c)
    low, high = module.lower(ratio, softness, c), module.upper(ratio, softness, c)
    p = module.start(ratio, softness, c) if near is None else near
    # Python's own functions take a tenth of the time of NumPy's on scalars.
    scalar = isinstance(ratio, float)
    smaller, larger, any_of = (min, max, bool) if scalar else (np.minimum, np.maximum, np.any)
    count = 0
    moves: Real = True
    while moves and count < MOST_ITERATIONS:
        last = smaller(larger(p, low), high)
        p = module.newton(last, ratio, softness, c)
        step = p - last
        moves = any_of(softness * step * step > CLOSE * p)
        count += 1
    lost = moves or any_of(p != p)
    if lost and near is not None:  # a start so far off that the law had no value there
        return pressure(module, u, U_a, c)
    if lost and (scalar or moves):
        raise AccuracyError("the contact pressure on the compliant support could not be solved for")
    return Root(p, count)
