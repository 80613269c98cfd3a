"""Draws: models of some relations, built at random from test functions, deterministically.

Overview
    Each equation is solved for one of its unknowns, linear in it: a datum, a field, a rate, an
    initial value.  What no equation determines is drawn: data from a short list of degenerate,
    ordinary and extreme values, fields from families of test functions (constants, ramps, roots,
    exponentials, logarithms, sines, squares).  An inequality is met on purpose by a difference
    that is drawn, zero included, a limit by a rest that vanishes or grows.  The same seed draws
    the same value for the same quantity in every judgement.
Key results
    drawn(relations, wanted, seed, free)    a model, or None where the draw does not fit
"""

from __future__ import annotations

import random
from collections.abc import Iterator
from dataclasses import dataclass, field
from functools import cache, lru_cache

import sympy as sp
from sympy.core.function import AppliedUndef
from sympy.core.relational import Relational

from ..laws import GENERAL
from ..symbols import DATA, symbol, t
from .models import Model, of, quantities, reached
from .truth import truth
from .values import field_of

T, U, V = symbol("T"), symbol("U"), symbol("V")
_ORDINARY = ("1", "1", "1", "1/2", "2", "3/4", "3/2", "3", "2/3")
_EXTREME = ("1/4", "1/1000", "1000", "1/8", "20", "1000000", "1/1000000")
WILD = 5
"""Every so many seeds draw extreme values too."""
_CLOSED = (sp.Limit, sp.Integral, sp.Subs)


_PHI, _RATIO = GENERAL.phi.func, sp.Dummy("r", real=True)
LAWS = (
    sp.exp(-_RATIO),
    1 / (1 + sp.exp(4 * _RATIO - 8)),
    (1 - (_RATIO - 1) / sp.sqrt(1 + (_RATIO - 1) ** 2)) / 2,
)
"""Positive, smooth, decreasing laws of contact."""


@cache
def with_law(relation: sp.Basic, number: int) -> sp.Basic:
    """Return a relation about any law of contact, for one of those that are tried."""
    if not relation.has(_PHI):
        return relation
    law = sp.Lambda(_RATIO, LAWS[number])
    written = relation.replace(_PHI, law)
    return written.replace(lambda e: isinstance(e, sp.Subs), lambda slope: slope.doit())


@dataclass
class _Draft:
    """What is determined so far; ``loop``: the field that rests on itself.

    ``moving`` are data over which a limit or a derivative is taken: no other datum follows them.
    """

    moving: frozenset[sp.Basic]
    values: dict[sp.Expr, sp.Expr] = field(default_factory=dict)
    loop: sp.Expr | None = None

    def takes(self, quantity: sp.Expr, value: sp.Expr, looped: bool) -> bool:
        """Take ``quantity = value``, unless something else determines it already."""
        rate = isinstance(quantity, sp.Derivative)
        field_or_rate = of(quantity.expr if rate else quantity)[:2]
        if any(known in self.values for known in (quantity, *field_or_rate)):
            return False
        rests_on = reached((value,), self.values, states=False)
        if _name(quantity) in DATA and rests_on & self.moving:
            return False
        if not rate and quantity in rests_on:
            if not looped or not quantity.args or self.loop:
                return False
            self.loop = field_of(quantity)
        self.values[quantity] = value
        return True


def drawn(
    relations: tuple[sp.Basic, ...],
    wanted: tuple[sp.Basic, ...],
    seed: int,
    free: frozenset[sp.Expr] = frozenset(),
) -> Model | None:
    """Return a model that is made to satisfy ``relations`` and gives all of ``wanted`` a value.

    The domains of the quantities in ``free`` are left on purpose.  Whatever is wanted, the same
    relations have the same model, but for derivatives and limits over data, and now and then a
    model on the edge of what is wanted.
    """
    chance = random.Random(f"{seed} edge")
    edges = [edge for relation in wanted for edge in relation.atoms(Relational)]
    if edges and chance.random() < 0.15:
        edge = chance.choice(sorted(edges, key=str))
        relations = (*relations, sp.Eq(*edge.args, evaluate=False))
    over = frozenset().union(*map(slopes_over_data, (*relations, *wanted)))
    ends = frozenset().union(*map(_limits_over_data, (*relations, *wanted)))
    moving = ends.union(*(slope.variables for slope in over))
    model = _made(relations, seed, free, frozenset(d.expr for d in over), moving)
    if model is not None:
        for quantity in quantities(sp.Tuple(*wanted)):
            if not any(known in model.values for known in of(quantity)[:2]):
                model.values[quantity] = _draw(quantity, seed, quantity in free)
    return model


@cache
def slopes_over_data(relation: sp.Basic) -> frozenset[sp.Expr]:
    """Return the derivatives with respect to data in a relation."""
    return frozenset(d for d in relation.atoms(sp.Derivative) if t not in d.variables)


@cache
def _limits_over_data(relation: sp.Basic) -> frozenset[sp.Expr]:
    """Return the data over which a relation takes limits."""
    return frozenset(limit.args[1] for limit in relation.atoms(sp.Limit)) - {t}


@lru_cache(maxsize=300)
def _made(
    relations: tuple[sp.Basic, ...],
    seed: int,
    free: frozenset[sp.Expr],
    slopes: frozenset[sp.Expr],
    moving: frozenset[sp.Basic],
) -> Model | None:
    """Return a model of relations; what is differentiated over data (``slopes``) follows from
    the data that are ``moving``."""
    chance, draft = random.Random(seed), _Draft(moving)
    parts = [p for relation in relations for p in _parts(relation, chance)]
    still = {f: sp.Symbol(f"{_name(f)}(0)", real=True) for f in map(_constant, parts) if f}
    draft.values.update(still)
    parts = [p if p.has(sp.Derivative) else p.xreplace(still) for p in parts]
    for equations in (True, False):  # an inequality is met by what no equation determines
        these = (part for part in parts if isinstance(part, sp.Eq) == equations)
        imposed = (_imposed(part, chance, seed % WILD == WILD - 1) for part in these)
        _assign([part for part in imposed if part is not None], draft, chance, slopes)
    values = draft.values
    unknown = quantities(sp.Tuple(*relations, *slopes, T, U, *values.values())) - values.keys()
    for quantity in sorted(unknown, key=lambda q: (bool(q.args), str(q))):
        _, *rate = of(quantity)[:2]
        if rate and rate[0] in values:
            least = sp.S.One if quantity.is_positive else sp.S.Zero
            first = _value(quantity, seed, quantity in free)
            values.setdefault(quantity.subs(t, 0), first if chance.random() < 0.5 else least)
        else:
            values[quantity] = _fitting(quantity, seed, quantity in free, parts, values)
    return _model(draft)


def _name(quantity: sp.Expr) -> str:
    return str(quantity.func if quantity.args else quantity)


def _constant(part: sp.Basic) -> sp.Expr | None:
    """Return the field of which a relation says that it does not vary."""
    if isinstance(part, sp.Eq):
        left, right = part.args
        if isinstance(left, sp.Derivative) and right == 0 and left.expr.args == (t,):
            return left.expr
        if isinstance(left, AppliedUndef) and left.args == (t,) and right == left.subs(t, 0):
            return left
    return None


def _fitting(
    quantity: sp.Expr,
    seed: int,
    outside: bool,
    said: list[sp.Basic],
    values: dict[sp.Expr, sp.Expr],
) -> sp.Expr:
    """Draw a number or a test function of which holds what is said of it, as far as others are
    known; the last one tried if none is found."""
    others = {known: value for known, value in values.items() if known in quantities(known)}
    about = [
        relation
        for relation in said
        if quantity in quantities(relation)
        and not any(q.args for q in quantities(relation) - {quantity})
    ]
    for attempt in range(12 if about else 1):
        made = _draw(quantity, seed + 97 * attempt, outside)
        if quantity.subs(t, 0) in values:
            made = made - made.subs(t, 0) + values[quantity.subs(t, 0)]
        alone = Model({**others, quantity: made})
        if all(truth(relation, alone).holds is not False for relation in about):
            break
    return made


def _model(draft: _Draft) -> Model | None:
    states = {key.expr for key in draft.values if isinstance(key, sp.Derivative)}
    starts = {key for key in draft.values if key.args == (0,) and key.func(t) not in states}
    values = {key: value for key, value in draft.values.items() if key not in starts}
    model = Model(values, draft.loop)
    try:
        if model.states:
            _ = model.motion  # there is one
    except (ArithmeticError, RecursionError, ValueError):
        return None
    return model


def _parts(relation: sp.Basic, chance: random.Random) -> Iterator[sp.Basic]:
    """Split a conjunction; of a disjunction take one part."""
    if isinstance(relation, sp.And):
        for part in relation.args:
            yield from _parts(part, chance)
    elif isinstance(relation, sp.Or):
        yield from _parts(chance.choice(sorted(relation.args, key=str)), chance)
    else:
        yield relation


def _imposed(part: sp.Basic, chance: random.Random, wild: bool) -> sp.Basic | None:
    """Return the equation by which a relation is met on purpose; None to leave it to chance."""
    if isinstance(part, (sp.Gt, sp.Ge, sp.Lt, sp.Le)):
        high, low = part.gts, part.lts
        if chance.random() > 0.7 or low.is_infinite or high.is_infinite:
            return None
        if isinstance(low, sp.Limit) or isinstance(high, sp.Limit):
            part = sp.Eq(
                *((low, high - 1) if isinstance(low, sp.Limit) else (high, low + 1)), evaluate=False
            )
            return _imposed(part, chance, wild)
        gaps = (sp.S.One, sp.S.Zero, sp.S.Half, sp.Integer(2), t, sp.exp(-t), sp.Integer(1000))
        gap = chance.choice(gaps if wild else gaps[:-1])
        if gap == 0 and isinstance(part, (sp.Gt, sp.Lt)):
            gap = sp.S.One
        part = sp.Eq(high, low + gap, evaluate=False)
    if not isinstance(part, sp.Eq):
        return None
    left, right = sorted(part.args, key=lambda side: not isinstance(side, sp.Limit))
    if not isinstance(left, sp.Limit) or left.args[1] != t or isinstance(part.lhs, sp.Symbol):
        return part
    return _approaching(left.args[0], left.args[2], right, chance)


def _approaching(
    inside: sp.Expr, point: sp.Expr, value: sp.Expr, chance: random.Random
) -> sp.Basic:
    """Return an equation by which an expression has a limit."""
    if value.is_infinite:
        wave = sp.sin(2 * sp.pi * t)
        grown = chance.choice((t, 1 + t, sp.log(1 + t), sp.sqrt(1 + t), sp.exp(t), t + wave))
        return sp.Eq(inside, grown * sp.sign(value), evaluate=False)
    if point == 0:
        rest = chance.choice((sp.S.Zero, t, sp.tanh(t), -t))
        return sp.Eq(inside, value + rest, evaluate=False)
    fields = {f: sp.Dummy() for f in inside.atoms(AppliedUndef, sp.Derivative)}
    timed = inside.xreplace(fields)
    if timed.has(t) and chance.random() < 0.7:  # a little later, so that t = 0 is regular
        later = timed.subs(t, t + 1).xreplace({d: f for f, d in fields.items()})
        return sp.Eq(later, value, evaluate=False)
    rest = chance.choice((sp.S.Zero, 1 / (1 + t), sp.exp(-t), -1 / (1 + t) ** 2))
    return sp.Eq(inside, value + rest, evaluate=False)


def _assign(
    equations: list[sp.Eq], draft: _Draft, chance: random.Random, slopes: frozenset[sp.Expr]
) -> None:
    """Let each equation determine one unknown; those that nothing can be solved for are left.

    What is differentiated with respect to data (``slopes``) must follow from the data.
    """
    rest = []
    bent = chance.choice(equations) if equations and chance.random() < 0.6 else None
    for equation in equations:
        offers = list(solutions(equation))
        if slopes:
            offers = [offer for offer in offers if offer[0] in slopes] or offers[:1]
        if not offers:
            continue
        if equation is bent:
            factors = [s for s in _coefficients(equation) if s not in draft.values]
            if factors and chance.random() < 0.5:
                draft.values[chance.choice(factors)] = sp.S.Zero
                continue
            chance.shuffle(offers)
        if not draft.takes(*offers[0], looped=False):
            rest.append(offers)
    for offers in rest:
        if not draft.takes(*offers[0], looped=True):
            any(draft.takes(*offer, looped=False) for offer in offers[1:])


@cache
def solutions(equation: sp.Eq) -> tuple[tuple[sp.Expr, sp.Expr], ...]:
    """Return what an equation can be solved for, each with its value; the left side first."""
    plain = equation.replace(lambda e: isinstance(e, _CLOSED), lambda _: sp.Dummy())
    rates = sorted(plain.atoms(sp.Derivative), key=str)
    if any(set(d.variables) != {t} for d in rates):
        return ()
    moving = {d.expr for d in rates}
    fields = sorted(plain.atoms(AppliedUndef), key=str)
    found = [d for d in rates if d.variables == (t,) and d.expr.args == (t,)]
    found += [f for f in fields if f.args[0] == 0 or (f.args[0] == t and f not in moving)]
    if not plain.has(t, AppliedUndef):
        found += sorted(plain.free_symbols - plain.atoms(sp.Dummy), key=str)
    solved = [(q, value) for q in found if (value := _solved(equation, q)) is not None]
    return tuple(sorted(solved, key=lambda offer: offer[0] != equation.lhs))


@cache
def _coefficients(equation: sp.Eq) -> tuple[sp.Symbol, ...]:
    """Return the data that may vanish and multiply a whole side of an equation."""
    factors = {f for side in equation.args for f in sp.Mul.make_args(sp.factor_terms(side))}
    return tuple(s for s in sorted(factors, key=str) if isinstance(s, sp.Symbol)
                 and not s.is_positive and s != t)  # fmt: skip


def _solved(equation: sp.Eq, quantity: sp.Expr) -> sp.Expr | None:
    """Return what a quantity equals, where the equation is linear in it; None where the value
    still rests on it, at this time or another."""
    left, right = equation.args
    if quantity in (left, right) and not (other := right if left == quantity else left).has(
        quantity
    ):
        value = other
    else:
        dummy = sp.Dummy()
        residual = (left - right).xreplace({quantity: dummy})
        if not _polynomial(residual, dummy):
            return None
        slope = sp.diff(residual, dummy)
        if slope == 0 or slope.has(dummy):
            return None
        value = -residual.xreplace({dummy: sp.S.Zero}) / slope
    known = quantity.expr if isinstance(quantity, sp.Derivative) else None
    field = (known or quantity).func
    if quantity.args and any(f.func == field and f != known for f in value.atoms(AppliedUndef)):
        return None
    return value


def _polynomial(expr: sp.Expr, unknown: sp.Symbol) -> bool:
    """Return whether an unknown stands in sums and products alone."""
    if not expr.has(unknown) or expr == unknown:
        return True
    return isinstance(expr, (sp.Add, sp.Mul)) and all(_polynomial(a, unknown) for a in expr.args)


def slides_fast(seed: int) -> bool:
    """Return whether a model slides fast: what wear tends to is seen within a few periods of its
    load, but of counterexamples those that slide slowly show more."""
    return seed % WILD == 3


def _draw(quantity: sp.Expr, seed: int, outside: bool) -> sp.Expr:
    """Draw a number or a test function of time, outside of its domain if asked."""
    return (test_function if quantity.args else _value)(quantity, seed, outside)


def _value(quantity: sp.Expr, seed: int, outside: bool) -> sp.Expr:
    """Draw a number for a quantity, outside of its domain if asked."""
    chance = random.Random(f"{seed} {_name(quantity)}")
    wild = seed % WILD == WILD - 1 and chance.random() < 0.4
    size = sp.Rational(chance.choice(_EXTREME if wild else _ORDINARY))
    if quantity == V and slides_fast(seed):
        size = sp.Integer(1000)
    if quantity.is_positive:
        return (-size if chance.random() < 0.7 else sp.S.Zero) if outside else size
    if quantity.is_nonnegative:
        return -size if outside else (sp.S.Zero if chance.random() < 0.25 else size)
    if chance.random() < 0.15:
        return sp.S.Zero
    return -size if chance.random() < 0.3 else size


def test_function(varying: sp.Expr, seed: int, outside: bool) -> sp.Expr:
    """Return a test function of time."""
    chance = random.Random(f"{seed} {_name(varying)}")
    s = t / T
    size = sp.Rational(chance.choice(("1", "1", "1", "2", "1/2", "-1", "1/4")))
    wave = sp.sin(2 * sp.pi * s)
    both = wave / 2 + sp.cos(4 * sp.pi * s) / 3
    shapes: list[sp.Expr] = [
        sp.S.One, s, wave, sp.exp(-s), 1 - sp.exp(-s), sp.log(1 + s), sp.sqrt(s), s + wave / 8,
        sp.exp(s), sp.tanh(s), 1 / (1 + s), s / (1 + s), sp.sin(sp.log(1 + s)), s**2, sp.S.Zero,
        both, 1 + s, 2 + wave, s - sp.log(1 + s), sp.cos(2 * sp.pi * s),
    ]  # fmt: skip
    shape = chance.choice(shapes)
    if varying == symbol("U_a"):  # one kind of load after the other
        loads = (sp.S.One, sp.sin(sp.log(1 + s)), s, wave, 1 - sp.exp(-s), sp.sqrt(s),
                 sp.S.Zero, sp.log(1 + s), (-1) ** sp.floor(2 * s), sp.exp(-s), both, -s,
                 s * wave)  # fmt: skip
        shape = loads[seed % len(loads)]
        size = U * sp.Rational(chance.choice(("1", "1", "1/2", "1", "-1", "2")))
    if varying.is_positive or varying.is_nonnegative:
        size = abs(size)
        shape = chance.choice((1, 1 + s, 2 + wave, sp.exp(-s), 1 / (1 + s), sp.exp(s)))
        return -size * shape if outside else size * shape
    return size * shape
