"""Contact laws: the pressure as a function of closure over roughness.

Overview
    A law is one relation, p = p_max phi(h/sigma).  To add a law, add one entry to LAWS: the
    condensed problem, its right-hand side, the asymptotic pressure, the LaTeX and the
    generated modules follow.
    In floating point a law may need another form.  The printed (1 + tanh x)/2 loses all relative
    accuracy for x << 0: at x = -19 it rounds to 0.  It equals y/(1 + y) with the odds
    y = exp(2x) = p/(p_max - p), which keeps full relative accuracy, and its slope is
    y/(1 + y)/(1 + y), in which nothing overflows.  exp overflows beyond 709.78.  Above 709 the odds
    are held constant: there y/(1 + y) is 1 to the last bit, and the slope is below the smallest
    normal double.  The quotient y/(1 + y)/(1 + y) has its own name: if it were merged with other
    factors, 1 + y times one of them could overflow.
Key results
    ContactLaw   phi, and a form of it for floating point
    TANH         Eq. (4) of the note
    EXPONENTIAL  p_max exp(-h/sigma), the tail of a Greenwood-Williamson contact
    GENERAL      an unspecified positive, decreasing phi, for the general theorems
    StableForm   a form to compute with: intermediates, value and slope
    written_out  an expression with a formula for an unspecified law
    unclamped    an expression without the bound on exponents
"""

from __future__ import annotations

from dataclasses import dataclass
from types import MappingProxyType

import sympy as sp
from sympy.core.function import AppliedUndef, UndefinedFunction

r = sp.Symbol("r", real=True)
"""Closure over equivalent roughness, h/sigma."""

EXP_BOUND = 709
"""Bound of exponents: the largest integer with a finite exponential in double precision."""

odds, share, spread = sp.symbols("odds share spread", positive=True)
"""p/(p_max - p); p/p_max; p (p_max - p)/p_max^2, to which the slope of tanh is proportional."""


@dataclass(frozen=True)
class StableForm:
    """A form of phi(r) and its slope that neither overflows nor loses digits.

    ``intermediates`` are named values in order, each an expression in r and earlier ones, in exact
    form except for exponents clamped at EXP_BOUND.  ``far_value`` and ``far_steepness`` are phi and
    phi'/phi in one expression each that does not overflow for large r, where they tend to a limit.
    """

    intermediates: tuple[tuple[sp.Symbol, sp.Expr], ...]
    value: sp.Expr
    slope: sp.Expr
    far_value: sp.Expr
    far_steepness: sp.Expr


@dataclass(frozen=True)
class ContactLaw:
    """A contact law ``p = p_max phi(r)`` with ``r = h/sigma``.

    phi must be positive, smooth and decreasing (phi' < 0), convex for ``r > inflection`` and
    concave below it (``-oo``: convex everywhere); the root of the pressure on a compliant support
    rests on that.  ``cutoff`` is the ratio h/sigma beyond which the note's text has no contact.  A
    law without a ``form`` is computed by phi and its derivative.
    """

    name: str
    phi: sp.Expr
    inflection: sp.Expr
    source: str
    cutoff: int = 3
    form: StableForm | None = None

    def ratio(self, closure_ratio: sp.Expr) -> sp.Expr:
        """Return p/p_max at the given h/sigma."""
        return self.phi.subs(r, closure_ratio)

    @property
    def stable(self) -> StableForm:
        """Return the form in which the law is computed.

        >>> ContactLaw("square", 1 / (1 + r**2), sp.Integer(1), "an example").stable.slope
        -2*r/(r**2 + 1)**2
        """
        slope = sp.diff(self.phi, r)
        steepness = sp.cancel(slope / self.phi)
        return self.form or StableForm(((share, self.phi),), share, slope, self.phi, steepness)


TANH = ContactLaw(
    name="tanh",
    phi=(1 + sp.tanh(4 - 2 * r)) / 2,
    inflection=sp.Integer(2),
    source="Eq. (4)",
    form=StableForm(
        intermediates=(
            (odds, sp.exp(sp.Min(8 - 4 * r, EXP_BOUND))),
            (share, odds / (1 + odds)),
            (spread, share / (1 + odds)),
        ),
        value=share,
        slope=-4 * spread,
        far_value=1 / (1 + sp.exp(4 * r - 8)),
        far_steepness=-4 / (1 + sp.exp(8 - 4 * r)),
    ),
)

EXPONENTIAL = ContactLaw(
    name="exponential",
    phi=sp.exp(-r),
    inflection=sp.S.NegativeInfinity,
    source="Greenwood and Williamson (1966), exponential distribution of heights",
    form=StableForm(((share, sp.exp(-r)),), share, -share, sp.exp(-r), sp.S.NegativeOne),
)

GENERAL = ContactLaw(
    name="general",
    phi=sp.Function("phi", positive=True)(r),
    inflection=sp.S.NegativeInfinity,
    source="any positive, smooth, decreasing phi",
)

LAWS = MappingProxyType({law.name: law for law in (TANH, EXPONENTIAL)})
"""The laws that code is generated for."""


def written_out(expr: sp.Expr, function: sp.Lambda, name: UndefinedFunction) -> sp.Expr:
    """Return an expression with an unspecified function of one variable, and its slope, written
    out.

    >>> phi = GENERAL.phi.func
    >>> written_out(sp.Symbol("x") * phi(2 * r), sp.Lambda(r, 1 / r), phi)
    x/(2*r)
    """
    (variable,), body = function.signature, function.expr
    slope = sp.diff(body, variable)
    parts = {f: body.xreplace({variable: f.args[0]}) for f in expr.atoms(AppliedUndef)
             if f.func == name}  # fmt: skip
    for rate in expr.atoms(sp.Derivative):
        if rate.expr.func == name and rate.variables == rate.expr.args:
            parts[rate] = slope.xreplace({variable: rate.variables[0]})
    for at in expr.atoms(sp.Subs):
        if at.expr in parts:
            parts[at] = parts[at.expr].xreplace({at.variables[0]: at.point[0]})
    return expr.xreplace(parts)


def unclamped(expr: sp.Expr) -> sp.Expr:
    """Return the exact form of an expression: its exponents without the bound EXP_BOUND."""
    return expr.replace(
        lambda e: isinstance(e, sp.Min) and EXP_BOUND in e.args,
        lambda e: next(argument for argument in e.args if argument != EXP_BOUND),
    )
