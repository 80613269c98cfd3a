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
from collections.abc import Iterable, Iterator
from dataclasses import dataclass, field
from functools import cache

import sympy as sp
from flint import fmpq
from sympy.core.function import AppliedUndef
from sympy.core.relational import Relational

from ..laws import GENERAL
from ..symbols import symbol, t
from .balls import fraction
from .models import Model
from .truth import truth

T, U = symbol("T"), symbol("U")
_ORDINARY = ("1", "1", "1", "1/2", "2", "3/4", "3/2", "3", "2/3")
_EXTREME = ("1/4", "1/1000", "1000", "1/8", "20", "1000000", "1/1000000")
WILD = 5
"""Every so many seeds draw extreme values too."""
_CLOSED = (sp.Limit, sp.Integral, sp.Subs)


_PHI, _RATIO = GENERAL.phi.func, sp.Dummy("r", real=True)
_LAWS = (
    sp.exp(-_RATIO),
    1 / (1 + sp.exp(4 * _RATIO - 8)),
    (1 - (_RATIO - 1) / sp.sqrt(1 + (_RATIO - 1) ** 2)) / 2,
)
"""Positive, continuous, decreasing laws of contact."""


@cache
def with_law(relation: sp.Basic, seed: int) -> sp.Basic:
    """Return a relation about any law of contact, for one."""
    if not relation.has(_PHI):
        return relation
    law = sp.Lambda(_RATIO, _LAWS[seed % len(_LAWS)])
    written = relation.replace(_PHI, law)
    return written.replace(lambda e: isinstance(e, sp.Subs), lambda slope: slope.doit())


@dataclass
class _Draft:
    """What is determined so far."""

    data: dict[sp.Symbol, sp.Expr] = field(default_factory=dict)
    fields: dict[str, sp.Expr] = field(default_factory=dict)
    rates: dict[str, sp.Expr] = field(default_factory=dict)
    start: dict[str, sp.Expr] = field(default_factory=dict)
    loops: set[str] = field(default_factory=set)

    def takes(self, kind: str, name: str | sp.Symbol, value: sp.Expr, looped: bool) -> bool:
        """Take ``name = value``, unless something else determines it already."""
        known = {"data": self.data, "fields": self.fields, "rates": self.rates, "start": self.start}
        book = known[kind]
        if name in book or (kind == "fields" and name in self.rates):
            return False
        if kind == "rates" and name in self.fields:
            return False
        if kind in ("fields", "data") and self._reaches(value, name):
            if not looped or kind == "data" or self.loops:
                return False
            self.loops.add(str(name))
        book[name] = value
        return True

    def _reaches(self, value: sp.Expr, name: str | sp.Symbol) -> bool:
        """Return whether a value rests on ``name``, states apart."""
        seen, waiting = set(), [value]
        while waiting:
            for atom in _unknowns(waiting.pop()):
                if atom == name:
                    return True
                if atom not in seen and atom not in self.rates:
                    seen.add(atom)
                    waiting += [b[atom] for b in (self.data, self.fields) if atom in b]
        return False


def _unknowns(expr: sp.Basic) -> set[str | sp.Symbol]:
    fields = {f.func.__name__ for f in expr.atoms(AppliedUndef)}
    return fields | {s for s in expr.free_symbols if s != t}


def drawn(
    relations: Iterable[sp.Basic],
    wanted: Iterable[sp.Basic],
    seed: int,
    free: frozenset[str] = frozenset(),
) -> Model | None:
    """Return a model that is made to satisfy ``relations`` and gives all of ``wanted`` a value.

    The domains of the quantities in ``free`` are left on purpose.
    """
    chance = random.Random(seed)
    draft = _Draft()
    relations, wanted = tuple(relations), tuple(wanted)
    parts = [p for relation in relations for p in _parts(relation, chance)]
    everything = sp.Tuple(*relations, *wanted)
    edges = sorted((e for w in wanted for e in w.atoms(Relational)), key=str)
    if edges and chance.random() < 0.15:  # on the edge of what is claimed
        edge = chance.choice(edges)
        parts.append(sp.Eq(*edge.args, evaluate=False))
    parts.sort(key=lambda part: not isinstance(part, sp.Eq))
    still = {f: sp.Symbol(f"{f.func.__name__}(0)", real=True) for f in map(_constant, parts) if f}
    draft.fields.update({f.func.__name__: value for f, value in still.items()})
    parts = [p if p.has(sp.Derivative) else p.xreplace(still) for p in parts]
    pending = [_imposed(part, chance, seed % WILD == WILD - 1) for part in parts]
    slopes = {d.expr for d in everything.atoms(sp.Derivative) if t not in d.variables}
    _assign([p for p in pending if p is not None], draft, chance, slopes)
    corners: sp.Expr = sp.S.Zero
    functions = {f.func.__name__: f.func for f in everything.atoms(AppliedUndef)}
    symbols = {s for s in everything.free_symbols if isinstance(s, sp.Symbol) and s != t}
    for book in (draft.fields, draft.rates, draft.start, draft.data):
        symbols |= {s for e in book.values() for s in e.free_symbols if s != t}
    for name in sorted(symbols | {T, U}, key=str):
        if name not in draft.data:
            draft.data[name] = _value(str(name), name, seed, str(name) in free)
    for name in sorted(functions):
        value = functions[name](t)
        if name in draft.rates:
            least = sp.S.One if value.is_positive else sp.S.Zero
            first = _value(name, value, seed, name in free)
            draft.start.setdefault(name, first if chance.random() < 0.5 else least)
        elif name not in draft.fields:
            about = [p for p in parts if _fields(p) == {name}]
            draft.fields[name], corner = _fitting(name, value, seed, name in free, about, draft)
            corners = corner or corners
    return _model(draft, corners)


def _constant(part: sp.Basic) -> sp.Expr | None:
    """Return the field of which a relation says that it does not vary."""
    if isinstance(part, sp.Eq):
        left, right = part.args
        if isinstance(left, sp.Derivative) and right == 0 and left.expr.args == (t,):
            return left.expr
        if isinstance(left, AppliedUndef) and left.args == (t,) and right == left.subs(t, 0):
            return left
    return None


def _fields(expr: sp.Basic) -> set[str]:
    return {f.func.__name__ for f in expr.atoms(AppliedUndef)}


def _fitting(
    name: str, value: sp.Expr, seed: int, outside: bool, about: list[sp.Basic], draft: _Draft
) -> tuple[sp.Expr, sp.Expr]:
    """Return a test function of which holds what is said of it alone; the last one tried if none
    is found."""
    for attempt in range(12 if about else 1):
        made, corner = test_function(name, value, seed + 97 * attempt, outside)
        if name in draft.start:
            made = made - made.subs(t, 0) + draft.start[name]
        alone = Model(draft.data, {**draft.fields, name: made})
        if all(truth(relation, alone).holds for relation in about):
            break
    return made, corner


def _model(draft: _Draft, corner: sp.Expr) -> Model | None:
    period = draft.data.get(T, sp.S.One)
    exact = fraction(period) if period.is_Rational and period > 0 else fmpq(1)
    fields = {name: value for name, value in draft.fields.items() if name not in draft.loops}
    loops = {name: draft.fields[name] for name in draft.loops}
    start = {name: value for name, value in draft.start.items() if name in draft.rates}
    try:
        model = Model(draft.data, fields, draft.rates, start, loops, corner, exact)
        if model.rates:
            _ = model.motion  # there is one
    except (ArithmeticError, RecursionError, ValueError, StopIteration, KeyError, TypeError):
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
    equations: list[sp.Eq], draft: _Draft, chance: random.Random, slopes: set[sp.Expr]
) -> None:
    """Let each equation determine one unknown; those that nothing can be solved for are left.

    What is differentiated with respect to data (``slopes``) must follow from the data.
    """
    rest = []
    for equation in equations:
        offers = list(solutions(equation))
        named = [offer for offer in offers if offer[1] in slopes]
        if slopes:
            offers = named or offers[:1]
        if not offers:
            continue
        factors = [s for s in _coefficients(equation) if s not in draft.data]
        if factors and chance.random() < 0.2:
            draft.data[chance.choice(factors)] = sp.S.Zero
            continue
        if chance.random() < 0.2:
            chance.shuffle(offers)
        if not any(draft.takes(*offer, looped=False) for offer in offers):
            rest.append(offers)
    for offers in rest:
        any(draft.takes(*offer, looped=True) for offer in offers)


@cache
def solutions(equation: sp.Eq) -> tuple[tuple[str, str | sp.Symbol, sp.Expr], ...]:
    """Return what an equation can be solved for: kind, name, value; the left side first."""
    found = []
    open_part = equation.replace(lambda e: isinstance(e, _CLOSED), lambda _: sp.Dummy())
    timeless = not open_part.has(t)
    rates = set(open_part.atoms(sp.Derivative))
    moving = {d.expr.func for d in rates if isinstance(d.expr, AppliedUndef)}
    for d in sorted(rates, key=str):
        if isinstance(d.expr, AppliedUndef) and d.variables == (t,):
            found.append(("rates", d.expr.func.__name__, d))
    for f in sorted(open_part.atoms(AppliedUndef), key=str):
        if f.args[0] == t and f.func not in moving:
            found.append(("fields", f.func.__name__, f))
        elif f.args[0] == 0:
            found.append(("start", f.func.__name__, f))
    if any(d.variables != (t,) * len(d.variables) for d in rates):
        return ()
    if timeless and not open_part.atoms(AppliedUndef):
        found += [("data", s, s) for s in sorted(open_part.free_symbols, key=str)
                  if not isinstance(s, sp.Dummy)]  # fmt: skip
    solved = ((kind, name, atom, _solved(equation, atom)) for kind, name, atom in found)
    good = [(k, n, a, v) for k, n, a, v in solved if v is not None and not _dangling(v, a)]
    good.sort(key=lambda offer: offer[2] != equation.lhs)
    return tuple((k, n, v) for k, n, a, v in good)


@cache
def _coefficients(equation: sp.Eq) -> tuple[sp.Symbol, ...]:
    """Return the data that may vanish and multiply a whole side of an equation."""
    factors = {f for side in equation.args for f in sp.Mul.make_args(sp.factor_terms(side))}
    return tuple(s for s in sorted(factors, key=str) if isinstance(s, sp.Symbol)
                 and not s.is_positive and s != t)  # fmt: skip


def _dangling(value: sp.Expr, atom: sp.Expr) -> bool:
    """Return whether the value still has the unknown, at this time or another."""
    if isinstance(atom, sp.Derivative):
        return any(f.func == atom.expr.func and f != atom.expr for f in value.atoms(AppliedUndef))
    return isinstance(atom, AppliedUndef) and any(
        f.func == atom.func for f in value.atoms(AppliedUndef)
    )


def _solved(equation: sp.Eq, atom: sp.Expr) -> sp.Expr | None:
    left, right = equation.args
    for here, other in ((left, right), (right, left)):
        if here == atom and not other.has(atom):
            return other
    dummy = sp.Dummy()
    residual = (left - right).xreplace({atom: dummy})
    slope = sp.diff(residual, dummy)
    if slope == 0 or slope.has(dummy) or slope.has(sp.Derivative):
        return None
    return -residual.xreplace({dummy: sp.S.Zero}) / slope


def _value(name: str, quantity: sp.Expr, seed: int, outside: bool) -> sp.Expr:
    """Draw a number for a quantity, outside of its domain if asked."""
    chance = random.Random(f"{seed} {name}")
    wild = seed % WILD == WILD - 1 and chance.random() < 0.4
    size = sp.Rational(chance.choice(_EXTREME if wild else _ORDINARY))
    if quantity.is_positive:
        return (-size if chance.random() < 0.7 else sp.S.Zero) if outside else size
    if quantity.is_nonnegative:
        return -size if outside else (sp.S.Zero if chance.random() < 0.25 else size)
    if chance.random() < 0.15:
        return sp.S.Zero
    return -size if chance.random() < 0.3 else size


def test_function(name: str, value: sp.Expr, seed: int, outside: bool) -> tuple[sp.Expr, sp.Expr]:
    """Return a test function of time, and the spacing of its corners (0: it has none)."""
    chance = random.Random(f"{seed} {name}")
    s = t / T
    size = sp.Rational(chance.choice(("1", "1", "1", "2", "1/2", "-1", "1/4")))
    wave = sp.sin(2 * sp.pi * s)
    families: list[sp.Expr] = [
        sp.S.One, s, wave, sp.exp(-s), 1 - sp.exp(-s), sp.log(1 + s), sp.sqrt(s), s + wave / 8,
        sp.exp(s), sp.tanh(s), 1 / (1 + s), s / (1 + s), sp.sin(sp.log(1 + s)), s**2, sp.S.Zero,
        wave / 2 + sp.cos(4 * sp.pi * s) / 3, 1 + s, 2 + wave, s - sp.log(1 + s),
        sp.cos(2 * sp.pi * s),
    ]  # fmt: skip
    shape = chance.choice(families)
    if name == "U_a":  # one kind of load after the other
        loads = (sp.S.One, sp.sin(sp.log(1 + s)), s, 1 - sp.exp(-s), wave, sp.sqrt(s),
                 sp.S.Zero, sp.log(1 + s), (-1) ** sp.floor(2 * s), sp.exp(-s), families[15], -s,
                 s * wave)  # fmt: skip
        shape = loads[seed % len(loads)]
        size = U * sp.Rational(chance.choice(("1", "1", "1/2", "1", "-1", "2")))
    made = size * shape
    if value.is_positive or value.is_nonnegative:
        made = abs(size) * chance.choice((1, 1 + s, 2 + wave, sp.exp(-s), 1 / (1 + s), sp.exp(s)))
        made = -made if outside else made
    return made, T / 2 if made.has(sp.floor) else sp.S.Zero
