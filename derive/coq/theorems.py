"""Steps that cite one general theorem of the library: the values for its parameters.

Overview
    The forms of the proofs are in ``library/theorems.jinja``, a macro for each rule; here SymPy
    finds the values that are inserted into them.
Key results
    proof       a proof, empty where no theorem is known for the step
    template    a template of proofs
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass
from functools import cache
from itertools import permutations
from typing import TYPE_CHECKING, Any

import sympy as sp
from sympy.core.function import AppliedUndef

from ..claims import Continuous
from ..rules.growth import expanded
from ..rules.limits import in_terms_of
from ..symbols import DATA, symbol, t
from .printer import always, proposition, quantity, term
from .steps import Step, stated

if TYPE_CHECKING:
    from jinja2 import Template

_LOAD = symbol("U_a")
_WEAR = symbol("u_c")
_RATIO = sp.Symbol("ratio", real=True)

Values = dict[str, Any]


def _follows(step: Step) -> Values:
    law = step.given[0].relation
    return {"pressure": law.lhs, "root": law.rhs.xreplace({_LOAD: _LOAD.subs(t, 0)})}


def _separates(step: Step) -> Values:
    along = _by_parts(step)
    rate, y = step.given[0], along["integral"].limits[0][2]
    along["speed"] = step.relation.lhs / t
    own = [s for s in step.ancestors if s.equates and s.relation.lhs == sp.Derivative(y, t)]
    if own:
        return along | {"rates": dict.fromkeys((own[0], step.given[0]))}
    factor = along["speed"] / rate.relation.rhs
    return along | {"rates": [rate], "inverse": _inverse(step, y) | {"factor": factor}}


def _inverse(step: Step, y: sp.Expr) -> Values:
    """Return the wear W(y), and its slope W' = -P/a with a positive P and the a that are not 0.

    A constant beside the data is eliminated by the wear, so that the sign of P is manifest.
    """
    wear = step.given[1]
    u, level = wear.relation.lhs, wear.relation.rhs.xreplace({_LOAD: _LOAD.subs(t, 0)})
    apart = sp.Mul(*(s.relation.lhs for s in step.given if isinstance(s.relation, sp.Ne)))
    (odds,) = level.atoms(sp.log)
    one, other = sp.fraction(odds.args[0])
    rise, flat = sp.Symbol("rise"), level.subs(odds, sp.Function("L")(y))
    back = {rise: one.diff(y) / one - other.diff(y) / other, sp.Function("L")(y): odds}
    slope = flat.diff(y).subs(sp.Function("L")(y).diff(y), rise)
    positive = -slope * apart.subs(odds, sp.Function("L")(y))
    for name in (s for s in flat.free_symbols if s.name not in DATA | {"t"}):
        positive = positive.subs(name, sp.solve(u - flat, name)[0])
    positive = sp.collect(sp.expand(sp.cancel(positive)), rise).xreplace(back)
    return {
        "wear": wear,
        "level": level,
        "slope": slope.xreplace(back),
        "apart": apart,
        "positive": positive,
        "loads": [h for h in step.hypotheses if h.relation.args[:1] == (_LOAD,)],
    }


def _by_parts(step: Step) -> Values:
    """Return an integral up to a field, its first value and the proof that it is continuous."""
    equation = step.relation if step.rule == "Separate" else step.given[0].relation
    (integral,) = equation.atoms(sp.Integral)
    _, start, y = integral.limits[0]
    first = [h for h in step.hypotheses if h.relation.args == (y.subs(t, 0), start)]
    continuity = [f for f in step.given if isinstance(f.relation, Continuous)]
    return {"integral": integral, "first": first, "continuity": continuity}


def _integrates(step: Step) -> Values:
    rate = step.given[0].relation.rhs
    (driving,) = rate.atoms(sp.Derivative)
    return {"driving": driving.expr, "factor": sp.cancel(rate / driving)}


def _diverges(step: Step) -> Values:
    grown, flat = step.given[0].relation.gts, sp.Symbol("flat")
    inside = step.relation.lhs.args[0].xreplace({grown: flat})
    return {"start": inside.subs(flat, 0), "slope": sp.diff(inside, flat)}


def _bounded(step: Step) -> Values:
    (parent,) = step.parents
    chosen = {p: "P" if isinstance(p.relation, sp.Gt) else "B" for p in parent.statement.premises}
    labels = [step.labels.get(p.proposition, label) for p, label in chosen.items()]
    (periodic,) = (f for f in step.hypotheses if f.equates and _LOAD in f.relation.args)
    return {"parent": parent, "labels": labels, "periodic": periodic.proof}


def _unbounded(step: Step) -> Values:
    u, rate = step.relation.lhs.args[0], step.given[0].relation.rhs
    bound = next(s for s in step.given if isinstance(getattr(s.relation, "lts", 0), sp.Abs))
    wear, load = symbol("u_s"), sp.Symbol("load", real=True)
    elsewhere = f" (with_wear (fun _ => {quantity(wear)}))"
    always = []
    for known in step.parents:
        if known.timed and not any(p.timed for p in known.statement.premises):
            proof = step.fact(known).proof.replace(known.name, known.name + elsewhere)
            always.append((known.relation, f"@{proof}"))
    flat = rate.xreplace({u: wear, bound.relation.lts.args[0]: load})
    above = (s for s in step.given if getattr(s.relation, "gts", None) == u)
    return {
        "wear": wear, "load": load, "rate": flat, "bound": bound, "always": always,
        "least": next(above, None),
    }  # fmt: skip


def _squeezed(step: Step) -> Values:
    inside, between = step.relation.lhs.args[0], step.given[0].relation
    return {"above": next(part.gts for part in between.args if part.lts == inside)}


@dataclass(frozen=True)
class _Affine:
    """An expression c0 + c1 L in a load, which is U_a, or U_a - U_c on a compliant support."""

    load: str
    c0: sp.Expr
    c1: sp.Expr

    @property
    def function(self) -> str:
        """Return the load as a function."""
        return "U_a" if self.load == "U_a t" else f"(fun t => {self.load})"

    def __str__(self) -> str:
        return f"({term(self.c0)} + ({term(self.c1)}) * ({self.load}))"


def _affine(expr: sp.Expr) -> _Affine | None:
    """Return an expression as a function that is affine in the load; None if it is not."""
    flat = sp.Symbol("load", real=True)
    for load, value in (("U_a t", flat), ("U_a t - U_c t", flat + symbol("U_c"))):
        inside = sp.expand(expr.xreplace({_LOAD: value}))
        slope = sp.diff(inside, flat)
        if not inside.has(t) and not slope.has(flat):
            return _Affine(load, inside.subs(flat, 0), slope)
    return None


def _at_infinity(step: Step) -> Values | None:
    """Return A and B of ``u A(1/u) + load B(1/u)``, or exponentials that vanish."""
    inside, u = step.relation.lhs.args[0], step.diverging.relation.lhs.args[0]
    z = sp.Dummy("z", positive=True)
    affine = _affine(inside.xreplace({u: 1 / z}))
    if affine is not None:
        (n, level), (m, slope) = expanded(affine.c0, z), expanded(affine.c1, z)
        return {"u": u, "affine": affine, "z": z, "A": z ** (1 - n) * level, "B": z**-m * slope}
    falling = sorted((e for e in inside.atoms(sp.exp) if e.has(u)), key=sp.default_sort_key)
    exponents = {e: sp.expand(e.args[0]) for e in falling}
    parts = {e: (-sp.diff(x, u), _affine(x.subs(u, 0))) for e, x in exponents.items()}
    return {"u": u, "parts": parts, "affine": next(iter(parts.values()))[1]}


def _first_order(step: Step) -> Values:
    law, deviation, ratio = step.given[:3]
    quantity, end = ratio.relation.lhs.args[0], ratio.relation.rhs
    function = in_terms_of(law.relation.rhs, quantity, _RATIO)
    affine = _affine(sp.expand(_WEAR * (quantity - end) - deviation.relation.lhs.args[0]))
    slope = sp.diff(function, _RATIO).subs(_RATIO, end).doit()
    return {"of_ratio": function, "slope": slope, "affine": affine}


def _drift(step: Step) -> Values:
    inside = step.given[0].relation.lhs.args[0]
    rate = next(d for d in inside.atoms(sp.Derivative) if d.has(AppliedUndef) and t in d.variables)
    now, load = sp.symbols("speed_now load", real=True)
    flat = inside.xreplace({rate: now, _LOAD: load})
    known = {part: f for f in step.hypotheses if f.equates for part in f.relation.args}
    return {
        "speed": sp.expand(now - sp.diff(flat, t)),
        "affine": _affine(-flat.subs(t, 0).xreplace({load: _LOAD})),
        "mean": known[symbol("U_mean")].proof,
        "periodic": known[_LOAD].proof,
    }


def _derivative(step: Step) -> Values:
    (slope,) = step.relation.atoms(sp.Derivative)
    used = {
        s.relation.lhs: s
        for s in (*step.given, *step.hypotheses)
        if s.equates and not s.timed
        if isinstance(s.relation.lhs, sp.Symbol) and step.judgement.relation.has(s.relation.lhs)
    }
    value = sp.diff(slope.expr, *slope.variables)
    return {"slope": slope, "value": value, "used": used.values()}


def _lipschitz(step: Step) -> Values:
    low, high = sorted(step.relation.atoms(sp.tanh), key=sp.count_ops)
    middle = next(part.gts for part in step.relation.args if part.lts == 0)
    factor = sp.diff(middle.xreplace({high: _RATIO}), _RATIO)
    left = sp.expand(high.args[0] - low.args[0]) - high + low
    forms = [factor * (high - low if part.lts == 0 else left) for part in step.relation.args]
    return {"low": low.args[0], "high": high.args[0], "forms": forms}


def _threshold(step: Step) -> Values | None:
    for reversed_, (bound, above) in enumerate(permutations(step.relation.args)):
        point, level = bound.gts, above.gts
        named = isinstance(bound, sp.Gt) and (point.is_Symbol or point.args == (t,))
        if named and level.has(point):
            positive = bool(point.is_positive) or any(f.relation == (point > 0) for f in step.given)
            return {"point": point, "level": level, "positive": positive, "reversed": reversed_}
    return None


_VALUES: Mapping[str, Callable[[Step], Values | None]] = {
    "AtInfinity": _at_infinity,
    "DataDerivative": _derivative,
    "Diverges": _diverges,
    "FirstOrder": _first_order,
    "Follows": _follows,
    "Integrate": _integrates,
    "ByParts": _by_parts,
    "Lipschitz": _lipschitz,
    "LogarithmicDrift": _drift,
    "PeriodicBound": _bounded,
    "Separate": _separates,
    "Threshold": _threshold,
    "Unbounded": _unbounded,
    "Vanishes": _squeezed,
}
"""The values that proofs need, by the name of the rule, or of the kind of claim."""


def proof(step: Step) -> str:
    """Return a proof by a general theorem, empty where there is none for the step."""
    rule = "Threshold" if isinstance(step.relation, sp.Equivalent) else step.rule
    macro = getattr(_macros(), rule, None)
    values = _VALUES[rule](step) if rule in _VALUES else {}
    return "" if macro is None or values is None else str(macro(step, **values))


@cache
def _macros() -> Any:
    return template("theorems").module


def template(name: str) -> Template:
    """Return a template of proofs; Jinja2 is imported when the first one is written."""
    from jinja2 import Environment, PackageLoader, StrictUndefined

    environment = Environment(
        loader=PackageLoader(__package__, "library"),
        trim_blocks=True,
        lstrip_blocks=True,
        keep_trailing_newline=True,
        undefined=StrictUndefined,
    )
    known = {each.__name__: each for each in (always, proposition, quantity, stated, term)}
    environment.filters |= known
    environment.globals |= known | {"t": t, "RATIO": _RATIO}
    return environment.get_template(f"{name}.jinja")
