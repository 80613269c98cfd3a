"""Hypotheses of judgements, and the words for some of them.

Overview
    A hypothesis is a relation; between fields it holds at every time.  Its words are looked up by
    that relation, in tables below and with the equations of the model, and contain only quantities
    of the vocabulary.  Any other hypothesis is shown as its formula, so that words never promise
    more than the relation.
Key results
    Hypothesis    a relation and its kind, in words, as plain text and in LaTeX
    sentences     hypotheses in sentences for readers
    SMOOTH_PIN, ..., CONTINUOUS      the settings that have a name
    ROUGHENING, ..., OPEN_GAP     other conditions that have words
"""

from __future__ import annotations

import re
from collections.abc import Iterable
from dataclasses import dataclass
from enum import StrEnum
from types import MappingProxyType

import sympy as sp

from .claims import Continuous, Term
from .language import defined_by, without_time
from .laws import GENERAL, TANH
from .note import model
from .symbols import rate, symbols, t

_MODULUS = re.compile(r"Abs\((\w+)\)")
#: Number of characters up to which a relation is easier to read than words.
_SHORT = 30


class Kind(StrEnum):
    """The closed list of kinds of hypotheses."""

    MODEL = "model"  # an equation of the note's model, (1) to (5)
    INITIAL = "initial"  # an initial value, (6)
    DEFINITION = "definition"  # a name for an expression
    CONDITION = "condition"  # shown beside the claim


def sentences(hypotheses: Iterable[Hypothesis]) -> list[str]:
    """Return hypotheses in sentences: settings in one line, each other one in its own."""
    shown = [h for h in hypotheses if h.shown]
    settings = dict.fromkeys(h.text for h in shown if h.is_setting)
    others = dict.fromkeys(f"if {h.stated}" for h in shown if not h.is_setting)
    return [*([f"setting: {', '.join(settings)}"] if settings else []), *others]


@dataclass(frozen=True)
class Hypothesis:
    """One hypothesis: a SymPy relation and its kind.

    >>> f_c = sp.Symbol("f_c")
    >>> SMOOTH_PIN.text, ROUGHENING.text, Hypothesis(f_c < 2).text
    ('smooth pin', 'wear of the bearing roughens it', 'f_c < 2')
    """

    relation: sp.Basic
    kind: Kind = Kind.CONDITION

    @property
    def shown(self) -> bool:
        """Return whether it is shown beside an equation: the note's model and definitions are
        not, another contact law or sign of (1) is."""
        other = self.relation in _SETTINGS or not self.words
        return self.kind is Kind.CONDITION or (self.kind is Kind.MODEL and other)

    @property
    def is_setting(self) -> bool:
        """Return whether it is a setting, which is shown by its name, not by its formula."""
        return self.shown and self.relation in _SETTINGS

    @property
    def words(self) -> str:
        """Return its words, empty if only its formula is shown."""
        if self.kind is Kind.DEFINITION:
            return _meaning(self.relation)
        return _SETTINGS.get(self.relation) or _OTHERS.get(self.relation, "")

    @property
    def text(self) -> str:
        """Return its words, or its formula as plain text if it has none."""
        return self.words or self._formula

    @property
    def stated(self) -> str:
        """Return it as one types it, after its words if it has some.

        >>> ROUGHENING.stated
        'wear of the bearing roughens it: f_c > 0'
        """
        return f"{self.words}: {self._formula}" if self.words else self._formula

    @property
    def brief(self) -> str:
        """Return its formula as plain text, or its words if it is a setting, an equation or long.

        >>> ROUGHENING.brief, BOUNDED_LOAD.brief, KEPT.brief
        ('f_c > 0', '|U_a| <= U', 'wear of the bearing does not change its roughness')
        """
        long = isinstance(self.relation, sp.Equality) or len(self._formula) > _SHORT
        return self.text if self.is_setting or long else self._formula

    @property
    def _formula(self) -> str:
        from .typeset.present import presentable

        relation = presentable(self.relation)
        parts = relation.args if isinstance(relation, sp.And) else (relation,)
        signs = {sp.Equality: "=", sp.Unequality: "!="}
        texts = (
            f" {signs[type(p)]} ".join(map(_typed, p.args)) if type(p) in signs else _typed(p)
            for p in parts
        )
        return ", ".join(_MODULUS.sub(r"|\1|", text) for text in texts)

    @property
    def latex(self) -> str:
        """Return it in LaTeX: a setting by its name, all others by their formulas."""
        from .typeset.display import inline
        from .typeset.present import presentable

        return rf"\text{{{self.words}}}" if self.is_setting else inline(presentable(self.relation))


def _typed(expr: sp.Basic) -> str:
    return without_time(sp.sstr(expr, order="none"))


def _meaning(relation: sp.Basic) -> str:
    """Return a definition in words: its names, and the expansion that they belong to."""
    names = " and ".join(sorted(defined_by(relation)))
    terms = "".join(f", in {term.words}" for term in relation.atoms(Term))
    return f"Definition of {names}{terms}"


h, U, U_a, U_c, u_a, sigma_a, sigma_c = symbols("h U U_a U_c u_a sigma_a sigma_c")
p, p_max, f_c, f_ac, f_ca, T = symbols("p p_max f_c f_ac f_ca T")
LOAD = U_a

SMOOTH_PIN, UNWORN_PIN, RIGID = (Hypothesis(sp.Eq(field, 0)) for field in (sigma_a, u_a, U_c))
UNCOUPLED = tuple(Hypothesis(sp.Eq(slope, 0)) for slope in (f_ac, f_ca))
PERIODIC = Hypothesis(sp.Eq(U_a.subs(t, t + T), U_a))
CONSTANT = Hypothesis(sp.Eq(U_a, U_a.subs(t, 0)))
DIFFERENTIABLE = Hypothesis(sp.Eq(rate("U_a"), rate("U_a"), evaluate=False))
CONTINUOUS = Hypothesis(Continuous(U_a))
SINE = Hypothesis(sp.Eq(U_a, U * sp.sin(2 * sp.pi * t / T)))

ROUGHENING, KEPT, SMOOTHING, NOT_SMOOTHING, SLOPED = (
    Hypothesis(relation(f_c, 0)) for relation in (sp.Gt, sp.Eq, sp.Lt, sp.Ge, sp.Ne)
)
BOUNDED_LOAD = Hypothesis(sp.Le(sp.Abs(U_a), U))
UNSATURATED = Hypothesis(sp.And(sp.Gt(p, 0), sp.Lt(p, p_max)))
OPEN_GAP = Hypothesis(sp.Ne(h, 0))
ANY_LAW = Hypothesis(sp.Lt(GENERAL.phi.diff(GENERAL.phi.args[0]), 0))
"""What is supposed of an unspecified contact law: it is positive and smooth, too."""

_ANY = "any positive, smooth, decreasing contact law phi"
_SETTINGS = MappingProxyType(
    {
        SMOOTH_PIN.relation: "smooth pin",
        UNWORN_PIN.relation: "unworn pin",
        RIGID.relation: "rigid support",
        model.CLOSURE[True]: "wear of the pin opens the gap",
        model.at_every_closure(TANH): "no loss of contact",
        ANY_LAW.relation: _ANY,
        model.at_every_closure(GENERAL): f"{_ANY} without loss of contact",
        UNCOUPLED[0].relation: "roughness of the pin unaffected by wear of the bearing",
        UNCOUPLED[1].relation: "roughness of the bearing unaffected by wear of the pin",
        PERIODIC.relation: "load of period T",
        CONSTANT.relation: "constant load",
        DIFFERENTIABLE.relation: "differentiable load",
        CONTINUOUS.relation: "continuous load",
    }
)
_OTHERS = MappingProxyType(
    {
        **model.WORDS,
        **dict.fromkeys(model.START, "initial condition, Eq. (6)"),
        ROUGHENING.relation: "wear of the bearing roughens it",
        KEPT.relation: "wear of the bearing does not change its roughness",
        SMOOTHING.relation: "wear of the bearing smooths it",
        NOT_SMOOTHING.relation: "wear of the bearing does not smooth it",
        SLOPED.relation: "wear of the bearing changes its roughness",
        BOUNDED_LOAD.relation: "the load is bounded by U",
        UNSATURATED.relation: "the pressure is between 0 and its largest value",
        OPEN_GAP.relation: "the mean surfaces do not coincide",
    }
)
