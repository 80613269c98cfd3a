"""Wrong versions of a claim: a sign, a factor, an exponent, a missing term, a reversed relation."""

from collections.abc import Iterator

import sympy as sp
from sympy.core.function import AppliedUndef
from sympy.core.relational import Relational


def mutants(claim: sp.Basic) -> Iterator[tuple[str, sp.Basic]]:
    """Yield wrong versions of a claim with what was done to it."""
    if isinstance(claim, sp.And):
        parts = list(claim.args)
        for place, part in enumerate(parts):
            for what, wrong in mutants(part):
                yield what, sp.And(*parts[:place], wrong, *parts[place + 1 :], evaluate=False)
        return
    if isinstance(claim, sp.Equivalent):
        left, right = claim.args
        for what, wrong in (*_shifted(right), *mutants(right)):
            yield what, sp.Equivalent(left, wrong, evaluate=False)
        return
    if not isinstance(claim, Relational):
        return
    if not isinstance(claim, sp.Equality):
        yield "reversed", claim.reversed.func(claim.lhs, claim.rhs, evaluate=False)
        return
    side = claim.rhs if claim.rhs.args or claim.rhs.is_number else claim.lhs
    for what, wrong in _expressions(side):
        left, right = (claim.lhs, wrong) if side is claim.rhs else (wrong, claim.rhs)
        yield what, sp.Eq(left, right, evaluate=False)


def _shifted(claim: Relational) -> Iterator[tuple[str, sp.Basic]]:
    yield "factor", claim.func(claim.lhs, 2 * claim.rhs, evaluate=False)


def _expressions(expr: sp.Expr) -> Iterator[tuple[str, sp.Expr]]:
    if expr == 0:
        yield "factor", sp.Integer(1)
        return
    yield "sign", -expr
    yield "factor", 2 * expr
    for node in sp.postorder_traversal(expr):
        if isinstance(node, sp.Add):
            first, *rest = node.args
            yield "sign of a term", expr.xreplace({node: sp.Add(-first, *rest)})
            yield "missing term", expr.xreplace({node: sp.Add(*rest)})
            break
    powers = [n for n in sp.postorder_traversal(expr) if isinstance(n, sp.Pow)]
    rates = sorted(expr.atoms(sp.Derivative), key=str)
    symbols = [n for n in sp.postorder_traversal(expr) if isinstance(n, (sp.Symbol, AppliedUndef))]
    symbols = rates or symbols
    if powers:
        base, exponent = powers[0].args
        yield "exponent", expr.xreplace({powers[0]: base ** (exponent + 1)})
    elif symbols:
        yield "exponent", expr.xreplace({symbols[0]: symbols[0] ** 2})
