"""Results as functions of a parameter: their derivatives.

Key results
    DataDerivative   the derivative of a result with respect to a parameter
"""

from __future__ import annotations

from collections.abc import Collection, Set

import sympy as sp
from sympy.core.function import AppliedUndef

from ..claims import Equality
from ..hypotheses import LOAD, Kind
from ..kernel import Conclusion, Judgement, RuleError
from ..language import defined_by, names
from ..laws import r
from ..note.model import ARCHARD, subject
from ..parts import nonnegative, positive
from ..reals import holds
from ..symbols import CLOCKS, DATA, symbols
from ..zero import is_zero
from .algebra import inserted
from .proving import continuity, is_contact_law, open_set, require_defined, smooth, undefined
from .reading import equality, functions
from .theorem import Theorem

PRESSURE, PRESSURE_MAX, h, sigma = symbols("p p_max h sigma")
_SETTINGS = [sp.Eq(field, 0) for field in symbols("u_a sigma_a U_c")]
_ROUGHENING = frozenset(ARCHARD[1::2])
"""The laws by which the two roughnesses change with wear."""


def _require_free(parameter: sp.Symbol, expr: sp.Expr, *premises: Judgement) -> None:
    """Refuse an expression unless it has data alone, of which one may vary, the others fixed."""
    if functions(expr) or any(s.name not in DATA for s in expr.free_symbols):
        raise RuleError(f"missing premise: {expr} is a function of data alone")
    hypotheses = [hypothesis for premise in premises for hypothesis in premise.hypotheses]
    definitions = [h.relation for h in hypotheses if h.kind is Kind.DEFINITION]
    modelled = {subject(h.relation) for h in hypotheses if h.kind is Kind.MODEL}
    if len({r for r in (h.relation for h in hypotheses) if _is_pressure_law(r)}) > 1:
        raise RuleError(f"missing premise: {parameter} may vary, but there are two contact laws")
    for hypothesis in hypotheses:
        relation, kind = hypothesis.relation, hypothesis.kind
        if kind in (Kind.DEFINITION, Kind.INITIAL, Kind.MODEL) and relation.atoms(AppliedUndef):
            continue
        if functions(relation):
            fixed = not _leaves_data_free(relation) or subject(relation) in modelled
        else:
            about = parameter.name in _data_of(relation, definitions)
            fixed = about and kind is not Kind.DEFINITION and not _is_open(relation, definitions)
        if fixed:
            raise RuleError(f"missing premise: {parameter} may vary, but {hypothesis.text}")
    _require_roughness(frozenset(h.relation for h in hypotheses))


def _require_roughness(said: frozenset[sp.Basic]) -> None:
    """Refuse laws by which a roughness may fall: for some data it would vanish, and none exist."""
    for law in said & _ROUGHENING:
        for wear in law.rhs.atoms(sp.Derivative):
            rises = nonnegative(law.rhs.diff(wear))
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


def _leaves_data_free(relation: sp.Basic) -> bool:
    """Return whether fields that satisfy a relation exist for all data.

    So it is for a contact law, a bound of the load, and a setting, if it is all that determines
    its field.
    """
    if isinstance(relation, sp.LessThan):
        bounds = holds(positive(relation.rhs)) and not [*undefined(relation.rhs)]
        return relation.lhs == sp.Abs(LOAD) and bounds
    if not _is_pressure_law(relation):
        return relation in _SETTINGS
    law = (relation.rhs / PRESSURE_MAX).subs(h, r * sigma)
    same = not relation.has(r) and relation.rhs == PRESSURE_MAX * law.subs(r, h / sigma)
    return same and law.free_symbols <= {r} and not functions(law) and is_contact_law(law)


def _is_pressure_law(relation: sp.Basic) -> bool:
    return isinstance(relation, sp.Equality) and relation.lhs == PRESSURE


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
