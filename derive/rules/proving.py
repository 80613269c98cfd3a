"""Side conditions: relations between reals, decided by proof from facts.

Overview
    ``holds`` asks z3 whether the facts and the negated goal contradict each other in the reals.
    What is no polynomial is opaque: a square root is known by its square, an exponential, a
    hyperbolic tangent, the contact law and its slope by their range, a constant by a ball.  A
    quotient whose denominator vanishes is any number, so that no answer rests on it.
    ``require_defined`` asks that denominators, roots, logarithms have a value.
Key results
    holds(goal, facts)       whether the relation follows; False proves nothing
    sign(expr, facts)        1, -1 or None
    require                  RuleError unless a relation follows from premises
    require_defined          RuleError unless every part of an expression has a value
    needs                    the relations where an expression has a value
    continuous               whether an expression is continuous at a point
References
    de Moura, Bjorner, Z3: an efficient SMT solver, TACAS 2008; Jovanovic, de Moura, Solving
    nonlinear arithmetic, IJCAR 2012.
"""

from __future__ import annotations

from collections.abc import Collection, Iterable, Iterator, Mapping
from functools import cache

import flint
import sympy as sp
import z3
from sympy.core.function import AppliedUndef
from sympy.core.relational import Relational

from ..claims import Asymptotic, FirstZero, Limit, Property, Term, landau_o
from ..hypotheses import Hypothesis, Kind
from ..kernel import Judgement, RuleError
from ..language import bound, certain
from ..laws import GENERAL, r
from ..symbols import rate, symbol, symbols, t

LAW = GENERAL.phi.func
"""The unspecified contact law: positive, continuously differentiable, of negative slope."""

WEARING = symbols("u_a u_c sigma_a sigma_c")
"""Fields that have rates, by Archard's law; others where a premise says so."""
_RATE_OF_LOAD = rate("U_a")
_PRESSURE = symbol("p_s")
"""The pressure over which is integrated: what is said of it holds over the whole integral."""
DIFFERENTIABLE = Hypothesis(
    "differentiable load",
    sp.Eq(_RATE_OF_LOAD, _RATE_OF_LOAD, evaluate=False),
    r"\text{differentiable load}",
    Kind.LOAD,
)
"""It says that the rate has a value."""

EFFORT = 3_000_000
"""Steps of z3 after which a side condition counts as not proved; no matter of time."""

_BALL = {sp.exp: flint.arb.exp, sp.log: flint.arb.log, sp.tanh: flint.arb.tanh}
#: Functions that are continuous wherever they have a value.
_CONTINUOUS = (sp.Add, sp.Mul, sp.Pow, sp.exp, sp.tanh, sp.log, sp.Abs, LAW, sp.Symbol)
#: Functions that are differentiable wherever they have a value; roots but at 0.
_SMOOTH = (
    *(sp.Add, sp.Mul, sp.Pow, sp.exp, sp.tanh, sp.log, sp.Ei, sp.LambertW, AppliedUndef),
    *(sp.Symbol, sp.Number, sp.NumberSymbol),
)
#: Functions that have a value at every real argument.
_TOTAL = (sp.exp, sp.tanh, sp.sin, sp.cos, sp.Abs, sp.Max, sp.Min, sp.besseli, sp.sign)
_RELATIONS = {
    sp.Equality: lambda a, b: a == b,
    sp.Unequality: lambda a, b: a != b,
    sp.StrictGreaterThan: lambda a, b: a > b,
    sp.GreaterThan: lambda a, b: a >= b,
    sp.StrictLessThan: lambda a, b: a < b,
    sp.LessThan: lambda a, b: a <= b,
}


def facts_of(premises: Iterable[Judgement]) -> frozenset[sp.Basic]:
    """Return what premises give: their claims, all of their hypotheses, and that every part of a
    claim has a value."""
    found: set[sp.Basic] = set()
    for premise in premises:
        if not isinstance(premise.claim, (Asymptotic, Property)):
            found.add(premise.relation)
        found |= {need for part in _parts((premise,)) for need in _need(part)} - {sp.false}
        found |= {h.relation for h in premise.hypotheses if h.relation is not sp.true}
    return frozenset(found)


def _parts(premises: Iterable[Judgement]) -> set[sp.Basic]:
    """Return the parts of claims that have a value, at every time and not just in the end."""
    late = (Asymptotic, Limit, Property)
    wholes = (premise.relation for premise in premises if not isinstance(premise.claim, late))
    ends = (premise.claim for premise in premises if isinstance(premise.claim, Limit))
    return {
        *(part for whole in wholes for part in certain(whole)),
        *(end.term for end in ends if end.value.is_finite is not False),
    }


@cache
def holds(goal: sp.Basic, facts: frozenset[sp.Basic] = frozenset()) -> bool:
    """Return True where the goal follows from facts; False proves nothing.

    >>> x, y = sp.symbols("x y", real=True)
    >>> holds(x + y > 0, frozenset([x > 1, sp.Abs(y) <= 1])), holds(x + y > 0)
    (True, False)
    """
    if goal in (sp.true, sp.false):
        return bool(goal)
    if goal in facts:
        return True
    if goal.has(sp.tanh) and goal.has(sp.exp):
        goal = goal.replace(sp.tanh, lambda x: 1 - 2 / (1 + sp.exp(2 * x)))
    for known in (_relevant(goal, facts), facts):
        translator, solver = _Translator(), z3.Solver()
        solver.set("rlimit", EFFORT)
        wanted = translator.relation(goal)
        given = [r for r in map(translator.relation, sorted(known, key=str)) if r is not None]
        if wanted is None:
            return False
        solver.add(*given, *translator.known, z3.Not(wanted))
        if solver.check() == z3.unsat:
            return True
    return False


def _relevant(goal: sp.Basic, facts: frozenset[sp.Basic]) -> frozenset[sp.Basic]:
    """Return the facts about nothing but what the goal is about: most goals need no others."""
    atoms = _unknowns(goal)
    return frozenset(fact for fact in facts if _unknowns(fact) <= atoms)


@cache
def _unknowns(expr: sp.Basic) -> frozenset[sp.Basic]:
    return frozenset(expr.atoms(sp.Symbol, AppliedUndef))


class _Translator:
    """Relations as z3 takes them; ``known`` collects what is known of opaque parts."""

    def __init__(self) -> None:
        self.names: dict[sp.Basic, z3.ArithRef] = {}
        self.known: list[z3.BoolRef] = []

    def relation(self, relation: sp.Basic) -> z3.BoolRef | None:
        """Return a relation, None for one of a kind that is not of the reals."""
        if isinstance(relation, (sp.And, sp.Or, sp.Not, sp.Equivalent)):
            parts = [self.relation(part) for part in relation.args]
            if None in parts:
                return None
            if isinstance(relation, sp.Equivalent):
                return parts[0] == parts[1]
            return {sp.And: z3.And, sp.Or: z3.Or, sp.Not: z3.Not}[type(relation)](*parts)
        if not isinstance(relation, Relational) or relation.has(sp.oo, sp.zoo, sp.nan, sp.I):
            return None
        return _RELATIONS[type(relation)](*map(self.number, relation.args))

    def number(self, expr: sp.Expr) -> z3.ArithRef:
        """Return an expression, opaque where it is no polynomial, quotient or root."""
        if isinstance(expr, sp.Rational):
            return z3.Q(int(expr.p), int(expr.q))
        if isinstance(expr, sp.Add):
            return z3.Sum(*map(self.number, expr.args))
        if isinstance(expr, sp.Mul):
            return z3.Product(*map(self.number, expr.args))
        if isinstance(expr, sp.Pow) and expr.exp.is_Integer:
            base = self.number(expr.base)
            power = z3.Product(*[base] * abs(int(expr.exp)))
            return power if expr.exp > 0 else 1 / power
        if isinstance(expr, sp.Pow) and expr.exp.is_Rational and expr.exp.q == 2:
            return self.number(sp.Pow(_Root(expr.base), expr.exp.p))
        if isinstance(expr, sp.exp):
            expr = sp.exp(sp.expand(expr.args[0]))
        if isinstance(expr, sp.Abs):
            inside = self.number(expr.args[0])
            return z3.If(inside >= 0, inside, -inside)
        if expr not in self.names:
            self.names[expr] = z3.Real(f"x{len(self.names)}")
            self._opaque(expr, self.names[expr])
        return self.names[expr]

    def _opaque(self, expr: sp.Expr, name: z3.ArithRef) -> None:
        """State what is known of an opaque part."""
        if isinstance(expr, _Root):
            inside = self.number(expr.args[0])
            self.known.append(z3.Implies(inside >= 0, z3.And(name >= 0, name * name == inside)))
        elif isinstance(expr, sp.tanh):
            signs = {"is_positive": name > 0, "is_negative": name < 0}
            self.known += [name > -1, name < 1]
            self.known += [known for given, known in signs.items() if getattr(expr.args[0], given)]
        elif isinstance(expr, (sp.sin, sp.cos)):
            self.known += [name >= -1, name <= 1]
        elif isinstance(expr, (sp.exp, LAW)):
            self.known.append(name > 0)
        elif is_slope_of_law(expr):
            self.known.append(name < 0)
        elif isinstance(expr, (sp.Max, sp.Min)):
            inside = [self.number(part) for part in expr.args]
            above = [name >= i if isinstance(expr, sp.Max) else name <= i for i in inside]
            self.known += [*above, z3.Or(*(name == i for i in inside))]
        if isinstance(expr, (sp.Symbol, AppliedUndef)):
            signs = {"is_positive": name > 0, "is_negative": name < 0, "is_nonnegative": name >= 0}
            self.known += [known for given, known in signs.items() if getattr(expr, given)]
        if expr is sp.pi or (type(expr) in _BALL and expr.args[0].is_Rational):
            self.known += [name > _rational(expr, -1), name < _rational(expr, 1)]


class _Root(sp.Expr):
    """The square root of its argument, kept apart."""


def _rational(expr: sp.Expr, side: int) -> z3.ArithRef:
    """Return a rational number below (-1) or above (1) a constant, from a ball that holds it."""
    if expr is sp.pi:
        ball = flint.arb.pi()
    else:
        ball = _BALL[type(expr)](flint.arb(flint.fmpq(expr.args[0].p, expr.args[0].q)))
    man, exp = (ball.lower() if side < 0 else ball.upper()).man_exp()
    value = sp.Integer(int(man)) * sp.Integer(2) ** int(exp)
    return z3.Q(int(value.p), int(value.q))


def is_slope_of_law(expr: sp.Basic) -> bool:
    """Return whether an expression is the first derivative of the unspecified contact law."""
    if isinstance(expr, sp.Subs):
        return len(expr.variables) == 1 and is_slope_of_law(expr.expr)
    return isinstance(expr, sp.Derivative) and (
        expr.derivative_count == 1 and expr.expr == LAW(expr.variables[0])
    )


def sign(expr: sp.Expr, facts: frozenset[sp.Basic] = frozenset()) -> int | None:
    """Return 1 or -1 for an expression that is proved to be positive or negative, else None.

    >>> y = sp.Symbol("y", real=True)
    >>> sign(1 + sp.tanh(y)), sign(sp.tanh(y) - 1), sign(y), sign(1 - y / sp.sqrt(1 + y**2))
    (1, -1, None, 1)
    """
    for found, goal in ((1, sp.Gt(expr, 0)), (-1, sp.Lt(expr, 0))):
        if holds(goal, facts):
            return found
    return None


def require(goal: sp.Basic, *premises: Judgement) -> None:
    """Raise RuleError unless a relation follows from premises, and has a value."""
    require_defined(goal, *premises)
    if not holds(goal, facts_of(premises)):
        raise RuleError(f"missing premise: {goal}")


def require_defined(expr: sp.Basic, *premises: Judgement, near: Iterable[sp.Basic] = ()) -> None:
    """Raise RuleError unless every part of an expression has a value under the premises.

    Where it is asked near the end of a limit, ``near`` has a value there, too.
    """
    for goal in undefined(expr, *premises, near=near):
        raise RuleError(f"missing premise: {goal}")


def undefined(
    expr: sp.Basic, *premises: Judgement, near: Iterable[sp.Basic] = ()
) -> Iterator[sp.Basic]:
    """Yield the relations that would give every part of an expression a value, and do not follow
    from premises, or from what gives ``near`` a value."""
    ends = {part for whole in near for part in certain(whole)}
    facts = facts_of(premises).union(*map(_need, ends))
    needed = _needed(expr, _parts(premises) | ends)
    return (goal for goal in needed if not holds(goal, facts))


def needs(expr: sp.Basic) -> set[sp.Basic]:
    """Return the relations where an expression has a value, but for limits and integrals in it.

    >>> f_c = sp.Symbol("f_c", real=True)
    >>> needs(1 + sp.sqrt(f_c)), needs(sp.tanh(f_c))
    ({f_c >= 0}, set())
    """
    return {need for part in certain(expr) for need in _need(part) if not need.has(sp.zoo)}


def _needed(expr: sp.Basic, known: Collection[sp.Basic]) -> list[sp.Basic]:
    """Return the relations that give every part of an expression a value."""
    if expr in known:
        return []
    parts = () if isinstance(expr, sp.Derivative) else expr.args
    hidden = {x: sp.Dummy(**x.assumptions0) for x in bound(expr) - {t, _PRESSURE}}
    parts = tuple(part.xreplace(hidden) for part in parts)  # of these no premise speaks
    goals = [goal for part in parts for goal in _needed(part, known)]
    if isinstance(expr, sp.Integral) and [len(limit) for limit in expr.limits] == [3]:
        s, *ends = expr.xreplace(hidden).limits[0]
        outside = (sp.And(*(relation(s, end) for end in ends)) for relation in (sp.Lt, sp.Gt))
        beyond = tuple(outside)
        goals = [sp.Or(goal, *beyond) if goal.has(s) else goal for goal in goals]
    return [*goals, *_need(expr)]


def _need(expr: sp.Basic) -> list[sp.Basic]:
    """Return the relation that gives an expression a value where its arguments have one."""
    if expr in (sp.zoo, sp.nan):
        return [sp.false]
    unknown = sp.Ne(expr, sp.zoo, evaluate=False)
    if isinstance(expr, (sp.Limit, FirstZero, Term, landau_o)):
        return [unknown]
    if isinstance(expr, sp.Piecewise) and expr.args[-1].cond is not sp.true:
        return [expr.args[0].cond if len(expr.args) == 1 else unknown]
    if isinstance(expr, sp.Derivative):
        rated = expr.expr in WEARING and expr.variables == (t,)
        return [] if rated or is_slope_of_law(expr) else [unknown]
    if isinstance(expr, sp.Pow):
        base, exponent = expr.args
        if exponent.is_Integer:
            return [sp.Ne(base, 0)] if exponent.is_negative else []
        relation = sp.Ge if exponent.is_positive else sp.Gt
        return [relation(base, 0, evaluate=False)]
    if isinstance(expr, sp.log):
        return [sp.Gt(expr.args[0], 0)]
    if isinstance(expr, sp.besseli):
        return [] if expr.order.is_Integer else [unknown]
    if isinstance(expr, sp.LambertW):
        return [sp.Ge(expr.args[0], 0) if len(expr.args) == 1 else unknown]
    if isinstance(expr, sp.Ei):
        return [sp.Ne(expr.args[0], 0)]
    partial = isinstance(expr, sp.Function) and not isinstance(expr, (*_TOTAL, sp.Piecewise))
    return [unknown] if partial and not isinstance(expr, AppliedUndef) else []


def continuous(
    expr: sp.Expr,
    at: Mapping[sp.Basic, sp.Expr],
    *premises: Judgement,
    but: Collection[sp.Basic] = (),
) -> bool:
    """Return whether an expression is continuous in some unknowns at a point.

    It must be made of continuous functions, which have a value at the point and near it; what
    premises say of the quantities ``but`` is no fact there.
    """
    plain = {unknown: sp.Dummy(real=True) for unknown in at}
    known = {part for part in _parts(premises) if not part.has(*but)}
    goals = continuity(expr.xreplace(plain), set(plain.values()), known)
    points = [goal.subs({plain[unknown]: end for unknown, end in at.items()}) for goal in goals]
    facts = frozenset(fact for fact in facts_of(premises) if not fact.has(*but))
    return all(not goal.has(sp.oo, sp.zoo, sp.nan) and holds(goal, facts) for goal in points)


def stays(
    goal: sp.Basic, side: sp.Expr, at: Mapping[sp.Basic, sp.Expr], *premises: Judgement
) -> bool:
    """Return whether what gives an expression a value holds near a point, where its left side is
    another expression, and its right side 0."""
    kept = 1 / side if isinstance(goal, sp.Ne) else sp.log(side)
    return goal.args[1] == 0 and continuous(kept, at, *premises)


def continuity(
    expr: sp.Expr, unknowns: set[sp.Basic], known: Collection[sp.Basic] = ()
) -> list[sp.Basic]:
    """Return the relations, true on open sets, where an expression is continuous in unknowns."""
    changing = [part for part in sp.preorder_traversal(expr) if part.has(*unknowns)]
    if not all(isinstance(part, _CONTINUOUS) or part in unknowns for part in changing):
        return [sp.false]
    return [_strict(goal) for goal in _needed(expr, known)]


def smooth(expr: sp.Expr, *unknowns: sp.Basic) -> bool:
    """Return whether an expression is differentiable (in some unknowns, or all) where it has a
    value, roots but at 0."""
    parts = sp.preorder_traversal(expr)
    changing = (part for part in parts if not unknowns or part.has(*unknowns))
    return all(isinstance(part, _SMOOTH) for part in changing)


def smooth_everywhere(expr: sp.Expr) -> bool:
    """Return whether an expression is differentiable whatever the values of its unknowns.

    >>> y = sp.Symbol("y", real=True)
    >>> [smooth_everywhere(sp.sqrt(y**4 + rest)) for rest in (1, y**2)]
    [True, False]
    """
    return smooth(expr) and all(map(holds, map(_strict, _needed(expr, ()))))


@cache
def falls(law: sp.Expr) -> bool:
    """Return whether a contact law ``phi(r)`` is positive and smooth and decreases."""
    return smooth_everywhere(law) and sign(law) == 1 and sign(sp.diff(law, r)) == -1


def _strict(goal: sp.Basic) -> sp.Basic:
    return sp.Gt(*goal.args) if isinstance(goal, sp.GreaterThan) else goal
