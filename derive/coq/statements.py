"""The statements of lemmas: one for every judgement, with its hypotheses as premises.

Overview
    The quantities of the vocabulary are the fields of one record, ``world``; a lemma is about
    any world.  Its premises are the hypotheses of the judgement and the domains of the symbols
    that occur; a premise about fields holds for every t >= 0.
Key results
    Statement     premises and conclusion of one lemma
    statement     of a judgement
    key           a hash of the statement, and of those that it rests on
    world         the record of all quantities in statements
"""

from __future__ import annotations

import hashlib
import re
from dataclasses import dataclass
from functools import cache

import sympy as sp
from sympy.core.function import AppliedUndef

from ..hypotheses import Hypothesis
from ..kernel import Judgement
from ..symbols import QUANTITIES, t
from . import printer

_LAW = (
    ("law_positive", "forall r, 0 < phi r"),
    ("law_decreasing", "forall r r', r < r' -> phi r' < phi r"),
    ("law_differentiable", "forall r, ex_derive phi r"),
)
"""The assumptions on an unspecified contact law."""


@dataclass(frozen=True)
class Premise:
    """One premise of a lemma: its name, its proposition, and the relation that this states."""

    label: str
    proposition: str
    relation: sp.Basic = sp.true

    @property
    def timed(self) -> bool:
        """Return whether it holds for every t >= 0."""
        return self.proposition.startswith("forall t, 0 <= t -> ")


@dataclass(frozen=True)
class Statement:
    """``premises -> conclusion``, in any world."""

    premises: tuple[Premise, ...]
    conclusion: str

    @property
    def text(self) -> str:
        """Return the proposition."""
        return " ->\n  ".join((*(f"({p.proposition})" for p in self.premises), self.conclusion))


@cache
def statement(judgement: Judgement) -> Statement:
    """Return the lemma of a judgement; UntranslatableError if Coq's library lacks its terms."""
    premises = [_premise(h) for h in judgement.hypotheses]
    relations = (judgement.relation, *(h.relation for h in judgement.hypotheses))
    free = frozenset().union(*(relation.free_symbols for relation in relations))
    domains = [relation for relation in judgement.domains if _of_quantity(relation.args[0])]
    premises += [_domain(r) for r in domains if r.args[0].args or r.args[0] in free]
    premises += _assumed(judgement)
    premises += _smooth(judgement)
    conclusion = printer.always(claim(judgement))
    if any(
        re.search(r"\bphi\b", text) for text in (conclusion, *(p.proposition for p in premises))
    ):
        premises += [Premise(label, said) for label, said in _LAW]
    return Statement(_numbered(premises), conclusion)


@cache
def key(judgement: Judgement) -> str:
    """Return the hash of a step: of its statement, its rule, and the steps that it cites.

    UntranslatableError if it cannot be stated.
    """
    cited = []
    for parent in judgement.parents:
        try:
            cited.append(key(parent))
        except printer.UntranslatableError:
            continue
    text = "\n".join((type(judgement.rule).__name__, statement(judgement).text, *cited))
    return hashlib.sha256(text.encode()).hexdigest()[:12]


@cache
def claim(judgement: Judgement) -> sp.Basic:
    """Return the claim, in which the derivative of a result is that of its function.

    The first premise gives this function.
    """
    relation = judgement.relation
    for slope in relation.atoms(sp.Derivative):
        if isinstance(slope.expr, sp.Symbol):
            if not judgement.parents:
                raise printer.UntranslatableError(f"{slope} of no function that is known")
            given = judgement.parents[0].relation.rhs
            function = sp.Derivative(given, *slope.variables, evaluate=False)
            relation = relation.func(
                *(a.xreplace({slope: function}) for a in relation.args), evaluate=False
            )
    return relation


@cache
def _premise(hypothesis: Hypothesis) -> Premise:
    relation = hypothesis.relation
    return Premise(_label(hypothesis.text), printer.always(relation), relation)


@cache
def _domain(relation: sp.Basic) -> Premise:
    atom = relation.args[0]
    label = f"domain_{printer.name(atom.func.__name__ if atom.args else str(atom))}"
    return Premise(label, printer.always(relation), relation)


def _assumed(judgement: Judgement) -> list[Premise]:
    """Return the signs of symbols outside the vocabulary, which a rule or an author introduced."""
    symbols = sorted(judgement.relation.free_symbols, key=str)
    others = [s for s in symbols if s.name not in QUANTITIES and not isinstance(s, sp.Dummy)]
    signs = ((s, sp.Gt if s.is_positive else sp.Ge) for s in others if s.is_nonnegative)
    return [_domain(relation(symbol, 0, evaluate=False)) for symbol, relation in signs]


def _smooth(judgement: Judgement) -> list[Premise]:
    """Return the premises that fields with rates are differentiable."""
    relations = (judgement.relation, *(h.relation for h in judgement.hypotheses))
    rates = {d for r in relations for d in r.atoms(sp.Derivative) if t in d.variables}
    fields = {printer.field(f) for d in rates for f in d.atoms(AppliedUndef)}
    form = "forall t, 0 <= t -> ex_derive {} t"
    return [Premise(f"smooth_{field}", form.format(field)) for field in sorted(fields)]


def _of_quantity(atom: sp.Expr) -> bool:
    """Return whether an atom is a datum, or a field at time t; time and initial values are not."""
    return atom != t and (not atom.args or atom.args == (t,))


def _label(text: str) -> str:
    words = re.sub(r"\W+", "_", text.encode("ascii", "ignore").decode()).strip("_").lower()
    return "for_" + words.removeprefix("the_")[:40].rstrip("_")


def _numbered(premises: list[Premise]) -> tuple[Premise, ...]:
    """Return the premises, each once, with distinct labels."""
    distinct: dict[str, Premise] = {}
    for premise in premises:
        distinct.setdefault(premise.proposition, premise)
    taken: dict[str, int] = {}
    result = []
    for premise in distinct.values():
        count = taken[premise.label] = taken.get(premise.label, 0) + 1
        label = premise.label if count == 1 else f"{premise.label}_{count}"
        result.append(Premise(label, premise.proposition, premise.relation))
    return tuple(result)


def world(relations: list[sp.Basic]) -> str:
    """Return the record of all quantities, with their types, and a world that differs in the wear.

    UntranslatableError if two of them would have one name.
    """
    printer.distinct(relations)
    fields = {"law": "> contact_law"}
    for relation in relations:
        bound = {v for e in relation.atoms(sp.Derivative, sp.Integral) for v in e.variables}
        for function in relation.atoms(AppliedUndef):
            fields[printer.field(function)] = " R -> R"
        for symbol in relation.atoms(sp.Symbol):
            if symbol not in bound and str(symbol) != "t" and not isinstance(symbol, sp.Dummy):
                fields.setdefault(printer.name(str(symbol)), " R")
    fields.pop("phi", None)
    rows = ";\n".join(f"  {name} :{kind}" for name, kind in sorted(fields.items()))
    same = "; ".join(f"{name} := {name}" for name in sorted(fields))
    another = f"Definition with_wear {{w : world}} (u_c : R -> R) : world := {{| {same} |}}.\n"
    return f"Class world := {{\n{rows}\n}}.\n{another}"
