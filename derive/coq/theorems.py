"""Steps that cite one general theorem of the library: the values for its parameters.

Overview
    The forms of the proofs are in ``library/theorems.jinja``, a macro for each rule; here SymPy
    finds the values that they insert and that Coq does not read off the goal.
Key results
    proof       a proof, empty where no theorem is known for the step
    template    a template of proofs
"""

from __future__ import annotations

from functools import cache

import sympy as sp
from jinja2 import Template

from ..rules.growth import expanded
from ..rules.limits import in_terms_of
from ..symbols import DATA, symbol, t
from ..templates import templates
from .printer import always, proposition, quantity, term
from .statements import Fact
from .steps import Step, stated

LOAD, WEAR, SUPPORT = map(symbol, ("U_a", "u_c", "U_c"))
RATIO = sp.Symbol("ratio", real=True)


def rate_of(y: sp.Expr, step: Step) -> Fact | None:
    """Return what a step knows of the rate of a field, None if nothing."""
    rates = (f for f in step.ancestors if f.equates and f.relation.lhs == sp.Derivative(y, t))
    return next(rates, None)


def slope_of_wear(y: sp.Expr, step: Step) -> tuple[sp.Expr, sp.Expr]:
    """Return P > 0 and a != 0 for the slope P/a of the wear as a function of y.

    A constant beside the data is eliminated by the wear, so that the sign of P is manifest.
    """
    u, level = step.given[1].relation.args
    apart = sp.Mul(*(s.relation.lhs for s in step.given if isinstance(s.relation, sp.Ne)))
    (odds,) = level.atoms(sp.log)
    above, below = sp.fraction(odds.args[0])
    name, rise = sp.symbols("odds rise")
    flat = level.subs(odds, name)
    positive = -(flat.diff(y) + flat.diff(name) * rise) * apart.subs(odds, name)
    for unknown in (s for s in level.free_symbols if s.name not in DATA | {"t"}):
        positive = positive.subs(unknown, sp.solve(u - flat, unknown)[0])
    rises = {name: odds, rise: above.diff(y) / above - below.diff(y) / below}
    return sp.collect(sp.expand(sp.cancel(positive)), rise).xreplace(rises), -apart


def vanishing(inside: sp.Expr, u: sp.Expr) -> list[tuple[sp.Expr, ...]]:
    """Return exponentials that fall with u, with c and a of their exponents ``a - c u``."""
    exponents = {e: sp.expand(e.args[0]) for e in inside.atoms(sp.exp) if e.has(u)}
    return [(e, -sp.diff(x, u), x.subs(u, 0)) for e, x in exponents.items()]


def at_infinity(inside: sp.Expr, u: sp.Expr) -> tuple[sp.Expr, ...]:
    """Return a load a, z, A(z) and B(z), so that the expression is ``u A(1/u) + a B(1/u)``."""
    z = sp.Dummy("z", positive=True)
    flat, support = inside.xreplace({u: 1 / z}), SUPPORT if inside.has(SUPPORT) else 0
    n, level = expanded(sp.expand(flat.subs(LOAD, support)), z)
    m, slope = expanded(sp.diff(sp.expand(flat), LOAD), z)
    return LOAD - support, z, z ** (1 - n) * level, z**-m * slope


def proof(step: Step) -> str:
    """Return a proof by a general theorem, empty where there is none for the step."""
    return str(getattr(template("theorems").module, step.rule, lambda _: "")(step))


@cache
def template(name: str) -> Template:
    """Return a template of proofs."""
    environment = templates(__package__, "library")
    words = (always, at_infinity, in_terms_of, proposition, quantity, rate_of)
    known = {each.__name__: each for each in (*words, slope_of_wear, stated, term, vanishing)}
    environment.filters |= known
    environment.globals |= known | {"t": t, "LOAD": LOAD, "WEAR": WEAR, "RATIO": RATIO}
    return environment.get_template(f"{name}.jinja")
