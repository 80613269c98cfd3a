"""Results as functions of a parameter: their derivatives.

Key results
    DataDerivative   the derivative of a result with respect to a parameter
"""

from __future__ import annotations

from collections.abc import Collection, Set

import sympy as sp

from ..claims import Equality
from ..hypotheses import BOUNDED_LOAD, RIGID, SMOOTH_PIN, UNWORN_PIN, Kind
from ..kernel import Conclusion, Judgement, RuleError
from ..language import defined_by, names
from ..laws import r
from ..note.model import ARCHARD, CLOSURE, ROUGHNESS, START, SUPPORT
from ..parts import nonnegative
from ..reals import holds
from ..symbols import CLOCKS, DATA, symbols
from ..zero import is_zero
from .algebra import inserted
from .proving import continuity, is_contact_law, open_set, require_defined, smooth
from .reading import equality, functions
from .theorem import Theorem

PRESSURE, PRESSURE_MAX, h, sigma = symbols("p p_max h sigma")
_ONE_SOLID = frozenset(
    (*CLOSURE.values(), ROUGHNESS, *ARCHARD[2:], SUPPORT, START[1], START[4])
).union(setting.relation for setting in (UNWORN_PIN, SMOOTH_PIN, RIGID, BOUNDED_LOAD))
"""The model of a bearing that alone wears.  With a contact law at every closure it has fields for
all data: under no load the gap never falls below its first value, so that the rate is bounded,
and on springs one gap is in equilibrium at each instant, since the pressure falls with it."""
_ROUGHENING = ARCHARD[3]


def _require_free(parameter: sp.Symbol, expr: sp.Expr, *premises: Judgement) -> None:
    """Refuse an expression unless it has data alone, of which one may vary, the others fixed.

    Fields must exist for all values, so that all that hypotheses may say of given fields is the
    model of one wearing solid.
    """
    if functions(expr) or any(s.name not in DATA for s in expr.free_symbols):
        raise RuleError(f"missing premise: {expr} is a function of data alone")
    hypotheses = [hypothesis for premise in premises for hypothesis in premise.hypotheses]
    definitions = [h.relation for h in hypotheses if h.kind is Kind.DEFINITION]
    for hypothesis in hypotheses:
        relation, named = hypothesis.relation, hypothesis.kind is Kind.DEFINITION
        if functions(relation):
            fixed = not (named or relation in _ONE_SOLID or _is_law_at_every_closure(relation))
        else:
            about = parameter.name in _data_of(relation, definitions)
            fixed = about and not named and not _is_open(relation, definitions)
        if fixed:
            raise RuleError(f"missing premise: {parameter} may vary, but {hypothesis.text}")
    _require_roughness(frozenset(h.relation for h in hypotheses))


def _require_roughness(said: frozenset[sp.Basic]) -> None:
    """Refuse a roughness that may fall: for some data it would vanish, and no fields exist."""
    for wear in _ROUGHENING.rhs.atoms(sp.Derivative) if _ROUGHENING in said else ():
        rises = nonnegative(_ROUGHENING.rhs.diff(wear))
        if sp.Eq(wear.expr, 0) not in said and not holds(rises, said):
            raise RuleError(f"missing premise: {rises}")


def _data_of(relation: sp.Basic, definitions: Collection[sp.Basic]) -> Set[str]:
    """Return the data in a relation, directly or by defined names: all, if a name is of fields or
    has no value by its definition, since that may follow."""
    about = {name for name, _ in names(relation)}
    for _ in definitions:
        defining = (names(known) for known in definitions if about & defined_by(known))
        about = about.union(name for group in defining for name, _ in group)
    of_fields = any(functions(known) for known in definitions if about & defined_by(known))
    explicit = (known for known in definitions if known.args[0].is_Symbol)
    told = DATA.union(CLOCKS, *map(defined_by, explicit))
    return DATA if of_fields or not about <= told else about & DATA


def _is_open(relation: sp.Basic, definitions: Collection[sp.Basic]) -> bool:
    """Return whether a relation is between data alone and holds on an open set of them, with the
    names in it written out: parts of it that then cancel must have values there, too."""
    values = {known.lhs: known.rhs for known in definitions if isinstance(known, sp.Equality)}

    def told(expr: sp.Basic) -> sp.Basic:
        while (further := expr.xreplace(values)) != expr:
            expr = further
        return expr

    whole = told(relation)
    of_data = all(name in DATA for name, _ in names(whole))
    parts = (goal for side in relation.args for goal in continuity(side, side.free_symbols))
    return of_data and open_set(whole) and all(holds(told(g), frozenset([whole])) for g in parts)


def _is_law_at_every_closure(relation: sp.Basic) -> bool:
    """Return whether a relation is a contact law without a cutoff."""
    if not isinstance(relation, sp.Equality) or relation.lhs != PRESSURE:
        return False
    law = (relation.rhs / PRESSURE_MAX).subs(h, r * sigma)
    same = not relation.has(r) and relation.rhs == PRESSURE_MAX * law.subs(r, h / sigma)
    return same and law.free_symbols <= {r} and not functions(law) and is_contact_law(law)


class DataDerivative(Theorem):
    """``y = F(a, ...)`` gives ``dy/da``: F is a function of data, of which a varies alone.

    The claim has the derivative of y; further premises name constants of the claim.
    """

    claim: sp.Equality
    parameter: sp.Symbol
    words = "Differentiate {0} with respect to {parameter}[, with {others}]."
    premise_names = ("the result",)

    def prove(self, *premises: Judgement) -> Conclusion:
        result = equality(premises[0])
        if not result.lhs.is_Symbol or self.parameter.name not in DATA:
            raise RuleError(f"missing premise: {self.parameter} is one of the data")
        _require_free(self.parameter, result.rhs, *premises)
        slope = sp.diff(result.rhs, self.parameter)
        of_result = sp.Derivative(result.lhs, self.parameter, evaluate=False)
        require_defined(slope, *premises)
        left, right = (side.xreplace({of_result: slope}) for side in self.claim.args)
        if not smooth(result.rhs) or not is_zero(inserted(left - right, premises)):
            raise RuleError(f"missing premise: the derivative is {slope}")
        return Conclusion(Equality(*self.claim.args), gives=(of_result,))
