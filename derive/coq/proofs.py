"""Proofs: the tactics that a lemma is tried with, written from the judgement.

Overview
    SymPy proposes, Coq disposes: what is written here may be wrong, and then does not compile.
    An equation becomes an identity when those that it rests on are inserted; an inequality has
    a difference of manifest sign, or follows from one by an increasing function.  Limits are in
    ``limits``.
Key results
    script    the proof of a step
"""

from __future__ import annotations

import random
from collections.abc import Iterable, Iterator, Sequence
from itertools import islice

import sympy as sp
from sympy.core.function import AppliedUndef
from sympy.core.relational import Relational

from ..symbols import symbol
from . import limits, theorems
from .printer import term
from .steps import Step

_UNKNOWN = sp.Symbol("unknown", real=True)
Named = tuple[str, sp.Basic]


def script(step: Step, way: int | None = None) -> str:
    """Return the proof of a step; by one of its ways, or by the first that succeeds."""
    cited = theorems.proof(step) or (
        limits.proof(step) if step.limits or step.relation.has(sp.Limit) else []
    )
    if cited:
        return "\n".join((step.introduction, *cited))
    lines = [step.introduction, *now(step)]
    found = _equation(step) if isinstance(step.relation, sp.Equality) else _inequality(step)
    if way is not None:
        return "\n".join((*lines, f"{next(islice(_different(found), way, None))}."))
    tried = (
        f'timeout 6 ({text}); idtac "WAY {step.name} {i}"'
        for i, text in enumerate(_different(found))
    )
    return "\n".join((*lines, "first [\n  " + "\n| ".join(tried) + "]."))


def _different(ways: Iterable[str]) -> Iterator[str]:
    """Return the ways, each once."""
    seen = set()
    for way in ways:
        if way not in seen:
            seen.add(way)
            yield way


def now(step: Step) -> list[str]:
    """Return the lines that fix an instant, and say what is positive then."""
    if not step.statement.conclusion.startswith("forall t, "):
        return []
    lines = ["intros t Ht."]
    for premise in step.statement.premises:
        if (
            premise.timed
            and not isinstance(premise.relation, sp.Equality)
            and premise.relation is not sp.true
        ):
            lines.append(f"pose proof ({premise.label} t Ht) as {premise.label}_now.")
    return lines + divisors(step)


def divisors(step: Step, time: str = "t", proof: str = "Ht") -> list[str]:
    """State that what the claim divides by is positive, where it is a field that is."""
    lines = []
    for other in step.ancestors:
        if isinstance(other.relation, Relational) and not isinstance(other.relation, sp.Equality):
            at = f" ({time}) {proof}" if other.timed else ""
            lines.append(f"pose proof ({step.cited(other)}{at}).")
    claims = [step.relation, *(p.relation for p in step.ancestors)]
    below = {
        e.base
        for c in claims
        for e in c.atoms(sp.Pow)
        if not e.exp.is_positive or not e.exp.is_Integer
    }
    below |= {sp.sqrt(e) for e in below}
    for other in step.ancestors:
        relation = other.relation
        if not isinstance(relation, sp.Equality) or relation.rhs not in below:
            continue
        for premise in step.statement.premises:
            if isinstance(premise.relation, sp.Gt) and premise.relation.args == (relation.lhs, 0):
                at = term(relation.rhs if time == "t" else limits.one_period_later(relation.rhs))
                said = (
                    f"rewrite <- ({step.cited(other)} _ {proof}); exact ({premise.label} _ {proof})"
                )
                lines.append(f"assert (0 < {at}) by ({said}).")
    return list(dict.fromkeys(lines))


def stated(step: Step, steps: Sequence[Step]) -> tuple[str, list[Named]]:
    """Return the tactic that states the claims of other steps at this time, and their labels."""
    named = [(f"P{i}", s) for i, s in enumerate(steps) if not s.relation.has(sp.Limit)]
    at = {True: " t Ht", False: ""}
    text = "; ".join(f"pose proof ({step.cited(s)}{at[s.timed]}) as {label}" for label, s in named)
    return f"{text}; " if text else "", [(label, s.relation) for label, s in named]


def _sources(step: Step) -> Iterator[tuple[str, list[Named]]]:
    """Return what a claim may follow from: the parents, or all that it rests on."""
    own = [s for s in step.hypotheses if isinstance(s.relation, sp.Equality)]
    new = [s for s in own if all(s.statement.conclusion not in p.labels for p in step.parents)]
    for steps in ([*step.frontier, *new], [*step.ancestors, *own]):
        usable = {s.statement.conclusion: s for s in steps if step.timed or not s.timed}
        yield stated(step, list(usable.values()))


def _equation(step: Step) -> Iterator[str]:
    """Return the ways in which an equation may follow, likely ones first."""
    goal = step.relation
    for text, named in _sources(step):
        equations = [(label, e) for label, e in named if isinstance(e, sp.Equality)]
        if equations:
            yield text + _from_first(goal, equations)
        lines, _ = _inserted(goal, equations)
        yield text + "; ".join((*lines, "identity"))


def _from_first(goal: sp.Equality, equations: list[Named]) -> str:
    """Insert the further equations into the first, which then is the goal."""
    (first, relation), *others = equations
    lines = []
    for label, other in others:
        if relation.has(other.lhs) and _atomic(other.lhs):
            lines.append(f"rewrite {label} in {first}")
            relation = _replaced(relation, other.lhs, other.rhs)
    factor = _factor(goal.lhs - goal.rhs, relation.lhs - relation.rhs, goal.lhs)
    return "; ".join((*lines, f"from_equation {first} ({term(factor)})"))


def _replaced(relation: sp.Basic, left: sp.Expr, right: sp.Expr) -> sp.Basic:
    """Insert an equation into a relation that is not to be decided by that."""
    if isinstance(relation, Relational):
        return relation.func(*(a.xreplace({left: right}) for a in relation.args), evaluate=False)
    return relation.func(*(_replaced(a, left, right) for a in relation.args), evaluate=False)


def _factor(goal: sp.Expr, known: sp.Expr, unknown: sp.Expr) -> sp.Expr:
    """Return c with ``goal = c known``, as far as numbers show."""
    candidates = [sp.S.One, sp.S.NegativeOne]
    if _atomic(unknown) and known.has(unknown):
        slope = sp.diff(known.xreplace({unknown: _UNKNOWN}), _UNKNOWN).xreplace({_UNKNOWN: unknown})
        candidates += [1 / slope] if slope != 0 else []
    found = (c for c in candidates if _vanishes(goal - c * known))
    return next(found, sp.S.One)


def _vanishes(expr: sp.Expr) -> bool:
    """Return whether an expression is 0 at a point."""
    draw = random.Random(1)
    for kind in (sp.Derivative, AppliedUndef, sp.Symbol):
        atoms = sorted(expr.atoms(kind), key=str)
        expr = expr.xreplace({a: sp.Float(draw.uniform(0.5, 1.5), 30) for a in atoms})
    size = sp.N(expr.doit(), 20)
    return bool(size.is_number and abs(size) < 1e-15) if not size.atoms(sp.Subs) else False


def _atomic(expr: sp.Expr) -> bool:
    return isinstance(expr, (sp.Symbol, AppliedUndef, sp.Derivative))


def _inserted(goal: sp.Basic, equations: list[Named]) -> tuple[list[str], sp.Basic]:
    """Insert equations into the goal, each after those that bring in its left side."""
    rules: dict[sp.Expr, tuple[str, sp.Expr]] = {}
    for label, relation in equations:
        left, right = relation.args
        if _atomic(left) and left not in rules and not _reaches(rules, right, left):
            rules[left] = (label, right)
    lines = []
    for left in _sorted(rules):
        if goal.has(left):
            label, right = rules[left]
            lines.append(f"rewrite ?{label}")
            goal = _replaced(goal, left, right)
    return lines, goal


def _reaches(rules: dict[sp.Expr, tuple[str, sp.Expr]], expr: sp.Expr, goal: sp.Expr) -> bool:
    if expr.has(goal):
        return True
    return any(_reaches(rules, right, goal) for left, (_, right) in rules.items() if expr.has(left))


def _sorted(rules: dict[sp.Expr, tuple[str, sp.Expr]]) -> list[sp.Expr]:
    """Return the left sides, each after all whose right sides contain it."""
    done: list[sp.Expr] = []

    def visit(left: sp.Expr) -> None:
        if left not in done:
            for other, (_, right) in rules.items():
                if right.has(left) and other != left:
                    visit(other)
            done.append(left)

    for left in rules:
        visit(left)
    return done


def _inequality(step: Step) -> Iterator[str]:
    """Return the ways in which an inequality, or several, may follow."""
    for text, named in _sources(step):
        equations = [(label, e) for label, e in named if isinstance(e, sp.Equality)]
        known = [label for label, e in named if not isinstance(e, sp.Equality)]
        lines, goal = _inserted(step.relation, equations)
        insert = "".join(f"{line}; " for line in lines)
        into = [
            f"{''.join(f'rewrite ?{e} in {label}; ' for e, _ in equations)}same_inequality {label}"
            for label in known
        ]
        if isinstance(goal, sp.And):
            parts = " | ".join(f"first [{' | '.join(_parts(part, known))}]" for part in goal.args)
            yield f"{text}{insert}split; [{parts}]"
        elif isinstance(goal, sp.Equivalent):
            yield f"{text}{insert}split; intro; arithmetic"
            for label in known:
                yield f"{text}{insert}split; intro; [apply {label} | apply {label}]; arithmetic"
        else:
            order = list(_ordered(goal))
            for way in (*order, *into, *(w for w in _parts(goal, []) if w not in order)):
                yield f"{text}{insert}{way}"
    yield from _last_ways(step)


def _last_ways(step: Step) -> Iterator[str]:
    """Return the ways of a bound that a bounded load gives."""
    text, _ = next(_sources(step))
    yield from (f"{text}manifest ({term(form)})" for form in _loaded(step.relation))


def _parts(goal: sp.Basic, known: list[str]) -> Iterator[str]:
    """Return the ways of one inequality."""
    yield "solve [arithmetic]"
    yield from (f"same_inequality {label}" for label in known)
    yield from (f"manifest ({term(form)})" for form in _manifest(goal))
    yield from _ordered(goal)


def _manifest(goal: sp.Basic) -> Iterator[sp.Expr]:
    """Return forms of the difference of the sides that may show its sign."""
    if isinstance(goal, Relational):
        difference = goal.gts - goal.lts
        hidden = sorted(difference.atoms(sp.Function, sp.Derivative), key=sp.default_sort_key)
        functions = {f: sp.Symbol(f"field_{i}", real=True) for i, f in enumerate(hidden)}
        back = {dummy: f for f, dummy in functions.items()}
        flat = difference.xreplace(functions)
        yield sp.factor(flat).xreplace(back)
        numerator, denominator = sp.fraction(sp.together(flat))
        yield (sp.expand(numerator) / sp.factor(denominator)).xreplace(back)


def _loaded(goal: sp.Basic) -> Iterator[sp.Expr]:
    """Return forms of the difference that are positive for every load between -U and U."""
    if not isinstance(goal, Relational):
        return
    numerator, denominator = sp.fraction(sp.together(goal.gts - goal.lts))
    load, bound, rest = symbol("U_a"), symbol("U"), sp.Symbol("rest", positive=True)
    for sign in (1, -1) if numerator.has(load) and numerator.has(bound) else ():
        inside = sp.expand(sp.expand(numerator).subs(load, sign * (rest - bound)))
        if all(term.as_coeff_Mul()[0] > 0 for term in sp.Add.make_args(inside)):
            yield (inside / sp.factor(denominator)).xreplace({rest: bound + sign * load})


def _ordered(goal: sp.Basic) -> Iterator[str]:
    """Return proofs by an increasing tanh, or a decreasing law, on the two sides."""
    if not isinstance(goal, Relational):
        return
    low, high = goal.lts, goal.gts
    for function in (sp.tanh, sp.Function("phi", positive=True)):
        for a in sorted(low.atoms(function), key=sp.default_sort_key):
            for b in sorted(high.atoms(function), key=sp.default_sort_key):
                form = next(_manifest(goal))
                yield f"ordered ({term(a.args[0])}) ({term(b.args[0])}) ({term(form)})"
