"""The search for models that satisfy the hypotheses of a judgement, and not its claim.

Overview
    Random models are drawn; each is tested for the hypotheses and for the claim.  A judgement is
    *false* if a model satisfies all hypotheses and not the claim, *vacuous* if no model satisfies
    all hypotheses.  A hypothesis is needed if a model violates it alone, and the claim; no such
    model proves it *superfluous*.
Key results
    try_on_models(judgement)                     a model that breaks it, or the number of trials
    counterexample_without(judgement, dropped)   a model that breaks it without one hypothesis
    falsify(hypotheses, claim)                   the same for relations
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass, replace
from functools import lru_cache

import sympy as sp
from flint import fmpq
from sympy.core.function import AppliedUndef
from sympy.core.relational import Relational

from ..claims import (
    Asymptotic,
    Claim,
    FirstZero,
    Predicate,
    Property,
    SlowEquation,
    Term,
    mapped,
)
from ..hypotheses import Hypothesis
from ..kernel import Judgement, domain
from ..language import without_time
from ..memory import cache
from ..symbols import CLOCKS, symbol, t
from .balls import fraction
from .draws import LAWS, WILD, draw_model, slides_fast, slopes_over_data, with_law
from .expansion import ExpansionTerm
from .models import Model, dependencies, quantities
from .values import truth

_ORDERS = (sp.Gt, sp.Ge, sp.Lt, sp.Le)
_T, _TAU, _CYCLES = symbol("T"), symbol("tau"), symbol("N")
DRAWS, _FEW, SEEDS = map(range, (60, 12, 1000))
"""Seeds for relations, for a judgement, for one without a hypothesis."""
ENOUGH = 12
"""Number of models after which relations that hold in all of them are accepted."""

Relations = tuple[sp.Basic, ...]


@dataclass(frozen=True)
class Counterexample:
    """A model in which a claim fails: its drawn values as equations, the failure, and the seed.

    ``left`` is, instead of the claim, the domain that a quantity leaves, so that the model has no
    value for it.
    """

    model: tuple[sp.Eq, ...]
    where: str
    seed: int
    left: sp.Basic | None = None

    def __str__(self) -> str:
        drawn = ", ".join(f"{e.lhs} = {e.rhs}" for e in self.model)
        left = f"{self.left} fails" if self.left is not None else ""
        return ": ".join(filter(None, (*map(without_time, (drawn, left)), self.where)))


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


def try_on_models(judgement: Judgement) -> TrialResult:
    """Return the result of trying a judgement on models; none is known of an averaged expansion."""
    if any(isinstance(hypothesis.relation, SlowEquation) for hypothesis in judgement.hypotheses):
        return TrialResult(None, models=0, decided=0, doubtful=1)
    found = _tried(_relations(judgement), _decidable(judgement.claim))
    return replace(found, decided=0) if isinstance(judgement.claim, Property) else found


@cache
def _tried(relations: Relations, claim: sp.Basic) -> TrialResult:
    return falsify(relations, claim, _FEW, enough=2)


def counterexample_without(
    judgement: Judgement, dropped: Hypothesis, seeds: Sequence[int] = SEEDS
) -> Counterexample | None:
    """Return a model of all other hypotheses that breaks the claim, None if none is found.

    If none is found, the model may be one in which a quantity that the others determine leaves its
    domain: the hypothesis then gives the claim a meaning.  None is no proof that the hypothesis is
    superfluous.
    """
    relations, claim = _relations(judgement), _decidable(judgement.claim)
    found = falsify(relations, claim, seeds, len(seeds), dropped.relation).counterexample
    left = (_leaving(stays, relations, dropped.relation, seeds) for stays in _domains(relations))
    return found or next(filter(None, left), None)


def is_open_without(judgement: Judgement, dropped: Hypothesis, seed: int) -> bool:
    """Return whether the model from a seed satisfies all other hypotheses without a verdict on the
    claim: a trend that is barely clear on one machine may not be so on one that rounds otherwise.
    """
    found = falsify(_relations(judgement), _decidable(judgement.claim), [seed], 1, dropped.relation)
    return found.passed and found.models > found.decided == 0


def _domains(relations: Relations) -> list[Relational]:
    """Return the domains of quantities whose value or rate is the left side of an equation."""
    sides = {h.lhs for h in relations if isinstance(h, sp.Eq) and not h.rhs.is_number}
    known = {side.expr if isinstance(side, sp.Derivative) else side for side in sides}
    found = (domain(q) for q in sorted(known, key=str) if q.is_Symbol or q.args == (t,))
    return [stays for stays in found if stays is not None]


def _leaving(
    stays: Relational, relations: Relations, dropped: sp.Basic, seeds: Sequence[int]
) -> Counterexample | None:
    """Return a model without a hypothesis in which a quantity leaves its domain."""
    values = {h.lhs: h.rhs for h in relations if isinstance(h, sp.Eq)}
    claim = stays.xreplace({stays.lhs: values.get(stays.lhs, stays.lhs)})
    *free, without, claimed = (_without_domain(r, stays.lhs) for r in (*relations, dropped, claim))
    found = falsify(free, claimed, seeds, len(seeds), without).counterexample
    return found and replace(found, left=stays)


def _relations(judgement: Judgement) -> Relations:
    """Return the hypotheses, and for an asymptotic claim in a field the limit of that field."""
    claim = judgement.claim
    given = (hypothesis.relation for hypothesis in judgement.hypotheses)
    relations = tuple(relation for relation in given if not isinstance(relation, Predicate))
    if not isinstance(claim, Asymptotic) or isinstance(claim.variable, sp.Symbol):
        return relations
    return *relations, sp.Eq(sp.Limit(claim.variable, t, sp.oo), claim.point, evaluate=False)


def _decidable(claim: Claim) -> sp.Basic:
    """Return a claim as a relation that models decide: an asymptotic one as a limit in time."""
    if not isinstance(claim, Asymptotic):
        return sp.true if isinstance(claim, Property) else claim.relation
    rest = (claim.lhs - claim.rhs) / claim.order
    variable, point = claim.variable, claim.point
    if variable != t and point == sp.oo:
        rest, variable = rest.subs(_CYCLES, t / _T), t
    elif not isinstance(variable, sp.Symbol):  # a field, which tends to the point
        variable, point = t, sp.oo
    return sp.Eq(sp.Limit(rest, variable, point), 0, evaluate=False)


def falsify(
    hypotheses: Iterable[sp.Basic],
    claim: sp.Basic,
    seeds: Sequence[int] = DRAWS,
    enough: int = ENOUGH,
    dropped: sp.Basic | None = None,
) -> TrialResult:
    """Search for a model that satisfies the hypotheses and not the claim.

    The models violate ``dropped``, a hypothesis or the domain of a quantity.
    """
    kept = (h for h in hypotheses if h != dropped)
    relations = (*kept, sp.false if dropped is None else dropped, claim)
    if isinstance(dropped, _ORDERS) and dropped == domain(dropped.lhs):
        relations = tuple(_without_domain(relation, dropped.lhs) for relation in relations)
    *others, absent, _ = relations
    imposed = (*((absent.negated,) if isinstance(absent, _ORDERS) else ()), *others)
    models = decided = doubtful = 0
    slow_first = sorted(seeds, key=lambda seed: dropped is not None and slides_fast(seed))
    for seed, model, wanted in _models(relations, imposed, slow_first):
        *given, without, claimed = wanted
        about = quantities(sp.Tuple(*wanted)), _varied(wanted)
        fits = _fits(model, tuple(given), *about, model.times)
        doubtful += fits is None
        if dropped is None and models - decided + doubtful > len(seeds) // 3:
            break  # further models would be as undecided
        if not fits or truth(without, model).holds is not False:
            continue
        models += 1
        outcome = truth(claimed, model)
        if outcome.holds is False:
            if not _fits(model, tuple(given), *about, model.times):
                models -= 1  # now that the fields are known for longer
                continue
            named = without.args if isinstance(without, _ORDERS) else ()
            drawn = _described(model, given, sp.Tuple(without, claimed), named)
            return TrialResult(Counterexample(drawn, outcome.where, seed), models, decided + 1)
        decided += outcome.holds is True
        if decided >= (enough if model.states else 3 * enough):
            break
    return TrialResult(None, models, decided, doubtful)


def _without_domain(relation: sp.Basic, quantity: sp.Expr) -> sp.Basic:
    """Write a quantity as one that may be any real number."""
    if not quantity.args:
        return relation.xreplace({quantity: sp.Symbol(quantity.name, real=True)})
    return relation.replace(quantity.func, sp.Function(quantity.func.__name__, real=True))


@lru_cache(maxsize=2000)
def _fits(
    model: Model,
    given: Relations,
    about: frozenset[sp.Expr],
    varied: frozenset[sp.Symbol],
    times: tuple[fmpq, ...],  # noqa: ARG001 - those of the model, a part of the key of the cache
) -> bool | None:
    """Return whether a model satisfies the hypotheses and the domains of quantities.

    It may be asked again for further claims, and when the fields are known at more times.
    """
    fixed = {h.lhs for h in given if isinstance(h, sp.Eq) and h.rhs.is_number}

    def rests_on_a_limit(relation: sp.Basic) -> bool:  # whose evaluation is expensive
        values = (model.values.get(q, q) for q in quantities(relation))
        return sp.Tuple(relation, *values).has(sp.Limit)

    domains = (d for d in map(domain, about - fixed) if d is not None)
    demands = sorted((*given, *domains), key=rests_on_a_limit)
    pairs = [(demand, model) for demand in demands]
    for datum in varied:  # the hypotheses hold nearby too, so that they may be differentiated
        value = model.values.get(datum)
        if value is not None and value.is_Rational:
            near = model.with_datum(datum, fraction(value) + fmpq(1, 10**6))
            pairs += [(demand, near) for demand in given]
    doubtful = False
    for demand, where in pairs:
        outcome = truth(demand, where)
        if outcome.holds is False or outcome.where:
            return False
        doubtful |= outcome.holds is None
    return None if doubtful else True


def _varied(relations: Relations) -> frozenset[sp.Symbol]:
    """Return the data by which relations have derivatives."""
    slopes = frozenset[sp.Expr]().union(*map(slopes_over_data, relations))
    return frozenset(variable for slope in slopes for variable in slope.variables)


def _described(
    model: Model, given: Iterable[sp.Basic], relations: sp.Basic, named: Iterable[sp.Basic]
) -> tuple[sp.Eq, ...]:
    """Return the drawn values of the quantities on which relations rest.

    Quantities whose values are hypotheses or follow from others are omitted; those in ``named``
    are always shown.
    """
    known = {h.lhs for h in given if isinstance(h, sp.Eq) and (h.rhs.is_number or h.rhs.is_Symbol)}
    starts = {f.func(t) for f in known if f.args == (sp.S.Zero,)} & model.states.keys()
    drawn = []
    rests_on = dependencies((relations,), model.values) - known - starts
    for quantity in sorted(rests_on, key=lambda q: (bool(q.args), str(q))):
        name = quantity.subs(t, 0) if quantity in model.states else quantity
        value = model.values.get(name)
        if name in named and value is not None:
            value = model.inlined(value)
        if value is None or value.has(AppliedUndef, sp.Derivative, sp.Limit, FirstZero):
            continue
        if name.args or value.is_Rational:
            drawn.append(sp.Eq(name, value, evaluate=False))
    return tuple(drawn)


def _models(
    relations: Relations, imposed: Relations, seeds: Iterable[int]
) -> Iterator[tuple[int, Model, Relations]]:
    """Yield seeds, models that are drawn to satisfy ``imposed``, and the relations with the contact
    law of each model."""
    trends = sp.Tuple(*relations).has(sp.Limit)
    in_time, imposed_in_time = (_in_time(given, imposed) for given in (relations, imposed))
    for seed in seeds:
        if trends and seed % WILD == WILD - 1:  # extreme data have no trend within 1e8 periods
            continue
        law = seed % len(LAWS)
        wanted = tuple(with_law(relation, law) for relation in in_time)
        given = tuple(with_law(h, law) for h in imposed_in_time)
        model = draw_model(given, wanted, seed)
        if model is not None:
            yield seed, model, wanted


def _in_time(relations: Relations, imposed: Relations) -> Relations:
    """Write relations as functions of time t, without other clocks such as N = t/T.

    A relation in scaled time holds for any unit of time, and so for the period.
    """
    named = sp.Tuple(*relations).atoms(AppliedUndef, Term)
    if any(isinstance(name, Term) or name.args == (_TAU,) for name in named):
        relations = tuple(map(_unscaled, relations))
    rest = imposed
    while (given := next(filter(_defines_clock, rest), None)) is not None:
        relations = tuple(_inserted(given, relation) for relation in relations)
        rest = tuple(_inserted(given, relation) for relation in rest if relation is not given)
        if given.lhs.name not in CLOCKS:  # a constant, and so is its value
            relations = (sp.Eq(given.rhs, given.rhs.subs(t, 0), evaluate=False), *relations)
    return relations


def _defines_clock(relation: sp.Basic) -> bool:
    return isinstance(relation, sp.Eq) and relation.lhs.is_Symbol and t in relation.rhs.free_symbols


def _inserted(given: sp.Eq, relation: sp.Basic) -> sp.Basic:
    return mapped(relation, lambda side: side.subs(given.lhs, given.rhs))


def _unscaled(relation: sp.Basic) -> sp.Basic:
    """Write fields and terms of expansions in scaled time as those of time."""
    terms = {term: ExpansionTerm(term, sp.S.Zero) for term in relation.atoms(Term)}
    fields = {f: f.func(t) for f in relation.atoms(AppliedUndef) if f.args == (_TAU,)}
    rates = {f.diff(_TAU): _T * now.diff(t) for f, now in fields.items()}
    parts = {**rates, **terms, **fields}
    return mapped(relation, lambda side: side.xreplace(parts).xreplace({_TAU: t / _T}))
