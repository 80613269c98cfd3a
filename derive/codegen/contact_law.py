"""A contact law as code: its value and relative slope in forms that do not overflow.

Key results
    faults_of   the properties without which no code is written for a law
    formulas    share p/p_max and relative slope of a law
    module      the source of a module with them
"""

from __future__ import annotations

import sympy as sp

from ..laws import ContactLaw, r, unclamped
from ..reals import sign
from ..zero import is_zero
from .formulas import Formula, formula_module

_DISTANCES = tuple(sp.Rational(d) for d in ("-8", "-1", "-1/8", "1/8", "1", "8"))
"""Distances from the inflection, in h/sigma, at which the curvature of a law is checked."""


def faults_of(law: ContactLaw) -> tuple[str, ...]:
    """Return the unproved properties of a law: positive, decreasing, one inflection, exact form.

    >>> from derive.laws import TANH
    >>> faults_of(TANH)
    ()
    """
    slope = sp.diff(law.phi, r)
    faults = [f"{law.name}: {fault}" for fault in faults_of_signs(law.phi)]
    everywhere = not law.inflection.is_finite
    place = sp.Integer(0) if everywhere else law.inflection
    convex = [bool(sp.diff(slope, r).subs(r, place + d).evalf(30) > 0) for d in _DISTANCES]
    if convex != [everywhere or d > 0 for d in _DISTANCES]:
        faults.append(f"{law.name}: phi does not turn from concave to convex at {law.inflection}")
    forms = zip(_exact_forms(law), (law.phi, slope), strict=True)
    if not all(is_zero((form - exact).rewrite(sp.exp)) for form, exact in forms):
        faults.append(f"{law.name}: the form to compute with is not phi")
    return tuple(faults)


def faults_of_signs(phi: sp.Expr) -> tuple[str, ...]:
    """Return what is not proved of the signs of a law and its slope."""
    slope, hint = sp.diff(phi, r), "if it is, write phi otherwise"
    faults = []
    if sign(phi) != 1:
        faults.append(
            f"phi must be positive: {phi} is not proved to be positive for every r; {hint}"
        )
    if sign(slope) != -1:
        faults.append(
            f"phi must decrease: its slope {slope} is not proved to be negative for every r, "
            f"also below 0; {hint}"
        )
    return tuple(faults)


def _exact_forms(law: ContactLaw) -> tuple[sp.Expr, sp.Expr]:
    """Return the computed forms of value and slope, in r alone and without bounded exponents."""
    value, slope = law.stable.value, law.stable.slope
    for name, form in reversed(law.stable.intermediates):
        value, slope = (e.xreplace({name: unclamped(form)}) for e in (value, slope))
    return value, slope


def formulas(law: ContactLaw) -> tuple[Formula, Formula]:
    """Return p/p_max and phi'/phi at h/sigma = r."""
    share, exact = law.stable.far_value, sp.diff(law.phi, r) / law.phi
    # one exponential, not a quotient that overflows
    slope = sp.powsimp(law.stable.far_steepness, deep=True)
    value, relative = "share p/p_max of the largest pressure", "relative slope phi'/phi"
    return (
        Formula(f"share_{law.name}", (r,), equal(share, law.phi), f"{value} at h/sigma = r"),
        Formula(f"steepness_{law.name}", (r,), equal(slope, exact), f"{relative} at h/sigma = r"),
    )


def equal(form: sp.Expr, exact: sp.Expr) -> sp.Expr:
    """Return the form; ValueError unless it is proved to equal the exact expression."""
    if not is_zero(form - exact):
        raise ValueError(f"{form} is not {exact}")
    return form


def module(law: ContactLaw) -> str:
    """Return the source of a module with the value and the relative slope of one law."""
    return formula_module("A contact law.", ("4",), formulas(law))
