"""The language of claims: the expressions that they may contain.

Overview
    The kernel trusts the heads that the model needs, exact real numbers, and names with their
    domain in the vocabulary.  Excluded are other heads, to which SymPy may assign a wrong sign, a
    second f_c with another domain, O(t), which is no number, and floats, which are not exact.
    Each head has one form, and parts of its types: what is cut off is 0 beyond a bound, derivatives
    are first ones, fields are taken now, one period later, at the start, after N cycles or at a
    phase.  What binds a variable binds a symbol.  Limits, integrals and the like are terms of sums.
Key results
    fault         the reason why an expression is not in the language, or None
    names         the names in an expression, with their symbols or functions
    defined_by    the names that a definition introduces
    meant_by      the names in their meaning
    is_changed    whether a part of an expression was changed in place
    without_time  printed text without the time of fields
"""

from __future__ import annotations

import re
from collections.abc import Callable, Iterator
from itertools import chain, repeat

import sympy as sp
from sympy.core.function import AppliedUndef, UndefinedFunction
from sympy.core.relational import Relational
from sympy.functions.elementary.piecewise import ExprCondPair
from sympy.printing.latex import accepted_latex_functions

from .claims import (
    Continuous,
    Drift,
    FirstZero,
    Oscillation,
    Predicate,
    SlowEquation,
    Term,
    landau_o,
)
from .laws import GENERAL
from .memory import cache, is_plain
from .note.model import FIELDS
from .parts import bound, bound_in, is_slope_of_law, nonnegative, positive
from .reals import holds
from .repairs import misjudged
from .symbols import CLOCKS, DATA, EXTREMES, QUANTITIES, symbol, t

_HASH = sp.Basic.__hash__
_HEADS = frozenset(
    (
        *(sp.Add, sp.Mul, sp.Pow, sp.Abs, sp.Piecewise, ExprCondPair),
        *(sp.exp, sp.log, sp.tanh, sp.sin, sp.cos, sp.LambertW, sp.Ei, sp.besseli),
        *(sp.Limit, sp.Integral, sp.Derivative, sp.Subs, sp.Lambda, sp.Tuple),
        *(sp.Eq, sp.Ne, sp.Gt, sp.Ge, sp.Lt, sp.Le, sp.And, sp.Equivalent),
        *map(type, (sp.true, sp.false, sp.pi, sp.E, sp.S.Half, sp.S(0), sp.S(1), sp.S(-1))),
        *(sp.Integer, sp.Rational, FirstZero, Drift, Oscillation, Continuous, SlowEquation),
    )
)
_MODEL = frozenset(f.__name__ for f in FIELDS) | DATA | CLOCKS | EXTREMES
_MARKS = str.maketrans("", "", " {}")
_OPERATORS, _OPERANDS = ("d", "max", "min"), frozenset(QUANTITIES) | CLOCKS
_FACES = frozenset(quantity.latex.translate(_MARKS) for quantity in QUANTITIES.values())
_WORDS = frozenset(head.__name__ for head in _HEADS) | {
    *accepted_latex_functions,
    *(
        "pi",
        "oo",
        "zoo",
        "nan",
        "I",
        "E",
        "sqrt",
        "lim",
        "inf",
        "sup",
        "max",
        "min",
        "ln",
        "true",
        "false",
        "phi",
        "o",
        "O",
        "e",
        "W",
    ),
}
_LAW = GENERAL.phi.func
_FUNCTIONS = frozenset((_LAW, landau_o))
_NOW = re.compile(rf"\b({'|'.join(q.name for q in QUANTITIES.values() if q.varies)})\(t\)")
"""A field of the vocabulary at the present time, in print."""
_PARTS = {
    **{FirstZero: 2, Drift: 5, Oscillation: 5, Continuous: 1, SlowEquation: 2, sp.besseli: 2},
    **dict.fromkeys((sp.Abs, sp.exp, sp.log, sp.tanh, sp.sin, sp.cos, sp.LambertW, sp.Ei), 1),
}
_PARTS_OF: dict[type, tuple[type | tuple[type, ...], type | tuple[type, ...]]] = {
    **dict.fromkeys((sp.Integral, sp.Derivative, sp.Subs), (sp.Expr, sp.Tuple)),
    sp.Lambda: (sp.Tuple, sp.Expr),
    sp.Piecewise: (ExprCondPair, ExprCondPair),
    ExprCondPair: (sp.Expr, (Relational, type(sp.true))),
    **dict.fromkeys((sp.And, sp.Equivalent), ((Relational, Predicate),) * 2),
}
"""The types of the first part of a node, and of the others, where these are not numbers."""
_TERMS = (sp.Limit, sp.Integral, sp.Piecewise, sp.LambertW, sp.Ei, FirstZero, Term, landau_o)
"""Heads of terms, which are in no function or power, nor in another term."""
_BODIES = (sp.Integral, sp.Piecewise, FirstZero, Term)
"""Heads of terms without derivatives."""
_SUMS = (sp.Add, sp.Mul, Relational, sp.And, sp.Equivalent)
_AS_WRITTEN = (Relational, sp.And, sp.Equivalent, sp.Derivative, sp.Limit)
"""Heads that a claim holds as they are written, without evaluation."""
_PERIOD = symbol("T")
_CYCLE = (symbol("tau"), symbol("rho"))
_NAME = re.compile(r"[A-Za-z][A-Za-z0-9]*(_[A-Za-z0-9]+)*")
_BESSEL = re.compile(r"I_?[0-9]+")
_SIGNS = [{domain: True} for domain in ("real", "positive", "nonnegative")]
_DOMAINS = [sp.Dummy(**domain).assumptions0 for domain in _SIGNS]
_RANGES = [sp.Function("any", **domain)._kwargs for domain in _SIGNS]


def fault(expr: sp.Basic) -> str | None:
    """Return why an expression is not in the language, None if it is.

    The type of a node is checked before any of its methods, which a subclass may override.

    >>> fault(symbol("f_c") + 1), fault(sp.Symbol("f_c", positive=True))
    (None, 'f_c is not the f_c of the vocabulary')
    """
    found = f"{expr} was changed" if is_changed(expr) else None
    found = found or next(filter(None, map(_fault, _nodes(expr))), None)
    found = found or next(filter(None, map(_leaves_domain, _nodes(expr))), None)
    if not found and any(isinstance(free, sp.Dummy) for free in expr.free_symbols):
        return f"{expr} has a name that others may have"
    twice = () if found else {s.name for s in expr.free_symbols & bound_in(expr)} - CLOCKS - DATA
    return f"{expr} has {min(twice)} both free and bound" if twice else found


def _nodes(expr: sp.Basic) -> Iterator[sp.Basic]:
    """Yield the nodes of an expression, without the infinities that a limit may have."""
    yield expr
    parts = expr.args
    if isinstance(expr, (sp.Limit, landau_o)):
        parts = parts[:2]
    elif isinstance(expr, sp.Eq) and isinstance(parts[0], sp.Limit):
        parts = [part for part in parts if part is not sp.oo and part is not -sp.oo]
    for part in parts:
        yield from _nodes(part)


def is_changed(expr: sp.Basic) -> bool:
    """Return whether a part was changed in place, after SymPy had stored its hash."""
    parts = (node for node in sp.preorder_traversal(expr) if type(node).__hash__ is _HASH)
    return any(hash((type(n).__name__, *n._hashable_content())) != hash(n) for n in parts)


def _fault(node: sp.Basic) -> str | None:
    kind = type(node)
    parts = 3 if isinstance(node, landau_o) else 1
    function = isinstance(kind, UndefinedFunction) and is_plain(kind) and len(node.args) == parts
    if not function and kind not in (sp.Symbol, sp.Dummy, *_HEADS):
        return f"{kind.__name__} is of no kind that a claim may hold"
    if len(node.args) != _PARTS.get(kind, len(node.args)):
        return f"{node} has no {_PARTS[kind]} parts"
    if not _is_typed(node):
        return f"{node} has a part of another type"
    wanted, fits = _FORMS.get(kind, ("", bool))
    if wanted and not fits(node):
        return f"{node} is no {wanted}"
    if not _is_evaluated(node):
        return f"{node} is not evaluated"
    if term := _term_inside(node):
        return f"{term} is a term in {node}, not in a sum"
    if kind in (sp.Symbol, sp.Dummy):
        return _fault_of_name(node, node.name)
    if function:
        if node.func not in _FUNCTIONS and not _is_instant(node.args[0]):
            return f"{node} is at no time"
        own = vars(node).keys() - {"nargs"}
        return f"{node} has signs of its own" if own else _fault_of_name(node, kind.__name__)
    if any(not variable.is_Symbol for variable in bound(node)):
        return f"{node} binds a quantity that is no variable"
    if isinstance(node, _BODIES) and any(isinstance(name, sp.Dummy) for name in bound(node)):
        return f"{node} binds a name that others may have"
    if isinstance(node, sp.Integral) and node.args[1][1:].has(*node.variables):
        return f"{node} has its variable in its own ends"
    inner = {(part.name, part) for part in node.args[0].atoms(sp.Symbol)} if bound(node) else ()
    if len(dict(inner)) < len(inner):
        return f"{node} has two variables of one name"
    if fixed := _held_fixed(node):
        return f"{node} holds {fixed} fixed"
    if node.args and misjudged(node):
        return f"{node} has a sign without proof"
    if kind is sp.Eq and isinstance(node.lhs, sp.Limit) and _clocks(node.rhs):
        return f"{node.rhs} cannot be a limit: it varies"
    return None


def _is_typed(node: sp.Basic) -> bool:
    """Return whether the parts of a node are numbers, or what belongs there in their place.

    SymPy would take the contact law of a relation.  Functions are fields of rules, no parts.
    """
    parts = node.args[:2] if isinstance(node, sp.Limit) else node.args
    first, others = _PARTS_OF.get(type(node), (sp.Expr, sp.Expr))
    pairs = zip(parts, chain((first,), repeat(others)), strict=False)
    return all(isinstance(part, kind) and type(part) is not sp.Lambda for part, kind in pairs)


def _is_evaluated(node: sp.Basic) -> bool:
    """Return whether SymPy gives a node again from its parts.

    It may have no right sign for what it would not make: 0/2, tanh(0), |0/f_c|.
    """
    if isinstance(node, sp.Rational):
        return bool(node == sp.Rational(node.p, node.q))
    return not node.args or isinstance(node, _AS_WRITTEN) or node.func(*node.args) == node


def _is_instant(time: sp.Expr) -> bool:
    """Return whether a field may be taken at a time: now, one period later, at the start, after N
    cycles, or at a phase."""
    return time in (t, t + _PERIOD, 0, symbol("N") * _PERIOD, _CYCLE[0])


def _is_root(power: sp.Pow) -> bool:
    """Return whether the exponent of a power is rational; a power of e is written exp."""
    return power.exp.is_Rational and power.base is not sp.E


def _is_cut(pieces: sp.Piecewise) -> bool:
    """Return whether a value is cut off: 0 beyond a bound, as the pressure is."""
    first, *others = pieces.args
    until = isinstance(first.cond, (sp.GreaterThan, sp.LessThan))
    return until and [tuple(other.args) for other in others] == [(sp.S.Zero, sp.true)]


def _is_slope(node: sp.Derivative) -> bool:
    """Return whether a derivative is the first one of a field in time, of the law as a function of
    its variable, or of a name."""
    function, (variable, order), *others = node.args
    if others or order != 1:
        return False
    if function.is_Symbol:
        return str(variable) in DATA
    if isinstance(function, _LAW):
        return function.args == (variable,) and str(variable) not in CLOCKS
    times = ((t, t), (t + _PERIOD, t), (_CYCLE[0], _CYCLE[0]))
    return isinstance(function, AppliedUndef) and (function.args[0], variable) in times


def _is_wave(node: sp.Expr) -> bool:
    """Return whether a sine or cosine has a whole number of waves in a period."""
    turns = [node.args[0] / (2 * sp.pi * clock) for clock in (t / _PERIOD, _CYCLE[0])]
    return any(number.is_Integer for number in turns)


def _is_of_field(node: Continuous) -> bool:
    (field,) = node.args
    moves = isinstance(field, AppliedUndef) and field.has(t, _CYCLE[0])
    return moves and field.func not in _FUNCTIONS


def _is_of_data(zero: FirstZero) -> bool:
    """Return whether the expression of a first zero varies with nothing but its variable."""
    function, variable = zero.args
    return variable.is_Symbol and not function.atoms(AppliedUndef) and not _clocks(function)


def _is_coefficient(node: Term) -> bool:
    order, law, size, *cycle = node.args
    counts = order.is_Integer and order.is_positive
    return counts and size.is_Symbol and tuple(cycle) == _CYCLE and _clocks(law) <= {"tau"}


_FORMS: dict[type, tuple[str, Callable[[sp.Basic], bool]]] = {
    sp.Pow: ("power with a rational exponent", _is_root),
    sp.Piecewise: ("value that is 0 beyond a bound", _is_cut),
    sp.Derivative: ("rate and no slope of a name", _is_slope),
    sp.Subs: ("slope of the contact law", is_slope_of_law),
    Continuous: ("property of a field", _is_of_field),
    SlowEquation: ("equation of m and s_0", lambda node: all(e.is_Symbol for e in node.args)),
    sp.Limit: ("limit for t -> oo", lambda node: node.args[1:3] == (t, sp.oo)),
    sp.Integral: (
        "integral between two ends",
        lambda node: [len(limits) for limits in node.limits] == [3],
    ),
    sp.besseli: ("Bessel function of order 0", lambda node: node.order == 0),
    FirstZero: ("first zero of a function of data", _is_of_data),
    **dict.fromkeys((sp.sin, sp.cos), ("wave of the period", _is_wave)),
    **dict.fromkeys(
        (Drift, Oscillation),
        ("coefficient c_n or w_n at the phase tau and the pace rho", _is_coefficient),
    ),
}
"""The one form of each head."""


def _term_inside(node: sp.Basic) -> sp.Basic | None:
    """Return a term inside a function, a power or another term; a value that is cut off may be in
    an integral."""
    if isinstance(node, _SUMS):
        return None
    terms = (*_TERMS, sp.Derivative) if isinstance(node, _BODIES) else _TERMS
    cut = sp.Piecewise if isinstance(node, sp.Integral) else ()
    found = (term for term in node.atoms(*terms) - {node} if not isinstance(term, cut))
    return min(found, key=str, default=None)


def _clocks(expr: sp.Expr) -> set[str]:
    return {s.name for s in expr.free_symbols} & CLOCKS


def _held_fixed(node: sp.Basic) -> str:
    """Return the other quantities that vary with the variable that a node binds.

    With a clock all clocks vary; with a datum fields and names do.
    """
    if not isinstance(node, (sp.Integral, sp.Limit, sp.Subs, FirstZero, Term)):
        return ""
    body = node.args[1] if isinstance(node, Term) else node.args[0]
    taken = {str(variable) for variable in bound(node)}
    others = {s.name for s in body.free_symbols} - taken
    found = others & CLOCKS if taken & CLOCKS else set()
    if not taken.isdisjoint(DATA):
        found |= others - DATA | {str(field) for field in body.atoms(AppliedUndef)}
    return ", ".join(sorted(found))


def _leaves_domain(node: sp.Basic) -> str | None:
    """Return the fault of a variable with a value outside its domain, such as a negative time."""
    for name, value in _taken(node):
        inside = positive(value) if name.is_positive else nonnegative(value)
        if name.is_nonnegative and not holds(inside):
            return f"{name} is never {value}"
    return None


def _taken(node: sp.Basic) -> Iterator[tuple[sp.Basic, sp.Expr]]:
    """Yield the variables that a node gives a value, with these values."""
    if isinstance(node, AppliedUndef) and node.func not in _FUNCTIONS:
        yield t, node.args[0]
    elif isinstance(node, sp.Integral):
        yield from ((name, end) for name, *ends in node.limits for end in ends)


def _fault_of_name(node: sp.Expr, name: str) -> str | None:
    if name in QUANTITIES:
        known = symbol(name)
        same = node.func is known.func if node.args else node == known
        return None if same else f"{name} is not the {name} of the vocabulary"
    fits = node.assumptions0 in _DOMAINS if node.is_Symbol else node.func._kwargs in _RANGES
    known = (name in _WORDS or _BESSEL.fullmatch(name)) and node.func not in _FUNCTIONS
    if not fits or known or not _NAME.fullmatch(name) or not _shows(name):
        return f"{name} is no real quantity"
    return None


def _shows(name: str) -> bool:
    """Return whether a name is typeset unchanged, and unlike every quantity of the vocabulary, its
    differential and its extremes, and unlike an operator with an index (``lim_t``)."""
    shown, stem = typeset_name(name), name.rstrip("0123456789").partition("_")[0]
    unlike = shown.translate(_MARKS) not in _FACES and not re.fullmatch("d[A-Za-z]", name)
    unlike &= stem == name or len(stem) == 1 or stem not in _WORDS
    unlike &= not any(name == operator + of for operator in _OPERATORS for of in _OPERANDS)
    return unlike and re.sub(r"[\\_{}]", "", shown) == name.replace("_", "")


def without_time(text: str) -> str:
    """Return printed text with f for each field f(t) of the vocabulary.

    >>> without_time("u_c(t) + exp(t) + x(t)")
    'u_c + exp(t) + x(t)'
    """
    return _NOW.sub(r"\1", text)


@cache
def typeset_name(name: str) -> str:
    """Return a name as typeset: x1 and x_1 look alike."""
    return str(sp.latex(sp.Symbol(name))).replace(" ", "")


def _name(node: sp.Basic) -> str:
    if isinstance(node, sp.Symbol):
        return str(node.name)
    return str(node.func.__name__) if isinstance(type(node), UndefinedFunction) else ""


@cache
def names(expr: sp.Basic) -> frozenset[tuple[str, object]]:
    """Return the names in an expression, each with the symbol or function that bears it."""
    found = ((_name(n), n.func if n.args else n) for n in _nodes(expr))
    return frozenset(
        (name, bearer) for name, bearer in found if name and not isinstance(bearer, sp.Dummy)
    )


@cache
def in_time(expr: sp.Basic) -> frozenset[sp.Expr]:
    """Return the fields in an expression at the present time, t or tau."""
    fields = (f for f in expr.atoms(AppliedUndef) if f.func not in _FUNCTIONS)
    return frozenset(f for f in fields if f.args in ((t,), (_CYCLE[0],)))


def defined_by(relation: sp.Basic) -> frozenset[str]:
    """Return the names that a definition gives a meaning: a symbol, or all that are its own."""
    name = _name(relation.args[0]) if isinstance(relation, sp.Equality) else ""
    if name and (name not in _MODEL or relation.args[0].is_Symbol):
        return frozenset([name])
    return frozenset(name for name, _ in names(relation)) - _MODEL


def meant_by(relation: sp.Basic) -> frozenset[str]:
    """Return the names in the meaning of a definition: those of the value, or all others."""
    given = defined_by(relation)
    if given and {_name(relation.args[0])} == given:
        return frozenset(name for name, _ in names(relation.args[1]))
    return frozenset(name for name, _ in names(relation)) - given
