"""The search for models that satisfy the hypotheses of a judgement, and not its claim.

Overview
    Random models are drawn; each is tested for the hypotheses and for the claim.  A judgement is
    *false* if a model satisfies all hypotheses and not the claim, *vacuous* if no model satisfies
    all hypotheses.  A hypothesis is needed if a model violates it alone, and the claim; no such
    model proves it *superfluous*.
Key results
    falsify(hypotheses, claim)    a counterexample, or the numbers of models
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from dataclasses import dataclass

import sympy as sp
from flint import fmpq
from sympy.core.function import AppliedUndef

from ..claims import Term
from ..symbols import symbol, t
from .balls import fraction
from .draws import LAWS, WILD, draw_model, slides_fast, slopes_over_data, with_law
from .expansion import ExpansionTerm
from .models import Model, dependencies, quantities
from .values import truth

_ORDERS = (sp.Gt, sp.Ge, sp.Lt, sp.Le)
_T, _TAU = symbol("T"), symbol("tau")
_CLOCK = sp.Eq(t, _T * _TAU)
DRAWS = 60
"""Number of seeds for a judgement."""
ENOUGH = 12
"""Number of models after which a claim that holds in all of them is accepted."""


@dataclass(frozen=True)
class Counterexample:
    """A model in which a claim fails: its drawn values as equations, and the failure."""

    model: tuple[sp.Eq, ...]
    where: str
    seed: int

    def __str__(self) -> str:
        drawn = ", ".join(f"{e.lhs} = {e.rhs}".replace("(t)", "") for e in self.model)
        return ": ".join(filter(None, (drawn, self.where)))


@dataclass(frozen=True)
class TrialResult:
    """The result of trying a judgement on models.

    ``models`` satisfied the hypotheses; ``decided`` of these gave the claim a truth value; for
    ``doubtful`` further ones the hypotheses are undecided.
    """

    counterexample: Counterexample | None
    models: int
    decided: int
    doubtful: int = 0

    @property
    def passed(self) -> bool:
        """Return whether the claim held wherever it was decided."""
        return self.counterexample is None

    @property
    def vacuous(self) -> bool:
        """Return whether every model violates a hypothesis."""
        return self.models == self.doubtful == 0

    def __str__(self) -> str:
        if self.counterexample is not None:
            return f"false for {self.counterexample}"
        if self.vacuous:
            return "possibly vacuous: every model that was drawn violates a hypothesis"
        if not self.models:
            return "not tried: no model is known to satisfy the hypotheses"
        return f"holds in {self.decided} of {self.models} models of the hypotheses, fails in none"


def falsify(
    hypotheses: Iterable[sp.Basic],
    claim: sp.Basic,
    draws: int = DRAWS,
    enough: int = ENOUGH,
    dropped: sp.Basic | None = None,
) -> TrialResult:
    """Search for a model that satisfies the hypotheses and not the claim.

    The models violate ``dropped``, a hypothesis or the domain of a quantity.
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
            break  # further models would be as undecided
        if not fits or truth(without, trial.model).holds is not False:
            continue
        models += 1
        outcome = truth(claimed, trial.model)
        if outcome.holds is False:
            if not trial.fits(given, free):  # now that the fields are known for longer
                continue
            named = without.args if isinstance(without, _ORDERS) else ()
            described = trial.described(given, sp.Tuple(without, claimed), named)
            found = Counterexample(described, outcome.where, trial.seed)
            return TrialResult(found, models, decided + 1)
        decided += outcome.holds is True
        if decided >= (enough if trial.model.states else 3 * enough):
            break
    return TrialResult(None, models, decided, doubtful)


@dataclass(frozen=True)
class _Trial:
    """A model, and the relations with its contact law."""

    model: Model
    relations: tuple[sp.Basic, ...]
    seed: int

    def fits(self, given: Iterable[sp.Basic], free: frozenset[sp.Expr]) -> bool | None:
        """Return whether the model satisfies the hypotheses and the domains of quantities.

        The result is kept for further claims, until the fields are known at more times.
        """
        key = tuple(given), free, frozenset(self._varied()), self.model.times
        return self._fits(given, free)

    def _fits(self, given: Iterable[sp.Basic], free: frozenset[sp.Expr]) -> bool | None:
        fixed = {h.lhs for h in given if isinstance(h, sp.Eq) and h.rhs.is_number}
        bounded = quantities(sp.Tuple(*self.relations)) - fixed.union(free)
        demands = sorted((*given, *map(domain, bounded)), key=self._rests_on_a_limit)
        pairs = [(demand, self.model) for demand in demands]
        pairs += [(demand, neighbour) for neighbour in self._neighbours() for demand in given]
        doubtful = False
        for demand, model in pairs:
            outcome = truth(demand, model)
            if outcome.holds is False or outcome.where:
                return False
            doubtful |= outcome.holds is None
        return None if doubtful else True

    def _rests_on_a_limit(self, relation: sp.Basic) -> bool:
        """Return whether a relation needs limits, whose evaluation is expensive."""
        values = (self.model.values.get(q, q) for q in quantities(relation))
        return sp.Tuple(relation, *values).has(sp.Limit)

    def _varied(self) -> set[sp.Symbol]:
        """Return the data by which the relations have derivatives."""
        slopes = (slope for relation in self.relations for slope in slopes_over_data(relation))
        return {variable for slope in slopes for variable in slope.variables}

    def _neighbours(self) -> Iterator[Model]:
        """Yield models with a datum slightly changed, for claims with derivatives by data.

        The hypotheses must hold there too.
        """
        for datum in self._varied():
            value = self.model.values.get(datum)
            if value is not None and value.is_Rational:
                yield self.model.with_datum(datum, fraction(value) + fmpq(1, 10**6))

    def described(
        self, given: Iterable[sp.Basic], relations: sp.Basic, named: Iterable[sp.Basic]
    ) -> tuple[sp.Eq, ...]:
        """Return the drawn values of the quantities on which relations rest.

        Quantities whose values are hypotheses are omitted; those in ``named`` are always shown.
        """
        known = {
            h.lhs for h in given if isinstance(h, sp.Eq) and (h.rhs.is_number or h.rhs.is_Symbol)
        }
        starts = {f.func(t) for f in known if f.args == (sp.S.Zero,)}
        drawn = dependencies((relations,), self.model.values) - known - starts
        ordered = sorted(drawn, key=lambda q: (bool(q.args), str(q)))
        equations = (self._drawn(quantity, quantity in named) for quantity in ordered)
        return tuple(equation for equation in equations if equation is not None)

    def _drawn(self, quantity: sp.Expr, named: bool) -> sp.Eq | None:
        """Return the value of a drawn quantity; None if others determine it, unless ``named``."""
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
    """Yield models that are drawn to satisfy ``imposed`` and have values for ``relations``."""
    trends = sp.Tuple(*relations).has(sp.Limit)
    in_time, imposed_in_time = (_in_time(given, imposed) for given in (relations, imposed))
    for seed in seeds:
        if trends and seed % WILD == WILD - 1:  # extreme data have no trend within 1e8 periods
            continue
        law = seed % len(LAWS)
        wanted = tuple(with_law(relation, law) for relation in in_time)
        given = tuple(with_law(h, law) for h in imposed_in_time)
        model = draw_model(given, wanted, seed, free)
        if model is not None:
            yield _Trial(model, wanted, seed)


def _in_time(
    relations: tuple[sp.Basic, ...], imposed: tuple[sp.Basic, ...]
) -> tuple[sp.Basic, ...]:
    """Write relations as functions of time t, without other clocks such as N = t/T.

    A relation in scaled time holds for any unit of time, and so for the period.
    """
    named = sp.Tuple(*relations).atoms(AppliedUndef, Term)
    if any(isinstance(name, Term) or name.args == (_TAU,) for name in named):
        relations = tuple(sp.true if r == _CLOCK else _unscaled(r) for r in relations)
    for given in imposed:
        if not isinstance(given, sp.Eq) or not isinstance(given.lhs, sp.Symbol):
            continue
        if t in given.rhs.free_symbols:
            rest = (r.subs(given.lhs, given.rhs) if r != given else sp.true for r in relations)
            relations = tuple(rest)
    return relations


def _unscaled(relation: sp.Basic) -> sp.Basic:
    """Write fields and terms of expansions in scaled time as those of time."""
    terms = {term: ExpansionTerm(term, sp.S.Zero) for term in relation.atoms(Term)}
    fields = {f: f.func(t) for f in relation.atoms(AppliedUndef) if f.args == (_TAU,)}
    rates = {f.diff(_TAU): _T * now.diff(t) for f, now in fields.items()}
    return relation.xreplace(rates).xreplace({**terms, **fields}).xreplace({_TAU: t / _T})


def domain(quantity: sp.Expr) -> sp.Basic:
    """Return the domain of a quantity, by the assumptions of its symbol."""
    if quantity.is_positive:
        return sp.Gt(quantity, 0, evaluate=False)
    return sp.Ge(quantity, 0, evaluate=False) if quantity.is_nonnegative else sp.true


def _is_domain(relation: sp.Basic) -> bool:
    return isinstance(relation, (sp.Gt, sp.Ge)) and relation == domain(relation.lhs)
