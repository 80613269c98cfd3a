"""The kernel: judgements, and the one place where they are made.

Overview
    A judgement ``Gamma |- claim`` states: if the hypotheses Gamma hold at every time, so does the
    claim.  A field that has a rate is the integral of it, and the rate may jump, as the pressure
    does: a relation with rates, and what follows from one at an instant, holds at almost every
    time; limits leave out the other times.  Rules alone make judgements: a rule is a theorem that
    reads its premises; all rules are in ``derive.rules``.  The hypotheses of a conclusion are those
    of the premises, plus those that the rule adds, minus those that a theorem discharges.
Key results
    Judgement     hypotheses, claim, and the rule and premises from which it follows
    Rule          a theorem, which concludes from premises
    infer         apply a rule
    chain         judgements and all that they rest on, premises first
    replay_fault  the reason why a judgement does not follow from its parents, or None
References
    Gordon, Milner, Wadsworth, Edinburgh LCF, 1979.
"""

from __future__ import annotations

import operator
import re
import sys
from abc import ABC, abstractmethod
from collections.abc import Callable, Hashable, Iterable
from dataclasses import InitVar, dataclass, fields
from functools import cache
from typing import ClassVar, dataclass_transform
from weakref import WeakKeyDictionary

import sympy as sp
from sympy.core.function import AppliedUndef
from sympy.core.relational import Relational

from .claims import Claim
from .hypotheses import Hypothesis, Kind
from .language import defined_by, fault, is_changed, meant_by, names, typeset_name
from .note.model import CLOSURE, WEARING, subject
from .reals import contradictory
from .symbols import CLOCKS, QUANTITIES, symbol, t
from .time_limit import TimeLimitError, time_limit

_RULES = "derive.rules."
_TOKEN = object()
_OPTIONAL = re.compile(r"\[(.*?)\]")
_PRESSURE, _PERIOD = symbol("p"), symbol("T")
LIMIT_S = 60.0
"""Limit of CPU time for a symbolic step, in seconds."""


def plain(expr: sp.Basic) -> str:
    """Return an expression as plain text."""
    return str(expr).replace("(t)", "")


def listed(labels: Iterable[str]) -> str:
    """Return labels as a list in words, with "and" before the last one.

    >>> listed(["(1)", "(2)", "(3)"])
    '(1), (2) and (3)'
    """
    *first, last = dict.fromkeys(labels) or ("",)
    return f"{', '.join(first)} and {last}" if first else last


class RuleError(ValueError):
    """A premise of a theorem is missing; the message names it."""


@dataclass(frozen=True)
class Conclusion:
    """The claim that a rule concludes, and the hypotheses that it adds and discharges.

    ``gives`` are parts of the claim that have a value by the theorem, not by the premises."""

    claim: Claim
    adds: tuple[Hypothesis, ...] = ()
    discharges: tuple[Hypothesis, ...] = ()
    gives: tuple[sp.Expr, ...] = ()


@dataclass_transform(frozen_default=True)
class Rule(ABC):
    """A theorem, as frozen data: its fields are the author's choices; its conditions are proved
    from premises."""

    words = ""
    """The sentence, with ``{0}`` for the first premise, ``{others}``, ``{all}``, ``{field}``.

    What stands in square brackets is left out where there are no others."""
    alone = ""
    """The sentence without premises, if another one."""
    premise_names: ClassVar[tuple[str, ...]] = ()
    """What the first premises are, in order, for messages; others may follow."""
    source = "elementary"
    """A reference for the theorem."""

    def __init_subclass__(cls) -> None:
        dataclass(frozen=True)(cls)

    def __call__(self, *premises: Judgement, name: str = "", remark: str = "") -> Judgement:
        """Return the judgement that follows from premises, as ``infer`` does."""
        return infer(self, *premises, name=name, remark=remark)

    @abstractmethod
    def conclude(self, *premises: Judgement) -> Conclusion:
        """Return the conclusion; RuleError names a missing premise or side condition."""

    def sentence(self, *labels: str, write: Callable[[sp.Basic], str] = plain) -> str:
        """Return a sentence on this application of the rule, with the labels of the premises."""
        fields = {name: write(v) for name, v in vars(self).items() if isinstance(v, sp.Basic)}
        places = {"all": listed(labels), "others": listed(labels[1:])}
        words = self.words if labels or not self.alone else self.alone
        words = _OPTIONAL.sub(r"\1" if labels[1:] else "", words)
        return words.format(*labels, **places, **fields)


@dataclass(frozen=True, eq=False)
class Judgement:
    """``hypotheses |- claim``, by ``rule`` from ``parents``.  Only ``infer`` makes one.

    ``remark`` is for readers: that the note drops a condition, switches a sign or rounds.
    """

    hypotheses: tuple[Hypothesis, ...]
    claim: Claim
    rule: Rule
    parents: tuple[Judgement, ...]
    name: str
    remark: str
    token: InitVar[object]

    def __post_init__(self, token: object) -> None:
        if token is not _TOKEN:
            raise TypeError("only a rule makes a judgement")
        _MADE[self] = self._held

    def __init_subclass__(cls) -> None:
        raise TypeError("only a rule makes a judgement")

    @property
    def _held(self) -> tuple[object, ...]:
        return self.hypotheses, self.claim, self.rule, self.parents

    @property
    def is_made(self) -> bool:
        """Return whether a rule made it, and it still holds what it held then."""
        known = _MADE.get(self)
        return known is not None and all(map(operator.is_, known, self._held))

    @property
    def relation(self) -> sp.Basic:
        """Return the claim as a SymPy relation."""
        return self.claim.relation

    @property
    def conditions(self) -> tuple[Hypothesis, ...]:
        """Return the hypotheses that a reader needs beside the claim."""
        return tuple(h for h in self.hypotheses if h.shown)

    @property
    def domains(self) -> tuple[sp.Basic, ...]:
        """Return the domains, by the vocabulary, of the symbols that occur."""
        relations = (self.relation, *(h.relation for h in self.hypotheses))
        return tuple(sorted({known for r in relations for known in _domains(r)}, key=str))

    def named(self, name: str, remark: str = "") -> Judgement:
        """Return the same judgement under another name."""
        return Judgement(
            self.hypotheses, self.claim, self.rule, self.parents, name, remark or self.remark,
            _TOKEN,
        )  # fmt: skip


_MADE: WeakKeyDictionary[Judgement, tuple[object, ...]] = WeakKeyDictionary()
"""What each judgement held when a rule made it."""


@cache
def _domains(relation: sp.Basic) -> tuple[sp.Basic, ...]:
    """Return the domains of the quantities in a relation."""
    atoms = relation.atoms(sp.Symbol, sp.Function)
    domains = (domain(a) for a in atoms if not QUANTITIES.keys().isdisjoint((str(a), str(a.func))))
    return tuple(known for known in domains if known is not None)


def domain(atom: sp.Expr) -> Relational | None:
    """Return the domain of a quantity, None for all real numbers."""
    for holds, relation in ((atom.is_positive, sp.Gt), (atom.is_nonnegative, sp.Ge)):
        if holds:
            return relation(atom, 0, evaluate=False)
    return None


def infer(rule: Rule, *premises: Judgement, name: str = "", remark: str = "") -> Judgement:
    """Apply a rule to premises; RuleError if its theorem does not cover them."""
    hypotheses, claim = _apply(rule, premises)
    return Judgement(hypotheses, claim, rule, premises, name, remark, _TOKEN)


def _apply(rule: Rule, premises: tuple[Judgement, ...]) -> tuple[tuple[Hypothesis, ...], Claim]:
    """Return the hypotheses and the claim that a rule concludes from premises.

    They depend only on its fields and on the hypotheses and claims of the premises, so that each
    application is computed once; RuleError if a stored conclusion was changed.
    """
    kind = type(rule)
    if not kind.__module__.startswith(_RULES) or (
        getattr(sys.modules[kind.__module__], kind.__name__, None) is not kind
    ):
        raise RuleError(f"{kind.__name__} is no rule of {_RULES[:-1]}")
    if set(vars(rule)) != {field.name for field in fields(rule)}:  # type: ignore[arg-type]
        raise RuleError(f"{kind.__name__} has fields that are not its own")
    if not all(type(premise) is Judgement and premise.is_made for premise in premises):
        raise RuleError("missing premise: a judgement that a rule made")
    supposed = {h.relation for premise in premises for h in premise.hypotheses}
    if any(map(is_changed, supposed.union(premise.relation for premise in premises))):
        raise RuleError("missing premise: a judgement that was not changed")
    if len(premises) < len(rule.premise_names):
        raise RuleError(f"missing premise: {kind.__name__} rests on {listed(rule.premise_names)}")
    _require_language(*vars(rule).values())
    application = rule, tuple((premise.hypotheses, premise.claim) for premise in premises)
    known = _CONCLUSIONS.get(application)
    if known is None or _content(known[:2]) != known[2]:
        made = _conclude(rule, premises)
        if known is not None and _content(made) != known[2]:
            raise RuleError("a stored conclusion was changed")
        known = _CONCLUSIONS[application] = *made, _content(made)
    return known[:2]


_CONCLUSIONS: dict[Hashable, tuple[tuple[Hypothesis, ...], Claim, object]] = {}


def _content(node: object) -> object:
    """Return the parts of an object, down to the names and numbers of its leaves."""
    if isinstance(node, (Claim, Hypothesis)):
        return type(node), *map(_content, vars(node).values())
    parts = node if isinstance(node, tuple) else getattr(node, "args", ())
    if parts:
        return type(node), type(node).__name__, *map(_content, parts)
    return node, *(getattr(node, part, "") for part in ("name", "p", "q"))


def _conclude(rule: Rule, premises: tuple[Judgement, ...]) -> tuple[tuple[Hypothesis, ...], Claim]:
    kind = type(rule).__name__
    try:
        with time_limit(LIMIT_S, f"{kind}: {rule.words}"):
            made = rule.conclude(*premises)
    except (RuleError, TimeLimitError):
        raise
    except Exception as odd:
        raise RuleError(f"{kind} is about premises and choices of another form: {odd}") from odd
    union = (h for premise in premises for h in premise.hypotheses)
    kept = (h for h in union if h not in made.discharges)
    hypotheses = tuple(dict.fromkeys((*kept, *made.adds)))
    _require_language(made.claim.relation, *hypotheses)
    if not any({*hypotheses} <= {*premise.hypotheses} for premise in premises):
        _require_names(hypotheses)
        _require_model(hypotheses)
    return hypotheses, made.claim


def _require_names(hypotheses: tuple[Hypothesis, ...]) -> None:
    """Refuse a name with two definitions or a circular one, which may hide a condition."""
    rests = dict[str, frozenset[str]]()
    for relation in (h.relation for h in hypotheses if h.kind is Kind.DEFINITION):
        if not rests.keys().isdisjoint(defined_by(relation)):
            raise RuleError("two definitions of one name")
        rests |= dict.fromkeys(defined_by(relation), meant_by(relation))
    while rests:
        done = [name for name, on in rests.items() if on.isdisjoint(rests)]
        if not done:
            raise RuleError(f"{listed(rests)} is no new name: a circle of definitions")
        for name in done:
            del rests[name]


def _require_model(hypotheses: tuple[Hypothesis, ...]) -> None:
    """Refuse contradictory hypotheses: anything would follow from them.

    They hold at every time, the start included, and equal fields that wear have equal rates.
    Two equations of the model for one quantity are refused too, since readers do not see them:
    h(0) = h_0 of (6) contradicts (1) if the load does not begin at zero.
    """
    of_closure = [h for h in hypotheses if h.relation.has(CLOSURE[True].lhs.func)]
    if len(of_closure) > 1 and any(h.kind is Kind.INITIAL for h in of_closure):
        raise RuleError("h(0) = h_0, and more is said of h: two equations of the model")
    equalities = [h for h in hypotheses if isinstance(h.relation, sp.Equality)]
    given = [subject(h.relation) for h in equalities if h.kind is Kind.MODEL]
    if (
        len(set(given)) < len(given)
        or contradictory(_at_times(hypotheses))
        or contradictory(_at_last([h.relation for h in hypotheses]))
    ):
        raise RuleError("the hypotheses contradict each other")


def _at_times(hypotheses: tuple[Hypothesis, ...]) -> frozenset[sp.Basic]:
    """Return the hypotheses in contact, also at all times in them, at extremes, and for rates."""
    now = [h.relation for h in hypotheses]
    pressed = [sp.Gt(_PRESSURE, 0)] if any(relation.has(_PRESSURE) for relation in now) else []
    fields = frozenset[sp.Basic]().union(*(relation.atoms(AppliedUndef) for relation in now))
    times = frozenset(f.args[0] for f in fields if f.func.__name__ in QUANTITIES) | {sp.S.Zero}
    times = times.union(*map(_extremes, now)) - {t}
    implied = (said for relation in now for said in _implied(relation, times))
    return frozenset((*pressed, *now, *implied, sp.Gt(t, 0)))


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


def _require_language(*parts: object) -> None:
    """Refuse expressions outside the language, and two quantities of one name."""
    said = [h for h in parts if type(h) is Hypothesis and type(h.kind) is Kind]
    expressions = [part for part in parts if isinstance(part, sp.Basic)]
    if len(said) + len(expressions) < len(parts):
        raise RuleError("no claim: neither an expression nor a hypothesis")
    expressions += [hypothesis.relation for hypothesis in said]
    if found := next(filter(None, map(fault, expressions)), None):
        raise RuleError(f"no claim: {found}")
    bearers = frozenset().union(*map(names, expressions))
    if len({typeset_name(name) for name, _ in bearers}) < len(bearers):
        raise RuleError("no claim: two quantities have one name")


def replay_fault(judgement: Judgement) -> str | None:
    """Return why the rule does not give this judgement again from its parents, None if it does."""
    if type(judgement) is not Judgement or not judgement.is_made:
        return "no rule made it"
    try:
        _require_language(judgement.claim.relation, *judgement.hypotheses)
        made = _apply(judgement.rule, judgement.parents)
    except (ValueError, TypeError, AttributeError) as refusal:
        return str(refusal) or type(refusal).__name__
    shown = judgement.hypotheses, judgement.claim
    return None if _content(made) == _content(shown) else f"the rule gives {made[1].relation}"


StepKey = tuple[Rule, tuple[Hypothesis, ...], Claim, tuple[Hashable, ...], bool]


def step_key(step: Judgement) -> StepKey:
    """Return a key that equal steps share, if a rule made both or neither."""
    parents = tuple((parent.hypotheses, parent.claim) for parent in step.parents)
    return (step.rule, step.hypotheses, step.claim, parents, step.is_made)


def chain(*judgements: Judgement) -> tuple[Judgement, ...]:
    """Return the judgements and all that they rest on, each once, premises first.

    RuleError if a judgement rests on itself.
    """
    seen: dict[int, Judgement] = {}
    begun: set[int] = set()

    def visit(judgement: Judgement) -> None:
        if id(judgement) in seen:
            return
        if id(judgement) in begun:
            raise RuleError(f"{judgement.relation} rests on itself")
        begun.add(id(judgement))
        for parent in judgement.parents:
            visit(parent)
        seen[id(judgement)] = judgement

    for judgement in judgements:
        visit(judgement)
    return tuple(seen.values())
