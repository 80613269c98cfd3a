"""Draws: random models of relations, built from random functions; the seed determines them.

Overview
    Each equation is solved for one of its unknowns, in which it must be linear: a datum, a field,
    a rate or an initial value.  Undetermined quantities are drawn: data from a short list of
    degenerate, ordinary and extreme values, fields from families of functions (constants,
    ramps, roots, exponentials, logarithms, sines, squares).  An inequality is imposed by a random
    difference of its sides, zero included, a limit by a remainder that vanishes or grows.  The
    same seed gives the same quantity the same value in every judgement.
Key results
    draw_model(relations, wanted, seed)    a model, or None if the draw fails
"""

from __future__ import annotations

import random
from dataclasses import dataclass, field
from functools import lru_cache

import sympy as sp
from sympy.core.function import AppliedUndef
from sympy.core.relational import Relational
from sympy.solvers.solveset import NonlinearError, linear_coeffs

from ..claims import FirstZero, mapped
from ..laws import GENERAL, written_out
from ..memory import cache
from ..symbols import DATA, symbol, t
from .balls import UndecidedError
from .expansion import ExpansionTerm
from .models import Model, dependencies, forms_of, quantities
from .values import field_of, truth

T, U, V = symbol("T"), symbol("U"), symbol("V")
_ORDINARY = ("1", "1", "1", "1/2", "2", "3/4", "3/2", "3", "2/3")
_EXTREME = ("1/4", "1/1000", "1000", "1/8", "20", "1000000", "1/1000000")
WILD = 5
"""One of so many seeds draws extreme values too."""
_CLOSED = (sp.Limit, sp.Integral, sp.Subs, ExpansionTerm)


_PHI, _RATIO = GENERAL.phi.func, sp.Dummy("r", real=True)
_PLAIN = sp.Dummy(real=True)
"""A variable in place of a field."""
LAWS = tuple(
    sp.Lambda(_RATIO, law)
    for law in (
        sp.exp(-_RATIO),
        1 / (1 + sp.exp(4 * _RATIO - 8)),
        (1 - (_RATIO - 1) / sp.sqrt(1 + (_RATIO - 1) ** 2)) / 2,
    )
)
"""Contact laws: positive, smooth and decreasing."""


@cache
def with_law(relation: sp.Basic, number: int) -> sp.Basic:
    """Return a relation with one of LAWS in place of the unspecified contact law."""
    if not relation.has(_PHI):
        return relation
    return mapped(relation, lambda side: written_out(side, LAWS[number], _PHI))


@dataclass
class _Draft:
    """The values determined so far; ``implicit`` is the field that rests on itself.

    ``moving`` are data over which a limit or a derivative is taken: no other datum may depend on
    them.
    """

    moving: frozenset[sp.Basic]
    values: dict[sp.Expr, sp.Expr] = field(default_factory=dict)
    implicit: sp.Expr | None = None

    def assign(self, quantity: sp.Expr, value: sp.Expr, may_be_implicit: bool) -> bool:
        """Set ``quantity = value`` unless it is determined already; return whether it was set."""
        rate = isinstance(quantity, sp.Derivative)
        field_or_rate = forms_of(quantity.expr if rate else quantity)[:2]
        if any(known in self.values for known in (quantity, *field_or_rate)):
            return False
        rests_on = dependencies((value,), self.values, states=False)
        if _name(quantity) in DATA and rests_on & self.moving:
            return False
        if not rate and quantity in rests_on:
            if not may_be_implicit or not quantity.args or self.implicit:
                return False
            self.implicit = field_of(quantity)
        self.values[quantity] = value
        return True


def draw_model(
    relations: tuple[sp.Basic, ...], wanted: tuple[sp.Basic, ...], seed: int
) -> Model | None:
    """Return a model that should satisfy ``relations`` and has values for all of ``wanted``.

    The model depends on ``wanted`` only through derivatives and limits over data, except that now
    and then it makes a wanted relation an equality.
    """
    chance = random.Random(f"{seed} edge")
    edges = [edge for relation in wanted for edge in relation.atoms(Relational)]
    if edges and chance.random() < 0.15:
        edge = chance.choice(sorted(edges, key=str))
        relations = (*relations, sp.Eq(*edge.args, evaluate=False))
    whole = sp.Tuple(*relations, *wanted)
    slopes = slopes_over_data(whole)
    moving = {end.args[1] for end in whole.atoms(sp.Limit)} - {t}
    moving.update(*(slope.variables for slope in slopes))
    model = _draw_quantities(
        relations, seed, frozenset(slope.expr for slope in slopes), frozenset(moving)
    )
    if model is not None:
        for quantity in quantities(sp.Tuple(*wanted)):
            if not any(known in model.values for known in forms_of(quantity)[:2]):
                model.values[quantity] = _draw(quantity, seed)
    return model


@cache
def slopes_over_data(relation: sp.Basic) -> frozenset[sp.Expr]:
    """Return the derivatives with respect to data in a relation."""
    return frozenset(d for d in relation.atoms(sp.Derivative) if t not in d.variables)


@lru_cache(maxsize=2000)
def _draw_quantities(
    relations: tuple[sp.Basic, ...],
    seed: int,
    slopes: frozenset[sp.Expr],
    moving: frozenset[sp.Basic],
) -> Model | None:
    """Return a model of relations, in which the quantities ``slopes`` depend on the data
    ``moving``, by which they are differentiated."""
    chance, draft = random.Random(seed), _Draft(moving)
    parts = [part for r in relations for part in sorted(sp.And.make_args(r), key=str)]
    constants = {f: sp.Symbol(f"{_name(f)}(0)", real=True) for f in map(_constant, parts) if f}
    draft.values.update(constants)
    parts = [p if p.has(sp.Derivative) else p.xreplace(constants) for p in parts]
    for equations in (True, False):  # inequalities set quantities that no equation determines
        these = (part for part in parts if isinstance(part, sp.Eq) == equations)
        imposed = (_imposed(part, chance, seed % WILD == WILD - 1) for part in these)
        _assign([part for part in imposed if part is not None], draft, chance, slopes)
    values = draft.values
    unknown = quantities(sp.Tuple(*relations, *slopes, T, U, *values.values())) - values.keys()
    for quantity in sorted(unknown, key=lambda q: (bool(q.args), str(q))):
        _, *rate = forms_of(quantity)[:2]
        if rate and rate[0] in values:
            least = sp.S.One if quantity.is_positive else sp.S.Zero
            first = _value(quantity, seed)
            values.setdefault(quantity.subs(t, 0), first if chance.random() < 0.5 else least)
        else:
            values[quantity] = _fitting(quantity, seed, parts, values)
    return _model(draft)


def _name(quantity: sp.Expr) -> str:
    return str(quantity.func if quantity.args else quantity)


def _constant(part: sp.Basic) -> sp.Expr | None:
    """Return the field that a relation makes constant, None for other relations."""
    if isinstance(part, sp.Eq):
        left, right = part.args
        if isinstance(left, sp.Derivative) and right == 0 and left.expr.args == (t,):
            return left.expr
        if isinstance(left, AppliedUndef) and left.args == (t,) and right == left.subs(t, 0):
            return left
    return None


def _fitting(
    quantity: sp.Expr, seed: int, relations: list[sp.Basic], values: dict[sp.Expr, sp.Expr]
) -> sp.Expr:
    """Draw a number or a random function that satisfies the relations with known quantities.

    It is the last one tried if none of them does.
    """
    about = [
        relation
        for relation in relations
        if quantity in quantities(relation)
        and not any(q.args for q in quantities(relation) - {quantity})
    ]
    others = {known: value for known, value in values.items() if known in quantities(known)}
    for attempt in range(12 if about else 1):
        value = _draw(quantity, seed + 97 * attempt)
        if quantity.subs(t, 0) in values:
            value = value - value.subs(t, 0) + values[quantity.subs(t, 0)]
        partial = Model({**others, quantity: value})
        if all(truth(relation, partial).holds is not False for relation in about):
            break
    return value


def _model(draft: _Draft) -> Model | None:
    states = {key.expr for key in draft.values if isinstance(key, sp.Derivative)}
    starts = {key for key in draft.values if key.args == (0,) and key.func(t) not in states}
    values = {key: value for key, value in draft.values.items() if key not in starts}
    try:
        if draft.implicit:
            values |= _as_state(draft.implicit, values.pop(draft.implicit), values)
        model = Model(values)
        if model.states:
            _ = model.motion  # raises if there is none
    except (ArithmeticError, RecursionError, ValueError):
        return None
    return model


def _as_state(
    field: sp.Expr, image: sp.Expr, others: dict[sp.Expr, sp.Expr]
) -> dict[sp.Expr, sp.Expr]:
    """Return the rate and the start of a field ``y = G(y)``: y' = G_t + G_y y'."""
    rate = field.diff(t)
    inlined = Model({**others, rate: rate}).inlined(image, about=field)
    if inlined.has(sp.floor):
        raise UndecidedError("an implicit field that jumps")
    root = FirstZero(_PLAIN - inlined.xreplace({field: _PLAIN}), _PLAIN)
    return {rate: _implicit_rate(field, inlined), field.subs(t, 0): root}


@cache
def _implicit_rate(field: sp.Expr, image: sp.Expr) -> sp.Expr:
    """Return the rate of a field ``y = G(y)``."""
    flat = image.xreplace({field: _PLAIN})
    return (sp.diff(flat, t) / (1 - sp.diff(flat, _PLAIN))).xreplace({_PLAIN: field})


def _imposed(part: sp.Basic, chance: random.Random, wild: bool) -> sp.Basic | None:
    """Return an equation that implies a relation; None to leave the relation to chance."""
    if isinstance(part, (sp.Gt, sp.Ge, sp.Lt, sp.Le)):
        high, low = part.gts, part.lts
        if chance.random() > 0.7 or low.is_infinite or high.is_infinite:
            return None
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
    """Return an equation that implies the limit of an expression."""
    if value.is_infinite:
        wave = sp.sin(2 * sp.pi * t)
        growth = chance.choice((t, 1 + t, sp.log(1 + t), sp.sqrt(1 + t), sp.exp(t), t + wave))
        return sp.Eq(inside, growth * sp.sign(value), evaluate=False)
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
    """Let each equation determine one unknown; skip those without a solution.

    The quantities ``slopes``, which are differentiated by data, must be determined by equations.
    """
    remaining = []
    varied = chance.choice(equations) if equations and chance.random() < 0.6 else None
    for equation in equations:
        offers = list(solutions(equation))
        if slopes:
            offers = [offer for offer in offers if offer[0] in slopes] or offers[:1]
        if not offers:
            continue
        if equation is varied:
            factors = [s for s in _coefficients(equation) if s not in draft.values]
            if factors and chance.random() < 0.5:
                draft.values[chance.choice(factors)] = sp.S.Zero
                continue
            chance.shuffle(offers)
        if not draft.assign(*offers[0], may_be_implicit=False):
            remaining.append(offers)
    for offers in remaining:
        if not draft.assign(*offers[0], may_be_implicit=True):
            any(draft.assign(*offer, may_be_implicit=False) for offer in offers[1:])


@cache
def solutions(equation: sp.Eq) -> tuple[tuple[sp.Expr, sp.Expr], ...]:
    """Return the unknowns of an equation that it determines, with their values, its left side
    first."""
    plain = equation.replace(lambda e: isinstance(e, _CLOSED), lambda _: sp.Dummy())
    rates = sorted(plain.atoms(sp.Derivative), key=str)
    if any(set(d.variables) != {t} for d in rates):
        return ()
    moving = {d.expr for d in rates}
    fields = sorted(plain.atoms(AppliedUndef), key=str)
    unknowns = [d for d in rates if d.variables == (t,) and d.expr.args == (t,)]
    unknowns += [f for f in fields if f.args[0] == 0 or (f.args[0] == t and f not in moving)]
    if not plain.has(t, AppliedUndef):
        unknowns += sorted(plain.free_symbols - plain.atoms(sp.Dummy), key=str)
    offers = [(q, value) for q in unknowns if (value := _solved(equation, q)) is not None]
    return tuple(sorted(offers, key=lambda offer: offer[0] != equation.lhs))


@cache
def _coefficients(equation: sp.Eq) -> tuple[sp.Symbol, ...]:
    """Return the data that may vanish and are factors of a side of an equation."""
    factors = {f for side in equation.args for f in sp.Mul.make_args(sp.factor_terms(side))}
    return tuple(s for s in sorted(factors, key=str) if isinstance(s, sp.Symbol)
                 and not s.is_positive and s != t)  # fmt: skip


def _solved(equation: sp.Eq, quantity: sp.Expr) -> sp.Expr | None:
    """Return the value of a quantity by an equation that is linear in it.

    None if it is not, or if the value depends on the quantity at another time.
    """
    left, right = equation.args
    other = right if quantity == left else left
    if quantity in (left, right) and not other.has(quantity):
        value = other
    else:
        try:
            slope, rest = linear_coeffs(left - right, quantity)
        except NonlinearError:
            return None
        if slope == 0:
            return None
        value = -rest / slope
    known = quantity.expr if isinstance(quantity, sp.Derivative) else None
    field = (known or quantity).func
    if quantity.args and any(f.func == field and f != known for f in value.atoms(AppliedUndef)):
        return None
    return value


def slides_fast(seed: int) -> bool:
    """Return whether a model has a high slip rate.

    Then wear approaches its limit within a few periods; a slow counterexample shows more.
    """
    return seed % WILD == 3


@cache
def _draw(quantity: sp.Expr, seed: int) -> sp.Expr:
    """Draw a number or a random function of time."""
    return (_function if quantity.args else _value)(quantity, seed)


def _value(quantity: sp.Expr, seed: int) -> sp.Expr:
    """Draw a number for a quantity, in its domain."""
    chance = random.Random(f"{seed} {_name(quantity)}")
    wild = seed % WILD == WILD - 1 and chance.random() < 0.4
    size = sp.Rational(chance.choice(_EXTREME if wild else _ORDINARY))
    if quantity == V and slides_fast(seed):
        size = sp.Integer(1000)
    if quantity.is_positive:
        return size
    if quantity.is_nonnegative:
        return sp.S.Zero if chance.random() < 0.25 else size
    if chance.random() < 0.15:
        return sp.S.Zero
    return -size if chance.random() < 0.3 else size


def _function(varying: sp.Expr, seed: int) -> sp.Expr:
    """Return a random function of time, in the domain of a quantity."""
    chance = random.Random(f"{seed} {_name(varying)}")
    s = t / T
    size = sp.Rational(chance.choice(("1", "1", "1", "2", "1/2", "-1", "1/4")))
    wave = sp.sin(2 * sp.pi * s)
    both = wave / 2 + sp.cos(4 * sp.pi * s) / 3
    shapes: list[sp.Expr] = [
        sp.S.One, s, wave, sp.exp(-s), 1 - sp.exp(-s), sp.log(1 + s), sp.sqrt(s), s + wave / 8,
        sp.exp(s), sp.tanh(s), 1 / (1 + s), s / (1 + s), sp.sin(sp.log(1 + s)), s**2, sp.S.Zero,
        both, 1 + s, 2 + wave, s - sp.log(1 + s), sp.cos(2 * sp.pi * s), s * sp.sin(s),
    ]  # fmt: skip
    shape = chance.choice(shapes)
    if varying == symbol("U_a"):  # the seed determines the kind of load
        loads = (sp.S.One, sp.sin(sp.log(1 + s)), s, wave, sp.sin(s), sp.sqrt(s),
                 sp.S.Zero, sp.log(1 + s), (-1) ** sp.floor(2 * s), sp.exp(-s), both, -s,
                 s * sp.sin(s))  # fmt: skip
        shape = loads[seed % len(loads)]
        size = U * sp.Rational(chance.choice(("1", "1", "1/2", "1", "-1", "2")))
    if varying.is_positive or varying.is_nonnegative:
        size = abs(size)
        shape = chance.choice((1, 1 + s, 2 + wave, sp.exp(-s), 1 / (1 + s), sp.exp(s),
                               (1 + s) * (2 + sp.sin(s))))  # fmt: skip
    return size * shape
