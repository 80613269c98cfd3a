"""Proofs: the tactics that close a lemma, written from the judgement.

Overview
    SymPy proposes proofs, Coq checks them: a wrong proposal does not compile.  A claim is reduced
    to an identity: after the equations that it rests on are inserted, the difference of its sides
    is a multiple of that of a known relation, or an expression of manifest sign.  General theorems
    are in ``theorems``, limits in ``limits``.
Key results
    script    the proof of a step
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence
from itertools import product
from operator import methodcaller

import sympy as sp
from sympy.core.function import AppliedUndef
from sympy.core.relational import Relational
from sympy.core.relational import _Inequality as Inequality

from ..claims import Claim, claim_of
from ..symbols import t
from . import limits, theorems
from .printer import term
from .steps import Step, stated

_NAMES = (sp.Symbol, AppliedUndef, sp.Derivative, sp.log)


def script(step: Step) -> str:
    """Return the proof of a step."""
    labels = " ".join(step.labels.values())
    return "\n".join(([f"intros {labels}."] if labels else []) + _body(step))


def _body(step: Step) -> list[str]:
    if cited := theorems.proof(step):
        return [cited]
    if step.limits or step.relation.has(sp.Limit):
        return limits.proof(step)
    start = ["intros t Ht.", step.signs()] if step.timed else []
    equates = isinstance(step.relation, sp.Equality)
    return [*start, f"{_equation(step) if equates else _inequality(step, step.relation)}."]


def _equation(step: Step) -> str:
    """Return the tactic for an equation: a multiple of the first one that it rests on, or equal."""
    equations = [fact for fact in step.sources if fact.equates]
    if not equations:
        return "equal"
    first, *others = equations
    factor = _factor(step, first.relation)
    tactic = "by_equation" if factor is None else f"multiple ({term(factor)})"
    return f"{stated(others)}{tactic} ({first.at()})"


def _factor(step: Step, given: sp.Equality) -> sp.Expr | None:
    """Return c for a claim that is c times an equation, if its left side gives c."""
    name, dummy = step.relation.lhs, sp.Dummy()
    slope = sp.diff((given.lhs - given.rhs).xreplace({name: dummy}), dummy)
    if isinstance(name, _NAMES) and slope != 0 and not slope.has(dummy):
        return 1 / slope
    factor = sp.cancel(name / given.lhs) if given.lhs != 0 else sp.S.One
    return factor if step.relation.rhs == factor * given.rhs else None


def _inserted(goal: Claim, equations: Iterable[sp.Basic]) -> Claim:
    """Insert equations into the goal and into each other, as the tactic does."""
    rest = [claim_of(equation) for equation in equations]
    while rest:
        name, value = rest.pop(0).relation.args
        if isinstance(name, _NAMES) and not value.has(name):
            insert = methodcaller("xreplace", {name: value})
            goal, *rest = (claim.map(insert) for claim in (goal, *rest))
    return goal


def _inequality(step: Step, claim: sp.Basic) -> str:
    """Return the tactic for an inequality, or for two."""
    implicit = (f for f in step.ancestors if f.equates and not isinstance(f.relation.lhs, _NAMES))
    facts = list(dict.fromkeys((*step.sources, *implicit)))
    bounds = [b for f in (*facts, *step.hypotheses) for b in _bounds(f.relation)]
    goal = _inserted(claim_of(claim), [f.relation for f in facts if f.equates]).relation
    start = f"{stated(f for f in facts if f.equates or not step.timed)}insert; "
    if isinstance(goal, sp.Equivalent):
        if step.rule == "Substitute":
            known, *equations = (fact.at() for fact in step.given)
            rewritten = "".join(f"rewrite ({equation}) in Q; " for equation in equations)
            return f"pose proof ({known}) as Q; {rewritten}exact Q"
        return f"{start}split; intro Q; first [arithmetic | from_inequality Q 1]"
    if isinstance(goal, sp.And):
        return f"{start}split; [{' | '.join(_first(_ways(part, bounds)) for part in goal.args)}]"
    return start + _first(_ways(goal, bounds))


def _first(tactics: Iterable[str]) -> str:
    """Return the first of several tactics that succeeds."""
    return f"first [{' | '.join(dict.fromkeys(tactics))}]"


Bound = tuple[sp.Expr, sp.Expr]
"""The smaller and the larger side."""


def _bounds(fact: sp.Basic) -> Iterator[Bound]:
    """Yield the inequalities in a relation."""
    for part in fact.args if isinstance(fact, sp.And) else (fact,):
        if isinstance(part, Inequality):
            if isinstance(part.lts, sp.Abs):
                yield from ((part.lts.args[0], part.gts), (-part.gts, part.lts.args[0]))
            else:
                yield part.lts, part.gts


def _ways(goal: sp.Basic, bounds: Sequence[Bound]) -> Iterator[str]:
    """Yield tactics for one inequality."""
    if isinstance(goal, Relational):
        yield from _ordered(goal)
    yield "solve [arithmetic]"
    if isinstance(goal, Inequality):
        forms = (*_multiples(goal, bounds), *_slacks(goal, bounds), *_manifest(goal))
        yield from (f"manifest ({term(form)})" for form in forms)
    yield "same_as_known"


def _multiples(goal: Inequality, bounds: Sequence[Bound]) -> Iterator[sp.Expr]:
    """Yield the difference of the sides as multiples of the differences of known inequalities."""
    for low, high in bounds:
        factor = sp.factor(sp.cancel((goal.gts - goal.lts) / (high - low)))
        if factor.count_ops() < (goal.gts - goal.lts).count_ops():
            yield sp.Mul(factor, high - low, evaluate=False)


def _slacks(goal: Inequality, bounds: Sequence[Bound]) -> Iterator[sp.Expr]:
    """Yield the difference of the sides with positive coefficients in the slacks of inequalities.

    The slack of ``a <= b`` is ``b - a``; it replaces a field or datum in it.
    """
    numerator, denominator = sp.fraction(sp.together(goal.gts - goal.lts))
    places: dict[sp.Expr, list[sp.Expr]] = {}
    for low, high in bounds:
        for atom in sorted((high - low).atoms(AppliedUndef, sp.Symbol), key=str):
            if atom != t and numerator.has(atom) and sp.diff(high - low, atom) in (1, -1):
                places.setdefault(atom, []).append(high - low)
    chosen = sorted(places, key=lambda a: (not a.args, str(a)))[:3]
    for choice in product(*([*places[a], None] for a in chosen)):
        inside, back = numerator, {}
        for i, (atom, rest) in enumerate(zip(chosen, choice, strict=True)):
            if rest is not None:
                name = sp.Symbol(f"rest_{i}", positive=True)
                back[name] = rest
                inside = sp.expand(inside).subs(atom, atom + (name - rest) / sp.diff(rest, atom))
        inside = sp.expand(inside)
        if back and all(part.as_coeff_Mul()[0] > 0 for part in sp.Add.make_args(inside)):
            yield (inside / sp.factor(denominator)).xreplace(back)


def _manifest(goal: Relational) -> Iterator[sp.Expr]:
    """Yield forms of the difference of the sides that may show its sign.

    One has factors that are positive where all quantities are below one, the other a numerator of
    separate terms.
    """
    difference = goal.gts - goal.lts
    hidden = sorted(difference.atoms(sp.Function, sp.Derivative), key=sp.default_sort_key)
    functions = {f: sp.Symbol(f"field_{i}", real=True) for i, f in enumerate(hidden)}
    back = {dummy: f for f, dummy in functions.items()}
    flat = difference.xreplace(functions)
    point = {s: sp.Rational(3 + i, 20) for i, s in enumerate(sorted(flat.free_symbols, key=str))}
    factored = sp.factor(flat)
    if flat.subs(point) > 0:
        factored = sp.Mul(*(f * sp.sign(f.subs(point)) for f in sp.Mul.make_args(factored)))
    yield factored.xreplace(back)
    numerator, denominator = sp.fraction(sp.together(flat))
    yield (sp.expand(numerator) / sp.factor(denominator)).xreplace(back)


def _ordered(goal: Relational) -> Iterator[str]:
    """Yield tactics by the increase of tanh, or the decrease of a law, on the two sides."""
    low, high = goal.lts, goal.gts
    form = term(next(_manifest(goal)))
    for a in sorted(low.atoms(sp.tanh), key=sp.default_sort_key) if high.has(sp.exp) else ():
        yield f"pose proof (share_below_exp ({term(a.args[0])})) as Q; manifest_by Q ({form})"
    for function in (sp.tanh, sp.Function("phi", positive=True)):
        for a in sorted(low.atoms(function), key=sp.default_sort_key):
            for b in sorted(high.atoms(function), key=sp.default_sort_key):
                yield f"ordered ({term(a.args[0])}) ({term(b.args[0])}) ({form})"
