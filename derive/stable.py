"""Rewrites for floating point: one table, each row with its proof and its domain.

Overview
    The printed (1 + tanh x)/2 loses all relative accuracy for x << 0: at x = -19 nothing is
    left of it.  It equals y/(1 + y) with the odds y = exp(2x) = p/(p_max - p), which keeps full
    relative accuracy, and its slope is y/(1 + y)/(1 + y), in which nothing overflows.
    exp overflows beyond 709.78.  Above 709 the odds are held: y/(1 + y) is 1 to the last bit
    there, and the slope is below the smallest normal double.  The quotient y/(1 + y)/(1 + y) has
    a name of its own: merged with other factors, 1 + y times one of them could overflow.
Key results
    Stable        intermediates, value and slope of a law, in a form to compute with
    STABLE        the table
    stable        how to compute a law: its row, or the law as it stands
    proof         the identities a row rests on, and their checks
"""

from __future__ import annotations

from dataclasses import dataclass
from types import MappingProxyType

import sympy as sp

from .kernel import Judgement
from .laws import EXPONENTIAL, LAWS, TANH, ContactLaw, r
from .rules.algebra import Identity

HELD = 709
"""Argument beyond which the odds are held: the largest integer whose exponential is finite."""

odds = sp.Symbol("odds", positive=True)
"""p/(p_max - p), the odds of full contact."""

share = sp.Symbol("share", positive=True)
"""p/p_max, the share of full contact."""

spread = sp.Symbol("spread", positive=True)
"""p (p_max - p)/p_max^2, to which the slope of the tanh law is proportional."""


@dataclass(frozen=True)
class Stable:
    """How to compute phi(r) and its slope.

    ``names`` are intermediates in order, each an expression in r and earlier ones, in exact
    form but for exponents held below HELD.  ``domain`` states where the forms are exact to
    rounding.  ``far_value`` and ``far_steepness`` are phi and phi'/phi in one expression each that
    does not overflow for large r, where they tend to a limit; None where the plain form does not.
    """

    names: tuple[tuple[sp.Symbol, sp.Expr], ...]
    value: sp.Expr
    slope: sp.Expr
    domain: str
    far_value: sp.Expr | None = None
    far_steepness: sp.Expr | None = None


@dataclass(frozen=True, kw_only=True)
class ComputedLaw(ContactLaw):
    """A contact law with a row of its own, proved where it was made."""

    row: Stable


STABLE = MappingProxyType(
    {
        TANH.name: Stable(
            names=(
                (odds, sp.exp(sp.Min(8 - 4 * r, HELD))),
                (share, odds / (1 + odds)),
                (spread, share / (1 + odds)),
            ),
            value=share,
            slope=-4 * spread,
            domain="every h/sigma",
            far_value=1 / (1 + sp.exp(4 * r - 8)),
            far_steepness=-4 / (1 + sp.exp(8 - 4 * r)),
        ),
        EXPONENTIAL.name: Stable(
            names=((share, sp.exp(-r)),),
            value=share,
            slope=-share,
            domain=f"h/sigma > -{HELD}",
        ),
    }
)
"""Rewrites by the name of the law."""


def stable(law: ContactLaw) -> Stable:
    """Return the row of a law; a law without one is computed as it stands.

    >>> stable(ContactLaw("square", 1 / (1 + r**2), sp.Integer(1), "an example")).slope
    -2*r/(r**2 + 1)**2
    """
    if isinstance(law, ComputedLaw):
        return law.row
    plain = Stable(((share, law.phi),), share, sp.diff(law.phi, r), "where phi is computed well")
    return STABLE.get(law.name, plain)


def proof(law_name: str) -> tuple[Judgement, Judgement]:
    """Return the two identities of a row: its value is phi, its slope is phi'."""
    law = LAWS[law_name]
    row = stable(law)
    value, slope = row.value, row.slope
    for name, form in reversed(row.names):
        value, slope = (e.xreplace({name: released(form)}) for e in (value, slope))
    pairs = ((law.phi, value), (sp.diff(law.phi, r), slope))
    of_value, of_slope = (Identity(sp.Eq(*pair, evaluate=False))() for pair in pairs)
    return of_value, of_slope


def released(expr: sp.Expr) -> sp.Expr:
    """Return an expression with its exponents no longer held: the exact form."""
    return expr.replace(
        lambda e: isinstance(e, sp.Min) and HELD in e.args,
        lambda e: next(argument for argument in e.args if argument != HELD),
    )
