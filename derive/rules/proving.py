"""Side conditions: the facts in premises, and the domains of expressions.

Overview
    The claims and hypotheses of premises are facts; ``derive.reals`` decides their consequences.
    ``require_defined`` requires values of denominators, roots, logarithms and integrals.
Key results
    facts_of                 the facts in premises
    lasts                    whether a claim holds at every time, lasting_facts those that do
    require                  RuleError unless a relation follows from premises
    require_defined          RuleError unless every part of an expression has a value
    require_integrands       the same, also for what it integrates
    undefined                the relations that are missing
    continuous               whether an expression is continuous at a point
    coefficients             the slopes and the rest of what is affine in some parts
"""

from __future__ import annotations

import operator
from collections.abc import Collection, Iterable, Iterator, Mapping, Set

import sympy as sp
from sympy.core.function import AppliedUndef
from sympy.core.relational import Relational
from sympy.functions.elementary.piecewise import ExprCondPair

from ..claims import Asymptotic, Continuous, FirstZero, HasValue, Limit, Property, Term
from ..hypotheses import DIFFERENTIABLE, LOAD
from ..kernel import Judgement, RuleError
from ..laws import r
from ..memory import cache
from ..note.model import WEARING
from ..parts import bound, bound_in, certain, needs, positive
from ..reals import LAW, holds, sign
from ..symbols import CLOCKS, symbols, t
from ..zero import is_zero
from .reading import clocks, constant, functions

#: Heads of integrands that are continuous on each of finitely many pieces.
_PIECES = (sp.Piecewise, ExprCondPair, Relational)
#: Functions that are differentiable wherever they have a value; roots but at 0.
_SMOOTH = (
    *(sp.Add, sp.Mul, sp.Pow, sp.exp, sp.tanh, sp.log, sp.Ei, sp.LambertW, AppliedUndef),
    *(sp.Symbol, sp.Number, sp.NumberSymbol),
)
#: Functions that are continuous wherever they have a value.
_CONTINUOUS = (
    *(sp.Add, sp.Mul, sp.Pow, sp.exp, sp.tanh, sp.log, sp.Ei, sp.LambertW, sp.sin, sp.cos, sp.Abs),
    *(LAW, sp.Symbol),
)
#: What is continuous in time by itself.
_MOVES = WEARING.union(symbols("t tau N"))
_LATE = (Asymptotic, Limit)
"""Claims on what happens in the limit alone."""


def facts_of(premises: Collection[Judgement]) -> frozenset[sp.Basic]:
    """Return the facts in premises: claims, hypotheses, and that all parts of claims are
    defined."""
    return _said(premises) | lasting_facts(premises) | _supposed(premises)


def _said(premises: Collection[Judgement]) -> frozenset[sp.Basic]:
    claims = (p.relation for p in premises if not isinstance(p.claim, Asymptotic))
    return frozenset(claims).union(*map(needs, _parts(premises)))


def _supposed(premises: Iterable[Judgement]) -> frozenset[sp.Basic]:
    return frozenset(h.relation for premise in premises for h in premise.hypotheses)


def lasting_facts(premises: Collection[Judgement]) -> frozenset[sp.Basic]:
    """Return the facts at every time, and which fields are continuous by them."""
    found = _untied(premises) | _said([*filter(lasts, premises)])
    return found.union(map(Continuous, _continuous_fields(found)))


def _untied(premises: Iterable[Judgement]) -> frozenset[sp.Basic]:
    return frozenset(relation for relation in _supposed(premises) if not _tied(relation))


def lasts(judgement: Judgement) -> bool:
    """Return whether a claim holds at every time, not only where rates have a value."""
    return judgement.is_made and _lasts(judgement)


@cache
def _lasts(judgement: Judgement) -> bool:
    """Return whether the claim of a judgement that was not changed holds at every time.

    So does what follows from such claims alone, if no hypothesis ties rates to others; and, since
    other times are limits of these, an equality or bound of continuous expressions that have values
    at every time.
    """
    claim, parents = judgement.relation, judgement.parents
    moving = functions(claim) or clocks(claim)
    if isinstance(judgement.claim, (*_LATE, Property)) or not moving:
        return True
    if _rates(claim):
        return False
    known = [*filter(lasts, parents)]
    if len(known) == len(parents) and not any(map(_tied, _supposed([judgement]))):
        return True
    closed = isinstance(claim, (sp.Equality, sp.GreaterThan, sp.LessThan))
    facts = _untied([judgement]) | _said(known)
    return (
        closed
        and all(_unbroken(side, ()) for side in claim.args)
        and all(holds(goal, facts) for goal in _needed(claim, _parts(known), facts))
    )


def _rates(expr: sp.Basic) -> set[sp.Basic]:
    return {d for d in expr.atoms(sp.Derivative) if functions(d)}


@cache
def _tied(relation: sp.Basic) -> bool:
    """Return whether a relation is of rates and of something else that varies."""
    parts, rates, others = [relation], False, False
    while parts:
        part = parts.pop()
        if isinstance(part, sp.Derivative) and functions(part):
            rates = True
            continue
        others |= isinstance(part, AppliedUndef) and not isinstance(part, LAW)
        others |= part.is_Symbol and part.name in CLOCKS
        parts += part.args
    return rates and others


def _continuous_fields(facts: Set[sp.Basic]) -> set[sp.Basic]:
    """Return the continuous fields: by a fact, or as they equal a continuous expression."""
    found = {fact.args[0] for fact in facts if isinstance(fact, Continuous)}
    found |= {LOAD} if DIFFERENTIABLE.relation in facts else set()
    values = [f for f in facts if isinstance(f, sp.Equality) and isinstance(f.lhs, AppliedUndef)]
    while new := {f.lhs for f in values if _unbroken(f.rhs, found)} - found:
        found |= new
    return found


def _unbroken(expr: sp.Expr, fields: Collection[sp.Basic]) -> bool:
    """Return whether an expression is continuous in time wherever it has a value."""
    if expr in _MOVES or expr in fields or constant(expr):
        return True
    composed = bool(expr.args) and isinstance(expr, _CONTINUOUS)
    return composed and all(_unbroken(part, fields) for part in expr.args)


def _parts(premises: Collection[Judgement], always: bool = False) -> set[sp.Basic]:
    """Return the parts of claims that have a value wherever these hold, not only in the limit;
    ``always``, of claims and hypotheses that hold at every time."""
    wholes = {fact for fact in _untied(premises) if not fact.has(sp.Limit)} if always else set()
    premises = [*filter(lasts, premises)] if always else premises
    wholes |= {premise.relation for premise in premises if not isinstance(premise.claim, _LATE)}
    ends = (premise.claim for premise in premises if isinstance(premise.claim, Limit))
    return {
        *(part for whole in wholes for part in certain(whole)),
        *(end.term for end in ends if end.value.is_finite is not False),
    }


def require(goal: sp.Basic, *premises: Judgement) -> None:
    """Raise RuleError unless a relation follows from premises, and has a value."""
    require_defined(goal, *premises)
    if not holds(goal, facts_of(premises)):
        raise RuleError(f"missing premise: {goal}")


def require_defined(
    expr: sp.Basic, *premises: Judgement, near: Iterable[sp.Basic] = (), always: bool = False
) -> None:
    """Raise RuleError unless every part of an expression has a value under the premises.

    For a neighbourhood of the end of a limit, ``near`` are expressions defined there too;
    ``always``, it has a value at every time.
    """
    for goal in undefined(expr, *premises, near=near, always=always):
        raise RuleError(f"missing premise: {in_words(goal)}")


def require_integrands(expr: sp.Expr, *premises: Judgement) -> None:
    """Raise RuleError unless integrands have values everywhere between the ends, too.

    That an integral has one, as a premise may say, does not tell it: the variables of integration
    are renamed, so that it counts as unknown.
    """
    names = {x: sp.Dummy(**x.assumptions0) for x in bound_in(expr)}
    if t in names:
        raise RuleError(f"missing premise: {expr} has no integral over time")
    require_defined(expr.xreplace(names), *premises)


def in_words(goal: sp.Basic) -> str:
    """Return a missing relation in words."""
    return "every part has a value" if goal == sp.false else str(goal)


def undefined(
    expr: sp.Basic, *premises: Judgement, near: Iterable[sp.Basic] = (), always: bool = False
) -> Iterator[sp.Basic]:
    """Yield the conditions for an expression to be defined that remain unproved.

    Those that follow from premises, or from the existence of ``near``, are omitted; ``always``,
    those that follow at every time.
    """
    ends = {part for whole in near for part in certain(whole)}
    facts = (lasting_facts if always else facts_of)(premises).union(*map(needs, ends))
    needed = _needed(expr, _parts(premises, always) | ends, lasting_facts(premises))
    return (goal for goal in needed if not holds(goal, facts))


def _needed(
    expr: sp.Basic, known: Collection[sp.Basic], facts: frozenset[sp.Basic] = frozenset()
) -> list[sp.Basic]:
    """Return the relations that give every part of an expression a value."""
    if expr in known:
        return []
    inside: tuple[sp.Basic, ...] = () if isinstance(expr, sp.Derivative) else expr.args
    ends: tuple[sp.Expr, ...] = ()
    if isinstance(expr, sp.Integral):
        inside, ends = inside[:1], expr.limits[0][1:]
    hidden = {x: sp.Dummy(**x.assumptions0) for x in bound(expr) - {t}}
    parts = (*(part.xreplace(hidden) for part in inside), *ends)  # unknown to premises
    over_time = isinstance(expr, sp.Integral) and t in bound(expr)  # what holds at all times counts
    goals = [goal for part in parts for goal in _needed(part, () if over_time else known, facts)]
    if over_time:
        goals = [goal.xreplace({t: sp.Dummy()}) for goal in goals if not holds(goal, facts)]
    if isinstance(expr, sp.Integral):
        (s,), (low, high) = hidden.values() or (t,), ends
        beyond = [sp.And(*(positive(side * (s - end)) for end in ends)) for side in (1, -1)]
        beyond += [sp.Not(fact) for fact in _between(s, low, high, facts)]
        goals = [sp.Or(goal, *beyond) if goal.has(s) else goal for goal in goals]
        goals += integrable(parts[0], s)
    return [*goals, *needs(expr)]


def _between(
    s: sp.Symbol, first: sp.Expr, last: sp.Expr, facts: Collection[sp.Basic]
) -> list[sp.Basic]:
    """Return the facts about values between the first and the present one of a continuous field.

    By the intermediate value theorem the field takes all of them, and facts about it hold always.
    """
    start = last.subs(t, 0)
    begun = first == start or sp.Eq(start, first) in facts
    if last.args != (t,) or not begun or not (last in WEARING or Continuous(last) in facts):
        return []
    parts = (part for fact in facts for part in sp.And.make_args(fact))
    about = (f for f in parts if isinstance(f, Relational) and f.atoms(AppliedUndef) == {last})
    of_values = (fact for fact in about if not fact.has(HasValue, sp.Derivative))
    return [*filter(constant, (fact.xreplace({last: s}) for fact in of_values))]


def integrable(body: sp.Basic, s: sp.Basic) -> list[sp.Basic]:
    """Return the relations where pieces of an integrand are continuous."""
    if isinstance(body, AppliedUndef) and not isinstance(body, LAW) and body.has(s):
        now = body.func(t)
        goals = [] if now in WEARING else [Continuous(now)]
        return [*goals, *integrable(body.args[0], s)]
    if body.has(s) and not isinstance(body, (*_CONTINUOUS, *_PIECES)):
        return [HasValue(body)]
    return [goal for part in body.args for goal in integrable(part, s)]


def continuous(
    expr: sp.Expr,
    at: Mapping[sp.Basic, sp.Expr],
    *premises: Judgement,
    but: Collection[sp.Basic] = (),
    always: bool = False,
) -> bool:
    """Return whether an expression is continuous in some unknowns at a point.

    It must consist of continuous functions that are defined at the point and near it.  Facts about
    the quantities ``but`` are not used, nor, ``always``, those that do not hold at every time.
    """
    plain = {unknown: sp.Dummy(real=True) for unknown in at}
    known = {part for part in _parts(premises, always) if not part.has(*but)}
    goals = continuity(expr.xreplace(plain), set(plain.values()), known)
    points = [goal.subs({plain[unknown]: end for unknown, end in at.items()}) for goal in goals]
    facts = (lasting_facts if always else facts_of)(premises)
    facts = frozenset(fact for fact in facts if not fact.has(*but))
    finite = all(end.is_finite is not False for end in at.values())
    return finite and all(not g.has(sp.oo, sp.zoo, sp.nan) and holds(g, facts) for g in points)


def continuity(
    expr: sp.Expr, unknowns: set[sp.Basic], known: Collection[sp.Basic] = ()
) -> list[sp.Basic]:
    """Return conditions, true on open sets, under which an expression is continuous in unknowns."""
    changing = [part for part in sp.preorder_traversal(expr) if part.has(*unknowns)]
    if not all(isinstance(part, _CONTINUOUS) or part in unknowns for part in changing):
        return [sp.false]
    return [_strict(goal) for goal in _needed(expr, known)]


def open_set(relation: sp.Basic) -> bool:
    """Return whether a relation between data holds on an open set."""
    if not isinstance(relation, (sp.StrictGreaterThan, sp.StrictLessThan, sp.Unequality)):
        return False
    goals = (g for side in relation.args for g in continuity(side, side.free_symbols))
    return all(holds(goal, frozenset([relation])) for goal in goals)


def smooth(expr: sp.Expr, *unknowns: sp.Basic) -> bool:
    """Return whether an expression is differentiable (in some unknowns, or all) where it is
    defined, except for roots at 0."""
    parts = sp.preorder_traversal(expr)
    changing = (part for part in parts if not unknowns or part.has(*unknowns))
    return all(isinstance(part, _SMOOTH) for part in changing)


def coefficients(expr: sp.Expr, *parts: sp.Expr) -> tuple[sp.Expr, ...] | None:
    """Return the slopes and the rest of an expression that is affine in some parts; else None.

    >>> x, y = sp.symbols("x y", real=True)
    >>> coefficients(2 * x + y * t, x, y), coefficients(x * y, x, y)
    ((2, t, 0), None)
    >>> coefficients(sp.Piecewise((y, x > 0), (0, True)), x) is None
    True
    """
    own = {part: sp.Dummy(real=True) for part in parts}
    flat = expr.xreplace(own)
    closed = flat.atoms(sp.Derivative, sp.Integral, sp.Limit, sp.Subs, FirstZero, Term)
    names = own.values()
    slopes = [sp.diff(flat, name) for name in names]
    inside = (*slopes, *closed)
    if not smooth(flat, *names) or any(part.has(*names) for part in inside):
        return None
    rest = flat.xreplace(dict.fromkeys(names, sp.S.Zero))
    whole = sp.Add(rest, *map(operator.mul, slopes, names))
    return (*slopes, rest) if is_zero(flat - whole) else None  # it may have no value at 0


def smooth_everywhere(expr: sp.Expr) -> bool:
    """Return whether an expression is differentiable for all values of its unknowns.

    >>> y = sp.Symbol("y", real=True)
    >>> [smooth_everywhere(sp.sqrt(y**4 + rest)) for rest in (1, y**2)]
    [True, False]
    """
    return smooth(expr) and all(map(holds, map(_strict, _needed(expr, ()))))


@cache
def is_contact_law(law: sp.Expr) -> bool:
    """Return whether a contact law ``phi(r)`` is positive, smooth and decreasing."""
    return smooth_everywhere(law) and sign(law) == 1 and sign(sp.diff(law, r)) == -1


def _strict(goal: sp.Basic) -> sp.Basic:
    return positive(goal.lhs - goal.rhs) if isinstance(goal, sp.GreaterThan) else goal
