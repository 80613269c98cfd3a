"""Steps that cite one general theorem of the library: what is inserted into it.

Key results
    proof    the lines of a proof, none where no theorem is known for the step
"""

from __future__ import annotations

from collections.abc import Iterator

import sympy as sp
from sympy.core.function import AppliedUndef

from ..symbols import symbol, t
from .limits import in_terms_of
from .printer import binder, field, term
from .steps import Step

_LOAD = symbol("U_a")
_WEAR = symbol("u_c")


def proof(step: Step) -> list[str]:
    """Return the lines of a proof by a general theorem."""
    for way in (_later, _discharges, _grows, _integrates, _bounded_load, _first_order, _drift, _derivative):
        if lines := list(way(step)):
            return lines
    return []


def _discharges(step: Step) -> Iterator[str]:
    """A hypothesis of the first parent that the others imply."""
    from .proofs import inequality

    if step.rule != "Discharge":
        return
    (first, premises), *_ = step.missing
    for premise in premises:
        ways = " | ".join(f"solve [{way}]" for way in inequality(step, premise.relation))
        fixed = "intros t Ht; " if premise.timed else ""
        yield f"assert ({premise.label}_met : {premise.said}) by ({fixed}first [{ways}])."
    labels = step.labels | {p.said: f"{p.label}_met" for p in premises}
    yield (
        "exact ("
        + " ".join((first.name, *(labels[p.said] for p in first.statement.premises)))
        + ")."
    )


def _later(step: Step) -> Iterator[str]:
    """What holds at every time, one period later."""
    if step.rule == "OnePeriodLater":
        yield "intros t Ht; assert (HT : 0 <= T + t) by lra."
        yield f"pose proof ({step.cited(step.frontier[0])} (T + t) HT) as P0."
        yield "first [exact P0 | rewrite ?derive_later; exact P0]."


def _grows(step: Step) -> Iterator[str]:
    """A rate of at least c, from 0: u >= c t."""
    relation = step.relation
    if not isinstance(relation, (sp.Ge, sp.Le)) or not _atom(relation.gts):
        return
    for other in step.frontier:
        bound = other.relation
        if isinstance(bound, (sp.Ge, sp.Le)) and bound.gts == sp.Derivative(relation.gts, t):
            name = field(relation.gts)
            start = next(s for s in step.frontier if s.relation.lhs == relation.gts.subs(t, 0))
            yield f"intros t Ht; pose proof (grows {name} _ smooth_{name} ({step.cited(other)}) t Ht) as P0."
            yield f"rewrite ({step.cited(start)}) in P0; same_inequality P0."


def _atom(expr: sp.Expr) -> bool:
    return isinstance(expr, AppliedUndef)


def _integrates(step: Step) -> Iterator[str]:
    """y' = c x' with constant c: y = y(0) + c (x - x(0))."""
    relation = step.relation
    if not isinstance(relation, sp.Equality):
        return
    for other in step.frontier:
        rate = other.relation
        if (
            isinstance(rate, sp.Equality)
            and _atom(relation.lhs)
            and rate.lhs == sp.Derivative(relation.lhs, t)
        ):
            driving = list(rate.rhs.atoms(sp.Derivative))
            factor = sp.cancel(rate.rhs / driving[0]) if len(driving) == 1 else t
            if factor.has(t):
                return
            y, x = field(relation.lhs), field(driving[0].expr)
            values = [step.cited(s) for s in step.frontier if not s.timed]
            yield "intros t Ht."
            yield f"rewrite (integrates {y} {x} ({term(factor)}) smooth_{y} smooth_{x}); [| | exact Ht]."
            yield "- " + "; ".join((*(f"rewrite ?({v})" for v in values), "identity."))
            yield f"- intros s Hs; rewrite ({step.cited(other)} s Hs); identity."


def _affine(expr: sp.Expr) -> tuple[str, str, sp.Expr] | None:
    """Return c0, c1 of an expression c0 + c1 U_a; None where it is none."""
    flat = sp.Symbol("load", real=True)
    inside = sp.expand(expr.xreplace({_LOAD: flat}))
    slope = sp.diff(inside, flat)
    if inside.has(t) or slope.has(flat):
        return None
    return term(inside.subs(flat, 0)), term(slope), inside


def _bounded(step: Step) -> str:
    """Return the label of the premise that bounds the load."""
    found = (
        p
        for p in step.statement.premises
        if isinstance(p.relation, sp.Le) and p.relation.lhs == sp.Abs(_LOAD)
    )
    premise = next(found, None)
    return premise.label if premise else ""


def _bounded_load(step: Step) -> Iterator[str]:
    """What tends to 0 because only a bounded load stands over a roughness that diverges."""
    if step.rule != "AtInfinity" or step.relation.rhs != 0 or not _bounded(step):
        return
    inside = sp.together(step.relation.lhs.args[0])
    size = next(
        (
            d
            for d in sorted(step.relation.lhs.args[0].atoms(sp.Add), key=sp.default_sort_key)
            if sp.denom(inside).has(_WEAR)
            and sp.diff(d, _WEAR).is_Symbol
            and (1 / d) in step.relation.lhs.args[0].atoms(sp.Pow)
        ),
        None,
    )
    parts = _affine(sp.cancel(inside * size)) if size is not None else None
    if size is None or parts is None:
        return
    slope, start = sp.diff(size, _WEAR), size.subs(_WEAR, 0)
    diverges = next(s for s in step.limits if s.relation.rhs == sp.oo)
    yield f"assert (S : diverges (fun t => {term(start)} + {term(slope)} * u_c t)) by (apply diverges_affine; [positive | exact ({step.cited(diverges)})])."
    yield f"generalize (vanishes_affine U_a _ _ ({parts[0]}) ({parts[1]}) {_bounded(step)} S); apply tends_ext; intros t Ht."
    facts = [s for s in step.frontier if not isinstance(s.relation, sp.Equality)]
    yield from (f"pose proof ({step.cited(s)}{' t Ht' if s.timed else ''})." for s in facts)
    yield f"assert (0 < {term(size)}) by positive; identity."


def _first_order(step: Step) -> Iterator[str]:
    """The rate to first order in 1/t, from that of h/sigma."""
    from .proofs import divisors

    if step.rule != "FirstOrder" or not _bounded(step):
        return
    law, deviation, ratio, limit = step.parents[:4]
    quantity, end = ratio.relation.lhs.args[0], ratio.relation.rhs
    y = sp.Symbol("ratio", real=True)
    function = in_terms_of(law.relation.rhs, quantity, y)
    parts = _affine(sp.expand(_WEAR * (quantity - end) - deviation.relation.lhs.args[0]))
    if parts is None or function.has(t):
        return
    slope = sp.diff(function, y).subs(y, end).doit()
    speed = limit.relation.rhs
    yield f"assert (D : is_derive (fun ratio => {term(function)}) ({term(end)}) ({term(slope)})) by (auto_derive; [repeat split; positive | identity])."
    yield f"assert (E : tends (fun t => u_c t * ({term(quantity)} - {term(end)}) - ({parts[0]} + ({parts[1]}) * U_a t)) 0)."
    yield f"{{ generalize ({step.cited(deviation)}); apply tends_ext; intros t Ht."
    yield from divisors(step)
    yield "field; positive. }"
    yield f"assert (N : {term(speed)} <> 0) by (apply Rgt_not_eq, Rlt_gt; positive)."
    yield f"generalize (first_order_affine u_c (fun t => {term(quantity)}) U_a _ _ _ ({term(speed)}) _ ({parts[0]}) ({parts[1]}) smooth_u_c ({step.cited(law)}) D eq_refl N {_bounded(step)} ({step.cited(ratio)}) ({step.cited(limit)}) E)."
    yield "apply tends_ext; intros t Ht; bounds; identity."


def _drift(step: Step) -> Iterator[str]:
    """The logarithmic drift under a periodic, continuous load."""
    if step.rule != "LogarithmicDrift":
        return
    approach = step.parents[0]
    inside = approach.relation.lhs.args[0]
    (rate,) = inside.atoms(sp.Derivative)
    speed_now = sp.Symbol("speed_now", real=True)
    flat = inside.xreplace({rate: speed_now})
    parts = (
        _affine(-flat.subs(t, 0))
        if not flat.has(_LOAD)
        else _affine(
            -flat.xreplace({_LOAD: sp.Symbol("load", real=True)})
            .subs(t, 0)
            .xreplace({sp.Symbol("load", real=True): _LOAD})
        )
    )
    if parts is None:
        return
    load = flat.xreplace({_LOAD: sp.Symbol("load", real=True)})
    speed = sp.expand(speed_now - sp.diff(load, t))
    mean = next(
        p
        for p in step.statement.premises
        if isinstance(p.relation, sp.Equality) and p.relation.lhs == symbol("U_mean")
    )
    periodic = next(
        p
        for p in step.statement.premises
        if isinstance(p.relation, sp.Equality) and p.relation.rhs == _LOAD
    )
    smooth = next(p for p in step.statement.premises if p.said.endswith("continuous U_a t"))
    yield f"assert (M : RInt U_a 0 T = U_mean * T) by (rewrite {mean.label}; exact (mean_times _ T domain_T))."
    yield f"assert (E : tends (fun t => t * (Derive u_c t - ({term(speed)})) - ({parts[0]} + ({parts[1]}) * U_a t)) 0) by (generalize ({step.cited(approach)}); apply tends_ext; intros t Ht; field; positive)."
    yield f"pose proof (logarithmic_drift_affine u_c U_a _ _ _ _ T domain_T smooth_u_c {smooth.label} {periodic.label} M E) as L."
    yield f"apply (tends_value _ (({parts[0]}) + ({parts[1]}) * U_mean)); [field; positive |]."
    yield f"apply (tends_ext (fun t => (u_c t - ({term(speed)}) * t) / ln (t / T))); [| exact L]."
    yield "intros t Ht; unfold Rdiv; f_equal; field; positive."


def _derivative(step: Step) -> Iterator[str]:
    """The derivative of a result, taken by Coquelicot."""
    if step.rule != "Differentiated":
        return
    (slope,) = step.relation.atoms(sp.Derivative)
    value = term(sp.diff(slope.expr, *slope.variables))
    named = [
        s
        for s in (*step.frontier, *step.hypotheses)
        if isinstance(s.relation, sp.Equality) and not s.timed and not s.relation.has(sp.Limit)
    ]
    variable = binder(slope.variables[0])
    yield f"assert (D : Derive (fun {variable} => {term(slope.expr)}) {variable} = {value}) by (apply is_derive_unique; auto_derive; [repeat split; positive | identity])."
    yield "rewrite D; clear D."
    used = {
        s.relation.lhs: s
        for s in named
        if isinstance(s.relation.lhs, sp.Symbol) and step.judgement.relation.has(s.relation.lhs)
    }
    yield from (f"rewrite ?({step.cited(s)})." for s in used.values())
    yield "bounds; same_exponentials; field; repeat split; positive."
