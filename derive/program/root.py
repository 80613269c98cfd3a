"""The functions of the equation for the pressure on a compliant support.

At given wear and load the pressure p is the root of p = p_max phi(undeflected + softness p):
undeflected is h/sigma with an undeflected support, softness the deflection of the support per
pressure, over sigma.  The root lies between two known pressures: that with h/sigma at the
inflection of the law, and that of the law at its inflection.  Between them the curvature of the
residual has one sign, so that the first Newton step from anywhere in between ends on a known side
of the root, and the next ones converge monotonically.  See `derive.results.pressure_root`.

Key results
    root    residual, undeflected, softness, start, lower, upper, newton
"""

from __future__ import annotations

from functools import cache

import sympy as sp

from ..laws import ContactLaw, r
from ..variant import Variant
from .function import Assignment, Function, pruned
from .functions import law, p_max, to_ratio
from .relations import roughnesses
from .symbols import compliance, h, load, number, pressure, ratio, sigma, u

undeflected, softness = map(number, ("undeflected", "softness"))
"""The parameters of the equation: h/sigma with an undeflected support; the support's deflection
per pressure, over sigma."""

rise, level, grown, height = map(number, ("rise", "level", "grown", "height"))


def root(variant: Variant) -> tuple[Function, ...]:
    """Return the equation of the pressure, bounds of its root, a start and Newton's step."""
    names, value, slope = law(variant)
    edge = _edge(variant.law)
    of_equation = (undeflected, softness)
    law_at = (*to_ratio(variant, deflected=True), *names)
    step = (
        (ratio, undeflected + softness * pressure),
        *names,
        (rise, -p_max * softness * slope),
    )
    stepped = (p_max * value + rise * pressure) / (1 + rise)
    return (
        pruned("residual", (pressure, u, load), law_at, pressure - p_max * value),
        pruned("undeflected", (u, load), to_ratio(variant, deflected=False)[:-1], h / sigma),
        pruned("softness", (u,), roughnesses(variant), compliance / sigma),
        _start(variant.law),
        pruned("lower", of_equation, (), sp.Max(0, sp.Min(*edge))),
        pruned("upper", of_equation, (), sp.Max(*edge)),
        pruned("newton", (pressure, *of_equation), step, stepped),
    )


def _edge(law: ContactLaw) -> tuple[sp.Expr, sp.Expr]:
    """Return two pressures that enclose the root, between which the law has no inflection.

    For a law that is convex everywhere any ratio serves.
    """
    at = law.inflection if law.inflection.is_finite else sp.Integer(0)
    value = law.ratio(at)  # of an inflection with 17 digits: its roots have integers without bound
    return (at - undeflected) / softness, p_max * (value if value.is_Rational else value.n(17))


def _start(of: ContactLaw) -> Function:
    """Return an estimate of the root, close to it if the law decays exponentially.

    With phi = A exp(-m r) the root is W(z)/(m softness), z = A m softness p_max exp(-m undeflected)
    and Lambert's W, which w (1 - ln(1 + w)/(2 + w)) with w = ln(1 + z) equals to a few percent.
    """
    names: tuple[Assignment, ...] = ()
    amplitude, steepness = tail(of)
    if steepness == 0:
        estimate = _edge(of)[0]
    else:
        logarithm = sp.log(steepness * p_max * softness) + sp.log(amplitude)
        names = (
            (level, logarithm - steepness * undeflected),
            (grown, 1 + sp.exp(-sp.Abs(level))),
            (height, sp.Max(level, 0) + sp.log(grown)),
        )
        estimate = height * (1 - sp.log(1 + height) / (2 + height)) / (steepness * softness)
    return pruned("start", (undeflected, softness), names, estimate)


@cache
def tail(of: ContactLaw) -> tuple[sp.Expr, sp.Expr]:
    """Return A and m of a law that tends to A exp(-m r) for large r; m = 0 if it does not.

    >>> from ..laws import TANH
    >>> tail(TANH)
    (exp(8), 4)
    """
    form = of.stable
    m = -sp.limit(form.far_steepness.rewrite(sp.exp), r, sp.oo)
    if not (m.is_finite and m.is_positive):
        return sp.Integer(0), sp.Integer(0)
    return sp.limit(form.far_value.rewrite(sp.exp) * sp.exp(m * r), r, sp.oo), m
