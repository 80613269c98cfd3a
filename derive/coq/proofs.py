"""Proofs: the tactics that close a lemma, written from the judgement.

Overview
    SymPy proposes proofs, Coq checks them: a wrong proposal does not compile.  A claim is reduced
    to an identity: after the equations that it rests on are inserted, the difference of its sides
    is a multiple of that of a known relation, or an expression of manifest sign.  A limit passes
    through an expression that SymPy finds: the load is expressed by quantities with known limits,
    the wear by quantities that diverge.  General theorems are in ``theorems``.
Key results
    script    the proof of a step
"""

from __future__ import annotations

from collections.abc import Iterable
from itertools import product
from operator import methodcaller

import sympy as sp
from sympy.core.function import AppliedUndef
from sympy.core.relational import _Inequality as Inequality

from ..claims import Claim, claim_of
from ..rules.limits import in_terms_of, later
from ..symbols import symbol, t
from . import theorems
from .printer import term
from .steps import Step, stated

_T = symbol("T")
_NAMES = (sp.Symbol, AppliedUndef, sp.Derivative, sp.log)


def script(step: Step) -> str:
    """Return the proof of a step."""
    labels = " ".join(step.labels.values())
    return "\n".join(([f"intros {labels}."] if labels else []) + _body(step))


def _body(step: Step) -> list[str]:
    if cited := "assumption." if step.assumed else theorems.proof(step):
        return [cited]
    if step.limits or step.relation.has(sp.Limit):
        return _limit(step)
    start = ["intros t Ht.", step.signs()] if step.timed else [step.signs("")]
    equates = isinstance(step.relation, sp.Equality)
    return [*start, f"{_equation(step) if equates else _inequality(step)}."]


def _equation(step: Step) -> str:
    """Return the tactic for an equation: a multiple of the first one that it rests on, or equal."""
    equations = [fact for fact in step.sources if fact.equates]
    if not equations:
        return "equal"
    first, *others = equations
    slope = _slope(first.relation, step.relation.lhs)
    tactic = f"multiple ({term(1 / slope)})" if slope else "by_equation"
    return f"{stated(others)}{tactic} ({first.at()})"


def _slope(given: sp.Equality, name: sp.Expr) -> sp.Expr:
    """Return the coefficient of a name in an equation that is linear in it, 0 if it is not."""
    dummy = sp.Dummy()
    slope = sp.diff((given.lhs - given.rhs).xreplace({name: dummy}), dummy)
    return slope if isinstance(name, _NAMES) and not slope.has(dummy) else sp.S.Zero


def _inserted(goal: Claim, equations: Iterable[sp.Basic]) -> Claim:
    """Insert equations into the goal and into each other, as the tactic does."""
    rest = [claim_of(equation) for equation in equations]
    while rest:
        name, value = rest.pop(0).relation.args
        if isinstance(name, _NAMES) and not value.has(name):
            insert = methodcaller("xreplace", {name: value})
            goal, *rest = (claim.map(insert) for claim in (goal, *rest))
    return goal


def _inequality(step: Step) -> str:
    """Return the tactic for an inequality, or for two."""
    implicit = (f for f in step.ancestors if f.equates and not isinstance(f.relation.lhs, _NAMES))
    equations = [f for f in dict.fromkeys((*step.sources, *implicit)) if f.equates]
    goal = _inserted(claim_of(step.relation), (f.relation for f in equations)).relation
    start = f"{stated(equations)}insert; "
    if isinstance(goal, sp.Equivalent):
        return f"{start}equivalent"
    if isinstance(goal, sp.And):
        return f"{start}split; [{' | '.join(map(_tactic, goal.args))}]"
    return start + _tactic(goal)


def _tactic(goal: sp.Basic) -> str:
    """Return the tactic for one inequality."""
    return f"by_signs ({term(_manifest(goal))})" if isinstance(goal, Inequality) else "arithmetic"


def _manifest(goal: Inequality) -> sp.Expr:
    """Return the difference of the sides by factors that are positive where all quantities are
    below one, if it is."""
    difference = goal.gts - goal.lts
    hidden = sorted(difference.atoms(sp.Function, sp.Derivative), key=sp.default_sort_key)
    functions = {f: sp.Symbol(f"field_{i}", real=True) for i, f in enumerate(hidden)}
    flat = difference.xreplace(functions)
    point = {s: sp.Rational(3 + i, 20) for i, s in enumerate(sorted(flat.free_symbols, key=str))}
    factored = sp.factor(flat)
    if flat.subs(point) > 0:
        factored = sp.Mul(*(f * sp.sign(f.subs(point)) for f in sp.Mul.make_args(factored)))
    return factored.xreplace({dummy: f for f, dummy in functions.items()})


def _limit(step: Step) -> list[str]:
    """Return the lines of a proof by known limits."""
    if not step.relation.has(sp.Limit):
        return [f"by_name ({step.limits[0].proof})."]
    state = "known_and_later T" if step.relation.has(t + _T) else "known_limit"
    known = [f"{state} ({limit.proof})." for limit in step.limits]
    left, right = step.relation.args
    if right.has(sp.Limit) or not isinstance(left, sp.Limit):
        return [*known, "same_limit."]
    return [*known, *_passes(step, left.args[0])]


def _passes(step: Step, inside: sp.Expr) -> list[str]:
    """Write the expression in terms of known limits, and let the limit pass through it."""
    equations = [f for f in step.given if f.equates and f.timed]
    for equation in equations:
        inside = inside.subs(*equation.relation.args)
    start = f"apply (tends_ext (fun t => {_composed(step, inside)})).\n{{ intros t Ht."
    lines = [start, step.signs()]
    if inside.has(t + _T):
        lines += ["assert (HT : 0 <= T + t) by lra.", step.signs("(T + t)", "HT")]
    return [*lines, f"{stated(equations)}insert; rewrite ?derive_later; identity. }}", "limit."]


def _composed(step: Step, inside: sp.Expr) -> str:
    """Return an expression as a function of known limits, and of them one period later.

    If none occurs, it should equal the first one in another form.
    """
    arguments: dict[sp.Symbol, str] = {}
    for time, limit in product(("t", "T + t"), step.limits):
        quantity, value = limit.relation.lhs.args[0], limit.relation.rhs
        name = sp.Symbol(f"known{len(arguments)}", positive=True)
        part, form = (1 / name, "/ ({})") if value == sp.oo else (name, "{}")
        replaced = in_terms_of(inside, quantity if time == "t" else later(quantity), part)
        if replaced.has(name):
            inside = replaced
            arguments[name] = f"((fun t => {form.format(term(quantity))}) ({time}))"
    if not arguments:
        return term(step.limits[0].relation.lhs.args[0] if step.limits else inside)
    return f"(fun {' '.join(map(str, arguments))} => {term(inside)}) {' '.join(arguments.values())}"
