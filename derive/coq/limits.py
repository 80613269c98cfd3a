"""Proofs of limits for t -> oo.

Overview
    A limit passes through an expression that SymPy finds: the load is expressed by quantities
    with known limits, the wear by quantities that diverge.
Key results
    proof    the lines of a proof by known limits
"""

from __future__ import annotations

import sympy as sp

from ..rules.limits import in_terms_of, later
from ..symbols import symbol, t
from .printer import term
from .steps import Step, stated

_T = symbol("T")


def proof(step: Step) -> list[str]:
    """Return the lines of a proof by known limits."""
    relation = step.relation
    if not relation.has(sp.Limit):
        return _named(step)
    left, right = relation.args
    if right.has(sp.Limit) or not isinstance(left, sp.Limit):
        return _exists(step, left, right)
    return [*_known(step), *_passes(step, left.args[0])]


def _named(step: Step) -> list[str]:
    """Return the proof that a limit equals its name, since limits are unique."""
    limit = next(f for f in step.limits if isinstance(f.relation.lhs, sp.Limit))
    defined = next(h for h in step.hypotheses if h.relation.args[0] == step.relation.lhs)
    return [
        f"apply (tends_unique (fun t => {term(defined.relation.rhs.args[0])}) _ _ {defined.proof}).",
        f"apply (tends_value _ ({term(limit.relation.rhs)})); [identity |].",
        f"generalize ({limit.proof}); apply tends_ext; intros t Ht.",
        "first [reflexivity | unfold Rdiv; f_equal; field; positive].",
    ]


def _known(step: Step) -> list[str]:
    """State the limits of the parents, now and one period later."""
    lines = []
    moves = step.relation.has(t + _T)
    for i, limit in enumerate(step.limits):
        if not isinstance(limit.relation.lhs, sp.Limit):
            continue
        inside, value = limit.relation.lhs.args[0], limit.relation.rhs
        moved, known = term(later(inside)), limit.proof
        if value == sp.oo:
            moved, value, known = f"/ ({moved})", sp.S.Zero, f"tends_inv_diverges _ ({known})"
        lines.append(f"pose proof ({known}) as L{i}; cbv beta in L{i}.")
        if moves:
            lines.append(
                f"assert (M{i} : tends (fun t => {moved}) ({term(value)})) by one_period_later T L{i}."
            )
    return lines


def _passes(step: Step, inside: sp.Expr) -> list[str]:
    """Write the expression in terms of known limits, and let the limit pass through it."""
    composed, _ = _composed(step, inside)
    lines = [f"apply (tends_ext (fun t => {composed})).", "{ intros t Ht.", step.signs()]
    if inside.has(t + _T):
        lines += ["assert (HT : 0 <= T + t) by lra.", step.signs("(T + t)", "HT")]
    equations = [f for f in step.given if f.equates and f.timed]
    return [*lines, f"{stated(equations)}insert; identity. }}", "limit."]


def _composed(step: Step, inside: sp.Expr) -> tuple[str, sp.Expr]:
    """Return the expression in terms of quantities with known limits, for Coq, and its limit.

    If no known limit occurs, it should equal the quantity of the first one in another form.
    """
    for other in step.given:
        if other.equates and other.timed:
            inside = inside.subs(*other.relation.args)
    now = sorted((f.relation.args for f in step.limits), key=lambda args: args[1] == sp.oo)
    known = [(limit.args[0], value) for limit, value in now]
    known += [(later(quantity), value) for quantity, value in known]
    texts: dict[str, str] = {}
    values: dict[sp.Symbol, sp.Expr] = {}
    for quantity, value in known:
        name = sp.Symbol(f"known{len(texts)}", positive=True)
        diverges = value == sp.oo
        replaced = in_terms_of(inside, quantity, 1 / name if diverges else name)
        if replaced.has(name):
            inside, values[name] = replaced, sp.S.Zero if diverges else value
            texts[name.name] = f"(/ ({term(quantity)}))" if diverges else f"({term(quantity)})"
    if known and not texts:
        quantity, value = known[0]
        return term(quantity), value
    composed = term(inside)
    for name, text in texts.items():
        composed = composed.replace(name, text)
    return composed, inside.xreplace(values)


def _exists(step: Step, left: sp.Expr, right: sp.Expr) -> list[str]:
    """Return the proof that two limits are equal, or that a product with a limit is 0."""
    inner = [e for side in (left, right) for e in sorted(side.atoms(sp.Limit), key=str)]
    _, value = _composed(step, inner[0].args[0])
    passes = [_passes(step, limit.args[0]) for limit in inner]
    first = [*_known(step), f"exists ({term(value)}).", "split.", "{", *passes[0], "}"]
    return [*first, *(passes[1] if len(passes) == 2 else ["ring."])]
