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
from itertools import islice, product

import sympy as sp
from sympy.core.function import AppliedUndef
from sympy.core.relational import Relational
from sympy.core.relational import _Inequality as Inequality

from ..rules.limits import later
from ..symbols import t
from . import limits, theorems
from .printer import term
from .statements import Premise
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
    found = (
        _equation(step)
        if isinstance(step.relation, sp.Equality)
        else inequality(step, step.relation)
    )
    if way is not None:
        return "\n".join((*lines, f"{next(islice(_different(found), way, None))}."))
    tried = (
        f'timeout 12 ({text}); idtac "WAY {step.name} {i}"'
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
    facts = (f"pose proof ({p.label} t Ht) as {p.label}_now." for p in _fixed(step))
    return ["intros t Ht.", *facts, *divisors(step)]


def _fixed(step: Step) -> list[Premise]:
    """Return the premises that say an inequality of every time, if the claim does too."""
    premises = step.statement.premises if step.timed else ()
    return [p for p in premises if p.timed and isinstance(p.relation, (Inequality, sp.Ne))]


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
                at = term(relation.rhs if time == "t" else later(relation.rhs))
                now = f" _ {proof}" if other.timed else ""
                here = f" _ {proof}" if premise.timed else ""
                said = f"rewrite <- ({step.cited(other)}{now}); exact ({premise.label}{here})"
                lines.append(f"assert (0 < {at}) by ({said}).")
    return list(dict.fromkeys(lines))


def stated(step: Step, steps: Sequence[Step]) -> tuple[str, list[Named]]:
    """Return the tactic that states the claims of other steps at this time, and their labels."""
    text, named = "", list[Named]()
    for i, other in enumerate(s for s in steps if not s.relation.has(sp.Limit)):
        parts = other.relation.args if isinstance(other.relation, sp.And) else [other.relation]
        labels = [f"P{i}" if len(parts) == 1 else f"P{i}_{j}" for j in range(len(parts))]
        pattern = f"[{' '.join(labels)}]" if len(parts) > 1 else labels[0]
        text += f"pose proof ({step.cited(other)}{' t Ht' if other.timed else ''}) as {pattern}; "
        named += zip(labels, parts, strict=True)
    return text, named


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
            yield text + _from_first(goal, equations, getattr(step.judgement.rule, "factor", None))
        lines, _ = _inserted(goal, equations)
        unequal = [label for label, e in named if isinstance(e, sp.Ne)]
        unequal += [f"{p.label}_now" for p in _fixed(step) if isinstance(p.relation, sp.Ne)]
        lines += [f"rewrite ?{e} in {label}" for label in unequal for e, _ in equations]
        yield text + "; ".join(
            (*lines, "logarithm" if isinstance(goal.lhs, sp.log) else "identity")
        )


def _from_first(goal: sp.Equality, equations: list[Named], factor: sp.Expr | None) -> str:
    """Insert the further equations into the first, of which the goal then is a multiple."""
    (first, relation), *others = equations
    lines = []
    for label, other in others:
        if relation.has(other.lhs) and _atomic(other.lhs):
            lines.append(f"rewrite {label} in {first}")
            relation = _replaced(relation, other.lhs, other.rhs)
    if factor is None:
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
    return isinstance(expr, (sp.Symbol, AppliedUndef, sp.Derivative, sp.log))


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


def inequality(step: Step, claim: sp.Basic) -> Iterator[str]:
    """Return the ways in which an inequality, or several, may follow."""
    for text, named in _sources(step):
        equations = [(label, e) for label, e in named if isinstance(e, sp.Equality)]
        facts = [(label, e) for label, e in named if not isinstance(e, sp.Equality)]
        facts += [(f"{p.label}_now", p.relation) for p in _fixed(step)]
        known = [label for label, _ in facts]
        lines, goal = _inserted(claim, equations)
        insert = "".join(f"{line}; " for line in lines)
        into = [
            f"{''.join(f'rewrite ?{e} in {label}; ' for e, _ in equations)}same_inequality {label}"
            for label in known
        ]
        if isinstance(goal, sp.And):
            parts = " | ".join(
                f"first [{' | '.join((*_rests(part, facts), *_parts(part, known)))}]"
                for part in goal.args
            )
            yield f"{text}{insert}split; [{parts}]"
        elif isinstance(goal, sp.Equivalent):
            yield f"{text}{insert}split; intro H; first [arithmetic | from_inequality H 1]"
        else:
            order = list(_ordered(goal))
            alone = [w for w in _parts(goal, []) if w not in order]
            more = (*_multiples(goal, facts), *_rests(goal, facts))
            for way in (*order, *more, *into, *alone):
                yield f"{text}{insert}{way}"
    for text, _ in _sources(step):
        yield f"{text}solve [arithmetic]"


def _multiples(goal: sp.Basic, facts: list[Named]) -> Iterator[str]:
    """Return ways by an inequality of which the goal is a multiple."""
    if isinstance(goal, Inequality):
        for label, fact in facts:
            if isinstance(fact, Inequality) and not fact.atoms(sp.Abs):
                factor = sp.factor(sp.cancel((goal.gts - goal.lts) / (fact.gts - fact.lts)))
                if factor.count_ops() < (goal.gts - goal.lts).count_ops():
                    yield f"from_inequality {label} ({term(factor)})"


def _rests(goal: sp.Basic, facts: list[Named]) -> Iterator[str]:
    """Return ways by a polynomial whose coefficients are positive in the rests of inequalities.

    The rest of ``a <= b`` is ``b - a``; it takes the place of a field or datum in it.
    """
    if not isinstance(goal, Inequality):
        return
    numerator, denominator = sp.fraction(sp.together(goal.gts - goal.lts))
    places: dict[sp.Expr, list[sp.Expr]] = {}
    for _, fact in facts:
        for low, high in _bounds(fact):
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
            yield f"manifest ({term((inside / sp.factor(denominator)).xreplace(back))})"


def _bounds(fact: sp.Basic) -> Iterator[tuple[sp.Expr, sp.Expr]]:
    """Return the sides of the inequalities that a relation consists of."""
    for part in fact.args if isinstance(fact, sp.And) else (fact,):
        if isinstance(part, Inequality):
            if isinstance(part.lts, sp.Abs):
                yield from ((part.lts.args[0], part.gts), (-part.gts, part.lts.args[0]))
            else:
                yield part.lts, part.gts


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
        turned = list(map(_turned, sp.Mul.make_args(sp.factor(flat))))
        sign = sp.Mul(*(s for s, _ in turned))
        yield sp.Mul(*((f if i else sign * f) for i, (_, f) in enumerate(turned))).xreplace(back)
        numerator, denominator = sp.fraction(sp.together(flat))
        yield (sp.expand(numerator) / sp.factor(denominator)).xreplace(back)


def _turned(factor: sp.Expr) -> tuple[int, sp.Expr]:
    """Return the sign, where all is below 1, of a power of a sum, and what remains."""
    base, power = factor.as_base_exp()
    if not base.is_Add or not power.is_Integer:
        return 1, factor
    draw = random.Random(1)
    size = base.subs([(s, draw.uniform(0.1, 0.9)) for s in sorted(base.free_symbols, key=str)])
    return (1, factor) if size > 0 else ((-1) ** int(power), (-base) ** power)


def _ordered(goal: sp.Basic) -> Iterator[str]:
    """Return proofs by an increasing tanh, or a decreasing law, on the two sides."""
    if not isinstance(goal, Relational):
        return
    low, high = goal.lts, goal.gts
    form = next(_manifest(goal))
    for a in sorted(low.atoms(sp.tanh), key=sp.default_sort_key) if high.has(sp.exp) else ():
        below = f"pose proof (share_below_exp ({term(a.args[0])})) as Q"
        yield f"{below}; manifest_by Q ({term(form)})"
    for function in (sp.tanh, sp.Function("phi", positive=True)):
        for a in sorted(low.atoms(function), key=sp.default_sort_key):
            for b in sorted(high.atoms(function), key=sp.default_sort_key):
                yield f"ordered ({term(a.args[0])}) ({term(b.args[0])}) ({term(form)})"
