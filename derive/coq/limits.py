"""Proofs of limits for t -> oo.

Overview
    A limit passes through an expression that SymPy finds: the load is expressed by quantities
    with known limits, the wear by quantities that diverge.
Key results
    proof    the lines of a proof by known limits
"""

from __future__ import annotations

from collections.abc import Iterator

import sympy as sp

from ..rules.limits import in_terms_of, later
from ..symbols import symbol, t
from .printer import term
from .steps import Step

_T = symbol("T")


def proof(step: Step) -> list[str]:
    """Return the lines of a proof by known limits."""
    relation = step.relation
    if not relation.has(sp.Limit):
        return list(_named(step))
    left, right = relation.args
    if right.has(sp.Limit) or not isinstance(left, sp.Limit):
        return _exists(step, left, right)
    return [*_known(step), *_passes(step, left.args[0])]


def _named(step: Step) -> Iterator[str]:
    """Yield the proof that a limit equals its name, since limits are unique."""
    name = step.relation.lhs
    for limit in (s for s in step.limits if isinstance(s.relation.lhs, sp.Limit)):
        for premise in step.statement.premises:
            defined = isinstance(premise.relation, sp.Equality) and premise.relation.lhs == name
            if defined and premise.relation.has(sp.Limit):
                inside = premise.relation.rhs.args[0]
                yield f"apply (tends_unique (fun t => {term(inside)}) _ _ {premise.label})."
                yield f"apply (tends_value _ ({term(limit.relation.rhs)})); [identity |]."
                yield f"generalize ({step.cited(limit)}); apply tends_ext; intros t Ht."
                yield "first [reflexivity | unfold Rdiv; f_equal; field; positive]."
                return


def _known(step: Step) -> list[str]:
    """State the limits of the parents, now and one period later."""
    lines = []
    moves = step.relation.has(t + _T)
    for i, limit in enumerate(step.limits):
        inside, value = limit.relation.lhs.args[0], limit.relation.rhs
        moved = term(later(inside))
        if not isinstance(limit.relation.lhs, sp.Limit):
            continue
        if value == sp.oo:
            lines.append(
                f"pose proof (tends_inv_diverges _ ({step.cited(limit)})) as L{i}; cbv beta in L{i}."
            )
            moved, value = f"/ ({moved})", sp.S.Zero
        else:
            lines.append(f"pose proof ({step.cited(limit)}) as L{i}.")
        if moves:
            proof = f"generalize (later _ _ T L{i}); apply tends_ext; intros; rewrite ?derive_later; first [reflexivity | replace (2 * T + t) with (T + (T + t)) by ring; reflexivity]"
            lines.append(f"assert (M{i} : tends (fun t => {moved}) ({term(value)})) by ({proof}).")
    return lines


def _passes(step: Step, inside: sp.Expr) -> list[str]:
    """Write the expression in terms of known limits, and let the limit pass through it."""
    composed, _ = _composed(step, inside)
    equations = [s for s in step.frontier if s.equates and not s.relation.has(sp.Limit)]
    lines = [f"apply (tends_ext (fun t => {composed})).", "{ intros t Ht."]
    lines += step.signs()
    if inside.has(t + _T):
        lines += ["assert (HT : 0 <= T + t) by lra.", *step.signs("(T + t)", "HT")]
    timed = step.stated([s for s in equations if s.timed])
    return [*lines, f"{timed}insert; identity. }}", "limit."]


def _composed(step: Step, inside: sp.Expr) -> tuple[str, sp.Expr]:
    """Return the expression in terms of quantities with known limits, for Coq, and its limit.

    If no known limit occurs, it should equal the quantity of the first one in another form.
    """
    for other in step.frontier:
        relation = other.relation
        if other.equates and not relation.has(sp.Limit) and other.timed:
            inside = inside.subs(relation.lhs, relation.rhs)
    texts: dict[str, str] = {}
    values: dict[sp.Symbol, sp.Expr] = {}
    for now in (True, False):
        for i, limit in enumerate(sorted(step.limits, key=lambda s: s.relation.rhs == sp.oo)):
            quantity, value = limit.relation.lhs.args[0], limit.relation.rhs
            quantity = quantity if now else later(quantity)
            stand_in = sp.Symbol(f"known{i}{'now' if now else 'later'}", positive=True)
            infinite = value == sp.oo
            text = f"(/ ({term(quantity)}))" if infinite else f"({term(quantity)})"
            replaced = in_terms_of(inside, quantity, 1 / stand_in if infinite else stand_in)
            if replaced.has(stand_in):
                inside, texts[stand_in.name], values[stand_in] = (
                    replaced,
                    text,
                    sp.S.Zero if infinite else value,
                )
    if step.limits and not texts:
        known, value = step.limits[0].relation.args
        return term(known.args[0]), value
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
