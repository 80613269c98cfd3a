"""Consistency of hypotheses: anything would follow from contradictory ones.

Overview
    ``derive.reals`` decides whether numbers satisfy the hypotheses: at any time, at the start, at
    extremes of sines, for rates, and late, where limits are near.  Other contradictions are found
    by the falsifier, as judgements that no model satisfies.
Key results
    inconsistency    why some hypotheses cannot stand together, or None
"""

from __future__ import annotations

from collections.abc import Iterable

import sympy as sp
from sympy.core.function import AppliedUndef

from .claims import Term
from .hypotheses import Hypothesis, Kind
from .language import defined_by, meant_by
from .memory import cache
from .note.model import CLOSURE, WEARING, subject
from .parts import bound_in
from .reals import contradictory
from .symbols import CLOCKS, QUANTITIES, symbol, t

_PRESSURE, _PERIOD = symbol("p"), symbol("T")
_SCALED = dict.fromkeys((symbol("tau"), symbol("N")), t / _PERIOD)


def inconsistency(hypotheses: tuple[Hypothesis, ...]) -> str | None:
    """Return why hypotheses cannot stand together, None if no reason is known."""
    return _of_names(hypotheses) or _of_model(hypotheses)


def _of_names(hypotheses: tuple[Hypothesis, ...]) -> str | None:
    """Return the fault of a name with two definitions or a circular one, which may hide a
    condition."""
    rests = dict[str, frozenset[str]]()
    for relation in (h.relation for h in hypotheses if h.kind is Kind.DEFINITION):
        if not rests.keys().isdisjoint(defined_by(relation)):
            return "two definitions of one name"
        rests |= dict.fromkeys(defined_by(relation), meant_by(relation))
    while rests:
        done = [name for name, on in rests.items() if on.isdisjoint(rests)]
        if not done:
            return f"{', '.join(rests)}: no new name, but a circle of definitions"
        for name in done:
            del rests[name]
    return None


def _of_model(hypotheses: tuple[Hypothesis, ...]) -> str | None:
    """Return the fault of hypotheses that have no model.

    They hold at every time, the start included, and equal fields that wear have equal rates.
    Two equations of the model for one quantity are refused too, since readers do not see them:
    h(0) = h_0 of (6) contradicts (1) if the load does not begin at zero.
    """
    of_closure = [h for h in hypotheses if h.relation.has(CLOSURE[True].lhs.func)]
    if len(of_closure) > 1 and any(h.kind is Kind.INITIAL for h in of_closure):
        return "h(0) = h_0, and more is said of h: two equations of the model"
    equalities = [h for h in hypotheses if isinstance(h.relation, sp.Equality)]
    given = [subject(h.relation) for h in equalities if h.kind is Kind.MODEL]
    if len({law for h in equalities if (law := _contact_law(h.relation)) is not None}) > 1:
        return "two contact laws"
    if (
        len(set(given)) < len(given)
        or contradictory(_at_times(hypotheses))
        or contradictory(_at_last([h.relation for h in hypotheses]))
    ):
        return "the hypotheses contradict each other"
    return None


def _contact_law(relation: sp.Equality) -> sp.Expr | None:
    """Return the pressure in contact by a contact law, None for any other equation."""
    law = relation.rhs
    if relation.lhs != _PRESSURE or not all(law.has(symbol(each).func) for each in ("h", "sigma")):
        return None
    return law.args[0].expr if isinstance(law, sp.Piecewise) else law


def _at_times(hypotheses: tuple[Hypothesis, ...]) -> frozenset[sp.Basic]:
    """Return the hypotheses in contact, also at all times in them, at extremes, and for rates."""
    now = [_in_time(h.relation) for h in hypotheses]
    pressed = [sp.Gt(_PRESSURE, 0)] if any(relation.has(_PRESSURE) for relation in now) else []
    fields = frozenset[sp.Basic]().union(*(relation.atoms(AppliedUndef) for relation in now))
    times = frozenset(f.args[0] for f in fields if f.func.__name__ in QUANTITIES) | {sp.S.Zero}
    times = times.union(*map(_extremes, now)) - {t}
    implied = (said for relation in now for said in _implied(relation, times))
    return frozenset((*pressed, *now, *implied, sp.Gt(t, 0)))


def _in_time(relation: sp.Basic) -> sp.Basic:
    """Write the clocks of a relation as functions of time."""
    bound = relation.has(sp.Derivative, Term) or not bound_in(relation).isdisjoint(_SCALED)
    return relation if bound else relation.xreplace(_SCALED)


def _at_last(relations: Iterable[sp.Basic]) -> frozenset[sp.Basic]:
    """Return relations at a late time, and between limits, which keep an order but no strictness.

    Then what tends to infinity exceeds every constant, and the rest is near its limit.  What stays
    above a multiple of time tends to infinity; a periodic field is what it was at the start.
    """
    said = [part for relation in relations for part in sp.And.make_args(relation)]
    limits = [r for r in said if isinstance(r, sp.Eq) and isinstance(r.lhs, sp.Limit)]
    ends = [(limit.lhs.args[0], limit.rhs) for limit in limits]
    ends += [(grown, sp.oo) for grown in map(_growing, said) if grown is not None]
    if not ends:
        return frozenset()
    said += [sp.Eq(r.rhs, r.rhs.subs(t, 0), evaluate=False) for r in said if _repeats(r)]
    orders = [_WEAK[r.func](*r.args, evaluate=False) for r in said if r.func in _WEAK]
    orders += [sp.Eq(part, end, evaluate=False) for part, end in ends]
    sides = {side for order in orders for side in order.args if not side.has(sp.Limit)}
    still = {c for c in sides if c.is_real and CLOCKS.isdisjoint(map(str, c.free_symbols))}
    facts, margin = {*said}, sp.Dummy(positive=True)
    for part, end in ends:
        if end.is_finite is False:
            large = part if end is sp.oo else -part
            facts |= {sp.Gt(large, sign * c + margin) for c in still | {0} for sign in (1, -1)}
        else:
            facts.add(sp.Lt(sp.Abs(part - end), margin))
            facts |= {r.xreplace({part: end}) for r in orders if still | {part} >= {*r.args}}
    return frozenset(facts)


def _growing(order: sp.Basic) -> sp.Expr | None:
    """Return the field that a relation keeps above a multiple of time, or whose rate it keeps above
    a positive constant; None for others."""
    if order.func not in _WEAK:
        return None
    grown, speed = order.args if isinstance(order, sp.Eq) else (order.gts, order.lts)
    if speed.atoms(AppliedUndef):
        return None
    if isinstance(grown, sp.Derivative) and grown.variables == (t,):
        grown = grown.expr
    else:
        speed = sp.diff(speed, t)
    steady = speed.is_positive and CLOCKS.isdisjoint(map(str, speed.free_symbols))
    return grown if steady and isinstance(grown, AppliedUndef) else None


def _repeats(relation: sp.Basic) -> bool:
    """Return whether a relation says that a field has the period T."""
    sides = relation.args if isinstance(relation, sp.Eq) else (t, t)
    return (
        isinstance(sides[1], AppliedUndef) and sides[0] == sides[1].subs(t, t + _PERIOD) != sides[1]
    )


_WEAK = {relation: relation for relation in (sp.Eq, sp.Ge, sp.Le)} | {sp.Gt: sp.Ge, sp.Lt: sp.Le}


@cache
def _extremes(relation: sp.Basic) -> frozenset[sp.Expr]:
    """Return the first times at which the sines of time in a relation are 0, 1 and -1."""
    phases = {wave.args[0]: wave.args[0].diff(t) for wave in relation.atoms(sp.sin, sp.cos)}
    turning = (rate for phase, rate in phases.items() if phase == rate * t and rate.is_positive)
    return frozenset(part * sp.pi / (2 * rate) for rate in turning for part in (1, 2, 3))


@cache
def _implied(relation: sp.Basic, times: frozenset[sp.Basic]) -> tuple[sp.Basic, ...]:
    """Return a relation between fields at other times, and between their rates."""
    fields = relation.atoms(AppliedUndef)
    unsuited = relation.has(sp.Derivative, sp.Integral, sp.Limit)
    instants = {f.args for f in fields}
    if (
        unsuited
        or not {(t,)} <= instants <= {(t,), (0,)}
        or any(free.name in CLOCKS - {"t"} for free in relation.free_symbols)
    ):
        return ()
    then = (relation.subs(t, time) for time in times)
    if isinstance(relation, sp.Eq) and fields <= WEARING:
        return *then, sp.Eq(*(sp.diff(side, t) for side in relation.args), evaluate=False)
    return tuple(then)
