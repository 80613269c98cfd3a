"""The falsifier: models that satisfy the hypotheses of a judgement, and not its claim.

Overview
    Models are drawn; of each it is asked which hypotheses it violates, and whether the claim
    holds.  From that table follow all answers: *false* (a model violates no hypothesis, and the
    claim), *vacuous* (no model satisfies all hypotheses), and for each hypothesis a model that
    violates it alone, and the claim: why it is there; or it is *superfluous* as far as models
    go.
Key results
    falsify(hypotheses, claim)    the answer, as data
    needed(hypotheses, claim)     each hypothesis with the counterexample without it
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from dataclasses import dataclass

import sympy as sp
from flint import fmpq
from sympy.core.function import AppliedUndef

from ..symbols import t
from .balls import fraction
from .draws import WILD, drawn, with_law
from .models import Model
from .truth import truth, varies

_ORDERS = (sp.Gt, sp.Ge, sp.Lt, sp.Le)
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

    ``models`` satisfied the hypotheses; ``decided`` of these gave the claim a truth value.
    """

    counterexample: Counterexample | None
    models: int
    decided: int

    @property
    def passed(self) -> bool:
        """Whether the claim held wherever it was decided."""
        return self.counterexample is None

    @property
    def vacuous(self) -> bool:
        """Whether no model satisfies the hypotheses."""
        return self.models == 0

    def __str__(self) -> str:
        if self.counterexample is not None:
            return f"false for {self.counterexample}"
        if self.vacuous:
            return "vacuous as far as models go: none of those drawn satisfies the hypotheses"
        return f"holds in {self.decided} of {self.models} models of the hypotheses, fails in none"


def falsify(
    hypotheses: Iterable[sp.Basic], claim: sp.Basic, draws: int = DRAWS, enough: int = ENOUGH
) -> Answer:
    """Return whether some model satisfies the hypotheses and not the claim."""
    hypotheses = tuple(hypotheses)
    models = decided = 0
    for trial in _models((*hypotheses, claim), hypotheses, draws):
        *given, claimed = trial.relations
        if not trial.fits(given):
            continue
        models += 1
        outcome = truth(claimed, trial.model)
        if outcome.holds is False:
            if not trial.fits(given):  # now that the fields are known for longer
                continue
            found = Counterexample(trial.described(given, claimed), outcome.where, trial.seed)
            return Answer(found, models, decided + 1)
        decided += outcome.holds is True
        if decided >= (enough if trial.model.rates else 3 * enough):
            break
    return Answer(None, models, decided)


@dataclass(frozen=True)
class Needed:
    """A hypothesis, and a model of all others in which the claim fails; None if none is found."""

    hypothesis: sp.Basic
    counterexample: Counterexample | None


def needed(
    hypotheses: Iterable[sp.Basic],
    claim: sp.Basic,
    draws: int = DRAWS,
    chosen: Iterable[sp.Basic] = (),
) -> Iterator[Needed]:
    """Drop each hypothesis in turn (or those chosen), the domains of quantities too, and look for
    the model that shows why it is there."""
    hypotheses = tuple(hypotheses)
    for dropped in tuple(chosen) or hypotheses:
        rest = tuple(h for h in hypotheses if h != dropped)
        free = (
            frozenset(map(_name, _quantities((dropped,)))) if _is_domain(dropped) else frozenset()
        )
        found = None
        negated = (dropped.negated,) if isinstance(dropped, _ORDERS) else ()
        for trial in _models((*rest, dropped, claim), (*negated, *rest), draws, free):
            *given, without, claimed = trial.relations
            if not trial.fits(given, free) or truth(without, trial.model).holds is not False:
                continue
            outcome = truth(claimed, trial.model)
            if outcome.holds is False and trial.fits(given, free):
                found = Counterexample(
                    trial.described(given, claimed, without), outcome.where, trial.seed
                )
                break
        yield Needed(dropped, found)


@dataclass(frozen=True)
class _Trial:
    """A model, and the relations written for its contact law."""

    model: Model
    relations: tuple[sp.Basic, ...]
    seed: int

    def fits(self, given: Iterable[sp.Basic], free: frozenset[str] = frozenset()) -> bool:
        """Return whether the model satisfies the hypotheses, and all quantities lie where their
        symbols say."""
        fixed = {_name(h.lhs) for h in given if isinstance(h, sp.Eq) and h.rhs.is_number}
        domains = (domain(q) for q in _quantities(self.relations) if _name(q) not in free | fixed)
        demands = (*given, *(d for d in domains if d is not None))
        return all(_holds(demand, self.model) for demand in demands) and all(
            _holds(demand, moved) for moved in self._moved() for demand in given
        )

    def _moved(self) -> Iterator[Model]:
        """Return the models next to this one, where a claim has a derivative with respect to
        data: the hypotheses must hold there too."""
        slopes = sp.Tuple(*self.relations).atoms(sp.Derivative)
        for datum in {v for slope in slopes for v in slope.variables if v != t}:
            value = self.model.data.get(datum)
            if value is not None and value.is_Rational:
                yield self.model.with_datum(datum, fraction(value) + fmpq(1, 10**6))

    def described(self, given: Iterable[sp.Basic], *relations: sp.Basic) -> tuple[sp.Eq, ...]:
        """Return what was drawn of the quantities on which relations rest, but for
        what the hypotheses say themselves."""
        equations = (h for h in given if isinstance(h, sp.Eq))
        said = {e.lhs for e in equations if e.rhs.is_number or e.rhs.is_Symbol}
        known = {**self.model.fields, **self.model.rates, **self.model.loops}
        waiting, seen = list(_quantities(relations)), set[sp.Expr]()
        while waiting:
            quantity = waiting.pop()
            seen.add(quantity)
            value = known.get(_name(quantity), self.model.data.get(quantity, sp.S.Zero))
            waiting += _quantities((value,)) - seen
        starts = {f.func(t) for f in said if f.args == (sp.S.Zero,)}
        ordered = sorted(seen - said - starts, key=lambda q: (bool(q.args), str(q)))
        drawn = map(self._drawn, ordered)
        return tuple(equation for equation in drawn if equation is not None)

    def _drawn(self, quantity: sp.Expr) -> sp.Eq | None:
        """Return the value of what was drawn; None of what other quantities determine."""
        model, name = self.model, _name(quantity)
        if name in model.start and quantity.args:
            return sp.Eq(quantity.func(0), model.start[name], evaluate=False)
        value = model.fields.get(name, model.data.get(quantity))
        determined = (AppliedUndef, sp.Derivative, sp.Limit)
        if value is None or value.atoms(*determined) or not (quantity.args or value.is_Rational):
            return None
        return sp.Eq(quantity, value, evaluate=False)


def _models(
    relations: tuple[sp.Basic, ...],
    imposed: tuple[sp.Basic, ...],
    draws: int,
    free: frozenset[str] = frozenset(),
) -> Iterator[_Trial]:
    """Draw models that are made to satisfy what is imposed; the relations are given a value."""
    trends = sp.Tuple(*relations).has(sp.Limit)
    for seed in range(draws):
        if trends and seed % WILD == WILD - 1:  # what takes 1e30 periods has no trend in 1e8
            continue
        written = tuple(with_law(relation, seed) for relation in _in_time(relations, imposed))
        given = tuple(with_law(h, seed) for h in _in_time(imposed, imposed))
        model = drawn(given, written, seed, free)
        if model is not None:
            yield _Trial(model, written, seed)


def _in_time(
    relations: tuple[sp.Basic, ...], imposed: tuple[sp.Basic, ...]
) -> tuple[sp.Basic, ...]:
    """Write relations without the names of what varies: N for t/T, say."""
    for named in imposed:
        if isinstance(named, sp.Eq) and isinstance(named.lhs, sp.Symbol) and varies(named.rhs, t):
            written = (r.subs(named.lhs, named.rhs) if r != named else sp.true for r in relations)
            relations = tuple(written)
    return relations


def _holds(relation: sp.Basic, model: Model) -> bool:
    return truth(relation, model).holds is True


def _quantities(relations: Iterable[sp.Basic]) -> set[sp.Expr]:
    everything = sp.Tuple(*relations)
    fields = {f.func(t) for f in everything.atoms(AppliedUndef)}
    return fields | {s for s in everything.free_symbols if s != t}


def _name(quantity: sp.Expr) -> str:
    return quantity.func.__name__ if isinstance(quantity, AppliedUndef) else str(quantity)


def domain(quantity: sp.Expr) -> sp.Basic | None:
    """Return the domain of a quantity as its symbol says it."""
    if quantity.is_positive:
        return sp.Gt(quantity, 0, evaluate=False)
    return sp.Ge(quantity, 0, evaluate=False) if quantity.is_nonnegative else None


def _is_domain(relation: sp.Basic) -> bool:
    return isinstance(relation, (sp.Gt, sp.Ge)) and relation == domain(relation.lhs)
