"""Proofs: the tactics to try for a lemma, written from the judgement.

Overview
    SymPy proposes proofs, Coq checks them: a wrong proposal does not compile.  A claim is reduced
    to an identity: after the equations that it rests on are inserted, the difference of its sides
    is a multiple of that of a known relation, or an expression of manifest sign.  Limits are in
    ``limits``.
Key results
    script    the proof of a step
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from itertools import islice, product

import sympy as sp
from sympy.core.function import AppliedUndef
from sympy.core.relational import Relational
from sympy.core.relational import _Inequality as Inequality

from ..symbols import t
from . import limits, theorems
from .printer import term
from .steps import Step

_ATOMS = (sp.Symbol, AppliedUndef, sp.Derivative, sp.log)


def script(step: Step, way: int | None = None) -> str:
    """Return the proof of a step: by the tactic with number ``way``, or the first to succeed."""
    cited = theorems.proof(step)
    if not cited and (step.limits or step.relation.has(sp.Limit)):
        cited = "\n".join(limits.proof(step))
    if cited:
        return f"{step.introduction}\n{cited}"
    start = ["intros t Ht.", *step.signs()] if step.timed else []
    ways = _equation if step.equates else inequality
    tactics = dict.fromkeys(ways(step, step.relation))
    if way is not None:
        return "\n".join((step.introduction, *start, f"{next(islice(tactics, way, None))}."))
    trials = (f'timeout 12 ({text}); idtac "WAY {step.name} {i}"' for i, text in enumerate(tactics))
    return "\n".join((step.introduction, *start, "first [\n  " + "\n| ".join(trials) + "]."))


def _sources(step: Step) -> Iterator[list[Step]]:
    """Yield the possible sources of a claim: its parents, then all steps that it rests on."""
    given = [s for s in step.hypotheses if s.equates]
    new = [s for s in given if all(s.statement.conclusion not in p.labels for p in step.parents)]
    for steps in ([*step.frontier, *new], [*step.ancestors, *given]):
        usable = {s.statement.conclusion: s for s in steps if step.timed or not s.timed}
        yield [s for s in usable.values() if not s.relation.has(sp.Limit)]


def _equation(step: Step, goal: sp.Equality) -> Iterator[str]:
    """Yield tactics for an equation, likely ones first."""
    for steps in _sources(step):
        equations = [s for s in steps if s.equates]
        if equations:
            first, *others = equations
            factor = term(_factor(step, first.relation))
            yield f"{step.stated(others)}multiple ({step.at_time(first)}) ({factor})"
        end = "logarithm" if isinstance(goal.lhs, sp.log) else "identity"
        yield f"{step.stated(steps)}insert; {end}"


def _factor(step: Step, given: sp.Equality) -> sp.Expr:
    """Return c for a claim that may be c times an equation, which is linear in its left side."""
    unknown, dummy = step.relation.lhs, sp.Dummy()
    flat = (given.lhs - given.rhs).xreplace({unknown: dummy})
    slope = sp.diff(flat, dummy)
    if isinstance(unknown, _ATOMS) and slope != 0 and not slope.has(dummy):
        return 1 / slope
    factor = sp.cancel(unknown / given.lhs) if given.lhs != 0 else sp.S.One
    return factor if step.relation.rhs == factor * given.rhs else sp.S.One


def _inserted(goal: sp.Basic, equations: Sequence[sp.Equality]) -> sp.Basic:
    """Insert equations into the goal and into each other, as the tactic does."""
    for i, equation in enumerate(equations):
        name, value = equation.args
        if isinstance(name, _ATOMS) and not value.has(name):
            goal = _put(goal, name, value)
            rest = [_put(other, name, value) for other in equations[i + 1 :]]
            return _inserted(goal, rest)
    return goal


def _put(relation: sp.Basic, name: sp.Expr, value: sp.Expr) -> sp.Basic:
    """Insert an equation into a relation without evaluating it."""
    if isinstance(relation, Relational):
        return relation.func(*(a.xreplace({name: value}) for a in relation.args), evaluate=False)
    return relation.func(*(_put(a, name, value) for a in relation.args), evaluate=False)


def inequality(step: Step, claim: sp.Basic) -> Iterator[str]:
    """Yield tactics for an inequality, or for several."""
    for steps in _sources(step):
        at_all_times = (s for s in step.hypotheses if s.timed)
        facts = [bound for s in (*steps, *at_all_times) for bound in _bounds(s.relation)]
        goal = _inserted(claim, [s.relation for s in steps if s.equates])
        start = f"{step.stated(steps)}insert; "
        if isinstance(goal, sp.And):
            parts = (f"first [{' | '.join(_ways(part, facts))}]" for part in goal.args)
            yield f"{start}split; [{' | '.join(parts)}]"
        elif isinstance(goal, sp.Equivalent):
            yield f"{start}split; intro Q; first [arithmetic | from_inequality Q 1]"
        else:
            yield from (f"{start}{way}" for way in _ways(goal, facts))


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


def _ways(goal: sp.Basic, facts: Sequence[Bound]) -> Iterator[str]:
    """Yield tactics for one inequality."""
    if isinstance(goal, Relational):
        yield from _ordered(goal)
    yield "solve [arithmetic]"
    if isinstance(goal, Inequality):
        forms = (*_multiples(goal, facts), *_slacks(goal, facts), *_manifest(goal))
        yield from (f"manifest ({term(form)})" for form in forms)
    yield "same_as_known"


def _multiples(goal: Inequality, facts: Sequence[Bound]) -> Iterator[sp.Expr]:
    """Yield the difference of the sides as multiples of the differences of known inequalities."""
    for low, high in facts:
        factor = sp.factor(sp.cancel((goal.gts - goal.lts) / (high - low)))
        if factor.count_ops() < (goal.gts - goal.lts).count_ops():
            yield sp.Mul(factor, high - low, evaluate=False)


def _slacks(goal: Inequality, facts: Sequence[Bound]) -> Iterator[sp.Expr]:
    """Yield the difference of the sides with positive coefficients in the slacks of inequalities.

    The slack of ``a <= b`` is ``b - a``; it replaces a field or datum in it.
    """
    numerator, denominator = sp.fraction(sp.together(goal.gts - goal.lts))
    places: dict[sp.Expr, list[sp.Expr]] = {}
    for low, high in facts:
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
