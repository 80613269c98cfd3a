"""The kernel: judgements, and the one place where they are made.

Overview
    A judgement ``Gamma |- claim`` states: if the hypotheses Gamma hold at every time, so does the
    claim.  A field that has a rate is the integral of it, and the rate may jump, as the pressure
    does: a relation with rates, and what follows from one at an instant, holds at almost every
    time; limits leave out the other times.  The clocks tau and N are t/T.  Rules alone make
    judgements: a rule is a theorem that reads its premises; all rules are in ``derive.rules``.  The
    hypotheses of a conclusion are those of the premises, plus those that the rule adds, minus those
    that a theorem discharges.
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
from typing import ClassVar, dataclass_transform
from weakref import WeakKeyDictionary

import sympy as sp
from sympy.core.cache import clear_cache
from sympy.core.function import AppliedUndef
from sympy.core.relational import Relational

from .claims import Claim
from .consistency import inconsistency
from .hypotheses import ANY_LAW, Hypothesis, Kind
from .language import fault, in_time, names, typeset_name, without_time
from .laws import GENERAL
from .memory import cache, is_standard
from .symbols import QUANTITIES
from .time_limit import TimeLimitError, time_limit

_RULES = "derive.rules."
_TOKEN = object()
_PHI = GENERAL.phi.func
_OPTIONAL = re.compile(r"\[(.*?)\]")
LIMIT_S = 60.0
"""Limit of CPU time for a symbolic step, in seconds."""


def plain(expr: sp.Basic) -> str:
    """Return an expression as plain text."""
    return without_time(str(expr))


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
        _MADE[self] = self._held, self._written

    def __init_subclass__(cls) -> None:
        raise TypeError("only a rule makes a judgement")

    @property
    def _held(self) -> tuple[object, ...]:
        return self.hypotheses, self.claim, self.rule, self.parents

    @property
    def _written(self) -> object:
        return _content((self.hypotheses, self.claim, *vars(self.rule).values()))

    @property
    def is_made(self) -> bool:
        """Return whether a rule made it, and it still holds what it held then."""
        held, written = _MADE.get(self, ((), ()))
        same = len(held) == len(self._held) and all(map(operator.is_, held, self._held))
        return same and written == self._written

    @property
    def relation(self) -> sp.Basic:
        """Return the claim as a SymPy relation."""
        return self.claim.relation

    @property
    def conditions(self) -> tuple[Hypothesis, ...]:
        """Return the hypotheses that a reader needs beside the claim."""
        return tuple(h for h in self.hypotheses if h.shown)

    @property
    def signs(self) -> tuple[Hypothesis, ...]:
        """Return the signs of names that neither the vocabulary nor a definition has, and what is
        supposed of a contact law phi if no hypothesis says it."""
        named = {h.relation.args[0] for h in self.hypotheses if h.kind is Kind.DEFINITION}
        free = (each for each in self.domains if each.args[0] not in named)
        own = (each for each in free if {name for name, _ in names(each)} - QUANTITIES.keys())
        said = any(h.is_setting and h.relation.has(_PHI) for h in self.hypotheses)
        law = () if said or not any(r.has(_PHI) for r in self._relations) else (ANY_LAW,)
        return (*law, *map(Hypothesis, own))

    @property
    def domains(self) -> tuple[sp.Basic, ...]:
        """Return the domains of the names that occur, those of authors included."""
        return tuple(sorted({known for r in self._relations for known in _domains(r)}, key=str))

    @property
    def _relations(self) -> tuple[sp.Basic, ...]:
        return (self.relation, *(h.relation for h in self.hypotheses))

    def named(self, name: str, remark: str = "") -> Judgement:
        """Return the same judgement under another name."""
        if type(self) is not Judgement or not self.is_made:
            raise TypeError("only a rule makes a judgement")
        return Judgement(
            self.hypotheses, self.claim, self.rule, self.parents, name, remark or self.remark,
            _TOKEN,
        )  # fmt: skip


_MADE: WeakKeyDictionary[Judgement, tuple[tuple[object, ...], object]] = WeakKeyDictionary()
"""What each judgement held when a rule made it, and the content of that."""


@cache
def _domains(relation: sp.Basic) -> tuple[sp.Basic, ...]:
    """Return the domains of the free names in a relation, but the contact law."""
    fields = (f for f in relation.atoms(AppliedUndef) if f.func != _PHI)
    known = map(domain, (*relation.free_symbols, *fields))
    return tuple(each for each in known if each is not None)


def domain(atom: sp.Expr) -> Relational | None:
    """Return the domain of a name, None for all real numbers."""
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

    What follows from some premises follows from all with the same hypotheses and claims, so that
    each application is computed once, and again if what it gave was changed.
    """
    kind = type(rule)
    if not is_standard():
        raise RuleError("no claim is made while SymPy has other settings than the standard ones")
    if not kind.__module__.startswith(_RULES) or (
        getattr(sys.modules[kind.__module__], kind.__name__, None) is not kind
    ):
        raise RuleError(f"{kind.__name__} is no rule of {_RULES[:-1]}")
    if set(vars(rule)) != {field.name for field in fields(rule)}:  # type: ignore[arg-type]
        raise RuleError(f"{kind.__name__} has fields that are not its own")
    if not all(type(premise) is Judgement and premise.is_made for premise in premises):
        raise RuleError("missing premise: a judgement that a rule made, and nobody changed")
    if len(premises) < len(rule.premise_names):
        raise RuleError(f"missing premise: {kind.__name__} rests on {listed(rule.premise_names)}")
    application = rule, tuple((premise.hypotheses, premise.claim) for premise in premises)
    known = _CONCLUSIONS.get(application)
    if known is None:
        clear_cache()  # SymPy's, in which objects that it calls equal may have left results
    _require_language(*vars(rule).values())
    if known is None or _content(known[:2]) != known[2]:
        made = _conclude(rule, premises)
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
    _require_language_of(made.claim, hypotheses, premises)
    for premise in filter(_has_slope_over_data, premises):
        if any(h.kind is not Kind.DEFINITION for h in {*hypotheses} - {*premise.hypotheses}):
            raise RuleError(f"missing premise: {premise.relation} under further conditions")
    joined = not any({*hypotheses} <= {*premise.hypotheses} for premise in premises)
    if joined and (contradiction := inconsistency(hypotheses)):
        raise RuleError(contradiction)
    return hypotheses, made.claim


def _has_slope_over_data(premise: Judgement) -> bool:
    """Return whether a claim, or a name in it, has the derivative of a name by a datum.

    As the datum varies, the hypotheses hold on; under others the derivative may be another one.
    """
    said = premise.relation, *(h.relation for h in premise.hypotheses)
    return any(d.expr.is_Symbol for relation in said for d in relation.atoms(sp.Derivative))


def _require_language_of(
    claim: Claim, hypotheses: tuple[Hypothesis, ...], premises: tuple[Judgement, ...]
) -> None:
    """Refuse a conclusion outside the language; what premises suppose was in it when they were
    made."""
    known = frozenset(h for premise in premises for h in premise.hypotheses)
    new = (h for h in hypotheses if h not in known)
    _require_language(claim.relation, *new, known=[h.relation for h in hypotheses if h in known])


def _require_language(*parts: object, known: Iterable[sp.Basic] = ()) -> None:
    """Refuse expressions outside the language, and two quantities of one name; ``known``
    expressions are in it."""
    said = [h for h in parts if type(h) is Hypothesis and type(h.kind) is Kind]
    expressions = [part for part in parts if isinstance(part, sp.Basic)]
    if len(said) + len(expressions) < len(parts):
        raise RuleError("no claim: neither an expression nor a hypothesis")
    expressions += [hypothesis.relation for hypothesis in said]
    if found := next(filter(None, map(fault, expressions)), None):
        raise RuleError(f"no claim: {found}")
    expressions += known
    fields = frozenset[sp.Expr]().union(*map(in_time, expressions))
    if len({field.func for field in fields}) < len(fields):
        raise RuleError("no claim: a field of time is one of scaled time, too")
    bearers = frozenset().union(*map(names, expressions))
    if any(expr.has(sp.E) for expr in expressions):
        bearers |= {("E", sp.E)}  # it is printed like a name
    if len({typeset_name(name) for name, _ in bearers}) < len(bearers):
        raise RuleError("no claim: two quantities have one name")


def replay_fault(judgement: Judgement) -> str | None:
    """Return why the rule does not give this judgement again from its parents, None if it does."""
    if type(judgement) is not Judgement or not judgement.is_made:
        return "no rule made it"
    try:
        _require_language_of(judgement.claim, judgement.hypotheses, judgement.parents)
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
