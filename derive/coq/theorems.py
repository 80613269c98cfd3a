"""Steps that cite one general theorem of the library: what is inserted into it.

Key results
    proof    the lines of a proof, none where no theorem is known for the step
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping
from dataclasses import dataclass

import sympy as sp
from sympy.core.function import AppliedUndef

from ..rules.inequalities import LogarithmicSlope
from ..rules.limits import in_terms_of
from ..rules.solutions import Integrated
from ..symbols import symbol, t
from . import limits
from .printer import binder, field, term
from .steps import Step

_LOAD = symbol("U_a")
_WEAR = symbol("u_c")
_RATIO = sp.Symbol("ratio", real=True)


def _later(step: Step) -> Iterator[str]:
    """What holds at every time, one period later."""
    yield "intros t Ht; assert (HT : 0 <= T + t) by lra."
    yield f"pose proof ({step.cited(step.frontier[0])} (T + t) HT) as P0."
    yield "first [exact P0 | rewrite ?derive_later; exact P0]."


def _same_rate(step: Step) -> Iterator[str]:
    """The rates of two sides that are equal at every time."""
    given = step.parents[0]
    rates = [f"(fun t => {term(side)})" for side in given.relation.args]
    slopes = [term(sp.diff(side, t)) for side in given.relation.args]
    for label, rate, slope in zip("AB", rates, slopes, strict=True):
        yield f"assert ({label} : forall t, 0 <= t -> is_derive {rate} t ({slope})) by (intros; derived)."
    yield "intros t Ht."
    yield f"multiple (same_rate _ _ _ _ t Ht ({step.cited(given)}) (A t Ht) (B t Ht)) 1."


def _separates(step: Step) -> Iterator[str]:
    """Separated variables: g(y) y' is constant."""
    pace, integral = term(step.relation.lhs / t), step.relation.rhs
    s, start, y = integral.limits[0]
    made, low, rate = _function(integral.function, s), _low(y), (sp.Derivative(y, t),)
    first = next(h for h in step.hypotheses if h.relation.args == (y.subs(t, 0), start))
    rates = (next(r for r in step.ancestors if r.relation.args[:1] == rate), step.frontier[0])
    yield _continuous("C", made, s, y)
    yield f"assert (D : forall t, 0 <= t -> {made} ({term(y)}) * Derive {field(y)} t = {pace})."
    yield from ("{ intros t Ht.", *step.signs())
    yield f"{step.stated(dict.fromkeys(rates))}cbv beta; insert; identity. }}"
    yield f"assert (B : forall t, 0 <= t -> Rbar_lt {low} ({term(y)})) by (simpl; auto)."
    yield "intros t Ht."
    yield f"pose proof (separates {field(y)} {made} ({pace}) {low} smooth_{field(y)} B C D t Ht) as Q."
    yield f"rewrite ({step.cited(first)}) in Q; refine (eq_trans _ Q); field; positive."


def _function(expr: sp.Expr, variable: sp.Symbol) -> str:
    return f"(fun {binder(variable)} => {term(expr)})"


def _low(y: sp.Expr) -> str:
    """Return the end of the half-line, or line, on which a field varies."""
    return "0" if y.is_nonnegative else "m_infty"


def _assured(label: str, said: str, s: sp.Symbol, y: sp.Expr, proof: str) -> str:
    """State what holds wherever a field may be."""
    place = f"forall {binder(s)} : R, Rbar_lt {_low(y)} {binder(s)}"
    return f"assert ({label} : {place} -> {said}) by (simpl; intros; {proof})."


def _continuous(label: str, made: str, s: sp.Symbol, y: sp.Expr) -> str:
    proof = f"apply (ex_derive_continuous {made}); auto_derive; repeat split; positive"
    return _assured(label, f"continuous {made} {binder(s)}", s, y, proof)


def _by_parts(step: Step) -> Iterator[str]:
    """A part of an integral, by a primitive."""
    rule = step.judgement.rule
    assert isinstance(rule, Integrated)
    given = step.frontier[0]
    (integral,) = given.relation.atoms(sp.Integral)
    s, *ends = integral.limits[0]
    y, parts = ends[1], (rule.primitive, integral.function, rule.rest)
    primitive, made, rest = (_function(part, s) for part in parts)
    here = binder(s)
    slope = f"is_derive {primitive} {here} ({made} {here} - {rest} {here})"
    yield _continuous("C", made, s, y)
    yield _continuous("E", rest, s, y)
    yield _assured("D", slope, s, y, "cbv beta; derived")
    yield from ("intros t Ht.", *step.signs())
    a, b = (f"({term(end)})" for end in ends)
    yield f"rewrite ({step.now(given)}), (by_parts {primitive} {made} {rest} {_low(y)} {a} {b}); [| simpl; trivial | simpl; trivial | exact D | exact C | exact E]."
    yield "rewrite ?RInt_zero; unfold Rdiv; rewrite ?Rmult_0_r, ?Rmult_0_l, ?exp_0; identity."


def _grows(step: Step) -> Iterator[str]:
    """A rate of at least c, from 0: u >= c t."""
    grown = step.relation.gts
    bound = next(s for s in step.frontier if s.relation.has(sp.Derivative(grown, t)))
    start = next(s for s in step.frontier if s.relation.lhs == grown.subs(t, 0))
    name = field(grown)
    yield f"intros t Ht; pose proof (grows {name} _ smooth_{name} ({step.cited(bound)}) t Ht) as P0."
    yield f"rewrite ({step.cited(start)}) in P0; same_inequality P0."


def _integrates(step: Step) -> Iterator[str]:
    """y' = c x' with constant c: y = y(0) + c (x - x(0))."""
    slope = sp.Derivative(step.relation.lhs, t)
    rate = next(s for s in step.frontier if s.relation.lhs == slope)
    (driving,) = rate.relation.rhs.atoms(sp.Derivative)
    factor = sp.cancel(rate.relation.rhs / driving)
    y, x = field(step.relation.lhs), field(driving.expr)
    values = [step.cited(s) for s in step.frontier if not s.timed]
    yield "intros t Ht."
    yield f"rewrite (integrates {y} {x} ({term(factor)}) smooth_{y} smooth_{x}); [| | exact Ht]."
    yield "- " + "; ".join((*(f"rewrite ?({v})" for v in values), "identity."))
    yield f"- intros s Hs; rewrite ({step.cited(rate)} s Hs); identity."


@dataclass(frozen=True)
class _Affine:
    """An expression c0 + c1 L in a load, which is U_a, or U_a - U_c on a compliant support."""

    load: str
    c0: str
    c1: str

    @property
    def function(self) -> str:
        """Return the load as a function."""
        return "U_a" if self.load == "U_a t" else f"(fun t => {self.load})"

    def __str__(self) -> str:
        return f"({self.c0} + ({self.c1}) * ({self.load}))"


def _affine(expr: sp.Expr) -> _Affine | None:
    """Return an expression as one that is affine in the load; None where it is not."""
    flat = sp.Symbol("load", real=True)
    for load, value in (("U_a t", flat), ("U_a t - U_c t", flat + symbol("U_c"))):
        inside = sp.expand(expr.xreplace({_LOAD: value}))
        slope = sp.diff(inside, flat)
        if not inside.has(t) and not slope.has(flat):
            return _Affine(load, term(inside.subs(flat, 0)), term(slope))
    return None


def _bounded(step: Step, affine: _Affine) -> Iterator[str]:
    """State that the load is bounded."""
    yield f"assert (B : exists b, forall t, 0 <= t -> Rabs ({affine.load}) <= b)."
    bound = "U" if affine.load == "U_a t" else "(U + p_max / k)"
    yield f"{{ exists {bound}; intros t Ht."
    facts = (s for s in step.ancestors if not isinstance(s.relation, sp.Equality))
    yield from (f"pose proof ({step.now(s)})." for s in facts)
    yield "arithmetic. }"
    yield "destruct B as [b B]."


def _bounded_load(step: Step) -> Iterator[str]:
    """What tends to 0 because only a bounded load stands over a roughness that diverges."""
    if step.relation.rhs != 0:
        return
    claimed = step.relation.lhs.args[0]
    inside = sp.together(claimed)
    below = (1 / p for p in sorted(claimed.atoms(sp.Pow), key=sp.default_sort_key))
    size = next((d for d in below if d.is_Add and sp.diff(d, _WEAR).is_Symbol), None)
    affine = _affine(sp.cancel(inside * size)) if size is not None else None
    if size is None or affine is None:
        return
    slope, start = sp.diff(size, _WEAR), size.subs(_WEAR, 0)
    diverges = next(s for s in step.limits if s.relation.rhs == sp.oo)
    yield f"assert (S : diverges (fun t => {term(start)} + {term(slope)} * u_c t)) by (apply diverges_affine; [positive | exact ({step.cited(diverges)})])."
    yield from _bounded(step, affine)
    yield f"pose proof (affine_bounded {affine.function} b ({affine.c0}) ({affine.c1}) B) as A."
    yield f"generalize (bounded_vanishes (fun t => {affine}) _ _ A (tends_inv_diverges _ S)); apply tends_ext; intros t Ht."
    facts = [s for s in step.frontier if not isinstance(s.relation, sp.Equality)]
    yield from (f"pose proof ({step.now(s)})." for s in facts)
    yield f"assert (0 < {term(size)}) by positive; identity."


def _first_order(step: Step) -> Iterator[str]:
    """The rate to first order in 1/t, from that of h/sigma."""
    law, deviation, ratio, limit = step.parents[:4]
    quantity, end = ratio.relation.lhs.args[0], ratio.relation.rhs
    function = in_terms_of(law.relation.rhs, quantity, _RATIO)
    affine = _affine(sp.expand(_WEAR * (quantity - end) - deviation.relation.lhs.args[0]))
    if affine is None or function.has(t):
        return
    slope = sp.diff(function, _RATIO).subs(_RATIO, end).doit()
    speed, made, at = limit.relation.rhs, f"(fun ratio => {term(function)})", term(quantity)
    signs = step.signs()
    yield f"assert (D : is_derive {made} ({term(end)}) ({term(slope)})) by derived."
    yield f"assert (W : forall t, 0 <= t -> Derive u_c t = {made} ({at}))."
    yield from (
        "{ intros t Ht.",
        *signs,
        f"rewrite ({step.cited(law)} t Ht); cbv beta; identity. }}",
    )
    yield f"assert (E : tends (fun t => u_c t * ({at} - {term(end)}) - {affine}) 0)."
    yield f"{{ generalize ({step.cited(deviation)}); apply tends_ext; intros t Ht."
    yield from (*signs, "field; positive. }")
    yield f"assert (N : {term(speed)} <> 0) by (apply Rgt_not_eq, Rlt_gt; positive)."
    yield f"assert (L : {made} ({term(end)}) = {term(speed)}) by (cbv beta; identity)."
    yield from _bounded(step, affine)
    yield f"pose proof (affine_bounded {affine.function} b ({affine.c0}) ({affine.c1}) B) as A."
    yield f"generalize (first_order u_c (fun t => {at}) (fun t => {affine}) {made} _ _ ({term(speed)}) _ smooth_u_c W D L N A ({step.cited(ratio)}) ({step.cited(limit)}) E)."
    yield "apply tends_ext; intros t Ht; cbv beta; bounds; identity."


def _drift(step: Step) -> Iterator[str]:
    """The logarithmic drift under a periodic, continuous load."""
    approach = step.parents[0]
    inside = approach.relation.lhs.args[0]
    rate = next(d for d in inside.atoms(sp.Derivative) if d.has(AppliedUndef) and t in d.variables)
    now, load = sp.symbols("speed_now load", real=True)
    flat = inside.xreplace({rate: now, _LOAD: load})
    affine = _affine(-flat.subs(t, 0).xreplace({load: _LOAD}))
    if affine is None:
        return
    speed = sp.expand(now - sp.diff(flat, t))
    said = {part: p for p in step.statement.premises for part in p.relation.args}
    mean, periodic = said[symbol("U_mean")], said[_LOAD]
    smooth = next(p for p in step.statement.premises if p.said.endswith("continuous U_a t"))
    yield f"assert (M : RInt U_a 0 T = U_mean * T) by (rewrite {mean.label}; unfold Rdiv; rewrite Rmult_assoc, Rinv_l, Rmult_1_r; [reflexivity | positive])."
    yield f"assert (E : tends (fun t => t * (Derive u_c t - ({term(speed)})) - {affine}) 0) by (generalize ({step.cited(approach)}); apply tends_ext; intros t Ht; field; positive)."
    yield f"pose proof (logarithmic_drift u_c U_a _ _ _ _ T domain_T smooth_u_c {smooth.label} {periodic.label} M E) as L."
    yield f"apply (tends_value _ (({affine.c0}) + ({affine.c1}) * U_mean)); [field; positive |]."
    yield f"apply (tends_ext (fun t => (u_c t - ({term(speed)}) * t) / ln (t / T))); [| exact L]."
    yield "intros t Ht; unfold Rdiv; f_equal; field; positive."


def _derivative(step: Step) -> Iterator[str]:
    """The derivative of a result, taken by Coquelicot."""
    (slope,) = step.relation.atoms(sp.Derivative)
    value = term(sp.diff(slope.expr, *slope.variables))
    named = [
        s
        for s in (*step.frontier, *step.hypotheses)
        if isinstance(s.relation, sp.Equality) and not s.timed and not s.relation.has(sp.Limit)
    ]
    variable = binder(slope.variables[0])
    yield f"assert (D : Derive (fun {variable} => {term(slope.expr)}) {variable} = {value}) by (apply is_derive_unique; derived)."
    yield "rewrite D; clear D."
    used = {
        s.relation.lhs: s
        for s in named
        if isinstance(s.relation.lhs, sp.Symbol) and step.judgement.relation.has(s.relation.lhs)
    }
    yield from (f"rewrite ?({step.cited(s)})." for s in used.values())
    yield "bounds; same_exponentials; field; repeat split; positive."


def _lipschitz(step: Step) -> Iterator[str]:
    """An increase of tanh, which is at most that of its argument."""
    low, high = sorted(step.relation.atoms(sp.tanh), key=sp.count_ops)
    yield "intros t Ht."
    for p in step.statement.premises:
        yield f"pose proof ({p.label}{' t Ht' if p.timed else ''})."
    ordered = f"{term(low.args[0])} <= {term(high.args[0])}"
    yield f"assert (D : {ordered}) by (apply Rminus_le_0; ring_simplify; positive)."
    yield "pose proof (tanh_order _ _ D); pose proof (tanh_slope _ _ D)."
    middle = next(part.gts for part in step.relation.args if part.lts == 0)
    factor = sp.diff(middle.xreplace({high: _RATIO}), _RATIO)
    left = sp.expand(high.args[0] - low.args[0]) - high + low
    forms = (factor * (high - low if part.lts == 0 else left) for part in step.relation.args)
    yield f"split; [{' | '.join(f'manifest ({term(form)})' for form in forms)}]."


def _logarithmic_slope(step: Step) -> Iterator[str]:
    """The change of the logarithm of a function, whose slope is bounded by a multiple of it."""
    rule = step.judgement.rule
    assert isinstance(rule, LogarithmicSlope)
    function = rule.function(_RATIO)
    value, slope, bound = map(term, (function, sp.diff(function, _RATIO), rule.bound))
    made, a, b = f"(fun ratio => {value})", term(rule.a), term(rule.b)
    yield f"assert (A : forall ratio, 0 < {value}) by (intro; arithmetic)."
    yield f"assert (B : forall ratio, is_derive {made} ratio ({slope})) by (intro; derived)."
    yield f"assert (C : forall ratio, Rabs ({slope}) <= {bound} * ({value})) by (intro; arithmetic)."
    yield f"intros t Ht; pose proof (log_slope _ _ _ ({a}) ({b}) A B C) as P0; cbv beta in P0; same_inequality P0."


def _threshold(step: Step) -> Iterator[str]:
    """A level that an increasing function exceeds beyond one point, and not before."""
    point, level = step.relation.args
    if isinstance(point, sp.Gt) and point.gts.is_Symbol and level.gts.has(point.gts):
        yield from (f"pose proof ({step.cited(s)})." for s in step.ancestors if not s.timed)
        yield f"apply (threshold (fun {term(point.gts)} => {term(level.gts)}))."
        yield "all: cbv beta; first [intros; increasing | positive | bounds; identity]."


_BY_RULE: Mapping[str, Callable[[Step], Iterator[str]]] = {
    "Accumulates": limits.accumulates,
    "AtInfinity": _bounded_load,
    "Differentiate": _same_rate,
    "Differentiated": _derivative,
    "Diverges": limits.diverges,
    "FirstOrder": _first_order,
    "Grows": _grows,
    "Integrate": _integrates,
    "Integrated": _by_parts,
    "Lipschitz": _lipschitz,
    "LogarithmicDrift": _drift,
    "LogarithmicSlope": _logarithmic_slope,
    "OnePeriodLater": _later,
    "Separate": _separates,
    "Vanishes": limits.squeezed,
}
"""The proofs by the name of the rule."""


def proof(step: Step) -> list[str]:
    """Return the lines of a proof by a general theorem, none where there is none for the step."""
    if isinstance(step.relation, sp.Equivalent):
        return list(_threshold(step))
    return list(_BY_RULE[step.rule](step)) if step.rule in _BY_RULE else []
