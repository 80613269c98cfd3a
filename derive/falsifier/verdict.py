"""The falsifier: models that satisfy the hypotheses of a judgement, and not its claim.

Overview
    Models are drawn; of each it is asked which hypotheses it violates, and whether the claim
    holds.  From that follow all answers: *false* (a model violates no hypothesis, and the
    claim), *vacuous* (no model satisfies all hypotheses), and for each hypothesis a model that
    violates it alone, and the claim: why it is there; or it is *superfluous* as far as models
    go.
Key results
    falsify(hypotheses, claim)    the answer, as data
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from dataclasses import dataclass

import sympy as sp
from flint import fmpq
from sympy.core.function import AppliedUndef

from ..claims import Drift, Term
from ..symbols import symbol, t
from .balls import fraction
from .draws import LAWS, WILD, drawn, slides_fast, slopes_over_data, with_law
from .expansion import Expanded
from .models import Model, quantities, reached
from .truth import truth

_ORDERS = (sp.Gt, sp.Ge, sp.Lt, sp.Le)
_T, _TAU = symbol("T"), symbol("tau")
_CLOCK = sp.Eq(t, _T * _TAU)
DRAWS = 60
"""Seeds tried for a judgement."""
ENOUGH = 12
"""Models in which a claim that holds in all of them is left alone."""


@dataclass(frozen=True)
class Counterexample:
    """A model in which a claim fails: what was drawn, as equations, and what is seen where."""

    model: tuple[sp.Eq, ...]
    where: str
    seed: int

    def __str__(self) -> str:
        drawn = ", ".join(f"{e.lhs} = {e.rhs}".replace("(t)", "") for e in self.model)
        return ": ".join(filter(None, (drawn, self.where)))


@dataclass(frozen=True)
class Answer:
    """What the models say of a judgement.

    ``models`` satisfied the hypotheses; ``decided`` of these gave the claim a truth value; of
    ``doubtful`` ones it is not known whether they satisfy the hypotheses.
    """

    counterexample: Counterexample | None
    models: int
    decided: int
    doubtful: int = 0

    @property
    def passed(self) -> bool:
        """Whether the claim held wherever it was decided."""
        return self.counterexample is None

    @property
    def vacuous(self) -> bool:
        """Whether every model violates a hypothesis."""
        return self.models == self.doubtful == 0

    def __str__(self) -> str:
        if self.counterexample is not None:
            return f"false for {self.counterexample}"
        if self.vacuous:
            return "vacuous as far as models go: all that are drawn violate the hypotheses"
        if not self.models:
            return "not tried: of no model it is known whether it satisfies the hypotheses"
        return f"holds in {self.decided} of {self.models} models of the hypotheses, fails in none"


def falsify(
    hypotheses: Iterable[sp.Basic],
    claim: sp.Basic,
    draws: int = DRAWS,
    enough: int = ENOUGH,
    dropped: sp.Basic | None = None,
) -> Answer:
    """Return whether some model satisfies the hypotheses and not the claim.

    Of ``dropped``, a hypothesis or the domain of a quantity, the models satisfy the contrary.
    """
    hypotheses = imposed = tuple(hypotheses)
    free = frozenset[sp.Expr]()
    if dropped is not None:
        hypotheses = imposed = tuple(h for h in hypotheses if h != dropped)
        free = quantities(dropped) if _is_domain(dropped) else free
        imposed = (*((dropped.negated,) if isinstance(dropped, _ORDERS) else ()), *hypotheses)
    absent = sp.false if dropped is None else dropped
    models = decided = doubtful = 0
    seeds = sorted(range(draws), key=lambda seed: dropped is not None and slides_fast(seed))
    for trial in _models((*hypotheses, absent, claim), imposed, seeds, free):
        *given, without, claimed = trial.relations
        fits = trial.fits(given, free)
        doubtful += fits is None
        if dropped is None and models - decided + doubtful > draws // 3:
            break  # others would leave as much open
        if not fits or truth(without, trial.model).holds is not False:
            continue
        models += 1
        outcome = truth(claimed, trial.model)
        if outcome.holds is False:
            if not trial.fits(given, free):  # now that the fields are known for longer
                continue
            named = without.args if isinstance(without, _ORDERS) else ()
            described = trial.described(given, sp.Tuple(without, claimed), named)
            return Answer(Counterexample(described, outcome.where, trial.seed), models, decided + 1)
        decided += outcome.holds is True
        if decided >= (enough if trial.model.states else 3 * enough):
            break
    return Answer(None, models, decided, doubtful)


@dataclass(frozen=True)
class _Trial:
    """A model, and the relations written for its contact law."""

    model: Model
    relations: tuple[sp.Basic, ...]
    seed: int

    def fits(self, given: Iterable[sp.Basic], free: frozenset[sp.Expr]) -> bool | None:
        """Return whether the model satisfies the hypotheses, and all quantities lie where their
        symbols say; asked once for several claims, while its fields are known for as long."""
        asked = tuple(given), free, frozenset(self._varied()), self.model.times
        known = self.model.satisfied
        if asked not in known:
            known[asked] = self._fits(given, free)
        return known[asked]

    def _fits(self, given: Iterable[sp.Basic], free: frozenset[sp.Expr]) -> bool | None:
        fixed = {h.lhs for h in given if isinstance(h, sp.Eq) and h.rhs.is_number}
        bounded = quantities(sp.Tuple(*self.relations)) - fixed.union(free)
        demands = sorted((*given, *map(domain, bounded)), key=self._rests_on_a_limit)
        asked = [(demand, self.model) for demand in demands]
        asked += [(demand, moved) for moved in self._moved() for demand in given]
        doubtful = False
        for demand, model in asked:
            found = truth(demand, model)
            if found.holds is False or found.where:
                return False
            doubtful |= found.holds is None
        return None if doubtful else True

    def _rests_on_a_limit(self, relation: sp.Basic) -> bool:
        """Return whether a relation costs more than others."""
        values = (self.model.values.get(q, q) for q in quantities(relation))
        return sp.Tuple(relation, *values).has(sp.Limit)

    def _varied(self) -> set[sp.Symbol]:
        """Return the data over which something is differentiated."""
        slopes = (slope for relation in self.relations for slope in slopes_over_data(relation))
        return {variable for slope in slopes for variable in slope.variables}

    def _moved(self) -> Iterator[Model]:
        """Return the models next to this one, where a claim has a derivative with respect to
        data: the hypotheses must hold there too."""
        for datum in self._varied():
            value = self.model.values.get(datum)
            if value is not None and value.is_Rational:
                yield self.model.with_datum(datum, fraction(value) + fmpq(1, 10**6))

    def described(
        self, given: Iterable[sp.Basic], said: sp.Basic, named: Iterable[sp.Basic]
    ) -> tuple[sp.Eq, ...]:
        """Return what was drawn of the quantities on which relations rest, but for
        what the hypotheses say themselves; those that are ``named`` in any case."""
        known = {
            h.lhs for h in given if isinstance(h, sp.Eq) and (h.rhs.is_number or h.rhs.is_Symbol)
        }
        starts = {f.func(t) for f in known if f.args == (sp.S.Zero,)}
        drawn = reached((said,), self.model.values) - known - starts
        ordered = sorted(drawn, key=lambda q: (bool(q.args), str(q)))
        equations = (self._drawn(quantity, quantity in named) for quantity in ordered)
        return tuple(equation for equation in equations if equation is not None)

    def _drawn(self, quantity: sp.Expr, named: bool) -> sp.Eq | None:
        """Return the value of what was drawn; None of what other quantities determine, unless it
        is ``named``."""
        if quantity in self.model.states:
            quantity = quantity.subs(t, 0)
        value = self.model.values.get(quantity)
        if named and value is not None:
            value = self.model.inlined(value)
        determined = (AppliedUndef, sp.Derivative, sp.Limit)
        if value is None or value.atoms(*determined) or not (quantity.args or value.is_Rational):
            return None
        return sp.Eq(quantity, value, evaluate=False)


def _models(
    relations: tuple[sp.Basic, ...],
    imposed: tuple[sp.Basic, ...],
    seeds: Iterable[int],
    free: frozenset[sp.Expr],
) -> Iterator[_Trial]:
    """Draw models that are made to satisfy what is imposed; the relations are given a value."""
    trends = sp.Tuple(*relations).has(sp.Limit)
    in_time, imposed_in_time = (_in_time(given, imposed) for given in (relations, imposed))
    for seed in seeds:
        if trends and seed % WILD == WILD - 1:  # what takes 1e30 periods has no trend in 1e8
            continue
        law = seed % len(LAWS)
        written = tuple(with_law(relation, law) for relation in in_time)
        given = tuple(with_law(h, law) for h in imposed_in_time)
        model = drawn(given, written, seed, free)
        if model is not None:
            yield _Trial(model, written, seed)


def _in_time(
    relations: tuple[sp.Basic, ...], imposed: tuple[sp.Basic, ...]
) -> tuple[sp.Basic, ...]:
    """Write relations without the names of what varies: N for t/T, say; what is said of scaled
    time holds on any clock, so on that of the period."""
    named = sp.Tuple(*relations).atoms(AppliedUndef, Term)
    if any(isinstance(name, Term) or name.args == (_TAU,) for name in named):
        relations = tuple(sp.true if r == _CLOCK else _unscaled(r) for r in relations)
    for said in imposed:
        if not isinstance(said, sp.Eq) or not isinstance(said.lhs, sp.Symbol):
            continue
        if t in said.rhs.free_symbols:
            written = (r.subs(said.lhs, said.rhs) if r != said else sp.true for r in relations)
            relations = tuple(written)
    return relations


def _unscaled(relation: sp.Basic) -> sp.Basic:
    """Write the fields of scaled time as fields of time, coefficients of expansions as such."""
    terms = {term: _expanded(term) for term in relation.atoms(Term)}
    hidden = {term: sp.Dummy() for term in terms}
    fields = {f: f.func(t) for f in relation.atoms(AppliedUndef) if f.args == (_TAU,)}
    rates = {f.diff(_TAU): _T * now.diff(t) for f, now in fields.items()}
    written = relation.xreplace(hidden).xreplace(rates).xreplace(fields).xreplace({_TAU: t / _T})
    return written.xreplace({dummy: terms[term] for term, dummy in hidden.items()})


def _expanded(term: Term) -> Expanded:
    n, *law = term.args
    order, phase = (sp.S.NegativeOne, sp.S.Zero) if isinstance(term, Drift) else (sp.S.Zero, t / _T)
    return Expanded(n, order, *law, phase)


def domain(quantity: sp.Expr) -> sp.Basic:
    """Return the domain of a quantity as its symbol says it."""
    if quantity.is_positive:
        return sp.Gt(quantity, 0, evaluate=False)
    return sp.Ge(quantity, 0, evaluate=False) if quantity.is_nonnegative else sp.true


def _is_domain(relation: sp.Basic) -> bool:
    return isinstance(relation, (sp.Gt, sp.Ge)) and relation == domain(relation.lhs)
