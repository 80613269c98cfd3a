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
from collections import Counter
from collections.abc import Iterable
from dataclasses import dataclass, replace
from functools import cache
from operator import methodcaller

import sympy as sp
from sympy.core.function import AppliedUndef

from ..hypotheses import Kind
from ..kernel import Judgement, domain
from ..rules.data import DataDerivative
from ..symbols import CLOCKS, t
from . import printer


@dataclass(frozen=True)
class Fact:
    """A proposition and the Coq term that proves it; the relation that it states, or none.

    A premise of a lemma is proved by its name.
    """

    proof: str
    proposition: str
    relation: sp.Basic = sp.true

    @property
    def timed(self) -> bool:
        """Return whether it holds for every t >= 0."""
        return printer.timed(self.proposition)

    @property
    def equates(self) -> bool:
        """Return whether it is an equation that contains no limit."""
        return isinstance(self.relation, sp.Equality) and not self.relation.has(sp.Limit)

    def at(self, time: str = "t", instant: str = "Ht") -> str:
        """Return the proof at a time; ``instant`` proves that it is no time before 0."""
        return f"{self.proof} {time} {instant}" if self.timed else self.proof


_LAW = (
    Fact("law_positive", "forall r, 0 < phi r"),
    Fact("law_decreasing", "forall r r', r < r' -> phi r' < phi r"),
    Fact("law_differentiable", "forall r, ex_derive phi r"),
    Fact("law_slope", "forall r, Derive phi r < 0"),
)
"""The assumptions on an unspecified contact law."""


@dataclass(frozen=True)
class Statement:
    """``premises -> conclusion``, in any world."""

    premises: tuple[Fact, ...]
    conclusion: str

    @property
    def text(self) -> str:
        """Return the proposition."""
        return " ->\n  ".join((*(f"({p.proposition})" for p in self.premises), self.conclusion))


@cache
def statement(judgement: Judgement) -> Statement:
    """Return the lemma of a judgement; UntranslatableError if Coq's library lacks its terms."""
    of_time, said = _clocks(judgement), claim(judgement)
    supposed = {h.relation.xreplace(of_time): f"for_{_words(h.text)}" for h in judgement.hypotheses}
    free = said.free_symbols.union(*(relation.free_symbols for relation in supposed))
    supposed.pop(sp.true, None)
    for atom in (known.args[0] for known in judgement.domains):
        if atom.args or atom in free - {t}:
            always = domain(atom.func(t) if atom.args else atom)
            supposed.setdefault(always, f"domain_{printer.quantity(atom)}")
    premises = [Fact(label, printer.always(r), r) for r, label in supposed.items()]
    rates = {d for r in (said, *supposed) for d in r.atoms(sp.Derivative) if t in d.variables}
    for field in sorted({printer.quantity(f) for d in rates for f in d.atoms(AppliedUndef)}):
        premises.append(Fact(f"smooth_{field}", f"forall t, 0 <= t -> ex_derive {field} t"))
    stated = Statement(_distinct(premises), printer.always(said))
    law = _LAW if re.search(r"\bphi\b", stated.text) else ()
    return replace(stated, premises=(*stated.premises, *law))


def _clocks(judgement: Judgement) -> dict[sp.Basic, sp.Expr]:
    """Return what the names of clocks mean in time, like N = t/T: no constants of a world."""
    meanings = (h.relation.args for h in judgement.hypotheses if h.kind is Kind.DEFINITION)
    return {name: now for name, now in meanings if str(name) in CLOCKS - {t.name}}


def _words(text: str) -> str:
    """Return a hypothesis in words as part of a name."""
    words = re.sub(r"\W+", "_", text.encode("ascii", "ignore").decode()).strip("_").lower()
    return words.removeprefix("the_")[:40].rstrip("_")


def _distinct(premises: Iterable[Fact]) -> tuple[Fact, ...]:
    """Return the premises, each once, with distinct names."""
    taken: Counter[str] = Counter()
    distinct: dict[str, Fact] = {}
    for premise in premises:
        if premise.proposition not in distinct:
            taken[premise.proof] += 1
            number = f"_{count}" if (count := taken[premise.proof]) > 1 else ""
            distinct[premise.proposition] = replace(premise, proof=premise.proof + number)
    return tuple(distinct.values())


@cache
def obstacle(judgement: Judgement) -> str:
    """Return why a step cannot be stated, empty if it can."""
    try:
        statement(judgement)
    except printer.UntranslatableError as reason:
        return str(reason)
    return ""


@cache
def key(judgement: Judgement) -> str:
    """Return the hash of a step: of its statement, its rule, and the steps that it cites.

    It is empty if the step cannot be stated.
    """
    if obstacle(judgement):
        return ""
    cited = filter(None, map(key, judgement.parents))
    text = "\n".join((type(judgement.rule).__name__, statement(judgement).text, *cited))
    return hashlib.sha256(text.encode()).hexdigest()[:12]


@cache
def claim(judgement: Judgement) -> sp.Basic:
    """Return the claim in terms of time; where a rule derives a result, its derivative is that of
    its function."""
    slopes = [d for d in judgement.relation.atoms(sp.Derivative) if isinstance(d.expr, sp.Symbol)]
    if not slopes:
        return judgement.relation.xreplace(_clocks(judgement))
    results = judgement.parents[:1] if isinstance(judgement.rule, DataDerivative) else ()
    known = {result.relation.lhs: result.relation.rhs for result in results}
    if not all(slope.expr in known for slope in slopes):
        raise printer.UntranslatableError(f"{slopes[0]} of no function that is known")
    functions = {d: sp.Derivative(known[d.expr], *d.variables, evaluate=False) for d in slopes}
    return judgement.claim.map(methodcaller("xreplace", functions)).relation


def world(relations: Iterable[sp.Basic]) -> str:
    """Return the record of all quantities, with their types, and worlds that differ in the bound
    of the load.

    UntranslatableError if two of them would have one name.
    """
    meanings: dict[str, sp.Basic | type] = {}
    fields = {"law": "> contact_law"}
    for relation in relations:
        bound = {v for e in relation.atoms(sp.Derivative, sp.Integral) for v in e.variables}
        for atom in relation.atoms(sp.Symbol, AppliedUndef) - {t}:
            name, meant = printer.quantity(atom), atom.func if atom.args else atom
            if meanings.setdefault(name, meant) != meant:
                both = f"{meanings[name]} and {meant}"
                raise printer.UntranslatableError(f"{both} would both be {name}")
            if atom not in bound and not isinstance(atom, sp.Dummy):
                fields[name] = " R -> R" if atom.args else " R"
    fields.pop("phi", None)
    rows = ";\n".join(f"  {name} :{kind}" for name, kind in sorted(fields.items()))
    same = "; ".join(f"{name} := {name}" for name in sorted(fields))
    other = f"Definition with_bound {{w : world}} (U : R) : world := {{| {same} |}}."
    return f"Class world := {{\n{rows}\n}}.\n{other}\n"
