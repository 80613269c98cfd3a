"""A contact law that is given as text: proved, and made into sources.

Overview
    phi is proved to be positive and decreasing; its inflection is found and, if possible, proved
    to be the only one; of several equal forms the one that loses fewest digits is generated.
Key results
    own_law     the contact law
    turns_once  whether its curvature is proved to change its sign at most once
    file_of     the modules of its variants, and a summary of its properties
"""

from __future__ import annotations

import json
from collections.abc import Callable
from contextlib import suppress
from functools import cache
from itertools import pairwise

import mpmath
import numpy as np
import sympy as sp

from .codegen import contact_law
from .codegen.sources import source
from .faults import UsageError
from .law_grammar import normal
from .laws import ContactLaw, StableForm, r, share
from .note.governing import Pin
from .program import program
from .reals import holds
from .rules.proving import smooth_everywhere
from .time_limit import TimeLimitError, time_limit
from .variant import Variant
from .written import evaluated, read
from .zero import is_zero

NAME = "own"
SECONDS = 30.0  # of CPU time for each symbolic step
RANGE = (-5.0, 1e4)  # of h/sigma, in which the rounding error is measured
GOOD = 1e-14  # relative error below which no other form is tried
TINIEST = 1e-280  # smaller values are not compared
DIGITS = 320  # working precision, enough for such values after cancellation
GRID = range(-120, 121)  # quarters of h/sigma at which the curvature is checked
BITS = 10**5  # largest binary exponent of the argument of an exponential, else it takes minutes


@cache
def own_law(text: str) -> tuple[ContactLaw, float]:
    """Return the contact law of a text, and the relative rounding error of its value and slope.

    Raises
    ------
    UsageError
        if the law cannot be read, is not proved to be positive and decreasing, or has more than
        one turn from concave to convex.
    """
    text = normal(text)
    try:
        with time_limit(SECONDS, f"phi = {text}"):
            phi = evaluated(read(text))
            if r not in phi.free_symbols or phi.has(sp.zoo, sp.nan, sp.I):
                raise UsageError(f"phi = {text} is no function of r = h/sigma")
            if not smooth_everywhere(phi):
                said = "has a kink or a pole; phi must be smooth for every r, also below 0"
                raise UsageError(f"phi = {text} {said}")
            if faults := contact_law.faults_of_signs(phi):
                raise UsageError("\n".join(faults))
            (value_loss, value), (slope_loss, slope) = map(_best, (phi, sp.diff(phi, r)))
            row = StableForm(((share, value),), share, slope, value, slope / value)
            law = ContactLaw(NAME, phi, _inflection(phi), f"phi = {text}", form=row)
            if faults := contact_law.faults_of(law):
                raise UsageError("\n".join(faults))
    except (TimeLimitError, ArithmeticError, RecursionError, MemoryError) as fault:
        raise UsageError(f"phi = {text} could not be checked: {fault}") from fault
    return law, max(value_loss, slope_loss)


def _inflection(phi: sp.Expr) -> sp.Expr:
    """Return the r at which phi turns from concave to convex, -oo if it is convex everywhere."""
    curvature = sp.diff(phi, r, 2)
    value = _exactly(curvature)
    with mpmath.workdps(50):
        values = [(mpmath.mpf(x) / 4, value(mpmath.mpf(x) / 4)) for x in GRID]
        signs = [(x, mpmath.sign(y)) for x, y in values if y != 0]
        if not signs:
            raise UsageError("phi is too steep: its curvature vanishes at every quarter of r")
        turns = [(a, b) for (a, s), (b, t) in pairwise(signs) if s != t]
        if not turns and signs[0][1] > 0:
            return sp.S.NegativeInfinity
        if len(turns) != 1 or signs[0][1] > 0:
            raise UsageError("phi must be concave below one value of r and convex above it")
        root = mpmath.findroot(value, turns[0], solver="anderson", tol=1e-60)
        place = sp.Rational(mpmath.nstr(root, 17))
        near = sp.nsimplify(sp.Float(place, 30), rational=True, tolerance=1e-12)
        return near if curvature.subs(r, near) == 0 else place


def turns_once(law: ContactLaw) -> bool:
    """Return whether it is proved that the curvature changes its sign only at the inflection.

    A rational function of an exponential changes its sign at roots of a polynomial, which are
    counted by Sturm's theorem; for other curvatures both signs are decided.

    Raises
    ------
    UsageError
        if it changes its sign elsewhere too.
    """
    place, curvature = law.inflection, sp.diff(law.phi, r, 2)
    quotient, step, _ = _of_exponentials(curvature) or (curvature, None, None)
    if quotient.free_symbols == {step}:
        factors = sp.Mul.make_args(sp.fraction(sp.factor(quotient))[0])
        numerator = sp.Mul(*(f for f in factors if f.as_base_exp()[0] != step))  # powers of it > 0
    if quotient.free_symbols == {step} and numerator.is_polynomial(step):
        odd = [sp.Poly(f, step) for f, n in sp.factor_list(numerator)[1] if n % 2]
        if all(f.domain.is_ZZ or f.domain.is_QQ for f in odd):
            turns = sum(f.count_roots(0) for f in odd)
            if turns != place.is_finite:
                raise UsageError(f"phi turns between concave and convex {turns} times, not once")
            return True
    distance = sp.Dummy(nonnegative=True)
    if not place.is_finite:
        return holds(sp.Ge(curvature, 0))
    above, below = (curvature.subs(r, place + side * distance) for side in (1, -1))
    return holds(sp.Ge(above, 0)) and holds(sp.Le(below, 0))


def _best(expression: sp.Expr) -> tuple[float, sp.Expr]:
    """Return the relative rounding error of the most accurate form of an expression, and the form.

    A quotient in decreasing exponentials neither overflows nor cancels.
    """
    candidates = [(_loss(expression, expression), expression)]
    forms = [_conjugate(expression)]
    if powers := _of_exponentials(expression):
        quotient, step, exponent = powers
        forms.insert(0, sp.factor(quotient).subs(step, sp.exp(exponent)))
    for form in forms:
        if candidates[0][0] > GOOD and is_zero((form - expression).rewrite(sp.exp)):
            candidates.append((_loss(form, expression), form))
    return min(candidates, key=lambda candidate: candidate[0])


def _conjugate(expression: sp.Expr) -> sp.Expr:
    """Return every sum a + b sqrt(q) as (a^2 - b^2 q)/(a - b sqrt(q)), which cancels where that
    does not; sums without a root, or with several, as they are."""
    if not expression.is_Add:
        return expression.func(*map(_conjugate, expression.args)) if expression.args else expression
    powers = [p for p in expression.atoms(sp.Pow) if p.exp.is_Rational and p.exp.q == 2]
    if len(under := {p.base for p in powers}) != 1:
        return expression
    (q,), root = under, sp.Dummy(positive=True)
    plain = expression.xreplace({p: root ** (2 * p.exp) for p in powers})
    (top, odd_top), (low, odd_low) = (
        [sum(c * q ** (n // 2) for (n,), c in sp.Poly(part, root).terms() if n % 2 == odd)
         for odd in (0, 1)]
        for part in sp.fraction(sp.together(plain))
    )  # fmt: skip
    a, b = top * low - odd_top * odd_low * q, odd_top * low - top * odd_low
    norm = low**2 - odd_low**2 * q
    if sp.expand(a) == 0:
        return sp.factor(b / norm) * sp.sqrt(q)
    return sp.factor(sp.expand(a**2 - b**2 * q) / norm) / (a - b * sp.sqrt(q))


def _of_exponentials(expression: sp.Expr) -> tuple[sp.Expr, sp.Symbol, sp.Expr] | None:
    """Return an expression as a rational function of one decreasing exponential, its symbol and
    exponent; None for other expressions."""
    plain = expression.replace(sp.tanh, lambda x: 1 - 2 / (1 + sp.exp(2 * x)))
    slopes = {e.args[0]: sp.diff(e.args[0], r) for e in plain.atoms(sp.exp)}
    if not slopes or not all(slope.is_number for slope in slopes.values()):
        return None
    unit = min(slopes, key=lambda exponent: (float(abs(slopes[exponent])), str(exponent)))
    unit = unit if slopes[unit] < 0 else -unit
    powers = {exponent: sp.cancel(exponent / unit) for exponent in slopes}
    if not all(power.is_Integer for power in powers.values()):
        return None
    step = sp.Dummy(positive=True)
    return plain.subs({sp.exp(e): step**n for e, n in powers.items()}), step, unit


def _loss(form: sp.Expr, exact: sp.Expr) -> float:
    """Return the largest relative error of a form in floating point."""
    return _errors(form, exact)[1][-1]


def _errors(form: sp.Expr, exact: sp.Expr) -> tuple[list[float], list[float]]:
    """Return values of h/sigma, and the largest relative error of a form up to each of them."""
    low, high = RANGE
    at = np.concatenate([np.linspace(low, 10.0, 61), np.geomspace(11.0, high, 40)])
    with np.errstate(all="ignore"):
        rounded = sp.lambdify(r, form, "numpy")(at) + 0.0 * at
    worst, found = 0.0, dict[float, float]()
    with mpmath.workdps(DIGITS):
        value = _exactly(exact)
        finite = np.isfinite(rounded).all()
        for place, approximate in zip(at.tolist(), rounded.tolist(), strict=True) if finite else ():
            true = value(mpmath.mpf(place))
            if abs(true) < TINIEST:
                break  # all further values are smaller
            worst = found[place] = max(worst, float(abs(approximate / true - 1)))
    found = found or {low: float("inf")}  # it overflows, or is too small anywhere to be compared
    return list(found), list(found.values())


def _exactly(expression: sp.Expr) -> Callable[[mpmath.mpf], mpmath.mpf]:
    """Return a function of h/sigma in the precision of mpmath.

    It raises OverflowError where an exponential of an exponential would take minutes.
    """

    def exponential(x: mpmath.mpf) -> mpmath.mpf:
        if mpmath.mag(x) > BITS:
            raise OverflowError("an exponent is too large to be computed")
        return mpmath.exp(x)

    return sp.lambdify(r, expression, [{"exp": exponential}, "mpmath"])


def file_of(text: str, name: str) -> str:
    """Return the text of a file of a law by its name.

    `about.json` has the law, its inflection and its relative rounding errors, the largest and those
    up to values of h/sigma, `law.py` the law and its relative slope; a variant without loss of
    contact is in a module of its name.

    Raises
    ------
    UsageError
        as `own_law` does.
    """
    law, loss = own_law(text)
    if name == "about.json":
        proved = False
        with suppress(TimeLimitError), time_limit(SECONDS, f"phi = {text}"):
            proved = turns_once(law)
        about = {"phi": text, "inflection": str(law.inflection), "inflection_proved": proved}
        errors = _errors(law.stable.intermediates[0][1], law.phi)
        return json.dumps(about | {"rounding_error": loss, "rounding_errors": errors})
    if name == "law.py":
        return contact_law.module(law)
    variants = [Variant(law, compliant, pin) for compliant in (False, True) for pin in Pin]
    chosen = next(variant for variant in variants if f"{variant.module}.py" == name)
    return source(program(chosen), "numpy")
